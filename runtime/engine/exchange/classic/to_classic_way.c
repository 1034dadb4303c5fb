/* SPDX-License-Identifier: MIT
 *
 * to_classic_way - draws rungs of contacts in series and an output.
 */
#include "engine/exchange/classic/to_classic_way.h"

int draw_way(struct leaving *e, struct classic_rung *rung, int y,
	     const struct way *way, int to)
{
	int x = 0;

	if (way->never)
		x = 1;
	for (int i = 0; i < way->count && !way->never; i++) {
		out_put(e, rung, y, x, &way->item[i]);
		x += way->item[i].width;
	}
	for (; x < to; x++)
		rung->cell[y][x].element = CL_WIRE;
	return x;
}

/* Ways side by side, then an output. */
void draw_ways(struct leaving *e, const struct way *way, int ways,
	       const struct out_part *output)
{
	struct classic_rung *rung = rung_begin(e);
	int join = 1, end = e->columns - output->width;

	if (!rung)
		return;
	for (int i = 0; i < ways; i++)
		if (way[i].width > join)
			join = way[i].width;
	for (int i = 0; i < ways; i++) {
		draw_way(e, rung, i, &way[i], i ? join : end);
		rung->cell[i][join].top = i > 0;
	}
	out_put(e, rung, 0, end, output);
	if (output->code == CL_JUMP)
		note_jump(e, &rung->cell[0][end], output);
}

APART void way_add(struct way *way, struct out_part item)
{
	if (way->count == CHAIN)
		return;
	way->item[way->count++] = item;
	way->width += item.width;
}

APART void way_contact(struct way *way, int code, struct classic_variable variable)
{
	way_add(way, contact(code, variable));
}

void draw_step(struct leaving *e, int code, struct classic_variable variable,
	       const struct out_part *output)
{
	struct way *way = arena_alloc(e->arena, sizeof(*way));

	if (!way)
		return;
	if (code != CL_WIRE)
		way_contact(way, code, variable);
	draw_ways(e, way, 1, output);
}

void draw_before(struct leaving *e, const struct out_before *before)
{
	for (; before && e->good; before = before->next) {
		struct out_part item = { .code = CL_OPERATE, .width = 3, .height = 1,
					 .text = before->text };
		struct way *way = arena_alloc(e->arena, sizeof(*way));

		if (!way)
			return;
		if (before->bit >= 0) {
			item.code = CL_COMPARE;
			way_add(way, item);
			item = coil(CL_COIL, before->bit);
		}
		draw_ways(e, way, 1, &item);
	}
}
