/* SPDX-License-Identifier: MIT
 *
 * read_rung - RUNG and its rows: cells, bars, links, boxes, expressions.
 *
 * A cell is read word by word and not cut at bars, because a comment may hold a bar. check/
 * finds whether the drawing makes sense.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/model/loop.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- cells ---- */

/* `---`; longer ones are taken too. */
static bool read_wire(struct reader *r, struct cell *cell)
{
	const char *text = r->lex.token.text;

	if (r->lex.end - text < 3 || memcmp(text, "---", 3) != 0)
		return reader_fail_token(r, DIAG_UNKNOWN_WORD);
	do
		reader_next(r);
	while (reader_is(r, '-') && !r->lex.token.space_before);
	cell->word = ELEM_WIRE;
	return true;
}

/* Is the box of this row of pins one of the project? The rows above lie one after the other,
 * each as long as it was written. */
static bool is_own_box(const struct reader *r)
{
	const int col = r->place.col - 1;
	int first = r->cell_count - col;

	for (int row = r->rows - 1; row >= 0; row--) {
		first -= r->row_cols[row];
		if (col >= r->row_cols[row])
			return false;
		if (r->cell[first + col].word != ELEM_PIN)
			return word_is_own((enum word)r->cell[first + col].word);
	}
	return false;
}

static bool read_pin(struct reader *r, struct cell *cell)
{
	const struct token *token = &r->lex.token;

	cell->word = ELEM_PIN;
	r->keep_pins = is_own_box(r);
	reader_next(r);
	if (token->kind != TOKEN_NAME || token->space_before)
		return true;
	if (memchr(token->text, '.', token->len))
		return reader_fail_token(r, DIAG_EXTRA_TEXT);
	if (!reader_pin(r, &cell->operand))
		return false;
	reader_next(r);
	return true;
}

/* May the word be a pin of a function? */
static bool is_pin(const struct word_row *row, const struct token *token)
{
	return word_pin_find(row, token->text, token->len) >= 0 || ascii_same(token->text, "IN", 2) ||
	       ascii_is("OUT", token->text, token->len) || ascii_is("EN", token->text, token->len) ||
	       ascii_is("ENO", token->text, token->len);
}

static bool read_args(struct reader *r, struct cell *cell)
{
	const struct word_row *row = words_row(&r->project->words, cell->word);
	bool strange = false;

	buffer_clear(&r->text);
	r->arg_count = 0;
	r->keep_pins = word_is_own((enum word)cell->word);
	while (!reader_at_end(r) && !reader_is(r, '|') && !reader_is(r, '^')) {
		strange |= row->kind == WORD_FN && !r->keep_pins && !is_pin(row, &r->lex.token);
		if (!reader_arg(r))
			return false;
		reader_next(r);
	}
	if (strange && reader_mend(r, DIAG_EXTRA_TEXT)) /* EQ A := 5; others are judged in check/ */
		return false;
	cell->args = buffer_take(r, &r->text);
	return true;
}

/* Constants and addresses are judged in check/; here only for a line that can be mended. */
static bool has_bad_literal(const struct expr *expr)
{
	struct literal literal;
	struct iec_addr addr;

	for (int i = 0; i < expr->count; i++)
		if (expr->node[i].op == EXPR_LITERAL &&
		    !literal_is_named(expr->node[i].text, expr->node[i].len) &&
		    literal_parse(expr->node[i].text, expr->node[i].len, &literal) != LITERAL_OK)
			return true;
		else if (expr->node[i].op == EXPR_NAME && *expr->node[i].text == '%' &&
			 iec_addr_parse(expr->node[i].text, expr->node[i].len, &addr) == ADDR_NONE)
			return true;
	return false;
}

/* Reads an expression with a cursor of its own, so that an error has the right column. Returns
 * the word; WORD_COUNT: an error. */
static enum word check_expression(struct reader *r)
{
	struct diag place = r->place;
	struct lex lex = r->lex, ahead;

