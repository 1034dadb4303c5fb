/* SPDX-License-Identifier: MIT
 *
 * source_image - loads and verifies a code image of `ladder build`, for small boards: no
 * parser, no translator.
 */
#include "ladderd/source.h"

#include "engine/base/file.h"

#include <stdlib.h>

const char *source_kinds(void)
{
	return "code images only";
}

bool source_load(struct source *source, const char *path, bool watch)
{
	struct arena scratch;
	struct diag place = { .file = path };
	size_t where;
	bool good;

	(void)watch; /* an image has the power of its cells or not */
	diag_init(&source->diags);
	source->image = file_read(path, LIMIT_IMAGE, &source->image_bytes,
				&source->diags);
	source->unreadable = !source->image;
	if (!source->image)
		return false;
	arena_init(&scratch);
	good = code_open(source->image, source->image_bytes, &scratch,
			 &source->program, &place.id, &where);
	arena_free(&scratch);
	return good || diag_add(&source->diags, place, "byte %zu", where);
}

/* Without --slots nothing comes from memory. */
bool source_load_text(struct source *source, const char *file, const void *text, size_t len,
		      bool watch)
{
	(void)text, (void)len, (void)watch;
	diag_init(&source->diags);
	return diag_add(&source->diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = file }, "%s", "");
}

bool source_settle(struct source *source)
{
	return source->image;
}

void source_free(struct source *source)
{
	free(source->image);
	source->image = NULL;
}
