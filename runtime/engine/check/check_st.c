/* SPDX-License-Identifier: MIT
 *
 * check_st - the names in statements; see check_st.h.
 */
#include "engine/check/check_st.h"

#include "engine/check/letters.h"
#include "engine/check/split.h"
#include "engine/model/expr_args.h"
#include "engine/model/st.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The callee of the call that is being walked. */
struct callee {
	const struct word_row *row; /* of an instance; NULL: a subroutine, a program */
	const struct pou *program;  /* NULL: none                              */
	int pin;                    /* of the last argument without a name; -1 */
	uint64_t given[4];          /* pins that have a value, the first ones */
};

static const struct expr_node *root_of(const struct expr *expr)
{
	return &expr->node[expr->root];
}

/* The variable of FOR: an integer. */
static void check_counter(struct operand_check *c, struct expr *expr)
{
	const struct expr_node *root = root_of(expr);
	const struct meaning *m;
	enum diag_id why;
	char text[LIMIT_ARG];

	if (!check_part(c, expr, OPERAND_WRITTEN))
		return;
	check_part(c, expr, OPERAND_READ);
	if (root->op != EXPR_NAME)
		return;
	m = scope_find(c->scope, c->pou,
		       names_intern(&c->project->names, root->text, root->len), &why);
	if (!m || iec_type_row(m->type)->class & (ANY_INT | CLASS_BITS))
		return;
	snprintf(text, sizeof(text), "%.*s" DIAG_AND "%s", root->len < 30 ? root->len : 30, root->text,
		 iec_type_row(m->type)->word);
	check_said(c, DIAG_ST_INTEGER, text);
}

/* Does CAL run it without an instance? */
static bool is_routine(const struct pou *pou)
{
	return pou && (pou->kind == POU_SUBROUTINE || pou->kind == POU_PROGRAM ||
		       pou->kind == POU_ACTION);
}

/* True: an instance or a subroutine, whose arguments follow. */
static bool check_callee(struct operand_check *c, struct expr *expr, struct callee *callee)
{
	const uint32_t id = scope_first_of(c->scope, c->pou, expr, root_of(expr));
	const struct meaning *m;
	enum diag_id why;

	const struct pou *routine = scope_pou(c->scope, c->pou, id);

	*callee = (struct callee){ .pin = -1 };
	if (is_routine(routine)) {
		callee->program = routine->kind == POU_PROGRAM ? routine : NULL;
		return true;
	}
	if (!check_part(c, expr, OPERAND_CALLED))
		return false;
	m = scope_find(c->scope, c->pou, id, &why);
	callee->row = m ? scope_row(c->scope, (enum word)m->word) : NULL;
	return callee->row != NULL;
}

/* The pin that an argument goes to; NULL: none, which check_il reports. */
static const struct word_pin *pin_of(struct callee *callee, const struct st_part *part)
{
	int index;

	if (!callee->row)
		return NULL;
	if (!part->pin.len)
		return pin_next(callee->row, &callee->pin);
	index = word_pin_find(callee->row, part->pin.text, part->pin.len);
	return index >= 0 && index < callee->row->pin_count ? &callee->row->pin[index] : NULL;
}

/* `IN = On` for IN := On. */
static bool said_equals(struct operand_check *c, const struct callee *callee, const struct st_part *part,
			const struct expr *expr)
{
	const struct expr_node *root = &expr->node[expr->root];
	const struct expr_node *left = root->op == EXPR_FN && root->fn == FN_EQ ? &expr->node[root->left] : NULL;
	char text[LIMIT_ARG];
	enum diag_id why;

	if (!left || left->op != EXPR_NAME || part->pin.len || !callee->row || left->len > 20 ||
	    word_pin_find(callee->row, left->text, left->len) < 0 ||
	    scope_find(c->scope, c->pou, names_intern(&c->project->names, left->text, left->len), &why))
		return false;
	c->spot = left->text;
	snprintf(text, sizeof(text), "%.*s =" DIAG_AND "%.*s :=", left->len, left->text, left->len, left->text);
	check_said(c, DIAG_ST_FOREIGN, text);
	return true;
}

