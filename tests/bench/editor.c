/* SPDX-License-Identifier: MIT
 *
 * editor - measures the editor with a large program, inside the process.
 *
 * usage: editor FILE SAMPLE [WORD]
 *   WORD: only actions whose name contains it, and the simulation
 *
 * Prints medians beside the targets, and never fails: the start with the sample, opening
 * the file, frames while scrolling, the time from a key to the picture (without waiting for
 * the next frame of the screen), memory, work while idle, and the simulation. Beside the
 * time by the clock it prints processor time, which depends less on other programs: of the
 * process for a start, of the drawing thread for keys.
 */
#include "editor-gtk/window/app.h"
#include "editor-gtk/window/window.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/kit/memory.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/fbd/fbd_view.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "editor-gtk/text/text_view.h"
#include "tests/bench/editor_ground.h"
#include "tests/bench/editor_start.h"
#include "tests/editor/sim_seen.h"
#include "tests/editor/strips.h"
#include "tests/editor/widgets.h"

#include <gtksourceview/gtksource.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define ROUNDS 60
#define IDLE_S 5
#define SIM_S  5
#define SIM_FRAMES 1000

static struct {
	gint64 begun, spent; /* us, last frame                                 */
	gint64 at, worked;   /* processor time of this thread                   */
	int frames;
} frame;

/* Processor time of this thread in us. */
static gint64 worked(void)
{
	struct timespec now;

	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return (gint64)now.tv_sec * G_USEC_PER_SEC + now.tv_nsec / 1000;
}

static void before(void)
{
	frame.begun = g_get_monotonic_time();
	frame.at = worked();
}

static void after(void)
{
	frame.spent = g_get_monotonic_time() - frame.begun;
	frame.worked = worked() - frame.at;
	frame.frames++;
}

static gboolean quit(gpointer loop)
{
	g_main_loop_quit(loop);
	return G_SOURCE_REMOVE;
}

/* Waits asleep, as the editor does. */
static void settle(guint ms)
{
	GMainLoop *loop = g_main_loop_new(NULL, FALSE);

	g_timeout_add(ms, quit, loop);
	g_main_loop_run(loop);
	g_main_loop_unref(loop);
}

static void next_frame(void)
{
	const int seen = frame.frames;
	const gint64 end = g_get_monotonic_time() + G_USEC_PER_SEC;

	while (frame.frames == seen && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, TRUE);
}

/* One action: @prepare (or NULL) is not measured; @act and the frame that shows it are.
 * Then it waits until the editor is idle. */
struct deed {
	const char *name, *most;
	void (*prepare)(LadderGridView *sheet, int round);
	void (*act)(LadderGridView *sheet, int round);
	int rounds;
	guint rest;          /* ms                                             */
};

/* us by the clock; not static, so that profilers show its name. */
static G_GNUC_NO_INLINE gint64 act_and_show(const struct deed *deed,
					    LadderGridView *sheet, int round)
{
	const gint64 begin = g_get_monotonic_time();
	gint64 spent;

	deed->act(sheet, round);
	spent = g_get_monotonic_time() - begin;
	next_frame();
	return spent + frame.spent;
}

static void measure(const struct deed *deed, LadderGridView *sheet)
{
	gint64 clock[ROUNDS], thread[ROUNDS], all[ROUNDS];
	const int rounds = deed->rounds;

	for (int i = 0; i < rounds; i++) {
		gint64 begun;

		if (deed->prepare) {
			deed->prepare(sheet, i);
			settle(deed->rest);
		}
		begun = worked();
		clock[i] = act_and_show(deed, sheet, i);
		thread[i] = worked() - begun;
		settle(deed->rest);
		all[i] = worked() - begun;
	}
	printf("| %s | %.2f | %.2f |", deed->name, median(thread, rounds),
	       median(clock, rounds));
	printf(" %.2f | %.2f | %s |\n", (double)clock[rounds - 1] / 1000,
	       median(all, rounds), deed->most);
	fflush(stdout);
}

