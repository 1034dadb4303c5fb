/* SPDX-License-Identifier: MIT
 *
 * assemble_unit - turns instruction lists into instructions, and all of them into an image.
 *
 * It walks a list and keeps track of the current result. Bits stay truth tables until a
 * variable that they read is written; then they are stored (list_protect). The types were
 * checked; nothing is judged here.
 */
#include "engine/base/ascii.h"
#include "engine/translate/assembler.h"

#include "engine/model/st.h"
#include "engine/translate/lists.h"

#include <limits.h>
#include <string.h>

#define ALWAYS CODE_TRUE_AT(list->as->areas)

const struct meaning *list_meaning(struct list *list, uint32_t operand)
{
	enum diag_id why;

	return scope_find(list->as->translation->scope, list->pou, operand, &why);
}

void list_place(struct list *list)
{
	struct assembler *as = list->as;
	const struct il_line *line = &list->il->line[list->at];
	struct code_place *place;

	place = arena_push(as->arena, &as->place, &as->place_count,
			   sizeof(*place));
	if (!place) {
		as->failed = true;
		return;
	}
	*place = (struct code_place){
		.text = (uint32_t)(as->code.count +
				   (as->text == &as->watch ? as->watch.count : 0)),
		.pou = (uint32_t)(list->unit - as->translation->unit),
		.rung = line->rung, .row = line->row, .col = line->col,
	};
	if (!line->rung) {
		place->rung = line->line;
		place->row = 0;
		place->col = CODE_LINE;
	}
}

/* ---- values that wait ---- */

static struct pending *find_pending(struct list *list, int var)
{
	for (int i = 0; i < list->pending_count; i++)
		if (list->pending[i].var == var)
			return &list->pending[i];
	return NULL;
}

static void drop_pending(struct list *list, struct pending *pending)
{
	*pending = list->pending[--list->pending_count];
}

static struct bits set_aside(struct list *list, struct bits value)
{
	uint32_t slot = scratch_new(list->as);

	bits_store(list->as, &value, slot);
	return bits_leaf(list->as, slot);
}

void list_protect(struct list *list, uint32_t offset, uint32_t size)
{
	if (list->now.kind == RESULT_BITS &&
	    bits_reads(&list->now.bits, offset, size))
		list->now.bits = set_aside(list, list->now.bits);
	for (int i = 0; i < list->depth; i++)
		if (list->opened[i].left.kind == RESULT_BITS &&
		    bits_reads(&list->opened[i].left.bits, offset, size))
			list->opened[i].left.bits =
				set_aside(list, list->opened[i].left.bits);
	for (int i = 0; i < list->pending_count; i++)
		if (bits_reads(&list->pending[i].value, offset, size))
			list->pending[i].value =
				set_aside(list, list->pending[i].value);
}

void list_keep_all(struct list *list)
{
	for (int i = 0; i < list->depth; i++)
		if (list->opened[i].left.kind == RESULT_BITS)
			list->opened[i].left.bits =
				set_aside(list, list->opened[i].left.bits);
	for (int i = 0; i < list->pending_count; i++)
		list->pending[i].value = set_aside(list,
						   list->pending[i].value);
}

static struct spot spot_of(struct list *list, const struct meaning *m)
{
	return layout_spot(list->as, m);
}

/* From here on the variable's own memory holds its value. */
static struct bits settle(struct list *list, struct pending *pending,
			  const struct meaning *m)
{
	struct spot spot = spot_of(list, m);
	struct bits value = pending->value;

	drop_pending(list, pending);
	list_protect(list, spot.offset, 1);
	bits_store(list->as, &value, spot.offset);
	return bits_leaf(list->as, spot.offset);
}

static struct bits read_temp(struct list *list, int var, const struct meaning *m)
{
	struct pending *pending = find_pending(list, var);
	struct bits value;

	if (!pending)
		return bits_leaf(list->as, spot_of(list, m).offset);
	value = pending->value;
	pending->left--;
	if (pending->left > 0 && value.count > 1)
		return settle(list, pending, m);
	if (pending->left <= 0)
		drop_pending(list, pending);
	return value;
}

struct bits list_bits(struct list *list, const struct meaning *m)
{
	int var = list_temp(list, m);
	struct spot spot;
	uint32_t slot;

	if (m->kind == MEANING_LITERAL)
		return bits_constant(m->literal.value.i != 0);
	if (meaning_is_indexed(m))
		return bits_leaf(list->as, CODE_OFFSET(list_fetch(list, m, ALWAYS, &slot)));
	if (var >= 0)
		return read_temp(list, var, m);
	spot = spot_of(list, m);
	if (!spot.packed)
		return bits_leaf(list->as, spot.offset);
	slot = scratch_new(list->as);
	emit_op(list->as, VM_BITGET, spot.bit);
	emit(list->as, spot.offset);
	emit(list->as, slot);
	return bits_leaf(list->as, slot);
}

uint32_t list_slot(struct list *list, const struct bits *value)
{
	const struct areas *areas = list->as->areas;
	struct bits kept;

	if (value->count == 0)
		return value->table & 1 ? CODE_TRUE_AT(areas)
					: CODE_FALSE_AT(areas);
	kept = bits_keep(list->as, value);
	return kept.leaf[0];
}

