/* SPDX-License-Identifier: MIT
 *
 * app - the life of the editor: its command line, its windows, its end.
 */
#ifndef EDITOR_APP_H
#define EDITOR_APP_H

/** app_run - all of ladder-editor; returns its exit status. */
int app_run(int argc, char **argv);

#endif
