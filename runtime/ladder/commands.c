/* SPDX-License-Identifier: MIT
 *
 * commands - the table of all commands: what each is called, takes and does.
 * What is said here is the help, the man pages and the parser.
 */
#include "ladder/command.h"

static const struct command_row rows[] = {
#include "ladder/commands.def"
	{ .name = NULL },
};

const struct command_row *command_table(void)
{
	return rows;
}
