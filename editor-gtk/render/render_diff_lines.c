/* SPDX-License-Identifier: MIT
 *
 * render_diff_lines - what differs and is no rung, as lines and charts; see
 * render_diff_lines.h.
 */
#include "editor-gtk/render/render_diff_lines.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/render/render_diff_sfc.h"
#include "editor-gtk/render/render_sheet.h"
#include "editor-gtk/draw/rung_layout.h"
#include "engine/compare/compare.h"

#define TEXT_LINE  17
#define SIGN_X     16   /* where + and - stand                                    */
#define NUMBER_END 62   /* and to where the number of a line reaches              */
#define TEXT_X     76
#define INDENT     7    /* px of a blank before a text                           */
#define AROUND     3    /* lines that are the same, shown before and after        */
#define TINT       0.10f

#define PLUS  "+"
#define MINUS "\xe2\x88\x92"
#define DOTS  "\xe2\x80\xa6"

struct listed {
	GArray *line;           /* struct compare_line; their texts are owned       */
	GStringChunk *texts;
};

static void take_line(void *context, struct compare_line line)
{
	struct listed *listed = context;

	line.text = g_string_chunk_insert(listed->texts, line.text);
	g_array_append_val(listed->line, line);
}

static bool is_same(const struct compare_line *line)
{
	return line->line_a && line->line_b;
}

/* Is a line near enough to one that differs? */
static bool is_shown(const GArray *lines, int index)
{
	const int from = MAX(0, index - AROUND), to = MIN((int)lines->len - 1,
							  index + AROUND);

	for (int i = from; i <= to; i++)
		if (!is_same(&g_array_index(lines, struct compare_line, i)))
			return true;
	return false;
}

static float put_text(struct lettering *lettering, enum token token, const char *text,
		      float x, float y, struct picture *picture)
{
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, text, -1, 0);

	picture_text(picture, token, LETTER_OPERAND, fits, x, y + 13);
	render_grow(picture, x + fits.width + SIGN_X, y + TEXT_LINE);
	return fits.width;
}

static void put_number(struct lettering *lettering, int number, float y,
		       struct picture *picture)
{
	char text[16];

	g_snprintf(text, sizeof(text), "%d", number);
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, text, -1, 0);
	picture_text(picture, TOKEN_COMMENT, LETTER_OPERAND, fits, NUMBER_END - fits.width,
		     y + 13);
}

static void put_line(struct lettering *lettering, const struct compare_line *line, float y,
		     struct picture *picture)
{
	const bool added = !line->line_a;
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;
	const float x = TEXT_X + (float)(line->indent * INDENT);
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, line->text, -1, 0);

	if (!is_same(line)) {
		picture_fill(picture, token, TINT, 0, y, x + fits.width + SIGN_X, TEXT_LINE);
		put_text(lettering, token, added ? PLUS : MINUS, SIGN_X, y, picture);
	}
	put_number(lettering, line->line_b ? line->line_b : line->line_a, y, picture);
	put_text(lettering, TOKEN_INK, line->text, x, y, picture);
}

float render_diff_lines(const struct project *a, int pou_a, const struct project *b,
			int pou_b, struct lettering *lettering, float y,
			struct picture *picture)
{
	struct listed listed = { g_array_new(FALSE, FALSE, sizeof(struct compare_line)),
				 g_string_chunk_new(4096) };
	bool left_out = false;

	compare_lines(a, pou_a, b, pou_b, take_line, &listed);
	for (int i = 0; i < (int)listed.line->len; i++) {
		if (!is_shown(listed.line, i)) {
			if (!left_out)
				put_text(lettering, TOKEN_COMMENT, DOTS, TEXT_X, y, picture);
			y += left_out ? 0 : TEXT_LINE;
			left_out = true;
			continue;
		}
		left_out = false;
		put_line(lettering, &g_array_index(listed.line, struct compare_line, i), y,
			 picture);
		y += TEXT_LINE;
	}
	g_array_unref(listed.line);
	g_string_chunk_free(listed.texts);
	return y + TEXT_LINE;
}

/* As it was (not @added) or is. */
static float put_chart(const struct sfc_sheet *chart, const GArray *marks, bool added,
		       const struct render_options *options, struct lettering *lettering,
		       float y, struct picture *picture)
{
	const struct sfc_scene scene = { .sheet = chart,
					 .theme = theme_get(options->theme, THEME_GREEN),
					 .mark = (const struct sfc_mark *)marks->data,
					 .mark_count = (int)marks->len };
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;

	picture_fill(picture, token, TINT, 0, y, RUNG_GUTTER + chart->width, chart->height);
	picture_text(picture, token, LETTER_HEADING,
		     lettering_fit(lettering, LETTER_HEADING, added ? PLUS : MINUS, -1, 0),
		     SIGN_X, y + 27);
	picture_move(picture, RUNG_GUTTER, y);
	sfc_draw(&scene, picture);
	picture_move(picture, 0, 0);
	y += chart->height + TEXT_LINE;
	render_grow(picture, RUNG_GUTTER + chart->width, y);
	return y;
}

float render_diff_charts(const struct project *a, int pou_a, const struct project *b,
			 int pou_b, const struct render_options *options,
			 struct lettering *lettering, float y, struct picture *picture)
{
	struct sfc_sheet *before = pou_a < 0 ? NULL :
		sfc_sheet_new(a, &a->pou[pou_a], lettering);
	struct sfc_sheet *after = pou_b < 0 ? NULL :
		sfc_sheet_new(b, &b->pou[pou_b], lettering);
	GArray *removed = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	GArray *added = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	if (before && after)
		render_diff_marks(before, after, removed, added);
	if (before)
		y = put_chart(before, removed, false, options, lettering, y, picture);
	if (after)
		y = put_chart(after, added, true, options, lettering, y, picture);
	g_array_unref(removed);
	g_array_unref(added);
	if (before)
		sfc_sheet_free(before);
	if (after)
		sfc_sheet_free(after);
	return y;
}

float render_diff_besides(const struct project *a, const struct project *b,
			  const struct render_options *options,
			  struct lettering *lettering, float y, struct picture *picture)
{
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (compare_besides(a, b, options->pou, &sink) > 0) {
		char **lines = g_strsplit(sink_memory_text(&memory), "\n", -1);

		y += render_heading(lettering, _("Outside the rungs"), y, picture);
		for (int i = 0; lines[i] && *lines[i]; i++, y += TEXT_LINE)
			put_text(lettering, TOKEN_INK, lines[i], SIGN_X, y, picture);
		g_strfreev(lines);
		y += TEXT_LINE;
		render_grow(picture, 1, y);
	}
	sink_memory_free(&memory);
	return y;
}
