/* SPDX-License-Identifier: MIT
 *
 * serve - the servers of a map: connections and serial lines on which others ask.
 *
 * One thread: the caller polls, serve_step() takes what has come and answers. It limits connections and
 * requests a second. What may be asked is the matter of answer.h.
 */
#ifndef MODBUS_SERVE_H
#define MODBUS_SERVE_H

#include "modbus/answer.h"
#include "modbus/line.h"

#include <poll.h>

#define SERVE_FRAME 260

struct serve_client {
	int fd;                /* -1: none                                     */
	int serve;             /* number in the map                            */
	int64_t heard_ns;
	int len;
	uint8_t byte[SERVE_FRAME];
};

struct serve_place {
	int fd;                /* listens; -1: a serial line                    */
	struct line line;
	int64_t credit_ns;     /* time for requests that has not been used       */
	int64_t at_ns;         /* … reckoned then                               */
	int clients;
};

struct serve {
	const struct io_net *net;
	struct answer_image image;
	struct serve_place *place; /* one for each SERVE of the map              */
	struct serve_client *client; /* also one for each serial line            */
	int clients;           /* room                                         */
	struct pollfd *ready;  /* as many as clients and places                */
	int readies;
	uint64_t answers, refusals; /* of all                                    */
};

/** serve_open - listens everywhere. Owns: serve_close(), also after a failure.
 * Fails: false; @bad: the number of the server, -1: no memory; errno says why. */
bool serve_open(struct serve *serve, const struct io_net *net, struct answer_image image, int *bad);
void serve_close(struct serve *serve);
/** serve_poll - fills serve->ready. Returns when serve_step() has something to do also without any of
 * them; INT64_MAX: never. */
int64_t serve_poll(struct serve *serve, int64_t now_ns);
/** serve_step - takes what has come and answers. */
void serve_step(struct serve *serve, int64_t now_ns);
/** serve_rtu - finds a request for @unit in the bytes of a serial line
 * @quiet: no byte has come for some time
 * @take: bytes to drop afterwards, also without a request; 0: wait for more
 * Returns the length of the frame at the begin of @byte, or 0. */
int serve_rtu(const uint8_t *byte, int len, uint8_t unit, bool quiet, int *take);
#endif
