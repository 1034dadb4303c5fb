/* SPDX-License-Identifier: MIT
 *
 * code - the verifier: nothing else turns bytes into a program that may run.
 *
 * Every byte of data memory gets a mark: the type that may be read or written there.
 * Then each instruction is checked against the marks. It repairs nothing.
 */
#include "engine/scan/verify.h"

#include "engine/base/digest.h"

#include <string.h>

static uint32_t type_size(uint32_t type)
{
	return iec_type_row((enum iec_type)type)->size;
}

/* An area operand may lie at any byte, but not leave its area. */
static bool in_area(const struct verifier *v, uint32_t offset, uint32_t size,
		    bool write)
{
	const struct areas *areas = &v->program->areas;
	enum iec_area area = areas_find(areas, offset);

	return area != AREA_NONE &&
	       size <= areas->at[area] + areas->bytes[area] - offset &&
	       (!write || iec_area_row(area)->access == ACCESS_WRITE);
}

bool verify_use(const struct verifier *v, uint32_t offset, uint32_t type,
		    bool write)
{
	if (!verify_is_type(type) || offset >= v->data_size ||
	    v->data_size - offset < type_size(type))
		return false;
	if (v->mark[offset] == MARK_VALUE + type)
		return true;
	if (v->mark[offset] == MARK_FIXED + type)
		return !write;
	return offset < v->areas && type != IEC_BOOL && type != IEC_STRING &&
	       in_area(v, offset, type_size(type), write);
}

bool verify_refuse(struct verifier *v, const void *at)
{
	v->where = (size_t)((const uint8_t *)at - v->program->base);
	return false;
}

enum word code_instance(const struct program *p, uint32_t offset)
{
	const struct code_run *run = code_run_at(p, offset);

	if (!run || run->kind != RUN_INSTANCE ||
	    (offset - run->offset) % code_run_size(run) != 0)
		return WORD_COUNT;
	return (enum word)run->word;
}

/* ---- header and sections ---- */

static const uint32_t section_unit[CODE_SECTION_COUNT] = {
	[0] = 1,
	[CODE_PROGRAMS] = sizeof(struct code_program),
	[CODE_TASKS] = sizeof(struct code_task),
	[CODE_CALLS] = 4,
	[CODE_LAYOUT] = sizeof(struct code_run),
	[CODE_INIT] = 4,
	[CODE_BITS] = sizeof(struct code_bits),
	[CODE_TEXT] = 4,
	[CODE_WATCH] = 4,
	[CODE_SYMBOLS] = 4,
	[CODE_GROUPS] = sizeof(struct code_group),
	[CODE_POWER] = sizeof(struct code_power),
	[CODE_PLACES] = sizeof(struct code_place),
	[CODE_STRINGS] = 1,
	[CODE_WATCHED] = sizeof(struct code_watched),
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
	*why = DIAG_IMAGE_VERSION;
	if (header->words != WORD_COUNT)
		return false;
	*why = DIAG_IMAGE_DAMAGED;
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
	p->task_count = section(p, CODE_TASKS, &at), p->task = at;
	p->call_count = section(p, CODE_CALLS, &at), p->call = at;
	p->run_count = section(p, CODE_LAYOUT, &at), p->run = at;
	p->bits_count = section(p, CODE_BITS, &at), p->bits = at;
	p->text_words = section(p, CODE_TEXT, &at), p->text = at;
	p->watch_words = section(p, CODE_WATCH, &at), p->watch = at;
	p->symbol_count = section(p, CODE_SYMBOLS, &at), p->symbol = at;
	p->group_count = section(p, CODE_GROUPS, &at), p->group = at;
	p->power_count = section(p, CODE_POWER, &at), p->power = at;
	p->place_count = section(p, CODE_PLACES, &at), p->place = at;
	p->string_bytes = section(p, CODE_STRINGS, &at), p->string = at;
	p->watched_count = section(p, CODE_WATCHED, &at), p->watched = at;
}

/* ---- data layout ---- */

static void mark_instance(struct verifier *v, uint32_t offset,
			  const struct word_row *row)
{
	memset(v->mark + offset, MARK_INSIDE, row->size);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &word_pins(row)[i];

		if (pin->type == IEC_STRING)
			memset(v->mark + offset + pin->offset, MARK_TEXT,
			       sizeof(struct word_text));
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

	memset(v->mark + offset, run->type == IEC_STRING ? MARK_TEXT : MARK_INSIDE,
	       code_run_size(run));
	v->mark[offset] = (uint8_t)(base + run->type);
}

