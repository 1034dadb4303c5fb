/* SPDX-License-Identifier: MIT
 *
 * random - networks of random shape, column by column.
 *
 * Power is led from bar to bar: each live row gets an element or a wire, or ends if
 * another row continues its net; links join neighbouring rows. That gives series,
 * parallels, splits and bridges. A rung that breaks a rule of topology is discarded.
 */
#include "tests/walker/random.h"

#include <stdio.h>
#include <string.h>

void random_seed(struct random_source *source, uint64_t seed)
{
	source->state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du;
	if (!source->state)
		source->state = 1;
	for (int i = 0; i < 8; i++)
		random_next(source);
}

uint32_t random_next(struct random_source *source)
{
	source->state ^= source->state >> 12;
	source->state ^= source->state << 25;
	source->state ^= source->state >> 27;
	return (uint32_t)(source->state * 0x2545f4914f6cdd1du >> 32);
}

uint32_t random_below(struct random_source *source, uint32_t n)
{
	return (uint32_t)((uint64_t)random_next(source) * n >> 32);
}

bool random_chance(struct random_source *source, uint32_t percent)
{
	return random_below(source, 100) < percent;
}

#define BARS (RANDOM_ROWS * (RANDOM_COLS + 1))
struct sketch {
	const struct random_rung *rung;
	int net[BARS];
	bool fed[BARS], read[BARS]; /* by net                                 */
	bool inner[BARS];           /* read by an element that is no output   */
	int from[BARS], to[BARS];   /* rightmost bar that feeds it, leftmost
				       that reads it                          */
};

static int bar_at(const struct sketch *sketch, int row, int bar)
{
	return row * (sketch->rung->cols + 1) + bar;
}

static int root_of(const struct sketch *sketch, int bar)
{
	while (sketch->net[bar] != bar)
		bar = sketch->net[bar];
	return bar;
}

static int net_at(const struct sketch *sketch, int row, int bar)
{
	return root_of(sketch, bar_at(sketch, row, bar));
}

static void join(struct sketch *sketch, int a, int b)
{
	a = root_of(sketch, a);
	b = root_of(sketch, b);
	sketch->net[a > b ? a : b] = a < b ? a : b;
}

static bool has_left(const struct random_cell *cell)
{
	return cell->kind != RANDOM_EMPTY && cell->kind != RANDOM_BLANK;
}

static bool is_through(const struct random_cell *cell)
{
	return cell->kind == RANDOM_SERIES || cell->kind == RANDOM_BOX ||
	       cell->kind == RANDOM_COIL;
}

static bool is_below(const struct random_cell *cell)
{
	return cell->kind == RANDOM_PIN || cell->kind == RANDOM_BLANK;
}

/* Whether an element or a wire is at this bar. */
static bool bar_is_used(const struct random_rung *rung, int row, int bar)
{
	bool left = bar > 0 && (rung->cell[row][bar - 1].kind == RANDOM_WIRE ||
				is_through(&rung->cell[row][bar - 1]));

	return left || (bar < rung->cols && has_left(&rung->cell[row][bar]));
}

static bool links_are_sound(const struct random_rung *rung)
{
	for (int row = 0; row < rung->rows; row++) {
		for (int col = 0; col < rung->cols; col++) {
			const struct random_cell *cell = &rung->cell[row][col];
			bool more = row + 1 < rung->rows &&
				    rung->cell[row + 1][col].link;
			bool up = row > 0 && rung->cell[row - 1][col].link;

			if (!cell->link)
				continue;
			if (row == 0 || is_below(cell) ||
			    cell->kind == RANDOM_LAST ||
			    is_below(&rung->cell[row - 1][col]) ||
			    rung->cell[row - 1][col].kind == RANDOM_LAST)
				return false;
			if (!more && !bar_is_used(rung, row, col + 1))
				return false;
			if (!up && !bar_is_used(rung, row - 1, col + 1))
				return false;
		}
	}
	return true;
}

static bool bar_is_linked(const struct random_rung *rung, int row, int bar)
{
	return bar > 0 && (rung->cell[row][bar - 1].link ||
			   (row + 1 < rung->rows &&
			    rung->cell[row + 1][bar - 1].link));
}

