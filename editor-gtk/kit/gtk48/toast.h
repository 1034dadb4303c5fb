/* SPDX-License-Identifier: MIT
 *
 * toast - shows a message that disappears by itself.
 *
 * Mends in libadwaita 1.2.2: AdwToastOverlay frees a toast when it has faded out, also while the
 * animation that showed it still runs; the end of that animation then writes to memory that was
 * freed. It happens when the close button is pressed within half a second, or when a window drew
 * no frame from the moment the toast came until it went, because it was covered or the machine
 * was busy. Here a toast goes only after the frames that showed it.
 *
 * To see it: tests/editor/kit/gtk48/test_toast.c with adw_toast_overlay_add_toast() in place of
 * toast_show(). Try so when the floor of libadwaita rises.
 */
#ifndef EDITOR_TOAST_H
#define EDITOR_TOAST_H

#include <adwaita.h>

/** toast_show - shows @text in @overlay for some seconds, after the messages that wait there. */
void toast_show(AdwToastOverlay *overlay, const char *text);

#endif
