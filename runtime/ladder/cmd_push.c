/* SPDX-License-Identifier: MIT
 *
 * cmd_push - `ladder push`: checks a program and a map here and puts both on a board.
 *
 * It downloads them through the link of the board, without a stop if the map is the same. A
 * board without the link needs only `sh` and ladderd: three calls of ssh bring the image, the
 * map and a script, which has ladderd check both and restarts it. ssh asks for passwords and
 * host keys on the terminal itself. No shell runs on this side, and no file name of the user
 * reaches the shell of the board.
 */
#include "ladder/remote.h"

#include "engine/base/digest.h"
#include "engine/base/version.h"

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
#define STARTS_MOST 20  /* times that a board that starts again is asked      */
#define STARTS_MS   500 /* between them                                       */

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

/* Arguments of the script. They are checked or made here, so none needs quotes. */
struct push_names {
	const char *folder;    /* on the board: letters, digits, ._-/        */
	char name[24];         /* "push-" and hex digits: new in each push   */
	size_t program_bytes, map_bytes;
};

struct push {
	const struct call *call;
	const char *board;
	struct stream_words words; /* of `ssh [OPTION]... USER@BOARD`         */
	struct push_names names;
	const void *image;
	size_t image_bytes;
	const void *map;
};

/* ---- ssh ---- */

