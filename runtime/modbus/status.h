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

/* Units for which others answer, from one look to the next. */
struct status_strays {
	struct status_stray {
		uint32_t wrong;  /* frames so far                                */
		bool is;
	} *unit;                 /* 256 for each bus                             */
	char first[24];          /* "rs485/3"; "": none                          */
};

/** status_strays_open - Owns: status_strays_close(). Fails: false: no memory. */
bool status_strays_open(struct status_strays *strays, int buses);
void status_strays_close(struct status_strays *strays);
/** status_strays - an error for each unit that is silent while frames of others come for it: once, until it
 * answers. */
void status_strays(struct status_strays *strays, const struct masters *masters, const struct iomap *map,
		   struct diag_list *diags);
/** status_report - what `ladder board WHERE status` shows; units that do not answer come first. */
void status_report(const struct masters *masters, const struct serve *serve, const struct status_strays *strays,
		   struct gateway_report *out);
/** status_print - a line for each unit, with each exception by its number. */
void status_print(const struct masters *masters, const struct serve *serve, FILE *out);
#endif
