/* SPDX-License-Identifier: MIT
 *
 * read_vars - VAR … END_VAR: names, addresses, types, initial values.
 *
 * A constant must fit its type here; check/ finds duplicate names, and addresses that do
 * not fit their type. Constant expressions are kept as text: check/settle.c computes them.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/model/named.h"

#include <stdio.h>
#include <string.h>

static bool add_var(struct reader *r, struct var_table *table, uint32_t name)
{
	if (r->project->globals.count == LIMIT_VARS ||
	    table->count == LIMIT_VARS)
		return reader_fail_many(r, DIAG_TOO_MANY, "variables", LIMIT_VARS);
	struct var *var = arena_push(&r->project->arena, &table->var,
				     &table->count, sizeof(*var));

	if (!var) {
		r->no_memory = true;
		return false;
	}
	*var = (struct var){ .name = name, .line = r->lex.token.line };
	var->fold = names_fold(&r->project->names, name);
	return true;
}

static bool add_name(struct reader *r, struct var_table *table)
{
	const struct token word = r->lex.token;
	uint32_t name = 0;

	if (r->paths && word.kind == TOKEN_NAME && (memchr(word.text, '.', word.len) || reader_peek(r, "["))) {
		buffer_clear(&r->text);
		if (!reader_value(r, false, &word))
			return false;
		name = buffer_take(r, &r->text);
	} else if (!reader_name(r, "name of a variable", &name)) {
		return false;
	}
	if (!add_var(r, table, name))
		return false;
	reader_step(r);
	return true;
}

static bool read_names(struct reader *r, struct var_table *table)
{
	if (!add_name(r, table))
		return false;
	while (reader_is(r, ',')) {
		reader_step(r);
		if (!add_name(r, table))
			return false;
	}
	return true;
}

/* %I*, %QX*: an address that somebody else gives. Here the variable is one without address. */
static bool is_open_address(struct lex lex)
{
	const struct token at = lex.token;

	return at.kind == TOKEN_ADDRESS && at.len >= 2 && at.len <= 3 &&
	       strchr("IQM", ascii_upper(at.text[1])) && lex_next(&lex) == TOKEN_SYMBOL &&
	       lex_is(&lex, "*") && !lex.token.space_before;
}

/* `%IX1.2.3`: rack, module and channel, which the vendor of another controller numbers. */
static bool is_hierarchical(const struct token *token)
{
	int dots = 0;

	for (size_t i = 1; i < token->len; i++)
		dots += token->text[i] == '.' && ascii_digit(token->text[i - 1]) && i + 1 < token->len &&
			ascii_digit(token->text[i + 1]);
	return token->kind == TOKEN_ADDRESS && dots > 1;
}

static bool read_at(struct reader *r, struct var *var)
{
	const struct token *token = &r->lex.token;
	enum diag_id why;
	char text[32];

	if (!lex_is(&r->lex, "AT"))
		return true;
	reader_step(r);
	if (is_open_address(r->lex)) {
		var->at_text = reader_intern(r, token->text, token->len + 1);
		reader_step(r);
		reader_step(r);
		return true;
	}
	if (token->kind != TOKEN_ADDRESS && token->kind != TOKEN_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "address");
	why = iec_addr_fault(token->text, token->len, &var->at);
	if (why == DIAG_NOT_ADDRESS && token->kind != TOKEN_ADDRESS)
		return reader_fail_word(r, DIAG_EXPECTED, "address");
	if (why == DIAG_NOT_ADDRESS && is_hierarchical(token)) {
		if (!r->plain || !strchr("IQM", ascii_upper(token->text[1])))
			return reader_fail_token(r, DIAG_HIERARCHICAL);
		reader_fail_token(r, DIAG_OPEN_HIERARCHICAL);
		var->at_text = reader_intern(r, token->text, token->len);
		reader_step(r);
		return true;
	}
	if (why != DIAG_COUNT)
		return reader_fail_token(r, why);
	int len = iec_addr_print(var->at, text, sizeof(text));

	var->at_text = reader_intern(r, text, (size_t)len);
	reader_step(r);
	return true;
}

