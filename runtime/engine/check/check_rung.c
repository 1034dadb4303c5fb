/* SPDX-License-Identifier: MIT
 *
 * check_rung - can power flow through this rung as it is drawn?
 *
 * It finds loose ends and misplaced boxes in the grid, and elements in the network that are
 * cut off, shorted or reversed. It does not look names up.
 *
 * Only the place where a fault begins is reported: the first element of a chain without a
 * feeder, the last of a chain without an output.
 */
#include "engine/check/check.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/args.h"

#include <string.h>

struct net_mark {
	int last_bar;   /* rightmost bar at which an element feeds the net */
	int feeder;     /* that element */
	bool said;      /* a loose end of this net was reported */
	bool wired;     /* a wire belongs to it */
	bool inner;     /* an element that is no output reads it */
};

struct rung_check {
	const struct project *project;
	const struct pou *pou;
	int number;
	const struct rung *rung;
	const struct network *network;
	struct arena *scratch;
	struct diag_list *diags;
	struct net_mark *net;
	bool outputs;   /* FALSE: the rung has no output, so no loose end is reported */
	bool followed;  /* elements behind a coil are reported; they lead nowhere, too */
	bool good;
};

static const struct cell *cell_at(const struct rung_check *c, int row, int col)
{
	return &c->rung->cell[(size_t)row * c->rung->cols + (size_t)col];
}

static enum word word_at(const struct rung_check *c, int row, int col)
{
	if (row < 0 || row >= c->rung->rows || col < 0 || col >= c->rung->cols)
		return ELEM_EMPTY;
	return (enum word)cell_at(c, row, col)->word;
}

/* @row, @col 0-based; -1: the whole rung. */
static struct diag place_of(const struct rung_check *c, enum diag_id id, int row, int col)
{
	return (struct diag){
		.id = id, .file = c->pou->file, .line = rung_line(c->rung, row + 1),
		.pou = project_text(c->project, c->pou->name),
		.rung = c->number, .row = row + 1, .col = col + 1,
	};
}

static void report(struct rung_check *c, enum diag_id id, int row, int col,
		   const char *arg)
{
	c->good &= diag_add(c->diags, place_of(c, id, row, col), "%s", arg);
}

/* A diagnostic that names the operand of a cell, else its word. */
static void report_cell(struct rung_check *c, enum diag_id id, int row, int col)
{
	const struct cell *cell = cell_at(c, row, col);

	report(c, id, row, col, cell->operand ?
	       project_text(c->project, cell->operand) :
	       words_row(&c->project->words, (enum word)cell->word)->word);
}

/* May rows of pins stand below it? */
static bool is_box(enum word word)
{
	const struct word_row *row = word_row(word);

	return row->place == PLACE_BOX || row->operand == OPND_EXPR;
}

/* ---- loose ends of the grid ---- */

/* Does the cell left of a bar end there? */
static bool ends_at(const struct rung_check *c, int row, int bar)
{
	return bar == 0 || word_at(c, row, bar - 1) != ELEM_EMPTY;
}

/* Does the cell right of a bar take power from it? */
static bool begins_at(const struct rung_check *c, int row, int bar)
{
	enum word word = word_at(c, row, bar);

	return word != ELEM_EMPTY &&
	       (word != ELEM_PIN || cell_at(c, row, bar)->operand);
}

/* Is a bar linked to the row above (@below 0) or below (@below 1)? */
static bool is_linked(const struct rung_check *c, int row, int bar, int below)
{
	row += below;
	return bar > 0 && bar <= c->rung->cols && row > 0 &&
	       row < c->rung->rows && cell_at(c, row, bar - 1)->link;
}

static void check_link(struct rung_check *c, int row, int bar)
{
	if (row > 0 &&
	    (ends_at(c, row, bar) || begins_at(c, row, bar) ||
	     is_linked(c, row, bar, 1)) &&
	    (ends_at(c, row - 1, bar) || begins_at(c, row - 1, bar) ||
	     is_linked(c, row - 1, bar, 0)))
		return;
	report(c, DIAG_LINK_NOWHERE, row, bar - 1, "");
	c->net[network_net(c->network, row, bar)].said = true;
}

static int feeder_count(const struct network *network, int net)
{
	return network->first_feeder[net + 1] - network->first_feeder[net];
}

