/* SPDX-License-Identifier: MIT
 *
 * carry_plan - a plan as carry_plan.c makes it and carry.c executes it; nobody else needs
 * to see inside.
 *
 * All places are offsets in the memory of the old or the new image, checked when the plan
 * is made. A bit that is packed in an area has the number 8 * offset + bit.
 */
#ifndef SCAN_CARRY_PLAN_H
#define SCAN_CARRY_PLAN_H

#include "engine/scan/carry.h"

enum move {
	MOVE_BYTES,        /* copies `count` bytes                            */
	MOVE_PACK,         /* bytes of 0 or 1 to bits                         */
	MOVE_UNPACK,       /* bits to bytes                                   */
	MOVE_BITS,         /* bits to bits                                    */
	MOVE_CHANGED,      /* values of `size` bytes; one that equals its old initial value
			    * becomes the new one                             */
	MOVE_TEXT,         /* a text, unless it is the old initial one or too long */
};
struct carry_move {
	uint8_t kind;      /* enum move                                       */
	uint8_t size;      /* of MOVE_CHANGED                                 */
	bool own;          /* reads the new memory, not the old one           */
	uint32_t from, to; /* offsets, or numbers of bits                     */
	uint32_t count;    /* of bytes, bits or values                        */
	uint32_t begun;    /* offset in the plan's `begun`. MOVE_CHANGED: old and new initial
			    * value for each; MOVE_TEXT: 1 + the old one, if it is not the
			    * new one; else 0                                 */
};

/* Values of one type, one after another in both memories, that a force may hold. */
struct carry_force {
	uint32_t from, to; /* offset; `to` a number of a bit of an area, if there is one */
	uint32_t count;
	uint8_t type, area; /* enum iec_type; enum iec_area in the new program */
};

/* A loss. An array has a range of elements. */
struct carry_lost {
	const char *pou, *name; /* in one of the programs                     */
	uint32_t head;          /* bytes of the name                          */
	enum carry_reason reason;
	int32_t low;
	uint32_t count;         /* 0: no array                                */
	struct location at;
	uint32_t from, stride;  /* CARRY_TEXT: the text in the old memory; to the next */
	uint16_t room;          /* CARRY_TEXT: the most bytes now             */
};

#define CARRY_NO_TASK LIMIT_TASKS

/* Bytes of the old program that a variable of the new one goes on with. */
struct carry_lead {
	uint32_t from, to, bytes;
};

/* A pointer that goes on: it leads to the same variable as before, or nowhere. */
struct carry_pointer {
	uint32_t from, to;
	uint64_t begun;         /* its initial value in the old program       */
};

struct carry_plan {
	const struct program *to, *from;
	bool same;              /* the same code: all memory and all forces go on */
	const struct carry_move *move;
	uint32_t move_count;
	const uint8_t *begun;
	const struct carry_force *force; /* by `from`, without overlaps       */
	uint32_t force_count;
	const struct carry_lead *lead;   /* by `from`; none if there is no pointer */
	uint32_t lead_count;
	const struct carry_pointer *pointer;
	uint32_t pointer_count;
	const struct carry_lost *lost;
	uint32_t lost_count;
	const uint32_t *pou;    /* of each entry of the old program: 1 + offset of its name
				 * in the strings of the new one; 0: none     */
	uint8_t task[LIMIT_TASKS];  /* of each old one: the new one of its name */
	uint8_t state[LIMIT_TASKS]; /* of each new one: the old one whose state it has */
	struct carry_cost cost;
};

/** carry_force_place - where a forced place of the old program is in the new one; type
 * IEC_NONE: nowhere. Scan-safe: yes. */
struct location carry_force_place(const struct carry_plan *plan, struct location at);
#endif
