/* SPDX-License-Identifier: MIT
 *
 * carry_random - random programs whose declarations differ: types, initial values, bounds,
 * addresses, order, blocks, tasks; and random values in them.
 *
 * Two programs of different seeds have most names in common and most of their types.
 * One seed gives the same program on every machine: no two draws are arguments of one call,
 * since compilers evaluate those in different orders.
 */
#ifndef TESTS_CARRY_RANDOM_H
#define TESTS_CARRY_RANDOM_H

#include "tests/unit/rig.h"
#include "tests/walker/random.h"

#include <stdarg.h>

struct made {
	struct random_source source;
	const char *block;      /* of the instance that is always there       */
	size_t used;
	char text[64 * 1024];
};

__attribute__((format(printf, 2, 3)))
static inline void make_line(struct made *made, const char *format, ...)
{
	va_list list;

	va_start(list, format);
	made->used += (size_t)vsnprintf(made->text + made->used,
					sizeof(made->text) - made->used, format, list);
	va_end(list);
	if (made->used >= sizeof(made->text))
		abort();
}

static inline uint32_t make_below(struct made *made, uint32_t n)
{
	return random_below(&made->source, n);
}

static inline bool make_chance(struct made *made, uint32_t percent)
{
	return random_chance(&made->source, percent);
}

/* Initial values are few, so that both programs often have the same one. */
static const struct make_type {
	const char *word, *begin[3], *address;
} make_types[] = {
	{ "BOOL", { "TRUE", "FALSE", "TRUE" }, "X" },
	{ "SINT", { "1", "-2", "0" }, "B" }, { "INT", { "1", "-2", "300" }, "W" },
	{ "DINT", { "1", "-2", "70000" }, "D" }, { "LINT", { "1", "-2", "3" }, NULL },
	{ "USINT", { "1", "2", "0" }, "B" }, { "UINT", { "1", "2", "0" }, "W" },
	{ "UDINT", { "1", "2", "0" }, "D" }, { "ULINT", { "1", "2", "0" }, NULL },
	{ "BYTE", { "16#12", "1", "0" }, "B" }, { "WORD", { "16#1234", "1", "0" }, "W" },
	{ "DWORD", { "16#12345678", "1", "0" }, "D" }, { "LWORD", { "1", "2", "0" }, "L" },
	{ "REAL", { "1.5", "-2.0", "0.0" }, NULL }, { "LREAL", { "1.5", "0.1", "0.0" }, NULL },
	{ "TIME", { "T#1s", "T#2s", "T#0s" }, NULL },
	{ "DATE", { "D#2026-01-02", "D#1970-01-01", "D#2000-01-01" }, NULL },
};
#define MAKE_TYPES (sizeof(make_types) / sizeof(*make_types))
static const char *const make_texts[] = { "", "ab", "abc" };
static const char *const make_blocks[] = { "TON", "TOF", "CTU", "FIFO", "R_TRIG", "Own" };

/* One of @n; for the same @name mostly the same. */
static inline uint32_t make_stable(struct made *made, int name, uint32_t n)
{
	return make_chance(made, 80) ? (uint32_t)name * 7919u / 13u % n : make_below(made, n);
}

/* Returns whether it may have an initial value. */
static inline bool make_address(struct made *made, const struct make_type *type)
{
	const uint32_t byte = make_below(made, 40);
	const bool input = make_chance(made, 10);

	if (!type->address || make_chance(made, 60))
		return true;
	if (*type->address == 'X') {
		const char area = input ? 'I' : "MMQ"[make_below(made, 3)];

		make_line(made, " AT %%%cX%u.%u", area, (unsigned)byte,
			  (unsigned)make_below(made, 8));
	} else {
		make_line(made, " AT %%%c%s%u", input ? 'I' : 'M', type->address,
			  (unsigned)byte / 8 * 8);
	}
	return !input;
}

static inline void make_elementary(struct made *made, const char *name, int number,
				   bool address)
{
	const struct make_type *type = &make_types[make_stable(made, number, MAKE_TYPES)];
	bool begins;

	make_line(made, "  %s", name);
	begins = !address || make_address(made, type);
	make_line(made, " : %s", type->word);
	if (begins && make_chance(made, 60))
		make_line(made, " := %s", type->begin[make_below(made, 3)]);
	make_line(made, ";\n");
}

