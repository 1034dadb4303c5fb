/* SPDX-License-Identifier: MIT
 *
 * test_long_problem - a problem that is longer than its column shows its beginning, with
 * the name in quotes, and its end.
 */
#include "editor-gtk/panels/problems.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <adwaita.h>

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
	}
	ladder_problems_set_document(LADDER_PROBLEMS(problems), NULL);
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(document);
	return tap_done();
}
