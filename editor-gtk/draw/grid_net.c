/* SPDX-License-Identifier: MIT
 *
 * grid_net - which bars of a rung are joined, and which of them have power.
 *
 * Rules of STEP 7: wire behind an element has power if the element lets it through, wire
 * behind a join if any branch brings it, and wire at the left rail always.
 */
#include "editor-gtk/draw/grid_pen.h"

#include <glib.h>

static int root_of(int *net, int bar)
{
	while (net[bar] != bar)
		bar = net[bar] = net[net[bar]];
	return bar;
}

static void join(int *net, int a, int b)
{
	int x = root_of(net, a), y = root_of(net, b);

	net[MAX(x, y)] = MIN(x, y);
}

static bool is_wire(const struct pen *pen, int row, int col)
{
	return word_row(rung_at(pen->rung, row, col)->word)->place == PLACE_WIRE;
}

void grid_net_make(struct pen *pen)
{
	const struct rung *rung = pen->rung;
	int bars = rung->cols + 1;
	int *net = g_new(int, rung->rows * bars);
	uint8_t *live = g_new0(uint8_t, rung->rows * bars);

	for (int bar = 0; bar < rung->rows * bars; bar++)
		net[bar] = bar % bars == 0 ? 0 : bar;
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			int bar = row * bars + col + 1;

			if (rung_at(rung, row, col)->link && row > 0)
				join(net, bar, bar - bars);
			if (is_wire(pen, row, col))
				join(net, bar, bar - 1);
		}
	if (pen->scene->live && !(pen->scene->state & RUNG_STILL))
		live[0] = LIVE_KNOWN | LIVE_OUT;
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			enum place place =
				word_row(rung_at(rung, row, col)->word)->place;

			if (place == PLACE_SERIES || place == PLACE_BOX)
				live[root_of(net, row * bars + col + 1)] |=
					pen_live(pen, row, col) & (LIVE_KNOWN | LIVE_OUT);
		}
	for (int bar = 0; bar < rung->rows * bars; bar++)
		live[bar] = live[root_of(net, bar)];
	g_free(net);
	pen->net_live = live;
}
