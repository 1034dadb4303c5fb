/* SPDX-License-Identifier: MIT
 *
 * code_text - verifies instructions: each is complete, its operands are in range and of
 * the right type, jumps lead to instructions, and the code ends.
 *
 * Loops are not checked: the budget ends them.
 */
#include "engine/scan/verify.h"

#include <string.h>

static bool can_read(const struct verifier *v, uint32_t operand)
{
	return verify_use(v, CODE_OFFSET(operand), CODE_TYPE(operand), false);
}

static bool can_write(const struct verifier *v, uint32_t operand)
{
	return verify_use(v, CODE_OFFSET(operand), CODE_TYPE(operand), true);
}

static bool reads_bool(const struct verifier *v, uint32_t offset)
{
	return verify_use(v, offset, IEC_BOOL, false);
}

static bool writes_bool(const struct verifier *v, uint32_t offset)
{
	return verify_use(v, offset, IEC_BOOL, true);
}

/* ---- instructions ---- */

uint32_t code_words(const uint32_t *code)
{
	uint32_t n = *code >> 8;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_LUT:
		return 1 + 4 * n;
	case VM_COPY:
	case VM_BLOCK:
		return 4;
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
		return 5;
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		return 6;
	case VM_FN:
		return 5 + (n >> 8 & 0xff);
	case VM_BITGET:
	case VM_BITPUT:
	case VM_JMPC:
		return 3;
	case VM_FB:
	case VM_JMP:
	case VM_CALL:
	case VM_STOP:
		return 2;
	case VM_AGET:
	case VM_APUT:
		return 9 + 4 * (n >> 1 & 15u);
	case VM_ABLOCK:
		return 10 + 4 * (n >> 1);
	case VM_EACH:
	case VM_SWITCH:
		return 3 + n;
	case VM_TICK:
		return 6;
	case VM_POINT:
		return 1;
	WITH_POINTERS(case VM_PEEK: case VM_POKE: return 8;)
	case VM_END:
	case VM_COUNT:
		break;
	}
	return 1;
}

/* Within check_text(): it is the only caller on a small board, and a call takes more bytes there. */
static inline __attribute__((always_inline)) const uint32_t *
targets_of(const uint32_t *code, uint32_t *count)
{
	const uint32_t op = *code & 0xff;
	const bool jump = op == VM_JMP || op == VM_JMPC;

	*count = jump ? 1 : op == VM_EACH || op == VM_SWITCH ? *code >> 8 : 0;
	return code + (jump ? 1 : 3);
}

const uint32_t *code_targets(const uint32_t *code, uint32_t *count)
{
	return targets_of(code, count);
}

uint32_t code_type(uint32_t op)
{
	static const uint8_t type[VM_COUNT] = {
		[VM_REAL] = IEC_REAL, [VM_DINT] = IEC_DINT, [VM_INT] = IEC_INT,
		[VM_CMP_REAL] = IEC_REAL, [VM_CMP_DINT] = IEC_DINT,
		[VM_CMP_INT] = IEC_INT,
	};

	return op < VM_COUNT ? type[op] : IEC_NONE;
}

static bool check_lut(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++, at += 4)
		if (!reads_bool(v, at[0]) || !reads_bool(v, at[1]) ||
		    !reads_bool(v, at[2]) || !writes_bool(v, at[3] >> 8))
			return false;
	return n > 0;
}

/* Whether COPY and FN may use type @from where @to is required. */
static bool converts(uint32_t from, uint32_t to)
{
	return verify_is_type(from) && verify_is_type(to) &&
	       iec_can_widen((enum iec_type)from, (enum iec_type)to);
}

static bool is_of(uint32_t type, uint16_t classes)
{
	return verify_is_type(type) &&
	       iec_type_row((enum iec_type)type)->class & classes;
}

/* The type that a function's result must be declared to have. */
static bool gives(const struct word_row *row, uint32_t type, uint32_t result)
{
	if (word_shares(row))
		return result == type;
	if (row->result == RESULT_OPEN)
		return is_of(result, row->result_classes);
	return result == row->result;
}

