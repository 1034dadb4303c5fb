/* SPDX-License-Identifier: MIT
 *
 * csv_plan - what the import of a table of symbols would do, and doing it.
 */
#include "editor-gtk/document/csv.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/symbols_text.h"

#include <string.h>

/* Columns by name, any case. */
enum column {
	COLUMN_SCOPE = SYMBOL_FIELDS, COLUMN_BLOCK, COLUMNS
};

static const char *const column_names[COLUMNS] = {
	[FIELD_NAME] = "name", [FIELD_TYPE] = "type", [FIELD_ADDRESS] = "address",
	[FIELD_INITIAL] = "initial value", [FIELD_RETAIN] = "retain",
	[FIELD_CONSTANT] = "constant", [FIELD_COMMENT] = "comment",
	[COLUMN_SCOPE] = "scope", [COLUMN_BLOCK] = "block",
};

struct import {
	struct csv_plan *plan;
	struct symbols *symbols;
	GHashTable *row;     /* "scope.name", folded: struct symbol_row *     */
	GHashTable *seen;    /* the same: its line in the table               */
	int column[COLUMNS]; /* -1: there is none                             */
	bool has_header;
};

static char *key_of(const char *scope, const char *name)
{
	char *text = g_strconcat(scope, ".", name, NULL), *key;

	key = g_ascii_strdown(text, -1);
	g_free(text);
	return key;
}

static void clear_entry(gpointer pointer)
{
	struct csv_entry *entry = pointer;

	g_free(entry->name);
	g_free(entry->text);
	g_free(entry->fault);
	g_free(entry);
}

/* @name, @text: taken over. */
static void tell(struct csv_plan *plan, enum csv_action action, int line, char *name,
		 char *text)
{
	struct csv_entry *entry = g_new0(struct csv_entry, 1);

	entry->action = action;
	entry->line = line;
	entry->name = name;
	entry->text = text;
	plan->counts[action]++;
	g_ptr_array_add(plan->entry, entry);
}

/* ---- the header ---- */

static bool read_header(struct import *import, int line, char *const *field, int count)
{
	for (int i = 0; i < COLUMNS; i++)
		import->column[i] = -1;
	for (int k = 0; k < count; k++) {
		char *name = g_strstrip(g_strdup(field[k]));

		for (int i = 0; i < COLUMNS; i++)
			if (g_ascii_strcasecmp(name, column_names[i]) == 0 &&
			    import->column[i] < 0)
				import->column[i] = k;
		g_free(name);
	}
	import->has_header = true;
	if (import->column[FIELD_NAME] >= 0)
		return true;
	tell(import->plan, CSV_REFUSE, line, g_strdup(""),
	     g_strdup(_("The first line must name the columns; “Name” is needed, and “Type” "
			"for new symbols")));
	return false;
}

/* ---- a record ---- */

/* "" where a record is short; NULL: there is no such column. */
static const char *cell(const struct import *import, int column, char *const *field,
			int count)
{
	const int at = import->column[column];

	if (at < 0)
		return NULL;
	return at < count ? g_strstrip(field[at]) : "";
}

static const char *yes_or_no(const char *text)
{
	static const char *const no[] = { "", "0", "no", "false", "-", "n", "nein", "non",
					  "faux", "falsch", "否" };

	for (gsize i = 0; i < G_N_ELEMENTS(no); i++)
		if (g_ascii_strcasecmp(text, no[i]) == 0)
			return "";
	return "1";
}

/* Table number of a scope; -1: there is none. */
static int table_of(struct project *project, const char *scope)
{
	const int pou = project_find_pou(project, scope, strlen(scope));

	if (!*scope)
		return 0;
	if (pou >= 0)
		return pou + 1;
	for (int i = 0; i < project->structure_count; i++)
		if (g_ascii_strcasecmp(scope, project_text(project,
				project->structure[i].name)) == 0)
			return project->pou_count + 1 + i;
	return -1;
}

#define KIND_FLAGS (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP)

