/* SPDX-License-Identifier: MIT
 *
 * test_server - the order in which a commit is stored and runs: whatever is refused, and whenever
 * ladderd is killed, the next start runs what the desk was told.
 *
 * The scan thread and the disk are functions of this test.
 */
#include "online/server.h"

#include "engine/scan/carry.h"
#include "tests/unit/rig.h"

#include <stdlib.h>
#include <string.h>

#define LINES 10000            /* of the board, more than one answer holds */

enum which { OLD, NEW };

/* What happens while the desk waits. */
enum trouble { ALL_GOOD, CHANGES_WHILE_STORED, FULL, NOT_RENAMED, LATE };

struct bench {
	struct rig rig;
	struct exchange exchange;
	struct exchange_host host;
	struct server *server;
	struct arena arena;
	uint8_t *views;
	uint8_t identity[2][32];
	enum which runs;             /* in the scan thread                   */
	enum which starts;           /* the newest slot                      */
	enum trouble trouble;
	enum event_id told[8];         /* the log                              */
	int told_count;
	bool beside;                   /* a program lies beside its slot       */
	bool early;                    /* the next start would have run NEW while OLD ran */
	bool restarts, lines;
	uint8_t answered[1 << 17];     /* the last answer, a frame             */
	size_t answer;                 /* its bytes                            */
};

static struct resource *host_resource(void *context)
{
	return &((struct bench *)context)->rig.resource;
}

static const uint8_t *host_identity(void *context)
{
	struct bench *bench = context;

	return bench->identity[bench->runs];
}

static enum refusal host_mode(void *context, enum mode_wish wish)
{
	(void)context, (void)wish;
	return REFUSAL_NONE;
}

static enum refusal host_swap(void *context, void *other, uint32_t back)
{
	(void)other, (void)back;
	((struct bench *)context)->runs = NEW;
	return REFUSAL_NONE;
}

static void host_restart(void *context, bool stopped)
{
	(void)stopped;
	((struct bench *)context)->restarts = true;
}

static void host_status(void *context, struct board_status *status)
{
	(void)context, (void)status;
}

static bool wait_for_scan(void *context)
{
	struct bench *bench = context;

	bench->early |= bench->starts == NEW && bench->runs == OLD && !bench->restarts;
	if (bench->trouble == LATE && bench->beside)
		return false;
	bench->exchange.done = 0;
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
	struct bench *bench = context;

	(void)role, (void)user, (void)one, (void)two;
	if (bench->told_count < 8)
		bench->told[bench->told_count++] = id;
}

static bool log_next(void *context, uint32_t seq, struct event *out)
{
	(void)context, (void)seq, (void)out;
	return false;
}

static enum refusal begin(void *context, const uint32_t len[STORED_PARTS], const uint8_t sha[32],
			  uint32_t *received)
{
	(void)context, (void)len, (void)sha;
	*received = 0;
	return REFUSAL_NONE;
}

static enum refusal verify(void *context, struct standby_view *out, char *detail, size_t size)
{
	struct bench *bench = context;
	const struct program *program = ladder_program(bench->rig.ladder);

	(void)detail, (void)size;
	*out = (struct standby_view){
		.map = MAP_SAME, .plan = carry_plan_new(program, program, &bench->arena),
	};
	return REFUSAL_NONE;
}

static enum refusal open_lines(void *context, char *detail, size_t size)
{
	(void)detail, (void)size;
	((struct bench *)context)->lines = true;
	return REFUSAL_NONE;
}

static void close_lines(void *context)
{
	((struct bench *)context)->lines = false;
}

/* A disk takes its time: the program may have a FAULT meanwhile. */
static enum refusal store(void *context, char *detail, size_t size)
{
	struct bench *bench = context;

	(void)detail, (void)size;
	if (bench->trouble == FULL)
		return REFUSAL_DISK;
	if (bench->trouble == CHANGES_WHILE_STORED)
		resource_fail(&bench->rig.resource, FAULT_IO);
	bench->beside = true;
	return REFUSAL_NONE;
}

