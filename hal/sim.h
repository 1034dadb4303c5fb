/* SPDX-License-Identifier: MIT
 *
 * sim - sets and reads the simulated levels of the driver sim. Levels are raw. hal_find()
 * gives request and line.
 */
#ifndef HAL_SIM_H
#define HAL_SIM_H

#include "hal/drivers.h"

/** sim_set - sets the level of an input. Scan-safe: yes. */
void sim_set(struct request *request, uint32_t line, bool level);
/** sim_get - the level of a line. Scan-safe: yes. */
bool sim_get(const struct request *request, uint32_t line);
/** sim_fail - makes reads, writes and opening fail with @error; 0: no longer. */
void sim_fail(struct request *request, int error);
#endif
