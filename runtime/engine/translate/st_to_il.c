/* SPDX-License-Identifier: MIT
 *
 * st_to_il - Structured Text as an instruction list (docs/st.md).
 *
 * Expressions are those of ladders (ld_expr.c); blocks become labels and jumps. A FOR and a CASE
 * keep what they compute once in temporaries until their end.
 */
#include "engine/check/letters.h"
#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/check/mixed.h"
#include "engine/check/split.h"
#include "engine/check/values.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/translate/ladder_unit.h"

#include <stdio.h>
#include <string.h>

/* How many temporaries are in use. */
struct level { int bools, numbers[IEC_TYPE_COUNT]; };

/* A block that is not closed yet. Labels are numbers from 1; 0: none. */
struct st_open {
	enum st_kind kind;
	uint32_t next;        /* IF: the next ELSIF, ELSE or END_IF; CASE: the next choice */
	uint32_t out;         /* behind the block                             */
	uint32_t again;       /* of a loop: its next round                    */
	uint32_t top;         /* of a loop: its beginning                     */
	uint32_t variable, by, to; /* of FOR: operands                        */
	bool bits;            /* of FOR: its variable is a bit string         */
	bool once;            /* of FOR: one more step cannot overflow        */
	uint32_t near;        /* of FOR: a BOOL, FALSE: likewise; 0: it is not known */
	int choices;          /* of CASE: so far                              */
	uint32_t first;       /* of CASE: number of the first label           */
	struct level level;   /* before it                                    */
};

/* The call that is being translated. */
struct st_call {
	struct il_line line[LIMIT_ARGS]; /* its arguments                     */
	uint32_t inverse[LIMIT_ARGS];    /* of NOT Q => place: place; 0: of another argument */
	uint32_t part[LIMIT_ARGS];       /* of Q => Word.3: the assignment behind the call; 0: likewise */
	int count;
	uint32_t skip;       /* label behind the call; 0: none                */
};

/* The values of a CASE so far, from the first to the last of each range. */
struct st_range { int64_t low, high; };

struct st_il {
	struct ld ld;
	struct st_range *range;
	int ranges;
	struct st_call call;
	struct translation *translation;
	const struct pou *pou;
	struct st_open open[LIMIT_ST_DEPTH];
	int depth;
	uint32_t labels;      /* made so far                                  */
	uint32_t leave;       /* behind the statements of a box; 0: RETURN leaves the POU */
	struct st_labels *named; /* those that are written; NULL: none, or not looked for */
	uint32_t first_named; /* the number of the first of them              */
	int first, count;     /* the items of the body                        */
	uint8_t *used;        /* by label: a jump leads there                 */
	uint32_t used_size;
};

/* ---- instructions ---- */

static uint32_t st_label(struct st_il *s, uint32_t number)
{
	char text[16];
	const int len = snprintf(text, sizeof(text), "_S%u", (unsigned)number);
	const uint32_t id = names_intern(&s->translation->project->names, text, (size_t)len);

	s->ld.failed |= !id;
	return id;
}

static uint32_t new_label(struct st_il *s)
{
	return ++s->labels;
}

static void use_label(struct st_il *s, uint32_t label)
{
	if (label >= s->used_size) {
		const uint32_t size = label < 32 ? 64 : 2 * label;
		uint8_t *grown = arena_grow(s->ld.scratch, s->used, s->used_size, size);

		s->ld.failed |= !grown;
		s->used = grown ? grown : s->used;
		s->used_size = grown ? size : s->used_size;
	}
	if (label < s->used_size)
		s->used[label] = 1;
}

/* Labels that no jump names are left out: a label ends what can be joined. */
static void here(struct st_il *s, uint32_t label)
{
	if (label < s->used_size && s->used[label])
		ld_emit_line(&s->ld, (struct il_line){ .kind = IL_LABEL, .operand = st_label(s, label) });
}

/* A label to which a jump further down leads. */
static void here_again(struct st_il *s, uint32_t label)
{
	use_label(s, label);
	here(s, label);
}

static void jump(struct st_il *s, uint8_t modifiers, uint32_t label)
{
	use_label(s, label);
	ld_emit(&s->ld, OP_JMP, modifiers, st_label(s, label));
}

static void compare(struct st_il *s, enum word fn, uint32_t operand)
{
	ld_emit_line(&s->ld, (struct il_line){ .kind = IL_FN, .mark = IL_MADE,
					       .word = (uint16_t)fn, .operand = operand });
}

static void copy(struct st_il *s, uint32_t from, uint32_t to)
{
	ld_emit(&s->ld, OP_LD, 0, from);
	ld_emit(&s->ld, OP_ST, 0, to);
}

static struct level level_of(const struct st_il *s)
{
	struct level level = { .bools = s->ld.temps->bools };

	memcpy(level.numbers, s->ld.temps->numbers, sizeof(level.numbers));
	return level;
}

static void level_back(struct st_il *s, const struct level *level)
{
	s->ld.temps->bools = level->bools;
	memcpy(s->ld.temps->numbers, level->numbers, sizeof(level->numbers));
}

static void at_item(struct st_il *s)
{
	s->ld.line = s->ld.item->line;
	s->ld.row = s->ld.col = (uint16_t)(s->ld.item->column > UINT16_MAX ? 0 : s->ld.item->column);
}

static uint32_t st_intern(struct st_il *s, const char *text, size_t len)
{
	const uint32_t id = names_intern(&s->translation->project->names, text, len);

	s->ld.failed |= !id;
	return id;
}

/* The next part of a statement, which the check has read before. */
static bool next_part(struct st_il *s, struct st_walk *walk, struct st_part *part)
{
	if (!st_next(walk, part, s->ld.expr, s->ld.ignored, (struct diag){ .id = DIAG_COUNT }))
		return false;
	if (part->role == ST_ASSIGNED || part->role == ST_VALUE || part->role == ST_INPUT)
		letters_rewrite(s->translation->scope, s->pou, s->ld.expr);
	return true;
}

/* A simulation can stop before the next instruction: st_to_il(). */
static void begins(struct st_il *s)
{
	s->ld.begins = true;
}

/* ---- messages ---- */

static void st_report(struct st_il *s, enum diag_id id, const char *at, const char *arg)
{
	struct diag place = { .id = id, .file = s->pou->file,
			      .pou = project_text(s->translation->project, s->pou->name) };

	st_where(&s->translation->project->names, s->ld.item, at, &place.line, &place.column);
	diag_add(s->translation->diags, place, "%s", arg);
}

/* The first name or constant of the expression. */
static const char *st_said(const struct expr *expr, char *text, size_t size, enum iec_type type)
{
	const struct expr_node *node = &expr->node[0];

	for (int i = 1; i < expr->count; i++)
		if (expr->node[i].text && (!node->text || expr->node[i].text < node->text))
			node = &expr->node[i];
	snprintf(text, size, "%.*s" DIAG_AND "%s", node->len < 30 ? node->len : 30, node->text,
		 iec_type_row(type)->word);
	return node->text;
}

static void want_bool(struct st_il *s, enum iec_type type)
{
	char text[LIMIT_ARG];
	const char *at;

	const struct expr *expr = s->ld.expr;

	if (type == IEC_BOOL || (type == IEC_NONE && (expr->count == 1 ||
						      expr->node[expr->root].op == EXPR_CALL)))
		return; /* of a constant, and of a whole structure or array, check_il tells */
	at = st_said(s->ld.expr, text, sizeof(text), type);
	text[strcspn(text, DIAG_AND)] = '\0';
	st_report(s, DIAG_NOT_BOOL, at, text);
}

static void want_integer(struct st_il *s, enum iec_type type)
{
	char text[LIMIT_ARG];
	const char *at;

	if (type == IEC_NONE || iec_type_row(type)->class & (ANY_INT | CLASS_BITS))
		return;
	at = st_said(s->ld.expr, text, sizeof(text), type);
	st_report(s, DIAG_ST_INTEGER, at, text);
}

/* ---- values that are used again ---- */

