/* SPDX-License-Identifier: MIT
 *
 * popover - a menu at a place, a text in a popover, and how one that was made for one
 * question goes away again.
 */
#ifndef EDITOR_POPOVER_H
#define EDITOR_POPOVER_H

#include <gtk/gtk.h>

/** popover_put - gives it a parent, with which it goes: a key may close the page below a menu
 * that is open. */
void popover_put(GtkWidget *popover, GtkWidget *parent);
/** popover_point - to @at of its parent, or where that comes nearest: it may be scrolled away. */
void popover_point(GtkWidget *popover, const GdkRectangle *at);
/** popover_drop - takes it from its parent, now; never in one of its own signals. A pointer
 * that was in it is not any more: GTK 4.8 asks what is below it for its surface in the next
 * layout, and one that is gone has none. */
void popover_drop(GtkWidget *popover);
/** popover_drop_later - the same when it comes to rest: its signals, and the action that
 * closed it, have run. */
void popover_drop_later(GtkWidget *popover);
/** popover_menu - opens @menu, which it takes, at @at of @parent; it is gone when it closes,
 * and the keys go to @then: GTK gives them back only to what had them when the menu was drawn. */
void popover_menu(GtkWidget *parent, GMenu *menu, const GdkRectangle *at, GtkWidget *then);
/** popover_menu_of - what @button opens is made by @make, which gives it away, the first time:
 * most menus are never seen. When it closes, the keys are where they were before. */
void popover_menu_of(GtkMenuButton *button, GMenu *(*make)(void));
/** popover_tell - a text that is seen whole, of a label that wraps; once it has the parent
 * whose style it takes. An empty one hides the label. */
void popover_tell(GtkLabel *label, const char *text);

#endif
