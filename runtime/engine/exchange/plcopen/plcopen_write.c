/* SPDX-License-Identifier: MIT
 *
 * plcopen_write - the export as a whole: header, types, POUs, configuration.
 */
#include "engine/exchange/plcopen/plcopen_digest.h"
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/base/name.h"
#include "engine/text/text.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

static const char *or_else(const char *text, const char *otherwise)
{
	return *text ? text : otherwise;
}

/* ---- header ---- */

static void put_scaling(struct out *out, const char *language)
{
	plco_open(out, "%s", language);
	plco_line(out, "scaling x=\"10\" y=\"10\"");
	plco_close(out, language);
}

static void put_attribute(struct out *out, const char *name, const char *value)
{
	sink_printf(&out->sink, " %s=\"", name);
	plco_escape(out, value);
	sink_text(&out->sink, "\"");
}

static void put_header(struct out *out)
{
	const struct project *project = out->project;
	const char *title = or_else(plco_id(out, project->title), "Unnamed");
	const char *version = plco_id(out, project->property[PROPERTY_VERSION]);
	const char *author = plco_id(out, project->property[PROPERTY_AUTHOR]);
	const char *text = plco_id(out, project->property[PROPERTY_DESCRIPTION]);

	/* Two exports of one project are the same: there is no time in them. */
	sink_text(&out->sink, "  <fileHeader");
	put_attribute(out, "companyName", or_else(plco_id(out, project->property[PROPERTY_COMPANY]), "Unknown"));
	put_attribute(out, "productName", title);
	put_attribute(out, "productVersion", or_else(version, "1"));
	put_attribute(out, "creationDateTime", "2000-01-01T00:00:00");
	sink_text(&out->sink, "/>\n  <contentHeader");
	put_attribute(out, "name", title);
	if (*version)
		put_attribute(out, "version", version);
	if (*author)
		put_attribute(out, "author", author);
	sink_text(&out->sink, ">\n");
	out->depth++;
	if (*text)
		plco_text(out, "Comment", text);
	plco_open(out, "coordinateInfo");
	put_scaling(out, "fbd");
	put_scaling(out, "ld");
	put_scaling(out, "sfc");
	plco_close(out, "coordinateInfo");
	plco_close(out, "contentHeader");
}

/* ---- bodies ---- */

static void put_written(struct out *out, const char *language, void (*write)(struct out *out))
{
	const struct sink before = out->sink;
	struct sink_memory memory;

	sink_memory_init(&memory);
	out->sink = sink_to_memory(&memory);
	write(out);
	out->sink = before;
	plco_formatted(out, language, plco_words(out, sink_memory_text(&memory)));
	sink_memory_free(&memory);
}

static void write_st(struct out *out)
{
	if (out->pou->st)
		text_write_st(out->project, out->pou->st, &out->sink);
}

static void write_il(struct out *out)
{
	text_write_il(out->project, &out->pou->il, &out->sink);
}

static void plco_body(struct out *out, const struct pou *pou)
{
	out->ids = out->y = 0;
	plco_open(out, "body");
	switch ((int)pou->language) {
	case LANGUAGE_ST:
		put_written(out, "ST", write_st);
		break;
	case LANGUAGE_IL:
		put_written(out, "IL", write_il);
		break;
	case LANGUAGE_LD:
		plco_open(out, "LD");
		plco_rungs(out, pou, 0, pou->rung_count);
		plco_close(out, "LD");
		break;
	case LANGUAGE_FBD:
		plco_networks(out, pou);
		break;
	case LANGUAGE_SFC:
		plco_chart(out, pou);
		break;
	default:
		plco_line(out, "ST");
		break;
	}
	plco_close(out, "body");
}

/* ---- POUs ---- */

static const struct var *result_of(const struct pou *pou)
{
	for (int i = 0; i < pou->vars.count; i++)
		if (vars_flags(&pou->vars, i) & VAR_RESULT)
			return &pou->vars.var[i];
	return NULL;
}

static const char *type_word(const struct pou *pou)
{
	return pou->kind == POU_FUNCTION ? "function" : pou->kind == POU_BLOCK ? "functionBlock" : "program";
}

/* ---- globals that a POU uses: most tools want them in its interface ---- */

static void find_used(struct out *out)
{
	const size_t globals = (size_t)out->project->globals.count;
	struct xref xref;

	out->used = arena_alloc(out->arena, globals * (size_t)out->project->pou_count + 1);
	if (xref_make(&xref, out->project) && out->used)
		for (int i = 0; i < xref.count; i++) {
			const struct xref_use *use = &xref.use[i];

			if (use->pou >= 0 && use->target.what == XREF_VARIABLE && use->target.table == 0 &&
			    use->target.index >= 0 && use->kind != XREF_DECLARED)
				out->used[(size_t)use->pou * globals + (size_t)use->target.index] = 1;
		}
	xref_free(&xref);
}

