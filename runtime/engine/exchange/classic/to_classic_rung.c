/* SPDX-License-Identifier: MIT
 *
 * to_classic_rung - makes elements, nets and the order of evaluation of a rung, and draws it
 * cell by cell if ClassicLadder then does the same.
 */
#include "engine/base/ascii.h"
#include "engine/exchange/classic/to_classic_parts.h"
#include "engine/model/args.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- functions with EN as assignments ---- */

static const struct { enum word word; const char *op; } function_rows[] = {
	{ FN_MOVE, "" }, { FN_ADD, " + " }, { FN_SUB, " - " }, { FN_MUL, " * " },
	{ FN_DIV, " / " }, { FN_MOD, " MOD " }, { FN_EQ, " = " }, { FN_NE, " <> " },
	{ FN_GT, " > " }, { FN_GE, " >= " }, { FN_LT, " < " }, { FN_LE, " <= " },
};

static bool function_part(struct leaving *e, const struct cell *cell,
			  struct out_part *item)
{
	const char *args = project_text(e->project, cell->args), *op = NULL;
	const char *target = NULL, *value = NULL;
	struct arg arg;

	for (size_t i = 0; i < sizeof(function_rows) / sizeof(*function_rows); i++)
		if (function_rows[i].word == cell->word)
			op = function_rows[i].op;
	for (const char *next = args; op && args_next(&next, &arg);) {
		if (arg.inverse || ascii_is("EN", arg.pin, arg.pin_len) ||
		    ascii_is("ENO", arg.pin, arg.pin_len))
			op = NULL;
		else if (arg.output)
			target = out_text(e, "%.*s", (int)arg.value_len, arg.value);
		else
			value = out_text(e, "%s%s%.*s", value ? value : "",
					 value ? op : "", (int)arg.value_len, arg.value);
	}
	if (op && value && !target && strpbrk(op, "<>=")) {
		item->code = CL_COMPARE;
		item->width = 3;
		return cell_expression(e, value, item);
	}
	if (!op || !target || !value || strpbrk(op, "<>="))
		return out_refuse(e, DIAG_EXPORT_WORD, "%s",
			      scope_row(e->scope, (enum word)cell->word)->word);
	item->code = CL_OPERATE;
	item->width = 3;
	return cell_expression(e, out_text(e, "%s := %s", target, value), item);
}

/* ---- elements ---- */

static bool contact_part(struct leaving *e, const struct word_row *row,
			 const struct cell *cell, struct out_part *item)
{
	struct out_operand operand;
	bool edge = row->edge != EDGE_NONE;

	if (!there_find(e, cell->operand, &operand))
		return false;
	item->code = row->edge == EDGE_RISING ? CL_RISING :
		     edge ? CL_FALLING : row->negate ? CL_NC : CL_NO;
	item->variable = operand.variable;
	if (!operand.is_constant)
		return true;
	if (edge)
		return out_refuse(e, DIAG_EXPORT_WORD, "%s", row->word);
	item->code = CL_WIRE;
	item->dead = (operand.value != 0) == row->negate;
	return true;
}

static bool coil_part(struct leaving *e, const struct word_row *row,
		      const struct cell *cell, struct out_part *item)
{
	struct out_operand operand;

	if (!there_find(e, cell->operand, &operand))
		return false;
	item->variable = operand.variable;
	item->code = row->number == ELEM_COIL_SET ? CL_SET :
		     row->number == ELEM_COIL_RESET ? CL_RESET :
		     row->negate ? CL_COIL_NOT : CL_COIL;
	item->edge = row->edge == EDGE_RISING ? CL_RISING :
		     row->edge == EDGE_FALLING ? CL_FALLING : 0;
	return true;
}

static bool flow_part(struct leaving *e, const struct word_row *row,
		      const struct cell *cell, struct out_part *item)
{
	item->code = CL_JUMP;
	switch ((int)row->number) {
	case ELEM_JUMP:
		item->label = names_fold(&e->project->names, cell->operand);
		return true;
	case ELEM_END:
		if (e->pou->kind != POU_PROGRAM)
			break;
		item->leaves = true;
		return true;
	case ELEM_RETURN:
		item->leaves = true;
		return true;
	case ELEM_CALL:
		item->code = CL_CALL;
		item->variable = variable_of(0, routine_number(e, cell->operand));
		if (item->variable.number >= 0)
			return true;
	}
	return out_refuse(e, DIAG_EXPORT_WORD, "%s", row->word);
}

