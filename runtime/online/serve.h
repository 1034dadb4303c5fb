/* SPDX-License-Identifier: MIT
 *
 * serve - what the files of the server share: its state, and what a service does with a request.
 *
 * serve.c has what all services use, server.c sessions and requests. The services are in serve_board.c (who is there, mode,
 * settings, password), serve_values.c (reading, watching, writing, forcing), serve_download.c
 * (programs), serve_files.c (retained values, log, record), serve_alarms.c, serve_io.c (gateways) and serve_machine.c. Only these
 * files include this one.
 */
#ifndef ONLINE_SERVE_H
#define ONLINE_SERVE_H

#include "online/server.h"

#define REFS_MOST   4096     /* variables of one request                      */
#define KEPT        8        /* answers to changes, for repeated requests     */
#define KEPT_BYTES  288
#define KEPT_FOR    1024     /* requests: then the number may have come round */
#define DETAIL_MOST 200      /* bytes of a refusal's detail                   */
#define RANGES_MOST 65536u   /* pieces of memory that are copied after a scan */
#define SYMBOL_BYTES (WIRE_TEXT_MOST + 64) /* of one symbol in a page, at most        */
#define PART_MOST   32768u   /* bytes of the record that one order copies     */
#define NEAR        16       /* ranges that are so near are copied as one     */

/* A download that was given to the scan thread, as long as its end is not known. */
enum given { GIVEN_NOTHING, GIVEN_SWAP, GIVEN_RESTART };

/* What a session has as a gateway; all zero: nothing. */
struct gateway_session {
	bool begun;
	enum gateway_id id;
	uint16_t outputs;      /* the request that asked for outputs; 0: none */
	bool more;             /* a frame had no room for all outputs         */
	bool told;             /* a frame of outputs was sent                 */
	int state;             /* … with this mode                            */
};

/* An answer to a request that changed something. */
struct kept {
	uint16_t request;
	uint8_t service;
	uint64_t number;     /* of the request in its session; 0: none        */
	size_t len;
	uint8_t bytes[KEPT_BYTES];
};

struct session {
	bool used, greeted, over;
	bool told_role;        /* the log says that it was refused for its role */
	bool changed;          /* not announced yet: another program runs     */
	bool unlocked;         /* the program password was given              */
	bool may_io;           /* it gets the role io if it asks for it       */
	enum role role;
	struct gateway_session gateway;
	char user[64];
	uint32_t who;          /* number of the user                          */
	uint64_t opened;       /* counts up: the least is the oldest session   */
	uint64_t requests;
	size_t in_len, out_len, out_sent;
	struct symbol_cursor symbols;
	uint32_t symbol;       /* number of the symbol at `symbols`           */
	struct kept kept[KEPT];
	struct publications publications;
	uint8_t in[WIRE_FRAME_MOST], out[WIRE_FRAME_MOST];
};

struct server {
	uint64_t opened;
	int downloading;       /* the session whose download it is; -1: none  */
	struct server_setup setup;
	struct retained retained;
	/* Given to the scan thread with an order, so not touched until it is done. */
	struct order order;
	struct board_status status;    /* the scan thread fills it in           */
	struct board_status known;     /* the last one; of no version: none     */
	struct image held;     /* only its forces                             */
	struct watch look_watch;
	struct standby_view standby;
	bool verified;
	enum given given;
	char why[STATUS_TEXT]; /* the board went back by itself; "": a desk did it */
	uint32_t map;          /* rises with each program                     */
	/* Of gateways. */
	struct gateways_status gateways; /* what the status tells              */
	struct values_status values;   /* likewise, of the I/O map            */
	struct gateway_report report[GATEWAY_COUNT]; /* the last ones          */
	uint64_t io_session[GATEWAY_COUNT]; /* `opened` of the session that began last */
	int64_t io_told_ns[GATEWAY_COUNT]; /* of its last event in the log, 0: none */
	bool io_told[GATEWAY_COUNT];       /* … that it began                  */
	int64_t now_ns;        /* of the last step                            */
	bool no_memory;        /* for the image of a new program: no reading  */
	/* The program over the memory of a view, with the forces of the board. */
	struct image mirror;
	struct view look;
	struct recorder_part part;
	uint8_t part_bytes[PART_MOST];
	struct range look_range[REFS_MOST];
	struct location place[REFS_MOST];
	struct order_item item[REFS_MOST];
	bool allowed[REFS_MOST]; /* items that VAR_ACCESS lets operators write */
	struct iec_text text[REFS_MOST / 16];
	struct symbol_cursor cursor;
	char name[2 * LIMIT_NAME + 64];
	struct watch watch;
	struct range *ranges[2]; /* the scan thread has one of them           */
	uint32_t range_count;
	bool ranges_full;
	int ranges_in_use;
	struct session session[SERVER_SESSIONS];
};

struct asked {
	struct server *server;
	struct session *session;
	const struct service_row *row;
	struct frame frame;
	struct wire_writer out;   /* the answer                               */
	char detail[DETAIL_MOST];
};