/* The present value of @operand in a temporary of its own, unless it is a constant. */
static uint32_t keep(struct st_il *s, uint32_t operand, enum iec_type type)
{
	const struct meaning *m = ld_meaning(&s->ld, operand);
	uint32_t kept;

	if (!m || m->kind == MEANING_LITERAL || m->constant)
		return operand;
	kept = temps_number(s->ld.temps, type);
	copy(s, operand, kept);
	return kept;
}

/* ---- IF, WHILE, REPEAT ---- */

static struct st_open *innermost(struct st_il *s)
{
	return &s->open[s->depth - 1];
}

static struct st_open *push_block(struct st_il *s, enum st_kind kind)
{
	struct st_open *open = &s->open[s->depth++];

	*open = (struct st_open){ .kind = kind, .out = new_label(s), .level = level_of(s) };
	return open;
}

/* Jumps to @label unless the condition of the statement is TRUE. */
static void unless(struct st_il *s, struct st_walk *walk, uint32_t label)
{
	struct st_part part;
	const struct level level = level_of(s);

	if (!next_part(s, walk, &part))
		s->ld.failed = true;
	want_bool(s, ld_test(&s->ld));
	jump(s, MOD_C | MOD_N, label);
	level_back(s, &level);
}

static void begin_if(struct st_il *s, struct st_walk *walk)
{
	struct st_open *open = push_block(s, ST_IF);

	open->next = new_label(s);
	begins(s);
	unless(s, walk, open->next);
}

/* ELSIF and ELSE of an IF. */
static void other_if(struct st_il *s, struct st_walk *walk, enum st_kind kind)
{
	struct st_open *open = innermost(s);

	jump(s, 0, open->out);
	here(s, open->next);
	open->next = kind == ST_ELSIF ? new_label(s) : 0;
	if (kind != ST_ELSIF)
		return;
	begins(s);
	unless(s, walk, open->next);
}

static void end_if(struct st_il *s)
{
	const struct st_open *open = &s->open[--s->depth];

	if (open->next)
		here(s, open->next);
	here(s, open->out);
}

static void begin_while(struct st_il *s, struct st_walk *walk)
{
	struct st_open *open = push_block(s, ST_WHILE);

	open->again = new_label(s);
	here_again(s, open->again);
	begins(s);
	unless(s, walk, open->out);
}

static void begin_repeat(struct st_il *s)
{
	struct st_open *open = push_block(s, ST_REPEAT);

	open->top = new_label(s);
	open->again = new_label(s);
	here_again(s, open->top);
}

static void end_repeat(struct st_il *s, struct st_walk *walk)
{
	const struct st_open *open = innermost(s);

	here(s, open->again);
	begins(s);
	unless(s, walk, open->top);
	s->depth--;
	here(s, open->out);
}

/* ---- FOR ---- */

static enum iec_type st_type_of(struct st_il *s, uint32_t operand)
{
	const struct meaning *m = ld_meaning(&s->ld, operand);

	return m ? m->type : IEC_NONE;
}

/* A part that cannot be computed ends the loop before its first round. */
static void leave_unless(struct st_il *s, const struct st_open *open, uint32_t good)
{
	if (!good)
		return;
	ld_emit(&s->ld, OP_LD, 0, good);
	jump(s, MOD_C | MOD_N, open->out);
}

/* The next part of FOR as a value that the body cannot change. */
static uint32_t for_value(struct st_il *s, struct st_open *open, enum iec_type type)
{
	enum iec_type is = type;
	uint32_t good, operand = ld_value(&s->ld, &is, &good);

	want_integer(s, is);
	leave_unless(s, open, good);
	return keep(s, operand, is == IEC_NONE ? type : is);
}

static bool literal_value(struct st_il *s, uint32_t operand, enum iec_type type, int64_t *out)
{
	const struct meaning *m = ld_meaning(&s->ld, operand);
	union iec_value value;

	if (!m || m->kind != MEANING_LITERAL || m->several || !literal_fit(&m->literal, type, &value))
		return false;
	*out = value.i;
	return true;
}

/* The number that a bit string is. */
static uint32_t as_whole(struct st_il *s, uint32_t operand)
{
	const uint32_t out = temps_number(s->ld.temps, IEC_LINT);

	ld_call(&s->ld, FN_CONVERT);
	ld_arg(&s->ld, false, s->ld.in_id, operand);
	ld_arg(&s->ld, true, s->ld.out_id, out);
	return out;
}

/* Leaves the loop when its variable is beyond the end. */
static void leave_for(struct st_il *s, const struct st_open *open)
{
	const uint32_t now = open->bits ? as_whole(s, open->variable) : open->variable;
	int64_t by = 1;

	if (!open->by || literal_value(s, open->by, IEC_LINT, &by)) {
		ld_emit(&s->ld, OP_LD, 0, now);
		compare(s, by < 0 ? FN_LT : FN_GT, open->to);
		jump(s, MOD_C, open->out);
		return;
	}
	const uint32_t up = new_label(s), round = new_label(s), zero = st_intern(s, "0", 1);

	ld_emit(&s->ld, OP_LD, 0, open->by);
	compare(s, FN_GT, zero);
	jump(s, MOD_C, up);
	ld_emit(&s->ld, OP_LD, 0, open->by);
	compare(s, FN_EQ, zero);
	jump(s, MOD_C, open->out);
	ld_emit(&s->ld, OP_LD, 0, now);
	compare(s, FN_LT, open->to);
	jump(s, MOD_C, open->out);
	jump(s, 0, round);
	here(s, up);
	ld_emit(&s->ld, OP_LD, 0, now);
	compare(s, FN_GT, open->to);
	jump(s, MOD_C, open->out);
	here(s, round);
}

/* Does the end of the loop compare itself, without a jump to its beginning? */
static bool tests_below(struct st_il *s, const struct st_open *open)
{
	int64_t by;

	return !open->bits && (!open->by || literal_value(s, open->by, IEC_LINT, &by));
}

/* The lowest or highest value that the variable can have, as a constant of @type. */
static uint32_t for_limit(struct st_il *s, const struct st_open *open, enum iec_type type, bool high,
			  union iec_value less)
{
	const struct meaning *m = ld_meaning(&s->ld, open->variable);
	const struct iec_type_row *row = iec_type_row(type);
	union iec_value value = { .i = !high ? row->low : iec_is_wide(type) ? -1 : row->high }; /* of 64 bits */
	char text[40];
	int len;

	if (m && meaning_is_ranged(m))
		value.i = high ? m->like->range->high : m->like->range->low;
	value.i = (int64_t)((uint64_t)value.i - (uint64_t)less.i);
	len = snprintf(text, sizeof(text), "%s#", row->word);
	len += literal_print(type, value, text + len, sizeof(text) - (size_t)len);
	return st_intern(s, text, (size_t)len);
}

/* Can the variable always have the value behind the last one? */
static bool has_room(struct st_il *s, const struct st_open *open, enum iec_type type)
{
	const struct meaning *m = ld_meaning(&s->ld, open->variable);
	int64_t to, by = 1;
	struct literal literal = { .type = IEC_NONE };
	union iec_value value;

	if (!literal_value(s, open->to, type, &to) ||
	    (open->by && !literal_value(s, open->by, type, &by)) || by > INT32_MAX || by < INT32_MIN ||
	    to > INT64_MAX / 2 || to < INT64_MIN / 2)
		return false;
	literal.value.i = to + by;
	return literal_fit(&literal, type, &value) &&
	       (!m || !meaning_is_ranged(m) || (value.i >= m->like->range->low && value.i <= m->like->range->high));
}

/* Is the name at the lexer that of a REFERENCE? */
static bool leads_on(struct st_il *s, const struct lex *lex)
{
	const struct meaning *m = lex->token.kind != TOKEN_NAME ? NULL :
		ld_meaning(&s->ld, names_intern(&s->translation->project->names, lex->token.text,
						lex->token.len));

	return m && m->kind != MEANING_LITERAL && m->through;
}

