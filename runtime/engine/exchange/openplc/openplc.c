/* SPDX-License-Identifier: MIT
 *
 * openplc - a project of OpenPLC Editor 4: a folder with project.json and a file for each POU.
 *
 * It becomes a project in PLCopen XML, as it does when OpenPLC Editor compiles it, and
 * exchange/plcopen/ reads that. Each line of the XML remembers its place in the project.
 * The file of a drawn POU opens alone, too, without the other files of its project.
 */
#include "engine/exchange/import.h"
#include "engine/exchange/openplc/json.h"

#include "engine/base/ascii.h"
#include "engine/base/file.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILES_MOST = 1000 };

struct openplc {
	struct import *import;
	const char *root;        /* the folder of the project                      */
	const char *own;         /* the name of project.json in it; "": it is the file that was given */
	struct writing w;        /* the XML                                        */
	int pous, elements, drawn; /* elements: in the file; drawn: that the XML has */
	bool failed;
};

static const char *const kinds[][3] = {
	{ "programs", "program", "PROGRAM" }, { "functions", "function", "FUNCTION" },
	{ "function-blocks", "functionBlock", "FUNCTION_BLOCK" },
};

/* A diagnostic at the place in work. */
static bool openplc_fail(struct openplc *c, enum diag_id id, const char *what)
{
	struct diag place = { .id = id, .file = c->import->path, .line = c->w.at.line };

	if (*c->w.at.member)
		place.file = w_text(&c->w, "%s/%s", c->root, c->w.at.member);
	if (!c->failed)
		diag_add(c->import->diags, place, "%.60s", what);
	c->failed = true;
	return false;
}

/* @text with the five entities of XML, as an attribute or a text. */
static const char *xml_written(struct openplc *c, const char *text)
{
	static const char *const entity[] = { "&amp;", "&lt;", "&gt;", "&quot;", "&apos;" };
	static const char bytes[] = "&<>\"'";
	char *out = arena_alloc(c->w.arena, 6 * strlen(text) + 1);
	size_t len = 0;

	for (; out && *text; text++) {
		const char *special = strchr(bytes, *text);

		if (special) {
			memcpy(out + len, entity[special - bytes], strlen(entity[special - bytes]));
			len += strlen(entity[special - bytes]);
		} else {
			out[len++] = (unsigned char)*text < ' ' ? ' ' : *text;
		}
	}
	return out ? out : "";
}

/* ---- drawings ----
 *
 * Ladders and FBD become bodies of PLCopen XML.
 * A drawing is nodes and edges. OpenPLC Editor itself compiles by way of this XML, so the order of
 * execution is the one that it means. Where wires divide and meet, it has nodes of their own: they
 * are no elements, and what leads to them leads to what is behind them. */

struct edge { const char *source, *target, *source_pin, *target_pin; int next; };

/* One rung, or one sheet of FBD. */
struct graph {
	struct openplc *c;
	struct names ids;
	const struct json **node; int nodes;
	int *of; int of_count;   /* by the id of a node's name: its number, from 1 on */
	struct edge *edge; int edges;
	int *first_edge;         /* by the number of their target; -1: none        */
	int first_local;         /* localId of node 0                              */
	int y;                   /* of the rung: rungs stand below one another     */
	int *seen, round;        /* of each node: the search that met it last      */
};

static int node_of(struct graph *g, const char *id)
{
	const uint32_t name = names_find(&g->ids, id, strlen(id));

	return name && (int)name < g->of_count ? g->of[name] - 1 : -1;
}

static const struct json *data_of(const struct json *node)
{
	return json_get(node, "data");
}

static bool is(const struct json *node, const char *type)
{
	return !strcmp(json_text(node, "type"), type);
}

static bool take_nodes(struct graph *g, const struct json *drawing)
{
	const struct json *node = json_items(json_get(drawing, "nodes"));

	for (; node; node = node->next) {
		const char *id = json_text(node, "id");
		const uint32_t name = names_intern(&g->ids, id, strlen(id));
		const struct json **slot = arena_push(g->c->w.arena, &g->node, &g->nodes, sizeof(*slot));

		if (!slot)
			return false;
		*slot = node;
		g->c->w.at.line = node->line;
		while ((uint32_t)g->of_count <= name)
			if (!arena_push(g->c->w.arena, &g->of, &g->of_count, sizeof(*g->of)))
				return false;
		if (!name || g->of[name])
			return openplc_fail(g->c, DIAG_OPENPLC_NODE, id);
		g->of[name] = g->nodes;
	}
	return true;
}

static bool take_edges(struct graph *g, const struct json *drawing)
{
	const struct json *each = json_items(json_get(drawing, "edges"));

	g->first_edge = arena_alloc(g->c->w.arena, sizeof(int) * ((size_t)g->nodes + 1));
	g->seen = arena_alloc(g->c->w.arena, sizeof(int) * ((size_t)g->nodes + 1));
	if (!g->first_edge || !g->seen)
		return false;
	for (int i = 0; i < g->nodes; i++)
		g->first_edge[i] = -1;
	for (; each; each = each->next) {
		struct edge edge = { json_text(each, "source"), json_text(each, "target"),
				     json_text(each, "sourceHandle"), json_text(each, "targetHandle"), -1 };
		const int target = node_of(g, edge.target);
		struct edge *slot;

		g->c->w.at.line = each->line;
		if (target < 0 || node_of(g, edge.source) < 0)
			return openplc_fail(g->c, DIAG_OPENPLC_EDGE, target < 0 ? edge.target : edge.source);
		slot = arena_push(g->c->w.arena, &g->edge, &g->edges, sizeof(*slot));
		if (!slot)
			return false;
		/* Behind the others of its target: their order stays. */
		*slot = edge;
		int *last = &g->first_edge[target];

		while (*last >= 0)
			last = &g->edge[*last].next;
		*last = g->edges - 1;
	}
	return true;
}

/* ---- connections ---- */

static void put_connection(struct graph *g, int source, const char *pin)
{
	struct writing *w = &g->c->w;
	const bool block = is(g->node[source], "block");

	w_put(w, "<connection refLocalId=\"%d\"", g->first_local + source);
	if (block && *pin)
		w_put(w, " formalParameter=\"%s\"", xml_written(g->c, pin));
	w_put(w, "/>");
}

/* What leads to a node, through the places where wires divide and meet. A node is met once in a
 * search, so a circle of such places ends. @pin: "" for all edges. */
