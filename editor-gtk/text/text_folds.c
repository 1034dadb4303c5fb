/* SPDX-License-Identifier: MIT
 *
 * text_folds - folded blocks: see text_folds.h.
 */
#include "editor-gtk/text/text_folds.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/text/fold_gutter.h"
#include "editor-gtk/text/fold_lines.h"

#include <string.h>

#define FIRST_PIECE 200 /* lines that are read first to find the end of a block */

/* Facts about a line. */
struct row {
	struct fold_state state; /* at its begin                               */
	guint8 kind;             /* enum fold_kind                              */
	bool folded;             /* its block is; it may be hidden itself       */
	bool hidden;
};

struct text_folds {
	LadderLineValues *values;
	GtkTextView *view;       /* the same                                    */
	GtkTextBuffer *buffer;
	GtkSourceGutterRenderer *gutter, *numbers;
	GtkTextTag *tag;         /* of hidden lines                             */
	GArray *rows;            /* of struct row                               */
	GHashTable *kept;        /* folded blocks of a text that is replaced, as block_name(); NULL: none is */
	int keeping;             /* calls of text_folds_keep() that have not ended */
	bool moves;              /* a key moves the cursor                      */
	bool shows;              /* the folds change                            */
};

static struct row *row_at(const struct text_folds *folds, int line)
{
	return &g_array_index(folds->rows, struct row, line);
}

static int row_count(const struct text_folds *folds)
{
	return (int)folds->rows->len;
}

/* ---- the text ---- */

/* Lines @from up to @to, which is not one of them. */
static char *text_of(const struct text_folds *folds, int from, int to)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_iter_at_line(folds->buffer, &start, from);
	if (to < gtk_text_buffer_get_line_count(folds->buffer))
		gtk_text_buffer_get_iter_at_line(folds->buffer, &end, to);
	else
		gtk_text_buffer_get_end_iter(folds->buffer, &end);
	return gtk_text_buffer_get_text(folds->buffer, &start, &end, TRUE);
}

/* The last line of its block; the line itself: it has none. */
static int end_of(const struct text_folds *folds, int line)
{
	const int count = row_count(folds);

	if (row_at(folds, line)->kind == FOLD_NONE)
		return line;
	for (int piece = FIRST_PIECE;; piece *= 4) {
		char *text = text_of(folds, line, MIN(line + piece, count));
		bool known;
		const int end = fold_end(text, row_at(folds, line)->state, &known);

		g_free(text);
		if (known || line + piece >= count)
			return MIN(line + end, count - 1);
	}
}

static bool begins(const struct text_folds *folds, int line)
{
	const struct row *row = row_at(folds, line);

	if (row->kind != FOLD_SLASHES)
		return row->kind != FOLD_NONE;
	return line + 1 < row_count(folds) && row[1].kind == FOLD_SLASHES &&
	       (line == 0 || row[-1].kind != FOLD_SLASHES);
}

static int cursor_line(const struct text_folds *folds)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(folds->buffer, &at, gtk_text_buffer_get_insert(folds->buffer));
	return gtk_text_iter_get_line(&at);
}

/* ---- hiding ---- */

static void apply(struct text_folds *folds, int from, int to, bool hide)
{
	GtkTextIter start, end;

	if (from >= to)
		return;
	gtk_text_buffer_get_iter_at_line(folds->buffer, &start, from);
	if (to < row_count(folds))
		gtk_text_buffer_get_iter_at_line(folds->buffer, &end, to);
	else
		gtk_text_buffer_get_end_iter(folds->buffer, &end);
	if (hide)
		gtk_text_buffer_apply_tag(folds->buffer, folds->tag, &start, &end);
	else
		gtk_text_buffer_remove_tag(folds->buffer, folds->tag, &start, &end);
}

static void changed(struct text_folds *folds)
{
	gtk_widget_queue_draw(GTK_WIDGET(folds->view));
	line_values_tell(folds->values);
	gtk_widget_queue_draw(GTK_WIDGET(folds->gutter));
	gtk_widget_queue_draw(GTK_WIDGET(folds->numbers));
}

