/* SPDX-License-Identifier: MIT
 *
 * settle - the constant expressions of declarations, from their texts to numbers.
 *
 * First the numbers of enumerations, then all bounds, lengths and plain values, each after the
 * constants that it names, without recursion; then lists and structures, which no expression names.
 */
#include "engine/check/settle.h"

#include "engine/check/constant.h"
#include "engine/model/advice.h"
#include "engine/model/expr_args.h"
#include "engine/model/named.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

enum state { STATE_OPEN, STATE_WORKING, STATE_DONE, STATE_FAILED };

struct settle {
	struct project *project;
	struct scope *scope;
	struct arena *scratch;
	struct fn_check fn;
	struct pou none;                 /* in place of a POU: of globals and structures */
	const struct pou *pou;           /* NULL: none                        */
	struct il_line line;             /* place of diagnostics              */
	struct var_written *top;         /* being computed; below it what needs it */
	int values;                      /* enumeration of the value + 1; 0: none */
	bool begins;                     /* what a variable begins with is computed, in plain IEC text */
	bool shapes;                     /* a size has changed                */
	bool reported;                   /* the walk's error has its diagnostic */
	struct init_walk walk;
	const char *copied;              /* of its text, up to here, the text of constants is made */
	struct text { char *text; size_t len, size; } made;
	struct expr expr;
	struct il_result value[LIMIT_EXPR_NODES];
	struct literal literal[LIMIT_EXPR_NODES];
	enum iec_type type[LIMIT_EXPR_NODES]; /* IEC_NONE: of constants without a type */
	enum iec_type hint[LIMIT_EXPR_NODES]; /* the type that is wanted      */
	struct il_result in[LIMIT_FN_ARGS];
};

static struct settle *settle_new(struct project *project, struct arena *scratch,
				 struct diag_list *diags)
{
	struct settle *s = arena_alloc(scratch, sizeof(*s));

	if (!s)
		return NULL;
	s->project = project;
	s->scratch = scratch;
	s->scope = scope_new(project, scratch);
	s->none = (struct pou){ .file = project->file, .language = LANGUAGE_IL };
	s->fn = (struct fn_check){ .scope = s->scope, .diags = diags };
	return s->scope ? s : NULL;
}

#define VALUES (-1) /* the table of the values of all enumerations */

static struct var_table *table_of(struct project *project, int table)
{
	if (table == 0)
		return &project->globals;
	table -= 1;
	if (table < project->pou_count)
		return &project->pou[table].vars;
	table -= project->pou_count;
	if (table < project->structure_count)
		return &project->structure[table].vars;
	return &project->named[table - project->structure_count].like;
}

/* The last table of a project. */
static int last_table(const struct project *project)
{
	return project->pou_count + project->structure_count + project->named_count;
}

/* Expressions that follow stand in this table of the project. */
static void enter(struct settle *s, int table, const char *file)
{
	const bool in_pou = table > 0 && table <= s->project->pou_count;

	s->pou = in_pou ? &s->project->pou[table - 1] : NULL;
	if (file)
		s->none.file = file;
	s->fn.pou = in_pou ? s->pou : &s->none;
}

static bool refuse(struct settle *s, enum diag_id id, const char *text, size_t len)
{
	char arg[LIMIT_ARG];

	snprintf(arg, sizeof(arg), "%.*s", (int)(len < LIMIT_ARG ? len : LIMIT_ARG - 1), text);
	s->line.operand = 0;
	return il_report(&s->fn, &s->line, id, arg);
}

/* ---- names ---- */

static const struct meaning *mean(struct settle *s, const struct expr_node *node,
				  enum diag_id *why)
{
	return scope_find(s->scope, s->pou,
			  names_intern(&s->project->names, node->text, node->len), why);
}

/* Where a variable begins, one of the same POU or a global may be named in plain IEC text: with
 * the value that it begins with. */
static bool begins_so(const struct settle *s, const struct meaning *m)
{
	const uint16_t others = VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_EXTERNAL;

	return s->begins && m->var && m->type != IEC_NONE && m->type != IEC_STRING && !m->through &&
	       !m->var->target && m->addr.area == AREA_NONE && (!m->pou || m->pou == s->pou) &&
	       !(vars_flags(m->pou ? &m->pou->vars : &s->project->globals, m->index) & others);
}

static bool is_constant(const struct settle *s, const struct meaning *m)
{
	return m->kind == MEANING_VARIABLE &&
	       ((m->constant && m->var->has_init) || begins_so(s, m));
}

/* A value of the enumeration that is wanted, which another one may have, too; NULL: none. */
static const struct enum_value *wanted_value(const struct settle *s, const struct expr_node *node)
{
	struct names *names = &s->project->names;

	return s->values ? named_value(s->project, s->values - 1, names_fold(names,
			   names_intern(names, node->text, node->len))) : NULL;
}

/* The value of an enumeration that a node names, unless a variable has the name; NULL: none. */
static const struct enum_value *value_named(struct settle *s, const struct expr_node *node,
					    const struct meaning *m)
{
	const struct enum_value *value = wanted_value(s, node);
	size_t head;
	int at;

	if (value || (m && m->kind != MEANING_LITERAL))
		return value;
	at = scope_value(s->scope, node->text, node->len, &head);
	return at < 0 ? NULL : &s->project->enum_value[at];
}

static bool is_open(const struct var_written *written)
{
	return written && written->state <= STATE_WORKING;
}