/* `Other(In := 5, Out => Level)`: In and Out are variables of the program. */
static void check_program_argument(struct operand_check *c, struct callee *callee,
				   const struct st_part *part, struct expr *expr)
{
	struct names *names = &c->project->names;
	const bool output = part->role == ST_OUTPUT;
	const struct var_table *table = &callee->program->vars;
	const uint32_t name = part->pin.len ? names_intern(names, part->pin.text, part->pin.len) : 0;
	const int at = vars_argument(table, name ? names_fold(names, name) : 0, output, &callee->pin);
	const char *program = project_text(c->project, callee->program->name);
	const struct meaning *m;
	char text[2 * LIMIT_NAME + 2];
	enum diag_id why;
	int len;

	if (at < 0 && !part->pin.len) {
		c->spot = part->text;
		check_said(c, DIAG_TOO_MANY_OPERANDS, program);
		return;
	}
	len = snprintf(text, sizeof(text), "%s.%.*s", program, (int)part->pin.len, part->pin.text);
	if (at >= 0)
		len = snprintf(text, sizeof(text), "%s.%s", program, project_text(c->project, table->var[at].name));
	if (at < 0) {
		c->spot = part->text;
		check_said(c, DIAG_NO_PIN, text);
		return;
	}
	m = scope_find(c->scope, c->pou, names_intern(names, text, (size_t)len), &why);
	if (m)
		uses_add(c->uses, m, output ? USE_READ : USE_WRITTEN);
	check_part(c, expr, output ? OPERAND_STORED :
		   vars_flags(table, at) & VAR_IN_OUT ? OPERAND_CHANGED : table->var[at].array.count ||
		   table->var[at].type == IEC_NONE ? OPERAND_WHOLE : OPERAND_READ);
}

/* @part has a name. */
static bool has_pin(struct operand_check *c, struct callee *callee, const struct st_part *part)
{
	struct names *names = &c->project->names;

	if (callee->program)
		return vars_find(&callee->program->vars, names_fold(names, names_intern(names, part->pin.text,
											part->pin.len))) >= 0;
	return !callee->row || pin_of(callee, part);
}

static void said_no_pin(struct operand_check *c, const struct st_part *part)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.*s", part->pin.len < LIMIT_ARG ? part->pin.len : LIMIT_ARG - 1,
		 part->pin.text);
	c->spot = part->pin.text;
	check_said(c, DIAG_NO_PIN, text);
}

static void check_argument(struct operand_check *c, struct callee *callee, const struct st_part *part,
			   struct expr *expr)
{
	if (callee->program) {
		check_program_argument(c, callee, part, expr);
		return;
	}
	const struct word_pin *pin = pin_of(callee, part);
	if (said_equals(c, callee, part, expr))
		return;
	const int at = pin ? (int)(pin - callee->row->pin) : INT_MAX;
	const bool whole = pin && (pin->elements || pin->type == IEC_NONE);

	if (at < 256 && callee->given[at / 64] >> at % 64 & 1) {
		char text[LIMIT_ARG];

		c->spot = part->text;
		snprintf(text, sizeof(text), "%.60s", pin->name);
		check_said(c, DIAG_DUPLICATE_ARG, text);
	} else if (at < 256) {
		callee->given[at / 64] |= UINT64_C(1) << at % 64;
	}
	if (part->role == ST_OUTPUT || (pin && pin->dir == PIN_OUT && !part->pin.len))
		check_part(c, expr, OPERAND_STORED);
	else if (pin && pin->dir == PIN_IN_OUT)
		check_part(c, expr, OPERAND_CHANGED);
	else
		check_part(c, expr, whole ? OPERAND_WHOLE : OPERAND_READ);
}

/* Is the statement the call of a function, whose result is not used? An instance may have the name of one. */
static bool is_function(struct operand_check *c, const struct expr_node *callee)
{
	const struct pou *pou;
	const struct meaning *m;
	enum diag_id why;
	uint32_t id;

	if (callee->op != EXPR_NAME || expr_function(&c->project->words, callee) == WORD_COUNT)
		return false;
	id = names_intern(&c->project->names, callee->text, callee->len);
	pou = scope_pou(c->scope, c->pou, id);
	if (pou && pou->kind == POU_ACTION) /* it may have the name of a function, too */
		return false;
	m = scope_find(c->scope, c->pou, id, &why);
	return !m || m->kind != MEANING_INSTANCE;
}

/* st_next() with letters of texts as functions. */
static bool next_part(struct operand_check *c, struct st_walk *walk, struct st_part *part)
{
	if (!st_next(walk, part, c->expr, c->diags, c->place))
		return false;
	if (part->role == ST_ASSIGNED || part->role == ST_VALUE || part->role == ST_INPUT)
		letters_rewrite(c->scope, c->pou, c->expr);
	return true;
}

/* A function as a statement: as an expression. */
static void check_function(struct operand_check *c)
{
	struct st_walk walk;

	st_begin(&walk, &c->project->names, c->item);
	if (expr_parse(&walk.lex, c->expr, c->diags, c->place)) {
		letters_rewrite(c->scope, c->pou, c->expr);
		check_part(c, c->expr, OPERAND_READ);
	} else {
		c->good = false;
	}
}

static bool said_call(struct operand_check *c, enum diag_id id, const struct st_part *part)
{
	const int len = root_of(c->expr)->len;
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.*s", len < LIMIT_ARG ? len : LIMIT_ARG - 1, part->text);
	c->spot = part->text;
	check_said(c, id, text);
	return false;
}

