/* SPDX-License-Identifier: MIT
 *
 * classic_grid - finds the elements of a rung, and which of them power can reach.
 *
 * An element without a meaning here is reported and does not conduct, as in ClassicLadder.
 */
#include "engine/exchange/classic/classic_grid.h"
#include "engine/exchange/classic/classic_say.h"

#include <stdio.h>
#include <string.h>

/* ---- elements ---- */

static const struct part_box box_timer = { { "E", "C" }, { "D", "R" }, 2, 2 };
static const struct part_box box_mono = { { "IN" }, { "R" }, 2, 2 };
static const struct part_box box_counter = {
	{ "RESET", "LOAD", "UP", "DOWN" }, { "E", "D", "F" }, 4, 2
};
static const struct part_box box_iec = { { "IN" }, { "Q" }, 2, 2 };
static const struct part_box box_register = {
	{ "RESET", "PUSH", "POP" }, { "E", "F" }, 3, 2
};

struct element_row {
	int code;
	enum part_kind kind;
	const char *word;          /* in front of an operand                   */
	const struct part_box *box;
	enum classic_kind block;
	int columns;
};

enum { WIRE = 9, COMPARE = 20, OPERATE = 60, JUMP = 54, CALL = 55, OCCUPIED = 99 };

static const struct element_row rows[] = {
	{ 1, PART_CONTACT, "NO", NULL, CLASSIC_KINDS, 1 },
	{ 2, PART_CONTACT, "NC", NULL, CLASSIC_KINDS, 1 },
	{ 3, PART_CONTACT, "P", NULL, CLASSIC_KINDS, 1 },
	{ 4, PART_CONTACT, "N", NULL, CLASSIC_KINDS, 1 },
	{ 9, PART_WIRE, "---", NULL, CLASSIC_KINDS, 1 },
	{ 10, PART_BOX, NULL, &box_timer, CLASSIC_TIMER, 2 },
	{ 11, PART_BOX, NULL, &box_mono, CLASSIC_MONOSTABLE, 2 },
	{ 12, PART_BOX, NULL, &box_counter, CLASSIC_COUNTER, 2 },
	{ 13, PART_BOX, NULL, &box_iec, CLASSIC_IEC_TIMER, 2 },
	{ 14, PART_BOX, NULL, &box_register, CLASSIC_REGISTER, 2 },
	{ COMPARE, PART_CONTACT, NULL, NULL, CLASSIC_KINDS, 3 },
	{ 50, PART_COIL, "COIL", NULL, CLASSIC_KINDS, 1 },
	{ 51, PART_COIL, "COILNOT", NULL, CLASSIC_KINDS, 1 },
	{ 52, PART_ACT, "S", NULL, CLASSIC_KINDS, 1 },
	{ 53, PART_ACT, "R", NULL, CLASSIC_KINDS, 1 },
	{ JUMP, PART_ACT, NULL, NULL, CLASSIC_KINDS, 1 },
	{ CALL, PART_ACT, NULL, NULL, CLASSIC_KINDS, 1 },
	{ OPERATE, PART_ACT, NULL, NULL, CLASSIC_KINDS, 3 },
};

static const struct element_row *row_of(int code)
{
	for (size_t i = 0; i < sizeof(rows) / sizeof(*rows); i++)
		if (rows[i].code == code)
			return &rows[i];
	return NULL;
}

/* ---- texts of elements; NULL: the element is left out ---- */

static const char *block_text(struct grid *grid, struct grid_part *part,
			      const struct classic_cell *cell, enum classic_kind kind)
{
	static const char *const word[CLASSIC_KINDS] = {
		"CL_TIMER", "CL_MONO", NULL, "CL_COUNTER", "CL_REGISTER"
	};
	const struct classic_block *block =
		classic_block(&grid->c->project->iec_timer, cell->variable.number);
	const char *name = word[kind] ? word[kind] : iec_word(block);
	bool timed = kind != CLASSIC_COUNTER && kind != CLASSIC_REGISTER;

	part->instance = instance_of(grid->c, kind, cell->variable.number);
	part->shared = block_cells(grid->c, kind, cell->variable.number) > 1;
	if (!part->instance)
		return NULL;
	return text_of(grid->c, "%s %s%s", name, part->instance,
		       timed ? " DT:=SYS_CYCLE" : "");
}

