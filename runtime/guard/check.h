/* SPDX-License-Identifier: MIT
 *
 * check - whether a packet is one that ladderd sends.
 */
#ifndef GUARD_CHECK_H
#define GUARD_CHECK_H

#include "guard/say.h"

#include <stdbool.h>
#include <stddef.h>

union guard_packet {
	struct guard_head head;
	struct guard_table table;
	struct guard_tell tell;
	struct guard_levels levels;
	struct guard_files files;
};

/** guard_check - checks all fields of a packet of @len bytes; false: throw it away. */
bool guard_check(const union guard_packet *packet, size_t len);
#endif
