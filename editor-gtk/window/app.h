/* SPDX-License-Identifier: MIT
 *
 * app - the life of the editor: its command line, its windows, its end.
 */
#ifndef EDITOR_APP_H
#define EDITOR_APP_H

/** app_run - all of ladder-editor; returns its exit status. */
int app_run(int argc, char **argv);
/** app_style - gives the display the editor's style sheet: for all its windows. */
void app_style(void);

#endif
