/* SPDX-License-Identifier: MIT
 *
 * session - writes a session as a scenario. The first scan is at t = period, and `at T`
 * acts before the first scan with t >= T. So an act after scan n is written at the time
 * of scan n + 1.
 */
#include "engine/trial/session.h"

#include "engine/trial/value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TIME_WIDE 16 /* bytes of "  at 120ms" and blanks                          */
#define LINE_LONG 84 /* bytes; longer lines are wrapped                          */

struct noted {
	uint64_t scan;   /* whose time is written                               */
	bool expect;
	char *text;      /* "Start = 1"                                         */
};
struct session {
	const struct image *image;
	int64_t period_ns;
	uint64_t speed;    /* words a millisecond; 0: scans take no time         */
	const char *plant; /* file; NULL: none                                  */
	struct noted *noted;
	int count, room, expects;
};

struct session *session_new(const struct image *image, int64_t period_ns)
{
	struct session *session = calloc(1, sizeof(*session));

	if (!session)
		return NULL;
	session->image = image;
	session->period_ns = period_ns;
	return session;
}

void session_free(struct session *session)
{
	if (!session)
		return;
	for (int i = 0; i < session->count; i++)
		free(session->noted[i].text);
	free(session->noted);
	free(session);
}

void session_speed(struct session *session, uint64_t speed)
{
	session->speed = speed;
}

void session_plant(struct session *session, const char *name)
{
	session->plant = name;
}

int session_acts(const struct session *session)
{
	return session->count - session->expects;
}

int session_expects(const struct session *session)
{
	return session->expects;
}

/* ---- names ---- */

static bool is_same(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where && a.number == b.number &&
	       a.first == b.first;
}

static bool is_found(const struct image *image, const char *name, struct location at)
{
	enum diag_id why;

	return is_same(value_find(image, name, strlen(name), &why), at);
}

/* A separate frame: the cursor holds a name. */
__attribute__((noinline))
static bool find_symbol(const struct image *image, struct location at, bool whole,
			char *out)
{
	struct symbol_cursor cursor = { .whole = whole };
	struct symbol symbol;

	while (image_next_symbol(image, &cursor, &symbol)) {
		if (symbol.flags & SYMBOL_HIDDEN || !is_same(symbol.at, at) ||
		    strlen(symbol.name) >= SESSION_NAME ||
		    !is_found(image, symbol.name, at))
			continue;
		snprintf(out, SESSION_NAME, "%s", symbol.name);
		return true;
	}
	return false;
}

static bool print_address(const struct image *image, struct location at, char *out)
{
	const struct areas *areas = &image->program->areas;
	struct iec_addr addr = { .area = at.area, .bits = 1, .bit = at.where % 8,
				 .byte = at.where / 8 };

	if (at.area == AREA_NONE) {
		addr.area = areas_find(areas, at.where);
		if (addr.area == AREA_NONE)
			return false;
		addr.bit = 0;
		addr.bits = (uint8_t)(8 * iec_type_size(at.type, 0));
		addr.byte = at.where - areas->at[addr.area];
	}
	iec_addr_print(addr, out, SESSION_NAME);
	return is_found(image, out, at);
}

/* The name of a variable in a scenario: one that value_find() finds, else its address.
 * @out: SESSION_NAME bytes. Scan-safe: no.
 * Fails: false: it has none. */
static bool session_name(const struct image *image, struct location at, char *out)
{
	return find_symbol(image, at, false, out) || find_symbol(image, at, true, out) ||
	       print_address(image, at, out);
}

/* ---- notes ---- */

static bool print_value(struct location at, union iec_value value, char *out, size_t size)
{
	if (iec_type_row(at.type)->class == CLASS_REAL && !isfinite(value.r))
		return false;
	if (at.type == IEC_BOOL)
		iec_value_print(at.type, value, out, size);
	else
		literal_print(at.type, value, out, size);
	return true;
}

static struct noted *add(struct session *session)
{
	const int room = session->room ? 2 * session->room : 64;
	struct noted *noted;

	if (session->count == session->room) {
		noted = realloc(session->noted, (size_t)room * sizeof(*noted));
		if (!noted)
			return NULL;
		session->noted = noted;
		session->room = room;
	}
	return &session->noted[session->count];
}

/* "Start = 1"; NULL: a scenario cannot express it. */
static char *say(const struct image *image, struct location at, union iec_value value)
{
	const size_t size = SESSION_NAME + 3 + IEC_VALUE_TEXT;
	char *text = malloc(size);
	size_t len;

	if (!text || !session_name(image, at, text)) {
		free(text);
		return NULL;
	}
	len = strlen(text);
	len += (size_t)snprintf(text + len, size - len, " = ");
	if (!print_value(at, value, text + len, size - len)) {
		free(text);
		return NULL;
	}
	return text;
}

