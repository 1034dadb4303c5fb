/* SPDX-License-Identifier: MIT
 *
 * read_types - TYPE … END_TYPE, and types that stand in a declaration itself: enumerations,
 * subranges.
 *
 * A name of a type may be used above its declaration: model/named.c finds what is behind it when
 * the project has been read.
 */
#include "engine/text/reader.h"
#include "engine/text/writer.h"

#include "engine/base/literal.h"
#include "engine/model/named.h"

#include <stdio.h>

/* ---- enumerations and subranges ---- */

struct named_type *reader_add_named(struct reader *r, uint32_t name)
{
	struct project *project = r->project;
	struct named_type *type;

	if (project->named_count == LIMIT_OWN_WORDS) {
		reader_fail_many(r, DIAG_TOO_MANY, "types", LIMIT_OWN_WORDS);
		return NULL;
	}
	type = arena_push(&project->arena, &project->named, &project->named_count, sizeof(*type));
	if (!type) {
		r->no_memory = true;
		return NULL;
	}
	*type = (struct named_type){ .name = name, .part = -1, .file = r->place.file };
	type->fold = names_fold(&project->names, name);
	return type;
}

/* Marks @value as one that check/settle.c computes; the place is the token. */
static bool write_down(struct reader *r, struct enum_value *value)
{
	value->written = arena_alloc(&r->project->arena, sizeof(*value->written));
	if (!value->written)
		return r->no_memory = true, false;
	value->written->file = r->place.file;
	value->written->at[WRITTEN_INITIAL].line = r->lex.token.line;
	value->written->at[WRITTEN_INITIAL].column = r->lex.token.column;
	return true;
}

/* `:= 5` or `:= Red + 1` behind a value; @number is the next one without it. */
static bool read_number(struct reader *r, enum iec_type type, struct enum_value *value)
{
	union iec_value number = { .i = 0 };

	if (!lex_is(&r->lex, ":="))
		return true;
	reader_step(r);
	buffer_clear(&r->text);
	value->written = NULL;
	if (reader_begins_expression(r, type)) {
		if (!write_down(r, value) || !reader_expression_text(r))
			return false;
	} else if (!read_constant(r, type, &number)) {
		return false;
	}
	value->text = buffer_take(r, &r->text);
	value->number = number.i;
	return true;
}

/* @open: the one before it is an expression. */
static bool read_value(struct reader *r, enum iec_type type, int64_t *next, bool *open)
{
	struct project *project = r->project;
	struct enum_value value = { .number = *next, .enumeration = project->enumeration_count - 1 };
	struct enum_value *out;

	if (!reader_name(r, "name of a value", &value.name))
		return false;
	value.fold = names_fold(&project->names, value.name);
	if (named_value(project, value.enumeration, value.fold))
		return reader_fail_token(r, DIAG_DUPLICATE_NAME);
	if (*open && !write_down(r, &value))
		return false;
	reader_step(r);
	if (!read_number(r, type, &value))
		return false;
	*open = value.written != NULL;
	if (value.number < iec_type_row(type)->low || value.number > iec_type_row(type)->high)
		return reader_fail_word(r, DIAG_LITERAL_RANGE, names_text(&project->names, value.name));
	out = arena_push(&project->arena, &project->enum_value, &project->enum_value_count,
			 sizeof(*out));
	if (!out)
		return r->no_memory = true, false;
	*out = value;
	project->enumeration[value.enumeration].count++;
	*next = value.number + 1;
	return true;
}

/* The integer type behind the list at the cursor, as TwinCAT writes it: (Red, Green) UINT. */
static enum iec_type type_behind(const struct reader *r)
{
	struct lex lex = r->lex;
	enum iec_type type = IEC_NONE;
	int open = 0;

	lex.newlines = lex.comments = false;
	do {
		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")");
	} while (lex_next(&lex) != TOKEN_END && open > 0);
	if (lex.token.kind == TOKEN_NAME)
		type = iec_type_find(lex.token.text, lex.token.len);
	return iec_type_row(type)->class & (ANY_INT | CLASS_BITS) ? type : IEC_NONE;
}