bool grid_called_again(const struct grid *grid, const struct grid_part *part)
{
	for (const struct grid_part *other = part + 1; other < grid->part + grid->parts; other++)
		if (other->kind == PART_BOX && !strcmp(other->instance, part->instance))
			return true;
	return false;
}

const char *grid_box_text(const struct grid *grid, const struct grid_part *part)
{
	const char *text = part->text;

	for (int i = 1; i < part->rows && part->shared; i++)
		if (part->box->input[i] && !grid->fed[part->y + i][part->x])
			text = text_of(grid->c, "%s %s:=FALSE", text, part->box->input[i]);
	return text;
}

/* A jump to a rung that the section does not have ends the section. */
static const char *jump_text(struct grid *grid, int number)
{
	struct conversion *c = grid->c;

	const char *label = label_of(c, number);

	if (label)
		return text_of(c, "JMP %s", label);
	tell(c, REPORT_TAKEN, "a jump to rung %d, which this section does not have, ends the "
	     "section, as in ClassicLadder", number);
	return "RET";
}

static const char *call_text(struct grid *grid, int number)
{
	struct conversion *c = grid->c;

	for (int i = 0; i < c->project->sections; i++)
		if (c->project->section[i].subroutine == number &&
		    !c->project->section[i].sequential)
			return text_of(c, "CALL %s", c->pou[i]);
	tell(c, REPORT_LOST, "a call of subroutine %d, which does not exist", number);
	return NULL;
}

static const char *expression_text(struct grid *grid, struct grid_part *part,
				   const struct classic_cell *cell)
{
	struct conversion *c = grid->c;
	const char *text = classic_expression(c->project, cell->variable.number);

	part->expression = cell->variable.number;
	if (!text || !*text || !strcmp(text, "#")) {
		tell(c, REPORT_LOST, "expression %d is empty", cell->variable.number);
		return NULL;
	}
	text = cell->element == COMPARE ? comparison_of(c, text) : assignment_of(c, text);
	return text ? text_of(c, "[ %s ]", text) : NULL;
}

static const char *operand_text(struct grid *grid, struct grid_part *part,
				const struct classic_cell *cell, const char *word)
{
	bool is_bool;
	const char *text = part->kind == PART_CONTACT ?
			   operand_of(grid->c, cell->variable, &is_bool) :
			   target_of(grid->c, cell->variable, &is_bool);

	part->reads = cell->variable;
	if (text && !is_bool) {
		tell(grid->c, REPORT_LOST, "\"%s\" is not a bit", text);
		return NULL;
	}
	return text ? text_of(grid->c, "%s %s", word, text) : NULL;
}

static const char *text_of_part(struct grid *grid, struct grid_part *part,
				const struct classic_cell *cell,
				const struct element_row *row)
{
	if (row->kind == PART_WIRE)
		return row->word;
	if (row->box)
		return block_text(grid, part, cell, row->block);
	if (cell->element == JUMP)
		return jump_text(grid, cell->variable.number);
	if (cell->element == CALL)
		return call_text(grid, cell->variable.number);
	if (!row->word)
		return expression_text(grid, part, cell);
	return operand_text(grid, part, cell, row->word);
}

/* ---- places of elements ---- */

/* All cells of an element but that with its code are marked as occupied. An element at the
 * edge of the grid has fewer of them. In a file that no editor wrote, other elements can
 * stand in their place: then this one is odd. */
static void settle(struct grid *grid, struct grid_part *part, int alive)
{
	if (part->x < 0) {
		part->columns += part->x;
		part->x = 0;
		part->odd = true;
	}
	for (int i = 0; i < part->rows; i++)
		for (int x = part->x; x < part_end(part); x++) {
			int y = part->y + i;
			bool own = (x == alive && !i) ||
				   (y < CLASSIC_ROWS &&
				    grid->rung->cell[y][x].element == OCCUPIED);

			part->odd |= !own;
			if (part->box && x == alive)
				part->gives[i] = own && part->box->output[i];
		}
	if (part->y + part->rows > CLASSIC_ROWS)
		part->rows = CLASSIC_ROWS - part->y;
}

