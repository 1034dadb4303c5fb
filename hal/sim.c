/* SPDX-License-Identifier: MIT
 *
 * sim - a driver without pins. An input has the level of sim_set(); before the first call
 * it is 1 with pull-up, else 0. An output keeps the level that was written.
 */
#include "hal/sim.h"

struct sim_state {
	uint64_t level;
	bool used; /* levels stay over close and open, as on a wire */
};

static bool sim_open(struct request *request, struct trouble *why)
{
	struct sim_state *state = request->state;

	(void)why;
	if (request->output) {
		state->level = request->first;
		return true;
	}
	for (uint32_t i = 0; i < request->count && !state->used; i++)
		if (request->line[i].point->bias == BIAS_UP)
			state->level |= UINT64_C(1) << i;
	state->used = true;
	return true;
}

static void sim_close(struct request *request)
{
	(void)request;
}

static int sim_read(struct request *request, uint64_t *levels)
{
	const struct sim_state *state = request->state;

	*levels = state->level;
	return 0;
}

static int sim_write(struct request *request, uint64_t levels)
{
	struct sim_state *state = request->state;

	state->level = levels;
	return 0;
}

void sim_set(struct request *request, uint32_t line, bool level)
{
	struct sim_state *state = request->state;
	uint64_t mask = UINT64_C(1) << line;

	state->level = level ? state->level | mask : state->level & ~mask;
}

const struct driver driver_sim = {
	.word = "sim", .state_size = sizeof(struct sim_state),
	.open = sim_open, .close = sim_close,
	.read = sim_read, .write = sim_write,
};
