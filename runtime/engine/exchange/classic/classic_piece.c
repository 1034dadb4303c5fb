/* SPDX-License-Identifier: MIT
 *
 * classic_piece - a rung as ClassicLadder draws it, without needless wires; cut into two or
 * more where outputs of a block or the order of columns make it necessary.
 *
 * A cut goes through all rows at one node. Behind it, a BOOL or a contact of the block has
 * the power of the node. If a cut would go through an element, or power would be lost,
 * nothing is written, and classic_unfold.c writes the rung.
 */
#include "engine/exchange/classic/classic_grid.h"

#include <string.h>

enum { PIECE_COLUMNS = CLASSIC_COLUMNS + 2 };

struct piece_cell {
	const char *text;     /* NULL: empty                                   */
	enum part_kind kind;
	struct grid_part *part; /* in its first cell; NULL: made here          */
	bool box_row;         /* a further row of a box                        */
	bool gives;           /* of a box: its first output is used            */
	bool needed, fed;
};

struct piece {
	struct grid *grid;
	struct piece_cell cell[CLASSIC_ROWS][PIECE_COLUMNS];
	/* Bar @x of this row is joined with that of the row above. */
	bool link[CLASSIC_ROWS + 1][PIECE_COLUMNS + 1];
	int rows, columns;
	bool broken;          /* it cannot be written as a drawing             */
};

struct cuts {
	bool at[CLASSIC_COLUMNS + 1];
	/* The BOOL of a node that is cut, by the first row of its run. */
	const char *power[CLASSIC_ROWS][CLASSIC_COLUMNS + 1];
};

static void piece_run(const struct piece *piece, int y, int x, int *from, int *to)
{
	for (*from = y; *from > 0 && piece->link[*from][x]; (*from)--)
		;
	for (*to = y + 1; *to < piece->rows && piece->link[*to][x]; (*to)++)
		;
}

/* ---- where to cut ---- */

static bool reads_block(struct grid *grid, const struct grid_part *part,
			const struct grid_part *box);

struct looked_for { struct grid *grid; const char *instance; bool found; };

static void look_at(void *context, struct classic_variable variable)
{
	struct looked_for *look = context;
	enum classic_kind kind = classic_kind_of(variable.type);
	const char *name = kind == CLASSIC_KINDS ? NULL :
			   instance_of(look->grid->c, kind, variable.number);

	if (name && !strcmp(name, look->instance))
		look->found = true;
}

/* Does @part read a pin of @box, or call its block again? */
static bool reads_block(struct grid *grid, const struct grid_part *part,
			const struct grid_part *box)
{
	struct looked_for look = { grid, box->instance, false };
	const char *text = part->expression < 0 ? NULL :
			   classic_expression(grid->c->project, part->expression);

	if (part->kind == PART_BOX)
		return part != box && !strcmp(part->instance, box->instance);
	if (part->reads.type >= 0)
		look_at(&look, part->reads);
	if (text)
		expression_uses(text, look_at, &look);
	return look.found;
}

/* Does a part begin at node @x of row @y? */
static bool is_used(const struct grid *grid, int y, int x)
{
	int from, to;

	if (x >= grid->columns)
		return false;
	grid_run(grid, y, x, &from, &to);
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (part->x == x && part->y < to && part->y + part->rows > from)
			return true;
	}
	return false;
}

static void cut_at_box(struct grid *grid, struct cuts *cuts, const struct grid_part *box)
{
	int end = part_end(box);

	for (int i = 1; i < box->rows; i++)
		if (box->gives[i] && is_used(grid, box->y + i, end))
			cuts->at[end] = true;
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (!reads_block(grid, part, box) ||
		    (part->kind > PART_BOX && part_end(part) == grid->columns))
			continue;
		cuts->at[end] = true;
		if (part_end(part) <= end)
			cuts->at[box->x] = true;
		/* A block is evaluated in its last column: parts beside it read before that. */
		if (part->x < end && part_end(part) > box->x)
			cuts->at[end - 1] = true;
	}
}

/* Parts to the right read what an output in the middle writes. */
static void find_cuts(struct grid *grid, struct cuts *cuts)
{
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (part->kind == PART_BOX)
			cut_at_box(grid, cuts, part);
		else if (part->kind > PART_BOX)
			cuts->at[part_end(part)] = true;
	}
	cuts->at[0] = cuts->at[grid->columns] = true;
}

static bool gives_any(const struct grid_part *part)
{
	for (int i = 0; i < part->rows; i++)
		if (part->gives[i])
			return true;
	return false;
}

