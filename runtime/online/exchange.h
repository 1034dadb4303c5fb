/* SPDX-License-Identifier: MIT
 *
 * exchange - what the link thread and the scan thread give each other.
 *
 * The link gives orders, one at a time; the scan thread does them between two scans and
 * allocates nothing, locks nothing and waits for nothing. After each scan it copies the
 * bytes that somebody watches into one of three buffers; one atomic exchange hands it over,
 * so neither thread ever waits for the other's copy.
 *
 * It starts no thread and knows no stream. What an order means outside of the resource
 * (lines, the clock, the store) is done by functions of the daemon.
 */
#ifndef ONLINE_EXCHANGE_H
#define ONLINE_EXCHANGE_H

#include "engine/scan/place.h"
#include "engine/scan/recorder.h"
#include "engine/scan/retain.h"
#include "engine/scan/resource.h"
#include "online/service.h"
#include "online/status.h"

#include <stdatomic.h>

#define EXCHANGE_ORDERS 64   /* done between two scans, at most                 */

/* Bytes of memory that somebody watches; ascending, no overlap. */
struct range {
	uint32_t at, size;
};

struct watch {
	uint32_t serial;      /* of the ranges; a view has that of its own     */
	bool power;           /* run the section that stores the power of cells */
	uint32_t count;
	const struct range *range;
};

/* A copy of watched bytes, at the offsets that they have in the image. */
struct view {
	uint64_t scan;
	int64_t now_ns;
	enum resource_state state;
	bool io_bad;          /* something of the I/O map does not answer      */
	int forces;           /* how many there are                            */
	uint32_t serial;
	uint8_t *memory;
#ifndef RUNGBOARD_SMALL
	/* STALE and FAULT of enum value_flag; NULL: all are STALE, if io_bad says so. In a copy of the link. */
	uint8_t (*quality)(const struct view *view, const struct program *program, struct location at);
	void *context;
#endif
};
#ifdef RUNGBOARD_SMALL
#define VIEW_QUALITY(view, program, at) ((view)->io_bad ? VALUE_STALE : 0)
#else
#define VIEW_QUALITY(view, program, at)                                                             \
	((view)->quality ? (view)->quality(view, program, at) : (view)->io_bad ? VALUE_STALE : 0)
#endif

enum order_kind {
	/* These have places of a program. */
	ORDER_LOOK,    /* copies ranges to a view of the link                 */
	ORDER_WATCH,   /* the ranges to be copied after each scan             */
	ORDER_WRITE,
	ORDER_FORCE,
	ORDER_UNFORCE, /* count 0: all                                        */
	ORDER_FORCES,  /* copies the list of forces                           */
	ORDER_RETAIN,  /* copies the retained values                          */
	ORDER_RESTORE, /* retained values for the next warm start, in STOP    */
	/* These have none. */
	ORDER_MODE,
	ORDER_STATUS,
	ORDER_SWAP,    /* another program runs from now on                    */
	ORDER_RESTART, /* the daemon ends and begins with the newest slot      */
	ORDER_ACT,     /* the daemon does something between two scans         */
	ORDER_RECORD,  /* copies a part of the record                         */
	ORDER_COUNT
};

struct order_item {
	struct location at;
	union iec_value value;
};

/* Retained values. */
struct order_retain {
	const struct retain *plan;     /* of the program that runs            */
	uint8_t *copy;                 /* of retain_copy()                    */
	int64_t clock_ns;
};

struct order {
	enum order_kind kind;
	bool expects;                  /* `expect` must hold, or nothing is done */
	struct expect expect;
	const struct program *program; /* whose places these are; NULL: it has none */
	const struct watch *watch;     /* ORDER_LOOK, ORDER_WATCH               */
	struct view *view;             /* ORDER_LOOK                            */
	const struct order_item *item; /* of writes and forces                  */
	uint32_t count;
	enum mode_wish mode;
	struct board_status *status;   /* ORDER_STATUS                          */
	struct image *forces;          /* ORDER_FORCES: gets only the forces    */
	void *other;                   /* ORDER_SWAP, ORDER_ACT: the host's     */
	void (*act)(void *context, void *other); /* @context: of the host        */
	struct recorder_part *part;    /* ORDER_RECORD                          */
	uint32_t back;                 /* ORDER_SWAP: a FAULT within so many scans brings
					* the program before back; 0: never     */
	struct order_retain retain;    /* ORDER_RETAIN, ORDER_RESTORE           */
	/* The result. */
	enum refusal refusal;
	uint32_t wrong;                /* the item that was refused             */
	uint64_t scan;                 /* the last scan before it               */
	enum resource_state state;     /* before it                             */
};

/* What the daemon does for an order. @context: its own. */
struct exchange_host {
	void *context;
	struct resource *(*resource)(void *context);
	/** Identity of the program that runs, 32 bytes. */
	const uint8_t *(*identity)(void *context);
	/** RUN, STOP, reset. Returns REFUSAL_NONE when it was done. */
	enum refusal (*mode)(void *context, enum mode_wish wish);
	/** Exchanges the program. Watches end. */
	enum refusal (*swap)(void *context, void *other, uint32_t back);
	/** @stopped: begins in STOP. */
	void (*restart)(void *context, bool stopped);
	/** Takes values for the next warm start. Fails: REFUSAL_NO_RETAIN. */
	enum refusal (*restore)(void *context, const struct order_retain *values);
	/** Fills in what only the scan thread knows. */
	void (*status)(void *context, struct board_status *status);
};

struct exchange {
	const struct exchange_host *host;
	struct recorder *recorder;     /* of changes; set after exchange_init(); NULL: none */
	_Atomic(struct order *) order; /* NULL: none is waiting                 */
	_Atomic int state;             /* enum resource_state, now; -1: not known yet */
	_Atomic unsigned middle;       /* the buffer between both sides, and FRESH */
	struct view view[3];
	/* Used by the scan thread. */
	struct watch watch;
	unsigned back;
	uint32_t done;                 /* orders since the last scan            */
	/* Used by the link thread. */
	unsigned front;
};

/**
 * exchange_init - nothing is watched
 * @memory: 3 * @size bytes, zeroed, borrowed; @size: image_memory_size() of the program
 *
 * Both threads may use it afterwards. Scan-safe: no.
 */
void exchange_init(struct exchange *exchange, const struct exchange_host *host,
		   uint8_t *memory, size_t size);

/** exchange_renew - the same for another program, after an ORDER_SWAP was done: until then
 * nothing is watched. Link thread. */
void exchange_renew(struct exchange *exchange, uint8_t *memory, size_t size);

/* ---- the scan thread ---- */

/** exchange_serve - does the order that waits, if any. Between two scans. Scan-safe: yes. */
void exchange_serve(struct exchange *exchange);
/** exchange_forget - nothing is watched any more: another program runs. Scan-safe: yes. */
void exchange_forget(struct exchange *exchange);
/** exchange_show - copies what is watched after a scan. Scan-safe: yes: bounded by the
 * watched bytes; without a watch it does nothing. */
void exchange_show(struct exchange *exchange, int64_t now_ns);

/* ---- the link thread ---- */

/** exchange_post - gives an order; it must stay until exchange_is_done(). Scan-safe: no. */
void exchange_post(struct exchange *exchange, struct order *order);
/** exchange_is_done - whether the order was done; then its result is there. */
bool exchange_is_done(const struct exchange *exchange);
/** exchange_newest - the newest view, the same one again if there is none newer. It is
 * the caller's until the next call. */
const struct view *exchange_newest(struct exchange *exchange);
#endif
