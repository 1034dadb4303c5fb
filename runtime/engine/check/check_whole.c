/* SPDX-License-Identifier: MIT
 *
 * check_whole - structures and arrays that are copied or handed over as a whole.
 *
 * Both sides are of one type: the same structure, or arrays of the same bounds and
 * elements. There is nothing to widen and nothing to convert.
 */
#include "engine/check/il_check.h"

#include "engine/model/shape.h"

#include <stdio.h>
#include <strings.h>

static bool is_arg(const struct il_check *c, int at)
{
	return at < c->il->count && (c->il->line[at].kind == IL_ARG_IN ||
				     c->il->line[at].kind == IL_ARG_OUT);
}

/* ---- shapes ---- */

static bool is_like(const struct meaning *m, const struct word_pin *pin)
{
	if (pin->elements)
		return m->kind == MEANING_ARRAY && m->addr.area == AREA_NONE &&
		       m->type == pin->type && m->array.low == pin->low &&
		       m->array.count == pin->elements &&
		       (pin->type != IEC_NONE || m->word == pin->word) &&
		       (pin->type != IEC_STRING || m->capacity == pin->capacity);
	return (m->kind == MEANING_STRUCT || m->kind == MEANING_INSTANCE) &&
	       pin->type == IEC_NONE && m->word == pin->word;
}

bool il_check_shape(struct il_check *c, const struct il_line *arg,
		    const struct meaning *m, const struct word_pin *pin)
{
	const char *word = pin->type == IEC_NONE ? scope_row(c->scope, pin->word)->word :
						   iec_type_row(pin->type)->word;
	char text[2 * LIMIT_ARG], room[16] = "";

	if (is_like(m, pin))
		return true;
	if (!pin->elements)
		return il_report(c, arg, DIAG_WRONG_TYPE, word);
	if (pin->type == IEC_STRING)
		snprintf(room, sizeof(room), "[%u]", pin->capacity);
	snprintf(text, sizeof(text), "ARRAY[%ld..%lld] OF %.20s%s%s", (long)pin->low,
		 (long long)pin->low + pin->elements - 1, word, room,
		 m->addr.area == AREA_NONE ? "" : " without AT");
	return il_report(c, arg, DIAG_WRONG_TYPE, text);
}

/* As it would be declared. */
static struct word_pin pin_like(const struct meaning *m)
{
	struct word_pin pin = { .type = m->type };

	if (m->type == IEC_NONE)
		pin.word = (enum word)m->word;
	else
		pin.capacity = m->capacity;
	if (m->kind == MEANING_ARRAY) {
		pin.elements = m->array.count;
		pin.low = m->array.low;
	}
	return pin;
}

bool il_check_same(struct il_check *c, const struct il_line *arg,
		   const struct meaning *m, const struct meaning *like)
{
	const struct word_pin pin = pin_like(like);

	if (like->addr.area != AREA_NONE) /* what may be copied has no AT */
		return il_check_shape(c, arg, like, &pin);
	return il_check_shape(c, arg, m, &pin);
}

/* ---- MOVE ---- */

static bool may_move(const struct meaning *m)
{
	return m && (m->kind == MEANING_STRUCT || m->kind == MEANING_ARRAY);
}

static const struct il_line *arg_of(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (strcasecmp(scope_text(c->scope, c->il->line[i].pin), name) == 0)
			return &c->il->line[i];
	return NULL;
}

bool il_is_whole_move(struct il_check *c, int at)
{
	enum diag_id why;

	if (c->il->line[at].word != FN_MOVE)
		return false;
	for (int i = at + 1; is_arg(c, i); i++)
		if (may_move(scope_find(c->scope, c->pou, c->il->line[i].operand,
					&why)))
			return true;
	return false;
}

bool il_check_whole_move(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct il_line *in = arg_of(c, at, "IN"), *out = arg_of(c, at, "OUT");
	const struct il_line *en = arg_of(c, at, "EN"), *eno = arg_of(c, at, "ENO");
	const struct meaning *from, *to;

	c->now.there = false;
	if (!in || !out)
		return il_report(c, line, DIAG_MISSING_INPUT, in ? "OUT" : "IN");
	from = il_find(c, in);
	to = il_find(c, out);
	if (!from || !to || (en && !il_check_power(c, en, false)) ||
	    (eno && !il_check_power(c, eno, true)))
		return false;
	if (!may_move(to))
		return il_check_same(c, out, to, from);
	return il_check_same(c, in, from, to) && il_can_write(c, out, to);
}

/* ---- LD and ST ---- */

/* The line behind @at that is no comment; count: none. */
static int next_line(const struct il_check *c, int at)
{
	do
		at++;
	while (at < c->il->count && c->il->line[at].kind == IL_COMMENT);
	return at;
}

static bool is_store(const struct il_check *c, int at)
{
	const struct il_line *line = at < c->il->count ? &c->il->line[at] : NULL;

	return line && line->kind == IL_OP && line->op == OP_ST && !line->modifiers;
}

bool il_loads_whole(struct il_check *c, int at, const struct meaning *m)
{
	return may_move(m) && !c->il->line[at].modifiers &&
	       is_store(c, next_line(c, at));
}

bool il_check_store_whole(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct meaning *from = c->now.whole, *to = il_find(c, line);

	if (!is_store(c, next_line(c, at))) /* nothing else takes it */
		c->now = (struct result){ .there = false };
	return to && il_check_same(c, line, to, from) && il_can_write(c, line, to);
}