/* A wire continues at both its ends. */
static bool wires_are_sound(const struct random_rung *rung)
{
	for (int row = 0; row < rung->rows; row++) {
		for (int col = 0; col < rung->cols; col++) {
			bool left, right;

			if (rung->cell[row][col].kind != RANDOM_WIRE)
				continue;
			left = col == 0 || bar_is_linked(rung, row, col) ||
			       rung->cell[row][col - 1].kind == RANDOM_WIRE ||
			       is_through(&rung->cell[row][col - 1]);
			right = bar_is_linked(rung, row, col + 1) ||
				(col + 1 < rung->cols &&
				 has_left(&rung->cell[row][col + 1]));
			if (!left || !right)
				return false;
		}
	}
	return true;
}

static void find_nets(struct sketch *sketch)
{
	const struct random_rung *rung = sketch->rung;

	for (int i = 0; i < BARS; i++)
		sketch->net[i] = i;
	for (int row = 0; row < rung->rows; row++) {
		join(sketch, bar_at(sketch, row, 0), 0);
		for (int col = 0; col < rung->cols; col++) {
			const struct random_cell *cell = &rung->cell[row][col];
			int right = bar_at(sketch, row, col + 1);

			if (cell->kind == RANDOM_WIRE)
				join(sketch, right - 1, right);
			if (cell->link && row > 0)
				join(sketch, right,
				     bar_at(sketch, row - 1, col + 1));
		}
	}
}

/* Nets that power can reach, round by round: the elements that feed a net must be fed
 * first. A cycle is never reached. */
static bool everything_is_fed(struct sketch *sketch)
{
	const struct random_rung *rung = sketch->rung;
	bool passed[RANDOM_ROWS][RANDOM_COLS] = { { false } };
	int waiting[BARS] = { 0 };
	bool moved = true, all = true;

	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++)
			if (is_through(&rung->cell[row][col]))
				waiting[net_at(sketch, row, col + 1)]++;
	sketch->fed[0] = true;
	if (waiting[0])
		return false;
	while (moved) {
		moved = false;
		for (int i = 0; i < rung->rows * rung->cols; i++) {
			int row = i / rung->cols, col = i % rung->cols, out;
			bool ready = true;

			if (!is_through(&rung->cell[row][col]) ||
			    passed[row][col])
				continue;
			for (int r = row; r < rung->rows && (r == row ||
			     is_below(&rung->cell[r][col])); r++)
				if (has_left(&rung->cell[r][col])) {
					int in = net_at(sketch, r, col);

					ready &= sketch->fed[in] && !waiting[in];
				}
			if (!ready)
				continue;
			passed[row][col] = moved = true;
			out = net_at(sketch, row, col + 1);
			waiting[out]--;
			sketch->fed[out] = true;
		}
	}
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		int row = i / rung->cols, col = i % rung->cols;

		if (has_left(&rung->cell[row][col]))
			all &= sketch->fed[net_at(sketch, row, col)] &&
			       !waiting[net_at(sketch, row, col)];
	}
	return all;
}

/* Power must not have to flow from right to left along a wire. */
static bool all_flows_right(struct sketch *sketch)
{
	const struct random_rung *rung = sketch->rung;

	for (int i = 0; i < BARS; i++)
		sketch->to[i] = RANDOM_COLS + 1;
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		int row = i / rung->cols, col = i % rung->cols;
		const struct random_cell *cell = &rung->cell[row][col];
		int in = net_at(sketch, row, col);
		int out = net_at(sketch, row, col + 1);

		if (has_left(cell) && cell->kind != RANDOM_WIRE &&
		    col < sketch->to[in])
			sketch->to[in] = col;
		if (is_through(cell) && col + 1 > sketch->from[out])
			sketch->from[out] = col + 1;
	}
	for (int i = 0; i < BARS; i++)
		if (sketch->from[i] > sketch->to[i])
			return false;
	return true;
}

bool random_sound(const struct random_rung *rung)
{
	struct sketch sketch = { .rung = rung };
	int outputs = 0;

	if (!links_are_sound(rung) || !wires_are_sound(rung))
		return false;
	find_nets(&sketch);
	if (!everything_is_fed(&sketch) || !all_flows_right(&sketch))
		return false;
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		int row = i / rung->cols, col = i % rung->cols;
		const struct random_cell *cell = &rung->cell[row][col];

		if (!has_left(cell) || cell->kind == RANDOM_WIRE)
			continue;
		sketch.read[net_at(&sketch, row, col)] = true;
		if (cell->kind != RANDOM_LAST && cell->kind != RANDOM_COIL)
			sketch.inner[net_at(&sketch, row, col)] = true;
	}
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		int row = i / rung->cols, col = i % rung->cols;
		const struct random_cell *cell = &rung->cell[row][col];
		bool read = sketch.read[net_at(&sketch, row, col + 1)];

		if (cell->kind == RANDOM_COIL && sketch.inner[net_at(&sketch, row, col + 1)])
			return false;
		outputs += cell->kind == RANDOM_LAST || cell->kind == RANDOM_COIL ||
			   (cell->kind == RANDOM_BOX && !read);
		if (!read && (cell->link || cell->kind == RANDOM_WIRE ||
			      cell->kind == RANDOM_SERIES))
			return false;
	}
	return outputs > 0;
}

