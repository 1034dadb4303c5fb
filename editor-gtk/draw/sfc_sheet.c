/* SPDX-License-Identifier: MIT
 *
 * sfc_sheet - widths of lanes, texts, and the part at a point; see sfc_sheet.h.
 */
#include "editor-gtk/draw/sfc_sheet.h"
#include "editor-gtk/kit/comment_text.h"
#include "engine/show/sfc_words.h"

#include <glib.h>
#include <math.h>

#define LEAST_HALF 36  /* px: half of a box                                     */
#define BOX_SIDE   14  /* px beside the name in a box                           */
#define LANE_GAP   34
#define TEXT_GAP   7   /* px from a bar or arrow to its text                    */
#define TWIN_HALF  2.5f

static float width_of(const struct sfc_sheet *sheet, enum letter letter, const char *text)
{
	return *text ? lettering_fit(sheet->lettering, letter, text, -1, SFC_BOUND).width :
		       0;
}

/* ---- texts ---- */

static char *take(struct sink_memory *memory)
{
	char *text = g_strdup(sink_memory_text(memory));

	sink_memory_free(memory);
	sink_memory_init(memory);
	return text;
}

static uint32_t comment_of(const struct sfc *sfc, int shape)
{
	if (shape < sfc->step_count)
		return sfc->step[shape].comment;
	shape -= sfc->step_count;
	return shape < sfc->transition_count ? sfc->transition[shape].comment : 0;
}

static void make_texts(struct sfc_sheet *sheet)
{
	const struct sfc *sfc = sheet->pou->sfc;
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	sheet->name = g_new0(char *, sheet->layout->shape_count + 1);
	sheet->times = g_new0(char *, sfc->step_count + 1);
	sheet->what = g_new0(char *, sfc->use_count + 1);
	sheet->does = g_new0(char *, sfc->use_count + 1);
	sheet->comment = g_new0(char *, sheet->layout->shape_count + 1);
	sheet->use_comment = g_new0(char *, sfc->use_count + 1);
	for (int i = 0; i < sheet->layout->shape_count; i++) {
		sfc_words_shape(sheet->project, sheet->pou, sheet->layout, i, &sink);
		sheet->name[i] = take(&memory);
		sheet->comment[i] = comment_text(project_text(sheet->project,
						      comment_of(sfc, i)));
	}
	for (int i = 0; i < sfc->step_count; i++) {
		sfc_words_times(sheet->project, sfc, i, &sink);
		sheet->times[i] = take(&memory);
	}
	for (int i = 0; i < sfc->use_count; i++) {
		sfc_words_qualifier(sheet->project, sfc, i, &sink);
		sheet->what[i] = take(&memory);
		sheet->does[i] = g_strdup(project_text(sheet->project,
						       sfc->use[i].operand));
		sheet->use_comment[i] = comment_text(project_text(sheet->project,
						sfc->use[i].comment));
	}
}

/* ---- widths ---- */

static struct sfc_table measure_table(const struct sfc_sheet *sheet, int step)
{
	const struct sfc_step *s = &sheet->pou->sfc->step[step];
	struct sfc_table table = { 0, 0, 0 };

	for (int i = s->first_use; i < s->first_use + s->use_count; i++) {
		table.what = MAX(table.what, width_of(sheet, LETTER_OPERAND,
						      sheet->what[i]));
		table.does = MAX(table.does, width_of(sheet, LETTER_SYMBOL,
						      sheet->does[i]));
	}
	table.what += s->use_count ? 2 * SFC_CELL : 0;
	table.does += s->use_count ? 2 * SFC_CELL : 0;
	return table;
}

/* The width that a comment gets in the layout: bounded, so that comments do not spread
 * branches. */
static float comment_width(const struct sfc_sheet *sheet, int lane, const char *comment)
{
	const float width = *comment ? width_of(sheet, LETTER_COMMENT, comment) : 0;

	if (!*comment)
		return 0;
	return SFC_APART + (lane == sheet->layout->lanes - 1 ? width : MIN(width, SFC_ASIDE));
}

static float widest_comment(const struct sfc_sheet *sheet, int step)
{
	const struct sfc_step *s = &sheet->pou->sfc->step[step];
	float widest = 0;

	for (int i = s->first_use; i < s->first_use + s->use_count; i++)
		widest = MAX(widest, comment_width(sheet, sheet->layout->shape[step].lane,
						   sheet->use_comment[i]));
	return widest;
}