/* False if a cut or a link of other rows goes through the inside of an element, or if a block
 * that gives power is called again. */
static bool can_cut(const struct grid *grid, const struct cuts *cuts)
{
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (part->odd)
			return false;
		if (part->kind == PART_BOX && gives_any(part) && grid_called_again(grid, part))
			return false;
		for (int x = part->x + 1; x < part_end(part); x++) {
			if (cuts->at[x])
				return false;
			for (int y = part->y; y <= part->y + part->rows; y++)
				if (grid_link(grid, y, x))
					return false;
		}
	}
	return true;
}

/* ---- one piece ---- */

static void set(struct piece *piece, int y, int x, const char *text, enum part_kind kind)
{
	if (piece->cell[y][x].text)
		piece->broken = true;
	piece->cell[y][x] = (struct piece_cell){ .text = text, .kind = kind };
}

static void set_box(struct piece *piece, const struct grid_part *part, int x, bool cut)
{
	struct conversion *c = piece->grid->c;
	int last = 0;

	set(piece, part->y, x, grid_box_text(piece->grid, part), PART_BOX);
	piece->cell[part->y][x].gives = !cut && part->box->output[0];
	for (int i = 1; i < part->rows; i++)
		if (part->box->input[i] && piece->grid->fed[part->y + i][part->x])
			last = i;
	for (int i = 1; i <= last; i++) {
		bool fed = part->box->input[i] &&
			   piece->grid->fed[part->y + i][part->x];

		set(piece, part->y + i, x, fed ? text_of(c, ".%s", part->box->input[i]) :
						 ".", PART_BOX);
		piece->cell[part->y + i][x].box_row = true;
		piece->cell[part->y + i][x].gives = false;
	}
}

static void set_part(struct piece *piece, struct grid_part *part, int x, bool cut)
{
	if (part->kind == PART_ACT && !part->fed)
		return;
	if (part->kind == PART_BOX)
		set_box(piece, part, x, cut);
	else
		set(piece, part->y, x, part->text, part->kind);
	piece->cell[part->y][x].part = part;
	for (int i = 1; i < part->columns && part->kind <= PART_BOX; i++)
		set(piece, part->y, x + i, "---", PART_WIRE);
}

/* Is the run fed from the left by anything but a box? @row: gets the first such row. */
static bool fed_by_power(const struct grid *grid, int x, int from, int to, int *row)
{
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (part_end(part) != x || part->kind > PART_CONTACT || !part->fed ||
		    part->y < from || part->y >= to)
			continue;
		*row = part->y;
		return true;
	}
	return false;
}

static const char *output_at(const struct grid *grid, int y, int x)
{
	for (int i = 0; i < grid->parts; i++) {
		const struct grid_part *part = &grid->part[i];

		if (part->kind == PART_BOX && part_end(part) == x && y >= part->y &&
		    part_gives(part, y))
			return text_of(grid->c, "NO %s.%s", part->instance,
				       part->box->output[y - part->y]);
	}
	return NULL;
}

/* The last column of a piece stores the power of each node that is cut. */
static void leave(struct piece *piece, struct cuts *cuts, int x, int column)
{
	struct grid *grid = piece->grid;
	int from, to, row;

	for (int y = 0; y < CLASSIC_ROWS; y = to) {
		grid_run(grid, y, x, &from, &to);
		if (!is_used(grid, y, x) || !fed_by_power(grid, x, from, to, &row))
			continue;
		cuts->power[from][x] = grid_temporary(grid);
		set(piece, row, column, text_of(grid->c, "COIL %s", cuts->power[from][x]),
		    PART_COIL);
	}
}

/* The first column of a piece reads that power. */
static void enter(struct piece *piece, const struct cuts *cuts, int x)
{
	struct grid *grid = piece->grid;
	int from, to;

	for (int y = 0; y < CLASSIC_ROWS; y = to) {
		const char *power;

		grid_run(grid, y, x, &from, &to);
		power = cuts->power[from][x];
		for (int i = from; i < to; i++) {
			const char *output = output_at(grid, i, x);

			if (output) {
				set(piece, i, 0, output, PART_CONTACT);
			} else if (power) {
				set(piece, i, 0, text_of(grid->c, "NO %s", power),
				    PART_CONTACT);
				power = NULL;
			}
		}
		if (power)
			piece->broken = true;
	}
}