	lex.comments = false;
	for (ahead = lex; ahead.token.kind != TOKEN_END && !lex_is(&ahead, "]"); lex_next(&ahead))
		if (reader_special(r, &ahead.token))
			return WORD_COUNT;
	lex_next(&lex);
	place.line = lex.token.line;
	place.column = lex.token.column;
	place.id = DIAG_BAD_EXPRESSION;
	if (!expr_parse_cell(&lex, &r->expr, r->diags, place)) {
		reader_mend_last(r);
		return WORD_COUNT;
	}
	if ((has_bad_literal(&r->expr) || expr_has_wrong_call(&r->expr, &r->project->words)) &&
	    reader_mend(r, DIAG_BAD_LITERAL))
		return WORD_COUNT;
	if (lex_is(&lex, "]"))
		return r->expr.target ? ELEM_ASSIGN : ELEM_COMPARE;
	if (reader_mend(r, DIAG_BAD_EXPRESSION))
		return WORD_COUNT;
	place.column = lex.token.column;
	diag_add(r->diags, place, "%.*s",
		 lex.token.len > LIMIT_ARG ? LIMIT_ARG : (int)lex.token.len,
		 lex.token.text);
	return WORD_COUNT;
}

/* Kept as text, with single blanks. */
static bool read_expression(struct reader *r, struct cell *cell)
{
	const struct token *token = &r->lex.token;
	const enum word word = check_expression(r);
	size_t note = r->note.len;
	int depth = 0;

	if (word == WORD_COUNT)
		return false;
	cell->word = (uint16_t)word;
	buffer_clear(&r->text);
	reader_next(r);
	while (!reader_is(r, ']') || depth > 0) {
		depth += reader_is(r, '[') - reader_is(r, ']');
		if (r->text.len > 0 &&
		    (token->space_before || note != r->note.len))
			buffer_add(r, &r->text, " ", 1);
		note = r->note.len;
		buffer_add(r, &r->text, token->text, token->len);
		reader_next(r);
	}
	cell->operand = buffer_take(r, &r->text);
	reader_next(r);
	return true;
}

/* The element that does with an operand what @row does with its inverse: NC of NO, N of P,
 * COILNOT of COIL; "": none. */
static const char *inverse_of(const struct word_row *row)
{
	const bool contact = row->operand == OPND_BOOL_R;

	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *other = word_row((enum word)i);

		if (other->operand == row->operand && other->place == row->place &&
		    other->first == row->first && other != row &&
		    (row->edge == EDGE_NONE ? other->edge == EDGE_NONE :
		     contact && other->edge != EDGE_NONE))
			return other->word;
	}
	return "";
}

/* `P NOT Door`, `NC /Door`, `NO !Door`. */
static bool refuse_negated(struct reader *r, const struct word_row *row)
{
	const char *mate = inverse_of(row), *name;
	char text[LIMIT_ARG + 1];
	int len = 0;

	reader_next(r);
	name = r->lex.token.text;
	while (len < 24 && name + len < r->lex.end && !strchr(" |^\r\n", name[len]))
		len++;
	snprintf(text, sizeof(text), "NOT %.*s" DIAG_AND "%s%s%.*s", len, name, mate,
		 *mate ? " " : "", *mate ? len : 0, name);
	return reader_fail_word(r, DIAG_NEGATED, text);
}

/* `TON PT:=T#3s`. */
static bool refuse_nameless(struct reader *r, const struct token *word)
{
	const int len = word->len < LIMIT_ARG / 2 - 8 ? (int)word->len : LIMIT_ARG / 2 - 8;
	char text[LIMIT_ARG + 1];

	snprintf(text, sizeof(text), "%.*s" DIAG_AND "%.*s Delay", len, word->text, len, word->text);
	return reader_fail_word(r, DIAG_MISSING_INSTANCE, text);
}

/* The operand or instance after a word. Without this a box that lacks its instance would take
 * its first parameter for one. */