/* The word of a VAR block as its flags; -1: it is none, or none of this table. */
static int flags_of(const char *block, bool member)
{
	static const uint8_t kinds[] = { 0, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR_TEMP };

	if (member || !*block)
		return !*block || g_ascii_strcasecmp(block, "STRUCT") == 0 ? 0 : -1;
	if (g_ascii_strcasecmp(block, "VAR_GLOBAL") == 0)
		return 0;
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (g_ascii_strcasecmp(block, vars_head(kinds[i])) == 0)
			return kinds[i];
	return -1;
}

static void add_change(GString *out, const char *name, const char *old, const char *new)
{
	g_string_append_printf(out, "%s%s: ", out->len ? "; " : "", name);
	if (old)
		g_string_append_printf(out, "%s → ", *old ? old : "–");
	g_string_append(out, *new ? new : "–");
}

/* "Address: %IX0.0 → %IX0.1; Comment: …"; of a new one what it has. */
static char *changes(const struct symbol_row *old, int flags,
		     const char *const text[SYMBOL_FIELDS])
{
	GString *out = g_string_new("");

	if (old && (old->flags & KIND_FLAGS) != flags)
		add_change(out, _("Block"), vars_head(old->flags), vars_head((uint16_t)flags));
	for (int i = FIELD_NAME + 1; i < SYMBOL_FIELDS; i++) {
		if (strcmp(old ? old->text[i] : "", text[i]) == 0)
			continue;
		if (i == FIELD_RETAIN || i == FIELD_CONSTANT)
			add_change(out, symbol_field_name(i), NULL,
				   *text[i] ? _("yes") : _("no"));
		else
			add_change(out, symbol_field_name(i), old ? old->text[i] : NULL,
				   text[i]);
	}
	return g_string_free(out, FALSE);
}

static void put(struct import *import, int line, char *name, int table, int flags,
		const struct symbol_row *old, const char *const text[SYMBOL_FIELDS])
{
	char *what = changes(old, flags, text), *why = NULL;

	if (old && !*what)
		tell(import->plan, CSV_SAME, line, name, what);
	else if (symbol_batch_put(import->plan->batch, table, old ? old->index : -1,
				  (uint16_t)flags, text, &why))
		tell(import->plan, old ? CSV_CHANGE : CSV_ADD, line, name, what);
	else {
		tell(import->plan, CSV_REFUSE, line, name, why);
		g_free(what);
	}
}

static bool is_seen(struct import *import, const char *key, int line, const char *name)
{
	const int before = GPOINTER_TO_INT(g_hash_table_lookup(import->seen, key));

	if (!before) {
		g_hash_table_insert(import->seen, g_strdup(key), GINT_TO_POINTER(line));
		return false;
	}
	tell(import->plan, CSV_REFUSE, line, g_strdup(name),
	     g_strdup_printf(_("It stands in line %d already"), before));
	return true;
}

/* What the symbol is to be. @text: caller frees the comment. */
static void read_fields(const struct import *import, const struct symbol_row *old,
			char *const *field, int count, const char *text[SYMBOL_FIELDS])
{
	for (int i = 0; i < SYMBOL_FIELDS; i++) {
		text[i] = cell(import, i, field, count);
		if (!text[i])
			text[i] = old ? old->text[i] : "";
		else if (i == FIELD_RETAIN || i == FIELD_CONSTANT)
			text[i] = yes_or_no(text[i]);
	}
	if (old)
		text[FIELD_NAME] = old->text[FIELD_NAME];
	text[FIELD_COMMENT] = symbol_text_comment(text[FIELD_COMMENT]);
}

static void import_symbol(struct import *import, int line, char *full, int table, int flags,
			  const struct symbol_row *old, char *const *field, int count)
{
	const char *text[SYMBOL_FIELDS];

	read_fields(import, old, field, count, text);
	put(import, line, full, table, flags, old, text);
	g_free((gpointer)text[FIELD_COMMENT]);
}

/* "" for what is not there. */
static const char *cell_or_none(const struct import *import, int column,
				char *const *field, int count)
{
	const char *text = cell(import, column, field, count);

	return text ? text : "";
}

