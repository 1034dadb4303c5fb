/* SPDX-License-Identifier: MIT
 *
 * show_sfc - draws a chart as text: boxes, lines, actions, conditions.
 *
 * Each lane has its own columns: left of its line half the width of its widest box,
 * right of it the width of its longest text. Every row is written from left to right.
 * Conditions and actions that are rungs or lists follow below, under their names.
 */
#include "engine/show/draw.h"
#include "engine/base/plain.h"
#include "engine/show/sfc_words.h"

#include <stdlib.h>
#include <string.h>

#define GAP      3   /* columns between lanes                                   */
#define LEAD     2   /* columns between a box and its actions                   */
#define CLIP_SFC 60  /* columns of a text                                       */

struct edges {               /* of a box                                       */
	const char *corner[4], *across, *side, *up, *down, *does;
};
struct sfc_strokes {
	struct edges step[3];    /* by enum step_kind                          */
	const char *twin, *twin_up, *twin_down, *twin_both;
	const char *arrow, *arrow_on; /* to a step; to a transition             */
	const char *token;       /* of an active step                          */
};
static const struct sfc_strokes unicode = {
	.step = {
		{ { "┌", "┐", "└", "┘" }, "─", "│", "┴", "┬", "├" },
		{ { "╔", "╗", "╚", "╝" }, "═", "║", "╧", "╤", "╟" },
		{ { "╒", "╕", "╘", "╛" }, "═", "│", "╧", "╤", "├" },
	},
	.twin = "═", .twin_up = "╧", .twin_down = "╤", .twin_both = "╪",
	.arrow = "▼", .arrow_on = "▽", .token = "● ",
};
static const struct sfc_strokes ascii = {
	.step = {
		{ { "+", "+", "+", "+" }, "-", "|", "+", "+", "|" },
		{ { "#", "#", "#", "#" }, "#", "#", "#", "#", "#" },
		{ { "+", "+", "+", "+" }, "=", "|", "+", "+", "|" },
	},
	.twin = "=", .twin_up = "+", .twin_down = "+", .twin_both = "+",
	.arrow = "v", .arrow_on = "V", .token = "* ",
};

struct words { const char *text; size_t len; int columns; };

struct lane {
	int left;                /* columns left of its line                   */
	int inner;               /* columns inside of its boxes                */
	int right;
	int x;                   /* column of its line                         */
	int shape, shape_end;    /* of layout->sorted: the next one            */
	int down, down_end;      /* of sketch.down: the next one               */
};

struct sketch {
	const struct draw *draw;
	const struct pou *pou;
	const struct sfc_layout *layout;
	const struct sfc_strokes *strokes;
	struct arena arena;
	struct words *shape;     /* by shape                                   */
	struct words *times;     /* by step                                    */
	struct words *what, *does; /* by use: qualifier, name                  */
	bool *active;            /* by step                                    */
	struct lane *lane;
	struct sfc_wire *down, *across; /* by lane and row; by row and lane    */
	int down_count, across_count;
	int next_across;
	int column;              /* terminal column that is written next      */
};

/* ---- texts ---- */

static const char *plainly(const struct sketch *sketch, const char *text, size_t *len)
{
	static const char *const pair[][2] = {
		{ "\xe2\x89\xa5", ">=" }, { "\xe2\x89\xa4", "<=" },
		{ "\xe2\x86\x92", "->" },
	};
	char *copy = arena_copy((struct arena *)&sketch->arena, text, *len);

	for (size_t i = 0; copy && sketch->strokes == &ascii &&
	     i < sizeof(pair) / sizeof(pair[0]); i++)
		for (char *at; (at = strstr(copy, pair[i][0])) != NULL; (*len)--) {
			memcpy(at, pair[i][1], 2);
			memmove(at + 2, at + 3, strlen(at + 3) + 1);
		}
	return copy;
}

static struct words keep(struct sketch *sketch, struct sink_memory *memory)
{
	struct words words = { "", memory->len, 0 };

	if (memory->len)
		words.text = plainly(sketch, memory->text, &words.len);
	if (!words.text || memory->failed)
		return (struct words){ "", 0, 0 };
	words.columns = draw_clipped(words.text, words.len, CLIP_SFC);
	memory->len = 0;
	return words;
}

