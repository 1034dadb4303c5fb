/* SPDX-License-Identifier: MIT
 *
 * diff_il - two instruction lists or charts compared line by line, as they are written.
 *
 * Lines are counted from the one behind the declarations.
 */
#include "engine/compare/diff.h"
#include "engine/text/pou_print.h"
#include "engine/text/text.h"

#include <string.h>

struct lines {
	char *text;        /* cut into lines, NUL-ended                       */
	char **line;
	int *indent;       /* blanks that stood before it                     */
	uint32_t *id;
	int count;
};

/* Operands stand aligned: how far must make no difference. */
static char *one_blank(char *line)
{
	char *begin = line + strspn(line, " "), *to = begin;

	for (const char *from = begin; *from; from++)
		if (*from != ' ' || from[1] != ' ')
			*to++ = *from;
	*to = '\0';
	return begin;
}

static bool cut_lines(struct diff *diff, struct lines *lines)
{
	char *at = strchr(lines->text, '\n');

	while (at) {
		*at++ = '\0';
		char *end = strchr(at, '\n');
		char **line;

		/* The last line is END_PROGRAM. */
		if (!end || end[1] == '\0')
			break;
		line = arena_push(&diff->arena, &lines->line, &lines->count,
				  sizeof(*line));
		if (!line)
			return false;
		*line = at;
		at = end;
	}
	if (at)
		*at = '\0';
	return true;
}

/* The body, between a line before it and one behind it. */
static bool write_body(const struct project *project, const struct pou *pou,
		       const struct sink *sink)
{
	const struct var_table none = { 0 };

	if (pou->language != LANGUAGE_SFC)
		return pou_print_il(project, pou, &none, NULL, 0, &pou->il, sink);
	sink_text(sink, "PROGRAM\n");
	text_write_sfc(project, pou, sink);
	sink_text(sink, "END_PROGRAM\n");
	return true;
}

static bool make_lines(struct diff *diff, const struct project *project,
		       const struct pou *pou, struct lines *lines)
{
	const struct sink sink = sink_to_memory(&diff->bytes);

	if (!pou)
		return true;
	diff->bytes.len = 0;
	if (!write_body(project, pou, &sink) || diff->bytes.failed)
		return false;
	lines->text = arena_copy(&diff->arena, diff->bytes.text,
				 diff->bytes.len);
	if (!lines->text || !cut_lines(diff, lines))
		return false;
	lines->id = arena_alloc(&diff->arena, (size_t)(lines->count + 1) *
					      sizeof(*lines->id));
	lines->indent = arena_alloc(&diff->arena, (size_t)(lines->count + 1) *
						  sizeof(*lines->indent));
	if (!lines->id || !lines->indent)
		return false;
	for (int i = 0; i < lines->count; i++) {
		char *line = one_blank(lines->line[i]);

		lines->indent[i] = (int)(line - lines->line[i]);
		lines->line[i] = line;
		lines->id[i] = diff_id(diff, line, strlen(line));
	}
	return !diff->failed;
}

/* The lines from (i, j) up to (i_end, j_end) have no partner: in pairs they
 * changed, the rest was added or removed. */
static void tell_gap(struct diff *diff, struct difference what,
		     const struct lines *a, int i, int i_end,
		     const struct lines *b, int j, int j_end)
{
	for (; i < i_end && j < j_end; i++, j++) {
		what.line = i + 1;
		diff_texts(diff, what, NULL, a->line[i], b->line[j]);
	}
	for (; i < i_end; i++) {
		what.line = i + 1;
		what.change = "removed";
		what.subject = a->line[i];
		diff_say(diff, what);
	}
	for (; j < j_end; j++) {
		what.line = j + 1;
		what.change = "added";
		what.subject = b->line[j];
		diff_say(diff, what);
	}
}

/* Line @i of @a, line @j of @b; -1: there is none. */
static void give_line(struct diff *diff, const struct lines *a, int i,
		      const struct lines *b, int j)
{
	const struct lines *in = i < 0 ? b : a;
	const int at = i < 0 ? j : i;

	diff->take_line(diff->context, (struct compare_line){ i + 1, j + 1, in->indent[at],
							   in->line[at] });
}

static void give_gap(struct diff *diff, const struct lines *a, int i, int i_end,
		     const struct lines *b, int j, int j_end)
{
	for (; i < i_end; i++)
		give_line(diff, a, i, b, -1);
	for (; j < j_end; j++)
		give_line(diff, a, -1, b, j);
}

void diff_il(struct diff *diff, const struct pou *a, const struct pou *b)
{
	struct difference what = { .pou = a ? project_text(diff->a, a->name) : NULL };
	struct lines x = { 0 }, y = { 0 };
	int i = 0, j = 0, *match = NULL;

	if (make_lines(diff, diff->a, a, &x) &&
	    make_lines(diff, diff->b, b, &y))
		match = arena_alloc(&diff->arena, (size_t)(x.count + 1) *
						  sizeof(int));
	if (!match || !diff_match(&diff->arena, x.id, x.count, y.id, y.count,
				  match)) {
		diff->failed = true;
		return;
	}
	for (int at = 0; at <= x.count; at++) {
		const int to = at < x.count ? match[at] : y.count;

		if (to < 0)
			continue;
		if (diff->take_line)
			give_gap(diff, &x, i, at, &y, j, to);
		else
			tell_gap(diff, what, &x, i, at, &y, j, to);
		if (diff->take_line && at < x.count)
			give_line(diff, &x, at, &y, to);
		i = at + 1;
		j = to + 1;
	}
}