static bool check_input(const struct verifier *v, const struct word_pin *pin,
			uint32_t operand, uint32_t type)
{
	if (pin->own != ((operand & CODE_OWN) != 0))
		return false;
	operand &= ~CODE_OWN;
	if (!can_read(v, operand))
		return false;
	return pin->own ? is_of(CODE_TYPE(operand), pin->classes) :
			  is_of(type, pin->classes) &&
			  converts(CODE_TYPE(operand), type);
}

static bool check_fn(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	uint32_t type = n & 0xff, count = n >> 8 & 0xff, result = n >> 16;
	const struct word_row *row;

	if (at[0] >= WORD_KNOWN || !verify_is_type(type))
		return false;
	row = word_row((enum word)at[0]);
	if (row->kind != WORD_FN || count < row->pin_count ||
	    count > row->most_inputs || !gives(row, type, result))
		return false;
	if (!reads_bool(v, at[1]) || !writes_bool(v, at[2]) ||
	    !can_write(v, at[3]) || !converts(result, CODE_TYPE(at[3])))
		return false;
	for (uint32_t i = 0; i < count; i++)
		if (!check_input(v, word_input(row, i), at[4 + i], type))
			return false;
	return true;
}

static bool check_bit(const struct verifier *v, const uint32_t *at, uint32_t op,
		      uint32_t n)
{
	if (n > 7)
		return false;
	if (op == VM_BITGET)
		return verify_use(v, at[0], IEC_BYTE, false) && writes_bool(v, at[1]);
	return reads_bool(v, at[0]) && verify_use(v, at[1], IEC_BYTE, true);
}

/* Whether no value or instance lies across this offset. */
static bool is_edge(const struct verifier *v, uint32_t offset)
{
	return offset == v->data_size || (v->mark[offset] != MARK_INSIDE &&
					  v->mark[offset] != MARK_TEXT);
}

/* The first run that may hold @offset. */
static uint32_t run_at(const struct verifier *v, uint32_t offset)
{
	uint32_t before = verify_runs_before(v->program, offset);

	return before ? before - 1 : 0;
}

/* Whether @b has the same instances as @a. Marks do not tell the inside of instances. */
static bool same_instances(const struct verifier *v, uint32_t a, uint32_t b,
			   uint32_t size)
{
	const struct program *p = v->program;

	for (uint32_t i = run_at(v, a); i < p->run_count; i++) {
		const struct code_run *run = &p->run[i];
		uint32_t own, at;

		if (run->offset >= a + size)
			break;
		if (run->kind != RUN_INSTANCE)
			continue;
		own = word_row((enum word)run->word)->size;
		at = run->offset;
		if (at < a)
			at += (a - at) / own * own;
		for (; at < a + size && at < run->offset + run->count * own;
		     at += own) {
			if (at + own <= a)
				continue;
			if (at < a || own > a + size - at ||
			    code_instance(p, at - a + b) != run->word)
				return false;
		}
	}
	return true;
}

/* Both sides must be whole and alike, so that a BOOL stays a BOOL. */
static bool are_alike(struct verifier *v, uint32_t to, uint32_t from, uint32_t size)
{
	uint32_t first = v->areas + 2;

	if (size == 0 || to < first || from < first || to > v->data_size ||
	    from > v->data_size || size > v->data_size - to ||
	    size > v->data_size - from ||
	    (to < from ? from - to : to - from) < size ||
	    size > v->blocks_left)
		return false;
	v->blocks_left -= size;
	return is_edge(v, to) && is_edge(v, from) && is_edge(v, to + size) &&
	       is_edge(v, from + size) &&
	       memcmp(v->mark + to, v->mark + from, size) == 0 &&
	       same_instances(v, to, from, size) &&
	       same_instances(v, from, to, size);
}

static bool check_block(struct verifier *v, const uint32_t *at)
{
	return are_alike(v, at[0], at[1], at[2]);
}

/* index, low, count, stride each; the index must be one. */
static bool check_dimensions(const struct verifier *v, const uint32_t *at,
			     uint32_t count)
{
	if (count > LIMIT_INDICES)
		return false;
	for (uint32_t i = 0; i < count; i++, at += CODE_DIMENSION)
		if (!can_read(v, at[0]) ||
		    !is_of(CODE_TYPE(at[0]), ANY_INT | CLASS_BITS))
			return false;
	return true;
}

