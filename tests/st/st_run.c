/* SPDX-License-Identifier: MIT
 *
 * st_run - statements, calls and scans of the evaluator of Structured Text.
 */
#include "tests/st/inside.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What a statement leaves. */
enum flow { FLOW_ON, FLOW_EXIT, FLOW_CONTINUE, FLOW_RETURN, FLOW_JUMP };

static enum flow run_list(struct frame_of *f, const struct stmt *stmt);

/* A condition; what cannot be computed is FALSE. */
static bool is_true(struct frame_of *f, const struct tree *tree)
{
	struct chain_state chain = { .on = true };
	const struct value value = tree_compute(f, tree, IEC_BOOL, &chain);

	return chain.on && value_is_true(value);
}

/* ---- := ---- */

static bool fits_text(const struct slot *slot, struct value value)
{
	return value.type != IEC_STRING || value.len <= slot->value->room;
}

/* A pointer gets a place, which may be nowhere. */
static void refer(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };
	struct slot *pointer = tree_slot(f, stmt->place, &chain);
	struct value index[INDICES_MAX] = { { 0 } };

	target_begin(f, stmt->value->left, &chain, index);
	if (!chain.on)
		return;
	pointer->led = target_slot(f, stmt->value->left, index);
	pointer->value->i = 1;
}

/* pointer ?= other: NULL, if they are for different types. */
static void try_pointer(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };
	struct slot *pointer = tree_slot(f, stmt->place, &chain), *other;
	const bool refers = stmt->value->kind == TREE_REF;
	enum iec_type type;

	other = !refers ? tree_slot(f, stmt->value, &chain) : stmt->value->left ? tree_first(f, stmt->value->left) : NULL;
	type = !other ? IEC_NONE : refers ? other->value->type : other->shape->value->type;
	if (pointer->shape->value->type != type)
		pointer->led = NULL;
	else if (refers)
		refer(f, stmt);
	else
		pointer->led = other->led;
}

/* The value is computed, then the target is found; the last operation stores, a wrapped result too. A
 * target that is not there: one error, whatever the value is. */
static void assign(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };
	const struct slot *first = tree_first(f, stmt->place);
	struct st_world *world = f->world;
	struct value value, index[INDICES_MAX] = { { 0 } };
	struct slot *to, *from;

	if (stmt->body)
		assign(f, stmt->body);
	if (stmt->tried) {
		try_pointer(f, stmt);
		return;
	}
	if (stmt->value->kind == TREE_REF) {
		refer(f, stmt);
		return;
	}
	target_begin(f, stmt->place, &chain, index);
	if (first->kind != SLOT_VALUE) {
		from = chain.on ? tree_slot(f, stmt->value, &chain) : NULL;
		to = target_slot(f, stmt->place, index);
		if (from && to)
			slot_copy(to, from);
		world->errors += from && !to;
		return;
	}
	chain.nowhere = stmt->value->kind == TREE_CALL ? stmt : NULL;
	chain.index = index;
	value = tree_compute(f, stmt->value, tree_type(f, stmt->place, IEC_NONE), &chain);
	to = target_slot(f, stmt->place, index);
	if (!to) {
		world->errors += chain.on;
		return;
	}
	if (!chain.on && chain.wrapped != stmt->value)
		return;
	if (!chain.on && to->var && to->var->range) /* a result that wrapped is beyond its limits */
		return;
	if (stmt->place->bits) {
		if (chain.on)
			slot_put(world, to, part_put(stmt->place, *to->value, value));
		return;
	}
	if (!fits_text(to, value) && chain.on)
		world->errors++;
	slot_put(world, to, value);
}

/* ---- calls ---- */

/* Which variable of the callee an argument belongs to; @last counts those without a name. */
static int target_of(const struct slot *callee, const struct tree *arg, int *last)
{
	if (arg->pin) {
		for (int i = 0; i < callee->count; i++)
			if (strncasecmp(callee->part[i].name, arg->pin, (size_t)arg->pin_len) == 0 &&
			    !callee->part[i].name[arg->pin_len])
				return i;
		return -1;
	}
	do
		++*last;
	while (*last < callee->count && !(callee->part[*last].flags & (VAR_INPUT | VAR_IN_OUT)));
	return *last < callee->count ? *last : -1;
}

