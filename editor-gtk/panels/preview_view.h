/* SPDX-License-Identifier: MIT
 *
 * preview_view - the pages that would be printed, one below the other.
 *
 * It shows a copy of the project and follows edits. It uses no printer and starts no program.
 * Actions: preview.zoom-in, preview.zoom-out; the button Print activates win.print.
 */
#ifndef EDITOR_PREVIEW_VIEW_H
#define EDITOR_PREVIEW_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_PREVIEW_VIEW (ladder_preview_view_get_type())
G_DECLARE_FINAL_TYPE(LadderPreviewView, ladder_preview_view, LADDER, PREVIEW_VIEW, GtkWidget)

/** ladder_preview_view_new - @setup: paper and orientation; the view changes it when a person
 * chooses another. */
GtkWidget *ladder_preview_view_new(LadderDocument *document, GtkPageSetup *setup);
/** ladder_preview_view_again - draws the pages anew, for another setup. */
void ladder_preview_view_again(LadderPreviewView *view);
/** ladder_preview_view_zoom - @factor 0: the width of the view, 100 % at
 * most. */
void ladder_preview_view_zoom(LadderPreviewView *view, double factor);

#endif