/* Every element must be like the other side. */
static bool check_ablock(struct verifier *v, const uint32_t *at, uint32_t n)
{
	struct verify_grid grid;
	uint32_t fixed = n & 1 ? at[3] : at[2];
	uint32_t base = n & 1 ? at[2] : at[3];

	if (!reads_bool(v, at[0]) || !writes_bool(v, at[1]) ||
	    !check_dimensions(v, at + 5, 1 + (n >> 1)) ||
	    !verify_grid_begin(v, &grid, base, at + 5, 1 + (n >> 1)))
		return false;
	do {
		if (grid.offset > v->data_size ||
		    !are_alike(v, fixed, (uint32_t)grid.offset, at[4]))
			return false;
	} while (verify_grid_next(v, &grid));
	return !grid.failed;
}

#define CODE_SHORTS (CODE_SHORT | CODE_LONG | CODE_WIDE)
#ifndef RUNGBOARD_SMALL
/* The VM believes these marks; on small boards it has no use for them. */
static bool check_short(const uint32_t *at, uint32_t n)
{
	const uint32_t type = CODE_TYPE(at[3]), marks = n & CODE_SHORTS;

	if (!(marks & CODE_SHORT))
		return !marks;
	return !(n & CODE_ACCESS) && CODE_TYPE(at[2]) == type && verify_is_type(type) &&
	       iec_type_row((enum iec_type)type)->size == (n & CODE_LONG ? 4 : 2) &&
	       CODE_TYPE(at[4]) == (n & CODE_WIDE ? IEC_DINT : IEC_INT);
}
#endif

/* AGET and APUT. `ok` is written first or last, so that an image that uses one place
 * for it and the element does no harm. */
static bool check_element(struct verifier *v, const uint32_t *at, uint32_t op,
			  uint32_t n)
{
	bool put = op == VM_APUT;
	uint32_t type = CODE_TYPE(at[3]), value = CODE_TYPE(at[2]);
	uint32_t more;

	WITH_POINTERS(if (!check_short(at, n))
		return false;)
	n &= ~(put ? CODE_SHORTS : CODE_SHORTS | CODE_KEEP);
	more = n >> 1;
	if ((n & 1 && more) || !reads_bool(v, at[0]) || !writes_bool(v, at[1]) ||
	    !check_dimensions(v, at + 4, 1 + more))
		return false;
	if (put ? !can_read(v, at[2]) || !converts(value, type)
		: !can_write(v, at[2]) || !converts(type, value))
		return false;
	if (more)
		return verify_elements_of(v, at[3], at + 4, 1 + more, put);
	return n ? type == IEC_BOOL && at[6] &&
		   verify_bits(v, CODE_OFFSET(at[3]), (uint64_t)(at[6] - 1) * at[7] + 1, put)
		 : verify_elements(v, at[3], at[6], at[7], put);
}

#ifndef RUNGBOARD_SMALL
/* PEEK and POKE of a whole: the scan compares what lies at both places. */
static bool check_whole(const struct verifier *v, const uint32_t *at)
{
	return reads_bool(v, at[0]) && writes_bool(v, at[1]) && at[2] >= v->areas + 2 && at[5] > 0 &&
	       at[5] <= v->data_size && at[2] <= v->data_size - at[5] && at[4] <= v->data_size &&
	       CODE_TYPE(at[3]) == IEC_NONE && verify_use(v, CODE_OFFSET(at[3]), IEC_LWORD, false);
}

/* PEEK and POKE. What the pointer says is compared in the scan. */
static bool check_pointer(const struct verifier *v, const uint32_t *at, bool poke)
{
	const uint32_t type = CODE_TYPE(at[3]), value = CODE_TYPE(at[2]);

	return reads_bool(v, at[0]) && writes_bool(v, at[1]) &&
	       type > IEC_NONE && type < IEC_TYPE_COUNT &&
	       verify_use(v, CODE_OFFSET(at[3]), IEC_LWORD, false) && can_read(v, at[5]) &&
	       is_of(CODE_TYPE(at[5]), ANY_INT | ANY_BIT) &&
	       (poke ? type == value && can_read(v, at[2]) :
		       can_write(v, at[2]) && converts(type, value));
}
#endif

