/* SPDX-License-Identifier: MIT
 *
 * check_tokens - reports what tokens.c found about the states of a chart.
 *
 * Each message holds a shortest way to the state. Consequences of a reported finding are
 * not reported.
 */
#include "engine/check/check_tokens.h"

#include "engine/base/ascii.h"
#include "engine/check/tokens.h"

#include <stdio.h>
#include <string.h>

#define WAY 4000 /* bytes of a way before it is cut                            */
#define SOME 5   /* findings of a kind to report                               */

struct teller {
	struct project *project;
	const struct pou *pou;
	const struct sfc *sfc;
	struct tokens tokens;
	struct arena *scratch;
	struct diag_list *diags;
	char *way;
};

static const char *name_of(const struct teller *c, int step)
{
	return project_text(c->project, c->sfc->step[step].name);
}

static void report(struct teller *c, enum diag_id id, int line, int column,
		   const char *arg)
{
	const struct diag place = {
		.id = id, .file = c->pou->file, .line = line, .column = column,
		.pou = project_text(c->project, c->pou->name),
	};

	diag_add(c->diags, place, "%s", arg);
}

static void report_step(struct teller *c, enum diag_id id, int step, const char *arg)
{
	report(c, id, c->sfc->step[step].line, c->sfc->step[step].column_at, arg);
}

/* ---- constants ---- */

/* By transition: 1 for TRUE, 2 for FALSE. NULL: no memory. */
static uint8_t *constants(struct teller *c)
{
	uint8_t *out = arena_alloc(c->scratch, (size_t)c->sfc->transition_count + 1);

	for (int i = 0; out && i < c->sfc->transition_count; i++) {
		const struct sfc_body *body = &c->sfc->transition[i].condition;
		const char *text;

		if (body->kind != BODY_EXPRESSION || !body->count)
			continue;
		text = project_text(c->project,
				    rung_at(c->pou->rung[body->first], 0, 0)->operand);
		out[i] = ascii_is("TRUE", text, strlen(text)) ? 1 :
			 ascii_is("FALSE", text, strlen(text)) ? 2 : 0;
	}
	return out;
}

/* ---- ways ---- */

static size_t put(char *out, size_t used, const char *text)
{
	const size_t len = strlen(text);

	if (used + len >= WAY)
		return used;
	memcpy(out + used, text, len + 1);
	return used + len;
}

/* Active steps; of a macro-step, the steps inside it. */
static size_t put_bits(const struct teller *c, size_t used, const uint64_t *bits)
{
	const char *between = "";

	for (int i = 0; i < c->sfc->step_count; i++) {
		if (!(bits[i / 64] >> i % 64 & 1) ||
		    c->sfc->step[i].kind == STEP_MACRO)
			continue;
		used = put(c->way, used, between);
		used = put(c->way, used, name_of(c, i));
		between = " + ";
	}
	return used;
}

static size_t put_steps(const struct teller *c, size_t used, const struct sfc_steps *steps)
{
	const char *between = "";

	for (int i = 0; i < steps->count; i++) {
		if (c->sfc->step[steps->step[i]].kind == STEP_MACRO)
			continue;
		used = put(c->way, used, between);
		used = put(c->way, used, name_of(c, steps->step[i]));
		between = " + ";
	}
	return used;
}

/* The end of a way to a state, as much as there is room for, after "...". */
static const char *cut(char *way, size_t used, size_t room)
{
	static const char dots[] = "...";
	char *at = used < room ? way : way + used - room + 1;

	if (at == way)
		return way;
	for (char *next = at + 3; next < way + used; next++)
		if (strncmp(next, " -> ", 4) == 0) {
			memcpy(next - 3, dots, 3);
			return next - 3;
		}
	return at; /* one state alone is too long: its end */
}

