/* SPDX-License-Identifier: MIT
 *
 * server - sessions: bytes in, one request after another, bytes out.
 *
 * One order at a time: the server waits until the scan thread has done it. If that takes too
 * long, the order stays where it is, and whoever asks meanwhile is told that the board is busy.
 */
#include "online/server.h"

#include "engine/base/digest.h"
#include "engine/base/version.h"
#include "engine/scan/carry.h"
#include "online/sums.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
	bool changed;          /* to be told: another program runs            */
	bool unlocked;         /* the program password was given              */
	enum role role;
	char user[64];
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
	struct board_status status;
	struct image held;     /* only its forces                             */
	struct watch look_watch;
	struct standby_view standby;
	bool verified;
	enum given given;
	char why[STATUS_TEXT]; /* the board went back by itself; "": a desk did it */
	bool no_memory;        /* for the image of a new program: no reading  */
	/* The program over the memory of a view, with the forces of the board. */
	struct image mirror;
	struct view look;
	struct recorder_part part;
	uint8_t part_bytes[PART_MOST];
	struct range look_range[REFS_MOST];
	struct location place[REFS_MOST];
	struct order_item item[REFS_MOST];
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

/* ---- orders ---- */

static enum refusal give(struct server *server)
{
	if (!exchange_is_done(server->setup.exchange))
		return REFUSAL_BUSY;
	if (server->order.kind < ORDER_MODE)
		server->order.program = server->setup.program;
	server->order.refusal = REFUSAL_BUSY; /* until it is done */
	exchange_post(server->setup.exchange, &server->order);
	return server->setup.wait(server->setup.context) ? server->order.refusal : REFUSAL_BUSY;
}

/* An order may be given only if the one before is done: it is the same memory. */
static bool can_order(const struct server *server)
{
	return exchange_is_done(server->setup.exchange) && server->given == GIVEN_NOTHING;
}

/* Learns the forces of the board anew. */
static enum refusal learn_forces(struct server *server)
{
	enum refusal refusal;

	if (!can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_FORCES, .forces = &server->held };
	refusal = give(server);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->mirror.force_count = server->held.force_count;
	memcpy(server->mirror.force, server->held.force, sizeof(server->held.force));
	return REFUSAL_NONE;
}

/* ---- what is watched ---- */

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
static enum refusal watch_again(struct server *server)
{
	const int other = !server->ranges_in_use;
	enum refusal refusal;
	bool power = false;

	if (!can_order(server))
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
	refusal = give(server);
	server->ranges_in_use = other;
	return refusal;
}

/* ---- answers ---- */

struct asked {
	struct server *server;
	struct session *session;
	const struct service_row *row;
	struct frame frame;
	struct wire_writer out;   /* the answer                               */
	char detail[DETAIL_MOST];
};

static void detail(struct asked *asked, const char *text, size_t len)
{
	if (len >= sizeof(asked->detail))
		len = sizeof(asked->detail) - 1;
	memcpy(asked->detail, text, len);
	asked->detail[len] = '\0';
}

static void begin_answer(struct asked *asked, uint8_t flags)
{
	asked->out = wire_write(asked->session->out, sizeof(asked->session->out));
	frame_begin(&asked->out, asked->frame.service, (uint8_t)(WIRE_ANSWER | flags),
		    asked->frame.request);
}

static void refuse(struct asked *asked, enum refusal refusal)
{
	begin_answer(asked, WIRE_REFUSED);
	wire_put_u16(&asked->out, (uint16_t)refusal);
	wire_put_string(&asked->out, asked->detail);
}

/* ---- the log ---- */

/* Who asked is known from the session. */
static void tell_log(const struct asked *asked, enum event_id id, const char *one, const char *two)
{
	const struct server_setup *setup = &asked->server->setup;

	setup->log->add(setup->context, id, (uint8_t)asked->session->role, asked->session->user,
			one, two);
}

/* ---- variables ---- */

static enum refusal find_place(struct asked *asked, const struct ref *ref, struct location *at)
{
	struct server *server = asked->server;
	const struct program *program = server->setup.program;
	struct iec_addr addr;

	if (ref->kind == REF_PLACE) {
		*at = place_locate(program, ref->place);
		snprintf(asked->detail, sizeof(asked->detail), "place %08x", (unsigned)ref->place);
	} else {
		detail(asked, ref->name, ref->len);
		*at = image_find(&server->mirror, ref->name, ref->len);
	}
	if (at->type == IEC_NONE && ref->kind == REF_NAME && !program->string_bytes &&
	    iec_addr_parse(ref->name, ref->len, &addr) == ADDR_NONE)
		return REFUSAL_NO_NAMES;
	return at->type == IEC_NONE ? REFUSAL_NO_NAME : REFUSAL_NONE;
}

/* Reads the number of variables of a request. */
static enum refusal take_count(struct asked *asked, uint32_t most, uint32_t *count)
{
	*count = wire_u16(&asked->frame.body);
	if (asked->frame.body.failed)
		return REFUSAL_BAD_FRAME;
	if (*count <= most)
		return REFUSAL_NONE;
	snprintf(asked->detail, sizeof(asked->detail), "%u variables; at most %u",
		 (unsigned)*count, (unsigned)most);
	return REFUSAL_TOO_MANY;
}

static enum refusal take_places(struct asked *asked, uint32_t count)
{
	struct server *server = asked->server;

	for (uint32_t i = 0; i < count; i++) {
		const struct ref ref = wire_ref(&asked->frame.body);
		enum refusal refusal;

		if (asked->frame.body.failed)
			return REFUSAL_BAD_FRAME;
		refusal = find_place(asked, &ref, &server->place[i]);
		if (refusal != REFUSAL_NONE)
			return refusal;
	}
	asked->detail[0] = '\0';
	return wire_done(&asked->frame.body) ? REFUSAL_NONE : REFUSAL_BAD_FRAME;
}

