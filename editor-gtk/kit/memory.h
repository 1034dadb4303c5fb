/* SPDX-License-Identifier: MIT
 *
 * memory - tells the C library of GNU when to keep freed memory and when to give it back to
 * the system. With another C library both functions do nothing.
 */
#ifndef EDITOR_MEMORY_H
#define EDITOR_MEMORY_H

/** memory_keep_frames - call once at the start. Each frame allocates and frees an image of
 * the window; this memory is kept for the next frame, because new pages for it would cost a
 * third of the time of a frame. */
void memory_keep_frames(void);
/** memory_give_back - gives free memory to the system now; after something large was freed. */
void memory_give_back(void);

#endif
