/* SPDX-License-Identifier: MIT
 *
 * test_sim_trace - what the panel of a simulation shows is what `ladder trace` shows after the
 * same clicks: every sample, and hundreds of random programs, with random clicks.
 *
 *   test_sim_trace [COUNT [SEED]]    so many random programs
 *
 * A click is one on a switch of the panel, or a value typed; what is compared is the text of
 * the widgets. The trace is run by itself, from a script of the same clicks.
 */
#include "editor-gtk/sim/live_value.h"
#include "tests/editor/panel_shown.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include "engine/trial/script.h"

#include <adwaita.h>
#include <math.h>
#include <stdlib.h>

#define PROGRAMS 100
#define STEPS 6
#define TEXT_MAX (128 * 1024)

static GtkWidget *window;
static LadderDocument *document;
static LadderSim *sim;
static LadderSimPanel *panel;
static guint64 compared, unseen;

/* ---- the panel ---- */

static bool is_running(void)
{
	return ladder_sim_twin(sim)->resource.state == STATE_RUN;
}

/* Runs the main loop until that scan is shown; false: it never is. */
static bool wait_for(guint64 scan)
{
	const gint64 end = g_get_monotonic_time() + 20 * G_USEC_PER_SEC;

	while (ladder_sim_twin(sim)->scan != scan && is_running() &&
	       g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, TRUE);
	while (g_main_context_iteration(NULL, FALSE))
		;
	return ladder_sim_twin(sim)->scan == scan;
}

/* A new reference; NULL: after the last. */
static LadderSimRow *row_at(guint at)
{
	return g_list_model_get_item(panel_list(panel), at);
}

/* Adds " Name=value" as in a trace, from the text of a widget. The panel shortens times and
 * REAL numbers: these get a ~ before the value. */
static void put(GString *out, const char *name, const char *pin, enum iec_type type,
		const char *text)
{
	const bool real = iec_type_row(type)->class == CLASS_REAL;
	struct iec_text room;
	union iec_value value;
	enum diag_id why;
	char plain[IEC_VALUE_TEXT + 1];

	if (type != IEC_TIME ||
	    !live_value_parse(FORMAT_AUTO, type, text, &room, &value, &why)) {
		g_string_append_printf(out, " %s%s=%s%s", name, pin, real ? "~" : "", text);
		return;
	}
	iec_value_print(type, value, plain, sizeof(plain));
	g_string_append_printf(out, " %s%s=~%s", name, pin, plain);
}

/* @all: also lines that are scrolled out of sight. */
static void put_row(GString *line, GString *columns, const LadderSimRow *row, bool all)
{
	char *(*shown)(LadderSimPanel *panel, const LadderSimRow *row) =
		row->kind == SIM_STEP ? panel_lamp : panel_shown;
	const bool timer = row->at.type == IEC_TIME;
	char *text = shown(panel, row), *slash;

	if (!text && all && ladder_sim_panel_select(panel, row->name))
		text = shown(panel, row);
	if (!text) {
		unseen += all;
		return;
	}
	compared++;
	slash = strstr(text, " / ");
	if (row->kind == SIM_STEP) {
		g_string_append_printf(columns, " %s.X", row->name);
		put(line, row->name, ".X", IEC_BOOL, text);
	} else if (row->kind != SIM_PRESET) {
		g_string_append_printf(columns, " %s", row->name);
		put(line, row->name, "", row->at.type, text);
	} else {
		*slash = '\0';
		g_string_append_printf(columns, timer ? " %s.ET %s.PT" : " %s.CV %s.PV",
				       row->name, row->name);
		put(line, row->name, timer ? ".ET" : ".CV", row->at.type, text);
		put(line, row->name, timer ? ".PT" : ".PV", row->preset.type, slash + 3);
	}
	g_free(text);
}

/* A heading or a line with parts has no value of its own. */
static bool has_value(const LadderSimRow *row)
{
	return row->kind != SIM_HEADING && row->kind != SIM_WHOLE;
}

/* Unfolds every line with parts. */
static void unfold_all(void)
{
	LadderSimRow *row;

	for (guint i = 0; (row = row_at(i)) != NULL; i++) {
		if (row->parts && row->folded)
			ladder_sim_row_view_fold(GTK_WIDGET(panel), row);
		g_object_unref(row);
	}
}

/* Adds the line that a trace has, from the text of all widgets. */
static void put_panel(GString *out, GString *columns, bool all)
{
	const struct twin *twin = ladder_sim_twin(sim);
	LadderSimRow *row;

	g_string_append_printf(out, "%d t=%.17g", (int)twin->scan, (double)twin->now_ns / 1e6);
	for (guint i = 0; (row = row_at(i)) != NULL; i++) {
		if (has_value(row))
			put_row(out, columns, row, all);
		g_object_unref(row);
	}
	g_string_append_c(out, '\n');
}

