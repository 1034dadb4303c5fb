/* SPDX-License-Identifier: MIT
 *
 * located_calls - structures and arrays at an address, as a whole, in the lists of all languages.
 *
 * Their parts do not lie as those of a variable without an address do. A call works on a copy, which gets the parts
 * before the call and gives back those that it may have changed; MOVE, and LD with ST, become copies of the parts.
 * If an index leads nowhere, there is no call.
 */
#include "engine/translate/located_calls.h"

#include "engine/base/name.h"
#include "engine/translate/temps.h"

#include <stdio.h>
#include <string.h>

#define PARTS_MOST 256 /* values of one copy; more of them are LD334 */

/* The operands of all values of one structure or array, in their order. */
struct parts {
	uint32_t part[PARTS_MOST];
	int count;
};

struct copied {
	uint32_t from, to;   /* operands: at an address, the copy              */
	bool takes, gives_back; /* before the call, after it                */
	bool computed, reads; /* by an index that may lead nowhere             */
	uint32_t late;       /* of a value: a temporary for it until the copies are back; 0: it is stored at once */
};

struct located {
	struct translation *translation;
	struct unit *unit;
	struct temps *temps;
	const struct il *from;
	struct il to;
	struct il_line like; /* place of what is added                         */
	struct parts *left, *right;
	uint32_t spare;      /* BOOL of begin_chain(); 0: not made            */
	bool failed;
};

/* ---- operands ---- */

static const struct meaning *meaning_at(struct located *l, uint32_t operand)
{
	enum diag_id why;

	return operand ? scope_find(l->translation->scope, l->unit->pou, operand, &why) : NULL;
}

static bool is_located(const struct meaning *m)
{
	return m && m->addr.area != AREA_NONE && (m->kind == MEANING_STRUCT || (m->kind == MEANING_ARRAY && m->var));
}

static uint32_t located_intern(struct located *l, const char *text)
{
	return names_intern(&l->translation->project->names, text, strlen(text));
}

/* `Whole[3]`, `Whole.Member`: part @index of the whole; 0: it has no more. */
static uint32_t part_at(struct located *l, uint32_t whole, const struct meaning *m, uint32_t index)
{
	const char *text = scope_text(l->translation->scope, whole);
	const struct word_row *row = m->kind == MEANING_ARRAY ? NULL :
				     scope_row(l->translation->scope, (enum word)m->word);
	const struct var_array bounds = m->kind != MEANING_ARRAY ? (struct var_array){ 0 } :
					m->dims > 1 ? m->dim[0] : m->array;
	char out[3 * LIMIT_NAME + 12 * LIMIT_INDICES];
	int size;

	if (row ? index >= row->pin_count : index >= bounds.count)
		return 0;
	size = row ? snprintf(out, sizeof(out), "%s.%s", text, row->pin[index].name) :
	       snprintf(out, sizeof(out), "%s[%ld]", text, (long)bounds.low + (long)index);
	return size < 0 || (size_t)size >= sizeof(out) ? 0 : located_intern(l, out);
}

/* False: it has too many. Depth: LIMIT_DEPTH. */
static bool list_parts(struct located *l, uint32_t whole, struct parts *out)
{
	const struct meaning *m = meaning_at(l, whole);
	uint32_t part;

	if (!m || m->kind == MEANING_INSTANCE)
		return false;
	if (!meaning_is_whole(m)) {
		if (out->count == PARTS_MOST)
			return false;
		out->part[out->count++] = whole;
		return true;
	}
	for (uint32_t i = 0; (part = part_at(l, whole, m, i)); i++)
		if (!list_parts(l, part, out))
			return false;
	return true;
}

static uint32_t flat_count(const struct meaning *m)
{
	return m->kind == MEANING_ARRAY ? m->array.count : 0;
}

static bool same_whole(const struct meaning *a, const struct meaning *b)
{
	return a && b && a->kind == b->kind && a->type == b->type && (a->type != IEC_NONE || a->word == b->word) &&
	       flat_count(a) == flat_count(b) && a->type != IEC_STRING &&
	       (a->kind != MEANING_ARRAY || vars_same_bounds(a->dim, a->dims, b->dim, b->dims));
}

static bool fits_pin(const struct meaning *m, const struct word_pin *pin)
{
	if (m->type != pin->type || (m->type == IEC_NONE && m->word != pin->word) || m->type == IEC_STRING)
		return false;
	return pin->elements ? m->kind == MEANING_ARRAY && m->array.low == pin->low && m->array.count == pin->elements :
			       m->kind == MEANING_STRUCT;
}

