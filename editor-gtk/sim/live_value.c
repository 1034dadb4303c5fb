/* SPDX-License-Identifier: MIT
 *
 * live_value - values of variables for people: see live_value.h.
 */
#include "editor-gtk/sim/live_value.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/trial/value.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* ---- find and compare ---- */

const struct image *live_image(LadderSim *sim, bool plant)
{
	const struct twin *twin = sim ? ladder_sim_twin(sim) : NULL;
	const struct image *image = !twin ? NULL :
		plant ? &twin->plant.image : &twin->resource.image;

	return image && image->program ? image : NULL;
}

struct location live_value_find(const struct image *image, const char *name)
{
	enum diag_id why;

	return image ? value_find(image, name, strlen(name), &why) :
		       (struct location){ .type = IEC_NONE };
}

bool live_value_is_same(struct location a, struct location b)
{
	return a.type != IEC_NONE && a.type == b.type && a.area == b.area && a.where == b.where &&
	       a.number == b.number && a.first == b.first;
}

union iec_value live_value_get(LadderSim *sim, bool plant, struct location at)
{
	const struct image *image = live_image(sim, plant);

	return image ? image_get(image, at) : (union iec_value){ 0 };
}

bool live_value_is_forced(LadderSim *sim, bool plant, struct location at)
{
	const struct image *image = live_image(sim, plant);

	return image && image->force_count && at.type != IEC_NONE &&
	       image_is_forced(image, at);
}

bool live_value_is_equal(enum iec_type type, union iec_value a, union iec_value b)
{
	if (type != IEC_STRING)
		return memcmp(&a, &b, sizeof(a)) == 0;
	return a.s->length == b.s->length && memcmp(a.s->text, b.s->text, a.s->length) == 0;
}

static void keep_value(struct live_seen *seen, enum iec_type type, union iec_value value)
{
	struct iec_string *copy;

	seen->value = value;
	if (type != IEC_STRING)
		return;
	copy = iec_text_init(&seen->text, value.s->length);
	memcpy(copy->text, value.s->text, value.s->length);
	seen->value.s = copy;
}

static bool look(struct live_seen *seen, LadderSim *sim, bool plant, struct location at, bool outside)
{
	const struct image *image = at.type != IEC_NONE ? live_image(sim, plant) : NULL;
	const bool known = seen->known, forced = seen->forced;
	const enum sim_quality quality = seen->quality;
	union iec_value value;

	seen->quality = image && !plant ? ladder_sim_quality(sim, at) : SIM_GOOD;
	seen->known = image && (plant || ladder_sim_knows(sim, at));
	seen->forced = live_value_is_forced(sim, plant, at);
	if (!seen->known)
		return known || forced;
	value = outside && !plant ? ladder_sim_outside(sim, at) : image_get(image, at);
	if (known && live_value_is_equal(at.type, seen->value, value))
		return forced != seen->forced || quality != seen->quality;
	keep_value(seen, at.type, value);
	return true;
}

bool live_value_look(struct live_seen *seen, LadderSim *sim, bool plant, struct location at)
{
	return look(seen, sim, plant, at, false);
}

bool live_value_look_outside(struct live_seen *seen, LadderSim *sim, bool plant, struct location at)
{
	return look(seen, sim, plant, at, true);
}

/* ---- quality ---- */

const char *live_quality_text(enum sim_quality quality)
{
	static const char *const text[] = {
		[SIM_GOOD] = "", [SIM_STALE] = N_("⚠ stale"), [SIM_VALUE_FAULT] = N_("✖ fault"),
		[SIM_FORCED] = N_("◆ forced"),
	};

	return *text[quality] ? _(text[quality]) : "";
}

const char *live_quality_word(enum sim_quality quality)
{
	const char *text = live_quality_text(quality), *word = strchr(text, ' ');

	return word ? word + 1 : text;
}

/* ---- set, force, release ---- */

static void act(LadderSim *sim, bool plant, enum act_kind kind, struct location at,
		union iec_value value)
{
	const struct act act = { .kind = kind, .plant = plant, .at = at, .value = value };

