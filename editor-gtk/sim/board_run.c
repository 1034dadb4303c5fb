/* SPDX-License-Identifier: MIT
 *
 * board_run - ladderd as a child process: see board_run.h.
 */
#include "editor-gtk/sim/board_run.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/installed.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#define ASK_MS 300 /* between two requests for its status                      */
#define FOLDER "rungboard-run-"
#define NEW_US 60000000 /* a folder whose ladderd may not listen yet           */

struct _LadderBoardRun {
	GObject parent;
	enum board_state state;
	struct run_status status;
	GSubprocess *child;
	GCancellable *cancel;
	guint timer;
	char *folder, *where; /* private: its socket, its slots; NULL: it does not run */
	int open;          /* streams that have not ended, plus 1 for the child */
	int exit;
};

G_DEFINE_FINAL_TYPE(LadderBoardRun, ladder_board_run, G_TYPE_OBJECT)

enum { CHANGED, TOLD, ENDED, SIGNALS };
static guint signals[SIGNALS];

/* ---- its folder ---- */

static void empty_folder(const char *folder)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	const char *name;

	while (dir && (name = g_dir_read_name(dir))) {
		char *path = g_build_filename(folder, name, NULL);

		if (!g_file_test(path, G_FILE_TEST_IS_SYMLINK) &&
		    g_file_test(path, G_FILE_TEST_IS_DIR))
			empty_folder(path);
		g_remove(path);
		g_free(path);
	}
	g_clear_pointer(&dir, g_dir_close);
}

/* Whether a ladderd listens at @path, or may. */
static bool is_heard(const char *path)
{
	struct sockaddr_un at = { .sun_family = AF_UNIX };
	const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	bool heard = true;

	if (fd >= 0 && g_strlcpy(at.sun_path, path, sizeof(at.sun_path)) < sizeof(at.sun_path))
		heard = connect(fd, (const struct sockaddr *)&at, sizeof(at)) == 0 ||
			(errno != ECONNREFUSED && errno != ENOENT);
	if (fd >= 0)
		close(fd);
	return heard;
}

/* Whether @folder holds what make_folder() puts there, and nothing else: another program's
 * folder may have a name like it. */
static bool is_of_a_run(const char *folder)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	bool group = false, others = !dir;
	const char *name;

	while (dir && (name = g_dir_read_name(dir))) {
		group = group || strcmp(name, "group") == 0;
		others = others || (strcmp(name, "group") != 0 && strcmp(name, "link") != 0 &&
				    strcmp(name, "slots") != 0);
	}
	g_clear_pointer(&dir, g_dir_close);
	return group && !others;
}

static void drop_left(const char *folder)
{
	char *path = g_build_filename(folder, "link", NULL);
	GStatBuf about;

	if (g_lstat(folder, &about) == 0 && S_ISDIR(about.st_mode) && about.st_uid == getuid() &&
	    g_get_real_time() - (gint64)about.st_mtime * 1000000 > NEW_US && is_of_a_run(folder) &&
	    !is_heard(path)) {
		empty_folder(folder);
		g_rmdir(folder);
	}
	g_free(path);
}

/* An editor that was killed leaves its folder. */
static void drop_all_left(void)
{
	GDir *dir = g_dir_open(g_get_tmp_dir(), 0, NULL);
	const char *name;

	while (dir && (name = g_dir_read_name(dir))) {
		char *path = g_build_filename(g_get_tmp_dir(), name, NULL);

		if (g_str_has_prefix(name, FOLDER))
			drop_left(path);
		g_free(path);
	}
	g_clear_pointer(&dir, g_dir_close);
}

/* The only group of its link is that of this user: whoever reaches the socket may do all. */
static bool make_folder(LadderBoardRun *run, GError **error)
{
	char *group, *path, *slots;
	bool good;

	drop_all_left();
	run->folder = g_dir_make_tmp(FOLDER "XXXXXX", error); /* 0700 */
	if (!run->folder)
		return false;
	run->where = g_strdup_printf("unix:%s/link", run->folder);
	group = g_strdup_printf("ladder-eng:x:%u:\n", (unsigned)getegid());
	path = g_build_filename(run->folder, "group", NULL);
	slots = g_build_filename(run->folder, "slots", NULL);
	good = g_file_set_contents(path, group, -1, error);
	if (good && g_mkdir(slots, 0700) != 0) {
		g_set_error_literal(error, G_IO_ERROR, g_io_error_from_errno(errno),
				    g_strerror(errno));
		good = false;
	}
	g_free(slots);
	g_free(path);
	g_free(group);
	return good;
}

static void drop_folder(LadderBoardRun *run)
{
	if (run->folder) {
		empty_folder(run->folder);
		g_rmdir(run->folder);
	}
	g_clear_pointer(&run->folder, g_free);
	g_clear_pointer(&run->where, g_free);
}

/* ---- end ---- */

