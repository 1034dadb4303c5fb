/* SPDX-License-Identifier: MIT
 *
 * words_example - makes an example for each word from its row: a rung file, the picture of
 * its rung, and the same as a list.
 *
 * Types of pins, and sometimes their names, decide on variables and values. Examples that
 * no rule can make (a jump needs a label) are written by hand. tests/docs.t runs every
 * example of docs/words.md.
 */
#include "engine/model/project.h"
#include "engine/show/show.h"
#include "engine/text/text.h"
#include "ladder/words.h"

#include <stdlib.h>
#include <string.h>

/* An example while it is made: `var` takes its variables, `out` its body. */
struct example {
	struct sink_memory vars, body;
	struct sink var, out;
	int switches;         /* inputs after %IX0.0                          */
	bool value;           /* Value is declared                            */
	enum iec_type in_text; /* Value is a text that holds this type;
				  IEC_NONE: any text                          */
};

/* ---- values ---- */

static enum iec_type type_of(uint16_t classes)
{
	static const struct {
		uint16_t classes;
		enum iec_type type;
	} first[] = {
		{ CLASS_SIGNED, IEC_INT }, { CLASS_BITS, IEC_WORD },
		{ CLASS_REAL, IEC_REAL }, { CLASS_TIME, IEC_TIME },
		{ CLASS_TOD, IEC_TIME_OF_DAY }, { CLASS_DT, IEC_DATE_AND_TIME },
		{ CLASS_DATE, IEC_DATE }, { CLASS_STRING, IEC_STRING },
		{ CLASS_UNSIGNED, IEC_UINT },
	};

	for (size_t i = 0; i < sizeof(first) / sizeof(first[0]); i++)
		if (classes & first[i].classes)
			return first[i].type;
	return IEC_BOOL;
}

static enum iec_type pin_type(const struct word_pin *pin)
{
	return pin->type != IEC_NONE ? pin->type : type_of(pin->classes);
}

/* A constant, or the initial value of a variable; both fit any width. */
static const char *value_of(enum iec_type type, bool initial)
{
	switch (iec_type_row(type)->class) {
	case CLASS_BOOL:
		return "TRUE";
	case CLASS_BITS:
		return initial ? "16#42" : "16#0F";
	case CLASS_REAL:
		return initial ? "0.5" : "2.0";
	case CLASS_TIME:
		return initial ? "T#1s500ms" : "T#2s";
	case CLASS_TOD:
		return initial ? "TOD#08:30:00" : "TOD#06:00:00";
	case CLASS_DATE:
		return initial ? "D#2026-11-21" : "D#2026-01-01";
	case CLASS_DT:
		return initial ? "DT#2026-11-21-08:30:00" :
				 "DT#2026-01-01-00:00:00";
	case CLASS_STRING:
		return initial ? "'ladder'" : "'add'";
	default:
		return initial ? "7" : "3";
	}
}

/* Values for pins that do not take any value of their type. */
static const char *value_by_name(const struct word_pin *pin)
{
	static const struct {
		const char *pin;
		uint16_t classes;
		const char *value;
	} known[] = {
		{ "MN", CLASS_SIGNED, "0" }, { "MX", CLASS_SIGNED, "100" },
		{ "L", CLASS_SIGNED, "2" }, { "P", CLASS_SIGNED, "2" },
		{ "K", CLASS_SIGNED, "1" }, { "YEAR", CLASS_SIGNED, "2026" },
		{ "MONTH", CLASS_SIGNED, "11" }, { "DAY", CLASS_SIGNED, "21" },
		{ "HOUR", CLASS_SIGNED, "8" }, { "MINUTE", CLASS_SIGNED, "30" },
		{ "NOW", CLASS_DT, "SYS_DATE_TIME" },
		{ "OFF", CLASS_TOD, "TOD#22:00:00" },
		{ "ON1", CLASS_TOD, "TOD#06:00:00" }, { "OFF1", CLASS_TOD, "TOD#22:00:00" },
		{ "ZONE", CLASS_TIME, "SYS_ZONE" },
		{ "LATITUDE", CLASS_REAL, "48.1" }, { "LONGITUDE", CLASS_REAL, "11.6" },
		{ "ON", CLASS_REAL, "21.0" }, { "OFF", CLASS_REAL, "19.0" },
		{ "SP", CLASS_REAL, "60.0" }, { "IN_MIN", CLASS_REAL, "0.0" },
		{ "IN_MAX", CLASS_REAL, "27648.0" },
		{ "OUT_MIN", CLASS_REAL, "0.0" }, { "OUT_MAX", CLASS_REAL, "100.0" },
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++)
		if (strcmp(pin->name, known[i].pin) == 0 &&
		    iec_type_row(pin_type(pin))->class == known[i].classes)
			return known[i].value;
	return NULL;
}

