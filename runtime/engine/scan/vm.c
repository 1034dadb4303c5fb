/* SPDX-License-Identifier: MIT
 *
 * vm - one switch over all instructions. code_open() has verified them.
 */
#include "engine/scan/vm.h"
#include "engine/scan/code.h"
#include "engine/scan/value.h"

#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* The branch that a compiler places first. */
#define LIKELY(x) __builtin_expect((x), 1)

/* A text of its own takes room on the stack; on a small board not in each vm_run() of tasks that
 * interrupt each other. What is called in several places has one place there, too. */
#ifdef __OPTIMIZE_SIZE__
#define OWN_FRAME __attribute__((noinline))
#define SELDOM
#else
#define OWN_FRAME
#define SELDOM __attribute__((noinline)) /* the registers of vm_run() are for what runs often */
#endif

/* ---- operands ---- */

static inline bool is_real(uint32_t word)
{
	return value_is_real(CODE_TYPE(word));
}

static inline int64_t integer(const uint8_t *m, uint32_t word)
{
	return value_integer(m + CODE_OFFSET(word), CODE_TYPE(word));
}

/* An operand for REAL arithmetic: integers that widen are exact. */
static inline double real(const uint8_t *m, uint32_t word)
{
	return is_real(word) ? value_real(m + CODE_OFFSET(word), CODE_TYPE(word))
			     : (double)integer(m, word);
}

static inline const struct iec_string *text(const uint8_t *m, uint32_t word)
{
	return (const void *)(m + CODE_OFFSET(word));
}

static inline void put(uint8_t *m, uint32_t word, union iec_value value)
{
	value_put(m + CODE_OFFSET(word), CODE_TYPE(word), value);
}

/* False if a text had to be cut. */
static inline bool put_text(uint8_t *m, uint32_t word, const struct iec_string *from)
{
	uint16_t len = from->length;

	iec_store(m + CODE_OFFSET(word), IEC_STRING, (union iec_value){ .s = from });
	return text(m, word)->length == len;
}

static inline void run_copy(uint8_t *m, const uint32_t *pc)
{
	union iec_value value;

	if (CODE_TYPE(pc[1]) == IEC_STRING) {
		put_text(m, pc[1], text(m, pc[2]));
		return;
	}
	if (is_real(pc[1]))
		value.r = real(m, pc[2]);
	else
		value.i = integer(m, pc[2]);
	put(m, pc[1], value);
}

/* Values may overlap: a word of %M begins at any byte. They are read whole before they are
 * written; a processor that reads odd addresses by bytes would else read what it wrote. */
static inline void copy_2(uint8_t *to, const uint8_t *from)
{
	uint16_t value;

	memcpy(&value, from, sizeof(value));
	memcpy(to, &value, sizeof(value));
}

static inline void copy_4(uint8_t *to, const uint8_t *from)
{
	uint32_t value;

	memcpy(&value, from, sizeof(value));
	memcpy(to, &value, sizeof(value));
}

static inline void copy_8(uint8_t *to, const uint8_t *from)
{
	uint64_t value;

	memcpy(&value, from, sizeof(value));
	memcpy(to, &value, sizeof(value));
}

/* @size: bytes to copy; 0: the value is widened, or is a text. */
static inline void copy(uint8_t *m, const uint32_t *pc, uint32_t size)
{
	uint8_t *to = m + CODE_OFFSET(pc[1]);
	const uint8_t *from = m + CODE_OFFSET(pc[2]);

	switch (size) {
	case 1:
		*to = *from;
		break;
	case 2:
		copy_2(to, from);
		break;
	case 4:
		copy_4(to, from);
		break;
	case 8:
		copy_8(to, from);
		break;
	default:
		run_copy(m, pc);
		break;
	}
}

/* ---- elements whose index is computed in the scan ---- */

/* Operands of AGET and APUT; ABLOCK has SIZE in between. The indices follow. */
enum { EN, OK, VALUE, BASE, ELEMENT, SIZE = ELEMENT };
enum { INDEX, LOW, COUNT, STRIDE };

/* Adds the offset of the element to *where; false: no such element. An index below
 * `low` wraps to a number far above `count`, so one comparison is enough. */
static inline bool find_index(const uint8_t *m, const uint32_t *at, uint32_t *where)
{
	int64_t index = integer(m, at[INDEX]);
	uint64_t element = (uint64_t)index - (uint64_t)(int32_t)at[LOW];

	if (element >= at[COUNT] ||
	    (index < 0 && !value_is_signed(CODE_TYPE(at[INDEX]))))
		return false;
	*where += (uint32_t)element * at[STRIDE];
	return true;
}

/* The indices after the first. */
static inline bool find_more(const uint8_t *m, const uint32_t *at, uint32_t more,
		      uint32_t *where)
{
	for (; more > 0; more--) {
		at += CODE_DIMENSION;
		if (!find_index(m, at, where))
			return false;
	}
	return true;
}

static OWN_FRAME bool find_element(const uint8_t *m, const uint32_t *at, uint32_t more,
				uint32_t *where)
{
	return find_index(m, at, where) && (!more || find_more(m, at, more, where));
}

/* @size: 2 or 4, a constant for the compiler. */
static inline int32_t whole(const uint8_t *at, size_t size)
{
	int16_t half;
	int32_t both;

	if (size == sizeof(half)) {
		memcpy(&half, at, sizeof(half));
		return half;
	}
	memcpy(&both, at, sizeof(both));
	return both;
}

#ifndef RUNGBOARD_SMALL
/* ---- pointers ---- */

/* Operands of PEEK and POKE behind VALUE. */
enum { POINTER = 3, MORE, AT_INDEX, AT_LOW };

/* What a pointer leads to. */
struct led {
	uint32_t where;               /* offset of the value                  */
	struct iec_string *text;      /* it is in this text; NULL: in none    */
	uint32_t at;                  /* its byte there                       */
};

/* False: it does not lead to a whole value in its place. */
static bool lead(const struct vm *vm, const uint32_t *at, struct led *out)
{
	const uint64_t pointer = (uint64_t)value_integer(vm->memory + CODE_OFFSET(at[POINTER]), IEC_LWORD);
	const uint32_t size = iec_type_row((enum iec_type)CODE_TYPE(at[POINTER]))->size;
	const uint32_t place = (uint32_t)(pointer >> CODE_POINTER_PLACE);
	const int64_t bytes = pointer >> CODE_POINTER_BYTES & CODE_POINTER_MOST;
	const int64_t position = (int32_t)((uint32_t)pointer << 12) >> 12;
	const int64_t index = integer(vm->memory, at[AT_INDEX]);
	const struct code_run *run;
	int64_t where;

	if (index < INT32_MIN || index > INT32_MAX)
		return false;
	where = position + at[MORE] + (index - (int32_t)at[AT_LOW]) * size;
	if (where < 0 || where + size > bytes || place < vm->program->areas.size + 2 ||
	    place + bytes > vm->program->header->data_size)
		return false;
	run = code_run_at(vm->program, place);
	*out = (struct led){ .where = place + (uint32_t)where };
	if (!run || run->kind != RUN_VALUES || run->type != IEC_STRING)
		return run != NULL;
	if ((place - run->offset) % code_run_size(run) || size != 1 || where > run->word)
		return false;
	out->text = (void *)(vm->memory + place);
	out->at = (uint32_t)where;
	return true;
}

