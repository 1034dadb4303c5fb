/* SPDX-License-Identifier: MIT
 *
 * spoken - accessible names that widgets of GTK and libadwaita lack, and text that a screen
 * reader should not find.
 *
 * Mends in GTK 4.8.3 and libadwaita 1.2:
 * - The button inside a GtkDropDown has the name "GtkToggleButton", the close button of an
 *   AdwTab "GtkImage", its indicator "GtkButton", an empty label "GtkLabel".
 * - A button with a mnemonic, as each one of an AdwMessageDialog, has its label twice as its name:
 *   as the label that the mnemonic belongs to, and as its content.
 * - A GtkToggleButton has the role of a button that is pushed, so nobody hears that one of several is on.
 * - What is inside a closed GtkRevealer is still in the accessible tree: a toast that is over.
 * To see it: look at the window with accerciser, or run tests/editor/person/spoken.py without
 * the calls. Try so on each new floor.
 */
#ifndef EDITOR_SPOKEN_H
#define EDITOR_SPOKEN_H

#include <gtk/gtk.h>

/** spoken_name - sets the accessible name of @widget. @name: translated. */
void spoken_name(gpointer widget, const char *name);
/** spoken_parts - names the parts that are below @root now, and hides closed revealers. */
void spoken_parts(GtkWidget *root);
/** spoken_choice - from now on @button is one choice of its group, and says whether it is the one. */
void spoken_choice(GtkToggleButton *button);
/** spoken_say - @widget, which has the focus, says @text at once, also when it has just said the same. */
void spoken_say(GtkWidget *widget, const char *text);
/** spoken_once - the same, of a widget that says nothing else: a second later its description is that of its
 * tooltip again. */
void spoken_once(GtkWidget *widget, const char *text);
/** spoken_text - from now on @label is visible only while it has a text. */
void spoken_text(GtkLabel *label);

#endif