/* The first constant in the expression that is not computed yet; NULL: none. */
static struct var_written *find_open(struct settle *s)
{
	for (int i = 0; i < s->expr.count; i++) {
		const struct expr_node *node = &s->expr.node[i];
		const struct enum_value *value;
		const struct meaning *m;
		enum diag_id why;

		if (node->op != EXPR_NAME && !(node->op == EXPR_LITERAL &&
					       literal_is_named(node->text, node->len)))
			continue;
		m = mean(s, node, &why);
		value = value_named(s, node, m);
		if (value && is_open(value->written))
			return value->written;
		if (m && is_constant(s, m) && is_open(m->var->written))
			return m->var->written;
	}
	return NULL;
}

/* After an error: a value that fits everywhere. */
static struct il_result unknown(void)
{
	return (struct il_result){ .there = true };
}

/* A constant as it is written, or a value of an enumeration. */
static struct il_result take_parsed(const struct literal *literal)
{
	struct il_result out = unknown();

	out.type = literal->type;
	if (literal->type == IEC_NONE)
		out.literal = literal;
	out.known = literal->type != IEC_NONE && literal->type != IEC_STRING;
	out.value = literal->value;
	return out;
}

/* The scope may know the number of before it was computed. */
static struct il_result take_value(struct settle *s, const struct enum_value *value,
				   struct literal *literal)
{
	*literal = (struct literal){ .type = s->project->enumeration[value->enumeration].type,
				     .value.i = value->number };
	return take_parsed(literal);
}

static struct il_result take_name(struct settle *s, int i)
{
	const struct expr_node *node = &s->expr.node[i];
	struct literal *literal = &s->literal[i];
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = mean(s, node, &why);
	const struct enum_value *value = value_named(s, node, m);
	struct il_result out = unknown();
	char text[2 * LIMIT_ARG], name[LIMIT_ARG];

	if (value)
		return take_value(s, value, literal);
	if (m && m->several) {
		m = NULL;
		why = DIAG_AMBIGUOUS_VALUE;
	}
	if (!m) {
		snprintf(name, sizeof(name), "%.*s", node->len, node->text);
		/* What another tool calls so is no constant. */
		if (advice_word(s->project, s->pou, EXPECT_VARIABLE, s->fn.diags, name, text,
				sizeof(text)) != DIAG_COUNT)
			snprintf(text, sizeof(text), "%s", name);
		if (why != DIAG_UNKNOWN_NAME)
			named_tell(s->project, why, name, text, sizeof(text));
		il_report(&s->fn, &s->line, why, text);
		return out;
	}
	if (m->kind == MEANING_LITERAL) {
		*literal = m->literal;
		return take_parsed(literal);
	}
	if (!is_constant(s, m)) {
		refuse(s, DIAG_NOT_CONSTANT, node->text, node->len);
		return out;
	}
	if (m->var->written && m->var->written->state == STATE_FAILED)
		return out;
	out.type = m->type;
	out.text = names_intern(&s->project->names, node->text, node->len);
	if (m->type == IEC_STRING) {
		const uint32_t id = var_value_text(m->var);

		literal_parse(project_text(s->project, id), names_len(&s->project->names, id),
			      literal);
		return out;
	}
	out.known = true;
	out.value = m->var->init;
	return out;
}

static struct il_result take_literal(struct settle *s, int i, const char *text, size_t len)
{
	struct literal *literal = &s->literal[i];
	enum literal_result result = literal_parse(text, len, literal);
	struct il_result out = unknown();

	if (result != LITERAL_OK) {
		refuse(s, result == LITERAL_RANGE ? DIAG_LITERAL_RANGE : DIAG_BAD_LITERAL, text, len);
		return out;
	}
	return take_parsed(literal);
}

/* ---- functions ---- */

/* Both integers, and each value of @from is one of @to. */
static bool may_widen(enum iec_type from, enum iec_type to)
{
	return iec_type_row(from)->class & ANY_INT && iec_type_row(to)->class & ANY_INT &&
	       iec_can_widen(from, to);
}

/* Integers of narrower types are used as the wanted one, so that INT constants may give a DINT. */
static void widen(struct settle *s, const struct word_row *row, int count, enum iec_type wanted)
{
	for (int i = 0; word_shares(row) && i < count; i++)
		if (!word_input(row, (uint32_t)i)->own && may_widen(s->in[i].type, wanted))
			s->in[i].type = wanted;
}

/* A function of s->in. */
static struct il_result run(struct settle *s, enum word word, int count, enum iec_type wanted,
			    bool named)
{
	struct il_line line = s->line;
	const struct word_row *row;
	struct il_result out = unknown();
	enum iec_type common = IEC_NONE;

	if (count == 2)
		word = fn_overload(word, s->in[0].type, s->in[1].type);
	for (int i = 0; i < count; i++)
		if (il_is_unknown(s->in[i]))
			return out;
	row = scope_row(s->scope, word);
	widen(s, row, count, wanted);
	line.kind = IL_FN;
	line.operand = 0;
	line.word = (uint16_t)word;
	line.mark = named ? IL_NAMED : 0;
	if (!il_check_inputs(&s->fn, &line, s->in, count, wanted, &common))
		return out;
	if (s->fn.has_constant)
		return il_function_result(&s->fn, fn_result(row, common, wanted));
	refuse(s, DIAG_NOT_COMPUTED, row->word, strlen(row->word));
	return out;
}

