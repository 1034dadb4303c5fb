/* SPDX-License-Identifier: MIT
 *
 * sfc - a chart of a few words, without the reader of rung files.
 *
 * Items stand between semicolons: `I Name` an initial step, `S Name` a step, `M Name`
 * a macro-step and `E` its end, `T A,B>C,D` a transition whose condition is an input,
 * `T A>B=TRUE` with that expression, `T A>B=` without a condition, `A Name` an empty
 * action, `L Name Q Time` a line of the step before it; `O`: the chart is IN ORDER, and
 * either side of `>` may be empty.
 */
#ifndef TESTS_SFC_H
#define TESTS_SFC_H

#include "engine/model/project.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct test_sfc {
	struct project *project;
	struct pou *pou;
	struct sfc *sfc;
	int macro[LIMIT_MACROS + 1], depth;
};

static inline uint32_t sfc_id(struct test_sfc *c, const char *text, size_t len)
{
	return names_intern(&c->project->names, text, len);
}

static inline void *push_room(struct test_sfc *c, void *vector, int *count, size_t size)
{
	void *slot = arena_push(&c->project->arena, vector, count, size);

	if (!slot)
		abort();
	return slot;
}

static inline void sfc_note(struct test_sfc *c, enum piece_kind kind, int index)
{
	struct sfc_piece *piece = push_room(c, &c->sfc->piece, &c->sfc->piece_count,
					   sizeof(*piece));

	*piece = (struct sfc_piece){ kind, index };
}

/* The word from @at on, up to one of @ends; @at moves behind it. */
static inline uint32_t read_sfc_word(struct test_sfc *c, const char **at, const char *ends)
{
	const size_t len = strcspn(*at, ends);
	const uint32_t id = sfc_id(c, *at, len);

	*at += len;
	return id;
}

static inline void sfc_step(struct test_sfc *c, const char *text, enum step_kind kind)
{
	struct sfc *sfc = c->sfc;
	struct sfc_step *step = push_room(c, &sfc->step, &sfc->step_count,
					  sizeof(*step));

	*step = (struct sfc_step){ .kind = kind, .macro = c->macro[c->depth],
				   .name = read_sfc_word(c, &text, " "),
				   .first_use = sfc->use_count,
				   .line = 10 + sfc->step_count };
	sfc_note(c, PIECE_STEP, sfc->step_count - 1);
	if (kind == STEP_MACRO)
		c->macro[++c->depth] = sfc->step_count - 1;
}

static inline int sfc_refs(struct test_sfc *c, const char **at)
{
	int count = 0;

	while (**at && !strchr(">=", **at)) {
		struct sfc_ref *ref = push_room(c, &c->sfc->ref, &c->sfc->ref_count,
						sizeof(*ref));

		*ref = (struct sfc_ref){ .name = read_sfc_word(c, at, ",>="),
					 .line = 100 + c->sfc->transition_count };
		*at += **at == ',';
		count++;
	}
	return count;
}

static inline struct rung *sfc_rung(struct test_sfc *c, const char *expression)
{
	struct rung *rung = rung_new(1, 2);

	if (!rung)
		abort();
	rung_cell(rung, 0, 0)->word = ELEM_COMPARE;
	rung_cell(rung, 0, 0)->operand = sfc_id(c, expression, strlen(expression));
	rung_cell(rung, 0, 1)->word = ELEM_COIL;
	rung_cell(rung, 0, 1)->operand = sfc_id(c, SFC_CONDITION,
						strlen(SFC_CONDITION));
	rung->line = (uint32_t)(100 + c->sfc->transition_count);
	if (!project_add_rung(c->pou, c->pou->rung_count, rung))
		abort();
	return rung;
}

