/* SPDX-License-Identifier: MIT
 *
 * scenario_read - reads scenario files. It reports at most one error a line and goes
 * on.
 */
#include "engine/scan/task.h"
#include "engine/trial/pace.h"
#include "engine/trial/scenario.h"
#include "engine/trial/value.h"

#include <string.h>

struct reader {
	const char *file;
	const struct image *image;
	const struct image *plant; /* NULL: none was given                    */
	struct formula_projects projects;
	struct token plant_name;   /* the first one; with its quotes          */
	bool with_plant;           /* before the first scenario: of all       */
	struct arena *arena;
	struct diag_list *diags;
	struct scenario_file *out;
	struct scenario *scenario; /* NULL before the first                   */
	struct expr *expr;         /* scratch                                 */
	struct lex lex;
	int64_t at_ns;
	const char *statement;     /* line of its heading                     */
	int line;
	bool spoiled;              /* this scenario has an error              */
};

static struct diag place_of(const struct reader *reader)
{
	const struct token *token = &reader->lex.token;

	return (struct diag){ .file = reader->file, .line = token->line,
			      .column = token->column };
}

static bool complain(struct reader *reader, enum diag_id id, const char *text)
{
	struct diag place = place_of(reader);

	place.id = id;
	return diag_add(reader->diags, place, "%s", text);
}

static bool complain_here(struct reader *reader, enum diag_id id)
{
	const struct token *token = &reader->lex.token;
	struct diag place = place_of(reader);

	place.id = id;
	if (token->kind == TOKEN_NEWLINE || token->kind == TOKEN_END)
		return diag_add(reader->diags, place, "end of line");
	return diag_add(reader->diags, place, "%.*s",
			token->len < 60 ? (int)token->len : 60, token->text);
}

/* `#` begins a comment, which the lexer does not know. */
static void drop_comment(struct lex *lex)
{
	if (lex->token.kind != TOKEN_SYMBOL || !lex_is(lex, "#"))
		return;
	while (lex->at < lex->end && *lex->at != '\n')
		lex->at++;
	lex_next(lex);
}

static void step_over(struct reader *reader)
{
	lex_next(&reader->lex);
	drop_comment(&reader->lex);
}

static bool accept(struct reader *reader, const char *word)
{
	if (!lex_is(&reader->lex, word))
		return false;
	step_over(reader);
	return true;
}

static bool at_end(struct reader *reader)
{
	drop_comment(&reader->lex);
	return reader->lex.token.kind == TOKEN_NEWLINE ||
	       reader->lex.token.kind == TOKEN_END;
}

static bool take_time(struct reader *reader, int64_t *ns)
{
	const struct token *token = &reader->lex.token;

	if (token->kind != TOKEN_NUMBER)
		return complain(reader, DIAG_EXPECTED, "a time such as 10ms");
	enum literal_result result =
		value_parse_time(token->text, token->len, 0, ns);

	/* 0 needs no unit. */
	if (result == LITERAL_BAD && token->len == 1 && *token->text == '0') {
		result = LITERAL_OK;
		*ns = 0;
	}
	if (result == LITERAL_RANGE)
		return complain_here(reader, DIAG_LITERAL_RANGE);
	if (result != LITERAL_OK)
		return complain(reader, DIAG_EXPECTED, "a time such as 10ms");
	step_over(reader);
	return true;
}

/* The plant of this scenario. */
static const struct image *plant_of(const struct reader *reader)
{
	return reader->scenario && reader->scenario->with_plant ? reader->plant : NULL;
}

static struct formula *take_formula(struct reader *reader)
{
	struct diag place = place_of(reader);
	const char *line_start = reader->lex.line_start;

	if (at_end(reader)) {
		complain(reader, DIAG_EXPECTED, "an expression");
		return NULL;
	}
	if (!expr_parse(&reader->lex, reader->expr, reader->diags, place))
		return NULL;
	drop_comment(&reader->lex);
	return formula_new(reader->image, plant_of(reader), reader->projects, reader->expr,
			   reader->arena, line_start, reader->diags, place);
}

/* Room for the changed texts of constants. */
static bool own_texts(struct reader *reader, struct scenario_watch *watch)
{
	uint16_t capacity = image_get(watch->plant ? reader->plant : reader->image,
				      watch->at).s->capacity;

	for (int i = 0; i < SCENARIO_HISTORY; i++) {
		struct iec_string *text = arena_alloc(reader->arena,
			iec_type_size(IEC_STRING, capacity));

		if (!text)
			return false;
		text->capacity = capacity;
		watch->past[i].s = text;
	}
	return true;
}

