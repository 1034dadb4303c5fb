/* SPDX-License-Identifier: MIT
 *
 * symbols - declarations as rows, and edits of them.
 *
 * An edited declaration is first read alone, in a project of its own, so that an error is
 * exact and nothing else can be inserted with it. All changes of a batch are made in the
 * canonical text, which replaces that of the document in one step.
 */
#include "editor-gtk/document/symbols.h"

#include "editor-gtk/draw/listing.h"
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/document/rename.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/xref/address_map.h"
#include "engine/xref/xref.h"

#include <string.h>

static const char *const field_names[SYMBOL_FIELDS] = {
	[FIELD_NAME] = N_("Name"), [FIELD_TYPE] = N_("Type"),
	[FIELD_ADDRESS] = N_("Address"), [FIELD_INITIAL] = N_("Initial value"),
	[FIELD_RETAIN] = N_("Retain"), [FIELD_CONSTANT] = N_("Constant"),
	[FIELD_COMMENT] = N_("Comment"),
};

const char *symbol_field_name(enum field field)
{
	return _(field_names[field]);
}

/* ---- the fields ---- */

char *symbol_initial(const struct project *project, const struct var *var)
{
	char text[64];

	if (!var->has_init || var->inherits)
		return g_strdup("");
	if (var->init_text)
		return g_strdup(project_text(project, var->init_text));
	literal_print(var->type, var->init, text, sizeof(text));
	return g_strdup(text);
}

static char *scope_name(const struct project *project, int table)
{
	const int type = table - project->pou_count - 1;

	if (table == 0)
		return g_strdup("");
	return g_strdup(type < 0 ? project_text(project, project->pou[table - 1].name) :
				   type_name(project, type));
}

/* Values of globals and programs; of an instance only the pins, which have no row. */
static bool exports(const struct project *project, const struct var *var, int table)
{
	if (table > project->pou_count ||
	    (table && project->pou[table - 1].kind != POU_PROGRAM))
		return false;
	return var->type != IEC_NONE || words_row(&project->words, var->fb)->kind == WORD_STRUCT;
}

static void fill(struct symbol_row *symbol, const struct project *project,
		 const struct var_table *vars, int table, int index)
{
	const struct var *var = &vars->var[index];

	symbol->table = table;
	symbol->index = index;
	symbol->scope = scope_name(project, table);
	symbol->member = table > project->pou_count;
	symbol->flags = symbol->member ? 0 : vars_flags(vars, index);
	symbol->text[FIELD_NAME] = g_strdup(project_text(project, var->name));
	symbol->text[FIELD_TYPE] = listing_type(project, var);
	symbol->text[FIELD_ADDRESS] = g_strdup(project_text(project, var->at_text));
	symbol->text[FIELD_INITIAL] = symbol_initial(project, var);
	symbol->text[FIELD_RETAIN] = g_strdup(symbol->flags & VAR_RETAIN ? "1" : "");
	symbol->text[FIELD_CONSTANT] = g_strdup(symbol->flags & VAR_CONSTANT ? "1" : "");
	symbol->text[FIELD_COMMENT] = comment_text(project_text(project, var->comment));
	symbol->line = -1;
	symbol->exports = exports(project, var, table);
}

struct symbol_row *symbol_row_new(const struct project *project,
				  const struct var_table *vars, int table, int index)
{
	struct symbol_row *symbol = g_new0(struct symbol_row, 1);

	fill(symbol, project, vars, table, index);
	return symbol;
}

static void clear(struct symbol_row *symbol)
{
	g_free(symbol->scope);
	for (int k = 0; k < SYMBOL_FIELDS; k++)
		g_free(symbol->text[k]);
}

void symbol_row_free(struct symbol_row *symbol)
{
	clear(symbol);
	g_free(symbol);
}

/* ---- the rows ---- */

/* Index of the first row of each table; results of functions have none. */
static int add_table(struct symbols *symbols, const struct project *project,
		     const struct var_table *vars, int table)
{
	const int first = symbols->count;

	for (int i = 0; i < vars_declared(vars); i++)
		if (table > project->pou_count ||
		    !(vars_flags(vars, i) & VAR_RESULT))
			fill(&symbols->symbol[symbols->count++], project, vars, table, i);
	return first;
}

/* Rows of a table are in the order of their indices. */
static struct symbol_row *row_of(struct symbols *symbols, const int *first,
			     const struct xref_target *target)
{
	int at = first[target->table] + target->index;

	at = MIN(at, first[target->table + 1] - 1);
	while (at > first[target->table] && symbols->symbol[at].index > target->index)
		at--;
	return at >= first[target->table] && at < first[target->table + 1] &&
	       symbols->symbol[at].index == target->index ? &symbols->symbol[at] : NULL;
}

