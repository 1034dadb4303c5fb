/* SPDX-License-Identifier: MIT
 *
 * grid_view_edit - the verbs that change the rungs of a sheet, and the clipboard.
 *
 * A verb acts on the selected rungs, or on that of the cursor: grid_edit makes new ones, which
 * the document gets as one named step. A refusal is shown at the cursor.
 *
 * The clipboard holds text of a rung file (rung_clip.h), for text editors and other windows. A
 * rung with outputs is pasted as a new rung; a part without outputs, and outputs alone, into
 * the circuit.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/document/rung_clip.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/draw/print.h"
#include "editor-gtk/edit/entry_duplicate.h"
#include "editor-gtk/kit/diag_said.h"

#include <stdlib.h>
#include <string.h>

/* ---- whole rungs ---- */

/* Selects rungs; the cursor keeps its end of the selection. */
static void select_rungs(LadderGridView *view, int first, int last)
{
	const bool down = view->cursor.at.rung >= view->cursor.anchor.rung;
	struct grid_cursor from = { down ? first : last, 0, 0 };
	struct grid_cursor to = { down ? last : first, view->cursor.at.row, view->cursor.at.col };

	if (first == last) {
		cursor_set(view, to, false);
		return;
	}
	cursor_set(view, from, false);
	cursor_set(view, to, true);
}

static bool splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		   int inserted, enum verb verb)
{
	bool good;

	ladder_document_begin(view->canvas->document, _(verb_row(verb)->label), NULL);
	good = sheet_splice(view, at, removed, rungs, inserted, NULL);
	ladder_document_end(view->canvas->document);
	return good;
}

static void do_new(LadderGridView *view, enum verb verb)
{
	int first, last, at;
	struct rung *rung;

	cursor_rungs(view, &first, &last);
	at = MIN(verb == VERB_rung_below ? last + 1 : first, sheet_rungs(view));
	if (!sheet_pou(view))
		return;
	rung = rung_new(1, 1);
	if (splice(view, at, 0, &rung, 1, verb))
		cursor_set(view, (struct grid_cursor){ at, 0, 0 }, false);
}

/* Deleting all rungs leaves an empty one as a place to type. */
static void delete_rungs(LadderGridView *view)
{
	struct rung *left = NULL;
	int first, last;

	cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	if (last - first + 1 == sheet_rungs(view))
		left = rung_new(1, 1);
	if (splice(view, first, last - first + 1, &left, left ? 1 : 0,
		   VERB_rung_delete))
		cursor_set(view, (struct grid_cursor){ first, 0, 0 }, false);
}

/* ---- duplicates ---- */

/* Copies, since the ids and rows of a project end when it is read again. */
struct instance {
	char *name, *type;
	bool retain;
};

static struct instance *instances_new(struct project *project,
				      const struct entry_instance *made, int count)
{
	struct instance *instances = g_new0(struct instance, count + 1);

	for (int i = 0; i < count; i++)
		instances[i] = (struct instance){
			g_strdup(project_text(project, made[i].to)),
			g_strdup(words_row(&project->words, made[i].word)->word),
			made[i].retain,
		};
	return instances;
}

static void instances_free(struct instance *instances)
{
	for (int i = 0; instances[i].name; i++) {
		g_free(instances[i].name);
		g_free(instances[i].type);
	}
	g_free(instances);
}

static void declare_instance(LadderGridView *view, const struct instance *one)
{
	const char *const text[SYMBOL_FIELDS] = {
		one->name, one->type, "", "", "1", "", "",
	};

	if (one->retain)
		symbol_add(view->canvas->document, view->canvas->pou + 1, 0, text, NULL);
	else
		ladder_document_declare(view->canvas->document, view->canvas->pou, one->name, one->type, "",
					NULL);
}

/* Declares all; returns the message about it. Caller: g_free. */
static char *declare_all(LadderGridView *view, const struct instance *instances)
{
	GString *told = g_string_new(NULL);

	for (const struct instance *one = instances; one->name; one++) {
		declare_instance(view, one);
		g_string_append_printf(told, "%s%s : %s%s", told->len ? "; " : "", one->name,
				       one->type, one->retain ? " RETAIN" : "");
	}
	return g_string_free(told, FALSE);
}

