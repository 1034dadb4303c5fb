/* SPDX-License-Identifier: MIT
 *
 * cmd_il - `ladder il`: prints the instruction lists that run, as a rung file of IL POUs.
 *
 * It replaces the rungs of the project in memory by the translated lists and writes the
 * project with the ordinary writer. So the output can be read again, except for charts: IL
 * in a rung file has no EACH, TICK or Step.X. Of a code image it prints lists made from the
 * instructions.
 */
#include "ladder/report.h"

#include "engine/exchange/image/image_il.h"

#include <stdio.h>
#include <stdlib.h>

/* Says on standard error what the lists lack. */
static enum status print_image(struct call *call, const struct ladder *ladder)
{
	size_t len;
	char *lost, *text = image_il_text(ladder_program(ladder), &len, &lost);
	const bool whole = !lost;

	if (!text)
		return report_no_memory(call->arg[0]);
	sink_write(&call->out, text, len);
	if (lost)
		fputs(lost, stderr);
	free(text);
	free(lost);
	return whole ? STATUS_GOOD : STATUS_NO;
}

enum status cmd_il(struct call *call)
{
	struct machine machine;
	enum status status = machine_open(&machine, call->arg[0], MACHINE_AS_FILE);
	struct project *project = NULL;
	char *text = NULL;
	size_t len;

	if (status == STATUS_GOOD)
		project = ladder_project(machine.ladder);
	if (project) {
		text = ladder_export_lists(machine.ladder, NULL, &len);
		if (text)
			sink_write(&call->out, text, len);
		else
			status = report_no_memory(call->arg[0]);
	} else if (status == STATUS_GOOD) {
		status = print_image(call, machine.ladder);
	}
	free(text);
	machine_close(&machine);
	return status;
}
