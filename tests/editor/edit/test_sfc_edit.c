/* SPDX-License-Identifier: MIT
 *
 * test_sfc_edit - edits of charts: known ones by their text, thousands of random ones by
 * invariants: the text can be read, is canonical, and has the expected steps and
 * transitions.
 */
#include "engine/show/sfc_layout.h"
#include "tests/editor/chart_edit.h"

#define EDITS 4000

/* ---- known edits ---- */

static void check_steps(void)
{
	begin("");
	EDIT(sfc_edit_first(edit, -1) == 0);
	CHECK_TEXT(body(), "  INITIAL_STEP Step1:\n  END_STEP\n");
	EDIT(sfc_edit_step_below(edit, 0) == 1);
	CHECK_TEXT(body(), "  INITIAL_STEP Step1:\n  END_STEP\n\n"
		   "  TRANSITION FROM Step1 TO Step2:\n  END_TRANSITION\n\n"
		   "  STEP Step2:\n  END_STEP\n");
	begin(two);
	EDIT(sfc_edit_step_below(edit, 0) == 2);
	CHECK(strstr(body(), "FROM A TO Step1:\n"));
	CHECK(strstr(body(), "FROM Step1 TO B := I0.0;"));
	begin(two);
	EDIT(sfc_edit_step_after(edit, 1) == 2);
	CHECK(strstr(body(), "FROM B TO Step1 := B.T > T#1s;"));
	CHECK(strstr(body(), "FROM Step1 TO A:\n"));
	EDIT(sfc_edit_delete_step(edit, 2));
	CHECK_TEXT(body(), two);
	EDIT(sfc_edit_branch(edit, 0) == 2);
	CHECK(chart()->transition_count == 3);
	EDIT(sfc_edit_parallel(edit, 0) >= 0);
	CHECK(strstr(body(), "FROM A TO (B, Step2) := I0.0;"));
	EDIT(sfc_edit_wait(edit, 2, 1));
	CHECK(strstr(body(), "FROM (B, Step"));
}

static void check_ways(void)
{
	begin(two);
	EDIT(sfc_edit_lead(edit, 0, 0) == 2);
	CHECK(strstr(body(), "FROM A TO A:\n"));
	EDIT(sfc_edit_move(edit, -1, 1, false));
	CHECK(strstr(body(), "FROM A TO A:") < strstr(body(), "FROM A TO B"));
	EDIT(sfc_edit_set_ways(edit, 0, true, "B , Nowhere"));
	CHECK(strstr(body(), "TO (B, Nowhere):\n"));
	EDIT(sfc_edit_cut_way(edit, 0, chart()->transition[0].first_to));
	CHECK(strstr(body(), "TO Nowhere:\n"));
	EDIT(sfc_edit_cut_way(edit, 0, chart()->transition[0].first_to));
	CHECK_TEXT(body(), two);
	EDIT(sfc_edit_delete_transition(edit, 1));
	EDIT(sfc_edit_delete_step(edit, 0));
	CHECK_TEXT(body(), "  STEP B:\n    Q0.0(N);\n  END_STEP\n");
}

static void check_statements(void)
{
	begin("  INITIAL_STEP A:\n    Do(N);\n  END_STEP\n\n  TRANSITION FROM A TO A := A.X; END_TRANSITION\n\n"
	      "  ACTION Do:\n    IF A.T > T#1s AND NOT AA.X THEN\n      M0.1 := A.X;  // A.X\n    END_IF;\n"
	      "  END_ACTION\n");
	EDIT(sfc_edit_name_step(edit, 0, "Begin"));
	CHECK(strstr(body(), "    IF Begin.T > T#1s AND NOT AA.X THEN\n      M0.1 := Begin.X;  // A.X\n"));
	CHECK(strstr(body(), "TO Begin := Begin.X;"));
}

