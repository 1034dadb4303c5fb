/* SPDX-License-Identifier: MIT
 *
 * fuzz_link - gives any bytes to a session of a board as a desk would, and the same bytes to
 * the readers of a desk.
 *
 * The first byte says the role; the rest is the stream. A scan runs between the steps. A gateway serves eight
 * points: those of even number are inputs, the last two are those of peer.
 */
#include "engine/ladder.h"
#include "online/desk.h"
#include "online/gateway.h"
#include "online/server.h"
#include "online/sums.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static const char source[] =
	"RUNGBOARD 1\nVAR\n  A : DINT;\n  B : BOOL;\n  T : TON;\n  In AT %IX0.0 : BOOL;\n"
	"  W AT %MW4 : WORD;\n  N : STRING[5];\n  L : ARRAY[1..3] OF REAL;\nEND_VAR\n"
	"VAR RETAIN\n  R : INT;\n  C : CTU;\nEND_VAR\n"
	"VAR CONSTANT\n  K : INT := 7;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO In | TON T PT:=T#1s | COIL B |\nEND_PROGRAM\n";

struct rig {
	struct resource resource;
	void *memory;
	uint8_t *views;
	struct exchange exchange;
	struct exchange_host host;
	struct server *server;
	struct alarms alarms;
	int64_t now_ns;
	uint64_t given[8];     /* of outputs                                  */
	struct server_io io;
	struct server_machine machine;
};

static struct resource *its_resource(void *context)
{
	return &((struct rig *)context)->resource;
}

static const uint8_t *its_identity(void *context)
{
	static const uint8_t none[32];

	(void)context;
	return none;
}

static enum refusal its_mode(void *context, enum mode_wish wish)
{
	struct resource *resource = its_resource(context);

	if (wish == MODE_STOP)
		resource_stop(resource);
	else
		resource_start(resource);
	return REFUSAL_NONE;
}

static void its_restart(void *context, bool stopped)
{
	(void)context, (void)stopped;
}

static enum refusal its_restore(void *context, const struct order_retain *values)
{
	struct rig *rig = context;

	retain_put(values->plan, &rig->resource.image, values->copy);
	return REFUSAL_NONE;
}

static void its_status(void *context, struct board_status *status)
{
	(void)context;
	memset(status, 0, sizeof(*status));
}

static void amend(void *context, struct board_status *status)
{
	(void)context, (void)status;
}

static void log_nothing(void *context, enum event_id id, uint8_t role, const char *user,
			const char *one, const char *two)
{
	(void)context, (void)role, (void)two;
	fuzz_expect(event_text((uint8_t)id) && strlen(user) < 64 && strlen(one) < 200, "an event");
}

static bool no_event(void *context, uint32_t seq, struct event *out)
{
	(void)context, (void)seq, (void)out;
	return false;
}

/* A board with a program of 300 bytes that takes any download. */
static enum refusal begin_any(void *context, const uint32_t len[STORED_PARTS],
			      const uint8_t sha[32], uint32_t *received)
{
	(void)context, (void)len, (void)sha;
	*received = 0;
	return REFUSAL_NONE;
}

static enum refusal take_any(void *context, uint32_t offset, const uint8_t *bytes, size_t len,
			     uint32_t *received)
{
	uint8_t sum = 0;

	(void)context;
	for (size_t i = 0; i < len; i++)
		sum = (uint8_t)(sum + bytes[i]); /* each byte can be read */
	*received = offset + (uint32_t)len;
	return sum == 255 ? REFUSAL_NOT_WHOLE : REFUSAL_NONE;
}

static enum refusal verify_none(void *context, struct standby_view *out, char *text, size_t size)
{
	(void)context, (void)out, (void)text, (void)size;
	return REFUSAL_NOT_WHOLE;
}

static enum refusal store_none(void *context, char *text, size_t size)
{
	(void)context, (void)text, (void)size;
	return REFUSAL_DISK;
}

static void abort_any(void *context)
{
	(void)context;
}

static const struct stored *runs_any(void *context)
{
	static uint8_t bytes[300];
	static const struct stored stored = { .len = { 200, 90, 10 }, .bytes = bytes };

	(void)context;
	return &stored;
}