/* References and values, as `write` and `force` have them. */
static enum refusal take_items(struct asked *asked, uint32_t count)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	uint32_t texts = 0;

	for (uint32_t i = 0; i < count; i++) {
		const struct ref ref = wire_ref(in);
		const enum iec_type type = (enum iec_type)wire_u8(in);
		struct order_item *item = &server->item[i];
		enum refusal refusal;

		if (type == IEC_STRING && texts == REFS_MOST / 16)
			return REFUSAL_TOO_MANY;
		item->value = wire_value(in, type, &server->text[texts]);
		texts += type == IEC_STRING;
		if (in->failed)
			return REFUSAL_BAD_FRAME;
		refusal = find_place(asked, &ref, &item->at);
		if (refusal == REFUSAL_NONE && item->at.type != type)
			refusal = REFUSAL_TYPE;
		if (refusal != REFUSAL_NONE)
			return refusal;
	}
	return wire_done(in) ? REFUSAL_NONE : REFUSAL_BAD_FRAME;
}

static enum refusal refuse_role(struct asked *asked, enum role needed)
{
	snprintf(asked->detail, sizeof(asked->detail), "%s" DIAG_AND "%s" DIAG_AND "%s",
		 asked->row->word, role_word(needed), role_word(asked->session->role));
	return REFUSAL_ROLE;
}

/* ---- services ---- */

static enum refusal serve_hello(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint32_t magic = wire_u32(in);
	const uint16_t lowest = wire_u16(in), highest = wire_u16(in);
	size_t len;

	wire_text(in, &len); /* the name of the desk's program */
	if (in->failed || magic != ONLINE_MAGIC)
		return REFUSAL_BAD_FRAME;
	snprintf(asked->detail, sizeof(asked->detail), "desk %u to %u, board %u to %u",
		 (unsigned)lowest, (unsigned)highest, ONLINE_LOWEST, ONLINE_HIGHEST);
	if (lowest > ONLINE_HIGHEST || highest < ONLINE_LOWEST)
		return REFUSAL_VERSION;
	asked->session->greeted = true;
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, ONLINE_MAGIC);
	wire_put_u16(&asked->out, highest < ONLINE_HIGHEST ? highest : ONLINE_HIGHEST);
	wire_put_u8(&asked->out, (uint8_t)asked->session->role);
	wire_put_u8(&asked->out, (uint8_t)(asked->session - asked->server->session));
	wire_put_string(&asked->out, LADDER_VERSION);
	wire_put_string(&asked->out, asked->server->setup.board);
	return REFUSAL_NONE;
}

static enum refusal serve_status(struct asked *asked)
{
	struct server *server = asked->server;
	enum refusal refusal;

	if (!can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status };
	refusal = give(server);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->setup.amend(server->setup.context, &server->status);
	server->status.sessions = (uint32_t)server_sessions(server);
	begin_answer(asked, 0);
	status_put(&asked->out, &server->status);
	return REFUSAL_NONE;
}

static enum refusal serve_read(struct asked *asked)
{
	struct server *server = asked->server;
	const struct program *program = server->setup.program;
	uint32_t count;
	enum refusal refusal = server->no_memory ? REFUSAL_MEMORY :
			       take_count(asked, REFS_MOST, &count);

	if (refusal == REFUSAL_NONE)
		refusal = take_places(asked, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!can_order(server))
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
	refusal = give(server);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->mirror.memory = server->look.memory;
	begin_answer(asked, 0);
	wire_put_u8(&asked->out, (uint8_t)server->look.state);
	wire_put_u64(&asked->out, server->look.scan);
	wire_put_i64(&asked->out, server->look.now_ns);
	wire_put_u16(&asked->out, (uint16_t)count);
	for (uint32_t i = 0; i < count; i++) {
		const struct location at = server->place[i];

		wire_put_u8(&asked->out, (image_is_forced(&server->mirror, at) ? VALUE_FORCED : 0) |
					 (server->look.io_bad ? VALUE_STALE : 0));
		wire_put_u8(&asked->out, (uint8_t)at.type);
		wire_put_value(&asked->out, at.type, image_get(&server->mirror, at));
	}
	return REFUSAL_NONE;
}

static enum refusal serve_publish(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct publications *all = &asked->session->publications;
	const uint32_t period_us = wire_u32(in);
	const enum publish_what what = (enum publish_what)wire_u8(in);
	struct publish_set *set = NULL;
	enum refusal refusal = REFUSAL_NONE;
	uint32_t count = 0;

	if (in->failed || (what != PUBLISH_VARIABLES && what != PUBLISH_CELLS))
		return REFUSAL_BAD_FRAME;
	if (what == PUBLISH_VARIABLES)
		refusal = take_count(asked, PUBLISH_VALUES, &count);
	if (refusal == REFUSAL_NONE && what == PUBLISH_VARIABLES)
		refusal = take_places(asked, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	set = publish_new(all, asked->frame.request, period_us);
	if (!set) {
		snprintf(asked->detail, sizeof(asked->detail), "a session can watch %d lists",
			 PUBLISH_SETS);
		return REFUSAL_TOO_MANY;
	}
	for (uint32_t i = 0; i < count && refusal == REFUSAL_NONE; i++)
		if (!publish_add(all, set, server->place[i])) {
			snprintf(asked->detail, sizeof(asked->detail),
				 "a session can watch %u variables", PUBLISH_VALUES);
			refusal = REFUSAL_TOO_MANY;
		}
	if (what == PUBLISH_CELLS) {
		size_t len;
		const char *name = wire_text(in, &len);

		detail(asked, name, len);
		refusal = !wire_done(in) ? REFUSAL_BAD_FRAME :
			  publish_cells(all, set, server->setup.program, name, len);
	}
	set->serial = server->watch.serial + 1;
	if (refusal == REFUSAL_NONE)
		refusal = watch_again(server);
	if (refusal != REFUSAL_NONE) {
		publish_drop(all, asked->frame.request);
		return refusal;
	}
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, set->count);
	for (uint32_t i = 0; i < count; i++)
		wire_put_u8(&asked->out, (uint8_t)server->place[i].type);
	return REFUSAL_NONE;
}

