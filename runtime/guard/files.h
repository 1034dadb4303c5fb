/* SPDX-License-Identifier: MIT
 *
 * files - outputs that are numbers in files of the kernel, such as a pulse width: their safe numbers are written
 * when ladderd has died. The guard holds none of them: the kernel keeps what was written last.
 */
#ifndef GUARD_FILES_H
#define GUARD_FILES_H

#include "guard/place.h"
#include "guard/say.h"

#include <stdbool.h>

struct files {
	struct guard_files known;   /* the last ones of ladderd                */
	struct guard_files more;    /* of another map that is about to be opened */
	struct place known_at[GUARD_FILES], more_at[GUARD_FILES]; /* which device each is of */
	bool told;                  /* that one cannot be written               */
	bool written;               /* all of them, since ladderd said them      */
};

/** files_know - other files; those of files_more() go. Their devices are there now: which ones they are is looked up,
 * as a device may come back with another number (pwmchip0 as pwmchip1). */
void files_know(struct files *files, const struct guard_files *known);
/** files_more - files beside those, until others come or none. */
void files_more(struct files *files, const struct guard_files *more);
/** files_write - writes all safe numbers, once. One that cannot be written is told once, and does not hinder the
 * others. Returns whether all are. */
bool files_write(struct files *files);
#endif
