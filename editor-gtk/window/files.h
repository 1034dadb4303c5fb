/* SPDX-License-Identifier: MIT
 *
 * files - opening, saving and closing files, and changes of a file by other programs.
 *
 * Unsaved changes are dropped only if the person says so. A failure is shown in a banner,
 * and the changes are kept.
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
	bool closing;             /* the question was answered                   */
	bool close_when_saved;    /* saving was asked for by closing             */
	enum disk_state disk_told; /* the change on the disk reported last       */
	bool over_locked;         /* the person agreed to overwrite a read-only file */
};

void files_init(struct files *files, struct core *core, struct origin *origin,
		struct exchange *exchange);
/** files_open - asks for a file and emits "open-wanted". */
void files_open(struct files *files);
/** files_import - the same, for a project of another program. */
void files_import(struct files *files);
/** files_save - saves the file in front, else the program and all changed files in tabs. */
void files_save(struct files *files);
void files_save_as(struct files *files);
/** files_save_over - saves the program even if its file changed on the disk. Without
 * @locked, asks before it writes a read-only file. */
void files_save_over(struct files *files, bool locked);
/** files_reload - reads the program from its file again. */
void files_reload(struct files *files);
/** files_is_all_saved - are the program and the files beside it saved? */
bool files_is_all_saved(struct files *files);
/** files_save_all - false: one could not be saved, or a question is open. */
bool files_save_all(struct files *files);
/** files_tell - warns by a banner if the file has bytes that are not text, or is read-only. */
void files_tell(struct files *files);
/** files_may_close - false: a question is open; its answer closes the window. */
bool files_may_close(struct files *files);
/** files_look - reports if another program changed the file. */
void files_look(struct files *files);
/** files_keep_drafts - writes drafts of all unsaved files now. */
void files_keep_drafts(struct files *files);
/** files_restore - opens the draft of a file beside the project. False: no new draft could
 * be written, which is reported. */
bool files_restore(struct files *files, const struct draft *draft);

#endif
