/* SPDX-License-Identifier: MIT
 *
 * sim - the pins of a board that is not there, for whoever plays the wires.
 *
 * Levels are raw, as on a wire. Find request and line with hal_find().
 */
#ifndef HAL_SIM_H
#define HAL_SIM_H

#include "hal/drivers.h"

/** sim_set - the level that an input shows from now on. Scan-safe: yes. */
void sim_set(struct request *request, uint32_t line, bool level);
/** sim_get - the level of any line. Scan-safe: yes. */
bool sim_get(const struct request *request, uint32_t line);
/** sim_fail - makes reads, writes and opening fail with @error until 0. */
void sim_fail(struct request *request, int error);
#endif
