/* SPDX-License-Identifier: MIT
 *
 * plcopen_write_types - types, values and variables, from their text in the project.
 */
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/base/ascii.h"
#include "engine/text/writer.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_NESTED = 16 };

/* ---- text of a type or a value ---- */

static const char *skip(const char *at)
{
	while (*at && (unsigned char)*at <= ' ')
		at++;
	return at;
}

/* The end of the part at @at, before one of @ends outside of brackets and quotes. ".." is one. */
static const char *part_end(const char *at, const char *ends)
{
	int depth = 0;

	for (; *at; at++) {
		if (*at == '\'') {
			const char *close = at + 1;

			while (*close && *close != '\'')
				close += *close == '$' && close[1] ? 2 : 1;
			at = *close ? close : close - 1;
			continue;
		}
		if (!depth && strchr(ends, *at) && (*at != '.' || at[1] == '.'))
			return at;
		depth += *at == '(' || *at == '[';
		depth -= *at == ')' || *at == ']';
	}
	return at;
}

static const char *part(struct out *out, const char *from, const char *end)
{
	char *text;

	from = skip(from);
	while (end > from && (unsigned char)end[-1] <= ' ')
		end--;
	text = arena_copy(out->arena, from, (size_t)(end - from));
	return text ? text : "";
}

static bool word_at(const char **at, const char *word)
{
	const size_t len = strlen(word);
	const char *text = skip(*at);

	if (!ascii_same(text, word, len) || ascii_digit(text[len]) || text[len] == '_' ||
	    (ascii_upper(text[len]) >= 'A' && ascii_upper(text[len]) <= 'Z'))
		return false;
	*at = skip(text + len);
	return true;
}

static const struct { const char *word, *element; } elementary[] = {
	{ "BOOL", "BOOL" }, { "BYTE", "BYTE" }, { "WORD", "WORD" }, { "DWORD", "DWORD" },
	{ "LWORD", "LWORD" }, { "SINT", "SINT" }, { "INT", "INT" }, { "DINT", "DINT" },
	{ "LINT", "LINT" }, { "USINT", "USINT" }, { "UINT", "UINT" }, { "UDINT", "UDINT" },
	{ "ULINT", "ULINT" }, { "REAL", "REAL" }, { "LREAL", "LREAL" }, { "TIME", "TIME" },
	{ "DATE", "DATE" }, { "DT", "DT" }, { "DATE_AND_TIME", "DT" }, { "TOD", "TOD" },
	{ "TIME_OF_DAY", "TOD" },
};

static void put_type(struct out *out, const char *text, int depth);
static void put_value(struct out *out, const char *text, int depth);

static void put_inner_type(struct out *out, const char *element, const char *text, int depth)
{
	plco_open(out, "%s", element);
	put_type(out, text, depth + 1);
	plco_close(out, element);
}

static void put_range(struct out *out, const char *element, const char *from, const char *end)
{
	const char *dots = part_end(from, ".");
	const bool any = dots >= end;

	sink_repeat(&out->sink, "  ", out->depth);
	sink_printf(&out->sink, "<%s lower=\"", element);
	plco_escape(out, any ? "" : part(out, from, dots));
	sink_text(&out->sink, "\" upper=\"");
	plco_escape(out, any ? "" : part(out, dots + 2, end));
	sink_text(&out->sink, "\"/>\n");
}

/* Behind ARRAY. */
static void put_array(struct out *out, const char *at, int depth)
{
	plco_open(out, "array");
	at = *at == '[' ? at + 1 : at;
	while (*at && *at != ']') {
		const char *end = part_end(at, ",]");

		put_range(out, "dimension", at, end);
		at = *end == ',' ? end + 1 : end;
	}
	at = skip(*at ? at + 1 : at);
	word_at(&at, "OF");
	put_inner_type(out, "baseType", at, depth);
	plco_close(out, "array");
}

static void put_names(struct out *out, const char *at)
{
	plco_open(out, "values");
	while (*at && *at != ')') {
		const char *end = part_end(at, ",)"), *colon = part_end(at, ":");
		const bool valued = colon < end;

		sink_repeat(&out->sink, "  ", out->depth);
		sink_text(&out->sink, "<value name=\"");
		plco_escape(out, part(out, at, valued ? colon : end));
		if (valued) {
			sink_text(&out->sink, "\" value=\"");
			plco_escape(out, part(out, colon + 2, end));
		}
		sink_text(&out->sink, "\"/>\n");
		at = *end == ',' ? end + 1 : end;
	}
	plco_close(out, "values");
}

/* Behind STRUCT: Name : T := value; … END_STRUCT */
static void put_members(struct out *out, const char *at, int depth)
{
	while (*(at = skip(at)) && !ascii_same(at, "END_", 4)) {
		const char *colon = part_end(at, ":"), *type = colon + (*colon == ':'), *end, *value;

		if (at[0] == '(' && at[1] == '*') {
			at = strstr(at, "*)");
			at = at ? at + 2 : "";
			continue;
		}
		end = ascii_same(skip(type), "STRUCT", 6) ? strstr(type, "END_STRUCT") : part_end(type, ";");
		if (!end)
			return;
		value = part_end(type, ":;");
		plco_named(out, "variable", "name", part(out, at, colon), false);
		put_inner_type(out, "type", part(out, type, value < end ? value : end), depth);
		if (value < end && *value == ':') {
			plco_open(out, "initialValue");
			put_value(out, part(out, value + 2, end), depth + 1);
			plco_close(out, "initialValue");
		}
		plco_close(out, "variable");
		at = part_end(end, ";");
		at += *at == ';';
	}
}