/* An active step has a mark and its time at its name. */
static void put_name(struct sketch *sketch, int shape, const struct sink *sink)
{
	const struct sfc_shape *s = &sketch->layout->shape[shape];
	const struct show_options *options = sketch->draw->options;
	char time[48] = "";

	if (s->part == SFC_STEP && options && options->step)
		sketch->active[s->index] = options->step(options->context,
			sketch->draw->pou, s->index, time, sizeof(time));
	if (s->part == SFC_STEP && sketch->active[s->index])
		sink_text(sink, sketch->strokes->token);
	sfc_words_shape(sketch->draw->project, sketch->pou, sketch->layout, shape, sink);
	sink_text(sink, *time ? " " : "");
	sink_text(sink, time);
}

static bool make_texts(struct sketch *sketch)
{
	const struct project *project = sketch->draw->project;
	const struct sfc *sfc = sketch->layout->sfc;
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	for (int i = 0; i < sketch->layout->shape_count; i++) {
		put_name(sketch, i, &sink);
		sketch->shape[i] = keep(sketch, &memory);
	}
	for (int i = 0; i < sfc->step_count; i++) {
		sfc_words_times(project, sfc, i, &sink);
		sketch->times[i] = keep(sketch, &memory);
	}
	for (int i = 0; i < sfc->use_count; i++) {
		sfc_words_qualifier(project, sfc, i, &sink);
		sketch->what[i] = keep(sketch, &memory);
		sink_text(&sink, project_text(project, sfc->use[i].operand));
		sketch->does[i] = keep(sketch, &memory);
	}
	bool good = !memory.failed && !sketch->arena.failed;
	sink_memory_free(&memory);
	return good;
}

/* ---- measuring ---- */

struct table { int what, does; }; /* columns of the texts                     */

static struct table table_of(const struct sketch *sketch, int step)
{
	const struct sfc_step *s = &sketch->layout->sfc->step[step];
	struct table table = { 0, 0 };

	for (int i = s->first_use; i < s->first_use + s->use_count; i++) {
		if (sketch->what[i].columns > table.what)
			table.what = sketch->what[i].columns;
		if (sketch->does[i].columns > table.does)
			table.does = sketch->does[i].columns;
	}
	return table;
}

static int most(int a, int b)
{
	return a > b ? a : b;
}

static void measure(struct sketch *sketch)
{
	const struct sfc_layout *layout = sketch->layout;
	int x = sketch->draw->margin;

	for (int i = 0; i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];
		struct lane *lane = &sketch->lane[shape->lane];
		int columns = sketch->shape[i].columns;

		if (shape->part == SFC_STEP)
			lane->inner = most(lane->inner, most(columns,
					   sketch->times[i].columns) + 2);
		else
			lane->right = most(lane->right, columns + 2);
	}
	for (int l = 0; l < layout->lanes; l++) {
		struct lane *lane = &sketch->lane[l];

		if (lane->inner)
			lane->inner = most(lane->inner | 1, 7);
		lane->left = lane->inner ? lane->inner / 2 + 1 : 1;
		lane->right = most(lane->right, lane->left);
	}
	for (int s = 0; s < layout->sfc->step_count; s++) {
		const struct table table = table_of(sketch, s);
		struct lane *lane = &sketch->lane[layout->shape[s].lane];

		if (layout->sfc->step[s].use_count)
			lane->right = most(lane->right, lane->left + LEAD + table.what +
					   table.does + 7);
	}
	for (int l = 0; l < layout->lanes; l++) {
		sketch->lane[l].x = x + sketch->lane[l].left;
		x += sketch->lane[l].left + 1 + sketch->lane[l].right + GAP;
	}
}

/* ---- lines ---- */

static int compare_down(const void *a, const void *b)
{
	const struct sfc_wire *x = a, *y = b;

	if (x->lane != y->lane)
		return x->lane < y->lane ? -1 : 1;
	return x->row < y->row ? -1 : x->row > y->row;
}

static int compare_across(const void *a, const void *b)
{
	const struct sfc_wire *x = a, *y = b;

	if (x->row != y->row)
		return x->row < y->row ? -1 : 1;
	return x->lane < y->lane ? -1 : x->lane > y->lane;
}

static void sort_wires(struct sketch *sketch)
{
	const struct sfc_layout *layout = sketch->layout;

	for (int i = 0; i < layout->wire_count; i++)
		if (layout->wire[i].lane == layout->wire[i].end_lane)
			sketch->down[sketch->down_count++] = layout->wire[i];
		else
			sketch->across[sketch->across_count++] = layout->wire[i];
	qsort(sketch->down, (size_t)sketch->down_count, sizeof(*sketch->down),
	      compare_down);
	qsort(sketch->across, (size_t)sketch->across_count, sizeof(*sketch->across),
	      compare_across);
	for (int i = sketch->down_count - 1; i >= 0; i--) {
		struct lane *lane = &sketch->lane[sketch->down[i].lane];

		lane->down = i;
		lane->down_end = lane->down_end ? lane->down_end : i + 1;
	}
	for (int i = layout->shape_count - 1; i >= 0; i--) {
		struct lane *lane = &sketch->lane[layout->shape[layout->sorted[i]].lane];

		lane->shape = i;
		lane->shape_end = lane->shape_end ? lane->shape_end : i + 1;
	}
}

