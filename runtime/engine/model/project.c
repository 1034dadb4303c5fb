/* SPDX-License-Identifier: MIT
 *
 * project - the contents of a rung file: variables, POUs, rungs.
 *
 * Readers and editors fill it. It reads no files and checks nothing.
 */
#include "engine/model/project.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/model/st.h"


#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct project *project_new(const char *file)
{
	struct project *project = calloc(1, sizeof(*project));

	if (!project)
		return NULL;
	arena_init(&project->arena);
	names_init(&project->names, &project->arena);
	words_init(&project->words, &project->arena);
	if (!file)
		file = "";
	project->file = arena_copy(&project->arena, file, strlen(file));
	if (project->arena.failed) {
		project_free(project);
		return NULL;
	}
	return project;
}

void project_free(struct project *project)
{
	if (!project)
		return;
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *pou = &project->pou[i];

		for (int at = 0; at < pou->rung_count; at++)
			rung_free(pou->rung[at]);
		free(pou->rung);
	}
	arena_free(&project->arena);
	free(project);
}

/* Capacity is the next power of two from 8 up. */
static bool has_room(struct pou *pou)
{
	size_t count = (size_t)pou->rung_count;
	size_t room = count ? count * 2 : 8;
	struct rung **rung;

	if (count && (count < 8 || (count & (count - 1))))
		return true;
	rung = realloc(pou->rung, room * sizeof(struct rung *));
	if (!rung)
		return false;
	pou->rung = rung;
	return true;
}

bool project_add_rung(struct pou *pou, int at, struct rung *rung)
{
	if (!rung || at < 0 || at > pou->rung_count ||
	    pou->rung_count >= LIMIT_RUNGS || !has_room(pou))
		return false;
	memmove(pou->rung + at + 1, pou->rung + at,
		(size_t)(pou->rung_count - at) * sizeof(struct rung *));
	pou->rung[at] = rung;
	pou->rung_count++;
	return true;
}

struct rung *project_take_rung(struct pou *pou, int at)
{
	struct rung *rung;

	if (at < 0 || at >= pou->rung_count)
		return NULL;
	rung = pou->rung[at];
	pou->rung_count--;
	memmove(pou->rung + at, pou->rung + at + 1,
		(size_t)(pou->rung_count - at) * sizeof(struct rung *));
	if (pou->rung_count == 0) {
		free(pou->rung);
		pou->rung = NULL;
	}
	return rung;
}

bool project_areas(const struct project *project, struct areas *out)
{
	const struct config *config = project->config;

	areas_init(out);
	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_AREA)
			out->bytes[config->entry[i].area] = config->entry[i].bytes;
	return areas_place(out);
}

bool project_has(const struct project *project, struct iec_addr addr)
{
	struct areas areas;

	project_areas(project, &areas);
	return addr.area == AREA_NONE || areas_have(&areas, addr);
}

bool pou_has_frame(const struct pou *pou)
{
	return pou->kind == POU_FUNCTION || pou->kind == POU_BLOCK;
}

bool pou_has_any_bounds(const struct pou *pou)
{
	for (int i = 0; pou_has_frame(pou) && i < pou->vars.count; i++)
		if (pou->vars.var[i].any_bounds)
			return true;
	return false;
}

const struct boxed *pou_boxed(const struct pou *pou, int rung, int row, int col)
{
	int low = 0, high = pou->boxed_count;

	while (low < high) {
		const int middle = low + (high - low) / 2;

		if (pou->boxed[middle].rung < rung)
			low = middle + 1;
		else
			high = middle;
	}
	for (; low < pou->boxed_count && pou->boxed[low].rung == rung; low++)
		if (pou->boxed[low].row == row && pou->boxed[low].col == col)
			return &pou->boxed[low];
	return NULL;
}

const struct access_block *access_block_of(const struct project *project, int index)
{
	int at = 0;

	while (at < project->access_block_count - 1 &&
	       index >= project->access_block[at].first + project->access_block[at].count)
		at++;
	return &project->access_block[at];
}

const char *access_word(bool writes)
{
	return writes ? "READ_WRITE" : "READ_ONLY";
}

const char *pou_word(enum pou_kind kind)
{
	static const char *const words[] = {
		[POU_PROGRAM] = "PROGRAM", [POU_FUNCTION] = "FUNCTION",
		[POU_BLOCK] = "FUNCTION_BLOCK",
		[POU_SUBROUTINE] = "SUBROUTINE", [POU_ACTION] = "ACTION",
	};

	return words[kind];
}

const char *pou_language_word(enum pou_language language)
{
	static const char *const words[] = {
		[LANGUAGE_LD] = "LD", [LANGUAGE_IL] = "IL", [LANGUAGE_SFC] = "SFC",
		[LANGUAGE_ST] = "ST", [LANGUAGE_FBD] = "FBD",
	};

	return words[language];
}

