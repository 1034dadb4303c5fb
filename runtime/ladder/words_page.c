/* SPDX-License-Identifier: MIT
 *
 * words_page - the page docs/words.md, made from the catalogue so that it
 * cannot be older than the program. It explains nothing that a row does not
 * say.
 */
#include "engine/base/explain.h"
#include "ladder/words.h"

#include <string.h>

static const char *heading(enum words_kind kind)
{
	switch (kind) {
	case WORDS_ELEMENT:
		return "Elements of a rung";
	case WORDS_BLOCK:
		return "Function blocks";
	case WORDS_FUNCTION:
		return "Functions";
	case WORDS_OPERATOR:
		return "Operators of the instruction list";
	case WORDS_TYPE:
		return "Types";
	case WORDS_AREA:
		return "Areas of direct addresses";
	case WORDS_SYSTEM:
		return "System names";
	case WORDS_KIND_COUNT:
		break;
	}
	return "";
}

static const char *columns(enum words_kind kind)
{
	switch (kind) {
	case WORDS_ELEMENT:
		return "| word | drawn | family | stands with | effect | source | "
		       "more |\n|---|---|---|---|---|---|---|\n";
	case WORDS_TYPE:
		return "| type | size and range | source | more |\n"
		       "|---|---|---|---|\n";
	case WORDS_AREA:
		return "| letters | size and use | what it is | source | more |\n"
		       "|---|---|---|---|---|\n";
	case WORDS_SYSTEM:
		return "| name | address and type | what it is | source | more |\n"
		       "|---|---|---|---|---|\n";
	case WORDS_OPERATOR:
		return "| operator | forms | operand | what it does | source | "
		       "more |\n|---|---|---|---|---|---|\n";
	case WORDS_BLOCK:
	case WORDS_FUNCTION:
	case WORDS_KIND_COUNT:
		break;
	}
	return "";
}

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

/* A title as the anchor that it gets: "Function blocks" is #function-blocks. */
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

/* Those of the words of a table, behind it. */
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
			    pin->dir == PIN_IN ? "in" : "out",
			    pin->type != IEC_NONE ?
			    iec_type_row(pin->type)->word :
			    words_classes(pin->classes));
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
	sink_text(sink, "| ");
	code(sink, entry->word);
	if (entry->kind == WORDS_ELEMENT) {
		sink_text(sink, " | ");
		code(sink, entry->row->glyph);
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

void words_markdown(const struct sink *sink)
{
	enum words_kind kind = WORDS_KIND_COUNT;
	struct words_entry entry;

	sink_text(sink, "# Words\n\n"
		"Every word a program can use. This page is made by "
		"`make words` from `runtime/engine/catalog.def`;\nchange it "
		"there. How the words are put together is told in "
		"[rung-file.md](rung-file.md), when\nthey are evaluated "
		"in [language.md](language.md). Tables are those of the third "
		"edition of\nIEC 61131-3 (2013) unless another is named. "
		"Every example is run by the tests; `ladder words TON`\n"
		"prints what stands here about a word.\n");
	for (int i = 0; words_at(i, &entry); i++) {
		if (entry.kind != kind) {
			table_examples(kind, sink);
			sink_printf(sink, "\n## %s\n%s%s", heading(entry.kind),
				    *columns(entry.kind) ? "\n" : "",
				    columns(entry.kind));
		}
		kind = entry.kind;
		if (kind == WORDS_BLOCK || kind == WORDS_FUNCTION)
			box(&entry, sink);
		else
			table_line(&entry, sink);
	}
}