/* Hides what the folds of lines @from up to @to hide, and nothing else. @ends: of blocks; NULL: they are
 * looked for. */
static void show_rows(struct text_folds *folds, int from, int to, const int *ends)
{
	int until = from; /* lines before it are hidden                         */

	folds->shows = true;
	apply(folds, from, to, false);
	for (int line = from; line < MAX(to, until) && line < row_count(folds); line++) {
		struct row *row = row_at(folds, line);
		int end;

		row->hidden = line < until;
		row->folded = row->folded && begins(folds, line);
		if (row->hidden || !row->folded)
			continue;
		end = ends ? ends[line] : end_of(folds, line);
		row->folded = end > line;
		apply(folds, line + 1, end + 1, true);
		until = end + 1;
	}
	folds->shows = false;
}

/* The first line above that is shown, or @line. */
static int shown_above(const struct text_folds *folds, int line)
{
	while (line > 0 && row_at(folds, line)->hidden)
		line--;
	return line;
}

/* Behind the hidden lines below it. */
static int shown_below(const struct text_folds *folds, int line)
{
	line++;
	while (line < row_count(folds) && row_at(folds, line)->hidden)
		line++;
	return line;
}

static void refresh(struct text_folds *folds, int line)
{
	show_rows(folds, line, shown_below(folds, line), NULL);
	changed(folds);
}

/* Unfolds all that hides it. */
static void reveal(struct text_folds *folds, int line)
{
	while (row_at(folds, line)->hidden) {
		const int above = shown_above(folds, line);

		row_at(folds, above)->folded = false;
		refresh(folds, above);
	}
}

/* A cursor that would be hidden goes to the line that is shown. */
static void keep_cursor_shown(struct text_folds *folds)
{
	const int line = cursor_line(folds), above = shown_above(folds, line);
	GtkTextIter at;

	if (above == line)
		return;
	gtk_text_buffer_get_iter_at_line(folds->buffer, &at, above);
	while (!gtk_text_iter_ends_line(&at) && g_unichar_isspace(gtk_text_iter_get_char(&at)))
		gtk_text_iter_forward_char(&at);
	gtk_text_buffer_place_cursor(folds->buffer, &at);
}

/* ---- folding ---- */

/* The innermost block around a line that is not folded; -1: none. */
static int block_around(const struct text_folds *folds, int line)
{
	char *text = text_of(folds, 0, row_count(folds));
	int count, *ends = fold_ends(text, &count), found;

	for (found = MIN(line, count - 1); found >= 0; found--)
		if (ends[found] > found && ends[found] >= line && !row_at(folds, found)->folded)
			break;
	g_free(ends);
	g_free(text);
	return found;
}

bool text_folds_close(struct text_folds *folds, int line)
{
	const int block = block_around(folds, line);

	if (block < 0)
		return false;
	row_at(folds, block)->folded = true;
	show_rows(folds, block, shown_below(folds, block), NULL);
	keep_cursor_shown(folds);
	changed(folds);
	return true;
}

bool text_folds_open(struct text_folds *folds, int line)
{
	if (!row_at(folds, line)->folded)
		return false;
	row_at(folds, line)->folded = false;
	refresh(folds, line);
	return true;
}

/* The program, function or block that the whole text is; -1: none. */
static int whole_block(const struct text_folds *folds, const int *ends)
{
	int last = row_count(folds) - 1, line = 0;
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(folds->buffer, &at, last);
	last -= last > 0 && gtk_text_iter_ends_line(&at);
	while (line < last && row_at(folds, line)->kind != FOLD_BLOCK)
		line++;
	return ends[line] >= last ? line : -1;
}

void text_folds_close_all(struct text_folds *folds)
{
	char *text = text_of(folds, 0, row_count(folds));
	int count, *ends = fold_ends(text, &count);
	const int whole = whole_block(folds, ends);

	g_assert(count == row_count(folds));
	for (int line = 0; line < count; line++)
		if (ends[line] > line && line != whole)
			row_at(folds, line)->folded = true;
	show_rows(folds, 0, count, ends);
	keep_cursor_shown(folds);
	changed(folds);
	g_free(ends);
	g_free(text);
}

