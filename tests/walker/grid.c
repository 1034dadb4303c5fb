/* SPDX-License-Identifier: MIT
 *
 * grid - from the cells of a rung to nets and elements, for the walker.
 *
 * Every bar starts as its own net; the rail, wires and links join them. ladder_build()
 * has checked the rung.
 */
#include "tests/walker/grid.h"

#include "engine/model/args.h"
#include "engine/model/shape.h"

#include <string.h>
#include <strings.h>

static int bar_at(const struct rung *rung, int row, int bar)
{
	return row * (rung->cols + 1) + bar;
}

static int root_of(const int *net, int bar)
{
	while (net[bar] != bar)
		bar = net[bar];
	return bar;
}

static void join(int *net, int a, int b)
{
	a = root_of(net, a);
	b = root_of(net, b);
	if (a < b)
		net[b] = a;
	else
		net[a] = b;
}

int grid_net(const struct walked_rung *walked, int row, int bar)
{
	return walked->net[bar_at(walked->rung, row, bar)];
}

static bool make_nets(struct walker *walker, struct walked_rung *walked)
{
	const struct rung *rung = walked->rung;
	int bars = rung->rows * (rung->cols + 1);
	int *net = arena_alloc(&walker->arena, (size_t)bars * sizeof(*net));

	if (!net)
		return false;
	for (int i = 0; i < bars; i++)
		net[i] = i;
	for (int row = 0; row < rung->rows; row++) {
		join(net, bar_at(rung, row, 0), bar_at(rung, 0, 0));
		for (int col = 0; col < rung->cols; col++) {
			const struct cell *cell = rung_at(rung, row, col);
			int right = bar_at(rung, row, col + 1);

			if (cell->word == ELEM_WIRE)
				join(net, bar_at(rung, row, col), right);
			if (cell->link && row > 0)
				join(net, right,
				     bar_at(rung, row - 1, col + 1));
		}
	}
	for (int i = 0; i < bars; i++)
		net[i] = root_of(net, i);
	walked->net = net;
	return true;
}

/* Number of a pin, an input of a function counted from 0. */
static int pin_number(enum word word, const char *name, size_t len)
{
	const struct word_row *row = word_row(word);
	char text[32] = "";

	if (len >= sizeof(text))
		return -1;
	memcpy(text, name, len);
	if (row->kind == WORD_FB) {
		struct block block = { .fb = word };

		return block_pin(&block, text);
	}
	if (len == 2 && !memcmp(text, "IN", 2))
		return 0;
	if (len == 3 && !memcmp(text, "IN", 2))
		return text[2] - '1';
	for (int i = 0; i < row->pin_count; i++)
		if (strcmp(row->pin[i].name, text) == 0)
			return i;
	return -1;
}

static bool fed_pins(struct walker *walker, struct walked_rung *walked,
		     struct walked *at)
{
	const struct rung *rung = walked->rung;

	for (int row = at->row + 1; row < rung->rows; row++) {
		const struct cell *cell = rung_at(rung, row, at->col);
		const char *name = project_text(walker->project, cell->operand);
		struct parameter *pin = &at->parameter[at->parameter_count];

		if (cell->word != ELEM_PIN)
			break;
		if (!cell->operand)
			continue;
		pin->pin = pin_number(at->word, name, strlen(name));
		pin->net = grid_net(walked, row, at->col);
		if (pin->pin < 0)
			return false;
		at->parameter_count++;
	}
	return true;
}

static bool written_pins(struct walker *walker, const struct frame *frame,
			 struct walked *at, const char *text)
{
	struct arg arg;

	while (text && args_next(&text, &arg)) {
		struct parameter *pin = &at->parameter[at->parameter_count++];

		pin->net = -1;
		pin->output = arg.output;
		pin->inverse = arg.inverse;
		pin->placed = walker_place(walker, frame, arg.value,
					   arg.value_len);
		pin->pin = arg.output && word_row(at->word)->kind == WORD_FN ?
			   0 : pin_number(at->word, arg.pin, arg.pin_len);
		if (pin->pin < 0 || pin->placed.kind == PLACED_NOWHERE)
			return false;
	}
	return true;
}