/* ---- actions of a person ---- */

static void scroll(LadderGridView *sheet, int round)
{
	GtkAdjustment *down = gtk_scrollable_get_vadjustment(GTK_SCROLLABLE(sheet));

	(void)round;
	gtk_adjustment_set_value(down, gtk_adjustment_get_value(down) + 40);
}

static void page(LadderGridView *sheet, int round)
{
	GtkAdjustment *down = gtk_scrollable_get_vadjustment(GTK_SCROLLABLE(sheet));

	(void)round;
	gtk_adjustment_set_value(down, gtk_adjustment_get_value(down) + 700);
}

static void move(LadderGridView *sheet, int round)
{
	ladder_grid_view_go(sheet, 2500, 0, round & 1);
}

static void to_contact(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_grid_view_go(sheet, 2500, 0, 0);
}

static void negate(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_canvas_do(LADDER_CANVAS(sheet), VERB_negate);
}

static void add_rung(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_canvas_do(LADDER_CANVAS(sheet), VERB_rung_below);
}

static void undo(LadderGridView *sheet, int round)
{
	(void)round;
	gtk_widget_activate_action(GTK_WIDGET(sheet), "win.undo", NULL);
}

static GtkWidget *line_of(LadderGridView *sheet)
{
	return find_type(GTK_WIDGET(sheet), GTK_TYPE_ENTRY);
}

/* Closes an open line; on the sheet itself, Esc would revert the rung. */
static void free_cell(LadderGridView *sheet, int round)
{
	(void)round;
	if (line_of(sheet) && gtk_widget_get_mapped(line_of(sheet)))
		ladder_canvas_do(LADDER_CANVAS(sheet), VERB_cancel);
	ladder_grid_view_go(sheet, 2500, 0, 0);
}

/* The letter that opens the line. */
static void open_entry(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_canvas_do(LADDER_CANVAS(sheet), VERB_block);
}

static void with_entry(LadderGridView *sheet, int round)
{
	if (!line_of(sheet) || !gtk_widget_get_mapped(line_of(sheet)))
		open_entry(sheet, round);
}

static void letter(LadderGridView *sheet, int round)
{
	char text[] = { (char)('a' + round % 26), '\0' };
	int at = -1;

	gtk_editable_insert_text(GTK_EDITABLE(line_of(sheet)), text, -1, &at);
}

static void typed(LadderGridView *sheet, const char *format, int round)
{
	char text[40];

	free_cell(sheet, round);
	open_entry(sheet, round);
	settle(50);
	g_snprintf(text, sizeof(text), format, round);
	gtk_editable_set_text(GTK_EDITABLE(line_of(sheet)), text);
}

static void type_known(LadderGridView *sheet, int round)
{
	typed(sheet, "In%d", round);
}

static void type_fresh(LadderGridView *sheet, int round)
{
	typed(sheet, "Fresh%d", round);
}

static void type_timer(LadderGridView *sheet, int round)
{
	typed(sheet, "TON Wait%d", round);
}

static void enter(LadderGridView *sheet, int round)
{
	(void)round;
	g_signal_emit_by_name(line_of(sheet), "activate");
}

static const struct deed deeds[] = {
	{ "scroll by 40 px", "2", NULL, scroll, ROUNDS, 20 },
	{ "scroll by a page", "2", NULL, page, ROUNDS, 20 },
	{ "move the cursor", "16", NULL, move, ROUNDS, 20 },
	{ "negate a contact", "16", to_contact, negate, 20, 250 },
	{ "the key that opens an entry", "16", free_cell, open_entry, 20, 100 },
	{ "a letter into it", "16", with_entry, letter, 20, 100 },
	{ "Enter: an element", "16", type_known, enter, 20, 250 },
	{ "Enter: a new symbol", "16", type_fresh, enter, 20, 250 },
	{ "Enter: a new timer", "16", type_timer, enter, 10, 250 },
	{ "undo of that", "16", NULL, undo, 10, 250 },
	{ "undo of a new symbol", "16", NULL, undo, 20, 250 },
	{ "undo of an element", "16", NULL, undo, 20, 250 },
	{ "a new rung", "16", NULL, add_rung, 20, 250 },
};

