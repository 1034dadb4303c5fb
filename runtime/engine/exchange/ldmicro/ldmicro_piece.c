/* SPDX-License-Identifier: MIT
 *
 * ldmicro_piece - what each element of LDmicro becomes: a cell, a box, lines in an Execute box.
 *
 * An element also says which variables it reads and writes: ldmicro_rung.c needs that for the order.
 * Numbers wrap as those of LDmicro do. An element without an equivalent is a box that says what it was.
 */
#include "engine/exchange/ldmicro/ldmicro_parts.h"

#include <stdlib.h>
#include <string.h>

struct making {
	struct ldmicro_conversion *c;
	struct ldmicro_node *node;
	struct ldmicro_piece *piece;
	const char *before;      /* statements in front of the one in work         */
};

static const char *arg(const struct making *m, int i)
{
	return i < m->node->args ? m->node->arg[i] : "";
}

static void reads(struct making *m, const struct ldmicro_var *var)
{
	name_add(m->c, &m->piece->reads, var->ours);
}

static struct ldmicro_var *written(struct making *m, const char *name)
{
	struct ldmicro_var *var = var_of(m->c, name, false);

	name_add(m->c, &m->piece->writes, var->ours);
	return var;
}

/* ---- operands ---- */

/* As a variable of @bytes holds it. */
static long long wrap(long long value, int bytes)
{
	return bytes == 1 ? (int8_t)(uint8_t)value : bytes == 2 ? (int16_t)(uint16_t)value :
	       (int32_t)(uint32_t)value;
}

static const char *number_text(struct making *m, long long value)
{
	return w_text(&m->c->w, value < 0 ? "(%lld)" : "%lld", value);
}

/* A number or variable as a value of @bytes. A narrower one is cut in a statement of its own: in one
 * expression it would stop the rest. */
static const char *operand(struct making *m, const char *text, int bytes)
{
	const struct ldmicro_var *var;
	const char *cut;
	long long value;

	if (ldmicro_number(text, &value))
		return number_text(m, wrap(value, bytes));
	var = var_of(m->c, text, false);
	reads(m, var);
	if (var->bytes == bytes)
		return var->ours;
	if (var->bytes < bytes)
		return w_text(&m->c->w, "%s_TO_%s(%s)", type_of(var->bytes), type_of(bytes), var->ours);
	cut = cut_new(m->c, bytes);
	m->before = w_text(&m->c->w, "%s    %s := %s_TO_%s(%s);\n", m->before, cut, type_of(var->bytes),
			   type_of(bytes), var->ours);
	return cut;
}

static const char *word_of(int bytes)
{
	return bytes == 1 ? "BYTE" : bytes == 2 ? "WORD" : "DWORD";
}

/* The same as bits. */
static const char *bits(struct making *m, const char *text, int bytes)
{
	long long value;

	if (ldmicro_number(text, &value))
		return w_text(&m->c->w, "%s#16#%llX", word_of(bytes),
			      value & (bytes == 1 ? 0xffLL : bytes == 2 ? 0xffffLL : 0xffffffffLL));
	return w_text(&m->c->w, "%s_TO_%s(%s)", type_of(bytes), word_of(bytes),
		      operand(m, text, bytes));
}

/* ---- what an element has no equivalent for ---- */

/* @passes: power goes through, else none comes out. */
static void stand_in(struct making *m, bool passes)
{
	struct ldmicro_conversion *c = m->c;
	const char *type = block_of(c, BLOCK_NOTHING, 2);

	m->piece->kind = PIECE_BOX;
	m->piece->lines = NULL;
	m->piece->cell = w_text(&c->w, "%s %s %sWHAT:=%s", type, instance_new(c, type, "Missing"),
				passes ? "PASS:=TRUE " : "", w_string(&c->w, m->node->text, 70));
	w_tell(&c->w, REPORT_LOST, "it has no equivalent; a box that does nothing stands in its place: %s",
	       w_string(&c->w, m->node->text, 70));
}

static bool is_number(const char *text)
{
	long long value;

	return ldmicro_number(text, &value);
}

