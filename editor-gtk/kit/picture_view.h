/* SPDX-License-Identifier: MIT
 *
 * picture_view - a widget that shows a picture (picture.h), scaled down to its width.
 */
#ifndef EDITOR_PICTURE_VIEW_H
#define EDITOR_PICTURE_VIEW_H

#include "editor-gtk/kit/picture.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_PICTURE_VIEW (ladder_picture_view_get_type())
G_DECLARE_FINAL_TYPE(LadderPictureView, ladder_picture_view, LADDER, PICTURE_VIEW, GtkWidget)

/** picture_draw - adds the strokes to an empty picture and sets its size. */
typedef void picture_draw(gpointer data, struct picture *picture, struct lettering *lettering);

/** ladder_picture_view_new - empty. @draw: called by ladder_picture_view_again(), and when the
 * colours of the desktop change. @data: borrowed for the life of the widget. */
GtkWidget *ladder_picture_view_new(picture_draw *draw, gpointer data);
/** ladder_picture_view_again - draws it anew. */
void ladder_picture_view_again(LadderPictureView *view);
/** ladder_picture_view_size - px of its picture at 100 %. */
void ladder_picture_view_size(LadderPictureView *view, float *width, float *height);
/** ladder_picture_view_grow - takes at least this much room, px at 100 %. */
void ladder_picture_view_grow(LadderPictureView *view, float width, float height);
/** ladder_picture_view_scale - of the present width. */
float ladder_picture_view_scale(LadderPictureView *view);

#endif
