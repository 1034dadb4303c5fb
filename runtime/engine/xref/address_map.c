/* SPDX-License-Identifier: MIT
 *
 * address_map - a bit map of the process image, filled from the cross reference.
 */
#include "engine/xref/address_map.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/st.h"
#include "engine/model/args.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

static uint32_t first_bit(const struct areas *areas, struct iec_addr addr)
{
	return areas_byte(areas, addr) * 8 + addr.bit;
}

/* Behind the last bit of its area. */
static uint32_t area_end(const struct areas *areas, enum iec_area area)
{
	return (areas->at[area] + areas->bytes[area]) * 8;
}

static void mark(uint8_t *map, uint32_t at, uint32_t end)
{
	for (; at < end; at++)
		map[at / 8] |= (uint8_t)(1u << at % 8);
}

static bool is_marked(const uint8_t *map, uint32_t at, uint32_t end)
{
	for (; at < end; at++)
		if (map[at / 8] & 1u << at % 8)
			return true;
	return false;
}

/* Bits of a variable at an address, all its elements. */
static uint32_t bits_of(struct project *project, const struct xref_target *target)
{
	const struct var *var = xref_var(project, target);

	return target->addr.bits * (var && var->array.count ? var->array.count : 1);
}

bool address_map_make(struct address_map *out, const struct xref *xref,
		      struct arena *arena)
{
	const struct areas *areas = &out->areas;
	size_t bytes;

	project_areas(xref->project, &out->areas);
	bytes = (size_t)areas->size + 1;
	out->used = arena_alloc(arena, bytes);
	out->reached = arena_alloc(arena, bytes);
	if (!out->used || !out->reached)
		return false;
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];
		const enum iec_area area = use->target.addr.area;
		uint32_t at, end;

		if (area == AREA_NONE)
			continue;
		at = first_bit(areas, use->target.addr);
		end = at + bits_of(xref->project, &use->target);
		end = end < area_end(areas, area) ? end : area_end(areas, area);
		mark(out->used, at, end);
		if (use->target.what == XREF_ADDRESS && use->open)
			end = area_end(areas, area);
		mark(out->reached, at, end);
	}
	return true;
}

static bool search(const struct address_map *map, const uint8_t *marks,
		   enum iec_area area, uint32_t bits, uint32_t count, uint32_t from,
		   struct iec_addr *out)
{
	const uint32_t base = map->areas.at[area] * 8;
	const uint64_t size = (uint64_t)map->areas.bytes[area] * 8;
	uint32_t at = (from + bits - 1) / bits * bits;

	for (; (uint64_t)at + (uint64_t)bits * count <= size; at += bits) {
		if (is_marked(marks, base + at, base + at + bits * count))
			continue;
		*out = (struct iec_addr){ area, (uint8_t)bits, (uint8_t)(at % 8), at / 8 };
		return true;
	}
	return false;
}

bool address_map_next(const struct address_map *map, enum iec_area area, int bits,
		      uint32_t count, const struct iec_addr *after, struct iec_addr *out)
{
	uint32_t from = 0;

	if (area <= AREA_NONE || area >= AREA_COUNT || count < 1 ||
	    count > LIMIT_ELEMENTS ||
	    (bits != 1 && bits != 8 && bits != 16 && bits != 32 && bits != 64))
		return false;
	if (after && after->area == area)
		from = after->byte * 8 + after->bit + after->bits;
	return search(map, map->reached, area, (uint32_t)bits, count, from, out) ||
	       search(map, map->used, area, (uint32_t)bits, count, from, out);
}

/* ---- two names ---- */

struct range {
	uint32_t first, end;
	int use;
};

static int by_first(const void *left, const void *right)
{
	const struct range *a = left, *b = right;

	if (a->first != b->first)
		return a->first < b->first ? -1 : 1;
	if (a->end != b->end)
		return a->end < b->end ? -1 : 1;
	return a->use < b->use ? -1 : a->use > b->use;
}

