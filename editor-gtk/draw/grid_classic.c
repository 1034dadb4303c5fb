/* SPDX-License-Identifier: MIT
 *
 * grid_classic - rungs of ClassicLadder as strokes, and below them the rungs of the import; see
 * grid_classic.h.
 *
 * In the file the code of a block is in its upper right cell, that of an expression in its
 * right one; their other cells are marked as taken.
 */
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/grid_glyph.h"
#include "editor-gtk/kit/i18n.h"

#include <glib.h>
#include <string.h>

#define CELL_WIDTH  78
#define CELL_HEIGHT 66
#define CELL_WIRE   30   /* of a row: from its top to its wire                  */
#define LEFT        24   /* x of the left rail                                  */
#define RIGHT       24
#define HEADING     28
#define NAME_UP     17   /* baselines above and below the wire                  */
#define NAME_DOWN   25
#define FRAME_UP    16   /* of an expression                                    */

enum { TAKEN = 99, COMPARE = 20, OPERATE = 60, JUMP = 54, CALL = 55, WIRE = 9,
       LAST_COIL = 55, FIRST_COIL = 50, FIRST_BLOCK = 10, LAST_BLOCK = 14 };

struct sketch {
	const struct classic_scene *scene;
	struct nib nib;
	int columns, rows;
	bool covered[CLASSIC_ROWS][CLASSIC_COLUMNS]; /* by something that is drawn */
};

/* ---- the cells ---- */

static const struct classic_cell *cell_at(const struct sketch *sketch, int y, int x)
{
	return &sketch->scene->rung->cell[y][x];
}

static int rows_of(const struct classic_rung *rung)
{
	int rows = 1;

	for (int y = 0; y < CLASSIC_ROWS; y++)
		for (int x = 0; x < CLASSIC_COLUMNS; x++)
			if (rung->cell[y][x].element || rung->cell[y][x].top)
				rows = y + 1;
	return rows;
}

static float left_of(int x)
{
	return LEFT + (float)(x * CELL_WIDTH);
}

static float wire_of(int y)
{
	return HEADING + (float)(y * CELL_HEIGHT) + CELL_WIRE;
}

static void put_line(const struct sketch *sketch, float x1, float y1, float x2, float y2)
{
	picture_line(sketch->nib.picture, TOKEN_IDLE, STROKE_SOLID,
		     sketch->nib.theme->idle_width, x1, y1, x2, y2);
}

static void put_frame(const struct sketch *sketch, enum stroke_style style, float x,
		      float y, float right, float bottom)
{
	picture_frame(sketch->nib.picture, TOKEN_INK, style,
		      sketch->nib.theme->shape_width, x, y, right - x, bottom - y);
}

/* @side: -1: @text ends at @x; 0: is centred; 1: begins. */
static void put_text(const struct sketch *sketch, enum token token, enum letter letter,
		     const char *text, float x, float y, int side, float bound)
{
	const struct lettered fits = lettering_fit(sketch->nib.lettering, letter,
						   text, -1, bound);

	if (*text)
		picture_text(sketch->nib.picture, token, letter, fits,
			     x - fits.width * (float)(1 - side) / 2, y);
}

/* ---- elements ---- */

static const char *strokes_of(int element)
{
	static const struct { int element; const char *strokes; } rows[] = {
		{ 1, "| |" }, { 2, "|/|" }, { 3, "|P|" }, { 4, "|N|" }, { 50, "( )" },
		{ 51, "(/)" }, { 52, "(S)" }, { 53, "(R)" }, { JUMP, "(J)" },
		{ CALL, "(C)" },
	};

	for (size_t i = 0; i < G_N_ELEMENTS(rows); i++)
		if (rows[i].element == element)
			return rows[i].strokes;
	return NULL;
}

/* Label of the target of a jump, number of a subroutine, or a variable with its symbol. */
static void name_element(const struct sketch *sketch, const struct classic_cell *cell,
			 char *name, const char **symbol)
{
	const struct classic_rung *to;

	*symbol = "";
	if (cell->element == JUMP) {
		to = NULL;
		for (int i = 0; i < sketch->scene->project->rungs; i++)
			if (sketch->scene->project->rung[i]->number == cell->variable.number)
				to = sketch->scene->project->rung[i];
		g_snprintf(name, CLASSIC_SAID, "%s", to && *to->label ? to->label : "");
		if (!*name)
			g_snprintf(name, CLASSIC_SAID, "%d", cell->variable.number);
	} else if (cell->element == CALL) {
		g_snprintf(name, CLASSIC_SAID, "SR%d", cell->variable.number);
	} else {
		classic_say_variable(sketch->scene->project->dialect, cell->variable, name);
		*symbol = classic_say_symbol(sketch->scene->project, name);
	}
}