/* JOIN_UP and JOIN_DOWN: where lines lead from this place along its lane. */
static unsigned ways_at(struct sketch *sketch, int l, int row)
{
	struct lane *lane = &sketch->lane[l];
	unsigned ways = 0;

	while (lane->down < lane->down_end && sketch->down[lane->down].end_row < row)
		lane->down++;
	for (int i = lane->down; i < lane->down_end && sketch->down[i].row <= row; i++) {
		ways |= sketch->down[i].row < row ? JOIN_UP : 0;
		ways |= sketch->down[i].end_row > row ? JOIN_DOWN : 0;
	}
	return ways;
}

/* ---- writing ---- */

static void put(struct sketch *sketch, const char *text, int count)
{
	sink_repeat(sketch->draw->sink, text, count);
	sketch->column += count;
}

static void put_to(struct sketch *sketch, int column)
{
	if (column > sketch->column)
		put(sketch, " ", column - sketch->column);
}

static void put_words(struct sketch *sketch, struct words words)
{
	sketch->column += draw_text(sketch->draw, words.text, words.len, CLIP_SFC);
}

static void put_edge(struct sketch *sketch, const struct edges *edges, bool top,
		     int inner, bool joined)
{
	put(sketch, edges->corner[top ? 0 : 2], 1);
	put(sketch, edges->across, inner / 2);
	put(sketch, !joined ? edges->across : top ? edges->up : edges->down, 1);
	put(sketch, edges->across, inner / 2);
	put(sketch, edges->corner[top ? 1 : 3], 1);
}

/* A line of the table of a step's actions: -1 and count are its edges. */
static void put_table(struct sketch *sketch, int step, int line)
{
	const struct sfc_step *s = &sketch->layout->sfc->step[step];
	const struct table table = table_of(sketch, step);
	const struct strokes *strokes = sketch->draw->strokes;
	const int use = s->first_use + line, start = sketch->column;
	const bool edge = line < 0 || line == s->use_count;
	const int down = line < 0 ? JOIN_DOWN : JOIN_UP;

	if (!s->use_count || line > s->use_count)
		return;
	put(sketch, line == 0 ? strokes->across : " ", LEAD);
	if (edge) {
		put(sketch, strokes->corner[line < 0 ? 0 : 2], 1);
		put(sketch, strokes->across, table.what + 2);
		put(sketch, strokes->joint[down | JOIN_LEFT | JOIN_RIGHT], 1);
		put(sketch, strokes->across, table.does + 2);
		put(sketch, strokes->corner[line < 0 ? 1 : 3], 1);
		return;
	}
	put(sketch, line == 0 ? strokes->open : strokes->side, 1);
	put(sketch, " ", 1);
	put_words(sketch, sketch->what[use]);
	put_to(sketch, start + LEAD + 3 + table.what);
	put(sketch, strokes->side, 1);
	put(sketch, " ", 1);
	put_words(sketch, sketch->does[use]);
	put_to(sketch, start + LEAD + 6 + table.what + table.does);
	put(sketch, strokes->side, 1);
}

static void put_step(struct sketch *sketch, int step, int row, unsigned ways)
{
	const struct sfc_shape *shape = sfc_layout_step(sketch->layout, step);
	const struct lane *lane = &sketch->lane[shape->lane];
	const struct sfc_step *s = &sketch->layout->sfc->step[step];
	const struct edges *edges = &sketch->strokes->step[s->kind];
	const int line = row - shape->top - 1, start = lane->x - lane->left;
	struct words words = { "", 0, 0 };

	put_to(sketch, start);
	if (row == shape->top || row == shape->bottom) {
		put_edge(sketch, edges, row == shape->top, lane->inner, ways != 0);
	} else {
		if (line < 2)
			words = line ? sketch->times[step] : sketch->shape[step];
		put(sketch, edges->side, 1);
		put_to(sketch, start + 1 + (lane->inner - words.columns) / 2);
		put_words(sketch, words);
		put_to(sketch, start + 1 + lane->inner);
		put(sketch, line == 0 && s->use_count ? edges->does : edges->side, 1);
	}
	put_table(sketch, step, line);
}

