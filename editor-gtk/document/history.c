/* SPDX-License-Identifier: MIT
 *
 * history - the steps of a document, as text.
 */
#include "editor-gtk/document/history.h"

#include <string.h>

#define HISTORY_BYTES (64u << 20) /* bytes of texts; the oldest steps above it are forgotten */
#define SAVED_NEVER   (-1)

struct history {
	GPtrArray *step;   /* of struct step *                                 */
	int now;           /* number of steps that are done; the others are undone */
	int saved;         /* the value of `now` when the file was saved       */
	struct step *open;
	int depth;
	struct step_cursor (*cursor)(gpointer data);
	gpointer data;     /* of cursor                                        */
	gsize bytes;
	guint64 serial;    /* of the last step that was made                    */
	guint64 base;      /* of the last step that was forgotten */
};

/* ---- changes and steps ---- */

GPtrArray *change_texts(void)
{
	return g_ptr_array_new_with_free_func(g_free);
}

struct change *change_new(enum change_kind kind, int pou, gsize at,
			  GPtrArray *before, GPtrArray *after)
{
	struct change *change = g_new0(struct change, 1);

	*change = (struct change){ kind, pou, at, before, after };
	return change;
}

static void change_free(gpointer pointer)
{
	struct change *change = pointer;

	g_ptr_array_unref(change->before);
	g_ptr_array_unref(change->after);
	g_free(change);
}

static gsize texts_bytes(const GPtrArray *texts)
{
	gsize bytes = 0;

	for (guint i = 0; i < texts->len; i++)
		bytes += strlen(texts->pdata[i]) + 1;
	return bytes;
}

static gsize step_bytes(const struct step *step)
{
	gsize bytes = sizeof(*step);

	for (guint i = 0; i < step->change->len; i++) {
		const struct change *change = step->change->pdata[i];

		bytes += sizeof(*change) + texts_bytes(change->before) +
			 texts_bytes(change->after);
	}
	return bytes;
}

static void step_free(gpointer pointer)
{
	struct step *step = pointer;

	if (!step)
		return;
	g_free(step->name);
	g_free(step->key);
	g_ptr_array_unref(step->change);
	g_free(step);
}

/* ---- the whole ---- */

struct history *history_new(void)
{
	struct history *history = g_new0(struct history, 1);

	history->step = g_ptr_array_new_with_free_func(step_free);
	return history;
}

void history_free(struct history *history)
{
	if (!history)
		return;
	step_free(history->open);
	g_ptr_array_unref(history->step);
	g_free(history);
}

void history_set_cursor(struct history *history,
			struct step_cursor (*cursor)(gpointer data), gpointer data)
{
	history->cursor = cursor;
	history->data = data;
}

/* ---- doing ---- */

void history_begin(struct history *history, const char *name, const char *key)
{
	if (history->depth++ > 0)
		return;
	history->open = g_new0(struct step, 1);
	history->open->name = g_strdup(name);
	history->open->key = g_strdup(key);
	history->open->change = g_ptr_array_new_with_free_func(change_free);
	history->open->cursor = history->cursor ? history->cursor(history->data) :
		(struct step_cursor){ .pou = -1 };
}

/* Its change exchanges whole texts, not pieces of one. */
static bool is_whole(const struct change *change)
{
	return change->kind != CHANGE_TEXT && change->kind != CHANGE_FILE;
}

/* A later change of the same text only replaces the result of the former. */
static bool join_change(struct step *step, struct change *change)
{
	struct change *last = step->change->len ?
		step->change->pdata[step->change->len - 1] : NULL;

	if (!last || !is_whole(last) || last->kind != change->kind ||
	    last->pou != change->pou || last->at != change->at ||
	    last->after->len != change->before->len)
		return false;
	g_ptr_array_unref(last->after);
	last->after = g_ptr_array_ref(change->after);
	change_free(change);
	return true;
}

void history_add(struct history *history, struct change *change)
{
	if (!history->open) {
		history_begin(history, "", NULL);
		history_add(history, change);
		history_end(history);
		return;
	}
	if (!join_change(history->open, change))
		g_ptr_array_add(history->open->change, change);
}

bool step_is_aside(const struct step *step)
{
	for (guint i = 0; i < step->change->len; i++)
		if (((const struct change *)step->change->pdata[i])->kind != CHANGE_FILE)
			return false;
	return true;
}

/* Is the document the same before step @from and after step @to - 1? */
static bool are_aside(const struct history *history, int from, int to)
{
	for (int i = from; i < to; i++)
		if (!step_is_aside(history->step->pdata[i]))
			return false;
	return true;
}

static void forget_undone(struct history *history)
{
	if (history->saved > history->now)
		history->saved = are_aside(history, history->now, history->saved) ?
			history->now : SAVED_NEVER;
	for (int i = history->now; i < (int)history->step->len; i++)
		history->bytes -= step_bytes(history->step->pdata[i]);
	g_ptr_array_set_size(history->step, history->now);
}

