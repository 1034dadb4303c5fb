/* SPDX-License-Identifier: MIT
 *
 * settings - preferences; see settings.h.
 */
#include "editor-gtk/kit/settings.h"

#include "editor-gtk/kit/installed.h"

#define SCHEMA "org.rungboard.Editor"

/* In a build, or installed where the desktop does not look for schemas. */
static GSettingsSchema *own_schema(void)
{
	char *schemas = installed_folder("schemas", "glib-2.0/schemas");
	GSettingsSchemaSource *source = schemas ?
		g_settings_schema_source_new_from_directory(schemas,
			g_settings_schema_source_get_default(), FALSE, NULL) : NULL;
	GSettingsSchema *schema = source ?
		g_settings_schema_source_lookup(source, SCHEMA, FALSE) : NULL;

	g_clear_pointer(&source, g_settings_schema_source_unref);
	g_free(schemas);
	return schema;
}

GSettings *settings_get(void)
{
	static GSettings *settings;
	static gsize looked;

	if (g_once_init_enter(&looked)) {
		GSettingsSchemaSource *source = g_settings_schema_source_get_default();
		GSettingsSchema *schema = source ?
			g_settings_schema_source_lookup(source, SCHEMA, TRUE) : NULL;

		if (!schema)
			schema = own_schema();

		if (schema) {
			settings = g_settings_new_full(schema, NULL, NULL);
			g_settings_schema_unref(schema);
		}
		g_once_init_leave(&looked, 1);
	}
	return settings;
}

int settings_int(const char *key, int otherwise)
{
	return settings_get() ? g_settings_get_int(settings_get(), key) : otherwise;
}

int settings_enum(const char *key, int otherwise)
{
	return settings_get() ? g_settings_get_enum(settings_get(), key) : otherwise;
}

gboolean settings_flag(const char *key, gboolean otherwise)
{
	return settings_get() ? g_settings_get_boolean(settings_get(), key) : otherwise;
}

double settings_number(const char *key, double otherwise)
{
	return settings_get() ? g_settings_get_double(settings_get(), key) : otherwise;
}