	ladder_sim_act(sim, &act);
}

void live_value_set(LadderSim *sim, bool plant, struct location at, union iec_value value)
{
	if (live_image(sim, plant) && at.type != IEC_NONE)
		act(sim, plant, live_value_is_forced(sim, plant, at) ? ACT_FORCE : ACT_SET,
		    at, value);
}

void live_value_force(LadderSim *sim, bool plant, struct location at, union iec_value value)
{
	act(sim, plant, ACT_FORCE, at, value);
}

void live_value_release(LadderSim *sim, bool plant, struct location at)
{
	if (live_value_is_forced(sim, plant, at))
		act(sim, plant, ACT_RELEASE, at, (union iec_value){ 0 });
}

/* ---- formats ---- */

static const struct { const char *word, *label; } row[FORMAT_COUNT] = {
	[FORMAT_AUTO] = { "auto", N_("As its type") },
	[FORMAT_BIN] = { "bin", N_("Binary") },
	[FORMAT_HEX] = { "hex", N_("Hexadecimal") },
	[FORMAT_SIGNED] = { "signed", N_("Signed") },
	[FORMAT_UNSIGNED] = { "unsigned", N_("Unsigned") },
	[FORMAT_FLOAT] = { "float", N_("Floating point") },
	[FORMAT_TIME] = { "time", N_("Time") },
};

const char *live_format_word(enum live_format format)
{
	return row[format].word;
}

const char *live_format_label(enum live_format format)
{
	return row[format].label;
}

enum live_format live_format_find(const char *word, size_t len)
{
	for (int i = 0; i < FORMAT_COUNT; i++)
		if (strlen(row[i].word) == len && memcmp(row[i].word, word, len) == 0)
			return (enum live_format)i;
	return FORMAT_COUNT;
}

static bool is_number(enum iec_type type)
{
	return iec_type_row(type)->class & (CLASS_BITS | ANY_INT);
}

bool live_format_fits(enum live_format format, enum iec_type type)
{
	const int size = iec_type_row(type)->size;

	switch (format) {
	case FORMAT_AUTO: return true;
	case FORMAT_BIN:
	case FORMAT_HEX: return is_number(type) || iec_type_row(type)->class == CLASS_REAL;
	case FORMAT_SIGNED:
	case FORMAT_UNSIGNED: return is_number(type);
	case FORMAT_FLOAT: return is_number(type) && size >= 4;
	case FORMAT_TIME: return is_number(type) && size >= 2;
	case FORMAT_COUNT: break;
	}
	return false;
}

/* ---- bits ---- */

static int width_of(enum iec_type type)
{
	return 8 * iec_type_row(type)->size;
}

static uint64_t bits_of(enum iec_type type, union iec_value value)
{
	unsigned char memory[8] = { 0 };

	iec_store(memory, type, value);
	return (uint64_t)iec_load(memory, IEC_LWORD).i;
}

static union iec_value of_bits(enum iec_type type, uint64_t bits)
{
	unsigned char memory[8] = { 0 };

	iec_store(memory, IEC_LWORD, (union iec_value){ .i = (int64_t)bits });
	return iec_load(memory, type);
}

static int64_t sign_extended(uint64_t bits, int width)
{
	if (width < 64 && bits >> (width - 1))
		bits |= UINT64_MAX << width;
	return (int64_t)bits;
}

static enum iec_type real_of(enum iec_type type)
{
	return width_of(type) == 64 ? IEC_LREAL : IEC_REAL;
}

/* ---- times ---- */

#define SECOND INT64_C(1000000000)

/* The unit of a time: ms below a second, s below a minute, "2:05 min", "1:02:05 h". */
enum unit { UNIT_MS, UNIT_S, UNIT_MIN, UNIT_H };
#define ALL_DIGITS (-1) /* as many as the time has                              */

static const char *const unit_name[] = {
	[UNIT_MS] = "ms", [UNIT_S] = "s", [UNIT_MIN] = "min", [UNIT_H] = "h",
};

