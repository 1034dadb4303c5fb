/* SPDX-License-Identifier: MIT
 *
 * csv - tables of symbols as text: records of fields, the table of all symbols, and the
 * plan of an import.
 *
 * An import is tried on a program in memory, which is checked as any other. Its errors are
 * reported at the lines of the table that cause them.
 */
#include "editor-gtk/document/csv.h"

#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"

#include "engine/base/name.h"
#include "engine/ladder.h"
#include "engine/xref/address_map.h"

#include <string.h>

struct reader {
	const char *at, *end;
	char separator;
	int line;
	GPtrArray *field;    /* of char *                                     */
	const char *why;
};

static bool fail(struct reader *reader, const char *why)
{
	reader->why = why;
	return false;
}

/* The separator: the candidate that the first line has most of. */
static char find_separator(const char *text, const char *end)
{
	static const char candidates[] = ",;\t";
	int count[3] = { 0 }, best = 0;
	bool quoted = false;

	for (; text < end && (quoted || (*text != '\n' && *text != '\r')); text++) {
		const char *found = *text ? strchr(candidates, *text) : NULL;

		if (*text == '"')
			quoted = !quoted;
		else if (found && !quoted)
			count[found - candidates]++;
	}
	for (int i = 1; i < 3; i++)
		best = count[i] > count[best] ? i : best;
	return candidates[best];
}

/* Skips one line end; false: there is none here. */
static bool skip_newline(struct reader *reader)
{
	if (reader->at == reader->end || (*reader->at != '\n' && *reader->at != '\r'))
		return false;
	if (*reader->at == '\r' && reader->at + 1 < reader->end && reader->at[1] == '\n')
		reader->at++;
	reader->at++;
	reader->line++;
	return true;
}

/* Fails at the line where the field begins. */
static bool fail_at(struct reader *reader, int line, const char *why)
{
	reader->line = line;
	return fail(reader, why);
}

/* Called after the opening quote. */
static bool read_quoted(struct reader *reader, GString *out)
{
	const int first = reader->line;

	for (;;) {
		const char *at = reader->at;

		if (at == reader->end)
			return fail_at(reader, first, N_("a quoted field does not end"));
		if (*at == '"') {
			reader->at++;
			if (reader->at == reader->end || *reader->at != '"')
				return true;
			at++;
		}
		reader->line += *at == '\n' ||
				(*at == '\r' && (at + 1 == reader->end || at[1] != '\n'));
		g_string_append_c(out, *at);
		reader->at = at + 1;
		if (out->len > CSV_FIELD_MOST)
			return fail_at(reader, first, N_("a field is too long"));
	}
}

static bool is_end(const struct reader *reader)
{
	return reader->at == reader->end || *reader->at == reader->separator ||
	       *reader->at == '\n' || *reader->at == '\r';
}

static bool read_field(struct reader *reader)
{
	GString *out = g_string_new("");
	bool good = true;

	if (reader->at < reader->end && *reader->at == '"') {
		reader->at++;
		good = read_quoted(reader, out);
		if (good && !is_end(reader))
			good = fail(reader, N_("text after a quoted field"));
	} else {
		while (!is_end(reader) && out->len <= CSV_FIELD_MOST)
			g_string_append_c(out, *reader->at++);
		if (out->len > CSV_FIELD_MOST)
			good = fail(reader, N_("a field is too long"));
	}
	g_ptr_array_add(reader->field, g_string_free(out, FALSE));
	if (good && reader->field->len > CSV_COLUMNS_MOST)
		good = fail(reader, N_("too many columns"));
	return good;
}

static bool read_record(struct reader *reader)
{
	g_ptr_array_set_size(reader->field, 0);
	for (;;) {
		if (!read_field(reader))
			return false;
		if (reader->at == reader->end || *reader->at != reader->separator)
			return true;
		reader->at++;
	}
}

/* Line of the first byte that is not UTF-8, or NUL; 0: none. */
static int bad_byte(const char *text, gsize len)
{
	const char *bad;
	int line = 1;

	if (g_utf8_validate(text, (gssize)len, &bad))
		return 0;
	for (; text < bad; text++)
		line += *text == '\n';
	return line;
}