/* ---- lines ---- */

static void add_line(struct located *l, struct il_line line)
{
	l->failed |= !il_add(&l->to, line);
}

static void add_op(struct located *l, enum op op, uint8_t modifiers, uint32_t operand)
{
	struct il_line line = l->like;

	line.kind = IL_OP;
	line.op = (uint8_t)op;
	line.modifiers = modifiers;
	line.operand = operand;
	add_line(l, line);
	l->like.mark &= (uint8_t)~IL_BEGINS;
}

static void add_pin(struct located *l, enum il_kind kind, const char *pin, uint32_t operand)
{
	struct il_line line = l->like;

	line.kind = (uint8_t)kind;
	line.mark = 0;
	line.pin = located_intern(l, pin);
	line.operand = operand;
	add_line(l, line);
}

/* @good: the BOOL that tells whether all went well so far, and gets this; 0: nobody asks. */
static void add_move(struct located *l, uint32_t from, uint32_t to, uint32_t good)
{
	struct il_line line = l->like;

	line.kind = IL_CALL;
	line.word = FN_MOVE;
	line.mark |= IL_NAMED;
	add_line(l, line);
	l->like.mark &= (uint8_t)~IL_BEGINS;
	if (good)
		add_pin(l, IL_ARG_IN, "EN", good);
	add_pin(l, IL_ARG_IN, "IN", from);
	if (good)
		add_pin(l, IL_ARG_OUT, "ENO", good);
	add_pin(l, IL_ARG_OUT, "OUT", to);
}

/* An index that leads nowhere fails once, not with each part. @from: begins with it; 0: with TRUE. */
static uint32_t begin_chain(struct located *l, uint32_t from)
{
	l->spare = l->spare ? l->spare : temps_bool(l->temps);
	add_op(l, OP_LD, 0, from ? from : located_intern(l, "TRUE"));
	add_op(l, OP_ST, 0, l->spare);
	return l->spare;
}

/* @good: as of add_move(). */
static void move_parts(struct located *l, uint32_t from, uint32_t to, uint32_t good)
{
	const struct meaning *a = meaning_at(l, from), *b = meaning_at(l, to);

	if (!good && ((a && meaning_is_indexed(a)) || (b && meaning_is_indexed(b))))
		good = begin_chain(l, 0);
	l->left->count = l->right->count = 0;
	if (!list_parts(l, from, l->left) || !list_parts(l, to, l->right) || l->left->count != l->right->count) {
		l->failed = true;
		return;
	}
	for (int i = 0; i < l->left->count; i++)
		add_move(l, l->left->part[i], l->right->part[i], good);
}

static bool has_parts(struct located *l, uint32_t whole)
{
	l->left->count = 0;
	return list_parts(l, whole, l->left);
}

/* ---- places that overlap ---- */

/* From the first bit of the first part to the last bit of the last one. False: not known. */
static bool bits_of(struct located *l, const struct parts *parts, uint64_t *first, uint64_t *end)
{
	const struct meaning *m = parts->count ? meaning_at(l, parts->part[0]) : NULL;

	if (!m || m->addr.area == AREA_NONE)
		return false;
	*first = m->addr.byte * UINT64_C(8) + m->addr.bit;
	m = meaning_at(l, parts->part[parts->count - 1]);
	if (!m || m->addr.area == AREA_NONE)
		return false;
	*end = m->addr.byte * UINT64_C(8) + m->addr.bit + m->addr.bits;
	return true;
}

/* Parts of two variables: those of one variable are the same or apart. */
static bool may_overlap(struct located *l, uint32_t from, uint32_t to)
{
	const struct meaning *a = meaning_at(l, from), *b = meaning_at(l, to);
	uint64_t first[2], end[2];

	if (!is_located(a) || !is_located(b) || a->addr.area != b->addr.area || a->var == b->var)
		return false;
	l->left->count = l->right->count = 0;
	return meaning_is_indexed(a) || meaning_is_indexed(b) || !list_parts(l, from, l->left) ||
	       !list_parts(l, to, l->right) || !bits_of(l, l->left, &first[0], &end[0]) ||
	       !bits_of(l, l->right, &first[1], &end[1]) || (first[0] < end[1] && first[1] < end[0]);
}

static uint32_t copy_like(struct located *l, const struct meaning *m)
{
	const uint32_t copy = temps_whole(l->temps, &(struct meaning){
		.kind = m->kind, .type = m->type, .word = m->word,
		.array = m->kind == MEANING_ARRAY ? m->array : (struct var_array){ 0 },
		.dim = m->dim, .dims = m->dims });

	l->failed |= !copy;
	return copy;
}

