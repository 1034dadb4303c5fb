/* SPDX-License-Identifier: MIT
 *
 * trial - the little program that tests of trial/ run, and a place for its
 * output.
 */
#ifndef TESTS_TRIAL_H
#define TESTS_TRIAL_H

#include "engine/base/sink.h"
#include "engine/ladder.h"

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
#endif
