/* SPDX-License-Identifier: MIT
 *
 * iomap_view_edit - what a person does to an I/O map in its table: each is one edit of the
 * text, and one step of its undo.
 */
#include "editor-gtk/iomap/iomap_view_inside.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/i18n.h"

#include <stdlib.h>
#include <string.h>

/* ---- the text ---- */

char *iomap_view_text(LadderIomapView *view)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(view->buffer, &start, &end);
	return gtk_text_buffer_get_text(view->buffer, &start, &end, TRUE);
}

static void iter_at(GtkTextBuffer *buffer, const char *text, size_t at, GtkTextIter *iter)
{
	gtk_text_buffer_get_iter_at_offset(buffer, iter,
					   (int)g_utf8_strlen(text, (gssize)at));
}

/* One step of the undo. @edit: its text is freed. */
static void apply(LadderIomapView *view, const char *text, struct io_edit *edit)
{
	GtkTextIter from, to;

	if (edit->removed || *edit->with) {
		gtk_text_buffer_begin_user_action(view->buffer);
		iter_at(view->buffer, text, edit->at, &from);
		iter_at(view->buffer, text, edit->at + edit->removed, &to);
		gtk_text_buffer_delete(view->buffer, &from, &to);
		gtk_text_buffer_insert(view->buffer, &from, edit->with, -1);
		gtk_text_buffer_end_user_action(view->buffer);
	}
	free(edit->with);
	edit->with = NULL;
}

static const char *refusal(enum io_refusal why)
{
	static const char *const text[] = {
		[IO_GOOD] = "", [IO_MANY_WORDS] = N_("It must be one word, without blanks"),
		[IO_NO_WORD] = N_("There is no such word"),
		[IO_BAD_OFFSET] = N_("The number of a line is too large"),
		[IO_BAD_NAME] = N_("No map can hold that name"),
		[IO_MEMORY] = N_("Out of memory"),
	};

	return _(text[why]);
}

/* What cannot be done is told below, until something can. */
void iomap_view_told(LadderIomapView *view, const char *text)
{
	g_free(view->refused);
	view->refused = text ? g_strdup(text) : NULL;
	panel_watch_later(view->watch);
	panel_watch_now(view->watch);
}

static bool done(LadderIomapView *view, const char *text, enum io_refusal why,
		 struct io_edit *edit)
{
	if (why == IO_GOOD)
		apply(view, text, edit);
	iomap_view_told(view, why == IO_GOOD ? NULL : refusal(why));
	return why == IO_GOOD;
}

/* ---- edits ---- */

/* The rows were made of an older text, perhaps. */
static bool is_same_row(const struct io_text *io, const LadderPanelRow *row)
{
	bool same = row->index < io->count;

	for (int i = 0; same && i < IO_FIELDS; i++) {
		char *text = iomap_field(io, row->index, (enum io_field)i);

		same = strcmp(text, panel_row_text(row, i)) == 0;
		g_free(text);
	}
	return same;
}

bool iomap_view_set_field(gpointer owner, const LadderPanelRow *row, enum io_field field,
		      const char *value, char **why)
{
	LadderIomapView *view = owner;
	char *text = iomap_view_text(view);
	enum io_refusal said = IO_NO_WORD;
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;
	bool good = false;

	if (!view->watch) {
		g_free(text);
		return false; /* it goes */
	}
	if (io_text_read(&io, text, strlen(text)) && is_same_row(&io, row)) {
		said = io_text_set(&io, row->index, field, value, &edit);
		good = said == IO_GOOD;
		*why = good ? NULL : g_strdup(refusal(said));
		if (good)
			apply(view, text, &edit);
	}
	io_text_free(&io);
	g_free(text);
	if (good || !*why)
		iomap_view_told(view, NULL);
	else {
		char *whole = g_strdup_printf("%s, %s: %s", panel_row_text(row, IO_ADDRESS),
					      io_field_name(field), *why);

		iomap_view_told(view, whole);
		g_free(whole);
	}
	return good;
}

static void set_board(LadderIomapView *view)
{
	const char *name = gtk_editable_get_text(GTK_EDITABLE(view->board));
	char *text = iomap_view_text(view), *board;
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	io_text_read(&io, text, strlen(text));
	board = io_text_board(&io);
	/* Nothing was shown yet, or it is as it was. */
	if (view->board_shown && g_strcmp0(view->board_shown, name) != 0 &&
	    g_strcmp0(board, name) != 0)
		done(view, text, io_text_set_board(&io, name, &edit), &edit);
	free(board);
	io_text_free(&io);
	g_free(text);
}