#define ARGS_MAX 12
/* The arguments of one call; values are read before the callee runs. */
struct given {
	const struct tree *arg[ARGS_MAX];
	int to[ARGS_MAX];
	struct value value[ARGS_MAX];
	struct slot *whole[ARGS_MAX]; /* VAR_IN_OUT: the caller's own          */
	int count;
};

static bool is_pin(const struct tree *arg, const char *name)
{
	return arg->pin && arg->pin_len == (int)strlen(name) && strncasecmp(arg->pin, name, strlen(name)) == 0;
}

static void read_arguments(struct frame_of *f, const struct tree *arg, struct slot *callee,
			   struct chain_state *chain, struct given *given)
{
	int last = -1;

	for (; arg && given->count < ARGS_MAX; arg = arg->next) {
		if (is_pin(arg, "EN") || (arg->out && is_pin(arg, "ENO")))
			continue;
		const int to = target_of(callee, arg, &last), n = given->count++;
		const bool place = to >= 0 && callee->part[to].flags & VAR_IN_OUT;

		given->arg[n] = arg;
		given->to[n] = to;
		if (to < 0 || arg->out)
			continue;
		if (place || callee->part[to].kind != SLOT_VALUE)
			given->whole[n] = chain->on ? tree_slot(f, arg, chain) : NULL;
		else
			given->value[n] = tree_compute(f, arg, callee->part[to].value->type, chain);
	}
}

static void give_arguments(struct st_world *world, struct slot *callee, const struct given *given)
{
	for (int i = 0; i < given->count; i++) {
		struct slot *to = &callee->part[given->to[i]];

		if (given->arg[i]->out)
			continue;
		if (given->whole[i] && to->var && to->var->any_bounds) {
			const struct slot own = *to, *clone = slot_clone(world, given->whole[i]);

			if (clone) {
				*to = *clone;
				to->name = own.name;
				to->flags = own.flags;
				to->var = own.var;
			}
		} else if (given->whole[i]) {
			slot_copy(to, given->whole[i]);
		} else {
			const int room = to->value->room;

			*to->value = given->value[i];
			to->value->room = room;
			if (to->value->len > room)
				to->value->len = room;
		}
	}
}

/* VAR_IN_OUT back, and outputs. */
static void take_results(struct frame_of *f, struct slot *callee, const struct given *given)
{
	for (int i = 0; i < given->count; i++) {
		struct chain_state chain = { .on = true };
		struct slot *from = &callee->part[given->to[i]], *to;

		if (!(from->flags & VAR_IN_OUT) && !given->arg[i]->out)
			continue;
		to = tree_slot(f, given->arg[i], &chain); /* its indices are read again */
		if (to && given->arg[i]->bits)
			slot_put(f->world, to, part_put(given->arg[i], *to->value, *from->value));
		else if (to && to->kind == SLOT_VALUE)
			slot_put(f->world, to, *from->value);
		else if (to)
			slot_copy(to, from);
	}
}

static const struct body *body_of(const struct st_world *world, const struct pou *pou)
{
	return &world->body[pou - world->project->pou];
}

/* ENO => of a function. */
static void tell_result(struct frame_of *f, const struct tree *call, bool good)
{
	for (const struct tree *arg = call->left; arg; arg = arg->next) {
		struct chain_state chain = { .on = true };
		const bool eno = arg->out && is_pin(arg, "ENO");
		struct slot *to = eno ? tree_slot(f, arg, &chain) : NULL;

		if (to && arg->bits)
			slot_put(f->world, to, part_put(arg, *to->value, value_bool(good)));
		else if (to)
			slot_put(f->world, to, value_bool(good));
	}
}

static bool run_called(struct frame_of *f, const struct tree *call, struct chain_state *chain,
		       struct value *out);

