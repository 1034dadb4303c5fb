/* SPDX-License-Identifier: MIT
 *
 * live_map - where the program that runs has the values and the power that a rung shows.
 *
 * Names and cells are looked up once for a program; each frame only reads bytes at known
 * places. It draws nothing, changes nothing and uses no widget.
 */
#ifndef EDITOR_LIVE_MAP_H
#define EDITOR_LIVE_MAP_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/sim/live_named.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/scan/resource.h"

/* The names that one POU of the program can use. */
struct live_map;

/**
 * live_map_new - of POU @pou
 * @resource: of the program, which must live as long
 * @instance: "Line.Belt1", whose body is shown; NULL: the first one, if the POU is a block
 *
 * Owns: the caller, live_map_free().
 */
struct live_map *live_map_new(const struct resource *resource, const char *pou,
			      const char *instance);
void live_map_free(struct live_map *map);
/** live_map_set_sim - finds only values and power that @sim has (ladder_sim_knows()), and knows
 * the names of values. @sim: borrowed; NULL, as at first: all, without names. */
void live_map_set_sim(struct live_map *map, LadderSim *sim);
/** live_map_instances - names of those of the POU, of const char *, of the program.
 * Caller: g_ptr_array_unref. */
GPtrArray *live_map_instances(const struct live_map *map);
/** live_map_instance - the one that is shown; NULL: the POU is no block, or has none. Lives as
 * long as @map, also when the program has gone. */
const char *live_map_instance(const struct live_map *map);
/** live_map_find - where an operand's value is: "Start", "T1.Q", "Table[3]", "%IX0.0";
 * type IEC_NONE: it has no place that is always the same, or there is none. */
struct location live_map_find(const struct live_map *map, const char *name, size_t len);
/** live_map_named - names of the values of the same operand; none before live_map_set_sim(). */
struct live_named live_map_named(const struct live_map *map, const char *name, size_t len);
/** live_map_find_pin - where the value of a pin of an instance is. */
struct location live_map_find_pin(const struct live_map *map, const char *instance,
				  const char *pin);

/* Where the result of a line of a list is. */
struct live_result {
	uint32_t ran;          /* a BOOL: has it run?                           */
	struct location at;    /* the current result after it; IEC_NONE: no single value */
};
/** live_map_result - of line @line of the file. Fails: false: no instruction is there. */
bool live_map_result(const struct live_map *map, uint32_t line, struct live_result *out);
/** live_map_listed - the same of instruction @number, from 1, of the list that a ladder or a chart
 * becomes, as code_listed() counts it. Fails: false: the program keeps no such results. */
bool live_map_listed(const struct live_map *map, uint32_t number, struct live_result *out);
/** live_map_before - how many instructions of a list stand before line @end, as live_map_listed() counts. */
uint32_t live_map_before(const struct il *il, int end);
/** live_map_is_listed - does live_map_listed() count this line? */
bool live_map_is_listed(const struct il_line *line);
/** live_map_made - the result of an operation of a network, in the program that runs
 * @il: the list of its POU; @first, @last: the lines of its statement in the file; @made: expr_mark()
 * Fails: false: no line leaves it, or the program keeps no such results. */
bool live_map_made(const struct live_map *map, const struct il *il, int first, int last, uint16_t made,
		   struct live_result *out);
/** live_map_always - of a line that has run, without a value. */
struct live_result live_map_always(const struct live_map *map);

/* A piece of a text: a variable, or the text between two of them. */
struct live_part {
	struct location at;    /* type IEC_NONE: no variable that has a place     */
	struct live_named named; /* of its values                                 */
	char *text;            /* as it is written                              */
};
/** live_parts - of struct live_part; NULL: no variable with a place is in @text. Caller:
 * g_array_unref. */
GArray *live_parts(const struct live_map *map, const char *text);
/** live_parts_print - the text with values in the place of their names. Caller frees. */
char *live_parts_print(GArray *parts, const struct image *image);

/** live_word_counts - does a block count up to a preset: ET to PT, CV to PV, V to P? The names of
 * both pins; they live for ever. */
