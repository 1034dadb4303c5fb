/* SPDX-License-Identifier: MIT
 *
 * texts - what stands in the text of a document.
 */
#ifndef TESTS_EDITOR_TEXTS_H
#define TESTS_EDITOR_TEXTS_H

#include "editor-gtk/document/document.h"

#include <stdio.h>
#include <string.h>

/** document_has - does the text of @document have @part? If not, the text is printed. */
static inline bool document_has(LadderDocument *document, const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool found = strstr(text, part);

	if (!found)
		printf("# lacks %s:\n# %s\n", part, text);
	g_free(text);
	return found;
}

#endif