/* ---- statements ---- */

/* One assignment is a cell of its own at the end of a branch. */
static void assign(struct making *m, const struct ldmicro_var *var, const char *value)
{
	struct ldmicro_conversion *c = m->c;

	m->piece->kind = PIECE_LINES;
	m->piece->cell = w_text(&c->w, "EXECUTE %s", var->ours);
	m->piece->lines = w_text(&c->w, "%s    %s := %s;\n", m->before, var->ours, value);
	if (!*m->before)
		m->piece->last = w_text(&c->w, "[ %s := %s ]", var->ours, value);
}

/* Of numbers alone; false: it has no result. */
static bool compute(enum ldmicro_word word, long long a, long long b, long long *out)
{
	if ((word == LDM_DIV || word == LDM_MOD) && b == 0)
		return false;
	*out = word == LDM_ADD ? a + b : word == LDM_SUB ? a - b : word == LDM_MUL ? a * b :
	       word == LDM_DIV ? a / b : a % b;
	return true;
}

static void make_arithmetic(struct making *m)
{
	static const char *const sign[] = { [LDM_ADD] = "+", [LDM_SUB] = "-", [LDM_MUL] = "*",
					    [LDM_DIV] = "/", [LDM_MOD] = "MOD" };
	const enum ldmicro_word word = m->node->word;
	long long a = 0, b = 0, result = 0;
	const bool one = ldmicro_number(arg(m, 1), &a), two = ldmicro_number(arg(m, 2), &b);
	const struct ldmicro_var *var;
	const char *left, *right;

	const int bytes = is_number(arg(m, 0)) ? 2 : var_of(m->c, arg(m, 0), false)->bytes;

	if (is_number(arg(m, 0)) ||
	    (two && wrap(b, bytes) == 0 && (word == LDM_DIV || word == LDM_MOD))) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	if (one && two && compute(word, wrap(a, var->bytes), wrap(b, var->bytes), &result)) {
		assign(m, var, w_text(&m->c->w, "%lld", wrap(result, var->bytes)));
		return;
	}
	left = operand(m, arg(m, 1), var->bytes);
	right = operand(m, arg(m, 2), var->bytes);
	assign(m, var, w_text(&m->c->w, "%s %s %s", left, sign[word], right));
}

static void make_move(struct making *m)
{
	const struct ldmicro_var *var;
	const char *value;
	long long number;

	if (is_number(arg(m, 0))) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	if (ldmicro_number(arg(m, 1), &number)) {
		number = wrap(number, var->bytes);
		assign(m, var, w_text(&m->c->w, "%lld", m->node->word == LDM_NEG ? wrap(-number, var->bytes) :
								       number));
		return;
	}
	value = operand(m, arg(m, 1), var->bytes);
	assign(m, var, m->node->word == LDM_NEG ? w_text(&m->c->w, "0 - %s", value) : value);
}

/* AND OR XOR NOT, shifts by a constant, SWAP. */
static void make_bits(struct making *m)
{
	struct writing *w = &m->c->w;
	const enum ldmicro_word word = m->node->word;
	const bool shift = word == LDM_SHL || word == LDM_SHR || word == LDM_SR0 ||
			   word == LDM_ROL || word == LDM_ROR;
	const struct ldmicro_var *var;
	const char *a, *b = "", *value;
	long long count = 0;

	if (is_number(arg(m, 0)) || (shift && !ldmicro_number(arg(m, 2), &count)) || count < 0 ||
	    count > 32) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	a = bits(m, arg(m, 1), var->bytes);
	if (!shift && word != LDM_NOT && word != LDM_SWAP)
		b = bits(m, arg(m, 2), var->bytes);
	if (word == LDM_NOT)
		value = w_text(w, "NOT %s", a);
	else if (word == LDM_AND || word == LDM_OR || word == LDM_XOR)
		value = w_text(w, "%s %s %s", a, word == LDM_AND ? "AND" : word == LDM_OR ? "OR" : "XOR", b);
	else if (word == LDM_SWAP)
		value = var->bytes == 4 ?
			w_text(w, "(ROL(%s, 8) AND DWORD#16#FF00FF) OR (ROR(%s, 8) AND DWORD#16#FF00FF00)", a, a) :
			w_text(w, "ROL(%s, %d)", a, 4 * var->bytes);
	else
		value = w_text(w, "%s(%s, %lld)", word == LDM_SHL ? "SHL" : word == LDM_ROL ? "ROL" :
			       word == LDM_ROR ? "ROR" : "SHR", a, count);
	value = w_text(w, "%s_TO_%s(%s)", word_of(var->bytes), type_of(var->bytes), value);
	assign(m, var, value);
	if (word != LDM_SHR)
		return;
	/* An arithmetic shift keeps the sign. */
	a = operand(m, arg(m, 1), var->bytes);
	m->piece->last = NULL;
	m->piece->lines = w_text(w, "%s    IF %s < 0 THEN\n      %s := %s_TO_%s(NOT SHR(NOT %s, %lld));\n    ELSE\n"
				    "      %s := %s;\n    END_IF;\n", m->before, a, var->ours, word_of(var->bytes),
				 type_of(var->bytes), bits(m, arg(m, 1), var->bytes), count, var->ours, value);
}