static inline void sfc_transition(struct test_sfc *c, const char *text)
{
	struct sfc *sfc = c->sfc;
	struct sfc_transition *t = push_room(c, &sfc->transition,
					     &sfc->transition_count, sizeof(*t));

	*t = (struct sfc_transition){ .macro = c->macro[c->depth],
		.line = 100 + sfc->transition_count, .first_from = sfc->ref_count };
	t->from_count = sfc_refs(c, &text);
	text += *text == '>';
	t->first_to = sfc->ref_count;
	t->to_count = sfc_refs(c, &text);
	sfc_note(c, PIECE_TRANSITION, sfc->transition_count - 1);
	if (strcmp(text, "=") == 0)
		return;
	sfc_rung(c, *text ? text + 1 : "%IX0.0");
	t->condition = (struct sfc_body){ BODY_EXPRESSION, c->pou->rung_count - 1, 1 };
}

static inline void sfc_action(struct test_sfc *c, const char *text)
{
	struct sfc_action *action = push_room(c, &c->sfc->action,
					      &c->sfc->action_count, sizeof(*action));

	*action = (struct sfc_action){ .name = read_sfc_word(c, &text, " "),
				       .line = 200 + c->sfc->action_count };
	sfc_note(c, PIECE_ACTION, c->sfc->action_count - 1);
}

/* Of the last step. */
static inline void sfc_line(struct test_sfc *c, const char *text)
{
	struct sfc_use *use = push_room(c, &c->sfc->use, &c->sfc->use_count,
					sizeof(*use));
	struct sfc_step *step = &c->sfc->step[c->sfc->step_count - 1];
	const char *word;

	*use = (struct sfc_use){ .operand = read_sfc_word(c, &text, " "),
				 .line = 300 + c->sfc->use_count,
				 .step = c->sfc->step_count - 1 };
	step->use_count++;
	word = text += *text == ' ';
	text += strcspn(text, " ");
	if (text - word == 3 && memcmp(word, "SET", 3) == 0)
		use->kind = USE_SET;
	else
		use->qualifier = qualifier_find(word, (size_t)(text - word));
	text += *text == ' ';
	if (*text)
		use->time = read_sfc_word(c, &text, "");
}

static inline void sfc_piece(struct test_sfc *c, const char *text)
{
	const char *rest = text + 1 + (text[1] == ' ');

	switch (*text) {
	case 'I': sfc_step(c, rest, STEP_INITIAL); break;
	case 'S': sfc_step(c, rest, STEP_PLAIN); break;
	case 'M': sfc_step(c, rest, STEP_MACRO); break;
	case 'E': c->depth--; break;
	case 'T': sfc_transition(c, rest); break;
	case 'A': sfc_action(c, rest); break;
	case 'L': sfc_line(c, rest); break;
	case 'O': c->sfc->evolution = EVOLVE_IN_ORDER; break;
	default: abort();
	}
}

/* An empty one, in a project of its own. */
static inline void sfc_begin(struct test_sfc *c)
{
	*c = (struct test_sfc){ .project = project_new("chart.rung"), .macro = { -1 } };
	if (!c->project)
		abort();
	c->pou = push_room(c, &c->project->pou, &c->project->pou_count,
			   sizeof(*c->pou));
	c->sfc = arena_alloc(&c->project->arena, sizeof(*c->sfc));
	if (!c->sfc)
		abort();
	c->sfc->block = -1;
	*c->pou = (struct pou){ .name = sfc_id(c, "Main", 4), .sfc = c->sfc,
		.language = LANGUAGE_SFC, .word = WORD_COUNT, .temp_word = WORD_COUNT,
		.file = "chart.rung", .line = 1 };
	c->pou->il.arena = &c->project->arena;
}

/* Names get their meaning, steps their variables. */
static inline void sfc_end(struct test_sfc *c)
{
	if (!sfc_link(c->sfc, &c->project->names) ||
	    !sfc_declare(c->sfc, &c->project->names, &c->pou->vars, &c->project->arena, false))
		abort();
}

static inline void sfc_open(struct test_sfc *c, const char *text)
{
	char piece[200];

	sfc_begin(c);
	while (*text) {
		const size_t len = strcspn(text, ";");

		snprintf(piece, sizeof(piece), "%.*s", (int)len, text);
		sfc_piece(c, piece);
		text += len;
		text += strspn(text, "; \n");
	}
	sfc_end(c);
}

static inline void sfc_close(struct test_sfc *c)
{
	project_free(c->project);
}
#endif
