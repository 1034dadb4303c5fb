/* SPDX-License-Identifier: MIT
 *
 * sfc_view_clipboard - steps and the ways between them as text of a rung file.
 */
#ifndef EDITOR_SFC_VIEW_CLIPBOARD_H
#define EDITOR_SFC_VIEW_CLIPBOARD_H

#include "editor-gtk/sfc/sfc_view.h"

/** chart_copy - what is selected, or what the cursor is on, with the transitions that lead
 * from one of it to another. */
void chart_copy(LadderSfcView *view);
/** chart_paste - what the clipboard holds, into the chart; names that are taken become
 * others. */
void chart_paste(LadderSfcView *view);

#endif
