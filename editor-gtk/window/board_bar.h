/* SPDX-License-Identifier: MIT
 *
 * board_bar - I/O maps of the project, and running it on this machine.
 */
#ifndef EDITOR_BOARD_BAR_H
#define EDITOR_BOARD_BAR_H

#include "editor-gtk/window/files.h"

struct board_bar {
	struct core *core;
	struct export *export;
	struct files *files;
	bool ran;            /* at least one scan has run                        */
	char *said;          /* the state logged last; NULL: none                */
	char *inside;        /* where the window was connected to what runs; NULL: not    */
	bool close_when_off; /* close the window when the program has stopped    */
};

void board_bar_init(struct board_bar *bar, struct core *core, struct export *export,
		    struct files *files);
void board_bar_clear(struct board_bar *bar);
/** board_bar_new_map - asks for a file and writes a map with a point for each used address. */
void board_bar_new_map(struct board_bar *bar);
/** board_bar_run - runs with the map in front, else with the one chosen in its panel; asks
 * before pins are driven or files are written. */
void board_bar_run(struct board_bar *bar);
void board_bar_stop(struct board_bar *bar);
/** board_bar_look - closes the banner "no I/O map" if the project has one now. */
void board_bar_look(struct board_bar *bar);
/** board_bar_may_close - true: nothing runs. Else asks, and closes the window when the
 * outputs are safe. */
bool board_bar_may_close(struct board_bar *bar);

#endif
