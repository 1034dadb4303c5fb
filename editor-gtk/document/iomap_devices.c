/* SPDX-License-Identifier: MIT
 *
 * iomap_devices - the analog devices of this machine.
 */
#include "editor-gtk/document/iomap_devices.h"

#include "hal/channels.h"
#include "hal/drivers.h"

#include <stdio.h>
#include <string.h>

static const char *keep(struct arena *arena, const char *text)
{
	const char *kept = arena_copy(arena, text, strlen(text));

	return kept ? kept : "";
}

static void add(void *context, const struct device_seen *seen)
{
	static const char *const unit[] = { "", " V", " A", " \302\260C", " %", " \316\251" };
	struct io_devices *devices = context;
	struct io_device *device = arena_push(&devices->arena, &devices->device, &devices->count,
					      sizeof(*device));
	char about[128], value[48] = "";

	if (!device)
		return;
	if (seen->has_value)
		snprintf(value, sizeof(value), "%.6g%s", seen->value, unit[seen->unit]);
	snprintf(about, sizeof(about), "%.40s%s%.60s", seen->label,
		 *seen->label && (*value || *seen->problem) ? ": " : "", *value ? value : seen->problem);
	*device = (struct io_device){ driver_row(seen->driver)->word, keep(&devices->arena, seen->device),
		keep(&devices->arena, seen->channel), keep(&devices->arena, about), seen->output };
}

void io_devices_look(struct io_devices *out, const char *sys)
{
	arena_init(&out->arena);
	out->device = NULL;
	out->count = 0;
	channels_list(sys, add, out);
}

void io_devices_free(struct io_devices *devices)
{
	arena_free(&devices->arena);
	devices->device = NULL;
	devices->count = 0;
}
