/* SPDX-License-Identifier: MIT
 *
 * write_project - a project as its one canonical text.
 *
 * Parts that were read from included files are left out.
 */
#include "engine/base/literal.h"
#include "engine/model/fbd.h"
#include "engine/text/text.h"
#include "engine/text/writer.h"

#include <stdlib.h>
#include <string.h>

/* Columns of the string of @id. */
static int write_width(const struct project *project, uint32_t id)
{
	return utf8_width(project_text(project, id), names_len(&project->names, id));
}

/* ---- declarations ---- */

struct widths {
	int name, at;
	int depth;   /* of structures without a name around the declaration */
};

static struct widths measure(const struct project *project,
			     const struct var *var, int count)
{
	struct widths widths = { .name = 0 };

	for (int i = 0; i < count; i++) {
		int name = var_is_nameless(&var[i]) ? 0 : write_width(project, var[i].name);
		int at = write_width(project, var[i].at_text);

		widths.name = name > widths.name ? name : widths.name;
		widths.at = at > widths.at ? at : widths.at;
	}
	return widths;
}

static void write_var(const struct sink *sink, const struct project *project,
		      const struct var *var, const struct widths *widths);

/* The structure without a name that is the type of @var, or of its elements; NULL: it is another type. */
static const struct structure *inner_struct(const struct project *project, const struct var *var)
{
	const struct word_row *row = var->type == IEC_NONE && !var->named ?
				     words_own(&project->words, var->fb) : NULL;

	return row && row->kind == WORD_STRUCT && row->owner >= 0 && !project->structure[row->owner].name ?
	       &project->structure[row->owner] : NULL;
}

/* STRUCT … END_STRUCT, each member on its line. Depth: LIMIT_NESTING. */
static void write_inner(const struct sink *sink, const struct project *project,
			const struct structure *structure, const struct widths *around)
{
	struct widths widths = measure(project, structure->vars.var, structure->vars.count);

	widths.depth = around->depth + 1;
	sink_text(sink, project_struct_begin(structure));
	sink_text(sink, "\n");
	for (int i = 0; i < structure->vars.count; i++)
		write_var(sink, project, &structure->vars.var[i], &widths);
	sink_repeat(sink, "  ", widths.depth);
	sink_text(sink, project_struct_end(structure));
}

uint32_t write_inner_text(struct project *project, const struct structure *structure)
{
	const struct widths around = { .name = 0 };
	struct sink_memory memory;
	struct sink sink;
	uint32_t id = 0;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	write_inner(&sink, project, structure, &around);
	if (!memory.failed)
		id = names_intern(&project->names, sink_memory_text(&memory), memory.len);
	sink_memory_free(&memory);
	return id;
}

/* ---- long initial values ---- */

#define LINE_MOST 100 /* columns of a declaration whose initial value stands on one line */

/* The items of `[1, 2, 3]`. */
struct items {
	const char *at;      /* of the next one                               */
	const char *text;    /* of this one                                   */
	size_t len;
	bool last;
};

/* What holds for all of them. */
struct table {
	int width;           /* of the widest                                 */
	bool parts;          /* one is a structure or a row, or repeats some  */
	bool uneven;         /* one is a string, or repeats a number          */
};

static bool item_next(struct items *items)
{
	char quote = '\0';
	int depth = 0;

	if (items->last)
		return false;
	items->text = items->at;
	for (; depth > 0 || quote || (*items->at != ',' && *items->at != ']'); items->at++) {
		const char c = *items->at;

		if (!c)
			return false;
		if (quote && c == '$' && items->at[1])
			items->at++;
		else if (c == '\'' || c == '"')
			quote = !quote ? c : quote == c ? '\0' : quote;
		else if (!quote)
			depth += (c == '(' || c == '[') - (c == ')' || c == ']');
	}
	items->len = (size_t)(items->at - items->text);
	items->last = *items->at == ']';
	items->at += items->last ? 1 : 1 + strspn(items->at + 1, " ");
	return true;
}

static void note_item(struct table *table, const char *text, size_t len)
{
	const size_t at = strcspn(text, "('[\",]"); /* an item ends with , or ] */
	const char *inner = text + at + 1;

	if (at >= len)
		return;
	if (text[at] != '(' || at == 0)
		table->parts |= text[at] == '(' || text[at] == '[';
	else
		table->parts |= *inner == '(' || *inner == '[' || strncmp(inner + strcspn(inner, " '\"()"), " :=", 3) == 0;
	table->uneven |= !table->parts;
}

