/* SPDX-License-Identifier: MIT
 *
 * uses_rows - the cross reference of a document as rows of a list. It shows nothing.
 */
#ifndef EDITOR_USES_ROWS_H
#define EDITOR_USES_ROWS_H

#include "editor-gtk/document/panel.h"
#include "editor-gtk/panels/uses_view.h"
#include "engine/xref/xref.h"

/* Texts of a row. */
enum { USES_NAME, USES_ADDRESS, USES_KIND, USES_PLACE, USES_TEXT };

/* What was found out last: asked again of the same document it need not be anew. */
struct uses_cache {
	struct xref xref;
	LadderDocument *document; /* it is of; compared only                   */
	const struct ladder *checked; /* where its lines are known from; so, too */
	guint64 version;
};

void uses_cache_clear(struct uses_cache *cache);

/**
 * uses_rows - of what is asked for
 * @cache: zeroed first; uses_cache_clear() at the end
 * @document: NULL: none; @symbol: of USES_SYMBOL, in POU @pou, else among the globals
 * Owns: the caller; of LadderPanelRow, in the order of the file, names in that of their
 * declarations.
 */
GPtrArray *uses_rows(struct uses_cache *cache, LadderDocument *document,
		     enum uses_mode mode, int pou, const char *symbol);

#endif
