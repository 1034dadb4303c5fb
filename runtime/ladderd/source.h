/* SPDX-License-Identifier: MIT
 *
 * source - loads the program file of ladderd.
 *
 * One of two files is linked: source_any.c loads rung files and code images,
 * source_image.c (SMALL=1) only images, without a parser.
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
	void *own, *image;     /* used by the implementation only            */
};

/** source_kinds - the kinds of files that can be loaded, for --version. */
const char *source_kinds(void);
/** source_load - @watch: also makes what stores the power of cells. Owns: source_free(), also after a failure. Scan-safe: no.
 * Fails: false and diagnostics. */
bool source_load(struct source *source, const char *path, bool watch);
/** source_load_text - the same from memory; @file names it in diagnostics. */
bool source_load_text(struct source *source, const char *file, const void *text, size_t len,
		      bool watch);
/**
 * source_settle - frees what was needed only for loading and diagnostics
 *
 * The program moves to another address. Owns: @source.   Scan-safe: no.
 * Fails: false when memory is out; the program is as before.
 */
bool source_settle(struct source *source);
/** source_leave_code - from now on, code of this process that is not used takes no memory
 *
 * Most of it reads, checks and translates programs. Code that is used again is mapped again, from the memory
 * that the kernel has for the file: not for a process that locks its memory. Scan-safe: no. */
void source_leave_code(void);
void source_free(struct source *source);
#endif
