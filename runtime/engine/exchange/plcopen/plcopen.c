/* SPDX-License-Identifier: MIT
 *
 * plcopen - the import as a whole: header, types, POUs, configuration, and what is left over.
 *
 * A project in PLCopen TC6 XML becomes the text of a rung file. Versions 1.0 to 2.01 are read, as Beremiz,
 * OpenPLC Editor, CODESYS and TwinCAT write them. An element that reaches neither the text nor a line of the
 * report is reported as left out. This code opens no file: the reader of rung files reads its text.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/limits.h"

#include <stdlib.h>
#include <string.h>

enum { LOOK_MOST = 4096 };

static bool has(const char *bytes, size_t len, const char *word)
{
	const size_t size = strlen(word);

	for (size_t i = 0; i + size <= len && i < LOOK_MOST; i++)
		if (bytes[i] == *word && !memcmp(bytes + i, word, size))
			return true;
	return false;
}

static bool is_plcopen(const void *bytes, size_t len)
{
	const char *text = bytes;
	size_t at = len >= 3 && !memcmp(text, "\xef\xbb\xbf", 3) ? 3 : 0;

	while (at < len && text[at] && strchr(" \t\r\n", text[at]))
		at++;
	return xml_is_built() && at < len && text[at] == '<' &&
	       (has(text, len, "plcopen.org/xml") || (has(text, len, "<project") &&
						     has(text, len, "<fileHeader")));
}

/* ---- header ---- */

static void put_property(struct plcopen *c, struct xml_node *node, const char *attribute,
			 const char *word)
{
	const char *value = xml_take(node, attribute);

	if (!value || !*value || !strcmp(value, "Unknown") || !strcmp(value, "Unnamed"))
		return;
	plc_put(c, "%s ", word);
	plc_string(c, value);
	plc_put(c, "\n");
}

static void put_header(struct plcopen *c, struct xml_node *project)
{
	struct xml_node *file = xml_child(project, "fileHeader");
	struct xml_node *content = xml_child(project, "contentHeader");
	const char *name = xml_take(content, "name"), *product = xml_take(file, "productName");
	struct xml_node *comment = xml_child(content, "Comment");

	xml_take(file, "creationDateTime");
	xml_take(content, "modificationDateTime");
	xml_take(content, "language");
	xml_take(file, "productVersion");
	if (xml_child(content, "coordinateInfo"))
		xml_take_all(xml_look(content, "coordinateInfo"));
	if (!name || !*name || !strcmp(name, "Unnamed"))
		name = product;
	plc_put(c, "RUNGBOARD 1\n");
	if (name && *name && strcmp(name, "Unnamed") != 0) {
		plc_put(c, "PROJECT ");
		plc_string(c, name);
		plc_put(c, "\n");
	}
	put_property(c, content, "author", "AUTHOR");
	put_property(c, file, "companyName", "COMPANY");
	if (content && xml_value(content, "organization") && file && !xml_value(file, "companyName"))
		put_property(c, content, "organization", "COMPANY");
	put_property(c, content, "version", "VERSION");
	if (comment && *xml_text(c->arena, comment, NULL)) {
		plc_put(c, "DESCRIPTION ");
		plc_string(c, xml_text(c->arena, comment, NULL));
		plc_put(c, "\n");
	} else {
		put_property(c, file, "contentDescription", "DESCRIPTION");
	}
}

/* ---- what tools add ---- */

/* They repeat what the file says elsewhere, or say where something is drawn. */
static bool repeats(const char *name)
{
	static const char *const endings[] = {
		"/objectid", "/projectstructure", "/interfaceasplaintext", "/fbdcalltype",
		"/fbdelementtype", "/fbdattributes", "/inputparamtypes", "/outputparamtypes",
		"/sfcelementid", "/projectinformation", "/sfcsettings",
	};
	const size_t len = name ? strlen(name) : 0;

	for (size_t i = 0; i < sizeof(endings) / sizeof(*endings); i++) {
		const size_t end = strlen(endings[i]);

		if (len >= end && !strcmp(name + len - end, endings[i]))
			return true;
	}
	return false;
}

/* Whether everything in @node only repeats. */
static bool all_repeat(const struct xml_node *node)
{
	for (const struct xml_node *data = node->first; data; data = data->next)
		if (!repeats(xml_value(data, "name")))
			return false;
	return true;
}

static void take_repeated(struct xml_node *project)
{
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		struct xml_node *above = node->parent;

		if (xml_is(node, "data") && above && xml_is(above, "addData") &&
		    repeats(xml_value(node, "name"))) {
			xml_take_all(node);
			above->taken = true;
		} else if (xml_is(node, "addData") && all_repeat(node)) {
			xml_take_all(node);
			if (above && xml_is(above, "vendorElement"))
				xml_take_all(above);
		}
	}
}

