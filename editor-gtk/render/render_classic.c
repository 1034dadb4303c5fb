/* SPDX-License-Identifier: MIT
 *
 * render_classic - before and after; see render_classic.h.
 */
#include "editor-gtk/render/render_classic.h"
#include "editor-gtk/render/render_sheet.h"

#include <glib.h>

struct before {
	struct ladder *ladder;
	const struct render_options *options;
	struct lettering *lettering;
	struct picture *picture;
	float y;
};

/* All of @pou that became of @rung; GArray of int. */
static GArray *became(const struct before *of, int pou, const struct classic_rung *rung)
{
	const struct project *project = ladder_project(of->ladder);
	GArray *all = g_array_new(FALSE, FALSE, sizeof(int));

	for (int i = 0; i < project->pou[pou].rung_count; i++)
		if (ladder_import_rung(of->ladder, pou, i) == rung)
			g_array_append_val(all, i);
	return all;
}

static void put_pair(struct before *of, int pou, const struct classic_rung *rung)
{
	GArray *ours = became(of, pou, rung);
	const struct classic_pair pair = {
		.there = { ladder_import_project(of->ladder), rung, of->lettering,
			   theme_get(of->options->theme, THEME_GREEN) },
		.there_name = *rung->place.member ? rung->place.member : of->options->file,
		.project = ladder_project(of->ladder), .pou = pou,
		.rung = &g_array_index(ours, int, 0),
		.rungs = of->options->original == ORIGINAL_BOTH ? (int)ours->len : 0,
		.show = of->options->show,
	};

	of->y = grid_classic_pair(&pair, of->y, of->picture);
	g_array_unref(ours);
}

static void put_pou(struct before *of, int pou)
{
	const struct pou *one = &ladder_project(of->ladder)->pou[pou];
	const struct classic_rung *last = NULL;

	for (int i = 0; i < one->rung_count; i++) {
		const struct classic_rung *rung = ladder_import_rung(of->ladder, pou, i);

		if (!rung || rung == last ||
		    (of->options->rung && of->options->rung != i + 1))
			continue;
		put_pair(of, pou, rung);
		last = rung;
	}
}

bool render_classic(struct ladder *ladder, int pou, const struct render_options *options,
		    struct lettering *lettering, struct picture *picture)
{
	struct before of = { ladder, options, lettering, picture, 0 };

	if (!ladder_import_project(ladder))
		return false;
	for (int i = 0; i < ladder_project(ladder)->pou_count; i++)
		/* A rung's number alone: of the first POU that has such a one. */
		if (pou == i || (pou < 0 && (!options->rung || of.y <= 0)))
			put_pou(&of, i);
	render_grow(picture, 1, of.y);
	return of.y > 0;
}
