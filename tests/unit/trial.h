/* SPDX-License-Identifier: MIT
 *
 * trial - the little program that tests of trial/ run, and a place for its
 * output.
 */
#ifndef TESTS_TRIAL_H
#define TESTS_TRIAL_H

#include "engine/base/sink.h"
#include "engine/ladder.h"
#include "engine/trial/scenario.h"
#include "engine/trial/script.h"

#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char trial_source[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Open  AT %IX0.0 : BOOL;\n"
	"  Stop  AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\n"
	"  Lamp  AT %QX0.1 : BOOL;\n"
	"  Level : INT;\n"
	"  Heat  : REAL := 1.5;\n"
	"  Wait  : TIME := T#30ms;\n"
	"  Delay : TON;\n"
	"END_VAR\n"
	"VAR CONSTANT\n"
	"  Seven : INT := 7;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n"
	"  | NO Open   | NC Stop | COIL Motor |\n"
	"  | NO Motor ^|\n"
	"RUNG\n"
	"  | NO Motor | TON Delay PT:=Wait | COIL Lamp |\n"
	"RUNG\n"
	"  | NO Open | [ Level := Level + Seven ] |\n"
	"RUNG\n"
	"  | [ Heat > 100.0 ] | JMP Loop |\n"
	"RUNG Loop\n"
	"  | [ Heat > 100.0 ] | JMP Loop |\n"
	"END_PROGRAM\n";

struct bed {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
	struct diag_list diags;
	struct sink_memory text;
	struct sink out;
};

static inline bool bed_open_source(struct bed *bed, const char *source)
{
	memset(bed, 0, sizeof(*bed));
	diag_init(&bed->diags);
	sink_memory_init(&bed->text);
	bed->out = sink_to_memory(&bed->text);
	bed->ladder = ladder_new();
	if (!bed->ladder ||
	    !ladder_load_text(bed->ladder, "bed.rung", source, strlen(source)) ||
	    !ladder_build(bed->ladder))
		return false;
	bed->memory = calloc(1, image_memory_size(ladder_program(bed->ladder)));
	if (!bed->memory)
		return false;
	resource_init(&bed->resource, ladder_program(bed->ladder), bed->memory);
	return true;
}

static inline bool bed_open(struct bed *bed)
{
	return bed_open_source(bed, trial_source);
}

static inline void bed_close(struct bed *bed)
{
	sink_memory_free(&bed->text);
	free(bed->memory);
	ladder_free(bed->ladder);
}

/* Before the next thing that is tried. */
static inline void bed_clear(struct bed *bed)
{
	diag_init(&bed->diags);
	sink_memory_free(&bed->text);
}

/* "LD106:3:5" of the first diagnostic, "" without one. */
static inline const char *bed_first(const struct bed *bed)
{
	static char text[64];
	const struct diag *diag = &bed->diags.diag[0];

	text[0] = '\0';
	if (bed->diags.count)
		snprintf(text, sizeof(text), "%s:%d:%d", diag_code(diag->id),
			 diag->line, diag->column);
	return text;
}

/* The trace of a script with scans 10 ms apart. */
static inline const char *bed_trace(struct bed *bed, const char *script,
				    enum trace_form form, bool changes)
{
	struct trace trace;

	bed_clear(bed);
	trace_init(&trace, &bed->resource.image, &bed->out, form, changes);
	script_run("s", script, strlen(script), INT64_C(10000000), &bed->resource, NULL,
		   &trace, &bed->diags);
	trace_free(&trace);
	return sink_memory_text(&bed->text);
}

/* The reports of all scenarios of a text; "held" if all passed.
 * @first: NULL, or gets the first one after its run; only its numbers are valid */
static inline const char *bed_judge(struct bed *bed, const char *text,
				    struct scenario *first)
{
	struct scenario_file file;
	struct arena arena;
	bool held = true;

	bed_clear(bed);
	arena_init(&arena);
	if (!scenario_read("s.scn", text, strlen(text), &bed->resource.image, NULL, (struct formula_projects){ NULL, NULL },
			   &arena, &file, &bed->diags)) {
		arena_free(&arena);
		return bed_first(bed);
	}
	for (int i = 0; i < file.count; i++)
		held = scenario_run(&file, i, &bed->resource, NULL, &bed->out) && held;
	if (first)
		*first = file.scenario[0];
	arena_free(&arena);
	CHECK_AS(held == !*sink_memory_text(&bed->text),
		 "a report exactly when something failed");
	return held ? "held" : sink_memory_text(&bed->text);
}
#endif
