/* SPDX-License-Identifier: MIT
 *
 * classic_unfold - a rung that cannot be written as it is drawn: every element that gives
 * power becomes a rung of its own, in ClassicLadder's order of evaluation.
 *
 * The power of a node is a BOOL. The result is longer than the original and does the same
 * in every scan.
 */
#include "engine/exchange/classic/classic_grid.h"

struct unfolded {
	struct grid *grid;
	/* The BOOL of what the cell left of node (x, y) gives; NULL: nothing. */
	const char *given[CLASSIC_ROWS][CLASSIC_COLUMNS + 1];
};

/* The contact that reads the power of a node; at the rail, nothing. */
static void put_power(struct unfolded *u, int y, int x)
{
	struct conversion *c = u->grid->c;
	bool any = false;
	int from, to;

	if (x == 0)
		return;
	grid_run(u->grid, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		if (!u->given[i][x])
			continue;
		put(c, " NO %s |", u->given[i][x]);
		any = true;
		break;
	}
	if (!any)
		put(c, " NC SYS_ALWAYS_ON |");
}

/* Contacts of the other feeders of the node, as branches below the first row. */
static void put_branches(struct unfolded *u, int y, int x)
{
	struct conversion *c = u->grid->c;
	bool first = true;
	int from, to;

	if (x == 0)
		return;
	grid_run(u->grid, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		if (u->given[i][x] && !first)
			put(c, "  | NO %s ^|\n", u->given[i][x]);
		if (u->given[i][x])
			first = false;
	}
}

/* The one BOOL that is the power of a node; NULL: there are several, or none. */
static const char *only_power(const struct unfolded *u, int y, int x)
{
	const char *only = NULL;
	int from, to;

	if (x == 0)
		return "SYS_ALWAYS_ON";
	grid_run(u->grid, y, x, &from, &to);
	for (int i = from; i < to; i++) {
		if (u->given[i][x] && only)
			return NULL;
		if (u->given[i][x])
			only = u->given[i][x];
	}
	return only;
}

static void write_part(struct unfolded *u, struct grid_part *part)
{
	struct conversion *c = u->grid->c;
	const char *power = only_power(u, part->y, part->x);
	int end = part_end(part);
	bool gives = part->kind <= PART_CONTACT;

	if (!part->needed)
		return;
	part->written = true;
	if (part->kind == PART_WIRE && power) {
		u->given[part->y][end] = power;
		return;
	}
	if (gives)
		u->given[part->y][end] = grid_temporary(u->grid);
	grid_head(u->grid);
	put(c, "  |");
	put_power(u, part->y, part->x);
	put(c, " %s |", part->text);
	if (gives)
		put(c, " COIL %s |", u->given[part->y][end]);
	put(c, "\n");
	put_branches(u, part->y, part->x);
}

/* Keeps an output as it is after this call of the block. */
static void keep_output(struct unfolded *u, const char **given)
{
	const char *kept = grid_temporary(u->grid);

	grid_head(u->grid);
	put(u->grid->c, "  | NO %s | COIL %s |\n", *given, kept);
	*given = kept;
}

/* Each input of a box gets a BOOL of its own and is given by name. */
static void write_box(struct unfolded *u, struct grid_part *part)
{
	struct conversion *c = u->grid->c;
	const char *in[4] = { NULL };

	for (int i = 0; i < part->rows; i++) {
		if (!part->box->input[i] || (i && !u->grid->fed[part->y + i][part->x]))
			continue;
		in[i] = grid_temporary(u->grid);
		grid_head(u->grid);
		put(c, "  |");
		put_power(u, part->y + i, part->x);
		put(c, " COIL %s |\n", in[i]);
		put_branches(u, part->y + i, part->x);
	}
	part->written = true;
	grid_head(u->grid);
	put(c, "  | NO %s | %s", in[0], grid_box_text(u->grid, part));
	for (int i = 1; i < part->rows; i++)
		if (in[i])
			put(c, " %s:=%s", part->box->input[i], in[i]);
	put(c, " |\n");
	for (int i = 0; i < part->rows; i++) {
		const char **given = &u->given[part->y + i][part_end(part)];

		if (!part->gives[i])
			continue;
		*given = text_of(c, "%s.%s", part->instance, part->box->output[i]);
		if (grid_called_again(u->grid, part))
			keep_output(u, given);
	}
}

void grid_unfold(struct grid *grid)
{
	struct unfolded *u = arena_alloc(&grid->c->scratch, sizeof(*u));

	if (!u)
		return;
	u->grid = grid;
	tell(grid->c, REPORT_TAKEN, "its columns depend on one another: it became several "
	     "rungs");
	for (int i = 0; i < grid->parts; i++) {
		if (grid->part[i].kind == PART_BOX)
			write_box(u, &grid->part[i]);
		else
			write_part(u, &grid->part[i]);
	}
}
