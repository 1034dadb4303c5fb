/* SPDX-License-Identifier: MIT
 *
 * guarded - packets for ladder-guard (guard/say.h).
 */
#include "ladderd/guarded.h"

#include "guard/say.h"
#include "hal/request.h"

#include <fcntl.h>
#include <poll.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define TAKE_MS 2000

/* A signal handler sends heartbeats. */
static struct {
	volatile int fd;       /* + 1; 0: no guard                            */
	int64_t heartbeat_ms, last_ms;
} to;

static struct guard_table table; /* no stack of ladderd is so large */

bool guarded_begin(void)
{
	const char *text = getenv(GUARD_VARIABLE);
	char *end;
	long fd, ms, stopped;

	if (!text)
		return false;
	fd = strtol(text, &end, 10);
	ms = strtol(end, &end, 10);
	stopped = strtol(end, &end, 10);
	unsetenv(GUARD_VARIABLE);
	if (*end || fd <= STDERR_FILENO || fd > 65535 || ms < 1 || ms > GUARD_LONGEST / 2 ||
	    fcntl((int)fd, F_SETFD, FD_CLOEXEC) != 0)
		return false;
	to.heartbeat_ms = ms;
	to.fd = (int)fd + 1;
	return stopped == 1;
}

bool guarded(void)
{
	return to.fd;
}

static void say(const void *packet, size_t len)
{
	send(to.fd - 1, packet, len, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void guarded_beat(int64_t next_ms, bool now)
{
	struct guard_head beat = { .magic = GUARD_MAGIC, .kind = GUARD_BEAT };
	struct timespec time;
	int64_t time_ms;

	if (!to.fd)
		return;
	clock_gettime(CLOCK_MONOTONIC, &time);
	time_ms = (int64_t)time.tv_sec * 1000 + time.tv_nsec / 1000000;
	if (!now && time_ms - to.last_ms < to.heartbeat_ms / 4)
		return;
	to.last_ms = time_ms;
	next_ms += to.heartbeat_ms;
	beat.within_ms = (uint32_t)(next_ms < GUARD_LONGEST ? next_ms : GUARD_LONGEST);
	say(&beat, sizeof(beat));
}

static void add_request(const struct hal_request *request, uint32_t *count, uint32_t *dropped)
{
	static const uint8_t bias[] = {
		[BIAS_AS_IS] = 0, [BIAS_NONE] = 1, [BIAS_UP] = 2, [BIAS_DOWN] = 3,
	};
	static const uint8_t drive[] = {
		[DRIVE_AS_IS] = 0, [DRIVE_PUSH_PULL] = 1, [DRIVE_OPEN_DRAIN] = 2,
		[DRIVE_OPEN_SOURCE] = 3,
	};
	const uint64_t level = request->safe ^ request->invert;

	for (uint32_t i = 0; request->ask.output && i < request->ask.count; i++) {
		const struct request_line *line = &request->ask.line[i];

		if (line->at.chip < 0)
			continue;
		if (*count == GUARD_LINES || line->at.chip > UINT16_MAX) {
			++*dropped;
			continue;
		}
		table.line[(*count)++] = (struct guard_line){
			.chip = (uint16_t)line->at.chip, .offset = (uint16_t)line->at.offset,
			.level = level >> i & 1, .bias = bias[line->point->bias],
			.drive = drive[line->point->drive],
		};
	}
}

bool guarded_lines(const struct hal *hal)
{
	uint32_t count = 0, dropped = 0;

	if (!to.fd)
		return true;
	memset(&table, 0, sizeof(table));
	for (uint32_t i = 0; i < hal->request_count; i++)
		add_request(&hal->request[i], &count, &dropped);
	table.head = (struct guard_head){ .magic = GUARD_MAGIC, .kind = GUARD_TABLE,
					  .count = (uint16_t)count };
	if (strlen(hal->map->dev) < sizeof(table.dev))
		memcpy(table.dev, hal->map->dev, strlen(hal->map->dev));
	if (dropped)
		fprintf(stderr, "ladderd: ladder-guard holds %d outputs; %u are not made safe by it\n",
			GUARD_LINES, (unsigned)dropped);
	if (send(to.fd - 1, &table, offsetof(struct guard_table, line) +
		 count * sizeof(table.line[0]), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
		fprintf(stderr, "ladderd: ladder-guard does not listen; it knows no outputs\n");
		return false;
	}
	return dropped == 0;
}

void guarded_take(void)
{
	struct guard_head head = { .magic = GUARD_MAGIC, .kind = GUARD_TAKE };
	struct pollfd answer = { .fd = to.fd - 1, .events = POLLIN };

	if (!to.fd)
		return;
	say(&head, sizeof(head));
	if (poll(&answer, 1, TAKE_MS) == 1)
		recv(to.fd - 1, &head, sizeof(head), MSG_DONTWAIT);
}

void guarded_tell(const char *state)
{
	struct guard_tell tell = { .head = { .magic = GUARD_MAGIC, .kind = GUARD_TELL } };
	const size_t len = strlen(state);

	if (!to.fd || len >= sizeof(tell.text))
		return;
	memcpy(tell.text, state, len);
	say(&tell, sizeof(tell));
}
