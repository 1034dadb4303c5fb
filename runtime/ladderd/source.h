/* SPDX-License-Identifier: MIT
 *
 * source - where a program comes from: the file that ladderd was given.
 *
 * Linked once: source_any.c takes rung files and code images, source_image.c
 * (SMALL=1) only images and needs no parser. Neither touches a pin.
 */
#ifndef LADDERD_SOURCE_H
#define LADDERD_SOURCE_H

#include "engine/scan/image.h"

struct source {
	struct program program;
	struct diag_list diags;
	bool unreadable;       /* the file could not be read at all          */
	size_t image_bytes;    /* of the code image                          */
	size_t other_bytes;    /* of text and translation, until settled     */
	void *own, *image;     /* of the implementation                      */
};

/** source_kinds - what this program can load, for --version. */
const char *source_kinds(void);
/** source_load - Fails: false and diagnostics; source_free() all the same.
 * Scan-safe: no. */
bool source_load(struct source *source, const char *path);
/**
 * source_settle - lets go of what only loading and its diagnostics needed
 *
 * The program moves. Owns: @source.   Scan-safe: no.
 * Fails: false when memory is out; the program is as before.
 */
bool source_settle(struct source *source);
void source_free(struct source *source);
#endif
