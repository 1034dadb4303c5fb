/* SPDX-License-Identifier: MIT
 *
 * test_results - the current result after each line of a list, as a watched scan keeps it.
 */
#include "engine/base/literal.h"
#include "tests/unit/rig.h"

static struct rig rig;

static const char source[] =
	"VAR\n  Bits : Latch;\n  Row : ARRAY[1..2] OF Latch;\n  N : INT := 7;\n"
	"  R : REAL := 1.5;\n  Far : BOOL;\n  Name : STRING := 'abc';\n  Down : TON;\n"
	"END_VAR\n"
	"PROGRAM Main IL\n"                /* line 11 of the file               */
	"  LD    I0\n"
	"  ANDN  I1\n"
	"  ST    Q0\n"
	"  JMPC  Skip\n"
	"  LD    N\n"                      /* 16                                */
	"  ADD   1\n"
	"  ST    N\n"
	"Skip:\n"
	"Here: LD R\n"                     /* 20                                */
	"  GT    1.0\n"
	"  AND(  I0\n"
	"  OR    I1\n"
	"  )\n"                            /* 24                                */
	"  (* nothing here *)\n"
	"  LD    5\n"
	"  LD    Name\n"
	"  CAL   Down(IN := I0, PT := T#1s)\n"
	"  CAL   Bits(On := I0)\n"         /* 29                                */
	"  CAL   Row[2](On := I1)\n"
	"END_PROGRAM\n"
	"FUNCTION_BLOCK Latch IL\n"
	"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR\n  Count : DINT;\n  Deep : Inner;\nEND_VAR\n"
	"  LD    On\n"                     /* 40                                */
	"  JMPCN Off\n"
	"  LD    Count\n"
	"  ADD   1\n"
	"  ST    Count\n"
	"Off:\n"
	"  CAL   Deep(On := On)\n"
	"END_FUNCTION_BLOCK\n"
	"FUNCTION_BLOCK Inner IL\n"
	"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR\n  Sum : LREAL;\nEND_VAR\n"
	"  LD    Sum\n"                    /* 55                                */
	"  ADD   0.5\n"
	"  ST    Sum\n"
	"  LD    On\n"
	"END_FUNCTION_BLOCK\n";

/* Where @instance keeps the byte that the block's last run has at @offset; NULL: Main. */
static uint32_t place(uint32_t pou, const char *instance, uint32_t offset)
{
	const struct program *program = rig.resource.image.program;

	for (uint32_t i = 0; instance && i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		if (watched->pou == pou &&
		    strcmp(program->string + watched->name, instance) == 0)
			return watched->to + (offset - watched->from);
	}
	return offset;
}

/* As a literal; "-": not run; "": run, no value; "?": no instruction. */
static const char *result(uint32_t pou, const char *instance, uint32_t line)
{
	static char text[64];
	const uint8_t *memory = rig.resource.image.memory;
	const struct code_power *at = code_result(rig.resource.image.program, pou, line);
	union iec_value value;

	if (!at)
		return "?";
	if (!memory[place(pou, instance, at->in)])
		return "-";
	if (!at->type)
		return "";
	value = iec_load(memory + place(pou, instance, at->out), (enum iec_type)at->type);
	literal_print((enum iec_type)at->type, value, text, sizeof(text));
	return text;
}

#define RESULT(line, text) CHECK_TEXT(result(0, NULL, line), text)

static void lines_have_their_results(void)
{
	CHECK(rig_open(&rig, source, true));
	RESULT(12, "-");
	CHECK(rig_scan(&rig));
	RESULT(12, "FALSE");
	RESULT(14, "FALSE");
	RESULT(15, "FALSE");
	RESULT(16, "7");
	RESULT(17, "8");
	RESULT(18, "8");
	RESULT(19, "");
	RESULT(20, "1.5");
	RESULT(21, "TRUE");
	RESULT(22, "FALSE");
	RESULT(24, "FALSE");
	RESULT(25, "?");
	RESULT(26, "5");
	RESULT(27, "'abc'");
	RESULT(28, "");
	RESULT(11, "?");
	RESULT(31, "?");
}

static void skipped_lines_have_not_run(void)
{
	CHECK(rig_set(&rig, "I0", 1) && rig_scan(&rig));
	RESULT(12, "TRUE");
	RESULT(13, "TRUE");
	RESULT(15, "TRUE");
	RESULT(16, "-");
	RESULT(18, "-");
	RESULT(19, "");
	RESULT(24, "TRUE");
	CHECK(rig_get(&rig, "N") == 8);
	CHECK(rig_set(&rig, "I1", 1) && rig_scan(&rig));
	RESULT(13, "FALSE");
	RESULT(17, "9");
	RESULT(23, "TRUE");
}