static bool mark_run(struct verifier *v, const struct code_run *run,
		     uint32_t *end)
{
	bool instance = run->kind == RUN_INSTANCE;
	uint32_t size, align;

	if (run->kind > RUN_INSTANCE || run->offset < *end)
		return verify_refuse(v, run);
	if (instance ? run->word >= WORD_KNOWN ||
		       word_row((enum word)run->word)->kind != WORD_FB
		     : !verify_is_type(run->type))
		return verify_refuse(v, run);
	if (!instance && (run->type == IEC_STRING) != (run->word != 0) &&
	    !(run->type == IEC_LWORD && run->word == RUN_POINTERS))
		return verify_refuse(v, run);
	size = code_run_size(run);
	align = instance ? 8 : type_size(run->type);
	if (run->word > IEC_STRING_MOST && !instance)
		return verify_refuse(v, run);
	if (run->offset % align || run->offset > v->data_size ||
	    run->count > (v->data_size - run->offset) / size)
		return verify_refuse(v, run);
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

	for (int area = 1; area < AREA_COUNT; area++)
		memset(v->mark + p->areas.at[area], MARK_AREA,
		       p->areas.bytes[area]);
	for (uint32_t i = 0; i < p->run_count; i++)
		if (!mark_run(v, &p->run[i], &end))
			return false;
	if (v->mark[CODE_FALSE_AT(&p->areas)] != MARK_FIXED + IEC_BOOL ||
	    v->mark[CODE_TRUE_AT(&p->areas)] != MARK_FIXED + IEC_BOOL ||
	    p->header->retain_offset > v->data_size ||
	    p->header->retain_size > v->data_size - p->header->retain_offset ||
	    p->header->budget > LIMIT_BUDGET ||
	    p->header->core_runs > p->run_count)
		return verify_refuse(v, p->header);
	return true;
}

/* Bytes of the value that begins at @offset; a text up to its end. */
static uint32_t value_bytes(const struct verifier *v, uint32_t offset)
{
	uint32_t size = type_size(v->mark[offset] % MARK_VALUE);

	if (v->mark[offset] % MARK_VALUE == IEC_STRING)
		for (size = 1; offset + size < v->data_size &&
			       v->mark[offset + size] == MARK_TEXT;)
			size++;
	return size;
}

/* A BOOL is 0 or 1; a text is no longer than its room. The run sets the bound of a
 * text. */
static bool is_initial(uint8_t type, const uint8_t *bytes, uint32_t size)
{
	uint16_t length;

	if (type == IEC_BOOL)
		return bytes[0] <= 1;
	if (type != IEC_STRING)
		return true;
	memcpy(&length, bytes + offsetof(struct iec_string, length), 2);
	return length <= size - sizeof(struct iec_string);
}

/* Initial bytes must be whole values. */
#ifdef RUNGBOARD_SMALL
#define is_raw(...) false /* no unions: their members are behind pointers */
#else
/* Members of a union lie in LWORDs, whatever their types are. */
static bool is_raw(const struct verifier *v, uint32_t at, uint64_t bytes)
{
	const struct code_run *run = code_run_at(v->program, at);

	return run && run->kind == RUN_VALUES && run->type == IEC_LWORD &&
	       at + bytes <= run->offset + (uint64_t)run->count * code_run_size(run);
}
#endif

static bool check_init_bytes(struct verifier *v, uint32_t offset,
			     const uint8_t *bytes, uint32_t len)
{
	while (len > 0) {
		uint8_t mark = v->mark[offset];
		uint32_t size = 1;

		if ((mark == MARK_VALUE + IEC_LWORD || (mark < MARK_VALUE && mark != MARK_AREA)) &&
		    is_raw(v, offset, 1)) {
			; /* byte by byte */
		} else if (mark >= MARK_VALUE) {
			size = value_bytes(v, offset);
			if (size > len ||
			    !is_initial(mark % MARK_VALUE, bytes, size))
				return verify_refuse(v, bytes);
		} else if (mark != MARK_AREA) {
			return verify_refuse(v, bytes);
		}
		if (size > len)
			return verify_refuse(v, bytes);
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
			return verify_refuse(v, at);
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
			return verify_refuse(v, bits);
		most = p->areas.bytes[bits->area] * 8;
		if (bits->area < area || (bits->area == area && bits->first < end) ||
		    bits->first > most || bits->count > most - bits->first ||
		    bits->slot >= v->data_size ||
		    bits->count > v->data_size - bits->slot)
			return verify_refuse(v, bits);
		for (uint32_t k = 0; k < bits->count; k++)
			if (v->mark[bits->slot + k] != MARK_VALUE + IEC_BOOL)
				return verify_refuse(v, bits);
		area = bits->area;
		end = bits->first + bits->count;
	}
	return true;
}

