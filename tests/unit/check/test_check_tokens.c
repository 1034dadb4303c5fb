/* SPDX-License-Identifier: MIT
 *
 * test_check_tokens - the states that a chart can reach, compared with a full search.
 *
 * The search fires every set of transitions that can fire together; check_tokens fires
 * one at a time, and proves the well-formed ones without a search.
 */
#include "engine/check/check_tokens.h"
#include "engine/check/tokens.h"
#include "tests/tap.h"
#include "tests/unit/sfc.h"

/* ---- messages ---- */

static const char *check(const char *text)
{
	static char out[1024];
	struct diag_list diags;
	struct test_sfc chart;
	struct arena arena;
	size_t len = 0;

	sfc_open(&chart, text);
	arena_init(&arena);
	diag_init(&diags);
	check_tokens(scope_new(chart.project, &arena), chart.pou, &arena, &diags);
	out[0] = 0;
	for (int i = 0; i < diags.count && len < sizeof(out) - 100; i++)
		len += (size_t)snprintf(out + len, sizeof(out) - len, "%s%s:%d %s",
			i ? "; " : "", diag_code(diags.diag[i].id),
			diags.diag[i].line, diags.diag[i].arg);
	arena_free(&arena);
	sfc_close(&chart);
	return out;
}

static void test_good(void)
{
	CHECK_TEXT(check("I A; S B; T A>B; T B>A"), "");
	CHECK_TEXT(check("I A; S B; S C; S D; T A>B,C; T B>D; T C,D>A"), "");
	/* both ways lead into the same branches */
	CHECK_TEXT(check("I A; S B; S C; S D; T A>B,C; T D>C,B; T B,C>A; T A>D"), "");
	/* branches in branches, joined at once */
	CHECK_TEXT(check("I A; S B; S C; S D; S E; T A>B,C; T C>D,E; T B,D,E>A"), "");
	/* each of two joins has a way to it */
	CHECK_TEXT(check("I A; M B; I C; S D; T C>D; E; T A>B; T B>A"), "");
	CHECK_TEXT(check("I A; S B; T A>B"), ""); /* check_sfc() reports this */
	CHECK_TEXT(check("I A; I B; S C; T A>C; T C>A; T B>B"), "");
}

static void test_faults(void)
{
	CHECK_TEXT(check("I Idle; S Fill; S Stir; S Mix; T Idle>Fill,Stir; T Stir>Mix;"
			 "T Fill,Stir>Idle"),
		   "LD451:12 Idle -> Fill + Stir -> Fill + Mix");
	CHECK_TEXT(check("I A; S B; S C; T A>B,C; T B>A; T B,C>A"),
		   "LD450:13 C\037A -> B + C -> A + C -> B + C; "
		   "LD452:102 B -> A");
	CHECK_TEXT(check("I A; S B; S C; S D; T A>B,C; T A>D; T D>B; T B,C>A"),
		   "LD451:12 A -> D -> B; LD452:103 D -> B");
	CHECK_TEXT(check("I A; M B; I C; S D; S F; T C>D,F; T D>D; E; T A>B; T B>A"),
		   "LD452:104 A -> C -> D + F -> A; "
		   "LD450:14 D\037A -> C -> D + F -> A + D -> C + D -> D + F");
}

static void test_long_ways(void)
{
	CHECK_TEXT(check("I First_of_all; S Second_of_all; S Third_of_all; S Fourth; "
			 "T First_of_all>Second_of_all; T Second_of_all>Third_of_all; "
			 "T Third_of_all>Fourth=FALSE; T Fourth>Fourth"),
		   "LD451:13 First_of_all -> Second_of_all -> Third_of_all; "
		   "LD453:103 Third_of_all -> Fourth");
	CHECK_TEXT(check("I Aaaaaaaaaaaaaaaaaaaa; S Bbbbbbbbbbbbbbbbbbbb; "
			 "S Cccccccccccccccccccc; S D; "
			 "T Aaaaaaaaaaaaaaaaaaaa>Bbbbbbbbbbbbbbbbbbbb; "
			 "T Bbbbbbbbbbbbbbbbbbbb>Cccccccccccccccccccc; "
			 "T Cccccccccccccccccccc>D=FALSE"),
		   "LD451:13 ... -> Bbbbbbbbbbbbbbbbbbbb -> Cccccccccccccccccccc; "
		   "LD453:103 Cccccccccccccccccccc -> D");
}

static void test_unreached(void)
{
	/* the first transition always wins */
	CHECK_TEXT(check("I A; S B; S C; T A>B=TRUE; T A>C; T B>A; T C>A"),
		   "LD453:102 A -> C");
	CHECK_TEXT(check("I A; S B; S C; T A>A; T B>C; T C>B"), "LD454:12 B");
	/* B and C are never active together */
	CHECK_TEXT(check("I A; S B; S C; S D; T A>B; T A>C; T B,C>D; T B>A; T C>A; "
			 "T D>A"), "LD453:103 B + C -> D");
	/* nothing leads to B: check_sfc() reports this */
	CHECK_TEXT(check("I A; S B; S C; T A>A; T B>C; T C>A"), "");
}

