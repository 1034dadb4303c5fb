/* SPDX-License-Identifier: MIT
 *
 * words_block - random function blocks and their pins.
 *
 * The parameters are valid, and near the limits of behaviour.
 */
#include "tests/walker/words.h"

#include "engine/base/catalog.h"

#include <string.h>

static const char *const instance[][2] = {
	{ "ton_a", "TON" }, { "ton_b", "TON" }, { "tof_a", "TOF" },
	{ "tof_b", "TOF" }, { "tp_a", "TP" }, { "tp_b", "TP" },
	{ "ctu_a", "CTU" }, { "ctu_b", "CTU" }, { "ctd_a", "CTD" },
	{ "ctud_a", "CTUD" }, { "sr_a", "SR" }, { "sr_b", "SR" },
	{ "rs_a", "RS" }, { "rt_a", "R_TRIG" }, { "ft_a", "F_TRIG" },
	{ "ft_b", "F_TRIG" }, { "ctu_c", "CTU_DINT" }, { "ctu_d", "CTU_ULINT" },
	{ "ctd_b", "CTD_UDINT" }, { "ctd_c", "CTD_LINT" },
	{ "ctud_b", "CTUD_UDINT" }, { "ctud_c", "CTUD_ULINT" },
};
#define INSTANCES (sizeof(instance) / sizeof(*instance))

/* Blocks of docs/blocks.md: their pins are taken from their rows. */
static const char *const more[][2] = {
	{ "tonr_a", "TONR" }, { "deb_a", "DEBOUNCE" }, { "deb_b", "DEBOUNCE" },
	{ "blink_a", "BLINK" }, { "pwm_a", "PWM" }, { "pwm_b", "PWM" },
	{ "rtc_a", "RTC_ALARM" }, { "week_a", "WEEK_TIMER" }, { "year_a", "YEAR_TIMER" },
	{ "sema_a", "SEMA" }, { "fifo_a", "FIFO" },
	{ "lifo_a", "LIFO" }, { "fifo_r", "FIFO_REAL" }, { "lifo_r", "LIFO_REAL" },
	{ "shift_a", "SHIFT" }, { "hyst_a", "HYSTERESIS" }, { "dead_a", "DEADBAND" },
	{ "ramp_a", "RAMP" }, { "ramp_b", "RAMP" }, { "scale_a", "SCALE" },
	{ "range_a", "SCALE_RANGE" }, { "mean_a", "AVERAGE" }, { "pid_a", "PID" },
	{ "pid_b", "PID" }, { "pid_c", "PID" },
};
#define MORE (sizeof(more) / sizeof(*more))

/* A Boolean input: fed by a branch, written, or not connected. */
static int bool_pin(struct builder *builder, const char *name,
		    const char *pin[3], int fed)
{
	struct random_source *source = builder->source;

	if (random_chance(source, 55))
		pin[fed++] = name;
	else if (random_chance(source, 60))
		words_put(builder, " %s:=%s%s", name, random_chance(source, 30) ? "/" : "",
		    operand(source, "BOOL", false));
	return fed;
}

/* PV and CV of a counter; the type is in its name. */
static void preset(struct builder *builder, const char *fb)
{
	struct random_source *source = builder->source;
	const char *type = strchr(fb, '_') ? strchr(fb, '_') + 1 : "INT";
	bool is_long = type[0] == 'L' || strcmp(type, "ULINT") == 0;

	if (random_chance(source, 90))
		words_put(builder, " PV:=%s", random_chance(source, 60) ? "2" :
		    is_long || random_chance(source, 50) ?
		    literal(source, type) : variable(source, type, false));
	if (!is_long && random_chance(source, 20))
		words_put(builder, " CV=>%s", variable(source, type, true));
}

