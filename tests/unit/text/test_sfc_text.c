/* SPDX-License-Identifier: MIT
 *
 * test_sfc_text - charts read and written, and what their names mean.
 *
 * Text that is damaged at random must be refused or be written and read again to the
 * same bytes. What a chart does is tested elsewhere.
 */
#include "engine/check/scope.h"
#include "engine/ladder.h"
#include "engine/text/text.h"
#include "engine/xref/xref.h"

#include "tests/tap.h"

#include <stdlib.h>

/* Everything that a chart may hold, in canonical form. */
static const char whole[] =
	"RUNGBOARD 1\n"
	"\n"
	"// above the chart\n"
	"PROGRAM Filler SFC UNTIL STABLE\n"
	"  VAR\n"
	"    Start  AT %IX0.0 : BOOL; (* button *)\n"
	"    Full   AT %IX0.1 : BOOL;\n"
	"    Step   : BOOL;\n"
	"    Set    : BOOL;\n"
	"    Lamps  : ARRAY[1..3] OF BOOL;\n"
	"    Wait   : TIME := T#2s;\n"
	"    Number : INT;\n"
	"  END_VAR\n"
	"\n"
	"  // how it is operated\n"
	"  CONTROL(RESET := I0.7, HOLD := M1.0, SEMI := M1.1, MANUAL := M1.2, "
	"TIP := M1.3, FORCE := Number);\n"
	"\n"
	"  (* two lines,\n"
	"one comment *)\n"
	"  // and one more\n"
	"  INITIAL_STEP Idle:\n"
	"    // nothing is done\n"
	"  END_STEP\n"
	"\n"
	"  STEP Fill (MIN := T#1s, MAX := Wait, ALARM := M0.0, COLUMN := 3):\n"
	"    // the valve\n"
	"    %QX0.0(N);\n"
	"    Lamps[2](L, T#1s500ms);\n"
	"    Count(P1);\n"
	"    Step(SD, Wait);\n"
	"    Set(S);\n"
	"    // once\n"
	"    SET Lamps[1], M0.1;\n"
	"    RESET M0.2;\n"
	"    // the end\n"
	"    // of it\n"
	"  END_STEP\n"
	"\n"
	"  MACRO_STEP Mix (COLUMN := 4):\n"
	"    M0.3(N);\n"
	"\n"
	"    // inside\n"
	"    INITIAL_STEP In:\n"
	"    END_STEP\n"
	"\n"
	"    MACRO_STEP Deep:\n"
	"      INITIAL_STEP d1:\n"
	"      END_STEP\n"
	"    END_STEP\n"
	"\n"
	"    TRANSITION FROM In TO Deep := TRUE; END_TRANSITION\n"
	"    // before its end\n"
	"  END_STEP\n"
	"\n"
	"  // why\n"
	"  TRANSITION (PRIORITY := 2) FROM Idle TO (Fill, Mix) := Start AND NOT (Full OR "
	"Idle.T < T#1s); END_TRANSITION\n"
	"\n"
	"  TRANSITION FROM (Fill, Mix) TO Idle := Full;\n"
	"    // tail\n"
	"  END_TRANSITION\n"
	"\n"
	"  TRANSITION Enough (PRIORITY := 1) FROM Fill TO Idle:\n"
	"    // above the rung\n"
	"    RUNG \"Full?\"\n"
	"      | NO Full (* wet *) | NC Fill.X | COIL TRANSITION |\n"
	"      |                  ^| NO Start ^|\n"
	"    // below it\n"
	"  END_TRANSITION\n"
	"\n"
	"  TRANSITION Late FROM Fill TO Idle:\n"
	"    LD    Fill.T // so long\n"
	"    GT    Wait\n"
	"  // over\n"
	"  END_TRANSITION\n"
	"\n"
	"  ACTION Count:\n"
	"  // first\n"
	"  // of all\n"
	"  Again:\n"
	"    LD    Number\n"
	"    ADD   1\n"
	"    ST    Number\n"
	"    JMPC  Again\n"
	"  END_ACTION\n"
	"\n"
	"  ACTION Rungs:\n"
	"    RUNG Again\n"
	"      | NO Full | JMP Again |\n"
	"    RUNG OFF\n"
	"      | NO Full | COIL M0.4 |\n"
	"  END_ACTION\n"
	"  // last\n"
	"END_PROGRAM\n"
	"\n"
	"// behind\n";