/* May the name stand there as a statement? @open: a parenthesis follows. */
static bool is_callable(struct operand_check *c, bool open, const struct st_part *part)
{
	const struct expr_node *root = root_of(c->expr);
	const uint32_t id = scope_first_of(c->scope, c->pou, c->expr, root);
	const enum word word = words_find(&c->project->words, root->text, root->len);
	const struct meaning *m;
	enum diag_id why;

	if (is_routine(scope_pou(c->scope, c->pou, id)))
		return true;
	m = scope_find(c->scope, c->pou, id, &why);
	if (!m && word != WORD_COUNT && words_row(&c->project->words, word)->kind == WORD_FB)
		return said_call(c, DIAG_ST_CALLS_TYPE, part);
	if (open || !m)
		return true;
	return said_call(c, m->kind == MEANING_INSTANCE ? DIAG_ST_NOT_CALLED : DIAG_ST_NOTHING, part);
}

/* The error of argument @pin of SPLIT_DATE and the like; DIAG_COUNT: none. @given: bit i of pin i. */
static enum diag_id judge_split(int pin, const struct st_part *part, unsigned int given)
{
	if (pin < 0)
		return part->pin.len ? DIAG_NO_PIN : DIAG_TOO_MANY_OPERANDS;
	if (given >> pin & 1)
		return DIAG_DUPLICATE_ARG;
	if (pin == 0 && part->role == ST_OUTPUT)
		return DIAG_INPUT_READ;
	return pin > 0 && part->pin.len && part->role != ST_OUTPUT ? DIAG_PIN_DIRECTION : DIAG_COUNT;
}

/* SPLIT_DATE(IN := Day, YEAR => Year); the translation compares the types. */
static void check_split(struct operand_check *c, const struct split *split, struct st_walk *walk)
{
	unsigned int given = 0;
	struct st_part part;
	char text[LIMIT_ARG];
	int last = -1;

	while (next_part(c, walk, &part) && part.role != ST_NO_PART) {
		const int pin = split_pin(split, &part, &last);
		const enum diag_id wrong = judge_split(pin, &part, part.role == ST_OPEN ? 0 : given);

		if (wrong != DIAG_COUNT && (part.role != ST_OPEN || pin < 0)) {
			snprintf(text, sizeof(text), "%.*s", part.pin.len ? (int)part.pin.len : 40,
				 part.pin.len ? part.pin.text : split->word);
			c->spot = part.pin.len ? part.pin.text : part.text;
			check_said(c, wrong, text);
		} else if (part.role != ST_OPEN) {
			given |= 1u << pin;
			check_part(c, c->expr, pin ? OPERAND_WRITTEN : OPERAND_READ);
		}
	}
	if (c->good && !walk->missing && !(given & 1)) {
		c->spot = project_text(c->project, c->item->text);
		check_said(c, DIAG_MISSING_INPUT, "IN");
	}
}

static void check_call_parts(struct operand_check *c, struct st_walk *walk)
{
	const struct split *split;
	struct callee callee;
	struct st_part part;

	if (!next_part(c, walk, &part)) {
		c->good = false;
		return;
	}
	if (is_function(c, root_of(c->expr))) {
		check_function(c);
		return;
	}
	split = split_find(c->scope, c->pou, root_of(c->expr));
	if (split) {
		check_split(c, split, walk);
		return;
	}
	if (!is_callable(c, lex_is(&walk->lex, "("), &part))
		return;
	if (!check_callee(c, c->expr, &callee))
		return;
	while (next_part(c, walk, &part) && part.role != ST_NO_PART)
		if (part.role != ST_OPEN)
			check_argument(c, &callee, &part, c->expr);
		else if (!has_pin(c, &callee, &part))
			said_no_pin(c, &part);
}

/* A value of CASE: a constant, or an expression of constants. */
static void check_choice(struct operand_check *c, struct expr *expr)
{
	const struct expr_node *wrong = NULL;

	if (!check_part(c, expr, OPERAND_READ))
		return;
	for (int i = 0; i < expr->count && !wrong; i++) {
		const struct expr_node *node = &expr->node[i];
		const struct meaning *m;
		enum diag_id why;

		if (node->op == EXPR_CALL || node->op == EXPR_INDEX || node->op == EXPR_BIT)
			wrong = node;
		if (node->op != EXPR_NAME)
			continue;
		m = scope_find(c->scope, c->pou,
			       names_intern(&c->project->names, node->text, node->len), &why);
		if (m && m->kind != MEANING_LITERAL && !m->constant)
			wrong = node;
	}
	if (wrong) {
		char text[LIMIT_ARG];

		c->spot = wrong->text;
		snprintf(text, sizeof(text), "%.*s", wrong->len < LIMIT_ARG ? wrong->len : LIMIT_ARG - 1,
			 wrong->text);
		check_said(c, DIAG_CHOICE_COMPUTED, text);
	}
}

