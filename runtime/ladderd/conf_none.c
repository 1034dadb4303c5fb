/* SPDX-License-Identifier: MIT
 *
 * conf_none - a ladderd for small boards has no settings of desks and no program on trial.
 */
#include "ladderd/conf.h"
#include "ladderd/cycle.h"

void conf_load(struct conf *conf, struct options *options)
{
	(void)conf, (void)options;
}

void cycle_back(struct cycle *cycle, enum fault fault)
{
	(void)cycle, (void)fault;
}

void cycle_pass(struct cycle *cycle)
{
	(void)cycle;
}
