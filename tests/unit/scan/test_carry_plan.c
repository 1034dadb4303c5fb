/* SPDX-License-Identifier: MIT
 *
 * test_carry_plan - a plan and its application against a slow evaluator that goes name by
 * name; what a plan costs; which losses it tells.
 *
 * The evaluator is made from the description in carry.h. It compares every name with
 * every other one and moves one element, one byte or one bit at a time.
 */
#include "engine/base/digest.h"
#include "engine/scan/carry.h"
#include "tests/unit/scan/carry_random.h"

#include <strings.h>

#define PAIRS 200

static struct made made;
static struct random_source source;

/* ---- the evaluator ---- */

struct known { struct declared_name name; bool used; };
static struct known known[4096], wanted[4096];
static int known_count, wanted_count;

struct model {
	struct image *to;         /* what is expected; begins cold            */
	const struct image *from;
	struct image to_cold, from_cold;
};

static int list_names(const struct program *program, struct known *out)
{
	struct declared_cursor cursor = { .memories = true };
	int count = 0;

	memset(out, 0, sizeof(known));
	while (count < 4096 && image_next_declared(program, &cursor, &out[count].name))
		count++;
	return count;
}

static bool has_blank(const struct declared_name *name)
{
	return strchr(name->name, ' ') != NULL;
}

static bool is_bare_name(const struct declared_name *a, const struct declared_name *b)
{
	return a->array.head == b->array.head && strcasecmp(a->pou, b->pou) == 0 &&
	       strncasecmp(a->name, b->name, a->array.head) == 0;
}

static bool is_input(const struct image *image, struct location at)
{
	static const enum iec_area inputs[] = { AREA_I, AREA_SM, AREA_AI, AREA_XI, AREA_XAI };
	const struct areas *areas = &image->program->areas;

	for (int i = 0; i < 5; i++)
		if (at.area == inputs[i] ||
		    (at.area == AREA_NONE && at.where >= areas->at[inputs[i]] &&
		     at.where < areas->at[inputs[i]] + areas->bytes[inputs[i]]))
			return true;
	return false;
}

static bool equal_values(enum iec_type type, union iec_value a, union iec_value b)
{
	return type == IEC_STRING ? a.s->length == b.s->length &&
				    memcmp(a.s->text, b.s->text, a.s->length) == 0
				  : a.i == b.i;
}

static void model_value(struct model *model, struct location to, struct location from)
{
	const union iec_value old = image_get(model->from, from);
	const bool text = to.type == IEC_STRING;

	if (is_input(model->to, to))
		return;
	if (equal_values(to.type, old, image_get(&model->from_cold, from)) ||
	    (text && old.s->length > image_get(&model->to_cold, to).s->capacity))
		image_set(model->to, to, image_get(&model->to_cold, to));
	else
		image_set(model->to, to, old);
}

static void model_instance(struct model *model, uint32_t to, uint32_t from)
{
	const struct word_row *row = word_row(code_instance(model->to->program, to));

	if (code_instance(model->from->program, from) !=
	    code_instance(model->to->program, to))
		return;
	for (uint32_t i = 0; i < row->size; i++)
		model->to->memory[to + i] = model->from->memory[from + i];
	for (int i = 0; i < row->pin_count; i++) {
		const uint32_t at = row->pin[i].offset;
		const uint32_t size = iec_type_row(row->pin[i].type)->size;

		if (row->pin[i].dir == PIN_IN &&
		    memcmp(model->to_cold.memory + to + at,
			   model->from_cold.memory + from + at, size) != 0)
			memcpy(model->to->memory + to + at,
			       model->to_cold.memory + to + at, size);
	}
}

static void model_name(struct model *model, const struct declared_name *to,
		       const struct declared_name *from)
{
	if (to->at.type != from->at.type || to->at.constant ||
	    (to->array.count > 0) != (from->array.count > 0))
		return;
	if (to->at.type == IEC_NONE) {
		model_instance(model, to->at.where, from->at.where);
		return;
	}
	if (!to->array.count)
		model_value(model, to->at, from->at);
	for (uint32_t i = 0; i < to->array.count; i++)
		for (uint32_t k = 0; k < from->array.count; k++)
			if (to->array.low + (int64_t)i == from->array.low + (int64_t)k)
				model_value(model, declared_element(to, i),
					    declared_element(from, k));
}

static void model_names(struct model *model)
{
	for (int i = 0; i < wanted_count; i++)
		for (int k = 0; k < known_count && !has_blank(&wanted[i].name); k++)
			if (!has_blank(&known[k].name) &&
			    is_bare_name(&wanted[i].name, &known[k].name)) {
				model_name(model, &wanted[i].name, &known[k].name);
				break;
			}
}

/* "P Start @1a2b3c4d" and "P Start @99999999" are the same element in two rungs. */
static bool is_element(const char *a, const char *b, bool whole)
{
	const char *end = strchr(a, '@'), *other = strchr(b, '@');

	if (whole || !end || !other)
		return strcmp(a, b) == 0;
	return end - a == other - b && strncasecmp(a, b, (size_t)(end - a)) == 0;
}

static void model_memories(struct model *model, bool whole)
{
	for (int i = 0; i < wanted_count; i++)
		for (int k = 0; k < known_count; k++) {
			struct known *to = &wanted[i], *from = &known[k];

			if (to->used || from->used || !has_blank(&to->name) ||
			    !has_blank(&from->name) ||
			    strcasecmp(to->name.pou, from->name.pou) != 0 ||
			    !is_element(to->name.name, from->name.name, whole))
				continue;
			model_name(model, &to->name, &from->name);
			to->used = from->used = true;
		}
}

static struct location operand_of(struct model *model, const struct declared_name *memory)
{
	const char *blank = strchr(memory->name, ' '), *end = strchr(memory->name, '@');
	const size_t path = (size_t)(blank - 1 - memory->name);
	const int len = end ? (int)(end - 1 - (blank + 1)) : 0;
	char name[3][700];
	struct location at = { .type = IEC_NONE };

