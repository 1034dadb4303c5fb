/* SPDX-License-Identifier: MIT
 *
 * ladder_others - the facade's import of the formats of exchange/import.h, and its export as PLCopen XML.
 *
 * A separate file, so that a program that does not use it does not link it.
 */
#include "engine/ladder.h"

#include "engine/exchange/import.h"
#include "engine/exchange/plcopen/plcopen_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct import_format *const formats[] = { &ldmicro_format, &openplc_format, &plcopen_format };
#define FORMATS (sizeof(formats) / sizeof(*formats))

enum { HEAD_MOST = 65536 };

struct other_foreign {
	struct foreign foreign;   /* first: the pointers are equal             */
	struct arena arena;
	struct classic_report report;
	struct foreign_text text;
	struct drawings drawings;
	const char *path;         /* as the user wrote it                      */
	const char *name;         /* the file of the text's lines; NULL: nothing was read */
	bool folder;
	bool declares_more;       /* of the format                             */
};

/* The format of a file, or of a folder if @bytes is NULL; NULL: none of them. */
static const struct import_format *format_of(const char *path, const void *bytes, size_t len)
{
	for (size_t i = 0; i < FORMATS; i++)
		if (bytes ? formats[i]->is && formats[i]->is(bytes, len) :
			    formats[i]->is_folder && formats[i]->is_folder(path))
			return formats[i];
	return NULL;
}

static bool is_other(const void *bytes, size_t len)
{
	return format_of("", bytes, len) != NULL;
}

static bool is_folder(const char *path)
{
	return format_of(path, NULL, 0) != NULL;
}

static void forget(struct foreign *foreign)
{
	struct other_foreign *other = (struct other_foreign *)foreign;

	arena_free(&other->arena);
	report_free(&other->report);
	memset(&other->text, 0, sizeof(other->text));
	memset(&other->drawings, 0, sizeof(other->drawings));
	other->name = NULL;
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
	struct other_foreign *other = (struct other_foreign *)foreign;
	const struct import_format *format = format_of(path, bytes, len);
	struct import import = {
		.path = path, .bytes = bytes, .len = len, .task = foreign->task,
		.arena = &other->arena, .report = &other->report, .diags = diags,
	};
	char *copy;

	forget(foreign);
	other->path = path;
	other->folder = !bytes;
	other->declares_more = format->declares_more;
	if (!format->read(&import))
		return NULL;
	other->text = import.text;
	other->drawings = import.drawings;
	foreign->period_ns = import.period_ns;
	copy = arena_copy(&other->arena, path, strlen(path));
	other->name = copy ? copy : path;
	*name = other->name;
	*text_len = other->text.len;
	return other->text.text;
}

static int line_of(const struct foreign *foreign, int line)
{
	const struct other_foreign *other = (const struct other_foreign *)foreign;

	return line > 0 && line <= other->text.lines ? other->text.place[line - 1].line : 0;
}

/* A line belongs to one of the files of a project. */
static const char *file_of(struct other_foreign *other, int line)
{
	const char *member = line > 0 && line <= other->text.lines ?
			     other->text.place[line - 1].member : "";
	const char *slash = strrchr(other->path, '/');
	const size_t size = strlen(other->path) + strlen(member) + 2;
	char *whole = *member ? arena_alloc(&other->arena, size) : NULL;

	if (!whole)
		return other->path;
	if (other->folder)
		snprintf(whole, size, "%s/%s", other->path, member);
	else
		snprintf(whole, size, "%.*s%s", slash ? (int)(slash + 1 - other->path) : 0, other->path, member);
	return whole;
}

static void place_diags(struct foreign *foreign, struct diag_list *diags)
{
	struct other_foreign *other = (struct other_foreign *)foreign;
	int kept = 0;

	for (int i = 0; i < diags->count; i++)
		if (!other->name || !other->declares_more || foreign->task || diags->diag[i].id != DIAG_UNUSED)
			diags->diag[kept++] = diags->diag[i];
	diags->count = kept;
	for (int i = 0; other->name && i < diags->count; i++) {
		struct diag *diag = &diags->diag[i];

		/* A message of the import itself has the path of the user. */
		if (!diag->file || diag->file == other->path || strcmp(diag->file, other->name) != 0)
			continue;
		diag->file = file_of(other, diag->line);
		diag->line = line_of(foreign, diag->line);
		diag->column = 0;
	}
}

bool ladder_take_others(struct ladder *ladder)
{
	struct other_foreign *other = calloc(1, sizeof(*other));

	if (!other)
		return false;
	other->foreign = (struct foreign){ .is = is_other, .is_folder = is_folder,
		.read = read_foreign, .place = place_diags, .forget = forget, .free = free_foreign,
		.line = line_of, .report = &other->report, .drawings = &other->drawings };
	arena_init(&other->arena);
	report_init(&other->report);
	ladder_add_foreign(ladder, &other->foreign);
	return true;
}

/* The first bytes of a file; 0: it is none, or cannot be read. */
static size_t read_head(const char *path, char *head, size_t size)
{
	struct stat about;
	FILE *file;
	size_t len;

	/* Opening a pipe would block. */
	if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
		return 0;
	file = fopen(path, "rb");
	if (!file)
		return 0;
	len = fread(head, 1, size, file);
	fclose(file);
	return len;
}

const char *ladder_import_format(const char *path)
{
	const struct import_format *format = format_of(path, NULL, 0);
	char *head;

	if (format)
		return format->name;
	if (ladder_is_classic(path))
		return "ClassicLadder";
	/* Declarations may stand before what tells the format. */
	head = malloc(HEAD_MOST);
	if (!head)
		return NULL;
	format = format_of(path, head, read_head(path, head, HEAD_MOST));
	free(head);
	return format ? format->name : NULL;
}

char *ladder_export_plcopen(struct ladder *ladder, size_t *len, struct classic_report *report)
{
	struct project *project = ladder_read_project(ladder);

	return project ? plcopen_write(project, len, report) : NULL;
}
