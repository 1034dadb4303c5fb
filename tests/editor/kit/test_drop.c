/* SPDX-License-Identifier: MIT
 *
 * test_drop - the entries of a drop-down follow the names; the same names leave it alone, so that
 * its open list does not close.
 */
#include "editor-gtk/kit/drop.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

/* Fills with the words of @line, and compares what can be chosen. */
static void fill(GtkDropDown *drop, const char *line)
{
	char **words = g_strsplit(line, " ", -1);
	GPtrArray *names = g_ptr_array_new();
	GString *got = g_string_new(NULL);
	GListModel *model;

	for (char **word = words; *word; word++)
		g_ptr_array_add(names, *word);
	drop_fill(drop, names);
	model = gtk_drop_down_get_model(drop);
	for (guint i = 0; model && i < g_list_model_get_n_items(model); i++)
		g_string_append_printf(got, "%s%s", i ? " " : "",
				       gtk_string_list_get_string(GTK_STRING_LIST(model), i));
	CHECK_TEXT(got->str, line);
	g_string_free(got, TRUE);
	g_ptr_array_unref(names);
	g_strfreev(words);
}

int main(void)
{
	GtkDropDown *drop;
	GListModel *model;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	drop = g_object_ref_sink(GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL)));
	fill(drop, "Main Pump");
	gtk_drop_down_set_selected(drop, 1);
	model = gtk_drop_down_get_model(drop);
	fill(drop, "Main Pump");
	CHECK(gtk_drop_down_get_model(drop) == model && gtk_drop_down_get_selected(drop) == 1);
	fill(drop, "Main Valve");
	fill(drop, "Main Valve Tank");
	fill(drop, "Main");
	fill(drop, "");
	g_object_unref(drop);
	return tap_done();
}
