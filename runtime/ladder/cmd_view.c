/* SPDX-License-Identifier: MIT
 *
 * cmd_view - `ladder show`, `ladder diff` and `ladder words`: open the files and print
 * with show.h, compare.h and words.h.
 */
#include "ladder/rungs.h"
#include "ladder/words.h"

#include "engine/compare/compare.h"
#include "engine/scan/code.h"

#include <stdlib.h>
#include <string.h>

/* Title and properties, if the file has properties. */
static void show_head(const struct sink *out, const struct project *project)
{
	bool any = false;

	for (int i = 0; i < PROPERTY_COUNT; i++)
		any = any || project->property[i];
	if (any && project->title)
		sink_printf(out, "project: %s\n", project_text(project, project->title));
	for (int i = 0; i < PROPERTY_COUNT; i++)
		if (project->property[i])
			sink_printf(out, "%s: %s\n", property_row(i)->name,
				    project_text(project, project->property[i]));
	if (any)
		sink_text(out, "\n");
}

static enum status show(struct call *call, struct ladder *ladder,
			const struct resource *resource,
			const struct show_options *options)
{
	const struct project *project = ladder_project(ladder);
	const char *name = call->arg_count < 2 ? NULL : call->arg[1];
	int shown;

	if (!name)
		show_head(&call->out, project);
	shown = rungs_show(project, name, resource, ladder, *options, &call->out);

	if (shown < 0)
		return report_no_memory(call->arg[0]);
	if (shown || !name)
		return STATUS_GOOD;
	return report_missing(call, resource ? "rung or instance" : "rung", name);
}

/* Shows the rungs after the last scan of a script, also if that was a fault or a STOP. */
static enum status show_after(struct call *call, const char *script,
			      const struct show_options *options)
{
	enum status status = STATUS_WRONG, drawn;
	struct machine machine = { 0 };
	size_t len;
	char *text = report_read(script, &len);

	if (text)
		status = machine_open(&machine, call->arg[0], MACHINE_WATCHED | MACHINE_LISTED);
	if (status == STATUS_GOOD && !ladder_project(machine.ladder))
		status = report_no_text(call->arg[0]);
	if (status == STATUS_GOOD) {
		status = machine_play(&machine, script, text, len);
		if (status == STATUS_GOOD || machine.resource.state == STATE_FAULT) {
			drawn = show(call, machine.ladder, &machine.resource, options);
			status = drawn > status ? drawn : status;
		}
	}
	machine_close(&machine);
	free(text);
	return status;
}

enum status cmd_show(struct call *call)
{
	struct show_options options = {
		.ascii = call_flag(call, "--ascii"),
	};
	const char *script = call_option(call, "--after");
	struct ladder *ladder;
	enum status status;
	int64_t width;

	if (!report_count(call, "--width", 0, 10000, &width))
		return STATUS_WRONG;
	options.width = (int)width;
	if (script)
		return show_after(call, script, &options);
	ladder = program_new(false);
	if (!ladder)
		return report_no_memory(call->arg[0]);
	status = report_load(ladder, call->arg[0], false);
	if (status == STATUS_GOOD)
		status = ladder_project(ladder) ?
			show(call, ladder, NULL, &options) :
			report_no_text(call->arg[0]);
	ladder_free(ladder);
	return status;
}

/* Compares code and data, if one of the two is an image. */
static enum status compare(struct call *call, struct ladder *a,
			   struct ladder *b)
{
	struct ladder *both[] = { a, b };
	bool json = call_flag(call, "--json");

	for (int i = 0; i < 2; i++) {
		if (!ladder_program(both[i]) && !ladder_build(both[i])) {
			report_diags(ladder_diags(both[i]));
			return STATUS_WRONG;
		}
	}
	bool same = code_is_same(ladder_program(a), ladder_program(b));

	if (json)
		sink_text(&call->out, same ? "[]\n" :
			  "[{\"text\": \"the code images differ\"}]\n");
	else if (!same)
		sink_text(&call->out, "the code images differ\n");
	return same ? STATUS_GOOD : STATUS_NO;
}

enum status diff_programs(struct call *call, struct ladder *a, struct ladder *b)
{
	struct project *first = ladder_project(a), *second = ladder_project(b);
	bool json = call_flag(call, "--json");

	if (!first || !second)
		return compare(call, a, b);
	int count = compare_projects(first, second, json, &call->out);

	if (count < 0)
		return report_no_memory(call->arg[0]);
	return count ? STATUS_NO : STATUS_GOOD;
}

enum status cmd_diff(struct call *call)
{
	struct ladder *a = program_new(false), *b = program_new(false);
	enum status status = STATUS_WRONG, other;

	if (a && b) {
		status = report_load(a, call->arg[0], false);
		other = report_load(b, call->arg[1], false);
		if (other > status)
			status = other;
		/* Status 1 means that they differ, so an error is 2. */
		status = status == STATUS_GOOD ? diff_programs(call, a, b) :
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
		words_markdown(&call->out);
		return STATUS_GOOD;
	}
	if (words_list(word, call_flag(call, "--json"), &call->out))
		return STATUS_GOOD;
	report_diag((struct diag){ .id = DIAG_UNKNOWN_WORD, .file = "ladder" },
		    "%.40s", word ? word : "");
	return STATUS_NO;
}
