/* SPDX-License-Identifier: MIT
 *
 * cell_entry - an entry of a table; see cell_entry.h. GtkText draws the text, clipped
 * before the ellipsis.
 */
#include "editor-gtk/kit/cell_entry.h"

#define ELLIPSIS "\xe2\x80\xa6"

struct _LadderCellEntry {
	GtkEntry entry;
};

G_DEFINE_FINAL_TYPE(LadderCellEntry, ladder_cell_entry, GTK_TYPE_ENTRY)

static GtkText *text_of(LadderCellEntry *entry)
{
	return GTK_TEXT(gtk_editable_get_delegate(GTK_EDITABLE(entry)));
}

bool cell_entry_is_cut(LadderCellEntry *entry)
{
	GtkText *text = text_of(entry);
	graphene_rect_t begin, end;

	if (gtk_widget_has_focus(GTK_WIDGET(text)))
		return false;
	gtk_text_compute_cursor_extents(text, 0, &begin, NULL);
	gtk_text_compute_cursor_extents(text, gtk_entry_get_text_length(GTK_ENTRY(entry)), &end,
					NULL);
	return end.origin.x - begin.origin.x > gtk_widget_get_width(GTK_WIDGET(text));
}

/* Width of the characters that fit whole into @room. */
static float whole_width(GtkWidget *text, float room)
{
	const gsize count = gtk_text_get_text_length(GTK_TEXT(text));
	graphene_rect_t begin, end;
	float width = 0;

	gtk_text_compute_cursor_extents(GTK_TEXT(text), 0, &begin, NULL);
	for (gsize i = 1; i <= count; i++) {
		gtk_text_compute_cursor_extents(GTK_TEXT(text), i, &end, NULL);
		if (end.origin.x - begin.origin.x > room)
			break;
		width = end.origin.x - begin.origin.x;
	}
	return width;
}

/* At the end of the text's line. */
static void snapshot_cut(GtkWidget *entry, GtkWidget *text, GtkSnapshot *snapshot)
{
	PangoLayout *ellipsis;
	graphene_rect_t bounds;
	GdkRGBA color;
	int width, height;

	if (!gtk_widget_compute_bounds(text, entry, &bounds))
		return;
	ellipsis = gtk_widget_create_pango_layout(text, ELLIPSIS);
	pango_layout_get_pixel_size(ellipsis, &width, &height);
	bounds.size.width = whole_width(text, bounds.size.width - (float)width);
	gtk_snapshot_push_clip(snapshot, &bounds);
	gtk_widget_snapshot_child(entry, text, snapshot);
	gtk_snapshot_pop(snapshot);
	gtk_style_context_get_color(gtk_widget_get_style_context(text), &color);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(
		bounds.origin.x + bounds.size.width,
		bounds.origin.y + (bounds.size.height - height) / 2));
	gtk_snapshot_append_layout(snapshot, ellipsis, &color);
	gtk_snapshot_restore(snapshot);
	g_object_unref(ellipsis);
}

static void snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderCellEntry *entry = LADDER_CELL_ENTRY(widget);
	GtkWidget *text = GTK_WIDGET(text_of(entry));
	const bool cut = cell_entry_is_cut(entry);

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		if (cut && child == text)
			snapshot_cut(widget, text, snapshot);
		else
			gtk_widget_snapshot_child(widget, child, snapshot);
}

static void ladder_cell_entry_class_init(LadderCellEntryClass *class)
{
	GTK_WIDGET_CLASS(class)->snapshot = snapshot;
}

static void ladder_cell_entry_init(LadderCellEntry *entry)
{
	(void)entry;
}

GtkWidget *cell_entry_new(void)
{
	GtkWidget *cell = g_object_new(LADDER_TYPE_CELL_ENTRY, NULL);

	gtk_entry_set_has_frame(GTK_ENTRY(cell), FALSE);
	gtk_editable_set_enable_undo(GTK_EDITABLE(cell), FALSE);
	gtk_widget_add_css_class(cell, "field");
	return cell;
}
