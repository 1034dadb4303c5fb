/* SPDX-License-Identifier: MIT
 *
 * code - the verifier: the only way from bytes to a program that may run.
 *
 * Every byte of data memory gets a mark that tells what may be read or written
 * there as what. Then each instruction is held against the marks. It repairs
 * nothing and guesses nothing.
 */
#include "engine/scan/code.h"

#include "engine/base/digest.h"

#include <stdio.h>
#include <string.h>

/* Marks: MARK_TYPE + type at the first byte of a value; read-only ones too. */
enum mark {
	MARK_NONE, MARK_INSIDE, MARK_AREA_READ, MARK_AREA_WRITE,
	MARK_VALUE = 32, MARK_FIXED = 64,
};

struct verifier {
	struct program *program;
	struct arena *scratch;
	uint8_t *mark;         /* one a byte of data memory                 */
	uint32_t data_size, areas;
	size_t where;          /* byte offset of what broke a rule          */
};

static bool value_type(uint32_t type)
{
	return type > IEC_NONE && type < IEC_TYPE_COUNT;
}

static uint32_t type_size(uint32_t type)
{
	return iec_type_row((enum iec_type)type)->size;
}

/* An area operand may lie at any byte, but not leave its area. */
static bool in_area(const struct verifier *v, uint32_t offset, uint32_t size,
		    bool write)
{
	for (uint32_t i = 0; i < size; i++) {
		uint8_t mark = v->mark[offset + i];

		if (mark != MARK_AREA_WRITE &&
		    (write || mark != MARK_AREA_READ))
			return false;
	}
	return true;
}

static bool can_use(const struct verifier *v, uint32_t offset, uint32_t type,
		    bool write)
{
	if (!value_type(type) || offset >= v->data_size ||
	    v->data_size - offset < type_size(type))
		return false;
	if (v->mark[offset] == MARK_VALUE + type)
		return true;
	if (v->mark[offset] == MARK_FIXED + type)
		return !write;
	return offset < v->areas && type != IEC_BOOL &&
	       in_area(v, offset, type_size(type), write);
}

static bool can_read(const struct verifier *v, uint32_t operand)
{
	return can_use(v, CODE_OFFSET(operand), CODE_TYPE(operand), false);
}

static bool can_write(const struct verifier *v, uint32_t operand)
{
	return can_use(v, CODE_OFFSET(operand), CODE_TYPE(operand), true);
}

static bool reads_bool(const struct verifier *v, uint32_t offset)
{
	return can_use(v, offset, IEC_BOOL, false);
}

static bool writes_bool(const struct verifier *v, uint32_t offset)
{
	return can_use(v, offset, IEC_BOOL, true);
}

/* ---- header and sections ---- */

static const uint32_t section_unit[CODE_SECTION_COUNT] = {
	[0] = 1,
	[CODE_PROGRAMS] = sizeof(struct code_program),
	[CODE_LAYOUT] = sizeof(struct code_run),
	[CODE_INIT] = 4,
	[CODE_BITS] = sizeof(struct code_bits),
	[CODE_TEXT] = 4,
	[CODE_WATCH] = 4,
	[CODE_SYMBOLS] = sizeof(struct code_symbol),
	[CODE_POWER] = sizeof(struct code_power),
	[CODE_PLACES] = sizeof(struct code_place),
	[CODE_STRINGS] = 1,
};

static uint32_t section(const struct program *program, int kind,
			const void **start)
{
	const struct code_section *at = &program->header->section[kind];

	*start = program->base + at->offset;
	return at->size / section_unit[kind];
}

static bool check_header(const void *bytes, size_t len, enum diag_id *why)
{
	const struct code_header *header = bytes;
	size_t covered = offsetof(struct code_header, crc) + 4;

	*why = DIAG_IMAGE_MAGIC;
	if (len < sizeof(header->magic) ||
	    memcmp(header->magic, CODE_MAGIC, sizeof(header->magic)) != 0)
		return false;
	*why = DIAG_IMAGE_DAMAGED;
	if (len < sizeof(*header) || len > LIMIT_IMAGE)
		return false;
	*why = DIAG_IMAGE_VERSION;
	if (header->version != CODE_VERSION)
		return false;
	*why = DIAG_IMAGE_DAMAGED;
	if (header->size != len ||
	    header->crc != digest_crc32c(0, (const uint8_t *)bytes + covered,
					 len - covered))
		return false;
	for (int i = 1; i < CODE_SECTION_COUNT; i++) {
		const struct code_section *at = &header->section[i];

		if (at->offset % 4 || at->offset < sizeof(*header) ||
		    at->offset > len || at->size > len - at->offset ||
		    at->size % section_unit[i])
			return false;
	}
	return true;
}