static void take_data(struct xml_node *data)
{
	data->taken = true;
	if (data->parent)
		data->parent->taken = true;
	xml_take(data, "name");
	xml_take(data, "handleUnknown");
}

/* Whether a text of the project says GVL.Name. */
static bool is_said(struct xml_node *project, const char *name)
{
	const size_t len = strlen(name);

	for (struct xml_node *node = project; node; node = xml_next(node))
		for (const char *at = node->text; at && *at; at++) {
			size_t same = 0;

			/* The end of a text is no letter of a name. */
			while (same < len && ascii_upper(at[same]) == ascii_upper(name[same]))
				same++;
			if (same == len && at[len] == '.')
				return true;
		}
	return false;
}

static void put_list(struct plcopen *c, struct xml_node *project, struct xml_node *list)
{
	const char *name = xml_value(list, "name");
	const bool good = name && plc_is_name(name), space = good && is_said(project, name);

	if (good)
		xml_take(list, "name");

	plc_put(c, space ? "\nNAMESPACE %s\n\n" : "\n", name);
	plc_variables(c, list, "VAR_GLOBAL");
	if (space)
		plc_put(c, "\nEND_NAMESPACE\n");
}

/* CODESYS: lists of global variables, behind the project or in the resource of an application. */
static void put_lists(struct plcopen *c, struct xml_node *project)
{
	for (struct xml_node *add = project->first; add; add = add->next)
		for (struct xml_node *data = xml_is(add, "addData") ? add->first : NULL; data;
		     data = data->next) {
			struct xml_node *list = xml_look(data, "globalVars");

			if (!list)
				continue;
			take_data(data);
			for (; list; list = list->next)
				if (xml_is(list, "globalVars"))
					put_list(c, project, list);
		}
}

/* ---- the application of a device ---- */

static struct xml_node *child_or_new(struct plcopen *c, struct xml_node *parent, const char *name)
{
	struct xml_node *child = parent ? xml_look(parent, name) : NULL;

	return child || !parent ? child : xml_make(c->arena, parent, name);
}

/* Where the schema has an element that stands in data. */
static struct xml_node *place_of(struct plcopen *c, struct xml_node *project, const struct xml_node *node)
{
	struct xml_node *types, *instances, *place;

	if (xml_is(node, "pou") || xml_is(node, "dataType")) {
		types = child_or_new(c, project, "types");
		return child_or_new(c, types, xml_is(node, "pou") ? "pous" : "dataTypes");
	}
	if (!xml_is(node, "resource"))
		return NULL;
	instances = child_or_new(c, child_or_new(c, project, "instances"), "configurations");
	place = xml_look(instances, "configuration");
	return place || !instances ? place : xml_make(c->arena, instances, "configuration");
}

/* Lists of a resource: they stand beside those behind the project. */
static void move_lists(struct plcopen *c, struct xml_node *project, struct xml_node *resource)
{
	struct xml_node *add = NULL, *data = NULL, *next;

	for (struct xml_node *each = resource->first; each; each = next) {
		next = each->next;
		if (!xml_is(each, "globalVars") || !xml_value(each, "name"))
			continue;
		if (!data) {
			add = xml_make(c->arena, project, "addData");
			data = add ? xml_make(c->arena, add, "data") : NULL;
		}
		if (data)
			xml_move(each, data);
	}
}

/* CODESYS and TwinCAT put all of an application into data behind the project: its resource, and in data of that
 * its POUs and types. They go where the schema has them. */
static void adopt(struct plcopen *c, struct xml_node *project)
{
	struct { struct xml_node **node; int count; } found = { NULL, 0 };

	/* All are found first: what moves has other nodes behind it. */
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		struct xml_node *data = node->parent, **added;

		if (!data || !xml_is(data, "data") || !data->parent || !xml_is(data->parent, "addData") ||
		    (!xml_is(node, "pou") && !xml_is(node, "dataType") && !xml_is(node, "resource")))
			continue;
		added = arena_push(c->arena, &found.node, &found.count, sizeof(struct xml_node *));
		if (added)
			*added = node;
	}
	for (int i = 0; i < found.count; i++) {
		struct xml_node *node = found.node[i], *place = place_of(c, project, node);

		if (!place)
			continue;
		take_data(node->parent);
		if (xml_is(node, "resource"))
			move_lists(c, project, node);
		xml_move(node, place);
	}
}

/* ---- the whole ---- */

static bool refuse(struct plcopen *c, enum diag_id id, const struct xml_node *node, const char *arg)
{
	const struct diag place = { .id = id, .file = c->file, .line = node->line };

	diag_add(c->diags, place, "%.60s", arg);
	return false;
}