static bool is_constant(const struct var_table *table, int index)
{
	for (int i = 0; i < table->block_count; i++)
		if (index >= table->block[i].first && index < table->block[i].first + table->block[i].count)
			return table->block[i].flags & (VAR_CONSTANT | VAR_FIXED);
	return false;
}

static bool is_told(const struct out *out, const struct pou *pou, uint32_t name)
{
	for (int i = 0; i < pou->external.count; i++)
		if (name_equal(plco_id(out, pou->external.var[i].name), plco_id(out, name)))
			return true;
	return false;
}

static void put_used(struct out *out, const struct pou *pou, bool constant)
{
	const struct var_table *globals = &out->project->globals;
	const uint8_t *used = out->used + (size_t)(pou - out->project->pou) * (size_t)globals->count;
	bool open = false;

	for (int i = 0; i < globals->count; i++) {
		const struct var *var = &globals->var[i];

		if (!used[i] || is_constant(globals, i) != constant || is_told(out, pou, var->name) ||
		    !plco_type_is_named(out, var))
			continue;
		if (!open)
			plco_open(out, "externalVars%s", constant ? " constant=\"true\"" : "");
		open = true;
		plco_named(out, "variable", "name", plco_id(out, var->name), false);
		plco_type(out, "type", var);
		plco_close(out, "variable");
	}
	if (open)
		plco_close(out, "externalVars");
}

static bool has_actions(const struct out *out, const struct pou *owner)
{
	const struct project *project = out->project;
	bool any = owner->language == LANGUAGE_SFC && owner->sfc->action_count;

	for (int i = 0; i < project->pou_count && !any; i++)
		any = project->pou[i].kind == POU_ACTION &&
		      pou_owner(project, &project->pou[i]) == (int)(owner - project->pou);
	return any;
}

/* Those of a chart stand inside of it or behind it. */
static void put_actions(struct out *out, const struct pou *owner)
{
	const struct project *project = out->project;

	if (!has_actions(out, owner))
		return;
	plco_open(out, "actions");
	if (owner->language == LANGUAGE_SFC)
		plco_chart_actions(out, owner);
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *action = &project->pou[i];

		if (action->kind != POU_ACTION || pou_owner(project, action) != (int)(owner - project->pou))
			continue;
		plco_named(out, "action", "name", pou_own_name(project, action), false);
		out->pou = action;
		plco_body(out, action);
		out->pou = owner;
		plco_documentation(out, plco_id(out, action->comment));
		plco_close(out, "action");
	}
	plco_close(out, "actions");
}

static void put_pou(struct out *out, const struct pou *pou)
{
	const struct var *result = result_of(pou);
	const size_t from = out->text.len;

	out->pou = pou;
	if (pou->kind == POU_ACTION && pou_owner(out->project, pou) >= 0)
		return; /* it stands in its owner */
	if (pou->kind == POU_SUBROUTINE || pou->kind == POU_ACTION) {
		plco_lost(out, REPORT_LOST, pou->line, 0, report_said(out->report,
			 REPORTED("the format has no subroutines: %s is left out")), plco_id(out, pou->name));
		return;
	}
	sink_repeat(&out->sink, "  ", out->depth++);
	sink_text(&out->sink, "<pou");
	put_attribute(out, "name", plco_id(out, pou->name));
	put_attribute(out, "pouType", type_word(pou));
	sink_text(&out->sink, ">\n");
	plco_open(out, "interface");
	if (result)
		plco_type(out, "returnType", result);
	plco_variables(out, &pou->vars);
	plco_variables(out, &pou->external);
	if (out->used) {
		put_used(out, pou, false);
		put_used(out, pou, true);
	}
	plco_close(out, "interface");
	put_actions(out, pou);
	if (pou->language == LANGUAGE_SFC)
		plco_chart_transitions(out, pou);
	plco_body(out, pou);
	plco_documentation(out, plco_id(out, pou->comment));
	plco_close(out, "pou");
	if (out->digest && !out->text.failed)
		out->digest[pou - out->project->pou] = plcopen_digest_text(out->text.text + from, out->text.len - from);
}

/* ---- configuration ---- */

static void put_globals(struct out *out)
{
	for (int i = 0; i < out->project->globals.block_count; i++)
		plco_block(out, &out->project->globals, i, "globalVars");
}

static void put_instance(struct out *out, const struct config_entry *entry)
{
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<pouInstance");
	put_attribute(out, "name", plco_id(out, entry->name));
	put_attribute(out, "typeName", plco_id(out, entry->pou));
	sink_text(&out->sink, "/>\n");
	if (entry->values)
		plco_lost(out, REPORT_LOST, entry->line, 0, report_said(out->report,
			 REPORTED("the connections of the program %s in the CONFIGURATION are left out")), plco_id(out, entry->name));
}

