/* SPDX-License-Identifier: MIT
 *
 * serve_download - another program: received, verified, stored, given to the scan thread; and read back.
 */
#include "online/serve.h"

#include "engine/base/digest.h"
#include "engine/scan/carry.h"
#include "online/sums.h"

#include <stdio.h>

/* Only the session that began it goes on with it; and not while a late order may still take it. */
static enum refusal own_download(const struct asked *asked)
{
	if (!asked->server->setup.store)
		return REFUSAL_NO_STORE;
	if (!server_can_order(asked->server))
		return REFUSAL_BUSY;
	if (asked->server->downloading < 0)
		return REFUSAL_NO_DOWNLOAD;
	return asked->server->downloading == asked->session - asked->server->session ?
		       REFUSAL_NONE : REFUSAL_OTHER_DOWNLOAD;
}

enum refusal serve_download(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct stored wanted = { .bytes = NULL };
	const uint8_t *sha;
	uint32_t received;
	enum refusal refusal;

	for (int i = 0; i < STORED_PARTS; i++)
		wanted.len[i] = wire_u32(in);
	sha = wire_bytes(in, 32);
	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	if (!server->setup.store)
		return REFUSAL_NO_STORE;
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	if (server->downloading >= 0 && own_download(asked) != REFUSAL_NONE)
		return REFUSAL_OTHER_DOWNLOAD;
	snprintf(asked->detail, sizeof(asked->detail), "%u bytes at most", STORED_MOST);
	if (!stored_size(&wanted))
		return REFUSAL_TOO_MANY;
	asked->detail[0] = '\0';
	refusal = server->setup.store->begin(server->setup.context, wanted.len, sha, &received);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->downloading = (int)(asked->session - server->session);
	server->verified = false;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, received);
	return REFUSAL_NONE;
}

enum refusal serve_block(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	const uint32_t offset = wire_u32(in);
	const size_t len = wire_left(in);
	const uint8_t *bytes = wire_bytes(in, len);
	uint32_t received;
	enum refusal refusal = own_download(asked);

	if (in->failed || !len)
		return REFUSAL_BAD_FRAME;
	if (refusal == REFUSAL_NONE)
		refusal = server->setup.store->block(server->setup.context, offset, bytes, len,
						     &received);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->verified = false;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, received);
	return REFUSAL_NONE;
}

/* The program that runs, for a session that may read it. */
static enum refusal give_running(struct asked *asked, const struct stored **stored)
{
	const struct server_store *store = asked->server->setup.store;

	if (!store)
		return REFUSAL_NO_STORE;
	if (asked_is_locked(asked))
		return REFUSAL_PASSWORD;
	*stored = store->running(asked->server->setup.context);
	return REFUSAL_NONE;
}

/* The sums of the blocks of the program that runs. Sums of blocks of many sizes tell its bytes,
 * so they need the password. */
enum refusal serve_sums(struct asked *asked)
{
	const uint32_t first = wire_u32(&asked->frame.body);
	const uint32_t block = wire_u16(&asked->frame.body);
	const struct stored *stored;
	uint32_t all, count = SUMS_WORK / (block ? block : 1);
	enum refusal refusal;

	if (!wire_done(&asked->frame.body) || block < SUMS_LEAST || block > SUMS_MOST)
		return REFUSAL_BAD_FRAME;
	refusal = give_running(asked, &stored);
	if (refusal != REFUSAL_NONE)
		return refusal;
	all = stored_size(stored) / block;
	if (first > all)
		return REFUSAL_BAD_FRAME;
	if (count > SUMS_PAGE)
		count = SUMS_PAGE;
	if (count > all - first)
		count = all - first;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, stored_size(stored));
	for (uint32_t i = first; i < first + count; i++) {
		const uint8_t *bytes = stored->bytes + (size_t)i * block;
		uint8_t strong[SUMS_STRONG];

		sums_strong(bytes, block, strong);
		wire_put_u32(&asked->out, sums_weak(bytes, block));
		wire_put_bytes(&asked->out, strong, sizeof(strong));
	}
	return REFUSAL_NONE;
}

