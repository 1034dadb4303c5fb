/* SPDX-License-Identifier: MIT
 *
 * grid_view_clipboard - cells, branches and rungs as text of a rung file.
 *
 * So they can be pasted into a text editor and from one, and from window to window. A
 * rung with outputs is pasted as a rung of its own, what has none into the circuit.
 */
#include "editor-gtk/grid_view_inside.h"

#include "editor-gtk/diag_said.h"

#include <stdlib.h>
#include <string.h>

#define PASTE_MOST (LIMIT_RUNGS + 1) /* one is too much for any POU: it is told */

/* ---- copying ---- */

static bool is_whole(LadderGridView *view, const struct grid_area *area)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);

	return area->row == 0 && area->col == 0 && area->last_row == rung->rows - 1 &&
	       area->last_col == view->columns - 1;
}

static void do_copy(LadderGridView *view)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_area area;
	struct rung *part;
	char *text;

	if (!rung)
		return;
	cursor_area(view, &area);
	part = is_whole(view, &area) ? rung_copy(rung) :
	       grid_copy(rung, view->columns, &area);
	text = part ? ladder_write_rung(ladder_document_ladder(view->document), part) :
	       NULL;
	if (text)
		gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(view)), text);
	else
		sheet_tell(view, _("nothing stands here"));
	free(text);
	rung_free(part);
}

/* ---- pasting ---- */

static bool has_output(const struct rung *rung)
{
	for (int row = 0; row < rung->rows; row++)
		if (grid_display_output(rung, row) >= 0)
			return true;
	return rung->title || rung->label || rung->comment;
}

static bool is_blank(const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY)
			return false;
	return !rung->title && !rung->label && !rung->comment;
}

/* Where the next rung begins: its RUNG at the beginning of a line. */
static const char *next_rung(const char *text)
{
	for (const char *at = strchr(text, '\n'); at; at = strchr(at + 1, '\n'))
		if (g_ascii_strncasecmp(at + 1, "RUNG", 4) == 0 &&
		    !g_ascii_isalnum(at[5]))
			return at + 1;
	return text + strlen(text);
}

/* The rungs of the text, up to the first that is none; why that is not. */
static int read_rungs(LadderGridView *view, const char *text, struct rung **rungs,
		      struct diag_list *why)
{
	struct ladder *ladder = ladder_document_ladder(view->document);
	int count = 0;

	diag_init(why);
	/* A comment above the first one belongs to it. */
	for (const char *end = text; *text && count < PASTE_MOST; text = end) {
		end = next_rung(text);
		rungs[count] = ladder_read_rung(ladder, text, (size_t)(end - text), why);
		if (!rungs[count])
			break;
		count++;
	}
	return count;
}

static void tell_too_many(LadderGridView *view)
{
	const struct diag diag = { .id = DIAG_TOO_MANY };

	sheet_tell(view, diag_said(&diag));
}

static void paste_whole(LadderGridView *view, struct rung **rungs, int count)
{
	const struct rung *here = sheet_rung(view, view->cursor.rung);
	const int removed = here && is_blank(here);
	const int at = view->cursor.rung + (here && !removed);

	ladder_document_begin(view->document, _(verb_row(VERB_paste)->label), NULL);
	if (sheet_splice(view, at, removed, rungs, count, NULL))
		cursor_set(view, (struct grid_cursor){ at + count - 1, 0, 0 }, false);
	else if (sheet_pou(view)->rung_count - removed + count > LIMIT_RUNGS)
		tell_too_many(view);
	ladder_document_end(view->document);
}

static void paste_part(LadderGridView *view, const struct rung *part, bool parallel)
{
	const struct rung *rung = sheet_rung(view, view->cursor.rung);
	struct grid_at at = sheet_at(view);

	if (rung)
		sheet_put(view, grid_paste(rung, &at, part, parallel), &at,
			  _(verb_row(VERB_paste)->label));
}

static void paste_text(LadderGridView *view, const char *text, bool parallel)
{
	struct rung **rungs;
	struct diag_list why;
	int count;

	if (!sheet_pou(view) || !text)
		return;
	rungs = g_new0(struct rung *, PASTE_MOST);
	count = read_rungs(view, text, rungs, &why);
	if (why.errors || count == 0) {
		sheet_tell(view, _("The clipboard holds no rungs."));
		for (int i = 0; i < count; i++)
			rung_free(rungs[i]);
	} else if (count > 1 || (has_output(rungs[0]) && !parallel)) {
		paste_whole(view, rungs, count);
	} else {
		paste_part(view, rungs[0], parallel);
		rung_free(rungs[0]);
	}
	g_free(rungs);
}

struct paste {
	LadderGridView *view;
	bool parallel;
};

static void pasted(GObject *clipboard, GAsyncResult *result, gpointer data)
{
	struct paste *paste = data;
	char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result,
						    NULL);

	if (!text)
		sheet_tell(paste->view, _("The clipboard holds no text."));
	else
		paste_text(paste->view, text, paste->parallel);
	g_free(text);
	g_object_unref(paste->view);
	g_free(paste);
}

static void do_paste(LadderGridView *view, bool parallel)
{
	struct paste *paste = g_new0(struct paste, 1);

	paste->view = g_object_ref(view);
	paste->parallel = parallel;
	gdk_clipboard_read_text_async(gtk_widget_get_clipboard(GTK_WIDGET(view)), NULL,
				      pasted, paste);
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
