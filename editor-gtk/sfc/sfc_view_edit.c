/* SPDX-License-Identifier: MIT
 *
 * sfc_view_edit - the verbs that change a chart, and the clipboard.
 *
 * Copy writes a chart that holds only the selection. Paste reads one, gives its steps unused
 * names, and puts its pieces into this chart.
 */
#include "editor-gtk/document/rung_clip.h"
#include "editor-gtk/sfc/sfc_view_inside.h"
#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

/* ---- an edit becomes a change of the document ---- */

/* Replaces only the lines that differ. */
static bool exchange(LadderSfcView *view, const char *text)
{
	struct text_span span;
	gsize start = 0, end = 0;
	char *whole = ladder_document_pou(view->canvas->document, view->canvas->pou, &span), *with;
	const char *old = whole + span.at;
	const gsize new_len = strlen(text), old_len = span.len;
	struct diag_list why;
	bool good;

	while (start < old_len && start < new_len && old[start] == text[start])
		start++;
	while (start > 0 && old[start - 1] != '\n')
		start--;
	while (end < old_len - start && end < new_len - start &&
	       old[old_len - 1 - end] == text[new_len - 1 - end])
		end++;
	while (end > 0 && old[old_len - end - 1] != '\n')
		end--;
	with = g_strndup(text + start, new_len - start - end);
	diag_init(&why);
	good = (old_len - start - end == 0 && !with[0]) ||
	       ladder_document_replace(view->canvas->document, span.at + start,
				       old_len - start - end, with, &why);
	if (!good)
		canvas_tell(LADDER_CANVAS(view), _("A rung file cannot hold this."));
	g_free(with);
	g_free(whole);
	return good;
}

/* The number of a piece after the file is read again. */
static int rank_of(const struct sfc_edit *edit, enum piece_kind kind, int index)
{
	int rank = 0;

	for (int i = 0; i < edit->sfc.piece_count; i++) {
		if (edit->sfc.piece[i].kind != kind)
			continue;
		if (edit->sfc.piece[i].index == index)
			return rank;
		rank++;
	}
	return -1;
}

static void go_rank(LadderSfcView *view, enum piece_kind kind, int rank)
{
	const struct pou *pou = sfc_pou(view);

	if (!pou || rank < 0 || !view->sheet)
		return;
	sfc_go(view, (struct sfc_at){ kind == PIECE_STEP ? rank :
					pou->sfc->step_count + rank, -1, false }, false);
}

struct sfc_edit *sfc_edit_begin(LadderSfcView *view)
{
	struct pou *pou = sfc_pou(view);

	return pou ? sfc_edit_new(ladder_document_project(view->canvas->document), pou) : NULL;
}

bool sfc_put(LadderSfcView *view, struct sfc_edit *edit, bool good, const char *name,
	       enum piece_kind kind, int index)
{
	const int rank = good && index >= 0 ? rank_of(edit, kind, index) : -1;
	char *text = good ? sfc_edit_text(edit) : NULL;

	if (edit && !good)
		canvas_tell(LADDER_CANVAS(view), edit->why ? _(edit->why) : "");
	sfc_edit_free(edit);
	if (!text)
		return false;
	ladder_document_begin(view->canvas->document, name, NULL);
	good = exchange(view, text);
	ladder_document_end(view->canvas->document);
	free(text);
	if (good)
		go_rank(view, kind, rank);
	return good;
}

/* ---- structure ---- */

/* Puts the edit; the cursor moves to the new step. */
static void put_step(LadderSfcView *view, struct sfc_edit *edit, int step, enum verb verb)
{
	sfc_put(view, edit, step >= 0, _(verb_row(verb)->label), PIECE_STEP, step);
}

static void step_below(LadderSfcView *view)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	enum sfc_part part;
	int index;

	if (!edit)
		return;
	part = sfc_part_here(view, &index);
	put_step(view, edit, part == SFC_STEP ? sfc_edit_step_below(edit, index) :
		 part == SFC_TRANSITION ? sfc_edit_step_after(edit, index) :
		 sfc_edit_first(edit, -1), VERB_step_below);
}

