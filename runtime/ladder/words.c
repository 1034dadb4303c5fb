/* SPDX-License-Identifier: MIT
 *
 * words - prints every word of the catalogue, or all details of one. A new row of the
 * catalogue appears without a change here.
 */
#include "ladder/words.h"

#include "engine/base/catalog.h"
#include "engine/model/convert.h"
#include "engine/model/words.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* The name of a kind. */
static const char *words_kind(enum words_kind kind)
{
	static const char *const name[WORDS_KIND_COUNT] = {
		"element", "function block", "function", "IL operator", "type",
		"area", "system name",
	};
	return name[kind];
}

const char *words_operand(enum operand_kind kind)
{
	switch (kind) {
	case OPND_NONE:
		return "";
	case OPND_BOOL_R:
		return "a BOOL";
	case OPND_BOOL_W:
		return "a BOOL it writes";
	case OPND_ANY_R:
		return "a value";
	case OPND_ANY_W:
		return "a variable it writes";
	case OPND_LABEL:
		return "a label";
	case OPND_INSTANCE:
		return "an instance";
	case OPND_ROUTINE:
		return "a SUBROUTINE";
	case OPND_EXPR:
		return "an expression";
	case OPND_ASSIGN:
		return "variable := expression";
	case OPND_PIN:
		return "a pin";
	case OPND_LOOP:
		return "variable := value TO value BY constant";
	case OPND_EXECUTE:
		return "a name, or nothing";
	case OPND_LOOP_END:
		return "";
	}
	return "";
}

const char *words_pin_type(const struct word_pin *pin)
{
	static const struct {
		const char *name;
		uint16_t classes;
	} generic[] = {
		{ "ANY_ELEMENTARY", ANY_ELEMENTARY },
		{ "ANY_MAGNITUDE", ANY_MAGNITUDE }, { "ANY_NUM", ANY_NUM },
		{ "ANY_SIMPLE", ANY_SIMPLE }, { "ANY_INT", ANY_INT }, { "ANY_BIT", ANY_BIT },
		{ "BOOL", CLASS_BOOL }, { "ANY_REAL", CLASS_REAL },
		{ "ANY_DATE", ANY_DATE }, { "ANY_STRING", CLASS_STRING },
		{ "TIME", CLASS_TIME }, { "TIME_OF_DAY", CLASS_TOD },
		{ "DATE", CLASS_DATE }, { "DATE_AND_TIME", CLASS_DT },
		{ "ANY_BITS", CLASS_BITS },
	};

	if (pin->type != IEC_NONE)
		return iec_type_row(pin->type)->word;
	for (size_t i = 0; i < sizeof(generic) / sizeof(generic[0]); i++)
		if (generic[i].classes == pin->classes)
			return generic[i].name;
	return "ANY";
}

/* ---- all tables as one row of entries ---- */

static void row_entry(const struct word_row *row, struct words_entry *out)
{
	out->kind = row->kind == WORD_FB ? WORDS_BLOCK :
		    row->kind == WORD_FN ? WORDS_FUNCTION : WORDS_ELEMENT;
	out->word = row->word;
	out->family = *explain_family(row) ? explain_family(row) : NULL;
	out->doc = words_explain(row);
	out->row = row;
}

static void word_entry(int word, struct words_entry *out)
{
	row_entry(word_row((enum word)word), out);
	out->number = word;
}

/* Words that no table has because their names follow a rule: INT_TO_REAL, TON_LTIME. */
static bool made_entry(const char *word, struct convert_word *made,
		       struct words_entry *out)
{
	enum word block = words_find_short(word, strlen(word));

	memset(out, 0, sizeof(*out));
	if (block == WORD_COUNT && !convert_make(word, strlen(word), made))
		return false;
	row_entry(block != WORD_COUNT ? word_row(block) : &made->row, out);
	out->number = (int)block;
	return true;
}

static void op_entry(int op, struct words_entry *out)
{
	out->kind = WORDS_OPERATOR;
	out->number = op;
	out->op = op_row((enum op)op);
	out->word = out->op->word;
	out->doc = explain_op((enum op)op);
}

static void type_entry(int type, struct words_entry *out)
{
	out->kind = WORDS_TYPE;
	out->type = iec_type_row((enum iec_type)type);
	out->word = out->type->word;
}

static void area_entry(int area, struct words_entry *out)
{
	out->kind = WORDS_AREA;
	out->number = area;
	out->area = iec_area_row((enum iec_area)area);
	out->word = out->area->letters;
	out->doc = explain_area((enum iec_area)area);
}