/* The place that S= and R= write: a BOOL. */
static void check_latched(struct operand_check *c, struct expr *expr)
{
	const struct expr_node *root = root_of(expr);
	const uint32_t id = scope_first_of(c->scope, c->pou, expr, root);
	const struct meaning *m;
	enum diag_id why;

	if (root->op == EXPR_BIT) { /* of a number */
		check_part(c, expr, OPERAND_READ);
		return;
	}
	if (!check_part(c, expr, OPERAND_WRITTEN))
		return;
	m = scope_find(c->scope, c->pou, id, &why);
	if (m && m->type != IEC_BOOL) {
		c->spot = root->text;
		check_said(c, DIAG_NOT_BOOL, project_text(c->project, id));
	}
}

static void check_statement(struct operand_check *c)
{
	struct st_walk walk;
	struct st_part part;

	st_begin(&walk, &c->project->names, c->item);
	if (c->item->kind == ST_CALL) {
		check_call_parts(c, &walk);
		return;
	}
	while (next_part(c, &walk, &part) && part.role != ST_NO_PART)
		if (part.role == ST_VARIABLE && (c->item->kind == ST_SET || c->item->kind == ST_RESET))
			check_latched(c, c->expr);
		else if (part.role == ST_VARIABLE)
			check_counter(c, c->expr);
		else if (part.role == ST_LOW || part.role == ST_HIGH)
			check_choice(c, c->expr);
		else
			check_part(c, c->expr, part.role == ST_ASSIGNED ? OPERAND_WHOLE : OPERAND_READ);
}

/* Says @id of the name of a JMP or a label. */
static void said_label(struct operand_check *c, enum diag_id id)
{
	const struct token name = st_label_name(&c->project->names, c->item);
	char text[LIMIT_NAME + 1];

	snprintf(text, sizeof(text), "%.*s", (int)name.len, name.text);
	c->spot = name.text;
	check_said(c, id, text);
}

/* A label is named once, and JMP leads to one of the same statements or of those around them. */
static void check_label(struct operand_check *c, const struct st_labels *labels, const struct st_lists *lists,
			int at)
{
	const int found = st_label_find(&c->project->names, labels, c->item);
	char text[LIMIT_ARG];
	bool around = false;

	if (c->item->kind == ST_LABEL) {
		snprintf(text, sizeof(text), "labels" DIAG_AND "%d", LIMIT_ST_LABELS);
		c->spot = st_label_name(&c->project->names, c->item).text;
		if (at == labels->over)
			check_said(c, DIAG_TOO_MANY, text);
		else if (found >= 0 && labels->label[found].item != at)
			said_label(c, DIAG_ST_LABEL_TWICE);
		return;
	}
	for (int i = 0; i <= c->item->depth && found >= 0; i++)
		around |= lists->of[i] == labels->label[found].list;
	if (!around)
		said_label(c, DIAG_ST_NO_LABEL);
}

static void check_labels(struct operand_check *c, int first, int count)
{
	struct names *names = &c->project->names;
	struct st_labels *labels = malloc(sizeof(*labels));
	struct st_lists *lists = malloc(sizeof(*lists));

	if (!labels || !lists) {
		c->good = diag_add(c->diags, (struct diag){ .id = DIAG_NO_MEMORY }, "%s", "");
	} else {
		*lists = (struct st_lists){ { -1 } };
		st_labels(names, c->pou->st, first, count, labels);
		for (int i = first; i < first + count; i++) {
			c->item = &c->pou->st->item[i];
			st_lists_step(lists, c->item, i);
			if (c->item->kind == ST_JUMP || c->item->kind == ST_LABEL)
				check_label(c, labels, lists, i);
		}
	}
	free(labels);
	free(lists);
}

bool check_st_item(struct operand_check *c, const struct st_item *item)
{
	c->good = true;
	c->item = item;
	check_statement(c);
	return c->good;
}

bool check_st(struct operand_check *c, int first, int count)
{
	bool jumps = false;

	c->good = true;
	c->place = (struct diag){ .file = c->pou->file, .pou = project_text(c->project, c->pou->name) };
	for (int i = first; i < first + count; i++)
		jumps |= c->pou->st->item[i].kind == ST_JUMP || c->pou->st->item[i].kind == ST_LABEL;
	if (jumps)
		check_labels(c, first, count);
	for (int i = first; i < first + count; i++) {
		c->item = &c->pou->st->item[i];
		if (c->item->kind != ST_COMMENT)
			check_statement(c);
	}
	return c->good;
}
