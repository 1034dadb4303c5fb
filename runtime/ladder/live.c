/* SPDX-License-Identifier: MIT
 *
 * live - the live table of `ladder run`. It draws 20 times a second, however fast the
 * scans are.
 */
#include "ladder/live.h"
#include "hal/clock.h"
#include "ladder/rungs.h"
#include "ladder/screen.h"
#include "ladder/tty.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAME_NS  50000000  /* between two drawings                          */
#define BEHIND_NS 250000000 /* a longer delay is not caught up               */
#define KEY_RESET 18        /* Ctrl-R                                        */

/* Keys of the switches; s scans once, q quits. */
static const char keys[] = "123456789abcdefghijklmnoprtuvwxyz";

struct live {
	struct board *board;
	struct pace *pace;
	struct screen screen;
	const char *file, *title;
	const struct project *project;
	const char *rungs;         /* shown instead of variables; or NULL   */
	struct sink_memory drawing;
	bool utf8, paused;
	int64_t scan_ns, scan_max_ns;
	int64_t drawn_ns;
};

void pace_start(struct pace *pace, int64_t wall_ns)
{
	pace->wall_start_ns = wall_ns;
	pace->ticks = 0;
}

int64_t pace_wait(struct pace *pace, int64_t wall_ns)
{
	double due = (pace->ticks + 1) * pace->wall_period_ns;
	double wait = due - (double)(wall_ns - pace->wall_start_ns);

	if (wait < -BEHIND_NS && wait < -pace->wall_period_ns) {
		pace_start(pace, wall_ns);
		wait = 0;
	}
	return wait > 1e9 ? 1000000000 : (int64_t)wait;
}

int64_t pace_step(struct pace *pace)
{
	pace->ticks++;
	pace->scans++;
	pace->now_ns += pace->period_ns;
	return pace->now_ns;
}

bool pace_is_over(const struct pace *pace)
{
	return pace->most && pace->scans >= pace->most;
}

static void put_time(struct screen *screen, int64_t ns)
{
	char text[32];

	snprintf(text, sizeof(text), "%.2f s", (double)ns / 1e9);
	screen_put(screen, STYLE_PLAIN, text);
}

static void put_state(struct live *live)
{
	struct screen *screen = &live->screen;
	const struct resource *resource = live->board->resource;
	char text[96];

	if (resource->state == STATE_FAULT) {
		screen_put(screen, STYLE_BAD, " FAULT: ");
		resource_fault_print(resource, text, sizeof(text));
		screen_put(screen, STYLE_BAD, text);
		if (!resource->fault_at.rung)
			return;
		snprintf(text, sizeof(text), ", %.40s rung %u (%u,%u)",
			 resource->fault_at.pou, resource->fault_at.rung,
			 resource->fault_at.row, resource->fault_at.col);
		screen_put(screen, STYLE_BAD, text);
		return;
	}
	if (resource->halted) {
		resource_halt_print(resource, text, sizeof(text));
		screen_put(screen, STYLE_BAD, " ");
		screen_put(screen, STYLE_BAD, text);
		return;
	}
	screen_put(screen, live->paused ? STYLE_BOLD : STYLE_GOOD,
		   live->paused ? " PAUSE" : " RUN");
	snprintf(text, sizeof(text), "   scan %llu   t ",
		 (unsigned long long)live->pace->scans);
	screen_put(screen, STYLE_PLAIN, text);
	put_time(screen, live->pace->now_ns);
	snprintf(text, sizeof(text), "   period %g ms   scan time %.1f us, "
		 "longest %.1f us", (double)live->pace->period_ns / 1e6,
		 (double)live->scan_ns / 1e3, (double)live->scan_max_ns / 1e3);
	screen_put(screen, STYLE_DIM, text);
}

static void put_lamp(struct live *live, const struct lamp *lamp, char key,
		     int col, int limit)
{
	struct screen *screen = &live->screen;
	bool on = board_is_on(live->board, lamp);
	char text[8];

	screen_column(screen, col, limit);
	snprintf(text, sizeof(text), " %c ", key);
	screen_put(screen, STYLE_DIM, text);
	if (live->utf8)
		screen_put(screen, on ? STYLE_GOOD : STYLE_DIM,
			   on ? "\u25cf" : "\u25cb");
	else
		screen_put(screen, on ? STYLE_GOOD : STYLE_DIM, on ? "*" : "o");
	screen_put(screen, on ? STYLE_BOLD : STYLE_PLAIN, on ? " 1 " : " 0 ");
	screen_put(screen, STYLE_PLAIN, *lamp->name ? lamp->name :
						      lamp->address);
	if (*lamp->name) {
		screen_put(screen, STYLE_DIM, " ");
		screen_put(screen, STYLE_DIM, lamp->address);
	}
	if (*lamp->line) {
		screen_put(screen, STYLE_DIM, " ");
		screen_put(screen, STYLE_DIM, lamp->line);
	}
}

