/* SPDX-License-Identifier: MIT
 *
 * test_gateways - what a gateway may do, and what a board takes from one that lies.
 *
 * The points of the map are those of this test; the scan is one call.
 */
#include "online/report.h"
#include "online/server.h"

#include "tests/unit/rig.h"

#include <stdlib.h>
#include <string.h>

/* Points 0 to 3: two inputs and an output of modbus, an input of peer. */
#define POINTS 4
static const struct server_point kinds[POINTS] = {
	{ false, IEC_INT }, { true, IEC_BOOL }, { false, IEC_REAL }, { false, IEC_BOOL },
};

struct bench {
	struct rig rig;
	struct exchange exchange;
	struct exchange_host host;
	struct server *server;
	uint8_t *views;
	union iec_value in[POINTS];
	int puts, alone[GATEWAY_COUNT];
	bool good[POINTS];
	union iec_value out;       /* of point 1                              */
	uint32_t serial, given;
	int told;                  /* events                                  */
	/* The last answer. */
	uint8_t answer[WIRE_FRAME_MOST];
	struct frame frame;
	struct wire_writer ask;
	uint8_t fields[4096];
};

static struct resource *host_resource(void *context)
{
	return &((struct bench *)context)->rig.resource;
}

static const uint8_t *host_identity(void *context)
{
	static const uint8_t none[32];

	(void)context;
	return none;
}

static void host_status(void *context, struct board_status *status)
{
	(void)context;
	memset(status, 0, sizeof(*status));
}

static bool wait_for_scan(void *context)
{
	struct bench *bench = context;

	exchange_serve(&bench->exchange);
	return exchange_is_done(&bench->exchange);
}

static void amend(void *context, struct board_status *status)
{
	(void)context, (void)status;
}

static void log_add(void *context, enum event_id id, uint8_t role, const char *user,
		    const char *one, const char *two)
{
	(void)role, (void)user, (void)one, (void)two;
	((struct bench *)context)->told += id == EVENT_GATEWAY || id == EVENT_GATEWAY_GONE;
}

static bool log_next(void *context, uint32_t seq, struct event *out)
{
	(void)context, (void)seq, (void)out;
	return false;
}

static bool serves(enum gateway_id gateway, uint32_t point)
{
	return point < POINTS && (point == 3) == (gateway == GATEWAY_PEER);
}

static uint32_t points(void *context, enum gateway_id gateway)
{
	(void)context;
	return gateway == GATEWAY_PEER ? 1 : 3;
}

static bool find_point(void *context, enum gateway_id gateway, uint32_t point, struct server_point *out)
{
	(void)context;
	if (!serves(gateway, point))
		return false;
	*out = kinds[point];
	return true;
}

static void put(void *context, uint32_t point, union iec_value value, bool good)
{
	struct bench *bench = context;

	bench->puts++;
	bench->in[point] = value;
	bench->good[point] = good;
}

static bool next_output(void *context, enum gateway_id gateway, struct server_output *out)
{
	struct bench *bench = context;

	if (gateway != GATEWAY_MODBUS || bench->given == bench->serial)
		return false;
	bench->given = bench->serial;
	*out = (struct server_output){ 1, bench->serial, IEC_BOOL, bench->out };
	return true;
}

static uint32_t count_outputs(void *context, enum gateway_id gateway)
{
	(void)context;
	return gateway == GATEWAY_MODBUS;
}

static void again(void *context, enum gateway_id gateway)
{
	(void)gateway;
	((struct bench *)context)->given = 0;
}

static void alone(void *context, enum gateway_id gateway)
{
	((struct bench *)context)->alone[gateway]++;
}

static bool window(void *context, uint32_t number, struct server_window *out)
{
	static const struct server_window windows[] = {
		{ { AREA_M, 16, 0, 2 }, 4, true }, { { AREA_Q, 1, 6, 0 }, 4, false },
		{ { AREA_M, 16, 0, 1u << 20 }, 4, true }, { { AREA_M, 1, 0, 20 }, 8, true },
	};

	(void)context;
	if (number >= sizeof(windows) / sizeof(windows[0]))
		return false;
	*out = windows[number];
	return true;
}

