/* SPDX-License-Identifier: MIT
 *
 * iomap_rows - what the table of an I/O map shows: rows, messages, choices.
 *
 * It reads the map, its check, the program and this machine, and changes none of them.
 */
#ifndef EDITOR_IOMAP_ROWS_H
#define EDITOR_IOMAP_ROWS_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/document/iomap_check.h"
#include "editor-gtk/document/iomap_text.h"
#include "editor-gtk/document/iomap_uses.h"
#include "editor-gtk/kit/panel_row.h"

/* Texts of a row, numbered after its fields. */
enum { IOMAP_SYMBOL = IO_FIELDS, IOMAP_STATE };

/** iomap_row_new - of row @number of @io; its texts are the fields, IOMAP_SYMBOL and
 * IOMAP_STATE, its index is @number. @check: NULL: no errors. */
LadderPanelRow *iomap_row_new(const struct io_uses *uses, const struct io_machine *machine,
			      const struct io_text *io, const struct io_check *check,
			      int number);
/** iomap_field - io_text_field() for g_free(); never NULL. */
char *iomap_field(const struct io_text *io, int row, enum io_field field);
/** iomap_has - does a row have this address? */
bool iomap_has(const struct io_text *io, struct iec_addr addr);
/** iomap_lacks - "The program uses, the map lacks: ..."; NULL: nothing. Caller: g_free. */
char *iomap_lacks(const struct io_uses *uses, const struct io_text *io);
/** iomap_first_error - "Line 4: ..."; @all: also of lines that have a row. NULL: none.
 * Caller: g_free. */
char *iomap_first_error(const struct io_check *check, const struct io_text *io, bool all);
/** iomap_first_doubt - the first output without safe=, "Line 4: ...", and how many there are more.
 * NULL: none. Caller: g_free. */
char *iomap_first_doubt(const struct io_check *check);
/** iomap_choices - the values of a field to choose from: pairs of a text and its description.
 * Caller: g_ptr_array_unref. */
GPtrArray *iomap_choices(const struct io_uses *uses, const struct io_machine *machine,
			 const struct io_text *io, enum io_field field);

/** iomap_new_text - a map with a point for every input and output of @document, on lines of
 * this machine if it has any, else simulated. Caller: g_free. */
char *iomap_new_text(LadderDocument *document);

#endif