/* ---- clicks ---- */

static bool can_be_set(const LadderSimRow *row)
{
	return has_value(row) && row->kind != SIM_LAMP && !row->at.constant &&
	       row->kind != SIM_PRESET && row->kind != SIM_STEP && row->at.type != IEC_STRING;
}

/* A random number, inside or outside the range of the type. */
static void click(struct random_source *random, const LadderSimRow *row, GString *script)
{
	union iec_value value = live_value_get(sim, row->plant, row->at);
	char text[IEC_VALUE_TEXT + 1];

	if (sim_row_is_bit(row)) {
		g_string_append_printf(script, "%s=%d ", row->name, !value.i);
		sim_row_press(row, sim);
		sim_row_unpress(row, sim);
		return;
	}
	if (iec_type_row(row->at.type)->class == CLASS_REAL)
		value.r = random_below(random, 2000) / 8.0;
	else
		value.i = random_below(random, 100);
	iec_value_print(row->at.type, value, text, sizeof(text));
	g_string_append_printf(script, "%s=%s ", row->name, text);
	live_value_set(sim, row->plant, row->at, value);
}

static void click_some(struct random_source *random, GString *script)
{
	const guint rows = g_list_model_get_n_items(panel_list(panel));
	guint at = rows ? random_below(random, rows) : 0;

	for (guint n = random_below(random, 4); n && at < rows;
	     n--, at += 1 + random_below(random, rows)) {
		LadderSimRow *row = row_at(at);

		if (can_be_set(row))
			click(random, row, script);
		g_object_unref(row);
	}
}

static void move_some(struct random_source *random, GString *script, guint64 *scan)
{
	const guint scans = random_chance(random, 70) ? 1 : 1 + random_below(random, 60);

	g_string_append_printf(script, ". x%u quiet\n", scans);
	*scan += scans;
	ladder_sim_scan(sim, (int)scans);
}

/* ---- the trace ---- */

/* The output of `ladder trace` for the running program. Caller frees. */
static char *trace_of(const char *script)
{
	const struct program *program = ladder_program(ladder_sim_ladder(sim));
	void *memory = g_malloc0(image_memory_size(program));
	struct sink_memory text;
	struct sink sink;
	struct diag_list diags;
	struct resource resource;
	struct trace trace;
	char *out;

	diag_init(&diags);
	resource_init(&resource, program, memory);
	sink_memory_init(&text);
	sink = sink_to_memory(&text);
	trace_init(&trace, &resource.image, &sink, TRACE_LINES, false);
	trace.project = ladder_project(ladder_sim_ladder(sim));
	script_run("clicks", script, strlen(script), ladder_sim_period(sim), &resource, NULL,
		   &trace, &diags);
	for (int i = 0; i < diags.count && diags.diag[i].id != DIAG_FAULT; i++)
		printf("# %s\n", diags.diag[i].arg);
	out = g_strdup(sink_memory_text(&text));
	trace_free(&trace);
	sink_memory_free(&text);
	g_free(memory);
	return out;
}

/* How exactly a time of so many ms is shown: to 1 ms below a second, to 0.1 s below a minute. */
static double step_of(double ms)
{
	return fabs(ms) < 1000 ? 1 : fabs(ms) < 60000 ? 100 : 1000;
}

/* Is @shown the same, or a shortened form of @exact? Times are cut; an ET is shown as exactly as
 * its PT, the @next word. A REAL has six digits. */
static bool agrees(const char *shown, const char *exact, const char *next)
{
	const char *value = strchr(shown, '~');
	const gsize name = value ? (gsize)(value - shown) : 0;
	const char *preset = next && strstr(exact, ".ET=") ? strstr(next, ".PT=") : NULL;
	double got, want, step;

	if (!value || strncmp(shown, exact, name) != 0)
		return strcmp(shown, exact) == 0;
	got = g_ascii_strtod(value + 1, NULL);
	want = g_ascii_strtod(exact + name, NULL);
	step = MAX(step_of(want), preset ? step_of(g_ascii_strtod(preset + 4, NULL)) : 0);
	return got == want || fabs(want - got) <= 1e-5 * fabs(want) ||
	       (fabs(got) <= fabs(want) && fabs(want - got) < step);
}

/* Do all words of two traces agree? */
static bool agree(const char *shown, const char *exact)
{
	char **is = g_strsplit_set(shown, " \n", -1), **ought = g_strsplit_set(exact, " \n", -1);
	guint i = 0;

	while (is[i] && ought[i] && agrees(is[i], ought[i], ought[i + 1]))
		i++;
	const bool same = !is[i] && !ought[i];

	g_strfreev(is);
	g_strfreev(ought);
	return same;
}

