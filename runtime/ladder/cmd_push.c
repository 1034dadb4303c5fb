/* SPDX-License-Identifier: MIT
 *
 * cmd_push - `ladder push`: checks a program and a map here, sends both to a
 * board through the system's ssh, has them checked there, and switches.
 *
 * Three calls of ssh: the image, the map, and the script that does the rest. A
 * board needs `sh`, ladderd and no scp. It keeps no password and no key.
 */
#include "ladder/push.h"
#include "ladder/report.h"

#include "engine/base/digest.h"
#include "hal/iomap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define FOLDER      "/etc/ladder"
#define FOLDER_MOST 200

struct push {
	const struct call *call;
	const char *board;
	struct push_words words;
	struct push_names names;
	const void *image;
	size_t image_bytes;
	char *map;
};

/* Letters, digits and what stands in @also; nothing that a shell, or ssh when
 * it runs a command of its configuration, could take for its own. */
static bool is_plain(const char *text, const char *also)
{
	static const char plain[] = "abcdefghijklmnopqrstuvwxyz"
				    "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

	while (*text) {
		text += strspn(text, plain);
		if (*text && !strchr(also, *text++))
			return false;
	}
	return true;
}

static bool is_board(const char *text)
{
	const char *at = strrchr(text, '@');
	const char *host = at ? at + 1 : text;

	return *text != '-' && *host && *host != '-' && at != text &&
	       is_plain(text, "@._-:[]%/");
}

static bool is_folder(const char *text)
{
	size_t len = strlen(text);

	return len > 1 && len <= FOLDER_MOST && *text == '/' &&
	       text[len - 1] != '/' && !strstr(text, "..") &&
	       is_plain(text, "._-/");
}

/* No two pushes may write into one folder, whoever starts them. */
static void name_folder(struct push *push)
{
	struct digest_sha256 sha;
	struct timespec now = { 0 };
	pid_t pid = getpid();
	uint8_t bytes[32];
	char hex[65];

	clock_gettime(CLOCK_REALTIME, &now);
	digest_sha256_init(&sha);
	digest_sha256_add(&sha, push->image, push->image_bytes);
	digest_sha256_add(&sha, &now, sizeof(now));
	digest_sha256_add(&sha, &pid, sizeof(pid));
	digest_sha256_end(&sha, bytes);
	digest_hex(bytes, sizeof(bytes), hex);
	snprintf(push->names.name, sizeof(push->names.name), "push-%.16s", hex);
}

static enum status tell(const struct push *push, enum diag_id id,
			const char *what)
{
	report_diag((struct diag){ .id = id, .file = push->board }, "%s", what);
	return id == DIAG_BOARD_REFUSED || id == DIAG_BOARD_NOT_STARTED ||
	       id == DIAG_BOARD_STOPPED ?
		       STATUS_NO : STATUS_WRONG;
}

static enum status send_file(const struct push *push, const char *name,
			     const void *bytes, size_t len)
{
	char remote[2 * FOLDER_MOST + 160];
	int end;

	snprintf(remote, sizeof(remote),
		 "sh -c 'umask 022 && mkdir -p %s/%s && cat >%s/%s/%s'",
		 push->names.folder, push->names.name, push->names.folder,
		 push->names.name, name);
	end = push_call(&push->words, remote, bytes, len);
	if (end == 0)
		return STATUS_GOOD;
	if (end < 0)
		return tell(push, DIAG_BOARD_AWAY, strerror(-end));
	if (end == PUSH_NO_SSH)
		return tell(push, DIAG_BOARD_AWAY, "ssh failed");
	return tell(push, DIAG_BOARD_CANNOT, "");
}

static enum status judge(const struct push *push, int end)
{
	switch (end) {
	case PUSH_DONE:
		return STATUS_GOOD;
	case PUSH_REFUSED:
		return tell(push, DIAG_BOARD_REFUSED, "");
	case PUSH_WENT_BACK:
		return tell(push, DIAG_BOARD_NOT_STARTED, "");
	case PUSH_NOTHING_RUNS:
		return tell(push, DIAG_BOARD_STOPPED, "");
	case PUSH_NOT_WHOLE:
		return tell(push, DIAG_BOARD_NOT_WHOLE, "");
	case PUSH_NO_LADDERD:
		return tell(push, DIAG_BOARD_NO_LADDERD, "");
	case PUSH_NO_SERVICE:
		return tell(push, DIAG_BOARD_NO_SERVICE, "");
	case PUSH_NO_ROOM:
		return tell(push, DIAG_BOARD_CANNOT, "");
	default:
		return tell(push, DIAG_BOARD_CUT, "");
	}
}

static enum status send_all(struct push *push)
{
	struct sink_memory script;
	struct sink out;
	enum status status;

	status = send_file(push, "program.rungc", push->image,
			   push->image_bytes);
	if (status == STATUS_GOOD)
		status = send_file(push, "board.io", push->map,
				   push->names.map_bytes);
	if (status != STATUS_GOOD)
		return status;
	sink_memory_init(&script);
	out = sink_to_memory(&script);
	push_script(&push->names, &out);
	status = script.failed ? report_no_memory(push->board) :
		judge(push, push_call(&push->words, "sh -s",
				      sink_memory_text(&script), script.len));
	sink_memory_free(&script);
	return status;
}

/* The map as text, if it is a good one. @program: its lines must fit; NULL: there is
 * none. */
static enum status read_map(struct push *push, const char *path,
			    const struct program *program)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct iomap map;
	struct arena arena;
	bool good = false;

	if (!diags)
		return report_no_memory(path);
	diag_init(diags);
	arena_init(&arena);
	push->map = report_read(path, &push->names.map_bytes);
	if (push->map)
		good = iomap_read(&map, &arena, path, push->map,
				  push->names.map_bytes, diags) &&
		       (!program || iomap_fits(&map, &program->areas, diags));
	report_diags(diags);
	arena_free(&arena);
	free(diags);
	return good ? STATUS_GOOD : push->map ? STATUS_NO : STATUS_WRONG;
}

static enum status read_and_send(struct push *push)
{
	const struct call *call = push->call;
	struct machine machine;
	enum status status, map;

	/* Both are read, so that one call tells all that is wrong. */
	status = machine_open_file(&machine, call->arg[0]);
	map = read_map(push, call->arg[1], status == STATUS_GOOD ?
		       ladder_program(machine.ladder) : NULL);
	if (status < map)
		status = map;
	if (status == STATUS_GOOD) {
		push->image = ladder_image(machine.ladder, &push->image_bytes);
		push->names.program_bytes = push->image_bytes;
		name_folder(push);
		status = send_all(push);
	}
	machine_close(&machine);
	free(push->map);
	return status;
}

enum status cmd_push(struct call *call)
{
	const char *ssh = call_option(call, "--ssh");
	const char *folder = call_option(call, "--folder");
	struct push push = { .call = call, .board = call->arg[2] };
	enum status status;

	push.names.folder = folder ? folder : FOLDER;
	if (!is_board(push.board))
		return report_usage(call, "%.24s is not USER@BOARD",
				    push.board);
	if (!is_folder(push.names.folder))
		return report_usage(call, "%.16s is not a folder on a board",
				    folder);
	if (push_words_split(&push.words, ssh ? ssh : "ssh", push.board))
		status = read_and_send(&push);
	else
		status = report_usage(call, "--ssh needs 1 to %d words",
				      PUSH_WORDS);
	free(push.words.text);
	return status;
}
