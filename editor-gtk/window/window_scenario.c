/* SPDX-License-Identifier: MIT
 *
 * window_scenario - scenarios in the window: recording, the file that a recording goes to,
 * running all of them, going to where one failed.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/panels/panels.h"
#include "editor-gtk/panels/scenario_view.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a file that a scenario is added to      */

static LadderScenarioView *view_of(LadderWindow *window)
{
	return LADDER_SCENARIO_VIEW(below_panel(window, "scenarios"));
}

/* ---- running ---- */

static char *typed_text(gpointer window, const char *path)
{
	LadderFileView *view = tabs_find_file(window, path);
	LadderSideFile *file = view ? ladder_file_view_file(view) : NULL;

	return file && !ladder_side_file_is_saved(file) ? ladder_side_file_text(file) : NULL;
}

/* A copy of a sample has the sample's until it is saved. */
static void run_all(LadderWindow *window)
{
	const char *path = ladder_document_path(window->document);

	ladder_scenario_view_run(LADDER_SCENARIO_VIEW(below_show(window, "scenarios")),
				 path ? path : window_sample(window), typed_text, window);
}

/* All that is wrong with that file, each at its line. */
static void mark_file(LadderWindow *window, LadderFileView *view)
{
	GPtrArray *results = ladder_scenario_view_results(view_of(window));
	const char *path = ladder_side_file_path(ladder_file_view_file(view));

	ladder_file_view_clear_flaws(view);
	for (guint i = 0; results && i < results->len; i++) {
		const struct scenario_result *result = results->pdata[i];

		if (result->line && strcmp(result->path, path) == 0)
			ladder_file_view_add_flaw(view, result->line, result->column,
					      result->why);
	}
}

/* The simulation stands right after the scan that failed. */
static void play(LadderWindow *window, const struct scenario_result *result)
{
	GError *error = NULL;
	char *text;

	if (ladder_scenario_view_version(view_of(window)) !=
	    ladder_document_version(window->document)) {
		ladder_window_tell(window, _("The program was changed since: run the "
					     "scenarios again."));
		return;
	}
	if (g_strcmp0(ladder_sim_plant(window->sim), result->plant) != 0 &&
	    !ladder_sim_set_plant(window->sim, result->plant, &error)) {
		ladder_window_tell(window, error->message);
		g_error_free(error);
		return;
	}
	if (!ladder_sim_play(window->sim, result->period_ns, result->acts, result->scan,
			     &error)) {
		ladder_window_tell(window, error->message);
		g_error_free(error);
		return;
	}
	gtk_widget_set_visible(GTK_WIDGET(window->right), TRUE);
	text = g_strdup_printf(_("Failed after scan %llu: %s"),
			       (unsigned long long)result->scan, result->why);
	ladder_window_tell(window, text);
	g_free(text);
}

static void opened(LadderScenarioView *view, struct scenario_result *result,
		   LadderWindow *window)
{
	LadderFileView *file;

	(void)view;
	if (result->outcome == SCENARIO_FAILED && result->acts)
		play(window, result);
	if (!g_str_has_suffix(result->path, ".scn"))
		return; /* of the program: its problems stand in their own list */
	if (!ladder_document_path(window->document))
		return; /* of a sample: nobody shall write into that             */
	tabs_show_file(window, result->path);
	file = tabs_find_file(window, result->path);
	if (!file)
		return;
	mark_file(window, file);
	ladder_file_view_go(file, result->line ? result->line : result->first_line);
}

/* ---- where a recording goes ---- */

struct saving {
	LadderWindow *window;
	GtkWidget *name, *file;
};

/* "motor.scn", of "motor.rung". */
static char *usual_file(LadderWindow *window)
{
	char *name = g_path_get_basename(ladder_document_path(window->document));
	char *file;

	if (strrchr(name, '.'))
		*strrchr(name, '.') = '\0';
	file = g_strconcat(name, ".scn", NULL);
	g_free(name);
	return file;
}

/* What is to be added, parted by a blank line from what stands before it. */
static char *to_append(const char *before, const char *scenario)
{
	const gsize len = strlen(before);
	const char *gap = len == 0 ? "" : before[len - 1] == '\n' ? "\n" : "\n\n";

	return g_strconcat(gap, scenario, NULL);
}