static void measure_shapes(struct sfc_sheet *sheet)
{
	const struct sfc_layout *layout = sheet->layout;

	for (int i = 0; i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];
		struct sfc_lane *lane = &sheet->lane[shape->lane];

		if (shape->part == SFC_STEP) {
			float name = width_of(sheet, LETTER_SYMBOL, sheet->name[i]);
			float times = width_of(sheet, LETTER_PIN, sheet->times[i]);

			lane->half = MAX(lane->half, MAX(MAX(name, times) / 2 + BOX_SIDE,
							 LEAST_HALF));
		} else {
			lane->right = MAX(lane->right, SFC_BAR + TEXT_GAP +
					  width_of(sheet, LETTER_OPERAND, sheet->name[i]) +
					  comment_width(sheet, shape->lane,
							sheet->comment[i]));
		}
	}
}

static void measure(struct sfc_sheet *sheet)
{
	const struct sfc_layout *layout = sheet->layout;
	float x = SFC_EDGE;

	measure_shapes(sheet);
	for (int l = 0; l < layout->lanes; l++) {
		struct sfc_lane *lane = &sheet->lane[l];

		lane->right = MAX(lane->right, MAX(lane->half, SFC_BAR));
	}
	for (int s = 0; s < layout->sfc->step_count; s++) {
		struct sfc_lane *lane = &sheet->lane[layout->shape[s].lane];

		sheet->table[s] = measure_table(sheet, s);
		if (layout->sfc->step[s].use_count)
			lane->right = MAX(lane->right, lane->half + SFC_LEAD +
					  sheet->table[s].what + sheet->table[s].does +
					  widest_comment(sheet, s));
		if (*sheet->comment[s])
			lane->right = MAX(lane->right, lane->half +
					  comment_width(sheet, layout->shape[s].lane,
							sheet->comment[s]));
	}
	for (int l = 0; l < layout->lanes; l++) {
		struct sfc_lane *lane = &sheet->lane[l];
		float left = MAX(lane->half, SFC_BAR);

		lane->x = x + left;
		x += left + lane->right + LANE_GAP;
	}
	for (int s = 0; s < layout->sfc->step_count; s++) {
		const struct sfc_lane *lane = &sheet->lane[layout->shape[s].lane];

		sheet->table[s].x = lane->x + lane->half + SFC_LEAD;
	}
	sheet->width = x - (layout->lanes ? LANE_GAP : 0) + SFC_EDGE;
	sheet->height = sfc_sheet_y(MAX(layout->rows - 1, 0)) + SFC_EDGE;
}

/* ---- */

static gint64 place_of(int lane, int row)
{
	return (gint64)row << 32 | (gint64)lane;
}

static void find_twins(struct sfc_sheet *sheet)
{
	sheet->twins = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
	for (int i = 0; i < sheet->layout->wire_count; i++) {
		const struct sfc_wire *wire = &sheet->layout->wire[i];

		for (int l = wire->lane; wire->twin && l <= wire->end_lane; l++) {
			gint64 *place = g_new(gint64, 1);

			*place = place_of(l, wire->row);
			g_hash_table_add(sheet->twins, place);
		}
	}
}

/* Are shapes or wires of a lane in these rows? */
static bool is_taken(const struct sfc_layout *layout, int lane, int first, int last)
{
	for (int i = 0; i < layout->shape_count; i++)
		if (layout->shape[i].lane == lane && layout->shape[i].top <= last &&
		    layout->shape[i].bottom >= first)
			return true;
	for (int i = 0; i < layout->wire_count; i++) {
		const struct sfc_wire *wire = &layout->wire[i];

		if (MIN(wire->lane, wire->end_lane) <= lane &&
		    MAX(wire->lane, wire->end_lane) >= lane &&
		    MIN(wire->row, wire->end_row) <= last && MAX(wire->row, wire->end_row) >= first)
			return true;
	}
	return false;
}

/* The first lane right of @lane that has something at the height @y; the number of lanes: none. */
static int next_lane(const struct sfc_sheet *sheet, int lane, float y)
{
	const float row = (y - SFC_EDGE) / SFC_ROW;
	int next = lane + 1;

	while (next < sheet->layout->lanes &&
	       !is_taken(sheet->layout, next, (int)floorf(row), (int)ceilf(row)))
		next++;
	return next;
}

