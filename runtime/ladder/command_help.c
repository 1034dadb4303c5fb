/* SPDX-License-Identifier: MIT
 *
 * command_help - the table of commands, and --help and man pages from its rows.
 */
#include "ladder/command.h"
#include "ladder/report.h"

#include <stdio.h>
#include <string.h>

static const struct command_row rows[] = {
#define COMMAND(name, arguments, purpose, text, example, least, most, ...) \
	{ #name, arguments, purpose, text, example, least, most, cmd_##name, { __VA_ARGS__ } },
#include "ladder/commands.def"
	{ .name = NULL },
};

const struct command_row *command_find(const char *name)
{
	const struct command_row *row = rows;

	while (row->name && strcmp(row->name, name) != 0)
		row++;
	return row->name ? row : NULL;
}

static const char exit_status[] =
	"0 good, also with warnings; 1 the answer is no (errors in a text, a "
	"test failed, files differ); 2 wrong usage, a file that cannot be read "
	"at all, or a result that cannot be written.";

static const char about[] =
	"Rungboard's command line: checks, shows, runs and tests ladder "
	"programs (rung files). Results go to standard output, diagnostics "
	"to standard error.";

/* Breaks @text into lines of at most 76 columns, each with @indent before it. */
static void print_wrapped(const char *text, const char *indent,
			  const struct sink *out)
{
	size_t column = 0;

	while (*text) {
		size_t len = strcspn(text, " \n");

		if (column && column + len + 1 > 76) {
			sink_text(out, "\n");
			column = 0;
		}
		sink_text(out, column ? " " : indent);
		column += column ? 1 : strlen(indent);
		sink_write(out, text, len);
		column += len;
		text += len;
		if (*text == '\n') {
			sink_text(out, "\n");
			column = 0;
		}
		text += *text != '\0';
	}
	if (column)
		sink_text(out, "\n");
}

static void print_lines(const char *text, const struct sink *out)
{
	while (*text) {
		size_t len = strcspn(text, "\n");

		sink_text(out, "  ");
		sink_write(out, text, len);
		sink_text(out, "\n");
		text += len + (text[len] == '\n');
	}
}

static void print_options(const struct command_row *row,
			  const struct sink *out)
{
	sink_text(out, "\nOptions:\n");
	for (int i = 0; i < COMMAND_OPTIONS && row->option[i].name; i++) {
		const struct option_row *option = &row->option[i];
		char form[40];

		snprintf(form, sizeof(form), "%s%s%s", option->name,
			 option->value ? " " : "",
			 option->value ? option->value : "");
		sink_printf(out, "  %-16s %s\n", form, option->doc);
	}
	sink_printf(out, "  %-16s %s\n", "--help", "this text");
}

static void help_all(const struct sink *out)
{
	sink_text(out, "Usage: ladder COMMAND [OPTION]... [ARGUMENT]...\n\n");
	print_wrapped(about, "", out);
	sink_text(out, "\nCommands:\n");
	for (const struct command_row *row = rows; row->name; row++)
		sink_printf(out, "  %-8s %s\n", row->name, row->purpose);
	sink_text(out, "\nOptions:\n"
		  "  --help      this text; behind a command: how to use it\n"
		  "  --version   the version of this program\n"
		  "\nExample:\n"
		  "  ladder check garage.rung && ladder run garage.rung\n"
		  "\nExit status:\n");
	print_wrapped(exit_status, "  ", out);
}

void command_help(const struct command_row *row, const struct sink *out)
{
	if (!row) {
		help_all(out);
		return;
	}
	sink_printf(out, "Usage: ladder %s [OPTION]... %s\n\n", row->name,
		    row->arguments);
	sink_printf(out, "ladder %s: %s.\n\n", row->name, row->purpose);
	print_wrapped(row->text, "", out);
	print_options(row, out);
	sink_text(out, "\nExample:\n");
	print_lines(row->example, out);
	sink_text(out, "\nExit status:\n");
	print_wrapped(exit_status, "  ", out);
}

/* Escapes text for roff: dots and quotes at the start of a line, backslash and minus. */
static void roff(const char *text, const struct sink *out)
{
	bool start = true;

	for (; *text; text++) {
		if (start && (*text == '.' || *text == '\''))
			sink_text(out, "\\&");
		start = *text == '\n';
		if (*text == '\\')
			sink_text(out, "\\e");
		else if (*text == '-')
			sink_text(out, "\\-");
		else
			sink_write(out, text, 1);
	}
}

static void man_head(const char *name, const char *purpose,
		     const struct sink *out)
{
	const char *dash = *name ? "-" : "";

	sink_printf(out, ".TH \"LADDER%s", dash);
	for (const char *at = name; *at; at++)
		sink_printf(out, "%c", *at >= 'a' && *at <= 'z' ? *at - 32 :
								  *at);
	sink_printf(out, "\" 1 \"\" \"Rungboard %s\" \"Rungboard\"\n"
		    ".SH NAME\nladder%s%s \\- ", LADDER_VERSION, dash, name);
	roff(purpose, out);
	sink_text(out, "\n");
}

static void man_option(const char *name, const char *value, const char *doc,
		       const struct sink *out)
{
	sink_text(out, ".TP\n.B ");
	roff(name, out);
	if (value) {
		sink_text(out, " \\fI");
		roff(value, out);
		sink_text(out, "\\fR");
	}
	sink_text(out, "\n");
	roff(doc, out);
	sink_text(out, "\n");
}

static void man_status(const struct sink *out)
{
	sink_text(out, ".SH EXIT STATUS\n");
	roff(exit_status, out);
	sink_text(out, "\n");
}

static void man_all(const struct sink *out)
{
	man_head("", "works with ladder programs", out);
	sink_text(out, ".SH SYNOPSIS\n.B ladder\n.I COMMAND\n"
		  "[\\fIOPTION\\fR]... [\\fIARGUMENT\\fR]...\n"
		  ".SH DESCRIPTION\n");
	roff(about, out);
	sink_text(out, "\n.SH COMMANDS\n");
	for (const struct command_row *row = rows; row->name; row++)
		man_option(row->name, NULL, row->purpose, out);
	man_status(out);
	sink_text(out, ".SH SEE ALSO\n");
	for (const struct command_row *row = rows; row->name; row++)
		sink_printf(out, ".BR ladder\\-%s (1)%s\n", row->name,
			    row[1].name ? "," : "");
}

/* Prints a man page in roff; @row NULL: for `ladder` itself. */
static void command_man(const struct command_row *row, const struct sink *out)
{
	if (!row) {
		man_all(out);
		return;
	}
	man_head(row->name, row->purpose, out);
	sink_printf(out, ".SH SYNOPSIS\n.B ladder %s\n[\\fIOPTION\\fR]... \\fI",
		    row->name);
	roff(row->arguments, out);
	sink_text(out, "\\fR\n.SH DESCRIPTION\n");
	roff(row->text, out);
	sink_text(out, "\n.SH OPTIONS\n");
	for (int i = 0; i < COMMAND_OPTIONS && row->option[i].name; i++)
		man_option(row->option[i].name, row->option[i].value,
			   row->option[i].doc, out);
	man_option("--help", NULL, "how to use this command", out);
	sink_text(out, ".SH EXAMPLE\n.nf\n");
	roff(row->example, out);
	sink_text(out, "\n.fi\n");
	man_status(out);
	sink_text(out, ".SH SEE ALSO\n.BR ladder (1)\n");
}

enum status cmd_help(struct call *call)
{
	const struct command_row *row = NULL;

	if (call_flag(call, "--names")) {
		for (row = rows; row->name; row++)
			sink_printf(&call->out, "%s\n", row->name);
		return STATUS_GOOD;
	}
	if (call->arg_count) {
		row = command_find(call->arg[0]);
		if (!row)
			return report_usage(call, "\"%.24s\" is not a command",
					    call->arg[0]);
	}
	if (call_flag(call, "--man"))
		command_man(row, &call->out);
	else
		command_help(row, &call->out);
	return STATUS_GOOD;
}