static enum word function_of(const struct expr_node *node)
{
	switch (node->op) {
	case EXPR_NEG:
		return FN_NEG;
	case EXPR_NOT:
		return op_function(OP_NOT);
	case EXPR_AND:
		return op_function(OP_AND);
	case EXPR_OR:
		return op_function(OP_OR);
	case EXPR_XOR:
		return op_function(OP_XOR);
	case EXPR_FN:
		return node->fn;
	case EXPR_NAME:
	case EXPR_INDEX:
	case EXPR_BIT:
	case EXPR_LITERAL:
	case EXPR_CALL:
	case EXPR_ARG:
		break;
	}
	return WORD_COUNT;
}

static void refuse_call(struct settle *s, enum diag_id why, const struct expr_node *call,
			const struct word_row *row, const struct expr_args *args)
{
	char text[LIMIT_ARG], pin[LIMIT_ARG];

	if (args->wrong >= 0)
		expr_pin_name(row, args->wrong, pin, sizeof(pin));
	else if (args->len || why != DIAG_NO_PIN)
		snprintf(pin, sizeof(pin), "%.*s", args->len, args->text);
	else
		snprintf(pin, sizeof(pin), "%d", args->number);
	snprintf(text, sizeof(text), "%.*s%s%.24s", call->len < 30 ? call->len : 30, call->text,
		 *pin ? "." : "", pin);
	il_report(&s->fn, &s->line, why, text);
}

/* The function of a call and its arguments; WORD_COUNT after a diagnostic. */
static enum word find_call(struct settle *s, const struct expr_node *call,
			   struct expr_args *args)
{
	struct word_table *words = &s->project->words;
	const enum word word = expr_function(words, call);
	enum diag_id why;

	*args = (struct expr_args){ .wrong = -1, .text = "" };
	if (word == WORD_COUNT) {
		refuse(s, words_find(words, call->text, call->len) == WORD_COUNT ?
		       DIAG_UNKNOWN_WORD : DIAG_NOT_FUNCTION, call->text, call->len);
		return WORD_COUNT;
	}
	if (word_is_own(word)) {
		refuse(s, DIAG_NOT_COMPUTED, call->text, call->len);
		return WORD_COUNT;
	}
	why = expr_match(&s->expr, call, words_row(words, word), args);
	if (why == DIAG_COUNT && args->count > words_row(words, word)->most_inputs) {
		refuse(s, DIAG_NOT_COMPUTED, call->text, call->len);
		return WORD_COUNT;
	}
	if (why == DIAG_COUNT)
		return word;
	refuse_call(s, why, call, words_row(words, word), args);
	return WORD_COUNT;
}

static struct il_result take_call(struct settle *s, int i)
{
	struct expr_args args;
	const enum word word = find_call(s, &s->expr.node[i], &args);

	if (word == WORD_COUNT)
		return unknown();
	for (int k = 0; k < args.count; k++)
		s->in[args.arg[k].pin] = s->value[args.arg[k].at];
	return run(s, word, args.count, s->hint[i], true);
}

static struct il_result take_node(struct settle *s, int i)
{
	const struct expr_node *node = &s->expr.node[i];
	const struct expr_node *left = node->left >= 0 ? &s->expr.node[node->left] : NULL;
	char text[LIMIT_NAME + 1];

	switch (node->op) {
	case EXPR_NAME:
		return take_name(s, i);
	case EXPR_LITERAL:
		return literal_is_named(node->text, node->len) ? take_name(s, i) :
		       take_literal(s, i, node->text, node->len);
	case EXPR_INDEX:
	case EXPR_BIT:
		refuse(s, DIAG_NOT_CONSTANT, node->text, node->len);
		return unknown();
	case EXPR_CALL:
		return take_call(s, i);
	case EXPR_ARG:
		return s->value[node->left];
	case EXPR_NEG:
		if (left->op != EXPR_LITERAL || left->len >= LIMIT_NAME)
			break;
		snprintf(text, sizeof(text), "-%.*s", left->len, left->text);
		if (s->value[node->left].literal) /* a number: so that -128 is one as well */
			return take_literal(s, i, text, left->len + 1u);
		break;
	case EXPR_NOT:
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
	case EXPR_FN:
		break;
	}
	s->in[0] = s->value[node->left];
	if (node->right >= 0)
		s->in[1] = s->value[node->right];
	return run(s, function_of(node), node->right >= 0 ? 2 : 1, s->hint[i], false);
}

/* ---- types ---- */

/* The type of a node from those of its parts, which come before it. */
static enum iec_type infer(struct settle *s, int i)
{
	const struct expr_node *node = &s->expr.node[i];
	const struct meaning *m;
	struct literal literal;
	struct expr_args args;
	enum iec_type type = IEC_NONE;
	enum word word;
	enum diag_id why;

