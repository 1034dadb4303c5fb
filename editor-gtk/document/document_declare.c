/* SPDX-License-Identifier: MIT
 *
 * document_declare - one more variable of a document, where a person would write it.
 *
 * Whether the name is free and the address good is found by the checks, and by whoever
 * proposed them. Behind the last one of a plain block it is added to the live project, so
 * that a key need not wait until thousands of rungs are read anew; what that must not do
 * is a line of the text.
 */
#include "editor-gtk/document/document_inside.h"

#include <string.h>

/* ---- into a block of the live project ---- */

static struct var_table *table_of(struct project *project, int pou)
{
	return pou < 0 ? &project->globals : &project->pou[pou].vars;
}

static bool is_plain(const struct var_table *table, int block)
{
	return (table->block[block].flags & ~VAR_GLOBAL_WORD) == 0;
}

static int last_of_config(const struct project *project, int found)
{
	for (int i = 0; i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];

		if (entry->kind == CONFIG_VARS && is_plain(&project->globals, entry->block))
			found = entry->block;
	}
	return found;
}

/* The last plain block in the order of the file; -1: there is none. */
static int last_global(const struct project *project)
{
	int found = -1;

	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->included)
			continue;
		if (part->kind == PART_VARS && is_plain(&project->globals, part->index))
			found = part->index;
		else if (part->kind == PART_CONFIG && project->config)
			found = last_of_config(project, found);
	}
	return found;
}

static int last_of_pou(const struct pou *pou)
{
	int found = -1;

	for (int i = 0; i < pou->vars.block_count; i++)
		if (is_plain(&pou->vars, i))
			found = i;
	return found;
}

/* What has a frame is a word of the project, with a size. */
static int live_block(const struct project *project, int pou)
{
	const struct pou *of = pou < 0 ? NULL : &project->pou[pou];

	if (!of)
		return last_global(project);
	return of->included || pou_has_frame(of) ? -1 : last_of_pou(of);
}

static void pop(LadderDocument *document, int pou, int block, const char *text)
{
	struct project *project = ladder_project(document->ladder);
	struct var_table *table = table_of(project, pou);
	const struct var_block *of = &table->block[block];
	const struct var *var = &table->var[of->first + of->count - 1];

	if (of->count == 0 || !g_str_has_prefix(text, project_text(project, var->name)))
		document_report_lost(text);

	const char *name = project_text(project, var->name);
	const char *address = project_text(project, var->at_text);

	vars_pop(table, block);
	document_tell_variable(document, pou, name, address);
}

static void push(LadderDocument *document, int pou, int block, const char *text)
{
	struct project *project = ladder_project(document->ladder);
	struct diag_list diags;
	const struct var *var;

	diag_init(&diags);
	if (!ladder_read_var(document->ladder, pou, block, text, strlen(text), &diags))
		document_report_lost(text);

	const struct var_table *table = table_of(project, pou);

	var = &table->var[table->block[block].first + table->block[block].count - 1];
	document_tell_variable(document, pou, project_text(project, var->name),
			       project_text(project, var->at_text));
}

void document_apply_variable(LadderDocument *document, int pou, int block,
			     const GPtrArray *from, const GPtrArray *to)
{
	for (guint i = from->len; i > 0; i--)
		pop(document, pou, block, from->pdata[i - 1]);
	for (guint i = 0; i < to->len; i++)
		push(document, pou, block, to->pdata[i]);
}

static bool declare_live(LadderDocument *document, int pou, int block, const char *text,
			 struct diag_list *why)
{
	const gsize len = strlen(text);
	struct diag_list diags;

	diag_init(&diags);
	if (!ladder_read_var(document->ladder, pou, block, text, len, &diags)) {
		if (why)
			*why = diags;
		return false;
	}
	vars_pop(table_of(ladder_project(document->ladder), pou), block);
	document_record(document, change_new(CHANGE_VARIABLE, pou, (gsize)block,
					     change_texts(), document_one_text(text, len)));
	return true;
}

/* ---- into the text ---- */

/* Where a line could go: the end of a plain block, or before something. */
struct opening {
	const struct project *project;
	int pou;              /* -1: global                                    */
	bool found;
	gsize at;             /* of END_VAR                                    */
	gsize heading;        /* behind the POU's first line                   */
	gsize first_pou;      /* the first part that is one; 0: none           */
};

static uint16_t block_flags(const struct opening *place, const struct text_span *span)
{
	const struct var_table *table = span->pou < 0 ? &place->project->globals :
		&place->project->pou[span->pou].vars;

	return table->block[span->number].flags;
}

static void look(void *context, const struct text_span *span)
{
	static const char end[] = "END_VAR\n";
	struct opening *place = context;

	if (span->part == TEXT_BLOCK && span->pou == place->pou &&
	    span->structure < 0 &&
	    (block_flags(place, span) & ~VAR_GLOBAL_WORD) == 0) {
		place->found = true;
		place->at = span->at + span->len - strlen(end);
	}
	if (span->part == TEXT_POU && span->number == place->pou)
		place->heading = span->at;
	if (span->part == TEXT_PART && !place->first_pou &&
	    place->project->part[span->number].kind == PART_POU)
		place->first_pou = span->at;
}

static bool declare_in_text(LadderDocument *document, int pou, const char *declaration,
			    struct diag_list *why)
{
	struct opening place = { .project = ladder_document_project(document), .pou = pou };
	gsize len;
	char *text = ladder_document_outline(document, &len, look, &place), *line;
	bool good;

	if (place.found) {
		line = g_strdup_printf("  %s\n", declaration);
	} else if (pou >= 0) {
		place.at = (gsize)(strchr(text + place.heading, '\n') + 1 - text);
		line = g_strdup_printf("VAR\n  %s\nEND_VAR\n", declaration);
	} else {
		place.at = place.first_pou ? place.first_pou : len;
		line = g_strdup_printf("VAR\n  %s\nEND_VAR\n\n", declaration);
	}
	good = ladder_document_replace(document, place.at, 0, line, why);
	g_free(line);
	g_free(text);
	return good;
}

bool ladder_document_declare(LadderDocument *document, int pou, const char *name,
			     const char *type, const char *address,
			     struct diag_list *why)
{
	struct project *project = ladder_document_project(document);
	char *declaration;
	bool good;
	int block;

	if (!project || pou >= project->pou_count || document->fixed)
		return false;
	declaration = g_strdup_printf("%s%s%s : %s;", name,
				      address && address[0] ? " AT " : "",
				      address ? address : "", type);
	block = live_block(project, pou);
	good = block >= 0 ? declare_live(document, pou, block, declaration, why) :
	       declare_in_text(document, pou, declaration, why);
	g_free(declaration);
	return good;
}
