/* SPDX-License-Identifier: MIT
 *
 * cmd_push - `ladder push`: checks a program and a map here, sends both to a board through
 * ssh, checks them there with ladderd, and switches to them.
 *
 * It calls ssh three times: for the image, for the map, and for a script that does the
 * rest. A board needs `sh` and ladderd, but no scp. ssh asks for passwords and host keys on
 * the terminal itself. No shell runs on this side, and no file name of the user reaches the
 * shell of the board.
 */
#include "ladder/report.h"

#include "engine/base/digest.h"
#include "hal/iomap.h"
#include "online/stream.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define FOLDER      "/etc/ladder"
#define FOLDER_MOST 200
#define PUSH_WORDS  32

extern char **environ;

/* Exit status of the script; any other is that of the board's shell or of ssh. */
enum push_end {
	PUSH_DONE = 0,
	PUSH_REFUSED = 41,     /* ladderd --check found errors               */
	PUSH_WENT_BACK = 42,   /* it did not start; the previous one runs    */
	PUSH_NOTHING_RUNS = 43, /* neither it nor the previous one started   */
	PUSH_NOT_WHOLE = 44,   /* what arrived is shorter than what was sent */
	PUSH_NO_LADDERD = 45,
	PUSH_NO_SERVICE = 46,  /* there is no way to restart ladderd         */
	PUSH_NO_ROOM = 47,     /* a file could not be written                */
	PUSH_NO_SSH = 255,     /* ssh itself: no connection, or it was cut   */
};

/* The words of `ssh [OPTION]... USER@BOARD COMMAND`. */
struct push_words {
	char *text;            /* what the words point into                  */
	const char *word[PUSH_WORDS + 3];
	int count;
};

/* Arguments of the script. They are checked or made here, so none needs quotes. */
struct push_names {
	const char *folder;    /* on the board: letters, digits, ._-/        */
	char name[24];         /* "push-" and hex digits: new in each push   */
	size_t program_bytes, map_bytes;
};

struct push {
	const struct call *call;
	const char *board;
	struct push_words words;
	struct push_names names;
	const void *image;
	size_t image_bytes;
	char *map;
};

/* ---- ssh ---- */

/* Splits @command at its blanks and adds @board. Owns: free(words->text).
 * Fails: false; there are no words or too many. */
static bool split_words(struct push_words *words, const char *command, const char *board)
{
	size_t len = strlen(command) + 1;
	char *at;

	memset(words, 0, sizeof(*words));
	words->text = malloc(len);
	if (!words->text)
		return false;
	memcpy(words->text, command, len);
	for (at = words->text; *at;) {
		char *end = at + strcspn(at, " \t\n");
		bool last = !*end;

		*end = '\0';
		if (end > at && words->count == PUSH_WORDS)
			return false;
		if (end > at)
			words->word[words->count++] = at;
		at = last ? end : end + 1;
	}
	if (!words->count)
		return false;
	words->word[words->count++] = board;
	return true;
}

static int start_ssh(const struct push_words *words, int input, int other_end,
		 pid_t *pid)
{
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	sigset_t signals;
	int error;

	/* ladder ignores SIGPIPE; ssh must not inherit that. */
	sigemptyset(&signals);
	sigaddset(&signals, SIGPIPE);
	posix_spawnattr_init(&attributes);
	posix_spawnattr_setsigdefault(&attributes, &signals);
	posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_addclose(&actions, other_end);
	posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
	posix_spawn_file_actions_addclose(&actions, input);
	error = posix_spawnp(pid, words->word[0], &actions, &attributes,
			     (char *const *)words->word, environ);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	return error;
}

/* An error is not reported here: the exit status of ssh says what failed. */
static void feed(int fd, const char *bytes, size_t len)
{
	while (len) {
		ssize_t done = write(fd, bytes, len);

		if (done < 0 && errno == EINTR)
			continue;
		if (done <= 0)
			break;
		bytes += done;
		len -= (size_t)done;
	}
	close(fd);
}

/* Runs ssh with @remote as its last word and @bytes as its input. Returns the exit status of
 * ssh, 255 if a signal ended it, or -errno if it did not start. */