/* Is this use the whole path of a line of VAR_ACCESS? */
static void note_access(struct symbol_row *symbol, const struct project *project,
			const struct xref_use *use)
{
	const guintptr at = (guintptr)use->slot, first = (guintptr)project->access;
	const struct access *access;

	if (!use->slot || at < first || at >= (guintptr)(project->access + project->access_count))
		return;
	access = &project->access[(at - first) / sizeof(*access)];
	if (use->slot != &access->path ||
	    use->at + use->len != names_len(&project->names, access->path))
		return;
	symbol->line = (int)(access - project->access);
	symbol->foreign = use->included;
	symbol->access = access->writes ? SYMBOL_WRITE : SYMBOL_READ;
}

static void count_uses(struct symbols *symbols, struct project *project, const int *first)
{
	struct xref xref;

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		struct symbol_row *symbol = use->target.what == XREF_VARIABLE ?
			row_of(symbols, first, &use->target) : NULL;

		if (!symbol)
			continue;
		if (use->kind == XREF_DECLARED)
			symbol->included = use->included;
		else
			symbol->uses++;
		if (symbol->exports && symbol->line < 0)
			note_access(symbol, project, use);
	}
	xref_free(&xref);
}

struct symbols *symbols_new(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	struct symbols *symbols = g_new0(struct symbols, 1);
	int tables = project ? project->pou_count + project->structure_count + 1 : 0;
	int all = 0, *first = g_new0(int, (gsize)tables + 1);

	for (int i = 0; i < tables; i++)
		all += xref_table(project, i)->count;
	symbols->symbol = g_new0(struct symbol_row, (gsize)all + 1);
	for (int i = 0; i < tables; i++)
		first[i] = add_table(symbols, project, xref_table(project, i), i);
	first[tables] = symbols->count;
	if (project)
		count_uses(symbols, project, first);
	g_free(first);
	return symbols;
}

void symbols_free(struct symbols *symbols)
{
	if (!symbols)
		return;
	for (int i = 0; i < symbols->count; i++)
		clear(&symbols->symbol[i]);
	g_free(symbols->symbol);
	g_free(symbols);
}

static const struct symbol_row *row_at(const struct symbols *symbols, int table, int index)
{
	for (int i = 0; i < symbols->count; i++)
		if (symbols->symbol[i].table == table && symbols->symbol[i].index == index)
			return &symbols->symbol[i];
	return NULL;
}

/* ---- proposals ---- */

static bool has_name(struct project *project, int table, const char *name)
{
	const struct var_table *vars = xref_table(project, table);

	for (int i = 0; vars && i < vars->count; i++)
		if (name_equal(project_text(project, vars->var[i].name), name))
			return true;
	if (table == 0 && project_find_pou(project, name, strlen(name)) >= 0)
		return true;
	return ladder_name_fault(name) != DIAG_COUNT;
}

static const char *table_name(const struct project *project, int table)
{
	const int type = table - 1 - project->pou_count;

	if (table < 1 || (type >= 0 && !type_is(project, type)))
		return "";
	return type < 0 ? project_text(project, project->pou[table - 1].name) :
			  type_name(project, type);
}

char *symbol_table_name(LadderDocument *document, int table)
{
	const struct project *project = ladder_document_project(document);

	return g_strdup(project ? table_name(project, table) : "");
}

int symbol_table_find(LadderDocument *document, const char *name)
{
	const struct project *project = ladder_document_project(document);
	const int count = project ? 1 + project->pou_count + type_count(project) : 0;

	for (int table = 0; table < count; table++)
		if (name_equal(table_name(project, table), name))
			return table;
	return -1;
}

int symbol_find(LadderDocument *document, int table, const char *name, int index)
{
	struct project *project = ladder_document_project(document);
	const struct var_table *vars = project ? xref_table(project, table) : NULL;
	const int count = vars ? vars_declared(vars) : 0;

	if (index >= 0 && index < count &&
	    strcmp(project_text(project, vars->var[index].name), name) == 0)
		return index;
	for (int i = 0; i < count; i++)
		if (strcmp(project_text(project, vars->var[i].name), name) == 0)
			return i;
	return -1;
}

char *symbol_free_name(LadderDocument *document, int table, const char *like)
{
	struct project *project = ladder_document_project(document);
	char *stem = g_strdup(*like ? like : "Symbol"), *name = g_strdup(stem);
	gsize len = strlen(stem);

	while (len > 1 && g_ascii_isdigit(stem[len - 1]))
		stem[--len] = '\0';
	for (int i = 2; project && has_name(project, table, name); i++) {
		g_free(name);
		name = g_strdup_printf("%s%d", stem, i);
		if (i > LIMIT_VARS)
			break;
	}
	g_free(stem);
	return name;
}