static enum refusal serve_unpublish(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint16_t request = wire_u16(in);
	enum refusal refusal;

	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	publish_drop(&asked->session->publications, request);
	refusal = watch_again(asked->server);
	if (refusal == REFUSAL_NONE)
		begin_answer(asked, 0);
	return refusal;
}

static bool same_place(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where;
}

/* The first name of a place, in server->name; its address if it has none. */
static void name_place(struct server *server, struct location at)
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

static enum refusal finish_change(struct asked *asked)
{
	struct server *server = asked->server;
	enum refusal refusal = give(server);

	const uint64_t scan = server->order.scan;
	const char *mode = mode_word((uint8_t)server->order.state);

	asked->detail[0] = '\0';
	if (refusal == REFUSAL_NOT_NOW)
		detail(asked, mode, strlen(mode));

	if (refusal != REFUSAL_NONE && server->order.wrong < server->order.count) {
		name_place(server, server->item[server->order.wrong].at);
		detail(asked, server->name, strlen(server->name));
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (server->order.kind != ORDER_WRITE)
		learn_forces(server); /* if the board is busy, the next view says that they differ */
	begin_answer(asked, 0);
	wire_put_u64(&asked->out, scan);
	return REFUSAL_NONE;
}

/* "Start=1", "Start=1 and 3 more". */
static void tell_items(struct asked *asked, enum order_kind kind, uint32_t count)
{
	struct server *server = asked->server;
	char value[64] = "", text[80];

	if (!count && kind == ORDER_UNFORCE) {
		tell_log(asked, EVENT_UNFORCE, "all", "");
		return;
	}
	if (!count)
		return;
	name_place(server, server->item[0].at);
	if (kind != ORDER_UNFORCE)
		iec_value_print(server->item[0].at.type, server->item[0].value, value,
				sizeof(value));
	snprintf(text, sizeof(text), count > 1 ? "%.30s%s%.24s and %u more" : "%.40s%s%.36s",
		 server->name, *value ? "=" : "", value, (unsigned)count - 1);
	tell_log(asked, kind == ORDER_WRITE ? EVENT_WRITE :
			kind == ORDER_FORCE ? EVENT_FORCE : EVENT_UNFORCE, text, "");
}

static enum refusal serve_change(struct asked *asked, enum order_kind kind)
{
	struct server *server = asked->server;
	const struct expect expect = wire_expect(&asked->frame.body);
	uint32_t count;
	enum refusal refusal;

	if (!can_order(server))
		return REFUSAL_BUSY;
	refusal = take_count(asked, kind == ORDER_WRITE ? REFS_MOST : LIMIT_FORCES, &count);
	if (refusal == REFUSAL_NONE && kind != ORDER_UNFORCE)
		refusal = take_items(asked, count);
	if (refusal == REFUSAL_NONE && kind == ORDER_UNFORCE)
		refusal = take_places(asked, count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (kind == ORDER_WRITE && asked->session->role < ROLE_ENG) {
		if (count) {
			name_place(server, server->item[0].at);
			detail(asked, server->name, strlen(server->name));
		}
		return REFUSAL_EXPORTED;
	}
	for (uint32_t i = 0; i < count && kind == ORDER_UNFORCE; i++)
		server->item[i].at = server->place[i];
	asked->detail[0] = '\0';
	server->order = (struct order){
		.kind = kind, .expects = true, .expect = expect,
		.item = server->item, .count = count,
	};
	refusal = finish_change(asked);
	if (refusal == REFUSAL_NONE)
		tell_items(asked, kind, count);
	return refusal;
}

static enum refusal serve_mode(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	const struct expect expect = wire_expect(in);
	const enum mode_wish wish = (enum mode_wish)wire_u8(in);
	static const char *const word[MODE_COUNT] = { "STOP", "RUN", "RUN, cold", "reset" };
	enum refusal refusal;

	if (!wire_done(in) || wish >= MODE_COUNT)
		return REFUSAL_BAD_FRAME;
	if (wish != MODE_RESET && asked->session->role < ROLE_ENG)
		return refuse_role(asked, ROLE_ENG);
	if (!can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_MODE, .mode = wish,
					.expects = true, .expect = expect };
	refusal = finish_change(asked);
	if (refusal == REFUSAL_NONE)
		tell_log(asked, EVENT_MODE, word[wish], "");
	return refusal;
}

static enum refusal serve_forces(struct asked *asked)
{
	struct server *server = asked->server;
	const enum refusal refusal = learn_forces(server);

