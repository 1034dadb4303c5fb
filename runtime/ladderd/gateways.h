/* SPDX-License-Identifier: MIT
 *
 * gateways - which points of the I/O map that runs a gateway serves, and their values.
 *
 * All of it is for the link thread. The scan reads and writes the same channels without a lock.
 */
#ifndef LADDERD_GATEWAYS_H
#define LADDERD_GATEWAYS_H

#include "hal/channels.h"
#include "ladderd/asks.h"
#include "online/server.h"

/* Outputs that one gateway serves. */
struct gateway_outputs {
	uint32_t *point;       /* their numbers in the map                    */
	uint32_t *given;       /* the serial of the value that it has; 0: none */
	uint32_t count;
	uint32_t next;         /* the one to be looked at next                */
};

struct gateways {
	const struct iomap *map;
	struct channels *channels;
	struct asks *asks;     /* of Modbus: the points behind those of the map */
	uint32_t points[GATEWAY_COUNT];
	struct gateway_outputs outputs[GATEWAY_COUNT];
	uint32_t *order;       /* points by area and first bit                */
};

/** gateways_use - another map runs; all are borrowed. Without memory its gateways have no points. */
void gateways_use(struct gateways *gateways, const struct iomap *map, struct channels *channels,
		  struct asks *asks);
void gateways_free(struct gateways *gateways);
/** gateways_io - for the server. */
struct server_io gateways_io(struct gateways *gateways);
#endif
