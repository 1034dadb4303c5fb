/* SPDX-License-Identifier: MIT
 *
 * read_array - ARRAY[low..high] OF, and initial values: [1, 2, 3(7)], (Speed := 5).
 *
 * Bounds are integer constants, or constant expressions. Initial values are
 * kept as text: model/init.c walks it, here if it needs no constant expression and the type is
 * known, else after the whole project was read. check/ finds whether a variable with an address
 * leaves its area.
 */
#include "engine/text/reader.h"

#include "engine/base/literal.h"

#include <stdio.h>
#include <string.h>

/* Reads a bound and steps past it; r->text gets it as written. */
static bool read_bound(struct reader *r, struct var *var, enum written_place where, int64_t *out)
{
	const struct token *token = &r->lex.token;
	bool negative = reader_is(r, '-');
	struct literal literal;

	buffer_clear(&r->text);
	if (reader_begins_expression(r, IEC_DINT))
		return reader_expression(r, var, where);
	if (negative || reader_is(r, '+'))
		reader_step(r);
	if (negative)
		buffer_add(r, &r->text, "-", 1);
	if (token->kind != TOKEN_NUMBER ||
	    literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
	    literal.real || literal.high ||
	    (literal.type != IEC_NONE && !(iec_type_row(literal.type)->class & ANY_INT)) ||
	    literal.value.i > INT32_MAX || literal.value.i < INT32_MIN)
		return reader_fail_token(r, DIAG_BAD_BOUNDS);
	*out = negative ? -literal.value.i : literal.value.i;
	buffer_add(r, &r->text, token->text, token->len);
	reader_step(r);
	return true;
}

/* `..` is two symbols for the scanner. */
bool reader_dots(struct reader *r)
{
	for (int i = 0; i < 2; i++) {
		if (!reader_is(r, '.'))
			return reader_fail_word(r, DIAG_EXPECTED, "..");
		reader_step(r);
	}
	return true;
}

/* The dimensions of the array that is read. */
struct dimensions {
	struct var_array dim[LIMIT_INDICES];
	uint32_t text[LIMIT_INDICES][2]; /* string ids: as written           */
	int count;
};

static bool fail_bounds(struct reader *r, int64_t low, int64_t high)
{
	char text[48];

	snprintf(text, sizeof(text), "%lld..%lld", (long long)low, (long long)high);
	return reader_fail_word(r, DIAG_BAD_BOUNDS, text);
}

/* `*`: the bounds are those of the argument. */
static bool read_any_bounds(struct reader *r, struct var *var, struct dimensions *out)
{
	const uint16_t places = !r->pou || r->members ? 0 : r->pou->kind == POU_FUNCTION ? VAR_INPUT | VAR_IN_OUT :
				r->pou->kind == POU_BLOCK ? VAR_IN_OUT : 0;

	if (!(r->var_flags & places) ||
	    (out->count > 0 && !var->any_bounds))
		return reader_fail_token(r, DIAG_ANY_BOUNDS);
	var->any_bounds = true;
	out->dim[out->count++] = (struct var_array){ 0, 1 };
	reader_step(r);
	return true;
}

/* `1..10` */
static bool read_dimension(struct reader *r, struct var *var, struct dimensions *out)
{
	int64_t low = 0, high = 0;
	uint32_t *text = out->text[out->count];

	if (out->count == LIMIT_INDICES)
		return reader_fail_many(r, DIAG_TOO_MANY, "dimensions", LIMIT_INDICES);
	if (reader_is(r, '*') || var->any_bounds)
		return read_any_bounds(r, var, out);
	if (!read_bound(r, var, WRITTEN_LOW, &low))
		return false;
	text[0] = buffer_take(r, &r->text);
	if (!reader_dots(r) || !read_bound(r, var, WRITTEN_HIGH, &high))
		return false;
	text[1] = buffer_take(r, &r->text);
	if (var->written)
		low = high = 0; /* until check/settle.c computes them */
	if (high < low || high - low >= LIMIT_ELEMENTS)
		return fail_bounds(r, low, high);
	out->dim[out->count++] = (struct var_array){ (int32_t)low, (uint32_t)(high - low + 1) };
	return true;
}

/* `[0..2, 1..3] OF` */
static bool read_dimensions(struct reader *r, struct var *var, struct dimensions *out)
{
	if (!reader_is(r, '['))
		return reader_fail_word(r, DIAG_EXPECTED, "[");
	do {
		reader_step(r);
		if (!read_dimension(r, var, out))
			return false;
	} while (reader_is(r, ','));
	if (!reader_is(r, ']'))
		return reader_fail_word(r, DIAG_EXPECTED, "]");
	reader_step(r);
	if (!lex_is(&r->lex, "OF"))
		return reader_fail_word(r, DIAG_EXPECTED, "OF");
	reader_step(r);
	return true;
}

