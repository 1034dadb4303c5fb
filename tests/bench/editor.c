/* SPDX-License-Identifier: MIT
 *
 * editor - how long the editor takes with a large program, measured inside it.
 *
 * usage: editor FILE. It prints medians and judges nothing: opening, frames while
 * scrolling, and what a key costs until its picture is there: the work of the key and of
 * the frame that shows it, without the wait for the screen's next frame.
 */
#include "editor-gtk/grid_view.h"
#include "editor-gtk/window.h"

#include <gtksourceview/gtksource.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROUNDS 60

static struct {
	GdkFrameClock *clock;
	gint64 begun, spent; /* us, of the last frame                          */
	int frames;
} frame;

static void before(void)
{
	frame.begun = g_get_monotonic_time();
}

static void after(void)
{
	frame.spent = g_get_monotonic_time() - frame.begun;
	frame.frames++;
}

static void settle(gint64 us)
{
	const gint64 end = g_get_monotonic_time() + us;

	while (g_get_monotonic_time() < end)
		if (!g_main_context_iteration(NULL, FALSE))
			g_usleep(500);
}

static void next_frame(void)
{
	const int seen = frame.frames;
	const gint64 end = g_get_monotonic_time() + G_USEC_PER_SEC;

	while (frame.frames == seen && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, TRUE);
}

static int compare(const void *a, const void *b)
{
	const gint64 left = *(const gint64 *)a, right = *(const gint64 *)b;

	return (left > right) - (left < right);
}

/* Medians of @act and of the frame behind it. */
static void measure(const char *name, void (*act)(LadderGridView *sheet, int round),
		    LadderGridView *sheet, int rounds)
{
	gint64 work[ROUNDS], whole[ROUNDS];

	for (int i = 0; i < rounds; i++) {
		const gint64 begin = g_get_monotonic_time();

		act(sheet, i);
		work[i] = g_get_monotonic_time() - begin;
		next_frame();
		whole[i] = work[i] + frame.spent;
		settle(5000);
	}
	qsort(work, (size_t)rounds, sizeof(*work), compare);
	qsort(whole, (size_t)rounds, sizeof(*whole), compare);
	printf("| %s | %.2f | %.2f | %.2f |\n", name, (double)work[rounds / 2] / 1000,
	       (double)whole[rounds / 2] / 1000, (double)whole[rounds - 1] / 1000);
}

static GtkWidget *find(GtkWidget *widget, GType type)
{
	GtkWidget *found = NULL;

	if (g_type_is_a(G_OBJECT_TYPE(widget), type))
		return widget;
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find(child, type);
	return found;
}

/* ---- what a person does ---- */

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

static void negate(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_grid_view_do(sheet, VERB_negate);
}

static void add_rung(LadderGridView *sheet, int round)
{
	(void)round;
	ladder_grid_view_do(sheet, VERB_rung_below);
}

static void type(LadderGridView *sheet, int round)
{
	GtkWidget *line = find(GTK_WIDGET(sheet), GTK_TYPE_ENTRY);
	char text[] = { (char)('a' + round % 26), '\0' };
	int at = -1;

	gtk_editable_insert_text(GTK_EDITABLE(line), text, -1, &at);
}

static void commit(LadderGridView *sheet, const char *text)
{
	GtkWidget *line;

	ladder_grid_view_do(sheet, VERB_block);
	line = find(GTK_WIDGET(sheet), GTK_TYPE_ENTRY);
	gtk_editable_set_text(GTK_EDITABLE(line), text);
	g_signal_emit_by_name(line, "activate");
}

static void known(LadderGridView *sheet, int round)
{
	char text[40];

	snprintf(text, sizeof(text), "In%d", round);
	ladder_grid_view_go(sheet, 2500, 0, 0);
	commit(sheet, text);
}

static void fresh(LadderGridView *sheet, int round)
{
	char text[40];

	snprintf(text, sizeof(text), "Fresh%d", round);
	ladder_grid_view_go(sheet, 2500, 0, 0);
	commit(sheet, text);
}

/* ---- all of it ---- */

static void memory(void)
{
	char *text = NULL;

	if (g_file_get_contents("/proc/self/status", &text, NULL, NULL)) {
		const char *line = strstr(text, "VmRSS:");

		if (line)
			printf("Memory: %ld MB.\n", strtol(line + 6, NULL, 10) / 1024);
	}
	g_free(text);
}

static void keys(LadderGridView *sheet)
{
	printf("| what | the key, ms | until its picture, ms | the worst, ms |\n"
	       "|---|---|---|---|\n");
	measure("scroll by 40 px", scroll, sheet, ROUNDS);
	measure("scroll by a page", page, sheet, ROUNDS);
	ladder_grid_view_go(sheet, 2500, 0, 0);
	settle(G_USEC_PER_SEC);
	measure("move the cursor", move, sheet, ROUNDS);
	measure("negate a contact", negate, sheet, ROUNDS);
	ladder_grid_view_do(sheet, VERB_block);
	settle(200000);
	measure("a letter into the entry", type, sheet, 10);
	ladder_grid_view_do(sheet, VERB_cancel);
	measure("an element", known, sheet, 20);
	measure("an element with a new symbol", fresh, sheet, 20);
	measure("a new rung", add_rung, sheet, 20);
}

static void run(AdwApplication *application, const char *path)
{
	const gint64 begin = g_get_monotonic_time();
	LadderDocument *document = ladder_document_new();
	LadderWindow *window;
	GtkWidget *sheet;
	int frames;

	if (!ladder_document_open(document, path, NULL))
		exit(2);
	printf("Reading: %.1f ms.\n", (double)(g_get_monotonic_time() - begin) / 1000);
	window = ladder_window_new(application, document);
	gtk_window_present(GTK_WINDOW(window));
	frame.clock = gdk_surface_get_frame_clock(
		gtk_native_get_surface(GTK_NATIVE(window)));
	g_signal_connect(frame.clock, "before-paint", G_CALLBACK(before), NULL);
	g_signal_connect(frame.clock, "after-paint", G_CALLBACK(after), NULL);
	next_frame();
	printf("Opening, to the first picture: %.1f ms.\n",
	       (double)(g_get_monotonic_time() - begin) / 1000);
	settle(4 * G_USEC_PER_SEC);
	memory();
	frames = frame.frames;
	settle(G_USEC_PER_SEC);
	printf("Frames in an idle second: %d.\n\n", frame.frames - frames);
	sheet = find(GTK_WIDGET(window), LADDER_TYPE_GRID_VIEW);
	gtk_widget_grab_focus(sheet);
	keys(LADDER_GRID_VIEW(sheet));
	settle(2 * G_USEC_PER_SEC);
	printf("\n");
	memory();
	g_object_unref(document);
}

int main(int argc, char **argv)
{
	AdwApplication *application;

	if (argc < 2)
		return 2;
	application = adw_application_new("org.rungboard.Bench", G_APPLICATION_NON_UNIQUE);
	g_application_register(G_APPLICATION(application), NULL, NULL);
	gtk_source_init();
	run(application, argv[1]);
	return 0;
}
