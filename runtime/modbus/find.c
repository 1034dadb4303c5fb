/* SPDX-License-Identifier: MIT
 *
 * find - asks one unit after the other.
 */
#include "modbus/find.h"

#include "modbus/line.h"

#include <stdio.h>

struct found {
	int unit;
	double ms;
	int exception;         /* 0: it has register 0                          */
};

/* False: it does not answer. */
static bool ask(struct line *line, int unit, struct found *found)
{
	struct unit_counts counts = { .requests = 0 };
	struct pdu request, answer;
	const int64_t began_ns = line_now();

	pdu_read(&request, TABLE_HOLDING_REGISTER, 0, 1);
	if (line_ask(line, (uint8_t)unit, &request, &answer, &counts) != HEARD_ANSWER)
		return false;
	*found = (struct found){ .unit = unit, .ms = (double)(line_now() - began_ns) / 1e6 };
	return pdu_check(&request, &answer, &found->exception) != PDU_WRONG;
}

static void tell(const struct found *found, bool json, bool first)
{
	if (json)
		printf("%s{\"unit\":%d,\"ms\":%.1f,\"exception\":%d}", first ? "" : ",", found->unit, found->ms,
		       found->exception);
	else if (found->exception)
		printf("unit %d answers in %.1f ms: exception %d\n", found->unit, found->ms, found->exception);
	else
		printf("unit %d answers in %.1f ms\n", found->unit, found->ms);
	fflush(stdout);
}

int find_units(const struct io_bus *bus, int first, int last, bool json)
{
	struct line line;
	struct found found;
	int count = 0;

	if (!line_init(&line, bus) || !line_open(&line)) {
		fprintf(stderr, "ladder-modbus: %s: %s\n", bus->port ? bus->port : bus->host, line.why);
		line_close(&line);
		return -1;
	}
	if (json)
		printf("{\"units\":[");
	for (int unit = first; unit <= last; unit++) {
		/* A device between us and the units says that one of them is not there. */
		if (ask(&line, unit, &found) && found.exception != PDU_NO_PATH &&
		    found.exception != PDU_NO_TARGET) {
			tell(&found, json, count == 0);
			count++;
		}
	}
	if (json)
		printf("]}\n");
	line_close(&line);
	return count;
}
