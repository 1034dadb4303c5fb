/* SPDX-License-Identifier: MIT
 *
 * plcopen_write_rung - rungs as drawn elements of a body.
 *
 * Power is a connection; where several elements lead to one net, all of them are connected with
 * what the net leads to. An expression in a cell is an AND with an expression at its second pin, an
 * assignment is a MOVE. A rung with elements that the format does not have becomes a comment.
 */
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/args.h"
#include "engine/model/network.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

enum { LEFT = 40, COLUMN = 160, ROW = 60, PIN = 20, CONTACT_WIDTH = 21, CONTACT_HEIGHT = 15,
       BOX_WIDTH = 80 };

struct ref { int id; const char *pin; }; /* an output; pin NULL: the only one */

struct drawing {
	struct out *out;
	const struct rung *rung;
	struct network net;
	int rail, number;       /* its localId; the rung, 1-based                  */
	struct ref *ref;        /* of each element of the network                  */
	struct ref *given;      /* inVariables of the box in work                  */
	int givens, pitch;      /* pitch: height of a row                          */
	int *order;             /* of each element: its place in the order         */
	int *seen;              /* of each element: by which coil it was looked at */
};

static int next_id(struct drawing *d)
{
	return ++d->out->ids;
}

static const struct cell *cell_of(const struct drawing *d, const struct network_element *e)
{
	return rung_at(d->rung, e->row, e->col);
}

static int x_of(const struct network_element *e)
{
	return LEFT + COLUMN / 2 + e->col * COLUMN;
}

static int y_of(const struct drawing *d, int row)
{
	return d->out->y + row * d->pitch;
}

/* ---- connections ---- */

static void put_ref(struct out *out, struct ref ref)
{
	plco_connection(out, ref.id, ref.pin);
}

static void put_sources(struct drawing *d, int net)
{
	if (net == NET_RAIL) {
		put_ref(d->out, (struct ref){ d->rail, NULL });
		return;
	}
	for (int i = d->net.first_feeder[net]; i < d->net.first_feeder[net + 1]; i++)
		put_ref(d->out, d->ref[d->net.feeder[i]]);
}

static void put_in(struct drawing *d, int net)
{
	plco_open(d->out, "connectionPointIn");
	put_sources(d, net);
	plco_close(d->out, "connectionPointIn");
}

static void put_position(struct out *out, int x, int y)
{
	plco_position(out, x, y);
}

/* ---- the order ---- */

static int outputs_in(const char *args)
{
	struct arg arg;
	int count = 0;

	while (args_next(&args, &arg))
		count += arg.output;
	return count;
}

/* Numbers what @net needs, then the element itself; power flows from left to right, so this ends. */
static void order_net(struct drawing *d, int net);

static void order_element(struct drawing *d, int at)
{
	const struct network_element *e = &d->net.element[at];

	if (d->order[at])
		return;
	d->order[at] = -1;
	order_net(d, e->in);
	for (int i = e->first_pin; i < e->first_pin + e->pins; i++)
		order_net(d, d->net.pin[i].in);
	d->order[at] = d->out->order + 1;
	d->out->order += 1 + outputs_in(plco_id(d->out, cell_of(d, e)->args));
	d->out->order += e->word == ELEM_ASSIGN;
}

static void order_net(struct drawing *d, int net)
{
	for (int i = net == NET_RAIL || net < 0 ? 0 : d->net.first_feeder[net];
	     net > NET_RAIL && i < d->net.first_feeder[net + 1]; i++)
		order_element(d, d->net.feeder[i]);
}

/* The attribute of an element, or of one of the variables that it writes. */
static const char *number(struct drawing *d, const struct network_element *e, int further)
{
	if (!d->out->numbered)
		return "";
	return plco_print(d->out, " executionOrderId=\"%d\"", d->order[e - d->net.element] + further);
}

/* ---- contacts and coils ---- */

