/* SPDX-License-Identifier: MIT
 *
 * serve_io - gateways: programs that serve points of the I/O map over a wire or a network.
 *
 * No scan waits for one. What it says of a point is compared with the map before any of it is taken; what it asks for
 * is what the map declares, and nothing else.
 */
#include "online/serve.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

#define WINDOW_MOST  2048u         /* coils or registers of one request       */
#define OUTPUT_BYTES 17            /* of an output in a frame, at most        */
#define TOLD_NS INT64_C(60000000000) /* between two events about one gateway     */

static const struct server_io *io_of(const struct asked *asked)
{
	return asked->server->setup.io;
}

static enum refusal refuse_number(struct asked *asked, enum refusal refusal, const char *what,
				  uint32_t number)
{
	snprintf(asked->detail, sizeof(asked->detail), "%s %u", what, (unsigned)number);
	return refusal;
}

/* ---- begin and end ---- */

static struct session *serving(struct server *server, enum gateway_id id)
{
	for (int i = 0; i < SERVER_SESSIONS; i++) {
		struct session *session = &server->session[i];

		if (session->used && session->gateway.begun && session->gateway.id == id)
			return session;
	}
	return NULL;
}

/* A gateway that begins and ends again and again must not fill the log. */
static void tell(struct server *server, const struct session *session, enum gateway_id id, bool begins)
{
	const struct server_setup *setup = &server->setup;
	const bool rests = server->io_told_ns[id] && server->now_ns - server->io_told_ns[id] < TOLD_NS;

	if (rests && (begins || !server->io_told[id]))
		return;
	server->io_told_ns[id] = server->now_ns;
	server->io_told[id] = begins;
	setup->log->add(setup->context, begins ? EVENT_GATEWAY : EVENT_GATEWAY_GONE,
			(uint8_t)session->role, session->user, gateway_word(id), "");
}

/* Also if another map runs for which the session has not begun yet. */
void io_end(struct server *server, struct session *session)
{
	for (int i = 0; i < GATEWAY_COUNT; i++) {
		if (server->io_session[i] != session->opened)
			continue;
		server->io_session[i] = 0;
		tell(server, session, (enum gateway_id)i, false);
		server->setup.io->alone(server->setup.io->context, (enum gateway_id)i);
	}
	session->gateway = (struct gateway_session){ .begun = false };
}

static uint32_t map_bytes(const struct server *server, const uint8_t **out)
{
	const struct server_setup *setup = &server->setup;
	const struct stored *stored = setup->store ? setup->store->running(setup->context) : NULL;

	*out = stored ? stored_part(stored, STORED_MAP) : NULL;
	return stored ? stored->len[STORED_MAP] : 0;
}

static bool find_gateway(const char *word, size_t len, enum gateway_id *out)
{
	for (int id = 0; id < GATEWAY_COUNT; id++)
		if (ascii_is(gateway_word((enum gateway_id)id), word, len)) {
			*out = (enum gateway_id)id;
			return true;
		}
	return false;
}

/* The same session again, because another map runs: it has never gone. */
static void take_gateway(struct server *server, struct session *session, enum gateway_id id)
{
	const bool again = server->io_session[id] == session->opened;

	if (!again)
		io_end(server, session); /* it may have served others */
	session->gateway = (struct gateway_session){ .begun = true, .id = id };
	server->io_session[id] = session->opened;
	if (again)
		return;
	memset(&server->report[id], 0, sizeof(server->report[id]));
	tell(server, session, id, true);
}

enum refusal serve_io_begin(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	size_t len;
	const char *word = wire_text(in, &len);
	const struct session *other;
	const uint8_t *map;
	enum gateway_id id;

	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	if (!io_of(asked) || !find_gateway(word, len, &id))
		return REFUSAL_NO_SERVICE;
	other = serving(server, id);
	if (other && other != asked->session) {
		asked_detail(asked, gateway_word(id), strlen(gateway_word(id)));
		return REFUSAL_GATEWAY;
	}
	take_gateway(server, asked->session, id);
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, server->map);
	wire_put_u32(&asked->out, map_bytes(server, &map));
	wire_put_u32(&asked->out, io_of(asked)->points(io_of(asked)->context, id));
	return REFUSAL_NONE;
}

