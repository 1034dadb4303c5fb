/* SPDX-License-Identifier: MIT
 *
 * engine_sfc - sequential pages of ClassicLadder.
 *
 * Transitions fire in the order of the file, at once, in rounds until none fires, at most 50.
 * ClassicLadder advances the times of all steps once for each page (F5).
 */
#include "tests/classic/engine.h"

enum { ROUNDS = 50 };

static int position(const struct classic_project *project, int index)
{
	for (int i = 0; i < project->steps; i++)
		if (project->step[i].index == index)
			return i;
	return -1;
}

static bool all_active(const struct engine *engine, const struct classic_transition *by)
{
	for (int i = 0; i < by->deactivates; i++) {
		int at = position(engine->project, by->deactivate[i]);

		if (at >= 0 && !engine->active[at])
			return false;
	}
	return true;
}

static void put(struct engine *engine, int index, bool active)
{
	int at = position(engine->project, index);

	if (at < 0 || engine->active[at] == active)
		return;
	engine->active[at] = active;
	engine->active_ms[at] = 0;
}

static bool fire(struct engine *engine, const struct classic_transition *by)
{
	if (by->condition.type < 0 ||
	    !engine_get(engine, by->condition.type, engine_at(engine, &by->condition)) ||
	    !all_active(engine, by))
		return false;
	for (int i = 0; i < by->deactivates; i++)
		put(engine, by->deactivate[i], false);
	for (int i = 0; i < by->activates; i++)
		put(engine, by->activate[i], true);
	return true;
}

static void publish(struct engine *engine, int page)
{
	const struct classic_project *project = engine->project;

	for (int i = 0; i < project->steps; i++) {
		const struct classic_step *step = &project->step[i];

		if (engine->active[i] && (engine->faithful || step->page == page))
			engine->active_ms[i] += engine->period;
		engine->step_a[step->number] = engine->active[i];
		engine->step_v[step->number] = (int32_t)(engine->active_ms[i] / 1000);
	}
}

void engine_sfc(struct engine *engine, int page)
{
	const struct classic_project *project = engine->project;

	bool fired = true;

	for (int round = 0; fired && round < ROUNDS; round++) {
		fired = false;
		for (int i = 0; i < project->transitions; i++)
			if (project->transition[i].page == page)
				fired |= fire(engine, &project->transition[i]);
	}
	publish(engine, page);
}
