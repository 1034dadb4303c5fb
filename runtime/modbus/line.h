/* SPDX-License-Identifier: MIT
 *
 * line - the wire of a bus over libmodbus: a serial line (RTU) or a connection (TCP).
 *
 * It sends a request and waits for the frame that answers it. Frames of other units and of requests
 * before are counted and dropped. It knows no point, no plan and no back-off.
 */
#ifndef MODBUS_LINE_H
#define MODBUS_LINE_H

#include "modbus/bus.h"

struct line {
	const struct io_bus *at; /* borrowed                                  */
	void *modbus;          /* modbus_t of libmodbus                        */
	bool open;
	bool used;             /* an answer came through this connection        */
	int silent;            /* requests in a row without an answer           */
	uint16_t number;       /* of the last request (TCP)                      */
	int64_t quiet_ns;      /* between two frames                             */
	int64_t free_ns;       /* the line is quiet from then on                 */
	char why[80];          /* why it could not be opened                     */
};

/** line_init - opens nothing. @at: outlives the line. Fails: false: libmodbus refuses what it says. */
bool line_init(struct line *line, const struct io_bus *at);
void line_close(struct line *line);
/** line_open - the device or the connection; line_ask() does it, too. Fails: line->why says why. */
bool line_open(struct line *line);
/** line_ask - see struct wire. */
enum heard line_ask(struct line *line, uint8_t unit, const struct pdu *request, struct pdu *answer,
		    struct unit_counts *counts);
/** line_say - sends a frame on a serial line, without a wait for an answer. */
bool line_say(struct line *line, uint8_t unit, const struct pdu *pdu);
/** line_fd - of an open line, for poll(). */
int line_fd(const struct line *line);
/** line_wire - for bus_open(). */
struct wire line_wire(struct line *line);
/** line_baud_is_known - whether this machine knows this rate. */
bool line_baud_is_known(uint32_t baud);
/** line_now - monotonic. */
int64_t line_now(void);
#endif