/* May the statement write the variable with this name? Calls and pointers may write anything. */
static bool may_write(struct st_il *s, const struct st_item *item, uint32_t variable)
{
	const struct names *names = &s->translation->project->names;
	const char *name = names_text(names, variable);
	struct lex lex, ahead;

	if (item->kind == ST_CALL)
		return true;
	if (item->kind == ST_COMMENT)
		return false;
	for (lex_init(&lex, names_text(names, item->text), names_len(names, item->text));
	     lex_next(&lex) != TOKEN_END;) {
		ahead = lex;
		lex_next(&ahead);
		if (lex.token.kind == TOKEN_NAME && lex_is(&ahead, "(") &&
		    scope_pou(s->translation->scope, s->pou,
			      names_intern(&s->translation->project->names, lex.token.text, lex.token.len)))
			return true;
		if ((lex_is(&lex, name) && lex_is(&ahead, ":=")) || lex_is(&lex, "^") ||
		    leads_on(s, &lex))
			return true;
	}
	return false;
}

/* Does the loop that begins at item @at leave its variable alone? */
static bool is_steady(struct st_il *s, const struct st_open *open, int at)
{
	const struct st *st = s->pou->st;
	const struct meaning *m = ld_meaning(&s->ld, open->variable);
	const int depth = st->item[at].depth;

	if (!m || m->kind != MEANING_VARIABLE || m->addr.area != AREA_NONE)
		return false;
	for (int i = at + 1; i < st->count && !(st->item[i].kind == ST_END_FOR &&
						st->item[i].depth == depth); i++)
		if (may_write(s, &st->item[i], open->variable))
			return false;
	return true;
}

/* The first value; a subrange may not have it, then the loop does not run. */
static void for_begin(struct st_il *s, struct st_open *open, uint32_t from)
{
	const struct meaning *m = ld_meaning(&s->ld, open->variable);
	uint32_t good;

	if (!m || !meaning_is_ranged(m)) {
		copy(s, from, open->variable);
		return;
	}
	good = temps_bool(s->ld.temps);
	ld_call(&s->ld, FN_MOVE);
	ld_arg(&s->ld, false, s->ld.in_id, from);
	ld_arg(&s->ld, true, s->ld.eno_id, good);
	ld_arg(&s->ld, true, s->ld.out_id, open->variable);
	ld_emit(&s->ld, OP_LD, 0, good);
	jump(s, MOD_C | MOD_N, open->out);
}

/* A fact about the constant end of a FOR, found once, saves a test of the variable in each round. */
static void note_end(struct st_il *s, struct st_open *open, enum iec_type type)
{
	union iec_value by = { .i = 1 };
	int64_t to;

	if (literal_value(s, open->to, type, &to) ||
	    (open->by && !literal_value(s, open->by, IEC_LINT, &by.i)))
		return;
	open->near = temps_number(s->ld.temps, IEC_BOOL);
	ld_emit(&s->ld, OP_LD, 0, open->to);
	compare(s, by.i < 0 ? FN_LT : FN_GT, for_limit(s, open, type, by.i >= 0, by));
	ld_emit(&s->ld, OP_ST, 0, open->near);
}

static void begin_for(struct st_il *s, struct st_walk *walk, int at)
{
	struct st_open *open = push_block(s, ST_FOR);
	enum iec_type type = IEC_NONE;
	struct st_part part;
	uint32_t good;
	bool steady;
	int64_t by;

	begins(s);
	while (next_part(s, walk, &part) &&
	       part.role != ST_NO_PART) {
		if (part.role == ST_VARIABLE) {
			open->variable = ld_target(&s->ld, &good);
			leave_unless(s, open, good);
			type = st_type_of(s, open->variable);
			open->bits = mixed_is_bits(type);
		} else if (part.role == ST_FROM) {
			for_begin(s, open, for_value(s, open, type));
			type = open->bits ? IEC_LINT : type;
		} else if (part.role == ST_TO) {
			open->to = for_value(s, open, type);
		} else {
			open->by = for_value(s, open, type);
			if (literal_value(s, open->by, IEC_LINT, &by) && by == 0)
				st_report(s, DIAG_LOOP_STEP, part.text, "");
		}
	}
	steady = !open->bits && is_steady(s, open, at);
	open->once = steady && has_room(s, open, type);
	if (steady && !open->once)
		note_end(s, open, type);
	open->top = new_label(s);
	open->again = new_label(s);
	at_item(s);
	if (tests_below(s, open)) {
		leave_for(s, open);
		here_again(s, open->top);
	} else {
		here_again(s, open->top);
		leave_for(s, open);
	}
}

/* Leaves the loop if a step beyond @limit would be needed. */
static void leave_at(struct st_il *s, const struct st_open *open, enum word beyond, uint32_t limit)
{
	ld_emit(&s->ld, OP_LD, 0, open->variable);
	compare(s, beyond, limit);
	jump(s, MOD_C, open->out);
}

/* Leaves the loop if the variable cannot have the next value: one more step is no error. */
static void leave_at_limit(struct st_il *s, const struct st_open *open, enum iec_type type)
{
	const struct meaning *m = ld_meaning(&s->ld, open->variable);
	const union iec_value none = { .i = 0 };
	union iec_value by = { .i = 1 };
	/* A step may lead far beyond a subrange. */
	const enum iec_type wide = m && meaning_is_ranged(m) && !iec_is_wide(type) ? IEC_LINT : type;
	uint32_t up, step, limit;

	if (!open->by || literal_value(s, open->by, IEC_LINT, &by.i)) {
		step = open->near ? new_label(s) : 0;
		if (step) {
			ld_emit(&s->ld, OP_LD, 0, open->near);
			jump(s, MOD_C | MOD_N, step);
		}
		leave_at(s, open, by.i < 0 ? FN_LT : FN_GT, for_limit(s, open, type, by.i >= 0, by));
		if (step)
			here(s, step);
		return;
	}
	up = new_label(s);
	step = new_label(s);
	limit = temps_number(s->ld.temps, wide);
	ld_emit(&s->ld, OP_LD, 0, open->by);
	compare(s, FN_GT, st_intern(s, "0", 1));
	jump(s, MOD_C, up);
	ld_emit(&s->ld, OP_LD, 0, for_limit(s, open, wide, false, none));
	compare(s, FN_SUB, open->by);
	ld_emit(&s->ld, OP_ST, 0, limit);
	leave_at(s, open, FN_LT, limit);
	jump(s, 0, step);
	here(s, up);
	ld_emit(&s->ld, OP_LD, 0, for_limit(s, open, wide, true, none));
	compare(s, FN_SUB, open->by);
	ld_emit(&s->ld, OP_ST, 0, limit);
	leave_at(s, open, FN_GT, limit);
	here(s, step);
}

/* Behind the step: the next round, unless the variable is beyond the end. */
static void next_round(struct st_il *s, const struct st_open *open)
{
	int64_t by = 1;

	if (!tests_below(s, open)) {
		jump(s, 0, open->top);
		return;
	}
	if (open->by)
		literal_value(s, open->by, IEC_LINT, &by);
	ld_emit(&s->ld, OP_LD, 0, open->variable);
	compare(s, by < 0 ? FN_GE : FN_LE, open->to);
	jump(s, MOD_C, open->top);
}

static void close_for(struct st_il *s, const struct st_open *open)
{
	next_round(s, open);
	here(s, open->out);
	level_back(s, &open->level);
	s->depth--;
}

/* The next round of a FOR whose variable is a bit string: it ends where that has no such value. */
static void next_bits(struct st_il *s, const struct st_open *open)
{
	const uint32_t next = as_whole(s, open->variable);
	char most[24];
	const int len = snprintf(most, sizeof(most), "%lld", (long long)
				 iec_type_row(st_type_of(s, open->variable))->high);

	ld_emit(&s->ld, OP_LD, 0, next);
	compare(s, FN_ADD, open->by ? open->by : st_intern(s, "1", 1));
	ld_emit(&s->ld, OP_ST, 0, next);
	compare(s, FN_GT, st_intern(s, most, (size_t)len));
	jump(s, MOD_C, open->out);
	ld_emit(&s->ld, OP_LD, 0, next);
	compare(s, FN_LT, st_intern(s, "0", 1));
	jump(s, MOD_C, open->out);
	ld_call(&s->ld, FN_CONVERT);
	ld_arg(&s->ld, false, s->ld.in_id, next);
	ld_arg(&s->ld, true, s->ld.out_id, open->variable);
	close_for(s, open);
}