static bool check_copy(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	uint32_t to = CODE_TYPE(at[1]), from = CODE_TYPE(at[2]);

	if (!reads_bool(v, at[0]) || !can_write(v, at[1]) || !can_read(v, at[2]))
		return false;
	return n == 0 ? converts(from, to) :
	       from == to && to != IEC_STRING &&
	       n == iec_type_row((enum iec_type)to)->size;
}

/* The operands of a comparison beside its two values. */
static bool check_order(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	return n < 256 && reads_bool(v, at[2]) && writes_bool(v, at[3]);
}

static bool check_pair(const struct verifier *v, const uint32_t *at, uint32_t type)
{
	return verify_use(v, at[0], type, false) && verify_use(v, at[1], type, false);
}

static bool check_math(const struct verifier *v, const uint32_t *at, uint32_t n,
		       uint32_t type)
{
	bool always = at[0] == CODE_TRUE_AT(&v->program->areas);

	return MATH_OF(n) < (type == IEC_REAL ? MATH_MOD : MATH_COUNT) &&
	       (n & ~(MATH_LIKELY | MATH_LOOP | MATH_ROW)) < MATH_ENABLED + MATH_LEFT && (n & MATH_ENABLED || always) &&
	       (n & (MATH_LIKELY | MATH_ENABLED)) != MATH_LIKELY &&
	       reads_bool(v, at[0]) && writes_bool(v, at[1]) &&
	       verify_use(v, at[2], type, true) && check_pair(v, at + 3, type);
}

#ifndef RUNGBOARD_SMALL
/* MATH_LOOP and MATH_ROW: the VM believes that these instructions follow. */
static bool check_marks(const uint32_t *code, uint32_t words)
{
	const uint32_t op = *code & 0xff, *cmp = code + 6, *jump = code + 11;

	if ((op != VM_INT && op != VM_DINT && op != VM_REAL) || !(*code >> 8 & (MATH_LOOP | MATH_ROW)))
		return true;
	if (op == VM_REAL)
		return !(*code >> 8 & MATH_LOOP) && *code >> 8 & MATH_ENABLED && words >= 12 &&
		       (code[6] & 0xff) == VM_REAL && code[6] >> 8 & MATH_ENABLED && code[7] == code[2];
	return *code >> 8 == (MATH_ADD | MATH_LOOP) && words >= 14 &&
	       (*cmp & 0xff) == (op == VM_INT ? VM_CMP_INT : VM_CMP_DINT) && cmp[1] == code[3] &&
	       code_order_alone(*cmp >> 8) &&
	       (*jump & 0xff) == VM_JMPC && jump[2] == cmp[4];
}
#endif

/* One instruction; jumps and calls are checked later. */
static bool check_code(struct verifier *v, const uint32_t *code)
{
	uint32_t op = *code & 0xff, n = *code >> 8;
	const uint32_t *at = code + 1;

	switch ((enum vm_op)op) {
	case VM_END:
	case VM_JMP:
		return n == 0;
	case VM_JMPC:
		return n <= 1 && reads_bool(v, at[1]);
	case VM_LUT:
		return check_lut(v, at, n);
	case VM_BITGET:
	case VM_BITPUT:
		return check_bit(v, at, op, n);
	case VM_COPY:
		return check_copy(v, at, n);
	case VM_CMP:
		return can_read(v, at[0]) && can_read(v, at[1]) &&
		       (CODE_TYPE(at[0]) == IEC_STRING) ==
		       (CODE_TYPE(at[1]) == IEC_STRING) && check_order(v, at, n);
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
		return check_pair(v, at, code_type(op)) &&
		       check_order(v, at, n);
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		return check_math(v, at, n, code_type(op));
	case VM_FN:
		return check_fn(v, at, n);
	case VM_AGET:
	case VM_APUT:
		return check_element(v, at, op, n);
	case VM_FB:
		return n < WORD_KNOWN && code_instance(v->program, at[0]) == n;
	case VM_BLOCK:
		return n == 0 && check_block(v, at);
	case VM_ABLOCK:
		return check_ablock(v, at, n);
	case VM_STOP:
		return n == 0 && reads_bool(v, at[0]);
	case VM_CALL:
		return n == 0 && at[0] < v->program->entry_count;
	case VM_EACH:
		return verify_use(v, at[0], IEC_UDINT, true) &&
		       verify_all(v, at[1], n, IEC_BOOL, false);
	case VM_SWITCH:
		return check_dimensions(v, at, 1);
	case VM_TICK:
		return verify_tick(v, at, n);
	case VM_POINT:
		return n <= LIMIT_IMAGE / 4;
	WITH_POINTERS(case VM_PEEK: case VM_POKE:
		return n ? n == 1 && check_whole(v, at) :
			   check_pointer(v, at, (*code & 0xff) == VM_POKE);)
	case VM_COUNT:
		break;
	}
	return false;
}

