/* SPDX-License-Identifier: MIT
 *
 * sfc_words - the texts in and beside the boxes of a chart.
 *
 * Used for the terminal and the editor's sheet. Texts are as in the file: the caller
 * handles control characters and width.
 */
#ifndef SHOW_SFC_WORDS_H
#define SHOW_SFC_WORDS_H

#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/show/sfc_layout.h"

/** sfc_words_shape - the name of a step; name and condition of a transition, with steps
 * and order that the drawing does not show; the target of a jump. */
void sfc_words_shape(const struct project *project, const struct pou *pou,
		     const struct sfc_layout *layout, int shape, const struct sink *sink);
/** sfc_words_times - `2s ... 20s`, below the name of a step; nothing if it has none. */
void sfc_words_times(const struct project *project, const struct sfc *sfc, int step,
		     const struct sink *sink);
/** sfc_words_qualifier - `N`, `L T#1s`, `SET`. */
void sfc_words_qualifier(const struct project *project, const struct sfc *sfc, int use,
			 const struct sink *sink);
/** sfc_words_ways - `Idle, Wait -> Fill`: the steps before and behind a transition. */
void sfc_words_ways(const struct project *project, const struct sfc *sfc, int transition,
		    const struct sink *sink);

/** sfc_words_list - the instructions of a list, or the statements of Structured Text, a line each. */
void sfc_words_list(const struct project *project, const struct pou *pou,
		    const struct sfc_body *body, const struct sink *sink);

#endif
