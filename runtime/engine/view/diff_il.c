/* SPDX-License-Identifier: MIT
 *
 * diff_il - two instruction lists or charts compared line by line, as they are written.
 *
 * Lines are counted from the one behind the declarations.
 */
#include "engine/view/diff.h"
#include "engine/text/text.h"
#include "engine/view/view.h"

#include <string.h>

struct lines {
	char *text;        /* cut into lines, NUL-ended                       */
	char **line;
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
		return view_print_il(project, pou, &none, NULL, 0, &pou->il, sink);
	sink_text(sink, "PROGRAM\n");
	text_write_chart(project, pou, sink);
	sink_text(sink, "END_PROGRAM\n");
	return true;
}

static bool make_lines(struct diff *diff, const struct project *project,
		       const struct pou *pou, struct lines *lines)
{
	const struct sink sink = sink_to_memory(&diff->bytes);

	diff->bytes.len = 0;
	if (!write_body(project, pou, &sink) || diff->bytes.failed)
		return false;
	lines->text = arena_copy(&diff->arena, diff->bytes.text,
				 diff->bytes.len);
	if (!lines->text || !cut_lines(diff, lines))
		return false;
	lines->id = arena_alloc(&diff->arena, (size_t)(lines->count + 1) *
					      sizeof(*lines->id));
	for (int i = 0; lines->id && i < lines->count; i++) {
		char *line = one_blank(lines->line[i]);

		lines->line[i] = line;
		lines->id[i] = diff_id(diff, line, strlen(line));
	}
	return lines->id && !diff->failed;
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

void diff_il(struct diff *diff, const struct pou *a, const struct pou *b)
{
	struct difference what = { .pou = project_text(diff->a, a->name) };
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
	for (int at = 0; at < x.count; at++)
		if (match[at] >= 0) {
			tell_gap(diff, what, &x, i, at, &y, j, match[at]);
			i = at + 1;
			j = match[at] + 1;
		}
	tell_gap(diff, what, &x, i, x.count, &y, j, y.count);
}
