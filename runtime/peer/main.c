/* SPDX-License-Identifier: MIT
 *
 * main - ladder-peer: sends variables of this board to others, and gives values of others to points of its map.
 *
 * A gateway of ladderd (online/gateway.h): it reads the map from there, and reaches nothing but what the map names. One
 * loop and no thread. Without PUBLISH and `peer` lines it opens no socket of the network.
 */
#include "online/gateway.h"
#include "peer/bus.h"
#include "peer/inbox.h"
#include "peer/outbox.h"

#include "engine/base/version.h"
#include "hal/clock.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

#define SECOND     INT64_C(1000000000)
#define AGAIN_MS   500         /* between two attempts to reach ladderd        */
#define ALIVE_NS   (SECOND / 50) /* what ladderd has said is no older when it is sent */
#define AT_ONCE    256         /* datagrams of one bus before ladderd is heard again */

struct peer {
	const char *socket;
	struct gateway gateway;
	struct arena arena;    /* of the map                                  */
	struct diag_list diags;
	struct iomap map;
	struct inbox inbox;
	struct outbox outbox;
	struct bus bus[IO_BUSES]; /* by their numbers in the map; of others fd is -1 and interface NULL */
	int bus_count;
	int told[IO_BUSES];    /* the error that was reported                 */
	int away;              /* … about ladderd: enum desk_end              */
	uint64_t run;
	int64_t keep_ns, heard_ns;
	struct gateway_report report;
	struct peer_writer out;
	uint8_t in[PEER_BYTES + 1];
};

static volatile sig_atomic_t stop;

static void want_stop(int number)
{
	(void)number;
	stop = 1;
}

/* ---- from ladderd ---- */

/* Only so that it tells the mode; the map has no outputs to other boards. */
static void take_output(void *context, uint32_t point, enum iec_type type, union iec_value value)
{
	(void)context, (void)point, (void)type, (void)value;
}

static void take_published(void *context, uint32_t which, enum iec_type type, union iec_value value, bool good)
{
	struct peer *peer = context;
	struct outbox_value *out = &peer->outbox.value[which];

	if (type == IEC_STRING)
		return;
	out->known = true;
	out->good = good;
	out->type = type;
	out->value = value;
}

static uint32_t shortest_us(const struct outbox *outbox)
{
	int64_t every_ns = SECOND;

	for (int i = 0; i < outbox->line_count; i++)
		if (outbox->line[i].publish->every_ns < every_ns)
			every_ns = outbox->line[i].publish->every_ns;
	return (uint32_t)(every_ns / 1000);
}

/* ladderd runs no map that publishes what its program does not have. */
static enum desk_end want_variables(struct peer *peer)
{
	const struct outbox *outbox = &peer->outbox;
	const char **name = arena_alloc(&peer->arena, (outbox->value_count + 1) * sizeof(*name));

	if (!name)
		return DESK_NO_ROOM;
	for (uint32_t i = 0; i < outbox->value_count; i++)
		name[i] = outbox->value[i].name;
	return outbox->value_count ?
		       gateway_publish(&peer->gateway, name, outbox->value_count, shortest_us(outbox)) : DESK_GOOD;
}

/* ---- the map ---- */

static void close_map(struct peer *peer)
{
	for (int i = 0; i < peer->bus_count; i++)
		bus_close(&peer->bus[i]);
	peer->bus_count = 0;
	arena_free(&peer->arena);
	arena_init(&peer->arena);
	memset(&peer->inbox, 0, sizeof(peer->inbox));
	memset(&peer->outbox, 0, sizeof(peer->outbox));
	memset(&peer->map, 0, sizeof(peer->map));
}

static bool needs_bus(const struct peer *peer, int number)
{
	for (int i = 0; i < peer->inbox.source_count; i++)
		if (peer->inbox.source[i].bus == number)
			return true;
	for (int i = 0; i < peer->outbox.line_count; i++)
		if (peer->outbox.line[i].publish->bus == number)
			return true;
	return false;
}

static void find_buses(struct peer *peer)
{
	const struct io_net *net = peer->map.net;

	for (int i = 0; net && i < net->bus_count; i++) {
		const struct io_bus *bus = &net->bus[i];

		bus_init(&peer->bus[i], bus->interface, bus->host, bus->tcp_port);
		if (bus->kind != BUS_PEER || !needs_bus(peer, i))
			peer->bus[i].interface = NULL;
		peer->told[i] = 1; /* nothing: errors are negative */
		peer->bus_count = i + 1;
	}
}