static enum refusal keep(void *context, char *detail, size_t size)
{
	struct bench *bench = context;

	snprintf(detail, size, "the disk has gone");
	if (bench->trouble == NOT_RENAMED)
		return REFUSAL_DISK;
	bench->starts = NEW;
	bench->beside = false;
	return REFUSAL_NONE;
}

static void drop(void *context)
{
	((struct bench *)context)->beside = false;
}

static const struct program *swapped(void *context, bool comes_back)
{
	(void)comes_back;
	return ladder_program(((struct bench *)context)->rig.ladder);
}

static const struct server_store disk = {
	.begin = begin, .verify = verify, .open_lines = open_lines, .close_lines = close_lines,
	.store = store, .keep = keep, .drop = drop, .swapped = swapped,
};
static const char *_Atomic board_name = "bench";
static const struct server_log events = { .add = log_add, .next = log_next };

/* The lines of the board: each has its number as its offset. */
static bool machine_look(void *context, bool anew)
{
	(void)context, (void)anew;
	return true;
}

static bool machine_row(void *context, uint32_t number, struct machine_row *out)
{
	(void)context;
	*out = (struct machine_row){ .driver = "gpio", .device = "gpiochip0", .offset = number };
	return number < LINES;
}

static const struct server_machine machine = { NULL, machine_look, machine_row };

static bool bench_open(struct bench *bench, enum trouble trouble)
{
	const struct program *program;

	memset(bench, 0, sizeof(*bench));
	if (!rig_open(&bench->rig, "PROJECT \"P\"\nVAR\n  A AT %QX0.0 : BOOL;\n  B : INT;\nEND_VAR\n"
		      "PROGRAM Main LD\nRUNG\n  | NO A | COIL A |\nEND_PROGRAM\n", false))
		return false;
	program = ladder_program(bench->rig.ladder);
	bench->trouble = trouble;
	bench->identity[NEW][0] = 1;
	arena_init(&bench->arena);
	bench->views = calloc(3, image_memory_size(program));
	bench->host = (struct exchange_host){
		.context = bench, .resource = host_resource, .identity = host_identity,
		.mode = host_mode, .status = host_status, .swap = host_swap,
		.restart = host_restart,
	};
	exchange_init(&bench->exchange, &bench->host, bench->views, image_memory_size(program));
	resource_start(&bench->rig.resource);
	bench->server = server_new(&(struct server_setup){
		.exchange = &bench->exchange, .program = program, .board = &board_name, .log = &events,
		.store = &disk, .wait = wait_for_scan, .amend = amend, .machine = &machine, .context = bench,
	});
	return bench->server && server_open(bench->server, ROLE_ENG, false, "desk", 1) == 0;
}

static void bench_close(struct bench *bench)
{
	server_free(bench->server);
	free(bench->views);
	arena_free(&bench->arena);
	rig_close(&bench->rig);
}

/* Sends a request; its fields are those that @body has behind the head. The refusal of the
 * answer. */
static enum refusal ask(struct bench *bench, enum service service, const uint8_t *body, size_t len)
{
	struct frame frame = { .flags = 0 };
	struct wire_writer out;
	const uint8_t *answer;
	uint8_t *room;
	size_t size, used;

	room = server_room(bench->server, 0, &size);
	out = wire_write(room, size);
	frame_begin(&out, (uint8_t)service, 0, (uint16_t)service);
	if (len)
		wire_put_bytes(&out, body, len);
	server_got(bench->server, 0, frame_end(&out));
	server_step(bench->server, 0);
	answer = server_pending(bench->server, 0, &size);
	if (!CHECK(frame_next(answer, size, &frame, &used) == FRAME_GOOD))
		return REFUSAL_BAD_FRAME;
	server_sent(bench->server, 0, size);
	bench->answer = size;
	memcpy(bench->answered, answer, size < sizeof(bench->answered) ? size : sizeof(bench->answered));
	return frame.flags & WIRE_REFUSED ? (enum refusal)wire_u16(&frame.body) : REFUSAL_NONE;
}