/* Number of rows for the lamps; four rows of the screen remain for the rest. */
static int lamp_rows(const struct live *live, int *left_out)
{
	const struct board *board = live->board;
	int rows = board->input.count > board->output.count ?
			   board->input.count : board->output.count;
	int room = live->screen.height - 4;

	if (room < 1)
		room = 1;
	*left_out = rows > room ? rows - room + 1 : 0;
	return rows > room ? room - 1 : rows;
}

static bool put_lamps(struct live *live)
{
	const struct board *board = live->board;
	int half = live->screen.width / 2, left_out;
	int rows = lamp_rows(live, &left_out);
	char text[48];

	screen_put(&live->screen, STYLE_BOLD, " INPUTS");
	screen_column(&live->screen, half, live->screen.width);
	screen_put(&live->screen, STYLE_BOLD, " OUTPUTS");
	for (int i = 0; i < rows; i++) {
		if (!screen_line(&live->screen))
			return false;
		if (i < board->input.count)
			put_lamp(live, &board->input.lamp[i],
				 i < (int)sizeof(keys) - 1 ? keys[i] : ' ', 0,
				 half);
		if (i < board->output.count)
			put_lamp(live, &board->output.lamp[i], ' ', half,
				 live->screen.width);
	}
	if (left_out) {
		if (!screen_line(&live->screen))
			return false;
		snprintf(text, sizeof(text), " %d more rows", left_out);
		screen_put(&live->screen, STYLE_DIM, text);
	}
	return screen_line(&live->screen);
}

static void put_variable(struct live *live, const struct moving *moving,
			 int col, int limit)
{
	bool time = moving->at.type == IEC_TIME;
	char text[IEC_VALUE_TEXT];

	iec_value_print(moving->at.type, moving->last, text, sizeof(text));
	/* A long name is cut, so that the value is visible. */
	screen_column(&live->screen, col,
		      limit - (int)strlen(text) - (time ? 6 : 3));
	screen_put(&live->screen, STYLE_PLAIN, " ");
	screen_put(&live->screen, STYLE_PLAIN, moving->name);
	screen_column(&live->screen, col, limit);
	screen_put(&live->screen, STYLE_DIM, " = ");
	screen_put(&live->screen, STYLE_BOLD, text);
	if (time)
		screen_put(&live->screen, STYLE_DIM, " ms");
}

/* Variables that have changed since the start, in order of declaration. */
static void put_variables(struct live *live)
{
	const struct board *board = live->board;
	struct screen *screen = &live->screen;
	int columns = screen->width >= 96 ? 3 : screen->width >= 50 ? 2 : 1;
	int width = screen->width / columns, shown = 0;

	for (int i = 0; i < board->moving_count; i++) {
		const struct moving *moving = &board->moving[i];
		int col = shown % columns * width;

		if (!moving->moved)
			continue;
		if (!col) {
			if (screen->row + 2 >= screen->height ||
			    !screen_line(screen))
				return;
			if (!shown) {
				screen_put(screen, STYLE_BOLD, " VARIABLES");
				if (!screen_line(screen))
					return;
			}
		}
		put_variable(live, moving, col, col + width);
		shown++;
	}
}

/* As many lines of the rungs as fit. */
static void put_rungs(struct live *live)
{
	struct screen *screen = &live->screen;
	struct sink out = sink_to_memory(&live->drawing);
	struct show_options options = { .ascii = !live->utf8 };
	char *at, *end;

	live->drawing.len = 0;
	if (rungs_show(live->project, live->rungs, live->board->resource, NULL, options,
		       &out) < 1)
		return;
	for (at = live->drawing.text; at && (end = strchr(at, '\n')) != NULL;
	     at = end + 1) {
		*end = '\0';
		if (screen->row + 2 >= screen->height || !screen_line(screen))
			return;
		screen_put(screen, STYLE_PLAIN, at);
	}
}

static void put_keys(struct live *live)
{
	struct screen *screen = &live->screen;

	while (screen->row + 1 < screen->height)
		screen_line(screen);
	screen_put(screen, STYLE_DIM, " keys: 1-9 a-z toggle inputs, space "
		   "pause, s one scan, Ctrl-R restart, q quit");
}

