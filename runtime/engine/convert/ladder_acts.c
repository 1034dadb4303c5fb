/* SPDX-License-Identifier: MIT
 *
 * ladder_acts - what the rungs of a POU do, in the order of docs/language.md.
 *
 * As in translate/ld_to_il.c, all but outputs comes first, each element once; then outputs act,
 * top to bottom. An element that read what a later act writes keeps its value in a temporary.
 */
#include "engine/convert/acts.h"

#include "engine/base/ascii.h"
#include "engine/model/args.h"
#include "engine/model/loop.h"
#include "engine/model/network.h"
#include "engine/model/st.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct call {
	struct act_arg arg[LIMIT_ARGS + LIMIT_FN_ARGS];
	int count, inputs;
	bool fails;           /* an input may not exist                       */
	uint32_t out, eno;    /* of a function: OUT, ENO; 0: none             */
};

/* What an element lets through. */
struct element {
	bool seen;
	bool powered;              /* @leaf is its power, else: if it has some */
	const struct term *leaf;   /* NULL: not power                          */
};

struct net {
	bool seen;
	const struct term *kept;   /* its power is in a temporary              */
};

struct rungs {
	struct acts *acts;
	struct arena *scratch;
	struct diag_list *ignored; /* texts that were read before              */
	const struct rung *rung;
	int number;                /* 0-based                                  */
	struct network network;
	struct element *element;
	struct net *net;
	int loops;
	struct act_loop loop[LIMIT_LOOPS];
	uint32_t *label;           /* of EXECUTE boxes: their folds            */
	int labels;
	struct call no_call;       /* given when memory is out                 */
};

static const char *text_of(const struct rungs *r, uint32_t id)
{
	return project_text(r->acts->project, id);
}

static const struct word_row *row_of(const struct rungs *r, int element)
{
	return words_row(&r->acts->project->words, (enum word)r->network.element[element].word);
}

static const struct cell *cell_of(const struct rungs *r, int element)
{
	const struct network_element *at = &r->network.element[element];

	return rung_at(r->rung, at->row, at->col);
}

static void refuse(struct rungs *r, int element, enum diag_id id, const char *what)
{
	const struct network_element *at = element >= 0 ? &r->network.element[element] : NULL;
	const struct pou *pou = r->acts->pou;
	const struct diag place = {
		.id = id, .file = pou->file, .pou = text_of(r, pou->name),
		.rung = r->number + 1, .line = rung_line(r->rung, at ? at->row + 1 : 0),
		.row = at ? at->row + 1 : 0, .col = at ? at->col + 1 : 0,
	};

	r->acts->refused = true;
	diag_add(r->acts->diags, place, "%s", what);
}

/* @word of an element has no counterpart. */
static void refuse_word(struct rungs *r, int element, const char *word)
{
	char what[64];

	snprintf(what, sizeof(what), "%s" DIAG_AND "%s", word,
		 pou_language_word(r->acts->networks ? LANGUAGE_FBD : LANGUAGE_ST));
	refuse(r, element, DIAG_CONVERT_STOP, what);
}

static bool is_unread(const struct rungs *r, int element)
{
	const int out = r->network.element[element].out;

	return out == NET_RAIL || r->network.reader_count[out] == 0;
}

static bool is_actor(const struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);

	if (row->operand == OPND_ASSIGN || row->operand == OPND_ROUTINE ||
	    row->operand == OPND_EXECUTE)
		return is_unread(r, element);
	return row->place == PLACE_LAST;
}

/* ---- power ---- */

static const struct term *power_in(struct rungs *r, int net);

static const struct term *power_out(struct rungs *r, int element)
{
	const struct network_element *at = &r->network.element[element];
	const struct element *e = &r->element[element];

	if (!e->leaf)
		return term_not(r->acts, power_in(r, at->in));
	return e->powered ? e->leaf : term_both(r->acts, TERM_AND, power_in(r, at->in), e->leaf);
}

static const struct term *unless_true(const struct term *term)
{
	return term->kind == TERM_TRUE ? NULL : term;
}

/* Contacts between the same two nets share the power before them: (A OR B) AND Stop. */
static const struct term *power_beside(struct rungs *r, const int *feeder, int count, int at)
{
	const struct network_element *first = &r->network.element[feeder[at]];
	const struct term *sum = NULL;

	if (first->in == NET_RAIL || !r->element[feeder[at]].leaf || r->element[feeder[at]].powered)
		return power_out(r, feeder[at]);
	for (int i = at; i < count; i++) {
		const struct element *e = &r->element[feeder[i]];

		if (r->network.element[feeder[i]].in != first->in || !e->leaf || e->powered)
			continue;
		sum = sum ? term_both(r->acts, TERM_OR, sum, e->leaf) : e->leaf;
	}
	return term_both(r->acts, TERM_AND, power_in(r, first->in), sum);
}

static bool was_beside(const struct rungs *r, const int *feeder, int at)
{
	const int in = r->network.element[feeder[at]].in;

	if (in == NET_RAIL || !r->element[feeder[at]].leaf || r->element[feeder[at]].powered)
		return false;
	for (int i = 0; i < at; i++)
		if (r->network.element[feeder[i]].in == in && r->element[feeder[i]].leaf &&
		    !r->element[feeder[i]].powered)
			return true;
	return false;
}

static const struct term *keep(struct rungs *r, const struct term *value)
{
	const int temp = acts_temp(r->acts, IEC_BOOL, r->number);
	struct act *act = acts_add(r->acts, ACT_STORE);

	act->temp = temp;
	act->value = value;
	return term_temp(r->acts, temp);
}

/* A term that several readers share is computed once; a single operand is not worth it. */
static const struct term *power_in(struct rungs *r, int net)
{
	const struct network *n = &r->network;
	const int *feeder = n->feeder + n->first_feeder[net];
	const int count = n->first_feeder[net + 1] - n->first_feeder[net];
	const struct term *sum = NULL;

	if (net == NET_RAIL || count == 0)
		return term_true(r->acts);
	if (r->net[net].kept)
		return r->net[net].kept;
	for (int i = 0; i < count; i++) {
		const struct term *one;

		if (was_beside(r, feeder, i))
			continue;
		one = power_beside(r, feeder, count, i);
		sum = sum ? term_both(r->acts, TERM_OR, sum, one) : one;
	}
	if (n->reader_count[net] > 1 && term_size(r->acts, sum) > 1)
		sum = r->net[net].kept = keep(r, sum);
	return sum;
}

/* ---- keeping aside ---- */

static void keep_leaf(struct rungs *r, int element)
{
	struct element *e = &r->element[element];

	e->leaf = keep(r, e->leaf);
}

static void freeze(struct rungs *r, uint32_t operand)
{
	for (int i = 0; operand && i < r->network.element_count; i++)
		if (r->element[i].leaf && term_reads(r->acts, r->element[i].leaf, operand))
			keep_leaf(r, i);
}

/* Before acts that may write any global, or with @all any variable. */
static void freeze_many(struct rungs *r, bool all)
{
	const struct act act = { .kind = ACT_CALL, .temp = -1, .writes_globals = true,
				 .writes_any = all };

	for (int i = 0; i < r->network.element_count; i++)
		if (r->element[i].leaf && act_touches(r->acts, &act, r->element[i].leaf))
			keep_leaf(r, i);
}

/* ---- expressions ---- */

/* Facts about the text of a cell. */
struct words {
	const struct term *term;
	bool fails;         /* it may be impossible to compute                 */
	bool inner;         /* a part of it may be                             */
	bool own;           /* it calls a function of the project              */
};

static bool add_read(struct acts *acts, uint32_t **read, int *reads, uint32_t operand)
{
	uint32_t *at = arena_push(acts->arena, read, reads, sizeof(**read));

	if (at)
		*at = operand;
	else
		acts->failed = true;
	return at;
}

