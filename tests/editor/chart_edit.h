/* SPDX-License-Identifier: MIT
 *
 * chart_edit - a chart from a text, an edit of it, a text again, for tests of such edits.
 */
#ifndef TEST_CHART_EDIT_H
#define TEST_CHART_EDIT_H

#include "editor-gtk/edit/sfc_edit.h"
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct ladder *ladder;
static char *text_now;

static bool load(const char *text)
{
	ladder_free(ladder);
	ladder = ladder_new();
	return ladder_load_text(ladder, "test.rung", text, strlen(text)) &&
	       ladder_project(ladder) && ladder_project(ladder)->pou[0].sfc;
}

static void keep_text(void)
{
	size_t len;

	free(text_now);
	text_now = ladder_write(ladder, &len);
}

static void begin(const char *body)
{
	char text[4000];

	snprintf(text, sizeof(text), "RUNGBOARD 1\n\nPROGRAM Main SFC\n%sEND_PROGRAM\n",
		 body);
	CHECK_AS(load(text), "the chart can be read");
	keep_text();
}

static struct sfc_edit *edit_new(void)
{
	struct project *project = ladder_project(ladder);

	return sfc_edit_new(project, &project->pou[0]);
}

/* Replaces the POU by the text of the edit. */
static bool take(struct sfc_edit *edit)
{
	char *pou = sfc_edit_text(edit), *whole;
	size_t size;
	bool good;

	sfc_edit_free(edit);
	if (!pou)
		return false;
	size = strlen(pou) + 32;
	whole = malloc(size);
	snprintf(whole, size, "RUNGBOARD 1\n\n%s", pou);
	good = load(whole);
	if (!good)
		printf("# cannot be read:\n%s\n", whole);
	free(pou);
	if (good) {
		keep_text();
		good = strcmp(text_now, whole) == 0;
		if (!good)
			printf("# not canonical:\n%s\n# is:\n%s\n", whole, text_now);
	}
	free(whole);
	return good;
}

static const struct sfc *chart(void)
{
	return ladder_project(ladder)->pou[0].sfc;
}

static const char *body(void)
{
	static char out[8000];
	const char *from = strstr(text_now, "SFC\n") + 4;
	const char *end = strstr(text_now, "END_PROGRAM");

	snprintf(out, sizeof(out), "%.*s", (int)(end - from), from);
	return out;
}

#define EDIT(call) do { \
	struct sfc_edit *edit = edit_new(); \
	CHECK_AS((call), #call); \
	CHECK_AS(take(edit), #call " reads again"); \
} while (0)

static const char two[] =
	"  INITIAL_STEP A:\n  END_STEP\n\n"
	"  TRANSITION FROM A TO B := I0.0; END_TRANSITION\n\n"
	"  STEP B:\n    Q0.0(N);\n  END_STEP\n\n"
	"  TRANSITION FROM B TO A := B.T > T#1s; END_TRANSITION\n";

#endif
