/* SPDX-License-Identifier: MIT
 *
 * board_bar - I/O maps of the project, and running it on this machine; see board_bar.h.
 */
#include "editor-gtk/window/board_bar.h"

#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/iomap_check.h"
#include "editor-gtk/iomap/board_view.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

static LadderBoardView *board_view(struct board_bar *bar)
{
	return LADDER_BOARD_VIEW(below_panel(bar->core->below, "board"));
}

/* ---- a new map ---- */

/* The map may have been made in this editor or elsewhere; closing the banner records that. */
void board_bar_look(struct board_bar *bar)
{
	if (messages_offers(bar->core->messages, "win.new_iomap") &&
	    ladder_board_view_map(board_view(bar)))
		messages_close_banner(bar->core->messages);
}

static void make_map(gpointer part, const char *path)
{
	struct board_bar *bar = part;
	char *text = iomap_new_text(bar->core->document);
	GError *error = NULL;

	if (disk_save(path, text, strlen(text), &error)) {
		ladder_project_tree_look(bar->core->tree);
		tabs_show_file(bar->core->tabs, path);
		board_bar_look(bar);
	} else {
		messages_warn(bar->core->messages, error->message);
	}
	g_clear_error(&error);
	g_free(text);
}

/* Proposes "garage-door.io" beside "garage-door.rung". */
void board_bar_new_map(struct board_bar *bar)
{
	export_ask(bar->export, _("New I/O map"), ".io", make_map, bar);
}

/* ---- running ---- */

#define MAP_MOST (4 << 20) /* bytes of a map, as in ladderd                    */

/* Logs @text: the log keeps it after the page is closed. */
static void log_board(struct board_bar *bar, const char *text)
{
	messages_log(bar->core->messages, LOG_COMMUNICATION, text);
}

static void warn_board(struct board_bar *bar, const char *text)
{
	messages_banner(bar->core->messages, LOG_COMMUNICATION, text, NULL, NULL);
}

static void start(struct board_bar *bar)
{
	const char *map = ladder_board_view_map(board_view(bar));
	const char *path = ladder_document_path(bar->core->document);
	char *name = map ? g_path_get_basename(map) : g_strdup(""), *text;
	GError *error = NULL;

	below_show(bar->core->below, "board");
	messages_close_banner(bar->core->messages);
	if (ladder_board_run_start(bar->core->board, path, map, &error)) {
		text = g_strdup_printf(_("Started with %s"), name);
		ladder_board_view_put(board_view(bar), text);
		log_board(bar, text);
		messages_tell(bar->core->messages, text);
		g_free(text);
	} else {
		ladder_board_view_put(board_view(bar), error->message);
		warn_board(bar, error->message);
	}
	g_clear_error(&error);
	g_free(name);
}

/* Counts the pins of a map that are read and driven. */
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

static void run_answered(AdwMessageDialog *dialog, const char *answer, struct board_bar *bar)
{
	(void)dialog;
	if (strcmp(answer, "map") == 0)
		board_bar_new_map(bar);
	else if (strcmp(answer, "run") == 0 && files_save_all(bar->files))
		start(bar);
}

