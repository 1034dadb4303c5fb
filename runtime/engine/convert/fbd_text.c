/* SPDX-License-Identifier: MIT
 *
 * fbd_text - acts as networks of Function Block Diagram, one for each rung.
 *
 * A temporary that one network alone needs is a wire. What a network cannot do under a condition stands
 * behind a jump over it, so it ends a network.
 */
#include "engine/convert/acts.h"

#include "engine/model/loop.h"
#include "engine/model/st.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where the acts of a temporary stand. */
struct home {
	int network;  /* of its first one; -1: none so far                     */
	bool wire;
};

struct loop_labels {
	uint32_t again, end;
};

struct fbd_writer {
	struct acts *acts;
	const struct sink *sink;
	struct home *home;     /* of each temporary                            */
	uint32_t *label;       /* of the network of each rung, and of one behind them */
	uint32_t *own;         /* labels that the rungs do not have            */
	int owns;
	int network;           /* in work                                      */
	struct loop_labels loop[LIMIT_LOOPS];
	int loops;
};

static const char *text_of(const struct fbd_writer *n, uint32_t id)
{
	return project_text(n->acts->project, id);
}

static void put(const struct fbd_writer *n, const char *text)
{
	sink_text(n->sink, text);
}

/* ---- labels ---- */

static bool is_label(const struct fbd_writer *n, uint32_t label)
{
	const struct names *names = &n->acts->project->names;
	const struct pou *pou = n->acts->pou;

	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label && names_fold(names, pou->rung[i]->label) == names_fold(names, label))
			return true;
	for (int i = 0; i < n->owns; i++)
		if (names_fold(names, n->own[i]) == names_fold(names, label))
			return true;
	return false;
}

/* Rung3_again, Rung3_again_2. */
static uint32_t label_new(struct fbd_writer *n, int rung, const char *what)
{
	char name[64];
	uint32_t *own, id = 0;

	for (int k = 1; !id || is_label(n, id); k++) {
		if (k == 1)
			snprintf(name, sizeof(name), "Rung%d_%s", rung + 1, what);
		else
			snprintf(name, sizeof(name), "Rung%d_%s_%d", rung + 1, what, k);
		id = acts_intern(n->acts, name, strlen(name));
		if (!id)
			return 0;
	}
	own = arena_push(n->acts->arena, &n->own, &n->owns, sizeof(*own));
	if (own)
		*own = id;
	n->acts->failed |= !own;
	return id;
}

/* The label of the network of rung @rung, or of the one behind all. */
static uint32_t label_of(struct fbd_writer *n, int rung)
{
	if (!n->label[rung])
		n->label[rung] = label_new(n, rung, "begins");
	return n->label[rung];
}

/* ---- which act ends a network ---- */

/* The call of a block that has no pin EN of its own. */
static bool takes_en(const struct fbd_writer *n, const struct act *act)
{
	const struct meaning *m = act->kind == ACT_CALL && !act->target && act->temp < 0 ?
				  acts_meaning(n->acts, act->text) : NULL;

	return m && m->kind == MEANING_INSTANCE &&
	       word_pin_find(words_row(&n->acts->project->words, (enum word)m->word), "EN", 2) < 0;
}

static bool is_edge_call(const struct fbd_writer *n, const struct act *act)
{
	for (int i = 0; act->kind == ACT_CALL && i < n->acts->edges; i++)
		if (n->acts->edge[i].name == act->text)
			return true;
	return false;
}

/* Does it stand behind a jump over it, as no pin takes its condition? */
static bool is_jumped(const struct fbd_writer *n, const struct act *act)
{
	if (!act->when || act->kind == ACT_NOTHING)
		return false;
	if (act->kind == ACT_STORE) {
		const struct meaning *m = act->target ? acts_meaning(n->acts, act->target) : NULL;

		return (act->fails || (act->target && (!m || meaning_is_checked(m)))) && !act_is_latch(n->acts, act);
	}
	if (act->kind == ACT_CALL)
		return act->fails || !(takes_en(n, act) || is_edge_call(n, act));
	return act->kind == ACT_WORDS || act->kind == ACT_LINES;
}

