/* SPDX-License-Identifier: MIT
 *
 * plcopen_declare - types, values to begin with, and variables.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_NESTED = 16 };

/* The element of a type: the first child that says one. */
static struct xml_node *type_in(struct xml_node *node)
{
	struct xml_node *child = node ? node->first : NULL;

	while (child && (xml_is(child, "addData") || xml_is(child, "documentation")))
		child = child->next;
	return child;
}

static const char *dimensions(struct plcopen *c, struct xml_node *array)
{
	const char *comma = "";
	struct plc_build all;

	plc_build(&all);
	for (struct xml_node *each = array->first; each; each = each->next) {
		const char *low, *high;

		if (!xml_is(each, "dimension"))
			continue;
		each->taken = true;
		low = xml_take(each, "lower");
		high = xml_take(each, "upper");
		if (!low || !*low || !high || !*high)
			plc_add(&all, "%s*", comma);
		else
			plc_add(&all, "%s%s..%s", comma, plc_renamed(c, low), plc_renamed(c, high));
		comma = ", ";
	}
	return plc_built(c, &all);
}

static const char *enumeration(struct plcopen *c, struct xml_node *node)
{
	struct xml_node *values = xml_child(node, "values"), *base = xml_child(node, "baseType");
	const char *comma = "", *list;
	struct plc_build all;

	plc_build(&all);
	for (struct xml_node *each = values ? values->first : NULL; each; each = each->next) {
		const char *name, *value;

		if (!xml_is(each, "value"))
			continue;
		each->taken = true;
		name = xml_take(each, "name");
		value = xml_take(each, "value");
		plc_add_text(&all, comma);
		plc_add_text(&all, plc_renamed(c, name ? name : ""));
		if (value && *value) {
			plc_add_text(&all, " := ");
			plc_add_text(&all, value);
		}
		comma = ", ";
	}
	list = plc_built(c, &all);
	return base ? plc_print(c, "%s (%s)", plc_type(c, base), list) : plc_print(c, "(%s)", list);
}

static const char *subrange(struct plcopen *c, struct xml_node *node)
{
	struct xml_node *range = xml_child(node, "range"), *base = xml_child(node, "baseType");
	const char *low = xml_take(range, "lower"), *high = xml_take(range, "upper");

	return plc_print(c, "%s (%s..%s)", base ? plc_type(c, base) : "INT", low ? low : "0",
			 high ? high : "0");
}

/* A structure without a name. */
static const char *structure(struct plcopen *c, struct xml_node *node)
{
	struct plc_build all;

	plc_build(&all);
	for (struct xml_node *each = node->first; each; each = each->next) {
		const char *name, *value;

		if (!xml_is(each, "variable"))
			continue;
		each->taken = true;
		name = xml_take(each, "name");
		value = plc_value(c, each);
		plc_add_text(&all, plc_print(c, "%s : %s", plc_renamed(c, name ? name : ""),
					     plc_type(c, xml_child(each, "type"))));
		plc_add_text(&all, value ? " := " : "");
		plc_add_text(&all, value ? value : "");
		plc_add_text(&all, "; ");
		if (xml_look(each, "documentation"))
			xml_look(each, "documentation")->taken = false;
	}
	return plc_print(c, "STRUCT %sEND_STRUCT", plc_built(c, &all));
}

/* Types that an extension of Beremiz adds: svghmi/pous.xml. */
static const struct { const char *name, *means; } added_types[] = {
	{ "HMI_SINT", "SINT" }, { "HMI_INT", "INT" }, { "HMI_DINT", "DINT" }, { "HMI_LINT", "LINT" },
	{ "HMI_USINT", "USINT" }, { "HMI_UINT", "UINT" }, { "HMI_UDINT", "UDINT" }, { "HMI_ULINT", "ULINT" },
	{ "HMI_REAL", "REAL" }, { "HMI_LREAL", "LREAL" }, { "HMI_STRING", "STRING" }, { "HMI_BOOL", "BOOL" },
	{ "HMI_NODE", "BOOL" }, { "HMI_LABEL", "STRING" },
};

