/* SPDX-License-Identifier: MIT
 *
 * test_names - each string has one id, and all spellings of a name fold to one id.
 */
#include "engine/base/names.h"
#include "tests/tap.h"

static void one_id_a_string(struct names *names)
{
	uint32_t motor = names_intern(names, "Motor", 5);

	CHECK(names_intern(names, "", 0) == 0);
	CHECK(motor != 0);
	CHECK(names_intern(names, "Motor and more", 5) == motor);
	CHECK(names_find(names, "Motor", 5) == motor);
	CHECK(names_find(names, "Moto", 4) == 0);
	CHECK(names_find(names, "", 0) == 0);
	CHECK_TEXT(names_text(names, motor), "Motor");
	CHECK_TEXT(names_text(names, 0), "");
	CHECK_TEXT(names_text(names, 4000000000u), "");
	CHECK(names_len(names, motor) == 5);
	CHECK(names_len(names, 0) == 0);
	CHECK(names_len(names, 4000000000u) == 0);
}

static void any_bytes(struct names *names)
{
	uint32_t a = names_intern(names, "a\0b", 3);
	uint32_t b = names_intern(names, "a\0c", 3);

	CHECK(a && b && a != b);
	CHECK(names_len(names, a) == 3);
	CHECK(memcmp(names_text(names, b), "a\0c", 4) == 0);
	CHECK(names_intern(names, "\xff\xfe", 2) != 0);
}

static void folds(struct names *names)
{
	uint32_t lower = names_intern(names, "pump", 4);
	uint32_t mixed = names_intern(names, "Pump", 4);
	uint32_t upper = names_intern(names, "PUMP", 4);
	uint32_t other = names_intern(names, "Pumps", 5);
	uint32_t fold = names_fold(names, mixed);

	CHECK(lower != mixed && mixed != upper);
	CHECK_AS(fold == lower, "the folded name is the first spelling");
	CHECK(names_fold(names, lower) == fold);
	CHECK(names_fold(names, upper) == fold);
	CHECK(names_fold(names, fold) == fold);
	CHECK(names_fold(names, mixed) == fold);
	CHECK(names_fold(names, other) != fold);
	CHECK(names_find_any(names, "PUMP", 4) == fold && names_find_any(names, "pump", 4) == fold);
	CHECK_AS(names_find_any(names, "pUMp", 4) == fold && names_find(names, "pUMp", 4) == 0,
		 "a new spelling finds the name but is not stored");
	CHECK(names_find_any(names, "pUM", 3) == 0 && names_find_any(names, "", 0) == 0);
	CHECK(names_fold(names, 0) == 0);
	CHECK(names_fold(names, 4000000000u) == 0);
	CHECK_AS(names_fold(names, names_intern(names, "a@", 2)) !=
		 names_fold(names, names_intern(names, "a`", 2)),
		 "only letters have a case");
	CHECK_AS(names_fold(names, names_intern(names, "\u00e4", 2)) ==
		 names_fold(names, names_intern(names, "\u00c4", 2)) &&
		 names_find_any(names, "A\u0308", 3) == names_find(names, "\u00e4", 2),
		 "spellings of different lengths are the same name");
}

static void grows(void)
{
	struct arena arena;
	struct names names;
	static uint32_t id[20000];
	bool good = true;
	uint32_t other;
	char text[32];

	arena_init(&arena);
	names_init(&names, &arena);
	for (int i = 0; i < 20000; i++) {
		int len = snprintf(text, sizeof(text), "Valve_%d", i);

		id[i] = names_intern(&names, text, (size_t)len);
		good &= id[i] == (uint32_t)i + 1;
	}
	CHECK_AS(good, "new names get the next ids");
	for (int i = 0; i < 20000; i++) {
		int len = snprintf(text, sizeof(text), "Valve_%d", i);

		good &= names_find(&names, text, (size_t)len) == id[i] &&
			strcmp(names_text(&names, id[i]), text) == 0;
		good &= names_fold(&names, id[i]) == id[i];
		snprintf(text, sizeof(text), "VALVE_%d", i);
		other = names_intern(&names, text, (size_t)len);
		good &= other != id[i] && names_fold(&names, other) == id[i];
	}
	CHECK_AS(good, "each name is found, and its capitals fold to it");
	CHECK(names.count == 40001);
	arena_free(&arena);
}

static void out_of_memory(void)
{
	struct arena arena;
	struct names names;
	uint32_t known;

	arena_init(&arena);
	names_init(&names, &arena);
	known = names_intern(&names, "known", 5);
	arena.failed = true;
	CHECK(names_intern(&names, "new", 3) == 0);
	CHECK(names_intern(&names, "known", 5) == known);
	CHECK_AS(names_fold(&names, known) == known, "names_fold() works without memory");
	arena_free(&arena);
	arena.failed = true;
	names_init(&names, &arena);
	CHECK(names_intern(&names, "x", 1) == 0);
	CHECK(names_find(&names, "x", 1) == 0);
	CHECK_TEXT(names_text(&names, 0), "");
	CHECK(names_fold(&names, 1) == 0);
}

int main(void)
{
	struct arena arena;
	struct names names;

	arena_init(&arena);
	names_init(&names, &arena);
	one_id_a_string(&names);
	any_bytes(&names);
	folds(&names);
	arena_free(&arena);
	grows();
	out_of_memory();
	return tap_done();
}
