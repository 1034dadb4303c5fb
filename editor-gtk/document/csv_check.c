/* SPDX-License-Identifier: MIT
 *
 * csv_check - what would be wrong with a program after the import of a table. The program
 * is made in memory, checked as any other, and its faults are told at the lines that bring
 * them.
 */
#include "editor-gtk/document/csv.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/ladder.h"
#include "engine/xref/address_map.h"

#include <string.h>

#define CLASHES_MOST 5000

/* The entries that would change something. */
struct checked {
	struct csv_plan *plan;
	struct xref xref;    /* of the program as it would be                 */
	GHashTable *name;    /* "Main.Delay", folded: struct csv_entry *      */
	GHashTable *line;    /* of its declaration: the same                  */
};

/* @text: taken over; the first one is kept. */
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
	key = g_ascii_strdown(name, -1);
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
			g_hash_table_insert(checked->name, g_ascii_strdown(entry->name, -1),
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

/* Of the first @count. */
static int count_same(const struct diag_list *diags, int count, const struct diag *diag)
{
	int same = 0;

	for (int i = 0; i < count; i++)
		same += is_same(&diags->diag[i], diag);
	return same;
}

/* Does the text of an error begin with the name that stands there? */
static bool speaks_of(const struct checked *checked, const struct diag *diag,
		      const struct xref_use *use)
{
	const char *name = xref_text(&checked->xref, use) + use->at;
	const char end = use->len < sizeof(diag->arg) ? diag->arg[use->len] : '\0';

	return use->len && g_ascii_strncasecmp(diag->arg, name, use->len) == 0 &&
	       !g_ascii_isalnum(end) && end != '_';
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

/* At the symbol it speaks of, else at those of its cell, else at those of its rung or line. */
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

/* Errors that the program has not yet, where it uses what would be another. */
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

/* No program would come of it, and no line is known that is to blame. */
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

void csv_plan_check(struct csv_plan *plan)
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
