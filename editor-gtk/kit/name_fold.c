/* SPDX-License-Identifier: MIT
 *
 * name_fold - a key for a hash table of names: the same text for all spellings.
 */
#include "editor-gtk/kit/name_fold.h"

#include "engine/base/name.h"

#include <string.h>

char *name_fold_len(const char *name, gsize len)
{
	const gsize size = name_key(name, len, NULL, 0) + 1;
	char *key = g_malloc(size);

	name_key(name, len, key, size);
	return key;
}

char *name_fold(const char *name)
{
	return name_fold_len(name, strlen(name));
}