/* Whether the project has a type of this name. */
static bool plc_data_type(const struct plcopen *c, const char *name)
{
	for (const struct xml_node *each = c->types ? c->types->first : NULL; each; each = each->next)
		if (xml_is(each, "dataType") && xml_value(each, "name") &&
		    plc_same(xml_value(each, "name"), name))
			return true;
	return false;
}

static const char *known_type(struct plcopen *c, struct xml_node *type, const char *name)
{
	for (size_t i = 0; i < sizeof(added_types) / sizeof(*added_types); i++)
		if (plc_same(added_types[i].name, name) && !plc_data_type(c, name)) {
			plc_report(c, REPORT_CHANGED, type,
				   report_said(c->report, REPORTED("the type %s of another program is %s here")),
				   name, added_types[i].means);
			return added_types[i].means;
		}
	return plc_renamed(c, plc_without_library(c, name));
}

static const char *text_type(struct plcopen *c, struct xml_node *type)
{
	const char *length = xml_take(type, "length");

	if (ascii_upper(type->name[0]) == 'W')
		plc_report(c, REPORT_CHANGED, type, "%s",
			   report_said(c->report, REPORTED("a WSTRING becomes a STRING, which holds any letters as UTF-8")));
	return length && *length ? plc_print(c, "STRING[%s]", length) : "STRING";
}

const char *plc_type(struct plcopen *c, struct xml_node *node)
{
	struct xml_node *type = type_in(node);
	const char *name;

	if (!type)
		return "";
	type->taken = true;
	if (plc_same(type->name, "string") || plc_same(type->name, "wstring"))
		return text_type(c, type);
	if (xml_is(type, "array"))
		return plc_print(c, "ARRAY[%s] OF %s", dimensions(c, type),
				 plc_type(c, xml_child(type, "baseType")));
	if (xml_is(type, "enum"))
		return enumeration(c, type);
	if (xml_is(type, "subrangeSigned") || xml_is(type, "subrangeUnsigned"))
		return subrange(c, type);
	if (xml_is(type, "struct"))
		return structure(c, type);
	if (xml_is(type, "pointer") || xml_is(type, "reference"))
		return plc_print(c, "%s %s", xml_is(type, "pointer") ? "POINTER TO" : "REFERENCE TO",
				 plc_type(c, xml_child(type, "baseType")));
	name = xml_is(type, "derived") ? xml_take(type, "name") : NULL;
	if (name)
		return known_type(c, type, name);
	name = plc_print(c, "%s", type->name);
	for (char *at = (char *)name; *at; at++)
		*at = ascii_upper(*at);
	return name;
}

/* ---- values ---- */

static const char *inner_value(struct plcopen *c, struct xml_node *value, int depth);

static const char *array_value(struct plcopen *c, struct xml_node *node, int depth)
{
	const char *comma = "";
	struct plc_build all;

	plc_build(&all);
	plc_add_text(&all, "[");
	for (struct xml_node *each = node->first; each; each = each->next) {
		const char *times, *value;
		bool repeated;

		if (!xml_is(each, "value"))
			continue;
		each->taken = true;
		times = xml_take(each, "repetitionValue");
		value = inner_value(c, each, depth);
		repeated = times && *times && strcmp(times, "1") != 0;
		plc_add_text(&all, comma);
		plc_add_text(&all, repeated ? times : "");
		plc_add_text(&all, repeated ? "(" : "");
		plc_add_text(&all, value ? value : "");
		plc_add_text(&all, repeated ? ")" : "");
		comma = ", ";
	}
	plc_add_text(&all, "]");
	return plc_built(c, &all);
}

