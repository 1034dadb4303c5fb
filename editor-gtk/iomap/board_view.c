/* SPDX-License-Identifier: MIT
 *
 * board_view - the page below the sheets for the program on this machine.
 */
#include "editor-gtk/iomap/board_view.h"

#include "editor-gtk/kit/drop.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/log_text.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define LEFT_WIDTH 400  /* px left of the log                                  */

enum row { ROW_SCANS, ROW_PERIOD, ROW_TIME, ROW_LATE, ROW_IO, ROW_ERRORS, ROWS };

struct _LadderBoardView {
	GtkBox parent;
	LadderBoardRun *run;
	LadderDocument *document;
	GtkDropDown *maps;
	GtkWidget *run_button, *reset_button, *stop_button, *state, *about, *grid, *log;
	GtkWidget *value[ROWS];
	GPtrArray *paths;   /* of the maps in the list                         */
	char *map;          /* path of the selected map; NULL: none            */
	bool chosen;        /* a person chose @map: new files do not change it */
	bool busy;          /* the list is being filled                        */
};

G_DEFINE_FINAL_TYPE(LadderBoardView, ladder_board_view, GTK_TYPE_BOX)

/* ---- the log ---- */

void ladder_board_view_put(LadderBoardView *view, const char *text)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(view->log));
	GtkTextIter end;

	log_text_put(GTK_TEXT_VIEW(view->log), "  ", text);
	gtk_text_buffer_get_end_iter(buffer, &end);
	gtk_text_buffer_place_cursor(buffer, &end);
	gtk_text_view_scroll_mark_onscreen(GTK_TEXT_VIEW(view->log),
					   gtk_text_buffer_get_insert(buffer));
}

static void told(LadderBoardView *view, const char *line)
{
	ladder_board_view_put(view, line);
}

static void ended(LadderBoardView *view, int status)
{
	char *text = board_ended_text(status);

	ladder_board_view_put(view, text);
	g_free(text);
}

/* ---- state ---- */

static const struct { const char *text, *class; } states[] = {
	[BOARD_OFF] = { N_("OFF"), "still" }, [BOARD_STARTING] = { N_("STARTING"), "still" },
	[BOARD_RUNNING] = { "RUN", "run" }, [BOARD_STOPPING] = { N_("STOPPING"), "still" },
};

static void show_state(LadderBoardView *view, enum board_state state,
		       const struct run_status *status)
{
	static const char *const classes[] = { "run", "still", "fault" };
	const bool told_it = state == BOARD_RUNNING && status->state[0];
	const char *class = told_it && strcmp(status->state, "FAULT") == 0 ? "fault" :
		told_it && strcmp(status->state, "STOP") == 0 ? "still" :
		states[state].class;

	for (gsize i = 0; i < G_N_ELEMENTS(classes); i++)
		gtk_widget_remove_css_class(view->state, classes[i]);
	gtk_widget_add_css_class(view->state, class);
	gtk_label_set_text(GTK_LABEL(view->state), told_it ? status->state :
			   _(states[state].text));
	gtk_widget_set_visible(view->reset_button, told_it &&
			       strcmp(status->state, "RUN") != 0);
}

static void show_about(LadderBoardView *view, enum board_state state,
		       const struct run_status *status)
{
	const char *text = state == BOARD_OFF ? "" :
		status->fault[0] && strcmp(status->fault, "none") != 0 ? status->fault :
		status->stop;

	gtk_label_set_text(GTK_LABEL(view->about), text);
	tip_set(view->about, text);
}

static void show_value(LadderBoardView *view, enum row row, const char *text)
{
	gtk_label_set_text(GTK_LABEL(view->value[row]), text);
	tip_set(view->value[row], text);
}

