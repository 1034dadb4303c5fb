/* SPDX-License-Identifier: MIT
 *
 * call - functions and function blocks of an instruction list.
 */
#include "engine/translate/lists.h"

#include "engine/check/check_il.h"

#include <string.h>
#include <strings.h>

#define TRUE_SLOT  CODE_TRUE_AT(list->as->areas)

static const char *pin_text(const struct list *list, const struct il_line *arg)
{
	return scope_text(list->as->translation->scope, arg->pin);
}

/* An offset for an unused result. */
uint32_t list_sink(struct assembler *as, enum iec_type type)
{
	if (!as->sink[type])
		as->sink[type] = layout_tail(as, RUN_VALUES, type);
	return as->sink[type];
}

/* The function of the image for a word: INT_TO_REAL and others share one. */
static uint32_t function_of(const struct word_row *row, enum word word)
{
	return row->runs ? (uint32_t)row->runs : (uint32_t)word;
}

/* ---- functions on the result ---- */

uint32_t list_operand(struct list *list, const struct il_result *result,
		      enum iec_type type)
{
	union iec_value value = { .i = 0 };

	if (result->kind == RESULT_LITERAL) {
		if (result->literal->type != IEC_NONE)
			type = result->literal->type;
		if (type == IEC_STRING)
			return CODE_OPERAND(type, layout_text(list->as,
							      result->literal));
		literal_fit(result->literal, type, &value);
		return CODE_OPERAND(type, layout_constant(list->as, type, value));
	}
	if (result->kind == RESULT_BITS)
		return CODE_OPERAND(IEC_BOOL, list_slot(list, &result->bits));
	return result->operand;
}

/* The type a constant or the current result has at an input. */
static enum iec_type input_type(const struct word_row *row, uint32_t index,
				enum iec_type type, const struct literal *literal)
{
	const struct word_pin *pin = word_input(row, index);

	return pin->own && literal ? fn_own_type(pin, literal) : type;
}

/* The result of a function that fails: the left operand, or 0 if that has another type. */
static void preset(struct list *list, enum iec_type result, uint32_t to, uint32_t left)
{
	union iec_value zero = { .i = 0 };

	if (iec_can_widen((enum iec_type)CODE_TYPE(left), result))
		list_copy(list, to, left);
	else if (result != IEC_STRING)
		list_copy(list, to, CODE_OPERAND(result,
			layout_constant(list->as, result, zero)));
}

static uint32_t input_word(const struct word_row *row, uint32_t index,
			   uint32_t operand)
{
	return operand | (word_input(row, index)->own ? CODE_OWN : 0);
}

/* Type of a result; IEC_NONE: a constant without one. */
static enum iec_type type_of(const struct il_result *result)
{
	if (result->kind == RESULT_LITERAL)
		return result->literal->type;
	if (result->kind == RESULT_BITS)
		return IEC_BOOL;
	return (enum iec_type)CODE_TYPE(result->operand);
}

/* One or more operands, the first of them what an error leaves. */
struct applied {
	enum word word;
	uint32_t count, operand[LIMIT_FN_ARGS];
};

static void apply(struct list *list, const struct applied *applied)
{
	const struct word_row *row = list_row(list, applied->word);
	bool stores;
	int at;
	struct fn_code fn = {
		.fn = function_of(row, applied->word), .type = list->types[list->at],
		.en = TRUE_SLOT, .eno = list_sink(list->as, IEC_BOOL),
		.count = applied->count, .left = true,
	};

	if (list_is_compare(applied->word)) {
		list_compare(list, applied->word, applied->operand[0],
			     applied->operand[1]);
		return;
	}
	fn.result = fn_result(row, fn.type,
			      il_stored_type(list->as->translation->scope, list->pou,
					     list->il, list->at));
	fn.to = CODE_OPERAND(fn.result, layout_tail(list->as, RUN_VALUES, fn.result));
	for (uint32_t i = 0; i < fn.count; i++)
		fn.input[i] = input_word(row, i, applied->operand[i]);
	stores = list_stores_left(&fn);
	if (!stores)
		preset(list, fn.result, fn.to, applied->operand[0]);
	at = list->as->text->count;
	list_emit_fn(list, &fn);
	if (stores && (list->as->text->word[at] & 0xff) != VM_FN)
		list->as->open_number = at + 3;
	list->now = (struct il_result){
		.kind = RESULT_NUMBER, .own = true, .operand = fn.to,
	};
	if (fn.result == IEC_BOOL)
		list->now = (struct il_result){
			.kind = RESULT_BITS, .bits = bits_leaf(list->as, CODE_OFFSET(fn.to)),
		};
}

