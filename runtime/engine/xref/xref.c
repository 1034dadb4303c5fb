/* SPDX-License-Identifier: MIT
 *
 * xref - finds the uses of each name in a project.
 *
 * xref_scan() reads each text that may contain names. xref_print.c prints.
 */
#include "engine/xref/xref.h"

#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/check/access.h"
#include "engine/check/scope.h"
#include "engine/check/split.h"
#include "engine/base/name.h"
#include "engine/model/fbd.h"
#include "engine/model/st.h"
#include "engine/model/args.h"
#include "engine/model/expr.h"
#include "engine/model/init.h"
#include "engine/model/loop.h"
#include "engine/model/named.h"

#include <string.h>

/* For a folded name: the last body with it as a label, and its 1-based place. */
struct xref_label {
	int body, at;
};

/* A ( in a text: the enumeration before it, as xref_walk.beside, and the arguments in it so far. */
struct open_paren {
	int beside, arg;
};

/* The state of a walk through a project. */
struct xref_walk {
	struct xref *out;
	struct project *project;
	struct scope *scope;
	const struct pou *pou;   /* scope of names; NULL: globals             */
	struct xref_use place;   /* the present place                         */
	uint32_t *slot;          /* the text that is scanned                  */
	const struct st_item *item; /* the statement it is; NULL: none        */
	struct xref_label *label; /* by folded name                           */
	uint32_t labels;
	int body;                /* for labels: each POU has one, a chart many */
	enum word call;          /* of the call in a list whose pins follow   */
	int values;              /* of an initial value: enumeration of its variable + 1; 0: none */
	int beside;              /* of a part of a statement: that of the pin or the selector which it meets */
	struct open_paren *open; /* of the text that is scanned, SCAN_DEPTH   */
	uint16_t selector[LIMIT_ST_DEPTH]; /* of each CASE that is open, likewise */
	int cases;
};

/* ---- targets ---- */

struct var_table *xref_table(struct project *project, int table)
{
	const int structure = table - project->pou_count - 1;

	if (table == 0)
		return &project->globals;
	if (table > 0 && table <= project->pou_count)
		return &project->pou[table - 1].vars;
	if (structure < 0 || structure >= project->structure_count + project->named_count)
		return NULL;
	return structure < project->structure_count ? &project->structure[structure].vars :
	       &project->named[structure - project->structure_count].like;
}

struct var *xref_var(struct project *project, const struct xref_target *target)
{
	struct var_table *table = target->what == XREF_VARIABLE ?
		xref_table(project, target->table) : NULL;

	return table && target->index >= 0 && target->index < table->count ?
	       &table->var[target->index] : NULL;
}

bool xref_value_owner(const struct project *project, int value, int *table, int *index)
{
	struct project *of = (struct project *)(uintptr_t)project;
	const int enumeration = project->enum_value[value].enumeration + 1;
	const int types = project->pou_count + 1 + project->structure_count;

	/* Types first: variables of a type have its enumeration, too. */
	for (int i = 0, tables = types + project->named_count; i < tables; i++) {
		const struct var_table *vars;

		*table = i < project->named_count ? types + i : i - project->named_count;
		vars = xref_table(of, *table);
		for (*index = 0; vars->var && *index < vars->count; ++*index)
			if (vars->var[*index].enumeration == enumeration && !vars->var[*index].named)
				return true;
	}
	return false;
}

struct xref_target xref_variable(struct project *project, int table, int index)
{
	struct xref_target target = { XREF_VARIABLE, table, index, { 0 } };

	target.addr = xref_table(project, table)->var[index].at;
	return target;
}

static bool same_bits(struct iec_addr a, struct iec_addr b)
{
	return a.area == b.area && a.bits == b.bits && a.bit == b.bit &&
	       a.byte == b.byte;
}

bool xref_same(const struct xref_target *a, const struct xref_target *b)
{
	if (a->what != b->what)
		return false;
	if (a->what == XREF_ADDRESS)
		return same_bits(a->addr, b->addr);
	return a->table == b->table && a->index == b->index;
}

bool xref_touches(const struct xref_target *a, const struct xref_target *b)
{
	const uint32_t first = a->addr.byte * 8 + a->addr.bit;
	const uint32_t other = b->addr.byte * 8 + b->addr.bit;

	if (xref_same(a, b))
		return true;
	return a->addr.area != AREA_NONE && a->addr.area == b->addr.area &&
	       first < other + b->addr.bits && other < first + a->addr.bits;
}

/* ---- adding uses ---- */

static struct xref_use *xref_add(struct xref_walk *walk, struct xref_target target,
				 enum xref_kind kind, uint32_t at, uint32_t len)
{
	struct xref_use *use = arena_push(&walk->out->arena, &walk->out->use,
					  &walk->out->count, sizeof(*use));

	if (!use)
		return NULL;
	*use = walk->place;
	if (walk->item && walk->place.pou >= 0) { /* of a statement: its own line and column */
		const char *text = project_text(walk->project, walk->item->text);

		int column;

		st_where(&walk->project->names, walk->item, text + at, &use->line, &column);
		use->col = use->rung ? use->col : column;
		use->row = use->rung ? use->row : use->line - walk->pou->line + 1;
	}
	use->target = target;
	use->kind = kind;
	use->slot = walk->slot;
	use->at = at;
	use->len = len;
	return use;
}

/* A path; the indices in its brackets are one level deeper. */
struct level {
	uint16_t word;        /* of the part so far; WORD_COUNT: no members    */
	uint8_t kind;         /* kind of use of the name                       */
	bool used : 1;        /* index of the use that ends here               */
	bool output : 1;      /* behind =>                                     */
	int use;
};

#define SCAN_DEPTH (LIMIT_EXPR_DEPTH + 2)

struct scan {
	struct xref_walk *walk;
	const char *text;     /* all of the slot's                            */
	struct lex lex;
	struct level level[SCAN_DEPTH];
	int depth;
	bool dot;             /* behind a dot: a member follows               */
	uint16_t function;    /* in front of the ( that comes next; WORD_COUNT: none */
	uint16_t call[SCAN_DEPTH]; /* of each ( that is open, likewise        */
	int parens;
	int beside;           /* enumeration + 1 of what a value is compared with, or goes to; 0: not known */
	int pin;              /* likewise, of the pin whose name was read last */
};

static uint16_t word_of(const struct var *var)
{
	return (uint16_t)(var->type == IEC_NONE ? var->fb : WORD_COUNT);
}

/* Parameter @name of a word: XREF_UNKNOWN if the word is not the project's. @dir: gets
 * its direction; PIN_NONE if there is no such parameter. */