/* "10000.0 us" is 10 ms. */
static void show_period(LadderBoardView *view, const char *told_us)
{
	const double us = g_ascii_strtod(told_us, NULL);
	char *text = us >= 1000 ? g_strdup_printf("%g ms", us / 1000) : g_strdup(told_us);

	show_value(view, ROW_PERIOD, text);
	g_free(text);
}

static void show(LadderBoardView *view)
{
	const enum board_state state = ladder_board_run_state(view->run);
	const struct run_status *status = ladder_board_run_status(view->run);
	char *times = *status->mean ? g_strdup_printf(_("%s, at worst %s"), status->mean,
						      status->worst) : g_strdup("");

	show_state(view, state, status);
	show_about(view, state, status);
	show_value(view, ROW_SCANS, status->scans);
	show_period(view, status->period);
	show_value(view, ROW_TIME, times);
	show_value(view, ROW_LATE, status->late);
	show_value(view, ROW_IO, status->io);
	show_value(view, ROW_ERRORS, status->errors);
	gtk_widget_set_visible(view->run_button, state == BOARD_OFF);
	gtk_widget_set_visible(view->stop_button, state != BOARD_OFF);
	gtk_widget_set_sensitive(GTK_WIDGET(view->maps), state == BOARD_OFF);
	g_free(times);
}

static void reset_clicked(GtkButton *button, LadderBoardView *view)
{
	(void)button;
	ladder_board_run_reset(view->run);
}

/* ---- maps ---- */

static guint index_of(const GPtrArray *paths, const char *path)
{
	for (guint i = 0; path && i < paths->len; i++)
		if (strcmp(paths->pdata[i], path) == 0)
			return i;
	return GTK_INVALID_LIST_POSITION;
}

/* Lists the files of the folder again. */
static void fill(LadderBoardView *view)
{
	const char *path = ladder_document_path(view->document);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);

	g_ptr_array_unref(view->paths);
	/* The program's own maps first. */
	view->paths = side_file_list(path, ".io", true);
	g_ptr_array_extend_and_steal(view->paths, side_file_list(path, ".io", false));
	if (view->map && g_file_test(view->map, G_FILE_TEST_EXISTS) &&
	    index_of(view->paths, view->map) == GTK_INVALID_LIST_POSITION)
		g_ptr_array_add(view->paths, g_strdup(view->map));
	for (guint i = 0; i < view->paths->len; i++)
		g_ptr_array_add(names, g_path_get_basename(view->paths->pdata[i]));
	if (!view->paths->len)
		g_ptr_array_add(names, g_strdup(_("no I/O map")));
	view->busy = true;
	drop_fill(view->maps, names);
	view->busy = false;
	g_ptr_array_unref(names);
}

/* Without a choice by the person: the first map, which is the program's own if it has one. */
static void select_map(LadderBoardView *view)
{
	const guint at = view->chosen ? index_of(view->paths, view->map) :
		GTK_INVALID_LIST_POSITION;
	const guint first = at == GTK_INVALID_LIST_POSITION ? 0 : at;
	const char *path = view->paths->len ? view->paths->pdata[first] : NULL;

	if (g_strcmp0(path, view->map) != 0) {
		g_free(view->map);
		view->map = g_strdup(path);
	}
	view->busy = true;
	gtk_drop_down_set_selected(view->maps, first);
	view->busy = false;
}

static void look(LadderBoardView *view)
{
	fill(view);
	select_map(view);
}

static void map_selected(GtkDropDown *maps, GParamSpec *spec, LadderBoardView *view)
{
	const guint at = gtk_drop_down_get_selected(maps);

	(void)spec;
	if (view->busy || at >= view->paths->len)
		return;
	g_free(view->map);
	view->map = g_strdup(view->paths->pdata[at]);
	view->chosen = true;
}

const char *ladder_board_view_map(LadderBoardView *view)
{
	look(view);
	return view->map;
}

void ladder_board_view_set_map(LadderBoardView *view, const char *path)
{
	g_free(view->map);
	view->map = g_strdup(path);
	view->chosen = true;
	look(view);
}

