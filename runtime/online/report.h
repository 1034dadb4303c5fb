/* SPDX-License-Identifier: MIT
 *
 * report - what a gateway says of itself, and what the status of a board tells of its gateways.
 */
#ifndef ONLINE_REPORT_H
#define ONLINE_REPORT_H

#include "online/service.h"

#define REPORT_UNITS 64        /* of one gateway in the status; others are left out */

struct gateway_unit {
	char name[40];                 /* "rs485/1": bus and unit             */
	uint64_t requests;             /* since the gateway began             */
	uint64_t errors;               /* answers that were errors, or damaged */
	uint64_t timeouts;             /* requests without an answer          */
};

struct gateway_report {
	char text[80];                 /* "2 buses, 17 units"                 */
	uint16_t count;
	struct gateway_unit unit[REPORT_UNITS];
};

/* In the status of a board. */
struct gateway_status {
	char driver[16];               /* "modbus"                            */
	bool runs;                     /* one is connected                    */
	uint32_t points;               /* of the map, that it serves          */
	char user[32];                 /* … and runs as; ""                   */
	struct gateway_report report;
};
struct gateways_status {
	uint8_t count;
	struct gateway_status gateway[GATEWAY_COUNT + 1]; /* the last one is for reading only */
};

/* How good the values of the I/O map are, those of lines of a chip apart. */
#define VALUES_TOLD 64         /* that are not good; others are only counted  */
struct value_status {
	char address[24];              /* "%AIW0"                             */
	uint8_t flags;                 /* STALE and FAULT of enum value_flag   */
};
struct values_status {
	uint32_t good, stale, fault;
	uint16_t count;
	struct value_status bad[VALUES_TOLD];
};

/** report_put - its fields. Scan-safe: yes; so are all functions. */
void report_put(struct wire_writer *out, const struct gateway_report *report);
/** report_take - texts are cut and end with NUL. Fails: the reader has failed; also if it has more
 * units than REPORT_UNITS; then nothing of it was taken. */
void report_take(struct wire_reader *in, struct gateway_report *report);
/** gateways_put - behind status_put() (online/status.h). */
void gateways_put(struct wire_writer *out, const struct gateways_status *all);
/** gateways_take - behind status_take(). A board that tells nothing of gateways has none; of one that knows more
 * of them those are left out. */
void gateways_take(struct wire_reader *in, struct gateways_status *all);
/** values_put - behind gateways_put(). */
void values_put(struct wire_writer *out, const struct values_status *all);
/** values_take - behind gateways_take(). A board that tells nothing of values has none. */
void values_take(struct wire_reader *in, struct values_status *all);
/** value_quality - "good", "stale" or "fault". @flags: of enum value_flag */
const char *value_quality(uint8_t flags);
#endif