static void put_element(struct sketch *sketch, int y, int x, const char *strokes)
{
	const struct classic_cell *cell = cell_at(sketch, y, x);
	const float middle = left_of(x) + CELL_WIDTH / 2.0f, wire = wire_of(y);
	struct glyph glyph = { .strokes = strokes, .x = middle, .y = wire,
			       .half = strokes[0] == '(' ? 13 : 8, .up = RUNG_HALF,
			       .wire = { TOKEN_INK, STROKE_SOLID,
					 sketch->nib.theme->shape_width } };
	char name[CLASSIC_SAID];
	const char *symbol;

	name_element(sketch, cell, name, &symbol);
	put_line(sketch, left_of(x), wire, middle - glyph.half, wire);
	put_line(sketch, middle + glyph.half, wire, left_of(x + 1), wire);
	glyph_draw(&sketch->nib, &glyph);
	put_text(sketch, TOKEN_INK, LETTER_SYMBOL, *symbol ? symbol : name, middle,
		 wire - NAME_UP, 0, CELL_WIDTH - 4);
	if (*symbol)
		put_text(sketch, TOKEN_COMMENT, LETTER_ADDRESS, name, middle,
			 wire + NAME_DOWN, 0, CELL_WIDTH - 4);
}

static void cover(struct sketch *sketch, int y, int x, int rows, int columns)
{
	for (int row = y; row < y + rows && row < CLASSIC_ROWS; row++)
		for (int col = MAX(x, 0); col < x + columns; col++)
			sketch->covered[row][col] = true;
}

static void put_expression(struct sketch *sketch, int y, int x)
{
	const struct classic_scene *scene = sketch->scene;
	const int first = MAX(x - 2, 0);
	const float from = left_of(first), to = left_of(x + 1), wire = wire_of(y);
	const char *text = classic_expression(scene->project,
					      cell_at(sketch, y, x)->variable.number);
	char said[CLASSIC_SAID];

	classic_say_expression(scene->project->dialect, text ? text : "", said);
	cover(sketch, y, first, 1, x - first + 1);
	put_line(sketch, from, wire, from + 6, wire);
	put_line(sketch, to - 6, wire, to, wire);
	put_frame(sketch, STROKE_SOLID, from + 6, wire - FRAME_UP, to - 6, wire + FRAME_UP);
	put_text(sketch, TOKEN_INK, LETTER_OPERAND, said, (from + to) / 2, wire + 4.5f, 0,
		 to - from - 20);
}

/* ---- blocks ---- */

struct block_look {
	const char *name, *input[4], *output[4];
	int rows;
};

static const struct block_look *look_of(int element)
{
	static const struct block_look looks[] = {
		{ "T", { "E", "C" }, { "D", "R" }, 2 },
		{ "M", { "^" }, { "R" }, 2 },
		{ "CTR", { "R", "P", "U", "D" }, { "E", "D", "F" }, 4 },
		{ "TM", { "I" }, { "Q" }, 2 },
		{ "REG", { "R", "I", "O" }, { "E", "F" }, 3 },
	};

	return element >= FIRST_BLOCK && element <= LAST_BLOCK ?
	       &looks[element - FIRST_BLOCK] : NULL;
}

static const struct classic_blocks *blocks_of(const struct classic_project *project,
					      int element)
{
	switch (element) {
	case 10: return &project->timer;
	case 11: return &project->monostable;
	case 12: return &project->counter;
	case 13: return &project->iec_timer;
	default: return &project->reg;
	}
}

/* "TON", "1.5 s" */
static void describe(const struct classic_scene *scene, const struct classic_cell *cell,
		     char *kind, char *preset, gsize size)
{
	static const char *const timers[] = { "TON", "TOF", "TP" };
	const struct classic_block *block = classic_block(
		blocks_of(scene->project, cell->element), cell->variable.number);

	*preset = '\0';
	g_strlcpy(kind, look_of(cell->element)->name, size);
	if (!block)
		return;
	if (cell->element == 13 && block->mode >= 0 && block->mode < 3)
		g_strlcpy(kind, timers[block->mode], size);
	if (cell->element == 14)
		g_strlcpy(kind, block->mode == 2 ? "LIFO" : "FIFO", size);
	else if (cell->element == 12)
		g_snprintf(preset, size, "%d", block->preset);
	else if (block->base == 2)
		g_snprintf(preset, size, "%d.%d s", block->preset / 10, block->preset % 10);
	else
		g_snprintf(preset, size, "%d %s", block->preset, block->base ? "s" : "min");
}

