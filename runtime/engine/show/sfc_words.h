/* SPDX-License-Identifier: MIT
 *
 * sfc_words - the texts in and beside the boxes of a chart.
 *
 * The same for the terminal and for the editor's sheet. Texts are as in the file: the
 * caller takes care of control characters and of the width.
 */
#ifndef SHOW_SFC_WORDS_H
#define SHOW_SFC_WORDS_H

#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/show/sfc_layout.h"

/** sfc_words_shape - name of a step; name and condition of a transition, with what its
 * place does not tell; the name that a jump leads to. */
void sfc_words_shape(const struct project *project, const struct pou *pou,
		     const struct sfc_layout *layout, int shape, const struct sink *sink);
/** sfc_words_times - `2s ... 20s`, below the name of a step; nothing if it has none. */
void sfc_words_times(const struct project *project, const struct sfc *sfc, int step,
		     const struct sink *sink);
/** sfc_words_qualifier - `N`, `L T#1s`, `SET`. */
void sfc_words_qualifier(const struct project *project, const struct sfc *sfc, int use,
			 const struct sink *sink);
/** sfc_words_ways - `Idle, Wait -> Fill`: what a transition leads from and to. */
void sfc_words_ways(const struct project *project, const struct sfc *sfc, int transition,
		    const struct sink *sink);

/** sfc_words_list - the instructions of a body that is a list, a line each. */
void sfc_words_list(const struct project *project, const struct pou *pou,
		    const struct sfc_body *body, const struct sink *sink);

#endif
