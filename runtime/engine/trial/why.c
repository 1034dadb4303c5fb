/* SPDX-License-Identifier: MIT
 *
 * why - walks the network of a rung from a cell back to the left rail, path by path.
 */
#include "engine/trial/why.h"
#include "engine/base/name.h"

#include "engine/model/network.h"
#include "engine/trial/why_parts.h"
#include "engine/trial/why_values.h"

#include <stdio.h>
#include <string.h>

#define STEPS_MOST 50000 /* bounds the time in a large rung */

/* A contact on the path, and the value that it needs. */
struct need { uint32_t operand; bool value; };

struct walk {
	const struct why_place *at;
	const struct rung *rung;
	struct network network;
	struct arena *arena;
	struct why *out;
	bool on;
	int path[LIMIT_COLS];   /* elements, from the cell to the left */
	bool blocks[LIMIT_COLS];
	struct need need[LIMIT_COLS];
	int depth, needs, steps;
};

const char *why_text(enum why_kind kind, bool on)
{
	static const char *const text[WHY_COUNT][2] = {
#define WHY(id, off, on) [WHY_##id] = { off, on },
#include "engine/trial/why.def"
#undef WHY
	};

	return kind < WHY_COUNT ? text[kind][on] : "";
}

static bool power_at(const struct why_place *at, int rung, int row, int col, bool *in,
		     bool *out)
{
	*in = *out = false;
	if (at->instance)
		return resource_power_in(at->resource, at->instance,
					 strlen(at->instance), (uint32_t)rung,
					 (uint32_t)row, (uint32_t)col, in, out);
	return resource_power(at->resource, (uint32_t)at->pou, (uint32_t)rung,
			      (uint32_t)row, (uint32_t)col, in, out);
}

static void power_of(const struct walk *walk, int element, bool *in, bool *out)
{
	const struct network_element *e = &walk->network.element[element];

	power_at(walk->at, walk->at->rung, e->row + 1, e->col + 1, in, out);
}

static const struct cell *cell_of(const struct walk *walk, int element)
{
	const struct network_element *e = &walk->network.element[element];

	return rung_at(walk->rung, e->row, e->col);
}

static const struct word_row *row_of(const struct walk *walk, int element)
{
	return words_row(&walk->at->project->words,
			 (enum word)walk->network.element[element].word);
}

static enum why_kind kind_of(const struct word_row *row)
{
	if (row->kind == WORD_FB)
		return WHY_BLOCK;
	if (row->kind == WORD_FN)
		return WHY_FUNCTION;
	if (row->operand == OPND_EXPR)
		return WHY_COMPARE;
	if (row->operand != OPND_BOOL_R)
		return row->place == PLACE_SERIES ? WHY_INVERTED : WHY_FUNCTION;
	if (row->edge != EDGE_NONE)
		return WHY_EDGE;
	return row->negate ? WHY_NEGATED : WHY_CONTACT;
}

static bool is_contact(enum why_kind kind)
{
	return kind == WHY_CONTACT || kind == WHY_NEGATED;
}

/* Whether it blocks power whatever is to its left. Unknown values do not block. */
static bool does_block(const struct walk *walk, int element, enum why_kind kind)
{
	bool in, out;

	power_of(walk, element, &in, &out);
	if (out || (!in && kind == WHY_FUNCTION))
		return false;
	if (in || !is_contact(kind))
		return in || kind == WHY_BLOCK || kind == WHY_EDGE;
	return why_operand(walk->at, cell_of(walk, element)->operand) ==
	       (kind == WHY_NEGATED);
}

/* ---- ways ---- */

static void name_cell(const struct walk *walk, int element, struct why_cell *cell)
{
	const struct network_element *e = &walk->network.element[element];
	const struct word_row *row = row_of(walk, element);
	const char *name = project_text(walk->at->project,
					cell_of(walk, element)->operand);
	bool in, out;

	power_of(walk, element, &in, &out);
	*cell = (struct why_cell){ .kind = kind_of(row), .row = e->row + 1,
				   .col = e->col + 1, .powered = in };
	snprintf(cell->name, sizeof(cell->name), "%.79s", *name ? name : row->word);
	why_values(walk->at, cell_of(walk, element), row, cell->values,
		   sizeof(cell->values));
}

