/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_names - names the variables of a chart that becomes a ladder, and finds what its
 * steps call.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

#include "engine/base/ascii.h"
#include "engine/check/scope.h"

#include <stdio.h>
#include <string.h>

/* ---- names ---- */

uint32_t lad_fresh(struct lad *e, const char *base)
{
	struct names *names = &e->project->names;
	char text[LIMIT_NAME + 1];

	for (int i = 1; i < 100000; i++) {
		const int before = names->count;
		uint32_t id;

		snprintf(text, sizeof(text), i == 1 ? "%.120s" : "%.120s_%d", base, i);
		id = names_intern(names, text, strlen(text));
		if (!id)
			break;
		if (names->count > before && names_fold(names, id) == id)
			return id;
	}
	e->good = false;
	return 0;
}

/* @text with _ for each character that a name cannot have. */
static char *plain(struct lad *e, const char *text)
{
	char *out = lad_text(e, "%s", text + (*text == '%'));

	for (char *c = out; *c; c++)
		if (!lad_letter(*c))
			*c = '_';
	return out;
}

static void make_var(struct lad *e, struct lad_var *var, const char *type,
		     const char *base, const char *comment)
{
	*var = (struct lad_var){ .type = type, .comment = comment,
				 .name = lad_fresh(e, base) };
}

static void name_steps(struct lad *e)
{
	static const struct { const char *end, *type; } kind[LAD_STEP_VARS] = {
		[LAD_X] = { "X", "BOOL" }, [LAD_T] = { "T", "TIME" },
		[LAD_START] = { "Start", "BOOL" }, [LAD_LEFT] = { "Left", "BOOL" },
		[LAD_END] = { "End", "BOOL" }, [LAD_STARTED] = { "Started", "BOOL" },
		[LAD_ENDED] = { "Ended", "BOOL" }, [LAD_FORCED] = { "Forced", "BOOL" },
	};

	for (int i = 0; i < e->sfc->step_count; i++)
		for (int k = 0; k < LAD_STEP_VARS; k++)
			make_var(e, &e->step[i][k], kind[k].type,
				 lad_text(e, "%s_%s", lad_name(e, i), kind[k].end),
				 k == LAD_X ? lad_text(e, "step %s", lad_name(e, i)) :
				 k == LAD_T ? lad_text(e, "time in %s", lad_name(e, i)) :
				 NULL);
}

static const char *first_name(const struct lad *e, int ref)
{
	return project_text(e->project, e->sfc->ref[ref].name);
}

static void name_arcs(struct lad *e)
{
	for (int i = 0; i < e->net.arc_count; i++) {
		const struct sfc_transition *t =
			&e->sfc->transition[e->net.arc[i].transition];
		const char *base = t->name ?
			lad_text(e, "%s_Fires", project_text(e->project, t->name)) :
			lad_text(e, "%s_%s",
				 t->from_count ? first_name(e, t->first_from) : "In",
				 t->to_count ? first_name(e, t->first_to) : "Out");

		make_var(e, &e->arc[i][LAD_FIRES], "BOOL", base, NULL);
		make_var(e, &e->arc[i][LAD_RESULT], "BOOL",
			 lad_text(e, "%s_Result", base), NULL);
		make_var(e, &e->arc[i][LAD_TRUE], "BOOL",
			 lad_text(e, "%s_True", base), NULL);
	}
}

static void name_lines(struct lad *e)
{
	static const struct { const char *end, *type; } kind[LAD_LINE_VARS] = {
		[LAD_STORED] = { "", "BOOL" }, [LAD_SINCE] = { "_T", "TIME" },
		[LAD_ARMED] = { "_Waits", "BOOL" }, [LAD_ALLOWED] = { "_Time", "BOOL" },
	};

	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];
		const char *what = plain(e, project_text(e->project, use->operand));

		for (int k = 0; k < LAD_LINE_VARS; k++)
			make_var(e, &e->line[i][k], kind[k].type,
				 lad_text(e, "%s_%s_%s%s", lad_name(e, use->step), what,
					  qualifier_word(use->qualifier), kind[k].end),
				 NULL);
	}
}

static void name_sfc(struct lad *e)
{
	static const struct { const char *end, *type; } kind[LAD_SFC_VARS] = {
		[LAD_RUNS] = { "Runs", "BOOL" }, [LAD_FIRST] = { "First", "BOOL" },
		[LAD_CLOCK] = { "Clock", "TON" }, [LAD_PASSED] = { "Passed", "TIME" },
		[LAD_LAST] = { "Last", "TIME" }, [LAD_ANEW] = { "Anew", "BOOL" },
		[LAD_STANDS] = { "Stands", "BOOL" },
		[LAD_CHANGED] = { "Changed", "BOOL" }, [LAD_NUMBER] = { "Number", "" },
		[LAD_SET] = { "Forced", "BOOL" }, [LAD_GO] = { "Go", "BOOL" },
		[LAD_HAND] = { "ByHand", "BOOL" }, [LAD_ONCE] = { "Once", "BOOL" },
		[LAD_ROUNDS] = { "Rounds", "INT" }, [LAD_FIRED] = { "Fired", "BOOL" },
	};
	const char *name = project_text(e->project, e->pou->name);

	for (int k = 0; k < LAD_SFC_VARS; k++)
		make_var(e, &e->whole[k], kind[k].type,
			 lad_text(e, "%s_%s", name, kind[k].end), NULL);
	e->steps_name = lad_fresh(e, lad_text(e, "%s_Steps", name));
	e->outputs_name = lad_fresh(e, lad_text(e, "%s_Outputs", name));
	e->again = lad_fresh(e, lad_text(e, "%s_Again", name));
	e->round = lad_is_in_order(e) ? lad_fresh(e, lad_text(e, "%s_Round", name)) : 0;
	for (int i = 0; i < sfc_bodies(e->sfc); i++) {
		const int action = i - e->sfc->transition_count;

		e->body[i] = lad_fresh(e, action < 0 ?
			lad_text(e, "%s_Condition%d", name, i + 1) :
			lad_text(e, "%s_%s", name, project_text(e->project,
				e->sfc->action[action].name)));
	}
}

