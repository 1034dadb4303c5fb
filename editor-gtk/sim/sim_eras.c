/* SPDX-License-Identifier: MIT
 *
 * sim_eras - the records of the programs that ran one after the other, from edit to edit.
 *
 * A record has one program. After an edit another record begins at the same scan; the one
 * before is kept with its program, so that its scans can be shown. Scan numbers continue, and
 * no scan between two eras is missing.
 */
#include "editor-gtk/sim/sim_eras.h"

#include <string.h>

struct sim_eras {
	GPtrArray *era;          /* of struct sim_era; the last one runs        */
	guint64 ids;
	gsize ended;             /* bytes of all others                        */
};

static struct sim_era *at(const struct sim_eras *eras, guint index)
{
	return eras->era->pdata[index];
}

static struct sim_era *newest(const struct sim_eras *eras)
{
	return at(eras, eras->era->len - 1);
}

static void era_free(gpointer pointer)
{
	struct sim_era *era = pointer;

	record_free(era->record);
	sim_program_unref(era->program);
	sim_program_unref(era->plant);
	g_free(era);
}

static bool begin(struct sim_eras *eras, const struct twin *twin,
		  struct sim_program *program, struct sim_program *plant)
{
	struct record *record = record_new(twin, SIM_SCANS, SIM_BYTES);
	struct sim_era *era;

	if (!record)
		return false;
	era = g_new0(struct sim_era, 1);
	*era = (struct sim_era){ .id = ++eras->ids, .record = record,
		.program = sim_program_ref(program), .plant = sim_program_ref(plant) };
	g_ptr_array_add(eras->era, era);
	return true;
}

struct sim_eras *sim_eras_new(const struct twin *twin, struct sim_program *program,
			      struct sim_program *plant)
{
	struct sim_eras *eras = g_new0(struct sim_eras, 1);

	eras->era = g_ptr_array_new_with_free_func(era_free);
	if (begin(eras, twin, program, plant))
		return eras;
	sim_eras_free(eras);
	return NULL;
}

void sim_eras_free(struct sim_eras *eras)
{
	if (!eras)
		return;
	g_ptr_array_unref(eras->era);
	g_free(eras);
}

const struct sim_era *sim_eras_newest(const struct sim_eras *eras)
{
	return newest(eras);
}

guint64 sim_eras_first(const struct sim_eras *eras)
{
	return record_first(at(eras, 0)->record);
}

gsize sim_eras_bytes(const struct sim_eras *eras)
{
	return eras->ended + record_bytes(newest(eras)->record);
}

/* The scan at which a program was replaced belongs to the era before, which ran it. */
const struct sim_era *sim_eras_find(const struct sim_eras *eras, guint64 scan)
{
	for (guint i = 0; i < eras->era->len; i++) {
		const struct sim_era *era = at(eras, i);

		if (scan <= record_last(era->record))
			return scan >= record_first(era->record) ? era : NULL;
	}
	return NULL;
}

/* ---- dropping ---- */

static void drop_oldest(struct sim_eras *eras)
{
	eras->ended -= at(eras, 0)->size;
	g_ptr_array_remove_index(eras->era, 0);
}

/* Eras before a missing scan are dropped too. */
static void keep_bound(struct sim_eras *eras)
{
	const struct record *record = newest(eras)->record;

	while (eras->era->len > 1 && sim_eras_bytes(eras) > SIM_BYTES)
		drop_oldest(eras);
	while (eras->era->len > 1 && record_first(record) >
	       record_last(at(eras, eras->era->len - 2)->record))
		drop_oldest(eras);
}

void sim_eras_act(struct sim_eras *eras, const struct twin *twin, const struct act *act)
{
	record_act(newest(eras)->record, twin, act);
	keep_bound(eras);
}

void sim_eras_scan(struct sim_eras *eras, const struct twin *twin)
{
	record_scan(newest(eras)->record, twin);
	keep_bound(eras);
}

static gsize size_of(const struct sim_era *era)
{
	return sizeof(*era) + record_bytes(era->record) +
	       ladder_memory(era->program->ladder) + strlen(era->program->text);
}

static bool end_era(struct sim_eras *eras, const struct twin *twin,
		    struct sim_program *program, gint64 us)
{
	const guint last = eras->era->len - 1;
	struct sim_era *before = at(eras, last);

	if (!begin(eras, twin, program, before->plant))
		return false;
	if (record_first(before->record) == record_last(before->record)) {
		g_ptr_array_remove_index(eras->era, last);
		return true;
	}
	before->edited_us = us;
	before->size = size_of(before);
	eras->ended += before->size;
	keep_bound(eras);
	return true;
}

bool sim_eras_change(struct sim_eras *eras, const struct twin *twin,
		     struct sim_program *program)
{
	return end_era(eras, twin, program, g_get_real_time());
}

bool sim_eras_break(struct sim_eras *eras, const struct twin *twin)
{
	return end_era(eras, twin, newest(eras)->program, 0);
}