static const char *struct_value(struct plcopen *c, struct xml_node *node, int depth)
{
	const char *comma = "(";
	struct plc_build all;

	plc_build(&all);
	for (struct xml_node *each = node->first; each; each = each->next) {
		const char *member, *value;

		if (!xml_is(each, "value"))
			continue;
		each->taken = true;
		member = xml_take(each, "member");
		value = inner_value(c, each, depth);
		if (!value)
			continue;
		plc_add_text(&all, comma);
		plc_add_text(&all, plc_renamed(c, member ? member : ""));
		plc_add_text(&all, " := ");
		plc_add_text(&all, value);
		comma = ", ";
	}
	plc_add_text(&all, *comma == ',' ? ")" : "");
	return *comma == ',' ? plc_built(c, &all) : (plc_built(c, &all), NULL);
}

static const char *inner_value(struct plcopen *c, struct xml_node *value, int depth)
{
	struct xml_node *child;
	const char *text;

	if (depth > MOST_NESTED)
		return NULL;
	if ((child = xml_child(value, "simpleValue"))) {
		text = xml_take(child, "value");
		text = text ? plc_trim(c, text) : "";
		return *text ? plc_renamed(c, text) : NULL;
	}
	if ((child = xml_child(value, "arrayValue")))
		return array_value(c, child, depth + 1);
	if ((child = xml_child(value, "structValue")))
		return struct_value(c, child, depth + 1);
	return NULL;
}

const char *plc_value(struct plcopen *c, struct xml_node *node)
{
	struct xml_node *initial = xml_child(node, "initialValue");

	return initial ? inner_value(c, initial, 0) : NULL;
}

/* ---- variables ---- */

/* Other tools take 0 for an input that a call leaves out, here it needs a value; NULL: no call leaves it out. */
static const char *left_out(struct plcopen *c, const struct xml_node *variable, const char *type)
{
	const struct xml_node *list = variable->parent, *interface = list ? list->parent : NULL;
	const enum iec_type of = iec_type_find(type, strcspn(type, "[( "));
	const struct plcopen_pou *pou;

	if (of == IEC_NONE || !interface || !xml_is(list, "inputVars") || !xml_is(interface, "interface") || !interface->parent)
		return NULL;
	pou = xml_value(interface->parent, "name") ? plc_pou(c, xml_value(interface->parent, "name")) : NULL;
	if (!pou || !pou->called_short)
		return NULL;
	return of == IEC_BOOL ? "FALSE" : iec_type_row(of)->class & (ANY_INT | CLASS_BITS) ? "0" :
	       iec_type_row(of)->class == CLASS_REAL ? "0.0" : iec_type_row(of)->class == CLASS_STRING ? "''" :
	       iec_type_row(of)->class == CLASS_TIME ? "T#0s" : NULL;
}

static void put_value(struct plcopen *c, struct xml_node *variable, const char *type)
{
	const char *value = plc_value(c, variable);

	if (!value)
		value = left_out(c, variable, type);
	if (!value)
		return;
	/* Beremiz takes a text without its quotes, and a number for a BOOL. */
	if (ascii_same(type, "STRING", 6) && *value != '\'' && !strchr(value, '#'))
		value = plc_print(c, "'%s'", value);
	plc_put(c, " := %s", value);
}

/*
 * Also an open one, %I* and %QW*. In an extension of Beremiz %QD0.2 is the third place of a slave, as large as the type.
 * Here it is bit 2 of a double word, which holds a BOOL only.
 */
static bool is_address(const char *text, const char *type)
{
	struct iec_addr address;
	const size_t len = strlen(text);

	if (!len || text[len - 1] == '*')
		return true;
	return iec_addr_parse(text, len, &address) == ADDR_OK &&
	       (address.bits > 1 || ascii_upper(text[2]) == 'X' || plc_same(type, "BOOL"));
}

/* Beremiz and OpenPLC take any type at any address. Is the address as wide as the type? */
static bool is_as_wide(const char *address, const char *type)
{
	const size_t len = strlen(address);
	const enum iec_type of = iec_type_find(type, strcspn(type, "[( "));
	struct iec_addr at;

	if (of == IEC_NONE || address[len - 1] == '*' || iec_addr_parse(address, len, &at) != ADDR_OK)
		return true;
	return of != IEC_STRING && (of == IEC_BOOL ? at.bits == 1 : at.bits == iec_type_row(of)->size * 8);
}