static void fill(struct piece *piece, struct cuts *cuts, int from, int to)
{
	struct grid *grid = piece->grid;
	int shift = (from > 0) - from;
	bool cut = to < grid->columns;

	piece->rows = CLASSIC_ROWS;
	piece->columns = to + shift + cut;
	for (int i = 0; i < grid->parts; i++) {
		struct grid_part *part = &grid->part[i];

		if (part->x >= from && part_end(part) <= to)
			set_part(piece, part, part->x + shift,
				 cut && part_end(part) == to);
	}
	for (int y = 1; y < CLASSIC_ROWS; y++)
		for (int x = from ? from : 1; x <= to && x < grid->columns; x++)
			piece->link[y][x + shift] = grid_link(grid, y, x);
	if (from > 0)
		enter(piece, cuts, from);
	if (cut)
		leave(piece, cuts, to, to + shift);
}

/* ---- cells that are needed ---- */

static bool is_fed(const struct piece *piece, int y, int x)
{
	int from, to;

	if (x == 0)
		return true;
	piece_run(piece, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		const struct piece_cell *cell = &piece->cell[i][x - 1];

		if (cell->text && ((cell->kind == PART_BOX && cell->gives) ||
				   (cell->kind <= PART_CONTACT && cell->fed)))
			return true;
	}
	return false;
}

static bool is_needed(const struct piece *piece, int y, int x)
{
	int from, to;

	if (x >= piece->columns)
		return false;
	piece_run(piece, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		const struct piece_cell *cell = &piece->cell[i][x];

		if (cell->text && cell->needed && strcmp(cell->text, "."))
			return true;
	}
	return false;
}

static void mark(struct piece *piece)
{
	for (int x = 0; x < piece->columns; x++)
		for (int y = 0; y < piece->rows; y++)
			piece->cell[y][x].fed = is_fed(piece, y, x);
	for (int x = piece->columns - 1; x >= 0; x--)
		for (int y = 0; y < piece->rows; y++) {
			struct piece_cell *cell = &piece->cell[y][x];

			cell->needed = cell->kind >= PART_BOX ||
				       is_needed(piece, y, x + 1);
		}
}

static bool works_without_power(const struct piece_cell *cell)
{
	return cell->kind == PART_COIL || (cell->kind == PART_BOX && !cell->box_row);
}

/* A coil or box that nothing feeds gets a contact that is never closed. */
static void feed_false(struct piece *piece, int y, int x)
{
	for (int i = 0; i < x; i++)
		if (piece->cell[y][i].text || piece->link[y][i + 1] ||
		    piece->link[y + 1][i + 1])
			piece->broken = true;
	if (!x)
		return;
	for (int i = 0; i < x; i++)
		piece->cell[y][i] = (struct piece_cell){ .text = i ? "---" :
			"NC SYS_ALWAYS_ON", .kind = i ? PART_WIRE : PART_CONTACT,
			.needed = true, .fed = true };
}

static void sweep(struct piece *piece)
{
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++) {
			struct piece_cell *cell = &piece->cell[y][x];

			if (!cell->text || (cell->fed && cell->needed))
				continue;
			if (works_without_power(cell))
				continue;
			if (!cell->box_row || strcmp(cell->text, "."))
				cell->text = cell->box_row ? "." : NULL;
		}
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++)
			if (piece->cell[y][x].text && !piece->cell[y][x].fed &&
			    works_without_power(&piece->cell[y][x]))
				feed_false(piece, y, x);
}

/* ---- links: only between rows that have something at that bar ---- */

static bool is_attached(const struct piece *piece, int y, int x)
{
	const struct piece_cell *left = x ? &piece->cell[y][x - 1] : NULL;
	const struct piece_cell *right = x < piece->columns ? &piece->cell[y][x] : NULL;

	return (left && left->text && left->kind <= PART_BOX &&
		(left->kind != PART_BOX || left->gives)) ||
	       (right && right->text && strcmp(right->text, "."));
}

static void trim_run(struct piece *piece, int x, int from, int to)
{
	int first = to, last = from;

	for (int i = from; i < to; i++) {
		if (!is_attached(piece, i, x))
			continue;
		if (first == to)
			first = i;
		last = i;
	}
	for (int i = from + 1; i < to; i++)
		if (i <= first || i > last)
			piece->link[i][x] = false;
}

static void trim_links(struct piece *piece)
{
	int from, to;

	for (int x = 1; x <= piece->columns; x++)
		for (int y = 0; y < piece->rows; y = to) {
			piece_run(piece, y, x, &from, &to);
			trim_run(piece, x, from, to);
		}
}

/* ---- the same power ---- */

struct bars { uint8_t set[CLASSIC_ROWS][PIECE_COLUMNS + 1]; };

