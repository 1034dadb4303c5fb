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
#include "editor-gtk/document/iomap_devices.h"
#include "editor-gtk/iomap/iomap_scan.h"
#include "editor-gtk/document/iomap_text.h"
#include "editor-gtk/document/iomap_uses.h"
#include "editor-gtk/kit/panel_row.h"

/* The pages of the table. */
enum iomap_page {
	IOMAP_PINS, IOMAP_ANALOG, IOMAP_MODBUS, IOMAP_PEERS, IOMAP_BUSES, IOMAP_SERVED, IOMAP_PAGES
};

/* Texts of a row: 0 … are the columns of its page, these are on all pages. */
enum { IOMAP_KIND = PANEL_TEXTS - 4, IOMAP_SYMBOL, IOMAP_VALUE, IOMAP_STATE };

/** iomap_page_name - translated. */
const char *iomap_page_name(enum iomap_page page);
/** iomap_page_of - where a row is shown. */
enum iomap_page iomap_page_of(const struct io_text *io, int row);
/** iomap_column - field of a column of a page; IO_FIELDS: there are no more. */
enum io_field iomap_column(enum iomap_page page, int column);
/** iomap_column_of - the column of a field; -1: the page has none. */
int iomap_column_of(enum iomap_page page, enum io_field field);
/** iomap_column_name - its title, translated. */
const char *iomap_column_name(enum iomap_page page, int column);

/** iomap_row_new - of row @number of @io; its texts are the columns of its page and those above, its
 * index is @number, its table the page, and flags has a bit for each column that its line may have.
 * @check: NULL: no errors. */
LadderPanelRow *iomap_row_new(const struct io_uses *uses, const struct io_machine *machine,
			      const struct io_text *io, const struct io_check *check,
			      int number);
/** iomap_field - io_text_field() for g_free(); never NULL. */
char *iomap_field(const struct io_text *io, int row, enum io_field field);
/** iomap_shown - as the table shows it: addresses are spelled as the preferences ask for. Caller: g_free. */
char *iomap_shown(const struct io_text *io, int row, enum io_field field);
/** iomap_typed - as the map has it: I0.0..3 is %IX0.0..3. Caller: g_free. */
char *iomap_typed(const struct io_text *io, int row, enum io_field field, const char *text);
/** iomap_has - does a row have this address, or a bit of it? @check: NULL: unknown. */
bool iomap_has(const struct io_text *io, const struct io_check *check, struct iec_addr addr);
/** iomap_lacks - "The program uses, the map lacks: ..."; NULL: nothing. Caller: g_free. */
char *iomap_lacks(const struct io_uses *uses, const struct io_text *io,
		  const struct io_check *check);
/** iomap_first_error - "Line 4: ..."; @all: also of lines that have a row. NULL: none.
 * Caller: g_free. */
char *iomap_first_error(const struct io_check *check, const struct io_text *io, bool all);
/** iomap_first_doubt - the first output without safe=, "Line 4: ...", and how many there are more.
 * NULL: none. Caller: g_free. */
char *iomap_first_doubt(const struct io_check *check);
/** iomap_choices - the values of a field to choose from: pairs of a text and its description.
 * @row: that the field is of; -1: of any. Caller: g_ptr_array_unref. */
GPtrArray *iomap_choices(const struct io_uses *uses, const struct io_machine *machine,
			 const struct io_devices *devices, const struct io_text *io, int row,
			 enum io_field field);

/* ---- lines to add ---- */

/* What io_text_add() needs. */
struct iomap_line {
	char *first, *second, *words; /* g_free(), by iomap_line_clear()       */
	int behind;                   /* a row, or -1                          */
};
/**
 * iomap_line_make - the line that usually comes next on a page
 * @kind: IO_KIND_POINT, or a line of the page
 * @row: selected; -1: none
 * Fails: false, and @why (translated, lives for ever) says what the map must have first.
 */
bool iomap_line_make(struct iomap_line *out, const struct io_uses *uses, const struct io_text *io,
		     const struct io_check *check, const struct io_machine *machine,
		     const struct io_devices *devices, enum iomap_page page, enum io_kind kind,
		     int row, const char **why);
/** iomap_line_for - the line of an address that the program uses. */
void iomap_line_for(struct iomap_line *out, const struct io_text *io,
		    const struct io_machine *machine, struct iec_addr addr);
void iomap_line_clear(struct iomap_line *line);

/** iomap_new_text - a map with a point for every input and output of @document, on lines of
 * this machine if it has any, else simulated. Caller: g_free. */
char *iomap_new_text(LadderDocument *document);

/** iomap_offer_units - adds what a scan has found to the choices of a unit. @units: NULL: nothing. */
void iomap_offer_units(const GArray *units, GPtrArray *choices);
/** iomap_bus_of - the BUS line of Modbus that a row is, or names; -1: the first one of the map, if @any; else
 * -1: none. */
int iomap_bus_of(const struct io_text *io, int row, bool any);

#endif