static void put_sources(struct graph *g, int target, const char *pin, int depth)
{
	const struct json *data = data_of(g->node[target]);
	const char *serial = json_text(json_get(data, "inputConnector"), "id");

	if (depth > 200) {
		openplc_fail(g->c, DIAG_OPENPLC_NODE, json_text(g->node[target], "id"));
		return;
	}
	/* A wire that meets another comes below it. */
	for (int below = 0; below < 2; below++)
		for (int i = g->first_edge[target]; i >= 0; i = g->edge[i].next) {
			const struct edge *edge = &g->edge[i];
			const int source = node_of(g, edge->source);
			const bool first = !*serial || !strcmp(edge->target_pin, serial);

			if (first == (below == 1) || (*pin && strcmp(edge->target_pin, pin) != 0) ||
			    is(g->node[source], "variable"))
				continue;
			if (!is(g->node[source], "parallel")) {
				put_connection(g, source, *edge->source_pin && is(g->node[source], "block") ?
					       edge->source_pin :
					       json_text(json_get(data_of(g->node[source]), "outputConnector"), "id"));
			} else if (g->seen[source] != g->round) {
				g->seen[source] = g->round;
				put_sources(g, source, "", depth + 1);
			}
		}
}

static void put_inputs(struct graph *g, int target, const char *pin)
{
	g->round++;
	w_put(&g->c->w, "<connectionPointIn>");
	put_sources(g, target, pin, 0);
	w_put(&g->c->w, "</connectionPointIn>");
}

/* ---- elements ---- */

static void put_head(struct graph *g, int i, const char *element)
{
	const struct json *node = g->node[i], *position = json_get(node, "position");
	const int order = json_int(data_of(node), "executionOrder");

	g->c->w.at.line = node->line;
	w_put(&g->c->w, "<%s localId=\"%d\" width=\"%d\" height=\"%d\"", element, g->first_local + i,
	      json_int(node, "width"), json_int(node, "height"));
	if (order > 0)
		w_put(&g->c->w, " executionOrderId=\"%d\"", order);
	(void)position;
}

static void put_position(struct graph *g, int i)
{
	const struct json *position = json_get(g->node[i], "position");

	w_put(&g->c->w, "><position x=\"%d\" y=\"%d\"/>", json_int(position, "x"),
	      json_int(position, "y") + g->y);
}

static const char *variable_name(const struct json *node)
{
	return json_text(json_get(data_of(node), "variable"), "name");
}

static void put_contact(struct graph *g, int i, bool coil)
{
	struct writing *w = &g->c->w;
	const char *variant = json_text(data_of(g->node[i]), "variant");
	const char *element = coil ? "coil" : "contact";

	put_head(g, i, element);
	if (!strcmp(variant, "negated"))
		w_put(w, " negated=\"true\"");
	if (!strcmp(variant, "risingEdge") || !strcmp(variant, "fallingEdge"))
		w_put(w, " edge=\"%s\"", *variant == 'r' ? "rising" : "falling");
	if (coil && (!strcmp(variant, "set") || !strcmp(variant, "reset")))
		w_put(w, " storage=\"%s\"", variant);
	put_position(g, i);
	put_inputs(g, i, "");
	w_put(w, "<connectionPointOut/><variable>%s</variable></%s>\n",
	      xml_written(g->c, variable_name(g->node[i])), element);
}

/* The variable that a ladder has at a pin of a block; -1: none. */
static int variable_at(const struct graph *g, const char *block, const char *pin, const char *variant)
{
	for (int i = 0; i < g->nodes; i++) {
		const struct json *data = data_of(g->node[i]), *at = json_get(data, "block");

		if (is(g->node[i], "variable") && !strcmp(json_text(at, "id"), block) &&
		    !strcmp(json_text(at, "handleId"), pin) && !strcmp(json_text(data, "variant"), variant) &&
		    *variable_name(g->node[i]))
			return i;
	}
	return -1;
}

static bool has_edge(const struct graph *g, int target, const char *pin)
{
	for (int i = g->first_edge[target]; i >= 0; i = g->edge[i].next)
		if (!strcmp(g->edge[i].target_pin, pin))
			return true;
	return false;
}

static void put_block(struct graph *g, int i, bool ld)
{
	struct writing *w = &g->c->w;
	const struct json *node = g->node[i], *data = data_of(node), *variant = json_get(data, "variant");
	const char *power = json_text(json_get(data, "inputConnector"), "id"), *id = json_text(node, "id");

	put_head(g, i, "block");
	w_put(w, " typeName=\"%s\"", xml_written(g->c, json_text(variant, "name")));
	if (!strcmp(json_text(variant, "type"), "function-block"))
		w_put(w, " instanceName=\"%s\"", xml_written(g->c, variable_name(node)));
	put_position(g, i);
	w_put(w, "<inputVariables>");
	for (const struct json *pin = json_items(json_get(data, "inputHandles")); pin; pin = pin->next) {
		const char *name = json_text(pin, "id");
		const int variable = ld ? variable_at(g, id, name, "input") : -1;

		if (variable < 0 && !has_edge(g, i, name))
			continue;
		w_put(w, "<variable formalParameter=\"%s\">", xml_written(g->c, name));
		if (variable >= 0 && strcmp(name, power) != 0) {
			w_put(w, "<connectionPointIn>");
			put_connection(g, variable, "");
			w_put(w, "</connectionPointIn>");
		} else {
			put_inputs(g, i, name);
		}
		w_put(w, "</variable>");
	}
	w_put(w, "</inputVariables><inOutVariables/><outputVariables>");
	for (const struct json *pin = json_items(json_get(data, "outputHandles")); pin; pin = pin->next)
		w_put(w, "<variable formalParameter=\"%s\"><connectionPointOut/></variable>",
		      xml_written(g->c, json_text(pin, "id")));
	w_put(w, "</outputVariables></block>\n");
}

/* A variable of a ladder belongs to a pin; one of FBD has edges. */
static void put_variable_node(struct graph *g, int i, bool input, bool ld)
{
	struct writing *w = &g->c->w;
	const struct json *data = data_of(g->node[i]), *at = json_get(data, "block"), *negated = json_get(data, "negated");
	const char *element = input ? "inVariable" : "outVariable";
	const int block = ld ? node_of(g, json_text(at, "id")) : -1;

	put_head(g, i, element);
	if (negated && negated->kind == JSON_TRUE)
		w_put(w, " negated=\"true\"");
	put_position(g, i);
	if (input) {
		w_put(w, "<connectionPointOut/>");
	} else if (ld) {
		w_put(w, "<connectionPointIn>");
		if (block >= 0)
			put_connection(g, block, json_text(at, "handleId"));
		w_put(w, "</connectionPointIn>");
	} else {
		put_inputs(g, i, "");
	}
	w_put(w, "<expression>%s</expression></%s>\n", xml_written(g->c, variable_name(g->node[i])), element);
}