static bool element_part(struct leaving *e, const struct word_row *row,
			 const struct cell *cell, struct out_part *item)
{
	const char *text = project_text(e->project, cell->operand);

	if (row->operand == OPND_EXPR || row->operand == OPND_ASSIGN) {
		item->code = row->operand == OPND_EXPR ? CL_COMPARE : CL_OPERATE;
		item->width = 3;
		return cell_expression(e, text, item);
	}
	if (row->number == ELEM_NOT) {
		item->invert = true;
		return true;
	}
	if (row->operand == OPND_BOOL_R)
		return contact_part(e, row, cell, item);
	if (row->operand == OPND_BOOL_W)
		return coil_part(e, row, cell, item);
	return flow_part(e, row, cell, item);
}

static bool is_unread(const struct out_rung *r, const struct network_element *at)
{
	return at->out == NET_RAIL || r->network.reader_count[at->out] == 0;
}

static bool make_part(struct leaving *e, struct out_rung *r, int index)
{
	const struct network_element *at = &r->network.element[index];
	const struct cell *cell = rung_at(r->rung, at->row, at->col);
	const struct word_row *row = scope_row(e->scope, (enum word)at->word);
	struct out_part *item = &r->item[index];
	bool box = row->place == PLACE_BOX || row->kind != WORD_ELEM;

	e->row = at->row + 1;
	e->col = at->col + 1;
	*item = (struct out_part){ .width = 1, .height = 1, .row = at->row,
		.col = at->col, .in = at->in, .out = at->out, .order = -1, .id = index + 1,
		.variable = variable_of(0, 0) };
	for (int i = 0; i < 4; i++) {
		item->pin[i] = NET_NONE;
		item->given[i] = variable_of(-1, 0);
	}
	item->actor = row->place == PLACE_LAST ||
		      (row->kind == WORD_ELEM && box && is_unread(r, at));
	item->output = item->actor || (box && is_unread(r, at));
	if (row->kind == WORD_FN)
		return function_part(e, cell, item);
	if (row->kind != WORD_ELEM)
		return box_part(e, &r->network, at, cell, item);
	return element_part(e, row, cell, item);
}

static void visit_net(struct out_rung *r, int net);

/* The recursion is as deep as a rung has columns. */
static void visit(struct out_rung *r, int index)
{
	const struct network_element *at = &r->network.element[index];
	struct out_part *item = &r->item[index];

	if (item->order >= 0)
		return;
	item->order = 0;
	visit_net(r, at->in);
	for (int i = 0; i < at->pins; i++)
		visit_net(r, r->network.pin[at->first_pin + i].in);
	item->order = ++r->order;
}

static void visit_net(struct out_rung *r, int net)
{
	const struct network *n = &r->network;

	if (net == NET_RAIL || net == NET_NONE || r->net_seen[net])
		return;
	r->net_seen[net] = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		visit(r, n->feeder[i]);
}

/* ---- elements that read what others write ---- */

/* ---- outputs behind a coil ---- */

/* The net whose power an output behind coils has. */
static int before_coils(const struct out_rung *r, int net)
{
	const struct network *n = &r->network;

	while (net != NET_RAIL && n->first_feeder[net + 1] == n->first_feeder[net] + 1) {
		const struct network_element *only = &n->element[n->feeder[n->first_feeder[net]]];

		if (word_row((enum word)only->word)->operand != OPND_BOOL_W)
			break;
		net = only->in;
	}
	return net;
}

/* Connects outputs behind a coil to the net before it. Other elements may lead to a net, too;
 * then the coil stays one of its feeders. */
static void part_coils(struct out_rung *r)
{
	struct network *n = &r->network;

	for (int i = 0; i < n->element_count; i++) {
		struct network_element *at = &n->element[i];
		const int net = before_coils(r, at->in);

		n->reader_count[at->in]--;
		n->reader_count[net]++;
		at->in = net;
	}
}

/* ---- a rung ---- */

