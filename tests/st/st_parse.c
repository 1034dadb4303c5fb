/* SPDX-License-Identifier: MIT
 *
 * st_parse - the evaluator's own parser of statements and expressions.
 *
 * It reads the text of each statement with the tokens of the engine, and nothing else of it.
 * ladder_build() has checked the text.
 */
#include "tests/st/inside.h"

#include <string.h>
#include <strings.h>

struct parse {
	struct st_world *world;
	const struct pou *pou;
	const struct st *st;
	struct body *body;
	int at;                     /* the next statement                     */
	struct lex lex;
};

static void *give(struct parse *p, size_t size)
{
	void *out = arena_alloc(&p->world->arena, size);

	if (!out)
		p->world->why = "out of memory";
	return out;
}

static void refuse(struct parse *p, const char *why)
{
	if (!p->world->why)
		p->world->why = why;
}

static void must(struct parse *p, const char *word)
{
	if (!lex_accept(&p->lex, word))
		refuse(p, word);
}

static struct tree *expression(struct parse *p, int level);

/* ---- places ---- */

static int local_of(const struct parse *p, const char *name, int len)
{
	for (int i = 0; i < p->pou->vars.count; i++) {
		const char *own = project_text(p->world->project, p->pou->vars.var[i].name);

		if (strncasecmp(own, name, (size_t)len) == 0 && !own[len])
			return i;
	}
	return -1;
}

static struct step **add_step(struct parse *p, struct step **end, struct step step)
{
	*end = give(p, sizeof(step));
	if (!*end)
		return end;
	**end = step;
	return &(*end)->next;
}

/* A number, `%B2`: bits of the place. */
static bool part(struct tree *tree, const char *text, size_t len)
{
	const bool named = *text == '%';

	if (!named && (*text < '0' || *text > '9'))
		return false;
	const int below = tree->bits * tree->number; /* of a part of a part */
	int number = 0;
	size_t i = named ? 2 : 0;

	tree->bits = !named || text[1] == 'X' ? 1 : text[1] == 'B' ? 8 : text[1] == 'W' ? 16 : 32;
	for (; i < len && text[i] != '.'; i++)
		number = number * 10 + text[i] - '0';
	tree->number = number + below / tree->bits;
	if (i < len)
		part(tree, text + i + 1, len - i - 1);
	return true;
}

/* `.Name.Other`, between @at and @stop. */
static struct step **members(struct parse *p, struct tree *tree, struct step **end, const char *at,
			     const char *stop)
{
	while (at < stop) {
		const char *dot = memchr(at, '.', (size_t)(stop - at));

		dot = dot ? dot : stop;
		if (part(tree, at, (size_t)(dot - at)))
			return end;
		end = add_step(p, end, (struct step){ .name = at, .len = (int)(dot - at) });
		at = dot + 1;
	}
	return end;
}

/* The name in front is read; indices and members follow. */
static void path(struct parse *p, struct tree *tree, const char *rest, const char *stop)
{
	const struct slot *global = tree->global;
	const bool reference = global && global->shape && global->var->target->word == REFERENCE_TO &&
			       !lex_is(&p->lex, "REF");
	struct step **end = reference ? add_step(p, &tree->step, (struct step){ .through = true }) :
			    &tree->step;

	end = members(p, tree, end, rest, stop);

	for (;;) {
		if (lex_accept(&p->lex, "^")) {
			end = add_step(p, end, (struct step){ .through = true });
		} else if (lex_accept(&p->lex, "[")) {
			do
				end = add_step(p, end, (struct step){ .index = expression(p, 1) });
			while (lex_accept(&p->lex, ","));
			must(p, "]");
		} else if (lex_is(&p->lex, ".")) {
			lex_next(&p->lex);
			if (!part(tree, p->lex.token.text, p->lex.token.len))
				end = members(p, tree, end, p->lex.token.text,
					      p->lex.token.text + p->lex.token.len);
			lex_next(&p->lex);
		} else {
			return;
		}
	}
}

static bool enum_constant(struct parse *p, struct tree *tree, const char *name, int len)
{
	const struct project *project = p->world->project;

	for (int i = 0; i < project->enum_value_count; i++) {
		const char *own = project_text(project, project->enum_value[i].name);

		if (strncasecmp(own, name, (size_t)len) != 0 || own[len])
			continue;
		tree->kind = TREE_CONSTANT;
		tree->literal = (struct literal){
			.type = project->enumeration[project->enum_value[i].enumeration].type,
			.value.i = project->enum_value[i].number,
		};
		return true;
	}
	return false;
}