/* The same of a text, a structure or an array: its offset. @size: what has to be in its place. */
static bool lead_whole(const struct vm *vm, const uint32_t *at, uint32_t size, uint32_t *where)
{
	const uint64_t pointer = (uint64_t)value_integer(vm->memory + CODE_OFFSET(at[POINTER]), IEC_LWORD);
	const uint32_t place = (uint32_t)(pointer >> CODE_POINTER_PLACE);
	const int64_t bytes = pointer >> CODE_POINTER_BYTES & CODE_POINTER_MOST;
	const int64_t position = ((int32_t)((uint32_t)pointer << 12) >> 12) + (int64_t)at[MORE];

	if (position < 0 || position + size > bytes || place < vm->program->areas.size + 2 ||
	    place + bytes > vm->program->header->data_size)
		return false;
	*where = place + (uint32_t)position;
	return true;
}

static bool copy_text(struct vm *vm, const uint32_t *at, bool poke)
{
	const struct code_run *run;
	uint32_t where;

	if (!lead_whole(vm, at, 1, &where))
		return false;
	run = code_run_at(vm->program, where);
	if (!run || run->kind != RUN_VALUES || run->type != IEC_STRING ||
	    (where - run->offset) % code_run_size(run))
		return false;
	where = CODE_OPERAND(IEC_STRING, where);
	return put_text(vm->memory, poke ? where : at[VALUE], text(vm->memory, poke ? at[VALUE] : where));
}

static bool is_raw(const struct code_run *run)
{
	return run && run->kind == RUN_VALUES && run->type == IEC_LWORD;
}

/* A union is LWORDs, whatever its members are. Bytes that may be copied from @from to @to; 0: none. */
static uint32_t raw_bytes(const struct program *p, uint32_t to, uint32_t from, uint32_t most)
{
	const struct code_run *one = code_run_at(p, to), *other = code_run_at(p, from);
	const struct code_run *typed = is_raw(one) ? other : one;
	const uint32_t at = is_raw(one) ? from : to;
	uint32_t left = 1;

	if (!is_raw(one) && !is_raw(other))
		return 0;
	if (typed && (typed->kind != RUN_VALUES || typed->type == IEC_STRING))
		return 0;
	if (typed)
		left = code_run_size(typed) - (at - typed->offset) % code_run_size(typed);
	return left < most ? left : most;
}

/* Bytes from @a and @b on that hold values of one type, or nothing; 0: they differ. */
static uint32_t alike(const struct program *p, uint32_t a, uint32_t b, uint32_t most)
{
	const struct code_run *one = code_run_at(p, a), *other = code_run_at(p, b);
	uint32_t unit, left, right;

	if (!one || !other)
		return !one && !other;
	unit = code_run_size(one);
	if (one->kind == RUN_CONSTANTS || one->kind != other->kind || one->type != other->type ||
	    one->word != other->word || (a - one->offset) % unit || (b - other->offset) % unit)
		return 0;
	left = one->offset + one->count * unit - a;
	right = other->offset + other->count * unit - b;
	left = left < right ? left : right;
	return left < most ? left : most - most % unit;
}

/* The BOOLs of what came out of a union: any byte but 0 is TRUE. */
static void make_bools(struct vm *vm, uint32_t to, uint32_t size)
{
	for (uint32_t i = 0; i < size; i++) {
		const struct code_run *run = code_run_at(vm->program, to + i);

		if (run && run->type == IEC_BOOL)
			vm->memory[to + i] = vm->memory[to + i] != 0;
	}
}

static bool copy_whole(struct vm *vm, const uint32_t *at, bool poke)
{
	const uint32_t size = at[AT_INDEX];
	uint32_t where, step;

	if (!lead_whole(vm, at, size, &where))
		return false;
	const uint32_t to = poke ? where : at[VALUE], from = poke ? at[VALUE] : where;
	bool raw = false;

	for (uint32_t i = 0; i < size; i += step) {
		step = alike(vm->program, to + i, from + i, size - i);
		if (!step) {
			step = raw_bytes(vm->program, to + i, from + i, size - i);
			raw = true;
		}
		if (!step)
			return false;
	}
	memmove(vm->memory + to, vm->memory + from, size);
	if (raw)
		make_bools(vm, to, size);
	return true;
}

static bool peek(struct vm *vm, const uint32_t *at)
{
	uint32_t pair[3] = { 0, at[VALUE], 0 };
	union iec_value byte = { .i = 0 };
	struct led led;

	if (CODE_TYPE(at[POINTER]) == IEC_STRING)
		return copy_text(vm, at, false);
	if (!lead(vm, at, &led))
		return false;
	if (led.text) { /* behind its end is a 0 */
		if (led.at != led.text->length && led.at < led.text->capacity)
			byte.i = (unsigned char)led.text->text[led.at];
		put(vm->memory, at[VALUE], byte);
		return true;
	}
	if (CODE_TYPE(at[POINTER]) == IEC_BOOL) { /* of any byte */
		byte.i = vm->memory[led.where] != 0;
		put(vm->memory, at[VALUE], byte);
		return true;
	}
	pair[2] = CODE_OPERAND(CODE_TYPE(at[POINTER]), led.where);
	run_copy(vm->memory, pair);
	return true;
}

/* A byte of a text, whose first 0 ends it. */
static bool poke_text(struct iec_string *text, uint32_t at, char byte)
{
	uint32_t length = 0;

	if (at >= text->capacity)
		return byte == 0;
	if (text->length < text->capacity)
		text->text[text->length] = 0;
	text->text[at] = byte;
	while (length < text->capacity && text->text[length])
		length++;
	text->length = (uint16_t)length;
	return true;
}

/* Numbers only: a BOOL is 0 or 1, an instance its own. */
static bool poke(struct vm *vm, const uint32_t *at)
{
	const uint32_t type = CODE_TYPE(at[POINTER]), size = iec_type_row((enum iec_type)type)->size;
	const uint8_t *from = vm->memory + CODE_OFFSET(at[VALUE]);
	const struct code_run *run;
	struct led led;

	if (type == IEC_STRING)
		return copy_text(vm, at, true);
	if (!lead(vm, at, &led))
		return false;
	if (led.text)
		return poke_text(led.text, led.at, (char)*from);
	run = code_run_at(vm->program, led.where);
	if (!run || run->kind != RUN_VALUES || run->type == IEC_STRING ||
	    led.where + size > run->offset + (uint64_t)run->count * code_run_size(run) ||
	    (run->type == IEC_BOOL && (size != 1 || *from > 1)))
		return false;
	memmove(vm->memory + led.where, from, size);
	return true;
}
#endif

