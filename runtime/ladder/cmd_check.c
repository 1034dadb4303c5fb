/* SPDX-License-Identifier: MIT
 *
 * cmd_check - `ladder check`: prints every error and warning of programs. It writes no
 * file.
 */
#include "ladder/load_text.h"

#include "hal/iomap.h"

#include <stdlib.h>

#define PATHS_SHOWN 4 /* more are counted */

static int warnings_of(const struct diag_list *diags)
{
	return diags->count + diags->dropped - diags->errors;
}

/* @paths: with a newline between two of them. */
static void print_paths(const char *paths, const struct sink *out)
{
	int count = 1;

	for (const char *at = paths; *at; at++)
		count += *at == '\n';
	if (count > PATHS_SHOWN) {
		sink_printf(out, "%d files", count);
		return;
	}
	for (; *paths; paths++)
		sink_write(out, *paths == '\n' ? ", " : paths, *paths == '\n' ? 2 : 1);
}

static void print_sum(const char *paths, const struct diag_list *diags,
		      const struct sink *out)
{
	int errors = diags->errors, warnings = warnings_of(diags);

	print_paths(paths, out);
	if (errors)
		sink_printf(out, ": %d error%s", errors, errors > 1 ? "s" : "");
	else
		sink_text(out, ": good");
	if (warnings)
		sink_printf(out, ", %d warning%s", warnings,
			    warnings > 1 ? "s" : "");
	sink_text(out, "\n");
}

/* The closing brace follows. */
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
}

/* Adds errors of the map, and inputs and outputs that it lacks. */
static enum status check_map(struct ladder *ladder, const char *path, struct arena *arena)
{
	struct diag_list *diags = ladder_diags(ladder);
	struct iomap map;
	size_t len;
	char *text = report_read(path, &len);
	bool good;

	if (!text)
		return STATUS_WRONG;
	good = iomap_read(&map, arena, path, text, len, diags) &&
	       iomap_check_program(&map, ladder_program(ladder), arena, diags);
	free(text);
	return good ? STATUS_GOOD : STATUS_NO;
}

struct wish {
	bool json, tasks;
	int64_t speed; /* 0: not given */
};

/* Prints everything about a file; @ladder is built if @status is good. */
static enum status print_all(struct call *call, struct ladder *ladder, const char *path,
			     const struct wish *wish, bool first, enum status status)
{
	enum status load = STATUS_GOOD;

	if (wish->json) {
		print_json(path, ladder_diags(ladder), status == STATUS_GOOD,
			   first, &call->out);
	} else {
		report_diags(ladder_diags(ladder));
		if (status != STATUS_WRONG)
			print_sum(path, ladder_diags(ladder), &call->out);
	}
	if (wish->tasks && status == STATUS_GOOD)
		load = load_print(ladder, path, wish->speed, wish->json, &call->out);
	if (wish->json)
		sink_text(&call->out, "}");
	return load > status ? load : status;
}

static enum status check_one(struct call *call, const char *path, const struct wish *wish,
			     bool first)
{
	const char *map = call_option(call, "--io");
	struct ladder *ladder = program_new(false);
	enum status status = STATUS_GOOD;
	struct arena arena;

	if (!ladder)
		return report_no_memory(path);
	arena_init(&arena);
	if (!report_read_program(ladder, path) || !ladder_build(ladder))
		status = ladder_could_read(ladder) ? STATUS_NO : STATUS_WRONG;
	else if (map)
		status = check_map(ladder, map, &arena);
	status = print_all(call, ladder, path, wish, first, status);
	ladder_free(ladder);
	arena_free(&arena);
	return status;
}

enum status cmd_check(struct call *call)
{
	struct wish wish = { .json = call_flag(call, "--json") };
	enum status worst = STATUS_GOOD;

	if (!report_count(call, "--speed", 0, 100000000, &wish.speed))
		return STATUS_WRONG;
	wish.tasks = call_flag(call, "--tasks") || wish.speed;
	if (wish.json)
		sink_text(&call->out, "[");
	for (int i = 0; i < call->arg_count && !call->out_failed; i++) {
		enum status status = check_one(call, call->arg[i], &wish, !i);

		if (status > worst)
			worst = status;
	}
	if (wish.json)
		sink_text(&call->out, "\n]\n");
	return worst;
}
