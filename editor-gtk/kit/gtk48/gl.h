/* SPDX-License-Identifier: MIT
 *
 * gl - starts without GL when the cairo renderer draws.
 *
 * Mends in GTK 4.8.3: GDK gets GL ready even if GSK_RENDERER is cairo, which takes 30 ms of a
 * start. To see it: remove the calls and compare the start in `make bench-editor`. Try so on
 * each new floor.
 */
#ifndef EDITOR_GTK48_GL_H
#define EDITOR_GTK48_GL_H

/** gl_spare - call before the display is opened: switches GL off by the environment, if cairo
 * draws. */
void gl_spare(void);
/** gl_forget - call when the display is open: programs that are started from here do not
 * inherit it. */
void gl_forget(void);

#endif
