/* SPDX-License-Identifier: MIT
 *
 * expect - the words of the catalogue, the project and a POU, by what is wanted.
 */
#include "engine/check/expect.h"

#include "engine/check/st_place.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/lex.h"
#include "engine/model/fbd.h"
#include "engine/model/dialect.h"
#include "engine/base/name.h"
#include "engine/base/nearest.h"
#include "engine/model/convert.h"
#include "engine/model/named.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TOKENS_MOST 128

/* The tokens of one instruction or cell before the cursor, without the word that is
 * being written. */
struct before {
	struct scope *scope;
	const struct pou *pou;
	struct token token[TOKENS_MOST];
	int count;
	struct st_place st; /* in Structured Text                              */
	bool boxed;         /* in an EXECUTE box                               */
};

struct offer {
	const struct project *project;
	const struct pou *pou;
	const struct expect_want *want;
	const struct expect_taker *taker;
};

static void give(const struct offer *o, enum expect_kind kind, const char *text,
		 const char *note)
{
	struct expect_word word = { .kind = kind, .text = text,
				    .note = note ? note : "" };

	if (*text)
		o->taker->take(o->taker->context, &word);
}

static void give_operator(const struct offer *o, enum op op, const char *text)
{
	struct expect_word word = { .kind = EXPECT_OPERATOR, .text = text, .op = op };

	o->taker->take(o->taker->context, &word);
}

static void give_row(const struct offer *o, enum expect_kind kind,
		     const struct word_row *row)
{
	struct expect_word word = { .kind = kind, .text = row->word, .row = row };

	if (*row->word)
		o->taker->take(o->taker->context, &word);
}

/* ---- words of the catalogue ---- */

static void offer_keywords(const struct offer *o)
{
	static const char *const outside[] = {
		"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "SUBROUTINE", "VAR",
		"VAR_GLOBAL", "TYPE", "CONFIGURATION", "INCLUDE", "USES", "VIEW",
		"PROJECT",
	};
	static const char *const inside[] = { "VAR", "VAR_TEMP" };
	static const char *const called[] = { "VAR_INPUT", "VAR_OUTPUT",
					      "VAR_IN_OUT" };
	const char *const *words = o->want->words;

	for (; words && *words; words++)
		give(o, EXPECT_KEYWORD, *words, "");
	if (o->want->words)
		return;
	for (size_t i = 0; !o->pou && i < sizeof(outside) / sizeof(*outside); i++)
		give(o, EXPECT_KEYWORD, outside[i], "");
	if (!o->pou)
		return;
	for (size_t i = 0; i < sizeof(inside) / sizeof(*inside); i++)
		give(o, EXPECT_KEYWORD, inside[i], "");
	for (size_t i = 0; pou_has_frame(o->pou) && i < 3; i++)
		give(o, EXPECT_KEYWORD, called[i], "");
	if (o->pou->language != LANGUAGE_IL)
		give(o, EXPECT_KEYWORD, "RUNG", "");
	for (int i = 0; o->pou->sfc && sfc_word(i); i++)
		give(o, EXPECT_KEYWORD, sfc_word(i)->word, "");
	give(o, EXPECT_KEYWORD, o->pou->kind == POU_PROGRAM ? "END_PROGRAM" :
	     o->pou->kind == POU_FUNCTION ? "END_FUNCTION" :
	     o->pou->kind == POU_BLOCK ? "END_FUNCTION_BLOCK" : "END_SUBROUTINE", "");
}

/* JMP has C and CN, AND has N and (. */
static void offer_operators(const struct offer *o)
{
	for (int i = 0; i < OP_COUNT; i++) {
		const struct op_row *row = op_row((enum op)i);
		static const char *const ends[] = { "N", "C", "CN", "(", "N(" };
		bool c = row->modifiers & MOD_C, n = row->modifiers & MOD_N;
		bool open = row->modifiers & MOD_PAREN;
		const bool may[] = { n && !c, c, c && n, open, open && n };
		char text[16];

		give_operator(o, (enum op)i, row->word);
		for (size_t k = 0; k < sizeof(may) / sizeof(*may); k++) {
			snprintf(text, sizeof(text), "%s%s", row->word, ends[k]);
			if (may[k])
				give_operator(o, (enum op)i, text);
		}
	}
}

static void offer_row(const struct offer *o, const struct word_row *row)
{
	bool element = row->kind == WORD_ELEM && row->place != PLACE_NONE &&
		       row->operand != OPND_EXPR && row->operand != OPND_ASSIGN;

	if (row->kind == WORD_FN && o->want->kinds & EXPECT_FUNCTION &&
	    (o->want->boxes || word_operator(row) == OP_COUNT))
		give_row(o, EXPECT_FUNCTION, row);
	if (row->kind == WORD_FB && o->want->kinds & EXPECT_BLOCK)
		give_row(o, EXPECT_BLOCK, row);
	if (row->kind == WORD_STRUCT && o->want->kinds & EXPECT_TYPE && strcmp(row->word, "STRUCT") != 0)
		give(o, EXPECT_TYPE, row->word, "structure");
	if (element && o->want->kinds & EXPECT_ELEMENT)
		give_row(o, EXPECT_ELEMENT, row);
}

static void offer_words(const struct offer *o)
{
	const struct word_table *words = &o->project->words;

	for (int i = 0; i < WORD_COUNT; i++)
		offer_row(o, word_row((enum word)i));
	for (int i = 0; i < words->count; i++)
		offer_row(o, words->row[i]);
}

/* ---- words made by rule ---- */

/* Names of types that stand in such words beside those of the rows. */
static const char *type_name(int index)
{
	static const char *const other[] = { "TOD", "DT", "LTIME", "LTOD", "LDATE",
					     "LDT" };
	int rows = IEC_TYPE_COUNT - IEC_NONE - 1, others = sizeof(other) / sizeof(*other);

	if (index < rows)
		return iec_type_row((enum iec_type)(IEC_NONE + 1 + index))->word;
	return index < rows + others ? other[index - rows] : NULL;
}

/* Is the token `INT_`, with or without more letters? */
static bool is_begun(const struct offer *o, const char *first)
{
	const char *begun = o->want->begun;
	size_t len = strlen(first), has = o->want->begun_len;

	if (!begun || !memchr(begun, '_', has))
		return false;
	return ascii_same(begun, first, len < has ? len : has) &&
	       (len >= has || begun[len] == '_');
}

/* INT_TO_REAL, INT_TO_TIME … with @from and @infix before a type. */
static void offer_towards(const struct offer *o, const char *from, const char *infix)
{
	struct convert_word made;
	const char *to;
	char text[48];

	for (int i = 0; (to = type_name(i)) != NULL; i++) {
		snprintf(text, sizeof(text), "%s%s%s", from, infix, to);
		struct expect_word word = { .kind = EXPECT_FUNCTION, .text = text };

		if (!convert_make(text, strlen(text), &made))
			continue;
		word.row = word_row(made.row.runs);
		o->taker->take(o->taker->context, &word);
	}
}

static void offer_made(const struct offer *o)
{
	static const char *const infix[] = { "_TO_", "_TRUNC_", "_BCD_TO_", "_TO_BCD_" };
	const char *from;

	for (int i = 0; (from = type_name(i)) != NULL; i++)
		for (size_t k = 0; is_begun(o, from) && k < sizeof(infix) / sizeof(*infix);
		     k++)
			offer_towards(o, from, infix[k]);
	for (size_t k = 0; k < sizeof(infix) / sizeof(*infix); k++)
		if (is_begun(o, k == 1 ? "TRUNC" : k == 2 ? "BCD" : "TO"))
			offer_towards(o, "", infix[k] + 1);
}

static void offer_types(const struct offer *o)
{
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++)
		give(o, EXPECT_TYPE, iec_type_row((enum iec_type)i)->word, "");
}

/* ---- names ---- */

static const char *type_text(const struct offer *o, enum iec_type type, enum word word)
{
	return type != IEC_NONE ? iec_type_row(type)->word :
				  words_row(&o->project->words, word)->word;
}

static bool is_class(const struct offer *o, enum iec_type type)
{
	return !o->want->classes ||
	       (type != IEC_NONE && iec_type_row(type)->class & o->want->classes);
}

static bool is_instance(const struct offer *o, const struct var *var)
{
	return var->type == IEC_NONE &&
	       words_row(&o->project->words, var->fb)->kind == WORD_FB;
}

static bool may_write(const struct var *var, uint16_t flags)
{
	return !(flags & (VAR_CONSTANT | VAR_INPUT)) &&
	       (var->at.area == AREA_NONE ||
		iec_area_row(var->at.area)->access == ACCESS_WRITE);
}

