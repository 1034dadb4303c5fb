/* SPDX-License-Identifier: MIT
 *
 * panel_row - a row of a panel's list.
 */
#include "editor-gtk/kit/panel_row.h"

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

static guint changed;

static void ladder_panel_row_class_init(LadderPanelRowClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_panel_row_finalize;
	changed = g_signal_new("changed", LADDER_TYPE_PANEL_ROW, G_SIGNAL_RUN_LAST, 0, NULL,
			       NULL, NULL, G_TYPE_NONE, 0);
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

/* Are all visible texts equal? */
static bool is_equal(const LadderPanelRow *a, const LadderPanelRow *b)
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

bool panel_row_is_like(const LadderPanelRow *row, gconstpointer other)
{
	const LadderPanelRow *of = other;

	return row->table == of->table && panel_row_is_named(row, panel_row_text(of, 0));
}

bool panel_row_is_named(const LadderPanelRow *row, gconstpointer name)
{
	return strcmp(panel_row_text(row, 0), name) == 0;
}

static bool is_same(GListModel *model, guint at, gpointer row)
{
	LadderPanelRow *old = g_list_model_get_item(model, at);
	bool same = is_equal(old, row);

	g_object_unref(old);
	return same;
}

/* Same declarations in the same order? One of them may be renamed. */
static bool are_same(GListModel *model, guint first, guint count, GPtrArray *rows)
{
	int renamed = 0;

	for (guint i = first; i < first + count && renamed < 2; i++) {
		const LadderPanelRow *row = rows->pdata[i];
		LadderPanelRow *old = g_list_model_get_item(model, i);

		renamed += strcmp(panel_row_text(old, 0), panel_row_text(row, 0)) != 0;
		if (row->table < 0 || old->table != row->table || old->index != row->index)
			renamed = 2;
		g_object_unref(old);
	}
	return renamed < 2;
}

/* Exchanges the contents of two rows. */
static void exchange(LadderPanelRow *a, LadderPanelRow *b)
{
	LadderPanelRow kept = *a;
	const gsize head = G_STRUCT_OFFSET(LadderPanelRow, text);

	memcpy((char *)a + head, (char *)b + head, sizeof(*a) - head);
	memcpy((char *)b + head, (char *)&kept + head, sizeof(*a) - head);
}

static void change(GListModel *model, guint first, guint count, GPtrArray *rows)
{
	for (guint i = first; i < first + count; i++) {
		LadderPanelRow *old = g_list_model_get_item(model, i);

		if (!is_equal(old, rows->pdata[i])) {
			exchange(old, rows->pdata[i]);
			g_signal_emit(old, changed, 0);
		}
		g_object_unref(old);
	}
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
	if (old == rows->len && are_same(model, first, old - first - last, rows))
		change(model, first, old - first - last, rows);
	else if (old - first - last || rows->len - first - last)
		g_list_store_splice(store, first, old - first - last, rows->pdata + first,
				    rows->len - first - last);
}