/* Whether all steps before it are active. */
static bool is_enabled(const struct sketch *sketch, int transition)
{
	const struct sfc *sfc = sketch->layout->sfc;
	const struct sfc_transition *t = &sfc->transition[transition];
	bool enabled = t->from_count > 0;

	for (int i = t->first_from; i < t->first_from + t->from_count; i++)
		enabled = enabled && sfc->ref[i].step >= 0 &&
			  sketch->active[sfc->ref[i].step];
	return enabled;
}

static void put_transition(struct sketch *sketch, int shape, unsigned ways)
{
	const struct strokes *strokes = sketch->draw->strokes;
	const char *bar = is_enabled(sketch, sketch->layout->shape[shape].index) ?
			  strokes->powered : strokes->across;
	const struct lane *lane = &sketch->lane[sketch->layout->shape[shape].lane];

	put_to(sketch, lane->x - 1);
	put(sketch, bar, 1);
	put(sketch, strokes->joint[ways | JOIN_LEFT | JOIN_RIGHT], 1);
	put(sketch, bar, 1);
	put(sketch, " ", 1);
	put_words(sketch, sketch->shape[shape]);
}

static void put_shape(struct sketch *sketch, int shape, int row, unsigned ways)
{
	const struct sfc_shape *s = &sketch->layout->shape[shape];

	if (s->part == SFC_STEP) {
		put_step(sketch, s->index, row, ways);
	} else if (s->part == SFC_TRANSITION) {
		put_transition(sketch, shape, ways);
	} else {
		put_to(sketch, sketch->lane[s->lane].x);
		put(sketch, sketch->layout->jump[s->index].to_transition ?
		    sketch->strokes->arrow_on : sketch->strokes->arrow, 1);
		put(sketch, " ", 1);
		put_words(sketch, sketch->shape[shape]);
	}
}

/* The shape that covers this place; -1: none. */
static int shape_at(struct sketch *sketch, int l, int row)
{
	const struct sfc_layout *layout = sketch->layout;
	struct lane *lane = &sketch->lane[l];

	while (lane->shape < lane->shape_end &&
	       layout->shape[layout->sorted[lane->shape]].bottom < row)
		lane->shape++;
	if (lane->shape == lane->shape_end ||
	    layout->shape[layout->sorted[lane->shape]].top > row)
		return -1;
	return layout->sorted[lane->shape];
}

static void put_twin(struct sketch *sketch, const struct sfc_wire *wire, int l,
		     unsigned ways)
{
	const struct sfc_strokes *strokes = sketch->strokes;
	const bool up = ways & JOIN_UP, down = ways & JOIN_DOWN;

	if (l == wire->lane) {
		put_to(sketch, sketch->lane[l].x - 1);
		put(sketch, strokes->twin, 1);
	}
	put(sketch, up && down ? strokes->twin_both : up ? strokes->twin_up :
	    down ? strokes->twin_down : strokes->twin, 1);
	if (l == wire->end_lane)
		put(sketch, strokes->twin, 1);
	else
		put(sketch, strokes->twin, sketch->lane[l + 1].x - sketch->column);
}

static void put_line(struct sketch *sketch, const struct sfc_wire *wire, int l,
		     unsigned ways)
{
	const struct strokes *strokes = sketch->draw->strokes;

	if (wire && wire->twin) {
		put_twin(sketch, wire, l, ways);
		return;
	}
	if (wire)
		ways |= (l > wire->lane ? JOIN_LEFT : 0) |
			(l < wire->end_lane ? JOIN_RIGHT : 0);
	if (!ways)
		return;
	put_to(sketch, sketch->lane[l].x);
	put(sketch, strokes->joint[ways], 1);
	if (wire && l < wire->end_lane)
		put(sketch, strokes->across, sketch->lane[l + 1].x - sketch->column);
}

static void put_row(struct sketch *sketch, int row)
{
	sketch->column = 0;
	for (int l = 0; l < sketch->layout->lanes; l++) {
		const struct sfc_wire *wire = &sketch->across[sketch->next_across];
		const unsigned ways = ways_at(sketch, l, row);
		const int shape = shape_at(sketch, l, row);
		const bool on = sketch->next_across < sketch->across_count &&
				wire->row == row && wire->lane <= l;

		if (shape >= 0)
			put_shape(sketch, shape, row, ways);
		else
			put_line(sketch, on ? wire : NULL, l, ways);
		if (on && wire->end_lane == l)
			sketch->next_across++;
	}
	sink_text(sketch->draw->sink, "\n");
}