static void put_operand(struct drawing *d, const struct network_element *e, const char *kind,
			const char *attributes)
{
	const struct cell *cell = cell_of(d, e);

	plco_open(d->out, "%s localId=\"%d\" height=\"%d\" width=\"%d\"%s%s", kind,
		 d->ref[e - d->net.element].id, CONTACT_HEIGHT, CONTACT_WIDTH, attributes,
		 !strcmp(kind, "coil") ? number(d, e, 0) : "");
	put_position(d->out, x_of(e), y_of(d, e->row));
	put_in(d, e->in);
	plco_line(d->out, "connectionPointOut");
	plco_text(d->out, "variable", d->out->coil && !strcmp(plco_id(d->out, cell->operand), SFC_CONDITION) ?
		 d->out->coil : plco_id(d->out, cell->operand));
	plco_documentation(d->out, plco_id(d->out, cell->comment));
	plco_close(d->out, kind);
}

static void put_jump(struct drawing *d, const struct network_element *e, bool jump)
{
	const int id = d->ref[e - d->net.element].id;

	if (jump)
		plco_open(d->out, "jump localId=\"%d\" label=\"%s\"%s", id, plco_id(d->out, cell_of(d, e)->operand),
			 number(d, e, 0));
	else
		plco_open(d->out, "return localId=\"%d\"%s", id, number(d, e, 0));
	put_position(d->out, x_of(e), y_of(d, e->row));
	put_in(d, e->in);
	plco_close(d->out, jump ? "jump" : "return");
}

/* ---- boxes ---- */

static struct ref give(struct drawing *d, int x, int y, const char *expression)
{
	struct ref ref = { next_id(d), NULL };

	plco_place(d->out, ref.id, x + BOX_WIDTH, y);
	plco_open(d->out, "inVariable localId=\"%d\" height=\"%d\" width=\"%d\"", ref.id, PIN, BOX_WIDTH);
	put_position(d->out, x, y);
	plco_line(d->out, "connectionPointOut");
	plco_text(d->out, "expression", expression);
	plco_close(d->out, "inVariable");
	return ref;
}

static void store(struct drawing *d, int x, int y, const char *name, struct ref from, const char *order)
{
	plco_open(d->out, "outVariable localId=\"%d\" height=\"%d\" width=\"%d\"%s", next_id(d), PIN, BOX_WIDTH, order);
	put_position(d->out, x, y);
	plco_open(d->out, "connectionPointIn");
	put_ref(d->out, from);
	plco_close(d->out, "connectionPointIn");
	plco_text(d->out, "expression", name);
	plco_close(d->out, "outVariable");
}

static bool runs_lines(const struct network_element *e)
{
	return e->word == ELEM_CALL || e->word == ELEM_EXECUTE;
}

static void open_box(struct drawing *d, const struct network_element *e, const char *type,
		     const char *instance)
{
	const int id = d->ref[e - d->net.element].id;

	if (instance)
		plco_open(d->out, "block localId=\"%d\" typeName=\"%s\" instanceName=\"%s\" height=\"%d\" width=\"%d\"%s",
			 id, type, instance, ROW, BOX_WIDTH, number(d, e, 0));
	else
		plco_open(d->out, "block localId=\"%d\" typeName=\"%s\" height=\"%d\" width=\"%d\"%s", id, type, ROW,
			 BOX_WIDTH, runs_lines(e) ? number(d, e, 0) : "");
	put_position(d->out, x_of(e), y_of(d, e->row));
}

static void open_pin(struct drawing *d, const char *name, bool negated)
{
	plco_open(d->out, "variable formalParameter=\"%s\"%s", name, negated ? " negated=\"true\"" : "");
	plco_open(d->out, "connectionPointIn");
}

static void close_pin(struct drawing *d)
{
	plco_close(d->out, "connectionPointIn");
	plco_close(d->out, "variable");
}

static void put_output(struct drawing *d, const char *name)
{
	plco_output(d->out, name, false, BOX_WIDTH);
}

