/* SPDX-License-Identifier: MIT
 *
 * memory - what a large project took goes back to the system when it is freed.
 *
 * GNU's C library would keep it; others have nothing to be told.
 */
#ifndef EDITOR_MEMORY_H
#define EDITOR_MEMORY_H

/** memory_give_back_large - once, at the start: large blocks are not kept in holes. */
void memory_give_back_large(void);
/** memory_give_back - now, what is free. */
void memory_give_back(void);

#endif