	if (refusal != REFUSAL_NONE)
		return refusal;
	begin_answer(asked, 0);
	wire_put_u16(&asked->out, (uint16_t)server->mirror.force_count);
	for (int i = 0; i < server->mirror.force_count; i++) {
		const struct force *force = &server->mirror.force[i];

		name_place(server, force->at);
		wire_put_u32(&asked->out, place_word(server->setup.program, force->at));
		wire_put_string(&asked->out, server->name);
		wire_put_u8(&asked->out, (uint8_t)force->at.type);
		wire_put_value(&asked->out, force->at.type, force->value);
		wire_put_value(&asked->out, force->at.type, force->aside);
	}
	return REFUSAL_NONE;
}

/* Moves the session's cursor to symbol @from. */
static bool seek_symbol(struct asked *asked, uint32_t from, struct symbol *symbol)
{
	struct session *session = asked->session;
	const struct image *image = &asked->server->mirror;

	if (from < session->symbol || from == 0) {
		session->symbols = (struct symbol_cursor){ .whole = false };
		session->symbol = 0;
	}
	for (; session->symbol < from; session->symbol++)
		if (!image_next_symbol(image, &session->symbols, symbol))
			return false;
	return true;
}

/* The rest goes with the next page. */
static enum refusal serve_symbols(struct asked *asked)
{
	struct session *session = asked->session;
	const struct server *server = asked->server;
	const struct program *program = server->setup.program;
	struct wire_writer *out = &asked->out;
	const uint32_t from = wire_u32(&asked->frame.body);
	struct symbol symbol;
	uint16_t count = 0;
	uint8_t *head;
	bool more = true;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!program->string_bytes)
		return REFUSAL_NO_NAMES;
	begin_answer(asked, 0);
	head = out->at;
	wire_put_u32(out, 0);
	wire_put_u16(out, 0);
	more = seek_symbol(asked, from, &symbol);
	while (more && (size_t)(out->end - out->at) > SYMBOL_BYTES && count < UINT16_MAX) {
		char address[40] = "";

		more = image_next_symbol(&server->mirror, &session->symbols, &symbol);
		if (!more)
			break;
		session->symbol++;
		if (symbol.flags & SYMBOL_HIDDEN)
			continue;
		place_address(program, symbol.at, address, sizeof(address));
		wire_put_string(out, symbol.name);
		wire_put_u8(out, (uint8_t)symbol.at.type);
		wire_put_u8(out, (uint8_t)(symbol.flags & (SYMBOL_CONSTANT | SYMBOL_RETAIN)));
		wire_put_u32(out, place_word(program, symbol.at));
		wire_put_string(out, address);
		count++;
	}
	{
		struct wire_writer fill = wire_write(head, 6);

		wire_put_u32(&fill, more ? session->symbol : 0);
		wire_put_u16(&fill, count);
	}
	return REFUSAL_NONE;
}

/* ---- another program ---- */

/* All that sessions have asked to be sent names places of the old program. */
static void end_publications(struct server *server)
{
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		publish_init(&server->session[i].publications);
		server->session[i].symbol = 0;
		server->session[i].changed = true;
	}
}

/* The link's own copy of the image is as large as the program's. */
static void server_renew(struct server *server, const struct program *program)
{
	uint8_t *memory = calloc(1, image_memory_size(program));

	end_publications(server);
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

void server_changed(struct server *server, const struct program *program, const char *why)
{
	server->verified = false; /* beside a program that has gone */
	snprintf(server->why, sizeof(server->why), "%s", why);
	server_renew(server, program);
	learn_forces(server);
}

/* ---- download, upload ---- */

/* Only the session that began it goes on with it; and not while a late order may still take it. */
static enum refusal own_download(const struct asked *asked)
{
	if (!asked->server->setup.store)
		return REFUSAL_NO_STORE;
	if (!can_order(asked->server))
		return REFUSAL_BUSY;
	return asked->server->downloading == asked->session - asked->server->session ?
		       REFUSAL_NONE : REFUSAL_NO_DOWNLOAD;
}

static enum refusal serve_download(struct asked *asked)
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
	if (!can_order(server))
		return REFUSAL_BUSY;
	if (server->downloading >= 0 && own_download(asked) != REFUSAL_NONE)
		return REFUSAL_NO_DOWNLOAD;
	snprintf(asked->detail, sizeof(asked->detail), "%u bytes at most", STORED_MOST);
	if (!stored_size(&wanted))
		return REFUSAL_TOO_MANY;
	asked->detail[0] = '\0';
	refusal = server->setup.store->begin(server->setup.context, wanted.len, sha, &received);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->downloading = (int)(asked->session - server->session);
	server->verified = false;
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, received);
	return REFUSAL_NONE;
}

static enum refusal serve_block(struct asked *asked)
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
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, received);
	return REFUSAL_NONE;
}

static bool is_locked(const struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;

	return setup->password && setup->password->is_set(setup->context) &&
	       !asked->session->unlocked;
}

/* The sums of the blocks of the program that runs. Sums of blocks of many sizes tell its bytes,
 * so they need the password. */
static enum refusal serve_sums(struct asked *asked)
{
	const struct server_store *store = asked->server->setup.store;
	const uint32_t first = wire_u32(&asked->frame.body);
	const uint32_t block = wire_u16(&asked->frame.body);
	const struct stored *stored;
	uint32_t all, count = SUMS_WORK / (block ? block : 1);

