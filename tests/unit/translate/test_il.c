/* SPDX-License-Identifier: MIT
 *
 * test_il - instruction lists whose result depends on the order of reading and
 * writing, and lists that are refused: one row each. The second evaluator checks the
 * lists of ladder diagrams, which have fewer forms than a person can write.
 */
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char head[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  A, B, C, X, Y : BOOL;\n"
	"  N, M, K : INT;\n"
	"  Heat : REAL;\n"
	"  Mask : WORD;\n"
	"  Wide : TIME := T#4s294ms967us296ns;\n"
	"  Span : TIME;\n"
	"  Delay : TON;\n"
	"  Up : CTU;\n"
	"END_VAR\n"
	"PROGRAM Main IL\n";

static struct ladder *load(const char *lines)
{
	struct ladder *ladder = ladder_new();
	size_t room = sizeof(head) + strlen(lines) + 16;
	char *text = malloc(room);

	if (!ladder || !text) {
		free(text);
		return ladder;
	}
	snprintf(text, room, "%s%sEND_PROGRAM\n", head, lines);
	if (ladder_load_text(ladder, "list.rung", text, strlen(text)))
		ladder_build(ladder);
	free(text);
	return ladder;
}

/* ---- what is refused ---- */

static const char *first_error(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			return diag_code(diags->diag[i].id);
	return "none";
}

static void test_refused(void)
{
	static const struct {
		const char *code, *lines;
	} rows[] = {
		{ "LD601", "  LD A\n  AND( B\n  JMP On\n  )\nOn:\n  ST X\n" },
		{ "LD601", "  LD A\n  AND( B\n  RET\n  )\n  ST X\n" },
		{ "LD601", "  LD A\n  AND( B\nOn:\n  LD A\n  ST X\n" },
		{ "LD601", "  LD A\n  AND( B\n  ST X\n" },
		{ "LD602", "  LD A\n  )\n  ST X\n" },
		{ "LD603", "  ST X\n" },
		{ "LD603", "  CALC Delay(IN := A)\n" },
		{ "LD603", "  JMPC On\nOn:\n  LD A\n  ST X\n" },
		{ "LD603", "  LD A\n  AND(\n  )\n  ST X\n" },
		{ "LD603", "  NOT\n  ST X\n" },
		{ "LD603", "  ADD 1\n  ST N\n" },
		{ "LD603", "  CAL Delay(IN := A)\n  ST X\n" },
		{ "LD609", "  LD A\nOn:\n  ST X\n" },
		{ "LD604", "  LDC A\n  ST X\n" },
		{ "LD604", "  LD A\n  SN X\n" },
		{ "LD305", "  LD A\n  ST TRUE\n" },
		{ "LD304", "  LD A\n  ST %IX0.0\n" },
		{ "LD306", "  JMP Nowhere\n" },
		{ "LD307", "On:\n  LD A\nOn:\n  LD A\n  ST X\n" },
		{ "LD308", "  LD Delay\n  ST X\n" },
		{ "LD309", "  CAL A(IN := B)\n" },
		{ "LD319", "  CAL Delay(GO := A)\n" },
		{ "LD320", "  CAL Delay(Q := A)\n" },
		{ "LD357", "  CAL Delay(IN => A)\n" },
		{ "LD320", "  LD A\n  ST Delay.Q\n" },
		{ "LD321", "  ADD(IN1 := N, OUT => M)\n" },
		{ "LD321", "  ADD(IN1 := N, IN3 := 2, OUT => M)\n" },
		{ "LD321", "  ADD(IN2 := N, IN3 := 2, OUT => M)\n" },
		{ "LD322", "  LD Heat\n  ST N\n" },
		{ "LD322", "  LD Mask\n  AND A\n  ST X\n" },
		{ "LD322", "  LD A\n  AND Mask\n  ST X\n" },
		{ "LD322", "  LD Mask\n  OR( A\n  )\n  ST Mask\n" },
		{ "LD322", "  LD A\n  OR( Mask\n  )\n  ST X\n" },
		{ "LD322", "  LD Mask\n  XORN N\n  ST Mask\n" },
		{ "LD322", "  LD Mask\n  AND 1\n  ST X\n" },
		{ "LD116", "  LD Mask\n  AND 65536\n  ST Mask\n" },
		{ "LD333", "  LD N\n  NOT\n  ST N\n" },
		{ "LD324", "  LDN N\n  ST N\n" },
		{ "LD324", "  LD A\n  STN N\n" },
		{ "LD322", "  LD A\n  STN Mask\n" },
		{ "LD322", "  LD Mask\n  INT_TO_REAL\n  ST Heat\n" },
		{ "LD110", "  LD Mask\n  DATE_TO_TOD\n  ST Heat\n" },
		{ "LD322", "  CAL Up(CU := A, CV => X)\n" },
		{ "LD333", "  LD N\n  CALC Delay(IN := A)\n" },
		{ "LD333", "  LD N\n  AND A\n  ST X\n" },
		{ "LD324", "  LD A\n  AND N\n  ST X\n" },
		{ "LD333", "  LD N\n  JMPC On\nOn:\n  LD A\n  ST X\n" },
		{ "LD333", "  LD N\n  NOT\n  ST X\n" },
		{ "LD324", "  LDN N\n  ST X\n" },
		{ "LD333", "  LD N\n  S X\n" },
		{ "LD324", "  ADD(EN := N, IN1 := N, IN2 := 2, OUT => M)\n" },
		{ "LD324", "  ADD(IN1 := N, IN2 := 2, ENO => K, OUT => M)\n" },
		{ "LD116", "  LD 40000\n  ST N\n" },
		{ "LD332", "  LD A\n  ADD A\n  ST X\n" },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct ladder *ladder = load(rows[i].lines);
		const char *got = first_error(ladder_diags(ladder));

		if (!CHECK_AS(strcmp(got, rows[i].code) == 0, rows[i].code))
			printf("# %s for:\n# %s\n", got, rows[i].lines);
		CHECK(!ladder_program(ladder));
		ladder_free(ladder);
	}
}

/* ---- what is run ---- */

struct setting {
	const char *name;
	int64_t value;
};

static bool apply(struct image *image, const struct setting *set)
{
	union iec_value value = { .i = set->value };
	struct location at = image_find(image, set->name, strlen(set->name));

	if (at.type == IEC_REAL)
		value.r = (double)set->value;
	return image_set(image, at, value);
}

static bool stands(const struct image *image, const struct setting *want)
{
	struct location at = image_find(image, want->name, strlen(want->name));
	union iec_value value = image_get(image, at);

	if (at.type == IEC_REAL)
		value.i = (int64_t)value.r;
	if (at.type != IEC_NONE && value.i == want->value)
		return true;
	printf("# %s is %lld, should be %lld\n", want->name,
	       (long long)value.i, (long long)want->value);
	return false;
}

static void run_row(const char *what, const char *lines,
		    const struct setting *set, const struct setting *want)
{
	struct ladder *ladder = load(lines);
	const struct program *program = ladder_program(ladder);
	struct resource resource;
	void *memory = program ? calloc(1, image_memory_size(program)) : NULL;
	bool good = memory != NULL;

	if (good) {
		resource_init(&resource, program, memory);
		resource_start(&resource);
		for (; good && set->name; set++)
			good = apply(&resource.image, set);
		good = good && resource_scan(&resource, 1000000);
		for (; good && want->name; want++)
			good = stands(&resource.image, want);
	}
	CHECK_AS(good, what);
	free(memory);
	ladder_free(ladder);
}

#define SET(...) (const struct setting[]){ __VA_ARGS__, { NULL, 0 } }
#define WANT SET

static void test_order(void)
{
	run_row("a store inside ( ) does not change the value before it",
		"  LD A\n  OR( B\n  ST A\n  AND C\n  )\n  ST X\n",
		SET({ "A", 1 }), WANT({ "A", 0 }, { "X", 1 }));
	run_row("a store inside two ( ) does not change the values before them",
		"  LD A\n  OR( B\n  OR( C\n  ST A\n  ST B\n  )\n  )\n  ST X\n",
		SET({ "B", 1 }), WANT({ "A", 0 }, { "B", 0 }, { "X", 1 }));
	run_row("an operand is read before a set changes it",
		"  LD A\n  R A\n  ST X\n",
		SET({ "A", 1 }), WANT({ "A", 0 }, { "X", 1 }));
	run_row("a store does not change the result, even if it overwrites its source",
		"  LD %MB1\n  ST %MW0\n  ST %MB4\n",
		SET({ "%MB1", 5 }), WANT({ "%MB0", 5 }, { "%MB1", 0 },
					 { "%MB4", 5 }));
	run_row("the next operation uses the stored number",
		"  LD N\n  ST M\n  ADD 1\n  ST N\n  ADD 1\n  ST K\n",
		SET({ "N", 7 }), WANT({ "M", 7 }, { "N", 8 }, { "K", 9 }));
	run_row("STN stores the inverse and keeps the result",
		"  LD A\n  STN X\n  ST Y\n",
		SET({ "A", 1 }), WANT({ "X", 0 }, { "Y", 1 }));
}

static void test_calls(void)
{
	run_row("CALC writes no outputs if the result is FALSE",
		"  LD Y\n  OR( C\n  CALC Delay(IN := A, Q => Y)\n  LD C\n  )\n"
		"  ST X\n",
		SET({ "Y", 1 }), WANT({ "X", 1 }, { "Y", 1 }));
	run_row("CALC in ( ) writes its outputs and keeps the value before the (",
		"  LD Y\n  OR( B\n  CALC Delay(IN := A, Q => Y)\n  LD C\n  )\n"
		"  ST X\n",
		SET({ "Y", 1 }, { "B", 1 }), WANT({ "X", 1 }, { "Y", 0 }));
	run_row("CALC sets no inputs if the result is FALSE",
		"  LD C\n  CALC Delay(IN := A, PT := T#5s)\n",
		SET({ "A", 1 }), WANT({ "Delay.PT", 0 }, { "Delay.IN", 0 }));
	run_row("CALCN calls if the result is FALSE",
		"  LD C\n  CALCN Up(CU := A, PV := 1, Q => X, CV => N)\n",
		SET({ "A", 1 }), WANT({ "X", 1 }, { "N", 1 }));
	run_row("ADD with EN FALSE stores nothing and sets ENO to FALSE",
		"  ADD(EN := A, IN1 := N, IN2 := 2, ENO => X, OUT => M)\n",
		SET({ "N", 3 }, { "M", 9 }, { "X", 1 }),
		WANT({ "M", 9 }, { "X", 0 }));
	run_row("MOVE with EN FALSE keeps a BOOL",
		"  MOVE(EN := A, IN := B, ENO => Y, OUT => X)\n",
		SET({ "B", 0 }, { "X", 1 }), WANT({ "X", 1 }, { "Y", 0 }));
	run_row("MOVE with EN FALSE keeps a packed BOOL",
		"  LD 0\n  ST %MB0\n  LD TRUE\n  ST %MX0.3\n"
		"  MOVE(EN := A, IN := B, OUT => %MX0.3)\n",
		SET({ "B", 0 }), WANT({ "%MX0.3", 1 }));
}

static void test_numbers(void)
{
	run_row("an integer is compared with a REAL as a number",
		"  LD N\n  LT Heat\n  ST X\n  LD N\n  GT Heat\n  ST Y\n",
		SET({ "N", 3 }, { "Heat", 2 }), WANT({ "X", 0 }, { "Y", 1 }));
	run_row("a REAL is compared with an integer as a number",
		"  LD Heat\n  GT N\n  ST X\n  LD Heat\n  EQ N\n  ST Y\n",
		SET({ "N", 4 }, { "Heat", 4 }), WANT({ "X", 0 }, { "Y", 1 }));
	run_row("an initial TIME of 2^32 ns is stored whole",
		"  LD Wide\n  ST Span\n",
		SET({ "A", 0 }), WANT({ "Span", INT64_C(1) << 32 }));
	run_row("a constant TIME of 2^33 ns is stored whole",
		"  LD T#8s589ms934us592ns\n  ST Span\n",
		SET({ "A", 0 }), WANT({ "Span", INT64_C(1) << 33 }));
	run_row("DIV by -1 negates, MOD by -1 gives 0",
		"  LD N\n  DIV -1\n  ST M\n  LD N\n  MOD -1\n  ST K\n",
		SET({ "N", -5 }, { "K", 4 }), WANT({ "M", 5 }, { "K", 0 }));
}

/* ---- more waiting values than there is room for ---- */

/* A rung of @rows contacts for edges in parallel. */
static void test_many_edges(int rows)
{
	struct ladder *ladder = ladder_new();
	char *text = malloc(64 * (size_t)rows + 400);
	size_t len = 0;
	const struct program *program;
	struct resource resource;
	void *memory = NULL;
	bool good = false;

	if (ladder && text) {
		len = (size_t)snprintf(text, 400, "RUNGBOARD 1\nVAR\n"
			"  X : BOOL;\nEND_VAR\nPROGRAM Main LD\nRUNG\n");
		for (int i = 0; i < rows; i++)
			len += (size_t)snprintf(text + len, 64, i ?
				"  | P %%MX%d.%d ^|\n" :
				"  | P %%MX%d.%d | COIL X |\n", i / 8, i % 8);
		len += (size_t)snprintf(text + len, 64, "END_PROGRAM\n");
		good = ladder_load_text(ladder, "edges.rung", text, len) &&
		       ladder_build(ladder);
	}
	CHECK_AS(good, "the rung of edges builds");
	program = ladder_program(ladder);
	if (good)
		memory = calloc(1, image_memory_size(program));
	if (memory) {
		struct location x = { .type = IEC_NONE };

		resource_init(&resource, program, memory);
		resource_start(&resource);
		x = image_find(&resource.image, "X", 1);
		for (int i = -1; i < rows && good; i++) {
			image_set_bit(&resource.image, AREA_M,
				      (uint32_t)(i < 0 ? 0 : i), i >= 0);
			resource_scan(&resource, 1000000 * (i + 2));
			good = image_get(&resource.image, x).i == (i >= 0);
			resource_scan(&resource, 1000000 * (i + 2) + 500000);
			good = good && image_get(&resource.image, x).i == 0;
		}
		CHECK_AS(good, "each single edge sets the coil for one scan");
	}
	free(memory);
	free(text);
	ladder_free(ladder);
}

int main(void)
{
	test_refused();
	test_order();
	test_calls();
	test_numbers();
	test_many_edges(3);
	test_many_edges(LIMIT_ROWS);
	return tap_done();
}