int csv_read(const char *text, gsize len,
	     bool (*take)(void *context, int line, char *const *field, int count),
	     void *context, const char **why)
{
	struct reader reader = { text, text + len, ',', 1, NULL, NULL };
	int bad = bad_byte(text, len), rows = 0;
	bool more = true;

	*why = _("this is not UTF-8 text");
	if (bad)
		return bad;
	if (len >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
		reader.at += 3;
	reader.separator = find_separator(reader.at, reader.end);
	reader.field = g_ptr_array_new_with_free_func(g_free);
	while (more && reader.at < reader.end) {
		const int line = reader.line;

		if (skip_newline(&reader))
			continue;
		more = ++rows <= CSV_ROWS_MOST ? read_record(&reader) :
		       fail(&reader, N_("too many rows"));
		more = more && take(context, line, (char *const *)reader.field->pdata,
				    (int)reader.field->len);
		skip_newline(&reader);
	}
	g_ptr_array_unref(reader.field);
	*why = reader.why ? _(reader.why) : NULL;
	return reader.why ? reader.line : 0;
}

/* ---- writing ---- */

static void write_field(GString *out, const char *text)
{
	if (!text[strcspn(text, ",;\t\"\r\n")] && *text != ' ') {
		g_string_append(out, text);
		return;
	}
	g_string_append_c(out, '"');
	for (; *text; text++) {
		if (*text == '"')
			g_string_append_c(out, '"');
		g_string_append_c(out, *text);
	}
	g_string_append_c(out, '"');
}

static void write_row(GString *out, const struct symbol_row *symbol)
{
	write_field(out, symbol->scope);
	g_string_append_c(out, ',');
	write_field(out, symbol->member ? "STRUCT" :
			vars_head((uint16_t)(symbol->flags & ~VAR_GLOBAL_WORD)));
	for (int i = 0; i < SYMBOL_FIELDS; i++) {
		g_string_append_c(out, ',');
		write_field(out, symbol->text[i]);
	}
	g_string_append(out, "\r\n");
}

char *csv_export(LadderDocument *document, int *count)
{
	struct symbols *symbols = symbols_new(document);
	GString *out = g_string_new("Scope,Block,Name,Type,Address,Initial value,Retain,"
				    "Constant,Comment\r\n");

	*count = 0;
	for (int i = 0; i < symbols->count; i++)
		if (!symbols->symbol[i].included) {
			write_row(out, &symbols->symbol[i]);
			++*count;
		}
	symbols_free(symbols);
	return g_string_free(out, FALSE);
}

#define CLASHES_MOST 5000

/* The entries that would change something, and the program they would make. */
struct checked {
	struct csv_plan *plan;
	struct xref xref;    /* of the changed program                        */
	GHashTable *name;    /* "Main.Delay", folded: struct csv_entry *      */
	GHashTable *line;    /* line of the declaration: struct csv_entry *   */
};

/* Only the first fault of an entry is kept. @text: taken over. */
static void mark(struct checked *checked, struct csv_entry *entry, bool warning, char *text)
{
	if (entry->fault) {
		g_free(text);
		return;
	}
	entry->fault = text;
	entry->warning = warning;
	checked->plan->faults++;
}

static struct csv_entry *entry_of(const struct checked *checked, const struct xref_use *use)
{
	char name[2 * LIMIT_NAME + 8], *key;
	struct csv_entry *entry;

	if (use->target.what != XREF_VARIABLE)
		return NULL;
	xref_name(checked->xref.project, &use->target, use, name, sizeof(name));
	key = name_fold(name);
	entry = g_hash_table_lookup(checked->name, key);
	g_free(key);
	return entry;
}

static void find_entries(struct checked *checked)
{
	const struct csv_plan *plan = checked->plan;

	for (guint i = 0; i < plan->entry->len; i++) {
		struct csv_entry *entry = plan->entry->pdata[i];

		if (entry->action == CSV_ADD || entry->action == CSV_CHANGE)
			g_hash_table_insert(checked->name, name_fold(entry->name),
					    entry);
	}
	for (int i = 0; i < checked->xref.count; i++) {
		const struct xref_use *use = &checked->xref.use[i];
		struct csv_entry *entry = use->kind == XREF_DECLARED && !use->included ?
			entry_of(checked, use) : NULL;

		if (entry)
			g_hash_table_insert(checked->line, GINT_TO_POINTER(use->line), entry);
	}
}

static void mark_errors(struct checked *checked, const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		struct csv_entry *entry = diag->rung ? NULL :
			g_hash_table_lookup(checked->line, GINT_TO_POINTER(diag->line));

		if (entry && diag_severity(diag->id) == SEVERITY_ERROR)
			mark(checked, entry, false, diag_said_whole(diag));
	}
}

