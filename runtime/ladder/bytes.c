/* SPDX-License-Identifier: MIT
 *
 * bytes - bytes that grow.
 */
#include "ladder/bytes.h"

#include <stdlib.h>
#include <string.h>

void bytes_add(struct bytes *bytes, const void *more, size_t len)
{
	if (bytes->len + len > bytes->room) {
		const size_t room = 2 * (bytes->len + len);
		uint8_t *at = bytes->failed ? NULL : realloc(bytes->at, room);

		if (!at) {
			bytes->failed = true;
			return;
		}
		bytes->at = at;
		bytes->room = room;
	}
	if (len)
		memcpy(bytes->at + bytes->len, more, len);
	bytes->len += len;
}

void bytes_free(struct bytes *bytes)
{
	free(bytes->at);
	*bytes = (struct bytes){ .at = NULL };
}