/* Reads the number of the map that a gateway knows. */
static enum refusal check_map(struct asked *asked)
{
	const uint32_t map = wire_u32(&asked->frame.body);

	if (asked->frame.body.failed)
		return REFUSAL_BAD_FRAME;
	if (!io_of(asked))
		return REFUSAL_NO_SERVICE;
	return asked->session->gateway.begun && map == asked->server->map ? REFUSAL_NONE :
									     REFUSAL_CONFLICT;
}

enum refusal serve_io_map(struct asked *asked)
{
	const enum refusal refusal = check_map(asked);
	const uint32_t offset = wire_u32(&asked->frame.body);
	const uint8_t *map;
	uint32_t len, part;

	if (refusal != REFUSAL_NONE)
		return refusal;
	len = map_bytes(asked->server, &map);
	if (!wire_done(&asked->frame.body) || offset > len)
		return REFUSAL_BAD_FRAME;
	part = len - offset < STORED_BLOCK ? len - offset : STORED_BLOCK;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, len);
	if (part)
		wire_put_bytes(&asked->out, map + offset, part);
	return REFUSAL_NONE;
}

/* ---- inputs ---- */

struct io_value {
	uint32_t point;
	bool good;
	union iec_value value;
};

/* One value of `io-put`; it fits to its point. */
static enum refusal take_value(struct asked *asked, struct io_value *out)
{
	struct wire_reader *in = &asked->frame.body;
	struct server_point point = { .output = false };
	uint8_t quality, type;

	out->point = wire_u32(in);
	quality = wire_u8(in);
	type = wire_u8(in);
	if (in->failed || quality > 1)
		return REFUSAL_BAD_FRAME;
	if (!io_of(asked)->point(io_of(asked)->context, asked->session->gateway.id, out->point, &point))
		return refuse_number(asked, REFUSAL_POINT, "point", out->point);
	if (type != point.raw)
		return refuse_number(asked, REFUSAL_TYPE, "point", out->point);
	out->good = quality == 1;
	out->value = wire_value(in, point.raw, NULL);
	return in->failed ? REFUSAL_BAD_FRAME : REFUSAL_NONE;
}

/* All of them or none. */
enum refusal serve_io_put(struct asked *asked)
{
	enum refusal refusal = check_map(asked);
	struct wire_reader *in = &asked->frame.body;
	const uint16_t count = wire_u16(in);
	const struct wire_reader values = *in;
	struct io_value value;

	for (uint32_t i = 0; i < count && refusal == REFUSAL_NONE; i++)
		refusal = take_value(asked, &value);
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	*in = values;
	for (uint32_t i = 0; i < count && take_value(asked, &value) == REFUSAL_NONE; i++)
		io_of(asked)->put(io_of(asked)->context, value.point, value.value, value.good);
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

/* ---- outputs ---- */

enum refusal serve_io_outputs(struct asked *asked)
{
	const enum refusal refusal = check_map(asked);
	struct gateway_session *gateway = &asked->session->gateway;

	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	io_of(asked)->again(io_of(asked)->context, gateway->id);
	gateway->outputs = asked->frame.request;
	gateway->told = false;
	gateway->more = true;
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

size_t io_give(struct server *server, struct session *session)
{
	const struct server_setup *setup = &server->setup;
	struct gateway_session *gateway = &session->gateway;
	const int state = atomic_load_explicit(&setup->exchange->state, memory_order_relaxed);
	struct wire_writer out = wire_write(session->out, sizeof(session->out));
	struct server_output output;
	uint16_t count = 0;
	uint8_t *head;

	frame_begin(&out, SERVICE_IO_OUTPUTS, WIRE_TOLD, gateway->outputs);
	wire_put_u8(&out, state < 0 ? STATE_STOP : (uint8_t)state);
	wire_put_u8(&out, state != STATE_RUN);
	head = out.at;
	wire_put_u16(&out, 0);
	gateway->more = true;
	while (gateway->more && out.end - out.at >= OUTPUT_BYTES) {
		gateway->more = setup->io->output(setup->io->context, gateway->id, &output);
		if (!gateway->more)
			break;
		wire_put_u32(&out, output.point);
		wire_put_u32(&out, output.serial);
		wire_put_u8(&out, (uint8_t)output.raw);
		wire_put_value(&out, output.raw, output.value);
		count++;
	}
	if (!count && gateway->told && gateway->state == state)
		return 0;
	gateway->told = true;
	gateway->state = state;
	head[0] = (uint8_t)count;
	head[1] = (uint8_t)(count >> 8);
	return frame_end(&out);
}

/* ---- windows ---- */

struct asked_window {
	uint32_t first;
	uint16_t count;
	struct server_window window;
};

static enum refusal take_window(struct asked *asked, bool writes, struct asked_window *out)
{
	struct wire_reader *in = &asked->frame.body;
	const uint32_t number = wire_u32(in);
	const struct server_window *window = &out->window;

