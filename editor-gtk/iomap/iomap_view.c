/* SPDX-License-Identifier: MIT
 *
 * iomap_view - an I/O map as a table, or as its text.
 */
#include "editor-gtk/iomap/iomap_view.h"

#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/iomap/iomap_live.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/online/board_devices.h"

#include <stdlib.h>
#include <string.h>

/* One page of the table. */
struct page {
	struct panel_list list;
	struct panel_cells cells;
	GtkWidget *columns;     /* the button of its columns, in a box         */
	GtkStackPage *tab;
};

struct _LadderIomapView {
	GtkBox parent;
	GtkTextBuffer *buffer;
	GtkWidget *stack, *tools, *columns, *kinds, *scan_button, *board, *pages, *lacks, *lacks_label, *message;
	struct page page[IOMAP_PAGES];
	enum iomap_page now;    /* the visible page                            */
	struct iomap_live live;
	LadderBoardLink *link;  /* NULL: none yet                              */
	struct iomap_scan *scan;
	bool connected;         /* lines and devices are those of the board, or will be */
	char *untold;           /* why the connected board does not tell them; NULL: it does, or none is connected */
	struct panel_watch *watch;
	struct io_machine machine;
	struct io_devices devices;
	bool looked;            /* for devices                                 */
	struct io_uses uses;
	guint64 version;        /* of the document that @uses is of, + 1; 0: none */
	char *refused;          /* the last refusal; NULL: none                */
	char *said;             /* message about the whole map; NULL: none     */
	char *board_shown;      /* board name last read from the text          */
	bool said_wrong, as_text;
	enum io_kind wanted;    /* of the line to add                          */
	bool opened;            /* the first page with rows has been shown     */
};

G_DEFINE_FINAL_TYPE(LadderIomapView, ladder_iomap_view, GTK_TYPE_BOX)

static guint turned; /* signal */

/* ---- the text ---- */

static char *map_text(LadderIomapView *view)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(view->buffer, &start, &end);
	return gtk_text_buffer_get_text(view->buffer, &start, &end, TRUE);
}

static void iter_at(GtkTextBuffer *buffer, const char *text, size_t at, GtkTextIter *iter)
{
	gtk_text_buffer_get_iter_at_offset(buffer, iter,
					   (int)g_utf8_strlen(text, (gssize)at));
}

/* Applies an edit as one step of the undo. @edit: its text is freed. */
static void apply(LadderIomapView *view, const char *text, struct io_edit *edit)
{
	GtkTextIter from, to;

	iomap_scan_hush(view->scan);
	if (edit->removed || *edit->with) {
		gtk_text_buffer_begin_user_action(view->buffer);
		iter_at(view->buffer, text, edit->at, &from);
		iter_at(view->buffer, text, edit->at + edit->removed, &to);
		gtk_text_buffer_delete(view->buffer, &from, &to);
		gtk_text_buffer_insert(view->buffer, &from, edit->with, -1);
		gtk_text_buffer_end_user_action(view->buffer);
	}
	free(edit->with);
	edit->with = NULL;
}

static const char *refusal(enum io_refusal why)
{
	static const char *const text[] = {
		[IO_GOOD] = "", [IO_MANY_WORDS] = N_("It must be one word, without blanks"),
		[IO_NO_WORD] = N_("This is not one of the choices; Ctrl+Space shows them"),
		[IO_EMPTY] = N_("A value is needed here"),
		[IO_NO_BOARD] = N_("The BOARD line has no name; correct it as text"),
		[IO_BAD_OFFSET] = N_("The number of a line is too large"),
		[IO_BAD_NAME] = N_("This name is too long, or has control characters"),
		[IO_NO_FIELD] = N_("This line has no such value"),
		[IO_SHARED_LINE] = N_("Two statements are in one line; move them as text"),
		[IO_MEMORY] = N_("Out of memory"),
	};

	return _(text[why]);
}

/* Shows a refusal below the table until the next edit succeeds. */
static void tell(LadderIomapView *view, const char *text)
{
	g_free(view->refused);
	view->refused = text ? g_strdup(text) : NULL;
	panel_watch_later(view->watch);
	panel_watch_now(view->watch);
}

static bool done(LadderIomapView *view, const char *text, enum io_refusal why,
		 struct io_edit *edit)
{
	if (why == IO_GOOD)
		apply(view, text, edit);
	tell(view, why == IO_GOOD ? NULL : refusal(why));
	return why == IO_GOOD;
}

/* ---- edits ---- */

static void enter(LadderIomapView *view, int index, enum io_field field);

static struct panel_list *list_now(LadderIomapView *view)
{
	return &view->page[view->now].list;
}

/* A row may be older than the text. */
static bool is_same_row(const struct io_text *io, const LadderPanelRow *row)
{
	const enum iomap_page page = (enum iomap_page)row->table;
	bool same = row->index < io->count && iomap_page_of(io, row->index) == page;

	for (int i = 0; same && iomap_column(page, i) != IO_FIELDS; i++) {
		char *text = iomap_shown(io, row->index, iomap_column(page, i));

		same = strcmp(text, panel_row_text(row, i)) == 0;
		g_free(text);
	}
	return same;
}