static struct xref_target xref_pin(struct xref_walk *walk, enum word word, const char *name,
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

/* Adds the members behind a name: `.Limit.High`. */
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

size_t xref_part(const struct lex *lex, struct iec_addr *addr)
{
	const struct token *token = &lex->token;
	struct lex ahead = *lex;
	struct expr_tail tail = { NULL, 0 };
	unsigned int bits, number;

	while (lex_next(&ahead) != TOKEN_END && lex_is(&ahead, ".") &&
	       (lex_next(&ahead) == TOKEN_ADDRESS || ahead.token.kind == TOKEN_NUMBER)) {
		if (!tail.text)
			tail.text = ahead.token.text;
		tail.len = (uint16_t)(ahead.token.text + ahead.token.len - tail.text);
	}
	if (!tail.len || !expr_part(tail, &bits, &number) || bits * (number + 1) > addr->bits)
		return token->len;
	addr->byte += bits * number / 8;
	addr->bit = (uint8_t)(bits * number % 8);
	addr->bits = (uint8_t)bits;
	return (size_t)(tail.text - token->text) + tail.len;
}

static void add_address(struct scan *scan, const struct token *token,
			struct iec_addr addr)
{
	const size_t len = xref_part(&scan->lex, &addr);

	add(scan, (struct xref_target){ XREF_ADDRESS, 0, 0, addr }, token->text, len);
}

/* ---- values of enumerations ---- */

static bool is_comparison(const struct lex *lex)
{
	return lex_is(lex, "=") || lex_is(lex, "<>") || lex_is(lex, "<") || lex_is(lex, ">") ||
	       lex_is(lex, "<=") || lex_is(lex, ">=");
}

/* Enumeration + 1 of the path that ends here; 0: it has none. */
static int enumeration_before(const struct scan *scan)
{
	const struct level *level = &scan->level[scan->depth];
	const struct var *var = level->used ?
		xref_var(scan->walk->project, &scan->walk->out->use[level->use].target) : NULL;

	return var ? var->enumeration : 0;
}

/* Of the name behind a comparison that follows. */
static int enumeration_behind(const struct scan *scan)
{
	struct lex ahead = scan->lex;
	const struct meaning *m;

	lex_next(&ahead);
	if (!is_comparison(&ahead) || lex_next(&ahead) != TOKEN_NAME)
		return 0;
	m = mean(scan, ahead.token.text, ahead.token.len);
	return m && m->kind != MEANING_LITERAL && m->like ? m->like->enumeration : 0;
}

/* The one of several enumerations with this value that is meant; NULL: only one has it, or it is not known. */
static const struct enum_value *meant(const struct scan *scan, uint32_t fold)
{
	const struct project *project = scan->walk->project;
	int lists = 0, of = scan->walk->values;

	for (int i = 0; i < project->enum_value_count; i++)
		lists += project->enum_value[i].fold == fold;
	if (lists > 1 && !of)
		of = scan->beside ? scan->beside : enumeration_behind(scan);
	return of ? named_value(project, of - 1, fold) : NULL;
}

/* A value of several enumerations, without its type: a use of each. False: it is none, or of one. */
static bool scan_several(struct scan *scan, const char *text, size_t len)
{
	struct project *project = scan->walk->project;
	const uint32_t fold = names_fold(&project->names, names_intern(&project->names, text, len));
	int found = 0;

	for (int i = 0; i < project->enum_value_count; i++)
		found += project->enum_value[i].fold == fold;
	for (int i = 0; found > 1 && i < project->enum_value_count; i++)
		if (project->enum_value[i].fold == fold)
			add(scan, (struct xref_target){ .what = XREF_VALUE, .index = i }, text, len);
	scan->level[scan->depth].used = false;
	return found > 1;
}

/* A value of an enumeration, with its type or without. False: it is none. */
static bool scan_value(struct scan *scan, const char *text, size_t len)
{
	struct project *project = scan->walk->project;
	struct names *names = &project->names;
	const bool plain = !memchr(text, '#', len) && !memchr(text, '.', len);
	const struct enum_value *wanted = plain ?
		meant(scan, names_fold(names, names_intern(names, text, len))) : NULL;
	size_t head = 0;

	if (plain && !wanted && scan_several(scan, text, len))
		return true;

	const int value = wanted ? (int)(wanted - project->enum_value) :
			  scope_value(scan->walk->scope, text, len, &head);
	const int type = value < 0 || !head ? -1 : named_find(project, names_fold(names,
			 names_intern(names, text, head - 1)));

	if (type >= 0)
		add(scan, (struct xref_target){ .what = XREF_NAMED, .index = type }, text, head - 1);
	if (value >= 0)
		add(scan, (struct xref_target){ .what = XREF_VALUE, .index = value }, text + head,
		    len - head);
	scan->level[scan->depth].used = false;
	return value >= 0;
}

/* A name without declaration: a constant, a system name, an address, or unknown. */
static void scan_other(struct scan *scan, const struct token *token, size_t first)
{
	const struct meaning *m = mean(scan, token->text, token->len);
	struct xref_target none = { .what = XREF_UNKNOWN, .index = -1 };

	if (m && m->kind == MEANING_LITERAL) {
		scan_value(scan, token->text, token->len);
		return;
	}
	if (m && m->addr.area != AREA_NONE)
		add_address(scan, token, m->addr);
	else
		add(scan, none, token->text, first);
}

/* Fill.X is a use of the step. TRANSITION is a reserved name. */
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
	struct token rest = *token;
	const struct meaning *m;
	int table;

	level->word = WORD_COUNT;
	if (scan_step(scan, token))
		return;
	if (scan->walk->values && !dot && scan_value(scan, token->text, len))
		return;
	m = mean(scan, token->text, len);
	if ((!m || !m->var) && words_strip(&scan->walk->project->words, &rest.text, &rest.len)) {
		scan_head(scan, &rest); /* behind all of its namespaces */
		return;
	}
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

/* Operators such as AND and MOD are not names. */
static bool is_operator(const struct token *token)
{
	const enum op op = op_find(token->text, token->len);

	return op == OP_AND || op == OP_OR || op == OP_XOR || op == OP_NOT ||
	       word_find(token->text, token->len) == FN_MOD;
}

/* PREVIOUS, R_EDGE and F_EDGE of networks (model/fbd.h) are no functions. */
static bool is_of_networks(const struct scan *scan, const struct token *token)
{
	static const char *const words[] = { "PREVIOUS", "R_EDGE", "F_EDGE" };

	for (size_t i = 0; scan->walk->pou && scan->walk->pou->fbd && i < sizeof(words) / sizeof(*words); i++)
		if (name_is(words[i], token->text, token->len))
			return true;
	return false;
}

/* The function of a call: `Twice(`. */
static void scan_function(struct scan *scan, const struct token *token)
{
	struct word_table *words = &scan->walk->project->words;
	const enum word word = words_find(words, token->text, token->len);
	const struct word_row *row = words_row(words, word);
	struct xref_target target = { .what = XREF_POU, .index = row->owner };

	scan->function = (uint16_t)word;
	if (word_is_own(word) && row->owner >= 0)
		xref_add(scan->walk, target, XREF_CALLED, (uint32_t)(token->text - scan->text),
			 (uint32_t)token->len);
	else if (word == WORD_COUNT && !is_of_networks(scan, token))
		scan_other(scan, token, token->len);
}

/* `MN :=` before an argument of a call. */
static void scan_argument(struct scan *scan, const struct token *token)
{
	enum pin_dir dir;
	struct xref_target target = xref_pin(scan->walk, (enum word)scan->call[scan->parens - 1],
					     token->text, token->len, &dir);
	const struct var *var = xref_var(scan->walk->project, &target);

	scan->pin = var ? var->enumeration : 0;
	if (target.what != XREF_UNKNOWN)
		xref_add(scan->walk, target, XREF_WRITTEN, (uint32_t)(token->text - scan->text),
			 (uint32_t)token->len);
}

static void scan_name(struct scan *scan, const struct token *token)
{
	struct lex ahead = scan->lex;

	lex_next(&ahead);
	if (!scan->dot && !is_operator(token) && lex_is(&ahead, "("))
		scan_function(scan, token);
	else if (!scan->dot && scan->parens > 0 && lex_is(&ahead, ":="))
		scan_argument(scan, token);
	else if (scan->dot)
		scan_members(scan, token->text, token->text + token->len);
	else if (!is_operator(token))
		scan_head(scan, token);
	else if (op_find(token->text, token->len) != OP_COUNT)
		scan->beside = 0; /* AND, OR, XOR, NOT: a condition begins */
}

static void scan_address(struct scan *scan, const struct token *token)
{
	struct iec_addr addr;

	scan->level[scan->depth].word = WORD_COUNT;
	if (iec_addr_parse(token->text, token->len, &addr) == ADDR_OK)
		add_address(scan, token, addr);
}

/* Enumeration + 1 of input @number of a function of the project. */
static int enumeration_of_input(const struct project *project, enum word word, int number)
{
	const struct word_row *row = words_row(&project->words, word);
	const struct var_table *vars = row->owner >= 0 ? &project->pou[row->owner].vars : NULL;

	for (int i = 0; vars && i < vars->count; i++)
		if (vars_flags(vars, i) & (VAR_INPUT | VAR_IN_OUT) && number-- == 0)
			return vars->var[i].enumeration;
	return 0;
}

/* What an argument meets: an input of a function of the project, else what the result of the function meets. */
static int beside_argument(const struct scan *scan)
{
	const int at = scan->parens - 1;
	const enum word word = at >= 0 ? (enum word)scan->call[at] : WORD_COUNT;

	if (at < 0)
		return scan->beside;
	return word != WORD_COUNT && word_is_own(word) ?
	       enumeration_of_input(scan->walk->project, word, scan->walk->open[at].arg) : scan->walk->open[at].beside;
}

/* What a value behind this symbol meets. */
static void meet(struct scan *scan)
{
	if (is_comparison(&scan->lex))
		scan->beside = enumeration_before(scan);
	else if (lex_is(&scan->lex, ":=") || lex_is(&scan->lex, "?="))
		scan->beside = scan->parens ? scan->pin : enumeration_before(scan);
	else if (lex_is(&scan->lex, "&"))
		scan->beside = 0;
	else if (lex_is(&scan->lex, ")") && scan->parens)
		scan->beside = scan->walk->open[scan->parens - 1].beside;
}

/* False: deeper than any text that a reader accepts. */
static bool scan_symbol(struct scan *scan)
{
	struct level *level = &scan->level[scan->depth];

	meet(scan);
	if (lex_is(&scan->lex, "[")) {
		if (level->used)
			scan->walk->out->use[level->use].open = true;
		if (++scan->depth == SCAN_DEPTH)
			return false;
		scan->level[scan->depth] = (struct level){ .word = WORD_COUNT, .kind = XREF_READ };
	} else if (lex_is(&scan->lex, "]")) {
		scan->depth -= scan->depth > 0;
	} else if (lex_is(&scan->lex, "(")) {
		if (scan->parens == SCAN_DEPTH)
			return false;
		scan->walk->open[scan->parens].beside = scan->beside;
		scan->walk->open[scan->parens].arg = 0;
		scan->call[scan->parens++] = scan->function;
		scan->beside = beside_argument(scan);
		level->used = false;
	} else if (lex_is(&scan->lex, ")") || lex_is(&scan->lex, ",")) {
		if (lex_is(&scan->lex, ",") && scan->parens > 0)
			scan->walk->open[scan->parens - 1].arg++;
		scan->parens -= scan->parens > 0 && lex_is(&scan->lex, ")");
		if (lex_is(&scan->lex, ","))
			scan->beside = beside_argument(scan);
		level->used = false;
		level->kind = level->output ? XREF_READ : level->kind;
		level->output = false;
	} else if (lex_is(&scan->lex, "=>") && scan->parens > 0) {
		level->used = false;
		level->kind = XREF_WRITTEN;
		level->output = true;
	} else if (lex_is(&scan->lex, ":=") || lex_is(&scan->lex, "?=")) {
		level->kind = XREF_READ;
	} else if (!lex_is(&scan->lex, ".")) {
		level->used = false;
	}
	return true;
}

/* Adds the names in @len bytes of the text of walk->slot from @at on
 * @kind: use of the first one, or of the target before `:=` */
static void xref_scan(struct xref_walk *walk, size_t at, size_t len, enum xref_kind kind)
{
	struct scan scan = { .walk = walk, .function = WORD_COUNT, .beside = walk->beside };
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
		else if (token->kind == TOKEN_NUMBER && literal_is_named(token->text, token->len))
			scan_value(&scan, token->text, token->len);
		else if (token->kind == TOKEN_SYMBOL)
			good = scan_symbol(&scan);
		if (token->kind != TOKEN_NAME)
			scan.function = WORD_COUNT;
		scan.dot = token->kind == TOKEN_SYMBOL && lex_is(&scan.lex, ".");
	}
}