const char *plc_address(struct plcopen *c, struct xml_node *variable, const char *name, const char *type)
{
	const char *address = xml_take(variable, "address");

	if (!address || !*address)
		return NULL;
	if (is_address(address, type) && !is_as_wide(address, type)) {
		plc_report(c, REPORT_LOST, variable, report_said(c->report,
			   REPORTED("\"%s\" has no address here: %s is not as wide as %s")), name, address, type);
		return NULL;
	}
	if (is_address(address, type) && plc_stores_input(c, variable, address)) {
		plc_report(c, REPORT_LOST, variable, report_said(c->report,
			   REPORTED("\"%s\" has no address here: the program stores into the input %s")), name, address);
		return NULL;
	}
	if (is_address(address, type)) {
		const char *to = plc_moved(c, address, strlen(address));

		return to ? to : address;
	}
	plc_report(c, REPORT_LOST, variable,
		   report_said(c->report, REPORTED("\"%s\" has no address here: %s is none")), name, address);
	return NULL;
}

/* Whether something of the file or built in has the type. A type of a library that is missing
 * would make the whole project unreadable. */
static bool is_known(struct plcopen *c, const struct xml_node *node, int depth)
{
	const struct xml_node *type = node ? node->first : NULL;
	const char *name = type ? xml_value(type, "name") : NULL;
	enum iec_type found;

	if (!type || depth > MOST_NESTED)
		return true;
	if (xml_is(type, "array") || xml_is(type, "pointer") || xml_is(type, "reference"))
		return is_known(c, xml_look(type, "baseType"), depth + 1);
	if (!xml_is(type, "derived") || !name)
		return true;
	for (size_t i = 0; i < sizeof(added_types) / sizeof(*added_types); i++)
		if (plc_same(added_types[i].name, name))
			return true;
	found = iec_type_find(name, strcspn(name, "[( "));
	return found != IEC_NONE || plc_data_type(c, name) || plc_pou(c, name) ||
	       (word_find(name, strlen(name)) != WORD_COUNT &&
		word_row(word_find(name, strlen(name)))->kind == WORD_FB) || strchr(name, '.');
}

static void put_variable(struct plcopen *c, struct xml_node *variable)
{
	const char *name = xml_take(variable, "name"), *address;
	const char *edge = xml_take(variable, "edge"), *type;
	bool unknown;
	struct xml_node *kind = xml_child(variable, "type");

	variable->taken = true;
	c->at = variable->line;
	type = plc_type(c, kind);
	address = plc_address(c, variable, name ? name : "", type);
	unknown = *type && !is_known(c, kind, 0);
	if (unknown)
		plc_report(c, REPORT_LOST, variable,
			   report_said(c->report, REPORTED("the type %s is not known: the variable \"%s\" stays as a comment")),
			   type, name ? name : "");
	if (!name || !*name || !*type) {
		plc_report(c, REPORT_LOST, variable,
			   report_said(c->report, REPORTED("the variable \"%s\" has no type or no name and is left out")),
			   name ? name : "");
		return;
	}
	plc_put(c, "  ");
	if (unknown)
		plc_put(c, "(* ");
	plc_put(c, "%s", plc_declared(c, variable));
	if (address)
		plc_put(c, " AT %s", address);
	plc_put(c, " : %s", type);
	if (edge && !strcmp(edge, "rising"))
		plc_put(c, " R_EDGE");
	else if (edge && !strcmp(edge, "falling"))
		plc_put(c, " F_EDGE");
	else
		put_value(c, variable, type);
	plc_put(c, unknown ? "; *)" : ";");
	plc_comment(c, plc_documentation(c, variable));
	plc_put(c, "\n");
	c->count.variables++;
}

