/* SPDX-License-Identifier: MIT
 *
 * store_none - refuses --retain: ladderd for small boards starts no thread, and a write to
 * flash between two scans would make scans late.
 */
#include "ladderd/store.h"

#include <errno.h>
#include <stdio.h>

struct store *store_open(const struct store_wish *wish,
			 const struct image *image, struct arena *arena,
			 int *status)
{
	(void)image, (void)arena;
	*status = 2;
	fprintf(stderr, "ladderd: --retain %s: this ladderd was built for small "
		"boards (SMALL=1) and stores no values\n", wish->path);
	return NULL;
}

bool store_measure(const struct program *program, struct arena *arena,
		   uint32_t *values, uint32_t *bytes)
{
	(void)program, (void)arena;
	*values = *bytes = 0;
	return false;
}

int store_begin(struct store *store)
{
	(void)store;
	return -ENOSYS;
}

void store_restore(struct store *store, struct resource *resource,
		   int64_t now_ns)
{
	(void)store, (void)resource, (void)now_ns;
}

void store_take(struct store *store, const struct image *image, int64_t clock_ns)
{
	(void)store, (void)image, (void)clock_ns;
}

void store_keep(struct store *store, const struct image *image)
{
	(void)store, (void)image;
}

void store_hurry(struct store *store)
{
	(void)store;
}

void store_close(struct store *store)
{
	(void)store;
}

int store_error(const struct store *store)
{
	(void)store;
	return 0;
}

struct store_status store_status(const struct store *store)
{
	(void)store;
	return (struct store_status){ .copy = 0 };
}
