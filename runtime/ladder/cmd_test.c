/* SPDX-License-Identifier: MIT
 *
 * cmd_test - `ladder test`: runs scenario files with the programs beside them and prints
 * TAP. A scenario file without a program is a failed test.
 */
#include "ladder/report.h"
#include "ladder/paths.h"

#include "engine/trial/scenario.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct tap {
	struct call *call;
	int count, failed;
};

/* Does no other scenario run? */
static bool is_over(const struct tap *tap)
{
	return tap->call->out_failed || (tap->failed && call_flag(tap->call, "--fail-fast"));
}

/* Prints a result line. In TAP 13 a backslash escapes `#`, which begins a directive. */
static void print_result(struct tap *tap, bool good, const char *path,
			 const char *name)
{
	const struct sink *out = &tap->call->out;

	tap->count++;
	tap->failed += !good;
	sink_printf(out, "%sok %d - ", good ? "" : "not ", tap->count);
	for (int part = 0; part < 2; part++) {
		const char *text = part ? name : path;

		if (part)
			sink_text(out, ": ");
		for (; *text; text++) {
			if (*text == '#' || *text == '\\')
				sink_text(out, "\\");
			sink_write(out, text, 1);
		}
	}
	sink_text(out, "\n");
}

/* Prints the result line first, then the comments of the scenario. */
static void run_one(struct tap *tap, struct machine *machine,
		    const struct scenario_file *file, int index)
{
	struct sink_memory comments;

	sink_memory_init(&comments);
	struct sink sink = sink_to_memory(&comments);
	bool good = scenario_run(file, index, &machine->resource,
				 machine_plant(machine), &sink);

	print_result(tap, good, file->file, file->scenario[index].name);
	sink_text(&tap->call->out, sink_memory_text(&comments));
	sink_memory_free(&comments);
}

/* Opens the plant that the scenario file names, if any; its path begins at the folder of
 * the file. */
static bool find_plant(struct machine *machine, const char *path, const char *text,
		       size_t len, struct arena *arena)
{
	struct diag place;
	const char *name = scenario_find_plant(path, text, len, arena, &place);
	char *beside, *plant;

	if (!name)
		return true;
	beside = path_beside(path, name);
	plant = beside ? arena_copy(arena, beside, strlen(beside)) : NULL;
	free(beside);
	return plant && machine_add_plant(machine, plant, place) == STATUS_GOOD;
}

static bool run_text(struct tap *tap, struct machine *machine, const char *path,
		     const char *text, size_t len)
{
	struct diag_list *diags = report_list(path);
	struct scenario_file file;
	struct arena arena;
	bool good;

	if (!diags)
		return false;
	arena_init(&arena);
	good = find_plant(machine, path, text, len, &arena) &&
	       scenario_read(path, text, len, &machine->resource.image,
			     machine_plant(machine) ?
			     &machine->plant.resource.image : NULL,
			     (struct formula_projects){ ladder_project(machine->ladder),
				machine->plant_ladder ? ladder_project(machine->plant_ladder) : NULL },
			     &arena, &file, diags);
	report_diags(diags);
	for (int i = 0; good && i < file.count && !is_over(tap); i++)
		run_one(tap, machine, &file, i);
	arena_free(&arena);
	free(diags);
	return good;
}

/* NAME.rung, or if there is none a folder or file of plain IEC text or a project of ClassicLadder of that
 * name; NULL: no memory. */
static char *program_of(const char *path)
{
	static const char *const ending[] = { "", ".st", ".iec", ".il", ".exp", ".EXP", ".TcPOU",
					      ".clprj", ".clp", ".clprjz" };
	char *program = path_with_ending(path, ".rung");
	struct stat about;

	for (size_t i = 0; program && i < sizeof(ending) / sizeof(*ending); i++) {
		char *other = stat(program, &about) ? path_with_ending(path, ending[i]) : NULL;

		if (other && stat(other, &about) == 0 && (*ending[i] || S_ISDIR(about.st_mode))) {
			free(program);
			return other;
		}
		free(other);
	}
	return program;
}

/* One scenario file with its program. */
static void run_file(struct tap *tap, const char *path)
{
	char *program = program_of(path);
	struct machine machine = { 0 };
	char *text = NULL;
	size_t len;

	if (!program ||
	    machine_open(&machine, program, MACHINE_AS_FILE) != STATUS_GOOD) {
		print_result(tap, false, path, "its program is good");
	} else {
		machine_skip(&machine, tap->call);
		text = report_read(path, &len);
		if (!text || !run_text(tap, &machine, path, text, len))
			print_result(tap, false, path, "can be read");
	}
	free(text);
	machine_close(&machine);
	free(program);
}

/* The scenario files of an argument: itself, those in a folder, and NAME.scn beside the folder NAME of a
 * project or beside its one file. */
static bool collect(struct paths *paths, const char *arg)
{
	static const char *const programs[] = { ".rung", ".st", ".iec", ".il", ".exp", ".EXP",
						".TcPOU", ".clprj", ".clp", ".clprjz", NULL };
	char *beside = path_is_folder(arg) ? path_with_ending(arg, ".scn") : NULL;
	struct stat about;
	const bool there = beside && stat(beside, &about) == 0;
	const bool good = (!there || paths_collect(paths, beside, ".scn", programs)) &&
			  paths_collect(paths, arg, ".scn", programs);

	free(beside);
	return good;
}

enum status cmd_test(struct call *call)
{
	struct tap tap = { .call = call };
	struct paths paths = { 0 };
	enum status status = STATUS_GOOD;

	for (int i = 0; i < call->arg_count; i++)
		if (!collect(&paths, call->arg[i]))
			status = STATUS_WRONG;
	if (status == STATUS_GOOD && !paths.count)
		status = report_usage(call, "there are no scenario files");
	for (int i = 0; status == STATUS_GOOD && i < paths.count && !is_over(&tap); i++)
		run_file(&tap, paths.path[i]);
	if (status == STATUS_GOOD) {
		sink_printf(&call->out, "1..%d\n", tap.count);
		status = tap.failed ? STATUS_NO : STATUS_GOOD;
	}
	paths_free(&paths);
	return status;
}
