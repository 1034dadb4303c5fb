/* SPDX-License-Identifier: MIT
 *
 * property - what a file says about its project: the rows of properties.def.
 */
#ifndef MODEL_PROPERTY_H
#define MODEL_PROPERTY_H

enum property {
#define PROPERTY(word, name, key) PROPERTY_##word,
#include "engine/properties.def"
	PROPERTY_COUNT
};
struct property_row {
	const char *word;       /* in a rung file: AUTHOR                      */
	const char *name;       /* "author"                                    */
	const char *key;        /* in ClassicLadder; NULL: none                */
};

/** property_row - Static. Scan-safe: no. */
const struct property_row *property_row(enum property property);

#endif
