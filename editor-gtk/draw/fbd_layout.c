/* SPDX-License-Identifier: MIT
 *
 * fbd_layout - the plan of a network in pixels, with its heading; see fbd_layout.h.
 */
#include "editor-gtk/draw/fbd_layout.h"

#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/kit/comment_text.h"
#include "engine/model/fbd.h"
#include "engine/model/st.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define TITLE_LINE   26   /* baseline of the number and the title            */
#define HEADING      34   /* height of the heading, if it has a title         */
#define NO_HEADING   10
#define NOTE_LINE    17
#define NOTE_ROOM   700   /* px of a line of a comment, at least              */
#define BELOW        16   /* below the last row                              */
#define LEAST        84   /* height of a strip                               */
#define AHEAD        12   /* left of everything                              */

bool fbd_is_constant(const char *operand)
{
	return g_ascii_isdigit(*operand) || strchr("'\"-+#", *operand) || strchr(operand, '#') ||
	       g_ascii_strcasecmp(operand, "TRUE") == 0 || g_ascii_strcasecmp(operand, "FALSE") == 0;
}

enum letter fbd_operand_letter(const char *operand)
{
	return fbd_is_constant(operand) ? LETTER_OPERAND : LETTER_SYMBOL;
}

static float operand_width(struct lettering *lettering, const char *text)
{
	return ceilf(lettering_fit(lettering, fbd_operand_letter(text), text, -1, LABEL_BOUND).width);
}

static float measure(void *context, enum fbd_text kind, const char *text)
{
	static const struct { enum letter letter; float bound; } rows[] = {
		[FBD_TEXT_TYPE] = { LETTER_TYPE, FBD_TYPE_BOUND },
		[FBD_TEXT_INSTANCE] = { LETTER_SYMBOL, LABEL_BOUND },
		[FBD_TEXT_PIN] = { LETTER_PIN, FBD_PIN_BOUND },
		[FBD_TEXT_TARGET] = { LETTER_SYMBOL, LABEL_BOUND },
		[FBD_TEXT_WIRE] = { LETTER_PIN, FBD_PIN_BOUND },
	};
	float width;

	if (kind == FBD_TEXT_OPERAND && fbd_is_constant(text))
		return operand_width(context, text);
	if (kind == FBD_TEXT_OPERAND) /* its value stands above it */
		return MAX(operand_width(context, text), FBD_VALUE_BOUND - 8);
	width = ceilf(lettering_fit(context, rows[kind].letter, text, -1, rows[kind].bound).width);
	return kind == FBD_TEXT_WIRE ? width + FBD_VALUE_BOUND - 16 : width;
}

static bool make_plan(struct fbd_layout *layout)
{
	const struct fbd_metrics metrics = {
		.width = measure, .context = layout->lettering, .head = 2, .instance = 1, .foot = 1,
		.end_head = 1, .end_foot = 0, .pad = 7, .middle = 16, .least = 64, .end_least = 84,
		.stub = FBD_STUB, .circle = 2 * FBD_CIRCLE, .tail = FBD_VALUE_BOUND - 10, .side = 16, .track = 11,
	};

	return fbd_plan_make(&layout->graph, &metrics, &layout->plan);
}

/* ---- heading ---- */

static void add_note(GPtrArray *lines, struct lettering *lettering, const char *comment, float room)
{
	char *text = comment_text(comment);
	const char *at = text;

	while (*at) {
		const struct lettered line = lettering_line(lettering, LETTER_COMMENT, &at, room, false);

		g_ptr_array_add(lines, g_strdup(line.text));
	}
	g_free(text);
}

/* Comments above the network, and between its lines. */
static void take_notes(struct fbd_layout *layout, const struct project *project, const struct pou *pou)
{
	GPtrArray *lines = g_ptr_array_new();
	const float room = MAX(layout->plan.width, NOTE_ROOM);

	add_note(lines, layout->lettering, project_text(project, layout->network->comment), room);
	for (int i = 0; i < layout->graph.note_count; i++)
		add_note(lines, layout->lettering,
			 project_text(project, pou->st->item[layout->graph.note[i]].text), room);
	g_ptr_array_add(lines, NULL);
	layout->note = (char **)g_ptr_array_free(lines, FALSE);
}

static void take_title(struct fbd_layout *layout, const struct project *project)
{
	const struct fbd_network *network = layout->network;
	char *label = network->label ? g_strdup_printf("%s:", project_text(project, network->label)) :
				       g_strdup("");

	layout->label = lettering_fit(layout->lettering, LETTER_OPERAND, label, -1, LABEL_BOUND);
	layout->title = lettering_fit(layout->lettering, LETTER_TITLE, project_text(project, network->title),
				      -1, 0);
	layout->title_x = RUNG_LEFT + (*label ? layout->label.width + TITLE_AIR : 0);
	g_free(label);
}