/* A box of a function with power at one pin and a text at another one. */
static void put_with_text(struct drawing *d, const struct network_element *e, const char *type,
			  const char *power, const char *pin, const char *text)
{
	struct ref given = { 0, NULL };

	if (pin)
		given = give(d, x_of(e) - BOX_WIDTH - PIN, y_of(d, e->row) + 2 * PIN, text);
	open_box(d, e, type, NULL);
	plco_open(d->out, "inputVariables");
	open_pin(d, power, false);
	put_sources(d, e->in);
	close_pin(d);
	if (pin) {
		open_pin(d, pin, false);
		put_ref(d->out, given);
		close_pin(d);
	}
	plco_close(d->out, "inputVariables");
	plco_line(d->out, "inOutVariables");
	plco_open(d->out, "outputVariables");
	if (!strcmp(power, "EN"))
		put_output(d, "ENO");
	put_output(d, "OUT");
	plco_close(d->out, "outputVariables");
	plco_close(d->out, "block");
}

static void put_assignment(struct drawing *d, const struct network_element *e)
{
	const char *text = plco_id(d->out, cell_of(d, e)->operand), *colon = strstr(text, ":=");
	const int id = d->ref[e - d->net.element].id;

	if (!colon)
		return;
	put_with_text(d, e, "MOVE", "EN", "IN", colon + 2 + strspn(colon + 2, " "));
	store(d, x_of(e) + BOX_WIDTH + PIN, y_of(d, e->row) + 2 * PIN,
	      plco_print(d->out, "%.*s", (int)strcspn(text, " :"), text), (struct ref){ id, "OUT" }, number(d, e, 1));
}

static const struct word_row *row_of(const struct drawing *d, const struct network_element *e)
{
	return words_row(&d->out->project->words, (enum word)e->word);
}

static const char *arg_text(struct drawing *d, const char *text, size_t len)
{
	return plco_print(d->out, "%.*s", (int)len, text);
}

static void give_arguments(struct drawing *d, const struct network_element *e, const char *args)
{
	struct arg arg;

	d->givens = 0;
	for (const char *at = args; args_next(&at, &arg) && d->givens < LIMIT_ARGS; )
		if (!arg.output) {
			d->given[d->givens] = give(d, x_of(e) - BOX_WIDTH - PIN,
						   y_of(d, e->row) + PIN * (d->givens + 2), arg_text(d, arg.value, arg.value_len));
			d->givens++;
		}
}

/* The inputs with an argument, then those that a branch feeds. */
static void put_inputs(struct drawing *d, const struct network_element *e, const char *power,
		       const char *args)
{
	struct arg arg;
	int given = 0;

	plco_open(d->out, "inputVariables");
	if (power) {
		open_pin(d, power, false);
		put_sources(d, e->in);
		close_pin(d);
	}
	for (int i = e->first_pin; i < e->first_pin + e->pins; i++) {
		open_pin(d, plco_id(d->out, d->net.pin[i].operand), false);
		put_sources(d, d->net.pin[i].in);
		close_pin(d);
	}
	for (const char *at = args; args_next(&at, &arg) && given < d->givens; )
		if (!arg.output) {
			open_pin(d, arg_text(d, arg.pin, arg.pin_len), arg.inverse);
			put_ref(d->out, d->given[given++]);
			close_pin(d);
		}
	plco_close(d->out, "inputVariables");
	plco_line(d->out, "inOutVariables");
}

static void store_outputs(struct drawing *d, const struct network_element *e, const char *args)
{
	struct arg arg;
	int count = 0;

	for (const char *at = args; args_next(&at, &arg); )
		if (arg.output) {
			count++;
			store(d, x_of(e) + BOX_WIDTH + PIN, y_of(d, e->row) + PIN * count,
			      arg_text(d, arg.value, arg.value_len),
			      (struct ref){ d->ref[e - d->net.element].id, arg_text(d, arg.pin, arg.pin_len) },
			      number(d, e, count));
		}
}

static void put_block(struct drawing *d, const struct network_element *e)
{
	const struct word_row *row = row_of(d, e);
	const struct cell *cell = cell_of(d, e);
	const char *args = plco_id(d->out, cell->args);
	const int power = word_first_bool(row, PIN_IN), first = word_first_bool(row, PIN_OUT);

	/* Without an input or an output of type BOOL the power goes through EN and ENO. */
	give_arguments(d, e, args);
	open_box(d, e, row->word, plco_id(d->out, cell->operand));
	put_inputs(d, e, power >= 0 ? word_pins(row)[power].name : e->in != NET_RAIL ? "EN" : NULL, args);
	plco_open(d->out, "outputVariables");
	if (first < 0)
		put_output(d, "ENO");
	for (int i = 0; i < row->pin_count; i++)
		if (word_pins(row)[i].dir == PIN_OUT || word_pins(row)[i].dir == PIN_IN_OUT)
			put_output(d, word_pins(row)[i].name);
	plco_close(d->out, "outputVariables");
	plco_documentation(d->out, plco_id(d->out, cell->comment));
	plco_close(d->out, "block");
	store_outputs(d, e, args);
}