/* Do later acts of the rung stand in another network? */
static bool ends_network(const struct fbd_writer *n, const struct act *act)
{
	if (act->kind == ACT_LABEL)
		return true;
	for (int i = 0; act->kind == ACT_LINES && i < act->items; i++)
		if (st_form((enum st_kind)act->item[i].kind)->opens || act->item[i].kind == ST_LABEL)
			return true;
	return is_jumped(n, act);
}

static bool has_more(const struct fbd_writer *n, int at)
{
	for (int i = at + 1; i < n->acts->count && n->acts->act[i].rung == n->acts->act[at].rung; i++)
		if (n->acts->act[i].kind != ACT_NOTHING)
			return true;
	return false;
}

/* ---- wires ---- */

static void use_temp(const struct fbd_writer *n, int temp, bool wire)
{
	struct home *home = temp >= 0 ? &n->home[temp] : NULL;

	if (!home)
		return;
	if (home->network < 0)
		home->network = n->network;
	home->wire &= wire && home->network == n->network;
}

static void use_term(const struct fbd_writer *n, const struct term *term)
{
	if (!term)
		return;
	term = term_plain(n->acts, term);
	if (term->kind == TERM_TEMP)
		use_temp(n, term->temp, true);
	for (int i = 0; i < term->parts; i++)
		use_term(n, term->part[i]);
}

/* What a failing act does not store has the value of an earlier scan on a wire, not in a VAR_TEMP. */
static void use_act(const struct fbd_writer *n, const struct act *act)
{
	const bool stores = !act->fails && !is_jumped(n, act) && act->kind != ACT_TEST && act->kind != ACT_LOOP;

	use_term(n, act->when);
	use_term(n, act->value);
	for (int i = 0; i < act->args; i++)
		use_term(n, act->arg[i].value);
	use_temp(n, act->temp, stores && (act->kind == ACT_CALL || !act->when));
	for (int i = 0; i < act->args; i++)
		if (!act->arg[i].value && !act->arg[i].place)
			use_temp(n, act->arg[i].temp, stores);
}

static void find_wires(struct fbd_writer *n)
{
	struct acts *acts = n->acts;
	const struct act *last = NULL;

	for (int i = 0; i < acts->temps; i++) {
		struct act_temp *temp = &acts->temp[i];

		n->home[i] = (struct home){ -1, temp->type == IEC_BOOL && temp->defined == 1 };
		temp->defined = temp->uses = 0;
	}
	for (int i = 0; i < acts->count; i++) {
		const struct act *act = &acts->act[i];

		if (act->kind == ACT_NOTHING)
			continue;
		n->network += last && (last->rung != act->rung || ends_network(n, last));
		last = act;
		use_act(n, act);
		if (act->when)
			term_count(acts, act->when);
		if (act->value)
			term_count(acts, act->value);
		for (int k = 0; k < act->args; k++)
			if (act->arg[k].value)
				term_count(acts, act->arg[k].value);
		if (act->kind == ACT_LOOP) {
			use_temp(n, act->loop.next, false);
			use_temp(n, act->loop.good, false);
		}
	}
}

/* ---- acts ---- */

static void put_network(const struct fbd_writer *n, uint32_t label)
{
	sink_printf(n->sink, "NETWORK %s\n", text_of(n, label));
}

static void put_jump_to(const struct fbd_writer *n, uint32_t label)
{
	sink_printf(n->sink, "JMP %s\n", text_of(n, label));
}

/* JMP Label IF NOT when, RETURN, STOP. */
static void put_leaving(const struct fbd_writer *n, const char *word, uint32_t label, const struct term *when, bool inverse)
{
	put(n, word);
	put(n, text_of(n, label));
	if (when && inverse && term_plain(n->acts, when)->kind == TERM_NOT) {
		when = term_plain(n->acts, when)->part[0];
		inverse = false;
	}
	if (when) {
		put(n, inverse ? " IF NOT " : " IF ");
		term_text(n->acts, when, inverse, n->sink);
	}
	put(n, "\n");
}

static void put_latch(const struct fbd_writer *n, const struct act *act)
{
	put(n, text_of(n, act->target));
	put(n, act->value->kind == TERM_TRUE ? " S= " : " R= ");
	term_text(n->acts, act->when, false, n->sink);
	put(n, "\n");
}