static guint64 size_of(int64_t ns)
{
	return ns < 0 ? 0 - (guint64)ns : (guint64)ns;
}

static enum unit unit_of(int64_t ns)
{
	const guint64 size = size_of(ns);

	return size == 0 || (size >= SECOND && size < 60 * SECOND) ? UNIT_S :
	       size < SECOND ? UNIT_MS : size < 3600 * SECOND ? UNIT_MIN : UNIT_H;
}

/* A decimal point and @digits of @rest of @whole ns, cut; ALL_DIGITS: without zeros at its end. */
static void put_fraction(GString *text, guint64 rest, guint64 whole, int digits)
{
	for (int i = 0; digits == ALL_DIGITS ? rest != 0 : i < digits; i++) {
		if (i == 0)
			g_string_append_c(text, '.');
		whole /= 10;
		g_string_append_c(text, (char)('0' + rest / whole));
		rest %= whole;
	}
}

/* "3.25" for the unit s, "2:05" for min. */
static void put_time(GString *text, int64_t ns, enum unit unit, int digits)
{
	const guint64 size = size_of(ns), ms = VALUE_MS, s = size / SECOND;

	if (ns < 0)
		g_string_append_c(text, '-');
	if (unit == UNIT_MS)
		g_string_append_printf(text, "%" G_GUINT64_FORMAT, size / ms);
	else if (unit == UNIT_S)
		g_string_append_printf(text, "%" G_GUINT64_FORMAT, s);
	else if (unit == UNIT_MIN)
		g_string_append_printf(text, "%" G_GUINT64_FORMAT ":%02d", s / 60,
				       (int)(s % 60));
	else
		g_string_append_printf(text, "%" G_GUINT64_FORMAT ":%02d:%02d", s / 3600,
				       (int)(s / 60 % 60), (int)(s % 60));
	put_fraction(text, unit == UNIT_MS ? size % ms : size % SECOND,
		     unit == UNIT_MS ? ms : SECOND, digits);
}

/* Digits of a time that has little room. A time below 1 ms keeps all. */
static int few_digits(int64_t ns, enum unit unit)
{
	if (unit == UNIT_MS)
		return size_of(ns) < VALUE_MS ? ALL_DIGITS : 0;
	return unit == UNIT_S && size_of(ns) % SECOND >= SECOND / 10 ? 1 : 0;
}

static int print_time(int64_t ns, int digits, char *out, size_t size)
{
	GString *text = g_string_new(NULL);

	put_time(text, ns, unit_of(ns), digits);
	g_string_append_printf(text, " %s", unit_name[unit_of(ns)]);
	const int length = g_snprintf(out, size, "%s", text->str);

	g_string_free(text, TRUE);
	return length;
}

int live_time_print(int64_t ns, char *out, size_t size)
{
	return print_time(ns, ALL_DIGITS, out, size);
}

void live_time_print_short(int64_t ns, char *out, size_t size)
{
	print_time(ns, few_digits(ns, unit_of(ns)), out, size);
}

/* Digits of a unit that tell apart times which are @step ns apart. */
static int step_digits(int64_t ns, int64_t step)
{
	const enum unit unit = unit_of(ns);
	int64_t part = unit == UNIT_MS ? VALUE_MS : SECOND;
	int digits = 0;

	for (; step > 0 && part > 1 && step % part != 0; digits++)
		part /= 10;
	return digits;
}

void live_time_print_tick(int64_t ns, int64_t step_ns, char *out, size_t size)
{
	print_time(ns, ns == 0 ? ALL_DIGITS : step_digits(ns, step_ns), out, size);
}

/* Both have the unit of the goal. The unit of hours and minutes is written once, at the end. */
static void print_times(int64_t ns, int64_t goal, char *out, size_t size)
{
	const enum unit unit = unit_of(goal);
	GString *text = g_string_new(NULL);

	put_time(text, ns, unit, unit == UNIT_S && goal ? 1 : 0);
	if (unit <= UNIT_S)
		g_string_append_printf(text, " %s", unit_name[unit]);
	g_string_append(text, " / ");
	put_time(text, goal, unit, ALL_DIGITS);
	g_string_append_printf(text, " %s", unit_name[unit]);
	g_strlcpy(out, text->str, size);
	g_string_free(text, TRUE);
}

