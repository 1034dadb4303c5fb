/* SPDX-License-Identifier: MIT
 *
 * why_parts - parses an expression to a tree of AND, OR, XOR and NOT, and finds the smallest
 * sets of leaves that must change, or that make it TRUE.
 */
#include "engine/trial/why_parts.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/trial/formula.h"
#include "engine/trial/why_values.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#define LEAVES_MOST 24
#define TERMS_MOST  96
#define TRIES_MOST  50000 /* sets of leaves to try                             */

struct span { const char *text; size_t len; };

enum term_kind { TERM_LEAF, TERM_NOT, TERM_AND, TERM_OR, TERM_XOR };
struct term {
	enum term_kind kind;
	int left, right;      /* terms; a leaf: its number                    */
};

struct tree {
	struct term term[TERMS_MOST]; /* children before parents              */
	int count;
	struct span leaf[LEAVES_MOST]; /* each text once                      */
	int leaves;
	uint32_t value;       /* by leaf: a bit                               */
	bool failed;
};

/* ---- text ---- */

static struct span trim(struct span s)
{
	while (s.len && *s.text == ' ') {
		s.text++;
		s.len--;
	}
	while (s.len && s.text[s.len - 1] == ' ')
		s.len--;
	return s;
}

static bool is_word(const struct token *token, const char *word)
{
	return token->kind == TOKEN_NAME && token->len == strlen(word) &&
	       ascii_is(word, token->text, token->len);
}

static int depth_change(const struct token *token)
{
	if (token->kind != TOKEN_SYMBOL)
		return 0;
	if (*token->text == '(' || *token->text == '[')
		return 1;
	return *token->text == ')' || *token->text == ']' ? -1 : 0;
}

/* The first place outside of brackets where @word, or @symbol, splits the text. */
static bool split(struct span all, const char *word, char symbol, struct span *left,
		  struct span *right)
{
	struct lex lex;
	int depth = 0;

	lex_init(&lex, all.text, all.len);
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		const struct token *t = &lex.token;
		const bool found = depth == 0 && (is_word(t, word) ||
			(symbol && t->kind == TOKEN_SYMBOL && *t->text == symbol));

		depth += depth_change(t);
		if (!found)
			continue;
		*left = trim((struct span){ all.text, (size_t)(t->text - all.text) });
		right->text = t->text + t->len;
		right->len = (size_t)(all.text + all.len - right->text);
		*right = trim(*right);
		return left->len && right->len;
	}
	return false;
}

/* Without brackets around the whole text. */
static bool unwrap(struct span *all)
{
	struct lex lex;
	int depth = 0;

	if (all->len < 2 || *all->text != '(' || all->text[all->len - 1] != ')')
		return false;
	lex_init(&lex, all->text, all->len);
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		depth += depth_change(&lex.token);
		if (depth == 0 && lex.token.text + 1 < all->text + all->len)
			return false;
	}
	*all = trim((struct span){ all->text + 1, all->len - 2 });
	return true;
}

static bool skip_not(struct span *all)
{
	struct lex lex;

	lex_init(&lex, all->text, all->len);
	lex_next(&lex);
	if (!is_word(&lex.token, "NOT"))
		return false;
	all->len -= (size_t)(lex.token.text + lex.token.len - all->text);
	all->text = lex.token.text + lex.token.len;
	*all = trim(*all);
	return all->len > 0;
}

/* ---- the tree ---- */

static bool same_span(struct span a, struct span b)
{
	return a.len == b.len && strncasecmp(a.text, b.text, a.len) == 0;
}

static int add_term(struct tree *tree, enum term_kind kind, int left, int right)
{
	if (tree->count == TERMS_MOST || left < 0 || right < 0) {
		tree->failed = true;
		return -1;
	}
	tree->term[tree->count] = (struct term){ kind, left, right };
	return tree->count++;
}

static int add_leaf(struct tree *tree, struct span text)
{
	int i = 0;

	while (i < tree->leaves && !same_span(tree->leaf[i], text))
		i++;
	if (i == LEAVES_MOST)
		return add_term(tree, TERM_LEAF, -1, 0);
	tree->leaf[i] = text;
	if (i == tree->leaves)
		tree->leaves++;
	return add_term(tree, TERM_LEAF, i, 0);
}

