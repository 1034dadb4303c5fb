/* SPDX-License-Identifier: MIT
 *
 * main - ladder-guard: starts ladderd, and makes the outputs safe when ladderd dies or freezes.
 *
 * One loop waits for signals, for packets of ladderd, for its end and for the time at which its
 * next heartbeat is due. It allocates nothing. From an abnormal end until the next ladderd is
 * about to request the lines, the guard holds them at their safe levels.
 */
#define _GNU_SOURCE
#include "guard/check.h"
#include "guard/child.h"
#include "guard/feed.h"
#include "guard/files.h"
#include "guard/lines.h"
#include "guard/text.h"

#include <errno.h>
#include <poll.h>
#include <sched.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define BEGIN_MS     60000 /* from the start of ladderd to its first packet   */
#define TAKING_MS    10000 /* from the request of the lines to the next packet */
#define AGAIN_MS     1000  /* between two attempts to take a line or to start  */
#define ENDS         3     /* abnormal ends …                                 */
#define WITHIN_MS    60000 /* … in this time: begin in STOP                   */
#define PRIORITY     50    /* above that of ladderd                           */

struct guard {
	const char *device, *name;
	char **argv;
	int heartbeat_ms;
	sigset_t signals;
	int signal_fd;
	struct child child;
	struct lines lines;
	struct files files;
	struct feed feed;
	int64_t due_ms;        /* of the next heartbeat                       */
	int64_t look_ms;       /* when a scan may be over its limit           */
	int64_t again_ms;      /* next attempt; 0: none                       */
	int64_t end_ms[ENDS];  /* of the last abnormal ends, the newest first */
	unsigned ends;         /* abnormal ones since the start               */
	int how;               /* the last one, see guard/say.h               */
	bool recovers;         /* since an abnormal end ladderd has not scanned */
	bool safe;             /* the guard keeps the lines                   */
	bool stop;             /* SIGTERM came                                */
	bool killed;           /* the guard has killed ladderd                */
	bool hung;             /* … because its scan hung                     */
	bool deaf;             /* ladderd has closed its socket               */
	bool strange;          /* a bad packet was reported                   */
};

/* No stack is large enough on small boards; the memory is locked. */
static struct guard guard;

static int64_t now_ms(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static const char help[] =
	"usage: ladder-guard [OPTION]... -- ladderd ARGUMENT...\n"
	"Starts ladderd. When ladderd dies or freezes, sets its outputs to their safe values and\n"
	"starts it again.\n"
	"  --heartbeat MS  ladderd is frozen after this time without a sign (50 to 10000; 200)\n"
	"  --watchdog DEV  feed this watchdog device while all is well\n"
	"  --name NAME     a second guard on this machine needs another name (board)\n"
	"  --help          print this\n"
	"After three abnormal ends within 60 s ladderd begins in STOP.\n"
	"Exit status: that of ladderd after an orderly end; 1 refused; 2 wrong usage;\n"
	"127 ladderd cannot be started.\n";

static int wrong(const char *what, const char *why)
{
	text_say("%s %s\nTry `ladder-guard --help`.", what, why);
	return 2;
}

/* -1: go on; else the exit status. */
static int read_options(int argc, char **argv)
{
	guard.heartbeat_ms = 200;
	guard.name = "board";
	for (int i = 1; i < argc; i++) {
		const char *word = argv[i];

		if (strcmp(word, "--") == 0) {
			guard.argv = &argv[i + 1];
			return guard.argv[0] ? -1 : wrong("--", "names no program");
		}
		if (strcmp(word, "--help") == 0)
			return write(STDOUT_FILENO, help, sizeof(help) - 1) < 0;
		if (i + 1 == argc)
			return wrong(word, "is no option, or needs a value");
		i++;
		if (strcmp(word, "--watchdog") == 0) {
			guard.device = argv[i];
		} else if (strcmp(word, "--name") == 0) {
			guard.name = argv[i];
		} else if (strcmp(word, "--heartbeat") == 0) {
			const long long ms = text_number(argv[i]);

			if (ms < 50 || ms > 10000)
				return wrong(word, "takes 50 to 10000 ms");
			guard.heartbeat_ms = (int)ms;
		} else {
			return wrong(word, "is no option");
		}
	}
	return wrong("--", "and the command of ladderd are missing");
}

/* An abstract address: it needs no file and goes with the process. */
static bool be_the_only_one(void)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
	const int len = text_print(address.sun_path + 1, sizeof(address.sun_path) - 1,
				 "rungboard-guard-%s", guard.name);

	if (len >= (int)sizeof(address.sun_path) - 1) {
		wrong("--name", "is too long");
		return false;
	}
	if (fd >= 0 && bind(fd, (const struct sockaddr *)&address,
			    (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + len)) == 0)
		return true;
	text_say("%s", fd >= 0 && errno == EADDRINUSE ?
		"another ladder-guard of this name runs; stop it, or give this one another --name" :
		strerror(errno));
	return false;
}