static bool reads_slot(const struct il_result *result, uint32_t slot)
{
	return result->kind == RESULT_BITS && bits_reads(&result->bits, slot, 1);
}

/* Does a waiting value read this slot? */
static bool is_awaited(const struct list *list, uint32_t slot)
{
	bool found = reads_slot(&list->now, slot);

	for (int i = 0; i < list->depth; i++)
		found |= reads_slot(&list->opened[i].left, slot);
	for (int i = 0; i < list->pending_count; i++)
		found |= bits_reads(&list->pending[i].value, slot, 1);
	return found;
}

/* A bit that only @value reads is stored by the instruction that makes it. */
static void store_at(struct list *list, const struct bits *value, uint32_t offset)
{
	uint32_t slot = bits_made(list->as);

	if (!slot || is_awaited(list, slot) ||
	    !bits_store_made(list->as, value, offset))
		bits_store(list->as, value, offset);
}

uint32_t list_keep(struct list *list, const struct bits *value)
{
	uint32_t slot;

	if (value->count == 0 || bits_is_leaf(value))
		return list_slot(list, value);
	slot = scratch_new(list->as);
	store_at(list, value, slot);
	return slot;
}

/* A temporary: kept as a truth table if it is read later. */
static void write_temp(struct list *list, int var, const struct bits *value)
{
	struct pending *pending = find_pending(list, var);
	int reads = list->reads[list->at];

	if (pending)
		drop_pending(list, pending);
	if (reads == 0)
		return;
	if (list->pending_count == PENDING_MAX) { /* then in its own memory */
		struct meaning m = { .kind = MEANING_VARIABLE,
			.type = IEC_BOOL, .pou = list->pou, .index = var };
		struct spot spot = spot_of(list, &m);

		list_protect(list, spot.offset, 1);
		bits_store(list->as, value, spot.offset);
		return;
	}
	list->pending[list->pending_count++] = (struct pending){
		.var = var, .left = reads, .value = *value,
	};
}

void list_write_bits(struct list *list, const struct meaning *m,
		     const struct bits *value)
{
	int var = list_temp(list, m);
	struct spot spot;
	struct bits copy = *value;

	if (var >= 0) {
		write_temp(list, var, value);
		return;
	}
	if (meaning_is_indexed(m)) {
		list_deposit(list, m, ALWAYS,
			     CODE_OPERAND(IEC_BOOL, list_slot(list, value)));
		return;
	}
	spot = spot_of(list, m);
	if (spot.packed) {
		uint32_t slot = list_slot(list, value);

		emit_op(list->as, VM_BITPUT, spot.bit);
		emit(list->as, slot);
		emit(list->as, spot.offset);
		return;
	}
	list_protect(list, spot.offset, 1);
	bits_store(list->as, &copy, spot.offset);
}

/* ---- numbers ---- */

uint32_t list_number(struct list *list, const struct meaning *m,
		     enum iec_type type)
{
	union iec_value value = { .i = 0 };
	struct spot spot;
	uint32_t ok;

	if (m->kind == MEANING_LITERAL) {
		if (m->type != IEC_NONE)
			type = m->type;
		if (type == IEC_STRING)
			return CODE_OPERAND(type, layout_text(list->as,
							      &m->literal));
		literal_fit(&m->literal, type, &value);
		return CODE_OPERAND(type, layout_constant(list->as, type, value));
	}
	if (m->type == IEC_BOOL) {
		struct bits bits = list_bits(list, m);

		return CODE_OPERAND(IEC_BOOL, list_slot(list, &bits));
	}
	if (meaning_is_indexed(m))
		return list_fetch(list, m, ALWAYS, &ok);
	spot = spot_of(list, m);
	return CODE_OPERAND(spot.type, spot.offset);
}

void list_copy(struct list *list, uint32_t to, uint32_t from)
{
	list_copy_if(list, ALWAYS, to, from);
}

/* Does the next line still use the result? */
static bool result_goes_on(const struct list *list)
{
	for (int i = list->at + 1; i < list->il->count; i++) {
		const struct il_line *line = &list->il->line[i];

		if (line->kind == IL_COMMENT)
			continue;
		return line->kind == IL_FN || line->kind == IL_CLOSE ||
		       (line->kind == IL_OP && line->op != OP_LD);
	}
	return false;
}

/* The result, a number or a constant, as a typed word. */
static uint32_t result_as(struct list *list, enum iec_type type)
{
	union iec_value value = { .i = 0 };

	if (list->now.kind != RESULT_LITERAL)
		return list->now.operand;
	if (type == IEC_STRING)
		return CODE_OPERAND(type, layout_text(list->as,
						      list->now.literal));
	literal_fit(list->now.literal, type, &value);
	return CODE_OPERAND(type, layout_constant(list->as, type, value));
}

/* The instruction before stores its result at @to itself, and not in a place of its own;
 * from here on the result is what lies there. False: it does not make the result, or that
 * is a text, which may have less room there. */
