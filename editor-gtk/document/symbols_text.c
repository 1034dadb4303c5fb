/* SPDX-License-Identifier: MIT
 *
 * symbols_text - a declaration as a line of text. It is read in a project made for it, in
 * which only its place and the words that may be its type are those of the true one.
 */
#include "editor-gtk/document/symbols_text.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/listing.h"

#include <string.h>

static bool refuse(char **why, char *text)
{
	if (why)
		*why = text;
	else
		g_free(text);
	return false;
}

char *symbol_text_comment(const char *text)
{
	GString *out = g_string_new("");

	for (const char *at = text; *at; at++) {
		const bool blank = g_ascii_isspace(*at);

		if (!blank)
			g_string_append_c(out, *at);
		if (blank || (at[0] == '*' && at[1] == ')') || (at[0] == '(' && at[1] == '*'))
			if (out->len && out->str[out->len - 1] != ' ')
				g_string_append_c(out, ' ');
	}
	return g_strchomp(g_string_free(out, FALSE));
}

char *symbol_text_line(const char *const text[SYMBOL_FIELDS])
{
	GString *out = g_string_new("  ");
	char *comment = symbol_text_comment(text[FIELD_COMMENT]);

	g_string_append(out, text[FIELD_NAME]);
	if (*text[FIELD_ADDRESS])
		g_string_append_printf(out, " AT %s", text[FIELD_ADDRESS]);
	g_string_append_printf(out, " : %s", text[FIELD_TYPE]);
	if (*text[FIELD_INITIAL])
		g_string_append_printf(out, " := %s", text[FIELD_INITIAL]);
	g_string_append(out, ";");
	if (*comment)
		g_string_append_printf(out, " (* %s *)", comment);
	g_string_append(out, "\n");
	g_free(comment);
	return g_string_free(out, FALSE);
}

char *symbol_text_block(uint16_t flags)
{
	return g_strdup_printf("%s%s%s\n", vars_head(flags),
			       flags & VAR_RETAIN ? " RETAIN" : "",
			       flags & VAR_CONSTANT ? " CONSTANT" : "");
}

char *symbol_text_reason(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag_severity(diag->id) == SEVERITY_ERROR)
			return diag_said_whole(diag);
	}
	return g_strdup(_("It cannot be read"));
}

/* Stand-ins for the words of the project, so that a type is known. */
static void add_words(GString *out, const struct project *project)
{
	for (int i = 0; i < project->structure_count; i++)
		g_string_append_printf(out, "TYPE\n  %s : STRUCT\n    X : INT;\n"
			"  END_STRUCT;\nEND_TYPE\n",
			project_text(project, project->structure[i].name));
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_BLOCK)
			g_string_append_printf(out, "FUNCTION_BLOCK %s LD\n"
				"END_FUNCTION_BLOCK\n",
				project_text(project, project->pou[i].name));
}

/* A name that no declaration has: it is too long for one that is typed. */
#define HERE "Place_of_a_declaration_that_is_tried"

/* The declaration where it is to stand. */
static void add_place(GString *out, const struct project *project, int table,
		      uint16_t flags, const char *line)
{
	char *head = symbol_text_block(flags);
	const char *word;

	if (table > project->pou_count) {
		g_string_append_printf(out, "TYPE\n  " HERE " : STRUCT\n%s  END_STRUCT;\n"
				       "END_TYPE\n", line);
	} else if (table == 0) {
		g_string_append_printf(out, "%s%sEND_VAR\n", head, line);
	} else {
		word = pou_word(project->pou[table - 1].kind);
		g_string_append_printf(out, "%s " HERE "%s LD\n%s%sEND_VAR\nEND_%s\n", word,
			project->pou[table - 1].kind == POU_FUNCTION ? " : INT" : "", head,
			line, word);
	}
	g_free(head);
}

/* Has the project that was made no other declaration than this one? */
static bool is_alone(const struct project *made, int table, int pous, const char *name)
{
	const struct var_table *vars = table == 0 ? &made->globals : table > pous ?
		&made->structure[made->structure_count - 1].vars :
		&made->pou[made->pou_count - 1].vars;
	const int first = listing_first(vars);

	return listing_count(vars) == 1 &&
	       strcmp(project_text(made, vars->var[first].name), name) == 0;
}

bool symbol_text_reads(const struct project *project, int table, uint16_t flags,
		       const char *line, const char *name, char **why)
{
	GString *text = g_string_new("RUNGBOARD 1\n");
	struct ladder *ladder = ladder_new();
	bool good;

	if (!ladder)
		g_error("out of memory");
	add_words(text, project);
	add_place(text, project, table, flags, line);
	good = ladder_load_text(ladder, "", text->str, text->len) && ladder_project(ladder);
	if (!good)
		refuse(why, symbol_text_reason(ladder_diags(ladder)));
	else if (!is_alone(ladder_project(ladder), table, project->pou_count, name))
		good = refuse(why, g_strdup(_("It cannot be read")));
	ladder_free(ladder);
	g_string_free(text, TRUE);
	return good;
}
