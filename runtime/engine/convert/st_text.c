/* SPDX-License-Identifier: MIT
 *
 * st_text - acts as Structured Text. Blanks are not canonical.
 */
#include "engine/convert/acts.h"

#include "engine/base/iec.h"
#include "engine/model/st.h"
#include "engine/text/text.h"

#include <string.h>

struct writer {
	struct acts *acts;
	const struct sink *sink;
	int open;                  /* loops inside an IF                       */
	bool inside[LIMIT_LOOPS + 1];
};

static const char *text_of(const struct writer *w, uint32_t id)
{
	return project_text(w->acts->project, id);
}

static void put(const struct writer *w, const char *text)
{
	sink_text(w->sink, text);
}

static const char *name_of(const struct writer *w, int temp)
{
	return text_of(w, w->acts->temp[temp].name);
}

/* The sign of a function of two inputs; NULL: it has none. */
static const char *sign_of(const char *function)
{
	static const char *const signs[][2] = {
		{ "GT", " > " }, { "GE", " >= " }, { "EQ", " = " }, { "LE", " <= " }, { "LT", " < " },
		{ "NE", " <> " }, { "ADD", " + " }, { "SUB", " - " }, { "MUL", " * " }, { "DIV", " / " },
		{ "MOD", " MOD " },
	};

	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (!strcmp(function, signs[i][0]))
			return signs[i][1];
	return NULL;
}

static void put_term(const struct writer *w, const struct term *term);

static bool is_compound(const struct writer *w, const struct term *term)
{
	switch (term->kind) {
	case TERM_AND: case TERM_XOR: case TERM_OR:
		return true;
	case TERM_WORDS:
		return term->level != LEVEL_NAME;
	case TERM_NAME:
		return *text_of(w, term->text) == '-';
	case TERM_CALL:
		return term->parts == 2 && sign_of(text_of(w, term->text));
	case TERM_TRUE: case TERM_TEMP: case TERM_NOT: case TERM_EDGE:
		break;
	}
	return false;
}

/* As a part of another one. */
static void put_part(const struct writer *w, const struct term *term)
{
	bool compound;

	term = term_plain(w->acts, term);
	compound = is_compound(w, term);
	put(w, compound ? "(" : "");
	put_term(w, term);
	put(w, compound ? ")" : "");
}

static void put_call(const struct writer *w, const struct term *term)
{
	const char *sign = term->parts == 2 ? sign_of(text_of(w, term->text)) : NULL;

	if (sign) {
		put_part(w, term->part[0]);
		put(w, sign);
		put_part(w, term->part[1]);
		return;
	}
	put(w, text_of(w, term->text));
	put(w, "(");
	for (int i = 0; i < term->parts; i++) {
		put(w, i ? ", " : "");
		put(w, text_of(w, term->pin[i]));
		put(w, " := ");
		put_term(w, term->part[i]);
	}
	put(w, ")");
}

static void put_term(const struct writer *w, const struct term *term)
{
	const char *between = " AND ";

	term = term_plain(w->acts, term);
	switch (term->kind) {
	case TERM_TRUE:
		put(w, "TRUE");
		return;
	case TERM_NAME: case TERM_WORDS:
		put(w, text_of(w, term->text));
		return;
	case TERM_TEMP:
		put(w, name_of(w, term->temp));
		return;
	case TERM_NOT:
		put(w, "NOT ");
		put_part(w, term->part[0]);
		return;
	case TERM_CALL:
		put_call(w, term);
		return;
	case TERM_EDGE:
		put(w, term->rising ? "R_EDGE(" : "F_EDGE(");
		put_term(w, term->part[0]);
		put(w, ")");
		return;
	case TERM_AND:
		between = term->lazy ? " AND_THEN " : between;
		break;
	case TERM_OR:
		between = " OR ";
		break;
	case TERM_XOR:
		between = " XOR ";
		break;
	}
	for (int i = 0; i < term->parts; i++) {
		put(w, i ? between : "");
		put_part(w, term->part[i]);
	}
}

static void put_target(const struct writer *w, const struct act *act)
{
	put(w, act->target ? text_of(w, act->target) : name_of(w, act->temp));
	put(w, " := ");
}

