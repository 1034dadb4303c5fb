/* SPDX-License-Identifier: MIT
 *
 * sim_past - what of a simulation is shown: the newest copy, or a scan that was, maybe of a
 * program before an edit.
 */
#include "editor-gtk/sim/sim_object.h"

#include <string.h>

/* ---- what is shown ---- */

const struct twin *ladder_sim_twin(LadderSim *sim)
{
	if (!sim->thread)
		return NULL;
	return sim->past ? sim_replay_twin(sim->replay) : &sim->view.twin;
}

bool ladder_sim_lateness(LadderSim *sim, struct sim_lateness *out)
{
	return sim->thread && sim_thread_lateness(sim->thread, out);
}

int ladder_sim_rung(LadderSim *sim, LadderDocument *document, int pou, int rung)
{
	if (!sim->thread)
		return -1;
	if (ladder_sim_older(sim, NULL))
		return document == sim->older ? rung : -1;
	return document == sim->document ? sim_rungs_find(sim->rungs, pou, rung) : -1;
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

/* ---- a look of one's own ---- */

struct sim_replay {
	struct replay replay;
	struct sim_program *program, *plant; /* whose scan it is; NULL: of none   */
	guint64 era;
	gint64 edited_us;        /* as it was when it was looked at            */
};

struct sim_replay *sim_replay_new(void)
{
	return g_new0(struct sim_replay, 1);
}

static void replay_clear(struct sim_replay *replay)
{
	replay_free(&replay->replay);
	g_clear_pointer(&replay->program, sim_program_unref);
	g_clear_pointer(&replay->plant, sim_program_unref);
	memset(replay, 0, sizeof(*replay));
}

void sim_replay_free(struct sim_replay *replay)
{
	if (!replay)
		return;
	replay_clear(replay);
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
	replay_clear(replay);
	if (!replay_init(&replay->replay, era->record))
		return false;
	replay->program = sim_program_ref(era->program);
	replay->plant = sim_program_ref(era->plant);
	replay->era = era->id;
	return true;
}

static bool step(struct sim_replay *replay, const struct sim_era *era, guint64 scan)
{
	if (replay->era != era->id && !take_era(replay, era))
		return false;
	replay->edited_us = era->edited_us;
	return replay_jump(&replay->replay, era->record, scan) &&
	       (replay->replay.twin.scan >= scan ||
		replay_next(&replay->replay, era->record));
}

bool ladder_sim_replay(LadderSim *sim, struct sim_replay *replay, guint64 scan)
{
	const struct sim_era *era;
	bool good;

	if (!sim->thread)
		return false;
	era = sim_eras_find(sim_thread_lock(sim->thread), scan);
	good = era && step(replay, era, scan);
	sim_thread_unlock(sim->thread);
	return good;
}

/* ---- the past ---- */

struct sim_program *sim_shown_program(LadderSim *sim)
{
	return sim->past ? sim->replay->program : sim->view.program;
}

struct ladder *ladder_sim_ladder(LadderSim *sim)
{
	const struct sim_program *program = sim_shown_program(sim);

	return program ? program->ladder : NULL;
}

struct ladder *ladder_sim_plant_ladder(LadderSim *sim)
{
	const struct sim_program *plant = sim->past ? sim->replay->plant : sim->view.plant;

	return plant ? plant->ladder : NULL;
}

/* After another scan may be shown than was. */
static void tell_shown(LadderSim *sim, const struct sim_program *before)
{
	if (sim_shown_program(sim) != before)
		g_signal_emit_by_name(sim, "program-changed");
	g_signal_emit_by_name(sim, "shown");
}

/* A scan at a time, so that the thread need not wait for long. */
static bool replay_to(LadderSim *sim, guint64 scan)
{
	bool good;

	do
		good = ladder_sim_replay(sim, sim->replay, scan);
	while (good && sim->replay->replay.twin.scan < scan);
	return good;
}

bool ladder_sim_show(LadderSim *sim, guint64 scan)
{
	struct sim_program *before = sim_program_ref(sim_shown_program(sim));
	bool good;

	if (!sim->replay)
		sim->replay = sim_replay_new();
	good = replay_to(sim, scan);
	/* What is half on its way is no scan, and it may be of no program. */
	sim->past = good || (sim->past && sim->replay->program);
	if (good || sim_shown_program(sim) != before)
		tell_shown(sim, before);
	sim_program_unref(before);
	return good;
}

void ladder_sim_show_now(LadderSim *sim)
{
	struct sim_program *before;

	if (!sim->past)
		return;
	before = sim_program_ref(sim_shown_program(sim));
	sim->past = false;
	tell_shown(sim, before);
	sim_program_unref(before);
}

bool ladder_sim_is_past(LadderSim *sim)
{
	return sim->past;
}

void sim_forget_replay(LadderSim *sim)
{
	sim->past = false;
	g_clear_pointer(&sim->replay, sim_replay_free);
	g_clear_object(&sim->older);
	sim->older_era = 0;
}

/* ---- the record ---- */

guint64 ladder_sim_first(LadderSim *sim)
{
	guint64 first = 0;

	if (sim->thread) {
		first = sim_eras_first(sim_thread_lock(sim->thread));
		sim_thread_unlock(sim->thread);
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

gsize ladder_sim_record_bytes(LadderSim *sim)
{
	gsize bytes = 0;

	if (sim->thread) {
		bytes = sim_eras_bytes(sim_thread_lock(sim->thread));
		sim_thread_unlock(sim->thread);
	}
	return bytes;
}

const struct record *ladder_sim_lock_record(LadderSim *sim)
{
	return sim->thread ? sim_eras_newest(sim_thread_lock(sim->thread))->record : NULL;
}

void ladder_sim_unlock_record(LadderSim *sim)
{
	sim_thread_unlock(sim->thread);
}

/* ---- programs before an edit ---- */

bool ladder_sim_next_edit(LadderSim *sim, guint64 scan, struct sim_edited *out)
{
	const struct sim_era *era;
	bool good;

	if (!sim->thread)
		return false;
	era = sim_eras_find(sim_thread_lock(sim->thread), scan);
	good = era && era->edited_us;
	if (good)
		*out = (struct sim_edited){ record_last(era->record), era->edited_us };
	sim_thread_unlock(sim->thread);
	return good;
}

static LadderDocument *document_of(LadderSim *sim, const struct sim_program *program)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, ladder_document_path(sim->document),
				  program->text, strlen(program->text), true);
	ladder_document_fix(document);
	return document;
}

LadderDocument *ladder_sim_older(LadderSim *sim, struct sim_edited *edit)
{
	const struct sim_replay *replay = sim->replay;

	if (!sim->past || !replay->edited_us)
		return NULL;
	if (sim->older_era != replay->era) {
		g_clear_object(&sim->older);
		sim->older = document_of(sim, replay->program);
		sim->older_era = replay->era;
	}
	if (edit && !ladder_sim_next_edit(sim, replay->replay.twin.scan, edit))
		*edit = (struct sim_edited){ replay->replay.twin.scan, replay->edited_us };
	return sim->older;
}

guint64 ladder_sim_life(LadderSim *sim)
{
	return sim->life;
}
