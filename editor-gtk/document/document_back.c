/* SPDX-License-Identifier: MIT
 *
 * document_back - gives a rung back as it was at a place in the history, with what its
 * edits declared.
 *
 * It undoes their steps, one after another, and is a step itself, which can be undone.
 */
#include "editor-gtk/document/document_inside.h"

guint64 ladder_document_place(LadderDocument *document)
{
	return history_place(document->history);
}

bool ladder_document_knows_place(LadderDocument *document, guint64 place)
{
	return history_since(document->history, place) >= 0;
}

enum relation {
	STEP_EDIT,  /* of that rung, and of declarations with it               */
	STEP_ASIDE, /* of nothing that it could meet                           */
	STEP_OTHER,
};

static enum relation relation_of(const struct step *step, int pou, int rung)
{
	bool edits = false, declares = false;

	for (guint i = 0; i < step->change->len; i++) {
		const struct change *change = step->change->pdata[i];

		switch (change->kind) {
		case CHANGE_RUNGS:
			if (change->pou != pou || change->at != (gsize)rung ||
			    change->before->len != 1 || change->after->len != 1)
				return STEP_OTHER;
			edits = true;
			break;
		case CHANGE_TEXT:
		case CHANGE_VARIABLE:
			declares = true;
			break;
		case CHANGE_LIST:
			return STEP_OTHER;
		case CHANGE_VIEW:
		case CHANGE_FILE:
			break;
		}
	}
	return edits ? STEP_EDIT : declares ? STEP_OTHER : STEP_ASIDE;
}

/* Steps since the rung was as it was at the place: then, or when it was given back last. */
static int steps_since(LadderDocument *document, guint64 place)
{
	const int count = history_since(document->history, place);

	for (int i = 0; i < count; i++) {
		const struct step *step = history_done(document->history, i);

		if (step->is_back && step->back_to == place)
			return i;
	}
	return count;
}

/* What the last @count steps are: edits of the rung, and nothing that stands on them? */
static enum back judge(LadderDocument *document, int pou, int rung, int count)
{
	enum back back = BACK_NOTHING;
	bool other = false;

	for (int i = 0; i < count; i++) {
		const enum relation relation = relation_of(history_done(document->history, i),
							   pou, rung);

		if (relation == STEP_EDIT)
			back = BACK_DONE;
		other = other || relation == STEP_OTHER;
	}
	return back == BACK_DONE && other ? BACK_OTHER : back;
}

static void take_back(LadderDocument *document, const struct step *step)
{
	for (guint i = step->change->len; i-- > 0;) {
		const struct change *change = step->change->pdata[i];

		document_record(document, change_new(change->kind, change->pou, change->at,
						     g_ptr_array_ref(change->after),
						     g_ptr_array_ref(change->before)));
	}
}

enum back ladder_document_give_back(LadderDocument *document, int pou, int rung,
				    guint64 place, const char *name)
{
	const int count = steps_since(document, place);
	const enum back back = judge(document, pou, rung, count);

	if (back != BACK_DONE)
		return back;
	ladder_document_begin(document, name, NULL);
	history_goes_back(document->history, place);
	for (int i = 0; i < count; i++) {
		const struct step *step = history_done(document->history, i);

		if (relation_of(step, pou, rung) == STEP_EDIT)
			take_back(document, step);
	}
	ladder_document_end(document);
	return back;
}