static bool has_power(const struct rung_check *c, int net)
{
	return net == NET_RAIL || feeder_count(c->network, net) > 0;
}

/* A wire that hangs in the air as a whole, or with one end. */
static void check_wire(struct rung_check *c, int row, int col)
{
	int net = network_net(c->network, row, col);
	struct net_mark *mark = &c->net[net];

	if (!has_power(c, net)) {
		if (!mark->wired && !mark->said &&
		    c->network->reader_count[net] == 0)
			report_cell(c, DIAG_OPEN_LEFT, row, col);
		mark->wired = true;
		return;
	}
	if (!ends_at(c, row, col) && !is_linked(c, row, col, 0) &&
	    !is_linked(c, row, col, 1))
		report_cell(c, DIAG_OPEN_LEFT, row, col);
	if (!c->outputs || begins_at(c, row, col + 1) ||
	    is_linked(c, row, col + 1, 0) ||
	    is_linked(c, row, col + 1, 1))
		return;
	report_cell(c, DIAG_OPEN_RIGHT, row, col);
	mark->said = true;
}

/* Reports a `.` row that is not directly below its box; only the first of several. */
static void check_pin_row(struct rung_check *c, int row, int col)
{
	enum word above = word_at(c, row - 1, col);
	int up = row - 2;

	if (above == ELEM_PIN || is_box(above))
		return;
	while (up >= 0 && !is_box(word_at(c, up, col)))
		up--;
	report_cell(c, up >= 0 ? DIAG_BOX_CUT : DIAG_PIN_WITHOUT_BOX, row, col);
	c->net[network_net(c->network, row, col)].said = true;
}

static void check_grid(struct rung_check *c)
{
	for (int row = 0; row < c->rung->rows; row++) {
		for (int col = 0; col < c->rung->cols; col++) {
			const struct cell *cell = cell_at(c, row, col);

			if (cell->link)
				check_link(c, row, col + 1);
			if (cell->word == ELEM_WIRE)
				check_wire(c, row, col);
			else if (cell->word == ELEM_PIN)
				check_pin_row(c, row, col);
		}
	}
}

/* ---- pins of a box ---- */

/* The error of giving pin @name a row of its own; DIAG_COUNT: none. */
static enum diag_id judge_pin(const struct word_row *row, const char *name,
			      size_t len, int index)
{
	const struct word_pin *pin;

	if (row->kind == WORD_FN && ascii_is("EN", name, len))
		return DIAG_PIN_FIRST;
	if (row->kind == WORD_FN && (ascii_is("ENO", name, len) ||
				     ascii_is("OUT", name, len)))
		return DIAG_PIN_NOT_BOOL;
	if (index < 0)
		return DIAG_PIN_UNKNOWN;
	pin = &row->pin[index < row->pin_count ? index : row->pin_count - 1];
	if (row->kind == WORD_FN)
		return pin->dir == PIN_IN && pin->classes & CLASS_BOOL ?
			DIAG_COUNT : DIAG_PIN_NOT_BOOL;
	if (index == word_first_bool(row, PIN_IN))
		return DIAG_PIN_FIRST;
	return pin->dir == PIN_IN && pin->type == IEC_BOOL ? DIAG_COUNT :
							     DIAG_PIN_NOT_BOOL;
}

static bool pin_row_before(const struct rung_check *c,
			   const struct network_element *e, int number,
			   int index)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)e->word);

	for (int i = 0; i < number; i++) {
		const char *name = project_text(c->project,
			c->network->pin[e->first_pin + i].operand);

		if (word_pin_find(row, name, strlen(name)) == index)
			return true;
	}
	return false;
}

static void check_pin(struct rung_check *c, const struct network_element *e,
		      int number)
{
	const struct network_pin *pin = &c->network->pin[e->first_pin + number];
	const struct word_row *row = words_row(&c->project->words, (enum word)e->word);
	const char *name = project_text(c->project, pin->operand);
	size_t len = strlen(name);
	int index = word_pin_find(row, name, len);
	enum diag_id wrong = judge_pin(row, name, len, index);
	const struct cell *box = cell_at(c, e->row, e->col);
	struct arg arg;

	if (wrong == DIAG_COUNT &&
	    (pin_row_before(c, e, number, index) ||
	     (box->args && args_find(project_text(c->project, box->args), name,
				     len, &arg))))
		wrong = DIAG_PIN_TWICE;
	if (wrong != DIAG_COUNT)
		report_cell(c, wrong, pin->row, pin->col);
	if (!has_power(c, pin->in) && !c->net[pin->in].said)
		report_cell(c, DIAG_OPEN_LEFT, pin->row, pin->col);
}