/* Bit number @text of a variable, as a BOOL; NULL: there is none. */
static const char *bit_text(struct making *m, const struct ldmicro_var *var, const char *text)
{
	long long bit;

	return ldmicro_number(text, &bit) && bit >= 0 && bit < 8 * var->bytes ?
	       w_text(&m->c->w, "%s.%lld", var->ours, bit) : NULL;
}

static void make_bit(struct making *m)
{
	const bool test = m->node->word == LDM_IF_BIT_SET || m->node->word == LDM_IF_BIT_CLEAR;
	const bool set = m->node->word == LDM_IF_BIT_SET || m->node->word == LDM_SET_BIT;
	const struct ldmicro_var *var = is_number(arg(m, 0)) ? NULL : var_of(m->c, arg(m, 0), false);
	const char *bit = var ? bit_text(m, var, arg(m, 1)) : NULL;

	if (!bit) {
		stand_in(m, !test);
		return;
	}
	if (test) {
		reads(m, var);
		m->piece->kind = PIECE_TEST;
		m->piece->cell = w_text(&m->c->w, "%s %s", set ? "NO" : "NC", bit);
		return;
	}
	written(m, arg(m, 0));
	m->piece->kind = PIECE_LINES;
	m->piece->cell = w_text(&m->c->w, "EXECUTE %s", var->ours);
	m->piece->lines = w_text(&m->c->w, "    %s := %s;\n", bit, set ? "TRUE" : "FALSE");
	m->piece->last = w_text(&m->c->w, "%s %s", set ? "S" : "R", bit);
}

/* ---- tables ---- */

/* An index or value that another table of the same file gave as a number. */
static bool table_values(struct making *m, int from, long long count, long long most)
{
	if (count < 0 || count > most || m->node->args < from + (int)count || is_number(arg(m, 0)))
		return false;
	for (int i = 0; i < count; i++)
		if (!is_number(arg(m, from + i)))
			return false;
	return true;
}

static long long value_at(const struct making *m, int i)
{
	long long value = 0;

	ldmicro_number(arg(m, i), &value);
	return value;
}

static void make_look_up(struct making *m)
{
	struct writing *w = &m->c->w;
	const long long count = value_at(m, 2);
	const struct ldmicro_var *var;
	const char *index, *text;

	if (!table_values(m, 4, count, 1024)) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	index = is_number(arg(m, 1)) ? arg(m, 1) : var_of(m->c, arg(m, 1), false)->ours;
	if (!is_number(arg(m, 1)))
		name_add(m->c, &m->piece->reads, index);
	m->piece->kind = PIECE_LINES;
	m->piece->cell = w_text(w, "EXECUTE %s", var->ours);
	if (is_number(arg(m, 1))) {
		const long long at = value_at(m, 1);

		m->piece->lines = at >= 0 && at < count ?
			w_text(w, "    %s := %lld;\n", var->ours, wrap(value_at(m, (int)(4 + at)), var->bytes)) : "";
		return;
	}
	text = w_text(w, "    CASE %s OF\n", index);
	for (int i = 0; i < count; i++)
		text = w_text(w, "%s      %d: %s := %lld;\n", text, i, var->ours,
			      wrap(value_at(m, 4 + i), var->bytes));
	m->piece->lines = count ? w_text(w, "%s    END_CASE;\n", text) : "";
}