static void put_named(struct graph *g, int i, bool connector)
{
	struct writing *w = &g->c->w;
	const char *element = connector ? "connector" : "continuation";

	put_head(g, i, element);
	w_put(w, " name=\"%s\"", xml_written(g->c, variable_name(g->node[i])));
	put_position(g, i);
	if (connector)
		put_inputs(g, i, "");
	else
		w_put(w, "<connectionPointOut/>");
	w_put(w, "</%s>\n", element);
}

static void put_note(struct openplc *c, int local, int y, const char *text)
{
	w_put(&c->w, "<comment localId=\"%d\" width=\"100\" height=\"10\"><position x=\"0\" y=\"%d\"/>"
	      "<content><xhtml:p>%s</xhtml:p></content></comment>\n", local, y, xml_written(c, text));
}

/* false: no element of this kind is known. */
static bool put_node(struct graph *g, int i, bool ld)
{
	const struct json *node = g->node[i], *data = data_of(node);
	const char *variant = json_text(data, "variant");

	if (is(node, "powerRail")) {
		const bool left = !strcmp(variant, "left");

		put_head(g, i, left ? "leftPowerRail" : "rightPowerRail");
		put_position(g, i);
		if (left)
			w_put(&g->c->w, "<connectionPointOut formalParameter=\"\"/></leftPowerRail>\n");
		else
			put_inputs(g, i, "");
		if (!left)
			w_put(&g->c->w, "</rightPowerRail>\n");
	} else if (is(node, "contact") || is(node, "coil")) {
		put_contact(g, i, is(node, "coil"));
	} else if (is(node, "block")) {
		put_block(g, i, ld);
	} else if (is(node, "variable")) {
		if (*variable_name(node))
			put_variable_node(g, i, !strcmp(variant, "input"), true);
	} else if (is(node, "input-variable") || is(node, "output-variable")) {
		put_variable_node(g, i, is(node, "input-variable"), false);
	} else if (is(node, "connector") || is(node, "continuation")) {
		put_named(g, i, is(node, "connector"));
	} else if (is(node, "comment")) {
		put_note(g->c, g->first_local + i, g->y + json_int(json_get(node, "position"), "y"),
			 json_text(data, "content"));
	} else {
		return is(node, "parallel") || is(node, "placeholder") || is(node, "parallelPlaceholder");
	}
	return true;
}

static int put_graph(struct openplc *c, const struct json *drawing, bool ld, int local, int y)
{
	struct graph g = { .c = c, .first_local = local, .y = y };

	names_init(&g.ids, c->w.arena);
	if (!take_nodes(&g, drawing) || !take_edges(&g, drawing))
		return local;
	for (int i = 0; i < g.nodes && !c->failed; i++) {
		c->w.at.line = g.node[i]->line;
		c->elements++;
		if (put_node(&g, i, ld))
			c->drawn++;
		else
			w_tell(&c->w, REPORT_LOST, "this element is not known: %s",
			       w_string(&c->w, json_text(g.node[i], "type"), 60));
	}
	return local + g.nodes;
}

static void put_drawing(struct openplc *c, const struct json *body, bool ld)
{
	const struct json *rung = json_items(json_get(body, "rungs"));
	int local = 1, y = 0;

	w_put(&c->w, ld ? "<body><LD>\n" : "<body><FBD>\n");
	if (!ld)
		put_graph(c, json_get(body, "rung"), false, local, 0);
	for (; ld && rung && !c->failed; rung = rung->next) {
		const struct json *size = json_items(json_get(rung, "reactFlowViewport"));
		const char *note = json_text(rung, "comment");
		const double height = size && size->next ? json_int(&(struct json){ .kind = JSON_OBJECT,
			.first = &(struct json){ .kind = JSON_NUMBER, .key = "y", .text = size->next->text } }, "y") : 0;

		c->w.at.line = rung->line;
		if (*note)
			put_note(c, local++, y, note);
		local = put_graph(c, rung, true, local, y + 20);
		y += (height > 100 && height < 100000 ? (int)height : 100) + 20;
	}
	w_put(&c->w, ld ? "</LD></body>\n" : "</FBD></body>\n");
}

/* ---- the project ---- */

/* ---- declarations ---- */

static bool is_elementary(const char *type)
{
	static const char *const words[] = {
		"BOOL", "BYTE", "WORD", "DWORD", "LWORD", "SINT", "INT", "DINT", "LINT", "USINT", "UINT",
		"UDINT", "ULINT", "REAL", "LREAL", "TIME", "DATE", "TOD", "DT",
	};

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (ascii_is(words[i], type, strlen(type)))
			return true;
	return false;
}

static const char *upper(struct openplc *c, const char *text)
{
	char *copy = arena_copy(c->w.arena, text, strlen(text));

	for (char *at = copy; at && *at; at++)
		*at = ascii_upper(*at);
	return copy ? copy : "";
}

static void put_type(struct openplc *c, const char *type);

/* `ARRAY [0..3, 1..2] OF INT` */
static void put_array(struct openplc *c, const char *type)
{
	struct lex lex;

	lex_init(&lex, type, strlen(type));
	lex_next(&lex);
	w_put(&c->w, "<array>");
	while (lex_next(&lex) != TOKEN_END && !lex_is(&lex, "OF")) {
		const char *from = lex.token.text, *dots, *to;

		if (lex_is(&lex, "[") || lex_is(&lex, ",") || lex_is(&lex, "]"))
			continue;
		to = from + strcspn(from, ",]");
		dots = strstr(from, "..");
		if (!dots || dots > to)
			break;
		w_put(&c->w, "<dimension lower=\"%s\" upper=\"%s\"/>",
		      xml_written(c, w_text(&c->w, "%.*s", (int)(dots - from), from)),
		      xml_written(c, w_text(&c->w, "%.*s", (int)(to - dots - 2), dots + 2)));
		lex.at = to;
	}
	w_put(&c->w, "<baseType>");
	put_type(c, lex.token.kind == TOKEN_END ? "INT" : lex.at + strspn(lex.at, " \t\r\n"));
	w_put(&c->w, "</baseType></array>");
}

