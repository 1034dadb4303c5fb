/* SPDX-License-Identifier: MIT
 *
 * entry_row - a candidate in one widget; see entry_row.h.
 */
#include "editor-gtk/kit/entry_row.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

#include <stdbool.h>
#include <string.h>

enum { TEXT, ADDRESS, NOTE, COLUMNS, MARK = COLUMNS, LAYOUTS };

#define GAP    12   /* px between columns                                       */
#define ROUND  7    /* px beside the letters of the mark in its frame           */
#define MARKED 0.85 /* size of its letters                                      */
#define QUIET  0.75 /* opacity of the note                                      */

/* In characters: least and largest natural width of a column. */
static const int least[COLUMNS] = { 14, 8, 18 }, most[COLUMNS] = { 22, 12, 44 };

struct _LadderEntryRow {
	GtkWidget parent;
	PangoLayout *layout[LAYOUTS]; /* NULL: not measured yet                */
	char *text[LAYOUTS];
	int width[COLUMNS];           /* px of natural width                   */
	int mark;                     /* px of the frame, with its gap; 0: none */
	int letter, height;           /* px of a character, of the row         */
};

G_DEFINE_FINAL_TYPE(LadderEntryRow, ladder_entry_row, GTK_TYPE_WIDGET)

static void forget_layouts(LadderEntryRow *row)
{
	for (int i = 0; i < LAYOUTS; i++)
		g_clear_object(&row->layout[i]);
}

static PangoLayout *layout_of(LadderEntryRow *row, int column)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(row),
							     row->text[column]);
	PangoAttrList *style = pango_attr_list_new();

	if (column == TEXT)
		pango_attr_list_insert(style, pango_attr_weight_new(PANGO_WEIGHT_BOLD));
	if (column == ADDRESS)
		pango_attr_list_insert(style, pango_attr_family_new("monospace"));
	if (column == MARK)
		pango_attr_list_insert(style, pango_attr_scale_new(MARKED));
	pango_layout_set_attributes(layout, style);
	pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
	pango_layout_set_single_paragraph_mode(layout, TRUE);
	pango_attr_list_unref(style);
	return layout;
}

/* A digit is as wide as most letters. */
static int letter_width(LadderEntryRow *row)
{
	PangoLayout *digits = gtk_widget_create_pango_layout(GTK_WIDGET(row), "0000000000");
	int width;

	pango_layout_get_pixel_size(digits, &width, NULL);
	g_object_unref(digits);
	return MAX((width + 5) / 10, 1);
}

static void lay_out_mark(LadderEntryRow *row)
{
	int width;

	row->layout[MARK] = layout_of(row, MARK);
	pango_layout_get_pixel_size(row->layout[MARK], &width, NULL);
	row->mark = row->text[MARK][0] ? width + 2 * ROUND + GAP / 2 : 0;
}

static void lay_out(LadderEntryRow *row)
{
	if (row->layout[TEXT])
		return;
	if (!row->letter)
		row->letter = letter_width(row);
	row->height = 0;
	lay_out_mark(row);
	for (int i = 0; i < COLUMNS; i++) {
		int width, height;

		row->layout[i] = layout_of(row, i);
		pango_layout_get_pixel_size(row->layout[i], &width, &height);
		if (i == TEXT)
			width += row->mark;
		row->width[i] = CLAMP(width, least[i] * row->letter, most[i] * row->letter);
		row->height = MAX(row->height, height);
	}
}

static void ladder_entry_row_measure(GtkWidget *widget, GtkOrientation orientation,
				     int for_size, int *minimum, int *natural,
				     int *minimum_baseline, int *natural_baseline)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(widget);

	(void)for_size;
	lay_out(row);
	*minimum_baseline = *natural_baseline = -1;
	*minimum = *natural = row->height;
	if (orientation == GTK_ORIENTATION_VERTICAL)
		return;
	*minimum = *natural = (COLUMNS - 1) * GAP;
	for (int i = 0; i < COLUMNS; i++) {
		*minimum += least[i] * row->letter;
		*natural += row->width[i];
	}
}

