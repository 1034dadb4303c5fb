/* SPDX-License-Identifier: MIT
 *
 * check_calls - calls between POUs: no circle, and not too deep; what never runs.
 *
 * A call of a function or function block of the project is a step from POU to POU.
 * The steps are walked depth first, without recursion, each list once.
 */
#include "engine/check/check_il.h"

#include "engine/model/shape.h"

#include <stdio.h>

enum state { STATE_OPEN, STATE_WORKING, STATE_DONE };

struct calls {
	struct scope *scope;
	const struct project *project;
	const struct il_pou *list;
	struct diag_list *diags;
	uint8_t *state;   /* by POU                                          */
	uint8_t *called;  /* by POU                                          */
	int *deep;        /* by POU: calls inside one another from it on     */
	int *stack, *at;  /* stack of POUs; next line of each, twice: an instance, its action */
	int depth;
	bool good;
};

/* The POU that a line calls; -1: none. @action: of an action of an instance the action, not the block. */
static int callee(struct calls *c, const struct pou *pou,
		  const struct il_line *line, bool action)
{
	const struct meaning *m;
	const struct pou *to = NULL;
	enum diag_id why;

	if (line->kind == IL_OP && line->op == OP_CAL)
		to = scope_pou(c->scope, pou, line->operand);
	if (to)
		return (int)(to - c->project->pou);

	if (line->kind == IL_FN || line->kind == IL_CALL)
		to = shape_pou(c->project, (enum word)line->word);
	if (line->kind == IL_OP && line->op == OP_CAL) {
		m = scope_find(c->scope, pou, line->operand, &why);
		if (m && m->kind == MEANING_INSTANCE && m->action && action)
			to = &c->project->pou[m->action - 1];
		else if (m && m->kind == MEANING_INSTANCE)
			to = shape_pou(c->project, m->word);
	}
	return to ? (int)(to - c->project->pou) : -1;
}

static void report(struct calls *c, const struct il_line *line,
		   enum diag_id id, const char *arg)
{
	const struct pou *pou = c->list[c->stack[c->depth - 1]].pou;

	c->good = diag_add(c->diags, il_place(c->scope, pou, line, id), "%s", arg);
}

static const char *name_of(struct calls *c, int pou)
{
	return scope_text(c->scope, c->list[pou].pou->name);
}

/* "A -> B -> A" */
static void report_circle(struct calls *c, const struct il_line *line, int again)
{
	char text[2 * LIMIT_ARG] = "";
	size_t used = 0;
	int from = 0;

	while (c->stack[from] != again)
		from++;
	for (int i = from; i < c->depth && used < LIMIT_ARG; i++)
		used += (size_t)snprintf(text + used, sizeof(text) - used,
					 "%.40s -> ", name_of(c, c->stack[i]));
	if (used < LIMIT_ARG)
		snprintf(text + used, sizeof(text) - used, "%.40s",
			 name_of(c, again));
	report(c, line, DIAG_RECURSION, text);
}

static void begin(struct calls *c, int pou)
{
	c->state[pou] = STATE_WORKING;
	c->stack[c->depth] = pou;
	c->at[c->depth++] = 0;
}

/* Takes one line of the POU on top of the stack; pushes the POU that it calls, unless that was
 * visited. */
static void step(struct calls *c)
{
	int top = c->stack[c->depth - 1];
	const struct il *il = c->list[top].il;
	const struct il_line *line;
	int to;

	if (c->at[c->depth - 1] == 2 * il->count) {
		c->state[top] = STATE_DONE;
		c->depth--;
		return;
	}
	line = &il->line[c->at[c->depth - 1] / 2];
	to = callee(c, c->list[top].pou, line, c->at[c->depth - 1] % 2);
	if (c->at[c->depth - 1] % 2 && to == callee(c, c->list[top].pou, line, false)) {
		c->at[c->depth - 1]++;
		return;
	}
	if (to >= 0)
		c->called[to] = 1;
	if (to >= 0 && c->state[to] == STATE_OPEN) {
		begin(c, to);
		return;
	}
	c->at[c->depth - 1]++;
	if (to < 0)
		return;
	if (c->state[to] == STATE_WORKING) {
		report_circle(c, line, to);
		return;
	}
	if (c->deep[to] + 1 > c->deep[top])
		c->deep[top] = c->deep[to] + 1;
	if (c->deep[top] == LIMIT_CALLS + 1) {
		report(c, line, DIAG_TOO_DEEP, name_of(c, to));
		c->deep[top] = 0;
	}
}

