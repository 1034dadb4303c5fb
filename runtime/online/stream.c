/* SPDX-License-Identifier: MIT
 *
 * stream - a socket pair is the standard input and output of a command; nothing of a board's
 * name reaches a shell.
 */
#define _GNU_SOURCE /* POSIX_SPAWN_SETSID */
#include "online/stream.h"
#include "online/port.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* ---- where ---- */

bool stream_is_plain(const char *text, const char *also)
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

/* Only bytes that mean nothing to a shell, nor to ssh when it runs a command of its
 * configuration. */
bool stream_is_host(const char *text)
{
	const char *at = strrchr(text, '@');
	const char *host = at ? at + 1 : text;

	return *text != '-' && *host && *host != '-' && at != text &&
	       stream_is_plain(text, "@._-:[]%/");
}

const char *stream_parse(const char *text, struct stream_where *out)
{
	static const struct { const char *word; enum stream_kind kind; } kinds[] = {
		{ "ssh:", STREAM_SSH }, { "unix:", STREAM_UNIX },
		{ "exec:", STREAM_EXEC }, { "serial:", STREAM_SERIAL },
	};

	*out = (struct stream_where){ .kind = STREAM_SSH, .rest = text };
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
		if (strncmp(text, kinds[i].word, strlen(kinds[i].word)) == 0)
			*out = (struct stream_where){ kinds[i].kind, text + strlen(kinds[i].word) };
	if (out->kind == STREAM_UNIX && !*out->rest)
		out->rest = STREAM_SOCKET;
	if (!*out->rest)
		return "a board is missing: USER@BOARD, unix:SOCKET, exec:COMMAND or serial:TTY";
	if (out->kind == STREAM_SSH && !stream_is_host(out->rest))
		return "is not USER@BOARD";
	return NULL;
}

/* ---- commands ---- */

bool stream_split(struct stream_words *words, const char *command)
{
	const size_t len = strlen(command) + 1;
	char *at;

	memset(words, 0, sizeof(*words));
	words->text = malloc(len);
	if (!words->text)
		return false;
	memcpy(words->text, command, len);
	for (at = words->text; *at;) {
		char *end = at + strcspn(at, " \t\n");
		const bool last = !*end;

		*end = '\0';
		if (end > at && words->count == STREAM_WORDS)
			return false;
		if (end > at)
			words->word[words->count++] = at;
		at = last ? end : end + 1;
	}
	return words->count;
}

static int start(const struct stream_words *words, const struct stream_how *how,
		 struct stream *out)
{
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	sigset_t signals;
	int pair[2], error;

	if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
		return -errno;
	sigemptyset(&signals);
	sigaddset(&signals, SIGPIPE); /* a desk ignores it; its command must not */
	posix_spawnattr_init(&attributes);
	posix_spawnattr_setsigdefault(&attributes, &signals);
	posix_spawnattr_setflags(&attributes, (short)(POSIX_SPAWN_SETSIGDEF |
						      (how->environment ? POSIX_SPAWN_SETSID : 0)));
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_adddup2(&actions, pair[1], STDIN_FILENO);
	posix_spawn_file_actions_adddup2(&actions, pair[1], STDOUT_FILENO);
	if (how->environment)
		posix_spawn_file_actions_adddup2(&actions, how->errors, STDERR_FILENO);
	error = posix_spawnp(&out->child, words->word[0], &actions, &attributes,
			     words->word, how->environment ? how->environment : environ);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	close(pair[1]);
	out->fd = pair[0];
	if (error) {
		close(pair[0]);
		out->child = 0;
	}
	return -error;
}

static int open_ssh(const char *host, const struct stream_how *how, struct stream *out)
{
	static char quiet[] = "-T", end[] = "--", attach[] = "ladder-attach";
	struct stream_words words;
	int error = -EINVAL;

	if (stream_split(&words, how->ssh ? how->ssh : "ssh")) {
		words.word[words.count++] = quiet;
		words.word[words.count++] = end;
		words.word[words.count++] = (char *)host;
		words.word[words.count++] = attach;
		error = start(&words, how, out);
	}
	free(words.text);
	return error;
}

static int open_command(const char *command, const struct stream_how *how,
			struct stream *out)
{
	struct stream_words words;
	const int error = stream_split(&words, command) ? start(&words, how, out) : -EINVAL;

	free(words.text);
	return error;
}

/* ---- this machine ---- */

static int open_socket(const char *path, struct stream *out)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };

	if (strlen(path) >= sizeof(address.sun_path))
		return -ENAMETOOLONG;
	memcpy(address.sun_path, path, strlen(path));
	out->fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	if (out->fd < 0)
		return -errno;
	if (connect(out->fd, (const void *)&address, sizeof(address)) == 0)
		return 0;
	const int error = -errno;

	close(out->fd);
	return error;
}

int stream_open(const struct stream_where *where, const char *ssh, struct stream *out)
{
	return stream_open_alone(where, &(struct stream_how){ .ssh = ssh }, out);
}

int stream_open_alone(const struct stream_where *where, const struct stream_how *how,
		      struct stream *out)
{
	*out = (struct stream){ .fd = -1 };
	switch (where->kind) {
	case STREAM_SSH:
		return open_ssh(where->rest, how, out);
	case STREAM_UNIX:
		return open_socket(where->rest, out);
	case STREAM_EXEC:
		return open_command(where->rest, how, out);
	case STREAM_SERIAL:
		out->fd = port_open(where->rest, &out->baud);
		return out->fd < 0 ? out->fd : 0;
	}
	return -EINVAL;
}

int stream_close(struct stream *stream)
{
	int status = -1;

	if (stream->fd >= 0)
		close(stream->fd);
	stream->fd = -1;
	if (!stream->child)
		return -1;
	while (waitpid(stream->child, &status, 0) < 0 && errno == EINTR)
		continue;
	stream->child = 0;
	return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
