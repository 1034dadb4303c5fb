/* SPDX-License-Identifier: MIT
 *
 * asks - carries requests of MB_READ and MB_WRITE from the program to a gateway, and answers back.
 *
 * The scan thread looks at the blocks after each scan. The link thread takes requests and leaves answers,
 * without a lock.
 */
#ifndef LADDERD_ASKS_H
#define LADDERD_ASKS_H

#include "engine/scan/image.h"
#include "hal/channel.h"

#include <stdatomic.h>

#define ASK_NOWHERE UINT32_MAX

struct ask {
	uint32_t at;                    /* its block, in the memory of the image; ASK_NOWHERE */
	_Atomic uint32_t asked;         /* number of the request that waits; 0: none          */
	_Atomic uint32_t answer;        /* as in struct io_ask; 0: none                       */
};

struct asks {
	const struct program *program;
	int count;                      /* as many as map->net has             */
	struct ask ask[];
};

/** asks_new - the blocks that @map names. Owns: the caller, free(). Scan-safe: no. Fails: NULL: no memory. */
struct asks *asks_new(const struct program *program, const struct iomap *map);
/** asks_look - behind a scan, and before the inputs of the next one are read: so the values of an answer are
 * there when its block sees it. Does nothing while another program runs. Scan-safe: yes. */
void asks_look(struct asks *asks, struct image *image);
#endif