/* @rungs: taken over. */
static void put_twice(LadderGridView *view, int at, struct rung **rungs, int count,
		      const struct instance *instances)
{
	char *told = NULL;

	ladder_document_begin(view->canvas->document, _(verb_row(VERB_rung_duplicate)->label), NULL);
	if (sheet_splice(view, at, 0, rungs, count, NULL)) {
		told = declare_all(view, instances);
		select_rungs(view, at, at + count - 1);
		if (told && *told)
			canvas_tell(LADDER_CANVAS(view), told);
	}
	ladder_document_end(view->canvas->document);
	g_free(told);
}

/* The copies get new instances: two rungs must not share a timer. */
static void do_duplicate(LadderGridView *view)
{
	const struct entry_place place = {
		.project = ladder_document_project(view->canvas->document), .pou = view->canvas->pou,
	};
	struct entry_instance *made;
	struct rung **copies;
	int first, last, count;
	struct instance *instances;

	cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	copies = g_new(struct rung *, last - first + 1);
	for (int i = first; i <= last; i++)
		copies[i - first] = sheet_rung(view, i);
	if (entry_duplicate(&place, copies, last - first + 1, &made, &count)) {
		for (int i = 0; i <= last - first; i++)
			copies[i]->label = 0; /* a label is unique */
		instances = instances_new(place.project, made, count);
		put_twice(view, last + 1, copies, last - first + 1, instances);
		instances_free(instances);
		free(made);
	}
	g_free(copies);
}

/* ---- moving ---- */

/* In the body of a chart the contents of the rungs change places. */
static bool move_in_body(LadderGridView *view, int from, int to)
{
	const int least = MIN(from, to), count = MAX(from, to) - least + 1;
	struct rung **rungs = g_new(struct rung *, count);
	bool good;

	for (int i = 0, at = least; i < count; i++) {
		if (least + i == to) {
			rungs[i] = rung_copy(sheet_rung(view, from));
			continue;
		}
		at += at == from;
		rungs[i] = rung_copy(sheet_rung(view, at++));
	}
	ladder_document_begin(view->canvas->document, _("Move rung"), NULL);
	good = sheet_splice(view, least, count, rungs, count, NULL);
	ladder_document_end(view->canvas->document);
	g_free(rungs);
	return good;
}

bool rungs_move(LadderGridView *view, int first, int last, int before)
{
	const int count = last - first + 1, down = before > last;
	bool good = before < first || before > last + 1;

	if (!good)
		return false;
	ladder_document_begin(view->canvas->document, _("Move rung"), NULL);
	for (int i = 0; good && i < count; i++)
		good = down ? ladder_document_move_rung(view->canvas->document, view->canvas->pou, first,
							before - 1) :
			      ladder_document_move_rung(view->canvas->document, view->canvas->pou, last,
							before);
	ladder_document_end(view->canvas->document);
	first = down ? before - count : before;
	if (count > 1)
		select_rungs(view, first, first + count - 1);
	else
		cursor_set(view, (struct grid_cursor){ first, view->cursor.at.row,
						       view->cursor.at.col }, false);
	return good;
}

/* Moves the rung above or below the selection to its other side. */
static void do_move(LadderGridView *view, int by)
{
	const struct grid_cursor cursor = view->cursor.at;
	int first, last, from, to;
	bool several, good;

	several = cursor_rungs(view, &first, &last);
	from = by < 0 ? first - 1 : last + 1;
	to = by < 0 ? last : first;
	if (from < 0 || from >= sheet_rungs(view))
		return;
	good = view->count >= 0 ? move_in_body(view, from, to) :
	       ladder_document_move_rung(view->canvas->document, view->canvas->pou, from, to);
	if (good && several)
		select_rungs(view, first + by, last + by);
	else if (good)
		cursor_set(view, (struct grid_cursor){ cursor.rung + by, cursor.row,
						       cursor.col }, false);
}

/* Switches all selected rungs off, or on if the first one is off. */
static void do_off(LadderGridView *view)
{
	const struct grid_cursor cursor = view->cursor.at, anchor = view->cursor.anchor;
	struct rung **rungs;
	int first, last;
	bool several, off;

	several = cursor_rungs(view, &first, &last);
	if (last >= sheet_rungs(view))
		return;
	rungs = g_new(struct rung *, last - first + 1);
	off = !sheet_rung(view, first)->off;
	for (int i = first; i <= last; i++) {
		rungs[i - first] = rung_copy(sheet_rung(view, i));
		rungs[i - first]->off = off;
	}
	if (splice(view, first, last - first + 1, rungs, last - first + 1, VERB_rung_off)) {
		if (several)
			cursor_set(view, anchor, false);
		cursor_set(view, cursor, several);
	}
	g_free(rungs);
}