	out->first = wire_u32(in);
	out->count = wire_u16(in);
	if (in->failed || !out->count || out->count > WINDOW_MOST)
		return REFUSAL_BAD_FRAME;
	if (asked->session->gateway.id != GATEWAY_MODBUS ||
	    !io_of(asked)->window(io_of(asked)->context, number, &out->window))
		return refuse_number(asked, REFUSAL_WINDOW, "window", number);
	if (out->first >= window->count || out->count > window->count - out->first ||
	    (writes && !window->writable) || (window->addr.bits != 1 && window->addr.bits != 16))
		return refuse_number(asked, REFUSAL_WINDOW, writes ? "write of window" : "read of window", number);
	return REFUSAL_NONE;
}

/* The place of coil or register @i of a request. */
static struct location place_in(const struct server *server, const struct asked_window *asked, uint32_t i)
{
	struct iec_addr addr = asked->window.addr;
	const uint64_t bit = (addr.byte * UINT64_C(8) + addr.bit) + asked->first + i;
	const uint64_t byte = addr.byte + 2 * ((uint64_t)asked->first + i);

	if (addr.bits == 1) {
		addr.byte = (uint32_t)(bit / 8);
		addr.bit = (uint8_t)(bit % 8);
	} else {
		addr.byte = (uint32_t)byte;
	}
	return image_locate(&server->mirror, addr);
}

/* A map is compared with its program before it runs, so that its windows lie in the areas. */
static enum refusal find_places(struct asked *asked, const struct asked_window *window)
{
	struct server *server = asked->server;

	for (uint32_t i = 0; i < window->count; i++) {
		server->place[i] = place_in(server, window, i);
		if (server->place[i].type == IEC_NONE)
			return refuse_number(asked, REFUSAL_WINDOW, "outside", window->first + i);
	}
	return REFUSAL_NONE;
}

static enum refusal read_window(struct asked *asked)
{
	struct server *server = asked->server;
	struct asked_window window;
	enum refusal refusal = take_window(asked, false, &window);

	if (refusal == REFUSAL_NONE && !wire_done(&asked->frame.body))
		refusal = REFUSAL_BAD_FRAME;
	if (refusal == REFUSAL_NONE)
		refusal = find_places(asked, &window);
	if (refusal == REFUSAL_NONE)
		refusal = serve_look(server, window.count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, (uint8_t)server->look.state);
	wire_put_u64(&asked->out, server->look.scan);
	for (uint32_t i = 0; i < window.count; i++)
		wire_put_value(&asked->out, server->place[i].type,
			       image_get(&server->mirror, server->place[i]));
	return REFUSAL_NONE;
}

static enum refusal write_window(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	struct asked_window window;
	enum refusal refusal = take_window(asked, true, &window);

	if (refusal == REFUSAL_NONE)
		refusal = find_places(asked, &window);
	if (refusal == REFUSAL_NONE && !server_can_order(server))
		refusal = REFUSAL_BUSY;
	if (refusal != REFUSAL_NONE)
		return refusal;
	for (uint32_t i = 0; i < window.count; i++)
		server->item[i] = (struct order_item){
			.at = server->place[i], .value = wire_value(in, server->place[i].type, NULL),
		};
	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	server->order = (struct order){ .kind = ORDER_WRITE, .item = server->item, .count = window.count };
	return asked_finish(asked);
}

enum refusal serve_io_window(struct asked *asked)
{
	const uint8_t what = wire_u8(&asked->frame.body);
	const enum refusal refusal = check_map(asked);