static bool is_enum_value(const struct rungs *r, const char *text, size_t len)
{
	size_t head;

	return scope_value(r->acts->scope, text, len, &head) >= 0;
}

/* An operand of an expression. */
static void look_at_name(struct rungs *r, const char *text, size_t len, struct term *term,
			 uint32_t **read, struct words *out)
{
	const uint32_t id = acts_intern(r->acts, text, len);
	const struct meaning *m = acts_meaning(r->acts, id);

	if (!m && is_enum_value(r, text, len))
		return;
	if (!m || m->opens || m->through) {
		out->fails = term->reads_any = true;
		return;
	}
	if (m->kind != MEANING_LITERAL)
		add_read(r->acts, read, &term->reads, id);
}

static enum level level_of(const struct expr_node *node)
{
	switch (node->op) {
	case EXPR_OR:
		return LEVEL_OR;
	case EXPR_XOR:
		return LEVEL_XOR;
	case EXPR_AND:
		return LEVEL_AND;
	case EXPR_NEG: case EXPR_NOT:
		return LEVEL_SIGN;
	case EXPR_FN:
		if (node->fn == FN_EQ || node->fn == FN_NE)
			return LEVEL_EQUAL;
		if (node->fn >= FN_GT && node->fn <= FN_NE)
			return LEVEL_LESS;
		if (node->fn == FN_ADD || node->fn == FN_SUB)
			return LEVEL_ADD;
		return node->fn == FN_EXPT ? LEVEL_POWER : LEVEL_MUL;
	case EXPR_NAME: case EXPR_INDEX: case EXPR_BIT: case EXPR_LITERAL: case EXPR_CALL: case EXPR_ARG:
		break;
	}
	return LEVEL_NAME;
}

static bool is_sure(const struct expr *expr, const struct expr_node *node)
{
	switch (node->op) {
	case EXPR_NEG:
		return expr->node[node->left].op == EXPR_LITERAL;
	case EXPR_FN:
		return node->fn >= FN_GT && node->fn <= FN_NE;
	case EXPR_INDEX: case EXPR_CALL:
		return false;
	case EXPR_NAME: case EXPR_BIT: case EXPR_LITERAL: case EXPR_NOT: case EXPR_AND: case EXPR_XOR:
	case EXPR_OR: case EXPR_ARG:
		break;
	}
	return true;
}

/* The expression of acts->expr, whose text this is. */
static struct words look_at(struct rungs *r, const char *text, size_t len)
{
	struct acts *acts = r->acts;
	const struct expr *expr = acts->expr;
	struct term *term = arena_alloc(acts->arena, sizeof(*term));
	struct words out = { .term = term };
	uint32_t *read = NULL;

	if (!term) {
		acts->failed = true;
		return (struct words){ .term = term_true(acts) };
	}
	*term = (struct term){ .kind = TERM_WORDS, .temp = -1, .text = acts_intern(acts, text, len),
			       .level = (uint8_t)level_of(&expr->node[expr->root]) };
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *node = &expr->node[i];

		out.fails |= !is_sure(expr, node);
		out.inner |= i != expr->root && out.fails;
		if (node->op == EXPR_NAME)
			look_at_name(r, node->text, node->len, term, &read, &out);
		if (node->op == EXPR_INDEX)
			term->reads_any = true;
		if (node->op == EXPR_CALL &&
		    scope_pou(acts->scope, acts->pou, acts_intern(acts, node->text, node->len)))
			out.own = term->reads_any = true;
		if (node->op == EXPR_ARG && node->output)
			out.own = term->reads_any = true;
	}
	out.inner |= term->reads_any;
	term->read = read;
	return out;
}

static bool parse(struct rungs *r, int element, const char **text, size_t *len)
{
	const uint32_t id = cell_of(r, element)->operand;
	struct lex lex;

	*text = text_of(r, id);
	*len = names_len(&r->acts->project->names, id);
	lex_init(&lex, *text, *len);
	lex_next(&lex);
	return expr_parse_cell(&lex, r->acts->expr, r->ignored, (struct diag){ .id = DIAG_COUNT });
}

static struct call *call_new(struct rungs *r)
{
	struct call *call = arena_alloc(r->acts->arena, sizeof(*call));

	if (call)
		return call;
	r->acts->failed = true;
	return &r->no_call;
}

static void add_arg(struct rungs *r, struct call *call, uint32_t pin, const struct term *value,
		    uint32_t place)
{
	if (call->count == (int)(sizeof(call->arg) / sizeof(*call->arg))) {
		r->acts->failed = true;
		return;
	}
	call->arg[call->count++] = (struct act_arg){ pin, value, place, -1 };
	call->inputs += value != NULL;
}

static void put_args(struct rungs *r, const struct call *call, struct act *act)
{
	const size_t size = sizeof(*act->arg) * (size_t)call->count;

	act->arg = arena_alloc(r->acts->arena, size + 1);
	if (!act->arg) {
		r->acts->failed = true;
		return;
	}
	if (size)
		memcpy(act->arg, call->arg, size);
	act->args = call->count;
}

/* FALSE in a temporary that a call may not reach. */
static void store_false(struct rungs *r, int temp)
{
	struct act *act = acts_add(r->acts, ACT_STORE);

	act->temp = temp;
	act->value = term_words(r->acts, LEVEL_NAME, "FALSE", 5);
}

/* An element that may not exist, as it is now, in a temporary, while @there; which then tells too whether
 * it exists. */
static const struct term *fetch(struct rungs *r, uint32_t operand, const struct term **there)
{
	struct acts *acts = r->acts;
	const struct meaning *m = acts_meaning(acts, operand);
	const int value = acts_temp(acts, m->type, r->number), good = acts_temp(acts, IEC_BOOL, r->number);
	struct call *call = call_new(r);
	struct act *act;

	store_false(r, good);
	add_arg(r, call, acts_intern(acts, "IN", 2), term_name(acts, operand), 0);
	add_arg(r, call, acts_intern(acts, "ENO", 3), NULL, 0);
	call->arg[1].temp = good;
	act = acts_add(acts, ACT_CALL);
	act->text = acts_intern(acts, "MOVE", 4);
	act->temp = value;
	act->when = *there;
	act->fails = true;
	put_args(r, call, act);
	*there = term_temp(acts, good);
	return term_temp(acts, value);
}

/* ---- operands of boxes ---- */

/* A value that is written at a box. */
static const struct term *value_of(struct rungs *r, const struct arg *arg, bool *fails)
{
	const uint32_t id = acts_intern(r->acts, arg->value, arg->value_len);
	const struct meaning *m = acts_meaning(r->acts, id);
	const struct term *term = term_name(r->acts, id);

	if (m && (m->opens || m->through))
		*fails = true;
	return arg->inverse ? term_not(r->acts, term) : term;
}

static bool is_pin(const struct arg *arg, const char *name)
{
	return arg->pin_len == strlen(name) && strncasecmp(arg->pin, name, arg->pin_len) == 0;
}

/* The parameters of a box, and its pins that branches feed. */
static void take_args(struct rungs *r, int element, struct call *call, bool function)
{
	const struct network_element *at = &r->network.element[element];
	struct arg arg;

	for (int i = 0; i < at->pins; i++) {
		const struct network_pin *pin = &r->network.pin[at->first_pin + i];

		add_arg(r, call, pin->operand, power_in(r, pin->in), 0);
	}
	for (const char *next = text_of(r, cell_of(r, element)->args); args_next(&next, &arg);) {
		const uint32_t pin = acts_intern(r->acts, arg.pin, arg.pin_len);

		if (!arg.output)
			add_arg(r, call, pin, value_of(r, &arg, &call->fails), 0);
		else if (function && is_pin(&arg, "OUT"))
			call->out = acts_intern(r->acts, arg.value, arg.value_len);
		else if (function && is_pin(&arg, "ENO"))
			call->eno = acts_intern(r->acts, arg.value, arg.value_len);
		else
			add_arg(r, call, pin, NULL, acts_intern(r->acts, arg.value, arg.value_len));
	}
}

