/* SPDX-License-Identifier: MIT
 *
 * map_words - the options of an I/O map, for `ladder io --words`.
 */
#ifndef LADDER_MAP_WORDS_H
#define LADDER_MAP_WORDS_H

#include "engine/base/sink.h"

#ifdef RUNGBOARD_SMALL
static inline void map_words_print(const struct sink *out)
{
	(void)out;
}
#else
/** map_words_print - a line for each option: how it is written, and which lines may have it. */
void map_words_print(const struct sink *out);
#endif
#endif
