/* SPDX-License-Identifier: MIT
 *
 * cmd_xref - `ladder xref`: where names and addresses are used. The program need not
 * be without errors, but it must be one that can be read.
 */
#include "ladder/report.h"

#include "engine/xref/xref.h"

static enum status no_image(const char *path)
{
	report_diag((struct diag){ .id = DIAG_IMAGE_NO_TEXT, .file = path },
		    "%s", "");
	return STATUS_NO;
}

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
		status = no_image(call->arg[0]);
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
