/* SPDX-License-Identifier: MIT
 *
 * symbols - declarations as rows: what they say, and how often they are used. Edits are
 * symbols_edit.c's.
 */
#include "editor-gtk/document/symbols.h"

#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/literal.h"
#include "engine/xref/address_map.h"

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

static char *type_text(const struct project *project, const struct var *var)
{
	GString *text = g_string_new("");

	if (var->array.count)
		g_string_printf(text, "ARRAY[%ld..%lld] OF ", (long)var->array.low,
				(long long)var->array.low + var->array.count - 1);
	g_string_append(text, var->type == IEC_NONE ?
			words_row(&project->words, var->fb)->word :
			iec_type_row(var->type)->word);
	if (var->type == IEC_STRING && var->capacity != IEC_STRING_DEFAULT)
		g_string_append_printf(text, "[%u]", var->capacity);
	return g_string_free(text, FALSE);
}

static char *initial_text(const struct project *project, const struct var *var)
{
	char text[64];

	if (!var->has_init)
		return g_strdup("");
	if (var->init_text)
		return g_strdup(project_text(project, var->init_text));
	literal_print(var->type, var->init, text, sizeof(text));
	return g_strdup(text);
}

static char *scope_name(const struct project *project, int table)
{
	const int structure = table - project->pou_count - 1;

	if (table == 0)
		return g_strdup("");
	return g_strdup(project_text(project, structure < 0 ?
		project->pou[table - 1].name : project->structure[structure].name));
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
	symbol->text[FIELD_TYPE] = type_text(project, var);
	symbol->text[FIELD_ADDRESS] = g_strdup(project_text(project, var->at_text));
	symbol->text[FIELD_INITIAL] = initial_text(project, var);
	symbol->text[FIELD_RETAIN] = g_strdup(symbol->flags & VAR_RETAIN ? "1" : "");
	symbol->text[FIELD_CONSTANT] = g_strdup(symbol->flags & VAR_CONSTANT ? "1" : "");
	symbol->text[FIELD_COMMENT] = comment_text(project_text(project, var->comment));
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

/* Of each table the number of its first row; results of functions have none. */
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

/* Rows of a table stand in the order of their indices. */
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

const struct symbol_row *symbols_find(const struct symbols *symbols, const char *scope,
				  const char *name)
{
	for (int i = 0; i < symbols->count; i++) {
		const struct symbol_row *symbol = &symbols->symbol[i];

		if (g_ascii_strcasecmp(symbol->scope, scope) == 0 &&
		    g_ascii_strcasecmp(symbol->text[FIELD_NAME], name) == 0)
			return symbol;
	}
	return NULL;
}

const struct symbol_row *symbols_at(const struct symbols *symbols, int table, int index)
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
		if (g_ascii_strcasecmp(project_text(project, vars->var[i].name), name) == 0)
			return true;
	if (table == 0 && project_find_pou(project, name, strlen(name)) >= 0)
		return true;
	return ladder_name_fault(name) != DIAG_COUNT;
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

char *symbol_free_address(LadderDocument *document, enum iec_area area, const char *type)
{
	struct project *project = ladder_document_project(document);
	const enum iec_type found = iec_type_find(type, strlen(type));
	const int bits = found == IEC_BOOL ? 1 : iec_type_row(found)->size * 8;
	struct address_map map;
	struct iec_addr addr;
	struct xref xref;
	char text[32] = "";

	if (!project || found == IEC_NONE)
		return g_strdup("");
	if (!xref_make(&xref, project) || !address_map_make(&map, &xref, &xref.arena))
		g_error("out of memory");
	if (address_map_next(&map, area, bits, 1, NULL, &addr))
		iec_addr_print(addr, text, sizeof(text));
	xref_free(&xref);
	return g_strdup(text);
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

/* ---- what is wrong ---- */

static bool speaks_of(const struct diag *diag, const struct symbol_row *symbol)
{
	const char *pou = diag->pou ? diag->pou : "";

	return diag->rung == 0 && strcmp(diag->arg, symbol->text[FIELD_NAME]) == 0 &&
	       (symbol->member || strcmp(pou, symbol->scope) == 0);
}

char *symbol_error(LadderDocument *document, const struct symbol_row *symbol,
		   bool *warning)
{
	const struct diag_list *diags = ladder_document_diags(document);

	for (int i = 0; diags && i < diags->count; i++)
		if (speaks_of(&diags->diag[i], symbol)) {
			*warning = diag_severity(diags->diag[i].id) != SEVERITY_ERROR;
			return g_strdup(_(diag_text(diags->diag[i].id)));
		}
	return NULL;
}

static char *place_of(struct project *project, const struct ladder_rename *how)
{
	const char *pou = how->pou < 0 ? "" :
		project_text(project, project->pou[how->pou].name);

	if (how->rung)
		return g_strdup_printf(_("%s, rung %d"), pou, how->rung);
	return g_strdup(*pou ? pou : _("the globals"));
}

char *rename_reason(LadderDocument *document, const struct ladder_rename *how,
		    const char *name)
{
	char *place = place_of(ladder_document_project(document), how), *text = NULL;

	switch (how->why) {
	case RENAME_GOOD:
	case RENAME_NOTHING:
		text = g_strdup(_("This has no name that could be changed"));
		break;
	case RENAME_FORM:
		text = g_strdup_printf(_("“%s” is not a name"), name);
		break;
	case RENAME_RESERVED:
		text = g_strdup_printf(_("“%s” is a word of the language"), name);
		break;
	case RENAME_TAKEN:
		text = g_strdup_printf(_("“%s” is declared already (%s)"), name, place);
		break;
	case RENAME_MEANING:
		text = g_strdup_printf(_("“%s” would mean something else in %s"), name,
				       place);
		break;
	case RENAME_OTHER_FILE:
		text = g_strdup_printf(_("It is used in another file (%s)"), place);
		break;
	case RENAME_MEMORY:
		text = g_strdup(_("Memory is out"));
		break;
	}
	g_free(place);
	return text;
}