struct drawing {
	struct random_source *source;
	struct random_rung *rung;
	bool live[RANDOM_ROWS];  /* the bar left of `col` may have power       */
	bool behind[RANDOM_ROWS]; /* that of a coil: only outputs follow      */
	int col, later;
};

/* A box at this row; false if there is no room for its pins. */
static bool draw_box(struct drawing *drawing, int row)
{
	struct random_cell *cell = &drawing->rung->cell[row][drawing->col];
	const char *pin[3];
	int fed, blank = random_chance(drawing->source, 10);

	fed = random_box(drawing->source, cell->text, sizeof(cell->text), pin);
	if (cell->text[0] == '[' || fed == 0)
		blank = 0;
	if (row + fed + blank >= drawing->rung->rows)
		return false;
	for (int i = 0; i < fed; i++)
		if (!drawing->live[row + 1 + i])
			return false;
	cell->kind = RANDOM_BOX;
	for (int i = 1; i <= fed + blank; i++) {
		struct random_cell *below =
			&drawing->rung->cell[row + i][drawing->col];

		below->kind = i <= fed ? RANDOM_PIN : RANDOM_BLANK;
		snprintf(below->text, sizeof(below->text), ".%s",
			 i <= fed ? pin[i - 1] : "");
	}
	return true;
}

static bool is_coil(const char *text)
{
	return strncmp(text, "COIL", 4) == 0 || strncmp(text, "S ", 2) == 0 ||
	       strncmp(text, "R ", 2) == 0;
}

static void draw_cell(struct drawing *drawing, int row)
{
	struct random_cell *cell = &drawing->rung->cell[row][drawing->col];
	struct random_source *source = drawing->source;
	bool last = drawing->col == drawing->rung->cols - 1;
	bool behind = drawing->behind[row];

	if (cell->kind != RANDOM_EMPTY || !drawing->live[row])
		return;
	if (!behind && random_chance(source, last ? 12 : 18) && draw_box(drawing, row))
		return;
	memset(cell->text, 0, sizeof(cell->text));
	if (last || behind ? random_chance(source, 75) : random_chance(source, 8)) {
		random_last(source, drawing->later, cell->text,
			    sizeof(cell->text));
		cell->kind = !last && is_coil(cell->text) && random_chance(source, 60) ?
			     RANDOM_COIL : RANDOM_LAST;
	} else if (behind) {
		cell->kind = last ? RANDOM_EMPTY : RANDOM_WIRE;
	} else if (!last && random_chance(source, 55)) {
		cell->kind = RANDOM_SERIES;
		random_series(source, cell->text, sizeof(cell->text));
	} else if (!last && random_chance(source, 60)) {
		cell->kind = RANDOM_WIRE;
	}
}

static void draw_column(struct drawing *drawing)
{
	struct random_rung *rung = drawing->rung;
	int col = drawing->col;

	for (int row = 0; row < rung->rows; row++)
		draw_cell(drawing, row);
	for (int row = 0; row < rung->rows; row++) {
		const struct random_cell *cell = &rung->cell[row][col];

		drawing->live[row] = is_through(cell) ||
				     cell->kind == RANDOM_WIRE;
		drawing->behind[row] = cell->kind == RANDOM_COIL ||
			(cell->kind == RANDOM_WIRE && drawing->behind[row]);
	}
	for (int row = 1; row < rung->rows && col + 1 < rung->cols; row++) {
		struct random_cell *cell = &rung->cell[row][col];
		const struct random_cell *above = &rung->cell[row - 1][col];

		if (is_below(cell) || is_below(above) ||
		    cell->kind == RANDOM_LAST || above->kind == RANDOM_LAST)
			continue;
		cell->link = (drawing->live[row] || drawing->live[row - 1]) &&
			     random_chance(drawing->source, 35);
		if (!cell->link)
			continue;
		drawing->live[row] = drawing->live[row - 1] = true;
		drawing->behind[row] |= drawing->behind[row - 1];
		drawing->behind[row - 1] = drawing->behind[row];
	}
}