/* ---- maps ---- */

/* A bit of any area, counted from the start of the first area. */
static bool is_area_bit(const struct verifier *v, uint32_t bit)
{
	return areas_find(&v->program->areas, bit / 8) != AREA_NONE;
}

static bool check_symbol(struct verifier *v, uint32_t symbol, const char *name)
{
	uint32_t type = CODE_TYPE(symbol) & SYMBOL_TYPE;
	uint32_t at = CODE_OFFSET(symbol), count = code_bounds(name).count;
	const struct code_run *run = code_run_at(v->program, at);

	if (!(CODE_TYPE(symbol) & SYMBOL_BIT) && verify_is_type(type) && type != IEC_STRING &&
	    is_raw(v, at, (uint64_t)type_size(type) * (count ? count : 1)))
		return true;
	if (count && CODE_TYPE(symbol) & SYMBOL_BIT)
		return type == IEC_BOOL && verify_bits(v, at, count, false);
	if (count)
		return verify_is_type(type) &&
		       verify_elements(v, CODE_OPERAND(type, at), count,
				       type == IEC_STRING && run ?
				       code_run_size(run) : type_size(type),
				       false);
	if (CODE_TYPE(symbol) & SYMBOL_BIT)
		return type == IEC_BOOL && is_area_bit(v, at);
	if (type == IEC_NONE)
		return code_instance(v->program, at) != WORD_COUNT;
	return verify_use(v, at, type, false);
}

static bool check_groups(struct verifier *v)
{
	const struct program *p = v->program;

	for (uint32_t i = 0; i < p->group_count; i++) {
		const struct code_group *group = &p->group[i];

		if (group->first >= p->symbol_count ||
		    group->pou > p->entry_count ||
		    group->flags & ~(uint32_t)(SYMBOL_CONSTANT | SYMBOL_RETAIN) ||
		    (i ? group->first <= group[-1].first : group->first))
			return verify_refuse(v, group);
	}
	return p->group_count || !p->symbol_count || verify_refuse(v, p->symbol);
}

/* At least one string for each symbol; the last string is terminated. */
static bool check_strings(struct verifier *v)
{
	const struct program *p = v->program;
	uint32_t ends = 0;

	for (uint32_t i = 0; i < p->string_bytes; i++)
		ends += p->string[i] == '\0';
	return (ends >= p->symbol_count &&
		(!p->string_bytes || p->string[p->string_bytes - 1] == '\0')) ||
	       verify_refuse(v, p->string);
}

static bool check_watched(struct verifier *v)
{
	const struct program *p = v->program;

	for (uint32_t i = 0; i < p->watched_count; i++) {
		const struct code_watched *w = &p->watched[i];

		if (w->pou >= p->entry_count || w->name >= p->string_bytes ||
		    w->to > v->data_size || w->size > v->data_size - w->to)
			return verify_refuse(v, w);
	}
	return true;
}

static bool check_power(const struct verifier *v, const struct code_power *power)
{
	const uint32_t type = power->type ? power->type : IEC_BOOL;

	return verify_use(v, power->in, IEC_BOOL, false) &&
	       verify_use(v, power->out, type, false);
}

static bool check_maps(struct verifier *v)
{
	const struct program *p = v->program;
	const char *name = p->string;

	if (!check_strings(v) || !check_groups(v) || !check_watched(v))
		return false;
	for (uint32_t i = 0; i < p->symbol_count; i++) {
		if (!check_symbol(v, p->symbol[i], name))
			return verify_refuse(v, &p->symbol[i]);
		name += strlen(name) + 1;
	}
	for (uint32_t i = 0; i < p->power_count; i++)
		if (!check_power(v, &p->power[i]))
			return verify_refuse(v, &p->power[i]);
	for (uint32_t i = 0; i < p->place_count; i++)
		if (p->place[i].text >= p->text_words + p->watch_words ||
		    p->place[i].pou >= p->entry_count)
			return verify_refuse(v, &p->place[i]);
	return true;
}

/* Of row 0; its column is the last key. */
static const struct code_power *find_result(const struct program *program, uint32_t pou,
					    uint32_t line, uint16_t col)
{
	uint32_t low = 0, high = program->power_count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;
		const struct code_power *at = &program->power[middle];

		/* Cells of a chart's rungs lie between the lines of its lists. */
		if (at->pou == pou && at->rung == line && at->row == 0 && at->col == col)
			return at;
		if (at->pou > pou || (at->pou == pou && at->rung > line) ||
		    (at->pou == pou && at->rung == line && (at->row || at->col > col)))
			high = middle;
		else
			low = middle + 1;
	}
	return NULL;
}