	switch (node->op) {
	case EXPR_NAME:
		if (wanted_value(s, node))
			return s->project->enumeration[s->values - 1].type;
		m = mean(s, node, &why);
		return m ? m->type : IEC_NONE;
	case EXPR_LITERAL:
		if (literal_is_named(node->text, node->len)) {
			m = mean(s, node, &why);
			return m ? m->type : IEC_NONE;
		}
		return literal_parse(node->text, node->len, &literal) == LITERAL_OK ?
		       literal.type : IEC_NONE;
	case EXPR_ARG:
	case EXPR_NEG:
	case EXPR_NOT:
		return s->type[node->left];
	case EXPR_CALL:
		word = expr_function(&s->project->words, node);
		args = (struct expr_args){ .wrong = -1, .text = "" };
		if (word == WORD_COUNT || word_is_own(word) || expr_match(&s->expr, node,
			words_row(&s->project->words, word), &args) != DIAG_COUNT)
			return IEC_NONE;
		for (int k = 0; k < args.count; k++)
			if (!word_input(scope_row(s->scope, word), (uint32_t)args.arg[k].pin)->own)
				type = types_join(type == IEC_TYPE_COUNT ? IEC_NONE : type,
						  s->type[args.arg[k].at]);
		return word_shares(scope_row(s->scope, word)) && type != IEC_TYPE_COUNT ? type :
		       fn_result(scope_row(s->scope, word), IEC_NONE, IEC_NONE);
	case EXPR_INDEX:
	case EXPR_BIT:
		return IEC_NONE;
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
	case EXPR_FN:
		break;
	}
	if (node->op == EXPR_FN && word_is_test(word_row(node->fn)))
		return IEC_BOOL;
	word = node->op == EXPR_FN ? fn_overload(node->fn, s->type[node->left],
						 s->type[node->right]) : WORD_COUNT;
	if (word != WORD_COUNT && word != node->fn)
		return fn_result(word_row(word), s->type[node->left], IEC_NONE);
	type = types_join(s->type[node->left], s->type[node->right]);
	return type == IEC_TYPE_COUNT ? IEC_NONE : type;
}

/* Constants without a type take that of their neighbours, or the one that is wanted. */
static void pass_hint(struct settle *s, int i)
{
	const struct expr_node *node = &s->expr.node[i];
	enum iec_type type = s->hint[i], sides;
	struct expr_args args;
	enum word word;

	switch (node->op) {
	case EXPR_NAME:
	case EXPR_LITERAL:
	case EXPR_INDEX:
	case EXPR_BIT:
		return;
	case EXPR_CALL:
		word = expr_function(&s->project->words, node);
		args = (struct expr_args){ .wrong = -1, .text = "" };
		if (word == WORD_COUNT || word_is_own(word) || expr_match(&s->expr, node,
			words_row(&s->project->words, word), &args) != DIAG_COUNT)
			return;
		if (!word_shares(scope_row(s->scope, word)))
			type = IEC_NONE;
		else if (s->type[i] != IEC_NONE && !may_widen(s->type[i], type))
			type = s->type[i];
		for (int k = 0; k < args.count; k++) {
			const struct word_pin *pin = word_input(scope_row(s->scope, word),
								(uint32_t)args.arg[k].pin);

			s->hint[args.arg[k].at] = pin->own ? IEC_NONE :
						  pin->type != IEC_NONE ? pin->type : type;
		}
		return;
	case EXPR_ARG: /* by its call */
		return;
	case EXPR_NEG:
	case EXPR_NOT:
		break;
	case EXPR_FN:
		if (fn_overload(node->fn, s->type[node->left], s->type[node->right]) != node->fn ||
		    word_is_test(word_row(node->fn)))
			type = IEC_NONE;
		/* fall through */
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		sides = types_join(s->type[node->left], s->type[node->right]);
		if (sides != IEC_NONE && sides != IEC_TYPE_COUNT && !may_widen(sides, type))
			type = sides;
		s->hint[node->right] = type;
		break;
	}
	s->hint[node->left] = type;
}

/* ---- one expression ---- */

/* @behind: the sign that ends the text, "" if nothing does; a message may name it. */
static bool parse(struct settle *s, const char *text, size_t len, const char *behind)
{
	struct diag place = il_place(s->scope, s->fn.pou, &s->line, DIAG_BAD_EXPRESSION);
	struct diag_list *diags = s->fn.diags;
	const int count = diags->count;
	struct token last = { .text = "" };
	struct lex lex;
	bool good;

	lex_init(&lex, text, len + (*behind != '\0'));
	lex_next(&lex);
	good = expr_parse(&lex, &s->expr, diags, place);
	if (!good && lex.token.kind == TOKEN_END && diags->count > count && len) {
		lex_init(&lex, text, len); /* an end has no text: its last word */
		while (lex_next(&lex) != TOKEN_END)
			last = lex.token;
		snprintf(diags->diag[diags->count - 1].arg, sizeof(diags->diag[0].arg), "%.*s",
			 (int)(last.len < LIMIT_ARG ? last.len : LIMIT_ARG), last.text);
	}
	if (good && lex.token.text < text + len)
		return refuse(s, DIAG_BAD_EXPRESSION, lex.token.text, lex.token.len);
	if (diags->count > count) /* not its column in the text */
		diags->diag[diags->count - 1].column = place.column;
	return good;
}

/* The value of s->expr, of any type. */
static struct il_result compute(struct settle *s, enum iec_type wanted)
{
	for (int i = 0; i < s->expr.count; i++) {
		s->type[i] = infer(s, i);
		s->hint[i] = IEC_NONE;
	}
	s->hint[s->expr.root] = wanted;
	for (int i = s->expr.count - 1; i >= 0; i--)
		pass_hint(s, i);
	for (int i = 0; i < s->expr.count; i++)
		s->value[i] = take_node(s, i);
	return s->value[s->expr.root];
}

/* Makes @from a value of @type; @text: as written. */
static bool convert(struct settle *s, struct il_result from, enum iec_type type,
		    union iec_value *out)
{
	if (il_is_unknown(from))
		return false;
	if (from.literal)
		return literal_fit(from.literal, type, out) ||
		       il_report_constant(&s->fn, &s->line, from.literal, type);
	s->line.operand = from.text;
	if (!iec_can_widen(from.type, type))
		return il_report_types(&s->fn, &s->line, from.type, type);
	*out = from.value;
	if (iec_type_row(type)->class == CLASS_REAL && iec_type_row(from.type)->class != CLASS_REAL)
		out->r = (double)from.value.i;
	return true;
}

