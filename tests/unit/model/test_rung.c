/* SPDX-License-Identifier: MIT
 *
 * test_rung - every edit of a grid, drawn: connections stay, and a failed edit changes
 * nothing.
 */
#include "engine/model/rung.h"
#include "tests/tap.h"

/* A drawing has two characters a cell: element and link (^ or blank). Elements:
 * - wire, . empty, p pin row, o box of several rows, other letters contacts whose
 * operand is the letter. Rows end with a slash. */
static struct cell cell_of(const char *at)
{
	struct cell cell = { .link = at[1] == '^' };

	if (at[0] == '-')
		cell.word = ELEM_WIRE;
	else if (at[0] == 'p')
		cell.word = ELEM_PIN;
	else if (at[0] == 'o')
		cell.word = FB_CTU;
	else if (at[0] != '.')
		cell.word = ELEM_CONTACT_NO;
	if (cell.word == ELEM_CONTACT_NO || cell.word == FB_CTU)
		cell.operand = (uint32_t)at[0];
	return cell;
}

static struct rung *draw(const char *drawing)
{
	int cols = (int)(strchr(drawing, '/') - drawing) / 2, rows = 0;
	struct rung *rung;

	for (const char *at = drawing; *at; at++)
		rows += *at == '/';
	rung = rung_new(rows, cols);
	for (int row = 0; rung && row < rows; row++)
		for (int col = 0; col < cols; col++)
			*rung_cell(rung, row, col) =
				cell_of(drawing + row * (2 * cols + 1) +
					2 * col);
	return rung;
}

/* The drawing of @rung, which is freed. */
static const char *drawn(struct rung *rung)
{
	static char out[4000];
	char *at = out;

	if (!rung)
		return "NULL";
	for (int row = 0; row < rung->rows; row++) {
		for (int col = 0; col < rung->cols; col++) {
			const struct cell *cell = rung_at(rung, row, col);

			*at++ = cell->word == ELEM_EMPTY ? '.' :
				cell->word == ELEM_WIRE ? '-' :
				cell->word == ELEM_PIN ? 'p' :
				(char)cell->operand;
			*at++ = cell->link ? '^' : ' ';
		}
		*at++ = '/';
	}
	*at = '\0';
	rung_free(rung);
	return out;
}

static const char *after(struct rung *(*change)(const struct rung *, int),
			 const char *drawing, int at)
{
	struct rung *rung = draw(drawing), *before = rung_copy(rung);
	struct rung *made = change(rung, at);
	static int untouched = 1;

	untouched &= rung_equal(rung, before);
	rung_free(rung);
	rung_free(before);
	return untouched ? drawn(made) : "the function changed the rung that it was given";
}

static void memory(void)
{
	struct rung *rung = rung_new(2, 3), *copy;

	CHECK(rung_new(0, 1) == NULL);
	CHECK(rung_new(1, 0) == NULL);
	CHECK(rung_new(-1, 5) == NULL);
	CHECK(rung_new(LIMIT_ROWS + 1, 1) == NULL);
	CHECK(rung_new(1, LIMIT_COLS + 1) == NULL);
	CHECK(rung_size(rung) == sizeof(*rung) + 6 * sizeof(struct cell));
	CHECK(rung_at(rung, 1, 2)->word == ELEM_EMPTY);
	CHECK(rung_cell(rung, 1, 2) == &rung->cell[5]);
	rung->label = 3;
	rung->off = 1;
	copy = rung_copy(rung);
	CHECK(rung_equal(rung, copy));
	copy->line = 77;
	CHECK_AS(rung_equal(rung, copy), "rungs with different lines are equal");
	copy->label = 4;
	CHECK(!rung_equal(rung, copy));
	copy->label = 3;
	copy->off = 0;
	CHECK(!rung_equal(rung, copy));
	copy->off = 1;
	copy->title = 1;
	CHECK(!rung_equal(rung, copy));
	copy->title = 0;
	copy->comment = 1;
	CHECK(!rung_equal(rung, copy));
	copy->comment = 0;
	rung_cell(copy, 1, 2)->args = 5;
	CHECK(!rung_equal(rung, copy));
	rung_free(copy);
	copy = rung_resize(rung, 3, 2);
	CHECK(!rung_equal(rung, copy));
	CHECK_AS(copy->label == 3 && copy->off == 1, "rung_resize() keeps label and off");
	rung_free(copy);
	rung_free(rung);
	rung_free(NULL);
}

