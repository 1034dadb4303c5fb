/* SPDX-License-Identifier: MIT
 *
 * rung_clip_declare - declarations that follow their rungs into another project.
 *
 * What the rungs name and nobody knows is asked of the cross reference once they stand
 * there, so that it is judged as the checks judge it. Two names never come to lie on one
 * address because of it.
 */
#include "editor-gtk/document/rung_clip.h"

#include "editor-gtk/kit/i18n.h"
#include "engine/xref/xref.h"

#include <string.h>

struct declare {
	LadderDocument *document;
	struct project *project;
	int pou;
	struct symbols *symbols;    /* of the source                          */
	struct project *source;
	struct symbol_batch *batch;
	int count;
	int clashes;
	char *clash;                /* what is told of the first one           */
};

/* ---- what is not known ---- */

/* Is there a name in the source that is none here? Most often not: what is pasted was
 * copied near by. */
static bool has_news(const struct declare *declare)
{
	for (int i = 0; i < declare->symbols->count; i++) {
		const char *name = declare->symbols->symbol[i].text[FIELD_NAME];
		const uint32_t fold = names_find_any(&declare->project->names, name,
						     strlen(name));

		if (vars_find(&declare->project->globals, fold) < 0 &&
		    vars_find(&declare->project->pou[declare->pou].vars, fold) < 0)
			return true;
	}
	return false;
}

/* Each name once, as it is first written. */
static GPtrArray *unknown_names(const struct declare *declare, int at, int count)
{
	GHashTable *seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	struct xref xref;

	if (!xref_make(&xref, declare->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		const char *text = xref_text(&xref, use) + use->at;

		if (use->target.what != XREF_UNKNOWN || use->pou != declare->pou ||
		    use->rung <= at || use->rung > at + count || !use->slot)
			continue;
		if (g_hash_table_add(seen, g_ascii_strdown(text, use->len)))
			g_ptr_array_add(names, g_strndup(text, use->len));
	}
	xref_free(&xref);
	g_hash_table_unref(seen);
	return names;
}

/* A local wins, as in the source; a member of a structure is none. */
static const struct symbol_row *find(const struct declare *declare, const char *name)
{
	const struct symbol_row *global = NULL;

	for (int i = 0; i < declare->symbols->count; i++) {
		const struct symbol_row *symbol = &declare->symbols->symbol[i];

		if (symbol->member ||
		    g_ascii_strcasecmp(symbol->text[FIELD_NAME], name) != 0)
			continue;
		if (symbol->table > 0)
			return symbol;
		global = symbol;
	}
	return global;
}

/* ---- addresses ---- */

static uint64_t bits_of(const struct var *var)
{
	return (uint64_t)var->at.bits * (var->array.count ? var->array.count : 1);
}

static bool overlaps(const struct var *a, const struct var *b)
{
	const uint64_t first = (uint64_t)a->at.byte * 8 + a->at.bit;
	const uint64_t other = (uint64_t)b->at.byte * 8 + b->at.bit;

	return a->at.area != AREA_NONE && a->at.area == b->at.area &&
	       first < other + bits_of(b) && other < first + bits_of(a);
}

/* The name that has memory of a variable of the source; NULL: none. */
static const char *owner_of(const struct declare *declare, const struct var *var)
{
	for (int table = 0; table <= declare->project->pou_count; table++) {
		const struct var_table *vars = xref_table(declare->project, table);

		for (int i = 0; i < vars->count; i++)
			if (overlaps(var, &vars->var[i]))
				return project_text(declare->project, vars->var[i].name);
	}
	return NULL;
}

static bool put(struct declare *declare, const struct symbol_row *symbol,
		const char *address)
{
	const char *text[SYMBOL_FIELDS];

	for (int i = 0; i < SYMBOL_FIELDS; i++)
		text[i] = symbol->text[i];
	text[FIELD_ADDRESS] = address;
	if (!symbol_batch_put(declare->batch, symbol->table ? declare->pou + 1 : 0, -1, 0,
			      text, NULL))
		return false;
	declare->count++;
	return true;
}

static void declare_one(struct declare *declare, const struct symbol_row *symbol)
{
	const struct var_table *vars = xref_table(declare->source, symbol->table);
	const char *owner = owner_of(declare, &vars->var[symbol->index]);

	if (!put(declare, symbol, owner ? "" : symbol->text[FIELD_ADDRESS]) || !owner)
		return;
	if (declare->clashes++ == 0)
		declare->clash = g_strdup_printf(_("; %s has no address: %s is %s here"),
			symbol->text[FIELD_NAME], symbol->text[FIELD_ADDRESS], owner);
}

/* ---- all of them ---- */

static char *done(const struct declare *declare)
{
	GString *text = g_string_new(NULL);
	const int more = declare->clashes - 1;

	g_string_printf(text, ngettext("%d name was declared", "%d names were declared",
				       (gulong)declare->count), declare->count);
	if (declare->clash)
		g_string_append(text, declare->clash);
	if (more > 0)
		g_string_append_printf(text, ngettext(" and %d more", " and %d more",
						      (gulong)more), more);
	return g_string_free(text, FALSE);
}

static char *declare_all(struct declare *declare, const GPtrArray *names)
{
	char *told = NULL;

	declare->batch = symbol_batch_new(declare->document);
	for (guint i = 0; i < names->len; i++) {
		const struct symbol_row *symbol = find(declare, names->pdata[i]);

		if (symbol)
			declare_one(declare, symbol);
	}
	if (declare->count &&
	    symbol_batch_apply(declare->batch, _("Add symbol"), &told))
		told = done(declare);
	symbol_batch_free(declare->batch);
	g_free(declare->clash);
	return told;
}

char *rung_clip_declare(const struct rung_clip *clip, LadderDocument *document, int pou,
			int at, int count)
{
	struct declare declare = { .document = document, .pou = pou,
				   .project = ladder_document_project(document) };
	char *told = NULL;

	if (!clip->source)
		return NULL;
	declare.source = ladder_document_project(clip->source);
	declare.symbols = symbols_new(clip->source);
	if (has_news(&declare)) {
		GPtrArray *names = unknown_names(&declare, at, count);

		if (names->len)
			told = declare_all(&declare, names);
		g_ptr_array_unref(names);
	}
	symbols_free(declare.symbols);
	return told;
}