/* @value as an integer: of a bound, a length, a count of repetitions. */
static bool take_any_integer(struct settle *s, struct il_result value, int64_t *out)
{
	union iec_value number;

	if (il_is_unknown(value))
		return false;
	if (!value.literal && !(iec_type_row(value.type)->class & ANY_INT)) {
		s->line.operand = value.text;
		return il_report_types(&s->fn, &s->line, value.type, IEC_DINT);
	}
	if (!convert(s, value, value.literal ? IEC_LINT : value.type, &number))
		return false;
	*out = number.i;
	return true;
}

/* The value of s->expr as one of @out->type; IEC_NONE: as an integer of any type. */
static bool compute_value(struct settle *s, struct init_value *out)
{
	const struct il_result value = compute(s, out->type == IEC_NONE ? IEC_DINT : out->type);
	char text[64];
	uint32_t id;

	s->line.operand = 0;
	if (out->type == IEC_NONE)
		return take_any_integer(s, value, &out->value.i);
	if (out->type == IEC_STRING && value.type == IEC_STRING) {
		const struct literal *literal = &s->literal[s->expr.root];

		out->literal = *literal;
		id = names_intern(&s->project->names, literal->text - 1, literal->len + 2);
		out->text = project_text(s->project, id);
		out->len = literal->len + 2;
		return id != 0;
	}
	if (!convert(s, value, out->type, &out->value))
		return false;
	literal_print(out->type, out->value, text, sizeof(text));
	id = names_intern(&s->project->names, text, strlen(text));
	out->text = project_text(s->project, id);
	out->len = strlen(text);
	out->literal = (struct literal){ .type = out->type, .value = out->value };
	return id != 0;
}

/* ---- one declaration ---- */

static struct var *var_of(struct settle *s, const struct var_written *written)
{
	return &table_of(s->project, written->table)->var[written->index];
}

/* The value of an enumeration that @written is of; NULL: of a variable. */
static struct enum_value *value_of(struct settle *s, const struct var_written *written)
{
	return written->table == VALUES ? &s->project->enum_value[written->index] : NULL;
}

static const char *name_of(struct settle *s, const struct var_written *written)
{
	const struct enum_value *value = value_of(s, written);

	return project_text(s->project, value ? value->name : var_of(s, written)->name);
}

#define CIRCLE_MOST 8 /* names of a circle that a message shows */

/* "A -> B -> A": @again is needed again. */
static void report_circle(struct settle *s, const struct var_written *again)
{
	const struct var_written *chain[CIRCLE_MOST];
	char text[2 * LIMIT_ARG];
	size_t used;
	int count = 0;

	for (const struct var_written *at = s->top; at && at != again; at = at->below)
		chain[count++ % CIRCLE_MOST] = at;
	used = (size_t)snprintf(text, sizeof(text), "%.40s",
				name_of(s, again));
	for (int i = count - 1; i >= 0 && i > count - 1 - CIRCLE_MOST && used < LIMIT_ARG; i--)
		used += (size_t)snprintf(text + used, sizeof(text) - used, " -> %.40s",
			name_of(s, chain[i % CIRCLE_MOST]));
	if (used < LIMIT_ARG)
		snprintf(text + used, sizeof(text) - used, " -> %.40s",
			 name_of(s, again));
	il_report(&s->fn, &s->line, DIAG_CONSTANT_CIRCLE, text);
}

/* Puts a constant on top that must be computed first. False after a diagnostic. */
static bool need(struct settle *s, struct var_written *first)
{
	if (first->state == STATE_WORKING) {
		report_circle(s, first);
		return false;
	}
	first->state = STATE_WORKING;
	first->below = s->top;
	s->top = first;
	return true;
}

enum outcome { FAILED, WAITS, GOOD };

/* Parses the text @id at @where of @w; what it names is computed first. */
static enum outcome open_text(struct settle *s, const struct var_written *w,
			      enum written_place where, uint32_t id)
{
	struct var_written *first;

	s->line.line = (uint32_t)w->at[where].line;
	s->line.col = (uint16_t)w->at[where].column;
	if (!parse(s, project_text(s->project, id), names_len(&s->project->names, id), ""))
		return FAILED;
	first = find_open(s);
	if (!first)
		return GOOD;
	return need(s, first) ? WAITS : FAILED;
}

static enum outcome take_integer(struct settle *s, const struct var_written *w,
				 enum written_place where, uint32_t id, int64_t *out)
{
	const enum outcome opened = open_text(s, w, where, id);

	if (opened != GOOD)
		return opened;
	return take_any_integer(s, compute(s, IEC_DINT), out) ? GOOD : FAILED;
}

static enum outcome refuse_bounds(struct settle *s, const struct var_written *w, int64_t low,
				  int64_t high)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%lld..%lld", (long long)low, (long long)high);
	s->line.line = (uint32_t)w->at[WRITTEN_LOW].line;
	s->line.col = (uint16_t)w->at[WRITTEN_LOW].column;
	if (!s->line.line) {
		s->line.line = (uint32_t)w->at[WRITTEN_HIGH].line;
		s->line.col = (uint16_t)w->at[WRITTEN_HIGH].column;
	}
	il_report(&s->fn, &s->line, DIAG_BAD_BOUNDS, text);
	return FAILED;
}

