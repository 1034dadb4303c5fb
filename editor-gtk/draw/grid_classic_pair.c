/* SPDX-License-Identifier: MIT
 *
 * grid_classic_pair - what stood in ClassicLadder, and below it what that became here.
 */
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/kit/i18n.h"

#include <glib.h>

#define CAPTION 24

static float put_caption(const struct classic_pair *pair, const char *text, float y,
			 struct picture *picture)
{
	const struct lettered fits = lettering_fit(pair->there.lettering, LETTER_COMMENT,
						   text, -1, 0);

	picture_move(picture, 0, y);
	picture_text(picture, TOKEN_COMMENT, LETTER_COMMENT, fits, 16, 17);
	picture_move(picture, 0, 0);
	picture->width = MAX(picture->width, fits.width + 32);
	return CAPTION;
}

/* "Here: Main, rungs 3 to 5" */
static char *name_ours(const struct classic_pair *pair)
{
	const char *pou = project_text(pair->project, pair->project->pou[pair->pou].name);
	const int first = pair->rung[0] + 1, last = pair->rung[pair->rungs - 1] + 1;

	if (pair->rungs == 1)
		return g_strdup_printf(_("Here: %s, rung %d"), pou, first);
	return g_strdup_printf(_("Here: %s, rungs %d to %d"), pou, first, last);
}

static void put_layout(const struct classic_pair *pair, const struct drafting *drafting,
		       struct rung_layout *layout, float y, struct picture *picture)
{
	const struct grid_scene scene = { .drafting = drafting, .layout = layout,
					  .theme = pair->there.theme };

	picture_move(picture, 0, y);
	grid_draw(&scene, picture);
	picture_move(picture, 0, 0);
	picture->width = MAX(picture->width, rung_layout_width(layout));
}

static float put_ours(const struct classic_pair *pair, float y, struct picture *picture)
{
	const struct pou *pou = &pair->project->pou[pair->pou];
	struct grid_names *names = grid_names_new(pair->project, pou);
	struct drafting drafting = { .project = pair->project, .names = names,
				     .lettering = pair->there.lettering,
				     .show = pair->show };
	struct rung_layout **layout = g_new0(struct rung_layout *, pair->rungs);
	float rails = 0;

	for (int i = 0; i < pair->rungs; i++)
		drafting.columns = MAX(drafting.columns,
				       rung_layout_columns(pou->rung[pair->rung[i]]));
	for (int i = 0; i < pair->rungs; i++) {
		layout[i] = rung_layout_new(&drafting, pou->rung[pair->rung[i]],
					    pair->rung[i] + 1, 0);
		rails = MAX(rails, layout[i]->natural);
	}
	for (int i = 0; i < pair->rungs; i++) {
		rung_layout_stretch(layout[i], rails);
		put_layout(pair, &drafting, layout[i], y, picture);
		y += layout[i]->height;
		rung_layout_free(layout[i]);
	}
	g_free(layout);
	grid_names_free(names);
	return y;
}

float grid_classic_pair(const struct classic_pair *pair, float y, struct picture *picture)
{
	char *text = g_strdup_printf(_("ClassicLadder: %s"), pair->there_name);

	y += put_caption(pair, text, y, picture);
	g_free(text);
	picture_move(picture, 0, y);
	y += grid_classic_draw(&pair->there, picture);
	picture_move(picture, 0, 0);
	if (pair->rungs > 0) {
		text = name_ours(pair);
		y += put_caption(pair, text, y, picture);
		g_free(text);
		y = put_ours(pair, y, picture);
	} else if (pair->lost) {
		y += put_caption(pair, pair->lost, y, picture);
	}
	picture->height = MAX(picture->height, y + 4);
	return y + 4;
}
