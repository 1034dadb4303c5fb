/* SPDX-License-Identifier: MIT
 *
 * listing - IL and symbols as lines of text, and the places that read an operand; see
 * listing.h.
 *
 * Reads are found by names as they are written: a local name belongs to its POU, an address
 * to the global variable AT it. Elements of arrays and members count as names of their own.
 */
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/draw/grid_names.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"
#include "engine/text/pou_print.h"
#include "engine/model/args.h"

#include <string.h>

char **listing_il(const struct project *project, const struct pou *pou)
{
	struct sink_memory memory;
	char **lines = NULL, *st = pou->language == LANGUAGE_ST || pou->fbd ? pou_print(project, pou) : NULL;
	const bool statements = st != NULL;

	sink_memory_init(&memory);
	struct sink sink = sink_to_memory(&memory);
	if (statements)
		sink_text(&sink, st);
	free(st);
	if (statements || pou_print_il(project, pou, &pou->vars, NULL, 0, &pou->il, &sink)) {
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
	struct sink_memory memory;
	struct sink sink;
	char *type;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	project_write_type(project, var, &sink);
	type = g_strdup(sink_memory_text(&memory));
	sink_memory_free(&memory);
	return type;
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

/* ---- where the operand of a coil is read ---- */

struct listing_reads {
	const struct project *project;
	struct grid_names **names;   /* one for each POU                        */
	GHashTable *places;          /* key: GArray of struct reader              */
	int pou, rung;               /* place of the search                     */
};
struct reader { int pou, rung; };

/* One key for all spellings of an operand. Owns: g_free. */
static char *key_of(const struct listing_reads *reads, int pou, const char *text,
		    size_t len)
{
	char *name = g_strndup(text, len), *stem = g_strndup(text, strcspn(name, ".["));
	struct grid_name known = grid_names_find(reads->names[pou], name);
	char *lower = name_fold(*known.symbol ? known.symbol : name);
	bool local = grid_names_find(reads->names[pou], stem).local;
	char *key = local ? g_strdup_printf("%d:%s", pou, lower) : g_strdup(lower);

	g_free(lower);
	g_free(stem);
	g_free(name);
	return key;
}

static void note(struct listing_reads *reads, const char *text, size_t len)
{
	char *key = key_of(reads, reads->pou, text, len);
	GArray *places = g_hash_table_lookup(reads->places, key);
	struct reader now = { reads->pou, reads->rung };

	if (!places) {
		places = g_array_new(FALSE, FALSE, sizeof(struct reader));
		g_hash_table_insert(reads->places, g_strdup(key), places);
	}
	struct reader *last = places->len ? &g_array_index(places, struct reader,
							  places->len - 1) : NULL;
	if (!last || last->pou != now.pou || last->rung != now.rung)
		g_array_append_val(places, now);
	g_free(key);
}

static bool is_name(char c)
{
	return g_ascii_isalnum(c) || c == '_' || c == '.' || c == '%' || (guchar)c >= 0x80;
}

/* Notes all names in an expression, but not literals such as T#5s and 'text'. */
static void note_expression(struct listing_reads *reads, const char *text, size_t len)
{
	const char *end = text + len;

	while (text < end) {
		const char *from = text;

		if (*text == '\'') {
			for (text++; text < end && *text != '\''; text++)
				text += *text == '$' && text + 1 < end;
			text += text < end;
			continue;
		}
		while (text < end && is_name(*text))
			text++;
		if (text == from) {
			text++;
		} else if (text < end && *text == '#') {
			for (text++; text < end && (is_name(*text) || *text == '#'); text++)
				;
		} else if (!g_ascii_isdigit(*from)) {
			note(reads, from, (size_t)(text - from));
		}
	}
}

static void note_cell(struct listing_reads *reads, const struct cell *cell)
{
	const struct word_row *word = words_row(&reads->project->words, cell->word);
	const char *operand = project_text(reads->project, cell->operand);
	const char *at = project_text(reads->project, cell->args);
	const char *source = strstr(operand, ":=");
	struct arg arg;

	if (word->operand == OPND_BOOL_R || word->operand == OPND_ANY_R)
		note(reads, operand, strlen(operand));
	else if (word->operand == OPND_EXPR)
		note_expression(reads, operand, strlen(operand));
	else if ((word->operand == OPND_ASSIGN || word->operand == OPND_LOOP) && source)
		note_expression(reads, source + 2, strlen(source + 2));
	while (cell->word != ELEM_EXECUTE && args_next(&at, &arg))
		if (!arg.output)
			note_expression(reads, arg.value, arg.value_len);
}

static void note_il(struct listing_reads *reads, const struct il *il)
{
	for (int i = 0; i < il->count; i++) {
		const struct il_line *line = &il->line[i];
		const char *operand = project_text(reads->project, line->operand);
		bool reads_it = line->kind == IL_FN || line->kind == IL_ARG_IN ||
				(line->kind == IL_OP &&
				 op_row(line->op)->operand != OPND_BOOL_W &&
				 op_row(line->op)->operand != OPND_ANY_W);

		if (reads_it && line->operand)
			note_expression(reads, operand, strlen(operand));
	}
}

static void free_places(gpointer places)
{
	g_array_unref(places);
}

struct listing_reads *listing_reads_new(const struct project *project)
{
	struct listing_reads *reads = g_new0(struct listing_reads, 1);

	reads->project = project;
	reads->names = g_new0(struct grid_names *, project->pou_count + 1);
	reads->places = g_hash_table_new_full(g_str_hash, g_str_equal, g_free,
					      free_places);
	for (reads->pou = 0; reads->pou < project->pou_count; reads->pou++) {
		const struct pou *pou = &project->pou[reads->pou];

		reads->names[reads->pou] = grid_names_new(project, pou);
		reads->rung = 0;
		if (pou->il.count)
			note_il(reads, &pou->il);
		for (int i = 0; i < pou->rung_count; i++) {
			const struct rung *rung = pou->rung[i];

			reads->rung = i + 1;
			for (int c = 0; c < rung->rows * rung->cols; c++)
				note_cell(reads, &rung->cell[c]);
		}
	}
	return reads;
}

void listing_reads_free(struct listing_reads *reads)
{
	if (!reads)
		return;
	for (int i = 0; i < reads->project->pou_count; i++)
		grid_names_free(reads->names[i]);
	g_free(reads->names);
	g_hash_table_unref(reads->places);
	g_free(reads);
}

char *listing_reads_of(const struct listing_reads *reads, int pou, const char *operand,
		       int most)
{
	char *key = key_of(reads, pou, operand, strlen(operand));
	const GArray *places = g_hash_table_lookup(reads->places, key);
	GString *out = g_string_new(NULL);
	int last = -1;

	g_free(key);
	for (guint i = 0; places && i < places->len; i++) {
		struct reader at = g_array_index(places, struct reader, i);

		if (most && i == (guint)most) {
			g_string_append(out, ", \xe2\x80\xa6");
			break;
		}
		if (at.pou != last)
			g_string_append_printf(out, "%s%s", i ? "; " : "",
				project_text(reads->project,
					     reads->project->pou[at.pou].name));
		if (at.rung)
			g_string_append_printf(out, "%s %d", at.pou == last ? "," : "",
					       at.rung);
		last = at.pou;
	}
	char *text = out->len ? g_strdup_printf(_("read in %s"), out->str) : NULL;
	g_string_free(out, TRUE);
	return text;
}