static inline void make_array(struct made *made, const char *name, int number)
{
	const struct make_type *type = &make_types[make_stable(made, number, MAKE_TYPES)];
	const int low = (int)make_below(made, 7) - 3, more = (int)make_below(made, 12);
	bool begins;

	make_line(made, "  %s", name);
	begins = make_address(made, type);
	make_line(made, " : ARRAY[%d..%d] OF %s", low, low + more, type->word);
	if (begins && make_chance(made, 50)) {
		const uint32_t count = 1 + make_below(made, 1u + (uint32_t)more);

		make_line(made, " := [%u(%s)]", (unsigned)count, type->begin[make_below(made, 3)]);
	}
	make_line(made, ";\n");
}

static inline void make_text(struct made *made, const char *name, bool array)
{
	const int low = (int)make_below(made, 4);
	const char *text = make_texts[make_below(made, 3)];

	make_line(made, "  %s : ", name);
	if (array)
		make_line(made, "ARRAY[%d..%d] OF ", low, low + (int)make_below(made, 5));
	make_line(made, "STRING[%u]", 3 + (unsigned)make_below(made, 9));
	if (*text)
		make_line(made, array ? " := ['%s']" : " := '%s'", text);
	make_line(made, ";\n");
}

static inline void make_variable(struct made *made, const char *name, int number)
{
	const int low = (int)make_below(made, 3);
	int high;

	switch (make_stable(made, number, 10)) {
	case 0: case 1: case 2: case 3: make_elementary(made, name, number, true); return;
	case 4: case 5: make_array(made, name, number); return;
	case 6: make_text(made, name, make_chance(made, 30)); return;
	case 7:
		make_line(made, "  %s : Item;\n", name);
		return;
	case 8:
		high = low + (int)make_below(made, 3);
		make_line(made, "  %s : ARRAY[%d..%d] OF %s;\n", name, low, high,
			  make_chance(made, 50) ? "Item" : "TON");
		return;
	default:
		make_line(made, "  %s : %s;\n", name, make_blocks[make_stable(made, number, 6)]);
		return;
	}
}

/* Some of @count names, in any order. */
static inline void make_variables(struct made *made, const char *letter, int count)
{
	const int step = (int)make_below(made, 2) * 2 - 1 + count;
	int at = (int)make_below(made, (uint32_t)count);
	char name[16];

	for (int i = 0; i < count; i++, at = (at + step) % count) {
		snprintf(name, sizeof(name), "%s%d", letter, at);
		if (make_chance(made, 75))
			make_variable(made, name, at);
	}
}

/* BOOLs that rungs may use, and perhaps an address or an initial value of them. */
static inline void make_bools(struct made *made, const char *letter, int count)
{
	const uint32_t first = make_below(made, (uint32_t)count);
	char name[16];

	for (int i = 0; i < count; i++) {
		snprintf(name, sizeof(name), "%s%u", letter,
			 (unsigned)(first + (uint32_t)i) % (unsigned)count);
		make_line(made, "  %s", name);
		if (make_chance(made, 20)) {
			const uint32_t bit = make_below(made, 24);

			make_line(made, " AT %%IX%u.%u", (unsigned)bit / 8, (unsigned)bit % 8);
		} else {
			make_address(made, &make_types[0]);
		}
		make_line(made, " : BOOL;\n");
	}
}

static inline void make_bit(struct made *made, char *out, size_t size, bool local)
{
	static const char *const other[] = { "t0.Q", "o0.Go", "%MX7.7", "%QX2.2", "%IX1.1" };
	const uint32_t what = make_below(made, 10);

	if (what < 2)
		snprintf(out, size, "%s", other[make_below(made, local ? 5 : 3)]);
	else if (what < 6 && local)
		snprintf(out, size, "c%u", (unsigned)make_below(made, 3));
	else
		snprintf(out, size, "b%u", (unsigned)make_below(made, 6));
}