static int start_ssh(const struct stream_words *words, int input, int other_end,
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
			     words->word, environ);
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
static int call_ssh(const struct stream_words *words, const char *remote, const void *bytes,
		    size_t len)
{
	struct stream_words all = *words;
	int ends[2], error, status;
	pid_t pid;

	all.word[all.count++] = (char *)remote;
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

/* The same program as a file for a board without the link: without the section that shows
 * power. Owns: the caller, ladder_free(). */
static struct ladder *build_plain(const char *path)
{
	struct ladder *ladder = program_new(false);

	if (!ladder)
		return NULL;
	ladder_classic_task(ladder, true);
	if (report_read_program(ladder, path) && (ladder_program(ladder) || ladder_build(ladder)))
		return ladder;
	ladder_free(ladder);
	return NULL;
}

static enum status copy_and_start(struct push *push, const struct parcel *parcel)
{
	struct ladder *ladder = build_plain(push->call->arg[0]);
	enum status status;

	if (!ladder)
		return report_no_memory(push->call->arg[0]);
	push->image = ladder_image(ladder, &push->image_bytes);
	push->names.program_bytes = push->image_bytes;
	push->map = stored_part(&parcel->stored, STORED_MAP);
	push->names.map_bytes = parcel->map_len;
	name_folder(push);
	status = send_all(push);
	ladder_free(ladder);
	return status;
}

/* ---- the link ---- */

/* What became of a session with ladderd. */
enum link_end {
	LINK_OPEN,
	LINK_NONE,   /* there is no link: the other way is left     */
	LINK_FAILED, /* after a message                             */
};

static enum link_end no_link(const struct push *push, const char *why)
{
	tell(push, DIAG_BOARD_NO_LINK, why);
	return LINK_NONE;
}

static enum desk_end open_session(const struct push *push, struct remote *remote, int *error)
{
	const struct stream_where where = { STREAM_SSH, push->board };
	struct stream stream;

	*error = stream_open(&where, call_option(push->call, "--ssh"), &stream);
	if (*error)
		return DESK_GONE;
	return desk_open(&remote->desk, &stream, "ladder " LADDER_VERSION);
}

/* Why there is no session. ssh itself ends with 255. */
static enum link_end judge_no_session(const struct push *push, struct remote *remote,
				      enum desk_end end, int error)
{
	const int status = stream_close(&remote->desk.stream);

	if (error || (end == DESK_GONE && status == PUSH_NO_SSH)) {
		tell(push, DIAG_BOARD_AWAY, error ? strerror(-error) : "ssh failed");
		return LINK_FAILED;
	}
	if (end == DESK_GONE)
		return no_link(push, status == 127 ? "the board has no ladder-attach" :
			       "ladderd on the board has no link");
	if (end == DESK_REFUSED && remote->desk.refusal != REFUSAL_VERSION) {
		remote_fail(remote, end);
		return LINK_FAILED;
	}
	return no_link(push, end == DESK_REFUSED ? "the link of the board has another version" :
		       "the link of the board does not answer");
}

static enum link_end open_link(const struct push *push, struct remote *remote)
{
	int error;
	const enum desk_end end = open_session(push, remote, &error);

	if (end != DESK_GOOD)
		return judge_no_session(push, remote, end, error);
	if (remote->desk.role != ROLE_ENG)
		return no_link(push, "you are not in the group ladder-eng there");
	return LINK_OPEN;
}

static bool runs_already(const struct remote *remote)
{
	return memcmp(remote->expect.program, remote->put.program,
		      sizeof(remote->put.program)) == 0;
}

/* Asks a board that has begun again until it answers. */
static enum status wait_for_start(const struct push *push, struct remote *remote,
				  struct board_status *now)
{
	const struct timespec pause = { 0, STARTS_MS * 1000000L };
	enum desk_end end = DESK_GONE;
	int error = 0;

	for (int i = 0; i < STARTS_MOST && end != DESK_GOOD; i++) {
		desk_close(&remote->desk);
		if (i)
			nanosleep(&pause, NULL);
		end = open_session(push, remote, &error);
	}
	if (end != DESK_GOOD)
		return tell(push, DIAG_BOARD_CUT, "");
	return remote_status(remote, now);
}

/* Shows what runs now: it must be the new program. */
static enum status show_what_runs(const struct push *push, struct remote *remote)
{
	struct board_status *now = calloc(1, sizeof(*now));
	enum status status;

	if (!now)
		return report_no_memory(push->board);
	status = remote->put.restart ? wait_for_start(push, remote, now) :
				       remote_status(remote, now);
	if (status == STATUS_GOOD && !runs_already(remote))
		status = tell(push, DIAG_BOARD_NOT_STARTED, "");
	if (status == STATUS_GOOD)
		remote_print_status(remote, now);
	free(now);
	return status;
}

/* @status: of the whole push, if this returns something other than LINK_NONE. */
static enum link_end over_link(const struct push *push, struct call *call,
			       const struct parcel *parcel, enum status *status)
{
	struct remote *remote = calloc(1, sizeof(*remote));
	enum link_end end;

	*status = STATUS_WRONG;
	if (!remote) {
		report_no_memory(push->board);
		return LINK_FAILED;
	}
	remote->call = call;
	remote->where = push->board;
	remote->desk.stream.fd = -1;
	remote->put = (struct put){ .or_restart = true, .or_else = true };
	end = open_link(push, remote);
	if (end == LINK_OPEN) {
		*status = remote_put(remote, parcel);
		if (remote->put.no_store)
			end = no_link(push, "ladderd on the board has no --slots");
		else if (*status == STATUS_GOOD)
			*status = show_what_runs(push, remote);
	}
	desk_close(&remote->desk);
	free(remote);
	return end;
}

static enum status read_and_put(struct push *push, struct call *call)
{
	struct parcel parcel;
	enum status status = parcel_open(&parcel, call->arg[0], call->arg[1]);

	/* --folder says where the files are to be, so they are copied. */
	if (status == STATUS_GOOD && (call_option(call, "--folder") ||
				      over_link(push, call, &parcel, &status) == LINK_NONE))
		status = copy_and_start(push, &parcel);
	parcel_close(&parcel);
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
	if (stream_split(&push.words, ssh ? ssh : "ssh")) {
		push.words.word[push.words.count++] = (char *)push.board;
		status = read_and_put(&push, call);
	} else {
		status = report_usage(call, "--ssh needs 1 to %d words",
				      STREAM_WORDS);
	}
	free(push.words.text);
	return status;
}
