/* SPDX-License-Identifier: MIT
 *
 * server - the board's side of the link: sessions, and the services that they ask for.
 *
 * A session is a stream of bytes; the owner of the stream moves the bytes. The server
 * reaches the scan only through orders and views (online/exchange.h). After server_new() it
 * allocates nothing: SERVER_SESSIONS sessions, each with buffers for one frame in and one
 * out. While a frame waits to be sent, the session's next request is not read: a slow desk
 * slows itself. Answers go before published values.
 */
#ifndef ONLINE_SERVER_H
#define ONLINE_SERVER_H

#include "online/alarms.h"
#include "online/board_time.h"
#include "online/event.h"
#include "online/exchange.h"
#include "online/machine.h"
#include "online/publish.h"
#include "online/report.h"
#include "online/retained.h"
#include "online/stored.h"

#define SERVER_SESSIONS 8

struct server;

/* In the answer of `verify`. */
enum standby_map {
	MAP_RESTART,                   /* a line must be requested anew         */
	MAP_SAME,
	MAP_EXCHANGED,                 /* between two scans                     */
};

/* A program that a download brought, verified. */
struct standby_view {
	void *standby;                 /* of the daemon; goes with ORDER_SWAP  */
	uint8_t identity[32];
	enum standby_map map;
	enum refusal map_refusal;      /* why lines need a restart; or none    */
	const char *map_detail;        /* part of the diagnostic               */
	const struct carry_plan *plan;
};

/* The log of the board; by the link thread. */
struct server_log {
	void (*add)(void *context, enum event_id id, uint8_t role, const char *user,
		    const char *one, const char *two);
	bool (*next)(void *context, uint32_t seq, struct event *out);
};

#define SETTING_TEXT 64        /* bytes of a value with its NUL                */
struct setting {
	const char *key, *range;
	bool stored;           /* a desk has changed it                       */
	bool restart;          /* a change is in force after the next start   */
	char now[SETTING_TEXT], next[SETTING_TEXT];
};
/* Settings of the board; by the link thread. */
struct server_conf {
	bool (*get)(void *context, uint32_t number, struct setting *out);
	/** Stores it, and puts it into force if that needs no restart. @changed: as it was.
	 * @detail: parts of a diagnostic. */
	enum refusal (*change)(void *context, const char *key, const char *value,
			       struct setting *changed, char *detail, size_t size);
};

/* The program password; by the link thread. A detail is a part of a diagnostic. */
struct server_password {
	bool (*is_set)(void *context);
	/** @who: of the session. Fails: REFUSAL_WRONG, REFUSAL_WAIT, REFUSAL_MEMORY. */
	enum refusal (*check)(void *context, uint32_t who, const char *text, char *detail,
			      size_t size);
	/** @text: "": none from now on. */
	enum refusal (*change)(void *context, uint32_t who, const char *old, const char *text,
			       char *detail, size_t size);
};

/* Where downloads go; all by the link thread. A detail is a part of a diagnostic. */
struct server_store {
	/** A download of so many bytes with this hash; @received: of one that was cut. */
	enum refusal (*begin)(void *context, const uint32_t len[STORED_PARTS],
			      const uint8_t sha[32], uint32_t *received);
	/** @received: bytes that are there afterwards, also after a refusal. */
	enum refusal (*block)(void *context, uint32_t offset, const uint8_t *bytes, size_t len,
			      uint32_t *received);
	enum refusal (*verify)(void *context, struct standby_view *out, char *detail, size_t size);
	/** Requests the lines that are new in its map. */
	enum refusal (*open_lines)(void *context, char *detail, size_t size);
	/** The commit failed: gives them back. */
	void (*close_lines)(void *context);
	/** Writes all of it beside its slot. The next start does not look there. Fails:
	 * REFUSAL_DISK. */
	enum refusal (*store)(void *context, char *detail, size_t size);
	/** What store() wrote becomes the newest slot: the next start runs it. Fails:
	 * REFUSAL_DISK; then the next start runs the program before. */
	enum refusal (*keep)(void *context, char *detail, size_t size);
	/** Forgets what store() wrote. */
	void (*drop)(void *context);
	/** After ORDER_SWAP: frees the program before, if it cannot come back, and stores
	 * retained values again. */
	const struct program *(*swapped)(void *context, bool comes_back);
	void (*abort)(void *context);
	const struct stored *(*running)(void *context);
	/** The image of a program that runs or ran, as long as the record may need it. NULL:
	 * unknown. */
	const uint8_t *(*image)(void *context, const uint8_t identity[32], uint32_t *len);
};