/* These inputs get a variable, the others constants. */
static bool wants_variable(const struct word_pin *pin)
{
	static const char *const name[] = { "IN", "IN1", "IN0", "Y", "DUTY" };

	for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++)
		if (strcmp(pin->name, name[i]) == 0)
			return true;
	return strcmp(pin->name, "PV") == 0 && pin->type == IEC_REAL;
}

static void declare_value(struct example *example, enum iec_type type)
{
	if (type == IEC_STRING && example->in_text != IEC_NONE)
		sink_printf(&example->var, "Value : STRING := '%s';\n",
			    value_of(example->in_text, true));
	else
		sink_printf(&example->var, "Value : %s := %s;\n",
			    iec_type_row(type)->word, value_of(type, true));
	example->value = true;
}

/* At an address, so that there is no warning "never read"; a STRING has none. */
static void declare_result(struct example *example, enum iec_type type)
{
	static const char width[] = { [1] = 'B', [2] = 'W', [4] = 'D', [8] = 'L' };
	const struct iec_type_row *row = iec_type_row(type);

	sink_text(&example->var, "Result");
	if (type == IEC_BOOL)
		sink_text(&example->var, " AT %MX0.0");
	else if (row->class != CLASS_STRING)
		sink_printf(&example->var, " AT %%M%c0", width[row->size]);
	sink_printf(&example->var, " : %s;\n", row->word);
}

static void put_value(struct example *example, const struct word_pin *pin)
{
	enum iec_type type = pin_type(pin);
	const char *known = value_by_name(pin);

	if (known) {
		sink_text(&example->out, known);
	} else if (type == IEC_BOOL) {
		sink_printf(&example->out, "%%IX0.%d", ++example->switches);
	} else if (wants_variable(pin) && !example->value) {
		declare_value(example, type);
		sink_text(&example->out, "Value");
	} else {
		sink_text(&example->out, value_of(type, false));
	}
}

/* ---- functions ---- */

static enum iec_type shared_type(const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (!row->pin[i].own)
			return pin_type(&row->pin[i]);
	return IEC_INT;
}

static enum iec_type result_type(const struct word_row *row)
{
	if (word_shares(row))
		return shared_type(row);
	if (row->result != (int)RESULT_OPEN)
		return row->result;
	/* A conversion has a result of another type than its input. */
	if (row->result_classes & CLASS_REAL && !(shared_type(row) == IEC_REAL))
		return IEC_REAL;
	return type_of(row->result_classes);
}

/* A text that is converted to a number must hold one. */
static enum iec_type text_holds(const struct word_row *row)
{
	enum iec_type result = result_type(row);

	return strcmp(explain_family(row), "Convert") == 0 && result != IEC_STRING ?
	       result : IEC_NONE;
}

static void function_cells(struct example *example, const struct word_row *row)
{
	example->in_text = text_holds(row);
	sink_printf(&example->out, "| NO Input | %s", row->word);
	for (int i = 0; i < row->pin_count; i++) {
		sink_printf(&example->out, " %s:=", row->pin[i].name);
		put_value(example, &row->pin[i]);
	}
	if (!word_is_test(row)) {
		declare_result(example, result_type(row));
		sink_text(&example->out, " OUT=>Result");
	}
	sink_text(&example->out, " | COIL Output |\n");
}

