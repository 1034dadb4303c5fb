/* SPDX-License-Identifier: MIT
 *
 * plcopen_library - what Beremiz and OpenPLC have beside the words of a rung file: blocks of an annex of the
 * standard, with other pins than those here, and conversions of TIME that count seconds, where milliseconds are
 * counted here.
 *
 * Those that a project uses become functions and blocks of it. An export from here means our own words, and CODESYS
 * has others.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/iec.h"
#include "engine/base/lex.h"

#include <string.h>

#define SECONDS(time) "LREAL_TO_REAL(LTIME_TO_LREAL(TIME_TO_LTIME(" time ")) / 1.0E9)"

/* Declarations are `Name Type, …`. */
static const struct library { const char *name, *in, *out, *own, *body, *needs; } library[] = {
	{ "INTEGRAL", "RUN BOOL, R1 BOOL, XIN REAL, X0 REAL, CYCLE TIME", "Q BOOL, XOUT REAL", "",
	  "Q := NOT R1;\n"
	  "IF R1 THEN XOUT := X0;\n"
	  "ELSIF RUN THEN XOUT := XOUT + XIN * " SECONDS("CYCLE") "; END_IF;\n", "" },
	{ "DERIVATIVE", "RUN BOOL, XIN REAL, CYCLE TIME", "XOUT REAL", "X1 REAL, X2 REAL, X3 REAL",
	  "IF NOT RUN THEN X1 := XIN; X2 := XIN; X3 := XIN; XOUT := 0.0; RETURN; END_IF;\n"
	  "XOUT := (3.0 * (XIN - X3) + X1 - X2) / (10.0 * " SECONDS("CYCLE") ");\n"
	  "X3 := X2; X2 := X1; X1 := XIN;\n", "" },
	{ "PID", "AUTO BOOL, PV REAL, SP REAL, X0 REAL, KP REAL, TR REAL, TD REAL, CYCLE TIME", "XOUT REAL",
	  "Error REAL, Sum INTEGRAL, Slope DERIVATIVE",
	  "Error := PV - SP;\n"
	  "Sum(RUN := AUTO, R1 := NOT AUTO, XIN := Error, X0 := TR * (X0 - Error), CYCLE := CYCLE);\n"
	  "Slope(RUN := AUTO, XIN := Error, CYCLE := CYCLE);\n"
	  "XOUT := KP * (Error + Sum.XOUT / TR + Slope.XOUT * TD);\n", "INTEGRAL DERIVATIVE" },
	{ "HYSTERESIS", "XIN1 REAL, XIN2 REAL, EPS REAL", "Q BOOL", "",
	  "Q := XIN1 > XIN2 + EPS OR (Q AND XIN1 >= XIN2 - EPS);\n", "" },
	{ "RAMP", "RUN BOOL, X0 REAL, X1 REAL, TR TIME, CYCLE TIME", "BUSY BOOL, XOUT REAL", "From REAL, Passed TIME",
	  "BUSY := RUN AND Passed < TR;\n"
	  "IF NOT RUN THEN XOUT := X0; From := X0; Passed := T#0s;\n"
	  "ELSIF NOT BUSY THEN XOUT := X1;\n"
	  "ELSE XOUT := From + (X1 - From) * " SECONDS("Passed") " / " SECONDS("TR") ";\n"
	  "Passed := Passed + CYCLE; END_IF;\n", "" },
};
enum { BLOCKS = sizeof(library) / sizeof(*library) };

struct using {
	struct plcopen *c;
	struct xml_node *pous;
	bool block[BLOCKS];
	bool from_time[IEC_TYPE_COUNT], to_time[IEC_TYPE_COUNT];
};

static bool is_number(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_NUM | CLASS_BITS);
}

static void use_name(struct using *u, const char *name, size_t len)
{
	enum iec_type type;

	for (int i = 0; i < BLOCKS; i++)
		u->block[i] |= ascii_is(library[i].name, name, len);
	if (len > 8 && ascii_same(name, "TIME_TO_", 8)) {
		type = iec_type_find(name + 8, len - 8);
		u->from_time[type] |= is_number(type);
	} else if (len > 8 && ascii_same(name + len - 8, "_TO_TIME", 8)) {
		type = iec_type_find(name, len - 8);
		u->to_time[type] |= is_number(type);
	}
}

static void use_text(struct using *u, const char *text)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END)
		if (lex.token.kind == TOKEN_NAME)
			use_name(u, lex.token.text, lex.token.len);
}

static void make_text(struct using *u, struct xml_node *parent, const char *name, const char *attribute, const char *value,
		      const char *text)
{
	struct xml_node *node = parent ? xml_make(u->c->arena, parent, name) : NULL;

	if (!node)
		return;
	node->text = text;
	xml_give(u->c->arena, node, attribute, value);
}

static void make_type(struct using *u, struct xml_node *parent, const char *name, const char *type)
{
	struct xml_node *node = parent ? xml_make(u->c->arena, parent, name) : NULL;

	if (!node)
		return;
	if (iec_type_find(type, strlen(type)) != IEC_NONE)
		xml_make(u->c->arena, node, type);
	else
		make_text(u, node, "derived", "name", type, NULL);
}