/* An element of a type. */
static void put_type(struct openplc *c, const char *type)
{
	if (ascii_prefix("ARRAY", type, strlen(type)) && strstr(type, "[") && !c->w.arena->failed)
		put_array(c, type);
	else if (ascii_is("STRING", type, strlen(type)))
		w_put(&c->w, "<string/>");
	else if (is_elementary(type))
		w_put(&c->w, "<%s/>", upper(c, type));
	else
		w_put(&c->w, "<derived name=\"%s\"/>", xml_written(c, type));
}

/* A declaration; "" for what it does not have. */
static void put_variable(struct openplc *c, const char *name, const char *type, const char *address,
			 const char *initial, const char *note)
{
	struct writing *w = &c->w;

	w_put(w, "<variable name=\"%s\"", xml_written(c, name));
	if (*address)
		w_put(w, " address=\"%s\"", xml_written(c, address));
	w_put(w, "><type>");
	put_type(c, type);
	w_put(w, "</type>");
	if (*initial)
		w_put(w, "<initialValue><simpleValue value=\"%s\"/></initialValue>", xml_written(c, initial));
	if (*note)
		w_put(w, "<documentation><xhtml:p>%s</xhtml:p></documentation>", xml_written(c, note));
	w_put(w, "</variable>\n");
}

static const char *list_of(const char *word, size_t len)
{
	static const char *const lists[][2] = {
		{ "VAR", "localVars" }, { "VAR_INPUT", "inputVars" }, { "VAR_OUTPUT", "outputVars" },
		{ "VAR_IN_OUT", "inOutVars" }, { "VAR_EXTERNAL", "externalVars" }, { "VAR_TEMP", "tempVars" },
		{ "VAR_GLOBAL", "globalVars" },
	};

	for (size_t i = 0; i < sizeof(lists) / sizeof(*lists); i++)
		if (ascii_is(lists[i][0], word, len))
			return lists[i][1];
	return NULL;
}

/* A text of the file without blanks around it. */
static const char *piece(struct openplc *c, const char *from, const char *to)
{
	while (from < to && strchr(" \t\r\n", *from))
		from++;
	while (to > from && strchr(" \t\r\n", to[-1]))
		to--;
	return w_text(&c->w, "%.*s", (int)(to - from), from);
}

/* `name : type AT %IX0.0 := value; (* note *)`, from its name on. The address stands behind the type. */
static bool read_declaration(struct openplc *c, struct lex *lex)
{
	const char *name = piece(c, lex->token.text, lex->token.text + lex->token.len);
	const char *address = "", *initial = "", *note = "", *from, *to;
	struct lex ahead;
	const int line = lex->token.line;

	c->w.at.line = line;
	if (lex->token.kind != TOKEN_NAME)
		return openplc_fail(c, DIAG_OPENPLC_TEXT, name);
	lex_next(lex);
	if (lex_is(lex, "AT")) {
		lex_next(lex);
		address = piece(c, lex->token.text, lex->token.text + lex->token.len);
		lex_next(lex);
	}
	if (!lex_is(lex, ":"))
		return openplc_fail(c, DIAG_OPENPLC_TEXT, name);
	from = to = lex->at;
	while (lex_next(lex) != TOKEN_END && !lex_is(lex, ";") && !lex_is(lex, ":=") && !lex_is(lex, "AT"))
		to = lex->at;
	const char *type = piece(c, from, to);

	if (lex_is(lex, "AT")) {
		lex_next(lex);
		address = piece(c, lex->token.text, lex->token.text + lex->token.len);
		lex_next(lex);
	}
	if (lex_is(lex, ":=")) {
		from = to = lex->at;
		while (lex_next(lex) != TOKEN_END && !lex_is(lex, ";"))
			to = lex->at;
		initial = piece(c, from, to);
	}
	if (!lex_is(lex, ";") || !*type)
		return openplc_fail(c, DIAG_OPENPLC_TEXT, name);
	ahead = *lex;
	ahead.comments = true;
	if (lex_next(&ahead) == TOKEN_COMMENT && ahead.token.line == lex->token.line && ahead.token.len > 4)
		note = piece(c, ahead.token.text + 2, ahead.token.text + ahead.token.len - (ahead.token.text[1] == '*' ? 2 : 0));
	put_variable(c, name, type, address, initial, note);
	return true;
}

/* The lists of variables in front of a body. */
static bool read_interface(struct openplc *c, struct lex *lex)
{
	const char *list;
	struct lex before = *lex;

	while ((list = lex_next(lex) == TOKEN_NAME ? list_of(lex->token.text, lex->token.len) : NULL)) {
		c->w.at.line = lex->token.line;
		w_put(&c->w, "<%s", list);
		lex_next(lex);
		while (lex_is(lex, "CONSTANT") || lex_is(lex, "RETAIN") || lex_is(lex, "NON_RETAIN")) {
			w_put(&c->w, " %s=\"true\"", lex_is(lex, "CONSTANT") ? "constant" :
			      lex_is(lex, "RETAIN") ? "retain" : "nonretain");
			lex_next(lex);
		}
		w_put(&c->w, ">\n");
		while (!lex_is(lex, "END_VAR")) {
			if (lex->token.kind == TOKEN_END)
				return openplc_fail(c, DIAG_OPENPLC_TEXT, "END_VAR");
			if (!read_declaration(c, lex))
				return false;
			lex_next(lex);
		}
		w_put(&c->w, "</%s>\n", list);
		before = *lex;
	}
	*lex = before;
	return true;
}

/* ---- POUs ---- */

/* Lines of a text as CDATA; each remembers its place. */
static void put_text_body(struct openplc *c, const char *text, const char *end, int line, bool il)
{
	w_put(&c->w, il ? "<body><IL><xhtml:p><![CDATA[" : "<body><ST><xhtml:p><![CDATA[");
	while (text < end) {
		const char *next = memchr(text, '\n', (size_t)(end - text));
		const char *to = next ? next : end;
		const char *copy = w_text(&c->w, "%.*s", (int)(to - text), text);

		c->w.at.line = line++;
		for (const char *mark; (mark = strstr(copy, "]]>")); copy = mark + 2)
			w_put(&c->w, "%.*s]]><![CDATA[", (int)(mark + 2 - copy), copy);
		w_put(&c->w, "%s\n", copy);
		text = next ? next + 1 : end;
	}
	w_put(&c->w, il ? "]]></xhtml:p></IL></body>\n" : "]]></xhtml:p></ST></body>\n");
}