static void hello(struct bench *bench)
{
	uint8_t body[64];
	struct wire_writer out = wire_write(body, sizeof(body));

	wire_put_u32(&out, ONLINE_MAGIC);
	wire_put_u16(&out, ONLINE_LOWEST);
	wire_put_u16(&out, ONLINE_HIGHEST);
	wire_put_string(&out, "test");
	CHECK(ask(bench, SERVICE_HELLO, body, (size_t)(out.at - body)) == REFUSAL_NONE);
}

static enum refusal commit(struct bench *bench, enum commit_how how)
{
	uint8_t body[64] = { 0 };
	struct wire_writer out;
	const struct expect expect = { .mode = STATE_RUN };

	hello(bench);
	body[0] = 1;
	CHECK(ask(bench, SERVICE_DOWNLOAD, body, 44) == REFUSAL_NONE);
	CHECK(ask(bench, SERVICE_VERIFY, body, 0) == REFUSAL_NONE);
	out = wire_write(body, sizeof(body));
	wire_put_expect(&out, &expect);
	wire_put_u8(&out, (uint8_t)how);
	return ask(bench, SERVICE_COMMIT, body, (size_t)(out.at - body));
}

/* How many symbols a page from number @from has. */
static int symbols_from(struct bench *bench, uint8_t from)
{
	const uint8_t body[4] = { from };
	struct frame frame;
	size_t used;

	if (!CHECK(ask(bench, SERVICE_SYMBOLS, body, sizeof(body)) == REFUSAL_NONE &&
		   bench->answer <= sizeof(bench->answered)) ||
	    !CHECK(frame_next(bench->answered, bench->answer, &frame, &used) == FRAME_GOOD))
		return -1;
	wire_u32(&frame.body);
	return wire_u16(&frame.body);
}

/* A session that never read the first symbols does not go on where another one, or the same one
 * in another program, has ended. */
static void test_symbols_begin_anew(void)
{
	struct bench bench;

	if (bench_open(&bench, ALL_GOOD)) {
		hello(&bench);
		CHECK(symbols_from(&bench, 0) == 2 && symbols_from(&bench, 1) == 1);
		symbols_from(&bench, 0);
		server_close(bench.server, 0);
		CHECK(server_open(bench.server, ROLE_ENG, false, "desk", 1) == 0);
		hello(&bench);
		CHECK_AS(symbols_from(&bench, 1) == 1, "in another session");
		symbols_from(&bench, 0);
		CHECK(commit(&bench, COMMIT_LIVE) == REFUSAL_NONE);
		CHECK_AS(symbols_from(&bench, 1) == 1, "in another program");
	}
	bench_close(&bench);
}

static bool was_told(const struct bench *bench, enum event_id id)
{
	for (int i = 0; i < bench->told_count; i++)
		if (bench->told[i] == id)
			return true;
	return false;
}

static void test_a_commit_is_stored_and_runs(void)
{
	for (enum commit_how how = COMMIT_LIVE; how <= COMMIT_STOPPED; how++) {
		struct bench bench;

		if (bench_open(&bench, ALL_GOOD)) {
			CHECK(commit(&bench, how) == REFUSAL_NONE);
			CHECK(bench.starts == NEW && !bench.beside);
			CHECK(how == COMMIT_LIVE ? bench.runs == NEW : bench.restarts);
			CHECK_AS(!bench.early, "no start runs the new program before the scan does");
		}
		bench_close(&bench);
	}
}

/* The mode changes while the disk writes: the order is refused, and the slot is as it was. */
static void test_a_refused_commit_starts_nothing(void)
{
	for (enum commit_how how = COMMIT_LIVE; how <= COMMIT_STOPPED; how++) {
		struct bench bench;

		if (bench_open(&bench, CHANGES_WHILE_STORED)) {
			CHECK(commit(&bench, how) == REFUSAL_CONFLICT);
			CHECK(bench.runs == OLD && bench.starts == OLD);
			CHECK(!bench.beside && !bench.lines && !bench.restarts && !bench.early);
			CHECK(!was_told(&bench, EVENT_DOWNLOAD));
		}
		bench_close(&bench);
	}
}

