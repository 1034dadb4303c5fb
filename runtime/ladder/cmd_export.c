/* SPDX-License-Identifier: MIT
 *
 * cmd_export - `ladder export`: a program in another language. Of charts there are
 * ladders; what comes out is read, checked and written in canonical form.
 */
#include "ladder/report.h"

#include "engine/base/file.h"

#include <stdlib.h>
#include <string.h>

static enum status write_out(struct call *call, const char *text, size_t len)
{
	const char *path = call_option(call, "-o");
	struct diag_list *diags;
	bool good;

	if (!path) {
		sink_write(&call->out, text, len);
		return STATUS_GOOD;
	}
	diags = calloc(1, sizeof(*diags));
	if (!diags)
		return report_no_memory(path);
	diag_init(diags);
	good = file_save(path, text, len, diags);
	report_diags(diags);
	free(diags);
	return good ? STATUS_GOOD : STATUS_WRONG;
}

/* @text: as the engine made it. */
static enum status write_canonical(struct call *call, const char *path, const char *text,
				   size_t len)
{
	struct ladder *ladder = ladder_new();
	enum status status = STATUS_NO;
	char *out;

	if (!ladder)
		return report_no_memory(path);
	if (ladder_load_text(ladder, path, text, len)) {
		out = ladder_write(ladder, &len);
		status = out ? write_out(call, out, len) : report_no_memory(path);
		free(out);
	}
	report_diags(ladder_diags(ladder));
	ladder_free(ladder);
	return status;
}

static enum status export_loaded(struct call *call, struct ladder *ladder,
				 const char *path)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	enum status status = STATUS_NO;
	size_t len;
	char *text;

	if (!diags)
		return report_no_memory(path);
	diag_init(diags);
	text = ladder_export_ladder(ladder, &len, diags);
	report_diags(diags);
	free(diags);
	if (text)
		status = write_canonical(call, path, text, len);
	free(text);
	return status;
}

enum status cmd_export(struct call *call)
{
	const char *path = call->arg[0], *as = call_option(call, "--as");
	struct ladder *ladder;
	enum status status;

	if (!as || strcmp(as, "ld") != 0)
		return report_usage(call, "--as ld must be given");
	ladder = program_new(false);
	if (!ladder)
		return report_no_memory(path);
	status = report_load(ladder, path, true);
	if (status == STATUS_GOOD)
		status = export_loaded(call, ladder, path);
	ladder_free(ladder);
	return status;
}
