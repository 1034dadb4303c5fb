/* SPDX-License-Identifier: MIT
 *
 * generic - see generic.h.
 */
#include "engine/check/generic.h"

#include "engine/base/literal.h"
#include "engine/model/expr_args.h"
#include "engine/model/shape.h"
#include "engine/model/st.h"

#include <string.h>

/* The bounds that one call gives, by the variable of the function. */
struct bounds {
	int var;
	int dims;
	struct var_array dim[LIMIT_INDICES];
};

struct generic {
	struct project *project;
	struct scope *scope;
	struct expr *expr;
	struct diag_list *ignored;
	int from;            /* the first POU of this round                   */
	bool failed;
};

/* The dimensions of the array at @node of the expression. False: it is none. */
static bool bounds_at(struct scope *scope, const struct pou *pou, struct expr *expr, int node,
		      struct bounds *out)
{
	const struct expr_node *at = &expr->node[node];
	const struct var_array *dim = NULL;
	const struct meaning *m = NULL;
	enum diag_id why;
	uint32_t id = 0;

	if (at->op == EXPR_NAME || at->op == EXPR_INDEX)
		id = scope_first_of(scope, pou, expr, at);
	m = id ? scope_find(scope, pou, id, &why) : NULL;
	if (m && m->kind == MEANING_ARRAY) {
		out->dims = m->dims > 1 ? m->dims : 1;
		dim = m->dims > 1 ? m->dim : &m->array;
	} else if (at->op == EXPR_CALL) { /* a function whose result is an array */
		const enum word word = expr_function(&scope_project(scope)->words, at);
		const struct pou *called = shape_pou(scope_project(scope), word);
		const struct var *result = called && called->vars.count ? &called->vars.var[0] : NULL;

		if (!result || !result->array.count)
			return false;
		out->dims = result->dims > 1 ? result->dims : 1;
		dim = result->dims > 1 ? result->dim : &result->array;
	}
	if (dim)
		memcpy(out->dim, dim, (size_t)out->dims * sizeof(*dim));
	return dim != NULL;
}

static bool has_bounds(const struct var *var, const struct bounds *bounds)
{
	const struct var_array *dim = var->dims > 1 ? var->dim : &var->array;

	if ((var->dims > 1 ? var->dims : 1) != bounds->dims)
		return false;
	for (int i = 0; i < bounds->dims; i++)
		if (dim[i].low != bounds->dim[i].low || dim[i].count != bounds->dim[i].count)
			return false;
	return true;
}

/* Is @pou the copy of @of that has, for each ARRAY[*], the bounds of its argument? */
static bool serves(struct scope *scope, const struct pou *caller, struct expr *expr, const struct expr_args *args,
		   const struct pou *of, const struct pou *pou)
{
	for (int i = 0; i < of->vars.count; i++) {
		struct bounds bounds = { .var = i };
		int at = -1;

		if (!of->vars.var[i].any_bounds)
			continue;
		for (int k = 0; k < args->count; k++)
			if (args->arg[k].pin == i)
				at = args->arg[k].at;
		if (at < 0 || !bounds_at(scope, caller, expr, at, &bounds) ||
		    !has_bounds(&pou->vars.var[i], &bounds))
			return false;
	}
	return true;
}

/* Index of the generic function that @word is; -1: it is none. */
static int generic_of(const struct project *project, enum word word)
{
	const struct word_row *row = words_own(&project->words, word);

	return row && row->kind == WORD_FN && row->owner >= 0 && pou_has_any_bounds(&project->pou[row->owner]) ?
	       row->owner : -1;
}

enum word generic_word(struct scope *scope, const struct pou *pou, struct expr *expr,
		       const struct expr_node *call, enum word word)
{
	struct project *project = scope_project(scope);
	const int of = generic_of(project, word);
	struct expr_args args = { .wrong = -1, .text = "" };

	if (of < 0 || expr_match(expr, call, words_row(&project->words, word), &args) != DIAG_COUNT)
		return word;
	for (int i = of + 1; i < project->pou_count; i++)
		if (project->pou[i].copy_of == of + 1 &&
		    serves(scope, pou, expr, &args, &project->pou[of], &project->pou[i]))
			return project->pou[i].word;
	return word;
}

