/* SPDX-License-Identifier: MIT
 *
 * acts - terms and acts: making them, and what they read and write.
 */
#include "engine/convert/acts.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/check/touch.h"

#include <stdio.h>
#include <string.h>

uint32_t acts_intern(struct acts *acts, const char *text, size_t len)
{
	const uint32_t id = names_intern(&acts->project->names, text, len);

	acts->failed |= !id && len;
	return id;
}

const struct meaning *acts_meaning(struct acts *acts, uint32_t operand)
{
	enum diag_id why;

	return operand ? scope_find(acts->scope, acts->pou, operand, &why) : NULL;
}

static struct term *term_new(struct acts *acts, enum term_kind kind, int parts)
{
	struct term *term = arena_alloc(acts->arena, sizeof(*term));

	if (term && parts)
		term->part = arena_alloc(acts->arena, sizeof(*term->part) * (size_t)parts);
	if (!term || (parts && !term->part)) {
		acts->failed = true;
		acts->no_term = (struct term){ .kind = TERM_TRUE };
		return &acts->no_term;
	}
	term->kind = kind;
	term->parts = parts;
	term->temp = -1;
	return term;
}

const struct term *term_true(struct acts *acts)
{
	return term_new(acts, TERM_TRUE, 0);
}

const struct term *term_name(struct acts *acts, uint32_t operand)
{
	struct term *term = term_new(acts, TERM_NAME, 0);
	uint32_t *read = arena_alloc(acts->arena, sizeof(*read));

	if (!read) {
		acts->failed = true;
		return term;
	}
	*read = operand;
	term->text = operand;
	term->level = LEVEL_NAME;
	term->read = read;
	term->reads = 1;
	return term;
}

const struct term *term_words(struct acts *acts, enum level level, const char *text, size_t len)
{
	struct term *term = term_new(acts, TERM_WORDS, 0);

	term->level = (uint8_t)level;
	term->text = acts_intern(acts, text, len);
	return term;
}

const struct term *term_temp(struct acts *acts, int temp)
{
	struct term *term = term_new(acts, TERM_TEMP, 0);

	term->temp = temp;
	return term;
}

const struct term *term_not(struct acts *acts, const struct term *of)
{
	struct term *term;

	if (of->kind == TERM_NOT)
		return of->part[0];
	term = term_new(acts, TERM_NOT, 1);
	if (term->parts)
		term->part[0] = of;
	return term;
}

const struct term *term_edge(struct acts *acts, const struct term *of, bool rising)
{
	struct term *term = term_new(acts, TERM_EDGE, 1);

	if (term->parts)
		term->part[0] = of;
	term->rising = rising;
	return term;
}

bool term_has_edge(const struct acts *acts, const struct term *term)
{
	term = term_plain(acts, term);
	if (term->kind == TERM_EDGE)
		return true;
	for (int i = 0; i < term->parts; i++)
		if (term_has_edge(acts, term->part[i]))
			return true;
	return false;
}

static int count_parts(const struct term *term, enum term_kind kind)
{
	return term->kind == kind && !term->lazy ? term->parts : 1;
}

static int put_parts(struct term *to, int at, const struct term *from, int parts)
{
	for (int i = 0; i < parts; i++)
		to->part[at + i] = parts == 1 ? from : from->part[i];
	return at + parts;
}

const struct term *term_both(struct acts *acts, enum term_kind kind, const struct term *a,
			     const struct term *b)
{
	const int first = count_parts(a, kind), second = count_parts(b, kind);
	struct term *term;
	int at;

	if (kind == TERM_AND && a->kind == TERM_TRUE)
		return b;
	if (kind == TERM_AND && b->kind == TERM_TRUE)
		return a;
	if (kind == TERM_OR && (a->kind == TERM_TRUE || b->kind == TERM_TRUE))
		return a->kind == TERM_TRUE ? a : b;
	term = term_new(acts, kind, first + second);
	if (!term->parts)
		return term;
	at = put_parts(term, 0, a, first);
	put_parts(term, at, b, second);
	return term;
}

const struct term *term_plain(const struct acts *acts, const struct term *term)
{
	while (term->kind == TERM_TEMP && acts->temp[term->temp].is)
		term = acts->temp[term->temp].is;
	return term;
}

