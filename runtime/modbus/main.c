/* SPDX-License-Identifier: MIT
 *
 * main - ladder-modbus: serves the points of an I/O map that are on Modbus, for ladderd.
 *
 * It reads the map that ladderd runs, asks and writes units on its buses, and answers other masters if the
 * map says so. A scan never waits for it.
 */
#include "hal/buses.h"
#include "modbus/find.h"
#include "modbus/line.h"
#include "modbus/session.h"

#include "engine/base/file.h"
#include "engine/base/version.h"
#include "online/stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAP_BYTES (4u << 20)

static const char help[] =
	"usage: ladder-modbus [--link SOCKET]\n"
	"       ladder-modbus --check MAP\n"
	"       ladder-modbus scan BUS MAP [--json]\n"
	"       ladder-modbus scan --port DEVICE [OPTION]...\n"
	"       ladder-modbus scan --host HOST [OPTION]...\n"
	"Serves the inputs and outputs of an I/O map that are on Modbus, for ladderd.\n"
	"  --link SOCKET    where ladderd listens (/run/rungboard/link)\n"
	"  --check MAP      print what this machine lacks for the buses and servers of a map\n"
	"  --version        print the version\n"
	"  --help           print this\n"
	"scan lists the units that answer, of a bus of a map or of these:\n"
	"  --port DEVICE    a serial line, such as /dev/ttyUSB0\n"
	"  --baud RATE      its speed (19200)\n"
	"  --parity WORD    even, odd or none (even)\n"
	"  --stop-bits N    1 or 2 (1)\n"
	"  --host HOST      a device of the network; with HOST:PORT at another port than 502\n"
	"  --timeout MS     how long an answer may take (100; 300 with --host)\n"
	"  --from N --to N  numbers of units (1 and 247)\n"
	"  --json           print one JSON object\n"
	"SIGUSR1 prints the counters of each unit. docs/modbus.md tells more.\n"
	"Exit status: 0 good; 1 something is wrong or no unit answers; 2 wrong usage.\n";

static int wrong(const char *what, const char *why)
{
	fprintf(stderr, "ladder-modbus: %s %s\nTry `ladder-modbus --help`.\n", what, why);
	return 2;
}

/* What the command line says. */
struct request {
	const char *link, *check, *bus_name, *map;
	struct io_bus bus;
	char host[256];
	bool scan, json;
	long from, to, timeout_ms;
};

static bool is_number(const char *text, long least, long most, long *out)
{
	char *end;

	*out = strtol(text, &end, 10);
	return *text && !*end && *out >= least && *out <= most;
}

static bool set_host(struct request *out, const char *text)
{
	const char *colon = strrchr(text, ':');
	const size_t len = colon ? (size_t)(colon - text) : strlen(text);
	long port = 502;

	if (!len || len >= sizeof(out->host) || (colon && !is_number(colon + 1, 1, 65535, &port)))
		return false;
	memcpy(out->host, text, len);
	out->host[len] = '\0';
	out->bus.kind = BUS_MODBUS_TCP;
	out->bus.host = out->host;
	out->bus.tcp_port = (uint16_t)port;
	return true;
}

static bool set_parity(struct request *out, const char *text)
{
	out->bus.parity = strcmp(text, "even") == 0 ? 'E' : strcmp(text, "odd") == 0 ? 'O' : 'N';
	return out->bus.parity != 'N' || strcmp(text, "none") == 0;
}

/* An option of scan and its value. False: it is none, or the value is wrong. */
static bool scan_option(struct request *out, const char *word, const char *value)
{
	long number;

	if (strcmp(word, "--port") == 0) {
		out->bus.port = value;
		return true;
	}
	if (strcmp(word, "--host") == 0)
		return set_host(out, value);
	if (strcmp(word, "--parity") == 0)
		return set_parity(out, value);
	if (strcmp(word, "--from") == 0)
		return is_number(value, 0, 255, &out->from);
	if (strcmp(word, "--to") == 0)
		return is_number(value, 0, 255, &out->to);
	if (strcmp(word, "--timeout") == 0)
		return is_number(value, 1, 60000, &out->timeout_ms);
	if (strcmp(word, "--baud") == 0 && is_number(value, 1, 4000000, &number) &&
	    line_baud_is_known((uint32_t)number)) {
		out->bus.baud = (uint32_t)number;
		return true;
	}
	if (strcmp(word, "--stop-bits") == 0 && is_number(value, 1, 2, &number)) {
		out->bus.stop_bits = (uint8_t)number;
		return true;
	}
	return false;
}

