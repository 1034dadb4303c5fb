/* SPDX-License-Identifier: MIT
 *
 * serve_files - what a board keeps: retained values, the log, the record.
 */
#include "online/serve.h"

#include "engine/scan/carry.h"

#include <stdio.h>

/* For the session, and the values as they are between two scans. Memory of an order that is late
 * is not touched. */
static enum refusal begin_retained(struct asked *asked)
{
	struct server *server = asked->server;
	struct retained *retained = &server->retained;
	const int session = (int)(asked->session - server->session);
	enum refusal refusal;

	if (!server_can_order(server) || (retained->owner >= 0 && retained->owner != session))
		return REFUSAL_BUSY;
	if (!server->setup.program->string_bytes)
		return REFUSAL_NO_NAMES;
	if (!retained_plan(retained, server->setup.program))
		return REFUSAL_MEMORY;
	server->order = (struct order){
		.kind = ORDER_RETAIN, .retain = { &retained->plan, retained->copy, 0 },
	};
	refusal = server_give(server);
	retained->clock_ns = server->order.retain.clock_ns;
	if (refusal == REFUSAL_NONE)
		retained->owner = session;
	return refusal;
}

static enum refusal read_retained(struct asked *asked)
{
	struct server *server = asked->server;
	struct retained *retained = &server->retained;
	const uint32_t offset = wire_u32(&asked->frame.body);
	const uint8_t *payload;
	uint32_t size, len;
	enum refusal refusal = REFUSAL_NONE;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!offset)
		refusal = begin_retained(asked);
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!offset)
		retained_fill(retained);
	if (retained->owner != asked->session - server->session || !retained->copy)
		return REFUSAL_CONFLICT;
	payload = retained_payload(retained, &size);
	if (offset > size)
		return REFUSAL_BAD_FRAME;
	len = size - offset < STORED_BLOCK ? size - offset : STORED_BLOCK;
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, server->setup.keeps);
	wire_put_u32(&asked->out, size);
	wire_put_bytes(&asked->out, payload + offset, len);
	if (offset + len == size)
		retained->owner = -1;
	return REFUSAL_NONE;
}

static enum refusal take_retained(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct retained *retained = &server->retained;
	const int session = (int)(asked->session - server->session);
	const uint32_t size = wire_u32(in), offset = wire_u32(in);
	const size_t len = wire_left(in);
	const uint8_t *bytes = wire_bytes(in, len);

	if (in->failed || !len)
		return REFUSAL_BAD_FRAME;
	if (retained->owner >= 0 && retained->owner != session)
		return REFUSAL_BUSY;
	if (size > LIMIT_RETAIN)
		return REFUSAL_TOO_MANY;
	if (!retained_take_part(retained, size, offset, bytes, len))
		return retained->bytes ? REFUSAL_NOT_WHOLE : REFUSAL_MEMORY;
	retained->owner = session;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, retained->received);
	return REFUSAL_NONE;
}

struct misfits {
	struct wire_writer *out;
	uint32_t count, told;
};

/* With the reasons of `verify`. */
static void put_misfit(void *context, const struct retain_record *record, enum retain_fate fate)
{
	static const uint8_t reason[] = {
		[RETAIN_KEPT] = CARRY_NEW, [RETAIN_NO_NAME] = CARRY_GONE,
		[RETAIN_NO_TYPE] = CARRY_TYPE,
	};
	struct misfits *misfits = context;

	misfits->count++;
	if ((size_t)(misfits->out->end - misfits->out->at) < SYMBOL_BYTES)
		return; /* counted, not named */
	misfits->told++;
	wire_put_u8(misfits->out, reason[fate]);
	wire_put_text(misfits->out, record->name, record->name_len);
}

