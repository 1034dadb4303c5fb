/* SPDX-License-Identifier: MIT
 *
 * window_board - I/O maps of a window's project, and running it on this machine.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/iomap/board_view.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/iomap_check.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/panels/panels.h"
#include "editor-gtk/panels/problems.h"

#include <string.h>

static LadderBoardView *board_view(LadderWindow *window)
{
	return LADDER_BOARD_VIEW(below_panel(window, "board"));
}

/* ---- a new map ---- */

/* It may have been made here, or come otherwise; whoever closed the banner knows. */
void window_board_look(LadderWindow *window)
{
	if (window->banner_do == window_new_iomap &&
	    gtk_revealer_get_reveal_child(window->banner) &&
	    ladder_board_view_map(board_view(window)))
		window_banner_close(window);
}

static void make_map(LadderWindow *window, const char *path)
{
	char *text = iomap_new_text(window->document);
	GError *error = NULL;

	if (disk_save(path, text, strlen(text), &error)) {
		ladder_project_tree_look(window->tree);
		tabs_show_file(window, path);
		window_board_look(window);
	} else {
		ladder_window_warn(window, error->message);
	}
	g_clear_error(&error);
	g_free(text);
}

/* "garage-door.io", beside the program. */
void window_new_iomap(LadderWindow *window)
{
	window_ask_where(window, _("New I/O map"), ".io", make_map);
}

/* ---- running ---- */

#define MAP_MOST (4 << 20) /* bytes of a map, as ladderd has it                */

const char *window_board_pill(LadderWindow *window, const char **class)
{
	const struct board_status *status;

	if (!window->board || ladder_board_run_state(window->board) == BOARD_OFF)
		return NULL;
	status = ladder_board_run_status(window->board);
	*class = strcmp(status->state, "FAULT") == 0 ? "fault" :
		strcmp(status->state, "RUN") == 0 ? "run" : "still";
	return _("ON THIS MACHINE");
}

/* What stays in the log when the page is gone. */
static void log_board(LadderWindow *window, const char *text)
{
	window_log(window, _("communication"), text);
}

static void warn_board(LadderWindow *window, const char *text)
{
	window_banner_of(window, _("communication"), text, NULL, NULL);
}

static void start(LadderWindow *window)
{
	const char *map = ladder_board_view_map(board_view(window));
	const char *path = ladder_document_path(window->document);
	char *name = map ? g_path_get_basename(map) : g_strdup(""), *text;
	GError *error = NULL;

	below_show(window, "board");
	window_banner_close(window);
	if (ladder_board_run_start(window->board, path, map, &error)) {
		text = g_strdup_printf(_("Started with %s"), name);
		ladder_board_view_put(board_view(window), text);
		log_board(window, text);
		ladder_window_tell(window, text);
		g_free(text);
	} else {
		ladder_board_view_put(board_view(window), error->message);
		warn_board(window, error->message);
	}
	g_clear_error(&error);
	g_free(name);
}

/* Of the pins of a map: how many are read, how many are driven. */
static void count_pins(const char *map, int *inputs, int *outputs)
{
	gsize len;
	char *text = disk_read(map, MAP_MOST, &len, NULL);
	struct areas areas;
	struct io_check *check;

	areas_init(&areas);
	*inputs = *outputs = 0;
	check = text ? io_check_new(text, len, &areas, NULL, NULL) : NULL;
	for (int i = 0; check && i < check->map.count; i++) {
		const struct io_point *point = &check->map.point[i];

		if (driver_row(point->driver)->needs_line)
			++*(point->output ? outputs : inputs);
	}
	io_check_free(check);
	g_free(text);
}

static bool save_all(LadderWindow *window)
{
	GPtrArray *files = tabs_unsaved(window);
	bool good = true;

	for (guint i = 0; good && i < files->len; i++)
		good = window_save_file(window, files->pdata[i]);
	g_ptr_array_unref(files);
	return good && (ladder_document_is_saved(window->document) ||
			window_save_here(window));
}