/* The way to @state, and @arc, if any, that fires there. */
static const char *way_to(struct teller *c, const char *head, int state, int arc)
{
	const struct tokens *t = &c->tokens;
	const size_t begin = strlen(head);
	int *back, count = 0;
	size_t used = 0;

	back = arena_alloc(c->scratch, ((size_t)t->states.count + 1) * sizeof(int));
	if (!back)
		return "";
	for (int at = state; at >= 0; at = t->states.before[at])
		back[count++] = at;
	while (count > 0) {
		/* The message has room only for the end of a long way. */
		if (used > WAY / 2)
			used = 0;
		used = put_bits(c, used, tokens_state(t, back[--count]));
		if (count > 0)
			used = put(c->way, used, " -> ");
	}
	if (arc >= 0) {
		used = put(c->way, used, " -> ");
		used = put_steps(c, used, &t->net.arc[arc].to);
	}
	return cut(c->way, used, begin < LIMIT_ARG ? LIMIT_ARG - begin : 1);
}

static void report_way(struct teller *c, enum diag_id id, int line, int column,
		       const char *name, int state, int arc)
{
	char head[40], arg[2 * LIMIT_ARG];

	snprintf(head, sizeof(head), "%.30s%s", name, *name ? DIAG_AND : "");
	snprintf(arg, sizeof(arg), "%s%.*s", head, LIMIT_ARG,
		 way_to(c, head, state, arc));
	report(c, id, line, column, arg);
}

/* ---- warnings about the states ---- */

static void tell_find(struct teller *c, const struct token_find *find)
{
	const struct sfc_step *step = &c->sfc->step[find->step];
	const struct sfc_transition *t = find->arc < 0 ? NULL :
		&c->sfc->transition[c->tokens.net.arc[find->arc].transition];

	switch (find->kind) {
	case TOKEN_TWICE:
		report_way(c, DIAG_SFC_ENTERED_TWICE, step->line, step->column_at,
			   name_of(c, find->step), find->state, find->arc);
		break;
	case TOKEN_DEAD:
		report_way(c, DIAG_SFC_DEAD_END, step->line, step->column_at, "",
			   find->state, -1);
		break;
	case TOKEN_LEFT:
		report_way(c, DIAG_SFC_GROUP, t->line, t->column, "", find->state,
			   find->arc);
		break;
	}
}

/* Reports steps of different branches that meet, and a branch that leaves the others. */
static void tell_strange(struct teller *c)
{
	const struct tokens *tokens = &c->tokens;
	int told = 0;

	for (int i = 0; i < tokens->net.arc_count && told < SOME; i++) {
		const struct sfc_arc *arc = &tokens->net.arc[i];
		const struct sfc_transition *t = &c->sfc->transition[arc->transition];
		size_t used;

		if (!tokens->strange[i])
			continue;
		used = put_steps(c, 0, &arc->from);
		used = put(c->way, used, " -> ");
		put_steps(c, used, &arc->to);
		report(c, DIAG_SFC_GROUP, t->line, t->column, c->way);
		told++;
	}
}

static void tell_found(struct teller *c)
{
	const struct tokens *t = &c->tokens;
	int told[TOKEN_LEFT + 1] = { 0 };
	char text[40];

	for (int i = 0; i < t->find_count; i++)
		if (told[t->find[i].kind]++ < SOME)
			tell_find(c, &t->find[i]);
	if (t->find_count && !told[TOKEN_LEFT])
		tell_strange(c);
	if (!t->gave_up)
		return;
	snprintf(text, sizeof(text), "%d", t->states.count);
	report(c, DIAG_SFC_GAVE_UP, c->pou->line, 0, text);
}

/* ---- steps that are never reached ---- */

/* Reports an unreachable step, without the steps that are unreachable only because of it. */
static void skip_behind(const struct tokens *t, uint8_t *told, int *queue, int step)
{
	int count = 0;

	if (t->reached[step] || told[step])
		return;
	told[step] = 1;
	queue[count++] = step;
	while (count > 0) {
		step = queue[--count];
		for (int i = t->first[step]; i < t->first[step + 1]; i++) {
			const struct sfc_steps *to = &t->net.arc[t->leaving[i]].to;

			for (int k = 0; k < to->count; k++) {
				const int next = to->step[k];

				if (t->reached[next] || told[next])
					continue;
				told[next] = 1;
				queue[count++] = next;
			}
		}
	}
}