/* ---- constant expressions ---- */

/* Is a variable of this name declared above? */
static bool is_declared(const struct reader *r, const struct token *token)
{
	struct names *names = &r->project->names;
	const uint32_t fold = names_fold(names, names_intern(names, token->text, token->len));

	return (r->pou && vars_find(&r->pou->vars, fold) >= 0) ||
	       vars_find(&r->project->globals, fold) >= 0;
}

bool reader_begins_expression(const struct reader *r, enum iec_type type)
{
	static const char *const words[] = { "ON", "OFF", "YES", "NO" };
	struct lex lex = r->lex;

	lex.newlines = lex.comments = false;
	for (size_t i = 0; type == IEC_BOOL && i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&lex, words[i]) && !is_declared(r, &lex.token))
			return false;
	return expr_begins(lex);
}

struct var_written *reader_written(struct reader *r, struct var *var, enum written_place where)
{
	if (!var->written)
		var->written = arena_alloc(&r->project->arena, sizeof(*var->written));
	if (!var->written) {
		r->no_memory = true;
		return NULL;
	}
	var->written->file = r->place.file;
	var->written->at[where].line = r->lex.token.line;
	var->written->at[where].column = r->lex.token.column;
	return var->written;
}

/* Is there no blank between two tokens of an expression, however it was written? */
static bool is_tight(const struct token *before, const struct token *token)
{
	return *before->text == '(' || *before->text == '[' || *before->text == '.' ||
	       *token->text == ')' || *token->text == ']' || *token->text == ',' ||
	       *token->text == '.';
}

/* Appends the tokens up to the one at @end. */
static void add_tokens(struct reader *r, const char *end)
{
	const struct token *token = &r->lex.token;

	while (token->text < end && token->kind != TOKEN_END && !r->no_memory) {
		const struct token before = *token;

		buffer_add(r, &r->text, token->text, token->len);
		reader_step(r);
		if (token->text < end && !is_tight(&before, token) &&
		    (token->space_before || token->line != before.line))
			buffer_add(r, &r->text, " ", 1);
	}
}

bool reader_expression_text(struct reader *r)
{
	struct diag place = r->place;
	struct lex lex = r->lex;

	lex.newlines = lex.comments = false;
	place.id = DIAG_BAD_EXPRESSION;
	place.line = lex.token.line;
	if (!expr_parse(&lex, &r->expr, r->diags, place))
		return false;
	if (expr_has_wrong_call(&r->expr, &r->project->words) && reader_mend(r, DIAG_BAD_LITERAL))
		return false;
	add_tokens(r, lex.token.text);
	return !r->no_memory;
}

bool reader_expression(struct reader *r, struct var *var, enum written_place where)
{
	return reader_written(r, var, where) && reader_expression_text(r);
}

/* STRING[20]; without a number the usual capacity. */
static bool read_capacity(struct reader *r, struct var *var)
{
	const struct token *token = &r->lex.token;
	struct literal literal;

	var->capacity = IEC_STRING_DEFAULT;
	if (var->at.area != AREA_NONE)
		return reader_fail_word(r, DIAG_MISPLACED, "AT");
	if (!reader_is(r, '[') && !reader_is(r, '('))
		return true;
	const char close = reader_is(r, '[') ? ']' : ')';

	reader_step(r);
	if (reader_begins_expression(r, IEC_DINT)) {
		buffer_clear(&r->text);
		if (!reader_expression(r, var, WRITTEN_CAPACITY))
			return false;
		var->written->capacity = buffer_take(r, &r->text);
	} else {
		if (literal_parse(token->text, token->len, &literal) != LITERAL_OK ||
		    literal.type != IEC_NONE || literal.real)
			return reader_fail_word(r, DIAG_EXPECTED, "number of bytes");
		if (literal.high || literal.value.i < 1 ||
		    literal.value.i > IEC_STRING_MOST)
			return reader_fail_token(r, DIAG_LITERAL_RANGE);
		var->capacity = (uint16_t)literal.value.i;
		reader_step(r);
	}
	if (!reader_is(r, close))
		return reader_fail(r, DIAG_EXPECTED, &close, 1);
	reader_step(r);
	return true;
}

