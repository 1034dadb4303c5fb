/* SPDX-License-Identifier: MIT
 *
 * sim - sets the simulated levels of the driver sim. Levels are raw. hal_find() gives request and
 * line; the driver's read() gives the levels of inputs and outputs.
 */
#ifndef HAL_SIM_H
#define HAL_SIM_H

#include "hal/drivers.h"

/** sim_set - sets the level of an input. Scan-safe: yes. */
void sim_set(struct request *request, uint32_t line, bool level);
#endif