#define POINTS 8u
static const enum iec_type raws[POINTS] = {
	IEC_BOOL, IEC_BOOL, IEC_UINT, IEC_UINT, IEC_REAL, IEC_DINT, IEC_BOOL, IEC_BOOL,
};

static uint32_t count_points(void *context, enum gateway_id gateway)
{
	(void)context;
	return gateway == GATEWAY_PEER ? 2 : POINTS - 2;
}

static bool find_point(void *context, enum gateway_id gateway, uint32_t point, struct server_point *out)
{
	(void)context;
	if (point >= POINTS || (point >= POINTS - 2) != (gateway == GATEWAY_PEER))
		return false;
	*out = (struct server_point){ .output = point & 1, .raw = raws[point] };
	return true;
}

static void put_point(void *context, uint32_t point, union iec_value value, bool good)
{
	(void)context, (void)good;
	fuzz_expect(point < POINTS, "a point of the map is put");
	fuzz_expect(raws[point] != IEC_BOOL || value.i == 0 || value.i == 1, "a BOOL is 0 or 1");
	fuzz_expect(raws[point] != IEC_UINT || (value.i >= 0 && value.i <= UINT16_MAX), "its type holds the value");
}

static bool next_output(void *context, enum gateway_id gateway, struct server_output *out)
{
	struct rig *rig = context;
	const uint32_t first = gateway == GATEWAY_PEER ? POINTS - 1 : 1, end = gateway == GATEWAY_PEER ? POINTS : POINTS - 2;

	for (uint32_t i = first; i < end; i += 2) {
		if (rig->given[i] == rig->exchange.view[0].scan + 1)
			continue;
		rig->given[i] = rig->exchange.view[0].scan + 1;
		*out = (struct server_output){ .point = i, .serial = (uint32_t)rig->given[i], .raw = raws[i] };
		return true;
	}
	return false;
}

static uint32_t count_outputs(void *context, enum gateway_id gateway)
{
	(void)context;
	return gateway == GATEWAY_PEER ? 1 : 3;
}

static void give_again(void *context, enum gateway_id gateway)
{
	(void)gateway;
	memset(((struct rig *)context)->given, 0, sizeof(((struct rig *)context)->given));
}

static void be_alone(void *context, enum gateway_id gateway)
{
	(void)context;
	fuzz_expect(gateway < GATEWAY_COUNT, "a gateway");
}

static bool find_window(void *context, uint32_t number, struct server_window *out)
{
	(void)context;
	*out = (struct server_window){ .addr = { .area = AREA_M, .bits = number & 1 ? 1 : 16 }, .count = number & 2 ? 5 : 1u << 30,
				       .writable = number & 4 };
	return number < 8;
}

static uint8_t any_quality(void *context, enum iec_area area, uint32_t bit, uint32_t count, bool io_bad)
{
	(void)context, (void)count;
	fuzz_expect(area > AREA_NONE && area < AREA_COUNT, "an area");
	return io_bad ? VALUE_STALE : bit % 3 == 2 ? VALUE_STALE | VALUE_FAULT : 0;
}

static bool find_value(void *context, uint32_t point, struct server_value *out)
{
	(void)context;
	*out = (struct server_value){ .addr = { .area = AREA_I, .bits = 8, .byte = point }, .counts = true,
				      .flags = point % 2 ? VALUE_STALE : 0 };
	return point < 200;
}

static bool is_published(void *context, const char *name, size_t len)
{
	(void)context;
	return len && (*name == 'A' || *name == 'N');
}

static int64_t no_clock(void)
{
	return 1;
}

static bool get_setting(void *context, uint32_t number, struct setting *out)
{
	(void)context;
	*out = (struct setting){ .key = "period", .now = "10ms", .range = "any" };
	return number < 2;
}

static enum refusal change_setting(void *context, const char *key, const char *value,
				   struct setting *changed, char *detail, size_t size)
{
	(void)context, (void)detail, (void)size;
	*changed = (struct setting){ .key = "period" };
	fuzz_expect(strlen(key) < 32 && strlen(value) <= SETTING_TEXT, "a setting");
	return *value ? REFUSAL_NONE : REFUSAL_RANGE;
}