/* One segment after the other, from the last to the first: a later one replaces what an earlier one
 * gave, as in LDmicro. */
static void make_linear(struct making *m)
{
	struct writing *w = &m->c->w;
	const long long count = value_at(m, 2);
	const struct ldmicro_var *var, *from;
	const char *text = "";

	if (count > 1024 || !table_values(m, 3, 2 * count, 2048) || is_number(arg(m, 1))) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	from = var_of(m->c, arg(m, 1), false);
	for (int i = (int)count - 1; i > 0; i--) {
		const long long x = value_at(m, 3 + 2 * i), y = value_at(m, 4 + 2 * i);
		const long long x0 = value_at(m, 1 + 2 * i), y0 = value_at(m, 2 + 2 * i);

		if (x <= x0) {
			stand_in(m, true);
			return;
		}
		m->before = "";
		const char *index = operand(m, arg(m, 1), var->bytes);

		text = w_text(w, "%s    IF %s <= %lld THEN\n%s      %s := %s - %s;\n      %s := %s * %s;\n"
			      "      %s := %s / %s;\n      %s := %s + %s;\n    END_IF;\n", text, from->ours,
			      wrap(x, from->bytes), m->before, var->ours, index,
			      number_text(m, wrap(x0, var->bytes)), var->ours, var->ours,
			      number_text(m, wrap(y - y0, var->bytes)), var->ours, var->ours,
			      number_text(m, wrap(x - x0, var->bytes)), var->ours, var->ours,
			      number_text(m, wrap(y0, var->bytes)));
	}
	m->piece->kind = PIECE_LINES;
	m->piece->cell = w_text(w, "EXECUTE %s", var->ours);
	m->piece->lines = text;
}

static void make_shift_register(struct making *m)
{
	struct writing *w = &m->c->w;
	const long long stages = value_at(m, 1);
	const char *text = "", *to = NULL;

	if (stages < 1 || stages > LDMICRO_STAGES) {
		stand_in(m, true);
		return;
	}
	for (long long i = stages - 1; i >= 0; i--) {
		const char *from = w_text(w, "%s%lld", arg(m, 0), i);
		const struct ldmicro_var *var = written(m, from);

		reads(m, var);
		if (to) {
			const struct ldmicro_var *next = var_of(m->c, to, false);

			m->before = "";
			const char *value = operand(m, from, next->bytes);

			text = w_text(w, "%s%s    %s := %s;\n", text, m->before, next->ours, value);
		}
		to = from;
	}
	m->piece->kind = PIECE_EDGE;
	m->piece->edge = w_text(w, "R_TRIG %s", instance_new(m->c, "R_TRIG", w_text(w, "%s_Edge", arg(m, 0))));
	m->piece->cell = w_text(w, "EXECUTE SHIFT_REGISTER");
	m->piece->lines = text;
}

/* ---- comparisons ---- */

static void make_comparison(struct making *m)
{
	static const char *const sign[] = { [LDM_EQU] = "=", [LDM_NEQ] = "<>", [LDM_GRT] = ">",
					    [LDM_GEQ] = ">=", [LDM_LES] = "<", [LDM_LEQ] = "<=" };
	const enum ldmicro_word word = m->node->word;
	long long a, b;
	const bool one = ldmicro_number(arg(m, 0), &a), two = ldmicro_number(arg(m, 1), &b);
	const char *left, *right;

	m->piece->kind = PIECE_TEST;
	if (one && two) {
		const bool yes = word == LDM_EQU ? a == b : word == LDM_NEQ ? a != b : word == LDM_GRT ? a > b :
				 word == LDM_GEQ ? a >= b : word == LDM_LES ? a < b : a <= b;

		m->piece->cell = yes ? "[ TRUE ]" : "[ FALSE ]";
		return;
	}
	const struct ldmicro_var *x = one ? NULL : var_of(m->c, arg(m, 0), false);
	const struct ldmicro_var *y = two ? NULL : var_of(m->c, arg(m, 1), false);

	if (x)
		reads(m, x);
	if (y)
		reads(m, y);
	left = x ? x->ours : w_text(&m->c->w, "%lld", wrap(a, y->bytes));
	right = y ? y->ours : w_text(&m->c->w, "%lld", wrap(b, x->bytes));
	m->piece->cell = w_text(&m->c->w, "[ %s %s %s ]", left, sign[word], right);
}

