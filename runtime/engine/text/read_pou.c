/* SPDX-License-Identifier: MIT
 *
 * read_pou - PROGRAM, FUNCTION and FUNCTION_BLOCK from their first line to their
 * last, and TYPE … END_TYPE.
 *
 * Declarations, rungs and instruction lists have readers of their own.
 */
#include "engine/text/reader.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
	const char *end, *name, *many;
} kinds[] = {
	[POU_PROGRAM] = { "END_PROGRAM", "name of the program", "programs" },
	[POU_FUNCTION] = { "END_FUNCTION", "name of the function", "functions" },
	[POU_BLOCK] = { "END_FUNCTION_BLOCK", "name of the function block",
			"function blocks" },
	[POU_SUBROUTINE] = { "END_SUBROUTINE", "name of the subroutine",
			     "subroutines" },
	[POU_ACTION] = { "END_ACTION", "name of the action", "actions" },
};

bool read_pou_kind(const struct reader *r, enum pou_kind *kind)
{
	*kind = POU_ACTION;
	if (read_begins_action(r))
		return true;
	for (size_t i = 0; i < POU_ACTION; i++)
		if (lex_is(&r->lex, pou_word((enum pou_kind)i))) {
			*kind = (enum pou_kind)i;
			return true;
		}
	*kind = POU_BLOCK;
	return lex_is(&r->lex, "FUNCTIONBLOCK"); /* CODESYS 2.3 reads and exports it */
}

/* ---- object-oriented parts, which no language here has ---- */

static const struct { const char *word, *end; } objects[] = {
	{ "METHOD", "END_METHOD" }, { "PROPERTY", "END_PROPERTY" },
	{ "CLASS", "END_CLASS" }, { "INTERFACE", "END_INTERFACE" },
};

bool reader_skip_objects(struct reader *r)
{
	for (size_t i = 0; r->plain && i < sizeof(objects) / sizeof(*objects); i++) {
		if (!lex_is(&r->lex, objects[i].word) || reader_peek(r, ":=") || reader_peek(r, ":"))
			continue;
		reader_fail_token(r, DIAG_OBJECTS);
		while (r->lex.token.kind != TOKEN_END && !lex_is(&r->lex, objects[i].end))
			reader_next(r);
		if (r->lex.token.kind != TOKEN_END)
			reader_next(r);
		reader_skip_newlines(r);
		return true;
	}
	return false;
}

/* A word beside the name of a block: ABSTRACT, EXTENDS Base. */
static bool is_object_word(const struct reader *r)
{
	static const char *const words[] = { "ABSTRACT", "FINAL", "PUBLIC", "PRIVATE", "PROTECTED",
					     "INTERNAL", "EXTENDS", "IMPLEMENTS" };

	for (size_t i = 0; r->plain && i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&r->lex, words[i]))
			return true;
	return false;
}

/* ---- bodies ---- */

/* Reads the body up to its END or to a word that cannot stand in a POU. */
static void read_rungs(struct reader *r, struct pou *pou)
{
	for (;;) {
		reader_skip_newlines(r);
		if (r->lex.token.kind == TOKEN_END)
			return;
		if (lex_is(&r->lex, "RUNG")) {
			r->lost = false;
			r->place.rung++;
			reader_add_rung(r, pou);
		} else if (reader_is_vars(r)) {
			if (r->place.rung > 0)
				reader_fail_token(r, DIAG_MISPLACED);
			read_vars(r, &pou->vars, false);
		} else if (read_ends_block(r)) {
			return;
		} else {
			reader_skip_odd_line(r);
			if (r->closed)
				return;
		}
	}
}

/* Rungs and charts, which have titles in quotes. */
static void read_drawn(struct reader *r, struct pou *pou)
{
	const bool wide = r->lex.wide;

	r->lex.wide = false;
	if (pou->language == LANGUAGE_LD)
		read_rungs(r, pou);
	else if (pou->sfc)
		read_sfc(r, pou);
	r->lex.wide = wide;
}