static bool prepare(struct leaving *e, struct out_rung *r)
{
	const struct network *n = &r->network;

	if (!network_make(r->rung, e->arena, &r->network))
		return false;
	part_coils(r);
	r->count = n->element_count;
	r->item = arena_alloc(e->arena, ((size_t)r->count + 1) * sizeof(*r->item));
	r->net_seen = arena_alloc(e->arena, ((size_t)n->net_count + 1));
	if (!r->item || !r->net_seen)
		return false;
	for (int i = 0; i < r->count; i++)
		if (!make_part(e, r, i))
			return false;
	r->plain = true;
	for (int i = 0; i < r->count; i++) {
		const struct out_part *item = &r->item[i];
		bool box = is_block(item) || item->code == CL_PART;
		bool middle = !item->actor && (item->code == CL_OPERATE ||
					       item->code == CL_CALL);

		if (item->output)
			visit(r, i);
		r->boxes |= box || middle || (item->before && !item->actor);
		if (item->invert || item->before || item->edge || middle ||
		    (box && !box_is_plain(item)))
			r->plain = false;
	}
	return true;
}

enum { ITEMS = 120, RAIL_BIT = 127, LOST_BIT = 126 };

struct drawing {
	struct leaving *e;
	struct out_rung *r;
	struct classic_rung *rung;
	int pos[LIMIT_COLS + 1];
	int part_at[CLASSIC_ROWS][CLASSIC_COLUMNS]; /* number + 1, at its last column */
	int x[ITEMS];
	bool bad;
};

static int width_of(const struct out_rung *r, int col)
{
	int width = 0;

	for (int i = 0; i < r->count; i++)
		if (r->item[i].col == col && !r->item[i].actor &&
		    r->item[i].width > width)
			width = r->item[i].width;
	for (int y = 0; y < r->rung->rows; y++)
		if (!width && rung_at(r->rung, y, col)->word == ELEM_WIRE)
			width = 1;
	return width;
}

static bool find_columns(struct drawing *d)
{
	const struct out_rung *r = d->r;
	int cols = r->rung->cols;

	for (int i = 0; i < r->count; i++)
		if (is_block(&r->item[i]) && r->item[i].col == 0)
			d->pos[0] = 1;
	for (int c = 0; c < cols; c++)
		d->pos[c + 1] = d->pos[c] + width_of(r, c);
	return d->pos[cols] <= d->e->columns;
}

/* ---- placing ---- */

static void put_code(struct drawing *d, int y, int x, int code)
{
	struct classic_cell *cell;

	if (y >= d->e->rows || x < 0 || x >= d->e->columns) {
		d->bad = true;
		return;
	}
	cell = &d->rung->cell[y][x];
	d->bad |= cell->element != CL_FREE;
	cell->element = code;
	cell->variable = variable_of(0, 0);
}

static void put_wires(struct drawing *d, int y, int from, int to)
{
	for (int x = from; x < to; x++)
		put_code(d, y, x, CL_WIRE);
}

static void place_part(struct drawing *d, int index)
{
	const struct out_part *item = &d->r->item[index];
	int x = d->pos[item->col], end = d->pos[item->col + 1], y = item->row;
	struct classic_rung *rung = d->rung;

	if (item->actor) {
		end = d->e->columns - item->width;
		put_wires(d, y, x, end);
		x = end;
		end = x + item->width;
	}
	if (item->dead)
		return;
	for (int i = 0; i < item->height; i++)
		for (int k = 0; k < item->width; k++)
			put_code(d, y + i, x + k, CL_PART);
	if (d->bad)
		return;
	out_put(d->e, rung, y, x, item);
	d->x[index] = x + item->width - 1;
	d->part_at[y][d->x[index]] = index + 1;
	put_wires(d, y, x + item->width, end);
}

static bool leads_on(const struct cell *cell)
{
	return cell->word != ELEM_EMPTY && (cell->word != ELEM_PIN || cell->operand);
}

static void place_all(struct drawing *d)
{
	const struct rung *rung = d->r->rung;

	for (int i = 0; i < d->r->count; i++)
		place_part(d, i);
	for (int y = 0; y < rung->rows; y++) {
		for (int c = 0; c < rung->cols; c++) {
			const struct cell *cell = rung_at(rung, y, c);

			if (cell->word == ELEM_WIRE)
				put_wires(d, y, d->pos[c], d->pos[c + 1]);
			if (cell->link && d->pos[c + 1] < d->e->columns)
				d->rung->cell[y][d->pos[c + 1]].top = true;
		}
		if (d->pos[0] && leads_on(rung_at(rung, y, 0)))
			put_wires(d, y, 0, 1);
	}
}

