/* SPDX-License-Identifier: MIT
 *
 * ladder_convert - the facade's conversion of POUs to other languages.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/convert/convert.h"

#include <stdlib.h>

char *ladder_export_as(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
		       struct diag_list *diags)
{
	struct project *project = ladder_project(ladder);
	struct sink_memory memory;
	struct sink sink;

	if (!project)
		return NULL;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (convert_to(project, wanted, to, &sink, diags) && !memory.failed) {
		*len = memory.len;
		return memory.text;
	}
	if (memory.failed)
		diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
	sink_memory_free(&memory);
	return NULL;
}

char *ladder_export_st(struct ladder *ladder, const uint8_t *wanted, size_t *len, struct diag_list *diags)
{
	return ladder_export_as(ladder, wanted, LANGUAGE_ST, len, diags);
}

char *ladder_export_lists(struct ladder *ladder, const uint8_t *wanted, size_t *len)
{
	struct project *project = ladder_project(ladder);

	if (!project)
		return NULL;
	if (!wanted)
		convert_join(project);
	for (int i = 0; i < project->pou_count; i++) {
		int count = 0;
		struct var *const *temp = ladder_temporaries(ladder, i, &count);

		/* The calls of a function with ARRAY[*] have one list for each set of bounds. */
		if (pou_has_any_bounds(&project->pou[i]) || (wanted && !wanted[i]))
			continue;
		if (!convert_to_il(project, i, ladder_il(ladder, i), temp, count))
			return NULL;
	}
	return ladder_write(ladder, len);
}
