/* SPDX-License-Identifier: MIT
 *
 * unit - what is known of one unit on a bus: whether it answers, when it is asked again, whether its
 * answers can be trusted, and counters.
 *
 * A unit that does not answer is asked again after 100 ms, then 200, 400 … 10 s. On a serial line an
 * answer does not say what it answers, and one that is late could be taken for the answer to another
 * request. So a request without an answer is remembered for some time-outs. Meanwhile the unit is asked
 * nothing that has answers of the same form, but the same request again. An answer that may belong to another
 * request all the same, such as a refusal, is a sign of life only.
 */
#ifndef MODBUS_UNIT_H
#define MODBUS_UNIT_H

#include "modbus/pdu.h"

#define UNIT_AGAIN_NS 100000000   /* to the first repetition             */
#define UNIT_MOST_NS  10000000000 /* … and to the last                   */
#define UNIT_ALONE_NS 1000000000  /* the same, while the bus has no unit that answers */
#define UNIT_LATE_NS  500000000   /* no answer is later than this, or …      */
#define UNIT_LATE     3           /* … than so many time-outs                */
#define UNIT_OWED     6           /* requests that are remembered        */
#define UNIT_FAILS    2           /* failures in a row make its values bad */

struct unit_counts {
	uint32_t requests;
	uint32_t answers;      /* good ones                                    */
	uint32_t timeouts;     /* nothing came, or half an answer              */
	uint32_t crc;          /* answers with a wrong check                   */
	uint32_t wrong;        /* of another unit, another request, another length */
	uint32_t late;         /* not trusted: they may belong to a request before */
	uint32_t exceptions[PDU_EXCEPTIONS]; /* by number; [0]: others        */
};

/* A request whose answer may still come. */
struct unit_owed {
	int64_t sent_ns;
	uint8_t head[7];       /* what an answer repeats or depends on         */
	uint16_t crc;          /* of all its bytes                              */
};

struct unit {
	uint8_t id;
	int fails;             /* in a row                                     */
	int64_t again_ns;      /* it is not asked before                       */
	int64_t wait_ns;       /* the last back-off                            */
	struct unit_owed owed[UNIT_OWED];
	int64_t unsure_ns;     /* too many to remember: nothing is trusted before  */
	int64_t late_ns;       /* no answer is later; 0: each says what it answers */
	bool no_mask, no_single, no_many, no_both; /* functions that it has refused     */
	struct unit_counts counts;
};

/** unit_is_away - it is asked only now and then. */
bool unit_is_away(const struct unit *unit);
/** unit_is_bad - its values do not count. */
bool unit_is_bad(const struct unit *unit);
/** unit_silent - no answer that fits came to a request; @owed: one may still come, to that request. NULL:
 * it cannot. */
void unit_silent(struct unit *unit, const struct pdu *owed, int64_t sent_ns, int64_t now_ns);
enum unit_trust {
	TRUST_ALL,
	TRUST_IT,       /* but a second answer to the same request may still come   */
	TRUST_NOTHING,  /* it may belong to another request before: do not use it    */
};
/** unit_answered - an answer came. */
enum unit_trust unit_answered(struct unit *unit, const struct pdu *request, const struct pdu *answer,
			      int64_t sent_ns, int64_t now_ns);
/** unit_is_twin - whether a read is another one than @request, with answers of the same form. */
bool unit_is_twin(const struct pdu *request, enum io_table table, uint16_t first, int count);
/** unit_clear_ns - from when on no answer to another read can be taken for one to this. */
int64_t unit_clear_ns(const struct unit *unit, enum io_table table, uint16_t first, int count);
/** unit_due_ns - when it may be asked; @alone: no other unit of the bus answers. */
int64_t unit_due_ns(const struct unit *unit, bool alone);
#endif