/* ---- serve.c; all by the link thread ---- */

/** server_give - gives server->order to the scan thread and waits. Fails: REFUSAL_BUSY: it is not
 * done yet; or as the scan thread says. */
enum refusal server_give(struct server *server);
/** server_give_unless_hung - the same, but while a scan hangs, REFUSAL_BUSY comes at once. */
enum refusal server_give_unless_hung(struct server *server);
/** server_hangs - a scan is over its limit and does not end; the outputs are safe. */
bool server_hangs(const struct server *server);
/** server_can_order - the order before is done: server->order may be used again. */
bool server_can_order(const struct server *server);
/** server_learn_forces - server->mirror gets the forces of the board. */
enum refusal server_learn_forces(struct server *server);
/** server_watch_again - tells the scan thread what all sessions watch. */
enum refusal server_watch_again(struct server *server);
/** server_renew - another program runs: nothing is watched any more. */
void server_renew(struct server *server, const struct program *program);
/** server_restart - the order to begin again; @stopped: in STOP. */
struct order server_restart(const struct expect *expect, bool stopped);

/** asked_detail - the detail of a refusal; cut. */
void asked_detail(struct asked *asked, const char *text, size_t len);
/** asked_begin - begins the answer. @flags: 0, or WIRE_REFUSED. */
void asked_begin(struct asked *asked, uint8_t flags);
/** asked_tell - an event of the log; who asked is known from the session. */
void asked_tell(const struct asked *asked, enum event_id id, const char *one, const char *two);
/** asked_refuse_role - REFUSAL_ROLE, and its detail. */
enum refusal asked_refuse_role(struct asked *asked, enum role needed);
/** asked_is_locked - the session must give the program password first. */
bool asked_is_locked(const struct asked *asked);
/** asked_tell_mode - the detail of REFUSAL_NOT_NOW of server->order. */
void asked_tell_mode(struct asked *asked);
/** server_with_quality - serve_io.c: a copy of @view whose values have the quality that @session gets. */
struct view server_with_quality(struct server *server, const struct session *session, const struct view *view);
/** server_name_place - the first name of a place, in server->name; its address if it has none. */
void server_name_place(struct server *server, struct location at);
/** session_begin_symbols - the next request for symbols begins at the first one. */
void session_begin_symbols(struct session *session);
/** serve_look - server->mirror gets the values of @count of server->place. */
enum refusal serve_look(struct server *server, uint32_t count);
/** asked_finish - gives a change to the scan thread, and answers. */
enum refusal asked_finish(struct asked *asked);

/* ---- services: they answer, or say why not ---- */

enum refusal serve_hello(struct asked *asked);
enum refusal serve_status(struct asked *asked);
enum refusal serve_read(struct asked *asked);
enum refusal serve_publish(struct asked *asked);
enum refusal serve_unpublish(struct asked *asked);
enum refusal serve_change(struct asked *asked, enum order_kind kind);
enum refusal serve_mode(struct asked *asked);
enum refusal serve_forces(struct asked *asked);
enum refusal serve_symbols(struct asked *asked);
enum refusal serve_download(struct asked *asked);
enum refusal serve_block(struct asked *asked);
enum refusal serve_sums(struct asked *asked);
enum refusal serve_pieces(struct asked *asked);
enum refusal serve_verify(struct asked *asked);
enum refusal serve_commit(struct asked *asked);
enum refusal serve_abort(struct asked *asked);
enum refusal serve_upload(struct asked *asked);
enum refusal serve_config(struct asked *asked);
enum refusal serve_password(struct asked *asked);
enum refusal serve_retain(struct asked *asked);
enum refusal serve_events(struct asked *asked);
enum refusal serve_record(struct asked *asked);
enum refusal serve_alarms(struct asked *asked);
enum refusal serve_ack(struct asked *asked);
enum refusal serve_time(struct asked *asked);
enum refusal serve_io_begin(struct asked *asked);
enum refusal serve_io_map(struct asked *asked);
enum refusal serve_io_put(struct asked *asked);
enum refusal serve_io_outputs(struct asked *asked);
enum refusal serve_io_window(struct asked *asked);
enum refusal serve_io_report(struct asked *asked);

enum refusal serve_devices(struct asked *asked);

/* ---- serve_io.c, for the others ---- */

/** io_check_publish - a gateway may watch what the map publishes. @in: the fields of `publish` behind
 * its kind; not moved. */
enum refusal io_check_publish(struct asked *asked, struct wire_reader in);
/** io_give - the next frame of outputs for a session. Returns its bytes; 0: nothing has changed. */
size_t io_give(struct server *server, struct session *session);
/** io_end - a session serves no points any more. */
void io_end(struct server *server, struct session *session);
/** io_status - what the status tells of gateways. */
const struct gateways_status *io_status(struct server *server);
/** io_values - what the status tells of the values of the I/O map. */
const struct values_status *io_values(struct server *server);
#endif