	if ((blank[-1] != 'P' && blank[-1] != 'N') ||
	    (path && memory->name[path - 1] != '.') || len <= 0)
		return at;
	snprintf(name[0], sizeof(name[0]), "%s%s%.*s%.*s", memory->pou,
		 *memory->pou ? "." : "", (int)path, memory->name, len, blank + 1);
	snprintf(name[1], sizeof(name[1]), "%.*s%.*s", (int)path, memory->name, len, blank + 1);
	snprintf(name[2], sizeof(name[2]), "%.*s", len, blank + 1);
	for (int i = 0; i < 3 && at.type == IEC_NONE; i++)
		at = image_find(model->to, name[i], strlen(name[i]));
	return at;
}

static int edges_begun;

static void model_edges(struct model *model)
{
	for (int i = 0; i < wanted_count; i++) {
		struct location at = { .type = IEC_NONE };

		if (has_blank(&wanted[i].name) && !wanted[i].used)
			at = operand_of(model, &wanted[i].name);
		if (at.type != IEC_BOOL)
			continue;
		image_set(model->to, wanted[i].name.at, image_get(model->to, at));
		edges_begun++;
	}
}

static void model_areas(struct model *model)
{
	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++)
		for (uint32_t bit = 0; bit < 8 * model->from->program->areas.bytes[area]; bit++)
			image_set_bit(model->to, (enum iec_area)area, bit,
				      image_get_bit(model->from, (enum iec_area)area, bit));
}

static bool in_areas(const struct image *image, struct location at)
{
	return at.area != AREA_NONE || at.where < image->program->areas.size;
}

static struct location same_address(struct model *model, struct location at)
{
	const struct areas *to = &model->to->program->areas;
	const struct areas *from = &model->from->program->areas;
	const struct location none = { .type = IEC_NONE };

	if (at.area != AREA_NONE)
		return at.where < 8 * to->bytes[at.area] ? at : none;
	for (int area = AREA_NONE + 1; area < AREA_COUNT; area++) {
		const uint32_t byte = at.where - from->at[area];

		if (at.where < from->at[area] || byte >= from->bytes[area])
			continue;
		if (byte + iec_type_row(at.type)->size > to->bytes[area])
			return none;
		at.where = to->at[area] + byte;
		return at;
	}
	return none;
}

/* By the name of the place, with its POU. */
static struct location same_symbol(struct model *model, struct location at)
{
	static struct symbol_cursor one, other;
	struct symbol from, to;

	one = other = (struct symbol_cursor){ .whole = true };
	while (image_next_symbol(model->from, &one, &from))
		if (from.at.type == at.type && from.at.area == at.area &&
		    from.at.where == at.where)
			while (image_next_symbol(model->to, &other, &to))
				if (strcasecmp(to.name, from.name) == 0)
					return to.at;
	return (struct location){ .type = IEC_NONE };
}

static void model_forces(struct model *model)
{
	for (int i = 0; i < model->from->force_count; i++) {
		const struct force *force = &model->from->force[i];
		const struct location at = in_areas(model->from, force->at) ?
					   same_address(model, force->at) :
					   same_symbol(model, force->at);

		if (at.type != force->at.type)
			continue;
		image_set(model->to, at, force->aside);
		image_force(model->to, at, force->value);
	}
}

static void cold(struct image *image, const struct program *program)
{
	image_init(image, program, calloc(1, image_memory_size(program)));
}

/* @to gets what carry_apply() should give. */
static void expect(struct image *to, const struct image *from)
{
	static struct model model;

	model.to = to;
	model.from = from;
	cold(&model.to_cold, to->program);
	cold(&model.from_cold, from->program);
	known_count = list_names(from->program, known);
	wanted_count = list_names(to->program, wanted);
	model_areas(&model);
	model_names(&model);
	model_memories(&model, true);
	model_memories(&model, false);
	model_edges(&model);
	model_forces(&model);
	free(model.to_cold.memory);
	free(model.from_cold.memory);
}

/* ---- the comparison ---- */

static void say_name(const struct image *image, uint32_t offset)
{
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	while (image_next_declared(image->program, &cursor, &name)) {
		uint32_t size = name.stride * (name.array.count ? name.array.count : 1);

		if (name.at.type == IEC_NONE)
			size = word_row(code_instance(image->program, name.at.where))->size;
		if (name.at.area == AREA_NONE && offset - name.at.where < size)
			printf("# in %s.%s\n", name.pou, name.name);
	}
}

static bool same_memory(const struct image *got, const struct image *want)
{
	const uint32_t size = (uint32_t)image_memory_size(got->program);

	for (uint32_t i = 0; i < size; i++) {
		if (got->memory[i] == want->memory[i])
			continue;
		printf("# byte %u of %u (areas %u): %u, expected %u\n", (unsigned)i,
		       (unsigned)size, (unsigned)got->program->areas.size,
		       got->memory[i], want->memory[i]);
		say_name(got, i);
		return false;
	}
	return true;
}

static bool same_forces(const struct image *got, const struct image *want)
{
	bool same = got->force_count == want->force_count;

	for (int i = 0; same && i < got->force_count; i++) {
		const struct force *a = &got->force[i], *b = &want->force[i];

		same = a->at.type == b->at.type && a->at.area == b->at.area &&
		       a->at.where == b->at.where && a->value.i == b->value.i &&
		       a->aside.i == b->aside.i;
	}
	if (!same)
		printf("# forces differ: %d, expected %d\n", got->force_count,
		       want->force_count);
	return same;
}

static bool same_tasks(const struct resource *to, const struct resource *from)
{
	const struct program *new = to->image.program, *old = from->image.program;

	for (uint32_t i = 0; i < new->task_count; i++) {
		const struct task_state *state = &to->tasks.state[i];
		uint32_t k = 0;

		while (k < old->task_count &&
		       (strcmp(task_name(new, i), task_name(old, k)) != 0 ||
			new->task[i].kind != old->task[k].kind ||
			task_interval(&new->task[i]) != task_interval(&old->task[k])))
			k++;
		if (k < old->task_count &&
		    memcmp(state, &from->tasks.state[k], sizeof(*state)) != 0)
			return false;
		if (k == old->task_count && (state->due || state->overruns || state->runs ||
		    state->next_ns != from->vm.now_ns - from->timers_ns))
			return false;
	}
	return to->scans == from->scans && to->vm.errors == from->vm.errors &&
	       to->vm.now_ns == from->vm.now_ns && to->vm.memory == to->image.memory &&
	       to->vm.program == new && to->state == from->state;
}

static int applied, kept_forces, lost_forces;