static void show_page(LadderIomapView *view, enum iomap_page page)
{
	gtk_stack_set_visible_child(GTK_STACK(view->pages),
				    gtk_stack_page_get_child(view->page[page].tab));
}

/* The row may be on another page now, if its driver is another one. */
static void follow(LadderIomapView *view, int index, enum io_field field)
{
	char *text = map_text(view);
	struct io_text io;
	enum iomap_page page = view->now;

	if (io_text_read(&io, text, strlen(text)) && index < io.count)
		page = iomap_page_of(&io, index);
	io_text_free(&io);
	g_free(text);
	if (page == view->now)
		return;
	panel_watch_later(view->watch);
	panel_watch_now(view->watch);
	show_page(view, page);
	enter(view, index, field);
}

static bool set_column(GObject *owner, LadderPanelRow *row, int column, const char *value,
		       char **why)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(owner);
	const enum io_field field = iomap_column((enum iomap_page)row->table, column);
	const int index = row->index;
	enum io_refusal said = IO_NO_WORD;
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;
	bool good = false;
	char *text;

	if (!view->watch)
		return false; /* the view is disposed */
	text = map_text(view);
	if (io_text_read(&io, text, strlen(text)) && is_same_row(&io, row)) {
		char *typed = iomap_typed(&io, index, field, value);

		said = io_text_set(&io, index, field, typed, &edit);
		g_free(typed);
		good = said == IO_GOOD;
		*why = good ? NULL : g_strdup(refusal(said));
		if (good)
			apply(view, text, &edit);
	}
	io_text_free(&io);
	g_free(text);
	if (good || !*why)
		tell(view, NULL);
	else {
		char *whole = g_strdup_printf(_("%s, %s: %s"), panel_row_text(row, 0),
			iomap_column_name((enum iomap_page)row->table, column), *why);

		tell(view, whole);
		g_free(whole);
	}
	if (good && (field == IO_DRIVER || field == IO_ADDRESS))
		follow(view, index, field);
	return good;
}

static void set_board(LadderIomapView *view)
{
	const char *name = gtk_editable_get_text(GTK_EDITABLE(view->board));
	char *text = map_text(view), *board;
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	io_text_read(&io, text, strlen(text));
	board = io_text_board(&io);
	/* Nothing was shown yet, or nothing changed. */
	if (view->board_shown && g_strcmp0(view->board_shown, name) != 0 &&
	    g_strcmp0(board, name) != 0)
		done(view, text, io_text_set_board(&io, name, &edit), &edit);
	free(board);
	io_text_free(&io);
	g_free(text);
}

static void board_activated(GtkEntry *entry, LadderIomapView *view)
{
	(void)entry;
	set_board(view);
}

static gpointer note_board(GtkWidget *entry, gpointer view)
{
	(void)entry;
	return g_object_ref(view);
}

static void board_left(gpointer data)
{
	LadderIomapView *view = data;

	if (view->watch) /* it is not disposed */
		set_board(view);
}

static void commit(LadderIomapView *view)
{
	panel_cells_commit(list_now(view)->view);
	set_board(view);
}

static struct io_check *check_text(LadderIomapView *view, const char *text)
{
	LadderDocument *document = panel_watch_document(view->watch);
	struct project *project = document ? ladder_document_project(document) : NULL;
	struct areas areas;

	areas_init(&areas);
	if (project)
		project_areas(project, &areas);
	return io_check_new(text, strlen(text), &areas, &view->machine, NULL);
}

/* ---- lines are added, deleted and moved ---- */

static bool is_at(const LadderPanelRow *row, gconstpointer index)
{
	return row->index == *(const int *)index;
}

/* Selects a row of the visible page and puts the focus into a cell. */
static void enter(LadderIomapView *view, int index, enum io_field field)
{
	struct panel_list *list = list_now(view);
	const int column = iomap_column_of(view->now, field);

	if (panel_list_select(list, is_at, &index) && column >= 0)
		cells_enter(list->view, panel_list_row(list), column);
}

/* Index of the selected row; -1: none. */
static int selected(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(list_now(view));

	return row ? row->index : -1;
}

/* The row that begins at a place of the text; -1: none. */
static int row_from(const struct io_text *io, size_t at)
{
	for (int i = 0; i < io->count; i++)
		if (io->row[i].from >= at)
			return i;
	return -1;
}

/* @index: gets the row that was added. */
static bool add_line(LadderIomapView *view, const struct iomap_line *line, const char *comment,
		     int *index)
{
	char *text = map_text(view);
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;
	size_t at = 0;
	bool good;

	io_text_read(&io, text, strlen(text));
	good = io_text_add(&io, line->behind, line->first, line->second, line->words, comment,
			   &edit) == IO_GOOD;
	if (good) {
		at = edit.at;
		apply(view, text, &edit);
	}
	io_text_free(&io);
	g_free(text);
	text = map_text(view);
	io_text_read(&io, text, strlen(text));
	*index = good ? row_from(&io, at) : -1;
	io_text_free(&io);
	g_free(text);
	return good;
}

