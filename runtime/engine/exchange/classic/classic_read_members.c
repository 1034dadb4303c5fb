/* SPDX-License-Identifier: MIT
 *
 * classic_read_members - the files that a ClassicLadder project is a container of.
 *
 * Their names are looked at nowhere but in a table: nothing is written to a disk. A
 * member without an end would swallow the next one, and is refused.
 */
#include "engine/exchange/classic/classic_read.h"

static const char begins[] = "_FILE-";
static const char ends[] = "_/FILE-";
static const char last[] = "_/FILES_CLASSICLADDER";

struct lines {
	const char *at, *end;
	const char *line;
	size_t len;              /* without its end                            */
	int number;
};

static bool next_line(struct lines *lines)
{
	size_t left = (size_t)(lines->end - lines->at);
	const char *newline;

	if (!left)
		return false;
	newline = memchr(lines->at, '\n', left);
	lines->line = lines->at;
	lines->len = newline ? (size_t)(newline - lines->at) : left;
	lines->at += lines->len + (newline ? 1 : 0);
	lines->number++;
	while (lines->len && (lines->line[lines->len - 1] == '\r' ||
			      lines->line[lines->len - 1] == ' '))
		lines->len--;
	return true;
}

static bool begins_with(const struct lines *lines, const char *word)
{
	size_t len = strlen(word);

	return lines->len >= len && memcmp(lines->line, word, len) == 0;
}

/* The lines up to the end of the member that begins here. */
static bool take_member(struct classic_reader *reader, struct lines *lines)
{
	struct classic_project *project = reader->project;
	struct classic_place place = { "", lines->number };
	struct classic_member member = { 0 }, *added;

	member.name = classic_text(reader, lines->line + sizeof(begins) - 1,
				   lines->len - (sizeof(begins) - 1));
	member.text = lines->at;
	member.line = lines->number + 1;
	for (;;) {
		if (!next_line(lines) || begins_with(lines, begins) ||
		    begins_with(lines, last))
			return classic_fail_at(reader, DIAG_IMPORT_OPEN, place,
					       member.name, strlen(member.name));
		if (begins_with(lines, ends))
			break;
	}
	member.len = (size_t)(lines->line - member.text);
	if (project->members >= 2 * CLASSIC_LIMIT)
		return classic_fail_at(reader, DIAG_TOO_MANY, place, member.name,
				       strlen(member.name));
	added = arena_push(reader->arena, &project->member, &project->members,
			   sizeof(member));
	if (added)
		*added = member;
	return true;
}

bool classic_members(struct classic_reader *reader, const char *text, size_t len)
{
	struct lines lines = { text, text + len, text, 0, 0 };
	struct classic_place place = { "", 1 };
	bool closed = false;

	next_line(&lines);
	if (lines.len != sizeof(last) - 2) /* _FILES_… has no slash            */
		return classic_fail_at(reader, DIAG_NEWER_VERSION, place, lines.line,
				       lines.len);
	while (!closed && next_line(&lines)) {
		if (begins_with(&lines, last))
			closed = true;
		else if (begins_with(&lines, begins)) {
			if (!take_member(reader, &lines))
				return false;
		} else if (lines.len) {
			place.line = lines.number;
			return classic_fail_at(reader, DIAG_IMPORT_LINE, place,
					       lines.line, lines.len);
		}
	}
	place.line = lines.number;
	return closed || classic_fail_at(reader, DIAG_IMPORT_CUT, place, "", 0);
}
