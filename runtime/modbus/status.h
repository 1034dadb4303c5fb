/* SPDX-License-Identifier: MIT
 *
 * status - the counters of all units: for ladderd, which shows them to desks, and as text.
 */
#ifndef MODBUS_STATUS_H
#define MODBUS_STATUS_H

#include "modbus/master.h"
#include "modbus/serve.h"
#include "online/report.h"

#include <stdio.h>

/** status_report - what `ladder board WHERE status` shows; units that do not answer come first. */
void status_report(const struct masters *masters, const struct serve *serve, struct gateway_report *out);
/** status_print - a line for each unit, with each exception by its number. */
void status_print(const struct masters *masters, const struct serve *serve, FILE *out);
#endif
