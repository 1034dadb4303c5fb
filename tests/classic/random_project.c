/* SPDX-License-Identifier: MIT
 *
 * random_project - makes a ClassicLadder project and a script from a seed.
 *
 * Half of the rungs are drawn row by row, as people do: elements, wires, blocks with all their
 * rows, links. In the other half elements stand anywhere, with links that nobody would draw.
 * Jumps lead forward and calls to later subroutines, so that a scan ends.
 */
#include "tests/classic/random_project.h"

#include "tests/classic/random_inside.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void making_put(struct making *making, const char *format, ...)
{
	va_list args;
	int len;

	for (;;) {
		size_t room = making->size - making->len;

		va_start(args, format);
		len = vsnprintf(making->text + making->len, room, format, args);
		va_end(args);
		if (len < 0 || making->failed)
			return;
		if ((size_t)len < room)
			break;
		making->size = making->size * 2 + (size_t)len + 1;
		making->text = realloc(making->text, making->size);
		if (!making->text) {
			making->failed = true;
			return;
		}
	}
	making->len += (size_t)len;
}

int making_below(struct making *making, int count)
{
	return (int)random_below(&making->random, (uint32_t)count);
}

bool making_chance(struct making *making, int percent)
{
	return making_below(making, 100) < percent;
}

/* ---- variables of contacts and coils ---- */

static void read_bit(struct making *making, struct cell *cell)
{
	static const int block_bits[] = { 10, 11, 15, 20, 25, 26, 27, 80, 81 };

	cell->number = making_below(making, BITS);
	if (making_chance(making, 45)) {
		cell->type = 50;
		cell->number = making_below(making, INPUTS);
	} else if (making_chance(making, 45)) {
		cell->type = 0;
	} else if (making_chance(making, 40)) {
		cell->type = 60;
		cell->number = making_below(making, OUTPUTS);
	} else if (making_chance(making, 60)) {
		cell->type = block_bits[making_below(making, making->linuxcnc ? 7 : 9)];
		cell->number = making_below(making, BLOCKS);
	} else if (making_chance(making, 60)) {
		cell->type = 30;
		cell->number = making_below(making, STEPS);
	} else {
		cell->type = making->linuxcnc ? 75 : making_chance(making, 50) ? 70 : 65;
		/* Not %S7 and %S8: here, elements without power do not set them. */
		cell->number = making_below(making, cell->type == 70 ? 7 : 9);
	}
	if (cell->type == 0 && making_chance(making, 10))
		cell->index = FIRST_INDEX + making_below(making, INDICES);
}

static void written_bit(struct making *making, struct cell *cell)
{
	cell->type = making_chance(making, 55) ? 0 : making_chance(making, 95) ? 60 :
		     making->linuxcnc ? 75 : 65;
	cell->number = making_below(making, cell->type == 0 ? BITS : OUTPUTS);
	if (cell->type != 65 && cell->type != 75 && making_chance(making, 5)) {
		cell->index = FIRST_INDEX + making_below(making, INDICES);
		if (cell->type == 0 && cell->number > BITS - 8)
			cell->number = 0;
	}
}

/* ---- one rung ---- */

static bool is_free(const struct grid *grid, int x, int y, int columns, int rows)
{
	for (int i = 0; i < rows; i++)
		for (int j = 0; j < columns; j++)
			if (y + i >= grid->rows || x + j >= grid->columns - 1 ||
			    grid->cell[y + i][x + j].element != 0)
				return false;
	return true;
}

/* A block, 2 columns wide: its code is in the upper right cell. */
static bool add_block(struct making *making, struct grid *grid, int x, int y)
{
	static const int rows[] = { 2, 2, 4, 2, 3 };
	int kind = making_below(making, making->linuxcnc ? 4 : 5);
	int *next = &making->used[kind];
	struct cell *alive;

	if (!is_free(grid, x, y, 2, rows[kind]) || (x == 0 && !making->odd))
		return false;
	if (*next >= BLOCKS)
		return false;
	for (int i = 0; i < rows[kind]; i++)
		grid->cell[y + i][x].element = grid->cell[y + i][x + 1].element = 99;
	alive = &grid->cell[y][x + 1];
	alive->element = 10 + kind;
	alive->number = *next && making->odd && making_chance(making, 20) ?
			making_below(making, *next) : (*next)++;
	if (kind == 0 && making_chance(making, 50))
		grid->cell[y + 1][x].top = true; /* E and C together            */
	return true;
}