static bool append_to_disk(const char *path, const char *scenario, GError **error)
{
	gsize len = 0, more;
	char *before = g_file_test(path, G_FILE_TEST_EXISTS) ?
		disk_read(path, FILE_MOST, &len, error) : g_strdup("");
	char *added, *whole;
	bool good;

	if (!before)
		return false;
	added = to_append(before, scenario);
	more = strlen(added);
	whole = g_malloc(len + more);
	memcpy(whole, before, len);
	memcpy(whole + len, added, more);
	good = disk_save(path, whole, len + more, error);
	g_free(whole);
	g_free(added);
	g_free(before);
	return good;
}

/* A file that is open is added to where it is typed in. */
static bool append(LadderWindow *window, const char *path, const char *scenario)
{
	LadderFileView *view = tabs_find_file(window, path);
	LadderSideFile *file;
	GError *error = NULL;
	char *before, *added;

	if (view) {
		file = ladder_file_view_file(view);
		before = ladder_side_file_text(file);
		added = to_append(before, scenario);
		ladder_side_file_append(file, added);
		g_free(added);
		g_free(before);
		return window_save_file(window, file);
	}
	if (append_to_disk(path, scenario, &error))
		return true;
	ladder_window_warn(window, error->message);
	g_error_free(error);
	return false;
}

static void save(LadderWindow *window, const char *name, const char *file)
{
	char *folder = g_path_get_dirname(ladder_document_path(window->document));
	char *ended = g_str_has_suffix(file, ".scn") ? g_strdup(file) :
		      g_strconcat(file, ".scn", NULL);
	char *path = g_path_is_absolute(ended) ? g_strdup(ended) :
		     g_build_filename(folder, ended, NULL);
	char *scenario = ladder_recorder_text(window->recorder, name);

	if (scenario && append(window, path, scenario)) {
		ladder_project_tree_look(window->tree);
		tabs_show_file(window, path);
		run_all(window);
	}
	g_free(scenario);
	g_free(path);
	g_free(ended);
	g_free(folder);
}

static void answered(AdwMessageDialog *dialog, const char *response, struct saving *saving)
{
	const char *name = gtk_editable_get_text(GTK_EDITABLE(saving->name));
	const char *file = gtk_editable_get_text(GTK_EDITABLE(saving->file));

	(void)dialog;
	if (strcmp(response, "save") == 0)
		save(saving->window, *name ? name : _("session"), file);
}

static GtkWidget *line(GtkGrid *grid, int row, const char *label, const char *text)
{
	GtkWidget *entry = gtk_entry_new(), *name = gtk_label_new(label);

	gtk_editable_set_text(GTK_EDITABLE(entry), text);
	gtk_entry_set_activates_default(GTK_ENTRY(entry), TRUE);
	gtk_widget_set_hexpand(entry, TRUE);
	gtk_label_set_xalign(GTK_LABEL(name), 0);
	gtk_accessible_update_property(GTK_ACCESSIBLE(entry),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, label, -1);
	gtk_grid_attach(grid, name, 0, row, 1, 1);
	gtk_grid_attach(grid, entry, 1, row, 1, 1);
	return entry;
}

static void free_saving(gpointer saving, GClosure *closure)
{
	(void)closure;
	g_free(saving);
}

