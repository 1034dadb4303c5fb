/* SPDX-License-Identifier: MIT
 *
 * symbols_edit - changes of declarations, as changes of the document's text.
 *
 * A declaration is written anew and first read alone, so that a bad field is told
 * exactly and nothing else can come in with it. All changes of a batch are made in the
 * one canonical text, and that becomes the document's in one step.
 */
#include "editor-gtk/document/symbols_text.h"

#include "editor-gtk/kit/i18n.h"
#include "engine/xref/xref.h"

#include <string.h>

/* A piece of the text that becomes another. */
struct piece {
	gsize at, removed;
	GString *with;
	const char *tail;    /* behind that: of a block that comes its end, so that
				more declarations can come in                  */
	int order;           /* of those at one place                         */
	int table;           /* of such a block; -1: it is none                */
	uint16_t flags;      /* likewise                                       */
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
	g_string_free(((struct piece *)piece)->with, TRUE);
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
	struct piece piece = { at, removed, g_string_new(with), "",
			       (int)batch->piece->len, -1, 0 };

	g_free(with);
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

/* ---- names ---- */

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
	if (table == 0 && project_find_pou(project, name, strlen(name)) >= 0)
		return refuse(why, g_strdup_printf(
			_("“%s” is the name of a program or block"), name));
	return true;
}

/* ---- blocks ---- */

static uint16_t wanted_flags(uint16_t flags, const char *const text[SYMBOL_FIELDS])
{
	flags &= (uint8_t)~(VAR_RETAIN | VAR_CONSTANT);
	if (*text[FIELD_RETAIN])
		flags |= VAR_RETAIN;
	if (*text[FIELD_CONSTANT])
		flags |= VAR_CONSTANT;
	return flags;
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

/* Into a block that comes with this batch; false: none does. */
static bool insert_fresh(struct symbol_batch *batch, int table, uint16_t flags,
			 const char *line)
{
	for (guint i = 0; i < batch->piece->len; i++) {
		struct piece *piece = &g_array_index(batch->piece, struct piece, i);

		if (piece->table != table || piece->flags != flags)
			continue;
		g_string_append(piece->with, line);
		return true;
	}
	return false;
}

static void insert_block(struct symbol_batch *batch, int table, uint16_t flags,
			 const char *line)
{
	struct piece *piece;
	const struct var_table *vars = xref_table(batch->project, table);
	const struct text_span *last = NULL, *body;
	char *head = symbol_text_block(flags);
	gsize at;

	for (int i = 0; i < vars->block_count; i++) {
		const struct text_span *span = find_span(batch, TEXT_BLOCK, table, i);

		last = span ? span : last;
	}
	body = table ? find_span(batch, TEXT_BODY, table, table - 1) : NULL;
	at = last ? last->at + last->len : body ? body->at : place_of_globals(batch);
	add_piece(batch, at, 0, g_strdup_printf("%s%s%s", table ? "" : "\n", head, line));
	piece = &g_array_index(batch->piece, struct piece, batch->piece->len - 1);
	piece->tail = table ? "END_VAR\n" : "END_VAR\n\n";
	piece->table = table;
	piece->flags = flags;
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
	else if (!insert_fresh(batch, table, flags, line))
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
		add_piece(batch, block->at, span->at - block->at, symbol_text_block(flags));
		add_piece(batch, span->at, span->len, g_strdup(line));
		return true;
	}
	add_piece(batch, span->at, span->len, g_strdup(""));
	return insert(batch, table, flags, line, why);
}

static bool put_line(struct symbol_batch *batch, int table, const struct symbol_row *old,
		     uint16_t flags, const char *line, char **why)
{
	const struct text_span *span = old ?
		find_span(batch, TEXT_VAR, table, old->index) : NULL;

	if (!old)
		return insert(batch, table, flags, line, why);
	if (!span)
		return refuse(why, g_strdup(_("It is declared in another file")));
	if (!old->member && flags != old->flags)
		return move(batch, table, old->index, flags, span, line, why);
	add_piece(batch, span->at, span->len, g_strdup(line));
	return true;
}

