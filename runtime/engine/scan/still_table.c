/* SPDX-License-Identifier: MIT
 *
 * still_table - cuts programs into stretches, and finds what each of them touches.
 *
 * A cut lies between two rungs: no jump crosses it, and no temporary is written before it and read
 * behind it. A temporary that is always written before it is read carries nothing from one stretch
 * to another, so it is no place that is touched; otherwise each rung that uses it again would
 * reach all others. Only places without a name can be temporaries.
 *
 * A program that is called is part of the stretches that call it.
 */
#include "engine/scan/interrupt.h"
#include "engine/scan/still.h"

#include <string.h>

#define MOST 256u          /* stretches of all programs, about                 */
#define LARGEST (1u << 20) /* bytes of data memory                             */
#define STEPS 20000000u    /* places looked at: bounds the time of loading     */

enum { NAMED = 1, FLOWS = 2 }; /* of a byte: it has a name; it carries a value */

struct table {
	const struct program *program;
	struct still *still;
	struct arena *keep, *scratch;
	uint8_t *kind;             /* of each byte of memory                   */
	uint32_t *sure, *maybe;    /* 1 + word that wrote a byte last: always, or if control
				    * came there                              */
	uint32_t *reach;           /* of each word: no cut before this word    */
	uint8_t *join;             /* of each word: a jump leads to it         */
	uint64_t *touch;           /* of each block: bytes that count          */
	uint32_t *seen_by;         /* of each block: 1 + the stretch that wrote it last */
	uint32_t begin, end;       /* words of the program that is looked at   */
	uint32_t at;               /* the present word                         */
	uint32_t skipped;          /* a jump may leave out what is before this word */
	uint32_t region;           /* the last word to which a jump leads      */
	bool writing;              /* the writes of an instruction come last   */
	const uint32_t *code;
	uint32_t of;               /* stretch                                  */
	int written;
	bool has_texts;
	uint64_t steps;
	uint32_t least;            /* words of a stretch                       */
};

static uint64_t *new_bits(struct arena *arena, size_t words)
{
	return arena_alloc(arena, words * sizeof(uint64_t));
}

static uint32_t *new_words(struct arena *arena, size_t words)
{
	return arena_alloc(arena, words * sizeof(uint32_t));
}

/* ---- bytes ---- */

struct bytes { uint32_t from, to; };

static bool has_texts(const struct code_run *run)
{
	const struct word_row *row;

	if (run->kind != RUN_INSTANCE)
		return run->type == IEC_STRING;
	row = word_row((enum word)run->word);
	for (int i = 0; i < row->pin_count; i++)
		if (word_pins(row)[i].type == IEC_STRING)
			return true;
	return false;
}

/* Of a STRING only the head is given. A text is as long as its room. */
static void add_text(const struct program *p, struct bytes *bytes)
{
	const struct code_run *run = code_run_at(p, bytes->from);
	uint32_t size, end;

	if (!run || !has_texts(run))
		return;
	size = code_run_size(run);
	end = run->offset + ((bytes->to - 1 - run->offset) / size + 1) * size;
	bytes->from = run->offset + (bytes->from - run->offset) / size * size;
	if (end <= p->header->data_size && end > bytes->to)
		bytes->to = end;
}

static struct bytes bytes_of(const struct table *table, const struct code_access *access)
{
	struct bytes bytes = {
		(uint32_t)(access->bit / 8), (uint32_t)((access->bit + access->bits + 7) / 8),
	};

	if (table->has_texts && bytes.to > bytes.from)
		add_text(table->program, &bytes);
	return bytes;
}

static void name_bytes(struct table *table, uint32_t from, uint32_t size)
{
	memset(table->kind + from, NAMED, size);
}

/* ---- places with a name ---- */

/* Of an array all of it; its elements may be parts of structures, so up to the end of the run. */
static void name_symbol(struct table *table, uint32_t symbol, const char *name)
{
	const uint32_t at = CODE_OFFSET(symbol), type = CODE_TYPE(symbol) & SYMBOL_TYPE;
	const struct code_run *run;

	if (CODE_TYPE(symbol) & SYMBOL_BIT)
		return;
	run = code_run_at(table->program, at);
	if (run && (type == IEC_NONE || type == IEC_STRING || code_bounds(name).count))
		name_bytes(table, run->offset, run->count * code_run_size(run));
	else
		name_bytes(table, at, iec_type_row((enum iec_type)type)->size);
}

