/* SPDX-License-Identifier: MIT
 *
 * write_fbd - networks in their canonical form: NETWORK, and a line for each of its lines, as write_st.c
 * writes a statement.
 */
#include "engine/text/text.h"
#include "engine/text/writer.h"

#include "engine/model/fbd.h"

static void write_heading(const struct project *project, const struct fbd_network *network,
			  const struct sink *sink)
{
	write_above(sink, project, network->comment);
	sink_text(sink, network->off ? "NETWORK OFF" : "NETWORK");
	if (network->label) {
		sink_text(sink, " ");
		write_id(sink, project, network->label);
	}
	if (network->title) {
		sink_text(sink, " ");
		write_string(sink, project_text(project, network->title),
			     names_len(&project->names, network->title));
	}
}

void text_write_network(const struct project *project, const struct pou *pou, int number, const struct sink *sink)
{
	const struct fbd_network *network = &pou->fbd->network[number];

	write_heading(project, network, sink);
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
