/* SPDX-License-Identifier: MIT
 *
 * plcopen_apart - actions of CODESYS that are charts.
 *
 * An action here has no steps. So the chart becomes a function block of its own, whose VAR_IN_OUT are the variables
 * of its POU that it uses; the POU gets an instance of it, and the action calls that. It is done in the tree, before
 * anything is written.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/iec.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <string.h>

enum { MOST_SHARED = LIMIT_ARGS }; /* a call has no more parameters            */
enum { MOST_WORK = 20000000 }; /* nodes and names that are looked at: a hostile file may have many of each */

/* A variable or an action of the POU. */
struct part { struct xml_node *node; const char *name; bool used, copied; };

struct apart {
	struct plcopen *c;
	struct xml_node *pous, *pou;
	struct part *variable, *action;
	int variables, actions;
	long work;
};

/* The element of the chart that the action is; NULL: it is none. */
static struct xml_node *chart_of(const struct xml_node *action)
{
	struct xml_node *element;

	return plc_language(xml_look(action, "body"), &element) == PLCOPEN_SFC ? element : NULL;
}

static void add_attribute(struct apart *a, struct xml_node *node, const char *name, const char *value)
{
	if (node)
		xml_give(a->c->arena, node, name, value);
}

static struct xml_node *make(struct apart *a, struct xml_node *parent, const char *name)
{
	return parent ? xml_make(a->c->arena, parent, name) : NULL;
}

/* @node once more, marked as taken: what is left over is told of @node itself. Nests as deep as the file, which is
 * bounded. */
static void make_copy(struct apart *a, const struct xml_node *node, struct xml_node *parent)
{
	struct xml_node *copy = node && --a->work > 0 ? make(a, parent, node->name) : NULL;

	if (!copy)
		return;
	copy->text = node->text;
	copy->attribute = node->attribute;
	copy->line = node->line;
	for (const struct xml_node *each = node->first; each; each = each->next)
		make_copy(a, each, copy);
}

/* ---- what a chart uses ---- */

static void use_action(struct apart *a, struct part *action);

static void use_name(struct apart *a, const char *name, size_t len)
{
	const char *dot = memchr(name, '.', len);
	const char *word = plc_print(a->c, "%.*s", (int)(dot ? (size_t)(dot - name) : len), name);

	a->work -= a->variables + a->actions + 1;
	for (int i = 0; i < a->variables; i++)
		a->variable[i].used |= plc_same(a->variable[i].name, word);
	for (int i = 0; i < a->actions && !dot; i++)
		if (plc_same(a->action[i].name, word))
			use_action(a, &a->action[i]);
}

static void use_text(struct apart *a, const char *text)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END && a->work > 0)
		if (lex.token.kind == TOKEN_NAME)
			use_name(a, lex.token.text, lex.token.len);
}

/* Nests as deep as the file, which is bounded. */
static void use_all(struct apart *a, const struct xml_node *node)
{
	if (xml_is(node, "documentation") || xml_is(node, "comment") || --a->work < 0)
		return;
	if (node->text)
		use_text(a, node->text);
	if (xml_is(node, "reference") && xml_value(node, "name"))
		use_text(a, xml_value(node, "name"));
	if (xml_is(node, "block") && xml_value(node, "instanceName"))
		use_text(a, xml_value(node, "instanceName"));
	if (xml_is(node, "block") && xml_value(node, "typeName"))
		use_text(a, xml_value(node, "typeName"));
	for (const struct xml_node *each = node->first; each; each = each->next)
		use_all(a, each);
}

static void use_action(struct apart *a, struct part *action)
{
	const struct xml_node *body = xml_look(action->node, "body");

	if (action->used)
		return;
	action->used = true;
	if (body)
		use_all(a, body);
}

/* ---- the block ---- */