/* Do the last elements lie beyond the end of the area? */
static bool leaves_area(const struct var *var)
{
	uint64_t bits = var->at.byte * (uint64_t)8 + var->at.bit +
			(uint64_t)var->at.bits * var->array.count;

	return bits > iec_area_row(var->at.area)->most * (uint64_t)8;
}

bool reader_type(struct reader *r, struct var *var)
{
	if (!reader_is(r, ':'))
		return reader_fail_word(r, DIAG_EXPECTED, ":");
	reader_step(r);
	return reader_type_of(r, var, 0);
}

/* The type at the cursor has a name of its own, and is no structure. */
static bool is_named(struct reader *r, struct var *var)
{
	struct names *names = &r->project->names;
	const char *text = r->lex.token.text;
	size_t len = r->lex.token.len;

	words_strip(&r->project->words, &text, &len);
	var->named = (uint16_t)(named_find(r->project, names_fold(names, names_intern(names, text, len))) + 1);
	return var->named;
}

/* POINTER TO T, REF_TO T: T is a value, a structure, or an array of values. */
static bool read_pointer(struct reader *r, struct var *var)
{
	struct var *to = arena_alloc(&r->project->arena, sizeof(*to));
	struct var_target *target = arena_alloc(&r->project->arena, sizeof(*target));
	const struct token at = r->lex.token;
	const bool joined = lex_is(&r->lex, "REFERENCE_TO");
	const enum var_pointer word = lex_is(&r->lex, "REF_TO") ? REF_TO :
				      joined || lex_is(&r->lex, "REFERENCE") ? REFERENCE_TO : POINTER_TO;
	bool list;

	if (var->at.area != AREA_NONE)
		return reader_fail_token(r, DIAG_MISPLACED);
	reader_step(r);
	if (word != REF_TO && !joined && !lex_is(&r->lex, "TO"))
		return reader_fail_word(r, DIAG_EXPECTED, "TO");
	if (word != REF_TO && !joined)
		reader_step(r);
	list = lex_is(&r->lex, "ARRAY");
	if (!to || !target)
		return !(r->no_memory = true);
	to->line = var->line;
	if (!reader_type_of(r, to, 0))
		return false;
	if (to->target && to->target->word == REFERENCE_TO)
		return reader_fail(r, DIAG_POINTER_TYPE, at.text, at.len);
	*target = (struct var_target){ .word = word, .type = to->type, .list = list, .low = to->array.low,
				       .like = to };
	var->target = target;
	var->type = IEC_LWORD;
	return !r->no_memory;
}

static bool is_wide_text(const struct reader *r)
{
	return ascii_is("WSTRING", r->lex.token.text, r->lex.token.len);
}

/* CHAR and WCHAR: a text of one letter. False: none stands here. */
static bool read_letter(struct reader *r, struct var *var)
{
	const bool wide = ascii_is("WCHAR", r->lex.token.text, r->lex.token.len);

	if ((!wide && !ascii_is("CHAR", r->lex.token.text, r->lex.token.len)) || is_named(r, var))
		return false;
	if (wide)
		reader_fail_word(r, DIAG_WIDE_TEXT, "");
	var->type = IEC_STRING;
	var->letter = true;
	var->wide = wide;
	var->capacity = wide ? 4 : 1; /* bytes of UTF-8 */
	reader_step(r);
	return true;
}

/* The integers of other tools that are as wide as an address. */
static enum iec_type type_of_address(const struct reader *r)
{
	return !r->plain ? IEC_NONE : lex_is(&r->lex, "__XWORD") ? IEC_LWORD :
	       lex_is(&r->lex, "__UXINT") ? IEC_ULINT : lex_is(&r->lex, "__XINT") ? IEC_LINT : IEC_NONE;
}

