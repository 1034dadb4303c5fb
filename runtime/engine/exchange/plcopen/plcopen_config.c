/* SPDX-License-Identifier: MIT
 *
 * plcopen_config - configurations, resources, tasks and instances of programs.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"

#include <stdlib.h>
#include <string.h>

/* T#… of a duration in ISO 8601, P0DT0H0M0.02S; NULL: it is none. */
static const char *iso_time(struct plcopen *c, const char *text)
{
	const char *out = "T#";
	bool time = false, any = false;

	if (ascii_upper(*text++) != 'P')
		return NULL;
	while (*text) {
		char *end;
		double number;
		char unit;

		if (ascii_upper(*text) == 'T') {
			time = true;
			text++;
			continue;
		}
		number = strtod(text, &end);
		unit = ascii_upper(*end);
		if (end == text || number < 0 || !unit || !strchr(time ? "HMS" : "D", unit))
			return NULL;
		if (unit == 'S')
			out = plc_print(c, "%s%.9gms", out, number * 1000);
		else if (number > 0)
			out = plc_print(c, "%s%.9g%c", out, number, unit + 'a' - 'A');
		any = any || unit == 'S' || number > 0;
		text = end + 1;
	}
	return any ? out : "T#0s";
}

/* 00:00:00.100000, as older versions of Beremiz write it; NULL: it is none. */
static const char *clock_time(struct plcopen *c, const char *text)
{
	double part[3];

	for (int i = 0; i < 3; i++) {
		char *end;

		if (!ascii_digit(*text))
			return NULL;
		part[i] = strtod(text, &end);
		if (*end != (i < 2 ? ':' : '\0') || part[i] > 1e6)
			return NULL;
		text = end + 1;
	}
	return plc_print(c, "T#%.9gms", ((part[0] * 60 + part[1]) * 60 + part[2]) * 1000);
}

/* A number alone is milliseconds, as in exports of CODESYS. */
static const char *interval(struct plcopen *c, const char *text)
{
	const char *iso = iso_time(c, text), *clock = iso ? NULL : clock_time(c, text);
	char *end;

	if (iso || clock)
		return iso ? iso : clock;
	strtod(text, &end);
	return !*end && end != text ? plc_print(c, "T#%sms", text) : text;
}

static const char *good_name(struct plcopen *c, struct xml_node *node, const char *name,
			     const char *otherwise)
{
	char *made;

	if (name && plc_is_name(name))
		return name;
	made = (char *)plc_print(c, "%s", name && *name ? name : otherwise);
	for (char *at = made; *at; at++)
		if (!ascii_digit(*at) && (ascii_upper(*at) < 'A' || ascii_upper(*at) > 'Z'))
			*at = '_';
	if (!plc_is_name(made))
		made = (char *)plc_print(c, "%s_%s", otherwise, made);
	plc_report(c, REPORT_CHANGED, node,
		   report_said(c->report, REPORTED("the name \"%s\" becomes %s")), name ? name : "",
		   made);
	return made;
}

static bool is_zero(const char *every)
{
	return every && (!strcmp(every, "PT0S") || !strcmp(every, "T#0s") || !strcmp(every, "0"));
}

/* A unit of the settings as literals have it, whose micro may be a sign; NULL: it is none. */
static const char *unit_of(const char *unit)
{
	static const char *const units[] = { "d", "h", "m", "s", "ms", "us", "ns" };

	if (!strcmp(unit, "\xc2\xb5s") || !strcmp(unit, "\xce\xbcs"))
		return "us";
	for (size_t i = 0; i < sizeof(units) / sizeof(*units); i++)
		if (plc_same(units[i], unit))
			return units[i];
	return NULL;
}

/* A decimal number above zero, as a literal has it. */
static bool is_amount(const char *text)
{
	size_t digits = strspn(text, "0123456789");
	const size_t all = digits;

	if (digits && text[digits] == '.')
		digits += 1 + strspn(text + digits + 1, "0123456789");
	return all && !text[digits] && text[digits - 1] != '.' && strtod(text, NULL) > 0;
}

/* CODESYS gives what is no whole number of milliseconds in its settings alone. @otherwise stays if nothing is given;
 * NULL: what is given says no time, and is reported as left out. */
