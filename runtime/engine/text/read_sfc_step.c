/* SPDX-License-Identifier: MIT
 *
 * read_sfc_step - steps and macro-steps of a chart, and the lines in them.
 *
 * Whether an action, a BOOL or a time is there for what a line says is found in check/.
 */
#include "engine/text/read_sfc.h"

#include <string.h>

#define COLUMN_MOST 9999

/* ---- lines ---- */

static void add_use(struct sfc_reader *in, struct sfc_use use)
{
	struct sfc *sfc = in->sfc;
	struct sfc_step *step = &sfc->step[sfc->step_count - 1];
	struct sfc_use *slot;

	use.step = sfc->step_count - 1;
	if (step->use_count == LIMIT_STEP_USES) /* said once */
		reader_fail_word(in->r, DIAG_SFC_TOO_MANY, "lines of a step");
	step->use_count++;
	if (step->use_count > LIMIT_STEP_USES)
		return;
	slot = arena_push(&in->r->project->arena, &sfc->use, &sfc->use_count,
			  sizeof(*slot));
	if (slot)
		*slot = use;
	else
		in->r->no_memory = true;
}

/* SET a, b; with the cursor behind SET. The comments go to the first. */
static bool read_bits(struct sfc_reader *in, struct sfc_use use, const struct token *word)
{
	struct reader *r = in->r;
	const int first = in->sfc->use_count;

	r->across_lines = true;
	for (;;) {
		use.line = r->lex.token.line;
		use.column = r->lex.token.column;
		if (!read_value(in, false, word, &use.operand))
			return false;
		add_use(in, use);
		use.more = 1;
		if (!reader_is(r, ','))
			break;
		reader_step(r);
	}
	r->across_lines = false;
	if (!expect_word(in, ";"))
		return false;
	if (in->sfc->use_count > first)
		in->sfc->use[first].comment = buffer_take(r, &r->above);
	return true;
}

static bool read_qualifier(struct sfc_reader *in, void *out)
{
	struct sfc_use *use = out;
	struct reader *r = in->r;
	const struct token *token = &r->lex.token;
	const struct token word = *token;

	if (use->qualifier == QUALIFIER_COUNT) {
		use->qualifier = qualifier_find(token->text, token->len);
		if (use->qualifier == QUALIFIER_COUNT)
			return reader_fail_token(r, DIAG_UNKNOWN_WORD);
		reader_step(r);
		return true;
	}
	if (use->time)
		return reader_fail_token(r, DIAG_SYNTAX);
	return read_value(in, true, &word, &use->time);
}

/* Name(Qualifier, time); */
static bool read_call(struct sfc_reader *in, struct sfc_use use)
{
	struct reader *r = in->r;
	const struct token word = r->lex.token;

	use.qualifier = QUALIFIER_COUNT;
	if (!read_value(in, false, &word, &use.operand))
		return false;
	if (!reader_is(r, '('))
		return reader_fail_word(r, DIAG_EXPECTED, "(");
	if (!read_settings(in, read_qualifier, &use) || !expect_word(in, ";"))
		return false;
	if (use.qualifier == QUALIFIER_COUNT)
		use.qualifier = QUALIFIER_N;
	use.comment = buffer_take(r, &r->above);
	add_use(in, use);
	return true;
}

/* A variable may be called Step or Set: then a parenthesis follows. */
static bool is_call(const struct reader *r)
{
	return r->lex.token.kind == TOKEN_NAME && reader_peek(r, "(") &&
	       !lex_is(&r->lex, "TRANSITION");
}

static bool read_use(struct sfc_reader *in)
{
	struct reader *r = in->r;
	const struct token word = r->lex.token;
	struct sfc_use use = { .line = word.line, .column = word.column, .action = -1 };
	bool set = lex_is(&r->lex, "SET");

	if (is_call(r) || (!set && !lex_is(&r->lex, "RESET")))
		return read_call(in, use);
	use.kind = set ? USE_SET : USE_RESET;
	reader_next(r);
	return read_bits(in, use, &word);
}