/* A transition between two others may make their step active again. A transition without
 * FROM or TO is not an error. */
static void test_in_order(void)
{
	CHECK_TEXT(check("O; I A; S B; S C; T A>B=TRUE; T A>C; T B>A; T C>A"), "");
	CHECK_TEXT(check("O; I A; S B; S C; S D; T A>B,C; T A>D; T D>B; T B,C>A"),
		   "LD451:12 A -> D -> B; LD452:103 D -> B");
	CHECK_TEXT(check("O; S A; S B; T >A; T A>B; T B>"), "");
	CHECK_TEXT(check("O; I A; S B; T A>B; T B,A>"), "");
}

static void append(char *text, size_t size, const char *more)
{
	const size_t used = strlen(text);

	snprintf(text + used, size - used, "%s", more);
}

/* Seventeen branches of two steps that two joins share: 2^17 states. */
static void test_giving_up(void)
{
	char text[2000] = "I A; S Z; T Z>A; T A>B0", join[400] = "; T C0";

	for (int i = 1; i < 17; i++)
		snprintf(text + strlen(text), 20, ",B%d", i);
	for (int i = 0; i < 17; i++)
		snprintf(text + strlen(text), 80, "; S B%d; S C%d; T B%d>C%d", i, i, i, i);
	for (int i = 1; i < 17; i++)
		snprintf(join + strlen(join), 20, ",C%d", i);
	append(join, sizeof(join), ">Z");
	append(text, sizeof(text), join);
	CHECK_TEXT(check(text), ""); /* proven without a search */
	append(text, sizeof(text), "; S D; T C0>D; T D>B0"); /* one more way: still proven */
	CHECK_TEXT(check(text), "");
	append(text, sizeof(text), "; S X; S Y; T D>X,Y; T X,Y,C1>C0,C1");
	CHECK_TEXT(check(text), "LD455:1 20000");
}

/* ---- random charts ---- */

static uint32_t seed = 1;

static uint32_t below(uint32_t n)
{
	seed = seed * 1664525u + 1013904223u;
	return (uint32_t)((uint64_t)(seed >> 8) * n >> 24);
}

struct writer {
	char text[4000];
	int steps;
};

static void add(struct writer *w, const char *item)
{
	snprintf(w->text + strlen(w->text), sizeof(w->text) - strlen(w->text), "%s;",
		 item);
}

static int add_step(struct writer *w, const char *kind)
{
	char item[20];

	snprintf(item, sizeof(item), "%s N%d", kind, w->steps);
	add(w, item);
	return w->steps++;
}

static const char *chance(void)
{
	static const char *const conditions[] = { "", "", "", "", "", "=TRUE", "=FALSE" };

	return conditions[below(7)];
}

static void add_way(struct writer *w, int from, int to)
{
	char item[40];

	snprintf(item, sizeof(item), "T N%d>N%d%s", from, to, chance());
	add(w, item);
}

static int add_macro(struct writer *w)
{
	const int macro = add_step(w, "M"), first = add_step(w, "I");
	const int end = add_step(w, "S");
	char item[60];

	if (below(3) == 0) { /* a second step, which may stay active */
		const int more = add_step(w, "S");

		snprintf(item, sizeof(item), "T N%d>N%d,N%d", first, more, end);
		add(w, item);
		add_way(w, more, below(2) ? more : first);
	} else {
		add_way(w, first, end);
	}
	add(w, "E");
	return macro;
}

/* Adds a correct random part between two steps. */
static void add_between(struct writer *w, int a, int b, int depth)
{
	char item[60];
	int x, y, z;

	switch (w->steps > 6 || depth > 3 ? 0 : below(5)) {
	case 0:
		add_way(w, a, b);
		break;
	case 1:
		x = below(4) ? add_step(w, "S") : add_macro(w);
		add_between(w, a, x, depth + 1);
		add_between(w, x, b, depth + 1);
		break;
	case 2:
		add_between(w, a, b, depth + 1);
		add_between(w, a, b, depth + 1);
		break;
	case 3:
		x = add_step(w, "S");
		y = add_step(w, "S");
		z = x;
		if (below(2)) {
			z = add_step(w, "S");
			add_between(w, x, z, depth + 1);
		}
		snprintf(item, sizeof(item), "T N%d>N%d,N%d", a, x, y);
		add(w, item);
		snprintf(item, sizeof(item), "T N%d,N%d>N%d", z, y, b);
		add(w, item);
		break;
	case 4:
		add_between(w, a, b, depth + 1);
		add_way(w, b, a);
		break;
	}
}

