/* SPDX-License-Identifier: MIT
 *
 * xref_scan - the names in one text: an operand, an expression, a parameter.
 *
 * Any text of the project goes through the one scanner; a path is followed from its
 * declared name through members, whatever its indices are. It parses no grammar: what
 * is malformed gives the names that are in it.
 */
#include "engine/xref/xref_walk.h"

#include "engine/base/lex.h"
#include "engine/model/loop.h"

#include <string.h>

#define SCAN_DEPTH (LIMIT_EXPR_DEPTH + 2)

/* A path, and the indices in its brackets one level deeper. */
struct level {
	uint16_t word;        /* of what was reached; WORD_COUNT: no parts     */
	uint8_t kind;         /* what happens to what is named here            */
	bool used;            /* `use` is the one that ends here               */
	int use;
};

struct scan {
	struct xref_walk *walk;
	const char *text;     /* all of the slot's                            */
	struct lex lex;
	struct level level[SCAN_DEPTH];
	int depth;
	bool dot;             /* behind a dot: a member follows               */
};

static uint16_t word_of(const struct var *var)
{
	return (uint16_t)(var->type == IEC_NONE ? var->fb : WORD_COUNT);
}

struct xref_target xref_pin(struct xref_walk *walk, enum word word, const char *name,
			    size_t len, enum pin_dir *dir)
{
	const struct xref_target none = { .what = XREF_UNKNOWN, .index = -1 };
	const struct word_row *row = words_row(&walk->project->words, word);
	int pin = word_pin_find(row, name, len), table, index;
	struct names *names = &walk->project->names;
	struct var_table *vars;

	*dir = pin >= 0 && pin < row->pin_count ? row->pin[pin].dir : PIN_NONE;
	if (pin < 0 || pin >= row->pin_count || !word_is_own(word) || row->owner < 0)
		return none;
	table = row->kind == WORD_STRUCT ?
		walk->project->pou_count + 1 + row->owner : row->owner + 1;
	vars = xref_table(walk->project, table);
	index = vars ? vars_find(vars, names_fold(names, names_intern(names, name, len))) :
		-1;
	return index < 0 ? none : xref_variable(walk->project, table, index);
}

/* ---- paths ---- */

static void add(struct scan *scan, struct xref_target target, const char *at, size_t len)
{
	struct level *level = &scan->level[scan->depth];

	level->use = scan->walk->out->count;
	level->used = xref_add(scan->walk, target, (enum xref_kind)level->kind,
			       (uint32_t)(at - scan->text), (uint32_t)len);
}

/* The next part up to a dot; false at the end. */
static bool part(const char **at, const char *end, size_t *len)
{
	const char *dot;

	if (*at >= end)
		return false;
	dot = memchr(*at, '.', (size_t)(end - *at));
	*len = (size_t)((dot ? dot : end) - *at);
	return true;
}

/* `.Limit.High` behind what was reached. */
static void scan_members(struct scan *scan, const char *at, const char *end)
{
	struct level *level = &scan->level[scan->depth];
	size_t len;

	for (; part(&at, end, &len); at += len + 1) {
		enum pin_dir dir;
		struct xref_target target = xref_pin(scan->walk, (enum word)level->word,
						     at, len, &dir);
		const struct var *var = xref_var(scan->walk->project, &target);

		level->word = WORD_COUNT;
		if (!var)
			continue;
		level->word = word_of(var);
		add(scan, target, at, len);
	}
}

static const struct meaning *mean(const struct scan *scan, const char *text, size_t len)
{
	struct xref_walk *walk = scan->walk;
	enum diag_id why;

	return scope_find(walk->scope, walk->pou,
			  names_intern(&walk->project->names, text, len), &why);
}

static void add_address(struct scan *scan, const struct token *token,
			struct iec_addr addr)
{
	add(scan, (struct xref_target){ XREF_ADDRESS, 0, 0, addr }, token->text,
	    token->len);
}

/* What is no declared name: a constant, a system name, an address, or nothing. */
static void scan_other(struct scan *scan, const struct token *token, size_t first)
{
	const struct meaning *m = mean(scan, token->text, token->len);
	struct xref_target none = { .what = XREF_UNKNOWN, .index = -1 };

	if (m && m->kind == MEANING_LITERAL)
		return;
	if (m && m->addr.area != AREA_NONE)
		add_address(scan, token, m->addr);
	else
		add(scan, none, token->text, first);
}

