/* SPDX-License-Identifier: MIT
 *
 * pou_import_dialog - imports POUs of another project; see pou_import_dialog.h.
 */
#include "editor-gtk/window/pou_import_dialog.h"

#include "editor-gtk/document/pou_file.h"
#include "editor-gtk/document/pou_import.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/naming.h"

#include <string.h>

struct asking {
	GtkWidget *widget;       /* that the result is reported to             */
	LadderDocument *document;
	struct ladder *from;
	GPtrArray *checks;       /* of GtkCheckButton, one for each POU        */
};

static void asking_free(gpointer data, GClosure *closure)
{
	struct asking *asking = data;

	(void)closure;
	ladder_free(asking->from);
	g_ptr_array_unref(asking->checks);
	g_object_unref(asking->document);
	g_object_unref(asking->widget);
	g_free(asking);
}

/* ---- which POUs ---- */

/* Brings the first of the imported POUs to the front. @before: POUs without them. */
static void show_first(struct asking *asking, const bool *wanted, int before)
{
	const struct project *from = ladder_project(asking->from);
	const struct project *project = ladder_document_project(asking->document);
	const char *name = NULL;
	int pou;

	for (int i = from->pou_count - 1; i >= 0; i--)
		name = wanted[i] ? project_text(from, from->pou[i].name) : name;
	if (!project || !name || project->pou_count <= before)
		return;
	pou = project_find_pou(project, name, strlen(name));
	gtk_widget_activate_action(asking->widget, "win.go-to", "(iiii)",
				   pou >= 0 ? pou : before, -1, -1, -1);
}

static void chosen(AdwMessageDialog *dialog, const char *response, struct asking *asking)
{
	const guint count = asking->checks->len;
	const struct project *project = ladder_document_project(asking->document);
	const int before = project ? project->pou_count : 0;
	bool *wanted = g_new0(bool, count + 1), any = false;
	GString *told = g_string_new(NULL);

	(void)dialog;
	for (guint i = 0; i < count; i++) {
		wanted[i] = gtk_check_button_get_active(asking->checks->pdata[i]);
		any = any || wanted[i];
	}
	if (any && g_strcmp0(response, "import") == 0) {
		const bool good = pou_import(asking->document, asking->from, wanted, told);

		if (good)
			show_first(asking, wanted, before);
		gtk_widget_activate_action(asking->widget, good ? "win.tell" : "win.warn", "s",
					   told->str);
	}
	g_string_free(told, TRUE);
	g_free(wanted);
}

/* "Import" is enabled while at least one is checked. */
static void toggled(GtkWidget *check, AdwMessageDialog *dialog)
{
	const struct asking *asking = g_object_get_data(G_OBJECT(dialog), "asking");
	gboolean any = FALSE;

	(void)check;
	for (guint i = 0; i < asking->checks->len; i++)
		any = any || gtk_check_button_get_active(asking->checks->pdata[i]);
	adw_message_dialog_set_response_enabled(dialog, "import", any);
}

/* Checks the only POU, if there is just one. */
static void choose_first(GtkWidget *dialog, struct asking *asking)
{
	GtkWidget *first = asking->checks->len == 1 ? asking->checks->pdata[0] : NULL;

	g_object_set_data(G_OBJECT(dialog), "asking", asking);
	for (guint i = 0; i < asking->checks->len; i++)
		g_signal_connect(asking->checks->pdata[i], "toggled", G_CALLBACK(toggled),
				 dialog);
	if (first && gtk_widget_get_sensitive(first))
		gtk_check_button_set_active(GTK_CHECK_BUTTON(first), TRUE);
	toggled(NULL, ADW_MESSAGE_DIALOG(dialog));
}

static GtkWidget *checks_new(struct asking *asking)
{
	const struct project *project = ladder_project(asking->from);
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
	GtkWidget *scroller = gtk_scrolled_window_new();

	for (int i = 0; i < project->pou_count; i++) {
		GtkWidget *check = gtk_check_button_new_with_label(
			project_text(project, project->pou[i].name));

		gtk_widget_set_sensitive(check, !project->pou[i].included);
		g_ptr_array_add(asking->checks, check);
		gtk_box_append(GTK_BOX(box), check);
	}
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), box);
	gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
	gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), 320);
	return scroller;
}