/* -1: go on; else the exit status. */
static int read_option(struct request *out, int argc, char **argv, int *i)
{
	const char *word = argv[*i];

	if (strcmp(word, "--help") == 0)
		return fputs(help, stdout) < 0;
	if (strcmp(word, "--version") == 0)
		return printf("ladder-modbus %s\n", LADDER_VERSION) < 0;
	if (strcmp(word, "--json") == 0 && out->scan) {
		out->json = true;
		return -1;
	}
	if (word[0] != '-' && out->scan && !out->map) {
		*(out->bus_name ? &out->map : &out->bus_name) = word;
		return -1;
	}
	if (*i + 1 == argc)
		return wrong(word, "is no option, or needs a value");
	(*i)++;
	if (!out->scan && strcmp(word, "--link") == 0)
		out->link = argv[*i];
	else if (!out->scan && strcmp(word, "--check") == 0)
		out->check = argv[*i];
	else if (!out->scan || !scan_option(out, word, argv[*i]))
		return wrong(word, "is no option here, or its value is wrong");
	return -1;
}

/* ---- maps of files ---- */

static struct diag_list diags;

static int print_diags(void)
{
	char line[1024];

	for (int i = 0; i < diags.count; i++) {
		diag_print(&diags.diag[i], line, sizeof(line));
		fprintf(stderr, "%s\n", line);
	}
	return diags.errors != 0;
}

/* The text must outlive the map. */
static bool load_map(const char *path, struct iomap *map, struct arena *arena, char **text)
{
	size_t len;

	diag_init(&diags);
	arena_init(arena);
	*text = file_read(path, MAP_BYTES, &len, &diags);
	return *text && iomap_read(map, arena, path, *text, len, &diags);
}

static int check_map(const char *path)
{
	struct iomap map = { .count = 0 };
	struct arena arena;
	char *text;

	if (load_map(path, &map, &arena, &text))
		buses_check(&map, &diags);
	if (!print_diags())
		printf("%s: good\n", path);
	arena_free(&arena);
	free(text);
	return diags.errors != 0;
}

static int scan(const struct request *request, const struct io_bus *bus)
{
	struct io_bus at = *bus;

	if (request->timeout_ms)
		at.timeout_ns = request->timeout_ms * INT64_C(1000000);
	return find_units(&at, (int)request->from, (int)request->to, request->json) <= 0;
}

static int scan_of_map(const struct request *request)
{
	struct iomap map = { .count = 0 };
	struct arena arena;
	char *text;
	int status = 2;

	if (!load_map(request->map, &map, &arena, &text)) {
		print_diags();
		status = 1;
	} else {
		for (int i = 0; map.net && i < map.net->bus_count && status == 2; i++)
			if (strcmp(map.net->bus[i].name, request->bus_name) == 0 &&
			    map.net->bus[i].kind != BUS_PEER)
				status = scan(request, &map.net->bus[i]);
		if (status == 2)
			wrong(request->bus_name, "is no bus of this map");
	}
	arena_free(&arena);
	free(text);
	return status;
}

static int do_scan(struct request *request)
{
	if (request->from > request->to)
		return wrong("--from", "is above --to");
	if (request->map)
		return scan_of_map(request);
	if (request->bus_name || !(request->bus.port || request->bus.host))
		return wrong("scan", "needs the name of a bus and a map, or --port, or --host");
	request->bus.timeout_ns = request->bus.host ? 300000000 : 100000000;
	return scan(request, &request->bus);
}

int main(int argc, char **argv)
{
	struct request request = { .link = STREAM_SOCKET, .from = 1, .to = 247,
				   .bus = { .name = "bus", .kind = BUS_MODBUS_RTU, .baud = 19200, .parity = 'E',
					    .stop_bits = 1 } };
	int i = 1;

	request.scan = argc > 1 && strcmp(argv[1], "scan") == 0;
	for (i += request.scan; i < argc; i++) {
		const int status = read_option(&request, argc, argv, &i);

		if (status >= 0)
			return status;
	}
	if (request.scan)
		return do_scan(&request);
	return request.check ? check_map(request.check) : session_run(request.link);
}