/* A name or an address, perhaps with a path. */
static bool is_operand(struct span leaf)
{
	struct lex lex;
	bool first = true;

	lex_init(&lex, leaf.text, leaf.len);
	for (lex_next(&lex); lex.token.kind != TOKEN_END; lex_next(&lex)) {
		const struct token *t = &lex.token;
		const bool name = t->kind == TOKEN_NAME || t->kind == TOKEN_ADDRESS;

		if (!name && (first || t->kind != TOKEN_SYMBOL || *t->text != '.'))
			return false;
		first = false;
	}
	return !first;
}

/* Depth: each level needs a term or a bracket; expr.c limits both. */
static int grow(struct tree *tree, struct span all)
{
	struct span left, right, inner = all;
	const int before = tree->count;
	int a, b;

	if (tree->failed || !all.len)
		return add_term(tree, TERM_LEAF, -1, 0);
	if (split(all, "OR", 0, &left, &right)) {
		a = grow(tree, left);
		b = grow(tree, right);
		return add_term(tree, TERM_OR, a, b);
	}
	if (split(all, "XOR", 0, &left, &right)) {
		a = grow(tree, left);
		b = grow(tree, right);
		return add_term(tree, TERM_XOR, a, b);
	}
	if (split(all, "AND", '&', &left, &right)) {
		a = grow(tree, left);
		b = grow(tree, right);
		return add_term(tree, TERM_AND, a, b);
	}
	if (unwrap(&inner))
		return grow(tree, inner);
	if (skip_not(&inner) && (is_operand(inner) || unwrap(&inner))) {
		a = grow(tree, inner);
		return add_term(tree, TERM_NOT, a, 0);
	}
	tree->count = before;
	return add_leaf(tree, all);
}

static bool value_with(const struct tree *tree, uint32_t leaves)
{
	bool value[TERMS_MOST] = { false };

	for (int i = 0; i < tree->count; i++) {
		const struct term *n = &tree->term[i];

		switch (n->kind) {
		case TERM_LEAF: value[i] = leaves >> n->left & 1u; break;
		case TERM_NOT: value[i] = !value[n->left]; break;
		case TERM_AND: value[i] = value[n->left] && value[n->right]; break;
		case TERM_OR: value[i] = value[n->left] || value[n->right]; break;
		case TERM_XOR: value[i] = value[n->left] != value[n->right]; break;
		}
	}
	return tree->count && value[tree->count - 1];
}

/* ---- values ---- */

static bool leaf_value(const struct why_place *at, struct span leaf, struct expr *expr,
		       struct arena *arena, bool *out)
{
	const size_t size = 2 * leaf.len + 1024;
	struct diag_list *ignored = arena_alloc(arena, sizeof(*ignored));
	char *text = arena_alloc(arena, size);
	const size_t len = text ? why_qualify(at, leaf.text, leaf.len, text, size) : 0;
	union iec_value value = { .i = 0 };
	struct formula *formula;

	if (!ignored || !len ||
	    !expr_parse_text(text, len, expr, ignored, (struct diag){ .line = 0 }))
		return false;
	formula = formula_new(&at->resource->image, NULL, (struct formula_projects){ at->project, NULL }, expr, arena, text, ignored,
			      (struct diag){ .line = 0 });
	if (!formula || formula_kind(formula) != KIND_BOOL ||
	    !formula_value(formula, &at->resource->image, &value))
		return false;
	*out = value.i != 0;
	return true;
}

static bool find_values(const struct why_place *at, struct tree *tree, struct arena *arena)
{
	struct expr *expr = arena_alloc(arena, sizeof(*expr));

	for (int i = 0; i < tree->leaves && expr; i++) {
		bool value = false;

		if (!leaf_value(at, tree->leaf[i], expr, arena, &value))
			return false;
		tree->value |= (uint32_t)value << i;
	}
	return expr;
}

/* ---- ways ---- */