bool sfc_new_way(LadderSfcView *view)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	int index, made = -1, way;
	enum sfc_part part;

	if (!edit)
		return false;
	part = sfc_part_here(view, &index);
	way = edit->sfc.transition_count; /* the number of the next one */
	if (part == SFC_NOTHING)
		edit->why = N_("Select a step first.");
	else
		made = part == SFC_STEP ? sfc_edit_step_below(edit, index) :
		       sfc_edit_step_after(edit, index);
	return sfc_put(view, edit, made >= 0, _(verb_row(VERB_step_below)->label),
		       PIECE_TRANSITION, way);
}

static void branch(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	struct sfc_edit *edit = sfc_edit_begin(view);
	int index, made = -1;
	enum sfc_part part;

	if (!edit)
		return;
	part = sfc_part_here(view, &index);
	/* Beside a transition: another way out of its step. */
	if (part == SFC_TRANSITION && pou->sfc->transition[index].from_count > 0)
		index = pou->sfc->ref[pou->sfc->transition[index].first_from].step;
	else if (part != SFC_STEP)
		index = -1;
	if (index >= 0)
		made = sfc_edit_branch(edit, index);
	else
		edit->why = N_("Select a step: a branch begins there.");
	put_step(view, edit, made, VERB_step_branch);
}

/* The transition that leads to a step; -1: none. */
static int way_to(const struct sfc *sfc, int step)
{
	for (int t = 0; t < sfc->transition_count; t++)
		for (int i = 0; i < sfc->transition[t].to_count; i++)
			if (sfc->ref[sfc->transition[t].first_to + i].step == step)
				return t;
	return -1;
}

static void parallel(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	struct sfc_edit *edit = sfc_edit_begin(view);
	int index, made = -1;
	enum sfc_part part;

	if (!edit)
		return;
	part = sfc_part_here(view, &index);
	if (part == SFC_STEP)
		index = way_to(pou->sfc, index);
	if (index >= 0)
		made = sfc_edit_parallel(edit, index);
	else
		edit->why = N_("Select a transition, or a step that a transition leads to.");
	put_step(view, edit, made, VERB_step_parallel);
}

static void move(LadderSfcView *view, bool right)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	int index;
	enum sfc_part part;
	bool good;

	if (!edit)
		return;
	part = sfc_part_here(view, &index);
	if (part == SFC_NOTHING) {
		sfc_edit_free(edit);
		return;
	}
	good = sfc_edit_move(edit, part == SFC_STEP ? index : -1,
			     part == SFC_TRANSITION ? index : -1, right);
	sfc_put(view, edit, good, _("Move branch"), part == SFC_STEP ? PIECE_STEP :
		  PIECE_TRANSITION, index);
}

void sfc_lead(LadderSfcView *view, struct sfc_at from, struct sfc_at to)
{
	const struct sfc_layout *layout = view->sheet->layout;
	const struct sfc_shape *a = &layout->shape[from.shape];
	const struct sfc_shape *b = &layout->shape[to.shape];
	struct sfc_edit *edit = sfc_edit_begin(view);
	int made = -1;
	bool good = false;

	if (!edit)
		return;
	if (a->part == SFC_STEP && b->part == SFC_STEP) {
		made = sfc_edit_lead(edit, a->index, b->index);
		good = made >= 0;
	} else if (a->part == SFC_STEP && b->part == SFC_TRANSITION) {
		made = b->index;
		good = sfc_edit_wait(edit, b->index, a->index);
	} else if (a->part == SFC_TRANSITION && b->part == SFC_STEP) {
		made = a->index;
		good = sfc_edit_set_ways(edit, a->index, true, project_text(
			view->sheet->project, layout->sfc->step[b->index].name));
	} else {
		edit->why = N_("Draw from a step or a transition to a step.");
	}
	sfc_put(view, edit, good, _("Draw a way"), PIECE_TRANSITION, made);
}

/* ---- deleting ---- */

