/* SPDX-License-Identifier: MIT
 *
 * files - opening, saving and closing, what is asked before, and what others do to the file
 * meanwhile.
 *
 * Unsaved work is lost only when the person says so. What cannot be done is told in a banner,
 * and the work is kept.
 */
#ifndef EDITOR_FILES_H
#define EDITOR_FILES_H

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/draft.h"
#include "editor-gtk/window/exchange.h"

struct files {
	struct core *core;
	struct origin *origin;
	struct exchange *exchange;
	bool closing;             /* the person has been asked                   */
	bool close_when_saved;    /* the file dialog was opened by closing       */
	enum disk_state disk_told; /* what was told of the file                  */
	bool over_locked;         /* the person saves over a read-only file      */
};

void files_init(struct files *files, struct core *core, struct origin *origin,
		struct exchange *exchange);
/** files_open - asks for a file; the window's "open-wanted" opens it. */
void files_open(struct files *files);
/** files_save - the file in front, or the program. */
void files_save(struct files *files);
void files_save_as(struct files *files);
/** files_save_over - the program, whatever is in its file now. A read-only file is written
 * only with @locked; else the person is asked. */
void files_save_over(struct files *files, bool locked);
/** files_reload - reads the program again. */
void files_reload(struct files *files);
/** files_is_all_saved - the program and the files beside it. */
bool files_is_all_saved(struct files *files);
/** files_save_all - false: one could not be saved, or the person is asked first. */
bool files_save_all(struct files *files);
/** files_tell - a banner if its file holds bytes that are no text, or is read-only: saving
 * asks before it writes over that. */
void files_tell(struct files *files);
/** files_may_close - false: the person is asked first, and the window closes itself. */
bool files_may_close(struct files *files);
/** files_look - tells if somebody else changed the file. */
void files_look(struct files *files);
/** files_keep_drafts - of all that is not saved, at once. */
void files_keep_drafts(struct files *files);
/** files_restore - the draft of a file beside the project, in front. False: it could not be
 * kept as a draft again, which is told. */
bool files_restore(struct files *files, const struct draft *draft);

#endif