static const struct act_arg *only_value(const struct writer *w, const struct act *act, int at, const char *pin)
{
	const struct act_arg *arg = at < act->args ? &act->arg[at] : NULL;

	return arg && arg->value && !strcmp(text_of(w, arg->pin), pin) ? arg : NULL;
}

/* `a + b` instead of ADD(IN1 := a, IN2 := b). */
static bool put_short_call(const struct writer *w, const struct act *act)
{
	const char *function = text_of(w, act->text), *sign = sign_of(function);

	if (!act->target)
		return false;
	if (!strcmp(function, "MOVE") && act->args == 1 && only_value(w, act, 0, "IN")) {
		put_term(w, act->arg[0].value);
		return true;
	}
	if (!sign || act->args != 2 || !only_value(w, act, 0, "IN1") || !only_value(w, act, 1, "IN2"))
		return false;
	put_part(w, act->arg[0].value);
	put(w, sign);
	put_part(w, act->arg[1].value);
	return true;
}

static void put_act_call(const struct writer *w, const struct act *act)
{
	if (act->target || act->temp >= 0)
		put_target(w, act);
	if (put_short_call(w, act)) {
		put(w, ";\n");
		return;
	}
	put(w, text_of(w, act->text));
	put(w, "(");
	for (int i = 0; i < act->args; i++) {
		const struct act_arg *arg = &act->arg[i];

		put(w, i ? ", " : "");
		put(w, text_of(w, arg->pin));
		put(w, !arg->pin ? "" : arg->value ? " := " : " => ");
		if (arg->value)
			put_term(w, arg->value);
		else
			put(w, arg->place ? text_of(w, arg->place) : name_of(w, arg->temp));
	}
	put(w, ");\n");
}

static void put_test(const struct writer *w, const struct act *act)
{
	put(w, "IF ");
	if (act->when) {
		put_part(w, act->when);
		put(w, " AND_THEN ");
		put_part(w, act->value);
	} else {
		put_term(w, act->value);
	}
	put(w, " THEN\n");
	put_target(w, act);
	put(w, "TRUE;\nELSE\n");
	put_target(w, act);
	put(w, "FALSE;\nEND_IF;\n");
}

static void put_loop(const struct writer *w, const struct act_loop *loop)
{
	put(w, text_of(w, loop->variable));
	put(w, " := ");
	put(w, text_of(w, loop->from));
	put(w, ";\nWHILE ");
	put(w, text_of(w, loop->variable));
	put(w, loop->down ? " >= " : " <= ");
	put(w, text_of(w, loop->to));
	put(w, " DO\n");
}

static void put_step(const struct writer *w, const struct act_loop *loop)
{
	const char *variable = text_of(w, loop->variable), *to = text_of(w, loop->to);

	if (loop->near) {
		sink_printf(w->sink, "IF ");
		put(w, variable);
		put(w, loop->down ? " <= " : " >= ");
		put(w, to);
		put(w, " THEN\nEXIT;\nEND_IF;\n");
		put(w, variable);
		put(w, " := ");
		put(w, variable);
		put(w, loop->down ? " - 1;\n" : " + 1;\n");
	} else {
		put(w, "IF ");
		put(w, variable);
		put(w, " = ");
		put(w, to);
		put(w, " THEN\nEXIT;\nEND_IF;\n");
		put(w, name_of(w, loop->next));
		put(w, " := ADD(IN1 := ");
		put(w, variable);
		put(w, ", IN2 := ");
		put(w, loop->by ? text_of(w, loop->by) : "1");
		put(w, ", ENO => ");
		put(w, name_of(w, loop->good));
		put(w, ");\nIF NOT ");
		put(w, name_of(w, loop->good));
		put(w, " OR (");
		put(w, name_of(w, loop->next));
		put(w, loop->down ? " < " : " > ");
		put(w, to);
		put(w, ") THEN\nEXIT;\nEND_IF;\n");
		put(w, variable);
		put(w, " := ");
		put(w, name_of(w, loop->next));
		put(w, ";\n");
	}
	put(w, "END_WHILE;\n");
}

static void put_lines(const struct writer *w, const struct act *act)
{
	const struct st lines = { .item = (struct st_item *)act->item, .count = act->items };

	text_write_st(w->acts->project, &lines, w->sink);
}