static uint32_t input_of(struct list *list, const struct word_row *row, uint32_t index,
			 const struct il_result *result)
{
	return list_operand(list, result, input_type(row, index,
		list->types[list->at],
		result->kind == RESULT_LITERAL ? result->literal : NULL));
}

static bool is_arg(const struct list *list, int at)
{
	return at < list->il->count && (list->il->line[at].kind == IL_ARG_IN ||
					list->il->line[at].kind == IL_ARG_OUT);
}

/* The function of the current line: its types depend on both operands. */
static enum word word_at(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	enum word word = (enum word)line->word;

	if (!line->operand || is_arg(list, list->at + 1))
		return word;
	return fn_overload(word, type_of(&list->now),
			   list_meaning(list, line->operand)->type);
}

/* One of its operands, from line @at. */
static void add_operand(struct list *list, int at, struct applied *fn)
{
	const struct word_row *row = list_row(list, fn->word);
	const struct meaning *m = list_meaning(list, list->il->line[at].operand);

	fn->operand[fn->count] = list_number(list, m,
		input_type(row, fn->count, list->types[list->at],
			   m->kind == MEANING_LITERAL ? &m->literal : NULL));
	fn->count++;
}

void list_fn(struct list *list, const struct il_line *line)
{
	struct applied fn = { .count = 1 };

	if (word_is_own((enum word)line->word)) {
		list_own_fn(list);
		return;
	}
	if (line->modifiers & MOD_PAREN) {
		list_open(list, line);
		return;
	}
	fn.word = word_at(list);
	fn.operand[0] = input_of(list, list_row(list, fn.word), 0, &list->now);
	if (line->operand)
		add_operand(list, list->at, &fn);
	for (int i = list->at + 1; is_arg(list, i); i++)
		add_operand(list, i, &fn);
	apply(list, &fn);
}

void list_close_fn(struct list *list, const struct opened *open)
{
	struct applied fn = { .count = 2 };
	const struct word_row *row;

	fn.word = fn_overload(open->word, type_of(&open->left), type_of(&list->now));
	row = list_row(list, fn.word);
	fn.operand[0] = input_of(list, row, 0, &open->left);
	fn.operand[1] = input_of(list, row, 1, &list->now);
	apply(list, &fn);
}

/* ---- functions with formal parameters ---- */

/* A BOOL that an instruction writes: directly, or through a scratch slot. */
struct target {
	const struct meaning *m;
	uint32_t slot;
	bool beside;
};

static struct target bool_target(struct list *list, const struct meaning *m,
				 bool keep)
{
	struct target out = { .m = m };
	struct spot spot;

	if (!m) {
		out.slot = list_sink(list->as, IEC_BOOL);
		return out;
	}
	spot = layout_spot(list->as, m);
	out.beside = meaning_is_indexed(m) || spot.packed || list_temp(list, m) >= 0;
	if (!out.beside) {
		out.slot = spot.offset;
		return out;
	}
	out.slot = scratch_new(list->as);
	if (keep) { /* not written when EN is FALSE */
		struct bits old = list_bits(list, m);

		bits_store(list->as, &old, out.slot);
	}
	return out;
}

static void finish_target(struct list *list, const struct target *target)
{
	struct bits value = bits_leaf(list->as, target->slot);

	if (target->m && target->beside)
		list_write_bits(list, target->m, &value);
}

struct call {
	uint32_t en, input[LIMIT_FN_ARGS];
	int count;
	const struct meaning *eno, *out;
	int eno_line, out_line;
};

