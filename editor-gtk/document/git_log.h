/* SPDX-License-Identifier: MIT
 *
 * git_log - the revisions of a file in git, also under its older names, and files as they were
 * in one.
 *
 * Starts the program git with its arguments as an array, never through a shell, and only to
 * read. Nothing waits: results come from the main loop.
 */
#ifndef EDITOR_GIT_LOG_H
#define EDITOR_GIT_LOG_H

#include <gio/gio.h>

struct git_revision {
	char *hash, *brief;  /* whole, and as git shortens it                   */
	char *date;          /* of the author, as the session writes dates      */
	char *subject;
	char *name;          /* of the file then, from the top of the repository */
};

/** git_log_take - @revisions: struct git_revision, newest first, owned by the callee; NULL:
 * @why (translated, borrowed) says why there are none. */
typedef void git_log_take(gpointer data, GPtrArray *revisions, const char *why);
/** git_log_read - the last 500 revisions of the file at @path. @take is not called after
 * @cancel was cancelled. */
void git_log_read(const char *path, GCancellable *cancel, git_log_take *take, gpointer data);

/** git_text_take - @text: NUL-ended, owned by the callee, g_free(); NULL: @why. */
typedef void git_text_take(gpointer data, char *text, gsize len, const char *why);
/** git_log_show - a file as it was in a revision. @path: a file in the repository; @name: as in
 * struct git_revision. */
void git_log_show(const char *path, const char *hash, const char *name, GCancellable *cancel,
		  git_text_take *take, gpointer data);

#endif
