/* SPDX-License-Identifier: MIT
 *
 * outline - the canonical text with the places of its parts.
 *
 * It writes nothing itself: the writer tells it where a part begins and ends.
 */
#include "engine/text/text.h"
#include "engine/text/writer.h"

#define OUTLINE_DEPTH (8 + LIMIT_MACROS) /* parts inside one another; those that are
					    deeper are not told               */

struct outline {
	struct sink_memory memory;
	struct sink into;
	void (*take)(void *context, const struct text_span *span);
	void *context;
	struct text_span open[OUTLINE_DEPTH];
	int depth;
};

static void outline_write(void *context, const char *text, size_t len)
{
	struct outline *outline = context;

	sink_write(&outline->into, text, len);
}

static void outline_mark(void *context, int kind, int number, bool begins)
{
	struct outline *outline = context;
	const int at = outline->depth - !begins;
	const struct text_span *outer;
	struct text_span *span;

	if (at >= OUTLINE_DEPTH) {
		outline->depth += begins ? 1 : -1;
		return;
	}
	span = &outline->open[at];
	if (begins) {
		outer = at ? span - 1 : NULL;
		*span = (struct text_span){ (enum text_part)kind, number,
			outer ? outer->pou : -1, outer ? outer->structure : -1,
			outline->memory.len, 0 };
		if (kind == TEXT_POU)
			span->pou = number;
		if (kind == TEXT_STRUCT)
			span->structure = number;
		outline->depth++;
		return;
	}
	outline->depth--;
	span->len = outline->memory.len - span->at;
	if (outline->take)
		outline->take(outline->context, span);
}

char *text_outline(const struct project *project, size_t *len,
		   void (*take)(void *context, const struct text_span *span),
		   void *context)
{
	struct outline outline = { .take = take, .context = context };
	const struct sink sink = { outline_write, &outline, outline_mark };

	sink_memory_init(&outline.memory);
	outline.into = sink_to_memory(&outline.memory);
	write_project(&sink, project);
	*len = outline.memory.len;
	if (outline.memory.failed)
		sink_memory_free(&outline.memory);
	return outline.memory.text;
}
