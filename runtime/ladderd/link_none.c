/* SPDX-License-Identifier: MIT
 *
 * link_none - a ladderd without the link, for small boards.
 */
#include "ladderd/link.h"
#include "ladderd/download.h"

#include <errno.h>

struct link *link_open(const struct options *options, struct cycle *cycle,
		       const struct link_store *store)
{
	(void)options, (void)cycle, (void)store;
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

void link_note(struct link *link, enum link_note note, int64_t now_ns)
{
	(void)link, (void)note, (void)now_ns;
}

bool link_doze(struct link *link, int64_t until_ns)
{
	(void)link, (void)until_ns;
	return false;
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

bool slots_load(struct slots *slots, const struct options *options, struct load *load,
		bool *stopped)
{
	(void)slots, (void)stopped;
	return load_files(load, options->file, options->map, false);
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
