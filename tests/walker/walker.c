/* SPDX-License-Identifier: MIT
 *
 * walker - evaluates rungs over the grid, in the two phases of
 * docs/language.md: everything but coils, then coils.
 */
#include "tests/walker/sfc.h"

#include <stdlib.h>
#include <string.h>

#define STEPS_MAX 1000000u

static bool make_pou(struct walker *walker, struct frame *frame,
		     struct walked_pou *out)
{
	const struct pou *pou = frame->pou;

	out->pou = pou;
	out->frame = frame;
	frame->body = out;
	if (pou->language == LANGUAGE_IL) {
		walker->why = "a POU in IL";
		return false;
	}
	out->rung = arena_alloc(&walker->arena, (size_t)pou->rung_count *
				sizeof(*out->rung) + 1);
	if (!out->rung)
		return false;
	for (int i = 0; i < pou->rung_count; i++) {
		walker->body = pou->sfc ? rung_body(pou->sfc, i) : NULL;
		if (!pou->rung[i]->off &&
		    !grid_make(walker, frame, pou->rung[i], &out->rung[i]))
			return false;
	}
	if (pou->sfc)
		out->sfc = sfc_new(walker, out);
	return !pou->sfc || out->sfc;
}

static bool make_all(struct walker *walker)
{
	struct project *project = walker->project;

	walker->pou = arena_alloc(&walker->arena, (size_t)project->pou_count *
				  sizeof(*walker->pou) + 1);
	if (!walker->pou || !walker_declare(walker))
		return false;
	for (int i = 0; i < project->pou_count; i++)
		if (walker->frame[i].pou &&
		    !make_pou(walker, &walker->frame[i], &walker->pou[i]))
			return false;
	for (struct frame *at = walker->instances; at; at = at->next) {
		struct walked_pou *body = arena_alloc(&walker->arena, sizeof(*body));

		if (!body || !make_pou(walker, at, body))
			return false;
	}
	return true;
}

struct walker *walker_new(struct project *project, const char **why)
{
	struct walker *walker = calloc(1, sizeof(*walker));

	*why = "out of memory";
	if (!walker)
		return NULL;
	arena_init(&walker->arena);
	walker->project = project;
	walker->why = *why;
	if (!make_all(walker)) {
		*why = walker->why;
		walker_free(walker);
		return NULL;
	}
	return walker;
}

void walker_free(struct walker *walker)
{
	if (!walker)
		return;
	arena_free(&walker->arena);
	free(walker);
}

uint8_t *walker_area(struct walker *walker, enum iec_area area)
{
	return walker->area[area];
}

uint32_t walker_errors(const struct walker *walker)
{
	return walker->errors;
}

static bool net_power(const struct walked_rung *walked, int net)
{
	if (net == GRID_RAIL(walked))
		return true;
	for (int i = 0; i < walked->count; i++)
		if (walked->element[i].out == net && walked->element[i].done &&
		    walked->element[i].power_out)
			return true;
	return false;
}

/* Stores, if the place exists. */
static bool put(struct walker *walker, const struct placed *to, struct value value)
{
	struct placed here;

	if (!placed_find(walker, to, &here))
		return false;
	placed_write(&here, value);
	return true;
}

/* A parameter of an input; inverted behind a /. */
static struct value read_input(const struct parameter *from, const struct placed *at,
			       enum iec_type type)
{
	struct value value = placed_read(at, type);

	return from->inverse ? value_bool(!value_is_true(value)) : value;
}

/* Elements and bits of numbers are read before anything else goes to the block. */
static bool is_looked_up(const struct placed *placed)
{
	return placed->index || placed->kind == PLACED_PART;
}

static bool call_block(struct walker *walker, struct walked_rung *walked,
		       struct walked *at, bool power)
{
	const struct word_row *row = word_row(at->word);
	struct value *pin = at->block->pin, given[PINS_MAX] = { { 0 } };
	bool all = true;