/* Checks all values; puts those that fit. */
static enum refusal restore_retained(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct retained *retained = &server->retained;
	const struct expect expect = wire_expect(in);
	const uint8_t how = wire_u8(in);
	struct misfits misfits = { .out = &asked->out };
	enum refusal refusal;
	char number[16];
	uint8_t *head;
	int kept;

	if (!wire_done(in) || how > 1)
		return REFUSAL_BAD_FRAME;
	refusal = server->setup.keeps ? begin_retained(asked) : REFUSAL_NO_RETAIN;
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	head = asked->out.at;
	for (int i = 0; i < 3; i++)
		wire_put_u32(&asked->out, 0);
	kept = retained_merge(retained, put_misfit, &misfits);
	if (kept < 0) {
		retained->owner = -1;
		return REFUSAL_NOT_WHOLE;
	}
	{
		struct wire_writer fill = wire_write(head, 12);

		wire_put_u32(&fill, (uint32_t)kept);
		wire_put_u32(&fill, misfits.count);
		wire_put_u32(&fill, misfits.told);
	}
	if (how == 0)
		return REFUSAL_NONE;
	server->order = (struct order){
		.kind = ORDER_RESTORE, .expects = true, .expect = expect,
		.retain = { &retained->plan, retained->copy, retained->clock_ns },
	};
	refusal = server_give(server);
	if (refusal == REFUSAL_NOT_NOW)
		asked_tell_mode(asked);
	if (refusal != REFUSAL_NONE)
		return refusal;
	snprintf(number, sizeof(number), "%d", kept);
	asked_tell(asked, EVENT_RETAIN, number, "");
	retained->owner = -1;
	return REFUSAL_NONE;
}

enum refusal serve_retain(struct asked *asked)
{
	switch (wire_u8(&asked->frame.body)) {
	case 0:
		return read_retained(asked);
	case 1:
		return take_retained(asked);
	case 2:
		return restore_retained(asked);
	default:
		return REFUSAL_BAD_FRAME;
	}
}

/* As many as fit, from a number on. */
enum refusal serve_events(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	const uint32_t from = wire_u32(&asked->frame.body);
	struct event event = { .seq = from };
	uint16_t count = 0;
	uint8_t *head;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	asked_begin(asked, 0);
	head = asked->out.at;
	wire_put_u16(&asked->out, 0);
	while ((size_t)(asked->out.end - asked->out.at) > EVENT_BYTES &&
	       setup->log->next(setup->context, count ? event.seq + 1 : from, &event)) {
		event_put(&asked->out, &event);
		count++;
	}
	head[0] = (uint8_t)count;
	head[1] = (uint8_t)(count >> 8);
	return REFUSAL_NONE;
}

static enum refusal serve_log(struct asked *asked, uint64_t from)
{
	struct server *server = asked->server;
	struct recorder_part *part = &server->part;
	enum refusal refusal;

	if (!server_can_order(server))
		return REFUSAL_BUSY;
	*part = (struct recorder_part){ .from = from, .out = server->part_bytes,
					.room = PART_MOST };
	server->order = (struct order){ .kind = ORDER_RECORD, .part = part };
	refusal = server_give(server);
	if (refusal == REFUSAL_RECORD_SMALL)
		snprintf(asked->detail, sizeof(asked->detail), "%u", (unsigned)(server->setup.exchange->recorder->size / 1024));
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u64(&asked->out, part->oldest);
	wire_put_u64(&asked->out, part->end);
	wire_put_u64(&asked->out, part->at);
	wire_put_bytes(&asked->out, part->out, part->len);
	return REFUSAL_NONE;
}

static enum refusal serve_program(struct asked *asked, const uint8_t *identity, uint32_t offset)
{
	const struct server_store *store = asked->server->setup.store;
	const uint8_t *image;
	uint32_t len = 0, part;

	image = store ? store->image(asked->server->setup.context, identity, &len) : NULL;
	if (!image)
		return REFUSAL_NO_IMAGE;
	if (asked_is_locked(asked))
		return REFUSAL_PASSWORD;
	if (offset > len)
		return REFUSAL_BAD_FRAME;
	part = len - offset < STORED_BLOCK ? len - offset : STORED_BLOCK;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, len);
	wire_put_bytes(&asked->out, image + offset, part);
	return REFUSAL_NONE;
}

enum refusal serve_record(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint8_t what = wire_u8(in);
	const uint64_t from = what == 0 ? wire_u64(in) : 0;
	const uint8_t *identity = what == 1 ? wire_bytes(in, 32) : NULL;
	const uint32_t offset = what == 1 ? wire_u32(in) : 0;

	if (what > 1 || !wire_done(in))
		return REFUSAL_BAD_FRAME;
	return what == 0 ? serve_log(asked, from) : serve_program(asked, identity, offset);
}