static void forget_step(struct history *history, int index)
{
	struct step *step = history->step->pdata[index];
	const bool aside = step_is_aside(step);

	history->bytes -= step_bytes(step);
	if (index == 0)
		history->base = step->serial;
	if (history->now > index)
		history->now--;
	if (history->saved > index || (history->saved == index && !aside && index == 0))
		history->saved--; /* 0 becomes -1: never */
	g_ptr_array_remove_index(history->step, index);
}

static void forget_oldest(struct history *history)
{
	while (history->bytes > HISTORY_BYTES && history->step->len > 1)
		forget_step(history, 0);
}

static void forget_changes(struct history *history, struct step *step, int file)
{
	history->bytes -= step_bytes(step);
	for (guint i = step->change->len; i-- > 0;) {
		const struct change *change = step->change->pdata[i];

		if (change->kind == CHANGE_FILE && change->pou == file)
			g_ptr_array_remove_index(step->change, i);
	}
	history->bytes += step_bytes(step);
}

void history_forget_file(struct history *history, int file)
{
	for (int i = (int)history->step->len; i-- > 0;) {
		struct step *step = history->step->pdata[i];

		forget_changes(history, step, file);
		if (step->change->len == 0)
			forget_step(history, i);
	}
}

/* Joins with the step before if both have the same key, unless that one was saved. */
static bool join_step(struct history *history, struct step *step)
{
	struct step *last = history->now > 0 ?
		history->step->pdata[history->now - 1] : NULL;

	if (!last || !step->key || g_strcmp0(last->key, step->key) ||
	    history->saved == history->now)
		return false;
	history->bytes -= step_bytes(last);
	while (step->change->len > 0) {
		struct change *change = g_ptr_array_steal_index(step->change, 0);

		if (!join_change(last, change))
			g_ptr_array_add(last->change, change);
	}
	history->bytes += step_bytes(last);
	last->serial = step->serial;
	step_free(step);
	return true;
}

void history_restart(struct history *history)
{
	history_cancel(history);
	forget_undone(history);
	for (int i = history->now; i-- > 0;)
		if (!step_is_aside(history->step->pdata[i]))
			forget_step(history, i);
	history->saved = history->now;
	history->base = ++history->serial;
}

bool history_end(struct history *history)
{
	struct step *step = history->open;

	g_assert(history->depth > 0);
	if (--history->depth > 0)
		return false;
	history->open = NULL;
	if (step->change->len == 0) {
		step_free(step);
		return false;
	}
	forget_undone(history);
	step->serial = ++history->serial;
	if (join_step(history, step))
		return true;
	g_ptr_array_add(history->step, step);
	history->now++;
	history->bytes += step_bytes(step);
	forget_oldest(history);
	return true;
}

const struct step *history_open_step(const struct history *history)
{
	return history->open;
}

void history_cancel(struct history *history)
{
	step_free(history->open);
	history->open = NULL;
	history->depth = 0;
}

/* ---- places ---- */

guint64 history_place(const struct history *history)
{
	return history->now > 0 ? history_done(history, 0)->serial : history->base;
}

int history_since(const struct history *history, guint64 place)
{
	int count = 0;

	while (count < history->now && history_done(history, count)->serial > place)
		count++;
	if (count < history->now)
		return history_done(history, count)->serial == place ? count : -1;
	return history->base == place ? count : -1;
}

const struct step *history_done(const struct history *history, int index)
{
	return history->step->pdata[history->now - 1 - index];
}

void history_goes_back(struct history *history, guint64 place)
{
	history->open->is_back = true;
	history->open->back_to = place;
}

/* ---- undoing ---- */

const struct step *history_undo(struct history *history)
{
	return history->now > 0 && !history->open ?
	       history->step->pdata[--history->now] : NULL;
}

const struct step *history_redo(struct history *history)
{
	return history->now < (int)history->step->len && !history->open ?
	       history->step->pdata[history->now++] : NULL;
}

struct step_cursor history_undo_cursor(const struct history *history)
{
	return history->now > 0 ? history_done(history, 0)->cursor :
	       (struct step_cursor){ .pou = -1 };
}

const char *history_undo_name(const struct history *history)
{
	const struct step *step = history->now > 0 ?
		history->step->pdata[history->now - 1] : NULL;

	return step ? step->name : NULL;
}

const char *history_redo_name(const struct history *history)
{
	const struct step *step = history->now < (int)history->step->len ?
		history->step->pdata[history->now] : NULL;

	return step ? step->name : NULL;
}

/* ---- the saved state ---- */

void history_mark_saved(struct history *history)
{
	history->saved = history->now;
}

bool history_is_saved(const struct history *history)
{
	return history->saved >= 0 &&
	       are_aside(history, MIN(history->saved, history->now),
			 MAX(history->saved, history->now));
}

void history_never_saved(struct history *history)
{
	history->saved = SAVED_NEVER;
}