/* Places all areas far apart: a declaration beyond the end of one area overlaps no
 * other. */
static uint32_t apart(struct iec_addr addr)
{
	return (uint32_t)addr.area << 27 | (addr.byte * 8 + addr.bit);
}
_Static_assert(LIMIT_MEMORY * 8 + LIMIT_ELEMENTS * 64 <= 1u << 27 && AREA_COUNT <= 32,
	       "areas have room");

/* Every variable with an address, and every used address, each once. */
static int ranges_of(struct xref *xref, struct range *range)
{
	int count = 0, kept = 0;

	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->target.addr.area == AREA_NONE ||
		    (use->target.what == XREF_VARIABLE && use->kind != XREF_DECLARED))
			continue;
		range[count].first = apart(use->target.addr);
		range[count].end = range[count].first +
				   bits_of(xref->project, &use->target);
		range[count++].use = i;
	}
	qsort(range, (size_t)count, sizeof(*range), by_first);
	for (int i = 0; i < count; i++) {
		const struct xref_target *one = &xref->use[range[i].use].target;

		if (kept > 0 && one->what == XREF_ADDRESS &&
		    xref_same(one, &xref->use[range[kept - 1].use].target))
			continue;
		range[kept++] = range[i];
	}
	return kept;
}

int address_map_clashes(struct xref *xref, struct address_clash *out, int most)
{
	struct range *range = arena_alloc(&xref->arena,
					  sizeof(*range) * ((size_t)xref->count + 1));
	int count = range ? ranges_of(xref, range) : 0, found = 0;

	for (int i = 0; i < count; i++) {
		for (int k = i + 1; k < count && range[k].first < range[i].end; k++) {
			int a = range[i].use, b = range[k].use;

			if (found < most)
				out[found] = (struct address_clash){ a < b ? a : b,
								     a < b ? b : a };
			if (++found > LIMIT_VARS) /* all parts of one word: enough */
				return found;
		}
	}
	return range ? found : -1;
}

/* ---- all things ---- */

static int ranges_of_all(struct xref *xref, struct range *range)
{
	int count = 0;

	for (int i = 0; i < xref->count; i++) {
		const struct xref_target *target = &xref->use[i].target;

		if (target->addr.area == AREA_NONE ||
		    (target->what != XREF_VARIABLE && target->what != XREF_ADDRESS))
			continue;
		range[count].first = apart(target->addr);
		range[count].end = range[count].first + bits_of(xref->project, target);
		range[count++].use = i;
	}
	qsort(range, (size_t)count, sizeof(*range), by_first);
	return count;
}

static void count_use(struct address_thing *thing, const struct xref_use *use, int number)
{
	if (use->kind == XREF_DECLARED) {
		thing->use = number;
		return;
	}
	thing->uses++;
	thing->open |= use->target.what == XREF_ADDRESS && use->open;
	if (use->off)
		return;
	thing->coils += use->kind == XREF_COIL;
	thing->writes += use->kind == XREF_WRITTEN || use->kind == XREF_CHANGED;
}

/* The thing of a range among those with the same bits; NULL: it is new. */
static struct address_thing *same_thing(const struct xref *xref, struct address_thing *thing,
					int count, const struct range *range)
{
	const struct xref_target *target = &xref->use[range->use].target;

	for (int i = count - 1; i >= 0; i--) {
		const struct xref_target *other = &xref->use[thing[i].use].target;

		if (apart(other->addr) != range->first)
			return NULL;
		if (xref_same(other, target))
			return &thing[i];
	}
	return NULL;
}