static bool make_box(struct walker *walker, const struct frame *frame,
		     struct walked_rung *walked, struct walked *at,
		     const struct cell *cell)
{
	enum iec_type type[LIMIT_FN_ARGS] = { IEC_NONE };

	walker->why = "a box";
	at->parameter = arena_alloc(&walker->arena, (size_t)(LIMIT_ARGS +
				    walked->rung->rows) *
				    sizeof(*at->parameter));
	if (!at->parameter || !fed_pins(walker, walked, at) ||
	    !written_pins(walker, frame, at,
			  project_text(walker->project, cell->args)))
		return false;
	if (word_row(at->word)->kind == WORD_FB)
		return true;
	for (int i = 0; i < at->parameter_count; i++) {
		const struct parameter *pin = &at->parameter[i];

		if (!pin->output && pin->pin < LIMIT_FN_ARGS &&
		    !word_input(word_row(at->word), (uint32_t)pin->pin)->own)
			type[pin->pin] = pin->net >= 0 ? IEC_BOOL :
					 pin->placed.type;
	}
	at->inputs = wide_type(type, LIMIT_FN_ARGS);
	for (int i = 0; i < at->parameter_count && at->inputs == IEC_NONE; i++)
		if (at->parameter[i].output)
			at->inputs = at->parameter[i].placed.type;
	return at->inputs != IEC_NONE;
}

/* The instance that a box calls, or the frame of a function. */
static struct frame *callee_of(struct walker *walker, const struct frame *frame,
			       enum word word, const char *text)
{
	const struct pou *pou = shape_pou(walker->project, word);
	struct variable *variable;

	if (pou->kind == POU_FUNCTION)
		return &walker->frame[pou - walker->project->pou];
	variable = frame_variable(walker, frame, text, strlen(text));
	return variable ? variable->inner : NULL;
}

/* The variable of a pin; OUT is the result of a function. */
static int called_pin(struct walker *walker, const struct frame *callee,
		      const char *name, size_t len)
{
	for (int i = 0; i < callee->count; i++)
		if (callee->variable[i].flags & VAR_RESULT && len == 3 &&
		    !strncasecmp(name, "OUT", 3))
			return i;
	return frame_find(walker, callee, name, len);
}

static bool make_call(struct walker *walker, const struct frame *frame,
		      struct walked_rung *walked, struct walked *at,
		      const struct cell *cell)
{
	const char *text = project_text(walker->project, cell->args);
	struct arg arg;

	at->parameter = arena_alloc(&walker->arena, LIMIT_ARGS *
				    sizeof(*at->parameter));
	(void)walked;
	while (at->parameter && text && args_next(&text, &arg)) {
		struct parameter *pin = &at->parameter[at->parameter_count++];

		pin->net = -1;
		pin->output = arg.output;
		pin->inverse = arg.inverse;
		pin->placed = walker_place(walker, frame, arg.value, arg.value_len);
		pin->pin = called_pin(walker, at->callee, arg.pin, arg.pin_len);
		if (pin->pin < 0 || pin->placed.kind == PLACED_NOWHERE)
			return false;
	}
	return at->parameter;
}

/* In the body of a chart that contains it, or else in the POU. */
static int rung_labelled(const struct pou *pou, const struct sfc_body *body,
			 uint32_t label, struct names *names)
{
	int first = body ? body->first : 0;
	int end = body ? first + body->count : pou->rung_count;

	for (int i = first; i < end; i++)
		if (pou->rung[i]->label && names_fold(names, label) ==
		    names_fold(names, pou->rung[i]->label))
			return i;
	return -1;
}

