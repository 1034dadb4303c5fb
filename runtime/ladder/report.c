/* SPDX-License-Identifier: MIT
 *
 * report - prints to standard output and standard error, and opens machines.
 */
#include "ladder/report.h"

#include "ladder/paths.h"

#include "engine/base/file.h"
#include "engine/scan/still.h"
#include "engine/trial/script.h"
#include "engine/trial/value.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void complain_output(struct call *call)
{
	if (!call->out_failed)
		report_diag((struct diag){ .id = DIAG_CANNOT_PRINT,
					   .file = "standard output" },
			    "%s", strerror(errno));
	call->out_failed = true;
}

static void write_out(void *context, const char *text, size_t len)
{
	struct call *call = context;

	if (!call->out_failed && fwrite(text, 1, len, stdout) != len)
		complain_output(call);
}

void report_open(struct call *call)
{
	call->out = (struct sink){ .write = write_out, .context = call };
	call->out_failed = false;
}

bool report_flush(struct call *call)
{
	if (!call->out_failed && fflush(stdout) != 0)
		complain_output(call);
	return !call->out_failed;
}

static void print_diag(const struct diag *diag)
{
	char line[2048];

	diag_print(diag, line, sizeof(line));
	fprintf(stderr, "%s\n", line);
}

static void print_with(struct diag place, const char *format, va_list list)
{
	char arg[LIMIT_ARG * 4];
	struct diag_list *diags = calloc(1, sizeof(*diags));

	vsnprintf(arg, sizeof(arg), format, list);
	if (!diags)
		return;
	diag_init(diags);
	diag_add(diags, place, "%s", arg);
	report_end(diags);
}

void report_diag(struct diag place, const char *format, ...)
{
	va_list list;

	va_start(list, format);
	print_with(place, format, list);
	va_end(list);
}

enum status report_usage(const struct call *call, const char *format, ...)
{
	struct diag place = { .id = DIAG_USAGE, .file = "ladder" };
	char name[40];
	va_list list;

	if (call && call->row) {
		snprintf(name, sizeof(name), "ladder %s", call->row->name);
		place.file = name;
	}
	va_start(list, format);
	print_with(place, format, list);
	va_end(list);
	return STATUS_WRONG;
}

enum status report_missing(const struct call *call, const char *kind, const char *name)
{
	report_diag((struct diag){ .id = DIAG_NOT_IN_PROGRAM, .file = call->arg[0] },
		    "%s \"%.60s\"", kind, name);
	return STATUS_WRONG;
}

void report_diags(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++)
		print_diag(&diags->diag[i]);
	if (diags->dropped)
		report_diag((struct diag){ .id = DIAG_MORE,
					   .file = diags->diag[0].file },
			    "%d", diags->dropped);
}

struct diag_list *report_list(const char *path)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));

	if (diags)
		diag_init(diags);
	else
		report_no_memory(path);
	return diags;
}

bool report_end(struct diag_list *diags)
{
	const bool good = !diags->errors;

	report_diags(diags);
	free(diags);
	return good;
}

static void swallow(void *context, const char *text, size_t len)
{
	(void)context, (void)text, (void)len;
}

struct sink report_nowhere(void)
{
	return (struct sink){ .write = swallow };
}

void report_json_field(const char *name, const char *text, const struct sink *out)
{
	sink_printf(out, ", \"%s\": ", name);
	sink_json_text(out, text);
}

static void json_number(const char *name, int value, const struct sink *out)
{
	if (value)
		sink_printf(out, ", \"%s\": %d", name, value);
}

/* "text" is the whole sentence, "arg" only the name in it. */
static void json_texts(const struct diag *diag, const struct sink *out)
{
	char text[1024], name[LIMIT_ARG];

	diag_fill(diag_text(diag->id), diag->arg, text, sizeof(text));
	report_json_field("text", text, out);
	snprintf(name, sizeof(name), "%.*s", diag_name_length(diag), diag->arg);
	if (*name)
		report_json_field("arg", name, out);
}

