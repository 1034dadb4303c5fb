/* SPDX-License-Identifier: MIT
 *
 * rung_text - the texts of elements and rungs; see rung_text.h.
 */
#include "editor-gtk/draw/rung_text.h"

#include "editor-gtk/kit/comment_text.h"

#include <glib.h>
#include <string.h>

static const struct lettered nothing = { "", 0 };

static struct lettered fit(const struct drafting *drafting, enum letter letter,
			   const char *text, float bound)
{
	return *text ? lettering_fit(drafting->lettering, letter, text, -1, bound) :
		       nothing;
}

static bool has_names(const struct word_row *word)
{
	return word->operand == OPND_BOOL_R || word->operand == OPND_BOOL_W ||
	       word->operand == OPND_ANY_R || word->operand == OPND_ANY_W;
}

/* Paper has no tooltips, so names get more room. */
static float name_bound(const struct drafting *drafting)
{
	return drafting->all_comments ? 2 * LABEL_BOUND : LABEL_BOUND;
}

struct rung_label rung_label(const struct drafting *drafting, const struct cell *cell)
{
	const struct word_row *word = word_row(cell->word);
	const char *operand = project_text(drafting->project, cell->operand);
	struct rung_label label = { nothing, nothing };
	float bound = name_bound(drafting);
	struct grid_name name;

	if (!cell->operand || (word->kind == WORD_ELEM && !has_names(word)))
		return label;
	name = grid_names_find(drafting->names, operand);
	if (drafting->show != SHOW_ADDRESSES || !*name.address)
		label.symbol = fit(drafting, LETTER_SYMBOL, name.symbol, bound);
	if (drafting->show != SHOW_SYMBOLS || !*name.symbol)
		label.address = fit(drafting, LETTER_ADDRESS, name.address, bound);
	return label;
}

struct lettered rung_element_comment(const struct drafting *drafting,
				     const struct cell *cell, float room)
{
	const char *comment = project_text(drafting->project, cell->comment);
	struct lettered fits = nothing;

	if (!*comment && drafting->comments && cell->operand)
		comment = grid_names_find(drafting->names,
					  project_text(drafting->project,
						       cell->operand)).comment;
	if (*comment) {
		char *plain = comment_text(comment);

		fits = fit(drafting, LETTER_PIN, plain, room);
		g_free(plain);
	}
	return fits;
}

bool rung_is_framed(const struct word_row *word)
{
	return word->kind == WORD_ELEM && word->place != PLACE_NONE &&
	       word->place != PLACE_WIRE && word->place != PLACE_PIN &&
	       !has_names(word) &&
	       !(word->operand == OPND_NONE && word->place == PLACE_SERIES);
}

static void break_lines(const struct drafting *drafting, const char *text,
			struct rung_framed *framed)
{
	struct lettering *lettering = drafting->lettering;

	while (*text && framed->lines < FRAMED_LINES) {
		bool last = framed->lines == FRAMED_LINES - 1;
		struct lettered line = lettering_line(lettering, LETTER_OPERAND, &text,
						      FRAMED_BOUND, last);

		framed->line[framed->lines++] = line;
		framed->width = MAX(framed->width, line.width);
	}
}

static struct rung_framed in_lines(const struct drafting *drafting, const char *text)
{
	struct rung_framed framed = { .lines = 1, .up = RUNG_HALF };

	framed.line[0] = fit(drafting, LETTER_OPERAND, text, 0);
	framed.width = framed.line[0].width;
	if (framed.width > FRAMED_BOUND) {
		framed.lines = 0;
		framed.width = 0;
		break_lines(drafting, text, &framed);
		framed.up = (float)(framed.lines * FRAMED_LINE) / 2 + 2;
	}
	return framed;
}

/* A line of statements; @more: it is the last one that fits, and others follow. */
static void add_statement(const struct drafting *drafting, const char *line, size_t len, bool more,
			  struct rung_framed *framed)
{
	char *text = g_strdup_printf("%.*s%s", (int)len, line, more ? " …" : "");
	const struct lettered fits = fit(drafting, LETTER_OPERAND, text, FRAMED_BOUND);

	framed->line[framed->lines++] = fits;
	framed->width = MAX(framed->width, fits.width);
	g_free(text);
}

/* The name of an EXECUTE box and its first lines. */
static struct rung_framed statements(const struct drafting *drafting, const struct cell *cell)
{
	const char *name = project_text(drafting->project, cell->operand);
	const char *line = project_text(drafting->project, cell->args), *end;
	struct rung_framed framed = { .left = true };
	char *title = g_strdup_printf("%s%s%s", word_row(cell->word)->word, *name ? " " : "", name);

	add_statement(drafting, title, strlen(title), false, &framed);
	g_free(title);
	for (; *line && framed.lines < FRAMED_LINES; line = end) {
		const size_t len = strcspn(line, "\n");

		end = line + len + strspn(line + len, "\n");
		line += g_str_has_prefix(line, "  ") ? 2 : 0; /* the usual indent */
		add_statement(drafting, line, strcspn(line, "\n"),
			      *end && framed.lines == FRAMED_LINES - 1, &framed);
	}
	framed.up = MAX((float)(framed.lines * FRAMED_LINE) / 2 + 2, RUNG_HALF);
	return framed;
}

struct rung_framed rung_framed(const struct drafting *drafting, const struct cell *cell)
{
	const struct word_row *word = word_row(cell->word);
	const char *operand = project_text(drafting->project, cell->operand);
	bool says_word = word->operand == OPND_LOOP || word->operand == OPND_ROUTINE;
	bool is_word = word->operand == OPND_NONE || word->operand == OPND_LOOP_END;
	struct rung_framed framed;
	char *text;

	if (word->operand == OPND_EXECUTE)
		return statements(drafting, cell);
	if (!says_word && !is_word)
		return in_lines(drafting, operand);
	text = g_strdup_printf("%s%s%s", explain_inside(word), is_word ? "" : " ",
			       is_word ? "" : operand);
	framed = in_lines(drafting, text);
	g_free(text);
	return framed;
}

struct rung_heading rung_heading(const struct drafting *drafting, const struct rung *rung)
{
	const struct project *project = drafting->project;
	struct rung_heading heading = { nothing, nothing, 0, 0, NULL, 0 };

	if (rung->label) {
		char *label = g_strdup_printf("%s:", project_text(project, rung->label));

		heading.label = fit(drafting, LETTER_OPERAND, label,
				    name_bound(drafting));
		g_free(label);
		heading.indent = heading.label.width + TITLE_AIR;
		heading.width = heading.indent;
	}
	if (rung->title) {
		heading.title = fit(drafting, LETTER_TITLE,
				    project_text(project, rung->title), 0);
		heading.width += heading.title.width + TITLE_AIR;
	}
	heading.comment = comment_text(project_text(project, rung->comment));
	heading.comment_width = fit(drafting, LETTER_COMMENT, heading.comment, 0).width;
	return heading;
}

int rung_lines(const struct drafting *drafting, enum letter letter, const char *text,
	       float width, int most,
	       void (*take)(void *context, int line, struct lettered text),
	       void *context)
{
	int lines = 0;

	while (*text && lines < most) {
		struct lettered line = lettering_line(drafting->lettering, letter, &text,
						      width, lines == most - 1);

		if (take)
			take(context, lines, line);
		lines++;
	}
	return lines;
}