static void name_symbols(struct table *table)
{
	const struct program *p = table->program;
	const char *name = p->string;

	for (uint32_t i = 0; i < p->symbol_count; i++, name += strlen(name) + 1)
		if (!(CODE_TYPE(p->symbol[i]) & SYMBOL_HIDDEN))
			name_symbol(table, p->symbol[i], name);
}

/* All that somebody outside of the program can read or write. */
static void name_places(struct table *table)
{
	const struct program *p = table->program;

	name_bytes(table, 0, p->areas.size);
	name_bytes(table, p->header->retain_offset, p->header->retain_size);
	for (uint32_t i = 0; i < p->bits_count; i++)
		name_bytes(table, p->bits[i].slot, p->bits[i].count);
	for (uint32_t i = 0; i < p->run_count; i++) {
		const struct code_run *run = &p->run[i];

		table->has_texts |= has_texts(run);
		if (run->kind == RUN_INSTANCE)
			name_bytes(table, run->offset, run->count * code_run_size(run));
	}
	for (uint32_t i = 0; i < p->task_count; i++)
		if (p->task[i].kind == TASK_EVENT)
			name_bytes(table, CODE_OFFSET(p->task[i].single), 1);
	name_symbols(table);
}

/* ---- what flows ---- */

/* Results that an instruction stores whatever its operands are. A later version of it may have
 * more; one that is missing here is only looked at more often. */
static bool is_sure(const struct table *table, const struct code_access *access)
{
	const uint32_t *code = table->code;
	const uint32_t at = (uint32_t)(access->bit / 8);

	switch (*code & 0xff) {
	case VM_LUT:
	case VM_BITGET:
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
		return true;
	case VM_BLOCK:
		return true;
	case VM_DINT:
	case VM_INT: /* without EN, all but a quotient */
		return (at == code[2] && access->bits == 8) || (*code >> 8 & ~MATH_LOOP) < MATH_DIV ||
		       *code >> 8 & MATH_LEFT;
	case VM_COPY:
		return *code >> 8 && code[1] == CODE_TRUE_AT(&table->program->areas);
	case VM_REAL:
		return (at == code[2] && access->bits == 8) || *code >> 8 & MATH_LEFT;
	case VM_AGET:
		return at == code[2] && access->bits == 8;
	case VM_FN:
		return at == code[3] && access->bits == 8;
	default:
		return false;
	}
}

static void no_cut(struct table *table, uint32_t from, uint32_t to)
{
	if (table->reach[from] < to)
		table->reach[from] = to;
}

/* A value is used that came from outside, or from a word of this program. */
static void use_byte(struct table *table, uint32_t byte)
{
	const uint32_t sure = table->sure[byte], maybe = table->maybe[byte];

	if (maybe > table->begin && maybe > table->region)
		no_cut(table, maybe - 1, table->at + 1);
	else if (sure > table->begin)
		no_cut(table, sure - 1, table->at + 1);
	else
		table->kind[byte] |= FLOWS;
}

static void set_byte(struct table *table, uint32_t byte)
{
	if (table->at < table->skipped)
		table->maybe[byte] = table->at + 1;
	else
		table->sure[byte] = table->at + 1;
}

static void flow(void *context, const struct code_access *access)
{
	struct table *table = context;
	const struct bytes bytes = bytes_of(table, access);
	const bool sets = access->write && is_sure(table, access);

	if (sets != table->writing)
		return;
	table->steps += 1 + (bytes.to - bytes.from);
	for (uint32_t i = bytes.from; i < bytes.to && table->steps < STEPS; i++)
		if (table->kind[i] & NAMED)
			continue;
		else if (sets)
			set_byte(table, i);
		else
			use_byte(table, i);
}

/* Control may leave out what lies between. */
static void jump(struct table *table, uint32_t to)
{
	if (to <= table->at) {
		no_cut(table, to, table->at + 1);
		return;
	}
	no_cut(table, table->at, to);
	if (to > table->skipped)
		table->skipped = to;
}

/* A jump back to EACH costs what was run since the begin of the program. */
static bool is_each(const struct table *table, uint32_t to)
{
	return (table->program->text[to] & 0xff) == VM_EACH;
}