bool reader_type_of(struct reader *r, struct var *var, uint32_t name)
{
	const struct token *token = &r->lex.token;
	enum word_kind kind;

	if (!read_array(r, var))
		return false;
	if (lex_is(&r->lex, "POINTER") || lex_is(&r->lex, "REF_TO") || lex_is(&r->lex, "REFERENCE") ||
	    (r->plain && lex_is(&r->lex, "REFERENCE_TO")))
		return read_pointer(r, var);
	if (reader_is(r, '('))
		return reader_own_type(r, var, name);
	if (lex_is(&r->lex, "STRUCT") || (lex_is(&r->lex, "UNION") && !is_named(r, var)))
		return reader_inner_struct(r, var);
	if (token->kind != TOKEN_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "type");
	var->type = iec_type_find(token->text, token->len);
	if (var->type == IEC_NONE)
		var->type = type_of_address(r);
	if (r->plain && read_letter(r, var))
		return true;
	if (r->plain && is_wide_text(r)) {
		reader_fail_word(r, DIAG_WIDE_TEXT, "");
		var->type = IEC_STRING;
		var->wide = true;
	}
	if (var->type == IEC_NONE) {
		var->fb = words_find_type(&r->project->words, token->text, token->len);
		kind = words_row(&r->project->words, var->fb)->kind;
		if ((var->fb == WORD_COUNT || (kind != WORD_FB && kind != WORD_STRUCT)) &&
		    is_named(r, var)) {
			var->fb = (enum word)0;
			reader_step(r);
			return true;
		}
		if (ascii_is("WCHAR", token->text, token->len) || is_wide_text(r))
			return reader_fail_token(r, DIAG_NO_WIDE_TEXT);
		if (var->fb == WORD_COUNT ||
		    (kind != WORD_FB && kind != WORD_STRUCT))
			return reader_fail_token(r, DIAG_BAD_TYPE);
		if (kind == WORD_FB && r->pou && r->pou->kind == POU_FUNCTION && !r->pou->vars.block_count)
			return reader_fail_token(r, DIAG_MISPLACED); /* the result is a value */
		if (var->at.area != AREA_NONE && kind != WORD_STRUCT)
			return reader_fail_word(r, DIAG_MISPLACED, "AT");
	}
	if (var->array.count && var->at.area != AREA_NONE && leaves_area(var))
		return reader_fail_word(r, DIAG_BAD_ADDRESS,
					names_text(&r->project->names,
						   var->at_text));
	reader_step(r);
	if (var->type == IEC_STRING)
		return read_capacity(r, var);
	return reader_own_type(r, var, name);
}

/* Is the constant only too large? Then its kind is right. */
static bool is_kind(const struct literal *literal, enum iec_type type)
{
	if (literal->type != IEC_NONE)
		return literal->type == type;
	return !(iec_type_row(type)->class & (CLASS_TIME | ANY_DATE | CLASS_STRING)) &&
	       !literal->real;
}

/* A number that fits, though that of its type may not: DINT#5 in an INT, LREAL#0.5 in a REAL. */
static bool fits_untyped(struct literal literal, enum iec_type type, union iec_value *out)
{
	if (!(iec_type_row(literal.type)->class & ANY_NUM) || !(iec_type_row(type)->class & ANY_NUM))
		return false;
	literal.real |= iec_type_row(literal.type)->class == CLASS_REAL;
	literal.type = IEC_NONE;
	return literal_fit(&literal, type, out);
}

static bool check_constant(struct reader *r, enum iec_type type,
			   const char *text, size_t len, union iec_value *out)
{
	struct literal literal;
	bool kind = true;

	switch (literal_parse(text, len, &literal)) {
	case LITERAL_OK:
		if (literal_fit(&literal, type, out) || (r->plain && fits_untyped(literal, type, out)))
			return true;
		kind = is_kind(&literal, type);
		break;
	case LITERAL_RANGE:
		break;
	case LITERAL_NONE:
	case LITERAL_BAD:
		kind = false;
		break;
	}
	return kind ? reader_fail_range(r, text, len) : reader_fail(r, DIAG_BAD_LITERAL, text, len);
}

