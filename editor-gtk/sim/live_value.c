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

bool live_value_look(struct live_seen *seen, LadderSim *sim, bool plant, struct location at)
{
	const struct image *image = at.type != IEC_NONE ? live_image(sim, plant) : NULL;
	const bool known = seen->known, forced = seen->forced;
	union iec_value value;

	seen->known = image != NULL;
	seen->forced = live_value_is_forced(sim, plant, at);
	if (!image)
		return known || forced;
	value = image_get(image, at);
	if (known && live_value_is_equal(at.type, seen->value, value))
		return forced != seen->forced;
	keep_value(seen, at.type, value);
	return true;
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
		return literal_print(type, value, out, size);
	return iec_value_print(type, value, out, size);
}

/* A number as so many ms; too many for ns stay a number. */
static int print_ms(enum iec_type type, union iec_value value, char *out, size_t size)
{
	const bool large = iec_is_wide(type) && value.i < 0;

	if (large || value.i > INT64_MAX / VALUE_MS || value.i < INT64_MIN / VALUE_MS)
		return print_auto(type, value, out, size);
	value.i *= VALUE_MS;
	return literal_print(IEC_TIME, value, out, size);
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

/* 1m30s, -2.5s, 20ms: a literal without its T#. */
static bool parse_time(enum iec_type type, const char *text, struct iec_text *room,
		       union iec_value *out, enum diag_id *why)
{
	char *whole = strchr(text, '#') ? g_strdup(text) : g_strconcat("T#", text, NULL);
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

/* ---- print: the panel ---- */

#define SECOND INT64_C(1000000000)

/* Digits after the point: usually two, so that the text keeps its width while it counts. */
static int digits_of(guint64 ns)
{
	static const guint step[] = { 10000000, 1000000, 1000, 1 };
	static const int digits[] = { 2, 3, 6, 9 };
	int i = 0;

	while (ns % step[i])
		i++;
	return digits[i];
}

static char *time_text(gint64 ns)
{
	const guint64 size = ns < 0 ? -(guint64)ns : (guint64)ns;
	const char *sign = ns < 0 ? "-" : "";
	const int digits = digits_of(size);
	guint64 fraction = size % SECOND;
	const guint s = (guint)(size / SECOND % 60), m = (guint)(size / SECOND / 60 % 60);
	const guint64 h = size / SECOND / 3600;

	for (int i = digits; i < 9; i++)
		fraction /= 10;
	if (h)
		return g_strdup_printf("%s%" G_GUINT64_FORMAT "h%02um%02u.%0*"
				       G_GUINT64_FORMAT "s", sign, h, m, s, digits, fraction);
	if (m)
		return g_strdup_printf("%s%um%02u.%0*" G_GUINT64_FORMAT "s", sign, m, s,
				       digits, fraction);
	return g_strdup_printf("%s%u.%0*" G_GUINT64_FORMAT "s", sign, s, digits, fraction);
}

char *live_value_text(enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT + 1];

	if (type == IEC_TIME)
		return time_text(value.i);
	iec_value_print(type, value, text, sizeof(text));
	return g_utf8_make_valid(text, -1);
}

/* ---- print: sheets ---- */

/* The unit that suits the size of a time. */
enum unit { UNIT_MS, UNIT_S, UNIT_MINUTES, UNIT_HOURS };

static enum unit unit_of(int64_t ns)
{
	const guint64 size = ns < 0 ? 0 - (guint64)ns : (guint64)ns;

	return size < SECOND ? UNIT_MS : size < 100 * SECOND ? UNIT_S :
	       size < 3600 * SECOND ? UNIT_MINUTES : UNIT_HOURS;
}

static void print_time(int64_t ns, enum unit unit, char *out, size_t size)
{
	const guint64 ms = (ns < 0 ? 0 - (guint64)ns : (guint64)ns) / VALUE_MS;
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

	if (type == IEC_TIME && unit == UNIT_HOURS) { /* no room for both */
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
		g_snprintf(out, size, "%.2f s", number / 1e3);
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