static bool same_cell(const struct why_cell *a, const struct why_cell *b)
{
	if (is_contact(a->kind) && is_contact(b->kind))
		return name_is(a->name, b->name, strlen(b->name));
	return a->row == b->row && a->col == b->col && strcmp(a->name, b->name) == 0;
}

/* Whether all of @a is in @b, too. */
static bool is_within(const struct why_way *a, const struct why_way *b)
{
	for (int i = 0; i < a->count; i++) {
		bool found = false;

		for (int k = 0; k < b->count && !found; k++)
			found = same_cell(&a->cell[i], &b->cell[k]);
		if (!found)
			return false;
	}
	return true;
}

static void drop_way(struct why *why, int index)
{
	why->ways--;
	memmove(&why->way[index], &why->way[index + 1],
		(size_t)(why->ways - index) * sizeof(why->way[0]));
}

/* Shortest first; ways of one length in the order of the rung. */
static void add_way(struct why *why, const struct why_way *way, bool on)
{
	int at = 0;

	for (int i = why->ways - 1; i >= 0; i--) {
		if (is_within(&why->way[i], way))
			return;
		if (!on && is_within(way, &why->way[i]))
			drop_way(why, i);
	}
	while (at < why->ways && why->way[at].count <= way->count)
		at++;
	if (why->ways == WHY_WAYS) {
		why->more = true;
		if (at == WHY_WAYS)
			return;
		drop_way(why, WHY_WAYS - 1);
	}
	memmove(&why->way[at + 1], &why->way[at],
		(size_t)(why->ways - at) * sizeof(why->way[0]));
	why->way[at] = *way;
	why->ways++;
}

static bool put_cells(struct walk *walk, struct why_way *way, const struct why_cell *cell,
		      int count)
{
	if (way->count + count > WHY_CELLS) {
		walk->out->more = true;
		return false;
	}
	memcpy(&way->cell[way->count], cell, (size_t)count * sizeof(*cell));
	way->count += count;
	return true;
}

static bool take_apart(struct walk *walk, int element, const struct why_cell *cell,
		       struct why_parts **out)
{
	const uint32_t operand = cell_of(walk, element)->operand;
	const struct names *names = &walk->at->project->names;

	*out = NULL;
	if (cell->kind != WHY_COMPARE)
		return false;
	*out = arena_alloc(walk->arena, sizeof(**out));
	return *out && why_parts(walk->at, cell, names_text(names, operand),
				 names_len(names, operand), walk->on, walk->arena, *out);
}

/* Adds the elements from number @left of the path to the right; an expression may have
 * several ways. Depth: that of the path. */
static void add_rest(struct walk *walk, struct why_way *way, int left)
{
	const int count = way->count;
	struct why_parts *parts;
	struct why_cell cell;

	while (left >= 0 && !walk->on && !walk->blocks[left])
		left--;
	if (left < 0) {
		add_way(walk->out, way, walk->on);
		return;
	}
	if (++walk->steps > STEPS_MOST) {
		walk->out->more = true;
		return;
	}
	name_cell(walk, walk->path[left], &cell);
	if (!take_apart(walk, walk->path[left], &cell, &parts)) {
		if (put_cells(walk, way, &cell, 1))
			add_rest(walk, way, left - 1);
		way->count = count;
		return;
	}
	for (int i = 0; i < parts->ways; i++) {
		if (put_cells(walk, way, parts->way[i].cell, parts->way[i].count))
			add_rest(walk, way, left - 1);
		way->count = count;
	}
}

/* The path reached the rail. */
static void end_way(struct walk *walk, struct why_way *way)
{
	way->count = 0;
	add_rest(walk, way, walk->depth - 1);
}