/* Old files have cells with codes of tools of the editor. One line for all of a code. */
static void report_unknown(struct grid *grid, int element)
{
	const struct classic_rung *rung = grid->rung;
	int count = 0;

	for (int i = 0; i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		count += rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].element == element;
	if (!grid->unknown[element])
		tell(grid->c, REPORT_LOST, count > 1 ?
		     REPORTED("element %d, in %d cells, does not conduct") :
		     REPORTED("element %d does not conduct"), element, count);
	grid->unknown[element] = true;
	grid->reported++;
}

static void find_part(struct grid *grid, int y, int x)
{
	const struct classic_cell *cell = &grid->rung->cell[y][x];
	const struct element_row *row = row_of(cell->element);
	struct grid_part *part = &grid->part[grid->parts];

	if (!cell->element || cell->element == OCCUPIED)
		return;
	grid->c->at.line = grid->rung->row_line[y];
	if (!row) {
		report_unknown(grid, cell->element);
		return;
	}
	*part = (struct grid_part){
		.kind = row->kind, .x = x - row->columns + 1, .y = y,
		.columns = row->columns, .rows = row->box ? row->box->rows : 1,
		.box = row->box, .reads.type = -1, .reads.index_type = -1,
		.expression = -1,
	};
	settle(grid, part, x);
	part->text = text_of_part(grid, part, cell, row);
	grid->reported += !part->text;
	if (part->text)
		grid->parts++;
	else if (row->kind == PART_CONTACT && cell->element == 2)
		*part = (struct grid_part){ .kind = PART_WIRE, .x = x, .y = y, .columns = 1,
			.rows = 1, .text = "---", .reads.type = -1, .expression = -1 },
		grid->parts++;
}

/* Column by column, in the order of evaluation. */
static void find_parts(struct grid *grid)
{
	for (int x = 0; x < grid->columns; x++)
		for (int y = 0; y < CLASSIC_ROWS; y++)
			find_part(grid, y, x);
}

/* Does a needed part begin at this node? A box has no input in some rows. */
static bool junction_needed(const struct grid *grid, int y, int x)
{
	int from, to;

	if (x >= grid->columns)
		return false;
	grid_run(grid, y, x, &from, &to);
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		for (int row = from; part->needed && part->x == x && row < to; row++)
			if (row == part->y ||
			    (part->box && row > part->y && row < part->y + part->rows &&
			     part->box->input[row - part->y]))
				return true;
	}
	return false;
}

static void find_need(struct grid *grid)
{
	for (int i = grid->parts - 1; i >= 0; i--) {
		struct grid_part *part = &grid->part[i];

		part->needed = part->kind == PART_BOX || part->kind == PART_COIL ||
			       (part->fed && (part->kind == PART_ACT ||
				junction_needed(grid, part->y, part_end(part))));
	}
}

static void feed_junction(struct grid *grid, int y, int x)
{
	int from, to;

	if (x >= grid->columns)
		return;
	grid_run(grid, y, x, &from, &to);
	for (int i = from; i < to; i++)
		grid->fed[i][x] = true;
}

/* Parts are ordered by their last column, so a part comes after those that feed it. */
static void find_power(struct grid *grid)
{
	for (int y = 0; y < CLASSIC_ROWS; y++)
		grid->fed[y][0] = true;
	for (int i = 0; i < grid->parts; i++) {
		struct grid_part *part = &grid->part[i];

		part->fed = grid->fed[part->y][part->x];
		for (int y = part->y; y < part->y + part->rows; y++)
			if (part_gives(part, y) && (part->kind == PART_BOX || part->fed))
				feed_junction(grid, y, part_end(part));
	}
}

/* ---- the rung ---- */

void grid_head(struct grid *grid)
{
	struct conversion *c = grid->c;

	grid->c->at = grid->rung->place;
	put(c, "RUNG");
	c->rung = ++c->rungs_written;
	if (!grid->begun) {
		const char *label = label_of(c, grid->rung->number);

		if (label)
			put(c, " %s", label);
		if (grid->rung->comment[0]) {
			put(c, " ");
			put_quoted(c, grid->rung->comment);
		}
	}
	grid->begun = true;
	put(c, "\n");
}