	for (int i = 0; i < at->parameter_count && all; i++) {
		const struct parameter *from = &at->parameter[i];
		struct placed here;

		if (from->output || from->net >= 0)
			continue;
		all = placed_find(walker, &from->placed, &here);
		if (all && is_looked_up(&from->placed))
			given[from->pin] = read_input(from, &here,
						      pin[from->pin].type);
	}
	pin[word_first_bool(row, PIN_IN)] = value_bool(power);
	for (int i = 0; i < at->parameter_count; i++) {
		const struct parameter *from = &at->parameter[i];

		if (from->net >= 0)
			pin[from->pin] = value_bool(net_power(walked,
							      from->net));
		else if (!from->output && all)
			pin[from->pin] = is_looked_up(&from->placed) ? given[from->pin] :
				read_input(from, &from->placed,
					   pin[from->pin].type);
	}
	if (!all)
		return false;
	at->block->called = true;
	block_call(at->block, walker->now_ns);
	for (int i = 0; i < at->parameter_count; i++)
		if (at->parameter[i].output)
			put(walker, &at->parameter[i].placed,
			    pin[at->parameter[i].pin]);
	return value_is_true(pin[word_first_bool(row, PIN_OUT)]);
}

/* The value of an input: an own pin takes it unchanged. */
static enum iec_type type_at(const struct walked *at, const struct parameter *from)
{
	if (!word_input(word_row(at->word), (uint32_t)from->pin)->own)
		return at->inputs;
	return from->placed.type == IEC_NONE ? IEC_DINT : from->placed.type;
}

/* Whether a text fits its destination. */
static bool has_room(const struct placed *to, struct value value)
{
	return value.type != IEC_STRING || value.len <= to->value->room;
}

static bool call_function(struct walker *walker, struct walked_rung *walked,
			  struct walked *at, bool power)
{
	struct value in[LIMIT_FN_ARGS] = { { 0 } }, out = { 0 };
	bool test = word_is_test(word_row(at->word)) ||
		    (value_is_logic(at->word) && at->inputs == IEC_BOOL);
	bool stored = true;
	enum outcome outcome;
	struct placed here;
	int count = 0;

	if (!power)
		return false;
	for (int i = 0; i < at->parameter_count; i++) {
		const struct parameter *from = &at->parameter[i];

		if (from->output)
			continue;
		if (from->net < 0 && !placed_find(walker, &from->placed, &here))
			return false;
		in[from->pin] = from->net >= 0 ?
			value_bool(net_power(walked, from->net)) :
			read_input(from, &here, type_at(at, from));
		count++;
	}
	for (int i = 0; i < at->parameter_count && !test; i++)
		if (at->parameter[i].output &&
		    !placed_find(walker, &at->parameter[i].placed, &here))
			return false;
	outcome = value_compute(at->word, in, count, &out);
	for (int i = 0; i < at->parameter_count; i++)
		if (at->parameter[i].output && outcome == OUTCOME_GOOD &&
		    !has_room(&at->parameter[i].placed, out))
			outcome = OUTCOME_WRAPPED;
	if (outcome != OUTCOME_GOOD)
		walker->errors++;
	for (int i = 0; i < at->parameter_count; i++)
		if (at->parameter[i].output && outcome != OUTCOME_FAILED)
			stored &= put(walker, &at->parameter[i].placed, out);
	if (test)
		return stored && value_is_true(out);
	return outcome == OUTCOME_GOOD;
}

/* Edges are updated without power, too. */
static bool contact(struct walker *walker, struct walked *at, bool power)
{
	bool edge = at->word == ELEM_CONTACT_P || at->word == ELEM_CONTACT_N;
	bool level, before = at->memory;
	struct placed here;

	if (!power && !edge)
		return false;
	if (!placed_find(walker, &at->operand, &here))
		return false;
	level = value_is_true(placed_read(&here, IEC_BOOL));
	at->memory = level;
	if (at->word == ELEM_CONTACT_NO)
		return power && level;
	if (at->word == ELEM_CONTACT_NC)
		return power && !level;
	if (at->word == ELEM_CONTACT_P)
		return power && level && !before;
	return power && !level && before;
}

