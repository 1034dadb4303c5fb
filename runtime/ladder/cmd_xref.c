/* SPDX-License-Identifier: MIT
 *
 * cmd_xref - `ladder xref`: lists where names and addresses are used. The program may have
 * errors, if it can be read.
 */
#include "ladder/report.h"

#include "engine/xref/xref.h"

enum status cmd_xref(struct call *call)
{
	const char *name = call->arg_count > 1 ? call->arg[1] : NULL;
	struct ladder *ladder = program_new(false);
	enum status status;
	int shown;

	if (!ladder)
		return report_no_memory(call->arg[0]);
	status = report_load(ladder, call->arg[0], false);
	if (status == STATUS_GOOD && !ladder_project(ladder))
		status = report_no_text(call->arg[0]);
	if (status == STATUS_GOOD) {
		struct xref_lines lines = { ladder_import_line, ladder };

		shown = xref_print(ladder_project(ladder), name,
				   call_flag(call, "--json"), &lines, &call->out);
		if (shown < 0)
			status = report_no_memory(call->arg[0]);
		else if (shown == 0 && name)
			status = STATUS_NO;
	}
	ladder_free(ladder);
	return status;
}