static void end_for(struct st_il *s)
{
	const struct st_open *open = innermost(s);

	here(s, open->again);
	begins(s);
	if (open->bits) {
		next_bits(s, open);
		return;
	}
	if (!open->once)
		leave_at_limit(s, open, st_type_of(s, open->variable));
	ld_emit(&s->ld, OP_LD, 0, open->variable);
	compare(s, FN_ADD, open->by ? open->by : st_intern(s, "1", 1));
	ld_emit(&s->ld, OP_ST, 0, open->variable);
	close_for(s, open);
}

/* ---- CASE ---- */

/* Reports a value that an earlier choice has. */
static void note_range(struct st_il *s, const char *at, const char *end, uint32_t low, uint32_t high)
{
	struct st_range range, *kept;
	char text[LIMIT_ARG + 1];

	if (!literal_value(s, low, IEC_LINT, &range.low) || !literal_value(s, high, IEC_LINT, &range.high))
		return;
	snprintf(text, sizeof(text), "%.*s", end - at < LIMIT_ARG ? (int)(end - at) : LIMIT_ARG, at);
	if (range.low > range.high) {
		char both[2 * LIMIT_ARG];

		snprintf(both, sizeof(both), "%.30s" DIAG_AND "%lld..%lld", text, (long long)range.high,
			 (long long)range.low);
		st_report(s, DIAG_ST_EMPTY_RANGE, at, both);
		return;
	}
	for (int i = 0; i < s->ranges; i++)
		if (range.low <= s->range[i].high && s->range[i].low <= range.high) {
			st_report(s, DIAG_ST_CHOICE_TWICE, at, text);
			return;
		}
	kept = arena_push(s->translation->arena, &s->range, &s->ranges, sizeof(*kept));
	if (kept)
		*kept = range;
	else
		s->ld.failed = true;
}

/* One value or range of a choice jumps to @label. */
static void test_choice(struct st_il *s, struct st_walk *walk, uint32_t selector, enum iec_type type,
			uint32_t label)
{
	struct st_part part;
	const char *at = NULL;
	uint32_t low = 0, good;

	while (next_part(s, walk, &part) &&
	       part.role != ST_NO_PART) {
		enum iec_type is = type;
		const uint32_t value = values_choose(s->translation->scope, s->pou, ld_value(&s->ld, &is, &good),
						     selector);
		struct lex ahead = walk->lex;
		const bool range = part.role == ST_LOW && lex_is(&ahead, ".");

		at = part.role == ST_LOW ? part.text : at;
		if (range) {
			low = value;
			continue;
		}
		note_range(s, at, walk->lex.token.text, part.role == ST_HIGH ? low : value, value);
		ld_emit(&s->ld, OP_LD, 0, selector);
		if (part.role == ST_HIGH) {
			compare(s, FN_GE, low);
			ld_emit(&s->ld, OP_AND, MOD_PAREN, selector);
			compare(s, FN_LE, value);
			ld_emit_line(&s->ld, (struct il_line){ .kind = IL_CLOSE });
		} else {
			compare(s, FN_EQ, value);
		}
		jump(s, MOD_C, label);
	}
}

/* The tests of all choices stand first; @at: of the CASE. */
static void test_choices(struct st_il *s, int at, uint32_t selector, enum iec_type type)
{
	const struct st *st = s->pou->st;
	struct st_open *open = innermost(s);
	const int depth = st->item[at].depth;
	bool other = false;

	s->range = NULL;
	s->ranges = 0;
	for (int i = at + 1; i < st->count && !(st->item[i].kind == ST_END_CASE &&
						st->item[i].depth == depth); i++) {
		struct st_walk walk;

		other |= st->item[i].kind == ST_ELSE && st->item[i].depth == depth;
		if (st->item[i].kind != ST_CHOICE || st->item[i].depth != depth + 1)
			continue;
		s->ld.item = &st->item[i];
		at_item(s);
		st_begin(&walk, &s->translation->project->names, s->ld.item);
		test_choice(s, &walk, selector, type, open->first + (uint32_t)open->choices++);
	}
	open->next = other ? new_label(s) : 0;
	jump(s, 0, other ? open->next : open->out);
}

static void begin_case(struct st_il *s, struct st_walk *walk, int at)
{
	const struct st *st = s->pou->st;
	struct st_open *open = push_block(s, ST_CASE);
	enum iec_type type = IEC_NONE;
	uint32_t selector, good;
	struct st_part part;
	const int depth = st->item[at].depth;

	begins(s);
	if (!next_part(s, walk, &part))
		s->ld.failed = true;
	selector = ld_value(&s->ld, &type, &good);
	want_integer(s, type);
	if (good) {
		ld_emit(&s->ld, OP_LD, 0, good);
		jump(s, MOD_C | MOD_N, open->out);
	}
	open->first = s->labels + 1;
	for (int i = at + 1; i < st->count && !(st->item[i].kind == ST_END_CASE &&
						st->item[i].depth == depth); i++)
		s->labels += st->item[i].kind == ST_CHOICE && st->item[i].depth == depth + 1;
	test_choices(s, at, selector, type == IEC_NONE ? IEC_DINT : type);
	s->ld.item = &st->item[at];
	level_back(s, &open->level);
	open->choices = 0;
}

static void next_choice(struct st_il *s)
{
	struct st_open *open = innermost(s);

	if (open->choices > 0)
		jump(s, 0, open->out);
	here(s, open->first + (uint32_t)open->choices++);
}

static void other_case(struct st_il *s)
{
	struct st_open *open = innermost(s);

	jump(s, 0, open->out);
	here(s, open->next);
}

static void end_block(struct st_il *s)
{
	here(s, s->open[--s->depth].out);
}

/* ---- calls ---- */

static void skip_unless(struct st_il *s, uint32_t good)
{
	struct st_call *call = &s->call;

	if (!good)
		return;
	if (!call->skip)
		call->skip = new_label(s);
	ld_emit(&s->ld, OP_LD, 0, good);
	jump(s, MOD_C | MOD_N, call->skip);
}

static const struct word_pin *pin_at(const struct word_row *row, const struct st_part *part, int *last)
{
	int index;

	if (!row)
		return NULL;
	if (!part->pin.len)
		return pin_next(row, last);
	index = word_pin_find(row, part->pin.text, part->pin.len);
	return index >= 0 && index < row->pin_count ? &row->pin[index] : NULL;
}

/* The text of `place := value`; 0: no memory. */
static uint32_t assignment(struct st_il *s, const char *place, size_t len, const char *value)
{
	const size_t size = len + strlen(value) + 5;
	char *text = arena_alloc(s->ld.scratch, size);

	if (!text) {
		s->ld.failed = true;
		return 0;
	}
	return st_intern(s, text, (size_t)snprintf(text, size, "%.*s := %s", (int)len, place, value));
}

/* Does what assignment() says. */
static void store_text(struct st_il *s, uint32_t id)
{
	struct lex lex;

	if (!id)
		return;
	lex_init(&lex, names_text(&s->translation->project->names, id),
		 names_len(&s->translation->project->names, id));
	lex_next(&lex);
	if (expr_parse_cell(&lex, s->ld.expr, s->ld.ignored, (struct diag){ .id = DIAG_COUNT }))
		ld_store(&s->ld);
	else
		s->ld.failed = true;
}

/* Does the place of an output have a number of another type, which takes only a converted one? */
static bool narrows(struct st_il *s, const struct word_pin *pin)
{
	const struct expr_node *root = &s->ld.expr->node[s->ld.expr->root];
	enum iec_type type;

	if (!pin || pin->elements || root->op != EXPR_NAME || !s->translation->project->words.own_first)
		return false;
	type = st_type_of(s, st_intern(s, root->text, root->len));
	return mixed_narrows((enum iec_type)pin->type, type) &&
	       !iec_can_widen((enum iec_type)pin->type, type);
}