/* ---- contacts, coils, edges ---- */

static void make_contact(struct making *m)
{
	const struct ldmicro_var *var = var_of(m->c, arg(m, 0), true);

	m->piece->kind = PIECE_TEST;
	m->piece->cell = w_text(&m->c->w, "%s %s", ldmicro_int(arg(m, 1)) ? "NC" : "NO", var->ours);
	reads(m, var);
}

static void make_coil(struct making *m)
{
	struct writing *w = &m->c->w;
	const struct ldmicro_var *var = var_of(m->c, arg(m, 0), true);

	name_add(m->c, &m->piece->writes, var->ours);
	m->piece->kind = PIECE_COIL;
	if (ldmicro_int(arg(m, 4)) && !ldmicro_int(arg(m, 1)) && !ldmicro_int(arg(m, 2)) && !ldmicro_int(arg(m, 3))) {
		reads(m, var);
		m->piece->kind = PIECE_EDGE;
		m->piece->edge = w_text(w, "R_TRIG %s", instance_new(m->c, "R_TRIG",
								     w_text(w, "%s_Edge", arg(m, 0))));
		m->piece->cell = w_text(w, "[ %s := NOT %s ]", var->ours, var->ours);
		return;
	}
	m->piece->cell = w_text(w, "%s %s", ldmicro_int(arg(m, 1)) ? "COILNOT" : ldmicro_int(arg(m, 2)) ? "S" :
				ldmicro_int(arg(m, 3)) ? "R" : "COIL", var->ours);
}

static void make_edge(struct making *m)
{
	struct writing *w = &m->c->w;
	const enum ldmicro_word word = m->node->word;
	const char *type = word == LDM_OSR || word == LDM_ODR ? "R_TRIG" : word == LDM_OSF ? "F_TRIG" :
			   block_of(m->c, word == LDM_OSC ? BLOCK_OSC : BLOCK_ODF, 2);
	const char *wish = word == LDM_OSR || word == LDM_ODR ? "Rise" : word == LDM_OSF ? "Fall" :
			   word == LDM_OSC ? "Osc" : "Drop";

	m->piece->kind = PIECE_BOX;
	m->piece->cell = w_text(w, "%s %s", type, instance_new(m->c, type, wish));
	if (word != LDM_ODR)
		return;
	m->piece->kind = PIECE_TEST;
	m->piece->edge = m->piece->cell;
	m->piece->cell = "NOT";
}

/* ---- timers and counters ---- */