static bool add_compare(struct making *making, struct grid *grid, int x, int y)
{
	if (!is_free(grid, x, y, 3, 1) || making->compares == 0)
		return false;
	grid->cell[y][x].element = grid->cell[y][x + 1].element = 99;
	grid->cell[y][x + 2].element = 20;
	grid->cell[y][x + 2].number = making_below(making, making->compares);
	return true;
}

static void add_contact(struct making *making, struct cell *cell)
{
	cell->element = making_chance(making, 40) ? 1 : making_chance(making, 50) ? 2 : 3 + making_below(making, 2);
	read_bit(making, cell);
}

/* A row from its left end to a coil, or up to where it joins the row above. */
static void add_row(struct making *making, struct grid *grid, int y)
{
	bool ends_early = y > 0 && making_chance(making, 35);
	int end = ends_early ? 2 + making_below(making, grid->columns - 3) :
		  grid->columns - 1;
	int x = y > 0 && making_chance(making, 30) ? 1 + making_below(making, 4) : 0;

	if (x > 0 && grid->cell[y][x].element == 0)
		grid->cell[y][x].top = true; /* begins at the row above         */
	while (x < end) {
		struct cell *cell = &grid->cell[y][x];
		bool top = cell->top;

		if (cell->element != 0) {
			x++;
			continue;
		}
		if (making_chance(making, 8) && add_block(making, grid, x, y))
			x += 2;
		else if (making_chance(making, 10) && add_compare(making, grid, x, y))
			x += 3;
		else if (making_chance(making, x < 6 ? 45 : 10))
			add_contact(making, &grid->cell[y][x++]);
		else
			grid->cell[y][x++].element = 9;
		cell->top = top || (y > 0 && cell->element != 99 && making_chance(making, 6));
	}
	if (ends_early && x < grid->columns)
		grid->cell[y][x].top = true;
}

static void add_coil(struct making *making, struct grid *grid, int y, int rung)
{
	int last = grid->columns - 1;
	struct cell *cell = &grid->cell[y][last];

	if (making->operates && making_chance(making, 25) && grid->cell[y][last - 2].element <= 9 &&
	    grid->cell[y][last - 1].element <= 9) {
		bool top = grid->cell[y][last - 2].top;

		grid->cell[y][last - 2] = grid->cell[y][last - 1] =
			(struct cell){ .element = 99, .index = -1 };
		grid->cell[y][last - 2].top = top;
		cell->element = 60;
		cell->number = making->compares + making_below(making, making->operates);
	} else if (making->target > rung && making_chance(making, 12)) {
		cell->element = 54;
		cell->number = rung + 1 + making_below(making, making->target - rung);
	} else if (making->callable < making->subroutines && making_chance(making, 12)) {
		cell->element = 55;
		cell->number = making->callable +
			       making_below(making, making->subroutines - making->callable);
	} else {
		cell->element = making_chance(making, 55) ? 50 : 51 + making_below(making, 3);
		written_bit(making, cell);
	}
	cell->top = y > 0 && making_chance(making, 15);
}

/* ---- elements anywhere ---- */

/* A coil, jump, call or operation, in any column. */
static void scatter_output(struct making *making, struct grid *grid, int y, int x, int rung)
{
	struct cell *cell = &grid->cell[y][x];

	if (making->operates && x >= 2 && making_chance(making, 25) &&
	    !cell[-1].element && !cell[-2].element) {
		cell[-1].element = cell[-2].element = 99;
		cell->element = 60;
		cell->number = making->compares + making_below(making, making->operates);
	} else if (making->target > rung && making_chance(making, 8)) {
		cell->element = 54;
		cell->number = rung + 1 + making_below(making, making->target - rung);
	} else if (making->callable < making->subroutines && making_chance(making, 8)) {
		cell->element = 55;
		cell->number = making->callable +
			       making_below(making, making->subroutines - making->callable);
	} else {
		cell->element = 50 + making_below(making, 4);
		written_bit(making, cell);
	}
}