static void find_sections(struct program *p)
{
	const void *at;

	p->entry_count = section(p, CODE_PROGRAMS, &at), p->entry = at;
	p->run_count = section(p, CODE_LAYOUT, &at), p->run = at;
	p->bits_count = section(p, CODE_BITS, &at), p->bits = at;
	p->text_words = section(p, CODE_TEXT, &at), p->text = at;
	p->watch_words = section(p, CODE_WATCH, &at), p->watch = at;
	p->symbol_count = section(p, CODE_SYMBOLS, &at), p->symbol = at;
	p->power_count = section(p, CODE_POWER, &at), p->power = at;
	p->place_count = section(p, CODE_PLACES, &at), p->place = at;
	p->string_bytes = section(p, CODE_STRINGS, &at), p->string = at;
}

static bool refuse(struct verifier *v, const void *at)
{
	v->where = (size_t)((const uint8_t *)at - v->program->base);
	return false;
}

/* ---- data layout ---- */

static void mark_instance(struct verifier *v, uint32_t offset,
			  const struct word_row *row)
{
	memset(v->mark + offset, MARK_INSIDE, row->size);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (pin->dir != PIN_VAR)
			v->mark[offset + pin->offset] = (uint8_t)
				((pin->dir == PIN_IN ? MARK_VALUE : MARK_FIXED) +
				 pin->type);
	}
}

static void mark_value(struct verifier *v, uint32_t offset,
		       const struct code_run *run)
{
	int base = run->kind == RUN_CONSTANTS ? MARK_FIXED : MARK_VALUE;

	memset(v->mark + offset, MARK_INSIDE, type_size(run->type));
	v->mark[offset] = (uint8_t)(base + run->type);
}

static bool mark_run(struct verifier *v, const struct code_run *run,
		     uint32_t *end)
{
	bool instance = run->kind == RUN_INSTANCE;
	uint32_t size, align;

	if (run->kind > RUN_INSTANCE || run->offset < *end)
		return refuse(v, run);
	if (instance ? run->word >= WORD_COUNT ||
		       word_row((enum word)run->word)->kind != WORD_FB
		     : !value_type(run->type))
		return refuse(v, run);
	size = instance ? word_row((enum word)run->word)->size
			: type_size(run->type);
	align = instance ? 8 : size;
	if (run->offset % align || run->offset > v->data_size ||
	    run->count > (v->data_size - run->offset) / size)
		return refuse(v, run);
	for (uint32_t i = 0; i < run->count; i++)
		if (instance)
			mark_instance(v, run->offset + i * size,
				      word_row((enum word)run->word));
		else
			mark_value(v, run->offset + i * size, run);
	*end = run->offset + run->count * size;
	return true;
}

static bool check_layout(struct verifier *v)
{
	const struct program *p = v->program;
	uint32_t end = v->areas;

	for (int area = 1; area < AREA_COUNT; area++) {
		const struct iec_area_row *row = iec_area_row((enum iec_area)area);

		memset(v->mark + row->offset, row->access == ACCESS_WRITE ?
		       MARK_AREA_WRITE : MARK_AREA_READ, row->bytes);
	}
	for (uint32_t i = 0; i < p->run_count; i++)
		if (!mark_run(v, &p->run[i], &end))
			return false;
	if (v->mark[CODE_FALSE_AT(v->areas)] != MARK_FIXED + IEC_BOOL ||
	    v->mark[CODE_TRUE_AT(v->areas)] != MARK_FIXED + IEC_BOOL ||
	    p->header->retain_offset > v->data_size ||
	    p->header->retain_size > v->data_size - p->header->retain_offset ||
	    p->header->budget > LIMIT_BUDGET)
		return refuse(v, p->header);
	return true;
}