static void make_timer(struct making *m)
{
	static const enum ldmicro_block block[] = {
		[LDM_TON] = BLOCK_TON, [LDM_TOF] = BLOCK_TOF, [LDM_RTO] = BLOCK_RTO,
		[LDM_RTL] = BLOCK_RTL, [LDM_TCY] = BLOCK_TCY, [LDM_THI] = BLOCK_THI, [LDM_TLO] = BLOCK_TLO,
	};
	struct ldmicro_conversion *c = m->c;
	const enum ldmicro_word word = m->node->word;
	struct ldmicro_var *var = var_of(c, arg(m, 0), false);
	const long long period = period_of(c, m->node);
	const long long us = (long long)period * c->program->cycle_us;
	long long delay = 0;
	const char *type;

	m->piece->kind = PIECE_BOX;
	if (ldmicro_number(arg(m, 1), &delay) && delay < c->program->cycle_us)
		w_tell(&c->w, REPORT_CHANGED, "%s is shorter than a cycle; it takes one", arg(m, 0));
	if ((word == LDM_TON || word == LDM_TOF) && period && var->uses == 1 && !c->jumps &&
	    us % 1000 == 0 && us <= 0x7fffffff * 1000LL) {
		type = word == LDM_TON ? "TON" : "TOF";
		if (!var->is_block) {
			void *slot = arena_push(c->w.arena, &c->instance, &c->instances,
						sizeof(*c->instance));

			if (slot) {
				c->instance[c->instances - 1].type = type;
				c->instance[c->instances - 1].name = var->ours;
			}
		}
		var->is_block = true;
		m->piece->cell = w_text(&c->w, "%s %s PT:=T#%lldms", type, var->ours, us / 1000);
		return;
	}
	written(m, arg(m, 0));
	reads(m, var);
	if (!period)
		reads(m, var_of(c, arg(m, 1), false));
	type = block_of(c, block[word], var->bytes);
	m->piece->cell = w_text(&c->w, "%s %s P:=%s N:=%s", type,
				instance_new(c, type, w_text(&c->w, "%s_%s", arg(m, 0), type + 4)),
				period ? w_text(&c->w, "%lld", period) : var_of(c, arg(m, 1), false)->ours,
				var->ours);
}

/* At a pin in a cell, which takes no calls and widens by itself. */
static const char *pin_value(struct making *m, const char *text, int bytes)
{
	const struct ldmicro_var *var;
	long long value;

	if (ldmicro_number(text, &value))
		return w_text(&m->c->w, "%lld", wrap(value, bytes));
	var = var_of(m->c, text, false);
	if (var->bytes > bytes)
		return operand(m, text, bytes);
	reads(m, var);
	return var->ours;
}

static void make_counter(struct making *m)
{
	static const enum ldmicro_block block[] = {
		[LDM_CTU] = BLOCK_CTU, [LDM_CTD] = BLOCK_CTD, [LDM_CTC] = BLOCK_CTC, [LDM_CTR] = BLOCK_CTR,
	};
	struct ldmicro_conversion *c = m->c;
	struct writing *w = &c->w;
	const struct ldmicro_var *var = written(m, arg(m, 0));
	const char *type = block_of(c, block[m->node->word], var->bytes);
	const char *kinds = "/\\-o", *kind = m->node->args > 3 && *arg(m, 3) ? strchr(kinds, *arg(m, 3)) : kinds;
	const char *from = m->node->args > 2 ? arg(m, 2) : "0";
	const char *most = pin_value(m, arg(m, 1), var->bytes), *start = pin_value(m, from, var->bytes);

	reads(m, var);
	if (*m->before || !kind) { /* a limit wider than the count */
		stand_in(m, false);
		return;
	}
	m->piece->kind = PIECE_BOX;
	m->piece->cell = w_text(w, "%s %s MOST:=%s%s%s%s%s N:=%s", type,
				instance_new(c, type, w_text(w, "%s_%s", arg(m, 0), type + 4)),
				most, strcmp(from, "0") ? " FROM:=" : "", strcmp(from, "0") ? start : "",
				is_number(from) ? "" : " LATE:=TRUE",
				kind > kinds ? w_text(w, " KIND:=%d", (int)(kind - kinds) + 1) : "", var->ours);
}

/* The counter of a name, as LDmicro looks for it: CTU first, then CTD, CTC, CTR. */
static const struct ldmicro_node *find_counter(const struct ldmicro_node *node, enum ldmicro_word word,
					       const char *name)
{
	for (; node; node = node->next) {
		const struct ldmicro_node *found = node->first ? find_counter(node->first, word, name) : NULL;

		if (found)
			return found;
		if (node->word == word && !strcmp(node->arg[0], name))
			return node;
	}
	return NULL;
}