/* Adds the names in a whole text. */
static void xref_all(struct xref_walk *walk, uint32_t *slot, enum xref_kind kind)
{
	if (!*slot)
		return;
	walk->slot = slot;
	xref_scan(walk, 0, names_len(&walk->project->names, *slot), kind);
}

/* The whole text names @target. */
static void xref_whole(struct xref_walk *walk, uint32_t *slot,
		      struct xref_target target, enum xref_kind kind)
{
	walk->slot = slot;
	xref_add(walk, target, kind, 0,
		 (uint32_t)names_len(&walk->project->names, *slot));
}

/* A name that the writer makes from a declaration. */
static void add_word(struct xref_walk *walk, enum word word, enum xref_kind kind)
{
	const struct word_row *row = words_row(&walk->project->words, word);
	struct xref_target target = { .what = XREF_POU, .index = row->owner };
	struct xref_use *use;

	if (!word_is_own(word) || row->owner < 0)
		return;
	if (row->kind == WORD_STRUCT)
		target.what = XREF_STRUCTURE;
	if (row->kind == WORD_STRUCT && !walk->project->structure[row->owner].name)
		return;
	walk->slot = NULL;
	use = xref_add(walk, target, kind, 0, 0);
	if (use)
		use->unnamed = true;
}

/* The type of a declaration, as it is written there. */
static void add_type(struct xref_walk *walk, const struct var *var)
{
	struct xref_use *use;

	while (var->target && !var->named)
		var = var->target->like;
	if (!var->named) {
		if (var->type == IEC_NONE)
			add_word(walk, var->fb, XREF_TYPE);
		return;
	}
	walk->slot = NULL;
	use = xref_add(walk, (struct xref_target){ .what = XREF_NAMED, .index = var->named - 1 },
		       XREF_TYPE, 0, 0);
	if (use)
		use->unnamed = true;
}