static struct diag_list diags;

/* NULL: the text was refused. */
static struct project *read(const char *text, size_t len)
{
	struct project *project = project_new("t.rung");

	diag_init(&diags);
	if (project && text_read(project, "t.rung", text, len, NULL, &diags))
		return project;
	project_free(project);
	return NULL;
}

static char *written(const char *text, size_t len, size_t *out)
{
	struct project *project = read(text, len);
	char *again = project ? text_write(project, out) : NULL;

	project_free(project);
	return again;
}

/* Whether a written chart that is read again is written the same. */
static bool is_stable(const char *text, size_t len)
{
	size_t first_len = 0, again_len = 0;
	char *first = written(text, len, &first_len), *again;
	bool same;

	if (!first)
		return diags.errors > 0;
	again = written(first, first_len, &again_len);
	same = again && first_len == again_len && !memcmp(first, again, first_len);
	if (!same)
		printf("# first: %s\n# again: %s\n", first, again ? again : "refused");
	free(first);
	free(again);
	return same;
}

static void canonical(const char *from, const char *to)
{
	size_t len = 0;
	char *text = written(from, strlen(from), &len);

	CHECK_TEXT(text ? text : "refused", to);
	free(text);
}

#define HEAD "RUNGBOARD 1\n\nPROGRAM P SFC\n"

static void test_forms(void)
{
	canonical(whole, whole);
	canonical("rungboard 1 program P sfc (* a *) step (* b *) S(column:=2):",
		  "refused");
	canonical("RUNGBOARD 1\nprogram P sfc\nend_program\n",
		  HEAD "END_PROGRAM\n");
	canonical("RUNGBOARD 1\nprogram P sfc\nstep A: M0(); M1 ( p0 ) ;\nend_step step B"
		  "(\n):\nend_step // b\ntransition t from(A)to( B ,\n A )"
		  ":= I0 // i\n and\nI1; // e\nend_transition\nend_program\n",
		  HEAD "  STEP A:\n    M0(N);\n    M1(P0);\n  END_STEP\n\n"
		  "  STEP B:\n  END_STEP\n\n"
		  "  // b\n  // i\n  // e\n"
		  "  TRANSITION t FROM A TO (B, A) := I0 and I1; END_TRANSITION\n"
		  "END_PROGRAM\n");
}

/* FROM or TO may be missing in a chart IN ORDER, not in another one. */
static void test_in_order(void)
{
#define OPEN "  STEP TO_A:\n  END_STEP\n\n" \
	     "  TRANSITION TO TO_A := I0; END_TRANSITION\n\n" \
	     "  TRANSITION Away (PRIORITY := 2) FROM TO_A := I1; END_TRANSITION\n" \
	     "END_PROGRAM\n"
	static const char in_order[] = "RUNGBOARD 1\n\nPROGRAM P SFC IN ORDER\n" OPEN;
	struct project *project = read(in_order, strlen(in_order));
	const struct sfc *sfc = project ? project->pou[0].sfc : NULL;

	canonical(in_order, in_order);
	canonical(HEAD OPEN, "refused");
	CHECK(sfc && sfc->evolution == EVOLVE_IN_ORDER && sfc->transition_count == 2 &&
	      !sfc->transition[0].name && !sfc->transition[0].from_count &&
	      sfc->transition[0].to_count == 1 && sfc->transition[1].from_count == 1 &&
	      !sfc->transition[1].to_count);
	project_free(project);
}