static void put_task(struct out *out, const struct config_entry *task)
{
	const struct config *config = out->project->config;

	sink_repeat(&out->sink, "  ", out->depth++);
	sink_text(&out->sink, "<task");
	put_attribute(out, "name", plco_id(out, task->name));
	if (task->single)
		put_attribute(out, "single", plco_id(out, task->single));
	else
		put_attribute(out, "interval", plco_id(out, task->interval));
	sink_printf(&out->sink, " priority=\"%u\">\n", (unsigned int)task->priority);
	for (int i = 0; i < config->count; i++)
		if (config->entry[i].kind == CONFIG_PROGRAM &&
		    names_fold(&out->project->names, config->entry[i].task) ==
		    names_fold(&out->project->names, task->name))
			put_instance(out, &config->entry[i]);
	plco_close(out, "task");
	if (task->watchdog_ns)
		plco_lost(out, REPORT_LOST, task->line, 0, report_said(out->report,
			 REPORTED("the format has no watchdogs: that of the task %s is left out")), plco_id(out, task->name));
}

static void put_resource(struct out *out, const struct config *config)
{
	plco_named(out, "resource", "name", config && config->has_resource ? plco_id(out, config->resource) : "Resource1",
		  false);
	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_TASK)
			put_task(out, &config->entry[i]);
	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_PROGRAM && !config->entry[i].task)
			put_instance(out, &config->entry[i]);
	plco_close(out, "resource");
}

static void put_access(struct out *out)
{
	const struct project *project = out->project;

	if (!project->access_count)
		return;
	plco_open(out, "accessVars");
	for (int i = 0; i < project->access_count; i++) {
		const struct access *access = &project->access[i];

		sink_repeat(&out->sink, "  ", out->depth++);
		sink_text(&out->sink, "<accessVariable");
		put_attribute(out, "alias", plco_id(out, access->var.name));
		put_attribute(out, "instancePathAndName", plco_id(out, access->path));
		put_attribute(out, "direction", access->writes ? "readWrite" : "readOnly");
		sink_text(&out->sink, ">\n");
		plco_type(out, "type", &access->var);
		plco_documentation(out, plco_id(out, access->var.comment));
		plco_close(out, "accessVariable");
	}
	plco_close(out, "accessVars");
}

/* VAR_CONFIG: places and values of variables of instances. */
static void put_located(struct out *out)
{
	const struct var_table *located = &out->project->located;

	if (!located->count)
		return;
	plco_open(out, "configVars");
	for (int i = 0; i < located->count; i++) {
		const struct var *var = &located->var[i];

		sink_repeat(&out->sink, "  ", out->depth++);
		sink_text(&out->sink, "<configVariable");
		put_attribute(out, "instancePathAndName", plco_id(out, var->name));
		if (var->at_text)
			put_attribute(out, "address", plco_id(out, var->at_text));
		sink_text(&out->sink, ">\n");
		plco_type(out, "type", var);
		plco_initial(out, var);
		plco_documentation(out, plco_id(out, var->comment));
		plco_close(out, "configVariable");
	}
	plco_close(out, "configVars");
}

static void report_config(struct out *out, const struct config *config)
{
	if (out->project->words.space_count)
		plco_lost(out, REPORT_CHANGED, 0, 0, "%s", report_said(out->report,
			 REPORTED("the format has no namespaces: names stand without them")));
	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind == CONFIG_AREA)
			plco_lost(out, REPORT_LOST, entry->line, 0, "%s", report_said(out->report,
				 REPORTED("the format has no sizes of memory areas: AREA is left out")));
	}
}

static void put_configuration(struct out *out)
{
	const struct config *config = out->project->config;

	out->pou = NULL;
	plco_open(out, "instances");
	plco_open(out, "configurations");
	if (config || out->project->globals.count) {
		plco_named(out, "configuration", "name", config ? plco_id(out, config->name) : "Config", false);
		put_resource(out, config);
		put_globals(out);
		put_access(out);
		put_located(out);
		plco_close(out, "configuration");
	}
	report_config(out, config);
	plco_close(out, "configurations");
	plco_close(out, "instances");
}

char *plcopen_write(struct project *project, size_t *len, struct classic_report *report)
{
	struct out out = { .project = project, .report = report, .depth = 1 };
	struct arena arena;
	char *text;

	arena_init(&arena);
	out.arena = &arena;
	out.digest = arena_alloc(&arena, sizeof(*out.digest) * ((size_t)project->pou_count + 1));
	find_used(&out);
	sink_memory_init(&out.text);
	out.sink = sink_to_memory(&out.text);
	sink_text(&out.sink, "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
		  "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\" xmlns:xhtml=\"http://www.w3.org/1999/xhtml\">\n");
	put_header(&out);
	plco_open(&out, "types");
	plco_open(&out, "dataTypes");
	plco_types(&out);
	plco_close(&out, "dataTypes");
	plco_open(&out, "pous");
	for (int i = 0; i < project->pou_count; i++)
		put_pou(&out, &project->pou[i]);
	plco_close(&out, "pous");
	plco_close(&out, "types");
	put_configuration(&out);
	plco_own(&out);
	sink_text(&out.sink, "</project>\n");
	text = out.text.failed || arena.failed ? NULL : out.text.text;
	*len = out.text.len;
	if (!text)
		sink_memory_free(&out.text);
	arena_free(&arena);
	return text;
}
