/* SPDX-License-Identifier: MIT
 *
 * type_new - asks for the name of a new structure; see type_new.h.
 */
#include "editor-gtk/window/type_new.h"

#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

struct naming {
	struct core *core;
	AdwMessageDialog *dialog;
	GtkWidget *line, *why;
	char *original;      /* NULL: a new one                               */
};

static void naming_free(gpointer data, GClosure *closure)
{
	struct naming *naming = data;

	(void)closure;
	g_free(naming->original);
	g_free(naming);
}

/* Caller frees. */
static char *name_typed(const struct naming *naming)
{
	return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(naming->line))));
}

static void judge(struct naming *naming)
{
	char *name = name_typed(naming);

	ask_refuse(naming->dialog, "make", naming->line, naming->why,
		   type_name_refusal(naming->core->document, name));
	g_free(name);
}

static bool make(const struct naming *naming, const char *name, char **why)
{
	LadderDocument *document = naming->core->document;
	int original;

	if (!naming->original)
		return type_add(document, name, why);
	original = type_find(document, naming->original);
	if (original >= 0)
		return type_duplicate(document, original, name, why);
	*why = g_strdup(_("It is not there any more"));
	return false;
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct naming *naming)
{
	char *name = name_typed(naming), *why = NULL;

	(void)dialog;
	if (strcmp(answer, "make") == 0) {
		if (make(naming, name, &why))
			tabs_show_type(naming->core->tabs, name);
		else
			messages_warn(naming->core->messages, why);
	}
	g_free(why);
	g_free(name);
}

/* Nothing is asked if nothing can be made. */
static bool is_ready(struct core *core)
{
	if (ladder_document_project(core->document) && ladder_document_is_whole(core->document))
		return true;
	messages_tell(core->messages, _("Nothing can be added while a text of the project "
					"cannot be read"));
	return false;
}

void type_new_ask(struct core *core, const char *original)
{
	struct naming *naming;
	char *heading, *name;
	GtkWidget *box;

	if (!is_ready(core))
		return;
	box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	naming = g_new0(struct naming, 1);
	*naming = (struct naming){ .core = core, .original = g_strdup(original) };
	heading = original ? g_strdup_printf(_("Duplicate “%s”"), original) :
		  g_strdup(_("New structure"));
	naming->dialog = ask_new(core->window, heading, NULL, "make",
				 original ? _("Duplicate") : _("Create"),
				 ADW_RESPONSE_SUGGESTED);
	naming->line = ask_entry(_("Name"));
	naming->why = ask_why();
	gtk_box_append(GTK_BOX(box), naming->line);
	gtk_box_append(GTK_BOX(box), naming->why);
	spoken_parts(box);
	adw_message_dialog_set_extra_child(naming->dialog, box);
	name = type_free_name(core->document, original ? original : "Structure1");
	g_signal_connect_swapped(naming->line, "changed", G_CALLBACK(judge), naming);
	gtk_editable_set_text(GTK_EDITABLE(naming->line), name);
	gtk_editable_select_region(GTK_EDITABLE(naming->line), 0, -1);
	g_signal_connect_data(naming->dialog, "response", G_CALLBACK(answered), naming,
			      naming_free, 0);
	gtk_window_present(GTK_WINDOW(naming->dialog));
	gtk_widget_grab_focus(naming->line);
	g_free(name);
	g_free(heading);
}