/* Comments that nothing stands beside make the chart wider. */
static void widen(struct sfc_sheet *sheet)
{
	for (int i = 0; i < sheet->layout->shape_count; i++) {
		const graphene_point_t at = sfc_sheet_comment(sheet, i);

		if (*sheet->comment[i] && next_lane(sheet, sheet->layout->shape[i].lane, at.y) ==
		    sheet->layout->lanes)
			sheet->width = MAX(sheet->width, SFC_EDGE + at.x +
					   width_of(sheet, LETTER_COMMENT, sheet->comment[i]));
	}
}

struct sfc_sheet *sfc_sheet_new(const struct project *project, const struct pou *pou,
				struct lettering *lettering)
{
	struct sfc_sheet *sheet = g_new0(struct sfc_sheet, 1);

	sheet->project = project;
	sheet->pou = pou;
	sheet->lettering = lettering;
	sheet->layout = sfc_layout_new(pou->sfc);
	if (!sheet->layout)
		g_error("no memory for a chart");
	sheet->lane = g_new0(struct sfc_lane, sheet->layout->lanes + 1);
	sheet->table = g_new0(struct sfc_table, pou->sfc->step_count + 1);
	make_texts(sheet);
	measure(sheet);
	widen(sheet);
	find_twins(sheet);
	return sheet;
}

void sfc_sheet_free(struct sfc_sheet *sheet)
{
	if (!sheet)
		return;
	/* The chart may be freed already, so its counts are not used here. */
	g_strfreev(sheet->name);
	g_strfreev(sheet->times);
	g_strfreev(sheet->what);
	g_strfreev(sheet->does);
	g_strfreev(sheet->comment);
	g_strfreev(sheet->use_comment);
	g_hash_table_unref(sheet->twins);
	sfc_layout_free(sheet->layout);
	g_free(sheet->lane);
	g_free(sheet->table);
	g_free(sheet);
}

/* ---- places ---- */

float sfc_sheet_y(int row)
{
	return SFC_EDGE + (float)(row * SFC_ROW);
}

graphene_rect_t sfc_sheet_box(const struct sfc_sheet *sheet, int shape)
{
	const struct sfc_shape *s = &sheet->layout->shape[shape];
	const struct sfc_lane *lane = &sheet->lane[s->lane];
	float text = width_of(sheet, LETTER_OPERAND, sheet->name[shape]);

	if (s->part == SFC_STEP)
		return GRAPHENE_RECT_INIT(lane->x - lane->half, sfc_sheet_y(s->top),
					  2 * lane->half,
					  (float)((s->bottom - s->top) * SFC_ROW));
	return GRAPHENE_RECT_INIT(lane->x - SFC_BAR, sfc_sheet_y(s->top) - SFC_ROW / 2.0f,
				  2 * SFC_BAR + TEXT_GAP + text, SFC_ROW);
}

graphene_point_t sfc_sheet_comment(const struct sfc_sheet *sheet, int shape)
{
	const struct sfc_shape *s = &sheet->layout->shape[shape];
	const struct sfc_lane *lane = &sheet->lane[s->lane];
	const graphene_rect_t box = sfc_sheet_box(sheet, shape);

	if (s->part != SFC_STEP)
		return GRAPHENE_POINT_INIT(box.origin.x + box.size.width + SFC_APART,
					   sfc_sheet_y(s->top));
	/* Above the table of actions, if there is one. */
	return GRAPHENE_POINT_INIT(lane->x + lane->half + SFC_APART,
		sheet->pou->sfc->step[s->index].use_count ? sfc_sheet_y(s->top) - 1 :
		box.origin.y + box.size.height / 2);
}

float sfc_sheet_room(const struct sfc_sheet *sheet, int lane, float x, float y)
{
	const int next = next_lane(sheet, lane, y);

	if (next == sheet->layout->lanes)
		return MAX(MIN(SFC_BOUND, sheet->width - x), 0);
	return MAX(sheet->lane[next].x - MAX(sheet->lane[next].half, SFC_BAR) - 10 - x, 0);
}

graphene_rect_t sfc_sheet_use(const struct sfc_sheet *sheet, int use)
{
	const struct sfc *sfc = sheet->layout->sfc;
	const int step = sfc->use[use].step;
	const struct sfc_table *table = &sheet->table[step];
	const int row = sheet->layout->shape[step].top + 1 + use - sfc->step[step].first_use;

	return GRAPHENE_RECT_INIT(table->x, sfc_sheet_y(row) - SFC_ROW / 2.0f,
				  table->what + table->does, SFC_ROW);
}

static bool is_twin(const struct sfc_sheet *sheet, int lane, int row)
{
	const gint64 place = place_of(lane, row);

	return g_hash_table_contains(sheet->twins, &place);
}