static const char *set_interval(struct plcopen *c, struct xml_node *task, const char *otherwise)
{
	struct xml_node *add = xml_look(task, "addData");

	for (struct xml_node *data = add ? add->first : NULL; data; data = data->next) {
		struct xml_node *settings = xml_look(data, "TaskSettings");
		const char *every = settings ? xml_value(settings, "Interval") : NULL;
		const char *unit = settings ? xml_value(settings, "IntervalUnit") : NULL;

		if (!every || !unit || is_zero(every))
			continue;
		add->taken = true;
		if (unit_of(unit) && is_amount(every)) {
			xml_take_all(data);
			return plc_print(c, "T#%s%s", every, unit_of(unit));
		}
		/* Their attributes are what is left over. */
		xml_take(data, "name");
		data->taken = true;
		settings->taken = true;
		return NULL;
	}
	return otherwise;
}

static void put_task(struct plcopen *c, struct xml_node *task)
{
	const char *name = good_name(c, task, xml_take(task, "name"), "Task");
	const char *every = xml_take(task, "interval"), *single = xml_take(task, "single");
	const char *priority = xml_take(task, "priority");

	if (is_zero(every))
		every = set_interval(c, task, every);
	task->taken = true;
	c->at = task->line;
	plc_put(c, "  TASK %s (", name);
	if (single && *single)
		plc_put(c, "SINGLE := %s", single);
	else if (every && *every)
		plc_put(c, "INTERVAL := %s", interval(c, every));
	else {
		plc_put(c, "INTERVAL := T#20ms");
		plc_report(c, REPORT_CHANGED, task,
			   report_said(c->report, REPORTED("the task %s says no interval; it gets 20 ms")), name);
	}
	plc_put(c, ", PRIORITY := %s);", priority && *priority ? priority : "0");
	plc_comment(c, plc_documentation(c, task));
	plc_put(c, "\n");
}

static void put_instance(struct plcopen *c, struct xml_node *instance, const char *task)
{
	const char *name = good_name(c, instance, xml_take(instance, "name"), "Instance");
	const char *type = xml_take(instance, "typeName");

	instance->taken = true;
	c->at = instance->line;
	if (!type || !*type)
		type = xml_take(instance, "type");
	if ((!type || !*type) && plc_pou(c, name)) /* CODESYS names the program alone */
		type = name;
	if (!type || !*type) {
		plc_report(c, REPORT_LOST, instance,
			   report_said(c->report, REPORTED("the instance \"%s\" names no program and is left out")), name);
		return;
	}
	plc_put(c, task ? "  PROGRAM %s WITH %s : %s;" : "  PROGRAM %s%s : %s;", name,
		task ? task : "", plc_renamed(c, type));
	plc_comment(c, plc_documentation(c, instance));
	plc_put(c, "\n");
}

static void put_access(struct plcopen *c, struct xml_node *list)
{
	list->taken = true;
	if (!xml_look(list, "accessVariable"))
		return;
	plc_put(c, "VAR_ACCESS\n");
	for (struct xml_node *each = list->first; each; each = each->next) {
		const char *direction;

		if (!xml_is(each, "accessVariable"))
			continue;
		each->taken = true;
		c->at = each->line;
		direction = xml_take(each, "direction");
		plc_put(c, "  %s : %s : %s%s;", xml_take(each, "alias"),
			xml_take(each, "instancePathAndName"), plc_type(c, xml_child(each, "type")),
			direction && !strcmp(direction, "readWrite") ? " READ_WRITE" : " READ_ONLY");
		plc_comment(c, plc_documentation(c, each));
		plc_put(c, "\n");
	}
	plc_put(c, "END_VAR\n");
}

