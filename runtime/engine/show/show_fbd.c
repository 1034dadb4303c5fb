/* SPDX-License-Identifier: MIT
 *
 * show_fbd - draws the networks of a function block diagram in a terminal.
 *
 * The plan (fbd_plan.h) is in characters and lines. Boxes and wires are put on a canvas first, as wires turn; a
 * wire that crosses another one interrupts it, and ┼ is a branch.
 */
#include "engine/show/draw.h"

#include "engine/base/lex.h"
#include "engine/base/plain.h"
#include "engine/model/fbd.h"
#include "engine/model/st.h"
#include "engine/show/fbd_plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CELL_BYTES 8

/* A character; the one right of a wide character is empty. */
struct spot {
	char text[CELL_BYTES];   /* "": a blank, or a part of a wire          */
	int pin;                 /* of the wire: its output + 1; 0: none      */
	uint8_t arms;            /* JOIN_…                                    */
	bool feedback, covered;
};

struct canvas {
	const struct draw *draw;
	const struct fbd_graph *graph;
	struct fbd_plan plan;
	bool *on;                /* by pin: a BOOL that is TRUE; NULL: nothing runs */
	struct spot *place;
	int width, height;
};

static float measure(void *context, enum fbd_text kind, const char *text)
{
	const int width = draw_clipped(text, strlen(text), DRAW_CLIP);

	(void)context;
	return (float)(kind == FBD_TEXT_TARGET || kind == FBD_TEXT_TYPE ? width + 2 : width); /* blanks or corners */
}

/* Outside of the canvas: one that nobody sees. */
static struct spot *at(const struct canvas *canvas, int x, int y)
{
	const bool inside = x >= 0 && x < canvas->width && y >= 0 && y < canvas->height;

	return &canvas->place[inside ? y * canvas->width + x : canvas->width * canvas->height];
}

static void put(const struct canvas *canvas, int x, int y, const char *text, size_t len)
{
	struct spot *place = at(canvas, x, y);

	*place = (struct spot){ .covered = true };
	if (len < CELL_BYTES)
		memcpy(place->text, text, len);
}

static void put_glyph(const struct canvas *canvas, int x, int y, const char *glyph)
{
	put(canvas, x, y, glyph, strlen(glyph));
}

/* Writes a text, clipped as measure() clips it. Returns its columns. */
static int put_text(const struct canvas *canvas, int x, int y, const char *text)
{
	const size_t len = strlen(text);
	int room, column = 0;
	size_t fits = plain_clip(text, len, DRAW_CLIP, &room);
	const bool cut = fits < len;

	if (cut)
		fits = plain_clip(text, len, DRAW_CLIP - 1, &room);
	for (size_t i = 0; i < fits;) {
		const size_t bytes = utf8_length(text + i, fits - i);
		const size_t step = bytes ? bytes : 1;
		const int wide = utf8_width(text + i, step);
		const bool shown = bytes && (bytes > 1 || (text[i] >= ' ' && text[i] != 0x7f));

		if (wide > 0)
			put(canvas, x + column, y, shown ? text + i : "?", shown ? step : 1);
		if (wide == 2)
			put(canvas, x + column + 1, y, "", 0);
		column += wide;
		i += step;
	}
	if (cut)
		put_glyph(canvas, x + column++, y, canvas->draw->strokes->more);
	return column;
}

/* ---- wires ---- */

static void add_arms(const struct canvas *canvas, int x, int y, const struct fbd_segment *s, uint8_t arms)
{
	struct spot *place = at(canvas, x, y);

	if (place->pin && place->pin != s->pin + 1) {
		if (arms & (JOIN_LEFT | JOIN_RIGHT))
			return; /* below the upright one */
		place->arms = 0;
	}
	place->pin = s->pin + 1;
	place->arms |= arms;
	place->feedback = s->feedback;
}