static void flow_jumps(struct table *table)
{
	const uint32_t *code = table->code, op = *code & 0xff;
	const uint32_t next = table->at + code_words(code);
	uint32_t count;
	const uint32_t *to = code_targets(code, &count);

	if (op == VM_END && next < table->end)
		jump(table, table->end);
	for (uint32_t i = 0; i < count; i++) {
		jump(table, to[i]);
		if (is_each(table, to[i]) && to[i] <= table->at)
			no_cut(table, table->begin, table->at + 1);
	}
}

static void flow_part(struct table *table, const uint32_t *code)
{
	table->code = code;
	table->writing = false;
	code_access(code, flow, table);
	table->writing = true;
	code_access(code, flow, table);
}

/* Each part of a LUT is an instruction of its own. */
static void each_part(struct table *table, const uint32_t *code,
		      void (*take)(struct table *table, const uint32_t *code))
{
	const uint32_t at = table->at, n = *code >> 8;
	uint32_t one[5] = { VM_LUT | 1u << 8, 0, 0, 0, 0 };

	if ((*code & 0xff) != VM_LUT) {
		take(table, code);
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		memcpy(one + 1, code + 1 + 4 * i, 4 * sizeof(*one));
		table->at = i ? at + 1 + 4 * i : at;
		take(table, one);
	}
	table->at = at;
	table->code = code;
}

static void begin_program(struct table *table, uint32_t entry)
{
	const struct code_program *e = &table->program->entry[entry];

	table->begin = e->text;
	table->end = e->text + e->text_words;
	table->skipped = table->region = 0;
}

static void mark_joins(struct table *table)
{
	const uint32_t *text = table->program->text;

	for (uint32_t at = table->begin; at < table->end; at += code_words(text + at)) {
		uint32_t count;
		const uint32_t *to = code_targets(text + at, &count);

		for (uint32_t i = 0; i < count; i++)
			table->join[to[i]] = 1;
	}
}

static void flow_program(struct table *table, uint32_t entry)
{
	const uint32_t *text = table->program->text;

	begin_program(table, entry);
	mark_joins(table);
	for (table->at = table->begin; table->at < table->end;
	     table->at += code_words(text + table->at)) {
		if (table->join[table->at])
			table->region = table->at;
		each_part(table, text + table->at, flow_part);
		table->code = text + table->at;
		flow_jumps(table);
	}
}

/* ---- cuts ---- */

static struct stretch *new_stretch(struct table *table, uint32_t begin)
{
	struct still *still = table->still;
	struct stretch *stretch;
	int count = (int)still->count;

	stretch = arena_push(table->keep, &still->stretch, &count, sizeof(*stretch));
	if (!stretch)
		return NULL;
	still->count = (uint32_t)count;
	stretch->begin = stretch->from = begin;
	return stretch;
}

/* Ends the last stretch, and begins the next one, at part @part of the LUT at @lut. */
static bool cut(struct table *table, uint32_t lut, uint32_t part)
{
	struct stretch *last = &table->still->stretch[table->still->count - 1], *next;
	const uint32_t n = table->program->text[lut] >> 8, at = part ? lut + 1 + 4 * part : lut;

	last->end = at;
	/* It may have begun in the same LUT. */
	if (last->head_parts && last->from > lut) {
		last->head_parts = (at - last->head) / 4;
		last->from = STILL_NONE;
	} else {
		last->stop = lut;
		last->tail_parts = part;
		if (last->from == lut)
			last->from = STILL_NONE;
	}
	next = new_stretch(table, at);
	if (next && part) {
		next->head = at;
		next->head_parts = n - part;
		next->from = lut + 1 + 4 * n;
	}
	return next;
}

/* Cuts where a stretch is long enough and nothing crosses. */
static bool cut_lut(struct table *table, uint32_t lut, uint32_t least, uint32_t *open)
{
	const uint32_t n = table->program->text[lut] >> 8;

	for (uint32_t i = 0; i < n; i++) {
		const uint32_t at = i ? lut + 1 + 4 * i : lut;
		const uint32_t begin = table->still->stretch[table->still->count - 1].begin;

		if (*open <= at && at - begin >= least && !cut(table, lut, i))
			return false;
		if (table->reach[at] > *open)
			*open = table->reach[at];
	}
	return true;
}