static void add_kind(LadderIomapView *view, enum io_kind kind)
{
	char *text = map_text(view);
	struct io_check *check = check_text(view, text);
	struct iomap_line line = { .behind = -1 };
	const char *why = NULL;
	struct io_text io;
	int index = -1;
	bool good;

	io_text_read(&io, text, strlen(text));
	good = iomap_line_make(&line, &view->uses, &io, check, &view->machine, &view->devices,
			       view->now, kind, selected(view), &why);
	io_text_free(&io);
	io_check_free(check);
	g_free(text);
	if (good)
		add_line(view, &line, "", &index);
	iomap_line_clear(&line);
	tell(view, good ? NULL : why);
	if (index >= 0)
		enter(view, index, IO_ADDRESS);
}

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	add_kind(LADDER_IOMAP_VIEW(widget), IO_KIND_POINT);
}

static gboolean add_wanted(gpointer data)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(data);

	if (view->watch)
		add_kind(view, view->wanted);
	return G_SOURCE_REMOVE;
}

/* When the menu has closed: it gives the focus back to its button. */
static void add_other(GtkWidget *widget, const char *action, GVariant *kind)
{
	(void)action;
	LADDER_IOMAP_VIEW(widget)->wanted = (enum io_kind)g_variant_get_int32(kind);
	g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, add_wanted, g_object_ref(widget), g_object_unref);
}

static void add_lacking(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	char *whole = map_text(view);
	struct io_check *check = check_text(view, whole);
	struct io_text io;

	(void)action;
	(void)unused;
	io_text_read(&io, whole, strlen(whole));
	gtk_text_buffer_begin_user_action(view->buffer);
	for (int i = 0; i < view->uses.count; i++) {
		const struct io_use *use = &view->uses.use[i];
		char *text = map_text(view);
		struct iomap_line line = { .behind = -1 };
		struct io_text now;
		int index;

		io_text_read(&now, text, strlen(text));
		if (!iomap_has(&io, check, use->addr) && !iomap_has(&now, NULL, use->addr)) {
			iomap_line_for(&line, &now, &view->machine, use->addr);
			add_line(view, &line, use->name, &index);
			iomap_line_clear(&line);
		}
		io_text_free(&now);
		g_free(text);
	}
	gtk_text_buffer_end_user_action(view->buffer);
	io_text_free(&io);
	io_check_free(check);
	g_free(whole);
	tell(view, NULL);
}

static void delete_point(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	LadderPanelRow *row = panel_list_row(list_now(view));
	char *text = map_text(view);
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	(void)action;
	(void)unused;
	io_text_read(&io, text, strlen(text));
	if (row && is_same_row(&io, row))
		done(view, text, io_text_delete(&io, row->index, &edit), &edit);
	io_text_free(&io);
	g_free(text);
}

/* The row of the same page before or behind @index in the text; -1: none. */
static int neighbour(const struct io_text *io, int index, int step)
{
	const enum iomap_page page = iomap_page_of(io, index);

	for (int i = index + step; i >= 0 && i < io->count; i += step)
		if (iomap_page_of(io, i) == page)
			return i;
	return -1;
}

static void move(LadderIomapView *view, int step)
{
	LadderPanelRow *row = panel_list_row(list_now(view));
	char *text = map_text(view);
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;
	int target = -1, column = 0;

	cells_focused(list_now(view)->view, &column);
	io_text_read(&io, text, strlen(text));
	if (row && is_same_row(&io, row))
		target = neighbour(&io, row->index, step);
	if (target >= 0 && done(view, text, io_text_move(&io, row->index, target, step > 0, &edit),
				&edit))
		enter(view, target, iomap_column(view->now, column));
	io_text_free(&io);
	g_free(text);
}

static void move_up(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	move(LADDER_IOMAP_VIEW(widget), -1);
}

static void move_down(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	move(LADDER_IOMAP_VIEW(widget), 1);
}

static void devices_drop(gpointer data)
{
	struct io_devices *devices = data;

	io_devices_free(devices);
	g_free(devices);
}

static void look_thread(GTask *task, gpointer source, gpointer data, GCancellable *stop)
{
	struct io_devices *devices = g_new0(struct io_devices, 1);

	(void)source, (void)data, (void)stop;
	io_devices_look(devices, NULL);
	g_task_return_pointer(task, devices, devices_drop);
}

static void looked(GObject *source, GAsyncResult *result, gpointer data)
{
	GWeakRef *ref = data;
	LadderIomapView *view = g_weak_ref_get(ref);
	struct io_devices *devices = g_task_propagate_pointer(G_TASK(result), NULL);

	(void)source;
	if (view && devices && !view->connected) {
		io_devices_free(&view->devices);
		view->devices = *devices;
		g_free(devices);
	} else if (devices) {
		devices_drop(devices);
	}
	g_clear_object(&view);
	g_weak_ref_clear(ref);
	g_free(ref);
}

/* A sensor may take a second to answer. */
static void look_for_devices(LadderIomapView *view)
{
	GWeakRef *ref = g_new0(GWeakRef, 1);
	GTask *task;

	g_weak_ref_init(ref, view);
	view->looked = true;
	task = g_task_new(NULL, NULL, looked, ref);
	g_task_run_in_thread(task, look_thread);
	g_object_unref(task);
}

static void look(LadderIomapView *view);

