/* SPDX-License-Identifier: MIT
 *
 * ld_to_il - the order in which a rung is evaluated (docs/language.md).
 *
 * Phase 1 walks from the outputs back to the left rail, each element once; phase 2
 * lets coils, jumps and last assignments act, top to bottom.
 */
#include "engine/translate/ladder_unit.h"

#include <stdio.h>
#include <string.h>

static const struct word_row *row_of(const struct ld *ld, int element)
{
	return word_row((enum word)ld->network.element[element].word);
}

static bool is_unread(const struct ld *ld, int element)
{
	int out = ld->network.element[element].out;

	return out == NET_RAIL || ld->network.reader_count[out] == 0;
}

/* What acts in phase 2. */
static bool is_actor(const struct ld *ld, int element)
{
	const struct word_row *row = row_of(ld, element);

	if (row->operand == OPND_ASSIGN || row->operand == OPND_ROUTINE)
		return is_unread(ld, element);
	return row->place == PLACE_LAST;
}

static bool is_output(const struct ld *ld, int element)
{
	bool box = row_of(ld, element)->place == PLACE_BOX;

	return is_actor(ld, element) || (box && is_unread(ld, element));
}

static uint32_t operand_of(const struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];

	return rung_at(ld->rung, at->row, at->col)->operand;
}

/* ---- phase 1 ---- */

/* An edge has a memory of its own, set at every evaluation. */
static void read_edge(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t operand = operand_of(ld, element);
	uint32_t memory;

	if (ld_is_indexed(ld, operand)) {
		ld_edge(ld, element, operand);
		return;
	}
	memory = ld_memory(ld, element);
	ld_emit(ld, OP_LD, 0, rising ? operand : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : operand);
	state->leaf = ld_store_new(ld);
	ld_emit(ld, OP_LD, 0, operand);
	ld_emit(ld, OP_ST, 0, memory);
	if (!memory)
		ld->failed = true;
}

static void evaluate(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	const struct word_row *row = row_of(ld, element);

	ld_place(ld, at->row, at->col);
	if (is_actor(ld, element))
		return;
	if (row->kind != WORD_ELEM)
		ld_box(ld, element);
	else if (row->operand == OPND_EXPR)
		ld_compare(ld, element);
	else if (row->operand == OPND_ASSIGN)
		ld_assign(ld, element);
	else if (row->operand == OPND_ROUTINE)
		ld_routine(ld, element);
	else if (row->edge != EDGE_NONE)
		read_edge(ld, element);
	else if (ld_is_indexed(ld, operand_of(ld, element)))
		ld_contact(ld, element, operand_of(ld, element));
	else
		state->leaf = operand_of(ld, element);
	state->negate = row->negate && !state->powered;
	ld_settle_element(ld, element);
	ld_read(ld, element);
}

static void visit_net(struct ld *ld, int net);

/* Depth: an element leads right, so at most LIMIT_COLS of them nest. */
static void visit(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];

	if (ld->element[element].seen)
		return;
	ld->element[element].seen = true;
	visit_net(ld, at->in);
	for (int i = 0; i < at->pins; i++)
		visit_net(ld, ld->network.pin[at->first_pin + i].in);
	evaluate(ld, element);
}

static void visit_net(struct ld *ld, int net)
{
	const struct network *n = &ld->network;

	if (net == NET_RAIL || ld->net[net].seen)
		return;
	ld->net[net].seen = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		visit(ld, n->feeder[i]);
	ld_settle_net(ld, net);
}

/* ---- phase 2 ---- */

/* Coils that only store the result, so that several can share it. */
static bool is_plain(const struct ld *ld, int element)
{
	const struct word_row *row = row_of(ld, element);

	return row->operand == OPND_BOOL_W && row->edge == EDGE_NONE;
}

static void act_plain(struct ld *ld, const int *group, int count)
{
	int net = ld->network.element[group[0]].in;

	/* One group that reads its net alone needs no temporary for it. */
	ld_prepare(ld, net, count);
	ld_load(ld, net);
	for (int i = 0; i < count; i++) {
		const struct network_element *at =
			&ld->network.element[group[i]];
		const struct word_row *row = row_of(ld, group[i]);

		ld_place(ld, at->row, at->col);
		ld_emit(ld, row->first, row->negate ? MOD_N : 0,
			operand_of(ld, group[i]));
	}
}

static void act_edge(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t power, memory = ld_memory(ld, element);

	ld_prepare(ld, at->in, 1);
	ld_load(ld, at->in);
	ld_place(ld, at->row, at->col);
	power = ld_store_new(ld);
	ld_emit(ld, OP_LD, 0, rising ? power : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : power);
	ld_emit(ld, row_of(ld, element)->first, 0, operand_of(ld, element));
	ld_emit(ld, OP_LD, 0, power);
	ld_emit(ld, OP_ST, 0, memory);
	if (!memory)
		ld->failed = true;
}