static void json_diag(const struct diag *diag, const struct sink *out)
{
	bool error = diag_severity(diag->id) == SEVERITY_ERROR;

	sink_printf(out, "{\"code\": \"%s\", \"severity\": \"%s\"", diag_code(diag->id),
		    error ? "error" : "warning");
	json_texts(diag, out);
	if (diag->file)
		report_json_field("file", diag->file, out);
	json_number("line", diag->line, out);
	if (diag->pou)
		report_json_field("pou", diag->pou, out);
	json_number("rung", diag->rung, out);
	json_number("row", diag->row, out);
	json_number("col", diag->col, out);
	json_number("column", diag->column, out);
	sink_text(out, "}");
}

void report_json_diags(const struct diag_list *diags, const struct sink *out)
{
	sink_text(out, "[");
	for (int i = 0; i < diags->count; i++) {
		sink_text(out, i ? ",\n  " : "\n  ");
		json_diag(&diags->diag[i], out);
	}
	sink_text(out, diags->count ? "\n]" : "]");
}

enum status report_no_memory(const char *path)
{
	report_diag((struct diag){ .id = DIAG_NO_MEMORY, .file = path }, "%s",
		    "");
	return STATUS_WRONG;
}

enum status report_no_text(const char *path)
{
	report_diag((struct diag){ .id = DIAG_IMAGE_NO_TEXT, .file = path },
		    "%s", "");
	return STATUS_NO;
}

/* Files of plain IEC text and a folder of them are one project. */
static bool load_project(struct ladder *ladder, const char *path)
{
	struct paths paths = { 0 };
	bool good = paths_project(&paths, path);

	good = good && ladder_load_files(ladder, paths.count ? (const char *const *)paths.path : &path,
					 paths.count);

	paths_free(&paths);
	return good;
}

bool report_read_program(struct ladder *ladder, const char *path)
{
	/* Several files stand one a line; but a name may have a newline, too. */
	const bool many = (strchr(path, '\n') && access(path, F_OK) != 0) ||
			  (path_is_folder(path) && !ladder_import_format(path));

	return many ? load_project(ladder, path) : ladder_load(ladder, path);
}

enum status report_load(struct ladder *ladder, const char *path, bool build)
{
	bool good = report_read_program(ladder, path);

	if (good && build)
		good = ladder_build(ladder);
	report_diags(ladder_diags(ladder));
	if (good)
		return STATUS_GOOD;
	return ladder_could_read(ladder) ? STATUS_NO : STATUS_WRONG;
}

bool report_classic(const char *path)
{
	if (!ladder_import_format(path))
		return false;
	report_diag((struct diag){ .id = DIAG_IMPORT_FIRST, .file = path }, "%s", "");
	return true;
}

struct ladder *program_new(bool faithful)
{
	struct ladder *ladder = ladder_new();

	if (ladder && (!ladder_take_classic(ladder, faithful) || !ladder_take_others(ladder))) {
		ladder_free(ladder);
		return NULL;
	}
	return ladder;
}

int64_t program_period(const struct ladder *ladder, int64_t given)
{
	if (!given)
		given = ladder_period(ladder);
	return given ? given : tasks_tick(ladder_program(ladder), 0, 10 * VALUE_MS);
}

enum status machine_open(struct machine *machine, const char *path, int how)
{
	enum status status;

	memset(machine, 0, sizeof(*machine));
	arena_init(&machine->skip);
	machine->ladder = program_new(how & MACHINE_FAITHFUL);
	if (!machine->ladder)
		return report_no_memory(path);
	ladder_classic_task(machine->ladder, how & MACHINE_AS_FILE);
	ladder_watch(machine->ladder, how & MACHINE_WATCHED);
	ladder_watch_lists(machine->ladder, how & MACHINE_LISTED);
	status = report_load(machine->ladder, path, true);
	if (status != STATUS_GOOD)
		return status;
	const struct program *program = ladder_program(machine->ladder);

	machine->memory = calloc(1, image_memory_size(program) + 8);
	if (!machine->memory)
		return report_no_memory(path);
	resource_init(&machine->resource, program, machine->memory);
	return STATUS_GOOD;
}

void machine_skip(struct machine *machine, const struct call *call)
{
	if (HAS_STILL && !call_flag(call, "--full-scan"))
		machine->resource.still = still_new(ladder_program(machine->ladder), STILL_LEAST,
						    &machine->skip, NULL);
}

enum status machine_add_plant(struct machine *machine, const char *path,
			      struct diag place)
{
	enum status status;

