/* SPDX-License-Identifier: MIT
 *
 * source_image - loads and verifies a code image of `ladder build`, for small boards: no
 * parser, no translator.
 */
#include "ladderd/source.h"

#include "engine/base/file.h"

#include <stdlib.h>
#include <string.h>

const char *source_kinds(void)
{
	return "code images only";
}

static bool open_image(struct source *source, const char *file)
{
	struct arena scratch;
	struct diag place = { .file = file };
	size_t where;
	bool good;

	arena_init(&scratch);
	good = code_open(source->image, source->image_bytes, &scratch,
			 &source->program, &place.id, &where);
	arena_free(&scratch);
	return good || diag_add(&source->diags, place, "byte %zu", where);
}

bool source_load(struct source *source, const char *path, bool watch)
{
	(void)watch; /* an image has the power of its cells or not */
	diag_init(&source->diags);
	source->image = file_read(path, LIMIT_IMAGE, &source->image_bytes,
				&source->diags);
	source->unreadable = !source->image;
	return source->image && open_image(source, path);
}

bool source_load_text(struct source *source, const char *file, const void *text, size_t len,
		      bool watch)
{
	(void)watch;
	diag_init(&source->diags);
	source->image = malloc(len + 1);
	source->image_bytes = len;
	if (!source->image)
		return diag_add(&source->diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = file },
				"%s", "");
	memcpy(source->image, text, len);
	return open_image(source, file);
}

bool source_settle(struct source *source)
{
	return source->image;
}

void source_leave_code(void)
{
}

void source_free(struct source *source)
{
	free(source->image);
	source->image = NULL;
}
