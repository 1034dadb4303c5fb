/* SPDX-License-Identifier: MIT
 *
 * call_own - calls of the functions and function blocks of a project.
 *
 * A body works on one frame. A block's frame is filled from the instance and copied back
 * after the call; a function's is filled from a template. A body may write any variable, so
 * all waiting values are stored before the call.
 */
#include "engine/base/name.h"
#include "engine/translate/lists.h"

#include <string.h>
#include <strings.h>

const struct word_row *list_row(const struct list *list, enum word word)
{
	return words_row(&list->as->translation->project->words, word);
}

static const char *pin_text(const struct list *list, const struct il_line *arg)
{
	return scope_text(list->as->translation->scope, arg->pin);
}

static bool is_arg(const struct list *list, int at)
{
	return at < list->il->count && (list->il->line[at].kind == IL_ARG_IN ||
					list->il->line[at].kind == IL_ARG_OUT);
}

static const struct il_line *find_arg(const struct list *list, const char *name,
				      int *at)
{
	for (int i = list->at + 1; is_arg(list, i); i++)
		if (name_is(pin_text(list, &list->il->line[i]), name, strlen(name))) {
			*at = i;
			return &list->il->line[i];
		}
	return NULL;
}

static uint32_t size_of(const struct list *list, const struct meaning *m)
{
	return scope_size(list->as->translation->scope, m);
}

/* ---- pins, at @to in an instance or frame ---- */

/* @fetched: place of an element that was looked up; 0: none. */
static void feed(struct list *list, uint32_t to, const struct word_pin *pin,
		 const struct meaning *m, uint32_t fetched, const struct var_range *range)
{
	struct bits bits;

	if (meaning_is_whole(m)) {
		list_copy_whole(list, to, fetched ? CODE_OFFSET(fetched) :
				layout_spot(list->as, m).offset, size_of(list, m));
	} else if (pin->type == IEC_BOOL) {
		bits = fetched ? bits_leaf(list->as, CODE_OFFSET(fetched))
			       : list_bits(list, m);
		list_protect(list, to, 1);
		bits_store(list->as, &bits, to);
	} else if (range) {
		list_keep_range(list, range, CODE_OPERAND(pin->type, to), fetched ? fetched :
				m->kind == MEANING_LITERAL ? list_number(list, m, pin->type) :
				list_number(list, m, m->type));
	} else {
		list_copy(list, CODE_OPERAND(pin->type, to), fetched ? fetched :
			  list_number(list, m, pin->type));
	}
}

/* Of the variable that @pin of an own block or function was made from; NULL: none. */
static const struct var_range *range_of(const struct list *list, const struct word_row *row,
					const struct word_pin *pin)
{
	const struct project *project = scope_project(list->as->translation->scope);
	const struct var_table *table = row->owner >= 0 ? &project->pou[row->owner].vars : NULL;

	return table && pin - row->pin < table->count ? table->var[pin - row->pin].range : NULL;
}

static void take(struct list *list, uint32_t from, enum iec_type type,
		 const struct meaning *m)
{
	struct bits bits = bits_leaf(list->as, from);

	if (meaning_is_whole(m) && meaning_is_indexed(m))
		list_deposit(list, m, CODE_TRUE_AT(list->as->areas),
			     CODE_OPERAND(IEC_NONE, from));
	else if (meaning_is_whole(m))
		list_copy_whole(list, layout_spot(list->as, m).offset, from,
				size_of(list, m));
	else if (type == IEC_BOOL)
		list_write_bits(list, m, &bits);
	else if (meaning_is_checked(m))
		list_deposit(list, m, CODE_TRUE_AT(list->as->areas),
			     CODE_OPERAND(type, from));
	else
		list_copy(list, list_number(list, m, m->type),
			  CODE_OPERAND(type, from));
}