static void add_random(struct writer *w)
{
	char item[60];
	const uint32_t n = (uint32_t)w->steps;

	switch (below(3)) {
	case 0:
		snprintf(item, sizeof(item), "T N%u>N%u", below(n), below(n));
		break;
	case 1:
		snprintf(item, sizeof(item), "T N%u,N%u>N%u", 0u, 1 + below(n - 1),
			 below(n));
		break;
	default:
		snprintf(item, sizeof(item), "T N%u>N%u,N%u", below(n), 0u,
			 1 + below(n - 1));
		break;
	}
	add(w, item);
}

static void make_random(struct writer *w, int number)
{
	w->text[0] = 0;
	w->steps = 0;
	add_step(w, "I");
	add_step(w, below(5) ? "S" : "I");
	if (number % 2) {
		add_between(w, 0, 1, 0);
		if (below(3))
			add_way(w, 1, 0);
		if (below(3) == 0)
			add_random(w);
		return;
	}
	for (uint32_t i = below(4); i > 0; i--)
		add_step(w, "S");
	for (uint32_t i = 1 + below(7); i > 0; i--)
		add_random(w);
}

/* ---- the full search ---- */

struct truth {
	const struct sfc *sfc;
	struct sfc_net net;
	const uint8_t *always;
	uint8_t *seen;        /* by state                                     */
	uint8_t *dead;
	uint32_t reached, twice, fires;
	bool any_dead, left;
};

static uint32_t bits(const struct sfc_steps *steps)
{
	uint32_t out = 0;

	for (int i = 0; i < steps->count; i++)
		out |= 1u << steps->step[i];
	return out;
}

/* @choice: a bit for each arc whose condition is true. */
static uint32_t together(struct truth *t, uint32_t state, uint32_t choice)
{
	uint32_t taken = 0, entered = 0;

	for (int i = 0; i < t->net.arc_count; i++) {
		const uint32_t from = bits(&t->net.arc[i].from);
		const uint32_t to = bits(&t->net.arc[i].to);

		if (!(choice >> i & 1) || (from & state) != from || from & taken)
			continue;
		taken |= from;
		t->twice |= entered & to;
		entered |= to;
		t->fires |= 1u << i;
	}
	t->twice |= state & ~taken & entered;
	return (state & ~taken) | entered;
}

static bool has_left(const struct sfc *sfc, uint32_t state)
{
	for (int i = 0; i < sfc->step_count; i++)
		for (int at = i; state >> i & 1 && at >= 0; at = sfc->step[at].macro)
			if (!(state >> at & 1))
				return true;
	return false;
}

static void look(struct truth *t, uint32_t state, uint32_t *queue, int *count)
{
	uint32_t free = 0, sure = 0, leaving = 0;

	for (int i = 0; i < t->net.arc_count; i++) {
		const uint32_t from = bits(&t->net.arc[i].from);
		const uint8_t always = t->always[t->net.arc[i].transition];

		leaving |= from;
		if ((from & state) != from)
			continue;
		free |= always == 0 ? 1u << i : 0;
		sure |= always == 1 ? 1u << i : 0;
	}
	for (int i = 0; i < t->sfc->step_count; i++)
		if (t->sfc->step[i].kind == STEP_MACRO)
			leaving &= ~(1u << i);
	t->dead[state] = !(free | sure) && leaving & state;
	t->any_dead |= t->dead[state];
	for (uint32_t choice = free;; choice = (choice - 1) & free) {
		const uint32_t next = together(t, state, choice | sure);

		t->left |= has_left(t->sfc, next);
		t->reached |= next;
		if (!t->seen[next]) {
			t->seen[next] = 1;
			queue[(*count)++] = next;
		}
		if (!choice)
			return;
	}
}

static void find_truth(struct truth *t, const struct sfc *sfc, const uint8_t *always,
		       struct arena *arena)
{
	const size_t states = (size_t)1 << sfc->step_count;
	uint32_t *queue = arena_alloc(arena, states * sizeof(*queue));
	int count = 0;

	*t = (struct truth){ .sfc = sfc, .always = always };
	t->seen = arena_alloc(arena, states);
	t->dead = arena_alloc(arena, states);
	if (!queue || !t->seen || !t->dead || !sfc_net_make(sfc, arena, &t->net))
		abort();
	queue[count++] = t->reached = bits(&t->net.initial);
	t->seen[t->reached] = 1;
	for (int i = 0; i < count; i++)
		look(t, queue[i], queue, &count);
}

/* ---- comparison of both ---- */

