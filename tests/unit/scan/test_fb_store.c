/* SPDX-License-Identifier: MIT
 *
 * test_fb_store - FIFO, LIFO, SHIFT, SEMA and the counters of each type.
 */
#include "engine/scan/vm.h"
#include "tests/tap.h"

#include <string.h>

static void fifo_edge(struct fb_FIFO *fifo, bool in, bool out, int32_t value)
{
	fifo->PUSH = fifo->POP = 0;
	fb_FIFO_step(fifo, 0);
	fifo->PUSH = in;
	fifo->POP = out;
	fifo->IN = value;
	fb_FIFO_step(fifo, 0);
}

static void fifo_keeps_the_order(void)
{
	struct fb_FIFO fifo = { .SIZE = 3, .POP = 1 };

	fb_FIFO_step(&fifo, 0);
	CHECK_AS(!fifo.Q && fifo.EMPTY && !fifo.FULL,
		 "POP of an empty FIFO gives Q = FALSE");
	fifo_edge(&fifo, true, false, 11);
	CHECK(fifo.Q && fifo.COUNT == 1 && !fifo.EMPTY);
	fb_FIFO_step(&fifo, 0);
	CHECK_AS(!fifo.Q && fifo.COUNT == 1, "PUSH without a new edge stores nothing");
	fifo_edge(&fifo, true, false, 22);
	fifo_edge(&fifo, true, false, 33);
	CHECK(fifo.Q && fifo.COUNT == 3 && fifo.FULL);
	fifo_edge(&fifo, true, false, 44);
	CHECK_AS(!fifo.Q && fifo.COUNT == 3,
		 "PUSH into a full FIFO stores nothing and gives Q = FALSE");
	fifo_edge(&fifo, false, true, 0);
	CHECK(fifo.Q && fifo.OUT == 11 && fifo.COUNT == 2 && !fifo.FULL);
	fifo_edge(&fifo, true, true, 55);
	CHECK(fifo.Q && fifo.OUT == 22 && fifo.COUNT == 2);
	fifo_edge(&fifo, false, true, 0);
	fifo_edge(&fifo, false, true, 0);
	CHECK(fifo.OUT == 55 && fifo.EMPTY);
	fifo_edge(&fifo, false, true, 0);
	CHECK_AS(!fifo.Q && fifo.OUT == 55, "POP of an empty FIFO does not change OUT");
	fifo_edge(&fifo, true, true, 66);
	CHECK_AS(fifo.Q && fifo.OUT == 66 && fifo.EMPTY,
		 "PUSH and POP of an empty FIFO move IN to OUT");
	fifo_edge(&fifo, true, false, 1);
	fifo_edge(&fifo, true, false, 2);
	fifo_edge(&fifo, true, false, 3);
	fifo_edge(&fifo, true, true, 4);
	CHECK_AS(fifo.Q && fifo.OUT == 1 && fifo.FULL,
		 "PUSH and POP of a full FIFO take a value out first");
	fifo.R = 1;
	fifo_edge(&fifo, true, false, 5);
	fifo.R = 0;
	fb_FIFO_step(&fifo, 0);
	CHECK_AS(fifo.EMPTY && !fifo.Q, "an edge of PUSH during R stores nothing later");
}

static void fifo_goes_round(void)
{
	struct fb_FIFO fifo = { .SIZE = 500 };
	int32_t expected = 0;
	bool good = true;

	for (int i = 0; i < 64; i++)
		fifo_edge(&fifo, true, false, i);
	CHECK_AS(fifo.Q && fifo.FULL && fifo.COUNT == 64,
		 "a FIFO holds at most 64 values");
	for (int i = 64; i < 1000; i++) {
		fifo_edge(&fifo, true, true, i);
		good &= fifo.Q && fifo.OUT == expected++;
	}
	CHECK_AS(good, "values come out in order past the end of the ring");
	fifo.SIZE = 10;
	fb_FIFO_step(&fifo, 0);
	CHECK_AS(fifo.FULL && fifo.COUNT == 64, "a smaller SIZE keeps the stored values");
	fifo.SIZE = -3;
	fb_FIFO_step(&fifo, 0);
	CHECK(fifo.FULL);
	memset(&fifo, 0xff, sizeof(fifo));
	fb_FIFO_step(&fifo, 0);
	fifo_edge(&fifo, true, true, 9);
	fifo.R = 0;
	fifo_edge(&fifo, true, true, 9);
	CHECK_AS(fifo.Q == 1 && fifo.COUNT <= 64,
		 "COUNT is at most 64 whatever the instance held");
}