/* These differ in nothing that is read here; a later one may. CODESYS 3.3 gives none. */
static bool is_version(const char *space)
{
	static const char *const known[] = {
		"", "http://www.plcopen.org/xml/tc6.xsd", "http://www.plcopen.org/xml/tc6_0100",
		"http://www.plcopen.org/xml/tc6_0101", "http://www.plcopen.org/xml/tc6_0200",
		"http://www.plcopen.org/xml/tc6_0201",
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++)
		if (!strcmp(space, known[i]))
			return true;
	return false;
}

static bool check_root(struct plcopen *c, struct xml_node *root, const char *space)
{
	if (!is_version(space))
		return refuse(c, DIAG_PLCOPEN_VERSION, root, space);
	if (!xml_is(root, "project"))
		return refuse(c, DIAG_PLCOPEN_ROOT, root, root->name);
	root->taken = true;
	for (struct xml_attribute *a = root->attribute; a; a = a->next)
		a->taken = true;
	return true;
}

static void put_all(struct plcopen *c, struct xml_node *project)
{
	struct xml_node *types, *instances;

	take_repeated(project);
	adopt(c, project);
	types = xml_child(project, "types");
	instances = xml_child(project, "instances");
	if (!types && !instances) {
		refuse(c, DIAG_PLCOPEN_EMPTY, project, "");
		return;
	}
	c->types = xml_look(types, "dataTypes");
	plc_find_own(c, project);
	plc_library(c, project, xml_look(types, "pous"));
	plc_note_init(c, project);
	plc_charts_apart(c, xml_look(types, "pous"));
	plc_find_pous(c, xml_child(types, "pous"));
	if (plc_own_project(c, project))
		return;
	plc_find_renames(c, project);
	plc_find_addresses(c, project);
	plc_find_short_calls(c);
	plc_find_called(c);
	put_header(c, project);
	if (xml_child(types, "dataTypes"))
		plc_types(c, xml_look(types, "dataTypes"));
	put_lists(c, project);
	plc_lost_globals(c, project);
	plc_pous(c);
	if (instances)
		plc_configurations(c, instances);
}

static void report_counts(struct plcopen *c)
{
	static const struct xml_node *const nowhere = NULL;

	if (c->count.types)
		plc_report(c, REPORT_TAKEN, nowhere, report_said(c->report, REPORTED("types: %d")),
			   c->count.types);
	plc_report(c, REPORT_TAKEN, nowhere,
		   report_said(c->report, REPORTED("POUs: %d, variables: %d")), c->count.pous,
		   c->count.variables);
	if (c->count.own)
		plc_report(c, REPORT_TAKEN, nowhere,
			   report_said(c->report, REPORTED("POUs as they were exported, by the text beside their drawing: %d")),
			   c->count.own);
	if (c->count.rungs)
		plc_report(c, REPORT_TAKEN, nowhere, report_said(c->report, REPORTED("rungs: %d")),
			   c->count.rungs);
	if (c->count.networks)
		plc_report(c, REPORT_TAKEN, nowhere, report_said(c->report, REPORTED("networks: %d")),
			   c->count.networks);
	if (c->count.steps)
		plc_report(c, REPORT_TAKEN, nowhere, report_said(c->report, REPORTED("steps: %d")),
			   c->count.steps);
}

static bool finish(struct plcopen *c, struct import *import)
{
	struct foreign_text *out = &import->text;
	const struct diag place = { .id = DIAG_NO_MEMORY, .file = c->file };
	const bool good = !c->arena->failed && !c->text.failed;

	import->drawings = c->drawings;
	*out = (struct foreign_text){ NULL, c->text.len, c->place, c->lines };
	if (good)
		out->text = arena_copy(c->arena, sink_memory_text(&c->text), c->text.len);
	if (!out->text)
		diag_add(c->diags, place, "%s", "");
	return out->text != NULL;
}

static bool read_xml(struct import *import)
{
	struct classic_report *report = import->report;
	struct arena *arena = import->arena;
	struct plcopen c = { .arena = arena, .file = import->path, .report = report,
			     .diags = import->diags, .at = 1 };
	const int errors = import->diags->errors;
	struct arena tree;
	struct xml_node *root;
	const char *space;
	bool good = false;

	arena_init(&tree);
	root = xml_read(&tree, import->path, import->bytes, import->len, &space, import->diags);
	if (root && check_root(&c, root, space)) {
		sink_memory_init(&c.text);
		c.out = sink_to_memory(&c.text);
		put_all(&c, root);
		if (import->diags->errors == errors) {
			plc_leftovers(&c, root);
			report_counts(&c);
			good = finish(&c, import);
		}
		sink_memory_free(&c.text);
	}
	/* Texts of the report are copies, names of POUs are not. */
	for (int i = 0; i < report->count; i++)
		if (report->line[i].pou)
			report->line[i].pou = arena_copy(arena, report->line[i].pou, strlen(report->line[i].pou));
	arena_free(&tree);
	return good;
}

const struct import_format plcopen_format = { "PLCopen XML", is_plcopen, NULL, read_xml, false };