static uint32_t values; /* of the map */

static uint8_t quality(void *context, enum iec_area area, uint32_t bit, uint32_t count, bool io_bad)
{
	(void)context, (void)area, (void)bit, (void)count;
	return io_bad ? VALUE_STALE : 0;
}

static bool find_value(void *context, uint32_t point, struct server_value *out)
{
	*out = (struct server_value){ .addr = { .area = AREA_AI, .bits = 16, .byte = 2 * point }, .counts = point != 1,
				      .flags = point % 3 == 0 ? 0 : point % 3 == 1 ? VALUE_STALE : VALUE_STALE | VALUE_FAULT };
	(void)context;
	return point < values;
}

static bool publishes(void *context, const char *name, size_t len)
{
	(void)context;
	return len == 1 && (*name == 'B' || *name == 'X');
}

static const struct stored *running(void *context)
{
	static const uint8_t bytes[] = "imageBOARD \"b\"";
	static const struct stored stored = { .len = { 5, 9, 0 }, .bytes = bytes };

	(void)context;
	return &stored;
}

static struct server_io io = { NULL, points, find_point, put, next_output, count_outputs, again, alone, window, quality, find_value, publishes };
static const struct server_store store = { .running = running };
static const struct server_log events = { .add = log_add, .next = log_next };
static const char *_Atomic board_name = "bench";

static bool bench_open(struct bench *bench)
{
	const struct program *program;

	memset(bench, 0, sizeof(*bench));
	if (!rig_open(&bench->rig, "PROJECT \"P\"\nVAR\n  A AT %QX0.7 : BOOL := TRUE;\n  B : INT := 7;\n  C : INT;\n"
		      "  W AT %MW8 : WORD;\n  Far AT %MX21.7 : BOOL;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | NO A | COIL A |\nEND_PROGRAM\n", false))
		return false;
	program = ladder_program(bench->rig.ladder);
	io.context = bench;
	bench->views = calloc(3, image_memory_size(program));
	bench->host = (struct exchange_host){
		.context = bench, .resource = host_resource, .identity = host_identity, .status = host_status,
	};
	exchange_init(&bench->exchange, &bench->host, bench->views, image_memory_size(program));
	resource_start(&bench->rig.resource);
	bench->server = server_new(&(struct server_setup){
		.exchange = &bench->exchange, .program = program, .board = &board_name, .log = &events,
		.store = &store, .io = &io, .wait = wait_for_scan, .amend = amend, .context = bench,
	});
	exchange_show(&bench->exchange, 0);
	return CHECK(bench->server != NULL);
}

static void bench_close(struct bench *bench)
{
	server_free(bench->server);
	free(bench->views);
	rig_close(&bench->rig);
}

static struct wire_writer *fields(struct bench *bench)
{
	bench->ask = wire_write(bench->fields, sizeof(bench->fields));
	return &bench->ask;
}

/* Takes what the board has for a session; its bytes. */
static size_t take(struct bench *bench, int session)
{
	size_t len, used;
	const uint8_t *bytes = server_pending(bench->server, session, &len);

	if (!len)
		return 0;
	memcpy(bench->answer, bytes, len);
	CHECK(frame_next(bench->answer, len, &bench->frame, &used) == FRAME_GOOD);
	server_sent(bench->server, session, len);
	return len;
}

/* Sends the fields that the caller has written. */
static enum refusal ask(struct bench *bench, int session, enum service service)
{
	struct wire_writer out;
	size_t size;
	uint8_t *room = server_room(bench->server, session, &size);

	out = wire_write(room, size);
	frame_begin(&out, (uint8_t)service, 0, (uint16_t)service);
	wire_put_bytes(&out, bench->fields, wire_len(&bench->ask));
	server_got(bench->server, session, frame_end(&out));
	bench->exchange.done = 0;
	server_step(bench->server, 1);
	CHECK(take(bench, session) != 0);
	fields(bench);
	return bench->frame.flags & WIRE_REFUSED ? (enum refusal)wire_u16(&bench->frame.body) : REFUSAL_NONE;
}

