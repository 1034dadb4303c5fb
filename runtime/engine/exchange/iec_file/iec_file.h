/* SPDX-License-Identifier: MIT
 *
 * iec_file - files of other tools that hold IEC text: what TwinCAT and CODESYS 2.3 export, and text
 * in Windows-1252.
 *
 * The result is plain IEC text with the same lines, so that every message has the place in the
 * file. A file that holds no IEC text is named for what it is. Nothing here writes such files.
 */
#ifndef EXCHANGE_IEC_FILE_IEC_FILE_H
#define EXCHANGE_IEC_FILE_IEC_FILE_H

#include "engine/base/diag.h"

#include <stdbool.h>
#include <stddef.h>

struct text_file;

/**
 * iec_file_text - the IEC text in a file
 * @files: @count files of one project as they are on the disk; their names, for diagnostics, must
 *         live as long as @diags
 * @at:    which of them
 * @out:   gets the text, NUL-ended, @out_len bytes without it, also if it is the same in a file that
 *         another tool exported; NULL: the bytes are read as they are
 * @diags: gets what is left out and what cannot be read, with their lines
 *
 * Owns: the caller, free() @out. Scan-safe: no.
 * Fails: false after a diagnostic: this is no IEC text, or no memory.
 */
bool iec_file_text(const struct text_file *files, int count, int at, char **out, size_t *out_len,
		   struct diag_list *diags);
#endif