static bool read_operand(struct reader *r, struct cell *cell,
			 const struct word_row *row, const struct token *word)
{
	const struct token *token = &r->lex.token;
	bool plain = row->kind == WORD_FB || row->operand == OPND_LABEL ||
		     row->operand == OPND_ROUTINE;

	if ((row->operand == OPND_BOOL_R || row->operand == OPND_BOOL_W) &&
	    (lex_is(&r->lex, "NOT") || reader_is(r, '/') || reader_is(r, '!')))
		return refuse_negated(r, row);
	if ((token->kind != TOKEN_NAME && token->kind != TOKEN_ADDRESS) ||
	    (row->kind == WORD_FB &&
	     (reader_peek(r, ":=") || reader_peek(r, "=>"))))
		return row->kind == WORD_FB ? refuse_nameless(r, word) : reader_fail_operand(r, word);
	if (plain && !(row->kind == WORD_FB ?
		       reader_instance(r, &cell->operand) :
		       reader_name(r, "name", &cell->operand)))
		return false;
	if (!plain) {
		buffer_clear(&r->text);
		if (!reader_value(r, false, word))
			return false;
		cell->operand = buffer_take(r, &r->text);
	}
	reader_next(r);
	return true;
}

/* FOR I := 1 TO 10: kept as text, with single blanks. */
static bool read_loop(struct reader *r, struct cell *cell)
{
	const struct token *token = &r->lex.token;
	const struct token first = *token;
	struct loop loop;

	bool glued = true;

	buffer_clear(&r->text);
	while (!reader_at_end(r) && !reader_is(r, '|') && !reader_is(r, '^')) {
		if (!glued && !reader_is(r, '[') && !reader_is(r, ']') &&
		    !reader_is(r, '.'))
			buffer_add(r, &r->text, " ", 1);
		glued = reader_is(r, '-') || reader_is(r, '+') || reader_is(r, '[') || reader_is(r, '.');
		buffer_add(r, &r->text, token->text, token->len);
		reader_next(r);
	}
	if (!r->no_memory && !loop_parse(r->text.text, r->text.len, &loop))
		return reader_fail(r, DIAG_LOOP_FORM, first.text, first.len);
	cell->operand = buffer_take(r, &r->text);
	return true;
}

/* NOT alone inverts the power; with parameters it is the function NOT. */
static enum word with_parameters(struct reader *r, enum word word)
{
	const enum word function = op_function(word_row(word)->next);
	struct lex ahead = r->lex;

	if (word_row(word)->operand != OPND_NONE || function == WORD_COUNT ||
	    strcmp(word_row(word)->word, word_row(function)->word) != 0)
		return word;
	ahead.comments = false;
	if (lex_next(&ahead) != TOKEN_NAME)
		return word;
	lex_next(&ahead);
	return lex_is(&ahead, ":=") || lex_is(&ahead, "=>") ? function : word;
}

/* The name behind EXECUTE, which may be left out. */
static bool read_box_name(struct reader *r, uint32_t *name)
{
	if (r->lex.token.kind != TOKEN_NAME)
		return true;
	if (!reader_name(r, "name of the box", name))
		return false;
	reader_next(r);
	return true;
}

/* Does a BOOL of this program follow? */
static bool bit_follows(const struct reader *r)
{
	const struct var_table *tables[] = { r->pou ? &r->pou->vars : &r->project->globals, &r->project->globals };
	struct lex lex = r->lex;
	bool is = false;
	uint32_t fold;

	lex_next(&lex);
	fold = names_find_any(&r->project->names, lex.token.text, lex.token.len);
	for (size_t i = 0; i < 2 && fold && !is; i++) {
		const int index = vars_find(tables[i], fold);

		is = index >= 0 && tables[i]->var[index].type == IEC_BOOL;
	}
	return is;
}

static bool read_word(struct reader *r, struct cell *cell)
{
	const struct token token = r->lex.token;
	const enum word word = with_parameters(r,
		words_find(&r->project->words, token.text, token.len));

	const struct word_row *row = words_row(&r->project->words, word);

	if (word == WORD_COUNT && (ascii_is("RES", token.text, token.len) || ascii_is("RST", token.text, token.len)) &&
	    !bit_follows(r))
		return reader_fail_token(r, DIAG_BLOCK_RESET);
	if (word == WORD_COUNT || row->kind == WORD_STRUCT)
		return reader_fail_token(r, DIAG_UNKNOWN_WORD);

	cell->word = (uint16_t)word;
	reader_next(r);
	if (row->kind == WORD_FN)
		return read_args(r, cell);
	if (row->kind == WORD_ELEM && (row->operand == OPND_NONE ||
				       row->operand == OPND_LOOP_END))
		return true;
	if (row->operand == OPND_LOOP)
		return read_loop(r, cell);
	if (row->operand == OPND_EXECUTE)
		return read_box_name(r, &cell->operand);
	if (!read_operand(r, cell, row, &token))
		return false;
	return row->kind != WORD_FB || read_args(r, cell);
}