static void lifo_edge(struct fb_LIFO_REAL *lifo, bool in, bool out, float value)
{
	lifo->PUSH = lifo->POP = 0;
	fb_LIFO_REAL_step(lifo, 0);
	lifo->PUSH = in;
	lifo->POP = out;
	lifo->IN = value;
	fb_LIFO_REAL_step(lifo, 0);
}

static void lifo_turns_it_round(void)
{
	struct fb_LIFO_REAL lifo = { .SIZE = 2 };
	struct fb_LIFO whole = { .SIZE = 64, .PUSH = 1, .IN = -7 };
	struct fb_FIFO_REAL queue = { .SIZE = 64, .PUSH = 1, .POP = 1, .IN = 2.5f };

	lifo_edge(&lifo, true, false, 1.5f);
	lifo_edge(&lifo, true, false, 2.5f);
	lifo_edge(&lifo, true, false, 3.5f);
	CHECK(!lifo.Q && lifo.FULL && lifo.COUNT == 2);
	lifo_edge(&lifo, true, true, 4.5f);
	CHECK_AS(lifo.Q && lifo.OUT == 2.5f && lifo.COUNT == 2,
		 "PUSH and POP of a full LIFO take a value out first");
	lifo_edge(&lifo, false, true, 0.0f);
	CHECK(lifo.Q && lifo.OUT == 4.5f);
	lifo_edge(&lifo, true, true, 5.5f);
	CHECK_AS(lifo.OUT == 5.5f && lifo.COUNT == 1,
		 "PUSH and POP of a LIFO with room move IN to OUT");
	lifo_edge(&lifo, false, true, 0.0f);
	CHECK(lifo.OUT == 1.5f && lifo.EMPTY);
	lifo_edge(&lifo, true, false, __builtin_nanf(""));
	lifo_edge(&lifo, false, true, 0.0f);
	CHECK_AS(lifo.OUT != lifo.OUT, "a LIFO_REAL stores NaN");
	fb_LIFO_step(&whole, 0);
	whole.POP = 1;
	fb_LIFO_step(&whole, 0);
	CHECK(whole.Q && whole.OUT == -7 && whole.EMPTY);
	fb_FIFO_REAL_step(&queue, 0);
	CHECK(queue.Q && queue.OUT == 2.5f);
	memset(&lifo, 0xff, sizeof(lifo));
	lifo.R = 0;
	lifo_edge(&lifo, false, true, 0.0f);
	CHECK(lifo.Q == 1 && lifo.COUNT == 63);
}

static void clock_bit(struct fb_SHIFT *shift, bool bit)
{
	shift->CLK = 0;
	fb_SHIFT_step(shift, 0);
	shift->CLK = 1;
	shift->D = bit;
	fb_SHIFT_step(shift, 0);
}

static void shift_moves_bits(void)
{
	struct fb_SHIFT shift = { .N = 4 };

	clock_bit(&shift, true);
	clock_bit(&shift, false);
	clock_bit(&shift, true);
	CHECK(shift.W == 5 && !shift.Q);
	fb_SHIFT_step(&shift, 0);
	CHECK_AS(shift.W == 5, "CLK without a new edge shifts nothing");
	clock_bit(&shift, true);
	CHECK_AS(shift.W == 11 && shift.Q, "Q is the last of the N bits");
	clock_bit(&shift, false);
	CHECK_AS(shift.W == 6 && !shift.Q, "a bit shifted out is lost");
	shift.N = 2;
	fb_SHIFT_step(&shift, 0);
	CHECK(shift.W == 2 && shift.Q);
	shift.R = 1;
	clock_bit(&shift, true);
	shift.R = 0;
	fb_SHIFT_step(&shift, 0);
	CHECK_AS(shift.W == 0, "an edge of CLK during R shifts nothing later");
	shift.N = 64;
	shift.W = UINT64_MAX;
	clock_bit(&shift, false);
	CHECK(shift.W == UINT64_MAX - 1 && shift.Q);
	shift.N = 1000;
	fb_SHIFT_step(&shift, 0);
	CHECK(shift.W == UINT64_MAX - 1 && shift.Q);
	shift.N = INT16_MIN;
	fb_SHIFT_step(&shift, 0);
	CHECK_AS(shift.W == 0, "an N below 1 counts as 1");
	shift.D = shift.CLK = 0x80;
	shift.seen = 0;
	fb_SHIFT_step(&shift, 0);
	CHECK(shift.W == 1 && shift.Q == 1);
}

