/* SPDX-License-Identifier: MIT
 *
 * value - times, names and values as scripts and command lines give them.
 *
 * A thin layer over base/literal.h for texts that people type beside a program:
 * `10ms`, `Start=1`, `%I0`. It never rounds and never guesses a type.
 */
#ifndef TRIAL_VALUE_H
#define TRIAL_VALUE_H

#include "engine/base/diag.h"
#include "engine/base/literal.h"
#include "engine/scan/image.h"

/* The longest time of a trial in ns (31 years): sums of four never overflow. */
#define VALUE_TIME_MAX INT64_C(1000000000000000000)
#define VALUE_MS INT64_C(1000000)

/**
 * value_parse_time - a time that is not negative: `10ms`, `2.5s`, `1m30s`,
 * `T#3s`
 * @unit_ns: what a bare number counts; 0: a unit is needed
 * @ns:      the time in ns, at most VALUE_TIME_MAX
 *
 * Units: d h m (min) s ms us ns. Owns: nothing.   Scan-safe: no.
 * Fails: LITERAL_BAD or LITERAL_RANGE (also for parts of a nanosecond).
 */
enum literal_result value_parse_time(const char *text, size_t len,
				     int64_t unit_ns, int64_t *ns);

/**
 * value_parse - a constant of a known type
 * @room: gets the bytes of a STRING, which @out then points to
 *
 * TIME may be a bare number of ms, dates and times of day as traces show them:
 * without T#, D#; BOOL is 0, 1, TRUE, FALSE; a STRING stands in '.
 * Owns: nothing.   Scan-safe: no. Fails: false; DIAG_BAD_LITERAL or
 * DIAG_LITERAL_RANGE in @why.
 */
bool value_parse(enum iec_type type, const char *text, size_t len,
		 struct iec_text *room, union iec_value *out, enum diag_id *why);

/** value_has_room - can @at hold all of @value? No text longer than its variable. */
bool value_has_room(const struct image *image, struct location at,
		    union iec_value value);

/**
 * value_find - image_find, which also takes a short address with its percent
 * sign (%I0, %Q7) as traces have it
 *
 * A local that several programs have must be named with its program.
 * Owns: nothing.   Scan-safe: no. Fails: IEC_NONE; DIAG_UNKNOWN_NAME or
 * DIAG_AMBIGUOUS_NAME in @why.
 */
struct location value_find(const struct image *image, const char *name,
			   size_t len, enum diag_id *why);

/**
 * value_side - whose name it is: the program's, or, of `plant.Level`, its plant's
 * @plant: NULL: there is none
 * @name, @len: lose `plant.` if it is the plant's. A program that has such a name itself
 * means its own.
 *
 * Scan-safe: no.   Returns @image or @plant. */
const struct image *value_side(const struct image *image, const struct image *plant,
			       const char **name, size_t *len);

struct setting {
	struct location at;
	union iec_value value;
	struct iec_text text;  /* a STRING; value points to it                */
};
/**
 * setting_parse - `NAME=VALUE`
 * @out:   not to be copied
 * @place: of the text, for the diagnostic; its column is that of @text
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false and one diagnostic.
 */
bool setting_parse(const struct image *image, const char *text, size_t len,
		   struct setting *out, struct diag_list *diags,
		   struct diag place);
#endif