/* ---- life ---- */

static void ladder_board_view_dispose(GObject *object)
{
	LadderBoardView *view = LADDER_BOARD_VIEW(object);

	g_clear_object(&view->run);
	g_clear_object(&view->document);
	G_OBJECT_CLASS(ladder_board_view_parent_class)->dispose(object);
}

static void ladder_board_view_finalize(GObject *object)
{
	LadderBoardView *view = LADDER_BOARD_VIEW(object);

	g_ptr_array_unref(view->paths);
	g_free(view->map);
	G_OBJECT_CLASS(ladder_board_view_parent_class)->finalize(object);
}

static void ladder_board_view_class_init(LadderBoardViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_board_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_board_view_finalize;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/board_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderBoardView, name)
	CHILD(maps); CHILD(run_button); CHILD(reset_button); CHILD(stop_button);
	CHILD(state); CHILD(about); CHILD(grid); CHILD(log);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, map_selected);
	gtk_widget_class_bind_template_callback(widget, reset_clicked);
}

static void add_rows(LadderBoardView *view)
{
	static const char *const name[ROWS] = {
		[ROW_SCANS] = N_("Scans"), [ROW_PERIOD] = N_("Period"),
		[ROW_TIME] = N_("Time of a scan"), [ROW_LATE] = N_("Late"),
		[ROW_IO] = N_("Lines"), [ROW_ERRORS] = N_("Errors"),
	};

	static const struct { int column, row, width; } place[ROWS] = {
		[ROW_SCANS] = { 0, 0, 1 }, [ROW_LATE] = { 2, 0, 1 },
		[ROW_PERIOD] = { 0, 1, 1 }, [ROW_ERRORS] = { 2, 1, 1 },
		[ROW_TIME] = { 0, 2, 3 }, [ROW_IO] = { 0, 3, 3 },
	};

	for (int i = 0; i < ROWS; i++) {
		GtkWidget *label = gtk_label_new(_(name[i]));

		view->value[i] = gtk_label_new(NULL);
		gtk_label_set_xalign(GTK_LABEL(label), 0);
		gtk_widget_add_css_class(label, "dim-label");
		gtk_label_set_xalign(GTK_LABEL(view->value[i]), 0);
		gtk_label_set_ellipsize(GTK_LABEL(view->value[i]), PANGO_ELLIPSIZE_END);
		gtk_widget_set_hexpand(view->value[i], TRUE);
		gtk_widget_add_css_class(view->value[i], "numeric");
		gtk_grid_attach(GTK_GRID(view->grid), label, place[i].column, place[i].row,
				1, 1);
		gtk_grid_attach(GTK_GRID(view->grid), view->value[i], place[i].column + 1,
				place[i].row, place[i].width, 1);
	}
}

static void ladder_board_view_init(LadderBoardView *view)
{
	GtkWidget *left;

	view->paths = g_ptr_array_new_with_free_func(g_free);
	gtk_widget_init_template(GTK_WIDGET(view));
	left = gtk_widget_get_first_child(GTK_WIDGET(view));
	gtk_widget_set_size_request(left, LEFT_WIDTH, -1);
	gtk_widget_set_hexpand(left, FALSE);
	add_rows(view);
}

GtkWidget *ladder_board_view_new(LadderBoardRun *run, LadderDocument *document)
{
	LadderBoardView *view = g_object_new(LADDER_TYPE_BOARD_VIEW, NULL);

	view->run = g_object_ref(run);
	view->document = g_object_ref(document);
	g_signal_connect_object(run, "changed", G_CALLBACK(show), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(run, "told", G_CALLBACK(told), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(run, "ended", G_CALLBACK(ended), view, G_CONNECT_SWAPPED);
	g_signal_connect(view, "map", G_CALLBACK(look), NULL);
	look(view);
	show(view);
	return GTK_WIDGET(view);
}
