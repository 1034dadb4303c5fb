/* SPDX-License-Identifier: MIT
 *
 * members - arrays as members, against the same arrays alone.
 *
 * Random programs are rewritten with their arrays inside a structure, inside elements
 * of an array of structures, and with a structure for each element. All must do the
 * same, scan by scan. The differential test checks arrays alone.
 */
#include "engine/ladder.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include <stdlib.h>

#define COUNT    400
#define SCANS    25
#define TEXT_MAX (192u * 1024)
#define PERIOD   INT64_C(10000000)

/* How an array is written: its prefix, and the text behind its index. */
struct form {
	const char *name, *before, *after;
	bool each; /* a structure for each element: no initial values        */
};

static const struct form forms[] = {
	{ "in a structure", "Whole.", "", false },
	{ "in an array of structures", "Row[4].", "", false },
	{ "two structures deep", "Deep.In[-1].", "", false },
	{ "of structures", "", ".V", true },
};
#define FORMS (sizeof(forms) / sizeof(*forms))

static const char *const moved[] = { "arr_b", "arr_i", "arr_s", "arr_t", "arr_r" };
#define MOVED (sizeof(moved) / sizeof(*moved))

struct page {
	char text[TEXT_MAX];
	size_t len;
};

static void add(struct page *page, const char *text, size_t len)
{
	if (len >= TEXT_MAX - page->len)
		abort();
	memcpy(page->text + page->len, text, len);
	page->len += len;
	page->text[page->len] = '\0';
}

static void add_text(struct page *page, const char *text)
{
	add(page, text, strlen(text));
}

/* Whether one of the arrays is here as a name of its own. */
static const char *moved_at(const char *start, const char *at)
{
	if (at > start && (at[-1] == '_' || (at[-1] >= 'a' && at[-1] <= 'z')))
		return NULL;
	for (size_t i = 0; i < MOVED; i++)
		if (strncmp(at, moved[i], strlen(moved[i])) == 0)
			return moved[i];
	return NULL;
}

/* The end of the index that begins at @at, behind its ]. */
static const char *closing(const char *at)
{
	int depth = 0;

	for (; *at; at++) {
		depth += (*at == '[') - (*at == ']');
		if (depth == 0)
			return at + 1;
	}
	abort();
}

/* Operands of a body, also inside indices of others. */
static void add_body(struct page *page, const char *text, size_t len,
		     const struct form *form)
{
	const char *due[16], *end = text + len; /* where an index ends */
	int open = 0;

	for (const char *at = text; at < end; at++) {
		while (open && due[open - 1] == at) {
			add_text(page, form->after);
			open--;
		}
		if (moved_at(text, at)) {
			add_text(page, form->before);
			if (open < 16)
				due[open++] = closing(strchr(at, '['));
		}
		add(page, at, 1);
	}
}

/* `arr_b : ARRAY[0..4] OF BOOL := [TRUE];` as a member, or with another type. */
static void add_declaration(struct page *page, const char *at, const char *end,
			    const struct form *form, bool init)
{
	const char *stop = memchr(at, '\n', (size_t)(end - at));
	const char *of = strstr(at, " OF "), *value = strstr(at, " :=");
	size_t type = 0;

	if (!value || value > stop)
		value = strchr(at, ';');
	type = (size_t)(value - of) - 4;
	add(page, at, (size_t)(of + 4 - at));
	add_text(page, form && form->each ? "Cell_" : "");
	add(page, of + 4, type);
	if (init)
		add(page, value, (size_t)(stop - value));
	else
		add_text(page, ";");
	add_text(page, "\n");
}

static void add_types(struct page *page, const char *text, const char *body,
		      const struct form *form)
{
	static const char *const type[] = { "BOOL", "INT", "SINT", "TIME", "REAL" };
	char line[120];

	add_text(page, "TYPE\n");
	for (size_t i = 0; form->each && i < sizeof(type) / sizeof(*type); i++) {
		snprintf(line, sizeof(line), "  Cell_%s : STRUCT\n    A : SINT;\n"
			 "    V : %s;\n    Z : LINT;\n  END_STRUCT;\n",
			 type[i], type[i]);
		add_text(page, line);
	}
	if (!form->each) {
		add_text(page, "  All : STRUCT\n  First : BOOL;\n");
		for (const char *at = text; at < body; at++)
			if (moved_at(text, at))
				add_declaration(page, at, body, NULL, true);
		add_text(page, "  END_STRUCT;\n  Outer : STRUCT\n"
			 "    In : ARRAY[-2..0] OF All;\n  END_STRUCT;\n");
	}
	add_text(page, "END_TYPE\n");
	if (!form->each)
		add_text(page, "VAR_GLOBAL\n  Whole : All;\n  Deep : Outer;\n"
			 "  Row : ARRAY[3..5] OF All;\nEND_VAR\n");
}

/* The program @text again; @form NULL: as it is, without initial values of arrays if
 * @each. */
static void write_form(struct page *page, const char *text, const struct form *form,
		       bool each)
{
	const char *first = strchr(text, '\n') + 1;
	const char *body = strstr(text, "PROGRAM Main");
	const char *at = first;

	page->len = 0;
	add(page, text, (size_t)(first - text));
	if (form)
		add_types(page, text, body, form);
	while (at < body) {
		const char *stop = strchr(at, '\n') + 1;
		const char *name = at + strspn(at, " ");
		bool array = moved_at(text, name);

		if (array && (!form || form->each)) {
			add_text(page, "  ");
			add_declaration(page, name, body, form, !each);
		} else if (!array) {
			add(page, at, (size_t)(stop - at));
		}
		at = stop;
	}
	if (form)
		add_body(page, body, strlen(body), form);
	else
		add_text(page, body);
}