static bool is_output(const struct walked *at)
{
	const struct word_row *row = word_row(at->word);

	if (row->place == PLACE_LAST)
		return true;
	return !at->read && (row->kind != WORD_ELEM || at->word == ELEM_CALL || at->word == ELEM_EXECUTE ||
			     (at->expression && expression_assigns(at->expression)));
}

static bool acts_last(const struct walked *at)
{
	return word_row(at->word)->place == PLACE_LAST ||
	       (!at->read && (at->word == ELEM_CALL || at->word == ELEM_EXECUTE ||
			      (at->expression && expression_assigns(at->expression))));
}

static bool walk_pou(struct walker *walker, struct walked_pou *walked);

/* The first BOOL among the variables with this flag; -1: none. */
static int first_bool(const struct frame *callee, uint8_t flag)
{
	for (int i = 0; i < callee->count; i++)
		if (callee->variable[i].flags & flag &&
		    callee->variable[i].var->type == IEC_BOOL &&
		    !callee->variable[i].var->array.count)
			return i;
	return -1;
}

/* Reads the inputs, before the callee writes anything; false: an element does not
 * exist. */
static bool read_parameters(struct walker *walker, const struct walked *at, bool outputs,
			    struct value *given)
{
	for (int i = 0; i < at->parameter_count; i++) {
		const struct parameter *from = &at->parameter[i];
		struct placed here;

		if (from->output && !outputs)
			continue;
		if (!placed_find(walker, &from->placed, &here))
			return false;
		if (!from->output)
			given[i] = read_input(from, &here,
					at->callee->variable[from->pin].var->type);
	}
	return true;
}

static void write_back(struct walker *walker, const struct walked *at)
{
	for (int i = 0; i < at->parameter_count; i++) {
		const struct parameter *to = &at->parameter[i];
		const struct variable *from = &at->callee->variable[to->pin];

		if (to->output || from->flags & VAR_IN_OUT)
			put(walker, &to->placed, *from->value);
	}
}

/* A block of the project is called with and without power; without a BOOL output it
 * gives no power. A function runs only with power, and its variables start anew. */
static bool call_own(struct walker *walker, struct walked *at, bool power)
{
	struct frame *callee = at->callee;
	bool function = callee->pou->kind == POU_FUNCTION;
	struct value given[LIMIT_ARGS] = { { 0 } };
	int in = function ? -1 : first_bool(callee, VAR_INPUT);
	int out = first_bool(callee, function ? VAR_RESULT : VAR_OUTPUT);

	bool all;

	if (in < 0 && !power)
		return false;
	all = read_parameters(walker, at, function, given);
	if (in >= 0)
		*callee->variable[in].value = value_bool(power);
	if (!all)
		return false;
	frame_reset(walker, callee, !function);
	for (int i = 0; i < at->parameter_count; i++)
		if (!at->parameter[i].output)
			*callee->variable[at->parameter[i].pin].value = given[i];
	if (!walk_pou(walker, callee->body))
		walker->lost = true;
	write_back(walker, at);
	return out < 0 ? power : value_is_true(*callee->variable[out].value);
}

static void call_routine(struct walker *walker, struct walked *at, bool power)
{
	at->power_out = power;
	if (power && !walk_pou(walker, &walker->pou[at->target]))
		walker->lost = true;
}

static void execute(struct walker *walker, struct walked_rung *walked, struct walked *at, bool power)
{
	at->power_out = power;
	if (power && !walk_statements(walker, walked->owner, at->boxed->first, at->boxed->count))
		walker->lost = true;
}

/* Phase 1 of one element, after its feeders. */
static void pass(struct walker *walker, struct walked_rung *walked,
		 struct walked *at)
{
	bool power = net_power(walked, at->in);

