/* SPDX-License-Identifier: MIT
 *
 * picture_live - the picture in a terminal, taken anew a few times a second. What
 * does not fit is reached page by page.
 */
#include "ladder/picture.h"
#include "ladder/screen.h"
#include "ladder/tty.h"

#include <stdio.h>
#include <stdlib.h>

#define FRAME_NS 250000000 /* 4 pictures a second                           */

struct view {
	struct picture *picture;
	struct screen screen;
	struct sink_memory text; /* of one row                             */
	const char *title;
	int first, page;         /* row at the top; rows that were shown   */
	bool whole;              /* every chip could be read               */
};

static void put_row(struct view *view, int row)
{
	struct sink out = sink_to_memory(&view->text);

	view->text.len = 0;
	picture_row(view->picture, row, &out);
	screen_put(&view->screen,
		   picture_level(view->picture, row) == LEVEL_HIGH ?
			   STYLE_GOOD : STYLE_PLAIN,
		   sink_memory_text(&view->text));
}

static void put_foot(struct view *view, int rows, int shown)
{
	char text[96];

	if (view->first || shown < rows) {
		snprintf(text, sizeof(text), " %d to %d of %d; space: next page, ",
			 rows ? view->first + 1 : 0, view->first + shown, rows);
		screen_put(&view->screen, STYLE_DIM, text);
	}
	screen_put(&view->screen, STYLE_DIM, " q: quit");
	if (!view->whole)
		screen_put(&view->screen, STYLE_BAD,
			   "  a chip cannot be read: see `ladder io`");
	else if (!view->picture->levels)
		screen_put(&view->screen, STYLE_DIM,
			   "  levels: not told here (they need root and debugfs)");
}

static bool draw(struct view *view)
{
	struct screen *screen = &view->screen;
	int rows = picture_rows(view->picture), width, height, shown = 0;
	struct sink out = sink_to_memory(&view->text);

	tty_size(&width, &height);
	if (view->first >= rows)
		view->first = 0;
	screen_begin(screen, width, height);
	screen_put(screen, STYLE_TITLE, " Rungboard ");
	screen_put(screen, STYLE_TITLE, view->title);
	screen_put(screen, STYLE_TITLE, " ");
	if (screen_line(screen)) {
		view->text.len = 0;
		picture_head(view->picture, &out);
		screen_put(screen, STYLE_BOLD, sink_memory_text(&view->text));
		while (view->first + shown < rows && screen->row + 2 < height &&
		       screen_line(screen))
			put_row(view, view->first + shown++);
		if (screen_line(screen))
			put_foot(view, rows, shown);
	}
	screen_end(screen);
	view->page = shown ? shown : 1;
	return tty_draw(sink_memory_text(&screen->frame), screen->frame.len);
}

/* False: quit. */
static bool take_key(struct view *view, int key)
{
	if (key == 'q' || key == 'Q' || key == -2)
		return false;
	if (key == ' ')
		view->first += view->page;
	return true;
}

static bool take(struct view *view)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));

	if (!diags)
		return false;
	diag_init(diags);
	picture_free(view->picture);
	view->whole = picture_take(view->picture, diags);
	free(diags);
	return true;
}

enum status picture_live(struct call *call, struct picture *picture)
{
	struct view view = { .picture = picture, .whole = true,
			     .title = picture->map ? picture->map->board :
						     "lines of this machine" };
	bool going = true;

	view.screen.colour = !getenv("NO_COLOR");
	tty_watch_signals();
	if (!tty_open()) {
		tty_close();
		return report_usage(call, "this terminal cannot be used");
	}
	while (going && !tty_stopped())
		going = take(&view) && draw(&view) &&
			take_key(&view, tty_key(FRAME_NS));
	tty_close();
	screen_free(&view.screen);
	sink_memory_free(&view.text);
	return STATUS_GOOD;
}
