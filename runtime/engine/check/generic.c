/* SPDX-License-Identifier: MIT
 *
 * generic - see generic.h.
 */
#include "engine/check/generic.h"

#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/model/args.h"
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

static bool bounds_of(const struct meaning *m, struct bounds *out)
{
	if (!m || m->kind != MEANING_ARRAY)
		return false;
	out->dims = m->dims > 1 ? m->dims : 1;
	memcpy(out->dim, m->dims > 1 ? m->dim : &m->array, (size_t)out->dims * sizeof(*out->dim));
	return true;
}

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
	if (bounds_of(m, out))
		return true;
	if (at->op == EXPR_CALL) { /* a function whose result is an array */
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

enum diag_id generic_fault(const struct project *project, const struct word_row *row, int pin, const struct meaning *m)
{
	const struct pou *pou = row->kind == WORD_FB && row->owner >= 0 ? &project->pou[row->owner] : NULL;
	struct bounds bounds = { .var = pin };

	if (!pou || !pou->copy_of || pin >= pou->vars.count || !project->pou[pou->copy_of - 1].vars.var[pin].any_bounds)
		return DIAG_COUNT;
	if (!bounds_of(m, &bounds) || bounds.dims != (pou->vars.var[pin].dims > 1 ? pou->vars.var[pin].dims : 1))
		return DIAG_ANY_BOUNDS_OF;
	return has_bounds(&pou->vars.var[pin], &bounds) || m->type != row->pin[pin].type ? DIAG_COUNT : DIAG_ANY_BOUNDS_FIXED;
}

/* Index of the generic function or block that @word is; -1: it is none. */
static int generic_of(const struct project *project, enum word word, enum word_kind kind)
{
	const struct word_row *row = words_own(&project->words, word);

	return row && row->kind == kind && row->owner >= 0 && pou_has_any_bounds(&project->pou[row->owner]) ?
	       row->owner : -1;
}

enum word generic_plain(const struct project *project, enum word word)
{
	const struct pou *pou = shape_pou(project, word);

	return pou && pou->copy_of ? project->pou[pou->copy_of - 1].word : word;
}

/* ---- calls of lists and boxes ---- */

/* The bounds that the arguments behind line @at give to POU @of, in the order of its arrays; -1: one has none, or
 * not so many. */
static int bounds_of_lines(struct scope *scope, const struct pou *caller, const struct il *il, int at, int of,
			   struct bounds *out)
{
	struct project *project = scope_project(scope);
	const struct var_table *vars = &project->pou[of].vars;
	int count = 0;

	for (int i = 0; i < vars->count; i++) {
		const char *name = project_text(project, vars->var[i].name);
		enum diag_id why;
		bool found = false;

		if (!vars->var[i].any_bounds)
			continue;
		for (int k = at + 1; k < il->count && il->line[k].kind != IL_CALL && !found &&
				     (il->line[k].kind == IL_ARG_IN || il->line[k].kind == IL_ARG_OUT); k++)
			found = il->line[k].pin && il->line[k].kind == IL_ARG_IN &&
				name_equal(project_text(project, il->line[k].pin), name) &&
				bounds_of(scope_find(scope, caller, il->line[k].operand, &why), &out[count]);
		if (!found || out[count].dims != (vars->var[i].dims > 1 ? vars->var[i].dims : 1))
			return -1;
		out[count++].var = i;
	}
	return count;
}

/* The copy of POU @of with these bounds; WORD_COUNT: there is none. */
static enum word copy_with(const struct project *project, int of, const struct bounds *bounds, int count)
{
	for (int i = of + 1; i < project->pou_count; i++) {
		bool same = project->pou[i].copy_of == of + 1;

		for (int k = 0; same && k < count; k++)
			same = has_bounds(&project->pou[i].vars.var[bounds[k].var], &bounds[k]);
		if (same)
			return project->pou[i].word;
	}
	return WORD_COUNT;
}

bool generic_lines(struct scope *scope, const struct pou *pou, struct il *il, struct arena *scratch)
{
	struct project *project = scope_project(scope);

	for (int i = 0; i < il->count; i++) {
		const int of = il->line[i].kind == IL_CALL ? generic_of(project, (enum word)il->line[i].word, WORD_FN) : -1;
		struct bounds *bounds;
		enum word word = WORD_COUNT;
		int count;

		if (of < 0)
			continue;
		bounds = arena_alloc(scratch, (size_t)project->pou[of].vars.count * sizeof(*bounds));
		if (!bounds)
			return false;
		count = bounds_of_lines(scope, pou, il, i, of, bounds);
		if (count >= 0)
			word = copy_with(project, of, bounds, count);
		if (word != WORD_COUNT)
			il->line[i].word = (uint16_t)word;
	}
	return true;
}

enum word generic_word(struct scope *scope, const struct pou *pou, struct expr *expr,
		       const struct expr_node *call, enum word word)
{
	struct project *project = scope_project(scope);
	const int of = generic_of(project, word, WORD_FN);
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
		if (!m || m->kind != MEANING_LITERAL || m->several)
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
	const int of = generic_of(project, word, WORD_FN);
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

/* The block whose ARRAY[*] the first call of the instance @m gives their bounds; -1: it has some, or needs none. */
static int block_of(const struct generic *g, const struct meaning *m)
{
	return m && m->kind == MEANING_INSTANCE && m->var && !m->through && m->var->type == IEC_NONE &&
	       m->var->fb == (enum word)m->word ? generic_of(g->project, (enum word)m->word, WORD_FB) : -1;
}

/* The instance @m gets the copy of block @of with these bounds. */
static void bind(struct generic *g, const struct meaning *m, int of, const struct bounds *bounds, int count)
{
	const struct var_table *table = m->pou ? &g->project->pou[m->pou - g->project->pou].vars : &g->project->globals;
	enum word word = copy_with(g->project, of, bounds, count);

	if (word == WORD_COUNT && add_copy(g->project, of, bounds, count))
		word = g->project->pou[g->project->pou_count - 1].word;
	g->failed |= word == WORD_COUNT;
	if (word != WORD_COUNT)
		table->var[m->index].fb = word;
}

static void note_lines(struct generic *g, int caller, const struct il *il)
{
	for (int i = 0; i < il->count && !g->failed; i++) {
		const bool cal = il->line[i].kind == IL_OP && il->line[i].op == OP_CAL;
		enum diag_id why;
		const struct meaning *m = cal ? scope_find(g->scope, &g->project->pou[caller], il->line[i].operand, &why) : NULL;
		const int of = cal ? block_of(g, m) : il->line[i].kind != IL_CALL ? -1 :
			       generic_of(g->project, (enum word)il->line[i].word, WORD_FN);
		struct bounds *bounds;
		int count;

		if (of < 0)
			continue;
		bounds = arena_alloc(&g->project->arena, (size_t)g->project->pou[of].vars.count * sizeof(*bounds));
		g->failed |= !bounds;
		count = bounds ? bounds_of_lines(g->scope, &g->project->pou[caller], il, i, of, bounds) : -1;
		if (count >= 0 && cal)
			bind(g, m, of, bounds, count);
		else if (count >= 0 && copy_with(g->project, of, bounds, count) == WORD_COUNT)
			g->failed |= !add_copy(g->project, of, bounds, count);
	}
}

/* A box, as the call of a list. */
static void note_box(struct generic *g, int caller, const struct cell *cell)
{
	struct names *names = &g->project->names;
	const char *next = project_text(g->project, cell->args);
	struct il_line line[LIMIT_ARGS + 1] = { { .kind = IL_CALL, .word = cell->word } };
	struct il il = { .line = line, .count = 1 };
	struct arg arg;

	if (generic_of(g->project, (enum word)cell->word, WORD_FB) >= 0)
		line[0] = (struct il_line){ .kind = IL_OP, .op = OP_CAL, .operand = cell->operand };
	else if (generic_of(g->project, (enum word)cell->word, WORD_FN) < 0)
		return;
	while (il.count <= LIMIT_ARGS && args_next(&next, &arg))
		if (!arg.output)
			line[il.count++] = (struct il_line){
				.kind = IL_ARG_IN, .pin = names_intern(names, arg.pin, arg.pin_len),
				.operand = names_intern(names, arg.value, arg.value_len),
			};
	note_lines(g, caller, &il);
}

static void note_rung(struct generic *g, int caller, const struct rung *rung)
{
	const struct names *names = &g->project->names;

	for (int i = 0; i < rung->rows * rung->cols && !rung->off && !g->failed; i++) {
		const struct cell *cell = &rung->cell[i];
		const enum operand_kind kind = words_row(&g->project->words, (enum word)cell->word)->operand;

		if (word_is_own((enum word)cell->word))
			note_box(g, caller, cell);
		if ((kind != OPND_EXPR && kind != OPND_ASSIGN) ||
		    !expr_parse_text(names_text(names, cell->operand), names_len(names, cell->operand), g->expr,
				     g->ignored, (struct diag){ .id = DIAG_COUNT }))
			continue;
		for (int k = 0; k < g->expr->count; k++)
			if (g->expr->node[k].op == EXPR_CALL)
				note_call(g, caller, &g->expr->node[k]);
	}
}

/* `Sorter(Row := Parts, Up := TRUE)` */
static void note_instance(struct generic *g, int caller, const struct st_item *item)
{
	const struct pou *pou = &g->project->pou[caller];
	const struct word_row *row;
	const struct meaning *m;
	struct bounds *bounds;
	struct st_part part;
	struct st_walk walk;
	enum diag_id why;
	int of, count = 0, pin = -1, wanted = 0;

	st_begin(&walk, &g->project->names, item);
	if (!st_next(&walk, &part, g->expr, g->ignored, (struct diag){ .id = DIAG_COUNT }) || part.role != ST_CALLED)
		return;
	m = scope_find(g->scope, pou, scope_first_of(g->scope, pou, g->expr, &g->expr->node[g->expr->root]), &why);
	of = block_of(g, m);
	if (of < 0)
		return;
	row = words_row(&g->project->words, (enum word)m->word);
	bounds = arena_alloc(&g->project->arena, (size_t)row->pin_count * sizeof(*bounds));
	g->failed |= !bounds;
	while (bounds && st_next(&walk, &part, g->expr, g->ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART) {
		const struct word_pin *by_place = part.role != ST_OPEN && !part.pin.len ? pin_next(row, &pin) : NULL;
		const int at = part.pin.len ? word_pin_find(row, part.pin.text, part.pin.len) :
					      by_place ? (int)(by_place - row->pin) : -1;
		const struct var_table *vars = &g->project->pou[of].vars;

		if (part.role != ST_INPUT || at < 0 || at >= vars->count || !vars->var[at].any_bounds)
			continue;
		if (count == row->pin_count || !bounds_at(g->scope, pou, g->expr, g->expr->root, &bounds[count]) ||
		    bounds[count].dims != (vars->var[at].dims > 1 ? vars->var[at].dims : 1))
			return;
		bounds[count++].var = at;
	}
	for (int i = 0; i < g->project->pou[of].vars.count; i++)
		wanted += g->project->pou[of].vars.var[i].any_bounds;
	if (bounds && count == wanted)
		bind(g, m, of, bounds, count);
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
	if (item->kind == ST_CALL)
		note_instance(g, caller, item);
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
		for (int k = 0; k < g->project->pou[i].rung_count && !pou_has_any_bounds(&g->project->pou[i]); k++)
			note_rung(g, i, g->project->pou[i].rung[k]);
		if (!pou_has_any_bounds(&g->project->pou[i]))
			note_lines(g, i, &g->project->pou[i].il);
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

/* Instances in @table that nobody calls have the first copy of their block, which add_uncalled() made. */
static void bind_uncalled(const struct project *project, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		const int of = table->var[i].type == IEC_NONE ? generic_of(project, table->var[i].fb, WORD_FB) : -1;

		if (of >= 0)
			table->var[i].fb = copy_with(project, of, NULL, 0);
	}
}

static void bind_all_uncalled(const struct project *project)
{
	bind_uncalled(project, &project->globals);
	for (int i = 0; i < project->pou_count; i++)
		if (!pou_has_any_bounds(&project->pou[i]))
			bind_uncalled(project, &project->pou[i].vars);
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
			g.failed = !add_uncalled(project, count);
			if (!g.failed)
				bind_all_uncalled(project);
			g.failed |= !shape_make(project, diags);
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

/* Instances have the type again that they are declared with. */
static void unbind(const struct project *project, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++)
		if (table->var[i].type == IEC_NONE)
			table->var[i].fb = generic_plain(project, table->var[i].fb);
}

void generic_end(struct project *project, int pous)
{
	unbind(project, &project->globals);
	for (int i = 0; i < pous; i++)
		unbind(project, &project->pou[i].vars);
	for (int i = pous; i < project->pou_count; i++) {
		struct word_row *row = project->pou[i].copy_of ? words_own(&project->words, project->pou[i].word) : NULL;

		if (row)
			row->owner = -1;
	}
}