/* `(Red, Green := 5)`; the cursor stands on the (. @name: of the type; 0: of a variable. */
static bool read_enumeration(struct reader *r, struct var *var, uint32_t name)
{
	struct project *project = r->project;
	const enum iec_type behind = var->type == IEC_NONE ? type_behind(r) : IEC_NONE;
	struct enumeration *list;
	bool open = false;
	int64_t next = 0;

	if (project->enumeration_count == LIMIT_OWN_WORDS)
		return reader_fail_many(r, DIAG_TOO_MANY, "enumerations", LIMIT_OWN_WORDS);
	list = arena_push(&project->arena, &project->enumeration, &project->enumeration_count,
			  sizeof(*list));
	if (!list)
		return r->no_memory = true, false;
	*list = (struct enumeration){ .first = project->enum_value_count, .name = name,
				      .based = var->type != IEC_NONE };
	var->enumeration = (uint16_t)project->enumeration_count;
	if (behind != IEC_NONE) {
		var->type = behind;
		list->based = true;
	} else if (var->type == IEC_NONE) {
		var->type = IEC_INT;
	}
	list->type = var->type;
	do {
		reader_step(r);
		if (!read_value(r, var->type, &next, &open))
			return false;
	} while (reader_is(r, ','));
	if (!reader_is(r, ')'))
		return reader_fail_word(r, DIAG_EXPECTED, ")");
	reader_step(r);
	if (behind != IEC_NONE)
		reader_step(r);
	return true;
}

/* A limit of a subrange: a number, or an expression that check/settle.c computes. */
static bool read_limit(struct reader *r, struct var *var, enum written_place where, int64_t *out,
		       uint32_t *text)
{
	union iec_value value = { .i = 0 };

	buffer_clear(&r->text);
	if (reader_begins_expression(r, var->type)) {
		if (!reader_expression(r, var, where))
			return false;
	} else if (!read_constant(r, var->type, &value)) {
		return false;
	}
	*text = buffer_take(r, &r->text);
	*out = value.i;
	return true;
}

/* `(0..100)` behind an integer type; the cursor stands on the (. */
static bool read_range(struct reader *r, struct var *var)
{
	struct var_range *range = arena_alloc(&r->project->arena, sizeof(*range));
	struct var_written *before = var->written;
	uint32_t low, high;

	if (!range)
		return r->no_memory = true, false;
	reader_step(r);
	if (!read_limit(r, var, WRITTEN_LEAST, &range->low, &low) || !reader_dots(r) ||
	    !read_limit(r, var, WRITTEN_MOST, &range->high, &high))
		return false;
	if (!reader_is(r, ')'))
		return reader_fail_word(r, DIAG_EXPECTED, ")");
	if (var->written != before || (var->written && var->written->at[WRITTEN_LEAST].line) ||
	    (var->written && var->written->at[WRITTEN_MOST].line)) {
		var->written->range[0] = low;
		var->written->range[1] = high;
	} else if (!var_range_fits(range)) {
		char text[48];

		snprintf(text, sizeof(text), "%lld..%lld", (long long)range->low,
			 (long long)range->high);
		return reader_fail_word(r, DIAG_BAD_RANGE, text);
	}
	reader_step(r);
	r->project->ranges = true;
	var->range = range;
	return true;
}

/* Is what stands in the parentheses at the cursor a list of names? */
static bool is_enumeration(const struct reader *r)
{
	struct lex lex = r->lex;

	lex.newlines = lex.comments = false;
	if (lex_next(&lex) != TOKEN_NAME)
		return false;
	lex_next(&lex);
	return lex_is(&lex, ",") || lex_is(&lex, ":=") || lex_is(&lex, ")");
}

bool reader_own_type(struct reader *r, struct var *var, uint32_t name)
{
	if (!reader_is(r, '('))
		return true;
	if (var->type != IEC_NONE && !(iec_type_row(var->type)->class & ANY_INT) &&
	    !(iec_type_row(var->type)->class & CLASS_BITS && is_enumeration(r)))
		return true;
	if (var->type != IEC_NONE && !is_enumeration(r))
		return read_range(r, var);
	return read_enumeration(r, var, name);
}