bool run_function(struct frame_of *f, const struct tree *call, struct chain_state *chain,
		  struct value *out)
{
	bool good;

	for (const struct tree *arg = call->left; arg; arg = arg->next)
		if (is_pin(arg, "EN"))
			chain->on &= value_is_true(tree_compute(f, arg, IEC_BOOL, chain));
	good = run_called(f, call, chain, out);
	tell_result(f, call, good);
	return good;
}

static bool run_called(struct frame_of *f, const struct tree *call, struct chain_state *chain,
		       struct value *out)
{
	const struct body *body = body_of(f->world, call->pou);
	struct slot callee = body->frame;
	struct given given = { .count = 0 };
	bool good = true;

	*out = (struct value){ .type = callee.part[0].value ? callee.part[0].value->type : IEC_NONE };
	read_arguments(f, call->left, &callee, chain, &given);
	if (chain->on && chain->nowhere && chain->nowhere->value == call &&
	    !target_slot(f, chain->nowhere->place, chain->index)) {
		f->world->errors++;
		chain->on = false;
	}
	if (!chain->on)
		return false;
	slot_reset(f->world, &callee, false);
	for (int i = 0; i < callee.count; i++)
		if (vars_is_eno(&call->pou->vars, i))
			callee.part[i].value->i = 1;
	give_arguments(f->world, &callee, &given);
	run_body(f->world, body, &callee);
	for (int i = 0; i < callee.count; i++)
		if (vars_is_eno(&call->pou->vars, i))
			good = value_is_true(*callee.part[i].value);
	if (!good) {
		chain->on = false;
		return false;
	}
	take_results(f, &callee, &given);
	*out = *callee.part[0].value;
	return true;
}

static bool is_enable(const struct slot *callee, const struct tree *arg)
{
	int last = 0;

	return arg->pin && arg->pin_len == 2 && strncasecmp(arg->pin, "EN", 2) == 0 &&
	       target_of(callee, arg, &last) < 0;
}

static void call_instance(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };
	struct slot *callee = tree_first(f, stmt->place);
	struct value index[INDICES_MAX] = { { 0 } };
	struct given given = { .count = 0 };
	const struct tree *rest = stmt->args;

	target_begin(f, stmt->place, &chain, index);
	if (!chain.on)
		return;
	if (rest && is_enable(callee, rest)) {
		if (!is_true(f, rest))
			return;
		rest = rest->next;
	}
	read_arguments(f, rest, callee, &chain, &given);
	if (!chain.on)
		return;
	callee = target_slot(f, stmt->place, index);
	if (!callee) {
		f->world->errors++;
		return;
	}
	give_arguments(f->world, callee, &given);
	if (callee->kind == SLOT_BLOCK) {
		callee->block->called = true;
		block_call(callee->block, f->world->now_ns);
	} else {
		slot_reset(f->world, callee, true);
		run_body(f->world, body_of(f->world, callee->pou), callee);
	}
	take_results(f, callee, &given);
}

/* Other(In := 5, Out => Level): assignments before and behind its body. */
static void call_program(struct frame_of *f, const struct stmt *stmt)
{
	struct st_world *world = f->world;
	const struct body *body = body_of(world, stmt->called);
	struct slot frame = body->frame;
	int last = -1;

	for (int after = 0; after < 2; after++) {
		for (const struct tree *arg = stmt->args; arg; arg = arg->next) {
			struct tree place = { .kind = TREE_PLACE, .local = -1, .global = &frame.part[target_of(&frame, arg, &last)] };
			struct tree value = *arg;
			const struct stmt one = { .kind = ST_ASSIGN, .place = arg->out ? &value : &place,
						  .value = arg->out ? &place : &value };

			if (arg->out == (after == 1))
				assign(f, &one);
		}
		if (after == 0) {
			slot_reset(world, &frame, true);
			run_body(world, body, &frame);
		}
	}
}

