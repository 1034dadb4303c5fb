/* SPDX-License-Identifier: MIT
 *
 * blocks_more - the walker's own blocks beyond the standard.
 *
 * Written from docs/blocks.md, not from the engine: with loops and shifted values where
 * the engine computes directly. Values at pins are not checked.
 */
#include "tests/walker/inside.h"

#include <math.h>
#include <string.h>
#include <time.h>

static double real(const struct block *block, const char *name)
{
	return (double)block->pin[block_pin(block, name)].r;
}

/* Whether all REAL inputs in @names are finite. */
static bool are_numbers(const struct block *block, const char *const *names)
{
	for (; *names; names++)
		if (!isfinite(real(block, *names)))
			return false;
	return true;
}

/* Stores a result and ENO TRUE, or only ENO FALSE. */
static void give(struct block *block, bool good, double out)
{
	good = good && fabs(out) <= (double)3.40282346638528859812e38f;
	if (good)
		block->pin[block_pin(block, "OUT")].r = (float)out;
	block_set(block, "ENO", good);
}

static int64_t time_of(const struct block *block, const char *name)
{
	return block_get(block, name) > 0 ? block_get(block, name) : 0;
}

/* ---- time ---- */

static void call_tonr(struct block *block, int64_t now_ns)
{
	int64_t pt = time_of(block, "PT"), et = block_get(block, "ET");
	bool in = block_get(block, "IN");

	if (block->was)
		et += now_ns - block->start_ns;
	if (et > pt)
		et = pt;
	if (block->was || in) {
		block_set(block, "ET", et);
		block_set(block, "Q", et == pt);
	}
	if (block_get(block, "R")) {
		block_set(block, "ET", 0);
		block_set(block, "Q", 0);
	}
	block->was = in;
	block->start_ns = now_ns;
}

static void call_debounce(struct block *block, int64_t now_ns)
{
	bool in = block_get(block, "IN");

	if (in == (block_get(block, "Q") != 0)) {
		block->busy = false;
		return;
	}
	if (!block->busy)
		block->start_ns = now_ns;
	block->busy = true;
	if (now_ns - block->start_ns < time_of(block, in ? "T_ON" : "T_OFF"))
		return;
	block_set(block, "Q", in);
	block->busy = false;
}

static void call_blink(struct block *block, int64_t now_ns)
{
	int64_t on = time_of(block, "TH"), off = time_of(block, "TL");

	if (!block_get(block, "EN") || on + off == 0) {
		block->busy = false;
		block_set(block, "Q", 0);
		return;
	}
	if (!block->busy)
		block->start_ns = now_ns;
	block->busy = true;
	while (now_ns - block->start_ns >= on + off)
		block->start_ns += on + off;
	block_set(block, "Q", now_ns - block->start_ns < on);
}

static void begin_pulse(struct block *block)
{
	int64_t period = block_get(block, "PERIOD"), on;
	double duty = real(block, "DUTY");

	duty = duty < 0 ? 0 : duty > 100 ? 100 : duty;
	on = duty >= 100 ? period : (int64_t)((double)period * (duty / 100));
	if (on < block_get(block, "MIN_ON"))
		on = 0;
	else if (on > 0 && period - on < block_get(block, "MIN_OFF"))
		on = period;
	block->exact = (double)on;
}

static void call_pwm(struct block *block, int64_t now_ns)
{
	int64_t period = block_get(block, "PERIOD");
	bool begins = !block->busy;

	if (!block_get(block, "EN") || period <= 0) {
		block->busy = false;
		block_set(block, "Q", 0);
		return;
	}
	if (begins)
		block->start_ns = now_ns;
	while (now_ns - block->start_ns >= period) {
		block->start_ns += period;
		begins = true;
	}
	if (begins && isfinite(real(block, "DUTY")))
		begin_pulse(block);
	block->busy = true;
	block_set(block, "Q", (double)(now_ns - block->start_ns) < block->exact);
}

/* By the calendar of the C library. */
static void call_alarm(struct block *block)
{
	int64_t now = block_get(block, "NOW"), second = 1000000000, of_day;
	int64_t on = block_get(block, "ON"), off = block_get(block, "OFF");
	int64_t days = block_get(block, "DAYS");
	time_t whole = (time_t)(now / second - (now % second < 0));
	struct tm date;
	bool today, yesterday, q;

	gmtime_r(&whole, &date);
	of_day = (date.tm_hour * 3600 + date.tm_min * 60 + date.tm_sec) * second +
		 (now - (int64_t)whole * second);
	today = days >> (date.tm_wday + 6) % 7 & 1;
	yesterday = days >> (date.tm_wday + 5) % 7 & 1;
	q = on < off ? today && of_day >= on && of_day < off :
	    on > off ? (today && of_day >= on) || (yesterday && of_day < off) :
		       false;
	block_set(block, "Q", block_get(block, "EN") && q);
}