void plc_variables(struct plcopen *c, struct xml_node *list, const char *word)
{
	const bool constant = xml_flag(list, "constant"), retain = xml_flag(list, "retain");
	const bool persistent = xml_flag(list, "persistent");
	struct xml_node *first = xml_look(list, "variable");

	list->taken = true;
	xml_flag(list, "nonretain");
	xml_flag(list, "nonpersistent");
	if (!first)
		return;
	c->at = list->line;
	if (*plc_documentation(c, list)) {
		plc_comment(c, plc_documentation(c, list));
		plc_put(c, "\n");
	}
	plc_put(c, "%s%s%s\n", word, constant ? " CONSTANT" : "",
		retain || persistent ? " RETAIN" : "");
	if (persistent && !retain)
		plc_report(c, REPORT_CHANGED, list, "%s",
			   report_said(c->report, REPORTED("PERSISTENT becomes RETAIN")));
	for (struct xml_node *each = first; each; each = each->next)
		if (xml_is(each, "variable"))
			put_variable(c, each);
	plc_put(c, "END_VAR\n");
}

const struct xml_node *plc_find_variable(const struct plcopen_pou *pou, const char *name)
{
	const struct xml_node *interface = xml_look(pou->node, "interface");

	for (const struct xml_node *list = interface ? interface->first : NULL; list;
	     list = list->next)
		for (const struct xml_node *each = list->first; each; each = each->next)
			if (xml_is(each, "variable") && xml_value(each, "name") &&
			    plc_same(xml_value(each, "name"), name))
				return each;
	return NULL;
}

static bool is_made(const struct plcopen *c, const char *name)
{
	for (int i = 0; i < c->made.count; i++)
		if (!strncmp(c->made.name[i], name, strlen(name)) &&
		    c->made.name[i][strlen(name)] == ' ')
			return true;
	return false;
}

const char *plc_make(struct plcopen *c, struct plcopen_pou *pou, const char *stem,
		     const char *type)
{
	const char *name = stem, **made;

	for (int n = 1; plc_find_variable(pou, name) || is_made(c, name) || plc_same(name, pou->name) ||
	     n == 1; n++)
		name = plc_print(c, "%s%d", stem, n);
	made = arena_push(c->arena, &c->made.name, &c->made.count, sizeof(*made));
	if (made)
		*made = plc_print(c, "%s : %s;", name, type);
	return name;
}

static const struct { const char *element, *word; } blocks[] = {
	{ "inputVars", "VAR_INPUT" }, { "outputVars", "VAR_OUTPUT" }, { "inOutVars", "VAR_IN_OUT" },
	{ "localVars", "VAR" }, { "tempVars", "VAR_TEMP" }, { "externalVars", "VAR_EXTERNAL" },
	{ "globalVars", "VAR" },
};

static const char *block_word(const struct xml_node *list)
{
	for (size_t i = 0; i < sizeof(blocks) / sizeof(*blocks); i++)
		if (xml_is(list, blocks[i].element))
			return blocks[i].word;
	return NULL;
}

/* A program that is drawn has no pins: nothing can be connected to them there either. */
static const char *word_here(struct plcopen *c, const struct plcopen_pou *pou,
			     const struct xml_node *list)
{
	const char *word = block_word(list);

	if (!word || pou->kind != POU_PROGRAM || pou->language <= PLCOPEN_IL ||
	    (strcmp(word, "VAR_INPUT") != 0 && strcmp(word, "VAR_OUTPUT") != 0) ||
	    !xml_look(list, "variable"))
		return word;
	plc_report(c, REPORT_CHANGED, list,
		   report_said(c->report, REPORTED("the variables of %s are VAR here: the program is drawn, and nothing is connected to them")),
		   word);
	return "VAR";
}

