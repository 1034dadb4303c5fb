/* SPDX-License-Identifier: MIT
 *
 * manual_window - see manual_window.h.
 */
#include "editor-gtk/panels/manual_window.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/text_lower.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/panels/manual_page.h"

#include <string.h>

#define HITS_MOST 300 /* of a search in all pages                               */
#define ABOVE     0.02 /* of the height, above the place that is shown         */
#define SECTION   2   /* level of the headings in the contents                  */

/* A page and what stands at its top. */
struct place { int page, offset; };
/* A match in the page: in the text, or in a cell of a table. */
struct match { int from, to; GtkWidget *cell; };

struct _LadderManualWindow {
	AdwWindow parent_instance;
	GtkWidget *search, *contents, *place, *view, *find_bar, *find, *found;
	struct manual *manual;
	struct manual_text text;
	int page;                  /* -1: none yet                               */
	GArray *history;           /* struct place; the present one is @at       */
	int at;
	GArray *matches;           /* struct match                               */
	int match;                 /* -1: none                                   */
	GtkTextMark *top;          /* where the view scrolls to                  */
	GtkWidget *copy;           /* button over the code under the pointer    */
	int code;                  /* its block; -1: none                       */
	guint fitting, settling, copying; /* sources                             */
};

G_DEFINE_FINAL_TYPE(LadderManualWindow, ladder_manual_window, ADW_TYPE_WINDOW)

static GtkTextBuffer *buffer_of(LadderManualWindow *window)
{
	return gtk_text_view_get_buffer(GTK_TEXT_VIEW(window->view));
}

/* ---- contents ---- */

static GtkWidget *row_new(const char *text, int indent, int page, int block)
{
	GtkWidget *row = gtk_list_box_row_new(), *label = gtk_label_new(text);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(label), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_lines(GTK_LABEL(label), 2);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_widget_set_margin_start(label, indent);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), label);
	g_object_set_data(G_OBJECT(row), "page", GINT_TO_POINTER(page));
	g_object_set_data(G_OBJECT(row), "block", GINT_TO_POINTER(block));
	spoken_name(row, text);
	return row;
}

static void clear_contents(LadderManualWindow *window)
{
	GtkWidget *row;

	while ((row = gtk_widget_get_first_child(window->contents)))
		gtk_list_box_remove(GTK_LIST_BOX(window->contents), row);
}

static void add_row(LadderManualWindow *window, GtkWidget *row)
{
	gtk_list_box_append(GTK_LIST_BOX(window->contents), row);
}

static void add_sections(LadderManualWindow *window, int page)
{
	const struct md_page *of = manual_page(window->manual, page);

	for (int i = 0; of && i < (int)of->blocks->len; i++) {
		const struct md_block *block = of->blocks->pdata[i];
		char *text = block->kind == MD_HEADING && block->level == SECTION ?
			     markdown_runs_text(block->runs) : NULL;

		if (text)
			add_row(window, row_new(text, 16, page, i));
		g_free(text);
	}
}

/* All pages, and the sections of the present one. */
static void show_contents(LadderManualWindow *window)
{
	clear_contents(window);
	for (int i = 0; i < manual_count(window->manual); i++) {
		const struct md_page *page = manual_page(window->manual, i);
		GtkWidget *row = row_new(page ? page->title : manual_name(window->manual, i), 0,
					 i, -1);

		add_row(window, row);
		if (i == window->page) {
			gtk_widget_add_css_class(row, "current");
			add_sections(window, i);
		}
	}
}

static void show_hits(LadderManualWindow *window, const char *wanted)
{
	GArray *hits = manual_search(window->manual, wanted, HITS_MOST);
	int page = -1;

	clear_contents(window);
	for (guint i = 0; i < hits->len; i++) {
		const struct manual_hit *hit = &g_array_index(hits, struct manual_hit, i);

		if (hit->page != page) {
			GtkWidget *row = row_new(manual_page(window->manual, hit->page)->title,
						 0, hit->page, -1);

			gtk_widget_add_css_class(row, "current");
			add_row(window, row);
		}
		page = hit->page;
		add_row(window, row_new(hit->line, 16, hit->page, hit->block));
	}
	if (!hits->len)
		add_row(window, row_new(_("No page has this text."), 0, -1, -1));
	g_array_unref(hits);
}

