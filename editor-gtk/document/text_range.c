/* SPDX-License-Identifier: MIT
 *
 * text_range - see text_range.h.
 */
#include "editor-gtk/document/text_range.h"

#include "editor-gtk/document/text_lines.h"

#include "engine/base/lex.h"
#include "engine/base/name.h"

#include <string.h>

/* A box or an action in a text: bytes, and lines from 0. */
struct found {
	enum range_kind kind;
	const char *name;
	gsize name_len;
	gsize at, end;         /* its lines                                     */
	int head, line, last;  /* lines of its heading, the first one, its end  */
};

void text_range_init(struct text_range *part)
{
	*part = (struct text_range){ RANGE_WHOLE, g_strdup(""), 0, 0, g_strdup(""), g_strdup(""), 0 };
}

void text_range_clear(struct text_range *part)
{
	g_free(part->name);
	g_free(part->before);
	g_free(part->after);
	*part = (struct text_range){ .kind = RANGE_WHOLE };
}

/* ---- the parts of a text ---- */

static const struct {
	const char *begin, *end;
	bool named;
} words[] = {
	[RANGE_BOX] = { "EXECUTE", "END_EXECUTE", false },
	[RANGE_ACTION] = { "ACTION", "END_ACTION", true },
};

/* Does `EXECUTE:`, `EXECUTE Name:` or `ACTION Name:` stand at the lexer? */
static bool is_heading(struct lex lex, enum range_kind kind, struct found *out)
{
	if (!lex_is(&lex, words[kind].begin))
		return false;
	*out = (struct found){ .kind = kind, .name = "", .head = lex.token.line - 1 };
	lex_next(&lex);
	if (lex.token.kind == TOKEN_NAME) {
		out->name = lex.token.text;
		out->name_len = lex.token.len;
		lex_next(&lex);
	} else if (words[kind].named) {
		return false;
	}
	if (kind == RANGE_ACTION && lex.token.kind == TOKEN_NEWLINE) /* ACTION Pump.Reset */
		return true;
	return lex_is(&lex, ":");
}

/* Up to the line that ends the part; behind it another one may begin. */
static bool find_end(struct lex *lex, const char *text, struct found *out)
{
	bool begins = true;

	while (lex->token.kind != TOKEN_NEWLINE && lex->token.kind != TOKEN_END)
		lex_next(lex);
	out->at = lex->token.kind == TOKEN_END ? (gsize)(lex->end - text) :
		  (gsize)(lex->token.text + lex->token.len - text);
	out->line = lex->token.line;
	while (lex_next(lex) != TOKEN_END) {
		if (begins && lex_is(lex, words[out->kind].end)) {
			const char *line = lex->token.text;

			while (line > text && line[-1] != '\n')
				line--;
			out->end = (gsize)(line - text);
			out->last = lex->token.line - 1;
			return out->end >= out->at;
		}
		begins = lex->token.kind == TOKEN_NEWLINE;
	}
	return false;
}

static GArray *parts_of(const char *text)
{
	GArray *parts = g_array_new(FALSE, FALSE, sizeof(struct found));
	bool begins = true;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex.newlines = true;
	while (lex_next(&lex) != TOKEN_END) {
		struct found found;

		for (enum range_kind kind = RANGE_BOX; begins && kind <= RANGE_ACTION; kind++) {
			struct lex ahead = lex;

			if (is_heading(lex, kind, &found) && find_end(&ahead, text, &found))
				g_array_append_val(parts, found);
		}
		begins = lex.token.kind == TOKEN_NEWLINE;
	}
	return parts;
}

/* ---- one of them ---- */

static void set(struct text_range *part, const char *text, const GArray *parts, guint index)
{
	const struct found *found = &g_array_index(parts, struct found, index);
	struct text_range now = { .kind = found->kind };

	for (guint i = 0; i < parts->len; i++) {
		const bool same = g_array_index(parts, struct found, i).kind == found->kind;

		now.number += same && i < index;
		now.count += same;
	}
	now.name = g_strndup(found->name, found->name_len);
	now.before = g_strndup(text, found->at);
	now.after = g_strdup(text + found->end);
	now.lines = text_lines_count(now.before);
	text_range_clear(part);
	*part = now;
}

bool text_range_take(struct text_range *part, const char *text, int line)
{
	GArray *parts = parts_of(text);
	int best = -1;

	for (guint i = 0; i < parts->len; i++) {
		const struct found *found = &g_array_index(parts, struct found, i);

		if (line >= found->head && line <= found->last) /* inner ones come later */
			best = (int)i;
	}
	if (best >= 0)
		set(part, text, parts, (guint)best);
	g_array_unref(parts);
	return best >= 0;
}

/* Without the end of the last line. Caller frees. */
static char *lines_of(const char *text, gsize at, gsize end)
{
	return g_strndup(text + at, end - at - (end > at && text[end - 1] == '\n'));
}

static char *between(const struct text_range *part, const char *text)
{
	const gsize before = strlen(part->before), after = strlen(part->after), len = strlen(text);

	if (len < before + after || strncmp(text, part->before, before) != 0 ||
	    strcmp(text + len - after, part->after) != 0 || (before + after < len &&
	    len > after && text[len - after - 1] != '\n'))
		return NULL;
	return lines_of(text, before, len - after);
}

/* How well it fits; 0: it is another one. */
static int likeness(const struct text_range *part, const struct found *found, int number, int count,
		    bool same_text)
{
	const bool same_name = name_is(part->name, found->name, found->name_len) ||
			       (!part->name[0] && !found->name_len);
	const bool same_place = number == part->number && count == part->count;

	if (!same_place && !(same_name && part->name[0]) && !same_text)
		return 0;
	return 1 + 8 * (same_name && part->name[0]) + 4 * same_text + 2 * same_place;
}

static int find_like(const struct text_range *part, const char *text, const GArray *parts,
		     const char *shown)
{
	int best = -1, most = 0, count = 0, number = 0;

	for (guint i = 0; i < parts->len; i++)
		count += g_array_index(parts, struct found, i).kind == part->kind;
	for (guint i = 0; i < parts->len; i++) {
		const struct found *found = &g_array_index(parts, struct found, i);
		char *own;
		int like;

		if (found->kind != part->kind)
			continue;
		own = lines_of(text, found->at, found->end);
		like = likeness(part, found, number++, count, strcmp(own, shown) == 0);
		g_free(own);
		if (like > most) {
			most = like;
			best = (int)i;
		}
	}
	return best;
}

char *text_range_find(struct text_range *part, const char *text, const char *shown)
{
	char *same = part->kind == RANGE_WHOLE ? g_strdup(text) : between(part, text), *out = NULL;
	GArray *parts;
	int index;

	if (same)
		return same;
	parts = parts_of(text);
	index = find_like(part, text, parts, shown);
	if (index >= 0) {
		const struct found *found = &g_array_index(parts, struct found, index);

		out = lines_of(text, found->at, found->end);
		set(part, text, parts, (guint)index);
	}
	g_array_unref(parts);
	return out;
}

int text_range_heading(const char *text)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	return lex_next(&lex) == TOKEN_END ? 0 : lex.token.line - 1;
}

char *text_range_whole(const struct text_range *part, const char *shown)
{
	return g_strconcat(part->before, shown, *shown && part->kind != RANGE_WHOLE ? "\n" : "",
			   part->after, NULL);
}
