/* SPDX-License-Identifier: MIT
 *
 * fuzz_classic - reads any bytes as a ClassicLadder project and imports it.
 *
 * Packed seeds are unpacked before they are changed, because the checksum would refuse them
 * all. One seed stays packed, for the unpacker.
 */
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/classic/inflate.h"
#include "engine/ladder.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	(void)bytes;
	*out_len = len;
	return NULL;
}

static void look_at(const struct classic_project *project)
{
	int count = 0;

	fuzz_expect(project->sections > 0, "a project has a section");
	fuzz_expect(project->period > 0, "and a period");
	for (int i = 0; i < project->rungs; i++) {
		const struct classic_rung *rung = project->rung[i];

		fuzz_expect(rung->rows <= CLASSIC_ROWS, "rows");
		fuzz_expect(rung->place.line > 0, "a rung has a place");
		fuzz_expect(classic_rung(project, rung->number) == rung, "and is found");
		for (int y = 0; y < CLASSIC_ROWS; y++)
			for (int x = 0; x < CLASSIC_COLUMNS; x++)
				count += rung->cell[y][x].variable.number >= CLASSIC_LIMIT;
	}
	fuzz_expect(count == 0, "numbers are in their range");
	for (int i = 0; i < project->sections; i++)
		fuzz_expect(project->section[i].sequential || project->section[i].first < 0 ||
			    classic_rung(project, project->section[i].first),
			    "a section's first rung is there");
	for (int i = 0; i < project->expressions; i++)
		fuzz_expect(classic_expression(project, project->expression[i].number) &&
			    strlen(project->expression[i].text) > 0, "expressions");
	for (int i = 0; i < project->symbols; i++)
		fuzz_expect(strlen(project->symbol[i].name) < 1000, "symbols");
}

/* Corrects the checksum and the length in the trailer, so that the changed text is read. */
static void unpack(const uint8_t *bytes, size_t len)
{
	enum diag_id why = DIAG_COUNT;
	struct arena arena;
	size_t out = 0;

	arena_init(&arena);
	if (!inflate_gzip(&arena, bytes, len, 1 << 20, &out, &why))
		fuzz_expect(why != DIAG_COUNT, "what is refused has a reason");
	arena_free(&arena);
}

/* Exports the project again: the result can be read, or there is an error. */
static void leave(struct ladder *ladder, enum classic_dialect dialect)
{
	struct classic_report report;
	struct diag_list diags;
	struct arena arena;
	size_t len = 0;
	char *text;

	arena_init(&arena);
	report_init(&report);
	diag_init(&diags);
	text = ladder_export_classic(ladder, dialect, NULL, &len, &report, &diags);
	fuzz_expect(!text == (diags.errors > 0), "an export, or an error");
	diag_init(&diags);
	if (text && dialect != CLASSIC_NUMERIC)
		fuzz_expect(classic_read(&arena, "again.clprj", text, len, &report, &diags) !=
			    NULL, "what is exported can be read");
	free(text);
	arena_free(&arena);
	report_free(&report);
}

/* A project without an error becomes a program, or there is an error. */
static void import(const uint8_t *bytes, size_t len)
{
	struct ladder *ladder = ladder_new();

	if (!ladder || !ladder_take_classic(ladder, len & 1))
		abort();
	if (!ladder_load_text(ladder, "fuzz.clprj", bytes, len) || !ladder_build(ladder))
		fuzz_expect(ladder_diags(ladder)->errors > 0, "no program, no error");
	else if (ladder_sfc_fits_classic(ladder))
		leave(ladder, len % 3 ? CLASSIC_UPSTREAM : len % 2 ? CLASSIC_LINUXCNC :
						       CLASSIC_NUMERIC);
	ladder_free(ladder);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	struct classic_report report;
	struct classic_project *project;
	struct diag_list diags;
	struct arena arena;

	arena_init(&arena);
	report_init(&report);
	diag_init(&diags);
	unpack(bytes, len);
	classic_is(bytes, len);
	project = classic_read(&arena, "fuzz.clprj", bytes, len, &report, &diags);
	fuzz_expect(!project == (diags.errors > 0), "a project, or an error");
	if (project) {
		look_at(project);
		import(bytes, len);
	}
	for (int i = 0; i < diags.count; i++) {
		char text[400];

		diag_print(&diags.diag[i], text, sizeof(text));
	}
	arena_free(&arena);
	report_free(&report);
	return 0;
}
