/* SPDX-License-Identifier: MIT
 *
 * csv - tables of symbols as text: RFC 4180, UTF-8, with a header row.
 *
 * An import is first a plan, which tells line by line what it would do or why not, and what
 * would be wrong after it; to carry it out is one step of the history. It reads and writes no files.
 */
#ifndef EDITOR_CSV_H
#define EDITOR_CSV_H

#include "editor-gtk/document/symbols.h"

#define CSV_ROWS_MOST 200000
#define CSV_FIELD_MOST 4096 /* bytes of one field                             */
#define CSV_COLUMNS_MOST 64

/**
 * csv_read - takes a text apart
 * @take: gets each record with the line it begins on, 1-based; false ends it
 *
 * Fields are parted by comma, semicolon or tab, whatever the first line has most of.
 * Lines end with CR LF, LF or CR; empty ones are left out; a BOM too.
 * Fails: 0, or the line of what is no CSV, and @why (translated, lives for ever).
 */
int csv_read(const char *text, gsize len,
	     bool (*take)(void *context, int line, char *const *field, int count),
	     void *context, const char **why);

/** csv_export - all symbols of this file; those of included files are left out.
 * Columns: Scope, Block, Name, Type, Address, Initial value, Retain, Constant, Comment;
 * never translated. Lines end with CR LF. @count: gets how many. Owns: the caller, g_free(). */
char *csv_export(LadderDocument *document, int *count);

enum csv_action { CSV_ADD, CSV_CHANGE, CSV_SAME, CSV_REFUSE };

struct csv_entry {
	enum csv_action action;
	int line;            /* in the table, 1-based                         */
	char *name;          /* with its scope: Main.Delay                    */
	char *text;          /* what changes, or why it cannot; translated    */
	char *fault;         /* what is wrong with the program then; NULL: nothing */
	bool warning;        /* a fault, and the program runs nevertheless    */
};

struct csv_plan {
	GPtrArray *entry;    /* of struct csv_entry *                         */
	int counts[CSV_REFUSE + 1];
	int faults;          /* entries with one                              */
	struct symbol_batch *batch;
	LadderDocument *document;
	guint64 version;     /* of the document it was made for               */
};

/**
 * csv_plan_new - what an import would do: symbols are found by scope and name; a column
 *                that is not there leaves what there is
 * The document is not changed. Owns: the caller, csv_plan_free().
 */
struct csv_plan *csv_plan_new(LadderDocument *document, const char *text, gsize len);
void csv_plan_free(struct csv_plan *plan);
/** csv_plan_apply - all that is not refused, as one step; once. Fails: false, and @why
 * (the caller frees it): the document is another by now, or it cannot be read. */
bool csv_plan_apply(struct csv_plan *plan, char **why);

#endif
