/* SPDX-License-Identifier: MIT
 *
 * link_none - a ladderd without the link, for small boards.
 */
#include "ladderd/link.h"
#include "ladderd/control.h"

#include <errno.h>

struct link *link_open(const char *path, const char *groups, struct cycle *cycle)
{
	(void)path, (void)groups, (void)cycle;
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