/* code_words() of hostile bytes: no overflow of a huge n. */
static uint32_t words_needed(const uint32_t *code)
{
	if ((*code & 0xff) == VM_LUT && *code >> 8 > LIMIT_IMAGE / 16)
		return UINT32_MAX;
	return code_words(code);
}

/* The instructions of one program: each is complete and valid, the last one ends the
 * program, jumps lead to instructions. @starts: a byte a word. */
static bool check_text(struct verifier *v, const uint32_t *base, uint32_t first,
		       uint32_t words, uint8_t *starts)
{
	uint32_t last = VM_COUNT;

	for (uint32_t at = 0; at < words; at += code_words(base + first + at)) {
		const uint32_t *code = base + first + at;

		if ((*code & 0xff) >= VM_COUNT ||
		    words_needed(code) > words - at || !check_code(v, code))
			return verify_refuse(v, code);
		WITH_POINTERS(if (!check_marks(code, words - at))
			return verify_refuse(v, code);)
		starts[at] = 1;
		last = *code & 0xff;
	}
	if (last != VM_END && last != VM_JMP)
		return verify_refuse(v, base + first);
	for (uint32_t at = 0; at < words; at += code_words(base + first + at)) {
		const uint32_t *code = base + first + at, *target;
		uint32_t targets;

		target = targets_of(code, &targets);
		for (uint32_t i = 0; i < targets; i++) {
			const uint32_t to = target[i] - first; /* above all words, if it is before them */

			if (to >= words || !starts[to] || ((*code & 0xff) == VM_SWITCH && to <= at))
				return verify_refuse(v, code);
		}
	}
	memset(starts, 0, words);
	return true;
}

/* ---- calls ---- */

struct calls {
	struct verifier *v;
	uint8_t *deep;     /* by program: 0 not visited, 255 in progress, else */
	uint32_t *stack, *at; /* programs in progress; the next word of each */
	uint32_t depth;
};
#define IN_WORK 255u

static void begin_calls(struct calls *c, uint32_t entry)
{
	c->deep[entry] = IN_WORK;
	c->stack[c->depth] = entry;
	c->at[c->depth++] = 0;
}

/* The next call of the program on top; false: no more. */
static bool next_call(struct calls *c, const uint32_t *text, uint32_t words,
		      uint32_t *to)
{
	uint32_t *at = &c->at[c->depth - 1];

	for (; *at < words; *at += code_words(text + *at))
		if ((text[*at] & 0xff) == VM_CALL) {
			*to = text[*at + 1];
			return true;
		}
	return false;
}

/* Steps through the calls of the programs on the stack until it is empty; a program
 * that was not visited is pushed. False: a circle, or too deep. */
static bool walk_calls(struct calls *c, bool watch, uint8_t *most)
{
	const struct program *p = c->v->program;

	while (c->depth > 0) {
		uint32_t top = c->stack[c->depth - 1], to;
		const struct code_program *e = &p->entry[top];
		const uint32_t *text = watch ? p->watch + e->watch : p->text + e->text;

		if (!next_call(c, text, watch ? e->watch_words : e->text_words,
			       &to)) {
			c->deep[top] = most[top];
			c->depth--;
			continue;
		}
		if (c->deep[to] == IN_WORK)
			return verify_refuse(c->v, e);
		if (c->deep[to] == 0) {
			most[to] = 1;
			begin_calls(c, to);
			continue;
		}
		if (c->deep[to] > LIMIT_CALLS)
			return verify_refuse(c->v, e);
		if (c->deep[to] + 1 > most[top])
			most[top] = (uint8_t)(c->deep[to] + 1);
		c->at[c->depth - 1] += 2;
	}
	return true;
}

