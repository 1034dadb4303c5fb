/* SPDX-License-Identifier: MIT
 *
 * ld_box - functions and function blocks of a rung as IL calls.
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

/* Everything the box writes, before anything of it runs. */
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

/* The written parameters of one direction; ENO of a function is stored otherwise. */
static void write_args(struct ld *ld, const char *text, bool output, bool block)
{
	struct arg arg;

	for (const char *at = text; args_next(&at, &arg);)
		if (arg.output == output && (block || !is_pin(&arg, "ENO")))
			ld_arg(ld, output, intern(ld, arg.pin, arg.pin_len),
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
static void call_block(struct ld *ld, int element, bool powered)
{
	const struct network_element *at = &ld->network.element[element];
	uint32_t instance = rung_at(ld->rung, at->row, at->col)->operand;

	powered &= at->in != NET_RAIL;
	if (powered) {
		ld_prepare(ld, at->in, 1);
		ld_load(ld, at->in);
	}
	ld_place(ld, at->row, at->col);
	ld_emit(ld, OP_CAL, powered ? MOD_C : 0, instance);
}

static void box_block(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct word_row *row = ld_row(ld, (enum word)at->word);
	uint32_t instance = rung_at(ld->rung, at->row, at->col)->operand;
	const char *args = args_of(ld, element);
	int first = word_first_bool(row, PIN_IN);
	int power = word_first_bool(row, PIN_OUT);

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
	call_block(ld, element, first < 0);
	write_args(ld, args, false, true);
	write_args(ld, args, true, true);
	if (power >= 0) {
		ld->element[element].leaf =
			pin_name(ld, instance, row->pin[power].name);
		ld->element[element].powered = true;
	} else { /* power goes through */
		ld->element[element].leaf = ld->true_id;
	}
}

static bool is_compare(enum word word)
{
	return word >= FN_GT && word <= FN_NE;
}

/* A comparison whose result is only power needs no EN: it cannot fail. */
static bool is_plain_compare(struct ld *ld, int element, struct arg *left,
			     struct arg *right)
{
	const struct network_element *at = &ld->network.element[element];
	const char *args = args_of(ld, element);
	struct arg arg;

	if (!is_compare((enum word)at->word) || at->pins)
		return false;
	for (const char *next = args; args_next(&next, &arg);)
		if (arg.output)
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

static void box_function(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct word_row *row = ld_row(ld, (enum word)at->word);
	struct element_state *state = &ld->element[element];
	const char *args = args_of(ld, element);
	bool compare = word_is_test(row);
	uint32_t en, eno = temps_bool(ld->temps);
	uint32_t result = compare ? temps_bool(ld->temps) : 0;
	struct arg out;

	freeze_outputs(ld, (enum word)at->word, args);
	en = ld_operand(ld, at->in);
	for (int i = 0; i < at->pins; i++)
		ld_operand(ld, ld->network.pin[at->first_pin + i].in);
	ld_place(ld, at->row, at->col); /* an error is the box's own */
	ld_call(ld, (enum word)at->word);
	ld_arg(ld, false, ld->en_id, en);
	for (int i = 0; i < at->pins; i++) /* all of them are operands by now */
		ld_arg(ld, false, ld->network.pin[at->first_pin + i].operand,
		       ld_operand(ld, ld->network.pin[at->first_pin + i].in));
	write_args(ld, args, false, false);
	ld_arg(ld, true, ld->eno_id, eno);
	if (!compare) {
		write_args(ld, args, true, false);
	} else {
		ld_arg(ld, true, ld->out_id, result);
		if (args_find(args, "OUT", 3, &out) && out.output) {
			ld_call(ld, FN_MOVE);
			ld_arg(ld, false, ld->en_id, eno);
			ld_arg(ld, false, intern(ld, "IN", 2), result);
			ld_arg(ld, true, ld->out_id,
			       intern(ld, out.value, out.value_len));
		}
	}
	store_eno(ld, args, eno);
	state->leaf = eno;
	state->powered = true;
	if (compare) { /* while EN is FALSE the result is an old one */
		ld_emit(ld, OP_LD, 0, eno);
		ld_emit(ld, OP_AND, 0, result);
		state->leaf = ld_store_new(ld);
	}
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