/* ---- running ---- */

struct side {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
};

static bool start(struct side *side, const struct page *page)
{
	side->ladder = ladder_new();
	side->memory = NULL;
	if (!side->ladder)
		abort();
	if (!ladder_load_text(side->ladder, "members.rung", page->text, page->len) ||
	    !ladder_build(side->ladder))
		return false;
	side->memory = calloc(1, image_memory_size(ladder_program(side->ladder)));
	if (!side->memory)
		abort();
	resource_init(&side->resource, ladder_program(side->ladder), side->memory);
	resource_start(&side->resource);
	return true;
}

static void stop(struct side *side)
{
	free(side->memory);
	ladder_free(side->ladder);
}

/* The variable of the second side for one of the first. */
static struct location other(const struct side *side, const char *name,
			     const struct form *form)
{
	const char *bracket = strchr(name, '[');
	char text[400];

	if (moved_at(name, name) && bracket)
		snprintf(text, sizeof(text), "%s%.150s%s", form->before, name,
			 form->after);
	else
		snprintf(text, sizeof(text), "%.300s", name);
	return image_find(&side->resource.image, text, strlen(text));
}

/* One variable on both sides. */
struct both {
	struct location at[2];
	char name[64];
};

static struct both both[1024];
static int both_count;

static bool find_both(const struct side side[2], const struct form *form)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	both_count = 0;
	while (image_next_symbol(&side[0].resource.image, &cursor, &symbol)) {
		struct both *out = &both[both_count];

		if (symbol.flags & (SYMBOL_HIDDEN | SYMBOL_SHARED) ||
		    *symbol.name == '_' || both_count == 1024)
			continue;
		out->at[0] = symbol.at;
		out->at[1] = other(&side[1], symbol.name, form);
		snprintf(out->name, sizeof(out->name), "%.60s", symbol.name);
		if (out->at[1].type != symbol.at.type) {
			printf("# %s is not there\n", symbol.name);
			return false;
		}
		both_count++;
	}
	return true;
}

static bool equal(enum iec_type type, union iec_value a, union iec_value b)
{
	if (type != IEC_STRING)
		return a.i == b.i;
	return a.s->length == b.s->length &&
	       memcmp(a.s->text, b.s->text, a.s->length) == 0;
}

static bool same(const struct side side[2])
{
	for (int i = 0; i < both_count; i++)
		if (!equal(both[i].at[0].type,
			   image_get(&side[0].resource.image, both[i].at[0]),
			   image_get(&side[1].resource.image, both[i].at[1]))) {
			printf("# %s differs\n", both[i].name);
			return false;
		}
	return true;
}

static bool run(struct side side[2], const struct form *form, uint64_t seed)
{
	struct random_source source;

	if (!find_both(side, form))
		return false;
	random_seed(&source, seed);
	for (int i = 1; i <= SCANS; i++) {
		for (uint32_t byte = 0; byte < 8; byte++) {
			uint8_t value = (uint8_t)random_next(&source);

			for (int k = 0; k < 2; k++)
				image_area(&side[k].resource.image, AREA_I)[byte] =
					value;
		}
		for (int k = 0; k < 2; k++)
			resource_scan(&side[k].resource, i * PERIOD);
		if (!same(side))
			return false;
		for (int area = AREA_I; area < AREA_COUNT; area++)
			if (memcmp(image_area(&side[0].resource.image,
					      (enum iec_area)area),
				   image_area(&side[1].resource.image,
					      (enum iec_area)area),
				   side[0].resource.image.program->areas.bytes[area]))
				return false;
	}
	return true;
}

static bool agree(const char *text, const struct form *form, uint64_t seed, int *built)
{
	static struct page page[2];
	struct side side[2];
	bool good[2], same_way;

	write_form(&page[0], text, NULL, form->each);
	write_form(&page[1], text, form, form->each);
	for (int k = 0; k < 2; k++)
		good[k] = start(&side[k], &page[k]);
	same_way = good[0] == good[1] &&
		   (!good[0] || run(side, form, seed));
	*built += good[0] && good[1];
	if (!same_way)
		printf("# seed %llu, %s:\n%s\n", (unsigned long long)seed, form->name,
		       page[1].text);
	for (int k = 0; k < 2; k++)
		stop(&side[k]);
	return same_way;
}

int main(void)
{
	static struct random_program program;
	static char text[TEXT_MAX / 2];
	int built = 0, arrays = 0;

	for (uint64_t seed = 1; seed <= COUNT; seed++) {
		bool good = true;

		random_make(&program, seed);
		random_print(&program, text, sizeof(text));
		arrays += strstr(text, "[i") || strstr(text, "[int");
		for (size_t i = 0; i < FORMS && good; i++)
			good = agree(text, &forms[i], seed, &built);
		if (!good) {
			CHECK_AS(false,
				 "an array as a member gives the same results as a plain array");
			return tap_done();
		}
	}
	printf("# %d programs built, %d of %d with an index found out\n", built, arrays,
	       COUNT);
	CHECK_AS(built > 2 * COUNT && arrays > COUNT / 10, "most programs build");
	CHECK_AS(true, "an array as a member gives the same results as a plain array");
	return tap_done();
}