/* Two contacts of one operand exclude each other: this path never has power. */
static bool is_possible(struct walk *walk, uint32_t operand, bool value)
{
	const struct names *names = &walk->at->project->names;
	const char *text = names_text(names, operand);

	for (int i = 0; i < walk->needs; i++) {
		const char *other = names_text(names, walk->need[i].operand);

		if (walk->need[i].value != value &&
		    name_is(other, text, names_len(names, operand)))
			return false;
	}
	walk->need[walk->needs++] = (struct need){ operand, value };
	return true;
}

static void walk_net(struct walk *walk, int net, struct why_way *way);

/* Whether power begins here: then nothing to its left matters. */
static bool is_source(const struct walk *walk, int element, enum why_kind kind)
{
	bool in, out;

	power_of(walk, element, &in, &out);
	return kind == WHY_INVERTED || (out && !in);
}

/* Depth: an element leads right, so at most LIMIT_COLS of them nest. */
static void walk_element(struct walk *walk, int element, struct why_way *way)
{
	const enum why_kind kind = kind_of(row_of(walk, element));
	const int needs = walk->needs;
	bool in, out;

	power_of(walk, element, &in, &out);
	if (row_of(walk, element)->place == PLACE_LAST) { /* a coil passes power on */
		walk_net(walk, walk->network.element[element].in, way);
		return;
	}
	if (walk->depth == LIMIT_COLS || ++walk->steps > STEPS_MOST) {
		walk->out->more = true;
		return;
	}
	if (walk->on && !out)
		return;
	if (!walk->on && is_contact(kind) &&
	    !is_possible(walk, cell_of(walk, element)->operand, kind == WHY_CONTACT))
		return;
	walk->path[walk->depth] = element;
	walk->blocks[walk->depth++] = does_block(walk, element, kind);
	if (is_source(walk, element, kind))
		end_way(walk, way);
	else
		walk_net(walk, walk->network.element[element].in, way);
	walk->depth--;
	walk->needs = needs;
}

static void walk_net(struct walk *walk, int net, struct why_way *way)
{
	const struct network *n = &walk->network;

	if (net == NET_RAIL) {
		end_way(walk, way);
		return;
	}
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		walk_element(walk, n->feeder[i], way);
}

/* ---- the rung as a whole ---- */

static int rung_of_label(const struct pou *pou, const struct names *names,
			 uint32_t label)
{
	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    name_is(names_text(names, pou->rung[i]->label),
			    names_text(names, label), names_len(names, label)))
			return i + 1;
	return 0;
}

/* The rung that rung @number jumps to; 0: out of the POU. */
static int next_rung(const struct why_place *at, const struct pou *pou, int number)
{
	const struct rung *rung = pou->rung[number - 1];

	for (int i = 0; i < rung->rows * rung->cols && !rung->off; i++) {
		const struct cell *cell = &rung->cell[i];
		const struct word_row *row = words_row(&at->project->words,
						       (enum word)cell->word);
		bool in, out;
		int to;

		if (row->place != PLACE_LAST ||
		    (row->first != OP_JMP && row->first != OP_RET) ||
		    !power_at(at, number, i / rung->cols + 1, i % rung->cols + 1, &in,
			      &out) || !in)
			continue;
		to = row->first == OP_RET ? 0 :
		     rung_of_label(pou, &at->project->names, cell->operand);
		if (!to || to > number)
			return to; /* a jump back in its last turn */
	}
	return number + 1;
}

/* The rung that jumped over @at; 0: none did. */
static int skipped_by(const struct why_place *at, const struct pou *pou)
{
	int number = 1;

	while (number < at->rung) {
		const int next = next_rung(at, pou, number);

		if (!next || next > at->rung)
			return number;
		number = next;
	}
	return 0;
}

static enum why_kind whole_rung(const struct why_place *at, const struct pou *pou,
				int *by)
{
	const struct resource *resource = at->resource;

	if (pou->rung[at->rung - 1]->off)
		return WHY_RUNG_OFF;
	if (resource->state == STATE_FAULT)
		return WHY_FAULTED;
	if (resource->state == STATE_STOP)
		return WHY_STOPPED;
	if (resource->scans == 0)
		return WHY_NOT_RUN;
	*by = skipped_by(at, pou);
	return *by ? WHY_SKIPPED : WHY_COUNT;
}

