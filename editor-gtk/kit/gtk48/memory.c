/* SPDX-License-Identifier: MIT
 *
 * memory - what is kept for the next frame, and what goes back to the system.
 */
#include "editor-gtk/kit/gtk48/memory.h"

#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>

#define FRAME (32 * 1024 * 1024) /* bytes: more than a frame takes, the most there can be */

void memory_keep_frames(void)
{
	mallopt(M_MMAP_THRESHOLD, FRAME);
	mallopt(M_TRIM_THRESHOLD, 2 * FRAME);
}

void memory_give_back(void)
{
	malloc_trim(0);
}
#else
void memory_keep_frames(void)
{
}

void memory_give_back(void)
{
}
#endif