static void scatter_cell(struct making *making, struct grid *grid, int y, int x, int rung)
{
	int kind = making_below(making, 100);

	if (grid->cell[y][x].element)
		return;
	if (kind < 12)
		scatter_output(making, grid, y, x, rung);
	else if (kind < 18 && x > 0)
		add_block(making, grid, x, y);
	else if (kind < 24)
		add_compare(making, grid, x, y);
	else if (kind < 60)
		add_contact(making, &grid->cell[y][x]);
	else
		grid->cell[y][x].element = 9;
}

/* A run of links up or down a column, whatever its cells hold. */
static void scatter_chain(struct making *making, struct grid *grid)
{
	int x = making_below(making, grid->columns), y = making_below(making, grid->rows);
	int rows = 1 + making_below(making, grid->rows);

	for (; rows > 0 && y < grid->rows; rows--, y++)
		grid->cell[y][x].top = true;
}

/* Some or most cells have an element, some or most have a link: also in the first row and
 * column, where links mean nothing, and in the last column. */
static void scatter(struct making *making, struct grid *grid, int rung)
{
	static const int densities[] = { 10, 30, 60, 95 }, chances[] = { 0, 4, 15, 50 };
	int density = densities[making_below(making, 4)], link = chances[making_below(making, 4)];
	int rows = 1 + making_below(making, grid->rows);

	for (int y = 0; y < rows; y++)
		for (int x = 0; x < grid->columns; x++) {
			if (making_chance(making, density))
				scatter_cell(making, grid, y, x, rung);
			grid->cell[y][x].top = making_chance(making, link);
		}
	for (int chains = making_below(making, 4); chains > 0; chains--)
		scatter_chain(making, grid);
	for (int y = 0; y < rows; y++)
		if (making_chance(making, 50) && !grid->cell[y][grid->columns - 1].element)
			scatter_output(making, grid, y, grid->columns - 1, rung);
}

/* Any element anywhere, which the editor does not allow. */
static void add_odd(struct making *making, struct grid *grid)
{
	static const int codes[] = { 0, 1, 2, 3, 9, 99, 103, 50, 53, 20, 60, 51, 4, 200 };
	int y = making_below(making, grid->rows), x = making_below(making, grid->columns);
	struct cell *cell = &grid->cell[y][x];

	cell->element = codes[making_below(making, 14)];
	/* An element that begins left of the rung has no defined meaning.      */
	if (x < 2 && (cell->element == 20 || cell->element == 60))
		cell->element = 9;
	cell->top = making_chance(making, 50);
	cell->index = -1;
	cell->type = 0;
	cell->number = making_below(making, BITS);
	if (cell->element == 20 && making->compares)
		cell->number = making_below(making, making->compares);
	if (cell->element == 60 && making->operates)
		cell->number = making->compares + making_below(making, making->operates);
}

static void put_grid(struct making *making, const struct grid *grid)
{
	for (int y = 0; y < grid->rows; y++)
		for (int x = 0; x < grid->columns; x++) {
			const struct cell *cell = &grid->cell[y][x];

			making_put(making, "%d-%d-%d/%d", cell->element, cell->top, cell->type,
			    cell->number);
			if (cell->index >= 0)
				making_put(making, "[200/%d]", cell->index);
			making_put(making, "%s", x + 1 < grid->columns ? " , " : "\n");
		}
}

/* As people draw: rows from the left to a coil. */
static void draw_rows(struct making *making, struct grid *grid, int rung)
{
	int rows = making_chance(making, 30) ? grid->rows : 1 + making_below(making, 5);

	for (int y = 0; y < rows; y++) {
		add_row(making, grid, y);
		if (grid->cell[y][grid->columns - 2].element == 9 || making_chance(making, 50))
			add_coil(making, grid, y, rung);
	}
}

