/* SPDX-License-Identifier: MIT
 *
 * grid_view_edit - what the verbs of a sheet do to its rungs.
 *
 * Each takes the cursor's rung, has grid_edit make another of it, and gives that to the
 * document as one named step. What is refused is told in the status bar.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/draw/print.h"

#include <stdlib.h>
#include <string.h>

/* ---- whose rungs they are ---- */

LadderDocument *ladder_grid_view_document(LadderGridView *view)
{
	return view->document;
}

bool sheet_is_fixed(LadderGridView *view)
{
	if (!ladder_document_is_fixed(view->document))
		return false;
	sheet_tell(view, _("This is the program before an edit: it can be looked at, not "
			   "changed"));
	return true;
}

/* ---- one rung becomes another ---- */

struct grid_at sheet_at(LadderGridView *view)
{
	return (struct grid_at){ .columns = view->columns, .row = view->cursor.row,
				 .col = view->cursor.col };
}

static void tell_diags(LadderGridView *view, const struct diag_list *why)
{
	char *text;

	text = why->count ? diag_said_whole(&why->diag[0]) :
	       g_strdup(_("A file cannot hold this"));
	sheet_tell(view, text);
	g_free(text);
}

bool sheet_put(LadderGridView *view, struct rung *rung, const struct grid_at *at,
	       const char *name)
{
	struct diag_list why;
	bool good;

	if (!rung) {
		sheet_tell(view, _(grid_refusal_text(at->refusal)));
		return false;
	}
	diag_init(&why);
	cursor_remember(view);
	ladder_document_begin(view->document, name, NULL);
	good = sheet_splice(view, view->cursor.rung, 1, &rung, 1, &why);
	ladder_document_end(view->document);
	if (!good) {
		tell_diags(view, &why);
		return false;
	}
	sheet_tell(view, "");
	cursor_set(view, (struct grid_cursor){ view->cursor.rung, at->row, at->col },
		   false);
	return true;
}

static void do_edit(LadderGridView *view,
		    struct rung *(*edit)(const struct rung *rung, struct grid_at *at),
		    enum verb verb)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);

	if (rung)
		sheet_put(view, edit(rung, &at), &at, _(verb_row(verb)->label));
}

static void do_wire(LadderGridView *view, enum grid_way way, enum verb verb)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);

	if (rung)
		sheet_put(view, grid_wire(rung, &at, way), &at, _(verb_row(verb)->label));
}

/* Where nothing is, its key begins what shall be: `/Stop`. */
static void do_negate(LadderGridView *view)
{
	struct project *project = ladder_document_project(view->document);
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);

	if (rung && !cursor_cell(view, NULL, NULL))
		entry_begin(view, "/");
	else if (rung)
		sheet_put(view, grid_negate(rung, &at, project, sheet_pou(view)), &at,
			  _(verb_row(VERB_negate)->label));
}

static void do_delete(LadderGridView *view)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);
	struct grid_area area;
	struct rung *edited;
	int first, last;

	if (!rung)
		return;
	if (cursor_rungs(view, &first, &last)) {
		rungs_do(view, VERB_rung_delete);
		return;
	}
	edited = cursor_area(view, &area) ? grid_delete_area(rung, &at, &area) :
		 grid_delete(rung, &at);
	sheet_put(view, edited, &at, _(verb_row(VERB_delete)->label));
}

static void do_cut(LadderGridView *view)
{
	clipboard_do(view, VERB_copy);
	ladder_document_begin(view->document, _(verb_row(VERB_cut)->label), NULL);
	do_delete(view);
	ladder_document_end(view->document);
}

/* ---- giving up ---- */

static void give_back(LadderGridView *view)
{
	if (view->came_rung != view->cursor.rung)
		return;
	if (ladder_document_give_back(view->document, view->pou,
				      view->first + view->cursor.rung, view->came,
				      _(verb_row(VERB_cancel)->label)) == BACK_OTHER)
		sheet_tell(view, _("other things were changed since, too: Undo takes them "
				   "back, one by one"));
}

/* Esc: a stroke or the entry goes first, then what was done to this rung since the cursor came. */
bool ladder_grid_view_has_begun(LadderGridView *view)
{
	return view->wire.drawing || view->entry || view->preview || view->selecting;
}

static void do_cancel(LadderGridView *view)
{
	view->given_up = true;
	edge_forget(view);
	if (view->wire.drawing)
		wire_forget(view);
	else if (view->entry || view->preview)
		entry_close(view);
	else if (view->selecting)
		cursor_set(view, view->cursor, false);
	else
		give_back(view);
}