/* The call of @act, without outputs that nobody reads; its condition, if it has one, is EN. */
static void put_call(const struct fbd_writer *n, const struct act *act)
{
	struct acts *acts = n->acts;
	struct act call = *act;

	call.arg = arena_alloc(acts->arena, sizeof(*call.arg) * (size_t)(act->args + 2));
	call.args = 0;
	if (!call.arg) {
		acts->failed = true;
		return;
	}
	if (act->when)
		call.arg[call.args++] = (struct act_arg){ acts_intern(acts, "EN", 2), act->when, 0, -1 };
	if (act->kind == ACT_STORE) {
		call.kind = ACT_CALL;
		call.text = acts_intern(acts, "MOVE", 4);
		call.arg[call.args++] = (struct act_arg){ acts_intern(acts, "IN", 2), act->value, 0, -1 };
	}
	for (int i = 0; act->kind == ACT_CALL && i < act->args; i++)
		if (act->arg[i].value || act->arg[i].place || acts->temp[act->arg[i].temp].uses)
			call.arg[call.args++] = act->arg[i];
	if (call.temp >= 0 && !acts->temp[call.temp].uses)
		call.temp = -1;
	act_text(acts, &call, n->sink);
}

/* FALSE, unless the value can be computed, while `when`, and is TRUE. */
static void put_test(const struct fbd_writer *n, const struct act *act)
{
	const char *name = text_of(n, n->acts->temp[act->temp].name);

	put(n, name);
	put(n, " := FALSE\n");
	put(n, name);
	put(n, " := ");
	if (act->when) {
		term_text(n->acts, act->when, true, n->sink);
		put(n, " AND_THEN ");
	}
	term_text(n->acts, act->value, act->when != NULL, n->sink);
	put(n, "\n");
}

/* The rung behind that of the NEXT of the FOR at @at. */
static int behind_loop(const struct fbd_writer *n, int at)
{
	int open = 0;

	for (; at < n->acts->count; at++) {
		open += n->acts->act[at].kind == ACT_LOOP;
		if (n->acts->act[at].kind == ACT_LOOP_END && --open == 0)
			return n->acts->act[at].rung + 1;
	}
	return n->acts->pou->rung_count;
}

static void put_loop(struct fbd_writer *n, int at)
{
	const struct act *act = &n->acts->act[at];
	const struct act_loop *loop = &act->loop;
	struct loop_labels *labels = &n->loop[n->loops < LIMIT_LOOPS ? n->loops++ : LIMIT_LOOPS - 1];

	*labels = (struct loop_labels){ label_new(n, act->rung, "again"), label_of(n, behind_loop(n, at)) };
	if (act->when)
		put_leaving(n, "JMP ", labels->end, act->when, true);
	sink_printf(n->sink, "%s := %s\n", text_of(n, loop->variable), text_of(n, loop->from));
	put_network(n, labels->again);
	sink_printf(n->sink, "JMP %s IF %s %s %s\n", text_of(n, labels->end), text_of(n, loop->variable),
		    loop->down ? "<" : ">", text_of(n, loop->to));
}

static void put_step(struct fbd_writer *n, const struct act *act)
{
	const struct act_loop *loop = &act->loop;
	const struct loop_labels *labels = &n->loop[n->loops ? --n->loops : 0];
	const char *variable = text_of(n, loop->variable), *to = text_of(n, loop->to), *end = text_of(n, labels->end);

	if (loop->near) {
		sink_printf(n->sink, "JMP %s IF %s %s %s\n", end, variable, loop->down ? "<=" : ">=", to);
		sink_printf(n->sink, "%s := %s %s 1\n", variable, variable, loop->down ? "-" : "+");
	} else {
		const char *next = text_of(n, n->acts->temp[loop->next].name);
		const char *good = text_of(n, n->acts->temp[loop->good].name);

		sink_printf(n->sink, "JMP %s IF %s = %s\n", end, variable, to);
		sink_printf(n->sink, "%s := ADD(IN1 := %s, IN2 := %s, ENO => %s)\n", next, variable,
			    loop->by ? text_of(n, loop->by) : "1", good);
		sink_printf(n->sink, "JMP %s IF NOT %s OR (%s %s %s)\n", end, good, next, loop->down ? "<" : ">", to);
		sink_printf(n->sink, "%s := %s\n", variable, next);
	}
	sink_printf(n->sink, "JMP %s\n", text_of(n, labels->again));
}