static void put_rung(struct making *making, int number, int previous, int next)
{
	struct grid grid;

	memset(&grid, 0, sizeof(grid));
	grid.rows = making->narrow ? ROWS - 2 : ROWS;
	grid.columns = making->narrow ? COLUMNS - 2 : COLUMNS;
	for (int y = 0; y < ROWS; y++)
		for (int x = 0; x < COLUMNS; x++)
			grid.cell[y][x].index = -1;
	if (making_chance(making, 50))
		scatter(making, &grid, number);
	else
		draw_rows(making, &grid, number);
	if (making->odd && making_chance(making, 20))
		for (int i = making_below(making, 4); i >= 0; i--)
			add_odd(making, &grid);
	making_put(making, "_FILE-rung_%d.csv\n#VER=%d.0\n#LABEL=%s\n#COMMENT=\n#PREVRUNG=%d\n"
		   "#NEXTRUNG=%d\n", number, making->narrow ? 2 : 3,
		   making_chance(making, 20) ? "L" : "", previous, next);
	put_grid(making, &grid);
	making_put(making, "_/FILE-rung_%d.csv\n", number);
}

/* ---- sections ---- */

static void put_rungs(struct making *making, int first, int count)
{
	making->target = first + count - 1;
	for (int i = 0; i < count; i++)
		put_rung(making, first + i, i ? first + i - 1 : -1,
			 i + 1 < count ? first + i + 1 : -1);
}

/* A random kind of those that are left; -1: none is. */
static int choose(struct making *making, int *left, int kinds)
{
	int total = 0, at;

	for (int i = 0; i < kinds; i++)
		total += left[i];
	if (!total)
		return -1;
	at = making_below(making, total);
	for (int i = 0; i < kinds; i++) {
		if (at < left[i]) {
			left[i]--;
			return i;
		}
		at -= left[i];
	}
	return -1;
}

/* Main sections, subroutines and pages in any order; sometimes a page that no section shows. */
static void put_sections(struct making *making)
{
	enum { MAIN, SUBROUTINE, PAGE, KINDS };
	int mains = 1 + making_below(making, 3), rung = 0, sections = 0, kind;
	int first[16], count[16], left[KINDS], done[KINDS] = { 0 }, turn;

	making->subroutines = making_chance(making, 40) ? 1 + making_below(making, 3) : 0;
	making->pages = making_chance(making, 60) ? 1 + making_below(making, PAGES) : 0;
	for (int i = 0; i < mains + making->subroutines; i++) {
		first[i] = rung;
		count[i] = 1 + making_below(making, 4);
		making->callable = i < mains ? 0 : i - mains + 1;
		put_rungs(making, rung, count[i]);
		rung += count[i];
	}
	left[MAIN] = mains;
	left[SUBROUTINE] = making->subroutines;
	left[PAGE] = making->pages - (making->pages > 1 && making_chance(making, 10));
	turn = making->pages ? making_below(making, making->pages) : 0;
	making_put(making, "_FILE-sections.csv\n#VER=1.0\n");
	while ((kind = choose(making, left, KINDS)) >= 0) {
		int n = done[kind]++, at = kind == SUBROUTINE ? mains + n : n;

		if (kind == PAGE)
			making_put(making, "%03d,1,-1,0,0,%d\n", sections++,
				   (turn + n) % making->pages);
		else
			making_put(making, "%03d,0,%d,%d,%d,0\n", sections++,
				   kind == MAIN ? -1 : n, first[at],
				   first[at] + count[at] - 1);
	}
	making_put(making, "_/FILE-sections.csv\n");
}

/* ---- sequential pages ---- */