/* An output that goes to Word.3, or is converted: into a temporary, which is put there behind the call. */
static uint32_t begin_part(struct st_il *s, const struct st_part *part, const struct word_pin *pin)
{
	const struct expr_node *root = &s->ld.expr->node[s->ld.expr->root];
	const struct expr_tail tail = root->op == EXPR_NAME ?
		(struct expr_tail){ root->text, root->len } : root->tail;
	const enum iec_type type = pin ? (enum iec_type)pin->type : IEC_BOOL;
	char value[LIMIT_NAME + 8];
	uint32_t temp;

	if (pin && (pin->elements || type == IEC_NONE || type == IEC_STRING)) {
		st_report(s, DIAG_PART_ALONE, part->text, "");
		return 0;
	}
	temp = type == IEC_BOOL ? temps_bool(s->ld.temps) : temps_number(s->ld.temps, type);
	snprintf(value, sizeof(value), "%s%.*s", part->inverted ? "NOT " : "", LIMIT_NAME,
		 project_text(s->translation->project, temp));
	s->call.part[s->call.count] = assignment(s, part->text, (size_t)(tail.text + tail.len - part->text), value);
	return temp;
}

/* An instance that an index leads to, perhaps to none: what the call leaves goes to a part only if there is one. */
static void check_instance(struct st_il *s, uint32_t instance, const struct meaning *m)
{
	const struct project *project = s->translation->project;

	for (int i = 0; m && (m->opens || m->through) && i < s->call.count; i++) {
		const struct il_line *line = &s->call.line[i];
		const uint32_t found = temps_bool(s->ld.temps);

		if (!s->call.part[i])
			continue;
		const char *path = project_text(project, instance), *pin = project_text(project, line->pin);
		const size_t size = strlen(path) + strlen(pin) + 2;
		char *text = arena_alloc(s->ld.scratch, size);

		if (!text) {
			s->ld.failed = true;
			return;
		}
		ld_call(&s->ld, FN_MOVE);
		ld_arg(&s->ld, false, s->ld.in_id,
		       st_intern(s, text, (size_t)snprintf(text, size, "%s.%s", path, pin)));
		ld_arg(&s->ld, true, s->ld.eno_id, found);
		ld_arg(&s->ld, true, s->ld.out_id, line->operand);
		skip_unless(s, found);
		return;
	}
}

static void end_parts(struct st_il *s)
{
	for (int i = 0; i < s->call.count; i++)
		if (s->call.part[i])
			store_text(s, s->call.part[i]);
}

/* The value of an argument, in a temporary if it is more than an operand. */
static uint32_t argument(struct st_il *s, const struct word_pin *pin)
{
	const struct expr_node *root = &s->ld.expr->node[s->ld.expr->root];
	const bool place = root->op == EXPR_NAME || root->op == EXPR_INDEX;
	enum iec_type type = pin ? pin->type : IEC_NONE;
	uint32_t good, operand;

	if (pin && place && (pin->dir == PIN_IN_OUT || pin->elements || pin->type == IEC_NONE))
		operand = ld_target(&s->ld, &good);
	else
		operand = ld_value(&s->ld, &type, &good);
	skip_unless(s, good);
	return operand;
}

/* A call that is not made keeps the value: NOT NOT of it. */
static uint32_t begin_inverse(struct st_il *s, uint32_t place)
{
	const uint32_t value = temps_bool(s->ld.temps);

	ld_emit(&s->ld, OP_LD, MOD_N, place);
	ld_emit(&s->ld, OP_ST, 0, value);
	return value;
}

static void end_inverses(struct st_il *s)
{
	for (int i = 0; i < s->call.count; i++)
		if (s->call.inverse[i]) {
			ld_emit(&s->ld, OP_LD, MOD_N, s->call.line[i].operand);
			ld_emit(&s->ld, OP_ST, 0, s->call.inverse[i]);
		}
}

static void add_argument(struct st_il *s, const struct st_part *part, const struct word_pin *pin)
{
	struct st_call *call = &s->call;
	const char *name = pin && !part->pin.len ? pin->name : part->pin.text;
	const size_t len = pin && !part->pin.len ? strlen(pin->name) : part->pin.len;
	struct il_line line = { .kind = part->role == ST_OUTPUT ? IL_ARG_OUT : IL_ARG_IN };
	uint32_t good = 0;

	if (call->count == LIMIT_ARGS) {
		st_report(s, DIAG_TOO_MANY, part->text, "parameters");
		return;
	}
	if (!pin && !part->pin.len)
		line.mark = IL_IN_ORDER; /* one too many: check_il tells */
	call->part[call->count] = 0;
	if (part->role == ST_OUTPUT &&
	    (s->ld.expr->node[s->ld.expr->root].op == EXPR_BIT || narrows(s, pin)))
		line.operand = begin_part(s, part, pin);
	else
		line.operand = part->role == ST_OUTPUT ? ld_target(&s->ld, &good) : argument(s, pin);
	skip_unless(s, good);
	call->inverse[call->count] = 0;
	if (call->part[call->count])
		; /* the assignment says NOT */
	else if (part->inverted && st_type_of(s, line.operand) != IEC_BOOL) {
		want_bool(s, st_type_of(s, line.operand));
	} else if (part->inverted) {
		call->inverse[call->count] = line.operand;
		line.operand = begin_inverse(s, line.operand);
	}
	line.pin = len ? st_intern(s, name, len) : 0;
	line.row = s->ld.row;
	line.line = (uint32_t)s->ld.line;
	call->line[call->count++] = line;
}

/* EN := condition: the call is made only while it is TRUE. */
static bool is_enable(const struct word_row *row, const struct st_part *part)
{
	return row && part->pin.len == 2 && word_pin_find(row, part->pin.text, 2) < 0 &&
	       (part->pin.text[0] | 32) == 'e' && (part->pin.text[1] | 32) == 'n';
}

/* ENO => place of a block that has no such output. */
static bool is_enabled(const struct st_il *s, const struct word_row *row, const struct st_part *part)
{
	const struct expr_node *root = &s->ld.expr->node[s->ld.expr->root];

	return row && part->role == ST_OUTPUT && ascii_is("ENO", part->pin.text, part->pin.len) &&
	       word_pin_find(row, part->pin.text, part->pin.len) < 0 &&
	       (root->op == EXPR_NAME || root->op == EXPR_BIT);
}

/* Two statements that store whether the call was made. */
static void keep_enabled(struct st_il *s, const struct st_part *part, uint32_t stores[2])
{
	const struct expr_node *root = &s->ld.expr->node[s->ld.expr->root];
	const char *end = root->op == EXPR_NAME ? root->text + root->len : root->tail.text + root->tail.len;

	for (int made = 0; made < 2; made++)
		stores[made] = assignment(s, part->text, (size_t)(end - part->text),
					  made != part->inverted ? "TRUE" : "FALSE");
}

/* Behind a call: it was made, or left out. */
static void end_call(struct st_il *s, const uint32_t stores[2])
{
	const uint32_t end = stores[0] && s->call.skip ? new_label(s) : 0;

	store_text(s, stores[1]);
	if (end)
		jump(s, 0, end);
	if (s->call.skip)
		here(s, s->call.skip);
	if (end) {
		store_text(s, stores[0]);
		here(s, end);
	}
}