/* Applies a plan from @from to @to, which is initialised here, and compares. */
static bool compare(struct rig *to, const struct rig *from)
{
	const struct program *program = ladder_program(to->ladder);
	const struct carry_plan *plan;
	static struct image want;
	struct arena arena;
	bool good;

	arena_init(&arena);
	resource_init(&to->resource, program, to->memory);
	cold(&want, program);
	expect(&want, &from->resource.image);
	plan = carry_plan_new(program, from->resource.image.program, &arena);
	good = plan && carry_apply(plan, &to->resource, &from->resource) &&
	       same_memory(&to->resource.image, &want) &&
	       same_forces(&to->resource.image, &want) &&
	       same_tasks(&to->resource, &from->resource);
	kept_forces += want.force_count;
	lost_forces += from->resource.image.force_count - want.force_count;
	applied++;
	free(want.memory);
	arena_free(&arena);
	return good;
}

/* Without a message: not every random text builds. */
static bool open_text(struct rig *rig, const char *text)
{
	memset(rig, 0, sizeof(*rig));
	rig->ladder = ladder_new();
	if (!ladder_load_text(rig->ladder, "random.rung", text, strlen(text)) ||
	    !ladder_build(rig->ladder)) {
		if (getenv("CARRY_SAYS_WHY"))
			rig_say_why(rig->ladder);
		return false;
	}
	rig->good = true;
	rig->memory = calloc(1, image_memory_size(ladder_program(rig->ladder)));
	resource_init(&rig->resource, ladder_program(rig->ladder), rig->memory);
	resource_start(&rig->resource);
	return true;
}

static bool open_made(struct rig *rig, uint64_t seed)
{
	static char text[sizeof(made.text) + 32];

	snprintf(text, sizeof(text), "RUNGBOARD 1\n%s", make_text_of(&made, seed));
	return open_text(rig, text);
}

/* ---- there and back ---- */

/* Whether a symbol of @a is in @b with the same type and initial value, as data without
 * an address in both. */
static bool is_in_both(const struct image *a, const struct image *b, const char *name,
		       struct location at, struct location *other)
{
	static struct symbol_cursor cursor;
	struct symbol symbol;

	cursor = (struct symbol_cursor){ .whole = true };
	while (!in_areas(a, at) && image_next_symbol(b, &cursor, &symbol))
		if (strcasecmp(symbol.name, name) == 0) {
			*other = symbol.at;
			return symbol.at.type == at.type && !in_areas(b, symbol.at) &&
			       !symbol.block && !symbol.at.constant && !at.constant &&
			       equal_values(at.type, image_get(a, at),
					    image_get(b, symbol.at));
		}
	return false;
}

static int kept;

/* @cold_a, @cold_b: to compare initial values. Pins do not count. */
static bool same_as_before(const struct image *a, const struct image *back,
			   const struct image *cold_a, const struct image *cold_b)
{
	static struct symbol_cursor cursor;
	struct symbol symbol;
	struct location other;

	cursor = (struct symbol_cursor){ .whole = true };
	while (image_next_symbol(a, &cursor, &symbol)) {
		const union iec_value before = image_get(a, symbol.at);

		if (symbol.block || !is_in_both(cold_a, cold_b, symbol.name, symbol.at, &other))
			continue;
		if (symbol.at.type == IEC_STRING &&
		    before.s->length > image_get(cold_b, other).s->capacity)
			continue;
		kept++;
		if (equal_values(symbol.at.type, before, image_get(back, symbol.at)))
			continue;
		printf("# %s is not as before\n", symbol.name);
		return false;
	}
	return true;
}

static bool there_and_back(const struct rig *a, struct rig *b)
{
	static struct image cold_a, cold_b;
	struct rig back = { .ladder = a->ladder };
	bool same;

	cold(&cold_a, ladder_program(a->ladder));
	cold(&cold_b, ladder_program(b->ladder));
	back.memory = calloc(1, image_memory_size(ladder_program(a->ladder)));
	same = compare(&back, b) &&
	       same_as_before(&a->resource.image, &back.resource.image, &cold_a, &cold_b);
	free(back.memory);
	free(cold_a.memory);
	free(cold_b.memory);
	return same;
}

static bool test_pair(uint64_t seed)
{
	struct rig a, b;
	bool good = true;

	random_seed(&source, seed);
	if (open_made(&a, 2 * seed) && open_made(&b, 2 * seed + 1)) {
		stir(&source, &a.resource);
		good = compare(&b, &a) && there_and_back(&a, &b);
		rig_close(&b);
	}
	rig_close(&a);
	if (!good)
		printf("# seed %llu\n", (unsigned long long)seed);
	return good;
}

static void test_made(void)
{
	const int pairs = tap_rounds(PAIRS);
	int good = 0;

	for (int seed = 1; seed <= pairs; seed++)
		good += test_pair((uint64_t)seed);
	printf("# %d changes, %d values kept there and back, %d edges begun, %d forces kept, "
	       "%d ended\n", applied, kept, edges_begun, kept_forces, lost_forces);
	CHECK(good == pairs);
	/* About 20 values a pair are kept: fewer pairs, as in an emulator, vary more. */
	CHECK(applied > pairs && kept > 10 * pairs && edges_begun > pairs);
	CHECK(kept_forces > pairs && lost_forces > pairs);
}

/* Programs of the walker: own blocks in one another, structures, lists of all words. */
static bool open_random(struct rig *rig, uint64_t seed)
{
	static struct random_program program;
	static char text[128 * 1024];

	random_make(&program, seed);
	random_print(&program, text, sizeof(text));
	return open_text(rig, text);
}

static bool test_random_pair(uint64_t seed)
{
	struct rig a, b;
	bool good = true;

	random_seed(&source, seed);
	if (open_random(&a, seed) && open_random(&b, seed + 5000)) {
		stir(&source, &a.resource);
		good = compare(&b, &a) && compare(&a, &b);
		rig_close(&b);
	}
	rig_close(&a);
	if (!good)
		printf("# random seed %llu\n", (unsigned long long)seed);
	return good;
}

static void test_random(void)
{
	const int pairs = tap_rounds(PAIRS / 2), before = applied;
	int good = 0;

	for (int seed = 1; seed <= pairs; seed++)
		good += test_random_pair((uint64_t)seed);
	printf("# %d changes of programs of the walker\n", applied - before);
	CHECK(good == pairs && applied - before > pairs);
}

/* ---- by hand ---- */

