/* SPDX-License-Identifier: MIT
 *
 * child - starts programs with posix_spawn, which works without an MMU. ladderd reports its
 * first scan through NOTIFY_SOCKET, as to a service manager.
 */
#define _GNU_SOURCE /* pipe2 */

#include "tests/targets/guest/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

static char text[TEXT_BYTES];

/* One abstract socket for the whole run: a NUL, then a name. */
static int notify_socket(char *name, size_t size)
{
	static int fd = -1;
	struct sockaddr_un at = { .sun_family = AF_UNIX };
	int len = snprintf(name, size, "guest-%d", (int)getpid());

	if (fd >= 0)
		return fd;
	fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	memcpy(at.sun_path + 1, name, (size_t)len);
	if (fd < 0 || bind(fd, (struct sockaddr *)&at,
			   (socklen_t)(offsetof(struct sockaddr_un, sun_path) +
				       1 + (size_t)len)) != 0)
		give_up("socket for NOTIFY_SOCKET");
	return fd;
}

static int64_t wait_ready(int limit_ms)
{
	char name[32], said[64];
	struct pollfd ready = { .events = POLLIN };

	ready.fd = notify_socket(name, sizeof(name));
	while (poll(&ready, 1, limit_ms) == 1) {
		ssize_t len = recv(ready.fd, said, sizeof(said) - 1, 0);

		said[len > 0 ? len : 0] = 0;
		if (strcmp(said, "READY=1") == 0)
			return clock_now();
	}
	return 0;
}

int64_t child_ready(void)
{
	return wait_ready(LIMIT_MS);
}

bool child_is_ready(void)
{
	return wait_ready(0) != 0;
}

static void path_of(const struct child *child, const char *what, char *out,
		    size_t size)
{
	snprintf(out, size, "%s/%s%d", guest.work, what, child->slot);
}

static void launch(struct child *child, const char *const *argv, int err)
{
	char out_path[PATH_MOST], err_path[PATH_MOST], name[32], said[64];
	char variable[64];
	char *environment[] = { variable, NULL };
	posix_spawn_file_actions_t files;
	const int flags = O_WRONLY | O_CREAT | O_TRUNC;
	int fd = notify_socket(name, sizeof(name)), error;

	while (recv(fd, said, sizeof(said), 0) >= 0)
		;
	snprintf(variable, sizeof(variable), "NOTIFY_SOCKET=@%s", name);
	if (child->slot != 0)
		environment[0] = NULL;
	path_of(child, "out", out_path, sizeof(out_path));
	path_of(child, "err", err_path, sizeof(err_path));
	unlink(out_path);
	unlink(err_path);
	posix_spawn_file_actions_init(&files);
	posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
	posix_spawn_file_actions_addopen(&files, 1, out_path, flags, 0666);
	if (err >= 0)
		posix_spawn_file_actions_adddup2(&files, err, 2);
	else
		posix_spawn_file_actions_addopen(&files, 2, err_path, flags,
						 0666);
	child->ended = child->traced = false;
	child->status = 0;
	error = posix_spawn(&child->pid, argv[0], &files, NULL,
			    (char *const *)(uintptr_t)argv, environment);
	posix_spawn_file_actions_destroy(&files);
	if (error) {
		errno = error;
		give_up(argv[0]);
	}
}

void child_start(struct child *child, int slot, const char *const *argv)
{
	child->slot = slot;
	child->pipe = -1;
	launch(child, argv, -1);
}

void child_start_pipe(struct child *child, const char *const *argv)
{
	int ends[2];

	if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
		give_up("pipe");
	child->slot = 0;
	child->pipe = ends[0];
	launch(child, argv, ends[1]);
	close(ends[1]);
}

#define ARGS 12