static bool store_made(struct list *list, uint32_t to)
{
	struct assembler *as = list->as;
	struct il_result *now = &list->now;
	uint32_t *word = as->open_number < 0 ? NULL : &as->text->word[as->open_number];

	if (!word || now->kind != RESULT_NUMBER || !now->own ||
	    CODE_TYPE(to) != CODE_TYPE(now->operand) || CODE_TYPE(to) == IEC_STRING ||
	    CODE_OFFSET(*word) != CODE_OFFSET(now->operand))
		return false;
	*word += CODE_OFFSET(to) - CODE_OFFSET(*word);
	bits_end(as);
	now->operand = to;
	now->own = false;
	return true;
}

static void store_number(struct list *list, const struct meaning *m)
{
	struct il_result *now = &list->now;
	struct spot spot = spot_of(list, m);
	uint32_t to = CODE_OPERAND(spot.type, spot.offset);

	if (meaning_is_indexed(m) || (meaning_is_ranged(m) && now->kind != RESULT_LITERAL)) {
		list_deposit(list, m, ALWAYS, result_as(list, m->type));
		return;
	}
	if (now->kind == RESULT_LITERAL) {
		list_copy(list, to, result_as(list, m->type));
		return;
	}
	if (store_made(list, to))
		return;
	if (!now->own && result_goes_on(list)) {
		enum iec_type type = (enum iec_type)CODE_TYPE(now->operand);
		uint32_t slot = layout_tail(list->as, RUN_VALUES, type);

		list_copy(list, CODE_OPERAND(type, slot), now->operand);
		now->operand = CODE_OPERAND(type, slot);
		now->own = true;
	}
	list_copy(list, to, now->operand);
}

/* ---- operators ---- */

void list_load(struct list *list, const struct il_line *line)
{
	const struct meaning *m = list_meaning(list, line->operand);
	bool bits = iec_type_row(m->type)->class & CLASS_BITS;

	list->now = (struct il_result){ .kind = RESULT_NUMBER };
	if (meaning_is_whole(m))
		list_load_result(list, m);
	else if (m->type == IEC_BOOL || (line->modifiers & MOD_N && !bits)) {
		list->now.kind = RESULT_BITS;
		list->now.bits = list_bits(list, m);
		if (line->modifiers & MOD_N)
			list->now.bits = bits_not(list->now.bits);
	} else if (m->kind == MEANING_LITERAL) {
		list->now.kind = RESULT_LITERAL;
		list->now.literal = &m->literal;
	} else {
		list->now.operand = list_number(list, m, m->type);
		list->now.own = meaning_is_indexed(m);
	}
	if (bits && line->modifiers & MOD_N)
		list_invert(list, m->type);
}

/* An untyped 0 or 1 where a bit is wanted; it may still become a number. */
struct bits list_now_bits(const struct list *list)
{
	if (list->now.kind == RESULT_LITERAL)
		return bits_constant(list->now.literal->value.i != 0);
	return list->now.bits;
}

/* A temporary whose value is also the result for the next line is stored at once; otherwise
 * both would be computed. */
static bool is_wanted_twice(const struct list *list, const struct bits *value)
{
	return value->count > 1 && list->reads[list->at] > 0 &&
	       result_goes_on(list);
}

/* Into the variable's own memory, also for a temporary. */
static void store_bits(struct list *list, const struct meaning *m,
		       const struct bits *value)
{
	int var = list_temp(list, m);
	struct pending *pending = var >= 0 ? find_pending(list, var) : NULL;
	uint32_t offset = spot_of(list, m).offset;

	if (pending)
		drop_pending(list, pending);
	list_protect(list, offset, 1);
	store_at(list, value, offset);
}

/* STN of bits; the result does not change. */
static void store_inverse(struct list *list, const struct meaning *m)
{
	struct il_result now = list->now;

	list_invert(list, now.kind == RESULT_NUMBER ?
		    (enum iec_type)CODE_TYPE(now.operand) : m->type);
	store_number(list, m);
	list->now = now;
}

static void store(struct list *list, const struct il_line *line)
{
	const struct meaning *m = list_meaning(list, line->operand);
	struct bits value;

	list_unshift(list, m);
	if (list->now.kind == RESULT_WHOLE) {
		list_store_result(list, m);
		return;
	}
	if (m->type != IEC_BOOL) {
		if (line->modifiers & MOD_N) /* for this once */
			store_inverse(list, m);
		else
			store_number(list, m);
		return;
	}
	value = list_now_bits(list);
	if (line->modifiers & MOD_N)
		value = bits_not(value);
	if (list->now.kind == RESULT_LITERAL || meaning_is_indexed(m) ||
	    spot_of(list, m).packed ||
	    (list_temp(list, m) >= 0 && !is_wanted_twice(list, &value))) {
		list_write_bits(list, m, &value);
		return;
	}
	/* From here on the result is the stored variable: one leaf. */
	list->now.kind = RESULT_NONE;
	store_bits(list, m, &value);
	list->now.kind = RESULT_BITS;
	list->now.bits = bits_leaf(list->as, spot_of(list, m).offset);
	if (line->modifiers & MOD_N)
		list->now.bits = bits_not(list->now.bits);
}

