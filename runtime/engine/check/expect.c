/* SPDX-License-Identifier: MIT
 *
 * expect - the words of the catalogue, the project and a POU, by what is wanted.
 */
#include "engine/check/expect.h"

#include "engine/base/ascii.h"
#include "engine/base/explain.h"
#include "engine/base/nearest.h"
#include "engine/model/convert.h"

#include <stdio.h>
#include <string.h>

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
	static const char *const chart[] = {
		"STEP", "INITIAL_STEP", "MACRO_STEP", "TRANSITION", "ACTION", "CONTROL",
		"SET", "RESET", "END_STEP", "END_TRANSITION", "END_ACTION",
	};
	static const char *const called[] = { "VAR_INPUT", "VAR_OUTPUT",
					      "VAR_IN_OUT" };

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
	for (size_t i = 0; o->pou->sfc && i < sizeof(chart) / sizeof(*chart); i++)
		give(o, EXPECT_KEYWORD, chart[i], "");
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
	if (row->kind == WORD_STRUCT && o->want->kinds & EXPECT_TYPE)
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

/* Is what stands there `INT_`, with more or less behind it? */
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

	/* An instance or structure is on the way to its parts. */
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
	/* Fill.X is read, TRANSITION is written. */
	if (flags & VAR_SFC && o->want->write == (strchr(name, '.') != NULL))
		return;
	if (var->type == IEC_NONE || is_class(o, var->type))
		give(o, EXPECT_VARIABLE, name, type_text(o, var->type, var->fb));
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

static void offer_routines(const struct offer *o)
{
	for (int i = 0; i < o->project->pou_count; i++)
		if (o->project->pou[i].kind == POU_SUBROUTINE)
			give(o, EXPECT_SUBROUTINE,
			     project_text(o->project, o->project->pou[i].name), "");
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
		if (*pin->name)
			o->taker->take(o->taker->context, &word);
	}
	if (!row || row->kind != WORD_FN || !o->want->call)
		return;
	give(o, EXPECT_PIN, "EN", "BOOL");
	give(o, EXPECT_PIN, "ENO", "BOOL");
	give(o, EXPECT_PIN, "OUT", "");
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
	}
	return "";
}

/* A word that is put together while it is offered is gone when the nearest are printed. */
static bool stays(const struct expect_word *word)
{
	if (word->kind == EXPECT_OPERATOR)
		return word->text == op_row(word->op)->word;
	return word->kind != EXPECT_FUNCTION || word->text == word->row->word;
}

static void take_nearest(void *context, const struct expect_word *word)
{
	if (stays(word))
		nearest_offer(context, word->text);
}

void expect_nearest(const struct project *project, const struct pou *pou,
		    unsigned int kinds, const char *wanted, char *out, size_t size)
{
	struct nearest nearest;
	const struct expect_taker taker = { take_nearest, &nearest };
	const struct expect_want want = { .kinds = kinds, .block = WORD_COUNT,
					  .begun = wanted, .begun_len = strlen(wanted) };

	nearest_init(&nearest, wanted, strlen(wanted));
	expect_offer(project, pou, &want, &taker);
	nearest_print(&nearest, out, size);
}