static void insert_row(void)
{
	CHECK_TEXT(after(rung_insert_row, "a b /", 0), ". . /a b /");
	CHECK_TEXT(after(rung_insert_row, "a b /", 1), "a b /. . /");
	CHECK_TEXT(after(rung_insert_row, "a b /c^. /", 1),
		   "a b /.^. /c^. /");
	CHECK_TEXT(after(rung_insert_row, "a b /c^. /", 2),
		   "a b /c^. /. . /");
	CHECK_TEXT(after(rung_insert_row, "a o b /c p . /d p . /", 2),
		   "a o b /c p . /. p . /d p . /");
	CHECK_TEXT(after(rung_insert_row, "a b /", 2), "NULL");
	CHECK_TEXT(after(rung_insert_row, "a b /", -1), "NULL");
}

static void delete_row(void)
{
	CHECK_TEXT(after(rung_delete_row, "a /b /", 0), "b /");
	CHECK_TEXT(after(rung_delete_row, "a /b /", 1), "a /");
	CHECK_TEXT(after(rung_delete_row, "a /b^/c^/", 1), "a /c^/");
	CHECK_TEXT(after(rung_delete_row, "a /b /c^/", 1), "a /c /");
	CHECK_TEXT(after(rung_delete_row, "a /b^/c^/", 0), "b /c^/");
	CHECK_TEXT(after(rung_delete_row, "a o b /c p^. /d p . /", 0),
		   "c . . /d . . /");
	CHECK_TEXT(after(rung_delete_row, "a o b /c p . /d p . /", 1),
		   "a o b /d p . /");
	CHECK_TEXT(after(rung_delete_row, "a /", 0), "NULL");
	CHECK_TEXT(after(rung_delete_row, "a /b /", 2), "NULL");
	CHECK_TEXT(after(rung_delete_row, "a /b /", -1), "NULL");
}

static void columns(void)
{
	CHECK_TEXT(after(rung_insert_column, "a b /", 0), "- a b /");
	CHECK_TEXT(after(rung_insert_column, "a b /", 1), "a - b /");
	CHECK_TEXT(after(rung_insert_column, "a b /", 2), "a b . /");
	CHECK_TEXT(after(rung_insert_column, "a b /c^. /", 1),
		   "a - b /c^. . /");
	CHECK_TEXT(after(rung_insert_column, ". b /c . /", 1),
		   ". . b /c . . /");
	CHECK_TEXT(after(rung_insert_column, "a b /.^c /", 1),
		   "a - b /.^- c /");
	CHECK_TEXT(after(rung_insert_column, "a b /. c /.^d /", 1),
		   "a - b /. - c /.^- d /");
	CHECK_TEXT(after(rung_insert_column, "o /p /", 0), "- o /. p /");
	CHECK_TEXT(after(rung_insert_column, "a /", 2), "NULL");
	CHECK_TEXT(after(rung_insert_column, "a /", -1), "NULL");
	CHECK_TEXT(after(rung_delete_column, "a b c /", 1), "a c /");
	CHECK_TEXT(after(rung_delete_column, "a b c /d -^. /", 1),
		   "a c /d^. /");
	CHECK_TEXT(after(rung_delete_column, "a b /c^. /", 0), "b /. /");
	CHECK_TEXT(after(rung_delete_column, "a b /c^d^/", 1), "a /c^/");
	CHECK_TEXT(after(rung_delete_column, "a /", 0), "NULL");
	CHECK_TEXT(after(rung_delete_column, "a b /", 2), "NULL");
	CHECK_TEXT(after(rung_delete_column, "a b /", -1), "NULL");
}

