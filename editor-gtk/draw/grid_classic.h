/* SPDX-License-Identifier: MIT
 *
 * grid_classic - a rung of a ClassicLadder file as strokes, above the rungs that an import
 * made of it.
 *
 * Every cell is drawn in its place, also one that does nothing. Drawing needs no widget and
 * no display.
 */
#ifndef EDITOR_GRID_CLASSIC_H
#define EDITOR_GRID_CLASSIC_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/rung_layout.h"

#include "engine/exchange/classic/classic_say.h"

struct classic_scene {
	const struct classic_project *project;
	const struct classic_rung *rung;
	struct lettering *lettering;
	const struct theme *theme;
};

/** grid_classic_draw - adds the rung to @picture and makes that wide enough. Returns the height.
 * Units: px at 100 %. */
float grid_classic_draw(const struct classic_scene *scene, struct picture *picture);

/* A rung of ClassicLadder, and the rungs of the import. */
struct classic_pair {
	struct classic_scene there;
	const char *there_name;      /* "rung_3.csv"                              */
	const struct project *project; /* the import                               */
	int pou;
	const int *rung;             /* 0-based, of @pou                          */
	int rungs;                   /* 0: only the original is drawn             */
	enum drafting_show show;
	const char *lost;            /* text if rungs is 0; NULL: none            */
};

/** grid_classic_here - adds the rungs of the import alone, below their name. Returns the y below them. */
float grid_classic_here(const struct classic_pair *pair, float y, struct picture *picture);
/** grid_classic_pair - adds both to @picture at @y. Returns the y below them. */
float grid_classic_pair(const struct classic_pair *pair, float y, struct picture *picture);

#endif