/* Gives @var the dimensions that were read. */
static bool keep_dimensions(struct reader *r, struct var *var, const struct dimensions *from)
{
	const size_t count = (size_t)from->count;

	var->dim = arena_alloc(&r->project->arena, count * sizeof(*from->dim));
	if (!var->dim)
		return r->no_memory = true, false;
	memcpy(var->dim, from->dim, count * sizeof(*from->dim));
	if (var->written && count > 1) {
		var->written->dim = arena_alloc(&r->project->arena, count * sizeof(from->text[0]));
		if (!var->written->dim)
			return r->no_memory = true, false;
		memcpy(var->written->dim, from->text, count * sizeof(from->text[0]));
	} else if (var->written) {
		var->written->bound[0] = from->text[0][0];
		var->written->bound[1] = from->text[0][1];
	}
	var->dims = var->own_dims = (uint8_t)count;
	var->array = vars_flat(var->dim, from->count);
	return true;
}

bool read_array(struct reader *r, struct var *var)
{
	struct dimensions dims = { .count = 0 };
	struct var_array all;

	if (!lex_is(&r->lex, "ARRAY"))
		return true;
	while (lex_is(&r->lex, "ARRAY")) {
		reader_step(r);
		if (!read_dimensions(r, var, &dims))
			return false;
	}
	all = vars_flat(dims.dim, dims.count);
	if (all.count > LIMIT_ELEMENTS)
		return fail_bounds(r, 0, (int64_t)all.count - 1);
	return keep_dimensions(r, var, &dims);
}

/* ---- initial values ---- */

#define BRACKETS 64 /* inside one another */

static bool opens(const struct token *token)
{
	return token->len == 1 && (*token->text == '(' || *token->text == '[');
}

static bool closes(const struct token *token)
{
	return token->len == 1 && (*token->text == ')' || *token->text == ']');
}

static bool is_symbol(const struct token *token, const char *symbol)
{
	return token->kind == TOKEN_SYMBOL && token->len == strlen(symbol) &&
	       memcmp(token->text, symbol, token->len) == 0;
}

/* A token behind which a value begins, so that a - there is a sign; @token NULL: the start. */
static bool is_before_value(const struct token *token)
{
	return !token || opens(token) || is_symbol(token, ",") || is_symbol(token, ":=");
}

/* Is the token, behind @before, more than the form of constants needs? @next follows it. */
static bool is_of_expression(const struct lex *lex, const struct token *before,
			     const struct token *next)
{
	static const char *const operators[] = { "*", "/", "&", "<", ">", "=", "<=", ">=", "<>", "." };
	const struct token *token = &lex->token;

	for (size_t i = 0; i < sizeof(operators) / sizeof(*operators); i++)
		if (is_symbol(token, operators[i]))
			return true;
	if (is_symbol(token, "-") || is_symbol(token, "+"))
		return !is_before_value(before);
	if (is_symbol(token, "(")) /* not of a structure, and not n( */
		return next->kind == TOKEN_NUMBER && before && before->kind != TOKEN_NUMBER;
	if (literal_is_named(token->text, token->len))
		return true;
	return token->kind == TOKEN_NAME && !is_symbol(next, ":=") && !lex_is(lex, "TRUE") &&
	       !lex_is(lex, "FALSE");
}

/* Have the values in the brackets at the cursor an expression? @bare: without brackets. */
static bool has_expressions(const struct reader *r, bool bare)
{
	struct token before = { .kind = TOKEN_END };
	struct lex lex = r->lex;
	int open = 0;

	lex.newlines = lex.comments = false;
	do {
		struct lex ahead = lex;

		lex_next(&ahead);
		if (is_of_expression(&lex, before.text ? &before : NULL, &ahead.token))
			return true;
		open += opens(&lex.token);
		open -= closes(&lex.token);
		before = lex.token;
		lex = ahead;
	} while ((bare || open > 0) && lex.token.kind != TOKEN_END && !lex_is(&lex, ";"));
	return false;
}

/* Appends the token under the cursor in its canonical form; @before NULL: it is the first.
 * @sign: a sign stands before it. */
static void add_part(struct reader *r, const struct token *before, bool sign)
{
	const struct token *token = &r->lex.token;
	const bool apart = before && (token->space_before || token->line != before->line);

	if (lex_is(&r->lex, ":=")) {
		buffer_add(r, &r->text, " := ", 4);
		return;
	}
	if (reader_is(r, ',')) {
		buffer_add(r, &r->text, ", ", 2);
		return;
	}
	if (apart && !sign && !closes(token) && !is_before_value(before) &&
	    !(opens(token) && before->kind == TOKEN_NUMBER) && !is_symbol(token, ".") &&
	    !is_symbol(before, "."))
		buffer_add(r, &r->text, " ", 1);
	buffer_add(r, &r->text, token->text, token->len);
}

static bool is_part(const struct reader *r)
{
	static const char *const symbols[] = { "(", ")", "[", "]", ",", "-", "+", ":=", "*", "/",
					       "&", "<", ">", "=", "<=", ">=", "<>", "." };

	if (r->lex.token.kind == TOKEN_NAME || r->lex.token.kind == TOKEN_NUMBER)
		return true;
	for (size_t i = 0; i < sizeof(symbols) / sizeof(*symbols); i++)
		if (lex_is(&r->lex, symbols[i]))
			return true;
	return false;
}

