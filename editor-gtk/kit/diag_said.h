/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 */
#ifndef EDITOR_DIAG_SAID_H
#define EDITOR_DIAG_SAID_H

#include "engine/base/diag.h"

/** diag_said_of - the text of @id with the parts of @arg (DIAG_AND): names of the user
 * unchanged, texts of the engine translated. Caller frees with g_free(). */
char *diag_said_of(enum diag_id id, const char *arg);

/** diag_said_whole - the same of a diagnostic, without its place. Caller frees with
 * g_free(). */
char *diag_said_whole(const struct diag *diag);

/** diag_said_line - as diag_print(): place, code and text; in English both are the same.
 * Caller frees with g_free(). */
char *diag_said_line(const struct diag *diag);

/** diag_first_error - NULL: there is none. Borrowed from @diags. */
const struct diag *diag_first_error(const struct diag_list *diags);

#endif
