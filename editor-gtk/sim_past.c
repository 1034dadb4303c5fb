/* SPDX-License-Identifier: MIT
 *
 * sim_past - what of a simulation is shown: the newest copy, or a scan that was.
 */
#include "editor-gtk/sim_object.h"

/* ---- what is shown ---- */

const struct twin *ladder_sim_twin(LadderSim *sim)
{
	if (!sim->thread)
		return NULL;
	return sim->past ? &sim->replay.twin : &sim->view.twin;
}

bool ladder_sim_lateness(LadderSim *sim, struct sim_lateness *out)
{
	return sim->thread && sim_thread_lateness(sim->thread, out);
}

struct ladder *ladder_sim_ladder(LadderSim *sim)
{
	return sim->view.program ? sim->view.program->ladder : NULL;
}

struct ladder *ladder_sim_plant_ladder(LadderSim *sim)
{
	return sim->view.plant ? sim->view.plant->ladder : NULL;
}

int ladder_sim_rung(LadderSim *sim, int pou, int rung)
{
	return sim->thread ? sim_rungs_find(sim->rungs, pou, rung) : -1;
}

bool ladder_sim_is_forced(LadderSim *sim, struct location at)
{
	const struct twin *twin = ladder_sim_twin(sim);

	return twin && image_is_forced(&twin->resource.image, at);
}

int ladder_sim_forces(LadderSim *sim)
{
	const struct twin *twin = ladder_sim_twin(sim);

	return twin ? twin->resource.image.force_count + twin->plant.image.force_count : 0;
}

/* ---- the past ---- */

guint64 ladder_sim_first(LadderSim *sim)
{
	const struct record *record = ladder_sim_lock_record(sim);
	guint64 first = 0;

	if (record) {
		first = record_first(record);
		ladder_sim_unlock_record(sim);
	}
	return first;
}

guint64 ladder_sim_last(LadderSim *sim)
{
	const struct record *record = ladder_sim_lock_record(sim);
	guint64 last = 0;

	if (record) {
		last = record_last(record);
		ladder_sim_unlock_record(sim);
	}
	return last;
}

/* A scan at a time, so that the thread need not wait for long. */
static bool replay_to(LadderSim *sim, guint64 scan)
{
	bool good = true, begun = false;

	while (good) {
		const struct record *record = sim_thread_lock(sim->thread);

		if (!begun)
			good = (sim->replay.twin.resource.image.program ||
				replay_init(&sim->replay, record)) &&
			       replay_jump(&sim->replay, record, scan);
		else
			good = replay_next(&sim->replay, record);
		begun = true;
		sim_thread_unlock(sim->thread);
		if (sim->replay.twin.scan >= scan)
			return good;
	}
	return false;
}

bool ladder_sim_show(LadderSim *sim, guint64 scan)
{
	if (!sim->thread || !replay_to(sim, scan))
		return false;
	sim->past = true;
	g_signal_emit_by_name(sim, "shown");
	return true;
}

void ladder_sim_show_now(LadderSim *sim)
{
	if (!sim->past)
		return;
	sim->past = false;
	g_signal_emit_by_name(sim, "shown");
}

bool ladder_sim_is_past(LadderSim *sim)
{
	return sim->past;
}

const struct record *ladder_sim_lock_record(LadderSim *sim)
{
	return sim->thread ? sim_thread_lock(sim->thread) : NULL;
}

void ladder_sim_unlock_record(LadderSim *sim)
{
	sim_thread_unlock(sim->thread);
}

void sim_forget_replay(LadderSim *sim)
{
	replay_free(&sim->replay);
	sim->past = false;
}