/* `Name[3]` of a text is MID(Name, 1, 3). */
static void take_letter(struct parse *p, struct tree *tree)
{
	struct frame_of f = { .world = p->world, .locals = &p->body->frame };
	struct step **last = &tree->step;
	struct tree *index, *one, *base;
	const struct slot *slot;

	while (*last && (*last)->next)
		last = &(*last)->next;
	if (!*last || !(*last)->index || tree->bits || p->world->why)
		return;
	index = (*last)->index;
	*last = NULL;
	slot = tree_first(&f, tree);
	if (!slot || slot->kind != SLOT_VALUE || slot->value->type != IEC_STRING) {
		add_step(p, last, (struct step){ .index = index });
		return;
	}
	base = give(p, sizeof(*base));
	one = give(p, sizeof(*one));
	if (!base || !one)
		return;
	*base = *tree;
	*one = (struct tree){ .kind = TREE_CONSTANT, .literal.value.i = 1, .local = -1, .next = index };
	base->next = one;
	*tree = (struct tree){ .kind = TREE_CALL, .fn = FN_MID, .left = base, .local = -1, .letter = true };
}

/* `Other.Level`: a variable of a program. */
static struct slot *of_program(struct parse *p, const char *text, int len, const char *dot, const char *stop,
			       const char **rest)
{
	const struct project *project = p->world->project;
	const char *end = dot ? memchr(dot + 1, '.', (size_t)(stop - dot - 1)) : NULL;

	for (int i = 0; dot && i < project->pou_count; i++) {
		const char *own = project_text(project, project->pou[i].name);

		if (project->pou[i].kind != POU_PROGRAM || strncasecmp(own, text, (size_t)len) != 0 || own[len])
			continue;
		*rest = end ? end + 1 : stop;
		return slot_member(&p->world->body[i].frame, dot + 1, (int)((end ? end : stop) - dot - 1));
	}
	return NULL;
}

/* The name at the lexer, which is stepped over. */
static void name(struct parse *p, struct tree *tree)
{
	const char *rest;

	const struct token token = p->lex.token;
	const char *stop = token.text + token.len, *dot = memchr(token.text, '.', token.len);
	const int len = (int)((dot ? dot : stop) - token.text);

	lex_next(&p->lex);
	rest = dot ? dot + 1 : stop;
	tree->kind = TREE_PLACE;
	tree->local = local_of(p, token.text, len);
	if (tree->local < 0)
		tree->global = slot_member(&p->world->globals, token.text, len);
	if (tree->local < 0 && !tree->global)
		tree->global = of_program(p, token.text, len, dot, stop, &rest);
	if (tree->local >= 0 || tree->global) {
		path(p, tree, rest, stop);
		take_letter(p, tree);
	} else if (!enum_constant(p, tree, token.text, len))
		refuse(p, "a name");
}

/* ---- calls ---- */

static const struct pou *pou_of(const struct parse *p, const char *text, size_t len)
{
	const struct project *project = p->world->project;

	for (int i = 0; i < project->pou_count; i++) {
		const char *own = project_text(project, project->pou[i].name);

		if (strncasecmp(own, text, len) == 0 && !own[len])
			return &project->pou[i];
	}
	return NULL;
}

/* Behind the parenthesis, up to the other one. */
static struct tree *arguments(struct parse *p)
{
	struct tree *first = NULL, **end = &first;

	if (lex_accept(&p->lex, ")"))
		return NULL;
	do {
		struct lex ahead = p->lex;
		const struct token pin = p->lex.token;
		bool named, out;

		lex_next(&ahead);
		out = lex_is(&ahead, "=>");
		named = pin.kind == TOKEN_NAME && (out || lex_is(&ahead, ":="));
		if (named) {
			lex_next(&p->lex);
			lex_next(&p->lex);
		}
		*end = expression(p, 1);
		if (!*end)
			return first;
		if (named) {
			(*end)->pin = pin.text;
			(*end)->pin_len = (int)pin.len;
			(*end)->out = out;
		}
		end = &(*end)->next;
	} while (lex_accept(&p->lex, ","));
	must(p, ")");
	return first;
}

