/* SPDX-License-Identifier: MIT
 *
 * scenarios - scenarios in the window; see scenarios.h.
 */
#include "editor-gtk/window/scenarios.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/panels/scenario_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/names.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a file that a scenario is appended to   */

static LadderScenarioView *view_of(struct scenarios *scenarios)
{
	return LADDER_SCENARIO_VIEW(below_panel(scenarios->core->below, "scenarios"));
}

/* ---- running ---- */

static char *typed_text(gpointer tabs, const char *path)
{
	LadderFileView *view = tabs_find_file(tabs, path);
	LadderSideFile *file = view ? ladder_file_view_file(view) : NULL;

	return file && !ladder_side_file_is_saved(file) ? ladder_side_file_text(file) : NULL;
}

/* An unsaved copy of a sample runs the scenarios of the sample. */
static void run_all(struct scenarios *scenarios)
{
	const char *path = ladder_document_path(scenarios->core->document);

	below_show(scenarios->core->below, "scenarios");
	ladder_scenario_view_run(view_of(scenarios), path ? path :
				 origin_sample(scenarios->origin), typed_text,
				 scenarios->core->tabs);
}

/* Marks each failed line in the file. */
static void mark_file(struct scenarios *scenarios, LadderFileView *view)
{
	GPtrArray *results = ladder_scenario_view_results(view_of(scenarios));
	const char *path = ladder_side_file_path(ladder_file_view_file(view));

	ladder_file_view_clear_flaws(view);
	for (guint i = 0; results && i < results->len; i++) {
		const struct scenario_result *result = results->pdata[i];

		if (result->line && strcmp(result->path, path) == 0)
			ladder_file_view_add_flaw(view, result->line, result->column,
					      result->why);
	}
}

/* Shows the scan that failed, in the simulation. */
static void play(struct scenarios *scenarios, const struct scenario_result *result)
{
	GError *error = NULL;
	char *text;

	if (ladder_scenario_view_version(view_of(scenarios)) !=
	    ladder_document_version(scenarios->core->document)) {
		messages_tell(scenarios->core->messages, _("The program has changed. Run the "
							   "scenarios again."));
		return;
	}
	if (g_strcmp0(ladder_sim_plant(scenarios->core->sim), result->plant) != 0 &&
	    !ladder_sim_set_plant(scenarios->core->sim, result->plant, &error)) {
		messages_tell(scenarios->core->messages, error->message);
		g_error_free(error);
		return;
	}
	if (!ladder_sim_play(scenarios->core->sim, result->period_ns, result->speed, result->acts,
			     result->scan, &error)) {
		messages_tell(scenarios->core->messages, error->message);
		g_error_free(error);
		return;
	}
	sim_bar_show_panel(scenarios->sim_bar);
	text = g_strdup_printf(_("Failed after scan %llu: %s"),
			       (unsigned long long)result->scan, result->why);
	messages_tell(scenarios->core->messages, text);
	g_free(text);
}

static void opened(LadderScenarioView *view, struct scenario_result *result,
		   struct scenarios *scenarios)
{
	LadderFileView *file;

	(void)view;
	if (result->outcome == SCENARIO_FAILED && result->acts)
		play(scenarios, result);
	if (!g_str_has_suffix(result->path, ".scn"))
		return; /* an error of the program: the problems list has it */
	if (!ladder_document_path(scenarios->core->document))
		return; /* files of a sample are not opened, so that nobody changes them */
	tabs_show_file(scenarios->core->tabs, result->path);
	file = tabs_find_file(scenarios->core->tabs, result->path);
	if (!file)
		return;
	mark_file(scenarios, file);
	ladder_file_view_go(file, result->line ? result->line : result->first_line);
}

/* ---- where a recording goes ---- */

struct saving {
	struct scenarios *scenarios;
	GtkWidget *name, *file;
};

/* The scenario to append, with a blank line before it. */
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

/* If the file is open, the text is added to its buffer instead of the file. */
static bool append(struct scenarios *scenarios, const char *path, const char *scenario)
{
	LadderFileView *view = tabs_find_file(scenarios->core->tabs, path);
	LadderSideFile *file = view ? ladder_file_view_file(view) : NULL;
	GError *error = NULL;
	char *before, *added;

	if (file) {
		before = ladder_side_file_text(file);
		added = to_append(before, scenario);
		ladder_side_file_append(file, added);
		g_free(added);
		g_free(before);
		return tabs_save_file(scenarios->core->tabs, file);
	}
	if (append_to_disk(path, scenario, &error))
		return true;
	messages_warn(scenarios->core->messages, error->message);
	g_error_free(error);
	return false;
}

