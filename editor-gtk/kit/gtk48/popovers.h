/* SPDX-License-Identifier: MIT
 *
 * popovers - what the toolkit leaves undone when a list or a menu closes.
 */
#ifndef EDITOR_POPOVERS_H
#define EDITOR_POPOVERS_H

/**
 * popovers_let_go - from now on no popover that is closed keeps the pointer
 *
 * GTK (seen in 4.8.3: gdk_surface_ensure_motion(), maybe_request_motion_event()) tells the
 * surface of a popover that the pointer moves on it when a layout changes, also after it was
 * hidden. The window then takes the pointer to be there until it moves: a press is lost, and
 * now and then one that comes just after a movement. A popover that is closed gives its
 * surface up here, as if it had never been shown; it gets another one when it is. Once, by
 * the main thread.
 */
void popovers_let_go(void);

#endif
