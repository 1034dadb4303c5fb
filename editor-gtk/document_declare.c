/* SPDX-License-Identifier: MIT
 *
 * document_declare - one more variable of a document, where a person would write it.
 *
 * It puts a line into the text; whether the name is free and the address good is found
 * by the checks, and by whoever proposed them.
 */
#include "editor-gtk/document_inside.h"

#include <string.h>

/* Where a line could go: the end of a plain block, or before something. */
struct opening {
	const struct project *project;
	int pou;              /* -1: global                                    */
	bool found;
	gsize at;             /* of END_VAR                                    */
	gsize heading;        /* behind the POU's first line                   */
	gsize first_pou;      /* the first part that is one; 0: none           */
};

static uint8_t block_flags(const struct opening *place, const struct text_span *span)
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

bool ladder_document_declare(LadderDocument *document, int pou, const char *name,
			     const char *type, const char *address,
			     struct diag_list *why)
{
	struct opening place = { .project = ladder_document_project(document), .pou = pou };
	gsize len;
	char *text = ladder_document_outline(document, &len, look, &place), *line;
	char *at = address && address[0] ? g_strdup_printf(" AT %s", address) :
		   g_strdup("");
	bool good;

	if (!text) {
		g_free(at);
		return false;
	}
	if (place.found) {
		line = g_strdup_printf("  %s%s : %s;\n", name, at, type);
	} else if (pou >= 0) {
		place.at = (gsize)(strchr(text + place.heading, '\n') + 1 - text);
		line = g_strdup_printf("VAR\n  %s%s : %s;\nEND_VAR\n", name, at, type);
	} else {
		place.at = place.first_pou ? place.first_pou : len;
		line = g_strdup_printf("VAR\n  %s%s : %s;\nEND_VAR\n\n", name, at, type);
	}
	good = ladder_document_replace(document, place.at, 0, line, why);
	g_free(line);
	g_free(at);
	g_free(text);
	return good;
}