/* A list of up to @most steps of the page, ten numbers. */
static void put_links(struct making *making, int first, int count, int most)
{
	/* Sometimes none: a transition from or to no step.                     */
	int links = making_chance(making, 75) ? 1 : making_below(making, most + 1);
	int at = making_below(making, count);

	for (int i = 0; i < 10; i++) {
		making_put(making, "%d,", i < links && i < count ? first + (at + i) % count : -1);
	}
}

static void put_page(struct making *making, int page, int first_transition)
{
	int steps = 3 + making_below(making, PAGE_STEPS - 3), first = page * PAGE_STEPS;
	int transitions = steps + making_below(making, 4);

	for (int i = 0; i < steps; i++) {
		/* Some have the number of another step.                           */
		int number = making_chance(making, 95) ? first + i :
			     making_below(making, STEPS);

		making->numbered[number] = true;
		making_put(making, "S%d,%d,%d,%d,%d,%d\n", first + i,
			   i == 0 || making_chance(making, 8), number, page,
			   1 + i % 8 * 2, 1 + i / 8 * 4);
	}
	for (int i = 0; i < transitions; i++) {
		struct cell cell = { .index = -1 };

		making_put(making, "T%d,", first_transition + i);
		if (i < steps) { /* a way through all steps                        */
			for (int k = 0; k < 10; k++)
				making_put(making, "%d,", k ? -1 : first + (i + 1) % steps);
			for (int k = 0; k < 10; k++)
				making_put(making, "%d,", k ? -1 : first + i);
		} else {
			put_links(making, first, steps, 3);
			put_links(making, first, steps, 3);
		}
		for (int k = 0; k < 20; k++)
			making_put(making, "-1,");
		read_bit(making, &cell);
		if (making_chance(making, 40)) {
			cell.type = 50;
			cell.number = INPUTS + making_below(making, INPUTS);
		}
		making_put(making, "%d,1,%d\nC%d,0,%d/%d\n", page, i, first_transition + i,
		    cell.type, cell.number);
	}
	making->transitions += transitions;
}

static void put_sfc(struct making *making)
{
	making_put(making, "_FILE-sequential.csv\n#VER=1.0\n");
	for (int page = 0; page < making->pages; page++)
		put_page(making, page, making->transitions);
	making_put(making, "_/FILE-sequential.csv\n");
}

/* ---- the rest ---- */

/* Upstream writes numbered lines, LinuxCNC one for each block from 0. */
static void put_blocks(struct making *making, const char *name, const char *letters,
		       int numbers)
{
	making_put(making, "_FILE-%s\n%s", name, making->linuxcnc ? "" : "#VER=2.0\n");
	for (int i = 0; i < BLOCKS; i++) {
		int base = making_chance(making, 70) ? 2 : making_chance(making, 90) ? 1 : 0;
		int least = making_chance(making, 90) ? 1 : 0;

		if (!making->linuxcnc)
			making_put(making, "%s%d,", letters, i);
		if (numbers == 1)
			making_put(making, "%d", least + making_below(making, 5));
		else
			making_put(making, "%d,%d", base,
				   least + making_below(making, base == 2 ? 9 : base ? 3 : 1));
		if (numbers == 3)
			making_put(making, ",%d", making_below(making, 3));
		making_put(making, "\n");
	}
	making_put(making, "_/FILE-%s\n", name);
}

static void put_registers(struct making *making)
{
	making_put(making, "_FILE-registers.csv\n#VER=1.0\n");
	for (int i = 0; i < BLOCKS; i++)
		making_put(making, "R%d,%d\n", i, 1 + making_below(making, 2));
	making_put(making, "_/FILE-registers.csv\n");
}

