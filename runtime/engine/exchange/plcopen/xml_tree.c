/* SPDX-License-Identifier: MIT
 *
 * xml_tree - finding elements and attributes in a tree of elements.
 */
#include "engine/exchange/plcopen/xml_tree.h"

#include <string.h>

bool xml_is(const struct xml_node *node, const char *name)
{
	return !strcmp(node->name, name);
}

struct xml_node *xml_next(const struct xml_node *node)
{
	if (node->first)
		return node->first;
	while (node && !node->next)
		node = node->parent;
	return node ? node->next : NULL;
}

struct xml_node *xml_look(const struct xml_node *node, const char *name)
{
	struct xml_node *child = node ? node->first : NULL;

	while (child && !xml_is(child, name))
		child = child->next;
	return child;
}

struct xml_node *xml_child(struct xml_node *node, const char *name)
{
	struct xml_node *child = xml_look(node, name);

	if (child)
		child->taken = true;
	return child;
}

static struct xml_attribute *find(const struct xml_node *node, const char *name)
{
	struct xml_attribute *attribute = node ? node->attribute : NULL;

	while (attribute && strcmp(attribute->name, name) != 0)
		attribute = attribute->next;
	return attribute;
}

const char *xml_value(const struct xml_node *node, const char *name)
{
	const struct xml_attribute *attribute = find(node, name);

	return attribute ? attribute->value : NULL;
}

const char *xml_take(struct xml_node *node, const char *name)
{
	struct xml_attribute *attribute = find(node, name);

	if (!attribute)
		return NULL;
	attribute->taken = true;
	return attribute->value;
}

bool xml_flag(struct xml_node *node, const char *name)
{
	const char *value = xml_take(node, name);

	return value && (!strcmp(value, "true") || !strcmp(value, "1"));
}

/* The next element in the order of the file, below @root only. */
static struct xml_node *after(struct xml_node *node, const struct xml_node *root)
{
	if (node->first)
		return node->first;
	while (node != root && !node->next)
		node = node->parent;
	return node == root ? NULL : node->next;
}

void xml_take_all(struct xml_node *node)
{
	for (struct xml_node *each = node; each; each = after(each, node)) {
		each->taken = true;
		for (struct xml_attribute *a = each->attribute; a; a = a->next)
			a->taken = true;
	}
}

static void append(struct xml_node *node, struct xml_node *to)
{
	node->parent = to;
	node->next = NULL;
	if (to->last)
		to->last->next = node;
	else
		to->first = node;
	to->last = node;
}

void xml_move(struct xml_node *node, struct xml_node *to)
{
	struct xml_node *from = node->parent, *before = NULL;

	for (struct xml_node *each = from->first; each != node; each = each->next)
		before = each;
	if (before)
		before->next = node->next;
	else
		from->first = node->next;
	if (from->last == node)
		from->last = before;
	append(node, to);
}

struct xml_node *xml_make(struct arena *arena, struct xml_node *parent, const char *name)
{
	struct xml_node *node = arena_alloc(arena, sizeof(*node));

	if (!node)
		return NULL;
	*node = (struct xml_node){ .name = name, .line = parent->line, .taken = true };
	append(node, parent);
	return node;
}

void xml_give(struct arena *arena, struct xml_node *node, const char *name, const char *value)
{
	struct xml_attribute *attribute = arena_alloc(arena, sizeof(*attribute));

	if (!attribute)
		return;
	*attribute = (struct xml_attribute){ .name = name, .value = value, .taken = true, .next = node->attribute };
	node->attribute = attribute;
}

const char *xml_text(struct arena *arena, struct xml_node *node, int *line)
{
	const struct xml_node *only = NULL;
	size_t len = 0, at = 0;
	int texts = 0;
	char *all;

	if (!node)
		return "";
	xml_take_all(node);
	for (struct xml_node *each = node; each; each = after(each, node))
		if (each->text) {
			only = only ? only : each;
			len += strlen(each->text) + 1;
			texts++;
		}
	if (line)
		*line = only ? only->line : node->line;
	if (texts < 2)
		return only ? only->text : "";
	all = arena_alloc(arena, len + 1);
	for (struct xml_node *each = node; all && each; each = after(each, node))
		if (each->text) {
			const size_t part = strlen(each->text);

			if (at)
				all[at++] = '\n';
			memcpy(all + at, each->text, part);
			at += part;
		}
	return all ? all : "";
}