bool bound_value(struct scope *scope, const struct pou *pou, struct expr *expr, const struct expr_bound *bound,
		 int64_t *out)
{
	struct bounds bounds = { .var = 0 };
	struct literal number;
	enum diag_id why;
	const struct meaning *m;

	if (bound->number->op == EXPR_LITERAL &&
	    literal_parse(bound->number->text, bound->number->len, &number) != LITERAL_OK)
		return false;
	if (bound->number->op == EXPR_NAME) {
		m = scope_find(scope, pou, names_intern(&scope_project(scope)->names, bound->number->text,
							bound->number->len), &why);
		if (!m || m->kind != MEANING_LITERAL)
			return false;
		number = m->literal;
	} else if (bound->number->op != EXPR_LITERAL) {
		return false;
	}
	if (bound->array->op == EXPR_CALL ||
	    !bounds_at(scope, pou, expr, (int)(bound->array - expr->node), &bounds) || number.real ||
	    number.value.i < 1 || number.value.i > bounds.dims)
		return false;
	*out = bounds.dim[number.value.i - 1].low;
	if (bound->upper)
		*out += (int64_t)bounds.dim[number.value.i - 1].count - 1;
	return true;
}

/* ---- copies ---- */

/* Room for one more POU: the vector stays as long as something refers to it. */
static struct pou *add_pou(struct project *project)
{
	const int at = project->pou_count;
	int room = 8;
	struct pou *pou;

	while (room < at + 1)
		room *= 2;
	pou = arena_alloc(&project->arena, 2 * (size_t)room * sizeof(*pou));
	if (!pou)
		return NULL;
	memcpy(pou, project->pou, (size_t)at * sizeof(*pou));
	project->pou = pou;
	project->pou_count++;
	return &pou[at];
}

static bool set_bounds(struct project *project, struct var *var, const struct bounds *bounds)
{
	struct var_array *dim = arena_alloc(&project->arena, (size_t)bounds->dims * sizeof(*dim));

	if (!dim)
		return false;
	memcpy(dim, bounds->dim, (size_t)bounds->dims * sizeof(*dim));
	var->dim = dim;
	var->array = vars_flat(dim, bounds->dims);
	var->any_bounds = false;
	return true;
}

/* A copy of POU @of whose arrays get the bounds, as many as it has ARRAY[*]. */
static bool add_copy(struct project *project, int of, const struct bounds *bounds, int count)
{
	struct pou *pou = add_pou(project);
	struct word_row row;
	struct var *var;

	if (!pou)
		return false;
	*pou = project->pou[of];
	var = arena_alloc(&project->arena, ((size_t)pou->vars.count + 1) * sizeof(*var));
	if (!var)
		return false;
	memcpy(var, pou->vars.var, (size_t)pou->vars.count * sizeof(*var));
	pou->vars.var = var;
	pou->copy_of = of + 1;
	for (int i = 0; i < count; i++)
		if (!set_bounds(project, &var[bounds[i].var], &bounds[i]))
			return false;
	row = *words_row(&project->words, pou->word);
	row.owner = project->pou_count - 1;
	pou->word = words_add(&project->words, row);
	return pou->word != WORD_COUNT;
}

/* The bounds that the arguments give to POU @of. False: one has none, or not so many. */
static bool bounds_of_call(struct generic *g, const struct pou *caller, const struct expr_args *args, int of,
			   struct bounds *out, int *count)
{
	const struct var_table *vars = &g->project->pou[of].vars;

	*count = 0;
	for (int i = 0; i < vars->count; i++) {
		struct bounds *bounds = &out[*count];
		int at = -1;

		if (!vars->var[i].any_bounds)
			continue;
		for (int k = 0; k < args->count; k++)
			if (args->arg[k].pin == i)
				at = args->arg[k].at;
		bounds->var = i;
		if (at < 0 || !bounds_at(g->scope, caller, g->expr, at, bounds) || bounds->dims != (vars->var[i].dims > 1 ?
												    vars->var[i].dims : 1))
			return false;
		++*count;
	}
	return true;
}

static void note_call(struct generic *g, int caller, const struct expr_node *call)
{
	struct project *project = g->project;
	const enum word word = expr_function(&project->words, call);
	const int of = generic_of(project, word);
	struct expr_args args = { .wrong = -1, .text = "" };
	struct bounds *bounds;
	int count;

	if (of < 0 || generic_word(g->scope, &project->pou[caller], g->expr, call, word) != word ||
	    expr_match(g->expr, call, words_row(&project->words, word), &args) != DIAG_COUNT)
		return;
	bounds = arena_alloc(&project->arena, (size_t)project->pou[of].vars.count * sizeof(*bounds));
	if (!bounds)
		g->failed = true;
	else if (bounds_of_call(g, &project->pou[caller], &args, of, bounds, &count))
		g->failed |= !add_copy(project, of, bounds, count);
}

