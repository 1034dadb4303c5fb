/* SPDX-License-Identifier: MIT
 *
 * ladder_classic - the facade's import of ClassicLadder projects.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/exchange/classic/classic_rung.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct classic_foreign {
	struct foreign foreign;   /* first: the pointers are equal             */
	struct arena arena;
	struct classic_report report;
	struct classic_options options;
	struct classic_text text;
	const char *io;           /* its I/O map; NULL: none                   */
	const struct classic_project *project; /* NULL: nothing was read       */
	const char *path;         /* as the user wrote it                      */
	bool folder;              /* it is a folder                            */
	const char *name;         /* lines of the text: their origin in the project */
};

static void free_foreign(struct foreign *foreign);

static struct classic_foreign *classic_of(const struct ladder *ladder)
{
	struct foreign *each = ladder_foreign(ladder);

	while (each && each->free != free_foreign)
		each = each->next;
	return (struct classic_foreign *)each;
}

static void forget(struct foreign *foreign)
{
	struct classic_foreign *classic = (struct classic_foreign *)foreign;

	arena_free(&classic->arena);
	report_free(&classic->report);
	classic->project = NULL;
	classic->io = NULL;
	memset(&classic->text, 0, sizeof(classic->text));
}

static void free_foreign(struct foreign *foreign)
{
	forget(foreign);
	free(foreign);
}

static const char *read_foreign(struct foreign *foreign, const char *path,
				const void *bytes, size_t len, size_t *text_len,
				const char **name, struct diag_list *diags)
{
	struct classic_foreign *classic = (struct classic_foreign *)foreign;
	struct diag place = { .id = DIAG_NO_MEMORY, .file = path };

	forget(foreign);
	classic->options.task = foreign->task;
	classic->path = path;
	classic->folder = !bytes;
	classic->project = bytes ?
		classic_read(&classic->arena, path, bytes, len, &classic->report, diags) :
		classic_read_folder(&classic->arena, path, &classic->report, diags);
	if (!classic->project)
		return NULL;
	classic->name = arena_copy(&classic->arena, path, strlen(path));
	if (!classic->name ||
	    !classic_to_rung(classic->project, classic->options, &classic->arena,
			     &classic->text, &classic->report)) {
		diag_add(diags, place, "%s", "");
		return NULL;
	}
	classic->io = classic_io_map(classic->project, &classic->arena, &classic->report);
	foreign->period_ns = classic->project->period * INT64_C(1000000);
	*name = classic->name;
	*text_len = classic->text.len;
	return classic->text.text;
}

/* Projects from before 2008 are folders that contain one of these files. */
static bool is_folder(const char *path)
{
	static const char *const name[] = { "sections.csv", "rung_0.csv", "general.txt",
					    "timers.csv" };
	char whole[600];
	struct stat about;

	for (size_t i = 0; i < sizeof(name) / sizeof(*name); i++) {
		int len = snprintf(whole, sizeof(whole), "%s/%s", path, name[i]);

		if (len > 0 && (size_t)len < sizeof(whole) && stat(whole, &about) == 0)
			return true;
	}
	return false;
}

static int line_of(const struct classic_foreign *classic, int line)
{
	return line > 0 && line <= classic->text.lines ?
	       classic->text.place[line - 1].line : 0;
}

/* In a folder, a line belongs to one of its files. */
static const char *file_of(struct classic_foreign *classic, int line)
{
	const char *member = line > 0 && line <= classic->text.lines ?
			     classic->text.place[line - 1].member : "";
	size_t path = strlen(classic->path), size = path + strlen(member) + 2;
	char *whole = classic->folder && *member ? arena_alloc(&classic->arena, size) : NULL;

	if (!whole)
		return classic->path;
	snprintf(whole, size, "%s%s%s", classic->path,
		 path && classic->path[path - 1] == '/' ? "" : "/", member);
	return whole;
}

static void place_diags(struct foreign *foreign, struct diag_list *diags)
{
	struct classic_foreign *classic = (struct classic_foreign *)foreign;

	int kept = 0;

	/* The import declares everything that a script can name: nobody left it unused. */
	for (int i = 0; i < diags->count; i++)
		if (!classic->project || classic->options.task ||
		    diags->diag[i].id != DIAG_UNUSED)
			diags->diag[kept++] = diags->diag[i];
	diags->count = kept;
	for (int i = 0; i < diags->count; i++) {
		struct diag *diag = &diags->diag[i];

		/* Files of the project itself have the path of the project. */
		if (!classic->project || !diag->file || diag->file == classic->path ||
		    strcmp(diag->file, classic->path))
			continue;
		diag->file = file_of(classic, diag->line);
		diag->column = 0;
		diag->line = line_of(classic, diag->line);
	}
}

static int line_in(const struct foreign *foreign, int line)
{
	return line_of((const struct classic_foreign *)foreign, line);
}

bool ladder_take_classic(struct ladder *ladder, bool faithful)
{
	struct classic_foreign *classic = calloc(1, sizeof(*classic));

	if (!classic)
		return false;
	classic->foreign = (struct foreign){ .is = classic_is, .is_folder = is_folder,
		.read = read_foreign, .place = place_diags, .forget = forget,
		.free = free_foreign, .line = line_in, .report = &classic->report, .classic = true };
	classic->options.faithful = faithful;
	arena_init(&classic->arena);
	report_init(&classic->report);
	ladder_add_foreign(ladder, &classic->foreign);
	return true;
}

const char *ladder_import_io(const struct ladder *ladder)
{
	const struct classic_foreign *classic = classic_of(ladder);

	return classic ? classic->io : NULL;
}

const struct classic_project *ladder_import_project(const struct ladder *ladder)
{
	const struct classic_foreign *classic = classic_of(ladder);

	return classic ? classic->project : NULL;
}

/* The place of the rung's RUNG line identifies the imported rung. */
const struct classic_rung *ladder_import_rung(const struct ladder *ladder, int pou,
					      int rung)
{
	const struct classic_foreign *classic = classic_of(ladder);
	const struct project *project = ladder_project((struct ladder *)ladder);
	const struct classic_place *place;
	uint32_t line;

	if (!classic || !classic->project || !project || pou < 0 ||
	    pou >= project->pou_count || rung < 0 || rung >= project->pou[pou].rung_count)
		return NULL;
	line = project->pou[pou].rung[rung]->line;
	if (!line || line > (uint32_t)classic->text.lines)
		return NULL;
	place = &classic->text.place[line - 1];
	for (int i = 0; i < classic->project->rungs; i++) {
		const struct classic_rung *one = classic->project->rung[i];

		if (one->place.member == place->member && one->place.line == place->line)
			return one;
	}
	return NULL;
}

bool ladder_is_classic(const char *path)
{
	char head[512];
	struct stat about;
	FILE *file;
	size_t len;

	if (is_folder(path))
		return true;
	/* Opening a pipe would block. */
	if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
		return false;
	file = fopen(path, "rb");
	if (!file)
		return false;
	len = fread(head, 1, sizeof(head), file);
	fclose(file);
	return classic_is(head, len);
}