static inline void make_rung(struct made *made, bool local)
{
	char a[16], b[16];
	uint32_t byte;

	make_bit(made, a, sizeof(a), local);
	make_bit(made, b, sizeof(b), local);
	make_line(made, "RUNG\n");
	switch (make_below(made, local ? 6 : 4)) {
	case 0: make_line(made, "  | P %s | N %s | COIL %%QX%u.1 |\n", a, b,
			  (unsigned)make_below(made, 3)); return;
	case 1: make_line(made, "  | NO %s | COILP %%MX%u.3 |\n", a,
			  (unsigned)make_below(made, 3)); return;
	case 2: make_line(made, "  | N %s | COILN %%MX%u.4 |\n", a,
			  (unsigned)make_below(made, 3)); return;
	case 3:
		byte = make_below(made, 40);
		make_line(made, "  | P %s | NO %%MX%u.5 | COIL %%MX%u.6 |\n", a, (unsigned)byte,
			  (unsigned)make_below(made, 40));
		return;
	case 4: make_line(made, "  | P %s | Own o0 |\n", a); return;
	default: make_line(made, "  | NO %s | %s t0 PT:=T#%us |\n", a, made->block,
			   1 + (unsigned)make_below(made, 2)); return;
	}
}

static inline void make_program(struct made *made, const char *name)
{
	make_line(made, "PROGRAM %s LD\nVAR\n", name);
	make_bools(made, "c", 3);
	make_line(made, "  o0 : Own;\n  t0 : %s;\n", made->block);
	make_variables(made, "l", 8);
	make_line(made, "END_VAR\n");
	for (uint32_t i = 3 + make_below(made, 6); i; i--)
		make_rung(made, true);
	make_line(made, "END_PROGRAM\n");
}

static inline void make_own(struct made *made)
{
	make_line(made, "FUNCTION_BLOCK Own LD\nVAR_INPUT\n  Go : BOOL;\nEND_VAR\nVAR\n");
	make_elementary(made, "Total", 3, false);
	make_line(made, "  Delay : TON;\nEND_VAR\nRUNG\n  | P Go | N %s | COIL %%MX1.0 |\n",
		  make_chance(made, 50) ? "b1" : "Delay.Q");
	make_line(made, "RUNG\n  | NO Go | TON Delay PT:=T#%us | COILP %%MX1.1 |\n"
		  "END_FUNCTION_BLOCK\n", 1 + (unsigned)make_below(made, 2));
}

static inline void make_config(struct made *made)
{
	static const unsigned interval[] = { 10, 20, 50 };
	const char *event = make_chance(made, 50) ? "Event" : "Late";
	const char *when;
	uint32_t fast;

	make_line(made, "CONFIGURATION Plant\n  AREA M %u;\n",
		  152 + 8 * (unsigned)make_below(made, 3));
	make_line(made, "  AREA I %u;\n", 152 + (unsigned)make_below(made, 9));
	make_line(made, "  AREA XQ %u;\n", (unsigned)make_below(made, 3) * 3);
	if (make_chance(made, 60)) {
		fast = make_below(made, 3);
		when = make_chance(made, 60) ? "SINGLE := b0" : "INTERVAL := T#70ms";
		make_line(made, "  TASK Fast (INTERVAL := T#%ums, PRIORITY := 1);\n"
			  "  TASK %s (%s, PRIORITY := 3);\n"
			  "  PROGRAM P1 WITH Fast : Main;\n"
			  "  PROGRAM P2 WITH %s : Other;\n",
			  interval[fast], event, when, event);
	}
	make_line(made, "END_CONFIGURATION\n");
}

static inline void make_item(struct made *made)
{
	make_line(made, "TYPE\n  Item : STRUCT\n");
	for (uint32_t i = 0; i < 2; i++)
		make_elementary(made, i ? "On" : "Speed", (int)i, false);
	make_text(made, "Name", false);
	make_line(made, "    List : ARRAY[0..%u] OF INT;\n  END_STRUCT;\nEND_TYPE\n",
		  1 + (unsigned)make_below(made, 3));
}

/* The whole text, without its first line. */
static inline const char *make_text_of(struct made *made, uint64_t seed)
{
	made->used = 0;
	random_seed(&made->source, seed);
	made->block = make_chance(made, 80) ? "TON" : "TOF";
	make_item(made);
	make_line(made, "VAR_GLOBAL\n");
	make_bools(made, "b", 6);
	make_variables(made, "g", 30);
	make_line(made, "END_VAR\nVAR_GLOBAL RETAIN\n");
	make_variables(made, "r", 5);
	make_line(made, "END_VAR\nVAR_GLOBAL CONSTANT\n  k0 : INT := %u;\nEND_VAR\n",
		  (unsigned)make_below(made, 3));
	make_config(made);
	make_own(made);
	make_program(made, "Main");
	make_program(made, "Other");
	return made->text;
}

