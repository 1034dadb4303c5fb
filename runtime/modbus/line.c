/* SPDX-License-Identifier: MIT
 *
 * line - a wire over libmodbus: one frame out, one frame in.
 */
#define _DEFAULT_SOURCE
#include "modbus/line.h"

#include <errno.h>
#include <modbus.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define BYTE_NS     50000000 /* within a frame; adapters on USB hold bytes back for 16 ms */
#define DRAIN_NS    20000000 /* a line is quiet after this time without a byte */
#define DRAIN_MOST  10       /* … but it is not waited for longer than so many of them */
#define BROADCAST_NS 100000000 /* units need this after a request to all     */
#define SILENT_MOST 3        /* requests without an answer; then TCP connects anew */
#define MBAP        7        /* bytes before a PDU in TCP                     */

int64_t line_now(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void sleep_ns(int64_t ns)
{
	const struct timespec time = { .tv_sec = ns / 1000000000, .tv_nsec = ns % 1000000000 };

	nanosleep(&time, NULL);
}

bool line_baud_is_known(uint32_t baud)
{
	static const uint32_t known[] = { 110, 300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200,
					  230400, 460800, 500000, 576000, 921600, 1000000, 1152000, 1500000,
					  2500000, 3000000, 3500000, 4000000 };

	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++)
		if (known[i] == baud)
			return true;
	return false;
}

static bool is_tcp(const struct line *line)
{
	return line->at->kind == BUS_MODBUS_TCP;
}

static int64_t bytes_ns(const struct line *line, int count)
{
	const int bits = 1 + 8 + (line->at->parity != 'N') + line->at->stop_bits;

	return is_tcp(line) ? 0 : (int64_t)count * bits * 1000000000 / line->at->baud;
}

bool line_init(struct line *line, const struct io_bus *at)
{
	char service[8];

	*line = (struct line){ .at = at };
	snprintf(service, sizeof(service), "%u", at->tcp_port);
	line->modbus = is_tcp(line) ? modbus_new_tcp_pi(at->host, service) :
		       modbus_new_rtu(at->port, (int)at->baud, at->parity, 8, at->stop_bits);
	if (!line->modbus) {
		snprintf(line->why, sizeof(line->why), "%s", modbus_strerror(errno));
		return false;
	}
	/* 3.5 characters; above 19,200 baud 1.75 ms, as the specification of the serial line says. */
	line->quiet_ns = is_tcp(line) ? 0 : at->baud > 19200 ? 1750000 : bytes_ns(line, 7) / 2;
	modbus_set_byte_timeout(line->modbus, 0, BYTE_NS / 1000);
	return true;
}

static void hang_up(struct line *line)
{
	if (line->open)
		modbus_close(line->modbus);
	line->open = line->used = false;
	line->silent = 0;
}

void line_close(struct line *line)
{
	hang_up(line);
	if (line->modbus)
		modbus_free(line->modbus);
	line->modbus = NULL;
}

static void set_timeout(struct line *line, int64_t ns)
{
	modbus_set_response_timeout(line->modbus, (uint32_t)(ns / 1000000000),
				    (uint32_t)(ns % 1000000000 / 1000));
}

bool line_open(struct line *line)
{
	if (line->open)
		return true;
	set_timeout(line, line->at->timeout_ns);
	if (modbus_connect(line->modbus) != 0) {
		snprintf(line->why, sizeof(line->why), "%s", modbus_strerror(errno));
		return false;
	}
	line->open = true;
	/* One master for a line: other programs that open it get the error "busy". */
	if (!is_tcp(line) && flock(modbus_get_socket(line->modbus), LOCK_EX | LOCK_NB) != 0) {
		snprintf(line->why, sizeof(line->why), "another program uses it");
		hang_up(line);
		return false;
	}
	line->free_ns = line_now() + line->quiet_ns;
	return true;
}

/* Until the line is quiet. Returns whether a byte came. */
static bool drain(struct line *line)
{
	struct pollfd ready = { .fd = modbus_get_socket(line->modbus), .events = POLLIN };
	uint8_t bytes[256];
	bool came = false;

	for (int i = 0; i < DRAIN_MOST && poll(&ready, 1, DRAIN_NS / 1000000) > 0; i++) {
		if (read(ready.fd, bytes, sizeof(bytes)) <= 0)
			break;
		came = true;
	}
	line->free_ns = line_now() + line->quiet_ns;
	return came;
}

/* What came since the last answer belongs to nothing. */
static void drop_strays(struct line *line, struct unit_counts *counts)
{
	int waiting = 0;

	if (ioctl(modbus_get_socket(line->modbus), FIONREAD, &waiting) == 0 && waiting > 0) {
		counts->wrong++;
		drain(line);
	}
}

static bool send_tcp(struct line *line, uint8_t unit, const struct pdu *request)
{
	uint8_t frame[MBAP + PDU_MOST];
	const int len = request->len + 1;

	line->number++;
	frame[0] = (uint8_t)(line->number >> 8);
	frame[1] = (uint8_t)line->number;
	frame[2] = frame[3] = 0;
	frame[4] = (uint8_t)(len >> 8);
	frame[5] = (uint8_t)len;
	frame[6] = unit;
	memcpy(frame + MBAP, request->byte, (size_t)request->len);
	return send(modbus_get_socket(line->modbus), frame, (size_t)request->len + MBAP, MSG_NOSIGNAL) ==
	       request->len + MBAP;
}