const struct code_power *code_result(const struct program *program, uint32_t pou,
				     uint32_t line)
{
	return find_result(program, pou, line, CODE_LINE);
}

const struct code_power *code_listed(const struct program *program, uint32_t pou,
				     uint32_t number)
{
	return find_result(program, pou, number, CODE_LISTED);
}

void code_identity(const struct program *p, uint8_t out[32])
{
	struct digest_sha256 sha;
	const struct code_header *h = p->header;
	uint32_t head[3] = { h->retain_offset, h->retain_size, h->budget };
	size_t runs = h->core_runs * sizeof(struct code_run);

	digest_sha256_init(&sha);
	digest_sha256_add(&sha, head, sizeof(head));
	digest_sha256_add(&sha, h->area_bytes, sizeof(h->area_bytes));
	for (uint32_t i = 0; i < p->entry_count; i++)
		digest_sha256_add(&sha, &p->entry[i], 2 * sizeof(uint32_t));
	for (uint32_t i = 0; i < p->task_count; i++)
		digest_sha256_add(&sha, &p->task[i],
				  offsetof(struct code_task, name));
	digest_sha256_add(&sha, p->run, runs);
	for (int kind = CODE_INIT; kind <= CODE_TEXT; kind++)
		digest_sha256_add(&sha, p->base + h->section[kind].offset,
				  h->section[kind].size);
	digest_sha256_end(&sha, out);
}

bool code_is_same(const struct program *a, const struct program *b)
{
	const struct code_header *x = a->header, *y = b->header;
	const size_t from = offsetof(struct code_header, retain_offset), end = offsetof(struct code_header, words);
	bool same = memcmp((const char *)x + from, (const char *)y + from, end - from) == 0 &&
		memcmp(x->area_bytes, y->area_bytes, sizeof(x->area_bytes)) == 0 &&
		a->entry_count == b->entry_count && a->task_count == b->task_count &&
		memcmp(a->run, b->run, x->core_runs * sizeof(struct code_run)) == 0;

	for (uint32_t i = 0; same && i < a->entry_count; i++)
		same = memcmp(&a->entry[i], &b->entry[i], 2 * sizeof(uint32_t)) == 0;
	for (uint32_t i = 0; same && i < a->task_count; i++)
		same = memcmp(&a->task[i], &b->task[i], offsetof(struct code_task, name)) == 0;
	for (int kind = CODE_INIT; same && kind <= CODE_TEXT; kind++)
		same = x->section[kind].size == y->section[kind].size &&
			memcmp(a->base + x->section[kind].offset, b->base + y->section[kind].offset,
			       x->section[kind].size) == 0;
	return same;
}

_Static_assert(AREA_COUNT <= CODE_AREAS, "no room for the sizes of all areas");

/* The size of each area and of all together is within its bounds. */
static bool check_areas(struct verifier *v)
{
	struct program *p = v->program;

	for (int area = 0; area < CODE_AREAS; area++)
		if (area < AREA_COUNT)
			p->areas.bytes[area] = p->header->area_bytes[area];
		else if (p->header->area_bytes[area])
			return verify_refuse(v, &p->header->area_bytes[area]);
	if (!areas_place(&p->areas))
		return verify_refuse(v, p->header->area_bytes);
	v->areas = p->areas.size;
	return true;
}

/* Reads the header behind the checksum. Not inline it would take more room on a small board. */
static inline __attribute__((always_inline)) bool open_header(const void *bytes, struct arena *scratch,
							      struct program *out, enum diag_id *why, size_t *where)
{
	struct verifier v = { .program = out, .scratch = scratch };

	out->header = bytes;
	out->base = bytes;
	find_sections(out);
	v.data_size = out->header->data_size;
	v.blocks_left = LIMIT_BLOCKS;
	*why = DIAG_IMAGE_REFUSED;
	if (!check_areas(&v)) {
		*where = v.where;
		return false;
	}
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
	    verify_programs(&v) && verify_tasks(&v) && check_maps(&v))
		return true;
	if (scratch->failed)
		*why = DIAG_NO_MEMORY;
	*where = v.where;
	return false;
}

bool code_open(const void *bytes, size_t len, struct arena *scratch,
	       struct program *out, enum diag_id *why, size_t *where)
{
	memset(out, 0, sizeof(*out));
	*where = 0;
	return check_header(bytes, len, why) && open_header(bytes, scratch, out, why, where);
}

#ifndef RUNGBOARD_SMALL
bool code_open_made(const void *bytes, struct arena *scratch, struct program *out, enum diag_id *why,
		    size_t *where)
{
	memset(out, 0, sizeof(*out));
	*where = 0;
	return open_header(bytes, scratch, out, why, where);
}
#endif
