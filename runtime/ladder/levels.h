/* SPDX-License-Identifier: MIT
 *
 * levels - what lines show, as the kernel tells it to root.
 *
 * The level of a line cannot be read without taking the line; but of lines that
 * somebody has, the kernel prints it in its debugfs. Where that cannot be read, or
 * a chip prints in a way of its own, a level is not known: nothing is guessed.
 */
#ifndef LADDER_LEVELS_H
#define LADDER_LEVELS_H

#include <stdbool.h>
#include <stdint.h>

enum level { LEVEL_UNKNOWN, LEVEL_LOW, LEVEL_HIGH };

/**
 * levels_read - calls @visit for each line whose level the kernel tells
 * Fails: false; the kernel's file cannot be read.
 */
bool levels_read(void (*visit)(void *context, const char *chip,
			       uint32_t offset, enum level level),
		 void *context);
#endif
