/* SPDX-License-Identifier: MIT
 *
 * xml_tree - an XML file as a tree of elements.
 *
 * No entity that a file declares is replaced, nothing outside the file is read, and depth and
 * number of elements are bounded. Namespaces are dropped. The code that converts an element
 * marks it as taken, so that the others can be reported.
 */
#ifndef XML_TREE_H
#define XML_TREE_H

#include "engine/base/arena.h"
#include "engine/base/diag.h"

#include <stdint.h>

struct xml_attribute {
	const char *name, *value;
	bool taken;
	struct xml_attribute *next;
};

struct xml_node {
	const char *name;
	const char *text;       /* all text directly in it; NULL: none or blanks  */
	int line;               /* where its start tag ends; its text begins there */
	bool taken;
	struct xml_attribute *attribute;
	struct xml_node *parent, *first, *last, *next;
};

/**
 * xml_read - the root element of a file
 * @space: gets its namespace; ""
 *
 * Owns: @arena.   Scan-safe: no.   Fails: NULL after a diagnostic.
 */
struct xml_node *xml_read(struct arena *arena, const char *file, const void *bytes, size_t len,
			  const char **space, struct diag_list *diags);
/** xml_is_built - whether this build can read XML. */
bool xml_is_built(void);

/** xml_is - whether @node has this name. */
bool xml_is(const struct xml_node *node, const char *name);
/** xml_next - the element behind @node as the text goes: its first child, else the next outside; NULL: none. */
struct xml_node *xml_next(const struct xml_node *node);
/** xml_child - the first child element @name, marked as taken; NULL: none. */
struct xml_node *xml_child(struct xml_node *node, const char *name);
/** xml_look - the same, and nothing is marked. */
struct xml_node *xml_look(const struct xml_node *node, const char *name);
/** xml_take - an attribute's value, marked as taken; NULL: none. */
const char *xml_take(struct xml_node *node, const char *name);
/** xml_value - the same, and nothing is marked. */
const char *xml_value(const struct xml_node *node, const char *name);
/** xml_flag - whether an attribute is "true" or "1"; marks it. */
bool xml_flag(struct xml_node *node, const char *name);
/** xml_take_all - marks @node, its attributes and all below it. */
void xml_take_all(struct xml_node *node);
/** xml_move - makes @node the last child of @to. */
void xml_move(struct xml_node *node, struct xml_node *to);
/** xml_make - a new last child, marked as taken; NULL: no memory. @name lives as long as @arena. */
struct xml_node *xml_make(struct arena *arena, struct xml_node *parent, const char *name);
/** xml_give - an attribute more, marked as taken. The texts live as long as @arena. */
void xml_give(struct arena *arena, struct xml_node *node, const char *name, const char *value);
/** xml_text - the text of @node and of all elements in it, which are marked; "": none. */
const char *xml_text(struct arena *arena, struct xml_node *node, int *line);
#endif