static void put_project(struct making *making)
{
	static const int periods[] = { 10, 20, 50, 50, 100, 100, 130, 250 };

	making_put(making, "_FILES_CLASSICLADDER\n_FILE-general.txt\nPERIODIC_REFRESH=%d\n"
	    "SIZE_NBR_RUNGS=100\nSIZE_NBR_BITS=500\nSIZE_NBR_WORDS=200\n"
	    "SIZE_NBR_PHYS_INPUTS=50\nSIZE_NBR_PHYS_OUTPUTS=50\nSIZE_REGISTER_LIST=%d\n"
	    "_/FILE-general.txt\n", periods[making_below(making, 8)], 2 + making_below(making, 6));
	put_blocks(making, "timers.csv", "T", 2);
	put_blocks(making, "monostables.csv", "M", 2);
	put_blocks(making, "counters.csv", "C", 1);
	put_blocks(making, "timers_iec.csv", "TM", 3);
	if (making->linuxcnc)
		making_put(making, "_FILE-com_params.txt\nMODBUS_MAP_COIL_READ=0\n"
			   "_/FILE-com_params.txt\n");
	else
		put_registers(making);
	put_expressions(making);
	put_sections(making);
	put_sfc(making);
	making_put(making, "_/FILES_CLASSICLADDER\n");
}

static void put_setting(struct making *making)
{
	if (making->pages && making_chance(making, 40))
		making_put(making, "%%I%d=%d ", INPUTS + making_below(making, INPUTS),
			   making_chance(making, 35));
	else if (making_chance(making, 75))
		making_put(making, "%%I%d=%d ", making_below(making, INPUTS),
			   making_below(making, 2));
	else if (making_chance(making, 30))
		making_put(making, "%%B%d=%d ", making_below(making, BITS), making_below(making, 2));
	else if (making_chance(making, 40))
		making_put(making, "%%IW%d=%d ", making_below(making, 8), making_below(making, 40) - 10);
	else if (making_chance(making, 60))
		making_put(making, "%%W%d=%d ", making_below(making, WORDS),
			   making_chance(making, 80) ? making_below(making, 300) - 100 :
			   2147483647 - making_below(making, 20));
	else
		making_put(making, "%%W%d=%d ", FIRST_INDEX + making_below(making, INDICES),
		    making_below(making, 8));
}

static void put_script(struct making *making)
{
	int lines = 20 + making_below(making, 60);

	making_put(making, "@print %%Q0..%d %%B0..%d %%W0..%d %%QW0..3 %s", OUTPUTS + 7,
		   BITS + 7, WORDS - 1, making->linuxcnc ? "%E0..8" : "%QLED0..8");
	for (int i = 0; i < making->used[0]; i++)
		making_put(making, " %%T%d.D %%T%d.R %%T%d.V", i, i, i);
	for (int i = 0; i < making->used[1]; i++)
		making_put(making, " %%M%d.R %%M%d.V", i, i);
	for (int i = 0; i < making->used[2]; i++)
		making_put(making, " %%C%d.D %%C%d.E %%C%d.F %%C%d.V", i, i, i, i);
	for (int i = 0; i < making->used[3]; i++)
		making_put(making, " %%TM%d.Q %%TM%d.V", i, i);
	for (int i = 0; i < making->used[4]; i++)
		making_put(making, " %%R%d.S %%R%d.O", i, i);
	for (int i = 0; i < STEPS; i++)
		if (making->numbered[i])
			making_put(making, " %%X%d.A %%X%d.V", i, i);
	making_put(making, "\n");
	for (int i = 0; i < lines; i++) {
		int settings = making_below(making, 4);

		if (!settings)
			making_put(making, ". ");
		while (settings--)
			put_setting(making);
		if (making_chance(making, 5))
			making_put(making, "+%d ", 1 + making_below(making, 400));
		if (making_chance(making, 8))
			making_put(making, "x%d ", 2 + making_below(making, 12));
		making_put(making, "\n");
	}
}

bool random_project(uint64_t seed, bool odd, struct random_texts *texts)
{
	struct making making = { .odd = odd, .linuxcnc = seed % 5 == 3,
				.narrow = seed % 5 == 3 || seed % 7 == 2 };

	random_seed(&making.random, seed);
	put_project(&making);
	texts->project = making.text;
	making.text = NULL;
	making.len = making.size = 0;
	put_script(&making);
	texts->script = making.text;
	if (making.failed || !texts->project || !texts->script) {
		free(texts->project);
		free(texts->script);
		return false;
	}
	return true;
}
