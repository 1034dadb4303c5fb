/* SPDX-License-Identifier: MIT
 *
 * session - one loop for ladderd, for what the buses have read, and for servers.
 */
#define _DEFAULT_SOURCE
#include "modbus/session.h"

#include "hal/buses.h"
#include "modbus/status.h"
#include "online/gateway.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <unistd.h>

#define AGAIN_LEAST_MS 250  /* until ladderd is asked again                */
#define AGAIN_MOST_MS  2000
#define LACKS_MS       2000 /* until this machine is examined again         */
#define POLL_MOST      1040 /* 16 servers with 64 connections each           */
#define REPORT_NS      1000000000
#define SAFE_MS        1000 /* for safe values, when ladderd has gone       */
#define FLUSH_NS       1000000 /* values that come within it go together        */

enum told { TOLD_NOTHING, TOLD_AWAY, TOLD_REFUSED };

static struct {
	struct gateway gateway;
	struct gateway_report report;
	struct diag_list diags;
	struct arena arena;
	struct iomap map;
	char *text;            /* of it                                        */
	size_t text_len;
	struct field field;
	struct field_fresh *fresh;
	struct masters masters;
	struct serve serve;
	struct status_strays strays;
	bool runs;             /* masters and servers have begun                */
	bool stop;
	enum told told;        /* what was said of ladderd last                */
	enum desk_end end;
	int signal_fd;
	int64_t report_ns, flush_ns;
} session;

static void keep_end(enum desk_end end)
{
	if (end != DESK_GOOD)
		session.end = end;
}

static void print_diags(void)
{
	char line[1024];

	for (int i = 0; i < session.diags.count; i++) {
		diag_print(&session.diags.diag[i], line, sizeof(line));
		fprintf(stderr, "ladder-modbus: %s\n", line);
	}
}

static void read_signals(void)
{
	struct signalfd_siginfo info;

	while (read(session.signal_fd, &info, sizeof(info)) == (ssize_t)sizeof(info)) {
		if (info.ssi_signo == SIGUSR1)
			status_print(&session.masters, &session.serve, stdout);
		else
			session.stop = true;
	}
}

/* Waits for a signal, or for @fd if it is one. */
static void pause_for(int fd, int ms)
{
	struct pollfd ready[2] = { { .fd = session.signal_fd, .events = POLLIN }, { .fd = fd, .events = POLLIN } };

	poll(ready, 2, ms);
	read_signals();
}

/* ---- values ---- */

static bool is_ours(const struct io_point *point)
{
	return point->driver == DRIVER_modbus || point->driver == DRIVER_module;
}

static void on_output(void *context, uint32_t point, enum iec_type type, union iec_value value)
{
	const int asks = session.map.net ? session.map.net->ask_count : 0;

	(void)context;
	(void)type;
	if (session.runs && point >= (uint32_t)session.map.count && point - (uint32_t)session.map.count < (uint32_t)asks)
		masters_ask(&session.masters, &session.map, (int)point - session.map.count, (uint32_t)value.i);
	if (session.runs && point < (uint32_t)session.map.count && is_ours(&session.map.point[point]))
		masters_output(&session.masters, (int)point, value);
}

static enum iec_type raw_of(int point)
{
	return point < session.map.count ? session.map.point[point].channel->raw : IEC_UDINT;
}

static void send_values(void)
{
	const int count = field_take(&session.field, session.fresh);

	for (int i = 0; i < count; i++)
		keep_end(gateway_put(&session.gateway, (uint32_t)session.fresh[i].point,
				     raw_of(session.fresh[i].point), session.fresh[i].value,
				     session.fresh[i].good));
	if (count)
		keep_end(gateway_flush(&session.gateway));
}

static bool of_coils(int window)
{
	const enum io_table table = session.map.net->window[window].table;

	return table == TABLE_COIL || table == TABLE_DISCRETE_INPUT;
}

static bool read_window(void *context, int window, uint32_t first, int count, uint16_t *value)
{
	enum desk_end end;

	(void)context;
	end = gateway_window_read(&session.gateway, (uint32_t)window, first, (uint16_t)count, value);
	if (end != DESK_REFUSED)
		keep_end(end);
	return end == DESK_GOOD;
}

static bool write_window(void *context, int window, uint32_t first, int count, const uint16_t *value)
{
	enum desk_end end;

	(void)context;
	end = gateway_window_write(&session.gateway, (uint32_t)window, of_coils(window), first,
				   (uint16_t)count, value);
	if (end != DESK_REFUSED)
		keep_end(end);
	return end == DESK_GOOD;
}

/* ---- a map ---- */

