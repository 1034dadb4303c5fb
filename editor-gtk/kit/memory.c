/* SPDX-License-Identifier: MIT
 *
 * memory - see memory.h.
 */
#include "editor-gtk/kit/memory.h"

#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>

#define FRAME (32 * 1024 * 1024) /* bytes: the largest value that glibc accepts */

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