static void put_text_type(struct out *out, const char *element, const char *at)
{
	const char *end;

	at = skip(at);
	if (*at != '[' && *at != '(') {
		plco_line(out, "%s", element);
		return;
	}
	end = part_end(at + 1, "])");
	plco_named(out, element, "length", part(out, at + 1, end), true);
}

static void put_named_type(struct out *out, const char *text, int depth)
{
	const char *end = text + strcspn(text, " ([");
	const char *name = part(out, text, end), *behind = skip(end);

	if (*behind == '(') {
		const bool range = *part_end(behind + 1, ".)") == '.';
		const bool unsigned_type = ascii_upper(*name) == 'U' || strstr(name, "BYTE") || strstr(name, "WORD");
		const char *element = !range ? "enum" : unsigned_type ? "subrangeUnsigned" : "subrangeSigned";

		plco_open(out, "%s", element);
		if (range)
			put_range(out, "range", behind + 1, part_end(behind + 1, ")"));
		else
			put_names(out, behind + 1);
		put_inner_type(out, "baseType", name, depth);
		plco_close(out, element);
		return;
	}
	for (size_t i = 0; i < sizeof(elementary) / sizeof(*elementary); i++)
		if (!strcmp(elementary[i].word, name)) {
			plco_line(out, "%s", elementary[i].element);
			return;
		}
	plco_named(out, "derived", "name", name, true);
}

static void put_type(struct out *out, const char *text, int depth)
{
	text = skip(text);
	if (depth > MOST_NESTED)
		plco_line(out, "ANY");
	else if (word_at(&text, "ARRAY"))
		put_array(out, text, depth);
	else if (word_at(&text, "STRUCT")) {
		plco_open(out, "struct");
		put_members(out, text, depth);
		plco_close(out, "struct");
	} else if (*text == '(') {
		plco_open(out, "enum");
		put_names(out, text + 1);
		plco_close(out, "enum");
	} else if (word_at(&text, "STRING")) {
		put_text_type(out, "string", text);
	} else if (word_at(&text, "WSTRING")) {
		put_text_type(out, "wstring", text);
	} else if (word_at(&text, "POINTER") || word_at(&text, "REFERENCE")) {
		word_at(&text, "TO");
		plco_open(out, "pointer");
		put_inner_type(out, "baseType", text, depth);
		plco_close(out, "pointer");
	} else if (word_at(&text, "REF_TO")) {
		plco_open(out, "pointer");
		put_inner_type(out, "baseType", text, depth);
		plco_close(out, "pointer");
	} else {
		put_named_type(out, text, depth);
	}
}

/* ---- values ---- */

/* 3(0): three times 0. The number before the parenthesis, or NULL. */
static const char *repeated(struct out *out, const char *item, const char **inner)
{
	const size_t digits = strspn(item, "0123456789_");
	const char *end;

	if (!digits || item[digits] != '(')
		return NULL;
	end = part_end(item + digits + 1, ")");
	*inner = part(out, item + digits + 1, end);
	return part(out, item, item + digits);
}

static void put_list(struct out *out, const char *at, int depth)
{
	plco_open(out, "arrayValue");
	while (*(at = skip(at)) && *at != ']') {
		const char *end = part_end(at, ",]"), *item = part(out, at, end), *inner = item;
		const char *times = repeated(out, item, &inner);

		if (times)
			plco_open(out, "value repetitionValue=\"%s\"", times);
		else
			plco_open(out, "value");
		put_value(out, inner, depth + 1);
		plco_close(out, "value");
		at = *end == ',' ? end + 1 : end;
	}
	plco_close(out, "arrayValue");
}

static void put_pairs(struct out *out, const char *at, int depth)
{
	plco_open(out, "structValue");
	while (*(at = skip(at)) && *at != ')') {
		const char *end = part_end(at, ",)"), *colon = part_end(at, ":");

		if (colon > end)
			colon = end;
		plco_named(out, "value", "member", part(out, at, colon), false);
		put_value(out, part(out, colon + 2 > end ? end : colon + 2, end), depth + 1);
		plco_close(out, "value");
		at = *end == ',' ? end + 1 : end;
	}
	plco_close(out, "structValue");
}

/* A parenthesis with := in it. */
static bool is_pairs(const char *text)
{
	const char *colon;

	if (*text != '(')
		return false;
	colon = part_end(text + 1, ":)");
	return colon[0] == ':' && colon[1] == '=';
}