static void note_statement(struct generic *g, int caller, const struct st_item *item)
{
	struct st_part part;
	struct st_walk walk;
	bool function;

	st_begin(&walk, &g->project->names, item);
	function = item->kind == ST_CALL && walk.lex.token.kind == TOKEN_NAME &&
		   words_row(&g->project->words, words_find(&g->project->words, walk.lex.token.text,
							    walk.lex.token.len))->kind == WORD_FN;
	if (function) { /* its arguments are those of an expression */
		if (!expr_parse(&walk.lex, g->expr, g->ignored, (struct diag){ .id = DIAG_COUNT }))
			return;
		for (int i = 0; i < g->expr->count; i++)
			if (g->expr->node[i].op == EXPR_CALL)
				note_call(g, caller, &g->expr->node[i]);
		return;
	}
	while (st_next(&walk, &part, g->expr, g->ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART)
		for (int i = 0; part.role != ST_OPEN && i < g->expr->count && !g->failed; i++)
			if (g->expr->node[i].op == EXPR_CALL)
				note_call(g, caller, &g->expr->node[i]);
}

/* The calls in POUs that came in the last round. */
static void note_calls(struct generic *g, int end)
{
	for (int i = g->from; i < end && !g->failed; i++) {
		const struct st *st = g->project->pou[i].st;

		for (int k = 0; st && !pou_has_any_bounds(&g->project->pou[i]) && k < st->count; k++)
			if (st->item[k].kind != ST_COMMENT)
				note_statement(g, i, &st->item[k]);
	}
}

/* Bounds that have room for the constants of a body, and little memory. */
static struct var_array some_bounds(int dims)
{
	return dims == 1 ? (struct var_array){ -128, 512 } : dims == 2 ? (struct var_array){ -8, 32 } :
							    (struct var_array){ 0, 4 };
}

/* A function that nobody calls has one copy, so that its body is checked. */
static bool add_uncalled(struct project *project, int count)
{
	for (int of = 0; of < count; of++) {
		struct bounds *bounds;
		int found = 0, arrays = 0;

		if (!pou_has_any_bounds(&project->pou[of]))
			continue;
		for (int i = count; i < project->pou_count; i++)
			found += project->pou[i].copy_of == of + 1;
		if (found)
			continue;
		bounds = arena_alloc(&project->arena, (size_t)project->pou[of].vars.count * sizeof(*bounds));
		if (!bounds)
			return false;
		for (int i = 0; i < project->pou[of].vars.count; i++) {
			const struct var *var = &project->pou[of].vars.var[i];

			if (!var->any_bounds)
				continue;
			bounds[arrays] = (struct bounds){ .var = i, .dims = var->dims > 1 ? var->dims : 1 };
			for (int k = 0; k < bounds[arrays].dims; k++)
				bounds[arrays].dim[k] = some_bounds(bounds[arrays].dims);
			arrays++;
		}
		if (!add_copy(project, of, bounds, arrays))
			return false;
	}
	return true;
}

bool generic_add(struct project *project, struct arena *arena, struct diag_list *diags)
{
	struct generic g = { .project = project };
	const int count = project->pou_count;
	bool any = false, last = false;

	for (int i = 0; i < count; i++)
		any |= pou_has_any_bounds(&project->pou[i]);
	if (!any)
		return true;
	g.expr = arena_alloc(arena, sizeof(*g.expr));
	g.ignored = arena_alloc(arena, sizeof(*g.ignored));
	while (g.expr && g.ignored && !g.failed) {
		const int end = project->pou_count;

		if (g.from == end && last)
			return true;
		if (g.from == end) { /* what only uncalled functions call has copies, too */
			last = true;
			g.failed = !add_uncalled(project, count) || !shape_make(project, diags);
			continue;
		}
		g.scope = scope_new(project, arena);
		g.failed = !g.scope;
		if (g.scope)
			note_calls(&g, end);
		g.from = end;
		g.failed |= !shape_make(project, diags);
	}
	return false;
}

void generic_end(struct project *project, int pous)
{
	for (int i = pous; i < project->pou_count; i++) {
		struct word_row *row = project->pou[i].copy_of ? words_own(&project->words, project->pou[i].word) : NULL;

		if (row)
			row->owner = -1;
	}
}