static int greet(struct bench *bench, enum role role, bool may_io, bool asks_io)
{
	const int session = server_open(bench->server, role, may_io, "user", 1);
	struct wire_writer *out = fields(bench);

	wire_put_u32(out, ONLINE_MAGIC);
	wire_put_u16(out, ONLINE_LOWEST);
	wire_put_u16(out, ONLINE_HIGHEST);
	wire_put_string(out, "test");
	if (asks_io)
		wire_put_u8(out, ROLE_IO);
	CHECK(session >= 0 && ask(bench, session, SERVICE_HELLO) == REFUSAL_NONE);
	wire_u32(&bench->frame.body);
	wire_u16(&bench->frame.body);
	return session;
}

static uint32_t begin(struct bench *bench, int session, const char *driver, enum refusal wanted)
{
	wire_put_string(fields(bench), driver);
	CHECK(ask(bench, session, SERVICE_IO_BEGIN) == wanted);
	return wanted == REFUSAL_NONE ? wire_u32(&bench->frame.body) : 0;
}

static void add_input(struct bench *bench, uint32_t point, uint8_t quality, enum iec_type type, int64_t value)
{
	wire_put_u32(&bench->ask, point);
	wire_put_u8(&bench->ask, quality);
	wire_put_u8(&bench->ask, (uint8_t)type);
	wire_put_value(&bench->ask, type, (union iec_value){ .i = value });
}

static enum refusal put_one(struct bench *bench, int session, uint32_t map, uint32_t point, enum iec_type type,
			    int64_t value)
{
	wire_put_u32(fields(bench), map);
	wire_put_u16(&bench->ask, 1);
	add_input(bench, point, 1, type, value);
	return ask(bench, session, SERVICE_IO_PUT);
}

static void test_roles(struct bench *bench)
{
	static const enum service not_io[] = {
		SERVICE_SYMBOLS, SERVICE_READ, SERVICE_WRITE, SERVICE_FORCE, SERVICE_UNFORCE, SERVICE_FORCES,
		SERVICE_MODE, SERVICE_DOWNLOAD, SERVICE_BLOCK, SERVICE_VERIFY, SERVICE_COMMIT, SERVICE_ABORT,
		SERVICE_UPLOAD, SERVICE_EVENTS, SERVICE_CONFIG, SERVICE_RECORD, SERVICE_SUMS, SERVICE_PIECES,
		SERVICE_RETAIN, SERVICE_PASSWORD, SERVICE_ALARMS, SERVICE_ACK, SERVICE_TIME,
	};
	static const enum service of_io[] = {
		SERVICE_IO_BEGIN, SERVICE_IO_MAP, SERVICE_IO_PUT, SERVICE_IO_OUTPUTS, SERVICE_IO_WINDOW,
		SERVICE_IO_REPORT,
	};
	int session;

	session = greet(bench, ROLE_IO, true, false);
	CHECK_AS(wire_u8(&bench->frame.body) == ROLE_IO, "of its group alone");
	for (size_t i = 0; i < sizeof(not_io) / sizeof(not_io[0]); i++)
		CHECK_AS(ask(bench, session, not_io[i]) == REFUSAL_ROLE, "a gateway is no desk");
	CHECK(ask(bench, session, SERVICE_STATUS) == REFUSAL_NONE);
	server_close(bench->server, session);
	for (enum role role = ROLE_NONE; role < ROLE_PERSONS; role++) {
		session = greet(bench, role, false, true);
		CHECK_AS(wire_u8(&bench->frame.body) == role, "who may not gets no role by asking");
		for (size_t i = 0; i < sizeof(of_io) / sizeof(of_io[0]); i++)
			CHECK_AS(ask(bench, session, of_io[i]) == REFUSAL_ROLE, "a desk is no gateway");
		server_close(bench->server, session);
	}
	session = greet(bench, ROLE_ENG, true, true);
	CHECK_AS(wire_u8(&bench->frame.body) == ROLE_IO, "who may both asks");
	CHECK(ask(bench, session, SERVICE_FORCES) == REFUSAL_ROLE);
	server_close(bench->server, session);
}

