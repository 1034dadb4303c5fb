/* SPDX-License-Identifier: MIT
 *
 * watch_cells - the columns of a status chart, and the widgets in them.
 *
 * A row that comes onto the screen gets widgets and knows them until it goes; so a value
 * that changes goes to its label and to nothing else.
 */
#include "editor-gtk/live/watch_inside.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define HEADING_ROOM 14 /* padding of a heading                                */

enum column { NAME, TYPE, FORMAT, VALUE, FRESH, FORCE, COMMENT, COLUMNS };

static const struct { const char *title; int width; } columns[COLUMNS] = {
	[NAME] = { N_("Name"), 170 }, [TYPE] = { N_("Type"), 84 },
	[FORMAT] = { N_("Shown as"), 125 }, [VALUE] = { N_("Value"), 120 },
	[FRESH] = { N_("New value"), 110 }, [FORCE] = { N_("Force"), 0 },
	[COMMENT] = { N_("Comment"), 0 },
};

static LadderWatchView *view_of(GtkWidget *cell)
{
	return LADDER_WATCH_VIEW(gtk_widget_get_ancestor(cell, LADDER_TYPE_WATCH_VIEW));
}

static void name_cell(GtkWidget *cell, const LadderWatchRow *row, enum column column)
{
	char *name = g_strdup_printf("%s, %s", row->line->name, _(columns[column].title));

	gtk_accessible_update_property(GTK_ACCESSIBLE(cell), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
	g_free(name);
}

static void set_class(GtkWidget *widget, const char *class, bool is)
{
	if (is)
		gtk_widget_add_css_class(widget, class);
	else
		gtk_widget_remove_css_class(widget, class);
}

/* ---- what changes ---- */

static void show_value(LadderWatchRow *row)
{
	char *text = watch_row_value(row);

	gtk_label_set_text(GTK_LABEL(row->value), text);
	tip_set(row->value, text);
	g_free(text);
}

static void show_force(LadderWatchRow *row)
{
	const bool can = row->live && row->at.type != IEC_STRING && !row->at.constant;

	gtk_widget_set_sensitive(row->force, can);
	set_class(row->force, "forced", row->forced);
	/* It is a state that is shown: nobody pressed it. */
	if (gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(row->force)) != row->forced)
		gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(row->force), row->forced);
}

void watch_cells_show(LadderWatchRow *row)
{
	if (row->value)
		show_value(row);
	if (row->force)
		show_force(row);
}

/* ---- what a person did ---- */

static void typed(GtkEditable *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (!row)
		return;
	g_free(row->typed);
	row->typed = g_strdup(gtk_editable_get_text(entry));
	gtk_widget_remove_css_class(GTK_WIDGET(entry), "error");
	gtk_accessible_reset_state(GTK_ACCESSIBLE(entry), GTK_ACCESSIBLE_STATE_INVALID);
}

static void typed_through(GtkEntry *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (row)
		watch_write(view_of(GTK_WIDGET(entry)), row);
}

static bool comment_left(GtkWidget *entry, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	LadderWatchView *view = view_of(entry);

	if (row && view)
		watch_set_comment(view, row, gtk_editable_get_text(GTK_EDITABLE(entry)));
	return true;
}

static void comment_activated(GtkEntry *entry, GtkListItem *item)
{
	comment_left(GTK_WIDGET(entry), item);
}

static void comment_unfocused(GtkEventControllerFocus *focus, GtkListItem *item)
{
	comment_left(gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus)), item);
}

static void force_clicked(GtkButton *button, GtkListItem *item)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);

	if (!row)
		return;
	show_force(row); /* until the simulation says so, it is as it was */
	watch_toggle_force(view_of(GTK_WIDGET(button)), row);
}

/* Only formats that its type has. */
static void make_formats(GtkMenuButton *button, gpointer data)
{
	LadderWatchRow *row = gtk_list_item_get_item(data);
	GMenu *menu = g_menu_new();

	for (int i = 0; row && i < WATCH_FORMATS; i++) {
		GMenuItem *item;

		if (!watch_format_fits((enum watch_format)i, row->at.type))
			continue;
		item = g_menu_item_new(_(watch_format_label((enum watch_format)i)), NULL);
		g_menu_item_set_action_and_target(item, "watch.format", "(ii)",
			watch_place(view_of(GTK_WIDGET(button)), row), i);
		g_menu_append_item(menu, item);
		g_object_unref(item);
	}
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_object_unref(menu);
}

/* ---- cells ---- */

static GtkWidget *label_cell(const char *class)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	if (class)
		gtk_widget_add_css_class(label, class);
	return label;
}

static GtkWidget *entry_cell(void)
{
	GtkWidget *entry = gtk_entry_new();

	gtk_entry_set_has_frame(GTK_ENTRY(entry), FALSE);
	gtk_editable_set_width_chars(GTK_EDITABLE(entry), 4);
	gtk_widget_add_css_class(entry, "field");
	return entry;
}

static GtkWidget *format_cell(GtkListItem *item)
{
	GtkWidget *button = gtk_menu_button_new();

	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "watch-format");
	gtk_menu_button_set_create_popup_func(GTK_MENU_BUTTON(button), make_formats, item,
					      NULL);
	return button;
}