/* @good: tells whether its indices could be computed; 0: they can. */
static void call_instance(struct st_il *s, struct st_walk *walk, uint32_t instance, uint32_t good)
{
	const struct meaning *m = ld_meaning(&s->ld, instance);
	const struct word_row *row = m && m->kind == MEANING_INSTANCE ?
		scope_row(s->translation->scope, (enum word)m->word) : NULL;
	struct st_call *call = &s->call;
	uint32_t enabled[2] = { 0, 0 };
	struct st_part part;
	int last = -1;

	*call = (struct st_call){ .count = 0 };
	skip_unless(s, good);
	while (next_part(s, walk, &part) &&
	       part.role != ST_NO_PART) {
		if (part.role == ST_OPEN)
			continue;
		if (is_enable(row, &part)) {
			if (!call->skip)
				call->skip = new_label(s);
			want_bool(s, ld_test(&s->ld));
			jump(s, MOD_C | MOD_N, call->skip);
		} else if (is_enabled(s, row, &part)) {
			keep_enabled(s, &part, enabled);
		} else {
			const struct word_pin *pin = pin_at(row, &part, &last);

			if (pin && pin->dir == PIN_OUT && !part.pin.len)
				part.role = ST_OUTPUT;
			add_argument(s, &part, pin);
		}
	}
	at_item(s);
	check_instance(s, instance, m);
	ld_emit(&s->ld, OP_CAL, 0, instance);
	for (int i = 0; i < call->count; i++) {
		s->ld.line = (int)call->line[i].line;
		s->ld.row = s->ld.col = call->line[i].row;
		ld_emit_line(&s->ld, call->line[i]);
	}
	end_inverses(s);
	end_parts(s);
	end_call(s, enabled);
}

/* `Other.Level` of a program and one of its variables. */
static const char *variable_of(struct st_il *s, const struct pou *program, int index, size_t *len)
{
	struct project *project = s->translation->project;
	char text[2 * LIMIT_NAME + 2];
	const int size = snprintf(text, sizeof(text), "%s.%s", project_text(project, program->name),
				  project_text(project, program->vars.var[index].name));
	const uint32_t id = st_intern(s, text, (size_t)size);

	*len = names_len(&project->names, id);
	return names_text(&project->names, id);
}

/* Other.Level := the expression that was read. */
static void store_input(struct st_il *s, const char *name, size_t len)
{
	struct expr *expr = s->ld.expr;

	expr->target = name;
	expr->target_len = len;
	expr->target_index = expr->target_base = -1;
	ld_store(&s->ld);
}

/* The place that was read := Other.Level */
static void take_output(struct st_il *s, const struct st_part *part, const char *name, size_t len)
{
	struct expr *expr = s->ld.expr;
	const struct expr_node place = expr->node[expr->root];
	const bool inverted = part->inverted;

	if (place.op == EXPR_BIT) {
		char value[2 * LIMIT_NAME + 8];

		snprintf(value, sizeof(value), "%s%.*s", inverted ? "NOT " : "", (int)len, name);
		store_text(s, assignment(s, part->text, (size_t)(place.tail.text + place.tail.len - part->text), value));
		return;
	}

	if (expr->count == LIMIT_EXPR_NODES)
		return;
	expr->target = place.text;
	expr->target_len = place.len;
	expr->target_index = place.op == EXPR_INDEX ? place.left : -1;
	expr->target_base = place.op == EXPR_INDEX ? place.right : -1;
	expr->target_tail = place.tail;
	expr->root = expr->count++;
	expr->node[expr->root] = (struct expr_node){ .op = EXPR_NAME, .text = name,
						     .len = (uint16_t)len, .left = -1, .right = -1 };
	if (inverted && expr->count < LIMIT_EXPR_NODES) {
		expr->node[expr->count] = (struct expr_node){ .op = EXPR_NOT, .text = name,
							      .left = (int16_t)expr->root, .right = -1 };
		expr->root = expr->count++;
	}
	ld_store(&s->ld);
}

/* The arguments that go into a program, or, @output, come out of it. */
static void program_arguments(struct st_il *s, const struct pou *program, struct st_walk walk,
				  bool output)
{
	struct names *names = &s->translation->project->names;
	struct st_part part;
	const char *name;
	size_t len;
	int last = -1;

	while (next_part(s, &walk, &part) && part.role != ST_NO_PART) {
		if (part.role == ST_OPEN)
			continue;
		const uint32_t fold = part.pin.len ? names_fold(names, st_intern(s, part.pin.text,
										 part.pin.len)) : 0;
		const int at = vars_argument(&program->vars, fold, part.role == ST_OUTPUT, &last);

		const bool both = at >= 0 && vars_flags(&program->vars, at) & VAR_IN_OUT;

		if (at < 0 || ((part.role == ST_OUTPUT) != output && !both))
			continue;
		name = variable_of(s, program, at, &len);
		if (output)
			take_output(s, &part, name, len);
		else
			store_input(s, name, len);
	}
}

/* A program is called with copies of its arguments: its variables exist once. */
static void call_program(struct st_il *s, const struct pou *program, struct st_walk *walk)
{
	program_arguments(s, program, *walk, false);
	at_item(s);
	ld_emit(&s->ld, OP_CAL, 0, program->name);
	program_arguments(s, program, *walk, true);
}

/* An instance may have the name of a function. */
static bool is_function(struct st_il *s, const struct expr_node *callee)
{
	const struct meaning *m;

	if (callee->op != EXPR_NAME ||
	    expr_function(&s->translation->project->words, callee) == WORD_COUNT)
		return false;
	m = ld_meaning(&s->ld, st_intern(s, callee->text, callee->len));
	return !m || m->kind != MEANING_INSTANCE;
}

/* The value of IN, computed once. */
static uint32_t split_value(struct st_il *s, const struct split *split)
{
	enum iec_type type = IEC_NONE;
	uint32_t good, operand = ld_value(&s->ld, &type, &good);
	char text[LIMIT_ARG];

	if (!(iec_type_row(type)->class & split->takes)) {
		snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "%s", split->word,
			 type == IEC_NONE ? "this" : iec_type_row(type)->word, split->takes == CLASS_DATE ? "DATE" :
			 split->takes == CLASS_TOD ? "TIME_OF_DAY" : "DATE_AND_TIME");
		st_report(s, DIAG_TYPE_NOT_TAKEN, s->ld.expr->node[0].text, text);
		return 0;
	}
	skip_unless(s, good);
	return keep(s, operand, type);
}

/* Stores one part of @value in the place that was read. */
static void split_store(struct st_il *s, enum word fn, uint32_t value)
{
	const uint32_t part = temps_number(s->ld.temps, IEC_INT);
	uint32_t good, place = ld_target(&s->ld, &good);

	want_integer(s, st_type_of(s, place));
	ld_call(&s->ld, fn);
	ld_arg(&s->ld, false, s->ld.in_id, value);
	ld_arg(&s->ld, true, s->ld.out_id, part);
	ld_call(&s->ld, FN_CONVERT);
	if (good)
		ld_arg(&s->ld, false, s->ld.en_id, good);
	ld_arg(&s->ld, false, s->ld.in_id, part);
	ld_arg(&s->ld, true, s->ld.out_id, place);
}

/* SPLIT_DATE(IN := Day, YEAR => Year): IN may stand behind the places. */
__attribute__((noinline))
static void split_statement(struct st_il *s, const struct split *split, const struct st_walk *walk)
{
	uint32_t value = 0;

	s->call = (struct st_call){ .count = 0 };
	for (int round = 0; round < 2; round++) {
		struct st_walk parts = *walk;
		struct st_part part;
		int last = -1, pin;

		while (next_part(s, &parts, &part) && part.role != ST_NO_PART) {
			pin = split_pin(split, &part, &last);
			if (part.role == ST_OPEN || (pin > 0) != (round == 1))
				continue;
			if (pin > 0 && value)
				split_store(s, split->part[pin - 1].fn, value);
			else if (pin == 0)
				value = split_value(s, split);
		}
	}
	if (s->call.skip)
		here(s, s->call.skip);
}

