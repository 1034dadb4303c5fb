/* SPDX-License-Identifier: MIT
 *
 * cmd_trace - `ladder trace`: runs a stimulus script in virtual time and prints the
 * variables after each scan.
 */
#include "ladder/report.h"

#include "engine/trial/script.h"
#include "engine/trial/value.h"

#include <stdlib.h>

static enum status run(struct call *call, struct machine *machine,
		       enum trace_form form, int64_t period_ns)
{
	struct trace trace;
	size_t len;
	char *text = report_read(call->arg[1], &len);
	struct diag_list *diags = text ? report_list(call->arg[1]) : NULL;
	enum status status = STATUS_WRONG;

	if (diags) {
		trace_init(&trace, &machine->resource.image, &call->out, form,
			   call_flag(call, "--changes"));
		trace.project = ladder_project(machine->ladder);
		trace.stop = &call->out_failed;
		status = script_run(call->arg[1], text, len, period_ns,
				    &machine->resource, machine_plant(machine), &trace,
				    diags) ? STATUS_GOOD : STATUS_NO;
		trace_free(&trace);
		report_end(diags);
	}
	free(text);
	return status;
}

enum status cmd_trace(struct call *call)
{
	bool csv = call_flag(call, "--csv"), vcd = call_flag(call, "--vcd");
	struct machine machine;
	enum status status;
	int64_t period_ns;

	if (csv && vcd)
		return report_usage(call, "--csv and --vcd cannot be used together");
	if (!report_period(call, "--period", 0, &period_ns))
		return STATUS_WRONG;
	status = machine_open_call(&machine, call,
				   call_flag(call, "--faithful") ? MACHINE_FAITHFUL : 0);
	if (status == STATUS_GOOD) {
		machine_skip(&machine, call);
		status = run(call, &machine, csv ? TRACE_CSV :
			     vcd ? TRACE_VCD : TRACE_LINES,
			     program_period(machine.ladder, period_ns));
	}
	machine_close(&machine);
	return status;
}
