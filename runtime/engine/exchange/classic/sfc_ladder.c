/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder - writes a project with ladders instead of its charts: texts, addresses,
 * declarations.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

#include "engine/base/ascii.h"
#include "engine/check/scope.h"
#include "engine/exchange/foreign_text.h"
#include "engine/text/text.h"
#include "engine/xref/address_map.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PASSES 4      /* a variable in use can need others, at most so many levels */
#define FIRST_BYTE 10 /* step bits begin at M10.0, where they are free           */

/* ---- texts ---- */

char *lad_text(struct lad *e, const char *format, ...)
{
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(e->arena, format, args);
	va_end(args);
	e->good &= text != NULL;
	return text ? text : (char *)"";
}

const char *lad_name(const struct lad *e, int step)
{
	return project_text(e->project, e->sfc->step[step].name);
}

const char *lad_use(struct lad *e, struct lad_var *var)
{
	var->used = true;
	return project_text(e->project, var->name);
}

void lad_refuse(struct lad *e, int line, int column, const char *what)
{
	const struct diag place = { .id = DIAG_SFC_NO_LADDER, .file = e->pou->file,
		.line = line, .column = column,
		.pou = project_text(e->project, e->pou->name) };

	if (e->good)
		diag_add(e->diags, place, "%s", what);
	e->good = false;
}

