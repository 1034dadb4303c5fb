/* SPDX-License-Identifier: MIT
 *
 * finder_none - a build without the library of Avahi: it finds no board.
 */
#include "online/finder.h"

#include <stddef.h>

struct finder *finder_open(const char **why)
{
	*why = "this program was built without Avahi";
	return NULL;
}

bool finder_wait(struct finder *finder, int ms)
{
	(void)finder;
	(void)ms;
	return false;
}

bool finder_settled(const struct finder *finder)
{
	(void)finder;
	return true;
}

const char *finder_failed(const struct finder *finder)
{
	(void)finder;
	return NULL;
}

int finder_count(const struct finder *finder)
{
	(void)finder;
	return 0;
}

const struct found_board *finder_board(const struct finder *finder, int index)
{
	(void)finder;
	(void)index;
	return NULL;
}

void finder_close(struct finder *finder)
{
	(void)finder;
}