/* Fill.X: speaks of the step. TRANSITION is nobody's name. */
static bool scan_step(struct scan *scan, const struct token *token)
{
	const struct pou *pou = scan->walk->pou;
	const char *dot = memchr(token->text, '.', token->len);
	const struct meaning *m;
	int index;

	if (!pou || !pou->sfc || pou->sfc->block < 0)
		return false;
	m = mean(scan, token->text, token->len);
	if (!m || m->pou != pou || m->index < vars_declared(&pou->vars) || !m->var)
		return false;
	index = m->index - vars_declared(&pou->vars);
	scan->level[scan->depth].used = false;
	if (dot && index < 2 * pou->sfc->step_count)
		add(scan, (struct xref_target){ XREF_STEP,
			(int)(pou - scan->walk->project->pou) + 1,
			index % pou->sfc->step_count, { 0 } },
		    token->text, (size_t)(dot - token->text));
	return true;
}

static void scan_head(struct scan *scan, const struct token *token)
{
	struct level *level = &scan->level[scan->depth];
	const char *end = token->text + token->len;
	const char *dot = memchr(token->text, '.', token->len);
	size_t len = dot ? (size_t)(dot - token->text) : token->len;
	const struct meaning *m;
	int table;

	level->word = WORD_COUNT;
	if (scan_step(scan, token))
		return;
	m = mean(scan, token->text, len);
	if (!m || !m->var) {
		scan_other(scan, token, len);
		return;
	}
	table = m->pou ? (int)(m->pou - scan->walk->project->pou) + 1 : 0;
	level->word = word_of(m->var);
	add(scan, xref_variable(scan->walk->project, table, m->index), token->text, len);
	if (dot)
		scan_members(scan, dot + 1, end);
}

/* AND, MOD and the like are no names. */
static bool is_operator(const struct token *token)
{
	return op_find(token->text, token->len) != OP_COUNT ||
	       word_find(token->text, token->len) == FN_MOD;
}

static void scan_name(struct scan *scan, const struct token *token)
{
	if (scan->dot)
		scan_members(scan, token->text, token->text + token->len);
	else if (!is_operator(token))
		scan_head(scan, token);
}

static void scan_address(struct scan *scan, const struct token *token)
{
	struct iec_addr addr;

	scan->level[scan->depth].word = WORD_COUNT;
	if (iec_addr_parse(token->text, token->len, &addr) == ADDR_OK)
		add_address(scan, token, addr);
}

/* False: too deep for any text that was read. */
static bool scan_symbol(struct scan *scan)
{
	struct level *level = &scan->level[scan->depth];

	if (lex_is(&scan->lex, "[")) {
		if (level->used)
			scan->walk->out->use[level->use].open = true;
		if (++scan->depth == SCAN_DEPTH)
			return false;
		scan->level[scan->depth] = (struct level){ .word = WORD_COUNT, .kind = XREF_READ };
	} else if (lex_is(&scan->lex, "]")) {
		scan->depth -= scan->depth > 0;
	} else if (lex_is(&scan->lex, ":=")) {
		level->kind = XREF_READ;
	} else if (!lex_is(&scan->lex, ".")) {
		level->used = false;
	}
	return true;
}

void xref_scan(struct xref_walk *walk, size_t at, size_t len, enum xref_kind kind)
{
	struct scan scan = { .walk = walk };
	bool good = true;

	scan.text = project_text(walk->project, *walk->slot);
	scan.level[0] = (struct level){ .word = WORD_COUNT, .kind = (uint8_t)kind };
	lex_init(&scan.lex, scan.text + at, len);
	while (good && lex_next(&scan.lex) != TOKEN_END) {
		const struct token *token = &scan.lex.token;

		if (token->kind == TOKEN_NAME)
			scan_name(&scan, token);
		else if (token->kind == TOKEN_ADDRESS)
			scan_address(&scan, token);
		else if (token->kind == TOKEN_SYMBOL)
			good = scan_symbol(&scan);
		scan.dot = token->kind == TOKEN_SYMBOL && lex_is(&scan.lex, ".");
	}
}

void xref_loop(struct xref_walk *walk)
{
	const char *text = project_text(walk->project, *walk->slot);
	struct loop loop;

	if (!loop_parse(text, strlen(text), &loop)) {
		xref_scan(walk, 0, strlen(text), XREF_CHANGED);
		return;
	}
	xref_scan(walk, (size_t)(loop.variable.text - text), loop.variable.len,
		  XREF_CHANGED);
	xref_scan(walk, (size_t)(loop.from.text - text), loop.from.len, XREF_READ);
	xref_scan(walk, (size_t)(loop.to.text - text), loop.to.len, XREF_READ);
}