void text_folds_open_all(struct text_folds *folds)
{
	for (int line = 0; line < row_count(folds); line++)
		row_at(folds, line)->folded = false;
	show_rows(folds, 0, row_count(folds), NULL);
	changed(folds);
}

/* Lines that are hidden behind line @line; 0: none. */
static int text_folds_hidden(const struct text_folds *folds, int line)
{
	if (line >= row_count(folds) || !row_at(folds, line)->folded || row_at(folds, line)->hidden)
		return 0;
	return shown_below(folds, line) - line - 1;
}

/* Is line @line hidden? */
static bool text_folds_is_hidden(const struct text_folds *folds, int line)
{
	return line < row_count(folds) && row_at(folds, line)->hidden;
}

char *text_folds_say(const struct text_folds *folds, int line)
{
	const int hidden = text_folds_hidden(folds, line);

	return hidden ? g_strdup_printf(ngettext("folded, %d line hidden", "folded, %d lines hidden",
						 (gulong)hidden), hidden) : NULL;
}

/* ---- the text changes ---- */

static void show_cursor(struct text_folds *folds)
{
	if (!folds->moves && !folds->kept)
		reveal(folds, cursor_line(folds));
}

/* A block that becomes a comment is not folded. */
static void set_kind(struct row *row, enum fold_kind kind)
{
	row->folded = row->folded && row->kind == kind;
	row->kind = (guint8)kind;
}

/* Returns the last line whose meaning changed: a comment may have begun. */
static int read_rows(struct text_folds *folds, int from, int to)
{
	char *text = text_of(folds, from, to);
	struct fold_state state = row_at(folds, from)->state;
	const char *at = text;

	for (int line = from; line < to && at; line++, at = fold_next(at)) {
		row_at(folds, line)->state = state;
		set_kind(row_at(folds, line), fold_kind_of(at, &state));
	}
	g_free(text);
	for (; to < row_count(folds); to++) {
		struct row *row = row_at(folds, to);

		if (row->state.kind == state.kind && row->state.depth == state.depth)
			break;
		row->state = state;
		text = text_of(folds, to, to + 1);
		set_kind(row, fold_kind_of(text, &state));
		g_free(text);
	}
	return to - 1;
}

static bool is_touched(const struct text_folds *folds, int from, int to)
{
	for (int line = from; line < MIN(to + 1, row_count(folds)); line++)
		if (row_at(folds, line)->hidden || row_at(folds, line)->folded)
			return true;
	return false;
}

/* Lines @from up to @to have another text. */
static void renew(struct text_folds *folds, int from, int to)
{
	int first, last;

	to = read_rows(folds, from, to + 1);
	if (!is_touched(folds, from, to + 1))
		return;
	first = shown_above(folds, from);
	last = shown_below(folds, to);
	show_rows(folds, first, last, NULL);
	changed(folds);
}

/* The number of rows becomes that of the lines. Returns how many came behind line @line. */
static int count_rows(struct text_folds *folds, int line)
{
	const int more = gtk_text_buffer_get_line_count(folds->buffer) - row_count(folds);
	struct row *rows;

	if (more > 0) {
		rows = g_new0(struct row, more);
		g_array_insert_vals(folds->rows, (guint)line + 1, rows, (guint)more);
		g_free(rows);
	} else if (more < 0) {
		g_array_remove_range(folds->rows, (guint)line + 1, (guint)-more);
	}
	return more;
}

static void fold_again(struct text_folds *folds, int from, int to);

static void inserted(struct text_folds *folds, GtkTextIter *at)
{
	const int last = gtk_text_iter_get_line(at);
	const int first = last - (gtk_text_buffer_get_line_count(folds->buffer) - row_count(folds));

	/* new lines in a hidden block are hidden until the block is looked at */
	for (int i = count_rows(folds, first); i > 0; i--)
		row_at(folds, first + i)->hidden = row_at(folds, first)->hidden;
	renew(folds, first, last);
	if (folds->kept)
		fold_again(folds, first, last);
	show_cursor(folds);
}