static void offer_var(const struct offer *o, const struct var *var, uint16_t flags)
{
	const char *name = project_text(o->project, var->name);
	unsigned int kinds = o->want->kinds;

	/* An instance or structure is offered because a dot may follow. */
	if (is_instance(o, var)) {
		if (kinds & EXPECT_INSTANCE ?
		    o->want->block == WORD_COUNT || o->want->block == var->fb :
		    (kinds & EXPECT_VARIABLE) && !o->want->write)
			give(o, EXPECT_INSTANCE, name,
			     type_text(o, var->type, var->fb));
		return;
	}
	if (!(kinds & EXPECT_VARIABLE) || (o->want->write && !may_write(var, flags)))
		return;
	/* Fill.X can only be read, TRANSITION only be written. */
	if (flags & VAR_WIRE)
		return; /* of networks, in which it has another name */
	if (flags & VAR_SFC && o->want->write == (strchr(name, '.') != NULL))
		return;
	if (var->type == IEC_NONE || is_class(o, var->type))
		give(o, EXPECT_VARIABLE, name, var->named ?
		     project_text(o->project, o->project->named[var->named - 1].name) :
		     type_text(o, var->type, var->fb));
}

static void offer_table(const struct offer *o, const struct var_table *table)
{
	for (int b = 0; b < table->block_count; b++) {
		const struct var_block *block = &table->block[b];

		for (int i = 0; i < block->count; i++)
			offer_var(o, &table->var[block->first + i], block->flags);
	}
}

static void offer_system(const struct offer *o)
{
	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (is_class(o, row->type))
			give(o, EXPECT_VARIABLE, row->name,
			     iec_type_row(row->type)->word);
	}
}

static void offer_labels(const struct offer *o)
{
	const struct pou *pou = o->pou;

	for (int i = 0; pou && i < pou->rung_count; i++)
		give(o, EXPECT_LABEL, project_text(o->project, pou->rung[i]->label),
		     project_text(o->project, pou->rung[i]->title));
	for (int i = 0; pou && pou->fbd && i < pou->fbd->count; i++)
		if (pou->fbd->network[i].label)
			give(o, EXPECT_LABEL, project_text(o->project, pou->fbd->network[i].label),
			     project_text(o->project, pou->fbd->network[i].title));
	for (int i = 0; pou && i < pou->il.count; i++)
		if (pou->il.line[i].kind == IL_LABEL)
			give(o, EXPECT_LABEL,
			     project_text(o->project, pou->il.line[i].operand), "");
}

static void offer_sfc(const struct offer *o)
{
	const struct sfc *sfc = o->pou ? o->pou->sfc : NULL;
	unsigned int kinds = o->want->kinds;

	for (int i = 0; sfc && kinds & EXPECT_STEP && i < sfc->step_count; i++)
		give(o, EXPECT_STEP, project_text(o->project, sfc->step[i].name), "");
	for (int i = 0; sfc && kinds & EXPECT_ACTION && i < sfc->action_count; i++)
		give(o, EXPECT_ACTION, project_text(o->project, sfc->action[i].name), "");
	for (int i = 0; kinds & EXPECT_QUALIFIER && i < QUALIFIER_COUNT; i++)
		give(o, EXPECT_QUALIFIER, qualifier_word((enum qualifier)i), "");
	if (kinds & EXPECT_STEP_PART) {
		give(o, EXPECT_STEP_PART, "X", "BOOL");
		give(o, EXPECT_STEP_PART, "T", "TIME");
	}
}

/* Its name, with the type before it where another value of the project has this name too. */
static void offer_value(const struct offer *o, const struct enum_value *value)
{
	const struct project *project = o->project;
	const uint32_t type = project->enumeration[value->enumeration].name;
	bool alone = true;
	char text[2 * LIMIT_NAME + 2];

	for (int i = 0; i < project->enum_value_count; i++)
		alone = alone && (&project->enum_value[i] == value ||
				  project->enum_value[i].fold != value->fold);
	snprintf(text, sizeof(text), "%s%s%s", alone || !type ? "" : project_text(project, type),
		 alone || !type ? "" : "#", project_text(project, value->name));
	give(o, EXPECT_VALUE, o->want->marks ? project_text(project, value->name) : text,
	     type ? project_text(project, type) : "");
}

static void offer_values(const struct offer *o)
{
	for (int i = 0; i < o->project->enum_value_count; i++)
		if (o->want->enumeration < 0 ||
		    o->project->enum_value[i].enumeration == o->want->enumeration)
			offer_value(o, &o->project->enum_value[i]);
}

static void offer_routines(const struct offer *o)
{
	for (int i = 0; i < o->project->pou_count; i++)
		if (o->project->pou[i].kind == POU_SUBROUTINE)
			give(o, EXPECT_SUBROUTINE,
			     project_text(o->project, o->project->pou[i].name), "");
}

/* "PT := " and "Q => ", as an argument begins. */
static void give_argument(const struct offer *o, const struct expect_word *pin)
{
	struct expect_word word = *pin;
	char text[LIMIT_NAME + 8];

	snprintf(text, sizeof(text), "%s %s ", pin->text,
		 pin->row->kind == WORD_FB && pin->row->pin[pin->pin].dir == PIN_OUT ? "=>" : ":=");
	word.text = text;
	o->taker->take(o->taker->context, &word);
}

static void offer_pins(const struct offer *o)
{
	const struct word_row *row = o->want->row;
	unsigned int dirs = o->want->dirs;

	for (int i = 0; row && i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const struct expect_word word = {
			.kind = EXPECT_PIN, .text = pin->name, .row = row, .pin = i };

		if (pin->dir == PIN_VAR || pin->dir == PIN_NONE || !pin->name ||
		    (dirs && !(dirs & 1u << pin->dir)) ||
		    (pin->type != IEC_NONE && !is_class(o, pin->type)))
			continue;
		if (*pin->name && o->want->marks)
			give_argument(o, &word);
		else if (*pin->name)
			o->taker->take(o->taker->context, &word);
	}
	if (o->want->marks || !row || row->kind != WORD_FN || !o->want->call)
		return;
	give(o, EXPECT_PIN, "EN", "BOOL");
	give(o, EXPECT_PIN, "ENO", "BOOL");
	give(o, EXPECT_PIN, "OUT", "");
}

/* Bits and bytes of a number; bits as %X3 only behind a %. */
static void offer_number(const struct offer *o)
{
	static const enum iec_type type[] = { [1] = IEC_BOOL, [8] = IEC_BYTE, [16] = IEC_WORD, [32] = IEC_DWORD };
	const bool percent = o->want->begun_len && *o->want->begun == '%';
	char text[8];
	unsigned int bits;

	for (int i = 0; (bits = expr_part_print(o->want->bits, percent, i, text, sizeof(text))) > 0; i++)
		if (is_class(o, type[bits]))
			give(o, EXPECT_PART, text, iec_type_row(type[bits])->word);
}

void expect_offer(const struct project *project, const struct pou *pou,
		  const struct expect_want *want, const struct expect_taker *taker)
{
	const struct offer o = { project, pou, want, taker };

	if (want->kinds & EXPECT_KEYWORD)
		offer_keywords(&o);
	if (want->kinds & EXPECT_OPERATOR)
		offer_operators(&o);
	if (want->kinds & EXPECT_TYPE)
		offer_types(&o);
	if (want->kinds & (EXPECT_FUNCTION | EXPECT_BLOCK | EXPECT_ELEMENT | EXPECT_TYPE))
		offer_words(&o);
	if (want->kinds & EXPECT_FUNCTION)
		offer_made(&o);
	if (want->kinds & (EXPECT_VARIABLE | EXPECT_INSTANCE) && pou)
		offer_table(&o, &pou->vars);
	if (want->kinds & (EXPECT_VARIABLE | EXPECT_INSTANCE))
		offer_table(&o, &o.project->globals);
	if (want->kinds & EXPECT_VARIABLE && !want->write)
		offer_system(&o);
	if (want->kinds & EXPECT_CONSTANT) {
		give(&o, EXPECT_CONSTANT, "TRUE", "BOOL");
		give(&o, EXPECT_CONSTANT, "FALSE", "BOOL");
	}
	if (want->kinds & EXPECT_LABEL)
		offer_labels(&o);
	if (want->kinds & EXPECT_SUBROUTINE)
		offer_routines(&o);
	if (want->kinds & (EXPECT_STEP | EXPECT_ACTION | EXPECT_QUALIFIER |
			   EXPECT_STEP_PART))
		offer_sfc(&o);
	if (want->kinds & EXPECT_PIN)
		offer_pins(&o);
	if (want->kinds & EXPECT_VALUE)
		offer_values(&o);
	if (want->kinds & EXPECT_PART)
		offer_number(&o);
}

void expect_functions(const struct project *project, const char *begun, size_t len,
		      const struct expect_taker *taker)
{
	const struct expect_want want = { .kinds = EXPECT_FUNCTION, .block = WORD_COUNT,
					  .boxes = true, .begun = begun,
					  .begun_len = len };
	const struct offer o = { project, NULL, &want, taker };

	offer_words(&o);
	offer_made(&o);
}