static int routine_named(const struct project *project, const char *name)
{
	int i = 0;

	while (i < project->pou_count &&
	       strcasecmp(project_text(project, project->pou[i].name), name) != 0)
		i++;
	return i < project->pou_count ? i : -1;
}

static const struct boxed *boxed_at(const struct pou *pou, const struct rung *rung, int row, int col)
{
	int number = 0;

	while (pou->rung[number] != rung)
		number++;
	return pou_boxed(pou, number, row, col);
}

static bool make_element(struct walker *walker, const struct frame *frame,
			 struct walked_rung *walked, struct walked *at)
{
	const struct cell *cell = rung_at(walked->rung, at->row, at->col);
	const struct word_row *row = word_row(at->word);
	const char *text = project_text(walker->project, cell->operand);

	if (word_is_own(at->word)) {
		at->callee = callee_of(walker, frame, at->word, text);
		walker->why = text;
		return at->callee && make_call(walker, frame, walked, at, cell);
	}
	if (row->kind == WORD_FB) {
		struct variable *variable = frame_variable(walker, frame, text,
							   strlen(text));

		at->block = variable ? variable->block : NULL;
		walker->why = text;
		return at->block && make_box(walker, frame, walked, at, cell);
	}
	if (row->kind == WORD_FN)
		return make_box(walker, frame, walked, at, cell);
	switch (row->operand) {
	case OPND_BOOL_R:
	case OPND_BOOL_W:
		at->operand = walker_place(walker, frame, text, strlen(text));
		walker->why = text;
		return at->operand.kind != PLACED_NOWHERE;
	case OPND_LABEL:
		at->target = rung_labelled(frame->pou, walker->body, cell->operand,
					   &walker->project->names);
		return at->target >= 0;
	case OPND_ROUTINE:
		at->target = routine_named(walker->project, text);
		return at->target >= 0;
	case OPND_EXECUTE:
		at->boxed = boxed_at(frame->pou, walked->rung, at->row, at->col);
		return at->boxed;
	case OPND_EXPR:
	case OPND_ASSIGN:
		at->expression = expression_new(walker, frame, text);
		return at->expression;
	case OPND_NONE:
		return true;
	case OPND_LOOP:
	case OPND_LOOP_END:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_INSTANCE:
	case OPND_PIN:
		break;
	}
	walker->why = "an element";
	return false;
}

static bool is_element(const struct cell *cell)
{
	return cell->word != ELEM_EMPTY && cell->word != ELEM_WIRE &&
	       cell->word != ELEM_PIN;
}

/* Whether an element or a connected pin has its left end on the net. */
static bool net_is_read(const struct walked_rung *walked, int net)
{
	for (int i = 0; i < walked->count; i++) {
		const struct walked *at = &walked->element[i];

		if (at->in == net)
			return true;
		for (int j = 0; j < at->parameter_count; j++)
			if (at->parameter[j].net == net)
				return true;
	}
	return false;
}

bool grid_make(struct walker *walker, const struct frame *frame,
	       const struct rung *rung, struct walked_rung *out)
{
	int cells = rung->rows * rung->cols;

	out->rung = rung;
	out->element = arena_alloc(&walker->arena, (size_t)cells *
				   sizeof(*out->element));
	if (!out->element || !make_nets(walker, out))
		return false;
	for (int i = 0; i < cells; i++) {
		int row = i / rung->cols, col = i % rung->cols;
		struct walked *at = &out->element[out->count];

		if (!is_element(rung_at(rung, row, col)))
			continue;
		at->row = row;
		at->col = col;
		at->word = (enum word)rung_at(rung, row, col)->word;
		at->in = grid_net(out, row, col);
		at->out = grid_net(out, row, col + 1);
		if (!make_element(walker, frame, out, at))
			return false;
		out->count++;
	}
	for (int i = 0; i < out->count; i++)
		out->element[i].read = net_is_read(out, out->element[i].out);
	return true;
}