/* Where the POU ends: its last END_…. NULL: there is none. */
static const char *find_end(const char *text, size_t len, const char *word)
{
	const size_t size = strlen(word);

	for (size_t at = len; at >= size + 4; at--)
		if (!memcmp(text + at - size - 4, "END_", 4) && ascii_same(text + at - size, word, size))
			return text + at - size - 4;
	return NULL;
}

static bool read_pou(struct openplc *c, const char *text, size_t len, int kind, const char *ending)
{
	const char *end = find_end(text, len, kinds[kind][2]), *note = "", *behind;
	struct lex lex;

	lex_init(&lex, text, len);
	lex.comments = true;
	c->w.at.line = 1;
	if (lex_next(&lex) == TOKEN_COMMENT && lex.token.len > 4) {
		note = piece(c, lex.token.text + 2, lex.token.text + lex.token.len - 2);
		lex_next(&lex);
	}
	lex.comments = false;
	c->w.at.line = lex.token.line;
	if (!lex_is(&lex, kinds[kind][2]) || lex_next(&lex) != TOKEN_NAME)
		return openplc_fail(c, DIAG_OPENPLC_TEXT, kinds[kind][2]);
	if (!end)
		return openplc_fail(c, DIAG_OPENPLC_TEXT, w_text(&c->w, "END_%s", kinds[kind][2]));
	lex.end = end;
	w_put(&c->w, "<pou name=\"%s\" pouType=\"%s\"><interface>\n",
	      xml_written(c, w_text(&c->w, "%.*s", (int)lex.token.len, lex.token.text)), kinds[kind][1]);
	if (kind == 1) {
		lex_next(&lex);
		lex_next(&lex);
		w_put(&c->w, "<returnType>");
		put_type(c, w_text(&c->w, "%.*s", (int)lex.token.len, lex.token.text));
		w_put(&c->w, "</returnType>\n");
	}
	if (!read_interface(c, &lex))
		return false;
	w_put(&c->w, "</interface>\n");
	behind = lex.at;
	if (!strcmp(ending, "st") || !strcmp(ending, "il")) {
		put_text_body(c, behind, end, lex.token.line, *ending == 'i');
	} else {
		int line = lex.token.line;
		const struct json *body = json_read(c->w.arena, behind, (size_t)(end - behind), &line, &behind);

		c->w.at.line = line;
		if (!body || behind + strspn(behind, " \t\r\n") < end)
			return openplc_fail(c, DIAG_OPENPLC_JSON, "");
		put_drawing(c, body, !strcmp(ending, "ld"));
	}
	if (*note)
		w_put(&c->w, "<documentation><xhtml:p>%s</xhtml:p></documentation>\n", xml_written(c, note));
	w_put(&c->w, "</pou>\n");
	c->pous++;
	return !c->failed;
}

/* POUs of an older version, which stand in project.json itself. */
static void put_old_pou(struct openplc *c, const struct json *pou)
{
	static const char *const classes[][2] = {
		{ "local", "localVars" }, { "input", "inputVars" }, { "output", "outputVars" },
		{ "inOut", "inOutVars" }, { "external", "externalVars" }, { "temp", "tempVars" },
	};
	const struct json *data = json_get(pou, "data"), *body = json_get(data, "body"), *value = json_get(body, "value");
	const char *type = json_text(pou, "type"), *language = json_text(body, "language");

	c->w.at.line = pou->line;
	w_put(&c->w, "<pou name=\"%s\" pouType=\"%s\"><interface>\n", xml_written(c, json_text(data, "name")),
	      !strcmp(type, "function-block") ? "functionBlock" : !strcmp(type, "function") ? "function" : "program");
	if (*json_text(data, "returnType")) {
		w_put(&c->w, "<returnType>");
		put_type(c, json_text(data, "returnType"));
		w_put(&c->w, "</returnType>\n");
	}
	for (size_t i = 0; i < sizeof(classes) / sizeof(*classes); i++) {
		w_put(&c->w, "<%s>\n", classes[i][1]);
		for (const struct json *each = json_items(json_get(data, "variables")); each; each = each->next) {
			c->w.at.line = each->line;
			if (!strcmp(json_text(each, "class"), classes[i][0]))
				put_variable(c, json_text(each, "name"), json_text(json_get(each, "type"), "value"),
					     json_text(each, "location"), json_text(each, "initialValue"),
					     json_text(each, "documentation"));
		}
		w_put(&c->w, "</%s>\n", classes[i][1]);
	}
	w_put(&c->w, "</interface>\n");
	if (!strcmp(language, "ld") || !strcmp(language, "fbd"))
		put_drawing(c, value, *language == 'l');
	else if (value && value->kind == JSON_TEXT)
		put_text_body(c, value->text, value->text + strlen(value->text), value->line,
			      !strcmp(language, "il"));
	else
		w_put(&c->w, "<body><ST><xhtml:p></xhtml:p></ST></body>\n");
	w_put(&c->w, "</pou>\n");
	c->pous++;
}

/* ---- files ---- */

static int by_name(const void *a, const void *b)
{
	return strcmp(*(const char *const *)a, *(const char *const *)b);
}

struct file_names { const char **name; int count; };

static struct file_names names_in(struct openplc *c, const char *folder)
{
	struct file_names files = { NULL, 0 };
	DIR *dir = opendir(w_text(&c->w, "%s/%s", c->root, folder));
	const struct dirent *each;

	while (dir && files.count < FILES_MOST && (each = readdir(dir))) {
		const char **slot = each->d_name[0] == '.' ? NULL :
				    arena_push(c->w.arena, &files.name, &files.count, sizeof(*slot));

		if (slot)
			*slot = w_text(&c->w, "%s/%s", folder, each->d_name);
	}
	if (dir)
		closedir(dir);
	if (files.count)
		qsort(files.name, (size_t)files.count, sizeof(*files.name), by_name);
	return files;
}

