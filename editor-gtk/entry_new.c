/* SPDX-License-Identifier: MIT
 *
 * entry_new - the last candidates of a line: a new name, with each address that it may
 * get.
 *
 * What it may get entry_read() says. The first is what the line means as it is.
 */
#include "editor-gtk/entry_search.h"
#include "editor-gtk/i18n.h"

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

/* Of one address the line says it, so that it can be changed at once. @begin: with the
 * name, without what is said of it. */
static void add_choices(struct search *s, const struct entry *entry, const char *begin,
			size_t begin_len, const char *typed, size_t typed_len)
{
	const struct entry_new *declared = &entry->declare[entry->declares - 1];

	for (int i = 0; i < entry->choices && s->count < s->most; i++) {
		const char *address = entry->choice[i];
		char *line = s->out[s->count].line;

		if (typed_len > strlen(address) || !ascii_same(address, typed, typed_len))
			continue;
		add_row(s, declared, address, address[0] ? "" : _("no address"));
		snprintf(line, ENTRY_TEXT, "%.*s%s%s", (int)begin_len, begin,
			 address[0] ? " AT " : " : ", address[0] ? address : declared->type);
	}
}

static const struct entry_new *last_declared(const struct entry *entry)
{
	return entry->declares > 0 ? &entry->declare[entry->declares - 1] : NULL;
}

/* If the line with the word before the cursor would declare that. */
static void add_name(struct search *s, struct entry *entry)
{
	const size_t len = s->cursor - s->from;
	const struct entry_new *declared;

	if (!entry_read(s->place, s->line, entry))
		return;
	declared = last_declared(entry);
	if (!declared || !ascii_is(declared->name, s->line + s->from, len))
		return;
	if (entry->choices > 0) {
		add_choices(s, entry, s->line, s->cursor, "", 0);
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

/* Behind AT or in its place the addresses that begin so, behind a colon BOOL. */
static void add_said(struct search *s, size_t name_end, struct entry *entry)
{
	char line[ENTRY_TEXT];
	const char *typed = s->line + s->from;
	size_t len = s->cursor - s->from;
	const bool type = memchr(s->line + name_end, ':', s->from - name_end) != NULL;

	snprintf(line, sizeof(line), "%.*s%s", (int)(type ? s->from : name_end), s->line,
		 type ? "BOOL" : "");
	if (!entry_read(s->place, line, entry) || !last_declared(entry))
		return;
	if (type && ascii_same("BOOL", typed, len < 4 ? len : 4) && len <= 4) {
		snprintf(s->out[s->count].line, ENTRY_TEXT, "%s", line);
		add_row(s, last_declared(entry), last_declared(entry)->address, "");
	} else if (!type) {
		if (ascii_is("AT", typed, len))
			len = 0;
		add_choices(s, entry, line, name_end, typed, len);
	}
}

bool entry_is_said(struct search *s)
{
	const size_t at = operand_at(s);
	const size_t name = at < s->cursor ?
		entry_declared_len(s->line + at, s->cursor - at, ENTRY_WORD_GIVEN) : 0;
	struct entry *entry;

	if (name == 0 || s->from < at + name)
		return false;
	entry = malloc(sizeof(*entry));
	if (entry)
		add_said(s, at + name, entry);
	free(entry);
	return true;
}
