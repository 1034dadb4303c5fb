/* SPDX-License-Identifier: MIT
 *
 * fb_classic - the blocks of ClassicLadder, as an imported project needs them.
 *
 * They add up the time of each call (DT) and read no clock: a block that is not called
 * does not count. They behave as its engine does (docs/from-classicladder.md), without
 * its faults unless FAITHFUL.
 */
#include "engine/scan/fb.h"

enum { COUNT_MOST = 9999, REGISTER_ROOM = 500 };

static int64_t not_negative(int64_t value)
{
	return value > 0 ? value : 0;
}

/* @units of @base in ns, limited to 64 bits. */
static int64_t in_ns(int32_t units, int64_t base)
{
	int64_t ns;

	if (units <= 0 || base <= 0 || __builtin_mul_overflow((int64_t)units, base, &ns))
		return units <= 0 || base <= 0 ? 0 : INT64_MAX;
	return ns;
}

/* ---- IEC timers: V counts up ---- */

struct up {
	int32_t *v;
	int64_t *rest;
	int32_t p;
	int64_t base, dt;
	bool faithful;
};

/* A fault of the original: the rest below a unit is kept for the next call. */
static void rewind_up(const struct up *up)
{
	*up->v = 0;
	if (!up->faithful)
		*up->rest = 0;
}

/* Another fault: at most one unit a call. */
static void count_up(const struct up *up)
{
	int64_t base = up->base > 0 ? up->base : 1, units;
	int64_t room = (int64_t)up->p - *up->v;

	if (__builtin_add_overflow(not_negative(*up->rest), not_negative(up->dt),
				   up->rest))
		*up->rest = INT64_MAX;
	units = *up->rest / base;
	if (up->faithful && units > 1)
		units = 1;
	*up->rest -= units * base;
	*up->v += (int32_t)(units < room ? units : not_negative(room));
}

#define UP(fb) &(struct up){ &(fb)->V, &(fb)->rest, (fb)->P, (fb)->BASE, (fb)->DT, \
			     (fb)->FAITHFUL != 0 }

void fb_CL_TON_step(struct fb_CL_TON *fb, int64_t now_ns)
{
	(void)now_ns;
	if (!fb->IN) {
		rewind_up(UP(fb));
		fb->Q = 0;
	} else if (fb->V >= fb->P) {
		fb->Q = 1;
	} else {
		count_up(UP(fb));
	}
}

/* Timers that run on without IN: an off-delay, a pulse. */
static uint8_t run_out(const struct up *up)
{
	if (*up->v < up->p) {
		count_up(up);
		return 1;
	}
	rewind_up(up);
	return 0;
}

void fb_CL_TOF_step(struct fb_CL_TOF *fb, int64_t now_ns)
{
	(void)now_ns;
	if (fb->IN) {
		rewind_up(UP(fb));
		fb->Q = 1;
	} else if (fb->Q) {
		fb->Q = run_out(UP(fb));
	}
}

void fb_CL_TP_step(struct fb_CL_TP *fb, int64_t now_ns)
{
	bool edge = fb_rises(fb->IN, &fb->seen);

	(void)now_ns;
	if (edge || fb->Q)
		fb->Q = run_out(UP(fb));
}

/* ---- blocks that count down ---- */

void fb_CL_TIMER_step(struct fb_CL_TIMER *fb, int64_t now_ns)
{
	(void)now_ns;
	if (!fb->begun) /* V starts from the preset at the start, not from the present P */
		fb->rest = in_ns(fb->V, fb->BASE);
	fb->begun = 1;
	if (!fb->E)
		fb->rest = in_ns(fb->P, fb->BASE);
	if (!fb->E) {
		fb->D = fb->R = 0;
	} else if (fb->rest <= 0) {
		fb->R = 0;
		fb->D = 1;
	} else if (fb->C) {
		fb->rest -= not_negative(fb->DT);
		fb->R = 1;
		fb->D = 0;
	}
	fb->V = fb->BASE > 0 ? (int32_t)(fb->rest / fb->BASE) : 0;
}

/* The fault of the original: after a pulse that ended between two calls, no other one
 * starts. */
void fb_CL_MONO_step(struct fb_CL_MONO *fb, int64_t now_ns)
{
	bool edge = fb_rises(fb->IN, &fb->seen);

	(void)now_ns;
	if (edge && fb->rest == 0) {
		fb->R = 1;
		fb->rest = in_ns(fb->P, fb->BASE);
	}
	if (fb->rest > 0)
		fb->rest -= not_negative(fb->DT);
	else
		fb->R = 0;
	if (fb->rest < 0 && !fb->FAITHFUL)
		fb->rest = 0;
	fb->V = fb->BASE > 0 ? (int32_t)(fb->rest / fb->BASE) : 0;
}

/* ---- counter, register ---- */

static void change_to(struct fb_CL_COUNTER *fb, int32_t value)
{
	fb->before = fb->V;
	fb->V = value;
}

void fb_CL_COUNTER_step(struct fb_CL_COUNTER *fb, int64_t now_ns)
{
	bool up = fb_rises(fb->UP, &fb->seen_up);
	bool down = fb_rises(fb->DOWN, &fb->seen_down);

	(void)now_ns;
	if (up)
		change_to(fb, fb->V >= COUNT_MOST ? 0 : fb->V + 1);
	if (down)
		change_to(fb, fb->V <= 0 ? COUNT_MOST : fb->V - 1);
	if (fb->LOAD)
		change_to(fb, fb->P);
	if (fb->RESET)
		change_to(fb, 0);
	fb->D = fb->V == fb->P;
	fb->E = fb->V == COUNT_MOST && fb->before == 0;
	fb->F = fb->V == 0 && fb->before == COUNT_MOST;
}

static int32_t *place(struct fb_CL_REGISTER *fb, int32_t index)
{
	return &fb->value[((uint32_t)fb->first % REGISTER_ROOM + (uint32_t)index) %
			  REGISTER_ROOM];
}

static void pop(struct fb_CL_REGISTER *fb)
{
	fb->O = *place(fb, fb->LAST_OUT ? fb->S - 1 : 0);
	if (!fb->LAST_OUT)
		fb->first = (int32_t)(((uint32_t)fb->first + 1) % REGISTER_ROOM);
	fb->S--;
}

void fb_CL_REGISTER_step(struct fb_CL_REGISTER *fb, int64_t now_ns)
{
	bool in = fb_rises(fb->PUSH, &fb->seen_push);
	bool out = fb_rises(fb->POP, &fb->seen_pop);
	int32_t size = fb->SIZE < 1 ? 1 : fb->SIZE < REGISTER_ROOM ? fb->SIZE :
								     REGISTER_ROOM;

	(void)now_ns;
	if (fb->S < 0 || fb->S > size)
		fb->S = 0;
	if (in && fb->S < size)
		*place(fb, fb->S++) = fb->I;
	if (out && fb->S > 0)
		pop(fb);
	if (fb->RESET)
		fb->S = fb->O = 0;
	fb->E = fb->S == 0;
	fb->F = fb->S == size;
}

/* ---- steps ---- */

void fb_CL_STEP_step(struct fb_CL_STEP *fb, int64_t now_ns)
{
	(void)now_ns;
	if (!fb->X || (fb->T == 0 && !fb->KEEP))
		fb->rest = 0;
	if (fb->X && __builtin_add_overflow(fb->rest, not_negative(fb->DT), &fb->rest))
		fb->rest = INT64_MAX;
	fb->V = (int32_t)(fb->rest / INT64_C(1000000000));
}
