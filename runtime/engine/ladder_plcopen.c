/* SPDX-License-Identifier: MIT
 *
 * ladder_plcopen - the facade's import and export of projects in PLCopen XML.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/exchange/plcopen/plcopen.h"
#include "engine/exchange/plcopen/plcopen_write.h"

#include <stdlib.h>
#include <string.h>

struct plcopen_foreign {
	struct foreign foreign;   /* first: the pointers are equal             */
	struct arena arena;
	struct classic_report report;
	struct plcopen_text text;
	const char *path;         /* as the user wrote it                      */
	const char *name;         /* the file of the text's lines; NULL: nothing was read */
};

static void forget(struct foreign *foreign)
{
	struct plcopen_foreign *xml = (struct plcopen_foreign *)foreign;

	arena_free(&xml->arena);
	report_free(&xml->report);
	memset(&xml->text, 0, sizeof(xml->text));
	xml->name = NULL;
}

static void free_foreign(struct foreign *foreign)
{
	forget(foreign);
	free(foreign);
}

static const char *read_foreign(struct foreign *foreign, const char *path, const void *bytes,
				size_t len, size_t *text_len, const char **name,
				struct diag_list *diags)
{
	struct plcopen_foreign *xml = (struct plcopen_foreign *)foreign;
	char *copy;

	forget(foreign);
	xml->path = path;
	if (!plcopen_to_rung(path, bytes, len, &xml->arena, &xml->text, &xml->report, diags))
		return NULL;
	copy = arena_copy(&xml->arena, path, strlen(path));
	xml->name = copy ? copy : path;
	*name = xml->name;
	*text_len = xml->text.len;
	return xml->text.text;
}

static int line_of(const struct foreign *foreign, int line)
{
	const struct plcopen_foreign *xml = (const struct plcopen_foreign *)foreign;

	return line > 0 && line <= xml->text.lines ? xml->text.line[line - 1] : 0;
}

/* A place in the text becomes one in the XML, which has other columns. */
static void place_diags(struct foreign *foreign, struct diag_list *diags)
{
	const struct plcopen_foreign *xml = (const struct plcopen_foreign *)foreign;

	for (int i = 0; xml->name && i < diags->count; i++) {
		struct diag *diag = &diags->diag[i];

		/* A message of the import itself has the path of the user. */
		if (!diag->file || diag->file == xml->path || strcmp(diag->file, xml->name) != 0)
			continue;
		diag->file = xml->path;
		diag->line = line_of(foreign, diag->line);
		diag->column = 0;
	}
}

bool ladder_take_plcopen(struct ladder *ladder)
{
	struct plcopen_foreign *xml = calloc(1, sizeof(*xml));

	if (!xml)
		return false;
	xml->foreign = (struct foreign){ .is = plcopen_is, .read = read_foreign,
		.place = place_diags, .forget = forget, .free = free_foreign, .line = line_of,
		.report = &xml->report, .drawings = &xml->text.drawings };
	arena_init(&xml->arena);
	report_init(&xml->report);
	ladder_add_foreign(ladder, &xml->foreign);
	return true;
}

char *ladder_export_plcopen(struct ladder *ladder, size_t *len, struct classic_report *report)
{
	struct project *project = ladder_read_project(ladder);

	return project ? plcopen_write(project, len, report) : NULL;
}