static void set_reset(struct list *list, const struct il_line *line)
{
	const struct meaning *m = list_meaning(list, line->operand);
	struct bits old, value;

	if (meaning_is_indexed(m)) {
		value = list_now_bits(list);
		list_deposit(list, m, list_slot(list, &value),
			     CODE_OPERAND(IEC_BOOL, line->op == OP_S ? ALWAYS :
					  CODE_FALSE_AT(list->as->areas)));
		return;
	}
	old = list_bits(list, m);
	/* S: old or now. R: old and not now. */
	value = bits_combine(list->as, old, list_now_bits(list),
			     line->op == OP_S ? 0xe : 0x2);
	list_write_bits(list, m, &value);
}

/* ---- the walk ---- */

/* ---- safe points ---- */

static int unit_number(const struct list *list)
{
	return (int)(list->unit - list->as->translation->unit);
}

/* Is this line the first one of a rung, or of a statement of a list? Lines that translation
 * makes belong to the rung before them. */
static bool begins(const struct list *list)
{
	const struct il_line *line = &list->il->line[list->at], *before = line - 1;

	if (list->at == 0)
		return true;
	if (before->kind == IL_LABEL)
		return line->rung || line->line;
	return line->rung ? line->rung != before->rung :
			    line->line != 0 && line->line != before->line;
}

/* Does a jump behind this line lead back to it? */
static bool begins_loop(const struct list *list)
{
	int at = list->at - 1;

	while (at >= 0 && list->il->line[at].kind == IL_COMMENT)
		at--;
	return at >= 0 && list->il->line[at].kind == IL_LABEL &&
	       list_jumps_back(list, &list->il->line[at]);
}

/* The words of the last one are known: the code has got so far. */
static void close_point(struct assembler *as)
{
	struct point *point = as->open_point < 0 ? NULL : &as->point[as->open_point];

	if (!point || as->text != &as->code)
		return;
	point->words = (uint32_t)as->code.count - point->at;
	as->code.word[point->at] |= point->words << 8;
	as->open_point = -1;
}

static void make_point(struct list *list, uint32_t rung, uint32_t line, bool loop)
{
	struct assembler *as = list->as;
	struct point *point;

	close_point(as);
	point = arena_push(as->arena, &as->point, &as->point_count, sizeof(*point));
	if (!point) {
		as->failed = true;
		return;
	}
	as->open_point = as->point_count - 1;
	*point = (struct point){ unit_number(list), rung, line, (uint32_t)as->code.count, 0, loop };
	emit_op(as, VM_POINT, 0);
}

/* In the unwatched section: far enough from the last one, or where a loop begins. In the
 * watched section: where the unwatched one has it. */
static void place_point(struct list *list, uint32_t rung, uint32_t line)
{
	struct assembler *as = list->as;
	const struct point *next;
	const bool loop = list->at > 0 && begins_loop(list);

	if (as->text == &as->code) {
		if (as->open_point < 0 || loop ||
		    (uint32_t)as->code.count - as->point[as->open_point].at >= POINT_APART)
			make_point(list, rung, line, loop);
		return;
	}
	next = as->open_point < 0 ? NULL : &as->point[as->open_point];
	if (!next || next->unit != unit_number(list) || next->rung != rung || next->line != line ||
	    next->loop != loop)
		return;
	emit_op(as, VM_POINT, next->words);
	as->open_point = as->open_point + 1 < as->point_count ? as->open_point + 1 : -1;
}

/* Between statements nothing waits in scratch slots: they may be used again, also by a task
 * that interrupts this one. */
static void begin_statement(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];

	if (list->depth > 0 || list->pending_count > 0)
		return;
	list->as->scratch_used = 0;
	memset(list->as->likely, 0, sizeof(list->as->likely));
	if (list->as->pointed[unit_number(list)] && !(line->mark & IL_WATCHING) && begins(list))
		place_point(list, line->rung, line->line);
}

static void assemble_op(struct list *list, const struct il_line *line)
{
	switch ((enum op)line->op) {
	case OP_LD:
		list_load(list, line);
		break;
	case OP_ST:
		store(list, line);
		break;
	case OP_S:
	case OP_R:
		set_reset(list, line);
		break;
	case OP_AND:
	case OP_OR:
	case OP_XOR:
		list_logic(list, line);
		break;
	case OP_NOT:
		list_not(list);
		break;
	case OP_JMP:
	case OP_RET:
		list_flow(list, line);
		break;
	case OP_CAL:
		if (begins_loop(list))
			begin_statement(list);
		list_cal(list);
		break;
	case OP_STP:
		list_stop(list, line);
		break;
	case OP_COUNT:
		break;
	}
}

/* ---- the current result after each line, while watched ---- */

/* Of a written list, of Structured Text, and of both in a chart. */
static bool keeps_results(const struct list *list)
{
	const bool lines = list->pou->il.count > 0 &&
		(list->pou->language == LANGUAGE_IL || list->pou->language == LANGUAGE_SFC);

	return list->as->watching && (lines || (list->pou->st && list->pou->st->count > 0));
}

static uint32_t bit_of(enum st_kind kind)
{
	return 1u << kind;
}

/* The kinds of the statements that begin in a line, as bits; 0: none does. @from: where to look first, and where the
 * next line is likely. */