/* An operand at an input of one's own may be a VAR_IN_OUT. */
static void add_in_outs(struct rungs *r, struct act *act)
{
	uint32_t *write = NULL;
	int writes = 0;

	for (int i = 0; i < act->writes; i++)
		add_read(r->acts, &write, &writes, act->write[i]);
	for (int i = 0; i < act->args; i++)
		if (act->arg[i].value && act->arg[i].value->kind == TERM_NAME)
			add_read(r->acts, &write, &writes, act->arg[i].value->text);
	act->write = write;
	act->writes = writes;
}

/* Readers of what the box writes keep their values. */
static void freeze_written(struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);
	const bool own = word_is_own((enum word)r->network.element[element].word);
	struct arg arg;

	for (const char *at = text_of(r, cell_of(r, element)->args); args_next(&at, &arg);) {
		const int pin = own ? word_pin_find(row, arg.pin, arg.pin_len) : -1;

		if (arg.output || (pin >= 0 && pin < row->pin_count && row->pin[pin].dir == PIN_IN_OUT))
			freeze(r, acts_intern(r->acts, arg.value, arg.value_len));
	}
	if (own)
		freeze_many(r, false);
}

/* ---- boxes ---- */

/* Does an input that is written at the box, from @from on, name a part of the block? */
static bool reads_itself(struct rungs *r, const struct call *call, int from, uint32_t instance)
{
	const struct meaning *whole = acts_meaning(r->acts, instance);

	for (int i = from; whole && i < call->count; i++) {
		const struct term *value = call->arg[i].value;
		const struct meaning *m;

		while (value && value->kind == TERM_NOT)
			value = value->part[0];
		m = value && value->kind == TERM_NAME ? acts_meaning(r->acts, value->text) : NULL;
		if (m && m->kind != MEANING_LITERAL && m->var == whole->var)
			return true;
	}
	return false;
}

static uint32_t pin_name(struct rungs *r, uint32_t instance, const char *pin)
{
	char name[2 * LIMIT_NAME + 8];

	snprintf(name, sizeof(name), "%s.%s", text_of(r, instance), pin);
	return acts_intern(r->acts, name, strlen(name));
}

static bool is_part(struct rungs *r, uint32_t place)
{
	const struct meaning *m = acts_meaning(r->acts, place);

	return m && m->part;
}

static void feed(struct rungs *r, uint32_t instance, const char *pin, const struct term *value)
{
	struct act *act = acts_add(r->acts, ACT_STORE);

	act->target = pin_name(r, instance, pin);
	act->value = value;
}

/* Elements that may not exist are read first; without one of them the block is not called. */
static void fetch_inputs(struct rungs *r, int element, struct call *call, int from, const struct term **there)
{
	const struct word_row *row = row_of(r, element);

	for (int i = from; i < call->count; i++) {
		struct act_arg *arg = &call->arg[i];
		const bool inverse = arg->value && arg->value->kind == TERM_NOT;
		const struct term *name = inverse ? arg->value->part[0] : arg->value, *value;
		const char *text = text_of(r, arg->pin);
		const int pin = word_pin_find(row, text, strlen(text));
		const struct meaning *m = name && name->kind == TERM_NAME ? acts_meaning(r->acts, name->text)
									 : NULL;

		if (!m || (!m->opens && !m->through))
			continue;
		if (meaning_is_whole(m) || m->type == IEC_STRING) {
			refuse(r, element, DIAG_CONVERT_INPUT, text_of(r, name->text));
			return;
		}
		value = fetch(r, name->text, there);
		if (pin < 0 || pin >= row->pin_count || row->pin[pin].dir != PIN_IN_OUT)
			arg->value = inverse ? term_not(r->acts, value) : value;
	}
}

/* Bits of numbers get the outputs behind the call. */
static void store_parts(struct rungs *r, const struct call *call, uint32_t instance, const struct term *when)
{
	for (int i = 0; i < call->count; i++) {
		const struct act_arg *arg = &call->arg[i];
		struct act *act;

		if (arg->value || !is_part(r, arg->place))
			continue;
		act = acts_add(r->acts, ACT_STORE);
		act->target = arg->place;
		act->when = when;
		act->value = term_name(r->acts, pin_name(r, instance, text_of(r, arg->pin)));
	}
}

/* The call itself. The first @fed arguments have been stored already. */
static void call_block(struct rungs *r, int element, const struct call *call, int fed, const struct term *when)
{
	struct acts *acts = r->acts;
	const uint32_t instance = cell_of(r, element)->operand;
	struct call *given = call_new(r);
	uint32_t *write = NULL;
	struct act *act;
	int writes = 0;

	for (int i = fed; i < call->count; i++)
		if (call->arg[i].value || !is_part(r, call->arg[i].place))
			given->arg[given->count++] = call->arg[i];
	add_read(acts, &write, &writes, instance);
	act = acts_add(acts, ACT_CALL);
	act->text = instance;
	act->when = unless_true(when);
	act->write = write;
	act->writes = writes;
	act->writes_globals = word_is_own((enum word)r->network.element[element].word);
	put_args(r, given, act);
	if (act->writes_globals)
		add_in_outs(r, act);
	store_parts(r, call, instance, unless_true(when));
}

static void box_block(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	const struct network_element *at = &r->network.element[element];
	const struct word_row *row = row_of(r, element);
	const uint32_t instance = cell_of(r, element)->operand;
	const int first = word_first_bool(row, PIN_IN), power = word_first_bool(row, PIN_OUT);
	const struct term *when = term_true(acts), *there = NULL;
	struct element *e = &r->element[element];
	struct call *call = call_new(r);
	int fed = at->pins + (first >= 0);

	freeze(r, instance);
	freeze_written(r, element);
	if (first >= 0)
		add_arg(r, call, acts_intern(acts, row->pin[first].name, strlen(row->pin[first].name)),
			power_in(r, at->in), 0);
	else
		when = power_in(r, at->in);
	take_args(r, element, call, false);
	if (call->fails || reads_itself(r, call, fed, instance)) {
		for (int i = 0; i < fed; i++)
			feed(r, instance, text_of(r, call->arg[i].pin), call->arg[i].value);
		fetch_inputs(r, element, call, fed, &there);
	} else {
		fed = 0;
	}
	if (there)
		when = term_both(acts, TERM_AND, when, there);
	call_block(r, element, call, fed, when);
	e->leaf = there ? there : term_true(acts);
	if (power < 0)
		return;
	e->leaf = term_both(acts, TERM_AND, e->leaf,
			    term_name(acts, pin_name(r, instance, row->pin[power].name)));
	e->powered = true;
}

/* A function as a value, where nothing can fail. */
static const struct term *call_term(struct rungs *r, uint32_t name, const struct call *call)
{
	struct acts *acts = r->acts;
	struct term *term = arena_alloc(acts->arena, sizeof(*term));
	const struct term **part = arena_alloc(acts->arena, sizeof(*part) * (size_t)(call->count + 1));
	uint32_t *pin = arena_alloc(acts->arena, sizeof(*pin) * (size_t)(call->count + 1));

	if (!term || !part || !pin) {
		acts->failed = true;
		return term_true(acts);
	}
	for (int i = 0; i < call->count; i++) {
		part[i] = call->arg[i].value;
		pin[i] = call->arg[i].pin;
	}
	*term = (struct term){ .kind = TERM_CALL, .level = LEVEL_NAME, .temp = -1, .text = name,
			       .part = part, .pin = pin, .parts = call->count };
	return term;
}