/* "2:05.5 min" and "1:02:05 h" as a literal; NULL: another form. Caller frees. */
static char *clock_literal(const char *text)
{
	static const char *const units[] = { "s", "m", "h" };
	const bool minus = *text == '-';
	char **part = g_strsplit(text + minus, ":", 4);
	const int parts = (int)g_strv_length(part);
	char *last = parts ? part[parts - 1] : NULL;
	GString *out = g_string_new(minus ? "T#-" : "T#");
	bool good = parts == 2 || parts == 3;

	if (good && (g_str_has_suffix(last, "min") || g_str_has_suffix(last, "h")))
		last[strlen(last) - (g_str_has_suffix(last, "h") ? 1 : 3)] = '\0';
	for (int i = 0; good && i < parts; i++) {
		good = part[i][0] && strspn(part[i], i + 1 < parts ? "0123456789" :
					    "0123456789.") == strlen(part[i]) &&
		       (i == 0 || g_ascii_strtod(part[i], NULL) < 60);
		g_string_append_printf(out, "%s%s", part[i], units[parts - 1 - i]);
	}
	g_strfreev(part);
	return g_string_free(out, !good);
}

/* A literal: the T# may be missing, as may the blanks of the form that is shown. Caller frees. */
static char *time_literal(const char *text)
{
	char **words = g_strsplit(text, " ", -1), *plain = g_strjoinv("", words);
	char *clock = strchr(plain, '#') ? NULL : clock_literal(plain), *literal;

	literal = clock ? g_strdup(clock) : strchr(plain, '#') ? g_strdup(plain) :
		  g_strconcat("T#", plain, NULL);
	g_free(clock);
	g_free(plain);
	g_strfreev(words);
	return literal;
}

/* ---- print: the status chart ---- */

/* "2#0001_0010": a group for each digit that hexadecimal has. */
static int print_bin(uint64_t bits, int width, char *out, size_t size)
{
	char text[2 + 64 + 16];
	int len = 2;

	memcpy(text, "2#", 2);
	for (int bit = width - 1; bit >= 0; bit--) {
		text[len++] = (char)('0' + (bits >> bit & 1));
		if (bit % 4 == 0 && bit > 0)
			text[len++] = '_';
	}
	return snprintf(out, size, "%.*s", len, text);
}

static int print_auto(enum iec_type type, union iec_value value, char *out, size_t size)
{
	if (iec_type_row(type)->class == CLASS_TIME)
		return live_time_print(value.i, out, size);
	return iec_value_print(type, value, out, size);
}

/* A number as so many ms; too many for ns stay a number. */
static int print_ms(enum iec_type type, union iec_value value, char *out, size_t size)
{
	const bool large = iec_is_wide(type) && value.i < 0;

	if (large || value.i > INT64_MAX / VALUE_MS || value.i < INT64_MIN / VALUE_MS)
		return print_auto(type, value, out, size);
	return live_time_print(value.i * VALUE_MS, out, size);
}

int live_value_format(enum live_format format, enum iec_type type, union iec_value value,
		char *out, size_t size)
{
	const int width = width_of(type);
	uint64_t bits;

	if (format == FORMAT_AUTO || !live_format_fits(format, type))
		return print_auto(type, value, out, size);
	bits = bits_of(type, value);
	switch (format) {
	case FORMAT_BIN: return print_bin(bits, width, out, size);
	case FORMAT_HEX:
		return snprintf(out, size, "16#%0*" PRIX64, width / 4, bits);
	case FORMAT_SIGNED:
		return snprintf(out, size, "%" PRId64, sign_extended(bits, width));
	case FORMAT_UNSIGNED: return snprintf(out, size, "%" PRIu64, bits);
	case FORMAT_FLOAT:
		return iec_value_print(real_of(type), of_bits(real_of(type), bits), out,
				       size);
	case FORMAT_TIME: return print_ms(type, value, out, size);
	case FORMAT_AUTO:
	case FORMAT_COUNT: break;
	}
	return 0;
}