static void search_changed(LadderManualWindow *window)
{
	const char *wanted = gtk_editable_get_text(GTK_EDITABLE(window->search));

	if (*wanted)
		show_hits(window, wanted);
	else
		show_contents(window);
}

/* ---- scrolling ---- */

static int offset_at_top(LadderManualWindow *window)
{
	GdkRectangle seen;
	GtkTextIter at;

	gtk_text_view_get_visible_rect(GTK_TEXT_VIEW(window->view), &seen);
	gtk_text_view_get_line_at_y(GTK_TEXT_VIEW(window->view), &at, seen.y, NULL);
	return gtk_text_iter_get_offset(&at);
}

static void scroll_now(LadderManualWindow *window)
{
	gtk_text_view_scroll_to_mark(GTK_TEXT_VIEW(window->view), window->top, ABOVE, TRUE, 1, 0);
}

/* When all lines above have their heights. A wide line must not move the page aside. */
static gboolean settle(gpointer data)
{
	LadderManualWindow *window = data;

	window->settling = 0;
	scroll_now(window);
	gtk_adjustment_set_value(gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(
		window->place)), 0);
	return G_SOURCE_REMOVE;
}

static void scroll_and_settle(LadderManualWindow *window)
{
	scroll_now(window);
	g_clear_handle_id(&window->settling, g_source_remove);
	window->settling = g_idle_add_full(G_PRIORITY_LOW, settle, window, NULL);
}

static void scroll_to(LadderManualWindow *window, int offset)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &at, offset);
	gtk_text_buffer_move_mark(buffer_of(window), window->top, &at);
	gtk_text_buffer_place_cursor(buffer_of(window), &at);
	scroll_and_settle(window);
}

/* ---- copying ---- */

static void put_clipboard(LadderManualWindow *window, char *text)
{
	gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(window)), text);
	g_free(text);
}

/* In place of the copy of GTK, which has nothing in the place of a table. */
static void copy_selected(LadderManualWindow *window)
{
	GtkTextIter from, to;

	g_signal_stop_emission_by_name(window->view, "copy-clipboard");
	if (gtk_text_buffer_get_selection_bounds(buffer_of(window), &from, &to))
		put_clipboard(window, manual_text_copy(&window->text, &from, &to));
}

static enum md_kind kind_of(LadderManualWindow *window, int block)
{
	return ((struct md_block *)window->text.page->blocks->pdata[block])->kind;
}

/* The code or the table at the cursor. */
static void copy_block(LadderManualWindow *window)
{
	GtkTextIter at;
	int block;

	gtk_text_buffer_get_iter_at_mark(buffer_of(window), &at,
					 gtk_text_buffer_get_insert(buffer_of(window)));
	block = manual_text_block(&window->text, &at);
	if (block >= 0 && (kind_of(window, block) == MD_CODE_BLOCK ||
			   kind_of(window, block) == MD_TABLE))
		put_clipboard(window, manual_text_block_copy(&window->text, block));
}

static void copy_code(LadderManualWindow *window)
{
	if (window->code < 0)
		return;
	put_clipboard(window, manual_text_block_copy(&window->text, window->code));
	gtk_button_set_label(GTK_BUTTON(window->copy), _("Copied"));
}

/* At the right end of the first line of the code that is seen. */
static void place_copy(LadderManualWindow *window)
{
	GtkTextView *view = GTK_TEXT_VIEW(window->view);
	GtkRequisition size;
	GdkRectangle seen;
	GtkTextIter at;
	int y;

	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &at, g_array_index(
		window->text.start, int, window->code));
	gtk_text_view_get_line_yrange(view, &at, &y, NULL);
	gtk_text_view_get_visible_rect(view, &seen);
	gtk_widget_get_preferred_size(window->copy, &size, NULL);
	gtk_text_view_move_overlay(view, window->copy, seen.x + seen.width -
		gtk_text_view_get_right_margin(view) - size.width - 2, MAX(y, seen.y) + 2);
}

