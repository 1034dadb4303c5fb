/* SPDX-License-Identifier: MIT
 *
 * cmd_import - `ladder import`: makes a rung file, an I/O map and a report from a project
 * of another tool.
 */
#include "ladder/paths.h"
#include "ladder/report.h"

#include "engine/exchange/report.h"

#include <stdlib.h>
#include <string.h>

static const char *const kind_text[REPORT_KINDS] = {
	[REPORT_TAKEN] = "taken", [REPORT_CHANGED] = "changed", [REPORT_LOST] = "lost",
};

static void print_line(const char *path, const struct report_line *line,
		       const struct sink *out)
{
	sink_text(out, path);
	if (line->line)
		sink_printf(out, ":%d", line->line);
	sink_printf(out, ": %s: ", kind_text[line->kind]);
	if (line->member && line->member[0]) {
		sink_text(out, line->member);
		sink_text(out, ": ");
	}
	if (line->pou) {
		sink_text(out, line->pou);
		sink_printf(out, line->rung ? " rung %d: " : ": ", line->rung);
	}
	sink_text(out, line->text);
	sink_text(out, "\n");
}

static void print_text(const char *path, const struct classic_report *report,
		       const struct sink *out)
{
	int count[REPORT_KINDS] = { 0 };

	for (int i = 0; i < report->count; i++) {
		print_line(path, &report->line[i], out);
		count[report->line[i].kind]++;
	}
	sink_text(out, path);
	sink_printf(out, ": %d changed, %d lost\n", count[REPORT_CHANGED], count[REPORT_LOST]);
}

static void print_json_line(const struct report_line *line, const struct sink *out)
{
	sink_printf(out, "  {\"kind\": \"%s\"", kind_text[line->kind]);
	report_json_field("member", line->member, out);
	sink_printf(out, ", \"line\": %d", line->line);
	report_json_field("pou", line->pou, out);
	sink_printf(out, ", \"rung\": %d", line->rung);
	report_json_field("text", line->text, out);
	sink_text(out, "}");
}

static void print_json(const char *path, const struct classic_report *report,
		       const struct sink *out)
{
	sink_text(out, "{\"file\": ");
	sink_json_text(out, path);
	sink_text(out, ", \"report\": [\n");
	for (int i = 0; i < report->count; i++) {
		print_json_line(&report->line[i], out);
		sink_text(out, i + 1 < report->count ? ",\n" : "\n");
	}
	sink_text(out, "]}\n");
}

/* OUT.rung: OUT.io */
static bool save_io(const char *out, const char *map)
{
	char *path = path_with_ending(out, ".io");
	bool good;

	if (!path)
		return report_no_memory(out) == STATUS_GOOD;
	good = report_save(path, map, strlen(map)) == STATUS_GOOD;
	free(path);
	return good;
}

/* A project with errors is written as the import made it, so that they can be corrected. */
static enum status write_files(struct ladder *ladder, const char *out)
{
	const char *map = ladder_import_io(ladder), *raw;
	size_t len;
	char *text = ladder_project(ladder) ? ladder_write(ladder, &len) : NULL;
	bool good;

	raw = text ? text : ladder_import_text(ladder, &len);
	if (!raw)
		return report_no_memory(out);
	good = report_save(out, raw, len) == STATUS_GOOD && (!map || save_io(out, map));
	free(text);
	return good ? STATUS_GOOD : STATUS_WRONG;
}

static enum status import(struct call *call, struct ladder *ladder)
{
	const char *path = call->arg[0], *out = call_option(call, "-o");
	enum status status = report_load(ladder, path, true), written;
	const struct classic_report *report = ladder_import_report(ladder);

	if (!report) {
		if (status == STATUS_GOOD)
			report_diag((struct diag){ .id = DIAG_NOT_CLASSIC, .file = path }, "%s", "");
		return status == STATUS_GOOD ? STATUS_WRONG : status;
	}
	if (status != STATUS_GOOD && ladder_import_project(ladder))
		return status;
	written = out ? write_files(ladder, out) : STATUS_GOOD;
	if (written != STATUS_GOOD)
		return written;
	if (call_flag(call, "--json"))
		print_json(path, report, &call->out);
	else
		print_text(path, report, &call->out);
	return status;
}

enum status cmd_import(struct call *call)
{
	struct ladder *ladder = program_new(call_flag(call, "--faithful"));
	enum status status;

	if (!ladder)
		return report_no_memory(call->arg[0]);
	ladder_classic_task(ladder, true);
	status = import(call, ladder);
	ladder_free(ladder);
	return status;
}
