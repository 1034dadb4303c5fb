/* SPDX-License-Identifier: MIT
 *
 * main - `ladder COMMAND …`: finds the row of the command, runs it, and reports a failed
 * write to standard output.
 */
#include "ladder/command.h"
#include "ladder/report.h"

#include <signal.h>
#include <string.h>

/* A closed pipe then makes write() fail, which is reported. */
static void ignore_sigpipe(void)
{
	struct sigaction action;

	memset(&action, 0, sizeof(action));
	action.sa_handler = SIG_IGN;
	sigemptyset(&action.sa_mask);
	sigaction(SIGPIPE, &action, NULL);
}

static int finish(struct call *call, enum status status)
{
	command_end(call);
	return report_flush(call) ? (int)status : STATUS_WRONG;
}

static bool asks_help(int argc, char **argv)
{
	for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++)
		if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h"))
			return true;
	return false;
}

static enum status run_command(struct call *call, int argc, char **argv)
{
	call->row = command_find(argv[0]);
	if (!call->row)
		return report_usage(call, "\"%.24s\" is not a command",
				    argv[0]);
	if (asks_help(argc - 1, argv + 1)) {
		command_help(call->row, &call->out);
		return STATUS_GOOD;
	}
	if (!command_parse(call, argc - 1, argv + 1))
		return STATUS_WRONG;
	return call->row->run(call);
}

int main(int argc, char **argv)
{
	struct call call = { 0 };

	ignore_sigpipe();
	report_open(&call);
	if (argc < 2) {
		report_usage(&call, "a command is missing");
		return STATUS_WRONG;
	}
	if (!strcmp(argv[1], "--version")) {
		sink_printf(&call.out, "ladder %s\n", LADDER_VERSION);
		return finish(&call, STATUS_GOOD);
	}
	if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")) {
		command_help(NULL, &call.out);
		return finish(&call, STATUS_GOOD);
	}
	return finish(&call, run_command(&call, argc - 1, argv + 1));
}