/* A copy of @from, so that no part is read after another one was written over it. @good: as of add_move(). */
static uint32_t kept(struct located *l, uint32_t from, uint32_t good)
{
	const uint32_t copy = copy_like(l, meaning_at(l, from));

	move_parts(l, from, copy, good);
	return copy;
}

/* ---- calls ---- */

static bool is_argument(const struct il *il, int at)
{
	return at < il->count && (il->line[at].kind == IL_ARG_IN || il->line[at].kind == IL_ARG_OUT);
}

static bool is_pin(struct located *l, const struct il_line *line, const char *name)
{
	return line->pin && name_equal(scope_text(l->translation->scope, line->pin), name);
}

/* The row of the function or block that is called; NULL: nothing of the project. */
static const struct word_row *called_row(struct located *l, const struct il_line *line)
{
	const struct meaning *m = line->kind == IL_OP && line->op == OP_CAL ? meaning_at(l, line->operand) : NULL;
	const enum word word = line->kind == IL_CALL ? (enum word)line->word :
			       m && m->kind == MEANING_INSTANCE ? (enum word)m->word : WORD_COUNT;

	return word_is_own(word) ? scope_row(l->translation->scope, word) : NULL;
}

static const struct word_pin *pin_of(struct located *l, const struct word_row *row, const struct il_line *arg)
{
	const char *name = arg->pin ? scope_text(l->translation->scope, arg->pin) : "";
	const int index = row->kind == WORD_FN && name_equal(name, words_result(row)) ? 0 :
			  word_pin_find(row, name, strlen(name));

	return index < 0 || index >= row->pin_count ? NULL : &row->pin[index];
}

/* A copy for the argument, if it needs one. */
static bool begin_copy(struct located *l, const struct word_row *row, const struct il_line *arg, struct copied *out)
{
	const struct meaning *m = meaning_at(l, arg->operand);
	const struct word_pin *pin = is_located(m) ? pin_of(l, row, arg) : NULL;

	*out = (struct copied){ .from = 0 };
	if (!pin || !fits_pin(m, pin) || !has_parts(l, arg->operand))
		return false;
	*out = (struct copied){
		.from = arg->operand,
		.to = copy_like(l, m),
		.takes = arg->kind == IL_ARG_IN, .gives_back = pin->dir != PIN_IN,
		.computed = meaning_is_indexed(m), .reads = arg->kind == IL_ARG_IN && meaning_is_indexed(m),
	};
	return true;
}

/* @condition of the call, or that of a function, which may have none, is the beginning of @good. */
static void begin_good(struct located *l, int at, int end, uint32_t condition, uint32_t good)
{
	condition = condition ? condition : located_intern(l, "TRUE");
	for (int i = at + 1; i < end; i++)
		if (l->from->line[i].kind == IL_ARG_IN && is_pin(l, &l->from->line[i], "EN"))
			condition = l->from->line[i].operand;
	add_op(l, OP_LD, 0, condition);
	add_op(l, OP_ST, 0, good);
}

/* CALC and CALCN: the result that decides is needed behind the copies. */
static void keep_condition(struct located *l, const struct il_line *call, uint32_t condition)
{
	if (call->modifiers & MOD_C)
		add_op(l, OP_ST, call->modifiers & MOD_N, condition);
}

/* The operand of the argument ENO; 0: there is none. */
static uint32_t eno_of(struct located *l, int at, int end)
{
	for (int i = at + 1; i < end; i++)
		if (l->from->line[i].kind == IL_ARG_OUT && is_pin(l, &l->from->line[i], "ENO"))
			return l->from->line[i].operand;
	return 0;
}

/* Values that the call stores where copies come back, such as `Row[i] := Turn(Row)`: they are stored behind the copies. */
static void find_late(struct located *l, const struct word_row *row, int at, int end, struct copied *copy)
{
	for (int i = at + 1; i < end; i++) {
		const struct il_line *arg = &l->from->line[i];
		const struct meaning *m = arg->kind == IL_ARG_OUT && !copy[i - at - 1].from && pin_of(l, row, arg) ?
					  meaning_at(l, arg->operand) : NULL;
		bool meets = false;

		for (int k = 0; m && k < end - at - 1; k++) {
			const struct meaning *back = copy[k].gives_back ? meaning_at(l, copy[k].from) : NULL;

			meets |= back && back->addr.area == m->addr.area;
		}
		if (!meets || m->addr.area == AREA_NONE || meaning_is_whole(m) || m->type == IEC_NONE)
			continue;
		copy[i - at - 1].late = m->type == IEC_BOOL ? temps_bool(l->temps) : temps_number(l->temps, m->type);
		copy[i - at - 1].computed = meaning_is_indexed(m);
		l->failed |= !copy[i - at - 1].late;
	}
}