static void sys_entry(int sys, struct words_entry *out)
{
	out->kind = WORDS_SYSTEM;
	out->number = sys;
	out->sys = sys_row((enum sys_id)sys);
	out->type = iec_type_row(out->sys->type);
	out->word = out->sys->name;
	out->doc = explain_sys((enum sys_id)sys);
}

bool words_at(int index, struct words_entry *out)
{
	/* The empty cell has no word, and type and area 0 are "none". */
	static const struct {
		void (*fill)(int number, struct words_entry *out);
		int first, end;
	} table[] = {
		{ word_entry, ELEM_EMPTY + 1, WORD_COUNT },
		{ op_entry, 0, OP_COUNT },
		{ type_entry, IEC_NONE + 1, IEC_TYPE_COUNT },
		{ area_entry, AREA_NONE + 1, AREA_COUNT },
		{ sys_entry, 0, SYS_COUNT },
	};

	memset(out, 0, sizeof(*out));
	out->doc = "";
	for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
		int count = table[i].end - table[i].first;

		if (index < count) {
			table[i].fill(table[i].first + index, out);
			return true;
		}
		index -= count;
	}
	return false;
}

/* ---- notes ---- */

static void note_operator(const struct op_row *op, const struct sink *sink)
{
	const char *word = op->word;

	sink_text(sink, word);
	if (op->modifiers & MOD_C)
		sink_printf(sink, " %sC %sCN", word, word);
	else if (op->modifiers & MOD_N)
		sink_printf(sink, " %sN", word);
	if (op->modifiers & MOD_PAREN)
		sink_printf(sink, " %s( %sN(", word, word);
}

static void note_size(const struct iec_area_row *area, const struct sink *sink)
{
	sink_printf(sink, "%u bytes", (unsigned)area->usual);
	if (area->most != area->usual)
		sink_printf(sink, " (AREA: %u to %u)", (unsigned)area->least,
			    (unsigned)area->most);
}

static void note_type(const struct iec_type_row *type, const struct sink *sink)
{
	sink_printf(sink, "%d byte%s", type->size, type->size == 1 ? "" : "s");
	if (type->class == CLASS_REAL)
		sink_text(sink, type->size == 4 ? ", about 7 digits" :
						  ", about 16 digits");
	else if (type->class == CLASS_TIME)
		sink_text(sink, ", in nanoseconds");
	else if (type->class == CLASS_TOD)
		sink_text(sink, ", nanoseconds since midnight");
	else if (type->class & ANY_DATE)
		sink_text(sink, ", nanoseconds since 1970-01-01");
	else if (type->class == CLASS_STRING)
		sink_printf(sink, " and its text, up to %u bytes",
			    IEC_STRING_MOST);
	else if (iec_is_wide(iec_type_find(type->word, strlen(type->word))))
		sink_printf(sink, ", 0 to %" PRIu64, UINT64_MAX);
	else
		sink_printf(sink, ", %" PRId64 " to %" PRId64, type->low,
			    type->high);
}

static void note_element(const struct word_row *row, const struct sink *sink)
{
	const char *operand = words_operand(row->operand);

	sink_text(sink, operand);
	if (row->place == PLACE_LAST)
		sink_text(sink, row->operand == OPND_BOOL_W ? ", only outputs behind it" :
				*operand ? ", last in its row" : "last in its row");
	if (row->edge != EDGE_NONE)
		sink_text(sink, ", one memory a cell");
}

static void note_function(const struct word_row *row, const struct sink *sink)
{
	int named = row->pin_count;

	if (row->most_inputs > named)
		sink_printf(sink, "%d to %d inputs, ", named, row->most_inputs);
	else
		sink_printf(sink, "%d input%s, ", named, named == 1 ? "" : "s");
	if (word_is_test(row))
		sink_text(sink, "a BOOL that gates the power");
	else if (row->result == (int)RESULT_GATE)
		sink_text(sink, "result of their type, a BOOL gates the power");
	else if (row->result == RESULT_SAME)
		sink_text(sink, "result of their type");
	else if (row->result == RESULT_OPEN)
		sink_text(sink, "result of the type of OUT");
	else
		sink_text(sink, iec_type_row(row->result)->word);
}

static void note_block(const struct word_row *row, const struct sink *sink)
{
	const char *gap = "";

	for (int i = 0; i < row->pin_count; i++) {
		if (row->pin[i].dir == PIN_VAR)
			continue;
		sink_printf(sink, "%s%s %s", gap, row->pin[i].name,
			    iec_type_row(row->pin[i].type)->word);
		gap = ", ";
	}
}

