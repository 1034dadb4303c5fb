/* SPDX-License-Identifier: MIT
 *
 * memory - what is kept for the next frame, and what goes back to the system.
 *
 * GNU's C library would keep it; others have nothing to be told.
 */
#ifndef EDITOR_MEMORY_H
#define EDITOR_MEMORY_H

/** memory_keep_frames - once, at the start: a picture of the window, which each frame
 * asks for and frees, is kept for the next one. New pages for it would cost a third of
 * the frame. */
void memory_keep_frames(void);
/** memory_give_back - now, what is free: after something large went. */
void memory_give_back(void);

#endif