bool symbol_batch_put(struct symbol_batch *batch, int table, int index, uint16_t flags,
		      const char *const text[SYMBOL_FIELDS], char **why)
{
	const struct symbol_row *old = index < 0 ? NULL :
		symbols_at(batch->symbols, table, index);
	const uint16_t wanted = wanted_flags(flags, text);
	char *line;
	bool good;

	if (!batch->text || !xref_table(batch->project, table))
		return refuse(why, g_strdup(_("The file cannot be read as a program")));
	if ((!old || strcmp(old->text[FIELD_NAME], text[FIELD_NAME]) != 0) &&
	    !name_is_free(batch, table, index, text[FIELD_NAME], why))
		return false;
	if (table > batch->project->pou_count && *text[FIELD_ADDRESS])
		return refuse(why, g_strdup(_("A member of a structure has no address")));
	if (!*text[FIELD_TYPE])
		return refuse(why, g_strdup(_("A type is needed")));
	line = symbol_text_line(text);
	good = symbol_text_reads(batch->project, table, wanted, line, text[FIELD_NAME],
				 why) &&
	       put_line(batch, table, old, wanted, line, why);
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

/* At one place first what comes, in its order, then what goes. */
static int by_place(gconstpointer left, gconstpointer right)
{
	const struct piece *a = left, *b = right;

	if (a->at != b->at)
		return a->at < b->at ? -1 : 1;
	if (!a->removed != !b->removed)
		return a->removed ? 1 : -1;
	return a->order - b->order;
}

/* The text with all its pieces. Caller frees. */
static GString *pieced(struct symbol_batch *batch)
{
	GString *text = g_string_sized_new(batch->len);
	gsize done = 0;

	g_array_sort(batch->piece, by_place);
	for (guint i = 0; i < batch->piece->len; i++) {
		const struct piece *piece = &g_array_index(batch->piece, struct piece, i);

		g_string_append_len(text, batch->text + done, (gssize)(piece->at - done));
		g_string_append_len(text, piece->with->str, (gssize)piece->with->len);
		g_string_append(text, piece->tail);
		done = piece->at + piece->removed;
	}
	return g_string_append_len(text, batch->text + done, (gssize)(batch->len - done));
}

struct ladder *symbol_batch_try(struct symbol_batch *batch, char **why)
{
	const char *path = ladder_document_path(batch->document);
	struct ladder *ladder = ladder_new();
	GString *text = pieced(batch);

	if (!ladder)
		g_error("out of memory");
	if (!ladder_load_text(ladder, path ? path : "", text->str, text->len)) {
		refuse(why, symbol_text_reason(ladder_diags(ladder)));
		g_clear_pointer(&ladder, ladder_free);
	}
	if (ladder)
		ladder_build(ladder);
	g_string_free(text, TRUE);
	return ladder;
}

bool symbol_batch_apply(struct symbol_batch *batch, const char *step, char **why)
{
	GString *text = pieced(batch);
	struct diag_list *diags = g_new0(struct diag_list, 1);
	bool good;

	ladder_document_begin(batch->document, step, NULL);
	good = ladder_document_replace(batch->document, 0, batch->len, text->str, diags);
	ladder_document_end(batch->document);
	if (!good)
		refuse(why, symbol_text_reason(diags));
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
		refuse(why, symbol_text_reason(diags));
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
	return symbol_batch_put(batch, symbol->table, symbol->index, symbol->flags,
				fields, why) &&
	       symbol_batch_apply(batch, step_name(field), why);
}

/* Is it there, and of this file? */
static bool may_change(const struct symbol_row *symbol, char **why)
{
	if (!symbol)
		return refuse(why, g_strdup(_("There is no such symbol")));
	return !symbol->included ||
	       refuse(why, g_strdup(_("It is declared in another file")));
}

bool symbol_set(LadderDocument *document, int table, int index, enum field field,
		const char *text, char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	const struct symbol_row *symbol = symbols_at(batch->symbols, table, index);
	char *clean = g_strstrip(g_strdup(text));
	bool good;

	if (!may_change(symbol, why))
		good = false;
	else if (strcmp(symbol->text[field], clean) == 0)
		good = true;
	else if (field == FIELD_COMMENT && (strstr(clean, "(*") || strstr(clean, "*)")))
		good = refuse(why, g_strdup(_("a comment holds no (* and no *)")));
	else if (field == FIELD_NAME && symbol->uses > 0)
		good = rename_everywhere(document, table, index, clean, why);
	else
		good = set_field(batch, symbol, field, clean, why);
	g_free(clean);
	symbol_batch_free(batch);
	return good;
}

bool symbol_set_kind(LadderDocument *document, int table, int index, uint16_t kind,
		     char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	const struct symbol_row *symbol = symbols_at(batch->symbols, table, index);
	bool good = may_change(symbol, why);

	if (good && (symbol->flags & SYMBOL_KINDS) != kind)
		good = symbol_batch_put(batch, table, index,
				(uint16_t)((symbol->flags & ~SYMBOL_KINDS) | kind),
				(const char *const *)symbol->text, why) &&
		       symbol_batch_apply(batch, _("Change kind"), why);
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
