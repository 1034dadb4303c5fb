/* SPDX-License-Identifier: MIT
 *
 * entry_popup - a line to type in at a place, with what could be meant below it.
 *
 * It knows no ladder: its owner says what candidates there are, what a line would do, and
 * whether it is taken.
 */
#ifndef EDITOR_ENTRY_POPUP_H
#define EDITOR_ENTRY_POPUP_H

#include <gtk/gtk.h>
#include <stdbool.h>

#define LADDER_TYPE_ENTRY_POPUP (ladder_entry_popup_get_type())
G_DECLARE_FINAL_TYPE(LadderEntryPopup, ladder_entry_popup, LADDER, ENTRY_POPUP, GtkPopover)

struct entry_popup_row {
	char *text, *address, *note; /* shown, in three columns                */
	char *kind;                  /* said by a screen reader                */
	char *line;                  /* the line with it taken                 */
};

struct entry_popup_calls {
	/** Adds rows with ladder_entry_popup_add(); returns what Enter would do, to be
	 * shown below, g_free'd; @good false: it would do nothing. */
	char *(*changed)(void *context, const char *line, int cursor, bool *good);
	/** Takes the line. False: not yet, it stays. */
	bool (*taken)(void *context, const char *line);
	/** It is gone, taken or not. */
	void (*gone)(void *context);
	void *context;
	/** After a click elsewhere: what was typed was taken as by Enter, or, if this is
	 * called, could not be, which it tells. NULL: what was typed is dropped. */
	void (*left)(void *context, const char *line);
	bool proposes; /* what stands there at first is a proposal, not what there is:
			  a click elsewhere takes it, too                      */
};

/** ladder_entry_popup_new - @prompt: what is asked for; @text: there at first, and
 * selected unless @typed; @owner: its parent, of whom a popup that was kept is used again. */
GtkWidget *ladder_entry_popup_new(GtkWidget *owner, const char *prompt, const char *text,
				  bool typed, const struct entry_popup_calls *calls);
/** ladder_entry_popup_add - one more candidate; its strings are copied. */
void ladder_entry_popup_add(LadderEntryPopup *popup, const struct entry_popup_row *row);
/** ladder_entry_popup_ask - asks its owner again what there is. */
void ladder_entry_popup_ask(LadderEntryPopup *popup);
/** ladder_entry_popup_select - of its line, in bytes. */
void ladder_entry_popup_select(LadderEntryPopup *popup, gsize from, gsize to);
/** ladder_entry_popup_show - at @cell of its owner. */
void ladder_entry_popup_show(LadderEntryPopup *popup, const GdkRectangle *cell);
/** ladder_entry_popup_keep - closes it, and keeps it for what its owner asks next: to make
 * one takes as long as all that a key does else. It may be what is calling. */
void ladder_entry_popup_keep(LadderEntryPopup *popup);
/** ladder_entry_popup_close - without taking anything. */
void ladder_entry_popup_close(LadderEntryPopup *popup);
/** ladder_entry_popup_drop - takes what was kept from @owner, who is going. */
void ladder_entry_popup_drop(GtkWidget *owner);

#endif
