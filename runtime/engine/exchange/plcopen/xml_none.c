/* SPDX-License-Identifier: MIT
 *
 * xml_none - in place of xml_libxml2.c in a build without libxml2.
 */
#include "engine/exchange/plcopen/xml_tree.h"

bool xml_is_built(void)
{
	return false;
}

struct xml_node *xml_read(struct arena *arena, const char *file, const void *bytes, size_t len,
			  const char **space, struct diag_list *diags)
{
	const struct diag place = { .id = DIAG_IS_PLCOPEN, .file = file };

	(void)arena;
	(void)bytes;
	(void)len;
	*space = "";
	diag_add(diags, place, "%s", "");
	return NULL;
}
