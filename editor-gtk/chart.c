/* SPDX-License-Identifier: MIT
 *
 * chart - rings of samples, one a variable, filled from the record.
 */
#include "editor-gtk/chart.h"

#include "engine/trial/value.h"

#include <string.h>

struct line {
	char *name;
	struct location at;   /* in the program whose scan is shown             */
	struct location here; /* in that of the scan that is taken              */
	double *sample;       /* CHART_SCANS of them, by scan                   */
};
struct chart {
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

struct chart *chart_new(LadderSim *sim)
{
	struct chart *chart = g_new0(struct chart, 1);

	chart->sim = sim;
	chart->replay = sim_replay_new();
	chart->life = ladder_sim_life(sim);
	chart->lines = g_ptr_array_new_with_free_func(line_free);
	chart->time = g_new0(gint64, CHART_SCANS);
	return chart;
}

void chart_free(struct chart *chart)
{
	if (!chart)
		return;
	sim_replay_free(chart->replay);
	g_ptr_array_unref(chart->lines);
	g_free(chart->time);
	g_free(chart);
}

static struct line *line_at(const struct chart *chart, int line)
{
	return chart->lines->pdata[line];
}

/* ---- lines ---- */

static struct location locate(const struct line *line, const struct twin *twin)
{
	enum diag_id why;

	return twin ? value_find(&twin->resource.image, line->name, strlen(line->name),
				 &why) : (struct location){ .type = IEC_NONE };
}

static void begin_anew(struct chart *chart)
{
	chart->first = chart->end = 0;
	chart->program = 0;
}

bool chart_add(struct chart *chart, const char *name)
{
	struct line *line;

	if (chart->lines->len >= CHART_LINES)
		return false;
	for (int i = 0; i < chart_lines(chart); i++)
		if (g_ascii_strcasecmp(chart_name(chart, i), name) == 0)
			return false;
	line = g_new0(struct line, 1);
	line->name = g_strdup(name);
	line->sample = g_new0(double, CHART_SCANS);
	line->at = locate(line, ladder_sim_twin(chart->sim));
	g_ptr_array_add(chart->lines, line);
	begin_anew(chart);
	return true;
}

void chart_remove(struct chart *chart, int line)
{
	g_ptr_array_remove_index(chart->lines, (guint)line);
}

void chart_move(struct chart *chart, int line, int to)
{
	gpointer moved = g_ptr_array_steal_index(chart->lines, (guint)line);

	g_ptr_array_insert(chart->lines, to, moved);
}

int chart_lines(const struct chart *chart)
{
	return (int)chart->lines->len;
}

const char *chart_name(const struct chart *chart, int line)
{
	return line_at(chart, line)->name;
}

struct location chart_at(const struct chart *chart, int line)
{
	return line_at(chart, line)->at;
}

void chart_program_changed(struct chart *chart)
{
	const struct twin *twin = ladder_sim_twin(chart->sim);

	if (chart->life != ladder_sim_life(chart->sim)) {
		chart->life = ladder_sim_life(chart->sim);
		sim_replay_free(chart->replay);
		chart->replay = sim_replay_new();
		begin_anew(chart);
	}
	for (int i = 0; i < chart_lines(chart); i++)
		line_at(chart, i)->at = locate(line_at(chart, i), twin);
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
static void find_here(struct chart *chart, const struct twin *twin)
{
	const guint64 program = sim_replay_program(chart->replay);

	if (chart->program == program)
		return;
	chart->program = program;
	for (int i = 0; i < chart_lines(chart); i++)
		line_at(chart, i)->here = locate(line_at(chart, i), twin);
}

static void take(struct chart *chart, const struct twin *twin)
{
	const guint64 slot = twin->scan % CHART_SCANS;

	find_here(chart, twin);
	chart->time[slot] = twin->now_ns;
	for (int i = 0; i < chart_lines(chart); i++) {
		struct line *line = line_at(chart, i);

		line->sample[slot] = line->here.type == IEC_NONE ? 0 :
			number(line->here, image_get(&twin->resource.image, line->here));
	}
	chart->end = twin->scan + 1;
	if (chart->end - chart->first > CHART_SCANS)
		chart->first = chart->end - CHART_SCANS;
}

/* Where it goes on: behind what it has, or, if the record or the room does not reach back
 * so far, later. */
static guint64 next_scan(struct chart *chart, guint64 first, guint64 last)
{
	const guint64 room = last >= CHART_SCANS ? last + 1 - CHART_SCANS : 0;
	const guint64 least = MAX(first, room);

	if (chart->end < least || chart->end > last + 1 || chart->first == chart->end)
		chart->first = chart->end = least;
	return chart->end;
}

/* One scan, or a step to it; false: there is none. */
static bool step(struct chart *chart)
{
	const guint64 last = ladder_sim_last(chart->sim);
	const struct twin *twin;
	guint64 scan;

	if (!ladder_sim_is_on(chart->sim))
		return false;
	scan = next_scan(chart, ladder_sim_first(chart->sim), last);
	if (scan > last || !ladder_sim_replay(chart->sim, chart->replay, scan))
		return false;
	twin = sim_replay_twin(chart->replay);
	if (twin->scan == scan)
		take(chart, twin);
	return true;
}

bool chart_feed(struct chart *chart, gint64 us)
{
	const gint64 until = g_get_monotonic_time() + us;
	bool more = true;

	while (more && g_get_monotonic_time() < until)
		more = step(chart);
	return more;
}

guint64 chart_first(const struct chart *chart)
{
	return chart->first;
}

guint64 chart_end(const struct chart *chart)
{
	return chart->end;
}

gint64 chart_time(const struct chart *chart, guint64 scan)
{
	return chart->time[scan % CHART_SCANS];
}

guint64 chart_scan_at(const struct chart *chart, gint64 ns)
{
	guint64 low = chart->first, high = chart->end;

	while (high - low > 1) {
		const guint64 middle = low + (high - low) / 2;

		if (chart_time(chart, middle) <= ns)
			low = middle;
		else
			high = middle;
	}
	return low;
}

double chart_value(const struct chart *chart, int line, guint64 scan)
{
	return line_at(chart, line)->sample[scan % CHART_SCANS];
}

bool chart_range(const struct chart *chart, int line, guint64 from, guint64 to,
		 double *low, double *high)
{
	const double *sample = line_at(chart, line)->sample;

	from = MAX(from, chart->first);
	to = MIN(to + 1, chart->end);
	if (from >= to)
		return false;
	*low = *high = sample[from % CHART_SCANS];
	for (guint64 scan = from + 1; scan < to; scan++) {
		const double value = sample[scan % CHART_SCANS];

		*low = MIN(*low, value);
		*high = MAX(*high, value);
	}
	return true;
}