/* Fills @argv with the arguments after @map. */
static void collect(const char **argv, const char *file, const char *map,
		    va_list more)
{
	int count = 0;

	argv[count++] = guest.ladderd;
	argv[count++] = file;
	argv[count++] = "--io";
	argv[count++] = map;
	while (count < ARGS - 1 &&
	       (argv[count] = va_arg(more, const char *)) != NULL)
		count++;
	argv[count] = NULL;
}

void ladderd_start(struct child *child, const char *file, const char *map, ...)
{
	const char *argv[ARGS];
	va_list more;

	va_start(more, map);
	collect(argv, file, map, more);
	va_end(more);
	child_start(child, 0, argv);
}

int ladderd_run(const char *file, const char *map, ...)
{
	const char *argv[ARGS];
	struct child child;
	va_list more;

	va_start(more, map);
	collect(argv, file, map, more);
	va_end(more);
	child_start(&child, 0, argv);
	return child_end(&child);
}

static bool has_ended(struct child *child)
{
	if (child->ended || child->traced)
		return child->ended;
	if (waitpid(child->pid, &child->status, WNOHANG) != child->pid)
		return false;
	child->ended = true;
	return true;
}

int child_end(struct child *child)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;
	bool hangs = false;

	while (!has_ended(child)) {
		if (!hangs && clock_now() >= end_ns) {
			hangs = true;
			kill(child->pid, SIGKILL);
		}
		sleep_ms(1);
	}
	if (child->pipe >= 0)
		close(child->pipe);
	child->pipe = -1;
	if (hangs)
		return CHILD_HANGS;
	return WIFSIGNALED(child->status) ?
		       CHILD_SIGNAL + WTERMSIG(child->status) :
		       WEXITSTATUS(child->status);
}

void child_signal(struct child *child, int signal_number)
{
	if (!has_ended(child))
		kill(child->pid, signal_number);
}

int child_stop(struct child *child)
{
	child_signal(child, SIGTERM);
	return child_end(child);
}

static const char *printed(const struct child *child, const char *what)
{
	char path[PATH_MOST];

	path_of(child, what, path, sizeof(path));
	if (file_take(path, text, sizeof(text)) < 0)
		text[0] = 0;
	return text;
}

const char *child_out(const struct child *child)
{
	return printed(child, "out");
}

const char *child_err(const struct child *child)
{
	return printed(child, "err");
}

bool child_line(struct child *child, const char *want)
{
	static char line[128];
	static size_t len;
	bool found = false;

	while (read(child->pipe, &line[len], 1) == 1) {
		if (line[len] != '\n') {
			len += len < sizeof(line) - 1;
			continue;
		}
		line[len] = 0;
		len = 0;
		found = found || strstr(line, want) != NULL;
	}
	return found;
}

bool child_says(struct child *child, const char *want)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;

	while (!strstr(child_err(child), want)) {
		if (has_ended(child))
			return strstr(child_err(child), want) != NULL;
		if (clock_now() >= end_ns)
			return false;
		sleep_ms(1);
	}
	return true;
}

/* Status blocks end with an empty line; the last one is the newest. */
static const char *last_block(const char *all, unsigned *count)
{
	const char *block = "", *at = all, *end;

	*count = 0;
	while ((end = strstr(at, "\n\n")) != NULL) {
		block = at;
		at = end + 2;
		++*count;
	}
	return block;
}

const char *child_status(struct child *child)
{
	int64_t end_ns = clock_now() + LIMIT_MS * MS;
	unsigned before, now;
	const char *block;

	last_block(child_out(child), &before);
	child_signal(child, SIGUSR1);
	do {
		sleep_ms(1);
		block = last_block(child_out(child), &now);
	} while (now == before && !has_ended(child) && clock_now() < end_ns);
	return block;
}

long child_number(const char *from, const char *word)
{
	size_t len = strlen(word);

	for (const char *line = from; line; line = strchr(line, '\n')) {
		line += *line == '\n';
		if (strncmp(line, word, len) == 0 && line[len] == ' ')
			return strtol(line + len, NULL, 10);
		if (!*line)
			break;
	}
	return -1;
}