static const char *on_address(const struct project *project, const struct var_table *vars,
			      const struct var *of)
{
	for (int i = 0; i < vars->count; i++)
		if (&vars->var[i] != of && (var_lies_on(&vars->var[i], of->at) ||
					    var_lies_on(of, vars->var[i].at)))
			return project_text(project, vars->var[i].name);
	return NULL;
}

const char *symbol_beside(LadderDocument *document, int table, int index)
{
	struct project *project = ladder_document_project(document);
	const struct var_table *vars = project ? xref_table(project, table) : NULL;
	const char *name = NULL;

	if (!vars || index < 0 || index >= vars->count)
		return NULL;
	for (int i = 0; !name && i <= project->pou_count; i++)
		name = on_address(project, xref_table(project, i), &vars->var[index]);
	return name;
}

/* ---- errors ---- */

static bool speaks_of(const struct diag *diag, const struct symbol_row *symbol)
{
	const char *pou = diag->pou ? diag->pou : "", *name = symbol->text[FIELD_NAME];
	const size_t len = (size_t)diag_name_length(diag);

	return diag->rung == 0 && strlen(name) == len && strncmp(diag->arg, name, len) == 0 &&
	       (symbol->member || strcmp(pou, symbol->scope) == 0);
}

char *symbol_error(LadderDocument *document, const struct symbol_row *symbol,
		   bool *warning)
{
	const struct diag_list *diags = ladder_document_diags(document);

	for (int i = 0; diags && i < diags->count; i++)
		if (speaks_of(&diags->diag[i], symbol)) {
			*warning = diag_severity(diags->diag[i].id) != SEVERITY_ERROR;
			return diag_said_whole(&diags->diag[i]);
		}
	return NULL;
}

static bool refuse(char **why, char *text)
{
	if (why)
		*why = text;
	else
		g_free(text);
	return false;
}

/* 5s becomes T#5s, as in an entry. Caller: g_free. */
static char *initial_of(const char *text)
{
	const gsize size = strlen(text) + sizeof("T#");
	char *out = g_malloc0(size);
	bool fits;

	if (!entry_literal(text, strlen(text), out, size, &fits))
		g_strlcpy(out, text, size);
	return out;
}

char *symbol_text_line(const char *const text[SYMBOL_FIELDS])
{
	GString *out = g_string_new("  ");
	char *comment = comment_text_safe(text[FIELD_COMMENT]), *initial;

	g_string_append(out, text[FIELD_NAME]);
	if (*text[FIELD_ADDRESS])
		g_string_append_printf(out, " AT %s", text[FIELD_ADDRESS]);
	g_string_append_printf(out, " : %s", text[FIELD_TYPE]);
	if (*text[FIELD_INITIAL]) {
		initial = initial_of(text[FIELD_INITIAL]);
		g_string_append_printf(out, " := %s", initial);
		g_free(initial);
	}
	g_string_append(out, ";");
	if (*comment)
		g_string_append_printf(out, " (* %s *)", comment);
	g_string_append(out, "\n");
	g_free(comment);
	return g_string_free(out, FALSE);
}

char *symbol_text_block(uint16_t flags)
{
	return g_strdup_printf("%s%s%s\n", vars_head(flags),
			       flags & VAR_RETAIN ? " RETAIN" : "",
			       flags & VAR_CONSTANT ? " CONSTANT" : "");
}

static char *reason(const struct diag_list *diags)
{
	const struct diag *diag = diag_first_error(diags);

	return diag ? diag_said_whole(diag) : g_strdup(_("It cannot be read"));
}

static void add_text(void *out, const char *text, size_t len)
{
	g_string_append_len(out, text, (gssize)len);
}

/* The other types with names, without @table, which is tried. */
static void add_named(GString *out, const struct project *project, int table)
{
	const struct sink sink = { add_text, out, NULL };

	for (int i = project->structure_count; i < type_count(project); i++) {
		if (!type_is(project, i) || i == table - project->pou_count - 1)
			continue;
		g_string_append_printf(out, "TYPE\n  %s : ", type_name(project, i));
		project_write_type(project, type_like(project, i), &sink);
		g_string_append(out, ";\nEND_TYPE\n");
	}
}

/* Empty stand-ins for the words of the project, so that types are known. */
static void add_words(GString *out, const struct project *project, int table)
{
	add_named(out, project, table);
	for (int i = 0; i < project->structure_count; i++)
		if (project->structure[i].name)
			g_string_append_printf(out, "TYPE\n  %s : STRUCT\n    X : INT;\n"
			"  END_STRUCT;\nEND_TYPE\n",
			project_text(project, project->structure[i].name));
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_BLOCK)
			g_string_append_printf(out, "FUNCTION_BLOCK %s LD\n"
				"END_FUNCTION_BLOCK\n",
				project_text(project, project->pou[i].name));
}