static bool cut_program(struct table *table, uint32_t entry, uint32_t least)
{
	struct still_program *part = &table->still->part[entry];
	const uint32_t *text = table->program->text;
	uint32_t open = 0;

	if (part->count)
		return true;
	begin_program(table, entry);
	part->first = table->still->count;
	if (!new_stretch(table, table->begin))
		return false;
	for (uint32_t at = table->begin; at < table->end; at += code_words(text + at)) {
		if ((text[at] & 0xff) == VM_LUT && !cut_lut(table, at, least, &open))
			return false;
		if (table->reach[at] > open)
			open = table->reach[at];
	}
	table->still->stretch[table->still->count - 1].end = table->end;
	part->count = table->still->count - part->first;
	return true;
}

/* ---- what a stretch touches ---- */

struct walk {
	const struct program *program;
	void (*take)(void *context, const struct code_access *access);
	void *context;
	void (*note)(void *context, const uint32_t *code);
	uint8_t *called;           /* programs that were walked already       */
};

static void walk_words(const struct walk *walk, uint32_t at, uint32_t end)
{
	const uint32_t *text = walk->program->text;

	for (; at < end; at += code_words(text + at)) {
		code_access(text + at, walk->take, walk->context);
		if (walk->note)
			walk->note(walk->context, text + at);
		if ((text[at] & 0xff) == VM_CALL && !walk->called[text[at + 1]]) {
			const struct code_program *e = &walk->program->entry[text[at + 1]];

			walk->called[text[at + 1]] = 1;
			walk_words(walk, e->text, e->text + e->text_words);
		}
	}
}

static void walk_parts(const struct walk *walk, uint32_t from, uint32_t parts)
{
	uint32_t one[5] = { VM_LUT | 1u << 8, 0, 0, 0, 0 };

	for (; parts; parts--, from += 4) {
		memcpy(one + 1, walk->program->text + from, 4 * sizeof(*one));
		code_access(one, walk->take, walk->context);
	}
}

static void walk_stretch(const struct walk *walk, const struct stretch *stretch)
{
	memset(walk->called, 0, walk->program->entry_count);
	walk_parts(walk, stretch->head, stretch->head_parts);
	if (stretch->from != STILL_NONE)
		walk_words(walk, stretch->from, stretch->stop ? stretch->stop : stretch->end);
	walk_parts(walk, stretch->stop + 1, stretch->tail_parts);
}

void still_each(const struct still *still, uint32_t stretch,
		void (*take)(void *context, const struct code_access *access), void *context)
{
	const struct walk walk = { still->program, take, context, NULL, still->walked };

	walk_stretch(&walk, &still->stretch[stretch]);
}

/* The bytes of a block from @from up to @to, which count from its begin. */
static uint64_t bits_between(uint32_t from, uint32_t to)
{
	const uint64_t upto = to >= 64 ? UINT64_MAX : (UINT64_C(1) << to) - 1;

	return upto & ~((UINT64_C(1) << from) - 1);
}

static void touch_block(struct table *table, uint32_t block, uint64_t bytes, bool write)
{
	struct still *still = table->still;
	struct stretch *stretch = &still->stretch[table->of];
	uint32_t *at;

	still->mask[block] |= bytes;
	still->touched_by[(size_t)block * still->words + table->of / 64] |=
		UINT64_C(1) << table->of % 64;
	if (!write || table->seen_by[block] == table->of + 1)
		return;
	table->seen_by[block] = table->of + 1;
	at = arena_push(table->keep, &still->written, &table->written, sizeof(*at));
	if (!at)
		return;
	*at = block;
	stretch->written_count++;
}

static void touch(void *context, const struct code_access *access)
{
	struct table *table = context;
	const struct bytes bytes = bytes_of(table, access);

	table->steps++;
	for (uint32_t i = bytes.from / STILL_BLOCK; i < table->still->blocks &&
	     i * STILL_BLOCK < bytes.to && table->steps < STEPS; i++, table->steps++) {
		const uint32_t at = i * STILL_BLOCK;
		const uint64_t some = table->touch[i] &
			bits_between(bytes.from > at ? bytes.from - at : 0, bytes.to - at);

		if (some)
			touch_block(table, i, some, access->write);
	}
}

/* A block that has changed nothing at one time changes nothing later, if its inputs stay. */
static bool rests(uint32_t word)
{
	static const uint8_t rests[WORD_KNOWN] = {
#define STILL(id) [FB_##id] = 1,
#include "engine/catalog.def"
	};

	return rests[word];
}

