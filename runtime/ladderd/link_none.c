/* SPDX-License-Identifier: MIT
 *
 * link_none - a ladderd without the link, for small boards.
 */
#include "ladderd/link.h"
#include "ladderd/control.h"
#include "ladderd/download.h"

#include <errno.h>

struct link *link_open(const char *path, const char *groups, struct cycle *cycle,
		       const struct link_store *store)
{
	(void)path, (void)groups, (void)cycle, (void)store;
	control_tell("--link: this ladderd is built without it");
	return NULL;
}

int link_begin(struct link *link)
{
	(void)link;
	return -ENOSYS;
}

void link_serve(struct link *link)
{
	(void)link;
}

void link_show(struct link *link, int64_t now_ns)
{
	(void)link, (void)now_ns;
}

void link_doze(struct link *link)
{
	(void)link;
}

void link_wake(struct link *link)
{
	(void)link;
}

void link_close(struct link *link)
{
	(void)link;
}

void link_free(struct link *link)
{
	(void)link;
}

bool slots_open(struct slots *slots, const char *folder, const char *file, const char *map)
{
	(void)file, (void)map;
	*slots = (struct slots){ .folder = folder };
	if (folder)
		control_tell("--slots: this ladderd is built without it");
	return false;
}

bool slots_reject(struct slots *slots)
{
	(void)slots;
	return false;
}

void slots_close(struct slots *slots)
{
	(void)slots;
}

enum refusal cycle_swap(struct cycle *cycle, struct standby *standby)
{
	(void)cycle, (void)standby;
	return REFUSAL_NO_STORE;
}
