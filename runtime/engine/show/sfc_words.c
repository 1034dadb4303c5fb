/* SPDX-License-Identifier: MIT
 *
 * sfc_words - texts of steps, transitions, actions and jumps.
 */
#include "engine/show/sfc_words.h"

#include "engine/model/st.h"
#include "engine/text/text.h"

static void put_id(const struct project *project, const struct sink *sink, uint32_t id)
{
	sink_text(sink, project_text(project, id));
}

static void put_refs(const struct project *project, const struct sfc *sfc, int first,
		     int count, const struct sink *sink)
{
	for (int i = 0; i < count; i++) {
		sink_text(sink, i > 0 ? ", " : "");
		put_id(project, sink, sfc->ref[first + i].name);
	}
}

/* The text of an expression that is written with :=. */
static const struct cell *expression_of(const struct pou *pou,
					const struct sfc_body *body)
{
	const struct rung *rung = body->count == 1 && body->kind == BODY_EXPRESSION ?
				  pou->rung[body->first] : NULL;

	return rung && rung->rows == 1 && rung->cols == 2 &&
	       rung->cell[0].word == ELEM_COMPARE ? rung->cell : NULL;
}

/* `Start`, `rung 3`, `list`; `?` if there is no body. */
static void sfc_words_condition(const struct project *project, const struct pou *pou,
				int transition, const struct sink *sink)
{
	const struct sfc_body *body = &pou->sfc->transition[transition].condition;
	const struct cell *cell = expression_of(pou, body);

	if (cell)
		put_id(project, sink, cell->operand);
	else if (body->kind == BODY_LIST)
		sink_text(sink, "list");
	else if (body->kind == BODY_ST)
		sink_text(sink, "ST");
	else if (body->kind == BODY_NONE || body->count == 0)
		sink_text(sink, "?");
	else
		sink_printf(sink, "rung %d", body->first + 1);
}

/* The other steps that must be active, too, and that have no line to here. */
static void put_apart(const struct project *project, const struct sfc_layout *layout,
		      const struct sfc_transition *transition, const struct sink *sink)
{
	const struct sfc *sfc = layout->sfc;
	bool first = true;

	for (int i = 0; i < transition->from_count; i++) {
		const int ref = transition->first_from + i;

		if (!layout->apart[ref])
			continue;
		sink_text(sink, first ? " (with " : ", ");
		put_id(project, sink, sfc->ref[ref].name);
		first = false;
	}
	sink_text(sink, first ? "" : ")");
}

static void put_transition(const struct project *project, const struct pou *pou,
			   const struct sfc_layout *layout, int transition,
			   const struct sink *sink)
{
	const struct sfc_transition *t = &layout->sfc->transition[transition];

	if (layout->turn[transition])
		sink_printf(sink, "%d. ", layout->turn[transition]);
	if (t->name) {
		put_id(project, sink, t->name);
		sink_text(sink, ": ");
	}
	sfc_words_condition(project, pou, transition, sink);
	put_apart(project, layout, t, sink);
}

static void put_jump(const struct project *project, const struct sfc_layout *layout,
		     const struct sfc_jump *jump, const struct sink *sink)
{
	const struct sfc *sfc = layout->sfc;

	if (!jump->to_transition) {
		put_id(project, sink, sfc->ref[jump->ref].name);
		return;
	}
	if (sfc->transition[jump->target].name)
		put_id(project, sink, sfc->transition[jump->target].name);
	else
		sfc_words_ways(project, sfc, jump->target, sink);
}

void sfc_words_shape(const struct project *project, const struct pou *pou,
		     const struct sfc_layout *layout, int shape, const struct sink *sink)
{
	const struct sfc_shape *s = &layout->shape[shape];

	switch (s->part) {
	case SFC_NOTHING:
		break;
	case SFC_STEP:
		put_id(project, sink, layout->sfc->step[s->index].name);
		break;
	case SFC_TRANSITION:
		put_transition(project, pou, layout, s->index, sink);
		break;
	case SFC_JUMP:
		put_jump(project, layout, &layout->jump[s->index], sink);
		break;
	}
}

void sfc_words_times(const struct project *project, const struct sfc *sfc, int step,
		     const struct sink *sink)
{
	const struct sfc_step *s = &sfc->step[step];

	if (s->min) {
		sink_text(sink, "\xe2\x89\xa5 ");
		put_id(project, sink, s->min);
	}
	sink_text(sink, s->min && s->max ? "  " : "");
	if (s->max) {
		sink_text(sink, "\xe2\x89\xa4 ");
		put_id(project, sink, s->max);
	}
}

void sfc_words_qualifier(const struct project *project, const struct sfc *sfc, int use,
			 const struct sink *sink)
{
	const struct sfc_use *u = &sfc->use[use];

	if (u->kind != USE_ACTION) {
		sink_text(sink, u->kind == USE_SET ? "SET" : "RESET");
		return;
	}
	sink_text(sink, qualifier_word(u->qualifier));
	if (u->time) {
		sink_text(sink, " ");
		put_id(project, sink, u->time);
	}
}

void sfc_words_ways(const struct project *project, const struct sfc *sfc, int transition,
		    const struct sink *sink)
{
	const struct sfc_transition *t = &sfc->transition[transition];

	put_refs(project, sfc, t->first_from, t->from_count, sink);
	sink_text(sink, " \xe2\x86\x92 ");
	put_refs(project, sfc, t->first_to, t->to_count, sink);
}

void sfc_words_list(const struct project *project, const struct pou *pou,
		    const struct sfc_body *body, const struct sink *sink)
{
	if (body->kind == BODY_ST)
		text_write_st(project, &(struct st){ .item = pou->st->item + body->first,
						     .count = body->count }, sink);
	else
		text_write_il(project, &(struct il){ .line = pou->il.line + body->first,
						     .count = body->count }, sink);
}
