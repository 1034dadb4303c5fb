/* SPDX-License-Identifier: MIT
 *
 * memory - what a large project took goes back to the system when it is freed.
 */
#include "editor-gtk/memory.h"

#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>

#define LARGE (256 * 1024) /* bytes, from where on a block is a mapping of its own */

void memory_give_back_large(void)
{
	mallopt(M_MMAP_THRESHOLD, LARGE);
}

void memory_give_back(void)
{
	malloc_trim(0);
}
#else
void memory_give_back_large(void)
{
}

void memory_give_back(void)
{
}
#endif
