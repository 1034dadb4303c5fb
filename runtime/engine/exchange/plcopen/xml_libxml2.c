/* SPDX-License-Identifier: MIT
 *
 * xml_libxml2 - reads XML by the events of libxml2 into a tree of elements.
 *
 * libxml2 builds no tree of its own. It gets no file name and no leave to fetch anything; a
 * declaration of an entity ends the reading.
 */
#include "engine/exchange/plcopen/xml_tree.h"

#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <libxml/xmlerror.h>
#include <stdlib.h>
#include <string.h>

enum {
	MOST_DEEP = 200,          /* elements in one another                   */
	MOST_NODES = 4000000,     /* elements and attributes of a file         */
	NAME_SLOTS = 1024,        /* a power of two                            */
	PIECE = 1 << 20           /* bytes that libxml2 gets at a time         */
};

struct name_entry { struct name_entry *next; char text[]; };

struct reader {
	struct arena *arena;
	const char *file;
	struct diag_list *diags;
	xmlParserCtxt *context;
	struct xml_node *root, *open; /* the innermost element that has no end yet */
	const char *space;        /* namespace of the root                     */
	int depth, nodes;
	bool failed;              /* a message is there                         */
	char *text;               /* of the open element, since its last child */
	size_t len, size;
	struct name_entry *names[NAME_SLOTS];
};

bool xml_is_built(void)
{
	return true;
}

static int line_now(const struct reader *reader)
{
	return reader->context && reader->context->input ? reader->context->input->line : 0;
}

static void fail(struct reader *reader, enum diag_id id, int line, const char *arg)
{
	const struct diag place = { .id = id, .file = reader->file, .line = line };

	if (reader->failed)
		return;
	reader->failed = true;
	diag_add(reader->diags, place, "%.60s", arg);
	if (reader->context)
		xmlStopParser(reader->context);
}

static const char *intern(struct reader *reader, const xmlChar *name)
{
	const char *text = (const char *)name;
	const size_t len = strlen(text);
	uint32_t hash = 5381;
	struct name_entry *entry;

	for (size_t i = 0; i < len; i++)
		hash = hash * 33 + (unsigned char)text[i];
	for (entry = reader->names[hash % NAME_SLOTS]; entry; entry = entry->next)
		if (!strcmp(entry->text, text))
			return entry->text;
	entry = arena_alloc(reader->arena, sizeof(*entry) + len + 1);
	if (!entry)
		return "";
	memcpy(entry->text, text, len + 1);
	entry->next = reader->names[hash % NAME_SLOTS];
	reader->names[hash % NAME_SLOTS] = entry;
	return entry->text;
}

static bool is_blank(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (!strchr(" \t\r\n", text[i]))
			return false;
	return true;
}

/* A tool may write the ends of lines as `&#13;` and a newline. A return alone is no new line in the file. */
static void drop_returns(struct reader *reader)
{
	size_t len = 0;

	for (size_t i = 0; i < reader->len; i++)
		if (reader->text[i] != '\r')
			reader->text[len++] = reader->text[i];
		else if (i + 1 == reader->len || reader->text[i + 1] != '\n')
			reader->text[len++] = ' ';
	reader->len = len;
}

/* Gives the text so far to the open element. */
static void settle_text(struct reader *reader)
{
	struct xml_node *node = reader->open;
	const size_t before = node && node->text ? strlen(node->text) : 0;
	char *whole;

	drop_returns(reader);
	if (node && reader->len && !is_blank(reader->text, reader->len)) {
		whole = arena_alloc(reader->arena, before + reader->len + 1);
		if (whole) {
			memcpy(whole, node->text ? node->text : "", before);
			memcpy(whole + before, reader->text, reader->len);
			node->text = whole;
		}
	}
	reader->len = 0;
}

/* libxml2 leaves an & of an attribute as &#38;, which stands for nothing else there. */
static void plain_ampersands(char *text)
{
	static const char code[] = "&#38;";
	char *to = text;

	for (const char *from = text; *from; to++) {
		*to = *from;
		from += strncmp(from, code, sizeof(code) - 1) ? 1 : sizeof(code) - 1;
	}
	*to = '\0';
}

static void add_attributes(struct reader *reader, struct xml_node *node, int count,
			   const xmlChar **list)
{
	struct xml_attribute **last = &node->attribute;

	for (int i = 0; i < count; i++, list += 5) {
		struct xml_attribute *attribute = arena_alloc(reader->arena, sizeof(*attribute));
		char *value;

		if (!attribute)
			return;
		attribute->name = intern(reader, list[0]);
		value = arena_copy(reader->arena, (const char *)list[3], (size_t)(list[4] - list[3]));
		if (!value)
			return;
		plain_ampersands(value);
		attribute->value = value;
		*last = attribute;
		last = &attribute->next;
	}
	reader->nodes += count;
}

static void begin(void *context, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri,
		  int namespaces, const xmlChar **namespace, int attributes, int defaults,
		  const xmlChar **attribute)
{
	struct reader *reader = context;
	struct xml_node *node;

	(void)prefix;
	(void)namespaces;
	(void)namespace;
	(void)defaults;
	if (reader->failed)
		return;
	settle_text(reader);
	if (++reader->depth > MOST_DEEP || ++reader->nodes > MOST_NODES) {
		fail(reader, DIAG_XML_DEEP, line_now(reader), (const char *)name);
		return;
	}
	node = arena_alloc(reader->arena, sizeof(*node));
	if (!node) {
		fail(reader, DIAG_NO_MEMORY, 0, "");
		return;
	}
	node->name = intern(reader, name);
	node->line = line_now(reader);
	node->parent = reader->open;
	add_attributes(reader, node, attributes, attribute);
	if (!reader->open) {
		reader->root = node;
		reader->space = uri ? intern(reader, uri) : "";
	}
	if (reader->open) {
		if (reader->open->last)
			reader->open->last->next = node;
		else
			reader->open->first = node;
		reader->open->last = node;
	}
	reader->open = node;
}