/* Not inlined: its locals would be on the stack for every kind of statement. */
__attribute__((noinline))
static void call_statement(struct st_il *s, struct st_walk *walk)
{
	const struct split *split;
	struct st_part part;
	const struct expr_node *root;
	const struct pou *pou;
	enum iec_type type = IEC_NONE;
	uint32_t good;

	begins(s);
	if (!next_part(s, walk, &part)) {
		s->ld.failed = true;
		return;
	}
	root = &s->ld.expr->node[s->ld.expr->root];
	pou = root->op != EXPR_NAME ? NULL :
	      scope_pou(s->translation->scope, s->pou, st_intern(s, root->text, root->len));
	if (pou && pou->kind == POU_PROGRAM) {
		call_program(s, pou, walk);
		return;
	}
	split = split_find(s->translation->scope, s->pou, root);
	if (split) {
		split_statement(s, split, walk);
		return;
	}
	if ((pou && pou->kind == POU_ACTION) || !is_function(s, &s->ld.expr->node[s->ld.expr->root])) {
		const uint32_t instance = ld_target(&s->ld, &good);

		call_instance(s, walk, instance, good);
		return;
	}
	/* A function: its result is not used. */
	st_begin(walk, &s->translation->project->names, s->ld.item);
	if (!expr_parse(&walk->lex, s->ld.expr, s->ld.ignored, (struct diag){ .id = DIAG_COUNT }))
		return;
	letters_rewrite(s->translation->scope, s->pou, s->ld.expr);
	ld_value(&s->ld, &type, &good);
}

/* ---- the walk ---- */

static void assign(struct st_il *s, struct st_walk *walk)
{
	struct st_part part;

	begins(s);
	do {
		if (!next_part(s, walk, &part))
			s->ld.failed = true;
		else if (part.role == ST_ASSIGNED)
			ld_store(&s->ld);
	} while (part.role == ST_ASSIGNED && !s->ld.failed);
}

/* EXIT and CONTINUE: of the innermost loop. */
static void leave_loop(struct st_il *s, enum st_kind kind)
{
	int i = s->depth - 1;

	while (i > 0 && (s->open[i].kind == ST_IF || s->open[i].kind == ST_CASE))
		i--;
	begins(s);
	jump(s, 0, kind == ST_EXIT ? s->open[i].out : s->open[i].again);
}

static void leave_body(struct st_il *s)
{
	begins(s);
	if (s->leave)
		jump(s, 0, s->leave);
	else
		ld_emit(&s->ld, OP_RET, 0, 0);
}

/* The number of the label with the name of the statement; 0: there is none. */
__attribute__((noinline))
static uint32_t named_label(struct st_il *s)
{
	struct names *names = &s->translation->project->names;

	if (!s->named) {
		s->named = arena_alloc(s->ld.scratch, sizeof(*s->named));
		s->ld.failed |= !s->named;
		if (!s->named)
			return 0;
		st_labels(names, s->pou->st, s->first, s->count, s->named);
		s->first_named = s->labels + 1;
		s->labels += (uint32_t)s->named->count;
	}
	const int found = st_label_find(names, s->named, s->ld.item);

	return found < 0 ? 0 : s->first_named + (uint32_t)found;
}

static void jump_to(struct st_il *s)
{
	const uint32_t label = named_label(s);

	begins(s);
	if (label)
		jump(s, 0, label);
}

static void label_here(struct st_il *s)
{
	const uint32_t label = named_label(s);

	if (label)
		here_again(s, label);
}

/* ---- networks ---- */

static void leave_if(struct st_il *s, struct st_walk *walk)
{
	const struct fbd *fbd = s->pou->fbd;
	struct names *names = &s->translation->project->names;
	uint32_t label = s->ld.item->kind == ST_STOP_IF ? 0 : s->leave;
	struct st_part part;

	if (s->ld.item->kind == ST_JUMP_IF) {
		const struct token name = st_label_name(names, s->ld.item);
		const int to = fbd_find_label(names, fbd, names_fold(names, names_intern(names, name.text, name.len)));

		label = to < 0 ? 0 : s->first_named + (uint32_t)to;
	}
	begins(s);
	if (!next_part(s, walk, &part)) {
		s->ld.failed = true;
		return;
	}
	if (part.role == ST_VALUE) {
		const enum iec_type type = ld_test(&s->ld);

		want_bool(s, type);
		if (type != IEC_BOOL && type != IEC_NONE)
			return;
	}
	if (label)
		jump(s, part.role == ST_VALUE ? MOD_C : 0, label);
	else if (s->ld.item->kind != ST_JUMP_IF)
		ld_emit(&s->ld, s->ld.item->kind == ST_STOP_IF ? OP_STP : OP_RET, part.role == ST_VALUE ? MOD_C : 0, 0);
}

/* `place := TRUE` or FALSE, where S and R cannot reach. */
static void store_latch(struct st_il *s, const char *place, size_t len, bool set)
{
	const uint32_t skip = new_label(s);

	jump(s, MOD_C | MOD_N, skip);
	store_text(s, assignment(s, place, len, set ? "TRUE" : "FALSE"));
	here(s, skip);
}

/* Horn S= Alarm */
static void latch(struct st_il *s, struct st_walk *walk, bool set)
{
	const char *place = walk->lex.token.text;
	struct st_part part;
	uint32_t target = 0;
	enum iec_type type;
	size_t len;

	begins(s);
	if (!next_part(s, walk, &part)) {
		s->ld.failed = true;
		return;
	}
	len = (size_t)(walk->lex.token.text - place);
	if (s->ld.expr->node[s->ld.expr->root].op == EXPR_NAME)
		target = st_intern(s, s->ld.expr->node[s->ld.expr->root].text, s->ld.expr->node[s->ld.expr->root].len);
	if (!next_part(s, walk, &part)) {
		s->ld.failed = true;
		return;
	}
	type = ld_test(&s->ld);
	want_bool(s, type);
	if (type != IEC_BOOL && type != IEC_NONE)
		return;
	at_item(s);
	if (target && !ld_is_indexed(&s->ld, target))
		ld_emit(&s->ld, set ? OP_S : OP_R, 0, target);
	else
		store_latch(s, place, len, set);
}

static void end_while(struct st_il *s)
{
	jump(s, 0, innermost(s)->again);
	end_block(s);
}

/* Not inlined: the walk is large. */
__attribute__((noinline))
static void st_item_to_il(struct st_il *s, int at)
{
	const enum st_kind kind = (enum st_kind)s->pou->st->item[at].kind;
	const bool in_case = s->depth > 0 && innermost(s)->kind == ST_CASE;
	struct st_walk walk;

	s->ld.item = &s->pou->st->item[at];
	at_item(s);
	s->ld.begins = false;
	st_begin(&walk, &s->translation->project->names, s->ld.item);
	switch (kind) {
	case ST_ASSIGN: assign(s, &walk); break;
	case ST_CALL: call_statement(s, &walk); break;
	case ST_IF: begin_if(s, &walk); break;
	case ST_ELSIF: other_if(s, &walk, kind); break;
	case ST_ELSE: in_case ? other_case(s) : other_if(s, &walk, kind); break;
	case ST_END_IF: end_if(s); break;
	case ST_CASE: begin_case(s, &walk, at); break;
	case ST_CHOICE: next_choice(s); break;
	case ST_END_CASE: end_block(s); break;
	case ST_FOR: begin_for(s, &walk, at); break;
	case ST_END_FOR: end_for(s); break;
	case ST_WHILE: begin_while(s, &walk); break;
	case ST_END_WHILE: end_while(s); break;
	case ST_REPEAT: begin_repeat(s); break;
	case ST_UNTIL: end_repeat(s, &walk); break;
	case ST_EXIT:
	case ST_CONTINUE: leave_loop(s, kind); break;
	case ST_RETURN: leave_body(s); break;
	case ST_JUMP: jump_to(s); break;
	case ST_LABEL: label_here(s); break;
	case ST_SET: latch(s, &walk, true); break;
	case ST_RESET: latch(s, &walk, false); break;
	case ST_JUMP_IF:
	case ST_RETURN_IF:
	case ST_STOP_IF: leave_if(s, &walk); break;
	case ST_EMPTY:
	case ST_COMMENT:
	case ST_KINDS: break;
	}
}

static void put_items(struct st_il *s, int first, int count)
{
	s->first = first;
	s->count = count;
	for (int i = first; i < first + count && !s->ld.failed; i++) {
		const struct level level = level_of(s);
		const enum st_kind kind = (enum st_kind)s->pou->st->item[i].kind;

		st_item_to_il(s, i);
		if (kind == ST_ASSIGN || kind == ST_CALL || kind >= ST_SET)
			level_back(s, &level);
	}
}