static void tell_difference(const char *what, const char *got, const char *want,
			    const char *script)
{
	char **is = g_strsplit_set(got, " \n", -1), **ought = g_strsplit_set(want, " \n", -1);
	guint i = 0;

	while (is[i] && ought[i] && agrees(is[i], ought[i], ought[i + 1]))
		i++;
	printf("# %s: the panel has %s, the trace %s\n", what, is[i] ? is[i] : "no more",
	       ought[i] ? ought[i] : "no more");
	g_strfreev(is);
	is = g_strsplit(script, "\n", -1);
	for (i = 0; is[i]; i++)
		if (is[i][0] != '@')
			printf("#   %s\n", is[i]);
	g_strfreev(is);
	g_strfreev(ought);
}

/* Drops the remark that the program stopped, which only a trace has. */
static void drop_remarks(char *trace)
{
	char *remark = strstr(trace, "\n# ");

	if (remark)
		remark[1] = '\0';
}

/* Runs one program with random clicks and compares. */
static bool play(const char *what, guint64 seed)
{
	GString *got = g_string_new(NULL), *script = g_string_new(NULL);
	struct random_source random;
	guint64 scan = 0;
	char *want;
	bool same;

	random_seed(&random, seed);
	ladder_sim_reset(sim, false);
	while (!is_running())
		g_main_context_iteration(NULL, TRUE);
	for (int i = 0; i < STEPS && is_running(); i++) {
		GString *columns = g_string_new("@print"), *step = g_string_new(NULL);

		click_some(&random, step);
		move_some(&random, step, &scan);
		if (wait_for(scan) || !is_running()) {
			put_panel(got, columns, i + 1 == STEPS);
			g_string_append_printf(script, "%s\n%s", columns->str, step->str);
		}
		g_string_free(columns, TRUE);
		g_string_free(step, TRUE);
	}
	want = trace_of(script->str);
	drop_remarks(want);
	same = agree(got->str, want);
	if (!same)
		tell_difference(what, got->str, want, script->str);
	g_free(want);
	g_string_free(script, TRUE);
	g_string_free(got, TRUE);
	return same;
}

/* ---- programs ---- */

/* 1: equal, 0: not, -1: not built. */
static int play_text(const char *what, const char *text, gsize len, guint64 seed)
{
	int same;

	ladder_sim_end(sim);
	ladder_document_open_text(document, what, text, len, true);
	if (!ladder_sim_begin(sim, NULL))
		return -1;
	while (g_main_context_iteration(NULL, FALSE))
		;
	unfold_all();
	gtk_test_widget_wait_for_draw(window);
	same = play(what, seed);
	return same;
}

static void test_samples(void)
{
	GDir *folder = g_dir_open("ladders", 0, NULL);
	const char *name;
	int count = 0;

	while (folder && (name = g_dir_read_name(folder)) != NULL) {
		char *path = g_build_filename("ladders", name, NULL), *text;
		gsize len;

		if (g_str_has_suffix(name, ".rung") &&
		    g_file_get_contents(path, &text, &len, NULL)) {
			count++;
			CHECK_AS(play_text(path, text, len, 1) == 1, path);
			g_free(text);
		}
		g_free(path);
	}
	if (folder)
		g_dir_close(folder);
	CHECK_AS(count > 5, "some samples were compared");
}

static void test_random(guint64 first, int count)
{
	struct random_program *program = g_new(struct random_program, 1);
	char *text = g_malloc(TEXT_MAX), name[64];
	int played = 0, bad = 0;

	for (guint64 seed = first; played < count && seed < first + 10 * (guint64)count;
	     seed++) {
		random_make(program, seed);
		g_snprintf(name, sizeof(name), "seed %" G_GUINT64_FORMAT, seed);
		switch (play_text(name, text, random_print(program, text, TEXT_MAX), seed)) {
		case 0: bad++; /* fall through */
		case 1: played++; break;
		default: break;
		}
	}
	printf("# %d random programs\n", played);
	CHECK_AS(played == count, "the wanted number of programs was built");
	CHECK_AS(bad == 0, "random programs: the panel equals the trace");
	g_free(text);
	g_free(program);
}

int main(int argc, char **argv)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	sim = ladder_sim_new(document);
	panel = LADDER_SIM_PANEL(ladder_sim_panel_new(sim));
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), 290, 860);
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(panel));
	gtk_window_present(GTK_WINDOW(window));
	test_samples();
	test_random(argc > 2 ? (guint64)atoll(argv[2]) : 1, argc > 1 ? atoi(argv[1]) : PROGRAMS);
	printf("# %" G_GUINT64_FORMAT " texts of widgets compared, %" G_GUINT64_FORMAT
	       " lines had none\n", compared, unseen);
	CHECK_AS(compared > 1000 && unseen == 0, "each compared line has a widget");
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
