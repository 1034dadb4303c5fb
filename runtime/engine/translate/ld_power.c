/* SPDX-License-Identifier: MIT
 *
 * ld_power - nets and elements as IL, readable where that is possible.
 *
 * A net that one element reads is written in place, with parentheses; one that
 * several read is computed once into a temporary. What is read early and written
 * before it is used is kept aside (ld_freeze).
 */
#include "engine/translate/ladder_unit.h"

void ld_place(struct ld *ld, int row, int col)
{
	ld->row = (uint16_t)(row + 1);
	ld->col = (uint16_t)(col + 1);
}

void ld_emit_line(struct ld *ld, struct il_line line)
{
	line.rung = ld->number;
	line.row = ld->row;
	line.col = ld->col;
	line.line = (uint32_t)rung_line(ld->rung, ld->row);
	if (!il_add(ld->il, line))
		ld->failed = true;
}

/* Was it stored just now? Then it is the result still. */
static bool is_result(const struct ld *ld, uint32_t operand)
{
	const struct il_line *last = ld->il->count ?
		&ld->il->line[ld->il->count - 1] : NULL;

	return last && last->kind == IL_OP && last->op == OP_ST &&
	       !last->modifiers && last->operand == operand &&
	       last->rung == ld->number;
}

void ld_emit(struct ld *ld, enum op op, uint8_t modifiers, uint32_t operand)
{
	struct il_line line = {
		.kind = IL_OP, .op = (uint8_t)op, .modifiers = modifiers,
		.operand = operand,
	};

	if (op == OP_LD && !modifiers && !ld->open && is_result(ld, operand))
		return;
	if (ld->open) {
		struct il_line open = {
			.kind = IL_OP, .op = ld->open_op,
			.modifiers = MOD_PAREN,
		};

		ld->open = false;
		if (op == OP_LD && !modifiers) {
			open.operand = operand; /* OR( Motor */
			ld_emit_line(ld, open);
			return;
		}
		ld_emit_line(ld, open);
	}
	ld_emit_line(ld, line);
}

static uint8_t negation(const struct element_state *state)
{
	return state->negate ? MOD_N : 0;
}

/* Is the element's power one operand, perhaps negated? */
static bool is_single(const struct ld *ld, int element)
{
	const struct element_state *state = &ld->element[element];

	return state->leaf &&
	       (state->powered || ld->network.element[element].in == NET_RAIL);
}

static void load_element(struct ld *ld, int element)
{
	const struct element_state *state = &ld->element[element];
	const struct network_element *at = &ld->network.element[element];

	ld_place(ld, at->row, at->col);
	if (is_single(ld, element)) {
		ld_emit(ld, OP_LD, negation(state), state->leaf);
		return;
	}
	ld_load(ld, at->in);
	ld_place(ld, at->row, at->col);
	if (state->leaf)
		ld_emit(ld, OP_AND, negation(state), state->leaf);
	else
		ld_emit(ld, OP_NOT, 0, 0);
}

static void or_element(struct ld *ld, int element)
{
	const struct element_state *state = &ld->element[element];
	struct il_line close = { .kind = IL_CLOSE };

	if (is_single(ld, element)) {
		const struct network_element *at = &ld->network.element[element];

		ld_place(ld, at->row, at->col);
		ld_emit(ld, OP_OR, negation(state), state->leaf);
		return;
	}
	ld->open = true;
	ld->open_op = OP_OR;
	load_element(ld, element);
	ld_emit_line(ld, close);
}

void ld_load(struct ld *ld, int net)
{
	const struct network *n = &ld->network;
	int first = n->first_feeder[net], end = n->first_feeder[net + 1];

	if (net == NET_RAIL || ld->net[net].temp || first == end) {
		ld_emit(ld, OP_LD, 0, net != NET_RAIL && ld->net[net].temp ?
			ld->net[net].temp : ld->true_id);
		return;
	}
	load_element(ld, n->feeder[first]);
	for (int i = first + 1; i < end; i++)
		or_element(ld, n->feeder[i]);
}

uint32_t ld_store_new(struct ld *ld)
{
	uint32_t name = temps_bool(ld->temps);

	if (!name)
		ld->failed = true;
	ld_emit(ld, OP_ST, 0, name);
	return name;
}

/* The one operand that a net's power is, or 0. */
static uint32_t single_operand(const struct ld *ld, int net)
{
	const struct network *n = &ld->network;
	int first = n->first_feeder[net];

	if (net == NET_RAIL)
		return ld->true_id;
	if (ld->net[net].temp)
		return ld->net[net].temp;
	if (n->first_feeder[net + 1] != first + 1)
		return 0;
	if (is_single(ld, n->feeder[first]) &&
	    !ld->element[n->feeder[first]].negate)
		return ld->element[n->feeder[first]].leaf;
	return 0;
}

void ld_prepare(struct ld *ld, int net, int readers)
{
	const struct network *n = &ld->network;

	if (net == NET_RAIL || ld->net[net].prepared)
		return;
	ld->net[net].prepared = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		if (!ld->element[n->feeder[i]].powered)
			ld_prepare(ld, n->element[n->feeder[i]].in, 1);
	if (n->reader_count[net] > readers && !single_operand(ld, net)) {
		ld_load(ld, net);
		ld->net[net].temp = ld_store_new(ld);
	}
}

uint32_t ld_operand(struct ld *ld, int net)
{
	uint32_t operand;

	ld_prepare(ld, net, 1);
	operand = single_operand(ld, net);
	if (operand)
		return operand;
	ld_load(ld, net);
	return ld->net[net].temp = ld_store_new(ld);
}