/* Of one programme: does it begin today or yesterday, and has not ended yet? */
static bool programme(struct block *block, char number, const struct tm *date, int64_t of_day)
{
	const char days[] = { 'D', 'A', 'Y', 'S', number, 0 }, on[] = { 'O', 'N', number, 0 };
	const char off[] = { 'O', 'F', 'F', number, 0 };
	const int64_t marked = block_get(block, days), from = block_get(block, on);
	const int64_t until = block_get(block, off);

	for (int back = 0; back <= 1; back++) {
		const int64_t at = of_day + back * INT64_C(86400000000000);
		const int64_t end = until < from ? until + INT64_C(86400000000000) : until;

		if (marked >> (date->tm_wday + 6 - back) % 7 & 1 && at >= from && at < end)
			return true;
	}
	return false;
}

static int64_t calendar(struct block *block, struct tm *date)
{
	int64_t now = block_get(block, "NOW"), second = 1000000000;
	time_t whole = (time_t)(now / second - (now % second < 0));

	gmtime_r(&whole, date);
	return (date->tm_hour * 3600 + date->tm_min * 60 + date->tm_sec) * second +
	       (now - (int64_t)whole * second);
}

static void call_week(struct block *block)
{
	struct tm date;
	int64_t of_day = calendar(block, &date);

	block_set(block, "Q", block_get(block, "EN") &&
		  (programme(block, '1', &date, of_day) || programme(block, '2', &date, of_day) ||
		   programme(block, '3', &date, of_day)));
}