static gboolean show_copy_now(gpointer data)
{
	LadderManualWindow *window = data;

	window->copying = 0;
	gtk_widget_set_visible(window->copy, window->code >= 0);
	if (window->code < 0)
		return G_SOURCE_REMOVE;
	gtk_button_set_label(GTK_BUTTON(window->copy), _("Copy"));
	place_copy(window);
	return G_SOURCE_REMOVE;
}

/* The pointer also moves to another widget while these are being placed: nothing may ask for
 * another layout then. @code: the block; -1: none. */
static void point_at(LadderManualWindow *window, int code)
{
	if (code == window->code)
		return;
	window->code = code;
	if (!window->copying)
		window->copying = g_idle_add(show_copy_now, window);
}

static void point_away(LadderManualWindow *window)
{
	point_at(window, -1);
}

static void show_copy(LadderManualWindow *window, double x, double y)
{
	GtkTextView *view = GTK_TEXT_VIEW(window->view);
	GtkTextIter at;
	int in_x, in_y, block;

	gtk_text_view_window_to_buffer_coords(view, GTK_TEXT_WINDOW_WIDGET, (int)x, (int)y,
					      &in_x, &in_y);
	gtk_text_view_get_line_at_y(view, &at, in_y, NULL);
	block = manual_text_block(&window->text, &at);
	point_at(window, block >= 0 && kind_of(window, block) == MD_CODE_BLOCK ? block : -1);
}

static void make_copy(LadderManualWindow *window)
{
	window->code = -1;
	window->copy = gtk_button_new_with_label(_("Copy"));
	gtk_widget_add_css_class(window->copy, "manual-copy");
	gtk_widget_set_focusable(window->copy, FALSE); /* Ctrl+Shift+C copies, too */
	gtk_widget_set_visible(window->copy, FALSE);
	gtk_widget_set_cursor_from_name(window->copy, "default");
	tip_set(window->copy, _("Copy the code"));
	g_signal_connect_swapped(window->copy, "clicked", G_CALLBACK(copy_code), window);
	gtk_text_view_add_overlay(GTK_TEXT_VIEW(window->view), window->copy, 0, 0);
	g_signal_connect_swapped(window->view, "copy-clipboard", G_CALLBACK(copy_selected),
				 window);
}

/* ---- pages ---- */

static gboolean follow_in_table(GtkLabel *label, const char *link, gpointer data);

static void tell_history(LadderManualWindow *window)
{
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "manual.back", window->at > 0);
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "manual.forward",
				      window->at + 1 < (int)window->history->len);
}

static void find_all(LadderManualWindow *window);

static void show_page(LadderManualWindow *window, int page)
{
	const struct md_page *of = manual_page(window->manual, page);

	if (page == window->page || !of)
		return;
	window->page = page;
	point_away(window);
	manual_text_show(&window->text, of, manual_folder(window->manual), follow_in_table,
			 window);
	gtk_window_set_title(GTK_WINDOW(window), of->title);
	search_changed(window);
	find_all(window);
}

static int offset_of(LadderManualWindow *window, int block)
{
	return block >= 0 && block < (int)window->text.start->len ?
	       g_array_index(window->text.start, int, block) : 0;
}

/* Keeps where the person was, for Back. */
static void leave(LadderManualWindow *window)
{
	struct place here = { window->page, 0 };

	if (window->page < 0)
		return;
	here.offset = offset_at_top(window);
	if (window->at < (int)window->history->len)
		g_array_index(window->history, struct place, window->at) = here;
}

void ladder_manual_window_show(LadderManualWindow *window, int page, int block)
{
	struct place place = { page, 0 };

	if (!manual_page(window->manual, page))
		return;
	leave(window);
	show_page(window, page);
	place.offset = offset_of(window, block);
	window->at = window->history->len ? window->at + 1 : 0;
	g_array_set_size(window->history, (guint)window->at);
	g_array_append_val(window->history, place);
	scroll_to(window, place.offset);
	tell_history(window);
}

