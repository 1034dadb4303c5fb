/* SPDX-License-Identifier: MIT
 *
 * app - the command line of the editor, its windows, and its end.
 */
#ifndef EDITOR_APP_H
#define EDITOR_APP_H

/** app_run - runs ladder-editor; returns its exit status. */
int app_run(int argc, char **argv);
/** app_style - loads the style sheet of the editor for the display. */
void app_style(void);

#endif
