/* SPDX-License-Identifier: MIT
 *
 * convert - splits words such as INT_TO_REAL.
 *
 * A row in rules[] is a family of conversions. scan/fn_convert.c implements them.
 */
#include "engine/model/convert.h"
#include "engine/base/ascii.h"

#include <string.h>

#define TIMES (CLASS_TIME | ANY_DATE)
#define CLOCK (CLASS_TIME | CLASS_TOD)
#define DAY   (CLASS_DATE | CLASS_DT)

#define FROM_DIGITS "number of decimal digits; ENO FALSE if one is none, or out of range"
#define TO_DIGITS   "decimal digits of a number; ENO FALSE if they do not fit"
#define CUT     "towards 0; ENO FALSE out of range"
#define NEAREST "to the nearest, ties to even; ENO FALSE out of range"
#define WHOLE   "the same number; wraps with ENO FALSE if it does not fit"
#define TRUTH   "TRUE unless it is 0"
#define OTHER   "the same as another type: bits of one width stay, others are numbers"
#define IN_MS   "milliseconds; ENO FALSE out of range"
#define IN_S    "seconds since 1970-01-01; ENO FALSE out of range"
#define IN_NS   "nanoseconds, of dates since 1970-01-01; ENO FALSE out of range"
#define AS_TEXT "its literal: TRUE, -7, 1.5, T#1h30m, D#2026-11-21"
#define OF_TEXT "the value of a literal, its type may be missing; ENO FALSE if it is none"
#define PART    "the same, or the part of it that the type holds"
#define SAME    "the same text; ENO FALSE if it is cut"
#define LETTER  "the letter with this Unicode number, or the first one of a text; ENO FALSE if there is none"
#define NUMBER  "Unicode number of the letter, 0 without one; ENO FALSE if it does not fit"

/* @infix stands between two types. A word without a type in front takes any type of
 * @from; a word without a type behind (if @open) has one of @to, the type at OUT. The
 *   first rule that matches is used. */
enum { ANY_TEXT, TO_LETTER, OF_LETTER };

static const struct rule {
	const char *infix;
	enum word runs;
	uint16_t from, to;
	bool open;
	const char *doc;
	uint8_t letters;   /* TO_LETTER, OF_LETTER: the text is written CHAR or WCHAR */
} rules[] = {
	{ "_BCD_TO_", FN_FROM_BCD, CLASS_BITS, ANY_INT, false, FROM_DIGITS, ANY_TEXT },
	{ "_TO_BCD_", FN_TO_BCD, ANY_INT, CLASS_BITS, false, TO_DIGITS, ANY_TEXT },
	{ "_TO_BCD", FN_TO_BCD, ANY_INT, CLASS_BITS, true, TO_DIGITS, ANY_TEXT },
	{ "_TRUNC_", FN_TRUNC, CLASS_REAL, ANY_INT, false, CUT, ANY_TEXT },
	{ "_TO_", FN_LETTER_OF, CLASS_BITS | CLASS_STRING, CLASS_STRING, false, LETTER, TO_LETTER },
	{ "_TO_", FN_LETTER_NUMBER, CLASS_STRING, CLASS_BITS, false, NUMBER, OF_LETTER },
	{ "_TO_", FN_CONVERT, CLASS_STRING, CLASS_STRING, false, SAME, ANY_TEXT },
	{ "_TO_", FN_CONVERT, CLASS_REAL, ANY_INT, false, NEAREST, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_INT, ANY_INT, false, WHOLE, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_NUM | ANY_BIT, CLASS_BOOL, false, TRUTH, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_NUM | ANY_BIT, ANY_NUM | CLASS_BITS, false, OTHER, ANY_TEXT },
	{ "_TO_", FN_CONVERT, CLOCK, ANY_NUM | ANY_BIT, false, IN_MS, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_NUM | ANY_BIT, CLOCK, false, IN_MS, ANY_TEXT },
	{ "_TO_", FN_CONVERT, DAY, ANY_NUM | ANY_BIT, false, IN_S, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_NUM | ANY_BIT, DAY, false, IN_S, ANY_TEXT },
	{ "_TO_", FN_CONVERT, CLOCK, CLOCK, false, PART, ANY_TEXT },
	{ "_TO_", FN_CONVERT, DAY, DAY, false, PART, ANY_TEXT },
	{ "_TO_", FN_CONVERT, CLASS_DT, CLASS_TOD, false, PART, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_SIMPLE, CLASS_STRING, false, AS_TEXT, ANY_TEXT },
	{ "_TO_", FN_CONVERT, CLASS_STRING, ANY_SIMPLE, false, OF_TEXT, ANY_TEXT },
	{ "_TO_", FN_CONVERT, ANY_ELEMENTARY, ANY_ELEMENTARY, false, OTHER, ANY_TEXT }, /* TO_INT */
};

/* LTIME and the like count nanoseconds; they are the same types as those without L. */
static bool is_long(const char *text, enum iec_type type)
{
	return text[0] == 'L' && iec_type_row(type)->class & TIMES;
}