/* Initial bytes must be whole values; a BOOL among them 0 or 1. */
static bool check_init_bytes(struct verifier *v, uint32_t offset,
			     const uint8_t *bytes, uint32_t len)
{
	while (len > 0) {
		uint8_t mark = v->mark[offset];
		uint32_t size = 1;

		if (mark >= MARK_VALUE) {
			size = type_size(mark % MARK_VALUE);
			if (mark % MARK_VALUE == IEC_BOOL && bytes[0] > 1)
				return refuse(v, bytes);
		} else if (mark != MARK_AREA_READ && mark != MARK_AREA_WRITE) {
			return refuse(v, bytes);
		}
		if (size > len)
			return refuse(v, bytes);
		offset += size;
		bytes += size;
		len -= size;
	}
	return true;
}

static bool check_init(struct verifier *v)
{
	const uint32_t *at;
	const void *start;
	uint32_t left = section(v->program, CODE_INIT, &start);

	for (at = start; left > 0;) {
		uint32_t words;

		if (left < 2 || at[1] > (left - 2) * 4 || at[0] > v->data_size ||
		    at[1] > v->data_size - at[0])
			return refuse(v, at);
		if (!check_init_bytes(v, at[0], (const uint8_t *)(at + 2), at[1]))
			return false;
		words = 2 + (at[1] + 3) / 4;
		at += words;
		left -= words;
	}
	return true;
}

static bool check_bits(struct verifier *v)
{
	const struct program *p = v->program;
	uint32_t area = 0, end = 0;

	for (uint32_t i = 0; i < p->bits_count; i++) {
		const struct code_bits *bits = &p->bits[i];
		uint32_t most;

		if (bits->area <= AREA_NONE || bits->area >= AREA_COUNT)
			return refuse(v, bits);
		most = iec_area_row((enum iec_area)bits->area)->bytes * 8;
		if (bits->area < area || (bits->area == area && bits->first < end) ||
		    bits->first > most || bits->count > most - bits->first ||
		    bits->slot >= v->data_size ||
		    bits->count > v->data_size - bits->slot)
			return refuse(v, bits);
		for (uint32_t k = 0; k < bits->count; k++)
			if (v->mark[bits->slot + k] != MARK_VALUE + IEC_BOOL)
				return refuse(v, bits);
		area = bits->area;
		end = bits->first + bits->count;
	}
	return true;
}

/* ---- instructions ---- */

uint32_t code_words(const uint32_t *code)
{
	uint32_t n = *code >> 8;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_LUT:
		return 1 + 4 * n;
	case VM_COPY:
	case VM_CMP:
		return 4;
	case VM_FN:
		return 5 + (n >> 8);
	case VM_BITGET:
	case VM_BITPUT:
	case VM_JMPC:
		return 3;
	case VM_FB:
	case VM_JMP:
		return 2;
	case VM_END:
	case VM_COUNT:
		break;
	}
	return 1;
}

static bool is_instance(const struct program *p, uint32_t offset, uint32_t word)
{
	uint32_t low = 0, high = p->run_count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;
		const struct code_run *run = &p->run[middle];

		if (run->offset > offset)
			high = middle;
		else
			low = middle + 1;
	}
	if (low == 0)
		return false;
	const struct code_run *run = &p->run[low - 1];
	uint32_t size;

	if (run->kind != RUN_INSTANCE || run->word != word)
		return false;
	size = word_row((enum word)word)->size;
	return (offset - run->offset) % size == 0 &&
	       (offset - run->offset) / size < run->count;
}

static bool check_lut(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++, at += 4)
		if (!reads_bool(v, at[0]) || !reads_bool(v, at[1]) ||
		    !reads_bool(v, at[2]) || !writes_bool(v, at[3] >> 8))
			return false;
	return n > 0;
}

/* Is @from a type that COPY and FN may take where @to is wanted? */
static bool converts(uint32_t from, uint32_t to)
{
	return value_type(from) && value_type(to) &&
	       iec_can_widen((enum iec_type)from, (enum iec_type)to);
}