/* ---- statements of EXECUTE boxes ---- */

/* Blocks around a statement: labels of what comes next and of what comes behind them. */
struct block {
	enum st_kind kind;     /* ST_IF, ST_CASE, ST_WHILE, ST_REPEAT, ST_FOR  */
	uint32_t again, next, end; /* 0: none                                  */
	int item;
};

struct blocks {
	struct fbd_writer *n;
	const struct act *act;
	struct block block[LIMIT_ST_DEPTH + 1];
	int open;
};

/* May it be impossible to compute? Then it counts as FALSE, and so does NOT of it. */
static bool may_fail(const char *text, size_t len)
{
	struct lex lex;

	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		struct lex next = lex;

		if (lex_is(&lex, "[") || lex_is(&lex, "^") || lex_is(&lex, "+") || lex_is(&lex, "-") ||
		    lex_is(&lex, "*") || lex_is(&lex, "/") || lex_is(&lex, "MOD") || lex_is(&lex, "**"))
			return true;
		lex_next(&next);
		if (lex.token.kind == TOKEN_NAME && lex_is(&next, "(") && !lex_is(&lex, "NOT") &&
		    !lex_is(&lex, "AND") && !lex_is(&lex, "OR") && !lex_is(&lex, "XOR"))
			return true;
	}
	return false;
}

/* The text behind the first word of an item: its condition. */
static const char *condition_of(const struct fbd_writer *n, const struct st_item *item)
{
	return text_of(n, item->text) + strlen(st_form((enum st_kind)item->kind)->word);
}

/* Goes on below if the condition is TRUE, else at @label. */
static void put_unless(struct fbd_writer *n, const struct act *act, const char *condition, uint32_t label)
{
	uint32_t then;

	if (!may_fail(condition, strlen(condition))) {
		const bool name = strchr(condition + 1, ' ') == NULL;

		sink_printf(n->sink, "JMP %s IF NOT %s%s%s\n", text_of(n, label), name ? "" : "(", condition, name ? "" : ")");
		return;
	}
	then = label_new(n, act->rung, "then");
	sink_printf(n->sink, "JMP %s IF %s\n", text_of(n, then), condition);
	put_jump_to(n, label);
	put_network(n, then);
}

/* Is the branch behind item @at the last one of its IF? */
static bool is_last_branch(const struct act *act, int at)
{
	for (int i = at + 1; i < act->items; i++)
		if (act->item[i].depth == act->item[at].depth && act->item[i].kind != ST_COMMENT)
			return act->item[i].kind == ST_END_IF;
		else if (act->item[i].depth < act->item[at].depth)
			return act->item[i].kind != ST_ELSE; /* of a choice: of its CASE */
	return true;
}

static void put_branch(struct blocks *b, int at)
{
	struct block *block = &b->block[b->open];
	const bool last = is_last_branch(b->act, at);

	block->next = last ? block->end : label_new(b->n, b->act->rung, "else");
	put_unless(b->n, b->act, condition_of(b->n, &b->act->item[at]), block->next);
}