/* One of its streams, or the child, has ended. */
static void close_one(LadderBoardRun *run)
{
	const int status = run->exit;

	if (--run->open > 0)
		return;
	g_clear_handle_id(&run->timer, g_source_remove);
	g_clear_object(&run->child);
	g_clear_object(&run->cancel);
	drop_folder(run);
	run->state = BOARD_OFF;
	memset(&run->status, 0, sizeof(run->status));
	g_signal_emit(run, signals[CHANGED], 0);
	g_signal_emit(run, signals[ENDED], 0, status);
}

static void waited(GObject *child, GAsyncResult *result, gpointer data)
{
	GError *error = NULL;
	LadderBoardRun *run;

	g_subprocess_wait_finish(G_SUBPROCESS(child), result, &error);
	if (g_error_matches(error, G_IO_ERROR, G_IO_ERROR_CANCELLED)) {
		g_error_free(error);
		return; /* @data is gone */
	}
	g_clear_error(&error);
	run = LADDER_BOARD_RUN(data);
	run->exit = g_subprocess_get_if_exited(G_SUBPROCESS(child)) ?
		g_subprocess_get_exit_status(G_SUBPROCESS(child)) : -1;
	close_one(run);
}

char *board_ended_text(int status)
{
	return status == 0 ? g_strdup(_("Ended; outputs have their safe values")) :
		status < 0 ? g_strdup(_("ladderd was ended by a signal")) :
		g_strdup_printf(_("ladderd ended with status %d"), status);
}

/* ---- status and log ---- */

/* "last 1.0 us, mean 2.0 us, max 3.0 us": the text after @word. */
static void take_part(char *out, size_t size, const char *text, const char *word)
{
	const char *at = strstr(text, word);
	size_t len;

	if (!at)
		return;
	at += strlen(word);
	len = strcspn(at, ",");
	snprintf(out, size, "%.*s", (int)(len < size ? len : size - 1), at);
}

bool board_status_line(struct run_status *status, const char *line)
{
	const struct { const char *word; char *out; size_t size; } row[] = {
		{ "state: ", status->state, sizeof(status->state) },
		{ "fault: ", status->fault, sizeof(status->fault) },
		{ "stop: ", status->stop, sizeof(status->stop) },
		{ "errors: ", status->errors, sizeof(status->errors) },
		{ "scans: ", status->scans, sizeof(status->scans) },
		{ "period: ", status->period, sizeof(status->period) },
		{ "late: ", status->late, sizeof(status->late) },
		{ "io: ", status->io, sizeof(status->io) },
	};

	if (!*line)
		return true;
	if (strncmp(line, "state: ", 7) == 0)
		status->stop[0] = '\0'; /* a line follows only if there is one */
	if (strncmp(line, "scan: ", 6) == 0) {
		take_part(status->mean, sizeof(status->mean), line, "mean ");
		take_part(status->worst, sizeof(status->worst), line, "max ");
	}
	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++)
		if (strncmp(line, row[i].word, strlen(row[i].word)) == 0)
			snprintf(row[i].out, row[i].size, "%s",
				 line + strlen(row[i].word));
	return false;
}

static void read_on(LadderBoardRun *run, GDataInputStream *stream);

static void take_line(LadderBoardRun *run, const char *line, bool status)
{
	if (!status) {
		g_signal_emit(run, signals[TOLD], 0, line);
		return;
	}
	if (!board_status_line(&run->status, line))
		return;
	if (run->state == BOARD_STARTING)
		run->state = BOARD_RUNNING;
	g_signal_emit(run, signals[CHANGED], 0);
}

static void read_line(GObject *stream, GAsyncResult *result, gpointer data)
{
	GError *error = NULL;
	char *line = g_data_input_stream_read_line_finish(G_DATA_INPUT_STREAM(stream),
							  result, NULL, &error);
	LadderBoardRun *run;
	char *text;

	if (g_error_matches(error, G_IO_ERROR, G_IO_ERROR_CANCELLED)) {
		g_error_free(error);
		return; /* @data is gone */
	}
	g_clear_error(&error);
	run = LADDER_BOARD_RUN(data);
	if (!line) {
		close_one(run);
		return;
	}
	text = g_utf8_make_valid(line, -1);
	g_free(line);
	g_object_ref(run);
	take_line(run, text, g_object_get_data(stream, "status") != NULL);
	if (run->cancel)
		read_on(run, G_DATA_INPUT_STREAM(stream));
	g_object_unref(run);
	g_free(text);
}

static void read_on(LadderBoardRun *run, GDataInputStream *stream)
{
	g_data_input_stream_read_line_async(stream, G_PRIORITY_DEFAULT, run->cancel,
					    read_line, run);
}

static void listen_to(LadderBoardRun *run, GInputStream *pipe, bool status)
{
	GDataInputStream *stream = g_data_input_stream_new(pipe);

	if (status)
		g_object_set_data(G_OBJECT(stream), "status", run);
	read_on(run, stream);
	g_object_unref(stream);
}