/* A comparison at the rail is without EN: its result is the power. */
static void put_function(struct drawing *d, const struct network_element *e)
{
	const struct word_row *row = row_of(d, e);
	const struct cell *cell = cell_of(d, e);
	const char *args = plco_id(d->out, cell->args);
	const bool test = word_is_test(row);
	const struct ref whole = d->ref[e - d->net.element];

	if (test && e->in != NET_RAIL) {
		d->ref[e - d->net.element].id = next_id(d);
		plco_place(d->out, d->ref[e - d->net.element].id, x_of(e) + BOX_WIDTH, y_of(d, e->row));
	}
	give_arguments(d, e, args);
	open_box(d, e, row->word, NULL);
	put_inputs(d, e, test ? NULL : "EN", args);
	plco_open(d->out, "outputVariables");
	if (!test)
		put_output(d, "ENO");
	put_output(d, "OUT");
	plco_close(d->out, "outputVariables");
	plco_documentation(d->out, plco_id(d->out, cell->comment));
	plco_close(d->out, "block");
	store_outputs(d, e, args);
	if (!test || e->in == NET_RAIL)
		return;
	/* Behind other elements it is an AND with their power. */
	d->given[0] = d->ref[e - d->net.element];
	d->ref[e - d->net.element] = whole;
	open_box(d, e, "AND", NULL);
	plco_open(d->out, "inputVariables");
	open_pin(d, "IN1", false);
	put_sources(d, e->in);
	close_pin(d);
	open_pin(d, "IN2", false);
	put_ref(d->out, d->given[0]);
	close_pin(d);
	plco_close(d->out, "inputVariables");
	plco_line(d->out, "inOutVariables");
	plco_open(d->out, "outputVariables");
	put_output(d, "OUT");
	plco_close(d->out, "outputVariables");
	plco_close(d->out, "block");
}

static void put_expression(struct drawing *d, const struct network_element *e)
{
	const char *text = plco_id(d->out, cell_of(d, e)->operand);

	put_with_text(d, e, "AND", "IN1", "IN2", text);
}

static void put_inverter(struct drawing *d, const struct network_element *e)
{
	put_with_text(d, e, "NOT", "IN", NULL, NULL);
}

/* As CODESYS and TwinCAT write it. */
static void put_code(struct drawing *d, const char *text)
{
	struct out *out = d->out;

	plco_open(out, "addData");
	plco_open(out, "data name=\"http://www.3s-software.com/plcopenxml/fbdcalltype\" handleUnknown=\"implementation\"");
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<CallType xmlns=\"\">execute</CallType>\n");
	plco_close(out, "data");
	plco_open(out, "data name=\"http://www.3s-software.com/plcopenxml/stcode\" handleUnknown=\"implementation\"");
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<STCode xmlns=\"\">");
	plco_escape(out, plco_words(out, text));
	sink_text(&out->sink, "</STCode>\n");
	plco_close(out, "data");
	plco_close(out, "addData");
}

/* The call of an action is a box with its name. */
static void put_call(struct drawing *d, const struct network_element *e)
{
	const bool code = e->word == ELEM_EXECUTE;

	open_box(d, e, code ? "EXECUTE" : plco_id(d->out, cell_of(d, e)->operand), NULL);
	plco_open(d->out, "inputVariables");
	open_pin(d, "EN", false);
	put_sources(d, e->in);
	close_pin(d);
	plco_close(d->out, "inputVariables");
	plco_line(d->out, "inOutVariables");
	plco_open(d->out, "outputVariables");
	put_output(d, "ENO");
	plco_close(d->out, "outputVariables");
	if (code)
		put_code(d, plco_id(d->out, cell_of(d, e)->args));
	plco_documentation(d->out, plco_id(d->out, cell_of(d, e)->comment));
	plco_close(d->out, "block");
}