static void draw_rung(struct random_source *source, struct random_rung *rung,
		      int later)
{
	struct drawing drawing = { .source = source, .rung = rung,
				   .later = later };
	int pou = rung->pou, label = rung->label, tries = 0;
	int rows = 1, cols = 2;

	do {
		/* A large shape is rare: tries for a while. */
		if (tries++ % 100 == 0) {
			rows = 1 + (int)random_below(source, RANDOM_ROWS);
			cols = 2 + (int)random_below(source, RANDOM_COLS - 1);
		}
		memset(rung, 0, sizeof(*rung));
		rung->pou = pou;
		rung->label = label;
		rung->rows = rows;
		rung->cols = cols;
		for (int row = 0; row < rung->rows; row++) {
			drawing.live[row] = row == 0 ||
					    random_chance(source, 70);
			drawing.behind[row] = false;
		}
		for (int col = 0; col < rung->cols; col++) {
			drawing.col = col;
			draw_column(&drawing);
		}
	} while (!random_sound(rung));
}

static void set_cell(struct random_rung *rung, int col, enum random_kind kind,
		     const char *text)
{
	rung->rows = 1;
	rung->cols = col + 1;
	rung->cell[0][col].kind = kind;
	snprintf(rung->cell[0][col].text, RANDOM_TEXT, "%s", text);
}

/* Three rungs around some others: a loop that counts, bounded by its counter. */
static void make_loop(struct random_program *program)
{
	struct random_rung *first = &program->rung[0];
	struct random_rung *back = &program->rung[program->rungs - 2];
	struct random_rung *clear = &program->rung[program->rungs - 1];

	memset(first->cell, 0, sizeof(first->cell));
	memset(back->cell, 0, sizeof(back->cell));
	memset(clear->cell, 0, sizeof(clear->cell));
	set_cell(first, 0, RANDOM_BOX, "[ loop_a := loop_a + 1 ]");
	set_cell(back, 0, RANDOM_SERIES, "[ loop_a < 3 ]");
	set_cell(back, 1, RANDOM_LAST, "JMP L1");
	set_cell(clear, 0, RANDOM_BOX, "[ loop_a := 0 ]");
	first->label = 1;
	first->off = back->off = clear->off = false;
}

/* Some cells become calls of the subroutine, ends and stops. */
static void add_flow(struct random_source *source, struct random_program *program,
		     struct random_rung *rung)
{
	bool called = program->routine && rung->pou == 1;

	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		struct random_cell *cell =
			&rung->cell[i / RANDOM_COLS][i % RANDOM_COLS];
		bool box = cell->kind == RANDOM_SERIES ||
			   (cell->kind == RANDOM_BOX && cell->text[0] == '[');

		if (program->routine && !called && box &&
		    random_chance(source, 15))
			snprintf(cell->text, sizeof(cell->text), "CALL Other");
		if (cell->kind != RANDOM_LAST || !random_chance(source, 3))
			continue;
		snprintf(cell->text, sizeof(cell->text), "%s",
			 random_chance(source, 30) ? "STOP" : called ? "RET" : "END");
	}
}

/* Some assignments become statements of an EXECUTE box. */
static void add_boxes(struct random_source *source, struct random_rung *rung)
{
	static const char *const forms[] = {
		"EXECUTE\n %s;", "EXECUTE\nIF bool_a THEN %s; ELSE bool_b := NOT bool_b; END_IF;",
		"EXECUTE\n %s; IF bool_b THEN RETURN; END_IF; bool_c := %%IX0.1;",
		"EXECUTE\n WHILE bool_d DO bool_d := FALSE; %s; END_WHILE;",
	};

	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		struct random_cell *cell =
			&rung->cell[i / RANDOM_COLS][i % RANDOM_COLS];
		const size_t len = strlen(cell->text);
		const bool box = cell->kind == RANDOM_SERIES || cell->kind == RANDOM_BOX;
		char inner[RANDOM_TEXT], made[2 * RANDOM_TEXT];

		if (!box || cell->text[0] != '[' || !strstr(cell->text, ":= ") ||
		    !random_chance(source, 40))
			continue;
		snprintf(inner, sizeof(inner), "%.*s", (int)len - 3, cell->text + 2);
		snprintf(made, sizeof(made), forms[random_below(source, 4)], inner);
		if (strlen(made) < sizeof(cell->text))
			memcpy(cell->text, made, strlen(made) + 1);
	}
}

/* Whether a body reads its own instance by its global name. docs/language.md defines
 * that, but it is not generated here. */
static bool names_global(const char *text)
{
	return strstr(text, "inner_a") || strstr(text, "inner_b") ||
	       strstr(text, "outer_");
}