/* The values of an enumeration that a declaration lists. */
static void walk_values(struct xref_walk *walk, const struct var_table *table, int index)
{
	const struct var *var = &table->var[index];
	struct project *project = walk->project;
	const struct enumeration *list;

	if (!var->enumeration || var->named ||
	    (index && !var[-1].named && var[-1].enumeration == var->enumeration))
		return;
	list = &project->enumeration[var->enumeration - 1];
	for (int i = list->first; i < list->first + list->count; i++) {
		xref_whole(walk, &project->enum_value[i].name,
			   (struct xref_target){ .what = XREF_VALUE, .index = i }, XREF_DECLARED);
		walk->values = var->enumeration;
		if (project->enum_value[i].written && project->enum_value[i].text)
			xref_all(walk, &project->enum_value[i].text, XREF_READ);
		walk->values = 0;
	}
}

/* ---- declarations ---- */

#define INIT_LEVELS (2 * INIT_DEPTH) /* brackets inside one another, with those of n( … ) */

/* A name with a ( behind it calls a function, or is the n of n( … ). */
static bool is_function(const struct xref_walk *walk, const struct token *name)
{
	struct word_table *words = &walk->project->words;

	return words_row(words, words_find(words, name->text, name->len))->kind == WORD_FN;
}

/* Adds the members that initial values name: `[(Speed := 5), 2(Wait := T#2s)]`. */
static void walk_initial(struct xref_walk *walk, struct var *var)
{
	uint16_t word[INIT_LEVELS + 1] = { 0 }, next = word_of(var);
	uint16_t values[INIT_LEVELS + 1] = { 0 };
	const char *text = project_text(walk->project, var->init_text);
	int depth = 0;
	struct lex lex;

	walk->slot = &var->init_text;
	word[0] = next;
	values[0] = var->enumeration;
	walk->values = var->enumeration;
	lex_init(&lex, text, names_len(&walk->project->names, var->init_text));
	lex_next(&lex);
	while (lex.token.kind != TOKEN_END && depth < INIT_LEVELS) {
		const struct token token = lex.token;
		struct xref_target target;
		enum pin_dir dir;

		lex_next(&lex);
		if (*token.text == '(' || *token.text == '[') {
			word[++depth] = next;
			values[depth] = (uint16_t)walk->values;
		} else if (*token.text == ')' || *token.text == ']') {
			depth -= depth > 0;
		} else if (*token.text == ',') {
			next = word[depth];
			walk->values = values[depth];
		} else if (token.kind == TOKEN_NAME && lex_is(&lex, ":=")) {
			target = xref_pin(walk, (enum word)word[depth], token.text,
					  token.len, &dir);
			next = WORD_COUNT;
			walk->values = 0;
			if (target.what == XREF_UNKNOWN)
				continue;
			next = word_of(xref_var(walk->project, &target));
			walk->values = xref_var(walk->project, &target)->enumeration;
			xref_add(walk, target, XREF_INITIAL, (uint32_t)(token.text - text),
				 (uint32_t)token.len);
		} else if (token.kind == TOKEN_NAME && var->written &&
			   !(lex_is(&lex, "(") && is_function(walk, &token))) {
			xref_scan(walk, (size_t)(token.text - text), token.len, XREF_READ);
		} else if (token.kind == TOKEN_NUMBER &&
			   literal_is_named(token.text, token.len)) {
			xref_scan(walk, (size_t)(token.text - text), token.len, XREF_READ);
		}
	}
	walk->values = 0;
}

/* Adds the constants in the expressions of a declaration. */
static void walk_written(struct xref_walk *walk, struct var *var)
{
	if (!var->written)
		return;
	xref_all(walk, &var->written->bound[0], XREF_READ);
	xref_all(walk, &var->written->bound[1], XREF_READ);
	for (int i = 0; var->written->dim && i < var->own_dims; i++) {
		xref_all(walk, &var->written->dim[i][0], XREF_READ);
		xref_all(walk, &var->written->dim[i][1], XREF_READ);
	}
	xref_all(walk, &var->written->capacity, XREF_READ);
	xref_all(walk, &var->written->range[0], XREF_READ);
	xref_all(walk, &var->written->range[1], XREF_READ);
	walk->values = var->enumeration;
	if (var->written->initial && !init_has_parts(var) && !var->array.count && !var->inherits)
		xref_all(walk, &var->init_text, XREF_READ);
	walk->values = 0;
}

/* The text behind the name of declaration @index. */
static void walk_declaration(struct xref_walk *walk, struct var_table *table, int index)
{
	struct var *var = &table->var[index];

	add_type(walk, var);
	walk_values(walk, table, index);
	walk_written(walk, var);
	if (!var->inherits && (init_has_parts(var) || (var->array.count && var->written)))
		walk_initial(walk, var);
}

/* Globals stand in several files. */
static void enter_block(struct xref_walk *walk, const struct var_block *block)
{
	if (!block || !block->file)
		return;
	walk->place.file = block->file;
	walk->place.included = block->included;
}

static void walk_table(struct xref_walk *walk, int number)
{
	struct var_table *table = xref_table(walk->project, number);

	for (int i = 0; i < vars_declared(table); i++) {
		struct var *var = &table->var[i];

		walk->place.line = var->line;
		if (number == 0)
			enter_block(walk, vars_block(table, i));
		if (vars_flags(table, i) & VAR_RESULT) { /* from the heading */
			add_type(walk, var);
			walk_written(walk, var);
			continue;
		}
		xref_whole(walk, &var->name, xref_variable(walk->project, number, i),
			  XREF_DECLARED);
		walk_declaration(walk, table, i);
	}
}

/* The name of a POU in its heading; before that of an action stands its owner's. */
static void add_heading(struct xref_walk *walk, struct pou *pou, struct xref_target target)
{
	const char *name = project_text(walk->project, pou->name);
	const char *own = pou_own_name(walk->project, pou);
	const int owner = pou_owner(walk->project, pou);

	walk->slot = &pou->name;
	if (owner >= 0)
		xref_add(walk, (struct xref_target){ .what = XREF_POU, .index = owner }, XREF_TYPE, 0,
			 (uint32_t)(own - name) - 1);
	xref_add(walk, target, XREF_DECLARED, (uint32_t)(own - name), (uint32_t)strlen(own));
}

static void begin_place(struct xref_walk *walk, int pou, const char *file, int line,
			bool included)
{
	walk->place = (struct xref_use){ .pou = pou, .file = file, .line = line,
					 .included = included };
}

static bool structure_included(const struct project *project, int number)
{
	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->kind == PART_TYPES && number >= part->index &&
		    number < part->index + part->count)
			return part->included;
	}
	return false;
}

/* The types with names that are no structures. */
static void walk_named(struct xref_walk *walk)
{
	struct project *project = walk->project;

	for (int i = 0; i < project->named_count; i++) {
		struct named_type *type = &project->named[i];
		struct xref_target target = { .what = XREF_NAMED, .index = i };

		if (!type->like.var || type->part < 0)
			continue;
		begin_place(walk, -1, type->file, type->line,
			    type->part < project->part_count && project->part[type->part].included);
		xref_whole(walk, &type->like.var->name, target, XREF_DECLARED);
		walk_declaration(walk, &type->like, 0);
	}
}