static struct table measure_items(const char *text)
{
	struct items items = { .at = text + 1 };
	struct table table = { .width = 0 };

	while (item_next(&items)) {
		const int width = utf8_width(items.text, items.len);

		table.width = width > table.width ? width : table.width;
		note_item(&table, items.text, items.len);
	}
	return table;
}

/* Items in a line: of numbers as many as the last dimension has, else ten or twenty, which are counted easily; of
 * structures and rows one; 0: as many as fit, whose number is not the same in each line. */
static int items_in_line(const struct var *var, const struct table *table, int indent)
{
	const int fit = (LINE_MOST - indent) / (table->width + 2);
	const int row = var->dims > 1 ? (int)var->dim[var->dims - 1].count : fit;

	if (table->parts)
		return 1;
	if (table->uneven || fit < 1)
		return 0;
	return row < fit ? row : fit > 10 ? fit - fit % 10 : fit;
}

/* `[` … `]` in lines between the first and the last one, numbers below one another. */
static void write_table(const struct sink *sink, const struct var *var, const char *text, int depth)
{
	struct items items = { .at = text + 1 };
	const struct table table = measure_items(text);
	const int indent = 2 * (depth + 2), most = items_in_line(var, &table, indent);
	int column = 0, count = 0;

	sink_text(sink, " := [");
	while (item_next(&items)) {
		const int width = utf8_width(items.text, items.len);
		const bool begins = column == 0 || (most ? count == most : column + 2 + width > LINE_MOST);

		if (begins) {
			sink_text(sink, "\n");
			sink_repeat(sink, " ", indent);
			column = indent;
			count = 0;
		} else {
			sink_text(sink, " ");
			column++;
		}
		if (most > 1)
			sink_repeat(sink, " ", table.width - width);
		sink_write(sink, items.text, items.len);
		sink_text(sink, items.last ? "" : ",");
		column += width + !items.last;
		count++;
	}
	sink_text(sink, "\n");
	sink_repeat(sink, "  ", 1 + depth);
	sink_text(sink, "]");
}

static void count_columns(void *columns, const char *text, size_t len)
{
	*(int *)columns += utf8_width(text, len);
}

static void write_initial(const struct sink *sink, const struct project *project, const struct var *var,
			  const struct widths *widths)
{
	const char *text = var->has_init && !var->inherits && var->init_text ?
			   project_text(project, var->init_text) : "";
	int columns = 2 * (1 + widths->depth) + widths->name + (var->at_text ? 4 + widths->at : 0);
	const struct sink counted = { .write = count_columns, .context = &columns };

	if (*text == '[') {
		project_write_type(project, var, &counted);
		columns += (int)strlen(" :  := ;") + write_width(project, var->init_text);
	}
	if (*text == '[' && columns > LINE_MOST)
		write_table(sink, var, text, widths->depth);
	else
		project_write_init(project, var, sink);
}

static void write_var(const struct sink *sink, const struct project *project,
		      const struct var *var, const struct widths *widths)
{
	const bool nameless = var_is_nameless(var);
	const int name = nameless ? 0 : write_width(project, var->name);
	const struct structure *inner = inner_struct(project, var);

	sink_repeat(sink, "  ", 1 + widths->depth);
	if (!nameless)
		write_id(sink, project, var->name);
	sink_repeat(sink, " ", widths->name - name);
	if (var->at_text) {
		sink_text(sink, widths->name ? " AT " : "AT ");
		write_id(sink, project, var->at_text);
		sink_repeat(sink, " ",
			    widths->at - write_width(project, var->at_text));
	}
	sink_text(sink, " : ");
	if (inner) {
		project_write_array(project, var, sink);
		write_inner(sink, project, inner, widths);
	} else {
		project_write_type(project, var, sink);
	}
	if (var->edge)
		sink_text(sink, var->edge == 1 ? " R_EDGE" : " F_EDGE");
	write_initial(sink, project, var, widths);
	sink_text(sink, ";");
	if (var->comment) {
		sink_text(sink, " ");
		write_id(sink, project, var->comment);
	}
	sink_text(sink, "\n");
}