static void read_body(struct reader *r, struct pou *pou)
{
	if (pou->language == LANGUAGE_LD || pou->language == LANGUAGE_SFC) {
		read_drawn(r, pou);
		return;
	}
	if (pou->language == LANGUAGE_FBD) {
		read_fbd(r, pou);
		return;
	}
	struct lex before = r->lex;
	size_t above = r->above.len; /* comments on the line of END_VAR */

	for (reader_skip_newlines(r); reader_is_vars(r); reader_skip_newlines(r)) {
		read_vars(r, &pou->vars, false);
		before = r->lex;
		above = r->above.len;
	}
	if (pou->language == LANGUAGE_IL) {
		read_il(r, pou);
		return;
	}
	r->above.len = above; /* read_st() reads the others, as a part of the body */
	r->above.slash = NULL;
	r->lex = before;
	read_st(r, pou);
}

/* ---- first lines ---- */

/* ENO is TRUE when a body begins; the body may clear it. */
static bool add_eno(struct reader *r, struct var_table *table, int line)
{
	struct var *eno = arena_push(&r->project->arena, &table->var, &table->count,
				     sizeof(*eno));

	if (!eno) {
		r->no_memory = true;
		return false;
	}
	*eno = (struct var){ .name = reader_intern(r, "ENO", 3), .type = IEC_BOOL,
			     .has_init = true, .init = { .i = 1 }, .line = line };
	eno->fold = names_fold(&r->project->names, eno->name);
	return true;
}

/* May the heading of a function end here, without the type of a result? */
static bool may_lack_result(const struct reader *r)
{
	return lex_is(&r->lex, "ST") || lex_is(&r->lex, "FBD") || lex_is(&r->lex, "LD") || lex_is(&r->lex, "IL") ||
	       (r->plain && (r->lex.token.kind == TOKEN_NEWLINE || reader_is_vars(r)));
}

/* The result is a variable of the function's name. */
static bool read_result(struct reader *r, struct pou *pou)
{
	struct var_table *table = &pou->vars;
	struct arena *arena = &r->project->arena;
	struct var var = { .name = pou->name, .line = pou->line };
	struct var_block *block;
	struct var *slot;

	var.fold = names_fold(&r->project->names, var.name);
	pou->no_result = !reader_is(r, ':') && may_lack_result(r);
	var.type = IEC_BOOL;
	if (!pou->no_result && !reader_type(r, &var))
		return false;
	block = arena_push(arena, &table->block, &table->block_count,
			   sizeof(*block));
	slot = arena_push(arena, &table->var, &table->count, sizeof(*slot));
	if (!block || !slot) {
		r->no_memory = true;
		return false;
	}
	*block = (struct var_block){ .flags = VAR_RESULT, .count = 2,
				     .line = pou->line };
	*slot = var;
	return add_eno(r, table, pou->line);
}

/* Reads the second of two words. */
static void read_evolution(struct reader *r, struct sfc *sfc, const char *word,
			   enum sfc_evolution evolution)
{
	reader_next(r);
	if (!lex_is(&r->lex, word)) {
		reader_fail_word(r, DIAG_EXPECTED, word);
		reader_skip_line(r);
		return;
	}
	sfc->evolution = evolution;
	reader_next(r);
}

static void begin_chart(struct reader *r, struct pou *pou)
{
	if (pou->kind != POU_PROGRAM && pou->kind != POU_BLOCK)
		reader_fail_word(r, DIAG_SFC_KIND, pou_word(pou->kind));
	pou->language = LANGUAGE_SFC;
	pou->sfc = arena_alloc(&r->project->arena, sizeof(*pou->sfc));
	if (!pou->sfc) {
		r->no_memory = true;
		return;
	}
	pou->sfc->block = -1;
}