static void put_pins(const struct sketch *sketch, const struct block_look *look, int y,
		     float from, float to)
{
	for (int i = 0; i < look->rows && y + i < CLASSIC_ROWS; i++) {
		const float wire = wire_of(y + i);

		if (look->input[i]) {
			put_line(sketch, from, wire, from + 10, wire);
			put_text(sketch, TOKEN_INK, LETTER_PIN, look->input[i], from + 15,
				 wire + 4, 1, 0);
		}
		if (look->output[i]) {
			put_line(sketch, to - 10, wire, to, wire);
			put_text(sketch, TOKEN_INK, LETTER_PIN, look->output[i], to - 15,
				 wire + 4, -1, 0);
		}
	}
}

static void put_block(struct sketch *sketch, int y, int x, const struct block_look *look)
{
	const struct classic_cell *cell = cell_at(sketch, y, x);
	const int first = MAX(x - 1, 0), rows = MIN(look->rows, CLASSIC_ROWS - y);
	const float from = left_of(first), to = left_of(x + 1), middle = (from + to) / 2;
	const float wire = wire_of(y), bound = to - from - 50;
	char name[CLASSIC_SAID], kind[24], preset[24];
	const char *symbol;

	classic_say_block(cell->element, cell->variable.number, name);
	symbol = classic_say_symbol(sketch->scene->project, name);
	describe(sketch->scene, cell, kind, preset, sizeof(kind));
	cover(sketch, y, first, rows, x - first + 1);
	put_frame(sketch, STROKE_SOLID, from + 10, wire - 13, to - 10,
		  wire_of(y + rows - 1) + 18);
	put_text(sketch, TOKEN_INK, LETTER_SYMBOL, *symbol ? symbol : name, middle,
		 wire - NAME_UP, 0, 2 * CELL_WIDTH - 8);
	put_text(sketch, TOKEN_INK, LETTER_TYPE, kind, middle, wire + 4, 0, bound);
	if (*symbol)
		put_text(sketch, TOKEN_COMMENT, LETTER_ADDRESS, name, middle, wire + 24, 0,
			 bound);
	put_text(sketch, TOKEN_INK, LETTER_OPERAND, preset, middle, wire + 48, 0, bound);
	put_pins(sketch, look, y, from, to);
}

/* ---- the rung ---- */

/* An element that never conducts: its number in a dotted frame. */
static void put_odd(const struct sketch *sketch, int y, int x, int element)
{
	const float wire = wire_of(y);
	char text[24];

	g_snprintf(text, sizeof(text), "%d", element);
	put_frame(sketch, STROKE_DOTTED, left_of(x) + 14, wire - 12,
		  left_of(x + 1) - 14, wire + 12);
	put_text(sketch, TOKEN_COMMENT, LETTER_OPERAND, text, left_of(x) + CELL_WIDTH / 2.0f,
		 wire + 4.5f, 0, CELL_WIDTH - 34);
}

static void put_cell(struct sketch *sketch, int y, int x)
{
	const int element = cell_at(sketch, y, x)->element;
	const char *strokes = strokes_of(element);

	if (strokes)
		put_element(sketch, y, x, strokes);
	else if (element == WIRE)
		put_line(sketch, left_of(x), wire_of(y), left_of(x + 1), wire_of(y));
	else if (element == COMPARE || element == OPERATE)
		put_expression(sketch, y, x);
	else if (look_of(element))
		put_block(sketch, y, x, look_of(element));
	else if (element && element != TAKEN)
		put_odd(sketch, y, x, element);
}

static void put_cells(struct sketch *sketch)
{
	for (int y = 0; y < sketch->rows; y++)
		for (int x = 0; x < sketch->columns; x++)
			put_cell(sketch, y, x);
	for (int y = 0; y < sketch->rows; y++)
		for (int x = 0; x < sketch->columns; x++) {
			if (y && x && cell_at(sketch, y, x)->top)
				put_line(sketch, left_of(x), wire_of(y - 1), left_of(x),
					 wire_of(y));
			if (cell_at(sketch, y, x)->element == TAKEN && !sketch->covered[y][x])
				put_odd(sketch, y, x, TAKEN);
		}
}

