/* SPDX-License-Identifier: MIT
 *
 * panel_watch - makes a panel look at the document again, not too often and not unseen.
 */
#include "editor-gtk/document/panel.h"

#define REFRESH_MS 100

struct panel_watch {
	GtkWidget *owner;
	void (*refresh)(GtkWidget *owner);
	LadderDocument *document;
	GSignalGroup *group;
	guint timer;
	bool dirty;
};

static void refresh(struct panel_watch *watch)
{
	g_clear_handle_id(&watch->timer, g_source_remove);
	watch->dirty = false;
	watch->refresh(watch->owner);
}

static gboolean elapsed(gpointer data)
{
	struct panel_watch *watch = data;

	watch->timer = 0;
	if (watch->dirty && gtk_widget_get_mapped(watch->owner))
		refresh(watch);
	return G_SOURCE_REMOVE;
}

static void changed(struct panel_watch *watch)
{
	watch->dirty = true;
	if (!watch->timer && gtk_widget_get_mapped(watch->owner))
		watch->timer = g_timeout_add(REFRESH_MS, elapsed, watch);
}

static void rungs_changed(LadderDocument *document, int pou, int at, int removed,
			  int inserted, gpointer watch)
{
	(void)document;
	(void)pou;
	(void)at;
	(void)removed;
	(void)inserted;
	changed(watch);
}

static void list_changed(LadderDocument *document, int pou, gpointer watch)
{
	(void)document;
	(void)pou;
	changed(watch);
}

static void variable_changed(LadderDocument *document, int pou, const char *name,
			     const char *address, gpointer watch)
{
	(void)document;
	(void)pou;
	(void)name;
	(void)address;
	changed(watch);
}

static void whole_changed(LadderDocument *document, gpointer watch)
{
	(void)document;
	changed(watch);
}

static void seen(GtkWidget *owner, gpointer data)
{
	struct panel_watch *watch = data;

	(void)owner;
	if (watch->dirty)
		refresh(watch);
}

struct panel_watch *panel_watch_new(GtkWidget *owner, bool checks,
				    void (*refresh_panel)(GtkWidget *owner))
{
	struct panel_watch *watch = g_new0(struct panel_watch, 1);

	watch->owner = owner;
	watch->refresh = refresh_panel;
	watch->group = g_signal_group_new(LADDER_TYPE_DOCUMENT);
	g_signal_group_connect(watch->group, "project-changed", G_CALLBACK(whole_changed),
			       watch);
	g_signal_group_connect(watch->group, "rungs-changed", G_CALLBACK(rungs_changed),
			       watch);
	g_signal_group_connect(watch->group, "variable-changed",
			       G_CALLBACK(variable_changed), watch);
	g_signal_group_connect(watch->group, "list-changed", G_CALLBACK(list_changed), watch);
	if (checks)
		g_signal_group_connect(watch->group, "checked", G_CALLBACK(whole_changed),
				       watch);
	g_signal_connect_after(owner, "map", G_CALLBACK(seen), watch);
	return watch;
}

void panel_watch_free(struct panel_watch *watch)
{
	if (!watch)
		return;
	g_clear_handle_id(&watch->timer, g_source_remove);
	g_signal_handlers_disconnect_by_data(watch->owner, watch);
	g_signal_group_set_target(watch->group, NULL);
	g_clear_object(&watch->group);
	g_clear_object(&watch->document);
	g_free(watch);
}

bool panel_watch_set(struct panel_watch *watch, LadderDocument *document)
{
	if (!g_set_object(&watch->document, document))
		return false;
	g_signal_group_set_target(watch->group, document);
	watch->dirty = true;
	if (gtk_widget_get_mapped(watch->owner))
		refresh(watch);
	return true;
}

LadderDocument *panel_watch_document(struct panel_watch *watch)
{
	return watch ? watch->document : NULL;
}

void panel_watch_later(struct panel_watch *watch)
{
	changed(watch);
}

void panel_watch_now(struct panel_watch *watch)
{
	if (watch->dirty)
		refresh(watch);
}