struct parts {
	enum iec_type from, to; /* IEC_NONE: the word names none              */
	bool long_time;         /* between LTIME or the like and a number     */
};

/* As strstr(), whose version for long texts is a kilobyte more on a board. */
static const char *find(const char *text, const char *part)
{
	const size_t len = strlen(part);

	while (*text && strncmp(text, part, len) != 0)
		text++;
	return *text ? text : NULL;
}

/* Also WSTRING, CHAR and WCHAR, which are texts. */
static enum iec_type type_named(const char *text, size_t len, bool *letter)
{
	*letter = ascii_is("CHAR", text, len) || ascii_is("WCHAR", text, len);
	return *letter || ascii_is("WSTRING", text, len) ? IEC_STRING : iec_type_find(text, len);
}

/* @text is "_" and the word. */
static bool take_apart(const char *text, const struct rule *rule, struct parts *out)
{
	const char *at = find(text, rule->infix);
	const char *to = at ? at + strlen(rule->infix) : NULL;
	const char *from = text + 1;
	bool is_time, of_letter = false, to_letter = false;

	if (!at || rule->open != !*to)
		return false;
	out->from = at == text ? IEC_NONE : type_named(from, (size_t)(at - from), &of_letter);
	out->to = *to ? type_named(to, strlen(to), &to_letter) : IEC_NONE;
	if ((rule->letters == TO_LETTER && !to_letter) || (rule->letters == OF_LETTER && !of_letter) ||
	    (of_letter && !(iec_type_row(out->to)->class & (CLASS_STRING | CLASS_BITS))) ||
	    (to_letter && rule->letters != TO_LETTER))
		return false;
	if ((at != text && !out->from) || (*to && !out->to))
		return false;
	is_time = iec_type_row(out->from)->class & TIMES &&
		  iec_type_row(out->to)->class & TIMES;
	is_time |= out->from == IEC_STRING || out->to == IEC_STRING;
	out->long_time = !is_time && (is_long(from, out->from) || is_long(to, out->to));
	if (!out->from && rule->runs == FN_CONVERT && rule->from != ANY_ELEMENTARY)
		return false; /* matches everything */
	if (out->from && rule->from == ANY_ELEMENTARY)
		return false;
	return (!out->from || iec_type_row(out->from)->class & rule->from) &&
	       (!out->to || iec_type_row(out->to)->class & rule->to) &&
	       (out->from || out->to);
}

static void fill(struct convert_word *out, const struct rule *rule,
		 const struct parts *parts)
{
	const struct word_row *runs = word_row(rule->runs);

	out->row = *runs;
	out->row.word = out->name + 1;
	out->row.runs = parts->long_time ? FN_CONVERT_NS : rule->runs;
	out->doc = parts->long_time ? IN_NS : rule->doc;
	if (parts->to)
		out->row.result = parts->to;
	out->row.result_classes = rule->to;
	out->pin[0] = runs->pin[0];
	out->pin[0].type = parts->from;
	out->pin[0].classes = parts->from ? iec_type_row(parts->from)->class : rule->from;
	out->row.pin = out->pin;
}

/* ADD_INT, GT_REAL, SHL_WORD: the function, whose inputs of any type have this one. */
static bool make_typed(struct convert_word *out)
{
	const char *name = out->name + 1, *at = strrchr(name, '_');
	const enum iec_type type = at ? iec_type_find(at + 1, strlen(at + 1)) : IEC_NONE;
	const size_t len = at ? (size_t)(at - name) : 0;
	const struct word_row *row = word_row(ascii_is("NOT", name, len) ? FN_NOT :
					      word_find(name, len));
	bool shared = false;

	if (type == IEC_NONE || row->kind != WORD_FN || (!word_shares(row) && !word_is_test(row)) ||
	    row->pin_count > (int)(sizeof(out->pin) / sizeof(*out->pin)))
		return false;
	out->row = *row;
	for (int i = 0; i < row->pin_count; i++) {
		out->pin[i] = row->pin[i];
		if (row->pin[i].own)
			continue;
		if (!(row->pin[i].classes & iec_type_row(type)->class))
			return false;
		shared = true;
		out->pin[i].type = type;
		out->pin[i].classes = iec_type_row(type)->class;
	}
	out->row.word = name;
	out->row.runs = row->number;
	out->row.pin = out->pin;
	out->doc = NULL; /* its own */
	return shared;
}

bool convert_make(const char *text, size_t len, struct convert_word *out)
{
	struct parts parts;

	if (len + 2 > sizeof(out->name) || len < 4)
		return false;
	out->name[0] = '_';
	for (size_t i = 0; i < len; i++)
		out->name[i + 1] = ascii_upper(text[i]);
	out->name[len + 1] = '\0';
	for (size_t i = 0; i < sizeof(rules) / sizeof(*rules); i++) {
		if (!take_apart(out->name, &rules[i], &parts))
			continue;
		fill(out, &rules[i], &parts);
		return true;
	}
	return make_typed(out);
}
