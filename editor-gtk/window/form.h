/* SPDX-License-Identifier: MIT
 *
 * form - a dialog of rows: texts that are edited and facts that are only shown. "Cancel"
 * changes nothing, "Apply" and Return apply all of them.
 */
#ifndef EDITOR_FORM_H
#define EDITOR_FORM_H

#include <adwaita.h>

struct form;

/**
 * form_new - an empty form above @window
 * @apply: returns NULL, or why it is refused, translated, which the form shows and frees
 * @data: freed with the form by @free
 *
 * form_show() presents it; it frees itself.
 */
struct form *form_new(GtkWindow *window, const char *title,
		      char *(*apply)(struct form *form, gpointer data), gpointer data,
		      GDestroyNotify free);
/** form_group - later rows come into a new group with this title; NULL: without one. */
void form_group(struct form *form, const char *title);
/** form_entry - a row with one line; returns its number. */
int form_entry(struct form *form, const char *title, const char *text);
/** form_text - a row with several lines; returns its number. */
int form_text(struct form *form, const char *title, const char *text);
/** form_fact - a row that shows @text; NULL: no row. Takes @text. */
void form_fact(struct form *form, const char *title, char *text);
/** form_get - the text of a row, without blanks around it. Caller frees. */
char *form_get(const struct form *form, int row);
/** form_judge - @refusal says why the text of a row is refused (translated, caller frees), NULL:
 * it is not. It is called at each change; a refused row is red and "Apply" is disabled. */
void form_judge(struct form *form, int row,
		char *(*refusal)(const char *text, gpointer data));
void form_show(struct form *form);

#endif