/* Copies from the program that runs, and bytes; in this order behind what is there. */
enum refusal serve_pieces(struct asked *asked)
{
	struct server *server = asked->server;
	const struct server_store *store = server->setup.store;
	struct wire_reader *in = &asked->frame.body;
	uint32_t offset = wire_u32(in), received = 0;
	enum refusal refusal = own_download(asked);
	const struct stored *runs;

	if (in->failed || !wire_left(in))
		return REFUSAL_BAD_FRAME;
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->verified = false;
	runs = store->running(server->setup.context);
	while (wire_left(in) && refusal == REFUSAL_NONE) {
		const uint8_t kind = wire_u8(in);
		const uint32_t from = kind == PIECE_COPY ? wire_u32(in) : 0;
		const uint32_t len = kind == PIECE_COPY ? wire_u32(in) : wire_u16(in);
		const uint8_t *bytes = kind == PIECE_BYTES ? wire_bytes(in, len) : NULL;

		if (in->failed || !len || kind > PIECE_BYTES)
			return REFUSAL_BAD_FRAME;
		if (kind == PIECE_COPY && asked_is_locked(asked))
			return REFUSAL_PASSWORD; /* `verify` would tell whether a guess is right */
		if (kind == PIECE_COPY &&
		    (from > stored_size(runs) || len > stored_size(runs) - from))
			return REFUSAL_NOT_WHOLE;
		refusal = store->block(server->setup.context, offset,
				       bytes ? bytes : runs->bytes + from, len, &received);
		offset += len;
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, received);
	return REFUSAL_NONE;
}

struct losses {
	struct wire_writer *out;
	uint32_t count, told;
};

static void put_loss(void *context, const struct carry_loss *loss)
{
	struct losses *losses = context;

	losses->count++;
	if ((size_t)(losses->out->end - losses->out->at) < SYMBOL_BYTES)
		return; /* counted, not named */
	losses->told++;
	wire_put_u8(losses->out, (uint8_t)loss->reason);
	wire_put_string(losses->out, loss->name);
}

enum refusal serve_verify(struct asked *asked)
{
	struct server *server = asked->server;
	struct losses losses = { .out = &asked->out };
	enum refusal refusal = own_download(asked);
	uint8_t *head;

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = server_learn_forces(server);
	if (refusal == REFUSAL_NONE)
		refusal = server->setup.store->verify(server->setup.context, &server->standby,
						      asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->verified = true;
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, (uint8_t)server->standby.map);
	wire_put_bytes(&asked->out, server->standby.identity, 32);
	head = asked->out.at;
	wire_put_u32(&asked->out, 0);
	wire_put_u32(&asked->out, 0);
	server->held.program = server->setup.program;
	server->held.memory = NULL;
	carry_plan_losses(server->standby.plan, &server->held, put_loss, &losses);
	{
		struct wire_writer fill = wire_write(head, 8);

		wire_put_u32(&fill, losses.count);
		wire_put_u32(&fill, losses.told);
	}
	return REFUSAL_NONE;
}

/* Another program runs, put there by a desk. */
static void go_on(struct server *server)
{
	const bool back = server->order.back != 0;

	server->verified = false;
	server->downloading = -1;
	server->why[0] = '\0';
	server_renew(server, server->setup.store->swapped(server->setup.context, back));
	server_learn_forces(server); /* if the board is busy, the next view says that they differ */
}

/* The slot is replaced only when the scan thread has taken the program: what a desk was refused
 * never starts, also if ladderd is killed meanwhile. Fails: the program could not be kept. */
static enum refusal settle(struct server *server, char *detail, size_t size)
{
	const struct server_setup *setup = &server->setup;
	const enum given given = server->given;
	enum refusal kept;

	if (given == GIVEN_NOTHING || !exchange_is_done(setup->exchange))
		return REFUSAL_NONE;
	server->given = GIVEN_NOTHING;
	if (server->order.refusal != REFUSAL_NONE) {
		setup->store->drop(setup->context);
		setup->store->close_lines(setup->context);
		return REFUSAL_NONE;
	}
	kept = setup->store->keep(setup->context, detail, size);
	if (given == GIVEN_RESTART)
		return kept;
	if (kept != REFUSAL_NONE)
		setup->log->add(setup->context, EVENT_NOT_KEPT, 0, "", detail, "");
	go_on(server);
	return kept == REFUSAL_NONE ? REFUSAL_NONE : REFUSAL_NOT_KEPT;
}

