/* SPDX-License-Identifier: MIT
 *
 * sim_panel_row - one line of the simulation panel, and the list of them for a program.
 *
 * A row knows where its values are and how they are written; it shows nothing, and changes
 * nothing but through ladder_sim_act().
 */
#ifndef EDITOR_SIM_PANEL_ROW_H
#define EDITOR_SIM_PANEL_ROW_H

#include "editor-gtk/sim/sim.h"

enum sim_group {
	SIM_INPUTS, SIM_OUTPUTS, SIM_MEMORY, SIM_TIMERS, SIM_COUNTERS, SIM_ANALOGUE,
	SIM_VALUES, SIM_PLANT, SIM_GROUPS
};

enum sim_kind {
	SIM_HEADING,   /* of a group                                           */
	SIM_SWITCH,    /* a bit that a person gives                            */
	SIM_LAMP,      /* a bit that the program gives                         */
	SIM_PRESET,    /* a timer or counter: how far, of how much             */
	SIM_SLIDER,    /* a number from without                                */
	SIM_LEVEL,     /* a number that goes out                               */
	SIM_VALUE,     /* anything else                                        */
};

#define LADDER_TYPE_SIM_ROW (ladder_sim_row_get_type())
G_DECLARE_FINAL_TYPE(LadderSimRow, ladder_sim_row, LADDER, SIM_ROW, GObject)

/* Read only, but for those who make rows. Places are those of the program that runs. */
struct _LadderSimRow {
	GObject parent;
	enum sim_group group;
	enum sim_kind kind;
	char *name;             /* as traces have it: "Start", "Main.Delay"    */
	char *address;          /* "%IX0.0"; NULL: none                        */
	char *comment;          /* without its delimiters; NULL: none          */
	/* Of an input or output, if there is an I/O map beside the project. */
	char *place;            /* where its pin is: chip or board; NULL: no map */
	char *pin;              /* "GPIO17", "12" of a chip; NULL: none is known */
	char *pin_told;         /* both, and what the map says of it; or NULL  */
	int place_number;       /* in the order of the map                     */
	char *block;            /* word of the timer or counter; else NULL     */
	bool plant;             /* of the plant                                */
	bool driven;            /* by the plant                                */
	bool folded;            /* of a SIM_HEADING                            */
	struct location at;     /* the value; of a SIM_PRESET how far it is    */
	/* Of a SIM_PRESET; type IEC_NONE: there is none. */
	struct location preset;
	struct location given;  /* where the preset comes from, if it can be set:
				   a variable, or the instance itself          */
	struct location done;   /* its Q                                       */
	struct location start;  /* of a timer: when it began to run            */
	/* What a person chose. */
	bool push;              /* a switch that is on as long as it is held   */
	char *key;              /* gdk_keyval_name() of one that does it; NULL */
	bool key_toggles;       /* rather than being held                      */
	bool ranged;
	double low, high;       /* of SIM_SLIDER, SIM_LEVEL                    */
};

/** sim_rows_new - what the program that runs, and its plant, have to show: of LadderSimRow,
 * group by group, no headings. Empty: the simulation is off. Caller: g_ptr_array_unref. */
GPtrArray *sim_rows_new(LadderSim *sim);
/** sim_row_heading - of a group, and of the place of its lines: as @first has them, which
 * is one of them; new reference. */
LadderSimRow *sim_row_heading(const LadderSimRow *first, bool folded);
/** sim_row_section - what a heading and the lines below it have in common: "0 gpiochip0".
 * Caller frees. */
char *sim_row_section(const LadderSimRow *row);
/** sim_row_is - the same line of the panel, whatever its places are? */
bool sim_row_is(const LadderSimRow *row, const LadderSimRow *other);
/** sim_row_become - its places are those of @from, which is the same line. */
void sim_row_become(LadderSimRow *row, const LadderSimRow *from);
/** sim_row_set_range - of SIM_SLIDER, SIM_LEVEL; @ranged false: that of its type. */
void sim_row_set_range(LadderSimRow *row, bool ranged, double low, double high);
/** sim_row_matches - is @wanted in name, address, pin, place, comment or block? Any case. */
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
