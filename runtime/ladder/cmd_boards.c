/* SPDX-License-Identifier: MIT
 *
 * cmd_boards - `ladder boards`: the boards that announce themselves in the network, and the
 * serial ports of this machine.
 */
#include "ladder/foreign.h"
#include "hal/clock.h"
#include "ladder/report.h"

#include "online/finder.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define WAIT_NS    INT64_C(3000000000)
#define PORTS_MOST 32

static void print_board(const struct call *call, const struct found_board *board, bool first)
{
	const struct sink *out = &call->out;

	if (call_flag(call, "--json")) {
		sink_text(out, first ? "\n  {\"where\": " : ",\n  {\"where\": ");
		sink_json_text(out, board->where);
		report_json_field("board", board->name, out);
		report_json_field("version", *board->version ? board->version : NULL, out);
		sink_printf(out, ", \"port\": %u}", (unsigned)board->port);
		return;
	}
	foreign_text(out, board->where);
	sink_text(out, "\t");
	foreign_text(out, board->name);
	sink_text(out, "\t");
	foreign_text(out, board->version);
	if (board->port != FINDER_SSH)
		sink_printf(out, "\tport %u", (unsigned)board->port);
	sink_text(out, "\n");
}

static void print_port(const struct call *call, const char *path, bool first)
{
	const struct sink *out = &call->out;

	if (!call_flag(call, "--json")) {
		sink_text(out, "serial:");
		sink_text(out, path);
		sink_text(out, "\n");
		return;
	}
	sink_text(out, first ? "\n  {\"where\": \"serial:" : ",\n  {\"where\": \"serial:");
	sink_text(out, path); /* letters and digits, as finder_ports() takes them */
	sink_text(out, "\", \"board\": null, \"version\": null, \"port\": null}");
}

/* Boards that have been printed. */
struct printed {
	struct found_board board[FINDER_MOST];
	int count;
};

static bool is_printed(const struct printed *printed, const struct found_board *board)
{
	for (int i = 0; i < printed->count; i++)
		if (strcmp(printed->board[i].where, board->where) == 0 &&
		    strcmp(printed->board[i].name, board->name) == 0 &&
		    printed->board[i].port == board->port)
			return true;
	return printed->count == FINDER_MOST;
}

static void print_boards(struct call *call, struct finder *finder, struct printed *printed)
{
	for (int i = 0; i < finder_count(finder); i++) {
		const struct found_board *board = finder_board(finder, i);

		if (is_printed(printed, board))
			continue;
		print_board(call, board, !printed->count);
		printed->board[printed->count++] = *board;
	}
	report_flush(call);
}

/* Until all boards that answer at once are there, or the time is over. A person sees each of
 * them as soon as it is found; JSON has them by name. */
static void find_boards(struct call *call, struct finder *finder, int64_t wait_ns,
			struct printed *printed)
{
	const int64_t until = clock_now() + wait_ns;
	int64_t left = wait_ns;

	while (!finder_settled(finder) && left > 0) {
		if (finder_wait(finder, (int)(left / 1000000) + 1) &&
		    !call_flag(call, "--json"))
			print_boards(call, finder, printed);
		left = until - clock_now();
	}
	print_boards(call, finder, printed);
}

enum status cmd_boards(struct call *call)
{
	char ports[PORTS_MOST][64];
	const int port_count = finder_ports("/dev", ports, PORTS_MOST);
	const struct diag place = { .id = DIAG_NO_FINDER, .file = "ladder" };
	struct printed *printed;
	const char *why = NULL;
	struct finder *finder;
	int64_t wait_ns;
	int count;

	if (!report_period(call, "--time", WAIT_NS, &wait_ns))
		return STATUS_WRONG;
	printed = calloc(1, sizeof(*printed));
	if (!printed)
		return report_no_memory("ladder");
	if (call_flag(call, "--json"))
		sink_text(&call->out, "[");
	finder = finder_open(&why);
	if (finder) {
		find_boards(call, finder, wait_ns, printed);
		why = finder_failed(finder);
	}
	count = printed->count;
	free(printed);
	for (int i = 0; i < port_count; i++)
		print_port(call, ports[i], count + i == 0);
	if (call_flag(call, "--json"))
		sink_text(&call->out, "\n]\n");
	if (why)
		report_diag(place, "%s", why);
	else if (!count)
		report_diag((struct diag){ .id = DIAG_NONE_FOUND, .file = "ladder" }, "%s", "");
	finder_close(finder);
	return why ? STATUS_WRONG : STATUS_GOOD;
}