static void read_file_of(struct openplc *c, const char *member, int kind)
{
	static const char *const known[] = { "st", "il", "ld", "fbd" };
	const char *dot = strrchr(member, '.'), *ending = dot ? dot + 1 : "";
	bool is_known = false;
	size_t len;
	char *text;

	c->w.at = (struct foreign_place){ member, 0 };
	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++)
		is_known = is_known || !strcmp(known[i], ending);
	if (!is_known) {
		w_tell(&c->w, REPORT_LOST, "its language has no equivalent; write it in Structured Text");
		return;
	}
	text = file_read(w_text(&c->w, "%s/%s", c->root, member), LIMIT_TEXT, &len, c->import->diags);
	if (!text || !utf8_valid(text, len, NULL)) {
		if (text)
			openplc_fail(c, DIAG_OPENPLC_TEXT, "UTF-8");
		c->failed = true;
	} else {
		read_pou(c, text, len, kind, ending);
	}
	free(text);
}

/* ---- types, tasks ---- */

static void put_data_type(struct openplc *c, const struct json *type)
{
	struct writing *w = &c->w;
	const char *derivation = json_text(type, "derivation"), *initial = json_text(type, "initialValue");

	w->at.line = type->line;
	w_put(w, "<dataType name=\"%s\"><baseType>", xml_written(c, json_text(type, "name")));
	if (!strcmp(derivation, "array")) {
		w_put(w, "<array>");
		for (const struct json *each = json_items(json_get(type, "dimensions")); each; each = each->next) {
			const char *bounds = json_text(each, "dimension"), *dots = strstr(bounds, "..");

			if (dots)
				w_put(w, "<dimension lower=\"%s\" upper=\"%s\"/>",
				      xml_written(c, w_text(w, "%.*s", (int)(dots - bounds), bounds)), xml_written(c, dots + 2));
		}
		w_put(w, "<baseType>");
		put_type(c, json_text(json_get(type, "baseType"), "value"));
		w_put(w, "</baseType></array>");
	} else if (!strcmp(derivation, "enumerated")) {
		w_put(w, "<enum><values>");
		for (const struct json *each = json_items(json_get(type, "values")); each; each = each->next)
			w_put(w, "<value name=\"%s\"/>", xml_written(c, json_text(each, "description")));
		w_put(w, "</values></enum>");
	} else {
		w_put(w, "<struct>\n");
		for (const struct json *each = json_items(json_get(type, "variable")); each; each = each->next) {
			const struct json *of = json_get(each, "type"), *array = json_get(of, "data");
			const char *name = json_text(of, "value");

			w->at.line = each->line;
			if (array && json_items(json_get(array, "dimensions"))) {
				name = "ARRAY[";
				for (const struct json *at = json_items(json_get(array, "dimensions")); at; at = at->next)
					name = w_text(w, "%s%s%s", name, json_text(at, "dimension"), at->next ? ", " : "");
				name = w_text(w, "%s] OF %s", name, json_text(json_get(array, "baseType"), "value"));
			}
			put_variable(c, json_text(each, "name"), name, "",
				     json_text(json_get(json_get(each, "initialValue"), "simpleValue"), "value"), "");
		}
		w_put(w, "</struct>");
	}
	w_put(w, "</baseType>");
	if (*initial)
		w_put(w, "<initialValue><simpleValue value=\"%s\"/></initialValue>", xml_written(c, initial));
	w_put(w, "</dataType>\n");
}

/* The values of an enumeration, from its ( on, up to the ) that ends it. */
static bool read_values(struct openplc *c, struct lex *lex)
{
	w_put(&c->w, "<enum><values>");
	do {
		if (lex_next(lex) != TOKEN_NAME)
			return openplc_fail(c, DIAG_OPENPLC_TEXT, piece(c, lex->token.text, lex->token.text + lex->token.len));
		c->w.at.line = lex->token.line;
		w_put(&c->w, "<value name=\"%s\"", xml_written(c, piece(c, lex->token.text, lex->token.text + lex->token.len)));
		lex_next(lex);
		if (lex_is(lex, ":=")) {
			const char *from = lex->at;

			while (lex_next(lex) != TOKEN_END && !lex_is(lex, ",") && !lex_is(lex, ")"))
				;
			w_put(&c->w, " value=\"%s\"", xml_written(c, piece(c, from, lex->token.text)));
		}
		w_put(&c->w, "/>");
	} while (lex_is(lex, ","));
	w_put(&c->w, "</values></enum>");
	return lex_is(lex, ")") || openplc_fail(c, DIAG_OPENPLC_TEXT, ")");
}

static bool read_members(struct openplc *c, struct lex *lex)
{
	w_put(&c->w, "<struct>\n");
	for (lex_next(lex); !lex_is(lex, "END_STRUCT"); lex_next(lex)) {
		if (lex->token.kind == TOKEN_END)
			return openplc_fail(c, DIAG_OPENPLC_TEXT, "END_STRUCT");
		if (!read_declaration(c, lex))
			return false;
	}
	w_put(&c->w, "</struct>");
	return true;
}

/* `Name : STRUCT … END_STRUCT;`, `Name : (Red, Green) := Red;`, `Name : ARRAY[1..3] OF INT;`, from its name on. */
static bool read_type(struct openplc *c, struct lex *lex)
{
	const char *name = piece(c, lex->token.text, lex->token.text + lex->token.len), *from;
	struct lex first;

	c->w.at.line = lex->token.line;
	if (lex->token.kind != TOKEN_NAME || (lex_next(lex), !lex_is(lex, ":")))
		return openplc_fail(c, DIAG_OPENPLC_TEXT, name);
	w_put(&c->w, "<dataType name=\"%s\"><baseType>", xml_written(c, name));
	from = lex->at;
	first = *lex;
	lex_next(&first);
	if (lex_is(&first, "STRUCT") || lex_is(&first, "(")) {
		*lex = first;
		if (lex_is(lex, "(") ? !read_values(c, lex) : !read_members(c, lex))
			return false;
		lex_next(lex);
	} else {
		while (lex_next(lex) != TOKEN_END && !lex_is(lex, ";") && !lex_is(lex, ":="))
			;
		put_type(c, piece(c, from, lex->token.text));
	}
	w_put(&c->w, "</baseType>");
	if (lex_is(lex, ":=")) {
		from = lex->at;
		while (lex_next(lex) != TOKEN_END && !lex_is(lex, ";"))
			;
		w_put(&c->w, "<initialValue><simpleValue value=\"%s\"/></initialValue>",
		      xml_written(c, piece(c, from, lex->token.text)));
	}
	w_put(&c->w, "</dataType>\n");
	return lex_is(lex, ";") || lex_is(lex, "END_TYPE") || openplc_fail(c, DIAG_OPENPLC_TEXT, name);
}

static bool is_types(const char *member)
{
	const char *dot = strrchr(member, '.');

	return dot && !strcmp(dot, ".dt");
}