/* The format has no STOP: it is a box of that name. */
static void put_stop(struct drawing *d, const struct network_element *e)
{
	open_box(d, e, "STOP", NULL);
	plco_open(d->out, "inputVariables");
	open_pin(d, "EN", false);
	put_sources(d, e->in);
	close_pin(d);
	plco_close(d->out, "inputVariables");
	plco_line(d->out, "inOutVariables");
	plco_line(d->out, "outputVariables");
	plco_documentation(d->out, plco_id(d->out, cell_of(d, e)->comment));
	plco_close(d->out, "block");
}

static void put_element(struct drawing *d, const struct network_element *e)
{
	switch ((int)e->word) {
	case ELEM_CONTACT_NO:
		put_operand(d, e, "contact", "");
		break;
	case ELEM_CONTACT_NC:
		put_operand(d, e, "contact", " negated=\"true\"");
		break;
	case ELEM_CONTACT_P:
		put_operand(d, e, "contact", " edge=\"rising\"");
		break;
	case ELEM_CONTACT_N:
		put_operand(d, e, "contact", " edge=\"falling\"");
		break;
	case ELEM_COIL:
		put_operand(d, e, "coil", "");
		break;
	case ELEM_COIL_NOT:
		put_operand(d, e, "coil", " negated=\"true\"");
		break;
	case ELEM_COIL_SET:
		put_operand(d, e, "coil", " storage=\"set\"");
		break;
	case ELEM_COIL_RESET:
		put_operand(d, e, "coil", " storage=\"reset\"");
		break;
	case ELEM_COIL_P:
		put_operand(d, e, "coil", " edge=\"rising\"");
		break;
	case ELEM_COIL_N:
		put_operand(d, e, "coil", " edge=\"falling\"");
		break;
	case ELEM_JUMP:
	case ELEM_RETURN:
	case ELEM_END: /* of a program: elsewhere it is missing */
		put_jump(d, e, e->word == ELEM_JUMP);
		break;
	case ELEM_STOP:
		put_stop(d, e);
		break;
	case ELEM_NOT:
		put_inverter(d, e);
		break;
	case ELEM_COMPARE:
		put_expression(d, e);
		break;
	case ELEM_CALL:
	case ELEM_EXECUTE:
		put_call(d, e);
		break;
	case ELEM_ASSIGN:
		put_assignment(d, e);
		break;
	default:
		if (row_of(d, e)->kind == WORD_FB)
			put_block(d, e);
		else
			put_function(d, e);
		break;
	}
}

/* ---- rungs ---- */

/* The word of the first element that the format does not have; NULL: it has all. */
static const char *missing(const struct drawing *d)
{
	for (int i = 0; i < d->net.element_count; i++) {
		const enum word word = (enum word)d->net.element[i].word;

		if (word == ELEM_END || word == ELEM_CALL || word == ELEM_FOR || word == ELEM_NEXT) {
			if (word == ELEM_END && d->out->pou && d->out->pou->kind == POU_PROGRAM)
				continue;
			if (word == ELEM_CALL && plco_is_action(d->out, plco_id(d->out, cell_of(d, &d->net.element[i])->operand)))
				continue;
			return words_row(&d->out->project->words, word)->word;
		}
	}
	return NULL;
}

static void put_comment(struct out *out, int y, const char *text)
{
	if (!*text)
		return;
	plco_open(out, "comment localId=\"%d\" height=\"%d\" width=\"%d\"", ++out->ids, PIN * 2, COLUMN * 3);
	put_position(out, LEFT, y);
	plco_formatted(out, "content", text);
	plco_close(out, "comment");
}

static void put_label(struct drawing *d)
{
	struct out *out = d->out;

	if (!d->rung->label)
		return;
	plco_open(out, "label localId=\"%d\" label=\"%s\"", ++out->ids, plco_id(out, d->rung->label));
	put_position(out, LEFT, out->y);
	plco_close(out, "label");
	out->y += ROW / 2;
}