static void act_flow(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	bool always = at->in == NET_RAIL;

	ld_prepare(ld, at->in, 1);
	if (!always)
		ld_load(ld, at->in);
	ld_place(ld, at->row, at->col);
	ld_emit(ld, row_of(ld, element)->first, always ? 0 : MOD_C,
		operand_of(ld, element));
}

/* An assignment, or a call of a subroutine. */
static void act_box(struct ld *ld, int element)
{
	if (row_of(ld, element)->operand == OPND_ASSIGN)
		ld_assign(ld, element);
	else
		ld_routine(ld, element);
	ld_settle_element(ld, element);
}

/* Outputs from @first on that share one result. */
static int group_size(const struct ld *ld, const int *actor, int first,
		      int count)
{
	int net = ld->network.element[actor[first]].in, n = 1;

	if (!is_plain(ld, actor[first]))
		return 1;
	while (first + n < count && is_plain(ld, actor[first + n]) &&
	       ld->network.element[actor[first + n]].in == net)
		n++;
	return n;
}

static void act(struct ld *ld, const int *actor, int count)
{
	for (int i = 0, n; i < count; i += n) {
		const struct network_element *at =
			&ld->network.element[actor[i]];
		const struct word_row *row = row_of(ld, actor[i]);

		n = group_size(ld, actor, i, count);
		ld_place(ld, at->row, at->col);
		for (int k = 0; k < n && i + n < count; k++)
			if (row->operand == OPND_BOOL_W)
				ld_freeze(ld, operand_of(ld, actor[i + k]));
		if (row->place == PLACE_BOX)
			act_box(ld, actor[i]);
		else if (row->edge != EDGE_NONE)
			act_edge(ld, actor[i]);
		else if (row->operand == OPND_LOOP)
			ld_loop_begin(ld, actor[i]);
		else if (row->operand == OPND_LOOP_END)
			ld_loop_end(ld);
		else if (is_plain(ld, actor[i]))
			act_plain(ld, actor + i, n);
		else
			act_flow(ld, actor[i]);
	}
}

/* ---- a rung ---- */

static void note_power(struct ld *ld, int row, int col, uint32_t in,
		       uint32_t out)
{
	struct power_note *note = arena_push(ld->translation->arena,
					     &ld->unit->power,
					     &ld->unit->power_count,
					     sizeof(*note));

	if (!note) {
		ld->failed = true;
		return;
	}
	*note = (struct power_note){
		.rung = ld->number, .row = (uint16_t)(row + 1),
		.col = (uint16_t)(col + 1), .in = in, .out = out,
	};
}

/* Power of every cell that has been evaluated, in reading order. */
static void note_rung(struct ld *ld)
{
	const struct network *n = &ld->network;
	int element = 0;

	for (int row = 0; row < n->rows; row++)
		for (int col = 0; col < n->cols; col++) {
			const struct cell *cell = rung_at(ld->rung, row, col);
			int net = network_net(n, row, col);
			uint32_t in = ld->net[net].temp, out = in;

			if (cell->word == ELEM_EMPTY ||
			    (net != NET_RAIL && !in && cell->word == ELEM_WIRE))
				continue;
			if (element < n->element_count &&
			    n->element[element].row == row &&
			    n->element[element].col == col) {
				if (!ld->element[element].seen) {
					element++;
					continue;
				}
				if (ld->element[element].leaf)
					out = ld->element[element].leaf;
				element++;
			}
			note_power(ld, row, col, in, out);
		}
}

/* One list of readers for about every element, at most 4096 of them. */
static bool prepare_readers(struct ld *ld)
{
	uint32_t size = 4;

	while (size < 4096 && size < (uint32_t)ld->network.element_count)
		size *= 2;
	ld->reader_mask = size - 1;
	ld->reader = arena_alloc(ld->scratch, size * sizeof(*ld->reader));
	for (uint32_t i = 0; ld->reader && i < size; i++)
		ld->reader[i] = -1;
	return ld->reader;
}

static bool prepare_rung(struct ld *ld)
{
	const struct network *n = &ld->network;

	arena_reset(ld->scratch);
	if (!network_make(ld->rung, ld->scratch, &ld->network))
		return false;
	ld->element = arena_alloc(ld->scratch, ((size_t)n->element_count + 1) *
				  sizeof(*ld->element));
	ld->net = arena_alloc(ld->scratch,
			      ((size_t)n->net_count + 1) * sizeof(*ld->net));
	temps_rung(ld->temps);
	return ld->element && ld->net && prepare_readers(ld);
}

