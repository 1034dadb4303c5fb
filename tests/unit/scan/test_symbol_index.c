/* SPDX-License-Identifier: MIT
 *
 * test_symbol_index - a search with an index gives the same as one without: for each
 * sample, and for a program with similar names.
 */
#include "tests/unit/rig.h"

#include "engine/scan/symbol_index.h"

#include <glob.h>

static const char alike[] =
	"VAR_ACCESS\n  Row : Main.Values : ARRAY[1..2] OF BOOL READ_WRITE;\n"
	"  Rows : Belt.Q : INT;\nEND_VAR\n"
	"VAR\n"
	"  Main2 : TON;\n  Value : INT := 1;\n  Values : ARRAY[-2..3] OF INT;\n"
	"  Q, Q1 : BOOL;\n  I0 : INT;\n  SYS : BOOL;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"VAR\n  Value : DINT := 2;\n  Values : ARRAY[1..2] OF BOOL;\n  Belt, Main : TON;\nEND_VAR\n"
	"RUNG\n  | NO Belt.Q | P Q | TON Main PT:=T#1s | COIL Q1 |\nEND_PROGRAM\n"
	"PROGRAM Belt LD\n"
	"VAR\n  Value : REAL := 3.0;\n  Q : INT;\n  Main : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO Main | COIL %QX0.0 |\nEND_PROGRAM\n";

static const char *const behind[] = {
	"", ".", ".Q", ".PT", ".CV", ".Value", ".Nothing", "[1]", "[-2]", " [ 3 ]", "[9]", "[", "x",
	" ", ".Q.Q", "%QX0.0",
};

struct pair {
	struct image indexed, linear;
	struct program plain;
	int asked, found, wrong;
};

static void ask(struct pair *pair, const char *text)
{
	const struct location a = image_find(&pair->indexed, text, strlen(text));
	const struct location b = image_find(&pair->linear, text, strlen(text));

	pair->asked++;
	pair->found += b.type != IEC_NONE;
	if (a.type == b.type && (a.type == IEC_NONE || (a.area == b.area &&
	    a.where == b.where && a.constant == b.constant)))
		return;
	if (!pair->wrong++)
		printf("# not the same: \"%s\"\n", text);
}

/* Looks up the name, in another case and shortened, with every possible text after it. */
static void ask_like(struct pair *pair, const char *name)
{
	char text[2 * LIMIT_NAME + 96];

	for (size_t i = 0; i < sizeof(behind) / sizeof(*behind); i++) {
		const int used = snprintf(text, sizeof(text), "%s%s", name, behind[i]);

		if (used <= 0 || (size_t)used >= sizeof(text))
			continue;
		ask(pair, text);
		text[0] ^= 0x20;
		ask(pair, text);
		text[used - 1] = '\0';
		ask(pair, text);
		ask(pair, text + 1);
	}
}

static void ask_all(struct pair *pair, const char *pou)
{
	for (int whole = 0; whole < 2; whole++) {
		struct symbol_cursor cursor = { .whole = whole };
		struct symbol symbol;
		char text[2 * LIMIT_NAME + 96];

		while (image_next_symbol(&pair->indexed, &cursor, &symbol)) {
			snprintf(text, sizeof(text), "%s%s%s", pou, *pou ? "." : "",
				 symbol.name);
			ask_like(pair, text);
		}
	}
}

static void compare(const struct program *program, const char *name)
{
	struct pair pair = { .indexed.program = program, .plain = *program };

	pair.plain.index = NULL;
	pair.linear.program = &pair.plain;
	CHECK(program->index);
	ask_all(&pair, "");
	for (uint32_t i = 0; i < program->entry_count; i++) {
		const char *pou = program->string + program->entry[i].name;

		ask_like(&pair, pou);
		ask_all(&pair, pou);
	}
	ask_like(&pair, "SYS_FIRST_SCAN");
	ask_like(&pair, "%IX0.0");
	ask_like(&pair, "Q0");
	ask_like(&pair, "Row");
	ask_like(&pair, "Rows");
	ask_like(&pair, "READ_WRITE Row");
	ask_like(&pair, "P Q");
	ask(&pair, "");
	CHECK_AS(pair.found > 0 && pair.found < pair.asked, name);
	CHECK_AS(pair.wrong == 0, name);
}

/* All samples; in an emulator every tenth. */
static void samples(void)
{
	const size_t step = 10 / (size_t)tap_rounds(10);
	glob_t files;

	if (!CHECK(glob("ladders/*.rung", 0, NULL, &files) == 0))
		return;
	for (size_t i = 0; i < files.gl_pathc; i += step) {
		struct ladder *ladder = ladder_new();

		if (CHECK_AS(ladder_load(ladder, files.gl_pathv[i]) && ladder_build(ladder),
			     files.gl_pathv[i]))
			compare(ladder_program(ladder), files.gl_pathv[i]);
		ladder_free(ladder);
	}
	globfree(&files);
}

static bool name_is_known(const struct rig *rig, const char *name)
{
	const struct image image = { .program = ladder_program(rig->ladder) };

	return image_find(&image, name, strlen(name)).type != IEC_NONE;
}

int main(void)
{
	struct rig rig;

	if (rig_open(&rig, alike, false)) {
		CHECK(rig_get(&rig, "value") == 1 && rig_get(&rig, "MAIN.VALUE") == 2);
		CHECK(rig_real(&rig, "Belt.Value") == 3.0);
		CHECK(rig_get(&rig, "Row[2]") == 0 && rig_get(&rig, "rows") == 0);
		CHECK_AS(!name_is_known(&rig, "READ_WRITE Row[2]") && !name_is_known(&rig, "P Q"),
			 "nobody can name the memory of an edge");
		compare(ladder_program(rig.ladder), "each of the similar names is found");
	}
	rig_close(&rig);
	samples();
	return tap_done();
}
