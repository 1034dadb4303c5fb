/* SPDX-License-Identifier: MIT
 *
 * property - the rows of properties.def; see property.h.
 */
#include "engine/model/property.h"

#include <stddef.h>

const struct property_row *property_row(enum property property)
{
	static const struct property_row rows[] = {
#define PROPERTY(word, name, key) [PROPERTY_##word] = { #word, name, key },
#include "engine/properties.def"
	};

	return &rows[property];
}
