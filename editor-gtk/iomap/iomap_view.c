/* SPDX-License-Identifier: MIT
 *
 * iomap_view - an I/O map as a table, or as its text.
 */
#include "editor-gtk/iomap/iomap_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderIomapView, ladder_iomap_view, GTK_TYPE_BOX)

static guint turned; /* signal */

/* ---- messages ---- */

static void show_lacks(LadderIomapView *view, const struct io_text *io)
{
	char *text = iomap_lacks(&view->uses, io);

	if (text)
		gtk_label_set_text(GTK_LABEL(view->lacks_label), text);
	gtk_widget_set_visible(view->lacks, text != NULL);
	g_free(text);
}

/* What was refused, else what is wrong with the selected row, else what there is to say of
 * the whole map. */
static void show_message(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);
	const char *note = row && !view->refused && !view->as_text ? row->note : NULL;
	char *text = view->refused ? g_strdup(view->refused) :
		note ? g_strdup_printf("%s: %s", panel_row_text(row, IO_ADDRESS), note) :
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
	if (!view->said && view->machine.diags.count)
		view->said = diag_said_whole(&view->machine.diags.diag[0]);
	else if (!view->said && !view->machine.count)
		view->said = g_strdup(_("This machine has no GPIO lines: whether the map "
					"fits a board is seen there."));
	show_message(view);
}

/* Wrong lines of the text are underlined. */
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

/* ---- looking again ---- */

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

	/* What a person types there stays. */
	if (board && g_strcmp0(board, view->board_shown) != 0) {
		gtk_editable_set_text(GTK_EDITABLE(view->board), board);
		g_free(view->board_shown);
		view->board_shown = g_strdup(board);
	}
	free(board);
}

/* -1: none. */
static int selected(LadderIomapView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);

	return row ? row->index : -1;
}

/* The row of the cell with the focus is the one that is meant. */
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

static void entered(gpointer owner, const LadderPanelRow *row)
{
	if (row && selected(owner) != row->index)
		select_row(owner, row->index);
}

static void given_up(gpointer owner)
{
	iomap_view_told(owner, NULL);
}

static void refresh(GtkWidget *widget)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	GtkWidget *list = GTK_WIDGET(view->list.view);
	char *text = iomap_view_text(view);
	struct io_check *check;
	struct io_text io;
	enum io_field field, now_field;
	int row, now;
	const bool focus = iomap_cells_place(list, &row, &field);
	const int was = selected(view);

	take_uses(view);
	check = check_text(view, text);
	io_text_read(&io, text, strlen(text));
	for (int i = 0; i < io.count; i++)
		g_ptr_array_add(rows, iomap_row_new(&view->uses, &view->machine, &io,
						    check, i));
	panel_list_update(&view->list, rows);
	select_row(view, was);
	if (focus && !(iomap_cells_place(list, &now, &now_field) && now == row &&
		       now_field == field))
		iomap_cells_focus(list, row, field);
	show_board(view, &io);
	show_lacks(view, &io);
	find_said(view, check, &io);
	mark_lines(view, check);
	io_text_free(&io);
	io_check_free(check);
	g_free(text);
	g_ptr_array_unref(rows);
}

void ladder_iomap_view_refresh(LadderIomapView *view)
{
	refresh(GTK_WIDGET(view));
}

GListModel *ladder_iomap_view_list(LadderIomapView *view)
{
	return G_LIST_MODEL(view->list.selection);
}

const char *ladder_iomap_view_message(LadderIomapView *view)
{
	return gtk_label_get_text(GTK_LABEL(view->message));
}

