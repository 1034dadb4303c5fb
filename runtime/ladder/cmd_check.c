/* SPDX-License-Identifier: MIT
 *
 * cmd_check - `ladder check`: prints every error and warning of programs. It writes no
 * file.
 */
#include "ladder/report.h"

static int warnings_of(const struct diag_list *diags)
{
	return diags->count + diags->dropped - diags->errors;
}

static void print_sum(const char *path, const struct diag_list *diags,
		      const struct sink *out)
{
	int errors = diags->errors, warnings = warnings_of(diags);

	sink_text(out, path);
	if (errors)
		sink_printf(out, ": %d error%s", errors, errors > 1 ? "s" : "");
	else
		sink_text(out, ": good");
	if (warnings)
		sink_printf(out, ", %d warning%s", warnings,
			    warnings > 1 ? "s" : "");
	sink_text(out, "\n");
}

static void print_json(const char *path, const struct diag_list *diags,
		       bool good, bool first, const struct sink *out)
{
	sink_text(out, first ? "\n {\"file\": " : ",\n {\"file\": ");
	sink_json_text(out, path);
	sink_printf(out, ", \"good\": %s, \"errors\": %d, \"warnings\": %d, "
		    "\"dropped\": %d, \"diagnostics\": ",
		    good ? "true" : "false", diags->errors, warnings_of(diags),
		    diags->dropped);
	report_json_diags(diags, out);
	sink_text(out, "}");
}

static enum status check_one(struct call *call, const char *path, bool json,
			     bool first)
{
	struct ladder *ladder = program_new(false);
	enum status status = STATUS_WRONG;

	if (!ladder)
		return report_no_memory(path);
	if (!json) {
		status = report_load(ladder, path, true);
	} else {
		bool good = ladder_load(ladder, path) && ladder_build(ladder);

		if (good)
			status = STATUS_GOOD;
		else if (ladder_could_read(ladder))
			status = STATUS_NO;
	}
	if (json)
		print_json(path, ladder_diags(ladder), status == STATUS_GOOD,
			   first, &call->out);
	else if (status != STATUS_WRONG)
		print_sum(path, ladder_diags(ladder), &call->out);
	ladder_free(ladder);
	return status;
}

enum status cmd_check(struct call *call)
{
	bool json = call_flag(call, "--json");
	enum status worst = STATUS_GOOD;

	if (json)
		sink_text(&call->out, "[");
	for (int i = 0; i < call->arg_count && !call->out_failed; i++) {
		enum status status = check_one(call, call->arg[i], json, !i);

		if (status > worst)
			worst = status;
	}
	if (json)
		sink_text(&call->out, "\n]\n");
	return worst;
}
