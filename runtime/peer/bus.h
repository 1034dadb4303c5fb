/* SPDX-License-Identifier: MIT
 *
 * bus - the socket of one group on one interface.
 *
 * It sends to the group and takes only what came to the group, on that interface, from an address of its network.
 * Nothing that it sends leaves the segment: no router passes it on.
 */
#ifndef PEER_BUS_H
#define PEER_BUS_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define BUS_NETWORKS 8 /* addresses of one interface                            */

struct bus {
	const char *interface, *group;
	uint16_t port;
	int fd;                /* -1: not open                                */
	unsigned index;        /* of the interface                            */
	struct in_addr group_at;
	struct in_addr network[BUS_NETWORKS], mask[BUS_NETWORKS];
	int networks;
	int error;             /* why it is not open, or does not send; 0     */
	uint64_t sent, strange; /* strange: not from this network, or too long */
};

/** bus_init - borrowed: @interface, @group. Not open. */
void bus_init(struct bus *bus, const char *interface, const char *group, uint16_t port);
/** bus_keep - opens it, and opens it again if the interface has come back as another one. Every second or so.
 * Returns whether it is open; else bus->error. */
bool bus_keep(struct bus *bus);
/** bus_problem - why a bus is not open or does not send, from bus->error: at most 30 bytes. */
const char *bus_problem(int error);
/** bus_hint - what a person can do about it. Static. */
const char *bus_hint(int error);
void bus_close(struct bus *bus);
/** bus_send - Fails: false; bus->error. */
bool bus_send(struct bus *bus, const uint8_t *bytes, size_t len);
/** bus_take - the next datagram. Returns its bytes; 0: none waits. @from: its sender, in network order. */
size_t bus_take(struct bus *bus, uint8_t *out, size_t size, uint32_t *from);
#endif