/* Longer than a name that can be typed, so no declaration has it. */
#define HERE "Place_of_a_declaration_that_is_tried"

/* Adds a block with the declaration as it would stand in @table. */
static void add_place(GString *out, const struct project *project, int table,
		      uint16_t flags, const char *line)
{
	char *head = symbol_text_block(flags);
	const char *word;

	if (table > project->pou_count + project->structure_count) {
		g_string_append_printf(out, "TYPE\n%sEND_TYPE\n", line);
	} else if (table > project->pou_count) {
		g_string_append_printf(out, "TYPE\n  " HERE " : STRUCT\n%s  END_STRUCT;\n"
				       "END_TYPE\n", line);
	} else if (table == 0) {
		g_string_append_printf(out, "%s%sEND_VAR\n", head, line);
	} else {
		word = pou_word(project->pou[table - 1].kind);
		g_string_append_printf(out, "%s " HERE "%s LD\n%s%sEND_VAR\nEND_%s\n", word,
			project->pou[table - 1].kind == POU_FUNCTION ? " : INT" : "", head,
			line, word);
	}
	g_free(head);
}

static int named_in(const struct project *project)
{
	int count = 0;

	for (int i = project->structure_count; i < type_count(project); i++)
		count += type_is(project, i);
	return count;
}

/* The last structure with a name; -1: none. @count: how many have one. */
static int last_structure(const struct project *project, int *count)
{
	int last = -1;

	*count = 0;
	for (int i = 0; i < project->structure_count; i++)
		if (project->structure[i].name) {
			last = i;
			++*count;
		}
	return last;
}

/* Does the made project have the type that is tried, as the last one, and no other new one? */
static bool is_alone_type(const struct project *made, const struct project *project,
			  const char *name)
{
	int now, before;

	last_structure(made, &now);
	last_structure(project, &before);
	return named_in(made) == named_in(project) && made->pou_count <= project->pou_count &&
	       now == before &&
	       strcmp(type_name(made, type_count(made) - 1), name) == 0;
}

/* Does the made project have this declaration and no other? */
static bool is_alone(const struct project *made, int table, int pous, const char *name)
{
	int count;
	const struct var_table *vars = table == 0 ? &made->globals : table > pous ?
		&made->structure[last_structure(made, &count)].vars :
		&made->pou[made->pou_count - 1].vars;
	const int first = listing_first(vars);

	return listing_count(vars) == 1 &&
	       strcmp(project_text(made, vars->var[first].name), name) == 0;
}

static bool reads(const struct project *project, int table, uint16_t flags,
		  const char *line, const char *name, char **why)
{
	GString *text = g_string_new("RUNGBOARD 1\n");
	struct ladder *ladder = ladder_new();
	bool good;

	if (!ladder)
		g_error("out of memory");
	ladder_leave_expressions(ladder, true);
	add_words(text, project, table);
	add_place(text, project, table, flags, line);
	good = ladder_load_text(ladder, "", text->str, text->len) && ladder_project(ladder);
	if (!good)
		refuse(why, reason(ladder_diags(ladder)));
	else if (table > project->pou_count + project->structure_count ?
		 !is_alone_type(ladder_project(ladder), project, name) :
		 !is_alone(ladder_project(ladder), table, project->pou_count, name))
		good = refuse(why, g_strdup(_("It cannot be read")));
	ladder_free(ladder);
	g_string_free(text, TRUE);
	return good;
}

/* A replacement in the text. */
struct piece {
	gsize at, removed;
	GString *with;
	const char *tail;    /* behind that: the end of a new block, which further declarations
				go before */
	int order;           /* among those at one place                      */
	int table;           /* of a new block; -1: it is none                 */
	uint16_t flags;      /* of a new block                                 */
};

struct symbol_batch {
	LadderDocument *document;
	struct project *project;
	struct symbols *symbols;
	struct symbol_row *type; /* a type that is no structure; NULL: none was asked for */
	char *text;
	gsize len;
	GArray *span;        /* of struct text_span                           */
	GArray *piece;       /* of struct piece                               */
	GHashTable *turned;  /* spans of blocks with a new heading            */
};

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
	if (batch->type)
		symbol_row_free(batch->type);
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

/* A part by kind and number in a table; NULL: none. */
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