/* ---- selecting ---- */

static bool is_all(LadderGridView *view)
{
	struct grid_area area;
	int first, last;

	if (cursor_rungs(view, &first, &last))
		return true;
	return cursor_area(view, &area) && area.row == 0 && area.col == 0 &&
	       area.last_row == sheet_rung(view, first)->rows - 1 &&
	       area.last_col == view->columns - 1;
}

/* Selects the rung; if it is selected already, all rungs. */
static void do_select_all(LadderGridView *view)
{
	const bool all = sheet_rung(view, view->cursor.at.rung) && is_all(view);
	const int first = all ? 0 : view->cursor.at.rung;
	const int last = all ? sheet_rungs(view) - 1 : first;
	const struct rung *rung = sheet_rung(view, last);

	if (!rung)
		return;
	cursor_set(view, (struct grid_cursor){ first, 0, 0 }, false);
	cursor_set(view, (struct grid_cursor){ last, rung->rows - 1, view->columns - 1 },
		   true);
}

/* ---- one rung ---- */

/* A wire in the empty cell at the cursor; elsewhere every element gets its wire. */
static struct rung *wire_here(const struct rung *rung, struct grid_at *at)
{
	const bool gap = at->row < rung->rows && at->col < rung->cols &&
			 rung_at(rung, at->row, at->col)->word == ELEM_EMPTY;

	return gap ? grid_wire(rung, at, GRID_RIGHT) : grid_close_gaps(rung, at);
}

static void do_edit(LadderGridView *view,
		    struct rung *(*edit)(const struct rung *rung, struct grid_at *at),
		    enum verb verb)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);

	if (rung)
		sheet_put(view, edit(rung, &at), &at, _(verb_row(verb)->label));
}

static void do_wire(LadderGridView *view, enum grid_way way, enum verb verb)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);

	if (rung)
		sheet_put(view, grid_wire(rung, &at, way), &at, _(verb_row(verb)->label));
}

static void do_delete(LadderGridView *view)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);
	struct grid_area area;
	struct rung *edited;
	int first, last;

	if (!rung)
		return;
	if (cursor_rungs(view, &first, &last)) {
		delete_rungs(view);
		return;
	}
	edited = cursor_area(view, &area) ? grid_delete_area(rung, &at, &area) :
		 grid_delete(rung, &at);
	sheet_put(view, edited, &at, _(verb_row(VERB_delete)->label));
}

/* ---- copying ---- */

static bool is_whole(LadderGridView *view, const struct grid_area *area)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);

	return area->row == 0 && area->col == 0 && area->last_row == rung->rows - 1 &&
	       area->last_col == view->columns - 1;
}

/* Copies of the selection; an empty array: there are no elements in it. */
static GPtrArray *chosen(LadderGridView *view)
{
	GPtrArray *rungs = g_ptr_array_new_with_free_func((GDestroyNotify)rung_free);
	struct grid_area area;
	struct rung *part;
	int first, last;

	if (cursor_rungs(view, &first, &last)) {
		for (int i = first; i <= last; i++)
			g_ptr_array_add(rungs, rung_copy(sheet_rung(view, i)));
		return rungs;
	}
	cursor_area(view, &area);
	part = is_whole(view, &area) ? rung_copy(sheet_rung(view, first)) :
	       grid_copy(sheet_rung(view, first), view->columns, &area);
	if (part)
		g_ptr_array_add(rungs, part);
	return rungs;
}

static void do_copy(LadderGridView *view)
{
	GPtrArray *rungs;
	char *text;

	if (!sheet_rung(view, view->cursor.at.rung))
		return;
	rungs = chosen(view);
	text = rungs->len ? rung_clip_text(view->canvas->document, view->canvas->pou,
					   (struct rung *const *)rungs->pdata,
					   (int)rungs->len) : NULL;
	if (text)
		gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(view)), text);
	else
		canvas_tell(LADDER_CANVAS(view), _("There is nothing to copy here."));
	g_free(text);
	g_ptr_array_unref(rungs);
}

/* ---- pasting ---- */

