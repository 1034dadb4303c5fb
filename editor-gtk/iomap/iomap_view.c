/* SPDX-License-Identifier: MIT
 *
 * iomap_view - an I/O map as a table, or as its text.
 */
#include "editor-gtk/iomap/iomap_view.h"

#include "editor-gtk/document/panel_cells.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <stdlib.h>
#include <string.h>

struct _LadderIomapView {
	GtkBox parent;
	GtkTextBuffer *buffer;
	GtkWidget *stack, *tools, *columns, *board, *lacks, *lacks_label, *message;
	struct panel_list list;
	struct panel_watch *watch;
	struct panel_cells cells;
	struct io_machine machine;
	struct io_uses uses;
	guint64 version;        /* of the document that @uses is of, + 1; 0: none */
	char *refused;          /* the last refusal; NULL: none                */
	char *said;             /* message about the whole map; NULL: none     */
	char *board_shown;      /* board name last read from the text          */
	bool said_wrong, as_text;
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

/* A row may be older than the text. */
static bool is_same_row(const struct io_text *io, const LadderPanelRow *row)
{
	bool same = row->index < io->count;

	for (int i = 0; same && i < IO_FIELDS; i++) {
		char *text = iomap_field(io, row->index, (enum io_field)i);

		same = strcmp(text, panel_row_text(row, i)) == 0;
		g_free(text);
	}
	return same;
}

static bool set_field(GObject *owner, LadderPanelRow *row, int field, const char *value,
		      char **why)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(owner);
	enum io_refusal said = IO_NO_WORD;
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;
	bool good = false;
	char *text;

	if (!view->watch)
		return false; /* the view is disposed */
	text = map_text(view);
	if (io_text_read(&io, text, strlen(text)) && is_same_row(&io, row)) {
		said = io_text_set(&io, row->index, (enum io_field)field, value,
				   &edit);
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
		char *whole = g_strdup_printf(_("%s, %s: %s"), panel_row_text(row, IO_ADDRESS),
					      io_field_name((enum io_field)field), *why);

		tell(view, whole);
		g_free(whole);
	}
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

static void board_left(GtkEventControllerFocus *focus, LadderIomapView *view)
{
	(void)focus;
	set_board(view);
}

static void commit(LadderIomapView *view)
{
	panel_cells_commit(view->list.view);
	set_board(view);
}

/* ---- points are added and deleted ---- */

/* The last row of the same area; -1: none. */
static int last_of(const struct io_text *io, enum iec_area area)
{
	int last = -1;

	for (int i = 0; i < io->count; i++) {
		const struct io_span *word = &io->row[i].word[IO_WORD_ADDRESS];
		struct iec_addr at;

		if (iec_addr_parse(io->text + word->at, word->len, &at) == ADDR_OK &&
		    at.area == area)
			last = i;
	}
	return last;
}

/* The driver of the other points: a map is for a board or for a desk. */
static const char *driver_for(const LadderIomapView *view, const struct io_text *io)
{
	for (int i = 0; i < io->count; i++) {
		const struct io_span *word = &io->row[i].word[IO_WORD_DRIVER];
		const enum driver_id id = driver_find(io->text + word->at, word->len);

		if (id < DRIVER_COUNT)
			return driver_row(id)->word;
	}
	return view->machine.count ? "gpio" : "sim";
}

/* @behind: a row; -1: the last one of its area. */
static void add_point(LadderIomapView *view, struct iec_addr addr, const char *comment,
		      int behind)
{
	char *text = map_text(view), address[24];
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	iec_addr_print(addr, address, sizeof(address));
	io_text_read(&io, text, strlen(text));
	if (behind < 0 || behind >= io.count)
		behind = last_of(&io, addr.area);
	if (io_text_add(&io, behind, address, driver_for(view, &io), comment, &edit) ==
	    IO_GOOD)
		apply(view, text, &edit);
	io_text_free(&io);
	g_free(text);
}

static bool is_row(const LadderPanelRow *row, gconstpointer address)
{
	return strcmp(panel_row_text(row, IO_ADDRESS), address) == 0;
}

/* The first bit that is not in the map, of inputs or of outputs. */
static bool next_address(LadderIomapView *view, enum iec_area area, struct iec_addr *out)
{
	char *text = map_text(view);
	struct io_text io;
	bool found = false;

	io_text_read(&io, text, strlen(text));
	for (uint32_t bit = 0; !found && bit < iec_area_row(area)->usual * 8; bit++) {
		*out = (struct iec_addr){ area, 1, (uint8_t)(bit % 8), bit / 8 };
		found = !iomap_has(&io, *out);
	}
	io_text_free(&io);
	g_free(text);
	return found;
}

static void add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);
	const bool output = row &&
		g_ascii_strncasecmp(panel_row_text(row, IO_ADDRESS), "%Q", 2) == 0;
	struct iec_addr addr;
	char text[24];

	(void)action;
	(void)unused;
	if (!next_address(view, output ? AREA_Q : AREA_I, &addr))
		return;
	add_point(view, addr, "", row ? row->index : -1);
	tell(view, NULL);
	iec_addr_print(addr, text, sizeof(text));
	if (panel_list_select(&view->list, is_row, text))
		cells_enter(view->list.view, panel_list_row(&view->list), IO_ADDRESS);
}

