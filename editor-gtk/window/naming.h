/* SPDX-License-Identifier: MIT
 *
 * naming - a dialog that asks for a name. A name that cannot be taken is refused at the entry.
 *
 * It knows nothing of what is named: its caller refuses names, and takes one.
 */
#ifndef EDITOR_NAMING_H
#define EDITOR_NAMING_H

#include <gtk/gtk.h>
#include <stdbool.h>

struct naming;

/* Names are given without blanks around them. */
struct naming_how {
	/* Why the name is refused, translated, caller frees; NULL: it is not. */
	char *(*refusal)(gpointer data, const char *name);
	void (*take)(gpointer data, const char *name);
	GDestroyNotify free;    /* of the data, when the dialog has ended         */
};

/**
 * naming_new - a dialog with an entry
 * @answer: on the button that takes the name; @entry: accessible name of the entry; all translated
 * @how: static; @data: taken over
 *
 * naming_set() and naming_show() follow. It frees itself.
 */
struct naming *naming_new(GtkWindow *window, const char *heading, const char *answer,
			  const char *entry, const struct naming_how *how, gpointer data);
/** naming_add - adds a widget behind the entry, or before it if @first. */
void naming_add(struct naming *naming, GtkWidget *widget, bool first);
/** naming_add_labelled - adds a widget behind the entry, with its name in front of it. @text: translated */
void naming_add_labelled(struct naming *naming, const char *text, GtkWidget *widget);
/** naming_say - the text below the heading. */
void naming_say(struct naming *naming, const char *body);
/** naming_other - adds another answer, which takes no name. @label: translated */
void naming_other(struct naming *naming, const char *label, void (*other)(gpointer data));
/** naming_set - proposes a name. */
void naming_set(struct naming *naming, const char *name);
/** naming_propose - as naming_set(), and takes @name over. */
void naming_propose(struct naming *naming, char *name);
/** naming_is_proposed - whether the entry still has the name that was proposed last. */
bool naming_is_proposed(const struct naming *naming);
/** naming_judge - asks again whether the name is refused. */
void naming_judge(struct naming *naming);
void naming_show(struct naming *naming);

#endif