static void test_one_gateway_a_driver(struct bench *bench)
{
	const int one = greet(bench, ROLE_IO, true, false), two = greet(bench, ROLE_IO, true, false);
	const int told = bench->told;
	int three;

	begin(bench, one, "mqtt", REFUSAL_NO_SERVICE);
	begin(bench, one, "modbus", REFUSAL_NONE);
	begin(bench, one, "modbus", REFUSAL_NONE);
	begin(bench, two, "modbus", REFUSAL_GATEWAY);
	begin(bench, two, "peer", REFUSAL_NONE);
	CHECK(bench->alone[GATEWAY_MODBUS] == 0 && bench->alone[GATEWAY_PEER] == 0);
	server_close(bench->server, one);
	CHECK(bench->alone[GATEWAY_MODBUS] == 1 && bench->alone[GATEWAY_PEER] == 0);
	begin(bench, two, "modbus", REFUSAL_NONE);
	CHECK_AS(bench->alone[GATEWAY_PEER] == 1, "it serves one");
	server_close(bench->server, two);
	CHECK(bench->alone[GATEWAY_MODBUS] == 2);
	CHECK_AS(bench->told == told + 4, "begins and ends are in the log");
	for (int i = 0; i < 20; i++) {
		three = greet(bench, ROLE_IO, true, false);
		begin(bench, three, "peer", REFUSAL_NONE);
		server_close(bench->server, three);
	}
	CHECK_AS(bench->told == told + 4, "not each time within a minute");
}

static void test_the_map(struct bench *bench)
{
	const int session = greet(bench, ROLE_IO, true, false);
	uint32_t map;

	wire_put_u32(fields(bench), 1);
	wire_put_u32(&bench->ask, 0);
	CHECK_AS(ask(bench, session, SERVICE_IO_MAP) == REFUSAL_CONFLICT, "it has not begun");
	map = begin(bench, session, "modbus", REFUSAL_NONE);
	CHECK(wire_u32(&bench->frame.body) == 9 && wire_u32(&bench->frame.body) == 3);
	wire_put_u32(fields(bench), map);
	wire_put_u32(&bench->ask, 2);
	CHECK(ask(bench, session, SERVICE_IO_MAP) == REFUSAL_NONE);
	CHECK(wire_u32(&bench->frame.body) == 9 && wire_left(&bench->frame.body) == 7 &&
	      memcmp(bench->frame.body.at, "ARD \"b\"", 7) == 0);
	wire_put_u32(fields(bench), map);
	wire_put_u32(&bench->ask, 10);
	CHECK(ask(bench, session, SERVICE_IO_MAP) == REFUSAL_BAD_FRAME);
	wire_put_u32(fields(bench), map + 1);
	wire_put_u32(&bench->ask, 0);
	CHECK(ask(bench, session, SERVICE_IO_MAP) == REFUSAL_CONFLICT);
	server_close(bench->server, session);
}

static void test_inputs(struct bench *bench)
{
	const int session = greet(bench, ROLE_IO, true, false);
	const uint32_t map = begin(bench, session, "modbus", REFUSAL_NONE);

	bench->puts = 0;
	CHECK(put_one(bench, session, map, 0, IEC_INT, -5) == REFUSAL_NONE);
	CHECK(bench->puts == 1 && bench->in[0].i == -5 && bench->good[0]);
	CHECK_AS(put_one(bench, session, map, 0, IEC_UINT, 5) == REFUSAL_TYPE, "another type");
	CHECK_AS(put_one(bench, session, map, 1, IEC_BOOL, 1) == REFUSAL_NONE && bench->puts == 2, "an output was written");
	CHECK_AS(put_one(bench, session, map, 3, IEC_BOOL, 1) == REFUSAL_POINT, "of another gateway");
	CHECK_AS(put_one(bench, session, map, 4, IEC_INT, 1) == REFUSAL_POINT, "no point");
	CHECK_AS(put_one(bench, session, map, UINT32_MAX, IEC_INT, 1) == REFUSAL_POINT, "nor this");
	CHECK_AS(put_one(bench, session, map + 1, 0, IEC_INT, 1) == REFUSAL_CONFLICT, "of another map");
	wire_put_u32(fields(bench), map);
	wire_put_u16(&bench->ask, 2);
	add_input(bench, 0, 1, IEC_INT, 6);
	add_input(bench, 2, 0, IEC_INT, 6);
	CHECK(ask(bench, session, SERVICE_IO_PUT) == REFUSAL_TYPE);
	CHECK_AS(bench->puts == 2 && bench->in[0].i == -5, "all or none");
	wire_put_u32(fields(bench), map);
	wire_put_u16(&bench->ask, 2);
	add_input(bench, 0, 2, IEC_INT, 6);
	CHECK_AS(ask(bench, session, SERVICE_IO_PUT) == REFUSAL_BAD_FRAME, "a quality of its own");
	wire_put_u32(fields(bench), map);
	wire_put_u16(&bench->ask, 2);
	add_input(bench, 0, 0, IEC_INT, 6);
	CHECK_AS(ask(bench, session, SERVICE_IO_PUT) == REFUSAL_BAD_FRAME && bench->puts == 2, "one too few");
	wire_put_u32(fields(bench), map);
	wire_put_u16(&bench->ask, 1);
	add_input(bench, 0, 0, IEC_INT, 6);
	CHECK(ask(bench, session, SERVICE_IO_PUT) == REFUSAL_NONE && bench->puts == 3 && !bench->good[0]);
	server_close(bench->server, session);
}