static void put_wires(const struct canvas *canvas)
{
	for (int i = 0; i < canvas->plan.segment_count; i++) {
		const struct fbd_segment *s = &canvas->plan.segment[i];
		const int x1 = (int)s->x1, x2 = (int)s->x2;

		for (int x = x1; x <= x2 && s->row1 == s->row2; x++)
			add_arms(canvas, x, s->row1, s, (uint8_t)((x > x1 ? JOIN_LEFT : 0) |
				 (x < x2 ? JOIN_RIGHT : 0)));
		for (int y = s->row1; y <= s->row2 && s->row1 < s->row2; y++)
			add_arms(canvas, x1, y, s, (uint8_t)((y > s->row1 ? JOIN_UP : 0) |
				 (y < s->row2 ? JOIN_DOWN : 0)));
	}
}

/* The line of a wire or a pin. */
static const char *across(const struct canvas *canvas, int pin)
{
	return canvas->on && canvas->on[pin] ? canvas->draw->strokes->powered : canvas->draw->strokes->across;
}

static const char *wire_glyph(const struct canvas *canvas, const struct spot *place)
{
	const bool ascii = canvas->draw->options && canvas->draw->options->ascii;

	if (place->feedback && (place->arms & ~(JOIN_LEFT | JOIN_RIGHT)) == 0)
		return ascii ? "." : "┄";
	if (place->feedback && (place->arms & ~(JOIN_UP | JOIN_DOWN)) == 0)
		return ascii ? ":" : "┆";
	if ((place->arms & ~(JOIN_LEFT | JOIN_RIGHT)) == 0)
		return across(canvas, place->pin - 1);
	return canvas->draw->strokes->joint[place->arms];
}

/* ---- boxes ---- */

static int glyphs(const struct canvas *canvas, int x, int y, const char *glyph, int count)
{
	for (int i = 0; i < count; i++)
		put_glyph(canvas, x + i, y, glyph);
	return count;
}

/* ┌ TON ┐3 */
static void put_edge(const struct canvas *canvas, int x, int y, int width, const char *title, int corner)
{
	const struct strokes *strokes = canvas->draw->strokes;
	const int taken = *title ? (int)measure(NULL, FBD_TEXT_TYPE, title) : 0;
	const int before = (width - 2 - taken) / 2;

	put_glyph(canvas, x, y, strokes->corner[corner]);
	glyphs(canvas, x + 1, y, strokes->across, width - 2);
	if (taken) {
		put_glyph(canvas, x + 1 + before, y, " ");
		put_text(canvas, x + 2 + before, y, title);
		put_glyph(canvas, x + before + taken, y, " ");
	}
	put_glyph(canvas, x + width - 1, y, strokes->corner[corner + 1]);
}

static void put_operand(const struct canvas *canvas, int index, int x, int y)
{
	const struct fbd_pin *pin = &canvas->graph->pin[index];
	const int width = (int)measure(NULL, FBD_TEXT_OPERAND, pin->operand);

	if (pin->output) {
		put_glyph(canvas, x, y, across(canvas, index));
		put_text(canvas, x + (pin->wire < 0 ? 2 : 1), y, pin->operand);
		return;
	}
	put_glyph(canvas, x - 1, y, across(canvas, index));
	put_text(canvas, x - 2 - width, y, pin->operand);
}

static void put_pin(const struct canvas *canvas, int index)
{
	const struct fbd_pin *pin = &canvas->graph->pin[index];
	const struct strokes *strokes = canvas->draw->strokes;
	const int x = (int)canvas->plan.pin[index].x, y = canvas->plan.pin[index].row;
	const int width = (int)measure(NULL, FBD_TEXT_PIN, pin->name);
	const bool value = canvas->graph->box[pin->box].kind == FBD_VALUE;

	if (!value)
		put_text(canvas, pin->output ? x - 1 - width : x + 1, y, pin->name);
	if (!value && !pin->open && !fbd_is_end(&canvas->graph->box[pin->box]))
		put_glyph(canvas, pin->output ? x - 1 : x, y, pin->output ? strokes->close : strokes->open);
	if (pin->operand)
		put_operand(canvas, index, x, y);
	if (pin->output && pin->wire >= 0 && !at(canvas, x, y)->pin) /* nobody reads it */
		put_glyph(canvas, x, y, across(canvas, index));
	if (pin->output && pin->wire >= 0)
		for (int i = 0, column = x + 1 + pin->negated; i < canvas->graph->wire_count; i++) {
			const struct fbd_wire *wire = &canvas->graph->wire[i];

			if (wire->from_pin == index && wire->name)
				column += put_text(canvas, column, y, wire->name) + 1;
		}
	if (pin->negated)
		put_glyph(canvas, pin->output ? x : x - 1, y, "o");
}