static void devices_came(gpointer owner, struct board_devices *came, const char *why)
{
	LadderIomapView *view = owner;

	if (!came) { /* the table offers what this machine has, as without a board */
		if (view->connected && view->watch) {
			view->connected = false;
			g_free(view->untold);
			view->untold = *why ? g_strdup(why) : NULL;
			look(view);
		}
	} else if (view->connected && view->watch) {
		io_machine_free(&view->machine);
		io_devices_free(&view->devices);
		view->machine = came->machine;
		view->devices = came->devices;
		g_free(came);
		tell(view, NULL);
	} else {
		board_devices_free(came);
	}
}

static void look(LadderIomapView *view)
{
	if (view->connected) {
		board_devices_ask(view->link, G_OBJECT(view), devices_came);
		return;
	}
	io_machine_free(&view->machine);
	io_machine_look(&view->machine, NULL);
	look_for_devices(view);
	tell(view, NULL);
}

static void ask_board(LadderIomapView *view)
{
	g_clear_pointer(&view->untold, g_free);
	view->connected = true;
	look(view);
	tell(view, NULL); /* why it did not tell them before is no longer true */
}

static void look_again(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);

	(void)action;
	(void)unused;
	if (view->untold) /* another ladderd may run there now */
		ask_board(view);
	else
		look(view);
}

/* The board is there, or has gone. */
static void link_changed(LadderIomapView *view)
{
	const bool connected = ladder_board_link_state(view->link) == LINK_CONNECTED &&
			       ladder_board_link_may(view->link, SERVICE_DEVICES);

	if (!view->watch || connected == (view->connected || view->untold))
		return; /* or the view is disposed */
	g_clear_pointer(&view->untold, g_free);
	view->connected = connected;
	look(view);
}

void ladder_iomap_view_connect(LadderIomapView *view, LadderBoardLink *link)
{
	if (view->link)
		return;
	view->link = g_object_ref(link);
	g_signal_connect_object(link, "state-changed", G_CALLBACK(link_changed), view, G_CONNECT_SWAPPED);
	link_changed(view);
}

/* ---- the scan of a bus ---- */

static void show_scan(LadderIomapView *view)
{
	const bool runs = iomap_scan_runs(view->scan);
	const char *name = runs ? _("Stop the scan") : _("Scan the bus");

	gtk_button_set_icon_name(GTK_BUTTON(view->scan_button), runs ? "process-stop-symbolic" : "system-search-symbolic");
	tip_set(view->scan_button, name);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->scan_button), GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_widget_set_visible(view->scan_button, view->now == IOMAP_MODBUS || view->now == IOMAP_BUSES);
}

static void scan_changed(gpointer data)
{
	LadderIomapView *view = data;

	if (!view->watch)
		return; /* the view is disposed */
	show_scan(view);
	tell(view, NULL);
}

/* The bus of the selected line; else the first one. */
static void scan_bus(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	char *text = map_text(view);
	const char *why = NULL;
	struct io_text io;
	int bus;

	(void)action;
	(void)unused;
	if (iomap_scan_runs(view->scan)) {
		iomap_scan_stop(view->scan);
	} else {
		io_text_read(&io, text, strlen(text));
		bus = iomap_bus_of(&io, selected(view), true);
		if (bus >= 0)
			iomap_scan_begin(view->scan, &io, bus);
		else
			why = _("This map has no Modbus bus to scan: add a BUS line");
		io_text_free(&io);
	}
	g_free(text);
	show_scan(view);
	tell(view, why);
}

/* ---- messages ---- */

static void show_lacks(LadderIomapView *view, const struct io_text *io,
		       const struct io_check *check)
{
	char *text = iomap_lacks(&view->uses, io, check);

	if (text)
		gtk_label_set_text(GTK_LABEL(view->lacks_label), text);
	gtk_widget_set_visible(view->lacks, text != NULL);
	g_free(text);
}

/* Shows the last refusal, else the error of the selected row, else the message about the
 * whole map. */
static void show_message(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(list_now(view));
	bool failed;
	const char *scanned = iomap_scan_said(view->scan, &failed);
	const char *note = row && !view->refused && !view->as_text && !scanned ? row->note : NULL;
	char *text = view->refused ? g_strdup(view->refused) :
		note ? g_strdup_printf(_("%s: %s"), panel_row_text(row, 0), note) :
		g_strdup(view->said);
	const bool wrong = view->refused || (note ? row->tone == PANEL_ERROR :
					     view->said_wrong);

	gtk_label_set_text(GTK_LABEL(view->message), text ? text : "");
	tip_set(view->message, text);
	gtk_widget_set_visible(view->message, text != NULL);
	gtk_widget_remove_css_class(view->message, wrong ? "dim-label" : "error");
	gtk_widget_add_css_class(view->message, wrong ? "error" : "dim-label");
	g_free(text);
}

/* Behind an error, if there is one. */
static void say_untold(LadderIomapView *view)
{
	char *untold = g_strdup_printf(_("“%s” does not tell its lines and devices (%s). Those to choose from are of this machine."),
				       ladder_board_link_board(view->link), view->untold);
	char *both = g_strdup_printf("%s%s%s", view->said ? view->said : "", view->said ? "  " : "", untold);

	g_free(untold);
	g_free(view->said);
	view->said = both;
}