/* ---- charts ---- */

static bool stands_in(const struct sfc_body *body, int rung)
{
	return sfc_body_has_rungs(body) && rung > body->first && rung <= body->first + body->count;
}

static bool is_active(const struct why_place *at, const struct pou *pou, int step)
{
	const struct var_table *vars = &pou->vars;

	return step < 0 || why_operand(at, vars->var[sfc_x(pou->sfc, vars, step)].name);
}

/* The step that must be active for this condition to be evaluated; 0: all are. */
static uint32_t missing_step(const struct why_place *at, const struct pou *pou)
{
	const struct sfc *sfc = pou->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		for (int k = t->first_from; k < t->first_from + t->from_count; k++)
			if (stands_in(&t->condition, at->rung) &&
			    !is_active(at, pou, sfc->ref[k].step))
				return sfc->step[sfc->ref[k].step].name;
	}
	return 0;
}

/* Whether the action may run after its step ended. */
static bool outlives(const struct sfc_use *use)
{
	return use->qualifier == QUALIFIER_S || use->qualifier == QUALIFIER_SD ||
	       use->qualifier == QUALIFIER_DS || use->qualifier == QUALIFIER_SL ||
	       use->qualifier == QUALIFIER_P0;
}

/* The action whose body this is, if no step calls it; 0: one does, or may. */
static uint32_t uncalled_action(const struct why_place *at, const struct pou *pou)
{
	const struct sfc *sfc = pou->sfc;
	int action = 0;

	while (action < sfc->action_count &&
	       !stands_in(&sfc->action[action].body, at->rung))
		action++;
	if (action == sfc->action_count)
		return 0;
	for (int i = 0; i < sfc->use_count; i++) {
		const struct sfc_use *use = &sfc->use[i];

		if (use->kind == USE_ACTION && use->action == action &&
		    (outlives(use) || is_active(at, pou, use->step)))
			return 0;
	}
	return sfc->action[action].name;
}

static void ask_sfc(const struct why_place *at, const struct pou *pou, struct why *out)
{
	const uint32_t step = missing_step(at, pou);
	const uint32_t action = step ? 0 : uncalled_action(at, pou);

	if (step)
		out->whole = WHY_INACTIVE;
	if (action)
		out->whole = WHY_UNCALLED;
	snprintf(out->name, sizeof(out->name), "%.79s",
		 project_text(at->project, step ? step : action));
}

bool why_ask(const struct why_place *at, struct arena *arena, struct why *out)
{
	struct walk *walk = arena_alloc(arena, sizeof(*walk));
	struct why_way *way = arena_alloc(arena, sizeof(*way));
	const struct pou *pou = &at->project->pou[at->pou];
	bool in, through;

	memset(out, 0, sizeof(*out));
	out->whole = WHY_COUNT;
	if (!walk || !way || at->rung < 1 || at->rung > pou->rung_count)
		return false;
	walk->at = at;
	walk->out = out;
	walk->arena = arena;
	walk->rung = pou->rung[at->rung - 1];
	if (at->row < 1 || at->row > walk->rung->rows || at->col < 1 ||
	    at->col > walk->rung->cols)
		return false;
	out->whole = whole_rung(at, pou, &out->by_rung);
	snprintf(out->name, sizeof(out->name), "%d", out->by_rung);
	if (out->whole == WHY_COUNT && pou->sfc)
		ask_sfc(at, pou, out);
	if (out->whole != WHY_COUNT)
		return true;
	if (!network_make(walk->rung, arena, &walk->network))
		return false;
	power_at(at, at->rung, at->row, at->col, &in, &through);
	walk->on = out->on = in;
	walk_net(walk, network_net(&walk->network, at->row - 1, at->col - 1), way);
	if (!out->ways && !out->on)
		out->whole = WHY_NEVER;
	return true;
}