/* ---- values ---- */

static inline void stir_text(struct random_source *source, struct image *image,
			     struct location at)
{
	const uint16_t room = image_get(image, at).s->capacity;
	struct iec_text memory;
	struct iec_string *text = iec_text_init(&memory,
						(uint16_t)random_below(source, room + 1u));

	for (int i = 0; i < text->length; i++)
		text->text[i] = (char)('a' + random_below(source, 26));
	image_set(image, at, (union iec_value){ .s = text });
}

static inline void stir_value(struct random_source *source, struct image *image,
			      struct location at)
{
	const uint64_t upper = random_next(source);
	union iec_value value = { .i = (int64_t)(upper << 32 | random_next(source)) };

	if (random_chance(source, 40))
		return;
	if (at.type == IEC_STRING) {
		stir_text(source, image, at);
		return;
	}
	if (at.type == IEC_REAL || at.type == IEC_LREAL)
		value.r = (double)(int32_t)random_next(source) / 8;
	if (at.type == IEC_BOOL)
		value.i &= 1;
	image_set(image, at, value);
}

static inline void stir_instance(struct random_source *source, struct image *image,
				 uint32_t at)
{
	const struct word_row *row = word_row(code_instance(image->program, at));

	for (uint32_t i = 0; i < row->size; i++)
		if (random_chance(source, 60))
			image->memory[at + i] = (uint8_t)random_next(source);
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].type == IEC_BOOL)
			image->memory[at + row->pin[i].offset] &= 1;
}

/* Packed bits and their bytes may differ, as those of inputs do between two scans. */
static inline void stir_areas(struct random_source *source, struct image *image)
{
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->areas.size; i++)
		image->memory[i] = (uint8_t)random_next(source);
	for (uint32_t i = 0; i < program->bits_count; i++)
		for (uint32_t k = 0; k < program->bits[i].count; k++)
			image->memory[program->bits[i].slot + k] =
				random_next(source) >> 9 & 1;
}

static inline void stir_forces(struct random_source *source, struct image *image, int percent)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;

	while (image_next_symbol(image, &cursor, &symbol))
		if (random_chance(source, (uint32_t)percent))
			image_force(image, image_find(image, symbol.name, strlen(symbol.name)),
				    (union iec_value){ .i = random_next(source) & 0xff });
	for (int i = 0; i < 6; i++) {
		const uint32_t bytes = image->program->areas.bytes[AREA_M];
		struct location at = { .type = i & 1 ? IEC_BOOL : IEC_DWORD };

		at.area = i & 1 ? AREA_M : AREA_NONE;
		at.where = random_below(source, i & 1 ? 8 * bytes : bytes - 3);
		at.where += i & 1 ? 0 : image->program->areas.at[AREA_M];
		image_force(image, at, (union iec_value){ .i = random_next(source) });
	}
}

static inline void stir(struct random_source *source, struct resource *resource)
{
	struct image *image = &resource->image;
	struct declared_cursor cursor = { .memories = true };
	struct declared_name name;

	stir_areas(source, image);
	while (image_next_declared(image->program, &cursor, &name)) {
		if (name.at.type == IEC_NONE)
			stir_instance(source, image, name.at.where);
		else
			for (uint32_t i = 0; i < (name.array.count ? name.array.count : 1); i++)
				stir_value(source, image, declared_element(&name, i));
	}
	stir_forces(source, image, 4);
	resource->scans = random_next(source);
	resource->vm.now_ns = (int64_t)random_next(source) << 8;
	resource->vm.errors = random_next(source);
	resource->timers_ns = random_next(source);
	for (uint32_t i = 0; i < image->program->task_count; i++) {
		struct task_state *state = &resource->tasks.state[i];

		state->next_ns = random_next(source);
		state->runs = random_next(source);
		state->overruns = random_next(source);
		state->due = random_next(source) & 1;
	}
}
#endif