/* A CASE with a plain selector: each choice is compared with it. */
static void put_choice(struct blocks *b, int at)
{
	struct block *block = &b->block[b->open];
	const char *selector = condition_of(b->n, &b->act->item[block->item]);
	const char *text = text_of(b->n, b->act->item[at].text);
	struct sink_memory memory;
	struct sink sink;
	struct lex lex;

	selector += strspn(selector, " ");
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	lex_init(&lex, text, strlen(text));
	for (const char *from = text, *low = NULL; from; ) {
		const char *until;
		bool range;

		lex_next(&lex);
		until = lex.token.text;
		range = lex_is(&lex, ".");
		if (lex.token.kind != TOKEN_END && !lex_is(&lex, ",") && !range)
			continue;
		while (until > from && until[-1] == ' ')
			until--;
		if (range)
			sink_printf(&sink, "(%s >= %.*s AND ", selector, (int)(until - from), from);
		else
			sink_printf(&sink, low ? "%s <= %.*s)%s" : "%s = %.*s%s", selector, (int)(until - from), from,
				    lex_is(&lex, ",") ? " OR " : "");
		if (range)
			lex_next(&lex); /* the second point */
		low = range ? from : NULL;
		from = lex.token.kind == TOKEN_END ? NULL : lex.token.text + lex.token.len;
		if (from)
			from += strspn(from, " ");
	}
	block->next = is_last_branch(b->act, at) ? block->end : label_new(b->n, b->act->rung, "else");
	put_unless(b->n, b->act, sink_memory_text(&memory), block->next);
	b->n->acts->failed |= memory.failed;
	sink_memory_free(&memory);
}

static bool loop_of(const struct blocks *b, int at, struct loop *loop)
{
	const char *text = condition_of(b->n, &b->act->item[at]);

	return loop_parse(text, strlen(text), loop);
}

static void put_for(struct blocks *b, int at)
{
	const struct block *block = &b->block[b->open];
	struct loop loop;

	if (!loop_of(b, at, &loop))
		return;
	sink_printf(b->n->sink, "%.*s := %.*s\n", (int)loop.variable.len, loop.variable.text, (int)loop.from.len,
		    loop.from.text);
	put_network(b->n, block->again);
	sink_printf(b->n->sink, "JMP %s IF %.*s %s %.*s\n", text_of(b->n, block->end), (int)loop.variable.len,
		    loop.variable.text, loop.step < 0 ? "<" : ">", (int)loop.to.len, loop.to.text);
}

/* Where the type has no further value, the loop ends. */
static void put_end_for(struct blocks *b)
{
	const struct block *block = &b->block[b->open];
	const struct iec_type_row *row;
	const struct meaning *variable;
	struct loop loop;
	const char *name;

	if (!loop_of(b, block->item, &loop))
		return;
	name = text_of(b->n, acts_intern(b->n->acts, loop.variable.text, loop.variable.len));
	variable = acts_meaning(b->n->acts, acts_intern(b->n->acts, loop.variable.text, loop.variable.len));
	row = iec_type_row(variable ? variable->type : IEC_NONE);
	put_network(b->n, block->next);
	sink_printf(b->n->sink, "JMP %s IF %s %s %lld\n", text_of(b->n, block->end), name, loop.step < 0 ? "<" : ">",
		    (long long)((loop.step < 0 ? row->low : row->high) - loop.step));
	sink_printf(b->n->sink, "%s := %s %s %lld\n", name, name, loop.step < 0 ? "-" : "+",
		    (long long)(loop.step < 0 ? -loop.step : loop.step));
}

static void open_block(struct blocks *b, int at)
{
	const struct st_item *item = &b->act->item[at];
	struct fbd_writer *n = b->n;
	struct block *block;

	if (b->open < LIMIT_ST_DEPTH)
		b->open++;
	block = &b->block[b->open];
	*block = (struct block){ .kind = (enum st_kind)item->kind, .end = label_new(n, b->act->rung, "behind"), .item = at };
	if (item->kind == ST_IF)
		put_branch(b, at);
	if (item->kind == ST_IF || item->kind == ST_CASE)
		return;
	block->again = label_new(n, b->act->rung, "again");
	if (item->kind == ST_FOR) {
		block->next = label_new(n, b->act->rung, "next");
		put_for(b, at);
		return;
	}
	put_network(n, block->again);
	if (item->kind == ST_WHILE)
		put_unless(n, b->act, condition_of(n, item), block->end);
	else
		block->next = label_new(n, b->act->rung, "until");
}

static void close_block(struct blocks *b, int at)
{
	const struct st_item *item = &b->act->item[at];
	const struct block *block = &b->block[b->open];

	if (item->kind == ST_UNTIL) {
		put_network(b->n, block->next);
		sink_printf(b->n->sink, "JMP %s IF %s\n", text_of(b->n, block->end), condition_of(b->n, item));
	}
	if (item->kind == ST_END_FOR)
		put_end_for(b);
	if (item->kind != ST_END_IF && item->kind != ST_END_CASE)
		put_jump_to(b->n, block->again);
	put_network(b->n, block->end);
	b->open -= b->open > 0;
}

