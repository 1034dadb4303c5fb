/* SPDX-License-Identifier: MIT
 *
 * test_code - values and results beside the list that a ladder is translated to.
 *
 * A written list with the same text is the judge: each line has the result that the written list
 * has after that line.
 */
#include "editor-gtk/panels/code_view.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/sim_mirror.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/text_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

#define VARS \
	"RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  B : BOOL;\n  C : BOOL;\n  M : BOOL;\n  L : BOOL;\n" \
	"  K : BOOL;\n  N : INT := 5;\n  T : TON;\n  U : CTU;\n" \
	"  Row : ARRAY[0..3] OF BOOL;\n  R : REAL;\n  Z : INT := 1;\nEND_VAR\n\n"

static const char ladder[] = VARS
	"PROGRAM Main LD\nRUNG Seal\n  | NO A   | NC B | COIL M |\n  | NO M  ^|\n"
	"RUNG Branches\n  | NO A | NO B   | NO M | S L    |\n  | NC C | NC A ^|\n"
	"RUNG Both\n  | NO B | NC C | COIL K |\n"
	"RUNG Timed\n  | NO A | TON T PT:=T#1s | NC B | COIL %QX0.0 |\n"
	"RUNG Compared\n  | NO C | [ N > 3 ] | NO B | R L |\n"
	"RUNG Edges\n  | P A | NOT | N B | COILP M |\n  | NO C | NO K ^|\n"
	"RUNG Counted\n  | P A | CTU U R:=C PV:=3 | COIL K |\n"
	"RUNG Boxes\n  | NO B | ADD IN1:=N IN2:=1 OUT=>N | [ R := N / 2.0 ] | NO A | NO B | S L |\n"
	"RUNG Indexed\n  | NO Row[Z] | COIL Row[1] |\n  | NO A | COIL M | COIL K |\n"
	"RUNG Nested\n  | NO A | NO B | NO C | COIL M |\n  | NO K | NO L ^| NO M ^|\n"
	"  | NC A ^| NC B | NC C ^|\nEND_PROGRAM\n";

static const char jumps[] = VARS
	"PROGRAM Main LD\nRUNG\n  | NO A | JMP Skip |\nRUNG\n  | NO B | COIL M |\n"
	"RUNG Skip\n  | NO C | COIL L |\nRUNG\n  | JMP End |\n  | NO A | COIL K |\n"
	"RUNG\n  | NO A | COIL M |\nRUNG End\n  | FOR N := 1 TO 3 |\nRUNG\n  | P C | COIL K |\n"
	"RUNG\n  | NEXT |\nRUNG\n  | NO A | RET |\nRUNG\n  | NO B | COIL K |\nEND_PROGRAM\n";

/* A ladder with its list, and the written list. */
static LadderDocument *document, *written;
static LadderLineValues *values;
static LadderTextView *view;
static LadderSim *sim, *judge;
static char **lines;
static int known; /* results at the last comparison                          */

static LadderDocument *opened(const char *text)
{
	LadderDocument *made = ladder_document_new();

	ladder_document_open_text(made, "/tmp/x/code.rung", text, strlen(text), true);
	ladder_document_check_now(made);
	return made;
}

static char *shown(void)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

static void set(LadderSim *to, const char *name, bool on)
{
	const struct act act = { .kind = ACT_SET, .value.i = on,
		.at = live_value_find(live_image(to, false), name) };

	ladder_sim_act(to, &act);
}

static void step(int bits)
{
	LadderSim *const both[] = { sim, judge };

	for (int i = 0; i < 2; i++) {
		set(both[i], "A", bits & 1);
		set(both[i], "B", bits & 2);
		set(both[i], "C", bits & 4);
		ladder_sim_scan(both[i], 1);
	}
}

static int line_of(const char *text)
{
	for (int i = 0; lines[i]; i++)
		if (strcmp(g_strstrip(lines[i]), text) == 0)
			return i;
	return -1;
}

/* May the result before it be one that nobody reads any more? */
static bool is_jump(const char *line)
{
	line += strspn(line, " ");
	return g_str_has_prefix(line, "JMP ") || strcmp(line, "RET") == 0;
}

/* The text of the view, which has values beside its lines. */
static LadderLineValues *beside_view(void)
{
	return LADDER_LINE_VALUES(find_type(GTK_WIDGET(view), LADDER_TYPE_LINE_VALUES));
}

/* Do both show these bits, and each line the result of the written list? */
static bool agree(int bits)
{
	static const char *const loads[] = { "LD    A", "LD    B", "LD    C" };
	bool good = true;

	known = 0;
	for (int i = 0; i < 3; i++) {
		const char *wanted = bits >> i & 1 ? "TRUE" : "FALSE";
		const int at = line_of(loads[i]);

		if (at >= 0)
			good &= g_strcmp0(line_values_text(values, at), wanted) == 0 &&
				g_strcmp0(line_values_text(beside_view(), at), wanted) == 0;
	}
	for (int i = 0; good && lines[i]; i++) {
		char *result = g_strdup(line_values_result(values, i));

		known += result != NULL;
		good = g_strcmp0(result, line_values_result(beside_view(), i)) == 0 ||
		       (!result && is_jump(lines[i]));
		if (!good)
			printf("# %d: %s: %s, %s\n", bits, lines[i], result,
			       line_values_result(beside_view(), i));
		g_free(result);
	}
	return good;
}

