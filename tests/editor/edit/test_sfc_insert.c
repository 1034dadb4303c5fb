/* SPDX-License-Identifier: MIT
 *
 * test_sfc_insert - inserting a part of a chart into its sequence: known places by their
 * text, random ones by invariants: the text can be read, is canonical, and no transition
 * leads to a missing step.
 */
#include "engine/show/sfc_layout.h"
#include "tests/editor/chart_edit.h"

#define INSERTS 3000

/* ---- a part at the end of the chart is moved into its sequence ---- */

/* A chart of @two and @part, whose first step and transition are 2 and 2. */
static void begin_with(const char *part)
{
	char text[2000];

	snprintf(text, sizeof(text), "%s\n%s", two, part);
	begin(text);
}

static void check_inserts(void)
{
	static const char cut[] = "  STEP New:\n  END_STEP\n\n"
		"  TRANSITION FROM New TO Gone := I0.7; END_TRANSITION\n";
	static const char between[] =
		"  INITIAL_STEP A:\n  END_STEP\n\n"
		"  TRANSITION FROM A TO New := I0.0; END_TRANSITION\n\n"
		"  STEP New:\n  END_STEP\n\n"
		"  TRANSITION FROM New TO B := I0.7; END_TRANSITION\n\n"
		"  STEP B:\n    Q0.0(N);\n  END_STEP\n\n"
		"  TRANSITION FROM B TO A := B.T > T#1s; END_TRANSITION\n";

	begin_with(cut);
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2);
	CHECK_TEXT(body(), between);
	EDIT(sfc_edit_delete_step(edit, 1));
	CHECK_TEXT(body(), two);
	begin_with(cut);
	EDIT(sfc_edit_insert(edit, 2, 2, -1, 0) == 2);
	CHECK_TEXT(body(), between);
	/* It joins the loop here, and not where it was copied from. */
	begin_with("  STEP New:\n  END_STEP\n\n"
		   "  TRANSITION FROM New TO B := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 2, -1, 1) == 2);
	CHECK(strstr(body(), "FROM B TO New := B.T > T#1s;"));
	CHECK(strstr(body(), "FROM New TO A := I0.7;"));
	/* A step alone, a transition alone, a transition and a step. */
	begin_with("  STEP New:\n  END_STEP\n");
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2);
	CHECK(strstr(body(), "FROM A TO New := I0.0;") && strstr(body(), "FROM New TO B:\n"));
	begin_with("  TRANSITION FROM Gone TO Far := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2);
	CHECK(strstr(body(), "FROM A TO Step1 := I0.7;") &&
	      strstr(body(), "FROM Step1 TO B := I0.0;"));
	begin_with("  TRANSITION FROM Gone TO Far := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 2, -1, 0) == 2);
	CHECK(strstr(body(), "FROM A TO Step1 := I0.0;") &&
	      strstr(body(), "FROM Step1 TO B := I0.7;"));
	begin_with("  TRANSITION FROM Gone TO New := I0.7; END_TRANSITION\n\n"
		   "  STEP New:\n  END_STEP\n");
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2);
	CHECK(strstr(body(), "FROM A TO New := I0.7;") &&
	      strstr(body(), "FROM New TO B := I0.0;"));
}