static void add_lacking(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	char *text = map_text(view);
	struct io_text io;

	(void)action;
	(void)unused;
	io_text_read(&io, text, strlen(text));
	gtk_text_buffer_begin_user_action(view->buffer);
	for (int i = 0; i < view->uses.count; i++)
		if (!iomap_has(&io, view->uses.use[i].addr))
			add_point(view, view->uses.use[i].addr, view->uses.use[i].name, -1);
	gtk_text_buffer_end_user_action(view->buffer);
	io_text_free(&io);
	g_free(text);
	tell(view, NULL);
}

static void delete_point(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);
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

static void look_again(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);

	(void)action;
	(void)unused;
	io_machine_free(&view->machine);
	io_machine_look(&view->machine, NULL);
	tell(view, NULL);
}

/* ---- messages ---- */

static void show_lacks(LadderIomapView *view, const struct io_text *io)
{
	char *text = iomap_lacks(&view->uses, io);

	if (text)
		gtk_label_set_text(GTK_LABEL(view->lacks_label), text);
	gtk_widget_set_visible(view->lacks, text != NULL);
	g_free(text);
}

/* Shows the last refusal, else the error of the selected row, else the message about the
 * whole map. */
static void show_message(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);
	const char *note = row && !view->refused && !view->as_text ? row->note : NULL;
	char *text = view->refused ? g_strdup(view->refused) :
		note ? g_strdup_printf(_("%s: %s"), panel_row_text(row, IO_ADDRESS), note) :
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

static void find_said(LadderIomapView *view, const struct io_check *check,
		      const struct io_text *io)
{
	g_free(view->said);
	view->said = iomap_first_error(check, io, view->as_text);
	view->said_wrong = view->said != NULL;
	if (!view->said)
		view->said = iomap_first_doubt(check);
	if (!view->said && view->machine.diags.count)
		view->said = diag_said_whole(&view->machine.diags.diag[0]);
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

/* Index of the selected row; -1: none. */
static int selected(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);

	return row ? row->index : -1;
}

/* Selects the row of the focused cell. */
static void select_row(LadderIomapView *view, int index)
{
	GListModel *model = G_LIST_MODEL(view->list.selection);

	for (guint i = 0; index >= 0 && i < g_list_model_get_n_items(model); i++) {
		LadderPanelRow *row = g_list_model_get_item(model, i);
		const bool is = row->index == index;

		g_object_unref(row);
		if (is) {
			gtk_single_selection_set_selected(view->list.selection, i);
			return;
		}
	}
}

static void given_up(GObject *owner)
{
	tell(LADDER_IOMAP_VIEW(owner), NULL);
}