struct change {
	struct rig old, new;
	struct arena arena;
	const struct carry_plan *plan;
};

static void plan_change(struct change *change, const char *old, const char *new)
{
	if (!rig_open(&change->old, old, false) || !rig_open(&change->new, new, false))
		exit(tap_done());
	resource_init(&change->new.resource, ladder_program(change->new.ladder),
		      change->new.memory);
	arena_init(&change->arena);
	change->plan = carry_plan_new(ladder_program(change->new.ladder),
				      ladder_program(change->old.ladder), &change->arena);
}

static bool apply(struct change *change)
{
	resource_init(&change->new.resource, ladder_program(change->new.ladder),
		      change->new.memory);
	return CHECK(change->plan &&
		     carry_apply(change->plan, &change->new.resource, &change->old.resource));
}

static void end_change(struct change *change)
{
	arena_free(&change->arena);
	rig_close(&change->old);
	rig_close(&change->new);
}

static bool holds(struct rig *rig, const char *name, int64_t value)
{
	return image_is_forced(&rig->resource.image, rig_at(rig, name)) &&
	       rig_get(rig, name) == value;
}

/* Bits that have their own byte in an image, but not where a word shares it. */
#define USES \
	"PROGRAM Main LD\n" \
	"RUNG\n  | NO %MX10.1 | NC %MX13.7 | NO %IX0.2 | COIL %QX0.0 |\n" \
	"RUNG\n  | NO %MX40.0 | COIL %MX41.0 |\n" \
	"END_PROGRAM\n"
static const char placed[] =
	"VAR_GLOBAL\n  Same AT %MW10 : INT := 5;\n  Other AT %MW12 : INT := 5;\n"
	"  Free : INT := 5;\n  Bit AT %MX20.0 : BOOL;\n  On AT %MX20.1 : BOOL;\n"
	"  Moves AT %MX21.3 : BOOL;\n  Stays : BOOL;\n  Leaves AT %MX22.0 : BOOL;\n"
	"  Mask : WORD;\n  Line AT %MX23.0 : ARRAY[0..3] OF BOOL;\n"
	"  Names : ARRAY[1..3] OF STRING[6] := ['one', 'two'];\n"
	"  Steps : ARRAY[0..3] OF DINT := [1, 2, 3, 4];\nEND_VAR\n" USES;
static const char placed_again[] =
	"VAR_GLOBAL\n  Steps : ARRAY[0..3] OF DINT := [1, 20, 3, 4];\n"
	"  Names : ARRAY[2..4] OF STRING[3] := ['TWO'];\n"
	"  Same AT %MW10 : INT := 7;\n  Other AT %MW12 : INT := 7;\n  Free : INT := 7;\n"
	"  Bit AT %MX20.0 : BOOL := TRUE;\n  On AT %MX20.1 : BOOL := TRUE;\n"
	"  Moves AT %MX31.2 : BOOL;\n  Stays AT %MX32.2 : BOOL;\n  Leaves : BOOL;\n"
	"  Mask AT %MW40 : WORD;\n  Line AT %MX33.1 : ARRAY[1..4] OF BOOL;\nEND_VAR\n" USES;

static void test_addresses(void)
{
	struct change change;
	struct rig *old = &change.old, *new = &change.new;
	struct iec_text room;
	struct iec_string *text = iec_text_init(&room, 4);

	plan_change(&change, placed, placed_again);
	rig_set(old, "Other", -2);
	rig_set(old, "Moves", 1);
	rig_set(old, "Stays", 1);
	rig_set(old, "Leaves", 1);
	rig_set(old, "Line[2]", 1);
	rig_set(old, "Mask", 0x8001);
	rig_set(old, "%IX0.2", 1);
	rig_set(old, "Steps[2]", 30);
	memcpy(text->text, "long", 4);
	image_set(&old->resource.image, rig_at(old, "Names[3]"), (union iec_value){ .s = text });
	apply(&change);
	/* The first still had its initial value; bits and words at an address agree. */
	CHECK(rig_get(new, "Same") == 7 && rig_get(new, "Free") == 7);
	CHECK(rig_get(new, "%MX10.1") == 1 && rig_get(new, "%MB10") == 7);
	CHECK(rig_get(new, "Other") == -2 && rig_get(new, "%MX13.7") == 1);
	CHECK(rig_get(new, "Bit") == 1 && rig_get(new, "On") == 1 &&
	      rig_get(new, "%MB20") == 3);
	CHECK(rig_get(new, "Moves") == 1 && rig_get(new, "Stays") == 1 &&
	      rig_get(new, "Leaves") == 1 && rig_get(new, "%MB31") == 4 &&
	      rig_get(new, "%MB32") == 4);
	CHECK(rig_get(new, "Line[1]") == 0 && rig_get(new, "Line[2]") == 1 &&
	      rig_get(new, "%MB33") == 4);
	CHECK(rig_get(new, "%MW40") == 0x8001 && rig_get(new, "%MX40.0") == 1 &&
	      rig_get(new, "%MX41.0") == 0);
	CHECK(rig_get(new, "%IX0.2") == 1);
	CHECK(rig_get(new, "Steps[1]") == 20 && rig_get(new, "Steps[2]") == 30 &&
	      rig_get(new, "Steps[3]") == 4);
	/* The initial text of the second is new; that of the third no longer fits. */
	CHECK(image_get(&new->resource.image, rig_at(new, "Names[2]")).s->length == 3 &&
	      image_get(&new->resource.image, rig_at(new, "Names[2]")).s->text[0] == 'T');
	CHECK(image_get(&new->resource.image, rig_at(new, "Names[3]")).s->length == 0);
	end_change(&change);
}

/* Each pair of numbers is one move; but what is written between them stays between. */
static void test_order(void)
{
	struct change change;
	struct rig *old = &change.old, *new = &change.new;

	plan_change(&change,
		    "VAR_GLOBAL\n  A AT %MW20 : INT;\n  Bit AT %MX40.0 : BOOL;\n"
		    "  B AT %MW22 : INT;\n  E : INT := 1;\n  C : DINT := 1;\n"
		    "  Text : STRING[3] := 'a';\n  D : DINT := 1;\nEND_VAR\n" USES,
		    "VAR_GLOBAL\n  A AT %MW10 : INT;\n  Bit AT %MX12.0 : BOOL;\n"
		    "  B AT %MW12 : INT;\n  E : INT := 4;\n  C : DINT := 2;\n"
		    "  Text : STRING[3] := 'b';\n  D : DINT := 3;\nEND_VAR\n"
		    "PROGRAM Main LD\nRUNG\n  | [ C := C + 1 ] |\nEND_PROGRAM\n");
	rig_set(old, "A", 5);
	rig_set(old, "B", 3);
	rig_set(old, "Bit", 0);
	apply(&change);
	CHECK(rig_get(new, "A") == 5 && rig_get(new, "B") == 3 && rig_get(new, "Bit") == 1);
	CHECK(rig_get(new, "C") == 2 && rig_get(new, "D") == 3 && rig_get(new, "E") == 4);
	end_change(&change);
}

