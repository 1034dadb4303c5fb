/* SPDX-License-Identifier: MIT
 *
 * image_il - a code image as a program of instruction lists, for a board without sources.
 *
 * Names, values and tasks are those of the image; what it does not name gets a name made of
 * its place. Comments and rungs are not in an image. The lists read again make another image
 * that does the same.
 */
#ifndef EXCHANGE_IMAGE_IL_H
#define EXCHANGE_IMAGE_IL_H

#include "engine/base/sink.h"
#include "engine/scan/code.h"

/* What the lists cannot say. */
struct image_il_report {
	void (*lost)(void *context, const char *pou, const char *text);
	void *context;
	int count;           /* of lines; 0: the lists do the same as the image */
};

/**
 * image_il_text - the same in memory
 * @lost: gets a line for each instruction that has no list, "Main: …"; NULL: none
 *
 * Owns: the caller, free() of both.   Scan-safe: no.   Fails: NULL: no memory.
 */
char *image_il_text(const struct program *program, size_t *len, char **lost);
#endif