/* Wires whose value of the scan before somebody reads keep it. */
static void keep_before(struct st_il *s, int network)
{
	struct project *project = s->translation->project;
	const struct var_table *vars = &s->pou->vars;
	char end[16];
	const size_t size = (size_t)snprintf(end, sizeof(end), ".P%d", network + 1);

	const struct fbd_network *of = &s->pou->fbd->network[network];

	for (int i = of->wire; i < of->wire + of->wires; i++) {
		const char *name = project_text(project, vars->var[i].name);
		const size_t len = strlen(name);

		if (len <= size || strcmp(name + len - size, end) != 0)
			continue;
		const uint32_t wire = fbd_wire_name(&project->names, name, len - size, network, false);

		if (vars->var[i].type != IEC_STRING) {
			copy(s, wire, vars->var[i].name);
			continue;
		}
		ld_call(&s->ld, FN_MOVE);
		ld_arg(&s->ld, false, s->ld.in_id, wire);
		ld_arg(&s->ld, true, s->ld.out_id, vars->var[i].name);
	}
}

/* A network that is OFF leaves its label. */
static void put_networks(struct st_il *s)
{
	const struct fbd *fbd = s->pou->fbd;
	struct names *names = &s->translation->project->names;

	s->first_named = s->labels + 1;
	s->labels += (uint32_t)fbd->count;
	for (int i = 0; i < s->pou->st->count; i++) {
		const struct st_item *item = &s->pou->st->item[i];
		const struct token name = st_label_name(names, item);
		const int to = item->kind != ST_JUMP_IF ? -1 :
			fbd_find_label(names, fbd, names_fold(names, names_intern(names, name.text, name.len)));

		if (to >= 0)
			use_label(s, s->first_named + (uint32_t)to);
	}
	for (int i = 0; i < fbd->count && !s->ld.failed; i++) {
		const struct fbd_network *network = &fbd->network[i];

		s->ld.line = network->line;
		s->ld.fbd = 0;
		here(s, s->first_named + (uint32_t)i);
		if (network->off)
			continue;
		s->ld.fbd = i + 1;
		scope_network(s->translation->scope, s->pou, i);
		keep_before(s, i);
		put_items(s, network->first, network->count);
	}
	s->ld.fbd = 0;
	scope_network(s->translation->scope, s->pou, -1);
}

void st_put(struct ld *ld, int first, int count)
{
	struct st_il *s = arena_alloc(ld->scratch, sizeof(*s));
	const struct ld before = *ld;

	if (!s) {
		ld->failed = true;
		return;
	}
	*s = (struct st_il){ .ld = before, .translation = ld->translation, .pou = ld->unit->pou };
	s->ld.rung = NULL;
	s->ld.number = 0;
	s->ld.statement = true;
	s->ld.watch = false;
	temps_rung(s->ld.temps);
	put_items(s, first, count);
	ld->failed |= s->ld.failed;
}

/* Is the callee of `name (`, the lexer behind the name, one that may write any variable? */
static bool calls_own(struct ld *ld, const struct lex *lex, const struct token *name)
{
	const uint32_t id = lex_is(lex, "(") && name->kind == TOKEN_NAME ?
		names_intern(&ld->translation->project->names, name->text, name->len) : 0;

	return id && scope_pou(ld->translation->scope, ld->unit->pou, id);
}

/* Keeps the value of what the statement writes. False: nobody knows what that is, as behind a pointer
 * or in a call. */
static bool keep_written(struct ld *ld, const struct st_item *item)
{
	struct names *names = &ld->translation->project->names;
	struct token before = { .kind = TOKEN_END };
	uint32_t written = 0;
	struct lex lex;
	int open = 0, stores = 0;

	if (item->kind == ST_CALL)
		return false;
	lex_init(&lex, names_text(names, item->text), names_len(names, item->text));
	for (int i = 0; lex_next(&lex) != TOKEN_END; i++) {
		if (i == (item->kind == ST_FOR) && (item->kind == ST_FOR || item->kind == ST_ASSIGN))
			written = names_intern(names, lex.token.text, lex.token.len);
		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")");
		stores += open == 0 && lex_is(&lex, ":=");
		if (lex_is(&lex, "^") || stores > 1 || calls_own(ld, &lex, &before) ||
		    (lex_is(&lex, "[") && before.kind == TOKEN_ADDRESS))
			return false;
		before = lex.token;
	}
	if (written && !ld_meaning(ld, written))
		return false;
	if (written)
		ld_freeze(ld, written);
	return true;
}

void st_keep_read(struct ld *ld, int first, int count)
{
	for (int i = first; i < first + count; i++) {
		const struct st_item *item = &ld->unit->pou->st->item[i];

		if (item->kind == ST_COMMENT || keep_written(ld, item))
			continue;
		ld_freeze_all(ld);
		return;
	}
}

void st_put_box(struct ld *ld, uint32_t en, int first, int count)
{
	struct st_il *s = arena_alloc(ld->scratch, sizeof(*s));
	struct level level;

	if (!s) {
		ld->failed = true;
		return;
	}
	*s = (struct st_il){ .ld = *ld, .translation = ld->translation, .pou = ld->unit->pou,
			     .labels = ld->labels };
	level = level_of(s);
	s->leave = new_label(s);
	if (en) {
		ld_emit(&s->ld, OP_LD, 0, en);
		jump(s, MOD_C | MOD_N, s->leave);
	}
	s->ld.rung = NULL;
	s->ld.number = 0;
	s->ld.statement = true;
	s->ld.watch = false;
	put_items(s, first, count);
	s->ld.rung = ld->rung;
	s->ld.number = ld->number;
	s->ld.row = ld->row;
	s->ld.col = ld->col;
	here(s, s->leave);
	level_back(s, &level);
	ld->labels = s->labels;
	ld->failed |= s->ld.failed;
}

/* The line of the CONFIGURATION that connects inputs and outputs of this instance; NULL: there is none. */
static const struct config_entry *entry_of(struct st_il *s)
{
	struct project *project = s->translation->project;
	const struct config *config = s->pou->kind == POU_PROGRAM ? project->config : NULL;

	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		const char *runs = entry->kind != CONFIG_PROGRAM || !entry->values ? "" :
			project_text(project, project_is_further(project, entry) ? entry->name : entry->pou);

		if (*runs && name_equal(runs, project_text(project, s->pou->name)))
			return entry;
	}
	return NULL;
}

/* Stores the inputs of the program before it runs or, @output, its outputs behind it. */
static void put_values(struct st_il *s, const struct config_entry *entry, bool output)
{
	const uint8_t mark = s->ld.mark;
	struct st_walk walk;
	struct st_part part;

	s->ld.mark |= IL_MADE;
	for (int i = 0; i < entry->values; i++) {
		const struct level level = level_of(s);

		s->ld.item = &entry->value[i];
		at_item(s);
		st_begin(&walk, &s->translation->project->names, s->ld.item);
		if (entry->value[i].behind != output)
			continue;
		if (next_part(s, &walk, &part))
			ld_store(&s->ld);
		else
			s->ld.failed = true;
		level_back(s, &level);
	}
	s->ld.mark = mark;
}

bool st_to_il(struct translation *translation, struct unit *unit, struct arena *scratch)
{
	struct st_il *s = arena_alloc(scratch, sizeof(*s));
	const struct config_entry *entry;

	if (!s)
		return false;
	*s = (struct st_il){
		.ld = { .translation = translation, .unit = unit, .scratch = scratch, .il = &unit->il,
			.statement = true },
		.translation = translation, .pou = unit->pou,
	};
	if (!ld_begin(&s->ld))
		return false;
	temps_rung(s->ld.temps);
	ld_edges(&s->ld);
	entry = entry_of(s);
	if (entry) {
		s->leave = new_label(s);
		put_values(s, entry, false);
	}
	if (unit->pou->fbd)
		put_networks(s);
	else
		put_items(s, 0, unit->pou->st->count);
	if (entry) {
		here(s, s->leave);
		put_values(s, entry, true);
	}
	return !s->ld.failed;
}