/* ---- the share of the toolkit ---- */

static void watch_frames(GtkWidget *window)
{
	GdkFrameClock *clock = gdk_surface_get_frame_clock(
		gtk_native_get_surface(GTK_NATIVE(window)));

	g_signal_connect(clock, "before-paint", G_CALLBACK(before), NULL);
	g_signal_connect(clock, "after-paint", G_CALLBACK(after), NULL);
	next_frame();
}

static GtkWidget *ground;

static void change_ground(LadderGridView *sheet, int round)
{
	(void)sheet;
	(void)round;
	ground_change(ground);
}

/* As many pixels as the rungs in the view, without drawing: the difference is our share. */
static void measure_ground(LadderGridView *sheet)
{
	static const struct deed deed = {
		"as many pixels, nothing drawn", "-", NULL, change_ground, ROUNDS, 20 };
	GtkAdjustment *across = gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(sheet));

	ground = ground_window((int)gtk_adjustment_get_upper(across),
			       gtk_widget_get_height(GTK_WIDGET(sheet)));
	watch_frames(ground);
	settle(500);
	measure(&deed, sheet);
	gtk_window_destroy(GTK_WINDOW(ground));
	settle(500);
}

/* ---- simulation ---- */

static long memory(void)
{
	const char *line;
	char *text = NULL;
	long kb = 0;

	if (g_file_get_contents("/proc/self/status", &text, NULL, NULL)) {
		line = strstr(text, "VmRSS:");
		kb = line ? strtol(line + 6, NULL, 10) : 0;
	}
	g_free(text);
	return kb / 1024;
}

static void idle(void)
{
	const int frames = frame.frames;
	const gint64 process = process_worked();
	gint64 used;

	settle(IDLE_S * 1000);
	used = process_worked() - process;
	printf("Idle and unchanged for %d s: %d frames, %.1f ms of the processor, %.2f %% "
	       "(0 and 0).\n", IDLE_S, frame.frames - frames, (double)used / 1000,
	       (double)used / (IDLE_S * 1e6) * 100);
}

/* Runs at its period: the time of a frame in the thread that draws, and the processor
 * time of this thread and of the whole editor. */
static void simulate(GtkWidget *window, LadderGridView *sheet)
{
	StripsSeen *seen_last = NULL;
	guint drawn = 0;
	gint64 begun, process, draws = 0, work[SIM_FRAMES];
	int frames = 0, worst = 0;
	gint64 end;

	gtk_widget_activate_action(window, verb_row(VERB_sim_run)->action, NULL);
	settle(3000);
	begun = worked();
	process = process_worked();
	strips_redrawn(sheet, &seen_last);
	end = g_get_monotonic_time() + SIM_S * G_USEC_PER_SEC;
	for (int seen = frame.frames; g_get_monotonic_time() < end;) {
		g_main_context_iteration(NULL, TRUE);
		if (frame.frames == seen)
			continue;
		seen = frame.frames;
		drawn += strips_redrawn(sheet, &seen_last);
		draws += frame.worked;
		worst = MAX(worst, (int)frame.worked);
		if (frames < SIM_FRAMES)
			work[frames] = frame.worked;
		frames++;
	}
	if (frames == 0)
		work[frames++] = 0;
	printf("Simulating: %.0f frames and %.0f rungs drawn a second; of the thread a frame takes %.2f ms, the "
	       "worst %.2f (2); thread %.1f %%, frames alone %.1f %%, the whole editor "
	       "%.1f %% of a processor.\n", (double)frames / SIM_S,
	       (double)drawn / SIM_S,
	       median(work, MIN(frames, SIM_FRAMES)), (double)worst / 1000,
	       (double)(worked() - begun) / (SIM_S * 1e4), (double)draws / (SIM_S * 1e4),
	       (double)(process_worked() - process) / (SIM_S * 1e4));
	g_ptr_array_unref(seen_last);
	gtk_widget_activate_action(window, verb_row(VERB_sim_mode)->action, NULL);
}