static void find_said(LadderIomapView *view, const struct io_check *check,
		      const struct io_text *io)
{
	const char *scanned = iomap_scan_said(view->scan, &view->said_wrong);

	g_free(view->said);
	view->said = g_strdup(scanned);
	if (!scanned) {
		view->said = iomap_first_error(check, io, view->as_text);
		view->said_wrong = view->said != NULL;
	}
	if (view->untold && !scanned)
		say_untold(view);
	if (!view->said)
		view->said = iomap_first_doubt(check);
	if (!view->said && view->machine.diags.count)
		view->said = diag_said_whole(&view->machine.diags.diag[0]);
	else if (!view->said && view->machine.elsewhere)
		view->said = g_strdup_printf(_("Lines and devices to choose from are those of “%s”."),
					     ladder_board_link_board(view->link));
	else if (!view->said && !view->machine.count)
		view->said = g_strdup(_("This machine has no GPIO lines. Check on the "
					"board whether the map fits it."));
	show_message(view);
}

/* Underlines wrong lines of the text. */
static void mark_lines(LadderIomapView *view, const struct io_check *check)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(view->buffer, &start, &end);
	gtk_text_buffer_remove_tag_by_name(view->buffer, "wrong", &start, &end);
	for (int i = 0; check && i < check->errors.count; i++) {
		if (!gtk_text_buffer_get_iter_at_line(view->buffer, &start,
						      check->errors.diag[i].line - 1))
			continue;
		end = start;
		if (!gtk_text_iter_ends_line(&end))
			gtk_text_iter_forward_to_line_end(&end);
		gtk_text_buffer_apply_tag_by_name(view->buffer, "wrong", &start, &end);
	}
}

/* ---- refresh ---- */

static void take_uses(LadderIomapView *view)
{
	LadderDocument *document = panel_watch_document(view->watch);
	struct project *project = document ? ladder_document_project(document) : NULL;
	const guint64 version = document ? ladder_document_version(document) + 1 : 1;

	if (view->version == version)
		return;
	view->version = version;
	io_uses_free(&view->uses);
	if (project)
		io_uses_make(&view->uses, project);
}

static void show_board(LadderIomapView *view, const struct io_text *io)
{
	char *board = io_text_board(io);

	/* Does not replace a name that is being typed. */
	if (board && g_strcmp0(board, view->board_shown) != 0) {
		gtk_editable_set_text(GTK_EDITABLE(view->board), board);
		g_free(view->board_shown);
		view->board_shown = g_strdup(board);
	}
	free(board);
}

/* Selects the row of the focused cell. */
static void select_row(struct panel_list *list, int index)
{
	GListModel *model = G_LIST_MODEL(list->selection);

	for (guint i = 0; index >= 0 && i < g_list_model_get_n_items(model); i++) {
		LadderPanelRow *row = g_list_model_get_item(model, i);
		const bool is = row->index == index;

		g_object_unref(row);
		if (is) {
			gtk_single_selection_set_selected(list->selection, i);
			return;
		}
	}
}

static void given_up(GObject *owner)
{
	tell(LADDER_IOMAP_VIEW(owner), NULL);
}

/* "Analog (3)", "Buses (2), errors: 1". */
static void show_title(struct page *page, enum iomap_page number, GPtrArray *rows)
{
	GString *text = g_string_new(iomap_page_name(number));
	int wrong = 0;

	for (guint i = 0; i < rows->len; i++)
		wrong += ((LadderPanelRow *)rows->pdata[i])->tone == PANEL_ERROR;
	if (rows->len)
		g_string_append_printf(text, " (%u)", rows->len);
	if (wrong)
		g_string_append_printf(text, _(", errors: %d"), wrong);
	if (g_strcmp0(gtk_stack_page_get_title(page->tab), text->str) != 0)
		gtk_stack_page_set_title(page->tab, text->str);
	gtk_stack_page_set_needs_attention(page->tab, wrong > 0);
	g_string_free(text, TRUE);
}

static void fill_page(LadderIomapView *view, enum iomap_page number, GPtrArray *rows)
{
	struct page *page = &view->page[number];
	int field, now_field;
	LadderPanelRow *cell = cells_focused(page->list.view, &field), *now;
	const LadderPanelRow *chosen = panel_list_row(&page->list);
	const int row = cell ? cell->index : -1, was = chosen ? chosen->index : -1;

	show_title(page, number, rows);
	panel_list_update(&page->list, rows);
	select_row(&page->list, was);
	now = cells_focused(page->list.view, &now_field);
	if (row >= 0 && !(now && now->index == row && now_field == field))
		panel_cells_focus(GTK_WIDGET(page->list.view), row, field);
}

/* A map is opened at the first page that has rows. */
static void open_page(LadderIomapView *view, GPtrArray *const *rows)
{
	int page = 0;

	if (view->opened)
		return;
	while (page < IOMAP_PAGES - 1 && !rows[page]->len)
		page++;
	view->opened = true;
	show_page(view, rows[page]->len ? (enum iomap_page)page : IOMAP_PINS);
}

