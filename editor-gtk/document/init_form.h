/* SPDX-License-Identifier: MIT
 *
 * init_form - the initial values of an array, a structure or an instance as a tree that can
 * be edited.
 *
 * Each value has its default: from the declaration of a member, or 0. Only values other than
 * their default are written. The form has a copy of the project, so the document may change
 * meanwhile. It changes no document.
 */
#ifndef EDITOR_INIT_FORM_H
#define EDITOR_INIT_FORM_H

#include "editor-gtk/document/document.h"

/* A value, or a group of values. */
struct init_node {
	char *name;          /* "Speed", "[3]", "[0..99]"                     */
	char *type;          /* "INT", "Recipe"; of a range of elements ""    */
	bool parts;          /* it has parts and no value of its own          */
	struct init_detail *detail; /* private                               */
};

struct init_form;

/** init_form_has - has a variable of this type parts: is it an array, a structure or an
 * instance with inputs? */
bool init_form_has(const struct project *project, const struct var *var);
/** init_form_new - of variable @index of a table of xref/xref.h, with its initial values.
 * Owns: the caller. Fails: NULL, and @why, which the caller frees. */
struct init_form *init_form_new(LadderDocument *document, int table, int index, char **why);
void init_form_free(struct init_form *form);
/** init_form_root - the variable. All nodes belong to the form. */
struct init_node *init_form_root(struct init_form *form);
/** init_node_parts - of struct init_node; empty for a value. A long array has ranges of 100
 * elements. Borrowed from the form. */
GPtrArray *init_node_parts(struct init_form *form, struct init_node *node);
/** init_node_default - "0"; "" if it has parts. Owns: the caller. */
char *init_node_default(struct init_form *form, struct init_node *node);
/** init_node_text - the given value, "": none; of a node with parts all given values, as they
 * would be written. Owns: the caller. */
char *init_node_text(struct init_form *form, struct init_node *node);
/** init_node_set - gives a value; "": the default. Fails: false, nothing changed, and @why,
 * which the caller frees. */
bool init_node_set(struct init_form *form, struct init_node *node, const char *text,
		   char **why);
/** init_form_is_changed - was a value set since init_form_new()? */
bool init_form_is_changed(const struct init_form *form);

#endif