static void make_variables(struct using *u, struct xml_node *interface, const char *list, const char *declared)
{
	struct xml_node *block = *declared && interface ? xml_make(u->c->arena, interface, list) : NULL;

	while (block && *declared) {
		const size_t name = strcspn(declared, " "), type = strcspn(declared + name + 1, ",");
		struct xml_node *variable = xml_make(u->c->arena, block, "variable");

		if (!variable)
			return;
		xml_give(u->c->arena, variable, "name", plc_print(u->c, "%.*s", (int)name, declared));
		make_type(u, variable, "type", plc_print(u->c, "%.*s", (int)type, declared + name + 1));
		declared += name + 1 + type;
		declared += strspn(declared, ", ");
	}
}

static bool has_pou(const struct using *u, const char *name)
{
	for (const struct xml_node *each = u->pous->first; each; each = each->next)
		if (xml_value(each, "name") && plc_same(xml_value(each, "name"), name))
			return true;
	return false;
}

static struct xml_node *make_pou(struct using *u, const char *name, const char *kind, const char *body)
{
	struct xml_node *pou = has_pou(u, name) ? NULL : xml_make(u->c->arena, u->pous, "pou");
	struct xml_node *interface = pou ? xml_make(u->c->arena, pou, "interface") : NULL;

	if (!interface)
		return NULL;
	xml_give(u->c->arena, pou, "pouType", kind);
	xml_give(u->c->arena, pou, "name", name);
	make_text(u, xml_make(u->c->arena, pou, "body"), "ST", "name", "", body);
	return interface;
}

static void add_block(struct using *u, const struct library *one)
{
	struct xml_node *interface = make_pou(u, one->name, "functionBlock", one->body);

	if (!interface)
		return;
	make_variables(u, interface, "inputVars", one->in);
	make_variables(u, interface, "outputVars", one->out);
	make_variables(u, interface, "localVars", one->own);
	plc_report(u->c, REPORT_CHANGED, u->pous, report_said(u->c->report,
		   REPORTED("the block %s of other tools has other pins: it becomes a block of the project")), one->name);
}

static void add_conversion(struct using *u, enum iec_type type, bool to_time)
{
	const char *word = iec_type_row(type)->word;
	const bool real = iec_type_row(type)->class == CLASS_REAL;
	const char *wide = real ? "LREAL" : "LINT", *name, *inner, *body;
	struct xml_node *interface;

	name = to_time ? plc_print(u->c, "%s_TO_TIME", word) : plc_print(u->c, "TIME_TO_%s", word);
	if (to_time) {
		inner = strcmp(word, wide) ? plc_print(u->c, "%s_TO_%s(IN)", word, wide) : "IN";
		body = plc_print(u->c, "%s := LTIME_TO_TIME(%s_TO_LTIME(%s * %s));\n", name, wide, inner, real ? "1.0E9" : "1000000000");
	} else {
		inner = plc_print(u->c, "LTIME_TO_%s(TIME_TO_LTIME(IN)) / %s", wide, real ? "1.0E9" : "1000000000");
		inner = strcmp(word, wide) ? plc_print(u->c, "%s_TO_%s(%s)", wide, word, inner) : inner;
		body = plc_print(u->c, "%s := %s;\n", name, inner);
	}
	interface = make_pou(u, name, "function", body);
	if (!interface)
		return;
	make_type(u, interface, "returnType", to_time ? "TIME" : word);
	make_variables(u, interface, "inputVars", plc_print(u->c, "IN %s", to_time ? word : "TIME"));
	plc_report(u->c, REPORT_CHANGED, u->pous, report_said(u->c->report,
		   REPORTED("%s counts seconds there and milliseconds here: it becomes a function of the project")), name);
}

void plc_library(struct plcopen *c, struct xml_node *project, struct xml_node *pous)
{
	struct using u = { .c = c, .pous = pous };
	bool again = true;

	if (!pous || plc_counts_otherwise(c, project))
		return;
	for (struct xml_node *node = xml_next(project); node; node = xml_next(node)) {
		const char *name = xml_is(node, "block") ? xml_value(node, "typeName") : xml_is(node, "derived") ? xml_value(node, "name") : NULL;

		if (name)
			use_name(&u, name, strlen(name));
		if (node->text && !xml_is(node, "content"))
			use_text(&u, node->text);
	}
	for (int round = 0; again && round < BLOCKS; round++) {
		again = false;
		for (int i = 0; i < BLOCKS; i++)
			for (int k = 0; k < BLOCKS; k++)
				if (u.block[i] && !u.block[k] && strstr(library[i].needs, library[k].name))
					again = u.block[k] = true;
	}
	for (int i = 0; i < BLOCKS; i++)
		if (u.block[i])
			add_block(&u, &library[i]);
	for (int i = 0; i < IEC_TYPE_COUNT; i++) {
		if (u.from_time[i])
			add_conversion(&u, (enum iec_type)i, false);
		if (u.to_time[i])
			add_conversion(&u, (enum iec_type)i, true);
	}
}