void sfc_sheet_ends(const struct sfc_sheet *sheet, const struct sfc_wire *wire, float *y1,
		    float *y2)
{
	*y1 = sfc_sheet_y(wire->row);
	*y2 = sfc_sheet_y(wire->end_row);
	if (is_twin(sheet, wire->lane, wire->row))
		*y1 += TWIN_HALF;
	if (is_twin(sheet, wire->lane, wire->end_row))
		*y2 -= TWIN_HALF;
}

/* ---- the part at a point ---- */

/* How far a point is from a box; 0 inside. */
static float distance(const graphene_rect_t *box, float x, float y)
{
	float right = box->origin.x + box->size.width;
	float bottom = box->origin.y + box->size.height;
	float dx = x < box->origin.x ? box->origin.x - x : x > right ? x - right : 0;
	float dy = y < box->origin.y ? box->origin.y - y : y > bottom ? y - bottom : 0;

	return MAX(dx, dy);
}

struct sfc_at sfc_sheet_at(const struct sfc_sheet *sheet, float x, float y, float slack)
{
	const struct sfc_layout *layout = sheet->layout;
	struct sfc_at at = { -1, -1, false };
	float least = slack;

	for (int i = 0; i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];
		graphene_rect_t box;
		float far;

		if (sfc_sheet_y(shape->top) - SFC_ROW - slack > y ||
		    sfc_sheet_y(shape->bottom) + SFC_ROW + slack < y)
			continue;
		box = sfc_sheet_box(sheet, i);
		far = distance(&box, x, y);
		if (far <= least) {
			least = far;
			at = (struct sfc_at){ i, -1, shape->part == SFC_STEP &&
				y > box.origin.y + box.size.height - 6 };
		}
		for (int u = 0; shape->part == SFC_STEP &&
		     u < layout->sfc->step[shape->index].use_count; u++) {
			const int use = layout->sfc->step[shape->index].first_use + u;

			box = sfc_sheet_use(sheet, use);
			far = distance(&box, x, y);
			if (far < least || far == 0) {
				least = far;
				at = (struct sfc_at){ i, use, false };
			}
		}
	}
	return at;
}

bool sfc_sheet_can_part(const struct sfc_sheet *sheet, int row)
{
	for (int i = 0; i < sheet->layout->sfc->step_count; i++)
		if (sheet->layout->shape[i].top <= row && row < sheet->layout->shape[i].bottom)
			return false;
	return true;
}

/* ---- the part of a diagnostic ---- */

static bool is_of_body(const struct sfc_body *body, int rung)
{
	return (body->kind == BODY_EXPRESSION || body->kind == BODY_RUNGS) &&
	       rung >= body->first && rung < body->first + body->count;
}

static bool of_rung(const struct sfc_sheet *sheet, int rung, int *shape, int *use)
{
	const struct sfc *sfc = sheet->layout->sfc;

	for (int i = 0; i < sfc->transition_count; i++)
		if (is_of_body(&sfc->transition[i].condition, rung)) {
			*shape = sfc->step_count + i;
			return true;
		}
	for (int i = 0; i < sfc->use_count; i++)
		if (sfc->use[i].action >= 0 &&
		    is_of_body(&sfc->action[sfc->use[i].action].body, rung)) {
			*shape = sfc->use[i].step;
			*use = i;
			return true;
		}
	return false;
}

bool sfc_sheet_of_diag(const struct sfc_sheet *sheet, const struct sfc *checked,
		       const struct diag *diag, int *shape, int *use)
{
	const struct sfc *mine = sheet->layout->sfc, *sfc = checked ? checked : mine;

	*shape = *use = -1;
	if (diag->rung > 0)
		return of_rung(sheet, diag->rung - 1, shape, use);
	if (sfc->step_count != mine->step_count || sfc->use_count != mine->use_count ||
	    sfc->transition_count != mine->transition_count)
		return false;
	for (int i = 0; diag->line > 0 && i < sfc->use_count; i++)
		if (sfc->use[i].line == diag->line) {
			*shape = sfc->use[i].step;
			*use = i;
		}
	for (int i = 0; diag->line > 0 && i < sfc->step_count; i++)
		if (sfc->step[i].line == diag->line)
			*shape = i;
	for (int i = 0; diag->line > 0 && i < sfc->transition_count; i++)
		if (sfc->transition[i].line == diag->line)
			*shape = sfc->step_count + i;
	return *shape >= 0;
}
