/* SPDX-License-Identifier: MIT
 *
 * writer - names, comments and strings of the canonical text.
 */
#include "engine/text/writer.h"

#include <string.h>

void write_id(const struct sink *sink, const struct project *project, uint32_t id)
{
	sink_write(sink, project_text(project, id), names_len(&project->names, id));
}

/* The end of a pragma whose `{` stands before @at; NULL: it has none. Beremiz writes C as `{{ … }}`, with braces inside. */
static const char *pragma_end(const char *at, const char *end)
{
	if (at < end && *at == '{')
		for (const char *close = at; end - close >= 2; close++)
			if (close[0] == '}' && close[1] == '}')
				return close + 2;
	at = memchr(at, '}', (size_t)(end - at));
	return at ? at + 1 : NULL;
}

bool comment_next(struct lex *lex)
{
	const char *close;

	if (lex_next(lex) == TOKEN_COMMENT)
		return true;
	if (!lex_is(lex, "{"))
		return false;
	close = pragma_end(lex->at, lex->end);
	if (!close)
		return false;
	for (; lex->at < close; lex->at++) {
		if (*lex->at != '\n')
			continue;
		lex->line++;
		lex->line_start = lex->at + 1;
	}
	lex->token.kind = TOKEN_COMMENT;
	lex->token.len = (size_t)(lex->at - lex->token.text);
	return true;
}

void write_comments(const struct sink *sink, const struct project *project,
		    uint32_t comments)
{
	const char *from = project_text(project, comments);
	const char *end = from + names_len(&project->names, comments);
	struct lex lex;

	lex_init(&lex, from, (size_t)(end - from));
	lex.comments = true;
	while (comment_next(&lex)) {
		sink_write(sink, from, (size_t)(lex.token.text - from));
		from = lex.token.text;
	}
	sink_write(sink, from, (size_t)(end - from));
}

void write_above(const struct sink *sink, const struct project *project,
		 uint32_t comment)
{
	if (!comment)
		return;
	write_comments(sink, project, comment);
	sink_text(sink, "\n");
}

static const char *escape(char c)
{
	switch (c) {
	case '"':
		return "$\"";
	case '$':
		return "$$";
	case '\n':
		return "$N";
	case '\r':
		return "$R";
	case '\t':
		return "$T";
	default:
		return NULL;
	}
}

void write_string(const struct sink *sink, const char *text, size_t len)
{
	size_t plain = 0;

	sink_text(sink, "\"");
	for (size_t i = 0; i < len; i++) {
		const char *with = escape(text[i]);

		if (!with)
			continue;
		sink_write(sink, text + plain, i - plain);
		sink_text(sink, with);
		plain = i + 1;
	}
	sink_write(sink, text + plain, len - plain);
	sink_text(sink, "\"");
}