/* SFC, and perhaps UNTIL STABLE or IN ORDER; the cursor stands on SFC. */
static void begin_sfc(struct reader *r, struct pou *pou)
{
	begin_chart(r, pou);
	reader_next(r);
	if (!pou->sfc)
		return;
	if (lex_is(&r->lex, "UNTIL"))
		read_evolution(r, pou->sfc, "STABLE", EVOLVE_UNTIL_STABLE);
	else if (lex_is(&r->lex, "IN"))
		read_evolution(r, pou->sfc, "ORDER", EVOLVE_IN_ORDER);
}

/* Steps behind the declarations of a POU, to the first token of its body. */
static void skip_vars(struct lex *lex)
{
	while (lex_is(lex, "USING")) {
		while (!lex_is(lex, ";") && lex->token.kind != TOKEN_END)
			lex_next(lex);
		lex_next(lex);
	}
	while (lex->token.kind == TOKEN_NAME && lex->token.len >= 3 &&
	       ascii_same(lex->token.text, "VAR", 3) &&
	       (lex->token.len == 3 || lex->token.text[3] == '_')) {
		while (!lex_is(lex, "END_VAR") && lex->token.kind != TOKEN_END)
			lex_next(lex);
		lex_next(lex);
	}
}

/* Does the POU at the cursor have a step? A body may also begin with its actions, in ST. */
static bool has_step(struct lex lex)
{
	while (lex.token.kind != TOKEN_END && !lex_is(&lex, "END_PROGRAM") && !lex_is(&lex, "END_FUNCTION_BLOCK")) {
		if (lex_is(&lex, "INITIAL_STEP"))
			return true;
		lex_next(&lex);
	}
	return false;
}

/* Does a part of a chart begin here: `STEP Name`, `TRANSITION (`? */
static bool begins_chart(struct lex lex)
{
	static const char *const words[] = { "INITIAL_STEP", "STEP", "MACRO_STEP", "TRANSITION", "ACTION" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++) {
		if (!lex_is(&lex, words[i]))
			continue;
		lex_next(&lex);
		if (i == 4 && !has_step(lex))
			return false;
		return lex.token.kind == TOKEN_NAME || (i == 3 && lex_is(&lex, "("));
	}
	return false;
}

/* RUNG, NETWORK: not a variable with this name. */
static bool begins_with(struct lex lex, const char *word)
{
	if (!lex_is(&lex, word))
		return false;
	lex_next(&lex);
	return !lex_is(&lex, ":=") && !lex_is(&lex, "(") && !lex_is(&lex, "[") && !lex_is(&lex, ".");
}

/* The language of a POU whose first line has none; the cursor stands behind that. */
static enum pou_language language_of_body(const struct reader *r)
{
	struct lex lex = r->lex;

	lex.comments = lex.newlines = false;
	if (lex.token.kind == TOKEN_NEWLINE)
		lex_next(&lex);
	skip_vars(&lex);
	if (begins_with(lex, "RUNG"))
		return LANGUAGE_LD;
	if (begins_chart(lex))
		return LANGUAGE_SFC;
	if (begins_with(lex, "NETWORK"))
		return LANGUAGE_FBD;
	if (lex_is(&lex, "ACTION"))
		return LANGUAGE_IL; /* as any body without a line */
	return st_begins(lex) ? LANGUAGE_ST : LANGUAGE_IL;
}

/* The last POU of the file that may have actions, or the one that ACTIONS names; NULL: there is none. */
static const struct pou *last_owner(const struct reader *r, int index)
{
	const struct project *project = r->project;
	const int named = r->actions_of ? project_find_pou(project, project_text(project, r->actions_of),
							   names_len(&project->names, r->actions_of)) : -1;

	if (named >= 0)
		return &project->pou[named];
	while (index-- > 0) {
		const struct pou *pou = &project->pou[index];

		if (pou->file == r->place.file && (pou->kind == POU_PROGRAM || pou->kind == POU_BLOCK))
			return pou;
	}
	return NULL;
}