static bool is_set(void *context)
{
	(void)context;
	return true;
}

static enum refusal check_password(void *context, uint32_t who, const char *text, char *detail,
				   size_t size)
{
	(void)context, (void)who, (void)detail, (void)size;
	fuzz_expect(strlen(text) < 257, "a password");
	return *text == 'p' ? REFUSAL_NONE : REFUSAL_WRONG;
}

static enum refusal change_password(void *context, uint32_t who, const char *old,
				    const char *text, char *detail, size_t size)
{
	fuzz_expect(strlen(text) < 257, "a new password");
	return check_password(context, who, old, detail, size);
}

static bool serve_now(void *context)
{
	struct rig *rig = context;

	exchange_serve(&rig->exchange);
	return exchange_is_done(&rig->exchange);
}

static void read_clock(void *context, int64_t at_ns, struct board_time *out)
{
	(void)context;
	*out = (struct board_time){ .time_ns = at_ns, .zone = "CEST" };
}

static enum refusal set_clock(void *context, int64_t time_ns)
{
	(void)context, (void)time_ns;
	return REFUSAL_NONE;
}

/* Built once: a rig only reads it. */
static const struct program *its_program(void)
{
	static struct ladder *ladder;

	if (ladder)
		return ladder_program(ladder);
	ladder = ladder_new();
	fuzz_expect(ladder != NULL, "there is memory");
	ladder_watch(ladder, true);
	fuzz_expect(ladder_load_text(ladder, "r", source, sizeof(source) - 1) && ladder_build(ladder),
		    "the program builds");
	return ladder_program(ladder);
}

static bool looks(void *context, bool anew)
{
	(void)context;
	return !anew;
}

static bool find_machine(void *context, uint32_t number, struct machine_row *out)
{
	(void)context;
	memset(out, 0, sizeof(*out));
	memcpy(out->driver, "gpio", 5);
	memset(out->device, 'x', sizeof(out->device) - 1);
	out->offset = number;
	return number < 300;
}

static void rig_open(struct rig *rig)
{
	static const struct server_log log = { log_nothing, no_event };
	static const struct server_store store = {
		.begin = begin_any, .block = take_any, .verify = verify_none,
		.open_lines = store_none, .close_lines = abort_any, .store = store_none, .keep = store_none, .drop = abort_any, .abort = abort_any, .running = runs_any,
	};
	static const struct server_password password = { is_set, check_password, change_password };
	static const struct server_clock clock = { read_clock, set_clock };
	const struct server_io io = {
		rig, count_points, find_point, put_point, next_output, count_outputs, give_again, be_alone, find_window, any_quality, find_value, is_published,
	};
	static const struct server_conf conf = { get_setting, change_setting };
	static const char *_Atomic board_name = "b";
	struct server_setup setup = { .keeps = true, .password = &password, .conf = &conf, .log = &log, .store = &store, .board = &board_name, .wait = serve_now, .amend = amend,
				      .context = rig, .exchange = &rig->exchange, .alarms = &rig->alarms, .clock = &clock, .io = &rig->io,
				      .machine = &rig->machine };

	size_t size;

	memset(rig, 0, sizeof(*rig));
	rig->io = io;
	rig->machine = (struct server_machine){ rig, looks, find_machine };
	rig->alarms.clock_ns = no_clock;
	alarm_list_raise(&rig->alarms.list, ALARM_IO, true, 1);
	setup.program = its_program();
	size = image_memory_size(setup.program);
	rig->memory = calloc(1, size);
	rig->views = calloc(3, size);
	resource_init(&rig->resource, setup.program, rig->memory);
	resource_start(&rig->resource);
	rig->host = (struct exchange_host){ .context = rig, .resource = its_resource,
					    .identity = its_identity, .mode = its_mode,
					    .status = its_status, .restart = its_restart,
					    .restore = its_restore };
	exchange_init(&rig->exchange, &rig->host, rig->views, size);
	rig->server = server_new(&setup);
	fuzz_expect(rig->server != NULL, "there is memory");
}

static void rig_close(struct rig *rig)
{
	server_free(rig->server);
	free(rig->memory);
	free(rig->views);
}

