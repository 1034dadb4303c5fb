/* SPDX-License-Identifier: MIT
 *
 * naming - a dialog that asks for a name; see naming.h.
 */
#include "editor-gtk/window/naming.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/window/ask.h"

#include <string.h>

#define TAKE "take"     /* the response                                      */
#define OTHER "other"   /* the response of naming_other()                    */
#define WHY_LINES 4     /* lines reserved for the reason of a refusal        */

struct naming {
	AdwMessageDialog *dialog;
	GtkWidget *box, *entry, *why;
	char *proposed;                /* NULL: nothing                          */
	const struct naming_how *how;
	void (*other)(gpointer data); /* of naming_other()                       */
	gpointer data;
};

static void naming_free(gpointer data, GClosure *closure)
{
	struct naming *naming = data;

	(void)closure;
	naming->how->free(naming->data);
	g_free(naming->proposed);
	g_free(naming);
}

/* Without blanks around it; the caller frees it. */
static char *name_of(const struct naming *naming)
{
	return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(naming->entry))));
}

void naming_judge(struct naming *naming)
{
	char *name = name_of(naming), *why = naming->how->refusal(naming->data, name);

	gtk_label_set_text(GTK_LABEL(naming->why), why ? why : "");
	adw_message_dialog_set_response_enabled(naming->dialog, TAKE, !why);
	cells_refuse(naming->entry, why);
	g_free(name);
}

void naming_propose(struct naming *naming, char *name)
{
	g_free(naming->proposed);
	naming->proposed = name;
	gtk_editable_set_text(GTK_EDITABLE(naming->entry), name);
	gtk_editable_select_region(GTK_EDITABLE(naming->entry), 0, -1);
	naming_judge(naming);
}

void naming_set(struct naming *naming, const char *name)
{
	naming_propose(naming, g_strdup(name));
}

bool naming_is_proposed(const struct naming *naming)
{
	char *name = name_of(naming);
	const bool same = g_strcmp0(name, naming->proposed) == 0;

	g_free(name);
	return same;
}

void naming_add(struct naming *naming, GtkWidget *widget, bool first)
{
	if (first)
		gtk_box_prepend(GTK_BOX(naming->box), widget);
	else
		gtk_box_append(GTK_BOX(naming->box), widget);
}

void naming_add_labelled(struct naming *naming, const char *text, GtkWidget *widget)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
	GtkWidget *label = gtk_label_new(text);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, TRUE);
	spoken_name(widget, text);
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), widget);
	naming_add(naming, box, false);
}

void naming_say(struct naming *naming, const char *body)
{
	adw_message_dialog_set_body(naming->dialog, body);
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct naming *naming)
{
	char *name = name_of(naming);

	(void)dialog;
	if (strcmp(answer, TAKE) == 0)
		naming->how->take(naming->data, name);
	else if (strcmp(answer, OTHER) == 0)
		naming->other(naming->data);
	g_free(name);
}

void naming_other(struct naming *naming, const char *label, void (*other)(gpointer data))
{
	naming->other = other;
	adw_message_dialog_add_response(naming->dialog, OTHER, label);
}

static GtkWidget *why_new(void)
{
	GtkWidget *why = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(why), 0);
	gtk_label_set_wrap(GTK_LABEL(why), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(why), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_lines(GTK_LABEL(why), WHY_LINES);
	gtk_label_set_ellipsize(GTK_LABEL(why), PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(why, "error");
	return why;
}

struct naming *naming_new(GtkWindow *window, const char *heading, const char *answer,
			  const char *entry, const struct naming_how *how, gpointer data)
{
	struct naming *naming = g_new(struct naming, 1);

	*naming = (struct naming){ .how = how, .data = data,
		.dialog = ask_new(window, heading, NULL, TAKE, answer, ADW_RESPONSE_SUGGESTED),
		.box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6), .entry = ask_entry(entry),
		.why = why_new() };
	gtk_box_append(GTK_BOX(naming->box), naming->entry);
	gtk_box_append(GTK_BOX(naming->box), naming->why);
	adw_message_dialog_set_extra_child(naming->dialog, naming->box);
	g_signal_connect_swapped(naming->entry, "changed", G_CALLBACK(naming_judge), naming);
	g_signal_connect_data(naming->dialog, "response", G_CALLBACK(answered), naming,
			      naming_free, 0);
	return naming;
}

void naming_show(struct naming *naming)
{
	spoken_parts(naming->box);
	gtk_window_present(GTK_WINDOW(naming->dialog));
	gtk_widget_grab_focus(naming->entry);
}