/* `ACTION Start:` of the POU above, `ACTION Pump.Start:` of another one. */
static void read_action_line(struct reader *r, struct pou *pou, int index)
{
	const struct pou *owner = last_owner(r, index);
	const struct token *token = &r->lex.token;
	char name[2 * LIMIT_NAME + 2];

	pou->language = LANGUAGE_ST;
	pou->unsaid = true;
	reader_next(r);
	if (token->len > LIMIT_NAME || (!owner && !memchr(token->text, '.', token->len))) {
		reader_fail_word(r, DIAG_MISPLACED, "ACTION");
		reader_skip_line(r);
		return;
	}
	if (memchr(token->text, '.', token->len))
		snprintf(name, sizeof(name), "%.*s", (int)token->len, token->text);
	else
		snprintf(name, sizeof(name), "%s.%.*s", project_text(r->project, owner->name),
			 (int)token->len, token->text);
	pou->name = reader_intern(r, name, strlen(name));
	reader_next(r);
	if (reader_is(r, ':'))
		reader_next(r);
	r->place.pou = names_text(&r->project->names, pou->name);
	pou->language = language_of_body(r);
	reader_end_head(r);
}

static bool begins_uses(const struct reader *r)
{
	struct lex ahead = r->lex;

	ahead.newlines = ahead.comments = false;
	if (ahead.token.kind == TOKEN_NEWLINE)
		lex_next(&ahead);
	return lex_is(&ahead, "USING");
}

/* USING Plant.Pumps; behind a heading. */
static void read_uses(struct reader *r, struct pou *pou)
{
	struct buffer line = { .text = NULL };

	for (reader_skip_newlines(r); lex_is(&r->lex, "USING"); reader_skip_newlines(r)) {
		if (line.len)
			buffer_add(r, &line, "\n", 1);
		if (!reader_take_space(r, &line)) {
			reader_skip_line(r);
			break;
		}
	}
	if (line.len)
		pou->uses = buffer_take(r, &line);
	free(line.text);
}

static void read_first_line(struct reader *r, struct pou *pou, int index)
{
	if (pou->kind == POU_ACTION) {
		read_action_line(r, pou, index);
		return;
	}
	reader_next(r);
	if (is_object_word(r)) {
		reader_fail_token(r, DIAG_OBJECTS);
		reader_next(r);
	}
	if (!reader_name(r, kinds[pou->kind].name, &pou->name)) {
		reader_skip_line(r);
		return;
	}
	reader_next(r);
	r->place.pou = names_text(&r->project->names, pou->name);
	if (pou_has_frame(pou))
		pou->word = reader_take_word(r, pou->name, pou->kind == POU_BLOCK ?
				     WORD_FB : WORD_FN, index);
	if (pou->kind == POU_FUNCTION && !read_result(r, pou)) {
		reader_skip_line(r);
		return;
	}
	if (is_object_word(r)) {
		reader_fail_token(r, DIAG_OBJECTS);
		reader_skip_line(r);
		pou->language = language_of_body(r);
		return;
	}
	pou->unsaid = !lex_is(&r->lex, "IL") && !lex_is(&r->lex, "LD") && !lex_is(&r->lex, "SFC") &&
		      !lex_is(&r->lex, "ST") && !lex_is(&r->lex, "FBD");
	if (lex_is(&r->lex, "IL"))
		pou->language = LANGUAGE_IL;
	else if (lex_is(&r->lex, "ST"))
		pou->language = LANGUAGE_ST;
	else if (lex_is(&r->lex, "FBD"))
		pou->language = LANGUAGE_FBD;
	else if (r->plain && pou->unsaid)
		pou->language = language_of_body(r);
	if (pou->language == LANGUAGE_SFC)
		begin_chart(r, pou);
	if (lex_is(&r->lex, "SFC"))
		begin_sfc(r, pou);
	else if (lex_is(&r->lex, "IL") || lex_is(&r->lex, "LD") || lex_is(&r->lex, "ST") ||
		 lex_is(&r->lex, "FBD"))
		reader_next(r);
	reader_end_head(r);
}