static void sizes(void)
{
	struct rung *rung = draw("a . . /. . . /");

	CHECK_TEXT(drawn(rung_trim(rung)), "a /");
	CHECK_TEXT(drawn(rung_resize(rung, 1, 2)), "a . /");
	CHECK_TEXT(drawn(rung_resize(rung, 3, 1)), "a /. /. /");
	CHECK_TEXT(drawn(rung_resize(rung, 0, 1)), "NULL");
	CHECK_TEXT(drawn(rung_resize(rung, 1, LIMIT_COLS + 1)), "NULL");
	rung_free(rung);
	rung = draw(". . . /. .^. /");
	CHECK_TEXT(drawn(rung_trim(rung)), ". . /. .^/");
	rung_free(rung);
	rung = draw(". . . /. . . /");
	CHECK_TEXT(drawn(rung_trim(rung)), ". /");
	rung_cell(rung, 0, 2)->comment = 9;
	CHECK_TEXT(drawn(rung_trim(rung)), ". . . /");
	rung_free(rung);
}

static void single_cells(void)
{
	struct rung *rung = draw("a b /c^d /");
	struct cell cell = { .word = ELEM_COIL, .link = 1, .operand = 'z' };

	CHECK(rung_set_cell(rung, 1, 1, cell));
	CHECK(rung_at(rung, 1, 1)->word == ELEM_COIL);
	CHECK(rung_at(rung, 1, 1)->link == 1);
	CHECK(!rung_set_cell(rung, 2, 0, cell));
	CHECK(!rung_set_cell(rung, 0, 2, cell));
	CHECK(!rung_set_cell(rung, -1, 0, cell));
	CHECK(!rung_set_cell(rung, 0, -1, cell));
	CHECK(rung_clear_cell(rung, 1, 0));
	CHECK(rung_at(rung, 1, 0)->word == ELEM_EMPTY);
	CHECK(rung_at(rung, 1, 0)->operand == 0);
	CHECK_AS(rung_at(rung, 1, 0)->link == 1, "a cleared cell keeps its link");
	CHECK(!rung_clear_cell(rung, 2, 0));
	CHECK_TEXT(drawn(rung), "a b /.^z^/");
}

static void height(void)
{
	struct rung *rung = draw("o a /p p /p . /. . /");

	CHECK(rung_height(rung, 0, 0) == 3);
	CHECK_AS(rung_height(rung, 0, 1) == 1, "the height of a contact is 1");
	CHECK(rung_height(rung, 1, 0) == 1);
	CHECK(rung_height(rung, 3, 1) == 1);
	CHECK(rung_height(rung, 4, 0) == 1);
	CHECK(rung_height(rung, 0, -1) == 1);
	rung_cell(rung, 0, 1)->word = ELEM_COMPARE;
	CHECK(rung_height(rung, 0, 1) == 2);
	rung_free(rung);
}

static void largest(void)
{
	struct rung *rung = rung_new(LIMIT_ROWS, LIMIT_COLS), *made;

	CHECK(rung_insert_row(rung, 0) == NULL);
	CHECK(rung_insert_column(rung, 0) == NULL);
	for (int row = 0; row < LIMIT_ROWS; row++)
		*rung_cell(rung, row, 0) = (struct cell){ .word = ELEM_PIN };
	rung_cell(rung, 0, 0)->word = FN_ADD;
	CHECK(rung_height(rung, 0, 0) == LIMIT_ROWS);
	made = rung_delete_row(rung, 0);
	CHECK(made && made->rows == LIMIT_ROWS - 1);
	CHECK(made && rung_at(made, LIMIT_ROWS - 2, 0)->word ==
	      ELEM_EMPTY);
	rung_free(made);
	CHECK(rung_clear_cell(rung, 0, 0));
	made = rung_trim(rung);
	CHECK(made && made->rows == 1 && made->cols == 1);
	rung_free(made);
	rung_free(rung);
}

int main(void)
{
	memory();
	insert_row();
	delete_row();
	columns();
	sizes();
	single_cells();
	height();
	largest();
	return tap_done();
}