/* EXIT and CONTINUE, which belong to the innermost loop. */
static void put_leave(const struct blocks *b, bool exit)
{
	for (int i = b->open; i > 0; i--)
		if (b->block[i].kind != ST_IF && b->block[i].kind != ST_CASE) {
			put_jump_to(b->n, exit ? b->block[i].end :
				    b->block[i].kind == ST_WHILE ? b->block[i].again : b->block[i].next);
			return;
		}
}

static void put_statement(struct blocks *b, int at)
{
	const struct st_item *item = &b->act->item[at];
	struct fbd_writer *n = b->n;

	switch ((enum st_kind)item->kind) {
	case ST_IF: case ST_WHILE: case ST_REPEAT: case ST_CASE: case ST_FOR:
		open_block(b, at);
		break;
	case ST_CHOICE:
		if (b->block[b->open].next) {
			put_jump_to(n, b->block[b->open].end);
			put_network(n, b->block[b->open].next);
		}
		put_choice(b, at);
		break;
	case ST_ELSIF: case ST_ELSE:
		put_jump_to(n, b->block[b->open].end);
		put_network(n, b->block[b->open].next);
		if (item->kind == ST_ELSIF)
			put_branch(b, at);
		break;
	case ST_END_IF: case ST_END_WHILE: case ST_UNTIL: case ST_END_CASE: case ST_END_FOR:
		close_block(b, at);
		break;
	case ST_EXIT: case ST_CONTINUE:
		put_leave(b, item->kind == ST_EXIT);
		break;
	case ST_LABEL:
		put_network(n, item->text);
		break;
	case ST_ASSIGN: case ST_CALL: case ST_COMMENT: case ST_JUMP:
		put(n, text_of(n, item->text));
		put(n, "\n");
		break;
	case ST_EMPTY: case ST_RETURN:
	case ST_SET: case ST_RESET: case ST_JUMP_IF: case ST_RETURN_IF: case ST_STOP_IF: case ST_KINDS:
		break;
	}
}

static void put_statements(struct fbd_writer *n, const struct act *act)
{
	struct blocks *b = arena_alloc(n->acts->arena, sizeof(*b));

	if (!b) {
		n->acts->failed = true;
		return;
	}
	b->n = n;
	b->act = act;
	for (int i = 0; i < act->items; i++)
		put_statement(b, i);
}

/* The act behind a jump over it, which leads to the network behind. */
static void put_jumped(struct fbd_writer *n, const struct act *act, bool more)
{
	const uint32_t label = more ? label_new(n, act->rung, "next") : label_of(n, act->rung + 1);
	struct act bare = *act;

	put_leaving(n, "JMP ", label, act->when, true);
	bare.when = NULL;
	if (act->kind == ACT_CALL)
		put_call(n, &bare);
	else if (act->kind == ACT_LINES)
		put_statements(n, act);
	else
		act_text(n->acts, &bare, n->sink);
	if (more)
		put_network(n, label);
}

static void put_one(struct fbd_writer *n, int at)
{
	const struct act *act = &n->acts->act[at];

	if (is_jumped(n, act)) {
		put_jumped(n, act, has_more(n, at));
		return;
	}
	switch (act->kind) {
	case ACT_STORE:
		if (act_is_latch(n->acts, act))
			put_latch(n, act);
		else if (act->when)
			put_call(n, act);
		else
			act_text(n->acts, act, n->sink);
		break;
	case ACT_CALL:
		put_call(n, act);
		break;
	case ACT_TEST:
		put_test(n, act);
		break;
	case ACT_JUMP: case ACT_RETURN: case ACT_STOP:
		put_leaving(n, act->kind == ACT_JUMP ? "JMP " : act->kind == ACT_STOP ? "STOP" : "RETURN",
			  act->kind == ACT_JUMP ? act->text : 0, act->when, false);
		break;
	case ACT_LOOP:
		put_loop(n, at);
		break;
	case ACT_LOOP_END:
		put_step(n, act);
		break;
	case ACT_WORDS: case ACT_REMARK:
		act_text(n->acts, act, n->sink);
		break;
	case ACT_LINES:
		put_statements(n, act);
		break;
	case ACT_LABEL:
		put_network(n, act->text);
		break;
	case ACT_NOTHING:
		break;
	}
}

