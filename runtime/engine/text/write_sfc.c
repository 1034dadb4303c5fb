/* SPDX-License-Identifier: MIT
 *
 * write_sfc - a sequential function chart as its one canonical text.
 *
 * Items stand in the order of the file, two blanks deeper for each level, with an empty
 * line between them. Faulty charts are written too; the variables that a chart adds are
 * not.
 */
#include "engine/text/writer.h"

#include "engine/model/st.h"
#include "engine/text/text.h"

/* A sink that puts blanks before each line. Text that comes in one piece, such as a comment of
 * several lines, is not changed. */
struct indent {
	const struct sink *to;
	int depth;
	bool begins;    /* a line                                             */
};

struct page {
	const struct project *project;
	const struct pou *pou;
	const struct sfc *sfc;
	struct indent *indent;
	const struct sink *sink; /* through the indent                        */
	bool follows;            /* an item stands above at the same level */
};

static void indent_write(void *context, const char *text, size_t len)
{
	struct indent *indent = context;

	if (indent->begins && text[0] != '\n')
		sink_repeat(indent->to, "  ", indent->depth);
	indent->begins = text[len - 1] == '\n';
	sink_write(indent->to, text, len);
}

static void indent_mark(void *context, int kind, int number, bool begins)
{
	const struct indent *indent = context;

	sink_mark(indent->to, kind, number, begins);
}

/* ---- parts of pieces ---- */

static void write_words(const struct page *page, const char *before, uint32_t id,
			const char *after)
{
	sink_text(page->sink, before);
	write_id(page->sink, page->project, id);
	sink_text(page->sink, after);
}

/* One setting of `(WORD := value, …)`; @count settings stand before it. */
static int write_setting(const struct page *page, int count, const char *word,
			 uint32_t id)
{
	if (!id)
		return count;
	sink_text(page->sink, count ? ", " : "(");
	sink_text(page->sink, word);
	write_words(page, " := ", id, "");
	return count + 1;
}

static void write_tail(const struct page *page, uint32_t tail)
{
	page->indent->depth++;
	write_above(page->sink, page->project, tail);
	page->indent->depth--;
}

static void write_body(const struct page *page, const struct sfc_body *body)
{
	const struct pou *pou = page->pou;

	page->indent->depth++;
	for (int i = body->first; sfc_body_has_rungs(body) && i < body->first + body->count;
	     i++) {
		sink_mark(page->sink, TEXT_RUNG, i, true);
		write_rung(page->sink, page->project, pou->rung[i]);
		sink_mark(page->sink, TEXT_RUNG, i, false);
	}
	page->indent->depth--;
	if (body->kind == BODY_LIST)
		text_write_il(page->project, &(struct il){ .line = pou->il.line + body->first,
							   .count = body->count }, page->sink);
	if (body->kind == BODY_ST)
		text_write_st(page->project, &(struct st){ .item = pou->st->item + body->first,
							   .count = body->count }, page->sink);
}

/* ---- steps ---- */

static void write_use(const struct page *page, const struct sfc_use *use)
{
	const struct sink *sink = page->sink;

	write_above(sink, page->project, use->comment);
	write_id(sink, page->project, use->operand);
	sink_text(sink, "(");
	sink_text(sink, qualifier_word(use->qualifier));
	if (use->time)
		write_words(page, ", ", use->time, "");
	sink_text(sink, ");\n");
}

/* SET a, b; Returns how many were written. */
static int write_bits(const struct page *page, const struct sfc_use *use, int count)
{
	int i = 1;

	write_above(page->sink, page->project, use->comment);
	write_words(page, use->kind == USE_SET ? "SET " : "RESET ", use->operand, "");
	for (; i < count && use[i].more && use[i].kind == use->kind && !use[i].comment;
	     i++)
		write_words(page, ", ", use[i].operand, "");
	sink_text(page->sink, ";\n");
	return i;
}

static void write_uses(const struct page *page, const struct sfc_step *step)
{
	const struct sfc_use *use = page->sfc->use;
	const int end = step->first_use + step->use_count;
	int i = step->first_use;

	while (i < end) {
		if (use[i].kind == USE_ACTION)
			write_use(page, &use[i++]);
		else
			i += write_bits(page, &use[i], end - i);
	}
}

/* The lines of a step; the contents of a macro-step follow as items. */
static void write_step(struct page *page, int index)
{
	const struct sfc_step *step = &page->sfc->step[index];
	static const char *const words[] = { "STEP ", "INITIAL_STEP ", "MACRO_STEP " };
	const struct sink *sink = page->sink;
	int count;

	sink_mark(sink, TEXT_STEP, index, true);
	write_above(sink, page->project, step->comment);
	write_words(page, words[step->kind], step->name, "");
	if (step->min || step->max || step->alarm || step->column)
		sink_text(sink, " ");
	count = write_setting(page, 0, "MIN", step->min);
	count = write_setting(page, count, "MAX", step->max);
	count = write_setting(page, count, "ALARM", step->alarm);
	if (step->column)
		sink_printf(sink, "%sCOLUMN := %d", count ? ", " : "(", step->column);
	sink_text(sink, count || step->column ? "):\n" : ":\n");
	page->indent->depth++;
	write_uses(page, step);
	page->follows = step->use_count > 0;
	if (step->kind == STEP_MACRO)
		return;
	write_above(sink, page->project, step->tail);
	page->indent->depth--;
	sink_text(sink, "END_STEP\n");
	sink_mark(sink, TEXT_STEP, index, false);
}

static void write_macro_end(const struct page *page, int index)
{
	write_above(page->sink, page->project, page->sfc->step[index].tail);
	page->indent->depth--;
	sink_text(page->sink, "END_STEP\n");
	sink_mark(page->sink, TEXT_STEP, index, false);
}

