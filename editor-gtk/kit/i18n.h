/* SPDX-License-Identifier: MIT
 *
 * i18n - texts in the language of the session.
 *
 * Words of the catalogue (TON, NC, COIL) are never translated; their descriptions are.
 */
#ifndef EDITOR_I18N_H
#define EDITOR_I18N_H

#include <libintl.h>

/** _ - the text in the language of the session. Lives for ever. */
#define _(text) gettext(text)
/** N_ - marks a text of a table for translation; _() it where it is shown. */
#define N_(text) text

/** said - a text of the engine's tables (diagnostics, descriptions of words), in the
 * language of the session. "" stays: gettext would return its header for it. Lives for
 * ever. */
static inline const char *said(const char *text)
{
	return text[0] ? gettext(text) : text;
}

#endif