struct search {
	const struct why_place *at;
	const struct why_cell *cell;
	const struct tree *tree;
	bool on;
	struct why_parts *out;
	uint32_t found[WHY_WAYS];
	int tries;
};

static void name_part(const struct search *s, struct span leaf, bool value,
		      struct why_cell *part)
{
	*part = *s->cell;
	snprintf(part->name, sizeof(part->name), "%.*s", (int)leaf.len, leaf.text);
	if (is_operand(leaf)) {
		part->kind = value == s->on ? WHY_CONTACT : WHY_NEGATED;
		*part->values = '\0';
		return;
	}
	part->kind = value == s->on ? WHY_COMPARE : WHY_COMPARED;
	why_values_of(s->at, leaf.text, leaf.len, part->values, sizeof(part->values));
}

/* Adds the leaves of a set as a way. */
static void add_set(struct search *s, uint32_t set)
{
	struct why_way *way = &s->out->way[s->out->ways];

	way->count = 0;
	for (int i = 0; i < s->tree->leaves && way->count < WHY_CELLS; i++)
		if (set >> i & 1u)
			name_part(s, s->tree->leaf[i], s->tree->value >> i & 1u,
				  &way->cell[way->count++]);
	s->found[s->out->ways++] = set;
}

static bool has_smaller(const struct search *s, uint32_t set)
{
	for (int i = 0; i < s->out->ways; i++)
		if ((s->found[i] & set) == s->found[i])
			return true;
	return false;
}

/* Whether the leaves of @set decide the result, whatever the values of the others are. */
static bool holds_by(const struct tree *tree, uint32_t set)
{
	/* Three values: TRUE, FALSE, or undecided. */
	bool yes[TERMS_MOST] = { false }, no[TERMS_MOST] = { false };

	for (int i = 0; i < tree->count; i++) {
		const struct term *n = &tree->term[i];
		const int a = n->left, b = n->right;

		switch (n->kind) {
		case TERM_LEAF:
			yes[i] = (set & tree->value) >> a & 1u;
			no[i] = (set & ~tree->value) >> a & 1u;
			break;
		case TERM_NOT:
			yes[i] = no[a];
			no[i] = yes[a];
			break;
		case TERM_AND:
			yes[i] = yes[a] && yes[b];
			no[i] = no[a] || no[b];
			break;
		case TERM_OR:
			yes[i] = yes[a] || yes[b];
			no[i] = no[a] && no[b];
			break;
		case TERM_XOR:
			yes[i] = (yes[a] && no[b]) || (no[a] && yes[b]);
			no[i] = (yes[a] && yes[b]) || (no[a] && no[b]);
			break;
		}
	}
	return yes[tree->count - 1];
}

/* Tries all sets of @size leaves, in order; false: no more tries. */
static bool try_size(struct search *s, int size)
{
	const uint32_t end = UINT32_C(1) << s->tree->leaves;
	uint32_t set = (UINT32_C(1) << size) - 1;

	while (set < end) {
		const uint32_t low = set & -set, next = set + low;
		const bool good = s->on ? holds_by(s->tree, set) :
				  value_with(s->tree, s->tree->value ^ set);

		if (s->out->ways == WHY_WAYS || ++s->tries > TRIES_MOST)
			return false;
		if (good && !has_smaller(s, set))
			add_set(s, set);
		/* The next larger number with as many bits. */
		set = next | ((set ^ next) / low >> 2);
	}
	return true;
}

bool why_parts(const struct why_place *at, const struct why_cell *cell, const char *text,
	       size_t len, bool on, struct arena *arena, struct why_parts *out)
{
	struct tree *tree = arena_alloc(arena, sizeof(*tree));
	struct search s = { .at = at, .cell = cell, .tree = tree, .on = on, .out = out };

	out->ways = 0;
	if (!tree)
		return false;
	grow(tree, trim((struct span){ text, len }));
	if (tree->failed || !find_values(at, tree, arena) ||
	    value_with(tree, tree->value) != on)
		return false;
	for (int size = 1; size <= tree->leaves && size <= WHY_CELLS; size++)
		if (!try_size(&s, size))
			break;
	return out->ways > 0;
}