/* ---- the most frequent element: CODE_SHORT ----
 * Left out where room is short: the general way has the same result. */

#ifdef __OPTIMIZE_SIZE__
#define HAS_OFTEN false
#define INLINE inline
#else
#define HAS_OFTEN true
#define INLINE inline __attribute__((always_inline))
#endif

/* Lists of steps, where numbers of 64 bits are cheap. */
#define HAS_LISTS (HAS_OFTEN && sizeof(size_t) > sizeof(uint32_t))

/* The marks of the most frequent one. */
#define SHAPE(n) ((n) & (CODE_SHORT | CODE_LONG | CODE_WIDE))

/* Is it such an element, at *@where? False: there is none, or it is another kind. No element has
 * a number above 2^24, so a difference that wraps is none. */
static INLINE bool find_short(const uint8_t *m, const uint32_t *at, uint32_t n, uint32_t *where)
{
	const uint8_t *index = m + CODE_OFFSET(at[ELEMENT + INDEX]);
	uint64_t element;

	if (!HAS_OFTEN || !LIKELY(n & CODE_SHORT))
		return false;
	if (n & CODE_WIDE)
		element = (uint64_t)((int64_t)whole(index, 4) - (int32_t)at[ELEMENT + LOW]);
	else
		element = (uint32_t)whole(index, 2) - at[ELEMENT + LOW];
	*where = CODE_OFFSET(at[BASE]) + (uint32_t)element * at[ELEMENT + STRIDE];
	return LIKELY(m[at[EN]]) && LIKELY(element < at[ELEMENT + COUNT]);
}

static INLINE void copy_short(uint8_t *m, uint32_t to, uint32_t from, uint32_t n)
{
	if (n & CODE_LONG)
		copy_4(m + to, m + from);
	else
		copy_2(m + to, m + from);
}

/* AGET or APUT of it; false: it is another one, or there is none. */
static INLINE bool run_shape(uint8_t *m, const uint32_t *at, uint32_t n, bool put)
{
	const uint32_t value = CODE_OFFSET(at[VALUE]);
	uint32_t where;

	if (!find_short(m, at, n, &where))
		return false;
	copy_short(m, put ? where : value, put ? value : where, n);
	m[at[OK]] = 1;
	return true;
}

/* INT is the most frequent one, as value and as index. */
static INLINE bool run_short(uint8_t *m, const uint32_t *at, uint32_t n, bool put)
{
	return LIKELY(SHAPE(n) == CODE_SHORT) ? run_shape(m, at, CODE_SHORT, put) :
						run_shape(m, at, n, put);
}

static SELDOM void clear_value(uint8_t *m, const uint32_t *at)
{
	static const struct iec_string none = { 0, 0 };

	if (CODE_TYPE(at[VALUE]) == IEC_STRING)
		put_text(m, at[VALUE], &none);
	else
		put(m, at[VALUE], (union iec_value){ .i = 0 });
}

static SELDOM bool get_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t where = CODE_OFFSET(at[BASE]), pair[3] = { 0, at[VALUE], 0 };

	if (!find_element(m, at + ELEMENT, n >> 1, &where))
		return false;
	if (n & 1) {
		m[CODE_OFFSET(at[VALUE])] = m[where / 8] >> where % 8 & 1u;
		return true;
	}
	pair[2] = CODE_OPERAND(CODE_TYPE(at[BASE]), where);
	run_copy(m, pair);
	return true;
}

static SELDOM bool put_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t where = CODE_OFFSET(at[BASE]), pair[3] = { 0, 0, at[VALUE] };

	if (!find_element(m, at + ELEMENT, n >> 1, &where))
		return false;
	if (n & 1) {
		uint8_t *byte = &m[where / 8];

		*byte = (uint8_t)((*byte & ~(1u << where % 8)) |
				  (uint32_t)m[CODE_OFFSET(at[VALUE])]
				  << where % 8);
		return true;
	}
	pair[1] = CODE_OPERAND(CODE_TYPE(at[BASE]), where);
	run_copy(m, pair);
	return true;
}

/* @at[VALUE] and @at[BASE]: destination and source. */
static SELDOM bool move_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t to = at[VALUE], from = at[BASE];

	if (!find_element(m, at + SIZE + 1, n >> 1, n & 1 ? &to : &from))
		return false;
	memmove(m + to, m + from, at[SIZE]);
	return true;
}

/* SWITCH: where it goes on. */
static OWN_FRAME const uint32_t *choose(const uint8_t *m, const uint32_t *pc, const uint32_t *base)
{
	const uint32_t n = *pc >> 8;
	const int64_t index = HAS_OFTEN && CODE_TYPE(pc[1]) == IEC_INT ?
			      whole(m + CODE_OFFSET(pc[1]), 2) : integer(m, pc[1]);
	const uint64_t number = (uint64_t)index - (uint64_t)(int32_t)pc[2];

	pc += 3;
	return number < n ? base + pc[number] : pc + n;
}

/* ---- steps: the cost of a chart depends on its active steps only ---- */

/* The first TRUE one of eight BOOLs, not all FALSE. */
static inline uint32_t first_of_eight(uint64_t eight)
{
	return (uint32_t)__builtin_ctzll(eight) / 8;
}

static inline uint64_t eight_at(const uint8_t *bits)
{
	uint64_t eight;

	memcpy(&eight, bits, sizeof(eight));
	return eight;
}

/* Skips BOOLs that are FALSE, 32 at a time: most steps of a large chart. */
static inline uint32_t skip_false(const uint8_t *bits, uint32_t from, uint32_t n)
{
	while (from < n && n - from >= 32 &&
	       !(eight_at(bits + from) | eight_at(bits + from + 8) |
		 eight_at(bits + from + 16) | eight_at(bits + from + 24)))
		from += 32;
	return from;
}

/* The number of the first of @n BOOLs that is TRUE, from @from on; @n: none. */
static inline uint32_t next_true(const uint8_t *bits, uint32_t from, uint32_t n)
{
	uint64_t eight;

	from = skip_false(bits, from, n);
	for (; from < n && n - from >= sizeof(eight); from += sizeof(eight)) {
		eight = eight_at(bits + from);
		if (eight)
			return from + first_of_eight(eight);
	}
	while (from < n && !bits[from])
		from++;
	return from < n ? from : n;
}

/* The active steps of a chart with many, from one of them on. EACH makes the list when it begins and
 * walks it: nobody can foresee where the next active step is, so a search for each one takes a wrong
 * branch. Conditions and actions write into no step but through a pointer; POKE ends the list. */