/* ---- transitions ---- */

static void write_refs(const struct page *page, const char *before, int first, int count)
{
	const struct sfc_ref *ref = page->sfc->ref + first;

	if (!count)
		return;
	sink_text(page->sink, before);
	sink_text(page->sink, count == 1 ? "" : "(");
	for (int i = 0; i < count; i++)
		write_words(page, i ? ", " : "", ref[i].name, "");
	sink_text(page->sink, count == 1 ? "" : ")");
}

/* Does the rung still have the form `TRANSITION := expression;`, without comments? */
static bool is_expression(const struct page *page, const struct sfc_body *body)
{
	const struct rung *rung = body->kind == BODY_EXPRESSION && body->count == 1 ?
				  page->pou->rung[body->first] : NULL;
	const struct cell *cell = rung ? rung->cell : NULL;

	return rung && rung->rows == 1 && rung->cols == 2 &&
	       !rung->label && !rung->title && !rung->comment &&
	       !rung->off && cell[0].word == ELEM_COMPARE && !cell[0].comment &&
	       cell[1].word == ELEM_COIL && !cell[1].comment && cell[0].operand;
}

static void write_condition(const struct page *page, const struct sfc_transition *t)
{
	const struct sink *sink = page->sink;
	const struct sfc_body *body = &t->condition;

	if (is_expression(page, body)) {
		write_words(page, " := ", page->pou->rung[body->first]->cell[0].operand,
			    t->tail ? ";\n" : "; ");
	} else {
		sink_text(sink, ":\n");
		write_body(page, body);
	}
	write_tail(page, t->tail);
	sink_text(sink, "END_TRANSITION\n");
}

static void write_transition(const struct page *page, int index)
{
	const struct sfc_transition *t = &page->sfc->transition[index];
	const struct sink *sink = page->sink;

	sink_mark(sink, TEXT_TRANSITION, index, true);
	write_above(sink, page->project, t->comment);
	sink_text(sink, "TRANSITION");
	if (t->name)
		write_words(page, " ", t->name, "");
	if (t->priority)
		sink_printf(sink, " (PRIORITY := %d)", t->priority);
	write_refs(page, " FROM ", t->first_from, t->from_count);
	write_refs(page, " TO ", t->first_to, t->to_count);
	write_condition(page, t);
	sink_mark(sink, TEXT_TRANSITION, index, false);
}

/* ---- the chart ---- */

static void write_action(const struct page *page, int index)
{
	const struct sfc_action *action = &page->sfc->action[index];
	const struct sink *sink = page->sink;

	sink_mark(sink, TEXT_ACTION, index, true);
	write_above(sink, page->project, action->comment);
	write_words(page, "ACTION ", action->name, ":\n");
	write_body(page, &action->body);
	write_tail(page, action->tail);
	sink_text(sink, "END_ACTION\n");
	sink_mark(sink, TEXT_ACTION, index, false);
}

static void write_control(const struct page *page)
{
	const struct sfc *sfc = page->sfc;
	int count = 0;

	write_above(page->sink, page->project, sfc->control_comment);
	sink_text(page->sink, "CONTROL");
	for (int i = 0; i < CONTROL_COUNT; i++)
		count = write_setting(page, count, control_word((enum control)i),
				      sfc->control[i]);
	sink_text(page->sink, count ? ");\n" : "();\n");
}

static void write_piece(struct page *page, struct sfc_piece piece)
{
	if (page->follows && piece.kind != PIECE_MACRO_END)
		sink_text(page->sink, "\n");
	switch (piece.kind) {
	case PIECE_STEP:
		write_step(page, piece.index);
		if (page->sfc->step[piece.index].kind == STEP_MACRO)
			return;
		break;
	case PIECE_MACRO_END:
		write_macro_end(page, piece.index);
		break;
	case PIECE_TRANSITION:
		write_transition(page, piece.index);
		break;
	case PIECE_ACTION:
		write_action(page, piece.index);
		break;
	case PIECE_CONTROL:
		write_control(page);
		break;
	}
	page->follows = true;
}

static bool has_blocks(const struct var_table *table)
{
	for (int i = 0; i < table->block_count; i++)
		if (!(table->block[i].flags & VAR_SFC))
			return true;
	return false;
}

static void write_pieces(const struct sink *sink, const struct project *project,
			const struct pou *pou, bool follows)
{
	struct indent indent = { .to = sink, .depth = 1, .begins = true };
	const struct sink into = { indent_write, &indent, indent_mark };
	struct page page = { .project = project, .pou = pou, .sfc = pou->sfc,
			     .indent = &indent, .sink = &into, .follows = follows };

	for (int i = 0; i < pou->sfc->piece_count; i++)
		write_piece(&page, pou->sfc->piece[i]);
	write_above(&into, project, pou->tail);
}

void text_write_sfc(const struct project *project, const struct pou *pou,
		    const struct sink *sink)
{
	write_pieces(sink, project, pou, false);
}

void write_sfc(const struct sink *sink, const struct project *project,
	       const struct pou *pou)
{
	struct indent indent = { .to = sink, .depth = 1, .begins = true };
	const struct sink into = { indent_write, &indent, indent_mark };
	const int number = (int)(pou - project->pou);

	text_write_vars(project, &pou->vars, &into);
	text_write_vars(project, &pou->external, &into);
	text_write_pou_access(project, pou, &into);
	sink_mark(sink, TEXT_BODY, number, true);
	write_pieces(sink, project, pou, has_blocks(&pou->vars));
	sink_mark(sink, TEXT_BODY, number, false);
}