static void check_texts(void)
{
	struct sfc_doing doing;

	begin(two);
	EDIT(sfc_edit_name_step(edit, 1, "Fill"));
	CHECK(strstr(body(), "FROM Fill TO A := Fill.T > T#1s;"));
	EDIT(sfc_edit_set_condition(edit, 0, "I0.1 AND Fill.X"));
	EDIT(sfc_edit_set_condition(edit, 1, ""));
	CHECK(strstr(body(), "FROM A TO Fill := I0.1 AND Fill.X;"));
	EDIT(sfc_edit_as_rung(edit, 0));
	CHECK(strstr(body(), "| [ I0.1 AND Fill.X ] | COIL TRANSITION |"));
	EDIT(sfc_edit_name_step(edit, 1, "Heat"));
	CHECK(strstr(body(), "| [ I0.1 AND Heat.X ] | COIL TRANSITION |"));
	EDIT(sfc_edit_name_transition(edit, 0, "Go"));
	EDIT(sfc_edit_set_priority(edit, 0, 2));
	EDIT(sfc_edit_set_times(edit, 0, "1s", "", "M0.0"));
	CHECK(strstr(body(), "INITIAL_STEP A (MIN := T#1s, ALARM := M0.0):"));
	CHECK(strstr(body(), "TRANSITION Go (PRIORITY := 2) FROM A TO Heat:"));
	EDIT(sfc_edit_set_kind(edit, 0, STEP_PLAIN));
	CHECK(sfc_doing_read(" l T#3s  Horn", &doing) && doing.qualifier == QUALIFIER_L);
	EDIT(sfc_edit_set_use(edit, 1, -1, &doing));
	CHECK(strstr(body(), "    Q0.0(N);\n    Horn(L, T#3s);\n"));
	CHECK(sfc_doing_read("SET Q0.1", &doing) && doing.kind == USE_SET);
	EDIT(sfc_edit_set_use(edit, 1, chart()->step[1].first_use, &doing));
	CHECK(strstr(body(), "    SET Q0.1;\n    Horn(L, T#3s);\n"));
	CHECK(sfc_doing_read("P1 ACTION Count", &doing) && doing.action);
	EDIT(sfc_edit_set_use(edit, 0, -1, &doing));
	CHECK(strstr(body(), "Count(P1);") && strstr(body(), "ACTION Count:\n    RUNG\n"));
	EDIT(sfc_edit_delete_use(edit, chart()->step[1].first_use));
	CHECK(!strstr(body(), "SET"));
	CHECK(sfc_doing_read("ACTION Sum ST", &doing) && doing.action && doing.statements);
	EDIT(sfc_edit_set_use(edit, 0, -1, &doing));
	CHECK(strstr(body(), "Sum(N);") && strstr(body(), "ACTION Sum:\n    ;\n  END_ACTION\n"));
}

/* A line of an action and its parts: qualifier, time, name, declaration; or the reason of a
 * refusal. */
static void check_doings(void)
{
	static const struct { const char *line, *says; } doings[] = {
		{ "Horn", "N  Horn|Horn" }, { "L T#3s, Horn", "L T#3s Horn|Horn" },
		{ "L 3s Horn", "L T#3s Horn|Horn" }, { "D Delay Horn", "D Delay Horn|Horn" },
		{ "N Horn AT %QX0.5", "N  Horn|Horn AT %QX0.5" },
		{ "Horn AT %QX0.5 : BOOL", "N  Horn|Horn AT %QX0.5 : BOOL" },
		{ "SET Horn : BOOL", "SET  Horn|Horn : BOOL" },
		{ "D T#1s Horn %QX0.5", "D T#1s Horn|Horn %QX0.5" },
		{ "N AT %QX0.5", "N  N|N AT %QX0.5" }, { "S : BOOL", "N  S|S : BOOL" },
		{ "ACTION Count", "N  Count|Count" }, { "S ACTION Count", "S  Count|Count" },
		{ "ACTION Count ST", "N  Count|Count ST" },
		{ "Z Horn", "! the first word is not a qualifier" },
		{ "Horn now", "! the first word is not a qualifier" },
		{ "N a b", "! there are too many words: write a qualifier and a name" }, { "ACTION a b", "! there are too many words: write a qualifier and a name" },
		{ "L T#3s", "! this qualifier needs a time and a name, as in L T#5s Motor" },
		{ "L Horn", "! this qualifier needs a time and a name, as in L T#5s Motor" },
		{ "ACTION", "! the name of an action or a bit is missing" },
		{ "  ", "! the name of an action or a bit is missing" },
	};

	for (size_t i = 0; i < sizeof(doings) / sizeof(*doings); i++) {
		struct sfc_doing doing;
		char got[400];

		if (sfc_doing_read(doings[i].line, &doing))
			snprintf(got, sizeof(got), "%s %s %s|%s", doing.kind == USE_SET ?
				 "SET" : qualifier_word(doing.qualifier), doing.time,
				 doing.name, doing.operand);
		else
			snprintf(got, sizeof(got), "! %s", doing.why);
		if (!CHECK_AS(strcmp(got, doings[i].says) == 0, doings[i].line))
			printf("# got: %s\n", got);
	}
}