/* @text: of one dimension, which goes to @out. */
static enum outcome settle_dimension(struct settle *s, struct var_written *w,
				     const uint32_t text[2], struct var_array *out)
{
	int64_t bound[2] = { 0, 0 };
	enum outcome outcome;

	for (int i = 0; i < 2; i++) {
		outcome = take_integer(s, w, i ? WRITTEN_HIGH : WRITTEN_LOW, text[i], &bound[i]);
		if (outcome != GOOD)
			return outcome;
	}
	if (bound[0] < INT32_MIN || bound[1] > INT32_MAX || bound[0] > bound[1] ||
	    bound[1] - bound[0] >= LIMIT_ELEMENTS)
		return refuse_bounds(s, w, bound[0], bound[1]);
	*out = (struct var_array){ (int32_t)bound[0], (uint32_t)(bound[1] - bound[0] + 1) };
	return GOOD;
}

static enum outcome settle_bounds(struct settle *s, struct var_written *w, struct var *var)
{
	const int own = w->dim ? var->own_dims : 1;
	enum outcome outcome;

	for (int i = 0; i < own; i++) {
		outcome = settle_dimension(s, w, w->dim ? w->dim[i] : w->bound, &var->dim[i]);
		if (outcome != GOOD)
			return outcome;
	}
	var->array = vars_flat(var->dim, var->dims);
	return var->array.count <= LIMIT_ELEMENTS ? GOOD :
	       refuse_bounds(s, w, 0, (int64_t)var->array.count - 1);
}

static enum outcome settle_capacity(struct settle *s, struct var_written *w, struct var *var)
{
	int64_t capacity = 0;
	enum outcome outcome = take_integer(s, w, WRITTEN_CAPACITY, w->capacity, &capacity);
	char text[LIMIT_ARG];

	if (outcome != GOOD)
		return outcome;
	if (capacity >= 1 && capacity <= IEC_STRING_MOST) {
		var->capacity = (uint16_t)capacity;
		return GOOD;
	}
	snprintf(text, sizeof(text), "%lld", (long long)capacity);
	il_report(&s->fn, &s->line, DIAG_LITERAL_RANGE, text);
	return FAILED;
}

static enum outcome settle_range(struct settle *s, struct var_written *w, struct var *var)
{
	int64_t limit[2] = { 0, 0 };
	enum outcome outcome;
	char text[LIMIT_ARG];

	for (int i = 0; i < 2; i++) {
		outcome = take_integer(s, w, i ? WRITTEN_MOST : WRITTEN_LEAST, w->range[i], &limit[i]);
		if (outcome != GOOD)
			return outcome;
	}
	*var->range = (struct var_range){ limit[0], limit[1] };
	if (var_range_fits(var->range) && limit[0] >= iec_type_row(var->type)->low &&
	    limit[1] <= iec_type_row(var->type)->high)
		return named_default(s->project, var) ? GOOD : FAILED;
	snprintf(text, sizeof(text), "%lld..%lld", (long long)limit[0], (long long)limit[1]);
	il_report(&s->fn, &s->line, DIAG_BAD_RANGE, text);
	return FAILED;
}

/* In plain IEC text, not a constant. */
static bool may_begin(struct settle *s, const struct var_written *w)
{
	return s->project->words.own_first &&
	       !(vars_flags(table_of(s->project, w->table), w->index) & VAR_CONSTANT);
}

static enum outcome settle_plain(struct settle *s, struct var_written *w, struct var *var)
{
	struct init_value value = { .type = var->type, .capacity = var->capacity };
	enum outcome outcome;

	s->begins = may_begin(s, w);
	outcome = open_text(s, w, WRITTEN_INITIAL, var->init_text);
	if (outcome != GOOD)
		return outcome;
	if (!compute_value(s, &value))
		return FAILED;
	var->init = value.value;
	w->value = names_intern(&s->project->names, value.text, value.len);
	return GOOD;
}

/* The table in which the list of an enumeration stands; 0: none of a POU. */
static int table_with(const struct project *project, int enumeration)
{
	for (int i = 0; !project->enumeration[enumeration].name && i < project->pou_count; i++)
		for (int k = 0; k < project->pou[i].vars.count; k++)
			if (project->pou[i].vars.var[k].enumeration == enumeration + 1)
				return i + 1;
	return 0;
}

/* The number of a value of an enumeration. */
static enum outcome settle_number(struct settle *s, struct var_written *w, struct enum_value *value)
{
	const enum iec_type type = s->project->enumeration[value->enumeration].type;
	struct init_value number = { .type = type };
	enum outcome outcome;

	enter(s, table_with(s->project, value->enumeration), w->file);
	s->values = value->enumeration + 1;
	if (value->text) {
		outcome = open_text(s, w, WRITTEN_INITIAL, value->text);
		if (outcome != GOOD)
			return outcome;
		if (!compute_value(s, &number))
			return FAILED;
		value->number = number.value.i;
	} else if (is_open(value[-1].written)) {
		return need(s, value[-1].written) ? WAITS : FAILED;
	} else if (value[-1].written && value[-1].written->state == STATE_FAILED) {
		return FAILED;
	} else {
		value->number = value[-1].number + 1;
	}
	if (value->number >= iec_type_row(type)->low && value->number <= iec_type_row(type)->high)
		return GOOD;
	s->line.line = (uint32_t)w->at[WRITTEN_INITIAL].line;
	s->line.col = (uint16_t)w->at[WRITTEN_INITIAL].column;
	il_report(&s->fn, &s->line, DIAG_LITERAL_RANGE, project_text(s->project, value->name));
	return FAILED;
}

static enum outcome settle_one(struct settle *s, struct var_written *w)
{
	struct var *var = value_of(s, w) ? NULL : var_of(s, w);
	enum outcome outcome = GOOD;

