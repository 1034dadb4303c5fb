/* SPDX-License-Identifier: MIT
 *
 * words_page - prints the page docs/words.md from the catalogue.
 */
#include "engine/base/catalog.h"
#include "ladder/words.h"

#include <string.h>

/* Functions and blocks have a table each, and none for all. */
static const struct {
	const char *heading, *columns;
} of_kind[WORDS_KIND_COUNT] = {
	[WORDS_ELEMENT] = { "Elements of a rung",
		"\n| word | symbol | family | stands with | effect | source | more |\n"
		"|---|---|---|---|---|---|---|\n" },
	[WORDS_BLOCK] = { "Function blocks", "" },
	[WORDS_FUNCTION] = { "Functions", "" },
	[WORDS_OPERATOR] = { "Operators of the instruction list",
		"\n| operator | forms | operand | what it does | source | more |\n"
		"|---|---|---|---|---|---|\n" },
	[WORDS_TYPE] = { "Types",
		"\n| type | size and range | source | more |\n|---|---|---|---|\n" },
	[WORDS_AREA] = { "Areas of direct addresses",
		"\n| letters | size and use | what it is | source | more |\n"
		"|---|---|---|---|---|\n" },
	[WORDS_SYSTEM] = { "System names",
		"\n| name | address and type | what it is | source | more |\n"
		"|---|---|---|---|---|\n" },
};

/* A bar would end the column of a Markdown table. */
static void in_table(const struct sink *sink, const char *text)
{
	for (; *text; text++) {
		if (*text == '|')
			sink_text(sink, "\\");
		sink_write(sink, text, 1);
	}
}

static void code(const struct sink *sink, const char *text)
{
	sink_text(sink, "`");
	in_table(sink, text);
	sink_text(sink, "`");
}

/* A link to the section; "Function blocks" has the anchor #function-blocks. */
static void more(const struct words_entry *entry, const struct sink *sink)
{
	const char *section = words_source(entry)->section;
	const char *title = strchr(section, '#') + 1;

	sink_printf(sink, "[%s](%.*s", title, (int)(title - section), section);
	for (; *title; title++) {
		char c = *title >= 'A' && *title <= 'Z' ? (char)(*title + 32) :
			 *title == ' ' ? '-' : *title;

		sink_write(sink, &c, 1);
	}
	sink_text(sink, ")");
}

static void fence(const struct words_entry *entry, enum words_form form,
		  const struct sink *sink)
{
	struct sink_memory memory;
	struct sink text = sink_to_memory(&memory);

	sink_memory_init(&memory);
	if (words_example(entry, form, &text)) {
		sink_text(sink, form == WORDS_AS_PICTURE ? "\n```text\n" :
							   "\n```rung\n");
		sink_text(sink, sink_memory_text(&memory));
		sink_text(sink, "```\n");
	}
	sink_memory_free(&memory);
}

static void examples(const struct words_entry *entry, const struct sink *sink)
{
	fence(entry, WORDS_AS_FILE, sink);
	fence(entry, WORDS_AS_PICTURE, sink);
	fence(entry, WORDS_AS_LIST, sink);
}

/* The examples of a table's words, after the table. */
static void table_examples(enum words_kind kind, const struct sink *sink)
{
	struct words_entry entry;

	if (kind != WORDS_ELEMENT && kind != WORDS_OPERATOR)
		return;
	for (int i = 0; words_at(i, &entry); i++) {
		if (entry.kind != kind)
			continue;
		sink_printf(sink, "\n### `%s`: ", entry.word);
		sink_printf(sink, "%s\n", entry.doc);
		examples(&entry, sink);
	}
}

static void box(const struct words_entry *entry, const struct sink *sink)
{
	const struct word_row *row = entry->row;

	sink_printf(sink, "\n### %s: %s\n\n", entry->word, entry->doc);
	sink_printf(sink, "%s, ", entry->family);
	if (entry->kind == WORDS_BLOCK)
		sink_printf(sink, "%u bytes an instance", (unsigned)row->size);
	else
		words_note(entry, sink);
	sink_printf(sink, ". %s; more: ", words_source(entry)->source);
	more(entry, sink);
	sink_text(sink, ".\n\n| pin | way | type | what it is |\n"
			"|---|---|---|---|\n");
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		char text[48];

		if (pin->dir == PIN_VAR)
			continue;
		sink_printf(sink, "| `%s` | %s | %s | ", pin->name,
			    pin->dir == PIN_IN ? "in" : "out", words_pin_type(pin));
		in_table(sink, explain_pin(row, i));
		if (pin->has_init)
			sink_printf(sink, "; `%s` if not given",
				    words_default(pin, text));
		sink_text(sink, " |\n");
	}
	examples(entry, sink);
}

static void table_line(const struct words_entry *entry, const struct sink *sink)
{
	char symbol[WORDS_SYMBOL];

	sink_text(sink, "| ");
	code(sink, entry->word);
	if (entry->kind == WORDS_ELEMENT) {
		sink_text(sink, " | ");
		code(sink, words_symbol(entry, symbol));
		sink_printf(sink, " | %s",
			    entry->family ? entry->family : "");
	}
	sink_text(sink, " | ");
	words_note(entry, sink);
	if (entry->kind == WORDS_OPERATOR)
		sink_printf(sink, " | %s", words_operand(entry->op->operand));
	if (*entry->doc) {
		sink_text(sink, " | ");
		in_table(sink, entry->doc);
	}
	sink_printf(sink, " | %s | ", words_source(entry)->source);
	more(entry, sink);
	sink_text(sink, " |\n");
}

/* All words of a kind: rows of the catalogue are in another order. */
static void part(enum words_kind kind, const struct sink *sink)
{
	struct words_entry entry;

	sink_printf(sink, "\n## %s\n%s", of_kind[kind].heading, of_kind[kind].columns);
	for (int i = 0; words_at(i, &entry); i++) {
		if (entry.kind != kind)
			continue;
		if (kind == WORDS_BLOCK || kind == WORDS_FUNCTION)
			box(&entry, sink);
		else
			table_line(&entry, sink);
	}
	table_examples(kind, sink);
}

void words_markdown(const struct sink *sink)
{
	sink_text(sink, "# Words\n\n"
		"This page lists every word that a program can use. `make words` "
		"makes it from\n`runtime/engine/catalog.def`; change it there. "
		"[rung-file.md](rung-file.md) describes the syntax,\n"
		"[language.md](language.md) what each word does. Numbers of tables "
		"are those of the third edition\nof IEC 61131-3 (2013) unless "
		"another is named. The tests run every example. `ladder words TON`\n"
		"prints the entry of a word.\n");
	for (int kind = 0; kind < WORDS_KIND_COUNT; kind++)
		part((enum words_kind)kind, sink);
}