static void function_list(struct example *example, const struct word_row *row)
{
	example->in_text = text_holds(row);
	sink_text(&example->out, "LD ");
	put_value(example, &row->pin[0]);
	sink_printf(&example->out, "\n%s", row->word);
	for (int i = 1; i < row->pin_count; i++) {
		sink_text(&example->out, i > 1 ? ", " : " ");
		put_value(example, &row->pin[i]);
	}
	if (!word_is_test(row))
		declare_result(example, result_type(row));
	sink_printf(&example->out, "\nST %s\n",
		    word_is_test(row) ? "Output" : "Result");
}

/* ---- function blocks ---- */

/* Inputs except the power input and those with a default. */
static bool shown_input(const struct word_row *row, int index)
{
	const struct word_pin *pin = &row->pin[index];

	return pin->dir == PIN_IN && !pin->has_init &&
	       index != word_first_bool(row, PIN_IN);
}

static void block_cells(struct example *example, const struct word_row *row)
{
	const struct word_pin *result = NULL;

	sink_printf(&example->var, "Box : %s;\n", row->word);
	sink_printf(&example->out, "| NO Input | %s Box", row->word);
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (shown_input(row, i)) {
			sink_printf(&example->out, " %s:=", pin->name);
			put_value(example, pin);
		} else if (!result && pin->dir == PIN_OUT && pin->type != IEC_BOOL) {
			result = pin;
		}
	}
	if (result) {
		declare_result(example, result->type);
		sink_printf(&example->out, " %s=>Result", result->name);
	}
	sink_text(&example->out, " | COIL Output |\n");
}

static void block_list(struct example *example, const struct word_row *row)
{
	sink_printf(&example->var, "Box : %s;\n", row->word);
	sink_printf(&example->out, "CAL Box(%s := Input",
		    row->pin[word_first_bool(row, PIN_IN)].name);
	for (int i = 0; i < row->pin_count; i++)
		if (shown_input(row, i)) {
			sink_printf(&example->out, ", %s := ", row->pin[i].name);
			put_value(example, &row->pin[i]);
		}
	sink_text(&example->out, ")\n");
	if (word_first_bool(row, PIN_OUT) < 0)
		sink_text(&example->out, "LD Input\nST Output\n");
	else
		sink_printf(&example->out, "LD Box.%s\nST Output\n",
			    row->pin[word_first_bool(row, PIN_OUT)].name);
}

/* ---- elements and names ---- */

static void element_cells(struct example *example, const struct word_row *row)
{
	const struct sink *out = &example->out;

	if (row->operand == OPND_BOOL_R)
		sink_printf(out, "| %s Input | COIL Output |\n", row->word);
	else if (row->operand == OPND_BOOL_W)
		sink_printf(out, "| NO Input | %s Output |\n", row->word);
	else if (row->place == PLACE_LAST)
		sink_printf(out, "| NO Input | %s |\n", row->word);
	else
		sink_printf(out, "| NO Input | %s | COIL Output |\n", row->word);
}

/* For a type, an area or a system name: a rung that copies such a value. */
static void name_cells(struct example *example, const struct words_entry *entry)
{
	enum iec_type type = entry->kind == WORDS_AREA ? IEC_WORD :
		(enum iec_type)iec_type_find(entry->type->word,
					     strlen(entry->type->word));

	if (entry->kind == WORDS_SYSTEM && type == IEC_BOOL) {
		sink_printf(&example->out, "| NO %s | COIL Output |\n", entry->word);
		return;
	}
	if (entry->kind == WORDS_TYPE)
		declare_value(example, type);
	declare_result(example, type);
	sink_printf(&example->out, "| NO Input | MOVE IN:=%s%s%s OUT=>Result | "
		    "COIL Output |\n", entry->kind == WORDS_AREA ? "%" : "",
		    entry->kind == WORDS_TYPE ? "Value" : entry->word,
		    entry->kind == WORDS_AREA ? "W0" : "");
}

/* ---- the whole ---- */

static void ladder_body(struct example *example, const struct words_entry *entry)
{
	if (entry->kind == WORDS_FUNCTION)
		function_cells(example, entry->row);
	else if (entry->kind == WORDS_BLOCK)
		block_cells(example, entry->row);
	else if (entry->kind == WORDS_ELEMENT)
		element_cells(example, entry->row);
	else
		name_cells(example, entry);
}