static bool note(struct session *session, uint64_t scan, bool expect, struct location at,
		 union iec_value value)
{
	struct noted *noted = add(session);
	char *text = noted ? say(session->image, at, value) : NULL;

	if (!text)
		return false;
	*noted = (struct noted){ scan, expect, text };
	session->count++;
	session->expects += expect;
	return true;
}

/* Whether a scenario can express the act. A start before the first scan, and an
 * unchanged period, need no statement. */
static bool session_can_hold(const struct session *session, uint64_t after,
			     const struct act *act)
{
	if (act->plant)
		return false;
	switch (act->kind) {
	case ACT_SET: return true;
	case ACT_START: return after == 0 && session->count == 0;
	case ACT_PERIOD: return act->value.i == session->period_ns;
	case ACT_SPEED: return (uint64_t)act->value.i == session->speed;
	case ACT_FORCE: case ACT_RELEASE: case ACT_RELEASE_ALL: case ACT_WARM: case ACT_STOP:
		break;
	}
	return false;
}

bool session_act(struct session *session, uint64_t after, const struct act *act)
{
	if (!session_can_hold(session, after, act))
		return false;
	return act->kind != ACT_SET ||
	       note(session, after + 1, false, act->at, act->value);
}

bool session_expect(struct session *session, uint64_t scan, struct location at,
		    union iec_value value)
{
	return scan > 0 && note(session, scan, true, at, value);
}

/* ---- writing ---- */

/* Settings of a scan come before its expectations; each kind in its order. */
static int by_time(const void *left, const void *right)
{
	const struct noted *a = *(const struct noted *const *)left;
	const struct noted *b = *(const struct noted *const *)right;

	if (a->scan != b->scan)
		return a->scan < b->scan ? -1 : 1;
	if (a->expect != b->expect)
		return a->expect ? 1 : -1;
	return a < b ? -1 : a > b; /* pointers into one array: their order */
}

static void write_name(const char *name, const struct sink *out)
{
	for (; *name; name++) {
		const char letter = *name == '"' ? '\'' :
				    (unsigned char)*name < ' ' ? ' ' : *name;

		sink_write(out, &letter, 1);
	}
}

/* "  at 120ms    " or as many blanks. */
static void write_time(const struct session *session, const struct noted *noted,
		       bool same, const struct sink *out)
{
	char time[48], text[64];
	int len;

	if (same) {
		sink_printf(out, "%16s", "");
		return;
	}
	literal_print_time((int64_t)noted->scan * session->period_ns, time, sizeof(time));
	len = snprintf(text, sizeof(text), "  at %-10s ", time + 2); /* T# */
	sink_write(out, text, (size_t)len);
}

/* The notes in order; NULL: no memory, or there are none. */
static const struct noted **sorted(const struct session *session)
{
	const struct noted **order = session->count ?
		malloc((size_t)session->count * sizeof(*order)) : NULL;

	for (int i = 0; order && i < session->count; i++)
		order[i] = &session->noted[i];
	if (order)
		qsort(order, (size_t)session->count, sizeof(*order), by_time);
	return order;
}

static void write_notes(const struct session *session, const struct noted *const *order,
			const struct sink *out)
{
	size_t len = 0;

	for (int i = 0; i < session->count; i++) {
		const struct noted *noted = order[i], *last = i ? order[i - 1] : NULL;
		const bool same = last && last->scan == noted->scan;

		if (same && last->expect == noted->expect &&
		    len + strlen(noted->text) < LINE_LONG) {
			sink_text(out, ", ");
		} else {
			if (last)
				sink_text(out, "\n");
			write_time(session, noted, same, out);
			sink_text(out, noted->expect ? "expect " : "");
			len = TIME_WIDE;
		}
		sink_text(out, noted->text);
		len += 2 + strlen(noted->text);
	}
	if (session->count)
		sink_text(out, "\n");
}

bool session_write(const struct session *session, const char *name,
		   const struct sink *out)
{
	const struct noted **order = sorted(session);
	char period[48];

	if (session->count && !order)
		return false;
	literal_print_time(session->period_ns, period, sizeof(period));
	sink_text(out, "scenario \"");
	write_name(name, out);
	sink_printf(out, "\"\n  period %s\n", period + 2); /* T# */
	if (session->speed)
		sink_printf(out, "  speed %llu\n", (unsigned long long)session->speed);
	if (session->plant) {
		sink_text(out, "  plant \"");
		write_name(session->plant, out);
		sink_text(out, "\"\n");
	}
	write_notes(session, order, out);
	free(order);
	return true;
}