/* What the board sends is whole frames. */
static void take_out(struct rig *rig, int session)
{
	size_t len, used;
	const uint8_t *bytes = server_pending(rig->server, session, &len);
	struct frame frame;

	if (!len)
		return;
	fuzz_expect(frame_next(bytes, len, &frame, &used) == FRAME_GOOD && used == len,
		    "an answer is one whole frame");
	fuzz_expect(frame.flags == WIRE_ANSWER || frame.flags == (WIRE_ANSWER | WIRE_REFUSED) ||
		    frame.flags == WIRE_TOLD, "its flags are known");
	if (frame.flags & WIRE_REFUSED)
		fuzz_expect(refusal_diag(wire_u16(&frame.body)) != DIAG_LINK_REFUSED,
			    "its refusal is known");
	server_sent(rig->server, session, len);
}

static void scan(struct rig *rig)
{
	rig->now_ns += 10000000;
	resource_scan(&rig->resource, rig->now_ns);
	exchange_show(&rig->exchange, rig->now_ns);
}

static void as_board(struct rig *rig, const uint8_t *bytes, size_t len)
{
	const int session = server_open(rig->server, (enum role)(bytes[0] % ROLE_COUNT), bytes[0] & 64, "fuzz", 0);
	size_t at = 1;

	while (at < len && !server_is_over(rig->server, session)) {
		size_t room;
		uint8_t *to = server_room(rig->server, session, &room);

		if (room > len - at)
			room = len - at;
		memcpy(to, bytes + at, room);
		server_got(rig->server, session, room);
		at += room;
		while (server_step(rig->server, rig->now_ns))
			take_out(rig, session);
		take_out(rig, session);
		scan(rig);
		server_step(rig->server, rig->now_ns);
		take_out(rig, session);
		if (!room)
			break;
	}
	server_close(rig->server, session);
	fuzz_expect(rig->resource.image.force_count <= LIMIT_FORCES, "forces are bounded");
	fuzz_expect(image_get(&rig->resource.image,
			      image_find(&rig->resource.image, "K", 1)).i == 7,
		    "a constant stays");
	fuzz_expect(image_get(&rig->resource.image,
			      image_find(&rig->resource.image, "N", 1)).s->length <= 5,
		    "a text is in its room");
}

static void take_output(void *context, uint32_t point, enum iec_type type, union iec_value value)
{
	(void)context, (void)point, (void)value;
	fuzz_expect(type > IEC_NONE && type < IEC_TYPE_COUNT && type != IEC_STRING, "the type of an output");
}

static void take_published(void *context, uint32_t which, enum iec_type type, union iec_value value, bool good)
{
	(void)context, (void)good;
	fuzz_expect(which < 2, "a variable that it asked for");
	fuzz_expect(type != IEC_STRING || value.s->length <= IEC_STRING_MOST, "a text is in its room");
}

/* A gateway that has asked for two variables, and for outputs. */
static void as_gateway(const struct frame *frame)
{
	static enum iec_type types[] = { IEC_INT, IEC_STRING };
	static struct gateway gateway;

	gateway.output = take_output;
	gateway.published = take_published;
	gateway.type = types;
	gateway.published_count = 2;
	gateway.outputs = gateway.publish = frame->request;
	gateway.changed = false;
	gateway_told(&gateway, frame);
}