bool read_constant(struct reader *r, enum iec_type type, union iec_value *out)
{
	const struct token *token = &r->lex.token;
	const size_t from = r->text.len;

	reader_sign(r);
	if (token->kind != TOKEN_NUMBER && token->kind != TOKEN_NAME)
		return reader_fail_word(r, DIAG_EXPECTED, "constant");
	buffer_add(r, &r->text, token->text, token->len);
	if (r->no_memory || !check_constant(r, type, r->text.text + from,
					    r->text.len - from, out))
		return false;
	reader_step(r);
	return true;
}

/* The initial value of a named type: check/settle.c computes it when the type is known. */
static bool init_named(struct reader *r, struct var *var)
{
	struct var_written *written = reader_written(r, var, WRITTEN_INITIAL);

	if (!written)
		return false;
	written->initial = true;
	if (reader_is(r, '(') || reader_is(r, '['))
		return reader_init_text(r, var);
	buffer_clear(&r->text);
	if (!reader_expression(r, var, WRITTEN_INITIAL))
		return false;
	var->has_init = true;
	var->init_text = buffer_take(r, &r->text);
	return true;
}

/* The initial value of a pointer: NULL, REF(Name), ADR(Name). */
static bool init_pointer(struct reader *r, struct var *var)
{
	const bool null = lex_is(&r->lex, "NULL");
	uint32_t path = 0;
	char text[LIMIT_NAME + 2];

	if (!null && !lex_is(&r->lex, "REF") && !lex_is(&r->lex, "ADR"))
		return reader_fail_word(r, DIAG_EXPECTED, "NULL or REF(Name)");
	var->has_init = true;
	var->init_text = reader_intern(r, r->lex.token.text, r->lex.token.len);
	reader_step(r);
	if (null)
		return true;
	if (!reader_is(r, '('))
		return reader_fail_word(r, DIAG_EXPECTED, "(");
	reader_step(r);
	buffer_clear(&r->text);
	while (!reader_is(r, ')') && !reader_is(r, ';') && r->lex.token.kind != TOKEN_END) {
		buffer_add(r, &r->text, r->lex.token.text, r->lex.token.len);
		reader_step(r);
	}
	if (!reader_is(r, ')'))
		return reader_fail_word(r, DIAG_EXPECTED, ")");
	reader_step(r);
	path = buffer_take(r, &r->text);
	var->points = arena_alloc(&r->project->arena, sizeof(*var->points));
	if (!var->points || names_len(&r->project->names, path) >= LIMIT_NAME)
		return reader_fail_word(r, DIAG_NAME_TOO_LONG, "");
	snprintf(text, sizeof(text), "&%s", names_text(&r->project->names, path));
	*var->points = (struct var_points){ .pou = r->pou ? (int)(r->pou - r->project->pou) : -1,
					    .text = reader_intern(r, text, strlen(text)) };
	buffer_add(r, &r->text, "REF(", 4);
	buffer_add(r, &r->text, text + 1, strlen(text + 1));
	buffer_add(r, &r->text, ")", 1);
	var->init_text = buffer_take(r, &r->text);
	return !r->no_memory;
}

bool reader_init(struct reader *r, struct var *var)
{
	if (!lex_is(&r->lex, ":="))
		return true;
	reader_step(r);
	if (var->target && !var->array.count)
		return init_pointer(r, var);
	if (var->named)
		return init_named(r, var);
	if (var->type == IEC_NONE)
		return read_init_parts(r, var);
	if (var->array.count)
		return read_init_list(r, var);
	buffer_clear(&r->text);
	if (reader_begins_expression(r, var->type)) {
		if (!reader_expression(r, var, WRITTEN_INITIAL))
			return false;
		var->written->initial = true;
	} else if (!read_constant(r, var->type, &var->init)) {
		return false;
	}
	var->has_init = true;
	var->init_text = buffer_take(r, &r->text);
	return true;
}

