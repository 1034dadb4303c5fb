/* SPDX-License-Identifier: MIT
 *
 * render_diff_chart - which steps, lines of steps and transitions of two charts differ; see
 * render_diff_chart.h. Two of them are the same if a file would have the same text of them.
 */
#include "editor-gtk/render/render_diff_sfc.h"

#include "engine/text/pou_print.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A copy of a chart that has one piece at a time, and steps that do nothing. */
struct plain {
	const struct sfc_sheet *sheet;
	const struct sfc *sfc;   /* the whole one                              */
	struct pou pou;
	struct sfc one;
	struct sfc_piece piece[2];
	char **text;             /* by shape; of jumps NULL                     */
	int *like;               /* by shape: the one of the other that is the
				    same, or was it before; -1: there is none    */
	bool *same;
};

static const char *text_of(const struct plain *plain, uint32_t id)
{
	return project_text(plain->sheet->project, id);
}

static int box_count(const struct plain *plain)
{
	return plain->sfc->step_count + plain->sfc->transition_count;
}

static bool is_step(const struct plain *plain, int shape)
{
	return shape < plain->sfc->step_count;
}

static const struct sfc_transition *way_of(const struct plain *plain, int shape)
{
	return &plain->sfc->transition[shape - plain->sfc->step_count];
}

static char *print(struct plain *plain, struct sfc_piece first, int count)
{
	plain->piece[0] = first;
	plain->piece[1] = (struct sfc_piece){ PIECE_MACRO_END, first.index };
	plain->one.piece = plain->piece;
	plain->one.piece_count = count;
	return pou_print(plain->sheet->project, &plain->pou);
}

/* From behind the first line on, with the name of what it stands in. */
static char *text_of_shape(struct plain *plain, int shape)
{
	const int index = is_step(plain, shape) ? shape : shape - plain->sfc->step_count;
	const int macro = is_step(plain, shape) ? plain->sfc->step[index].macro :
						  plain->sfc->transition[index].macro;
	const bool two = is_step(plain, shape) && plain->sfc->step[index].kind == STEP_MACRO;
	char *text = print(plain, (struct sfc_piece){ is_step(plain, shape) ? PIECE_STEP :
				   PIECE_TRANSITION, index }, two ? 2 : 1);
	const char *body = text ? strchr(text, '\n') : NULL;
	char *out = g_strdup_printf("%s\n%s", macro < 0 ? "" :
		text_of(plain, plain->sfc->step[macro].name), body ? body : "");

	free(text);
	return out;
}

static void start(struct plain *plain, const struct sfc_sheet *sheet)
{
	struct sfc_step *steps;

	plain->sheet = sheet;
	plain->sfc = sheet->pou->sfc;
	plain->pou = *sheet->pou;
	plain->one = *plain->sfc;
	plain->pou.sfc = &plain->one;
	plain->pou.vars.block_count = 0;
	steps = g_new0(struct sfc_step, plain->sfc->step_count + 1);
	for (int i = 0; i < plain->sfc->step_count; i++) {
		steps[i] = plain->sfc->step[i];
		steps[i].use_count = 0;
	}
	plain->one.step = steps;
	plain->text = g_new0(char *, box_count(plain) + 1);
	plain->like = g_new(int, box_count(plain) + 1);
	plain->same = g_new0(bool, box_count(plain) + 1);
	for (int i = 0; i < box_count(plain); i++) {
		plain->text[i] = text_of_shape(plain, i);
		plain->like[i] = -1;
	}
}

static void end(struct plain *plain)
{
	g_strfreev(plain->text);
	g_free(plain->like);
	g_free(plain->same);
	g_free(plain->one.step);
}

/* ---- which belong together ---- */

static bool same_names(const struct plain *a, int first_a, int count_a,
		       const struct plain *b, int first_b, int count_b)
{
	for (int i = 0; i < count_a && count_a == count_b; i++)
		if (strcasecmp(text_of(a, a->sfc->ref[first_a + i].name),
			       text_of(b, b->sfc->ref[first_b + i].name)) != 0)
			return false;
	return count_a == count_b;
}

