/* SPDX-License-Identifier: MIT
 *
 * classic_power - where power goes in a piece of a rung, as it does there: along links,
 * and through wires only to the right.
 */
#include "engine/exchange/classic/classic_piece.h"

#include <string.h>

void piece_run(const struct piece *piece, int y, int x, int *from, int *to)
{
	for (*from = y; *from > 0 && piece->link[*from][x]; (*from)--)
		;
	for (*to = y + 1; *to < piece->rows && piece->link[*to][x]; (*to)++)
		;
}

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

/* What wires and links join is one place. */
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

/* Where power goes that is at bar @x of row @y: along links, and wires to the right. */
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

/* Does all that is joined to this place get the power that goes out from there? */
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

bool piece_is_same_power(const struct piece *piece)
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