/* A second name of a declaration has its own record of it. */
static bool repeat_written(struct reader *r, struct var *var)
{
	struct var_written *own = arena_alloc(&r->project->arena, sizeof(*own));

	if (!own)
		return r->no_memory = true, false;
	*own = *var->written;
	own->again = true;
	var->written = own;
	return true;
}

/* R_EDGE, F_EDGE behind the type of an input. */
static bool read_edge(struct reader *r, struct var *var)
{
	const bool rising = lex_is(&r->lex, "R_EDGE");

	if (!rising && !lex_is(&r->lex, "F_EDGE"))
		return true;
	if (!(r->var_flags & VAR_INPUT) || !r->pou || r->pou->kind != POU_BLOCK || var->type != IEC_BOOL || var->array.count)
		return reader_fail_token(r, DIAG_MISPLACED);
	var->edge = rising ? 1 : 2;
	reader_step(r);
	return true;
}

/* AT %QW1 : WORD := 5; says what the address has in the beginning. */
static bool is_nameless(struct lex lex)
{
	return lex_is(&lex, "AT") && lex_next(&lex) == TOKEN_ADDRESS && !is_open_address(lex);
}

/* May no address stand here? One in a FUNCTION_BLOCK is the same for all its instances. */
static bool lacks_address(const struct reader *r)
{
	const uint16_t given = VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT | VAR_TEMP | VAR_EXTERNAL;

	return r->members || (r->pou && pou_has_frame(r->pou) &&
			      (r->pou->kind != POU_BLOCK || r->var_flags & given));
}

static bool read_declaration(struct reader *r, struct var_table *table)
{
	const int first = table->count;
	const bool nameless = is_nameless(r->lex);
	struct var like = { 0 };

	if (nameless ? !read_at(r, &like) || !add_var(r, table, like.at_text) : !read_names(r, table))
		return false;
	const bool many = table->count - first > 1 || lacks_address(r);

	if (many && lex_is(&r->lex, "AT")) {
		struct lex ahead = r->lex;

		lex_next(&ahead);
		if (r->members && !is_open_address(ahead))
			return reader_fail_word(r, DIAG_MEMBER_PLACE, names_text(&r->project->names,
										 table->var[first].name));
		if (!is_open_address(ahead))
			return reader_fail_token(r, DIAG_MISPLACED);
	}
	if (nameless && many)
		return reader_fail_word(r, DIAG_MISPLACED, "AT");
	if ((!nameless && !read_at(r, &like)) || !reader_type(r, &like) || !read_edge(r, &like) || !reader_init(r, &like))
		return false;
	const bool closed = reader_is(r, ';');
	const bool next = !closed && r->lex.token.line > r->begun;
	const bool last = r->plain && (lex_is(&r->lex, "END_VAR") || (r->members && reader_ends_struct(r)));

	if (!closed && last)
		reader_fail_token(r, DIAG_LAST_MARK);
	else if (!closed && !reader_fail_word(r, DIAG_EXPECTED, ";") && !next)
		return false;
	for (int i = first; i < table->count; i++) {
		like.name = table->var[i].name;
		like.fold = table->var[i].fold;
		like.line = table->var[i].line;
		table->var[i] = like;
		if (i > first && like.written && !repeat_written(r, &table->var[i]))
			return false;
	}
	/* A comment on the same line belongs to this declaration. */
	if (closed)
		reader_next(r);
	table->var[table->count - 1].comment = buffer_take(r, &r->note);
	return true;
}

bool reader_ends_struct(const struct reader *r)
{
	return lex_is(&r->lex, "END_STRUCT") || lex_is(&r->lex, "END_UNION");
}

void reader_skip_declaration(struct reader *r)
{
	while (!reader_at_end(r) && !lex_is(&r->lex, "END_VAR") &&
	       !(r->members && reader_ends_struct(r))) {
		bool last = reader_is(r, ';');

		reader_next(r);
		if (last)
			return;
	}
}

