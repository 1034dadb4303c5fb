/* SPDX-License-Identifier: MIT
 *
 * whole - structures and arrays that are copied as a whole: MOVE, LD and ST.
 *
 * Both sides have one type, so bytes are copied. It knows no calls.
 */
#include "engine/translate/lists.h"

#include <strings.h>

#define ALWAYS CODE_TRUE_AT(list->as->areas)

static uint32_t size_of(const struct list *list, const struct meaning *m)
{
	return scope_size(list->as->translation->scope, m);
}

void list_copy_whole(struct list *list, uint32_t to, uint32_t from, uint32_t size)
{
	list_protect(list, to, size);
	emit_block(list->as, to, from, size);
}

/* Reads it while @en, for list_store_whole(). */
static struct whole_value list_load_whole(struct list *list, const struct meaning *m,
					  uint32_t en)
{
	struct whole_value out = { .m = m, .ok = en, .own = meaning_is_indexed(m) };

	if (out.own)
		out.at = CODE_OFFSET(list_fetch(list, m, en, &out.ok));
	else
		out.at = layout_spot(list->as, m).offset;
	return out;
}

/* A jump over the following code while @ok is FALSE; -1: @ok is always TRUE. */
static int skip_unless(struct list *list, uint32_t ok)
{
	const struct il_line jump = { .modifiers = MOD_C };

	if (ok == ALWAYS)
		return -1;
	list->now.kind = RESULT_BITS;
	list->now.bits = bits_leaf(list->as, ok);
	return list_skip_call(list, &jump);
}

/* Stores it if it exists; returns the BOOL that tells whether it was stored. The current
 * result is lost. */
static uint32_t list_store_whole(struct list *list, const struct meaning *to,
				 struct whole_value value)
{
	uint32_t size = size_of(list, to), copy;
	int skip;

	list->now.kind = RESULT_NONE;
	if (!meaning_is_indexed(to)) {
		skip = skip_unless(list, value.ok);
		list->now.kind = RESULT_NONE;
		list_copy_whole(list, layout_spot(list->as, to).offset, value.at, size);
		list_end_skip(list, skip);
		return value.ok;
	}
	if (!value.own && value.m->var == to->var) { /* both may be the same place */
		copy = layout_like(list->as, to);
		list_copy_whole(list, copy, value.at, size);
		value.at = copy;
	}
	return list_deposit(list, to, value.ok, CODE_OPERAND(IEC_NONE, value.at));
}

/* ---- LD and ST ---- */

void list_load_result(struct list *list, const struct meaning *m)
{
	struct whole_value value = list_load_whole(list, m, ALWAYS);

	list->now = (struct il_result){ .kind = RESULT_WHOLE, .whole = value };
}

/* The result stays for another ST. */
void list_store_result(struct list *list, const struct meaning *m)
{
	struct il_result now = list->now;

	list_store_whole(list, m, now.whole);
	list->now = now;
}

/* ---- MOVE ---- */

static const struct meaning *arg_of(struct list *list, const char *name)
{
	const struct scope *scope = list->as->translation->scope;

	for (int i = list->at + 1; i < list->il->count; i++) {
		const struct il_line *line = &list->il->line[i];

		if (line->kind != IL_ARG_IN && line->kind != IL_ARG_OUT)
			break;
		if (strcasecmp(scope_text(scope, line->pin), name) == 0)
			return list_meaning(list, line->operand);
	}
	return NULL;
}

bool list_is_whole_move(struct list *list)
{
	const struct meaning *in;

	if (list->il->line[list->at].word != FN_MOVE)
		return false;
	in = arg_of(list, "IN");
	return in && meaning_is_whole(in);
}

uint32_t list_whole_move(struct list *list, uint32_t en)
{
	const struct meaning *from = arg_of(list, "IN"), *to = arg_of(list, "OUT");

	list_place(list);
	if (meaning_is_indexed(from) && !meaning_is_indexed(to) && from->var != to->var)
		return list_fetch_whole(list, from, en,
					layout_spot(list->as, to).offset);
	return list_store_whole(list, to, list_load_whole(list, from, en));
}