static void put_end(const struct canvas *canvas, const struct fbd_box *box, const struct fbd_at *place)
{
	const bool square = box->kind == FBD_STORE || box->kind == FBD_SET || box->kind == FBD_RESET;
	int x = (int)place->x;

	put_glyph(canvas, x++, place->first, square ? "[" : box->kind != FBD_JUMP ? "<" : " ");
	if (square && !*box->type)
		put_glyph(canvas, x++, place->first, " ");
	x += put_text(canvas, x, place->first, box->type);
	if (*box->type && box->target)
		put_glyph(canvas, x++, place->first, " ");
	if (box->target)
		x += put_text(canvas, x, place->first, box->target);
	if (square)
		put_glyph(canvas, x++, place->first, " ");
	if (box->kind != FBD_JUMP)
		put_glyph(canvas, x, place->first, square ? "]" : ">");
}

static void put_box(const struct canvas *canvas, int index)
{
	const struct fbd_box *box = &canvas->graph->box[index];
	const struct fbd_at *place = &canvas->plan.box[index];
	const int x = (int)place->x, width = (int)place->width;
	const int top = place->first - 1, bottom = place->first + place->rows + 1;

	if (fbd_is_end(box)) {
		put_end(canvas, box, place);
	} else if (box->kind != FBD_VALUE) {
		char number[8];

		put_edge(canvas, x, top, width, fbd_box_title(box), 0);
		put_edge(canvas, x, bottom, width, "", 2);
		for (int y = top + 1; y < bottom; y++) {
			put_glyph(canvas, x, y, canvas->draw->strokes->side);
			glyphs(canvas, x + 1, y, " ", width - 2);
			put_glyph(canvas, x + width - 1, y, canvas->draw->strokes->side);
		}
		if (box->instance)
			put_text(canvas, x + (width - (int)measure(NULL, FBD_TEXT_INSTANCE, box->instance)) / 2,
				 top - 1, box->instance);
		snprintf(number, sizeof(number), "%d", box->order);
		put_text(canvas, x + width, top, number);
	}
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		put_pin(canvas, i);
}

/* ---- */

static void write_line(const struct canvas *canvas, int y)
{
	const struct sink *sink = canvas->draw->sink;
	int blanks = 0, end = 0;

	for (int x = 0; x < canvas->width; x++)
		if (*at(canvas, x, y)->text > ' ' || (uint8_t)*at(canvas, x, y)->text > 0x7f || at(canvas, x, y)->pin)
			end = x + 1;
	blanks = end ? canvas->draw->margin + 1 : 0;
	for (int x = 0; x < end; x++) {
		const struct spot *place = at(canvas, x, y);
		const char *text = place->pin ? wire_glyph(canvas, place) : place->text;

		if (!*text && place->covered)
			continue; /* behind a wide character */
		if (!*text) {
			blanks++;
			continue;
		}
		draw_blank(canvas->draw, blanks);
		blanks = 0;
		sink_text(sink, text);
	}
	sink_text(sink, "\n");
}

static void write_comment(const struct draw *draw, uint32_t comment)
{
	const char *text = project_text(draw->project, comment), *line;
	size_t len;

	while ((line = plain_comment_line(&text, &len))) {
		draw_blank(draw, draw->margin + 2);
		plain_write(draw->sink, line, len);
		sink_text(draw->sink, "\n");
	}
}

static void write_heading(const struct canvas *canvas, const struct pou *pou, const struct fbd_network *network)
{
	const struct draw *draw = canvas->draw;
	const char *label = project_text(draw->project, network->label);
	const char *title = project_text(draw->project, network->title);

	sink_printf(draw->sink, "%*d", draw->margin, draw->number);
	sink_text(draw->sink, *label || *title || network->off ? "  " : "");
	plain_text(draw->sink, label);
	sink_text(draw->sink, *label && *title ? ": " : "");
	plain_text(draw->sink, title);
	if (network->off)
		sink_text(draw->sink, *label || *title ? " [OFF]" : "[OFF]");
	sink_text(draw->sink, "\n");
	write_comment(draw, network->comment);
	for (int i = 0; i < canvas->graph->note_count; i++)
		write_comment(draw, pou->st->item[canvas->graph->note[i]].text);
}

