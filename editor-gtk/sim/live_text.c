/* SPDX-License-Identifier: MIT
 *
 * live_text - values as people read them on a sheet: times with a unit that fits.
 *
 * Short, since there is little room; traces have all digits (iec_value_print()).
 */
#include "editor-gtk/sim/live_inside.h"

#include <string.h>

#define MS G_GINT64_CONSTANT(1000000)
#define S  (1000 * MS)

/* The unit that its size asks for. */
enum unit { UNIT_MS, UNIT_S, UNIT_MINUTES, UNIT_HOURS };

static enum unit unit_of(int64_t ns)
{
	const guint64 size = ns < 0 ? 0 - (guint64)ns : (guint64)ns;

	return size < S ? UNIT_MS : size < 100 * S ? UNIT_S :
	       size < 3600 * S ? UNIT_MINUTES : UNIT_HOURS;
}

static void print_time(int64_t ns, enum unit unit, char *out, size_t size)
{
	const guint64 ms = (ns < 0 ? 0 - (guint64)ns : (guint64)ns) / MS;
	const char *sign = ns < 0 ? "-" : "";
	const guint64 s = ms / 1000;

	if (unit == UNIT_MS)
		g_snprintf(out, size, "%s%" G_GUINT64_FORMAT, sign, ms);
	else if (unit == UNIT_S)
		g_snprintf(out, size, "%s%" G_GUINT64_FORMAT ".%d", sign, s,
			   (int)(ms % 1000 / 100));
	else if (unit == UNIT_MINUTES)
		g_snprintf(out, size, "%s%" G_GUINT64_FORMAT ":%02d", sign, s / 60,
			   (int)(s % 60));
	else
		g_snprintf(out, size, "%s%" G_GUINT64_FORMAT ":%02d:%02d", sign, s / 3600,
			   (int)(s / 60 % 60), (int)(s % 60));
}

static const char *unit_name(enum unit unit)
{
	return unit == UNIT_MS ? " ms" : unit == UNIT_S ? " s" : "";
}

static void print_real(double value, char *out, size_t size)
{
	char text[G_ASCII_DTOSTR_BUF_SIZE];

	g_strlcpy(out, g_ascii_formatd(text, sizeof(text), "%.6g", value), size);
}

/* Cut between two characters. */
static void print_long(enum iec_type type, union iec_value value, char *out, size_t size)
{
	char text[IEC_VALUE_TEXT + 1], *whole;

	iec_value_print(type, value, text, sizeof(text));
	whole = g_utf8_make_valid(text, -1);
	g_strlcpy(out, whole, size);
	if (strlen(whole) >= size)
		*g_utf8_find_prev_char(out, out + strlen(out)) = '\0';
	g_free(whole);
}

void live_value_print(enum iec_type type, union iec_value value, char *out, size_t size)
{
	char time[32];

	if (type == IEC_BOOL)
		g_strlcpy(out, value.i ? "TRUE" : "FALSE", size);
	else if (type == IEC_REAL || type == IEC_LREAL)
		print_real(value.r, out, size);
	else if (type == IEC_TIME) {
		print_time(value.i, unit_of(value.i), time, sizeof(time));
		g_snprintf(out, size, "%s%s", time, unit_name(unit_of(value.i)));
	} else
		print_long(type, value, out, size);
}

void live_count_print(enum iec_type type, union iec_value value, union iec_value goal,
		      char *out, size_t size)
{
	const enum unit unit = unit_of(goal.i);
	char now[32], aim[32];

	if (type == IEC_TIME && unit == UNIT_HOURS) { /* there is no room for both */
		print_time(value.i, unit, out, size);
	} else if (type == IEC_TIME) {
		print_time(value.i, unit, now, sizeof(now));
		print_time(goal.i, unit, aim, sizeof(aim));
		g_snprintf(out, size, "%s/%s%s", now, aim, unit_name(unit));
	} else {
		live_value_print(type, value, now, sizeof(now));
		live_value_print(type, goal, aim, sizeof(aim));
		g_snprintf(out, size, "%s/%s", now, aim);
	}
}