/* The pin that takes the power of the box's row cannot be a parameter too. */
static void check_power_pin(struct rung_check *c,
			    const struct network_element *e)
{
	const struct cell *cell = cell_at(c, e->row, e->col);
	const struct word_row *row = words_row(&c->project->words, (enum word)e->word);
	int first = word_first_bool(row, PIN_IN);
	const char *name;
	struct arg arg;

	if (row->kind == WORD_ELEM || (row->kind == WORD_FB && first < 0))
		return;
	name = row->kind == WORD_FN ? "EN" : row->pin[first].name;
	if (!cell->args || !args_find(project_text(c->project, cell->args), name, strlen(name), &arg))
		return;
	if (e->in == NET_RAIL && arg.value_len < LIMIT_ARG - 4 && !ascii_is("TRUE", arg.value, arg.value_len) &&
	    !ascii_is("FALSE", arg.value, arg.value_len))
		c->good &= diag_add(c->diags, place_of(c, DIAG_PIN_FIRST, e->row, e->col), "%s" DIAG_AND "%s %.*s",
				    name, arg.inverse ? "NC" : "NO", (int)arg.value_len, arg.value);
	else
		c->good &= diag_add(c->diags, place_of(c, DIAG_PIN_FIRST, e->row, e->col), "%s" DIAG_AND DIAG_AND "%.*s",
				    name, arg.value_len < LIMIT_ARG ? (int)(arg.value + arg.value_len - arg.pin) : 0, arg.pin);
}

/* ---- the network ---- */

static bool is_last(const struct network_element *e)
{
	return word_row((enum word)e->word)->place == PLACE_LAST;
}

/* A coil passes its power on to other outputs. */
static bool is_coil(const struct network_element *e)
{
	return is_last(e) && word_row((enum word)e->word)->operand == OPND_BOOL_W;
}

static bool may_be_last(const struct network_element *e)
{
	return word_row((enum word)e->word)->place == PLACE_BOX;
}

static bool is_shorted(const struct network_element *e)
{
	return e->in == e->out || e->out == NET_RAIL;
}

static bool has_output(const struct network *network)
{
	for (int i = 0; i < network->element_count; i++) {
		const struct network_element *e = &network->element[i];

		if (is_last(e) ||
		    (may_be_last(e) && network->reader_count[e->out] == 0))
			return true;
	}
	return false;
}

/* What an assigned value that is a number does not have. */
static const char *const no_sums[] = {
	"=", "<", ">", "<=", ">=", "<>", "AND", "OR", "XOR", "NOT",
};

/* `N = 5`: the length of the name before the sign; 0: no such comparison. */
static size_t compared_name(const char *text)
{
	struct lex lex;
	size_t len;

	lex_init(&lex, text, strlen(text));
	if (lex_next(&lex) != TOKEN_NAME)
		return 0;
	len = (size_t)(lex.token.text - text) + lex.token.len;
	lex_next(&lex);
	if (!lex_is(&lex, "="))
		return 0;
	while (lex_next(&lex) != TOKEN_END)
		for (size_t i = 0; i < sizeof(no_sums) / sizeof(*no_sums); i++)
			if (lex_is(&lex, no_sums[i]))
				return 0;
	return len;
}

/* A comparison at the end of a rung, such as [ N = 5 ], is meant as an assignment. */
static void report_no_output(struct rung_check *c)
{
	const struct network *n = c->network;

	for (int i = 0; i < n->element_count; i++) {
		const struct network_element *e = &n->element[i];
		const char *text = project_text(c->project, cell_at(c, e->row, e->col)->operand);
		const size_t len = e->word == ELEM_COMPARE && !n->reader_count[e->out] ?
				   compared_name(text) : 0;
		struct diag place;

		if (!len)
			continue;
		place = place_of(c, DIAG_COMPARES_LAST, e->row, e->col);
		c->good &= diag_add(c->diags, place, "%s" DIAG_AND "%.*s :%s", text, (int)len, text,
				    strchr(text + len, '='));
		return;
	}
	report(c, DIAG_NO_OUTPUT, -1, -1, "");
}

