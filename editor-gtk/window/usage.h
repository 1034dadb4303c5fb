/* SPDX-License-Identifier: MIT
 *
 * usage - what ladder-editor says on a terminal: --help, --version, --keys, its man page.
 *
 * Nothing of it needs a display.
 */
#ifndef EDITOR_USAGE_H
#define EDITOR_USAGE_H

#include <stdbool.h>

/** usage_main - answers a command line that asks for one of these; false: it does not.
 * @status: gets the exit status. */
bool usage_main(int argc, char **argv, int *status);

#endif