	if (refusal != REFUSAL_NONE)
		return refusal;
	return what == 0 ? read_window(asked) : what == 1 ? write_window(asked) : REFUSAL_BAD_FRAME;
}

/* ---- what others see ---- */

enum refusal serve_io_report(struct asked *asked)
{
	struct server *server = asked->server;
	struct gateway_report *report = &server->report[asked->session->gateway.id];
	const enum refusal refusal = check_map(asked);

	if (refusal != REFUSAL_NONE)
		return refusal;
	report_take(&asked->frame.body, report);
	if (!wire_done(&asked->frame.body)) {
		memset(report, 0, sizeof(*report));
		return REFUSAL_BAD_FRAME;
	}
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

enum refusal io_check_publish(struct asked *asked, struct wire_reader in)
{
	const uint16_t count = wire_u16(&in);

	if (!io_of(asked))
		return REFUSAL_NO_SERVICE;
	for (uint32_t i = 0; i < count; i++) {
		const struct ref ref = wire_ref(&in);

		if (in.failed)
			return REFUSAL_BAD_FRAME;
		asked_detail(asked, ref.name, ref.len);
		if (ref.kind != REF_NAME ||
		    !io_of(asked)->publishes(io_of(asked)->context, ref.name, ref.len))
			return REFUSAL_PUBLISH;
	}
	asked->detail[0] = '\0';
	return REFUSAL_NONE;
}

/* A variable that is an input or output is as good as that point; all others are good. */
static uint8_t quality_of(const struct view *view, const struct program *program, struct location at)
{
	const struct server_io *io = ((const struct server *)view->context)->setup.io;
	const struct areas *areas = &program->areas;

	at = location_whole(at);
	if (!io)
		return view->io_bad ? VALUE_STALE : 0;
	if (at.area != AREA_NONE)
		return io->quality(io->context, at.area, at.where, 1, view->io_bad);
	if (at.constant || at.where >= areas->size)
		return 0;
	at.area = areas_find(areas, at.where);
	return io->quality(io->context, at.area, 8 * (at.where - areas->at[at.area]),
			   8 * iec_type_row(at.type)->size, view->io_bad);
}

/* For a gateway an output is good, whatever its device says. */
static uint8_t quality_of_input(const struct view *view, const struct program *program, struct location at)
{
	const struct location whole = location_whole(at);
	const enum iec_area area = whole.area != AREA_NONE || whole.where >= program->areas.size ?
				   whole.area : areas_find(&program->areas, whole.where);

	return area != AREA_NONE && iec_area_row(area)->access == ACCESS_WRITE ? 0 :
	       quality_of(view, program, at);
}

const struct values_status *io_values(struct server *server)
{
	const struct server_io *io = server->setup.io;
	struct values_status *all = &server->values;
	struct server_value value = { .flags = 0 };

	memset(all, 0, sizeof(*all));
	for (uint32_t i = 0; io && io->value(io->context, i, &value); i++) {
		struct value_status *bad = all->count < VALUES_TOLD ? &all->bad[all->count] : NULL;

		if (!value.counts)
			continue;
		all->good += !value.flags;
		all->stale += value.flags == VALUE_STALE;
		all->fault += value.flags & VALUE_FAULT ? 1 : 0;
		if (!value.flags || !bad)
			continue;
		iec_addr_print(value.addr, bad->address, sizeof(bad->address));
		bad->flags = value.flags;
		all->count++;
	}
	return all;
}

const struct gateways_status *io_status(struct server *server)
{
	const struct server_setup *setup = &server->setup;
	struct gateways_status *all = &server->gateways;

	all->count = 0;
	for (int i = 0; setup->io && i < GATEWAY_COUNT; i++) {
		const enum gateway_id id = (enum gateway_id)i;
		const struct session *session = serving(server, id);
		struct gateway_status *gateway = &all->gateway[all->count];

		gateway->runs = session != NULL;
		gateway->points = setup->io->points(setup->io->context, id);
		memcpy(&gateway->report, &server->report[i], sizeof(gateway->report));
		snprintf(gateway->driver, sizeof(gateway->driver), "%s", gateway_word(id));
		snprintf(gateway->user, sizeof(gateway->user), "%.31s", session ? session->user : "");
		all->count += session || gateway->points;
	}
	return all;
}

struct view server_with_quality(struct server *server, const struct session *session, const struct view *view)
{
	struct view with = *view;

	with.quality = session->role == ROLE_IO ? quality_of_input : quality_of;
	with.context = server;
	return with;
}
