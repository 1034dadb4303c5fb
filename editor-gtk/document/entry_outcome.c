/* SPDX-License-Identifier: MIT
 *
 * entry_outcome - see entry_outcome.h.
 */
#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

/* ---- the line of a declaration ---- */

struct declared {
	int pou, number;     /* of the table, -1: global; index in it          */
	bool found;
	gsize at;
};

static void look(void *context, const struct text_span *span)
{
	struct declared *of = context;

	if (span->part != TEXT_VAR || span->structure >= 0 || span->pou != of->pou ||
	    span->number != of->number)
		return;
	of->found = true;
	of->at = span->at;
}

static bool stands_in(const struct var_table *table, const struct var *var, int *number)
{
	for (int i = 0; i < table->count; i++)
		if (&table->var[i] == var)
			*number = i;
	return *number >= 0;
}

/* Line in the saved file; 0: the variable is declared in another file. */
static int line_of(LadderDocument *document, int pou, const struct var *var)
{
	const struct project *project = ladder_document_project(document);
	struct declared of = { .pou = -1, .number = -1 };
	int line = 1;
	char *text;
	gsize len;

	if (!stands_in(&project->globals, var, &of.number)) {
		of.pou = pou;
		stands_in(&project->pou[pou].vars, var, &of.number);
	}
	text = ladder_document_outline(document, &len, look, &of);
	for (gsize i = 0; i < of.at; i++)
		line += text[i] == '\n';
	g_free(text);
	return of.found ? line : 0;
}

/* ---- messages ---- */

static void tell_wrong(GString *out, LadderDocument *document, int pou,
		       const struct entry *entry)
{
	const int line = entry->known ? line_of(document, pou, entry->known) : 0;
	char *what = line ? g_strdup_printf(_("%s, line %d"), entry->what, line) :
			    g_strdup(entry->what);

	g_string_append_printf(out, _(entry->why), what, entry->instead);
	g_free(what);
}

static void tell_new(GString *out, const struct entry_new *declare)
{
	g_string_append_printf(out, _("%snew: %s%s%s : %s"), out->len ? "; " : "",
			       declare->name, declare->address[0] ? " AT " : "",
			       declare->address, declare->type);
	if (declare->shares[0])
		g_string_append_printf(out, _(" (%s has the same address)"), declare->shares);
}

char *entry_outcome_tell(LadderDocument *document, int pou, const struct entry *entry,
			 const char *line, bool *good)
{
	GString *text = g_string_new(NULL);

	*good = entry->sense != ENTRY_WRONG;
	if (entry->sense == ENTRY_WRONG && entry->why)
		tell_wrong(text, document, pou, entry);
	else if (entry->sense == ENTRY_PART && line[0])
		g_string_append(text, _("the operand is still missing"));
	for (int i = 0; i < entry->declares; i++)
		tell_new(text, &entry->declare[i]);
	return g_string_free(text, FALSE);
}

bool entry_outcome_declare(LadderDocument *document, int pou, const struct entry *entry)
{
	bool good = true;

	for (int i = 0; i < entry->declares; i++) {
		const struct entry_new *declare = &entry->declare[i];

		good = ladder_document_declare(document, declare->address[0] ? -1 : pou,
					       declare->name, declare->type,
					       declare->address, NULL) && good;
	}
	return good;
}
