/* SPDX-License-Identifier: MIT
 *
 * bookmarks - bookmarks as text: lines `bookmark POU NUMBER` of the VIEW part of a file.
 *
 * Other lines of that part stay as they are. It knows no document.
 */
#ifndef EDITOR_BOOKMARKS_H
#define EDITOR_BOOKMARKS_H

#include <stdbool.h>

/* What happens to the rungs of a POU. All numbers are 0-based. */
struct bookmark_shift {
	const char *name, *to;     /* of the POU, before and afterwards        */
	int at, removed, inserted;
	int from;                  /* >= 0: a rung moves from there to @at     */
	bool drop;                 /* the bookmark at @at is cleared           */
};

/** bookmarks_have - has @view a bookmark at that rung of the POU? */
bool bookmarks_have(const char *view, const char *pou, int rung);
/** bookmarks_add - @view ("": none yet) with one more. Caller: g_free(). */
char *bookmarks_add(const char *view, const char *pou, int rung);
/** bookmarks_shift - @view with bookmarks that follow their rungs. Caller: g_free(). */
char *bookmarks_shift(const char *view, const struct bookmark_shift *shift);

#endif