enum { MANY = 64, LISTED = 96, FAR = UINT16_MAX - MANY };
struct active {
	const uint32_t *each;  /* operands of the EACH that walks it; NULL: none does */
	uint32_t next;         /* its cursor                                  */
	uint32_t first;        /* step[] counts from this one                 */
	uint32_t at, count;
	uint32_t end;          /* where the search goes on behind the list    */
	uint16_t step[LISTED];
};

#ifdef __SSE2__
/* 16 BOOLs as bits of a number. */
static inline uint64_t bits_of_16(const uint8_t *at)
{
	const __m128i sixteen = _mm_loadu_si128((const void *)at);

	return (uint32_t)_mm_movemask_epi8(_mm_cmpgt_epi8(sixteen, _mm_setzero_si128()));
}
#else
/* The same: a product puts the lowest bit of byte k at bit 56 + k. */
static inline uint64_t bits_of_16(const uint8_t *at)
{
	const uint64_t up = 0x0102040810204080u;

	return eight_at(at) * up >> 56 | eight_at(at + 8) * up >> 56 << 8;
}
#endif

static inline uint64_t bits_of_many(const uint8_t *at)
{
	return bits_of_16(at) | bits_of_16(at + 16) << 16 | bits_of_16(at + 32) << 32 |
	       bits_of_16(at + 48) << 48;
}

/* Lists the lowest bit of @mask, if there is one. Returns where the next one goes. */
static inline uint16_t *list_lowest(uint16_t *out, uint32_t first, uint64_t mask)
{
	*out = (uint16_t)(first + (uint32_t)__builtin_ctzll(mask | UINT64_C(1) << 63));
	return out + (mask != 0);
}

/* Lists the bits of @mask. Two at a time, whether there are two or not. */
static inline uint16_t *list_bits(uint16_t *out, uint32_t first, uint64_t mask)
{
	do {
		out = list_lowest(out, first, mask);
		mask &= mask - 1;
		out = list_lowest(out, first, mask);
		mask &= mask - 1;
	} while (mask);
	return out;
}

/* Lists those of @n BOOLs that are TRUE, from @from on, as long as there is room for more.
 * @n: at least MANY. */
static SELDOM void list_active(const uint8_t *bits, uint32_t from, uint32_t n, struct active *out)
{
	const uint32_t left = from < n ? n - from : 0, end = from + (left < FAR ? left : FAR);
	const uint16_t *last = out->step + LISTED - MANY;
	uint16_t *to = out->step;
	uint32_t at = from;

	for (; to <= last && end - at >= MANY; at += MANY)
		to = list_bits(to, at - from, bits_of_many(bits + at));
	if (to <= last && at < n && n - at < MANY) {
		to = list_bits(to, at - from, bits_of_many(bits + n - MANY) >> (MANY - (n - at)));
		at = n;
	}
	out->next = out->first = from;
	out->at = 0;
	out->count = (uint32_t)(to - out->step);
	out->end = at;
}

/* EACH: true if one is TRUE; *@found is its number. */
static inline bool find_step(uint8_t *m, const uint32_t *at, uint32_t n, uint32_t *found)
{
	uint32_t cursor;

	memcpy(&cursor, m + at[0], sizeof(cursor));
	*found = next_true(m + at[1], cursor, n);
	cursor = *found < n ? *found + 1 : 0;
	memcpy(m + at[0], &cursor, sizeof(cursor));
	return *found < n;
}

/* As find_step(), of at least MANY. */
static INLINE bool find_listed(uint8_t *m, const uint32_t *at, uint32_t n, struct active *active,
			       uint32_t *found)
{
	uint32_t cursor;

	memcpy(&cursor, m + at[0], sizeof(cursor));
	if (active->each != at || active->next != cursor)
		list_active(m + at[1], cursor, n, active);
	while (active->at == active->count && active->end < n)
		list_active(m + at[1], active->end, n, active);
	active->each = NULL;
	cursor = 0;
	if (active->at < active->count) {
		*found = active->first + active->step[active->at++];
		active->each = at;
		active->next = cursor = *found + 1;
	}
	memcpy(m + at[0], &cursor, sizeof(cursor));
	return cursor != 0;
}

/* Operands of TICK. */
enum { TICK_HOLD, TICK_LAST, TICK_DT, TICK_X, TICK_T, TICK_WORDS };

static inline void add_time(uint8_t *at, int64_t dt)
{
	int64_t value;

	memcpy(&value, at, sizeof(value));
	value = (int64_t)((uint64_t)value + (uint64_t)dt);
	memcpy(at, &value, sizeof(value));
}

/* The times of at least MANY. If an EACH of the same BOOLs is next, it takes the list. */
static inline void tick_listed(uint8_t *m, const uint32_t *at, uint32_t n, int64_t dt,
			       struct active *active)
{
	const uint32_t *each = at + TICK_WORDS;

	active->end = 0;
	do {
		list_active(m + at[TICK_X], active->end, n, active);
		for (uint32_t i = 0; i < active->count; i++)
			add_time(m + at[TICK_T] + (active->first + active->step[i]) * sizeof(dt), dt);
	} while (active->end < n);
	if (*each == (VM_EACH | n << 8) && each[2] == at[TICK_X] && active->first == 0)
		active->each = each + 1;
}

static SELDOM void tick(uint8_t *m, const uint32_t *at, uint32_t n, int64_t now_ns,
			struct active *active)
{
	const uint8_t *x = m + at[TICK_X];
	uint8_t *t = m + at[TICK_T];
	int64_t last, dt;

	memcpy(&last, m + at[TICK_LAST], sizeof(last));
	memcpy(m + at[TICK_LAST], &now_ns, sizeof(now_ns));
	dt = m[at[TICK_HOLD]] ? 0 : (int64_t)((uint64_t)now_ns - (uint64_t)last);
	memcpy(m + at[TICK_DT], &dt, sizeof(dt));
	if (HAS_LISTS && n >= MANY) {
		tick_listed(m, at, n, dt, active);
		return;
	}
	for (uint32_t i = next_true(x, 0, n); i < n; i = next_true(x, i + 1, n))
		add_time(t + i * sizeof(dt), dt);
}

/* ---- calls through the catalogue ---- */