static bool are_bits(struct rungs *r, const struct call *call)
{
	bool seen = false;

	for (int i = 0; i < call->count; i++) {
		const struct term *value = call->arg[i].value;
		const struct meaning *m = value->kind == TERM_NAME ? acts_meaning(r->acts, value->text)
								  : NULL;

		seen |= !m || m->type == IEC_BOOL;
		if (m && m->type != IEC_BOOL && (m->type != IEC_NONE || m->kind != MEANING_LITERAL))
			return false;
	}
	return seen;
}

/* AND OR XOR NOT of BOOLs. */
static const struct term *logic_term(struct rungs *r, enum word word, const struct call *call)
{
	const enum term_kind kind = word == FN_AND ? TERM_AND : word == FN_OR ? TERM_OR : TERM_XOR;
	const struct term *term = call->arg[0].value;

	for (int i = 1; i < call->count; i++)
		term = term_both(r->acts, kind, term, call->arg[i].value);
	return term;
}

static bool stores_all(struct rungs *r, uint32_t target)
{
	const struct meaning *m = acts_meaning(r->acts, target);

	return m && !meaning_is_checked(m) && !meaning_is_whole(m) && m->type != IEC_STRING;
}

static bool is_fixed_whole(struct rungs *r, uint32_t target)
{
	const struct meaning *m = acts_meaning(r->acts, target);

	return m && meaning_is_whole(m) && !meaning_is_indexed(m);
}

/* Arguments in the order of the pins, so that pins of branches stand where a person writes them. */
static void sort_args(const struct rungs *r, int element, struct call *call)
{
	const struct word_row *row = row_of(r, element);

	for (int i = 1; i < call->count; i++)
		for (int k = i; k > 0; k--) {
			const char *a = text_of(r, call->arg[k - 1].pin), *b = text_of(r, call->arg[k].pin);
			const struct act_arg one = call->arg[k];

			if (!call->arg[k - 1].value || !one.value ||
			    word_pin_find(row, a, strlen(a)) <= word_pin_find(row, b, strlen(b)))
				break;
			call->arg[k] = call->arg[k - 1];
			call->arg[k - 1] = one;
		}
}

/* ENO => Place: the power behind the box. */
static void store_eno(struct rungs *r, uint32_t place, const struct term *power)
{
	struct act *act;

	if (!place)
		return;
	act = acts_add(r->acts, ACT_STORE);
	act->target = place;
	act->value = power;
}

/* A function that always succeeds. @value: its result. */
static void box_sure(struct rungs *r, int element, const struct call *call, const struct term *value,
		     bool gates)
{
	const struct term *in = power_in(r, r->network.element[element].in);
	struct element *e = &r->element[element];
	struct act *act;

	e->leaf = gates ? value : term_true(r->acts);
	if (call->out) {
		act = acts_add(r->acts, ACT_STORE);
		act->target = call->out;
		act->value = value;
		act->when = unless_true(in);
		if (gates)
			e->leaf = term_name(r->acts, call->out);
	}
	store_eno(r, call->eno, in);
}

/* A function that may fail, and a condition of power alone: IF in AND_THEN F(…). */
static void box_test(struct rungs *r, int element, const struct call *call)
{
	const struct network_element *at = &r->network.element[element];
	const struct word_row *row = row_of(r, element);
	const struct term *in = power_in(r, at->in);
	const struct term *value = row == word_row(FN_NOT) ? call->arg[0].value :
		call_term(r, acts_intern(r->acts, row->word, strlen(row->word)), call);
	const int temp = acts_temp(r->acts, IEC_BOOL, r->number);
	struct act *act = acts_add(r->acts, ACT_TEST);

	act->temp = temp;
	act->when = unless_true(in);
	act->value = value;
	act->fails = true;
	r->element[element].leaf = term_temp(r->acts, temp);
	r->element[element].powered = true;
}

/* Stores a result where it may not fit, while @when. Returns whether it was stored. */
static const struct term *store_aside(struct rungs *r, uint32_t target, const struct term *when, int result)
{
	struct acts *acts = r->acts;
	const int stored = acts_temp(acts, IEC_BOOL, r->number);
	struct call *call = call_new(r);
	struct act *act;

	store_false(r, stored);
	add_arg(r, call, acts_intern(acts, "IN", 2), term_temp(acts, result), 0);
	add_arg(r, call, acts_intern(acts, "ENO", 3), NULL, 0);
	call->arg[1].temp = stored;
	act = acts_add(acts, ACT_CALL);
	act->text = acts_intern(acts, "MOVE", 4);
	act->target = target;
	act->when = when;
	act->fails = true;
	put_args(r, call, act);
	return term_temp(acts, stored);
}

/* A call that tells whether it succeeded: x := F(EN := power, …, ENO => temporary). */
static void box_call(struct rungs *r, int element, struct call *call, bool gates)
{
	struct acts *acts = r->acts;
	const struct network_element *at = &r->network.element[element];
	const struct word_row *row = row_of(r, element);
	const bool needs = !is_unread(r, element) || call->eno || (gates && !call->out);
	const struct term *in = power_in(r, at->in);
	const bool inside = (!needs && !acts->networks) || call->fails; /* IF around it instead of EN */
	const bool aside = gates && (!call->out || (needs && !stores_all(r, call->out)));
	struct element *e = &r->element[element];
	int eno = -1, result = -1;
	struct call *with = call_new(r);
	struct act *act;

	if (needs)
		eno = acts_temp(acts, IEC_BOOL, r->number);
	if (needs && aside)
		result = acts_temp(acts, IEC_BOOL, r->number);
	if (needs && inside)
		store_false(r, eno);
	if (!inside && in->kind != TERM_TRUE)
		add_arg(r, with, acts_intern(acts, "EN", 2), in, 0);
	for (int i = 0; i < call->count; i++)
		add_arg(r, with, call->arg[i].pin, call->arg[i].value, call->arg[i].place);
	if (needs) {
		add_arg(r, with, acts_intern(acts, "ENO", 3), NULL, 0);
		with->arg[with->count - 1].temp = eno;
	}
	act = acts_add(acts, ACT_CALL);
	act->text = at->word == FN_NOT ? acts_intern(acts, "MOVE", 4) :
		    acts_intern(acts, row->word, strlen(row->word));
	act->when = inside && in->kind != TERM_TRUE ? in : NULL;
	act->fails = call->fails;
	act->target = aside ? 0 : call->out;
	act->temp = result;
	act->writes_globals = word_is_own((enum word)at->word);
	put_args(r, with, act);
	if (act->writes_globals)
		add_in_outs(r, act);
	e->powered = true;
	e->leaf = needs ? term_temp(acts, eno) : in;
	if (aside && call->out)
		e->leaf = store_aside(r, call->out, e->leaf, result);
	store_eno(r, call->eno, e->leaf);
	if (needs && gates)
		e->leaf = term_both(acts, TERM_AND, e->leaf,
				    aside ? term_temp(acts, result) : term_name(acts, call->out));
}

static void box_function(struct rungs *r, int element)
{
	const enum word word = (enum word)r->network.element[element].word;
	const struct word_row *row = row_of(r, element);
	struct call *call = call_new(r);
	bool bits, gates;

	freeze_written(r, element);
	take_args(r, element, call, true);
	sort_args(r, element, call);
	bits = row->result == (int)RESULT_GATE && are_bits(r, call);
	if (word == FN_NOT && call->count)
		call->arg[0].value = term_not(r->acts, call->arg[0].value);
	gates = word_is_test(row) || bits;
	if (word == FN_MOVE && call->count == 1 && !call->fails && call->out &&
	    (stores_all(r, call->out) || is_fixed_whole(r, call->out)))
		box_sure(r, element, call, call->arg[0].value, false);
	else if (row->result == (int)RESULT_GATE && word_operator(row) != OP_COUNT && !call->fails &&
		 (!call->out || stores_all(r, call->out)))
		box_sure(r, element, call, logic_term(r, word, call), bits);
	else if (word >= FN_GT && word <= FN_NE && !call->fails && call->count == 2 &&
		 (!call->out || stores_all(r, call->out)))
		box_sure(r, element, call,
			 call_term(r, acts_intern(r->acts, row->word, strlen(row->word)), call), true);
	else if (gates && !call->out && !call->eno && call->count == call->inputs && !word_is_own(word))
		box_test(r, element, call);
	else
		box_call(r, element, call, gates);
}