	if (!wire_done(&asked->frame.body) || block < SUMS_LEAST || block > SUMS_MOST)
		return REFUSAL_BAD_FRAME;
	if (!store)
		return REFUSAL_NO_STORE;
	if (is_locked(asked))
		return REFUSAL_PASSWORD;
	stored = store->running(asked->server->setup.context);
	all = stored_size(stored) / block;
	if (first > all)
		return REFUSAL_BAD_FRAME;
	if (count > SUMS_PAGE)
		count = SUMS_PAGE;
	if (count > all - first)
		count = all - first;
	begin_answer(asked, 0);
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
static enum refusal serve_pieces(struct asked *asked)
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
		if (kind == PIECE_COPY && is_locked(asked))
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
	begin_answer(asked, 0);
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

static enum refusal serve_verify(struct asked *asked)
{
	struct server *server = asked->server;
	struct losses losses = { .out = &asked->out };
	enum refusal refusal = own_download(asked);
	uint8_t *head;

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = learn_forces(server);
	if (refusal == REFUSAL_NONE)
		refusal = server->setup.store->verify(server->setup.context, &server->standby,
						      asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->verified = true;
	begin_answer(asked, 0);
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
	learn_forces(server); /* if the board is busy, the next view says that they differ */
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
	refusal = give(server);
	kept = settle(server, asked->detail, sizeof(asked->detail));
	return refusal == REFUSAL_NONE ? kept : refusal;
}

static struct order restart(const struct expect *expect, bool stopped)
{
	return (struct order){ .kind = ORDER_RESTART, .expects = true,
			       .mode = stopped ? MODE_STOP : MODE_WARM, .expect = *expect };
}

/* From which identity to which. */
static void tell_download(const struct asked *asked, const struct expect *before)
{
	char from[65], to[65];

	digest_hex(before->program, sizeof(before->program), from);
	digest_hex(asked->server->standby.identity, 32, to);
	tell_log(asked, EVENT_DOWNLOAD, from, to);
}

static enum refusal serve_commit(struct asked *asked)
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
	if (!can_order(server))
		return REFUSAL_BUSY;
	/* Nothing is written for a desk that is stale. */
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status,
					.expects = true, .expect = expect };
	refusal = give(server);
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
			restart(&expect, how == COMMIT_STOPPED);

		refusal = give_program(asked, &order);
	} else {
		store->close_lines(server->setup.context);
	}
	if (refusal == REFUSAL_NONE || refusal == REFUSAL_NOT_KEPT)
		tell_download(asked, &expect);
	if (refusal != REFUSAL_NONE)
		return refusal;
	server->downloading = -1;
	begin_answer(asked, 0);
	wire_put_u64(&asked->out, scan);
	return REFUSAL_NONE;
}

static enum refusal serve_abort(struct asked *asked)
{
	const enum refusal refusal = own_download(asked);

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	asked->server->setup.store->abort(asked->server->setup.context);
	asked->server->downloading = -1;
	begin_answer(asked, 0);
	return REFUSAL_NONE;
}

static enum refusal serve_upload(struct asked *asked)
{
	const struct server_store *store = asked->server->setup.store;
	const uint32_t offset = wire_u32(&asked->frame.body);
	const struct stored *stored;
	uint32_t size, len;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!store)
		return REFUSAL_NO_STORE;
	if (is_locked(asked))
		return REFUSAL_PASSWORD;
	stored = store->running(asked->server->setup.context);
	size = stored_size(stored);
	if (offset > size)
		return REFUSAL_BAD_FRAME;
	len = size - offset < STORED_BLOCK ? size - offset : STORED_BLOCK;
	if (!offset)
		tell_log(asked, EVENT_UPLOAD, "", "");
	begin_answer(asked, 0);
	for (int i = 0; i < STORED_PARTS; i++)
		wire_put_u32(&asked->out, stored->len[i]);
	wire_put_bytes(&asked->out, stored->bytes + offset, len);
	return REFUSAL_NONE;
}

static enum refusal put_settings(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	struct setting setting;
	uint16_t count = 0;
	uint8_t *head;

	begin_answer(asked, 0);
	head = asked->out.at;
	wire_put_u16(&asked->out, 0);
	for (; setup->conf->get(setup->context, count, &setting); count++) {
		wire_put_string(&asked->out, setting.key);
		wire_put_string(&asked->out, setting.now);
		wire_put_string(&asked->out, setting.next);
		wire_put_u8(&asked->out, (uint8_t)(setting.stored | setting.restart << 1));
		wire_put_string(&asked->out, setting.range);
	}
	head[0] = (uint8_t)count;
	return REFUSAL_NONE;
}