static bool watch(struct reader *reader, const struct formula *formula)
{
	struct scenario *scenario = reader->scenario;

	for (int i = 0; i < formula->count; i++) {
		const struct formula_term *term = &formula->term[i];
		struct scenario_watch *seen = scenario->watch;
		int n = 0;

		if (term->op != EXPR_NAME)
			continue;
		while (n < scenario->watch_count &&
		       (seen[n].at.where != term->at.where ||
			seen[n].at.area != term->at.area ||
			seen[n].at.type != term->at.type ||
			seen[n].plant != term->plant))
			n++;
		if (n < scenario->watch_count)
			continue;
		seen = arena_push(reader->arena, &scenario->watch,
				  &scenario->watch_count, sizeof(*seen));
		if (!seen)
			return complain(reader, DIAG_NO_MEMORY, "");
		seen->name = term->name;
		seen->at = term->at;
		seen->plant = term->plant;
		if (seen->at.type == IEC_STRING && !own_texts(reader, seen))
			return complain(reader, DIAG_NO_MEMORY, "");
	}
	return true;
}

static bool add_step(struct reader *reader, enum scenario_verb verb,
		     int64_t span_ns, struct location target,
		     struct formula *formula)
{
	struct scenario *scenario = reader->scenario;
	struct scenario_step *step =
		arena_push(reader->arena, &scenario->step,
			   &scenario->step_count, sizeof(*step));
	const char *end = reader->lex.token.text;