/* ---- the scan thread, and earlier scans ---- */

static void print_late(LadderSim *sim, const char *what)
{
	struct sim_lateness before, late;

	settle(1000);
	ladder_sim_lateness(sim, &before);
	settle(SIM_S * 1000);
	ladder_sim_lateness(sim, &late);
	for (int i = 0; i < SIM_LATE_STEPS; i++)
		late.count[i] -= before.count[i];
	printf("Lateness of the scan thread, %s: median %.2f ms, 99 %% %.2f ms, "
	       "worst %.2f ms, of %llu scans.\n", what, sim_lateness_us(&late, 0.5) / 1000,
	       sim_lateness_us(&late, 0.99) / 1000, sim_lateness_us(&late, 1) / 1000,
	       (unsigned long long)sim_lateness_scans(&late));
	fflush(stdout);
}

/* Drawing must not delay scans: the same with a hidden window. */
static void late(GtkWidget *window)
{
	gtk_widget_activate_action(window, verb_row(VERB_sim_run)->action, NULL);
	print_late(sim_seen, "while it is drawn");
	gtk_widget_set_visible(window, FALSE);
	print_late(sim_seen, "while nothing is drawn");
	gtk_widget_set_visible(window, TRUE);
	print_late(sim_seen, "while it is drawn again");
}

/* Any scan of a record of 100,000: from ladder_sim_show() until its frame is drawn. */
static void past(GtkWidget *window)
{
	LadderSim *sim = sim_seen;
	gint64 clock[ROUNDS], shown[ROUNDS], thread[ROUNDS];
	guint64 first, last, scan = 1;
	double known, seen, spent;

	ladder_sim_pause(sim);
	ladder_sim_scan(sim, 100000);
	for (int i = 0; i < 600 && ladder_sim_last(sim) < 100000; i++)
		settle(100);
	first = ladder_sim_first(sim);
	last = ladder_sim_last(sim);
	settle(2000);
	for (int i = 0; i < ROUNDS; i++) {
		const gint64 begin = g_get_monotonic_time(), begun = worked();

		scan = first + (scan * 48271 + 11) % (last - first);
		ladder_sim_show(sim, scan);
		shown[i] = g_get_monotonic_time() - begin;
		next_frame();
		clock[i] = shown[i] + frame.spent;
		thread[i] = worked() - begun;
		settle(40);
	}
	known = median(shown, ROUNDS);
	seen = median(clock, ROUNDS); /* median() has sorted them */
	spent = median(thread, ROUNDS);
	printf("Showing any of %llu scans: median %.2f ms until all views know, %.2f ms with "
	       "its frame; worst %.2f ms (16); of the thread %.2f, worst %.2f.\n",
	       (unsigned long long)(last - first), known, seen,
	       (double)clock[ROUNDS - 1] / 1000, spent, (double)thread[ROUNDS - 1] / 1000);
	ladder_sim_show_now(sim);
	ladder_sim_stop(sim);
	settle(3000);
	printf("In STOP. ");
	idle();
	gtk_widget_activate_action(window, verb_row(VERB_sim_mode)->action, NULL);
}

/* ---- a chart, networks, a list ---- */

#define SOME_ROUNDS 40

static void scroll_chart(GtkWidget *chart, int round)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(chart, GTK_TYPE_SCROLLED_WINDOW);

	gtk_adjustment_set_value(gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(scroller)), 100 + 60 * round);
}

