/* SPDX-License-Identifier: MIT
 *
 * scenario_view - the list of scenarios and their results; see scenario_view.h.
 */
#include "editor-gtk/panels/scenario_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/panel.h"

#include <string.h>

/* Columns of a row. */
enum { NAME, FILE_NAME, RESULT };

struct _LadderScenarioView {
	GtkWidget parent_instance;
	/* Of the template: */
	GtkWidget *box, *record_button, *expect_button, *summary, *stack, *empty;
	LadderDocument *document;
	LadderRecorder *recorder;
	struct panel_list list;
	GPtrArray *results;
	guint64 version;       /* of the document that the results are for     */
	GCancellable *running; /* NULL: none running                           */
};

G_DEFINE_FINAL_TYPE(LadderScenarioView, ladder_scenario_view, GTK_TYPE_WIDGET)

static guint opened;

/* ---- results as rows ---- */

static const char *outcome_text(enum scenario_outcome outcome)
{
	static const char *const texts[] = {
		[SCENARIO_HELD] = N_("passed"), [SCENARIO_FAILED] = N_("failed"),
		[SCENARIO_UNREAD] = N_("cannot be run"),
	};

	return _(texts[outcome]);
}

static LadderPanelRow *row_of(const struct scenario_result *result, int index)
{
	LadderPanelRow *row = ladder_panel_row_new();
	const bool held = result->outcome == SCENARIO_HELD;

	row->text[NAME] = g_strdup(result->name);
	row->text[FILE_NAME] = g_path_get_basename(result->path);
	row->text[RESULT] = held ? g_strdup(outcome_text(result->outcome)) :
		g_strdup_printf(_("%s: %s"), outcome_text(result->outcome), result->why);
	row->tone = held ? PANEL_PLAIN : PANEL_ERROR;
	row->note = held ? NULL : g_strdup(outcome_text(result->outcome));
	row->number = result->line;
	row->index = index;
	row->spoken = g_strdup_printf("%s, %s, %s", row->text[NAME], row->text[FILE_NAME],
				      row->text[RESULT]);
	return row;
}

static void show_summary(LadderScenarioView *view)
{
	guint bad = 0;
	char *text;

	for (guint i = 0; view->results && i < view->results->len; i++)
		bad += ((struct scenario_result *)view->results->pdata[i])->outcome !=
		       SCENARIO_HELD;
	if (view->running)
		text = g_strdup(_("Running…"));
	else if (!view->results)
		text = g_strdup("");
	else if (bad)
		text = g_strdup_printf(_("%u of %u failed"), bad, view->results->len);
	else
		text = g_strdup_printf(ngettext("%u passed", "%u passed",
			view->results->len), view->results->len);
	gtk_label_set_text(GTK_LABEL(view->summary), text);
	g_free(text);
}

/* The text before the first run. Caller frees. */
static char *before_run(LadderScenarioView *view)
{
	GPtrArray *files = scenario_files(ladder_document_path(view->document));
	GString *names = g_string_new(NULL);
	char *text;

	for (guint i = 0; i < files->len; i++) {
		char *name = g_path_get_basename(files->pdata[i]);

		g_string_append_printf(names, "%s%s", i ? ", " : "", name);
		g_free(name);
	}
	text = files->len ? g_strdup_printf(_("Not run yet: %s"), names->str) :
	       g_strdup(_("Scenarios say what a program must do. They are in files beside it whose "
			  "names begin with its name and end in .scn."));
	g_string_free(names, TRUE);
	g_ptr_array_unref(files);
	return text;
}

static void show_rows(LadderScenarioView *view)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	char *empty = view->running ? g_strdup(_("Running…")) :
		      view->results ? g_strdup(_("The project has no scenarios yet. Record one.")) :
		      before_run(view);

	for (guint i = 0; view->results && i < view->results->len; i++)
		g_ptr_array_add(rows, row_of(view->results->pdata[i], (int)i));
	panel_list_update(&view->list, rows);
	gtk_label_set_label(GTK_LABEL(view->empty), empty);
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), rows->len ? "list" : "none");
	g_ptr_array_unref(rows);
	g_free(empty);
	show_summary(view);
}

GPtrArray *ladder_scenario_view_results(LadderScenarioView *view)
{
	return view->results;
}

guint64 ladder_scenario_view_version(LadderScenarioView *view)
{
	return view->version;
}

/* ---- running ---- */