static bool read_element(struct reader *r, struct cell *cell)
{
	if (reader_at_end(r) || reader_is(r, '|') || reader_is(r, '^'))
		return true;
	if (r->lex.token.kind == TOKEN_NAME)
		return read_word(r, cell);
	if (reader_is(r, '-'))
		return read_wire(r, cell);
	if (reader_is(r, '.'))
		return read_pin(r, cell);
	if (reader_is(r, '['))
		return read_expression(r, cell);
	return reader_fail_token(r, DIAG_UNKNOWN_WORD);
}

/* ---- rows ---- */

static void skip_cell(struct reader *r)
{
	while (!reader_at_end(r) && !reader_is(r, '|'))
		reader_next(r);
}

static bool read_link(struct reader *r, struct cell *cell)
{
	if (!reader_is(r, '^'))
		return true;
	if (r->place.row == 1)
		return reader_fail_word(r, DIAG_LINK_ABOVE, "");
	reader_next(r);
	if (!reader_is(r, '|'))
		return reader_fail_word(r, DIAG_EXTRA_TEXT, "^");
	cell->link = 1;
	return true;
}

/* Up to its closing bar, or to the end of the line if there is none. */
static void read_cell(struct reader *r, struct cell *cell)
{
	if (!read_element(r, cell) || !read_link(r, cell)) {
		skip_cell(r);
		return;
	}
	if (reader_is(r, '|'))
		return;
	if (!reader_at_end(r)) {
		reader_fail_token(r, DIAG_EXTRA_TEXT);
		skip_cell(r);
	} else if (cell->word != ELEM_EMPTY) {
		reader_fail_word(r, DIAG_BAD_ROW, "");
	}
}

static void push_cell(struct reader *r, const struct cell *cell)
{
	if (r->cell_count == r->cell_size) {
		int size = r->cell_size ? 2 * r->cell_size : 64;
		struct cell *grown = realloc(r->cell,
					     (size_t)size * sizeof(*grown));
		if (!grown) {
			r->no_memory = true;
			return;
		}
		r->cell = grown;
		r->cell_size = size;
	}
	r->cell[r->cell_count++] = *cell;
}

/* Reads a row; the cursor stands after the first bar. */
static void read_cells(struct reader *r)
{
	for (int col = 0; ; col++) {
		struct cell cell = { 0 };

		if (reader_at_end(r))
			return;
		if (col == LIMIT_COLS) {
			reader_fail_word(r, DIAG_TOO_MANY_COLS, "");
			reader_skip_line(r);
			return;
		}
		r->place.col = col + 1;
		read_cell(r, &cell);
		if (reader_at_end(r))
			return;
		cell.comment = buffer_take_cell(r, &r->note);
		push_cell(r, &cell);
		reader_next(r);
	}
}

static void read_row(struct reader *r)
{
	const int first = r->cell_count, errors = r->diags->errors;

	r->comments = COMMENT_CELL;
	r->place.row = r->rows + 1;
	r->place.col = 0;
	reader_next(r);
	read_cells(r);
	r->place.col = 0;
	if (r->cell_count == first && r->diags->errors == errors)
		reader_fail_word(r, DIAG_BAD_ROW, "");
	/* A comment after the last bar belongs to the last cell. */
	if (r->note.len > 0 && r->cell_count > first) {
		struct cell *last = &r->cell[r->cell_count - 1];
		uint32_t id = buffer_take_cell(r, &r->note);
		const char *text = names_text(&r->project->names, id);

		buffer_add(r, &r->note, text, strlen(text));
		last->comment = comment_join(r, last->comment, &r->note, COMMENT_CELL);
	}
	buffer_clear(&r->note);
	r->comments = COMMENT_ABOVE;
	r->row_cols[r->rows++] = (uint8_t)(r->cell_count - first);
}