	if (!step)
		return complain(reader, DIAG_NO_MEMORY, "");
	while (end > reader->statement &&
	       (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
		end--;
	step->verb = verb;
	step->line = reader->line;
	step->at_ns = reader->at_ns;
	step->span_ns = span_ns;
	step->target = target;
	step->formula = formula;
	step->text = reader->statement;
	step->text_len = (int)(end - reader->statement);
	return true;
}

static bool take_condition(struct reader *reader, enum scenario_verb verb,
			   int64_t span_ns)
{
	struct diag place = place_of(reader);
	struct formula *formula = take_formula(reader);

	if (!formula)
		return false;
	if (formula_kind(formula) != KIND_BOOL) {
		place.id = DIAG_NOT_BOOL;
		return diag_add(reader->diags, place, "expect");
	}
	return watch(reader, formula) &&
	       add_step(reader, verb, span_ns, (struct location){ 0 }, formula);
}

static bool check_setting(struct reader *reader, const struct token *name,
			  const struct image *image, struct location target,
			  struct formula *formula, struct diag place)
{
	union iec_value value;

	place.id = DIAG_COUNT;
	if (target.constant)
		place.id = target.number ? DIAG_PART_ALONE : DIAG_WRITE_CONSTANT;
	else if (!formula_can_set(formula, target.type))
		place.id = DIAG_WRONG_TYPE;
	else if (formula->constant &&
		 (!formula_value(formula, reader->image, &value) ||
		  !formula_fit(formula, value, target.type, &value) ||
		  !value_has_room(image, target, value)))
		place.id = DIAG_LITERAL_RANGE;
	return place.id == DIAG_COUNT ||
	       diag_add(reader->diags, place, "%.*s",
			name->len < 60 ? (int)name->len : 60, name->text);
}

/* `[3]` and `.Speed` behind the name of a variable that is set. */
static bool take_index(struct reader *reader, struct token *name)
{
	struct lex *lex = &reader->lex;

	while (accept(reader, "[")) {
		accept(reader, "-");
		if (lex->token.kind == TOKEN_NUMBER)
			step_over(reader);
		if (!lex_is(lex, "]"))
			return complain(reader, DIAG_EXPECTED, "a number and ]");
		name->len = (size_t)(lex->token.text + 1 - name->text);
		step_over(reader);
		if (!accept(reader, "."))
			return true;
		if (lex->token.kind != TOKEN_NAME)
			return complain(reader, DIAG_EXPECTED, "name of a member");
		name->len = (size_t)(lex->token.text + lex->token.len - name->text);
		step_over(reader);
	}
	return true;
}

static bool take_setting(struct reader *reader)
{
	struct token name = reader->lex.token;
	struct diag place = place_of(reader);
	const struct image *side;
	struct location target;
	enum diag_id why;

	if (name.kind != TOKEN_NAME && name.kind != TOKEN_ADDRESS)
		return complain_here(reader, DIAG_SYNTAX);
	step_over(reader);
	if (!take_index(reader, &name))
		return false;
	const char *own = name.text;
	size_t own_len = name.len;

	side = value_side(reader->image, plant_of(reader), &own, &own_len);
	target = value_find(side, own, own_len, &why);
	if (!accept(reader, "=") && !accept(reader, ":=")) {
		place.id = DIAG_EXPECTED;
		return diag_add(reader->diags, place, "NAME = VALUE or expect");
	}
	if (target.type == IEC_NONE) {
		place.id = why;
		return diag_add(reader->diags, place, "%.*s",
				name.len < 60 ? (int)name.len : 60, name.text);
	}
	struct formula *formula = take_formula(reader);

	if (!formula || !check_setting(reader, &name, side, target, formula, place) ||
	    !add_step(reader, VERB_SET, 0, target, formula))
		return false;
	reader->scenario->step[reader->scenario->step_count - 1].plant =
		side != reader->image;
	return true;
}

static bool take_expect(struct reader *reader, enum scenario_verb verb,
			int64_t span_ns)
{
	do {
		if (!take_condition(reader, verb, span_ns))
			return false;
	} while (accept(reader, ","));
	return true;
}

static bool take_span(struct reader *reader, enum scenario_verb verb)
{
	int64_t span_ns;

	if (!take_time(reader, &span_ns))
		return false;
	if (!accept(reader, "expect"))
		return complain(reader, DIAG_EXPECTED, "expect");
	return take_expect(reader, verb, span_ns);
}

/* Statements behind `at T` or alone. */
static bool take_action(struct reader *reader)
{
	if (accept(reader, "expect"))
		return take_expect(reader, VERB_EXPECT, 0);
	if (accept(reader, "within"))
		return take_span(reader, VERB_WITHIN);
	if (accept(reader, "for"))
		return take_span(reader, VERB_FOR);
	do {
		if (!take_setting(reader))
			return false;
	} while (accept(reader, ","));
	return true;
}

static bool take_at(struct reader *reader)
{
	int64_t ns = 0;

	if (!take_time(reader, &ns))
		return false;
	if (ns < reader->at_ns)
		return complain(reader, DIAG_TIME_BACK, "");
	reader->at_ns = ns;
	return at_end(reader) || take_action(reader);
}

static bool take_period(struct reader *reader)
{
	struct scenario *scenario = reader->scenario;
	int64_t ns = 0;

	if (scenario->period_ns)
		return complain(reader, DIAG_PERIOD_TWICE, "");
	if (!take_time(reader, &ns))
		return false;
	if (!ns)
		return complain(reader, DIAG_LITERAL_RANGE, "period 0");
	scenario->period_ns = ns;
	return true;
}

static bool take_speed(struct reader *reader)
{
	const struct token *token = &reader->lex.token;
	struct scenario *scenario = reader->scenario;
	const uint64_t speed = pace_read(token->text, token->len);

	if (scenario->speed)
		return complain(reader, DIAG_SPEED_TWICE, "");
	if (speed == PACE_NO_NUMBER)
		return complain(reader, DIAG_EXPECTED, "words a millisecond, such as 500");
	if (!speed || speed > PACE_SPEED_MOST)
		return complain_here(reader, DIAG_LITERAL_RANGE);
	scenario->speed = speed;
	step_over(reader);
	return true;
}

/* The plant is loaded already; the statement says which scenarios use it. */
static bool take_plant(struct reader *reader)
{
	struct scenario *scenario = reader->scenario;
	bool *with = scenario ? &scenario->with_plant : &reader->with_plant;
	const struct token *token = &reader->lex.token;

	step_over(reader);
	if (scenario && scenario->step_count)
		return complain(reader, DIAG_PLANT_LATE, "");
	if (!reader->plant || *with || token->len != reader->plant_name.len ||
	    memcmp(token->text, reader->plant_name.text, token->len) != 0)
		return complain(reader, *with || reader->plant ? DIAG_PLANT_TWICE :
				DIAG_NO_PLANT_FILE, "");
	*with = true;
	step_over(reader);
	return true;
}

/* A scenario that would run for too long is refused; so is one without expectations, as
 * it would always pass. */
static void close_scenario(struct reader *reader)
{
	struct scenario *scenario = reader->scenario;
	bool expects = false;

	if (!scenario)
		return;
	if (!scenario->period_ns)
		scenario->period_ns = tasks_tick(reader->image->program, 0,
						 10 * VALUE_MS);
	for (int i = 0; i < scenario->step_count && !expects; i++)
		expects = scenario->step[i].verb != VERB_SET;
	if (!expects && !reader->spoiled) {
		struct diag place = { .id = DIAG_NO_EXPECT, .file = reader->file,
				      .line = scenario->line };

		diag_add(reader->diags, place, "%s", "");
	}
	for (int i = 0; i < scenario->step_count; i++) {
		const struct scenario_step *step = &scenario->step[i];
		struct diag place = { .id = DIAG_TOO_MANY_SCANS,
				      .file = reader->file,
				      .line = step->line };

		if ((step->at_ns + step->span_ns) / scenario->period_ns <
		    SCENARIO_SCANS_MAX)
			continue;
		diag_add(reader->diags, place, "%d",
			 SCENARIO_SCANS_MAX);
		return;
	}
}

static bool open_scenario(struct reader *reader)
{
	const struct token *token = &reader->lex.token;

	close_scenario(reader);
	reader->scenario = NULL;
	if (token->kind != TOKEN_STRING)
		return complain(reader, DIAG_EXPECTED,
				"the scenario's name in quotes");
	reader->scenario = arena_push(reader->arena, &reader->out->scenario,
				      &reader->out->count,
				      sizeof(*reader->scenario));
	if (!reader->scenario)
		return complain(reader, DIAG_NO_MEMORY, "");
	reader->scenario->name =
		arena_copy(reader->arena, token->text + 1, token->len - 2);
	if (!reader->scenario->name)
		return complain(reader, DIAG_NO_MEMORY, "");
	reader->scenario->line = token->line;
	reader->scenario->with_plant = reader->with_plant;
	reader->at_ns = 0;
	reader->spoiled = false;
	step_over(reader);
	return true;
}

static bool take_statement(struct reader *reader)
{
	reader->statement = reader->lex.token.text;
	reader->line = reader->lex.token.line;
	if (accept(reader, "scenario"))
		return open_scenario(reader);
	if (scenario_is_plant(&reader->lex) && (reader->scenario || !reader->out->count))
		return take_plant(reader);
	if (!reader->scenario)
		return reader->out->count || reader->diags->errors ? false :
		       complain(reader, DIAG_EXPECTED, "scenario \"name\"");
	if (accept(reader, "period"))
		return take_period(reader);
	if (accept(reader, "speed"))
		return take_speed(reader);
	if (accept(reader, "at"))
		return take_at(reader);
	if (accept(reader, "always"))
		return take_condition(reader, VERB_ALWAYS, 0);
	if (accept(reader, "never"))
		return take_condition(reader, VERB_NEVER, 0);
	return take_action(reader);
}

static bool take_line(struct reader *reader)
{
	return take_statement(reader) &&
	       (at_end(reader) || complain_here(reader, DIAG_SYNTAX));
}

static bool check_utf8(struct reader *reader, const char *text, size_t len)
{
	struct diag place = { .id = DIAG_BAD_UTF8, .file = reader->file,
			      .line = 1 };
	const char *line = text;
	size_t bad;

	if (utf8_valid(text, len, &bad))
		return true;
	if (utf16_text(text, len))
		place.id = DIAG_UTF16;
	for (size_t i = 0; i < bad; i++) {
		if (text[i] != '\n')
			continue;
		place.line++;
		line = text + i + 1;
	}
	place.column = (int)(text + bad - line) + 1;
	return diag_add(reader->diags, place, "%s", "");
}

/* Skips the rest of a line with an error. */
static void skip_line(struct reader *reader)
{
	while (!at_end(reader))
		lex_next(&reader->lex);
}

static bool open_reader(struct reader *reader, const char *text, size_t len)
{
	reader->expr = arena_alloc(reader->arena, sizeof(*reader->expr));
	if (!reader->expr)
		return complain(reader, DIAG_NO_MEMORY, "");
	if (!check_utf8(reader, text, len))
		return false;
	lex_init(&reader->lex, text, len);
	reader->lex.newlines = true;
	step_over(reader);
	return true;
}

bool scenario_read(const char *file, const char *text, size_t len,
		   const struct image *image, const struct image *plant,
		   struct formula_projects projects, struct arena *arena, struct scenario_file *out,
		   struct diag_list *diags)
{
	struct reader reader = { .file = file, .image = image, .plant = plant,
				 .projects = projects, .arena = arena, .diags = diags, .out = out };
	int errors = diags->errors;

	memset(out, 0, sizeof(*out));
	out->file = file;
	out->plant = plant;
	if (!open_reader(&reader, text, len))
		return false;
	scenario_plant_token(text, len, &reader.plant_name);
	while (reader.lex.token.kind != TOKEN_END) {
		if (!at_end(&reader) && !take_line(&reader))
			reader.spoiled = true;
		skip_line(&reader);
		if (reader.lex.token.kind == TOKEN_NEWLINE)
			step_over(&reader);
	}
	close_scenario(&reader);
	if (!out->count && diags->errors == errors)
		complain(&reader, DIAG_EXPECTED, "scenario \"name\"");
	return diags->errors == errors;
}