static void ask(LadderWindow *window, const char *body)
{
	struct saving *saving = g_new0(struct saving, 1);
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window),
						   _("Save the recording?"), body);
	AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);
	GtkWidget *grid = gtk_grid_new();
	char *file = usual_file(window);

	gtk_grid_set_row_spacing(GTK_GRID(grid), 8);
	gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
	saving->window = window;
	saving->name = line(GTK_GRID(grid), 0, _("Name of the scenario"), "");
	saving->file = line(GTK_GRID(grid), 1, _("File"), file);
	adw_message_dialog_set_extra_child(message, grid);
	adw_message_dialog_add_responses(message, "discard", _("Discard"), "save", _("Save"),
					 NULL);
	adw_message_dialog_set_response_appearance(message, "discard",
						   ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_response_appearance(message, "save", ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(message, "save");
	adw_message_dialog_set_close_response(message, "discard");
	g_signal_connect_data(dialog, "response", G_CALLBACK(answered), saving, free_saving,
			      0);
	gtk_window_present(GTK_WINDOW(dialog));
	gtk_widget_grab_focus(saving->name);
	g_free(file);
}

/* ---- recording ---- */

static void show_recorder(LadderWindow *window)
{
	const bool on = ladder_recorder_is_on(window->recorder);
	const int expects = ladder_recorder_expects(window->recorder);
	char *text;

	gtk_widget_set_visible(GTK_WIDGET(window->record_button), on);
	if (!on)
		return;
	text = g_strdup_printf(_("● Recording · %d set · %d expected"),
			       ladder_recorder_acts(window->recorder), expects);
	if (g_strcmp0(gtk_button_get_label(window->record_button), text) != 0)
		gtk_button_set_label(window->record_button, text);
	tip_set(GTK_WIDGET(window->record_button), _("End recording"));
	g_free(text);
}

static void ended(LadderRecorder *recorder, const char *why, LadderWindow *window)
{
	const int acts = ladder_recorder_acts(recorder);
	int outputs = 0;
	GString *body = g_string_new(why);

	show_recorder(window);
	if (ladder_sim_state(window->sim) == SIM_RUN)
		ladder_sim_pause(window->sim);
	if (ladder_recorder_expects(recorder) == 0)
		outputs = ladder_recorder_expect_outputs(recorder);
	if (ladder_recorder_expects(recorder) == 0) {
		g_string_append_printf(body, "%s%s", body->len ? "\n" : "",
			_("Nothing is expected, so there is nothing to save."));
		ladder_window_tell(window, body->str);
		g_string_free(body, TRUE);
		return;
	}
	g_string_append_printf(body, body->len ? "\n\n" : "");
	g_string_append_printf(body, ngettext("%d value was set, ", "%d values were set, ",
					      (unsigned long)acts), acts);
	g_string_append_printf(body, ngettext("%d is expected.", "%d are expected.",
		(unsigned long)ladder_recorder_expects(recorder)),
		ladder_recorder_expects(recorder));
	if (outputs)
		g_string_append_printf(body, "\n%s",
			_("You expected nothing yourself: all outputs are expected as they "
			  "were at the end."));
	ask(window, body->str);
	g_string_free(body, TRUE);
}

static void toggle(LadderWindow *window)
{
	GError *error = NULL;

	if (ladder_recorder_is_on(window->recorder)) {
		ladder_recorder_end(window->recorder);
		return;
	}
	if (!ladder_document_path(window->document)) {
		ladder_window_tell(window, _("Save the project first: scenarios lie beside "
					     "it."));
		return;
	}
	if (!ladder_recorder_begin(window->recorder, &error)) {
		ladder_window_tell(window, error->message);
		g_error_free(error);
		return;
	}
	gtk_widget_set_visible(GTK_WIDGET(window->right), TRUE);
	ladder_window_tell(window, _("Recording, from a cold start. What you set is noted; "
				     "what must come of it, you say."));
}

void window_expect(LadderWindow *window, const char *name)
{
	char *said, *text;
	const bool good = ladder_recorder_expect(window->recorder, name, &said);

	text = good ? g_strdup_printf(_("Expected: %s"), said) : g_strdup(said);
	ladder_window_tell(window, text);
	g_free(text);
	g_free(said);
}

static void expect_at_cursor(LadderWindow *window)
{
	char *name = names_at_cursor(window);

	if (name)
		window_expect(window, name);
	g_free(name);
}

bool window_scenario(LadderWindow *window, enum verb verb)
{
	switch ((int)verb) {
	case VERB_record: toggle(window); return true;
	case VERB_expect: expect_at_cursor(window); return true;
	case VERB_run_scenarios: run_all(window); return true;
	default: return false;
	}
}

GtkWidget *window_scenario_new(LadderWindow *window)
{
	GtkWidget *view = ladder_scenario_view_new(window->document, window->recorder);

	g_signal_connect_object(view, "opened", G_CALLBACK(opened), window, 0);
	return view;
}

void window_scenario_init(LadderWindow *window)
{
	window->recorder = ladder_recorder_new(window->sim);
	g_signal_connect_object(window->recorder, "changed", G_CALLBACK(show_recorder),
				window, G_CONNECT_SWAPPED);
	g_signal_connect_object(window->recorder, "ended", G_CALLBACK(ended), window, 0);
}