static bool draw_canvas(struct canvas *canvas, const struct pou *pou, const struct fbd_network *network)
{
	canvas->width = (int)canvas->plan.width + 4;
	canvas->height = canvas->plan.rows;
	canvas->place = calloc((size_t)canvas->width * (size_t)canvas->height + 1, sizeof(*canvas->place));
	if (!canvas->place)
		return false;
	put_wires(canvas);
	for (int i = 0; i < canvas->graph->box_count; i++)
		put_box(canvas, i);
	write_heading(canvas, pou, network);
	for (int y = 0; y < canvas->height; y++)
		write_line(canvas, y);
	free(canvas->place);
	return true;
}

/* ---- values ---- */

/* "Level=10", "=10"; @text if memory is out. */
static const char *with_value(struct fbd_graph *graph, const char *text, const char *value)
{
	const size_t room = strlen(text) + strlen(value) + 2;
	char *out = arena_alloc(&graph->arena, room);

	if (out)
		snprintf(out, room, "%s=%s", text, value);
	return out ? out : text;
}

/* At the name of what has it. A result without a name has its value as one. */
static void put_value(struct fbd_graph *graph, int index, const char *value)
{
	struct fbd_pin *pin = &graph->pin[index];
	bool named = false;

	if (pin->operand && strcmp(pin->operand, value) != 0)
		pin->operand = with_value(graph, pin->operand, value);
	else if (fbd_pin_shows_value(pin))
		pin->operand = with_value(graph, "", value);
	if (pin->operand || !pin->output)
		return;
	for (int i = 0; i < graph->wire_count && !named; i++) {
		struct fbd_wire *wire = &graph->wire[i];

		if (wire->from_pin != index)
			continue;
		wire->name = with_value(graph, wire->name ? wire->name : "", value);
		named = true;
	}
}

/* All values first: their texts change the names. */
static bool look(struct canvas *canvas, struct fbd_graph *graph, int index)
{
	const struct draw *draw = canvas->draw;
	const struct show_options *options = draw->options;
	const size_t pins = (size_t)graph->pin_count + 1;
	const char **value;
	char *text;

	if (!options || !options->pin)
		return true;
	text = arena_alloc(&graph->arena, IEC_VALUE_TEXT);
	canvas->on = arena_alloc(&graph->arena, pins);
	value = arena_alloc(&graph->arena, pins * sizeof(*value));
	if (!text || !canvas->on || !value)
		return false;
	for (int i = 0; i < graph->pin_count; i++)
		if (options->pin(options->context, draw->pou, index, graph, i, text, IEC_VALUE_TEXT,
				 &canvas->on[i]) && *text)
			value[i] = with_value(graph, "", text) + 1;
	for (int i = 0; i < graph->pin_count; i++)
		if (value[i])
			put_value(graph, i, value[i]);
	return true;
}

bool draw_network(struct draw *draw, const struct pou *pou, int index)
{
	static const struct fbd_metrics metrics = {
		.width = measure, .head = 1, .instance = 1, .foot = 1, .end_head = 0, .end_foot = 0, .pad = 1,
		.middle = 2, .least = 5, .end_least = 3, .stub = 2, .circle = 1, .tail = 2, .side = 2, .track = 2,
	};
	struct fbd_graph graph;
	struct canvas canvas = { .draw = draw, .graph = &graph };
	bool good;

	if (!fbd_graph_make(draw->project, pou, index, &graph))
		return false;
	good = look(&canvas, &graph, index) && fbd_plan_make(&graph, &metrics, &canvas.plan);
	if (good)
		good = draw_canvas(&canvas, pou, &pou->fbd->network[index]);
	fbd_plan_free(&canvas.plan);
	fbd_graph_free(&graph);
	return good;
}