#define SIZES(more) \
	"VAR_GLOBAL\n  A : INT;\nEND_VAR\nCONFIGURATION Sizes\n  AREA M 600;\n" more \
	"END_CONFIGURATION\nPROGRAM Main LD\n" \
	"RUNG\n  | NO %MX1.1 | COIL %MX2.2 |\n"

/* Bits beyond the end of the smaller area go nowhere, and come from nowhere. */
static void test_sizes(void)
{
	static const char small[] = SIZES("") "RUNG\n  | [ A := A + 1 ] |\nEND_PROGRAM\n";
	static const char large[] =
		"VAR_GLOBAL\n  A : INT;\nEND_VAR\nPROGRAM Main LD\n"
		"RUNG\n  | NO %MX1.1 | NO %MX601.2 | NO %MX599.7 | NO %MX600.0 | COIL %MX602.2 |\n"
		"END_PROGRAM\n";
	struct change change;

	plan_change(&change, large, small);
	rig_set(&change.old, "%MX1.1", 1);
	rig_set(&change.old, "%MX601.2", 1);
	rig_set(&change.old, "%MX599.7", 1);
	rig_set(&change.old, "%MX600.0", 1);
	apply(&change);
	CHECK(rig_get(&change.new, "%MX1.1") == 1);
	CHECK(rig_get(&change.new, "%MX599.7") == 1);
	/* V begins behind M. */
	CHECK(rig_get(&change.new, "%VX0.0") == 0 && rig_get(&change.new, "%VX1.2") == 0);
	end_change(&change);
	plan_change(&change, small, large);
	rig_set(&change.old, "%MX1.1", 1);
	rig_set(&change.old, "%VX0.0", 1);
	rig_set(&change.old, "%VX1.2", 1);
	apply(&change);
	CHECK(rig_get(&change.new, "%MX1.1") == 1 && rig_get(&change.new, "%VX1.2") == 1);
	CHECK(rig_get(&change.new, "%MX600.0") == 0 && rig_get(&change.new, "%MX601.2") == 0);
	end_change(&change);
}

/* Only a comment differs: the memory and the forces are copied. */
static void test_same_code(void)
{
	struct change change;

	plan_change(&change, "VAR_GLOBAL\n  A : INT;\n  Fast : INT;\nEND_VAR\n" USES,
		    "VAR_GLOBAL\n  A : INT; (* more *)\n  Slow : INT;\nEND_VAR\n" USES);
	rig_set(&change.old, "Fast", 5);
	CHECK(rig_force(&change.old, "A", 4) && rig_force(&change.old, "%MX10.1", 1));
	apply(&change);
	CHECK(change.new.resource.image.force_count == 2 && holds(&change.new, "A", 4) &&
	      holds(&change.new, "%MX10.1", 1));
	CHECK(rig_get(&change.new, "Slow") == 5);
	end_change(&change);
}

/* A plan knows no values: it can be applied to any state. */
static void test_again(void)
{
	struct change change;
	struct rig *old = &change.old, *new = &change.new;

	plan_change(&change, placed, placed_again);
	for (int i = 0; i < 3; i++) {
		rig_set(old, "Free", i * 5);
		rig_set(old, "Stays", i & 1);
		apply(&change);
		CHECK(rig_get(new, "Free") == (i == 1 ? 7 : i * 5));
		CHECK(rig_get(new, "Stays") == (i & 1));
	}
	end_change(&change);
}

/* A plan for other programs changes nothing. */
static void test_wrong_plan(void)
{
	struct change change;
	const struct rig *new = &change.new;
	uint8_t *before;
	size_t size;

	plan_change(&change, placed, placed_again);
	size = image_memory_size(ladder_program(new->ladder));
	before = malloc(size);
	memcpy(before, new->memory, size);
	rig_set(&change.old, "Free", 99);
	CHECK(!carry_apply(change.plan, &change.old.resource, &change.new.resource));
	CHECK(!carry_apply(change.plan, &change.new.resource, &change.new.resource));
	CHECK(!carry_apply(change.plan, &change.old.resource, &change.old.resource));
	CHECK(memcmp(before, new->memory, size) == 0 && new->resource.scans == 0);
	CHECK(rig_get(&change.old, "Free") == 99);
	free(before);
	end_change(&change);
}

/* ---- forces ---- */

static char told[4096];
static int misplaced;

/* Whether the place is that of the name, or of the first of some elements. */
static bool is_place(const struct image *image, const struct carry_loss *loss)
{
	const char *range = strstr(loss->name, "..");
	char name[80];
	struct location at;

	snprintf(name, sizeof(name), "%.*s%s", range ? (int)(range - loss->name) : 60,
		 loss->name, range ? "]" : "");
	at = image_find(image, name, strlen(name));
	return at.type == loss->at.type && at.where == loss->at.where;
}

static void tell(void *context, const struct carry_loss *loss)
{
	static const char *const word[] = { "gone", "new", "type", "block", "text", "force" };
	const size_t used = strlen(told);

	snprintf(told + used, sizeof(told) - used, "%s %s %d\n", word[loss->reason], loss->name,
		 (int)loss->at.type);
	if (loss->reason == CARRY_TEXT || loss->reason == CARRY_NEW)
		misplaced += context && !is_place(context, loss);
}

static const char *losses(const struct change *change, const struct image *now)
{
	told[0] = '\0';
	carry_plan_losses(change->plan, now, tell, (void *)&change->new.resource.image);
	return told;
}

/* The lines of them that are about forces; they are the last. */
static const char *force_losses(const struct change *change)
{
	const char *first = strstr(losses(change, &change->old.resource.image), "force ");

	return first ? first : "";
}