struct manual *ladder_manual_window_manual(LadderManualWindow *window)
{
	return window->manual;
}

static void go_by(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderManualWindow *window = LADDER_MANUAL_WINDOW(widget);
	const int to = window->at + (strcmp(name, "manual.back") == 0 ? -1 : 1);
	struct place place;

	(void)unused;
	if (to < 0 || to >= (int)window->history->len)
		return;
	leave(window);
	window->at = to;
	place = g_array_index(window->history, struct place, to);
	show_page(window, place.page);
	scroll_to(window, place.offset);
	tell_history(window);
}

/* ---- links ---- */

/* Opens another file or an address outside the manual with the program for it. */
static void open_outside(LadderManualWindow *window, const char *link)
{
	GFile *folder = g_file_new_for_path(manual_folder(window->manual));
	GFile *file = strstr(link, "://") ? g_file_new_for_uri(link) :
					    g_file_resolve_relative_path(folder, link);
	char *uri = g_file_get_uri(file);

	gtk_show_uri(GTK_WINDOW(window), uri, GDK_CURRENT_TIME);
	g_free(uri);
	g_object_unref(file);
	g_object_unref(folder);
}

static void follow(LadderManualWindow *window, const char *link)
{
	char **parts = g_strsplit(link, "#", 2);
	const int page = *parts[0] ? manual_find(window->manual, parts[0]) : window->page;

	if (page >= 0)
		ladder_manual_window_show(window, page, parts[1] ?
			manual_anchor(window->manual, page, parts[1]) : -1);
	else
		open_outside(window, link);
	g_strfreev(parts);
}

static gboolean follow_in_table(GtkLabel *label, const char *link, gpointer data)
{
	char *kept = g_strdup(link); /* the label goes with its page             */

	(void)label;
	follow(data, kept);
	g_free(kept);
	return TRUE;
}

static const char *link_at(LadderManualWindow *window, double x, double y)
{
	GtkTextView *view = GTK_TEXT_VIEW(window->view);
	GtkTextIter at;
	int in_x, in_y;

	gtk_text_view_window_to_buffer_coords(view, GTK_TEXT_WINDOW_WIDGET, (int)x, (int)y,
					      &in_x, &in_y);
	return gtk_text_view_get_iter_at_location(view, &at, in_x, in_y) ?
	       manual_text_link(&at) : NULL;
}

static void released(GtkGestureClick *click, int presses, double x, double y,
		     LadderManualWindow *window)
{
	const char *link = link_at(window, x, y);
	char *kept;

	(void)click;
	if (!link || presses != 1 || gtk_text_buffer_get_has_selection(buffer_of(window)))
		return;
	kept = g_strdup(link);
	follow(window, kept);
	g_free(kept);
}

static void moved(GtkEventControllerMotion *motion, double x, double y,
		  LadderManualWindow *window)
{
	(void)motion;
	show_copy(window, x, y);
	gtk_widget_set_cursor_from_name(window->view, link_at(window, x, y) ? "pointer" :
					"text");
}

static void select_link(LadderManualWindow *window, bool back)
{
	GtkTextBuffer *buffer = buffer_of(window);
	GtkTextIter at, end;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	if (!manual_text_next_link(&at, &end, back))
		return;
	gtk_text_buffer_select_range(buffer, &at, &end);
	gtk_text_view_scroll_to_mark(GTK_TEXT_VIEW(window->view),
				     gtk_text_buffer_get_insert(buffer), 0.1, FALSE, 0, 0);
}

/* Tab goes from link to link, Enter follows the one that is selected. */
static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType with, LadderManualWindow *window)
{
	GtkTextIter at;
	char *link;

	(void)keys;
	(void)code;
	if (with & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return GDK_EVENT_PROPAGATE;
	if (key == GDK_KEY_Tab || key == GDK_KEY_ISO_Left_Tab) {
		select_link(window, key == GDK_KEY_ISO_Left_Tab);
		return GDK_EVENT_STOP;
	}
	if (key != GDK_KEY_Return && key != GDK_KEY_KP_Enter)
		return GDK_EVENT_PROPAGATE;
	gtk_text_buffer_get_iter_at_mark(buffer_of(window), &at,
					 gtk_text_buffer_get_insert(buffer_of(window)));
	link = g_strdup(manual_text_link(&at));
	if (link)
		follow(window, link);
	g_free(link);
	return GDK_EVENT_STOP;
}

static void row_activated(GtkListBox *list, GtkListBoxRow *row, LadderManualWindow *window)
{
	const int page = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(row), "page"));
	const int block = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(row), "block"));

	(void)list;
	if (page >= 0)
		ladder_manual_window_show(window, page, block);
}