	s->begins = false;
	if (!var)
		return settle_number(s, w, value_of(s, w));

	if (is_open(w->type))
		return need(s, w->type) ? WAITS : FAILED;
	if (w->type && w->type->state == STATE_FAILED)
		return FAILED;
	if (var->named && !named_take(s->project, var))
		return FAILED;
	s->shapes |= w->type != NULL;
	enter(s, w->table, w->file);
	s->values = var->enumeration;
	if (w->bound[0] || w->dim)
		outcome = settle_bounds(s, w, var);
	if (outcome == GOOD && w->capacity)
		outcome = settle_capacity(s, w, var);
	if (outcome == GOOD && w->range[0])
		outcome = settle_range(s, w, var);
	if (outcome == GOOD && w->initial && var->type != IEC_NONE && !var->array.count)
		outcome = settle_plain(s, w, var);
	s->shapes |= outcome == GOOD && (w->bound[0] || w->dim || w->capacity);
	return outcome;
}

/* Of `A, B : INT := 2 * N` the second variable is as the first. */
static void copy_from(const struct var *first, struct var *var)
{
	struct var_written *w = var->written;

	w->state = first->written->state;
	w->value = first->written->value;
	var->array = first->array;
	var->capacity = first->capacity;
	var->init = first->init;
	var->init_count = first->init_count;
}

/* Computes @w and all that it needs. */
static void settle_with(struct settle *s, struct var_written *w)
{
	if (w->state != STATE_OPEN)
		return;
	need(s, w);
	while (s->top) {
		struct var_written *top = s->top;
		struct var *var = top->again ? var_of(s, top) : NULL;
		struct var_written *before = var && top->index ? var[-1].written : NULL;
		enum outcome outcome = GOOD;

		if (is_open(before))
			outcome = need(s, before) ? WAITS : FAILED;
		else if (!before)
			outcome = settle_one(s, top);
		if (outcome == WAITS)
			continue;
		top->state = outcome == GOOD ? STATE_DONE : STATE_FAILED;
		s->top = top->below;
		if (before && outcome == GOOD)
			copy_from(&var[-1], var);
	}
}

/* ---- lists and structures ---- */

static bool add(struct settle *s, const char *text, size_t len)
{
	struct text *to = &s->made;

	if (to->len + len > to->size) {
		const size_t size = 2 * (to->len + len) + 64;
		char *larger = arena_grow(s->scratch, to->text, to->len, size);

		if (!larger)
			return false;
		to->text = larger;
		to->size = size;
	}
	memcpy(to->text + to->len, text, len);
	to->len += len;
	return true;
}

/* Adds the text up to @from, and @to in place of what ends at @behind. */
static bool replace(struct settle *s, const char *from, const char *behind, const char *to,
		    size_t len)
{
	if (!add(s, s->copied, (size_t)(from - s->copied)) || !add(s, to, len))
		return false;
	s->copied = behind;
	return true;
}

/* The enumeration of the present value of the walk, that of its member or of the variable, + 1; 0: none. */
static int values_wanted(const struct settle *s)
{
	for (int i = s->walk.depth; i-- > 0;) {
		const struct init_level *level = &s->walk.level[i];
		const struct var_table *table = level->row ? shape_vars(s->project, level->word) : NULL;

		if (level->row)
			return table && level->pin >= 0 && level->pin < table->count ?
			       table->var[level->pin].enumeration : 0;
	}
	return s->walk.var->enumeration;
}

/* Called by the walk for each expression in a list, and for the n of n( … ). */
static enum diag_id fold_value(void *context, const char *text, size_t len,
			       struct init_value *out)
{
	struct settle *s = context;
	const bool count = out->type == IEC_NONE;
	char number[24];
	int digits;

	s->values = values_wanted(s);
	/* Behind a count there is a (, which would make a call of it. */
	s->reported = !parse(s, text, len, count ? "" : text + len) || !compute_value(s, out);
	if (s->reported || !count)
		return s->reported ? DIAG_NOT_CONSTANT : DIAG_COUNT;
	digits = snprintf(number, sizeof(number), "%lld", (long long)out->value.i);
	return replace(s, text, text + len, number, (size_t)digits) ? DIAG_COUNT : DIAG_NO_MEMORY;
}

/* Walks the text of @var; the values become those of its list, and a text of constants. */
static bool walk(struct settle *s, struct var *var)
{
	const char *text = project_text(s->project, var->init_text);
	const char *end = text + names_len(&s->project->names, var->init_text);
	struct init_value value;
	uint32_t next = 0;

	s->made = (struct text){ NULL, 0, 0 };
	s->copied = text;
	while (init_next(&s->walk, &value)) {
		if (var->type != IEC_NONE && !init_keep(&s->walk, s->project, var, &value, &next))
			return false;
		if (!replace(s, s->walk.from, s->walk.behind, value.text, value.len))
			return false;
	}
	return add(s, s->copied, (size_t)(end - s->copied));
}

/* A mistake in the form of a structure is left to check_names(), which walks it again; it sees
 * numbers in place of counts. */
static bool is_ours(const struct init_walk *walk, const struct var *var)
{
	return walk->why != DIAG_COUNT &&
	       (var->type != IEC_NONE || walk->why == DIAG_REPEAT_NONE ||
		walk->why == DIAG_REPEAT_MANY || walk->why == DIAG_REPEAT_KIND);
}