static void write_marked_var(const struct sink *sink, const struct project *project,
			     const struct var *var, int number,
			     const struct widths *widths)
{
	sink_mark(sink, TEXT_VAR, number, true);
	write_var(sink, project, var, widths);
	sink_mark(sink, TEXT_VAR, number, false);
}

/* Marks tell an editor where it finds a block of the variables; others have none. */
static void mark_block(const struct sink *sink, const struct var_block *block, int index, bool open)
{
	if (!(block->flags & VAR_EXTERNAL))
		sink_mark(sink, TEXT_BLOCK, index, open);
}

/* VAR … END_VAR number @index of a table. */
static void write_block(const struct sink *sink, const struct project *project,
			const struct var_table *table, int index)
{
	const struct var_block *block = &table->block[index];
	const struct var *var = table->var ? table->var + block->first : NULL;
	const struct widths widths = measure(project, var, block->count);

	if (block->flags & (VAR_RESULT | VAR_SFC))
		return;
	write_above(sink, project, block->comment);
	mark_block(sink, block, index, true);
	sink_text(sink, vars_head(block->flags));
	if (block->flags & VAR_RETAIN)
		sink_text(sink, " RETAIN");
	if (block->flags & VAR_NON_RETAIN)
		sink_text(sink, " NON_RETAIN");
	if (block->flags & (VAR_CONSTANT | VAR_FIXED))
		sink_text(sink, " CONSTANT");
	sink_text(sink, "\n");
	for (int i = 0; i < block->count; i++)
		if (block->flags & VAR_EXTERNAL)
			write_var(sink, project, &var[i], &widths);
		else
			write_marked_var(sink, project, &var[i], block->first + i, &widths);
	sink_text(sink, "END_VAR\n");
	mark_block(sink, block, index, false);
}

void text_write_vars(const struct project *project, const struct var_table *table,
		     const struct sink *sink)
{
	for (int i = 0; i < table->block_count; i++)
		write_block(sink, project, table, i);
}

/* ---- VAR_ACCESS ---- */

static void write_access_line(const struct sink *sink, const struct project *project,
			      const struct access *access, int name, int path)
{
	const int number = (int)(access - project->access);

	sink_mark(sink, TEXT_ACCESS_LINE, number, true);
	sink_text(sink, "  ");
	write_id(sink, project, access->var.name);
	sink_repeat(sink, " ", name - write_width(project, access->var.name));
	sink_text(sink, " : ");
	write_id(sink, project, access->path);
	sink_repeat(sink, " ", path - write_width(project, access->path));
	sink_text(sink, " : ");
	project_write_type(project, &access->var, sink);
	sink_text(sink, " ");
	sink_text(sink, access_word(access->writes));
	sink_text(sink, ";");
	if (access->var.comment) {
		sink_text(sink, " ");
		write_id(sink, project, access->var.comment);
	}
	sink_text(sink, "\n");
	sink_mark(sink, TEXT_ACCESS_LINE, number, false);
}

/* Names and paths below one another. */
static void write_access(const struct sink *sink, const struct project *project, int index)
{
	const struct access_block *block = &project->access_block[index];
	const struct access *access = project->access ? project->access + block->first : NULL;
	int name = 0, path = 0;

	for (int i = 0; i < block->count; i++) {
		const int one = write_width(project, access[i].var.name);
		const int two = write_width(project, access[i].path);

		name = one > name ? one : name;
		path = two > path ? two : path;
	}
	write_above(sink, project, block->comment);
	sink_mark(sink, TEXT_ACCESS, index, true);
	sink_text(sink, "VAR_ACCESS\n");
	for (int i = 0; i < block->count; i++)
		write_access_line(sink, project, &access[i], name, path);
	sink_text(sink, "END_VAR\n");
	sink_mark(sink, TEXT_ACCESS, index, false);
}

void text_write_pou_access(const struct project *project, const struct pou *pou, const struct sink *sink)
{
	for (int i = 0; i < project->access_block_count; i++)
		if (project->access_block[i].pou == (int)(pou - project->pou) + 1)
			write_access(sink, project, i);
}

/* ---- parts ---- */

