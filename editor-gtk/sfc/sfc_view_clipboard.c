/* SPDX-License-Identifier: MIT
 *
 * sfc_view_clipboard - copying is to write a chart without what is not selected; pasting
 * is to read one, to give its steps names of their own, and to put its pieces into this one.
 */
#include "editor-gtk/sfc/sfc_view_clipboard.h"
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/document/rung_clip.h"

#include <stdlib.h>
#include <string.h>

/* ---- copying ---- */

static bool is_chosen(LadderSfcView *view, int shape)
{
	bool any = false;

	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		any |= view->selected[i];
	return any ? view->selected[shape] : shape == view->cursor.shape;
}

/* A transition goes with the steps that it leaves: its condition is theirs, and where it
 * led is found again where it comes to. */
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
	switch (piece->kind) {
	case PIECE_STEP:
	case PIECE_MACRO_END:
		return is_chosen(view, piece->index);
	case PIECE_TRANSITION:
		return is_left(view, sfc, piece->index);
	case PIECE_ACTION:
	case PIECE_CONTROL:
	default:
		return false;
	}
}

/* The chart, with the declarations of what it names: globals before it, its own in it.
 * Caller: g_free. */
static char *with_declarations(LadderSfcView *view, const char *chart)
{
	GString *globals = g_string_new(NULL), *locals = g_string_new(NULL);
	const char *body = strchr(chart, '\n');

	rung_clip_blocks(view->document, view->pou, chart, globals, locals);
	g_string_append_len(globals, chart, body + 1 - chart);
	g_string_append_printf(globals, "%s%s", locals->str, body + 1);
	g_string_free(locals, TRUE);
	return g_string_free(globals, FALSE);
}

void chart_copy(LadderSfcView *view)
{
	struct sfc_edit *edit = chart_edit(view);
	int kept = 0, inside = -1;
	char *text, *whole;

	if (!edit)
		return;
	for (int i = 0; i < edit->sfc.piece_count; i++) {
		const struct sfc_piece piece = edit->sfc.piece[i];
		const bool macro = piece.kind == PIECE_STEP &&
				   edit->sfc.step[piece.index].kind == STEP_MACRO;

		/* What stands in a macro-step goes with it. */
		if (inside >= 0 || is_kept(view, chart_pou(view)->sfc, &piece))
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
		chart_tell(view, _("nothing stands here"));
	g_free(whole);
	free(text);
	sfc_edit_free(edit);
}

/* ---- pasting ---- */

static bool is_taken(const struct sfc_edit *here, const char *name)
{
	for (int i = 0; i < here->sfc.step_count; i++)
		if (g_ascii_strcasecmp(project_text(here->project, here->sfc.step[i].name),
				       name) == 0)
			return true;
	return false;
}

/* Has it a step to begin with? One that was cut is it again when it comes back. */
static bool begins(const struct sfc_edit *edit)
{
	for (int i = 0; i < edit->sfc.step_count; i++)
		if (edit->sfc.step[i].kind == STEP_INITIAL && edit->sfc.step[i].macro < 0)
			return true;
	return false;
}

/* Names that neither chart has. */
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

/* What stands between its first line and its last one. */
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

/* What its names are and nobody knows here comes along. @told: gets what came; NULL: nothing
 * did. Caller: g_free. */
static bool put_pieces(LadderSfcView *view, const char *pieces, LadderDocument *source,
		       char **told)
{
	const struct rung_clip clip = { .source = source };
	struct end_of_pou end = { .pou = view->pou };
	gsize len;
	char *whole = ladder_document_outline(view->document, &len, take_end, &end), *with;
	bool good;

	with = g_strdup_printf("\n%s", pieces);
	good = whole && ladder_document_replace(view->document, end.span.at + end.span.len,
						0, with, NULL);
	*told = good ? rung_clip_declare(&clip, view->document, view->pou, -1,
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

/* A whole chart, or pieces alone: then a chart is made of them. */
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

/* Its pieces, by names that no step has here; NULL: it is none. Caller: g_free. */
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

/* They stand behind the chart; now they come to what was at the cursor. @told: of them. */
static void insert(LadderSfcView *view, const struct sfc_edit *before, enum sfc_part part,
		   int index, const char *told)
{
	struct sfc_edit *edit;
	const char *why;
	char *all;
	int made;

	chart_fresh(view);
	edit = chart_edit(view);
	if (!edit)
		return;
	made = sfc_edit_insert(edit, before->sfc.step_count, before->sfc.transition_count,
			       part == SFC_STEP ? index : -1,
			       part == SFC_TRANSITION ? index : -1);
	why = made >= 0 && edit->why ? _(edit->why) : "";
	all = g_strdup_printf("%s%s%s", told ? told : "", told && *why ? " · " : "", why);
	if (*all)
		chart_tell(view, all);
	g_free(all);
	chart_put(view, edit, made >= 0, _(verb_row(VERB_paste)->label), PIECE_STEP, made);
}

static void paste_text(LadderSfcView *view, const char *text)
{
	LadderDocument *source = text ? read_chart(text) : NULL;
	struct sfc_edit *here = source ? chart_edit(view) : NULL;
	char *pieces = here ? pieces_for(here, source) : NULL, *told = NULL;
	enum sfc_part part;
	int index;

	part = here ? chart_part_here(view, &index) : SFC_NOTHING;
	ladder_document_begin(view->document, _(verb_row(VERB_paste)->label), NULL);
	if (!pieces || !put_pieces(view, pieces, source, &told))
		chart_tell(view, _("The clipboard holds no steps."));
	else
		insert(view, here, part, index, told);
	ladder_document_end(view->document);
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

void chart_paste(LadderSfcView *view)
{
	gdk_clipboard_read_text_async(gtk_widget_get_clipboard(GTK_WIDGET(view)), NULL,
				      pasted, g_object_ref(view));
}