static bool has_form(const struct words_entry *entry, enum words_form form)
{
	if (form == WORDS_AS_LIST)
		return entry->kind == WORDS_OPERATOR ||
		       entry->kind == WORDS_BLOCK || entry->kind == WORDS_FUNCTION;
	return entry->kind != WORDS_OPERATOR;
}

/* Declares Input and Output only if the example uses them. */
static void whole_file(struct example *example, bool list, const char *behind,
		       const struct sink *sink)
{
	const char *body = sink_memory_text(&example->body);

	sink_text(sink, "RUNGBOARD 1\n\nVAR\n");
	if (strstr(body, "Input"))
		sink_text(sink, "Input AT %IX0.0 : BOOL;\n");
	if (strstr(body, "Output"))
		sink_text(sink, "Output AT %QX0.0 : BOOL;\n");
	sink_text(sink, sink_memory_text(&example->vars));
	sink_printf(sink, "END_VAR\n\nPROGRAM Main %s\n", list ? "IL" : "LD\nRUNG");
	sink_text(sink, body);
	sink_text(sink, "END_PROGRAM\n");
	sink_text(sink, behind);
}

/* An example written by hand: variables, the body of Main, text after Main. */
struct hand {
	const char *vars, *body, *behind;
};

static const struct {
	enum word word;
	struct hand hand;
} of_word[] = {
	{ ELEM_WIRE, { "", "| NO Input | --- | COIL Output |\n", "" } },
	{ ELEM_JUMP, { "Hand AT %IX0.1 : BOOL;\n",
		"| NO Hand | JMP Behind |\nRUNG\n| NO Input | COIL Output |\n"
		"RUNG Behind\n| NO Hand | COIL %QX0.1 |\n", "" } },
	{ ELEM_CALL, { "", "| P Input | CALL Turn | COIL Output |\n",
		"\nSUBROUTINE Turn LD\nRUNG\n| NC %QX0.1 | COIL %QX0.1 |\n"
		"END_SUBROUTINE\n" } },
	{ ELEM_FOR, { "I : INT;\nSum : INT;\n",
		"| NO Input | FOR I := 1 TO 4 |\nRUNG\n| [ Sum := Sum + I ] |\n"
		"RUNG\n| NEXT |\n", "" } },
	{ ELEM_NEXT, { "I : INT;\nSum : INT;\n",
		"| NO Input | FOR I := 1 TO 4 |\nRUNG\n| [ Sum := Sum + I ] |\n"
		"RUNG\n| NEXT |\n", "" } },
	{ ELEM_COMPARE, { "Level AT %IW2 : INT;\n",
		"| NO Input | [ Level > 20 AND Level < 80 ] | COIL Output |\n", "" } },
	{ ELEM_ASSIGN, { "Level : INT;\n",
		"| P Input | [ Level := Level * 2 + 1 ] |\n", "" } },
	{ ELEM_EXECUTE, { "Level : INT;\nFull : BOOL;\n",
		"| NO Input | EXECUTE Count | COIL Output |\n"
		"EXECUTE Count:\nLevel := Level + 1;\nFull := Level > 100;\nEND_EXECUTE\n"
		"RUNG\n| NO Full | COIL %QX0.1 |\n", "" } },
	{ ELEM_PIN, { "Box : CTU;\n",
		"| NO Input  | CTU Box PV:=3 | COIL Output |\n"
		"| NO %IX0.1 | .R           |\n", "" } },
	{ FN_INC, { "Count : INT;\n",
		"| P Input | INC IN:=Count OUT=>Count | COIL Output |\n", "" } },
	{ FN_DEC, { "Count : INT := 10;\n",
		"| P Input | DEC IN:=Count OUT=>Count | COIL Output |\n", "" } },
#ifndef RUNGBOARD_CORE_WORDS
	{ FN_CONVERT_NS, { "Value : TIME := T#1s500ms;\nResult AT %ML0 : LINT;\n",
		"| NO Input | CONVERT_NS IN:=Value OUT=>Result | COIL Output |\n",
		"" } },
#endif
};