static void make_reset(struct making *m)
{
	const char *name = arg(m, 0), *value = "0";
	const struct ldmicro_node *counter = NULL;
	const struct ldmicro_var *var;
	struct ldmicro_conversion *c = m->c;

	if (is_number(name)) {
		stand_in(m, true);
		return;
	}
	for (int word = LDM_CTU; *name == 'C' && word <= LDM_CTR; word++)
		for (int i = 0; !counter && i < c->program->rungs; i++)
			counter = find_counter(c->program->rung[i].first, (enum ldmicro_word)word, name);
	var = written(m, name);
	if (counter && counter->args > 2)
		value = operand(m, counter->arg[2], var->bytes);
	assign(m, var, value);
}

static void make_count_of_time(struct making *m)
{
	const struct ldmicro_var *var;
	const long long period = period_of(m->c, m->node);

	if (!period || is_number(arg(m, 0))) {
		stand_in(m, true);
		return;
	}
	var = written(m, arg(m, 0));
	assign(m, var, w_text(&m->c->w, "%lld", wrap(period, var->bytes)));
}

/* ---- the world outside ---- */

static void make_analog(struct making *m)
{
	struct ldmicro_conversion *c = m->c;
	struct ldmicro_var *var;
	const char *input;

	if (is_number(arg(m, 0))) {
		stand_in(m, true);
		return;
	}
	input = w_text(&c->w, "%s_Input", arg(m, 0));
	if (!names_find(&c->spelled, input, strlen(input))) {
		struct ldmicro_var *own = var_of(c, input, false);

		own->comment = var_of(c, arg(m, 0), false)->comment;
		own->at = word_address(c, false);
		w_tell(&c->w, REPORT_CHANGED, "READ_ADC takes the value of %s: give it a converter in an I/O map, 0 to 1023",
		       own->ours);
	}
	var = written(m, arg(m, 0));
	assign(m, var, operand(m, input, var->bytes));
}

static void make_pulses(struct making *m)
{
	struct ldmicro_conversion *c = m->c;
	const char *given = arg(m, 2);
	const char *name = *given == 'P' ? given : w_text(&c->w, "P%s", given);
	struct ldmicro_var *var = written(m, name);

	if (!var->at)
		var->at = word_address(c, true);
	assign(m, var, operand(m, arg(m, 0), var->bytes));
	w_tell(&c->w, REPORT_CHANGED, "SET_PWM writes %s: give it an output of pulses of %s Hz in an I/O map",
	       var->ours, arg(m, 1));
}

/* ---- jumps ---- */

/* 0-based; -1: there is none. */
static int rung_of_label(const struct ldmicro_conversion *c, const char *label, enum ldmicro_word word)
{
	for (int i = 0; i < c->program->rungs; i++) {
		const struct ldmicro_node *node = c->program->rung[i].first;

		for (; node; node = node->next)
			if (node->word == word && !strcmp(node->arg[0], label))
				return i;
	}
	return -1;
}

static void make_jump(struct making *m)
{
	struct ldmicro_conversion *c = m->c;
	const bool sub = m->node->word == LDM_GOSUB;
	long long number = 0;
	int rung = ldmicro_number(arg(m, 0), &number) && !sub ? (int)(number < 1 ? 0 : number - 1) :
		   rung_of_label(c, arg(m, 0), sub ? LDM_SUBPROG : LDM_LABEL);

	m->piece->kind = PIECE_JUMP;
	m->piece->all = true;
	if (sub && rung >= 0 && c->subprogram[rung]) {
		m->piece->kind = PIECE_LINES;
		m->piece->cell = w_text(&c->w, "CALL %s", c->subprogram[rung]);
		return;
	}
	if (!sub && rung >= c->program->rungs && c->owner[c->rung] < 0) {
		m->piece->cell = "RET";
		return;
	}
	if (sub || rung < 0 || rung >= c->program->rungs || c->owner[rung] != c->owner[c->rung]) {
		m->piece->all = false;
		stand_in(m, true);
		return;
	}
	m->piece->cell = w_text(&c->w, "JMP %s", c->label[rung]);
}

/* ---- */

