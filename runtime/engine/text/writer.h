/* SPDX-License-Identifier: MIT
 *
 * writer - shared by the files that write the canonical text.
 *
 * Everything goes to a sink in whole strings, also faulty contents.
 */
#ifndef TEXT_WRITER_H
#define TEXT_WRITER_H

#include "engine/base/lex.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/model/st.h"

/** write_id - the string of @id. */
void write_id(const struct sink *sink, const struct project *project, uint32_t id);
/** comment_next - steps to the next token; is it a comment or a pragma, {…}? The token is all of it
 * then. */
bool comment_next(struct lex *lex);
/** write_comments - comments unchanged, each in one piece. */
void write_comments(const struct sink *sink, const struct project *project,
		    uint32_t comments);
/** write_above - comments and a newline, or nothing. */
void write_above(const struct sink *sink, const struct project *project,
		 uint32_t comment);
/** write_string - "…" with its escapes. */
void write_string(const struct sink *sink, const char *text, size_t len);

/** write_rung - comments, RUNG line, rows, and the statements of its EXECUTE boxes. */
void write_rung(const struct sink *sink, const struct project *project,
		const struct rung *rung);
/** write_item - a statement or a line of a network without the sign that ends it; a comment as it is. */
void write_item(const struct sink *sink, const struct project *project, const struct st_item *item);
/** write_sfc - a chart: declarations and items, up to the comments before its end. */
void write_sfc(const struct sink *sink, const struct project *project,
	       const struct pou *pou);
/** write_inner_text - string id of STRUCT … END_STRUCT, with its comments; 0: no memory. Scan-safe: no. */
uint32_t write_inner_text(struct project *project, const struct structure *structure);
#endif