/* EN first: a missing element is no error while EN is FALSE. */
static void read_en(struct list *list, struct call *call)
{
	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		struct bits bits;

		if (strcasecmp(pin_text(list, arg), "EN") != 0)
			continue;
		bits = list_bits(list, list_meaning(list, arg->operand));
		call->en = list_keep(list, &bits);
	}
}

/* If an element is missing the function does not run. */
static uint32_t read_input(struct list *list, const struct meaning *m,
			   enum iec_type type, struct call *call)
{
	return meaning_is_indexed(m) ? list_fetch(list, m, call->en, &call->en)
			     : list_number(list, m, type);
}

static void read_args(struct list *list, const struct word_row *row,
		      enum iec_type type, struct call *call)
{
	read_en(list, call);
	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		const struct meaning *m = list_meaning(list, arg->operand);
		const char *pin = pin_text(list, arg);
		int index = word_pin_find(row, pin, strlen(pin));

		if (strcasecmp(pin, "ENO") == 0) {
			call->eno = m;
			call->eno_line = i;
		} else if (strcasecmp(pin, "OUT") == 0) {
			call->out = m;
			call->out_line = i;
		} else if (index >= 0 && index < LIMIT_FN_ARGS) {
			call->input[index] = read_input(list, m,
				input_type(row, (uint32_t)index, type,
					   m->kind == MEANING_LITERAL ?
					   &m->literal : NULL), call);
			call->count = index >= call->count ? index + 1
							   : call->count;
		}
	}
}

/* The overload of the line's word for its inputs. */
static enum word overloaded(struct list *list, enum word word)
{
	const struct word_row *row = list_row(list, word);
	enum iec_type type[2] = { IEC_NONE, IEC_NONE };

	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		const char *pin = pin_text(list, arg);
		int index = word_pin_find(row, pin, strlen(pin));

		if (index > 1)
			return word;
		if (index >= 0 && arg->kind == IL_ARG_IN)
			type[index] = list_meaning(list, arg->operand)->type;
	}
	return fn_overload(word, type[0], type[1]);
}

/* The temporary keeps its value under the line that stores it. */
static void finish_at(struct list *list, const struct target *target, int line)
{
	int at = list->at;

	list->at = line;
	finish_target(list, target);
	list->at = at;
}

/* A plain store of a value cannot fail, so ENO is EN. */
static bool is_plain_move(const struct word_row *row, enum word word,
			  const struct call *call, uint32_t to)
{
	uint32_t type = CODE_TYPE(to);

	return function_of(row, word) == FN_MOVE && type != IEC_BOOL &&
	       type != IEC_STRING && CODE_TYPE(call->input[0]) == type;
}

/* @fn: bits_made() records its ENO if only a temporary has it. */
static void emit_call(struct list *list, const struct word_row *row, enum word word,
		      const struct call *call, struct fn_code fn)
{
	struct assembler *as = list->as;
	int at;

	fn.fn = function_of(row, word);
	fn.type = list->types[list->at];
	fn.en = call->en;
	fn.count = (uint32_t)call->count;
	for (uint32_t i = 0; i < fn.count; i++)
		fn.input[i] = input_word(row, i, call->input[i]);
	at = as->text->count;
	list_emit_fn(list, &fn);
	if (call->eno && list_temp(list, call->eno) >= 0)
		as->open_bit = at + ((as->text->word[at] & 0xff) == VM_FN ? 3 : 2);
}

/* ---- MOVE from or to an element ---- */

/* The input of a MOVE and where it goes, both values of one type that need no more than a copy. */
struct moved { const struct meaning *in, *out, *eno; int eno_line; };

static bool find_moved(struct list *list, const struct word_row *row, enum word word,
		       struct moved *moved)
{
	*moved = (struct moved){ .in = NULL };
	if (function_of(row, word) != FN_MOVE)
		return false;
	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		const struct meaning *m = list_meaning(list, arg->operand);
		const char *pin = pin_text(list, arg);

