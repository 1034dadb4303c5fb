/* SPDX-License-Identifier: MIT
 *
 * bookmarks - bookmarks as text: lines `bookmark POU NUMBER` of the VIEW part of a file.
 *
 * Other lines of that part stay as they are. It works on text and needs no document.
 */
#ifndef EDITOR_BOOKMARKS_H
#define EDITOR_BOOKMARKS_H

#include <stdbool.h>

/* A change of the rungs of a POU. All numbers are 0-based. */
struct bookmark_shift {
	const char *name, *to;     /* name of the POU, before and afterwards   */
	int at, removed, inserted;
	int from;                  /* >= 0: the rung that moves to @at         */
	bool drop;                 /* clears the bookmark at @at               */
};

/** bookmarks_have - does @view have a bookmark at that rung of the POU? */
bool bookmarks_have(const char *view, const char *pou, int rung);
/** bookmarks_add - @view with one more bookmark. @view: "": no VIEW part. Caller: g_free(). */
char *bookmarks_add(const char *view, const char *pou, int rung);
/** bookmarks_shift - @view with its bookmarks moved as the rungs are. Caller: g_free(). */
char *bookmarks_shift(const char *view, const struct bookmark_shift *shift);

#endif
