/* SPDX-License-Identifier: MIT
 *
 * bus - the master of one bus: asks and writes what the plan says, when it is due.
 *
 * bus_step() does at most one request and says when it wants to be called again; a thread per bus calls it,
 * a test calls it in virtual time. The wire is a struct of functions: runtime/modbus/line.h has that of
 * libmodbus. A unit that does not answer costs the others at most one time-out in each of their rounds.
 */
#ifndef MODBUS_BUS_H
#define MODBUS_BUS_H

#include "modbus/field.h"
#include "modbus/plan.h"
#include "modbus/unit.h"

#include <stdatomic.h>

enum heard {
	HEARD_ANSWER,   /* of the right unit, in a whole frame; pdu_check() is still to come */
	HEARD_NOTHING,  /* or half a frame                                           */
	HEARD_CRC,
	HEARD_WRONG,    /* only of other units or other requests; they are counted   */
	HEARD_NO_LINE,  /* there is no connection, or it has ended                    */
};

struct wire {
	enum heard (*ask)(void *context, uint8_t unit, const struct pdu *request, struct pdu *answer,
			  struct unit_counts *counts);
	int64_t (*now)(void *context);
	void *context;
	bool numbered;  /* an answer says which request it answers (TCP)        */
};

struct bus_ask {
	int64_t due_ns;        /* of a read                                    */
	int64_t refresh_ns;    /* of a write: when one of its items must be repeated */
	bool changed;          /* of a write: one of its items is due …         */
	int64_t since_ns;      /* … since then                                  */
	uint32_t served;       /* the number of the request for which it was done */
	int next;              /* of a write: the item that is looked at first */
	bool apart;            /* of a write: the device refused it together with a read */
};

/* What a block of the program asks for (struct io_ask). */
struct bus_request {
	uint32_t number;       /* of the request that waits; 0: none           */
	int status;            /* of what is done; 0: good                     */
};

/* What other threads may know of a unit: as it was after its last request. */
struct bus_told {
	struct unit_counts counts;
	bool silent;           /* or there is no line                          */
};

struct bus_sent {
	uint32_t serial;       /* of the value that was written last; 0: none   */
	int64_t at_ns;
};

struct bus {
	const struct iomap *map;
	int number;            /* of the bus in the map                         */
	struct plan plan;
	struct plan_limits limits[256]; /* by unit                               */
	struct bus_ask *ask;   /* beside plan.ask                               */
	struct bus_sent *sent; /* beside plan.item                              */
	struct bus_request *request; /* one for each io_ask of the map; of other buses unused */
	struct unit unit[256]; /* by number                                     */
	bool has[256];         /* the plan asks it                              */
	struct bus_told told[256]; /* by number; with field->lock                */
	struct field *field;
	struct wire wire;
	int since_probe;       /* requests to others since one to a silent unit  */
	bool wrote;            /* the last request was a write                   */
	bool broken;           /* there is no line                               */
	atomic_bool changed;   /* an output has a new value                      */
	int64_t line_ns;       /* when it is tried again                         */
	int64_t line_wait_ns;
};

/** bus_open - plans the requests of bus @number. Owns: bus_close(). Fails: false: no memory. */
bool bus_open(struct bus *bus, const struct iomap *map, int number, struct field *field,
	      struct wire wire);
void bus_close(struct bus *bus);
/** bus_changed - an output of this bus has a new value. From any thread. */
void bus_changed(struct bus *bus);
/** bus_ask_for - block @ask of the program makes request @number; 0: its request waits no longer. The answer is a
 * value of the point behind all points of the map. From any thread; field->lock is not held. */
void bus_ask_for(struct bus *bus, int ask, uint32_t number);
/** bus_tell - what unit @id has come to. From any thread; field->lock is not held. */
struct bus_told bus_tell(struct bus *bus, int id);
/** bus_step - at most one request. Returns when it wants to be called again; INT64_MAX: when an output
 * changes. */
int64_t bus_step(struct bus *bus);
#endif
