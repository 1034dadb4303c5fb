/* SPDX-License-Identifier: MIT
 *
 * serve - what all services of the server use: orders to the scan thread, what is watched, answers and their
 * details, the log.
 */
#include "online/serve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- orders ---- */

static bool post(struct server *server)
{
	if (!exchange_is_done(server->setup.exchange))
		return false;
	if (server->order.kind < ORDER_MODE)
		server->order.program = server->setup.program;
	server->order.refusal = REFUSAL_BUSY; /* until it is done */
	exchange_post(server->setup.exchange, &server->order);
	return true;
}

static enum refusal await(struct server *server, bool (*wait)(void *context))
{
	return wait(server->setup.context) ? server->order.refusal : REFUSAL_BUSY;
}

enum refusal server_give(struct server *server)
{
	return post(server) ? await(server, server->setup.wait) : REFUSAL_BUSY;
}

bool server_hangs(const struct server *server)
{
	return server->setup.hangs && server->setup.hangs(server->setup.context);
}

enum refusal server_give_unless_hung(struct server *server)
{
	enum refusal refusal;

	if (!server->setup.hangs)
		return server_give(server);
	if (!post(server))
		return REFUSAL_BUSY;
	refusal = await(server, server->setup.wait_unless_hung);
	/* It may have ended meanwhile. */
	return refusal == REFUSAL_BUSY && !server_hangs(server) ? await(server, server->setup.wait) : refusal;
}

/* An order may be given only if the one before is done: it is the same memory. */
bool server_can_order(const struct server *server)
{
	return exchange_is_done(server->setup.exchange) && server->given == GIVEN_NOTHING;
}

/* Learns the forces of the board anew. */
enum refusal server_learn_forces(struct server *server)
{
	enum refusal refusal;

	if (!server_can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_FORCES, .forces = &server->held };
	refusal = server_give(server);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->mirror.force_count = server->held.force_count;
	memcpy(server->mirror.force, server->held.force, sizeof(server->held.force));
	return REFUSAL_NONE;
}

struct order server_restart(const struct expect *expect, bool stopped)
{
	return (struct order){ .kind = ORDER_RESTART, .expects = true,
			       .mode = stopped ? MODE_STOP : MODE_WARM, .expect = *expect };
}

/* ---- watched bytes ---- */

static void sort_ranges(struct range *range, uint32_t count)
{
	for (uint32_t gap = count / 2; gap; gap /= 2)
		for (uint32_t i = gap; i < count; i++) {
			const struct range moved = range[i];
			uint32_t k = i;

			for (; k >= gap && range[k - gap].at > moved.at; k -= gap)
				range[k] = range[k - gap];
			range[k] = moved;
		}
}

/* Sorts, and makes one of those that are near. Returns how many are left. */
static uint32_t join_ranges(struct range *range, uint32_t count)
{
	uint32_t last = 0;

	sort_ranges(range, count);
	for (uint32_t i = 1; i < count; i++) {
		const uint32_t end = range[last].at + range[last].size;
		const uint32_t new_end = range[i].at + range[i].size;

		if (range[i].at <= end + NEAR) {
			if (new_end > end)
				range[last].size = new_end - range[last].at;
		} else {
			range[++last] = range[i];
		}
	}
	return count ? last + 1 : 0;
}

static void add_range(void *context, struct range range)
{
	struct server *server = context;
	struct range *ranges = server->ranges[!server->ranges_in_use];

	if (server->range_count == RANGES_MOST)
		server->range_count = join_ranges(ranges, server->range_count);
	if (server->range_count < RANGES_MOST)
		ranges[server->range_count++] = range;
	else
		server->ranges_full = true;
}

/* Tells the scan thread what to copy after each scan from now on. */
enum refusal server_watch_again(struct server *server)
{
	const int other = !server->ranges_in_use;
	enum refusal refusal;
	bool power = false;

	if (!server_can_order(server))
		return REFUSAL_BUSY;
	server->range_count = 0;
	server->ranges_full = false;
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (!session->used)
			continue;
		publish_ranges(&session->publications, server->setup.program, add_range, server);
		power |= publish_has_cells(&session->publications);
	}
	if (server->ranges_full)
		return REFUSAL_TOO_MANY;
	server->watch = (struct watch){
		.serial = server->watch.serial + 1, .power = power,
		.count = join_ranges(server->ranges[other], server->range_count),
		.range = server->ranges[other],
	};
	server->order = (struct order){ .kind = ORDER_WATCH, .watch = &server->watch };
	refusal = server_give(server);
	server->ranges_in_use = other;
	return refusal;
}

enum refusal serve_look(struct server *server, uint32_t count)
{
	const struct program *program = server->setup.program;
	enum refusal refusal;

