/* SPDX-License-Identifier: MIT
 *
 * finder - boards that announce themselves in the network by DNS-SD (`_ladder._tcp`), and the
 * serial ports of this machine.
 *
 * Avahi does the work (finder_avahi.c); a build without its library finds no board
 * (finder_none.c). It connects to no board. For programs of a desk only.
 */
#ifndef ONLINE_FINDER_H
#define ONLINE_FINDER_H

#include <stdbool.h>
#include <stdint.h>

#define FINDER_SERVICE "_ladder._tcp"
#define FINDER_MOST    256 /* announcements that are kept                        */
#define FINDER_SSH     22

struct found_board {
	char name[64];         /* its record `board`, else the name of the service; no control
	                        * characters                                    */
	char where[256];       /* for `ssh`: a name of a host, checked by stream_is_host() */
	char version[32];      /* of ladderd; "" if it does not say           */
	uint16_t port;         /* of its ssh                                  */
};

struct finder;

/**
 * finder_open - begins to listen
 * @why: set on failure: a text, static
 *
 * Owns: the caller, finder_close(). Fails: NULL.
 */
struct finder *finder_open(const char **why);
/** finder_wait - takes what comes within @ms, until the list changes or is settled; 0: what is
 * there already. Returns whether the list has changed since the last call. */
bool finder_wait(struct finder *finder, int ms);
/** finder_settled - whether all boards that answer at once are in the list. */
bool finder_settled(const struct finder *finder);
/** finder_failed - NULL, or why Avahi has ended meanwhile; static. */
const char *finder_failed(const struct finder *finder);
int finder_count(const struct finder *finder);
/** finder_board - each board once, by name; valid until the next finder_wait(). */
const struct found_board *finder_board(const struct finder *finder, int index);
void finder_close(struct finder *finder);

/** finder_text - copies @len bytes of a text from the network; control characters become `?`.
 * @size: of @out */
void finder_text(char *out, int size, const char *text, int len);
/** finder_ports - `/dev/ttyUSB0` and the like, by name. @folder: `/dev`. Returns how many. */
int finder_ports(const char *folder, char out[][64], int most);
#endif
