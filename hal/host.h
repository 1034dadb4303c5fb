/* SPDX-License-Identifier: MIT
 *
 * host - the address of a host. One of two files is linked: host.c asks this machine, host_static.c, of programs
 * that are linked statically, knows numbers only.
 */
#ifndef HAL_HOST_H
#define HAL_HOST_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/socket.h>

enum host_found { HOST_GOOD, HOST_NONE, HOST_UNTOLD };

/** host_find - @listens: an address to listen at. HOST_UNTOLD: this program cannot know. Scan-safe: no. */
enum host_found host_find(const char *host, uint16_t port, bool listens, struct sockaddr_storage *out, socklen_t *len);
#endif