/* The step before a transition; -1: none. */
static int step_of(const struct sfc *sfc, int transition)
{
	return transition >= 0 && sfc->transition[transition].from_count > 0 ?
	       sfc->ref[sfc->transition[transition].first_from].step : -1;
}

/* The nearest step before the cursor that stays: the cursor moves there. -1: none. */
static int step_before(LadderSfcView *view, const struct sfc *sfc, enum sfc_part part,
		       int index)
{
	const int first = part == SFC_STEP ? index : -1;
	int step = part == SFC_STEP ? step_of(sfc, way_to(sfc, index)) :
		   part == SFC_TRANSITION ? step_of(sfc, index) : -1;

	for (int i = 0; i < sfc->step_count && step >= 0 && view->selected[step]; i++)
		step = step_of(sfc, way_to(sfc, step));
	return step == first || (step >= 0 && view->selected[step]) ? -1 : step;
}

static bool delete_jump(LadderSfcView *view, struct sfc_edit *edit, int index)
{
	const struct sfc_jump *jump = &view->sheet->layout->jump[index];

	return sfc_edit_cut_way(edit, jump->to_transition ? jump->target : jump->from,
				jump->ref);
}

static bool delete_shape(LadderSfcView *view, struct sfc_edit *edit, int number)
{
	const struct sfc_shape *shape = &view->sheet->layout->shape[number];

	if (shape->part == SFC_STEP)
		return sfc_edit_delete_step(edit, shape->index);
	if (shape->part == SFC_JUMP)
		return delete_jump(view, edit, shape->index);
	/* A deleted step may have taken the transition with it. */
	sfc_edit_delete_transition(edit, shape->index);
	return shape->part == SFC_TRANSITION;
}

static bool delete_selected(LadderSfcView *view, struct sfc_edit *edit, bool *any)
{
	const struct sfc_layout *layout = view->sheet->layout;
	const int boxes = layout->sfc->step_count + layout->sfc->transition_count;
	bool good = true;

	*any = false;
	for (int i = 0; i < boxes; i++)
		if (view->selected[i]) {
			*any = true;
			good = delete_shape(view, edit, i) && good;
		}
	return good;
}

static void delete(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	struct sfc_edit *edit;
	int index, next;
	enum sfc_part part;
	bool good, any;

	if (!pou || view->cursor.shape < 0)
		return;
	edit = sfc_edit_begin(view);
	part = sfc_part_at_cursor(view, &index);
	next = step_before(view, pou->sfc, part, index);
	good = delete_selected(view, edit, &any);
	if (!any && view->cursor.use >= 0) {
		next = index;
		good = sfc_edit_delete_use(edit, view->cursor.use);
	} else if (!any) {
		good = delete_shape(view, edit, view->cursor.shape);
	}
	sfc_put(view, edit, good, _(verb_row(VERB_delete)->label), PIECE_STEP, next);
}

/* ---- kinds ---- */

static void change_kind(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	struct sfc_edit *edit;
	int index;

	if (sfc_part_at_cursor(view, &index) != SFC_STEP)
		return;
	edit = sfc_edit_begin(view);
	sfc_put(view, edit, sfc_edit_set_kind(edit, index,
			pou->sfc->step[index].kind == STEP_INITIAL ? STEP_PLAIN :
			STEP_INITIAL), _(verb_row(VERB_step_kind)->label), PIECE_STEP, index);
}

/* ---- macro-steps ---- */

/* Makes a macro-step of the selected steps, or of the step at the cursor if none is selected. */
static void macro_make(LadderSfcView *view)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	const int count = edit ? edit->sfc.step_count : 0;
	bool *chosen = g_new0(bool, count + 1), any = false;
	int index, made;

	for (int i = 0; i < count; i++)
		any |= chosen[i] = view->selected[i];
	if (!any && sfc_part_at_cursor(view, &index) == SFC_STEP)
		chosen[index] = true;
	made = edit ? sfc_edit_macro_make(edit, chosen) : -1;
	sfc_put(view, edit, made >= 0, _(verb_row(VERB_macro_make)->label), PIECE_STEP,
		  made);
	g_free(chosen);
}