bool term_equal(const struct acts *acts, const struct term *a, const struct term *b)
{
	if (!a || !b)
		return a == b;
	a = term_plain(acts, a);
	b = term_plain(acts, b);
	if (a == b)
		return true;
	if (a->kind != b->kind || a->text != b->text || a->temp != b->temp ||
	    a->parts != b->parts || a->lazy != b->lazy || a->kind == TERM_EDGE)
		return false;
	for (int i = 0; i < a->parts; i++)
		if (!term_equal(acts, a->part[i], b->part[i]) ||
		    (a->pin && a->pin[i] != b->pin[i]))
			return false;
	return true;
}

/* A bit of a number lies where the number lies. */
static const struct meaning *place_of(const struct meaning *meaning)
{
	while (meaning && meaning->part)
		meaning = meaning->number;
	return meaning;
}

static bool touches(struct acts *acts, uint32_t write, uint32_t read)
{
	const struct meaning *to = place_of(acts_meaning(acts, write));
	const struct meaning *from = place_of(acts_meaning(acts, read));

	if (from && from->kind == MEANING_LITERAL)
		return false;
	if (!to || !from || to->through || from->through)
		return true;
	return meaning_touches(acts->scope, to, from);
}

bool term_reads(struct acts *acts, const struct term *term, uint32_t operand)
{
	term = term_plain(acts, term);
	if (term->reads_any)
		return true;
	for (int i = 0; i < term->reads; i++)
		if (touches(acts, operand, term->read[i]))
			return true;
	for (int i = 0; i < term->parts; i++)
		if (term_reads(acts, term->part[i], operand))
			return true;
	return false;
}

/* Does it read a global, an address or, with @locals, any variable? */
static bool reads_variable(struct acts *acts, const struct term *term, bool locals)
{
	term = term_plain(acts, term);
	if (term->reads_any)
		return true;
	for (int i = 0; i < term->reads; i++) {
		const struct meaning *m = acts_meaning(acts, term->read[i]);

		if (!m || (m->kind != MEANING_LITERAL && (locals || !m->pou || m->through)))
			return true;
	}
	for (int i = 0; i < term->parts; i++)
		if (reads_variable(acts, term->part[i], locals))
			return true;
	return false;
}

static bool reads_temp(const struct acts *acts, const struct term *term, int temp)
{
	term = term_plain(acts, term);
	if (term->kind == TERM_TEMP)
		return term->temp == temp;
	for (int i = 0; i < term->parts; i++)
		if (reads_temp(acts, term->part[i], temp))
			return true;
	return false;
}

bool act_touches(struct acts *acts, const struct act *act, const struct term *term)
{
	if (act->kind == ACT_NOTHING || act->kind == ACT_REMARK)
		return false;
	if (act->kind == ACT_LABEL || act->kind == ACT_LOOP || act->kind == ACT_LOOP_END)
		return true;
	if ((act->writes_any || act->writes_globals) &&
	    reads_variable(acts, term, act->writes_any))
		return true;
	if (act->target && term_reads(acts, term, act->target))
		return true;
	if (act->temp >= 0 && reads_temp(acts, term, act->temp))
		return true;
	for (int i = 0; i < act->writes; i++)
		if (term_reads(acts, term, act->write[i]))
			return true;
	for (int i = 0; i < act->args; i++) {
		const struct act_arg *arg = &act->arg[i];

		if (arg->value)
			continue;
		if (arg->place ? term_reads(acts, term, arg->place) :
				 reads_temp(acts, term, arg->temp))
			return true;
	}
	return false;
}

void term_count(struct acts *acts, const struct term *term)
{
	term = term_plain(acts, term);
	if (term->kind == TERM_TEMP)
		acts->temp[term->temp].uses++;
	for (int i = 0; i < term->parts; i++)
		term_count(acts, term->part[i]);
}

int term_size(const struct acts *acts, const struct term *term)
{
	int size = 0;

	term = term_plain(acts, term);
	for (int i = 0; i < term->parts; i++)
		size += term_size(acts, term->part[i]);
	return size ? size : 1;
}

struct act *acts_add(struct acts *acts, enum act_kind kind)
{
	struct act *act = arena_push(acts->arena, &acts->act, &acts->count, sizeof(*act));

	if (!act) {
		acts->failed = true;
		act = &acts->no_act;
	}
	*act = (struct act){ .kind = kind, .temp = -1, .rung = acts->rung };
	return act;
}

