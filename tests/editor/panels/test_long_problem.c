/* SPDX-License-Identifier: MIT
 *
 * test_long_problem - a problem that is longer than its column shows its beginning, with
 * the name in quotes, and its end.
 */
#include "editor-gtk/panels/problems.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <adwaita.h>

/* Px of the columns beside the problem, and what a cell has beside its text. */
#define ICON 34
#define PLACE 260
#define CODE 80
#define ROOM 24
#define LACK 30

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Lamp AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL Lamp |\n"
	"RUNG\n  | NO %IX0.1 | COIL Lamp |\nEND_PROGRAM\n";

static GtkLabel *label_of(GtkWidget *from, const char *end)
{
	GtkLabel *label = NULL;

	if (GTK_IS_LABEL(from) && g_str_has_suffix(gtk_label_get_text(GTK_LABEL(from)), end))
		return GTK_LABEL(from);
	for (GtkWidget *child = gtk_widget_get_first_child(from); child && !label;
	     child = gtk_widget_get_next_sibling(child))
		label = label_of(child, end);
	return label;
}

/* Is the ellipsis neither at the beginning nor at the end? */
static bool shows_both_ends(GtkLabel *label)
{
	PangoLayout *layout = gtk_label_get_layout(label);
	GSList *runs = pango_layout_get_line_readonly(layout, 0)->runs;
	const PangoLayoutRun *first = runs->data, *last = g_slist_last(runs)->data;

	return !(first->item->analysis.flags & PANGO_ANALYSIS_FLAG_IS_ELLIPSIS) &&
	       !(last->item->analysis.flags & PANGO_ANALYSIS_FLAG_IS_ELLIPSIS);
}

/* Px of the text on one line. */
static int width_of(GtkLabel *label)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(label),
							     gtk_label_get_text(label));
	int width;

	pango_layout_get_pixel_size(layout, &width, NULL);
	g_object_unref(layout);
	return width;
}

/* No text is cut beside columns that have more room than their texts need: all others have their
 * wishes here, and the problem lacks LACK px. */
static void check_room(GtkWindow *window, GtkLabel *label)
{
	gtk_window_set_default_size(window, 1200, 200);
	WAIT(gtk_widget_get_width(GTK_WIDGET(label)) > width_of(label) + 100);
	gtk_window_set_default_size(window, ICON + PLACE + CODE + width_of(label) + ROOM - LACK, 200);
	WAIT(gtk_widget_get_width(GTK_WIDGET(label)) < width_of(label) + 100);
	CHECK_SOON(!pango_layout_is_ellipsized(gtk_label_get_layout(label)));
}

int main(void)
{
	LadderDocument *document;
	GtkWidget *window, *problems;
	GtkLabel *label = NULL;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	ladder_document_check_now(document);
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), 560, 200);
	problems = ladder_problems_new();
	ladder_problems_set_document(LADDER_PROBLEMS(problems), document);
	gtk_window_set_child(GTK_WINDOW(window), problems);
	screen_show(window);
	WAIT((label = label_of(problems, "the last one wins")) != NULL);
	CHECK(label);
	if (label) {
		CHECK_SOON(pango_layout_is_ellipsized(gtk_label_get_layout(label)));
		CHECK(shows_both_ends(label));
		check_room(GTK_WINDOW(window), label);
	}
	ladder_problems_set_document(LADDER_PROBLEMS(problems), NULL);
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(document);
	return tap_done();
}