static bool begin_servers(void)
{
	static const struct io_net none = { .serve_count = 0 };
	const struct answer_image image = { .read = read_window, .write = write_window };
	int bad, why;

	if (serve_open(&session.serve, session.map.net ? session.map.net : &none, image, &bad))
		return true;
	why = errno;
	if (bad >= 0)
		buses_server_error(&session.map, &session.map.net->serve[bad], why, &session.diags);
	return false;
}

static void end_map(void)
{
	masters_stop(&session.masters);
	serve_close(&session.serve);
	if (session.fresh)
		field_close(&session.field);
	free(session.fresh);
	session.fresh = NULL;
	status_strays_close(&session.strays);
	arena_free(&session.arena);
	free(session.text);
	session.text = NULL;
	session.runs = false;
}

/* Another program with the same map: buses and connections go on. */
static bool is_same_map(void)
{
	return session.runs && session.text_len == session.gateway.text_len &&
	       (!session.text_len || memcmp(session.text, session.gateway.text, session.text_len) == 0);
}

/* All is examined before anything is driven. False after a message: something is not right. */
static bool begin_map(void)
{
	bool good;
	int places;

	arena_init(&session.arena);
	diag_init(&session.diags);
	session.map = (struct iomap){ .count = 0 };
	session.text_len = session.gateway.text_len;
	session.text = malloc(session.text_len + 1);
	if (!session.text)
		return false;
	if (session.text_len)
		memcpy(session.text, session.gateway.text, session.text_len);
	session.text[session.text_len] = '\0';
	good = !session.text_len || iomap_read(&session.map, &session.arena, "map of the board", session.text,
					       session.text_len, &session.diags);
	good = good && buses_check(&session.map, &session.diags);
	places = session.map.count + (session.map.net ? session.map.net->ask_count : 0);
	session.fresh = good ? calloc((size_t)places + 1, sizeof(*session.fresh)) : NULL;
	if (session.fresh && !field_open(&session.field, places)) {
		free(session.fresh);
		session.fresh = NULL;
	}
	session.runs = session.fresh &&
		       status_strays_open(&session.strays, session.map.net ? session.map.net->bus_count : 0) &&
		       begin_servers() &&
		       masters_start(&session.masters, &session.map, &session.field);
	return session.runs;
}

/* Drives nothing, reports why to ladderd and the log, and examines all again later. */
static void tell_lack(void)
{
	struct gateway_report *report = &session.report;

	print_diags();
	report->count = 0;
	report->text[0] = '\0';
	if (session.diags.count)
		diag_print(&session.diags.diag[0], report->text, sizeof(report->text));
	keep_end(gateway_report(&session.gateway, report));
	for (int64_t until_ns = line_now() + LACKS_MS * INT64_C(1000000);
	     line_now() < until_ns && !session.stop && !session.gateway.changed && session.end == DESK_GOOD;) {
		pause_for(gateway_fd(&session.gateway), 100);
		keep_end(gateway_listen(&session.gateway, 0));
	}
}

/* ---- the loop ---- */

static int wait_ms(int64_t until_ns, int64_t now_ns)
{
	if (until_ns <= now_ns)
		return 0;
	return until_ns - now_ns > REPORT_NS ? (int)(REPORT_NS / 1000000) :
	       (int)((until_ns - now_ns + 999999) / 1000000);
}

static void wait_for_it(void)
{
	static struct pollfd ready[3 + POLL_MOST];
	const int64_t now_ns = line_now();
	const bool flush = now_ns >= session.flush_ns;
	int64_t until_ns = serve_poll(&session.serve, now_ns);
	const int servers = session.serve.readies;
	const int some = servers < POLL_MOST ? servers : POLL_MOST;

	ready[0] = (struct pollfd){ .fd = session.signal_fd, .events = POLLIN };
	ready[1] = (struct pollfd){ .fd = gateway_fd(&session.gateway), .events = POLLIN };
	ready[2] = (struct pollfd){ .fd = flush ? session.field.wake_fd : -1, .events = POLLIN };
	memcpy(ready + 3, session.serve.ready, (size_t)some * sizeof(*ready));
	if (session.report_ns < until_ns)
		until_ns = session.report_ns;
	if (!flush && session.flush_ns < until_ns)
		until_ns = session.flush_ns;
	poll(ready, (nfds_t)(3 + some), wait_ms(until_ns, now_ns));
	memcpy(session.serve.ready, ready + 3, (size_t)some * sizeof(*ready));
	if (ready[0].revents)
		read_signals();
	if (ready[2].revents) {
		send_values();
		session.flush_ns = line_now() + FLUSH_NS;
	}
}

