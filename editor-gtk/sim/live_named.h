/* SPDX-License-Identifier: MIT
 *
 * live_named - the names of the values of an enumeration, wherever live values are shown or typed.
 *
 * They are those of the program whose scan is shown. It changes nothing and makes no widget.
 */
#ifndef EDITOR_LIVE_NAMED_H
#define EDITOR_LIVE_NAMED_H

#include "editor-gtk/sim/sim.h"

/* Of a variable. Zeroed: its values have no names. After `program-changed` it may be of another
 * variable. */
struct live_named {
	LadderSim *sim;          /* borrowed                                    */
	bool plant;
	uint32_t enumeration;    /* of its project, from 1; 0: none              */
};

/**
 * live_named_find - of a variable
 * @plant: of the plant instead of the program
 * @pou:   whose variables @name may mean; "": @name is as the whole program knows it
 * @name:  "Now", "Mix.Phase", "Line[2].Phase"
 *
 * Zeroed if it is of no enumeration, or the simulation is off.
 */
struct live_named live_named_find(LadderSim *sim, bool plant, const char *pou, const char *name);
/** live_named_word - the name of @value; NULL: it has none. Lives as long as the program. */
const char *live_named_word(struct live_named named, union iec_value value);
/** live_named_type - the type as a person calls it: "Phase"; "INT" for another variable, and for an
 * enumeration without a name. Lives as long as the program. */
const char *live_named_type(struct live_named named, enum iec_type type);
/** live_named_print - that name; as live_value_print() if there is none. */
void live_named_print(struct live_named named, enum iec_type type, union iec_value value,
		      char *out, size_t size);
/** live_named_literal - that name; as live_value_literal() if there is none. Caller frees. */
char *live_named_literal(struct live_named named, enum iec_type type, union iec_value value);
/** live_named_parse - the value called @text: `Filling`, `Phase#Filling`. False: there is none. */
bool live_named_parse(struct live_named named, const char *text, union iec_value *out);
/** live_named_wrong - why a text is no value of the enumeration, with the values that there are; NULL:
 * it has none. Caller frees. */
char *live_named_wrong(struct live_named named);

#endif