static void after_insert(GtkTextBuffer *buffer, GtkTextIter *at, const char *text, int len,
			 struct text_folds *folds)
{
	(void)buffer;
	(void)text;
	(void)len;
	inserted(folds, at);
}

static void after_delete(GtkTextBuffer *buffer, GtkTextIter *at, GtkTextIter *end,
			 struct text_folds *folds)
{
	const int line = gtk_text_iter_get_line(at);

	(void)buffer;
	(void)end;
	count_rows(folds, line);
	renew(folds, line, line);
	show_cursor(folds);
}

/* ---- a text replaces another one ---- */

void text_folds_keep(struct text_folds *folds)
{
	if (folds->keeping++ == 0)
		folds->kept = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
}

void text_folds_kept(struct text_folds *folds)
{
	if (--folds->keeping > 0)
		return;
	g_clear_pointer(&folds->kept, g_hash_table_unref);
	reveal(folds, cursor_line(folds));
}

/* The block of a line among those of the replaced text that begin with such a line: "IFX>3THEN 2".
 * @times: how often each has been seen. Caller frees. */
static char *block_name(struct text_folds *folds, GHashTable *times, int line)
{
	char *text = text_of(folds, line, line + 1), *key = fold_key(text);
	const int time = GPOINTER_TO_INT(g_hash_table_lookup(times, key)) + 1;
	char *name = g_strdup_printf("%s %d", key, time);

	g_hash_table_replace(times, key, GINT_TO_POINTER(time)); /* takes the key */
	g_free(text);
	return name;
}

static void before_delete(GtkTextBuffer *buffer, GtkTextIter *at, GtkTextIter *end,
			  struct text_folds *folds)
{
	const int first = gtk_text_iter_get_line(at);
	const int last = MIN(gtk_text_iter_get_line(end), row_count(folds) - 1);
	GHashTable *times;

	(void)buffer;
	if (!folds->kept || !is_touched(folds, first, last))
		return;
	times = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	for (int line = first; line <= last; line++) {
		char *name = begins(folds, line) ? block_name(folds, times, line) : NULL;

		if (name && row_at(folds, line)->folded)
			g_hash_table_add(folds->kept, name);
		else
			g_free(name);
	}
	g_hash_table_unref(times);
}

/* The blocks that were folded in the text before. */
static void fold_again(struct text_folds *folds, int from, int to)
{
	GHashTable *times;

	if (!g_hash_table_size(folds->kept))
		return;
	times = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	for (int line = from; line <= to; line++) {
		char *name = begins(folds, line) ? block_name(folds, times, line) : NULL;

		if (name && g_hash_table_contains(folds->kept, name))
			row_at(folds, line)->folded = true;
		g_free(name);
	}
	g_hash_table_unref(times);
	show_rows(folds, shown_above(folds, from), shown_below(folds, to), NULL);
	changed(folds);
}

/* ---- the cursor ---- */

static void before_move(struct text_folds *folds)
{
	folds->moves = true;
}

/* Where a key may leave it in hidden lines: at the end of the text, or behind the word before. */
static void after_move(GtkTextView *view, GtkMovementStep step, int count, gboolean selects,
		       struct text_folds *folds)
{
	const int line = cursor_line(folds);
	GtkTextIter at;
	int to;

	(void)view;
	(void)step;
	folds->moves = false;
	if (!row_at(folds, line)->hidden)
		return;
	to = shown_below(folds, line);
	if (count > 0 && to < row_count(folds)) {
		gtk_text_buffer_get_iter_at_line(folds->buffer, &at, to);
	} else {
		gtk_text_buffer_get_iter_at_line(folds->buffer, &at, shown_above(folds, line));
		if (!gtk_text_iter_ends_line(&at))
			gtk_text_iter_forward_to_line_end(&at);
	}
	if (selects)
		gtk_text_buffer_move_mark(folds->buffer, gtk_text_buffer_get_insert(folds->buffer), &at);
	else
		gtk_text_buffer_place_cursor(folds->buffer, &at);
}

