/* SPDX-License-Identifier: MIT
 *
 * test_normal - the normal form of a rung has the same meaning.
 *
 * Every rung of the samples and of the golden cases that build is put into normal form; the
 * translated program must be the same, instruction by instruction.
 */
#include "editor-gtk/edit/grid_edit.h"
#include "engine/base/name.h"
#include "engine/ladder.h"
#include "tests/tap.h"

#include <glob.h>
#include <stdlib.h>

static bool same_text(struct project *a, uint32_t i, struct project *b, uint32_t k)
{
	return name_equal(project_text(a, i), project_text(b, k)); /* a name such as By is written as a word: BY */
}

static bool same_lists(struct ladder *a, struct ladder *b, int pou)
{
	const struct il *x = ladder_il(a, pou), *y = ladder_il(b, pou);
	struct project *p = ladder_project(a), *q = ladder_project(b);

	if (!x || !y || x->count != y->count)
		return false;
	for (int i = 0; i < x->count; i++) {
		const struct il_line *u = &x->line[i], *v = &y->line[i];

		if (u->kind != v->kind || u->op != v->op || u->word != v->word ||
		    u->modifiers != v->modifiers || u->rung != v->rung ||
		    !same_text(p, u->operand, q, v->operand) ||
		    !same_text(p, u->pin, q, v->pin))
			return false;
	}
	return true;
}

/* Puts all rungs into normal form; -1: a result is wrong. */
static int normalise_all(struct project *project)
{
	int changed = 0;

	for (int i = 0; i < project->pou_count; i++)
		for (int k = 0; k < project->pou[i].rung_count; k++) {
			struct rung **rung = &project->pou[i].rung[k];
			struct rung *made = grid_normalise(*rung);
			struct rung *again = made ? grid_normalise(made) : NULL;

			if (!made || !again || !rung_equal(made, again) ||
			    !grid_same(*rung, made)) {
				rung_free(made);
				rung_free(again);
				return -1;
			}
			changed += !rung_equal(made, *rung);
			rung_free(again);
			rung_free(*rung);
			*rung = made;
		}
	return changed;
}

/* NULL: equal, or nothing to compare. */
static const char *compare(const char *path, int *rungs_changed, int *files)
{
	struct ladder *before = ladder_new(), *after = ladder_new();
	const char *wrong = NULL;
	char *text = NULL;
	size_t len;
	int changed;

	if (!ladder_load(before, path) || !ladder_build(before) ||
	    !ladder_load(after, path) || !ladder_project(after) || ladder_project(after)->words.as_numbers)
		goto out;
	changed = normalise_all(ladder_project(after));
	if (changed < 0) {
		wrong = "the normal form is another circuit";
		goto out;
	}
	text = ladder_write(after, &len);
	if (!text || !ladder_load_text(after, path, text, len) || !ladder_build(after)) {
		wrong = "the normal form does not build";
		goto out;
	}
	for (int i = 0; i < ladder_project(before)->pou_count; i++)
		if (!same_lists(before, after, i))
			wrong = "the normal form is another program";
	++*files;
	*rungs_changed += changed;
out:
	free(text);
	ladder_free(before);
	ladder_free(after);
	return wrong;
}

int main(void)
{
	int changed = 0, files = 0;
	glob_t found;

	if (!CHECK(glob("ladders/*.rung", 0, NULL, &found) == 0))
		return tap_done();
	glob("tests/golden/*/*.rung", GLOB_APPEND, NULL, &found);
	for (size_t i = 0; i < found.gl_pathc; i++) {
		const char *wrong = compare(found.gl_pathv[i], &changed, &files);

		if (wrong) {
			CHECK_AS(false, found.gl_pathv[i]);
			printf("# %s\n", wrong);
		}
	}
	printf("# %d files, %d rungs changed\n", files, changed);
	CHECK(files > 60);
	CHECK(changed > 5);
	globfree(&found);
	return tap_done();
}