static void mark_clash(struct checked *checked, const struct xref_use *use,
		       const struct xref_use *other)
{
	struct csv_entry *entry = entry_of(checked, use);
	char name[2 * LIMIT_NAME + 8];

	if (!entry)
		return;
	xref_name(checked->xref.project, &other->target, other, name, sizeof(name));
	mark(checked, entry, true, g_strdup_printf(_("also used as %s"), name));
}

static void mark_clashes(struct checked *checked)
{
	struct address_clash *clash = g_new(struct address_clash, CLASHES_MOST);
	const int count = address_map_clashes(&checked->xref, clash, CLASHES_MOST);

	for (int i = 0; i < MIN(count, CLASHES_MOST); i++) {
		const struct xref_use *a = &checked->xref.use[clash[i].a];
		const struct xref_use *b = &checked->xref.use[clash[i].b];

		mark_clash(checked, a, b);
		mark_clash(checked, b, a);
	}
	g_free(clash);
}

/* ---- where they are used ---- */

static bool is_same(const struct diag *a, const struct diag *b)
{
	return a->id == b->id && a->rung == b->rung && a->row == b->row && a->col == b->col &&
	       g_strcmp0(a->pou, b->pou) == 0 && strcmp(a->arg, b->arg) == 0;
}

/* Counts the diagnostics among the first @count that are equal to @diag. */
static int count_same(const struct diag_list *diags, int count, const struct diag *diag)
{
	int same = 0;

	for (int i = 0; i < count; i++)
		same += is_same(&diags->diag[i], diag);
	return same;
}

static bool is_letter(char c)
{
	return g_ascii_isalnum(c) || c == '_' || (guchar)c >= 0x80;
}

/* Does the argument of @diag begin with the name used at @use? */
static bool speaks_of(const struct checked *checked, const struct diag *diag,
		      const struct xref_use *use)
{
	const char *name = xref_text(&checked->xref, use) + use->at;
	const gsize most = strlen(diag->arg);

	for (gsize len = 1; len <= most; len++)
		if (!is_letter(diag->arg[len]) && name_same(name, use->len, diag->arg, len))
			return true;
	return false;
}

enum near { ELSEWHERE, SAME_LINE, SAME_CELL, SAME_NAME };

static enum near nearness(const struct checked *checked, const struct diag *diag,
			  const struct xref_use *use)
{
	const struct project *project = checked->xref.project;
	const char *pou = use->pou < 0 ? NULL :
		project_text(project, project->pou[use->pou].name);

	if (use->kind == XREF_DECLARED || g_strcmp0(pou, diag->pou) != 0)
		return ELSEWHERE;
	if (diag->rung ? use->rung != diag->rung : use->line != diag->line)
		return ELSEWHERE;
	if (speaks_of(checked, diag, use))
		return SAME_NAME;
	return diag->row && use->row == diag->row && use->col == diag->col ? SAME_CELL :
	       SAME_LINE;
}

/* Marks the symbol that the error names, else those in its cell, else those in its rung or
 * line. */
static void mark_uses(struct checked *checked, const struct diag *diag)
{
	const struct xref *xref = &checked->xref;
	enum near nearest = ELSEWHERE;

	for (int i = 0; i < xref->count; i++) {
		const enum near near = nearness(checked, diag, &xref->use[i]);

		if (near > nearest && entry_of(checked, &xref->use[i]))
			nearest = near;
	}
	for (int i = 0; nearest && i < xref->count; i++) {
		struct csv_entry *entry = nearness(checked, diag, &xref->use[i]) == nearest ?
			entry_of(checked, &xref->use[i]) : NULL;

		if (entry)
			mark(checked, entry, false, diag_said_whole(diag));
	}
}

/* Marks entries with the new errors that they cause where the program uses them. */
static void mark_used(struct checked *checked, const struct diag_list *diags)
{
	struct symbol_batch *nothing = symbol_batch_new(checked->plan->document);
	struct ladder *before = symbol_batch_try(nothing, NULL);
	const struct diag_list *old = before ? ladder_diags(before) : NULL;

	for (int i = 0; old && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag_severity(diag->id) == SEVERITY_ERROR &&
		    count_same(diags, i, diag) >= count_same(old, old->count, diag))
			mark_uses(checked, diag);
	}
	ladder_free(before);
	symbol_batch_free(nothing);
}

