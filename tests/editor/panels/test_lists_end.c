/* SPDX-License-Identifier: MIT
 *
 * test_lists_end - a panel goes while its list, which goes a little later, selects another row:
 * the panel is told nothing any more.
 */
#include "editor-gtk/panels/symbols_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/tap.h"

#include <adwaita.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Spare : INT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Start | COIL %QX0.4 |\nEND_PROGRAM\n\n"
	"PROGRAM Other LD\nRUNG\n  | NO Start | COIL %QX0.5 |\nEND_PROGRAM\n";

static LadderDocument *document;
static GtkSelectionModel *rows; /* of the panel that goes */
static guint criticals;

static void select_another(void)
{
	for (guint i = 0; i < 2; i++)
		gtk_single_selection_set_selected(GTK_SINGLE_SELECTION(rows), i);
}

static GLogWriterOutput count(GLogLevelFlags level, const GLogField *fields, gsize n, gpointer unused)
{
	criticals += (level & G_LOG_LEVEL_MASK) <= G_LOG_LEVEL_WARNING;
	return g_log_writer_default(level, fields, n, unused);
}

static void test_end(GtkWidget *panel, const char *as)
{
	GtkWidget *window = gtk_window_new(), *list;

	gtk_window_set_child(GTK_WINDOW(window), panel);
	screen_show(window);
	list = find_type(panel, GTK_TYPE_COLUMN_VIEW);
	rows = g_object_ref(gtk_column_view_get_model(GTK_COLUMN_VIEW(list)));
	WAIT(g_list_model_get_n_items(G_LIST_MODEL(rows)) > 1);
	/* between the end of its parts and that of its signals */
	g_signal_connect(panel, "destroy", G_CALLBACK(select_another), NULL);
	criticals = 0;
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_clear_object(&rows);
	CHECK_AS(criticals == 0, as);
}

int main(void)
{
	GtkWidget *symbols;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	g_log_set_writer_func(count, NULL, NULL);
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/test.rung", sample, strlen(sample), true);
	symbols = ladder_symbols_view_new();
	ladder_symbols_view_set_document(LADDER_SYMBOLS_VIEW(symbols), document);
	test_end(symbols, "the table of symbols");
	g_object_unref(document);
	return tap_done();
}
