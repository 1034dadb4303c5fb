/* SPDX-License-Identifier: MIT
 *
 * ladder_inside - what the parts of the facade share. Only they include it.
 */
#ifndef ENGINE_LADDER_INSIDE_H
#define ENGINE_LADDER_INSIDE_H

#include "engine/ladder.h"

/** ladder_read_project - what was read, with its errors; NULL: nothing, an image.
 * Owns: @ladder, until its next load. */
struct project *ladder_read_project(struct ladder *ladder);

/* Files of another tool that can be loaded: what becomes of one is the text of a rung
 * file. A board has none. */
struct foreign {
	bool (*is)(const void *bytes, size_t len);
	bool (*is_folder)(const char *path);
	/* Text and its name for diagnostics, both @foreign's until its next call; NULL
	 * after a diagnostic. @bytes NULL: @path is a folder. */
	const char *(*read)(struct foreign *foreign, const char *path, const void *bytes,
			    size_t len, size_t *text_len, const char **name,
			    struct diag_list *diags);
	/* Places in that text become places in the file. */
	void (*place)(const struct foreign *foreign, struct diag_list *diags);
	void (*forget)(struct foreign *foreign); /* what was read last */
	void (*free)(struct foreign *foreign);
	bool loaded;      /* what was loaded last was one                     */
};
/** ladder_foreign - owned by @ladder from then on; NULL: none. */
void ladder_set_foreign(struct ladder *ladder, struct foreign *foreign);
struct foreign *ladder_foreign(const struct ladder *ladder);
#endif
