/* SPDX-License-Identifier: MIT
 *
 * statements - Structured Text as bodies of a chart and in EXECUTE boxes, for the walker: assignments, IF, WHILE, EXIT,
 * RETURN.
 *
 * A statement is found by its number; the end of a block by its depth. ladder_build() has checked
 * the text.
 */
#include "tests/walker/sfc.h"

#include "engine/model/st.h"

#include <stdlib.h>
#include <string.h>

#define ROUNDS_MAX 100000

struct texts {
	struct walker *walker;
	struct walked_pou *walked;
	const struct st *st;
	int first, end;
	bool good, leaves, breaks;
};

/* The assignment, or the condition of statement @at. */
static struct expression *expression_at(struct texts *run, int at)
{
	const struct names *names = &run->walker->project->names;
	struct expression **made = &run->walked->statement[at];
	struct diag_list *ignored = calloc(1, sizeof(*ignored));
	struct expr *expr = calloc(1, sizeof(*expr));
	struct st_part part;
	struct st_walk walk;

	st_begin(&walk, names, &run->st->item[at]);
	if (!*made && ignored && expr &&
	    st_next(&walk, &part, expr, ignored, (struct diag){ .id = DIAG_COUNT })) {
		char *text = strdup(part.text);

		if (text)
			*made = expression_new(run->walker, run->walked->frame, text);
		free(text);
	}
	free(expr);
	free(ignored);
	run->good &= *made != NULL;
	return *made;
}

static bool is_true(struct texts *run, int at)
{
	struct expression *expression = expression_at(run, at);

	return expression && expression_run(run->walker, expression, true);
}

/* The next statement at the depth of @at that is of one of @kinds, as bits. */
static int next_of(const struct texts *run, int at, uint32_t kinds)
{
	const int depth = run->st->item[at].depth;

	for (at++; at < run->end; at++)
		if (run->st->item[at].depth == depth && kinds >> run->st->item[at].kind & 1)
			return at;
	return run->end;
}

static void run_items(struct texts *run, int at, int end);

static int run_if(struct texts *run, int at)
{
	const uint32_t ways = 1u << ST_ELSIF | 1u << ST_ELSE | 1u << ST_END_IF;
	bool done = false;

	while (at < run->end && run->st->item[at].kind != ST_END_IF) {
		const int next = next_of(run, at, ways);

		if (!done && (run->st->item[at].kind == ST_ELSE || is_true(run, at))) {
			done = true;
			run_items(run, at + 1, next);
		}
		at = next;
	}
	return at;
}

static int run_while(struct texts *run, int at)
{
	const int end = next_of(run, at, 1u << ST_END_WHILE);

	for (int i = 0; run->good && !run->leaves && !run->breaks && is_true(run, at); i++) {
		run->good &= i < ROUNDS_MAX;
		run_items(run, at + 1, end);
	}
	run->breaks = false;
	return end;
}

static void run_assignment(struct texts *run, int at)
{
	struct expression *expression = expression_at(run, at);

	if (expression)
		expression_run(run->walker, expression, true);
}

static void run_items(struct texts *run, int at, int end)
{
	for (; at < end && run->good && !run->leaves && !run->breaks; at++) {
		const int kind = run->st->item[at].kind;

		if (kind == ST_ASSIGN)
			run_assignment(run, at);
		else if (kind == ST_IF)
			at = run_if(run, at);
		else if (kind == ST_WHILE)
			at = run_while(run, at);
		else if (kind == ST_RETURN)
			run->leaves = true;
		else if (kind == ST_EXIT)
			run->breaks = true;
		else
			run->good &= kind == ST_EMPTY || kind == ST_COMMENT;
	}
}

bool walk_statements(struct walker *walker, struct walked_pou *walked, int first, int count)
{
	const struct st *st = walked->pou->st;
	struct texts run = { .walker = walker, .walked = walked, .st = st, .first = first,
			     .end = first + count, .good = true };

	if (!walked->statement)
		walked->statement = arena_alloc(&walker->arena, ((size_t)st->count + 1) *
						sizeof(*walked->statement));
	if (!walked->statement)
		return false;
	run_items(&run, run.first, run.end);
	return run.good;
}