static void call(struct parse *p, struct tree *tree)
{
	const struct token token = p->lex.token;
	struct word_table *words = &p->world->project->words;

	if (lex_is(&p->lex, "REF") || lex_is(&p->lex, "ADR")) {
		lex_next(&p->lex);
		lex_next(&p->lex);
		tree->kind = TREE_REF;
		tree->left = expression(p, 1);
		must(p, ")");
		return;
	}
	if (lex_is(&p->lex, "LOWER_BOUND") || lex_is(&p->lex, "UPPER_BOUND")) {
		tree->upper = lex_is(&p->lex, "UPPER_BOUND");
		lex_next(&p->lex);
		lex_next(&p->lex);
		tree->kind = TREE_BOUND;
		tree->left = expression(p, 1);
		must(p, ",");
		tree->right = expression(p, 1);
		must(p, ")");
		return;
	}
	tree->kind = TREE_CALL;
	tree->pou = pou_of(p, token.text, token.len);
	if (!tree->pou) {
		const enum word word = words_find(words, token.text, token.len);
		const struct word_row *row = words_row(words, word);

		if (word == WORD_COUNT)
			refuse(p, "a function");
		tree->fn = word >= WORD_FIRST_MADE ? row->runs : word;
		tree->to = row->result < IEC_TYPE_COUNT ? row->result : IEC_NONE;
	}
	lex_next(&p->lex);
	lex_next(&p->lex);
	tree->left = arguments(p);
}

/* ---- expressions ---- */

/* The right side of a lazy one is computed only if it matters. */
static const struct { const char *text; enum word fn; int level; bool lazy; } operators[] = {
	{ "OR", FN_OR, 1, false }, { "XOR", FN_XOR, 2, false }, { "AND", FN_AND, 3, false }, { "&", FN_AND, 3, false },
	{ "AND_THEN", FN_AND, 3, true }, { "OR_ELSE", FN_OR, 1, true },
	{ "=", FN_EQ, 4, false }, { "<>", FN_NE, 4, false }, { "<", FN_LT, 5, false }, { ">", FN_GT, 5, false },
	{ "<=", FN_LE, 5, false }, { ">=", FN_GE, 5, false }, { "+", FN_ADD, 6, false }, { "-", FN_SUB, 6, false },
	{ "*", FN_MUL, 7, false }, { "/", FN_DIV, 7, false }, { "MOD", FN_MOD, 7, false },
};
#define OPERATORS (sizeof(operators) / sizeof(*operators))
#define UNARY 8

static struct tree *new_tree(struct parse *p, struct tree from)
{
	struct tree *tree = give(p, sizeof(*tree));

	if (tree)
		*tree = from;
	return tree;
}

static struct tree *unary(struct parse *p)
{
	struct tree tree = { .kind = TREE_CONSTANT, .local = -1 };
	struct lex ahead = p->lex;
	const struct token token = p->lex.token;

	if (lex_accept(&p->lex, "(")) {
		struct tree *inner = expression(p, 1);

		must(p, ")");
		return inner;
	}
	if (lex_accept(&p->lex, "+"))
		return unary(p);
	if (lex_is(&p->lex, "-") || lex_is(&p->lex, "NOT")) {
		tree.kind = lex_is(&p->lex, "-") ? TREE_NEG : TREE_NOT;
		lex_next(&p->lex);
		tree.left = unary(p);
		if (tree.left && tree.kind == TREE_NEG && tree.left->kind == TREE_CONSTANT &&
		    tree.left->literal.type == IEC_NONE) {
			tree.left->minus = !tree.left->minus;
			return tree.left;
		}
		return new_tree(p, tree);
	}
	lex_next(&ahead);
	if (token.kind == TOKEN_NAME && lex_is(&ahead, "(")) {
		call(p, &tree);
	} else if (literal_is_named(token.text, token.len)) {
		const char *hash = (const char *)memchr(token.text, '#', token.len) + 1;

		lex_next(&p->lex);
		if (!enum_constant(p, &tree, hash, (int)(token.text + token.len - hash)))
			refuse(p, "a value of an enumeration");
	} else if (literal_parse(token.text, token.len, &tree.literal) == LITERAL_OK) {
		lex_next(&p->lex);
	} else if (token.kind == TOKEN_NAME) {
		name(p, &tree);
	} else {
		refuse(p, "an expression");
	}
	return p->world->why ? NULL : new_tree(p, tree);
}

static struct tree *expression(struct parse *p, int level)
{
	struct tree *left = level == UNARY ? unary(p) : expression(p, level + 1);
	size_t i = 0;

	while (left && i < OPERATORS) {
		if (operators[i].level != level || !lex_is(&p->lex, operators[i].text)) {
			i++;
			continue;
		}
		lex_next(&p->lex);
		left = new_tree(p, (struct tree){ .kind = TREE_TWO, .fn = operators[i].fn, .lazy = operators[i].lazy,
			.left = left, .right = expression(p, level + 1), .local = -1 });
		i = 0;
	}
	return left;
}

