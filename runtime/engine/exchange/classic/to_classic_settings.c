/* SPDX-License-Identifier: MIT
 *
 * to_classic_settings - general.txt and project_infos.txt: the period, how large the
 * project is, its name.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include <string.h>

static void setting(struct leaving *e, const char *key, const char *value)
{
	struct classic_setting *one = arena_push(e->arena, &e->out->setting,
						 &e->out->settings, sizeof(*one));

	if (one) {
		one->key = key;
		one->value = value;
	}
}

static void size(struct leaving *e, const char *key, int count, int usual)
{
	setting(e, key, out_text(e, "%d", count > usual ? count : usual));
}

int blocks_end(const struct classic_blocks *blocks)
{
	return blocks->count ? blocks->block[blocks->count - 1].number + 1 : 0;
}

/* An array of all words tells how many there are. */
static int word_count(const struct leaving *e, int type, int usual)
{
	for (int i = 0; i < e->slots; i++)
		if (e->slot[i].type == type && e->slot[i].count > 1 && !e->slot[i].number &&
		    e->slot[i].count < usual)
			return e->slot[i].count;
	return usual;
}

/* A table of 64 lines. LinuxCNC has pins of its own: HAL's. */
static void leave_lines(struct leaving *e)
{
	enum { LINES = 32 };
	int used[2] = { 0, 0 };

	if (!e->lines || !e->lines->count)
		return;
	if (e->dialect != CLASSIC_UPSTREAM) {
		tell_line(e, 0, e->dialect == CLASSIC_LINUXCNC ?
			  "the I/O map stays here: LinuxCNC connects pins of HAL" :
			  "the I/O map stays here: a bare rung file has none");
		return;
	}
	for (int i = 0; i < e->lines->count; i++) {
		const struct classic_io *from = &e->lines->io[i];
		struct classic_io *to;

		if (used[from->output]++ == LINES) {
			out_refuse(e, DIAG_EXPORT_MANY, "%s", from->output ?
				   "lines of outputs in the I/O map" :
				   "lines of inputs in the I/O map");
			return;
		}
		to = arena_push(e->arena, &e->out->io, &e->out->ios, sizeof(*to));
		if (to)
			*to = *from;
		size_note(e, from->output ? 60 : 50, from->first + from->count - 1);
	}
}

void leave_settings(struct leaving *e)
{
	struct classic_project *out = e->out;

	const char *title = plain_title(e, project_text(e->project, e->project->title));

	leave_lines(e);
	setting(e, "PROJECT_NAME", title);
	if (strlen(title) > CLASSIC_COMMENT)
		tell_line(e, 0, "the project's name is cut to %d bytes", CLASSIC_COMMENT);
	setting(e, "PERIODIC_REFRESH", out_text(e, "%d", out->period));
	setting(e, "PERIODIC_INPUTS_REFRESH", out_text(e, "%d", e->lines &&
		e->lines->sample_ms ? e->lines->sample_ms : 10));
	setting(e, "REAL_INPUTS_OUTPUTS_ONLY_ON_TARGET", "0");
	size(e, "SIZE_NBR_RUNGS", out->rungs, 100);
	size(e, "SIZE_NBR_BITS", e->sizes[CL_BIT], 500);
	size(e, "SIZE_NBR_WORDS", e->sizes[CL_WORD], word_count(e, CL_WORD, 200));
	size(e, "SIZE_NBR_TIMERS", blocks_end(&out->timer), 10);
	size(e, "SIZE_NBR_MONOSTABLES", blocks_end(&out->monostable), 10);
	size(e, "SIZE_NBR_COUNTERS", blocks_end(&out->counter), 10);
	size(e, "SIZE_NBR_TIMERS_IEC", blocks_end(&out->iec_timer), 10);
	size(e, "SIZE_NBR_REGISTERS", blocks_end(&out->reg), 10);
	setting(e, "SIZE_REGISTER_LIST", out_text(e, "%d", out->register_list));
	size(e, "SIZE_NBR_PHYS_INPUTS", e->sizes[50], 50);
	size(e, "SIZE_NBR_PHYS_OUTPUTS", e->sizes[60], 50);
	size(e, "SIZE_NBR_ARITHM_EXPR", out->expressions, 100);
	size(e, "SIZE_NBR_SECTIONS", out->sections, 10);
	size(e, "SIZE_NBR_SYMBOLS", out->symbols, 100);
	size(e, "SIZE_NBR_PHYS_WORDS_INPUTS", e->sizes[270], word_count(e, 270, 25));
	size(e, "SIZE_NBR_PHYS_WORDS_OUTPUTS", e->sizes[280], word_count(e, 280, 25));
}