/* The types of VAR_EXTERNAL, whose names are those of globals. */
static void walk_external(struct xref_walk *walk, const struct var_table *table)
{
	for (int i = 0; i < table->count; i++) {
		walk->place.line = table->var[i].line;
		add_type(walk, &table->var[i]);
	}
}

static void walk_declarations(struct xref_walk *walk)
{
	struct project *project = walk->project;

	begin_place(walk, -1, project->file, 0, false);
	walk_table(walk, 0);
	for (int i = 0; i < project->structure_count; i++) {
		struct structure *structure = &project->structure[i];
		struct xref_target target = { .what = XREF_STRUCTURE, .index = i };

		begin_place(walk, -1, structure->file, structure->line,
			    structure_included(project, i));
		if (structure->name)
			xref_whole(walk, &structure->name, target, XREF_DECLARED);
		walk_table(walk, project->pou_count + 1 + i);
	}
	walk_named(walk);
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *pou = &project->pou[i];
		struct xref_target target = { .what = XREF_POU, .index = i };

		begin_place(walk, i, pou->file, pou->line, pou->included);
		add_heading(walk, pou, target);
		walk->pou = pou;
		walk_table(walk, i + 1);
		walk_external(walk, &pou->external);
		walk->pou = NULL;
	}
}

/* ---- the configuration ---- */

static struct xref_target find_program(struct xref_walk *walk, uint32_t name)
{
	struct project *project = walk->project;
	struct xref_target target = { .what = XREF_UNKNOWN, .index = -1 };
	const uint32_t fold = names_fold(&project->names, name);

	for (int i = 0; i < project->pou_count; i++)
		if (names_fold(&project->names, project->pou[i].name) == fold)
			return (struct xref_target){ .what = XREF_POU, .index = i };
	return target;
}

static bool config_included(const struct project *project)
{
	for (int i = 0; i < project->part_count; i++)
		if (project->part[i].kind == PART_CONFIG)
			return project->part[i].included;
	return false;
}

static void walk_assignment(struct xref_walk *walk, uint32_t *slot);

/* PROGRAM P1 : Pump (In := Level): the names are those of Pump. */
static void walk_connected(struct xref_walk *walk, struct config_entry *entry)
{
	const char *name = project_text(walk->project, entry->pou);
	const int pou = project_find_pou(walk->project, name, strlen(name));

	for (int i = 0; i < entry->values && pou >= 0; i++) {
		walk->pou = &walk->project->pou[pou];
		walk->item = &entry->value[i];
		walk->slot = &entry->value[i].text;
		walk_assignment(walk, walk->slot);
	}
	walk->pou = NULL;
	walk->item = NULL;
}

static void walk_config(struct xref_walk *walk)
{
	struct config *config = walk->project->config;

	walk->pou = NULL;
	for (int i = 0; config && i < config->count; i++) {
		struct config_entry *entry = &config->entry[i];

		begin_place(walk, -1, config->file, entry->line,
			    config_included(walk->project));
		xref_all(walk, &entry->single, XREF_READ);
		if (entry->pou)
			xref_whole(walk, &entry->pou, find_program(walk, entry->pou),
				  XREF_RUN);
		walk_connected(walk, entry);
	}
}

/* ---- VAR_ACCESS ---- */

static void walk_access(struct xref_walk *walk)
{
	struct project *project = walk->project;

	for (int i = 0; i < project->access_count; i++) {
		struct access *access = &project->access[i];
		const struct access_block *block = access_block_of(project, i);
		const struct access_path path = access_split(project, access);

		begin_place(walk, block->pou - 1, block->file, access->var.line, block->included);
		walk->slot = &access->path;
		if (path.pou && !path.instance && path.program_len)
			xref_add(walk, (struct xref_target){ .what = XREF_POU,
				.index = (int)(path.pou - project->pou) }, XREF_READ,
				 path.program, path.program_len);
		walk->pou = path.pou;
		xref_scan(walk, path.at, names_len(&project->names, access->path) - path.at,
			  access->writes ? XREF_CHANGED : XREF_READ);
		walk->pou = NULL;
		add_type(walk, &access->var);
	}
}

/* ---- labels ---- */

static void note_label(struct xref_walk *walk, int pou, uint32_t *name, int at)
{
	const uint32_t fold = names_fold(&walk->project->names, *name);
	struct xref_target target = { XREF_LABEL, pou + 1, at - 1, { 0 } };

	if (!fold || fold >= walk->labels)
		return;
	if (walk->label[fold].body == walk->body) /* of two equal labels the first is used */
		target.index = walk->label[fold].at - 1;
	else
		walk->label[fold] = (struct xref_label){ walk->body, at };
	xref_whole(walk, name, target, XREF_DECLARED);
}

static void add_jump(struct xref_walk *walk, uint32_t *name)
{
	const uint32_t fold = names_fold(&walk->project->names, *name);
	struct xref_target target = { XREF_LABEL, walk->place.pou + 1, -1, { 0 } };

	if (fold && fold < walk->labels &&
	    walk->label[fold].body == walk->body)
		target.index = walk->label[fold].at - 1;
	xref_whole(walk, name, target, XREF_JUMPED);
}

static void add_routine(struct xref_walk *walk, uint32_t *name)
{
	const struct pou *pou = scope_pou(walk->scope, walk->pou, *name);
	struct xref_target target = { .what = XREF_POU };

	if (!pou) {
		xref_all(walk, name, XREF_CALLED);
		return;
	}
	target.index = (int)(pou - walk->project->pou);
	xref_whole(walk, name, target, XREF_CALLED);
}

/* ---- cells ---- */

/* The kind of use of a variable at a parameter of a box. */
static enum xref_kind kind_of_value(enum pin_dir dir, bool output)
{
	if (dir == PIN_IN_OUT)
		return XREF_CHANGED;
	return output ? XREF_WRITTEN : XREF_READ;
}

static enum xref_kind kind_of_pin(enum pin_dir dir, bool output)
{
	if (dir == PIN_IN_OUT)
		return XREF_CHANGED;
	return output ? XREF_READ : XREF_WRITTEN;
}

static void walk_args(struct xref_walk *walk, struct cell *cell)
{
	const char *text = project_text(walk->project, cell->args), *next = text;
	struct arg arg;

	while (args_next(&next, &arg)) {
		enum pin_dir dir;
		struct xref_target target = xref_pin(walk, (enum word)cell->word,
						     arg.pin, arg.pin_len, &dir);

		walk->slot = &cell->args;
		if (target.what != XREF_UNKNOWN)
			xref_add(walk, target, kind_of_pin(dir, arg.output),
				 (uint32_t)(arg.pin - text), (uint32_t)arg.pin_len);
		xref_scan(walk, (size_t)(arg.value - text), arg.value_len,
			  kind_of_value(dir, arg.output));
	}
}

/* A PIN row of the box above. */
static void walk_pin(struct xref_walk *walk, struct rung *rung, int row, int col)
{
	struct cell *cell = rung_cell(rung, row, col);
	const char *name = project_text(walk->project, cell->operand);
	struct xref_target target;
	enum pin_dir dir;

	if (!cell->operand)
		return;
	while (row > 0 && rung_at(rung, row, col)->word == ELEM_PIN)
		row--;
	target = xref_pin(walk, (enum word)rung_at(rung, row, col)->word, name,
			  strlen(name), &dir);
	if (target.what != XREF_UNKNOWN)
		xref_whole(walk, &cell->operand, target, kind_of_pin(dir, false));
}