static void macro_open(LadderSfcView *view)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	const int macro = sfc_macro_here(view);
	int made = -1;

	if (edit && macro < 0)
		edit->why = N_("This is not a macro-step.");
	if (edit && macro >= 0)
		made = sfc_edit_macro_open(edit, macro);
	sfc_put(view, edit, made >= 0, _(verb_row(VERB_macro_open)->label), PIECE_STEP,
		  made);
}

/* Makes a rung of a condition that is an expression, and shows it. */
static void as_rung(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	const int use = view->cursor.use;
	struct sfc_edit *edit;
	int index;
	const enum sfc_part part = sfc_part_here(view, &index);

	if (part == SFC_TRANSITION) {
		edit = sfc_edit_begin(view);
		if (sfc_put(view, edit, sfc_edit_as_rung(edit, index),
			      _(verb_row(VERB_as_rung)->label), PIECE_TRANSITION, index) &&
		    sfc_part_at_cursor(view, &index) == SFC_TRANSITION)
			sfc_want_body(view,
				&sfc_pou(view)->sfc->transition[index].condition);
	} else if (part == SFC_STEP && use >= 0 && pou->sfc->use[use].action >= 0) {
		sfc_want_body(view, &pou->sfc->action[pou->sfc->use[use].action].body);
	} else if (part == SFC_STEP) {
		canvas_tell(LADDER_CANVAS(view), _("Select a condition or an action first."));
	}
}

/* ---- copying ---- */

static bool is_chosen(LadderSfcView *view, int shape)
{
	bool any = false;

	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		any |= view->selected[i];
	return any ? view->selected[shape] : shape == view->cursor.shape;
}

/* A transition is copied with the steps before it; sfc_edit_insert() adds a step behind it. */
static bool is_left(LadderSfcView *view, const struct sfc *sfc, int transition)
{
	const struct sfc_transition *t = &sfc->transition[transition];

	if (is_chosen(view, sfc->step_count + transition))
		return true;
	for (int i = t->first_from; i < t->first_from + t->from_count; i++)
		if (sfc->ref[i].step < 0 || !is_chosen(view, sfc->ref[i].step))
			return false;
	return t->from_count > 0;
}

static bool is_kept(LadderSfcView *view, const struct sfc *sfc, const struct sfc_piece *piece)
{
	return piece->kind == PIECE_STEP || piece->kind == PIECE_MACRO_END ?
	       is_chosen(view, piece->index) :
	       piece->kind == PIECE_TRANSITION && is_left(view, sfc, piece->index);
}

/* The chart with the declarations of its names: globals before it, others in it.
 * Caller: g_free. */
static char *with_declarations(LadderSfcView *view, const char *chart)
{
	GString *globals = g_string_new(NULL), *locals = g_string_new(NULL);
	const char *body = strchr(chart, '\n');

	rung_clip_blocks(view->canvas->document, view->canvas->pou, chart, globals, locals);
	g_string_append_len(globals, chart, body + 1 - chart);
	g_string_append_printf(globals, "%s%s", locals->str, body + 1);
	g_string_free(locals, TRUE);
	return g_string_free(globals, FALSE);
}

static void copy(LadderSfcView *view)
{
	struct sfc_edit *edit = sfc_edit_begin(view);
	int kept = 0, inside = -1;
	char *text, *whole;

	if (!edit)
		return;
	for (int i = 0; i < edit->sfc.piece_count; i++) {
		const struct sfc_piece piece = edit->sfc.piece[i];
		const bool macro = piece.kind == PIECE_STEP &&
				   edit->sfc.step[piece.index].kind == STEP_MACRO;

		/* A macro-step is copied with its content. */
		if (inside >= 0 || is_kept(view, sfc_pou(view)->sfc, &piece))
			edit->sfc.piece[kept++] = piece;
		else
			continue;
		if (macro && inside < 0)
			inside = piece.index;
		else if (piece.kind == PIECE_MACRO_END && piece.index == inside)
			inside = -1;
	}
	edit->sfc.piece_count = kept;
	edit->pou.vars.block_count = 0;
	text = kept ? sfc_edit_text(edit) : NULL;
	whole = text ? with_declarations(view, text) : NULL;
	if (whole)
		gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(view)), whole);
	else
		canvas_tell(LADDER_CANVAS(view), _("There is nothing to copy here."));
	g_free(whole);
	free(text);
	sfc_edit_free(edit);
}

