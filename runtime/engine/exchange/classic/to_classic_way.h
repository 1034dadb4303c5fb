/* SPDX-License-Identifier: MIT
 *
 * to_classic_way - contacts in series, and rungs drawn from several side by side. Private to
 * to_classic_split.c and to_classic_way.c.
 */
#ifndef CLASSIC_TO_CLASSIC_WAY_H
#define CLASSIC_TO_CLASSIC_WAY_H

#include "engine/exchange/classic/to_classic_parts.h"

enum { CHAIN = 16 };

/* Items are large: their functions share no frame. */
#define APART __attribute__((noinline))

/* Contacts in series, from the rail on. */
struct way { struct out_part item[CHAIN]; int count, width; bool never; };

/** contact, coil - one of them. Scan-safe: yes. */
static inline struct out_part contact(int code, struct classic_variable variable)
{
	return (struct out_part){ .code = code, .width = 1, .height = 1,
				  .variable = variable };
}

static inline struct out_part coil(int code, int bit)
{
	return contact(code, variable_of(CL_BIT, bit));
}

/** way_add - one more in series; beyond CHAIN it is left out. */
void way_add(struct way *way, struct out_part item);
void way_contact(struct way *way, int code, struct classic_variable variable);
/** draw_way - in row @y, with wires up to column @to; gives the column behind. */
int draw_way(struct leaving *e, struct classic_rung *rung, int y, const struct way *way,
	     int to);
/** draw_ways - side by side, then an output. */
void draw_ways(struct leaving *e, const struct way *way, int ways,
	       const struct out_part *output);
#endif