/* ---- rungs ---- */

static void read_head(struct reader *r, struct rung *head)
{
	head->line = (uint32_t)r->lex.token.line;
	reader_next(r);
	if (lex_is(&r->lex, "OFF")) {
		head->off = 1;
		reader_next(r);
	}
	if (r->lex.token.kind == TOKEN_NAME) {
		if (!reader_name(r, "label", &head->label)) {
			reader_skip_line(r);
			return;
		}
		reader_next(r);
	}
	if (r->lex.token.kind == TOKEN_STRING &&
	    reader_string(r, &head->title))
		reader_next(r);
	reader_end_line(r);
}

/* Comments between rows move above the rung, in order. */
static void keep_above(struct reader *r)
{
	if (r->above.len == 0)
		return;
	if (r->rung_note.len > 0)
		buffer_add(r, &r->rung_note, "\n", 1);
	buffer_add(r, &r->rung_note, r->above.text, r->above.len);
	buffer_clear(&r->above);
}

static struct rung *make_rung(struct reader *r, const struct rung *head)
{
	const struct cell *from = r->cell;
	int rows = r->rows ? r->rows : 1, cols = 1;

	for (int i = 0; i < r->rows; i++)
		if (r->row_cols[i] > cols)
			cols = r->row_cols[i];
	struct rung *rung = r->no_memory ? NULL : rung_new(rows, cols);

	if (!rung) {
		r->no_memory = true;
		return NULL;
	}
	rung->label = head->label;
	rung->title = head->title;
	rung->line = head->line;
	rung->off = head->off;
	rung->gaps = head->gaps;
	rung->comment = buffer_take(r, &r->rung_note);
	for (int i = 0; i < r->rows; i++) {
		if (r->row_cols[i] == 0)
			continue;
		memcpy(rung_cell(rung, i, 0), from,
		       r->row_cols[i] * sizeof(*from));
		from += r->row_cols[i];
	}
	return rung;
}

/* ---- the statements of EXECUTE boxes ---- */

/* EXECUTE Name: … END_EXECUTE below the rows. */
static void read_boxed(struct reader *r, struct pou *pou)
{
	const struct token head = r->lex.token;
	const int first = pou->st ? pou->st->count : 0, rung = r->place.rung;
	struct boxed boxed = { .rung = -1, .row = -1, .first = first, .line = head.line }, *slot;

	r->place.rung = r->place.row = r->place.col = 0;
	reader_next(r);
	if (!read_box_name(r, &boxed.name) || (!reader_is(r, ':') && !reader_fail_word(r, DIAG_EXPECTED, ":")))
		reader_skip_line(r);
	r->boxed = true;
	read_st_behind(r, pou);
	r->boxed = false;
	boxed.count = pou->st ? pou->st->count - first : 0;
	boxed.text = boxed.count ? text_statements(r->project, pou->st->item + first, boxed.count) : 0;
	if (lex_is(&r->lex, "END_EXECUTE")) {
		reader_next(r);
		reader_end_line(r);
	} else if (r->lex.token.kind == TOKEN_END) {
		reader_fail_open(r, &head);
	} else {
		reader_fail_word(r, DIAG_MISSING_ABOVE, "END_EXECUTE");
	}
	r->place.rung = rung;
	slot = arena_push(&r->project->arena, &pou->boxed, &pou->boxed_count, sizeof(*slot));
	if (slot)
		*slot = boxed;
	else
		r->no_memory = true;
}

/* "EXECUTE Name", or EXECUTE alone. */
static void said_box(struct reader *r, enum diag_id id, uint32_t name, int line)
{
	char text[LIMIT_ARG];
	struct diag place = r->place;

	snprintf(text, sizeof(text), "EXECUTE%s%.40s", name ? " " : "",
		 names_text(&r->project->names, name));
	place.id = id;
	place.line = line;
	diag_add(r->diags, place, "%s", text);
}

