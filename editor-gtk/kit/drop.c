/* SPDX-License-Identifier: MIT
 *
 * drop - the entries of a drop-down; see drop.h.
 */
#include "editor-gtk/kit/drop.h"

#include <stdbool.h>
#include <string.h>

static bool offers(GtkDropDown *drop, const GPtrArray *names)
{
	GListModel *model = gtk_drop_down_get_model(drop);
	bool same = model && g_list_model_get_n_items(model) == names->len;

	for (guint i = 0; same && i < names->len; i++)
		same = strcmp(gtk_string_list_get_string(GTK_STRING_LIST(model), i),
			      names->pdata[i]) == 0;
	return same;
}

void drop_fill(GtkDropDown *drop, const GPtrArray *names)
{
	GtkStringList *list;

	if (offers(drop, names))
		return;
	list = gtk_string_list_new(NULL);
	for (guint i = 0; i < names->len; i++)
		gtk_string_list_append(list, names->pdata[i]);
	gtk_drop_down_set_model(drop, G_LIST_MODEL(list));
	g_object_unref(list);
}
