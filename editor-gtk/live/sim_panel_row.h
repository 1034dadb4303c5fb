/* SPDX-License-Identifier: MIT
 *
 * sim_panel_row - one line of the simulation panel, and the list of them for a program.
 *
 * A row knows where its values are. It shows nothing; values are set through live_value.h.
 */
#ifndef EDITOR_SIM_PANEL_ROW_H
#define EDITOR_SIM_PANEL_ROW_H

#include "editor-gtk/sim/live_named.h"

enum sim_group {
	SIM_INPUTS, SIM_OUTPUTS, SIM_MEMORY, SIM_TIMERS, SIM_COUNTERS, SIM_BLOCKS, SIM_CHARTS,
	SIM_ANALOGUE, SIM_VALUES, SIM_PLANT, SIM_GROUPS
};

enum sim_kind {
	SIM_HEADING,   /* of a group                                           */
	SIM_SWITCH,    /* a bit that a person can set                          */
	SIM_LAMP,      /* a bit that the program writes                        */
	SIM_PRESET,    /* a timer or counter: its value and its preset         */
	SIM_SLIDER,    /* a number that is an input                            */
	SIM_LEVEL,     /* a number that is an output                           */
	SIM_VALUE,     /* anything else                                        */
	SIM_STEP,      /* of a chart: is it active, and how long                */
	SIM_WHOLE,     /* an instance, a chart, an array or a structure: its parts have lines
			  of their own                                         */
};

#define LADDER_TYPE_SIM_ROW (ladder_sim_row_get_type())
G_DECLARE_FINAL_TYPE(LadderSimRow, ladder_sim_row, LADDER, SIM_ROW, GObject)

/* Read only, except for sim_panel_rows.c. Places are of the program that runs. */
struct _LadderSimRow {
	GObject parent;
	enum sim_group group;
	enum sim_kind kind;
	char *name;             /* as in traces: "Start", "Main.Delay"         */
	char *address;          /* "%IX0.0"; NULL: none                        */
	char *comment;          /* without its delimiters; NULL: none          */
	/* Of an input or output, if there is an I/O map beside the project. */
	char *place;            /* chip or board of its pin; NULL: no map      */
	char *pin;              /* "GPIO17", "12" of a chip; NULL: unknown     */
	char *pin_told;         /* both, and the comment of the map; or NULL   */
	int place_number;       /* in the order of the map                     */
	char *block;            /* type of the instance; else NULL             */
	char *owner;            /* name of the line whose part it is; else NULL */
	GPtrArray *parts;       /* of LadderSimRow: what it unfolds to; NULL: nothing */
	bool plant;             /* of the plant                                */
	bool driven;            /* by the plant                                */
	bool folded;            /* of a SIM_HEADING, and of a line with parts   */
	struct location at;     /* the value; of a SIM_PRESET its ET or CV, of a SIM_STEP its
				   T, of a SIM_WHOLE its first output           */
	struct live_named named; /* of the values of `at`                        */
	/* Of SIM_PRESET, SIM_STEP, SIM_WHOLE; type IEC_NONE: there is none. */
	struct location preset;
	struct location given;  /* the variable or pin to set the preset with  */
	struct location done;   /* its Q, or its X                             */
	struct location start;  /* of a timer: when it began to run            */
	/* Choices of a person. */
	bool push;              /* a push button instead of a switch           */
	char *key;              /* gdk_keyval_name() of its key; NULL: none    */
	bool key_toggles;       /* the key toggles; else it holds              */
	bool ranged;            /* the range is not that of the type           */
	double low, high;       /* of SIM_SLIDER, SIM_LEVEL                    */
};

/** sim_rows_new - the rows of the program that runs and of its plant, in their order, without
 * headings. Empty: the simulation is off. Caller: g_ptr_array_unref. */
GPtrArray *sim_rows_new(LadderSim *sim);
/** sim_row_heading - the heading above @first. Caller: g_object_unref(). */
LadderSimRow *sim_row_heading(const LadderSimRow *first, bool folded);
/** sim_row_section - a key of the heading and of the lines below it: "0 gpiochip0"; of a line
 * with parts: "Delay" of the program, "@Delay" of the plant. Caller frees. */
char *sim_row_section(const LadderSimRow *row);
/** sim_row_is - is it the same line, apart from its places? */
bool sim_row_is(const LadderSimRow *row, const LadderSimRow *other);
/** sim_row_become - takes the places of @from, which is the same line. */
void sim_row_become(LadderSimRow *row, const LadderSimRow *from);
/** sim_row_set_range - of SIM_SLIDER, SIM_LEVEL; @ranged false: that of its type. */
void sim_row_set_range(LadderSimRow *row, bool ranged, double low, double high);
/** sim_row_label - the name in its line: of a part without that of its owner. Borrowed. */
const char *sim_row_label(const LadderSimRow *row);
/** sim_row_told - of a chart: "Fill, Heat", the steps that are active. NULL: another row. Caller
 * frees. */
char *sim_row_told(const LadderSimRow *row, LadderSim *sim);
/** sim_row_matches - is @wanted in name, address, pin, place, comment or block? Ignores case. The
 * name of a part is that of its line, unless @wanted has a dot. */
bool sim_row_matches(const LadderSimRow *row, const char *wanted);

/** sim_group_name - translated. Lives for ever. */
const char *sim_group_name(enum sim_group group);
/** sim_row_is_bit - a switch or a lamp? */
bool sim_row_is_bit(const LadderSimRow *row);
/** sim_row_is_forced - its value, or that of its preset. */
bool sim_row_is_forced(const LadderSimRow *row, LadderSim *sim);
void sim_row_release(const LadderSimRow *row, LadderSim *sim);
/** sim_row_set_elapsed - a timer continues as if so much time had passed, a counter as if it
 * had counted so far. */
void sim_row_set_elapsed(const LadderSimRow *row, LadderSim *sim, union iec_value value);
/** sim_row_press, sim_row_unpress - a switch or lamp toggles; a push button is on in between.
 * Nothing happens if it is constant, or driven by the plant and not forced. */
void sim_row_press(const LadderSimRow *row, LadderSim *sim);
void sim_row_unpress(const LadderSimRow *row, LadderSim *sim);

/* ---- what a person chose, kept in the project ----
 * Lines `panel NAME push`, `panel NAME hold F6`, `panel NAME toggle F6`, `panel NAME range 0
 * 100` of the VIEW part, or several of these in one; `panel-plant` for a row of the plant. */

/** sim_row_read_choices - sets the choices of @rows (of LadderSimRow) as @view says. True: one
 * of them changed. */
bool sim_row_read_choices(const char *view, GPtrArray *rows);
/** sim_row_write_choices - @view with the choices of @row. Unknown words in the line of @row
 * are dropped, other lines stay. Caller frees. */
char *sim_row_write_choices(const char *view, const LadderSimRow *row);

#endif