static void edit_chart(GtkWidget *chart, int round)
{
	(void)round;
	ladder_canvas_do(LADDER_CANVAS(chart), VERB_step_below);
}

static void edit_networks(GtkWidget *networks, int round)
{
	(void)round;
	ladder_canvas_do(LADDER_CANVAS(networks), VERB_network_below);
}

static void measure_one(GtkWidget *widget, const char *name,
			void (*act)(GtkWidget *widget, int round))
{
	gint64 thread[SOME_ROUNDS];

	for (int i = 0; i < SOME_ROUNDS; i++) {
		const gint64 begun = worked();

		act(widget, i);
		next_frame();
		thread[i] = worked() - begun;
		settle(100);
	}
	const double middle = median(thread, SOME_ROUNDS); /* sorts them */

	printf("%s: %.2f ms of the thread until its picture, worst %.2f.\n", name, middle,
	       (double)thread[SOME_ROUNDS - 1] / 1000);
}

static void type_in_list(GtkWidget *text, int round)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(text));

	gtk_text_buffer_insert_interactive_at_cursor(buffer, round % 8 ? "1" : "\n  LD %MX1.", -1,
						     TRUE);
}

/* A list after all those rungs. Half of the letters leave it readable. */
static void measure_list(GtkWidget *window, LadderDocument *document)
{
	const int pou = ladder_document_project(document)->pou_count;
	GtkTextBuffer *buffer;
	GtkTextIter at;
	GtkWidget *text;

	g_free(pou_add(document, POU_PROGRAM, LANGUAGE_IL, "Measured"));
	gtk_widget_activate_action(window, "win.go-to", "(iiii)", pou, 0, -1, -1);
	settle(1000);
	text = find_type(find_type(window, LADDER_TYPE_TEXT_VIEW), GTK_TYPE_TEXT_VIEW);
	buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(text));
	gtk_text_buffer_get_iter_at_line(buffer, &at, 1);
	gtk_text_iter_forward_to_line_end(&at);
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_widget_grab_focus(text);
	settle(1000);
	measure_one(text, "A letter in a list", type_in_list);
	while (ladder_document_project(document)->pou_count > pou &&
	       ladder_document_undo(document))
		;
	settle(1000);
}

/* The window has been told that the simulation runs another program. */
static void program_runs(gint64 *at)
{
	*at = g_get_monotonic_time();
}

/* @first: puts the cursor near the end. Returns the time. */
static gint64 letter_ready(GtkTextBuffer *buffer, bool first)
{
	GtkTextIter at;

	if (first) {
		gtk_text_buffer_get_end_iter(buffer, &at);
		gtk_text_iter_backward_lines(&at, 2);
		gtk_text_iter_forward_to_line_end(&at);
		gtk_text_buffer_place_cursor(buffer, &at);
		settle(1000);
	}
	return g_get_monotonic_time();
}

/* All blocks of a text are folded and unfolded, each time until the picture; then a letter while all are
 * folded. */
static void measure_folding(GtkWidget *window, GtkWidget *text)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(text));
	static const enum verb verbs[] = { VERB_fold_all, VERB_unfold_all };
	gint64 clock[2][SOME_ROUNDS], letter[2][SOME_ROUNDS];
	GtkTextIter at;

	gtk_text_buffer_get_start_iter(buffer, &at);
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_widget_grab_focus(text);
	settle(1000);
	for (int i = 0; i < 2 * SOME_ROUNDS; i++) {
		const gint64 begin = g_get_monotonic_time();

		gtk_widget_activate_action(window, verb_row(verbs[i % 2])->action, NULL);
		clock[i % 2][i / 2] = g_get_monotonic_time() - begin;
		next_frame();
		settle(300);
	}
	for (int i = 0; i < 2 * SOME_ROUNDS; i++) {
		const gint64 begin = letter_ready(buffer, i == 0);

		gtk_text_buffer_insert_interactive_at_cursor(buffer, " ", -1, TRUE);
		next_frame();
		letter[i % 2][i / 2] = g_get_monotonic_time() - begin;
		gtk_widget_activate_action(window, verb_row(verbs[i % 2])->action, NULL);
		settle(300);
	}
	printf("Folding all blocks of %d lines: %.1f ms by the clock (50), unfolding them %.1f; a letter to its picture while all are folded %.1f, unfolded %.1f ms.\n",
	       gtk_text_buffer_get_line_count(buffer), median(clock[0], SOME_ROUNDS),
	       median(clock[1], SOME_ROUNDS), median(letter[1], SOME_ROUNDS), median(letter[0], SOME_ROUNDS));
}