static void write_body(const struct sink *sink, const struct project *project,
		       const struct pou *pou)
{
	const int number = (int)(pou - project->pou);

	text_write_vars(project, &pou->vars, sink);
	text_write_vars(project, &pou->external, sink);
	text_write_pou_access(project, pou, sink);
	sink_mark(sink, TEXT_BODY, number, true);
	for (int i = 0; i < pou->rung_count; i++) {
		sink_mark(sink, TEXT_RUNG, i, true);
		write_rung(sink, project, pou->rung[i]);
		sink_mark(sink, TEXT_RUNG, i, false);
	}
	if (pou->language == LANGUAGE_IL)
		text_write_il(project, &pou->il, sink);
	for (int i = 0; pou->fbd && i < pou->fbd->count; i++) {
		sink_mark(sink, TEXT_RUNG, i, true);
		text_write_network(project, pou, i, sink);
		sink_mark(sink, TEXT_RUNG, i, false);
	}
	if (pou->language == LANGUAGE_ST && pou->st)
		text_write_st(project, pou->st, sink);
	write_above(sink, project, pou->tail);
	sink_mark(sink, TEXT_BODY, number, false);
}

/* Does an action stand behind its owner, or another action of it? */
static bool is_below_owner(const struct project *project, const struct pou *pou)
{
	const int owner = pou_owner(project, pou);

	while (pou > project->pou && pou->kind == POU_ACTION)
		pou--;
	return owner >= 0 && pou == &project->pou[owner];
}

/* One POU, from its heading to its end. @plain: its file needs no language. Scan-safe: no. */
static void text_write_pou(const struct project *project, const struct pou *pou, bool plain,
			   const struct sink *sink)
{
	const bool sfc = pou->language == LANGUAGE_SFC;

	sink_text(sink, pou_word(pou->kind));
	sink_text(sink, " ");
	if (pou->kind == POU_ACTION && is_below_owner(project, pou)) {
		sink_text(sink, pou_own_name(project, pou));
		sink_text(sink, ":");
	} else {
		write_id(sink, project, pou->name);
	}
	if (pou->kind == POU_FUNCTION && pou->vars.count > 0 && !pou->no_result) {
		sink_text(sink, " : ");
		project_write_type(project, &pou->vars.var[0], sink);
	}
	if ((!plain || !pou->unsaid) && pou->kind != POU_ACTION) {
		sink_text(sink, " ");
		sink_text(sink, pou_language_word(pou->language));
	}
	if (sfc && sfc_goes_round(pou->sfc)) {
		sink_text(sink, " ");
		sink_text(sink, sfc_evolution_words(pou->sfc->evolution));
	}
	sink_text(sink, "\n");
	if (pou->uses) {
		write_id(sink, project, pou->uses);
		sink_text(sink, "\n");
	}
	if (sfc)
		write_sfc(sink, project, pou);
	else
		write_body(sink, project, pou);
	sink_text(sink, "END_");
	sink_text(sink, pou_word(pou->kind));
	sink_text(sink, "\n");
}

static void write_pou(const struct sink *sink, const struct project *project,
		      const struct pou *pou, bool plain)
{
	const int number = (int)(pou - project->pou);

	write_above(sink, project, pou->comment);
	sink_mark(sink, TEXT_POU, number, true);
	text_write_pou(project, pou, plain, sink);
	sink_mark(sink, TEXT_POU, number, false);
}

static void write_struct(const struct sink *sink, const struct project *project,
			 const struct structure *structure)
{
	const struct var *var = structure->vars.var;
	struct widths widths = measure(project, var, structure->vars.count);
	const int number = (int)(structure - project->structure);

	widths.depth = 1;
	if (!structure->name) /* its variable writes it */
		return;

	sink_mark(sink, TEXT_STRUCT, number, true);
	sink_text(sink, "  ");
	write_id(sink, project, structure->name);
	sink_printf(sink, " : %s\n", project_struct_begin(structure));
	for (int i = 0; i < structure->vars.count; i++) {
		sink_mark(sink, TEXT_VAR, i, true);
		write_var(sink, project, &var[i], &widths);
		sink_mark(sink, TEXT_VAR, i, false);
	}
	sink_printf(sink, "  %s;", project_struct_end(structure));
	if (structure->comment) {
		sink_text(sink, " ");
		write_id(sink, project, structure->comment);
	}
	sink_text(sink, "\n");
	sink_mark(sink, TEXT_STRUCT, number, false);
}

