/* SPDX-License-Identifier: MIT
 *
 * i18n - texts that a person reads, in that person's language.
 *
 * Words of the catalogue (TON, NC, COIL) are never translated; what is said of them is.
 */
#ifndef EDITOR_I18N_H
#define EDITOR_I18N_H

#include <libintl.h>

/** _ - the text in the language of the session. Lives for ever. */
#define _(text) gettext(text)
/** N_ - marks a text of a table for translation; _() it where it is shown. */
#define N_(text) text

/** said - a text of the engine's tables (diagnostics, what words do), in the language of
 *  the session. "" stays: gettext would give its own header for it. Lives for ever. */
static inline const char *said(const char *text)
{
	return text[0] ? gettext(text) : text;
}

#endif