/* The row of a declaration; NULL: there is none. */
static const struct symbol_row *old_row(struct symbol_batch *batch, int table, int index)
{
	const struct project *project = batch->project;
	const int type = project ? table - project->pou_count - 1 : -1;

	if (type < 0 || type < project->structure_count)
		return row_at(batch->symbols, table, index);
	if (!batch->type && type_is(project, type)) {
		batch->type = symbol_row_new(project, xref_table(batch->project, table), table, 0);
		batch->type->included = type_is_included(batch->document, type);
	}
	return batch->type;
}

/* ---- names ---- */

static char *name_reason(enum diag_id fault, const char *name)
{
	if (fault == DIAG_EXPECTED)
		return g_strdup_printf(_("“%s” is not a name"), name);
	return diag_said_of(fault, name);
}

/* Does the program use this name as an address? A symbol of this name would replace it. */
static bool is_used_address(struct symbol_batch *batch, const char *name)
{
	struct xref xref;
	bool found = false;

	if (!xref_make(&xref, batch->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count && !found; i++) {
		const struct xref_use *use = &xref.use[i];

		found = use->target.what == XREF_ADDRESS &&
			name_is(name, xref_text(&xref, use) + use->at, use->len);
	}
	xref_free(&xref);
	return found;
}

/* @index: the declaration that may have the name already; -1: none. */
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
		if (i != index && name_equal(name,
				project_text(project, vars->var[i].name)))
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

/* The last block with these flags in this file; NULL: none. */
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

/* A new block of globals goes before the first POU. */
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

/* Inserts into a new block of this batch; false: there is none. */
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

int symbol_block(const struct var_table *vars, int index)
{
	for (int i = 0; i < vars->block_count; i++)
		if (index >= vars->block[i].first &&
		    index < vars->block[i].first + vars->block[i].count)
			return i;
	return -1;
}

/* Moves a declaration to another block; if it is alone in its block, the block gets another
 * heading. */
static bool move(struct symbol_batch *batch, int table, int index, uint16_t flags,
		 const struct text_span *span, const char *line, char **why)
{
	const struct var_table *vars = xref_table(batch->project, table);
	const int number = symbol_block(vars, index);
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
	const struct symbol_row *old = index < 0 ? NULL : old_row(batch, table, index);
	const uint16_t wanted = wanted_flags(flags, text);
	char *line;
	bool good;

	if (!batch->text || !xref_table(batch->project, table))
		return refuse(why, g_strdup(_("The file cannot be read as a program. Correct its errors first")));
	if ((!old || strcmp(old->text[FIELD_NAME], text[FIELD_NAME]) != 0) &&
	    !name_is_free(batch, table, index, text[FIELD_NAME], why))
		return false;
	if (table > batch->project->pou_count && *text[FIELD_ADDRESS])
		return refuse(why, g_strdup(_("A member of a structure has no address")));
	if (!*text[FIELD_TYPE])
		return refuse(why, g_strdup(_("A type is needed")));
	line = symbol_text_line(text);
	good = reads(batch->project, table, wanted, line, text[FIELD_NAME],
				 why) &&
	       put_line(batch, table, old, wanted, line, why);
	g_free(line);
	return good;
}

static bool batch_delete(struct symbol_batch *batch, int table, int index, char **why)
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
	number = symbol_block(vars, index);
	block = find_span(batch, TEXT_BLOCK, table, number);
	if (block && vars->block[number].count == 1 && !vars->block[number].comment)
		span = block;
	add_piece(batch, span->at, span->len, g_strdup(""));
	return true;
}

/* At one place insertions come first, in their order, then removals. */
static int by_place(gconstpointer left, gconstpointer right)
{
	const struct piece *a = left, *b = right;

	if (a->at != b->at)
		return a->at < b->at ? -1 : 1;
	if (!a->removed != !b->removed)
		return a->removed ? 1 : -1;
	return a->order - b->order;
}

/* The text with all replacements. Caller frees. */
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
	struct ladder *ladder = ladder_document_reader(batch->document);
	GString *text = pieced(batch);

	if (!ladder_load_text(ladder, path ? path : "", text->str, text->len)) {
		refuse(why, reason(ladder_diags(ladder)));
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
	char *refusal = ladder_document_replace_step(batch->document, 0, batch->len, text->str,
						     step);

	g_string_free(text, TRUE);
	return !refusal || refuse(why, refusal);
}

/* ---- single changes ---- */

static bool rename_symbol(LadderDocument *document, int table, int index, const char *name,
			  char **why)
{
	struct project *project = ladder_document_project(document);
	const struct xref_target target = xref_variable(project, table, index);
	char *reason = NULL;

	return rename_everywhere(document, &target, name, _("Rename symbol"), NULL, &reason) ||
	       refuse(why, reason);
}

