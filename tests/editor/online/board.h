/* SPDX-License-Identifier: MIT
 *
 * board - a ladderd with --link in a folder of its own, for tests of the editor's side.
 */
#ifndef TESTS_EDITOR_ONLINE_BOARD_H
#define TESTS_EDITOR_ONLINE_BOARD_H

#include "editor-gtk/online/board_link.h"
#include "tests/editor/soon.h"

#include <gio/gunixsocketaddress.h>
#include <glib/gstdio.h>
#include <stdlib.h>
#include <unistd.h>

#define BOARD_PROGRAM "RUNGBOARD 1\nPROJECT \"Seal\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n" \
	"  Motor AT %QX0.0 : BOOL;\n  Count : INT;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n" \
	"  | NO Start | COIL Motor |\nEND_PROGRAM\n"
#define BOARD_MAP "BOARD \"table\"\n%IX0.0 sim\n%QX0.0 sim\n"

struct test_board {
	char *folder, *where;
	bool empty; /* it begins without a program                           */
	GSubprocess *daemon;
};

static inline char *board_path(const struct test_board *board, const char *name)
{
	return g_build_filename(board->folder, name, NULL);
}

static inline void board_write(const struct test_board *board, const char *name, const char *text)
{
	char *path = board_path(board, name);

	g_file_set_contents(path, text, -1, NULL);
	g_free(path);
}

static inline bool board_listens(const char *path)
{
	GSocketClient *client = g_socket_client_new();
	GSocketAddress *address = g_unix_socket_address_new(path);
	GSocketConnection *to = g_socket_client_connect(client, G_SOCKET_CONNECTABLE(address),
							NULL, NULL);
	const bool listens = to != NULL;

	g_clear_object(&to);
	g_object_unref(address);
	g_object_unref(client);
	return listens;
}

/* Waits until it listens. */
static inline void board_start(struct test_board *board)
{
	const char *build = g_getenv("BUILD");
	char *relative = g_build_filename(build ? build : "build", "ladderd", NULL);
	char *program = g_canonicalize_filename(relative, NULL);
	char *path = board_path(board, "link");
	GSubprocessLauncher *launcher = g_subprocess_launcher_new(
		G_SUBPROCESS_FLAGS_STDOUT_SILENCE | G_SUBPROCESS_FLAGS_STDERR_SILENCE);

	g_subprocess_launcher_set_cwd(launcher, board->folder);
	board->daemon = g_subprocess_launcher_spawn(launcher, NULL, program, board->empty ? "" :
						    "seal.rung", "--io", board->empty ? "" :
						    "board.io", "--link", "link", "--groups",
						    "group", "--slots", "slots", NULL);
	g_object_unref(launcher);
	WAIT(board_listens(path));
	g_free(relative);
	g_free(program);
	g_free(path);
}

/* @role: of this user: "eng", "view"; "": none. */
static inline void board_open(struct test_board *board, const char *role)
{
	char *group = g_strdup_printf("ladder-%s:x:%u:\n", role, (unsigned)getgid());
	char *slots;

	board->folder = g_dir_make_tmp("board-XXXXXX", NULL);
	slots = board_path(board, "slots");
	g_mkdir(slots, 0700);
	board->where = g_strdup_printf("unix:%s/link", board->folder);
	board_write(board, "seal.rung", BOARD_PROGRAM);
	board_write(board, "board.io", BOARD_MAP);
	board_write(board, "group", group);
	board_start(board);
	g_free(slots);
	g_free(group);
}

static inline void board_stop(struct test_board *board)
{
	char *path = board_path(board, "link");

	g_subprocess_send_signal(board->daemon, SIGTERM);
	g_subprocess_wait(board->daemon, NULL, NULL);
	g_clear_object(&board->daemon);
	g_unlink(path);
	g_free(path);
}

static inline void board_close(struct test_board *board)
{
	char *command = g_strdup_printf("rm -rf '%s'", board->folder);

	if (board->daemon)
		board_stop(board);
	if (system(command) != 0)
		perror(command);
	g_free(command);
	g_free(board->folder);
	g_free(board->where);
}

#endif
