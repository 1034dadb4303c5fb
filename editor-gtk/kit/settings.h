/* SPDX-License-Identifier: MIT
 *
 * settings - preferences that are kept from one start to the next.
 *
 * The keys are those of packaging/org.rungboard.Editor.gschema.xml. If that is not installed,
 * the defaults of the program apply and nothing is kept.
 */
#ifndef EDITOR_SETTINGS_H
#define EDITOR_SETTINGS_H

#include <gio/gio.h>

/** settings_get - NULL: the schema is not installed. Borrowed. */
GSettings *settings_get(void);
/* As g_settings_get_…; @otherwise without a schema. */
int settings_int(const char *key, int otherwise);
int settings_enum(const char *key, int otherwise);
gboolean settings_flag(const char *key, gboolean otherwise);
double settings_number(const char *key, double otherwise);

#endif
