/* SPDX-License-Identifier: MIT
 *
 * ladder_convert - the facade's conversion of POUs to other languages.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"
#include "engine/convert/convert.h"
#include "engine/exchange/classic/sfc_ladder.h"
#include "engine/model/sfc.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

enum { CELL_MOST = 160 };

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
		again[i] = (to == LANGUAGE_IL || pou->language == LANGUAGE_LD || pou->language == LANGUAGE_FBD) &&
			   pou->language != to && !pou->included && (at >= 0 ? wanted[at] : 1);
	}
	return again;
}

/* ---- places ---- */

/* Main_Act is what the action Act of the chart Main has become. */
static bool is_made_of(const char *name, const char *chart, const char *part)
{
	const size_t len = strlen(chart);

	return ascii_same(name, chart, len) && strlen(name) > len && name[len] == '_' &&
	       (!part || (strlen(name + len + 1) == strlen(part) && ascii_same(name + len + 1, part, strlen(part))));
}

/* The rung of a condition that has the cell of the ladder's rung; -1: none. */
static int same_cell(const struct project *is, const struct rung *rung, const struct diag *from,
		     const struct project *was, const struct pou *chart)
{
	char text[CELL_MOST], other[CELL_MOST];

	if (from->row < 1 || from->row > rung->rows || from->col < 1 || from->col > rung->cols)
		return -1;
	text_write_cell(is, rung_at(rung, from->row - 1, from->col - 1), text, sizeof(text));
	for (int i = 0; i < chart->rung_count; i++)
		for (int row = 0; row < chart->rung[i]->rows; row++)
			for (int col = 0; col < chart->rung[i]->cols; col++) {
				text_write_cell(was, rung_at(chart->rung[i], row, col), other, sizeof(other));
				if (*text && !strcmp(text, other))
					return i;
			}
	return -1;
}

/* The line of the first step that a title names, as in "Fill -> Stir"; 0: it names none. */
static int line_of_title(const struct project *was, const struct pou *chart, const char *title)
{
	struct lex lex;

	lex_init(&lex, title, strlen(title));
	while (lex_next(&lex) != TOKEN_END)
		for (int i = 0; lex.token.kind == TOKEN_NAME && i < chart->sfc->step_count; i++) {
			const char *name = project_text(was, chart->sfc->step[i].name);

			if (strlen(name) == lex.token.len && ascii_same(name, lex.token.text, lex.token.len))
				return chart->sfc->step[i].line;
		}
	return 0;
}

/* @place: gets the action, condition or step of a chart that became the ladder in which @from lies. */
static void place_in_chart(const struct project *was, const struct pou *chart, const struct project *is,
			   const struct pou *ladder, const struct diag *from, struct diag *place)
{
	const struct rung *rung = from->rung > 0 && from->rung <= ladder->rung_count ? ladder->rung[from->rung - 1] : NULL;
	int at;

	place->file = chart->file;
	place->line = chart->line;
	place->pou = project_text(was, chart->name);
	for (int i = 0; i < chart->sfc->action_count; i++) {
		const struct sfc_action *action = &chart->sfc->action[i];

		if (!is_made_of(from->pou, place->pou, project_text(was, action->name)))
			continue;
		place->line = action->line;
		if (!rung || !sfc_body_has_rungs(&action->body) || from->rung > action->body.count)
			return;
		place->rung = action->body.first + from->rung;
		place->row = from->row;
		place->col = from->col;
		place->line = (int)chart->rung[place->rung - 1]->line;
		return;
	}
	if (!rung)
		return;
	at = same_cell(is, rung, from, was, chart);
	if (at >= 0) {
		place->rung = at + 1;
		place->line = (int)chart->rung[at]->line;
	} else if (line_of_title(was, chart, project_text(is, rung->title))) {
		place->line = line_of_title(was, chart, project_text(is, rung->title));
	}
}

static void place_of(const struct project *was, const struct project *is, const struct diag *from, struct diag *place)
{
	const int made = from->pou ? project_find_pou(is, from->pou, strlen(from->pou)) : -1;

	for (int i = 0; made >= 0 && i < was->pou_count; i++)
		if (was->pou[i].language == LANGUAGE_SFC && was->pou[i].sfc &&
		    is_made_of(from->pou, project_text(was, was->pou[i].name), NULL)) {
			place_in_chart(was, &was->pou[i], is, &is->pou[made], from, place);
			return;
		}
}

/* A place in a ladder that a chart has become is none of the file: it is that of a part of the chart. */
static void tell_again(const struct project *was, const struct project *is, const struct diag_list *from,
		       struct diag_list *to)
{
	for (int i = 0; i < from->count; i++) {
		struct diag place = { .id = from->diag[i].id, .file = was->file };

		if (diag_severity(place.id) != SEVERITY_ERROR)
			continue;
		if (is)
			place_of(was, is, &from->diag[i], &place);
		diag_add(to, place, "%s", from->diag[i].arg);
	}
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
		out = !those ? NULL : to == LANGUAGE_IL ? ladder_export_lists(again, those, len) :
		      convert_bodies(again, those, to, len, list);
		tell_again(project, ladder_project(again), list, diags);
	} else if (again) {
		tell_again(project, ladder_project(again), ladder_diags(again), diags);
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

	if (to == LANGUAGE_IL) {
		text = convert_charts(ladder, wanted, len, diags);
		out = text ? convert_again(ladder, wanted, to, text, len, diags) : NULL;
		free(text);
		free(rest);
		return out;
	}
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

/* Programs alone have ladders for their steps. */
static void refuse_chart(const struct project *project, const struct pou *pou, enum pou_language to, struct diag_list *diags)
{
	const char *name = project_text(project, pou->name);

	diag_add(diags, (struct diag){ .id = DIAG_CONVERT_LANGUAGE, .file = pou->file, .line = pou->line, .pou = name },
		 "%s" DIAG_AND "%s" DIAG_AND "%s", name, pou_language_word(pou->language), pou_language_word(to));
}

char *ladder_export_as(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
		       struct diag_list *diags)
{
	const struct project *project = ladder_project(ladder);
	bool charts = false;
	char *out;

	if (!project)
		return NULL;
	for (int i = 0; i < project->pou_count; i++) {
		charts |= wanted[i] && project->pou[i].language == LANGUAGE_SFC;
		if (wanted[i] && project->pou[i].language == LANGUAGE_SFC && project->pou[i].kind == POU_BLOCK)
			refuse_chart(project, &project->pou[i], to, diags);
	}
	if (diags->errors)
		return NULL;
	out = charts ? convert_both(ladder, wanted, to, len, diags) :
	      to == LANGUAGE_IL ? ladder_export_lists(ladder, wanted, len) :
	      convert_bodies(ladder, wanted, to, len, diags);
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