/* Instructions that take from the budget, or may do so in a later version. */
static bool is_free(uint32_t op)
{
	switch (op) {
	case VM_END:
	case VM_LUT:
	case VM_BITGET:
	case VM_BITPUT:
	case VM_COPY:
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
	case VM_FN:
	case VM_FB:
	case VM_STOP:
	case VM_AGET:
	case VM_APUT:
	case VM_POINT:
		return true;
	default:
		return false;
	}
}

static void note(void *context, const uint32_t *code)
{
	struct table *table = context;
	struct stretch *stretch = &table->still->stretch[table->of];
	const uint32_t op = *code & 0xff;

	stretch->always |= op == VM_TICK || (op == VM_FB && !rests(*code >> 8));
	stretch->pays |= !is_free(op);
}

static void touch_all(struct table *table)
{
	struct still *still = table->still;
	const struct walk walk = { table->program, touch, table, note, still->walked };

	for (uint32_t i = 0; i < still->blocks; i++)
		for (uint32_t k = 0; k < STILL_BLOCK; k++)
			if (i * STILL_BLOCK + k < table->program->header->data_size &&
			    table->kind[i * STILL_BLOCK + k])
				table->touch[i] |= UINT64_C(1) << k;
	for (table->of = 0; table->of < still->count; table->of++) {
		struct stretch *stretch = &still->stretch[table->of];

		if (table->of)
			stretch->written = stretch[-1].written + stretch[-1].written_count;
		walk_stretch(&walk, stretch);
		if (stretch->always)
			still->always[table->of / 64] |= UINT64_C(1) << table->of % 64;
	}
}

/* ---- inputs ---- */

static void add_outside(struct table *table, uint32_t block)
{
	struct still *still = table->still;
	const struct program *p = table->program;
	uint64_t bits = 0;

	for (uint32_t i = 0; i < p->bits_count; i++) {
		const struct code_bits *b = &p->bits[i];
		const uint64_t first = p->areas.at[b->area] + b->first / 8;
		const uint64_t last = p->areas.at[b->area] + (b->first + b->count + 7) / 8;
		const uint64_t at = (uint64_t)block * STILL_BLOCK;

		if (image_reads(b) && b->count && first < at + STILL_BLOCK && last > at)
			bits |= bits_between((uint32_t)(first > at ? first - at : 0),
					     (uint32_t)(last - at));
	}
	if (!bits && !still->mask[block])
		return;
	still->outside[still->outside_count] = block;
	still->unpacked[still->outside_count++] = bits;
}

static bool is_in_row(const struct still *still, uint32_t i)
{
	return i + 1 < still->outside_count && still->outside[i + 1] == still->outside[i] + 1;
}

static void find_outside(struct table *table)
{
	const struct program *p = table->program;
	uint32_t next = 0;

	for (int area = 1; area < AREA_COUNT; area++) {
		const uint32_t at = p->areas.at[area], end = at + p->areas.bytes[area];

		if (iec_area_row((enum iec_area)area)->access != ACCESS_READ || end == at)
			continue;
		for (uint32_t i = at / STILL_BLOCK; i * STILL_BLOCK < end; i++)
			if (i >= next) {
				add_outside(table, i);
				next = i + 1;
			}
	}
	for (uint32_t i = table->still->outside_count; i-- > 0;)
		table->still->row_end[i] = is_in_row(table->still, i) ?
					   table->still->row_end[i + 1] : i + 1;
	table->still->in_order = true;
	for (uint32_t i = 1; i < p->bits_count; i++)
		if (p->bits[i].slot < p->bits[i - 1].slot + p->bits[i - 1].count)
			table->still->in_order = false;
}

/* ---- all of it ---- */

static bool take_scratch(struct table *table, uint32_t blocks)
{
	const struct program *p = table->program;
	const size_t bytes = p->header->data_size, words = (size_t)p->text_words + 1;

	table->kind = arena_alloc(table->scratch, bytes);
	table->sure = new_words(table->scratch, bytes);
	table->maybe = new_words(table->scratch, bytes);
	table->reach = new_words(table->scratch, words);
	table->join = arena_alloc(table->scratch, words);
	table->touch = new_bits(table->scratch, blocks);
	table->seen_by = new_words(table->scratch, blocks);
	return !table->scratch->failed;
}