static int lines_of(LadderDocument *document)
{
	char *text = ladder_document_text(document, NULL);
	int lines = 0;

	for (const char *at = text; (at = strchr(at, '\n')) != NULL; at++)
		lines++;
	g_free(text);
	return lines;
}

static GtkWidget *text_in(GtkWidget *window)
{
	return find_type(find_type(window, LADDER_TYPE_TEXT_VIEW), GTK_TYPE_TEXT_VIEW);
}

/* From a letter in the middle of Structured Text until the simulation runs it, by the clock. Of many POUs, the
 * one in the middle is changed. */
static void measure_change(GtkWidget *window, LadderDocument *document)
{
	const int pous = ladder_document_project(document)->pou_count;
	GtkTextBuffer *buffer;
	GtkWidget *text;
	gint64 clock[SOME_ROUNDS], picture[SOME_ROUNDS], thread[SOME_ROUNDS], all[SOME_ROUNDS], runs = 0;
	GtkTextIter at, end;

	if (pous > 2)
		gtk_widget_activate_action(window, "win.go-to", "(iiii)", pous / 2, 0, -1, -1);
	settle(500);
	text = pous > 2 ? gtk_root_get_focus(GTK_ROOT(window)) : text_in(window);
	if (!GTK_IS_TEXT_VIEW(text))
		return;
	buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(text));
	gtk_widget_activate_action(window, verb_row(VERB_sim_run)->action, NULL);
	gtk_text_buffer_get_iter_at_line(buffer, &at, gtk_text_buffer_get_line_count(buffer) / 2);
	if (!gtk_text_iter_forward_search(&at, " + 1;", 0, &at, &end, NULL))
		return;
	gtk_text_iter_forward_chars(&at, 4);
	gtk_text_buffer_place_cursor(buffer, &at);
	gtk_widget_grab_focus(text);
	settle(3000);
	g_signal_connect_swapped(sim_seen, "program-changed", G_CALLBACK(program_runs), &runs);
	for (int i = 0; i < SOME_ROUNDS; i++) {
		const gint64 begin = g_get_monotonic_time(), last = begin + 5 * G_USEC_PER_SEC;
		const gint64 begun = worked(), process = process_worked();

		runs = 0;
		gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
		end = at;
		if (i % 2) /* 1 is 12, and 1 again */
			gtk_text_buffer_backspace(buffer, &end, TRUE, TRUE);
		else
			gtk_text_buffer_insert_interactive_at_cursor(buffer, "2", -1, TRUE);
		while (!runs && g_get_monotonic_time() < last)
			g_main_context_iteration(NULL, TRUE);
		clock[i] = (runs ? runs : last) - begin;
		thread[i] = worked() - begun;
		all[i] = process_worked() - process;
		next_frame();
		picture[i] = g_get_monotonic_time() - begin;
		settle(600);
	}
	const double middle = median(clock, SOME_ROUNDS); /* sorts them */

	printf("A changed line of %d, of %d POUs, to the simulation that runs it: %.1f ms by the clock (50), least %.1f, worst %.1f; to its picture %.1f; of the processor %.1f until it runs, of these %.1f in the thread that draws.\n",
	       lines_of(document), pous, middle, (double)clock[0] / 1000,
	       (double)clock[SOME_ROUNDS - 1] / 1000, median(picture, SOME_ROUNDS),
	       median(all, SOME_ROUNDS), median(thread, SOME_ROUNDS));
}