/* A refusal has a reason and changes nothing. */
#define REFUSED(call) do { \
	struct sfc_edit *edit = edit_new(); \
	CHECK_AS(!(call) && edit->why, #call); \
	sfc_edit_free(edit); \
} while (0)

static void check_refusals(void)
{
	struct sfc_doing doing;

	begin(two);
	REFUSED(sfc_edit_name_step(edit, 0, "B"));
	REFUSED(sfc_edit_name_step(edit, 0, "1x"));
	REFUSED(sfc_edit_name_step(edit, 0, "a b"));
	REFUSED(sfc_edit_name_step(edit, 0, "TON"));
	REFUSED(sfc_edit_name_step(edit, 0, ""));
	REFUSED(sfc_edit_set_condition(edit, 0, "A; B"));
	REFUSED(sfc_edit_set_ways(edit, 0, true, " , "));
	REFUSED(sfc_edit_wait(edit, 0, 0));
	REFUSED(sfc_edit_move(edit, -1, 0, true));
	REFUSED(sfc_edit_set_times(edit, 0, "T#1s, X", "", ""));
	CHECK(!sfc_doing_read("", &doing) && doing.why);
	CHECK(!sfc_doing_read("L Horn", &doing) && doing.why);
	CHECK(!sfc_doing_read("N a b", &doing) && doing.why);
	CHECK_AS(sfc_doing_read("N", &doing) && strcmp(doing.name, "N") == 0,
		 "a name may look like a qualifier");
}

/* ---- macro-steps ---- */

static const char six[] =
	"  INITIAL_STEP A:\n    Q0.0(N);\n  END_STEP\n\n"
	"  TRANSITION FROM A TO B := I0.0; END_TRANSITION\n\n"
	"  STEP B:\n    Q0.1(L, T#20ms);\n  END_STEP\n\n"
	"  TRANSITION FROM B TO (C, D) := I0.1; END_TRANSITION\n\n"
	"  TRANSITION FROM B TO A := I0.2; END_TRANSITION\n\n"
	"  STEP C:\n    Q0.2(P);\n  END_STEP\n\n"
	"  STEP D:\n    Q0.3(S);\n  END_STEP\n\n"
	"  TRANSITION FROM (C, D) TO E := I0.3; END_TRANSITION\n\n"
	"  STEP E:\n    Q0.3(R);\n  END_STEP\n\n"
	"  TRANSITION FROM E TO F := I0.4; END_TRANSITION\n\n"
	"  STEP F:\n    SET M0.0;\n  END_STEP\n\n"
	"  TRANSITION FROM F TO E := I0.5; END_TRANSITION\n\n"
	"  TRANSITION FROM F TO A := I0.6; END_TRANSITION\n";

static int fold(struct sfc_edit *edit, unsigned int which)
{
	bool chosen[16] = { false };

	for (int i = 0; i < edit->sfc.step_count; i++)
		chosen[i] = which >> i & 1;
	return sfc_edit_macro_make(edit, chosen);
}

/* Behaviour on random inputs: a checksum of all steps and outputs in all scans. */
static uint64_t traced(void)
{
	static const char *const names[] = { "A.X", "B.X", "C.X", "D.X", "E.X", "F.X",
					     "%QB0", "%MB0", "B.T", "F.T" };
	struct resource resource;
	uint64_t sum = 0, inputs = 1;
	void *memory;

	if (!ladder_build(ladder))
		return 0;
	memory = calloc(1, image_memory_size(ladder_program(ladder)));
	resource_init(&resource, ladder_program(ladder), memory);
	resource_start(&resource);
	for (int scan = 1; scan <= 3000; scan++) {
		const struct location in = image_find(&resource.image, "%IB0", 4);

		inputs = inputs * 6364136223846793005u + 1442695040888963407u;
		if (scan % 3 == 0)
			image_set(&resource.image, in,
				  (union iec_value){ .i = (int64_t)(inputs >> 50 & 127) });
		resource_scan(&resource, scan * (int64_t)10000000);
		for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
			const struct location at = image_find(&resource.image, names[i],
							      strlen(names[i]));

			sum = sum * 1099511628211u +
			      (uint64_t)(at.type ? image_get(&resource.image, at).i : -1);
		}
	}
	free(memory);
	return sum;
}

