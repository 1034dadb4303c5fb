/* SPDX-License-Identifier: MIT
 *
 * plan - which requests read and write the points of one bus.
 *
 * Neighbours of one unit, table and period become one request. It is a pure function of the map; it knows
 * no line and no time.
 */
#ifndef MODBUS_PLAN_H
#define MODBUS_PLAN_H

#include "modbus/pdu.h"

struct plan_item {
	int point;             /* number in the map                            */
	const struct io_channel *channel;
	bool output;
	int bit;               /* 0 … 15 of its register; -1: none              */
	int words;             /* registers, or 1 coil                         */
};

/* A request that repeats. Its items follow each other in plan.item[]. */
struct plan_ask {
	uint8_t unit;
	enum io_table table;
	bool output;
	uint16_t first;
	int count;             /* coils or registers                           */
	int from, to;          /* items from … to - 1                          */
	int64_t period_ns;     /* of a read                                    */
	int by;                /* number of the io_ask that it waits for; -1: none */
};

struct plan_limits {
	int read_bits, read_words, write_bits, write_words; /* of one request    */
	int gap_bits, gap_words; /* that nobody wants and that a read takes along */
	bool together;           /* registers are read and written in one request */
};
extern const struct plan_limits plan_usual;
/** plan_limits_of - @usual, and what the map says of unit @unit of bus @bus. */
struct plan_limits plan_limits_of(const struct plan_limits *usual, const struct io_net *net, int bus,
				  uint8_t unit);

struct plan {
	struct plan_item *item;
	struct plan_ask *ask;  /* room for as many as items                    */
	int items, asks;
};

/** plan_make - all requests of bus @bus of @map
 * @limits: of the units of which the map says nothing
 * Owns: plan_free().   Fails: false: no memory. */
bool plan_make(struct plan *out, const struct iomap *map, int bus, const struct plan_limits *limits);
void plan_free(struct plan *plan);
/** plan_split - makes two requests of one that the device refuses; the second is the last of plan->ask.
 * Fails: false: it has one item, or all its items lie on the same register. */
bool plan_split(struct plan *plan, int ask);
/** plan_run - the next items of a request that are written together: the longest row of neighbours for which
 * @due is true, from @from on, or several bits of one register
 * Returns the end of the row; @from is moved to its begin. Both are ask->to if there is none. */
int plan_run(const struct plan *plan, const struct plan_ask *ask, int *from,
	     bool (*due)(void *context, int item), void *context, const struct plan_limits *limits);
#endif