static void refresh(GtkWidget *widget)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	GPtrArray *rows[IOMAP_PAGES];
	char *text = map_text(view);
	struct io_check *check;
	struct io_text io;

	take_uses(view);
	check = check_text(view, text);
	io_text_read(&io, text, strlen(text));
	for (int i = 0; i < IOMAP_PAGES; i++)
		rows[i] = g_ptr_array_new_with_free_func(g_object_unref);
	for (int i = 0; i < io.count; i++)
		g_ptr_array_add(rows[iomap_page_of(&io, i)],
				iomap_row_new(&view->uses, &view->machine, &io, check, i));
	open_page(view, rows);
	for (int i = 0; i < IOMAP_PAGES; i++) {
		fill_page(view, (enum iomap_page)i, rows[i]);
		g_ptr_array_unref(rows[i]);
	}
	show_board(view, &io);
	show_lacks(view, &io, check);
	find_said(view, check, &io);
	mark_lines(view, check);
	io_text_free(&io);
	io_check_free(check);
	g_free(text);
}

static GPtrArray *choices_of(GObject *owner, int column)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(owner);
	char *text = map_text(view);
	int row = selected(view);
	GPtrArray *choices;
	struct io_text io;

	io_text_read(&io, text, strlen(text));
	if (row >= io.count)
		row = -1;
	choices = iomap_choices(&view->uses, &view->machine, &view->devices, &io, row,
				iomap_column(view->now, column));
	if (iomap_column(view->now, column) == IO_UNIT) {
		const int bus = iomap_bus_of(&io, row, false);
		char *name = bus < 0 ? NULL : iomap_field(&io, bus, IO_ADDRESS);

		iomap_offer_units(name ? iomap_scan_units(view->scan, name) : NULL, choices);
		g_free(name);
	}
	io_text_free(&io);
	g_free(text);
	return choices;
}

/* ---- life ---- */

static void ladder_iomap_view_dispose(GObject *object)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(object);

	if (view->buffer)
		g_signal_handlers_disconnect_by_data(view->buffer, view->watch);
	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_object(&view->buffer);
	for (int i = 0; i < IOMAP_PAGES; i++)
		panel_list_clear(&view->page[i].list);
	iomap_live_clear(&view->live);
	iomap_scan_stop(view->scan);
	if (view->link)
		g_signal_handlers_disconnect_by_data(view->link, view);
	g_clear_object(&view->link);
	G_OBJECT_CLASS(ladder_iomap_view_parent_class)->dispose(object);
}

static void ladder_iomap_view_finalize(GObject *object)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(object);

	io_machine_free(&view->machine);
	io_devices_free(&view->devices);
	io_uses_free(&view->uses);
	iomap_scan_free(view->scan);
	g_free(view->refused);
	g_free(view->said);
	g_free(view->untold);
	g_free(view->board_shown);
	G_OBJECT_CLASS(ladder_iomap_view_parent_class)->finalize(object);
}

static void ladder_iomap_view_class_init(LadderIomapViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_iomap_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_iomap_view_finalize;
	turned = g_signal_new("turned", LADDER_TYPE_IOMAP_VIEW, G_SIGNAL_RUN_LAST, 0, NULL,
			      NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_install_action(widget, "iomap.add", NULL, add);
	gtk_widget_class_install_action(widget, "iomap.add-kind", "i", add_other);
	gtk_widget_class_install_action(widget, "iomap.delete", NULL, delete_point);
	gtk_widget_class_install_action(widget, "iomap.up", NULL, move_up);
	gtk_widget_class_install_action(widget, "iomap.down", NULL, move_down);
	gtk_widget_class_install_action(widget, "iomap.look", NULL, look_again);
	gtk_widget_class_install_action(widget, "iomap.scan", NULL, scan_bus);
	gtk_widget_class_install_action(widget, "iomap.add-lacking", NULL,
					add_lacking);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/iomap_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderIomapView, name)
	CHILD(stack); CHILD(tools); CHILD(columns); CHILD(kinds); CHILD(scan_button); CHILD(board); CHILD(pages);
	CHILD(lacks); CHILD(lacks_label); CHILD(message);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, board_activated);
}

/* ---- pages ---- */

#define NAME(page) \
	static const char *name_##page(int column) { return iomap_column_name(page, column); }
NAME(IOMAP_PINS) NAME(IOMAP_ANALOG) NAME(IOMAP_MODBUS) NAME(IOMAP_PEERS) NAME(IOMAP_BUSES)
NAME(IOMAP_SERVED)
#undef NAME

static bool is_fixed(const LadderPanelRow *row, int column)
{
	return !(row->flags >> column & 1);
}

static int width_of(enum io_field field)
{
	switch ((int)field) {
	case IO_ADDRESS: return 96;
	case IO_DRIVER: return 90;
	case IO_LINE: return 120;
	case IO_PULL: return 118;
	case IO_DRIVE: return 110;
	case IO_COMMENT: return 110;
	case IO_DEVICE: case IO_CHANNEL: case IO_RANGE: case IO_TABLE: case IO_PORT: case IO_HOST:
	case IO_LISTEN: case IO_NAMES: return 130;
	case IO_BUS: case IO_TYPE: case IO_ACCESS: case IO_AS: return 100;
	default: return 76;
	}
}

