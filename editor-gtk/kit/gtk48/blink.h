/* SPDX-License-Identifier: MIT
 *
 * blink - a hidden line of text that has the keys is not marked.
 *
 * Mends in GTK 4.8.3: a line that gets the focus lets its cursor blink, and marks its text. If it is
 * hidden, for example in a page behind another one whose list fills its rows anew, it does not look
 * whether a marked text may blink, and warns in the next frame: "unexpected blinking selection". To see
 * it: run tests/editor/kit/gtk48/test_blink.c without blink_follow(). Try it without on each new floor.
 */
#ifndef EDITOR_BLINK_H
#define EDITOR_BLINK_H

#include <gtk/gtk.h>

/** blink_follow - once for each window. */
void blink_follow(GtkWindow *window);

#endif
