/* SPDX-License-Identifier: MIT
 *
 * ld_box - functions and function blocks of a rung as calls in IL.
 */
#include "engine/translate/ladder_unit.h"

#include "engine/model/args.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

const struct word_row *ld_row(const struct ld *ld, enum word word)
{
	return words_row(&ld->translation->project->words, word);
}

void ld_call(struct ld *ld, enum word function)
{
	struct il_line line = { .kind = IL_CALL, .word = (uint16_t)function };

	ld_emit_line(ld, line);
}

void ld_arg(struct ld *ld, bool output, uint32_t pin, uint32_t operand)
{
	struct il_line line = {
		.kind = output ? IL_ARG_OUT : IL_ARG_IN,
		.pin = pin, .operand = operand,
	};

	ld_emit_line(ld, line);
}

static struct names *names_of(struct ld *ld)
{
	return &ld->translation->project->names;
}

static uint32_t intern(struct ld *ld, const char *text, size_t len)
{
	uint32_t id = names_intern(names_of(ld), text, len);

	if (!id && len)
		ld->failed = true;
	return id;
}

static const char *args_of(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];

	return names_text(names_of(ld),
			  rung_at(ld->rung, at->row, at->col)->args);
}

static bool is_pin(const struct arg *arg, const char *name)
{
	return arg->pin_len == strlen(name) &&
	       strncasecmp(arg->pin, name, arg->pin_len) == 0;
}

/* Freezes readers of everything that the box writes, before it runs. */
static void freeze_outputs(struct ld *ld, enum word word, const char *text)
{
	const struct word_row *row = ld_row(ld, word);
	struct arg arg;

	for (const char *at = text; args_next(&at, &arg);) {
		int pin = word_is_own(word) ?
			word_pin_find(row, arg.pin, arg.pin_len) : -1;

		if (arg.output || (pin >= 0 && row->pin[pin].dir == PIN_IN_OUT))
			ld_freeze(ld, intern(ld, arg.value, arg.value_len));
	}
	if (word_is_own(word))
		ld_freeze_globals(ld);
}

/* The operands of the written inputs, in order; an inverted one is a temporary, made before
 * the call. */
struct inputs {
	uint32_t operand[LIMIT_ARGS];
};

/* Copies an element whose index is computed in the scan to a temporary, while @en; @en then
 * also tells whether it exists. An operand that the block writes too stays the element. */
static void fetch_input(struct ld *ld, enum word word, const struct arg *arg,
			uint32_t *operand, uint32_t *en)
{
	const struct word_row *row = ld_row(ld, word);
	int pin = word_pin_find(row, arg->pin, arg->pin_len);
	const struct meaning *m = *operand ? ld_meaning(ld, *operand) : NULL;
	uint32_t value;

	/* MOVE fetches a whole structure or array itself; no other function takes one. */
	if (!m || !meaning_is_indexed(m) || (meaning_is_whole(m) && !word_is_own(word)))
		return;
	value = ld_fetch(ld, *operand, *en ? *en : ld->true_id, en);
	if (pin < 0 || pin >= row->pin_count || row->pin[pin].dir != PIN_IN_OUT)
		*operand = value;
}

/* @en: operand that enables it, 0: none so far; afterwards also FALSE if an element is
 * missing. */
static void read_inputs(struct ld *ld, enum word word, const char *text,
			struct inputs *out, uint32_t *en)
{
	struct arg arg;
	int i = 0;

	for (const char *at = text; i < LIMIT_ARGS && args_next(&at, &arg); i++) {
		out->operand[i] = intern(ld, arg.value, arg.value_len);
		if (!arg.output)
			fetch_input(ld, word, &arg, &out->operand[i], en);
		if (!arg.inverse)
			continue;
		ld_emit(ld, OP_LD, MOD_N, out->operand[i]);
		out->operand[i] = ld_store_new(ld);
	}
}

static void write_inputs(struct ld *ld, const char *text, const struct inputs *inputs)
{
	struct arg arg;
	int i = 0;

	for (const char *at = text; i < LIMIT_ARGS && args_next(&at, &arg); i++)
		if (!arg.output)
			ld_arg(ld, false, intern(ld, arg.pin, arg.pin_len),
			       inputs->operand[i]);
}

