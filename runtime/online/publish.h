/* SPDX-License-Identifier: MIT
 *
 * publish - what one session has asked to be sent as it changes: values of variables, and the
 * power of the cells of a POU.
 *
 * It compares views of the scan with what was sent last and writes messages. All memory is in
 * the struct. It sends nothing and knows no stream.
 */
#ifndef ONLINE_PUBLISH_H
#define ONLINE_PUBLISH_H

#include "online/exchange.h"

#ifdef RUNGBOARD_SMALL
#define PUBLISH_SETS   4     /* of one session                                */
#define PUBLISH_VALUES 128   /* of all sets of one session                    */
#define PUBLISH_POWER  1     /* bytes of the power of all sets of one session */
#else
#define PUBLISH_SETS   16
#define PUBLISH_VALUES 2048
#define PUBLISH_POWER  32768
#endif
#define PUBLISH_LEAST_US 10000 /* shortest period                             */
#define PUBLISH_MOST_US  3600000000u

enum publish_what { PUBLISH_VARIABLES, PUBLISH_CELLS };

struct published {
	struct location at;
	uint64_t sent;         /* the value that was sent last; of a STRING its hash */
	uint8_t flags;
	bool any;              /* one was sent                                */
};

struct publish_set {
	bool used;
	enum publish_what what;
	uint16_t request;      /* of the desk, stands in each message         */
	uint32_t serial;       /* views from this one on have its bytes       */
	int64_t period_ns, due_ns;
	uint32_t lost;         /* periods without a message because the desk is slow */
	uint32_t first, count; /* in `value`, or cells of `power`             */
	/* PUBLISH_CELLS */
	uint32_t cell;         /* of the program's map of cells               */
	uint32_t from, size, to; /* of an instance: its cells between from and from + size
				  * are copied to to …; size 0: of a program  */
	bool any;
};

struct publications {
	struct publish_set set[PUBLISH_SETS];
	struct published value[PUBLISH_VALUES];
	uint8_t power[PUBLISH_POWER];
	uint32_t values, power_bytes;
};

void publish_init(struct publications *all);
/** publish_new - a set for a request that does not exist yet. @period_us: brought into its
 * bounds. Fails: NULL: PUBLISH_SETS are used, or one has this number. */
struct publish_set *publish_new(struct publications *all, uint16_t request, uint32_t period_us);
/** publish_add - one more variable of the newest set. Fails: false: too many. */
bool publish_add(struct publications *all, struct publish_set *set, struct location at);
/** publish_cells - all cells of a POU, or of the body of an instance
 * @name: "Main", "Line.Belt1"
 *
 * Fails: REFUSAL_NO_NAME, REFUSAL_TOO_MANY; the set is to be dropped. */
enum refusal publish_cells(struct publications *all, struct publish_set *set,
			   const struct program *program, const char *name, size_t len);
/** publish_drop - false: no set has this number. */
bool publish_drop(struct publications *all, uint16_t request);
/** publish_ranges - calls @take for the bytes that the sets need. */
void publish_ranges(const struct publications *all, const struct program *program,
		    void (*take)(void *context, struct range range), void *context);
/** publish_has_cells - whether a set needs the power of cells. */
bool publish_has_cells(const struct publications *all);
/** publish_due - when the next message is due; INT64_MAX: never. */
int64_t publish_due(const struct publications *all);
/** publish_lose - counts periods that have passed at @now_ns without room for a message. */
void publish_lose(struct publications *all, int64_t now_ns);

/**
 * publish_write - the message of one set that is due
 * @image: the view as an image of the program, with the forces of the board
 *
 * Returns the bytes of its frame; 0: nothing is due, or nothing changed.
 */
size_t publish_write(struct publications *all, const struct view *view,
		     const struct image *image, int64_t now_ns, struct wire_writer *out);
#endif