static void join(struct bars *bars, uint8_t a, uint8_t b)
{
	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x <= PIECE_COLUMNS; x++)
			if (bars->set[y][x] == b)
				bars->set[y][x] = a;
}

static bool is_through(const struct piece_cell *cell)
{
	return cell->text && !cell->box_row &&
	       (cell->kind == PART_CONTACT || cell->kind == PART_BOX);
}

/* Bars that wires and links join get the same number. */
static void find_bars(const struct piece *piece, struct bars *bars)
{
	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x <= PIECE_COLUMNS; x++)
			bars->set[y][x] = x ? (uint8_t)(y * (PIECE_COLUMNS + 1) + x) : 0;
	for (int y = 0; y < piece->rows; y++)
		for (int x = 1; x <= piece->columns; x++) {
			if (y && piece->link[y][x])
				join(bars, bars->set[y][x], bars->set[y - 1][x]);
			if (piece->cell[y][x - 1].text &&
			    piece->cell[y][x - 1].kind == PART_WIRE)
				join(bars, bars->set[y][x], bars->set[y][x - 1]);
		}
}

/* Marks the bars that power reaches from bar @x of row @y: along links, and through wires to
 * the right, as in ClassicLadder. */
static void spread(const struct piece *piece, int y, int x,
		   bool reached[CLASSIC_ROWS][PIECE_COLUMNS + 1])
{
	int from, to;

	if (x == 0)
		from = y, to = y + 1;
	else
		piece_run(piece, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		const struct piece_cell *cell = &piece->cell[i][x];

		if (reached[i][x])
			continue;
		reached[i][x] = true;
		if (x < piece->columns && cell->text && cell->kind == PART_WIRE)
			spread(piece, i, x + 1, reached);
	}
}

/* Is every cell at a bar of number @set reached? */
static bool reaches_all(const struct piece *piece, const struct bars *bars, uint8_t set,
			bool reached[CLASSIC_ROWS][PIECE_COLUMNS + 1])
{
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++) {
			const struct piece_cell *cell = &piece->cell[y][x];

			if (cell->text && cell->kind != PART_WIRE &&
			    strcmp(cell->text, ".") && bars->set[y][x] == set &&
			    !reached[y][x])
				return false;
		}
	return true;
}

static bool is_same_power(const struct piece *piece)
{
	bool reached[CLASSIC_ROWS][PIECE_COLUMNS + 1] = { { false } };
	struct bars bars;

	find_bars(piece, &bars);
	for (int y = 0; y < piece->rows; y++)
		spread(piece, y, 0, reached);
	if (!reaches_all(piece, &bars, 0, reached))
		return false;
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++) {
			if (!is_through(&piece->cell[y][x]))
				continue;
			memset(reached, 0, sizeof(reached));
			spread(piece, y, x + 1, reached);
			if (!reaches_all(piece, &bars, bars.set[y][x + 1], reached))
				return false;
		}
	return true;
}

/* ---- rows and columns that are not needed ---- */

static void drop_row(struct piece *piece, int y)
{
	for (int i = y; i + 1 < piece->rows; i++) {
		memcpy(piece->cell[i], piece->cell[i + 1], sizeof(piece->cell[i]));
		memcpy(piece->link[i], piece->link[i + 1], sizeof(piece->link[i]));
	}
	piece->rows--;
	memset(piece->cell[piece->rows], 0, sizeof(piece->cell[0]));
	memset(piece->link[piece->rows], 0, sizeof(piece->link[0]));
}

static void drop_rows(struct piece *piece)
{
	for (int y = piece->rows - 1; y >= 0; y--) {
		bool any = false;

		for (int x = 0; x < piece->columns; x++)
			any |= piece->cell[y][x].text != NULL;
		if (!any && piece->rows > 1)
			drop_row(piece, y);
	}
}

static bool holds(const struct piece *piece, int y, int x)
{
	return is_attached(piece, y, x) || piece->link[y][x] || piece->link[y + 1][x];
}

/* Is it a column of wires that can go without joining nodes that are apart? */
static bool is_needless(const struct piece *piece, int x)
{
	for (int y = 0; y < piece->rows; y++) {
		const struct piece_cell *cell = &piece->cell[y][x];

		if (cell->text && cell->kind != PART_WIRE)
			return false;
		if (!cell->text && x > 0 && holds(piece, y, x) && holds(piece, y, x + 1))
			return false;
		/* Without the column this bar would be the rail, which has power. */
		if (!cell->text && x == 0 && holds(piece, y, 1))
			return false;
	}
	return true;
}