/* It must run while a program of ladderd takes the whole processor. */
static void make_ready(void)
{
	struct sched_param wanted = { .sched_priority = PRIORITY };

	syscall(SYS_sched_setscheduler, 0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted);
	if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
		text_say("memory is not locked: %s",
			strerror(errno));
}

static bool listen_to_signals(void)
{
	static const int wanted[] = { SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGCHLD };

	sigemptyset(&guard.signals);
	for (size_t i = 0; i < sizeof(wanted) / sizeof(wanted[0]); i++)
		sigaddset(&guard.signals, wanted[i]);
	sigprocmask(SIG_BLOCK, &guard.signals, NULL);
	guard.signal_fd = signalfd(-1, &guard.signals, SFD_CLOEXEC | SFD_NONBLOCK);
	if (guard.signal_fd < 0)
		text_say("no signals: %s", strerror(errno));
	return guard.signal_fd >= 0;
}

static bool are_many(int64_t now)
{
	const int64_t oldest = guard.end_ms[ENDS - 1];

	return oldest && now - oldest <= WITHIN_MS;
}

static bool start(int64_t now)
{
	const bool stopped = are_many(now);

	guard.killed = guard.hung = guard.deaf = false;
	guard.again_ms = 0;
	guard.due_ms = now + BEGIN_MS;
	if (stopped)
		text_say("ladderd has ended abnormally %d times within "
			"%d s: it begins in STOP", ENDS, WITHIN_MS / 1000);
	return child_start(&guard.child, guard.argv, guard.heartbeat_ms, stopped,
			   guard.ends, guard.how);
}

static void on_signals(void)
{
	struct signalfd_siginfo info;

	while (read(guard.signal_fd, &info, sizeof(info)) == (ssize_t)sizeof(info)) {
		if (info.ssi_signo == SIGCHLD)
			continue;
		if (info.ssi_signo == SIGTERM || info.ssi_signo == SIGINT)
			guard.stop = true;
		if (guard.child.pid)
			kill(guard.child.pid, (int)info.ssi_signo);
	}
}

static void on_packet(const union guard_packet *packet, int64_t now)
{
	struct guard_levels levels;

	switch (packet->head.kind) {
	case GUARD_BEAT:
		guard.recovers = false;
		guard.due_ms = now + packet->head.within_ms;
		break;
	case GUARD_TABLE:
		lines_know(&guard.lines, &packet->table);
		break;
	case GUARD_TAKE:
		lines_release(&guard.lines);
		guard.safe = false;
		guard.due_ms = now + TAKING_MS;
		lines_answer(&guard.lines, &levels);
		send(guard.child.socket, &levels, sizeof(levels), MSG_NOSIGNAL | MSG_DONTWAIT);
		break;
	case GUARD_LEVELS:
		lines_levels(&guard.lines, &packet->levels);
		break;
	case GUARD_MORE:
		lines_more(&guard.lines, &packet->table);
		break;
	case GUARD_VALUES:
		files_know(&guard.files, &packet->files);
		break;
	case GUARD_VALUES_MORE:
		files_more(&guard.files, &packet->files);
		break;
	default:
		feed_tell(&guard.feed, packet->tell.text);
	}
}

static void hear(int64_t now)
{
	static union guard_packet packet;

	for (;;) {
		const ssize_t got = recv(guard.child.socket, &packet, sizeof(packet),
					 MSG_DONTWAIT | MSG_TRUNC);

		if (got <= 0) {
			/* It has closed its end: only its own end is awaited now. */
			guard.deaf = got == 0;
			return;
		}
		if ((size_t)got <= sizeof(packet) && guard_check(&packet, (size_t)got)) {
			on_packet(&packet, now);
			continue;
		}
		if (!guard.strange)
			text_say("ladderd sent %d bytes that say "
				"nothing; they are not used", (int)got);
		guard.strange = true;
	}
}

/* A ladderd that ends by itself before it scans, such as one whose lines another process holds, has
 * driven no output: it is no reason to begin in STOP. */
static void count_end(int64_t now)
{
	if (guard.killed || WIFSIGNALED(guard.child.status)) {
		memmove(guard.end_ms + 1, guard.end_ms, sizeof(guard.end_ms) - sizeof(guard.end_ms[0]));
		guard.end_ms[0] = now ? now : 1;
	}
	guard.ends++;
	guard.how = guard.hung ? GUARD_HUNG : guard.killed ? GUARD_FROZEN : WIFSIGNALED(guard.child.status) ?
		    WTERMSIG(guard.child.status) : GUARD_STATUS + WEXITSTATUS(guard.child.status);
}

static void tell_end(void)
{
	const int status = guard.child.status;
	char how[48];

	if (guard.hung)
		text_print(how, sizeof(how), "hung in a scan and is killed");
	else if (guard.killed)
		text_print(how, sizeof(how), "was frozen and is killed");
	else if (WIFSIGNALED(status))
		text_print(how, sizeof(how), "died of signal %d", WTERMSIG(status));
	else
		text_print(how, sizeof(how), "ended with status %d", WEXITSTATUS(status));
	text_say("ladderd %s; %s", how,
		guard.safe ? "the outputs are safe" : "not all outputs are safe");
	feed_tell(&guard.feed, guard.safe ? "STATUS=ladderd has died, outputs are safe" :
					    "STATUS=ladderd has died, not all outputs are safe");
}

