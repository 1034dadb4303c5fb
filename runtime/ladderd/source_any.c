/* SPDX-License-Identifier: MIT
 *
 * source_any - loads a rung file, which it checks and translates, or a code image.
 */
#include "ladderd/source.h"

#include "engine/ladder.h"

#include <stdlib.h>
#include <string.h>

const char *source_kinds(void)
{
	return "rung files and code images";
}

bool source_load(struct source *source, const char *path, bool watch)
{
	struct ladder *ladder = ladder_new_terse();
	bool good;

	diag_init(&source->diags);
	source->own = ladder;
	if (!ladder)
		return diag_add(&source->diags, (struct diag){
			.id = DIAG_NO_MEMORY, .file = path }, "%s", "");
	ladder_watch(ladder, watch);
	good = ladder_load(ladder, path) && ladder_build(ladder);
	source->diags = *ladder_diags(ladder);
	source->unreadable = !good && !ladder_could_read(ladder);
	if (!good)
		return false;
	source->program = *ladder_program(ladder);
	ladder_image(ladder, &source->image_bytes);
	source->other_bytes = ladder_memory(ladder);
	return true;
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
	return true;
}

void source_free(struct source *source)
{
	ladder_free(source->own);
	free(source->image);
	source->own = source->image = NULL;
}