/* Goes through the days of a leap year, from the first day on, until today or the last. */
static void call_year(struct block *block)
{
	static const char lengths[] = { 31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
	int64_t month = block_get(block, "FROM_MONTH"), day = block_get(block, "FROM_DAY");
	const int64_t last_month = block_get(block, "TO_MONTH"), last = block_get(block, "TO_DAY");
	bool good = block_get(block, "EN"), today = false;
	struct tm date;

	calendar(block, &date);
	good = good && month >= 1 && month <= 12 && last_month >= 1 && last_month <= 12 &&
	       day >= 1 && last >= 1 && day <= lengths[month - 1] && last <= lengths[last_month - 1];
	block_set(block, "ENO", good);
	for (int i = 0; good && i < 366; i++) {
		today = today || (month == date.tm_mon + 1 && day == date.tm_mday);
		if (month == last_month && day == last)
			break;
		if (++day > lengths[month - 1]) {
			day = 1;
			month = month % 12 + 1;
		}
	}
	block_set(block, "Q", today);
}

/* ---- stores ---- */

static int at_most_64(int64_t number)
{
	return number < 1 ? 1 : number > 64 ? 64 : (int)number;
}

static bool push(struct block *block)
{
	if (block->count >= at_most_64(block_get(block, "SIZE")))
		return false;
	block->held[block->count++] = block->pin[block_pin(block, "IN")];
	return true;
}

/* The oldest is first; the others move up. */
static bool pop(struct block *block, bool newest)
{
	int at = newest ? block->count - 1 : 0;

	if (block->count == 0)
		return false;
	block->pin[block_pin(block, "OUT")] = block->held[at];
	block->count--;
	memmove(&block->held[at], &block->held[at + 1],
		(size_t)(block->count - at) * sizeof(block->held[0]));
	return true;
}

static void call_store(struct block *block, bool newest)
{
	bool in = block_rises(block_get(block, "PUSH"), &block->was);
	bool out = block_rises(block_get(block, "POP"), &block->was_too);
	int size = at_most_64(block_get(block, "SIZE"));
	bool done = in || out;

	if (block_get(block, "R")) {
		block->count = 0;
		done = false;
	} else if (in && out && block->count >= size) {
		pop(block, newest);
		done = push(block);
	} else {
		if (in)
			done = push(block);
		if (out)
			done = pop(block, newest) && done;
	}
	block_set(block, "Q", done);
	block_set(block, "COUNT", block->count);
	block_set(block, "EMPTY", block->count == 0);
	block_set(block, "FULL", block->count >= size);
}

static void call_shift(struct block *block)
{
	bool edge = block_rises(block_get(block, "CLK"), &block->was);
	uint64_t w = (uint64_t)block_get(block, "W"), kept = 0, last;
	int bits = at_most_64(block_get(block, "N"));

	if (block_get(block, "R"))
		w = 0;
	else if (edge)
		w = w * 2 + (block_get(block, "D") != 0);
	last = 1;
	for (int i = 0; i < bits; i++) {
		last = (uint64_t)1 << i;
		kept |= w & last;
	}
	block_set(block, "W", (int64_t)kept);
	block_set(block, "Q", (kept & last) != 0);
}

static void call_sema(struct block *block)
{
	bool busy = block->was;

	if (block_get(block, "CLAIM"))
		block->was = true;
	else if (block_get(block, "RELEASE"))
		block->was = busy = false;
	block_set(block, "BUSY", busy);
}

/* ---- numbers ---- */

static void call_hysteresis(struct block *block)
{
	static const char *const inputs[] = { "IN", "ON", "OFF", NULL };
	double in = real(block, "IN"), on = real(block, "ON");
	double off = real(block, "OFF");

	if (!block_get(block, "EN")) {
		block_set(block, "Q", 0);
	} else if (are_numbers(block, inputs)) {
		if (on >= off ? in >= on : in <= on)
			block_set(block, "Q", 1);
		else if (on >= off ? in <= off : in >= off)
			block_set(block, "Q", 0);
	}
}

static void call_deadband(struct block *block)
{
	static const char *const inputs[] = { "IN", "WIDTH", NULL };
	double in = real(block, "IN"), width = fmax(real(block, "WIDTH"), 0.0);
	double out = 0.0;

	if (fabs(in) > width)
		out = in > 0 ? in - width : in + width;
	give(block, block_get(block, "EN") && are_numbers(block, inputs), out);
}

static void call_scale(struct block *block)
{
	static const char *const inputs[] = { "IN", "GAIN", "OFFSET", NULL };

	give(block, block_get(block, "EN") && are_numbers(block, inputs),
	     real(block, "GAIN") * real(block, "IN") + real(block, "OFFSET"));
}

static void call_range(struct block *block)
{
	static const char *const inputs[] = { "IN", "IN_MIN", "IN_MAX", "OUT_MIN",
					      "OUT_MAX", NULL };
	double low = real(block, "OUT_MIN"), high = real(block, "OUT_MAX");
	double width = real(block, "IN_MAX") - real(block, "IN_MIN");
	double out = low + (real(block, "IN") - real(block, "IN_MIN")) *
			   (high - low) / width;

	if (block_get(block, "CLIP"))
		out = fmax(fmin(low, high), fmin(fmax(low, high), out));
	give(block, block_get(block, "EN") && are_numbers(block, inputs) &&
		    width != 0, out);
}

static void call_ramp(struct block *block, int64_t now_ns)
{
	static const char *const inputs[] = { "IN", "UP", "DOWN", NULL };
	double seconds = block->busy ? (double)(now_ns - block->start_ns) / 1e9 : 0;
	double in = real(block, "IN"), at = block->exact;

	block->busy = block_get(block, "EN");
	block->start_ns = now_ns;
	if (!block->busy || !are_numbers(block, inputs)) {
		block_set(block, "ENO", 0);
		return;
	}
	if (block_get(block, "LOAD"))
		at = in;
	else if (in > at)
		at = fmin(in, at + fmax(real(block, "UP"), 0) * seconds);
	else
		at = fmax(in, at - fmax(real(block, "DOWN"), 0) * seconds);
	block->exact = at;
	block_set(block, "DONE", at == in);
	give(block, true, at);
}

/* The newest value is first. */
static void call_average(struct block *block)
{
	int most = at_most_64(block_get(block, "N")), count;
	double sum = 0;

	if (block_get(block, "R")) {
		block->count = 0;
		block_set(block, "COUNT", 0);
	}
	if (!block_get(block, "EN") || block_get(block, "R") ||
	    !isfinite(real(block, "IN"))) {
		block_set(block, "ENO", 0);
		return;
	}
	memmove(&block->held[1], &block->held[0],
		sizeof(block->held) - sizeof(block->held[0]));
	block->held[0] = block->pin[block_pin(block, "IN")];
	block->count += block->count < 64;
	count = block->count < most ? block->count : most;
	for (int i = 0; i < count; i++)
		sum += (double)block->held[i].r;
	block_set(block, "COUNT", count);
	give(block, true, sum / count);
}

/* ---- PID: the table of docs/blocks.md, line by line ---- */

static double limited(const struct block *block, double out)
{
	return fmax(real(block, "MIN"), fmin(real(block, "MAX"), out));
}

/* exact: I; smooth: y; was: it has worked before. */
static void control(struct block *block, double dt, bool fresh)
{
	double k = block_get(block, "INVERT") ? -real(block, "KP") : real(block, "KP");
	double pv = real(block, "PV"), n = fmax(real(block, "N"), 1);
	double td = (double)time_of(block, "TD") / 1e9 / n;
	double ti = (double)time_of(block, "TI") / 1e9;
	double p = k * (real(block, "SP") - pv), pd, step, room;
	bool manual = block_get(block, "MANUAL");

	if (fresh || td == 0)
		block->smooth = pv;
	else
		block->smooth += (pv - block->smooth) * (dt / (td + dt));
	pd = p - k * n * (pv - block->smooth);
	if (manual)
		block->exact = limited(block, real(block, "MAN")) - pd;
	else if (fresh && block->was)
		block->exact = limited(block, real(block, "OUT")) - pd;
	if (ti == 0) {
		block->exact = 0;
	} else if (!manual) {
		step = p * (dt / ti);
		room = (step > 0 ? real(block, "MAX") : real(block, "MIN")) - pd;
		if (step > 0 && block->exact + step > room)
			block->exact = fmax(block->exact, room);
		else if (step < 0 && block->exact + step < room)
			block->exact = fmin(block->exact, room);
		else
			block->exact += step;
	}
	block->was = true;
	give(block, true, limited(block, manual ? real(block, "MAN") :
						  pd + block->exact));
	block_set(block, "HI", real(block, "OUT") >= real(block, "MAX"));
	block_set(block, "LO", real(block, "OUT") <= real(block, "MIN"));
}

static void call_pid(struct block *block, int64_t now_ns)
{
	static const char *const inputs[] = { "SP", "PV", "KP", "N", "MIN", "MAX",
					      NULL };
	double dt = block->busy ? (double)(now_ns - block->start_ns) / 1e9 : 0;
	bool fresh = !block->busy;

	block->busy = block_get(block, "EN");
	block->start_ns = now_ns;
	if (!block->busy || !are_numbers(block, inputs) ||
	    (block_get(block, "MANUAL") && !isfinite(real(block, "MAN"))) ||
	    real(block, "MIN") > real(block, "MAX"))
		block_set(block, "ENO", 0);
	else
		control(block, dt, fresh);
}

void block_call_more(struct block *block, int64_t now_ns)
{
	const char *word = word_row(block->fb)->word;

	if (strcmp(word, "TONR") == 0)
		call_tonr(block, now_ns);
	else if (strcmp(word, "DEBOUNCE") == 0)
		call_debounce(block, now_ns);
	else if (strcmp(word, "BLINK") == 0)
		call_blink(block, now_ns);
	else if (strcmp(word, "PWM") == 0)
		call_pwm(block, now_ns);
	else if (strcmp(word, "RTC_ALARM") == 0)
		call_alarm(block);
	else if (strcmp(word, "WEEK_TIMER") == 0)
		call_week(block);
	else if (strcmp(word, "YEAR_TIMER") == 0)
		call_year(block);
	else if (strncmp(word, "FIFO", 4) == 0)
		call_store(block, false);
	else if (strncmp(word, "LIFO", 4) == 0)
		call_store(block, true);
	else if (strcmp(word, "SHIFT") == 0)
		call_shift(block);
	else if (strcmp(word, "SEMA") == 0)
		call_sema(block);
	else if (strcmp(word, "HYSTERESIS") == 0)
		call_hysteresis(block);
	else if (strcmp(word, "DEADBAND") == 0)
		call_deadband(block);
	else if (strcmp(word, "SCALE") == 0)
		call_scale(block);
	else if (strcmp(word, "SCALE_RANGE") == 0)
		call_range(block);
	else if (strcmp(word, "RAMP") == 0)
		call_ramp(block, now_ns);
	else if (strcmp(word, "AVERAGE") == 0)
		call_average(block);
	else if (strcmp(word, "PID") == 0)
		call_pid(block, now_ns);
}