/* Acts after all powers are known, so it may follow a coil. */
static bool acts_last(const struct network *n, const struct network_element *e)
{
	enum operand_kind operand = word_row((enum word)e->word)->operand;

	return is_last(e) || ((operand == OPND_ASSIGN || operand == OPND_ROUTINE ||
				operand == OPND_EXECUTE) &&
			      n->reader_count[e->out] == 0);
}

static void mark_readers(struct rung_check *c)
{
	const struct network *n = c->network;

	for (int i = 0; i < n->element_count; i++)
		c->net[n->element[i].in].inner |= !acts_last(n, &n->element[i]);
	for (int i = 0; i < n->pin_count; i++)
		c->net[n->pin[i].in].inner = true;
}

/* An output with something behind it. */
static void check_followed(struct rung_check *c, const struct network_element *e)
{
	if (!is_coil(e))
		report_cell(c, DIAG_NOT_LAST, e->row, e->col);
	else if (c->net[e->out].inner)
		report_cell(c, DIAG_COIL_FOLLOWED, e->row, e->col);
	c->followed |= is_coil(e) && c->net[e->out].inner;
}

static void check_element(struct rung_check *c, int number)
{
	const struct network_element *e = &c->network->element[number];
	struct net_mark *out = &c->net[e->out];
	bool read = c->network->reader_count[e->out] > 0;

	if (!has_power(c, e->in) && !c->net[e->in].said)
		report_cell(c, DIAG_OPEN_LEFT, e->row, e->col);
	if (is_box((enum word)e->word)) {
		check_power_pin(c, e);
		for (int i = 0; i < e->pins; i++)
			check_pin(c, e, i);
	}
	if (is_shorted(e)) {
		report_cell(c, DIAG_SHORT_CIRCUIT, e->row, e->col);
	} else {
		if (is_last(e) && read)
			check_followed(c, e);
		if ((!is_last(e) || is_coil(e)) && out->last_bar < e->col + 1) {
			out->last_bar = e->col + 1;
			out->feeder = number;
		}
	}
	if (c->outputs && !c->followed && !read && !out->said && !is_last(e) && !may_be_last(e))
		report_cell(c, DIAG_OPEN_RIGHT, e->row, e->col);
}

/* ---- backwards ----
 *
 * An element feeds its net at the bar of its right end; an element or pin that
 * reads the net at a bar left of it would need power to flow right to left.
 * When the reader leads round to the feeder again, the net is a bare wire
 * beside what lies between: a short circuit. Else two branches are mixed. */

/* Elements that no order of evaluation can reach: on a ring, or behind one. */
struct ring {
	int *open_feeders;  /* by net: feeders not yet in order               */
	int *open_nets;     /* by element: nets it reads, not yet in order    */
	int *first, *reader; /* elements that read a net                      */
	int *queue;          /* nets in order                                 */
	int queued;
};

static bool ring_init(struct ring *ring, const struct network *n,
		      struct arena *scratch)
{
	size_t nets = (size_t)n->net_count + 1;
	size_t elements = (size_t)n->element_count;
	size_t reads = elements + (size_t)n->pin_count;

	ring->open_feeders = arena_alloc(scratch, nets * sizeof(int));
	ring->first = arena_alloc(scratch, nets * sizeof(int));
	ring->queue = arena_alloc(scratch, nets * sizeof(int));
	ring->open_nets = arena_alloc(scratch, elements * sizeof(int));
	ring->reader = arena_alloc(scratch, reads * sizeof(int));
	return !scratch->failed;
}

static bool is_feeder(const struct network_element *e)
{
	return !is_shorted(e) && (!is_last(e) || is_coil(e));
}

