/* SPDX-License-Identifier: MIT
 *
 * value - times, names and values in scripts and command lines.
 *
 * A layer over base/literal.h for `10ms`, `Start=1`, `%I0`. It does not round and does
 * not guess types.
 */
#ifndef TRIAL_VALUE_H
#define TRIAL_VALUE_H

#include "engine/base/diag.h"
#include "engine/base/literal.h"
#include "engine/model/project.h"
#include "engine/scan/image.h"

/* The longest time of a trial in ns (31 years): sums of four never overflow. */
#define VALUE_TIME_MAX INT64_C(1000000000000000000)
#define VALUE_MS INT64_C(1000000)

/**
 * value_parse_time - a time that is not negative: `10ms`, `2.5s`, `1m30s`, `T#3s`
 * @unit_ns: the unit of a bare number; 0: a unit is required
 * @ns:      the time in ns, at most VALUE_TIME_MAX
 *
 * Units: d h m (min) s ms us ns. Owns: nothing. Scan-safe: no.
 * Fails: LITERAL_BAD or LITERAL_RANGE (also for parts of a nanosecond).
 */
enum literal_result value_parse_time(const char *text, size_t len,
				     int64_t unit_ns, int64_t *ns);

/**
 * value_parse - a constant of a known type
 * @room: gets the bytes of a STRING, which @out then points to
 *
 * TIME may be a bare number of ms, dates and times of day as in traces: without T#, D#;
 * BOOL is 0, 1, TRUE, FALSE; a STRING is in '.
 * Owns: nothing. Scan-safe: no. Fails: false; DIAG_BAD_LITERAL or DIAG_LITERAL_RANGE in
 * @why.
 */
bool value_parse(enum iec_type type, const char *text, size_t len,
		 struct iec_text *room, union iec_value *out, enum diag_id *why);

/** value_has_room - whether @at can hold all of @value: a text must not be longer than
 * its variable. */
bool value_has_room(const struct image *image, struct location at,
		    union iec_value value);

/**
 * value_find - image_find, and also short addresses with a percent sign (%I0, %Q7) as
 * in traces
 *
 * A local of several programs needs the name of its program.
 * Owns: nothing. Scan-safe: no. Fails: IEC_NONE; DIAG_UNKNOWN_NAME or
 * DIAG_AMBIGUOUS_NAME in @why.
 */
struct location value_find(const struct image *image, const char *name,
			   size_t len, enum diag_id *why);

/**
 * value_side - the image of a name: the program's, or, for `plant.Level`, its plant's
 * @plant: NULL: there is none
 * @name, @len: lose `plant.` if it is the plant's. If the program has such a name
 *              itself, that is meant.
 *
 * Scan-safe: no. Returns @image or @plant. */
const struct image *value_side(const struct image *image, const struct image *plant,
			       const char **name, size_t *len);

struct setting {
	struct location at;
	union iec_value value;
	struct iec_text text;  /* a STRING; value points to it                */
};
/**
 * setting_parse - `NAME=VALUE`
 * @project: its values of enumerations may be used; NULL: numbers only
 * @out: must not be copied
 * @place: of the text, for the diagnostic; its column is that of @text
 *
 * Owns: nothing. Scan-safe: no. Fails: false and one diagnostic.
 */
bool setting_parse(const struct image *image, const struct project *project, const char *text,
		   size_t len, struct setting *out, struct diag_list *diags, struct diag place);
#endif