bool lad_letter(char c)
{
	return (unsigned char)c > 127 || c == '_' || ascii_digit(c) ||
	       (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z');
}

/* The name in the ladder of a word of the chart; NULL: unchanged. @len: gets its length. */
static const char *word_of(struct lad *e, const char *text, size_t *len)
{
	struct names *names = &e->project->names;
	const uint32_t id = names_intern(names, text, *len);
	const char *behind = text + *len;
	int step;

	if (ascii_is(SFC_CONDITION, text, *len) && e->condition)
		return e->condition;
	if (e->renamed) {
		const int var = vars_find(&e->pou->vars, names_fold(names, id));

		if (var >= 0 && e->renamed[var])
			return project_text(e->project, e->renamed[var]);
	}
	if (behind[0] != '.' || lad_letter(behind[2]) ||
	    (ascii_upper(behind[1]) != 'X' && ascii_upper(behind[1]) != 'T'))
		return NULL;
	step = sfc_find_step(e->sfc, names, id);
	if (step < 0)
		return NULL;
	*len += 2;
	return lad_use(e, &e->step[step][ascii_upper(behind[1]) == 'X' ? LAD_X : LAD_T]);
}

/* Length of a quoted text or comment at @at; 0: there is none. */
static size_t skip_quoted(const char *at)
{
	const char *end = NULL;

	if (*at == '\'' || *at == '"')
		end = strchr(at + 1, *at);
	else if (at[0] == '(' && at[1] == '*')
		end = strstr(at + 2, "*)");
	return end ? (size_t)(end - at) + (*at == '(' ? 2 : 1) : 0;
}

char *lad_words(struct lad *e, const char *text)
{
	struct sink_memory memory;
	struct sink sink;
	bool reference = false;
	char *out;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	while (*text) {
		size_t len = skip_quoted(text);
		const char *word = NULL;

		if (!len && lad_letter(*text)) {
			while (lad_letter(text[len]))
				len++;
			word = word_of(e, text, &len);
			e->refers |= word && reference;
			reference = ascii_is("ADR", text, len) || ascii_is("REF", text, len);
		} else if (*text != '(' && *text != ' ') {
			reference = false;
		}
		len += !len;
		if (word)
			sink_text(&sink, word);
		else
			sink_write(&sink, text, len);
		text += len;
		/* What follows a point is a member, not a step. */
		while (!word && *text == '.' && lad_letter(text[1])) {
			for (len = 1; lad_letter(text[len]); len++)
				;
			sink_write(&sink, text, len);
			text += len;
		}
	}
	out = lad_text(e, "%s", sink_memory_text(&memory));
	e->good &= !memory.failed;
	sink_memory_free(&memory);
	return out;
}

/* ---- addresses ---- */

static uint32_t fold_of(const struct lad *e, uint32_t name)
{
	return names_fold(&e->project->names, name);
}

static bool find_addresses(struct lad *e)
{
	const uint32_t count = (uint32_t)e->sfc->step_count;
	struct address_map map;
	struct iec_addr before = e->last;

	if (!address_map_make(&map, e->xref, e->arena))
		return false;
	if (address_map_next(&map, AREA_M, 1, count, &before, &e->at) ||
	    (!e->sfcs && address_map_next(&map, AREA_M, 1, count, NULL, &e->at))) {
		const uint32_t last = e->at.byte * 8u + e->at.bit + count - 1;

		e->last = (struct iec_addr){ .area = AREA_M, .bits = 1,
					     .bit = (uint8_t)(last % 8), .byte = last / 8 };
		e->sfcs++;
		return true;
	}
	lad_refuse(e, e->pou->line, 0, "M has no room for a bit of each step");
	return false;
}

/* ---- declarations ---- */

static void declare(struct lad *e, const struct sink *out, const struct lad_var *var,
		    const char *at)
{
	if (!var->used)
		return;
	sink_text(out, "  ");
	sink_text(out, project_text(e->project, var->name));
	sink_text(out, at);
	sink_text(out, " : ");
	sink_text(out, var->type);
	sink_text(out, ";");
	if (var->comment) {
		sink_text(out, " (* ");
		sink_text(out, var->comment);
		sink_text(out, " *)");
	}
	sink_text(out, "\n");
}

static void declare_all(struct lad *e, const struct sink *out)
{
	char at[40];

	sink_text(out, "VAR\n");
	for (int i = 0; i < e->sfc->step_count; i++) {
		const uint32_t bit = e->at.byte * 8u + e->at.bit + (uint32_t)i;

		/* ADR takes no variable with an address. */
		at[0] = 0;
		if (!e->refers)
			snprintf(at, sizeof(at), " AT %%MX%u.%u", bit / 8, bit % 8);
		e->step[i][LAD_X].used = true;
		declare(e, out, &e->step[i][LAD_X], at);
	}
	for (int i = 0; i < LAD_SFC_VARS; i++)
		declare(e, out, &e->whole[i], "");
	for (int i = 0; i < e->sfc->step_count; i++)
		for (int k = LAD_T; k < LAD_STEP_VARS; k++)
			declare(e, out, &e->step[i][k], "");
	for (int i = 0; i < e->net.arc_count; i++)
		for (int k = 0; k < LAD_ARC_VARS; k++)
			declare(e, out, &e->arc[i][k], "");
	for (int i = 0; i < e->sfc->use_count; i++)
		for (int k = 0; k < LAD_LINE_VARS; k++)
			declare(e, out, &e->line[i][k], "");
	for (int i = 0; i < e->called_count; i++)
		for (int k = 0; k < LAD_CALL_VARS; k++)
			declare(e, out, &e->called[i].var[k], "");
	sink_text(out, "END_VAR\n\n");
}

/* ---- one chart ---- */

/* Does another chart have a variable of this name? Variables of charts become global. */
static bool is_elsewhere(const struct lad *e, uint32_t fold)
{
	for (int i = 0; i < e->project->pou_count; i++) {
		const struct pou *pou = &e->project->pou[i];

		if (pou != e->pou && pou->sfc && vars_find(&pou->vars, fold) >= 0)
			return true;
	}
	return vars_find(&e->project->globals, fold) >= 0;
}

static void check_var(struct lad *e, int index)
{
	const struct var *var = &e->pou->vars.var[index];

	if (e->renamed && is_elsewhere(e, var->fold))
		e->renamed[index] = lad_fresh(e, lad_text(e, "%s_%s",
			project_text(e->project, e->pou->name),
			project_text(e->project, var->name)));
}

/* Renames variables whose names another chart has. */
static void check_table(struct lad *e)
{
	const struct var_table *table = &e->pou->vars;

	e->renamed = arena_alloc(e->arena, ((size_t)table->count + 1) *
				 sizeof(*e->renamed));

	for (int i = 0; i < table->block_count; i++) {
		const struct var_block *block = &table->block[i];

		if (block->flags & VAR_TEMP)
			lad_refuse(e, block->line, 0, "VAR_TEMP");
		for (int k = 0; !(block->flags & VAR_SFC) && k < block->count; k++)
			check_var(e, block->first + k);
	}
}

/* Finds the type of FORCE, for the variable that keeps its last value. */
static void type_number(struct lad *e)
{
	const uint32_t force = e->sfc->control[CONTROL_FORCE];
	struct scope *scope = force ? scope_new(e->project, e->arena) : NULL;
	enum diag_id why;
	const struct meaning *m = scope ? scope_find(scope, e->pou, force, &why) : NULL;

	e->reach = 0;
	if (m && m->type != IEC_NONE) {
		const struct iec_type_row *row = iec_type_row(m->type);

		e->whole[LAD_NUMBER].type = row->word;
		e->reach = iec_is_wide(m->type) || row->high > e->sfc->step_count ?
			   e->sfc->step_count : (int)row->high;
	} else if (force) {
		lad_refuse(e, e->sfc->control_line, 0, "FORCE");
	}
}

static void check_place(struct lad *e)
{
	const struct config *config = e->project->config;

	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_PROGRAM &&
		    fold_of(e, config->entry[i].pou) == fold_of(e, e->pou->name))
			lad_refuse(e, config->entry[i].line, 0,
				   project_text(e->project, e->pou->name));
	if (e->pou->included)
		lad_refuse(e, e->pou->line, 0, "it stands in an included file");
}

