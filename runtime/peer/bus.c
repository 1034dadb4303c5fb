/* SPDX-License-Identifier: MIT
 *
 * bus - UDP multicast of IPv4.
 */
#define _GNU_SOURCE /* struct in_pktinfo, struct ip_mreqn */
#include "peer/bus.h"

#include <arpa/inet.h>
#include <errno.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

void bus_init(struct bus *bus, const char *interface, const char *group, uint16_t port)
{
	memset(bus, 0, sizeof(*bus));
	bus->interface = interface;
	bus->group = group;
	bus->port = port;
	bus->fd = -1;
}

void bus_close(struct bus *bus)
{
	if (bus->fd >= 0)
		close(bus->fd);
	bus->fd = -1;
}

/* The networks of the interface: who sends must be in one of them. */
static int read_networks(struct bus *bus)
{
	struct ifaddrs *all = NULL;

	bus->networks = 0;
	if (getifaddrs(&all) != 0)
		return -errno;
	for (const struct ifaddrs *at = all; at && bus->networks < BUS_NETWORKS; at = at->ifa_next) {
		struct sockaddr_in address, mask;

		if (strcmp(at->ifa_name, bus->interface) != 0 || !at->ifa_addr || !at->ifa_netmask ||
		    at->ifa_addr->sa_family != AF_INET)
			continue;
		memcpy(&address, at->ifa_addr, sizeof(address));
		memcpy(&mask, at->ifa_netmask, sizeof(mask));
		bus->mask[bus->networks] = mask.sin_addr;
		bus->network[bus->networks].s_addr = address.sin_addr.s_addr & mask.sin_addr.s_addr;
		bus->networks++;
	}
	freeifaddrs(all);
	return bus->networks ? 0 : -EADDRNOTAVAIL;
}

static int set(int fd, int level, int option, const void *value, socklen_t len)
{
	return setsockopt(fd, level, option, value, len) == 0 ? 0 : -errno;
}

static int join(const struct bus *bus)
{
	const struct ip_mreqn where = { .imr_multiaddr = bus->group_at, .imr_ifindex = (int)bus->index };
	const struct sockaddr_in at = { .sin_family = AF_INET, .sin_port = htons(bus->port), .sin_addr = bus->group_at };
	const int one = 1, none = 0, own = 1;
	int error = set(bus->fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof(one));

	if (!error && bind(bus->fd, (const void *)&at, sizeof(at)) != 0)
		error = -errno;
	if (!error)
		error = set(bus->fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &where, sizeof(where));
	if (!error)
		error = set(bus->fd, IPPROTO_IP, IP_MULTICAST_IF, &where, sizeof(where));
	if (!error)
		error = set(bus->fd, IPPROTO_IP, IP_MULTICAST_ALL, &none, sizeof(none));
	if (!error)
		error = set(bus->fd, IPPROTO_IP, IP_MULTICAST_TTL, &own, sizeof(own));
	return error ? error : set(bus->fd, IPPROTO_IP, IP_PKTINFO, &one, sizeof(one));
}

static int open_bus(struct bus *bus)
{
	int error;

	bus->index = if_nametoindex(bus->interface);
	if (!bus->index)
		return -errno;
	if (inet_pton(AF_INET, bus->group, &bus->group_at) != 1 || !IN_MULTICAST(ntohl(bus->group_at.s_addr)))
		return -EINVAL;
	error = read_networks(bus);
	if (error)
		return error;
	bus->fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	if (bus->fd < 0)
		return -errno;
	error = join(bus);
	if (error)
		bus_close(bus);
	return error;
}

bool bus_keep(struct bus *bus)
{
	bool was_open;
	int error;

	if (bus->fd >= 0 && if_nametoindex(bus->interface) != bus->index)
		bus_close(bus);
	was_open = bus->fd >= 0;
	error = was_open ? read_networks(bus) : open_bus(bus);
	if (error)
		bus_close(bus);
	/* An open bus that does not send keeps that error until it sends again. */
	if (error || !was_open)
		bus->error = error;
	return !error;
}

const char *bus_problem(int error)
{
	switch (-error) {
	case ENODEV:
	case ENXIO:
		return "no such network interface";
	case EADDRNOTAVAIL:
		return "the interface has no address";
	case ENETUNREACH:
	case ENETDOWN:
		return "the interface is down";
	case EADDRINUSE:
		return "another program has this port";
	case EPERM:
	case EACCES:
		return "a firewall or a right forbids";
	default:
		return strerror(-error);
	}
}

const char *bus_hint(int error)
{
	switch (-error) {
	case ENODEV:
	case ENXIO:
		return "`ip link` lists those of this machine";
	case EADDRNOTAVAIL:
		return "give it one";
	case ENETUNREACH:
	case ENETDOWN:
		return "plug its cable in and switch it on";
	case EADDRINUSE:
		return "end that program, or write another port in group=";
	case EPERM:
	case EACCES:
		return "let it pass UDP to this group";
	default:
		return "the end of `dmesg` may say why";
	}
}

bool bus_send(struct bus *bus, const uint8_t *bytes, size_t len)
{
	const struct sockaddr_in to = { .sin_family = AF_INET, .sin_port = htons(bus->port), .sin_addr = bus->group_at };

	if (bus->fd < 0)
		return false;
	if (sendto(bus->fd, bytes, len, MSG_NOSIGNAL, (const void *)&to, sizeof(to)) != (ssize_t)len) {
		bus->error = -errno;
		return false;
	}
	bus->sent++;
	bus->error = 0;
	return true;
}

static bool is_neighbour(const struct bus *bus, struct in_addr from)
{
	for (int i = 0; i < bus->networks; i++)
		if ((from.s_addr & bus->mask[i].s_addr) == bus->network[i].s_addr)
			return true;
	return false;
}

/* On this interface, to the group? */
static bool is_ours(const struct bus *bus, struct msghdr *message)
{
	for (struct cmsghdr *part = CMSG_FIRSTHDR(message); part; part = CMSG_NXTHDR(message, part)) {
		struct in_pktinfo info;

		if (part->cmsg_level != IPPROTO_IP || part->cmsg_type != IP_PKTINFO)
			continue;
		memcpy(&info, CMSG_DATA(part), sizeof(info));
		return (unsigned)info.ipi_ifindex == bus->index && info.ipi_addr.s_addr == bus->group_at.s_addr;
	}
	return false;
}

size_t bus_take(struct bus *bus, uint8_t *out, size_t size, uint32_t *from)
{
	for (int i = 0; i < 64 && bus->fd >= 0; i++) {
		union { struct cmsghdr head; uint8_t bytes[128]; } room;
		struct sockaddr_in sender;
		struct iovec part = { .iov_base = out, .iov_len = size };
		struct msghdr message = { .msg_name = &sender, .msg_namelen = sizeof(sender), .msg_iov = &part,
					  .msg_iovlen = 1, .msg_control = &room, .msg_controllen = sizeof(room) };
		const ssize_t got = recvmsg(bus->fd, &message, MSG_DONTWAIT);

		if (got < 0)
			return 0;
		if (message.msg_namelen == sizeof(sender) && sender.sin_family == AF_INET && !(message.msg_flags & MSG_TRUNC) &&
		    got > 0 && is_ours(bus, &message) && is_neighbour(bus, sender.sin_addr)) {
			*from = sender.sin_addr.s_addr;
			return (size_t)got;
		}
		bus->strange++;
	}
	return 0;
}