/* ---- actions and BOOLs that steps call ---- */

static bool overlaps(struct iec_addr a, struct iec_addr b)
{
	const uint64_t first = a.byte * 8u + a.bit, last = first + a.bits;
	const uint64_t other = b.byte * 8u + b.bit;

	return a.area == b.area && a.area != AREA_NONE && first < other + b.bits &&
	       other < last;
}

static bool is_same(const struct xref_target *a, const struct xref_target *b)
{
	if (a->what == XREF_VARIABLE && b->what == XREF_VARIABLE &&
	    a->table == b->table && a->index == b->index)
		return true;
	return overlaps(a->addr, b->addr);
}

/* Is this use in a line of a step other than SET and RESET? */
static bool is_line(const struct lad *e, const struct xref_use *use)
{
	for (int i = 0; i < e->sfc->use_count; i++)
		if (use->slot == &e->sfc->use[i].operand)
			return e->sfc->use[i].kind == USE_ACTION;
	return false;
}

static bool is_written(const struct xref_use *use)
{
	return use->kind != XREF_DECLARED && use->kind != XREF_READ &&
	       use->kind != XREF_TYPE;
}

static bool has_value(const struct lad *e, const struct xref_target *target)
{
	const struct var_table *table = target->table ?
		&e->project->pou[target->table - 1].vars : &e->project->globals;

	return target->what == XREF_VARIABLE &&
	       (target->table > e->project->pou_count || table->var[target->index].has_init);
}

/* Do only lines of steps write the variable of line @number? */
static bool is_alone(const struct lad *e, int number)
{
	const struct xref_use *mine = NULL;

	for (int i = 0; !mine && i < e->xref->count; i++)
		if (e->xref->use[i].slot == &e->sfc->use[number].operand)
			mine = &e->xref->use[i];
	if (!mine || has_value(e, &mine->target))
		return false;
	for (int i = 0; i < e->xref->count; i++) {
		const struct xref_use *use = &e->xref->use[i];

		if (is_same(&use->target, &mine->target) &&
		    ((is_written(use) && !is_line(e, use)) || use->open ||
		     has_value(e, &use->target)))
			return false;
	}
	return true;
}

/* For each line, finds the first line with the same BOOL, in any spelling. */
static bool find_same(struct lad *e)
{
	const size_t lines = (size_t)e->sfc->use_count + 1;
	struct scope *scope = scope_new(e->project, e->arena);
	const struct meaning **m = arena_alloc(e->arena, lines * sizeof(*m));
	const struct names *names = &e->project->names;
	enum diag_id why;

	e->same = arena_alloc(e->arena, lines * sizeof(*e->same));
	if (!scope || !m || !e->same)
		return false;
	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = e->sfc->use;
		int k = 0;

		e->same[i] = i;
		if (use[i].kind != USE_ACTION || use[i].action >= 0)
			continue;
		m[i] = scope_find(scope, e->pou, use[i].operand, &why);
		for (; k < i; k++)
			if (use[k].kind == USE_ACTION && use[k].action < 0 &&
			    (names_fold(names, use[k].operand) ==
			     names_fold(names, use[i].operand) ||
			     (m[i] && m[k] && meaning_same(m[i], m[k]))))
				break;
		e->same[i] = k < i ? e->same[k] : i;
	}
	return true;
}

/* Are the times of all lines with this BOOL literals? */
static bool has_fixed_times(const struct lad *e, int line)
{
	for (int i = 0; i < e->sfc->use_count; i++) {
		const struct sfc_use *use = &e->sfc->use[i];

		if (use->time && e->same[i] == line &&
		    !strchr(project_text(e->project, use->time), '#'))
			return false;
	}
	return true;
}

static void add_called(struct lad *e, int action, uint32_t operand, int use)
{
	struct lad_called *called;
	const char *base;

	if (action < 0 && e->same[use] != use)
		return;
	called = &e->called[e->called_count++];
	*called = (struct lad_called){ .action = action, .operand = operand, .use = use };
	called->alone = action < 0 && is_alone(e, use) && has_fixed_times(e, use);
	base = plain(e, project_text(e->project, operand));
	make_var(e, &called->var[LAD_CALLED], "BOOL", lad_text(e, "%s_Called", base), NULL);
	make_var(e, &called->var[LAD_LEVEL], "BOOL", lad_text(e, "%s_Level", base), NULL);
	make_var(e, &called->var[LAD_WAS], "BOOL", lad_text(e, "%s_Was", base), NULL);
}

static void find_called(struct lad *e)
{
	for (int i = 0; i < e->sfc->action_count; i++)
		add_called(e, i, e->sfc->action[i].name, -1);
	for (int i = 0; i < e->sfc->use_count; i++)
		if (e->sfc->use[i].kind == USE_ACTION && e->sfc->use[i].action < 0)
			add_called(e, -1, e->sfc->use[i].operand, i);
}

void lad_names(struct lad *e)
{
	name_steps(e);
	name_arcs(e);
	name_lines(e);
	name_sfc(e);
	if (find_same(e))
		find_called(e);
	else
		e->good = false;
}
