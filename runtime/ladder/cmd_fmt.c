/* SPDX-License-Identifier: MIT
 *
 * cmd_fmt - `ladder fmt`: writes rung files in canonical form. It does not write a file
 * that has an error or is canonical already.
 */
#include "ladder/report.h"

#include <stdlib.h>
#include <string.h>

static enum status compare(struct call *call, const char *path,
			   const char *text, size_t len)
{
	size_t old_len;
	char *old = report_read(path, &old_len);

	if (!old)
		return STATUS_WRONG;
	bool same = old_len == len && !memcmp(old, text, len);

	free(old);
	if (same)
		return STATUS_GOOD;
	if (!call_flag(call, "--check"))
		return report_save(path, text, len);
	sink_text(&call->out, path);
	sink_text(&call->out, "\n");
	return STATUS_NO;
}

/* One file of the project. */
static enum status format_source(struct call *call, struct ladder *ladder, int number)
{
	const struct source_file *source = &ladder_project(ladder)->source[number];
	enum status status;
	size_t len;
	char *text;

	if (source->foreign) {
		report_diag((struct diag){ .id = DIAG_NOT_FORMATTED, .file = source->name }, "%s", "");
		return STATUS_NO;
	}
	text = ladder_write_source(ladder, number, &len);
	if (!text)
		return report_no_memory(source->name);
	status = compare(call, source->name, text, len);
	free(text);
	return status;
}

static enum status format_loaded(struct call *call, struct ladder *ladder,
				 const char *path)
{
	const struct project *project = ladder_project(ladder);
	enum status worst = STATUS_GOOD;

	if (!project) {
		report_diag((struct diag){ .id = DIAG_IMAGE_NO_TEXT, .file = path }, "%s", "");
		return STATUS_NO;
	}
	for (int i = 0; i < project->source_count; i++) {
		enum status status = format_source(call, ladder, i);

		worst = status > worst ? status : worst;
	}
	return worst;
}

static enum status format_one(struct call *call, const char *path)
{
	struct ladder *ladder;
	enum status status;

	if (report_classic(path))
		return STATUS_NO;
	ladder = ladder_new();
	if (!ladder)
		return report_no_memory(path);
	status = report_load(ladder, path, false);
	if (status == STATUS_GOOD)
		status = format_loaded(call, ladder, path);
	ladder_free(ladder);
	return status;
}

enum status cmd_fmt(struct call *call)
{
	enum status worst = STATUS_GOOD;

	for (int i = 0; i < call->arg_count && !call->out_failed; i++) {
		enum status status = format_one(call, call->arg[i]);

		if (status > worst)
			worst = status;
	}
	return worst;
}