/* Two passes over all readers: count them by net, then put them there. */
static void ring_fill(struct ring *ring, const struct network *n)
{
	for (int i = 0; i < n->element_count; i++) {
		const struct network_element *e = &n->element[i];

		ring->open_nets[i] = 1 + e->pins;
		ring->open_feeders[e->out] += is_feeder(e);
		ring->first[e->in]++;
		for (int k = 0; k < e->pins; k++)
			ring->first[n->pin[e->first_pin + k].in]++;
	}
	for (int i = 1; i <= n->net_count; i++)
		ring->first[i] += ring->first[i - 1];
	for (int i = 0; i < n->element_count; i++) {
		const struct network_element *e = &n->element[i];

		ring->reader[--ring->first[e->in]] = i;
		for (int k = 0; k < e->pins; k++) {
			int net = n->pin[e->first_pin + k].in;

			ring->reader[--ring->first[net]] = i;
		}
	}
}

static void ring_order(struct ring *ring, const struct network *n)
{
	for (int i = 0; i < n->net_count; i++)
		if (ring->open_feeders[i] == 0)
			ring->queue[ring->queued++] = i;
	for (int done = 0; done < ring->queued; done++) {
		int net = ring->queue[done];

		for (int i = ring->first[net]; i < ring->first[net + 1]; i++) {
			int number = ring->reader[i];
			const struct network_element *e = &n->element[number];

			if (--ring->open_nets[number] == 0 && is_feeder(e) &&
			    --ring->open_feeders[e->out] == 0)
				ring->queue[ring->queued++] = e->out;
		}
	}
}

/* One message a net; @net of a reader at bar @bar. */
static void check_reader(struct rung_check *c, const struct ring *ring,
			 int reader, int net, int row, int bar)
{
	struct net_mark *mark = &c->net[net];
	const struct network_element *e = &c->network->element[mark->feeder];

	if (bar >= mark->last_bar)
		return;
	mark->last_bar = 0;
	if (ring->open_nets[reader] > 0 && ring->open_nets[mark->feeder] > 0)
		report_cell(c, DIAG_SHORT_CIRCUIT, e->row, e->col);
	else
		report_cell(c, DIAG_BACKWARDS, row, bar);
}

static bool is_backwards(const struct rung_check *c)
{
	const struct network *n = c->network;

	for (int i = 0; i < n->element_count; i++)
		if (n->element[i].col < c->net[n->element[i].in].last_bar)
			return true;
	for (int i = 0; i < n->pin_count; i++)
		if (n->pin[i].col < c->net[n->pin[i].in].last_bar)
			return true;
	return false;
}

static void check_direction(struct rung_check *c)
{
	const struct network *n = c->network;
	struct ring ring = { 0 };

	if (!is_backwards(c))
		return;
	if (!ring_init(&ring, n, c->scratch)) {
		report(c, DIAG_NO_MEMORY, -1, -1, "");
		return;
	}
	ring_fill(&ring, n);
	ring_order(&ring, n);
	for (int i = 0; i < n->element_count; i++) {
		const struct network_element *e = &n->element[i];

		if (!is_shorted(e))
			check_reader(c, &ring, i, e->in, e->row, e->col);
		for (int k = 0; k < e->pins; k++) {
			const struct network_pin *pin =
				&n->pin[e->first_pin + k];

			check_reader(c, &ring, i, pin->in, pin->row, pin->col);
		}
	}
}

static bool has_wire(const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY || rung->cell[i].link)
			return true;
	return false;
}

bool check_rung(const struct project *project, const struct pou *pou,
		int number, const struct rung *rung,
		const struct network *network,
		struct arena *scratch, struct diag_list *diags)
{
	struct rung_check c = {
		.project = project, .pou = pou, .number = number, .rung = rung,
		.network = network, .scratch = scratch, .diags = diags,
		.outputs = has_output(network), .good = true,
	};

	if (rung->off)
		return true;
	if (!has_wire(rung)) {
		/* A jump may end here, and a new program begins so. */
		if (!rung->label && pou->rung_count > 1)
			report(&c, DIAG_EMPTY_RUNG, -1, -1, "");
		return c.good;
	}
	c.net = arena_alloc(scratch,
			    (size_t)network->net_count * sizeof(*c.net));
	if (!c.net) {
		report(&c, DIAG_NO_MEMORY, -1, -1, "");
		return false;
	}
	check_grid(&c);
	mark_readers(&c);
	for (int i = 0; i < network->element_count; i++)
		check_element(&c, i);
	if (!c.outputs)
		report_no_output(&c);
	check_direction(&c);
	return c.good;
}
