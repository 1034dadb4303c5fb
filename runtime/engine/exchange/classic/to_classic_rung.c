/* SPDX-License-Identifier: MIT
 *
 * to_classic_rung - what a rung holds, in ClassicLadder's terms: elements, the nets between
 * them, and when each is evaluated here.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"
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
		.col = at->col, .in = at->in, .out = at->out, .order = -1,
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

/* ---- the order of evaluation here ---- */

static void visit(struct out_rung *r, int index);

static void visit_net(struct out_rung *r, int net)
{
	const struct network *n = &r->network;

	if (net == NET_RAIL || net == NET_NONE || r->net_seen[net])
		return;
	r->net_seen[net] = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		visit(r, n->feeder[i]);
}

/* As deep as a rung has columns. */
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

/* ---- what touches what ---- */

static bool reads_pin(struct classic_variable variable, const struct out_part *box)
{
	int kind = pin_kind(variable.type);

	return kind >= 0 && kind == box->slot->block &&
	       variable.number == box->slot->number;
}

bool part_touches(const struct out_part *item, const struct out_part *box)
{
	if (!box->slot || box->slot->block < 0)
		return true;
	if (is_block(item))
		return item->slot->block == box->slot->block &&
		       item->slot->number == box->slot->number;
	for (const char *at = item->text; at && (at = strpbrk(at, "@[")); at++) {
		char *slash, *end;
		const long type = strtol(at + 1, &slash, 10);
		const long number = *slash == '/' ? strtol(slash + 1, &end, 10) : -1;

		if (number >= 0 && reads_pin(variable_of((int)type, (int)number), box))
			return true;
	}
	if (item->text)
		return false;
	return reads_pin(item->variable, box) ||
	       reads_pin(variable_of(item->variable.index_type,
				     item->variable.index_number), box);
}

/* ---- a rung ---- */

static bool prepare(struct leaving *e, struct out_rung *r)
{
	const struct network *n = &r->network;

	if (!network_make(r->rung, e->arena, &r->network))
		return false;
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
		tell_change(e, "a rung that is switched off stays empty there");
		return;
	}
	if (!prepare(e, &r))
		return;
	if (!same_rung(e, &r))
		split_rung(e, &r);
	if (e->good && e->out->rungs == first)
		rung_begin(e);
}