/* The pin that a parameter names; NULL: EN, ENO or OUT of a function. */
static const struct word_pin *pin_of(const struct list *list,
				     const struct word_row *row,
				     const struct il_line *arg)
{
	const char *name = pin_text(list, arg);
	int index = word_pin_find(row, name, strlen(name));

	return index < 0 ? NULL : &row->pin[index];
}

static void feed_all(struct list *list, const struct word_row *row, uint32_t base,
		     const uint32_t fetched[LIMIT_ARGS])
{
	for (int i = list->at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		const struct word_pin *pin = pin_of(list, row, arg);

		if (pin && arg->kind == IL_ARG_IN)
			feed(list, base + pin->offset, pin,
			     list_meaning(list, arg->operand),
			     fetched[i - list->at - 1], range_of(list, row, pin));
	}
}

/* Copies outputs and VAR_IN_OUT back. */
static void take_all(struct list *list, const struct word_row *row, uint32_t base)
{
	int at = list->at;

	for (int i = at + 1; is_arg(list, i); i++) {
		const struct il_line *arg = &list->il->line[i];
		const struct word_pin *pin = pin_of(list, row, arg);

		if (!pin || pin->dir == PIN_IN)
			continue;
		list->at = i;
		take(list, base + pin->offset, pin->type,
		     list_meaning(list, arg->operand));
		list->at = at;
	}
}

static void emit_call(struct list *list, uint32_t entry)
{
	list_place(list);
	emit_op(list->as, VM_CALL, 0);
	emit(list->as, entry);
}

/* ---- function blocks ---- */

/* While watched: the power of the body's cells, for this instance. */
static void keep_power(struct list *list, const struct meaning *instance,
		       const struct frame *frame)
{
	struct assembler *as = list->as;
	uint32_t to, element;

	if (as->text != &as->watch || !frame->power_size || instance->var->fb != (enum word)instance->word)
		return;
	to = as->power[layout_table(as, instance)][instance->index];
	element = instance->offset / list_row(list, instance->word)->size;
	if (to)
		emit_block(as, to + element * frame->power_size, frame->power,
			   frame->power_size);
}

/* The same of an instance behind computed indices, which lies in an array of its own. */
static void keep_power_of(struct list *list, const struct meaning *instance,
			  const struct frame *frame, const struct indices *indices)
{
	struct assembler *as = list->as;
	const uint32_t to = as->text == &as->watch && frame->power_size ?
		as->power[layout_table(as, instance)][instance->index] : 0;

	if (to && !instance->through && instance->var->fb == (enum word)instance->word)
		list_keep_power(list, instance, indices, &(struct element_power){
			.to = to, .from = frame->power, .size = frame->power_size,
			.unit = list_row(list, instance->word)->size });
}

/* The frame of a block, and the list that is called: its own, or that of an action. */
static const struct frame *callee_of(const struct list *list, const struct meaning *instance,
				     uint32_t *entry)
{
	const struct frame *frame = layout_pou(list->as, instance->word, entry);

	if (instance->action)
		*entry = instance->action - 1u;
	return frame;
}

/* An element's frame is filled from it before the inputs. */
static void call_element(struct list *list, const struct meaning *instance,
			 const uint32_t fetched[LIMIT_ARGS])
{
	const struct word_row *row = list_row(list, instance->word);
	uint32_t entry;
	const struct frame *frame = callee_of(list, instance, &entry);
	struct indices indices;
	const int skip = list_skip_unborrowed(list, list_borrow(list, instance, frame->offset,
								&indices));

	feed_all(list, row, frame->offset, fetched);
	emit_call(list, entry);
	list_give_back(list, instance, frame->offset, &indices);
	keep_power_of(list, instance, frame, &indices);
	take_all(list, row, frame->offset);
	list_end_skip(list, skip);
}

static void call_instance(struct list *list, const struct meaning *instance,
			  const uint32_t fetched[LIMIT_ARGS])
{
	const struct word_row *row = list_row(list, instance->word);
	const uint32_t base = layout_spot(list->as, instance).offset;
	uint32_t entry;
	const struct frame *frame = callee_of(list, instance, &entry);

	feed_all(list, row, base, fetched);
	emit_block(list->as, frame->offset, base, row->size);
	emit_call(list, entry);
	emit_block(list->as, base, frame->offset, row->size);
	keep_power(list, instance, frame);
	take_all(list, row, base);
}