/* The sign that closes the innermost bracket; bit 0 of @open: it is a [. */
static const char *closing(uint64_t open, int depth)
{
	return !(open & 1) ? ")" : depth == 1 ? ", or ]" : "]";
}

/* Counts the brackets @open of which @depth are open; one that does not fit is an error. */
static bool count_bracket(struct reader *r, uint64_t *open, int *depth)
{
	const struct token *token = &r->lex.token;

	if (opens(token)) {
		if (++*depth > BRACKETS)
			return reader_fail_word(r, DIAG_TOO_DEEP, "");
		*open = *open << 1 | (*token->text == '[');
	} else if (closes(token)) {
		if ((*open & 1) != (*token->text == ']'))
			return reader_fail_word(r, DIAG_EXPECTED, closing(*open, *depth));
		*open >>= 1;
		--*depth;
	}
	return true;
}

bool reader_init_text(struct reader *r, struct var *var)
{
	/* Old tools write the list of an array without brackets. */
	const bool bare = !reader_is(r, '(') && !reader_is(r, '[');

	const struct token *token = &r->lex.token;
	struct token before = { .kind = TOKEN_END };
	uint64_t open = bare, named = 0;
	bool sign = false;
	int depth = bare;

	if (has_expressions(r, bare) || var->written) {
		struct var_written *written = reader_written(r, var, WRITTEN_INITIAL);

		if (!written)
			return false;
		written->initial = true;
	}
	buffer_clear(&r->text);
	if (bare)
		buffer_add(r, &r->text, "[", 1);
	do {
		const struct token *last = before.text ? &before : NULL;

		if (!is_part(r))
			return reader_fail_word(r, DIAG_EXPECTED,
						reader_is(r, ';') ? closing(open, depth) :
						"initial value");
		named = opens(token) ? named << 1 : closes(token) ? named >> 1 :
			named | lex_is(&r->lex, ":=");
		/* (Speed := 1,5): a member has a name. */
		if (named & 1 && token->kind == TOKEN_NUMBER && !token->space_before && last &&
		    is_symbol(last, ",") && !last->space_before)
			return reader_fail_word(r, DIAG_EXPECTED, "name of a member");
		if (!count_bracket(r, &open, &depth))
			return false;
		if (bare && depth == 0) /* its ] was not opened */
			return reader_fail_word(r, DIAG_EXPECTED, ";");
		add_part(r, last, sign);
		sign = (is_symbol(token, "-") || is_symbol(token, "+")) && is_before_value(last);
		before = *token;
		reader_step(r);
	} while (bare ? depth > 1 || !reader_is(r, ';') : depth > 0);
	if (bare)
		buffer_add(r, &r->text, "]", 1);
	var->has_init = true;
	var->init_text = buffer_take(r, &r->text);
	return true;
}

/* Reports why the walk over var->init_text failed, at the same token of the text that began at
 * @start. */
static bool fail_walk(struct reader *r, const struct var *var, const struct lex *start)
{
	const struct init_walk *walk = &r->walk;
	const struct lex behind = r->lex;
	const char *text = project_text(r->project, var->init_text);
	/* An argument is a part of the text, or the name of what is expected. */
	const char *at = walk->arg >= text &&
			 walk->arg < text + names_len(&r->project->names, var->init_text) ?
			 walk->arg : walk->lex.token.text;
	char said[LIMIT_ARG];
	struct lex lex;

	lex_init(&lex, text, names_len(&r->project->names, var->init_text));
	lex.wide = true;
	r->lex = *start;
	r->lex.newlines = r->lex.comments = false;
	while (lex_next(&lex) != TOKEN_END && lex.token.text < at)
		lex_next(&r->lex);
	init_say(walk, said, sizeof(said));
	if (walk->why != DIAG_SIGN_MISSING && walk->why != DIAG_EXPECTED)
		reader_fail_word(r, walk->why, said);
	else
		reader_fail_word(r, DIAG_EXPECTED, strcmp(said, "]") == 0 ? ", or ]" : said);
	r->lex = behind;
	return false;
}

bool read_init_list(struct reader *r, struct var *var)
{
	const struct lex start = r->lex;
	struct init_value value;
	uint32_t next = 0;

	if (!reader_init_text(r, var))
		return false;
	if (var->written) /* check/settle.c walks it */
		return true;
	init_begin(&r->walk, r->project, var, &r->project->arena);
	while (init_next(&r->walk, &value))
		if (!init_keep(&r->walk, r->project, var, &value, &next))
			return r->no_memory = true, false;
	return r->walk.why == DIAG_COUNT || fail_walk(r, var, &start);
}

bool read_init_parts(struct reader *r, struct var *var)
{
	const char first = var->array.count ? '[' : '(';

	if (!reader_is(r, first))
		return reader_fail(r, DIAG_EXPECTED, &first, 1);
	return reader_init_text(r, var);
}