static void put_rails(const struct sketch *sketch, float bottom)
{
	const float right = left_of(sketch->columns);

	picture_line(sketch->nib.picture, TOKEN_IDLE, STROKE_SOLID,
		     sketch->nib.theme->rail_width, LEFT, HEADING, LEFT, bottom);
	picture_line(sketch->nib.picture, TOKEN_IDLE, STROKE_SOLID,
		     sketch->nib.theme->rail_width, right, HEADING, right, bottom);
}

float grid_classic_draw(const struct classic_scene *scene, struct picture *picture)
{
	struct sketch sketch = {
		.scene = scene, .columns = scene->rung->columns,
		.rows = rows_of(scene->rung),
		.nib = { picture, scene->theme, scene->lettering, TOKEN_INK },
	};
	const float bottom = HEADING + (float)(sketch.rows * CELL_HEIGHT);
	const float width = left_of(sketch.columns) + RIGHT;
	const char *label = scene->rung->label;
	float x = LEFT;

	put_cells(&sketch);
	put_rails(&sketch, bottom);
	if (*label) {
		put_text(&sketch, TOKEN_ACCENT, LETTER_OPERAND, label, x, 18, 1, 160);
		x += lettering_fit(scene->lettering, LETTER_OPERAND, label, -1, 160).width +
		     10;
	}
	put_text(&sketch, TOKEN_INK, LETTER_TITLE, scene->rung->comment, x, 18, 1,
		 width - x - RIGHT);
	picture->width = MAX(picture->width, width);
	return bottom + 8;
}

/* ---- original and import ---- */

/* "Here: Main, rungs 3 to 5" */
static char *name_ours(const struct classic_pair *pair)
{
	const char *pou = project_text(pair->project, pair->project->pou[pair->pou].name);
	const int first = pair->rung[0] + 1, last = pair->rung[pair->rungs - 1] + 1;

	if (pair->rungs == 1)
		return g_strdup_printf(_("Here: %s, rung %d"), pou, first);
	return g_strdup_printf(_("Here: %s, rungs %d to %d"), pou, first, last);
}

static void put_layout(const struct classic_pair *pair, const struct drafting *drafting,
		       struct rung_layout *layout, float y, struct picture *picture)
{
	const struct grid_scene scene = { .drafting = drafting, .layout = layout,
					  .theme = pair->there.theme };

	picture_move(picture, 0, y);
	grid_draw(&scene, picture);
	picture_move(picture, 0, 0);
	picture->width = MAX(picture->width, rung_layout_width(layout));
}

static float put_ours(const struct classic_pair *pair, float y, struct picture *picture)
{
	const struct pou *pou = &pair->project->pou[pair->pou];
	struct grid_names *names = grid_names_new(pair->project, pou);
	struct drafting drafting = { .project = pair->project, .names = names,
				     .lettering = pair->there.lettering,
				     .show = pair->show };
	struct rung_layout **layout = g_new0(struct rung_layout *, pair->rungs);
	float rails = 0;

	for (int i = 0; i < pair->rungs; i++)
		drafting.columns = MAX(drafting.columns,
				       rung_layout_columns(pou->rung[pair->rung[i]]));
	for (int i = 0; i < pair->rungs; i++) {
		layout[i] = rung_layout_new(&drafting, pou->rung[pair->rung[i]],
					    pair->rung[i] + 1, 0);
		rails = MAX(rails, layout[i]->natural);
	}
	for (int i = 0; i < pair->rungs; i++) {
		rung_layout_stretch(layout[i], rails);
		put_layout(pair, &drafting, layout[i], y, picture);
		y += layout[i]->height;
		rung_layout_free(layout[i]);
	}
	g_free(layout);
	grid_names_free(names);
	return y;
}

float grid_classic_here(const struct classic_pair *pair, float y, struct picture *picture)
{
	y += picture_caption(picture, pair->there.lettering, name_ours(pair), y);
	return put_ours(pair, y, picture);
}

float grid_classic_pair(const struct classic_pair *pair, float y, struct picture *picture)
{
	y += picture_caption(picture, pair->there.lettering, g_strdup_printf(_("ClassicLadder: %s"), pair->there_name), y);
	picture_move(picture, 0, y);
	y += grid_classic_draw(&pair->there, picture);
	picture_move(picture, 0, 0);
	if (pair->rungs > 0)
		y = grid_classic_here(pair, y, picture);
	else if (pair->lost)
		y += picture_caption(picture, pair->there.lettering, g_strdup(pair->lost), y);
	picture->height = MAX(picture->height, y + 4);
	return y + 4;
}
