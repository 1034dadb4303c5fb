/* SPDX-License-Identifier: MIT
 *
 * value - reads times, names and values. It changes no image.
 */
#include "engine/trial/value.h"
#include "engine/base/name.h"
#include "engine/model/named.h"

#include "engine/trial/classic_name.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

static const struct {
	char word[4];
	int64_t ns;
} units[] = {
	{ "d", 86400 * INT64_C(1000000000) },
	{ "h", 3600 * INT64_C(1000000000) },
	{ "min", 60 * INT64_C(1000000000) },
	{ "ms", 1000000 },
	{ "m", 60 * INT64_C(1000000000) },
	{ "us", 1000 },
	{ "ns", 1 },
	{ "s", 1000000000 },
};

/* The unit at *at, which is skipped; 0: none. */
static int64_t take_unit(const char **at, const char *end)
{
	for (size_t i = 0; i < sizeof(units) / sizeof(units[0]); i++) {
		size_t len = ascii_prefix(units[i].word, *at, (size_t)(end - *at));

		*at += len;
		if (len)
			return units[i].ns;
	}
	return 0;
}

/* Adds @digits (of the fraction when @scale shrinks) to *sum. */
static enum literal_result add_fraction(const char *at, const char *end,
					int64_t scale, int64_t *sum)
{
	for (; at < end; at++) {
		int digit = *at - '0';

		if (digit && scale % 10)
			return LITERAL_RANGE;
		scale /= 10;
		*sum += digit * scale;
		if (digit && !scale)
			return LITERAL_RANGE;
	}
	return LITERAL_OK;
}

static enum literal_result add_whole(const char *at, const char *end,
				     int64_t scale, int64_t *sum)
{
	int64_t whole = 0;

	for (; at < end; at++) {
		whole = whole * 10 + (*at - '0');
		if (whole > VALUE_TIME_MAX / scale)
			return LITERAL_RANGE;
	}
	*sum += whole * scale;
	return *sum > VALUE_TIME_MAX ? LITERAL_RANGE : LITERAL_OK;
}

/* One number with its unit; *at moves behind it. */
static enum literal_result add_part(const char **at, const char *end,
				    int64_t bare, int64_t *sum, bool *last)
{
	const char *whole = *at, *point, *digits;

	while (*at < end && ascii_digit(**at))
		(*at)++;
	point = *at;
	if (*at < end && **at == '.') {
		(*at)++;
		*last = true;
	}
	digits = *at;
	while (*at < end && ascii_digit(**at))
		(*at)++;
	if (point == whole || (*last && digits == *at))
		return LITERAL_BAD;
	const char *digits_end = *at;
	int64_t scale = take_unit(at, end);

	if (!scale && *at == end) {
		scale = bare;
		*last = true;
	}
	if (!scale)
		return LITERAL_BAD;
	enum literal_result result = add_whole(whole, point, scale, sum);

	if (result != LITERAL_OK)
		return result;
	result = add_fraction(digits, digits_end, scale, sum);
	return result == LITERAL_OK && *sum > VALUE_TIME_MAX ? LITERAL_RANGE :
							       result;
}

enum literal_result value_parse_time(const char *text, size_t len,
				     int64_t unit_ns, int64_t *ns)
{
	const char *at = text, *end = text + len;
	int64_t sum = 0;
	bool last = false, first = true;

	if (memchr(text, '#', len)) {
		struct literal literal;
		enum literal_result result = literal_parse(text, len, &literal);

		if (result != LITERAL_OK)
			return result;
		if (literal.type != IEC_TIME)
			return LITERAL_BAD;
		*ns = literal.value.i;
		return *ns < 0 || *ns > VALUE_TIME_MAX ? LITERAL_RANGE :
							 LITERAL_OK;
	}
	do {
		if (last)
			return LITERAL_BAD;
		enum literal_result result =
			add_part(&at, end, first ? unit_ns : 0, &sum, &last);

		if (result != LITERAL_OK)
			return result;
		first = false;
	} while (at < end);
	*ns = sum;
	return LITERAL_OK;
}

/* A date or time of day without its D#, as in traces. */
static enum literal_result parse_bare(enum iec_type type, const char *text, size_t len,
				      struct literal *out)
{
	char whole[64];
	int n = snprintf(whole, sizeof(whole), "%s#%.*s", iec_type_row(type)->word,
			 (int)(len < sizeof(whole) ? len : sizeof(whole)), text);

	if (n < 0 || (size_t)n >= sizeof(whole))
		return LITERAL_BAD;
	return literal_parse(whole, (size_t)n, out);
}

static enum literal_result parse_constant(enum iec_type type, const char *text,
					  size_t len, struct literal *out)
{
	if (iec_type_row(type)->class & ANY_DATE && ascii_digit(*text))
		return parse_bare(type, text, len, out);
	return literal_parse(text, len, out);
}

bool value_parse(enum iec_type type, const char *text, size_t len,
		 struct iec_text *room, union iec_value *out, enum diag_id *why)
{
	struct literal literal;
	enum literal_result result;