/* Some boxes of a rung become calls of the program's own blocks. */
static void add_own(struct random_source *source, struct random_rung *rung)
{
	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		struct random_cell *cell =
			&rung->cell[i / RANDOM_COLS][i % RANDOM_COLS];
		bool box = cell->kind == RANDOM_SERIES ||
			   (cell->kind == RANDOM_BOX && cell->text[0] == '[');

		if (!box || !random_chance(source, 20))
			continue;
		do
			random_own_call(source, rung->pou, cell->text,
					sizeof(cell->text));
		while (rung->pou > RANDOM_OTHER && names_global(cell->text));
	}
}

/* A function: no edges, no instances, no calls of blocks with a state. */
static void forget(struct random_source *source, struct random_rung *rung)
{
	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		struct random_cell *cell =
			&rung->cell[i / RANDOM_COLS][i % RANDOM_COLS];

		random_without_memory(source, cell->text, sizeof(cell->text));
	}
}

static bool has_box(const struct random_rung *rung)
{
	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		const struct random_cell *cell =
			&rung->cell[i / RANDOM_COLS][i % RANDOM_COLS];

		if (cell->kind == RANDOM_BOX && cell->text[0] != '[')
			return true;
	}
	return false;
}

static bool looks_outside(const struct random_rung *rung)
{
	for (int i = 0; i < RANDOM_ROWS * RANDOM_COLS; i++) {
		if (names_global(rung->cell[i / RANDOM_COLS][i % RANDOM_COLS].text))
			return true;
	}
	return false;
}

static void make_own(struct random_source *source, struct random_program *program)
{
	for (int pou = RANDOM_INNER; pou < RANDOM_POUS; pou++) {
		int count = 1 + (int)random_below(source, 2);

		for (int i = 0; i < count; i++) {
			struct random_rung *rung = &program->rung[program->rungs++];

			rung->pou = pou;
			do {
				draw_rung(source, rung, 0);
				if (pou == RANDOM_RECKON)
					forget(source, rung);
			} while (looks_outside(rung) ||
			       (pou == RANDOM_RECKON && has_box(rung)));
		}
	}
}

/* Small areas, of any number of bytes, or larger than usual. Fixed addresses of
 * programs stay inside; indexed ones do not. */
static void draw_areas(struct random_source *source, struct random_program *program)
{
	static const struct { uint32_t least, more; } bounds[RANDOM_AREAS] = {
		{ 16, 40 }, { 16, 40 }, { 24, 60 }, { 0, 9 }, { 0, 9 },
	};

	program->sized = random_chance(source, 30);
	for (int i = 0; i < RANDOM_AREAS; i++) {
		uint32_t most = random_chance(source, 25) ? 8000 : 0;

		program->bytes[i] = bounds[i].least +
				    random_below(source, bounds[i].more + most);
	}
}

void random_make(struct random_program *program, uint64_t seed)
{
	struct random_source source;
	int second, programs = 0;

	random_seed(&source, seed);
	memset(program, 0, sizeof(*program));
	program->rungs = 1 + (int)random_below(&source, 8);
	second = random_chance(&source, 25) ? program->rungs / 2 + 1 :
					      program->rungs;
	for (int i = 0; i < program->rungs; i++) {
		struct random_rung *rung = &program->rung[i];
		int end = i < second ? second : program->rungs;
		int later = i + 1 < end ?
			i + 2 + (int)random_below(&source, (uint32_t)(end - i - 1)) :
			0;

		rung->pou = i >= second;
		draw_rung(&source, rung, random_chance(&source, 60) ? later : 0);
	}
	program->routine = second < program->rungs && random_chance(&source, 60);
	for (int i = 0; i < program->rungs; i++)
		add_flow(&source, program, &program->rung[i]);
	if (program->rungs <= 8 && random_chance(&source, 50)) {
		programs = program->rungs;
		make_own(&source, program);
		for (int i = 0; i < program->rungs; i++)
			if (program->rung[i].pou != RANDOM_RECKON)
				add_own(&source, &program->rung[i]);
	}
	for (int i = 0; i < program->rungs; i++)
		if (program->rung[i].pou <= RANDOM_OTHER)
			add_boxes(&source, &program->rung[i]);
	for (int i = 0; i < program->rungs; i++)
		program->rung[i].label = i + 1;
	program->rung[random_below(&source, (uint32_t)program->rungs)].off =
		random_chance(&source, 10);
	if (!programs && program->rungs >= 4 && second == program->rungs &&
	    random_chance(&source, 15))
		make_loop(program);
	draw_areas(&source, program);
}
