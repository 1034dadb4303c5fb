/* SPDX-License-Identifier: MIT
 *
 * find - asks one unit after the other.
 */
#include "modbus/find.h"

#include "modbus/line.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#define OPENS_MOST 5  /* a connection that has gone is made anew so often, */
#define OPENS_MS   200 /* … with this time between                           */

struct search {
	struct line line;
	bool json;
	int found, doubts;
	uint8_t why[256 / 4];  /* enum doubt of each unit, two bits            */
};

enum doubt { NO_DOUBT, DAMAGED, STRANGE, SENSELESS };

static const char *const doubt_text[] = {
	[DAMAGED] = "the answer is damaged: two units with this number, another speed or parity, or a disturbed line",
	[STRANGE] = "what comes is no answer of this unit: another unit answers for it, or another master asks",
	[SENSELESS] = "what it says is no answer to the request",
};

/* What a unit said. */
struct answer {
	int unit;
	double ms;
	int exception;         /* 0: it has register 0                          */
};

static const char *exception_text(int exception)
{
	switch (exception) {
	case PDU_NO_FUNCTION: return "it cannot read holding registers";
	case PDU_NO_ADDRESS: return "it has no holding register 0";
	case PDU_BAD_VALUE: return "it does not take this request";
	case PDU_FAILURE: return "it has a failure";
	case PDU_BUSY: return "it is busy";
	default: return "it refuses";
	}
}

static void tell(struct search *search, const struct answer *answer)
{
	if (search->json)
		printf("%s{\"unit\":%d,\"ms\":%.1f,\"exception\":%d}", search->found ? "," : "", answer->unit, answer->ms,
		       answer->exception);
	else if (answer->exception)
		printf("unit %d answers in %.1f ms: exception %d: %s\n", answer->unit, answer->ms, answer->exception,
		       exception_text(answer->exception));
	else
		printf("unit %d answers in %.1f ms\n", answer->unit, answer->ms);
	fflush(stdout);
	search->found++;
}

static void doubt(struct search *search, int unit, enum doubt why)
{
	search->why[unit / 4] |= (uint8_t)((unsigned)why << unit % 4 * 2);
	search->doubts++;
	if (!search->json)
		printf("unit %d: %s\n", unit, doubt_text[why]);
	fflush(stdout);
}

/* Some devices end the connection when they are asked for a number that they do not have, and some take a new one only
 * after a while. False: it cannot be made anew. */
static bool open_again(struct line *line)
{
	const struct timespec nap = { 0, OPENS_MS * 1000000 };

	for (int i = 0; i < OPENS_MOST; i++) {
		if (line_open(line))
			return true;
		nanosleep(&nap, NULL);
	}
	return false;
}

/* A device that ends a new connection was asked. One that takes none, or had ended an old one, was not: it is asked when
 * it takes a new one. *@began_ns: when it was. */
static enum heard ask_for_sure(struct line *line, int unit, const struct pdu *request, struct pdu *got, int64_t *began_ns)
{
	struct unit_counts counts = { .requests = 0 };
	enum heard heard;
	bool used;

	do {
		if (!open_again(line))
			return HEARD_NO_LINE;
		used = line->used;
		*began_ns = line_now();
		heard = line_ask(line, (uint8_t)unit, request, got, &counts);
	} while (heard == HEARD_NO_LINE && used);
	return heard;
}

/* False: the line has gone. */
static bool ask(struct search *search, int unit)
{
	struct answer answer = { .unit = unit };
	struct pdu request, got;
	int64_t began_ns;

	pdu_read(&request, TABLE_HOLDING_REGISTER, 0, 1);
	switch (ask_for_sure(&search->line, unit, &request, &got, &began_ns)) {
	case HEARD_ANSWER:
		break;
	case HEARD_NOTHING:
		return true;
	case HEARD_CRC:
		doubt(search, unit, DAMAGED);
		return true;
	case HEARD_WRONG:
		doubt(search, unit, STRANGE);
		return true;
	case HEARD_NO_LINE:
		return open_again(&search->line);
	}
	answer.ms = (double)(line_now() - began_ns) / 1e6;
	if (pdu_check(&request, &got, &answer.exception) == PDU_WRONG)
		doubt(search, unit, SENSELESS);
	/* A device between us and the units says that one of them is not there. */
	else if (answer.exception != PDU_NO_PATH && answer.exception != PDU_NO_TARGET)
		tell(search, &answer);
	return true;
}

/* "ladder-modbus: 10.0.0.20:502", "ladder-modbus: /dev/ttyUSB0" */
static void begin_line(const struct io_bus *bus)
{
	fprintf(stderr, "ladder-modbus: %s", bus->kind == BUS_MODBUS_TCP ? bus->host : bus->port);
	if (bus->kind == BUS_MODBUS_TCP)
		fprintf(stderr, ":%u", bus->tcp_port);
}

static const char *hint_of(const struct io_bus *bus)
{
	return bus->kind == BUS_MODBUS_TCP ?
		"are address and port right, is the device on, and does it serve Modbus there?" :
		"is it the right serial line, may this user open it, and does no other program use it?";
}

/* What a list alone does not say. */
static void conclude(const struct search *search, const struct io_bus *bus, int asked, bool lost, int last)
{
	if (search->json) {
		printf("],\"doubts\":[");
		for (int unit = 0, told = 0; unit < 256; unit++) {
			const int why = search->why[unit / 4] >> unit % 4 * 2 & 3;

			if (why)
				printf("%s{\"at\":%d,\"why\":\"%s\"}", told++ ? "," : "", unit, doubt_text[why]);
		}
		printf("]}\n");
	}
	if (lost) {
		begin_line(bus);
		fprintf(stderr, ": gone at unit %d: %s: %s\n", last, search->line.why, hint_of(bus));
	} else if (!search->found && !search->doubts) {
		begin_line(bus);
		fprintf(stderr, bus->kind == BUS_MODBUS_TCP ?
			" takes the connection, but no unit answers: does it serve Modbus, and has it one of these numbers?\n" :
			": no unit answers: are speed, parity and the two wires right, and is the device on?\n");
	} else if (bus->kind == BUS_MODBUS_TCP && asked > 1 && search->found == asked) {
		begin_line(bus);
		fprintf(stderr, " answers for each number: it is one device, and takes any unit\n");
	}
}

int find_units(const struct io_bus *bus, int first, int last, bool json)
{
	struct search search;
	bool lost = false;
	int unit;

	memset(&search, 0, sizeof(search));
	search.json = json;
	if (!line_init(&search.line, bus) || !line_open(&search.line)) {
		begin_line(bus);
		fprintf(stderr, ": %s: %s\n", search.line.why, hint_of(bus));
		line_close(&search.line);
		return -1;
	}
	if (json)
		printf("{\"units\":[");
	for (unit = first; unit <= last && !lost; unit++)
		/* All units of a serial line take what is sent to 0, and none answers. */
		lost = (unit || bus->kind == BUS_MODBUS_TCP) && !ask(&search, unit);
	conclude(&search, bus, last - first + 1, lost, unit - 1);
	line_close(&search.line);
	return lost ? -1 : search.found;
}
