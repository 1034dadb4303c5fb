/* SPDX-License-Identifier: MIT
 *
 * scenario_acts - what a scenario does, as acts of a twin. It judges nothing.
 */
#include "engine/trial/scenario.h"
#include "engine/trial/value.h"

/* A setting that cannot be done is left out, as in a run. */
static void act(const struct scenario_step *step, struct twin *twin,
		void (*take)(void *context, uint64_t after, const struct act *act),
		void *context)
{
	const struct image *image = &twin->resource.image;
	const struct image *target = step->plant ? &twin->plant.image : image;
	struct act act = { .kind = ACT_SET, .plant = step->plant, .at = step->target };

	if (!formula_value(step->formula, image, &act.value) ||
	    !formula_fit(step->formula, act.value, step->target.type, &act.value) ||
	    !value_has_room(target, step->target, act.value))
		return;
	take(context, twin->scan, &act);
	twin_act(twin, &act);
}

bool scenario_each_act(const struct scenario_file *file, int index, struct twin *twin,
		       uint64_t scans,
		       void (*take)(void *context, uint64_t after, const struct act *act),
		       void *context)
{
	const struct scenario *scenario = &file->scenario[index];
	const struct act period = { .kind = ACT_PERIOD, .value.i = scenario->period_ns };
	const struct act start = { .kind = ACT_START };
	int next = 0;

	if (!twin_act(twin, &period) || !twin_act(twin, &start))
		return false;
	while (twin->scan < scans) {
		const uint64_t before = twin->scan;

		for (; next < scenario->step_count; next++) {
			const struct scenario_step *step = &scenario->step[next];
			const bool always = step->verb == VERB_ALWAYS ||
					    step->verb == VERB_NEVER;

			if (!always && step->at_ns > twin->now_ns + twin->period_ns)
				break;
			if (step->verb == VERB_SET)
				act(step, twin, take, context);
		}
		twin_scan(twin);
		if (twin->scan == before || (file->stop && *file->stop))
			return false;
	}
	return true;
}