static enum refusal change_setting(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	const struct expect expect = wire_expect(in);
	const uint8_t how = wire_u8(in);
	char key[32], value[SETTING_TEXT + 1], told[80];
	struct setting changed;
	enum refusal refusal;

	wire_copy_text(in, key, sizeof(key));
	wire_copy_text(in, value, sizeof(value));
	if (!wire_done(in) || how > 1)
		return REFUSAL_BAD_FRAME;
	if (!can_order(server))
		return REFUSAL_BUSY;
	/* Nothing is written for a desk that is stale. */
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status,
					.expects = true, .expect = expect };
	refusal = give(server);
	if (refusal == REFUSAL_NONE)
		refusal = server->setup.conf->change(server->setup.context, key, value, &changed,
						     asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return refusal;
	snprintf(told, sizeof(told), "%.15s=%.63s", key, value);
	tell_log(asked, EVENT_CONFIG, told, changed.next);
	if (how == 1) {
		server->order = restart(&expect, false);
		refusal = give(server);
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	begin_answer(asked, 0);
	wire_put_u8(&asked->out, changed.restart);
	return REFUSAL_NONE;
}

static enum refusal serve_config(struct asked *asked)
{
	const uint8_t what = wire_u8(&asked->frame.body);

	if (!asked->server->setup.conf)
		return REFUSAL_NO_SERVICE;
	if (what == 0 && wire_done(&asked->frame.body))
		return put_settings(asked);
	return what == 1 ? change_setting(asked) : REFUSAL_BAD_FRAME;
}

/* ---- the program password ---- */

#define PASSWORD_TEXT 129

static void wipe(void *bytes, size_t len)
{
	volatile uint8_t *at = bytes;

	while (len--)
		*at++ = 0;
}

static void take_password(struct wire_reader *in, char *out)
{
	size_t len;
	const char *text = wire_text(in, &len);

	if (len >= PASSWORD_TEXT || memchr(text, 0, len)) {
		in->failed = true;
		len = 0;
	}
	memcpy(out, text, len);
	out[len] = '\0';
}

/* Who guesses is in the log. */
static enum refusal told_wrong(struct asked *asked, enum refusal refusal)
{
	if (refusal == REFUSAL_WRONG)
		tell_log(asked, EVENT_WRONG, "", "");
	return refusal;
}

static enum refusal give_password(struct asked *asked, char *text)
{
	const struct server_setup *setup = &asked->server->setup;
	enum refusal refusal;

	take_password(&asked->frame.body, text);
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = setup->password->check(setup->context, text, asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return told_wrong(asked, refusal);
	asked->session->unlocked = true;
	begin_answer(asked, 0);
	return REFUSAL_NONE;
}

/* Other sessions must give the new one. */
static enum refusal change_password(struct asked *asked, char *old, char *text)
{
	struct server *server = asked->server;
	const struct server_setup *setup = &server->setup;
	const bool was_set = setup->password->is_set(setup->context);
	const struct expect expect = wire_expect(&asked->frame.body);
	enum refusal refusal;

	take_password(&asked->frame.body, old);
	take_password(&asked->frame.body, text);
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status,
					.expects = true, .expect = expect };
	refusal = give(server);
	if (refusal == REFUSAL_NONE)
		refusal = setup->password->change(setup->context, old, text, asked->detail,
						  sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return told_wrong(asked, refusal);
	for (int i = 0; i < SERVER_SESSIONS; i++)
		server->session[i].unlocked = false;
	tell_log(asked, EVENT_PASSWORD, !*text ? "removed" : was_set ? "changed" : "set", "");
	begin_answer(asked, 0);
	return REFUSAL_NONE;
}

static enum refusal serve_password(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	char old[PASSWORD_TEXT], text[PASSWORD_TEXT];
	enum refusal refusal = REFUSAL_BAD_FRAME;
	const uint8_t what = wire_u8(&asked->frame.body);

	if (!setup->password)
		return REFUSAL_NO_SERVICE;
	if (what == 0)
		refusal = give_password(asked, text);
	else if (what == 1 && asked->session->role < ROLE_ENG)
		refusal = refuse_role(asked, ROLE_ENG);
	else if (what == 1)
		refusal = change_password(asked, old, text);
	else if (what == 2 && wire_done(&asked->frame.body)) {
		begin_answer(asked, 0);
		wire_put_u8(&asked->out, setup->password->is_set(setup->context));
		refusal = REFUSAL_NONE;
	}
	wipe(old, sizeof(old));
	wipe(text, sizeof(text));
	return refusal;
}

/* ---- retained values ---- */

/* For the session, and the values as they are between two scans. Memory of an order that is late
 * is not touched. */
static enum refusal begin_retained(struct asked *asked)
{
	struct server *server = asked->server;
	struct retained *retained = &server->retained;
	const int session = (int)(asked->session - server->session);
	enum refusal refusal;

	if (!can_order(server) || (retained->owner >= 0 && retained->owner != session))
		return REFUSAL_BUSY;
	if (!server->setup.program->string_bytes)
		return REFUSAL_NO_NAMES;
	if (!retained_plan(retained, server->setup.program))
		return REFUSAL_MEMORY;
	server->order = (struct order){
		.kind = ORDER_RETAIN, .retain = { &retained->plan, retained->copy, 0 },
	};
	refusal = give(server);
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
	begin_answer(asked, 0);
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
	begin_answer(asked, 0);
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
	begin_answer(asked, 0);
	head = asked->out.at;
	for (int i = 0; i < 3; i++)
		wire_put_u32(&asked->out, 0);
	kept = retained_merge(retained, put_misfit, &misfits);
	if (kept < 0)
		return REFUSAL_NOT_WHOLE;
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
	refusal = give(server);
	if (refusal == REFUSAL_NOT_NOW)
		snprintf(asked->detail, sizeof(asked->detail), "%s",
			 mode_word((uint8_t)server->order.state));
	if (refusal != REFUSAL_NONE)
		return refusal;
	snprintf(number, sizeof(number), "%d", kept);
	tell_log(asked, EVENT_RETAIN, number, "");
	retained->owner = -1;
	return REFUSAL_NONE;
}

static enum refusal serve_retain(struct asked *asked)
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
static enum refusal serve_events(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	const uint32_t from = wire_u32(&asked->frame.body);
	struct event event = { .seq = from };
	uint16_t count = 0;
	uint8_t *head;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	begin_answer(asked, 0);
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

/* ---- record ---- */

static enum refusal serve_log(struct asked *asked, uint64_t from)
{
	struct server *server = asked->server;
	struct recorder_part *part = &server->part;
	enum refusal refusal;

	if (!can_order(server))
		return REFUSAL_BUSY;
	*part = (struct recorder_part){ .from = from, .out = server->part_bytes,
					.room = PART_MOST };
	server->order = (struct order){ .kind = ORDER_RECORD, .part = part };
	refusal = give(server);
	if (refusal != REFUSAL_NONE)
		return refusal;
	begin_answer(asked, 0);
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
		return REFUSAL_NO_RECORD;
	if (is_locked(asked))
		return REFUSAL_PASSWORD;
	if (offset > len)
		return REFUSAL_BAD_FRAME;
	part = len - offset < STORED_BLOCK ? len - offset : STORED_BLOCK;
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, len);
	wire_put_bytes(&asked->out, image + offset, part);
	return REFUSAL_NONE;
}

static enum refusal serve_record(struct asked *asked)
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

/* ---- requests ---- */

static enum refusal serve(struct asked *asked)
{
	switch ((enum service)asked->row->number) {
	case SERVICE_HELLO:
		return serve_hello(asked);
	case SERVICE_STATUS:
		return wire_done(&asked->frame.body) ? serve_status(asked) : REFUSAL_BAD_FRAME;
	case SERVICE_SYMBOLS:
		return serve_symbols(asked);
	case SERVICE_READ:
		return serve_read(asked);
	case SERVICE_PUBLISH:
		return serve_publish(asked);
	case SERVICE_UNPUBLISH:
		return serve_unpublish(asked);
	case SERVICE_WRITE:
		return serve_change(asked, ORDER_WRITE);
	case SERVICE_FORCE:
		return serve_change(asked, ORDER_FORCE);
	case SERVICE_UNFORCE:
		return serve_change(asked, ORDER_UNFORCE);
	case SERVICE_FORCES:
		return wire_done(&asked->frame.body) ? serve_forces(asked) : REFUSAL_BAD_FRAME;
	case SERVICE_MODE:
		return serve_mode(asked);
	case SERVICE_DOWNLOAD:
		return serve_download(asked);
	case SERVICE_BLOCK:
		return serve_block(asked);
	case SERVICE_SUMS:
		return serve_sums(asked);
	case SERVICE_PIECES:
		return serve_pieces(asked);
	case SERVICE_VERIFY:
		return serve_verify(asked);
	case SERVICE_COMMIT:
		return serve_commit(asked);
	case SERVICE_ABORT:
		return serve_abort(asked);
	case SERVICE_UPLOAD:
		return serve_upload(asked);
	case SERVICE_EVENTS:
		return serve_events(asked);
	case SERVICE_CONFIG:
		return serve_config(asked);
	case SERVICE_RETAIN:
		return serve_retain(asked);
	case SERVICE_PASSWORD:
		return serve_password(asked);
	case SERVICE_RECORD:
		return serve_record(asked);
	}
	return REFUSAL_NO_SERVICE;
}

static bool is_change(const struct service_row *row)
{
	return row->number == SERVICE_WRITE || row->number == SERVICE_FORCE ||
	       row->number == SERVICE_UNFORCE || row->number == SERVICE_MODE ||
	       row->number == SERVICE_COMMIT || row->number == SERVICE_CONFIG ||
	       row->number == SERVICE_RETAIN || row->number == SERVICE_PASSWORD;
}

/* Gives the answer of the same request again; it is not done again. */
static bool repeat(struct asked *asked)
{
	struct session *session = asked->session;

	for (int i = 0; i < KEPT; i++) {
		const struct kept *kept = &session->kept[i];

		if (!kept->number || kept->request != asked->frame.request ||
		    kept->service != asked->frame.service ||
		    session->requests - kept->number > KEPT_FOR)
			continue;
		memcpy(session->out, kept->bytes, kept->len);
		session->out_len = kept->len;
		return true;
	}
	return false;
}

static void keep(struct asked *asked)
{
	struct session *session = asked->session;
	struct kept *oldest = &session->kept[0];

	for (int i = 1; i < KEPT; i++)
		if (session->kept[i].number < oldest->number)
			oldest = &session->kept[i];
	if (session->out_len > KEPT_BYTES)
		return;
	oldest->request = asked->frame.request;
	oldest->service = asked->frame.service;
	oldest->number = session->requests;
	oldest->len = session->out_len;
	memcpy(oldest->bytes, session->out, session->out_len);
}

static enum refusal judge(struct asked *asked)
{
	struct session *session = asked->session;

	if (!asked->row)
		return REFUSAL_NO_SERVICE;
	if (!session->greeted && asked->row->number != SERVICE_HELLO)
		return REFUSAL_NO_HELLO;
	if (session->role < asked->row->role)
		return refuse_role(asked, asked->row->role);
	return serve(asked);
}

static void answer(struct server *server, struct session *session, const struct frame *frame)
{
	struct asked asked = { .server = server, .session = session, .frame = *frame,
			       .row = service_row(frame->service) };
	const bool change = asked.row && is_change(asked.row);
	enum refusal refusal;

	session->requests++;
	if (change && repeat(&asked))
		return;
	refusal = judge(&asked);
	if (refusal == REFUSAL_NONE && asked.out.failed)
		refusal = REFUSAL_TOO_MANY;
	/* Once a session: a desk that asks again and again must not fill the log. */
	if (refusal == REFUSAL_ROLE && !session->told_role) {
		tell_log(&asked, EVENT_REFUSED, asked.row->word, "");
		session->told_role = true;
	}
	if (refusal != REFUSAL_NONE)
		refuse(&asked, refusal);
	session->out_len = frame_end(&asked.out);
	if (change)
		keep(&asked);
}

static void give_up(struct session *session)
{
	struct wire_writer out = wire_write(session->out, sizeof(session->out));

	frame_begin(&out, 0, WIRE_ANSWER | WIRE_REFUSED, 0);
	wire_put_u16(&out, REFUSAL_BAD_FRAME);
	wire_put_string(&out, "the length of a frame");
	session->out_len = frame_end(&out);
	session->out_sent = 0;
	session->over = true;
}

/* The next request, if it is whole and the answer before it has gone. */
static bool serve_next(struct server *server, struct session *session)
{
	struct frame frame;
	size_t used;

	if (session->over || session->out_len)
		return false;
	switch (frame_next(session->in, session->in_len, &frame, &used)) {
	case FRAME_PART:
		return false;
	case FRAME_BAD:
		give_up(session);
		return true;
	case FRAME_GOOD:
		break;
	}
	answer(server, session, &frame);
	session->in_len -= used;
	memmove(session->in, session->in + used, session->in_len);
	/* A password must not stay in memory. */
	memset(session->in + session->in_len, 0, used);
	return true;
}

/* The publish requests of the session have ended. */
static void tell_changed(const struct server *server, struct session *session)
{
	struct wire_writer out = wire_write(session->out, sizeof(session->out));

	frame_begin(&out, SERVICE_COMMIT, WIRE_TOLD, 0);
	if (*server->why)
		wire_put_string(&out, server->why);
	session->out_len = frame_end(&out);
	session->changed = false;
}

static void publish_next(struct server *server, struct session *session, int64_t now_ns)
{
	const struct view *view;
	struct wire_writer out;

	if (session->changed && session->greeted && !session->over && !session->out_len) {
		tell_changed(server, session);
		return;
	}
	if (session->over || publish_due(&session->publications) > now_ns)
		return;
	if (session->out_len) {
		publish_lose(&session->publications, now_ns);
		return;
	}
	view = exchange_newest(server->setup.exchange);
	if (view->forces != server->mirror.force_count)
		learn_forces(server);
	server->mirror.memory = view->memory;
	out = wire_write(session->out, sizeof(session->out));
	session->out_len = publish_write(&session->publications, view, &server->mirror, now_ns,
					 &out);
}

bool server_step(struct server *server, int64_t now_ns)
{
	bool more = false;

	server_settle(server);
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct session *session = &server->session[i];

		if (!session->used)
			continue;
		more |= serve_next(server, session);
		publish_next(server, session, now_ns);
	}
	return more;
}

int64_t server_due(const struct server *server)
{
	int64_t due_ns = INT64_MAX;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (session->used && publish_due(&session->publications) < due_ns)
			due_ns = publish_due(&session->publications);
	}
	return due_ns;
}