/* ---- keeping aside ---- */

static bool is_var(const struct meaning *m)
{
	return m->var && (m->kind == MEANING_VARIABLE || m->kind == MEANING_PIN ||
			  m->kind == MEANING_INSTANCE ||
			  m->kind == MEANING_STRUCT ||
			  m->kind == MEANING_ARRAY ||
			  m->kind == MEANING_ELEMENT);
}

/* Bytes of a variable that it may be: all elements that an index may lead to. */
static uint32_t end_of(const struct scope *scope, const struct meaning *m)
{
	return m->offset + scope_span(scope, m);
}

/* Two parts of one variable; those with an address by where they lie. */
static bool parts_touch(const struct scope *scope, const struct meaning *a,
			const struct meaning *b)
{
	return a->offset < end_of(scope, b) && b->offset < end_of(scope, a);
}

/* Bytes of its area that it may be; one behind the last. */
static uint32_t end_byte(const struct meaning *m)
{
	struct iec_addr last = m->addr;
	uint32_t count = meaning_reach(m).count;

	if (count)
		last = vars_shift(m->addr, count - 1);
	return last.byte + (last.bits + 7u) / 8;
}

static bool bytes_overlap(const struct meaning *a, const struct meaning *b)
{
	if (a->addr.area != b->addr.area || a->addr.area == AREA_NONE)
		return false;
	if (a->addr.bits == 1 && b->addr.bits == 1 && !meaning_reach(a).count &&
	    !meaning_reach(b).count)
		return a->addr.byte == b->addr.byte && a->addr.bit == b->addr.bit;
	return a->addr.byte < end_byte(b) && b->addr.byte < end_byte(a);
}

/* Can a write to @a change what is read from @b? */
static bool touches(const struct scope *scope, const struct meaning *a,
		    const struct meaning *b)
{
	if (is_var(a) && is_var(b) && a->var == b->var)
		return parts_touch(scope, a, b);
	return bytes_overlap(a, b);
}

const struct meaning *ld_meaning(struct ld *ld, uint32_t operand)
{
	enum diag_id why;

	return scope_find(ld->translation->scope, ld->unit->pou, operand, &why);
}

bool ld_is_indexed(struct ld *ld, uint32_t operand)
{
	const struct meaning *m = operand ? ld_meaning(ld, operand) : NULL;

	return m && meaning_is_indexed(m);
}

/* Readers are kept by place, so that a write looks at few of them: eight bytes of
 * an area, or a variable. A wide read may begin in the eight bytes before. */
static uint32_t place_key(const struct meaning *m)
{
	if (m->addr.area != AREA_NONE)
		return (uint32_t)m->addr.area << 16 | m->addr.byte / 8;
	return (uint32_t)((uintptr_t)m->var >> 4) * 2654435761u;
}

static void freeze_at(struct ld *ld, const struct meaning *write, uint32_t key)
{
	int at = ld->reader[key & ld->reader_mask];

	for (; at >= 0; at = ld->element[at].next) {
		struct element_state *state = &ld->element[at];
		const struct meaning *read = ld_meaning(ld, state->leaf);

		if (!read || !touches(ld->translation->scope, write, read))
			continue;
		ld_emit(ld, OP_LD, 0, state->leaf);
		state->leaf = ld_store_new(ld);
	}
}

void ld_freeze(struct ld *ld, uint32_t operand)
{
	const struct meaning *write = ld_meaning(ld, operand);
	uint32_t key, last;

	if (!write)
		return;
	key = place_key(write);
	freeze_at(ld, write, key);
	if (write->addr.area == AREA_NONE)
		return;
	freeze_at(ld, write, key - 1);
	last = key + (end_byte(write) - 1) / 8 - write->addr.byte / 8 + 1;
	if (last - key > ld->reader_mask)
		last = key + ld->reader_mask; /* then all of them */
	for (; key != last; key++)
		freeze_at(ld, write, key + 1);
}

void ld_freeze_globals(struct ld *ld)
{
	for (int i = 0; i < ld->network.element_count; i++) {
		struct element_state *state = &ld->element[i];
		const struct meaning *read = state->seen && state->leaf ?
			ld_meaning(ld, state->leaf) : NULL;

		if (!read || read->pou || read->kind == MEANING_LITERAL)
			continue;
		ld_emit(ld, OP_LD, 0, state->leaf);
		state->leaf = ld_store_new(ld);
	}
}

void ld_read(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];
	const struct meaning *read = state->leaf ? ld_meaning(ld, state->leaf)
						 : NULL;
	int *head;

	if (!read)
		return;
	head = &ld->reader[place_key(read) & ld->reader_mask];
	state->next = *head;
	*head = element;
}

/* ---- watching ---- */

static uint32_t store_power(struct ld *ld)
{
	uint32_t name = temps_power(ld->temps);

	if (!name)
		ld->failed = true;
	ld_emit(ld, OP_ST, 0, name);
	return name;
}

void ld_settle_net(struct ld *ld, int net)
{
	if (!ld->watch || net == NET_RAIL || ld->net[net].temp)
		return;
	ld_load(ld, net);
	ld->net[net].temp = store_power(ld);
}

void ld_settle_element(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	const struct word_row *row = word_row((enum word)at->word);

	if (!ld->watch || row->place == PLACE_LAST)
		return;
	if (!state->leaf && row->operand == OPND_ASSIGN)
		return;
	load_element(ld, element);
	*state = (struct element_state){
		.seen = true, .powered = true, .leaf = store_power(ld),
		.next = state->next,
	};
}