/* Days since 1970-01-01 as a day of the calendar, year by year. */
static void calendar(int64_t days, int64_t part[3])
{
	static const int length[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
	int64_t year = 1970;
	bool leap;

	for (;;) {
		leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
		if (days < 0)
			year--, days += (year % 4 == 0 && year % 100 != 0) || year % 400 == 0 ? 366 : 365;
		else if (days >= 365 + leap)
			year++, days -= 365 + leap;
		else
			break;
	}
	part[0] = year;
	for (part[1] = 1; days >= length[part[1] - 1] + (part[1] == 2 && leap); part[1]++)
		days -= length[part[1] - 1] + (part[1] == 2 && leap);
	part[2] = days + 1;
}

static void split(struct frame_of *f, const struct stmt *stmt)
{
	static const char *const pins[] = { "YEAR", "MONTH", "DAY", "HOUR", "MINUTE", "SECOND", "MILLISECOND" };
	const int64_t day_ns = INT64_C(86400000000000);
	const int first = stmt->parts == 2 ? 3 : 0;
	struct chain_state chain = { .on = true };
	int64_t part[7], of_day;
	struct value in = { 0 };
	int number = first;

	for (const struct tree *arg = stmt->args; arg; arg = arg->next)
		if (is_pin(arg, "IN") || (!arg->pin && arg == stmt->args))
			in = tree_compute(f, arg, IEC_NONE, &chain);
	if (!chain.on)
		return;
	of_day = in.i % day_ns + (in.i % day_ns < 0 ? day_ns : 0);
	calendar((in.i - of_day) / day_ns, part);
	part[3] = of_day / INT64_C(3600000000000);
	part[4] = of_day / INT64_C(60000000000) % 60;
	part[5] = of_day / 1000000000 % 60;
	part[6] = of_day / 1000000 % 1000;
	for (const struct tree *arg = stmt->args; arg; arg = arg->next) {
		struct tree whole = { .kind = TREE_CONSTANT, .literal.type = IEC_INT };
		struct tree place = *arg, turned = { .kind = TREE_CALL, .fn = FN_CONVERT, .left = &whole };
		const struct stmt one = { .kind = ST_ASSIGN, .place = &place, .value = &turned };

		if (is_pin(arg, "IN") || (!arg->pin && arg == stmt->args))
			continue;
		for (int i = 0; arg->pin && i < 7; i++)
			if (is_pin(arg, pins[i]))
				number = i;
		whole.literal.value.i = part[number++];
		turned.to = tree_type(f, arg, IEC_NONE);
		assign(f, &one);
	}
}

static void call(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };

	if (stmt->parts) {
		split(f, stmt);
	} else if (stmt->called && stmt->called->kind == POU_PROGRAM) {
		call_program(f, stmt);
	} else if (stmt->called) {
		const struct body *body = body_of(f->world, stmt->called);
		struct slot frame = body->frame;

		slot_reset(f->world, &frame, true);
		run_body(f->world, body, &frame);
	} else if (stmt->place) {
		call_instance(f, stmt);
	} else {
		tree_compute(f, stmt->value, IEC_NONE, &chain);
	}
}

/* ---- blocks of statements ---- */

static int64_t whole_value(struct frame_of *f, const struct tree *tree, enum iec_type wanted,
			   bool *good)
{
	struct chain_state chain = { .on = *good };
	const struct value value = tree_compute(f, tree,
		tree_type(f, tree, wanted) ? IEC_NONE : wanted, &chain);

	*good = chain.on;
	return value.i;
}

static bool has_value(const struct choice *choice, int64_t value)
{
	for (; choice; choice = choice->next) {
		struct frame_of none = { 0 };
		bool good = true;
		const int64_t low = whole_value(&none, choice->low, IEC_LINT, &good);
		const int64_t high = choice->high ?
			whole_value(&none, choice->high, IEC_LINT, &good) : low;

		if (low <= value && value <= high)
			return true;
	}
	return false;
}

static enum flow run_case(struct frame_of *f, const struct stmt *stmt)
{
	bool good = true;
	const int64_t value = whole_value(f, stmt->value, IEC_DINT, &good);

