/* SPDX-License-Identifier: MIT
 *
 * symbols_edit - changes of declarations, as changes of the document's text.
 *
 * A declaration is written anew and first read alone, so that a bad field is told
 * exactly and nothing else can come in with it. All changes of a batch are made in the
 * one canonical text, and that becomes the document's in one step.
 */
#include "editor-gtk/symbols.h"

#include "editor-gtk/diag_said.h"
#include "editor-gtk/i18n.h"
#include "engine/view/xref.h"

#include <string.h>

/* A piece of the text that becomes another. */
struct piece {
	gsize at, removed;
	char *with;
	int order;           /* of those at one place                         */
};

struct symbol_batch {
	LadderDocument *document;
	struct project *project;
	struct symbols *symbols;
	char *text;
	gsize len;
	GArray *span;        /* of struct text_span                           */
	GArray *piece;       /* of struct piece                               */
	GHashTable *turned;  /* spans of blocks that got another head         */
};

static bool refuse(char **why, char *text)
{
	if (why)
		*why = text;
	else
		g_free(text);
	return false;
}

/* ---- the text and its parts ---- */

static void take_span(void *context, const struct text_span *span)
{
	g_array_append_val((GArray *)context, *span);
}

static void clear_piece(gpointer piece)
{
	g_free(((struct piece *)piece)->with);
}

struct symbol_batch *symbol_batch_new(LadderDocument *document)
{
	struct symbol_batch *batch = g_new0(struct symbol_batch, 1);

	batch->document = document;
	batch->project = ladder_document_project(document);
	batch->symbols = symbols_new(document);
	batch->span = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	batch->piece = g_array_new(FALSE, FALSE, sizeof(struct piece));
	g_array_set_clear_func(batch->piece, clear_piece);
	batch->turned = g_hash_table_new(NULL, NULL);
	if (batch->project)
		batch->text = ladder_document_outline(document, &batch->len, take_span,
						      batch->span);
	return batch;
}

void symbol_batch_free(struct symbol_batch *batch)
{
	symbols_free(batch->symbols);
	g_array_unref(batch->span);
	g_array_unref(batch->piece);
	g_hash_table_unref(batch->turned);
	g_free(batch->text);
	g_free(batch);
}

static void add_piece(struct symbol_batch *batch, gsize at, gsize removed, char *with)
{
	struct piece piece = { at, removed, with, (int)batch->piece->len };

	g_array_append_val(batch->piece, piece);
}

/* The part of this kind and number in a table; NULL: none. */
static const struct text_span *find_span(const struct symbol_batch *batch,
					 enum text_part part, int table, int number)
{
	const int pous = batch->project->pou_count;
	const int pou = table >= 1 && table <= pous ? table - 1 : -1;
	const int structure = table > pous ? table - pous - 1 : -1;

	for (guint i = 0; i < batch->span->len; i++) {
		const struct text_span *span = &g_array_index(batch->span,
							      struct text_span, i);

		if (span->part == part && span->number == number && span->pou == pou &&
		    span->structure == structure)
			return span;
	}
	return NULL;
}

/* ---- a declaration as text ---- */

static bool is_set(const char *text)
{
	return text && *text;
}

/* So that it ends where it should, on one line. */
static char *comment_of(const char *text)
{
	GString *out = g_string_new("(* ");

	for (const char *at = text; *at; at++) {
		if ((at[0] == '*' && at[1] == ')') || (at[0] == '(' && at[1] == '*')) {
			g_string_append_c(out, *at);
			g_string_append_c(out, ' ');
		} else if (*at == '\n' || *at == '\r' || *at == '\t') {
			g_string_append_c(out, ' ');
		} else {
			g_string_append_c(out, *at);
		}
	}
	g_string_append(out, " *)");
	return g_string_free(out, FALSE);
}