/* Calls through the catalogue: a row without its function does not link. */
#define FB(id, ...) static void step_##id(void *fb, int64_t now_ns) \
	{ fb_##id##_step(fb, now_ns); }
#include "engine/catalog.def"

static void (*const fb_table[WORD_KNOWN])(void *fb, int64_t now_ns) = {
#define FB(id, ...) [FB_##id] = step_##id,
#include "engine/catalog.def"
};

static enum fn_status (*const fn_table[WORD_KNOWN])(struct fn_args *) = {
#define FN(id, ...) [FN_##id] = fn_##id,
#include "engine/catalog.def"
};

#ifndef VM_COUNTS_BACK
enum fn_status vm_function(enum word word, struct fn_args *args)
{
	return fn_table[word](args);
}

const char *fault_text(enum fault fault)
{
	static const char *const text[FAULT_COUNT] = {
		[FAULT_NONE] = "none",
		[FAULT_BUDGET] = "instruction budget of the scan exceeded (a loop?)",
		[FAULT_WATCHDOG] = "watchdog: scan too late or too long",
		[FAULT_IO] = "inputs or outputs do not answer",
		[FAULT_CODE] = "the program in memory is damaged",
	};

	return fault < FAULT_COUNT ? text[fault] : "unknown";
}
#endif

/* Bit @i of @d as 0 or 1. A PC is faster when it tests a mask; ARM shifts in fewer instructions. */
#if defined(__x86_64__) && !defined(__OPTIMIZE_SIZE__)
#define BIT_OF(d, i) (((d) & 1u << (i)) != 0)
#else
#define BIT_OF(d, i) ((uint8_t)((d) >> (i) & 1u))
#endif

/* Contacts become these: a bit by a truth table of three others. Without branches, so
 * that its time does not depend on the inputs. The index is 0..7, as the verifier
 * admits only 0 and 1 for a BOOL. */
static inline void look_up(uint8_t *m, const uint32_t *pc)
{
	uint32_t i = m[pc[0]] + 2u * m[pc[1]] + 4u * m[pc[2]];
	uint32_t d = pc[3];

	m[d >> 8] = BIT_OF(d, i & 31u);
}

/* Less than four of them: what a LUT between other instructions has. */
static INLINE const uint32_t *run_few(uint8_t *m, const uint32_t *pc, uint32_t n)
{
	if (n & 2) {
		look_up(m, pc);
		look_up(m, pc + 4);
		pc += 8;
	}
	if (n & 1) {
		look_up(m, pc);
		pc += 4;
	}
	return pc;
}

static inline void look_up_four(uint8_t *m, const uint32_t *pc)
{
	look_up(m, pc);
	look_up(m, pc + 4);
	look_up(m, pc + 8);
	look_up(m, pc + 12);
}

static SELDOM const uint32_t *run_lut(uint8_t *m, const uint32_t *pc, uint32_t n)
{
	for (; HAS_OFTEN && n >= 8; n -= 8, pc += 32) {
		look_up_four(m, pc);
		look_up_four(m, pc + 16);
	}
	for (; n >= 4; n -= 4, pc += 16)
		look_up_four(m, pc);
	return run_few(m, pc, n);
}

#if !defined(RUNGBOARD_SMALL) && !defined(VM_COUNTS_BACK)
void vm_look_up(uint8_t *memory, const uint32_t *part, uint32_t n)
{
	run_lut(memory, part, n);
}
#endif

/* ---- two numbers of one type ---- The most frequent functions have instructions of
 * their own, which need no struct fn_args. Results are the same bits as those of the
 * functions. No branch depends on a value, as values change from scan to scan. */

/* Does it run without a look at the old value? */
static inline bool runs_straight(const uint8_t *m, const uint32_t *pc, uint32_t n)
{
	return HAS_OFTEN && (!(n & MATH_ENABLED) || (n & MATH_LIKELY && LIKELY(m[pc[0]])));
}

static float single(const uint8_t *at)
{
	float value;

	memcpy(&value, at, sizeof(value));
	return value;
}

/* One rounding of the exact result; double and a second rounding give the same. */
static inline float compute_real(uint32_t math, float a, float b)
{
	if (LIKELY(math == MATH_ADD))
		return a + b;
	if (math == MATH_SUB)
		return a - b;
	return math == MATH_MUL ? a * b : a / b; /* by 0: infinite or NaN */
}

/* Both: not 0 if it ran and failed. Their bits are numbers and not bool, and are joined
 * by & and ^, as a compiler makes a branch of && and of !. */
static INLINE uint32_t run_real(uint8_t *m, const uint32_t *pc, uint32_t n)
{
	float a = single(m + pc[3]), b = single(m + pc[4]);
	float out = LIKELY(MATH_OF(n) == MATH_ADD) ? a + b : compute_real(MATH_OF(n), a, b);
	uint32_t bits, old, en, good;

	memcpy(&bits, &out, sizeof(bits));
	good = bits << 1 < 0xff000000u; /* finite */
	if (LIKELY(runs_straight(m, pc, n))) {
		m[pc[1]] = (uint8_t)good;
		if (LIKELY(good))
			memcpy(m + pc[2], &bits, sizeof(bits));
		else if (n & MATH_LEFT)
			memcpy(m + pc[2], &a, sizeof(a));
		return good ^ 1u;
	}
	en = m[pc[0]];
	memcpy(&old, m + pc[n & MATH_LEFT ? 3 : 2], sizeof(old));
	bits = old ^ ((old ^ bits) & (0u - (en & good)));
	memcpy(m + pc[2], &bits, sizeof(bits));
	m[pc[1]] = (uint8_t)(en & good);
	return en & (good ^ 1u);
}

/* One of a row of REAL, of which each runs if the one before did; @en: did it? Returns whether this one did. */
static INLINE uint32_t run_in_row(uint8_t *m, const uint32_t *pc, uint32_t n, uint32_t en)
{
	float a = single(m + pc[3]), b = single(m + pc[4]);
	float out = LIKELY(MATH_OF(n) == MATH_ADD) ? a + b :
		    LIKELY(MATH_OF(n) == MATH_MUL) ? a * b : compute_real(MATH_OF(n), a, b);
	uint32_t bits, old;

	memcpy(&bits, &out, sizeof(bits));
	memcpy(&old, m + pc[2], sizeof(old));
	en &= bits << 1 < 0xff000000u; /* finite */
	bits = old ^ ((old ^ bits) & (0u - en));
	memcpy(m + pc[2], &bits, sizeof(bits));
	m[pc[1]] = (uint8_t)en;
	return en;
}

/* A quotient or what remains. */
static SELDOM uint32_t divide(uint32_t math, int32_t a, int32_t b, int32_t low, int64_t *out)
{
	*out = 0;
	if (math == MATH_MOD && b == -1) /* nothing remains; MIN % -1 would trap */
		return 1;
	if (b == 0 || (b == -1 && a == low))
		return 0;
	*out = math == MATH_DIV ? a / b : a % b;
	return 1;
}

/* 0: there is no result, nothing is stored. */
static INLINE uint32_t compute_whole(uint32_t math, int32_t a, int32_t b, int32_t low,
				     int64_t *out)
{
	if (LIKELY(math == MATH_ADD)) {
		*out = (int64_t)a + b;
		return 1;
	}
	if (math == MATH_SUB) {
		*out = (int64_t)a - b;
		return 1;
	}
	if (math == MATH_MUL) {
		*out = (int64_t)a * b;
		return 1;
	}
	return divide(math, a, b, low, out);
}

static inline uint32_t fits(int64_t value, size_t size)
{
	return value == (size == 2 ? (int16_t)value : (int32_t)value);
}

/* How two values compare: bit 0: a >= b, bit 1: a <= b; neither: not a number. */
#define ORDER(a, b) ((uint32_t)((a) >= (b)) | (uint32_t)((a) <= (b)) << 1)

/* Operands of what follows on MATH_LOOP, from the ADD on. */
enum { LOOP_CMP = 6, LOOP_RIGHT = 8, LOOP_TEST = 10, LOOP_JUMP = 11, LOOP_WORDS = 14 };

/* ADD, CMP and JMPC at once. False: the sum does not fit, nothing was done; @more: does it jump? */
static INLINE bool step(uint8_t *m, const uint32_t *pc, size_t size, bool *more)
{
	const int64_t sum = (int64_t)whole(m + pc[4], size) + whole(m + pc[5], size);
	const uint32_t table = pc[LOOP_CMP] >> 8, unless = pc[LOOP_JUMP] >> 8;
	int32_t right;
	bool is;

	if (!LIKELY(fits(sum, size)))
		return false;
	memcpy(m + pc[3], &sum, size); /* its low bytes: little-endian */
	m[pc[2]] = 1;
	right = whole(m + pc[LOOP_RIGHT], size); /* behind the sum, which it may be */
	is = LIKELY(table == CODE_AT_MOST) ? sum <= right : table >> ORDER(sum, right) & 1;
	m[pc[LOOP_TEST]] = is;
	*more = is != unless;
	return true;
}

/* The same for INT and DINT, by their size: overflow wraps and is an error. */
static INLINE uint32_t run_whole(uint8_t *m, const uint32_t *pc, uint32_t n, size_t size)
{
	int32_t low = size == 2 ? INT16_MIN : INT32_MIN;
	int32_t a = whole(m + pc[3], size), old, bits;
	int64_t out;
	uint32_t some = compute_whole(MATH_OF(n), a, whole(m + pc[4], size), low, &out);
	uint32_t good = some & fits(out, size), en;

	en = m[pc[0]];
	old = whole(m + pc[n & MATH_LEFT ? 3 : 2], size);
	bits = old ^ ((old ^ (int32_t)out) & -(int32_t)(en & some));
	memcpy(m + pc[2], &bits, size);
	m[pc[1]] = (uint8_t)(en & good);
	return en & (good ^ 1u);
}

/* The usual way: it is enabled and its result fits. False: nothing was done. */
static INLINE bool run_quick(uint8_t *m, const uint32_t *pc, uint32_t n, size_t size)
{
	const int64_t a = whole(m + pc[3], size), b = whole(m + pc[4], size);
	int64_t out;

	if (!runs_straight(m, pc, n))
		return false;
	if (LIKELY(MATH_OF(n) == MATH_ADD)) {
		out = a + b;
	} else if (LIKELY(MATH_OF(n) == MATH_MUL)) {
		out = a * b;
	} else if (LIKELY(MATH_OF(n) == MATH_SUB)) {
		out = a - b;
	} else {
		if (b == 0 || b == -1)
			return false;
		out = MATH_OF(n) == MATH_DIV ? (int32_t)a / (int32_t)b : (int32_t)a % (int32_t)b;
	}
	if (!LIKELY(fits(out, size)))
		return false;
	m[pc[1]] = 1;
	memcpy(m + pc[2], &out, size); /* its low bytes: little-endian */
	return true;
}

static int64_t time_at(const uint8_t *at)
{
	int64_t value;

	memcpy(&value, at, sizeof(value));
	return value;
}

static uint32_t order(const uint8_t *m, const uint32_t *pc)
{
	uint32_t left = CODE_TYPE(pc[0]), right = CODE_TYPE(pc[1]);

	/* The times of steps and timers. */
	if (HAS_OFTEN && LIKELY(left == IEC_TIME) && right == IEC_TIME) {
		int64_t a = time_at(m + CODE_OFFSET(pc[0])), b = time_at(m + CODE_OFFSET(pc[1]));

		return ORDER(a, b);
	}
	if (is_real(pc[0]) || is_real(pc[1])) {
		double a = real(m, pc[0]), b = real(m, pc[1]);

		return ORDER(a, b);
	}
	if (left == IEC_STRING) {
		int order = value_order(text(m, pc[0]), text(m, pc[1]));

		return ORDER(order, 0);
	}
	int64_t a = integer(m, pc[0]), b = integer(m, pc[1]);

	if (iec_is_wide(left) || iec_is_wide(right))
		return ORDER((uint64_t)a, (uint64_t)b);
	return ORDER(a, b);
}

/* As look_up(), with an order instead of two bits. */
static inline const uint32_t *put_order(uint8_t *m, const uint32_t *pc, uint32_t n,
					uint32_t order)
{
	uint32_t i = order + 4u * m[pc[3]];

	m[pc[4]] = n >> (i & 31u) & 1u;
	return pc + 5;
}

/* One input: widened to the shared type, or in its own type. */
static union iec_value fetch(const uint8_t *m, uint32_t word, uint32_t type)
{
	union iec_value value;

	if (value_is_real(type))
		value.r = real(m, word);
	else if (type == IEC_STRING)
		value.s = text(m, word);
	else
		value.i = integer(m, word);
	return value;
}

/* Stores the result of a function; false: it did not fit. */
static bool store(uint8_t *m, uint32_t word, const struct fn_args *args)
{
	union iec_value out = args->out;

	if (args->result == IEC_STRING)
		return put_text(m, word, out.s);
	if (is_real(word) && !value_is_real(args->result))
		out.r = (double)out.i;
	put(m, word, out);
	return true;
}

/* True if it ran without an error. */
static OWN_FRAME bool run_fn(uint8_t *m, const uint32_t *pc, uint32_t n)
{
	uint32_t room[(sizeof(struct iec_string) + IEC_STRING_MOST + 3) / 4];
	struct fn_args args;
	enum fn_status status;

	args.type = (enum iec_type)(n & 0xff);
	args.result = (enum iec_type)(n >> 16);
	args.count = n >> 8 & 0xff;
	args.room = (void *)room;
	args.room->capacity = IEC_STRING_MOST;
	for (uint32_t i = 0; i < args.count; i++) {
		uint32_t word = pc[4 + i] & ~CODE_OWN;
		uint32_t type = pc[4 + i] & CODE_OWN ? CODE_TYPE(word) : args.type;

		args.in_type[i] = (enum iec_type)type;
		args.in[i] = fetch(m, word, type);
	}
	status = fn_table[pc[0]](&args);
	if (status == FN_FAILED)
		return false;
	return store(m, pc[3], &args) && status == FN_OK;
}

static void count_error(struct vm *vm, const uint32_t *pc, const uint32_t *base)
{
	if (vm->errors++ == 0)
		vm->error_text = (uint32_t)(pc - base);
}

#ifndef RUNGBOARD_SMALL
/* PEEK and POKE. */
static SELDOM void run_pointer(struct vm *vm, const uint32_t *pc, const uint32_t *base)
{
	uint8_t *m = vm->memory;
	const bool get = (*pc & 0xff) == VM_PEEK, all = *pc >> 8;
	static const struct iec_string none = { 0, 0 };

	m[pc[2]] = m[pc[1]] && (all ? copy_whole(vm, pc + 1, !get) :
				get ? peek(vm, pc + 1) : poke(vm, pc + 1));
	if (m[pc[2]])
		return;
	if (get && !all && CODE_TYPE(pc[3]) == IEC_STRING)
		put_text(m, pc[3], &none);
	else if (get && !all)
		put(m, pc[3], (union iec_value){ .i = 0 });
	if (m[pc[1]])
		count_error(vm, pc, base);
}
#endif

static void ask_to_stop(struct vm *vm, uint32_t text)
{
	if (!vm->stop)
		vm->stop_text = text;
	vm->stop = true;
}

/* A jump back costs the words it goes back over. Jumps forward cost nothing. */
static inline bool spend(uint32_t *budget, const uint32_t *from, const uint32_t *to)
{
	uint32_t cost = to <= from ? (uint32_t)(from - to) + 1 : 0;

	if (cost > *budget)
		return false;
	*budget -= cost;
	return true;
}

/* A jump back to an EACH costs the words since its target, at @run. */
static inline bool spend_each(uint32_t *budget, const uint32_t *from, const uint32_t *to,
		       const uint32_t *run, uint32_t words)
{
	uint32_t cost;

	if (to > from || (*to & 0xff) != VM_EACH)
		return spend(budget, from, to);
	cost = from >= run ? (uint32_t)(from - run) + 1 : words;
	if (cost > *budget)
		return false;
	*budget -= cost;
	return true;
}

/* A call costs the words of its program; loops in it cost extra when they jump back. */
static inline bool pay(uint32_t *budget, uint32_t cost)
{
	if (cost > *budget)
		return false;
	*budget -= cost;
	return true;
}

/* engine/trial/vm_counting.c is this file again, with a call at each jump back. */
#ifdef VM_COUNTS_BACK
static inline void count_back(struct vm *vm, const uint32_t *from, const uint32_t *to)
{
	if (vm->went_back && to <= from && (*to & 0xff) != VM_EACH)
		vm->went_back(vm, from);
}
#else
#define count_back(vm, from, to) ((void)0)
#endif

/* engine/trial/vm_stepping.c is it once more: it looks at each instruction, so that none may be joined
 * with the one before. */
#ifdef VM_STEPS
#define JOINS false
static bool stands(struct vm *vm, const uint32_t *pc, const uint32_t *base,
		   const uint32_t *const *back, uint32_t depth, const uint32_t *run, bool *fresh)
{
	struct vm_stand *stand = vm->stand;
	const bool asked = *fresh;

	*fresh = false;
	if (!stand || asked || !stand->begins[pc - base])
		return false;
	stand->word = (uint32_t)(pc - base);
	stand->depth = depth;
	for (uint32_t i = 0; i < depth; i++)
		stand->back[i] = (uint32_t)(back[i] - base);
	stand->run = (uint32_t)(run - base);
	stand->stands = stand->asks(stand, vm);
	return stand->stands;
}

static bool stood(const struct vm *vm, const uint32_t *base, const uint32_t **pc,
		  const uint32_t **back, uint32_t *depth, const uint32_t **run)
{
	struct vm_stand *stand = vm->stand;

	if (!stand)
		return false;
	stand->starts += !stand->stands;
	if (!stand->stands)
		return false;
	stand->stands = false;
	*pc = base + stand->word;
	*run = base + stand->run;
	*depth = stand->depth;
	for (uint32_t i = 0; i < stand->depth; i++)
		back[i] = base + stand->back[i];
	return true;
}
#else
#define JOINS true
#define stands(vm, pc, base, back, depth, run, fresh) ((void)(fresh), false)
#define stood(vm, base, pc, back, depth, run) false
#endif

/* Loops consist of few instructions, which often follow each other: it saves time to look
 * whether the next one is that, before the switch does. */
#define NEXT_OFTEN(pc, op) (HAS_OFTEN && JOINS && LIKELY((*(pc) & 0xff) == (op)))

enum fault vm_run(struct vm *vm, uint32_t entry, bool watch)
{
	const struct program *program = vm->program;
	const struct code_program *at = &program->entry[entry];
	const uint32_t *base = watch ? program->watch : program->text;
	const uint32_t *pc = base + (vm->resume ? vm->resume : watch ? at->watch : at->text);
	uint8_t *m = vm->memory;
	const uint32_t *back[LIMIT_CALLS]; /* return addresses                */
	const uint32_t *run = pc;          /* last target of EACH            */
	uint32_t depth = 0, found, budget = vm->budget; /* a local for speed */
	bool more;
	struct active active;

	const uint32_t *until = HAS_STILL && vm->until ? base + vm->until : NULL;
	bool fresh = stood(vm, base, &pc, back, &depth, &run);

	active.each = NULL;
	vm->resume = 0;
	if (HAS_STILL)
		vm->until = 0;
	for (;;) {
		uint32_t word = *pc, n = word >> 8;

		if (stands(vm, pc, base, back, depth, run, &fresh)) {
			vm->budget = budget;
			vm->resume = (uint32_t)(pc - base);
			return FAULT_PAUSED;
		}
		switch ((enum vm_op)(word & 0xff)) {
		case VM_END:
			if (depth == 0) {
				vm->budget = budget;
				return FAULT_NONE;
			}
			pc = back[--depth];
			break;
		case VM_LUT:
			if (HAS_STILL && pc == until) {
				vm->budget = budget;
				return FAULT_NONE;
			}
			pc = HAS_OFTEN && n < 4 ? run_few(m, pc + 1, n) : run_lut(m, pc + 1, n);
			break;
		case VM_BITGET:
			m[pc[2]] = m[pc[1]] >> n & 1u;
			pc += 3;
			break;
		case VM_BITPUT:
			m[pc[2]] = (uint8_t)((m[pc[2]] & ~(1u << n)) |
					     (uint32_t)m[pc[1]] << n);
			pc += 3;
			break;
		case VM_COPY:
			if (m[pc[1]])
				copy(m, pc + 1, n);
			pc += 4;
			break;
		case VM_CMP:
			pc = put_order(m, pc, n, order(m, pc + 1));
			break;
		case VM_INT:
			if (HAS_OFTEN && JOINS && n & MATH_LOOP && step(m, pc, 2, &more)) {
				pc += more ? LOOP_JUMP : LOOP_WORDS;
				if (more)
					goto jump;
				break;
			}
			if (!run_quick(m, pc + 1, n, 2) && run_whole(m, pc + 1, n, 2))
				count_error(vm, pc, base);
			pc += 6;
			n = *pc >> 8;
			if (!NEXT_OFTEN(pc, VM_CMP_INT))
				break;
			/* fall through */
		case VM_CMP_INT:
			pc = put_order(m, pc, n, ORDER(whole(m + pc[1], 2),
						       whole(m + pc[2], 2)));
			if (NEXT_OFTEN(pc, VM_JMPC))
				goto jump_if;
			break;
		case VM_DINT:
			if (HAS_OFTEN && JOINS && n & MATH_LOOP && step(m, pc, 4, &more)) {
				pc += more ? LOOP_JUMP : LOOP_WORDS;
				if (more)
					goto jump;
				break;
			}
			if (!run_quick(m, pc + 1, n, 4) && run_whole(m, pc + 1, n, 4))
				count_error(vm, pc, base);
			pc += 6;
			n = *pc >> 8;
			if (!NEXT_OFTEN(pc, VM_CMP_DINT))
				break;
			/* fall through */
		case VM_CMP_DINT:
			pc = put_order(m, pc, n, ORDER(whole(m + pc[1], 4),
						       whole(m + pc[2], 4)));
			if (NEXT_OFTEN(pc, VM_JMPC))
				goto jump_if;
			break;
		case VM_REAL:
			if (HAS_OFTEN && JOINS && n & MATH_ROW) {
				uint32_t en = m[pc[1]], ran;

				do {
					n = *pc >> 8;
					ran = run_in_row(m, pc + 1, n, en);
					if (!LIKELY(ran == en))
						count_error(vm, pc, base);
					en = ran;
					pc += 6;
				} while (n & MATH_ROW);
				break;
			}
			if (!LIKELY(!run_real(m, pc + 1, n)))
				count_error(vm, pc, base);
			pc += 6;
			n = *pc >> 8;
			/* A sum is often followed by a comparison. */
			if (!JOINS || !LIKELY((*pc & 0xff) == VM_CMP_REAL))
				break;
			/* fall through */
		case VM_CMP_REAL:
			pc = put_order(m, pc, n, ORDER(single(m + pc[1]),
						       single(m + pc[2])));
			break;
		case VM_FN:
			if (!m[pc[2]])
				m[pc[3]] = 0;
			else if (!(m[pc[3]] = run_fn(m, pc + 1, n)))
				count_error(vm, pc, base);
			pc += 5 + (n >> 8 & 0xff);
			break;
		case VM_FB:
			fb_table[n](m + pc[1], vm->now_ns);
			pc += 2;
			break;
		case VM_BLOCK:
			if (!pay(&budget, pc[3] / 8))
				goto out_of_budget;
			memmove(m + pc[1], m + pc[2], pc[3]);
			pc += 4;
			break;
		case VM_CALL:
			at = &program->entry[pc[1]];
			if (!pay(&budget, watch ? at->watch_words : at->text_words))
				goto out_of_budget;
			vm->called += at->text_words;
			back[depth++] = pc + 2;
			pc = base + (watch ? at->watch : at->text);
			break;
		case VM_STOP:
			if (m[pc[1]])
				ask_to_stop(vm, (uint32_t)(pc - base));
			pc += 2;
			break;
		case VM_JMPC:
		jump_if:
			if (m[pc[2]] == *pc >> 8) {
				pc += 3;
				break;
			}
			/* fall through */
		case VM_JMP:
		jump:
			if (HAS_OFTEN && base + pc[1] > pc) {
				pc = base + pc[1];
				break;
			}
			if (!spend_each(&budget, pc, base + pc[1], run,
					watch ? program->watch_words : program->text_words))
				goto out_of_budget;
			count_back(vm, pc, base + pc[1]);
			pc = base + pc[1];
			n = *pc >> 8;
			/* Back to EACH, for the next active step. */
			if ((*pc & 0xff) == VM_EACH)
				goto each;
			break;
		case VM_SWITCH:
			pc = choose(m, pc, base);
			break;
		case VM_AGET:
			if (LIKELY(run_short(m, pc + 1, n, false))) {
				pc += 9;
				break;
			}
			found = n & CODE_KEEP;
			n &= CODE_ACCESS;
			m[pc[2]] = m[pc[1]] && get_element(m, pc + 1, n);
			if (!m[pc[2]]) {
				if (!found)
					clear_value(m, pc + 1);
				if (m[pc[1]])
					count_error(vm, pc, base);
			}
			pc += 9 + 4 * (n >> 1);
			break;
		case VM_APUT:
			if (LIKELY(run_short(m, pc + 1, n, true))) {
				pc += 9;
				break;
			}
			n &= CODE_ACCESS;
			m[pc[2]] = m[pc[1]] && put_element(m, pc + 1, n);
			if (m[pc[1]] && !m[pc[2]])
				count_error(vm, pc, base);
			pc += 9 + 4 * (n >> 1);
			break;
		WITH_POINTERS(case VM_PEEK: case VM_POKE:
			if (n && !pay(&budget, pc[6] / 4))
				goto out_of_budget;
			run_pointer(vm, pc, base);
			active.each = NULL; /* it may have made a step active */
			pc += 8;
			break;)
		case VM_ABLOCK:
			if (!pay(&budget, pc[5] / 8))
				goto out_of_budget;
			m[pc[2]] = m[pc[1]] && move_element(m, pc + 1, n);
			if (m[pc[1]] && !m[pc[2]])
				count_error(vm, pc, base);
			pc += 10 + 4 * (n >> 1);
			break;
		case VM_EACH:
		each:
			if (!pay(&budget, 1 + n / 8))
				goto out_of_budget;
			if (!(HAS_LISTS && n >= MANY ? find_listed(m, pc + 1, n, &active, &found) :
						       find_step(m, pc + 1, n, &found))) {
				pc += 3 + n;
				break;
			}
			if (HAS_LISTS && n >= MANY && active.at < active.count) /* where it will go on */
				__builtin_prefetch(base + pc[3 + active.first + active.step[active.at]]);
			run = base + pc[3 + found];
			if (!spend(&budget, pc, run))
				goto out_of_budget;
			pc = run;
			break;
		case VM_TICK:
			if (!pay(&budget, 1 + n))
				goto out_of_budget;
			tick(m, pc + 1, n, vm->now_ns, HAS_LISTS ? &active : NULL);
			pc += 1 + TICK_WORDS;
			break;
		case VM_POINT:
			vm->points++;
			if (LIKELY(!vm->ask) || !vm->at_point) {
				pc++;
				break;
			}
			pc++;
			if (!vm->at_point(vm, n))
				break;
			vm->budget = budget;
			vm->resume = (uint32_t)(pc - base);
			return FAULT_PAUSED;
		case VM_COUNT:
		default:
			return FAULT_CODE;
		}
	}
out_of_budget:
	vm->budget = budget;
	vm->fault_text = (uint32_t)(pc - base);
	return FAULT_BUDGET;
}