/* ENO of a function is stored elsewhere. */
static void write_outputs(struct ld *ld, const char *text, bool block)
{
	struct arg arg;

	for (const char *at = text; args_next(&at, &arg);)
		if (arg.output && (block || !is_pin(&arg, "ENO")))
			ld_arg(ld, true, intern(ld, arg.pin, arg.pin_len),
			       intern(ld, arg.value, arg.value_len));
}

/* "Delay.Q" of an instance and a pin. */
static uint32_t pin_name(struct ld *ld, uint32_t instance, const char *pin)
{
	char text[2 * LIMIT_NAME + 8];
	int len = snprintf(text, sizeof(text), "%s.%s",
			   names_text(names_of(ld), instance), pin);

	if (len < 0 || (size_t)len >= sizeof(text)) {
		ld->failed = true;
		return 0;
	}
	return intern(ld, text, (size_t)len);
}

static void feed_pin(struct ld *ld, uint32_t instance, const char *pin, int net)
{
	uint32_t name = pin_name(ld, instance, pin);

	ld_prepare(ld, net, 1);
	ld_load(ld, net);
	ld_emit(ld, OP_ST, 0, name);
}

/* A block of the project without a Boolean input is called while it has power. */
/* @ok: another condition; 0: none. */
static void call_block(struct ld *ld, int element, bool powered, uint32_t ok)
{
	const struct network_element *at = &ld->network.element[element];
	uint32_t instance = rung_at(ld->rung, at->row, at->col)->operand;

	powered &= at->in != NET_RAIL;
	if (powered) {
		ld_prepare(ld, at->in, 1);
		ld_load(ld, at->in);
	}
	ld_place(ld, at->row, at->col);
	if (ok)
		ld_emit(ld, powered ? OP_AND : OP_LD, 0, ok);
	ld_emit(ld, OP_CAL, powered || ok ? MOD_C : 0, instance);
}

static void box_block(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct word_row *row = ld_row(ld, (enum word)at->word);
	uint32_t instance = rung_at(ld->rung, at->row, at->col)->operand;
	const char *args = args_of(ld, element);
	int first = word_first_bool(row, PIN_IN);
	int power = word_first_bool(row, PIN_OUT);
	struct inputs inputs;
	uint32_t ok = 0;

	ld_freeze(ld, instance);
	freeze_outputs(ld, (enum word)at->word, args);
	if (first >= 0)
		feed_pin(ld, instance, row->pin[first].name, at->in);
	for (int i = 0; i < at->pins; i++) {
		const struct network_pin *pin =
			&ld->network.pin[at->first_pin + i];

		ld_place(ld, pin->row, pin->col);
		feed_pin(ld, instance,
			 names_text(names_of(ld), pin->operand), pin->in);
	}
	ld_place(ld, at->row, at->col);
	read_inputs(ld, (enum word)at->word, args, &inputs, &ok);
	call_block(ld, element, first < 0, ok);
	write_inputs(ld, args, &inputs);
	write_outputs(ld, args, true);
	if (power >= 0) {
		ld->element[element].leaf =
			pin_name(ld, instance, row->pin[power].name);
		ld->element[element].powered = true;
	} else { /* power goes through */
		ld->element[element].leaf = ok ? ok : ld->true_id;
	}
	if (power >= 0 && ok) {
		ld_emit(ld, OP_LD, 0, ok);
		ld_emit(ld, OP_AND, 0, ld->element[element].leaf);
		ld->element[element].leaf = ld_store_new(ld);
	}
}

static bool is_compare(enum word word)
{
	return word >= FN_GT && word <= FN_NE;
}

/* A comparison whose result is only power needs no EN: it cannot fail unless an element is
 * missing. */
static bool is_plain_compare(struct ld *ld, int element, struct arg *left,
			     struct arg *right)
{
	const struct network_element *at = &ld->network.element[element];
	const char *args = args_of(ld, element);
	struct arg arg;