int address_map_things(struct xref *xref, struct address_thing **out)
{
	struct range *range = arena_alloc(&xref->arena,
					  sizeof(*range) * ((size_t)xref->count + 1));
	int ranges = range ? ranges_of_all(xref, range) : 0, count = 0;
	struct address_thing *thing = range ? arena_alloc(&xref->arena,
		sizeof(*thing) * ((size_t)ranges + 1)) : NULL;

	for (int i = 0; thing && i < ranges; i++) {
		const struct xref_use *use = &xref->use[range[i].use];
		const struct iec_addr addr = use->target.addr;
		struct address_thing *at = same_thing(xref, thing, count, &range[i]);

		if (!at) {
			at = &thing[count++];
			*at = (struct address_thing){ .use = range[i].use, .area = addr.area,
				.first = addr.byte * 8 + addr.bit };
			at->end = at->first + (range[i].end - range[i].first);
		}
		count_use(at, use, range[i].use);
	}
	*out = thing;
	return thing ? count : -1;
}

/* For a text: it was read whole, or as parameters. For a folded name: it is declared. */
enum mark { SEEN_WHOLE = 1, SEEN_ARGS = 2, GLOBAL = 4, LOCAL = 8 };

struct walk {
	struct xref *out;
	const struct project *project;
	uint8_t *mark;           /* by string id                              */
	bool own;                /* the text may mean something else in another POU */
};

static struct xref_use *add(struct walk *walk, struct xref_target target,
			    enum xref_kind kind)
{
	struct xref_use *use = arena_push(&walk->out->arena, &walk->out->use,
					  &walk->out->count, sizeof(*use));

	if (use)
		*use = (struct xref_use){ .target = target, .kind = kind, .pou = -1 };
	return use;
}

static void walk_table(struct walk *walk, const struct var_table *table, int number)
{
	for (int i = 0; i < table->count; i++)
		if (table->var[i].at.area != AREA_NONE)
			add(walk, (struct xref_target){ XREF_VARIABLE, number, i,
							table->var[i].at },
			    XREF_DECLARED);
}

static void mark_table(struct walk *walk, const struct var_table *table, enum mark mark,
		       bool set)
{
	for (int i = 0; i < table->count; i++) {
		uint8_t *marks = &walk->mark[table->var[i].fold];

		*marks = (uint8_t)(set ? *marks | mark : *marks & ~mark);
	}
}

/* A variable may have the name of an address; then the variable is meant. */
static bool is_declared(struct walk *walk, const char *text, size_t len)
{
	walk->own = true;
	return walk->mark[names_find_any(&walk->project->names, text, len)] &
	       (GLOBAL | LOCAL);
}

/* An address, or a system name for one. */
static bool is_address(struct walk *walk, const char *text, size_t len,
		       struct iec_addr *out)
{
	if (len > 4 && ascii_same(text, "SYS_", 4))
		for (int i = 0; i < SYS_COUNT; i++) {
			const struct sys_row *row = sys_row((enum sys_id)i);

			if (ascii_is(row->name, text, len))
				return iec_addr_parse(row->address, strlen(row->address),
						      out) == ADDR_OK;
		}
	return iec_addr_parse(text, len, out) == ADDR_OK &&
	       (text[0] == '%' || !is_declared(walk, text, len));
}

/* Most texts are one name: no scanner is needed. */
static bool is_plain_name(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (!ascii_digit(text[i]) && text[i] != '_' &&
		    !(ascii_upper(text[i]) >= 'A' && ascii_upper(text[i]) <= 'Z'))
			return false;
	return true;
}

static void scan(struct walk *walk, const char *text, size_t len)
{
	struct xref_use *last = NULL;
	struct iec_addr addr;
	struct lex lex;

	if (is_plain_name(text, len)) {
		if (is_address(walk, text, len, &addr))
			add(walk, (struct xref_target){ XREF_ADDRESS, 0, 0, addr },
			    XREF_READ);
		return;
	}
	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;

		if (last && lex_is(&lex, "["))
			last->open = true;
		last = NULL;
		if ((token->kind == TOKEN_NAME || token->kind == TOKEN_ADDRESS) &&
		    is_address(walk, token->text, token->len, &addr)) {
			xref_part(&lex, &addr);
			last = add(walk, (struct xref_target){ XREF_ADDRESS, 0, 0, addr },
				   XREF_READ);
		}
	}
}