static int call_ssh(const struct push_words *words, const char *remote, const void *bytes,
		    size_t len)
{
	struct push_words all = *words;
	int ends[2], error, status;
	pid_t pid;

	all.word[all.count++] = remote;
	all.word[all.count] = NULL;
	if (pipe(ends) != 0)
		return -errno;
	/* If standard input is closed, the pipe must not get its number. */
	while (ends[0] <= STDERR_FILENO || ends[1] <= STDERR_FILENO) {
		int high[2] = { fcntl(ends[0], F_DUPFD, STDERR_FILENO + 1),
				fcntl(ends[1], F_DUPFD, STDERR_FILENO + 1) };

		close(ends[0]);
		close(ends[1]);
		if (high[0] < 0 || high[1] < 0)
			return -EMFILE;
		memcpy(ends, high, sizeof(ends));
	}
	error = start_ssh(&all, ends[0], ends[1], &pid);
	close(ends[0]);
	if (error) {
		close(ends[1]);
		return -error;
	}
	feed(ends[1], bytes, len);
	while (waitpid(pid, &status, 0) < 0)
		if (errno != EINTR)
			return -errno;
	return WIFEXITED(status) ? WEXITSTATUS(status) : PUSH_NO_SSH;
}

/* ---- the script on the board ---- */

/*
 * POSIX sh, for busybox too. The braces make the shell read all of it before it runs any,
 * so a script that was cut off does nothing. The file `active` names what ladderd runs. One
 * rename replaces it, and before and after the rename it names a complete folder. The
 * folder of the previous program is kept.
 */
static const char body[] =
"PATH=$PATH:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin\n"
"new=$1/$2\n"
"\n"
"give_up() { rm -rf \"$new\"; exit \"$1\"; }\n"
"\n"
"service() { # restart or status\n"
"	case $how,$1 in\n"
"	systemd,restart)\n"
"		# The limit of three starts a minute is for crashes, not for pushes.\n"
"		$root systemctl reset-failed ladderd 2>/dev/null\n"
"		$root systemctl restart ladderd ;;\n"
"	systemd,status)\n"
"		$root systemctl kill -s USR1 ladderd &&\n"
"			sleep 1\n"
"		systemctl status --no-pager -n 15 -o cat ladderd ;;\n"
"	*)\n"
"		\"$how\" \"$1\" ;;\n"
"	esac\n"
"}\n"
"\n"
"umask 022\n"
"cd \"$1\" || exit 47\n"
"[ $(($(wc -c <\"$new/program.rungc\"))) -eq \"$3\" ] || give_up 44\n"
"[ $(($(wc -c <\"$new/board.io\"))) -eq \"$4\" ] || give_up 44\n"
"command -v ladderd >/dev/null || give_up 45\n"
"ladderd \"$new/program.rungc\" --io \"$new/board.io\" --check >/dev/null ||\n"
"	give_up 41\n"
"\n"
"root=\n"
"if [ -x ./service ]; then\n"
"	how=./service\n"
"elif systemctl cat ladderd.service >/dev/null 2>&1; then\n"
"	how=systemd\n"
"	[ \"$(id -u)\" = 0 ] ||\n"
"		! sudo -n -l systemctl restart ladderd >/dev/null 2>&1 ||\n"
"		root='sudo -n'\n"
"elif [ -x /etc/init.d/ladderd ]; then\n"
"	how=/etc/init.d/ladderd\n"
"elif how=$(command -v ladderd-run); then\n"
"	:\n"
"else\n"
"	give_up 46\n"
"fi\n"
"\n"
"if [ -f active ]; then\n"
"	cp active \"$new/before\" || give_up 47\n"
"fi\n"
"printf 'LADDERD_FILE=%s\\nLADDERD_MAP=%s\\n' \"$new/program.rungc\" \\\n"
"	\"$new/board.io\" >\"$new/active\" || give_up 47\n"
"sync\n"
"# From here on the script ends by itself, also if the connection is lost.\n"
"trap '' HUP INT TERM PIPE\n"
"mv -f \"$new/active\" active || give_up 47\n"
"sync\n"
"if service restart >&2 && sleep 1 && service status >\"$new/status\"; then\n"
"	keep=$(sed -n 's|^LADDERD_FILE=.*/\\(push-[0-9a-f]*\\)/.*|\\1|p' \\\n"
"		\"$new/before\" 2>/dev/null)\n"
"	for old in push-*; do\n"
"		case $old in\n"
"		\"$2\" | \"$keep\") ;;\n"
"		*) rm -rf \"$old\" ;;\n"
"		esac\n"
"	done\n"
"	cat \"$new/status\"\n"
"	exit 0\n"
"fi\n"
"cat \"$new/status\" >&2\n"
"if [ -f \"$new/before\" ]; then\n"
"	cp \"$new/before\" \"$new/active\" && sync && mv -f \"$new/active\" active\n"
"else\n"
"	rm -f active\n"
"fi\n"
"sync\n"
"service restart >&2\n"
"sleep 1\n"
"service status >/dev/null && give_up 42\n"
"give_up 43\n";