static const char forced[] =
	"VAR_GLOBAL\n  A : INT;\n  B : INT;\n  C : INT;\n  List : ARRAY[1..5] OF INT;\n"
	"  Bits : ARRAY[0..3] OF BOOL;\n  Twin : INT;\n  Goes : INT;\n"
	"  Fixed : INT := 3;\nEND_VAR\n"
	"PROGRAM Main LD\nVAR\n  Own : INT;\n  Twin : INT;\n  Wait : TON;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | TON Wait PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n";
static const char forced_again[] =
	"VAR_GLOBAL\n  C : INT;\n  B AT %MW40 : INT;\n  A : INT;\n"
	"  Bits AT %MX50.3 : ARRAY[2..6] OF BOOL;\n  List : ARRAY[3..9] OF INT;\nEND_VAR\n"
	"VAR_GLOBAL CONSTANT\n  Fixed : INT := 3;\nEND_VAR\n"
	"CONFIGURATION Small\n  AREA M 60;\nEND_CONFIGURATION\n"
	"PROGRAM Main LD\nVAR\n  Goes : INT;\n  Own : INT;\n  Wait : TOF;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | TOF Wait PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n";

static const char forced_store[] =
	"PROGRAM Main LD\nVAR\n  Wait : FIFO;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | FIFO Wait IN:=1 SIZE:=2 | COIL %QX0.0 |\nEND_PROGRAM\n";

static void test_forces(void)
{
	struct location at;
	struct change change;
	struct rig *old = &change.old, *new = &change.new;

	plan_change(&change, forced, forced_again);
	rig_set(old, "B", 20);
	CHECK(rig_force(old, "A", 1) && rig_force(old, "B", 2) && rig_force(old, "List[2]", 3) &&
	      rig_force(old, "List[5]", 4) && rig_force(old, "Bits[1]", 1) &&
	      rig_force(old, "Bits[3]", 1) && rig_force(old, "Main.Own", 5) &&
	      rig_force(old, "Main.Wait.ET", 6) && rig_force(old, "%MW58", 7) &&
	      rig_force(old, "%MD58", 8) && rig_force(old, "%MX59.7", 1) &&
	      rig_force(old, "%MX60.0", 1) && rig_force(old, "Goes", 9) &&
	      rig_force(old, "Twin", 10) && rig_force(old, "Fixed", 11));
	apply(&change);
	CHECK(new->resource.image.force_count == 8);
	CHECK(holds(new, "A", 1) && holds(new, "B", 2) && rig_get(new, "%MW40") == 2);
	CHECK(holds(new, "List[5]", 4) && holds(new, "Bits[3]", 1) && holds(new, "%MX50.4", 1));
	CHECK(holds(new, "Main.Own", 5) && holds(new, "Main.Wait.ET", 6));
	CHECK(holds(new, "%MX59.7", 1));
	/* %MD58 has no room any more; %MW58 has. */
	CHECK(rig_get(new, "%MW58") == (7 | 1 << 15));
	/* A variable of another POU is another variable. */
	CHECK(!image_is_forced(&new->resource.image, rig_at(new, "Main.Goes")));
	CHECK(rig_release(new, "B") && rig_get(new, "B") == 20);
	CHECK(rig_get(new, "Fixed") == 3);
	CHECK_TEXT(force_losses(&change), "force %MD58 4\nforce %MX60.0 1\n"
		   "force List[2] 7\nforce Bits[1] 1\nforce Twin 7\nforce Goes 7\nforce Fixed 7\n");
	end_change(&change);
	/* Between two elements of an array there is none. */
	plan_change(&change, forced, forced_again);
	at = rig_at(old, "List[3]");
	at.where++;
	CHECK(image_force(&old->resource.image, at, (union iec_value){ .i = 5 }));
	apply(&change);
	CHECK(new->resource.image.force_count == 0);
	end_change(&change);
	/* A pin of another block, if it has the same name and type. */
	plan_change(&change, forced, forced_store);
	CHECK(rig_force(old, "Wait.IN", 1) && rig_force(old, "Wait.Q", 1));
	apply(&change);
	CHECK(new->resource.image.force_count == 1 && holds(new, "Wait.Q", 1));
	CHECK_TEXT(force_losses(&change), "force Main.Wait.IN 1\n");
	end_change(&change);
}

static void test_all_forces(void)
{
	struct change change;
	struct rig *old = &change.old;
	char name[24];

	plan_change(&change,
		    "VAR_GLOBAL\n  A : ARRAY[1..300] OF INT;\nEND_VAR\nPROGRAM Main LD\n"
		    "RUNG\n  | [ A[1] := 1 ] |\nEND_PROGRAM\n",
		    "VAR_GLOBAL\n  B : INT;\n  A : ARRAY[2..400] OF INT;\nEND_VAR\n"
		    "PROGRAM Main LD\nRUNG\n  | [ A[2] := 1 ] |\nEND_PROGRAM\n");
	for (int i = 2; i < 2 + LIMIT_FORCES; i++) {
		snprintf(name, sizeof(name), "A[%d]", i);
		rig_force(old, name, i);
	}
	apply(&change);
	CHECK(change.new.resource.image.force_count == LIMIT_FORCES);
	for (int i = 2; i < 2 + LIMIT_FORCES; i += 51) {
		snprintf(name, sizeof(name), "A[%d]", i);
		CHECK(holds(&change.new, name, i));
	}
	end_change(&change);
}

/* ---- losses ---- */

static const char lost[] =
	"TYPE\n  Item : STRUCT\n    Speed : INT;\n    Name : STRING[8];\n  END_STRUCT;\nEND_TYPE\n"
	"VAR_GLOBAL\n  Kept : INT;\n  Gone : INT;\n  Typed : INT;\n  Many : INT;\n"
	"  List : ARRAY[1..6] OF INT;\n  Apart : ARRAY[1..2] OF INT;\n  Text : STRING[9];\n"
	"  Short : STRING[9];\n  Texts : ARRAY[1..4] OF STRING[9];\n"
	"  Lines : ARRAY[3..4] OF STRING[9];\n  Item1 : Item;\n"
	"  Down : ARRAY[4..6] OF INT;\n  Place AT %MW20 : INT;\n  Far AT %MW700 : INT;\nEND_VAR\n"
	"VAR_GLOBAL CONSTANT\n  Max : INT := 4;\nEND_VAR\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\n  Local : INT;\nEND_VAR\n"
	"RUNG\n  | P %IX0.0 | TON Delay PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n"
	"PROGRAM Other LD\nVAR\n  Local : INT;\nEND_VAR\n"
	"RUNG\n  | [ Local := 1 ] |\nEND_PROGRAM\n";