static enum xref_kind kind_of_write(enum op op, bool list)
{
	if (op == OP_S)
		return XREF_SET;
	if (op == OP_R)
		return XREF_RESET;
	return list ? XREF_WRITTEN : XREF_COIL;
}

/* The text behind FOR. */
static void xref_loop(struct xref_walk *walk)
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

static void walk_operand(struct xref_walk *walk, struct cell *cell,
			 const struct word_row *row)
{
	switch (row->operand) {
	case OPND_BOOL_R:
	case OPND_ANY_R:
	case OPND_EXPR:
		xref_all(walk, &cell->operand, XREF_READ);
		return;
	case OPND_BOOL_W:
		xref_all(walk, &cell->operand, kind_of_write(row->next, false));
		return;
	case OPND_ANY_W:
	case OPND_ASSIGN:
		xref_all(walk, &cell->operand, XREF_WRITTEN);
		return;
	case OPND_INSTANCE:
		xref_all(walk, &cell->operand, XREF_CALLED);
		return;
	case OPND_LABEL:
		if (cell->operand)
			add_jump(walk, &cell->operand);
		return;
	case OPND_ROUTINE:
		if (cell->operand)
			add_routine(walk, &cell->operand);
		return;
	case OPND_LOOP:
		walk->slot = &cell->operand;
		if (cell->operand)
			xref_loop(walk);
		return;
	case OPND_NONE:
	case OPND_PIN:
	case OPND_LOOP_END:
	case OPND_EXECUTE:
		return;
	}
}

static void walk_cell(struct xref_walk *walk, struct rung *rung, int row, int col)
{
	struct cell *cell = rung_cell(rung, row, col);

	if (cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE)
		return;
	walk->place.row = row + 1;
	walk->place.col = col + 1;
	walk->place.line = rung_line(rung, row + 1);
	if (cell->word == ELEM_PIN) {
		walk_pin(walk, rung, row, col);
		return;
	}
	add_word(walk, (enum word)cell->word, XREF_CALLED);
	walk_operand(walk, cell, words_row(&walk->project->words, (enum word)cell->word));
	if (cell->args && cell->word != ELEM_EXECUTE)
		walk_args(walk, cell);
}

static void begin_rung(struct xref_walk *walk, struct pou *pou, int i)
{
	const struct rung *rung = pou->rung[i];

	begin_place(walk, (int)(pou - walk->project->pou), pou->file,
		    rung_line(rung, 0), pou->included);
	walk->place.rung = i + 1;
	walk->place.off = rung->off;
}

static void walk_rungs(struct xref_walk *walk, struct pou *pou, int first, int count)
{
	const int end = first + count;

	walk->body++;
	for (int i = first; i < end; i++) {
		begin_rung(walk, pou, i);
		note_label(walk, walk->place.pou, &pou->rung[i]->label, i + 1);
	}
	for (int i = first; i < end; i++) {
		struct rung *rung = pou->rung[i];

		begin_rung(walk, pou, i);
		for (int k = 0; k < rung->rows * rung->cols; k++)
			walk_cell(walk, rung, k / rung->cols, k % rung->cols);
	}
}

/* ---- lists ---- */

static void walk_call(struct xref_walk *walk, struct il_line *line)
{
	const struct meaning *m;
	enum diag_id why;

	add_routine(walk, &line->operand);
	m = scope_find(walk->scope, walk->pou, line->operand, &why);
	walk->call = m && m->kind == MEANING_INSTANCE ? (enum word)m->word : WORD_COUNT;
}

static void walk_op(struct xref_walk *walk, struct il_line *line)
{
	const enum operand_kind operand = op_row((enum op)line->op)->operand;

	if (!line->operand)
		return;
	if (operand == OPND_LABEL)
		add_jump(walk, &line->operand);
	else if (operand == OPND_INSTANCE)
		walk_call(walk, line);
	else if (operand == OPND_ANY_W || operand == OPND_BOOL_W)
		xref_all(walk, &line->operand, kind_of_write((enum op)line->op, true));
	else
		xref_all(walk, &line->operand, XREF_READ);
}

static void walk_arg(struct xref_walk *walk, struct il_line *line)
{
	const char *name = project_text(walk->project, line->pin);
	const bool output = line->kind == IL_ARG_OUT;
	enum pin_dir dir;
	struct xref_target target = xref_pin(walk, walk->call, name, strlen(name), &dir);

	if (target.what != XREF_UNKNOWN)
		xref_whole(walk, &line->pin, target, kind_of_pin(dir, output));
	xref_all(walk, &line->operand, kind_of_value(dir, output));
}

static void walk_line(struct xref_walk *walk, struct il_line *line)
{
	switch ((enum il_kind)line->kind) {
	case IL_OP:
		walk->call = WORD_COUNT;
		walk_op(walk, line);
		return;
	case IL_FN:
	case IL_CALL:
		walk->call = (enum word)line->word;
		add_word(walk, walk->call, XREF_CALLED);
		xref_all(walk, &line->operand, XREF_READ);
		return;
	case IL_ARG_IN:
	case IL_ARG_OUT:
		walk_arg(walk, line);
		return;
	case IL_CLOSE:
	case IL_LABEL:
	case IL_COMMENT:
	case IL_EACH:
	case IL_TARGET:
	case IL_TICK:
		return;
	}
}

/* The place in a text that is not a rung. */
static void xref_begin(struct xref_walk *walk, const struct pou *pou, int line, int column)
{
	begin_place(walk, (int)(pou - walk->project->pou), pou->file, line,
		    pou->included);
	walk->place.row = line ? line - pou->line + 1 : 0;
	walk->place.col = column;
}

static void begin_line(struct xref_walk *walk, struct pou *pou, const struct il_line *line)
{
	xref_begin(walk, pou, (int)line->line, line->rung ? 0 : line->col);
}

static void walk_list(struct xref_walk *walk, struct pou *pou, int first, int count)
{
	const int end = first + count;

	walk->body++;
	for (int i = first; i < end; i++) {
		struct il_line *line = &pou->il.line[i];

		begin_line(walk, pou, line);
		if (line->kind == IL_LABEL)
			note_label(walk, walk->place.pou, &line->operand,
				   pou->rung_count + i + 1);
	}
	walk->call = WORD_COUNT;
	for (int i = first; i < end; i++) {
		begin_line(walk, pou, &pou->il.line[i]);
		walk_line(walk, &pou->il.line[i]);
	}
}

/* ---- Structured Text ---- */

/* A part of a statement, up to the token at the lexer. */
static void walk_part(struct xref_walk *walk, const struct st_part *part, const struct st_walk *parts,
		      enum xref_kind kind)
{
	const char *text = project_text(walk->project, walk->item->text);

	xref_scan(walk, (size_t)(part->text - text), (size_t)(parts->lex.token.text - part->text), kind);
}