static void test_model(void)
{
	struct project *project = read(whole, strlen(whole));
	const struct pou *pou = project ? &project->pou[0] : NULL;
	const struct sfc *sfc = pou ? pou->sfc : NULL;

	CHECK(sfc != NULL);
	if (!sfc)
		return;
	CHECK(sfc->evolution == EVOLVE_UNTIL_STABLE && sfc->step_count == 6 &&
	      sfc->transition_count == 5);
	CHECK(sfc->action_count == 2 && sfc->use_count == 9 && sfc->piece_count == 16);
	CHECK(sfc->step[1].use_count == 8 && sfc->step[2].use_count == 1);
	CHECK(sfc->step[2].kind == STEP_MACRO && sfc->step[5].macro == 4 &&
	      sfc->step[4].macro == 2 && sfc->step[3].macro == 2 && sfc->step[2].macro == -1);
	CHECK(sfc->piece[sfc->step[2].end].kind == PIECE_MACRO_END &&
	      sfc->piece[sfc->step[2].end].index == 2);
	CHECK(sfc->use[2].action == 0 && sfc->use[0].action == -1);
	CHECK(!sfc->use[5].more && sfc->use[6].more && !sfc->use[7].more);
	CHECK(pou->rung_count == 6 && pou->il.count == 10);
	CHECK(sfc->transition[0].condition.kind == BODY_EXPRESSION &&
	      sfc->transition[4].condition.kind == BODY_LIST &&
	      sfc->transition[4].condition.count == 4);
	CHECK(sfc->step[1].line == 25 && sfc->step[1].column_at == 8);
	CHECK(sfc->ref[sfc->transition[1].first_to + 1].step == 2);
	CHECK(vars_declared(&pou->vars) == 7 && pou->vars.count == 7 + 2 * 6 + 1);
	project_free(project);
}

/* A written chart has its first and last comments. */
static void test_outline(void)
{
	struct sink_memory memory;
	struct project *project = read(whole, strlen(whole));

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	if (project)
		text_write_sfc(project, &project->pou[0], &sink);
	CHECK(!strncmp(sink_memory_text(&memory), "  // how it is operated\n", 24));
	CHECK(strstr(sink_memory_text(&memory), "  // last\n") != NULL);
	sink_memory_free(&memory);
	project_free(project);
}

struct marks {
	int count[TEXT_ACTION + 1], faults;
	const char *text;
};

static void take(void *context, const struct text_span *span)
{
	static const char *const ends[] = {
		[TEXT_STEP] = "END_STEP\n", [TEXT_TRANSITION] = "END_TRANSITION\n",
		[TEXT_ACTION] = "END_ACTION\n",
	};
	struct marks *marks = context;

	marks->count[span->part]++;
	if (span->part < TEXT_STEP)
		return;
	const char *end = ends[span->part];
	const size_t len = strlen(end);

	marks->faults += span->pou != 0 || span->len < len ||
			 memcmp(whole + span->at + span->len - len, end, len) != 0;
}

static void test_marks(void)
{
	struct marks marks = { 0 };
	struct project *project = read(whole, strlen(whole));
	size_t len = 0;

	free(project ? text_outline(project, &len, take, &marks) : NULL);
	CHECK(marks.count[TEXT_STEP] == 6 && marks.count[TEXT_TRANSITION] == 5 &&
	      marks.count[TEXT_ACTION] == 2 && marks.count[TEXT_RUNG] == 3);
	CHECK(!marks.faults);
	project_free(project);
}

/* ---- names ---- */

static const struct meaning *mean(struct scope *scope, struct project *project,
				  const char *text, enum diag_id *why)
{
	return scope_find(scope, &project->pou[0],
			  names_intern(&project->names, text, strlen(text)), why);
}

static void test_scope(void)
{
	static const char text[] = HEAD
		"  STEP S1:\n  END_STEP\n\n  STEP Fill:\n  END_STEP\nEND_PROGRAM\n";
	struct project *project = read(text, strlen(text));
	const struct meaning *m;
	struct scope *scope;
	struct arena arena;
	enum diag_id why;

	arena_init(&arena);
	scope = project ? scope_new(project, &arena) : NULL;
	CHECK(scope != NULL);
	if (!scope)
		return;
	m = mean(scope, project, "fILL.x", &why);
	CHECK(m && m->type == IEC_BOOL && !m->writable && !scope_is_condition(m));
	m = mean(scope, project, "Fill.T", &why);
	CHECK(m && m->type == IEC_TIME && !m->writable);
	m = mean(scope, project, "transition", &why);
	CHECK(m && m->writable && scope_is_condition(m));
	CHECK(!mean(scope, project, "Fill", &why) && why == DIAG_SFC_STEP);
	CHECK(!mean(scope, project, "fill.Q", &why) && why == DIAG_NO_PIN);
	/* The name wins over the address, as that of a variable does. */
	CHECK(!mean(scope, project, "S1", &why) && why == DIAG_SFC_STEP);
	CHECK(mean(scope, project, "S1.X", &why) != NULL);
	CHECK(mean(scope, project, "%SX0.1", &why) != NULL);
	CHECK(!mean(scope, project, "Nobody.X", &why) && why == DIAG_UNKNOWN_NAME);
	arena_free(&arena);
	project_free(project);
}

