/* SPDX-License-Identifier: MIT
 *
 * ladder_convert - the facade's conversion of POUs to other languages.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/convert/convert.h"
#include "engine/exchange/classic/sfc_ladder.h"

#include <stdlib.h>
#include <string.h>

static char *no_text(struct sink_memory *memory, struct project *project, struct diag_list *diags)
{
	if (memory->failed)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
	sink_memory_free(memory);
	return NULL;
}

/* Of POUs that are no charts. */
static char *convert_bodies(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
			    struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	if (!convert_to(project, wanted, to, &sink, diags) || memory.failed)
		return no_text(&memory, project, diags);
	*len = memory.len;
	return memory.text;
}

static char *convert_charts(struct ladder *ladder, const uint8_t *wanted, size_t *len, struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	if (!sfc_ladder(project, wanted, &sink, diags) || memory.failed)
		return no_text(&memory, project, diags);
	*len = memory.len;
	return memory.text;
}

/* The POUs that are wanted, and those that charts have become. Owns: the caller, free(). */
static uint8_t *wanted_again(const struct project *was, const uint8_t *wanted, const struct project *is,
			     enum pou_language to)
{
	uint8_t *again = calloc((size_t)is->pou_count + 1, 1);

	for (int i = 0; again && i < is->pou_count; i++) {
		const struct pou *pou = &is->pou[i];
		const char *name = project_text(is, pou->name);
		const int at = project_find_pou(was, name, strlen(name));

		/* A condition or a body that was a list of the chart stays one. */
		again[i] = (pou->language == LANGUAGE_LD || pou->language == LANGUAGE_FBD) && pou->language != to &&
			   !pou->included && (at >= 0 ? wanted[at] : 1);
	}
	return again;
}

/* A place in a ladder that a chart has become is none of the file. */
static void tell_again(const struct project *project, const struct diag_list *from, struct diag_list *to)
{
	for (int i = 0; i < from->count; i++)
		if (diag_severity(from->diag[i].id) == SEVERITY_ERROR)
			diag_add(to, (struct diag){ .id = from->diag[i].id, .file = project->file }, "%s",
				 from->diag[i].arg);
}

/* From the text in which charts are ladders. */
static char *convert_again(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, char *text, size_t *len,
			   struct diag_list *diags)
{
	const struct project *project = ladder_project(ladder);
	struct ladder *again = ladder_new();
	struct diag_list *list = calloc(1, sizeof(*list));
	uint8_t *those = NULL;
	char *out = NULL;

	if (again && list && ladder_load_text(again, project->file, text, *len) && ladder_build(again)) {
		those = wanted_again(project, wanted, ladder_project(again), to);
		out = those ? convert_bodies(again, those, to, len, list) : NULL;
		tell_again(project, list, diags);
	} else if (again) {
		tell_again(project, ladder_diags(again), diags);
	}
	free(those);
	free(list);
	ladder_free(again);
	return out;
}

/* Charts become ladders first. All other POUs are converted without them before, so that messages have the places
 * of the file. */
static char *convert_both(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
			  struct diag_list *diags)
{
	const struct project *project = ladder_project(ladder);
	uint8_t *rest = malloc((size_t)project->pou_count + 1);
	char *text = NULL, *out = NULL;
	bool others = to != LANGUAGE_LD;

	for (int i = 0; rest && i < project->pou_count; i++) {
		rest[i] = wanted[i] && project->pou[i].language != LANGUAGE_SFC;
		others |= rest[i] > 0;
	}
	if (rest)
		text = convert_bodies(ladder, rest, to, len, diags);
	if (text) {
		free(text);
		text = convert_charts(ladder, wanted, len, diags);
	}
	free(rest);
	if (!text || !others)
		return text;
	out = convert_again(ladder, wanted, to, text, len, diags);
	free(text);
	return out;
}

char *ladder_export_as(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
		       struct diag_list *diags)
{
	const struct project *project = ladder_project(ladder);
	bool charts = false;
	char *out;

	if (!project)
		return NULL;
	for (int i = 0; i < project->pou_count; i++)
		charts |= wanted[i] && project->pou[i].language == LANGUAGE_SFC;
	out = charts ? convert_both(ladder, wanted, to, len, diags) : convert_bodies(ladder, wanted, to, len, diags);
	if (!out && !diags->errors)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
	return out;
}

char *ladder_export_lists(struct ladder *ladder, const uint8_t *wanted, size_t *len)
{
	struct project *project = ladder_project(ladder);

	if (!project)
		return NULL;
	if (!wanted)
		convert_join(project);
	for (int i = 0; i < project->pou_count; i++) {
		int count = 0;
		struct var *const *temp = ladder_temporaries(ladder, i, &count);

		/* The calls of a function with ARRAY[*] have one list for each set of bounds. */
		if (pou_has_any_bounds(&project->pou[i]) || (wanted && !wanted[i]))
			continue;
		if (!convert_to_il(project, i, ladder_il(ladder, i), temp, count))
			return NULL;
	}
	return ladder_write(ladder, len);
}
