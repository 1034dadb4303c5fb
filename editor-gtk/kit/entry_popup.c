/* SPDX-License-Identifier: MIT
 *
 * entry_popup - a line to type in at a place, with what could be meant below it.
 *
 * Enter takes the typed text, or the candidate that the arrows selected; it never selects one
 * by itself. A key of the window, such as Ctrl+S, first takes the typed text and then does
 * its work. Undo and redo belong to the line. Candidates that are not visible at first become
 * widgets only after a pause or when the selection moves there. Rows and popups are reused.
 */
#include "editor-gtk/kit/entry_popup.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/entry_row.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/kit/verbs.h"

#include <string.h>

struct _LadderEntryPopup {
	GtkPopover parent;
	GtkWidget *line, *list, *scroller, *told;
	struct entry_popup_calls calls;
	GPtrArray *rows;    /* of struct entry_popup_row *                     */
	GHashTable *known;  /* the same: no candidate is there twice           */
	guint made;         /* rows that are visible without scrolling, as widgets */
	guint making;       /* timer that makes the others                     */
	bool filling;       /* the program changes the line, not the user      */
	guint asking;       /* idle source: asks for candidates                */
	bool spare;         /* closed, and kept for the next line               */
	bool done;          /* taken or given up: closing is no click elsewhere */
	char *first;        /* the text before the user typed                   */
};

G_DEFINE_FINAL_TYPE(LadderEntryPopup, ladder_entry_popup, GTK_TYPE_POPOVER)

#define LIST_HEIGHT 190
#define ROWS_SEEN   8    /* rows that fill the list                            */
#define REST_MS     120
#define TOLD_WIDTH  60   /* characters: most texts fit in one line              */

static void row_free(gpointer pointer)
{
	struct entry_popup_row *row = pointer;

	g_free(row->text);
	g_free(row->address);
	g_free(row->note);
	g_free(row->kind);
	g_free(row->line);
	g_free(row);
}

/* Text and effect of a candidate. */
static guint row_hash(gconstpointer pointer)
{
	const struct entry_popup_row *row = pointer;

	return g_str_hash(row->text) ^ g_str_hash(row->line);
}

static gboolean row_equal(gconstpointer a, gconstpointer b)
{
	const struct entry_popup_row *one = a, *other = b;

	return strcmp(one->text, other->text) == 0 && strcmp(one->line, other->line) == 0;
}

static char *spelled(LadderEntryPopup *popup, const char *text)
{
	return !text || popup->calls.spelling.spelling == SPELLING_IEC ? g_strdup(text) :
	       spelling_text(&popup->calls.spelling, text);
}

void ladder_entry_popup_add(LadderEntryPopup *popup, const struct entry_popup_row *row)
{
	struct entry_popup_row *copy;

	if (g_hash_table_contains(popup->known, row))
		return;
	copy = g_new(struct entry_popup_row, 1);
	*copy = (struct entry_popup_row){
		spelled(popup, row->text), spelled(popup, row->address), g_strdup(row->note),
		g_strdup(row->kind), spelled(popup, row->line), row->marked,
	};
	g_ptr_array_add(popup->rows, copy);
	g_hash_table_add(popup->known, copy);
}

/* The widget for a candidate: a used one with new texts, or a new one. */
static GtkListBoxRow *widget_of(LadderEntryPopup *popup, int index)
{
	GtkListBox *list = GTK_LIST_BOX(popup->list);
	GtkListBoxRow *widget = gtk_list_box_get_row_at_index(list, index);

	if (widget)
		return widget;
	widget = GTK_LIST_BOX_ROW(gtk_list_box_row_new());
	gtk_list_box_row_set_child(widget, ladder_entry_row_new());
	gtk_widget_set_focusable(GTK_WIDGET(widget), FALSE);
	gtk_list_box_append(list, GTK_WIDGET(widget));
	return widget;
}

