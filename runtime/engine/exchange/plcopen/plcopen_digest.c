/* SPDX-License-Identifier: MIT
 *
 * plcopen_digest - the same number from a tree of elements and from the text that becomes it.
 */
#include "engine/exchange/plcopen/plcopen_digest.h"

#include <string.h>

#define DIGEST_BEGIN 14695981039346656037u /* FNV-1a */

static uint64_t add(uint64_t digest, const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if ((unsigned char)text[i] > ' ')
			digest = (digest ^ (unsigned char)text[i]) * 1099511628211u;
	return digest;
}

static uint64_t add_number(uint64_t digest, uint64_t number)
{
	for (int i = 0; i < 8; i++)
		digest = (digest ^ ((number >> (8 * i)) & 255)) * 1099511628211u;
	return digest;
}

/* An element begins with its name and its attributes, and ends with its own text. */
static uint64_t begin(uint64_t digest, const char *name, size_t len, uint64_t attributes)
{
	return add_number(add(add(digest, "<", 1), name, len), attributes);
}

static uint64_t end(uint64_t digest, uint64_t text)
{
	return add_number(digest, text);
}

/* ---- of a tree ---- */

bool plcopen_is_own(const struct xml_node *data)
{
	const char *name = xml_is(data, "data") ? xml_value(data, "name") : NULL;

	return name && !strcmp(name, PLCOPEN_OWN);
}

static bool is_skipped(const struct xml_node *node)
{
	return xml_is(node, "addData") && node->first && node->first == node->last && plcopen_is_own(node->first);
}

static uint64_t begin_node(uint64_t digest, const struct xml_node *node)
{
	uint64_t attributes = 0;

	for (const struct xml_attribute *a = node->attribute; a; a = a->next)
		attributes += add(add(add(DIGEST_BEGIN, a->name, strlen(a->name)), "=", 1), a->value, strlen(a->value));
	return begin(digest, node->name, strlen(node->name), attributes);
}

static uint64_t end_node(uint64_t digest, const struct xml_node *node)
{
	return end(digest, add(DIGEST_BEGIN, node->text ? node->text : "", node->text ? strlen(node->text) : 0));
}

uint64_t plcopen_digest(const struct xml_node *root)
{
	const struct xml_node *node = root;
	uint64_t digest = begin_node(DIGEST_BEGIN, root);

	for (;;) {
		const struct xml_node *next = node->first;

		while (next && is_skipped(next))
			next = next->next;
		/* Down, or to the next one beside it or beside what is around it. */
		while (!next) {
			digest = end_node(digest, node);
			if (node == root)
				return digest;
			next = node->next;
			while (next && is_skipped(next))
				next = next->next;
			node = node->parent;
		}
		node = next;
		digest = begin_node(digest, node);
	}
}

/* ---- of a text ---- */

/* In what an export writes, only elements without others in them have text. */
struct scan {
	const char *at, *end;
	uint64_t digest;
	uint64_t text;          /* since the last start of an element            */
	bool alone;             /* no element has ended since then               */
};

static const struct { const char *name; char is; } entities[] = {
	{ "&lt;", '<' }, { "&gt;", '>' }, { "&amp;", '&' }, { "&quot;", '"' },
};

/* Adds text up to @stop, which it leaves at; entities count as what they stand for. */
static uint64_t add_until(struct scan *scan, uint64_t digest, char stop)
{
	while (scan->at < scan->end && *scan->at != stop) {
		size_t len = 1;
		char c = *scan->at;

		for (size_t i = 0; c == '&' && len == 1 && i < sizeof(entities) / sizeof(*entities); i++) {
			const size_t size = strlen(entities[i].name);

			if ((size_t)(scan->end - scan->at) < size || memcmp(scan->at, entities[i].name, size) != 0)
				continue;
			len = size;
			c = entities[i].is;
		}
		digest = add(digest, &c, 1);
		scan->at += len;
	}
	return digest;
}

static size_t word(const struct scan *scan)
{
	size_t len = 0;

	while (scan->at + len < scan->end && !strchr(" \n\t=/>", scan->at[len]))
		len++;
	return len;
}

static void scan_tag(struct scan *scan)
{
	const char *name = scan->at, *colon;
	size_t len = word(scan);
	uint64_t attributes = 0;

	scan->at += len;
	while (scan->at < scan->end && *scan->at != '>' && *scan->at != '/') {
		const char *attribute = scan->at;
		const size_t size = word(scan);
		uint64_t one;

		if (!size) {
			scan->at++;
			continue;
		}
		scan->at += size + 2 < (size_t)(scan->end - scan->at) ? size + 2 : (size_t)(scan->end - scan->at);
		one = add_until(scan, add(add(DIGEST_BEGIN, attribute, size), "=", 1), '"');
		if (size < 5 || memcmp(attribute, "xmlns", 5) != 0)
			attributes += one;
		scan->at += scan->at < scan->end;
	}
	colon = memchr(name, ':', len);
	if (colon) {
		len -= (size_t)(colon + 1 - name);
		name = colon + 1;
	}
	scan->digest = begin(scan->digest, name, len, attributes);
	if (scan->at < scan->end && *scan->at == '/') {
		scan->digest = end(scan->digest, DIGEST_BEGIN);
		scan->at++;
		scan->alone = false;
	} else {
		scan->text = DIGEST_BEGIN;
		scan->alone = true;
	}
	scan->at += scan->at < scan->end;
}

static bool skip(struct scan *scan, const char *text)
{
	const size_t len = strlen(text);

	if ((size_t)(scan->end - scan->at) < len || memcmp(scan->at, text, len) != 0)
		return false;
	scan->at += len;
	return true;
}

static void scan_characters(struct scan *scan)
{
	const char *from = scan->at;

	while (scan->at < scan->end && !skip(scan, "]]>"))
		scan->at++;
	scan->text = add(scan->text, from, (size_t)(scan->at - from) >= 3 ? (size_t)(scan->at - from) - 3 : 0);
}

uint64_t plcopen_digest_text(const char *text, size_t len)
{
	struct scan scan = { .at = text, .end = text + len, .digest = DIGEST_BEGIN };

	while (scan.at < scan.end) {
		scan.text = add_until(&scan, scan.text, '<');
		if (skip(&scan, "<![CDATA[")) {
			scan_characters(&scan);
		} else if (skip(&scan, "</")) {
			scan.digest = end(scan.digest, scan.alone ? scan.text : DIGEST_BEGIN);
			scan.alone = false;
			while (scan.at < scan.end && *scan.at++ != '>')
				;
		} else if (skip(&scan, "<")) {
			scan_tag(&scan);
		}
	}
	return scan.digest;
}