static bool check_fn(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	uint32_t type = n & 0xff, count = n >> 8;
	const struct word_row *row;
	uint32_t result;

	if (at[0] >= WORD_COUNT || !value_type(type))
		return false;
	row = word_row((enum word)at[0]);
	if (row->kind != WORD_FN || count < row->pin_count ||
	    count > row->most_inputs ||
	    !(row->pin[0].classes & iec_type_row((enum iec_type)type)->class))
		return false;
	result = row->result == RESULT_BOOL ? IEC_BOOL : type;
	if (!reads_bool(v, at[1]) || !writes_bool(v, at[2]) ||
	    !can_write(v, at[3]) || !converts(result, CODE_TYPE(at[3])))
		return false;
	for (uint32_t i = 0; i < count; i++)
		if (!can_read(v, at[4 + i]) ||
		    !converts(CODE_TYPE(at[4 + i]), type))
			return false;
	return true;
}

static bool check_bit(const struct verifier *v, const uint32_t *at, uint32_t op,
		      uint32_t n)
{
	if (n > 7)
		return false;
	if (op == VM_BITGET)
		return can_use(v, at[0], IEC_BYTE, false) && writes_bool(v, at[1]);
	return reads_bool(v, at[0]) && can_use(v, at[1], IEC_BYTE, true);
}

/* One instruction; jumps are looked at later. */
static bool check_code(const struct verifier *v, const uint32_t *code)
{
	uint32_t op = *code & 0xff, n = *code >> 8;
	const uint32_t *at = code + 1;

	switch ((enum vm_op)op) {
	case VM_END:
	case VM_JMP:
		return n == 0;
	case VM_JMPC:
		return n == 0 && reads_bool(v, at[1]);
	case VM_LUT:
		return check_lut(v, at, n);
	case VM_BITGET:
	case VM_BITPUT:
		return check_bit(v, at, op, n);
	case VM_COPY:
		return n == 0 && reads_bool(v, at[0]) && can_write(v, at[1]) &&
		       can_read(v, at[2]) &&
		       converts(CODE_TYPE(at[2]), CODE_TYPE(at[1]));
	case VM_CMP:
		return n < CMP_COUNT && writes_bool(v, at[0]) &&
		       can_read(v, at[1]) && can_read(v, at[2]);
	case VM_FN:
		return check_fn(v, at, n);
	case VM_FB:
		return n < WORD_COUNT && is_instance(v->program, at[0], n);
	case VM_COUNT:
		break;
	}
	return false;
}

/* code_words() of hostile bytes: no overflow of a huge n. */
static uint32_t words_needed(const uint32_t *code)
{
	bool many = (*code & 0xff) == VM_LUT || (*code & 0xff) == VM_FN;

	if (many && *code >> 8 > LIMIT_IMAGE / 16)
		return UINT32_MAX;
	return code_words(code);
}

/* The instructions of one program: each whole and right, the last one leaves,
 * jumps land on instructions. @starts has a byte a word. */
static bool check_text(struct verifier *v, const uint32_t *base, uint32_t first,
		       uint32_t words, uint8_t *starts)
{
	uint32_t last = VM_COUNT;

	for (uint32_t at = 0; at < words; at += code_words(base + first + at)) {
		const uint32_t *code = base + first + at;

		if ((*code & 0xff) >= VM_COUNT ||
		    words_needed(code) > words - at || !check_code(v, code))
			return refuse(v, code);
		starts[at] = 1;
		last = *code & 0xff;
	}
	if (last != VM_END && last != VM_JMP)
		return refuse(v, base + first);
	for (uint32_t at = 0; at < words; at += code_words(base + first + at)) {
		const uint32_t *code = base + first + at;
		uint32_t op = *code & 0xff;

		if ((op == VM_JMP || op == VM_JMPC) &&
		    (code[1] < first || code[1] - first >= words ||
		     !starts[code[1] - first]))
			return refuse(v, code);
	}
	memset(starts, 0, words);
	return true;
}