static void translate_rung(struct ld *ld)
{
	const struct network *n = &ld->network;
	int *actor = arena_alloc(ld->scratch, ((size_t)n->element_count + 1) *
				 sizeof(*actor));
	int count = 0;

	if (!actor) {
		ld->failed = true;
		return;
	}
	for (int i = 0; i < n->element_count; i++) {
		if (!is_output(ld, i))
			continue;
		visit(ld, i);
		if (is_actor(ld, i))
			actor[count++] = i;
	}
	act(ld, actor, count);
	if (ld->watch)
		note_rung(ld);
}

/* ---- a POU ---- */

static uint32_t fold(struct ld *ld, uint32_t name)
{
	return names_fold(&ld->translation->project->names, name);
}

/* Only labels that are jumped to are written: a label ends what may be fused. */
static bool find_targets(struct ld *ld)
{
	const struct pou *pou = ld->unit->pou;
	const struct names *names = &ld->translation->project->names;

	for (int pass = 0; pass < 2; pass++) {
		for (int i = 0; i < pou->rung_count; i++) {
			const struct rung *rung = pou->rung[i];
			int cells = rung->off ? 0 : rung->rows * rung->cols;

			for (int k = 0; k < cells; k++) {
				const struct cell *cell = &rung->cell[k];
				uint32_t id;

				if (word_row((enum word)cell->word)->operand !=
				    OPND_LABEL)
					continue;
				id = fold(ld, cell->operand);
				if (pass == 1 && id < ld->target_count)
					ld->target[id] = 1;
			}
		}
		if (pass == 1)
			break;
		ld->target_count = (uint32_t)names->count;
		ld->target = arena_alloc(ld->translation->arena,
					 ld->target_count);
		if (!ld->target)
			return false;
	}
	return true;
}

static void head(struct ld *ld)
{
	const struct names *names = &ld->translation->project->names;
	struct il_line line = { .kind = IL_COMMENT };
	const char *label = names_text(names, ld->rung->label);
	char text[LIMIT_NAME + 32];
	int len;
	uint32_t id;

	if (!ld->watch) {
		len = snprintf(text, sizeof(text), "(* rung %u%s%s *)",
			       ld->number, *label ? ": " : "", label);
		line.operand = names_intern(&ld->translation->project->names,
					    text, (size_t)len);
		ld_emit_line(ld, line);
	}
	id = ld->rung->label ? fold(ld, ld->rung->label) : 0;
	if (id && id < ld->target_count && ld->target[id]) {
		line.kind = IL_LABEL;
		line.operand = ld->rung->label;
		ld_emit_line(ld, line);
	}
}

bool ld_begin(struct ld *ld)
{
	struct translation *t = ld->translation;
	struct names *names = &t->project->names;

	if (!ld->unit->temps) {
		ld->unit->temps = arena_alloc(t->arena, sizeof(struct temps));
		if (!ld->unit->temps)
			return false;
		ld->unit->temps->translation = t;
		ld->unit->temps->unit = ld->unit;
	}
	ld->temps = ld->unit->temps;
	ld->temps->edges = ld->temps->powers = 0;
	ld->il->arena = t->arena;
	ld->expr = arena_alloc(t->arena, sizeof(*ld->expr));
	ld->ignored = arena_alloc(t->arena, sizeof(*ld->ignored));
	ld->true_id = names_intern(names, "TRUE", 4);
	ld->in_id = names_intern(names, "IN", 2);
	ld->en_id = names_intern(names, "EN", 2);
	ld->eno_id = names_intern(names, "ENO", 3);
	ld->out_id = names_intern(names, "OUT", 3);
	return ld->expr && ld->ignored && ld->out_id && find_targets(ld);
}

bool ld_rungs(struct ld *ld, int first, int count, const uint8_t *skip)
{
	for (int i = first; i < first + count && !ld->failed; i++) {
		ld->rung = ld->unit->pou->rung[i];
		ld->number = (uint32_t)i + 1;
		ld->row = ld->col = 0;
		if (ld->rung->off)
			continue;
		head(ld); /* a label counts even if the rung has errors */
		if (skip[i])
			continue;
		if (!prepare_rung(ld))
			return false;
		translate_rung(ld);
	}
	return !ld->failed;
}

bool ld_to_il(struct translation *translation, struct unit *unit,
	      const uint8_t *skip, bool watch, struct arena *scratch)
{
	struct ld ld = {
		.translation = translation, .unit = unit, .scratch = scratch,
		.il = watch ? &unit->watch : &unit->il, .watch = watch,
	};

	return ld_begin(&ld) && ld_rungs(&ld, 0, unit->pou->rung_count, skip);
}