static bool take_tables(struct table *table)
{
	struct still *still = table->still;
	const size_t outside = table->program->areas.size / STILL_BLOCK + 2;

	still->words = (still->count + 63) / 64;
	still->mask = new_bits(table->keep, still->blocks);
	still->touched_by = new_bits(table->keep, (size_t)still->blocks * still->words);
	still->always = new_bits(table->keep, still->words);
	still->pending = new_bits(table->keep, still->words);
	still->changed = new_bits(table->keep, still->blocks / 64 + 1);
	still->outside = new_words(table->keep, outside);
	still->row_end = new_words(table->keep, outside);
	still->unpacked = new_bits(table->keep, outside);
	still->spent = new_words(table->keep, still->count);
	still->called = new_words(table->keep, still->count);
	still->seen = arena_alloc(table->keep, (size_t)still->blocks * STILL_BLOCK);
	return !table->keep->failed;
}

static bool cut_all(struct table *table)
{
	const struct program *p = table->program;
	uint32_t words = 0, least = table->least;

	for (uint32_t i = 0; i < p->call_count; i++)
		words += p->entry[p->call[i]].text_words;
	if (words / MOST > least)
		least = words / MOST;
	for (uint32_t i = 0; i < p->call_count; i++)
		if (!cut_program(table, p->call[i], least))
			return false;
	return true;
}

static bool is_timed(const struct still *still)
{
	uint32_t always = 0;

	for (uint32_t i = 0; i < still->count; i++)
		always += still->stretch[i].always;
	return always > still->count / 2;
}

static void find_flows(struct table *table)
{
	name_places(table);
	for (uint32_t i = 0; i < table->program->entry_count; i++)
		flow_program(table, i);
}

uint8_t *still_carries(const struct program *program, struct arena *arena)
{
	struct table table = { .program = program, .scratch = arena };

	if (program->header->data_size > LARGEST || !take_scratch(&table, 0))
		return NULL;
	find_flows(&table);
	if (table.steps >= STEPS || code_has_pointers(program))
		memset(table.kind, NAMED, program->header->data_size);
	return table.kind;
}

static enum still_why fill(struct table *table)
{
	const struct program *p = table->program;
	struct still *still = table->still;

	still->blocks = (p->header->data_size + STILL_BLOCK - 1) / STILL_BLOCK;
	still->rest = p->header->data_size % STILL_BLOCK;
	still->part = arena_alloc(table->keep, p->entry_count * sizeof(*still->part));
	still->walked = arena_alloc(table->keep, p->entry_count);
	if (!still->part || !still->walked || !take_scratch(table, still->blocks))
		return STILL_NO_MEMORY;
	find_flows(table);
	if (!cut_all(table) || !take_tables(table))
		return STILL_NO_MEMORY;
	touch_all(table);
	find_outside(table);
	if (table->keep->failed)
		return STILL_NO_MEMORY;
	return table->steps >= STEPS ? STILL_LARGE : is_timed(still) ? STILL_TIMED : STILL_GOOD;
}

static enum still_why make(struct table *table)
{
	if (interrupt_levels(table->program))
		return STILL_INTERRUPTED;
	if (table->program->header->data_size > LARGEST)
		return STILL_LARGE;
	if (code_has_pointers(table->program))
		return STILL_POINTERS;
	table->still = arena_alloc(table->keep, sizeof(*table->still));
	if (!table->still)
		return STILL_NO_MEMORY;
	table->still->program = table->program;
	table->still->stale = true;
	return fill(table);
}

struct still *still_new(const struct program *program, uint32_t least, struct arena *keep,
			enum still_why *why)
{
	struct arena scratch;
	struct table table = {
		.program = program, .least = least, .keep = keep, .scratch = &scratch,
	};
	enum still_why found;

	arena_init(&scratch);
	found = make(&table);
	arena_free(&scratch);
	if (why)
		*why = found;
	return found == STILL_GOOD ? table.still : NULL;
}

const char *still_why_text(enum still_why why)
{
	static const char *const text[] = {
		[STILL_GOOD] = "",
		[STILL_INTERRUPTED] = "a task may interrupt another",
		[STILL_LARGE] = "the program is too large",
		[STILL_TIMED] = "most of it depends on the time",
		[STILL_POINTERS] = "it uses pointers",
		[STILL_NO_MEMORY] = "no memory",
	};

	return text[why];
}
