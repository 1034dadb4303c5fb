/* SPDX-License-Identifier: MIT
 *
 * ladder_leave - the facade's export to ClassicLadder.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/exchange/classic/classic_write.h"
#include "engine/exchange/classic/to_classic.h"

bool ladder_sfc_fits_classic(struct ladder *ladder)
{
	struct project *project = ladder_project(ladder);

	return project && classic_sfc_fits(project);
}

char *ladder_export_classic(struct ladder *ladder, enum classic_dialect dialect,
			    const struct classic_lines *lines, size_t *len,
			    struct classic_report *report, struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	const struct classic_project *classic;
	struct sink_memory memory;
	struct arena arena;
	struct sink sink;

	if (!project)
		return NULL;
	arena_init(&arena);
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	classic = to_classic(project, dialect, lines, &arena, report, diags);
	if (classic)
		classic_write(classic, &sink);
	arena_free(&arena);
	if (classic && !memory.failed) {
		*len = memory.len;
		return memory.text;
	}
	if (classic)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY,
					       .file = project->file }, "%s", "");
	sink_memory_free(&memory);
	return NULL;
}