static void set_size(struct fbd_layout *layout)
{
	const bool headed = layout->network->label || layout->network->title;
	const float notes = (float)(g_strv_length(layout->note) * NOTE_LINE);

	layout->title_y = TITLE_LINE;
	layout->note_y = headed ? TITLE_LINE + NOTE_LINE : TITLE_LINE;
	layout->left = RUNG_LEFT + AHEAD;
	layout->top = (headed ? HEADING : notes > 0 ? HEADING - NOTE_LINE : NO_HEADING) + notes;
	layout->width = MAX(layout->left + layout->plan.width, layout->title_x + layout->title.width) +
			RUNG_AFTER;
	for (char **note = layout->note; *note; note++)
		layout->width = MAX(layout->width, RUNG_LEFT + RUNG_AFTER +
				    lettering_fit(layout->lettering, LETTER_COMMENT, *note, -1, 0).width);
	layout->height = MAX(layout->top + (float)(layout->plan.rows * FBD_ROW) + BELOW, LEAST);
}

struct fbd_layout *fbd_layout_new(const struct project *project, const struct pou *pou, int index,
				  struct lettering *lettering)
{
	struct fbd_layout *layout = g_new0(struct fbd_layout, 1);

	layout->network = &pou->fbd->network[index];
	layout->off = layout->network->off;
	layout->index = index;
	layout->number = index + 1;
	layout->lettering = lettering;
	if (!fbd_graph_make(project, pou, index, &layout->graph) || !make_plan(layout))
		g_error("out of memory");
	take_notes(layout, project, pou);
	take_title(layout, project);
	set_size(layout);
	return layout;
}

int fbd_layout_networks(const struct pou *pou)
{
	return pou->fbd ? pou->fbd->count : 0;
}

char *fbd_layout_text(const struct project *project, const struct pou *pou, int index)
{
	const struct fbd_network *network = &pou->fbd->network[index];
	GString *text = g_string_new(NULL);

	g_string_printf(text, "%d\n%s\n%s\n%s\n", network->off, project_text(project, network->label),
			project_text(project, network->title), project_text(project, network->comment));
	for (int i = network->first; i < network->first + network->count; i++) {
		const struct st_item *item = &pou->st->item[i];

		g_string_append_printf(text, "%s {%d,%d}\n", project_text(project, item->text), item->at_column,
				       item->at_row);
	}
	return g_string_free(text, FALSE);
}

void fbd_layout_free(struct fbd_layout *layout)
{
	if (!layout)
		return;
	fbd_plan_free(&layout->plan);
	fbd_graph_free(&layout->graph);
	g_strfreev(layout->note);
	g_free(layout);
}

/* ---- places ---- */

float fbd_layout_y(const struct fbd_layout *layout, int row)
{
	return layout->top + (float)(row * FBD_ROW) + FBD_ROW / 2.0f;
}

graphene_rect_t fbd_layout_box(const struct fbd_layout *layout, int box)
{
	const struct fbd_at *at = &layout->plan.box[box];
	const struct fbd_box *b = &layout->graph.box[box];
	const float x = layout->left + at->x, y = fbd_layout_y(layout, at->first);

	if (b->kind == FBD_VALUE)
		return fbd_layout_operand(layout, b->first_pin);
	if (fbd_is_end(b))
		return GRAPHENE_RECT_INIT(x, y - FBD_END, at->width, 2 * FBD_END);
	return GRAPHENE_RECT_INIT(x, y - FBD_HEAD, at->width,
				  FBD_HEAD + (float)(at->rows * FBD_ROW) + FBD_FOOT);
}

graphene_point_t fbd_layout_pin(const struct fbd_layout *layout, int pin)
{
	const struct fbd_pin_at *at = &layout->plan.pin[pin];

	return GRAPHENE_POINT_INIT(layout->left + at->x, fbd_layout_y(layout, at->row));
}

graphene_rect_t fbd_layout_operand(const struct fbd_layout *layout, int pin)
{
	const struct fbd_pin *p = &layout->graph.pin[pin];
	const graphene_point_t at = fbd_layout_pin(layout, pin);
	const float width = p->operand ? operand_width(layout->lettering, p->operand) : FBD_OPEN;
	const float away = p->operand ? FBD_STUB + (p->negated ? 2 * FBD_CIRCLE : 0) : 4;

	return GRAPHENE_RECT_INIT(p->output ? at.x + away : at.x - away - width, at.y - FBD_ROW / 2.0f, width,
				  FBD_ROW);
}

bool fbd_layout_can_part(const struct fbd_layout *layout, int row)
{
	for (int i = 0; i < layout->graph.box_count; i++)
		if (layout->plan.box[i].top <= row && layout->plan.box[i].bottom > row)
			return false;
	return true;
}