/* ---- networks ---- */

/* The rows of a rung that is OFF, as comments. */
static void put_off(struct fbd_writer *n, const struct rung *rung)
{
	struct rung *bare = rung_copy(rung);
	char *text = NULL;

	if (bare) {
		bare->comment = bare->title = bare->label = 0;
		text = text_write_rung(n->acts->project, bare);
	}
	n->acts->failed |= !text;
	for (const char *at = text ? strchr(text, '\n') : NULL; at && at[1]; at = strchr(at, '\n')) {
		const char *end = strchr(at + 1, '\n');

		at += 1 + strspn(at + 1, " ");
		put(n, "// ");
		sink_write(n->sink, at, end ? (size_t)(end - at) : strlen(at));
		put(n, "\n");
	}
	free(text);
	rung_free(bare);
}

static void put_rungs(struct fbd_writer *n)
{
	const struct acts *acts = n->acts;
	int at = 0;

	for (int i = 0; i < acts->pou->rung_count; i++) {
		const struct rung *rung = acts->pou->rung[i];
		const struct text_heading heading = { n->label[i], rung->title, rung->comment, rung->off };

		text_write_heading(acts->project, "NETWORK", &heading, n->sink);
		put(n, "\n");
		if (rung->off)
			put_off(n, rung);
		for (; at < acts->count && acts->act[at].rung == i; at++)
			put_one(n, at);
	}
	if (n->label[acts->pou->rung_count])
		put_network(n, n->label[acts->pou->rung_count]);
}

/* Jumps to networks behind their own, whose headings must be known before. */
static void give_labels(struct fbd_writer *n)
{
	const struct pou *pou = n->acts->pou;

	for (int i = 0; i < pou->rung_count; i++)
		n->label[i] = pou->rung[i]->label;
	for (int i = 0; i < n->acts->count; i++) {
		if (is_jumped(n, &n->acts->act[i]) && !has_more(n, i))
			label_of(n, n->acts->act[i].rung + 1);
		if (n->acts->act[i].kind == ACT_LOOP)
			label_of(n, behind_loop(n, i));
	}
}

static void declare(const struct fbd_writer *n, const struct sink *sink)
{
	const struct acts *acts = n->acts;
	bool begun = false;

	for (int i = 0; i < acts->temps; i++)
		if (n->home[i].network >= 0 && acts->temp[i].name && !n->home[i].wire) {
			sink_printf(sink, "%s%s : %s;\n", begun ? "" : "VAR_TEMP\n", text_of(n, acts->temp[i].name),
				    iec_type_row(acts->temp[i].type)->word);
			begun = true;
		}
	sink_text(sink, begun ? "END_VAR\n" : "");
	begun = false;
	for (int i = 0; i < acts->edges; i++)
		if (!acts->edge[i].other) {
			sink_printf(sink, "%s%s : %s;\n", begun ? "" : "VAR\n", text_of(n, acts->edge[i].name),
				    acts->edge[i].rising ? "R_TRIG" : "F_TRIG");
			begun = true;
		}
	sink_text(sink, begun ? "END_VAR\n" : "");
}

bool fbd_text(struct acts *acts, const struct sink *sink)
{
	struct fbd_writer *n = arena_alloc(acts->arena, sizeof(*n));
	const size_t rungs = (size_t)acts->pou->rung_count + 1;

	if (n) {
		n->home = arena_alloc(acts->arena, sizeof(*n->home) * ((size_t)acts->temps + 1));
		n->label = arena_alloc(acts->arena, sizeof(*n->label) * rungs);
	}
	if (!n || !n->home || !n->label) {
		acts->failed = true;
		return false;
	}
	n->acts = acts;
	n->sink = sink;
	find_wires(n);
	give_labels(n);
	declare(n, sink);
	put_rungs(n);
	return !acts->failed;
}
