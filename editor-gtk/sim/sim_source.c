/* SPDX-License-Identifier: MIT
 *
 * sim_source - what both sources share: views and replays of records.
 */
#include "editor-gtk/sim/sim_source.h"

#include <string.h>

void sim_view_clear(struct sim_view *view)
{
	twin_free(&view->twin);
	view->frames = 0;
	g_clear_pointer(&view->outside, g_free);
	g_clear_pointer(&view->program, sim_program_unref);
	g_clear_pointer(&view->plant, sim_program_unref);
}

/* ---- replays ---- */

struct sim_replay *sim_replay_new(void)
{
	return g_new0(struct sim_replay, 1);
}

void sim_replay_clear(struct sim_replay *replay)
{
	replay_free(&replay->replay);
	g_free(replay->bad);
	g_clear_pointer(&replay->program, sim_program_unref);
	g_clear_pointer(&replay->plant, sim_program_unref);
	memset(replay, 0, sizeof(*replay));
}

void sim_replay_free(struct sim_replay *replay)
{
	if (!replay)
		return;
	sim_replay_clear(replay);
	g_free(replay);
}

const struct twin *sim_replay_twin(const struct sim_replay *replay)
{
	return replay->program ? &replay->replay.twin : NULL;
}

guint64 sim_replay_program(const struct sim_replay *replay)
{
	return replay->era;
}

static bool take_era(struct sim_replay *replay, const struct sim_era *era)
{
	sim_replay_clear(replay);
	if (!replay_init(&replay->replay, era->record))
		return false;
	replay->program = sim_program_ref(era->program);
	replay->plant = sim_program_ref(era->plant);
	replay->era = era->id;
	return true;
}

static bool replay_step(struct sim_replay *replay, const struct sim_era *era, guint64 scan)
{
	if (replay->era != era->id && !take_era(replay, era))
		return false;
	replay->edited_us = era->edited_us;
	return replay_jump(&replay->replay, era->record, scan) &&
	       (replay->replay.twin.scan >= scan ||
		replay_next(&replay->replay, era->record));
}

bool sim_eras_replay(const struct sim_eras *eras, struct sim_replay *replay, guint64 scan)
{
	const struct sim_era *era = sim_eras_find(eras, scan);

	return era && replay_step(replay, era, scan);
}