/* Is it a whole rung? It has a circuit with outputs, or a title, label or comment. */
static bool is_rung(const struct rung *rung)
{
	if (rung->title || rung->label || rung->comment)
		return true;
	for (int row = 0; row < rung->rows; row++)
		if (grid_display_output(rung, row) >= 0)
			return !grid_is_outputs(rung);
	return false;
}

static bool is_blank(const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY)
			return false;
	return !rung->title && !rung->label && !rung->comment;
}

static void tell_too_many(LadderGridView *view)
{
	char *said = diag_said_of(DIAG_TOO_MANY, "rungs" DIAG_AND G_STRINGIFY(LIMIT_RUNGS));

	canvas_tell(LADDER_CANVAS(view), said);
	g_free(said);
}

/* Declares the variables that the pasted rungs use and this project lacks. @at: a
 * rung of the sheet. */
static void declare(LadderGridView *view, const struct rung_clip *clip, int at, int count)
{
	char *told = rung_clip_declare(clip, view->canvas->document, view->canvas->pou,
				       view->first + at, count);

	if (told)
		canvas_tell(LADDER_CANVAS(view), told);
	g_free(told);
}

static void paste_whole(LadderGridView *view, struct rung_clip *clip)
{
	const struct rung *here = sheet_rung(view, view->cursor.at.rung);
	const int removed = here && is_blank(here), count = clip->count;
	const int at = view->cursor.at.rung + (here && !removed);
	struct rung **rungs = rung_clip_take(clip);

	ladder_document_begin(view->canvas->document, _(verb_row(VERB_paste)->label), NULL);
	if (sheet_splice(view, at, removed, rungs, count, NULL)) {
		cursor_set(view, (struct grid_cursor){ at + count - 1, 0, 0 }, false);
		declare(view, clip, at, count);
	} else if (sheet_pou(view)->rung_count - removed + count > LIMIT_RUNGS) {
		tell_too_many(view);
	}
	ladder_document_end(view->canvas->document);
	g_free(rungs);
}

static void paste_part(LadderGridView *view, const struct rung_clip *clip, bool parallel)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	const char *name = _(verb_row(VERB_paste)->label);
	struct grid_at at = sheet_at(view);

	if (!rung)
		return;
	ladder_document_begin(view->canvas->document, name, NULL);
	if (sheet_put(view, grid_paste(rung, &at, clip->rung[0], parallel), &at, name))
		declare(view, clip, view->cursor.at.rung, 1);
	ladder_document_end(view->canvas->document);
}

static void paste_text(LadderGridView *view, const char *text, gsize len, bool parallel)
{
	struct rung_clip *clip;
	char *why;

	if (!sheet_pou(view))
		return;
	clip = rung_clip_read(view->canvas->document, view->canvas->pou, text, len, &why);
	if (!clip)
		canvas_tell(LADDER_CANVAS(view), why);
	else if (clip->count > 1 || (is_rung(clip->rung[0]) && !parallel))
		paste_whole(view, clip);
	else
		paste_part(view, clip, parallel);
	rung_clip_free(clip);
	g_free(why);
}

/* ---- reading the clipboard ---- */

struct paste {
	LadderGridView *view;
	bool parallel;
	GInputStream *stream;
	GByteArray *bytes;
};

/* Bytes to read: one more than a rung file may have. */
#define READ_MOST (LIMIT_TEXT + 1)
#define READ_AT_ONCE 65536

static void paste_end(struct paste *paste)
{
	g_clear_object(&paste->stream);
	g_byte_array_unref(paste->bytes);
	g_object_unref(paste->view);
	g_free(paste);
}

static void take_bytes(GObject *stream, GAsyncResult *result, gpointer data)
{
	struct paste *paste = data;
	GBytes *bytes = g_input_stream_read_bytes_finish(G_INPUT_STREAM(stream), result,
							 NULL);
	const gsize len = bytes ? g_bytes_get_size(bytes) : 0;
	const gsize room = READ_MOST - paste->bytes->len;

	if (len > 0)
		g_byte_array_append(paste->bytes, g_bytes_get_data(bytes, NULL),
				    (guint)MIN(len, room));
	if (len > 0 && len < room) {
		g_input_stream_read_bytes_async(paste->stream, READ_AT_ONCE,
						G_PRIORITY_DEFAULT, NULL, take_bytes, paste);
	} else {
		if (!bytes)
			canvas_tell(LADDER_CANVAS(paste->view), _("The clipboard holds no text."));
		else
			paste_text(paste->view, paste->bytes->len ?
				   (const char *)paste->bytes->data : "",
				   paste->bytes->len, paste->parallel);
		paste_end(paste);
	}
	if (bytes)
		g_bytes_unref(bytes);
}

