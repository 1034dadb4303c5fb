/* SPDX-License-Identifier: MIT
 *
 * write_fbd - networks in their canonical form: NETWORK, and a line for each of its lines, as write_st.c
 * writes a statement.
 */
#include "engine/text/text.h"
#include "engine/text/writer.h"

#include "engine/model/fbd.h"

void text_write_heading(const struct project *project, const char *word, const struct text_heading *heading,
			const struct sink *sink)
{
	write_above(sink, project, heading->comment);
	sink_text(sink, word);
	sink_text(sink, heading->off ? " OFF" : "");
	if (heading->label) {
		sink_text(sink, " ");
		write_id(sink, project, heading->label);
	}
	if (heading->title) {
		sink_text(sink, " ");
		write_string(sink, project_text(project, heading->title),
			     names_len(&project->names, heading->title));
	}
}

void text_write_network(const struct project *project, const struct pou *pou, int number, const struct sink *sink)
{
	const struct fbd_network *network = &pou->fbd->network[number];
	const struct text_heading heading = { network->label, network->title, network->comment, network->off };

	text_write_heading(project, "NETWORK", &heading, sink);
	for (int i = network->first; i < network->first + network->count; i++) {
		const struct st_item *item = &pou->st->item[i];

		if (item->kind == ST_COMMENT && item->behind && i > network->first) {
			sink_text(sink, "  ");
		} else {
			sink_text(sink, item->gap ? "\n\n  " : "\n  ");
		}
		write_item(sink, project, item);
		if (item->at_column)
			sink_printf(sink, "  { at %d,%d }", item->at_column, item->at_row);
	}
	sink_text(sink, "\n");
}