void list_own_cal(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	const struct meaning *instance = list_meaning(list, line->operand);
	uint32_t fetched[LIMIT_ARGS];
	int skip = -1, missing = -1;

	if (line->modifiers & MOD_C)
		skip = list_skip_call(list, line);
	else
		list_keep_all(list);
	list->now.kind = RESULT_NONE;
	missing = list_skip_missing(list, true, fetched);
	if (meaning_is_indexed(instance))
		call_element(list, instance, fetched);
	else
		call_instance(list, instance, fetched);
	list_end_skip(list, skip);
	list_end_skip(list, missing);
}

void list_routine(struct list *list, const struct pou *routine)
{
	const struct il_line *line = &list->il->line[list->at];
	int skip = -1;

	if (line->modifiers & MOD_C)
		skip = list_skip_call(list, line);
	else
		list_keep_all(list);
	list->now.kind = RESULT_NONE;
	emit_call(list, (uint32_t)(routine - list->as->translation->project->pou));
	list_end_skip(list, skip);
}

/* ---- functions ---- */

/* EN := x is a jump over the call; x is kept for ENO. */
static int skip_unless(struct list *list, struct bits *en)
{
	struct il_line jump = { .modifiers = MOD_C };
	uint32_t slot;

	if (en->count == 0 && en->table & 1)
		return -1;
	slot = scratch_new(list->as);
	bits_store(list->as, en, slot);
	*en = bits_leaf(list->as, slot);
	list->now.kind = RESULT_BITS;
	list->now.bits = *en;
	return list_skip_call(list, &jump);
}

static struct bits read_en(struct list *list)
{
	int at;
	const struct il_line *arg = find_arg(list, "EN", &at);

	return arg ? list_bits(list, list_meaning(list, arg->operand))
		   : bits_constant(true);
}

static void write_eno(struct list *list, const struct bits *en)
{
	int at, own = list->at;
	const struct il_line *arg = find_arg(list, "ENO", &at);

	if (!arg)
		return;
	list->at = at;
	list_write_bits(list, list_meaning(list, arg->operand), en);
	list->at = own;
}

/* The function's result is its first variable. */
static uint32_t result_at(const struct frame *frame, const struct word_row *row)
{
	return frame->offset + row->pin[0].offset;
}

static void take_result(struct list *list, const struct frame *frame,
			const struct word_row *row)
{
	int at, own = list->at;
	const struct il_line *arg = find_arg(list, words_result(row), &at);

	if (!arg || arg->kind != IL_ARG_OUT)
		return;
	list->at = at;
	take(list, result_at(frame, row), row->pin[0].type,
	     list_meaning(list, arg->operand));
	list->at = own;
}

/* A jump over the copy of the outputs, if the body made ENO FALSE; @en is FALSE then. If a
 * jump skips the call, @en has a place of its own already. */
static int skip_failed(struct list *list, const struct frame *frame,
		       const struct word_row *row, struct bits *en)
{
	const struct il_line jump = { .modifiers = MOD_C };
	struct bits eno = bits_leaf(list->as, frame->offset + row->pin[1].offset);
	uint32_t ok = en->count ? en->leaf[0] : scratch_new(list->as);

	bits_store(list->as, &eno, ok);
	*en = bits_leaf(list->as, ok);
	list->now.kind = RESULT_BITS;
	list->now.bits = *en;
	return list_skip_kept(list, &jump);
}

/* @en: also becomes FALSE if the body clears ENO. */
static void call_function(struct list *list, const uint32_t fetched[LIMIT_ARGS],
			  struct bits *en)
{
	enum word word = (enum word)list->il->line[list->at].word;
	const struct word_row *row = list_row(list, word);
	uint32_t entry;
	const struct frame *frame = layout_pou(list->as, word, &entry);
	int skip = -1;