void plc_interface(struct plcopen *c, struct plcopen_pou *pou)
{
	struct xml_node *interface = xml_child(pou->node, "interface");

	for (struct xml_node *list = interface ? interface->first : NULL; list; list = list->next) {
		const char *word = word_here(c, pou, list);

		if (word)
			plc_variables(c, list, word);
	}
	if (!c->made.count)
		return;
	plc_put(c, "VAR\n");
	for (int i = 0; i < c->made.count; i++)
		plc_put(c, "  %s\n", c->made.name[i]);
	plc_put(c, "END_VAR\n");
}

/* ---- VAR_EXTERNAL ---- */

static bool is_global(struct xml_node *project, const char *name)
{
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		if (!xml_is(node, "variable") || !node->parent || !xml_is(node->parent, "globalVars") ||
		    !xml_value(node, "name") || !plc_same(xml_value(node, "name"), name))
			continue;
		/* In a POU they are its own. */
		if (!node->parent->parent || !xml_is(node->parent->parent, "interface"))
			return true;
	}
	return false;
}

static bool is_declared(struct plcopen *c, const char *name)
{
	for (int i = 0; i < c->globals.count; i++)
		if (plc_same(c->globals.name[i], name))
			return true;
	return false;
}

static void put_lost_global(struct plcopen *c, struct xml_node *variable)
{
	const char *name = xml_value(variable, "name"), **added;

	added = arena_push(c->arena, &c->globals.name, &c->globals.count, sizeof(*added));
	if (!added)
		return;
	*added = name;
	plc_report(c, REPORT_CHANGED, variable,
		   report_said(c->report, REPORTED("\"%s\" is in VAR_EXTERNAL, and nothing declares it: it is a global variable here")),
		   name);
	c->at = variable->line;
	plc_put(c, "%s  %s : %s;\n", c->globals.count == 1 ? "\nVAR_GLOBAL\n" : "", plc_renamed(c, name),
		plc_type(c, xml_look(variable, "type")));
}

void plc_lost_globals(struct plcopen *c, struct xml_node *project)
{
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		if (!xml_is(node, "externalVars"))
			continue;
		for (struct xml_node *each = node->first; each; each = each->next) {
			const char *name = xml_value(each, "name");

			if (xml_is(each, "variable") && name && *name && is_known(c, xml_look(each, "type"), 0) &&
			    xml_look(each, "type") && !is_declared(c, name) && !is_global(project, name))
				put_lost_global(c, each);
		}
	}
	if (c->globals.count)
		plc_put(c, "END_VAR\n");
}

/* ---- types ---- */

static void put_structure(struct plcopen *c, struct xml_node *structure)
{
	structure->taken = true;
	plc_put(c, "STRUCT\n");
	for (struct xml_node *each = structure->first; each; each = each->next)
		if (xml_is(each, "variable"))
			put_variable(c, each);
	plc_put(c, "  END_STRUCT");
}

static void put_type(struct plcopen *c, struct xml_node *type)
{
	const char *name = xml_take(type, "name"), *value;
	struct xml_node *base = xml_child(type, "baseType"), *inner = type_in(base);

	type->taken = true;
	if (!name || !inner) {
		plc_report(c, REPORT_LOST, type,
			   report_said(c->report, REPORTED("the type \"%s\" says nothing and is left out")),
			   name ? name : "");
		return;
	}
	c->at = type->line;
	plc_comment(c, plc_documentation(c, type));
	plc_put(c, "  %s : ", plc_renamed(c, name));
	if (xml_is(inner, "struct"))
		put_structure(c, inner);
	else
		plc_put(c, "%s", plc_type(c, base));
	value = plc_value(c, type);
	if (value)
		plc_put(c, " := %s", value);
	plc_put(c, ";\n");
	c->count.types++;
}

void plc_types(struct plcopen *c, struct xml_node *types)
{
	if (!xml_look(types, "dataType"))
		return;
	plc_put(c, "\nTYPE\n");
	for (struct xml_node *each = types->first; each; each = each->next)
		if (xml_is(each, "dataType"))
			put_type(c, each);
	plc_put(c, "END_TYPE\n");
}
