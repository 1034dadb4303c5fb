/* SPDX-License-Identifier: MIT
 *
 * cmd_code - `ladder code` and `ladder build`: print the verified code image, or write it
 * to a file.
 */
#include "ladder/report.h"

#include "engine/base/file.h"
#include "engine/base/digest.h"
#include "engine/scan/image.h"
#include "engine/scan/still.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char *const section_name[CODE_SECTION_COUNT] = {
	[CODE_PROGRAMS] = "programs", [CODE_TASKS] = "tasks",
	[CODE_CALLS] = "calls", [CODE_LAYOUT] = "layout",
	[CODE_INIT] = "initial values", [CODE_BITS] = "bits",
	[CODE_TEXT] = "instructions", [CODE_WATCH] = "instructions, watched",
	[CODE_SYMBOLS] = "symbols", [CODE_POWER] = "power of cells",
	[CODE_GROUPS] = "groups of symbols",
	[CODE_PLACES] = "places", [CODE_STRINGS] = "strings",
	[CODE_WATCHED] = "watched instances",
};

/* Empty areas are left out. */
static void print_areas(const struct areas *areas, const struct sink *out)
{
	sink_printf(out, "areas         %u bytes:", (unsigned)areas->size);
	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++)
		if (areas->bytes[i])
			sink_printf(out, " %s %u",
				    iec_area_row((enum iec_area)i)->letters,
				    (unsigned)areas->bytes[i]);
	sink_text(out, "\n");
}

static void print_sizes(const struct program *program, const struct sink *out)
{
	const struct code_header *header = program->header;
	uint8_t identity[32];
	char sha[65];

	code_identity(program, identity);
	digest_hex(identity, sizeof(identity), sha);
	sink_printf(out, "identity      %s\n", sha);
	sink_printf(out, "image         %u bytes, version %u\n", header->size,
		    header->version);
	for (int i = 1; i < CODE_SECTION_COUNT; i++)
		sink_printf(out, "  %7u %s\n", header->section[i].size,
			    section_name[i]);
	sink_printf(out, "data          %u bytes, of them %u retained\n",
		    header->data_size, header->retain_size);
	print_areas(&program->areas, out);
	sink_printf(out, "budget        %u instructions a scan\n",
		    header->budget);
}

static bool is_jump(uint32_t word)
{
	return (word & 0xff) == VM_JMP || (word & 0xff) == VM_JMPC;
}

/* Prints one program. Returns the number of its instructions; each part of a LUT counts. */
static uint32_t print_program(const struct program *program,
			      const struct code_program *entry,
			      const struct call *call, bool *loops)
{
	const uint32_t *text = program->text;
	uint32_t at = entry->text, end = at + entry->text_words, count = 0;
	char line[512];

	sink_printf(&call->out, "\nprogram ");
	sink_text(&call->out, program->string_bytes ?
			      program->string + entry->name : "?");
	sink_text(&call->out, "\n");
	while (at < end && !call->out_failed) {
		uint32_t word = text[at], n = word >> 8;
		uint32_t parts = (word & 0xff) == VM_LUT ? n : 1;

		for (uint32_t i = 0; i < parts; i++) {
			code_print(text + at, i, line, sizeof(line));
			if (i)
				sink_text(&call->out, "          ");
			else
				sink_printf(&call->out, "%8u  ", at);
			sink_text(&call->out, line);
			sink_text(&call->out, "\n");
		}
		if (is_jump(word) && text[at + 1] <= at)
			*loops = true;
		count += parts;
		at += code_words(text + at);
	}
	return count;
}

/* Adds the instructions of called programs. @own: instructions of each program without its
 * calls; @all: with them, as far as computed. Returns whether @all has grown. */
static bool add_calls(const struct program *program, uint32_t entry,
		      const uint32_t *own, uint64_t *all)
{
	const struct code_program *e = &program->entry[entry];
	const uint32_t *text = program->text;
	uint32_t end = e->text + e->text_words;
	uint64_t sum = own[entry];

	for (uint32_t at = e->text; at < end; at += code_words(text + at))
		if ((text[at] & 0xff) == VM_CALL)
			sum += all[text[at + 1]];
	sum = sum < UINT32_MAX ? sum : UINT32_MAX; /* more than any budget */
	if (sum == all[entry])
		return false;
	all[entry] = sum;
	return true;
}

/* The verifier refuses recursive calls, so this ends after as many rounds as calls nest. */
static uint64_t count_worst(const struct program *program, const uint32_t *own)
{
	uint64_t *all = calloc(program->entry_count + 1u, sizeof(*all)), sum = 0;
	bool more = all;

	while (more) {
		more = false;
		for (uint32_t i = 0; i < program->entry_count; i++)
			more |= add_calls(program, i, own, all);
	}
	for (uint32_t i = 0; all && i < program->call_count; i++)
		sum += all[program->call[i]];
	free(all);
	return sum < UINT32_MAX ? sum : UINT32_MAX;
}