static void check_macros(void)
{
	uint64_t before;
	int made = 0;

	begin(two);
	EDIT(fold(edit, 2) == 2);
	CHECK_TEXT(body(),
		"  INITIAL_STEP A:\n  END_STEP\n\n"
		"  TRANSITION FROM A TO Macro1 := I0.0; END_TRANSITION\n\n"
		"  MACRO_STEP Macro1:\n"
		"    INITIAL_STEP B:\n      Q0.0(N);\n    END_STEP\n  END_STEP\n\n"
		"  TRANSITION FROM Macro1 TO A := B.T > T#1s; END_TRANSITION\n");
	EDIT(sfc_edit_macro_open(edit, 1) == 2);
	CHECK_TEXT(body(), two);
	REFUSED(fold(edit, 1) >= 0);
	REFUSED(fold(edit, 0) >= 0);
	REFUSED(sfc_edit_macro_open(edit, 0) >= 0);
	/* Makes and dissolves macro-steps and compares the behaviour. */
	begin(six);
	before = traced();
	CHECK(before != 0);
	for (unsigned int which = 1; which < 64; which++) {
		struct sfc_edit *edit;
		bool good;

		begin(six);
		edit = edit_new();
		if (fold(edit, which) < 0) {
			CHECK_AS(edit->why, "a refusal has a reason");
			sfc_edit_free(edit);
			continue;
		}
		made++;
		good = take(edit) && traced() == before;
		for (int i = 0; good && i < chart()->step_count; i++)
			if (chart()->step[i].kind == STEP_MACRO) {
				edit = edit_new();
				good = sfc_edit_macro_open(edit, i) >= 0 && take(edit) &&
				       traced() == before;
				break;
			}
		CHECK_AS(good, "a macro-step keeps the behaviour");
		if (!good)
			printf("# steps %x\n%s\n", which, text_now);
	}
	printf("# %d of 63\n", made);
	CHECK(made == 6);
	begin(six);
	REFUSED(fold(edit, 4 | 8) >= 0);  /* C and D: two entries */
	REFUSED(fold(edit, 2 | 16) >= 0); /* B and E: likewise */
	EDIT(fold(edit, 16 | 32) == 6);
	CHECK(strstr(body(), "FROM Macro1 TO Macro1 := I0.5;"));
}

static void check_comments(void)
{
	begin(two);
	EDIT(sfc_edit_set_comment(edit, PIECE_STEP, 1, "fills"));
	EDIT(sfc_edit_set_comment(edit, PIECE_TRANSITION, 0, "begins"));
	EDIT(sfc_edit_set_use_comment(edit, 0, "the valve"));
	CHECK(strstr(body(), "  (* begins *)\n  TRANSITION FROM A TO B"));
	CHECK(strstr(body(), "  (* fills *)\n  STEP B:\n    (* the valve *)\n    Q0.0(N);"));
	EDIT(sfc_edit_set_comment(edit, PIECE_STEP, 1, ""));
	EDIT(sfc_edit_set_comment(edit, PIECE_TRANSITION, 0, ""));
	EDIT(sfc_edit_set_use_comment(edit, 0, ""));
	CHECK_TEXT(body(), two);
	REFUSED(sfc_edit_set_comment(edit, PIECE_STEP, 0, "a *) b"));
	REFUSED(sfc_edit_set_comment(edit, PIECE_STEP, 0, "a\nb"));
	REFUSED(sfc_edit_set_priority(edit, 0, 65536));
}

/* ---- random ones ---- */

static uint64_t state = 88172645463325252u;

static int roll(int count)
{
	state ^= state << 13;
	state ^= state >> 7;
	state ^= state << 17;
	return count > 0 ? (int)((state >> 33) % (uint64_t)count) : 0;
}

