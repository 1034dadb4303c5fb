/* SPDX-License-Identifier: MIT
 *
 * choices - comparisons of one number with constants, each with a jump further down, become one
 * SWITCH. A CASE is a list of such comparisons, and people write them, too.
 */
#include "engine/translate/lists.h"

#define FEWEST 4   /* comparisons are as fast                                */
#define MOST   4096 /* of a SWITCH: targets                                  */
#define ROOM   8   /* targets that take as much room as one comparison       */

/* `LD n / EQ low / JMPC label`, or with GE low / AND( n / LE high / ). */
struct choice { int64_t low, high; uint32_t label; int lines; };

/* The numbers from low to high that the choices so far have. */
struct span { int64_t low, high; int count, lines; };

static const struct il_line *line_at(const struct list *list, int at)
{
	static const struct il_line none = { .kind = IL_COMMENT };

	return at < list->il->count ? &list->il->line[at] : &none;
}

static bool is_op(const struct il_line *line, enum op op, uint8_t modifiers, uint32_t operand)
{
	return line->kind == IL_OP && line->op == op && line->modifiers == modifiers &&
	       line->operand == operand;
}

/* A comparison with a constant of the number's type. */
static bool compares(struct list *list, int at, enum word word, enum iec_type type, int64_t *out)
{
	const struct il_line *line = line_at(list, at);
	const struct meaning *m;
	union iec_value value = { .i = 0 };

	if (line->kind != IL_FN || line->word != word || line->modifiers || !line->operand)
		return false;
	m = list_meaning(list, line->operand);
	if (m->kind != MEANING_LITERAL || (m->type != IEC_NONE && m->type != type) ||
	    !literal_fit(&m->literal, type, &value) || value.i > INT32_MAX || value.i < INT32_MIN)
		return false;
	*out = value.i;
	return true;
}

static bool find_choice(struct list *list, int at, uint32_t number, enum iec_type type, struct choice *out)
{
	const struct il_line *jump;
	int lines = 2;

	if (!is_op(line_at(list, at), OP_LD, 0, number))
		return false;
	if (compares(list, at + 1, FN_EQ, type, &out->low)) {
		out->high = out->low;
	} else {
		if (!compares(list, at + 1, FN_GE, type, &out->low) ||
		    !is_op(line_at(list, at + 2), OP_AND, MOD_PAREN, number) ||
		    !compares(list, at + 3, FN_LE, type, &out->high) ||
		    line_at(list, at + 4)->kind != IL_CLOSE)
			return false;
		lines = 5;
	}
	jump = line_at(list, at + lines);
	if (jump->kind != IL_OP || jump->op != OP_JMP || jump->modifiers != MOD_C ||
	    !list_is_ahead(list, jump->operand) || out->high < out->low)
		return false;
	out->label = jump->operand;
	out->lines = lines + 1;
	return true;
}

/* Is the operand a whole number in a place of its own? */
static bool is_number(const struct meaning *m)
{
	return m->kind != MEANING_LITERAL && !meaning_is_whole(m) && !meaning_is_indexed(m) &&
	       m->type != IEC_NONE && m->type != IEC_BOOL &&
	       iec_type_row(m->type)->class & (ANY_INT | CLASS_BITS) && !iec_is_wide(m->type);
}

static int64_t targets_of(const struct span *span)
{
	return span->high - span->low + 1;
}

/* The choices from here on, as many as lie close together. */
static struct span find_span(struct list *list, uint32_t number, enum iec_type type)
{
	struct span best = { .count = 0 }, span = { .count = 0 };
	struct choice choice;

	while (find_choice(list, list->at + span.lines, number, type, &choice)) {
		span.low = span.count && span.low < choice.low ? span.low : choice.low;
		span.high = span.count && span.high > choice.high ? span.high : choice.high;
		span.count++;
		span.lines += choice.lines;
		if (targets_of(&span) > MOST || targets_of(&span) > (int64_t)ROOM * ROOM * (span.count + FEWEST))
			break;
		if (targets_of(&span) <= (int64_t)ROOM * span.count)
			best = span;
	}
	return best;
}

/* The first choice of a number has it. @label: by number, 0: none. */
static void fill(struct list *list, const struct span *span, uint32_t number, enum iec_type type,
		 uint32_t *label)
{
	struct choice choice;

	for (int lines = 0; lines < span->lines; lines += choice.lines) {
		if (!find_choice(list, list->at + lines, number, type, &choice))
			return;
		for (int64_t i = choice.low - span->low; i <= choice.high - span->low; i++)
			if (!label[i])
				label[i] = choice.label;
	}
}

static void emit_switch(struct list *list, const struct span *span, uint32_t operand,
			const uint32_t *label)
{
	const uint32_t count = (uint32_t)targets_of(span);
	uint32_t behind;

	list_place(list);
	list->straight = false;
	emit_op(list->as, VM_SWITCH, count);
	behind = (uint32_t)list->as->text->count + 2 + count;
	emit(list->as, operand);
	emit(list->as, (uint32_t)(int32_t)span->low);
	for (uint32_t i = 0; i < count; i++)
		if (label[i])
			list_target(list, label[i]);
		else
			emit(list->as, behind);
}

int list_choices(struct list *list)
{
	const struct il_line *line = line_at(list, list->at);
	const struct meaning *m;
	struct span span;
	uint32_t *label, operand;
	enum iec_type type;

	/* A watched scan keeps the result of each comparison. */
	if (list->as->text != &list->as->code || !is_op(line, OP_LD, 0, line->operand))
		return 0;
	m = list_meaning(list, line->operand);
	if (!is_number(m))
		return 0;
	type = m->type;
	operand = list_number(list, m, type);
	span = find_span(list, line->operand, type);
	if (span.count < FEWEST)
		return 0;
	label = arena_alloc(list->as->arena, (size_t)targets_of(&span) * sizeof(*label));
	if (!label) {
		list->as->failed = true;
		return 0;
	}
	fill(list, &span, line->operand, type, label);
	emit_switch(list, &span, operand, label);
	list->now = (struct il_result){ .kind = RESULT_NUMBER, .operand = operand };
	return span.lines;
}
