/* SPDX-License-Identifier: MIT
 *
 * gateway - a gateway's side of a session: a program that serves points of the I/O map over a wire
 * or a network.
 *
 * It connects to ladderd on this machine with the role io, reads the map that runs, gives values of
 * inputs and gets those of outputs (docs/online.md). The number of a point is its index in
 * struct iomap of that map, the type of its value the `raw` of its channel.
 *
 * One thread at a time. A call waits until ladderd has answered, which takes less than a
 * millisecond as a rule; ladderd waits for no gateway. It shows nothing and reads no map itself.
 *
 *	gateway_open(…);
 *	while (gateway_begin(…) == DESK_GOOD) {
 *		// read the map, find the own points
 *		while (!gateway->changed && end == DESK_GOOD) {
 *			// poll() on gateway_fd() and the wires
 *			// gateway_put() what was read, then gateway_flush()
 *			end = gateway_listen(gateway, 0);
 *		}
 *	}
 */
#ifndef ONLINE_GATEWAY_H
#define ONLINE_GATEWAY_H

#include "online/desk.h"
#include "online/report.h"

struct gateway {
	struct desk desk;
	uint32_t map;          /* number of the map that runs                 */
	char *text;            /* that map; NUL behind it                     */
	size_t text_len;
	bool changed;          /* another program or map runs: begin again    */
	bool held;             /* no program runs: outputs have their safe values */
	uint8_t mode;          /* enum resource_state                         */
	/* Called by gateway_listen(), and by every other call that waits for an answer, for each
	 * output that has changed; for all of them after gateway_begin(). A slow gateway gets only
	 * the newest value. NULL: outputs are not wanted. A callback calls none of these functions. */
	void (*output)(void *context, uint32_t point, enum iec_type type, union iec_value value);
	/* The same for variables of gateway_publish(). @which: from 0 on, in its order. @good:
	 * false: inputs of the board may be old. A text is valid during the call. */
	void (*published)(void *context, uint32_t which, enum iec_type type, union iec_value value,
			  bool good);
	void *context;
	/* Its own. */
	uint16_t outputs;      /* the request that outputs came for           */
	uint16_t publish;
	enum iec_type *type;   /* of published variables                      */
	uint32_t published_count;
	uint32_t waiting;      /* values that wait for gateway_flush()        */
	struct wire_writer put;
	uint8_t body[WIRE_FRAME_MOST]; /* of the next io-put                  */
};

/**
 * gateway_open - connects and says hello
 * @socket: STREAM_SOCKET, as a rule; @program: name of this program, for the log
 *
 * Its callbacks are set afterwards. Owns: the caller, gateway_close(), also after a failure.
 * Scan-safe: no; so are all functions. Fails: as desk_open(); DESK_REFUSED with REFUSAL_ROLE: this
 * user is not in the group ladder-io.
 */
enum desk_end gateway_open(struct gateway *gateway, const char *socket, const char *program);
void gateway_close(struct gateway *gateway);
/** gateway_fd - for poll(): readable when gateway_listen() has something to do. */
int gateway_fd(const struct gateway *gateway);

/**
 * gateway_begin - says which points it serves, and gets the map that runs
 * @driver: "modbus" (also for the points of modules) or "peer"
 *
 * Again whenever gateway->changed is set. gateway->text is valid until then. Fails: DESK_REFUSED:
 * another gateway serves them (REFUSAL_GATEWAY).
 */
enum desk_end gateway_begin(struct gateway *gateway, const char *driver);

/**
 * gateway_put - an input was read, or an output written; goes with the next gateway_flush(), or at once if there is no room
 * @type: the raw type of its channel; not a STRING
 * @value: of an output it does not matter
 * @good: false: the device does not answer, or answers with an error; @value does not matter then
 *
 * Fails: as desk_call(). Values that were refused are gone. */
enum desk_end gateway_put(struct gateway *gateway, uint32_t point, enum iec_type type,
			  union iec_value value, bool good);
enum desk_end gateway_flush(struct gateway *gateway);
/** gateway_alive - asks ladderd for no more than an answer. */
enum desk_end gateway_alive(struct gateway *gateway);
/** gateway_listen - takes what comes within @ms, and all that has come: calls the callbacks.
 * Nothing came: DESK_GOOD, too. */
enum desk_end gateway_listen(struct gateway *gateway, int ms);

/**
 * gateway_window_read, gateway_window_write - coils or registers of a WINDOW of the map
 * @window: its index in iomap.net->window
 * @first:  from 0 on, of the window; @count: at most GATEWAY_WINDOW
 * @coils:  the window has coils, a register has 16 bits
 * @value:  a coil is 0 or 1
 *
 * All are of the same scan; all are written together between two scans. Fails: DESK_REFUSED:
 * REFUSAL_WINDOW: it has no such coil or register, or is read-only; REFUSAL_CONFLICT: another map
 * runs.
 */
#define GATEWAY_WINDOW 2048u
enum desk_end gateway_window_read(struct gateway *gateway, uint32_t window, uint32_t first,
				  uint16_t count, uint16_t *value);
enum desk_end gateway_window_write(struct gateway *gateway, uint32_t window, bool coils, uint32_t first,
				   uint16_t count, const uint16_t *value);

/**
 * gateway_publish - wants the values of variables that PUBLISH lines of the map name
 * @every_us: shortest time between two messages; the board takes no less than 10 ms
 *
 * Once after each gateway_begin(). Fails: DESK_REFUSED: REFUSAL_NO_NAME: the program has none of
 * that name, which is then in desk.detail; REFUSAL_PUBLISH: the map does not publish it.
 */
enum desk_end gateway_publish(struct gateway *gateway, const char *const *name, uint32_t count,
			      uint32_t every_us);

/** gateway_told - takes a frame that was not asked for, as gateway_listen() does. For tests. */
void gateway_told(struct gateway *gateway, const struct frame *frame);
/** gateway_report - what `ladder board WHERE status` shows: the gateway and its units. Every second
 * or so. */
enum desk_end gateway_report(struct gateway *gateway, const struct gateway_report *report);
#endif
