/* SPDX-License-Identifier: MIT
 *
 * engine_block - timers, monostables, counters and registers of ClassicLadder.
 *
 * With engine->faithful also their faults: F1 a timer keeps its remainder, F2 it counts at
 * most one unit a scan, F3 a monostable cannot start again, F6 a register has a place too
 * many.
 */
#include "tests/classic/engine.h"

static int32_t less(int32_t value, int32_t by)
{
	return (int32_t)((uint32_t)value - (uint32_t)by);
}

static void old_timer(const struct engine *engine, struct old_timer *timer,
		      const bool in[4], bool out[4])
{
	if (!in[0]) {
		timer->value = timer->preset;
		timer->done = timer->running = false;
	} else if (timer->value > 0) {
		if (in[1]) {
			timer->value = less(timer->value, engine->period);
			timer->running = true;
			timer->done = false;
		}
	} else {
		timer->running = false;
		timer->done = true;
	}
	out[0] = timer->done;
	out[1] = timer->running;
}

static void monostable(const struct engine *engine, struct monostable *mono,
		       const bool in[4], bool out[4])
{
	if (in[0] && !mono->before && mono->value == 0) {
		mono->running = true;
		mono->value = mono->preset;
	}
	mono->before = in[0];
	if (mono->value > 0)
		mono->value = less(mono->value, engine->period);
	else
		mono->running = false;
	if (mono->value < 0 && !engine->faithful) /* F3 */
		mono->value = 0;
	out[0] = mono->running;
}

static void start_again(const struct engine *engine, struct iec_timer *iec)
{
	iec->value = 0;
	if (!engine->faithful) /* F1 */
		iec->rest = 0;
}

static void count_time(const struct engine *engine, struct iec_timer *iec)
{
	int32_t units, room = iec->preset - iec->value;

	iec->rest += engine->period;
	units = iec->rest / iec->base;
	if (engine->faithful && units > 1) /* F2 */
		units = 1;
	iec->rest -= units * iec->base;
	iec->value += units < room ? units : room;
}

static void iec_timer(const struct engine *engine, struct iec_timer *iec,
		      const bool in[4], bool out[4])
{
	bool rising = in[0] && !iec->before;

	iec->before = in[0];
	if (iec->mode == 0) {
		if (!in[0]) {
			iec->q = false;
			start_again(engine, iec);
		} else if (iec->value >= iec->preset) {
			iec->q = true;
		} else {
			count_time(engine, iec);
		}
	} else if (iec->mode == 1 && in[0]) {
		iec->q = true;
		start_again(engine, iec);
	} else {
		if (iec->mode == 2 && rising)
			iec->q = true;
		if (iec->q && iec->value >= iec->preset) {
			iec->q = false;
			start_again(engine, iec);
		} else if (iec->q) {
			count_time(engine, iec);
		}
	}
	out[0] = iec->q;
}

static void change(struct counter *counter, int32_t value)
{
	counter->last = counter->value;
	counter->value = value;
}

static void count(struct counter *counter, const bool in[4], bool out[4])
{
	if (in[2] && !counter->up)
		change(counter, counter->value >= 9999 ? 0 : counter->value + 1);
	if (in[3] && !counter->down)
		change(counter, counter->value <= 0 ? 9999 : counter->value - 1);
	counter->up = in[2];
	counter->down = in[3];
	if (in[1])
		change(counter, counter->preset);
	if (in[0])
		change(counter, 0);
	counter->done = counter->value == counter->preset;
	counter->empty = counter->value == 9999 && counter->last == 0;
	counter->full = counter->value == 0 && counter->last == 9999;
	out[0] = counter->empty;
	out[1] = counter->done;
	out[2] = counter->full;
}

/* The next place in the ring of a register (F6). */
static int32_t behind(const struct engine *engine, int32_t at)
{
	int32_t slots = engine->project->register_list + (engine->faithful ? 1 : 0);

	return at + 1 >= slots ? 0 : at + 1;
}

static void fifo(struct engine *engine, int number, const bool in[4], bool out[4])
{
	struct fifo *fifo = &engine->fifo[number];
	int32_t size = engine->project->register_list;
	int32_t *list = engine->list + (ptrdiff_t)number * size;
	bool push = in[1] && !fifo->push, pop = in[2] && !fifo->pop;

	fifo->push = in[1];
	fifo->pop = in[2];
	if (number >= engine->fifos)
		return;
	if (in[0]) {
		fifo->put = fifo->get = fifo->count = fifo->out = 0;
	} else {
		if (push && fifo->count < size) {
			list[fifo->put] = fifo->in;
			fifo->put = behind(engine, fifo->put);
			fifo->count++;
		}
		if (pop && fifo->count > 0) {
			fifo->count--;
			if (fifo->mode == 2) {
				fifo->put = fifo->put ? fifo->put - 1 : size - 1;
				fifo->out = list[fifo->put];
			} else {
				fifo->out = list[fifo->get];
				fifo->get = behind(engine, fifo->get);
			}
		}
	}
	out[0] = fifo->empty = fifo->count == 0;
	out[1] = fifo->full = fifo->count >= size;
}

void engine_block(struct engine *engine, int element, int number, const bool in[4],
		  bool out[4])
{
	switch (element) {
	case 10:
		old_timer(engine, &engine->timer[number], in, out);
		break;
	case 11:
		monostable(engine, &engine->mono[number], in, out);
		break;
	case 12:
		count(&engine->counter[number], in, out);
		break;
	case 13:
		iec_timer(engine, &engine->iec[number], in, out);
		break;
	default:
		fifo(engine, number, in, out);
		break;
	}
}
