/* SPDX-License-Identifier: MIT
 *
 * remote - a session of `ladder board` or `ladder push` with a board, shared by the files of
 * their actions.
 */
#ifndef LADDER_REMOTE_H
#define LADDER_REMOTE_H

#include "ladder/bytes.h"
#include "ladder/report.h"

#include "online/machine.h"
#include "online/desk.h"
#include "online/status.h"
#include "online/stored.h"

/* A variable that a person named, and its type on the board. */
struct named {
	const char *name;
	size_t len;
	enum iec_type type;
	uint8_t flags;
	union iec_value value;
	struct iec_text text;
};

/* A program on its way to a board: image, map and sources, one after another. */
struct parcel {
	struct machine machine;
	struct bytes bytes;
	struct stored stored;
	size_t map_len;
};

/* How a program is put on a board, and what became of it. */
struct put {
	bool ask;              /* before values are lost                      */
	bool restart;          /* the board begins again                      */
	bool or_restart;       /* restart if the board does not run, or the map needs it */
	bool or_else;          /* there is another way: no message if the board stores nothing */
	bool no_store;         /* it stores nothing                           */
	uint8_t program[32];   /* identity of the new program                 */
};

struct remote {
	struct call *call;
	const char *where;
	struct desk desk;
	struct stream_where to;
	bool json;
	struct expect expect;  /* what ran when the command began             */
	char why[160];         /* the board went back to the program before    */
	struct named *named;
	uint32_t count;
	struct put put;
	/* Of watch. */
	uint64_t lines, most;
	int64_t first_ns;
	bool begun;
};

/** remote_fail - prints why a call failed; its exit status. */
enum status remote_fail(const struct remote *remote, enum desk_end end);
/** remote_tell - prints a message that needs no more than the board's place; returns STATUS_WRONG. */
enum status remote_tell(const struct remote *remote, enum diag_id id);
/** remote_status - asks what runs, and expects it from now on. Fails: after a message. */
enum status remote_status(struct remote *remote, struct board_status *status);

#define REMOTE_SETTINGS 32
struct board_setting {
	char key[32], now[64], next[64], range[48];
	bool stored, restart;
};
struct board_settings {
	int count;
	struct board_setting at[REMOTE_SETTINGS];
};
/** remote_expect - what runs now is expected from now on; @mode: in the same mode. Fails: after
 * a message. */
enum status remote_expect(struct remote *remote, bool mode);
/** remote_settings - asks for all. Fails: after a message. */
enum status remote_settings(struct remote *remote, struct board_settings *settings);
/** remote_set - changes one; @restart: the board begins anew, and the session ends. */
enum status remote_set(struct remote *remote, const char *key, const char *value, bool restart,
		       bool *needs_restart);
/** remote_print_status - as `ladder board WHERE status`. */
void remote_print_status(const struct remote *remote, const struct board_status *status);

/** parcel_open - reads and checks program and map; both, even if the first has errors. Owns:
 * the caller, parcel_close(), always. Fails: a status after diagnostics. */
enum status parcel_open(struct parcel *parcel, const char *path, const char *map_path);
void parcel_close(struct parcel *parcel);
/** remote_put - downloads it as remote->put says; prints what does not go on. Fails: after
 * messages; without one if put->no_store is set. */
enum status remote_put(struct remote *remote, const struct parcel *parcel);

/** remote_again - connects once more, silently; false: nobody answers. */
bool remote_again(struct remote *remote);
/** remote_peek - status, silently. */
bool remote_peek(struct remote *remote, struct board_status *status);
/** remote_stop - stops the program if it runs; outputs get their safe values. Fails: after a
 * message. */
enum status remote_stop(struct remote *remote);
/** remote_begin, remote_finish - a request that changes something, and its answer. The program must still be
 * the one that was asked for its types; its mode may change. Fail: after a message. */
enum status remote_begin(struct remote *remote, enum service service, struct wire_writer *out);
enum status remote_finish(struct remote *remote, struct wire_writer *out);
/** remote_mode - starts or stops the program. Fails: after a message. */
enum status remote_mode(struct remote *remote, enum mode_wish wish);
/** remote_is_wanted - asks on the terminal, unless --yes; without a terminal the answer is no. */
bool remote_is_wanted(struct remote *remote, const char *question);
/** remote_send - sends a program and has it verified; @verified: the answer. */
enum status remote_send(struct remote *remote, const struct stored *stored,
			struct wire_reader *verified);
/** remote_commit - @back: a FAULT within so many scans brings the program before back; 0: none. */
enum status remote_commit(struct remote *remote, enum commit_how how, uint32_t back);
/** remote_unlock - asks for the program password and gives it to the board. Fails: after a message. */
enum status remote_unlock(struct remote *remote);
/** remote_receive - what the board stores. @bytes: empty at first; @stored points into it.
 * Owns: the caller, free(bytes->at), also after a failure. Fails: after a message. */
enum status remote_receive(struct remote *remote, struct stored *stored, struct bytes *bytes);

/** remote_download, remote_upload, remote_compare - the actions. */
enum status remote_download(struct remote *remote);
enum status remote_upload(struct remote *remote);
enum status remote_compare(struct remote *remote);
enum status remote_config(struct remote *remote);
enum status remote_password(struct remote *remote);
enum status remote_backup(struct remote *remote);
enum status remote_restore(struct remote *remote);
enum status remote_record(struct remote *remote);
enum status remote_alarms(struct remote *remote);
enum status remote_time(struct remote *remote);
/* The lines and devices of a board. */
struct remote_machine {
	struct machine_row *row;
	uint32_t count, room;
};
/** remote_check_map - board_map.c: prints of each line of the map @path whether the board has it. Fails: STATUS_NO:
 * it lacks one, or the map has errors. */
enum status remote_check_map(struct remote *remote, const char *path, const struct remote_machine *machine);
/** remote_devices - board_devices.c */
enum status remote_devices(struct remote *remote);
/** remote_print_alarms - a line of `status`, or a field: how many alarms are active; none, or null,
 * if the board keeps no list. */
void remote_print_alarms(struct remote *remote);
/** remote_print_gateways - lines of `status`, or a field, about the gateways of the board, if it has any. */
void remote_print_gateways(struct remote *remote);
#endif