static void make_row(LadderEntryPopup *popup, guint index)
{
	const struct entry_popup_row *row = popup->rows->pdata[index];
	GtkListBoxRow *widget = widget_of(popup, (int)index);
	char *name = g_strdup_printf("%s, %s %s %s", row->text, row->kind, row->address,
				     row->note);

	ladder_entry_row_say(LADDER_ENTRY_ROW(gtk_list_box_row_get_child(widget)),
			     row->text, row->address, row->note,
			     row->marked ? row->kind : "");
	gtk_accessible_update_property(GTK_ACCESSIBLE(widget),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_widget_set_visible(GTK_WIDGET(widget), TRUE);
	g_free(name);
}

static void make_rows(LadderEntryPopup *popup, guint count)
{
	while (popup->made < MIN(count, popup->rows->len))
		make_row(popup, popup->made++);
	if (popup->made == popup->rows->len)
		g_clear_handle_id(&popup->making, g_source_remove);
}

static gboolean make_rest(gpointer data)
{
	LadderEntryPopup *popup = data;

	popup->making = 0;
	make_rows(popup, popup->rows->len);
	return G_SOURCE_REMOVE;
}

/* Hides the widgets without a candidate. */
static void hide_rest(LadderEntryPopup *popup)
{
	GtkListBox *list = GTK_LIST_BOX(popup->list);
	GtkListBoxRow *row;

	for (guint i = popup->made; (row = gtk_list_box_get_row_at_index(list, (int)i)); i++)
		gtk_widget_set_visible(GTK_WIDGET(row), FALSE);
}

/* Makes the rows that are visible at once. */
static void make_first(LadderEntryPopup *popup)
{
	make_rows(popup, ROWS_SEEN);
	hide_rest(popup);
	if (popup->made < popup->rows->len && !popup->making)
		popup->making = g_timeout_add(REST_MS, make_rest, popup);
}

static void clear_rows(LadderEntryPopup *popup)
{
	g_clear_handle_id(&popup->making, g_source_remove);
	g_hash_table_remove_all(popup->known);
	g_ptr_array_set_size(popup->rows, 0);
	popup->made = 0;
	gtk_list_box_unselect_all(GTK_LIST_BOX(popup->list));
}

/* ---- what is wrong ---- */

static bool in_word(char c)
{
	return g_ascii_isalnum(c) || c == '_' || (guchar)c >= 0x80;
}

/* The first place of the word that is no part of another one; NULL: there is none. */
static const char *find_word(const char *line, const char *word)
{
	const gsize len = strlen(word);
	const char *at = len ? strstr(line, word) : NULL;

	while (at && ((at > line && in_word(*at) && in_word(at[-1])) ||
		      (in_word(at[len - 1]) && in_word(at[len]))))
		at = strstr(at + 1, word);
	return at;
}

void ladder_entry_popup_wrong(LadderEntryPopup *popup, const char *word, gsize at, gsize len)
{
	const char *line = gtk_editable_get_text(GTK_EDITABLE(popup->line)), *found = find_word(line, word);
	const GdkRGBA *color = &theme_screen()->color[TOKEN_ERROR];
	PangoAttribute *wave[2];
	PangoAttrList *list;

	if (!found)
		return;
	list = pango_attr_list_new();
	wave[0] = pango_attr_underline_new(PANGO_UNDERLINE_ERROR);
	wave[1] = pango_attr_underline_color_new((guint16)(color->red * 65535), (guint16)(color->green * 65535),
						 (guint16)(color->blue * 65535));
	for (gsize i = 0; i < G_N_ELEMENTS(wave); i++) {
		wave[i]->start_index = (guint)((gsize)(found - line) + at);
		wave[i]->end_index = wave[i]->start_index + (guint)len;
		pango_attr_list_insert(list, wave[i]);
	}
	gtk_entry_set_attributes(GTK_ENTRY(popup->line), list);
	pango_attr_list_unref(list);
}

/* The row of a candidate. */
static const char *row_line(LadderEntryPopup *popup, int row)
{
	return ((const struct entry_popup_row *)popup->rows->pdata[row])->line;
}

static const char *line_of(LadderEntryPopup *popup)
{
	return gtk_editable_get_text(GTK_EDITABLE(popup->line));
}

void ladder_entry_popup_ask(LadderEntryPopup *popup)
{
	bool good = true;
	char *told, *said;

	g_clear_handle_id(&popup->asking, g_source_remove);
	clear_rows(popup);
	gtk_entry_set_attributes(GTK_ENTRY(popup->line), NULL);
	told = popup->calls.changed(popup->calls.context, line_of(popup),
				    gtk_editable_get_position(GTK_EDITABLE(popup->line)),
				    &good);
	said = spelled(popup, told ? told : "");
	g_free(told);
	told = said;
	make_first(popup);
	popover_tell(GTK_LABEL(popup->told), told ? told : "");
	gtk_accessible_update_property(GTK_ACCESSIBLE(popup->line),
				       GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, told ? told : "", -1);
	if (good)
		gtk_widget_remove_css_class(popup->told, "error");
	else
		gtk_widget_add_css_class(popup->told, "error");
	/* A scroll bar, even a hidden one, needs the height of two rows. */
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(popup->scroller), GTK_POLICY_NEVER,
				       popup->rows->len < ROWS_SEEN ? GTK_POLICY_NEVER :
				       GTK_POLICY_AUTOMATIC);
	gtk_widget_set_visible(popup->scroller, popup->rows->len > 0);
	g_free(told);
}