/* ---- sessions ---- */

/* The oldest session that has no rights or has not said hello; -1: none. So nobody without
 * rights keeps those away who have some. */
static int idle_session(const struct server *server)
{
	int oldest = -1;

	for (int i = 0; i < SERVER_SESSIONS; i++) {
		const struct session *session = &server->session[i];

		if (session->role != ROLE_NONE && session->greeted)
			continue;
		if (oldest < 0 || session->opened < server->session[oldest].opened)
			oldest = i;
	}
	return oldest;
}

int server_open(struct server *server, enum role role, const char *user)
{
	const int gone = server_sessions(server) == SERVER_SESSIONS && role != ROLE_NONE ?
				 idle_session(server) : -1;

	if (gone >= 0)
		server_close(server, gone);
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct session *session = &server->session[i];

		if (session->used)
			continue;
		session->used = true;
		session->greeted = session->over = session->changed = session->told_role = false;
		session->unlocked = false;
		session->role = role;
		session->opened = ++server->opened;
		session->requests = session->symbol = 0;
		session->in_len = session->out_len = session->out_sent = 0;
		memset(session->kept, 0, sizeof(session->kept));
		publish_init(&session->publications);
		snprintf(session->user, sizeof(session->user), "%s", user);
		return i;
	}
	return -1;
}