/* A point of the map that a gateway serves. */
struct server_point {
	bool output;
	enum iec_type raw;             /* of its values; no STRING            */
};
/* The value of an output. */
struct server_output {
	uint32_t point, serial;        /* the serial rises with each change   */
	enum iec_type raw;
	union iec_value value;
};
/* How good the value of a point is. */
struct server_value {
	struct iec_addr addr;
	bool counts;                   /* it has a quality of its own: it is no line */
	uint8_t flags;                 /* STALE and FAULT of enum value_flag   */
};
/* A WINDOW of the map: so many bits or words from an address on. */
struct server_window {
	struct iec_addr addr;
	uint32_t count;
	bool writable;
};
/* The points of gateways, of the map that runs; by the link thread. */
struct server_io {
	void *context;
	/** How many points of the map it serves. */
	uint32_t (*points)(void *context, enum gateway_id gateway);
	/** Fails: false: it serves no point of this number. */
	bool (*point)(void *context, enum gateway_id gateway, uint32_t point,
		      struct server_point *out);
	/** @value: of the raw type of an input, not used of an output; @good: false: it could not be read or
	 * written. */
	void (*put)(void *context, uint32_t point, union iec_value value, bool good);
	/** The next output whose value has changed since it was given. Fails: false: none. */
	bool (*output)(void *context, enum gateway_id gateway, struct server_output *out);
	/** How many outputs it has. */
	uint32_t (*outputs)(void *context, enum gateway_id gateway);
	/** All outputs are given again. */
	void (*again)(void *context, enum gateway_id gateway);
	/** The gateway has gone. */
	void (*alone)(void *context, enum gateway_id gateway);
	bool (*window)(void *context, uint32_t number, struct server_window *out);
	/** STALE and FAULT of enum value_flag: of the worst point among @count bits of @area from @bit on.
	 * @io_bad: something of the map does not answer. */
	uint8_t (*quality)(void *context, enum iec_area area, uint32_t bit, uint32_t count, bool io_bad);
	/** Point @point of the map. Fails: false: there are no more points. */
	bool (*value)(void *context, uint32_t point, struct server_value *out);
	/** Whether a PUBLISH line names the variable. */
	bool (*publishes)(void *context, const char *name, size_t len);
};

/* The lines and devices of the board; by the link thread. */
struct server_machine {
	void *context;
	/** Whether the list is ready. If there is none yet, or @anew, one is begun; it is ready later. */
	bool (*look)(void *context, bool anew);
	/** Fails: false: there are no more rows. */
	bool (*row)(void *context, uint32_t number, struct machine_row *out);
};

struct server_setup {
	struct exchange *exchange;
	const struct program *program;
	const char *_Atomic *board; /* its name, which an exchange changes; borrowed */
	const struct server_log *log;
	const struct server_conf *conf;
	const struct server_password *password; /* NULL: there is none    */
	struct alarms *alarms; /* by the link thread, but its ring; NULL: no list */
	const struct server_clock *clock; /* NULL: the board tells no time     */
	bool keeps;            /* retained values are stored                  */
	const struct server_store *store; /* NULL: downloads are refused       */
	const struct server_io *io; /* NULL: no gateways                       */
	const struct server_machine *machine; /* NULL: it tells no devices     */
	/** Waits until the order of the exchange is done, at most some seconds.
	 * Returns whether it is. */
	bool (*wait)(void *context);
	/** The same, but not while a scan hangs. NULL, as hangs(): a board that does not know. */
	bool (*wait_unless_hung)(void *context);
	/** The scan that runs is over its limit and does not end; the outputs are safe. */
	bool (*hangs)(void *context);
	/** Fills in what is not the scan's: time, processor, memory. */
	void (*amend)(void *context, struct board_status *status);
	void *context;
};

/** server_new - Owns: the caller, server_free(). Scan-safe: no; so are all functions.
 * Fails: NULL: no memory. */
struct server *server_new(const struct server_setup *setup);
void server_free(struct server *server);

/** server_open - a session with the role that the kernel vouches for
 * @user: for the log; copied, cut
 * @who: number of the user; sessions of one user have the same
 * @may_io: it gets the role io if its hello asks for that
 *
 * If all are in use, the oldest one without rights or without a hello ends: its stream, which
 * has the number that is returned, must be closed. Returns the number; -1: all are in use. */
int server_open(struct server *server, enum role role, bool may_io, const char *user, uint32_t who);
/** server_close - ends a session: nothing on the board changes but what it watched. */
void server_close(struct server *server, int session);
int server_sessions(const struct server *server);

/** server_room - where bytes from the desk go; 0 bytes: read no more for now. */
uint8_t *server_room(struct server *server, int session, size_t *len);
/** server_got - that many bytes were put there. */
void server_got(struct server *server, int session, size_t len);
/** server_pending - bytes for the desk; 0: none. */
const uint8_t *server_pending(struct server *server, int session, size_t *len);
void server_sent(struct server *server, int session, size_t len);
/** server_is_over - the stream made no sense, and all was sent: close it. */
bool server_is_over(const struct server *server, int session);

/** server_settle - a program that was given to the scan thread may run by now: goes on with it.
 * Before server_changed(); server_step() does it, too. */
void server_settle(struct server *server);
/** server_changed - the board went back to @program by itself; each session gets @why. */
void server_changed(struct server *server, const struct program *program, const char *why);

/** server_image - the program that runs, as the server knows it. */
const struct image *server_image(const struct server *server);

/** server_step - one request of each session, and published values that are due.
 * Returns whether there may be more to do at once. */
bool server_step(struct server *server, int64_t now_ns);
/** server_due - when a value is to be published next; INT64_MAX: never. */
int64_t server_due(const struct server *server);
/* When server_step() is to be called for gateways. */
enum server_wants {
	WANTS_NOTHING,
	WANTS_MODE,            /* when the mode has changed                   */
	WANTS_OUTPUTS,         /* after each scan                             */
};
enum server_wants server_wants(const struct server *server);
#endif