static void put_heading(struct drawing *d)
{
	struct out *out = d->out;
	const char *title = plco_id(out, d->rung->title), *comment = plco_bare(out, plco_id(out, d->rung->comment));

	put_comment(out, out->y, *title && *comment ? plco_print(out, "%s\n%s", comment, title) :
		    *title ? title : comment);
	if (*title || *comment)
		out->y += ROW;
	put_label(d);
}

static void put_as_comment(struct drawing *d, const char *word)
{
	char *text = text_write_rung(d->out->project, d->rung);

	if (word)
		plco_lost(d->out, REPORT_LOST, (int)d->rung->line, d->number, report_said(d->out->report,
			  REPORTED("the format has no %s: the rung becomes a comment")), word);
	else
		plco_lost(d->out, REPORT_LOST, (int)d->rung->line, d->number, "%s", report_said(d->out->report,
			  REPORTED("the rung is OFF and becomes a comment")));
	put_label(d);
	put_comment(d->out, d->out->y, text ? text : "");
	d->out->y += ROW;
	free(text);
}

static int tallest(const struct drawing *d)
{
	int most = ROW;

	for (int i = 0; i < d->net.element_count; i++) {
		const struct word_row *row = row_of(d, &d->net.element[i]);
		const int height = row->kind == WORD_ELEM ? ROW : PIN * (row->pin_count + 4);

		most = height > most ? height : most;
	}
	return most;
}

/* ---- a coil that others of its rung read ---- */

/* What acts when all of its rung was read. */
static bool is_last(const struct network_element *e)
{
	switch ((int)e->word) {
	case ELEM_ASSIGN:
	case ELEM_COIL:
	case ELEM_COIL_NOT:
	case ELEM_COIL_SET:
	case ELEM_COIL_RESET:
	case ELEM_COIL_P:
	case ELEM_COIL_N:
		return true;
	default:
		return false;
	}
}

static const char *written(const struct drawing *d, const struct network_element *e)
{
	const char *text = plco_id(d->out, cell_of(d, e)->operand);

	return e->word == ELEM_ASSIGN ? plco_print(d->out, "%.*s", (int)strcspn(text, " :"), text) : text;
}

/* Does @text name the variable that @name begins with? */
static bool mentions(const char *text, const char *name)
{
	const size_t base = strcspn(name, ".[");
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END)
		if (ascii_same(lex.token.text, name, base) && (lex.token.len == base ||
		    (lex.token.len > base && lex.token.text[base] == '.') || name[0] == '%'))
			return true;
	return false;
}

static bool net_reads(struct drawing *d, int net, int coil);

static bool element_reads(struct drawing *d, int at, int coil)
{
	const struct network_element *e = &d->net.element[at];
	const struct cell *cell = cell_of(d, e);
	const char *name = written(d, &d->net.element[coil]);
	const bool box = row_of(d, e)->kind != WORD_ELEM;

	if (d->seen[at] == coil + 1)
		return false;
	d->seen[at] = coil + 1;
	/* A box that was called before has read what it needs. */
	if (box && d->order[at] < d->order[coil])
		return false;
	if (!is_last(e) && (mentions(plco_id(d->out, cell->operand), name) || mentions(plco_id(d->out, cell->args), name)))
		return true;
	for (int i = e->first_pin; i < e->first_pin + e->pins; i++)
		if (net_reads(d, d->net.pin[i].in, coil))
			return true;
	return net_reads(d, e->in, coil);
}

static bool net_reads(struct drawing *d, int net, int coil)
{
	for (int i = net <= NET_RAIL ? 0 : d->net.first_feeder[net];
	     net > NET_RAIL && i < d->net.first_feeder[net + 1]; i++)
		if (element_reads(d, d->net.feeder[i], coil))
			return true;
	return false;
}