/* Begins the list that is shown in both. */
static bool begin_both(void)
{
	char *text = shown(), *list = g_strconcat(VARS, text, NULL);
	bool good;

	printf("# %s\n", text);
	lines = g_strsplit(text, "\n", -1);
	written = opened(list);
	view = g_object_ref_sink(LADDER_TEXT_VIEW(ladder_text_view_new(written, 0)));
	judge = ladder_sim_new(written);
	ladder_text_view_set_sim(view, judge);
	good = ladder_sim_begin(sim, NULL) && ladder_sim_begin(judge, NULL);
	if (good) { /* the first scan begins cold: it forgets what was set */
		step(0);
		WAIT(ladder_sim_twin(sim)->resource.scans && ladder_sim_twin(judge)->resource.scans);
	}
	g_free(list);
	g_free(text);
	return good;
}

static void end_both(void)
{
	ladder_sim_end(sim);
	g_object_unref(view);
	g_object_unref(judge);
	g_object_unref(written);
	g_strfreev(lines);
}

static bool has_result(const char *text, const char *result)
{
	return g_strcmp0(line_values_result(values, line_of(text)), result) == 0;
}

static void test_results(void)
{
	if (!CHECK(begin_both()))
		return;
	for (int bits = 1; bits < 24; bits++) { /* each one is seen by its inputs */
		step(bits ^ bits >> 1);
		CHECK_SOON(agree((bits ^ bits >> 1) & 7));
	}
	printf("# %d of %u lines\n", known, g_strv_length(lines));
	step(1);
	CHECK_SOON(agree(1));
	CHECK(has_result("LD    A", "TRUE") && has_result("OR    M", "TRUE") &&
	      has_result("ANDN  B", "TRUE") && has_result("ST    M", "TRUE"));
	CHECK_AS(has_result("END_PROGRAM", NULL) && has_result("VAR", NULL),
		 "only instructions have results");
	CHECK(ladder_sim_show(sim, 1));
	CHECK_AS(has_result("LD    A", "FALSE") && has_result("ST    M", "FALSE"),
		 "the results are those of the earlier scan");
	ladder_sim_end(sim);
	CHECK(has_result("ST    M", NULL));
	end_both();
}

static void test_jumps(void)
{
	if (!CHECK(begin_both()))
		return;
	for (int bits = 1; bits < 16; bits++) {
		step(bits ^ bits >> 1);
		CHECK_SOON(agree((bits ^ bits >> 1) & 7));
	}
	step(1);
	CHECK_SOON(agree(1));
	CHECK_AS(has_result("JMPC  Skip", "TRUE") && has_result("LD    B", "not run"),
		 "a line that was jumped over has not run");
	end_both();
}

/* ---- a chart ---- */

static const char chart[] =
	"RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  B : BOOL;\n  C : BOOL;\n  M : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Go:\n    Lamp(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Go:\n    RUNG\n      | NO A | NC B | COIL TRANSITION |\n"
	"  END_TRANSITION\n  TRANSITION FROM Go TO Start := C; END_TRANSITION\n"
	"  ACTION Lamp:\n    RUNG\n      | NO A | COIL M |\n      | NO B ^|\n  END_ACTION\nEND_PROGRAM\n";

/* Sets the inputs of the simulation alone. */
static void step_alone(int bits)
{
	judge = sim;
	step(bits);
}

static void test_chart(void)
{
	char *text;

	ladder_document_open_text(document, "/tmp/x/chart.rung", chart, strlen(chart), true);
	ladder_document_check_now(document);
	turn(0);
	text = shown();
	printf("# %s\n", text);
	lines = g_strsplit(text, "\n", -1);
	CHECK(ladder_sim_begin(sim, NULL));
	step_alone(0);
	WAIT(ladder_sim_twin(sim)->resource.scans);
	step_alone(3);
	CHECK_SOON(has_result("ANDN  B", "FALSE"));
	CHECK_AS(has_result("ST    M", "not run"), "an action that no step calls has not run");
	step_alone(1);
	step_alone(1);
	CHECK_SOON(has_result("ST    M", "TRUE"));
	/* Nor the condition of a step that is not active. */
	CHECK_SOON(has_result("OR    B", "TRUE") && has_result("ANDN  B", "not run"));
	ladder_sim_end(sim);
	g_strfreev(lines);
	g_free(text);
}

/* ---- a board ---- */

static struct twin board;

