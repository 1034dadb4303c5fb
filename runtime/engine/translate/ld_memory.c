/* SPDX-License-Identifier: MIT
 *
 * ld_memory - what an edge was, by what it stands for.
 *
 * A memory has no name of its own, but a program that is changed while it runs must find
 * it again (scan/carry.h). So it is known by its element, and by the rung it stands in.
 */
#include "engine/translate/ladder_unit.h"

#include <stdio.h>
#include <string.h>

#define OPERAND_MOST 80 /* bytes of an operand that tell it from others       */

static uint32_t mix(uint32_t hash, const char *text)
{
	for (; *text; text++)
		hash = (hash ^ (uint8_t)*text) * 16777619u;
	return (hash ^ 255u) * 16777619u;
}

/* A number for what is drawn, whatever stands around the rung. */
static uint32_t hash_rung(const struct ld *ld)
{
	const struct project *project = ld->translation->project;
	const struct rung *rung = ld->rung;
	uint32_t hash = 2166136261u ^ rung->cols;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		hash = mix(hash, words_row(&project->words,
					   (enum word)cell->word)->word);
		hash = mix(hash, cell->link ? "|" : "");
		hash = mix(hash, names_text(&project->names, cell->operand));
		hash = mix(hash, names_text(&project->names, cell->args));
	}
	return hash;
}

/* "P Start @1a2b3c4d": a name with blanks, which no variable has. */
uint32_t ld_memory(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct cell *cell = rung_at(ld->rung, at->row, at->col);
	const struct names *names = &ld->translation->project->names;
	char text[LIMIT_NAME + OPERAND_MOST + 16];
	int len = snprintf(text, sizeof(text), "%.*s %.*s @%08x", LIMIT_NAME,
			   word_row((enum word)cell->word)->word, OPERAND_MOST,
			   names_text(names, cell->operand), (unsigned)hash_rung(ld));

	return temps_edge(ld->temps, arena_copy(ld->translation->arena, text,
						(size_t)len));
}
