/* SPDX-License-Identifier: MIT
 *
 * stream - opens the stream of bytes to a board: ssh, a socket of this machine, a command, a
 * serial line.
 *
 * For programs of a desk only: it starts processes. It sends nothing itself.
 */
#ifndef ONLINE_STREAM_H
#define ONLINE_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define STREAM_SOCKET "/run/rungboard/link" /* where the service of a board listens */
#define STREAM_WORDS  32   /* of a command                                      */

enum stream_kind { STREAM_SSH, STREAM_UNIX, STREAM_EXEC, STREAM_SERIAL };

/* Where a board is, as a person writes it. */
struct stream_where {
	enum stream_kind kind;
	const char *rest;      /* user@host, path, command or tty; in the text */
};
/**
 * stream_parse - `pi@garage`, `ssh:garage`, `unix:/run/rungboard/link`, `exec:COMMAND`,
 * `serial:/dev/ttyUSB0,115200`, `unix:` for this machine
 *
 * Fails: NULL when it is good; else what is wrong, static.
 */
const char *stream_parse(const char *text, struct stream_where *out);

/** stream_is_plain - whether @text has only letters, digits and bytes of @also: nothing that
 * has a meaning to a shell. */
bool stream_is_plain(const char *text, const char *also);
/** stream_is_host - whether @text is USER@BOARD or BOARD: plain, and no option of ssh. */
bool stream_is_host(const char *text);

/* A command as words; its user may add some, and a NULL. */
struct stream_words {
	char *text;            /* what the words point into                   */
	char *word[STREAM_WORDS + 5];
	int count;
};
/** stream_split - splits @command at its blanks. Owns: the caller, free(words->text), also
 * after a failure. Fails: false: no word, too many, or no memory. */
bool stream_split(struct stream_words *words, const char *command);

struct stream {
	int fd;                /* both ways                                   */
	pid_t child;           /* 0: none                                     */
	uint32_t baud;         /* of a serial line, which needs online/serial.h; 0: reliable */
};

/**
 * stream_open - @ssh: the command and its options, NULL: "ssh"
 *
 * The standard error of a command is that of this process, so ssh's questions and messages
 * reach a terminal. Owns: the caller, stream_close(). Fails: -errno.
 */
int stream_open(const struct stream_where *where, const char *ssh, struct stream *out);
/* How a command is started by a program without a terminal: in a session of its own. */
struct stream_how {
	const char *ssh;       /* as in stream_open()                          */
	char *const *environment;
	int errors;            /* takes its standard error                     */
};
/** stream_open_alone - the same as stream_open(), for a program without a terminal. */
int stream_open_alone(const struct stream_where *where, const struct stream_how *how,
		      struct stream *out);
/** stream_close - closes it and waits for its command; returns its exit status, -1: none or a
 * signal. */
int stream_close(struct stream *stream);
#endif
