/* SPDX-License-Identifier: MIT
 *
 * test_plain_grid - edits of rungs, each as rung before, what is done, rung after.
 *
 * Rows and columns are 1-based here, the sheet has six columns. A line of edits is
 * `verb row column [cell]`; what is refused is `! REFUSAL`. Blanks count for nothing.
 */
#include "tests/editor/grid_words.h"
#include "tests/tap.h"

struct sample {
	const char *name, *before, *edits, *after;
};

static const struct sample samples[] = {
#include "tests/editor/grid_cases.def"
};

int main(void)
{
	struct grid_bench bench;

	if (!CHECK(grid_bench_open(&bench)))
		return tap_done();
	for (size_t i = 0; i < sizeof(samples) / sizeof(*samples); i++) {
		const struct sample *s = &samples[i];
		char got[GRID_TEXT], want[GRID_TEXT];

		grid_bench_play(&bench, s->before, s->edits, got, sizeof(got));
		grid_squeeze_text(s->after, want, sizeof(want));
		if (!CHECK_AS(!strcmp(got, want), s->name))
			printf("# got:\n%s# want:\n%s", got, want);
	}
	grid_bench_close(&bench);
	return tap_done();
}