bool live_word_counts(const struct word_row *word, const char **now, const char **goal);

/* A cell of a rung that is shown. */
struct live_cell {
	uint32_t in, out;      /* where its power is; LIVE_NOWHERE: not known     */
	enum { LIVE_NOTHING, LIVE_CONTACT, LIVE_COIL, LIVE_TEXT, LIVE_BOX } kind;
	bool inverse;          /* closed while FALSE                            */
	bool edge;             /* closed if its output has power                */
	bool fails;            /* no power at its output means that it failed    */
	struct location at;    /* of its operand, of the first variable of an
				  expression, of what counts in a box           */
	const char *name;      /* of that variable; of a bit that of its number; else "" */
	uint8_t bit;           /* the operand is bit n - 1 of the number; 0: it is the whole */
	struct live_named named; /* of its values                                 */
	struct location goal;  /* the preset up to which it counts              */
	GArray *parts;         /* of LIVE_TEXT: of struct live_part; NULL: none    */
	union iec_value value, aim; /* value and goal, as last looked at         */
	union iec_value scanned; /* of a contact: after the scan that is shown    */
	guint64 sum;           /* hash of all values of `parts`                  */
	gint64 changed, flash; /* us: last change, last change that was marked   */
	float part;            /* 0 to 1 of the bar, as drawn; -1: no bar        */
	char text[48];         /* as drawn; "": no value is shown               */
	uint8_t quality;       /* enum sim_quality of the value at its place, of the sheet */
};
#define LIVE_NOWHERE UINT32_MAX
/** live_cell_bit - the value of a cell's operand, when the value at its place is @number: a bit of
 * it, or the same. */
union iec_value live_cell_bit(const struct live_cell *cell, union iec_value number);
/** live_cell_switched - the value at the place when the operand, a BOOL or a bit, becomes the other one. */
union iec_value live_cell_switched(const struct live_cell *cell, union iec_value number);
/* In live_rung.bits beside enum live_bit; they are marks when they are drawn. */
#define LIVE_FORCED 128
#define LIVE_FAILED 64 /* its operation failed: power came, and ENO is FALSE     */

struct live_rung {
	int rows, cols;
	int number;            /* of the program that runs; -1: changed since      */
	bool fresh;            /* not looked at yet                             */
	gint64 until;          /* us: when the next mark of a change ends; 0: none */
	guint64 scans;         /* the last scan looked at, counted from start_ns  */
	gint64 start_ns;
	uint8_t *bits;         /* by row; enum live_bit, LIVE_FORCED, LIVE_FAILED */
	struct live_cell *cell; /* by row                                       */
	const struct live_map *map;
	const struct project *project;
	const struct rung *shown;
};

/** live_map_power - stores where the cells of rung->number have their power. */
void live_map_power(const struct live_map *map, struct live_rung *rung);

/**
 * live_rung_new - finds the places of a rung
 * @project, @shown: the document's; borrowed
 * @number: of the program that runs; -1, and rungs that differ: power is not known
 *
 * Owns: the caller, live_rung_free(). @map must live as long.
 */
struct live_rung *live_rung_new(const struct live_map *map, const struct project *project,
				const struct rung *shown, int number);
void live_rung_free(struct live_rung *rung);
/**
 * live_rung_look - reads all values and power again
 * @resource: of the same program, in any state
 * @now:      us; @flash: marks changed values for a second
 *
 * Returns what changed; LIVE_SAME: it is drawn the same.
 */
enum live_change {
	LIVE_SAME, LIVE_OTHER_VALUE = 1, LIVE_OTHER_STATE = 2,
	LIVE_OTHER_TEXT = 4      /* always with LIVE_OTHER_VALUE                  */
};
unsigned int live_rung_look(struct live_rung *rung, const struct resource *resource,
			    gint64 now, bool flash);
/** live_rung_value - for struct grid_live; @context: the rung. */
bool live_rung_value(void *context, int row, int col, struct live_value *out);

#endif