static const char lost_again[] =
	"TYPE\n  Item : STRUCT\n    Name : STRING[8];\n    Weight : INT;\n  END_STRUCT;\nEND_TYPE\n"
	"VAR_GLOBAL\n  Kept : INT;\n  Typed : DINT;\n  Many : ARRAY[0..2] OF INT;\n"
	"  List : ARRAY[3..9] OF INT;\n  Apart : ARRAY[5..6] OF INT;\n  Text : STRING[4];\n"
	"  Short : STRING[4];\n  Texts : ARRAY[2..4] OF STRING[4];\n"
	"  Lines : ARRAY[2..4] OF STRING[4];\n  Item1 : Item;\n"
	"  Down : ARRAY[2..5] OF INT;\n  Fresh : INT;\n  NewPlace AT %MW30 : INT;\nEND_VAR\n"
	"VAR_GLOBAL CONSTANT\n  Most : INT := 4;\nEND_VAR\n"
	"CONFIGURATION Small\n  AREA M 600;\nEND_CONFIGURATION\n"
	"PROGRAM Main LD\nVAR\n  Delay : TOF;\n  Local : INT;\nEND_VAR\n"
	"RUNG\n  | N %IX0.0 | TOF Delay PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n"
	"PROGRAM Later LD\nVAR\n  Local : INT;\nEND_VAR\n"
	"RUNG\n  | [ Local := 1 ] |\nEND_PROGRAM\n";
static void set_text(struct rig *rig, const char *name, const char *value)
{
	struct iec_text room;
	struct iec_string *text = iec_text_init(&room, (uint16_t)strlen(value));

	memcpy(text->text, value, strlen(value));
	image_set(&rig->resource.image, rig_at(rig, name), (union iec_value){ .s = text });
}

static void test_losses(void)
{
	static const char head[] =
		"type Typed 8\ntype Many[0..2] 7\n"
		"gone List[1..2] 7\nnew List[7..9] 7\n"
		"gone Apart[1..2] 7\nnew Apart[5..6] 7\n";
	static const char tail[] =
		"new Item1.Weight 7\ngone Down[6] 7\nnew Down[2..3] 7\nnew Fresh 7\nblock Main.Delay 0\nnew Later.Local 7\n"
		"gone Gone 7\ngone Item1.Speed 7\ngone Far 7\ngone Other.Local 7\n";
	char want[2048];
	struct change change;
	struct image now;

	plan_change(&change, lost, lost_again);
	/* Nothing is known of the values: what may be lost. */
	snprintf(want, sizeof(want), "%s%s%s", head,
		 "text Text 20\ntext Short 20\ngone Texts[1] 20\ntext Texts[2..4] 20\n"
		 "new Lines[2] 20\ntext Lines[3..4] 20\n", tail);
	CHECK_TEXT(losses(&change, NULL), want);
	set_text(&change.old, "Text", "hello");
	set_text(&change.old, "Short", "four");
	set_text(&change.old, "Texts[1]", "first");
	set_text(&change.old, "Texts[3]", "third");
	set_text(&change.old, "Lines[4]", "fourth");
	rig_force(&change.old, "Kept", 1);
	rig_force(&change.old, "Typed", 1);
	rig_force(&change.old, "%MW700", 1);
	rig_force(&change.old, "%MX650.3", 1);
	rig_force(&change.old, "%MW2", 1);
	rig_force(&change.old, "List[2]", 1);
	rig_force(&change.old, "List[3]", 1);
	rig_force(&change.old, "Main.Delay.ET", 1);
	rig_force(&change.old, "Other.Local", 1);
	snprintf(want, sizeof(want), "%s%s%s%s", head,
		 "text Text 20\ngone Texts[1] 20\ntext Texts[3] 20\n"
		 "new Lines[2] 20\ntext Lines[4] 20\n", tail,
		 "force %MW700 3\nforce %MX650.3 1\nforce Typed 7\nforce List[2] 7\n"
		 "force Other.Local 7\n");
	CHECK_TEXT(losses(&change, &change.old.resource.image), want);
	/* Only forces are known. */
	now = change.old.resource.image;
	now.memory = NULL;
	now.force_count = 1;
	snprintf(want, sizeof(want), "%s%s%s", head,
		 "text Text 20\ntext Short 20\ngone Texts[1] 20\ntext Texts[2..4] 20\n"
		 "new Lines[2] 20\ntext Lines[3..4] 20\n", tail);
	CHECK_TEXT(losses(&change, &now), want);
	/* A place without a name: the bytes between two variables. */
	now.force_count = 1;
	now.force[0].at = (struct location){ .type = IEC_BOOL,
		.where = CODE_TRUE_AT(&change.old.resource.image.program->areas) };
	CHECK(strstr(losses(&change, &now), "\nforce  1\n"));
	CHECK(misplaced == 0);
	/* What is told is what happens. */
	apply(&change);
	CHECK(change.new.resource.image.force_count == 4);
	end_change(&change);
	plan_change(&change, lost, lost);
	rig_force(&change.old, "Typed", 1);
	CHECK_TEXT(losses(&change, &change.old.resource.image), "");
	end_change(&change);
}

/* ---- cost ---- */

#define ADDS "PROGRAM Main LD\nRUNG\n  | [ A := A + 1 ] |\nEND_PROGRAM\n"