static void scan_whole(struct walk *walk, uint32_t id)
{
	if (!id || walk->mark[id] & SEEN_WHOLE)
		return;
	walk->own = false;
	scan(walk, project_text(walk->project, id), names_len(&walk->project->names, id));
	if (!walk->own)
		walk->mark[id] |= SEEN_WHOLE;
}

/* Only the values: the name of a parameter may look like an address. */
static void scan_args(struct walk *walk, uint32_t id)
{
	const char *next;
	struct arg arg;

	if (!id || walk->mark[id] & SEEN_ARGS)
		return;
	walk->own = false;
	next = project_text(walk->project, id);
	while (args_next(&next, &arg))
		scan(walk, arg.value, arg.value_len);
	if (!walk->own)
		walk->mark[id] |= SEEN_ARGS;
}

/* Names of labels, routines and parameters are not memory. */
static bool is_memory(enum operand_kind operand)
{
	return operand != OPND_NONE && operand != OPND_LABEL &&
	       operand != OPND_PIN && operand != OPND_LOOP_END && operand != OPND_EXECUTE;
}

static void walk_rung(struct walk *walk, const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		if (!cell->operand && !cell->args)
			continue;
		if (is_memory(words_row(&walk->project->words,
					(enum word)cell->word)->operand))
			scan_whole(walk, cell->operand);
		if (cell->word != ELEM_EXECUTE)
			scan_args(walk, cell->args);
	}
}

static void walk_list(struct walk *walk, const struct il *il)
{
	for (int i = 0; i < il->count; i++) {
		const struct il_line *line = &il->line[i];

		if (line->kind == IL_COMMENT || line->kind == IL_LABEL ||
		    (line->kind == IL_OP &&
		     !is_memory(op_row((enum op)line->op)->operand)))
			continue;
		scan_whole(walk, line->operand);
	}
}

static void walk_sfc(struct walk *walk, const struct sfc *sfc)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		scan_whole(walk, sfc->control[i]);
	for (int i = 0; i < sfc->step_count; i++) {
		scan_whole(walk, sfc->step[i].min);
		scan_whole(walk, sfc->step[i].max);
		scan_whole(walk, sfc->step[i].alarm);
	}
	for (int i = 0; i < sfc->use_count; i++) {
		if (sfc->use[i].action < 0)
			scan_whole(walk, sfc->use[i].operand);
		scan_whole(walk, sfc->use[i].time);
	}
}

static void walk_config(struct walk *walk, const struct config *config)
{
	for (int i = 0; config && i < config->count; i++)
		scan_whole(walk, config->entry[i].single);
}

bool xref_addresses(struct xref *out, struct project *project)
{
	struct walk walk = { .out = out, .project = project };

	*out = (struct xref){ .project = project };
	arena_init(&out->arena);
	walk.mark = arena_alloc(&out->arena, (size_t)project->names.count + 1);
	if (!walk.mark)
		return false;
	walk_table(&walk, &project->globals, 0);
	for (int i = 0; i < project->pou_count; i++)
		walk_table(&walk, &project->pou[i].vars, i + 1);
	mark_table(&walk, &project->globals, GLOBAL, true);
	walk_config(&walk, project->config);
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		mark_table(&walk, &pou->vars, LOCAL, true);
		for (int k = 0; k < pou->rung_count; k++)
			walk_rung(&walk, pou->rung[k]);
		walk_list(&walk, &pou->il);
		for (int k = 0; pou->st && k < pou->st->count; k++)
			if (pou->st->item[k].kind != ST_COMMENT)
				scan_whole(&walk, pou->st->item[k].text);
		if (pou->sfc)
			walk_sfc(&walk, pou->sfc);
		mark_table(&walk, &pou->vars, LOCAL, false);
	}
	return !out->arena.failed;
}
