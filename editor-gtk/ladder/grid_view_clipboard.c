/* SPDX-License-Identifier: MIT
 *
 * grid_view_clipboard - cells, branches and rungs as text of a rung file (rung_clip.h).
 *
 * So they can be pasted into a text editor and from one, and from window to window. A
 * rung with outputs is pasted as a rung of its own, what has none, and outputs alone, into
 * the circuit.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/document/rung_clip.h"

#include <stdlib.h>
#include <string.h>

/* ---- copying ---- */

static bool is_whole(LadderGridView *view, const struct grid_area *area)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);

	return area->row == 0 && area->col == 0 && area->last_row == rung->rows - 1 &&
	       area->last_col == view->columns - 1;
}

/* Copies of what is selected; none: nothing stands there. */
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

	if (!sheet_rung(view, view->cursor.rung))
		return;
	rungs = chosen(view);
	text = rungs->len ? rung_clip_text(view->document, view->pou,
					   (struct rung *const *)rungs->pdata,
					   (int)rungs->len) : NULL;
	if (text)
		gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(view)), text);
	else
		sheet_tell(view, _("nothing stands here"));
	g_free(text);
	g_ptr_array_unref(rungs);
}

/* ---- pasting ---- */

/* With what leads there, or a title: a rung, not a part of one. */
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
	const struct diag diag = { .id = DIAG_TOO_MANY };

	sheet_tell(view, diag_said(&diag));
}

/* What they use and nobody knows here comes along: @at is of the sheet. */
static void declare(LadderGridView *view, const struct rung_clip *clip, int at, int count)
{
	char *told = rung_clip_declare(clip, view->document, view->pou, view->first + at,
				       count);

	if (told)
		sheet_tell(view, told);
	g_free(told);
}

static void paste_whole(LadderGridView *view, struct rung_clip *clip)
{
	const struct rung *here = sheet_rung(view, view->cursor.rung);
	const int removed = here && is_blank(here), count = clip->count;
	const int at = view->cursor.rung + (here && !removed);
	struct rung **rungs = rung_clip_take(clip);

	ladder_document_begin(view->document, _(verb_row(VERB_paste)->label), NULL);
	if (sheet_splice(view, at, removed, rungs, count, NULL)) {
		cursor_set(view, (struct grid_cursor){ at + count - 1, 0, 0 }, false);
		declare(view, clip, at, count);
	} else if (sheet_pou(view)->rung_count - removed + count > LIMIT_RUNGS) {
		tell_too_many(view);
	}
	ladder_document_end(view->document);
	g_free(rungs);
}

static void paste_part(LadderGridView *view, const struct rung_clip *clip, bool parallel)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	const char *name = _(verb_row(VERB_paste)->label);
	struct grid_at at = sheet_at(view);

	if (!rung)
		return;
	ladder_document_begin(view->document, name, NULL);
	if (sheet_put(view, grid_paste(rung, &at, clip->rung[0], parallel), &at, name))
		declare(view, clip, view->cursor.rung, 1);
	ladder_document_end(view->document);
}

static void paste_text(LadderGridView *view, const char *text, gsize len, bool parallel)
{
	struct rung_clip *clip;
	char *why;

	if (!sheet_pou(view))
		return;
	clip = rung_clip_read(view->document, view->pou, text, len, &why);
	if (!clip)
		sheet_tell(view, why);
	else if (clip->count > 1 || (is_rung(clip->rung[0]) && !parallel))
		paste_whole(view, clip);
	else
		paste_part(view, clip, parallel);
	rung_clip_free(clip);
	g_free(why);
}

/* ---- what the clipboard holds: bytes, until they were looked at ---- */

struct paste {
	LadderGridView *view;
	bool parallel;
	GInputStream *stream;
	GByteArray *bytes;
};

/* Whoever gives more than a file may have is not heard to the end. */
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
			sheet_tell(paste->view, _("The clipboard holds no text."));
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
	sheet_tell(paste->view, _("The clipboard holds no text."));
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

void clipboard_do(LadderGridView *view, enum verb verb)
{
	switch ((int)verb) {
	case VERB_copy:
		do_copy(view);
		break;
	default:
		do_paste(view, verb == VERB_paste_parallel);
		break;
	}
}
