/* SPDX-License-Identifier: MIT
 *
 * app - the life of the editor: its command line, its windows, its end.
 */
#ifndef EDITOR_APP_H
#define EDITOR_APP_H

#include "editor-gtk/window/window.h"

#define APP_ID "org.rungboard.Editor"

/** app_run - all of ladder-editor; returns its exit status. */
int app_run(int argc, char **argv);
/** app_style - gives the display the editor's style sheet: for all its windows. */
void app_style(void);
/** app_new_window - with a new project. */
void app_new_window(LadderWindow *window);
/** app_open_path - in the window, if nothing was done in it yet; else in another. */
void app_open_path(LadderWindow *window, const char *path);
/** app_open_sample - a copy without a file, likewise. */
void app_open_sample(LadderWindow *window, const char *path);

#endif