static void end(void *context, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri)
{
	struct reader *reader = context;

	(void)name;
	(void)prefix;
	(void)uri;
	if (reader->failed || !reader->open)
		return;
	settle_text(reader);
	reader->open = reader->open->parent;
	reader->depth--;
}

static void take_text(void *context, const xmlChar *text, int len)
{
	struct reader *reader = context;
	const size_t wanted = reader->len + (size_t)len;
	char *larger;

	if (reader->failed || !reader->open)
		return;
	if (wanted > reader->size) {
		larger = realloc(reader->text, wanted * 2);
		if (!larger) {
			fail(reader, DIAG_NO_MEMORY, 0, "");
			return;
		}
		reader->text = larger;
		reader->size = wanted * 2;
	}
	memcpy(reader->text + reader->len, text, (size_t)len);
	reader->len = wanted;
}

static void refuse_entity(void *context, const xmlChar *name, int type, const xmlChar *public_id,
			  const xmlChar *system_id, xmlChar *content)
{
	struct reader *reader = context;

	(void)type;
	(void)public_id;
	(void)system_id;
	(void)content;
	fail(reader, DIAG_XML_ENTITY, line_now(reader), (const char *)name);
}

static xmlEntityPtr find_entity(void *context, const xmlChar *name)
{
	(void)context;
	return xmlGetPredefinedEntity(name);
}

static xmlParserInputPtr fetch_nothing(void *context, const xmlChar *public_id,
				       const xmlChar *system_id)
{
	(void)context;
	(void)public_id;
	(void)system_id;
	return NULL;
}

static bool is_cut(const struct reader *reader, int code)
{
	const xmlParserInput *input = reader->context ? reader->context->input : NULL;

	if (code == XML_ERR_DOCUMENT_EMPTY || code == XML_ERR_DOCUMENT_END)
		return true;
	return reader->open && input && input->cur >= input->end;
}

static void take_error(void *context, xmlError *error)
{
	struct reader *reader = context;
	const bool cut = is_cut(reader, error->code);

	if (error->level < XML_ERR_ERROR)
		return;
	if (error->code == XML_ERR_UNDECLARED_ENTITY || error->code == XML_WAR_UNDECLARED_ENTITY)
		fail(reader, DIAG_XML_ENTITY, error->line, error->str1 ? error->str1 : "");
	else if (error->code == XML_ERR_NO_MEMORY)
		fail(reader, DIAG_NO_MEMORY, 0, "");
	else if (cut)
		fail(reader, DIAG_XML_CUT, error->line, reader->open ? reader->open->name : "");
	else
		fail(reader, DIAG_XML_DAMAGED, error->line, reader->open ? reader->open->name : "");
}

static void read_pieces(struct reader *reader, const char *bytes, size_t len)
{
	for (size_t at = 0; at < len && !reader->failed; ) {
		const size_t piece = len - at < PIECE ? len - at : PIECE;

		xmlParseChunk(reader->context, bytes + at, (int)piece, 0);
		at += piece;
	}
	if (!reader->failed)
		xmlParseChunk(reader->context, NULL, 0, 1);
}

struct xml_node *xml_read(struct arena *arena, const char *file, const void *bytes, size_t len,
			  const char **space, struct diag_list *diags)
{
	xmlSAXHandler handler = { .initialized = XML_SAX2_MAGIC, .startElementNs = begin,
		.endElementNs = end, .characters = take_text, .cdataBlock = take_text,
		.entityDecl = refuse_entity, .getEntity = find_entity,
		.resolveEntity = fetch_nothing, .serror = (xmlStructuredErrorFunc)take_error };
	struct reader *reader = calloc(1, sizeof(*reader));
	const struct diag place = { .id = DIAG_NO_MEMORY, .file = file };
	struct xml_node *root = NULL;

	if (!reader) {
		diag_add(diags, place, "%s", "");
		return NULL;
	}
	reader->arena = arena;
	reader->file = file;
	reader->diags = diags;
	reader->context = xmlCreatePushParserCtxt(&handler, reader, NULL, 0, NULL);
	if (reader->context) {
		xmlCtxtUseOptions(reader->context, XML_PARSE_NONET | XML_PARSE_NODICT | XML_PARSE_HUGE);
		read_pieces(reader, bytes, len);
		if (!reader->failed && (!reader->root || reader->open))
			fail(reader, DIAG_XML_CUT, line_now(reader),
			     reader->open ? reader->open->name : "");
		xmlFreeDoc(reader->context->myDoc); /* libxml2 makes one for the declarations of a DTD */
		reader->context->myDoc = NULL;
		xmlFreeParserCtxt(reader->context);
	}
	if (!reader->context || arena->failed)
		diag_add(diags, place, "%s", "");
	else if (!reader->failed)
		root = reader->root;
	*space = root ? reader->space : "";
	free(reader->text);
	free(reader);
	return root;
}