static gboolean ask_now(gpointer data)
{
	LadderEntryPopup *popup = data;

	popup->asking = 0;
	ladder_entry_popup_ask(popup);
	return G_SOURCE_REMOVE;
}

/* Candidates come after the letter is drawn: with thousands of symbols they take longer. */
static void changed(LadderEntryPopup *popup)
{
	if (popup->filling)
		return;
	gtk_list_box_unselect_all(GTK_LIST_BOX(popup->list));
	if (!popup->asking)
		popup->asking = g_idle_add(ask_now, popup);
}

static void ask_if_due(LadderEntryPopup *popup)
{
	if (popup->asking)
		ladder_entry_popup_ask(popup);
}

static void set_line(LadderEntryPopup *popup, const char *text)
{
	popup->filling = true;
	gtk_editable_set_text(GTK_EDITABLE(popup->line), text);
	gtk_editable_set_position(GTK_EDITABLE(popup->line), -1);
	popup->filling = false;
	ladder_entry_popup_ask(popup);
}

static int chosen(LadderEntryPopup *popup)
{
	GtkListBoxRow *row = gtk_list_box_get_selected_row(GTK_LIST_BOX(popup->list));

	return row ? gtk_list_box_row_get_index(row) : -1;
}

/* Closes it without taking the line. */
static void close_line(LadderEntryPopup *popup)
{
	popup->done = true;
	gtk_popover_popdown(GTK_POPOVER(popup));
}

static bool take(LadderEntryPopup *popup)
{
	const int row = chosen(popup);
	char *line = g_strdup(row >= 0 ? row_line(popup, row) : line_of(popup));
	bool good;

	g_object_ref(popup);
	good = popup->calls.taken(popup->calls.context, line);
	if (good)
		close_line(popup);
	else
		set_line(popup, line);
	g_object_unref(popup);
	g_free(line);
	return good;
}

/* False: not a key of the window. A line that cannot be taken stays open and says why. */
static bool window_key(LadderEntryPopup *popup, GdkEvent *key)
{
	GtkWidget *owner = gtk_widget_get_parent(GTK_WIDGET(popup));
	const enum verb verb = verb_of_key(key);

	if (verb == VERB_COUNT || verb == VERB_undo || verb == VERB_redo)
		return false;
	g_object_ref(popup);
	if (take(popup) || !*line_of(popup)) { /* an empty line is dropped */
		close_line(popup);
		gtk_widget_activate_action(owner, verb_row(verb)->action, NULL);
	}
	g_object_unref(popup);
	return true;
}

static void row_activated(LadderEntryPopup *popup, GtkListBoxRow *row)
{
	gtk_list_box_select_row(GTK_LIST_BOX(popup->list), row);
	take(popup);
}

static void choose(LadderEntryPopup *popup, int by)
{
	ask_if_due(popup);
	make_rows(popup, popup->rows->len);

	const int count = (int)popup->rows->len;
	const int to = CLAMP(chosen(popup) + by, -1, count - 1);
	GtkListBoxRow *row = to < 0 ? NULL :
		gtk_list_box_get_row_at_index(GTK_LIST_BOX(popup->list), to);
	GtkAdjustment *down = gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(popup->scroller));
	int height;

	gtk_list_box_select_row(GTK_LIST_BOX(popup->list), row);
	if (!row)
		return;
	height = gtk_widget_get_allocated_height(GTK_WIDGET(row));
	gtk_adjustment_clamp_page(down, to * height, (to + 1) * height);
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, LadderEntryPopup *popup)
{
	(void)code;
	(void)state;
	switch (key) {
	case GDK_KEY_Down: case GDK_KEY_KP_Down:
		choose(popup, 1);
		return TRUE;
	case GDK_KEY_Up: case GDK_KEY_KP_Up:
		choose(popup, -1);
		return TRUE;
	case GDK_KEY_Tab:
		ask_if_due(popup);
		if (popup->rows->len == 0)
			return TRUE;
		set_line(popup, row_line(popup, MAX(chosen(popup), 0)));
		return TRUE;
	case GDK_KEY_Escape:
		close_line(popup);
		return TRUE;
	default:
		return window_key(popup, gtk_event_controller_get_current_event(
			GTK_EVENT_CONTROLLER(controller)));
	}
}

/* ---- pasting ---- */