static bool check_programs(struct verifier *v)
{
	const struct program *p = v->program;
	uint32_t most = p->text_words > p->watch_words ? p->text_words
						       : p->watch_words;
	uint8_t *starts = arena_alloc(v->scratch, most + 1u);

	if (!starts)
		return false;
	for (uint32_t i = 0; i < p->entry_count; i++) {
		const struct code_program *e = &p->entry[i];

		if (e->text > p->text_words || e->text_words > p->text_words - e->text ||
		    e->watch > p->watch_words ||
		    e->watch_words > p->watch_words - e->watch ||
		    (p->string_bytes && e->name >= p->string_bytes))
			return refuse(v, e);
		if (!check_text(v, p->text, e->text, e->text_words, starts))
			return false;
		if (p->watch_words &&
		    !check_text(v, p->watch, e->watch, e->watch_words, starts))
			return false;
	}
	return true;
}

/* ---- maps ---- */

static bool check_symbol(const struct verifier *v, const struct code_symbol *s)
{
	const struct program *p = v->program;

	if (s->name >= p->string_bytes || s->pou >= p->string_bytes)
		return false;
	if (s->area != AREA_NONE)
		return s->area < AREA_COUNT && s->type == IEC_BOOL &&
		       s->where / 8 <
		       iec_area_row((enum iec_area)s->area)->bytes;
	if (s->type == IEC_NONE)
		return s->word < WORD_COUNT && is_instance(p, s->where, s->word);
	return can_use(v, s->where, s->type, false);
}

static bool check_maps(struct verifier *v)
{
	const struct program *p = v->program;

	if (p->string_bytes && p->string[p->string_bytes - 1] != '\0')
		return refuse(v, p->string);
	for (uint32_t i = 0; i < p->symbol_count; i++)
		if (!check_symbol(v, &p->symbol[i]))
			return refuse(v, &p->symbol[i]);
	for (uint32_t i = 0; i < p->power_count; i++)
		if (!reads_bool(v, p->power[i].in) ||
		    !reads_bool(v, p->power[i].out))
			return refuse(v, &p->power[i]);
	for (uint32_t i = 0; i < p->place_count; i++)
		if (p->place[i].text >= p->text_words ||
		    p->place[i].pou >= p->entry_count)
			return refuse(v, &p->place[i]);
	return true;
}

/* Identity: code and data layout; not the maps a target may drop. */
static void identify(struct program *p)
{
	struct digest_sha256 sha;
	const struct code_header *h = p->header;
	uint32_t head[4] = { h->data_size, h->retain_offset, h->retain_size,
			     h->budget };

	digest_sha256_init(&sha);
	digest_sha256_add(&sha, head, sizeof(head));
	for (uint32_t i = 0; i < p->entry_count; i++)
		digest_sha256_add(&sha, &p->entry[i], 2 * sizeof(uint32_t));
	for (int kind = CODE_LAYOUT; kind <= CODE_TEXT; kind++)
		digest_sha256_add(&sha, p->base + h->section[kind].offset,
				  h->section[kind].size);
	digest_sha256_end(&sha, p->sha256);
}

bool code_open(const void *bytes, size_t len, struct arena *scratch,
	       struct program *out, enum diag_id *why, size_t *where)
{
	struct verifier v = { .program = out, .scratch = scratch };

	memset(out, 0, sizeof(*out));
	*where = 0;
	if (!check_header(bytes, len, why))
		return false;
	out->header = bytes;
	out->base = bytes;
	find_sections(out);
	v.areas = iec_areas_size();
	v.data_size = out->header->data_size;
	*why = DIAG_IMAGE_REFUSED;
	if (v.data_size > LIMIT_DATA || v.data_size < v.areas + 2) {
		*where = offsetof(struct code_header, data_size);
		return false;
	}
	*why = DIAG_NO_MEMORY;
	v.mark = arena_alloc(scratch, v.data_size);
	if (!v.mark)
		return false;
	*why = DIAG_IMAGE_REFUSED;
	if (check_layout(&v) && check_init(&v) && check_bits(&v) &&
	    check_programs(&v) && check_maps(&v)) {
		identify(out);
		return true;
	}
	if (scratch->failed)
		*why = DIAG_NO_MEMORY;
	*where = v.where;
	return false;
}
