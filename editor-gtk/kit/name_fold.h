/* SPDX-License-Identifier: MIT
 *
 * name_fold - a key for a hash table of names: the same text for all spellings.
 */
#ifndef KIT_NAME_FOLD_H
#define KIT_NAME_FOLD_H

#include <glib.h>

/** name_fold - the key of a name, which also may be a path such as Main.Größe[3]. Owns: g_free. */
char *name_fold(const char *name);
/** name_fold_len - the same of @len bytes. */
char *name_fold_len(const char *name, gsize len);

#endif