/* Is the symbol in a file beside the project? */
static bool is_beside(LadderDocument *document, int table, int index)
{
	const struct xref_target target = xref_variable(ladder_document_project(document), table,
							index);
	char *why = NULL;
	GPtrArray *files = rename_files(document, &target, NULL, &why);
	const bool is = !files || files->len > 0;

	if (files)
		g_ptr_array_unref(files);
	g_free(why);
	return is;
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

/* Does it exist, in this file? */
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
	const struct symbol_row *symbol = old_row(batch, table, index);
	char *clean = g_strstrip(g_strdup(text));
	bool good;

	if (!may_change(symbol, why))
		good = false;
	else if (strcmp(symbol->text[field], clean) == 0)
		good = true;
	else if (field == FIELD_COMMENT && (strstr(clean, "(*") || strstr(clean, "*)")))
		good = refuse(why, g_strdup(_("a comment is one line without (* and *)")));
	else if (field == FIELD_NAME &&
		 (symbol->uses > 0 || is_beside(document, table, index)))
		good = rename_symbol(document, table, index, clean, why);
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
	const struct symbol_row *symbol = row_at(batch->symbols, table, index);
	bool good = may_change(symbol, why);

	if (good && (symbol->flags & SYMBOL_KINDS) != kind)
		good = symbol_batch_put(batch, table, index,
				(uint16_t)((symbol->flags & ~SYMBOL_KINDS) | kind),
				(const char *const *)symbol->text, why) &&
		       symbol_batch_apply(batch, _("Change kind"), why);
	symbol_batch_free(batch);
	return good;
}

/* ---- access for operators ---- */

/* Whether @table has another variable of this name than the one at @index. */
static bool is_variable(const struct project *project, const struct var_table *vars,
			const char *name, int index)
{
	for (int i = 0; i < vars->count; i++)
		if (i != index && name_equal(project_text(project, vars->var[i].name), name))
			return true;
	return false;
}

static bool access_is_free(struct project *project, const struct symbol_row *symbol,
			   const char *name)
{
	for (int i = 0; i < project->access_count; i++)
		if (i != symbol->line &&
		    name_equal(project_text(project, project->access[i].var.name), name))
			return false;
	for (int i = 0; i <= project->pou_count; i++)
		if ((!i || project->pou[i - 1].kind == POU_PROGRAM) &&
		    is_variable(project, xref_table(project, i), name,
				i == symbol->table ? symbol->index : -1))
			return false;
	return project_find_pou(project, name, strlen(name)) < 0;
}

/* Its own name, or behind that of its program, or with a number. */
static char *access_free_name(struct project *project, const struct symbol_row *symbol)
{
	char *stem = *symbol->scope ? g_strdup_printf("%s_%s", symbol->scope,
			symbol->text[FIELD_NAME]) : g_strdup(symbol->text[FIELD_NAME]);
	char *name = g_strdup(symbol->text[FIELD_NAME]);

	for (int i = 1; !access_is_free(project, symbol, name) && i < LIMIT_VARS; i++) {
		g_free(name);
		name = i == 1 ? g_strdup(stem) : g_strdup_printf("%s%d", stem, i);
	}
	g_free(stem);
	return name;
}

/* "  Name : Main.Name : INT READ_WRITE; (* … *)\n"; the bounds of an array are numbers. */
static char *access_line(struct project *project, const struct symbol_row *symbol,
			 enum symbol_access access, const char *name)
{
	const struct access *old = symbol->line < 0 ? NULL : &project->access[symbol->line];
	struct var var = xref_table(project, symbol->table)->var[symbol->index];
	char *path = old ? g_strdup(project_text(project, old->path)) :
		     *symbol->scope ? g_strdup_printf("%s.%s", symbol->scope,
						      symbol->text[FIELD_NAME]) :
				      g_strdup(symbol->text[FIELD_NAME]);
	const char *comment = old ? project_text(project, old->var.comment) : "";
	char *type, *line;

	var.written = NULL;
	type = listing_type(project, &var);
	line = g_strdup_printf("  %s : %s : %s %s;%s%s\n", name, path, type,
			       access_word(access == SYMBOL_WRITE), *comment ? " " : "", comment);
	g_free(path);
	g_free(type);
	return line;
}

/* The last block in this file that stands in no POU. */
static const struct text_span *access_block(const struct symbol_batch *batch)
{
	const struct text_span *found = NULL;

	for (guint i = 0; i < batch->span->len; i++) {
		const struct text_span *span = &g_array_index(batch->span, struct text_span, i);

		if (span->part == TEXT_ACCESS && !batch->project->access_block[span->number].pou)
			found = span;
	}
	return found;
}