	at->power_in = power;
	at->power_out = false;
	at->done = true;
	walker->steps++;
	if (acts_last(at)) {
		at->power_out = power && at->read; /* a coil with outputs behind it */
		return;
	}
	if (at->word == ELEM_CALL)
		call_routine(walker, at, power);
	else if (at->word == ELEM_EXECUTE)
		execute(walker, walked, at, power);
	else if (at->callee)
		at->power_out = call_own(walker, at, power);
	else if (at->block)
		at->power_out = call_block(walker, walked, at, power);
	else if (word_row(at->word)->kind == WORD_FN)
		at->power_out = call_function(walker, walked, at, power);
	else if (at->expression)
		at->power_out = expression_run(walker, at->expression, power);
	else if (at->word == ELEM_NOT)
		at->power_out = !power;
	else
		at->power_out = contact(walker, at, power);
}

/* Depth: a path of a rung has at most its elements; grids of tests are small. */
static void visit(struct walker *walker, struct walked_rung *walked,
		  struct walked *at)
{
	if (at->done)
		return;
	for (int i = 0; i < walked->count; i++)
		if (walked->element[i].out == at->in &&
		    at->in != GRID_RAIL(walked))
			visit(walker, walked, &walked->element[i]);
	for (int j = 0; j < at->parameter_count; j++)
		for (int i = 0; i < walked->count; i++)
			if (at->parameter[j].net >= 0 &&
			    at->parameter[j].net != GRID_RAIL(walked) &&
			    walked->element[i].out == at->parameter[j].net)
				visit(walker, walked, &walked->element[i]);
	pass(walker, walked, at);
}

static void drive(struct walker *walker, struct walked_rung *walked, struct walked *at)
{
	bool power = at->power_in, before = at->memory;
	const struct placed *to = &at->operand;

	if (at->word == ELEM_COIL)
		put(walker, to, value_bool(power));
	else if (at->word == ELEM_COIL_NOT)
		put(walker, to, value_bool(!power));
	else if (at->word == ELEM_COIL_SET && power)
		put(walker, to, value_bool(true));
	else if (at->word == ELEM_COIL_RESET && power)
		put(walker, to, value_bool(false));
	else if (at->word == ELEM_COIL_P)
		put(walker, to, value_bool(power && !before));
	else if (at->word == ELEM_COIL_N)
		put(walker, to, value_bool(!power && before));
	else if (at->word == ELEM_STOP)
		walker->halted |= power;
	else if (at->word == ELEM_CALL)
		call_routine(walker, at, power);
	else if (at->word == ELEM_EXECUTE)
		execute(walker, walked, at, power);
	else if (at->expression)
		at->power_out = expression_run(walker, at->expression, power);
	at->memory = power;
}

#define RUNG_NEXT -1
#define RUNG_LEAVE -2
/* Returns the next rung, RUNG_NEXT or RUNG_LEAVE. */
static int walk_rung(struct walker *walker, struct walked_rung *walked)
{
	walked->scan = walker->scans;
	walked->stopped = walked->count;
	for (int i = 0; i < walked->count; i++)
		walked->element[i].done = false;
	for (int i = 0; i < walked->count; i++)
		if (is_output(&walked->element[i]))
			visit(walker, walked, &walked->element[i]);
	for (int i = 0; i < walked->count; i++) {
		struct walked *at = &walked->element[i];
		bool jump = at->word == ELEM_JUMP || at->word == ELEM_RETURN ||
			    at->word == ELEM_END;

		if (!jump && acts_last(at))
			drive(walker, walked, at);
		if (!jump || !at->power_in)
			continue;
		walked->stopped = i;
		return at->word == ELEM_JUMP ? at->target : RUNG_LEAVE;
	}
	return RUNG_NEXT;
}

bool walk_rungs(struct walker *walker, struct walked_pou *walked, int first, int count)
{
	for (int i = first; i < first + count;) {
		int next = RUNG_NEXT;

		if (++walker->steps > STEPS_MAX || walker->lost)
			return false;
		walked->rung[i].owner = walked;
		if (walked->rung[i].rung)
			next = walk_rung(walker, &walked->rung[i]);
		if (next == RUNG_LEAVE)
			break;
		i = next == RUNG_NEXT ? i + 1 : next;
	}
	return true;
}

static bool walk_pou(struct walker *walker, struct walked_pou *walked)
{
	if (!pou_has_frame(walked->pou))
		frame_reset(walker, walked->frame, true);
	return walked->sfc ? sfc_walk(walker, walked->sfc) :
	       walk_rungs(walker, walked, 0, walked->pou->rung_count);
}