	emit_block(list->as, frame->offset, frame->model, frame->size);
	feed_all(list, row, frame->offset, fetched);
	emit_call(list, entry);
	if (frame->eno)
		skip = skip_failed(list, frame, row, en);
	list->now.kind = RESULT_NONE;
	take_all(list, row, frame->offset);
	take_result(list, frame, row);
	list_end_skip(list, skip);
}

void list_own_call(struct list *list)
{
	uint32_t fetched[LIMIT_ARGS];
	struct bits en;
	int skip;

	list->now.kind = RESULT_NONE;
	en = read_en(list);
	if (list_is_whole_move(list)) {
		en = bits_leaf(list->as, list_whole_move(list, list_slot(list, &en)));
		write_eno(list, &en);
		return;
	}
	list_fetch_args(list, &en, fetched);
	list_keep_all(list);
	skip = skip_unless(list, &en);
	list->now.kind = RESULT_NONE;
	call_function(list, fetched, &en);
	list_end_skip(list, skip);
	write_eno(list, &en);
}

/* ---- functions on the result ---- */

static int next_input(const struct word_row *row, int index)
{
	do
		index++;
	while (index < row->pin_count && row->pin[index].dir != PIN_IN);
	return index;
}

/* The current result goes to a pin. */
static void feed_now(struct list *list, uint32_t to, const struct word_pin *pin)
{
	const struct il_result *now = &list->now;
	union iec_value value = { .i = 0 };
	struct bits bits;
	uint32_t from = now->operand;

	if (pin->type == IEC_BOOL) {
		bits = list_now_bits(list);
		bits_store(list->as, &bits, to);
		return;
	}
	if (now->kind == RESULT_LITERAL && pin->type == IEC_STRING) {
		from = CODE_OPERAND(IEC_STRING, layout_text(list->as,
							    now->literal));
	} else if (now->kind == RESULT_LITERAL) {
		literal_fit(now->literal, pin->type, &value);
		from = CODE_OPERAND(pin->type, layout_constant(list->as,
							       pin->type, value));
	}
	list_copy(list, CODE_OPERAND(pin->type, to), from);
}

/* The result is copied out of the frame, because the next call uses the frame again. */
static void result_now(struct list *list, uint32_t from, enum iec_type type)
{
	struct bits bits = bits_leaf(list->as, from);
	uint32_t slot;

	if (type == IEC_BOOL) {
		slot = scratch_new(list->as);
		bits_store(list->as, &bits, slot);
		list->now = (struct il_result){
			.kind = RESULT_BITS, .bits = bits_leaf(list->as, slot),
		};
		return;
	}
	slot = layout_tail(list->as, RUN_VALUES, type);
	list_copy(list, CODE_OPERAND(type, slot), CODE_OPERAND(type, from));
	list->now = (struct il_result){
		.kind = RESULT_NUMBER, .own = true,
		.operand = CODE_OPERAND(type, slot),
	};
}

void list_own_fn(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];
	enum word word = (enum word)line->word;
	const struct word_row *row = list_row(list, word);
	int pin = next_input(row, -1);
	uint32_t entry;
	const struct frame *frame = layout_pou(list->as, word, &entry);

	list_keep_all(list);
	emit_block(list->as, frame->offset, frame->model, frame->size);
	feed_now(list, frame->offset + row->pin[pin].offset, &row->pin[pin]);
	list->now.kind = RESULT_NONE;
	for (int i = list->at; i == list->at ? line->operand != 0 : is_arg(list, i);
	     i++) {
		pin = next_input(row, pin);
		feed(list, frame->offset + row->pin[pin].offset, &row->pin[pin],
		     list_meaning(list, list->il->line[i].operand), 0,
		     range_of(list, row, &row->pin[pin]));
	}
	emit_call(list, entry);
	result_now(list, result_at(frame, row), row->pin[0].type);
}
