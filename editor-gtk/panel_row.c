/* SPDX-License-Identifier: MIT
 *
 * panel_row - a row of a panel's list.
 */
#include "editor-gtk/panel_row.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderPanelRow, ladder_panel_row, G_TYPE_OBJECT)

static void ladder_panel_row_finalize(GObject *object)
{
	LadderPanelRow *row = LADDER_PANEL_ROW(object);

	for (int i = 0; i < PANEL_TEXTS; i++)
		g_free(row->text[i]);
	g_free(row->spoken);
	g_free(row->note);
	G_OBJECT_CLASS(ladder_panel_row_parent_class)->finalize(object);
}

static void ladder_panel_row_class_init(LadderPanelRowClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_panel_row_finalize;
}

static void ladder_panel_row_init(LadderPanelRow *row)
{
	row->pou = row->rung = row->row = row->col = -1;
	row->table = row->index = -1;
}

LadderPanelRow *ladder_panel_row_new(void)
{
	return g_object_new(LADDER_TYPE_PANEL_ROW, NULL);
}

const char *panel_row_text(const LadderPanelRow *row, int column)
{
	return row->text[column] ? row->text[column] : "";
}

bool panel_row_equal(const LadderPanelRow *a, const LadderPanelRow *b)
{
	for (int i = 0; i < PANEL_TEXTS; i++)
		if (strcmp(panel_row_text(a, i), panel_row_text(b, i)) != 0)
			return false;
	return a->pou == b->pou && a->rung == b->rung && a->row == b->row &&
	       a->col == b->col && a->table == b->table && a->index == b->index &&
	       a->tone == b->tone && a->flags == b->flags &&
	       g_strcmp0(a->note, b->note) == 0 && g_strcmp0(a->spoken, b->spoken) == 0;
}

bool panel_row_matches(const LadderPanelRow *row, const char *wanted)
{
	char *folded = g_utf8_casefold(wanted, -1);
	bool found = !*folded;

	for (int i = 0; i < PANEL_TEXTS && !found; i++) {
		char *text = row->text[i] ? g_utf8_casefold(row->text[i], -1) : NULL;

		found = text && strstr(text, folded);
		g_free(text);
	}
	g_free(folded);
	return found;
}

static bool is_same(GListModel *model, guint at, gpointer row)
{
	LadderPanelRow *old = g_list_model_get_item(model, at);
	bool same = panel_row_equal(old, row);

	g_object_unref(old);
	return same;
}

void panel_rows_update(GListStore *store, GPtrArray *rows)
{
	GListModel *model = G_LIST_MODEL(store);
	const guint old = g_list_model_get_n_items(model);
	guint first = 0, last = 0;

	while (first < MIN(old, rows->len) && is_same(model, first, rows->pdata[first]))
		first++;
	while (last < MIN(old, rows->len) - first &&
	       is_same(model, old - 1 - last, rows->pdata[rows->len - 1 - last]))
		last++;
	if (old - first - last || rows->len - first - last)
		g_list_store_splice(store, first, old - first - last, rows->pdata + first,
				    rows->len - first - last);
}