		if (strcasecmp(pin, "ENO") == 0) {
			moved->eno = m;
			moved->eno_line = i;
		} else if (strcasecmp(pin, "OUT") == 0) {
			moved->out = m;
		} else if (strcasecmp(pin, "EN") != 0) {
			moved->in = m;
		}
	}
	return moved->in && moved->out && moved->out->type != IEC_NONE &&
	       moved->out->type != IEC_BOOL && moved->out->type != IEC_STRING &&
	       !moved->in->through && !moved->out->through;
}

/* An element whose index is found out in the scan goes to a plain value. */
static bool gets_element(const struct moved *moved)
{
	return meaning_is_indexed(moved->in) && moved->in->type == moved->out->type &&
	       !meaning_is_checked(moved->out);
}

/* A value, or another element, goes to such an element. */
static bool puts_element(const struct list *list, const struct moved *moved)
{
	const struct meaning *in = moved->in;

	return meaning_is_indexed(moved->out) &&
	       (in->kind == MEANING_LITERAL ? in->type == IEC_NONE || in->type == moved->out->type :
		in->type == moved->out->type) && list->types[list->at] == moved->out->type;
}

/* A MOVE that AGET or APUT does alone; false: it is another one. */
static bool move_element(struct list *list, const struct word_row *row, enum word word)
{
	struct target eno = { .beside = true };
	struct moved moved;
	struct spot spot;
	struct call call = { .en = TRUE_SLOT };
	uint32_t from;

	if (!find_moved(list, row, word, &moved) ||
	    !(gets_element(&moved) || puts_element(list, &moved)))
		return false;
	list->now.kind = RESULT_NONE; /* read for the last time here */
	read_en(list, &call);
	if (gets_element(&moved)) {
		spot = layout_spot(list->as, moved.out);
		eno.slot = list_fetch_to(list, moved.in, call.en,
					 CODE_OPERAND(spot.type, spot.offset));
	} else {
		from = read_input(list, moved.in, moved.out->type, &call);
		eno.slot = list_deposit(list, moved.out, call.en, from);
	}
	eno.m = moved.eno;
	if (moved.eno)
		finish_at(list, &eno, moved.eno_line);
	return true;
}

/* ---- an index that differs from a variable by a constant ---- */

const struct shift *list_shift(const struct list *list, const struct meaning *m)
{
	const struct shift *shift = list->shift && m->kind == MEANING_VARIABLE && m->pou == list->pou ?
				    &list->shift[m->index] : NULL;

	return shift && shift->of ? shift : NULL;
}

void list_unshift(struct list *list, const struct meaning *m)
{
	if (list_shift(list, m))
		list->shift[m->index].of = NULL;
}

/* The simulation stands at lists as they are. */
static bool is_index(const struct list *list, const struct il_line *call)
{
	return call->mark & IL_INDEX && !(list->as->listing && list->as->text == &list->as->watch);
}

/* Nothing runs here: the bounds of the elements take the constant. It cannot fail where they do not. */
static void call_index(struct list *list)
{
	struct target eno = { .beside = true };
	struct call call = { .en = TRUE_SLOT };

	list->now.kind = RESULT_NONE;
	read_en(list, &call);
	eno.slot = call.en;
	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];

		if (strcasecmp(pin_text(list, arg), "ENO") != 0)
			continue;
		eno.m = list_meaning(list, arg->operand);
		finish_at(list, &eno, i);
	}
}

/* @call: the line of a sum. */
static struct shift shift_of(struct list *list, const struct il_line *call)
{
	struct shift shift = { .of = NULL };

	for (const struct il_line *arg = call + 1; arg->kind == IL_ARG_IN; arg++) {
		const struct meaning *m = list_meaning(list, arg->operand);

		if (strcasecmp(pin_text(list, arg), "EN") == 0)
			continue;
		if (m->kind != MEANING_LITERAL)
			shift.of = m;
		else
			shift.by = (int32_t)(call->word == FN_SUB ? -m->literal.value.i : m->literal.value.i);
	}
	return shift;
}

