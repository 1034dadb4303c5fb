/* SPDX-License-Identifier: MIT
 *
 * test_boxed - statements of EXECUTE boxes after rungs were replaced, and texts after statements were.
 */
#include "engine/text/text.h"

#include "tests/tap.h"

#include <stdlib.h>

static const char program[] =
	"RUNGBOARD 1\n\nVAR\n  A : INT;\nEND_VAR\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO %IX0.0 | EXECUTE One |\n  EXECUTE One:\n    A := 1;\n  END_EXECUTE\n"
	"RUNG\n  | NO %IX0.1 | EXECUTE |\n  EXECUTE:\n    // two\n    (* lines\n above *)\n    A := 2;\n"
	"    IF A > 1 THEN\n      A := 3;\n    END_IF;\n  END_EXECUTE\nEND_PROGRAM\n";

static struct diag_list diags;
static struct project *project;
static struct pou *pou;

static const char *item(int at)
{
	return at < pou->st->count ? project_text(project, pou->st->item[at].text) : "";
}

static void put(int at, const char *text)
{
	struct rung *rung = text_read_rung(project, text, strlen(text), &diags);

	CHECK(rung && project_add_rung(pou, at, rung) && text_take_boxes(project, pou));
}

static bool give(void *context, uint32_t *slot, uint32_t text)
{
	*slot = text;
	*(int *)context += 1;
	return true;
}

int main(void)
{
	char *text;
	size_t len;
	int given = 0;

	project = project_new("t.rung");
	diag_init(&diags);
	CHECK(text_read(project, "t.rung", program, strlen(program), NULL, &diags));
	pou = &project->pou[0];
	CHECK(pou->boxed_count == 2 && pou->boxed[1].rung == 1 && pou->boxed[1].count == 6);
	CHECK(pou->st->item[0].line == 11 && pou->boxed[0].line == 10);
	text = text_write(project, &len);
	CHECK_TEXT(text, program);
	free(text);
	/* A rung without a box moves them, and keeps the statements. */
	const struct st_item *before = pou->st->item;

	put(0, "RUNG\n  | NO %IX0.2 | COIL %QX0.0 |\n");
	CHECK(pou->boxed_count == 2 && pou->boxed[1].rung == 2 && pou->st->item == before);
	CHECK(pou_boxed(pou, 2, 0, 1) == &pou->boxed[1] && !pou_boxed(pou, 0, 0, 1) && !pou_boxed(pou, 2, 0, 0));
	/* One with a box has statements of its own, among the others. */
	put(2, "RUNG\n  | NO %IX0.3 | EXECUTE More |\n  EXECUTE More:\n    A := 7;\n    A := 8;\n  END_EXECUTE\n");
	CHECK(pou->boxed_count == 3 && pou->boxed[1].count == 2 && pou->boxed[2].count == 6);
	CHECK_TEXT(item(0), "A := 1");
	CHECK_TEXT(item(1), "A := 7");
	CHECK_TEXT(item(2), "A := 8");
	CHECK_TEXT(item(3), "// two");
	CHECK_TEXT(item(5), "A := 2");
	/* A changed statement changes the text of its cell only. */
	pou->st->item[1].text = names_intern(&project->names, "A := 9", 6);
	CHECK(text_give_boxes(project, give, &given) && given == 1);
	CHECK_TEXT(project_text(project, rung_at(pou->rung[2], 0, 1)->args), "  A := 9;\n  A := 8;\n");
	/* A removed rung takes its statements with it. */
	rung_free(project_take_rung(pou, 2));
	CHECK(text_take_boxes(project, pou) && pou->boxed_count == 2);
	CHECK_TEXT(item(1), "// two");
	project_free(project);
	return tap_done();
}