static char *declaration(const char *const text[SYMBOL_FIELDS])
{
	GString *out = g_string_new("  ");

	g_string_append(out, text[FIELD_NAME]);
	if (is_set(text[FIELD_ADDRESS]))
		g_string_append_printf(out, " AT %s", text[FIELD_ADDRESS]);
	g_string_append_printf(out, " : %s", text[FIELD_TYPE]);
	if (is_set(text[FIELD_INITIAL]))
		g_string_append_printf(out, " := %s", text[FIELD_INITIAL]);
	g_string_append(out, ";");
	if (is_set(text[FIELD_COMMENT])) {
		char *comment = comment_of(text[FIELD_COMMENT]);

		g_string_append_printf(out, " %s", comment);
		g_free(comment);
	}
	g_string_append(out, "\n");
	return g_string_free(out, FALSE);
}

static char *diag_reason(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag_severity(diag->id) == SEVERITY_ERROR)
			return diag_said_whole(diag);
	}
	return g_strdup(_("It cannot be read"));
}

/* Stand-ins for the words of the project, so that a type is known. */
static void add_words(GString *out, const struct project *project)
{
	for (int i = 0; i < project->structure_count; i++)
		g_string_append_printf(out, "TYPE\n  %s : STRUCT\n    X : INT;\n"
			"  END_STRUCT;\nEND_TYPE\n",
			project_text(project, project->structure[i].name));
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_BLOCK)
			g_string_append_printf(out, "FUNCTION_BLOCK %s LD\n"
				"END_FUNCTION_BLOCK\n",
				project_text(project, project->pou[i].name));
}

/* Is it one declaration, of this name, and nothing else? */
static bool reads_alone(struct symbol_batch *batch, const char *line, const char *name,
			char **why)
{
	GString *text = g_string_new("RUNGBOARD 1\n");
	struct ladder *ladder = ladder_new();
	const struct project *project;
	bool good;

	if (!ladder)
		g_error("out of memory");
	add_words(text, batch->project);
	g_string_append_printf(text, "VAR\n%sEND_VAR\n", line);
	good = ladder_load_text(ladder, "", text->str, text->len);
	project = ladder_project(ladder);
	if (!good || !project)
		refuse(why, diag_reason(ladder_diags(ladder)));
	else if (project->globals.count != 1 || project->globals.block_count != 1 ||
		 strcmp(project_text(project, project->globals.var[0].name), name) != 0)
		good = refuse(why, g_strdup(_("It cannot be read")));
	ladder_free(ladder);
	g_string_free(text, TRUE);
	return good;
}

static char *name_reason(enum diag_id fault, const char *name)
{
	if (fault == DIAG_EXPECTED)
		return g_strdup_printf(_("“%s” is not a name"), name);
	return g_strdup_printf("%s: %s", _(diag_text(fault)), name);
}