/* Marked like a structure with one member. */
static void write_named_type(const struct sink *sink, const struct project *project, int index,
			     const struct widths *widths)
{
	const int number = project->structure_count + index;

	sink_mark(sink, TEXT_STRUCT, number, true);
	sink_mark(sink, TEXT_VAR, 0, true);
	write_var(sink, project, project->named[index].like.var, widths);
	sink_mark(sink, TEXT_VAR, 0, false);
	sink_mark(sink, TEXT_STRUCT, number, false);
}

/* The types of this part that are no structures and stand above structure @before. */
static void write_named(const struct sink *sink, const struct project *project,
			const struct part *part, int before)
{
	const int number = (int)(part - project->part);
	struct widths widths = { .name = 0 };

	for (int pass = 0; pass < 2; pass++)
		for (int i = 0; i < project->named_count; i++) {
			const struct named_type *type = &project->named[i];
			const int width = write_width(project, type->name);

			if (type->part != number || type->before != before || !type->like.var)
				continue;
			if (pass)
				write_named_type(sink, project, i, &widths);
			else
				widths.name = width > widths.name ? width : widths.name;
		}
}

static void write_types(const struct sink *sink, const struct project *project,
			const struct part *part)
{
	sink_text(sink, "TYPE\n");
	for (int i = 0; i < part->count; i++) {
		write_named(sink, project, part, part->index + i);
		write_struct(sink, project, &project->structure[part->index + i]);
	}
	write_named(sink, project, part, part->index + part->count);
	sink_text(sink, "END_TYPE\n");
}

struct config_writer {
	const struct sink *sink;
	const struct project *project;
};

static void put_id(const struct config_writer *w, const char *before, uint32_t id)
{
	sink_text(w->sink, before);
	write_id(w->sink, w->project, id);
}

static void put_comment(const struct config_writer *w, uint32_t comment)
{
	if (comment)
		put_id(w, " ", comment);
	sink_text(w->sink, "\n");
}

static void put_task(const struct config_writer *w,
		     const struct config_entry *entry)
{
	put_id(w, "TASK ", entry->own_name ? entry->own_name : entry->name);
	if (entry->interval)
		put_id(w, " (INTERVAL := ", entry->interval);
	else
		put_id(w, " (SINGLE := ", entry->single);
	sink_printf(w->sink, ", PRIORITY := %u", (unsigned)entry->priority);
	if (entry->watchdog)
		put_id(w, ", WATCHDOG := ", entry->watchdog);
	sink_text(w->sink, ");");
}

static void put_program(const struct config_writer *w,
			const struct config_entry *entry)
{
	put_id(w, "PROGRAM ", entry->own_name ? entry->own_name : entry->name);
	if (entry->task)
		put_id(w, " WITH ", entry->own_task ? entry->own_task : entry->task);
	put_id(w, " : ", entry->pou);
	project_write_values(w->project, entry, w->sink);
	sink_text(w->sink, ";");
}

/* VAR_CONFIG … END_VAR */
static void write_located(const struct sink *sink, const struct project *project, int index)
{
	const struct var_block *block = &project->located.block[index];
	const struct var *var = project->located.var ? project->located.var + block->first : NULL;
	const struct widths widths = measure(project, var, block->count);

	write_above(sink, project, block->comment);
	sink_text(sink, "VAR_CONFIG\n");
	for (int i = 0; i < block->count; i++)
		write_var(sink, project, &var[i], &widths);
	sink_text(sink, "END_VAR\n");
}

static void put_entry(const struct config_writer *w,
		     const struct config_entry *entry)
{
	const int number = (int)(entry - w->project->config->entry);

	if (entry->kind == CONFIG_VARS) {
		write_block(w->sink, w->project, &w->project->globals,
			    entry->block);
		return;
	}
	if (entry->kind == CONFIG_ACCESS) {
		write_access(w->sink, w->project, entry->block);
		return;
	}
	if (entry->kind == CONFIG_LOCATED) {
		write_located(w->sink, w->project, entry->block);
		return;
	}
	sink_mark(w->sink, TEXT_ENTRY, number, true);
	sink_text(w->sink, entry->inside ? "    " : "  ");
	if (entry->kind == CONFIG_TASK)
		put_task(w, entry);
	else if (entry->kind == CONFIG_PROGRAM)
		put_program(w, entry);
	else
		sink_printf(w->sink, "AREA %s %u;",
			    iec_area_row(entry->area)->letters,
			    (unsigned)entry->bytes);
	put_comment(w, entry->comment);
	sink_mark(w->sink, TEXT_ENTRY, number, false);
}