/* A new block: in the CONFIGURATION if this file has one, else before the first POU. */
static void add_access_block(struct symbol_batch *batch, const char *line)
{
	static const char end[] = "END_CONFIGURATION\n";

	for (guint i = 0; i < batch->span->len; i++) {
		const struct text_span *span = &g_array_index(batch->span, struct text_span, i);

		if (span->part != TEXT_PART ||
		    batch->project->part[span->number].kind != PART_CONFIG)
			continue;
		add_piece(batch, span->at + span->len - strlen(end), 0,
			  g_strdup_printf("VAR_ACCESS\n%sEND_VAR\n", line));
		return;
	}
	add_piece(batch, place_of_globals(batch), 0,
		  g_strdup_printf("VAR_ACCESS\n%sEND_VAR\n\n", line));
}

static void add_access(struct symbol_batch *batch, const char *line)
{
	const struct text_span *block = access_block(batch);

	if (block)
		add_piece(batch, block->at + block->len - strlen("END_VAR\n"), 0,
			  g_strdup(line));
	else
		add_access_block(batch, line);
}

/* The last line goes with its block, unless that has a comment. */
static void drop_access(struct symbol_batch *batch, const struct symbol_row *symbol)
{
	const struct project *project = batch->project;
	const struct access_block *block = access_block_of(project, symbol->line);
	const struct text_span *span = find_span(batch, TEXT_ACCESS_LINE, 0, symbol->line);
	const struct text_span *whole = find_span(batch, TEXT_ACCESS, 0,
						  (int)(block - project->access_block));

	if (block->count == 1 && !block->comment)
		span = whole;
	if (span)
		add_piece(batch, span->at, span->len, g_strdup(""));
}

/* Removes the lines of a block that @drops has. */
static void drop_lines(struct symbol_batch *batch, int number, const bool *drops)
{
	const struct access_block *block = &batch->project->access_block[number];
	const struct text_span *span = find_span(batch, TEXT_ACCESS, 0, number);
	int count = 0;

	for (int i = 0; i < block->count; i++)
		count += drops[block->first + i];
	if (count && count == block->count && !block->comment && span) {
		add_piece(batch, span->at, span->len, g_strdup(""));
		return;
	}
	for (int i = 0; i < block->count; i++) {
		span = drops[block->first + i] ?
		       find_span(batch, TEXT_ACCESS_LINE, 0, block->first + i) : NULL;
		if (span)
			add_piece(batch, span->at, span->len, g_strdup(""));
	}
}

/* The line of VAR_ACCESS whose path leads to this symbol, or into it, by a member or an index;
 * -1: the use is none. */
static int access_line_of(const struct project *project, const struct xref_use *use)
{
	const guintptr at = (guintptr)use->slot, first = (guintptr)project->access;
	const struct access *access;
	int depth = 0;

	if (!use->slot || use->included || at < first ||
	    at >= (guintptr)(project->access + project->access_count))
		return -1;
	access = &project->access[(at - first) / sizeof(*access)];
	if (use->slot != &access->path)
		return -1;
	for (uint32_t i = 0; i < use->at; i++) {
		const char c = project_text(project, access->path)[i];

		depth += c == '[' ? 1 : c == ']' ? -1 : 0;
	}
	return depth ? -1 : (int)(access - project->access); /* not for an index in it */
}

/* All lines that lead to the symbol, whatever name operators have for it. A block goes with its
 * last line, unless it has a comment. */
