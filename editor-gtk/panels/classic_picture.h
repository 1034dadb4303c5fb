/* SPDX-License-Identifier: MIT
 *
 * classic_picture - a widget that shows a rung of ClassicLadder above what became of it
 * here, as wide as there is room.
 */
#ifndef EDITOR_CLASSIC_PICTURE_H
#define EDITOR_CLASSIC_PICTURE_H

#include "editor-gtk/document/classic_origin.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_CLASSIC_PICTURE (ladder_classic_picture_get_type())
G_DECLARE_FINAL_TYPE(LadderClassicPicture, ladder_classic_picture, LADDER, CLASSIC_PICTURE,
		     GtkWidget)

GtkWidget *ladder_classic_picture_new(void);
/** ladder_classic_picture_show - as the document is now
 * @rung: NULL: nothing is shown, and that is said. */
void ladder_classic_picture_show(LadderClassicPicture *picture, LadderOrigin *origin,
				 LadderDocument *document,
				 const struct classic_rung *rung);
#endif