static void take_stream(GObject *clipboard, GAsyncResult *result, gpointer data)
{
	struct paste *paste = data;

	paste->stream = gdk_clipboard_read_finish(GDK_CLIPBOARD(clipboard), result, NULL,
						  NULL);
	if (paste->stream) {
		g_input_stream_read_bytes_async(paste->stream, READ_AT_ONCE,
						G_PRIORITY_DEFAULT, NULL, take_bytes, paste);
		return;
	}
	canvas_tell(LADDER_CANVAS(paste->view), _("The clipboard holds no text."));
	paste_end(paste);
}

static void do_paste(LadderGridView *view, bool parallel)
{
	static const char *types[] = { "text/plain;charset=utf-8", "text/plain", NULL };
	struct paste *paste = g_new0(struct paste, 1);

	paste->view = g_object_ref(view);
	paste->parallel = parallel;
	paste->bytes = g_byte_array_new();
	gdk_clipboard_read_async(gtk_widget_get_clipboard(GTK_WIDGET(view)), types,
				 G_PRIORITY_DEFAULT, NULL, take_stream, paste);
}

static void do_cut(LadderGridView *view)
{
	do_copy(view);
	ladder_document_begin(view->canvas->document, _(verb_row(VERB_cut)->label), NULL);
	do_delete(view);
	ladder_document_end(view->canvas->document);
}

/* ---- pictures ---- */

static void do_copy_picture(LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	struct sheet *sheet = sheet_pou(view) ?
		sheet_new(project, sheet_pou(view), view->canvas->lettering) : NULL;
	GdkContentProvider *picture;

	if (!sheet)
		return;
	sheet->drafting.show = view->drafting.show;
	sheet_layout(sheet);
	picture = print_rung_picture(sheet, view->cursor.at.rung,
				     theme_get(THEME_LIGHT, THEME_GREEN), 2);
	if (picture) {
		gdk_clipboard_set_content(gtk_widget_get_clipboard(GTK_WIDGET(view)),
					  picture);
		g_object_unref(picture);
		canvas_tell(LADDER_CANVAS(view), _("The clipboard holds the rung as a picture."));
	}
	sheet_free(sheet);
}

/* ---- the table ---- */

/* The verbs for whole rungs and the clipboard. */
static bool do_rungs(LadderGridView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_cut: do_cut(view); return true;
	case VERB_copy: do_copy(view); return true;
	case VERB_paste: do_paste(view, false); return true;
	case VERB_paste_parallel: do_paste(view, true); return true;
	case VERB_copy_picture: do_copy_picture(view); return true;
	case VERB_rung_below: case VERB_rung_above: do_new(view, verb); return true;
	case VERB_rung_delete: delete_rungs(view); return true;
	case VERB_rung_duplicate: do_duplicate(view); return true;
	case VERB_rung_up: do_move(view, -1); return true;
	case VERB_rung_down: do_move(view, 1); return true;
	case VERB_rung_off: do_off(view); return true;
	case VERB_select_all: do_select_all(view); return true;
	default: return false;
	}
}

bool edit_do(LadderGridView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_delete: do_delete(view); return true;
	case VERB_cycle: do_edit(view, grid_cycle, verb); return true;
	case VERB_wire_left: do_wire(view, GRID_LEFT, verb); return true;
	case VERB_wire_right: do_wire(view, GRID_RIGHT, verb); return true;
	case VERB_wire_up: do_wire(view, GRID_UP, verb); return true;
	case VERB_wire_down: do_wire(view, GRID_DOWN, verb); return true;
	case VERB_wire_here: do_edit(view, wire_here, verb); return true;
	case VERB_link_here: do_edit(view, grid_open_branch, verb); return true;
	case VERB_insert_column: do_edit(view, grid_insert_column, verb); return true;
	case VERB_delete_column: do_edit(view, grid_delete_column, verb); return true;
	case VERB_insert_row: do_edit(view, grid_insert_row, verb); return true;
	case VERB_delete_row: do_edit(view, grid_delete_row, verb); return true;
	default: return do_rungs(view, verb);
	}
}