/* ---- the check ---- */

/* For an error that no line of the table causes: refuses every entry. */
static void refuse_all(struct csv_plan *plan, const char *why)
{
	for (guint i = 0; i < plan->entry->len; i++) {
		struct csv_entry *entry = plan->entry->pdata[i];

		if (entry->action != CSV_ADD && entry->action != CSV_CHANGE)
			continue;
		plan->counts[entry->action]--;
		plan->counts[CSV_REFUSE]++;
		entry->action = CSV_REFUSE;
		g_free(entry->text);
		entry->text = g_strdup(why);
	}
}

static void check_plan(struct csv_plan *plan)
{
	struct checked checked = { .plan = plan };
	char *why = NULL;
	struct ladder *ladder = symbol_batch_try(plan->batch, &why);

	if (!ladder) {
		refuse_all(plan, why);
		g_free(why);
		return;
	}
	if (!xref_make(&checked.xref, ladder_project(ladder)))
		g_error("out of memory");
	checked.name = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	checked.line = g_hash_table_new(NULL, NULL);
	find_entries(&checked);
	mark_errors(&checked, ladder_diags(ladder));
	if (ladder_diags(ladder)->errors)
		mark_used(&checked, ladder_diags(ladder));
	mark_clashes(&checked);
	g_hash_table_unref(checked.name);
	g_hash_table_unref(checked.line);
	xref_free(&checked.xref);
	ladder_free(ladder);
}

/* Headings of columns are found in any case. */
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
	GHashTable *seen;    /* "scope.name", folded: its line in the table   */
	int column[COLUMNS]; /* -1: the table has no such column              */
	bool has_header;
};

static char *key_of(const char *scope, const char *name)
{
	char *text = g_strconcat(scope, ".", name, NULL), *key;

	key = name_fold(text);
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

/* "": the record is too short; NULL: there is no such column. */
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

/* -1: there is no such scope. */
static int table_of(struct project *project, const char *scope)
{
	const int pou = project_find_pou(project, scope, strlen(scope));

	if (!*scope)
		return 0;
	if (pou >= 0)
		return pou + 1;
	for (int i = 0; i < project->structure_count; i++)
		if (name_equal(scope, project_text(project,
				project->structure[i].name)))
			return project->pou_count + 1 + i;
	return -1;
}

#define KIND_FLAGS (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP)

/* Flags for the word of a VAR block; -1: unknown, or not allowed in this table. */
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

/* "Address: %IX0.0 → %IX0.1; Comment: …"; of a new symbol all its fields. */
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
	     g_strdup_printf(_("It is already in line %d"), before));
	return true;
}

/* The fields of the symbol after the import. @text: caller frees the comment. */
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
	text[FIELD_COMMENT] = comment_text_safe(text[FIELD_COMMENT]);
}

static void import_symbol(struct import *import, int line, char *full, int table, int flags,
			  const struct symbol_row *old, char *const *field, int count)
{
	const char *text[SYMBOL_FIELDS];

	read_fields(import, old, field, count, text);
	put(import, line, full, table, flags, old, text);
	g_free((gpointer)text[FIELD_COMMENT]);
}

/* As cell(), but "" where there is no such column. */
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
		tell(import->plan, CSV_REFUSE, line, full,
		     diag_said_of(DIAG_MISPLACED, block));
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
		     g_strdup(_("The file cannot be read as a program. Correct its errors first")));
		return plan;
	}
	import.symbols = symbols_new(document);
	find_rows(&import);
	line = csv_read(text, len, take_record, &import, &why);
	if (line)
		tell(plan, CSV_REFUSE, line, g_strdup(""), g_strdup_printf(
			_("%s; the rest of the table was not read"), why));
	else if (!import.has_header)
		tell(plan, CSV_REFUSE, 1, g_strdup(""), g_strdup(_("The table is empty")));
	g_hash_table_unref(import.row);
	g_hash_table_unref(import.seen);
	symbols_free(import.symbols);
	if (plan->counts[CSV_ADD] || plan->counts[CSV_CHANGE])
		check_plan(plan);
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
			*why = g_strdup(_("The program has changed since the table was "
					  "read. Import the table again."));
		return false;
	}
	if (!plan->counts[CSV_ADD] && !plan->counts[CSV_CHANGE])
		return true;
	return symbol_batch_apply(plan->batch, _("Import symbols"), why);
}