static void test_cost(void)
{
	struct carry_cost cost;
	struct change change;
	uint32_t areas;

	plan_change(&change, "VAR_GLOBAL\n  A : INT;\n  B : INT;\n  C : INT;\nEND_VAR\n" ADDS,
		    "VAR_GLOBAL\n  N : INT;\n  A : INT;\n  B : INT;\n  C : INT;\nEND_VAR\n" ADDS);
	areas = ladder_program(change.old.ladder)->areas.size;
	cost = carry_cost(change.plan);
	/* All areas, which are the same, and three neighbours: two blocks. */
	CHECK(cost.bytes == areas + 6 && cost.operations == LIMIT_FORCES + 2);
	end_change(&change);
	plan_change(&change, "VAR_GLOBAL\n  A : INT := 1;\n  B : INT := 1;\n  C : STRING[5];\n"
		    "  D AT %MX3.3 : BOOL;\nEND_VAR\n" ADDS,
		    "VAR_GLOBAL\n  A : INT := 2;\n  B : INT := 2;\n  C : STRING[9];\n"
		    "  D AT %MX3.4 : BOOL;\nEND_VAR\n" ADDS);
	cost = carry_cost(change.plan);
	/* Areas, two values, a text of 13 bytes and its padding, a bit. */
	CHECK(cost.bytes == areas + 16 && cost.operations == LIMIT_FORCES + 5);
	end_change(&change);
	/* The same code: one block. */
	plan_change(&change, "VAR_GLOBAL\n  A : INT;\nEND_VAR\n" ADDS,
		    "(* told *)\nVAR_GLOBAL\n  A : INT; (* more *)\nEND_VAR\n" ADDS);
	cost = carry_cost(change.plan);
	CHECK(cost.bytes == image_memory_size(ladder_program(change.old.ladder)) &&
	      cost.operations <= 1);
	end_change(&change);
}

/* ---- places ---- */

#define LOOPS(fast, main) \
	"CONFIGURATION All\n  TASK " fast " (INTERVAL := T#10ms, PRIORITY := 1);\n" \
	"  TASK Slow (INTERVAL := T#100ms, PRIORITY := 2);\n" \
	"  PROGRAM P1 WITH " fast " : " main ";\n  PROGRAM P2 WITH Slow : Calm;\nEND_CONFIGURATION\n" \
	"PROGRAM Calm LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.0 |\nEND_PROGRAM\n" \
	"PROGRAM " main " LD\nRUNG Again\n  | NO %IX0.0 | JMP Again |\n"

static bool is_inside(const char *text, const struct program *program)
{
	return text >= program->string && text < program->string + program->string_bytes;
}

/* A fault names POU and task of the new program, if it has them. */
static void test_places(void)
{
	const struct fault_place *at;
	struct change change;

	plan_change(&change, LOOPS("Fast", "Main") "END_PROGRAM\n",
		    "VAR_GLOBAL\n  N : INT;\nEND_VAR\n"
		    LOOPS("Fast", "Main") "RUNG\n  | [ N := N + 1 ] |\nEND_PROGRAM\n");
	rig_set(&change.old, "%IX0.0", 1);
	CHECK(!rig_scan(&change.old));
	apply(&change);
	at = &change.new.resource.fault_at;
	CHECK(change.new.resource.fault == FAULT_BUDGET);
	CHECK_TEXT(at->pou, "Main");
	CHECK_TEXT(at->task, "Fast");
	CHECK(is_inside(at->pou, ladder_program(change.new.ladder)) &&
	      is_inside(at->task, ladder_program(change.new.ladder)));
	end_change(&change);
	plan_change(&change, LOOPS("Fast", "Main") "END_PROGRAM\n",
		    LOOPS("Quick", "Else") "END_PROGRAM\n");
	rig_set(&change.old, "%IX0.0", 1);
	CHECK(!rig_scan(&change.old));
	apply(&change);
	at = &change.new.resource.fault_at;
	CHECK_TEXT(at->pou, "");
	CHECK(at->task == NULL);
	CHECK(change.new.resource.halt_at.pou == NULL);
	end_change(&change);
}

/* ---- a hostile image ---- */

/* "B0[100000..100009]" gets a million elements, which are those of A0. */
static void overlap(const struct program *program, uint8_t *bytes)
{
	uint32_t *symbol = (void *)(bytes + program->header->section[CODE_SYMBOLS].offset);
	char *name = (char *)bytes + program->header->section[CODE_STRINGS].offset;
	const size_t covered = offsetof(struct code_header, crc) + 4;
	struct code_header *header = (void *)bytes;
	uint32_t first = 0;

	for (uint32_t i = 0; i < program->symbol_count; i++, name += strlen(name) + 1) {
		if (strncmp(name, "A0[", 3) == 0)
			first = symbol[i];
		if (name[0] != 'B')
			continue;
		memcpy(name + 2, "[000000..999999]", 16);
		symbol[i] = first;
	}
	header->crc = digest_crc32c(0, bytes + covered, header->size - covered);
}

static uint8_t *open_overlap(const struct rig *rig, struct program *out, struct arena *arena)
{
	const struct program *program = ladder_program(rig->ladder);
	uint8_t *bytes = malloc(program->header->size);
	enum diag_id why;
	size_t where;

	memcpy(bytes, program->base, program->header->size);
	overlap(program, bytes);
	CHECK_AS(code_open(bytes, program->header->size, arena, out, &why, &where),
		 "arrays may overlap in an image");
	return bytes;
}

#define WIDE(n) "  A" #n " : ARRAY[0..999999] OF BOOL;\n"
#define FEW(n) "  B" #n " : ARRAY[100000..100009] OF BOOL;\n"
#define WIDE_PROGRAM(more) \
	"VAR_GLOBAL\n" WIDE(0) WIDE(1) WIDE(2) WIDE(3) WIDE(4) WIDE(5) FEW(0) FEW(1) FEW(2) \
	FEW(3) FEW(4) FEW(5) "END_VAR\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n" \
	more "END_PROGRAM\n"

/* A plan of it would take for ever. */
static void test_hostile(void)
{
	struct program to, from;
	struct change change;
	uint8_t *one, *other;

	if (getenv("EMULATED")) {
		tap_skip("twelve million values in an emulator");
		return;
	}
	plan_change(&change, WIDE_PROGRAM(""),
		    WIDE_PROGRAM("RUNG\n  | NO %IX0.1 | COIL %QX0.1 |\n"));
	CHECK(change.plan && carry_cost(change.plan).operations < 2 * LIMIT_FORCES);
	one = open_overlap(&change.new, &to, &change.arena);
	other = open_overlap(&change.old, &from, &change.arena);
	CHECK(!carry_plan_new(&to, &from, &change.arena));
	free(one);
	free(other);
	end_change(&change);
}

int main(void)
{
	test_hostile();
	test_addresses();
	test_order();
	test_sizes();
	test_same_code();
	test_again();
	test_wrong_plan();
	test_forces();
	test_all_forces();
	test_losses();
	test_cost();
	test_places();
	test_made();
	test_random();
	return tap_done();
}