	*why = DIAG_BAD_LITERAL;
	if (!len)
		return false;
	if (type == IEC_BOOL && (ascii_is("TRUE", text, len) || ascii_is("FALSE", text, len))) {
		out->i = len == 4;
		return true;
	}
	if (type == IEC_TIME && ascii_digit(*text)) {
		result = value_parse_time(text, len, VALUE_MS, &out->i);
		if (result == LITERAL_RANGE)
			*why = DIAG_LITERAL_RANGE;
		return result == LITERAL_OK;
	}
	result = parse_constant(type, text, len, &literal);
	if (result == LITERAL_NONE || result == LITERAL_BAD)
		return false;
	*why = DIAG_LITERAL_RANGE;
	if (result != LITERAL_OK || !literal_fit(&literal, type, out))
		return false;
	if (type == IEC_STRING) {
		struct iec_string *s = iec_text_init(room, 0);

		s->length = (uint16_t)literal_string(&literal, s->text);
		out->s = s;
	}
	return true;
}

bool value_has_room(const struct image *image, struct location at,
		    union iec_value value)
{
	return at.type != IEC_STRING ||
	       value.s->length <= image_get(image, at).s->capacity;
}

static bool is_head(const char *word, const char *text, size_t len)
{
	return name_is(word, text, len);
}

static bool is_own(const struct declared_name *symbol, const char *text,
		   size_t len)
{
	return name_same(symbol->name, strcspn(symbol->name, ".["), text, len);
}

/* Whether a bare name is a local of several programs and not a global. */
static bool is_ambiguous(const struct program *p, const char *name, size_t len)
{
	size_t head = 0;
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;
	bool local = false;

	while (head < len && !strchr(".[ ", name[head]))
		head++;
	while (image_next_declared(p, &cursor, &symbol)) {
		if (*symbol.pou && is_head(symbol.pou, name, head))
			return false;
		if (!(symbol.flags & SYMBOL_SHARED) ||
		    !is_own(&symbol, name, head))
			continue;
		if (!*symbol.pou)
			return false;
		local = true;
	}
	return local;
}

/* `Table[1, 2]` as symbols have it: Table[1][2]. */
static size_t split_indices(const char *name, size_t len, char *out, size_t size)
{
	size_t used = 0;

	for (size_t i = 0; i < len && used + 2 < size; i++) {
		if (name[i] == ' ')
			continue;
		if (name[i] == ',')
			out[used++] = ']';
		out[used++] = name[i] == ',' ? '[' : name[i];
	}
	return used;
}

struct location value_find(const struct image *image, const char *name,
			   size_t len, enum diag_id *why)
{
	struct location at = { .type = IEC_NONE };
	char split[2 * LIMIT_NAME];

	if (memchr(name, ',', len)) {
		len = split_indices(name, len, split, sizeof(split));
		name = split;
	}

	/* In a project of ClassicLadder %QW3 has its meaning there. */
	if (image->program->classic)
		at = classic_name_find(image, name, len);
	if (at.type == IEC_NONE)
		at = image_find(image, name, len);
	*why = DIAG_UNKNOWN_NAME;
	if (at.type != IEC_NONE && is_ambiguous(image->program, name, len)) {
		*why = DIAG_AMBIGUOUS_NAME;
		at.type = IEC_NONE;
		return at;
	}
	if (at.type == IEC_NONE && len > 1 && *name == '%')
		at = image_find(image, name + 1, len - 1);
	if (at.type == IEC_NONE)
		at = classic_name_find(image, name, len);
	return at;
}

const struct image *value_side(const struct image *image, const struct image *plant,
			       const char **name, size_t *len)
{
	static const char head[] = "plant.";
	const size_t skip = sizeof(head) - 1;

	if (!plant || *len <= skip || !ascii_same(*name, head, skip) ||
	    image_find(image, *name, *len).type != IEC_NONE)
		return image;
	*name += skip;
	*len -= skip;
	return plant;
}

static bool tell_value(const struct project *project, const char *text, size_t len,
		       struct diag_list *diags, struct diag place)
{
	char name[64], told[192];

	snprintf(name, sizeof(name), "%.*s", (int)(len < 60 ? len : 60), text);
	snprintf(told, sizeof(told), "%s", name);
	if (project)
		named_tell(project, place.id, name, told, sizeof(told));
	return diag_add(diags, place, "%s", told);
}

/* May it be of an enumeration? */
static bool is_whole(enum iec_type type)
{
	return type != IEC_BOOL && iec_type_row(type)->class & (ANY_INT | ANY_BIT);
}

bool setting_parse(const struct image *image, const struct project *project, const char *text,
		   size_t len, struct setting *out, struct diag_list *diags,
		   struct diag place)
{
	const char *equals = memchr(text, '=', len);
	size_t name = equals ? (size_t)(equals - text) : 0;
	enum diag_id why;

	if (!name) {
		place.id = DIAG_EXPECTED;
		return diag_add(diags, place, "NAME=VALUE" DIAG_AND "%.*s",
				(int)(len < 40 ? len : 40), text);
	}
	out->at = value_find(image, text, name, &why);
	if (out->at.type == IEC_NONE || out->at.constant) {
		place.id = out->at.type == IEC_NONE ? why : out->at.number ? DIAG_PART_ALONE : DIAG_WRITE_CONSTANT;
		return diag_add(diags, place, "%.*s",
				(int)(name < 60 ? name : 60), text);
	}
	len -= name + 1;
	bool good = value_parse(out->at.type, equals + 1, len, &out->text,
				&out->value, &why) ||
		    (project && is_whole(out->at.type) &&
		     named_number(project, equals + 1, len, &out->value.i, &why));

	if (good && !value_has_room(image, out->at, out->value)) {
		good = false;
		why = DIAG_LITERAL_RANGE;
	}
	if (!good) {
		place.id = why;
		if (place.column)
			place.column += (int)name + 1;
		return tell_value(project, equals + 1, len, diags, place);
	}
	return true;
}
