/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 */
#ifndef EDITOR_DIAG_SAID_H
#define EDITOR_DIAG_SAID_H

#include "engine/base/diag.h"

/** diag_said - its text, without its argument. Lives for ever. */
const char *diag_said(const struct diag *diag);

/**
 * diag_said_arg - its argument: names of the user unchanged, words of the engine translated.
 * Caller frees with g_free().
 */
char *diag_said_arg(const struct diag *diag);

/** diag_said_whole - "text: argument", or the text alone. Caller frees with g_free(). */
char *diag_said_whole(const struct diag *diag);

/** diag_said_line - as diag_print(), place, code and text; in English it is the same. Caller
 * frees with g_free(). */
char *diag_said_line(const struct diag *diag);

#endif