/* ---- [ … ] ---- */

static void compare(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	struct element *e = &r->element[element];
	const struct term *in;
	struct words words;
	struct act *act;
	const char *text;
	size_t len;
	int temp;

	e->leaf = term_true(acts);
	if (!parse(r, element, &text, &len))
		return;
	words = look_at(r, text, len);
	if (!words.fails) {
		e->leaf = words.term;
		return;
	}
	if (words.own)
		freeze_many(r, true);
	in = power_in(r, r->network.element[element].in);
	temp = acts_temp(acts, IEC_BOOL, r->number);
	act = acts_add(acts, ACT_TEST);
	act->temp = temp;
	act->when = unless_true(in);
	act->value = words.term;
	act->writes_any = words.own;
	act->fails = true;
	e->leaf = term_temp(acts, temp);
	e->powered = true;
}

/* The text behind the first := outside of brackets. */
static const char *behind_store(const char *text, size_t len)
{
	struct lex lex;
	int open = 0;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		if (open == 0 && lex_is(&lex, ":=")) {
			lex_next(&lex);
			return lex.token.kind == TOKEN_END ? NULL : lex.token.text;
		}
	}
	return NULL;
}

/* The operator of the root, which is the last of its kind outside of brackets; NULL: not found. @len: gets
 * its length. */
static const char *root_operator(const struct expr *expr, const char *text, size_t size, size_t *len)
{
	static const struct { enum word fn; const char *sign; } signs[] = {
		{ FN_ADD, "+" }, { FN_SUB, "-" }, { FN_MUL, "*" }, { FN_DIV, "/" }, { FN_MOD, "MOD" },
		{ FN_EXPT, "**" },
	};
	const enum word fn = expr->node[expr->root].fn;
	const char *found = NULL;
	bool operand = false;
	struct lex lex;
	int open = 0;

	lex_init(&lex, text, size);
	while (lex_next(&lex) != TOKEN_END) {
		const bool symbol = lex.token.kind == TOKEN_SYMBOL;

		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		for (size_t i = 0; open == 0 && operand && i < sizeof(signs) / sizeof(*signs); i++)
			if (signs[i].fn == fn && lex_is(&lex, signs[i].sign)) {
				found = lex.token.text;
				*len = lex.token.len;
			}
		operand = !symbol || lex_is(&lex, ")") || lex_is(&lex, "]") || lex_is(&lex, "^");
		if (found == lex.token.text)
			operand = false;
	}
	return found;
}

/* `( a + b )` without its parentheses. */
static void strip(const char **text, size_t *len)
{
	for (;;) {
		struct lex lex;
		int open = 0;

		lex_init(&lex, *text, *len);
		if (lex_next(&lex) == TOKEN_END || !lex_is(&lex, "("))
			return;
		for (open = 1; open > 0 && lex_next(&lex) != TOKEN_END;) {
			open += lex_is(&lex, "(");
			open -= lex_is(&lex, ")");
		}
		if (open > 0 || lex.token.text + 1 != *text + *len)
			return;
		++*text;
		*len -= 2;
		while (*len && **text == ' ') {
			++*text;
			--*len;
		}
		while (*len && (*text)[*len - 1] == ' ')
			--*len;
	}
}

static const struct term *part_term(struct rungs *r, const char *text, size_t len, bool any)
{
	struct term *term;

	while (len && *text == ' ') {
		text++;
		len--;
	}
	while (len && text[len - 1] == ' ')
		len--;
	term = (struct term *)term_words(r->acts, LEVEL_NAME, text, len);
	term->reads_any = any;
	return term;
}

/* The call that computes an expression and tells whether it could: its last function as a call, so that it
 * stores as the box does. */
static void expression_call(struct rungs *r, const char *text, size_t len, struct call *call,
			    uint32_t *name)
{
	const struct expr *expr = r->acts->expr;
	const struct expr_node *root = &expr->node[expr->root];
	const char *sign = NULL;
	size_t sign_len = 0;

	strip(&text, &len);
	*name = acts_intern(r->acts, "MOVE", 4);
	if (root->op == EXPR_FN)
		sign = root_operator(expr, text, len, &sign_len);
	if (root->op == EXPR_CALL && text[len - 1] == ')') {
		const char *open = memchr(text, '(', len);

		*name = acts_intern(r->acts, text, (size_t)(open - text));
		add_arg(r, call, 0, part_term(r, open + 1, (size_t)(text + len - open) - 2, true), 0);
		return;
	}
	if (root->op == EXPR_NEG && *text == '-') {
		*name = acts_intern(r->acts, "NEG", 3);
		add_arg(r, call, acts_intern(r->acts, "IN", 2), part_term(r, text + 1, len - 1, true), 0);
	} else if (sign) {
		const struct word_row *row = word_row(root->fn);
		const size_t left = (size_t)(sign - text);

		*name = acts_intern(r->acts, row->word, strlen(row->word));
		add_arg(r, call, acts_intern(r->acts, "IN1", 3), part_term(r, text, left, true), 0);
		add_arg(r, call, acts_intern(r->acts, "IN2", 3),
			part_term(r, sign + sign_len, len - left - sign_len, true), 0);
	} else {
		add_arg(r, call, acts_intern(r->acts, "IN", 2), part_term(r, text, len, true), 0);
	}
}

/* x := expression, whose success is power, if an element behind it reads it. @inside: it stands inside an IF,
 * because its arguments may fail and are then not computed without power. */
static void assign_call(struct rungs *r, int element, uint32_t target, const char *text, size_t len,
			bool own, bool inside)
{
	struct acts *acts = r->acts;
	const struct term *in = power_in(r, r->network.element[element].in);
	const int eno = is_unread(r, element) ? -1 : acts_temp(acts, IEC_BOOL, r->number);
	struct element *e = &r->element[element];
	struct call *call = call_new(r);
	struct act *act;
	uint32_t name;

	if (!inside && in->kind != TERM_TRUE)
		add_arg(r, call, acts_intern(acts, "EN", 2), in, 0);
	expression_call(r, text, len, call, &name);
	if (eno >= 0) {
		add_arg(r, call, acts_intern(acts, "ENO", 3), NULL, 0);
		call->arg[call->count - 1].temp = eno;
	}
	if (inside && eno >= 0)
		store_false(r, eno);
	act = acts_add(acts, ACT_CALL);
	act->text = name;
	act->target = target;
	act->when = inside ? unless_true(in) : NULL;
	act->writes_any = own;
	act->fails = inside;
	put_args(r, call, act);
	e->leaf = eno >= 0 ? term_temp(acts, eno) : in;
	e->powered = true;
}

static bool stores_simply(struct rungs *r, uint32_t target)
{
	const struct meaning *m = acts_meaning(r->acts, target);

	return m && !meaning_is_indexed(m);
}

/* Pointer REF= place, Pointer ?= reference. */
static void assign_pointer(struct rungs *r, int element, const char *text, size_t len)
{
	const struct term *in;
	struct act *act;

	if (!is_unread(r, element)) {
		refuse(r, element, DIAG_CONVERT_POWER, text);
		return;
	}
	freeze_many(r, true);
	in = power_in(r, r->network.element[element].in);
	act = acts_add(r->acts, ACT_WORDS);
	act->text = acts_intern(r->acts, text, len);
	act->when = unless_true(in);
	act->writes_any = true;
}

