/* SPDX-License-Identifier: MIT
 *
 * press - a press that a grab has ended is not ended again, and nothing stays pressed.
 *
 * Mends in GTK 4.8.3: GTK counts for each widget how many presses it is in. A menu that opens at a
 * press, or a row that is dragged, takes the pointer from the window. When GTK hears of the broken grab
 * it ends the press for the widget that is below the pointer by then, not for the one that was pressed:
 * it warns "Broken accounting of active state", and the pressed one stays marked as if a button was held.
 * To see it: run tests/editor/kit/gtk48/test_press.c, or storms 4 and 59, without press_init(). Try it
 * without on each new floor.
 */
#ifndef EDITOR_GTK48_PRESS_H
#define EDITOR_GTK48_PRESS_H

/** press_init - once for the program, when the display is open. */
void press_init(void);

#endif
