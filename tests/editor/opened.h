/* SPDX-License-Identifier: MIT
 *
 * opened - a document with a text that can be read.
 */
#ifndef TESTS_EDITOR_OPENED_H
#define TESTS_EDITOR_OPENED_H

#include "editor-gtk/document/document.h"
#include "tests/tap.h"

#include <string.h>

/** opened - Owns: the caller. */
static inline LadderDocument *opened(const char *text)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(ladder_document_project(document));
	return document;
}

#endif
