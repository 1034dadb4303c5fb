/* SPDX-License-Identifier: MIT
 *
 * app - the life of the editor: its command line, its windows, its end.
 */
#include "editor-gtk/app.h"

#include <adwaita.h>

static void activate(GtkApplication *application, void *unused)
{
	GtkWidget *window = adw_application_window_new(application);

	(void)unused;
	gtk_window_set_default_size(GTK_WINDOW(window), 1440, 900);
	gtk_window_present(GTK_WINDOW(window));
}

int app_run(int argc, char **argv)
{
	AdwApplication *application = adw_application_new("org.rungboard.Editor", 0);
	int status;

	g_signal_connect(application, "activate", G_CALLBACK(activate), NULL);
	status = g_application_run(G_APPLICATION(application), argc, argv);
	g_object_unref(application);
	return status;
}