static bool begin(struct lad *e)
{
	const size_t steps = (size_t)e->sfc->step_count + 1;
	const size_t arcs = (size_t)e->sfc->transition_count + 1;
	const size_t lines = (size_t)e->sfc->use_count + 1;
	const size_t actions = (size_t)e->sfc->action_count;

	e->refers = false;
	check_table(e);
	check_place(e);
	e->step = arena_alloc(e->arena, steps * sizeof(*e->step));
	e->arc = arena_alloc(e->arena, arcs * sizeof(*e->arc));
	e->line = arena_alloc(e->arena, lines * sizeof(*e->line));
	e->called = arena_alloc(e->arena, (lines + actions) * sizeof(*e->called));
	e->body = arena_alloc(e->arena, (arcs + actions) * sizeof(*e->body));
	if (!e->good || !e->step || !e->arc || !e->line || !e->called || !e->body ||
	    !sfc_net_make(e->sfc, e->arena, &e->net) || !find_addresses(e))
		return false;
	lad_names(e);
	type_number(e);
	return e->good;
}

static void head(struct lad *e, uint32_t name)
{
	sink_text(&e->out, "PROGRAM ");
	sink_text(&e->out, project_text(e->project, name));
	sink_text(&e->out, " LD\n");
}

/* Writes both programs, and their subroutines. */
static void write_once(struct lad *e, struct sink_memory *programs,
		       struct sink_memory *subs)
{
	e->out = sink_to_memory(programs);
	e->subs = sink_to_memory(subs);
	head(e, e->steps_name);
	lad_steps(e);
	sink_text(&e->out, "END_PROGRAM\n\n");
	if (e->called_count) {
		head(e, e->outputs_name);
		lad_outputs(e);
		sink_text(&e->out, "END_PROGRAM\n\n");
	}
	e->good &= !programs->failed && !subs->failed;
}

static void write_vars(struct lad *e, const struct sink *out)
{
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	text_write_vars(e->project, &e->pou->vars, &sink);
	e->good &= !memory.failed;
	sink_text(out, lad_words(e, sink_memory_text(&memory)));
	sink_text(out, "\n");
	sink_memory_free(&memory);
}

static void write_one_sfc(struct lad *e, const struct sink *out)
{
	struct sink_memory programs, subs;

	for (int pass = 0; pass < PASSES && e->good; pass++) {
		sink_memory_init(&programs);
		sink_memory_init(&subs);
		write_once(e, &programs, &subs);
		if (pass == PASSES - 1 && e->good) {
			write_vars(e, out);
			declare_all(e, out);
			sink_text(out, sink_memory_text(&programs));
			sink_text(out, sink_memory_text(&subs));
		}
		sink_memory_free(&programs);
		sink_memory_free(&subs);
	}
}

/* ---- the project ---- */

/* Places of POUs in the text of the project. */
struct pou_spans {
	struct text_span *span;
	int count;
};

static void take(void *context, const struct text_span *span)
{
	struct pou_spans *spans = context;

	if (span->part == TEXT_POU && span->number < spans->count)
		spans->span[span->number] = *span;
}

static bool write_project_text(struct lad *e, const uint8_t *wanted, const struct sink *sink)
{
	struct project *project = e->project;
	struct pou_spans spans = { .count = project->pou_count };
	size_t len, at = 0;
	char *text;

	spans.span = arena_alloc(e->arena, ((size_t)spans.count + 1) *
				 sizeof(*spans.span));
	text = spans.span ? text_outline(project, &len, take, &spans) : NULL;
	if (!text)
		return false;
	for (int i = 0; i < project->pou_count && e->good; i++) {
		const struct text_span *span = &spans.span[i];

		e->pou = &project->pou[i];
		e->sfc = e->pou->sfc;
		e->called_count = 0;
		if (!e->sfc || (wanted && !wanted[i]))
			continue;
		if (!begin(e))
			e->good = false;
		sink_write(sink, text + at, span->at - at);
		if (e->good)
			write_one_sfc(e, sink);
		at = span->at + span->len;
	}
	sink_write(sink, text + at, len - at);
	free(text);
	return e->good;
}

static bool export_all(struct lad *e, const uint8_t *wanted, const struct sink *sink)
{
	struct xref xref;
	bool good;

	e->xref = &xref;
	good = xref_make(&xref, e->project) && write_project_text(e, wanted, sink);
	xref_free(&xref);
	return good;
}

bool sfc_ladder(struct project *project, const uint8_t *wanted, const struct sink *sink,
		struct diag_list *diags)
{
	const struct diag place = { .id = DIAG_NO_MEMORY, .file = project->file };
	const int before = diags->errors;
	struct arena arena;
	struct lad *e;
	bool good;

	arena_init(&arena);
	e = arena_alloc(&arena, sizeof(*e));
	if (e) {
		*e = (struct lad){ .project = project, .diags = diags, .good = true,
				   .arena = &arena, .last = { .area = AREA_M, .bits = 1,
				   .bit = 7, .byte = FIRST_BYTE - 1 } };
	}
	good = e && export_all(e, wanted, sink);
	arena_free(&arena);
	if (!good && diags->errors == before)
		diag_add(diags, place, "%s", "");
	return good;
}