/* The call itself. @done: gets whether it was computed; 0: nobody asks. */
static void call_again(struct located *l, int at, int end, const struct copied *copy, uint32_t condition,
		       uint32_t good, uint32_t done)
{
	struct il_line call = l->from->line[at];
	const uint32_t eno = call.kind == IL_CALL ? eno_of(l, at, end) : good ? good : condition;

	if (call.kind == IL_OP && (condition || good)) {
		add_op(l, OP_LD, 0, good ? good : condition);
		call.modifiers = (uint8_t)((call.modifiers & ~MOD_N) | MOD_C);
	}
	call.mark = l->like.mark;
	l->like.mark &= (uint8_t)~IL_BEGINS;
	add_line(l, call);
	if (call.kind == IL_CALL && good)
		add_pin(l, IL_ARG_IN, "EN", good);
	for (int i = at + 1; i < end; i++) {
		struct il_line arg = l->from->line[i];

		if (good && call.kind == IL_CALL && arg.kind == IL_ARG_IN && is_pin(l, &arg, "EN"))
			continue;
		if (copy[i - at - 1].from)
			arg.operand = copy[i - at - 1].to;
		if (copy[i - at - 1].late)
			arg.operand = copy[i - at - 1].late;
		add_line(l, arg);
	}
	if (!done)
		return;
	if (call.kind == IL_CALL && !eno) {
		add_pin(l, IL_ARG_OUT, "ENO", done);
		return;
	}
	add_op(l, OP_LD, 0, eno ? eno : located_intern(l, "TRUE"));
	add_op(l, OP_ST, 0, done);
}

/* The call at @at, whose arguments end before @end, with copies. */
static void copy_call(struct located *l, int at, int end, const struct copied *copy)
{
	const struct il_line *call = &l->from->line[at];
	uint32_t condition = call->modifiers & MOD_C ? temps_bool(l->temps) : 0, good = 0, done = 0;

	keep_condition(l, call, condition);
	for (int i = 0; i < end - at - 1; i++) {
		if (((copy[i].from && copy[i].reads) || (copy[i].late && copy[i].computed)) && !good)
			good = temps_bool(l->temps);
		if (copy[i].from && copy[i].gives_back && !done)
			done = temps_bool(l->temps);
	}
	if (good)
		begin_good(l, at, call->kind == IL_CALL ? end : at, condition, good);
	for (int i = 0; i < end - at - 1; i++)
		if (copy[i].from && copy[i].takes)
			move_parts(l, copy[i].from, copy[i].to, copy[i].reads ? good : 0);
	for (int i = 0; i < end - at - 1; i++)
		if (copy[i].late && copy[i].computed) /* if it leads nowhere, nothing is called */
			add_move(l, l->from->line[at + 1 + i].operand, copy[i].late, good);
	call_again(l, at, end, copy, condition, good, done);
	for (int i = 0; i < end - at - 1; i++)
		if (copy[i].from && copy[i].gives_back)
			move_parts(l, copy[i].to, copy[i].from, copy[i].computed ? begin_chain(l, done) : done);
	for (int i = 0; i < end - at - 1; i++)
		if (copy[i].late)
			add_move(l, copy[i].late, l->from->line[at + 1 + i].operand, begin_chain(l, done));
}

/* ---- MOVE ---- */

/* MOVE of a whole. False: it is no such call. */
static bool copy_move(struct located *l, int at, int end)
{
	const struct il_line *line = l->from->line;
	uint32_t in = 0, out = 0, eno = 0, good;

	if (line[at].kind != IL_CALL || line[at].word != FN_MOVE)
		return false;
	for (int i = at + 1; i < end; i++) {
		in = is_pin(l, &line[i], "IN") ? line[i].operand : in;
		out = is_pin(l, &line[i], "OUT") ? line[i].operand : out;
		eno = is_pin(l, &line[i], "ENO") ? line[i].operand : eno;
	}
	const struct meaning *a = meaning_at(l, in), *b = meaning_at(l, out);

	if (!same_whole(a, b) || !meaning_is_whole(a) || (!is_located(a) && !is_located(b)) || !has_parts(l, in))
		return false;
	good = temps_bool(l->temps);
	begin_good(l, at, end, 0, good);
	if (may_overlap(l, in, out))
		in = kept(l, in, good);
	move_parts(l, in, out, good);
	if (eno) {
		add_op(l, OP_LD, 0, good);
		add_op(l, OP_ST, 0, eno);
	}
	return true;
}

