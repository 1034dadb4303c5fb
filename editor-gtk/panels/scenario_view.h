/* SPDX-License-Identifier: MIT
 *
 * scenario_view - the scenarios of a project: run them all, see which hold and why not.
 *
 * It asks the window for files and goes to none itself. Signal: opened (gpointer result):
 * the struct scenario_result of a row that a person wants to see; borrowed.
 */
#ifndef EDITOR_SCENARIO_VIEW_H
#define EDITOR_SCENARIO_VIEW_H

#include "editor-gtk/sim/scenario_record.h"
#include "editor-gtk/sim/scenario_run.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_SCENARIO_VIEW (ladder_scenario_view_get_type())
G_DECLARE_FINAL_TYPE(LadderScenarioView, ladder_scenario_view, LADDER, SCENARIO_VIEW, GtkWidget)

/** ladder_scenario_view_new - @recorder: whose state its buttons show. */
GtkWidget *ladder_scenario_view_new(LadderDocument *document, LadderRecorder *recorder);
/** ladder_scenario_view_run - all of them; what runs already ends first.
 * @path: of the project whose they are; NULL: it has no file, and none
 * @text_of: what somebody types in a file and has not saved; NULL: as on the disk; the
 * caller of it frees. */
void ladder_scenario_view_run(LadderScenarioView *view, const char *path,
			      char *(*text_of)(gpointer data, const char *path),
			      gpointer data);
/** ladder_scenario_view_results - of struct scenario_result *; NULL: none yet, or they run
 * now. Borrowed until they run again. */
GPtrArray *ladder_scenario_view_results(LadderScenarioView *view);
/** ladder_scenario_view_version - of the document that the results are of. */
guint64 ladder_scenario_view_version(LadderScenarioView *view);
/** ladder_scenario_view_list - the rows shown (LadderPanelRow). Borrowed. */
GListModel *ladder_scenario_view_list(LadderScenarioView *view);

#endif