/* The word of the instance that is called; WORD_COUNT: none. */
static enum word word_called(struct xref_walk *walk, const struct expr *expr)
{
	const uint32_t id = scope_first_of(walk->scope, walk->pou, expr, &expr->node[expr->root]);
	enum diag_id why;
	const struct meaning *m = scope_find(walk->scope, walk->pou, id, &why);

	return m && m->kind == MEANING_INSTANCE ? (enum word)m->word : WORD_COUNT;
}

/* `Start()` and `Pump.Start()`: the action, and the POU before it. */
static void add_called(struct xref_walk *walk, const struct pou *pou, const char *name, size_t len,
		       uint32_t at)
{
	const struct project *project = walk->project;
	const int owner = pou_owner(project, pou);
	const char *dot = owner >= 0 ? memchr(name, '.', len) : NULL;
	const uint32_t head = dot ? (uint32_t)(dot - name) + 1 : 0;

	if (head)
		xref_add(walk, (struct xref_target){ .what = XREF_POU, .index = owner }, XREF_TYPE, at, head - 1);
	xref_add(walk, (struct xref_target){ .what = XREF_POU, .index = (int)(pou - project->pou) },
		 XREF_CALLED, at + head, (uint32_t)len - head);
}

static void walk_callee(struct xref_walk *walk, const struct st_part *part, const struct st_walk *parts,
			const struct expr *expr, enum word *word)
{
	const struct expr_node *root = &expr->node[expr->root];
	const char *text = project_text(walk->project, walk->item->text);
	const uint32_t id = scope_first_of(walk->scope, walk->pou, expr, root);
	const struct pou *pou = scope_pou(walk->scope, walk->pou, id);

	*word = pou && pou->kind == POU_FUNCTION ? pou->word : word_called(walk, expr);
	if (pou)
		add_called(walk, pou, root->text, root->len, (uint32_t)(root->text - text));
	else
		walk_part(walk, part, parts, XREF_CALLED);
}

static void walk_argument(struct xref_walk *walk, const struct st_part *part,
			  const struct st_walk *parts, enum word word)
{
	const char *text = project_text(walk->project, walk->item->text);
	enum pin_dir dir = PIN_NONE;

	if (part->pin.len && word != WORD_COUNT) {
		const struct xref_target target = xref_pin(walk, word, part->pin.text, part->pin.len,
							   &dir);

		const struct var *var = xref_var(walk->project, &target);

		walk->beside = var ? var->enumeration : 0;
		if (target.what != XREF_UNKNOWN)
			xref_add(walk, target, kind_of_pin(dir, part->role == ST_OUTPUT),
				 (uint32_t)(part->pin.text - text), part->pin.len);
	}
	if (part->role != ST_OPEN)
		walk_part(walk, part, parts, kind_of_value(dir, part->role == ST_OUTPUT));
	walk->beside = 0;
}

/* `a := b := 1`: what stands before each := gets a value, but the first of them. The last one begins the rest. */
static void walk_assignment(struct xref_walk *walk, uint32_t *slot)
{
	const char *text = project_text(walk->project, *slot);
	const size_t len = names_len(&walk->project->names, *slot);
	size_t from = 0, behind = 0;
	struct lex lex;
	int open = 0;

	walk->slot = slot;
	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		open += lex_is(&lex, "(") || lex_is(&lex, "[");
		open -= lex_is(&lex, ")") || lex_is(&lex, "]");
		if (!lex_is(&lex, ":=") || open != 0)
			continue;
		if (behind)
			xref_scan(walk, from, behind - from, XREF_WRITTEN);
		from = behind;
		behind = (size_t)(lex.at - text);
	}
	xref_scan(walk, from, len - from, XREF_WRITTEN);
}

/* SPLIT_DATE(Day, Year): IN is read, the places are written. */
static void walk_split(struct xref_walk *walk, const struct split *split, struct st_walk *parts,
		       struct expr *expr, struct diag_list *ignored)
{
	struct st_part part;
	int last = -1;