static void assign(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	const struct expr *expr = acts->expr;
	struct element *e = &r->element[element];
	const struct term *in;
	const char *text, *value;
	struct words words;
	struct act *act;
	uint32_t target;
	bool sure, open, inside;
	size_t len, n;

	e->leaf = term_true(acts);
	if (!parse(r, element, &text, &len))
		return;
	value = behind_store(text, len);
	if (!value || expr->target_points || expr->target_tried) {
		assign_pointer(r, element, text, len);
		return;
	}
	len -= (size_t)(value - text);
	words = look_at(r, value, len);
	for (n = (size_t)(value - text); n > 0 && strchr(" :=", text[n - 1]); n--)
		;
	target = acts_intern(acts, text, n); /* with its indices, as it is written */
	open = expr->target_index >= 0 || expr->target_bit.len || !acts_meaning(acts, target) ||
	       acts_meaning(acts, target)->through;
	sure = !words.fails && !open && stores_all(r, target);
	if (words.own || open)
		freeze_many(r, true);
	else
		freeze(r, target);
	inside = words.own || words.inner || open || !stores_simply(r, target);
	in = power_in(r, r->network.element[element].in);
	if (!sure && (!is_unread(r, element) || (acts->networks && !inside && in->kind != TERM_TRUE))) {
		assign_call(r, element, target, value, len, words.own || open, inside);
		return;
	}
	act = acts_add(acts, ACT_STORE);
	act->target = target;
	act->value = words.term;
	act->when = unless_true(in);
	act->writes_any = words.own || open;
	act->fails = !sure;
	e->leaf = in;
	e->powered = true;
}

/* ---- subroutines, statements ---- */

static void routine(struct rungs *r, int element)
{
	const struct term *in;
	struct act *act;

	freeze_many(r, false);
	in = power_in(r, r->network.element[element].in);
	if (in->kind != TERM_TRUE && term_size(r->acts, in) > 1 && !is_unread(r, element))
		in = keep(r, in);
	act = acts_add(r->acts, ACT_CALL);
	act->text = cell_of(r, element)->operand;
	act->when = unless_true(in);
	act->writes_globals = true;
	r->element[element].leaf = in;
	r->element[element].powered = true;
}

static uint32_t jump_text(struct rungs *r, uint32_t label)
{
	char text[LIMIT_NAME + 8];

	snprintf(text, sizeof(text), "JMP %.*s", LIMIT_NAME, text_of(r, label));
	return acts_intern(r->acts, text, strlen(text));
}

/* Does the item, a JMP or a label, name @label? */
static bool names_label(struct rungs *r, const struct st_item *item, uint32_t label)
{
	const struct names *names = &r->acts->project->names;
	const struct token token = st_label_name(names, item);

	return names_fold(names, acts_intern(r->acts, token.text, token.len)) == names_fold(names, label);
}

/* Is there a label of this name in another place of the body? @box: in a box that may not have been seen. */
static bool label_is_taken(struct rungs *r, uint32_t label, bool box)
{
	const struct names *names = &r->acts->project->names;
	const struct st *st = r->acts->pou->st;

	for (int i = 0; box && st && i < st->count; i++)
		if (st->item[i].kind == ST_LABEL && names_label(r, &st->item[i], label))
			return true;

	for (int i = 0; i < r->acts->pou->rung_count; i++)
		if (r->acts->pou->rung[i]->label &&
		    names_fold(names, r->acts->pou->rung[i]->label) == names_fold(names, label))
			return true;
	for (int i = 0; i < r->labels; i++)
		if (r->label[i] == names_fold(names, label))
			return true;
	return false;
}

static uint32_t label_new(struct rungs *r, const char *text)
{
	char name[LIMIT_NAME + 16];
	uint32_t id = acts_intern(r->acts, text, strlen(text));

	for (int n = 2; id && label_is_taken(r, id, n > 2); n++) {
		snprintf(name, sizeof(name), "%.*s_%d", LIMIT_NAME - 8, text, n);
		id = acts_intern(r->acts, name, strlen(name));
	}
	add_read(r->acts, &r->label, &r->labels, names_fold(&r->acts->project->names, id));
	return id;
}

/* The statements of a box, whose labels become those of the body; a RETURN leads to @end. */
static struct st_item *box_items(struct rungs *r, const struct boxed *boxed, uint32_t *end)
{
	const struct names *names = &r->acts->project->names;
	struct st_item *item = arena_alloc(r->acts->arena, sizeof(*item) * (size_t)(boxed->count + 1));
	char name[32];

	for (int i = 0; item && i < boxed->count; i++)
		item[i] = r->acts->pou->st->item[boxed->first + i];
	for (int i = 0; item && i < boxed->count; i++) {
		const uint32_t was = item[i].text;
		uint32_t is;

		if (item[i].kind == ST_RETURN && !*end) {
			snprintf(name, sizeof(name), "Rung%d_end", r->number + 1);
			*end = label_new(r, name);
		}
		if (item[i].kind == ST_RETURN)
			item[i] = (struct st_item){ .kind = ST_JUMP, .text = jump_text(r, *end), .depth = item[i].depth };
		if (item[i].kind != ST_LABEL)
			continue;
		is = label_new(r, names_text(names, was));
		for (int k = 0; k < boxed->count; k++)
			if (item[k].kind == ST_LABEL && names_label(r, &item[k], was))
				item[k].text = is;
			else if (item[k].kind == ST_JUMP && names_label(r, &item[k], was))
				item[k].text = jump_text(r, is);
	}
	r->acts->failed |= !item;
	return item;
}

/* A name or a constant, perhaps with a sign: it can always be computed. @name: gets the name; "": it is none. */
static bool is_plain(const char *text, size_t len, struct token *name)
{
	struct lex lex;

	lex_init(&lex, text, len);
	lex_next(&lex);
	if (lex_is(&lex, "-") || lex_is(&lex, "+"))
		lex_next(&lex);
	*name = lex.token;
	if (lex.token.kind != TOKEN_NAME)
		name->len = 0;
	if (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_NUMBER)
		return false;
	lex_next(&lex);
	return lex.token.kind == TOKEN_END;
}

/* Do the statements of the block that begins with item @at leave the variable @name alone? */
static bool is_left_alone(const struct rungs *r, const struct boxed *boxed, int at, const struct token *name)
{
	const struct st_item *item = r->acts->pou->st->item + boxed->first;

	for (int i = at + 1; name->len && i < boxed->count && item[i].depth > item[at].depth; i++)
		if (item[i].kind != ST_COMMENT && text_may_write(r->acts, text_of(r, item[i].text), name))
			return false;
	return true;
}

/* Does the loop itself write the variable @name? */
static bool counts_in(const struct rungs *r, const struct loop *loop, const struct token *name)
{
	char text[2 * LIMIT_NAME];
	const int len = snprintf(text, sizeof(text), "%.*s := 0", (int)loop->variable.len, loop->variable.text);

	return len < 0 || len >= (int)sizeof(text) || text_may_write(r->acts, text, name);
}

/* `FOR i := from TO to BY by`: may its bounds be looked at in each round? */
static bool may_jump_for(struct rungs *r, const struct boxed *boxed, int at)
{
	const char *text = text_of(r, r->acts->pou->st->item[boxed->first + at].text);
	const struct meaning *variable;
	struct token to, name;
	struct loop loop;

	if (!loop_parse(text + strlen("FOR"), strlen(text) - strlen("FOR"), &loop))
		return false;
	variable = acts_meaning(r->acts, acts_intern(r->acts, loop.variable.text, loop.variable.len));
	if (!variable || !(iec_type_row(variable->type)->class & ANY_INT) || iec_is_wide(variable->type) ||
	    meaning_is_ranged(variable) || loop.step > INT8_MAX || loop.step < -INT8_MAX)
		return false;
	if (memchr(loop.variable.text, '[', loop.variable.len) || loop.step == 0 ||
	    !is_plain(loop.from.text, loop.from.len, &name) || !is_plain(loop.to.text, loop.to.len, &to))
		return false;
	return (!to.len || !counts_in(r, &loop, &to)) && is_left_alone(r, boxed, at, &to);
}

