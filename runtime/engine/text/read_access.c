/* SPDX-License-Identifier: MIT
 *
 * read_access - VAR_ACCESS … END_VAR: names for operators and gateways, and what they may do.
 *
 * It judges form only, and a place in a PROGRAM or outside of all POUs; check/check_access.c finds the variable and compares its type.
 */
#include "engine/text/reader.h"

/* Main.Delay.ET, Line[2].Speed, %MW4, Station.%IX0.3; leaves the cursor behind it. */
static bool read_path(struct reader *r, uint32_t *path)
{
	const struct token *token = &r->lex.token;
	const struct token word = *token;

	buffer_clear(&r->text);
	if (token->kind != TOKEN_NAME && token->kind != TOKEN_ADDRESS)
		return reader_fail_word(r, DIAG_EXPECTED, "variable such as Main.Speed");
	if (token->kind == TOKEN_NAME && reader_peek(r, ".")) {
		buffer_add(r, &r->text, token->text, token->len);
		buffer_add(r, &r->text, ".", 1);
		reader_step(r);
		reader_step(r);
		if (token->kind != TOKEN_ADDRESS)
			return reader_fail_word(r, DIAG_EXPECTED, "address");
	}
	if (!reader_value(r, false, &word))
		return false;
	*path = buffer_take(r, &r->text);
	reader_step(r);
	return true;
}

/* The bounds of an array are numbers: the variable says how they are computed. */
static bool read_access_type(struct reader *r, struct var *var)
{
	struct diag place = r->place;
	enum written_place where;

	if (!reader_type(r, var))
		return false;
	if (!var->written)
		return true;
	where = var->written->at[WRITTEN_LOW].line ? WRITTEN_LOW :
		var->written->at[WRITTEN_HIGH].line ? WRITTEN_HIGH : WRITTEN_CAPACITY;
	place.id = DIAG_ACCESS_BOUND;
	place.line = var->written->at[where].line;
	place.column = var->written->at[where].column;
	return diag_add(r->diags, place, "%s", names_text(&r->project->names,
			where == WRITTEN_CAPACITY ? var->written->capacity :
						    var->written->bound[where]));
}

/* READ_ONLY is what the standard takes if nothing is written. */
static bool read_direction(struct reader *r, bool *writes)
{
	*writes = lex_is(&r->lex, access_word(true));
	if (*writes || lex_is(&r->lex, access_word(false)))
		reader_step(r);
	else if (!reader_is(r, ';'))
		return reader_fail_word(r, DIAG_EXPECTED, "READ_ONLY or READ_WRITE");
	if (reader_is(r, ';'))
		return true;
	return reader_fail_word(r, DIAG_EXPECTED, ";");
}

static bool read_line(struct reader *r, struct access *access)
{
	struct var *var = &access->var;

	*access = (struct access){ .var.line = r->lex.token.line };
	if (!reader_name(r, "name for operators", &var->name))
		return false;
	var->fold = names_fold(&r->project->names, var->name);
	reader_step(r);
	if (!reader_is(r, ':'))
		return reader_fail_word(r, DIAG_EXPECTED, ":");
	reader_step(r);
	if (!read_path(r, &access->path) || !read_access_type(r, var) ||
	    !read_direction(r, &access->writes))
		return false;
	reader_next(r); /* a comment on the same line belongs to this line */
	var->comment = buffer_take(r, &r->note);
	return true;
}

static void add_line(struct reader *r, const struct access *access)
{
	struct project *project = r->project;
	struct access *slot;

	if (project->access_count == LIMIT_VARS) {
		reader_fail_many(r, DIAG_TOO_MANY, "lines of VAR_ACCESS", LIMIT_VARS);
		return;
	}
	slot = arena_push(&project->arena, &project->access, &project->access_count,
			  sizeof(*slot));
	if (slot)
		*slot = *access;
	else
		r->no_memory = true;
}

static void read_lines(struct reader *r)
{
	struct access access;
	bool good;

	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END || r->no_memory ||
		    lex_is(&r->lex, "END_VAR") || read_ends_block(r))
			return;
		r->across_lines = true;
		r->begun = r->lex.token.line;
		good = read_line(r, &access);
		r->across_lines = false;
		if (good)
			add_line(r, &access);
		else if (r->closed && r->lex.token.line != r->mended)
			return;
		else
			reader_skip_declaration(r);
		if (r->closed)
			return;
	}
}

/* Comments behind the last line go to it; without one, to the block, where they stand
 * @outside. */
static void keep_last_comments(struct reader *r, struct access_block *block,
			       enum comment_place outside)
{
	uint32_t *id = block->count > 0 ?
		       &r->project->access[r->project->access_count - 1].var.comment :
		       &block->comment;

	*id = comment_join(r, *id, &r->note, block->count > 0 ? COMMENT_NOTE : outside);
}

int read_access(struct reader *r)
{
	struct project *project = r->project;
	const struct token head = r->lex.token;
	const enum comment_place outside = r->comments;
	struct access_block *slot, block = {
		.first = project->access_count, .file = r->place.file, .line = head.line,
		.included = r->outer != NULL, .pou = r->pou ? (int)(r->pou - project->pou) + 1 : 0,
	};

	if (r->library)
		reader_fail_word(r, DIAG_LIBRARY_VARS, "");
	reader_next(r);
	while (lex_is(&r->lex, "RETAIN") || lex_is(&r->lex, "CONSTANT")) {
		reader_fail_token(r, DIAG_MISPLACED);
		reader_next(r);
	}
	block.comment = buffer_take(r, outside == COMMENT_ABOVE ? &r->above : &r->note);
	r->comments = COMMENT_NOTE;
	read_lines(r);
	block.count = project->access_count - block.first;
	keep_last_comments(r, &block, outside);
	r->comments = outside;
	slot = arena_push(&project->arena, &project->access_block,
			  &project->access_block_count, sizeof(*slot));
	if (slot)
		*slot = block;
	else
		r->no_memory = true;
	reader_close_vars(r, &head);
	return slot ? project->access_block_count - 1 : -1;
}

void reader_misplaced_access(struct reader *r)
{
	struct project *project = r->project;
	const int count = project->access_count, blocks = project->access_block_count;

	reader_fail_token(r, DIAG_MISPLACED);
	read_access(r);
	project->access_count = count;
	project->access_block_count = blocks;
}