/* ---- statements ---- */

static struct stmt *block_of(struct parse *p, enum st_kind end);

static const struct st_item *here(const struct parse *p)
{
	return p->at < p->st->count ? &p->st->item[p->at] : NULL;
}

static void enter(struct parse *p)
{
	const struct names *names = &p->world->project->names;

	lex_init(&p->lex, names_text(names, here(p)->text), names_len(names, here(p)->text));
	lex_next(&p->lex);
}

/* IF and ELSIF: a condition, the branch, the next one. */
static void branch(struct parse *p, struct stmt *stmt, const char *word)
{
	must(p, word);
	if (stmt->kind != ST_ELSE)
		stmt->value = expression(p, 1);
	p->at++;
	stmt->body = block_of(p, ST_END_IF);
	if (!here(p) || here(p)->kind == ST_END_IF) {
		p->at++;
		return;
	}
	stmt->other = give(p, sizeof(*stmt));
	if (!stmt->other)
		return;
	stmt->other->kind = (enum st_kind)here(p)->kind;
	enter(p);
	branch(p, stmt->other, stmt->other->kind == ST_ELSE ? "ELSE" : "ELSIF");
}

static struct choice *choices(struct parse *p)
{
	struct choice *first = NULL, **end = &first;

	do {
		struct choice *choice = *end = give(p, sizeof(*choice));

		if (!choice)
			return first;
		choice->low = expression(p, 1);
		if (lex_accept(&p->lex, ".")) {
			must(p, ".");
			choice->high = expression(p, 1);
		}
		end = &choice->next;
	} while (lex_accept(&p->lex, ","));
	return first;
}

static void case_of(struct parse *p, struct stmt *stmt)
{
	struct stmt **end = &stmt->body;

	must(p, "CASE");
	stmt->value = expression(p, 1);
	p->at++;
	while (here(p) && here(p)->kind != ST_END_CASE && !p->world->why) {
		if (here(p)->kind == ST_COMMENT || here(p)->kind == ST_EMPTY) {
			p->at++;
			continue;
		}
		*end = give(p, sizeof(**end));
		if (!*end)
			return;
		(*end)->kind = (enum st_kind)here(p)->kind;
		enter(p);
		if ((*end)->kind == ST_CHOICE)
			(*end)->choice = choices(p);
		p->at++;
		(*end)->body = block_of(p, ST_END_CASE);
		end = &(*end)->next;
	}
	p->at++;
}

static void for_of(struct parse *p, struct stmt *stmt)
{
	must(p, "FOR");
	stmt->place = expression(p, 1);
	must(p, ":=");
	stmt->from = expression(p, 1);
	must(p, "TO");
	stmt->to = expression(p, 1);
	if (lex_accept(&p->lex, "BY"))
		stmt->by = expression(p, 1);
	p->at++;
	stmt->body = block_of(p, ST_END_FOR);
	p->at++;
}

static void call_of(struct parse *p, struct stmt *stmt)
{
	const struct pou *pou = pou_of(p, p->lex.token.text, p->lex.token.len);
	struct lex ahead = p->lex;

	lex_next(&ahead);
	stmt->parts = lex_is(&p->lex, "SPLIT_DATE") ? 1 : lex_is(&p->lex, "SPLIT_TOD") ? 2 : lex_is(&p->lex, "SPLIT_DT") ? 3 : 0;
	if (stmt->parts) {
		lex_next(&p->lex);
		must(p, "(");
		stmt->args = arguments(p);
	} else if (pou && pou->kind == POU_PROGRAM) {
		stmt->called = pou;
		p->world->body[pou - p->world->project->pou].called = true;
		lex_next(&p->lex);
		must(p, "(");
		stmt->args = arguments(p);
	} else if (pou && pou->kind == POU_SUBROUTINE) {
		stmt->called = pou;
	} else if (pou || (lex_is(&ahead, "(") && !memchr(p->lex.token.text, '.', p->lex.token.len) &&
			   words_find(&p->world->project->words, p->lex.token.text,
				      p->lex.token.len) != WORD_COUNT)) {
		stmt->value = expression(p, 1);
	} else {
		stmt->place = give(p, sizeof(*stmt->place));
		if (!stmt->place)
			return;
		name(p, stmt->place);
		must(p, "(");
		stmt->args = arguments(p);
	}
	p->at++;
}