/* What an input with R_EDGE or F_EDGE was at the last call: the hidden variable Input.M. */
static void add_edges(struct reader *r, struct var_table *table)
{
	const int count = table->count;
	struct var_block *block = NULL;

	for (int i = 0; i < count && !r->no_memory; i++) {
		char name[LIMIT_NAME + 4];
		struct var *slot;

		if (!table->var[i].edge)
			continue;
		if (!block) {
			block = arena_push(&r->project->arena, &table->block, &table->block_count,
					   sizeof(*block));
			if (block)
				*block = (struct var_block){ .flags = VAR_SFC, .first = count };
		}
		snprintf(name, sizeof(name), "%s.M", names_text(&r->project->names, table->var[i].name));
		slot = arena_push(&r->project->arena, &table->var, &table->count, sizeof(*slot));
		if (!slot || !block) {
			r->no_memory = true;
			return;
		}
		*slot = (struct var){ .name = reader_intern(r, name, strlen(name)), .type = IEC_BOOL,
				      .line = table->var[i].line };
		slot->fold = names_fold(&r->project->names, slot->name);
		block->count++;
	}
}

/* VAR_TEMP is a row without a name. */
static void add_temps(struct reader *r, struct pou *pou, int index)
{
	bool temps = false;

	for (int i = 0; i < pou->vars.block_count; i++)
		temps |= pou->vars.block[i].flags & VAR_TEMP &&
			 pou->vars.block[i].count > 0;
	if (!temps || pou->kind == POU_FUNCTION)
		return;
	pou->temp_word = reader_own_word(r, 0, WORD_STRUCT);
	if (pou->temp_word != WORD_COUNT)
		words_own(&r->project->words, pou->temp_word)->owner = index;
}

void read_pou(struct reader *r, enum pou_kind kind)
{
	struct project *project = r->project;
	int index = project->pou_count;
	struct token head = r->lex.token;
	struct pou *pou = NULL;

	if (index == LIMIT_POUS)
		reader_fail_many(r, DIAG_TOO_MANY, kinds[kind].many, LIMIT_POUS);
	else
		pou = arena_push(&project->arena, &project->pou,
				 &project->pou_count, sizeof(*pou));
	if (!pou) {
		r->no_memory |= project->pou_count < LIMIT_POUS;
		r->lex.at = r->lex.end;
		reader_next(r);
		return;
	}
	*pou = (struct pou){ .file = r->place.file, .line = head.line,
			     .included = r->outer != NULL, .kind = kind,
			     .word = WORD_COUNT, .temp_word = WORD_COUNT };
	pou->il.arena = &project->arena;
	reader_add_part(r, (struct part){ .kind = PART_POU, .index = index });
	r->pou = pou;
	read_first_line(r, pou, index);
	pou->comment = buffer_take(r, &r->above);
	if (r->plain && kind != POU_ACTION && begins_uses(r))
		read_uses(r, pou);
	read_body(r, pou);
	r->place.rung = 0;
	r->pou = NULL;
	pou->tail = buffer_take(r, &r->above);
	add_temps(r, pou, index);
	add_edges(r, &pou->vars);
	while (kind != POU_ACTION) { /* inside it, as TwinCAT has them */
		reader_skip_newlines(r);
		if (read_begins_action(r))
			read_pou(r, POU_ACTION);
		else if (!reader_skip_objects(r))
			break;
	}
	if (lex_is(&r->lex, kinds[kind].end)) {
		reader_next(r);
		r->place.pou = NULL;
		reader_end_head(r);
		return;
	}
	if (r->closed)
		r->closed = false;
	else if (r->lex.token.kind == TOKEN_END)
		reader_fail_open(r, &head);
	else
		reader_fail_word(r, DIAG_MISSING_ABOVE, kinds[kind].end);
	r->place.pou = NULL;
}