	machine->plant_ladder = program_new(false);
	if (!machine->plant_ladder)
		return report_no_memory(path);
	status = report_load(machine->plant_ladder, path, true);
	if (status == STATUS_GOOD &&
	    !plant_init(&machine->plant, ladder_program(machine->plant_ladder),
			ladder_program(machine->ladder)))
		return report_no_memory(path);
	if (status == STATUS_GOOD)
		return status;
	place.id = DIAG_NO_PLANT;
	report_diag(place, "%.60s", path);
	return status;
}

enum status machine_open_call(struct machine *machine, const struct call *call, int how)
{
	const char *plant = call_option(call, "--plant");
	enum status status = machine_open(machine, call->arg[0], how);

	if (status == STATUS_GOOD && plant)
		status = machine_add_plant(machine, plant, (struct diag){ .file = "--plant" });
	return status;
}

struct plant *machine_plant(struct machine *machine)
{
	return machine->plant.memory ? &machine->plant : NULL;
}

enum status machine_play(struct machine *machine, const char *script, const char *text,
			 size_t len)
{
	const struct sink nowhere = report_nowhere();
	struct diag_list *diags = report_list(script);
	struct trace trace;
	bool good;

	if (!diags)
		return STATUS_WRONG;
	machine->resource.watch = true;
	trace_init(&trace, &machine->resource.image, &nowhere, TRACE_LINES, false);
	good = script_run(script, text, len, program_period(machine->ladder, 0),
			  &machine->resource, machine_plant(machine), &trace, diags);
	trace_free(&trace);
	report_end(diags);
	return good ? STATUS_GOOD : STATUS_NO;
}

void machine_close(struct machine *machine)
{
	plant_free(&machine->plant);
	ladder_free(machine->plant_ladder);
	machine->plant_ladder = NULL;
	free(machine->memory);
	arena_free(&machine->skip);
	ladder_free(machine->ladder);
	machine->memory = NULL;
	machine->ladder = NULL;
}

bool report_period(const struct call *call, const char *option,
		   int64_t preset_ns, int64_t *ns)
{
	const char *text = call_option(call, option);

	*ns = preset_ns;
	if (!text)
		return true;
	if (value_parse_time(text, strlen(text), VALUE_MS, ns) == LITERAL_OK &&
	    *ns > 0)
		return true;
	report_usage(call, "%s needs a time such as 10ms, not %.12s", option,
		     text);
	return false;
}

bool report_count(const struct call *call, const char *option, int64_t preset,
		  int64_t most, int64_t *count)
{
	const char *text = call_option(call, option);
	char *end;

	*count = preset;
	if (!text)
		return true;
	errno = 0;
	long long number = strtoll(text, &end, 10);

	*count = number;
	if (*text >= '0' && *text <= '9' && !*end && !errno && number >= 1 &&
	    number <= most)
		return true;
	report_usage(call, "%s needs a number from 1 on, not %.12s", option,
		     text);
	return false;
}

static char *read_stdin(size_t *len)
{
	size_t size = 65536, used = 0;
	char *text = malloc(size), *grown;

	while (text) {
		used += fread(text + used, 1, size - used, stdin);
		if (used < size || size >= LIMIT_TEXT)
			break;
		grown = realloc(text, size *= 2);
		if (!grown)
			free(text);
		text = grown;
	}
	if (text && (ferror(stdin) || used == size)) {
		free(text);
		text = NULL;
	}
	if (!text)
		report_diag((struct diag){ .id = DIAG_CANNOT_READ,
					   .file = "-" }, "%s", "");
	*len = used;
	return text;
}

char *report_read(const char *path, size_t *len)
{
	struct diag_list *diags;
	char *text;

	if (!strcmp(path, "-"))
		return read_stdin(len);
	diags = report_list(path);
	if (!diags)
		return NULL;
	text = file_read(path, LIMIT_TEXT, len, diags);
	report_end(diags);
	return text;
}

enum status report_save(const char *path, const void *bytes, size_t len)
{
	struct diag_list *diags = report_list(path);

	if (!diags)
		return STATUS_WRONG;
	file_save(path, bytes, len, diags);
	return report_end(diags) ? STATUS_GOOD : STATUS_WRONG;
}
