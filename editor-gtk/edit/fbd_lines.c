/* SPDX-License-Identifier: MIT
 *
 * fbd_lines - reads the networks of a POU; see fbd_lines.h.
 */
#include "editor-gtk/edit/fbd_lines.h"

#include "engine/base/lex.h"
#include "engine/model/fbd.h"
#include "engine/model/st.h"

#include <string.h>

int fbd_lines_count(const struct pou *pou)
{
	return pou->fbd ? pou->fbd->count : 0;
}

struct fbd_heading fbd_lines_heading(const struct project *project, const struct pou *pou, int network)
{
	const struct fbd_network *of = &pou->fbd->network[network];

	return (struct fbd_heading){ of->off, project_text(project, of->label), project_text(project, of->title),
				     project_text(project, of->comment) };
}

int fbd_lines_line(const struct pou *pou, int network)
{
	return pou->fbd->network[network].line;
}

int fbd_lines_statement(const struct pou *pou, int network, int item)
{
	int statement = 0;

	for (int i = pou->fbd->network[network].first; i < item; i++)
		statement += pou->st->item[i].kind != ST_COMMENT;
	return statement;
}

const char *fbd_lines_text(const struct project *project, const struct pou *pou, int item)
{
	return project_text(project, pou->st->item[item].text);
}

bool fbd_lines_place(const struct project *project, const struct pou *pou, int item, int *first, int *last)
{
	const struct st_item *at = pou->st && item >= 0 && item < pou->st->count ? &pou->st->item[item] : NULL;
	const char *text = at ? project_text(project, at->text) : NULL;
	int column;

	if (!at)
		return false;
	st_where(&project->names, at, text, first, &column);
	st_where(&project->names, at, text + strlen(text), last, &column);
	return true;
}

size_t fbd_heading_len(const char *text, size_t len)
{
	const char *at = text, *end = text + len;
	struct lex lex;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END)
		if (lex_is(&lex, "NETWORK")) {
			at = lex.token.text;
			break;
		}
	while (at < end && *at != '\n')
		at++;
	return (size_t)(at - text) + (at < end);
}

bool fbd_is_network(const char *text)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex_next(&lex);
	return lex_is(&lex, "NETWORK");
}

int fbd_lines_wire(struct project *project, const struct pou *pou, int network, const char *name, size_t len)
{
	return fbd_wire(&project->names, pou, network, name, len);
}