void list_take_out(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at], *call = line;
	const struct meaning *m = list_meaning(list, line->operand);
	const size_t count = (size_t)(list->pou->vars.count + list->unit->temp_count);

	while (call->kind == IL_ARG_IN || call->kind == IL_ARG_OUT)
		call--;
	if (!is_index(list, call) || strcasecmp(pin_text(list, line), "OUT") != 0) {
		list_unshift(list, m);
		return;
	}
	if (!list->shift)
		list->shift = arena_alloc(list->as->arena, count * sizeof(*list->shift));
	if (list->shift)
		list->shift[m->index] = shift_of(list, call);
	else
		list->as->failed = true;
}

void list_call(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	enum word word = overloaded(list, (enum word)line->word);
	const struct word_row *row = list_row(list, word);
	enum iec_type type = list->types[list->at];
	struct call call = { .en = TRUE_SLOT };
	enum iec_type result;
	struct target eno, out = { .m = NULL };
	uint32_t to;

	if (is_index(list, line)) {
		call_index(list);
		return;
	}
	if (word_is_own((enum word)line->word) || list_is_whole_move(list)) {
		list_own_call(list);
		return;
	}
	if (move_element(list, row, word))
		return;
	list->now.kind = RESULT_NONE; /* read for the last time here */
	read_args(list, row, type, &call);
	result = fn_result(row, type, call.out ? call.out->type : IEC_NONE);
	if (call.out && meaning_is_indexed(call.out)) { /* the value if OUT fails */
		to = list_fetch(list, call.out, call.en, &call.en);
	} else if (call.out && meaning_is_ranged(call.out)) { /* compared before it is stored */
		to = CODE_OPERAND(call.out->type,
				  layout_tail(list->as, RUN_VALUES, call.out->type));
		list_copy(list, to, list_number(list, call.out, call.out->type));
	} else if (call.out && result == IEC_BOOL) {
		out = bool_target(list, call.out, true);
		to = CODE_OPERAND(IEC_BOOL, out.slot);
	} else if (call.out) {
		struct spot spot = layout_spot(list->as, call.out);

		to = CODE_OPERAND(spot.type, spot.offset);
	} else {
		to = CODE_OPERAND(result, list_sink(list->as, result));
	}
	list_protect(list, CODE_OFFSET(to), 1);
	if (is_plain_move(row, word, &call, to)) {
		eno = (struct target){ .m = call.eno, .slot = call.en, .beside = true };
		list_copy_if(list, call.en, to, call.input[0]);
	} else {
		eno = bool_target(list, call.eno, false);
		list_protect(list, eno.slot, 1);
		emit_call(list, row, word, &call, (struct fn_code){
			.result = result, .eno = eno.slot, .to = to });
	}
	if (call.out && meaning_is_ranged(call.out)) {
		const uint32_t stored = list_deposit(list, call.out, eno.slot, to);

		if (eno.slot == call.en)
			eno.slot = stored;
		else
			list_copy(list, CODE_OPERAND(IEC_BOOL, eno.slot),
				  CODE_OPERAND(IEC_BOOL, stored));
	} else if (call.out && meaning_is_indexed(call.out)) {
		list_deposit(list, call.out, call.en, to);
	}
	if (call.eno)
		finish_at(list, &eno, call.eno_line);
	if (out.m)
		finish_at(list, &out, call.out_line);
}

/* ---- function blocks ---- */

/* @base: where the instance is called; 0: where it lies. */
static uint32_t pin_at(struct list *list, const struct meaning *pin, const struct word_row *row,
		       uint32_t base)
{
	return base ? base + row->pin[pin->pin].offset : layout_spot(list->as, pin).offset;
}