static void loop_of(struct parse *p, struct stmt *stmt)
{
	if (stmt->kind == ST_WHILE) {
		must(p, "WHILE");
		stmt->value = expression(p, 1);
		p->at++;
		stmt->body = block_of(p, ST_END_WHILE);
		p->at++;
		return;
	}
	p->at++;
	stmt->body = block_of(p, ST_UNTIL);
	if (!here(p))
		return;
	enter(p);
	must(p, "UNTIL");
	stmt->value = expression(p, 1);
	p->at++;
}

static struct tree *argument_of(struct parse *p, const struct tree *from, struct tree *next)
{
	struct tree *tree = from ? new_tree(p, *from) : NULL;

	if (tree)
		tree->next = next;
	return tree;
}

/* `Name[i] := value` is Name := REPLACE(Name, LEFT(value, 1), 1, i). */
static void store_letter(struct parse *p, struct stmt *stmt)
{
	struct tree *name = stmt->place->left, *one = name->next, *index = one->next, *left;

	left = new_tree(p, (struct tree){ .kind = TREE_CALL, .fn = FN_LEFT, .local = -1,
					  .left = argument_of(p, stmt->value, argument_of(p, one, NULL)) });
	stmt->value = new_tree(p, (struct tree){ .kind = TREE_CALL, .fn = FN_REPLACE, .local = -1,
		.left = argument_of(p, name, argument_of(p, left, argument_of(p, one, argument_of(p, index, NULL)))) });
	stmt->place = argument_of(p, name, NULL);
}

/* place := value, place REF= other, place ?= reference, a := b := value */
static void assigned(struct parse *p, struct stmt *stmt)
{
	stmt->place = expression(p, UNARY);
	if (lex_accept(&p->lex, "REF")) {
		must(p, "=");
		stmt->value = new_tree(p, (struct tree){ .kind = TREE_REF, .local = -1,
							 .left = expression(p, 1) });
		return;
	}
	stmt->tried = lex_accept(&p->lex, "?=");
	if (stmt->tried && lex_accept(&p->lex, "NULL")) {
		stmt->value = new_tree(p, (struct tree){ .kind = TREE_REF, .local = -1 });
		return;
	}
	if (!stmt->tried)
		must(p, ":=");
	const struct lex value = p->lex;

	stmt->value = expression(p, 1);
	if (lex_is(&p->lex, ":=")) { /* the value is what comes next, stored first */
		stmt->body = give(p, sizeof(*stmt));
		p->lex = value;
		if (!stmt->body)
			return;
		stmt->body->kind = ST_ASSIGN;
		assigned(p, stmt->body);
	}
	if (stmt->place && stmt->place->letter && stmt->value)
		store_letter(p, stmt);
}

static void statement(struct parse *p, struct stmt *stmt)
{
	enter(p);
	switch ((int)stmt->kind) {
	case ST_ASSIGN:
		assigned(p, stmt);
		p->at++;
		break;
	case ST_JUMP:
		must(p, "JMP");
		stmt->label = p->lex.token;
		p->at++;
		break;
	case ST_LABEL:
		stmt->label = p->lex.token;
		p->at++;
		break;
	case ST_CALL: call_of(p, stmt); break;
	case ST_IF: branch(p, stmt, "IF"); break;
	case ST_CASE: case_of(p, stmt); break;
	case ST_FOR: for_of(p, stmt); break;
	case ST_WHILE:
	case ST_REPEAT: loop_of(p, stmt); break;
	default: p->at++; break;
	}
}

/* Does the block end here, or its next branch begin? */
static bool ends(const struct parse *p, enum st_kind end)
{
	const enum st_kind kind = (enum st_kind)here(p)->kind;

	return kind == end || (end == ST_END_IF && (kind == ST_ELSIF || kind == ST_ELSE)) ||
	       (end == ST_END_CASE && (kind == ST_CHOICE || kind == ST_ELSE));
}

static struct stmt *block_of(struct parse *p, enum st_kind end)
{
	struct stmt *first = NULL, **last = &first;

	while (here(p) && !ends(p, end) && !p->world->why) {
		struct stmt *stmt;

		if (here(p)->kind == ST_COMMENT || here(p)->kind == ST_EMPTY) {
			p->at++;
			continue;
		}
		stmt = *last = give(p, sizeof(*stmt));
		if (!stmt)
			break;
		stmt->kind = (enum st_kind)here(p)->kind;
		statement(p, stmt);
		last = &stmt->next;
	}
	return first;
}

bool parse_body(struct st_world *world, struct body *body)
{
	struct parse p = { .world = world, .pou = body->pou, .st = body->pou->st, .body = body };

	if (!p.st) {
		world->why = "a POU that is not Structured Text";
		return false;
	}
	body->first = block_of(&p, ST_KINDS);
	return !world->why;
}
