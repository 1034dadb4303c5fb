/* SPDX-License-Identifier: MIT
 *
 * checker - reads and checks a copy of a text in a thread, a moment after its last change. It
 * knows the text of its owner, not the project that is edited.
 */
#ifndef EDITOR_CHECKER_H
#define EDITOR_CHECKER_H

#include "engine/ladder.h"

#include <gio/gio.h>

struct checker;

struct checker_text {
	struct ladder *reader; /* loads the text; the checker takes it over      */
	char *text;
	gsize len;
	const char *file;    /* interned                                       */
	guint64 version;
};

struct checker_how {
	/* The text of the owner now; the checker frees it. */
	void (*copy)(gpointer owner, struct checker_text *to);
	/* A check has ended. @read: the whole project could be read. */
	void (*done)(gpointer owner, bool read);
};

/** checker_new - @owner: frees it; stays until a running check has ended. @how: static. */
struct checker *checker_new(GObject *owner, const struct checker_how *how);
void checker_free(struct checker *checker);
/** checker_later - checks when nothing more has changed for a moment. */
void checker_later(struct checker *checker);
/** checker_stop - forgets checker_later(). */
void checker_stop(struct checker *checker);
/** checker_now - checks before it returns. */
void checker_now(struct checker *checker);

/** checker_ladder - what the last check has read, built if it could be; NULL: there was none.
 * Until the next one. */
struct ladder *checker_ladder(struct checker *checker);
/** checker_diags - its messages; the owner may add some. */
struct diag_list *checker_diags(struct checker *checker);
/** checker_version - of the text of the last check. */
guint64 checker_version(const struct checker *checker);
/** checker_place - gives the bodies of @project, the one of the checked text,
 * the lines that they have in the checked text. */
void checker_place(struct checker *checker, struct project *project);

#endif