bool project_is_further(struct project *project, const struct config_entry *entry)
{
	const struct config_entry *before = project->config->entry;
	struct names *names = &project->names;

	for (; entry->kind == CONFIG_PROGRAM && before < entry; before++)
		if (before->kind == CONFIG_PROGRAM &&
		    names_fold(names, before->pou) == names_fold(names, entry->pou))
			return true;
	return false;
}

uint32_t project_called(struct project *project, const struct config_entry *entry, int index)
{
	char text[2 * LIMIT_NAME + 8]; /* both names, a point and "()" */
	const int len = snprintf(text, sizeof(text), "%s.%s()",
				 project_text(project, project_is_further(project, entry) ? entry->name : entry->pou),
				 project_text(project, entry->called[index].name));

	return names_intern(&project->names, text, (size_t)len);
}

int project_find_pou(const struct project *project, const char *name, size_t len)
{
	for (int i = 0; i < project->pou_count; i++)
		if (name_is(project_text(project, project->pou[i].name), name, len))
			return i;
	return -1;
}

const char *pou_own_name(const struct project *project, const struct pou *pou)
{
	const char *name = project_text(project, pou->name);
	const char *dot = pou->kind == POU_ACTION ? strchr(name, '.') : NULL;

	return dot ? dot + 1 : name;
}

int pou_owner(const struct project *project, const struct pou *pou)
{
	const char *name = project_text(project, pou->name), *own = pou_own_name(project, pou);
	const int owner = own == name ? -1 : project_find_pou(project, name, (size_t)(own - name) - 1);

	return owner >= 0 && (project->pou[owner].kind == POU_PROGRAM ||
			      project->pou[owner].kind == POU_BLOCK) ? owner : -1;
}

bool project_has_head(const struct project *project)
{
	bool any = project->title;

	for (int i = 0; i < PROPERTY_COUNT; i++)
		any = any || project->property[i];
	return any;
}

const char *project_text(const struct project *project, uint32_t id)
{
	return names_text(&project->names, id);
}

/* ---- VIEW ---- */

static int view_part(const struct project *project)
{
	for (int i = 0; i < project->part_count; i++)
		if (project->part[i].kind == PART_VIEW && !project->part[i].included)
			return i;
	return -1;
}

const char *project_view(const struct project *project)
{
	const int at = view_part(project);

	return at < 0 ? "" : project_text(project, project->part[at].text);
}

bool project_view_is_last(const struct project *project)
{
	const int at = view_part(project);

	return at >= 0 && at == project->part_count - 1;
}

static bool add_view(struct project *project, uint32_t text)
{
	struct part *part = arena_push(&project->arena, &project->part,
				       &project->part_count, sizeof(*part));

	if (!part)
		return false;
	*part = (struct part){ .kind = PART_VIEW, .text = text };
	return true;
}

bool project_set_view(struct project *project, const char *text)
{
	const int at = view_part(project);
	uint32_t id;

	if (!text[0]) {
		if (at >= 0) {
			memmove(&project->part[at], &project->part[at + 1],
				(size_t)(project->part_count - at - 1) *
				sizeof(*project->part));
			project->part_count--;
		}
		return true;
	}
	id = names_intern(&project->names, text, strlen(text));
	if (!id)
		return false;
	if (at < 0)
		return add_view(project, id);
	project->part[at].text = id;
	return true;
}

/* (Red, Green := 5) of an enumeration, (0..100) of a subrange. */
static void write_values(const struct project *project, const struct var *var,
			 const struct sink *sink)
{
	const struct var_written *written = var->written;
	const struct enumeration *list;

	if (var->enumeration) {
		list = &project->enumeration[var->enumeration - 1];
		for (int i = 0; i < list->count; i++) {
			const struct enum_value *value = &project->enum_value[list->first + i];

			sink_printf(sink, "%s%s", i ? ", " : list->based ? " (" : "(",
				    project_text(project, value->name));
			if (value->text)
				sink_printf(sink, " := %s", project_text(project, value->text));
		}
		sink_text(sink, ")");
	} else if (var->range && written && written->range[0]) {
		sink_printf(sink, " (%s..%s)", project_text(project, written->range[0]),
			    project_text(project, written->range[1]));
	} else if (var->range) {
		sink_printf(sink, " (%lld..%lld)", (long long)var->range->low,
			    (long long)var->range->high);
	}
}

/* ARRAY[0..2, 1..Count] OF, without what a named type brings. */
static void write_dimensions(const struct project *project, const struct var *var,
			     const struct sink *sink)
{
	const struct var_written *written = var->written;

	for (int i = 0; i < var->own_dims; i++) {
		const uint32_t *text = written && written->dim ? written->dim[i] : NULL;

		sink_text(sink, i ? ", " : "ARRAY[");
		if (text)
			sink_printf(sink, "%s..%s", project_text(project, text[0]),
				    project_text(project, text[1]));
		else
			sink_printf(sink, "%ld..%lld", (long)var->dim[i].low,
				    (long long)var->dim[i].low + var->dim[i].count - 1);
	}
	sink_text(sink, "] OF ");
}

