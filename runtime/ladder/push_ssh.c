/* SPDX-License-Identifier: MIT
 *
 * push_ssh - one call of the system's ssh, fed by a pipe. ssh asks for passwords
 * and host keys on the terminal itself.
 */
#include "ladder/push.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

bool push_words_split(struct push_words *words, const char *command,
		      const char *board)
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

static int start(const struct push_words *words, int input, int other_end,
		 pid_t *pid)
{
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	sigset_t signals;
	int error;

	/* ssh must not inherit that we ignore SIGPIPE. */
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

/* Whatever it does not take, its exit status tells why. */
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

int push_call(const struct push_words *words, const char *remote,
	      const void *bytes, size_t len)
{
	struct push_words all = *words;
	int ends[2], error, status;
	pid_t pid;

	all.word[all.count++] = remote;
	all.word[all.count] = NULL;
	if (pipe(ends) != 0)
		return -errno;
	/* A closed standard input must not become an end of the pipe. */
	while (ends[0] <= STDERR_FILENO || ends[1] <= STDERR_FILENO) {
		int high[2] = { fcntl(ends[0], F_DUPFD, STDERR_FILENO + 1),
				fcntl(ends[1], F_DUPFD, STDERR_FILENO + 1) };

		close(ends[0]);
		close(ends[1]);
		if (high[0] < 0 || high[1] < 0)
			return -EMFILE;
		memcpy(ends, high, sizeof(ends));
	}
	error = start(&all, ends[0], ends[1], &pid);
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