static void put_value(struct out *out, const char *text, int depth)
{
	text = skip(text);
	if (*text == '[' && depth < MOST_NESTED)
		put_list(out, text + 1, depth);
	else if (is_pairs(text) && depth < MOST_NESTED)
		put_pairs(out, text + 1, depth);
	else
		plco_named(out, "simpleValue", "value", text, true);
}

/* ---- variables ---- */

static const char *type_text(struct out *out, const struct var *var)
{
	const struct word_row *row = var->type == IEC_NONE && !var->named ?
				     words_own(&out->project->words, var->fb) : NULL;
	struct sink_memory memory;
	struct sink sink;
	char *text;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (row && row->kind == WORD_STRUCT && row->owner >= 0 && !out->project->structure[row->owner].name) {
		project_write_array(out->project, var, &sink);
		sink_text(&sink, plco_id(out, write_inner_text(out->project, &out->project->structure[row->owner])));
	} else {
		project_write_type(out->project, var, &sink);
	}
	text = arena_copy(out->arena, sink_memory_text(&memory), memory.len);
	sink_memory_free(&memory);
	return text ? text : "";
}

void plco_type(struct out *out, const char *name, const struct var *var)
{
	put_inner_type(out, name, type_text(out, var), 0);
}

bool plco_type_is_named(struct out *out, const struct var *var)
{
	return !strchr(type_text(out, var), '(');
}

void plco_initial(struct out *out, const struct var *var)
{
	struct sink_memory memory;
	struct sink sink;
	const char *text;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	project_write_init(out->project, var, &sink);
	text = skip(sink_memory_text(&memory));
	if (text[0] == ':' && text[1] == '=') {
		plco_open(out, "initialValue");
		put_value(out, text + 2, 0);
		plco_close(out, "initialValue");
	}
	sink_memory_free(&memory);
}

static void put_variable(struct out *out, const struct var *var)
{
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<variable name=\"");
	plco_escape(out, plco_id(out, var->name));
	if (var->at_text) {
		sink_text(&out->sink, "\" address=\"");
		plco_escape(out, plco_id(out, var->at_text));
	}
	sink_text(&out->sink, "\">\n");
	out->depth++;
	plco_type(out, "type", var);
	plco_initial(out, var);
	if (var->edge)
		plco_lost(out, REPORT_LOST, var->line, 0, report_said(out->report,
			 REPORTED("the format has no inputs with edges: \"%s\" is a plain one")), plco_id(out, var->name));
	plco_documentation(out, plco_id(out, var->comment));
	plco_close(out, "variable");
}

void plco_block(struct out *out, const struct var_table *table, int number, const char *element)
{
	const struct var_block *block = &table->block[number];

	if (!block->count || block->flags & (VAR_RESULT | VAR_SFC))
		return;
	plco_open(out, "%s%s%s%s", element, block->flags & (VAR_CONSTANT | VAR_FIXED) ? " constant=\"true\"" : "",
		 block->flags & VAR_RETAIN ? " retain=\"true\"" : "",
		 block->flags & VAR_NON_RETAIN ? " nonretain=\"true\"" : "");
	for (int i = block->first; i < block->first + block->count; i++)
		put_variable(out, &table->var[i]);
	plco_documentation(out, plco_id(out, block->comment));
	plco_close(out, element);
}

static const char *list_of(uint16_t flags)
{
	return flags & VAR_INPUT ? "inputVars" : flags & VAR_OUTPUT ? "outputVars" :
	       flags & VAR_IN_OUT ? "inOutVars" : flags & VAR_TEMP ? "tempVars" :
	       flags & VAR_EXTERNAL ? "externalVars" : "localVars";
}

void plco_variables(struct out *out, const struct var_table *table)
{
	for (int i = 0; i < table->block_count; i++)
		plco_block(out, table, i, list_of(table->block[i].flags));
}

/* ---- types with a name ---- */

static void put_structure(struct out *out, const struct structure *structure)
{
	plco_named(out, "dataType", "name", plco_id(out, structure->name), false);
	plco_open(out, "baseType");
	plco_open(out, "struct");
	for (int i = 0; i < structure->vars.count; i++)
		put_variable(out, &structure->vars.var[i]);
	plco_close(out, "struct");
	plco_close(out, "baseType");
	plco_documentation(out, plco_id(out, structure->comment));
	plco_close(out, "dataType");
}

void plco_types(struct out *out)
{
	const struct project *project = out->project;

	for (int i = 0; i < project->named_count; i++) {
		const struct var *var = project->named[i].like.var;

		if (!var)
			continue;
		plco_named(out, "dataType", "name", plco_id(out, project->named[i].name), false);
		plco_type(out, "baseType", var);
		plco_initial(out, var);
		plco_documentation(out, plco_id(out, var->comment));
		plco_close(out, "dataType");
	}
	for (int i = 0; i < project->structure_count; i++) {
		const struct structure *structure = &project->structure[i];

		if (!structure->name)
			continue;
		if (strcmp(project_struct_begin(structure), "STRUCT") != 0)
			plco_lost(out, REPORT_LOST, 0, 0, report_said(out->report,
				 REPORTED("the format has no unions: %s becomes a structure")), plco_id(out, structure->name));
		put_structure(out, structure);
	}
}