/* Enter in the search opens the first hit. */
static void search_taken(LadderManualWindow *window)
{
	GtkListBoxRow *row;

	search_changed(window);
	row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(window->contents), 1);
	if (row && *gtk_editable_get_text(GTK_EDITABLE(window->search)))
		row_activated(GTK_LIST_BOX(window->contents), row, window);
}

static void search_stopped(LadderManualWindow *window)
{
	gtk_editable_set_text(GTK_EDITABLE(window->search), "");
	gtk_widget_grab_focus(window->view);
}

/* ---- finding in the page ---- */

static void unmark(LadderManualWindow *window)
{
	const struct match *match = window->match < 0 ? NULL :
		&g_array_index(window->matches, struct match, window->match);

	if (match && match->cell)
		gtk_widget_remove_css_class(match->cell, "found");
	window->match = -1;
}

static void find_in_text(LadderManualWindow *window, const char *wanted, int from, int to)
{
	const int length = (int)g_utf8_strlen(wanted, -1);
	GtkTextIter begin, end;
	char *text, *low;

	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &begin, from);
	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &end, to);
	text = gtk_text_buffer_get_slice(buffer_of(window), &begin, &end, TRUE);
	low = text_lower(text);
	for (const char *at = low; (at = strstr(at, wanted)); at += strlen(wanted)) {
		const int offset = from + (int)g_utf8_pointer_to_offset(low, at);
		const struct match match = { offset, offset + length, NULL };

		g_array_append_val(window->matches, match);
	}
	g_free(low);
	g_free(text);
}

static void find_in_table(LadderManualWindow *window, const char *wanted, int from,
			  GtkWidget *table)
{
	for (GtkWidget *cell = gtk_widget_get_first_child(table); cell;
	     cell = gtk_widget_get_next_sibling(cell)) {
		char *text = text_lower(gtk_label_get_text(GTK_LABEL(cell)));
		const struct match match = { from, from + 1, cell };

		if (strstr(text, wanted))
			g_array_append_val(window->matches, match);
		g_free(text);
	}
}

static void mark(LadderManualWindow *window, const struct match *match)
{
	GtkTextIter from, to;

	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &from, match->from);
	gtk_text_buffer_get_iter_at_offset(buffer_of(window), &to, match->to);
	if (match->cell)
		gtk_widget_add_css_class(match->cell, "found");
	if (match->cell)
		gtk_text_buffer_place_cursor(buffer_of(window), &from);
	else
		gtk_text_buffer_select_range(buffer_of(window), &from, &to);
	g_clear_handle_id(&window->settling, g_source_remove);
	gtk_text_buffer_move_mark(buffer_of(window), window->top, &from);
	gtk_text_view_scroll_to_mark(GTK_TEXT_VIEW(window->view), window->top, 0, TRUE, 1, 0.3);
}

static void show_match(LadderManualWindow *window, int to)
{
	const int count = (int)window->matches->len;
	const bool typed = *gtk_editable_get_text(GTK_EDITABLE(window->find));
	char *text;

	unmark(window);
	window->match = count ? (to + count) % count : -1;
	text = count ? g_strdup_printf(_("%u of %u"), window->match + 1, count) :
	       g_strdup(typed ? _("not found") : "");
	gtk_label_set_text(GTK_LABEL(window->found), text);
	g_free(text);
	if (count)
		mark(window, &g_array_index(window->matches, struct match, window->match));
}

