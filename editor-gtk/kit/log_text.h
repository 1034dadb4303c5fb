/* SPDX-License-Identifier: MIT
 *
 * log_text - lines with the time of day, in a text view.
 */
#ifndef EDITOR_LOG_TEXT_H
#define EDITOR_LOG_TEXT_H

#include <gtk/gtk.h>

/** log_text_put - adds a line: the time, @gap, @text. Keeps the last thousand lines. */
void log_text_put(GtkTextView *view, const char *gap, const char *text);

#endif