static bool check_calls(struct verifier *v, bool watch)
{
	uint32_t count = v->program->entry_count;
	struct calls c = { .v = v };
	uint8_t *most = arena_alloc(v->scratch, count + 1u);

	c.deep = arena_alloc(v->scratch, count + 1u);
	c.stack = arena_alloc(v->scratch, (count + 1u) * sizeof(uint32_t));
	c.at = arena_alloc(v->scratch, (count + 1u) * sizeof(uint32_t));
	if (!most || !c.deep || !c.stack || !c.at)
		return false;
	for (uint32_t i = 0; i < count; i++) {
		if (c.deep[i])
			continue;
		most[i] = 1;
		begin_calls(&c, i);
		if (!walk_calls(&c, watch, most))
			return false;
	}
	return true;
}

bool verify_programs(struct verifier *v)
{
	const struct program *p = v->program;
	uint32_t most = p->text_words > p->watch_words ? p->text_words
						       : p->watch_words;
	uint8_t *starts = arena_alloc(v->scratch, most + 1u);

	uint32_t text = 0, watch = 0; /* words of all programs so far: they share none */

	if (!starts)
		return false;
	for (uint32_t i = 0; i < p->entry_count; i++) {
		const struct code_program *e = &p->entry[i];

		if (e->text > p->text_words || e->text_words > p->text_words - e->text ||
		    e->watch > p->watch_words ||
		    e->watch_words > p->watch_words - e->watch ||
		    (p->string_bytes && e->name >= p->string_bytes) ||
		    e->text_words > p->text_words - text ||
		    e->watch_words > p->watch_words - watch)
			return verify_refuse(v, e);
		text += e->text_words;
		watch += e->watch_words;
		if (!check_text(v, p->text, e->text, e->text_words, starts))
			return false;
		if (p->watch_words &&
		    !check_text(v, p->watch, e->watch, e->watch_words, starts))
			return false;
	}
	return check_calls(v, false) &&
	       (!p->watch_words || check_calls(v, true));
}


/* ---- tasks ---- */

static bool is_interval(const uint32_t words[2])
{
	uint64_t ns = (uint64_t)words[1] << 32 | words[0];

	return ns >= LIMIT_TICK && ns <= LIMIT_INTERVAL;
}

/* A bit of a byte that a program may read, or a whole BOOL. */
static bool is_event(const struct verifier *v, uint32_t single)
{
	uint32_t offset = CODE_OFFSET(single), bit = CODE_TYPE(single);

	return bit < 8 && ((bit == 0 && reads_bool(v, offset)) ||
			   verify_use(v, offset, IEC_BYTE, false));
}

static bool check_task(const struct verifier *v, const struct code_task *task)
{
	const struct program *p = v->program;
	bool timed = task->kind == TASK_INTERVAL;

	if (task->kind > TASK_EVENT || task->first > p->call_count ||
	    task->count > p->call_count - task->first ||
	    (p->string_bytes && task->name >= p->string_bytes))
		return false;
	if (timed ? !is_interval(task->interval)
		  : task->interval[0] || task->interval[1])
		return false;
	if ((task->watchdog[0] || task->watchdog[1]) &&
	    !is_interval(task->watchdog))
		return false;
	return task->kind != TASK_EVENT || is_event(v, task->single);
}

bool verify_tasks(struct verifier *v)
{
	const struct program *p = v->program;

	/* A program runs in one task: no image makes a scan of many calls. */
	if (p->task_count > LIMIT_TASKS || p->call_count > p->entry_count)
		return verify_refuse(v, p->task);
	for (uint32_t i = 0; i < p->task_count; i++)
		if (!check_task(v, &p->task[i]) ||
		    (i && p->task[i].priority < p->task[i - 1].priority))
			return verify_refuse(v, &p->task[i]);
	for (uint32_t i = 0; i < p->call_count; i++)
		if (p->call[i] >= p->entry_count)
			return verify_refuse(v, &p->call[i]);
	return true;
}