/* ---- rungs and lists below ---- */

static void put_body(const struct sketch *sketch, struct draw *draw,
		     const struct sfc_body *body)
{
	const struct pou *pou = sketch->pou;

	if (body->kind == BODY_LIST || body->kind == BODY_ST) {
		sfc_words_list(draw->project, pou, body, draw->sink);
		return;
	}
	for (int i = body->first; i < body->first + body->count; i++) {
		if (i > body->first)
			sink_text(draw->sink, "\n");
		draw->rung = pou->rung[i];
		draw->number = i + 1;
		draw_rung(draw);
	}
}

static void put_bodies(struct sketch *sketch, struct draw *draw)
{
	const struct sfc *sfc = sketch->layout->sfc;
	struct sink_memory memory;
	const struct sink sink = sink_to_memory(&memory);

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		if (t->condition.kind != BODY_RUNGS && t->condition.kind != BODY_LIST)
			continue;
		sink_memory_init(&memory);
		sfc_words_ways(draw->project, sfc, i, &sink);
		struct words ways = keep(sketch, &memory);
		sink_memory_free(&memory);
		sink_text(draw->sink, "\nTRANSITION ");
		plain_text(draw->sink, project_text(draw->project, t->name));
		sink_text(draw->sink, t->name ? ": " : "");
		plain_write(draw->sink, ways.text, ways.len);
		sink_text(draw->sink, "\n\n");
		put_body(sketch, draw, &t->condition);
	}
	for (int i = 0; i < sfc->action_count; i++) {
		sink_text(draw->sink, "\nACTION ");
		plain_text(draw->sink, project_text(draw->project, sfc->action[i].name));
		sink_text(draw->sink, "\n\n");
		put_body(sketch, draw, &sfc->action[i].body);
	}
}

/* ---- */

static bool make_room(struct sketch *sketch)
{
	const struct sfc_layout *layout = sketch->layout;
	const struct sfc *sfc = layout->sfc;
	struct arena *arena = &sketch->arena;
	const size_t wires = (size_t)layout->wire_count + 1;

	sketch->shape = arena_alloc(arena, ((size_t)layout->shape_count + 1) *
				    sizeof(*sketch->shape));
	sketch->times = arena_alloc(arena, ((size_t)sfc->step_count + 1) *
				    sizeof(*sketch->times));
	sketch->what = arena_alloc(arena, ((size_t)sfc->use_count + 1) *
				   sizeof(*sketch->what));
	sketch->does = arena_alloc(arena, ((size_t)sfc->use_count + 1) *
				   sizeof(*sketch->does));
	sketch->active = arena_alloc(arena, ((size_t)sfc->step_count + 1) *
				     sizeof(*sketch->active));
	sketch->lane = arena_alloc(arena, ((size_t)layout->lanes + 1) *
				   sizeof(*sketch->lane));
	sketch->down = arena_alloc(arena, wires * sizeof(*sketch->down));
	sketch->across = arena_alloc(arena, wires * sizeof(*sketch->across));
	return !arena->failed;
}

static void put_sfc(struct sketch *sketch)
{
	const struct sfc_layout *layout = sketch->layout;

	measure(sketch);
	sort_wires(sketch);
	for (int i = 0; i < layout->frame_count; i++) {
		const struct sfc_frame *frame = &layout->frame[i];

		if (frame->title >= 0) {
			sink_text(sketch->draw->sink, "\nMACRO_STEP ");
			plain_text(sketch->draw->sink, project_text(
				sketch->draw->project,
				layout->sfc->step[frame->macro].name));
			sink_text(sketch->draw->sink, "\n\n");
		}
		for (int row = frame->top; row <= frame->bottom; row++)
			put_row(sketch, row);
	}
}

bool draw_sfc(struct draw *draw, const struct pou *pou)
{
	struct sfc_layout *layout = sfc_layout_new(pou->sfc);
	struct sketch sketch = { .draw = draw, .pou = pou, .layout = layout };
	bool good = false;

	if (!layout)
		return false;
	arena_init(&sketch.arena);
	sketch.strokes = draw->options && draw->options->ascii ? &ascii : &unicode;
	if (make_room(&sketch) && make_texts(&sketch)) {
		good = true;
		put_sfc(&sketch);
		put_bodies(&sketch, draw);
	}
	arena_free(&sketch.arena);
	sfc_layout_free(layout);
	return good;
}