int acts_temp(struct acts *acts, enum iec_type type, int rung)
{
	struct act_temp *temp = arena_push(acts->arena, &acts->temp, &acts->temps,
					   sizeof(*temp));

	if (!temp) {
		acts->failed = true;
		return -1;
	}
	*temp = (struct act_temp){ .type = type, .rung = rung };
	return acts->temps - 1;
}

static bool is_taken(struct acts *acts, uint32_t name)
{
	const struct names *names = &acts->project->names;
	const uint32_t fold = names_fold(names, name);
	const char *text = names_text(names, name);

	if (acts_meaning(acts, name) || scope_pou(acts->scope, acts->pou, name) ||
	    project_find_pou(acts->project, text, strlen(text)) >= 0 ||
	    words_find(&acts->project->words, text, strlen(text)) != WORD_COUNT)
		return true;
	for (int i = 0; i < acts->temps; i++)
		if (acts->temp[i].name && names_fold(names, acts->temp[i].name) == fold)
			return true;
	for (int i = 0; i < acts->edges; i++)
		if (names_fold(names, acts->edge[i].name) == fold)
			return true;
	return false;
}

uint32_t acts_name(struct acts *acts, const char *text)
{
	char name[LIMIT_NAME + 16];
	uint32_t id;
	int len = snprintf(name, sizeof(name), "%.*s", LIMIT_NAME - 8, text);

	id = acts_intern(acts, name, (size_t)len);
	for (int n = 2; id && is_taken(acts, id); n++) {
		len = snprintf(name, sizeof(name), "%.*s_%d", LIMIT_NAME - 8, text, n);
		id = acts_intern(acts, name, (size_t)len);
	}
	return id;
}

bool text_is_pure(const struct acts *acts, const struct token *token)
{
	const enum op op = op_find(token->text, token->len);
	const enum word word = word_find(token->text, token->len);

	if (project_find_pou(acts->project, token->text, token->len) >= 0)
		return false;
	return op != OP_COUNT || (word != WORD_COUNT && word_row(word)->kind == WORD_FN);
}

/* Whose memory may have other names: of a VAR_IN_OUT and of a REFERENCE TO that of any variable; of an address that of
 * others at addresses which programs write. */
enum shared { SHARED_NOT, SHARED_AT, SHARED_ANY };

static enum shared shared_as(struct acts *acts, const struct token *name)
{
	const struct var_table *vars = &acts->pou->vars;
	const size_t base = strcspn(name->text, ".");
	const uint32_t id = acts_intern(acts, name->text, base < name->len ? base : name->len);
	const bool named = name->kind == TOKEN_NAME;
	const struct meaning *m = named ? acts_meaning(acts, acts_intern(acts, name->text, name->len)) : NULL;
	const int at = named ? vars_find(vars, names_fold(&acts->project->names, id)) : -1;

	if ((at >= 0 && vars_flags(vars, at) & VAR_IN_OUT) || (m && m->through))
		return SHARED_ANY;
	m = named ? acts_meaning(acts, id) : NULL;
	if (name->kind == TOKEN_ADDRESS)
		return SHARED_AT;
	return m && m->addr.area != AREA_NONE && iec_area_row(m->addr.area)->access != ACCESS_READ ? SHARED_AT : SHARED_NOT;
}

bool text_may_write(struct acts *acts, const char *text, const struct token *name)
{
	const enum shared as = shared_as(acts, name);
	const char *dot = memchr(name->text, '.', name->len);
	const size_t base = dot ? (size_t)(dot - name->text) : name->len;
	bool output = false;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const struct token token = lex.token;
		struct lex next = lex;
		bool named, written;

		lex_next(&next);
		if (token.kind == TOKEN_NAME && lex_is(&next, "(") && !text_is_pure(acts, &token))
			return true;
		named = token.kind == TOKEN_NAME && token.len >= base && ascii_same(token.text, name->text, base) &&
			(token.len == base || token.text[base] == '.');
		written = output || lex_is(&next, ":=") || lex_is(&next, "?=") || lex_is(&next, "S") ||
			  lex_is(&next, "R") || lex_is(&next, "[");
		if (named && (written || lex_is(&next, "^") || lex_is(&next, "REF")))
			return true;
		if (lex_is(&lex, "^"))
			return true; /* a pointer leads anywhere */
		if (written) {
			const enum shared to = shared_as(acts, &token);

			if (to == SHARED_ANY || as == SHARED_ANY || (to == SHARED_AT && as == SHARED_AT))
				return true;
		}
		output = lex_is(&lex, "=>");
	}
	return false;
}