static void test_a_full_disk_starts_nothing(void)
{
	struct bench bench;

	if (bench_open(&bench, FULL)) {
		CHECK(commit(&bench, COMMIT_LIVE) == REFUSAL_DISK);
		CHECK(bench.runs == OLD && bench.starts == OLD && !bench.lines);
	}
	bench_close(&bench);
}

/* The program runs, so the desk and the log say that the next start runs another one. */
static void test_a_program_that_cannot_be_kept_is_told(void)
{
	struct bench bench;

	if (bench_open(&bench, NOT_RENAMED)) {
		CHECK(commit(&bench, COMMIT_LIVE) == REFUSAL_NOT_KEPT);
		CHECK(bench.runs == NEW && bench.starts == OLD);
		CHECK(was_told(&bench, EVENT_NOT_KEPT) && was_told(&bench, EVENT_DOWNLOAD));
	}
	bench_close(&bench);
	if (bench_open(&bench, NOT_RENAMED)) {
		CHECK(commit(&bench, COMMIT_RESTART) == REFUSAL_DISK);
		CHECK(bench.starts == OLD && !was_told(&bench, EVENT_DOWNLOAD));
	}
	bench_close(&bench);
}

/* A scan hangs: the desk is told "busy", and the slot is replaced when the order is done. */
static void test_a_late_commit_is_settled_later(void)
{
	for (enum commit_how how = COMMIT_LIVE; how <= COMMIT_RESTART; how++) {
		struct bench bench;

		if (bench_open(&bench, LATE)) {
			CHECK(commit(&bench, how) == REFUSAL_BUSY);
			CHECK(bench.runs == OLD && bench.starts == OLD && bench.beside);
			server_settle(bench.server);
			CHECK(bench.starts == OLD);
			exchange_serve(&bench.exchange);
			server_settle(bench.server);
			CHECK(bench.starts == NEW && !bench.beside);
		}
		bench_close(&bench);
	}
}

/* Lines come in several answers, each of them once and in order. */
static void test_each_line_is_told_once(void)
{
	struct bench bench;
	uint32_t next = 0, told = 0, wrong = 0;
	int answers = 0;

	if (bench_open(&bench, ALL_GOOD)) {
		hello(&bench);
		do {
			uint8_t body[5];
			struct wire_writer out = wire_write(body, sizeof(body));
			struct frame frame;
			struct machine_row row;
			size_t used;

			wire_put_u8(&out, !answers);
			wire_put_u32(&out, next);
			if (!CHECK(ask(&bench, SERVICE_DEVICES, body, sizeof(body)) == REFUSAL_NONE &&
				   bench.answer <= sizeof(bench.answered)) ||
			    !CHECK(frame_next(bench.answered, bench.answer, &frame, &used) == FRAME_GOOD))
				break;
			wrong += wire_u8(&frame.body) != 1;
			next = wire_u32(&frame.body);
			for (int count = wire_u16(&frame.body); count > 0; count--) {
				machine_take(&frame.body, &row);
				wrong += frame.body.failed || row.offset != told++;
			}
		} while (++answers < 100 && next);
		CHECK_AS(told == LINES && wrong == 0, "each line once, in order");
		CHECK_AS(answers > 1 && answers < 100 && next == 0, "in some answers");
	}
	bench_close(&bench);
}

int main(void)
{
	test_symbols_begin_anew();
	test_a_commit_is_stored_and_runs();
	test_a_refused_commit_starts_nothing();
	test_a_full_disk_starts_nothing();
	test_a_program_that_cannot_be_kept_is_told();
	test_a_late_commit_is_settled_later();
	test_each_line_is_told_once();
	return tap_done();
}