/* The facts that the question before a run shows. */
struct question {
	const char *map;
	char *usual;         /* path of the project's own map; NULL: none      */
	bool own;            /* the map belongs to the project, by its name    */
	bool saved;
	int inputs, outputs; /* number of pins of the map                      */
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
static char *question_text(struct board_bar *bar, const struct question *question)
{
	char *name = ladder_document_name(bar->core->document);
	char *board = g_path_get_basename(question->map);
	char *usual = question->usual ? g_path_get_basename(question->usual) :
		origin_name(bar->export->origin, ".io");
	GString *body = g_string_new(NULL);

	g_string_append_printf(body, _("“%s” with %s."), name, board);
	if (!question->own)
		g_string_append_printf(body, _(" %s is not the I/O map of this project, "
					       "which is named %s. Its pins may be wired to "
					       "something else."),
			board, usual);
	add_pins(body, question);
	if (!question->saved)
		g_string_append(body, _(" Unsaved changes are saved first."));
	g_free(usual);
	g_free(board);
	g_free(name);
	return g_string_free(body, FALSE);
}

/* Asks before pins are driven or files are written; warns if the map belongs to another
 * project. */
static void ask(struct board_bar *bar, const struct question *question)
{
	char *body = question_text(bar, question);
	AdwMessageDialog *dialog = ask_new(bar->core->window, _("Run on this machine?"), body,
		"run", question->saved ? _("Run") : _("Save and run"),
		question->own ? ADW_RESPONSE_SUGGESTED : ADW_RESPONSE_DESTRUCTIVE);

	if (!question->usual)
		adw_message_dialog_add_response(dialog, "map", _("New I/O map…"));
	if (!question->own)
		adw_message_dialog_set_default_response(dialog, "cancel");
	core_connect(bar->core, dialog, "response", G_CALLBACK(run_answered), bar, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
}

static void run_with(struct board_bar *bar, const char *map)
{
	const char *path = ladder_document_path(bar->core->document);
	struct question question = {
		.map = map, .usual = iomap_beside(path), .own = iomap_is_own(path, map),
		.saved = files_is_all_saved(bar->files),
	};

	count_pins(map, &question.inputs, &question.outputs);
	if (question.inputs + question.outputs || !question.saved || !question.own)
		ask(bar, &question);
	else
		start(bar);
	g_free(question.usual);
}

/* False: the project has errors; shows them. */
static bool is_sound(struct board_bar *bar)
{
	ladder_document_check_now(bar->core->document);
	if (ladder_document_project(bar->core->document) &&
	    !ladder_document_diags(bar->core->document)->errors)
		return true;
	below_show_error(bar->core->below);
	messages_tell(bar->core->messages, _("Cannot run a program with errors"));
	return false;
}

void board_bar_run(struct board_bar *bar)
{
	LadderSideFile *file = front_file(bar->core->front);
	const char *map;

	if (ladder_board_run_state(bar->core->board) != BOARD_OFF) {
		below_show(bar->core->below, "board");
		messages_tell(bar->core->messages, _("The program already runs on this machine"));
		return;
	}
	if (!is_sound(bar))
		return;
	if (!ladder_document_path(bar->core->document)) {
		messages_tell(bar->core->messages, _("Save the program first"));
		core_do(bar->core, "win.save_as");
		return;
	}
	if (file && g_str_has_suffix(ladder_side_file_path(file), ".io"))
		ladder_board_view_set_map(board_view(bar), ladder_side_file_path(file));
	map = ladder_board_view_map(board_view(bar));
	if (!map) {
		messages_banner(bar->core->messages, LOG_SYSTEM, _("The program has no I/O map. "
							     "Create one to say which pin "
							     "each input and output uses."),
			_("New I/O map…"), "win.new_iomap");
		return;
	}
	run_with(bar, map);
}

void board_bar_stop(struct board_bar *bar)
{
	below_show(bar->core->below, "board");
	ladder_board_run_stop(bar->core->board);
}

/* ---- its end ---- */

static void stop_answered(AdwMessageDialog *dialog, const char *answer, struct board_bar *bar)
{
	(void)dialog;
	if (strcmp(answer, "stop") != 0)
		return;
	if (ladder_board_run_state(bar->core->board) == BOARD_OFF) {
		gtk_window_close(bar->core->window);
		return;
	}
	bar->close_when_off = true;
	ladder_board_run_stop(bar->core->board);
}

bool board_bar_may_close(struct board_bar *bar)
{
	AdwMessageDialog *dialog;

	if (ladder_board_run_state(bar->core->board) == BOARD_OFF)
		return true;
	dialog = ask_new(bar->core->window, _("Stop the program on this machine?"),
			 _("The program drives pins. When it stops, they take their safe "
			   "values."), "stop", _("Stop and close"), ADW_RESPONSE_DESTRUCTIVE);
	core_connect(bar->core, dialog, "response", G_CALLBACK(stop_answered), bar, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	return false;
}

/* "RUN", "FAULT: division by zero …", "STOP: …". Caller frees. */
static char *said_by(enum board_state state, const struct run_status *status)
{
	const char *why = strcmp(status->state, "FAULT") == 0 ? status->fault : status->stop;

	if (state == BOARD_STOPPING)
		return g_strdup(_("STOPPING"));
	if (state != BOARD_RUNNING)
		return NULL;
	return g_strdup_printf("%s%s%s", status->state, *why ? _(": ") : "", why);
}

/* Logs the state only when it changed, because it is polled. */
static void log_state(struct board_bar *bar, enum board_state state)
{
	char *said = said_by(state, ladder_board_run_status(bar->core->board));

	if (said && g_strcmp0(said, bar->said) != 0)
		log_board(bar, said);
	g_free(bar->said);
	bar->said = said;
}

/* What runs is shown as that of any board; a session with another board is not ended for it. */
static void look_inside(struct board_bar *bar)
{
	const char *where = ladder_board_run_where(bar->core->board);
	char *why = NULL;

	if (ladder_board_link_state(bar->core->link) != LINK_OFF)
		return;
	if (!ladder_board_link_connect(bar->core->link, where, &why))
		log_board(bar, why);
	g_free(why);
	g_free(bar->inside);
	bar->inside = g_strdup(where);
}

/* Its socket is gone with it. */
static void look_away(struct board_bar *bar)
{
	if (bar->inside &&
	    g_strcmp0(bar->inside, ladder_board_link_where(bar->core->link)) == 0)
		ladder_board_link_disconnect(bar->core->link);
	g_clear_pointer(&bar->inside, g_free);
}

static void board_changed(struct board_bar *bar)
{
	const enum board_state state = ladder_board_run_state(bar->core->board);

	if (state == BOARD_RUNNING && !bar->ran)
		look_inside(bar);
	if (state == BOARD_RUNNING)
		bar->ran = true;
	else if (state == BOARD_STARTING)
		bar->ran = false;
	else if (state == BOARD_STOPPING)
		look_away(bar);
	core_with(bar->core, WITH_OWN, state != BOARD_OFF);
	log_state(bar, state);
}

/* If ladderd ended before the first scan, its messages are in the log: show it. */
static void board_ended(struct board_bar *bar, int status)
{
	char *text = board_ended_text(status);

	look_away(bar);
	log_board(bar, text);
	g_free(text);
	if (status != 0 && !bar->ran) {
		below_show(bar->core->below, "board");
		warn_board(bar, _("Could not start. See the messages below."));
	}
	if (bar->close_when_off)
		gtk_window_close(bar->core->window);
}

/* ---- life ---- */

static GtkWidget *panel_new(gpointer data)
{
	struct board_bar *bar = data;

	return ladder_board_view_new(bar->core->board, bar->core->document);
}

void board_bar_init(struct board_bar *bar, struct core *core, struct export *export,
		    struct files *files)
{
	bar->core = core;
	bar->export = export;
	bar->files = files;
	below_add(core->below, "board", N_("Board"), panel_new, bar);
	core_connect(core, core->board, "changed", G_CALLBACK(board_changed), bar,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->board, "told", G_CALLBACK(log_board), bar,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->board, "ended", G_CALLBACK(board_ended), bar,
		     G_CONNECT_SWAPPED);
	core_with(core, WITH_OWN, false);
}

void board_bar_clear(struct board_bar *bar)
{
	g_clear_pointer(&bar->said, g_free);
	g_clear_pointer(&bar->inside, g_free);
}
