/* SPDX-License-Identifier: MIT
 *
 * board_finder - where a board could be: this machine, boards that were connected before, boards
 * that announce themselves in the network, serial ports.
 *
 * The list changes as they come and go. It connects to none of them.
 *
 * Signal: changed ().
 */
#ifndef EDITOR_BOARD_FINDER_H
#define EDITOR_BOARD_FINDER_H

#include <gio/gio.h>
#include <stdbool.h>

#define LADDER_TYPE_BOARD_FINDER (ladder_board_finder_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardFinder, ladder_board_finder, LADDER, BOARD_FINDER, GObject)

enum found_kind { FOUND_HERE, FOUND_RECENT, FOUND_NETWORK, FOUND_SERIAL };
struct board_found {
	enum found_kind kind;
	char *where;           /* as stream_parse() reads it                   */
	char *title, *about;   /* for a person                                 */
	char *key;             /* of the service in the network; NULL: none    */
};

/** ladder_board_finder_new - @dev: folder of the devices; NULL: /dev. */
LadderBoardFinder *ladder_board_finder_new(const char *dev);
/** ladder_board_finder_list - of struct board_found, by kind. Borrowed until `changed`. */
GPtrArray *ladder_board_finder_list(LadderBoardFinder *finder);
/** ladder_board_finder_why - why no board in the network can be found, translated; NULL: it is
 * looked for. Borrowed until `changed`. */
const char *ladder_board_finder_why(LadderBoardFinder *finder);
/** board_recent_add - makes @where the newest of the boards that were connected. */
void board_recent_add(const char *where);

#endif
