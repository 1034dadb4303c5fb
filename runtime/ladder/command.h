/* SPDX-License-Identifier: MIT
 *
 * command - a command of `ladder` as a row of a table, and the call of a command.
 *
 * Arguments, --help and the man page come from the row. A command returns an exit status;
 * it never ends the program itself.
 */
#ifndef LADDER_COMMAND_H
#define LADDER_COMMAND_H

#include "engine/base/sink.h"
#include "engine/ladder.h"

#define COMMAND_OPTIONS 16
#define COMMAND_GIVEN 256 /* options on one command line                      */

/* Exit status of `ladder`; scripts rely on it. command_help.c has the text. */
enum status { STATUS_GOOD, STATUS_NO, STATUS_WRONG };

struct option_row {
	const char *name;   /* "--json", "-o"                                 */
	const char *value;  /* "N"; NULL: it takes none                       */
	const char *doc;
};

struct call;

struct command_row {
	const char *name;
	const char *arguments; /* "FILE..."                                   */
	const char *purpose;   /* one line                                    */
	const char *text;      /* paragraph for --help and the man page       */
	const char *example;   /* lines of shell                              */
	int least, most;       /* arguments; most -1: any number              */
	enum status (*run)(struct call *call);
	struct option_row option[COMMAND_OPTIONS];
};

struct given {
	const struct option_row *row;
	const char *value;
};

struct call {
	const struct command_row *row;
	char **arg;            /* the arguments without options; files of plain IEC text
				  that make one project are one, each on a line */
	char **joined;         /* those that are malloc'ed                    */
	int joined_count;
	int arg_count;
	struct given given[COMMAND_GIVEN];
	int given_count;
	struct sink out;       /* the results: standard output                */
	bool out_failed;       /* a write to it failed                        */
};

/** command_find - NULL: there is no such command. */
const struct command_row *command_find(const char *name);

/**
 * command_parse - fills @call from @argv
 * @argv: the words after the command's name; reordered, borrowed by @call
 *
 * Fails: false after a message about wrong usage.
 */
bool command_parse(struct call *call, int argc, char **argv);
/** command_end - frees what command_parse() made. */
void command_end(struct call *call);
/** call_option - the last value of an option; NULL: not given. */
const char *call_option(const struct call *call, const char *name);
/** call_flag - whether an option was given. */
bool call_flag(const struct call *call, const char *name);

/** command_help - prints what --help prints; @row NULL: for `ladder` itself. */
void command_help(const struct command_row *row, const struct sink *out);

#define COMMAND(name, ...) enum status cmd_##name(struct call *call);
#include "ladder/commands.def"
#endif