static void instances_have_their_own(void)
{
	CHECK_TEXT(result(1, "Bits", 40), "TRUE");
	CHECK_TEXT(result(1, "Bits", 43), "2");
	CHECK_TEXT(result(1, "Row[2]", 43), "1");
	CHECK_TEXT(result(2, "Bits.Deep", 56), "1.5");
	CHECK_TEXT(result(2, "Row[2].Deep", 56), "1.5");
	CHECK(rig_set(&rig, "I0", 0) && rig_scan(&rig));
	CHECK_TEXT(result(1, "Bits", 41), "FALSE");
	CHECK_TEXT(result(1, "Bits", 43), "-");
	CHECK_TEXT(result(1, "Row[2]", 43), "2");
	CHECK_TEXT(result(2, "Bits.Deep", 58), "FALSE");
	CHECK_TEXT(result(2, "Row[2].Deep", 58), "TRUE");
	CHECK_TEXT(result(1, "Row[1]", 40), "-");
	rig_close(&rig);
}

/* The scan that nobody watches stores nothing, and has the same code. */
static void unwatched_lines_cost_nothing(void)
{
	CHECK(rig_open(&rig, source, false) && rig_scan(&rig));
	RESULT(12, "?");
	CHECK(rig.resource.image.program->power_count == 0);
	rig_close(&rig);
}

/* An image of CODE_VERSION that was made before lines had results has cells alone, and 0 in
 * the place of the type: cells are BOOL, and no rung is taken for a line of its number. */
static void older_images_have_cells_alone(void)
{
	static const char cells[] =
		"PROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\nRUNG\n  | NO I1 | COIL Q1 |\n"
		"END_PROGRAM\n";
	const struct program *program;

	CHECK(rig_open(&rig, cells, true) && rig_scan(&rig));
	program = rig.resource.image.program;
	CHECK(program->power_count > 0);
	for (uint32_t i = 0; i < program->power_count; i++) {
		const struct code_power *power = &program->power[i];

		CHECK(power->row >= 1 && power->col >= 1 && power->type == 0);
		CHECK(code_result(program, power->pou, power->rung) == NULL);
	}
	rig_close(&rig);
}

/* ---- lists that ladders and charts become ---- */

static const char generated[] =
	"VAR\n  T : TON;\n  N : INT := 3;\n  Bits : Two;\nEND_VAR\n"
	"PROGRAM Main LD\nRUNG\n  | NO I0 | NC I1 | COIL Q0 |\n  | NO Q0 ^|\n"
	"RUNG\n  | NO I1 | [ N > 2 ] | COIL Q1 |\n"
	"RUNG\n  | NO I0 | TON T PT:=T#1s | COIL Q2 |\n  | NO I1 | Two Bits |\nEND_PROGRAM\n"
	"FUNCTION_BLOCK Two LD\nVAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Out : BOOL;\nEND_VAR\nVAR\n  Seen : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO On | S Seen |\nEND_FUNCTION_BLOCK\n"
	"PROGRAM Chart SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Go:\n    Lamp(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Go:\n    RUNG\n      | NO I0 | NC I1 | COIL TRANSITION |\n"
	"  END_TRANSITION\n  TRANSITION FROM Go TO Start := I1; END_TRANSITION\n"
	"  ACTION Lamp:\n    RUNG\n      | NO I0 | COIL Q3 |\n  END_ACTION\nEND_PROGRAM\n";

/* Builds @text once more, with or without results of generated lists. */
static bool build_again(bool lists, const char *text)
{
	static char file[8192];

	snprintf(file, sizeof(file), "RUNGBOARD 1\n%s", text);
	ladder_watch_lists(rig.ladder, lists);
	return CHECK(ladder_load_text(rig.ladder, "rig.rung", file, strlen(file)) &&
		     ladder_build(rig.ladder));
}

static int count_listed(const struct program *program)
{
	int count = 0;

	for (uint32_t i = 0; i < program->power_count; i++)
		count += program->power[i].row == 0 && program->power[i].col == CODE_LISTED;
	return count;
}

/* Only a simulation asks for results of generated lists: the image of a board has none, and is the
 * same whatever was asked for before. */
static void boards_keep_no_generated_lists(void)
{
	size_t len, again;
	void *image;

	if (!CHECK(rig_open(&rig, generated, true)))
		return;
	CHECK(count_listed(rig.resource.image.program) == 0);
	image = malloc(rig.resource.image.program->header->size);
	memcpy(image, ladder_image(rig.ladder, &len), rig.resource.image.program->header->size);
	if (build_again(true, generated)) {
		const struct program *program = ladder_program(rig.ladder);

		ladder_image(rig.ladder, &again);
		CHECK(count_listed(program) > 30 && again > len);
		CHECK(program->header->section[CODE_TEXT].size ==
		      ((const struct code_header *)image)->section[CODE_TEXT].size);
	}
	if (build_again(false, generated))
		CHECK(memcmp(ladder_image(rig.ladder, &again), image, len) == 0 && again == len);
	free(image);
	rig_close(&rig);
}

int main(void)
{
	boards_keep_no_generated_lists();
	lines_have_their_results();
	skipped_lines_have_not_run();
	instances_have_their_own();
	unwatched_lines_cost_nothing();
	older_images_have_cells_alone();
	return tap_done();
}
