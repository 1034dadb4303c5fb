/* SPDX-License-Identifier: MIT
 *
 * slow_bar - scroll bars that follow what is scrolled 100 ms later.
 *
 * Mends in GTK 4.8.3: to move the slider of a bar GTK lays out the window, asks the X server
 * for the monitors and waits for its answer: a fourth of the time of a frame. Nobody sees
 * whether the slider follows after 16 or 100 ms, nor one pixel: for less it does not follow.
 * A slider that is dragged follows at once. Overlay bars are switched off: while one fades in,
 * a second of frames is drawn up to the edge of the window through four clips.
 *
 * To see it: remove a call of slow_bar_make() and compare "Scrolling" of `make bench-editor`.
 * Compare so on each new floor. It works only as long as the bar listens to the adjustment
 * with itself as data; otherwise nothing is blocked and the bar follows at once.
 *
 * - Blank window, slow_bar_choose(): with automatic policy GtkScrolledWindow shows or hides a
 *   bar while it is allocated. Widgets above it may then be left without allocation, and what
 *   they hold is not drawn until their size changes. To see it: search the manual in windows of
 *   several sizes, or run tests/editor/person/panes.py, without slow_bar_choose_all().
 *
 * - "Trying to snapshot GtkGizmo … without a current allocation", and a slider that stays where it
 *   was: GtkTextView lays out its first lines, and scrolls, while it is drawn. The slider asks for
 *   a layout then, and is drawn before it. Bars wait until the window has been drawn. To see it:
 *   the same without the calls of wait_for_drawing().
 *
 * - The same warning with GtkTextView, and a blank text: a text that scrolls while it is laid out asks
 *   for another layout. If a widget around it, such as a GtkPaned, is laid out at the same time, it
 *   forgets that afterwards, and the text is not drawn until its size changes. Then the scroller asks
 *   again. To see it: run storm 35 some times on a busy machine without the call of lay_out_again().
 */
#ifndef EDITOR_SLOW_BAR_H
#define EDITOR_SLOW_BAR_H

#include <gtk/gtk.h>

/** slow_bar_choose - shows the bars that are needed; decided after the layout, not in it. A bar
 * that is always or never shown stays so. Its adjustments stay the same from now on. */
void slow_bar_choose(GtkScrolledWindow *scroller);
/** slow_bar_choose_all - slow_bar_choose() for each one that is mapped from now on, in any window,
 * also of GTK; except in popups. Once for the program. */
void slow_bar_choose_all(void);
/** slow_bar_make - slow_bar_choose(), and makes both bars of @scroller slow, as long as it lives. */
void slow_bar_make(GtkScrolledWindow *scroller);

#endif