static uint32_t st_kinds_in(const struct st *st, uint32_t line, int *from)
{
	int low = 0, high = st ? st->count : 0;
	uint32_t kinds = 0;

	if (*from > 0 && *from < high && (uint32_t)st->item[*from - 1].line < line &&
	    (uint32_t)st->item[*from].line >= line)
		low = high = *from;
	while (low < high) {
		const int middle = low + (high - low) / 2;

		if ((uint32_t)st->item[middle].line < line)
			low = middle + 1;
		else
			high = middle;
	}
	for (; st && low < st->count && (uint32_t)st->item[low].line == line; low++)
		kinds |= bit_of((enum st_kind)st->item[low].kind);
	*from = low;
	return kinds;
}

/* The same of a line of @list: most instructions are of the same line as the one before. */
static uint32_t kinds_of(struct list *list, uint32_t line)
{
	if (line != list->kinds_line || !list->kinds_line) {
		list->kinds = st_kinds_in(list->pou->st, line, &list->kinds_item);
		list->kinds_line = line;
	}
	return list->kinds;
}

/* Lines that do something: not those that only end a block. */
static bool st_does(uint32_t kinds)
{
	return kinds & ~(bit_of(ST_ELSE) | bit_of(ST_END_IF) | bit_of(ST_END_CASE) |
			 bit_of(ST_END_FOR) | bit_of(ST_END_WHILE) | bit_of(ST_REPEAT) |
			 bit_of(ST_LABEL) | bit_of(ST_EMPTY) | bit_of(ST_COMMENT));
}

/* Has its line one value that a person looks for: what is stored, or a condition? */
static bool st_has_value(uint32_t kinds)
{
	const uint32_t most = kinds & ~(bit_of(ST_COMMENT) | bit_of(ST_EMPTY));

	return most == bit_of(ST_ASSIGN) || most == bit_of(ST_IF) || most == bit_of(ST_ELSIF) ||
	       most == bit_of(ST_WHILE) || most == bit_of(ST_UNTIL);
}

/* The jump behind the branch above ELSIF has the line of the ELSIF, which did not run for it. */
static bool st_runs(const struct il_line *line, uint32_t kinds)
{
	if (line->kind == IL_LABEL)
		return false;
	return line->kind != IL_OP || line->op != OP_JMP || line->modifiers & MOD_C ||
	       kinds & (bit_of(ST_EXIT) | bit_of(ST_CONTINUE) | bit_of(ST_JUMP));
}

static struct frame *frame_of(const struct list *list)
{
	return &list->as->frame[list->unit - list->as->translation->unit];
}


/* First pass: room for the number of the result of each line of the POU. */
static bool make_slots(struct list *list)
{
	const struct il *il = &list->pou->il;
	const struct st *st = list->pou->st;
	const int statements = st ? st->count : 0;
	struct frame *frame = frame_of(list);
	uint32_t last = statements ? (uint32_t)st->item[statements - 1].line : 0;

	if (!keeps_results(list) || frame->slot_of)
		return true;
	frame->first_line = statements ? (uint32_t)st->item[0].line : UINT32_MAX;
	for (int i = 0; i < il->count; i++) {
		frame->first_line = il->line[i].line < frame->first_line ? il->line[i].line :
				    frame->first_line;
		last = il->line[i].line > last ? il->line[i].line : last;
	}
	frame->lines = last - frame->first_line + 1;
	frame->slot_of = arena_alloc(list->as->arena, ((size_t)frame->lines + 1) *
				     sizeof(*frame->slot_of));
	for (int i = 0; frame->slot_of && i < il->count; i++)
		frame->slot_of[il->line[i].line - frame->first_line] = SLOT_FREE;
	for (int i = 0; frame->slot_of && i < statements; i++)
		if (st_does(bit_of((enum st_kind)st->item[i].kind)))
			frame->slot_of[(uint32_t)st->item[i].line - frame->first_line] = SLOT_FREE;
	return frame->slot_of;
}

/* Of a line that is written in a list; NULL: it is not. A chart copies a list to each place
 * where it runs, among lines that translation makes. */
static int *slot_of_line(const struct frame *frame, uint32_t line)
{
	int *slot = line - frame->first_line < frame->lines ?
		    &frame->slot_of[line - frame->first_line] : NULL;

	return slot && *slot != SLOT_NONE ? slot : NULL;
}

/* A chart copies a list to each place where it runs, among lines that translation makes. */
static bool is_written(const struct list *list, const struct il_line *line)
{
	return line->line > 0 && !line->rung &&
	       !(list->pou->language == LANGUAGE_SFC && line->mark & IL_MADE);
}

static bool is_instruction(const struct il_line *line)
{
	switch ((enum il_kind)line->kind) {
	case IL_OP:
	case IL_FN:
	case IL_CLOSE:
	case IL_LABEL:
	case IL_CALL:
		return true;
	case IL_ARG_IN:
	case IL_ARG_OUT:
	case IL_COMMENT:
	case IL_EACH:
	case IL_TARGET:
	case IL_TICK:
		break;
	}
	return false;
}

static enum iec_type result_type(const struct il_result *now)
{
	switch (now->kind) {
	case RESULT_BITS:
		return IEC_BOOL;
	case RESULT_NUMBER:
		return (enum iec_type)CODE_TYPE(now->operand);
	case RESULT_LITERAL:
		return now->literal->type != IEC_NONE ? now->literal->type :
		       now->literal->real ? IEC_LREAL :
		       now->literal->high ? IEC_ULINT : IEC_LINT;
	case RESULT_NONE:
	case RESULT_WHOLE:
		break;
	}
	return IEC_NONE;
}

