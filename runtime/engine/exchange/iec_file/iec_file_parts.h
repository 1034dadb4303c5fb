/* SPDX-License-Identifier: MIT
 *
 * iec_file_parts - what the files of this room share. Only they include it.
 */
#ifndef EXCHANGE_IEC_FILE_IEC_FILE_PARTS_H
#define EXCHANGE_IEC_FILE_IEC_FILE_PARTS_H

#include "engine/exchange/iec_file/iec_file.h"

#include "engine/text/text.h"

/**
 * stranger_find - the message about a file that is no IEC text
 * @arg: gets its argument, the name of a kind of file, static; or ""
 *
 * Returns DIAG_COUNT: it is none that is known. Scan-safe: no.
 */
enum diag_id stranger_find(const char *bytes, size_t len, const char **arg);

/** stranger_is_siemens - is it the text of a Siemens controller, though it begins as IEC text does? */
bool stranger_is_siemens(const char *bytes, size_t len);

/** twincat_is - is it a TwinCAT object, a .TcPOU, .TcDUT or .TcGVL? */
bool twincat_is(const char *bytes, size_t len);
/**
 * twincat_text - its declaration and body, everything else blank
 * @out: room for 2 * @len + 64 bytes
 *
 * Returns the bytes written. Told in @diags: what cannot be read. Scan-safe: no.
 */
size_t twincat_text(const char *file, const char *bytes, size_t len, char *out,
		    struct diag_list *diags);

/**
 * twincat_blank_lists - `Lights.Red`, where Lights is a list of global variables, is the variable Red: puts
 * blanks over `Lights.` in @text
 * @files: @count files of the project as they are on the disk: which lists it has
 *
 * Not if @text itself declares something with the name of the list. Scan-safe: no.
 */
void twincat_blank_lists(const struct text_file *files, int count, char *text, size_t len);

/** codesys_is - does a CODESYS 2.3 export begin here? */
bool codesys_is(const char *bytes, size_t len);
/** codesys_blank - puts blanks over all in @text that is no IEC text, and tells of it. */
void codesys_blank(const char *file, char *text, size_t len, struct diag_list *diags);
#endif