static void read_declarations(struct reader *r, struct var_table *table)
{
	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || r->no_memory ||
		    lex_is(&r->lex, "END_VAR") || read_ends_block(r) ||
		    (r->members && reader_ends_struct(r)))
			return;
		r->across_lines = true;
		r->begun = r->lex.token.line;
		bool good = read_declaration(r, table);

		r->across_lines = false;
		if (!good && r->closed && r->lex.token.line != r->mended)
			return;
		if (!good)
			reader_skip_declaration(r);
		if (r->closed)
			return;
	}
}

/* The words that may follow a heading. */
static uint16_t may_be(uint16_t head)
{
	if (head & (VAR_IN_OUT | VAR_TEMP))
		return 0;
	if (head & VAR_EXTERNAL)
		return VAR_CONSTANT;
	return VAR_RETAIN | VAR_NON_RETAIN |
	       (head & VAR_INPUT ? VAR_FIXED : head & VAR_OUTPUT ? 0 : VAR_CONSTANT);
}

/* The flag of a heading at the cursor; -1: there is none. */
static int find_head(const struct reader *r)
{
	static const uint16_t flags[] = {
		0, VAR_GLOBAL_WORD, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR_TEMP, VAR_EXTERNAL,
	};

	for (size_t i = 0; i < sizeof(flags) / sizeof(*flags); i++)
		if (lex_is(&r->lex, vars_head(flags[i])))
			return flags[i];
	return -1;
}

static bool is_access(const struct reader *r)
{
	return lex_is(&r->lex, "VAR_ACCESS");
}

bool reader_is_vars(const struct reader *r)
{
	return find_head(r) >= 0 || is_access(r);
}

/* May a block of this kind stand here? */
static bool has_place(const struct reader *r, uint16_t flag, bool global)
{
	bool callable = r->pou && pou_has_frame(r->pou);

	if (flag == VAR_GLOBAL_WORD)
		return global;
	if (flag == VAR_TEMP || flag == VAR_EXTERNAL)
		return !global;
	/* A program without a caller that gives its inputs: variables with initial values. */
	if (flag & (VAR_INPUT | VAR_OUTPUT | VAR_IN_OUT))
		return callable || (r->pou && r->pou->kind == POU_PROGRAM && !global &&
				    (r->pou->language == LANGUAGE_ST || r->pou->language == LANGUAGE_FBD ||
				     r->pou->language == LANGUAGE_IL));
	return flag == 0 || callable;
}

/* VAR PUBLIC. A name may be Public. */
static bool tell_of_objects(struct reader *r)
{
	static const char *const words[] = { "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL" };
	struct lex ahead = r->lex;

	lex_next(&ahead);
	if (lex_is(&ahead, ":") || lex_is(&ahead, ",") || lex_is(&ahead, "AT"))
		return false;
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&r->lex, words[i])) {
			reader_fail_token(r, DIAG_OBJECTS);
			return true;
		}
	return false;
}

static uint16_t read_flags(struct reader *r, bool global)
{
	const bool function = r->pou && r->pou->kind == POU_FUNCTION;
	const uint16_t head = (uint16_t)find_head(r);
	uint16_t flags = head, flag;

	if (!has_place(r, flags, global))
		reader_fail_token(r, DIAG_MISPLACED);
	for (;;) {
		reader_next(r);
		if (r->plain && tell_of_objects(r))
			continue;
		flag = lex_is(&r->lex, "RETAIN") || (r->plain && lex_is(&r->lex, "PERSISTENT")) ? VAR_RETAIN :
		       lex_is(&r->lex, "NON_RETAIN") ? VAR_NON_RETAIN :
		       !lex_is(&r->lex, "CONSTANT") ? 0 :
		       head & VAR_INPUT ? VAR_FIXED : VAR_CONSTANT;
		if (!flag)
			break;
		if (!(may_be(head) & flag) ||
		    (flag == VAR_RETAIN && function))
			reader_fail_token(r, DIAG_MISPLACED);
		flags |= flag;
	}
	if (r->library && global && !(flags & VAR_CONSTANT))
		reader_fail_word(r, DIAG_LIBRARY_VARS, "");
	return flags;
}

