/* SPDX-License-Identifier: MIT
 *
 * timing - a ring of samples for each variable, filled from the record; and the lines of the
 * VIEW part that keep the variables.
 */
#include "editor-gtk/live/timing.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"
#include "engine/base/name.h"

#include <string.h>

#define LINE "timing"

struct line {
	char *name;
	struct location at;   /* in the program whose scan is shown             */
	struct location here; /* in that of the scan that is taken              */
	double *sample;       /* TIMING_SCANS of them, by scan                  */
	guint8 *quality;      /* likewise, of enum sim_quality                  */
};
struct timing {
	LadderSim *sim;
	struct sim_replay *replay;
	guint64 program;   /* that `here` of the lines is of; 0: of none        */
	guint64 life;      /* of the simulation, that the samples are of        */
	GPtrArray *lines;  /* of struct line                                   */
	gint64 *time;
	guint64 first, end;
};

static void line_free(gpointer pointer)
{
	struct line *line = pointer;

	g_free(line->name);
	g_free(line->sample);
	g_free(line->quality);
	g_free(line);
}

struct timing *timing_new(LadderSim *sim)
{
	struct timing *timing = g_new0(struct timing, 1);

	timing->sim = sim;
	timing->replay = sim_replay_new();
	timing->life = ladder_sim_life(sim);
	timing->lines = g_ptr_array_new_with_free_func(line_free);
	timing->time = g_new0(gint64, TIMING_SCANS);
	return timing;
}

void timing_free(struct timing *timing)
{
	if (!timing)
		return;
	sim_replay_free(timing->replay);
	g_ptr_array_unref(timing->lines);
	g_free(timing->time);
	g_free(timing);
}

static struct line *line_at(const struct timing *timing, int line)
{
	return timing->lines->pdata[line];
}

/* ---- lines ---- */

static void begin_anew(struct timing *timing)
{
	timing->first = timing->end = 0;
	timing->program = 0;
}

bool timing_has(const struct timing *timing, const char *name)
{
	const struct location at = live_value_find(live_image(timing->sim, false), name);

	for (int i = 0; i < timing_lines(timing); i++)
		if (name_equal(timing_name(timing, i), name) ||
		    live_value_is_same(timing_at(timing, i), at))
			return true;
	return false;
}

bool timing_add(struct timing *timing, const char *name)
{
	struct line *line;

	if (timing->lines->len >= TIMING_LINES || timing_has(timing, name))
		return false;
	line = g_new0(struct line, 1);
	line->name = g_strdup(name);
	line->sample = g_new0(double, TIMING_SCANS);
	line->quality = g_new0(guint8, TIMING_SCANS);
	line->at = live_value_find(live_image(timing->sim, false), name);
	g_ptr_array_add(timing->lines, line);
	begin_anew(timing);
	return true;
}

void timing_remove(struct timing *timing, int line)
{
	g_ptr_array_remove_index(timing->lines, (guint)line);
}

void timing_move(struct timing *timing, int line, int to)
{
	gpointer moved = g_ptr_array_steal_index(timing->lines, (guint)line);

	g_ptr_array_insert(timing->lines, to, moved);
}

int timing_lines(const struct timing *timing)
{
	return (int)timing->lines->len;
}

const char *timing_name(const struct timing *timing, int line)
{
	return line_at(timing, line)->name;
}

struct location timing_at(const struct timing *timing, int line)
{
	return line_at(timing, line)->at;
}

void timing_program_changed(struct timing *timing)
{
	const struct image *image = live_image(timing->sim, false);

	if (timing->life != ladder_sim_life(timing->sim)) {
		timing->life = ladder_sim_life(timing->sim);
		sim_replay_free(timing->replay);
		timing->replay = sim_replay_new();
		begin_anew(timing);
	}
	for (int i = 0; i < timing_lines(timing); i++)
		line_at(timing, i)->at = live_value_find(image, timing_name(timing, i));
}

/* ---- samples ---- */

/* After an edit a variable may be at another place. */
static void find_here(struct timing *timing, const struct image *image)
{
	const guint64 program = sim_replay_program(timing->replay);

	if (timing->program == program)
		return;
	timing->program = program;
	for (int i = 0; i < timing_lines(timing); i++)
		line_at(timing, i)->here = live_value_find(image, timing_name(timing, i));
}

static void take(struct timing *timing, const struct twin *twin)
{
	const guint64 slot = twin->scan % TIMING_SCANS;
	const struct image *image = &twin->resource.image;

	find_here(timing, image);
	timing->time[slot] = twin->now_ns;
	for (int i = 0; i < timing_lines(timing); i++) {
		struct line *line = line_at(timing, i);

		line->sample[slot] = line->here.type == IEC_NONE ? 0 :
			live_value_number(line->here.type, image_get(image, line->here));
		line->quality[slot] = (guint8)(image_is_forced(image, line->here) ? SIM_FORCED :
			ladder_sim_replay_quality(timing->sim, timing->replay, line->here));
	}
	timing->end = twin->scan + 1;
	if (timing->end - timing->first > TIMING_SCANS)
		timing->first = timing->end - TIMING_SCANS;
}

