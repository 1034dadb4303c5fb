/* SPDX-License-Identifier: MIT
 *
 * cmd_replay - `ladder replay`: computes the scans of a record again and prints their values.
 */
#include "ladder/report.h"

#include "engine/trial/record_file.h"
#include "engine/trial/trace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct show {
	struct call *call;
	struct playback playback;
	struct trace trace;
	uint32_t changes;      /* of the playback, that the columns are for   */
	bool all;
};

static const char *quality_of(void *context, struct location at)
{
	static const char *const word[2][3] = {
		{ [RECORD_STALE] = "stale", [RECORD_BROKEN] = "fault" },
		{ "forced", [RECORD_STALE] = "forced!stale", [RECORD_BROKEN] = "forced!fault" },
	};
	const struct playback *playback = context;
	const struct image *image = &playback->twin.resource.image;

	return word[image_is_forced(image, at)][record_quality_of(playback->bad, playback->bad_len, image->program, at)];
}

static bool show_columns(struct show *show)
{
	const struct call *call = show->call;
	struct diag_list *diags = report_list(call->arg[0]);
	bool good = diags;

	if (show->all)
		good = good && trace_show_all(&show->trace);
	for (int i = 1; i < call->arg_count && good; i++)
		good = trace_show(&show->trace, call->arg[i], strlen(call->arg[i]), diags,
				  (struct diag){ .file = call->arg[0] });
	if (diags)
		good = report_end(diags) && good;
	return good;
}

/* The twin has another program than in the scan before. */
static bool change_program(struct show *show)
{
	static const char text[] = "another program";

	show->changes = show->playback.changes;
	trace_note(&show->trace, text, sizeof(text) - 1);
	if (!show->all || show->trace.form != TRACE_LINES)
		return trace_again(&show->trace);
	trace_clear(&show->trace);
	show->trace.begun = false; /* its first values are changes */
	return show_columns(show);
}

static enum status run(struct show *show, int64_t from_ns)
{
	struct playback *playback = &show->playback;
	bool good = true;

	while (good && !trace_stopped(&show->trace) && playback_next(playback)) {
		if (playback->changes != show->changes)
			good = change_program(show);
		if (good && playback->twin.now_ns >= from_ns)
			trace_scan(&show->trace, playback->twin.scan, playback->twin.now_ns);
	}
	trace_end(&show->trace);
	if (!good)
		return STATUS_NO;
	if (playback->differs) {
		report_diag((struct diag){ .id = DIAG_RECORD_DIFFERS, .file = show->call->arg[0] },
			    "%llu", (unsigned long long)playback->differs);
		return STATUS_NO;
	}
	if (playback->twin.scan < record_file_last(playback->file) && !show->call->out_failed)
		return report_no_memory(show->call->arg[0]);
	return STATUS_GOOD;
}

/* Time of the first scan to be shown. */
static bool find_start(struct show *show, int64_t *from_ns)
{
	int64_t last_ns;
	struct playback end;
	bool good;

	*from_ns = 0;
	if (!report_period(show->call, "--last", INT64_MAX, &last_ns))
		return false;
	if (last_ns == INT64_MAX)
		return true;
	good = playback_init(&end, show->playback.file) &&
	       playback_seek(&end, record_file_last(show->playback.file));
	*from_ns = end.twin.now_ns - last_ns;
	playback_free(&end);
	return good;
}

static enum status show(struct call *call, const struct record_file *file, enum trace_form form)
{
	struct show *show = calloc(1, sizeof(*show));
	enum status status = STATUS_WRONG;
	int64_t from_ns;

	if (!show)
		return report_no_memory(call->arg[0]);
	show->call = call;
	show->all = call->arg_count == 1;
	if (!playback_init(&show->playback, file)) {
		status = report_no_memory(call->arg[0]);
	} else if (find_start(show, &from_ns)) {
		show->playback.exact = true;
		show->changes = show->playback.changes;
		trace_init(&show->trace, &show->playback.twin.resource.image, &call->out, form,
			   call_flag(call, "--changes"));
		show->trace.stop = &call->out_failed;
		show->trace.quality = quality_of;
		show->trace.quality_context = &show->playback;
		status = show_columns(show) ? run(show, from_ns) : STATUS_NO;
		trace_free(&show->trace);
	}
	playback_free(&show->playback);
	free(show);
	return status;
}

enum status cmd_replay(struct call *call)
{
	const bool csv = call_flag(call, "--csv"), vcd = call_flag(call, "--vcd");
	struct record_file *file;
	enum status status;
	enum diag_id why;
	size_t len, where;
	char *bytes;

	if (csv && vcd)
		return report_usage(call, "--csv and --vcd cannot be used together");
	bytes = report_read(call->arg[0], &len);
	if (!bytes)
		return STATUS_WRONG;
	file = record_file_open(bytes, len, &why, &where);
	free(bytes);
	if (!file) {
		report_diag((struct diag){ .id = why, .file = call->arg[0] }, "byte %zu", where);
		return STATUS_NO;
	}
	status = show(call, file, csv ? TRACE_CSV : vcd ? TRACE_VCD : TRACE_LINES);
	record_file_free(file);
	return status;
}
