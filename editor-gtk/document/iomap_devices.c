/* SPDX-License-Identifier: MIT
 *
 * iomap_devices - the analog devices of this machine.
 */
#include "editor-gtk/document/iomap_devices.h"

#include "engine/base/ascii.h"
#include "hal/channel.h"
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
	struct io_devices *devices = context;
	struct io_device *device = arena_push(&devices->arena, &devices->device, &devices->count,
					      sizeof(*device));
	const char *unit = io_unit_word(seen->unit);
	char about[128], value[48] = "";
	const char *what = seen->has_value ? value : seen->problem;

	if (!device)
		return;
	if (seen->has_value)
		snprintf(value, sizeof(value), "%.6g%s%s", seen->value, *unit ? " " : "", unit);
	snprintf(about, sizeof(about), "%.*s%s%.*s", (int)utf8_cut(seen->label, 40), seen->label,
		 *seen->label && *what ? ": " : "", (int)utf8_cut(what, 60), what);
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