/* ladderd has read the same text before. */
static bool open_map(struct peer *peer)
{
	close_map(peer);
	diag_init(&peer->diags);
	if (peer->gateway.text_len &&
	    !iomap_read(&peer->map, &peer->arena, "map", peer->gateway.text, peer->gateway.text_len, &peer->diags)) {
		fprintf(stderr, "ladder-peer: it cannot read the I/O map of this ladderd: another version of it\n");
		return false;
	}
	if (!inbox_open(&peer->inbox, &peer->map, &peer->arena) ||
	    !outbox_open(&peer->outbox, &peer->map, peer->run, &peer->arena)) {
		fprintf(stderr, "ladder-peer: out of memory\n");
		return false;
	}
	find_buses(peer);
	return true;
}

/* ---- the network ---- */

static void keep_buses(struct peer *peer)
{
	for (int i = 0; i < peer->bus_count; i++) {
		struct bus *bus = &peer->bus[i];

		if (!bus->interface)
			continue;
		bus_keep(bus);
		if (bus->error == peer->told[i])
			continue;
		peer->told[i] = bus->error;
		fprintf(stderr, "ladder-peer: %s on %s: %s%s%s\n", bus->group, bus->interface,
			bus->error ? bus_problem(bus->error) : "ready", bus->error ? "; " : "",
			bus->error ? bus_hint(bus->error) : "");
	}
}

static void put(void *context, uint32_t point, enum iec_type type, union iec_value value, bool good)
{
	/* A failure is found by the next flush. */
	gateway_put(&((struct peer *)context)->gateway, point, type, value, good);
}

static void take_datagrams(struct peer *peer, int number)
{
	struct bus *bus = &peer->bus[number];
	uint32_t from;

	for (int i = 0; i < AT_ONCE; i++) {
		const size_t len = bus_take(bus, peer->in, sizeof(peer->in), &from);

		if (!len)
			return;
		inbox_take(&peer->inbox, number, peer->in, len, from, peer->run, clock_now(), put, peer);
	}
}

/* What is sent is no older than ladderd's last word. */
static enum desk_end send_due(struct peer *peer)
{
	struct outbox_line *line;
	enum desk_end end = DESK_GOOD;

	while (end == DESK_GOOD && !peer->gateway.changed && (line = outbox_line_due(&peer->outbox, clock_now()))) {
		struct bus *bus = &peer->bus[line->publish->bus];

		if (clock_now() - peer->heard_ns > ALIVE_NS) {
			end = gateway_alive(&peer->gateway);
			if (end != DESK_GOOD || peer->gateway.changed)
				break;
			peer->heard_ns = clock_now();
		}
		while (outbox_write(&peer->outbox, line, peer->gateway.held ? PEER_HELD : 0,
				    (uint32_t)((clock_now() - peer->heard_ns) / 1000000), &peer->out))
			bus_send(bus, peer->out.bytes, peer_end(&peer->out));
	}
	return end;
}

/* ---- the report ---- */

static void add_unit(struct peer *peer, int bus, const char *board, uint64_t requests, uint64_t errors,
		     uint64_t timeouts)
{
	struct gateway_unit *unit = &peer->report.unit[peer->report.count];

	if (peer->report.count == REPORT_UNITS)
		return;
	*unit = (struct gateway_unit){ .requests = requests, .errors = errors, .timeouts = timeouts };
	snprintf(unit->name, sizeof(unit->name), "%.18s/%.20s", peer->map.net->bus[bus].name, board);
	peer->report.count++;
}

static enum desk_end report(struct peer *peer)
{
	uint64_t sent = 0, strange = 0;
	const char *why = NULL;

	peer->report.count = 0;
	for (int i = 0; i < peer->bus_count; i++) {
		sent += peer->bus[i].sent;
		strange += peer->bus[i].strange;
		why = peer->bus[i].interface && peer->bus[i].error ? bus_problem(peer->bus[i].error) : why;
	}
	for (int i = 0; i < peer->inbox.source_count; i++) {
		const struct inbox_source *source = &peer->inbox.source[i];

		add_unit(peer, source->bus, source->board, source->taken, source->refused, source->lost);
	}
	snprintf(peer->report.text, sizeof(peer->report.text), "%llu datagrams sent, %llu strange%s%.30s",
		 (unsigned long long)sent, (unsigned long long)strange, why ? ", " : "", why ? why : "");
	return gateway_report(&peer->gateway, &peer->report);
}

/* ---- the loop ---- */

static void wait_for_all(struct peer *peer)
{
	struct pollfd ready[IO_BUSES + 1] = { { .fd = gateway_fd(&peer->gateway), .events = POLLIN } };
	int64_t due_ns = outbox_due(&peer->outbox), left_ns;

	for (int i = 0; i < peer->bus_count; i++)
		ready[i + 1] = (struct pollfd){ .fd = peer->bus[i].fd, .events = POLLIN };
	if (peer->keep_ns < due_ns)
		due_ns = peer->keep_ns;
	left_ns = due_ns - clock_now();
	if (poll(ready, (nfds_t)peer->bus_count + 1, left_ns > 0 ? (int)((left_ns + 999999) / 1000000) : 0) < 0)
		return;
	for (int i = 0; i < peer->bus_count; i++)
		if (ready[i + 1].revents)
			take_datagrams(peer, i);
}