/* The matches of what is typed, in a page that is new or not. */
static void find_all(LadderManualWindow *window)
{
	char *wanted = text_lower(gtk_editable_get_text(GTK_EDITABLE(window->find)));
	const GArray *start = window->text.start;

	g_array_set_size(window->matches, 0);
	window->match = -1;
	for (guint i = 0; *wanted && i < start->len; i++) {
		const int from = g_array_index(start, int, i);
		const int to = i + 1 < start->len ? g_array_index(start, int, i + 1) :
			       gtk_text_buffer_get_char_count(buffer_of(window));

		if (window->text.tables->pdata[i])
			find_in_table(window, wanted, from, window->text.tables->pdata[i]);
		else
			find_in_text(window, wanted, from, to);
	}
	g_free(wanted);
}

static void find_changed(LadderManualWindow *window)
{
	unmark(window);
	find_all(window);
	show_match(window, 0);
}

static void find_next(LadderManualWindow *window)
{
	show_match(window, window->match + 1);
}

static void find_previous(LadderManualWindow *window)
{
	show_match(window, window->match - 1);
}

static void act(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderManualWindow *window = LADDER_MANUAL_WINDOW(widget);

	(void)unused;
	if (strcmp(name, "manual.next") == 0) {
		find_next(window);
	} else if (strcmp(name, "manual.previous") == 0) {
		find_previous(window);
	} else if (strcmp(name, "manual.copy") == 0) {
		copy_block(window);
	} else if (strcmp(name, "manual.search") == 0) {
		gtk_widget_grab_focus(window->search);
	} else {
		gtk_search_bar_set_search_mode(GTK_SEARCH_BAR(window->find_bar), TRUE);
		gtk_widget_grab_focus(window->find);
	}
}

/* Escape closes the bar first, then the window. */
static gboolean escape(GtkWidget *widget, GVariant *unused, gpointer data)
{
	LadderManualWindow *window = LADDER_MANUAL_WINDOW(widget);
	GtkSearchBar *bar = GTK_SEARCH_BAR(window->find_bar);

	(void)unused;
	(void)data;
	if (!gtk_search_bar_get_search_mode(bar)) {
		gtk_window_close(GTK_WINDOW(window));
		return TRUE;
	}
	gtk_search_bar_set_search_mode(bar, FALSE);
	gtk_editable_set_text(GTK_EDITABLE(window->find), "");
	gtk_widget_grab_focus(window->view);
	return TRUE;
}

/* ---- the window ---- */

static gboolean fit_now(gpointer data)
{
	LadderManualWindow *window = data;

	window->fitting = 0;
	manual_text_fit(&window->text);
	scroll_and_settle(window);
	return G_SOURCE_REMOVE;
}

/* During layout nothing may ask for another. */
static void resized(LadderManualWindow *window)
{
	if (!window->fitting)
		window->fitting = g_idle_add(fit_now, window);
}

/* The colours of links and code. */
static void recolour(LadderManualWindow *window)
{
	const int page = window->page;
	const int offset = page < 0 ? 0 : offset_at_top(window);

	if (page < 0)
		return;
	window->page = -1;
	show_page(window, page);
	scroll_to(window, offset);
}

static void dispose(GObject *object)
{
	LadderManualWindow *window = LADDER_MANUAL_WINDOW(object);

	g_clear_handle_id(&window->fitting, g_source_remove);
	g_clear_handle_id(&window->settling, g_source_remove);
	g_clear_handle_id(&window->copying, g_source_remove);
	manual_text_clear(&window->text);
	g_clear_pointer(&window->history, g_array_unref);
	g_clear_pointer(&window->matches, g_array_unref);
	g_clear_pointer(&window->manual, manual_free);
	G_OBJECT_CLASS(ladder_manual_window_parent_class)->dispose(object);
}