static void run(AdwApplication *application, const char *path, const char *word)
{
	const gint64 begin = g_get_monotonic_time(), begun = worked();
	LadderDocument *document = ladder_document_new();
	LadderWindow *window;
	GtkWidget *sheet, *chart, *networks;

	if (!ladder_document_open(document, path, NULL))
		exit(2);
	printf("Reading: %.1f ms by the clock, %.1f ms of the processor.\n",
	       (double)(g_get_monotonic_time() - begin) / 1000,
	       (double)(worked() - begun) / 1000);
	sim_watch();
	window = ladder_window_new(application, document);
	gtk_window_present(GTK_WINDOW(window));
	watch_frames(GTK_WIDGET(window));
	chart = find_type(GTK_WIDGET(window), LADDER_TYPE_SFC_VIEW);
	printf("Opening, to the first picture: %.1f ms by the clock, %.1f ms of the "
	       "processor (%d).\n", (double)(g_get_monotonic_time() - begin) / 1000,
	       (double)(worked() - begun) / 1000, chart ? 300 : 500);
	settle(4000);
	if (chart) {
		measure_one(chart, "Scrolling", scroll_chart);
		measure_one(chart, "A step more", edit_chart);
		g_object_unref(document);
		return;
	}
	networks = find_type(GTK_WIDGET(window), LADDER_TYPE_FBD_VIEW);
	if (networks) {
		measure_one(networks, "Scrolling", scroll_chart);
		measure_one(networks, "A network more", edit_networks);
		g_object_unref(document);
		return;
	}
	if (find_type(GTK_WIDGET(window), LADDER_TYPE_TEXT_VIEW)) {
		if (!*word)
			measure_folding(GTK_WIDGET(window), text_in(GTK_WIDGET(window)));
		measure_change(GTK_WIDGET(window), document);
		g_object_unref(document);
		return;
	}
	printf("Memory: %ld MB (200).\n", memory());
	idle();
	sheet = find_type(GTK_WIDGET(window), LADDER_TYPE_GRID_VIEW);
	gtk_widget_grab_focus(sheet);
	printf("\n| what | thread until its picture, ms | clock, ms | worst, ms | "
	       "thread until all is done, ms | asked |\n|---|---|---|---|---|---|\n");
	measure_ground(LADDER_GRID_VIEW(sheet));
	for (gsize i = 0; i < G_N_ELEMENTS(deeds); i++)
		if (strstr(deeds[i].name, word))
			measure(&deeds[i], LADDER_GRID_VIEW(sheet));
	free_cell(LADDER_GRID_VIEW(sheet), 0);
	settle(6000); /* scrollbars fade away */
	printf("\nMemory: %ld MB (200).\n", memory());
	idle();
	simulate(GTK_WIDGET(window), LADDER_GRID_VIEW(sheet));
	if (*word) {
		late(GTK_WIDGET(window));
		past(GTK_WIDGET(window));
	}
	measure_list(GTK_WIDGET(window), document);
	g_object_unref(document);
}

int main(int argc, char **argv)
{
	AdwApplication *application;

	if (start_is_one())
		return start(argc, argv);
	if (argc < 3)
		return 2;
	if (argc == 3)
		starts(argv[0], argv[2]);
	memory_keep_frames();
	application = adw_application_new("org.rungboard.Bench", G_APPLICATION_NON_UNIQUE);
	g_application_register(G_APPLICATION(application), NULL, NULL);
	gtk_source_init();
	app_style();
	run(application, argv[1], argc > 3 ? argv[3] : "");
	return 0;
}