/* Joins lines with blanks. */
static char *joined(const char *text, gsize len)
{
	char *all = g_strstrip(g_strndup(text, len));
	char **lines = g_strsplit_set(all, "\r\n", -1);
	GString *out = g_string_new(NULL);

	for (int i = 0; lines[i]; i++)
		if (*g_strstrip(lines[i]))
			g_string_append_printf(out, "%s%s", out->len ? " " : "", lines[i]);
	g_strfreev(lines);
	g_free(all);
	return g_string_free(out, FALSE);
}

/* Removes line ends, which the toolkit would show as signs and a file cannot hold. */
static void comes(GtkEditable *line, const char *text, int len, int *at)
{
	const gsize size = len < 0 ? strlen(text) : (gsize)len;
	char *one;

	if (!memchr(text, '\n', size) && !memchr(text, '\r', size))
		return;
	one = joined(text, size);
	g_signal_stop_emission_by_name(line, "insert-text");
	gtk_editable_insert_text(line, one, -1, at);
	g_free(one);
}

/* ---- the widget ---- */

/* After a click elsewhere: takes the typed text. False: it could not be taken, and the
 * owner was told. */
static bool leave(LadderEntryPopup *popup)
{
	const struct entry_popup_calls calls = popup->calls;
	char *line = g_strdup(line_of(popup));
	const bool good = !calls.left || strcmp(line, popup->first) == 0 ||
			  calls.taken(calls.context, line);

	popup->done = true;
	if (!good)
		calls.left(calls.context, line);
	g_free(line);
	return good;
}

/* A window that closes while a line is typed takes it as after a click elsewhere. */
static bool leave_now(GtkWidget *widget, GtkListItem *unused)
{
	LadderEntryPopup *popup = LADDER_ENTRY_POPUP(widget);
	bool good;

	(void)unused;
	if (popup->done || popup->spare)
		return true;
	g_object_ref(popup);
	good = leave(popup);
	close_line(popup);
	g_object_unref(popup);
	return good;
}

static void closed(LadderEntryPopup *popup)
{
	void (*gone)(void *);

	if (!popup->done && !popup->spare)
		leave(popup);
	gone = popup->calls.gone;

	popup->calls.gone = NULL;
	g_clear_handle_id(&popup->asking, g_source_remove);
	g_clear_handle_id(&popup->making, g_source_remove);
	if (gone)
		gone(popup->calls.context);
}

static void ladder_entry_popup_finalize(GObject *object)
{
	LadderEntryPopup *popup = LADDER_ENTRY_POPUP(object);

	g_clear_handle_id(&popup->asking, g_source_remove);
	g_clear_handle_id(&popup->making, g_source_remove);
	g_hash_table_unref(popup->known);
	g_ptr_array_unref(popup->rows);
	g_free(popup->first);
	G_OBJECT_CLASS(ladder_entry_popup_parent_class)->finalize(object);
}

static void ladder_entry_popup_class_init(LadderEntryPopupClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_entry_popup_finalize;
}

static void ladder_entry_popup_init(LadderEntryPopup *popup)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
	GtkEventController *keys = gtk_event_controller_key_new();

	popup->rows = g_ptr_array_new_with_free_func(row_free);
	popup->known = g_hash_table_new(row_hash, row_equal);
	popup->line = gtk_entry_new();
	popup->told = gtk_label_new(NULL);
	popup->list = gtk_list_box_new();
	popup->scroller = gtk_scrolled_window_new();
	gtk_editable_set_width_chars(GTK_EDITABLE(popup->line), 34);
	gtk_widget_add_css_class(popup->line, "monospace");
	gtk_label_set_xalign(GTK_LABEL(popup->told), 0);
	gtk_label_set_wrap(GTK_LABEL(popup->told), TRUE);
	gtk_label_set_max_width_chars(GTK_LABEL(popup->told), TOLD_WIDTH);
	gtk_widget_add_css_class(popup->told, "caption");
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(popup->scroller), popup->list);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(popup->scroller),
				       GTK_POLICY_NEVER, GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_propagate_natural_width(
		GTK_SCROLLED_WINDOW(popup->scroller), TRUE);
	gtk_scrolled_window_set_max_content_height(
		GTK_SCROLLED_WINDOW(popup->scroller), LIST_HEIGHT);
	gtk_scrolled_window_set_propagate_natural_height(
		GTK_SCROLLED_WINDOW(popup->scroller), TRUE);
	gtk_list_box_set_activate_on_single_click(GTK_LIST_BOX(popup->list), TRUE);
	gtk_box_append(GTK_BOX(box), popup->line);
	gtk_box_append(GTK_BOX(box), popup->told);
	gtk_box_append(GTK_BOX(box), popup->scroller);
	gtk_popover_set_child(GTK_POPOVER(popup), box);
	gtk_popover_set_position(GTK_POPOVER(popup), GTK_POS_BOTTOM);
	gtk_popover_set_has_arrow(GTK_POPOVER(popup), FALSE);
	gtk_widget_set_halign(GTK_WIDGET(popup), GTK_ALIGN_START);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), popup);
	gtk_widget_add_controller(popup->line, keys);
	g_signal_connect(gtk_editable_get_delegate(GTK_EDITABLE(popup->line)), "insert-text",
			 G_CALLBACK(comes), NULL);
	g_signal_connect_swapped(popup->line, "changed", G_CALLBACK(changed), popup);
	g_signal_connect_swapped(popup->line, "activate", G_CALLBACK(take), popup);
	g_signal_connect_swapped(popup->list, "row-activated", G_CALLBACK(row_activated),
				 popup);
	g_signal_connect(popup, "closed", G_CALLBACK(closed), NULL);
	cells_on_take(GTK_WIDGET(popup), leave_now, NULL);
}