static void open_resource(const struct config_writer *w, uint32_t name, uint32_t on, uint32_t comment)
{
	sink_mark(w->sink, TEXT_RESOURCE, 0, true);
	put_id(w, "  RESOURCE ", name);
	if (on)
		put_id(w, " ON ", on);
	put_comment(w, comment);
}

static void close_resource(const struct config_writer *w, uint32_t behind)
{
	sink_text(w->sink, "  END_RESOURCE");
	put_comment(w, behind);
	sink_mark(w->sink, TEXT_RESOURCE, 0, false);
}

/* Lines outside a RESOURCE stay before or behind it. */
static void write_config(const struct sink *sink, const struct project *project)
{
	const struct config_writer w = { sink, project };
	const struct config *config = project->config;
	bool open = false, first = config->has_resource;
	uint32_t behind = 0;

	put_id(&w, "CONFIGURATION ", config->name);
	put_comment(&w, config->comment);
	for (int i = 0; i <= config->count; i++) {
		const struct config_entry *entry = i < config->count ? &config->entry[i] : NULL;

		if (first && i == config->resource_at) {
			open_resource(&w, config->resource, config->on, config->resource_comment);
			if (config->resource_inside) {
				put_id(&w, "    ", config->resource_inside);
				sink_text(sink, "\n");
			}
			behind = config->resource_behind;
			open = true;
			first = false;
		}
		if (open && (!entry || !entry->inside || entry->kind == CONFIG_RESOURCE)) {
			close_resource(&w, behind);
			open = false;
		}
		if (entry && entry->kind == CONFIG_RESOURCE) {
			open_resource(&w, entry->name, entry->pou, entry->comment);
			behind = entry->task;
			open = true;
		} else if (entry) {
			put_entry(&w, entry);
		}
	}
	sink_text(sink, "END_CONFIGURATION\n");
}

static void write_part(const struct sink *sink, const struct project *project,
		       const struct part *part, bool plain)
{
	write_above(sink, project, part->comment);
	switch (part->kind) {
	case PART_VARS:
		write_block(sink, project, &project->globals, part->index);
		break;
	case PART_ACCESS:
		write_access(sink, project, part->index);
		break;
	case PART_POU:
		write_pou(sink, project, &project->pou[part->index], plain);
		break;
	case PART_CONFIG:
		write_config(sink, project);
		break;
	case PART_SPACE:
	case PART_VIEW:
		write_id(sink, project, part->text);
		sink_text(sink, "\n");
		break;
	case PART_TYPES:
		write_types(sink, project, part);
		break;
	case PART_USES:
	case PART_INCLUDE:
		sink_text(sink, part->kind == PART_USES ? "USES " : "INCLUDE ");
		write_string(sink, project_text(project, part->text),
			     names_len(&project->names, part->text));
		sink_text(sink, "\n");
		break;
	}
}

static void write_property(const struct sink *sink, const struct project *project,
			   const char *word, uint32_t text)
{
	if (!text)
		return;
	sink_text(sink, word);
	sink_text(sink, " ");
	write_string(sink, project_text(project, text), names_len(&project->names, text));
	sink_text(sink, "\n");
}

/* RUNGBOARD 1, title and properties. Returns the comments that belong to the first part: without a
 * title and properties, those of the head. */
static uint32_t write_first_lines(const struct sink *sink, const struct project *project)
{
	const bool has = project_has_head(project);

	sink_text(sink, "RUNGBOARD 1\n");
	sink_mark(sink, TEXT_TITLE, 0, true);
	if (has)
		write_above(sink, project, project->head);
	write_property(sink, project, "PROJECT", project->title);
	for (int i = 0; i < PROPERTY_COUNT; i++)
		write_property(sink, project, property_row(i)->word, project->property[i]);
	sink_mark(sink, TEXT_TITLE, 0, false);
	return has ? 0 : project->head;
}

/* Does the text have the form of its file? Several files become one rung file. */
static bool is_plain(const struct project *project)
{
	return project->source_count == 1 && project->source[0].plain;
}

