/* SPDX-License-Identifier: MIT
 *
 * values - the values that a text view shows beside its lines.
 */
#ifndef TESTS_EDITOR_VALUES_H
#define TESTS_EDITOR_VALUES_H

#include "editor-gtk/text/line_values.h"

/** values_in - the text with values in @widget; NULL: there is none. */
static inline LadderLineValues *values_in(GtkWidget *widget)
{
	LadderLineValues *found = LADDER_IS_LINE_VALUES(widget) ? LADDER_LINE_VALUES(widget) : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = values_in(child);
	return found;
}

#endif