/* Elsewhere a coil is written before what acts behind it reads; here a rung reads first. */
static void report_readers(struct drawing *d)
{
	for (int i = 0; i < d->net.element_count; i++)
		for (int k = 0; is_last(&d->net.element[i]) && k < d->net.element_count; k++) {
			const struct network_element *e = &d->net.element[k];
			const bool acts = is_last(e) || e->word == ELEM_JUMP || e->word == ELEM_RETURN ||
					  row_of(d, e)->kind != WORD_ELEM;

			if (!acts || d->order[k] <= d->order[i] || !element_reads(d, k, i))
				continue;
			plco_lost(d->out, REPORT_CHANGED, (int)d->rung->line, d->number, report_said(d->out->report,
				  REPORTED("other tools write %s before the rest of the rung acts; here the whole rung is read first")),
				  written(d, &d->net.element[i]));
			break;
		}
}

/* The output that is the power behind an element; it may be named before the element stands there. NULL: it has
 * only one. */
static const char *power_pin(const struct drawing *d, const struct network_element *e)
{
	const struct word_row *row = row_of(d, e);
	const int first = row->kind == WORD_FB ? word_first_bool(row, PIN_OUT) : -1;

	switch ((int)e->word) {
	case ELEM_COMPARE:
	case ELEM_NOT:
		return "OUT";
	case ELEM_ASSIGN:
	case ELEM_CALL:
	case ELEM_EXECUTE:
		return "ENO";
	default:
		break;
	}
	if (row->kind == WORD_FB)
		return first >= 0 ? word_pins(row)[first].name : "ENO";
	return row->kind == WORD_ELEM ? NULL : word_is_test(row) ? "OUT" : "ENO";
}

static void put_rung(struct out *out, const struct rung *rung, int number)
{
	struct drawing d = { .out = out, .rung = rung, .number = number };
	struct ref given[LIMIT_ARGS];
	const char *word;

	if (!network_make(rung, out->arena, &d.net))
		return;
	d.given = given;
	d.ref = arena_alloc(out->arena, sizeof(*d.ref) * ((size_t)d.net.element_count + 1));
	d.order = arena_alloc(out->arena, sizeof(*d.order) * ((size_t)d.net.element_count + 1));
	d.seen = arena_alloc(out->arena, sizeof(*d.seen) * ((size_t)d.net.element_count + 1));
	if (!d.ref || !d.order || !d.seen)
		return;
	word = missing(&d);
	if (rung->off || word) {
		put_as_comment(&d, word);
		return;
	}
	for (int i = 0; i < d.net.element_count; i++)
		order_element(&d, i);
	report_readers(&d);
	put_heading(&d);
	d.pitch = tallest(&d);
	d.rail = next_id(&d);
	plco_place(out, d.rail, LEFT + 3, out->y);
	for (int i = 0; i < d.net.element_count; i++) {
		const struct network_element *e = &d.net.element[i];

		d.ref[i] = (struct ref){ next_id(&d), power_pin(&d, e) };
		plco_place(out, d.ref[i].id, x_of(e) + (row_of(&d, e)->kind == WORD_ELEM ? CONTACT_WIDTH : BOX_WIDTH), y_of(&d, e->row));
	}
	plco_open(out, "leftPowerRail localId=\"%d\" height=\"%d\" width=\"3\"", d.rail, d.pitch * rung->rows);
	put_position(out, LEFT, out->y);
	plco_line(out, "connectionPointOut formalParameter=\"\"");
	plco_close(out, "leftPowerRail");
	for (int i = 0; i < d.net.element_count; i++)
		put_element(&d, &d.net.element[i]);
	out->y += d.pitch * rung->rows + ROW;
}

/* A block that leads to nothing: elsewhere it would act behind all coils of the body. */
static bool has_idle_block(struct out *out, const struct rung *rung)
{
	struct network net;

	if (rung->off || !network_make(rung, out->arena, &net))
		return false;
	for (int i = 0; i < net.element_count; i++)
		if ((words_row(&out->project->words, (enum word)net.element[i].word)->kind == WORD_FB ||
		     runs_lines(&net.element[i])) && (net.element[i].out < 0 || !net.reader_count[net.element[i].out]))
			return true;
	return false;
}

void plco_rungs(struct out *out, const struct pou *pou, int first, int count)
{
	out->order = 0;
	out->numbered = false;
	for (int i = first; i < first + count && !out->numbered; i++)
		out->numbered = has_idle_block(out, pou->rung[i]);
	for (int i = first; i < first + count; i++)
		put_rung(out, pou->rung[i], i + 1);
}