static LadderEntryPopup *spare_of(GtkWidget *owner)
{
	GtkWidget *child = gtk_widget_get_first_child(owner);

	while (child && !(LADDER_IS_ENTRY_POPUP(child) && LADDER_ENTRY_POPUP(child)->spare))
		child = gtk_widget_get_next_sibling(child);
	return child ? LADDER_ENTRY_POPUP(child) : NULL;
}

/* Resets the line to its first text. */
static void use_again(LadderEntryPopup *popup)
{
	popup->spare = false;
	popup->filling = true;
	gtk_editable_set_enable_undo(GTK_EDITABLE(popup->line), FALSE);
	gtk_editable_set_text(GTK_EDITABLE(popup->line), "");
	gtk_editable_set_enable_undo(GTK_EDITABLE(popup->line), TRUE);
	popup->filling = false;
	gtk_adjustment_set_value(gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(popup->scroller)), 0);
}

GtkWidget *ladder_entry_popup_new(GtkWidget *owner, const char *prompt, const char *text,
				  bool typed, const struct entry_popup_calls *calls)
{
	LadderEntryPopup *popup = spare_of(owner);

	if (popup) {
		use_again(popup);
	} else {
		popup = g_object_new(LADDER_TYPE_ENTRY_POPUP, NULL);
		popover_put(GTK_WIDGET(popup), owner);
	}
	popup->calls = *calls;
	popup->done = false;
	g_free(popup->first);
	popup->first = g_strdup(typed || calls->proposes ? "" : text);
	gtk_entry_set_placeholder_text(GTK_ENTRY(popup->line), prompt);
	gtk_accessible_update_property(GTK_ACCESSIBLE(popup->line),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, prompt, -1);
	set_line(popup, text);
	if (!typed)
		gtk_editable_select_region(GTK_EDITABLE(popup->line), 0, -1);
	return GTK_WIDGET(popup);
}

void ladder_entry_popup_keep(LadderEntryPopup *popup)
{
	popup->spare = true;
	gtk_popover_popdown(GTK_POPOVER(popup));
}

void ladder_entry_popup_select(LadderEntryPopup *popup, gsize from, gsize to)
{
	const char *line = line_of(popup);

	gtk_editable_select_region(GTK_EDITABLE(popup->line),
				   (int)g_utf8_pointer_to_offset(line, line + from),
				   (int)g_utf8_pointer_to_offset(line, line + to));
}

void ladder_entry_popup_drop(GtkWidget *owner)
{
	LadderEntryPopup *popup = spare_of(owner);

	if (popup)
		popover_drop(GTK_WIDGET(popup));
}

void ladder_entry_popup_show(LadderEntryPopup *popup, const GdkRectangle *cell)
{
	const int at = gtk_editable_get_position(GTK_EDITABLE(popup->line));
	int from, to;
	const bool selected = gtk_editable_get_selection_bounds(
		GTK_EDITABLE(popup->line), &from, &to);

	popover_point(GTK_WIDGET(popup), cell);
	gtk_popover_popup(GTK_POPOVER(popup));
	gtk_widget_grab_focus(popup->line); /* selects all of it */
	if (selected)
		gtk_editable_select_region(GTK_EDITABLE(popup->line), from, to);
	else
		gtk_editable_set_position(GTK_EDITABLE(popup->line), at);
}