const char *expect_note(const struct expect_word *word)
{
	if (word->note)
		return word->note;
	if (word->kind == EXPECT_OPERATOR)
		return explain_op(word->op);
	if (word->kind != EXPECT_PIN)
		return explain_word(word->row);
	if (word->row->pin[word->pin].type != IEC_NONE)
		return iec_type_row(word->row->pin[word->pin].type)->word;
	return explain_pin(word->row, word->pin);
}

const char *expect_kind_text(enum expect_kind kind)
{
	switch (kind) {
	case EXPECT_KEYWORD:
		return "keyword";
	case EXPECT_OPERATOR:
		return "operator";
	case EXPECT_FUNCTION:
		return "function";
	case EXPECT_BLOCK:
		return "function block";
	case EXPECT_ELEMENT:
		return "element";
	case EXPECT_INSTANCE:
		return "instance";
	case EXPECT_SUBROUTINE:
		return "subroutine";
	case EXPECT_LABEL:
		return "label";
	case EXPECT_VARIABLE:
		return "variable";
	case EXPECT_PIN:
		return "pin";
	case EXPECT_TYPE:
		return "type";
	case EXPECT_CONSTANT:
		return "constant";
	case EXPECT_STEP:
		return "step";
	case EXPECT_ACTION:
		return "action";
	case EXPECT_QUALIFIER:
		return "qualifier";
	case EXPECT_STEP_PART:
		return "part of a step";
	case EXPECT_VALUE:
		return "value";
	case EXPECT_PART:
		return "part of a number";
	}
	return "";
}

/* A word made by rule lives only while it is offered; keep a copy. */
static bool stays(const struct expect_word *word)
{
	if (word->kind == EXPECT_OPERATOR)
		return word->text == op_row(word->op)->word;
	if (word->kind == EXPECT_VALUE || word->kind == EXPECT_PART)
		return false;
	return word->kind != EXPECT_FUNCTION || word->text == word->row->word;
}

static void take_nearest(void *context, const struct expect_word *word)
{
	if (stays(word))
		nearest_offer(context, word->text);
}

/* What another tool calls so: an address is suggested, anything else must be declared. */
static enum diag_id say_dialect(const char *wanted, char *out, size_t size)
{
	struct dialect found;
	char addr[40], other[40] = "";

	if (dialect_is_data_block(wanted, strlen(wanted))) {
		snprintf(out, size, "%s", wanted);
		return DIAG_DATA_BLOCK;
	}
	if (!dialect_find(wanted, strlen(wanted), 0, &found))
		return DIAG_COUNT;
	iec_addr_print(found.addr, addr, sizeof(addr));
	if (found.kind == DIALECT_UNSURE)
		iec_addr_print(found.other, other, sizeof(other));
	if (found.kind == DIALECT_ADDRESS || found.kind == DIALECT_UNSURE) {
		snprintf(out, size, "%s" DIAG_AND "%s%s%s", wanted, addr, *other ? ", " : "", other);
		return DIAG_COUNT;
	}
	if (found.kind == DIALECT_STEP)
		return DIAG_COUNT;
	if (found.kind == DIALECT_WORD)
		snprintf(out, size, "%s" DIAG_AND "%s AT %s : %s;", wanted, found.name, addr,
			 iec_type_row(found.type)->word);
	else
		snprintf(out, size, "%s" DIAG_AND "%s : %s;%s%s%s", wanted, found.name, found.word,
			 found.kind == DIALECT_BLOCK ? DIAG_AND : "",
			 found.kind == DIALECT_BLOCK ? found.name : "",
			 found.kind == DIALECT_BLOCK ? ".Q" : "");
	return DIAG_AS_ELSEWHERE;
}

/* What members of timers and counters are called elsewhere: in Logix, STEP 7, GX Works, ClassicLadder. The
 * first of `to` that the block has is meant. */
static const struct {
	const char *from, *to[4];
} members[] = {
	{ "DN", { "Q", "QU" } }, { "DONE", { "Q", "QU" } }, { "D", { "Q", "QU" } }, { "OUT", { "Q", "QU" } },
	{ "OUTPUT", { "Q", "QU" } }, { "CONTACT", { "Q", "QU" } }, { "Q0", { "Q", "QU" } }, { "Q", { "QU" } },
	{ "EN", { "IN", "CU", "CD" } }, { "ENABLE", { "IN", "CU", "CD" } }, { "IN", { "CU", "CD" } },
	{ "INPUT", { "IN", "CU", "CD" } }, { "CU", { "IN", "CD" } }, { "UP", { "CU" } }, { "DOWN", { "CD" } },
	{ "ACC", { "ET", "CV" } }, { "ACCUM", { "ET", "CV" } }, { "CURRENT", { "ET", "CV" } }, { "V", { "ET", "CV" } },
	{ "ELAPSED", { "ET" } }, { "VALUE", { "ET", "CV" } }, { "VAL", { "ET", "CV" } }, { "COUNT", { "CV" } },
	{ "CNT", { "CV" } }, { "ET", { "CV" } }, { "CV", { "ET" } }, { "PRE", { "PT", "PV" } },
	{ "PRESET", { "PT", "PV" } }, { "P", { "PT", "PV" } }, { "SP", { "PT", "PV" } }, { "PT", { "PV" } },
	{ "PV", { "PT" } }, { "RES", { "R" } }, { "RESET", { "R" } }, { "RST", { "R" } }, { "CLEAR", { "R" } },
	{ "LOAD", { "LD" } },
};

/* The bit of Logix that is TRUE while a timer runs; NULL: no timer of these. */
static const char *timing_of(const char *block)
{
	return ascii_same(block, "TOF", 4) ? "%.*s.Q AND NOT %.*s.IN" :
	       ascii_same(block, "TON", 4) ? "%.*s.IN AND NOT %.*s.Q" : NULL;
}

/* Behind @path, "Delay.DN" of the block @row: the member that is meant, "Delay.Q", if one is near. */
static void near_member(const struct word_row *row, const char *path, const char *name, char *out, size_t size)
{
	const char *timing = row->kind == WORD_FB && ascii_is("TT", name, strlen(name)) ? timing_of(row->word) : NULL;
	const int len = (int)(name - path) - 1;
	struct nearest nearest;
	const char *found = NULL;
	char made[2 * LIMIT_ARG] = "";

	for (size_t i = 0; row->kind == WORD_FB && !found && i < sizeof(members) / sizeof(*members); i++)
		for (int k = 0; ascii_is(members[i].from, name, strlen(name)) && members[i].to[k] && !found; k++)
			if (word_pin_find(row, members[i].to[k], strlen(members[i].to[k])) >= 0)
				found = members[i].to[k];
	nearest_init(&nearest, name, strlen(name));
	for (int i = 0; !found && i < row->pin_count; i++)
		if (word_pins(row)[i].dir != PIN_VAR)
			nearest_offer(&nearest, word_pins(row)[i].name);
	if (!found && nearest.count)
		found = nearest.word[0].text;
	if (timing && len < LIMIT_ARG / 3)
		snprintf(made, sizeof(made), timing, len, path, len, path);
	else if (found && len < LIMIT_ARG)
		snprintf(made, sizeof(made), "%.*s.%s", len, path, found);
	snprintf(out, size, "%.60s%s%s", path, *made ? DIAG_AND : "", strlen(made) < LIMIT_ARG ? made : "");
}

/* The same of `Delay.DN` and `Delays[2].DN`; other paths have no suggestion. */
static void find_member(const struct project *project, const struct pou *pou, const char *path, char *out, size_t size)
{
	const char *dot = strrchr(path, '.');
	const size_t len = strcspn(path, ".[");
	const struct var_table *tables[] = { pou ? &pou->vars : &project->globals, &project->globals };
	const uint32_t name = names_find_any(&project->names, path, len);

	snprintf(out, size, "%.60s", path);
	if (!name || strchr(path, '.') != dot)
		return;
	for (int i = 0; i < 2; i++) {
		const int at = vars_find(tables[i], names_fold(&project->names, name));

		if (at < 0)
			continue;
		if (tables[i]->var[at].type == IEC_NONE)
			near_member(words_row(&project->words, tables[i]->var[at].fb), path, dot + 1, out, size);
		return;
	}
}

enum diag_id expect_nearest(const struct project *project, const struct pou *pou,
			    unsigned int kinds, const char *wanted, char *out, size_t size)
{
	struct nearest nearest;
	const struct expect_taker taker = { take_nearest, &nearest };
	const struct expect_want want = { .kinds = kinds, .block = WORD_COUNT,
					  .begun = wanted, .begun_len = strlen(wanted) };

	if (kinds & EXPECT_PIN && strchr(wanted, '.')) {
		find_member(project, pou, wanted, out, size);
		return DIAG_COUNT;
	}
	nearest_init(&nearest, wanted, strlen(wanted));
	expect_offer(project, pou, &want, &taker);
	nearest_print(&nearest, out, size);
	return nearest.count == 0 && kinds & EXPECT_VARIABLE ? say_dialect(wanted, out, size) :
							       DIAG_COUNT;
}

