/* SPDX-License-Identifier: MIT
 *
 * cmd_run - `ladder run`: runs a program on simulated pins in real time. In a terminal it
 * shows a live table, elsewhere it prints lines.
 */
#include "ladder/live.h"
#include "ladder/rungs.h"
#include "ladder/tty.h"

#include "engine/trial/script.h"
#include "engine/trial/trace.h"
#include "engine/trial/value.h"
#include "hal/clock.h"

#include <stdlib.h>
#include <string.h>

static enum status tell_fault(const struct board *board, const char *path)
{
	struct diag_list *diags = report_list(path);

	if (!diags)
		return STATUS_WRONG;
	script_fault(board->resource, path, 0, diags);
	report_end(diags);
	return STATUS_NO;
}

static void tell_halt(const struct board *board, struct trace *trace)
{
	char text[96];

	resource_halt_print(board->resource, text, sizeof(text));
	trace_note(trace, text, strlen(text));
}

static bool add_columns(struct trace *trace, const struct board *board)
{
	struct diag place = { .file = "ladder run" };
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good = diags && trace_show_all(trace);

	/* Bits without a name are shown by their address. */
	for (int side = 0; side < 2 && good; side++) {
		const struct lamps *lamps = side ? &board->output :
						   &board->input;

		for (int i = 0; i < lamps->count && good; i++) {
			const char *text = lamps->lamp[i].address;

			if (!*lamps->lamp[i].name)
				good = trace_show(trace, text, strlen(text),
						  diags, place);
		}
	}
	free(diags);
	return good;
}

/* Prints and flushes a line for every scan that changes something. */
static enum status run_plain(struct call *call, struct board *board,
			     struct pace *pace)
{
	struct trace trace;
	bool good = true;

	trace_init(&trace, &board->resource->image, &call->out, TRACE_LINES,
		   true);
	if (!add_columns(&trace, board)) {
		trace_free(&trace);
		return report_no_memory(call->arg[0]);
	}
	tty_watch_signals();
	pace_start(pace, clock_now());
	while (good && !tty_stopped() && !pace_is_over(pace)) {
		int64_t wait = pace_wait(pace, clock_now());

		if (wait > 0) {
			tty_sleep(wait);
			continue;
		}
		good = board_scan(board, pace_step(pace));
		trace_scan(&trace, pace->scans, pace->now_ns);
		if (board->resource->halted)
			tell_halt(board, &trace);
		if (!report_flush(call))
			break;
	}
	trace_free(&trace);
	return good || board->resource->halted ? STATUS_GOOD :
						 tell_fault(board, call->arg[0]);
}

static enum status apply_settings(struct call *call, const struct project *project,
				  struct board *board)
{
	struct image *image = &board->resource->image;
	struct diag place = { .file = "--set" };
	struct diag_list *diags = report_list(place.file);

	if (!diags)
		return STATUS_WRONG;
	for (int i = 0; i < call->given_count; i++) {
		const char *text = call->given[i].value;
		struct setting setting;

		if (strcmp(call->given[i].row->name, "--set") != 0)
			continue;
		if (setting_parse(image, project, text, strlen(text), &setting, diags, place))
			board_set(board, setting.at, setting.value);
	}
	return report_end(diags) ? STATUS_GOOD : STATUS_WRONG;
}

static enum status take_pace(struct call *call, struct pace *pace)
{
	const char *speed = call_option(call, "--speed");
	int64_t scans;
	char *end;

	if (!report_period(call, "--period", 0, &pace->period_ns) ||
	    !report_count(call, "--scans", 0, INT64_MAX / 2, &scans))
		return STATUS_WRONG;
	pace->speed = 1;
	if (speed) {
		pace->speed = strtod(speed, &end);
		if (end == speed || *end ||
		    !(pace->speed >= 1e-6 && pace->speed <= 1e9))
			return report_usage(call, "--speed needs a number "
					    "such as 10, not %.12s", speed);
	}
	pace->most = (uint64_t)scans;
	return STATUS_GOOD;
}

/* The period of the tasks, as in ladderd. */
static void settle_pace(struct pace *pace, const struct program *program)
{
	pace->period_ns = tasks_tick(program, pace->period_ns, 10 * VALUE_MS);
	pace->wall_period_ns = (double)pace->period_ns / pace->speed;
}

static enum status run(struct call *call, struct machine *machine,
		       struct pace *pace)
{
	struct board *board = calloc(1, sizeof(*board));
	enum status status;

	if (!board)
		return report_no_memory(call->arg[0]);
	status = board_open(board, machine, call_option(call, "--io"));
	if (status == STATUS_GOOD)
		status = apply_settings(call, ladder_project(machine->ladder), board);
	if (status == STATUS_GOOD && tty_is() && !call_flag(call, "--plain")) {
		status = live_run(call, board, pace, ladder_project(machine->ladder),
				  call_option(call, "--rungs"));
		if (board->resource->state == STATE_FAULT)
			status = tell_fault(board, call->arg[0]);
	} else if (status == STATUS_GOOD) {
		status = run_plain(call, board, pace);
	}
	board_close(board);
	free(board);
	return status;
}

/* Checks that --rungs names something, before the terminal becomes a live table. */
static enum status watch_rungs(struct call *call, struct machine *machine,
			       const char *rungs)
{
	const struct sink nowhere = report_nowhere();
	const struct show_options options = { .width = 0 };
	const struct project *project = ladder_project(machine->ladder);

	machine->resource.watch = true;
	if (project && rungs_show(project, rungs, &machine->resource, NULL, options,
				  &nowhere) > 0)
		return STATUS_GOOD;
	return report_missing(call, "rung or instance", rungs);
}

enum status cmd_run(struct call *call)
{
	struct pace pace = { 0 };
	struct machine machine;
	const char *rungs = call_option(call, "--rungs");
	enum status status = take_pace(call, &pace);

	if (status != STATUS_GOOD)
		return status;
	status = machine_open_call(&machine, call,
				   rungs ? MACHINE_WATCHED : MACHINE_AS_FILE);
	if (status == STATUS_GOOD && rungs)
		status = watch_rungs(call, &machine, rungs);
	if (status == STATUS_GOOD) {
		machine_skip(&machine, call);
		settle_pace(&pace, ladder_program(machine.ladder));
		status = run(call, &machine, &pace);
	}
	machine_close(&machine);
	return status;
}
