/* SPDX-License-Identifier: MIT
 *
 * values - values of several enumerations; see values.h.
 *
 * One walk through a list. The current result has an enumeration or not; lines that wait have a value of several in
 * the current result, until a comparison or ST says which is meant.
 */
#include "engine/check/values.h"

#include "engine/base/ascii.h"
#include "engine/model/named.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

/* The current result. */
struct result {
	uint32_t of;  /* its enumeration + 1; 0: none, or not known           */
	int waits;    /* the first line with a value that waits; -1: none     */
};

#define HELD 8

struct walk {
	struct scope *scope;
	const struct pou *pou;
	struct il *il;
	struct result now;
	struct { uint32_t operand, of; } held[HELD]; /* temporaries with a value of an enumeration */
	int last;              /* of them: the newest                         */
	int depth;             /* of open parentheses                         */
	struct { struct result left; bool tests; } open[LIMIT_IL_DEPTH];
};

static const struct meaning *mean(struct scope *scope, const struct pou *pou, uint32_t operand)
{
	enum diag_id why;

	return operand ? scope_find(scope, pou, operand, &why) : NULL;
}

static uint32_t enumeration_of(const struct meaning *m)
{
	return m && m->kind != MEANING_LITERAL && m->like && !meaning_is_whole(m) ? m->like->enumeration : 0;
}

/* @operand with the type of enumeration @of - 1; of one without a name the number. */
static uint32_t typed(struct scope *scope, const struct pou *pou, uint32_t operand, uint32_t of)
{
	struct project *project = scope_project(scope);
	const struct meaning *m = of ? mean(scope, pou, operand) : NULL;
	const struct enum_value *value;
	const struct enumeration *list;
	char text[2 * LIMIT_NAME + 2];
	uint32_t id;
	int len;

	if (!m || m->kind != MEANING_LITERAL || !m->several)
		return operand;
	value = named_value(project, (int)of - 1, names_fold(&project->names, operand));
	list = &project->enumeration[of - 1];
	if (!value)
		return operand;
	len = list->name ? snprintf(text, sizeof(text), "%s#%s", project_text(project, list->name),
				    project_text(project, value->name)) :
			   snprintf(text, sizeof(text), "%s#%lld", iec_type_row(list->type)->word,
				    (long long)value->number);
	id = len > 0 && (size_t)len < sizeof(text) ? names_intern(&project->names, text, (size_t)len) : 0;
	return id ? id : operand;
}

uint32_t values_choose(struct scope *scope, const struct pou *pou, uint32_t operand, uint32_t like)
{
	return scope_project(scope)->enumeration_count ?
	       typed(scope, pou, operand, enumeration_of(mean(scope, pou, like))) : operand;
}

static bool is_arg(const struct walk *w, int at)
{
	return at < w->il->count && (w->il->line[at].kind == IL_ARG_IN || w->il->line[at].kind == IL_ARG_OUT);
}

/* A temporary that translation made gets a value of enumeration @of - 1; 0: another value. */
static void hold(struct walk *w, uint32_t operand, uint32_t of)
{
	for (int i = 0; i < HELD; i++)
		if (w->held[i].operand == operand) {
			w->held[i].of = of;
			return;
		}
	if (!of || *project_text(scope_project(w->scope), operand) != '_')
		return;
	w->last = (w->last + 1) % HELD;
	w->held[w->last].operand = operand;
	w->held[w->last].of = of;
}

static uint32_t of_operand(struct walk *w, const struct il_line *line)
{
	const uint32_t of = enumeration_of(mean(w->scope, w->pou, line->operand));

	for (int i = 0; i < HELD && !of && line->operand; i++)
		if (w->held[i].operand == line->operand)
			return w->held[i].of;
	return of;
}

static bool is_several(struct walk *w, const struct il_line *line)
{
	const struct meaning *m = mean(w->scope, w->pou, line->operand);

	return m && m->kind == MEANING_LITERAL && m->several;
}

/* The values from line @from to before @to that wait are of enumeration @of - 1. */
static void choose(struct walk *w, int from, int to, uint32_t of)
{
	for (int i = from; of && from >= 0 && i < to; i++) {
		struct il_line *line = &w->il->line[i];

		if (line->kind == IL_OP || line->kind == IL_FN || is_arg(w, i))
			line->operand = typed(w->scope, w->pou, line->operand, of);
	}
}