/* datatypes/Motor.dt: text between TYPE and END_TYPE. */
static void read_types_of(struct openplc *c, const char *member)
{
	struct lex lex;
	size_t len;
	char *text;

	c->w.at = (struct foreign_place){ member, 0 };
	text = file_read(w_text(&c->w, "%s/%s", c->root, member), LIMIT_TEXT, &len, c->import->diags);
	if (!text) {
		c->failed = true;
		return;
	}
	lex_init(&lex, text, len);
	lex_next(&lex);
	c->w.at.line = lex.token.line;
	if (!utf8_valid(text, len, NULL) || !lex_is(&lex, "TYPE"))
		openplc_fail(c, DIAG_OPENPLC_TEXT, "TYPE");
	while (!c->failed && !lex_is(&lex, "END_TYPE") && lex_next(&lex) != TOKEN_END && !lex_is(&lex, "END_TYPE"))
		read_type(c, &lex);
	if (!c->failed && !lex_is(&lex, "END_TYPE"))
		openplc_fail(c, DIAG_OPENPLC_TEXT, "END_TYPE");
	free(text);
}

/* A file of a type replaces what project.json says of it. */
static void put_data_types(struct openplc *c, const struct json *data)
{
	const struct file_names files = names_in(c, "datatypes");

	for (const struct json *type = json_items(json_get(data, "dataTypes")); type; type = type->next) {
		const char *member = w_text(&c->w, "datatypes/%s.dt", json_text(type, "name"));
		bool has_file = false;

		for (int i = 0; i < files.count; i++)
			has_file = has_file || ascii_is(files.name[i], member, strlen(member));
		if (!has_file)
			put_data_type(c, type);
	}
	for (int i = 0; i < files.count && !c->failed; i++)
		if (is_types(files.name[i]))
			read_types_of(c, files.name[i]);
	c->w.at = (struct foreign_place){ c->own, 0 };
}

static void put_configuration(struct openplc *c, const struct json *resource)
{
	struct writing *w = &c->w;
	const struct json *each, *instance;

	w_put(w, "<instances><configurations><configuration name=\"Config0\"><resource name=\"Res0\">\n");
	for (each = json_items(json_get(resource, "tasks")); each; each = each->next) {
		const char *name = json_text(each, "name");

		w->at.line = each->line;
		w_put(w, "<task name=\"%s\" priority=\"%d\"", xml_written(c, name), json_int(each, "priority"));
		if (!strcmp(json_text(each, "triggering"), "Cyclic"))
			w_put(w, " interval=\"%s\"", xml_written(c, json_text(each, "interval")));
		else
			w_tell(w, REPORT_CHANGED, "task %s has no event here; it runs in each cycle", name);
		w_put(w, ">\n");
		for (instance = json_items(json_get(resource, "instances")); instance; instance = instance->next)
			if (!strcmp(json_text(instance, "task"), name))
				w_put(w, "<pouInstance name=\"%s\" typeName=\"%s\"/>\n",
				      xml_written(c, json_text(instance, "name")), xml_written(c, json_text(instance, "program")));
		w_put(w, "</task>\n");
	}
	w_put(w, "</resource>\n");
	each = json_items(json_get(resource, "globalVariables"));
	if (each)
		w_put(w, "<globalVars>\n");
	for (const struct json *global = each; global; global = global->next) {
		w->at.line = global->line;
		put_variable(c, json_text(global, "name"), json_text(json_get(global, "type"), "value"),
			     json_text(global, "location"), json_text(global, "initialValue"),
			     json_text(global, "documentation"));
	}
	w_put(w, "%s</configuration></configurations></instances>\n", each ? "</globalVars>\n" : "");
}

/* What is in the project and no program. */
static void tell_others(struct openplc *c, const struct json *data)
{
	static const char *const lists[] = { "servers", "remoteDevices", "dataLoggers" };
	static const char *const folders[] = { "devices", "datatypes", "libraries" };

	for (size_t i = 0; i < sizeof(lists) / sizeof(*lists); i++)
		for (const struct json *each = json_items(json_get(data, lists[i])); each; each = each->next) {
			c->w.at = (struct foreign_place){ c->own, each->line };
			w_tell(&c->w, REPORT_LOST, "%s is no part of the program: give its points a device in an I/O map",
			       w_string(&c->w, json_text(each, "name"), 60));
		}
	for (size_t i = 0; i < sizeof(folders) / sizeof(*folders); i++) {
		const struct file_names files = names_in(c, folders[i]);

		for (int k = 0; k < files.count; k++) {
			if (i == 1 && is_types(files.name[k]))
				continue;
			c->w.at = (struct foreign_place){ files.name[k], 0 };
			w_tell(&c->w, REPORT_LOST, "this file has no meaning here");
		}
	}
}

/* ---- the whole ---- */

static void put_header(struct openplc *c, const char *name)
{
	w_put(&c->w, "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\" xmlns:xhtml=\"http://www.w3.org/1999/xhtml\">\n"
	      "<fileHeader companyName=\"\" productName=\"OpenPLC Editor\" productVersion=\"4\" creationDateTime=\"2024-01-01T00:00:00\"/>\n"
	      "<contentHeader name=\"%s\"><coordinateInfo><fbd><scaling x=\"1\" y=\"1\"/></fbd><ld><scaling x=\"1\" y=\"1\"/></ld>"
	      "<sfc><scaling x=\"1\" y=\"1\"/></sfc></coordinateInfo></contentHeader>\n<types>\n<dataTypes>\n",
	      xml_written(c, name));
}

static bool put_project(struct openplc *c, const struct json *project)
{
	const struct json *data = json_get(project, "data");
	struct writing *w = &c->w;

	put_header(c, json_text(json_get(project, "meta"), "name"));
	put_data_types(c, data);
	w_put(w, "</dataTypes>\n<pous>\n");
	for (const struct json *pou = json_items(json_get(data, "pous")); pou && !c->failed; pou = pou->next)
		put_old_pou(c, pou);
	for (int kind = 0; kind < 3; kind++) {
		const struct file_names files = names_in(c, w_text(w, "pous/%s", kinds[kind][0]));

		for (int i = 0; i < files.count && !c->failed; i++)
			read_file_of(c, files.name[i], kind);
	}
	w->at = (struct foreign_place){ c->own, 0 };
	w_put(w, "</pous>\n</types>\n");
	put_configuration(c, json_get(json_get(data, "configuration"), "resource"));
	w_put(w, "</project>\n");
	if (!c->pous && !c->failed) {
		w->at.line = 0;
		return openplc_fail(c, DIAG_OPENPLC_EMPTY, "");
	}
	tell_others(c, data);
	return !c->failed;
}