/* An act without its condition. */
static void put_act(const struct writer *w, const struct act *act)
{
	switch (act->kind) {
	case ACT_STORE:
		put_target(w, act);
		put_term(w, act->value);
		put(w, ";\n");
		break;
	case ACT_CALL:
		put_act_call(w, act);
		break;
	case ACT_JUMP:
		put(w, "JMP ");
		put(w, text_of(w, act->text));
		put(w, ";\n");
		break;
	case ACT_RETURN:
		put(w, "RETURN;\n");
		break;
	case ACT_WORDS:
		put(w, text_of(w, act->text));
		put(w, ";\n");
		break;
	case ACT_LINES:
		put_lines(w, act);
		break;
	case ACT_REMARK:
		put(w, act->apart ? "\n" : "");
		put(w, text_of(w, act->text));
		put(w, "\n");
		break;
	case ACT_LABEL:
		put(w, text_of(w, act->text));
		put(w, ":\n");
		break;
	case ACT_NOTHING: case ACT_STOP: case ACT_TEST: case ACT_LOOP: case ACT_LOOP_END:
		break;
	}
}

void term_text(struct acts *acts, const struct term *term, bool part, const struct sink *sink)
{
	const struct writer w = { .acts = acts, .sink = sink };

	if (part)
		put_part(&w, term);
	else
		put_term(&w, term);
}

void act_text(struct acts *acts, const struct act *act, const struct sink *sink)
{
	const struct writer w = { .acts = acts, .sink = sink };

	put_act(&w, act);
}

static bool joins(struct acts *acts, const struct act *act, const struct act *next)
{
	return next->when && next->rung == act->rung && next->kind != ACT_TEST && next->kind != ACT_LOOP &&
	       act->kind != ACT_JUMP && act->kind != ACT_RETURN && term_equal(acts, act->when, next->when) &&
	       !act_touches(acts, act, act->when);
}

/* Act @at under its condition, and those behind it that have the same one. Returns the last. */
static int put_under(const struct writer *w, int at)
{
	struct acts *acts = w->acts;
	int last = at;

	put(w, "IF ");
	put_term(w, acts->act[at].when);
	put(w, " THEN\n");
	put_act(w, &acts->act[at]);
	for (int i = at + 1; i < acts->count; i++) {
		if (acts->act[i].kind == ACT_NOTHING)
			continue;
		if (!joins(acts, &acts->act[last], &acts->act[i]))
			break;
		put_act(w, &acts->act[i]);
		last = i;
	}
	put(w, "END_IF;\n");
	return last;
}

void st_text(struct acts *acts, const struct sink *sink)
{
	struct writer w = { .acts = acts, .sink = sink };

	for (int i = 0; i < acts->count; i++) {
		const struct act *act = &acts->act[i];

		if (act->kind == ACT_TEST) {
			put_test(&w, act);
		} else if (act->kind == ACT_LOOP) {
			w.inside[w.open] = act->when;
			if (act->when) {
				put(&w, "IF ");
				put_term(&w, act->when);
				put(&w, " THEN\n");
			}
			w.open++;
			put_loop(&w, &act->loop);
		} else if (act->kind == ACT_LOOP_END) {
			put_step(&w, &act->loop);
			put(&w, w.inside[--w.open] ? "END_IF;\n" : "");
		} else if (act->when) {
			i = put_under(&w, i);
		} else {
			put_act(&w, act);
		}
	}
}

void st_declare(const struct acts *acts, const struct sink *sink)
{
	bool begun = false;

	for (int i = 0; i < acts->temps; i++) {
		if (!acts->temp[i].name)
			continue;
		sink_text(sink, begun ? "" : "VAR_TEMP\n");
		begun = true;
		sink_text(sink, project_text(acts->project, acts->temp[i].name));
		sink_text(sink, " : ");
		sink_text(sink, iec_type_row(acts->temp[i].type)->word);
		sink_text(sink, ";\n");
	}
	sink_text(sink, begun ? "END_VAR\n" : "");
	begun = false;
	for (int i = 0; i < acts->edges; i++) {
		if (acts->edge[i].other)
			continue;
		sink_text(sink, begun ? "" : "VAR\n");
		begun = true;
		sink_text(sink, project_text(acts->project, acts->edge[i].name));
		sink_text(sink, acts->edge[i].rising ? " : R_TRIG;\n" : " : F_TRIG;\n");
	}
	sink_text(sink, begun ? "END_VAR\n" : "");
}