/* Lines first: the driver of a file may hang. */
static bool make_safe(void)
{
	const bool lines = lines_take(&guard.lines);

	return files_write(&guard.files) && lines;
}

/* ladderd has ended. -1: it shall begin again; else the exit status of the guard. */
static int on_end(int64_t now)
{
	const int status = guard.child.status;

	if (WIFEXITED(status) && !guard.killed && !guard.recovers) {
		if (WEXITSTATUS(status) == CHILD_NO_PROGRAM)
			text_say("\"%s\" cannot be started",
				guard.argv[0]);
		return WEXITSTATUS(status);
	}
	guard.safe = make_safe();
	tell_end();
	if (guard.stop)
		return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : 1;
	/* The first one begins at once; one that never comes to scan must not fill the machine. */
	guard.again_ms = guard.recovers || are_many(now) ? now + AGAIN_MS : now;
	guard.recovers = true;
	count_end(now);
	return -1;
}

/* A scan that is over its limit and its grace. One in which ladderd has made the outputs safe itself
 * is left alone: that ladderd can tell its fault, and its heartbeat says whether it goes on. */
static bool is_hung(int64_t now)
{
	struct guard_page *page = guard.child.page;
	const uint32_t limit = page ? atomic_load(&page->limit) : 0;
	const uint32_t scan = page ? atomic_load(&page->scan) : 0;
	const int64_t most_ms = (int64_t)limit * GUARD_TICK / 1000000 + GUARD_GRACE + 1;
	struct timespec time;
	int64_t left_ms;

	guard.look_ms = limit ? now + most_ms : INT64_MAX;
	if (!limit || !(scan & 1) || atomic_load(&page->safe) == scan)
		return false;
	clock_gettime(CLOCK_MONOTONIC, &time);
	left_ms = (int64_t)(int32_t)(atomic_load(&page->began) + limit -
		  (uint32_t)((time.tv_sec * INT64_C(1000000000) + time.tv_nsec) / GUARD_TICK)) *
		  GUARD_TICK / 1000000 + GUARD_GRACE;
	if (atomic_load(&page->scan) != scan)
		return false;
	if (left_ms > 0)
		guard.look_ms = now + left_ms;
	return left_ms <= 0;
}

/* Does the work that is due. */
static void on_time(int64_t now)
{
	if (guard.child.pid && !guard.killed) {
		guard.hung = is_hung(now);
		guard.killed = guard.hung || now >= guard.due_ms;
		if (guard.killed)
			kill(guard.child.pid, SIGKILL);
	}
	if (guard.child.pid || now < guard.again_ms)
		return;
	guard.safe = make_safe();
	if (!start(now))
		guard.again_ms = now + AGAIN_MS;
}

static void wait_for_it(int64_t now)
{
	struct pollfd ready[3] = {
		{ .fd = guard.signal_fd, .events = POLLIN },
		{ .fd = guard.child.pid && !guard.deaf ? guard.child.socket : -1, .events = POLLIN },
		{ .fd = guard.child.pid ? guard.child.pidfd : -1, .events = POLLIN },
	};
	int64_t until = guard.feed.fed_ms + guard.feed.every_ms;

	if (guard.child.pid && !guard.killed && guard.due_ms < until)
		until = guard.due_ms;
	if (guard.child.pid && !guard.killed && guard.look_ms < until)
		until = guard.look_ms;
	if (!guard.child.pid && guard.again_ms < until)
		until = guard.again_ms;
	poll(ready, 3, until > now ? (int)(until - now) : 0);
}

/* Until ladderd ends as it shall. Returns the exit status. */
static int keep_watch(void)
{
	for (;;) {
		int64_t now = now_ms();

		wait_for_it(now);
		on_signals();
		now = now_ms();
		if (guard.child.pid)
			hear(now);
		if (child_ended(&guard.child)) {
			int status;

			hear(now); /* what it has said since */
			child_close(&guard.child);
			status = on_end(now);
			if (status >= 0)
				return status;
		}
		if (!guard.child.pid && guard.stop)
			return 1;
		on_time(now);
		if (!guard.killed)
			feed_give(&guard.feed, now);
	}
}

int main(int argc, char **argv)
{
	int status = read_options(argc, argv);

	if (status >= 0)
		return status;
	lines_begin(&guard.lines);
	files_begin(&guard.files);
	guard.child.pidfd = guard.child.socket = -1;
	if (!be_the_only_one() || !listen_to_signals() || !feed_open(&guard.feed, guard.device))
		return 1;
	child_page(&guard.child);
	make_ready();
	if (!start(now_ms()))
		return 1;
	status = keep_watch();
	lines_release(&guard.lines);
	feed_close(&guard.feed);
	return status;
}