/* The first statements from @first on that have this name and no box yet; NULL: none. */
static struct boxed *boxed_for(struct reader *r, struct pou *pou, int first, uint32_t name)
{
	struct names *names = &r->project->names;

	for (int i = first; i < pou->boxed_count; i++)
		if (pou->boxed[i].row < 0 &&
		    names_fold(names, pou->boxed[i].name) == names_fold(names, name))
			return &pou->boxed[i];
	return NULL;
}

/* In the order of the cells. */
static void order_boxed(struct pou *pou, int first)
{
	for (int i = first + 1; i < pou->boxed_count; i++) {
		const struct boxed moved = pou->boxed[i];
		int at = i;

		for (; at > first && (pou->boxed[at - 1].row > moved.row ||
				      (pou->boxed[at - 1].row == moved.row &&
				       pou->boxed[at - 1].col > moved.col)); at--)
			pou->boxed[at] = pou->boxed[at - 1];
		pou->boxed[at] = moved;
	}
}

/* Boxes get the statements with their name; those of one name in their order. */
static void pair_boxes(struct reader *r, struct pou *pou, int first, struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		struct cell *cell = &rung->cell[i];
		struct boxed *boxed;

		if (cell->word != ELEM_EXECUTE)
			continue;
		boxed = boxed_for(r, pou, first, cell->operand);
		if (boxed) {
			boxed->row = i / rung->cols;
			boxed->col = i % rung->cols;
			cell->args = boxed->text;
			continue;
		}
		r->place.row = i / rung->cols + 1;
		r->place.col = i % rung->cols + 1;
		said_box(r, DIAG_BOX_EMPTY, cell->operand, rung_line(rung, r->place.row));
		r->place.row = r->place.col = 0;
	}
	for (int i = first; i < pou->boxed_count; i++)
		if (pou->boxed[i].row < 0)
			said_box(r, DIAG_NO_BOX, pou->boxed[i].name, pou->boxed[i].line);
	order_boxed(pou, first);
}

struct rung *read_rung(struct reader *r, struct pou *pou)
{
	const int boxed = pou->boxed_count;
	struct rung head = { 0 }, *rung;

	r->rows = 0;
	r->cell_count = 0;
	buffer_clear(&r->rung_note);
	read_head(r, &head);
	keep_above(r);
	bool over = false;

	for (;;) {
		reader_skip_newlines(r);
		if (lex_is(&r->lex, "EXECUTE")) {
			read_boxed(r, pou);
			continue;
		}
		if (!reader_is(r, '|'))
			break;
		keep_above(r);
		if ((uint32_t)r->lex.token.line !=
		    head.line + (uint32_t)r->rows + 1)
			head.gaps = 1;
		if (r->rows < LIMIT_ROWS) {
			read_row(r);
			continue;
		}
		r->place.row = r->place.col = 0;
		if (!over)
			reader_fail_word(r, DIAG_TOO_MANY_ROWS, "");
		over = true;
		reader_skip_line(r);
	}
	r->place.row = r->place.col = 0;
	rung = make_rung(r, &head);
	if (rung)
		pair_boxes(r, pou, boxed, rung);
	else
		pou->boxed_count = boxed;
	return rung;
}

static size_t rung_cells(const struct rung *rung)
{
	return (size_t)rung->rows * rung->cols;
}

void reader_add_rung(struct reader *r, struct pou *pou)
{
	bool full = pou->rung_count == LIMIT_RUNGS ||
		    r->all_cells > LIMIT_TEXT / 4;

	if (full && r->place.rung <= pou->rung_count + 1)
		reader_fail_many(r, DIAG_TOO_MANY, "rungs", LIMIT_RUNGS);
	const int boxed = pou->boxed_count;
	struct rung *rung = read_rung(r, pou);

	if (!rung)
		return;
	r->all_cells += full ? 0 : rung_cells(rung);
	if (!full && project_add_rung(pou, pou->rung_count, rung)) {
		for (int i = boxed; i < pou->boxed_count; i++)
			pou->boxed[i].rung = pou->rung_count - 1;
		return;
	}
	pou->boxed_count = boxed;
	r->no_memory |= !full;
	rung_free(rung);
}