static void ask_which(GtkWidget *widget, LadderDocument *document, struct ladder *from)
{
	AdwMessageDialog *dialog = ask_new(GTK_WINDOW(gtk_widget_get_root(widget)), _("Import"),
		_("The symbols, structures and blocks that they use are imported too."), "import",
		_("Import"), ADW_RESPONSE_SUGGESTED);
	struct asking *asking = g_new0(struct asking, 1);

	asking->widget = g_object_ref(widget);
	asking->document = g_object_ref(document);
	asking->from = from;
	asking->checks = g_ptr_array_new();
	adw_message_dialog_set_extra_child(dialog, checks_new(asking));
	choose_first(GTK_WIDGET(dialog), asking);
	g_signal_connect_data(dialog, "response", G_CALLBACK(chosen), asking, asking_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
}

/* ---- which project ---- */

static void ask_of(GtkWidget *widget, LadderDocument *document, const char *path)
{
	struct ladder *from = ladder_new();

	if (from && ladder_load(from, g_intern_string(path)) && ladder_project(from)) {
		ask_which(widget, document, from);
		return;
	}
	ladder_free(from);
	gtk_widget_activate_action(widget, "win.warn", "s",
		_("Cannot read the file as a project. Open it to see why."));
}

static void file_chosen(GtkNativeDialog *dialog, int response, LadderDocument *document)
{
	GtkWidget *widget = g_object_ref(g_object_get_data(G_OBJECT(dialog), "widget"));
	char *path = ask_take_path(dialog, response);

	if (path)
		ask_of(widget, document, path);
	g_object_unref(widget);
	g_free(path);
}

void pou_import_ask(GtkWidget *widget, LadderDocument *document)
{
	GtkFileChooserNative *chooser = ask_rung_file(GTK_WINDOW(gtk_widget_get_root(widget)),
		document, _("Import from another project"), GTK_FILE_CHOOSER_ACTION_OPEN,
		_("Open"));

	g_object_set_data_full(G_OBJECT(chooser), "widget", g_object_ref(widget),
			       g_object_unref);
	g_signal_connect_data(chooser, "response", G_CALLBACK(file_chosen),
			      g_object_ref(document), (GClosureNotify)(void (*)(void))
			      g_object_unref, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

/* ---- the other way: a POU of this project to another file ---- */

struct leaving {
	GtkWidget *widget;
	LadderDocument *document;
	char *name;
	bool moves;
};

static void leaving_free(gpointer data)
{
	struct leaving *leaving = data;

	g_object_unref(leaving->document);
	g_object_unref(leaving->widget);
	g_free(leaving->name);
	g_free(leaving);
}

static void leaving_closed(gpointer data, GClosure *closure)
{
	(void)closure;
	leaving_free(data);
}

static struct leaving *leaving_new(GtkWidget *widget, LadderDocument *document, const char *name,
				   bool moves)
{
	struct leaving *leaving = g_new0(struct leaving, 1);

	leaving->widget = g_object_ref(widget);
	leaving->document = g_object_ref(document);
	leaving->name = g_strdup(name);
	leaving->moves = moves;
	return leaving;
}

static void leave(struct leaving *leaving, const char *path)
{
	const struct project *project = ladder_document_project(leaving->document);
	const int pou = project ? project_find_pou(project, leaving->name,
						   strlen(leaving->name)) : -1;
	GString *told = g_string_new(_("It is not there any more"));
	const bool good = pou >= 0 && (leaving->moves ?
		pou_to_file(leaving->document, pou, path, told) :
		pou_export(leaving->document, pou, path, told));

	gtk_widget_activate_action(leaving->widget, good ? "win.tell" : "win.warn", "s",
				   told->str);
	g_string_free(told, TRUE);
}

static void target_chosen(GtkNativeDialog *dialog, int response, struct leaving *leaving)
{
	char *path = ask_take_path(dialog, response);

	if (path)
		leave(leaving, path);
	g_free(path);
}

static void ask_target(struct leaving *leaving)
{
	GtkFileChooserNative *chooser = ask_rung_file(GTK_WINDOW(gtk_widget_get_root(
		leaving->widget)), leaving->document, leaving->moves ? _("Move to file") :
		_("Copy to file"), GTK_FILE_CHOOSER_ACTION_OPEN, leaving->moves ? _("Move") :
		_("Copy"));

	g_signal_connect_data(chooser, "response", G_CALLBACK(target_chosen),
		leaving_new(leaving->widget, leaving->document, leaving->name, leaving->moves),
		leaving_closed, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

/* Why no new file can have the name. */
static char *file_refusal(gpointer data, const char *name)
{
	return pou_file_refusal(((struct leaving *)data)->document, name);
}

static void file_named(gpointer data, const char *name)
{
	struct leaving *leaving = data;
	char *path = pou_file_path(leaving->document, name);

	leave(leaving, path);
	g_free(path);
}

static void other_wanted(gpointer data)
{
	ask_target(data);
}

static const struct naming_how new_file = { file_refusal, file_named, leaving_free };

/* Asks for the name of a new file, or for another one. @leaving: taken over. */
static void ask_move(struct leaving *leaving, int pou)
{
	char *heading = g_strdup_printf(_("Move “%s” to another file"), leaving->name);
	char *name = pou_file_name(leaving->document, pou);
	struct naming *naming = naming_new(GTK_WINDOW(gtk_widget_get_root(leaving->widget)),
		heading, _("Move to new file"), _("Name of the file"), &new_file, leaving);

	naming_say(naming, _("The project includes the new file, so all callers still work."));
	naming_other(naming, _("Existing file…"), other_wanted);
	naming_set(naming, name);
	naming_show(naming);
	g_free(name);
	g_free(heading);
}

static void copy_answered(AdwMessageDialog *dialog, const char *answer, struct leaving *leaving)
{
	(void)dialog;
	if (strcmp(answer, "choose") == 0)
		ask_target(leaving);
}

/* @leaving: taken over. */
static void ask_copy(struct leaving *leaving, int pou)
{
	AdwMessageDialog *dialog;
	char *needs = pou_export_needs(leaving->document, pou);
	char *heading = g_strdup_printf(_("Copy “%s” to another file"), leaving->name);
	char *body = g_strdup_printf(_("These are copied: %s. A name that means something else there "
				       "is changed in the copy."), needs);

	dialog = ask_new(GTK_WINDOW(gtk_widget_get_root(leaving->widget)), heading, body, "choose",
			 _("Choose file…"), ADW_RESPONSE_SUGGESTED);
	g_signal_connect_data(dialog, "response", G_CALLBACK(copy_answered), leaving,
			      leaving_closed, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
	g_free(heading);
	g_free(needs);
}

/* Why nothing can be copied or moved; NULL: it can. */
static const char *leaving_refusal(LadderDocument *document, int pou, bool moves)
{
	const struct project *project = ladder_document_project(document);

	if (!project || !ladder_document_is_whole(document))
		return _("Nothing can be copied or moved until the whole project can be read. Correct its errors first");
	if (pou < 0 || project->pou[pou].included)
		return _("It is declared in another file");
	return moves && !ladder_document_path(document) ?
	       _("Save the project first. The other file is found beside it.") : NULL;
}

void pou_export_ask(GtkWidget *widget, LadderDocument *document, int pou, bool moves)
{
	const char *why = leaving_refusal(document, pou, moves);
	const struct project *project = ladder_document_project(document);
	struct leaving *leaving;

	if (why) {
		gtk_widget_activate_action(widget, "win.warn", "s", why);
		return;
	}
	leaving = leaving_new(widget, document, project_text(project, project->pou[pou].name),
			      moves);
	if (moves)
		ask_move(leaving, pou);
	else
		ask_copy(leaving, pou);
}