/* Comments after the last declaration go to it; without one, to the block, where they stand
 * @outside. */
static void keep_last_comments(struct reader *r, struct var_table *table,
			       struct var_block *block, enum comment_place outside)
{
	uint32_t *id = block->count > 0 ? &table->var[table->count - 1].comment :
					  &block->comment;

	*id = comment_join(r, *id, &r->note, block->count > 0 ? COMMENT_NOTE : outside);
}

void reader_close_vars(struct reader *r, const struct token *head)
{
	if (lex_is(&r->lex, "END_VAR")) {
		reader_next(r);
		reader_end_head(r);
		return;
	}
	if (r->closed)
		r->closed = false;
	else if (r->lex.token.kind == TOKEN_END)
		reader_fail_open(r, head);
	else
		reader_fail_word(r, DIAG_MISSING_ABOVE, "END_VAR");
}

void read_vars(struct reader *r, struct var_table *table, bool global)
{
	const struct token head = r->lex.token;
	const enum comment_place outside = r->comments;
	struct var_block block = { .first = table->count, .line = head.line,
				   .file = r->place.file, .included = r->outer != NULL };

	if (is_access(r)) { /* in a POU */
		if (r->pou && r->pou->kind == POU_PROGRAM)
			read_access(r);
		else
			reader_misplaced_access(r);
		return;
	}
	block.flags = read_flags(r, global);
	if (block.flags & VAR_EXTERNAL && r->pou) {
		table = &r->project->pou[r->pou - r->project->pou].external;
		block.first = table->count;
	}
	r->var_flags = block.flags;
	block.comment = buffer_take(r, outside == COMMENT_ABOVE ? &r->above : &r->note);
	r->comments = COMMENT_NOTE;
	read_declarations(r, table);
	r->var_flags = 0;
	block.count = table->count - block.first;
	if (r->note.len > 0)
		keep_last_comments(r, table, &block, outside);
	r->comments = outside;
	struct var_block *slot = arena_push(&r->project->arena, &table->block,
					    &table->block_count,
					    sizeof(block));

	if (slot)
		*slot = block;
	else
		r->no_memory = true;
	reader_close_vars(r, &head);
}

int read_located(struct reader *r)
{
	struct var_table *table = &r->project->located;
	const struct token head = r->lex.token;
	struct var_block block = { .first = table->count, .line = head.line,
				   .file = r->place.file, .included = r->outer != NULL };
	struct var_block *slot;

	reader_next(r);
	block.comment = buffer_take(r, &r->note);
	r->paths = true;
	read_declarations(r, table);
	r->paths = false;
	block.count = table->count - block.first;
	if (block.count > 0)
		keep_last_comments(r, table, &block, r->comments);
	slot = arena_push(&r->project->arena, &table->block, &table->block_count, sizeof(block));
	if (slot)
		*slot = block;
	else
		r->no_memory = true;
	reader_close_vars(r, &head);
	return table->block_count - 1;
}

void read_members(struct reader *r, struct var_table *table)
{
	const bool inside = r->members;

	r->members = true;
	read_declarations(r, table);
	r->members = inside;
	if (r->note.len > 0 && table->count > 0) {
		struct var *last = &table->var[table->count - 1];

		last->comment = comment_join(r, last->comment, &r->note, COMMENT_NOTE);
	}
}

bool read_var(struct reader *r, uint16_t flags, struct var *out)
{
	struct var_table one = { 0 };
	bool good;

	r->var_flags = flags;
	r->comments = COMMENT_NOTE;
	r->across_lines = true;
	good = read_declaration(r, &one);
	r->across_lines = false;
	r->var_flags = 0;
	if (!good)
		return false;
	reader_skip_newlines(r);
	if (one.count != 1 || r->lex.token.kind != TOKEN_END)
		return reader_fail_token(r, DIAG_SYNTAX);
	*out = one.var[0];
	return true;
}