static enum desk_end turn(struct peer *peer)
{
	struct gateway *gateway = &peer->gateway;
	enum desk_end end;

	if (clock_now() >= peer->keep_ns) {
		keep_buses(peer);
		peer->keep_ns = clock_now() + SECOND;
		end = report(peer);
		if (end != DESK_GOOD)
			return end;
	}
	end = send_due(peer);
	if (end != DESK_GOOD)
		return end;
	wait_for_all(peer);
	end = gateway_flush(gateway);
	return end == DESK_GOOD ? gateway_listen(gateway, 0) : end;
}

/* The map may change between any two requests; then they are refused, and it begins again. */
static enum desk_end serve_map(struct peer *peer)
{
	struct gateway *gateway = &peer->gateway;
	enum desk_end end = gateway_begin(gateway, gateway_word(GATEWAY_PEER));
	bool good;

	if (end != DESK_GOOD)
		return end;
	good = open_map(peer);
	peer->heard_ns = clock_now();
	peer->keep_ns = 0;
	if (good)
		end = want_variables(peer);
	while (end == DESK_GOOD && !gateway->changed && !stop)
		end = good ? turn(peer) : gateway_listen(gateway, 1000);
	if (end == DESK_REFUSED && gateway->desk.refusal == REFUSAL_CONFLICT)
		end = gateway_listen(gateway, 100);
	return end;
}

/* Once for each reason. */
static void tell(struct peer *peer, enum desk_end end)
{
	const struct diag diag = desk_diag(&peer->gateway.desk, end);
	char text[600];

	if ((int)end == peer->away)
		return;
	peer->away = (int)end;
	diag_print(&diag, text, sizeof(text));
	fprintf(stderr, "ladder-peer: %s: %s\n", peer->socket, text);
}

static void rest(void)
{
	poll(NULL, 0, AGAIN_MS);
}

static void serve(struct peer *peer)
{
	struct gateway *gateway = &peer->gateway;
	enum desk_end end = gateway_open(gateway, peer->socket, "ladder-peer");

	gateway->output = take_output;
	gateway->published = take_published;
	gateway->context = peer;
	while (end == DESK_GOOD && !stop) {
		end = serve_map(peer);
		if (end == DESK_GOOD)
			peer->away = DESK_GOOD;
	}
	if (end != DESK_GOOD && !stop)
		tell(peer, end);
	close_map(peer);
	gateway_close(gateway);
}

/* ---- the command ---- */

static const char help[] =
	"usage: ladder-peer [OPTION]...\n"
	"Sends variables of this board to others in its network, and takes theirs: the lines PUBLISH\n"
	"and `peer` of the I/O map that ladderd runs.\n"
	"  --link SOCKET   where ladderd listens (" STREAM_SOCKET ")\n"
	"  --help, --version\n"
	"Its user must be in the group ladder-io, or be the one that ladderd runs as.\n";

static int usage(const char *word)
{
	fprintf(stderr, "ladder-peer: %s is not understood; see ladder-peer --help\n", word);
	return 2;
}

static bool begin(struct peer *peer)
{
	struct sigaction action;

	memset(&action, 0, sizeof(action));
	action.sa_handler = want_stop;
	sigemptyset(&action.sa_mask);
	sigaction(SIGTERM, &action, NULL);
	sigaction(SIGINT, &action, NULL);
	arena_init(&peer->arena);
	return getrandom(&peer->run, sizeof(peer->run), 0) == sizeof(peer->run) && (peer->run |= 1);
}

int main(int argc, char **argv)
{
	struct peer *peer;
	const char *socket = STREAM_SOCKET;

	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--help") == 0)
			return fputs(help, stdout) < 0;
		if (strcmp(argv[i], "--version") == 0)
			return printf("ladder-peer %s\n", LADDER_VERSION) < 0;
		if (strcmp(argv[i], "--link") != 0 || i + 1 == argc)
			return usage(argv[i]);
		socket = argv[++i];
	}
	peer = calloc(1, sizeof(*peer));
	if (!peer || !begin(peer)) {
		fprintf(stderr, "ladder-peer: out of memory\n");
		free(peer);
		return 1;
	}
	peer->socket = socket;
	while (!stop) {
		serve(peer);
		if (!stop)
			rest();
	}
	arena_free(&peer->arena);
	free(peer);
	return 0;
}