/* The mark follows the text, whose column is @column px wide. */
static void draw_mark(LadderEntryRow *row, GtkSnapshot *snapshot, int column, const GdkRGBA *ink)
{
	static const float line[4] = { 1, 1, 1, 1 };
	const GdkRGBA frame[4] = { *ink, *ink, *ink, *ink };
	const int wide = row->mark - GAP / 2, all = gtk_widget_get_height(GTK_WIDGET(row));
	int text, height;
	GskRoundedRect box;

	pango_layout_get_pixel_size(row->layout[TEXT], &text, NULL);
	pango_layout_get_pixel_size(row->layout[MARK], NULL, &height);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(
		(float)(MIN(text, column - row->mark) + GAP / 2), (float)((all - height) / 2)));
	gsk_rounded_rect_init_from_rect(&box, &GRAPHENE_RECT_INIT(0, 0, (float)wide,
								 (float)height),
					(float)height / 2);
	gtk_snapshot_append_border(snapshot, &box, line, frame);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(ROUND, 0));
	gtk_snapshot_append_layout(snapshot, row->layout[MARK], ink);
	gtk_snapshot_restore(snapshot);
}

/* The note gets the rest of the width. */
static void ladder_entry_row_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(widget);
	int left = gtk_widget_get_width(widget);
	GdkRGBA ink;

	lay_out(row);
	gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
	for (int i = 0; i < COLUMNS; i++) {
		const int width = i == NOTE ? MAX(left, 0) : row->width[i];
		int height;

		pango_layout_set_width(row->layout[i], (i == TEXT ? width - row->mark : width) *
						       PANGO_SCALE);
		pango_layout_get_pixel_size(row->layout[i], NULL, &height);
		if (i == NOTE)
			ink.alpha *= (float)QUIET;
		gtk_snapshot_save(snapshot);
		gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(
			(float)(gtk_widget_get_width(widget) - left),
			(float)((gtk_widget_get_height(widget) - height) / 2)));
		gtk_snapshot_append_layout(snapshot, row->layout[i], &ink);
		gtk_snapshot_restore(snapshot);
		if (i == TEXT && row->mark)
			draw_mark(row, snapshot, width, &ink);
		left -= width + GAP;
	}
}

static gboolean ladder_entry_row_query_tooltip(GtkWidget *widget, int x, int y,
					       gboolean keyboard, GtkTooltip *tooltip)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(widget);
	char *text = g_strdup_printf(_("%s: %s"), row->text[TEXT], row->text[NOTE]);

	(void)x;
	(void)y;
	(void)keyboard;
	tip_show(tooltip, text);
	g_free(text);
	return TRUE;
}

static void ladder_entry_row_css_changed(GtkWidget *widget, GtkCssStyleChange *change)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(widget);

	GTK_WIDGET_CLASS(ladder_entry_row_parent_class)->css_changed(widget, change);
	forget_layouts(row);
	row->letter = 0;
}

static void ladder_entry_row_finalize(GObject *object)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(object);

	forget_layouts(row);
	for (int i = 0; i < LAYOUTS; i++)
		g_free(row->text[i]);
	G_OBJECT_CLASS(ladder_entry_row_parent_class)->finalize(object);
}

static void ladder_entry_row_class_init(LadderEntryRowClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->finalize = ladder_entry_row_finalize;
	widget->measure = ladder_entry_row_measure;
	widget->snapshot = ladder_entry_row_snapshot;
	widget->query_tooltip = ladder_entry_row_query_tooltip;
	widget->css_changed = ladder_entry_row_css_changed;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_PRESENTATION);
}

static void ladder_entry_row_init(LadderEntryRow *row)
{
	for (int i = 0; i < LAYOUTS; i++)
		row->text[i] = g_strdup("");
	gtk_widget_set_has_tooltip(GTK_WIDGET(row), TRUE);
}

GtkWidget *ladder_entry_row_new(void)
{
	return g_object_new(LADDER_TYPE_ENTRY_ROW, NULL);
}

void ladder_entry_row_say(LadderEntryRow *row, const char *text, const char *address,
			  const char *note, const char *mark)
{
	const char *const said[LAYOUTS] = { text, address, note, mark };
	bool same = true;

	for (int i = 0; i < LAYOUTS; i++) {
		same = same && strcmp(row->text[i], said[i]) == 0;
		g_free(row->text[i]);
		row->text[i] = g_strdup(said[i]);
	}
	if (same)
		return;
	forget_layouts(row);
	gtk_widget_queue_resize(GTK_WIDGET(row));
}
