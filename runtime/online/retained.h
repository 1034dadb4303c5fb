/* SPDX-License-Identifier: MIT
 *
 * retained - retained values on their way between desk and board: a payload of
 * scan/retain.h, sent in parts.
 *
 * One session at a time. Memory is allocated when a desk asks and kept until the next one: an
 * order that is late may still use it. It gives no orders; the server does.
 */
#ifndef ONLINE_RETAINED_H
#define ONLINE_RETAINED_H

#include "engine/scan/retain.h"
#include "online/wire.h"

struct retained {
	int owner;             /* the session; -1: none                       */
	struct arena arena;    /* of the plan and the copy                    */
	struct retain plan;
	uint8_t *copy;         /* NULL: there is no plan                      */
	bool *told;            /* variables that had a value of another type  */
	int64_t clock_ns;      /* of the scan, at the copy                    */
	uint8_t *bytes;        /* the payload that a desk sends               */
	uint32_t size, received;
};

/** retained_init, retained_free - Scan-safe: no; so are all functions. */
void retained_init(struct retained *retained);
void retained_free(struct retained *retained);
/** retained_plan - finds the retained variables of a program. Fails: false: no memory. */
bool retained_plan(struct retained *retained, const struct program *program);
/** retained_fill - the copy becomes a payload. */
void retained_fill(struct retained *retained);
/** retained_payload - of retained_fill(). */
const uint8_t *retained_payload(const struct retained *retained, uint32_t *size);
/**
 * retained_take_part - a part of the payload that a desk sends
 * @size: of all of it; @offset: 0 begins anew
 *
 * Fails: REFUSAL_NOT_WHOLE-like false: a gap, or too many bytes; or no memory: `bytes` is NULL.
 */
bool retained_take_part(struct retained *retained, uint32_t size, uint32_t offset,
			const uint8_t *bytes, size_t len);
/**
 * retained_merge - puts the values that were sent into the copy, where name and type are the same
 * @told: for each that cannot be; and, with RETAIN_KEPT, for each variable that none was sent for
 *
 * Returns how many were put. Fails: -1: the payload is not whole or not well-formed.
 */
int retained_merge(struct retained *retained,
		   void (*told)(void *context, const struct retain_record *record,
				enum retain_fate fate),
		   void *context);
#endif