/* ---- parse ---- */

/* Any number of that width, of either sign. */
static bool parse_bits(const char *text, int width, uint64_t *bits, enum diag_id *why)
{
	struct literal literal;
	union iec_value value;
	const enum literal_result result = literal_parse(text, strlen(text), &literal);

	*why = result == LITERAL_RANGE ? DIAG_LITERAL_RANGE : DIAG_BAD_LITERAL;
	if (result != LITERAL_OK)
		return false;
	if (literal_fit(&literal, IEC_LWORD, &value)) {
		*bits = (uint64_t)value.i;
		*why = DIAG_LITERAL_RANGE;
		return width == 64 || *bits >> width == 0;
	}
	if (!literal_fit(&literal, IEC_LINT, &value))
		return false;
	*why = DIAG_LITERAL_RANGE;
	*bits = (uint64_t)value.i & (width == 64 ? UINT64_MAX : (UINT64_C(1) << width) - 1);
	return sign_extended(*bits, width) == value.i;
}

static bool parse_digits(const char *base, enum iec_type type, const char *text,
			 union iec_value *out, enum diag_id *why)
{
	char whole[IEC_VALUE_TEXT + 4];
	uint64_t bits;

	*why = DIAG_BAD_LITERAL;
	if (strlen(text) >= IEC_VALUE_TEXT)
		return false;
	snprintf(whole, sizeof(whole), "%s%s", strchr(text, '#') ? "" : base, text);
	if (!parse_bits(whole, width_of(type), &bits, why))
		return false;
	*out = of_bits(type, bits);
	return true;
}

/* 1m30s, -2.5 s, 20ms, 2:05 min: a literal without its T#, or a time as it is shown. */
static bool parse_time(enum iec_type type, const char *text, struct iec_text *room,
		       union iec_value *out, enum diag_id *why)
{
	char *whole = time_literal(text);
	struct literal literal;
	const bool good = literal_parse(whole, strlen(whole), &literal) == LITERAL_OK &&
			  literal.type == IEC_TIME;

	*out = literal.value;
	g_free(whole);
	return good || value_parse(type, text, strlen(text), room, out, why);
}

static bool parse_ms(enum iec_type type, const char *text, struct iec_text *room,
		     union iec_value *out, enum diag_id *why)
{
	char number[24];

	if (!parse_time(IEC_TIME, text, room, out, why))
		return false;
	*why = DIAG_LITERAL_RANGE;
	if (out->i % VALUE_MS)
		return false;
	snprintf(number, sizeof(number), "%" PRId64, out->i / VALUE_MS);
	return value_parse(type, number, strlen(number), room, out, why);
}

static bool parse_float(enum iec_type type, const char *text, struct iec_text *room,
			union iec_value *out, enum diag_id *why)
{
	if (!value_parse(real_of(type), text, strlen(text), room, out, why))
		return false;
	*out = of_bits(type, bits_of(real_of(type), *out));
	return true;
}

static bool parse(enum live_format format, enum iec_type type, const char *text,
		  struct iec_text *room, union iec_value *out, enum diag_id *why)
{
	switch (live_format_fits(format, type) ? format : FORMAT_AUTO) {
	case FORMAT_BIN: return parse_digits("2#", type, text, out, why);
	case FORMAT_HEX: return parse_digits("16#", type, text, out, why);
	case FORMAT_SIGNED:
	case FORMAT_UNSIGNED: return parse_digits("", type, text, out, why);
	case FORMAT_FLOAT: return parse_float(type, text, room, out, why);
	case FORMAT_TIME: return parse_ms(type, text, room, out, why);
	case FORMAT_AUTO:
	case FORMAT_COUNT: break;
	}
	if (iec_type_row(type)->class == CLASS_TIME)
		return parse_time(type, text, room, out, why);
	return value_parse(type, text, strlen(text), room, out, why);
}