/* ---- LD and ST ---- */

/* Behind the ST that store what the LD at @at took; @at itself, if it is no LD of a whole. */
static int stores_end(struct located *l, int at)
{
	const struct il_line *line = l->from->line;
	const struct meaning *m = line[at].kind == IL_OP && line[at].op == OP_LD && !line[at].modifiers ?
				  meaning_at(l, line[at].operand) : NULL;
	int end = at + 1;

	if (!m || !meaning_is_whole(m))
		return at;
	while (end < l->from->count && line[end].kind == IL_OP && line[end].op == OP_ST)
		end++;
	return end;
}

/* LD and the ST behind it, up to @end, if a part of them has an address. */
static bool copy_result(struct located *l, int at, int end)
{
	const struct il_line *line = l->from->line;
	uint32_t from = line[at].operand, good = 0, read = 0;
	const struct meaning *of = meaning_at(l, from);
	bool any = false, overlaps = false;

	for (int i = at + 1; i < end; i++) {
		const struct meaning *m = meaning_at(l, line[i].operand);

		if (!same_whole(of, m) || !has_parts(l, line[i].operand))
			return false;
		any = any || is_located(of) || is_located(m);
		overlaps = overlaps || may_overlap(l, from, line[i].operand);
	}
	if (overlaps) {
		read = meaning_is_indexed(of) ? temps_bool(l->temps) : 0;
		good = read ? begin_chain(l, 0) : 0;
		from = kept(l, from, good);
		if (read) {
			add_op(l, OP_LD, 0, good);
			add_op(l, OP_ST, 0, read);
		}
	}
	for (int i = at + 1; i < end && any; i++) {
		l->like.line = line[i].line;
		l->like.row = line[i].row;
		l->like.col = line[i].col;
		if (is_located(of) || is_located(meaning_at(l, line[i].operand))) {
			move_parts(l, from, line[i].operand, read ? begin_chain(l, read) : 0);
			continue;
		}
		add_line(l, line[at]);
		add_line(l, line[i]);
	}
	return any;
}

/* ---- lists ---- */

static void copy_lines(struct located *l)
{
	const struct il *from = l->from;
	struct copied copy[LIMIT_ARGS];

	for (int i = 0; i < from->count && !l->failed; i++) {
		const struct word_row *row = called_row(l, &from->line[i]);
		const int stores = stores_end(l, i);
		int end = i + 1;
		bool any = false;

		l->like = from->line[i];
		l->like.pin = l->like.word = 0;
		l->like.modifiers = 0;
		while (is_argument(from, end) && end - i <= LIMIT_ARGS)
			end++;
		for (int k = i + 1; k < end && row; k++)
			any |= begin_copy(l, row, &from->line[k], &copy[k - i - 1]);
		if (any) {
			find_late(l, row, i, end, copy);
			copy_call(l, i, end, copy);
			i = end - 1;
		} else if (copy_move(l, i, end)) {
			i = end - 1;
		} else if (copy_result(l, i, stores)) {
			i = stores - 1;
		} else {
			add_line(l, from->line[i]);
		}
	}
}

/* Is there a structure or array at an address? */
static bool has_located(const struct var_table *table)
{
	for (int i = 0; i < table->count; i++)
		if (table->var[i].at.area != AREA_NONE && (table->var[i].type == IEC_NONE || table->var[i].array.count))
			return true;
	return false;
}

bool located_calls(struct translation *translation, struct unit *unit, struct il *il)
{
	struct located l = { .translation = translation, .unit = unit, .temps = unit->temps, .from = il,
			     .to = { .arena = il->arena } };

	if (!unit->temps || (!has_located(&translation->project->globals) && !has_located(&unit->pou->vars)))
		return true;
	l.left = arena_alloc(translation->arena, sizeof(*l.left));
	l.right = arena_alloc(translation->arena, sizeof(*l.right));
	if (!l.left || !l.right)
		return false;
	unit->temps->bools = unit->temps->bool_count; /* the others are in use */
	for (int i = 0; i < IEC_TYPE_COUNT; i++)
		unit->temps->numbers[i] = unit->temps->number_count[i];
	for (int i = 0; i < unit->temps->whole_count; i++)
		unit->temps->whole[i].used = true;
	copy_lines(&l);
	if (!l.failed)
		*il = l.to;
	return !l.failed;
}
