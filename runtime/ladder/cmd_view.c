/* SPDX-License-Identifier: MIT
 *
 * cmd_view - `ladder show`, `diff` and `words`: what view/ prints, with the
 * exit status of the command line around it.
 */
#include "ladder/report.h"

#include "engine/scan/code.h"
#include "engine/view/view.h"

#include <stdlib.h>
#include <string.h>

/* Index of the POU named so (any case); -1: none. */
static int find_pou(const struct project *project, const char *name, size_t len)
{
	uint32_t want = names_find(&project->names, name, len);

	for (int i = 0; i < project->pou_count; i++) {
		const char *text = project_text(project, project->pou[i].name);

		if (project->pou[i].name == want && want)
			return i;
		if (strlen(text) == len && !memcmp(text, name, len))
			return i;
	}
	return -1;
}

/* 1-based number of the rung with this label or number in @pou; 0: none. */
static int find_rung(const struct project *project, const struct pou *pou,
		     const char *name)
{
	char *end;
	long number = strtol(name, &end, 10);

	if (!*end && end != name)
		return number >= 1 && number <= pou->rung_count ? (int)number :
								  0;
	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    !strcmp(project_text(project, pou->rung[i]->label), name))
			return i + 1;
	return 0;
}

static int show_named(const struct project *project, const char *name,
		      const struct view_show_options *options,
		      const struct sink *out)
{
	const char *colon = strchr(name, ':');
	size_t len = colon ? (size_t)(colon - name) : strlen(name);
	int only = find_pou(project, name, len), shown = 0;

	if (colon && only < 0)
		return 0;
	if (!colon && only >= 0)
		return view_show(project, only, 0, options, out);
	for (int i = 0; i < project->pou_count; i++) {
		int rung = 0;

		if (only < 0 || i == only)
			rung = find_rung(project, &project->pou[i],
					 colon ? colon + 1 : name);
		if (rung)
			shown += view_show(project, i, rung, options, out);
	}
	return shown;
}

static enum status show(struct call *call, const struct project *project,
			const struct view_show_options *options)
{
	int shown;

	if (call->arg_count < 2) {
		shown = view_show(project, -1, 0, options, &call->out);
		return shown < 0 ? report_no_memory(call->arg[0]) : STATUS_GOOD;
	}
	shown = show_named(project, call->arg[1], options, &call->out);
	if (shown < 0)
		return report_no_memory(call->arg[0]);
	if (shown)
		return STATUS_GOOD;
	return report_usage(call, "no rung is called %.24s", call->arg[1]);
}

static enum status no_project(const char *path)
{
	report_diag((struct diag){ .id = DIAG_NOT_RUNGBOARD, .file = path },
		    "a code image holds no rungs");
	return STATUS_NO;
}

enum status cmd_show(struct call *call)
{
	struct view_show_options options = {
		.ascii = call_flag(call, "--ascii"),
	};
	struct ladder *ladder;
	enum status status;
	int64_t width;

	if (!report_count(call, "--width", 0, 10000, &width))
		return STATUS_WRONG;
	options.width = (int)width;
	ladder = ladder_new();
	if (!ladder)
		return report_no_memory(call->arg[0]);
	status = report_load(ladder, call->arg[0], false);
	if (status == STATUS_GOOD)
		status = ladder_project(ladder) ?
			show(call, ladder_project(ladder), &options) :
			no_project(call->arg[0]);
	ladder_free(ladder);
	return status;
}

/* Where one of them is an image: do they run the same code on the same data? */
static enum status compare(struct call *call, struct ladder *a,
			   struct ladder *b)
{
	struct ladder *both[] = { a, b };
	uint8_t identity[2][32];
	bool json = call_flag(call, "--json");

	for (int i = 0; i < 2; i++) {
		if (!ladder_program(both[i]) && !ladder_build(both[i])) {
			report_diags(ladder_diags(both[i]));
			return STATUS_WRONG;
		}
		code_identity(ladder_program(both[i]), identity[i]);
	}
	bool same = !memcmp(identity[0], identity[1], sizeof(identity[0]));

	if (json)
		sink_text(&call->out, same ? "[]\n" :
			  "[{\"text\": \"the code images differ\"}]\n");
	else if (!same)
		sink_text(&call->out, "the code images differ\n");
	return same ? STATUS_GOOD : STATUS_NO;
}

static enum status diff(struct call *call, struct ladder *a, struct ladder *b)
{
	struct project *first = ladder_project(a), *second = ladder_project(b);
	bool json = call_flag(call, "--json");

	if (!first || !second)
		return compare(call, a, b);
	int count = view_diff(first, second, json, &call->out);

	if (count < 0)
		return report_no_memory(call->arg[0]);
	return count ? STATUS_NO : STATUS_GOOD;
}

enum status cmd_diff(struct call *call)
{
	struct ladder *a = ladder_new(), *b = ladder_new();
	enum status status = STATUS_WRONG, other;

	if (a && b) {
		status = report_load(a, call->arg[0], false);
		other = report_load(b, call->arg[1], false);
		if (other > status)
			status = other;
		/* An answer of 1 must mean that they differ. */
		status = status == STATUS_GOOD ? diff(call, a, b) :
						 STATUS_WRONG;
	} else {
		report_no_memory(call->arg[0]);
	}
	ladder_free(a);
	ladder_free(b);
	return status;
}

enum status cmd_words(struct call *call)
{
	const char *word = call->arg_count ? call->arg[0] : NULL;

	if (call_flag(call, "--markdown")) {
		view_words_markdown(&call->out);
		return STATUS_GOOD;
	}
	if (view_words(word, call_flag(call, "--json"), &call->out))
		return STATUS_GOOD;
	report_diag((struct diag){ .id = DIAG_UNKNOWN_WORD, .file = "ladder" },
		    "%.40s", word ? word : "");
	return STATUS_NO;
}