void words_note(const struct words_entry *entry, const struct sink *sink)
{
	switch (entry->kind) {
	case WORDS_ELEMENT:
		note_element(entry->row, sink);
		break;
	case WORDS_BLOCK:
		note_block(entry->row, sink);
		break;
	case WORDS_FUNCTION:
		note_function(entry->row, sink);
		break;
	case WORDS_OPERATOR:
		note_operator(entry->op, sink);
		break;
	case WORDS_TYPE:
		note_type(entry->type, sink);
		break;
	case WORDS_AREA:
		note_size(entry->area, sink);
		sink_printf(sink, ", programs %s",
			    entry->area->access == ACCESS_READ ?
			    "only read it" : "read and write it");
		break;
	case WORDS_SYSTEM:
		sink_printf(sink, "%s %s", entry->sys->address,
			    entry->type->word);
		break;
	case WORDS_KIND_COUNT:
		break;
	}
}

/* ---- text ---- */

static void list_line(const struct words_entry *entry, const struct sink *sink)
{
	sink_printf(sink, "  %-16s ", entry->word);
	if (entry->kind == WORDS_ELEMENT)
		sink_printf(sink, "%s  ", explain_glyph(entry->row));
	if (entry->kind == WORDS_TYPE)
		words_note(entry, sink);
	else
		sink_text(sink, entry->doc);
	sink_text(sink, "\n");
}

const char *words_default(const struct word_pin *pin, char *out)
{
	char value[40];

	out[0] = '\0';
	if (!pin->has_init)
		return out;
	iec_value_print(pin->type, pin_init(pin), value, sizeof(value));
	if (pin->type == IEC_BOOL)
		snprintf(out, 48, "%s", pin->init ? "TRUE" : "FALSE");
	else if (pin->type == IEC_TIME)
		snprintf(out, 48, "T#%sms", value);
	else
		snprintf(out, 48, "%s", value);
	return out;
}

static void pin_lines(const struct word_row *row, const struct sink *sink)
{
	int width = 4;

	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir != PIN_VAR &&
		    (int)strlen(row->pin[i].name) > width)
			width = (int)strlen(row->pin[i].name);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		char text[48];

		if (pin->dir == PIN_VAR)
			continue;
		sink_printf(sink, "  %-3s %-*s %-14s %s%s%s\n",
			    pin->dir == PIN_IN ? "in" : "out", width, pin->name,
			    words_pin_type(pin), explain_pin(row, i),
			    pin->has_init ? "; if not given: " : "",
			    words_default(pin, text));
	}
}

static void sources(const struct words_entry *entry, const struct sink *sink)
{
	const struct words_source *source = words_source(entry);
	const char *title = strchr(source->section, '#');

	sink_printf(sink, "  source: %s\n  more: docs/%.*s, %s\n", source->source,
		    (int)(title - source->section), source->section, title + 1);
}

static void example(const struct words_entry *entry, enum words_form form,
		    const char *heading, const struct sink *sink)
{
	struct sink_memory memory;
	struct sink text = sink_to_memory(&memory);

	sink_memory_init(&memory);
	if (words_example(entry, form, &text))
		sink_printf(sink, "\n%s\n\n", heading);
	sink_text(sink, sink_memory_text(&memory));
	sink_memory_free(&memory);
}

const char *words_symbol(const struct words_entry *entry, char out[WORDS_SYMBOL])
{
	size_t len = (size_t)snprintf(out, WORDS_SYMBOL, "%s", explain_glyph(entry->row));

	while (len > 0 && out[len - 1] == ' ')
		out[--len] = 0;
	return out;
}

static void one_word(const struct words_entry *entry, const struct sink *sink)
{
	char symbol[WORDS_SYMBOL];

	sink_printf(sink, "%s: %s", entry->word, words_kind(entry->kind));
	if (entry->family)
		sink_printf(sink, " (%s)", entry->family);
	if (*entry->doc)
		sink_printf(sink, ": %s", entry->doc);
	sink_text(sink, "\n");
	if (entry->kind == WORDS_ELEMENT)
		sink_printf(sink, "  symbol %s\n", words_symbol(entry, symbol));
	if (entry->kind != WORDS_BLOCK) {
		sink_text(sink, "  ");
		words_note(entry, sink);
		sink_text(sink, "\n");
	}
	if (entry->row)
		pin_lines(entry->row, sink);
	sources(entry, sink);
	example(entry, WORDS_AS_FILE, "example:", sink);
	example(entry, WORDS_AS_PICTURE, "drawn:", sink);
	example(entry, WORDS_AS_LIST, "as a list:", sink);
}