static bool may_jump(struct rungs *r, const struct boxed *boxed, int at)
{
	const struct st_item *item = &r->acts->pou->st->item[boxed->first + at];
	const char *text = text_of(r, item->text);
	struct token name;

	if (item->kind == ST_CASE)
		return is_plain(text + strlen("CASE"), strlen(text) - strlen("CASE"), &name);
	return item->kind != ST_FOR || may_jump_for(r, boxed, at);
}

/* Of a FOR nobody sees the bound that it keeps, of a CASE the selector, if it is no plain one. */
static void refuse_blocks(struct rungs *r, int element, const struct boxed *boxed)
{
	for (int i = 0; i < boxed->count; i++) {
		const enum st_kind kind = (enum st_kind)r->acts->pou->st->item[boxed->first + i].kind;

		if (!may_jump(r, boxed, i)) {
			refuse_word(r, element, st_form(kind)->word);
			return;
		}
	}
}

static void execute(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	const struct network_element *at = &r->network.element[element];
	const struct boxed *boxed = pou_boxed(acts->pou, r->number, at->row, at->col);
	struct st_item *item = NULL;
	const struct term *in;
	uint32_t end = 0;
	struct act *act;

	freeze_many(r, true);
	in = power_in(r, at->in);
	if (boxed && acts->networks)
		refuse_blocks(r, element, boxed);
	if (boxed)
		item = box_items(r, boxed, &end);
	act = acts_add(acts, ACT_LINES);
	act->when = unless_true(in);
	act->item = item;
	act->items = item ? boxed->count : 0;
	act->writes_any = true;
	if (end) {
		act = acts_add(acts, ACT_LABEL);
		act->text = end;
	}
	r->element[element].leaf = in;
	r->element[element].powered = true;
}

/* ---- contacts ---- */

/* Start_rises, of an operand; "Rung3_edge" if that is no plain name. */
static void edge_name(const struct rungs *r, uint32_t operand, bool rising, char *name, size_t size)
{
	const char *text = text_of(r, operand);

	if (strpbrk(text, ".%[^#'\" ") || ascii_is("SYS_", text, 4))
		snprintf(name, size, "Rung%d_edge", r->number + 1);
	else
		snprintf(name, size, "%.*s_%s", LIMIT_NAME - 20, text, rising ? "rises" : "falls");
}

static uint32_t edge_instance(struct rungs *r, uint32_t operand, bool rising)
{
	struct acts *acts = r->acts;
	char name[LIMIT_NAME + 32];
	struct act_edge *edge;
	uint32_t id;

	edge_name(r, operand, rising, name, sizeof(name));
	id = acts_name(acts, name);
	edge = arena_push(acts->arena, &acts->edge, &acts->edges, sizeof(*edge));
	if (!edge) {
		acts->failed = true;
		return id;
	}
	*edge = (struct act_edge){ .name = id, .rising = rising };
	return id;
}

/* Of networks: R_EDGE(value) in a wire. */
static const struct term *edge_value(struct rungs *r, int element, const struct term *value)
{
	const bool rising = row_of(r, element)->edge == EDGE_RISING;
	const struct term *kept = keep(r, term_edge(r->acts, value, rising));
	char name[LIMIT_NAME + 32];

	edge_name(r, cell_of(r, element)->operand, rising, name, sizeof(name));
	if (kept->temp >= 0)
		r->acts->temp[kept->temp].wish = acts_intern(r->acts, name, strlen(name));
	return kept;
}

/* Calls the instance of an edge with @value, while @when; gives its Q. */
static const struct term *edge_call(struct rungs *r, int element, const struct term *value,
				    const struct term *when)
{
	struct acts *acts = r->acts;
	struct call *call;
	char name[LIMIT_NAME + 8];
	struct act *act;
	uint32_t id;

	if (acts->networks && !when)
		return edge_value(r, element, value);
	call = call_new(r);
	id = edge_instance(r, cell_of(r, element)->operand, row_of(r, element)->edge == EDGE_RISING);
	add_arg(r, call, acts_intern(acts, "CLK", 3), value, 0);
	act = acts_add(acts, ACT_CALL);
	act->text = id;
	act->when = when;
	put_args(r, call, act);
	snprintf(name, sizeof(name), "%.*s.Q", LIMIT_NAME, text_of(r, id));
	return term_words(acts, LEVEL_NAME, name, strlen(name));
}

/* A contact of an element that may not exist passes no power then, also a closed one. */
static void open_contact(struct rungs *r, int element, const struct term *value)
{
	const struct term *in = power_in(r, r->network.element[element].in);
	const int temp = acts_temp(r->acts, IEC_BOOL, r->number);
	struct act *act = acts_add(r->acts, ACT_TEST);

	act->temp = temp;
	act->when = unless_true(in);
	act->value = value;
	r->element[element].leaf = term_temp(r->acts, temp);
	r->element[element].powered = true;
}

/* The memory of the edge stays while there is no such element. */
static void open_edge(struct rungs *r, int element, uint32_t operand)
{
	const struct term *there = NULL, *value = fetch(r, operand, &there);

	r->element[element].leaf = term_both(r->acts, TERM_AND, there,
					     edge_call(r, element, value, there));
}

static void contact(struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);
	const uint32_t operand = cell_of(r, element)->operand;
	const struct meaning *m = acts_meaning(r->acts, operand);
	const struct term *value = term_name(r->acts, operand);
	const bool open = m && (m->opens || m->through);

	if (row->edge != EDGE_NONE && open)
		open_edge(r, element, operand);
	else if (row->edge != EDGE_NONE)
		r->element[element].leaf = edge_call(r, element, value, NULL);
	else if (open)
		open_contact(r, element, row->negate ? term_not(r->acts, value) : value);
	else
		r->element[element].leaf = row->negate ? term_not(r->acts, value) : value;
}

/* ---- phase 1 ---- */

static void evaluate(struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);
	struct element *e = &r->element[element];

	if (is_actor(r, element)) {
		if (row->operand == OPND_BOOL_W && !is_unread(r, element)) {
			e->leaf = power_in(r, r->network.element[element].in);
			e->powered = true;
		}
		return;
	}
	if (row->kind != WORD_ELEM && row->kind == WORD_FB)
		box_block(r, element);
	else if (row->kind != WORD_ELEM)
		box_function(r, element);
	else if (row->operand == OPND_EXPR)
		compare(r, element);
	else if (row->operand == OPND_ASSIGN)
		assign(r, element);
	else if (row->operand == OPND_ROUTINE)
		routine(r, element);
	else if (row->operand == OPND_EXECUTE)
		execute(r, element);
	else if (row->operand != OPND_NONE)
		contact(r, element);
}

static void visit(struct rungs *r, int element);

static void visit_net(struct rungs *r, int net)
{
	const struct network *n = &r->network;

	if (net == NET_RAIL || r->net[net].seen)
		return;
	r->net[net].seen = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		visit(r, n->feeder[i]);
}

/* An element leads right, so at most LIMIT_COLS of them nest. */
static void visit(struct rungs *r, int element)
{
	const struct network_element *at = &r->network.element[element];

	if (r->element[element].seen)
		return;
	r->element[element].seen = true;
	visit_net(r, at->in);
	for (int i = 0; i < at->pins; i++)
		visit_net(r, r->network.pin[at->first_pin + i].in);
	evaluate(r, element);
}

/* ---- phase 2 ---- */

