/* SPDX-License-Identifier: MIT
 *
 * plcopen_digest - a number that is another one when an element of an XML file says something else.
 *
 * An export writes it beside its own text, and an import compares: so it notices that another tool
 * has changed the drawing. Blanks, the order of attributes, and how characters are escaped do not
 * matter. It is no protection against forged files.
 */
#ifndef PLCOPEN_DIGEST_H
#define PLCOPEN_DIGEST_H

#include "engine/exchange/plcopen/xml_tree.h"

/** PLCOPEN_OWN - the name of the data with the text, and the namespace of what is in it. */
#define PLCOPEN_OWN "urn:rungboard:text"

/** plcopen_digest_text - of the elements in XML as an export writes it. Scan-safe: no. */
uint64_t plcopen_digest_text(const char *text, size_t len);
/** plcopen_digest - of an element, without the text of an export in it. */
uint64_t plcopen_digest(const struct xml_node *node);
/** plcopen_is_own - whether @data is the text of an export. */
bool plcopen_is_own(const struct xml_node *data);
#endif
