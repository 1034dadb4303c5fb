/* SPDX-License-Identifier: MIT
 *
 * chart - rings of samples, one a variable, filled from the record.
 */
#include "editor-gtk/live/timing.h"

#include "engine/trial/value.h"

#include <string.h>

struct line {
	char *name;
	struct location at;   /* in the program whose scan is shown             */
	struct location here; /* in that of the scan that is taken              */
	double *sample;       /* CHART_SCANS of them, by scan                   */
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

static struct location locate(const struct line *line, const struct twin *twin)
{
	enum diag_id why;

	return twin ? value_find(&twin->resource.image, line->name, strlen(line->name),
				 &why) : (struct location){ .type = IEC_NONE };
}

static void begin_anew(struct timing *timing)
{
	timing->first = timing->end = 0;
	timing->program = 0;
}

bool timing_add(struct timing *timing, const char *name)
{
	struct line *line;

	if (timing->lines->len >= TIMING_LINES)
		return false;
	for (int i = 0; i < timing_lines(timing); i++)
		if (g_ascii_strcasecmp(timing_name(timing, i), name) == 0)
			return false;
	line = g_new0(struct line, 1);
	line->name = g_strdup(name);
	line->sample = g_new0(double, TIMING_SCANS);
	line->at = locate(line, ladder_sim_twin(timing->sim));
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
	const struct twin *twin = ladder_sim_twin(timing->sim);

	if (timing->life != ladder_sim_life(timing->sim)) {
		timing->life = ladder_sim_life(timing->sim);
		sim_replay_free(timing->replay);
		timing->replay = sim_replay_new();
		begin_anew(timing);
	}
	for (int i = 0; i < timing_lines(timing); i++)
		line_at(timing, i)->at = locate(line_at(timing, i), twin);
}

/* ---- samples ---- */

static double number(struct location at, union iec_value value)
{
	switch (iec_type_row(at.type)->class) {
	case CLASS_REAL: return value.r;
	case CLASS_STRING: return value.s->length;
	case CLASS_TIME: return (double)value.i / 1e6;
	default: return (double)value.i;
	}
}

/* Behind an edit a name may stand elsewhere. */
static void find_here(struct timing *timing, const struct twin *twin)
{
	const guint64 program = sim_replay_program(timing->replay);

	if (timing->program == program)
		return;
	timing->program = program;
	for (int i = 0; i < timing_lines(timing); i++)
		line_at(timing, i)->here = locate(line_at(timing, i), twin);
}

static void take(struct timing *timing, const struct twin *twin)
{
	const guint64 slot = twin->scan % TIMING_SCANS;

	find_here(timing, twin);
	timing->time[slot] = twin->now_ns;
	for (int i = 0; i < timing_lines(timing); i++) {
		struct line *line = line_at(timing, i);

		line->sample[slot] = line->here.type == IEC_NONE ? 0 :
			number(line->here, image_get(&twin->resource.image, line->here));
	}
	timing->end = twin->scan + 1;
	if (timing->end - timing->first > TIMING_SCANS)
		timing->first = timing->end - TIMING_SCANS;
}

/* Where it goes on: behind what it has, or, if the record or the room does not reach back
 * so far, later. */
static guint64 next_scan(struct timing *timing, guint64 first, guint64 last)
{
	const guint64 room = last >= TIMING_SCANS ? last + 1 - TIMING_SCANS : 0;
	const guint64 least = MAX(first, room);

	if (timing->end < least || timing->end > last + 1 || timing->first == timing->end)
		timing->first = timing->end = least;
	return timing->end;
}

/* One scan, or a step to it; false: there is none. */
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