static void sema_gives_it_once(void)
{
	struct fb_SEMA sema = { .CLAIM = 1 };

	fb_SEMA_step(&sema, 0);
	CHECK_AS(!sema.BUSY, "the first CLAIM gets it: BUSY is FALSE");
	fb_SEMA_step(&sema, 0);
	CHECK_AS(sema.BUSY, "a second CLAIM does not get it: BUSY is TRUE");
	sema.CLAIM = 0;
	fb_SEMA_step(&sema, 0);
	CHECK(sema.BUSY);
	sema.CLAIM = sema.RELEASE = 1;
	fb_SEMA_step(&sema, 0);
	CHECK_AS(sema.BUSY && sema.taken, "CLAIM wins over RELEASE");
	sema.CLAIM = 0;
	fb_SEMA_step(&sema, 0);
	CHECK(!sema.BUSY && !sema.taken);
	sema.RELEASE = 0;
	sema.CLAIM = 1;
	fb_SEMA_step(&sema, 0);
	CHECK(!sema.BUSY);
	sema.taken = 0x80;
	fb_SEMA_step(&sema, 0);
	CHECK(sema.BUSY == 1);
}

/* Counts up at the highest value, down at the lowest, both, R and LD. */
#define LIMITS(type, low, high) do { \
	struct fb_CTU##type up = { .CU = 1, .CV = (high) - 1, .PV = high }; \
	struct fb_CTD##type down = { .CD = 1, .CV = (low) + 1 }; \
	struct fb_CTUD##type both = { .CU = 1, .CV = (high) - 1, .PV = high }; \
\
	fb_CTU##type##_step(&up, 0); \
	CHECK(up.CV == (high) && up.Q == 1); \
	up.seen = 0; \
	fb_CTU##type##_step(&up, 0); \
	CHECK_AS(up.CV == (high), "CTU" #type " stops at its highest value"); \
	up.R = 0x80; \
	up.PV = 1; \
	fb_CTU##type##_step(&up, 0); \
	CHECK(up.CV == 0 && !up.Q); \
	fb_CTD##type##_step(&down, 0); \
	CHECK(down.CV == (low) && down.Q == 1); \
	down.seen = 0; \
	fb_CTD##type##_step(&down, 0); \
	CHECK_AS(down.CV == (low), "CTD" #type " stops at its lowest value"); \
	down.LD = 1; \
	down.PV = high; \
	fb_CTD##type##_step(&down, 0); \
	CHECK(down.CV == (high) && !down.Q); \
	fb_CTUD##type##_step(&both, 0); \
	CHECK(both.CV == (high) && both.QU == 1 && !both.QD); \
	both.seen_up = 0; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK(both.CV == (high)); \
	both.CD = 1; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK(both.CV == (high) - 1); \
	both.CV = low; \
	both.seen_down = 0; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK(both.CV == (low) && both.QD == 1); \
	both.seen_up = both.seen_down = 0; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK_AS(both.CV == (low), "edges of CU and CD in one call do not change CV"); \
	both.LD = 1; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK(both.CV == (high)); \
	both.R = 1; \
	fb_CTUD##type##_step(&both, 0); \
	CHECK_AS(both.CV == 0, "CTUD" #type ": R wins over LD"); \
} while (0)

static void counters_stop_at_their_limits(void)
{
	LIMITS(, INT16_MIN, INT16_MAX);
	LIMITS(_DINT, INT32_MIN, INT32_MAX);
	LIMITS(_LINT, INT64_MIN, INT64_MAX);
	LIMITS(_UDINT, 0u, UINT32_MAX);
	LIMITS(_ULINT, 0u, UINT64_MAX);
}

int main(void)
{
	fifo_keeps_the_order();
	fifo_goes_round();
	lifo_turns_it_round();
	shift_moves_bits();
	sema_gives_it_once();
	counters_stop_at_their_limits();
	return tap_done();
}
