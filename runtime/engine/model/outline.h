/* SPDX-License-Identifier: MIT
 *
 * outline - the places of the parts of a project in its canonical text.
 *
 * For programs that replace parts of a text, as the editor does with declarations.
 */
#ifndef MODEL_OUTLINE_H
#define MODEL_OUTLINE_H

#include <stddef.h>

enum text_part {
	TEXT_PART,  /* number of the part, its comments too                   */
	TEXT_POU,   /* number of the POU, from its heading to END_…           */
	TEXT_BLOCK, /* VAR … END_VAR; number in its table                     */
	TEXT_VAR,   /* one declaration, its newline too; number in its table  */
	TEXT_BODY,  /* of a POU: its rungs or its list; number of the POU     */
	TEXT_RUNG,  /* number in its POU                                      */
	TEXT_STRUCT, /* a structure; number in the project                    */
	TEXT_TITLE, /* PROJECT "…" with its newline, or the place for it      */
	TEXT_STEP,  /* of a chart, from its comments to END_STEP; its number  */
	TEXT_TRANSITION, /* likewise                                          */
	TEXT_ACTION,
};
struct text_span {
	enum text_part part;
	int number;         /* 0-based                                        */
	int pou;            /* that contains it; -1: none                     */
	int structure;      /* likewise                                       */
	size_t at, len;     /* bytes                                          */
};

#endif