void project_write_array(const struct project *project, const struct var *var, const struct sink *sink)
{
	const struct var_written *written = var->written;

	if (var->any_bounds) {
		sink_text(sink, "ARRAY[*");
		for (int i = 1; i < var->own_dims; i++)
			sink_text(sink, ", *");
		sink_text(sink, "] OF ");
	} else if (written && written->bound[0]) {
		sink_text(sink, "ARRAY[");
		sink_text(sink, project_text(project, written->bound[0]));
		sink_text(sink, "..");
		sink_text(sink, project_text(project, written->bound[1]));
		sink_text(sink, "] OF ");
	} else if (var->own_dims > 1 || (var->own_dims && var->dims > 1)) {
		write_dimensions(project, var, sink);
	} else if (var->array.count && (!var->named || var->own_dims)) {
		sink_printf(sink, "ARRAY[%ld..%lld] OF ", (long)var->array.low,
			    (long long)var->array.low + var->array.count - 1);
	}
}

void project_write_values(const struct project *project, const struct config_entry *entry,
			  const struct sink *sink)
{
	for (int i = 0; i < entry->calls; i++)
		sink_printf(sink, "%s%s WITH %s", i ? ", " : " (", project_text(project, entry->called[i].name),
			    project_text(project, entry->called[i].own_task ? entry->called[i].own_task :
					 entry->called[i].task));
	for (int i = 0; i < entry->values; i++) {
		const char *text = project_text(project, entry->value[i].text);
		const char *sign = strstr(text, " := ");

		sink_text(sink, i || entry->calls ? ", " : " (");
		if (entry->value[i].behind && sign)
			sink_printf(sink, "%s => %.*s", sign + 4, (int)(sign - text), text);
		else
			sink_text(sink, text);
	}
	sink_text(sink, entry->values || entry->calls ? ")" : "");
}

void project_write_init(const struct project *project, const struct var *var, const struct sink *sink)
{
	char text[64];

	if (!var->has_init || var->inherits)
		return;
	sink_text(sink, " := ");
	if (var->init_text) {
		sink_text(sink, project_text(project, var->init_text));
		return;
	}
	literal_print(var->type, var->init, text, sizeof(text));
	sink_text(sink, text);
}

const char *project_struct_begin(const struct structure *structure)
{
	return structure->overlap == OVERLAP_UNION ? "UNION" :
	       structure->overlap == OVERLAP_STRUCT ? "STRUCT OVERLAP" : "STRUCT";
}

const char *project_struct_end(const struct structure *structure)
{
	return structure->overlap == OVERLAP_UNION ? "END_UNION" : "END_STRUCT";
}

/* On one line. Depth: LIMIT_NESTING. */
static void write_members(const struct project *project, const struct structure *structure,
			  const struct sink *sink)
{
	sink_printf(sink, "%s ", project_struct_begin(structure));
	for (int i = 0; i < structure->vars.count; i++) {
		const struct var *var = &structure->vars.var[i];

		sink_printf(sink, "%s : ", project_text(project, var->name));
		project_write_type(project, var, sink);
		project_write_init(project, var, sink);
		sink_text(sink, "; ");
	}
	sink_text(sink, project_struct_end(structure));
}

void project_write_type(const struct project *project, const struct var *var,
			const struct sink *sink)
{
	const struct var_written *written = var->written;
	const struct word_row *row = var->type == IEC_NONE ? words_own(&project->words, var->fb) : NULL;

	project_write_array(project, var, sink);
	if (row && !var->named && row->kind == WORD_STRUCT && row->owner >= 0 &&
	    !project->structure[row->owner].name) {
		write_members(project, &project->structure[row->owner], sink);
		return;
	}
	if (var->target && !var->named) {
		sink_text(sink, var->target->word == REF_TO ? "REF_TO " :
				var->target->word == REFERENCE_TO ? "REFERENCE TO " : "POINTER TO ");
		project_write_type(project, var->target->like, sink);
		return;
	}
	if (var->named) {
		sink_text(sink, project_text(project, project->named[var->named - 1].name));
		return;
	}
	if (var->wide)
		sink_text(sink, "W");
	if (var->letter) {
		sink_text(sink, "CHAR");
		return;
	}
	if (!var->enumeration || project->enumeration[var->enumeration - 1].based)
		sink_text(sink, var->type == IEC_NONE ? words_row(&project->words, var->fb)->word :
							iec_type_row(var->type)->word);
	write_values(project, var, sink);
	if (written && written->capacity) {
		sink_text(sink, "[");
		sink_text(sink, project_text(project, written->capacity));
		sink_text(sink, "]");
	} else if (var->type == IEC_STRING && var->capacity != IEC_STRING_DEFAULT) {
		sink_printf(sink, "[%u]", var->capacity ? var->capacity :
			    (unsigned)IEC_STRING_MOST); /* a temporary */
	}
}

void project_print_type(const struct project *project, const struct var *var, char *out, size_t size)
{
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	project_write_type(project, var, &sink);
	snprintf(out, size, "%s", sink_memory_text(&memory));
	sink_memory_free(&memory);
}