static void cursor_moved(struct text_folds *folds)
{
	if (!folds->shows && gtk_text_buffer_get_line_count(folds->buffer) == row_count(folds))
		show_cursor(folds);
}

/* ---- life ---- */

static unsigned marks_of(void *context, int line)
{
	const struct text_folds *folds = context;
	const struct row *row;

	if (line >= row_count(folds))
		return 0;
	row = row_at(folds, line);
	return (begins(folds, line) ? FOLD_BEGINS : 0u) | (row->folded ? FOLD_CLOSED : 0u) |
	       (row->hidden ? FOLD_HIDDEN : 0u);
}

static void pressed(struct text_folds *folds, int line)
{
	if (!text_folds_open(folds, line))
		text_folds_close(folds, line);
}

static int hidden_behind(void *context, int line)
{
	return text_folds_is_hidden(context, line) ? -1 : text_folds_hidden(context, line);
}

static void watch_buffer(struct text_folds *folds)
{
	g_signal_connect_after(folds->buffer, "insert-text", G_CALLBACK(after_insert), folds);
	g_signal_connect(folds->buffer, "delete-range", G_CALLBACK(before_delete), folds);
	g_signal_connect_after(folds->buffer, "delete-range", G_CALLBACK(after_delete), folds);
	g_signal_connect_swapped(folds->buffer, "notify::cursor-position", G_CALLBACK(cursor_moved),
				 folds);
	g_signal_connect_swapped(folds->view, "move-cursor", G_CALLBACK(before_move), folds);
	g_signal_connect_after(folds->view, "move-cursor", G_CALLBACK(after_move), folds);
}

struct text_folds *text_folds_new(LadderLineValues *view)
{
	struct text_folds *folds = g_new0(struct text_folds, 1);
	GtkSourceGutter *gutter;

	folds->values = view;
	folds->view = GTK_TEXT_VIEW(view);
	folds->buffer = g_object_ref(gtk_text_view_get_buffer(folds->view));
	folds->tag = gtk_text_buffer_create_tag(folds->buffer, "folded", "invisible", TRUE, NULL);
	folds->rows = g_array_new(FALSE, TRUE, sizeof(struct row));
	g_array_set_size(folds->rows, (guint)gtk_text_buffer_get_line_count(folds->buffer));
	read_rows(folds, 0, row_count(folds));
	watch_buffer(folds);
	gutter = gtk_source_view_get_gutter(GTK_SOURCE_VIEW(view), GTK_TEXT_WINDOW_LEFT);
	folds->numbers = line_numbers_new(marks_of, folds);
	folds->gutter = fold_gutter_new(marks_of, folds);
	spoken_name(GTK_WIDGET(folds->gutter), _("Blocks to fold"));
	g_signal_connect_swapped(folds->gutter, "pressed", G_CALLBACK(pressed), folds);
	gtk_source_gutter_insert(gutter, folds->numbers, GTK_SOURCE_VIEW_GUTTER_POSITION_LINES);
	gtk_source_gutter_insert(gutter, folds->gutter, GTK_SOURCE_VIEW_GUTTER_POSITION_LINES + 1);
	line_values_set_hidden(view, hidden_behind, folds);
	return folds;
}

void text_folds_free(struct text_folds *folds)
{
	GtkSourceGutter *gutter;

	if (!folds)
		return;
	line_values_set_hidden(folds->values, NULL, NULL);
	g_signal_handlers_disconnect_by_data(folds->buffer, folds);
	g_signal_handlers_disconnect_by_data(folds->view, folds);
	gutter = gtk_source_view_get_gutter(GTK_SOURCE_VIEW(folds->view), GTK_TEXT_WINDOW_LEFT);
	gtk_source_gutter_remove(gutter, folds->gutter);
	gtk_source_gutter_remove(gutter, folds->numbers);
	g_clear_pointer(&folds->kept, g_hash_table_unref);
	g_array_unref(folds->rows);
	g_object_unref(folds->buffer);
	g_free(folds);
}
