/* SPDX-License-Identifier: MIT
 *
 * scenario_view - the scenarios of a project: runs all, and shows which failed and why.
 *
 * It opens no file; the window gives it the texts. Signal: opened (gpointer result): a
 * person activated the row of that struct scenario_result; borrowed.
 */
#ifndef EDITOR_SCENARIO_VIEW_H
#define EDITOR_SCENARIO_VIEW_H

#include "editor-gtk/sim/scenario_record.h"
#include "editor-gtk/sim/scenario_run.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SCENARIO_VIEW (ladder_scenario_view_get_type())
G_DECLARE_FINAL_TYPE(LadderScenarioView, ladder_scenario_view, LADDER, SCENARIO_VIEW, GtkWidget)

/** ladder_scenario_view_new - @recorder: its buttons show the state of it. */
GtkWidget *ladder_scenario_view_new(LadderDocument *document, LadderRecorder *recorder);
/** ladder_scenario_view_run - runs all; a run under way is cancelled first
 * @path: of the project; NULL: it has no file, and no scenarios
 * @text_of: returns unsaved text of a file, which is freed here; NULL: read the file */
void ladder_scenario_view_run(LadderScenarioView *view, const char *path,
			      char *(*text_of)(gpointer data, const char *path),
			      gpointer data);
/** ladder_scenario_view_results - of struct scenario_result *; NULL: none, or still
 * running. Borrowed until the next run. */
GPtrArray *ladder_scenario_view_results(LadderScenarioView *view);
/** ladder_scenario_view_version - the version of the document that was run. */
guint64 ladder_scenario_view_version(LadderScenarioView *view);

#endif
