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
	int64_t number[2 * GUARD_FILES];         /* the safe one              */
	struct place_file file[2 * GUARD_FILES]; /* the last ones of ladderd; behind them those of another map that
						  * is about to be opened     */
	uint16_t known, count;                   /* … of ladderd, and all     */
	uint16_t known_places, known_bytes;      /* what they take of places  */
	bool known_lack, lack;                   /* there was no room for all */
	bool told;                               /* that one cannot be written */
	bool written;                            /* all of them, since ladderd said them */
	struct places places;
};

/** files_begin - no file. */
void files_begin(struct files *files);
/** files_know - other files; those of files_more() go. Their devices are there now: which ones they are is looked up,
 * as a device may come back with another number (pwmchip0 as pwmchip1). Reports one that has no room. */
void files_know(struct files *files, const struct guard_files *known);
/** files_more - files beside those, until others come or none. */
void files_more(struct files *files, const struct guard_files *more);
/** files_write - writes all safe numbers, once. One that cannot be written is reported once, and does not hinder the
 * others. Returns whether all are. */
bool files_write(struct files *files);
#endif