/* Comments behind all parts, and those of the head if there are no parts. */
static void write_last(const struct sink *sink, const struct project *project, uint32_t head,
		       uint32_t tail)
{
	if (!head && !tail)
		return;
	sink_text(sink, "\n");
	write_above(sink, project, head);
	write_above(sink, project, tail);
}

uint32_t text_write_head(const struct project *project, const struct sink *sink)
{
	return write_first_lines(sink, project);
}

void text_write_part(const struct project *project, int number, uint32_t head, const struct sink *sink)
{
	sink_text(sink, "\n");
	write_above(sink, project, head);
	write_part(sink, project, &project->part[number], false);
}

void text_write_tail(const struct project *project, uint32_t head, const struct sink *sink)
{
	write_last(sink, project, head, project->tail);
	for (int i = 1; i < project->source_count; i++)
		write_last(sink, project, 0, project->source[i].tail);
}

/* @number: of one file, in its own form; -1: of all. A view is of rung files only. */
static void write_project(const struct sink *sink, const struct project *project, int number)
{
	const bool plain = number >= 0 ? project->source[number].plain : is_plain(project);
	uint32_t head = plain ? 0 : write_first_lines(sink, project);
	bool begins = plain;

	for (int i = 0; i < project->part_count; i++) {
		if (project->part[i].included || (number >= 0 && project->part[i].source != number) ||
		    (plain && project->part[i].kind == PART_VIEW))
			continue;
		if (!begins)
			sink_text(sink, "\n");
		begins = false;
		sink_mark(sink, TEXT_PART, i, true);
		write_above(sink, project, head);
		head = 0;
		write_part(sink, project, &project->part[i], plain);
		sink_mark(sink, TEXT_PART, i, false);
	}
	write_last(sink, project, head, number <= 0 ? project->tail : project->source[number].tail);
	for (int i = 1; number < 0 && i < project->source_count; i++)
		write_last(sink, project, 0, project->source[i].tail);
}

static char *write_to_memory(const struct project *project, int number, size_t *len)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	const struct sink sink = sink_to_memory(&memory);

	write_project(&sink, project, number);
	if (memory.failed) {
		sink_memory_free(&memory);
		return NULL;
	}
	*len = memory.len;
	return memory.text;
}

char *text_write(const struct project *project, size_t *len)
{
	return write_to_memory(project, -1, len);
}

char *text_write_source(const struct project *project, int number, size_t *len)
{
	return write_to_memory(project, number, len);
}

#define OUTLINE_DEPTH (8 + LIMIT_MACROS) /* nested parts; deeper parts are not reported */

struct outline {
	struct sink_memory memory;
	struct sink into;
	void (*take)(void *context, const struct text_span *span);
	void *context;
	struct text_span open[OUTLINE_DEPTH];
	int depth;
};

static void outline_write(void *context, const char *text, size_t len)
{
	struct outline *outline = context;

	sink_write(&outline->into, text, len);
}

static void outline_mark(void *context, int kind, int number, bool begins)
{
	struct outline *outline = context;
	const int at = outline->depth - !begins;
	const struct text_span *outer;
	struct text_span *span;

	if (at >= OUTLINE_DEPTH) {
		outline->depth += begins ? 1 : -1;
		return;
	}
	span = &outline->open[at];
	if (begins) {
		outer = at ? span - 1 : NULL;
		*span = (struct text_span){ (enum text_part)kind, number,
			outer ? outer->pou : -1, outer ? outer->structure : -1,
			outline->memory.len, 0 };
		if (kind == TEXT_POU)
			span->pou = number;
		if (kind == TEXT_STRUCT)
			span->structure = number;
		outline->depth++;
		return;
	}
	outline->depth--;
	span->len = outline->memory.len - span->at;
	if (outline->take)
		outline->take(outline->context, span);
}

char *text_outline(const struct project *project, size_t *len,
		   void (*take)(void *context, const struct text_span *span),
		   void *context)
{
	struct outline outline = { .take = take, .context = context };
	const struct sink sink = { outline_write, &outline, outline_mark };

	sink_memory_init(&outline.memory);
	outline.into = sink_to_memory(&outline.memory);
	write_project(&sink, project, -1);
	*len = outline.memory.len;
	if (outline.memory.failed)
		sink_memory_free(&outline.memory);
	return outline.memory.text;
}