static struct names *names_of(struct scope *scope)
{
	return &scope_project(scope)->names;
}

static bool is_name_byte(char c)
{
	return ascii_digit(c) || c == '_' || c == '.' || (unsigned char)c >= 128 ||
	       (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z');
}

/* expect_value, expect_write - a value of these classes, a variable that is written. */
static struct expect_want expect_value(uint16_t classes)
{
	struct expect_want want = { .kinds = EXPECT_VARIABLE, .classes = classes,
				    .block = WORD_COUNT };

	if (!classes || classes & CLASS_BOOL)
		want.kinds |= EXPECT_CONSTANT;
	return want;
}

static struct expect_want expect_write(uint16_t classes)
{
	return (struct expect_want){ .kinds = EXPECT_VARIABLE, .classes = classes,
				     .write = true, .block = WORD_COUNT };
}

static const struct meaning *meaning_of(const struct before *b, const char *text,
					size_t len)
{
	uint32_t id = names_intern(names_of(b->scope), text, len);
	enum diag_id why;

	return scope_find(b->scope, b->pou, id, &why);
}

/* The block of an instance that a token names; NULL: none. */
static const struct word_row *row_of_instance(const struct before *b,
					      const struct token *token)
{
	const struct meaning *m = meaning_of(b, token->text, token->len);

	return m && m->kind == MEANING_INSTANCE ? scope_row(b->scope, m->word) : NULL;
}

static uint16_t pin_classes(const struct word_row *row, const struct token *pin)
{
	int index = row ? word_pin_find(row, pin->text, pin->len) : -1;

	if (index < 0 || index >= row->pin_count)
		return st_is(pin, "EN") || st_is(pin, "ENO") ? CLASS_BOOL : 0;
	return row->pin[index].type != IEC_NONE ?
	       iec_type_row(row->pin[index].type)->class : row->pin[index].classes;
}

/* Parameters from token @at on: a pin, or a value for one. */
static struct expect_want parameter_want(const struct before *b, int at,
					 const struct word_row *row)
{
	const struct token *last = &b->token[b->count - 1];

	if (b->count - at >= 2 && st_is(last, ":="))
		return expect_value(pin_classes(row, last - 1));
	if (b->count - at >= 2 && st_is(last, "=>"))
		return expect_write(pin_classes(row, last - 1));
	return (struct expect_want){ .kinds = EXPECT_PIN, .row = row, .call = true,
				     .block = WORD_COUNT };
}

/* ---- an instruction ---- */

static struct expect_want operator_want(const struct before *b, int at, enum op op)
{
	const struct op_row *row = op_row(op);
	bool more = b->count - at > 1;

	if (op == OP_CAL && b->count - at >= 3)
		return parameter_want(b, at + 3,
				      row_of_instance(b, &b->token[at + 1]));
	if (row->operand == OPND_LABEL && !more)
		return (struct expect_want){ .kinds = EXPECT_LABEL,
					     .block = WORD_COUNT };
	if (row->operand == OPND_INSTANCE && !more)
		return (struct expect_want){
			.kinds = EXPECT_INSTANCE | EXPECT_SUBROUTINE,
			.block = WORD_COUNT };
	if (row->operand == OPND_BOOL_W && !more)
		return expect_write(CLASS_BOOL);
	if (row->operand == OPND_ANY_W && !more)
		return expect_write(0);
	if (row->operand == OPND_NONE || (more && !st_is(&b->token[at + 1], "(")))
		return (struct expect_want){ .block = WORD_COUNT };
	return expect_value(word_operator(word_row(op_function(op))) == op ? ANY_BIT : 0);
}

/* ANDN is AND, JMPCN is JMP. */
static enum op find_op(const struct token *token)
{
	size_t len = token->len;
	enum op op = op_find(token->text, len);

	if (op == OP_COUNT && len > 1 && ascii_upper(token->text[len - 1]) == 'N')
		op = op_find(token->text, --len);
	if (op == OP_COUNT && len > 1 && ascii_upper(token->text[len - 1]) == 'C')
		op = op_find(token->text, --len);
	return op;
}

static bool has_parameters(const struct before *b, int at)
{
	for (int i = at; i < b->count; i++)
		if (st_is(&b->token[i], ":=") || st_is(&b->token[i], "=>"))
			return true;
	return false;
}

/* expect_list, expect_cell - behind these words of an instruction, of a cell. */
static struct expect_want expect_list(const struct before *b)
{
	struct word_table *words = &scope_project(b->scope)->words;
	const struct word_row *row;
	struct expect_want want = expect_value(0);
	int at = b->count >= 2 && st_is(&b->token[1], ":") ? 2 : 0;
	enum op op;

	if (b->count == at)
		return (struct expect_want){
			.kinds = EXPECT_OPERATOR | EXPECT_FUNCTION |
				 (at ? 0u : (unsigned)EXPECT_KEYWORD),
			.block = WORD_COUNT };
	op = find_op(&b->token[at]);
	if (op != OP_COUNT && !(op_function(op) != WORD_COUNT &&
				has_parameters(b, at)))
		return operator_want(b, at, op);
	row = words_row(words, words_find(words, b->token[at].text, b->token[at].len));
	if (row->kind != WORD_FN)
		return (struct expect_want){ .block = WORD_COUNT };
	if (b->count - at >= 2 && st_is(&b->token[at + 1], "(")) {
		struct expect_want pins = parameter_want(b, at + 2, row);

		if (b->count - at == 2 && word_opens(row))
			pins.kinds |= EXPECT_VARIABLE;
		return pins;
	}
	if (row->pin_count > 1)
		want.classes = row->pin[1].classes;
	return want;
}

/* ---- a cell ---- */

static struct expect_want element_want(const struct before *b,
				       const struct word_row *row)
{
	bool more = b->count > 1;
	struct expect_want none = { .block = WORD_COUNT };

	switch (row->operand) {
	case OPND_BOOL_R:
		return more ? none : expect_value(CLASS_BOOL);
	case OPND_BOOL_W:
		return more ? none : expect_write(CLASS_BOOL);
	case OPND_LABEL:
		none.kinds = more ? 0 : EXPECT_LABEL;
		return none;
	case OPND_ROUTINE:
		none.kinds = more ? 0 : EXPECT_SUBROUTINE;
		return none;
	case OPND_LOOP:
		return b->count == 1 ? expect_write(ANY_INT) : expect_value(ANY_INT);
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_INSTANCE:
	case OPND_EXPR:
	case OPND_ASSIGN:
	case OPND_PIN:
	case OPND_LOOP_END:
	case OPND_EXECUTE:
	case OPND_NONE:
		return none;
	}
	return none;
}

/* Does a value end there, so that an operator must come? */
static bool expect_ends_value(const struct token *token)
{
	static const char *const words[] = { "AND", "OR", "XOR", "MOD", "NOT" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (st_is(token, words[i]))
			return false;
	return token->kind != TOKEN_SYMBOL || st_is(token, ")") ||
	       st_is(token, "]");
}

/* In brackets: values, and functions that make some. */
static struct expect_want expression_want(const struct before *b)
{
	struct expect_want want = expect_value(0);

	if (b->count > 1 && expect_ends_value(&b->token[b->count - 1]))
		return (struct expect_want){ .block = WORD_COUNT };
	want.kinds |= EXPECT_FUNCTION;
	want.boxes = true;
	return want;
}

static struct expect_want expect_cell(const struct before *b)
{
	struct word_table *words = &scope_project(b->scope)->words;
	struct expect_want want = { .block = WORD_COUNT };
	const struct word_row *row;
	enum word word;

	if (b->count == 0) {
		want.kinds = EXPECT_ELEMENT | EXPECT_FUNCTION | EXPECT_BLOCK;
		want.boxes = true;
		return want;
	}
	if (st_is(&b->token[0], "["))
		return expression_want(b);
	word = words_find(words, b->token[0].text, b->token[0].len);
	row = words_row(words, word);
	if (word == WORD_COUNT)
		return want;
	if (row->kind == WORD_FB && b->count == 1) {
		want.kinds = EXPECT_INSTANCE;
		want.block = word;
		return want;
	}
	if (row->kind == WORD_ELEM)
		return element_want(b, row);
	return parameter_want(b, row->kind == WORD_FB ? 2 : 1, row);
}

/* ---- the text before the cursor ---- */

/* Bytes [*from, to) of the cursor's instruction, cell or declaration; an instruction may begin
 * on an earlier line. */
static size_t expect_line(const char *text, size_t at)
{
	while (at > 0 && text[at - 1] != '\n')
		at--;
	return at;
}

static size_t last_byte(const char *text, size_t from, size_t to)
{
	while (to > from && (text[to - 1] == ' ' || text[to - 1] == '\t' ||
			     text[to - 1] == '\n' || text[to - 1] == '\r'))
		to--;
	return to;
}

/* Start of the statement that goes on in the line at @line. */
static size_t expect_statement(const char *text, size_t line)
{
	for (int lines = 0; line > 0 && lines < 64; lines++) {
		size_t to = last_byte(text, 0, line);

		if (to == 0 || (text[to - 1] != ',' && text[to - 1] != '('))
			break;
		line = expect_line(text, to - 1);
	}
	return line;
}

/* The words in bytes [@from, @to). */
static void expect_tokens(struct before *b, const char *text, size_t from, size_t to)
{
	struct lex lex;

	lex_init(&lex, text + from, to - from);
	while (lex_next(&lex) != TOKEN_END && b->count < TOKENS_MOST)
		b->token[b->count++] = lex.token;
}

/* The last POU that begins at or before the line, unless it has ended. */
static const struct pou *pou_at(const struct project *project, const char *text,
				size_t at, int line)
{
	const struct pou *found = NULL;
	size_t from = at;

	for (int i = 0; i < project->pou_count; i++)
		if (!project->pou[i].included && project->pou[i].line < line &&
		    (!found || project->pou[i].line > found->line))
			found = &project->pou[i];
	while (found && from > 0) { /* no END_… since then */
		size_t begin = expect_line(text, from - 1), word = begin;

		while (word < at && (text[word] == ' ' || text[word] == '\t'))
			word++;
		if (at - word > 12 && (ascii_same(text + word, "END_PROGRAM", 11) ||
				       ascii_same(text + word, "END_FUNCTION", 12) ||
				       ascii_same(text + word, "END_SUBROUTI", 12)))
			return NULL;
		if (--line <= found->line)
			break;
		from = begin;
	}
	return found;
}

/* In a VAR block, after the colon, a type is wanted. */
static bool in_vars(const char *text, size_t line)
{
	while (line > 0) {
		size_t begin = expect_line(text, line - 1), word = begin;

		while (word < line && (text[word] == ' ' || text[word] == '\t'))
			word++;
		if (line - word >= 7 && ascii_same(text + word, "END_VAR", 7))
			return false;
		if (line - word >= 4 && ascii_same(text + word, "VAR", 3) &&
		    !(is_name_byte(text[word + 3]) && text[word + 3] != '_'))
			return true;
		if (line - word >= 4 && (ascii_same(text + word, "RUNG", 4) ||
					 ascii_same(text + word, "END_", 4) ||
					 ascii_same(text + word, "PROG", 4)))
			return false;
		line = begin;
	}
	return false;
}

static struct expect_want declaration_want(const struct before *b)
{
	struct expect_want want = { .block = WORD_COUNT };

	if (b->count > 0 && st_is(&b->token[b->count - 1], ":"))
		want.kinds = EXPECT_TYPE | EXPECT_BLOCK;
	return want;
}

static bool is_step(const struct before *b, const char *word, size_t len)
{
	const struct names *names = names_of(b->scope);

	return b->pou && b->pou->sfc &&
	       sfc_find_step(b->pou->sfc, names, names_find(names, word, len)) >= 0;
}

/* `Recipes[i].Steps[2].`: where the path begins that ends with the word at @word. */
static const char *path_start(const char *text, const char *word)
{
	while (word > text && word[-1] == ']') {
		int open = 0;

		do {
			word--;
			open += *word == ']';
			open -= *word == '[';
		} while (word > text && open > 0 && *word != '\n');
		while (word > text && is_name_byte(word[-1]))
			word--;
	}
	return word;
}

/* Appends "[1,1]", the first element of @array. */
static size_t print_first(const struct meaning *array, char *out, size_t size)
{
	size_t used = 0;
	const int dims = array->dims > 1 ? array->dims : 1;

	for (int i = 0; i < dims && used < size; i++)
		used += (size_t)snprintf(out + used, size - used, "%s%" PRId32, i ? "," : "[",
					 dims > 1 ? array->dim[i].low : array->array.low);
	if (used < size)
		used += (size_t)snprintf(out + used, size - used, "]");
	return used;
}

/* What a path means, whatever its indices are: parts of all elements are the same. */
static const struct meaning *meaning_of_path(const struct before *b, const char *path, size_t len)
{
	const struct meaning *m = meaning_of(b, path, len);
	char plain[2 * LIMIT_NAME];
	size_t used = 0;

	for (size_t i = 0; !m && i < len && used + 1 < sizeof(plain); i++) {
		const struct meaning *array;
		int open = 0;

		if (path[i] != '[') {
			plain[used++] = path[i];
			continue;
		}
		array = meaning_of(b, plain, used);
		if (!array || array->kind != MEANING_ARRAY)
			return NULL;
		used += print_first(array, plain + used, sizeof(plain) - used);
		for (; i < len && (open += (path[i] == '[') - (path[i] == ']')) > 0; i++)
			;
	}
	return m || used + 1 >= sizeof(plain) ? m : meaning_of(b, plain, used);
}

/* The values of the enumeration of this name. */
static bool values_want(const struct before *b, const char *type, size_t len,
			struct expect_want *want)
{
	const struct project *project = scope_project(b->scope);
	const int found = named_find(project, names_fold(names_of(b->scope),
				     names_intern(names_of(b->scope), type, len)));
	const struct var *like = found < 0 ? NULL : project->named[found].like.var;

	if (!like || !like->enumeration)
		return false;
	*want = (struct expect_want){ .kinds = EXPECT_VALUE, .block = WORD_COUNT, .marks = true,
				      .enumeration = like->enumeration - 1 };
	return true;
}

/* `Delay.`: the word under the cursor is a part of the variable before the dot. */
static bool part_want(const struct before *b, const char *text, const char *word, size_t *len,
		      struct expect_want *want, const char **prefix)
{
	const char *dot = NULL;
	const struct meaning *m;
	bool write = want->write;

	for (size_t i = 0; i < *len; i++)
		if (word[i] == '.')
			dot = word + i;
	if (!dot)
		return true;
	*len -= (size_t)(dot + 1 - word);
	*prefix = dot + 1;
	word = path_start(text, word);
	m = meaning_of_path(b, word, (size_t)(dot - word));
	if (!m && is_step(b, word, (size_t)(dot - word))) {
		*want = (struct expect_want){ .kinds = write ? 0 : EXPECT_STEP_PART,
					      .block = WORD_COUNT };
		return true;
	}
	if (!m && !write && values_want(b, word, (size_t)(dot - word), want))
		return true;
	if (m && meaning_fault(m) == DIAG_COUNT && m->kind != MEANING_LITERAL &&
	    iec_type_row(m->type)->class & (ANY_INT | CLASS_BITS)) {
		*want = (struct expect_want){ .kinds = write && !m->writable ? 0 : EXPECT_PART,
					      .classes = want->classes, .block = WORD_COUNT,
					      .bits = 8u * iec_type_row(m->type)->size };
		return true;
	}
	if (!m || (m->kind != MEANING_INSTANCE && m->kind != MEANING_STRUCT))
		return false;
	*want = (struct expect_want){ .kinds = EXPECT_PIN, .classes = want->classes,
				      .row = scope_row(b->scope, m->word),
				      .block = WORD_COUNT };
	if (write && m->kind == MEANING_INSTANCE)
		want->dirs = 1u << PIN_IN;
	return true;
}

static bool offset_of(const char *text, size_t len, int line, int column, size_t *out)
{
	size_t at = 0, end;

	for (int i = 1; i < line; i++) {
		const char *newline = memchr(text + at, '\n', len - at);

		if (!newline)
			return false;
		at = (size_t)(newline - text) + 1;
	}
	for (end = at; end < len && text[end] != '\n'; end++)
		;
	if (line < 1 || column < 1 || (size_t)column - 1 > end - at)
		return false;
	*out = at + (size_t)column - 1;
	return true;
}

enum inside { OUTSIDE, IN_STEP, IN_BODY };

/* Does the line at @at begin with this word? */
static bool begins(const char *text, size_t at, size_t end, const char *word)
{
	const size_t len = strlen(word);

	while (at < end && (text[at] == ' ' || text[at] == '\t'))
		at++;
	return end - at >= len && ascii_same(text + at, word, len) &&
	       (end - at == len || strchr(" \t(:;\r", text[at + len]));
}

static bool ends_with(const char *text, size_t at, size_t end, const char *word)
{
	const size_t len = strlen(word);

	while (end > at && strchr(" \t\r", text[end - 1]))
		end--;
	return end - at >= len && ascii_same(text + end - len, word, len);
}

/* The body that a word of a chart begins; -1: neither begins nor ends one. */
static int inside_word(const struct sfc_word *word)
{
	switch (word->kind) {
	case SFC_WORD_STEP:
		return IN_STEP;
	case SFC_WORD_TRANSITION:
	case SFC_WORD_ACTION:
		return IN_BODY;
	case SFC_WORD_CONTROL:
	case SFC_WORD_END:
		return OUTSIDE;
	case SFC_WORD_SETTING:
		break;
	}
	return -1;
}

/* Does a word that ends a body end this line? */
static bool ends_body(const char *text, size_t at, size_t end)
{
	const struct sfc_word *word;

	for (int i = 0; (word = sfc_word(i)); i++)
		if (word->kind == SFC_WORD_END && ends_with(text, at, end, word->word))
			return true;
	return false;
}

/* The body that a line begins; -1: the line begins none. */
static int inside_of(const char *text, size_t at, size_t end)
{
	const struct sfc_word *word;
	int in = begins(text, at, end, "END_VAR") || begins(text, at, end, "PROGRAM") ?
		OUTSIDE : -1;

	for (int i = 0; in < 0 && (word = sfc_word(i)); i++)
		if (begins(text, at, end, word->word))
			in = inside_word(word);
	return in > OUTSIDE && ends_body(text, at, end) ? OUTSIDE : in;
}

static enum inside inside_at(const char *text, size_t line)
{
	while (line > 0) {
		const size_t end = line - 1, at = expect_line(text, end);
		const int in = inside_of(text, at, end);

		if (in >= 0)
			return (enum inside)in;
		line = at;
	}
	return OUTSIDE;
}

/* ---- heads ---- */

static struct expect_want kinds_want(unsigned int kinds)
{
	return (struct expect_want){ .kinds = kinds, .block = WORD_COUNT };
}

static const struct expect_want nothing = { .block = WORD_COUNT };

/* The word before the last one, which is `:=`; NULL: it is not. */
static const struct token *setting(const struct before *b)
{
	return b->count >= 2 && st_is(&b->token[b->count - 1], ":=") ?
	       &b->token[b->count - 2] : NULL;
}

static struct expect_want step_want(const struct before *b)
{
	const struct token *word = setting(b);

	if (word && st_is(word, "ALARM"))
		return expect_write(CLASS_BOOL);
	return word ? expect_value(CLASS_TIME) : nothing;
}

/* Where the condition begins; 0: it does not yet. */
static int condition_at(const struct before *b)
{
	for (int i = 1; i < b->count; i++)
		if (st_is(&b->token[i], ":=") &&
		    !st_is(&b->token[i - 1], "PRIORITY"))
			return i + 1;
	return 0;
}

static struct expect_want transition_want(const struct before *b)
{
	const struct token *last = &b->token[b->count - 1];
	const int condition = condition_at(b);
	struct expect_want want = expect_value(0);
	bool named = false;

	want.kinds |= EXPECT_FUNCTION;
	want.boxes = true;
	if (condition)
		return b->count > condition && expect_ends_value(last) ? nothing : want;
	for (int i = 1; i < b->count; i++)
		named |= st_is(&b->token[i], "FROM") || st_is(&b->token[i], "TO");
	if (named && (st_is(last, "FROM") || st_is(last, "TO") ||
		      st_is(last, "(") || st_is(last, ",")))
		return kinds_want(EXPECT_STEP);
	return nothing;
}

static struct expect_want control_want(const struct before *b)
{
	const struct token *word = setting(b);

	if (!word)
		return nothing;
	return expect_value(st_is(word, "FORCE") ? ANY_INT : CLASS_BOOL);
}

/* ---- lines ---- */

static struct expect_want use_want(const struct before *b)
{
	const struct token *last = b->count ? &b->token[b->count - 1] : NULL;
	struct expect_want want = expect_write(CLASS_BOOL);

	if (!last) {
		want.kinds |= EXPECT_ACTION | EXPECT_KEYWORD;
		return want;
	}
	if (st_is(&b->token[0], "SET") || st_is(&b->token[0], "RESET"))
		return b->count == 1 || st_is(last, ",") ? want : nothing;
	if (st_is(last, "("))
		return kinds_want(EXPECT_QUALIFIER);
	return st_is(last, ",") ? expect_value(CLASS_TIME) : nothing;
}

static bool is_sfc_step(const struct token *token)
{
	const struct sfc_word *word;

	for (int i = 0; (word = sfc_word(i)); i++)
		if (word->kind == SFC_WORD_STEP && st_is(token, word->word))
			return true;
	return false;
}

/* ---- Structured Text ---- */

static bool has_rungs(const struct before *b)
{
	return b->pou && (b->pou->language == LANGUAGE_LD || b->pou->sfc);
}

/* Is the line at @line one of the statements of an EXECUTE box? */
static bool in_box(const struct before *b, const char *text, size_t line)
{
	static const char *const outside[] = { "RUNG", "END_EXECUTE", "PROGRAM", "FUNCTION", "FUNCTION_BLOCK",
					       "SUBROUTINE", "END_VAR", "ACTION", "TRANSITION", "STEP" };
	size_t begin = has_rungs(b) ? line : 0;

	while (begin > 0) {
		const size_t end = begin - 1;

		begin = expect_line(text, end);
		if (begins(text, begin, end, "EXECUTE"))
			return true;
		for (size_t i = 0; i < sizeof(outside) / sizeof(*outside); i++)
			if (begins(text, begin, end, outside[i]))
				return false;
	}
	return false;
}

/* Where the lines below the heading of the POU begin; of a chart below that of the action, of a ladder
 * below that of the box. */
static size_t body_of(const struct before *b, const char *text, size_t line)
{
	static const char *const heads[] = { "PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "SUBROUTINE" };
	const bool chart = b->pou && b->pou->sfc;
	size_t begin = line;

	while (begin > 0) {
		const size_t end = begin - 1;

		begin = expect_line(text, end);
		for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
			if (begins(text, begin, end, heads[i]))
				return end + 1;
		if (has_rungs(b) && begins(text, begin, end, "EXECUTE"))
			return end + 1;
		if (chart && (begins(text, begin, end, "ACTION") || begins(text, begin, end, "TRANSITION")))
			return end + 1;
	}
	return 0;
}

static struct expect_want words_want(const char *const *words)
{
	return (struct expect_want){ .kinds = EXPECT_KEYWORD, .words = words,
				     .block = WORD_COUNT };
}

/* The enumeration of what a path names; -1: it has none. */
static int enumeration_of(const struct before *b, const char *text, const struct token *last)
{
	const char *from, *end = last->text + last->len;
	const struct meaning *m;

	if (last->kind != TOKEN_NAME && !st_is(last, "]"))
		return -1;
	from = path_start(text, last->kind == TOKEN_NAME ? last->text : end);
	m = meaning_of_path(b, from, (size_t)(end - from));
	return m && m->kind != MEANING_LITERAL && m->like ? (int)m->like->enumeration - 1 : -1;
}

/* A value, compared with or stored in one of this enumeration; -1: any. */
static struct expect_want st_value_want(int enumeration)
{
	struct expect_want want = expect_value(0);

	want.boxes = true;
	want.enumeration = enumeration;
	want.kinds |= EXPECT_FUNCTION | EXPECT_VALUE;
	return want;
}

static const struct word_row *row_of_call(const struct before *b, const struct st_open *open)
{
	struct word_table *words = &scope_project(b->scope)->words;
	const struct token *name = &b->st.token[open->at - 1];
	const struct word_row *row;

	if (open->at < 1 || !st_is(name + 1, "(") || name->kind != TOKEN_NAME)
		return NULL;
	row = row_of_instance(b, name);
	if (row)
		return row;
	row = words_row(words, words_find(words, name->text, name->len));
	return row->kind == WORD_FN ? row : NULL;
}

/* The variable of the project that a pin is; NULL: one of the catalogue. */
static const struct var *var_of_pin(const struct before *b, const struct word_row *row,
				    const char *pin, size_t len)
{
	const struct project *project = scope_project(b->scope);
	const struct var_table *vars;

	if (!row || row->kind == WORD_STRUCT || row->number < WORD_COUNT || row->owner < 0 ||
	    row->owner >= project->pou_count)
		return NULL;
	vars = &project->pou[row->owner].vars;
	for (int i = 0; i < vars->count; i++)
		if (name_is(project_text(project, vars->var[i].name), pin, len))
			return &vars->var[i];
	return NULL;
}

static const char *const st_operators[] = { "AND", "OR", "XOR", "MOD", NULL };

/* What the value before the cursor is compared with or stored in. */
static int st_compared(const struct before *b, const char *text)
{
	static const char *const signs[] = { ":=", "=", "<>" };

	for (size_t i = 0; b->st.count > 1 && i < sizeof(signs) / sizeof(*signs); i++)
		if (st_is(&b->st.token[b->st.count - 1], signs[i]))
			return enumeration_of(b, text, &b->st.token[b->st.count - 2]);
	return -1;
}

static struct expect_want st_argument_want(const struct before *b, const char *text,
					   const struct st_open *open)
{
	const struct word_row *row = row_of_call(b, open);
	const struct token *last = &b->st.token[b->st.count - 1];
	struct expect_want want = st_value_want(-1);
	const struct var *var;

	if (row && last - b->st.token == open->last + 1 && st_is(last, "=>"))
		return expect_write(pin_classes(row, last - 1));
	if (row && last - b->st.token == open->last + 1 && st_is(last, ":=")) {
		var = var_of_pin(b, row, last[-1].text, last[-1].len);
		want.enumeration = var ? (int)var->enumeration - 1 : -1;
		return want;
	}
	if (st_ends_value(&b->st) && b->st.count > open->last)
		return words_want(st_operators);
	if (row && b->st.count == open->last) {
		want.kinds |= EXPECT_PIN;
		want.row = row;
		want.marks = true;
		want.kinds &= ~(unsigned)EXPECT_VALUE;
		return want;
	}
	want.enumeration = st_compared(b, text);
	return want;
}

static bool has_word(const struct st_place *st, const char *word)
{
	for (int i = 0; i < st->count; i++)
		if (st_is(&st->token[i], word))
			return true;
	return false;
}

/* Words that may follow the value which ends before the cursor. */
static struct expect_want st_behind_want(const struct before *b)
{
	static const char *const then[] = { "THEN", "AND", "OR", "XOR", "MOD", NULL };
	static const char *const of[] = { "OF", "AND", "OR", "XOR", "MOD", NULL };
	static const char *const doing[] = { "DO", "AND", "OR", "XOR", "MOD", NULL };
	static const char *const to[] = { "TO", "MOD", NULL };
	static const char *const by[] = { "BY", "DO", "MOD", NULL };
	static const char *const until[] = { "END_REPEAT", "AND", "OR", "XOR", "MOD", NULL };
	const struct token *first = b->st.token;

	if (st_is(first, "IF") || st_is(first, "ELSIF"))
		return words_want(then);
	if (st_is(first, "CASE"))
		return words_want(of);
	if (st_is(first, "UNTIL"))
		return words_want(until);
	if (st_is(first, "FOR"))
		return !has_word(&b->st, ":=") ? nothing :
		       words_want(has_word(&b->st, "BY") ? doing :
				  has_word(&b->st, "TO") ? by : to);
	return words_want(st_is(first, "WHILE") ? doing : st_operators);
}

/* Words that end the innermost block, or begin its next branch. */
static const char *const *ends_of_block(const struct before *b)
{
#define STATEMENTS "IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "CONTINUE", "RETURN"
	static const char *const branch[] = { STATEMENTS, "ELSIF", "ELSE", "END_IF", NULL };
	static const char *const last[] = { STATEMENTS, "END_IF", NULL };
	static const char *const choice[] = { STATEMENTS, "ELSE", "END_CASE", NULL };
	static const char *const other[] = { STATEMENTS, "END_CASE", NULL };
	static const char *const repeat[] = { STATEMENTS, "UNTIL", "END_REPEAT", NULL };
	static const char *const counted[] = { STATEMENTS, "END_FOR", NULL };
	static const char *const whiles[] = { STATEMENTS, "END_WHILE", NULL };
	static const char *const outside[][12] = {
		[POU_PROGRAM] = { STATEMENTS, "VAR", "VAR_TEMP", "END_PROGRAM" },
		[POU_FUNCTION] = { STATEMENTS, "VAR", "VAR_INPUT", "END_FUNCTION" },
		[POU_BLOCK] = { STATEMENTS, "VAR", "VAR_INPUT", "END_FUNCTION_BLOCK" },
		[POU_SUBROUTINE] = { STATEMENTS, "VAR", "END_SUBROUTINE" },
		[POU_ACTION] = { STATEMENTS, "END_ACTION" },
	};
	static const char *const action[] = { STATEMENTS, "END_ACTION", NULL };
	static const char *const box[] = { STATEMENTS, "END_EXECUTE", NULL };
	const struct st_block *block = st_place_block(&b->st);

	if (!block && b->boxed)
		return box;
	if (!block)
		return b->pou->sfc ? action : outside[b->pou->kind];
	if (block->kind == ST_IF)
		return block->other ? last : branch;
	if (block->kind == ST_CASE)
		return block->other ? other : choice;
	return block->kind == ST_REPEAT ? repeat : block->kind == ST_FOR ? counted : whiles;
#undef STATEMENTS
}

/* At the beginning of a statement: in a CASE also the values that choose a branch. */
static struct expect_want st_begin_want(const struct before *b, const char *text)
{
	const struct st_block *block = st_place_block(&b->st);
	struct expect_want want = words_want(ends_of_block(b));

	want.kinds |= EXPECT_VARIABLE | EXPECT_INSTANCE | EXPECT_SUBROUTINE;
	want.write = true;
	if (block && block->kind == ST_CASE && !block->other && block->selector.len) {
		want.enumeration = enumeration_of(b, text, &block->selector);
		want.kinds |= want.enumeration >= 0 ? (unsigned)EXPECT_VALUE : 0;
	}
	return want;
}

/* Behind `1, ` of a choice of CASE. */
static bool in_choice(const struct before *b)
{
	const struct st_block *block = st_place_block(&b->st);

	return block && block->kind == ST_CASE && b->st.count > 0 &&
	       st_is(&b->st.token[b->st.count - 1], ",") && !has_word(&b->st, ":=");
}

/* At the beginning of a line of a network, in its heading, behind JMP. */
static struct expect_want fbd_want(const struct before *b)
{
	static const char *const begin[][6] = {
		[POU_PROGRAM] = { "NETWORK", "JMP", "RETURN", "STOP", "END_PROGRAM" },
		[POU_FUNCTION] = { "NETWORK", "JMP", "RETURN", "STOP", "END_FUNCTION" },
		[POU_BLOCK] = { "NETWORK", "JMP", "RETURN", "STOP", "END_FUNCTION_BLOCK" },
		[POU_SUBROUTINE] = { "NETWORK", "JMP", "RETURN", "STOP", "END_SUBROUTINE" },
		[POU_ACTION] = { "NETWORK", "JMP", "RETURN", "STOP", "END_ACTION" },
	};
	static const char *const off[] = { "OFF", NULL }, *const condition[] = { "IF", NULL };
	struct expect_want want;

	if (b->st.count && st_is(b->st.token, "NETWORK"))
		return b->st.count == 1 ? words_want(off) : nothing;
	if (b->st.count == 2)
		return words_want(condition);
	if (b->st.count)
		return kinds_want(EXPECT_LABEL);
	want = words_want(begin[b->pou->kind]);
	want.kinds |= EXPECT_VARIABLE | EXPECT_INSTANCE | EXPECT_SUBROUTINE;
	want.write = true;
	return want;
}

static struct expect_want expect_st(struct before *b, const char *text, size_t line, size_t to)
{
	const bool fbd = b->pou && b->pou->fbd && !b->boxed; /* a line is whole by itself */
	const size_t body = fbd ? line : body_of(b, text, line);
	struct expect_want want;
	struct st_open open;

	st_place_find(&b->st, text + body, to - body);
	if (fbd && (b->st.count == 0 || (st_is(b->st.token, "JMP") && b->st.count < 3) ||
		    st_is(b->st.token, "NETWORK")))
		return fbd_want(b);
	if (b->st.count == 0)
		return st_begin_want(b, text);
	open = st_place_open(&b->st);
	if (open.at >= 0)
		return st_argument_want(b, text, &open);
	if (in_choice(b)) {
		want = kinds_want(EXPECT_VALUE);
		want.enumeration = enumeration_of(b, text, &st_place_block(&b->st)->selector);
		return want;
	}
	if (b->st.count == 1 && st_is(b->st.token, "FOR"))
		return expect_write(ANY_INT);
	if (st_ends_value(&b->st))
		return b->st.count == 1 ? nothing : st_behind_want(b);
	return st_value_want(st_compared(b, text));
}

/* Is the body around the line at @line of a chart Structured Text? Before its first statement is
 * whole, it is what the other actions are. */
static bool is_st_action(const struct before *b, const char *text, size_t line)
{
	const size_t body = body_of(b, text, line);
	struct lex lex, end;

	if (!b->pou || !b->pou->sfc || inside_at(text, line) != IN_BODY)
		return false;
	lex_init(&lex, text + body, strlen(text + body));
	lex_next(&lex);
	end = lex;
	while (end.token.kind != TOKEN_END && !lex_is(&end, "END_ACTION") && !lex_is(&end, "END_TRANSITION"))
		lex_next(&end);
	if (lex_is(&lex, "RUNG") || op_find(lex.token.text, lex.token.len) == OP_LD)
		return false;
	lex.end = end.token.text;
	return (end.token.text != lex.token.text && st_begins(lex)) || (b->pou->st && b->pou->st->count > 0 && b->pou->il.count == 0);
}

/* What is wanted in the line at @line of a chart, before @to; @bar: after its last bar, or
 * @line. */
static struct expect_want expect_sfc(struct before *b, const char *text, size_t line,
				     size_t bar, size_t to)
{
	enum inside in;

	if (bar > line) {
		expect_tokens(b, text, bar, to);
		return expect_cell(b);
	}
	expect_tokens(b, text, expect_statement(text, line), to);
	if (b->count && is_sfc_step(&b->token[0]))
		return step_want(b);
	if (b->count && st_is(&b->token[0], "TRANSITION"))
		return transition_want(b);
	if (b->count && st_is(&b->token[0], "CONTROL"))
		return control_want(b);
	in = inside_at(text, line);
	if (in == IN_STEP)
		return use_want(b);
	if (in == IN_BODY)
		return is_st_action(b, text, line) ? expect_st(b, text, line, to) : expect_list(b);
	return kinds_want(b->count ? 0 : EXPECT_KEYWORD);
}

/* Phase#: the values of the enumeration before the cursor's word. */
static bool typed_want(const struct before *b, const char *text, size_t word,
		       struct expect_want *want)
{
	size_t from = word - (word > 0);

	if (word == 0 || text[word - 1] != '#')
		return false;
	while (from > 0 && is_name_byte(text[from - 1]))
		from--;
	if (!values_want(b, text + from, word - 1 - from, want))
		*want = nothing;
	return true;
}

static struct expect_want want_at(struct before *b, const char *text, size_t line,
				  size_t to)
{
	size_t bar = to;

	while (bar > line && text[bar - 1] != '|')
		bar--;
	if (in_vars(text, line)) {
		expect_tokens(b, text, line, to);
		return declaration_want(b);
	}
	b->boxed = in_box(b, text, line);
	if (b->boxed)
		return expect_st(b, text, line, to);
	if (b->pou && b->pou->language == LANGUAGE_SFC)
		return expect_sfc(b, text, line, bar, to);
	if (b->pou && b->pou->language == LANGUAGE_LD && bar > line) {
		expect_tokens(b, text, bar, to);
		return expect_cell(b);
	}
	if (b->pou && b->pou->language == LANGUAGE_IL) {
		expect_tokens(b, text, expect_statement(text, line), to);
		return expect_list(b);
	}
	if (b->pou && (b->pou->language == LANGUAGE_ST || b->pou->language == LANGUAGE_FBD))
		return expect_st(b, text, line, to);
	expect_tokens(b, text, line, to);
	return (struct expect_want){ .kinds = b->count ? 0 : EXPECT_KEYWORD,
				     .block = WORD_COUNT };
}

static void find_want(struct before *b, const char *text, size_t at, int line,
		      struct expect_place *out)
{
	size_t word = at;

	while (word > 0 && (is_name_byte(text[word - 1]) || text[word - 1] == '%'))
		word--;
	b->pou = out->pou = pou_at(scope_project(b->scope), text,
				   expect_line(text, at), line);
	if (!typed_want(b, text, word, &out->want))
		out->want = want_at(b, text, expect_line(text, at), word);
	out->prefix = text + word;
	out->prefix_len = at - word;
	if (!part_want(b, text, text + word, &out->prefix_len, &out->want, &out->prefix))
		out->want.kinds = 0;
}

bool expect_at(struct scope *scope, const char *text, size_t len, int line,
	       int column, struct expect_place *out)
{
	struct before *before;
	size_t at;

	*out = (struct expect_place){ .want = { .block = WORD_COUNT } };
	if (!offset_of(text, len, line, column, &at))
		return false;
	before = calloc(1, sizeof(*before));
	if (!before)
		return false;
	before->scope = scope;
	find_want(before, text, at, line, out);
	out->want.begun = out->prefix;
	out->want.begun_len = out->prefix_len;
	free(before);
	return true;
}

/* ---- the call around the cursor ---- */

static const char *type_of_pin(const struct before *b, const struct word_row *row,
			       const struct word_pin *pin)
{
	const struct var *var = var_of_pin(b, row, pin->name, strlen(pin->name));
	static const struct { uint16_t classes; const char *text; } any[] = {
		{ ANY_INT, "ANY_INT" }, { ANY_NUM, "ANY_NUM" }, { ANY_BIT, "ANY_BIT" },
	};

	if (var && var->named)
		return project_text(scope_project(b->scope),
				    scope_project(b->scope)->named[var->named - 1].name);
	if (pin->type != IEC_NONE)
		return iec_type_row(pin->type)->word;
	if (pin->classes == 0 && pin->word)
		return scope_row(b->scope, (enum word)pin->word)->word;
	for (size_t i = 0; i < sizeof(any) / sizeof(*any); i++)
		if (pin->classes == any[i].classes)
			return any[i].text;
	return "ANY";
}

/* Which pin the argument at the cursor goes to; -1: none yet. */
static int pin_at(const struct before *b, const struct word_row *row, const struct st_open *open)
{
	const struct st_place *st = &b->st;
	int pin = -1;

	if (st->count > open->last + 1 && (st_is(&st->token[open->last + 1], ":=") ||
					   st_is(&st->token[open->last + 1], "=>")))
		return word_pin_find(row, st->token[open->last].text, st->token[open->last].len);
	for (int i = 0; i <= open->argument && pin < row->pin_count; i++)
		do
			pin++;
		while (pin < row->pin_count && row->pin[pin].dir != PIN_IN &&
		       row->pin[pin].dir != PIN_IN_OUT);
	return pin;
}

static void say(struct expect_call *out, size_t *used, const char *before, const char *text)
{
	int written = *used < sizeof(out->text) ?
		snprintf(out->text + *used, sizeof(out->text) - *used, "%s%s", before, text) : 0;

	*used += written > 0 ? (size_t)written : 0;
	if (*used >= sizeof(out->text))
		*used = sizeof(out->text) - 1;
}

/* The inputs, or the outputs of a block. Pins of a function without a name outside are left out. */
static void print_pins(const struct before *b, const struct word_row *row, bool outputs, int at,
		       struct expect_call *out, size_t *used)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (pin->dir == PIN_VAR || pin->dir == PIN_NONE || !pin->name || !*pin->name ||
		    (row->kind == WORD_FB && pin->dir == PIN_OUT) != outputs)
			continue;
		say(out, used, out->text[*used - 1] == '(' ? "" : ", ", "");
		if (i == at)
			out->from = *used;
		say(out, used, pin->name, outputs ? " => " : " : ");
		say(out, used, type_of_pin(b, row, pin), "");
		if (i == at)
			out->to = *used;
	}
}

static void print_call(const struct before *b, const struct word_row *row, const char *name,
		       int at, struct expect_call *out)
{
	size_t used = 0;

	out->from = out->to = 0;
	say(out, &used, name, "(");
	print_pins(b, row, false, at, out, &used);
	print_pins(b, row, true, at, out, &used);
	say(out, &used, row->kind == WORD_FN && row->most_inputs > row->pin_count ? ", \xe2\x80\xa6" : "",
	    ")");
}

static bool find_call(struct before *b, const char *text, size_t at, int line,
		      struct expect_call *out)
{
	const size_t from = expect_line(text, at);
	const struct word_row *row;
	struct st_open open;
	char name[LIMIT_NAME + 1];
	size_t body;

	b->pou = pou_at(scope_project(b->scope), text, from, line);
	body = b->pou && b->pou->fbd ? from : body_of(b, text, from);
	if (!b->pou || body > at || (b->pou->language != LANGUAGE_ST && !b->pou->fbd && !in_box(b, text, from) && !is_st_action(b, text, from)))
		return false;
	st_place_find(&b->st, text + body, at - body);
	open = st_place_open(&b->st);
	row = open.at > 0 ? row_of_call(b, &open) : NULL;
	if (!row)
		return false;
	snprintf(name, sizeof(name), "%.*s", (int)b->st.token[open.at - 1].len,
		 b->st.token[open.at - 1].text);
	print_call(b, row, name, pin_at(b, row, &open), out);
	return true;
}

bool expect_call(struct scope *scope, const char *text, size_t len, int line, int column,
		 struct expect_call *out)
{
	struct before *before;
	bool found;
	size_t at;

	if (!offset_of(text, len, line, column, &at))
		return false;
	before = calloc(1, sizeof(*before));
	if (!before)
		return false;
	before->scope = scope;
	found = find_call(before, text, at, line, out);
	free(before);
	return found;
}