static GtkWidget *force_cell(void)
{
	GtkWidget *button = gtk_toggle_button_new_with_label("F");

	gtk_widget_add_css_class(button, "watch-force");
	gtk_widget_set_halign(button, GTK_ALIGN_CENTER);
	gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
	return button;
}

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer column)
{
	GtkWidget *cell = NULL;

	(void)factory;
	switch ((enum column)GPOINTER_TO_INT(column)) {
	case NAME: cell = label_cell(NULL); break;
	case TYPE: cell = label_cell("dim-label"); break;
	case FORMAT: cell = format_cell(item); break;
	case VALUE: cell = label_cell("live-value"); break;
	case FRESH:
		cell = entry_cell();
		gtk_widget_add_css_class(cell, "watch-fresh");
		break;
	case COMMENT: cell = entry_cell(); break;
	case FORCE: cell = force_cell(); break;
	case COLUMNS: return;
	}
	gtk_list_item_set_child(item, cell);
}

static void bind_name(GtkWidget *cell, LadderWatchRow *row)
{
	const bool unknown = watch_row_is_unknown(row);
	char *tip = unknown ? g_strdup_printf(_("%s: the program has no such name"),
					      row->line->name) : NULL;

	gtk_label_set_text(GTK_LABEL(cell), row->line->name);
	set_class(cell, "error", unknown);
	set_class(cell, "watch-unknown", unknown);
	tip_set(cell, tip ? tip : row->line->name);
	gtk_accessible_update_property(GTK_ACCESSIBLE(cell), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       tip ? tip : row->line->name, -1);
	g_free(tip);
}

static void bind_type(GtkWidget *cell, LadderWatchRow *row)
{
	gtk_label_set_text(GTK_LABEL(cell), row->at.type != IEC_NONE ?
			   iec_type_row(row->at.type)->word :
			   watch_row_is_unknown(row) ? _("unknown") : "");
}

static void bind_format(GtkWidget *cell, LadderWatchRow *row)
{
	gtk_menu_button_set_label(GTK_MENU_BUTTON(cell),
				  _(watch_format_label(row->line->format)));
	gtk_widget_set_visible(cell, watch_format_fits(WATCH_HEX, row->at.type) ||
			       row->line->format != WATCH_AUTO);
	name_cell(cell, row, FORMAT);
}

static void bind_fresh(GtkWidget *cell, LadderWatchRow *row, GtkListItem *item)
{
	row->fresh = cell;
	gtk_editable_set_text(GTK_EDITABLE(cell), row->typed);
	gtk_widget_set_sensitive(cell, !row->at.constant);
	gtk_widget_remove_css_class(cell, "error");
	name_cell(cell, row, FRESH);
	g_signal_connect(cell, "changed", G_CALLBACK(typed), item);
	g_signal_connect(cell, "activate", G_CALLBACK(typed_through), item);
}

static void bind_comment(GtkWidget *cell, LadderWatchRow *row, GtkListItem *item)
{
	GtkEventController *focus = gtk_event_controller_focus_new();

	gtk_editable_set_text(GTK_EDITABLE(cell), row->line->comment);
	tip_set(cell, row->line->comment);
	name_cell(cell, row, COMMENT);
	g_signal_connect(cell, "activate", G_CALLBACK(comment_activated), item);
	g_signal_connect(focus, "leave", G_CALLBACK(comment_unfocused), item);
	gtk_widget_add_controller(cell, focus);
	g_object_set_data(G_OBJECT(cell), "focus", focus);
	cells_on_take(cell, comment_left, item);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer column)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	switch ((enum column)GPOINTER_TO_INT(column)) {
	case NAME: bind_name(cell, row); break;
	case TYPE: bind_type(cell, row); break;
	case FORMAT: bind_format(cell, row); break;
	case VALUE:
		row->value = cell;
		show_value(row);
		break;
	case FRESH: bind_fresh(cell, row, item); break;
	case FORCE:
		row->force = cell;
		show_force(row);
		name_cell(cell, row, FORCE);
		g_signal_connect(cell, "clicked", G_CALLBACK(force_clicked), item);
		break;
	case COMMENT: bind_comment(cell, row, item); break;
	case COLUMNS: break;
	}
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer column)
{
	LadderWatchRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	g_signal_handlers_disconnect_by_data(cell, item);
	switch ((enum column)GPOINTER_TO_INT(column)) {
	case VALUE: row->value = NULL; break;
	case FRESH: row->fresh = NULL; break;
	case FORCE: row->force = NULL; break;
	case COMMENT:
		cells_on_take(cell, NULL, NULL);
		gtk_widget_remove_controller(cell, g_object_get_data(G_OBJECT(cell),
								     "focus"));
		break;
	case NAME:
	case TYPE:
	case FORMAT:
	case COLUMNS: break;
	}
}

void watch_columns(LadderWatchView *view)
{
	for (int i = 0; i < COLUMNS; i++) {
		GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
		GtkColumnViewColumn *column;

		g_signal_connect(factory, "setup", G_CALLBACK(setup), GINT_TO_POINTER(i));
		g_signal_connect(factory, "bind", G_CALLBACK(bind), GINT_TO_POINTER(i));
		g_signal_connect(factory, "unbind", G_CALLBACK(unbind), GINT_TO_POINTER(i));
		column = gtk_column_view_column_new(_(columns[i].title), factory);
		gtk_column_view_column_set_resizable(column, TRUE);
		gtk_column_view_column_set_expand(column, i == COMMENT);
		if (columns[i].width)
			gtk_column_view_column_set_fixed_width(column, MAX(columns[i].width,
				panel_heading_width(view->list, _(columns[i].title)) +
				HEADING_ROOM));
		gtk_column_view_append_column(GTK_COLUMN_VIEW(view->list), column);
		g_object_unref(column);
	}
}