	for (const struct stmt *at = stmt->body; good && at; at = at->next)
		if (at->kind == ST_ELSE || has_value(at->choice, value))
			return run_list(f, at->body);
	return FLOW_ON;
}

static enum flow run_if(struct frame_of *f, const struct stmt *stmt)
{
	for (; stmt; stmt = stmt->other)
		if (!stmt->value || is_true(f, stmt->value))
			return run_list(f, stmt->body);
	return FLOW_ON;
}

/* Leaves @flow what goes on outside of the loop; true: the loop ends. */
static bool loop_ends(enum flow *flow)
{
	const bool ends = *flow == FLOW_EXIT || *flow == FLOW_RETURN || *flow == FLOW_JUMP;

	if (*flow != FLOW_RETURN && *flow != FLOW_JUMP)
		*flow = FLOW_ON;
	return ends;
}

static enum flow run_while(struct frame_of *f, const struct stmt *stmt)
{
	enum flow flow = FLOW_ON;

	while (!f->world->lost && is_true(f, stmt->value)) {
		f->world->steps++;
		flow = run_list(f, stmt->body);
		if (loop_ends(&flow))
			break;
	}
	return flow;
}

static enum flow run_repeat(struct frame_of *f, const struct stmt *stmt)
{
	enum flow flow;

	do {
		f->world->steps++;
		flow = run_list(f, stmt->body);
		if (loop_ends(&flow))
			break;
	} while (!f->world->lost && !is_true(f, stmt->value));
	return flow;
}

/* The next value of the variable; false: its type has none. */
static bool step_to(struct slot *slot, int64_t by)
{
	const struct iec_type_row *row = iec_type_row(slot->value->type);
	const bool wide = slot->value->type == IEC_ULINT;
	int64_t next;

	if (wide ? (by > 0 ? (uint64_t)slot->value->i > UINT64_MAX - (uint64_t)by :
			     (uint64_t)slot->value->i < (uint64_t)-by) :
		   __builtin_add_overflow(slot->value->i, by, &next) ||
		   next < row->low || next > row->high)
		return false;
	next = (int64_t)((uint64_t)slot->value->i + (uint64_t)by);
	if (!slot_fits(slot, (struct value){ .type = slot->value->type, .i = next }))
		return false;
	slot->value->i = next;
	return true;
}

static bool is_past(const struct slot *slot, int64_t to, int64_t by)
{
	const int64_t is = slot->value->i;

	if (slot->value->type == IEC_ULINT)
		return by < 0 ? (uint64_t)is < (uint64_t)to : (uint64_t)is > (uint64_t)to;
	return by < 0 ? is < to : is > to;
}

static enum flow run_for(struct frame_of *f, const struct stmt *stmt)
{
	struct chain_state chain = { .on = true };
	struct slot *slot = tree_slot(f, stmt->place, &chain);
	const enum iec_type type = slot->value->type;
	enum flow flow = FLOW_ON;
	bool good = true;
	struct value from = { .type = type };
	int64_t to, by = 1;

	from.i = whole_value(f, stmt->from, type, &good);
	if (good && !slot_put(f->world, slot, from))
		good = false;
	to = good ? whole_value(f, stmt->to, type, &good) : 0;
	if (stmt->by && good)
		by = whole_value(f, stmt->by, type, &good);
	while (good && by && !is_past(slot, to, by) && !f->world->lost) {
		f->world->steps++;
		flow = run_list(f, stmt->body);
		if (loop_ends(&flow) || !step_to(slot, by))
			break;
	}
	return flow;
}

