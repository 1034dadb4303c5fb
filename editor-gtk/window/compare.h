/* SPDX-License-Identifier: MIT
 *
 * compare - compares the document with another version, or two other files: asks which, reads them,
 * shows the page.
 */
#ifndef EDITOR_WINDOW_COMPARE_H
#define EDITOR_WINDOW_COMPARE_H

#include "editor-gtk/document/comparison.h"
#include "editor-gtk/window/core.h"

struct compare {
	struct core *core;
	GCancellable *cancel;   /* of git; NULL: nothing is awaited               */
	char *older;            /* the first of two files that are asked for; NULL: none */
};

void compare_init(struct compare *compare, struct core *core);
void compare_clear(struct compare *compare);
/** compare_ask - asks with what, and shows the page. */
void compare_ask(struct compare *compare);
/** compare_ask_files - asks for two files, and shows the page. */
void compare_ask_files(struct compare *compare);
/** compare_files - shows the page of two files. */
void compare_files(struct compare *compare, const char *older, const char *newer);
/** compare_with - shows the page of @older, whose texts are taken over, and the document. */
void compare_with(struct compare *compare, struct compare_side *older);
/** compare_step - shows the next or previous difference; of a page that is not in front, the
 * one that is selected. */
void compare_step(struct compare *compare, bool back);

#endif