/* Are the inputs of the function of one type, so of one enumeration? */
static bool shares(const struct walk *w, enum word word)
{
	return word == FN_MOVE || word == FN_SEL || word == FN_MUX || word == FN_MIN || word == FN_MAX ||
	       word == FN_LIMIT || (!word_is_own(word) && word_is_test(scope_row(w->scope, word)));
}

/* The operand of line @at meets the value that waits for its type. The first input of SEL and MUX only chooses. */
static void meet(struct walk *w, int at, int end, bool chooses)
{
	uint32_t of;

	if (chooses)
		w->now = (struct result){ .waits = -1 };
	of = w->now.of;

	for (int i = at; i < end && !of; i++)
		of = of_operand(w, &w->il->line[i]);
	choose(w, w->now.waits >= 0 ? w->now.waits : at, end, of);
	w->now.of = of;
	for (int i = at; i < end && !of && w->now.waits < 0; i++)
		if (is_several(w, &w->il->line[i]))
			w->now.waits = i;
	if (of)
		w->now.waits = -1;
}

static void load(struct walk *w, int at)
{
	const struct il_line *line = &w->il->line[at];

	w->now = (struct result){ .of = of_operand(w, line), .waits = is_several(w, line) ? at : -1 };
}

static void open_paren(struct walk *w, int at, bool tests)
{
	if (w->depth < LIMIT_IL_DEPTH) {
		w->open[w->depth].left = w->now;
		w->open[w->depth].tests = tests;
	}
	w->depth++;
	load(w, at);
}

static void close_paren(struct walk *w, int at)
{
	const struct result right = w->now;

	w->now = (struct result){ .waits = -1 };
	if (w->depth == 0 || --w->depth >= LIMIT_IL_DEPTH)
		return;
	w->now = w->open[w->depth].left;
	choose(w, right.waits, at, w->now.of);
	choose(w, w->now.waits, at, right.of);
	if (w->open[w->depth].tests)
		w->now = (struct result){ .waits = -1 };
}

/* ---- calls ---- */

static const struct var *pin_variable(const struct walk *w, const struct word_row *row, enum word word,
				      uint32_t pin)
{
	const struct project *project = scope_project(w->scope);
	const struct var_table *table = word_is_own(word) ? shape_vars(project, word) : NULL;
	const char *name = project_text(project, pin);
	const int index = table ? word_pin_find(row, name, strlen(name)) : -1;

	if (table && row->kind == WORD_FN && ascii_is(words_result(row), name, strlen(name)))
		return table->count ? &table->var[0] : NULL;
	return index >= 0 && index < table->count ? &table->var[index] : NULL;
}

/* Has the pin a type of its own, which is not the one of the other inputs, as EN has? */
static bool is_own_pin(const struct walk *w, const struct word_row *row, uint32_t pin)
{
	const char *name = project_text(scope_project(w->scope), pin);
	const int index = word_pin_find(row, name, strlen(name));

	if (index < 0 && (ascii_is("EN", name, strlen(name)) || ascii_is("ENO", name, strlen(name))))
		return true;
	return index >= 0 && index < row->pin_count && row->pin[index].own;
}

/* The arguments behind @at go to the pins of @word. */
static void to_pins(struct walk *w, int at, enum word word)
{
	const struct word_row *row = scope_row(w->scope, word);
	uint32_t of = 0;
	int end = at + 1;

	for (; is_arg(w, end); end++)
		if (!of && !is_own_pin(w, row, w->il->line[end].pin) && row->kind == WORD_FN && shares(w, word))
			of = of_operand(w, &w->il->line[end]);
	for (int i = at + 1; i < end; i++) {
		struct il_line *arg = &w->il->line[i];
		const struct var *var = pin_variable(w, row, word, arg->pin);

		if (!word_is_own(word) && is_own_pin(w, row, arg->pin))
			continue;
		arg->operand = typed(w->scope, w->pou, arg->operand, word_is_own(word) ? (var ? var->enumeration : 0) : of);
		if (arg->kind == IL_ARG_OUT)
			hold(w, arg->operand, word_is_own(word) ? (var ? var->enumeration : 0) :
			     word_is_test(row) ? 0 : of);
	}
}