/* The scan to take next: the one after the last, or a later one if the record or the ring does
 * not reach back so far. */
static guint64 next_scan(struct timing *timing, guint64 first, guint64 last)
{
	const guint64 room = last >= TIMING_SCANS ? last + 1 - TIMING_SCANS : 0;
	const guint64 least = MAX(first, room);

	if (timing->end < least || timing->end > last + 1 || timing->first == timing->end)
		timing->first = timing->end = least;
	return timing->end;
}

/* Takes one scan, or moves the replay nearer to it. False: there is no scan to take. */
static bool step(struct timing *timing)
{
	const guint64 last = ladder_sim_last(timing->sim);
	const struct twin *twin;
	guint64 scan;

	if (!ladder_sim_is_on(timing->sim))
		return false;
	scan = next_scan(timing, ladder_sim_first(timing->sim), last);
	if (scan > last || !ladder_sim_replay(timing->sim, timing->replay, scan))
		return false;
	twin = sim_replay_twin(timing->replay);
	if (twin->scan == scan)
		take(timing, twin);
	return true;
}

bool timing_feed(struct timing *timing, gint64 us)
{
	const gint64 until = g_get_monotonic_time() + us;
	bool more = true;

	while (more && g_get_monotonic_time() < until)
		more = step(timing);
	return more;
}

guint64 timing_first(const struct timing *timing)
{
	return timing->first;
}

guint64 timing_end(const struct timing *timing)
{
	return timing->end;
}

gint64 timing_time(const struct timing *timing, guint64 scan)
{
	return timing->time[scan % TIMING_SCANS];
}

guint64 timing_scan_at(const struct timing *timing, gint64 ns)
{
	guint64 low = timing->first, high = timing->end;

	while (high - low > 1) {
		const guint64 middle = low + (high - low) / 2;

		if (timing_time(timing, middle) <= ns)
			low = middle;
		else
			high = middle;
	}
	return low;
}

double timing_value(const struct timing *timing, int line, guint64 scan)
{
	return line_at(timing, line)->sample[scan % TIMING_SCANS];
}

enum sim_quality timing_quality(const struct timing *timing, int line, guint64 scan)
{
	return (enum sim_quality)line_at(timing, line)->quality[scan % TIMING_SCANS];
}

bool timing_range(const struct timing *timing, int line, guint64 from, guint64 to,
		 double *low, double *high)
{
	const double *sample = line_at(timing, line)->sample;

	from = MAX(from, timing->first);
	to = MIN(to + 1, timing->end);
	if (from >= to)
		return false;
	*low = *high = sample[from % TIMING_SCANS];
	for (guint64 scan = from + 1; scan < to; scan++) {
		const double value = sample[scan % TIMING_SCANS];

		*low = MIN(*low, value);
		*high = MAX(*high, value);
	}
	return true;
}

/* ---- what the project keeps ---- */

/* The name in a line `timing NAME`; NULL: another line. Caller frees. */
static char *name_in(const char *line)
{
	const char *name = live_line_after(line, LINE);
	const gsize len = name ? strcspn(name, " \t\r") : 0;

	return len ? g_strndup(name, len) : NULL;
}

char **timing_kept_read(const char *view)
{
	GPtrArray *names = g_ptr_array_new();
	char **lines = g_strsplit(view, "\n", -1);

	for (char **line = lines; *line; line++) {
		char *name = name_in(*line);

		if (name)
			g_ptr_array_add(names, name);
	}
	g_ptr_array_add(names, NULL);
	g_strfreev(lines);
	return (char **)g_ptr_array_free(names, FALSE);
}

static bool is_own(void *context, const char *line)
{
	char *name = name_in(line);

	(void)context;
	g_free(name);
	return name != NULL;
}

char *timing_kept_write(const char *view, const char *const *names)
{
	GString *own = g_string_new(NULL);
	char *text;

	for (int i = 0; names[i]; i++)
		g_string_append_printf(own, "  " LINE " %s\n", names[i]);
	text = live_lines_replace(view, is_own, NULL, own->str);
	g_string_free(own, TRUE);
	return text;
}

void timing_kept_put(LadderDocument *document, const char *const *names)
{
	const char *view = ladder_document_view(document);
	char **before = timing_kept_read(view);

	if (ladder_document_project(document) &&
	    !g_strv_equal((const char *const *)before, names))
		live_lines_keep(document, timing_kept_write(view, names),
				_("Change variables of the timing chart"));
	g_strfreev(before);
}