/* Does the configuration run programs, but not this one? Without any PROGRAM line all run. */
static bool is_left_out(struct calls *c, const struct pou *pou)
{
	struct names *names = &scope_project(c->scope)->names;
	const struct config *config = c->project->config;
	bool any = false, runs = false;

	for (int i = 0; config && i < config->count; i++) {
		any |= config->entry[i].kind == CONFIG_PROGRAM;
		runs |= config->entry[i].pou && names_fold(names, config->entry[i].pou) ==
						names_fold(names, pou->name);
	}
	return any && !runs;
}

/* Warns of a SUBROUTINE that nothing calls, and of a PROGRAM that runs in no task either. */
static void warn_of_uncalled(struct calls *c, int count)
{
	for (int i = 0; i < count; i++) {
		const struct pou *pou = c->list[i].pou;
		struct diag place = { .id = pou->kind == POU_PROGRAM ? DIAG_NOT_RUN : DIAG_NEVER_CALLED,
				      .file = pou->file, .line = pou->line, .pou = name_of(c, i) };

		if (!c->called[i] && (pou->kind == POU_SUBROUTINE || pou->kind == POU_ACTION ||
				      (pou->kind == POU_PROGRAM && is_left_out(c, pou))))
			diag_add(c->diags, place, "%s", name_of(c, i));
	}
}

/* Is @pou the program of this name, or one of its actions? */
static bool is_of_program(struct calls *c, const struct pou *pou, uint32_t name)
{
	struct names *names = &scope_project(c->scope)->names;
	const int owner = pou->kind == POU_ACTION ? pou_owner(c->project, pou) : -1;
	const struct pou *program = owner >= 0 ? &c->project->pou[owner] : pou;

	return program->kind == POU_PROGRAM && names_fold(names, program->name) == names_fold(names, name);
}

/* A block that a task of its own calls is not called by its program. */
static void check_block_tasks(struct calls *c, int count, const struct config_entry *entry)
{
	struct names *names = &scope_project(c->scope)->names;

	for (int i = 0; i < count && entry->calls; i++) {
		const struct pou *pou = c->list[i].pou;

		if (!is_of_program(c, pou, entry->pou))
			continue;
		for (int k = 0; k < c->list[i].il->count; k++) {
			const struct il_line *line = &c->list[i].il->line[k];

			for (int n = 0; n < entry->calls; n++)
				if (line->kind == IL_OP && line->op == OP_CAL &&
				    names_fold(names, line->operand) == names_fold(names, entry->called[n].name))
					c->good = diag_add(c->diags, il_place(c->scope, pou, line, DIAG_BLOCK_CALLED), "%s",
							   scope_text(c->scope, line->operand));
		}
	}
}

bool check_calls(struct scope *scope, const struct il_pou *list, int count,
		 struct arena *scratch, struct diag_list *diags)
{
	size_t size = (size_t)count + 1;
	struct calls c = {
		.scope = scope, .project = scope_project(scope), .list = list,
		.diags = diags, .good = true,
	};

	c.state = arena_alloc(scratch, size);
	c.called = arena_alloc(scratch, size);
	c.deep = arena_alloc(scratch, size * sizeof(int));
	c.stack = arena_alloc(scratch, size * sizeof(int));
	c.at = arena_alloc(scratch, size * sizeof(int));
	if (!c.state || !c.called || !c.deep || !c.stack || !c.at)
		return false;
	for (int i = 0; i < count; i++) {
		if (c.state[i] == STATE_OPEN)
			begin(&c, i);
		while (c.depth > 0)
			step(&c);
	}
	warn_of_uncalled(&c, count);
	for (int i = 0; c.project->config && i < c.project->config->count; i++)
		check_block_tasks(&c, count, &c.project->config->entry[i]);
	return c.good;
}
