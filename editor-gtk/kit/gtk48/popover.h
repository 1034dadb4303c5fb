/* SPDX-License-Identifier: MIT
 *
 * popover - opens, points and removes popovers and menus.
 *
 * Mends in GTK 4.8.3:
 * - Lost pointer, popover_init(): after a layout GDK tells a popover's surface that the
 *   pointer moves on it, even if the popover is hidden (gdk_surface_ensure_motion(),
 *   maybe_request_motion_event()). The window then believes the pointer is there until it
 *   moves, and a press is lost. To see it: open and close a menu, change the layout by a key,
 *   click without moving the pointer. Test: tests/editor/kit/gtk48/test_popover.c.
 * - Critical, popover_init(): half a second after the pointer moved in a popover, GTK asks its
 *   surface where a tooltip is due. A popover that closed in between has none. To see it: storm
 *   12 of tests/editor/person/storm.py, which tests it.
 * - Crash, popover_drop(): a popover that is unparented while the pointer is in it is asked
 *   for its surface in the next layout and has none.
 * - Crash, popover_init(): a popover that points outside the window, such as to a line that was
 *   scrolled away, looks for a monitor there and finds none. It points to the nearest place in the
 *   window instead. To see it: storm 4, which asks for the condition of a breakpoint.
 *   Test: test_popover.c.
 * - Cut text, popover_tell(): a popover measures its height for more width than its child
 *   gets, so that the last line of a wrapped label is cut off. To see it: a refusal that
 *   needs just two lines at a line of quick entry. An open popover does not grow
 *   with its child, such as the form of an array with a last index below the first.
 * - Covered menu, popover_is_above(): the tooltip of a button is drawn above the menu that the
 *   button opened. To see it: click an arrow of the palette and wait.
 * - Cut menu, popover_menu(): a popover below its place gets no more height than there is, above
 *   or below, and its menu scrolls without a sign. Beside its place it slides, and has the height of
 *   the screen. To see it: the menu of an element in the middle of a screen of 1024x700.
 * - Focus, popover_menu() and popover_menu_of(): when a menu closes, GTK gives the focus back
 *   only to the widget that had it when the menu was first drawn.
 * - Lost keys, popover_init(): an item of a menu takes the focus when the pointer moves over it, also
 *   just after the menu was closed; then no key does anything. To see it: storm 20, the menu of a
 *   cell. Test: test_popover.c.
 * - Tab, popover_form(): a popover whose parent is in a table is left by Tab, and closes.
 * Remove each of them on a new floor, and run test_popover and tests/editor/person/seal_in.py.
 */
#ifndef EDITOR_POPOVER_H
#define EDITOR_POPOVER_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** popover_init - from now on a popover that closes gives up its surface. Call once, in the
 * main thread. */
void popover_init(void);
/** popover_is_above - is a menu open that @widget is not in? Tooltips ask. NULL: of a sheet. */
bool popover_is_above(GtkWidget *widget);
/** popover_put - sets the parent of @popover, which is removed when @parent is destroyed: a key
 * may close the page below an open menu. */
void popover_put(GtkWidget *popover, GtkWidget *parent);
/** popover_point - points to @at of its parent, or to the nearest place inside the parent. */
void popover_point(GtkWidget *popover, const GdkRectangle *at);
/** popover_drop - unparents it now. Never call it in one of the popover's own signals. */
void popover_drop(GtkWidget *popover);
/** popover_drop_later - the same when its signals, and the action that closed it, have run. */
void popover_drop_later(GtkWidget *popover);
/** popover_menu - opens @menu at @at of @parent. When it closes it is removed and @then gets
 * the focus. Owns: takes @menu. */
void popover_menu(GtkWidget *parent, GMenu *menu, const GdkRectangle *at, GtkWidget *then);
/** popover_menu_of - @button opens the menu that @make gives, which is called the first time:
 * most menus are never seen. When it closes, the focus goes back. Owns: takes the menu. */
void popover_menu_of(GtkMenuButton *button, GMenu *(*make)(void));
/** popover_form - from now on Tab goes round inside @popover, and Escape closes it. When it closes, the focus
 * goes to @back, which must live as long as @popover. */
void popover_form(GtkWidget *popover, GtkWidget *back);
/** popover_tell - sets the text of a label inside a popover, and shows all of its lines; "":
 * hides the label. Call it when the label has a parent. */
void popover_tell(GtkLabel *label, const char *text);

#endif