static void no_act(gpointer data, const struct act *act, int count)
{
	(void)data, (void)act, (void)count;
}

static const char *may(gpointer data, enum sim_wish wish)
{
	(void)data, (void)wish;
	return NULL;
}

static void nothing(gpointer data)
{
	(void)data;
}

/* What a board publishes: two bits a cell of the first program. */
static void publish(struct sim_mirror *mirror, const struct program *program)
{
	const guint8 *memory = board.resource.image.memory;
	guint8 bits[64] = { 0 };

	for (guint i = 0; i < program->power_count; i++)
		bits[i / 4] |= (guint8)((memory[program->power[i].in] |
			memory[program->power[i].out] << 1) << i % 4 * 2);
	sim_mirror_power(mirror, "Main", bits);
	sim_mirror_moment(mirror, &(struct sim_moment){ board.resource.state, board.scan,
							5000000000 + board.now_ns });
	turn(0);
}

/* A board has no results of the list, only power of cells, and its image is the same as before
 * results of lists were kept. */
static void test_board(void)
{
	struct sim_board of = { .name = "table", .period_ns = 10000000, .act = no_act,
				.why_not = may, .wanted = nothing, .past = nothing };
	char *text;

	ladder_document_open_text(document, "/tmp/x/list.rung", ladder, strlen(ladder), true);
	ladder_document_check_now(document);
	turn(0);
	text = shown();
	lines = g_strsplit(text, "\n", -1);
	of.program = ladder_sim_build(sim, NULL);
	CHECK_AS(!code_listed(of.program->program, 0, 1), "no board keeps the list");
	CHECK(twin_init(&board, of.program->program, NULL, 10000000) &&
	      twin_act(&board, &(struct act){ .kind = ACT_START }));
	for (int i = 0; i < 2; i++) {
		const struct location a = image_find(&board.resource.image, "A", 1);

		twin_scan(&board); /* the first scan begins cold */
		CHECK(image_set(&board.resource.image, a, (union iec_value){ .i = 1 }));
	}
	publish(ladder_sim_mirror_begin(sim, &of), of.program->program);
	CHECK_SOON(has_result("ANDN  B", "TRUE"));
	CHECK_AS(has_result("GT    3", NULL) || line_of("GT    3") < 0,
		 "a line that is no cell has none");
	ladder_sim_end(sim);
	twin_free(&board);
	sim_program_unref(of.program);
	g_strfreev(lines);
	g_free(text);
}

/* ---- the rung with the cursor ---- */

/* Is the cursor in the line that has @first, and the line visible? */
static bool is_at(const char *first)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	GtkTextIter at, end;
	GdkRectangle seen, line;
	char *text;
	bool is;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	end = at;
	gtk_text_iter_forward_to_line_end(&end);
	text = gtk_text_iter_get_text(&at, &end);
	gtk_text_view_get_visible_rect(GTK_TEXT_VIEW(values), &seen);
	gtk_text_view_get_iter_location(GTK_TEXT_VIEW(values), &at, &line);
	is = strstr(text, first) && line.y >= seen.y && line.y + line.height <= seen.y + seen.height;
	g_free(text);
	return is;
}

static void test_rung(GtkWidget *code)
{
	GString *text = g_string_new(VARS "PROGRAM Main LD\n");

	for (int i = 0; i < 100; i++)
		g_string_append_printf(text, "RUNG\n  | NO %%IX%d.%d | COIL M |\n", i / 8, i % 8);
	g_string_append(text, "END_PROGRAM\n");
	ladder_code_view_set_rung(code, 80);
	ladder_document_open_text(document, "/tmp/x/rungs.rung", text->str, text->len, true);
	ladder_document_check_now(document);
	CHECK_SOON(is_at("LD    %IX10.0"));
	ladder_code_view_set_rung(code, 60);
	CHECK_SOON(is_at("LD    %IX7.4"));
	ladder_code_view_set_rung(code, 1);
	CHECK_SOON(is_at("LD    %IX0.1"));
	ladder_code_view_set_rung(code, 100);
	CHECK_AS(is_at("LD    %IX0.1"), "a rung that is not there moves nothing");
	g_string_free(text, TRUE);
}

int main(void)
{
	GtkWidget *window, *code;

	if (!screen_start()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	gtk_init();
	adw_init();
	gtk_source_init();
	document = opened(ladder);
	sim = ladder_sim_new(document);
	code = ladder_code_view_new(document, sim);
	values = LADDER_LINE_VALUES(gtk_scrolled_window_get_child(GTK_SCROLLED_WINDOW(code)));
	window = gtk_window_new();
	gtk_window_set_child(GTK_WINDOW(window), code);
	screen_show(window);
	turn(0);
	test_results();
	ladder_document_open_text(document, "/tmp/x/jumps.rung", jumps, strlen(jumps), true);
	ladder_document_check_now(document);
	turn(0);
	test_jumps();
	test_chart();
	test_board();
	test_rung(code);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
