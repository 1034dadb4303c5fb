/* SPDX-License-Identifier: MIT
 *
 * guarded_none - a ladderd for small boards: no guard.
 */
#include "ladderd/guarded.h"

#include "guard/say.h"

#include <stddef.h>

const char *guarded_begin(void)
{
	return NULL;
}

struct guard_page *guarded_page(void)
{
	static struct guard_page page;

	return &page;
}

void guarded_beat(int64_t next_ms, bool now)
{
	(void)next_ms, (void)now;
}

bool guarded_lines(struct hal *hal)
{
	(void)hal;
	return true;
}

bool guarded_more(const struct hal *next)
{
	(void)next;
	return true;
}

void guarded_take(struct hal *hal)
{
	(void)hal;
}

void guarded_tell(const char *state)
{
	(void)state;
}