/* First pass: which lines there are, and the types of their results. A label and an instruction
 * may share a line: the last one counts. */
static void note_result(struct list *list, struct frame *frame, int *slot, uint32_t line)
{
	const uint32_t kinds = kinds_of(list, line);

	if (*slot == SLOT_FREE && !arena_push(list->as->arena, &frame->result,
					      &frame->result_count, sizeof(*frame->result))) {
		list->as->failed = true;
		return;
	}
	if (*slot == SLOT_FREE)
		*slot = frame->result_count;
	frame->result[*slot - 1] = (struct result){ .line = line,
		.type = kinds && !st_has_value(kinds) ? IEC_NONE : result_type(&list->now) };
}

/* Second pass: into the places that they have got. */
static void store_result(struct list *list, const struct result *result, bool always)
{
	const struct bits yes = bits_constant(true);

	if (!always)
		bits_store(list->as, &yes, result->ran);
	if (result->kept || result->type == IEC_NONE || result->type != result_type(&list->now))
		return;
	if (list->now.kind == RESULT_BITS)
		bits_store(list->as, &list->now.bits, result->at);
	else
		list_copy(list, CODE_OPERAND(result->type, result->at),
			  list_operand(list, &list->now, result->type));
}

/* Of a line that a person wrote. */
static void keep_written(struct list *list, const struct il_line *line)
{
	struct frame *frame = frame_of(list);
	int *slot = keeps_results(list) && is_written(list, line) ?
		    slot_of_line(frame, line->line) : NULL;

	if (!slot || (kinds_of(list, line->line) && !st_runs(line, kinds_of(list, line->line))))
		return;
	if (list->as->text != &list->as->watch)
		note_result(list, frame, slot, line->line);
	else if (*slot != SLOT_FREE)
		store_result(list, &frame->result[*slot - 1], false);
}

/* ---- the same of the list that a ladder or a chart becomes ---- */

/* The instructions behind it may be skipped; the current result does not change. */
static bool leaves(const struct il_line *line)
{
	return line->kind == IL_OP && (line->op == OP_JMP || line->op == OP_RET);
}

/* Does each line run whenever the first one does? */
static bool always_runs(const struct il *il)
{
	for (int i = 0; i < il->count; i++)
		if (il->line[i].kind == IL_LABEL || il->line[i].kind == IL_EACH ||
		    leaves(&il->line[i]))
			return false;
	return true;
}

/* What the line leaves as its result. Before a jump that nothing decides there may be one that is
 * read no more, and watching does not keep that. */
static enum iec_type type_after(const struct list *list, const struct il_line *line)
{
	return leaves(line) && !(line->modifiers & MOD_C) ? IEC_NONE : result_type(&list->now);
}

/* Does the line leave the current result as it was? Only of lines that always run. */
static bool is_kept(const struct frame *frame, const struct il_line *line, enum iec_type type)
{
	return frame->always && line->kind == IL_OP && frame->listed_count > 0 &&
	       (line->op == OP_ST || line->op == OP_S || line->op == OP_R) &&
	       type != IEC_NONE && frame->listed[frame->listed_count - 1].type == type;
}

static void note_listed(struct list *list, struct frame *frame, const struct il_line *line)
{
	const enum iec_type type = type_after(list, line);
	const struct result result = { .line = list->number, .type = type,
				       .kept = is_kept(frame, line, type) };
	struct result *listed = arena_push(list->as->arena, &frame->listed,
					   &frame->listed_count, sizeof(*listed));

	if (listed)
		*listed = result;
	else
		list->as->failed = true;
}

static bool is_listed(const struct list *list, const struct il_line *line)
{
	return list->as->listing && list->pou->language != LANGUAGE_IL && !(line->mark & IL_WATCHING);
}

/* Both sections have the same lines, but for those that keep power. */
static void keep_listed(struct list *list, const struct il_line *line)
{
	struct frame *frame = frame_of(list);

	if (!is_listed(list, line))
		return;
	list->number++;
	if (list->as->text != &list->as->watch)
		note_listed(list, frame, line);
	else if (list->number <= (uint32_t)frame->listed_count)
		store_result(list, &frame->listed[list->number - 1], frame->always);
}

/* ---- what a call of a network leaves: its OUT ---- */

static bool is_argument(const struct il_line *line)
{
	return line->kind == IL_ARG_IN || line->kind == IL_ARG_OUT;
}

static const char *pin_text(const struct list *list, int line)
{
	return names_text(&list->as->translation->project->names, list->il->line[line].pin);
}

