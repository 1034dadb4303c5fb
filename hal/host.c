/* SPDX-License-Identifier: MIT
 *
 * host - names and numbers of hosts, as this machine knows them.
 */
#define _DEFAULT_SOURCE
#include "hal/host.h"

#include <netdb.h>
#include <stdio.h>
#include <string.h>

enum host_found host_find(const char *host, uint16_t port, bool listens, struct sockaddr_storage *out, socklen_t *len)
{
	const struct addrinfo want = { .ai_socktype = SOCK_STREAM, .ai_flags = listens ? AI_PASSIVE : 0 };
	struct addrinfo *found;
	char service[8];

	snprintf(service, sizeof(service), "%u", port);
	if (getaddrinfo(host, service, &want, &found) != 0)
		return HOST_NONE;
	memcpy(out, found->ai_addr, found->ai_addrlen);
	*len = found->ai_addrlen;
	freeaddrinfo(found);
	return HOST_GOOD;
}