static void make(struct making *m)
{
	switch (m->node->word) {
	case LDM_CONTACTS: make_contact(m); break;
	case LDM_COIL: make_coil(m); break;
	case LDM_POWER:
		m->piece->kind = PIECE_TEST;
		m->piece->cell = w_text(&m->c->w, "NO %s", m->node->text);
		name_add(m->c, &m->piece->reads, m->node->text);
		break;
	case LDM_SHORT: case LDM_COMMENT: case LDM_LABEL: case LDM_SUBPROG: case LDM_ENDSUB:
		m->piece->cell = "---";
		break;
	case LDM_OPEN:
		m->piece->kind = PIECE_TEST;
		m->piece->cell = "[ FALSE ]";
		break;
	case LDM_MASTER_RELAY: m->piece->kind = PIECE_MASTER; break;
	case LDM_TON: case LDM_TOF: case LDM_RTO: case LDM_RTL: case LDM_TCY: case LDM_THI:
	case LDM_TLO: make_timer(m); break;
	case LDM_CTU: case LDM_CTD: case LDM_CTC: case LDM_CTR: make_counter(m); break;
	case LDM_RES: make_reset(m); break;
	case LDM_TIME2COUNT: make_count_of_time(m); break;
	case LDM_OSR: case LDM_OSF: case LDM_ODR: case LDM_ODF: case LDM_OSL: case LDM_OSC:
		make_edge(m); break;
	case LDM_EQU: case LDM_NEQ: case LDM_GRT: case LDM_GEQ: case LDM_LES: case LDM_LEQ:
		make_comparison(m); break;
	case LDM_IF_BIT_SET: case LDM_IF_BIT_CLEAR: case LDM_SET_BIT: case LDM_CLEAR_BIT:
		make_bit(m); break;
	case LDM_MOVE: case LDM_NEG: make_move(m); break;
	case LDM_ADD: case LDM_SUB: case LDM_MUL: case LDM_DIV: case LDM_MOD: make_arithmetic(m); break;
	case LDM_AND: case LDM_OR: case LDM_XOR: case LDM_NOT: case LDM_SHL: case LDM_SHR: case LDM_SR0:
	case LDM_ROL: case LDM_ROR: case LDM_SWAP: make_bits(m); break;
	case LDM_SHIFT_REGISTER: make_shift_register(m); break;
	case LDM_LOOK_UP_TABLE: make_look_up(m); break;
	case LDM_PIECEWISE_LINEAR: make_linear(m); break;
	case LDM_READ_ADC: make_analog(m); break;
	case LDM_SET_PWM: make_pulses(m); break;
	case LDM_PERSIST:
		m->piece->cell = w_text(&m->c->w, "--- (* %s *)", w_clean(&m->c->w, m->node->text));
		w_tell(&m->c->w, REPORT_CHANGED, "PERSIST: %s is RETAIN", var_of(m->c, arg(m, 0), false)->ours);
		break;
	case LDM_GOTO: case LDM_GOSUB: make_jump(m); break;
	case LDM_RETURN:
		m->piece->kind = PIECE_JUMP;
		m->piece->all = true;
		m->piece->cell = "RET";
		break;
	case LDM_UART_SEND: case LDM_UART_RECV: case LDM_UART_SEND_READY: case LDM_UART_SEND_BUSY:
	case LDM_UART_UDRE: case LDM_UART_RECV_AVAIL: case LDM_FORMATTED_STRING:
		stand_in(m, false);
		break;
	case LDM_PLACEHOLDER: case LDM_UNKNOWN: case LDM_SERIES: case LDM_PARALLEL:
		stand_in(m, true);
		break;
	}
}

struct ldmicro_piece *piece_of(struct ldmicro_conversion *c, struct ldmicro_node *node)
{
	struct making m = { .c = c, .node = node, .before = "" };

	if (node->piece)
		return node->piece;
	m.piece = arena_alloc(c->w.arena, sizeof(*m.piece));
	if (!m.piece)
		return NULL;
	m.piece->kind = PIECE_WIRE;
	c->w.at.line = node->line;
	c->w.rung++; /* the one that it will stand in */
	make(&m);
	c->w.rung--;
	node->piece = m.piece;
	return m.piece;
}