void iomap_view_board_activated(GtkEntry *entry, LadderIomapView *view)
{
	(void)entry;
	set_board(view);
}

void iomap_view_board_left(GtkEventControllerFocus *focus, LadderIomapView *view)
{
	(void)focus;
	set_board(view);
}

void ladder_iomap_view_commit(LadderIomapView *view)
{
	iomap_cells_commit(GTK_WIDGET(view->list.view));
	set_board(view);
}

/* ---- points come and go ---- */

/* The last row of the same area; -1: none. */
static int last_of(const struct io_text *io, enum iec_area area)
{
	int last = -1;

	for (int i = 0; i < io->count; i++) {
		const struct io_span *word = &io->row[i].word[IO_WORD_ADDRESS];
		struct iec_addr at;

		if (iec_addr_parse(io->text + word->at, word->len, &at) == ADDR_OK &&
		    at.area == area)
			last = i;
	}
	return last;
}

/* That of the others: a map is for a board or for a desk. */
static const char *driver_for(const LadderIomapView *view, const struct io_text *io)
{
	for (int i = 0; i < io->count; i++) {
		const struct io_span *word = &io->row[i].word[IO_WORD_DRIVER];
		const enum driver_id id = driver_find(io->text + word->at, word->len);

		if (id < DRIVER_COUNT)
			return driver_row(id)->word;
	}
	return view->machine.count ? "gpio" : "sim";
}

/* @behind: a row; -1: the last one of its area. */
static void add_point(LadderIomapView *view, struct iec_addr addr, const char *comment,
		      int behind)
{
	char *text = iomap_view_text(view), address[24];
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	iec_addr_print(addr, address, sizeof(address));
	io_text_read(&io, text, strlen(text));
	if (behind < 0 || behind >= io.count)
		behind = last_of(&io, addr.area);
	if (io_text_add(&io, behind, address, driver_for(view, &io), comment, &edit) ==
	    IO_GOOD)
		apply(view, text, &edit);
	io_text_free(&io);
	g_free(text);
}

static bool is_row(const LadderPanelRow *row, gconstpointer address)
{
	return strcmp(panel_row_text(row, IO_ADDRESS), address) == 0;
}

/* The first bit that is not in the map, of inputs or of outputs. */
static bool next_address(LadderIomapView *view, enum iec_area area, struct iec_addr *out)
{
	char *text = iomap_view_text(view);
	struct io_text io;
	bool found = false;

	io_text_read(&io, text, strlen(text));
	for (uint32_t bit = 0; !found && bit < iec_area_row(area)->usual * 8; bit++) {
		*out = (struct iec_addr){ area, 1, (uint8_t)(bit % 8), bit / 8 };
		found = !iomap_has(&io, *out);
	}
	io_text_free(&io);
	g_free(text);
	return found;
}

void iomap_view_add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);
	const bool output = row && g_ascii_strncasecmp(panel_row_text(row, IO_ADDRESS),
						       "%Q", 2) == 0;
	struct iec_addr addr;
	char text[24];

	(void)action;
	(void)unused;
	if (!next_address(view, output ? AREA_Q : AREA_I, &addr))
		return;
	add_point(view, addr, "", row ? row->index : -1);
	iomap_view_told(view, NULL);
	iec_addr_print(addr, text, sizeof(text));
	if (panel_list_select(&view->list, is_row, text))
		cells_enter(view->list.view, panel_list_row(&view->list), IO_ADDRESS);
}

void iomap_view_add_lacking(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	char *text = iomap_view_text(view);
	struct io_text io;

	(void)action;
	(void)unused;
	io_text_read(&io, text, strlen(text));
	gtk_text_buffer_begin_user_action(view->buffer);
	for (int i = 0; i < view->uses.count; i++)
		if (!iomap_has(&io, view->uses.use[i].addr))
			add_point(view, view->uses.use[i].addr, view->uses.use[i].name, -1);
	gtk_text_buffer_end_user_action(view->buffer);
	io_text_free(&io);
	g_free(text);
	iomap_view_told(view, NULL);
}

void iomap_view_delete(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);
	LadderPanelRow *row = panel_list_row(&view->list);
	char *text = iomap_view_text(view);
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io;

	(void)action;
	(void)unused;
	io_text_read(&io, text, strlen(text));
	if (row && is_same_row(&io, row))
		done(view, text, io_text_delete(&io, row->index, &edit), &edit);
	io_text_free(&io);
	g_free(text);
}

void iomap_view_look(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderIomapView *view = LADDER_IOMAP_VIEW(widget);

	(void)action;
	(void)unused;
	io_machine_free(&view->machine);
	io_machine_look(&view->machine, NULL);
	iomap_view_told(view, NULL);
}
