/* SPDX-License-Identifier: MIT
 *
 * grid_classic - a rung of ClassicLadder as it stands in its file, as strokes; and the same
 * above what became of it here.
 *
 * Its cells are drawn where they are, also those that do nothing: what the import made of
 * them is seen beside it. It knows no widget and no display, and changes nothing.
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

/** grid_classic_draw - added to @picture at its place; says how high it is, and makes the
 * picture wide enough. Units: px at 100 %. */
float grid_classic_draw(const struct classic_scene *scene, struct picture *picture);

/* Theirs above ours. */
struct classic_pair {
	struct classic_scene there;
	const char *there_name;      /* "rung_3.csv"                              */
	const struct project *project; /* here                                    */
	int pou;
	const int *rung;             /* 0-based, of @pou                          */
	int rungs;                   /* 0: theirs alone                           */
	enum drafting_show show;
	const char *lost;            /* then said in the place of ours; NULL: nothing */
};

/** grid_classic_pair - added to @picture at @y, which grows with it; gives where it ends. */
float grid_classic_pair(const struct classic_pair *pair, float y, struct picture *picture);

#endif