/* PIN := value, stored as LD value, ST Instance.PIN would. */
static void feed_pin(struct list *list, const struct meaning *instance, uint32_t base,
		     const struct il_line *arg, uint32_t fetched)
{
	const struct word_row *row = list_row(list, instance->word);
	const struct meaning *m = list_meaning(list, arg->operand);
	struct meaning pin = *instance;
	const char *name = pin_text(list, arg);
	union iec_value value = { .i = 0 };
	struct bits bits;
	uint32_t to;

	pin.kind = MEANING_PIN;
	pin.pin = word_pin_find(row, name, strlen(name));
	pin.type = row->pin[pin.pin].type;
	pin.offset += row->pin[pin.pin].offset;
	to = pin_at(list, &pin, row, base);
	if (m->kind == MEANING_LITERAL && list->straight && !base &&
	    layout_only_stored(list->as, &pin)) {
		if (list->as->text == &list->as->code && pin.type == IEC_STRING)
			layout_init_text(list->as, to, WORD_TEXT, m->literal);
		literal_fit(&m->literal, pin.type, &value);
		if (list->as->text == &list->as->code && pin.type != IEC_STRING)
			layout_init_over(list->as, to, pin.type, value);
		return;
	}
	if (pin.type == IEC_BOOL) {
		bits = fetched ? bits_leaf(list->as, CODE_OFFSET(fetched))
			       : list_bits(list, m);
		list_protect(list, to, 1);
		bits_store(list->as, &bits, to);
		return;
	}
	list_copy(list, CODE_OPERAND(pin.type, to),
		  fetched ? fetched : list_number(list, m, pin.type));
}

/* PIN => variable. */
static void take_pin(struct list *list, const struct meaning *instance, uint32_t base,
		     const struct il_line *arg)
{
	const struct word_row *row = list_row(list, instance->word);
	const struct meaning *m = list_meaning(list, arg->operand);
	struct meaning pin = *instance;
	const char *name = pin_text(list, arg);
	struct bits bits;
	uint32_t from;

	pin.kind = MEANING_PIN;
	pin.pin = word_pin_find(row, name, strlen(name));
	pin.type = row->pin[pin.pin].type;
	pin.offset += row->pin[pin.pin].offset;
	from = pin_at(list, &pin, row, base);
	if (pin.type == IEC_BOOL) {
		bits = bits_leaf(list->as, from);
		list_write_bits(list, m, &bits);
		return;
	}
	if (meaning_is_checked(m))
		list_deposit(list, m, TRUE_SLOT,
			     CODE_OPERAND(pin.type, from));
	else
		list_copy(list, list_number(list, m, m->type),
			  CODE_OPERAND(pin.type, from));
}

/* A jump over the call; returns the word of its target. Waiting values must be stored before:
 * after the jump would be too late. */
static int jump_over(struct list *list, struct bits skip)
{
	uint32_t slot = list_slot(list, &skip);
	int at;

	emit_op(list->as, VM_JMPC, 0);
	at = list->as->text->count;
	emit(list->as, 0);
	emit(list->as, slot);
	list->straight = false;
	return at;
}

static bool is_element(struct list *list, const struct il_line *arg)
{
	return meaning_is_indexed(list_meaning(list, arg->operand));
}

/* Looks up inputs that are elements, by number of the parameter; 0: no element. Returns the
 * BOOL that is TRUE if all exist; 0: there are none. */
static uint32_t fetch_inputs(struct list *list, uint32_t fetched[LIMIT_ARGS])
{
	uint32_t ok = 0;

	memset(fetched, 0, LIMIT_ARGS * sizeof(*fetched));
	for (int i = 0; i < LIMIT_ARGS && is_arg(list, list->at + 1 + i); i++) {
		const struct il_line *arg = &list->il->line[list->at + 1 + i];

		if (arg->kind == IL_ARG_IN && is_element(list, arg))
			fetched[i] = list_fetch(list,
				list_meaning(list, arg->operand),
				ok ? ok : TRUE_SLOT, &ok);
	}
	return ok;
}

int list_skip_missing(struct list *list, bool kept, uint32_t fetched[LIMIT_ARGS])
{
	uint32_t ok = fetch_inputs(list, fetched);

	if (!ok)
		return -1;
	if (!kept)
		list_keep_all(list);
	return jump_over(list, bits_not(bits_leaf(list->as, ok)));
}