static bool has_choices(enum io_field field)
{
	switch ((int)field) {
	case IO_ADDRESS: case IO_DRIVER: case IO_LINE: case IO_BUS: case IO_TYPE: case IO_AS:
	case IO_RAW: case IO_NAMES: case IO_UNIT: return true;
	default: return !io_field_is_flag(field) && io_text_choices(field);
	}
}

/* Columns that leave a narrow table, the first one first. */
static void let_leave(struct page *page, enum iomap_page number)
{
	static const enum io_field stay[] = { IO_ADDRESS, IO_DRIVER, IO_LINE, IO_DEVICE, IO_CHANNEL,
					      IO_BUS, IO_UNIT, IO_TABLE, IO_NUMBER, IO_NAMES, IO_OF };
	static const enum io_field pins[] = { IO_DRIVE, IO_PULL, IO_DEBOUNCE, IO_ACTIVE_LOW,
					      IO_COMMENT, IO_SAFE };
	GtkWidget *button = gtk_menu_button_new();
	int leaving[IOMAP_KIND], count = 0;

	if (number == IOMAP_PINS)
		for (gsize i = 0; i < G_N_ELEMENTS(pins); i++)
			leaving[count++] = iomap_column_of(number, pins[i]);
	else
		for (int i = 0; iomap_column(number, i) != IO_FIELDS; i++) {
			bool stays = false;

			for (gsize k = 0; k < G_N_ELEMENTS(stay); k++)
				stays = stays || stay[k] == iomap_column(number, i);
			if (!stays)
				leaving[count++] = i;
		}
	/* those at the end first */
	for (int i = 0; number != IOMAP_PINS && i < count / 2; i++) {
		const int other = leaving[i];

		leaving[i] = leaving[count - 1 - i];
		leaving[count - 1 - i] = other;
	}
	gtk_menu_button_set_label(GTK_MENU_BUTTON(button), _("Columns"));
	tip_set(button, _("Some columns have no room: choose which are shown"));
	panel_list_may_leave(&page->list, leaving, count, GTK_MENU_BUTTON(button));
	gtk_box_append(GTK_BOX(page->columns), button);
}

static void add_columns(struct page *page, enum iomap_page number, struct iomap_live *live)
{
	const bool points = number < IOMAP_BUSES;

	panel_list_column(&page->list, "", 0, PANEL_ICON, 0);
	if (!points)
		panel_list_column(&page->list, _("Line"), IOMAP_KIND, 0, 84);
	for (int i = 0; iomap_column(number, i) != IO_FIELDS; i++) {
		const enum io_field field = iomap_column(number, i);

		if ((has_choices(field) && !(field == IO_ADDRESS && !points)) ||
		    (number == IOMAP_ANALOG && (field == IO_DEVICE || field == IO_CHANNEL)))
			page->cells.choosable |= 1u << i;
		if (io_field_is_flag(field))
			page->cells.checks |= 1u << i;
	}
	for (int i = 0; iomap_column(number, i) != IO_FIELDS; i++) {
		panel_cells_add(&page->list, &page->cells, i, 0, width_of(iomap_column(number, i)));
		if (i == 0 && points) {
			panel_list_column(&page->list, _("Symbol"), IOMAP_SYMBOL, 0, 105);
			iomap_live_add(live, &page->list);
		}
	}
	panel_list_column(&page->list, _("State"), IOMAP_STATE, PANEL_EXPAND, 150);
}

