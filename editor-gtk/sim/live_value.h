/* SPDX-License-Identifier: MIT
 *
 * live_value - the value of a variable at the scan that is shown: found by name, compared,
 * printed, parsed, set, forced, released, and named in the project's VIEW part.
 *
 * The simulation panel, the status chart, the timing chart and the sheets all use it. It
 * changes the simulation only through ladder_sim_act(), and it makes no widget.
 */
#ifndef EDITOR_LIVE_VALUE_H
#define EDITOR_LIVE_VALUE_H

#include "editor-gtk/sim/sim.h"

#include "engine/base/diag.h"

/* ---- find and compare ---- */

/** live_image - of the program whose scan is shown, or of its plant. NULL: the simulation is
 * off, or there is no plant. Borrowed as ladder_sim_twin(). */
const struct image *live_image(LadderSim *sim, bool plant);
/** live_value_find - as value_find(); type IEC_NONE: not found, ambiguous, or @image is NULL. */
struct location live_value_find(const struct image *image, const char *name);
/** live_value_is_same - the same variable? False: one of them is nowhere. */
bool live_value_is_same(struct location a, struct location b);
/** live_value_get - 0 if the simulation is off. */
union iec_value live_value_get(LadderSim *sim, bool plant, struct location at);
bool live_value_is_forced(LadderSim *sim, bool plant, struct location at);
bool live_value_is_equal(enum iec_type type, union iec_value a, union iec_value b);

/* A value as it was last looked at. Zeroed: not looked at yet. */
struct live_seen {
	bool known, forced;
	enum sim_quality quality; /* ladder_sim_quality()                       */
	union iec_value value;
	struct iec_text text;    /* the bytes of a STRING                      */
};
/** live_value_look - stores value and force of the scan that is shown in @seen; `known` is
 * false if there is no value. True: something changed. */
bool live_value_look(struct live_seen *seen, LadderSim *sim, bool plant, struct location at);

/** live_value_look_outside - the same as others see it: ladder_sim_outside(). */
bool live_value_look_outside(struct live_seen *seen, LadderSim *sim, bool plant, struct location at);

/** live_quality_text - a sign and a word for a value that is not good: "⚠ stale"; "": it is good. Translated. */
const char *live_quality_text(enum sim_quality quality);
/** live_quality_word - "stale", "fault"; "": good. Translated, for who hears it. */
const char *live_quality_word(enum sim_quality quality);

/* ---- set, force, release: acts between two scans ---- */

/** live_value_set - a variable that is forced is forced to the new value. */
void live_value_set(LadderSim *sim, bool plant, struct location at, union iec_value value);
void live_value_force(LadderSim *sim, bool plant, struct location at, union iec_value value);
/** live_value_release - does nothing if it is not forced. */
void live_value_release(LadderSim *sim, bool plant, struct location at);

/* ---- print and parse ---- */

/* How a status chart shows a value. The bits may be shown as another type has them; the
 * variable keeps its type. */
enum live_format {
	FORMAT_AUTO,             /* as its type is written                     */
	FORMAT_BIN, FORMAT_HEX,  /* its bits                                   */
	FORMAT_SIGNED, FORMAT_UNSIGNED,
	FORMAT_FLOAT,            /* the bits of a number as those of a REAL    */
	FORMAT_TIME,             /* of a number: ms                            */
	FORMAT_COUNT
};
/** live_format_word - as a file has it: "hex". Lives for ever. */
const char *live_format_word(enum live_format format);
/** live_format_find - of a word; FORMAT_COUNT: none. */
enum live_format live_format_find(const char *word, size_t len);
/** live_format_label - N_() text. Lives for ever. */
const char *live_format_label(enum live_format format);
/** live_format_fits - can a value of @type be shown so? */
bool live_format_fits(enum live_format format, enum iec_type type);

/**
 * live_time_print - the form of a time that is shown, wherever that is
 *
 * "250 ms" below a second, "3.25 s" below a minute, "2:05 min" below an hour, "1:02:05 h".
 * live_value_parse() reads it back. As snprintf; 32 bytes are enough.
 */
int live_time_print(int64_t ns, char *out, size_t size);
/** live_time_print_short - with at most one digit after the point: "3.2 s". Cut, not rounded: a
 * time that is not over does not look so. */
void live_time_print_short(int64_t ns, char *out, size_t size);

/** live_value_format - in a format; FORMAT_AUTO if @format does not fit the type. As
 * snprintf; IEC_VALUE_TEXT bytes are enough. */
int live_value_format(enum live_format format, enum iec_type type, union iec_value value,
		      char *out, size_t size);
/** live_time_print_tick - for a ruler whose marks stand @step_ns apart: all have the digits that tell
 * them from each other, and no more ("1.990 s", "1.995 s", "2.000 s"). */
void live_time_print_tick(int64_t ns, int64_t step_ns, char *out, size_t size);
/**
 * live_value_parse - what a person types for a value in this format
 * @room: gets the bytes of a STRING, which @out then points to
 *
 * A literal with a base (16#FF) is accepted in any format; a TIME needs no T#, and may be as
 * live_time_print() writes it.
 * Owns: nothing.   Scan-safe: no.   Fails: false; DIAG_BAD_LITERAL or DIAG_LITERAL_RANGE
 * in @why.
 */
bool live_value_parse(enum live_format format, enum iec_type type, const char *text,
		      struct iec_text *room, union iec_value *out, enum diag_id *why);
/** live_value_literal - for an entry: a time as T#5s, all else as in traces. Caller frees. */
char *live_value_literal(enum iec_type type, union iec_value value);
/** live_value_print - short, for sheets and the panel: "3.2 s", "1250", "TRUE", 'text'. */
void live_value_print(enum iec_type type, union iec_value value, char *out, size_t size);
/** live_count_print - "3.2 s / 5 s", "1:05 / 2:00 min", "7 / 10": how far it is on the way to
 * @goal. */
void live_count_print(enum iec_type type, union iec_value value, union iec_value goal,
		      char *out, size_t size);
/** live_value_number - for curves and bars: BOOL 0 and 1, TIME in ms, STRING its length. */
double live_value_number(enum iec_type type, union iec_value value);
/** live_number_print - a number of live_value_number(), for the timing chart. */
void live_number_print(enum iec_type type, double number, char *out, size_t size);

/* ---- lines of the VIEW part: what the project keeps for the views ---- */

/** live_name - @name without blanks, as a line can hold it: a blank ends a name there.
 * Caller frees. */
char *live_name(const char *name);
/** live_line_after - the text after the first word of @line if that is @word, else NULL. */
const char *live_line_after(const char *line, const char *word);
/** live_lines_replace - @view, with @own in place of the lines for which @is_own is true,
 * or before END_VIEW. Caller frees. */
char *live_lines_replace(const char *view, bool (*is_own)(void *context, const char *line),
			 void *context, const char *own);
/** live_lines_keep - @view becomes the document's VIEW part, as one step of its history.
 * @view: taken over. */
void live_lines_keep(LadderDocument *document, char *view, const char *step);

#endif