/* A renamed step is renamed in all places that name it. */
static void test_rename(void)
{
	struct ladder *ladder = ladder_new();
	struct ladder_rename how = { 0 };
	struct xref_target step = { XREF_STEP, 1, 1, { 0 } };
	struct xref_target action = { XREF_ACTION, 1, 0, { 0 } };
	size_t len;
	char *text;

	CHECK(ladder_load_text(ladder, "t.rung", whole, strlen(whole)));
	text = ladder_rename(ladder, &step, "Pour", &len, &how);
	CHECK(text && how.why == RENAME_GOOD && how.places == 7);
	CHECK(text && !strstr(text, "Fill ") && !strstr(text, "Fill.") &&
	      strstr(text, "NC Pour.X") && strstr(text, "LD    Pour.T") &&
	      strstr(text, "FROM (Pour, Mix)") && strstr(text, "TO (Pour, Mix)"));
	free(text);
	text = ladder_rename(ladder, &action, "Sum", &len, &how);
	CHECK(text && strstr(text, "Sum(P1);") && strstr(text, "ACTION Sum:"));
	free(text);
	CHECK(!ladder_rename(ladder, &step, "Count", &len, &how) &&
	      how.why == RENAME_TAKEN);
	CHECK(!ladder_rename(ladder, &step, "start", &len, &how) &&
	      how.why == RENAME_TAKEN);
	CHECK(!ladder_rename(ladder, &step, "TRANSITION", &len, &how) &&
	      how.why == RENAME_RESERVED);
	ladder_free(ladder);
}

/* ---- random damage ---- */

static uint32_t seed = 1;

static uint32_t below(uint32_t most)
{
	seed = seed * 1664525u + 1013904223u;
	return (seed >> 8) % most;
}

/* Removes, doubles or moves a piece of the text, or changes a byte. */
static size_t damage(char *text, size_t len)
{
	static const char signs[] = "():;,=.\n |\"*/NT";
	size_t at = below((uint32_t)len), piece = 1 + below(40), to;
	char kept[40];

	if (piece > len - at)
		piece = len - at;
	memcpy(kept, text + at, piece);
	switch (below(4)) {
	case 0:
		memmove(text + at, text + at + piece, len - at - piece);
		return len - piece;
	case 1:
		memmove(text + at + piece, text + at, len - at);
		return len + piece;
	case 2:
		memmove(text + at, text + at + piece, len - at - piece);
		to = below((uint32_t)(len - piece + 1));
		memmove(text + to + piece, text + to, len - piece - to);
		memcpy(text + to, kept, piece);
		return len;
	default:
		text[at] = signs[below(sizeof(signs) - 1)];
		return len;
	}
}

/* Swaps lines; many of these texts are read without an error. */
static size_t swap_lines(char *text, size_t len)
{
	size_t a = below((uint32_t)len), b;

	while (a > 0 && text[a - 1] != '\n')
		a--;
	for (b = a; b < len && text[b] != '\n'; b++)
		;
	b += b < len;
	memmove(text + a, text + b, len - b);
	return len - (b - a);
}

static void test_damage(void)
{
	char text[2 * sizeof(whole) + 400];
	int read_again = 0, unstable = 0;

	for (int i = 0; i < tap_rounds(20000) && !unstable; i++) {
		size_t len = sizeof(whole) - 1;

		seed = (uint32_t)i;
		memcpy(text, whole, len);
		for (uint32_t k = 1 + below(4); k > 0; k--)
			len = i % 3 ? damage(text, len) : swap_lines(text, len);
		unstable += !is_stable(text, len);
		read_again += diags.errors == 0;
	}
	CHECK(!unstable);
	printf("# %d damaged charts were read\n", read_again);
	CHECK(read_again > tap_rounds(1000));
}

int main(void)
{
	test_forms();
	test_in_order();
	test_model();
	test_outline();
	test_marks();
	test_scope();
	test_rename();
	test_damage();
	return tap_done();
}