static void coil(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	const struct word_row *row = row_of(r, element);
	const uint32_t operand = cell_of(r, element)->operand;
	const struct term *in = power_in(r, r->network.element[element].in);
	const bool latch = row->first == OP_S || row->first == OP_R;
	struct act *act;

	if (row->edge != EDGE_NONE)
		in = edge_call(r, element, in, NULL);
	freeze(r, operand);
	if (row->edge == EDGE_NONE)
		in = power_in(r, r->network.element[element].in);
	act = acts_add(acts, ACT_STORE);
	act->target = operand;
	act->value = row->negate ? term_not(acts, in) : in;
	if (!latch)
		return;
	act->when = unless_true(in);
	act->value = row->first == OP_S ? term_true(acts) : term_words(acts, LEVEL_NAME, "FALSE", 5);
}

static void flow(struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);
	const struct term *in = power_in(r, r->network.element[element].in);
	const bool jump = row->operand == OPND_LABEL, stop = !jump && row->first == OP_STP;
	struct act *act;

	if (stop && !r->acts->networks)
		refuse_word(r, element, row->word);
	act = acts_add(r->acts, jump ? ACT_JUMP : stop ? ACT_STOP : ACT_RETURN);
	act->text = jump ? cell_of(r, element)->operand : 0;
	act->when = unless_true(in);
}

static uint32_t part_id(struct rungs *r, const struct loop_part *part)
{
	return part->text ? acts_intern(r->acts, part->text, part->len) : 0;
}

static void loop_begin(struct rungs *r, int element)
{
	struct acts *acts = r->acts;
	const uint32_t id = cell_of(r, element)->operand;
	const struct term *in = power_in(r, r->network.element[element].in);
	const struct meaning *variable, *to;
	struct act_loop *loop;
	struct loop text;
	struct act *act;

	if (r->loops == LIMIT_LOOPS || !loop_parse(text_of(r, id), names_len(&acts->project->names, id), &text))
		return;
	loop = &r->loop[r->loops++];
	*loop = (struct act_loop){ part_id(r, &text.variable), part_id(r, &text.from),
				   part_id(r, &text.to), part_id(r, &text.by), text.step < 0, false, -1, -1 };
	variable = acts_meaning(acts, loop->variable);
	to = acts_meaning(acts, loop->to);
	if (strpbrk(text_of(r, id), "[^"))
		refuse(r, element, DIAG_CONVERT_LOOP, text_of(r, loop->variable));
	loop->near = (text.step == 1 || text.step == -1) && variable && to &&
		     (to->type == variable->type || to->type == IEC_NONE);
	if (!loop->near && variable) {
		loop->next = acts_temp(acts, variable->type, r->number);
		loop->good = acts_temp(acts, IEC_BOOL, r->number);
		if (loop->good >= 0)
			acts->temp[loop->next].uses = acts->temp[loop->good].uses = 1;
	}
	act = acts_add(acts, ACT_LOOP);
	act->when = unless_true(in);
	act->loop = *loop;
}

static void loop_end(struct rungs *r)
{
	struct act *act;

	if (r->loops == 0)
		return;
	act = acts_add(r->acts, ACT_LOOP_END);
	act->loop = r->loop[--r->loops];
}

static void act_one(struct rungs *r, int element)
{
	const struct word_row *row = row_of(r, element);

	if (row->operand == OPND_ASSIGN)
		assign(r, element);
	else if (row->operand == OPND_ROUTINE)
		routine(r, element);
	else if (row->operand == OPND_EXECUTE)
		execute(r, element);
	else if (row->operand == OPND_LOOP)
		loop_begin(r, element);
	else if (row->operand == OPND_LOOP_END)
		loop_end(r);
	else if (row->operand == OPND_BOOL_W)
		coil(r, element);
	else
		flow(r, element);
}

/* ---- a rung ---- */

static void remark(struct rungs *r, const char *text, size_t len, bool apart)
{
	struct act *act = acts_add(r->acts, ACT_REMARK);

	act->text = acts_intern(r->acts, text, len);
	act->apart = apart;
}

/* `// ` before each line. */
static void remark_lines(struct rungs *r, const char *text, bool apart)
{
	while (*text) {
		const size_t len = strcspn(text, "\n");
		char *line = arena_alloc(r->scratch, len + 4);

		if (!line) {
			r->acts->failed = true;
			return;
		}
		snprintf(line, len + 4, "// %.*s", (int)len, text);
		remark(r, line, strlen(line), apart);
		apart = false;
		text += len + (text[len] == '\n');
	}
}

static bool is_target(const struct rungs *r, uint32_t label)
{
	const struct names *names = &r->acts->project->names;
	const struct pou *pou = r->acts->pou;

	for (int i = 0; i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; !rung->off && k < rung->rows * rung->cols; k++)
			if (word_row((enum word)rung->cell[k].word)->operand == OPND_LABEL &&
			    names_fold(names, rung->cell[k].operand) == names_fold(names, label))
				return true;
	}
	return false;
}

static void cell_remarks(struct rungs *r)
{
	const struct rung *rung = r->rung;

	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].comment)
			remark(r, text_of(r, rung->cell[i].comment),
			       names_len(&r->acts->project->names, rung->cell[i].comment), false);
}

static void head(struct rungs *r)
{
	const struct rung *rung = r->rung;
	bool apart = r->acts->count > 0;
	struct act *act;

	if (rung->off)
		return;
	if (r->acts->networks) {
		cell_remarks(r);
		return;
	}
	if (rung->comment) {
		remark(r, text_of(r, rung->comment), names_len(&r->acts->project->names, rung->comment), apart);
		apart = false;
	}
	if (rung->title)
		remark_lines(r, text_of(r, rung->title), apart);
	cell_remarks(r);
	if (!rung->label || !is_target(r, rung->label))
		return;
	act = acts_add(r->acts, ACT_LABEL);
	act->text = rung->label;
}

static void off(struct rungs *r)
{
	char *text = text_write_rung(r->acts->project, r->rung);

	if (text)
		remark_lines(r, text, r->acts->count > 0);
	else
		r->acts->failed = true;
	free(text);
}

static bool prepare(struct rungs *r)
{
	const struct network *n = &r->network;

	arena_reset(r->scratch);
	if (!network_make(r->rung, r->scratch, &r->network))
		return false;
	r->element = arena_alloc(r->scratch, ((size_t)n->element_count + 1) * sizeof(*r->element));
	r->net = arena_alloc(r->scratch, ((size_t)n->net_count + 1) * sizeof(*r->net));
	return r->element && r->net;
}

static bool is_output(const struct rungs *r, int element)
{
	return is_actor(r, element) ||
	       (row_of(r, element)->place == PLACE_BOX && is_unread(r, element));
}

static void one_rung(struct rungs *r)
{
	const struct network *n = &r->network;
	int *actor, count = 0;

	head(r);
	if (r->rung->off) {
		if (!r->acts->networks)
			off(r);
		return;
	}
	actor = prepare(r) ? arena_alloc(r->scratch, ((size_t)n->element_count + 1) * sizeof(*actor)) : NULL;
	if (!actor) {
		r->acts->failed = true;
		return;
	}
	for (int i = 0; i < n->element_count; i++) {
		if (!is_output(r, i))
			continue;
		visit(r, i);
		if (is_actor(r, i))
			actor[count++] = i;
	}
	for (int i = 0; i < count; i++)
		act_one(r, actor[i]);
}

bool ladder_acts(struct acts *acts)
{
	struct rungs *r = arena_alloc(acts->arena, sizeof(*r));
	struct arena scratch;

	if (r)
		r->ignored = arena_alloc(acts->arena, sizeof(*r->ignored));
	if (!r || !r->ignored) {
		acts->failed = true;
		return false;
	}
	arena_init(&scratch);
	r->acts = acts;
	r->scratch = &scratch;
	for (int i = 0; i < acts->pou->rung_count && !acts->failed; i++) {
		r->rung = acts->pou->rung[i];
		r->number = acts->rung = i;
		one_rung(r);
	}
	arena_free(&scratch);
	return !acts->failed && !acts->refused;
}
