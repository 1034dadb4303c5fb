/* SPDX-License-Identifier: MIT
 *
 * usual - where the areas of a program lie that says nothing of their sizes.
 */
#ifndef TESTS_USUAL_H
#define TESTS_USUAL_H

#include "engine/base/areas.h"

static inline const struct areas *usual_areas(void)
{
	static struct areas areas;

	if (!areas.size)
		areas_init(&areas);
	return &areas;
}
#endif
