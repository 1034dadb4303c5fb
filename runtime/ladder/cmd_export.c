/* SPDX-License-Identifier: MIT
 *
 * cmd_export - `ladder export`: a program in another language. Of charts there are
 * ladders; what comes out is read, checked and written in canonical form. Or the whole as a
 * project of ClassicLadder.
 */
#include "ladder/export_io.h"
#include "ladder/paths.h"

#include "engine/base/file.h"
#include "engine/exchange/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static enum status write_out(struct call *call, const char *text, size_t len)
{
	const char *path = call_option(call, "-o");

	if (path)
		return report_save(path, text, len);
	sink_write(&call->out, text, len);
	return STATUS_GOOD;
}

/* @text: as the engine made it. */
static enum status write_canonical(struct call *call, const char *path, const char *text,
				   size_t len)
{
	struct ladder *ladder = ladder_new();
	enum status status = STATUS_NO;
	char *out;

	if (!ladder)
		return report_no_memory(path);
	if (ladder_load_text(ladder, path, text, len)) {
		out = ladder_write(ladder, &len);
		status = out ? write_out(call, out, len) : report_no_memory(path);
		free(out);
	}
	report_diags(ladder_diags(ladder));
	ladder_free(ladder);
	return status;
}

static enum status export_loaded(struct call *call, struct ladder *ladder,
				 const char *path)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	enum status status = STATUS_NO;
	size_t len;
	char *text;

	if (!diags)
		return report_no_memory(path);
	diag_init(diags);
	text = ladder_export_ladder(ladder, &len, diags);
	ladder_import_places(ladder, diags);
	report_diags(diags);
	free(diags);
	if (text)
		status = write_canonical(call, path, text, len);
	free(text);
	return status;
}

/* ---- ClassicLadder ---- */

/* What an export goes on with. */
struct leaving_to {
	enum classic_dialect dialect;
	struct classic_lines lines;
	struct arena arena; /* of the lines                                     */
};

/* The map that is given, the one that an import of the project itself gives, or the one
 * that stands beside the rung file. */
static bool find_lines(struct call *call, struct ladder *ladder, struct leaving_to *to)
{
	const char *given = call_option(call, "--io"), *own = ladder_import_io(ladder);
	char *beside = path_with_ending(call->arg[0], ".io"), *text;
	const char *path = given ? given : beside;
	bool good = true;
	size_t len;

	if (own && !given) {
		good = export_lines(call->arg[0], own, strlen(own), &to->arena, &to->lines);
	} else if (given || (beside && access(beside, R_OK) == 0)) {
		text = report_read(path, &len);
		good = text && export_lines(path, text, len, &to->arena, &to->lines);
		free(text);
	}
	free(beside);
	return good;
}

static const struct { const char *word; enum classic_dialect dialect; } classic_words[] = {
	{ "classicladder", CLASSIC_UPSTREAM }, { "linuxcnc", CLASSIC_LINUXCNC },
	{ "numeric", CLASSIC_NUMERIC },
};
enum { CLASSIC_WORDS = sizeof(classic_words) / sizeof(*classic_words) };

/* What means something else there; on standard error, because the file may be on the
 * other one. */
static void print_changes(const char *path, const struct classic_report *report)
{
	for (int i = 0; i < report->count; i++) {
		const struct report_line *line = &report->line[i];

		if (line->line)
			fprintf(stderr, "%s:%d: changed: %s\n", path, line->line, line->text);
		else
			fprintf(stderr, "%s: changed: %s\n", path, line->text);
	}
}

static enum status export_classic(struct call *call, struct ladder *ladder,
				  const char *path, const struct leaving_to *to)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct classic_report report;
	enum status status = STATUS_NO;
	size_t len;
	char *text;

	if (!diags)
		return report_no_memory(path);
	diag_init(diags);
	report_init(&report);
	text = ladder_export_classic(ladder, to->dialect, &to->lines, &len, &report, diags);
	ladder_import_places(ladder, diags);
	report_diags(diags);
	free(diags);
	if (text) {
		print_changes(path, &report);
		status = write_out(call, text, len);
	}
	report_free(&report);
	free(text);
	return status;
}

/* A chart that can be no page goes there as a ladder. */
static enum status export_as_ladder(struct call *call, struct ladder *ladder,
				    const char *path, const struct leaving_to *to)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct ladder *again = ladder_new();
	enum status status = STATUS_NO;
	char *text = NULL;
	size_t len;

	if (!diags || !again) {
		free(diags);
		ladder_free(again);
		return report_no_memory(path);
	}
	diag_init(diags);
	text = ladder_export_ladder(ladder, &len, diags);
	ladder_import_places(ladder, diags);
	report_diags(diags);
	if (text && ladder_load_text(again, path, text, len) && ladder_build(again)) {
		status = export_classic(call, again, path, to);
	} else if (text) {
		report_diags(ladder_diags(again));
	}
	free(text);
	free(diags);
	ladder_free(again);
	return status;
}

static enum status export_any(struct call *call, struct ladder *ladder, const char *path,
			      int word)
{
	struct leaving_to to = { .lines = { NULL, 0, 0 } };
	enum status status;

	if (word == CLASSIC_WORDS)
		return export_loaded(call, ladder, path);
	to.dialect = classic_words[word].dialect;
	arena_init(&to.arena);
	if (!find_lines(call, ladder, &to))
		status = STATUS_NO;
	else if (ladder_sfc_fits_classic(ladder))
		status = export_classic(call, ladder, path, &to);
	else
		status = export_as_ladder(call, ladder, path, &to);
	arena_free(&to.arena);
	return status;
}

enum status cmd_export(struct call *call)
{
	const char *path = call->arg[0], *as = call_option(call, "--as");
	struct ladder *ladder;
	enum status status;
	int word = 0;

	while (as && word < CLASSIC_WORDS && strcmp(as, classic_words[word].word) != 0)
		word++;
	if (!as || (word == CLASSIC_WORDS && strcmp(as, "ld") != 0))
		return report_usage(call, "--as needs ld, classicladder, linuxcnc or "
				    "numeric");
	ladder = program_new(false);
	if (!ladder)
		return report_no_memory(path);
	ladder_classic_task(ladder, true);
	status = report_load(ladder, path, true);
	if (status == STATUS_GOOD)
		status = export_any(call, ladder, path, word);
	ladder_free(ladder);
	return status;
}