/* Behind a line that could not be read. */
static void skip_use(struct sfc_reader *in)
{
	struct reader *r = in->r;

	r->across_lines = false;
	while (!reader_at_end(r) && !reader_is(r, ';') && !lex_is(&r->lex, "END_STEP"))
		reader_next(r);
	if (reader_is(r, ';'))
		reader_next(r);
}

static void read_uses(struct sfc_reader *in)
{
	struct reader *r = in->r;

	for (;;) {
		reader_skip_newlines(r);
		if (r->no_memory || (is_end(in) && !is_call(r)))
			return;
		if ((r->lex.token.kind != TOKEN_NAME &&
		     r->lex.token.kind != TOKEN_ADDRESS) ||
		    (read_ends_block(r) && !is_call(r)))
			skip_odd(in);
		else if (!read_use(in))
			skip_use(in);
	}
}

/* ---- steps ---- */

static bool read_part(struct sfc_reader *in, void *out)
{
	struct sfc_step *step = out;
	const struct lex *lex = &in->r->lex;

	if (lex_is(lex, "MIN"))
		return read_setting(in, true, &step->min);
	if (lex_is(lex, "MAX"))
		return read_setting(in, true, &step->max);
	if (lex_is(lex, "ALARM"))
		return read_setting(in, false, &step->alarm);
	if (lex_is(lex, "COLUMN"))
		return read_number(in, COLUMN_MOST, &step->column);
	return reader_fail_token(in->r, DIAG_UNKNOWN_WORD);
}

/* From the name to the colon. */
static bool read_head(struct sfc_reader *in, struct sfc_step *step)
{
	struct reader *r = in->r;

	step->line = r->lex.token.line;
	step->column_at = r->lex.token.column;
	if (!reader_name(r, "name of the step", &step->name))
		return false;
	reader_next(r);
	if (reader_is(r, '(') && !read_settings(in, read_part, step))
		return false;
	return expect_word(in, ":");
}

static void enter_macro(struct sfc_reader *in)
{
	in->macro = in->sfc->step_count - 1;
	in->depth++;
	if (in->depth == LIMIT_MACROS + 1)
		reader_fail_word(in->r, DIAG_TOO_DEEP, "MACRO_STEP");
}

static bool push_step(struct sfc_reader *in, struct sfc_step step)
{
	struct sfc *sfc = in->sfc;
	struct sfc_step *slot = push_room(in, &sfc->step, &sfc->step_count,
					  sizeof(*slot), LIMIT_STEPS, "steps");

	if (!slot)
		return false;
	step.macro = in->macro;
	step.end = -1;
	step.first_use = sfc->use_count;
	*slot = step;
	add_piece(in, PIECE_STEP, sfc->step_count - 1);
	return true;
}

void read_step(struct sfc_reader *in)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	const struct token head = r->lex.token;
	struct sfc_step step = {
		.kind = lex_is(&r->lex, "STEP") ? STEP_PLAIN :
			lex_is(&r->lex, "MACRO_STEP") ? STEP_MACRO : STEP_INITIAL };

	reader_next(r);
	bool good = read_head(in, &step);

	if (!good)
		reader_skip_line(r);
	step.comment = buffer_take(r, &r->above);
	if (!push_step(in, step))
		return;
	read_uses(in);
	if (sfc->step[sfc->step_count - 1].use_count > LIMIT_STEP_USES)
		sfc->step[sfc->step_count - 1].use_count = LIMIT_STEP_USES;
	if (step.kind == STEP_MACRO) {
		enter_macro(in);
		return;
	}
	sfc->step[sfc->step_count - 1].tail = buffer_take(r, &r->above);
	close_head(in, "END_STEP", &head);
}

void read_step_end(struct sfc_reader *in)
{
	struct reader *r = in->r;
	struct sfc *sfc = in->sfc;
	struct sfc_step *step = &sfc->step[in->macro];

	step->tail = buffer_take(r, &r->above);
	step->end = sfc->piece_count;
	add_piece(in, PIECE_MACRO_END, in->macro);
	in->macro = step->macro;
	in->depth--;
	reader_next(r);
}