/* The variable at OUT of a box, after the last line of its call; NULL: no such line, or its value is of no plain type. */
static const struct meaning *made_out(struct list *list)
{
	const struct il *il = list->il;
	int call = list->at, out = -1;
	const struct meaning *m;

	if (!is_argument(&il->line[call]) || (call + 1 < il->count && is_argument(&il->line[call + 1])))
		return NULL;
	for (; call > 0 && is_argument(&il->line[call]); call--)
		if (il->line[call].kind == IL_ARG_OUT &&
		    ascii_is("OUT", pin_text(list, call), strlen(pin_text(list, call))))
			out = call;
	if (out < 0 || il->line[call].kind != IL_CALL || !il->line[call].made || il->line[call].mark & IL_INDEX ||
	    !is_listed(list, &il->line[call]))
		return NULL;
	m = list_meaning(list, il->line[out].operand);
	return m && m->kind == MEANING_VARIABLE && !meaning_is_indexed(m) && !meaning_is_whole(m) &&
	       m->type != IEC_STRING && m->type != IEC_NONE ? m : NULL;
}

/* Looks at a BOOL that may still wait, and takes it away from nobody. */
static struct bits out_bits(struct list *list, const struct meaning *m)
{
	const int var = list_temp(list, m);
	const struct pending *pending = var >= 0 ? find_pending(list, var) : NULL;

	return pending ? pending->value : bits_leaf(list->as, spot_of(list, m).offset);
}

/* Into the place of the result of the call's own line. */
static void keep_made(struct list *list)
{
	const struct meaning *m = made_out(list);
	struct frame *frame = frame_of(list);
	struct result *result = m && list->number > 0 && list->number <= (uint32_t)frame->listed_count ?
				&frame->listed[list->number - 1] : NULL;
	struct bits value;

	if (!result || spot_of(list, m).packed)
		return;
	if (list->as->text != &list->as->watch) {
		result->type = m->type;
	} else if (result->type != m->type) {
		return;
	} else if (m->type == IEC_BOOL) {
		value = out_bits(list, m);
		bits_store(list->as, &value, result->at);
	} else {
		list_copy(list, CODE_OPERAND(m->type, result->at), CODE_OPERAND(m->type, spot_of(list, m).offset));
	}
}

static void keep_result(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];

	keep_made(list);
	if (!is_instruction(line))
		return;
	keep_written(list, line);
	keep_listed(list, line);
}

/* Before the first line no line has run. */
static void clear_results(struct list *list)
{
	struct assembler *as = list->as;
	struct frame *frame = frame_of(list);

	frame->always = always_runs(&list->unit->il);
	if (as->text != &as->watch)
		return;
	if (frame->result_count)
		emit_block(as, frame->result[0].ran, as->not_run,
			   (uint32_t)frame->result_count);
	if (frame->listed_count && !frame->always)
		emit_block(as, frame->listed[0].ran, as->not_run,
			   (uint32_t)frame->listed_count);
}

static void assemble_one(struct list *list)
{
	const struct il_line *line = &list->il->line[list->at];

	switch ((enum il_kind)line->kind) {
	case IL_OP:
		assemble_op(list, line);
		break;
	case IL_FN:
		list_fn(list, line);
		break;
	case IL_CLOSE:
		list_close(list);
		break;
	case IL_LABEL:
		list_label(list, line);
		break;
	case IL_CALL:
		if (begins_loop(list))
			begin_statement(list);
		list_call(list);
		break;
	case IL_EACH:
		list_each(list);
		break;
	case IL_TICK:
		list_tick(list);
		break;
	case IL_ARG_OUT:
		list_take_out(list);
		break;
	case IL_TARGET:
	case IL_ARG_IN:
	case IL_COMMENT:
		break;
	}
}

/* The lines of a SWITCH; their results have their places as those of other lines have. */
static void assemble_choices(struct list *list, int lines)
{
	const struct il_result number = list->now;
	const struct il_result found = { .kind = RESULT_BITS, .bits = bits_constant(false) };

	for (int end = list->at + lines; ; list->at++) {
		const struct il_line *line = &list->il->line[list->at];

		list->now = line->kind == IL_OP && line->op != OP_JMP ? number : found;
		keep_result(list);
		if (list->at + 1 == end)
			return;
	}
}

/* ---- where the simulation can stand ---- */

#define ST_STANDS (bit_of(ST_ASSIGN) | bit_of(ST_CALL) | bit_of(ST_IF) | bit_of(ST_ELSIF) | \
		   bit_of(ST_CASE) | bit_of(ST_FOR) | bit_of(ST_END_FOR) | bit_of(ST_WHILE) | \
		   bit_of(ST_UNTIL) | bit_of(ST_EXIT) | bit_of(ST_CONTINUE) | bit_of(ST_RETURN) | \
		   bit_of(ST_JUMP))

/* The statement that a line was made of: its first instruction may be of a part further down. */
static const struct st_item *st_item_of(const struct st *st, const struct il_line *line)
{
	const int column = line->col ? line->col : INT_MAX;
	int low = 0, high = st->count;

	while (low < high) {
		const int middle = low + (high - low) / 2;
		const struct st_item *item = &st->item[middle];

		if ((uint32_t)item->line < line->line ||
		    ((uint32_t)item->line == line->line && item->column <= column))
			low = middle + 1;
		else
			high = middle;
	}
	while (low > 0 && !(bit_of((enum st_kind)st->item[low - 1].kind) & ST_STANDS))
		low--;
	return low > 0 ? &st->item[low - 1] : NULL;
}

/* While listing, an instruction begins there, and a place has the column of the statement as its
 * row. */
