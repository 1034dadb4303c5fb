/* SPDX-License-Identifier: MIT
 *
 * type_edit - adds, duplicates and deletes structures, and moves their members.
 *
 * Each edit is one step of the history, made as a change of the text. Fields of members are
 * edited with symbols.h.
 */
#ifndef EDITOR_TYPE_EDIT_H
#define EDITOR_TYPE_EDIT_H

#include "editor-gtk/document/document.h"

/** type_find - the structure of this name, in any case; -1: none. */
int type_find(LadderDocument *document, const char *name);
/** type_table - the table of its members, for symbols.h and xref/xref.h. */
int type_table(LadderDocument *document, int structure);
/** type_is_included - is it declared in another file? Then it cannot be changed. */
bool type_is_included(LadderDocument *document, int structure);
/** type_free_name - a name for a new structure made of @like: Recipe2. Owns: the caller. */
char *type_free_name(LadderDocument *document, const char *like);
/** type_name_refusal - why a new structure cannot have this name, translated; NULL: it can.
 * Owns: the caller. */
char *type_name_refusal(LadderDocument *document, const char *name);
/** type_add - adds a structure with one member. Fails: false, and @why, which the caller
 * frees. */
bool type_add(LadderDocument *document, const char *name, char **why);
/** type_duplicate - adds a copy with another name behind it. Fails: as type_add(). */
bool type_duplicate(LadderDocument *document, int structure, const char *name, char **why);
/** type_uses - the number of places that use a structure, without its declaration. */
int type_uses(LadderDocument *document, int structure);
/** type_delete - deletes it and the variables and members of this type. Fails: as
 * type_add(): it is in another file, or something cannot be read without it. */
bool type_delete(LadderDocument *document, int structure, char **why);
/** type_add_member - adds a member behind member @behind, with its type; -1: the first one.
 * @name: gets its name, which the caller frees. Fails: as type_add(). */
bool type_add_member(LadderDocument *document, int structure, int behind, char **name,
		     char **why);
/** type_move_member - @to: its place afterwards. Fails: as type_add(). */
bool type_move_member(LadderDocument *document, int structure, int from, int to, char **why);

#endif