/* Are the steps behind FROM reached, each for itself? */
static bool is_wanted(const struct tokens *t, int arc)
{
	const struct sfc_steps *from = &t->net.arc[arc].from;

	for (int i = 0; i < from->count; i++)
		if (!t->reached[from->step[i]])
			return false;
	return from->count;
}

static void tell_never(struct teller *c, uint8_t *told, int *queue)
{
	const struct tokens *t = &c->tokens;

	for (int i = 0; i < t->net.arc_count; i++) {
		const struct sfc_arc *arc = &t->net.arc[i];
		const struct sfc_transition *at = &c->sfc->transition[arc->transition];
		size_t used;

		if (t->fires[i] || !is_wanted(t, i))
			continue;
		used = put_steps(c, 0, &arc->from);
		used = put(c->way, used, " -> ");
		put_steps(c, used, &arc->to);
		report(c, DIAG_SFC_NEVER_FIRES, at->line, at->column, c->way);
		for (int k = 0; k < arc->to.count; k++)
			skip_behind(t, told, queue, arc->to.step[k]);
	}
}

/* check_sfc has reported steps to which nothing leads. */
static void skip_orphans(const struct teller *c, uint8_t *told, int *queue)
{
	const struct tokens *t = &c->tokens;
	uint8_t *entered = arena_alloc(c->scratch, (size_t)c->sfc->step_count + 1);

	for (int i = 0; entered && i < t->net.arc_count; i++)
		for (int k = 0; k < t->net.arc[i].to.count; k++)
			entered[t->net.arc[i].to.step[k]] = 1;
	for (int i = 0; entered && i < c->sfc->step_count; i++) {
		const int macro = c->sfc->step[i].macro;

		if (!entered[i] || (macro >= 0 && !t->reached[macro] && told[macro]))
			skip_behind(t, told, queue, i);
	}
}

static void tell_unreached(struct teller *c)
{
	const struct tokens *t = &c->tokens;
	uint8_t *told = arena_alloc(c->scratch, (size_t)c->sfc->step_count + 1);
	int *queue = arena_alloc(c->scratch, ((size_t)c->sfc->step_count + 1) *
				 sizeof(int));

	if (!told || !queue)
		return;
	tell_never(c, told, queue);
	skip_orphans(c, told, queue);
	for (int i = 0; i < c->sfc->step_count; i++) {
		if (t->reached[i] || told[i])
			continue;
		report_step(c, DIAG_SFC_UNREACHED, i, name_of(c, i));
		skip_behind(t, told, queue, i);
	}
}

/* IN ORDER transitions may have no step before or after them; the states do not show what is
 * active then. */
static bool is_open(const struct sfc *sfc)
{
	for (int i = 0; i < sfc->transition_count; i++)
		if (!sfc->transition[i].from_count || !sfc->transition[i].to_count)
			return true;
	return false;
}

void check_tokens(struct scope *scope, const struct pou *pou, struct arena *scratch,
		  struct diag_list *diags)
{
	struct teller c = { .project = scope_project(scope), .pou = pou,
			    .sfc = pou->sfc, .scratch = scratch, .diags = diags };
	const uint8_t *always = constants(&c);

	if (is_open(c.sfc))
		return;
	c.way = arena_alloc(scratch, WAY + 1);
	if (!c.way || !always || !tokens_begin(&c.tokens, c.sfc, always, scratch))
		return;
	if (!tokens_prove(&c.tokens)) {
		if (scratch->failed || !tokens_walk(&c.tokens))
			return;
		tell_found(&c);
		/* A chart with errors is not fully known; a warning about it could be
		 * wrong. */
		if ((c.tokens.find_count || c.tokens.gave_up) &&
		    !tokens_bound(&c.tokens))
			return;
	}
	tell_unreached(&c);
}
