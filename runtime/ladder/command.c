/* SPDX-License-Identifier: MIT
 *
 * command - parses a command line by the row of its command. Options cannot be
 * abbreviated.
 */
#include "ladder/command.h"

#include "ladder/paths.h"
#include "ladder/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct option_row *find_option(const struct command_row *row,
					    const char *text, size_t len)
{
	for (int i = 0; i < COMMAND_OPTIONS && row->option[i].name; i++)
		if (strlen(row->option[i].name) == len &&
		    !memcmp(row->option[i].name, text, len))
			return &row->option[i];
	return NULL;
}

/* @what: "needs a value", behind the quoted @text. */
static bool wrong(const struct call *call, const char *text, const char *what)
{
	report_usage(call, "\"%.30s\" %s", text, what);
	return false;
}

/* Reads the option argv[*i] and its value, which is in the same word or the next. */
static bool take_option(struct call *call, int argc, char **argv, int *i)
{
	const char *text = argv[*i], *equals = strchr(text, '=');
	size_t len = equals ? (size_t)(equals - text) : strlen(text);
	const struct option_row *row = find_option(call->row, text, len);
	struct given *given = &call->given[call->given_count];

	if (!row)
		return wrong(call, text, "is not an option of this command");
	if (call->given_count == COMMAND_GIVEN)
		return wrong(call, text, "is one option too many");
	if (!row->value && equals)
		return wrong(call, text, "takes no value");
	given->row = row;
	given->value = equals ? equals + 1 : NULL;
	if (row->value && !equals) {
		if (*i + 1 == argc)
			return wrong(call, text, "needs a value");
		given->value = argv[++*i];
	}
	call->given_count++;
	return true;
}

/* Is it one file, or a folder, of a project of plain IEC text? */
static bool is_part(const char *path)
{
	return path_is_folder(path) ? !ladder_import_format(path) : path_is_plain(path);
}

/* @count arguments become one, a line each; false: no memory. */
static bool join_args(struct call *call, char **arg, int count)
{
	char **grown = realloc(call->joined, sizeof(*grown) * (size_t)(call->joined_count + 1));
	size_t size = 1, at = 0;
	char *text;

	if (!grown)
		return false;
	call->joined = grown;
	for (int i = 0; i < count; i++)
		size += strlen(arg[i]) + 1;
	text = malloc(size);
	if (!text)
		return false;
	for (int i = 0; i < count; i++)
		at += (size_t)snprintf(text + at, size - at, i ? "\n%s" : "%s", arg[i]);
	call->joined[call->joined_count++] = arg[0] = text;
	return true;
}

/* Where a row takes a FILE, several files of plain IEC text, or folders of them, are one project. */
static bool join_projects(struct call *call)
{
	int out = 0;

	if (strncmp(call->row->arguments, "FILE", 4) != 0)
		return true;
	for (int i = 0, count; i < call->arg_count; i += count) {
		for (count = 0; i + count < call->arg_count && is_part(call->arg[i + count]);)
			count++;
		if (count > 1 && !join_args(call, &call->arg[i], count))
			return false;
		count += !count;
		call->arg[out++] = call->arg[i];
	}
	call->arg_count = out;
	return true;
}

void command_end(struct call *call)
{
	while (call->joined_count > 0)
		free(call->joined[--call->joined_count]);
	free(call->joined);
	call->joined = NULL;
}

bool command_parse(struct call *call, int argc, char **argv)
{
	bool options = true;

	call->arg = argv;
	for (int i = 0; i < argc; i++) {
		if (options && !strcmp(argv[i], "--")) {
			options = false;
		} else if (options && argv[i][0] == '-' && argv[i][1]) {
			if (!take_option(call, argc, argv, &i))
				return false;
		} else {
			call->arg[call->arg_count++] = argv[i];
		}
	}
	if (!join_projects(call)) {
		report_no_memory("ladder");
		return false;
	}
	if (call->arg_count < call->row->least) {
		report_usage(call, "this command needs %.30s", call->row->arguments);
		return false;
	}
	if (call->row->most >= 0 && call->arg_count > call->row->most)
		return wrong(call, call->arg[call->row->most],
			     "is one argument too many");
	return true;
}

/* The last one of that name; NULL: none. */
static const struct given *find_given(const struct call *call, const char *name)
{
	for (int i = call->given_count; i-- > 0;)
		if (!strcmp(call->given[i].row->name, name))
			return &call->given[i];
	return NULL;
}

const char *call_option(const struct call *call, const char *name)
{
	const struct given *given = find_given(call, name);

	return given ? given->value : NULL;
}

bool call_flag(const struct call *call, const char *name)
{
	return find_given(call, name);
}