const char *grid_temporary(struct grid *grid)
{
	struct conversion *c = grid->c;
	const char **slot = arena_push(c->arena, &c->temps.name, &c->temps.count,
				       sizeof(*slot));

	if (!slot)
		return "";
	*slot = name_new(c, text_of(c, "Rung%d_Power", grid->rung->number));
	return *slot;
}

static bool acts(const struct grid *grid)
{
	for (int i = 0; i < grid->parts; i++)
		if (grid->part[i].kind >= PART_BOX &&
		    (grid->part[i].kind != PART_ACT || grid->part[i].fed))
			return true;
	return false;
}

/* A rung without an output is a comment, or the target of a jump. */
static void write_empty(struct grid *grid)
{
	struct conversion *c = grid->c;

	if (label_of(c, grid->rung->number)) {
		grid_head(grid);
		put(c, "  | NC SYS_ALWAYS_ON | RET |\n");
	} else if (grid->rung->comment[0]) {
		put_comment_line(c, "", grid->rung->comment);
	}
}

/* ---- elements that are left out ---- */

/* An element as ClassicLadder shows it. */
static const char *said(struct conversion *c, const struct classic_cell *cell)
{
	const int number = cell->variable.number;
	char text[CLASSIC_SAID];

	if (cell->element == JUMP)
		return text_of(c, "jump to rung %d", number);
	if (cell->element == CALL)
		return text_of(c, "call of subroutine %d", number);
	if (cell->element == COMPARE || cell->element == OPERATE)
		classic_say_expression(c->project->dialect,
				       classic_expression(c->project, number), text);
	else if (row_of(cell->element)->box)
		classic_say_block(cell->element, number, text);
	else
		classic_say_variable(c->project->dialect, cell->variable, text);
	return text_of(c, "%s", text);
}

/* A line of the report for each element that the text does not have. Wires are none. */
static int report_left_out(struct grid *grid)
{
	int count = 0;

	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];
		const int x = part_end(part) - 1;

		if (part->written || part->kind == PART_WIRE)
			continue;
		grid->c->at.line = grid->rung->row_line[part->y];
		tell(grid->c, REPORT_LOST, part->fed ?
		     REPORTED("\"%s\" in row %d, column %d, leads to no output") :
		     REPORTED("\"%s\" in row %d, column %d, never has power"),
		     said(grid->c, &grid->rung->cell[part->y][x]), part->y + 1, x + 1);
		count++;
	}
	return count;
}

/* Each element of the file must be in the text or in the report: a rung that breaks this rule
 * is reported, too. */
static void check_count(struct grid *grid, int left_out)
{
	int count = 0, known = grid->reported + left_out;

	for (int i = 0; i < grid->parts; i++)
		known += grid->part[i].written && grid->part[i].kind != PART_WIRE;
	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x < CLASSIC_COLUMNS; x++) {
			const int element = grid->rung->cell[y][x].element;

			count += element && element != WIRE && element != OCCUPIED;
		}
	grid->c->at = grid->rung->place;
	if (count != known)
		tell(grid->c, REPORT_LOST, "%d of %d elements of this rung are missing: "
		     "an error of the import, please report it", count - known, count);
}

/* Lines of the report from @first on do not lead to a rung: none is written. */
static void lead_nowhere(struct conversion *c, int first)
{
	for (int i = first; i < c->report->count; i++)
		c->report->line[i].rung = 0;
}

void convert_rung(struct conversion *c, const struct classic_rung *rung)
{
	const int first = c->report->count, first_rung = c->rungs_written + 1;
	struct grid *grid;

	arena_reset(&c->scratch);
	grid = arena_alloc(&c->scratch, sizeof(*grid));
	if (!grid)
		return;
	grid->c = c;
	grid->rung = rung;
	grid->columns = rung->columns;
	c->rung = first_rung;
	find_parts(grid);
	find_power(grid);
	find_need(grid);
	if (!acts(grid)) {
		lead_nowhere(c, first);
		write_empty(grid);
	} else if (!grid_write_pieces(grid)) {
		grid_unfold(grid);
	}
	c->rung = c->rungs_written < first_rung ? 0 : first_rung;
	check_count(grid, report_left_out(grid));
	c->rung = 0;
}
