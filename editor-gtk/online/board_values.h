/* SPDX-License-Identifier: MIT
 *
 * board_values - the simulation shows a board while a link is connected to it.
 *
 * It finds the program that the board runs, has the board publish what the views need, and
 * turns acts of a person into requests. It follows the link by itself: the views show the board
 * from its first values on, nothing while the link is lost, and the new program when the board
 * gets one. It has no widget.
 *
 * It tells by `told` of the simulation why the views show nothing although the link is connected.
 * Signal: mended (const char *why): this is true no more.
 */
#ifndef EDITOR_BOARD_VALUES_H
#define EDITOR_BOARD_VALUES_H

#include "editor-gtk/online/board_link.h"
#include "editor-gtk/sim/sim.h"

#define LADDER_TYPE_BOARD_VALUES (ladder_board_values_get_type())
G_DECLARE_FINAL_TYPE(LadderBoardValues, ladder_board_values, LADDER, BOARD_VALUES, GObject)

/** ladder_board_values_new - @sim, @link: referenced. What @sim runs ends when the link is
 * connected. */
LadderBoardValues *ladder_board_values_new(LadderSim *sim, LadderBoardLink *link);
/** ladder_board_values_took_read - whether the board logs a read of its program that no person
 * wanted: it was read to show its values. True once for each. */
bool ladder_board_values_took_read(LadderBoardValues *values);
/** ladder_board_values_again - if none are shown: looks for the program of the board again, at its
 * next status. */
void ladder_board_values_again(LadderBoardValues *values);

#endif