static enum flow run_one(struct frame_of *f, const struct stmt *stmt)
{
	switch ((int)stmt->kind) {
	case ST_ASSIGN: assign(f, stmt); break;
	case ST_CALL: call(f, stmt); break;
	case ST_IF: return run_if(f, stmt);
	case ST_CASE: return run_case(f, stmt);
	case ST_FOR: return run_for(f, stmt);
	case ST_WHILE: return run_while(f, stmt);
	case ST_REPEAT: return run_repeat(f, stmt);
	case ST_EXIT: return FLOW_EXIT;
	case ST_CONTINUE: return FLOW_CONTINUE;
	case ST_RETURN: return FLOW_RETURN;
	case ST_JUMP: f->jump = stmt; return FLOW_JUMP;
	default: break;
	}
	return FLOW_ON;
}

/* The label that the jump names, among these statements; NULL: it stands further outside. */
static const struct stmt *label_among(const struct stmt *first, const struct stmt *jump)
{
	for (; first; first = first->next)
		if (first->kind == ST_LABEL && first->label.len == jump->label.len &&
		    strncasecmp(first->label.text, jump->label.text, jump->label.len) == 0)
			return first;
	return NULL;
}

static enum flow run_list(struct frame_of *f, const struct stmt *first)
{
	enum flow flow = FLOW_ON;

	for (const struct stmt *stmt = first; stmt && flow == FLOW_ON && !f->world->lost; stmt = stmt->next) {
		if (++f->world->steps > STEPS_MAX)
			f->world->lost = true;
		flow = run_one(f, stmt);
		if (flow != FLOW_JUMP)
			continue;
		stmt = label_among(first, f->jump);
		if (!stmt)
			return FLOW_JUMP;
		flow = FLOW_ON;
	}
	return flow;
}

bool run_body(struct st_world *world, const struct body *body, struct slot *locals)
{
	struct frame_of f = { .world = world, .locals = locals };

	run_list(&f, body->first);
	return !world->lost;
}

/* ---- the world ---- */

static bool make_all(struct st_world *world)
{
	struct project *project = world->project;
	const size_t size = (size_t)project->pou_count * sizeof(*world->body);

	world->body = arena_alloc(&world->arena, size + 1);
	if (!world->body || !slot_frame(world, &world->globals, &project->globals))
		return false;
	slot_show(world, &world->globals, "");
	for (int i = 0; i < project->pou_count; i++) {
		struct body *body = &world->body[i];

		body->pou = &project->pou[i];
		if (!slot_frame(world, &body->frame, &body->pou->vars))
			return false;
		if (body->pou->kind == POU_PROGRAM || body->pou->kind == POU_SUBROUTINE)
			slot_show(world, &body->frame, project_text(project, body->pou->name));
	}
	for (int i = 0; i < project->pou_count; i++)
		if (!parse_body(world, &world->body[i]))
			return false;
	return true;
}

struct st_world *st_world_new(struct project *project, const char **why)
{
	struct st_world *world = calloc(1, sizeof(*world));

	*why = "out of memory";
	if (!world)
		return NULL;
	arena_init(&world->arena);
	world->project = project;
	if (make_all(world))
		return world;
	*why = world->why ? world->why : *why;
	st_world_free(world);
	return NULL;
}

void st_world_free(struct st_world *world)
{
	if (!world)
		return;
	arena_free(&world->arena);
	free(world);
}

bool st_world_scan(struct st_world *world, int64_t now_ns)
{
	world->now_ns = now_ns;
	world->steps = 0;
	for (int i = 0; i < world->project->pou_count; i++) {
		struct slot frame = world->body[i].frame;

		if (world->project->pou[i].kind != POU_PROGRAM || world->body[i].called)
			continue;
		slot_reset(world, &frame, true);
		if (!run_body(world, &world->body[i], &frame))
			return false;
	}
	return true;
}

uint32_t st_world_errors(const struct st_world *world)
{
	return world->errors;
}

int st_world_count(const struct st_world *world)
{
	return world->shown_count;
}

const char *st_world_name(const struct st_world *world, int index)
{
	return world->shown[index].name;
}

struct value *st_world_value(struct st_world *world, int index)
{
	return world->shown[index].value;
}

bool st_world_is_settled(const struct st_world *world, int index)
{
	const struct block *block = world->shown[index].block;

	return !block || block->called;
}