	while (st_next(parts, &part, expr, ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART)
		if (split_pin(split, &part, &last) >= 0 && part.role != ST_OPEN)
			walk_part(walk, &part, parts, last > 0 || part.role == ST_OUTPUT ? XREF_WRITTEN : XREF_READ);
}

/* The enumeration of the selector, which is the last path that was read, for the choices of its CASE. */
static void note_case(struct xref_walk *walk, int first)
{
	const struct st_item *item = walk->item;
	const struct xref *out = walk->out;
	const struct var *var = NULL;

	if (item->kind == ST_CASE && walk->cases < LIMIT_ST_DEPTH) {
		for (int i = first; i < out->count; i++)
			if (out->use[i].target.what == XREF_VARIABLE && out->use[i].kind == XREF_READ)
				var = xref_var(walk->project, &out->use[i].target);
		walk->selector[walk->cases++] = (uint16_t)(var ? var->enumeration : 0);
	} else if (item->kind == ST_END_CASE && walk->cases > 0) {
		walk->cases--;
	}
}

static void walk_statement(struct xref_walk *walk, struct expr *expr, struct diag_list *ignored)
{
	enum word word = WORD_COUNT;
	const struct split *split;
	struct st_part part;
	struct st_walk parts;

	st_begin(&parts, &walk->project->names, walk->item);
	if (walk->item->kind == ST_ASSIGN) {
		walk_assignment(walk, walk->slot);
		return;
	}
	while (st_next(&parts, &part, expr, ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART) {
		split = part.role == ST_CALLED ? split_find(walk->scope, walk->pou, &expr->node[expr->root]) : NULL;
		if (split) {
			walk_split(walk, split, &parts, expr, ignored);
			return;
		}
		if (part.role == ST_CALLED)
			walk_callee(walk, &part, &parts, expr, &word);
		else if (part.role == ST_INPUT || part.role == ST_OUTPUT || part.role == ST_OPEN)
			walk_argument(walk, &part, &parts, word);
		else
			walk_part(walk, &part, &parts, part.role != ST_VARIABLE ? XREF_READ : walk->pou->fbd ?
				  XREF_WRITTEN : XREF_CHANGED);
	}
}

/* @boxed: of this EXECUTE box, at its cell; NULL: of a body. */
static bool xref_st(struct xref_walk *walk, struct pou *pou, int first, int count, const struct boxed *boxed)
{
	struct expr *expr = arena_alloc(&walk->out->arena, sizeof(*expr));
	struct diag_list *ignored = arena_alloc(&walk->out->arena, sizeof(*ignored));

	int uses;

	if (!expr || !ignored)
		return false;
	for (int i = first; i < first + count; i++) {
		struct st_item *item = &pou->st->item[i];

		if (item->kind == ST_COMMENT)
			continue;
		xref_begin(walk, pou, item->line, item->column);
		if (boxed) {
			walk->place.rung = boxed->rung + 1;
			walk->place.row = boxed->row + 1;
			walk->place.col = boxed->col + 1;
			walk->place.off = pou->rung[boxed->rung]->off;
		}
		walk->item = item;
		walk->slot = &item->text;
		if (pou->fbd) {
			const int network = fbd_network_of(pou->fbd, i);

			scope_network(walk->scope, pou, network);
			walk->place.off = network >= 0 && pou->fbd->network[network].off;
		}
		uses = walk->out->count;
		walk->beside = item->kind == ST_CHOICE && walk->cases ? walk->selector[walk->cases - 1] : 0;
		walk_statement(walk, expr, ignored);
		walk->beside = 0;
		note_case(walk, uses);
	}
	walk->cases = 0;
	scope_network(walk->scope, pou, -1);
	walk->item = NULL;
	return true;
}

/* All statements of a POU: its body, or those of its actions and boxes. */
static bool xref_statements(struct xref_walk *walk, struct pou *pou)
{
	bool good = true;

	if (pou->language == LANGUAGE_ST || pou->language == LANGUAGE_FBD)
		return xref_st(walk, pou, 0, pou->st->count, NULL);
	for (int i = 0; pou->sfc && i < pou->sfc->action_count && good; i++)
		if (pou->sfc->action[i].body.kind == BODY_ST)
			good = xref_st(walk, pou, pou->sfc->action[i].body.first,
				       pou->sfc->action[i].body.count, NULL);
	for (int i = 0; i < pou->boxed_count && good; i++)
		if (pou->boxed[i].rung >= 0)
			good = xref_st(walk, pou, pou->boxed[i].first, pou->boxed[i].count, &pou->boxed[i]);
	return good;
}

/* A condition or an action of a chart. */
static void xref_body(struct xref_walk *walk, struct pou *pou, const struct sfc_body *body)
{
	if (body->kind == BODY_LIST)
		walk_list(walk, pou, body->first, body->count);
	else if (sfc_body_has_rungs(body))
		walk_rungs(walk, pou, body->first, body->count);
}

/* ---- all ---- */

/* Labels and jumps are compared by folded name, which must exist before. */
static bool make_labels(struct xref_walk *walk)
{
	struct names *names = &walk->project->names;

	walk->labels = (uint32_t)names->count;
	walk->label = arena_alloc(&walk->out->arena,
				  walk->labels * sizeof(*walk->label));
	return walk->label;
}

static struct xref_target target_of(const struct xref_walk *walk, const struct pou *pou,
				    enum xref_what what, int index)
{
	return (struct xref_target){ index < 0 ? XREF_UNKNOWN : what,
				     (int)(pou - walk->project->pou) + 1, index, { 0 } };
}

static void declare(struct xref_walk *walk, struct pou *pou)
{
	struct sfc *sfc = pou->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		xref_begin(walk, pou, sfc->step[i].line, sfc->step[i].column_at);
		xref_whole(walk, &sfc->step[i].name, target_of(walk, pou, XREF_STEP, i),
			   XREF_DECLARED);
	}
	for (int i = 0; i < sfc->transition_count; i++) {
		xref_begin(walk, pou, sfc->transition[i].line, sfc->transition[i].column);
		if (sfc->transition[i].name)
			xref_whole(walk, &sfc->transition[i].name,
				   target_of(walk, pou, XREF_TRANSITION, i),
				   XREF_DECLARED);
	}
	for (int i = 0; i < sfc->action_count; i++) {
		xref_begin(walk, pou, sfc->action[i].line, sfc->action[i].column);
		xref_whole(walk, &sfc->action[i].name,
			   target_of(walk, pou, XREF_ACTION, i), XREF_DECLARED);
	}
}

/* The kind of use of the BOOL of a step's line. */
static enum xref_kind kind_of(const struct sfc_use *use)
{
	if (use->kind == USE_SET || (use->kind == USE_ACTION &&
				     (use->qualifier == QUALIFIER_S ||
				      use->qualifier == QUALIFIER_SD ||
				      use->qualifier == QUALIFIER_DS ||
				      use->qualifier == QUALIFIER_SL)))
		return XREF_SET;
	if (use->kind == USE_RESET || use->qualifier == QUALIFIER_R)
		return XREF_RESET;
	return XREF_WRITTEN;
}

static void walk_uses(struct xref_walk *walk, struct pou *pou)
{
	for (int i = 0; i < pou->sfc->use_count; i++) {
		struct sfc_use *use = &pou->sfc->use[i];

		xref_begin(walk, pou, use->line, use->column);
		if (use->action >= 0)
			xref_whole(walk, &use->operand,
				   target_of(walk, pou, XREF_ACTION, use->action),
				   XREF_CALLED);
		else
			xref_all(walk, &use->operand, kind_of(use));
		xref_all(walk, &use->time, XREF_READ);
	}
}

static void walk_steps(struct xref_walk *walk, struct pou *pou)
{
	for (int i = 0; i < pou->sfc->step_count; i++) {
		struct sfc_step *step = &pou->sfc->step[i];

		xref_begin(walk, pou, step->line, step->column_at);
		xref_all(walk, &step->min, XREF_READ);
		xref_all(walk, &step->max, XREF_READ);
		xref_all(walk, &step->alarm, XREF_SET);
	}
}

static void walk_refs(struct xref_walk *walk, struct pou *pou, int first, int count,
		      enum xref_kind kind)
{
	for (int i = first; i < first + count; i++) {
		struct sfc_ref *ref = &pou->sfc->ref[i];

		xref_begin(walk, pou, ref->line, ref->column);
		xref_whole(walk, &ref->name, target_of(walk, pou, XREF_STEP, ref->step),
			   kind);
	}
}

/* A chart without its declarations. */
static void xref_sfc(struct xref_walk *walk, struct pou *pou)
{
	struct sfc *sfc = pou->sfc;

	declare(walk, pou);
	xref_begin(walk, pou, sfc->control_line, 0);
	for (int i = 0; i < CONTROL_COUNT; i++)
		xref_all(walk, &sfc->control[i], XREF_READ);
	walk_steps(walk, pou);
	walk_uses(walk, pou);
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		walk_refs(walk, pou, t->first_from, t->from_count, XREF_LEFT);
		walk_refs(walk, pou, t->first_to, t->to_count, XREF_ENTERED);
		xref_body(walk, pou, &t->condition);
	}
	for (int i = 0; i < sfc->action_count; i++)
		xref_body(walk, pou, &sfc->action[i].body);
}

bool xref_make(struct xref *out, struct project *project)
{
	struct xref_walk walk = { .out = out, .project = project };

	*out = (struct xref){ .project = project };
	arena_init(&out->arena);
	walk.scope = scope_new(project, &out->arena);
	walk.open = arena_alloc(&out->arena, SCAN_DEPTH * sizeof(*walk.open));
	if (!walk.scope || !walk.open || !make_labels(&walk))
		return false;
	walk_declarations(&walk);
	walk_config(&walk);
	walk_access(&walk);
	for (int i = 0; i < project->pou_count; i++) {
		walk.pou = &project->pou[i];
		if (project->pou[i].st && !xref_statements(&walk, &project->pou[i]))
			return false;
		if (project->pou[i].sfc) {
			xref_sfc(&walk, &project->pou[i]);
			continue;
		}
		walk_rungs(&walk, &project->pou[i], 0, project->pou[i].rung_count);
		walk_list(&walk, &project->pou[i], 0, project->pou[i].il.count);
	}
	return !out->arena.failed && !project->arena.failed;
}

void xref_free(struct xref *xref)
{
	arena_free(&xref->arena);
	*xref = (struct xref){ 0 };
}
