/* SPDX-License-Identifier: MIT
 *
 * preferences - what a person chooses once; see preferences.h.
 */
#include "editor-gtk/window/preferences.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/kit/verbs.h"

/* ---- what holds ---- */

static void use_appearance(void)
{
	static const AdwColorScheme schemes[] = {
		ADW_COLOR_SCHEME_DEFAULT, ADW_COLOR_SCHEME_FORCE_LIGHT,
		ADW_COLOR_SCHEME_FORCE_DARK,
	};

	adw_style_manager_set_color_scheme(adw_style_manager_get_default(),
		schemes[CLAMP(settings_enum("appearance", 0), 0, 2)]);
}

static void use_keys(GtkApplication *application)
{
	verbs_use_scheme(application, (enum key_scheme)CLAMP(
		settings_enum("keys", SCHEME_RUNGBOARD), 0, KEY_SCHEMES - 1));
}

void preferences_follow(AdwApplication *application)
{
	use_appearance();
	use_keys(GTK_APPLICATION(application));
	if (!settings_get())
		return;
	g_signal_connect_swapped(settings_get(), "changed::appearance",
				 G_CALLBACK(use_appearance), NULL);
	g_signal_connect_object(settings_get(), "changed::keys", G_CALLBACK(use_keys),
				application, G_CONNECT_SWAPPED);
}

/* ---- asking ---- */

static void chosen(AdwComboRow *row, GParamSpec *spec, const char *key)
{
	(void)spec;
	g_settings_set_enum(settings_get(), key, (int)adw_combo_row_get_selected(row));
}

static void add_choice(AdwPreferencesGroup *group, const char *key, const char *title,
		       const char *subtitle, const char *const *names)
{
	GtkWidget *row = adw_combo_row_new();
	GtkStringList *list = gtk_string_list_new(names);

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
	adw_action_row_set_subtitle(ADW_ACTION_ROW(row), subtitle);
	adw_combo_row_set_model(ADW_COMBO_ROW(row), G_LIST_MODEL(list));
	adw_combo_row_set_selected(ADW_COMBO_ROW(row), (guint)settings_enum(key, 0));
	gtk_widget_set_sensitive(row, settings_get() != NULL);
	g_signal_connect(row, "notify::selected", G_CALLBACK(chosen), (gpointer)key);
	adw_preferences_group_add(group, row);
	g_object_unref(list);
}

static void add_switch(AdwPreferencesGroup *group, const char *key, gboolean otherwise, const char *title,
		       const char *subtitle)
{
	GtkWidget *row = adw_action_row_new(), *is = gtk_switch_new();

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
	adw_action_row_set_subtitle(ADW_ACTION_ROW(row), subtitle);
	gtk_widget_set_valign(is, GTK_ALIGN_CENTER);
	gtk_switch_set_active(GTK_SWITCH(is), settings_flag(key, otherwise));
	gtk_widget_set_sensitive(row, settings_get() != NULL);
	if (settings_get())
		g_settings_bind(settings_get(), key, is, "active", G_SETTINGS_BIND_DEFAULT);
	adw_action_row_add_suffix(ADW_ACTION_ROW(row), is);
	adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), is);
	adw_preferences_group_add(group, row);
}

static AdwPreferencesGroup *add_group(AdwPreferencesPage *page, const char *title)
{
	GtkWidget *group = adw_preferences_group_new();

	adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(group), title);
	adw_preferences_page_add(page, ADW_PREFERENCES_GROUP(group));
	return ADW_PREFERENCES_GROUP(group);
}

static void add_looks(AdwPreferencesPage *page)
{
	const char *appearance[] = { _("as the desktop"), _("light"), _("dark"), NULL };
	const char *contrast[] = { _("as the desktop"), _("high"), NULL };
	const char *power[] = { _("green"), _("blue"), NULL };
	const char *show[] = { _("symbol and address"), _("symbols"), _("addresses"),
			       NULL };
	const char *spelling[] = { _("IEC: %IX0.0"), _("Siemens: I0.0"), NULL };
	AdwPreferencesGroup *group = add_group(page, _("Drawing"));

	add_choice(group, "appearance", _("Light or dark"), NULL, appearance);
	add_choice(group, "contrast", _("Contrast"),
		   _("Stronger colours, thicker lines, edges"), contrast);
	add_choice(group, "power", _("Colour of power"),
		   _("Power is also drawn thicker, so colour is not needed to see it"), power);
	add_choice(group, "show", _("Above an element"), NULL, show);
	add_choice(group, "spelling", _("Addresses"),
		   _("Both forms can be typed; files have the first"), spelling);
	add_switch(group, "fold-rungs", FALSE, _("Fold long rungs"),
		   _("A rung that is wider than the sheet goes on below, as on paper"));
}

static void add_keys(AdwPreferencesPage *page)
{
	const char *names[KEY_SCHEMES + 1] = { NULL };

	for (int i = 0; i < KEY_SCHEMES; i++)
		names[i] = key_scheme_name((enum key_scheme)i);
	add_choice(add_group(page, _("Keys")), "keys", _("Key scheme"),
		   _("Rungboard's own keys, or those of another editor"), names);
}

static void add_simulation(AdwPreferencesPage *page)
{
	add_switch(add_group(page, _("Simulation")), "simulate-runs", TRUE, _("Run at once"),
		   _("“Simulate” also runs the program; if off, it stops before the first scan"));
}

void preferences_show(GtkWindow *window)
{
	GtkWidget *dialog = adw_preferences_window_new();
	GtkWidget *page = adw_preferences_page_new();

	add_looks(ADW_PREFERENCES_PAGE(page));
	add_keys(ADW_PREFERENCES_PAGE(page));
	add_simulation(ADW_PREFERENCES_PAGE(page));
	adw_preferences_window_add(ADW_PREFERENCES_WINDOW(dialog),
				   ADW_PREFERENCES_PAGE(page));
	adw_preferences_window_set_search_enabled(ADW_PREFERENCES_WINDOW(dialog), FALSE);
	gtk_window_set_default_size(GTK_WINDOW(dialog), 560, 460);
	gtk_window_set_transient_for(GTK_WINDOW(dialog), window);
	gtk_window_present(GTK_WINDOW(dialog));
}