/* The next frame of outputs: how many it has. */
static int outputs(struct bench *bench, int session, uint8_t *mode, uint8_t *held)
{
	server_step(bench->server, 2);
	if (!take(bench, session))
		return -1;
	CHECK(bench->frame.service == SERVICE_IO_OUTPUTS && bench->frame.flags == WIRE_TOLD &&
	      bench->frame.request == SERVICE_IO_OUTPUTS);
	*mode = wire_u8(&bench->frame.body);
	*held = wire_u8(&bench->frame.body);
	return wire_u16(&bench->frame.body);
}

static void test_outputs(struct bench *bench)
{
	const int session = greet(bench, ROLE_IO, true, false);
	const uint32_t map = begin(bench, session, "modbus", REFUSAL_NONE);
	uint8_t mode = 9, held = 9;

	bench->serial = 5;
	bench->out.i = 1;
	CHECK(server_wants(bench->server) == WANTS_NOTHING);
	wire_put_u32(fields(bench), map);
	CHECK(ask(bench, session, SERVICE_IO_OUTPUTS) == REFUSAL_NONE);
	CHECK(server_wants(bench->server) == WANTS_OUTPUTS);
	CHECK(outputs(bench, session, &mode, &held) == 1 && mode == STATE_RUN && held == 0);
	CHECK(wire_u32(&bench->frame.body) == 1 && wire_u32(&bench->frame.body) == 5 &&
	      wire_u8(&bench->frame.body) == IEC_BOOL && wire_u8(&bench->frame.body) == 1);
	CHECK_AS(outputs(bench, session, &mode, &held) == -1, "nothing has changed");
	bench->serial = 7;
	server_step(bench->server, 2);
	bench->serial = 9; /* the frame of 7 waits */
	server_step(bench->server, 2);
	CHECK(take(bench, session) != 0);
	CHECK_AS(outputs(bench, session, &mode, &held) == 1, "then the newest one");
	CHECK(wire_u32(&bench->frame.body) == 1 && wire_u32(&bench->frame.body) == 9);
	resource_stop(&bench->rig.resource);
	exchange_show(&bench->exchange, 0);
	CHECK_AS(outputs(bench, session, &mode, &held) == 0 && mode == STATE_STOP && held == 1, "held");
	server_close(bench->server, session);
	CHECK(server_wants(bench->server) == WANTS_NOTHING);
	resource_start(&bench->rig.resource);
	exchange_show(&bench->exchange, 0);
}

static enum refusal ask_window(struct bench *bench, int session, uint8_t what, uint32_t number, uint32_t first,
			       uint16_t count, const uint8_t *bytes, size_t len)
{
	wire_put_u8(fields(bench), what);
	wire_put_u32(&bench->ask, 1);
	wire_put_u32(&bench->ask, number);
	wire_put_u32(&bench->ask, first);
	wire_put_u16(&bench->ask, count);
	wire_put_bytes(&bench->ask, bytes, len);
	return ask(bench, session, SERVICE_IO_WINDOW);
}