void server_close(struct server *server, int session)
{
	server->session[session].used = false;
	memset(server->session[session].in, 0, server->session[session].in_len);
	if (server->retained.owner == session)
		server->retained.owner = -1;
	if (server->downloading == session)
		server->downloading = -1; /* what has come stays; it may go on */
	if (publish_due(&server->session[session].publications) != INT64_MAX)
		watch_again(server);
}

int server_sessions(const struct server *server)
{
	int count = 0;

	for (int i = 0; i < SERVER_SESSIONS; i++)
		count += server->session[i].used;
	return count;
}

uint8_t *server_room(struct server *server, int number, size_t *len)
{
	struct session *session = &server->session[number];

	*len = session->over ? 0 : sizeof(session->in) - session->in_len;
	return session->in + session->in_len;
}

void server_got(struct server *server, int session, size_t len)
{
	server->session[session].in_len += len;
}

const uint8_t *server_pending(struct server *server, int number, size_t *len)
{
	const struct session *session = &server->session[number];

	*len = session->out_len - session->out_sent;
	return session->out + session->out_sent;
}

void server_sent(struct server *server, int number, size_t len)
{
	struct session *session = &server->session[number];

	session->out_sent += len;
	if (session->out_sent == session->out_len)
		session->out_len = session->out_sent = 0;
}

bool server_is_over(const struct server *server, int session)
{
	return server->session[session].over && !server->session[session].out_len;
}

/* ---- all of it ---- */

struct server *server_new(const struct server_setup *setup)
{
	struct server *server = calloc(1, sizeof(*server));
	const size_t size = image_memory_size(setup->program);
	bool good;

	if (!server)
		return NULL;
	server->setup = *setup;
	server->downloading = -1;
	retained_init(&server->retained);
	server->mirror.program = setup->program;
	server->look.memory = calloc(1, size);
	server->mirror.memory = server->look.memory;
	for (int i = 0; i < 2; i++)
		server->ranges[i] = calloc(RANGES_MOST, sizeof(struct range));
	good = server->look.memory && server->ranges[0] && server->ranges[1];
	if (good)
		return server;
	server_free(server);
	return NULL;
}

void server_free(struct server *server)
{
	if (!server)
		return;
	retained_free(&server->retained);
	free(server->look.memory);
	free(server->ranges[0]);
	free(server->ranges[1]);
	free(server);
}