static void set_system(struct walker *walker, enum sys_id id, int64_t value)
{
	const char *name = sys_row(id)->name;
	struct placed placed = walker_place(walker, NULL, name, strlen(name));

	placed_write(&placed, (struct value){ .type = placed.type,
					      .i = value });
}

bool walker_scan(struct walker *walker, int64_t now_ns)
{
	if (walker->halted)
		return false;
	walker->now_ns = now_ns;
	walker->steps = 0;
	set_system(walker, SYS_ALWAYS_ON, 1);
	set_system(walker, SYS_FIRST_SCAN, walker->scans == 0);
	set_system(walker, SYS_MATH_ERROR,
		   walker->errors != walker->errors_before);
	set_system(walker, SYS_ERRORS, walker->errors);
	if (walker->scans == 0)
		walker->start_ns = now_ns;
	set_system(walker, SYS_CLOCK_1S,
		   (now_ns - walker->start_ns) % 1000000000 < 500000000);
	walker->errors_before = walker->errors;
	walker->scans++;
	for (int i = 0; i < walker->project->pou_count; i++)
		if (walker->project->pou[i].kind == POU_PROGRAM &&
		    !walk_pou(walker, &walker->pou[i]))
			return false;
	return !walker->lost && !walker->halted;
}

int walker_count(const struct walker *walker)
{
	return walker->shown_count;
}

const char *walker_name(const struct walker *walker, int index)
{
	return walker->shown[index].name;
}

struct value walker_value(const struct walker *walker, int index)
{
	return placed_read(&walker->shown[index].placed, IEC_NONE);
}

bool walker_is_settled(const struct walker *walker, int index)
{
	const struct block *block = walker->shown[index].block;

	return !block || block->called;
}

static enum walker_power element_power(const struct walked_rung *walked,
				       int index, bool *in, bool *out)
{
	const struct walked *at = &walked->element[index];

	*in = at->power_in;
	*out = at->power_out;
	if (word_row(at->word)->place == PLACE_LAST)
		return POWER_IN_ONLY;
	return acts_last(at) && index > walked->stopped ? POWER_IN_ONLY :
							  POWER_BOTH;
}

static enum walker_power cell_power(const struct walker *walker,
				    const struct walked_pou *body, int rung,
				    int row, int col, bool *in, bool *out)
{
	const struct walked_rung *walked = &body->rung[rung - 1];
	const struct cell *cell;

	if (!body->rung || !walked->rung || walked->scan != walker->scans)
		return POWER_UNKNOWN;
	for (int i = 0; i < walked->count; i++)
		if (walked->element[i].row == row - 1 &&
		    walked->element[i].col == col - 1)
			return element_power(walked, i, in, out);
	cell = rung_at(walked->rung, row - 1, col - 1);
	*in = net_power(walked, grid_net(walked, row - 1, col - 1));
	*out = *in;
	if (cell->word == ELEM_WIRE)
		return POWER_BOTH;
	return cell->word == ELEM_PIN && cell->operand ? POWER_IN_ONLY :
							 POWER_UNKNOWN;
}

enum walker_power walker_power(const struct walker *walker, int pou, int rung,
			       int row, int col, bool *in, bool *out)
{
	return cell_power(walker, &walker->pou[pou], rung, row, col, in, out);
}

static const struct frame *instance_at(const struct walker *walker, int index)
{
	const struct frame *at = walker->instances;

	while (at && index-- > 0)
		at = at->next;
	return at;
}

const struct pou *walker_instance(const struct walker *walker, int index,
				  const char **name)
{
	const struct frame *at = instance_at(walker, index);

	*name = at ? at->name : "";
	return at ? at->pou : NULL;
}

enum walker_power walker_power_in(const struct walker *walker, int index, int rung,
				  int row, int col, bool *in, bool *out)
{
	return cell_power(walker, instance_at(walker, index)->body, rung, row, col,
			  in, out);
}
