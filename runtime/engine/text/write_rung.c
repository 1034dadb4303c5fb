/* SPDX-License-Identifier: MIT
 *
 * write_rung - a rung as rows of cells between aligned bars.
 *
 * Widths are columns of a terminal, so that bars stay aligned after Chinese comments.
 * Faulty rungs are written too.
 */
#include "engine/text/writer.h"

#include "engine/base/lex.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

static void write_behind(const struct sink *sink, const struct project *project,
			 uint32_t id)
{
	if (!id)
		return;
	sink_text(sink, " ");
	write_id(sink, project, id);
}

static void write_element(const struct sink *sink, const struct project *project,
			  const struct cell *cell, const struct word_row *row)
{
	switch (row->operand) {
	case OPND_EXPR:
	case OPND_ASSIGN:
		sink_text(sink, "[");
		write_behind(sink, project, cell->operand);
		sink_text(sink, " ]");
		return;
	case OPND_PIN:
		sink_text(sink, row->word);
		write_id(sink, project, cell->operand);
		return;
	case OPND_EXECUTE:
		sink_text(sink, row->word);
		write_behind(sink, project, cell->operand);
		return;
	case OPND_NONE:
	case OPND_LOOP:
	case OPND_LOOP_END:
	case OPND_BOOL_R:
	case OPND_BOOL_W:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_LABEL:
	case OPND_ROUTINE:
	case OPND_INSTANCE:
		sink_text(sink, row->word);
		write_behind(sink, project, cell->operand);
		write_behind(sink, project, cell->args);
		return;
	}
}

/* An element, without comment. */
static void write_cell(const struct sink *sink, const struct project *project,
		       const struct cell *cell)
{
	if (cell->word != ELEM_EMPTY)
		write_element(sink, project, cell,
			      words_row(&project->words, (enum word)cell->word));
}

/* Width with the comment, and with the blank before a link. */
static void write_whole(const struct sink *sink, const struct project *project,
			const struct cell *cell)
{
	write_cell(sink, project, cell);
	if (cell->comment) {
		if (cell->word != ELEM_EMPTY)
			sink_text(sink, " ");
		write_id(sink, project, cell->comment);
	}
	if (cell->link && (cell->word != ELEM_EMPTY || cell->comment))
		sink_text(sink, " ");
}

/* ---- widths ---- */

static void count_width(void *context, const char *text, size_t len)
{
	*(int *)context += utf8_width(text, len);
}

static int cell_width(const struct project *project, const struct cell *cell)
{
	int width = 0;
	const struct sink sink = { .write = count_width, .context = &width };

	write_whole(&sink, project, cell);
	return width;
}

static bool is_blank(const struct cell *cell)
{
	return cell->word == ELEM_EMPTY && !cell->link && !cell->comment;
}

/* Cells of a row up to the last one that is not empty; one at least. */
static int row_cols(const struct rung *rung, int row)
{
	int cols = rung->cols;

	while (cols > 1 && is_blank(rung_at(rung, row, cols - 1)))
		cols--;
	return cols;
}

/* An empty rung of one row is written without the row. */
static int rows_to_write(const struct rung *rung)
{
	if (rung->rows == 1 && row_cols(rung, 0) == 1 &&
	    is_blank(rung_at(rung, 0, 0)))
		return 0;
	return rung->rows;
}

/* ---- rows ---- */

static void write_row(const struct sink *sink, const struct project *project,
		      const struct rung *rung, int row, const int *widths)
{
	const int cols = row_cols(rung, row);

	sink_text(sink, "  |");
	for (int col = 0; col < cols; col++) {
		const struct cell *cell = rung_at(rung, row, col);

		sink_text(sink, " ");
		write_whole(sink, project, cell);
		sink_repeat(sink, " ", widths[col] - cell_width(project, cell));
		sink_text(sink, cell->link ? "^|" : " |");
	}
	sink_text(sink, "\n");
}

static void write_rows(const struct sink *sink, const struct project *project,
		       const struct rung *rung)
{
	const int rows = rows_to_write(rung);
	int widths[LIMIT_COLS] = { 0 };

	for (int row = 0; row < rows; row++) {
		for (int col = 0; col < rung->cols; col++) {
			int width = cell_width(project, rung_at(rung, row, col));

			if (width > widths[col])
				widths[col] = width;
		}
	}
	for (int row = 0; row < rows; row++)
		write_row(sink, project, rung, row, widths);
}

/* Statements two blanks deeper; the inner lines of a comment stay as they are. */
static void write_statements(const struct sink *sink, const char *text, size_t len)
{
	const char *from = text;
	struct lex lex;

	lex_init(&lex, text, len);
	lex.newlines = lex.comments = lex.wide = true;
	while (comment_next(&lex) || lex.token.kind != TOKEN_END) {
		if (lex.token.kind != TOKEN_NEWLINE)
			continue;
		if (lex.token.text > from)
			sink_text(sink, "  ");
		sink_write(sink, from, (size_t)(lex.token.text + lex.token.len - from));
		from = lex.token.text + lex.token.len;
	}
}

static void write_boxes(const struct sink *sink, const struct project *project,
			const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		if (cell->word != ELEM_EXECUTE)
			continue;
		sink_text(sink, "  EXECUTE");
		write_behind(sink, project, cell->operand);
		sink_text(sink, ":\n");
		write_statements(sink, project_text(project, cell->args),
				 names_len(&project->names, cell->args));
		sink_text(sink, "  END_EXECUTE\n");
	}
}

void write_rung(const struct sink *sink, const struct project *project,
		const struct rung *rung)
{
	const struct text_heading heading = { rung->label, rung->title, rung->comment, rung->off };

	text_write_heading(project, "RUNG", &heading, sink);
	sink_text(sink, "\n");
	write_rows(sink, project, rung);
	write_boxes(sink, project, rung);
}

/* ---- one rung, one cell ---- */

char *text_write_rung(const struct project *project, const struct rung *rung)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	write_rung(&sink, project, rung);
	if (memory.failed)
		sink_memory_free(&memory);
	return memory.text;
}

struct bounded {
	char *out;
	size_t size, len; /* len counts text that did not fit, too            */
};

static void write_bounded(void *context, const char *text, size_t len)
{
	struct bounded *bounded = context;

	if (bounded->len + 1 < bounded->size) {
		size_t room = bounded->size - 1 - bounded->len;
		size_t part = len < room ? len : room;

		memcpy(bounded->out + bounded->len, text, part);
		bounded->out[bounded->len + part] = '\0';
	}
	bounded->len += len;
}

int text_write_cell(const struct project *project, const struct cell *cell,
		    char *out, size_t size)
{
	struct bounded bounded = { out, size, 0 };
	const struct sink sink = { .write = write_bounded, .context = &bounded };

	if (size > 0)
		out[0] = '\0';
	write_cell(&sink, project, cell);
	return (int)bounded.len;
}