static void check_inserts_at_ends(void)
{
	/* Behind the last step; unknown steps are made. */
	begin("  INITIAL_STEP A:\n  END_STEP\n\n  STEP New:\n  END_STEP\n\n"
	      "  TRANSITION FROM New TO A := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 1, 0, 0, -1) == 1);
	CHECK(strstr(body(), "FROM A TO New:\n") && strstr(body(), "FROM New TO A := I0.7;"));
	begin("  INITIAL_STEP A:\n  END_STEP\n\n  STEP New:\n  END_STEP\n\n"
	      "  TRANSITION FROM New TO Gone := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 1, 0, 0, -1) == 1);
	CHECK(strstr(body(), "FROM New TO Step1 := I0.7;") && strstr(body(), "STEP Step1:"));
	/* A pasted transition closes the gap. */
	begin("  INITIAL_STEP A:\n  END_STEP\n\n  STEP B:\n  END_STEP\n\n"
	      "  TRANSITION FROM A TO B := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 0, 0, -1) >= 0);
	CHECK(strstr(body(), "FROM A TO B := I0.7;") && chart()->step_count == 2);
	/* A step with two transitions: both leave the inserted part. */
	begin("  INITIAL_STEP A:\n  END_STEP\n\n  STEP B:\n  END_STEP\n\n"
	      "  TRANSITION FROM A TO A := I0.0; END_TRANSITION\n\n"
	      "  TRANSITION FROM A TO B := I0.1; END_TRANSITION\n\n"
	      "  STEP New:\n  END_STEP\n\n"
	      "  TRANSITION FROM New TO Gone := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2);
	CHECK(strstr(body(), "FROM A TO New:\n") && strstr(body(), "FROM New TO Step1 := I0.7;") &&
	      strstr(body(), "FROM Step1 TO A := I0.0;") &&
	      strstr(body(), "FROM Step1 TO B := I0.1;"));
	/* Into a macro-step. */
	begin("  INITIAL_STEP A:\n  END_STEP\n\n  MACRO_STEP M:\n\n"
	      "    INITIAL_STEP In:\n    END_STEP\n  END_STEP\n\n"
	      "  STEP New:\n  END_STEP\n\n"
	      "  TRANSITION FROM New TO A := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 3, 0, 2, -1) == 3);
	CHECK(strstr(body(), "    TRANSITION FROM In TO New:\n") &&
	      strstr(body(), "    TRANSITION FROM New TO Step1 := I0.7;"));
	/* Stays at the end: nothing to insert behind, or two beginnings. */
	begin_with("  STEP New:\n  END_STEP\n\n"
		   "  TRANSITION FROM New TO Gone := I0.7; END_TRANSITION\n");
	EDIT(sfc_edit_insert(edit, 2, 2, -1, -1) == 2);
	CHECK(strstr(body(), two) && strstr(body(), "FROM New TO Step1 := I0.7;"));
	begin_with("  STEP New:\n  END_STEP\n\n  STEP Other:\n  END_STEP\n");
	EDIT(sfc_edit_insert(edit, 2, 2, 0, -1) == 2 && edit->why);
	CHECK(strstr(body(), two) && chart()->transition_count == 2);
}

/* ---- any part at any place ---- */

static unsigned int seed = 7;

static int roll(int sides)
{
	seed = seed * 1103515245u + 12345u;
	return (int)((seed >> 16) % (unsigned int)sides);
}

/* Steps @prefix0…, and transitions between any of them and others. */
static int put_random(char *out, size_t size, const char *prefix, int steps, int ways)
{
	int len = 0;

	for (int i = 0; i < steps; i++)
		len += snprintf(out + len, size - (size_t)len, "  STEP %s%d:\n  END_STEP\n\n",
				prefix, i);
	for (int i = 0; i < ways; i++) {
		const int from = roll(steps + 1), to = roll(steps + 1);

		len += snprintf(out + len, size - (size_t)len,
				"  TRANSITION FROM %s%d TO %s%d := I0.%d; END_TRANSITION\n\n",
				from < steps ? prefix : "Old", from < steps ? from : roll(5),
				to < steps ? prefix : "Old", to < steps ? to : roll(5), i);
	}
	return len;
}

static bool all_known(void)
{
	struct sfc_layout *layout = sfc_layout_new(chart());
	bool good = layout != NULL;

	for (int t = 0; t < chart()->transition_count; t++) {
		const struct sfc_transition *way = &chart()->transition[t];

		for (int i = 0; i < way->to_count; i++)
			good &= chart()->ref[way->first_to + i].step >= 0;
		for (int i = 0; i < way->from_count; i++)
			good &= chart()->ref[way->first_from + i].step >= 0;
	}
	sfc_layout_free(layout);
	return good;
}

static bool insert_any(int *beside)
{
	const int steps = 1 + roll(4), ways = roll(4), new_steps = roll(4);
	char text[4000] = "RUNGBOARD 1\n\nPROGRAM Main SFC\n  INITIAL_STEP Old0:\n"
			  "  END_STEP\n\n";
	size_t len = strlen(text);
	struct sfc_edit *edit;
	int at, made;

	for (int i = 1; i < steps; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len,
					"  STEP Old%d:\n  END_STEP\n\n", i);
	for (int i = 0; i < ways; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len,
			"  TRANSITION FROM Old%d TO Old%d := I1.%d; END_TRANSITION\n\n",
			roll(steps), roll(steps), i);
	len += (size_t)put_random(text + len, sizeof(text) - len, "New", new_steps,
				  new_steps ? roll(4) : 1);
	snprintf(text + len, sizeof(text) - len, "END_PROGRAM\n");
	if (!load(text))
		return false;
	edit = edit_new();
	at = roll(steps + ways + 1) - 1;
	made = sfc_edit_insert(edit, steps, ways, at < steps ? at : -1,
			       at >= steps ? at - steps : -1);
	*beside += edit->why != NULL;
	if (made >= 0 && take(edit) && all_known())
		return true;
	printf("# at %d:\n%s\n# became:\n%s\n", at, text, text_now ? text_now : "");
	return false;
}

static void check_any(void)
{
	int bad = 0, beside = 0;

	for (int i = 0; i < INSERTS && !bad; i++)
		bad += !insert_any(&beside);
	printf("# %d of %d stand beside\n", beside, INSERTS);
	CHECK_AS(bad == 0, "results can be read and name existing steps");
}

int main(void)
{
	check_inserts();
	check_inserts_at_ends();
	check_any();
	ladder_free(ladder);
	free(text_now);
	return tap_done();
}
