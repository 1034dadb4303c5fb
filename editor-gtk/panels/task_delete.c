/* SPDX-License-Identifier: MIT
 *
 * task_delete - deletes a row of the tasks; see task_delete.h.
 */
#include "editor-gtk/panels/task_delete.h"

#include "editor-gtk/kit/i18n.h"

#include <adwaita.h>
#include <string.h>

struct deleting {
	LadderDocument *document;
	enum task_what what;
	char *name;
	void (*done)(gpointer data, bool good, char *why);
	GObject *data;
};

static void deleting_free(gpointer data, GClosure *closure)
{
	struct deleting *deleting = data;

	(void)closure;
	g_object_unref(deleting->document);
	g_object_unref(deleting->data);
	g_free(deleting->name);
	g_free(deleting);
}

static void delete_now(const struct deleting *deleting)
{
	struct task_rows *tasks = task_rows_new(deleting->document);
	const int row = task_rows_find(tasks, deleting->what, deleting->name);
	char *why = NULL;
	bool good;

	task_rows_free(tasks);
	good = task_rows_delete(deleting->document, row, &why);
	deleting->done(deleting->data, good, why);
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct deleting *deleting)
{
	(void)dialog;
	if (strcmp(answer, "delete") == 0)
		delete_now(deleting);
}

/* Says which programs then run in each scan. */
static void ask(GtkWindow *window, struct deleting *deleting, const char *programs, int count)
{
	GtkWidget *dialog = adw_message_dialog_new(window, NULL, NULL);
	AdwMessageDialog *ask = ADW_MESSAGE_DIALOG(dialog);

	adw_message_dialog_format_heading(ask, _("Delete “%s”?"), deleting->name);
	adw_message_dialog_format_body(ask, ngettext(
		"Its program then runs in each scan: %s.",
		"Its programs then run in each scan: %s.", (gulong)count), programs);
	adw_message_dialog_add_responses(ask, "cancel", _("Cancel"), "delete", _("Delete"), NULL);
	adw_message_dialog_set_response_appearance(ask, "delete", ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_default_response(ask, "delete");
	adw_message_dialog_set_close_response(ask, "cancel");
	g_signal_connect_data(dialog, "response", G_CALLBACK(answered), deleting, deleting_free,
			      0);
	gtk_window_present(GTK_WINDOW(dialog));
}

/* The programs below a task, and how many they are. */
static GString *programs_of(LadderDocument *document, const char *task, int *count)
{
	struct task_rows *tasks = task_rows_new(document);
	const int row = task_rows_find(tasks, TASKS_TASK, task);
	GString *programs = g_string_new(NULL);

	*count = row >= 0 ? task_rows_programs(tasks, row) : 0;
	for (int i = row + 1; i <= row + *count; i++)
		g_string_append_printf(programs, "%s%s", programs->len ? ", " : "",
				       tasks->row[i].text[TASKS_PROGRAM]);
	task_rows_free(tasks);
	return programs;
}

void task_delete_ask(GtkWindow *window, LadderDocument *document, enum task_what what,
		     const char *name, void (*done)(gpointer data, bool good, char *why),
		     GObject *data)
{
	struct deleting *deleting = g_new(struct deleting, 1);
	int count = 0;
	GString *programs = what == TASKS_TASK ? programs_of(document, name, &count) :
						 g_string_new(NULL);

	*deleting = (struct deleting){ g_object_ref(document), what, g_strdup(name), done,
				       g_object_ref(data) };
	if (count) {
		ask(window, deleting, programs->str, count);
	} else {
		delete_now(deleting);
		deleting_free(deleting, NULL);
	}
	g_string_free(programs, TRUE);
}