/* Does the program say this name and mean an address? It would mean the symbol then. */
static bool is_used_address(struct symbol_batch *batch, const char *name)
{
	struct xref xref;
	bool found = false;

	if (!xref_make(&xref, batch->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count && !found; i++) {
		const struct xref_use *use = &xref.use[i];

		found = use->target.what == XREF_ADDRESS && use->len == strlen(name) &&
			g_ascii_strncasecmp(xref_text(&xref, use) + use->at, name,
					    use->len) == 0;
	}
	xref_free(&xref);
	return found;
}

/* @index: of the one that has it and may; -1: none. */
static bool name_is_free(struct symbol_batch *batch, int table, int index,
			 const char *name, char **why)
{
	struct project *project = batch->project;
	const struct var_table *vars = xref_table(project, table);
	const enum diag_id fault = ladder_name_fault(name);

	if (fault == DIAG_SHADOWS_ADDRESS && is_used_address(batch, name))
		return refuse(why, g_strdup_printf(
			_("“%s” is used as an address"), name));
	if (fault != DIAG_COUNT && fault != DIAG_SHADOWS_ADDRESS)
		return refuse(why, name_reason(fault, name));
	for (int i = 0; i < vars->count; i++)
		if (i != index && g_ascii_strcasecmp(name,
				project_text(project, vars->var[i].name)) == 0)
			return refuse(why, g_strdup_printf(
				_("“%s” is declared already"), name));
	for (int i = 0; table == 0 && i < project->pou_count; i++)
		if (g_ascii_strcasecmp(name, project_text(project,
				project->pou[i].name)) == 0)
			return refuse(why, g_strdup_printf(
				_("“%s” is the name of a program or block"), name));
	return true;
}

/* ---- blocks ---- */

static uint16_t wanted_flags(uint16_t flags, const char *const text[SYMBOL_FIELDS])
{
	flags &= (uint8_t)~(VAR_RETAIN | VAR_CONSTANT);
	if (is_set(text[FIELD_RETAIN]))
		flags |= VAR_RETAIN;
	if (is_set(text[FIELD_CONSTANT]))
		flags |= VAR_CONSTANT;
	return flags;
}

static char *block_head(uint16_t flags)
{
	return g_strdup_printf("%s%s%s\n", vars_head(flags),
			       flags & VAR_RETAIN ? " RETAIN" : "",
			       flags & VAR_CONSTANT ? " CONSTANT" : "");
}

/* Of the last block with these flags, that stands in this file; NULL: none. */
static const struct text_span *find_block(const struct symbol_batch *batch, int table,
					  uint16_t flags)
{
	const struct var_table *vars = xref_table(batch->project, table);
	const uint8_t same = (uint8_t)~VAR_GLOBAL_WORD;

	for (int i = vars->block_count - 1; i >= 0; i--) {
		const struct text_span *span = find_span(batch, TEXT_BLOCK, table, i);

		if (span && (vars->block[i].flags & same) == (flags & same) &&
		    !g_hash_table_contains(batch->turned, GINT_TO_POINTER(span->at)))
			return span;
	}
	return NULL;
}

/* Where a block of globals would stand: before the first POU. */
static gsize place_of_globals(const struct symbol_batch *batch)
{
	const struct project *project = batch->project;

	for (guint i = 0; i < batch->span->len; i++) {
		const struct text_span *span = &g_array_index(batch->span,
							      struct text_span, i);

		if (span->part == TEXT_PART &&
		    project->part[span->number].kind == PART_POU)
			return span->at;
	}
	return batch->len;
}

static void insert_block(struct symbol_batch *batch, int table, uint16_t flags,
			 const char *line)
{
	const struct var_table *vars = xref_table(batch->project, table);
	const struct text_span *last = NULL, *body;
	char *head = block_head(flags);
	gsize at;

	for (int i = 0; i < vars->block_count; i++) {
		const struct text_span *span = find_span(batch, TEXT_BLOCK, table, i);

		last = span ? span : last;
	}
	body = table ? find_span(batch, TEXT_BODY, table, table - 1) : NULL;
	at = last ? last->at + last->len : body ? body->at : place_of_globals(batch);
	add_piece(batch, at, 0, g_strdup_printf("%s%s%sEND_VAR\n%s",
		table ? "" : "\n", head, line, table ? "" : "\n"));
	g_free(head);
}

static bool insert_member(struct symbol_batch *batch, int table, const char *line)
{
	const struct var_table *vars = xref_table(batch->project, table);
	const struct text_span *last = find_span(batch, TEXT_VAR, table, vars->count - 1);

	if (last)
		add_piece(batch, last->at + last->len, 0, g_strdup(line));
	return last;
}

static bool insert(struct symbol_batch *batch, int table, uint16_t flags, const char *line,
		   char **why)
{
	const struct text_span *block;

	if (table > batch->project->pou_count)
		return insert_member(batch, table, line) ? true :
		       refuse(why, g_strdup(_("The structure is in another file")));
	if (table > 0 && batch->project->pou[table - 1].included)
		return refuse(why, g_strdup(_("It is declared in another file")));
	block = find_block(batch, table, flags);
	if (block)
		add_piece(batch, block->at + block->len - strlen("END_VAR\n"), 0,
			  g_strdup(line));
	else
		insert_block(batch, table, flags, line);
	return true;
}

/* ---- batches ---- */

/* Of the block that variable @index stands in. */
static int block_of(const struct var_table *vars, int index)
{
	for (int i = 0; i < vars->block_count; i++)
		if (index >= vars->block[i].first &&
		    index < vars->block[i].first + vars->block[i].count)
			return i;
	return -1;
}

/* It leaves its block, or the block, if it has no other one, gets another head. */
static bool move(struct symbol_batch *batch, int table, int index, uint16_t flags,
		 const struct text_span *span, const char *line, char **why)
{
	const struct var_table *vars = xref_table(batch->project, table);
	const int number = block_of(vars, index);
	const struct text_span *block = find_span(batch, TEXT_BLOCK, table, number);

	if (block && vars->block[number].count == 1) {
		g_hash_table_add(batch->turned, GINT_TO_POINTER(block->at));
		add_piece(batch, block->at, span->at - block->at, block_head(flags));
		add_piece(batch, span->at, span->len, g_strdup(line));
		return true;
	}
	add_piece(batch, span->at, span->len, g_strdup(""));
	return insert(batch, table, flags, line, why);
}

static bool put_line(struct symbol_batch *batch, int table, int index, uint16_t flags,
		     const char *const text[SYMBOL_FIELDS], const char *line, char **why)
{
	const struct symbol_row *old = index < 0 ? NULL :
		symbols_at(batch->symbols, table, index);
	const struct text_span *span = old ?
		find_span(batch, TEXT_VAR, table, index) : NULL;
	uint16_t wanted = wanted_flags(old ? old->flags : flags, text);

	if (index < 0)
		return insert(batch, table, wanted, line, why);
	if (!span)
		return refuse(why, g_strdup(_("It is declared in another file")));
	if (!old->member && wanted != old->flags)
		return move(batch, table, index, wanted, span, line, why);
	add_piece(batch, span->at, span->len, g_strdup(line));
	return true;
}

bool symbol_batch_put(struct symbol_batch *batch, int table, int index, uint16_t flags,
		      const char *const text[SYMBOL_FIELDS], char **why)
{
	const struct symbol_row *old;
	char *line;
	bool good;

	if (!batch->text || !xref_table(batch->project, table))
		return refuse(why, g_strdup(_("The file cannot be read as a program")));
	old = index < 0 ? NULL : symbols_at(batch->symbols, table, index);
	if ((!old || strcmp(old->text[FIELD_NAME], text[FIELD_NAME]) != 0) &&
	    !name_is_free(batch, table, index, text[FIELD_NAME], why))
		return false;
	if (table > batch->project->pou_count && is_set(text[FIELD_ADDRESS]))
		return refuse(why, g_strdup(_("A member of a structure has no address")));
	if (!is_set(text[FIELD_TYPE]))
		return refuse(why, g_strdup(_("A type is needed")));
	line = declaration(text);
	good = reads_alone(batch, line, text[FIELD_NAME], why) &&
	       put_line(batch, table, index, flags, text, line, why);
	g_free(line);
	return good;
}

bool symbol_batch_delete(struct symbol_batch *batch, int table, int index, char **why)
{
	const struct text_span *span = batch->text ?
		find_span(batch, TEXT_VAR, table, index) : NULL;
	const struct var_table *vars = span ? xref_table(batch->project, table) : NULL;
	const struct text_span *block;
	int number;

	if (!span)
		return refuse(why, g_strdup(_("It is declared in another file")));
	if (table > batch->project->pou_count && vars->count == 1)
		return refuse(why, g_strdup(_("A structure needs a member")));
	number = block_of(vars, index);
	block = find_span(batch, TEXT_BLOCK, table, number);
	if (block && vars->block[number].count == 1 && !vars->block[number].comment)
		span = block;
	add_piece(batch, span->at, span->len, g_strdup(""));
	return true;
}

/* From the end to the beginning; at one place first what goes, then the last one that
 * comes. */
static int from_end(gconstpointer left, gconstpointer right)
{
	const struct piece *a = left, *b = right;

	if (a->at != b->at)
		return a->at > b->at ? -1 : 1;
	if (!a->removed != !b->removed)
		return a->removed ? -1 : 1;
	return b->order - a->order;
}

bool symbol_batch_apply(struct symbol_batch *batch, const char *step, char **why)
{
	GString *text = g_string_new_len(batch->text, (gssize)batch->len);
	struct diag_list *diags = g_new0(struct diag_list, 1);
	bool good;

	g_array_sort(batch->piece, from_end);
	for (guint i = 0; i < batch->piece->len; i++) {
		const struct piece *piece = &g_array_index(batch->piece, struct piece, i);

		g_string_erase(text, (gssize)piece->at, (gssize)piece->removed);
		g_string_insert(text, (gssize)piece->at, piece->with);
	}
	ladder_document_begin(batch->document, step, NULL);
	good = ladder_document_replace(batch->document, 0, batch->len, text->str, diags);
	ladder_document_end(batch->document);
	if (!good)
		refuse(why, diag_reason(diags));
	g_free(diags);
	g_string_free(text, TRUE);
	return good;
}

/* ---- single changes ---- */

static bool rename_everywhere(LadderDocument *document, int table, int index,
			      const char *name, char **why)
{
	struct project *project = ladder_document_project(document);
	const struct xref_target target = xref_variable(project, table, index);
	struct ladder_rename how;
	struct diag_list *diags;
	gsize len, old_len;
	char *text = ladder_rename(ladder_document_ladder(document), &target, name, &len,
				   &how);
	bool good;

	if (!text)
		return refuse(why, rename_reason(document, &how, name));
	diags = g_new0(struct diag_list, 1);
	free(ladder_write(ladder_document_ladder(document), &old_len));
	ladder_document_begin(document, _("Rename symbol"), NULL);
	good = ladder_document_replace(document, 0, old_len, text, diags);
	ladder_document_end(document);
	if (!good)
		refuse(why, diag_reason(diags));
	g_free(diags);
	free(text);
	return good;
}

static const char *step_name(enum field field)
{
	static const char *const name[SYMBOL_FIELDS] = {
		[FIELD_NAME] = N_("Rename symbol"), [FIELD_TYPE] = N_("Change type"),
		[FIELD_ADDRESS] = N_("Change address"),
		[FIELD_INITIAL] = N_("Change initial value"),
		[FIELD_RETAIN] = N_("Change retain"),
		[FIELD_CONSTANT] = N_("Change constant"),
		[FIELD_COMMENT] = N_("Change comment"),
	};

	return _(name[field]);
}

static bool set_field(struct symbol_batch *batch, const struct symbol_row *symbol,
		      enum field field, const char *text, char **why)
{
	const char *fields[SYMBOL_FIELDS];

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		fields[i] = symbol->text[i];
	fields[field] = text;
	return symbol_batch_put(batch, symbol->table, symbol->index, 0, fields, why) &&
	       symbol_batch_apply(batch, step_name(field), why);
}

bool symbol_set(LadderDocument *document, int table, int index, enum field field,
		const char *text, char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	const struct symbol_row *symbol = symbols_at(batch->symbols, table, index);
	char *clean = g_strstrip(g_strdup(text));
	bool good;

	if (!symbol)
		good = refuse(why, g_strdup(_("There is no such symbol")));
	else if (symbol->included)
		good = refuse(why, g_strdup(_("It is declared in another file")));
	else if (strcmp(symbol->text[field], clean) == 0)
		good = true;
	else if (field == FIELD_NAME && symbol->uses > 0)
		good = rename_everywhere(document, table, index, clean, why);
	else
		good = set_field(batch, symbol, field, clean, why);
	g_free(clean);
	symbol_batch_free(batch);
	return good;
}

bool symbol_add(LadderDocument *document, int table, uint16_t flags,
		const char *const text[SYMBOL_FIELDS], char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	bool good = symbol_batch_put(batch, table, -1, flags, text, why) &&
		    symbol_batch_apply(batch, _("Add symbol"), why);

	symbol_batch_free(batch);
	return good;
}

bool symbol_delete(LadderDocument *document, int table, int index, char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	bool good = symbol_batch_delete(batch, table, index, why) &&
		    symbol_batch_apply(batch, _("Delete symbol"), why);

	symbol_batch_free(batch);
	return good;
}
