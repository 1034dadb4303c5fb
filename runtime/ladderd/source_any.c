/* SPDX-License-Identifier: MIT
 *
 * source_any - loads a rung file, which it checks and translates, or a code image.
 */
#define _GNU_SOURCE /* dl_iterate_phdr(), madvise() */
#include "ladderd/source.h"

#include "engine/ladder.h"

#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

/* Pages that cannot be written are those of the file. Whoever uses one maps it again. */
static int leave_pages(struct dl_phdr_info *info, size_t size, void *page)
{
	const uintptr_t mask = *(const uintptr_t *)page - 1;

	(void)size;
	for (int i = 0; i < info->dlpi_phnum; i++) {
		const ElfW(Phdr) *part = &info->dlpi_phdr[i];
		const uintptr_t begin = (info->dlpi_addr + part->p_vaddr) & ~mask;
		const uintptr_t end = (info->dlpi_addr + part->p_vaddr + part->p_memsz) & ~mask;

		if (part->p_type == PT_LOAD && !(part->p_flags & PF_W) && begin < end)
			madvise((void *)begin, end - begin, MADV_DONTNEED); /* only a hint */
	}
	return 0;
}

void source_leave_code(void)
{
	uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);

	dl_iterate_phdr(leave_pages, &page);
}

/* This C library keeps freed memory; the larger the blocks, the more. */
static void give_back(void)
{
	malloc_trim(0);
}
#else
void source_leave_code(void)
{
}

static void give_back(void)
{
}
#endif

const char *source_kinds(void)
{
	return "rung files and code images";
}

static bool begin(struct source *source, const char *file, bool watch)
{
	diag_init(&source->diags);
	source->own = ladder_new_terse();
	if (!source->own)
		return diag_add(&source->diags, (struct diag){
			.id = DIAG_NO_MEMORY, .file = file }, "%s", "");
	ladder_watch(source->own, watch);
	return true;
}

static bool finish(struct source *source, bool good)
{
	struct ladder *ladder = source->own;

	good = good && ladder_build(ladder);
	source->diags = *ladder_diags(ladder);
	source->unreadable = !good && !ladder_could_read(ladder);
	if (!good)
		return false;
	source->program = *ladder_program(ladder);
	ladder_image(ladder, &source->image_bytes);
	source->other_bytes = ladder_memory(ladder);
	return true;
}

bool source_load(struct source *source, const char *path, bool watch)
{
	return begin(source, path, watch) && finish(source, ladder_load(source->own, path));
}

bool source_load_text(struct source *source, const char *file, const void *text, size_t len,
		      bool watch)
{
	return begin(source, file, watch) &&
	       finish(source, ladder_load_text(source->own, file, text, len));
}

/* Keeps only the image; text and translation of 1,000 rungs take some megabytes. */
bool source_settle(struct source *source)
{
	struct arena scratch;
	struct program program;
	enum diag_id why;
	size_t where;
	void *image = malloc(source->image_bytes);
	bool good;

	if (!image)
		return false;
	memcpy(image, source->program.base, source->image_bytes);
	arena_init(&scratch);
	good = code_open(image, source->image_bytes, &scratch, &program, &why,
			 &where);
	arena_free(&scratch);
	if (!good) {
		free(image);
		return false;
	}
	ladder_free(source->own);
	source->own = NULL;
	source->image = image;
	source->program = program;
	give_back();
	return true;
}

void source_free(struct source *source)
{
	ladder_free(source->own);
	free(source->image);
	source->own = source->image = NULL;
}
