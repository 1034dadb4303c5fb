/* SPDX-License-Identifier: MIT
 *
 * ladder_import - report and places of the last import, whatever format it had.
 *
 * A separate file, so that a program that imports nothing does not link it.
 */
#include "engine/ladder.h"

#include "engine/base/name.h"
#include "engine/exchange/drawing.h"
#include "engine/exchange/report.h"

static struct foreign *loaded(const struct ladder *ladder)
{
	struct foreign *each = ladder_foreign(ladder);

	while (each && !each->loaded)
		each = each->next;
	return each;
}

void ladder_import_language(struct ladder *ladder, const char *(*translate)(const char *text))
{
	for (struct foreign *each = ladder_foreign(ladder); each; each = each->next)
		each->report->translate = translate;
}

void ladder_classic_task(struct ladder *ladder, bool task)
{
	for (struct foreign *each = ladder_foreign(ladder); each; each = each->next)
		each->task = task;
}

int64_t ladder_period(const struct ladder *ladder)
{
	const struct foreign *foreign = loaded(ladder);

	return foreign ? foreign->period_ns : 0;
}

const struct classic_report *ladder_import_report(const struct ladder *ladder)
{
	const struct foreign *foreign = loaded(ladder);

	return foreign ? foreign->report : NULL;
}

const struct drawing *ladder_import_drawing(struct ladder *ladder, int pou, int number)
{
	const struct foreign *foreign = loaded(ladder);
	const struct drawings *all = foreign ? foreign->drawings : NULL;
	const struct project *project = ladder_project(ladder);
	const char *name = project && pou >= 0 && pou < project->pou_count ?
			   project_text(project, project->pou[pou].name) : NULL;

	for (int i = 0; all && name && i < all->count; i++)
		if (all->one[i].number == number && name_equal(all->one[i].pou, name))
			return &all->one[i];
	return NULL;
}

const char *ladder_import_text(const struct ladder *ladder, size_t *len)
{
	const struct foreign *foreign = loaded(ladder);

	*len = foreign ? foreign->text_len : 0;
	return foreign ? foreign->text : NULL;
}

int ladder_import_line(const void *ladder, int line)
{
	const struct foreign *foreign = loaded(ladder);

	return foreign ? foreign->line(foreign, line) : line;
}

void ladder_import_places(const struct ladder *ladder, struct diag_list *diags)
{
	struct foreign *foreign = loaded(ladder);

	if (foreign)
		foreign->place(foreign, diags);
}