/* ---- pasting ---- */

static bool is_taken(const struct sfc_edit *here, const char *name)
{
	for (int i = 0; i < here->sfc.step_count; i++)
		if (name_equal(project_text(here->project, here->sfc.step[i].name), name))
			return true;
	return false;
}

/* Has the chart an initial step? If not, a pasted initial step stays one. */
static bool begins(const struct sfc_edit *edit)
{
	for (int i = 0; i < edit->sfc.step_count; i++)
		if (edit->sfc.step[i].kind == STEP_INITIAL && edit->sfc.step[i].macro < 0)
			return true;
	return false;
}

/* Gives the steps of @other names that neither chart has. */
static void rename_steps(struct sfc_edit *here, struct sfc_edit *other)
{
	for (int i = 0; i < other->sfc.step_count; i++) {
		const char *old = project_text(other->project, other->sfc.step[i].name);
		char *name = g_strdup(old);

		for (int k = 2; is_taken(here, name) ||
		     (strcmp(name, old) != 0 && is_taken(other, name)); k++) {
			g_free(name);
			name = g_strdup_printf("%s_%d", old, k);
		}
		if (strcmp(name, old) != 0)
			sfc_edit_name_step(other, i, name);
		g_free(name);
	}
	for (int i = 0; i < other->sfc.transition_count; i++)
		sfc_edit_name_transition(other, i, "");
	for (int i = 0; i < other->sfc.step_count; i++)
		if (other->sfc.step[i].kind == STEP_INITIAL &&
		    other->sfc.step[i].macro < 0 && begins(here))
			other->sfc.step[i].kind = STEP_PLAIN;
}

/* The text between the first and the last line of a chart. */
static char *pieces_of(const struct sfc_edit *edit)
{
	char *text = sfc_edit_text(edit);
	const char *from = text ? strchr(text, '\n') : NULL;
	const char *to = text ? g_strrstr(text, "END_PROGRAM") : NULL;
	char *pieces = from && to ? g_strndup(from + 1, (gsize)(to - from - 1)) : NULL;

	free(text);
	return pieces;
}

struct end_of_pou { int pou; struct text_span span; };

static void take_end(void *context, const struct text_span *span)
{
	struct end_of_pou *end = context;

	if (span->part == TEXT_BODY && span->pou == end->pou)
		end->span = *span;
}

/* Declares the variables that this project lacks. @told: the message about them;
 * NULL: none. Caller: g_free. */
static bool put_pieces(LadderSfcView *view, const char *pieces, LadderDocument *source,
		       char **told)
{
	const struct rung_clip clip = { .source = source };
	struct end_of_pou end = { .pou = view->canvas->pou };
	gsize len;
	char *whole = ladder_document_outline(view->canvas->document, &len, take_end, &end);
	char *with = g_strdup_printf("\n%s", pieces);
	const bool good = whole && ladder_document_replace(view->canvas->document, end.span.at +
							   end.span.len, 0, with, NULL);

	*told = good ? rung_clip_declare(&clip, view->canvas->document, view->canvas->pou, -1,
					 LIMIT_RUNGS + 1) : NULL;
	g_free(with);
	g_free(whole);
	return good;
}

static bool holds_chart(LadderDocument *source)
{
	const struct project *project = ladder_document_project(source);

	return project && project->pou_count == 1 && project->pou[0].sfc &&
	       project->pou[0].sfc->step_count + project->pou[0].sfc->transition_count > 0;
}

/* @text: a chart, or only pieces, which get a chart around them. */
static LadderDocument *read_chart(const char *text)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	LadderDocument *source = NULL;

	for (int try = 0; try < 2 && !source; try++) {
		char *body = try ? g_strdup_printf("PROGRAM Copy SFC\n%s\nEND_PROGRAM\n", text) :
				   g_strdup(text);

		source = rung_clip_source(body, diags);
		if (source && !holds_chart(source))
			g_clear_object(&source);
		g_free(body);
	}
	g_free(diags);
	return source;
}