static GPtrArray *choices_of(gpointer owner, const LadderPanelRow *row, enum io_field field)
{
	LadderIomapView *view = owner;
	char *text = iomap_view_text(view);
	GPtrArray *choices;
	struct io_text io;

	(void)row;
	io_text_read(&io, text, strlen(text));
	choices = iomap_choices(&view->uses, &view->machine, &io, field);
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
	gtk_widget_class_install_action(widget, "iomap.add", NULL, iomap_view_add);
	gtk_widget_class_install_action(widget, "iomap.delete", NULL, iomap_view_delete);
	gtk_widget_class_install_action(widget, "iomap.look", NULL, iomap_view_look);
	gtk_widget_class_install_action(widget, "iomap.add-lacking", NULL,
					iomap_view_add_lacking);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/iomap_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderIomapView, name)
	CHILD(stack); CHILD(tools); CHILD(board); CHILD(lacks); CHILD(lacks_label);
	CHILD(message);
#undef CHILD
	gtk_widget_class_bind_template_child_full(widget, "view", FALSE, 0);
	gtk_widget_class_bind_template_callback(widget, iomap_view_board_activated);
	gtk_widget_class_bind_template_callback(widget, iomap_view_board_left);
}

static void add_columns(LadderIomapView *view)
{
	static const struct { enum io_field field; int width; } column[] = {
		{ IO_DRIVER, 76 }, { IO_LINE, 120 }, { IO_PULL, 118 }, { IO_ACTIVE_LOW, 70 },
		{ IO_DEBOUNCE, 76 }, { IO_SAFE, 76 }, { IO_DRIVE, 110 },
		{ IO_COMMENT, 110 },
	};

	panel_list_column(&view->list, "", 0, PANEL_ICON, 0);
	panel_list_add(&view->list, io_field_name(IO_ADDRESS), IO_ADDRESS, 0, 96,
		       iomap_cells(IO_ADDRESS, &view->cells));
	panel_list_column(&view->list, _("Symbol"), IOMAP_SYMBOL, 0, 105);
	for (gsize i = 0; i < G_N_ELEMENTS(column); i++)
		panel_list_add(&view->list, io_field_name(column[i].field),
			       (int)column[i].field, 0, column[i].width, iomap_cells(column[i].field, &view->cells));
	panel_list_column(&view->list, _("State"), IOMAP_STATE, PANEL_EXPAND, 150);
}

static void ladder_iomap_view_init(LadderIomapView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	view->cells = (struct iomap_cells){ view, iomap_view_set_field, given_up, entered,
					    choices_of };
	arena_init(&view->uses.arena);
	io_machine_look(&view->machine, NULL);
	gtk_widget_init_template(widget);
	panel_list_init(&view->list, GTK_COLUMN_VIEW(gtk_widget_get_template_child(
		widget, LADDER_TYPE_IOMAP_VIEW, "view")));
	add_columns(view);
	g_signal_connect_object(view->list.selection, "notify::selected-item",
				G_CALLBACK(show_message), view, G_CONNECT_SWAPPED);
	view->watch = panel_watch_new(widget, true, refresh);
}

static void shown_page(LadderIomapView *view)
{
	if (!view->watch)
		return; /* it goes */
	view->as_text = g_strcmp0(gtk_stack_get_visible_child_name(GTK_STACK(view->stack)),
				  "text") == 0;
	gtk_widget_set_sensitive(view->tools, !view->as_text);
	iomap_view_told(view, NULL);
	g_signal_emit(view, turned, 0);
}

bool ladder_iomap_view_is_text(LadderIomapView *view)
{
	return view->as_text;
}

GtkWidget *ladder_iomap_view_new(GtkTextBuffer *buffer, GtkWidget *text,
				 LadderDocument *document)
{
	LadderIomapView *view = g_object_new(LADDER_TYPE_IOMAP_VIEW, NULL);

	view->buffer = g_object_ref(buffer);
	gtk_text_buffer_create_tag(buffer, "wrong", "underline", PANGO_UNDERLINE_ERROR, NULL);
	gtk_stack_add_titled(GTK_STACK(view->stack), text, "text", _("Text"));
	g_signal_connect_swapped(buffer, "changed", G_CALLBACK(panel_watch_later),
				 view->watch);
	g_signal_connect_swapped(view->stack, "notify::visible-child", G_CALLBACK(shown_page),
				 view);
	panel_watch_set(view->watch, document);
	panel_watch_later(view->watch);
	return GTK_WIDGET(view);
}