/* "task Fast, every 1 ms, priority 1: Counting" */
static void print_tasks(const struct program *program, const struct sink *out)
{
	for (uint32_t i = 0; i < program->task_count; i++) {
		const struct code_task *task = &program->task[i];
		char text[40];

		sink_text(out, "task ");
		if (*task_name(program, i))
			sink_text(out, task_name(program, i));
		else
			sink_printf(out, "%u", i + 1);
		iec_value_print(IEC_TIME, (union iec_value){
				.i = task_interval(task) }, text, sizeof(text));
		if (task->kind == TASK_INTERVAL)
			sink_printf(out, ", every %s ms", text);
		else
			sink_text(out, task->kind == TASK_EVENT ? ", on event" :
				       ", in every cycle");
		if (*task_name(program, i))
			sink_printf(out, ", priority %u", task->priority);
		for (uint32_t k = 0; k < task->count; k++) {
			uint32_t entry = program->call[task->first + k];

			sink_text(out, k ? ", " : ": ");
			sink_text(out, program->string_bytes ? program->string +
				       program->entry[entry].name : "?");
		}
		sink_text(out, "\n");
	}
}

/* ---- stretches ---- */

/* The bytes of memory that a stretch reads, or writes. */
struct touched { uint8_t *byte; uint32_t size; bool write; };

static void take_bytes(void *context, const struct code_access *access)
{
	struct touched *touched = context;
	const uint64_t end = (access->bit + access->bits + 7) / 8;

	for (uint64_t i = access->bit / 8;
	     access->write == touched->write && i < end && i < touched->size; i++)
		touched->byte[i] = 1;
}

/* " 4..7 12" */
static void print_ranges(const struct touched *touched, const struct sink *out)
{
	uint32_t end;

	for (uint32_t i = 0; i < touched->size; i = end + 1) {
		for (end = i; end < touched->size && touched->byte[end];)
			end++;
		if (end > i + 1)
			sink_printf(out, " %u..%u", i, end - 1);
		else if (end > i)
			sink_printf(out, " %u", i);
	}
	sink_text(out, "\n");
}

static void print_stretch(const struct still *still, uint32_t i, struct touched *touched,
			  const struct sink *out)
{
	const struct stretch *stretch = &still->stretch[i];

	sink_printf(out, "%8u..%u%s\n", stretch->begin, stretch->end - 1,
		    stretch->always ? "  in each scan" : "");
	for (int write = 0; write < 2; write++) {
		memset(touched->byte, 0, touched->size);
		touched->write = write;
		still_each(still, i, take_bytes, touched);
		sink_text(out, write ? "          writes" : "          reads ");
		print_ranges(touched, out);
	}
}

static void print_stretches(const struct program *program, const struct sink *out)
{
	struct touched touched = { .size = program->header->data_size };
	const struct still *still;
	enum still_why why;
	struct arena keep;

	arena_init(&keep);
	touched.byte = malloc(touched.size);
	still = touched.byte ? still_new(program, STILL_LEAST, &keep, &why) : NULL;
	if (still)
		sink_printf(out, "\nstretches     %u, left out when no byte that they read or write "
			    "has changed\n", still->count);
	else
		sink_printf(out, "\nstretches     none, each scan runs the whole program: %s\n",
			    still_why_text(touched.byte ? why : STILL_NO_MEMORY));
	for (uint32_t i = 0; still && i < still->count; i++)
		print_stretch(still, i, &touched, out);
	free(touched.byte);
	arena_free(&keep);
}

static void print_code(const struct call *call, const struct program *program)
{
	uint32_t *own = calloc(program->entry_count + 1u, sizeof(*own));
	unsigned count;
	bool loops = false;

	print_sizes(program, &call->out);
	if (tasks_declared(program)) {
		sink_text(&call->out, "\n");
		print_tasks(program, &call->out);
	}
	for (uint32_t i = 0; own && i < program->entry_count; i++)
		own[i] = print_program(program, &program->entry[i], call,
				       &loops);
	count = own ? (unsigned)count_worst(program, own) : 0;
	free(own);
	if (loops)
		sink_printf(&call->out, "\nworst case    loops: %u "
			    "instructions, and what the budget of %u allows\n",
			    count, program->header->budget);
	else
		sink_printf(&call->out, "\nworst case    %u instructions\n",
			    count);
	if (HAS_STILL)
		print_stretches(program, &call->out);
}

enum status cmd_code(struct call *call)
{
	struct machine machine;
	enum status status = machine_open(&machine, call->arg[0], MACHINE_AS_FILE);

	if (status == STATUS_GOOD)
		print_code(call, ladder_program(machine.ladder));
	machine_close(&machine);
	return status;
}

static enum status save(const struct ladder *ladder, bool small,
			const char *path)
{
	size_t len = 0;
	const void *image = ladder_image(ladder, &len);
	enum status status;
	void *stripped;

	if (!small)
		return report_save(path, image, len);
	len = code_strip(image, NULL);
	stripped = malloc(len);
	if (!stripped)
		return report_no_memory(path);
	code_strip(image, stripped);
	status = report_save(path, stripped, len);
	free(stripped);
	return status;
}

/* A device, a pipe or a folder is not replaced by a file. */
static bool is_in_the_way(const char *path)
{
	struct stat status;

	if (stat(path, &status) != 0 || S_ISREG(status.st_mode))
		return false;
	report_diag((struct diag){ .id = DIAG_NOT_A_FILE, .file = path }, "%s",
		    "");
	return true;
}

enum status cmd_build(struct call *call)
{
	const char *path = call_option(call, "-o");
	struct machine machine;
	enum status status;

	if (!path || !*path)
		return report_usage(call, "-o OUT is missing");
	if (is_in_the_way(path))
		return STATUS_WRONG;
	status = machine_open(&machine, call->arg[0], MACHINE_AS_FILE);
	if (status == STATUS_GOOD)
		status = save(machine.ladder, call_flag(call, "--small"), path);
	machine_close(&machine);
	return status;
}
