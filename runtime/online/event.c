/* SPDX-License-Identifier: MIT
 *
 * event - fields, records and texts of the log.
 */
#include "online/event.h"
#include "online/status.h"

#include "engine/base/diag.h"
#include "engine/base/digest.h"
#include "engine/base/lex.h"

#include <stdio.h>
#include <string.h>

const char *event_text(uint8_t id)
{
	switch (id) {
#define EVENT(id, number, text) case number: return text;
#include "online/events.def"
	}
	return NULL;
}

void event_program(const uint8_t identity[32], char out[65])
{
	static const uint8_t none[32];

	digest_hex(identity, 32, out);
	if (memcmp(identity, none, 32) == 0)
		memcpy(out, "none", 5);
}

void event_put(struct wire_writer *out, const struct event *event)
{
	wire_put_u32(out, event->seq);
	wire_put_i64(out, event->time_ns);
	wire_put_u8(out, event->id);
	wire_put_u8(out, event->role);
	wire_put_string(out, event->user);
	wire_put_string(out, event->arg[0]);
	wire_put_string(out, event->arg[1]);
}

void event_take(struct wire_reader *in, struct event *event)
{
	memset(event, 0, sizeof(*event));
	event->seq = wire_u32(in);
	event->time_ns = wire_i64(in);
	event->id = wire_u8(in);
	event->role = wire_u8(in);
	wire_copy_text(in, event->user, sizeof(event->user));
	wire_copy_text(in, event->arg[0], sizeof(event->arg[0]));
	wire_copy_text(in, event->arg[1], sizeof(event->arg[1]));
}

void event_seal(const struct event *event, uint8_t *out)
{
	struct wire_writer body = wire_write(out, EVENT_BYTES - 4);
	struct wire_writer tail = wire_write(out + EVENT_BYTES - 4, 4);

	memset(out, 0, EVENT_BYTES);
	event_put(&body, event);
	wire_put_u32(&tail, digest_crc32c(0, out, EVENT_BYTES - 4));
}

bool event_open(const uint8_t *bytes, struct event *out)
{
	struct wire_reader body = wire_read(bytes, EVENT_BYTES - 4);
	struct wire_reader tail = wire_read(bytes + EVENT_BYTES - 4, 4);

	event_take(&body, out);
	return !body.failed && out->seq && wire_u32(&tail) ==
	       digest_crc32c(0, bytes, EVENT_BYTES - 4);
}

int status_next(const struct board_status *status, const char *text, char *out, size_t size)
{
	struct event event = { .id = status->next };

	snprintf(event.arg[0], sizeof(event.arg[0]), "%.79s", status->next_why);
	return event_fill(&event, text, out, size);
}

int status_began(const struct board_status *status, const char *text, char *out, size_t size)
{
	struct event event = { .id = status->began };

	if (status->began == EVENT_DIED || status->began == EVENT_FAILED)
		snprintf(event.arg[0], sizeof(event.arg[0]), "%u", (unsigned)status->began_how);
	if (status->began_ends)
		snprintf(event.arg[1], sizeof(event.arg[1]), "%u", (unsigned)status->began_ends);
	return event_fill(&event, text, out, size);
}

int event_print(const struct event *event, char *out, size_t size)
{
	return event_fill(event, event_text(event->id), out, size);
}

int event_fill(const struct event *event, const char *text, char *out, size_t size)
{
	char args[2 * sizeof(event->arg[0]) + 2];
	int len;

	snprintf(args, sizeof(args), "%s" DIAG_AND "%s", event->arg[0], event->arg[1]);
	len = text ? diag_fill(text, args, out, size) :
		     snprintf(out, size, "event %u", (unsigned)event->id);
	while (size && *out) {
		const size_t whole = utf8_length(out, strlen(out));

		if (!whole || (unsigned char)*out < ' ' || *out == 127)
			*out = '?';
		out += whole ? whole : 1;
	}
	return len;
}