/* Ctrl+Shift+Up and Ctrl+Shift+Down move a line, also from a cell. */
static void add_keys(GtkWidget *table)
{
	GtkEventController *keys = gtk_shortcut_controller_new();
	static const struct { guint key; const char *action; } row[] = {
		{ GDK_KEY_Up, "iomap.up" }, { GDK_KEY_Down, "iomap.down" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(row); i++)
		gtk_shortcut_controller_add_shortcut(GTK_SHORTCUT_CONTROLLER(keys),
			gtk_shortcut_new(gtk_keyval_trigger_new(row[i].key,
						GDK_CONTROL_MASK | GDK_SHIFT_MASK),
					 gtk_named_action_new(row[i].action)));
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(table, keys);
}

static void add_page(LadderIomapView *view, enum iomap_page number)
{
	static const char *(*const names[IOMAP_PAGES])(int column) = {
		name_IOMAP_PINS, name_IOMAP_ANALOG, name_IOMAP_MODBUS, name_IOMAP_PEERS,
		name_IOMAP_BUSES, name_IOMAP_SERVED,
	};
	struct page *page = &view->page[number];
	GtkWidget *scroller = gtk_scrolled_window_new(), *table = gtk_column_view_new(NULL);
	char *name = g_strdup_printf("%s: %s", _("I/O map"), iomap_page_name(number));

	page->cells = (struct panel_cells){
		.owner = G_OBJECT(view), .later = true, .name = names[number], .set = set_column,
		.given_up = given_up, .is_fixed = is_fixed, .choices = choices_of,
	};
	page->columns = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
	gtk_box_append(GTK_BOX(view->columns), page->columns);
	gtk_widget_set_visible(page->columns, number == IOMAP_PINS);
	gtk_widget_add_css_class(table, "data-table");
	gtk_accessible_update_property(GTK_ACCESSIBLE(table), GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_scrolled_window_set_min_content_height(GTK_SCROLLED_WINDOW(scroller), 32);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_widget_set_hexpand(scroller, TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), table);
	page->tab = gtk_stack_add_titled(GTK_STACK(view->pages), scroller, NULL, iomap_page_name(number));
	panel_list_init(&page->list, GTK_COLUMN_VIEW(table));
	add_columns(page, number, &view->live);
	let_leave(page, number);
	add_keys(table);
	panel_list_follow(&page->list, G_CALLBACK(show_message), view);
	g_free(name);
}

/* Lines that are no points: each kind can be added. */
static void show_kinds(LadderIomapView *view)
{
	static const struct { enum iomap_page page; enum io_kind kind; const char *name; } row[] = {
		{ IOMAP_BUSES, IO_KIND_BUS, N_("Add a bus") },
		{ IOMAP_BUSES, IO_KIND_MODULE, N_("Add a type of module") },
		{ IOMAP_BUSES, IO_KIND_DEVICE, N_("Add what a device takes") },
		{ IOMAP_SERVED, IO_KIND_SERVE, N_("Add a server") },
		{ IOMAP_SERVED, IO_KIND_WINDOW, N_("Add a window of a server") },
		{ IOMAP_SERVED, IO_KIND_PUBLISH, N_("Add variables for other boards") },
	};
	GMenu *menu = g_menu_new();

	for (gsize i = 0; i < G_N_ELEMENTS(row); i++) {
		char *action = g_strdup_printf("iomap.add-kind(%d)", (int)row[i].kind);

		if (row[i].page == view->now)
			g_menu_append(menu, _(row[i].name), action);
		g_free(action);
	}
	gtk_widget_set_visible(view->kinds, g_menu_model_get_n_items(G_MENU_MODEL(menu)) > 0);
	gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(view->kinds), G_MENU_MODEL(menu));
	g_object_unref(menu);
}

static void turn(LadderIomapView *view)
{
	const GtkWidget *child = gtk_stack_get_visible_child(GTK_STACK(view->pages));

	if (!view->watch)
		return; /* the view is disposed */
	for (int i = 0; i < IOMAP_PAGES; i++) {
		const bool is = gtk_stack_page_get_child(view->page[i].tab) == child;

		gtk_widget_set_visible(view->page[i].columns, is);
		if (is)
			view->now = (enum iomap_page)i;
	}
	iomap_scan_hush(view->scan);
	show_kinds(view);
	show_scan(view);
	if (view->now == IOMAP_ANALOG && !view->looked && !view->connected)
		look_for_devices(view);
	tell(view, NULL);
}

static void ladder_iomap_view_init(LadderIomapView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	arena_init(&view->uses.arena);
	arena_init(&view->devices.arena);
	io_machine_look(&view->machine, NULL);
	view->scan = iomap_scan_new(scan_changed, view);
	gtk_widget_init_template(widget);
	left_connect(GTK_WIDGET(view->board), note_board, board_left, g_object_unref, view);
	iomap_live_init(&view->live);
	for (int i = 0; i < IOMAP_PAGES; i++)
		add_page(view, (enum iomap_page)i);
	g_signal_connect_object(view->pages, "notify::visible-child", G_CALLBACK(turn), view,
				G_CONNECT_SWAPPED);
	view->watch = panel_watch_new(widget, true, refresh);
}

static void shown_page(LadderIomapView *view)
{
	if (!view->watch)
		return; /* the view is disposed */
	view->as_text = g_strcmp0(gtk_stack_get_visible_child_name(GTK_STACK(view->stack)),
				  "text") == 0;
	gtk_widget_set_sensitive(view->tools, !view->as_text);
	tell(view, NULL);
	g_signal_emit(view, turned, 0);
}

void ladder_iomap_view_follow(LadderIomapView *view, LadderSim *sim)
{
	iomap_live_follow(&view->live, sim, G_OBJECT(view));
}

bool ladder_iomap_view_is_text(LadderIomapView *view)
{
	return view->as_text;
}

GtkWidget *ladder_iomap_view_new(LadderSideFile *file, GtkWidget *text)
{
	LadderIomapView *view = g_object_new(LADDER_TYPE_IOMAP_VIEW, NULL);
	GtkTextBuffer *buffer = ladder_side_file_buffer(file);

	view->buffer = g_object_ref(buffer);
	gtk_text_buffer_create_tag(buffer, "wrong", "underline", PANGO_UNDERLINE_ERROR, NULL);
	gtk_stack_add_titled(GTK_STACK(view->stack), text, "text", _("Text"));
	g_signal_connect_swapped(buffer, "changed", G_CALLBACK(panel_watch_later),
				 view->watch);
	g_signal_connect_swapped(view->stack, "notify::visible-child", G_CALLBACK(shown_page),
				 view);
	g_signal_connect_object(file, "commit", G_CALLBACK(commit), view, G_CONNECT_SWAPPED);
	panel_watch_set(view->watch, ladder_side_file_document(file));
	panel_watch_later(view->watch);
	return GTK_WIDGET(view);
}