static void drop_column(struct piece *piece, int x)
{
	for (int y = 0; y < piece->rows; y++) {
		struct piece_cell *row = piece->cell[y];
		bool *link = piece->link[y];
		bool joined = x > 0 && (link[x] || link[x + 1]);

		memmove(row + x, row + x + 1,
			sizeof(*row) * (size_t)(PIECE_COLUMNS - x - 1));
		memmove(link + x, link + x + 1, sizeof(*link) * (size_t)(PIECE_COLUMNS - x));
		link[x] = joined;
	}
	piece->columns--;
}

/* Two columns stay: an output must not stand at the rail. */
static void drop_columns(struct piece *piece)
{
	for (int x = piece->columns - 1; x >= 0; x--)
		if (is_needless(piece, x) && piece->columns > 2)
			drop_column(piece, x);
}

/* ---- writing ---- */

static void write_row(const struct piece *piece, int y)
{
	struct conversion *c = piece->grid->c;
	int last = -1;

	for (int x = 0; x < piece->columns; x++)
		if (piece->cell[y][x].text || piece->link[y][x + 1])
			last = x;
	put(c, "  |");
	for (int x = 0; x <= last; x++) {
		const struct piece_cell *cell = &piece->cell[y][x];

		put(c, " %s %s", cell->text ? cell->text : "",
		    piece->link[y][x + 1] ? "^|" : "|");
		if (cell->text && cell->part)
			cell->part->written = true;
	}
	put(c, "\n");
}

static bool has_output(const struct piece *piece)
{
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++)
			if (piece->cell[y][x].text && piece->cell[y][x].kind >= PART_BOX)
				return true;
	return false;
}

/* Does a link pass the right end of an output? ClassicLadder ends power there; in a rung file
 * the output would not be the last on its branch. */
static bool joins_output(const struct piece *piece)
{
	for (int y = 0; y < piece->rows; y++)
		for (int x = 0; x < piece->columns; x++)
			if (piece->cell[y][x].text && piece->cell[y][x].kind > PART_BOX &&
			    (piece->link[y][x + 1] || piece->link[y + 1][x + 1]))
				return true;
	return false;
}

static void prepare(struct piece *piece)
{
	mark(piece);
	sweep(piece);
	trim_links(piece);
	if (joins_output(piece) || !is_same_power(piece))
		piece->broken = true;
	drop_rows(piece);
	drop_columns(piece);
	/* Without these columns, rows can be left with nothing but links. */
	trim_links(piece);
	drop_rows(piece);
}

static bool reads(const struct piece *piece, const char *name)
{
	for (int y = 0; y < piece->rows; y++) {
		const char *text = piece->cell[y][0].text;

		if (text && !strncmp(text, "NO ", 3) && !strcmp(text + 3, name))
			return true;
	}
	return false;
}

/* Takes power out of a piece that no later one reads. */
static void drop_unread(struct piece *piece, const struct piece *later, int count)
{
	for (int y = 0; y < piece->rows; y++) {
		struct piece_cell *cell = &piece->cell[y][piece->columns - 1];
		bool is_read = false;

		if (!cell->text || cell->part || cell->kind != PART_COIL)
			continue;
		for (int i = 0; i < count; i++)
			is_read |= reads(&later[i], cell->text + strlen("COIL "));
		if (!is_read)
			*cell = (struct piece_cell){ .text = NULL };
	}
}

bool grid_write_pieces(struct grid *grid)
{
	struct arena *scratch = &grid->c->scratch;
	struct piece *pieces = arena_alloc(scratch, CLASSIC_COLUMNS * sizeof(*pieces));
	struct cuts *cuts = arena_alloc(scratch, sizeof(*cuts));
	int count = 0;

	if (!pieces || !cuts)
		return false;
	find_cuts(grid, cuts);
	if (!can_cut(grid, cuts))
		return false;
	for (int from = 0, to; from < grid->columns; from = to) {
		for (to = from + 1; !cuts->at[to]; to++)
			;
		pieces[count].grid = grid;
		fill(&pieces[count++], cuts, from, to);
	}
	for (int i = count - 1; i >= 0; i--) {
		drop_unread(&pieces[i], &pieces[i + 1], count - 1 - i);
		prepare(&pieces[i]);
		if (pieces[i].broken)
			return false;
	}
	for (int i = 0; i < count; i++) {
		if (!has_output(&pieces[i]))
			continue;
		grid_head(grid);
		for (int y = 0; y < pieces[i].rows; y++)
			write_row(&pieces[i], y);
	}
	return true;
}
