/* SPDX-License-Identifier: MIT
 *
 * type_edit - adds, duplicates and deletes data types, moves members of structures, and edits
 * enumerations and subranges.
 *
 * A type is a number: structures by their number in the project, behind them its other types with
 * a name. Each edit is one step of the history, made as a change of the text. Fields of members,
 * and the declaration of a type that is no structure, are edited with symbols.h.
 */
#ifndef EDITOR_TYPE_EDIT_H
#define EDITOR_TYPE_EDIT_H

#include "editor-gtk/document/document.h"

#include "engine/xref/xref.h"

enum type_kind {
	TYPE_STRUCTURE, TYPE_ENUMERATION, TYPE_SUBRANGE, TYPE_ARRAY, TYPE_ALIAS,
	TYPE_KINDS
};

/** type_count - numbers of types are below this. */
int type_count(const struct project *project);
/** type_is - is there a type with this number? A name that is used before its declaration was
 * read has a number, too. */
bool type_is(const struct project *project, int type);
/** type_name - its name. Borrowed until the document changes. */
const char *type_name(const struct project *project, int type);
/** type_like - the declaration of a type that is no structure; NULL: it is one. Borrowed. */
const struct var *type_like(const struct project *project, int type);
enum type_kind type_kind_of(const struct project *project, int type);
/** type_kind_name - "enumeration", translated. Static. */
const char *type_kind_name(enum type_kind kind);
/** type_order - the numbers of all types (int) in the order of the file. Owns: the caller. */
GArray *type_order(const struct project *project);
/** type_find - the type of this name, in any case; -1: none. */
int type_find(LadderDocument *document, const char *name);
/** type_table - the table of its members or its declaration, for symbols.h and xref/xref.h. */
int type_table(LadderDocument *document, int type);
/** type_target - what uses of it name. */
struct xref_target type_target(const struct project *project, int type);
/** type_is_included - is it declared in another file? Then it cannot be changed. */
bool type_is_included(LadderDocument *document, int type);
/** type_free_name - a name for a new type made of @like: Recipe2. Owns: the caller. */
char *type_free_name(LadderDocument *document, const char *like);
/** type_name_refusal - why a new type cannot have this name, translated; NULL: it can.
 * Owns: the caller. */
char *type_name_refusal(LadderDocument *document, const char *name);
/** type_add - adds a type: a structure with one member, an enumeration with two values, 0..100.
 * Fails: false, and @why, which the caller frees. */
bool type_add(LadderDocument *document, enum type_kind kind, const char *name, char **why);
/** type_duplicate - adds a copy with another name behind it. Fails: as type_add(). */
bool type_duplicate(LadderDocument *document, int type, const char *name, char **why);
/** type_uses - the number of places that use a type or its values, without its declaration. */
int type_uses(LadderDocument *document, int type);
/** type_delete - deletes it and the variables and members of this type. Fails: as
 * type_add(): it is in another file, or something cannot be read without it. */
bool type_delete(LadderDocument *document, int type, char **why);
/** type_add_member - adds a member behind member @behind, with its type; -1: the first one.
 * @name: gets its name, which the caller frees. Fails: as type_add(). */
bool type_add_member(LadderDocument *document, int structure, int behind, char **name,
		     char **why);
/** type_move_member - @to: its place afterwards. Fails: as type_add(). */
bool type_move_member(LadderDocument *document, int structure, int from, int to, char **why);

/* ---- enumerations and subranges ---- */

/* They fail as type_add(). */

/** type_base - INT; "": an enumeration that names none. Owns: the caller. */
char *type_base(const struct project *project, int type);
bool type_set_base(LadderDocument *document, int type, const char *base, char **why);
/** type_bound - the lowest or @high value of a subrange, as written. Owns: the caller. */
char *type_bound(const struct project *project, int type, bool high);
bool type_set_bound(LadderDocument *document, int type, bool high, const char *text, char **why);
/** type_value - the number in the project of value @index of an enumeration; -1: none. */
int type_value(const struct project *project, int type, int index);
/** type_rename_value - wherever it is used. */
bool type_rename_value(LadderDocument *document, int type, int index, const char *name,
		       char **why);
/** type_set_number - @number: "": one more than the value before. */
bool type_set_number(LadderDocument *document, int type, int index, const char *number,
		     char **why);
/** type_add_value - adds one behind value @behind; -1: the first one. @name: gets its name, which
 * the caller frees. */
bool type_add_value(LadderDocument *document, int type, int behind, char **name, char **why);
/** type_delete_value - not the only one. */
bool type_delete_value(LadderDocument *document, int type, int index, char **why);
/** type_move_value - @to: its place afterwards. */
bool type_move_value(LadderDocument *document, int type, int from, int to, char **why);

#endif