/* ---- TYPE ---- */

/* `Name :`; steps behind the colon. */
static bool read_head(struct reader *r, struct structure *out)
{
	if (!reader_name(r, "name of a type", &out->name))
		return false;
	out->line = r->lex.token.line;
	reader_step(r);
	if (!reader_is(r, ':'))
		return reader_fail_word(r, DIAG_EXPECTED, ":");
	reader_step(r);
	return true;
}

/* The word at the cursor, STRUCT or UNION. */
static enum overlap struct_word(const struct reader *r)
{
	struct lex ahead = r->lex;

	if (lex_is(&ahead, "UNION"))
		return OVERLAP_UNION;
	ahead.newlines = ahead.comments = false;
	lex_next(&ahead);
	return lex_is(&ahead, "OVERLAP") ? OVERLAP_STRUCT : OVERLAP_NONE;
}

/* Behind STRUCT, STRUCT OVERLAP or UNION. */
static void step_to_members(struct reader *r, const struct structure *structure)
{
	if (structure->overlap == OVERLAP_STRUCT)
		reader_step(r);
	r->across_lines = false;
	reader_next(r);
}

/* STRUCT … END_STRUCT; with the comment behind it. */
static bool read_struct(struct reader *r, struct structure *out)
{
	out->overlap = struct_word(r);
	step_to_members(r, out);
	read_members(r, &out->vars);
	if (!lex_is(&r->lex, project_struct_end(out)))
		return reader_fail_word(r, DIAG_EXPECTED, project_struct_end(out));
	reader_next(r);
	if (reader_is(r, ';'))
		reader_next(r);
	else if (!lex_is(&r->lex, "END_TYPE") && r->lex.token.kind != TOKEN_NEWLINE)
		return reader_fail_word(r, DIAG_EXPECTED, ";");
	out->comment = buffer_take(r, &r->note);
	return true;
}

/* Drops the structure if there is one like it, whose word is @word then. */
static bool drop_alike(struct project *project, int index, enum word *word)
{
	for (int i = 0; i < index; i++)
		if (!project->structure[i].name && project->structure[i].text == project->structure[index].text) {
			*word = project->structure[i].word;
			project->structure_count = index;
			return true;
		}
	return false;
}

/* Its word has the name of no type. */
bool reader_inner_struct(struct reader *r, struct var *var)
{
	struct project *project = r->project;
	struct structure made = { .file = r->place.file, .line = r->lex.token.line };
	const int index = project->structure_count;
	struct word_row *row;

	made.overlap = struct_word(r);
	if (r->inner == LIMIT_NESTING)
		return reader_fail_token(r, DIAG_TOO_DEEP);
	made.word = reader_own_word(r, reader_intern(r, "STRUCT", 6), WORD_STRUCT);
	row = words_own(&project->words, made.word);
	if (!row || !arena_push(&project->arena, &project->structure, &project->structure_count, sizeof(made)))
		return r->no_memory |= row != NULL, false;
	row->owner = index;
	project->structure[index] = made;
	r->inner++;
	step_to_members(r, &made);
	read_members(r, &made.vars);
	r->across_lines = true;
	r->inner--;
	made.text = write_inner_text(project, &made);
	project->structure[index] = made;
	row->owner = drop_alike(project, index, &made.word) ? -1 : index;
	var->fb = made.word;
	if (!lex_is(&r->lex, project_struct_end(&made)))
		return reader_fail_word(r, DIAG_EXPECTED, project_struct_end(&made));
	r->begun = r->lex.token.line;
	reader_step(r);
	return true;
}

/* The type that read_words() made, unless another one has this name. */
static struct named_type *take_named(struct reader *r, uint32_t name)
{
	struct project *project = r->project;
	const int at = named_find(project, names_fold(&project->names, name));

	if (at < 0 || project->named[at].like.var)
		return reader_add_named(r, name);
	return &project->named[at];
}