/* ---- elements ---- */

/* With an operand, or of a word that needs none. */
void sheet_place(LadderGridView *view, struct cell cell, bool parallel)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);
	struct grid_area area;
	const bool chosen = cursor_area(view, &area);
	struct rung *edited;

	if (!rung)
		return;
	edited = parallel ? grid_parallel(rung, &at, chosen ? &area : NULL, cell) :
		 grid_place(rung, &at, cell, GRID_REPLACE);
	sheet_put(view, edited, &at, parallel ? _("Add in parallel") : _("Add element"));
}

void ladder_grid_view_put(LadderGridView *view, enum word word)
{
	gtk_widget_grab_focus(GTK_WIDGET(view)); /* before a line opens, which takes it  */
	entry_begin_word(view, word, false);
}

/* ---- pictures ---- */

static void do_copy_picture(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->document);
	struct sheet *sheet = sheet_pou(view) ?
		sheet_new(project, sheet_pou(view), view->lettering) : NULL;
	GdkContentProvider *picture;

	if (!sheet)
		return;
	sheet->drafting.show = view->drafting.show;
	sheet_layout(sheet);
	picture = print_rung_picture(sheet, view->cursor.rung,
				     theme_get(THEME_LIGHT, THEME_GREEN), 2);
	if (picture) {
		gdk_clipboard_set_content(gtk_widget_get_clipboard(GTK_WIDGET(view)),
					  picture);
		g_object_unref(picture);
		sheet_tell(view, _("The clipboard holds the rung as a picture."));
	}
	sheet_free(sheet);
}

/* ---- the table ---- */

static bool changes(enum verb verb)
{
	return verb != VERB_copy && verb != VERB_copy_picture && verb != VERB_select_all &&
	       verb != VERB_cancel;
}

void ladder_grid_view_do(LadderGridView *view, enum verb verb)
{
	if ((changes(verb) && sheet_is_fixed(view)) || act_do(view, verb))
		return;
	switch ((int)verb) {
	case VERB_cut:
		do_cut(view);
		break;
	case VERB_copy: case VERB_paste: case VERB_paste_parallel:
		clipboard_do(view, verb);
		break;
	case VERB_copy_picture: do_copy_picture(view); break;
	case VERB_delete: do_delete(view); break;
	case VERB_context_menu: mouse_menu(view); break;
	case VERB_enter: case VERB_edit_operand: entry_begin_edit(view); break;
	case VERB_contact: entry_begin_word(view, ELEM_CONTACT_NO, false); break;
	case VERB_contact_not: entry_begin_word(view, ELEM_CONTACT_NC, false); break;
	case VERB_coil: entry_begin_word(view, ELEM_COIL, false); break;
	case VERB_block: entry_begin(view, ""); break;
	case VERB_parallel: entry_begin_word(view, ELEM_CONTACT_NO, true); break;
	case VERB_parallel_not: entry_begin_word(view, ELEM_CONTACT_NC, true); break;
	case VERB_negate: do_negate(view); break;
	case VERB_cycle: do_edit(view, grid_cycle, verb); break;
	case VERB_wire_left: do_wire(view, GRID_LEFT, verb); break;
	case VERB_wire_right: do_wire(view, GRID_RIGHT, verb); break;
	case VERB_wire_up: do_wire(view, GRID_UP, verb); break;
	case VERB_wire_down: do_wire(view, GRID_DOWN, verb); break;
	case VERB_wire_here: do_edit(view, grid_close_gaps, verb); break;
	case VERB_link_here: do_edit(view, grid_open_branch, verb); break;
	case VERB_insert_column: do_edit(view, grid_insert_column, verb); break;
	case VERB_delete_column: do_edit(view, grid_delete_column, verb); break;
	case VERB_insert_row: do_edit(view, grid_insert_row, verb); break;
	case VERB_delete_row: do_edit(view, grid_delete_row, verb); break;
	case VERB_add_pin: case VERB_comment: case VERB_rung_title:
	case VERB_rung_label: case VERB_rung_comment:
		entry_begin_text(view, verb);
		break;
	case VERB_rung_below: case VERB_rung_above: case VERB_rung_delete:
	case VERB_rung_duplicate: case VERB_rung_up: case VERB_rung_down:
	case VERB_rung_off: case VERB_select_all:
		rungs_do(view, verb);
		break;
	case VERB_bookmark:
		ladder_document_toggle_bookmark(view->document, view->pou,
						view->first + view->cursor.rung);
		break;
	case VERB_cancel: do_cancel(view); break;
	default: break;
	}
}