/* The current result and the operands are the inputs of @word, in their order. */
static void to_inputs(struct walk *w, int at, int end, enum word word)
{
	const struct word_row *row = scope_row(w->scope, word);
	const struct var_table *table = shape_vars(scope_project(w->scope), word);
	int pin = -1;

	for (int i = at - 1; table && i < end; i++) {
		do
			pin++;
		while (pin < row->pin_count && row->pin[pin].dir != PIN_IN);
		if (pin >= row->pin_count || pin >= table->count)
			break;
		if (i < at)
			choose(w, w->now.waits, at, table->var[pin].enumeration);
		else
			w->il->line[i].operand = typed(w->scope, w->pou, w->il->line[i].operand,
						       table->var[pin].enumeration);
	}
	w->now = (struct result){ .of = table && table->count ? table->var[0].enumeration : 0, .waits = -1 };
}

static void function(struct walk *w, int at)
{
	const struct il_line *line = &w->il->line[at];
	const enum word word = (enum word)line->word;
	const bool tests = !word_is_own(word) && word_is_test(scope_row(w->scope, word));
	int end = at + 1;

	while (is_arg(w, end))
		end++;
	if (line->modifiers & MOD_PAREN) {
		open_paren(w, at, tests);
	} else if (word_is_own(word)) {
		to_inputs(w, at, end, word);
	} else {
		if (shares(w, word))
			meet(w, at, end, word == FN_SEL || word == FN_MUX);
		if (tests || !shares(w, word))
			w->now = (struct result){ .waits = -1 };
	}
}

/* Is the current result stored below in a variable of an enumeration other than @of - 1, too? */
static bool is_of_two(struct walk *w, int at, uint32_t of)
{
	for (int i = at + 1; i < w->il->count; i++) {
		const struct il_line *line = &w->il->line[i];
		const uint32_t other = line->kind == IL_OP && line->op == OP_ST ? of_operand(w, line) : 0;

		if (other && other != of)
			return true;
		if (line->kind != IL_COMMENT && (line->kind != IL_OP || line->op != OP_ST))
			return false;
	}
	return false;
}

/* A value that is stored in variables of two enumerations is of none: who wrote it must say which is meant. */
static void store(struct walk *w, int at)
{
	const struct il_line *line = &w->il->line[at];
	const uint32_t of = of_operand(w, line);

	if (of && w->now.waits >= 0 && is_of_two(w, at, of))
		w->now.waits = -1;
	hold(w, line->operand, line->modifiers ? 0 : w->now.of);
	choose(w, w->now.waits, at, of);
}

static void operation(struct walk *w, int at)
{
	const struct il_line *line = &w->il->line[at];
	const struct meaning *m;

	switch ((enum op)line->op) {
	case OP_LD:
		load(w, at);
		break;
	case OP_ST:
		store(w, at);
		break;
	case OP_AND:
	case OP_OR:
	case OP_XOR:
		if (line->modifiers & MOD_PAREN)
			open_paren(w, at, true);
		else
			w->now = (struct result){ .waits = -1 };
		break;
	case OP_CAL:
		m = mean(w->scope, w->pou, line->operand);
		if (m && m->kind == MEANING_INSTANCE)
			to_pins(w, at, (enum word)m->word);
		w->now = (struct result){ .waits = -1 };
		break;
	case OP_JMP:
	case OP_RET:
	case OP_STP:
	case OP_S:
	case OP_R:
	case OP_NOT:
	case OP_COUNT:
		break;
	}
}

void values_in_list(struct scope *scope, const struct pou *pou, struct il *il)
{
	struct walk w = { .scope = scope, .pou = pou, .il = il, .now.waits = -1 };

	if (!scope_has_several(scope))
		return;
	for (int i = 0; i < il->count; i++)
		switch ((enum il_kind)il->line[i].kind) {
		case IL_OP:
			operation(&w, i);
			break;
		case IL_FN:
			function(&w, i);
			break;
		case IL_CALL:
			to_pins(&w, i, (enum word)il->line[i].word);
			w.now = (struct result){ .waits = -1 };
			break;
		case IL_CLOSE:
			close_paren(&w, i);
			break;
		case IL_LABEL:
			w.now = (struct result){ .waits = -1 };
			w.depth = 0;
			break;
		case IL_EACH:
		case IL_TARGET:
		case IL_TICK:
		case IL_ARG_IN:
		case IL_ARG_OUT:
		case IL_COMMENT:
			break;
		}
}