static void refresh(GtkWidget *widget)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	char *text = map_text(view);
	struct io_check *check;
	struct io_text io;
	int field, now_field;
	LadderPanelRow *cell = cells_focused(view->list.view, &field), *now;
	const int row = cell ? cell->index : -1;
	const int was = selected(view);

	take_uses(view);
	check = check_text(view, text);
	io_text_read(&io, text, strlen(text));
	for (int i = 0; i < io.count; i++)
		g_ptr_array_add(rows, iomap_row_new(&view->uses, &view->machine, &io,
						    check, i));
	panel_list_update(&view->list, rows);
	select_row(view, was);
	now = cells_focused(view->list.view, &now_field);
	if (row >= 0 && !(now && now->index == row && now_field == field))
		panel_cells_focus(GTK_WIDGET(view->list.view), row, field);
	show_board(view, &io);
	show_lacks(view, &io);
	find_said(view, check, &io);
	mark_lines(view, check);
	io_text_free(&io);
	io_check_free(check);
	g_free(text);
	g_ptr_array_unref(rows);
}

static GPtrArray *choices_of(GObject *owner, int field)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(owner);
	char *text = map_text(view);
	GPtrArray *choices;
	struct io_text io;

	io_text_read(&io, text, strlen(text));
	choices = iomap_choices(&view->uses, &view->machine, &io, (enum io_field)field);
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
	panel_list_clear(&view->list);
	G_OBJECT_CLASS(ladder_iomap_view_parent_class)->dispose(object);
}

static void ladder_iomap_view_finalize(GObject *object)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(object);

	io_machine_free(&view->machine);
	io_uses_free(&view->uses);
	g_free(view->refused);
	g_free(view->said);
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
	gtk_widget_class_install_action(widget, "iomap.delete", NULL, delete_point);
	gtk_widget_class_install_action(widget, "iomap.look", NULL, look_again);
	gtk_widget_class_install_action(widget, "iomap.add-lacking", NULL,
					add_lacking);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/iomap_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderIomapView, name)
	CHILD(stack); CHILD(tools); CHILD(columns); CHILD(board); CHILD(lacks); CHILD(lacks_label);
	CHILD(message);
#undef CHILD
	panel_bind_list(widget, LadderIomapView);
	gtk_widget_class_bind_template_callback(widget, board_activated);
	gtk_widget_class_bind_template_callback(widget, board_left);
}

static const char *field_name(int field)
{
	return io_field_name((enum io_field)field);
}

static void add_columns(LadderIomapView *view)
{
	static const struct { enum io_field field; int width; } column[] = {
		{ IO_DRIVER, 76 }, { IO_LINE, 120 }, { IO_PULL, 118 }, { IO_ACTIVE_LOW, 70 },
		{ IO_DEBOUNCE, 76 }, { IO_SAFE, 76 }, { IO_DRIVE, 110 },
		{ IO_COMMENT, 110 },
	};
	static const int leaving[] = { IO_DRIVE, IO_PULL, IO_DEBOUNCE, IO_ACTIVE_LOW, IO_COMMENT,
				       IO_SAFE };

	panel_list_column(&view->list, "", 0, PANEL_ICON, 0);
	panel_cells_add(&view->list, &view->cells, IO_ADDRESS, 0, 96);
	panel_list_column(&view->list, _("Symbol"), IOMAP_SYMBOL, 0, 105);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_cells_add(&view->list, &view->cells, (int)column[i].field, 0,
				column[i].width);
	panel_list_column(&view->list, _("State"), IOMAP_STATE, PANEL_EXPAND, 150);
	panel_list_may_leave(&view->list, leaving, G_N_ELEMENTS(leaving),
			     GTK_MENU_BUTTON(view->columns));
}

static void ladder_iomap_view_init(LadderIomapView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	view->cells = (struct panel_cells){
		.owner = G_OBJECT(view), .checks = 1u << IO_ACTIVE_LOW,
		.choosable = 1u << IO_ADDRESS | 1u << IO_DRIVER | 1u << IO_LINE |
			     1u << IO_PULL | 1u << IO_DRIVE | 1u << IO_SAFE,
		.later = true, .name = field_name, .set = set_field, .given_up = given_up,
		.choices = choices_of,
	};
	arena_init(&view->uses.arena);
	io_machine_look(&view->machine, NULL);
	gtk_widget_init_template(widget);
	panel_list_init(&view->list, view->list.view);
	add_columns(view);
	panel_list_follow(&view->list, G_CALLBACK(show_message), view);
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