static const struct hand of_op[OP_COUNT] = {
	[OP_LD]  = { "", "LD Input\nST Output\n", "" },
	[OP_ST]  = { "", "LD Input\nST Output\nSTN %QX0.1\n", "" },
	[OP_S]   = { "", "LD Input\nS Output\n", "" },
	[OP_R]   = { "", "LD Input\nR Output\n", "" },
	[OP_AND] = { "", "LD Input\nANDN %IX0.1\nST Output\n", "" },
	[OP_OR]  = { "", "LD Input\nOR( %IX0.1\nAND %IX0.2\n)\nST Output\n", "" },
	[OP_XOR] = { "", "LD Input\nXOR %IX0.1\nST Output\n", "" },
	[OP_NOT] = { "", "LD Input\nAND %IX0.1\nNOT\nST Output\n", "" },
	[OP_JMP] = { "", "LD Input\nJMPC Behind\nLD %IX0.1\nST Output\n"
			 "Behind: LD Input\nST %QX0.1\n", "" },
	[OP_CAL] = { "Box : TON;\n", "CAL Box(IN := Input, PT := T#2s)\nLD Box.Q\n"
				     "ST Output\n", "" },
	[OP_RET] = { "", "LD %IX0.1\nRETC\nLD Input\nST Output\n", "" },
	[OP_STP] = { "", "LD Input\nST Output\nLD %IX0.1\nSTPC\n", "" },
};

/* NULL: the example is made by rule. */
static const struct hand *find_hand(const struct words_entry *entry, bool list)
{
	if (entry->kind == WORDS_OPERATOR)
		return &of_op[entry->number];
	for (size_t i = 0; !list && i < sizeof(of_word) / sizeof(of_word[0]); i++)
		if (entry->row == word_row(of_word[i].word))
			return &of_word[i].hand;
	return NULL;
}

static bool draft(const struct words_entry *entry, bool list,
		  struct sink_memory *memory)
{
	const struct hand *hand = find_hand(entry, list);
	const struct sink sink = sink_to_memory(memory);
	struct example example = { .in_text = IEC_NONE };
	bool made;

	example.var = sink_to_memory(&example.vars);
	example.out = sink_to_memory(&example.body);
	if (hand) {
		sink_text(&example.var, hand->vars);
		sink_text(&example.out, hand->body);
	} else if (!list) {
		ladder_body(&example, entry);
	} else if (entry->kind == WORDS_FUNCTION) {
		function_list(&example, entry->row);
	} else if (entry->kind == WORDS_BLOCK) {
		block_list(&example, entry->row);
	}
	whole_file(&example, list, hand ? hand->behind : "", &sink);
	made = !memory->failed && !example.vars.failed && !example.body.failed;
	sink_memory_free(&example.vars);
	sink_memory_free(&example.body);
	return made;
}

/* Prints the example in canonical form, or its picture. */
static bool put_project(const struct project *project, enum words_form form,
			const struct sink *sink)
{
	char *text;
	size_t len;

	if (form == WORDS_AS_PICTURE)
		return show_rungs(project, 0, 0, NULL, sink) > 0;
	text = text_write(project, &len);
	if (text)
		sink_write(sink, text, len);
	free(text);
	return text != NULL;
}

static bool read_draft(struct project *project, const struct sink_memory *draft)
{
	struct diag_list *diags = malloc(sizeof(*diags)); /* 10 KB */
	bool good;

	if (!diags)
		return false;
	diag_init(diags);
	good = text_read(project, "example.rung", draft->text, draft->len, NULL,
			 diags);
	free(diags);
	return good;
}

bool words_example(const struct words_entry *entry, enum words_form form,
		   const struct sink *sink)
{
	struct sink_memory memory;
	struct project *project;
	bool made = false;

	if (!has_form(entry, form))
		return false;
	sink_memory_init(&memory);
	project = project_new("example.rung");
	if (project && draft(entry, form == WORDS_AS_LIST, &memory) &&
	    read_draft(project, &memory))
		made = put_project(project, form, sink);
	project_free(project);
	sink_memory_free(&memory);
	return made;
}
