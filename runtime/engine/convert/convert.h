/* SPDX-License-Identifier: MIT
 *
 * convert - a project with the bodies of POUs in another language. In each scan they do the same as
 * before, to the bit.
 *
 * A part that the other language cannot express is refused with its place, never changed in meaning.
 */
#ifndef CONVERT_CONVERT_H
#define CONVERT_CONVERT_H

#include "engine/base/diag.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"

/**
 * convert_to - the text of @project with POUs in another language
 * @project: without errors; its table of names grows
 * @wanted:  a byte a POU: 1 for those that are converted; one in the language @to stays as it is
 * @to:      LANGUAGE_ST: ladders and networks; LANGUAGE_FBD: ladders; LANGUAGE_LD: networks
 * @sink:    gets the text, which is not canonical
 * @diags:   gets LD780 to LD787 with their places
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false after a diagnostic.
 */
bool convert_to(struct project *project, const uint8_t *wanted, enum pou_language to, const struct sink *sink,
		struct diag_list *diags);

/** convert_lists - makes the lists that run the bodies of POUs, in @project itself
 * @lists: of each POU; NULL: as it is   @temps: what the translation added to it, @temp_count of it
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false: no memory. */
bool convert_to_il(struct project *project, int pou, const struct il *list, struct var *const *temp,
		   int temp_count);
/** convert_join - parts of files that are named by INCLUDE or USES become parts of the file itself. */
void convert_join(struct project *project);
#endif