static void add_keys(GtkWidgetClass *widget)
{
	static const struct { guint key; GdkModifierType with; const char *action; } keys[] = {
		{ GDK_KEY_Left, GDK_ALT_MASK, "manual.back" },
		{ GDK_KEY_Right, GDK_ALT_MASK, "manual.forward" },
		{ GDK_KEY_f, GDK_CONTROL_MASK, "manual.find" },
		{ GDK_KEY_f, GDK_CONTROL_MASK | GDK_SHIFT_MASK, "manual.search" },
		{ GDK_KEY_F3, 0, "manual.next" }, { GDK_KEY_F3, GDK_SHIFT_MASK, "manual.previous" },
		{ GDK_KEY_c, GDK_CONTROL_MASK | GDK_SHIFT_MASK, "manual.copy" },
		{ GDK_KEY_w, GDK_CONTROL_MASK, "window.close" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(keys); i++)
		gtk_widget_class_add_binding_action(widget, keys[i].key, keys[i].with,
						    keys[i].action, NULL);
	gtk_widget_class_add_binding(widget, GDK_KEY_Escape, 0, escape, NULL);
}

static void ladder_manual_window_class_init(LadderManualWindowClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/manual_window.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderManualWindow, name)
	CHILD(search); CHILD(contents); CHILD(place); CHILD(view); CHILD(find_bar); CHILD(find);
	CHILD(found);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, search_changed);
	gtk_widget_class_bind_template_callback(widget, search_stopped);
	gtk_widget_class_bind_template_callback(widget, search_taken);
	gtk_widget_class_bind_template_callback(widget, row_activated);
	gtk_widget_class_bind_template_callback(widget, find_changed);
	gtk_widget_class_bind_template_callback(widget, find_next);
	gtk_widget_class_bind_template_callback(widget, find_previous);
	gtk_widget_class_install_action(widget, "manual.back", NULL, go_by);
	gtk_widget_class_install_action(widget, "manual.forward", NULL, go_by);
	gtk_widget_class_install_action(widget, "manual.find", NULL, act);
	gtk_widget_class_install_action(widget, "manual.search", NULL, act);
	gtk_widget_class_install_action(widget, "manual.next", NULL, act);
	gtk_widget_class_install_action(widget, "manual.previous", NULL, act);
	gtk_widget_class_install_action(widget, "manual.copy", NULL, act);
	add_keys(widget);
}

static void add_controllers(LadderManualWindow *window)
{
	GtkGesture *click = gtk_gesture_click_new();
	GtkEventController *motion = gtk_event_controller_motion_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	g_signal_connect(click, "released", G_CALLBACK(released), window);
	g_signal_connect(motion, "motion", G_CALLBACK(moved), window);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), window);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(window->view, GTK_EVENT_CONTROLLER(click));
	g_signal_connect_swapped(motion, "leave", G_CALLBACK(point_away), window);
	gtk_widget_add_controller(window->view, motion);
	gtk_widget_add_controller(window->view, keys);
}

static void ladder_manual_window_init(LadderManualWindow *window)
{
	GtkTextIter start;

	gtk_widget_init_template(GTK_WIDGET(window));
	window->page = window->match = -1;
	window->history = g_array_new(FALSE, FALSE, sizeof(struct place));
	window->matches = g_array_new(FALSE, FALSE, sizeof(struct match));
	manual_text_init(&window->text, GTK_TEXT_VIEW(window->view));
	gtk_text_buffer_get_start_iter(buffer_of(window), &start);
	window->top = gtk_text_buffer_create_mark(buffer_of(window), NULL, &start, TRUE);
	gtk_search_bar_connect_entry(GTK_SEARCH_BAR(window->find_bar),
				     GTK_EDITABLE(window->find));
	make_copy(window);
	add_controllers(window);
	spoken_name(window->search, _("Search the manual"));
	spoken_name(window->find, _("Find in this page"));
	g_signal_connect_object(gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(
		window->place)), "notify::page-size", G_CALLBACK(resized), window,
		G_CONNECT_SWAPPED);
	theme_follow(window, G_CALLBACK(recolour));
	tell_history(window);
}

GtkWidget *ladder_manual_window_new(struct manual *manual)
{
	LadderManualWindow *window = g_object_new(LADDER_TYPE_MANUAL_WINDOW, NULL);

	window->manual = manual;
	show_contents(window);
	spoken_parts(GTK_WIDGET(window));
	gtk_window_set_focus(GTK_WINDOW(window), window->view);
	return GTK_WIDGET(window);
}
