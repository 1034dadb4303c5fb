/* SPDX-License-Identifier: MIT
 *
 * nameless - the services of a small board: one session, no names, no thread.
 *
 * The owner of the stream moves the bytes. A request is served at once, between two scans, and
 * costs a bounded time: at most NAMELESS_ITEMS variables, a block of a download as long as a
 * piece of the line. What takes longer (hashing, verifying and storing a program) is done only
 * when the board does not run. All memory is in the struct, but for that of checking a program,
 * which is given back.
 */
#ifndef LADDERD_NAMELESS_H
#define LADDERD_NAMELESS_H

#include "ladderd/cycle.h"
#include "ladderd/download.h"
#include "online/publish.h"
#include "online/serial.h"

#define NAMELESS_ITEMS  128u          /* variables of one request                  */
#define NAMELESS_TEXTS  4u            /* STRINGs that one request writes           */
#define NAMELESS_KEPT   8             /* answers to changes, for repeated requests */
#define NAMELESS_ANSWER 80u           /* bytes of such an answer                   */
#define NAMELESS_IN     4096u         /* bytes of a request, but for those of a block */
#define NAMELESS_OUT    10240u        /* of an answer: 256 forces                  */
#define NAMELESS_MOST   (256u * 1024) /* of a download: image, map and sources     */

/* An answer to a request that changed something. */
struct nameless_kept {
	uint64_t number;               /* of the request in its session; 0: none */
	uint16_t request, len;
	uint8_t service;
	uint8_t bytes[NAMELESS_ANSWER];
};

/* A program that comes. */
struct nameless_download {
	uint8_t *pool;                 /* SLOT_HEAD + NAMELESS_MOST + 4 bytes; NULL: no --slots */
	struct stored wanted;
	uint8_t sha[32];
	uint32_t received;
	bool begun, verified;
};

struct nameless {
	struct cycle *cycle;
	struct slots *slots;
	enum role role;
	int64_t began_ns;              /* CLOCK_MONOTONIC, when ladderd began  */
	bool greeted, over;            /* over: the stream makes no sense      */
	uint64_t requests;
	uint32_t left;                 /* bytes of a frame that are not kept in `in` */
	uint32_t at;                   /* where in the download they go        */
	enum refusal refusal;          /* of that frame                        */
	uint16_t request;              /* … and its number and service         */
	uint8_t service;
	struct nameless_download download;
	struct publications publications;
	struct board_status status;
	struct location place[NAMELESS_ITEMS];
	union iec_value value[NAMELESS_ITEMS];
	struct iec_text text[NAMELESS_TEXTS];
	struct nameless_kept kept[NAMELESS_KEPT];
	size_t in_len, out_len, out_sent;
	uint8_t in[NAMELESS_IN], out[NAMELESS_OUT];
};

/** nameless_begin - a new session; what was published ends. What has come of a download stays,
 * so that a desk can go on with it. Scan-safe: yes. */
void nameless_begin(struct nameless *nameless);
/** nameless_take - bytes of the desk. Scan-safe: yes. Fails: false: no room; nothing was taken. */
bool nameless_take(struct nameless *nameless, const uint8_t *bytes, size_t len);
/** nameless_step - serves one request, or writes a message that is due. Scan-safe: between
 * scans. Returns whether there may be more to do at once. */
bool nameless_step(struct nameless *nameless, int64_t now_ns);
/** nameless_pending - bytes for the desk; 0: none. nameless_sent - so many have gone. */
const uint8_t *nameless_pending(const struct nameless *nameless, size_t *len);
void nameless_sent(struct nameless *nameless, size_t len);
#endif