/* The pieces of the chart in @source, with names unused in @here; NULL: no chart. Caller:
 * g_free. */
static char *pieces_for(struct sfc_edit *here, LadderDocument *source)
{
	struct project *project = ladder_document_project(source);
	struct sfc_edit *other = sfc_edit_new(project, &project->pou[0]);
	char *pieces;

	if (!other)
		return NULL;
	other->pou.vars.block_count = 0;
	rename_steps(here, other);
	pieces = pieces_of(other);
	sfc_edit_free(other);
	return pieces;
}

/* Moves the pasted pieces from the end of the chart to the cursor. @told: message so
 * far. */
static void insert_pieces(LadderSfcView *view, const struct sfc_edit *before, enum sfc_part part,
		   int index, const char *told)
{
	struct sfc_edit *edit;
	const char *why;
	char *all;
	int made;

	sfc_fresh(view);
	edit = sfc_edit_begin(view);
	if (!edit)
		return;
	made = sfc_edit_insert(edit, before->sfc.step_count, before->sfc.transition_count,
			       part == SFC_STEP ? index : -1,
			       part == SFC_TRANSITION ? index : -1);
	why = made >= 0 && edit->why ? _(edit->why) : "";
	all = g_strdup_printf("%s%s%s", told ? told : "", told && *why ? " · " : "", why);
	if (*all)
		canvas_tell(LADDER_CANVAS(view), all);
	g_free(all);
	sfc_put(view, edit, made >= 0, _(verb_row(VERB_paste)->label), PIECE_STEP, made);
}

static void paste_text(LadderSfcView *view, const char *text)
{
	LadderDocument *source = text ? read_chart(text) : NULL;
	struct sfc_edit *here = source ? sfc_edit_begin(view) : NULL;
	char *pieces = here ? pieces_for(here, source) : NULL, *told = NULL;
	enum sfc_part part;
	int index;

	part = here ? sfc_part_here(view, &index) : SFC_NOTHING;
	ladder_document_begin(view->canvas->document, _(verb_row(VERB_paste)->label), NULL);
	if (!pieces || !put_pieces(view, pieces, source, &told))
		canvas_tell(LADDER_CANVAS(view), _("The clipboard holds no steps."));
	else
		insert_pieces(view, here, part, index, told);
	ladder_document_end(view->canvas->document);
	g_free(told);
	g_free(pieces);
	sfc_edit_free(here);
	g_clear_object(&source);
}

static void pasted(GObject *clipboard, GAsyncResult *result, gpointer data)
{
	LadderSfcView *view = data;
	char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);

	paste_text(view, text);
	g_free(text);
	g_object_unref(view);
}

static void paste(LadderSfcView *view)
{
	gdk_clipboard_read_text_async(gtk_widget_get_clipboard(GTK_WIDGET(view)), NULL,
				      pasted, g_object_ref(view));
}

/* ---- the table ---- */

static void cut(LadderSfcView *view)
{
	copy(view);
	ladder_document_begin(view->canvas->document, _(verb_row(VERB_cut)->label), NULL);
	delete(view);
	ladder_document_end(view->canvas->document);
}

bool sfc_edit_do(LadderSfcView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_step_below: step_below(view); return true;
	case VERB_step_branch: branch(view); return true;
	case VERB_step_parallel: parallel(view); return true;
	case VERB_branch_left: move(view, false); return true;
	case VERB_branch_right: move(view, true); return true;
	case VERB_step_kind: change_kind(view); return true;
	case VERB_as_rung: as_rung(view); return true;
	case VERB_macro_make: macro_make(view); return true;
	case VERB_macro_open: macro_open(view); return true;
	case VERB_delete: delete(view); return true;
	case VERB_cut: cut(view); return true;
	case VERB_copy: copy(view); return true;
	case VERB_paste: paste(view); return true;
	default: return false;
	}
}