static void run_answered(AdwMessageDialog *dialog, const char *answer, LadderWindow *window)
{
	(void)dialog;
	if (strcmp(answer, "map") == 0)
		window_new_iomap(window);
	else if (strcmp(answer, "run") == 0 && save_all(window))
		start(window);
}

static bool is_all_saved(LadderWindow *window)
{
	GPtrArray *files = tabs_unsaved(window);
	const bool saved = ladder_document_is_saved(window->document) && files->len == 0;

	g_ptr_array_unref(files);
	return saved;
}

/* What is asked before a run. */
struct question {
	const char *map;
	char *usual;         /* the project's own map; NULL: it has none       */
	bool own;            /* the map is one of its own, by its name         */
	bool saved;
	int inputs, outputs; /* pins of the map                                */
};

static char *pins(int count)
{
	return g_strdup_printf(ngettext("%d pin", "%d pins", (gulong)count), count);
}

static void add_pins(GString *body, const struct question *question)
{
	char *reads = pins(question->inputs), *drives = pins(question->outputs);

	if (question->inputs + question->outputs)
		g_string_append_printf(body, _(" It reads %s and drives %s."), reads, drives);
	g_free(reads);
	g_free(drives);
}

/* Caller: g_free. */
static char *question_text(LadderWindow *window, const struct question *question)
{
	char *name = ladder_document_name(window->document);
	char *board = g_path_get_basename(question->map);
	char *usual = question->usual ? g_path_get_basename(question->usual) :
		window_name_with(window, ".io");
	GString *body = g_string_new(NULL);

	g_string_append_printf(body, _("“%s” with %s."), name, board);
	if (!question->own)
		g_string_append_printf(body, _(" %s is not this project's own I/O map, "
			"which has the name %s: its pins may be wired to something else."),
			board, usual);
	add_pins(body, question);
	if (!question->saved)
		g_string_append(body, _(" What is not saved is saved first."));
	g_free(usual);
	g_free(board);
	g_free(name);
	return g_string_free(body, FALSE);
}

/* Pins are driven, or files written, only if the person says so: plainly, if the map is
 * another's. */
