/* SPDX-License-Identifier: MIT
 *
 * origin - what an unsaved project was made from, and what comes along when it is saved: the
 * plant and the scenarios of a sample, the I/O map of a ClassicLadder project. Also the plant
 * that is simulated beside the program (trial/plant.h).
 *
 * What comes along gets the name of the program, by which it is found (side_file.h); so does
 * the plant in the scenarios that name it. Nothing is written over.
 */
#ifndef EDITOR_ORIGIN_H
#define EDITOR_ORIGIN_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/window/core.h"

struct origin {
	struct core *core;
	char *path;             /* of the file; NULL: a new project             */
	LadderOrigin *classic;  /* ClassicLadder's; NULL: it was not made from one */
	char *plant;            /* the person's choice; NULL: none              */
	bool plant_chosen;
};

void origin_init(struct origin *origin, struct core *core);
void origin_clear(struct origin *origin);
/** origin_set_path - NULL: the project is of no other file. */
void origin_set_path(struct origin *origin, const char *path);
/** origin_sample - the sample that an unsaved project is a copy of; NULL: it is none.
 * Borrowed. */
const char *origin_sample(struct origin *origin);
/** origin_name - the name of the document, or of what it was made from, with another ending.
 * Caller frees. */
char *origin_name(struct origin *origin, const char *ending);
/** origin_saved - the document has a file now: what belongs to it is copied beside it.
 * @sample: as origin_sample() was before. */
void origin_saved(struct origin *origin, const char *sample);
/** origin_load_plant - the simulation gets the plant as its file is now. False: the plant
 * has errors, @error says which. */
bool origin_load_plant(struct origin *origin, GError **error);
/** origin_set_plant - @path; NULL: none. The simulation starts anew with it, if it is on. A
 * plant with errors is refused, which is told. */
void origin_set_plant(struct origin *origin, const char *path);

#endif
