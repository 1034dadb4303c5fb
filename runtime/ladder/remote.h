/* SPDX-License-Identifier: MIT
 *
 * remote - a session of `ladder board`, shared by the files of its actions.
 */
#ifndef LADDER_REMOTE_H
#define LADDER_REMOTE_H

#include "ladder/report.h"

#include "online/desk.h"
#include "online/status.h"

/* A variable that a person named, and its type on the board. */
struct named {
	const char *name;
	size_t len;
	enum iec_type type;
	uint8_t flags;
	union iec_value value;
	struct iec_text text;
};

struct remote {
	struct call *call;
	const char *where;
	struct desk desk;
	bool json;
	struct expect expect;  /* what ran when the command began             */
	struct named *named;
	uint32_t count;
	/* Of watch. */
	uint64_t lines, most;
	int64_t first_ns;
	bool begun;
};

/** remote_fail - prints why a call failed; its exit status. */
enum status remote_fail(const struct remote *remote, enum desk_end end);
/** remote_status - asks what runs, and expects it from now on. Fails: after a message. */
enum status remote_status(struct remote *remote, struct board_status *status);

/** remote_download, remote_upload - the actions. */
enum status remote_download(struct remote *remote);
enum status remote_upload(struct remote *remote);
#endif