/* ---- JSON ---- */

static void json_field(const struct sink *sink, const char *name,
		       const char *value)
{
	sink_printf(sink, ", \"%s\": ", name);
	sink_json_text(sink, value);
}

static void json_pins(const struct word_row *row, const struct sink *sink)
{
	const char *gap = "";

	sink_text(sink, ", \"pins\": [");
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		char text[48];

		if (pin->dir == PIN_VAR)
			continue;
		sink_printf(sink, "%s{\"pin\": \"%s\"", gap, pin->name);
		json_field(sink, "direction",
			   pin->dir == PIN_IN ? "in" : "out");
		json_field(sink, "type", words_pin_type(pin));
		json_field(sink, "doc", explain_pin(row, i));
		if (pin->has_init)
			json_field(sink, "default", words_default(pin, text));
		sink_text(sink, "}");
		gap = ", ";
	}
	sink_text(sink, "]");
}

/* The lines of an example as one string. */
static void json_example(const struct words_entry *entry, enum words_form form,
			 const char *name, const struct sink *sink)
{
	struct sink_memory memory;
	struct sink text = sink_to_memory(&memory);

	sink_memory_init(&memory);
	if (words_example(entry, form, &text))
		json_field(sink, name, sink_memory_text(&memory));
	sink_memory_free(&memory);
}

static void json_entry(const struct words_entry *entry, const struct sink *sink)
{
	sink_text(sink, "{\"kind\": ");
	sink_json_text(sink, words_kind(entry->kind));
	json_field(sink, "word", entry->word);
	json_field(sink, "doc", entry->doc);
	if (entry->family)
		json_field(sink, "family", entry->family);
	if (entry->kind == WORDS_ELEMENT) {
		json_field(sink, "glyph", explain_glyph(entry->row));
		json_field(sink, "operand", words_operand(entry->row->operand));
	}
	if (entry->kind == WORDS_BLOCK || entry->kind == WORDS_FUNCTION)
		json_pins(entry->row, sink);
	if (entry->kind == WORDS_FUNCTION)
		sink_printf(sink, ", \"most_inputs\": %d",
			    entry->row->most_inputs);
	if (entry->kind == WORDS_TYPE)
		sink_printf(sink, ", \"bytes\": %d", entry->type->size);
	if (entry->area)
		sink_printf(sink, ", \"bytes\": %u, \"most_bytes\": %u, "
			    "\"writable\": %s", (unsigned)entry->area->usual,
			    (unsigned)entry->area->most,
			    entry->area->access == ACCESS_WRITE ? "true" :
								  "false");
	if (entry->sys) {
		json_field(sink, "address", entry->sys->address);
		json_field(sink, "type", entry->type->word);
	}
	json_field(sink, "source", words_source(entry)->source);
	json_field(sink, "section", words_source(entry)->section);
	json_example(entry, WORDS_AS_FILE, "example", sink);
	json_example(entry, WORDS_AS_PICTURE, "picture", sink);
	json_example(entry, WORDS_AS_LIST, "list", sink);
	sink_text(sink, "}");
}

static void show_entry(const struct words_entry *entry, bool one, bool json,
		       bool first, const struct sink *sink)
{
	if (json) {
		sink_text(sink, first ? "\n " : ",\n ");
		json_entry(entry, sink);
	} else if (one) {
		one_word(entry, sink);
	} else {
		list_line(entry, sink);
	}
}

int words_list(const char *word, bool json, const struct sink *sink)
{
	enum words_kind kind = WORDS_KIND_COUNT;
	struct words_entry entry;
	struct convert_word made;
	int found = 0;

	sink_text(sink, json ? "[" : "");
	for (int i = 0; words_at(i, &entry); i++) {
		if (word && strcasecmp(entry.word, word) != 0)
			continue;
		if (!json && !word && entry.kind != kind)
			sink_printf(sink, "%s%ss\n", found ? "\n" : "",
				    words_kind(entry.kind));
		show_entry(&entry, word, json, found == 0, sink);
		kind = entry.kind;
		found++;
	}
	if (!found && word && made_entry(word, &made, &entry)) {
		show_entry(&entry, true, json, true, sink);
		found++;
	}
	sink_text(sink, json ? "\n]\n" : "");
	return found;
}
