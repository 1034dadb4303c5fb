/* SPDX-License-Identifier: MIT
 *
 * origin - the file that an unsaved project was made from, and the files that are copied
 * when it is saved: plant, scenarios and I/O maps of a sample, the I/O map of a ClassicLadder
 * project. Also the plant to simulate beside the program (trial/plant.h).
 *
 * A copied file gets the name of the program, by which it is found (side_file.h); so does
 * the plant in a scenario. A file that the program includes keeps its name. No existing file is replaced.
 */
#ifndef EDITOR_ORIGIN_H
#define EDITOR_ORIGIN_H

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/window/core.h"

struct origin {
	struct core *core;
	char *path;             /* of the file; NULL: a new project             */
	LadderOrigin *classic;  /* NULL: not made from ClassicLadder */
	char *plant;            /* chosen by the person; NULL: none             */
	bool plant_chosen;
	GString *taken, *left;  /* names of files that origin_will_save() has copied, or not; NULL: none yet */
};

void origin_init(struct origin *origin, struct core *core);
void origin_clear(struct origin *origin);
/** origin_set_path - @path: NULL: the project was made from no file. */
void origin_set_path(struct origin *origin, const char *path);
/** origin_sample - the sample that the unsaved project is a copy of; NULL: none. Borrowed. */
const char *origin_sample(struct origin *origin);
/** origin_name - the file name of the document, or of its origin, with @ending. Caller
 * frees. */
char *origin_name(struct origin *origin, const char *ending);
/** origin_will_save - to be called before the first save, to @path: copies the files that the sample includes, under
 * their names. @sample: as of origin_saved(). */
void origin_will_save(struct origin *origin, const char *sample, const char *path);
/** origin_saved - to be called after the first save: copies the files beside the origin.
 * @sample: what origin_sample() returned before. */
void origin_saved(struct origin *origin, const char *sample);
/** origin_load_plant - gives the simulation the current text of the plant. False: the plant
 * has errors; @error has the first. */
bool origin_load_plant(struct origin *origin, GError **error);
/** origin_set_plant - @path: NULL: no plant. Restarts the simulation if it is on. A plant
 * with errors is refused with a message. */
void origin_set_plant(struct origin *origin, const char *path);

#endif
