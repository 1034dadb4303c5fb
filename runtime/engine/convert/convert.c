/* SPDX-License-Identifier: MIT
 *
 * convert - puts converted bodies into the text of their project.
 */
#include "engine/convert/convert.h"

#include "engine/convert/acts.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

/* Where the heading and the body of each POU stand. */
struct places {
	struct text_span *pou, *body; /* a span a POU                         */
	int count;
};

static void take(void *context, const struct text_span *span)
{
	struct places *places = context;

	if (span->number < 0 || span->number >= places->count)
		return;
	if (span->part == TEXT_POU)
		places->pou[span->number] = *span;
	if (span->part == TEXT_BODY)
		places->body[span->number] = *span;
}

static bool convert_one(struct acts *acts, const struct pou *pou, enum pou_language to, const struct sink *sink)
{
	acts->pou = pou;
	acts->networks = to == LANGUAGE_FBD;
	if (pou->language == LANGUAGE_FBD)
		return to == LANGUAGE_LD ? fbd_ladder(acts, sink) : fbd_st(acts, sink);
	if (!ladder_acts(acts))
		return false;
	settle_acts(acts);
	if (acts->failed)
		return false;
	if (acts->networks)
		return fbd_text(acts, sink);
	st_declare(acts, sink);
	st_text(acts, sink);
	return true;
}

/* The heading of a POU, whose first line ends with its language. */
static bool put_heading(const struct sink *sink, const char *text, size_t len, const char *was, enum pou_language to)
{
	const char *end = memchr(text, '\n', len);
	const size_t word = strlen(was);

	if (!end || (size_t)(end - text) < word || memcmp(end - word, was, word) != 0)
		return false;
	sink_write(sink, text, (size_t)(end - text) - word);
	sink_text(sink, pou_language_word(to));
	sink_write(sink, end, len - (size_t)(end - text));
	return true;
}

static bool is_known(enum pou_language from, enum pou_language to)
{
	return (from == LANGUAGE_LD && (to == LANGUAGE_ST || to == LANGUAGE_FBD)) ||
	       (from == LANGUAGE_FBD && (to == LANGUAGE_ST || to == LANGUAGE_LD));
}

static bool refuse_language(const struct acts *acts, const struct pou *pou, enum pou_language to)
{
	const char *name = project_text(acts->project, pou->name);

	return diag_add(acts->diags, (struct diag){ .id = DIAG_CONVERT_LANGUAGE, .file = pou->file, .line = pou->line,
						    .pou = name },
			"%s" DIAG_AND "%s" DIAG_AND "%s", name, pou_language_word(pou->language),
			pou_language_word(to));
}

static bool put_pou(struct acts *acts, int number, const char *text, const struct places *places,
		    enum pou_language to, const struct sink *sink)
{
	const struct pou *pou = &acts->project->pou[number];
	const struct text_span *whole = &places->pou[number], *body = &places->body[number];

	if (!is_known(pou->language, to))
		return refuse_language(acts, pou, to);
	if (!put_heading(sink, text + whole->at, body->at - whole->at, pou_language_word(pou->language), to) ||
	    !convert_one(acts, pou, to, sink))
		return false;
	if (pou->tail)
		sink_printf(sink, "%s\n", project_text(acts->project, pou->tail));
	return true;
}

/* POUs stand in the text in the order of their places, which need not be that of their numbers. */
static int next_pou(const struct project *project, const struct places *places, const uint8_t *wanted,
		    enum pou_language to, size_t at)
{
	int found = -1;

	for (int i = 0; i < places->count; i++)
		if (wanted[i] && project->pou[i].language != to && places->body[i].len + places->pou[i].len && places->pou[i].at >= at &&
		    (found < 0 || places->pou[i].at < places->pou[found].at))
			found = i;
	return found;
}

static bool put_all(struct project *project, struct scope *scope, struct arena *arena, const uint8_t *wanted,
		    enum pou_language to, const struct places *places, const char *text, size_t len, const struct sink *sink,
		    struct diag_list *diags)
{
	struct expr *expr = arena_alloc(arena, sizeof(*expr));
	bool good = expr != NULL;
	size_t at = 0;

	for (int i; expr && (i = next_pou(project, places, wanted, to, at)) >= 0;) {
		struct acts acts = { .project = project, .scope = scope, .arena = arena, .diags = diags,
				     .expr = expr };

		sink_write(sink, text + at, places->pou[i].at - at);
		good &= put_pou(&acts, i, text, places, to, sink);
		at = places->body[i].at + places->body[i].len;
	}
	sink_write(sink, text + at, len - at);
	return good && !arena->failed;
}

bool convert_to(struct project *project, const uint8_t *wanted, enum pou_language to, const struct sink *sink,
		struct diag_list *diags)
{
	const size_t size = (size_t)project->pou_count + 1;
	const int errors = diags->errors;
	struct places places = { .count = project->pou_count };
	struct scope *scope;
	struct arena arena;
	char *text = NULL;
	bool good = false;
	size_t len;

	arena_init(&arena);
	places.pou = arena_alloc(&arena, size * sizeof(*places.pou));
	places.body = arena_alloc(&arena, size * sizeof(*places.body));
	scope = scope_new(project, &arena);
	if (places.pou && places.body && scope)
		text = text_outline(project, &len, take, &places);
	if (text)
		good = put_all(project, scope, &arena, wanted, to, &places, text, len, sink, diags);
	free(text);
	arena_free(&arena);
	if (!good && diags->errors == errors)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
	return good;
}
