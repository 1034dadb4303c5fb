/* SPDX-License-Identifier: MIT
 *
 * push - what `ladder push` sends and how: words of an ssh command, one call of
 * it, and the script that runs on the board.
 *
 * No shell runs on this side, and nothing of a user's file names reaches the
 * one over there.
 */
#ifndef LADDER_PUSH_H
#define LADDER_PUSH_H

#include "engine/base/sink.h"

#define PUSH_WORDS 32

/* How the script ends; what is not listed is the board's shell or ssh. */
enum push_end {
	PUSH_DONE = 0,
	PUSH_REFUSED = 41,     /* ladderd --check says no                    */
	PUSH_WENT_BACK = 42,   /* it did not start; the one before runs      */
	PUSH_NOTHING_RUNS = 43, /* it did not start, nor did the one before  */
	PUSH_NOT_WHOLE = 44,   /* what arrived is shorter than what was sent */
	PUSH_NO_LADDERD = 45,
	PUSH_NO_SERVICE = 46,  /* nothing there knows how to restart it      */
	PUSH_NO_ROOM = 47,     /* a file could not be written                */
	PUSH_NO_SSH = 255,     /* ssh's own: no connection, or it was cut    */
};

/* The words of `ssh [OPTION]... USER@BOARD COMMAND`. */
struct push_words {
	char *text;            /* what the words point into                  */
	const char *word[PUSH_WORDS + 3];
	int count;
};

/**
 * push_words_split - @command at its blanks, and @board behind it
 * Owns: free(words->text).   Fails: false; there are none or too many.
 */
bool push_words_split(struct push_words *words, const char *command,
		      const char *board);

/**
 * push_call - runs ssh with @remote as the last word and @bytes as its input
 *
 * Returns ssh's exit status, 255 also when a signal ended it, or -errno when it
 * could not be run. Output and errors go where ours go.
 */
int push_call(const struct push_words *words, const char *remote,
	      const void *bytes, size_t len);

/* What the script is told. All of it is ours; nothing needs quotes. */
struct push_names {
	const char *folder;    /* on the board: letters, digits, ._-/        */
	char name[24];         /* "push-" and hex digits: new in each push   */
	size_t program_bytes, map_bytes;
};
/** push_script - the text for the board's `sh -s`. */
void push_script(const struct push_names *names, const struct sink *out);
#endif