static void stand_here(struct list *list)
{
	struct assembler *as = list->as;
	const struct il_line *line = &list->il->line[list->at];
	const struct st_item *item;
	struct code_place *place;

	if (!as->listing || as->text != &as->watch || !(line->mark & IL_BEGINS))
		return;
	item = st_item_of(list->pou->st, line);
	bits_end(as);
	list_place(list);
	place = &as->place[as->place_count - 1];
	if (as->failed || !item)
		return;
	place->rung = (uint32_t)item->line;
	place->row = (uint16_t)(item->column < UINT16_MAX ? item->column : UINT16_MAX);
}

static void assemble_line(struct list *list)
{
	const bool before = leaves(&list->il->line[list->at]);
	int choices;

	stand_here(list);
	if (list->il->line[list->at].kind == IL_OP && list->il->line[list->at].op == OP_LD) {
		begin_statement(list);
		choices = list_choices(list);
		if (choices) {
			assemble_choices(list, choices);
			return;
		}
	}
	if (before)
		keep_result(list);
	assemble_one(list);
	if (!before)
		keep_result(list);
}

/** assemble_unit - the instructions of one list, with END behind them. */
static bool assemble_unit(struct assembler *as, int unit, bool watch)
{
	const struct unit *u = &as->translation->unit[unit];
	struct list *list = arena_alloc(as->arena, sizeof(*list));
	struct frame *frame = &as->frame[unit];
	uint32_t end;

	if (!list)
		return false;
	list->as = as;
	list->unit = u;
	list->pou = u->pou;
	list->il = watch && u->watch.count ? &u->watch : &u->il;
	list->types = watch && u->watch.count ? u->watch_types : u->types;
	list->straight = u->pou->kind == POU_PROGRAM && !as->called[unit];
	as->slots = list->straight ? &as->program_slots : &frame->slots;
	bits_end(as);
	as->scratch_used = 0;
	if (!list_find_labels(list) || !list_count_reads(list) || !make_slots(list))
		return false;
	if (as->pointed[unit])
		place_point(list, 0, 0);
	if (frame->temps_size)
		emit_block(as, frame->temps, frame->temps_model,
			   frame->temps_size);
	clear_results(list);
	for (; list->at < list->il->count && !as->failed; list->at++)
		assemble_line(list);
	end = (uint32_t)as->text->count;
	emit_op(as, VM_END, 0);
	close_point(as);
	if (!as->failed)
		list_patch(list, end);
	return !as->failed;
}

static bool assemble_section(struct assembler *as, bool watch)
{
	as->text = watch ? &as->watch : &as->code;
	as->open_point = watch && as->point_count ? 0 : -1;
	for (int i = 0; i < as->translation->unit_count; i++) {
		struct code_program *entry = &as->entry[i];
		uint32_t first = (uint32_t)as->text->count;

		if (!assemble_unit(as, i, watch))
			return false;
		if (watch) {
			entry->watch = first;
			entry->watch_words = (uint32_t)as->text->count - first;
		} else {
			entry->text = first;
			entry->text_words = (uint32_t)as->text->count - first;
		}
	}
	return true;
}

/* Which programs and subroutines another list calls. */
static bool find_called(struct assembler *as)
{
	struct translation *t = as->translation;
	const struct pou *to;

	as->called = arena_alloc(as->arena, (size_t)t->unit_count + 1);
	if (!as->called)
		return false;
	for (int i = 0; i < t->unit_count; i++)
		for (int k = 0; k < t->unit[i].il.count; k++) {
			const struct il_line *line = &t->unit[i].il.line[k];

			to = line->kind == IL_OP && line->op == OP_CAL ?
				scope_pou(t->scope, t->unit[i].pou, line->operand) : NULL;
			if (to)
				as->called[to - t->project->pou] = true;
		}
	return true;
}

/* The programs of tasks that can be interrupted have safe points. */
static bool find_pointed(struct assembler *as)
{
	struct code_task *task;

	as->pointed = arena_alloc(as->arena, (size_t)as->translation->unit_count + 1);
	if (!as->pointed)
		return false;
	for (int i = 0; i < as->task_count; i++) {
		task = &as->task[i];
		for (int k = 0; k < i; k++)
			if (as->task[k].kind != TASK_CYCLE &&
			    as->task[k].priority < task->priority)
				for (uint32_t n = 0; n < task->count; n++)
					as->pointed[as->call.word[task->first + n]] = true;
	}
	return true;
}

void *assemble(struct translation *translation, bool watch, size_t *len)
{
	struct assembler *as = arena_alloc(translation->arena, sizeof(*as));

	if (!as)
		return NULL;
	as->translation = translation;
	as->arena = translation->arena;
	as->areas = scope_areas(translation->scope);
	as->watching = watch;
	as->listing = watch && translation->listing;
	as->entry = arena_alloc(as->arena, ((size_t)translation->unit_count + 1) *
				sizeof(*as->entry));
	if (!as->entry || !find_called(as) || !layout_make(as) || !layout_pointers(as) || !pack_tasks(as) || !find_pointed(as) ||
	    !assemble_section(as, false))
		return NULL;
	layout_core(as);
	if (watch) {
		layout_power(as);
		if (!assemble_section(as, true))
			return NULL;
	}
	return pack_image(as, len);
}