static gboolean ask(gpointer data)
{
	LadderBoardRun *run = data;

	g_subprocess_send_signal(run->child, SIGUSR1);
	return G_SOURCE_CONTINUE;
}

/* ---- begin ---- */

/* SIGUSR1 would end ladderd before it has its handler. */
static void in_child(gpointer unused)
{
	(void)unused;
	signal(SIGUSR1, SIG_IGN);
}

static GSubprocess *spawn(LadderBoardRun *run, const char *program, const char *file,
			  const char *map, GError **error)
{
	char *socket = g_build_filename(run->folder, "link", NULL);
	char *group = g_build_filename(run->folder, "group", NULL);
	char *slots = g_build_filename(run->folder, "slots", NULL);
	GSubprocessLauncher *launcher = g_subprocess_launcher_new(
		G_SUBPROCESS_FLAGS_STDIN_PIPE | G_SUBPROCESS_FLAGS_STDOUT_PIPE |
		G_SUBPROCESS_FLAGS_STDERR_PIPE);
	GSubprocess *child;

	g_subprocess_launcher_set_child_setup(launcher, in_child, NULL, NULL);
	/* ladderd must not report to the service manager of the editor. */
	g_subprocess_launcher_unsetenv(launcher, "NOTIFY_SOCKET");
	g_subprocess_launcher_unsetenv(launcher, "WATCHDOG_USEC");
	child = g_subprocess_launcher_spawn(launcher, error, program, "--attended", "--link",
					    socket, "--groups", group, "--slots", slots, "--io",
					    map, "--", file, NULL);
	g_free(slots);
	g_free(group);
	g_free(socket);
	g_object_unref(launcher);
	return child;
}

bool ladder_board_run_start(LadderBoardRun *run, const char *file, const char *map,
			    GError **error)
{
	char *program = installed_program("ladderd");

	if (!program) {
		g_set_error(error, G_IO_ERROR, G_IO_ERROR_NOT_FOUND,
			    _("ladderd, which runs programs on pins, was not found beside "
			      "this editor or in PATH: install it"));
		return false;
	}
	run->child = make_folder(run, error) ? spawn(run, program, file, map, error) : NULL;
	g_free(program);
	if (!run->child) {
		drop_folder(run);
		return false;
	}
	run->cancel = g_cancellable_new();
	run->state = BOARD_STARTING;
	run->exit = -1;
	run->open = 3;
	memset(&run->status, 0, sizeof(run->status));
	listen_to(run, g_subprocess_get_stdout_pipe(run->child), true);
	listen_to(run, g_subprocess_get_stderr_pipe(run->child), false);
	g_subprocess_wait_async(run->child, run->cancel, waited, run);
	run->timer = g_timeout_add(ASK_MS, ask, run);
	g_signal_emit(run, signals[CHANGED], 0);
	return true;
}

void ladder_board_run_stop(LadderBoardRun *run)
{
	if (!run->child)
		return;
	g_subprocess_send_signal(run->child, SIGTERM);
	run->state = BOARD_STOPPING;
	g_signal_emit(run, signals[CHANGED], 0);
}

void ladder_board_run_reset(LadderBoardRun *run)
{
	if (run->child)
		g_subprocess_send_signal(run->child, SIGHUP);
}

const char *ladder_board_run_where(LadderBoardRun *run)
{
	return run->where;
}

enum board_state ladder_board_run_state(LadderBoardRun *run)
{
	return run->state;
}

const struct run_status *ladder_board_run_status(LadderBoardRun *run)
{
	return &run->status;
}

/* ---- life ---- */

static void ladder_board_run_dispose(GObject *object)
{
	LadderBoardRun *run = LADDER_BOARD_RUN(object);

	g_clear_handle_id(&run->timer, g_source_remove);
	if (run->cancel)
		g_cancellable_cancel(run->cancel);
	g_clear_object(&run->cancel);
	if (run->child) {
		g_subprocess_send_signal(run->child, SIGTERM);
		g_output_stream_close(g_subprocess_get_stdin_pipe(run->child), NULL, NULL);
	}
	g_clear_object(&run->child);
	drop_folder(run);
	G_OBJECT_CLASS(ladder_board_run_parent_class)->dispose(object);
}

static void ladder_board_run_class_init(LadderBoardRunClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_board_run_dispose;
	signals[CHANGED] = g_signal_new("changed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
					NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				     G_TYPE_NONE, 1, G_TYPE_STRING);
	signals[ENDED] = g_signal_new("ended", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				      G_TYPE_NONE, 1, G_TYPE_INT);
}

static void ladder_board_run_init(LadderBoardRun *run)
{
	run->state = BOARD_OFF;
}

LadderBoardRun *ladder_board_run_new(void)
{
	return g_object_new(LADDER_TYPE_BOARD_RUN, NULL);
}
