/* SPDX-License-Identifier: MIT
 *
 * host_static - numbers of hosts. The C library cannot look up a name in a program that is linked statically.
 */
#define _DEFAULT_SOURCE
#include "hal/host.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <string.h>

enum host_found host_find(const char *host, uint16_t port, bool listens, struct sockaddr_storage *out, socklen_t *len)
{
	struct sockaddr_in four = { .sin_family = AF_INET, .sin_port = htons(port) };
	struct sockaddr_in6 six = { .sin6_family = AF_INET6, .sin6_port = htons(port) };

	(void)listens;
	if (inet_pton(AF_INET, host, &four.sin_addr) == 1) {
		memcpy(out, &four, sizeof(four));
		*len = sizeof(four);
		return HOST_GOOD;
	}
	if (inet_pton(AF_INET6, host, &six.sin6_addr) != 1)
		return HOST_UNTOLD;
	memcpy(out, &six, sizeof(six));
	*len = sizeof(six);
	return HOST_GOOD;
}