static const char *free_name(struct apart *a, const char *stem)
{
	const char *name = stem;
	bool taken = true;

	for (int n = 1; taken; n++) {
		taken = false;
		for (const struct xml_node *each = a->pous->first; each; each = each->next)
			taken |= xml_value(each, "name") && plc_same(xml_value(each, "name"), name);
		for (int i = 0; i < a->variables; i++)
			taken |= plc_same(a->variable[i].name, name);
		for (int i = 0; i < a->actions; i++)
			taken |= plc_same(a->action[i].name, name);
		if (taken)
			name = plc_print(a->c, "%s_%d", stem, n);
	}
	return name;
}

static bool is_plain(const struct part *part)
{
	const struct xml_node *type = xml_look(part->node, "type");

	return type && type->first && iec_type_find(type->first->name, strlen(type->first->name)) != IEC_NONE;
}

/* Values beyond what a call takes are copied to inputs before it, and back behind it. */
static void choose_copied(struct apart *a)
{
	int shared = 0;

	for (int i = 0; i < a->variables; i++) {
		a->variable[i].copied = false;
		shared += a->variable[i].used && !is_plain(&a->variable[i]);
	}
	for (int i = 0; i < a->variables; i++)
		if (a->variable[i].used && is_plain(&a->variable[i]) && shared++ >= MOST_SHARED)
			a->variable[i].copied = true;
}

/* The variables that the chart shares with its POU. Constants are inputs, as nobody stores into them. */
static void share(struct apart *a, struct xml_node *block)
{
	struct xml_node *interface = make(a, block, "interface");
	struct xml_node *in = make(a, interface, "inputVars"), *both = make(a, interface, "inOutVars");

	for (int i = 0; i < a->variables; i++) {
		const struct part *part = &a->variable[i];
		struct xml_node *list = part->copied || xml_flag(part->node->parent, "constant") ? in : both, *variable;

		if (!part->used)
			continue;
		variable = make(a, list, "variable");
		add_attribute(a, variable, "name", part->name);
		make_copy(a, xml_look(part->node, "type"), variable);
	}
}

/* Move_chart.A := A; */
static void copy_over(struct apart *a, struct plc_build *call, const char *instance, bool back)
{
	for (int i = 0; i < a->variables; i++) {
		const char *name = a->variable[i].name;

		if (!a->variable[i].used || !a->variable[i].copied || (back && xml_flag(a->variable[i].node->parent, "constant")))
			continue;
		plc_add_text(call, back ? plc_print(a->c, " %s := %s.%s;", name, instance, name) :
					  plc_print(a->c, "%s.%s := %s; ", instance, name, name));
	}
}

/* Move_chart(A := A, B := B); */
static const char *call_of(struct apart *a, const char *instance)
{
	const char *comma = "";
	struct plc_build call;

	plc_build(&call);
	copy_over(a, &call, instance, false);
	plc_add_text(&call, plc_print(a->c, "%s(", instance));
	for (int i = 0; i < a->variables; i++)
		if (a->variable[i].used && !a->variable[i].copied) {
			plc_add_text(&call, plc_print(a->c, "%s%s := %s", comma, a->variable[i].name, a->variable[i].name));
			comma = ", ";
		}
	plc_add_text(&call, ");");
	copy_over(a, &call, instance, true);
	return plc_built(a->c, &call);
}

static void forget(struct apart *a)
{
	for (int i = 0; i < a->variables; i++)
		a->variable[i].used = false;
	for (int i = 0; i < a->actions; i++)
		a->action[i].used = false;
}

static void add_part(struct apart *a, struct part **list, int *count, struct xml_node *node)
{
	struct part *added = arena_push(a->c->arena, list, count, sizeof(*added));

	if (added)
		*added = (struct part){ .node = node, .name = xml_value(node, "name") };
}

/* A flag that every chart of CODESYS heeds. */
static void use_flags(struct apart *a)
{
	for (int i = 0; i < a->variables; i++)
		a->variable[i].used |= plc_same(a->variable[i].name, "SFCReset") || plc_same(a->variable[i].name, "SFCInit");
}

