/* SPDX-License-Identifier: MIT
 *
 * usage - what ladder-editor prints on a terminal: --help, --version, --keys, its man page.
 *
 * It needs no display.
 */
#ifndef EDITOR_USAGE_H
#define EDITOR_USAGE_H

#include <stdbool.h>

/** usage_main - handles a command line with one of these options; false: it has none.
 * @status: gets the exit status. */
bool usage_main(int argc, char **argv, int *status);
/** usage_compares - is it `--compare OLD NEW`? */
bool usage_compares(int argc, char **argv);

#endif