static void report(int64_t now_ns)
{
	if (now_ns < session.report_ns)
		return;
	session.report_ns = now_ns + REPORT_NS;
	diag_init(&session.diags);
	status_strays(&session.strays, &session.masters, &session.map, &session.diags);
	print_diags();
	status_report(&session.masters, &session.serve, &session.strays, &session.report);
	keep_end(gateway_report(&session.gateway, &session.report));
}

static void move_values(void)
{
	while (!session.stop && !session.gateway.changed && session.end == DESK_GOOD) {
		wait_for_it();
		keep_end(gateway_listen(&session.gateway, 0));
		serve_step(&session.serve, line_now());
		report(line_now());
	}
}

/* Whether an output has its safe value when no ladderd says what it shall be. */
static bool has_safe(int point)
{
	const struct io_point *of = &session.map.point[point];

	return of->output && is_ours(of) && of->channel && !of->channel->ask && !of->hold;
}

/* Takes what the buses have written. Returns how many outputs of @left that were. */
static int take_written(bool *left)
{
	const int count = field_take(&session.field, session.fresh);
	int done = 0;

	for (int i = 0; i < count; i++) {
		const int point = session.fresh[i].point;

		if (point >= session.map.count || !left[point] || !session.fresh[i].good)
			continue;
		left[point] = false;
		done++;
	}
	return done;
}

/* ladderd has gone, and nobody says any more what an output shall be: each gets its safe value once. Afterwards it is
 * not written any more, so that a watchdog of the far end can act, too. A unit that is silent is not waited for. */
static void make_safe(void)
{
	const int64_t until_ns = line_now() + SAFE_MS * INT64_C(1000000);
	bool *left = session.runs ? calloc((size_t)session.map.count + 1, sizeof(*left)) : NULL;
	int count = 0;

	if (!left)
		return;
	field_take(&session.field, session.fresh); /* what was written before */
	for (int i = 0; i < session.map.count; i++) {
		left[i] = has_safe(i);
		count += left[i];
		if (left[i])
			masters_output(&session.masters, i, channel_wanted(session.map.point[i].channel,
									    session.map.point[i].channel->safe));
	}
	while (count > 0 && line_now() < until_ns) {
		pause_for(session.field.wake_fd, 20);
		count -= take_written(left);
	}
	free(left);
}

/* While ladderd is there. */
static void serve_board(void)
{
	while (!session.stop && session.end == DESK_GOOD) {
		keep_end(gateway_begin(&session.gateway, "modbus"));
		if (session.end != DESK_GOOD)
			break;
		session.told = TOLD_NOTHING;
		if (!is_same_map()) {
			end_map();
			if (!begin_map()) {
				tell_lack();
				end_map();
				continue;
			}
		}
		move_values();
	}
	make_safe();
	end_map();
}

static void tell_away(void)
{
	const struct desk *desk = &session.gateway.desk;

	if (session.told == (session.end == DESK_REFUSED ? TOLD_REFUSED : TOLD_AWAY))
		return;
	session.told = session.end == DESK_REFUSED ? TOLD_REFUSED : TOLD_AWAY;
	if (session.told == TOLD_REFUSED)
		fprintf(stderr, "ladder-modbus: ladderd refuses%s%s; is this user in the group ladder-io, and does "
			"no other ladder-modbus run?\n", desk->detail[0] ? ": " : "", desk->detail);
	else
		fprintf(stderr, "ladder-modbus: no ladderd answers; it is asked again\n");
}

static bool hear_signals(void)
{
	sigset_t signals;

	sigemptyset(&signals);
	sigaddset(&signals, SIGTERM);
	sigaddset(&signals, SIGINT);
	sigaddset(&signals, SIGUSR1);
	pthread_sigmask(SIG_BLOCK, &signals, NULL);
	signal(SIGPIPE, SIG_IGN);
	session.signal_fd = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
	return session.signal_fd >= 0;
}

int session_run(const char *socket)
{
	int again_ms = AGAIN_LEAST_MS;

	if (!hear_signals()) {
		fprintf(stderr, "ladder-modbus: no signals: %s\n", strerror(errno));
		return 1;
	}
	while (!session.stop) {
		session.end = gateway_open(&session.gateway, socket, "ladder-modbus");
		if (session.end == DESK_GOOD) {
			session.gateway.output = on_output;
			again_ms = AGAIN_LEAST_MS;
			serve_board();
		}
		if (!session.stop)
			tell_away();
		gateway_close(&session.gateway);
		if (!session.stop)
			pause_for(-1, again_ms);
		again_ms = again_ms * 2 < AGAIN_MOST_MS ? again_ms * 2 : AGAIN_MOST_MS;
	}
	return 0;
}
