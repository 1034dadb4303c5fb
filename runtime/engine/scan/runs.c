/* SPDX-License-Identifier: MIT
 *
 * runs - finds the run that holds a place of the data memory. Pointers do in a scan.
 */
#include "engine/scan/verify.h"

uint32_t verify_runs_before(const struct program *p, uint32_t offset)
{
	uint32_t low = 0, high = p->run_count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;

		if (p->run[middle].offset > offset)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

const struct code_run *code_run_at(const struct program *p, uint32_t offset)
{
	uint32_t before = verify_runs_before(p, offset);
	const struct code_run *run;

	if (before == 0)
		return NULL;
	run = &p->run[before - 1];
	return (offset - run->offset) / code_run_size(run) < run->count ? run
								     : NULL;
}