static void test_windows(struct bench *bench)
{
	static const uint8_t two[] = { 0x34, 0x12, 0x78, 0x56 }, bits[] = { 1, 0, 1, 2 };
	const int session = greet(bench, ROLE_IO, true, false);
	const struct image *image = &bench->rig.resource.image;

	begin(bench, session, "modbus", REFUSAL_NONE);
	CHECK(ask_window(bench, session, 1, 0, 2, 2, two, 4) == REFUSAL_NONE);
	CHECK(image_get(image, image_find(image, "W", 1)).i == 0x5678 &&
	      image_get(image, image_find(image, "%MW6", 4)).i == 0x1234);
	CHECK(ask_window(bench, session, 0, 0, 3, 1, NULL, 0) == REFUSAL_NONE);
	wire_u8(&bench->frame.body);
	wire_u64(&bench->frame.body);
	CHECK(wire_u16(&bench->frame.body) == 0x5678 && wire_done(&bench->frame.body));
	CHECK(ask_window(bench, session, 0, 1, 0, 2, NULL, 0) == REFUSAL_NONE);
	wire_u8(&bench->frame.body);
	wire_u64(&bench->frame.body);
	CHECK(wire_u8(&bench->frame.body) == 0 && wire_u8(&bench->frame.body) == 1 && wire_done(&bench->frame.body));
	CHECK_AS(ask_window(bench, session, 1, 1, 0, 1, bits, 1) == REFUSAL_WINDOW, "read-only");
	CHECK_AS(ask_window(bench, session, 0, 0, 4, 1, NULL, 0) == REFUSAL_WINDOW, "behind its end");
	CHECK_AS(ask_window(bench, session, 0, 0, UINT32_MAX, 2, NULL, 0) == REFUSAL_WINDOW, "and round");
	CHECK_AS(ask_window(bench, session, 0, 0, 0, 5, NULL, 0) == REFUSAL_WINDOW, "more than it has");
	CHECK_AS(ask_window(bench, session, 0, 9, 0, 1, NULL, 0) == REFUSAL_WINDOW, "no window");
	CHECK_AS(ask_window(bench, session, 0, 2, 0, 1, NULL, 0) == REFUSAL_WINDOW, "outside of the program");
	CHECK(ask_window(bench, session, 1, 3, 5, 3, bits, 3) == REFUSAL_NONE);
	CHECK(image_get(image, image_find(image, "%MX20.5", 7)).i == 1 &&
	      image_get(image, image_find(image, "%MX20.7", 7)).i == 1);
	CHECK_AS(ask_window(bench, session, 1, 3, 5, 1, bits + 3, 1) == REFUSAL_BAD_FRAME, "no coil");
	CHECK(ask_window(bench, session, 1, 0, 2, 2, two, 3) == REFUSAL_BAD_FRAME);
	CHECK(ask_window(bench, session, 2, 0, 2, 2, two, 4) == REFUSAL_BAD_FRAME);
	server_close(bench->server, session);
}

static enum refusal publish(struct bench *bench, int session, const char *name)
{
	wire_put_u32(fields(bench), 10000);
	wire_put_u8(&bench->ask, 0);
	wire_put_u16(&bench->ask, 1);
	wire_put_name(&bench->ask, name);
	return ask(bench, session, SERVICE_PUBLISH);
}

static void test_published(struct bench *bench)
{
	const int session = greet(bench, ROLE_IO, true, false);

	begin(bench, session, "peer", REFUSAL_NONE);
	CHECK(publish(bench, session, "B") == REFUSAL_NONE);
	CHECK_AS(publish(bench, session, "C") == REFUSAL_PUBLISH, "the map does not publish it");
	CHECK_AS(publish(bench, session, "X") == REFUSAL_NO_NAME, "the program has none");
	wire_put_u32(fields(bench), 10000);
	wire_put_u8(&bench->ask, 0);
	wire_put_u16(&bench->ask, 1);
	wire_put_u8(&bench->ask, REF_PLACE);
	wire_put_u32(&bench->ask, 0);
	CHECK_AS(ask(bench, session, SERVICE_PUBLISH) == REFUSAL_PUBLISH, "a place");
	wire_put_u32(fields(bench), 10000);
	wire_put_u8(&bench->ask, 1);
	wire_put_string(&bench->ask, "Main");
	CHECK_AS(ask(bench, session, SERVICE_PUBLISH) == REFUSAL_ROLE, "cells");
	server_close(bench->server, session);
}

