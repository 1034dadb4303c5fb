/* SPDX-License-Identifier: MIT
 *
 * entry_popup - a line to type in at a place of a widget, with candidates below it.
 *
 * It knows nothing of ladders: its owner gives the candidates, says what a line would do,
 * and takes or refuses it.
 */
#ifndef EDITOR_ENTRY_POPUP_H
#define EDITOR_ENTRY_POPUP_H

#include "editor-gtk/kit/spelling.h"

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_ENTRY_POPUP (ladder_entry_popup_get_type())
G_DECLARE_FINAL_TYPE(LadderEntryPopup, ladder_entry_popup, LADDER, ENTRY_POPUP, GtkPopover)

struct entry_popup_row {
	char *text, *address, *note; /* shown, in three columns                */
	char *kind;                  /* for a screen reader; shown if @marked   */
	char *line;                  /* the line after the candidate is taken  */
	bool marked;                 /* it is not there yet: taking it makes it */
};

struct entry_popup_calls {
	/** Adds candidates with ladder_entry_popup_add(). Returns the text below the line:
	 * what Enter would do, or with @good false why it would do nothing. Freed with
	 * g_free. */
	char *(*changed)(void *context, const char *line, int cursor, bool *good);
	/** Takes the line. False: refused, the popup stays open. */
	bool (*taken)(void *context, const char *line);
	/** The popup was closed, with its line taken or not. */
	void (*gone)(void *context);
	void *context;
	/** A click elsewhere takes the line as Enter does. Called if that fails, to show
	 * the reason. NULL: a click elsewhere drops the line. */
	void (*left)(void *context, const char *line);
	struct spelling_rule spelling; /* of addresses in candidates and in what it says */
	bool proposes; /* the first text is a proposal: a click elsewhere takes it even if
			  nothing was typed */
};

/** ladder_entry_popup_new - @owner: its parent; the popup that @owner kept is used again.
 * @prompt: what to type; @text: the first text, selected unless @typed. */
GtkWidget *ladder_entry_popup_new(GtkWidget *owner, const char *prompt, const char *text,
				  bool typed, const struct entry_popup_calls *calls);
/** ladder_entry_popup_add - adds a candidate, if it is not there already: the same text and
 * line. Its strings are copied. */
void ladder_entry_popup_add(LadderEntryPopup *popup, const struct entry_popup_row *row);
/** ladder_entry_popup_wrong - underlines a part of the first @word of its line, until the line changes.
 * @at, @len: of the part, in bytes of @word. Called from `changed`. */
void ladder_entry_popup_wrong(LadderEntryPopup *popup, const char *word, gsize at, gsize len);
/** ladder_entry_popup_ask - asks its owner for the candidates again. */
void ladder_entry_popup_ask(LadderEntryPopup *popup);
/** ladder_entry_popup_select - selects a part of its line, in bytes. */
void ladder_entry_popup_select(LadderEntryPopup *popup, gsize from, gsize to);
/** ladder_entry_popup_show - opens it at @cell of its owner. */
void ladder_entry_popup_show(LadderEntryPopup *popup, const GdkRectangle *cell);
/** ladder_entry_popup_keep - closes it and keeps it for its owner's next line: making one
 * takes as long as all other work of a key. It may be called from a callback. */
void ladder_entry_popup_keep(LadderEntryPopup *popup);
/** ladder_entry_popup_drop - removes the popup that @owner kept, when @owner is disposed. */
void ladder_entry_popup_drop(GtkWidget *owner);

#endif