static void import_record(struct import *import, int line, char *const *field, int count)
{
	struct project *project = ladder_document_project(import->plan->document);
	const char *scope = cell_or_none(import, COLUMN_SCOPE, field, count);
	const char *block = cell_or_none(import, COLUMN_BLOCK, field, count);
	const char *name = cell(import, FIELD_NAME, field, count);
	const int table = table_of(project, scope);
	const int flags = flags_of(block, table > project->pou_count);
	char *full = *scope ? g_strconcat(scope, ".", name, NULL) : g_strdup(name);
	char *key = key_of(scope, name);
	const struct symbol_row *old = g_hash_table_lookup(import->row, key);

	if (table < 0)
		tell(import->plan, CSV_REFUSE, line, full, g_strdup_printf(
			_("There is no program or structure “%s”"), scope));
	else if (flags < 0)
		tell(import->plan, CSV_REFUSE, line, full, g_strdup_printf("%s: %s",
			_(diag_text(DIAG_MISPLACED)), block));
	else if (is_seen(import, key, line, full))
		g_free(full);
	else if (old && old->included)
		tell(import->plan, CSV_REFUSE, line, full,
		     g_strdup(_("It is declared in another file")));
	else
		import_symbol(import, line, full, table, *block || !old ? flags :
			      old->flags & KIND_FLAGS, old, field, count);
	g_free(key);
}

static bool take_record(void *context, int line, char *const *field, int count)
{
	struct import *import = context;

	if (!import->has_header)
		return read_header(import, line, field, count);
	import_record(import, line, field, count);
	return true;
}

/* ---- the plan ---- */

static void find_rows(struct import *import)
{
	import->row = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	import->seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	for (int i = 0; i < import->symbols->count; i++) {
		struct symbol_row *symbol = &import->symbols->symbol[i];

		g_hash_table_insert(import->row, key_of(symbol->scope,
					symbol->text[FIELD_NAME]), symbol);
	}
}

struct csv_plan *csv_plan_new(LadderDocument *document, const char *text, gsize len)
{
	struct csv_plan *plan = g_new0(struct csv_plan, 1);
	struct import import = { .plan = plan };
	const char *why = NULL;
	int line;

	plan->entry = g_ptr_array_new_with_free_func(clear_entry);
	plan->document = g_object_ref(document);
	plan->version = ladder_document_version(document);
	plan->batch = symbol_batch_new(document);
	if (!ladder_document_project(document)) {
		tell(plan, CSV_REFUSE, 0, g_strdup(""),
		     g_strdup(_("The file cannot be read as a program")));
		return plan;
	}
	import.symbols = symbols_new(document);
	find_rows(&import);
	line = csv_read(text, len, take_record, &import, &why);
	if (line)
		tell(plan, CSV_REFUSE, line, g_strdup(""), g_strdup_printf(
			_("%s; nothing from here on was read"), why));
	else if (!import.has_header)
		tell(plan, CSV_REFUSE, 1, g_strdup(""), g_strdup(_("The table is empty")));
	g_hash_table_unref(import.row);
	g_hash_table_unref(import.seen);
	symbols_free(import.symbols);
	if (plan->counts[CSV_ADD] || plan->counts[CSV_CHANGE])
		csv_plan_check(plan);
	return plan;
}

void csv_plan_free(struct csv_plan *plan)
{
	if (!plan)
		return;
	symbol_batch_free(plan->batch);
	g_ptr_array_unref(plan->entry);
	g_object_unref(plan->document);
	g_free(plan);
}

bool csv_plan_apply(struct csv_plan *plan, char **why)
{
	if (plan->version != ladder_document_version(plan->document)) {
		if (why)
			*why = g_strdup(_("The program was changed meanwhile"));
		return false;
	}
	if (!plan->counts[CSV_ADD] && !plan->counts[CSV_CHANGE])
		return true;
	return symbol_batch_apply(plan->batch, _("Import symbols"), why);
}