	if (!is_compare((enum word)at->word) || at->pins)
		return false;
	for (const char *next = args; args_next(&next, &arg);)
		if (arg.output || arg.inverse ||
		    ld_is_indexed(ld, intern(ld, arg.value, arg.value_len)))
			return false;
	return args_find(args, "IN1", 3, left) && args_find(args, "IN2", 3, right);
}

static void store_eno(struct ld *ld, const char *args, uint32_t eno)
{
	struct arg arg;

	if (!args_find(args, "ENO", 3, &arg) || !arg.output)
		return;
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_ST, 0, intern(ld, arg.value, arg.value_len));
}

/* All inputs in the order of the row: pin rows and parameters. */
struct operands {
	uint32_t id[LIMIT_FN_ARGS];
	bool bits;             /* one of them is a BOOL, and none is more     */
};

static bool is_bit(struct ld *ld, uint32_t id, bool *seen)
{
	enum diag_id why;
	const struct meaning *m = scope_find(ld->translation->scope, ld->unit->pou, id,
					     &why);

	*seen |= m && m->type == IEC_BOOL;
	return m && (m->type == IEC_BOOL || (m->type == IEC_NONE &&
					     m->kind == MEANING_LITERAL));
}

static void take_operand(struct ld *ld, const struct word_row *row, const char *pin,
			 size_t len, uint32_t id, struct operands *out)
{
	int index = word_pin_find(row, pin, len);
	bool seen = false;

	if (index < 0 || index >= LIMIT_FN_ARGS)
		return;
	out->id[index] = id;
	if (!is_bit(ld, id, &seen))
		out->bits = false;
}

/* Are all inputs that share a type BOOLs? They are in @out then. */
static bool take_operands(struct ld *ld, int element, const struct inputs *inputs,
			  struct operands *out)
{
	const struct network_element *at = &ld->network.element[element];
	const struct word_row *row = ld_row(ld, (enum word)at->word);
	bool seen = false;
	struct arg arg;
	int n = 0;

	*out = (struct operands){ .bits = true };
	for (int i = 0; i < at->pins; i++) {
		const struct network_pin *from = &ld->network.pin[at->first_pin + i];
		const char *pin = names_text(names_of(ld), from->operand);

		take_operand(ld, row, pin, strlen(pin), ld_operand(ld, from->in), out);
	}
	for (const char *next = args_of(ld, element);
	     n < LIMIT_ARGS && args_next(&next, &arg); n++)
		if (!arg.output)
			take_operand(ld, row, arg.pin, arg.pin_len,
				     inputs->operand[n], out);
	for (int i = 0; i < LIMIT_FN_ARGS; i++)
		if (out->id[i])
			is_bit(ld, out->id[i], &seen);
	out->bits &= seen;
	return out->bits;
}

/* AND OR XOR NOT of BOOLs: the operators of IL, which become truth tables. */
static void emit_logic(struct ld *ld, enum op op, const struct operands *operands,
		       uint32_t result)
{
	ld_emit(ld, OP_LD, 0, operands->id[0]);
	if (op_row(op)->operand == OPND_NONE)
		ld_emit(ld, op, 0, 0);
	for (int i = 1; i < LIMIT_FN_ARGS && operands->id[i]; i++)
		ld_emit(ld, op, 0, operands->id[i]);
	ld_emit(ld, OP_ST, 0, result);
}

static void emit_call(struct ld *ld, int element, uint32_t en, uint32_t eno,
		      const struct inputs *inputs)
{
	const struct network_element *at = &ld->network.element[element];

	ld_call(ld, (enum word)at->word);
	ld_arg(ld, false, ld->en_id, en);
	for (int i = 0; i < at->pins; i++) /* all of them are operands by now */
		ld_arg(ld, false, ld->network.pin[at->first_pin + i].operand,
		       ld_operand(ld, ld->network.pin[at->first_pin + i].in));
	write_inputs(ld, args_of(ld, element), inputs);
	ld_arg(ld, true, ld->eno_id, eno);
}

/* A Boolean result that is also power: stored while enabled. Returns ENO, which is FALSE also
 * if OUT is a missing element. */
