/* SPDX-License-Identifier: MIT
 *
 * file_history - see file_history.h.
 */
#include "editor-gtk/document/file_history.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

struct file_history {
	GtkTextBuffer *buffer;
	LadderDocument *document;
	int file;          /* number in the document                           */
	char *path, *name;
	char *known;       /* the text at the last look                        */
	int saves;         /* saves so far: steps before and after a save do not join */
	bool inside;       /* inside a user action, which is one step          */
	bool applying;     /* an undo or redo changes the buffer               */
	void (*undone)(gpointer data, const char *text);
	gpointer data;
};

static char *text_of(GtkTextBuffer *buffer)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

static bool is_inside_char(char byte)
{
	return (byte & 0xc0) == 0x80;
}

/* Bytes that both texts begin with, up to the start of a character. */
static gsize same_begin(const char *from, const char *to)
{
	gsize at = 0;

	while (from[at] && from[at] == to[at])
		at++;
	while (at > 0 && (is_inside_char(from[at]) || is_inside_char(to[at])))
		at--;
	return at;
}

/* Bytes that both texts end with, apart from the first @begin ones. */
static gsize same_end(const char *from, gsize from_len, const char *to, gsize to_len,
		      gsize begin)
{
	const gsize most = MIN(from_len, to_len) - begin;
	gsize end = 0;

	while (end < most && from[from_len - 1 - end] == to[to_len - 1 - end])
		end++;
	while (end > 0 && (is_inside_char(from[from_len - end]) ||
			   is_inside_char(to[to_len - end])))
		end--;
	return end;
}

/* Key for joining: single characters typed or deleted in the same line are one step. */
static char *key_of(const struct file_history *history, gsize at, const char *before,
		    const char *after)
{
	int line = 0;

	if (g_utf8_strlen(before, -1) + g_utf8_strlen(after, -1) != 1 ||
	    *before == '\n' || *after == '\n')
		return NULL;
	for (gsize i = 0; i < at; i++)
		line += history->known[i] == '\n';
	return g_strdup_printf("file %d save %d line %d", history->file, history->saves,
			       line);
}

static void note(struct file_history *history, gsize at, const char *before,
		 const char *after)
{
	char *name = g_strdup_printf(_("Change %s"), history->name);
	char *key = key_of(history, at, before, after);

	ladder_document_note(history->document, history->file, name, key, at, before, after);
	g_free(key);
	g_free(name);
}

/* Takes @now. */
static void set_known(struct file_history *history, char *now)
{
	g_free(history->known);
	history->known = now;
}

static void look(struct file_history *history)
{
	const char *was = history->known;
	char *now = text_of(history->buffer), *before, *after;
	const gsize was_len = strlen(was), now_len = strlen(now);
	const gsize begin = same_begin(was, now);
	const gsize end = same_end(was, was_len, now, now_len, begin);

	if (was_len != now_len || begin != was_len) {
		before = g_strndup(was + begin, was_len - begin - end);
		after = g_strndup(now + begin, now_len - begin - end);
		set_known(history, now); /* before the document reads it */
		note(history, begin, before, after);
		g_free(before);
		g_free(after);
		return;
	}
	set_known(history, now);
}

static void changed(struct file_history *history)
{
	if (!history->inside && !history->applying)
		look(history);
}

static void act_begun(struct file_history *history)
{
	history->inside = true;
}

static void act_ended(struct file_history *history)
{
	history->inside = false;
	if (!history->applying)
		look(history);
}

/* ---- undone and done again ---- */

static void iter_at(const struct file_history *history, gsize byte, GtkTextIter *at)
{
	gtk_text_buffer_get_iter_at_offset(history->buffer, at,
		(int)g_utf8_pointer_to_offset(history->known, history->known + byte));
}

static void apply(gpointer data, gsize at, const char *from, const char *to)
{
	struct file_history *history = data;
	GtkTextIter start, end;

	history->applying = true;
	iter_at(history, at, &start);
	iter_at(history, at + strlen(from), &end);
	gtk_text_buffer_begin_user_action(history->buffer);
	gtk_text_buffer_delete(history->buffer, &start, &end);
	gtk_text_buffer_insert(history->buffer, &start, to, -1);
	gtk_text_buffer_place_cursor(history->buffer, &start);
	gtk_text_buffer_end_user_action(history->buffer);
	history->applying = false;
	set_known(history, text_of(history->buffer));
	history->undone(history->data, history->known);
}

static const char *known_text(gpointer history)
{
	return ((struct file_history *)history)->known;
}

struct file_history *file_history_new(GtkTextBuffer *buffer, LadderDocument *document,
				      const char *path, bool part,
				      void (*undone)(gpointer data, const char *text),
				      gpointer data)
{
	struct file_history *history = g_new0(struct file_history, 1);

	*history = (struct file_history){ .buffer = buffer, .known = text_of(buffer),
		.document = g_object_ref(document), .path = g_strdup(path),
		.name = g_path_get_basename(path), .undone = undone, .data = data };
	history->file = ladder_document_attach(document, apply, history->path,
					       part ? known_text : NULL, history);
	gtk_text_buffer_set_enable_undo(buffer, FALSE);
	g_signal_connect_swapped(buffer, "changed", G_CALLBACK(changed), history);
	g_signal_connect_swapped(buffer, "begin-user-action", G_CALLBACK(act_begun), history);
	g_signal_connect_swapped(buffer, "end-user-action", G_CALLBACK(act_ended), history);
	return history;
}

void file_history_saved(struct file_history *history)
{
	history->saves++;
}

void file_history_free(struct file_history *history)
{
	if (!history)
		return;
	g_signal_handlers_disconnect_by_data(history->buffer, history);
	ladder_document_detach(history->document, history->file);
	g_object_unref(history->document);
	g_free(history->known);
	g_free(history->path);
	g_free(history->name);
	g_free(history);
}