bool line_say(struct line *line, uint8_t unit, const struct pdu *pdu)
{
	uint8_t frame[1 + PDU_MOST];
	const int64_t now_ns = line_now();

	if (line->free_ns > now_ns)
		sleep_ns(line->free_ns - now_ns);
	frame[0] = unit;
	memcpy(frame + 1, pdu->byte, (size_t)pdu->len);
	modbus_set_slave(line->modbus, unit);
	return modbus_send_raw_request(line->modbus, frame, pdu->len + 1) > 0;
}

int line_fd(const struct line *line)
{
	return modbus_get_socket(line->modbus);
}

/* The part of a frame that is a PDU. False: the frame is not for this request. */
static bool unpack(struct line *line, uint8_t unit, const uint8_t *frame, int len, struct pdu *answer)
{
	const int head = is_tcp(line) ? MBAP : 1, tail = is_tcp(line) ? 0 : 2;

	if (len <= head + tail || len - head - tail > PDU_MOST)
		return false;
	answer->len = len - head - tail;
	memcpy(answer->byte, frame + head, (size_t)answer->len);
	return is_tcp(line) ? pdu_word(frame) == line->number && frame[6] == unit : frame[0] == unit;
}

/* A connection whose frames have lost their begin is of no more use. */
static bool is_torn(const struct line *line, const uint8_t *frame, int len)
{
	return is_tcp(line) && (len < MBAP || pdu_word(frame + 2) != 0 || pdu_word(frame + 4) != len - 6);
}

static enum heard failed(struct line *line, bool strays, struct unit_counts *counts)
{
	switch (errno) {
	case ETIMEDOUT:
		if (!is_tcp(line))
			drain(line);
		return strays ? HEARD_WRONG : HEARD_NOTHING;
	case EMBBADCRC:
		drain(line);
		return HEARD_CRC;
	case EMBBADDATA:
		counts->wrong++;
		drain(line);
		if (is_tcp(line))
			hang_up(line);
		return HEARD_WRONG;
	default:
		snprintf(line->why, sizeof(line->why), "%s", modbus_strerror(errno));
		hang_up(line);
		return HEARD_NO_LINE;
	}
}

static enum heard hear(struct line *line, uint8_t unit, struct pdu *answer, int64_t until_ns,
		       struct unit_counts *counts)
{
	uint8_t frame[MODBUS_MAX_ADU_LENGTH];
	bool strays = false;

	for (;;) {
		const int64_t left_ns = until_ns - line_now();
		int len;

		set_timeout(line, left_ns > 1000000 ? left_ns : 1000000);
		len = modbus_receive_confirmation(line->modbus, frame);
		if (len < 0)
			return failed(line, strays, counts);
		if (len > 0 && is_torn(line, frame, len)) {
			counts->wrong++;
			hang_up(line);
			return HEARD_WRONG;
		}
		if (len > 0 && unpack(line, unit, frame, len, answer)) {
			line->free_ns = line_now() + line->quiet_ns;
			line->used = true;
			return HEARD_ANSWER;
		}
		/* Of another unit, or of a request before. */
		counts->wrong++;
		strays = true;
		if (left_ns <= 0)
			return HEARD_WRONG;
	}
}

static enum heard ask_once(struct line *line, uint8_t unit, const struct pdu *request,
			   struct pdu *answer, struct unit_counts *counts)
{
	bool sent;

	drop_strays(line, counts);
	sent = is_tcp(line) ? send_tcp(line, unit, request) : line_say(line, unit, request);
	if (!sent) {
		snprintf(line->why, sizeof(line->why), "%s", strerror(errno));
		hang_up(line);
		return HEARD_NO_LINE;
	}
	if (!unit && !is_tcp(line)) {
		/* All units take it and none answers. */
		*answer = *request;
		if (request->byte[0] == PDU_SET_COILS || request->byte[0] == PDU_SET_REGISTERS)
			answer->len = 5;
		line->free_ns = line_now() + bytes_ns(line, request->len + 3) + BROADCAST_NS;
		return HEARD_ANSWER;
	}
	return hear(line, unit, answer,
		    line_now() + line->at->timeout_ns + bytes_ns(line, request->len + 3), counts);
}

enum heard line_ask(struct line *line, uint8_t unit, const struct pdu *request, struct pdu *answer,
		    struct unit_counts *counts)
{
	enum heard heard;
	bool used;

	if (!line_open(line))
		return HEARD_NO_LINE;
	used = line->used;
	heard = ask_once(line, unit, request, answer, counts);
	/* Many devices end a connection that was idle for some seconds. */
	if (heard == HEARD_NO_LINE && used && is_tcp(line) && line_open(line))
		heard = ask_once(line, unit, request, answer, counts);
	line->silent = heard == HEARD_NOTHING ? line->silent + 1 : 0;
	/* The far end may have forgotten this connection. */
	if (line->silent >= SILENT_MOST && is_tcp(line))
		hang_up(line);
	return heard;
}

static enum heard wire_ask(void *context, uint8_t unit, const struct pdu *request, struct pdu *answer,
			   struct unit_counts *counts)
{
	return line_ask(context, unit, request, answer, counts);
}

static int64_t wire_now(void *context)
{
	(void)context;
	return line_now();
}

struct wire line_wire(struct line *line)
{
	return (struct wire){ .ask = wire_ask, .now = wire_now, .context = line,
			      .numbered = is_tcp(line) };
}