static bool draw(struct live *live)
{
	struct screen *screen = &live->screen;
	int width, height;

	tty_size(&width, &height);
	screen_begin(screen, width, height);
	screen_put(screen, STYLE_TITLE, " Rungboard ");
	screen_put(screen, STYLE_TITLE, live->file);
	screen_put(screen, STYLE_TITLE, *live->title ? "  " : "");
	screen_put(screen, STYLE_TITLE, live->title);
	screen_put(screen, STYLE_TITLE, " ");
	if (screen_line(screen)) {
		put_state(live);
		if (screen_line(screen) && screen_line(screen) &&
		    put_lamps(live)) {
			if (live->rungs)
				put_rungs(live);
			else
				put_variables(live);
		}
		if (screen->row < screen->height)
			put_keys(live);
	}
	screen_end(screen);
	return tty_draw(sink_memory_text(&screen->frame), screen->frame.len);
}

static void note_moves(struct board *board)
{
	for (int i = 0; i < board->moving_count; i++) {
		struct moving *moving = &board->moving[i];
		union iec_value value = image_get(&board->resource->image,
						  moving->at);

		moving->moved |= moving_update(moving, value);
	}
}

static void scan(struct live *live)
{
	int64_t start = clock_now(), took;
	struct resource *resource = live->board->resource;

	board_scan(live->board, pace_step(live->pace));
	took = clock_now() - start;
	live->scan_ns = took;
	if (took > live->scan_max_ns)
		live->scan_max_ns = took;
	resource->scan_us = (uint32_t)(took / 1000);
	resource->scan_max_us = (uint32_t)(live->scan_max_ns / 1000);
}

static void restart(struct live *live)
{
	board_start(live->board);
	live->scan_max_ns = 0;
}

/* False: quit. */
static bool take_key(struct live *live, int key)
{
	const char *at = key > 0 && key < 128 ? strchr(keys, key) : NULL;

	if (key == 'q' || key == 'Q' || key == -2)
		return false;
	if (at && *at)
		board_toggle(live->board, (int)(at - keys));
	else if (key == ' ')
		live->paused = !live->paused;
	else if (key == KEY_RESET)
		restart(live);
	else if (key == 's') {
		live->paused = true;
		if (!pace_is_over(live->pace))
			scan(live);
	} else {
		return true;
	}
	if (live->paused || key == ' ')
		pace_start(live->pace, clock_now());
	live->drawn_ns = 0; /* draw at once */
	return true;
}

static bool is_idle(const struct live *live)
{
	return live->paused ||
	       live->board->resource->state != STATE_RUN;
}

/* Draws if a frame is due. False: the terminal cannot be written. */
static bool show(struct live *live)
{
	int64_t now = clock_now();

	if (live->drawn_ns && now - live->drawn_ns < FRAME_NS)
		return true;
	live->drawn_ns = now;
	note_moves(live->board);
	return draw(live);
}

static void loop(struct live *live)
{
	bool going = show(live);

	pace_start(live->pace, clock_now());
	while (going && !tty_stopped() && !pace_is_over(live->pace)) {
		int64_t wait = FRAME_NS;

		if (!is_idle(live)) {
			int64_t due = pace_wait(live->pace, clock_now());

			if (due <= 0)
				scan(live);
			wait = due <= 0 ? 0 : due < FRAME_NS ? due : FRAME_NS;
		}
		going = take_key(live, tty_key(wait)) && show(live);
	}
}

enum status live_run(struct call *call, struct board *board, struct pace *pace,
		     const struct project *project, const char *rungs)
{
	struct live live = { .board = board, .pace = pace, .project = project,
			     .rungs = rungs, .file = call->arg[0],
			     .utf8 = tty_utf8(), .title = project ?
			     project_text(project, project->title) : "" };

	live.screen.colour = !getenv("NO_COLOR");
	tty_watch_signals();
	if (!tty_open()) {
		tty_close();
		return report_usage(call, "this terminal cannot be used");
	}
	loop(&live);
	tty_close();
	screen_free(&live.screen);
	sink_memory_free(&live.drawing);
	sink_printf(&call->out, "stopped after %llu scans, longest %.1f us\n",
		    (unsigned long long)pace->scans,
		    (double)live.scan_max_ns / 1e3);
	return board->resource->state == STATE_FAULT ? STATUS_NO : STATUS_GOOD;
}