static const uint8_t *constants(const struct test_sfc *c, struct arena *arena)
{
	uint8_t *out = arena_alloc(arena, (size_t)c->sfc->transition_count + 1);

	for (int i = 0; i < c->sfc->transition_count; i++) {
		const char *text = project_text(c->project, rung_at(c->pou->rung[
			c->sfc->transition[i].condition.first], 0, 0)->operand);

		out[i] = strcmp(text, "TRUE") == 0 ? 1 : strcmp(text, "FALSE") == 0 ? 2 : 0;
	}
	return out;
}

static bool has_true(const struct test_sfc *c, const uint8_t *always)
{
	for (int i = 0; i < c->sfc->transition_count; i++)
		if (always[i] == 1)
			return true;
	return false;
}

static uint32_t mask(const uint8_t *bytes, int count)
{
	uint32_t out = 0;

	for (int i = 0; i < count; i++)
		out |= bytes[i] ? 1u << i : 0;
	return out;
}

struct tally { int proven, walked, twice, dead, left, wrong; };

/* Whether each find is true in the full search, if no condition is always true. */
static bool finds_hold(const struct tokens *t, const struct truth *truth)
{
	for (int i = 0; i < t->find_count; i++) {
		const struct token_find *find = &t->find[i];
		const uint32_t state = (uint32_t)tokens_state(t, find->state)[0];

		if (find->kind == TOKEN_TWICE && !(truth->twice >> find->step & 1))
			return false;
		if (!truth->seen[state])
			return false;
		if (find->kind == TOKEN_DEAD && !truth->dead[state])
			return false;
	}
	return true;
}

static bool found(const struct tokens *t, enum token_kind kind)
{
	for (int i = 0; i < t->find_count; i++)
		if (t->find[i].kind == kind)
			return true;
	return false;
}

static bool agree(struct tokens *t, const struct truth *truth, bool exact,
		  struct tally *tally)
{
	const int steps = t->sfc->step_count;
	const bool proven = tokens_prove(t);
	bool good = true, faults;

	if (!proven && !tokens_walk(t))
		abort();
	faults = t->find_count > 0;
	tally->proven += proven;
	tally->walked += !proven;
	tally->twice += truth->twice != 0;
	tally->dead += truth->any_dead;
	tally->left += truth->left;
	good &= !truth->twice || found(t, TOKEN_TWICE);
	good &= !truth->any_dead || found(t, TOKEN_DEAD) || found(t, TOKEN_TWICE);
	good &= !truth->left || found(t, TOKEN_LEFT) || found(t, TOKEN_TWICE);
	if (exact) {
		good &= finds_hold(t, truth);
		if (!faults)
			good &= mask(t->reached, steps) == truth->reached &&
				mask(t->fires, t->net.arc_count) == truth->fires;
	}
	if (faults && !tokens_bound(t))
		abort();
	return good && !(truth->reached & ~mask(t->reached, steps)) &&
	       !(truth->fires & ~mask(t->fires, t->net.arc_count));
}

/* A chart that check_sfc() accepts, small enough for the full search. */
static bool is_whole(const struct sfc *sfc)
{
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].kind == STEP_MACRO && sfc_exit(sfc, i) < 0)
			return false;
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		for (int k = 0; k < t->from_count; k++)
			if (sfc->step[sfc->ref[t->first_from + k].step].macro != t->macro)
				return false;
		for (int k = 0; k < t->to_count; k++)
			if (sfc->step[sfc->ref[t->first_to + k].step].macro != t->macro)
				return false;
	}
	return sfc->step_count <= 14 && sfc->transition_count <= 20;
}

static void test_random(void)
{
	struct tally tally = { 0 };
	struct writer writer;

	for (int i = 0; i < 6000; i++) {
		const uint8_t *always;
		struct test_sfc chart;
		struct arena arena;
		struct tokens tokens;
		struct truth truth;

		make_random(&writer, i);
		sfc_open(&chart, writer.text);
		arena_init(&arena);
		always = constants(&chart, &arena);
		if (is_whole(chart.sfc)) {
			find_truth(&truth, chart.sfc, always, &arena);
			if (!tokens_begin(&tokens, chart.sfc, always, &arena))
				abort();
			if (!agree(&tokens, &truth, !has_true(&chart, always), &tally) &&
			    tally.wrong++ < 3)
				printf("# %s\n", writer.text);
		}
		arena_free(&arena);
		sfc_close(&chart);
	}
	printf("# %d proven, %d walked: %d twice, %d dead, %d left behind\n",
	       tally.proven, tally.walked, tally.twice, tally.dead, tally.left);
	CHECK(tally.wrong == 0);
	CHECK(tally.proven > 800 && tally.walked > 2000);
	CHECK(tally.twice > 500 && tally.dead > 300 && tally.left > 10);
}

int main(void)
{
	test_good();
	test_faults();
	test_long_ways();
	test_unreached();
	test_in_order();
	test_giving_up();
	test_random();
	return tap_done();
}
