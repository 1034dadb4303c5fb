/* SPDX-License-Identifier: MIT
 *
 * openplc_parts - what the files of this room share. Only they include it.
 */
#ifndef OPENPLC_PARTS_H
#define OPENPLC_PARTS_H

#include "engine/exchange/import.h"
#include "engine/exchange/openplc/json.h"

struct openplc {
	struct import *import;
	const char *root;        /* the folder of the project                      */
	const char *own;         /* the name of project.json in it; "": it is the file that was given */
	struct writing w;        /* the XML                                        */
	int pous, elements, drawn; /* elements: in the file; drawn: that the XML has */
	bool failed;
};

/** openplc_fail - a diagnostic at the place in work. Returns false. */
bool openplc_fail(struct openplc *c, enum diag_id id, const char *what);
/** xml_written - @text with the five entities of XML, as an attribute or a text. */
const char *xml_written(struct openplc *c, const char *text);
/** put_body - the body that a drawing has. @ld: a ladder, else FBD. */
void put_drawing(struct openplc *c, const struct json *body, bool ld);
#endif