/* The actions of the POU that the steps need. One that is a chart calls its own instance by now. */
static void give_actions(struct apart *a, struct xml_node *block, const struct part *chart)
{
	struct xml_node *actions = make(a, block, "actions");

	for (int i = 0; i < a->actions; i++)
		if (a->action[i].used && &a->action[i] != chart)
			make_copy(a, a->action[i].node, actions);
}

/* A chart that others call stands before them, so their instances are variables by now. False: it goes on too long. */
static bool put_apart(struct apart *a, struct part *action)
{
	struct xml_node *chart = chart_of(action->node), *body = chart ? chart->parent : NULL, *block, *list, *text;
	const char *owner = xml_value(a->pou, "name"), *name, *instance;

	if (!chart)
		return true;
	forget(a);
	action->used = true;
	use_flags(a);
	use_all(a, chart);
	/* Charts that it calls go first. */
	for (int i = 0; i < a->actions && a->work > 0; i++)
		if (a->action[i].used && &a->action[i] != action && chart_of(a->action[i].node))
			return false;
	if (a->work <= 0)
		return false;
	name = free_name(a, plc_print(a->c, "%s_%s", owner, action->name));
	instance = free_name(a, plc_print(a->c, "%s_chart", action->name));
	block = make(a, a->pous, "pou");
	if (!block)
		return false;
	block->line = action->node->line;
	add_attribute(a, block, "pouType", "functionBlock");
	add_attribute(a, block, "name", name);
	choose_copied(a);
	share(a, block);
	give_actions(a, block, action);
	text = make(a, body, "ST");
	xml_move(chart, make(a, block, "body"));
	list = make(a, xml_look(a->pou, "interface"), "localVars");
	list = make(a, list, "variable");
	if (!text || !list)
		return false;
	text->text = call_of(a, instance);
	add_attribute(a, list, "name", instance);
	add_part(a, &a->variable, &a->variables, list);
	list = make(a, make(a, list, "type"), "derived");
	add_attribute(a, list, "name", name);
	plc_report(a->c, REPORT_CHANGED, action->node, report_said(a->c->report,
		   REPORTED("the action %s.%s is a chart: it becomes the function block %s, which the action calls")),
		   owner, action->name, name);
	return true;
}

static void find_parts(struct apart *a)
{
	const struct xml_node *interface = xml_look(a->pou, "interface"), *actions = xml_look(a->pou, "actions");

	for (struct xml_node *list = interface ? interface->first : NULL; list; list = list->next)
		for (struct xml_node *each = list->first; each && !xml_is(list, "externalVars"); each = each->next)
			if (xml_is(each, "variable") && xml_value(each, "name"))
				add_part(a, &a->variable, &a->variables, each);
	for (struct xml_node *each = actions ? actions->first : NULL; each; each = each->next)
		if (xml_is(each, "action") && xml_value(each, "name"))
			add_part(a, &a->action, &a->actions, each);
}

static bool has_charts(const struct apart *a)
{
	const struct xml_node *actions = xml_look(a->pou, "actions");
	const char *type = xml_value(a->pou, "pouType");

	if (!type || plc_same(type, "function") || !xml_value(a->pou, "name") || !xml_look(a->pou, "interface"))
		return false;
	for (const struct xml_node *each = actions ? actions->first : NULL; each; each = each->next)
		if (chart_of(each))
			return true;
	return false;
}

void plc_charts_apart(struct plcopen *c, struct xml_node *pous)
{
	struct apart a = { .c = c, .pous = pous, .work = MOST_WORK };
	struct xml_node *next;

	for (struct xml_node *each = pous ? pous->first : NULL; each; each = next) {
		bool again = true;

		next = each->next;
		a.pou = each;
		a.variables = a.actions = 0;
		a.variable = a.action = NULL;
		if (!xml_is(each, "pou") || !has_charts(&a))
			continue;
		find_parts(&a);
		/* In each round those that call no chart that is left. */
		while (again && a.work > 0) {
			again = false;
			for (int i = 0; i < a.actions && a.work > 0; i++)
				again |= chart_of(a.action[i].node) && put_apart(&a, &a.action[i]);
		}
	}
}