bool live_value_parse(enum live_format format, enum iec_type type, const char *text,
		      struct iec_text *room, union iec_value *out, enum diag_id *why)
{
	char *plain = g_strstrip(g_strdup(text));
	const bool good = *plain && parse(format, type, plain, room, out, why);

	if (!*plain)
		*why = DIAG_BAD_LITERAL;
	g_free(plain);
	return good;
}

char *live_value_literal(enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT + 1];

	if (type == IEC_TIME)
		literal_print(type, value, text, sizeof(text));
	else
		iec_value_print(type, value, text, sizeof(text));
	return g_utf8_make_valid(text, -1);
}

/* ---- print: sheets and the panel ---- */

static void print_real(double value, char *out, size_t size)
{
	char text[G_ASCII_DTOSTR_BUF_SIZE];

	g_strlcpy(out, g_ascii_formatd(text, sizeof(text), "%.6g", value), size);
}

/* Cut between two UTF-8 characters. */
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
	if (type == IEC_BOOL)
		g_strlcpy(out, value.i ? "TRUE" : "FALSE", size);
	else if (type == IEC_REAL || type == IEC_LREAL)
		print_real(value.r, out, size);
	else if (type == IEC_TIME)
		live_time_print_short(value.i, out, size);
	else
		print_long(type, value, out, size);
}

void live_count_print(enum iec_type type, union iec_value value, union iec_value goal,
		      char *out, size_t size)
{
	char now[32], aim[32];

	if (type == IEC_TIME) {
		print_times(value.i, goal.i, out, size);
	} else {
		live_value_print(type, value, now, sizeof(now));
		live_value_print(type, goal, aim, sizeof(aim));
		g_snprintf(out, size, "%s / %s", now, aim);
	}
}

/* ---- numbers ---- */

double live_value_number(enum iec_type type, union iec_value value)
{
	switch (iec_type_row(type)->class) {
	case CLASS_REAL: return value.r;
	case CLASS_STRING: return value.s->length;
	case CLASS_TIME: return (double)value.i / VALUE_MS;
	default: return iec_is_wide(type) ? (double)(guint64)value.i : (double)value.i;
	}
}

void live_number_print(enum iec_type type, double number, char *out, size_t size)
{
	if (type == IEC_NONE)
		g_strlcpy(out, "?", size);
	else if (iec_type_row(type)->class == CLASS_TIME)
		live_time_print((int64_t)CLAMP(number * (double)VALUE_MS, -9.2e18, 9.2e18),
				out, size);
	else
		g_snprintf(out, size, "%.10g", number);
}

/* ---- lines of the VIEW part ---- */

char *live_name(const char *name)
{
	GString *out = g_string_new(NULL);

	for (; *name; name++)
		if ((guchar)*name > ' ' && *name != 127)
			g_string_append_c(out, *name);
	return g_string_free(out, FALSE);
}

const char *live_line_after(const char *line, const char *word)
{
	const gsize len = strlen(word);

	line += strspn(line, " \t");
	if (strncmp(line, word, len) != 0 || !strchr(" \t", line[len]))
		return NULL;
	line += len;
	return line + strspn(line, " \t");
}

static bool is_end(const char *line)
{
	return g_ascii_strncasecmp(line + strspn(line, " \t"), "END_VIEW", 8) == 0;
}

char *live_lines_replace(const char *view, bool (*is_own)(void *context, const char *line),
			 void *context, const char *own)
{
	char **lines = g_strsplit(*view ? view : "VIEW\nEND_VIEW", "\n", -1);
	GString *out = g_string_new(NULL);
	bool written = false;

	for (char **line = lines; *line; line++) {
		const bool replaced = is_own(context, *line);

		if (!written && (replaced || is_end(*line))) {
			g_string_append(out, own);
			written = true;
		}
		if (!replaced)
			g_string_append_printf(out, "%s\n", *line);
	}
	g_string_truncate(out, out->len - 1);
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}

void live_lines_keep(LadderDocument *document, char *view, const char *step)
{
	ladder_document_begin(document, step, NULL);
	ladder_document_set_view(document, view);
	ladder_document_end(document);
	g_free(view);
}