void list_fetch_args(struct list *list, struct bits *en,
		     uint32_t fetched[LIMIT_ARGS])
{
	memset(fetched, 0, LIMIT_ARGS * sizeof(*fetched));
	for (int i = 0; i < LIMIT_ARGS && is_arg(list, list->at + 1 + i); i++) {
		const struct il_line *arg = &list->il->line[list->at + 1 + i];
		const char *pin = pin_text(list, arg);
		uint32_t ok;

		if (!is_element(list, arg) || strcasecmp(pin, "EN") == 0 ||
		    strcasecmp(pin, "ENO") == 0)
			continue;
		fetched[i] = list_fetch(list, list_meaning(list, arg->operand),
					list_slot(list, en), &ok);
		*en = bits_leaf(list->as, ok);
	}
}

/* CALC is a jump over the call. */
int list_skip_call(struct list *list, const struct il_line *line)
{
	struct bits now = list_now_bits(list);

	list_keep_all(list);
	return jump_over(list, line->modifiers & MOD_N ? now : bits_not(now));
}

int list_skip_kept(struct list *list, const struct il_line *line)
{
	const struct bits now = list_now_bits(list);

	return jump_over(list, line->modifiers & MOD_N ? now : bits_not(now));
}

void list_end_skip(struct list *list, int skip)
{
	if (skip < 0)
		return;
	bits_end(list->as);
	list->as->text->word[skip] = (uint32_t)list->as->text->count;
}

/* The parameters and the block itself. */
static void call_at(struct list *list, const struct meaning *instance, uint32_t base,
		    const uint32_t fetched[LIMIT_ARGS])
{
	for (int i = list->at + 1; is_arg(list, i); i++)
		if (list->il->line[i].kind == IL_ARG_IN)
			feed_pin(list, instance, base, &list->il->line[i],
				 fetched[i - list->at - 1]);
	list_place(list);
	emit_op(list->as, VM_FB, (uint32_t)instance->word);
	emit(list->as, base ? base : layout_spot(list->as, instance).offset);
}

static void take_outputs(struct list *list, const struct meaning *instance, uint32_t base)
{
	for (int i = list->at + 1, at = list->at; is_arg(list, i); i++)
		if (list->il->line[i].kind == IL_ARG_OUT) {
			list->at = i;
			take_pin(list, instance, base, &list->il->line[i]);
			list->at = at;
		}
}

int list_skip_unborrowed(struct list *list, uint32_t ok)
{
	return jump_over(list, bits_not(bits_leaf(list->as, ok)));
}

/* An instance behind a computed index is called in a place of its own. */
static void call_element(struct list *list, const struct meaning *instance,
			 const uint32_t fetched[LIMIT_ARGS])
{
	const uint32_t base = layout_like(list->as, instance);
	struct indices indices;
	const int skip = list_skip_unborrowed(list, list_borrow(list, instance, base, &indices));

	call_at(list, instance, base, fetched);
	list_give_back(list, instance, base, &indices);
	take_outputs(list, instance, base);
	list_end_skip(list, skip);
}

/* A missing element at an input jumps over the call, too. */
void list_cal(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	const struct pou *routine = scope_pou(list->as->translation->scope, list->pou,
					      line->operand);
	const struct meaning *instance;
	uint32_t fetched[LIMIT_ARGS];
	bool element;
	int unless = -1, missing;

	if (routine) {
		list_routine(list, routine);
		return;
	}
	instance = list_meaning(list, line->operand);
	element = meaning_is_indexed(instance);
	if (word_is_own(instance->word)) {
		list_own_cal(list);
		return;
	}
	if (!(line->modifiers & MOD_C))
		list->now.kind = RESULT_NONE; /* read for the last time here */
	if (!element)
		list_protect(list, layout_spot(list->as, instance).offset,
			     list_row(list, instance->word)->size);
	if (line->modifiers & MOD_C)
		unless = list_skip_call(list, line);
	else if (element)
		list_keep_all(list);
	missing = list_skip_missing(list, element || unless >= 0, fetched);
	if (element) {
		call_element(list, instance, fetched);
	} else {
		call_at(list, instance, 0, fetched);
		take_outputs(list, instance, 0);
	}
	list_end_skip(list, unless);
	list_end_skip(list, missing);
	list->now.kind = RESULT_NONE;
}