void server_settle(struct server *server)
{
	char detail[DETAIL_MOST];

	settle(server, detail, sizeof(detail));
}

/* An order that is late is settled later: its program may run by then. */
static enum refusal give_program(struct asked *asked, const struct order *order)
{
	struct server *server = asked->server;
	enum refusal refusal, kept;

	server->order = *order;
	server->given = order->kind == ORDER_SWAP ? GIVEN_SWAP : GIVEN_RESTART;
	refusal = server_give(server);
	kept = settle(server, asked->detail, sizeof(asked->detail));
	return refusal == REFUSAL_NONE ? kept : refusal;
}

/* From which identity to which. */
static void tell_download(const struct asked *asked, const struct expect *before)
{
	char from[65], to[65];

	event_program(before->program, from);
	event_program(asked->server->standby.identity, to);
	asked_tell(asked, EVENT_DOWNLOAD, from, to);
}

enum refusal serve_commit(struct asked *asked)
{
	struct server *server = asked->server;
	const struct server_store *store = server->setup.store;
	struct wire_reader *in = &asked->frame.body;
	const struct expect expect = wire_expect(in);
	const uint8_t how = wire_u8(in);
	const uint32_t back = wire_left(in) ? wire_u32(in) : 0;
	enum refusal refusal = own_download(asked);
	uint64_t scan;

	if (!wire_done(in) || how >= COMMIT_COUNT || (how != COMMIT_LIVE && back))
		return REFUSAL_BAD_FRAME;
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!server->verified)
		return REFUSAL_NO_DOWNLOAD;
	if (how == COMMIT_LIVE && server->standby.map_refusal != REFUSAL_NONE) {
		snprintf(asked->detail, sizeof(asked->detail), "%s", server->standby.map_detail);
		return server->standby.map_refusal;
	}
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	/* Nothing is written for a desk that is stale. */
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status,
					.expects = true, .expect = expect };
	refusal = server_give(server);
	scan = server->order.scan;
	if (refusal == REFUSAL_NONE && how == COMMIT_LIVE)
		refusal = store->open_lines(server->setup.context, asked->detail,
					    sizeof(asked->detail));
	if (refusal == REFUSAL_NONE)
		refusal = store->store(server->setup.context, asked->detail,
				       sizeof(asked->detail));
	if (refusal == REFUSAL_NONE) {
		const struct order order = how == COMMIT_LIVE ?
			(struct order){ .kind = ORDER_SWAP, .other = server->standby.standby,
					.back = back, .expects = true, .expect = expect } :
			server_restart(&expect, how == COMMIT_STOPPED);

		refusal = give_program(asked, &order);
	} else {
		store->close_lines(server->setup.context);
	}
	if (refusal == REFUSAL_NONE || refusal == REFUSAL_NOT_KEPT)
		tell_download(asked, &expect);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->downloading = -1;
	asked_begin(asked, 0);
	wire_put_u64(&asked->out, scan);
	return REFUSAL_NONE;
}

enum refusal serve_abort(struct asked *asked)
{
	const enum refusal refusal = own_download(asked);

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	asked->server->setup.store->abort(asked->server->setup.context);
	asked->server->downloading = -1;
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

enum refusal serve_upload(struct asked *asked)
{
	const uint32_t offset = wire_u32(&asked->frame.body);
	const struct stored *stored;
	enum refusal refusal;
	uint32_t size, len;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = give_running(asked, &stored);
	if (refusal != REFUSAL_NONE)
		return refusal;
	size = stored_size(stored);
	if (offset > size)
		return REFUSAL_BAD_FRAME;
	len = size - offset < STORED_BLOCK ? size - offset : STORED_BLOCK;
	if (!offset)
		asked_tell(asked, EVENT_UPLOAD, "", "");
	asked_begin(asked, 0);
	for (int i = 0; i < STORED_PARTS; i++)
		wire_put_u32(&asked->out, stored->len[i]);
	wire_put_bytes(&asked->out, stored->bytes + offset, len);
	return REFUSAL_NONE;
}