static struct foreign_place place_of(const struct openplc *c, int line)
{
	return line > 0 && line <= c->w.out.lines ? c->w.out.place[line - 1] :
						    (struct foreign_place){ "", 0 };
}

/* Places in the XML become places in the project. */
static bool convert(struct openplc *c)
{
	struct import *import = c->import;
	const int lines = import->report->count, diags = import->diags->count;
	struct import *const xml = arena_alloc(import->arena, sizeof(*xml));
	bool good;

	if (!xml)
		return false;
	*xml = *import;
	xml->bytes = c->w.out.text;
	xml->len = c->w.out.len;
	good = plcopen_format.read(xml);

	for (int i = lines; i < import->report->count; i++) {
		struct report_line *line = &import->report->line[i];
		const struct foreign_place place = place_of(c, line->line);

		if (line->line)
			line->member = place.member;
		line->line = place.line;
	}
	for (int i = diags; i < import->diags->count; i++) {
		struct diag *diag = &import->diags->diag[i];
		const struct foreign_place place = place_of(c, diag->line);

		if (*place.member)
			diag->file = w_text(&c->w, "%s/%s", c->root, place.member);
		diag->line = place.line;
		diag->column = 0;
	}
	if (!good)
		return false;
	import->text = xml->text;
	import->drawings = xml->drawings;
	for (int i = 0; i < xml->drawings.count; i++)
		xml->drawings.one[i].line = place_of(c, xml->drawings.one[i].line).line;
	for (int i = 0; i < xml->text.lines; i++)
		xml->text.place[i] = place_of(c, xml->text.place[i].line);
	return true;
}

/* ---- recognising a project ---- */

static bool has(const char *bytes, size_t len, const char *word)
{
	const size_t size = strlen(word);

	for (size_t i = 0; i + size <= len && i < 400; i++)
		if (!memcmp(bytes + i, word, size))
			return true;
	return false;
}

/* A row of kinds if it is the file of one drawn POU: the drawing begins with its name. Else -1. */
static int drawn_kind(const char *text, size_t len, const char **ending)
{
	const char *end = text + len, *brace = text;
	struct lex lex;

	lex_init(&lex, text, len);
	if (lex_next(&lex) != TOKEN_NAME)
		return -1;
	for (int kind = 0; kind < 3; kind++) {
		if (!lex_is(&lex, kinds[kind][2]))
			continue;
		while ((brace = memchr(brace, '{', (size_t)(end - brace)))) {
			const char *at = ++brace;

			while (at < end && strchr(" \t\r\n", *at))
				at++;
			if (end - at < 7 || memcmp(at, "\"name\"", 6) != 0)
				continue;
			*ending = has(at, (size_t)(end - at), "\"rungs\"") ? "ld" : "fbd";
			return has(at, (size_t)(end - at), "\"rung") ? kind : -1;
		}
		return -1;
	}
	return -1;
}

/* The other POUs, the tasks and the global variables stand in files that nobody named. */
static bool put_drawn_pou(struct openplc *c, const char *text, size_t len, int kind, const char *ending)
{
	put_header(c, "");
	w_put(&c->w, "</dataTypes>\n<pous>\n");
	if (!utf8_valid(text, len, NULL))
		return openplc_fail(c, DIAG_OPENPLC_TEXT, "UTF-8");
	if (!read_pou(c, text, len, kind, ending))
		return false;
	c->w.at.line = 0;
	w_put(&c->w, "</pous>\n</types>\n<instances><configurations/></instances>\n</project>\n");
	w_tell(&c->w, REPORT_LOST, "the tasks, global variables and other POUs of its project are in other files: "
	       "open the folder with project.json");
	return !c->failed;
}

static bool read(struct import *import)
{
	struct openplc c = { .import = import };
	const char *slash = strrchr(import->path, '/'), *end, *ending = "";
	const int kind = import->bytes ? drawn_kind(import->bytes, import->len, &ending) : -1;
	const struct json *project = NULL;
	struct diag place = { .id = DIAG_NO_MEMORY, .file = import->path };
	int line = 1;
	size_t len = 0;
	char *text = NULL;

	writing_init(&c.w, import->arena, import->report);
	c.root = import->bytes ? slash ? w_text(&c.w, "%.*s", (int)(slash - import->path), import->path) : "." :
		 import->path;
	c.own = import->bytes ? "" : "project.json";
	c.w.at = (struct foreign_place){ c.own, 0 };
	if (kind >= 0 && !put_drawn_pou(&c, import->bytes, import->len, kind, ending))
		return false;
	if (!import->bytes)
		text = file_read(w_text(&c.w, "%s/project.json", c.root), LIMIT_TEXT, &len, import->diags);
	if (!import->bytes && !text)
		return false;
	if (import->bytes)
		len = import->len;
	if (kind < 0) {
		project = json_read(import->arena, text ? text : import->bytes, len, &line, &end);
		free(text);
		c.w.at.line = line;
		if (!project)
			return openplc_fail(&c, DIAG_OPENPLC_JSON, "");
		if (!put_project(&c, project))
			return false;
	}
	if (!import->arena->failed && convert(&c))
		return true;
	return import->arena->failed && diag_add(import->diags, place, "%s", "");
}

static bool is_project(const void *bytes, size_t len)
{
	const char *text = bytes;
	size_t at = 0;

	while (at < len && text[at] && strchr(" \t\r\n", text[at]))
		at++;
	return at < len && text[at] == '{' && has(text, len, "\"plc-project\"");
}

static bool is_own(const void *bytes, size_t len)
{
	const char *ending;

	return is_project(bytes, len) || drawn_kind(bytes, len, &ending) >= 0;
}

static bool is_folder(const char *path)
{
	char name[600], head[400];
	const int len = snprintf(name, sizeof(name), "%s/project.json", path);
	FILE *file = len > 0 && (size_t)len < sizeof(name) ? fopen(name, "rb") : NULL;
	size_t got = 0;

	if (file) {
		got = fread(head, 1, sizeof(head), file);
		fclose(file);
	}
	return is_project(head, got);
}

const struct import_format openplc_format = { "OpenPLC Editor", is_own, is_folder, read, true };