static bool edit_text(struct sfc_edit *edit, int step, int transition)
{
	static const char *const lines[] = { "N Q0.1", "SET M0.1", "RESET M0.1, ", "Q0.2",
					     "SD T#2s Q0.3", "ACTION Do", "P ACTION Too" };
	static const char *const names[] = { "A", "Fill", "Heat", "Step2", "x", "", "1" };
	struct sfc_doing doing;

	switch (roll(8)) {
	case 0: return sfc_edit_name_step(edit, step, names[roll(7)]);
	case 1: return sfc_edit_set_kind(edit, step, (enum step_kind)roll(2));
	case 2: return sfc_edit_set_times(edit, step, roll(2) ? "T#1s" : "", "MW0", "");
	case 3: return transition >= 0 &&
		       sfc_edit_name_transition(edit, transition, names[roll(7)]);
	case 4: return transition >= 0 &&
		       sfc_edit_set_condition(edit, transition, roll(3) ? "Fill.X" : "");
	case 5: return transition >= 0 && sfc_edit_as_rung(edit, transition);
	case 6: return edit->sfc.use_count && sfc_edit_delete_use(edit,
							roll(edit->sfc.use_count));
	default:
		return sfc_doing_read(lines[roll(7)], &doing) &&
		       sfc_edit_set_use(edit, step, -1, &doing);
	}
}

static bool edit_way(struct sfc_edit *edit, int step, int transition)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];

	switch (roll(8)) {
	case 0: return sfc_edit_step_after(edit, transition) >= 0;
	case 1: return sfc_edit_parallel(edit, transition) >= 0;
	case 2: return sfc_edit_set_ways(edit, transition, roll(2), "Step1, Step3");
	case 3: return sfc_edit_wait(edit, transition, step);
	case 4: return sfc_edit_delete_transition(edit, transition);
	case 5: return sfc_edit_cut_way(edit, transition, t->first_to + roll(t->to_count));
	case 6: return sfc_edit_cut_way(edit, transition,
					t->first_from + roll(t->from_count));
	default: return sfc_edit_move(edit, roll(2) ? step : -1, transition, roll(2));
	}
}

static bool fold_any(struct sfc_edit *edit)
{
	bool chosen[256] = { false };
	const int count = 1 + roll(3);

	for (int i = 0; i < count; i++)
		chosen[roll(edit->sfc.step_count)] = true;
	return sfc_edit_macro_make(edit, chosen) >= 0;
}

static bool edit_any(struct sfc_edit *edit)
{
	const int step = roll(edit->sfc.step_count);
	const int transition = roll(edit->sfc.transition_count + 1) - 1;

	if (!edit->sfc.step_count || roll(60) == 0)
		return sfc_edit_first(edit, -1) >= 0;
	if (edit->sfc.step_count > 40)
		return sfc_edit_delete_step(edit, step);
	switch (roll(9)) {
	case 8: return roll(2) ? fold_any(edit) : sfc_edit_macro_open(edit, step) >= 0;
	case 0: return sfc_edit_step_below(edit, step) >= 0;
	case 1: return sfc_edit_branch(edit, step) >= 0;
	case 2: return sfc_edit_lead(edit, step, roll(edit->sfc.step_count)) >= 0;
	case 3: return sfc_edit_delete_step(edit, step);
	case 4: case 5: return edit_text(edit, step, transition);
	default: return transition >= 0 && edit_way(edit, step, transition);
	}
}

/* Each name in a transition that was found is that of an existing step. */
static bool is_whole(void)
{
	struct sfc_layout *layout = sfc_layout_new(chart());
	bool good = layout != NULL;

	sfc_layout_free(layout);
	return good;
}

static void check_random(void)
{
	int done = 0, bad = 0, most = 0;

	begin("  MACRO_STEP M:\n\n    INITIAL_STEP In:\n    END_STEP\n  END_STEP\n");
	for (int i = 0; i < EDITS && !bad; i++) {
		struct sfc_edit *edit = edit_new();

		if (!edit_any(edit)) {
			sfc_edit_free(edit);
			continue;
		}
		done++;
		bad += !take(edit) || !is_whole();
		most = chart()->step_count > most ? chart()->step_count : most;
	}
	printf("# %d edits, up to %d steps\n", done, most);
	CHECK_AS(bad == 0, "results can be read and are canonical");
	CHECK(done > EDITS / 2 && most > 20);
}

int main(void)
{
	check_steps();
	check_ways();
	check_statements();
	check_texts();
	check_doings();
	check_refusals();
	check_macros();
	check_comments();
	check_random();
	ladder_free(ladder);
	free(text_now);
	return tap_done();
}
