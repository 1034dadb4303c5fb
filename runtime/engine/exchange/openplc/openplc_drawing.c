/* SPDX-License-Identifier: MIT
 *
 * openplc_drawing - ladders and FBD of OpenPLC Editor as bodies of PLCopen XML.
 *
 * A drawing is nodes and edges. OpenPLC Editor itself compiles by way of this XML, so the order of
 * execution is the one that it means. Where wires divide and meet, it has nodes of their own: they
 * are no elements, and what leads to them leads to what is behind them.
 */
#include "engine/exchange/openplc/openplc_parts.h"

#include <string.h>

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

void put_drawing(struct openplc *c, const struct json *body, bool ld)
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