static void ask(LadderWindow *window, const struct question *question)
{
	char *body = question_text(window, question);
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window),
						   _("Run on this machine?"), body);
	AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);

	adw_message_dialog_add_response(message, "cancel", _("Cancel"));
	if (!question->usual)
		adw_message_dialog_add_response(message, "map", _("New I/O map…"));
	adw_message_dialog_add_response(message, "run", question->saved ? _("Run") :
					_("Save and run"));
	adw_message_dialog_set_response_appearance(message, "run", question->own ?
		ADW_RESPONSE_SUGGESTED : ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_default_response(message, question->own ? "run" : "cancel");
	adw_message_dialog_set_close_response(message, "cancel");
	g_signal_connect_object(dialog, "response", G_CALLBACK(run_answered), window, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
}

static void run_with(LadderWindow *window, const char *map)
{
	const char *path = ladder_document_path(window->document);
	struct question question = {
		.map = map, .usual = iomap_beside(path), .own = iomap_is_own(path, map),
		.saved = is_all_saved(window),
	};

	count_pins(map, &question.inputs, &question.outputs);
	if (question.inputs + question.outputs || !question.saved || !question.own)
		ask(window, &question);
	else
		start(window);
	g_free(question.usual);
}

/* The problems come to the front if there are errors. */
static bool is_sound(LadderWindow *window)
{
	ladder_document_check_now(window->document);
	if (ladder_document_project(window->document) &&
	    !ladder_document_diags(window->document)->errors)
		return true;
	ladder_problems_show_error(LADDER_PROBLEMS(below_show(window, "problems")));
	ladder_window_tell(window, _("A program with errors cannot be run"));
	return false;
}

void window_run_board(LadderWindow *window)
{
	LadderSideFile *file = tabs_file(window) ?
		ladder_file_view_file(tabs_file(window)) : NULL;
	const char *map;

	if (ladder_board_run_state(window->board) != BOARD_OFF) {
		below_show(window, "board");
		ladder_window_tell(window, _("It runs on this machine already"));
		return;
	}
	if (!is_sound(window))
		return;
	if (!ladder_document_path(window->document)) {
		ladder_window_tell(window, _("Save the program first"));
		window_save_as(window);
		return;
	}
	if (file && g_str_has_suffix(ladder_side_file_path(file), ".io"))
		ladder_board_view_set_map(board_view(window), ladder_side_file_path(file));
	map = ladder_board_view_map(board_view(window));
	if (!map) {
		window_banner(window, _("There is no I/O map beside the program: which pin "
			"each input and output is."), _("New I/O map…"), window_new_iomap);
		return;
	}
	run_with(window, map);
}

void window_stop_board(LadderWindow *window)
{
	below_show(window, "board");
	ladder_board_run_stop(window->board);
}

/* ---- its end ---- */

static void stop_answered(AdwMessageDialog *dialog, const char *answer, LadderWindow *window)
{
	(void)dialog;
	if (strcmp(answer, "stop") != 0)
		return;
	if (ladder_board_run_state(window->board) == BOARD_OFF) {
		gtk_window_close(GTK_WINDOW(window));
		return;
	}
	window->close_after_board = true;
	ladder_board_run_stop(window->board);
}

bool window_board_may_close(LadderWindow *window)
{
	GtkWidget *dialog;
	AdwMessageDialog *message;

	if (ladder_board_run_state(window->board) == BOARD_OFF)
		return true;
	dialog = adw_message_dialog_new(GTK_WINDOW(window),
					_("Stop what runs on this machine?"),
					_("The program drives pins. When it is stopped they "
					  "have their safe values."));
	message = ADW_MESSAGE_DIALOG(dialog);
	adw_message_dialog_add_responses(message, "cancel", _("Cancel"), "stop",
					 _("Stop and close"), NULL);
	adw_message_dialog_set_response_appearance(message, "stop",
						   ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_default_response(message, "stop");
	adw_message_dialog_set_close_response(message, "cancel");
	g_signal_connect_object(dialog, "response", G_CALLBACK(stop_answered), window, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	return false;
}

/* "RUN", "FAULT: division by zero …", "STOP: …". Caller frees. */
static char *said_by(enum board_state state, const struct board_status *status)
{
	const char *why = strcmp(status->state, "FAULT") == 0 ? status->fault : status->stop;

	if (state == BOARD_STOPPING)
		return g_strdup(_("STOPPING"));
	if (state != BOARD_RUNNING)
		return NULL;
	return g_strdup_printf("%s%s%s", status->state, *why ? ": " : "", why);
}

/* It is asked for its state again and again: the log has it when it is another. */
static void log_state(LadderWindow *window, enum board_state state)
{
	char *said = said_by(state, ladder_board_run_status(window->board));

	if (said && g_strcmp0(said, window->board_said) != 0)
		log_board(window, said);
	g_free(window->board_said);
	window->board_said = said;
}

static void board_changed(LadderWindow *window)
{
	const enum board_state state = ladder_board_run_state(window->board);

	if (state == BOARD_RUNNING)
		window->board_ran = true;
	else if (state == BOARD_STARTING)
		window->board_ran = false;
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "win.stop_board",
				      state != BOARD_OFF);
	log_state(window, state);
	window_show_pill(window);
}

/* What was refused before it ran must be seen. */
static void board_ended(LadderWindow *window, int status)
{
	char *text = board_ended_text(status);

	log_board(window, text);
	g_free(text);
	if (status != 0 && !window->board_ran) {
		below_show(window, "board");
		warn_board(window, _("It was not run: ladderd says why, below."));
	}
	if (window->close_after_board)
		gtk_window_close(GTK_WINDOW(window));
}

GtkWidget *window_board_new(LadderWindow *window)
{
	return ladder_board_view_new(window->board, window->document);
}

void window_board_init(LadderWindow *window)
{
	g_signal_connect_object(window->board, "changed", G_CALLBACK(board_changed), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->board, "told", G_CALLBACK(log_board), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->board, "ended", G_CALLBACK(board_ended), window,
				G_CONNECT_SWAPPED);
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "win.stop_board", FALSE);
}