static bool same_side(const struct plain *a, int i, const struct plain *b, int k, bool to)
{
	const struct sfc_transition *x = way_of(a, i), *y = way_of(b, k);

	return to ? same_names(a, x->first_to, x->to_count, b, y->first_to, y->to_count) :
		    same_names(a, x->first_from, x->from_count, b, y->first_from,
			       y->from_count);
}

enum likeness { ALL, BOTH_SIDES, SAME_FROM, SAME_TO, LIKENESSES };

static bool is_like(const struct plain *a, int i, const struct plain *b, int k,
		    enum likeness likeness)
{
	if (is_step(a, i) != is_step(b, k))
		return false;
	if (likeness == ALL)
		return strcmp(a->text[i], b->text[k]) == 0;
	if (is_step(a, i))
		return strcasecmp(text_of(a, a->sfc->step[i].name),
				  text_of(b, b->sfc->step[k].name)) == 0;
	return (likeness == SAME_TO || same_side(a, i, b, k, false)) &&
	       (likeness == SAME_FROM || same_side(a, i, b, k, true));
}

/* The likest first; each has one at most. */
static void match(struct plain *a, struct plain *b)
{
	for (int likeness = ALL; likeness < LIKENESSES; likeness++)
		for (int i = 0; i < box_count(a); i++)
			for (int k = 0; k < box_count(b) && a->like[i] < 0; k++) {
				if (b->like[k] >= 0 ||
				    !is_like(a, i, b, k, (enum likeness)likeness))
					continue;
				a->like[i] = k;
				b->like[k] = i;
				a->same[i] = b->same[k] = likeness == ALL;
			}
}

/* ---- lines of steps ---- */

static char *action_text(struct plain *plain, int use)
{
	const int action = plain->sfc->use[use].action;

	return action < 0 ? NULL :
	       print(plain, (struct sfc_piece){ PIECE_ACTION, action }, 1);
}

/* What such a line calls counts, too. */
static bool same_action(struct plain *a, int i, struct plain *b, int k)
{
	char *x = action_text(a, i), *y = action_text(b, k);
	const char *body_x = x ? strchr(x, '\n') : "", *body_y = y ? strchr(y, '\n') : "";
	const bool same = body_x && body_y && strcmp(body_x, body_y) == 0;

	free(x);
	free(y);
	return same;
}

static bool same_use(struct plain *a, int i, struct plain *b, int k)
{
	return strcmp(a->sheet->what[i], b->sheet->what[k]) == 0 &&
	       strcmp(a->sheet->does[i], b->sheet->does[k]) == 0 &&
	       strcmp(a->sheet->use_comment[i], b->sheet->use_comment[k]) == 0 &&
	       same_action(a, i, b, k);
}

static void mark_uses(struct plain *own, int step, struct plain *other, GArray *marks)
{
	const struct sfc_step *s = &own->sfc->step[step];
	const struct sfc_step *o = &other->sfc->step[own->like[step]];

	for (int i = s->first_use; i < s->first_use + s->use_count; i++) {
		const struct sfc_mark mark = { step, i, SFC_CHANGED };
		bool same = false;

		for (int k = o->first_use; k < o->first_use + o->use_count && !same; k++)
			same = same_use(own, i, other, k);
		if (!same)
			g_array_append_val(marks, mark);
	}
}

static void mark_all(struct plain *own, struct plain *other, unsigned int alone,
		     GArray *marks)
{
	for (int i = 0; i < box_count(own); i++) {
		const struct sfc_mark mark = { i, -1, own->like[i] < 0 ? alone : SFC_CHANGED };

		if (!own->same[i])
			g_array_append_val(marks, mark);
		if (is_step(own, i) && own->like[i] >= 0)
			mark_uses(own, i, other, marks);
	}
}

void render_diff_marks(const struct sfc_sheet *before, const struct sfc_sheet *after,
		       GArray *removed, GArray *added)
{
	struct plain *a = g_new0(struct plain, 1), *b = g_new0(struct plain, 1);

	start(a, before);
	start(b, after);
	match(a, b);
	mark_all(a, b, SFC_REMOVED, removed);
	mark_all(b, a, SFC_ADDED, added);
	end(a);
	end(b);
	g_free(a);
	g_free(b);
}
