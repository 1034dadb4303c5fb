/* SPDX-License-Identifier: MIT
 *
 * listing - IL and symbols as lines of text; see listing.h. Who reads what is
 * listing_reads.c.
 */
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/kit/comment_text.h"
#include "engine/text/pou_print.h"

char **listing_il(const struct project *project, const struct pou *pou)
{
	struct sink_memory memory;
	char **lines = NULL;

	sink_memory_init(&memory);
	struct sink sink = sink_to_memory(&memory);
	if (pou_print_il(project, pou, &pou->vars, NULL, 0, &pou->il, &sink)) {
		GString *text = g_string_new(sink_memory_text(&memory));

		while (text->len && text->str[text->len - 1] == '\n')
			g_string_truncate(text, text->len - 1);
		lines = g_strsplit(text->str, "\n", -1);
		g_string_free(text, TRUE);
	}
	sink_memory_free(&memory);
	return lines;
}

char *listing_type(const struct project *project, const struct var *var)
{
	const char *word = var->type == IEC_NONE ?
		words_row(&project->words, var->fb)->word :
		iec_type_row(var->type)->word;
	GString *out = g_string_new(NULL);

	if (var->array.count)
		g_string_append_printf(out, "ARRAY[%d..%lld] OF ", (int)var->array.low,
				       (long long)var->array.low + var->array.count - 1);
	g_string_append(out, word);
	if (var->type == IEC_STRING && var->capacity != IEC_STRING_DEFAULT)
		g_string_append_printf(out, "[%u]", var->capacity);
	return g_string_free(out, FALSE);
}

int listing_first(const struct var_table *table)
{
	const int count = vars_declared(table);
	int first = 0;

	while (first < count && vars_flags(table, first) & VAR_RESULT)
		first++;
	return first;
}

int listing_count(const struct var_table *table)
{
	return vars_declared(table) - listing_first(table);
}

int listing_symbol_count(const struct project *project)
{
	int count = project->globals.count;

	for (int i = 0; i < project->pou_count; i++)
		count += listing_count(&project->pou[i].vars);
	return count;
}

void listing_symbol(const struct project *project, const struct var_table *table,
		    int index, char *cell[LISTING_COLUMNS])
{
	const struct var *var = &table->var[index];

	cell[LISTING_NAME] = g_strdup(project_text(project, var->name));
	cell[LISTING_TYPE] = listing_type(project, var);
	cell[LISTING_ADDRESS] = g_strdup(project_text(project, var->at_text));
	cell[LISTING_INITIAL] = g_strdup(var->has_init ?
					 project_text(project, var->init_text) : "");
	cell[LISTING_COMMENT] = comment_text(project_text(project, var->comment));
}