static void save(struct scenarios *scenarios, const char *name, const char *file)
{
	char *folder = g_path_get_dirname(ladder_document_path(scenarios->core->document));
	char *ended = g_str_has_suffix(file, ".scn") ? g_strdup(file) :
		      g_strconcat(file, ".scn", NULL);
	char *path = g_path_is_absolute(ended) ? g_strdup(ended) :
		     g_build_filename(folder, ended, NULL);
	char *scenario = ladder_recorder_text(scenarios->recorder, name);

	if (scenario && append(scenarios, path, scenario)) {
		ladder_project_tree_look(scenarios->core->tree);
		tabs_show_file(scenarios->core->tabs, path);
		run_all(scenarios);
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
		save(saving->scenarios, *name ? name : _("session"), file);
}

static GtkWidget *line(GtkGrid *grid, int row, const char *label, const char *text)
{
	GtkWidget *entry = ask_entry(label), *name = gtk_label_new(label);

	gtk_editable_set_text(GTK_EDITABLE(entry), text);
	gtk_widget_set_hexpand(entry, TRUE);
	gtk_label_set_xalign(GTK_LABEL(name), 0);
	gtk_grid_attach(grid, name, 0, row, 1, 1);
	gtk_grid_attach(grid, entry, 1, row, 1, 1);
	return entry;
}

static void free_saving(gpointer saving, GClosure *closure)
{
	(void)closure;
	g_free(saving);
}

static void ask(struct scenarios *scenarios, const char *body)
{
	struct saving *saving = g_new0(struct saving, 1);
	GtkWidget *dialog = adw_message_dialog_new(scenarios->core->window,
						   _("Save the recording?"), body);
	AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);
	GtkWidget *grid = gtk_grid_new();
	char *file = origin_name(scenarios->origin, ".scn");

	gtk_grid_set_row_spacing(GTK_GRID(grid), 8);
	gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
	saving->scenarios = scenarios;
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

static void show_recorder(struct scenarios *scenarios)
{
	const bool on = ladder_recorder_is_on(scenarios->recorder);
	const int expects = ladder_recorder_expects(scenarios->recorder);
	char *text;

	gtk_widget_set_visible(GTK_WIDGET(scenarios->record_button), on);
	if (!on)
		return;
	text = g_strdup_printf(_("● Recording · %d set · %d expected"),
			       ladder_recorder_acts(scenarios->recorder), expects);
	if (g_strcmp0(gtk_button_get_label(scenarios->record_button), text) != 0)
		gtk_button_set_label(scenarios->record_button, text);
	tip_set(GTK_WIDGET(scenarios->record_button), _("End recording"));
	g_free(text);
}

static void ended(LadderRecorder *recorder, const char *why, struct scenarios *scenarios)
{
	const int acts = ladder_recorder_acts(recorder);
	int outputs = 0;
	GString *body = g_string_new(why);

	show_recorder(scenarios);
	if (ladder_sim_state(scenarios->core->sim) == SIM_RUN)
		ladder_sim_pause(scenarios->core->sim);
	if (ladder_recorder_expects(recorder) == 0)
		outputs = ladder_recorder_expect_outputs(recorder);
	if (ladder_recorder_expects(recorder) == 0) {
		g_string_append_printf(body, "%s%s", body->len ? "\n" : "",
			_("The recording expects no value, so there is nothing to save."));
		messages_tell(scenarios->core->messages, body->str);
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
			_("You expected no value, so all outputs are expected as they were "
			  "at the end."));
	ask(scenarios, body->str);
	g_string_free(body, TRUE);
}

static void toggle(struct scenarios *scenarios)
{
	GError *error = NULL;

	if (ladder_recorder_is_on(scenarios->recorder)) {
		ladder_recorder_end(scenarios->recorder);
		return;
	}
	if (!ladder_document_path(scenarios->core->document)) {
		messages_tell(scenarios->core->messages, _("Save the project first: its "
							   "scenarios are saved in the same "
							   "folder."));
		return;
	}
	if (!ladder_recorder_begin(scenarios->recorder, &error)) {
		messages_tell(scenarios->core->messages, error->message);
		g_error_free(error);
		return;
	}
	sim_bar_show_panel(scenarios->sim_bar);
	messages_tell(scenarios->core->messages, _("Recording from a cold start. The values "
						   "that you set are recorded; mark the "
						   "results with “Expect this value”."));
}

void scenarios_expect(struct scenarios *scenarios, const char *name)
{
	char *said, *text;
	const bool good = ladder_recorder_expect(scenarios->recorder, name, &said);

	text = good ? g_strdup_printf(_("Expected: %s"), said) : g_strdup(said);
	messages_tell(scenarios->core->messages, text);
	g_free(text);
	g_free(said);
}

static void expect_at_cursor(struct scenarios *scenarios)
{
	char *name = names_at_cursor(scenarios->core);

	if (name)
		scenarios_expect(scenarios, name);
	g_free(name);
}

/* ---- life ---- */

bool scenarios_do(struct scenarios *scenarios, enum verb verb)
{
	switch ((int)verb) {
	case VERB_record: toggle(scenarios); return true;
	case VERB_expect: expect_at_cursor(scenarios); return true;
	case VERB_run_scenarios: run_all(scenarios); return true;
	default: return false;
	}
}

static GtkWidget *panel_new(gpointer data)
{
	struct scenarios *scenarios = data;
	GtkWidget *view = ladder_scenario_view_new(scenarios->core->document,
						   scenarios->recorder);

	core_connect(scenarios->core, view, "opened", G_CALLBACK(opened), scenarios, 0);
	return view;
}

void scenarios_init(struct scenarios *scenarios, struct core *core, struct origin *origin,
		    struct sim_bar *sim_bar)
{
	scenarios->core = core;
	scenarios->origin = origin;
	scenarios->sim_bar = sim_bar;
	scenarios->recorder = ladder_recorder_new(core->sim);
	below_add(core->below, "scenarios", N_("Scenarios"), panel_new, scenarios);
	core_connect(core, scenarios->recorder, "changed", G_CALLBACK(show_recorder),
		     scenarios, G_CONNECT_SWAPPED);
	core_connect(core, scenarios->recorder, "ended", G_CALLBACK(ended), scenarios, 0);
}

void scenarios_clear(struct scenarios *scenarios)
{
	g_clear_object(&scenarios->recorder);
}