static uint32_t store_result(struct ld *ld, const char *args, uint32_t eno,
			     uint32_t result)
{
	uint32_t en = eno, to;
	struct arg out;

	if (!args_find(args, "OUT", 3, &out) || !out.output)
		return eno;
	to = intern(ld, out.value, out.value_len);
	ld_call(ld, FN_MOVE);
	ld_arg(ld, false, ld->en_id, en);
	ld_arg(ld, false, ld->in_id, result);
	if (ld_is_indexed(ld, to)) {
		eno = temps_bool(ld->temps);
		ld_arg(ld, true, ld->eno_id, eno);
	}
	ld_arg(ld, true, ld->out_id, to);
	return eno;
}

static void box_function(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct word_row *row = ld_row(ld, (enum word)at->word);
	struct element_state *state = &ld->element[element];
	const char *args = args_of(ld, element);
	uint32_t en, eno, result = 0;
	enum op op = word_operator(row);
	struct operands operands;
	struct inputs inputs;
	bool gates, bits;

	freeze_outputs(ld, (enum word)at->word, args);
	en = ld_operand(ld, at->in);
	for (int i = 0; i < at->pins; i++)
		ld_operand(ld, ld->network.pin[at->first_pin + i].in);
	ld_place(ld, at->row, at->col); /* an error stops at this box */
	read_inputs(ld, (enum word)at->word, args, &inputs, &en);
	bits = row->result == (int)RESULT_GATE &&
	       take_operands(ld, element, &inputs, &operands);
	gates = word_is_test(row) || bits;
	eno = bits && op != OP_COUNT ? en : temps_bool(ld->temps);
	if (gates)
		result = temps_bool(ld->temps);
	if (bits && op != OP_COUNT) {
		emit_logic(ld, op, &operands, result);
	} else {
		emit_call(ld, element, en, eno, &inputs);
		if (gates)
			ld_arg(ld, true, ld->out_id, result);
		else
			write_outputs(ld, args, false);
	}
	if (gates)
		eno = store_result(ld, args, eno, result);
	store_eno(ld, args, eno);
	state->leaf = eno;
	state->powered = true;
	if (gates) { /* while EN is FALSE the result is an old one */
		ld_emit(ld, OP_LD, 0, eno);
		ld_emit(ld, OP_AND, 0, result);
		state->leaf = ld_store_new(ld);
	}
}

/* A subroutine may write all globals; its output is the power of its call. */
void ld_routine(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	uint32_t name = rung_at(ld->rung, at->row, at->col)->operand;
	uint32_t power;

	ld_freeze_globals(ld);
	power = ld_operand(ld, at->in);
	ld_place(ld, at->row, at->col);
	if (at->in != NET_RAIL)
		ld_emit(ld, OP_LD, 0, power);
	ld_emit(ld, OP_CAL, at->in != NET_RAIL ? MOD_C : 0, name);
	state->leaf = power;
	state->powered = true;
}

void ld_execute(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	const struct boxed *boxed = pou_boxed(ld->unit->pou, (int)ld->number - 1, at->row, at->col);

	if (boxed)
		st_keep_read(ld, boxed->first, boxed->count);
	state->leaf = ld_operand(ld, at->in);
	state->powered = true;
	ld_place(ld, at->row, at->col);
	if (boxed)
		st_put_box(ld, at->in == NET_RAIL ? 0 : state->leaf, boxed->first, boxed->count);
}

void ld_box(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	struct il_line compare = { .kind = IL_FN, .word = at->word };
	struct arg left, right;

	ld_place(ld, at->row, at->col);
	if (ld_row(ld, (enum word)at->word)->kind == WORD_FB) {
		box_block(ld, element);
	} else if (is_plain_compare(ld, element, &left, &right)) {
		ld_emit(ld, OP_LD, 0, intern(ld, left.value, left.value_len));
		compare.operand = intern(ld, right.value, right.value_len);
		ld_emit_line(ld, compare);
		state->leaf = ld_store_new(ld);
	} else {
		box_function(ld, element);
	}
}