/* A desk reads what a board says. */
static void as_desk(const uint8_t *bytes, size_t len)
{
	static struct board_status status;
	static struct gateways_status gateways;
	struct wire_reader in;
	struct slot slot;
	struct frame frame;
	size_t used;

	if (slot_open(bytes, len, &slot))
		fuzz_expect(stored_part(&slot.stored, STORED_SOURCES) +
			    slot.stored.len[STORED_SOURCES] + 4 == bytes + len,
			    "the parts fill a slot");
	while (frame_next(bytes, len, &frame, &used) == FRAME_GOOD) {
		struct iec_text text;
		struct alarm_row row;
		uint32_t version;
		bool empty;

		as_gateway(&frame);
		in = frame.body;
		gateways_take(&in, &gateways);
		in = frame.body;
		status_take(&in, &status);
		in = frame.body;
		while (!in.failed && wire_left(&in))
			wire_value(&in, (enum iec_type)wire_u8(&in), &text);
		in = frame.body;
		while (!in.failed && wire_left(&in))
			wire_ref(&in);
		in = frame.body;
		alarm_read(&in, &row);
		if (frame.body.end - frame.body.at >= (ptrdiff_t)ALARM_BYTES &&
		    alarm_open(frame.body.at, &row, &version, &empty))
			fuzz_expect(row.number && !empty, "a row has a number");
		bytes += used;
		len -= used;
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct rig rig;

	if (!len)
		return 0;
	rig_open(&rig);
	as_board(&rig, bytes, len);
	as_desk(bytes + 1, len - 1);
	rig_close(&rig);
	return 0;
}

static void add_name(struct wire_writer *out, const char *name)
{
	wire_put_u8(out, REF_NAME);
	wire_put_string(out, name);
}

static void add_names(struct wire_writer *out, uint8_t service, const struct expect *expect)
{
	if (service == SERVICE_UNFORCE)
		wire_put_expect(out, expect);
	if (service == SERVICE_PUBLISH) {
		wire_put_u32(out, 10000);
		wire_put_u8(out, 0);
	}
	wire_put_u16(out, 2);
	add_name(out, "A");
	add_name(out, "T.ET");
}

/* Lengths and a hash. */
static void add_download(struct wire_writer *out)
{
	for (uint32_t i = 0; i < STORED_PARTS + 8u; i++)
		wire_put_u32(out, 1);
}

static void add_pieces(struct wire_writer *out)
{
	wire_put_u32(out, 0);
	wire_put_u8(out, PIECE_COPY);
	wire_put_u32(out, 1);
	wire_put_u32(out, 2);
	wire_put_u8(out, PIECE_BYTES);
	wire_put_u16(out, 1);
	wire_put_u8(out, 0);
}

static void add_hello(struct wire_writer *out)
{
	wire_put_u32(out, ONLINE_MAGIC);
	wire_put_u16(out, 1);
	wire_put_u16(out, 1);
	wire_put_string(out, "fuzz");
}

static void add_setting(struct wire_writer *out, const struct expect *expect)
{
	wire_put_u8(out, 1);
	wire_put_expect(out, expect);
	wire_put_u8(out, 0);
	wire_put_string(out, "period");
	wire_put_string(out, "5ms");
}

/* Of a gateway that has begun with map 1. */
static void put_io(struct wire_writer *out, enum service service)
{
	if (service == SERVICE_IO_BEGIN) {
		wire_put_string(out, "modbus");
		return;
	}
	if (service == SERVICE_IO_WINDOW || service == SERVICE_DEVICES)
		wire_put_u8(out, 1);
	wire_put_u32(out, 1);
	if (service == SERVICE_IO_MAP)
		wire_put_u32(out, 0);
	if (service == SERVICE_IO_PUT) {
		wire_put_u16(out, 1);
		wire_put_u32(out, 2);
		wire_put_u8(out, 1);
		wire_put_u8(out, IEC_UINT);
		wire_put_u16(out, 9);
	}
	if (service == SERVICE_IO_WINDOW) {
		wire_put_u32(out, 4);
		wire_put_u32(out, 2);
		wire_put_u16(out, 1);
		wire_put_u16(out, 5);
	}
	if (service == SERVICE_DEVICES) {
		wire_put_u8(out, 0);
		wire_put_u32(out, 3);
	}
	if (service == SERVICE_IO_REPORT) {
		wire_put_string(out, "1 bus");
		wire_put_u16(out, 1);
		wire_put_string(out, "rs485/1");
		for (int i = 0; i < 3; i++)
			wire_put_u64(out, 1);
	}
}

static void put_fields(struct wire_writer *out, enum service service)
{
	const struct expect expect = { .mode = EXPECT_ANY };

	switch (service) {
	case SERVICE_HELLO:
		add_hello(out);
		break;
	case SERVICE_READ:
	case SERVICE_UNFORCE:
	case SERVICE_PUBLISH:
		add_names(out, (uint8_t)service, &expect);
		break;
	case SERVICE_WRITE:
	case SERVICE_FORCE:
		wire_put_expect(out, &expect);
		wire_put_u16(out, 1);
		add_name(out, "A");
		wire_put_u8(out, IEC_DINT);
		wire_put_value(out, IEC_DINT, (union iec_value){ .i = 5 });
		break;
	case SERVICE_UNPUBLISH:
		wire_put_u16(out, 5);
		break;
	case SERVICE_MODE:
		wire_put_expect(out, &expect);
		wire_put_u8(out, MODE_STOP);
		break;
	case SERVICE_DOWNLOAD:
		add_download(out);
		break;
	case SERVICE_COMMIT:
		wire_put_expect(out, &expect);
		wire_put_u8(out, 0);
		break;
	case SERVICE_SUMS:
		wire_put_u32(out, 0);
		wire_put_u16(out, SUMS_LEAST);
		break;
	case SERVICE_PIECES:
		add_pieces(out);
		break;
	case SERVICE_SYMBOLS:
	case SERVICE_BLOCK:
	case SERVICE_UPLOAD:
	case SERVICE_EVENTS:
	case SERVICE_ALARMS:
	case SERVICE_ACK:
		wire_put_u32(out, 0);
		break;
	case SERVICE_CONFIG:
		add_setting(out, &expect);
		break;
	case SERVICE_RETAIN:
	case SERVICE_TIME:
		wire_put_u8(out, 0);
		service == SERVICE_TIME ? wire_put_i64(out, 0) : wire_put_u32(out, 0);
		break;
	case SERVICE_RECORD:
		wire_put_u8(out, 0);
		wire_put_u64(out, 0);
		break;
	case SERVICE_PASSWORD:
		wire_put_u8(out, 0);
		wire_put_string(out, "p");
		break;
	case SERVICE_STATUS:
	case SERVICE_FORCES:
	case SERVICE_VERIFY:
	case SERVICE_ABORT:
		break;
	case SERVICE_IO_BEGIN:
	case SERVICE_IO_MAP:
	case SERVICE_IO_OUTPUTS:
	case SERVICE_IO_PUT:
	case SERVICE_IO_WINDOW:
	case SERVICE_IO_REPORT:
	case SERVICE_DEVICES:
		put_io(out, service);
		break;
	}
}

/* A session that asks for everything once: a desk, or a gateway. */
uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	static const uint8_t of_gateway[] = { SERVICE_HELLO, SERVICE_STATUS, SERVICE_IO_BEGIN, SERVICE_IO_MAP, SERVICE_IO_OUTPUTS,
		SERVICE_IO_PUT, SERVICE_IO_WINDOW, SERVICE_PUBLISH, SERVICE_IO_REPORT, SERVICE_STATUS };
	static const uint8_t of_desk[] = { SERVICE_HELLO, SERVICE_STATUS, SERVICE_SYMBOLS,
		SERVICE_READ, SERVICE_PUBLISH, SERVICE_WRITE, SERVICE_FORCE, SERVICE_FORCES,
		SERVICE_UNFORCE, SERVICE_UNPUBLISH, SERVICE_DOWNLOAD, SERVICE_BLOCK,
		SERVICE_SUMS, SERVICE_PIECES, SERVICE_VERIFY, SERVICE_COMMIT, SERVICE_ABORT,
		SERVICE_UPLOAD, SERVICE_EVENTS, SERVICE_CONFIG, SERVICE_RETAIN, SERVICE_PASSWORD, SERVICE_RECORD, SERVICE_MODE };
	const bool gateway = len && bytes[0] == 'g';
	const uint8_t *services = gateway ? of_gateway : of_desk;
	const size_t count = gateway ? sizeof(of_gateway) : sizeof(of_desk);
	uint8_t *seed = malloc(4096);
	size_t at = 1;

	if (!seed)
		return NULL;
	seed[0] = gateway ? ROLE_IO : ROLE_ENG;
	for (size_t i = 0; i < count; i++) {
		struct wire_writer out = wire_write(seed + at, 4096 - at);

		frame_begin(&out, services[i], 0, (uint16_t)(i + 1));
		put_fields(&out, (enum service)services[i]);
		at += frame_end(&out);
	}
	*out_len = at;
	return seed;
}