static void test_report(struct bench *bench)
{
	static struct gateway_report report, bad;
	static struct board_status status;
	static struct gateways_status all;
	static struct values_status good;
	const int session = greet(bench, ROLE_IO, true, false);
	const uint32_t map = begin(bench, session, "peer", REFUSAL_NONE);

	report.count = 1;
	report.unit[0] = (struct gateway_unit){ "yard/pump", 5, 2, UINT64_C(1) << 40 };
	snprintf(report.text, sizeof(report.text), "1 bus");
	wire_put_u32(fields(bench), map);
	report_put(&bench->ask, &report);
	CHECK(ask(bench, session, SERVICE_IO_REPORT) == REFUSAL_NONE);
	CHECK(ask(bench, session, SERVICE_STATUS) == REFUSAL_NONE);
	status_take(&bench->frame.body, &status);
	gateways_take(&bench->frame.body, &all);
	values_take(&bench->frame.body, &good);
	CHECK(wire_done(&bench->frame.body) && all.count == 2 && !good.good && !good.count);
	CHECK(strcmp(all.gateway[0].driver, "modbus") == 0 && !all.gateway[0].runs && all.gateway[0].points == 3);
	CHECK(strcmp(all.gateway[1].driver, "peer") == 0 && all.gateway[1].runs && all.gateway[1].points == 1 &&
	      strcmp(all.gateway[1].user, "user") == 0);
	CHECK(strcmp(all.gateway[1].report.text, "1 bus") == 0 && all.gateway[1].report.count == 1 &&
	      memcmp(&all.gateway[1].report.unit[0], &report.unit[0], sizeof(report.unit[0])) == 0);
	bad.count = REPORT_UNITS;
	wire_put_u32(fields(bench), map);
	report_put(&bench->ask, &bad);
	CHECK(ask(bench, session, SERVICE_IO_REPORT) == REFUSAL_NONE);
	wire_put_u32(fields(bench), map);
	wire_put_string(&bench->ask, "many");
	wire_put_u16(&bench->ask, REPORT_UNITS + 1);
	CHECK(ask(bench, session, SERVICE_IO_REPORT) == REFUSAL_BAD_FRAME);
	server_close(bench->server, session);
}

/* Of 301 points all but one count: of three one is stale and one in fault. */
static void test_values(struct bench *bench)
{
	static struct board_status status;
	static struct gateways_status all;
	static struct values_status told;
	const int session = greet(bench, ROLE_VIEW, false, false);

	values = 301;
	fields(bench);
	CHECK(ask(bench, session, SERVICE_STATUS) == REFUSAL_NONE);
	values = 0;
	status_take(&bench->frame.body, &status);
	gateways_take(&bench->frame.body, &all);
	values_take(&bench->frame.body, &told);
	CHECK(wire_done(&bench->frame.body) && told.good == 101 && told.stale == 99 && told.fault == 100);
	CHECK(told.count == VALUES_TOLD && strcmp(told.bad[0].address, "%AIW4") == 0 && strcmp(told.bad[1].address, "%AIW8") == 0);
	CHECK(strcmp(value_quality(told.bad[0].flags), "fault") == 0 && strcmp(value_quality(told.bad[1].flags), "stale") == 0 &&
	      strcmp(value_quality(0), "good") == 0);
	server_close(bench->server, session);
}

int main(void)
{
	static struct bench bench;

	if (bench_open(&bench)) {
		test_roles(&bench);
		test_one_gateway_a_driver(&bench);
		test_the_map(&bench);
		test_inputs(&bench);
		test_outputs(&bench);
		test_windows(&bench);
		test_published(&bench);
		test_report(&bench);
		test_values(&bench);
	}
	bench_close(&bench);
	return tap_done();
}
