/* SPDX-License-Identifier: MIT
 *
 * csv - tables of symbols as text: RFC 4180, UTF-8, with a header row.
 *
 * An import begins with a plan: for each line what it would do or why it cannot, and what
 * would then be wrong with the program. Applying it is one step of the history. This file
 * reads and writes no files.
 */
#ifndef EDITOR_CSV_H
#define EDITOR_CSV_H

#include "editor-gtk/document/symbols.h"

#define CSV_ROWS_MOST 200000
#define CSV_FIELD_MOST 4096 /* bytes of one field                             */
#define CSV_COLUMNS_MOST 64

/**
 * csv_read - splits a text into records
 * @take: gets each record with its first line, 1-based; returns false to stop
 *
 * Fields are separated by comma, semicolon or tab: by the one that the first line has most
 * of. Lines end with CR LF, LF or CR. Empty lines and a BOM are skipped.
 * Returns 0, or the line of an error, and @why (translated, lives for ever).
 */
int csv_read(const char *text, gsize len,
	     bool (*take)(void *context, int line, char *const *field, int count),
	     void *context, const char **why);

/** csv_export - all symbols of this file, without those of included files.
 * Columns: Scope, Block, Name, Type, Address, Initial value, Retain, Constant, Comment;
 * never translated. Lines end with CR LF. @count: gets the number of symbols. Owns: the
 * caller, g_free(). */
char *csv_export(LadderDocument *document, int *count);

enum csv_action { CSV_ADD, CSV_CHANGE, CSV_SAME, CSV_REFUSE };

struct csv_entry {
	enum csv_action action;
	int line;            /* in the table, 1-based                         */
	char *name;          /* with its scope: Main.Delay                    */
	char *text;          /* the change, or why there is none; translated  */
	char *fault;         /* what is then wrong with the program; NULL: nothing */
	bool warning;        /* the program runs despite the fault            */
};

struct csv_plan {
	GPtrArray *entry;    /* of struct csv_entry *                         */
	int counts[CSV_REFUSE + 1];
	int faults;          /* entries with one                              */
	struct symbol_batch *batch;
	LadderDocument *document;
	guint64 version;     /* version of the document that the plan is for  */
};

/**
 * csv_plan_new - finds out what an import would do
 *
 * Symbols are found by scope and name. A column that the table lacks leaves the field as it
 * is. The document does not change. Owns: the caller, csv_plan_free().
 */
struct csv_plan *csv_plan_new(LadderDocument *document, const char *text, gsize len);
void csv_plan_free(struct csv_plan *plan);
/** csv_plan_apply - applies all entries that are not refused, as one step; once. Fails:
 * false, and @why (the caller frees it): the document changed after the plan, or the result
 * cannot be read. */
bool csv_plan_apply(struct csv_plan *plan, char **why);

#endif