/* Sources of power: a bit for each element, the rail, and outputs that must not be read. */
struct sources { uint64_t bit[2]; };

/* ---- sources of power in the drawing, by the rule of ClassicLadder ---- */

struct power { struct sources out[CLASSIC_ROWS][CLASSIC_COLUMNS]; };

static void sources_add(struct sources *to, int bit)
{
	to->bit[bit / 64] |= UINT64_C(1) << bit % 64;
}

static void sources_join(struct sources *to, struct sources from)
{
	to->bit[0] |= from.bit[0];
	to->bit[1] |= from.bit[1];
}

static struct sources left_of(const struct drawing *d, const struct power *power, int y,
			      int x)
{
	struct sources left = { { 0, 0 } };
	int from = y, to = y;

	if (x == 0) {
		sources_add(&left, RAIL_BIT);
		return left;
	}
	while (from > 0 && d->rung->cell[from][x].top)
		from--;
	while (to + 1 < d->e->rows && d->rung->cell[to + 1][x].top)
		to++;
	for (int i = from; i <= to; i++)
		sources_join(&left, power->out[i][x - 1]);
	return left;
}

/* ---- sources of power in the network ---- */

static void expected(const struct out_rung *r, int net, struct sources *out, int depth)
{
	const struct network *n = &r->network;

	if (net == NET_NONE || depth > LIMIT_COLS)
		return;
	if (net == NET_RAIL) {
		sources_add(out, RAIL_BIT);
		return;
	}
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++) {
		const struct out_part *item = &r->item[n->feeder[i]];

		if (item->dead)
			continue;
		if (item->code == CL_WIRE || item->actor)
			expected(r, item->in, out, depth + 1);
		else
			sources_add(out, n->feeder[i]);
	}
}

static bool is_expected(struct drawing *d, struct sources left, int net)
{
	struct sources want = { { 0, 0 } };

	expected(d->r, net, &want, 0);
	return want.bit[0] == left.bit[0] && want.bit[1] == left.bit[1];
}

static bool check_part(struct drawing *d, const struct power *power, int index, int y,
		       int x)
{
	const struct out_part *item = &d->r->item[index];

	x -= item->width - 1;
	if (!is_block(item))
		return is_expected(d, left_of(d, power, y, x), item->in);
	for (int i = 0; i < item->height; i++)
		if ((item->slot->block != CLASSIC_IEC_TIMER && item->slot->block != CLASSIC_MONOSTABLE) ||
		    i == 0)
			if ((item->slot->block != CLASSIC_TIMER || i < 2) &&
			    !is_expected(d, left_of(d, power, y + i, x), item->pin[i]))
				return false;
	return true;
}

static void give_power(struct drawing *d, struct power *power, int index, int y, int x)
{
	const struct out_part *item = &d->r->item[index];

	if (item->actor)
		return;
	sources_add(&power->out[y][x], index);
	for (int i = 1; is_block(item) && i < item->height; i++)
		sources_add(&power->out[y + i][x], LOST_BIT);
}

static bool means_the_same(struct drawing *d)
{
	struct power *power = arena_alloc(d->e->arena, sizeof(*power));

	if (!power)
		return false;
	for (int x = 0; x < d->e->columns; x++)
		for (int y = 0; y < d->e->rows; y++) {
			int index = d->part_at[y][x] - 1;

			if (d->rung->cell[y][x].element == CL_WIRE)
				power->out[y][x] = left_of(d, power, y, x);
			if (index < 0 || d->rung->cell[y][x].element == CL_WIRE)
				continue;
			if (!check_part(d, power, index, y, x))
				return false;
			give_power(d, power, index, y, x);
		}
	return true;
}

/* Do elements that read a block keep their order? ClassicLadder goes column by column, a rung
 * here from its outputs back. */
static bool same_order(const struct drawing *d)
{
	const struct out_rung *r = d->r;

	for (int i = 0; i < r->count; i++) {
		const struct out_part *box = &r->item[i];

		for (int k = 0; is_block(box) && k < r->count; k++) {
			const struct out_part *item = &r->item[k];
			int there = (d->x[k] - d->x[i]) * 256 + item->row - box->row;

			if (k == i || item->actor || item->order < 0 || item->dead ||
			    item->code == CL_WIRE || !part_touches(item, box))
				continue;
			/* An import would cut here. Cut now, so that the text stays the same. */
			if ((item->order < box->order) != (there < 0) ||
			    (d->x[k] <= d->x[i] && item->row < box->row))
				return false;
		}
	}
	return true;
}