/* False when memory is out. */
static bool settle_parts(struct settle *s, struct var_written *w, struct var *var)
{
	struct diag place;

	enter(s, w->table, w->file);
	s->values = var->enumeration;
	s->line.line = (uint32_t)w->at[WRITTEN_INITIAL].line;
	s->line.col = (uint16_t)w->at[WRITTEN_INITIAL].column;
	s->reported = false;
	s->begins = may_begin(s, w);
	w->value = 0;
	init_begin(&s->walk, s->project, var, s->scratch);
	s->walk.fold = (struct init_fold){ fold_value, s, &s->project->words };
	if (var->type != IEC_NONE) {
		var->init_list = NULL;
		var->init_count = 0;
	}
	if (!walk(s, var))
		return false;
	place = il_place(s->scope, s->fn.pou, &s->line, DIAG_COUNT);
	place.column = 0;
	if (!s->reported && is_ours(&s->walk, var))
		init_report(s->project, var, &s->walk, s->fn.diags, place);
	w->value = names_intern(&s->project->names, s->made.text, s->made.len);
	return w->value != 0;
}

static bool has_list(const struct var *var)
{
	return var->written->initial && (var->type == IEC_NONE || var->array.count);
}

/* ---- the project ---- */

/* Calls @act for each variable with expressions, in the order of the tables. */
static bool each(struct settle *s, bool (*act)(struct settle *s, struct var *var, int table, int index))
{
	const int tables = last_table(s->project);

	for (int i = 0; i <= tables; i++) {
		struct var_table *table = table_of(s->project, i);

		for (int k = 0; k < table->count; k++)
			if (table->var[k].written && !act(s, &table->var[k], i, k))
				return false;
	}
	return true;
}

static bool name_one(struct settle *s, struct var *var, int table, int index)
{
	(void)s;
	var->written->state = STATE_OPEN;
	var->written->table = table;
	var->written->index = index;
	return true;
}

static bool number_one(struct settle *s, struct var *var, int table, int index)
{
	(void)table;
	(void)index;
	settle_with(s, var->written);
	return true;
}

static bool list_one(struct settle *s, struct var *var, int table, int index)
{
	(void)table;
	if (var->written->state != STATE_DONE || !has_list(var))
		return true;
	if (var->written->again && index) {
		copy_from(&var[-1], var);
		return true;
	}
	return settle_parts(s, var->written, var) && named_default(s->project, var);
}

/* Initial values of arrays and structures that come from a named type. */
static bool inherit_one(struct settle *s, struct var *var, int table, int index)
{
	(void)table;
	(void)index;
	return !var->named || !var->inherits || named_take(s->project, var);
}

/* Has an enumeration numbers that are expressions? */
static bool has_numbers(const struct project *project)
{
	for (int i = 0; i < project->enum_value_count; i++)
		if (project->enum_value[i].written)
			return true;
	return false;
}

/* The numbers of enumerations; variables that begin with one of them get it again. */
static bool settle_numbers(struct settle *s)
{
	struct project *project = s->project;
	const int errors = s->fn.diags->errors;

	for (int i = 0; i < project->enum_value_count; i++)
		if (project->enum_value[i].written) {
			project->enum_value[i].written->state = STATE_OPEN;
			project->enum_value[i].written->table = VALUES;
			project->enum_value[i].written->index = i;
		}
	for (int i = 0; i < project->enum_value_count; i++)
		if (project->enum_value[i].written)
			settle_with(s, project->enum_value[i].written);
	return s->fn.diags->errors == errors && project_resolve(project, s->fn.diags);
}

static bool has_any(struct project *project)
{
	const int tables = last_table(project);

	for (int i = 0; i <= tables; i++) {
		const struct var_table *table = table_of(project, i);

		for (int k = 0; k < table->count; k++)
			if (table->var[k].written)
				return true;
	}
	return has_numbers(project);
}

static bool no_memory(struct project *project, struct diag_list *diags)
{
	return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
}

/* Names and numbers of all declarations are settled. NULL: no memory, or a number has no value. */
static struct settle *settled_names(struct project *project, struct arena *scratch, struct diag_list *diags)
{
	struct settle *s = settle_new(project, scratch, diags);

	if (!s) {
		no_memory(project, diags);
		return NULL;
	}
	each(s, name_one);
	if (has_numbers(project) && !settle_numbers(s))
		return NULL;
	each(s, number_one);
	return s;
}

bool settle_project(struct project *project, struct arena *scratch, struct diag_list *diags)
{
	const int errors = diags->errors;
	struct settle *s;

	if (!has_any(project))
		return true;
	s = settled_names(project, scratch, diags);
	if (!s)
		return false;
	if (diags->errors == errors && s->shapes && !shape_make(project, diags))
		return false;
	if (diags->errors == errors && (!each(s, list_one) || !each(s, inherit_one)))
		return no_memory(project, diags);
	if (scratch->failed || project->arena.failed)
		return no_memory(project, diags);
	return diags->errors == errors;
}

bool settle_var(struct project *project, int table, int index, struct arena *scratch,
		struct diag_list *diags)
{
	const int errors = diags->errors;
	struct var *var = &table_of(project, table)->var[index];
	struct settle *s;

	if (!var->written)
		return true;
	s = settled_names(project, scratch, diags);
	if (!s)
		return false;
	if (diags->errors == errors)
		list_one(s, var, table, index);
	return diags->errors == errors;
}

bool settle_value(struct project *project, int table, const char *text, size_t len,
		  struct init_value *out, struct arena *scratch, struct diag_list *diags)
{
	struct settle *s = settle_new(project, scratch, diags);

	if (!s)
		return no_memory(project, diags);
	enter(s, table, NULL);
	return parse(s, text, len, "") && compute_value(s, out);
}
