/* SPDX-License-Identifier: MIT
 *
 * board_bar - the project's I/O maps, and running it on this machine.
 */
#ifndef EDITOR_BOARD_BAR_H
#define EDITOR_BOARD_BAR_H

#include "editor-gtk/window/files.h"

struct board_bar {
	struct core *core;
	struct export *export;
	struct files *files;
	bool ran;            /* the program came to a scan                       */
	char *said;          /* the state that the log has; NULL: none           */
	bool close_when_off; /* the person closes the window                     */
};

void board_bar_init(struct board_bar *bar, struct core *core, struct export *export,
		    struct files *files);
void board_bar_clear(struct board_bar *bar);
/** board_bar_new_map - asks for a file, and opens it: a point for all that is used. */
void board_bar_new_map(struct board_bar *bar);
/** board_bar_run - with the map in front, or the one chosen below; asks before pins are
 * driven or files are written. */
void board_bar_run(struct board_bar *bar);
void board_bar_stop(struct board_bar *bar);
/** board_bar_look - closes the banner that no map lies beside the program when one does. */
void board_bar_look(struct board_bar *bar);
/** board_bar_may_close - false: something runs; the person is asked, and the window closes
 * itself when outputs are safe. */
bool board_bar_may_close(struct board_bar *bar);

#endif
