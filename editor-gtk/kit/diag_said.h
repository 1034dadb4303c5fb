/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 */
#ifndef EDITOR_DIAG_SAID_H
#define EDITOR_DIAG_SAID_H

#include "engine/base/diag.h"

/** diag_said - its text, without what it speaks of. Lives for ever. */
const char *diag_said(const struct diag *diag);

/**
 * diag_said_arg - what it speaks of: names of the user as they are, what the engine
 * expected, counted or says of them in the language of the session. Caller frees with
 * g_free().
 */
char *diag_said_arg(const struct diag *diag);

/** diag_said_whole - "text: what", or the text alone. Caller frees with g_free(). */
char *diag_said_whole(const struct diag *diag);

/** diag_said_line - as diag_print(), place, code and text; in English it is the same. Caller
 * frees with g_free(). */
char *diag_said_line(const struct diag *diag);

#endif