void fbd_layout_hint(const struct fbd_layout *layout, int box, float x, float y, int *column, int *row)
{
	const int rows = layout->plan.box[box].first - layout->plan.box[box].top;
	const float shift = fbd_is_end(&layout->graph.box[box]) ? FBD_END : FBD_HEAD;
	float best = INFINITY;

	*row = MAX((int)lroundf((y + shift - layout->top - FBD_ROW / 2.0f) / FBD_ROW) - rows + 1, 1);
	*column = 1;
	for (int i = 0; i < layout->graph.box_count; i++) {
		const struct fbd_at *at = &layout->plan.box[i];
		const float away = fabsf(layout->left + at->x - x);

		if (fbd_is_end(&layout->graph.box[i]) || away >= best)
			continue;
		best = away;
		*column = at->column + 1;
	}
	if (x > layout->left + layout->plan.width)
		*column = layout->plan.columns + 1;
}

/* ---- parts at a point ---- */

static bool contains(graphene_rect_t rect, float x, float y, float slack)
{
	graphene_rect_inset(&rect, -slack, -slack);
	return graphene_rect_contains_point(&rect, &GRAPHENE_POINT_INIT(x, y));
}

static int pin_at(const struct fbd_layout *layout, float x, float y, float slack)
{
	for (int i = 0; i < layout->graph.pin_count; i++) {
		const graphene_point_t at = fbd_layout_pin(layout, i);

		if (fabsf(at.x - x) <= slack + 5 && fabsf(at.y - y) <= MIN(slack + 5, FBD_ROW / 2.0f))
			return i;
	}
	return -1;
}

/* The wire whose stroke is at a point: the one that has a name, if several leave its pin. */
static int wire_at(const struct fbd_layout *layout, float x, float y, float slack)
{
	for (int i = 0; i < layout->plan.segment_count; i++) {
		const struct fbd_segment *s = &layout->plan.segment[i];

		if (x >= layout->left + s->x1 - slack && x <= layout->left + s->x2 + slack &&
		    y >= fbd_layout_y(layout, s->row1) - slack && y <= fbd_layout_y(layout, s->row2) + slack)
			return layout->graph.pin[s->pin].wire;
	}
	return -1;
}

struct fbd_hit fbd_layout_hit(const struct fbd_layout *layout, float x, float y, float slack)
{
	struct fbd_hit hit = { FBD_PART_NONE, -1, -1, -1 };
	int at = pin_at(layout, x, y, slack);

	if (x < RUNG_GUTTER)
		hit.part = FBD_PART_NUMBER;
	for (int i = 0; i < layout->graph.pin_count && at < 0; i++)
		if (layout->graph.pin[i].wire < 0 && contains(fbd_layout_operand(layout, i), x, y, 0)) {
			hit.part = FBD_PART_OPERAND;
			at = i;
		}
	if (at >= 0) {
		hit.part = hit.part == FBD_PART_OPERAND ? FBD_PART_OPERAND : FBD_PART_PIN;
		hit.pin = at;
		hit.box = layout->graph.pin[at].box;
		return hit;
	}
	for (int i = 0; i < layout->graph.box_count; i++)
		if (contains(fbd_layout_box(layout, i), x, y, 0)) {
			hit.part = FBD_PART_BOX;
			hit.box = i;
			return hit;
		}
	hit.wire = wire_at(layout, x, y, slack);
	if (hit.wire >= 0) {
		hit.part = FBD_PART_WIRE;
		hit.pin = layout->graph.wire[hit.wire].from_pin;
	} else if (hit.part == FBD_PART_NONE && y < layout->top) {
		hit.part = FBD_PART_TITLE;
	}
	return hit;
}

/* ---- diagnostics ---- */

/* Does what begins at (line, column) with @len bytes contain the place? Texts of several lines are longer. */
static bool covers(int line, int column, int len, const struct diag *diag)
{
	return line == diag->line && column <= diag->column && diag->column < column + MAX(len, 1);
}

/* The innermost box, which is the first one, as boxes stand in the order of execution. */
static int box_of(const struct fbd_graph *graph, const struct diag *diag)
{
	for (int i = 0; i < graph->box_count; i++)
		if (covers(graph->box[i].line, graph->box[i].column, graph->box[i].len, diag))
			return i;
	for (int i = graph->box_count - 1; i >= 0; i--)
		if (graph->box[i].line == diag->line)
			return i;
	return -1;
}

bool fbd_layout_of_diag(const struct fbd_layout *layout, const struct diag *diag, int *box, int *pin)
{
	const struct fbd_graph *graph = &layout->graph;

	*pin = -1;
	*box = box_of(graph, diag);
	for (int i = 0; i < graph->pin_count && *box >= 0; i++) {
		const struct fbd_pin *p = &graph->pin[i];

		if (!p->len || !(p->operand || p->wire >= 0) || !covers(p->line, p->column, p->len, diag))
			continue;
		if (p->operand || p->column == diag->column) {
			*box = p->box;
			*pin = p->operand ? i : -1;
			return true;
		}
	}
	return *box >= 0;
}