/* A value for an input that is not BOOL. */
static const char *input(struct random_source *source, enum iec_type type)
{
	const char *word = iec_type_row(type)->word;

	if (type == IEC_TIME || type == IEC_TIME_OF_DAY ||
	    type == IEC_DATE_AND_TIME || random_chance(source, 30))
		return literal(source, word);
	if (type == IEC_INT && random_chance(source, 50)) /* sizes and numbers of */
		return random_chance(source, 50) ? "1" : "2";
	if (type == IEC_REAL && random_chance(source, 30))
		return variable(source, "INT", false);
	return variable(source, word, false);
}

/* Inputs with an initial value are mostly not connected; a cell has limited length. */
static int any_block(struct builder *builder, const char *const *which,
		     const char *pin[3])
{
	struct random_source *source = builder->source;
	enum word word = word_find(which[1], strlen(which[1]));
	const struct word_row *row = word_row(word);
	int fed = 0, power = word_first_bool(row, PIN_IN);

	words_put(builder, "%s %s", which[1], which[0]);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *at = &row->pin[i];

		if (i == power || builder->used > RANDOM_TEXT * 3 / 4)
			continue;
		if (at->dir == PIN_IN && at->type == IEC_BOOL)
			fed = bool_pin(builder, at->name, pin, fed);
		else if (at->dir == PIN_IN &&
			 random_chance(source, at->has_init ? 35 : 90))
			words_put(builder, " %s:=%s", at->name, input(source, at->type));
		else if (at->dir == PIN_OUT && at->type != IEC_LWORD &&
			 random_chance(source, 10))
			words_put(builder, " %s=>%s", at->name,
			    operand(source, iec_type_row(at->type)->word, true));
	}
	return fed;
}

static int block(struct builder *builder, const char *pin[3])
{
	struct random_source *source = builder->source;
	const char *const *which = instance[random_below(source, INSTANCES)];
	const char *fb = which[1];
	int fed = 0;

	words_put(builder, "%s %s", fb, which[0]);
	if (*fb == 'T') {
		if (random_chance(source, 90))
			words_put(builder, " PT:=%s", random_chance(source, 10) ?
			    "T#0s" : random_chance(source, 10) ? "time_a" :
			    random_chance(source, 30) ? "T#25ms" : "T#10ms");
		if (random_chance(source, 20))
			words_put(builder, " ET=>%s", variable(source, "TIME", true));
	} else if (strncmp(fb, "CTUD", 4) == 0) {
		fed = bool_pin(builder, "CD", pin, fed);
		fed = bool_pin(builder, "R", pin, fed);
		fed = bool_pin(builder, "LD", pin, fed);
	} else if (strncmp(fb, "CTU", 3) == 0) {
		fed = bool_pin(builder, "R", pin, fed);
	} else if (strncmp(fb, "CTD", 3) == 0) {
		fed = bool_pin(builder, "LD", pin, fed);
	} else if (strcmp(fb, "SR") == 0) {
		fed = bool_pin(builder, "R", pin, fed);
	} else if (strcmp(fb, "RS") == 0) {
		fed = bool_pin(builder, "R1", pin, fed);
	}
	if (*fb == 'C')
		preset(builder, fb);
	if (random_chance(source, 15))
		words_put(builder, " %s=>%s", *fb == 'S' || fb[1] == 'S' ? "Q1" :
		    strncmp(fb, "CTUD", 4) == 0 ? "QU" : "Q",
		    operand(source, "BOOL", true));
	return fed;
}

int random_block(struct builder *builder, const char *pin[3])
{
	struct random_source *source = builder->source;

	if (random_chance(source, 40))
		return any_block(builder, more[random_below(source, MORE)], pin);
	return block(builder, pin);
}

void random_declare_blocks(struct builder *builder, const char *body)
{
	for (size_t i = 0; i < INSTANCES; i++)
		if (is_used(body, instance[i][0]))
			words_put(builder, "  %s : %s;\n", instance[i][0],
			    instance[i][1]);
	for (size_t i = 0; i < MORE; i++)
		if (is_used(body, more[i][0]))
			words_put(builder, "  %s : %s;\n", more[i][0], more[i][1]);
}