static void put_located(struct plcopen *c, struct xml_node *list)
{
	list->taken = true;
	if (!xml_look(list, "configVariable"))
		return;
	plc_put(c, "VAR_CONFIG\n");
	for (struct xml_node *each = list->first; each; each = each->next) {
		const char *name, *type, *address, *value;

		if (!xml_is(each, "configVariable"))
			continue;
		each->taken = true;
		c->at = each->line;
		name = xml_take(each, "instancePathAndName");
		type = plc_type(c, xml_child(each, "type"));
		address = plc_address(c, each, name ? name : "", type);
		value = plc_value(c, each);
		plc_put(c, "  %s%s%s : %s%s%s;", name ? name : "", address ? " AT " : "", address ? address : "",
			type, value ? " := " : "", value ? value : "");
		plc_comment(c, plc_documentation(c, each));
		plc_put(c, "\n");
	}
	plc_put(c, "END_VAR\n");
}

static void put_globals(struct plcopen *c, struct xml_node *node)
{
	for (struct xml_node *each = node->first; each; each = each->next)
		if (xml_is(each, "globalVars")) {
			xml_take(each, "name");
			plc_variables(c, each, "VAR_GLOBAL");
		}
}

static void put_tasks(struct plcopen *c, struct xml_node *resource)
{
	for (struct xml_node *task = resource->first; task; task = task->next)
		if (xml_is(task, "task"))
			put_task(c, task);
}

static void put_instances(struct plcopen *c, struct xml_node *resource)
{
	for (struct xml_node *each = resource->first; each; each = each->next) {
		if (xml_is(each, "pouInstance"))
			put_instance(c, each, NULL);
		if (!xml_is(each, "task"))
			continue;
		for (struct xml_node *one = each->first; one; one = one->next)
			if (xml_is(one, "pouInstance"))
				put_instance(c, one, good_name(c, each, xml_value(each, "name"), "Task"));
	}
}

/* Whether a program stands in one of the lines of instances. */
static bool has_instances(const struct xml_node *configuration)
{
	for (const struct xml_node *r = configuration->first; r; r = r->next)
		for (const struct xml_node *t = r->first; t; t = t->next)
			if (xml_is(t, "pouInstance") || xml_look(t, "pouInstance"))
				return true;
	return false;
}

static void put_resources(struct plcopen *c, struct xml_node *configuration)
{
	struct xml_node *first = NULL;

	for (struct xml_node *each = configuration->first; each; each = each->next) {
		if (!xml_is(each, "resource"))
			continue;
		each->taken = true;
		if (first)
			plc_report(c, REPORT_CHANGED, each,
				   report_said(c->report, REPORTED("the resource \"%s\" is run by the same controller as the first one")),
				   xml_take(each, "name"));
		else
			first = each;
	}
	if (!first)
		return;
	c->at = first->line;
	plc_put(c, "RESOURCE %s\n", good_name(c, first, xml_take(first, "name"), "Resource"));
	for (struct xml_node *each = first; each; each = each->next)
		if (xml_is(each, "resource"))
			put_globals(c, each);
	for (struct xml_node *each = first; each; each = each->next)
		if (xml_is(each, "resource"))
			put_tasks(c, each);
	for (struct xml_node *each = first; each; each = each->next)
		if (xml_is(each, "resource"))
			put_instances(c, each);
	plc_put(c, "END_RESOURCE\n");
}

static void put_configuration(struct plcopen *c, struct xml_node *configuration)
{
	struct xml_node *access = xml_look(configuration, "accessVars");
	struct xml_node *located = xml_look(configuration, "configVars");

	c->at = configuration->line;
	plc_put(c, "\nCONFIGURATION %s\n",
		xml_value(configuration, "name") ?
		good_name(c, configuration, xml_take(configuration, "name"), "Config") : "Config");
	put_globals(c, configuration);
	put_resources(c, configuration);
	if (access)
		put_access(c, access);
	if (located)
		put_located(c, located);
	plc_put(c, "END_CONFIGURATION\n");
	if (!has_instances(configuration) && c->pous)
		plc_report(c, REPORT_CHANGED, configuration, "%s",
			   report_said(c->report, REPORTED("the configuration names no program: all programs run in each scan")));
}

void plc_configurations(struct plcopen *c, struct xml_node *instances)
{
	struct xml_node *all = xml_child(instances, "configurations");
	bool any = false;

	for (struct xml_node *each = all ? all->first : NULL; each; each = each->next) {
		if (!xml_is(each, "configuration") || any)
			continue;
		each->taken = true;
		any = true;
		put_configuration(c, each);
	}
}
