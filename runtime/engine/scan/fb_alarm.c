/* SPDX-License-Identifier: MIT
 *
 * fb_alarm - ALARM, ALARM_LIMIT and EVENT.
 *
 * The states are those of IEC 62682. The blocks keep no list and know no clock of the
 * wall: scan/alarms.h looks at their pins after a scan.
 */
#include "engine/scan/fb.h"

enum { NOTICE = 3 }; /* this CLASS needs no acknowledgement                  */

/* What both alarms have, so that one function does the work. */
struct alarm {
	uint8_t *active, *unack, *running;
	int64_t *start, *came, *went, *acked; /* on the clock of the scan       */
	uint32_t *count;
	int64_t delay;
	uint8_t class;
};

/* An acknowledgement counts for what stood before this call, so that nobody
 * acknowledges an alarm that was never shown. Returns the state of IEC 62682. */
static uint8_t step(const struct alarm *alarm, bool now, bool ack, int64_t now_ns)
{
	bool before = *alarm->active != 0;

	if (ack && *alarm->unack)
		*alarm->acked = now_ns;
	if (ack)
		*alarm->unack = 0;
	if (now && !*alarm->running)
		*alarm->start = now_ns;
	*alarm->running = now;
	*alarm->active = now && (before || alarm->delay <= 0 ||
				 fb_since(now_ns, *alarm->start) >= (uint64_t)alarm->delay);
	if (*alarm->active && !before) {
		++*alarm->count;
		*alarm->unack = 1;
		*alarm->came = now_ns;
		*alarm->went = *alarm->acked = 0;
	}
	if (before && !*alarm->active)
		*alarm->went = now_ns;
	*alarm->unack = *alarm->unack && alarm->class != NOTICE;
	return (uint8_t)(*alarm->active ? 2 - *alarm->unack : 3 * *alarm->unack);
}

#define STEP(fb, condition) do { \
	bool ack = fb_rises((fb)->ACK, &(fb)->seen); \
	const struct alarm alarm = { \
		&(fb)->Q, &(fb)->UNACK, &(fb)->running, &(fb)->start, &(fb)->came, \
		&(fb)->went, &(fb)->acked, &(fb)->COUNT, (fb)->DELAY, (fb)->CLASS, \
	}; \
\
	ack |= (fb)->OP_ACK != 0; \
	(fb)->OP_ACK = 0; \
	(fb)->STATE = step(&alarm, condition, ack, now_ns); \
} while (0)

void fb_ALARM_step(struct fb_ALARM *fb, int64_t now_ns)
{
	STEP(fb, fb->IN != 0);
}

/* A sensor that gives no number, or a limit that is none, is an alarm. */
static bool is_beyond(const struct fb_ALARM_LIMIT *fb)
{
	double in = (double)fb->IN, limit = (double)fb->LIMIT;
	double back = fb->beyond && fb->HYST > 0.0f ? (double)fb->HYST : 0.0;

	if (!fb_is_number(in) || !fb_is_number(limit))
		return true;
	return fb->BELOW ? in < limit + back : in > limit - back;
}

void fb_ALARM_LIMIT_step(struct fb_ALARM_LIMIT *fb, int64_t now_ns)
{
	fb->beyond = fb->EN && is_beyond(fb);
	STEP(fb, fb->beyond != 0);
}

void fb_EVENT_step(struct fb_EVENT *fb, int64_t now_ns)
{
	fb->Q = fb_rises(fb->IN, &fb->seen);
	fb->COUNT += fb->Q;
	if (fb->Q)
		fb->came = now_ns;
}
