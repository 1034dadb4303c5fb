/* SPDX-License-Identifier: MIT
 *
 * ask - dialogs of a window; see ask.h.
 */
#include "editor-gtk/window/ask.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"

/* Enter in a check box gives the answer, as in an entry; Space checks it. */
static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, GtkWindow *dialog)
{
	(void)keys;
	(void)code;
	if ((key != GDK_KEY_Return && key != GDK_KEY_KP_Enter) ||
	    state & gtk_accelerator_get_default_mod_mask() ||
	    !GTK_IS_CHECK_BUTTON(gtk_window_get_focus(dialog)))
		return FALSE;
	gtk_widget_activate_default(GTK_WIDGET(dialog));
	return TRUE;
}

static void answer_by_enter(AdwMessageDialog *dialog)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), dialog);
	gtk_widget_add_controller(GTK_WIDGET(dialog), keys);
}

AdwMessageDialog *ask_new(GtkWindow *window, const char *heading, const char *body,
			  const char *answer, const char *label,
			  AdwResponseAppearance appearance)
{
	AdwMessageDialog *dialog =
		ADW_MESSAGE_DIALOG(adw_message_dialog_new(window, heading, body));

	adw_message_dialog_add_responses(dialog, "cancel", _("Cancel"), answer, label, NULL);
	adw_message_dialog_set_response_appearance(dialog, answer, appearance);
	adw_message_dialog_set_default_response(dialog, answer);
	adw_message_dialog_set_close_response(dialog, "cancel");
	answer_by_enter(dialog);
	return dialog;
}

AdwMessageDialog *ask_save(GtkWindow *window, const char *name)
{
	char *body = g_strdup_printf(_("“%s” has changes that are not saved."), name);
	AdwMessageDialog *dialog = ask_new(window, _("Save the changes?"), body, "discard",
					   _("Discard"), ADW_RESPONSE_DESTRUCTIVE);

	adw_message_dialog_add_response(dialog, "save", _("Save"));
	adw_message_dialog_set_response_appearance(dialog, "save", ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(dialog, "save");
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
	return dialog;
}

GtkWidget *ask_entry(const char *name)
{
	GtkWidget *entry = gtk_entry_new();

	gtk_entry_set_activates_default(GTK_ENTRY(entry), TRUE);
	spoken_name(entry, name);
	return entry;
}

/* A GtkPasswordEntry of GTK 4.8 follows the Caps Lock key even when it is gone. */
GtkWidget *ask_secret(const char *name)
{
	GtkEntryBuffer *buffer = gtk_password_entry_buffer_new(); /* is not paged out */
	GtkWidget *entry = gtk_entry_new_with_buffer(buffer);

	gtk_entry_set_visibility(GTK_ENTRY(entry), FALSE);
	gtk_entry_set_input_purpose(GTK_ENTRY(entry), GTK_INPUT_PURPOSE_PASSWORD);
	gtk_entry_set_activates_default(GTK_ENTRY(entry), TRUE);
	spoken_name(entry, name);
	g_object_unref(buffer);
	return entry;
}

GtkFileChooserNative *ask_rung_file(GtkWindow *window, LadderDocument *document,
				    const char *title, GtkFileChooserAction action,
				    const char *accept)
{
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(title, window, action,
								    accept, _("Cancel"));
	GtkFileFilter *rungs = gtk_file_filter_new(), *all = gtk_file_filter_new();

	gtk_file_filter_set_name(rungs, _("Rung files"));
	gtk_file_filter_add_pattern(rungs, "*.rung");
	gtk_file_filter_set_name(all, _("All files"));
	gtk_file_filter_add_pattern(all, "*");
	gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(chooser), rungs);
	gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(chooser), all);
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	panel_choose_beside(chooser, document);
	g_object_unref(rungs);
	g_object_unref(all);
	return chooser;
}

char *ask_take_path(GtkNativeDialog *dialog, int response)
{
	GFile *file = response == GTK_RESPONSE_ACCEPT ?
		gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog)) : NULL;
	char *path = file ? g_file_get_path(file) : NULL;

	g_clear_object(&file);
	g_object_unref(dialog);
	return path;
}