/* A type that is no structure, behind its colon. */
static bool add_named(struct reader *r, const struct structure *head, const struct part *part,
		      uint32_t **comment)
{
	struct project *project = r->project;
	struct var *like = arena_alloc(&project->arena, sizeof(*like));
	struct var_block *block = arena_alloc(&project->arena, sizeof(*block));
	struct named_type *type;
	bool good;

	if (!like || !block)
		return r->no_memory = true, false;
	*like = (struct var){ .name = head->name, .line = head->line };
	like->fold = names_fold(&project->names, like->name);
	type = take_named(r, head->name);
	if (!type)
		return false;
	*block = (struct var_block){ .count = 1, .line = head->line };
	type->part = project->part_count;
	type->before = part->index + part->count;
	type->file = r->place.file;
	type->line = head->line;
	type->like = (struct var_table){ .var = like, .count = 1, .block = block, .block_count = 1 };
	const int own = (int)(type - project->named);

	good = reader_type_of(r, like, head->name) && reader_init(r, like);
	if (good && reader_is(r, ';'))
		reader_next(r);
	else if (good && r->plain && lex_is(&r->lex, "END_TYPE"))
		reader_fail_token(r, DIAG_LAST_MARK);
	else if (good)
		good = reader_fail_word(r, DIAG_EXPECTED, ";");
	*comment = &project->named[own].like.var->comment;
	**comment = buffer_take(r, &r->note);
	return good;
}

static void add_struct(struct reader *r, const struct structure *head, struct part *part)
{
	struct project *project = r->project;
	int index = project->structure_count;
	struct structure *out = arena_push(&project->arena, &project->structure,
					   &project->structure_count, sizeof(*out));
	struct structure made = *head;
	bool good;

	if (!out) {
		r->no_memory = true;
		return;
	}
	good = read_struct(r, &made);
	made.word = reader_take_word(r, made.name, WORD_STRUCT, index);
	project->structure[index] = made;
	part->count = project->structure_count - part->index; /* those inside it, too */
	while (!good && r->lex.token.kind != TOKEN_END && !read_ends_block(r) &&
	       !reader_ends_struct(r) && !lex_is(&r->lex, "END_TYPE"))
		reader_next(r);
	if (!good && reader_ends_struct(r))
		reader_skip_line(r);
}

/* `Name : … ;` @comment: gets the place of its comment. */
static void add_type(struct reader *r, struct part *part, uint32_t **comment)
{
	struct structure head = { .file = r->place.file, .word = WORD_COUNT };
	const int index = r->project->structure_count;
	bool good;

	r->across_lines = true;
	good = read_head(r, &head);
	if (good && (lex_is(&r->lex, "STRUCT") || lex_is(&r->lex, "UNION"))) {
		add_struct(r, &head, part);
		*comment = index < r->project->structure_count ? &r->project->structure[index].comment : NULL;
		return;
	}
	r->begun = r->lex.token.line;
	good = good && add_named(r, &head, part, comment);
	part->count = r->project->structure_count - part->index;
	r->across_lines = false;
	while (!good && r->lex.token.kind != TOKEN_END && !read_ends_block(r) &&
	       !lex_is(&r->lex, "END_TYPE") && !reader_ends_struct(r)) {
		good = reader_is(r, ';');
		reader_next(r);
	}
	if (!good && reader_ends_struct(r))
		reader_skip_line(r);
}

void read_types(struct reader *r)
{
	const struct token head = r->lex.token;
	struct part part = { .kind = PART_TYPES,
			     .index = r->project->structure_count };
	uint32_t *last = NULL; /* comment of the last type                    */

	part.comment = buffer_take(r, &r->above);
	r->comments = COMMENT_NOTE;
	reader_next(r);
	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || r->no_memory ||
		    lex_is(&r->lex, "END_TYPE") || read_ends_block(r))
			break;
		add_type(r, &part, &last);
	}
	if (r->note.len > 0 && last) {
		*last = comment_join(r, *last, &r->note, COMMENT_NOTE);
	} else if (r->note.len > 0) {
		part.comment = comment_join(r, part.comment, &r->note, COMMENT_ABOVE);
	}
	r->comments = COMMENT_ABOVE;
	reader_add_part(r, part);
	if (lex_is(&r->lex, "END_TYPE")) {
		reader_next(r);
		reader_end_head(r);
		return;
	}
	reader_fail_open(r, &head);
}
