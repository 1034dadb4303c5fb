/* SPDX-License-Identifier: MIT
 *
 * entry_new - the last candidates of a line: a new name, with each address that it may
 * get.
 *
 * What it may get entry_read() says. The first is what the line means as it is.
 */
#include "editor-gtk/edit/entry_search.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_row(struct search *s, const struct entry_new *declared,
		    const char *address, const char *more)
{
	struct entry_candidate *c = &s->out[s->count++];

	memset(c, 0, sizeof(*c));
	c->kind = ENTRY_NEW;
	snprintf(c->text, sizeof(c->text), "%s", declared->name);
	snprintf(c->address, sizeof(c->address), "%s", address);
	snprintf(c->note, sizeof(c->note), "%.100s%s%.200s", declared->type,
		 more[0] ? ", " : "", more);
}

/* Of one address the line says it, so that it can be changed at once. @name_end: of the
 * name in the line; from there to the cursor goes what is said of it. */
static void add_choices(struct search *s, const struct entry_new *declared,
			size_t name_end, const char *typed, size_t typed_len)
{
	for (int i = 0; i < declared->choices && s->count < s->most; i++) {
		const char *address = declared->choice[i];
		char *line = s->out[s->count].line;

		if (typed_len > strlen(address) || !ascii_same(address, typed, typed_len))
			continue;
		add_row(s, declared, address, address[0] ? "" : _("no address"));
		snprintf(line, ENTRY_TEXT, "%.*s%s%s%s", (int)name_end, s->line,
			 address[0] ? " AT " : " : ", address[0] ? address : declared->type,
			 s->line + s->cursor);
	}
}

static const struct entry_new *declared_as(const struct entry *entry, const char *name,
					   size_t len)
{
	for (int i = 0; i < entry->declares; i++)
		if (ascii_is(entry->declare[i].name, name, len))
			return &entry->declare[i];
	return NULL;
}

/* If the line with the word before the cursor would declare that. */
static void add_name(struct search *s, struct entry *entry)
{
	const struct entry_new *declared;

	if (!entry_read(s->place, s->line, entry))
		return;
	declared = declared_as(entry, s->line + s->from, s->cursor - s->from);
	if (!declared)
		return;
	if (declared->choices > 0) {
		add_choices(s, declared, s->cursor, "", 0);
		return;
	}
	snprintf(s->out[s->count].line, ENTRY_TEXT, "%s", s->line);
	add_row(s, declared, declared->address, "");
}

void entry_add_new(struct search *s)
{
	struct entry *entry = malloc(sizeof(*entry));

	if (entry && s->count < s->most && s->cursor > s->from)
		add_name(s, entry);
	free(entry);
}

/* ---- what is said of it already ---- */

/* Where the operand begins: behind a word, a glyph, a sign. */
static size_t operand_at(const struct search *s)
{
	static const char blanks[] = " \t";
	size_t at = strspn(s->line, blanks), len, glyph;
	enum word word;
	bool below;

	glyph = entry_glyph(s->line + at, &word);
	len = strcspn(s->line + at, blanks);
	if (glyph > 0)
		at += glyph;
	else if (!entry_declared_len(s->line + at, s->cursor - at, ENTRY_WORD_POSSIBLE) &&
		 entry_word_find(s->place, s->line + at, len, &below) != WORD_COUNT)
		at += len;
	at += strspn(s->line + at, blanks);
	if (s->line[at] == '/' || s->line[at] == '!')
		at += 1 + strspn(s->line + at + 1, blanks);
	return at;
}

/* What the cursor's word says of a name. */
struct saying {
	size_t name, name_end; /* in the line; name_end 0: it says nothing     */
	bool type;             /* else its address                             */
};

static size_t back_blanks(const char *line, size_t at)
{
	while (at > 0 && (line[at - 1] == ' ' || line[at - 1] == '\t'))
		at--;
	return at;
}

/* Without the sign before it; the colon in I:0/3 belongs to it. */
static size_t back_word(const char *line, size_t end)
{
	size_t at = end;

	while (at > 0 && (!strchr(" \t:=<>+-*&,;()[]", line[at - 1]) ||
			  (at < end && line[at - 1] == ':' && ascii_digit(line[at]))))
		at--;
	while (at < end && (line[at] == '/' || line[at] == '!'))
		at++;
	return at;
}

/* By what stands before that word: `Level AT`, `Level AT %IW0 :`, `Level :`; or it is
 * AT itself; or, of a contact or coil, an address. */
static struct saying find_saying(const struct search *s)
{
	const char *line = s->line;
	size_t end = back_blanks(line, s->from), word;
	struct saying out = { .type = end > 0 && line[end - 1] == ':' };

	if (out.type)
		end = back_blanks(line, end - 1);
	word = back_word(line, end);
	if (ascii_is("AT", line + word, end - word)) {
		end = back_blanks(line, word);
	} else if (out.type && back_blanks(line, word) > 0) {
		const size_t at = back_word(line, back_blanks(line, word));

		if (ascii_is("AT", line + at, back_blanks(line, word) - at))
			end = back_blanks(line, at);
		else if (line[word] == '%' && at == operand_at(s))
			end = back_blanks(line, word);
	} else if (!out.type && !ascii_is("AT", line + s->from, s->cursor - s->from) &&
		   (line[s->from] != '%' || word != operand_at(s))) {
		return out;
	}
	word = back_word(line, end);
	if (entry_is_name(line + word, end - word)) {
		out.name = word;
		out.name_end = end;
	}
	return out;
}

/* All types that will do there. */
static void add_types(struct search *s, const struct saying *saying, struct entry *entry)
{
	const size_t len = s->cursor - s->from;

	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT && s->count < s->most; i++) {
		const char *word = iec_type_row((enum iec_type)i)->word;
		char *line = s->out[s->count].line;
		const struct entry_new *declared;

		if (len > strlen(word) || !ascii_same(word, s->line + s->from, len))
			continue;
		snprintf(line, ENTRY_TEXT, "%.*s%s%s", (int)s->from, s->line, word,
			 s->line + s->cursor);
		if (!entry_read(s->place, line, entry))
			continue;
		declared = declared_as(entry, s->line + saying->name,
				       saying->name_end - saying->name);
		if (declared)
			add_row(s, declared, declared->address, "");
	}
}

/* Behind AT or in its place the addresses that begin so. */
static void add_addresses(struct search *s, const struct saying *saying,
			  struct entry *entry)
{
	const char *typed = s->line + s->from;
	const size_t len = s->cursor - s->from;
	const struct entry_new *declared;
	char line[ENTRY_TEXT];

	snprintf(line, sizeof(line), "%.*s%s", (int)saying->name_end, s->line,
		 s->line + s->cursor);
	if (!entry_read(s->place, line, entry))
		return;
	declared = declared_as(entry, s->line + saying->name,
			       saying->name_end - saying->name);
	if (declared)
		add_choices(s, declared, saying->name_end, typed,
			    ascii_is("AT", typed, len) ? 0 : len);
}

bool entry_is_said(struct search *s)
{
	const struct saying saying = find_saying(s);
	struct entry *entry;

	if (saying.name_end == 0)
		return false;
	entry = malloc(sizeof(*entry));
	if (entry && saying.type)
		add_types(s, &saying, entry);
	else if (entry)
		add_addresses(s, &saying, entry);
	free(entry);
	return true;
}