static void done(GObject *source, GAsyncResult *task, gpointer data)
{
	LadderScenarioView *view = data;
	GCancellable *mine = g_task_get_cancellable(G_TASK(task));
	GPtrArray *results = scenario_run_finish(task);

	(void)source;
	if (results && mine == view->running) {
		view->results = results;
		g_clear_object(&view->running);
		show_rows(view);
	} else if (results) {
		g_ptr_array_unref(results);
	}
	g_object_unref(view);
}

static void stop(LadderScenarioView *view)
{
	if (view->running)
		g_cancellable_cancel(view->running);
	g_clear_object(&view->running);
}

void ladder_scenario_view_run(LadderScenarioView *view, const char *path,
			      char *(*text_of)(gpointer data, const char *path),
			      gpointer data)
{
	GPtrArray *files = scenario_files(path);
	GPtrArray *texts = g_ptr_array_new_with_free_func(g_free);
	gsize len;
	char *program = ladder_document_text(view->document, &len);

	stop(view);
	for (guint i = 0; i < files->len; i++)
		g_ptr_array_add(texts, text_of ? text_of(data, files->pdata[i]) : NULL);
	g_clear_pointer(&view->results, g_ptr_array_unref);
	view->version = ladder_document_version(view->document);
	view->running = g_cancellable_new();
	show_rows(view);
	scenario_run_all(ladder_document_reader(view->document), path ? path : "-", program, len,
			 files, texts, view->running, done, g_object_ref(view));
	g_free(program);
}

/* ---- what a person does ---- */

static void activated(GtkColumnView *list, guint at, LadderScenarioView *view)
{
	LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(view->list.selection),
						    at);

	(void)list;
	if (row && view->results && row->index < (int)view->results->len)
		g_signal_emit(view, opened, 0, view->results->pdata[row->index]);
	g_clear_object(&row);
}

static void show_recorder(LadderScenarioView *view)
{
	const bool on = ladder_recorder_is_on(view->recorder);

	gtk_button_set_label(GTK_BUTTON(view->record_button), on ? _("End recording") :
			     _("Record"));
	gtk_widget_set_sensitive(view->expect_button, on);
}

/* A file of scenarios may be there since the last look. */
static void map(GtkWidget *widget)
{
	GTK_WIDGET_CLASS(ladder_scenario_view_parent_class)->map(widget);
	show_rows(LADDER_SCENARIO_VIEW(widget));
}

/* ---- the widget ---- */

static void dispose(GObject *object)
{
	LadderScenarioView *view = LADDER_SCENARIO_VIEW(object);

	stop(view);
	if (view->recorder)
		g_signal_handlers_disconnect_by_data(view->recorder, view);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	g_clear_pointer(&view->results, g_ptr_array_unref);
	g_clear_object(&view->recorder);
	g_clear_object(&view->document);
	G_OBJECT_CLASS(ladder_scenario_view_parent_class)->dispose(object);
}

static void ladder_scenario_view_class_init(LadderScenarioViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->map = map;
	opened = g_signal_new("opened", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
			      NULL, NULL, G_TYPE_NONE, 1, G_TYPE_POINTER);
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/scenario_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderScenarioView, name)
	CHILD(box); CHILD(record_button); CHILD(expect_button); CHILD(summary);
	CHILD(stack); CHILD(empty);
#undef CHILD
	panel_bind_list(widget, LadderScenarioView);
	gtk_widget_class_bind_template_callback(widget, activated);
}

static void ladder_scenario_view_init(LadderScenarioView *view)
{
	gtk_widget_init_template(GTK_WIDGET(view));
	panel_list_init(&view->list, view->list.view);
	panel_list_column(&view->list, "", RESULT, PANEL_ICON, 0);
	panel_list_column(&view->list, _("Scenario"), NAME, 0, 180);
	panel_list_column(&view->list, _("File"), FILE_NAME, 0, 140);
	panel_list_column(&view->list, _("Result"), RESULT, PANEL_EXPAND, 180);
}

GtkWidget *ladder_scenario_view_new(LadderDocument *document, LadderRecorder *recorder)
{
	LadderScenarioView *view = g_object_new(LADDER_TYPE_SCENARIO_VIEW, NULL);

	view->document = g_object_ref(document);
	view->recorder = g_object_ref(recorder);
	g_signal_connect_swapped(recorder, "changed", G_CALLBACK(show_recorder), view);
	show_recorder(view);
	show_rows(view);
	return GTK_WIDGET(view);
}