	if (server->no_memory)
		return REFUSAL_MEMORY;
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	for (uint32_t i = 0; i < count; i++)
		server->look_range[i] = (struct range){
			place_byte(program, server->place[i]),
			place_size(program, server->place[i]) };
	server->look_watch = (struct watch){
		.range = server->look_range,
		.count = join_ranges(server->look_range, count),
	};
	server->order = (struct order){ .kind = ORDER_LOOK, .watch = &server->look_watch,
					.view = &server->look };
	refusal = server_give(server);
	if (refusal == REFUSAL_NONE)
		server->mirror.memory = server->look.memory;
	return refusal;
}

/* ---- answers ---- */

void asked_detail(struct asked *asked, const char *text, size_t len)
{
	if (len >= sizeof(asked->detail))
		len = sizeof(asked->detail) - 1;
	memcpy(asked->detail, text, len);
	asked->detail[len] = '\0';
}

void asked_begin(struct asked *asked, uint8_t flags)
{
	asked->out = wire_write(asked->session->out, sizeof(asked->session->out));
	frame_begin(&asked->out, asked->frame.service, (uint8_t)(WIRE_ANSWER | flags),
		    asked->frame.request);
}

bool asked_is_locked(const struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;

	return setup->password && setup->password->is_set(setup->context) &&
	       !asked->session->unlocked;
}

/* ---- the log ---- */

/* Who asked is known from the session. */
void asked_tell(const struct asked *asked, enum event_id id, const char *one, const char *two)
{
	const struct server_setup *setup = &asked->server->setup;

	setup->log->add(setup->context, id, (uint8_t)asked->session->role, asked->session->user,
			one, two);
}

enum refusal asked_refuse_role(struct asked *asked, enum role needed)
{
	snprintf(asked->detail, sizeof(asked->detail), "%s" DIAG_AND "%s" DIAG_AND "%s",
		 asked->row->word, role_word(needed), role_word(asked->session->role));
	return REFUSAL_ROLE;
}

/* What is possible only in which mode, and the mode that the board is in. */
void asked_tell_mode(struct asked *asked)
{
	const struct order *order = &asked->server->order;
	const bool restores = order->kind == ORDER_RESTORE;

	snprintf(asked->detail, sizeof(asked->detail), "%s" DIAG_AND "%s" DIAG_AND "%s",
		 restores ? "restore" : mode_wish_word(order->mode),
		 mode_word(restores ? STATE_STOP : mode_wish_needs(order->mode)),
		 mode_word((uint8_t)order->state));
}

static bool same_place(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where;
}

void server_name_place(struct server *server, struct location at)
{
	struct symbol symbol;

	server->cursor = (struct symbol_cursor){ .whole = false };
	while (image_next_symbol(&server->mirror, &server->cursor, &symbol))
		if (same_place(symbol.at, at)) {
			snprintf(server->name, sizeof(server->name), "%s", symbol.name);
			return;
		}
	place_address(server->setup.program, at, server->name, sizeof(server->name));
}

enum refusal asked_finish(struct asked *asked)
{
	struct server *server = asked->server;
	enum refusal refusal = server_give(server);

	const uint64_t scan = server->order.scan;

	asked->detail[0] = '\0';
	if (refusal == REFUSAL_NOT_NOW)
		asked_tell_mode(asked);

	if (refusal != REFUSAL_NONE && server->order.wrong < server->order.count) {
		server_name_place(server, server->item[server->order.wrong].at);
		asked_detail(asked, server->name, strlen(server->name));
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (server->order.kind != ORDER_WRITE)
		server_learn_forces(server); /* if the board is busy, the next view says that they differ */
	asked_begin(asked, 0);
	wire_put_u64(&asked->out, scan);
	return REFUSAL_NONE;
}

/* ---- another program ---- */

void session_begin_symbols(struct session *session)
{
	session->symbol = 0;
	session->symbols = (struct symbol_cursor){ .whole = false };
}

/* All that sessions have asked to be sent, and how far they read the symbols, is of the old program. */
static void end_publications(struct server *server)
{
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		publish_init(&server->session[i].publications);
		server->session[i].gateway = (struct gateway_session){ .begun = false };
		session_begin_symbols(&server->session[i]);
		server->session[i].changed = true;
	}
}

/* The link's own copy of the image is as large as the program's. */
void server_renew(struct server *server, const struct program *program)
{
	uint8_t *memory = calloc(1, image_memory_size(program));

	end_publications(server);
	server->map++;
	server->retained.copy = NULL; /* its plan is of the old program */
	server->setup.program = program;
	server->mirror.program = program;
	server->mirror.force_count = 0;
	if (memory) {
		free(server->look.memory);
		server->look.memory = memory;
	}
	server->no_memory = !memory;
	server->mirror.memory = server->look.memory;
}

int server_sessions(const struct server *server)
{
	int count = 0;

	for (int i = 0; i < SERVER_SESSIONS; i++)
		count += server->session[i].used;
	return count;
}
