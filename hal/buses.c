/* SPDX-License-Identifier: MIT
 *
 * buses - opens what a map names, for a moment.
 */
#define _DEFAULT_SOURCE
#include "hal/buses.h"

#include "hal/host.h"

#include <errno.h>
#include <fcntl.h>
#include <net/if.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <unistd.h>

static struct diag place_of(const struct iomap *map, const struct io_bus *bus, enum diag_id id)
{
	return (struct diag){ .id = id, .file = map->file, .line = bus->text_line,
			      .column = bus->text_column };
}

/* Opens a serial line as another program would find it, and closes it. 0 or errno. */
static int try_port(const char *port)
{
	const int fd = open(port, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
	int why = fd < 0 ? errno : 0;

	if (fd >= 0 && !isatty(fd))
		why = ENOTTY;
	else if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) != 0)
		why = EBUSY;
	if (fd >= 0)
		close(fd);
	return why;
}

static enum diag_id id_of(int why)
{
	switch (why) {
	case EACCES:
	case EPERM:
		return DIAG_MODBUS_PERMISSION;
	case EBUSY:
	case EWOULDBLOCK:
		return DIAG_MODBUS_PORT_BUSY;
	case ENOTTY:
		return DIAG_MODBUS_NOT_SERIAL;
	default:
		return DIAG_MODBUS_NO_PORT;
	}
}

static bool check_port(const struct iomap *map, const struct io_bus *bus, struct diag_list *diags)
{
	const int why = try_port(bus->port);
	const enum diag_id id = id_of(why);

	if (!why)
		return true;
	return diag_add(diags, place_of(map, bus, id), "%s%s%s", bus->port, DIAG_AND,
			id == DIAG_MODBUS_NO_PORT && why != ENOENT ? strerror(why) : "");
}

static bool check_host(const struct iomap *map, const struct io_bus *bus, struct diag_list *diags)
{
	struct sockaddr_storage address;
	socklen_t len;

	return host_find(bus->host, bus->tcp_port, false, &address, &len) != HOST_NONE ||
	       diag_add(diags, place_of(map, bus, DIAG_MODBUS_NO_HOST), "%s", bus->host);
}

/* Two names of one device, such as /dev/ttyUSB0 and /dev/serial/by-id/…; equal names are the reader's. */
static bool check_twins(const struct iomap *map, const struct io_bus *bus, const struct io_bus *other,
			struct diag_list *diags)
{
	char *a, *b;
	bool same;

	if (!other->port || strcmp(bus->port, other->port) == 0)
		return true;
	a = realpath(bus->port, NULL);
	b = realpath(other->port, NULL);
	same = a && b && strcmp(a, b) == 0;
	free(a);
	free(b);
	return !same || diag_add(diags, place_of(map, bus, DIAG_MODBUS_PORT_TWICE), "%s%s%s", bus->port,
				 DIAG_AND, other->name);
}

void buses_server_error(const struct iomap *map, const struct io_serve *serve, int why,
			struct diag_list *diags)
{
	const enum diag_id id = why == EADDRINUSE ? DIAG_MODBUS_ADDRESS_BUSY :
				why == EACCES ? DIAG_MODBUS_LOW_PORT : DIAG_MODBUS_NOT_OURS;

	if (serve->at.kind == BUS_MODBUS_RTU)
		check_port(map, &serve->at, diags);
	else
		diag_add(diags, place_of(map, &serve->at, id), "%s:%u", serve->at.host, serve->at.tcp_port);
}

int buses_listen(const struct io_bus *at)
{
	struct sockaddr_storage address;
	socklen_t len;
	const int on = 1;
	int fd, why;

	if (host_find(at->host, at->tcp_port, true, &address, &len) != HOST_GOOD) {
		errno = ENXIO;
		return -1;
	}
	fd = socket(address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (fd >= 0)
		setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
	if (fd >= 0 && (bind(fd, (const struct sockaddr *)&address, len) != 0 || listen(fd, 8) != 0)) {
		why = errno;
		close(fd);
		fd = -1;
		errno = why;
	}
	return fd;
}

/* The servers listen all at once, so that two at one address are found, too. */
static bool check_servers(const struct iomap *map, struct diag_list *diags)
{
	const struct io_net *net = map->net;
	int *fd = calloc((size_t)net->serve_count + 1, sizeof(*fd));
	bool good = true;

	for (int i = 0; fd && i < net->serve_count; i++) {
		fd[i] = -1;
		if (net->serve[i].at.kind == BUS_MODBUS_RTU) {
			good = check_port(map, &net->serve[i].at, diags) && good;
			continue;
		}
		fd[i] = buses_listen(&net->serve[i].at);
		if (fd[i] < 0) {
			buses_server_error(map, &net->serve[i], errno, diags);
			good = false;
		}
	}
	for (int i = 0; fd && i < net->serve_count; i++)
		if (fd[i] >= 0)
			close(fd[i]);
	free(fd);
	return good;
}

bool buses_check(const struct iomap *map, struct diag_list *diags)
{
	const struct io_net *net = map->net;
	bool good = true;

	for (int i = 0; net && i < net->bus_count; i++) {
		const struct io_bus *bus = &net->bus[i];

		if (bus->kind == BUS_MODBUS_TCP)
			good = check_host(map, bus, diags) && good;
		if (bus->kind != BUS_MODBUS_RTU)
			continue;
		good = check_port(map, bus, diags) && good;
		for (int j = 0; j < i; j++)
			good = check_twins(map, bus, &net->bus[j], diags) && good;
		for (int j = 0; j < net->serve_count; j++)
			good = check_twins(map, bus, &net->serve[j].at, diags) && good;
	}
	return (!net || check_servers(map, diags)) && good;
}

/* The names of all interfaces, for a message. */
static void list_interfaces(char *out, size_t size)
{
	struct if_nameindex *all = if_nameindex();
	size_t used = 0;

	out[0] = '\0';
	for (const struct if_nameindex *at = all; at && at->if_index; at++)
		if (used + strlen(at->if_name) + 3 < size)
			used += (size_t)snprintf(out + used, size - used, "%s%s", used ? ", " : "", at->if_name);
	if_freenameindex(all);
}

bool buses_check_peers(const struct iomap *map, struct diag_list *diags)
{
	const struct io_net *net = map->net;
	char known[LIMIT_ARG];
	bool good = true;

	for (int i = 0; net && i < net->bus_count; i++) {
		const struct io_bus *bus = &net->bus[i];

		if (bus->kind != BUS_PEER || if_nametoindex(bus->interface))
			continue;
		list_interfaces(known, sizeof(known));
		good = diag_add(diags, place_of(map, bus, DIAG_PEER_NO_INTERFACE), "%s%s%s", bus->interface, DIAG_AND, known);
	}
	return good;
}
