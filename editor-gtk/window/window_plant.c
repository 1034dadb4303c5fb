/* SPDX-License-Identifier: MIT
 *
 * window_plant - which plant is simulated beside the program (trial/plant.h).
 *
 * NAME.plant.rung beside NAME.rung, unless a person says which, or none.
 */
#include "editor-gtk/window/window_inside.h"

#include <string.h>

char *window_plant_of(const char *path)
{
	const gsize len = path ? strlen(path) : 0;
	char *plant;

	if (len < 5 || !g_str_has_suffix(path, ".rung") ||
	    g_str_has_suffix(path, ".plant.rung"))
		return NULL;
	plant = g_strdup_printf("%.*s.plant.rung", (int)(len - 5), path);
	if (!g_file_test(plant, G_FILE_TEST_EXISTS))
		g_clear_pointer(&plant, g_free);
	return plant;
}

void ladder_window_set_origin(LadderWindow *window, const char *path)
{
	g_free(window->origin);
	window->origin = g_strdup(path);
}

bool window_plant_ready(LadderWindow *window, GError **error)
{
	const char *path = ladder_document_path(window->document);
	char *found = window_plant_of(path ? path : window->origin);
	const char *plant = window->plant_chosen ? window->plant : found;
	const bool good = (!plant && !ladder_sim_plant(window->sim)) ||
			  ladder_sim_set_plant(window->sim, plant, error);

	g_free(found);
	return good;
}

/* The simulation, if it is on, begins anew with it; a plant with errors is not taken. */
static void choose(LadderWindow *window, const char *path)
{
	GError *error = NULL;

	if (!ladder_sim_set_plant(window->sim, path, &error)) {
		ladder_window_warn(window, error->message);
		g_error_free(error);
		return;
	}
	window->plant_chosen = true;
	g_free(window->plant);
	window->plant = g_strdup(path);
}

static void chosen(GtkNativeDialog *dialog, int response, LadderWindow *window)
{
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;

	if (path)
		choose(window, path);
	g_free(path);
	g_object_unref(dialog);
}

void window_plant_choose(LadderWindow *window)
{
	GtkFileChooserNative *chooser = window_chooser(window, _("Plant beside the program"),
		GTK_FILE_CHOOSER_ACTION_OPEN, _("Choose"));

	g_signal_connect(chooser, "response", G_CALLBACK(chosen), window);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

void window_plant_none(LadderWindow *window)
{
	choose(window, NULL);
}