static bool actors_apart(const struct out_rung *r)
{
	for (int i = 1; i < r->count; i++)
		for (int k = 0; k < i; k++)
			if (r->item[i].actor && r->item[k].actor &&
			    r->item[i].row == r->item[k].row)
				return false;
	return true;
}

/* A jump that nothing feeds needs no target: such a rung is split. */
static bool jumps_dead(const struct out_rung *r)
{
	for (int i = 0; i < r->count; i++) {
		struct sources sources = { { 0, 0 } };

		if (!r->item[i].actor || r->item[i].code != CL_JUMP)
			continue;
		expected(r, r->item[i].in, &sources, 0);
		if (!sources.bit[0] && !sources.bit[1])
			return true;
	}
	return false;
}

/* Draws the rung as it is. false: it does not fit or would do something else; nothing is
 * written. */
static bool same_rung(struct leaving *e, struct out_rung *r)
{
	struct drawing *d = arena_alloc(e->arena, sizeof(*d));
	struct classic_rung *rung;

	if (!d || !r->plain || r->count > ITEMS || r->rung->rows > e->rows)
		return false;
	d->e = e;
	d->r = r;
	d->rung = arena_alloc(e->arena, sizeof(*d->rung));
	for (int i = 0; d->rung && i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		d->rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].variable =
			variable_of(0, 0);
	if (!d->rung || !actors_apart(r) || jumps_dead(r) || !find_columns(d))
		return false;
	place_all(d);
	if (d->bad || !means_the_same(d) || !same_order(d))
		return false;
	rung = rung_begin(e);
	if (!rung)
		return true;
	memcpy(rung->cell, d->rung->cell, sizeof(rung->cell));
	for (int i = 0; i < r->count; i++)
		if (r->item[i].actor && r->item[i].code == CL_JUMP) {
			e->row = r->item[i].row + 1;
			e->col = r->item[i].col + 1;
			note_jump(e, &rung->cell[r->item[i].row][e->columns - 1],
				  &r->item[i]);
		}
	return true;
}

/* Reports the elements that neither drawing has: nothing is lost silently. A constant is no
 * element of ClassicLadder but a wire or a gap. */
static void report_left_out(struct leaving *e, const struct out_rung *r)
{
	for (int i = 0; i < r->count && e->good; i++) {
		const struct out_part *item = &r->item[i];
		const struct cell *cell = rung_at(r->rung, item->row, item->col);

		if (e->written[item->id] || item->code == CL_WIRE)
			continue;
		e->row = item->row + 1;
		e->col = item->col + 1;
		if (item->text)
			tell_lost(e, "\"[ %s ]\" never has power",
				  project_text(e->project, cell->operand));
		else
			tell_lost(e, "\"%s %s\" never has power",
				  scope_row(e->scope, (enum word)cell->word)->word,
				  project_text(e->project, cell->operand));
	}
}

void leave_rung(struct leaving *e, const struct rung *rung)
{
	struct out_rung r = { .rung = rung };
	int first = e->out->rungs;

	e->comment = project_text(e->project, rung->title);
	e->rung_label = rung->label;
	e->helpers_used = 0;
	if (rung->label) {
		struct out_label *label = arena_push(e->arena, &e->label, &e->labels,
						     sizeof(*label));

		if (label)
			*label = (struct out_label){ names_fold(&e->project->names,
							rung->label), first };
	}
	if (rung->off) {
		rung_begin(e);
		tell_change(e, "a rung that is switched off is exported as an empty rung");
		return;
	}
	if (!prepare(e, &r))
		return;
	e->written = arena_alloc(e->arena, (size_t)r.count + 1);
	if (!e->written)
		return;
	if (!same_rung(e, &r)) {
		memset(e->written, 0, (size_t)r.count + 1);
		split_rung(e, &r);
	}
	report_left_out(e, &r);
	e->written = NULL;
	if (e->good && e->out->rungs == first)
		rung_begin(e);
}
