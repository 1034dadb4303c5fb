/* SPDX-License-Identifier: MIT
 *
 * ports - looks at the files of serial lines.
 */
#include "hal/ports.h"

#include "hal/channel.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static bool is_same(const struct io_bus *bus, const char *port)
{
	return bus->port && strcmp(bus->port, port) == 0;
}

static bool has_port(const struct iomap *map, const char *port)
{
	const struct io_net *net = map ? map->net : NULL;

	for (int i = 0; net && i < net->bus_count; i++)
		if (is_same(&net->bus[i], port))
			return true;
	for (int i = 0; net && i < net->serve_count; i++)
		if (is_same(&net->serve[i].at, port))
			return true;
	return false;
}

static bool check(const struct iomap *map, const struct iomap *now, const struct io_bus *bus,
		  struct diag_list *diags)
{
	struct diag place = { .id = DIAG_MODBUS_NOT_SERIAL, .file = map->file, .line = bus->text_line,
			      .column = bus->text_column };
	struct stat seen;
	int why = 0;

	if (!bus->port || has_port(now, bus->port))
		return true;
	if (stat(bus->port, &seen) != 0)
		why = errno;
	else if (S_ISCHR(seen.st_mode))
		return true;
	if (why == EACCES) /* of a folder that only the other user may look into */
		return true;
	if (why)
		place.id = DIAG_MODBUS_NO_PORT;
	return diags && diag_add(diags, place, "%s%s%s", bus->port, DIAG_AND,
				 why && why != ENOENT ? strerror(why) : "");
}

bool ports_check(const struct iomap *map, const struct iomap *now, struct diag_list *diags)
{
	const struct io_net *net = map->net;
	bool good = true;

	for (int i = 0; net && i < net->bus_count; i++)
		good = check(map, now, &net->bus[i], diags) && good;
	for (int i = 0; net && i < net->serve_count; i++)
		good = check(map, now, &net->serve[i].at, diags) && good;
	return good;
}