static void print_script(const struct push_names *names, const struct sink *out)
{
	sink_text(out, "{\nset -- ");
	sink_text(out, names->folder);
	sink_printf(out, " %s %zu %zu\n", names->name, names->program_bytes,
		    names->map_bytes);
	sink_text(out, body);
	sink_text(out, "}\n");
}

/* ---- the command ---- */

static bool is_folder(const char *text)
{
	size_t len = strlen(text);

	return len > 1 && len <= FOLDER_MOST && *text == '/' &&
	       text[len - 1] != '/' && !strstr(text, "..") &&
	       stream_is_plain(text, "._-/");
}

/* Gives each push a folder name of its own, also if two run at once. */
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
	end = call_ssh(&push->words, remote, bytes, len);
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
	static const struct { int end; enum diag_id id; } known[] = {
		{ PUSH_REFUSED, DIAG_BOARD_REFUSED },
		{ PUSH_WENT_BACK, DIAG_BOARD_NOT_STARTED },
		{ PUSH_NOTHING_RUNS, DIAG_BOARD_STOPPED },
		{ PUSH_NOT_WHOLE, DIAG_BOARD_NOT_WHOLE },
		{ PUSH_NO_LADDERD, DIAG_BOARD_NO_LADDERD },
		{ PUSH_NO_SERVICE, DIAG_BOARD_NO_SERVICE },
		{ PUSH_NO_ROOM, DIAG_BOARD_CANNOT },
	};

	if (end == PUSH_DONE)
		return STATUS_GOOD;
	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++)
		if (known[i].end == end)
			return tell(push, known[i].id, "");
	return tell(push, DIAG_BOARD_CUT, "");
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
	print_script(&push->names, &out);
	status = script.failed ? report_no_memory(push->board) :
		judge(push, call_ssh(&push->words, "sh -s",
				      sink_memory_text(&script), script.len));
	sink_memory_free(&script);
	return status;
}

/* Reads and checks the map. @program: its areas must hold all lines; NULL if it has errors. */
static enum status read_map(struct push *push, const char *path,
			    const struct program *program)
{
	struct diag_list *diags = report_list(path);
	struct iomap map;
	struct arena arena;
	bool good = false;

	if (!diags)
		return STATUS_WRONG;
	arena_init(&arena);
	push->map = report_read(path, &push->names.map_bytes);
	if (push->map)
		good = iomap_read(&map, &arena, path, push->map,
				  push->names.map_bytes, diags) &&
		       (!program || iomap_fits(&map, &program->areas, diags));
	report_end(diags);
	arena_free(&arena);
	return good ? STATUS_GOOD : push->map ? STATUS_NO : STATUS_WRONG;
}

static enum status read_and_send(struct push *push)
{
	const struct call *call = push->call;
	struct machine machine;
	enum status status, map;

	/* Both are read, so that one call reports all errors. */
	status = machine_open(&machine, call->arg[0], MACHINE_AS_FILE);
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
	if (!stream_is_host(push.board))
		return report_usage(call, "%.24s is not USER@BOARD",
				    push.board);
	if (!is_folder(push.names.folder))
		return report_usage(call, "%.16s is not a folder on a board",
				    folder);
	if (split_words(&push.words, ssh ? ssh : "ssh", push.board))
		status = read_and_send(&push);
	else
		status = report_usage(call, "--ssh needs 1 to %d words",
				      PUSH_WORDS);
	free(push.words.text);
	return status;
}