static void drop_accesses(struct symbol_batch *batch, int table, int index)
{
	const struct project *project = batch->project;
	bool *drops = g_new0(bool, (gsize)project->access_count + 1);
	struct xref xref;

	if (!xref_make(&xref, batch->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		const int line = use->target.what == XREF_VARIABLE &&
				 use->target.table == table && use->target.index == index ?
				 access_line_of(project, use) : -1;

		if (line >= 0)
			drops[line] = true;
	}
	xref_free(&xref);
	for (int i = 0; i < project->access_block_count; i++)
		drop_lines(batch, i, drops);
	g_free(drops);
}

/* @name: for operators. */
static void change_access(struct symbol_batch *batch, const struct symbol_row *symbol,
			  enum symbol_access access, const char *name)
{
	const struct text_span *span = symbol->line < 0 ? NULL :
		find_span(batch, TEXT_ACCESS_LINE, 0, symbol->line);
	char *line;

	if (access == SYMBOL_KEPT) {
		drop_access(batch, symbol);
		return;
	}
	line = access_line(batch->project, symbol, access, name);
	if (span)
		add_piece(batch, span->at, span->len, g_strdup(line));
	else
		add_access(batch, line);
	g_free(line);
}

static bool may_give(const struct symbol_row *symbol, char **why)
{
	if (!may_change(symbol, why))
		return false;
	if (!symbol->exports)
		return refuse(why, g_strdup(_("Only variables of programs and global variables can be given to operators")));
	return !symbol->foreign || refuse(why, g_strdup(_("It is declared in another file")));
}

/* Its name for operators, or the one that it would get. Caller frees. */
static char *access_name(struct project *project, const struct symbol_row *symbol)
{
	return symbol->line < 0 ? access_free_name(project, symbol) :
	       g_strdup(project_text(project, project->access[symbol->line].var.name));
}

bool symbol_set_access(LadderDocument *document, int table, int index,
		       enum symbol_access access, char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	const struct symbol_row *symbol = row_at(batch->symbols, table, index);
	bool good = may_give(symbol, why) && batch->text;
	char *name;

	if (good && symbol->access != access) {
		name = access_name(batch->project, symbol);
		change_access(batch, symbol, access, name);
		good = symbol_batch_apply(batch, _("Change access"), why);
		g_free(name);
	}
	symbol_batch_free(batch);
	return good;
}

/* The text of the column Access. */
struct wanted_access { enum symbol_access access; char *name; };

/* A word for what operators may do, a name, or both with a colon between them. Without a word, the
 * symbol keeps what it had; a new one may be read. */
static struct wanted_access wanted_access(struct project *project,
					  const struct symbol_row *symbol, const char *text)
{
	const char *colon = strchr(text, ':');
	const gsize len = colon ? (gsize)(colon - text) : strlen(text);
	char *word = g_strstrip(g_strndup(text, len));
	const bool reads = name_equal(word, access_word(false));
	const bool writes = name_equal(word, access_word(true));
	const char *name = reads || writes ? (colon ? colon + 1 : "") : text;
	struct wanted_access wanted = {
		.access = writes ? SYMBOL_WRITE : reads || symbol->access == SYMBOL_KEPT ?
			  SYMBOL_READ : symbol->access,
		.name = g_strstrip(g_strdup(name)),
	};

	g_free(word);
	if (!*text)
		wanted.access = SYMBOL_KEPT;
	else if (!*wanted.name) {
		g_free(wanted.name);
		wanted.name = access_free_name(project, symbol);
	}
	return wanted;
}

static bool is_access_name(struct project *project, const struct symbol_row *symbol,
			   const char *name, char **why)
{
	const enum diag_id fault = ladder_name_fault(name);

	if (fault != DIAG_COUNT)
		return refuse(why, name_reason(fault, name));
	return access_is_free(project, symbol, name) ||
	       refuse(why, g_strdup_printf(_("“%s” is declared already"), name));
}

/* The name that operators have for it; "": none. Owns: the caller. */
static char *symbol_access_name(LadderDocument *document, const struct symbol_row *symbol)
{
	struct project *project = ladder_document_project(document);

	return g_strdup(symbol->line < 0 || !project || symbol->line >= project->access_count ? "" :
			project_text(project, project->access[symbol->line].var.name));
}

bool symbol_set_access_text(LadderDocument *document, int table, int index, const char *text,
			    char **why)
{
	struct symbol_batch *batch = symbol_batch_new(document);
	const struct symbol_row *symbol = row_at(batch->symbols, table, index);
	bool good = may_give(symbol, why) && batch->text;
	struct wanted_access wanted;
	char *clean, *old;

	if (good) {
		clean = g_strstrip(g_strdup(text));
		wanted = wanted_access(batch->project, symbol, clean);
		old = symbol_access_name(document, symbol);
		good = wanted.access == SYMBOL_KEPT ||
		       is_access_name(batch->project, symbol, wanted.name, why);
		if (good && (wanted.access != symbol->access || strcmp(wanted.name, old) != 0)) {
			change_access(batch, symbol, wanted.access, wanted.name);
			good = symbol_batch_apply(batch, _("Change access"), why);
		}
		g_free(old);
		g_free(wanted.name);
		g_free(clean);
	}
	symbol_batch_free(batch);
	return good;
}

char *symbol_access_text(LadderDocument *document, const struct symbol_row *symbol,
			 enum symbol_access access)
{
	char *name = symbol_access_name(document, symbol), *text;

	if (access == SYMBOL_KEPT)
		text = g_strdup("");
	else if (!*name || name_equal(name, symbol->text[FIELD_NAME]))
		text = g_strdup(access_word(access == SYMBOL_WRITE));
	else
		text = g_strdup_printf(_("%s: %s"), access_word(access == SYMBOL_WRITE), name);
	g_free(name);
	return text;
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
	bool good = batch_delete(batch, table, index, why);

	if (good)
		drop_accesses(batch, table, index);
	good = good && symbol_batch_apply(batch, _("Delete symbol"), why);

	symbol_batch_free(batch);
	return good;
}
