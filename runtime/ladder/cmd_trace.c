/* SPDX-License-Identifier: MIT
 *
 * cmd_trace - `ladder trace`: runs a stimulus script in virtual time and prints the
 * variables after each scan.
 */
#include "ladder/report.h"

#include "engine/trial/script.h"
#include "engine/trial/value.h"
#include "hal/iomap.h"
#include "hal/said.h"

#include <stdlib.h>

/* What tells the quality of values, of the map of --io. */
struct quality {
	const struct image *image;
	struct io_said *said;
	int count;
};

static const char *quality_of(void *context, struct location at)
{
	static const char *const word[] = { [QUALITY_STALE] = "stale", [QUALITY_FAULT] = "fault",
		[QUALITY_FORCED] = "forced" };
	const struct quality *quality = context;

	return word[io_said_quality(quality->said, quality->count, quality->image, at)];
}

static bool list_said(struct quality *quality, const struct iomap *map, const struct areas *areas,
		      struct arena *arena)
{
	const int count = io_said_list(map, areas, NULL, 0);

	quality->said = arena_alloc(arena, sizeof(*quality->said) * (size_t)(count + 1));
	if (quality->said)
		quality->count = io_said_list(map, areas, quality->said, count);
	return quality->said;
}

static enum status read_map(struct quality *quality, const char *path, const struct machine *machine,
			    struct arena *arena)
{
	const struct areas *areas = &machine->resource.image.program->areas;
	struct diag_list *diags;
	struct iomap map;
	size_t len;
	char *text = report_read(path, &len);
	bool good;

	if (!text)
		return STATUS_WRONG;
	diags = report_list(path);
	good = diags && iomap_read(&map, arena, path, text, len, diags) && iomap_fits(&map, areas, diags) &&
	       list_said(quality, &map, areas, arena);
	free(text);
	if (diags)
		report_end(diags);
	return good ? STATUS_GOOD : STATUS_NO;
}

static enum status run(struct call *call, struct machine *machine, struct quality *quality,
		       enum trace_form form, int64_t period_ns)
{
	struct trace trace;
	size_t len;
	char *text = report_read(call->arg[1], &len);
	struct diag_list *diags = text ? report_list(call->arg[1]) : NULL;
	enum status status = STATUS_WRONG;

	if (diags) {
		trace_init(&trace, &machine->resource.image, &call->out, form,
			   call_flag(call, "--changes"));
		trace.project = ladder_project(machine->ladder);
		trace.stop = &call->out_failed;
		trace.quality = quality->count ? quality_of : NULL;
		trace.quality_context = quality;
		status = script_run(call->arg[1], text, len, period_ns,
				    &machine->resource, machine_plant(machine), &trace,
				    diags) ? STATUS_GOOD : STATUS_NO;
		trace_free(&trace);
		report_end(diags);
	}
	free(text);
	return status;
}

enum status cmd_trace(struct call *call)
{
	bool csv = call_flag(call, "--csv"), vcd = call_flag(call, "--vcd");
	const char *map = call_option(call, "--io");
	struct quality quality = { .count = 0 };
	struct machine machine;
	enum status status;
	struct arena arena;
	int64_t period_ns;

	if (csv && vcd)
		return report_usage(call, "--csv and --vcd cannot be used together");
	if (!report_period(call, "--period", 0, &period_ns))
		return STATUS_WRONG;
	status = machine_open_call(&machine, call,
				   call_flag(call, "--faithful") ? MACHINE_FAITHFUL : 0);
	arena_init(&arena);
	quality.image = &machine.resource.image;
	if (status == STATUS_GOOD && map)
		status = read_map(&quality, map, &machine, &arena);
	if (status == STATUS_GOOD) {
		machine_skip(&machine, call);
		status = run(call, &machine, &quality, csv ? TRACE_CSV :
			     vcd ? TRACE_VCD : TRACE_LINES,
			     program_period(machine.ladder, period_ns));
	}
	arena_free(&arena);
	machine_close(&machine);
	return status;
}
