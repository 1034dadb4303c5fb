/* SPDX-License-Identifier: MIT
 *
 * check_sfc_names - the names that a chart declares, and those that its lines use.
 *
 * It looks at each operand alone. check_sfc checks times, qualifiers and where transitions
 * lead.
 */
#include "engine/check/check_sfc_names.h"

#include "engine/check/reserved.h"
#include "engine/model/advice.h"

#include <stdio.h>
#include <string.h>

struct sfc_names {
	struct scope *scope;
	struct project *project;
	const struct pou *pou;
	const struct sfc *sfc;
	struct uses *uses;
	struct diag_list *diags;
	int *first;          /* by folded name: line of the first of this name */
	int firsts;
	bool good;
};

/* A place in the file. */
struct spot {
	int line, column;
};

static void report(struct sfc_names *c, enum diag_id id, struct spot at, const char *arg)
{
	const struct diag place = { .id = id, .file = c->pou->file, .line = at.line,
		.column = at.column, .pou = project_text(c->project, c->pou->name) };

	c->good &= diag_add(c->diags, place, "%s", arg);
}

/* @needed: NULL: BOOL. */
static void report_type(struct sfc_names *c, struct spot at, const char *name,
			const char *needed)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.40s" DIAG_AND "%s", name, needed ? needed : "");
	report(c, needed ? DIAG_WRONG_TYPE : DIAG_NOT_BOOL, at, needed ? text : name);
}

/* ---- names that it gives ---- */

static void add_name(struct sfc_names *c, uint32_t name, struct spot at, bool own)
{
	const uint32_t fold = names_fold(&c->project->names, name);
	const char *text = project_text(c->project, name);
	const struct diag place = { .id = DIAG_DUPLICATE_NAME, .file = c->pou->file,
		.line = at.line, .column = at.column,
		.pou = project_text(c->project, c->pou->name) };

	if (!fold || fold >= (uint32_t)c->firsts)
		return;
	if (own && (reserved_fault(text) == DIAG_RESERVED_NAME || sfc_reserved(text)))
		report(c, DIAG_RESERVED_NAME, at, text);
	if (!c->first[fold])
		c->first[fold] = at.line ? at.line : 1;
	else if (own)
		c->good &= diag_add(c->diags, place, "%.40s" DIAG_AND "%d", text,
				    c->first[fold]);
}

/* Names that the program declares, without those that the chart adds. */
static void add_variables(struct sfc_names *c)
{
	const struct var_table *table = &c->pou->vars;

	for (int i = 0; i < table->block_count; i++) {
		const struct var_block *block = &table->block[i];

		for (int k = 0; !(block->flags & VAR_SFC) && k < block->count; k++) {
			const struct var *var = &table->var[block->first + k];
			const struct spot at = { var->line, 0 };

			add_name(c, var->name, at, false);
			if (sfc_reserved(project_text(c->project, var->name)))
				report(c, DIAG_RESERVED_NAME, at,
				       project_text(c->project, var->name));
		}
	}
}

static void add_piece(struct sfc_names *c, struct sfc_piece piece)
{
	const struct sfc *sfc = c->sfc;

	if (piece.kind == PIECE_STEP) {
		const struct sfc_step *step = &sfc->step[piece.index];

		add_name(c, step->name, (struct spot){ step->line, step->column_at }, true);
	} else if (piece.kind == PIECE_TRANSITION) {
		const struct sfc_transition *t = &sfc->transition[piece.index];

		add_name(c, t->name, (struct spot){ t->line, t->column }, true);
	} else if (piece.kind == PIECE_ACTION) {
		const struct sfc_action *action = &sfc->action[piece.index];

		add_name(c, action->name, (struct spot){ action->line, action->column },
			 true);
	}
}

static void check_given(struct sfc_names *c, struct arena *scratch)
{
	c->firsts = c->project->names.count;
	c->first = arena_alloc(scratch, (size_t)c->firsts * sizeof(*c->first));
	if (!c->first) {
		report(c, DIAG_NO_MEMORY, (struct spot){ 0, 0 }, "");
		return;
	}
	add_variables(c);
	for (int i = 0; i < c->sfc->piece_count; i++)
		add_piece(c, c->sfc->piece[i]);
}

/* ---- names that it uses ---- */

static const struct meaning *find(struct sfc_names *c, uint32_t id, struct spot at,
				  unsigned int kinds)
{
	const char *name = project_text(c->project, id);
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);
	char text[2 * LIMIT_ARG];

	if (m) {
		uses_add_index(c->uses, c->scope, c->pou, id, m);
		return m;
	}
	enum diag_id better = DIAG_COUNT;

	if (why == DIAG_UNKNOWN_NAME || (why == DIAG_NO_PIN && strchr(name, '.')))
		better = advice_word(c->project, c->pou, why == DIAG_NO_PIN ? EXPECT_PIN : kinds, c->diags,
				     name, text, sizeof(text));
	else
		snprintf(text, sizeof(text), "%.*s", LIMIT_ARG - 1, name);
	report(c, better != DIAG_COUNT ? better : why, at, text);
	return NULL;
}

/* The error of using a meaning as a value; DIAG_COUNT: none. */
static enum diag_id value_fault(const struct meaning *m)
{
	if (m->kind == MEANING_STRUCT)
		return DIAG_STRUCT_AS_VALUE;
	return meaning_fault(m);
}

/* A BOOL that the chart writes. */
static void check_written(struct sfc_names *c, uint32_t id, struct spot at,
			  unsigned int kinds)
{
	const struct meaning *m = id ? find(c, id, at, kinds) : NULL;
	const char *name = project_text(c->project, id);

	if (!m)
		return;
	if (value_fault(m) != DIAG_COUNT)
		report(c, value_fault(m), at, name);
	else if (m->constant || m->kind == MEANING_LITERAL)
		report(c, DIAG_WRITE_CONSTANT, at, name);
	else if (!m->writable)
		report(c, m->kind == MEANING_PIN ? DIAG_PIN_DIRECTION : DIAG_WRITE_INPUT,
		       at, name);
	else if (m->type != IEC_BOOL)
		report(c, DIAG_NOT_BOOL, at, name);
	else if (scope_is_condition(m))
		report(c, DIAG_SFC_TRANSITION, at, name);
	uses_add(c->uses, m, USE_READ | USE_WRITTEN);
}

/* A value of one of these classes; @needed: a type of them, NULL: BOOL. */
static void check_read(struct sfc_names *c, uint32_t id, struct spot at,
		       unsigned int class, const char *needed)
{
	const struct meaning *m = id ? find(c, id, at, EXPECT_VARIABLE) : NULL;
	const char *name = project_text(c->project, id);

	if (!m)
		return;
	if (value_fault(m) != DIAG_COUNT)
		report(c, value_fault(m), at, name);
	else if (m->type == IEC_NONE || !(iec_type_row(m->type)->class & class))
		report_type(c, at, name, needed);
	uses_add(c->uses, m, USE_READ);
}

static void check_uses(struct sfc_names *c)
{
	for (int i = 0; i < c->sfc->use_count; i++) {
		const struct sfc_use *use = &c->sfc->use[i];
		const struct spot at = { use->line, use->column };

		if (use->action < 0)
			check_written(c, use->operand, at, EXPECT_VARIABLE |
				      (use->kind == USE_ACTION ? EXPECT_ACTION : 0u));
		check_read(c, use->time, at, CLASS_TIME, "TIME");
	}
}

static void check_steps(struct sfc_names *c)
{
	for (int i = 0; i < c->sfc->step_count; i++) {
		const struct sfc_step *step = &c->sfc->step[i];
		const struct spot at = { step->line, step->column_at };

		check_read(c, step->min, at, CLASS_TIME, "TIME");
		check_read(c, step->max, at, CLASS_TIME, "TIME");
		check_written(c, step->alarm, at, EXPECT_VARIABLE);
	}
}

static void check_control(struct sfc_names *c)
{
	const struct spot at = { c->sfc->control_line, 0 };

	for (int i = 0; i < CONTROL_COUNT; i++)
		check_read(c, c->sfc->control[i], at,
			   i == CONTROL_FORCE ? ANY_INT : CLASS_BOOL,
			   i == CONTROL_FORCE ? "INT" : NULL);
}

/* Lists outside conditions cannot use TRANSITION. */
static void check_lists(struct sfc_names *c)
{
	for (int i = 0; i < c->sfc->action_count; i++) {
		const struct sfc_body *body = &c->sfc->action[i].body;

		for (int k = 0; body->kind == BODY_LIST && k < body->count; k++) {
			const struct il_line *line = &c->pou->il.line[body->first + k];
			const struct meaning *m;
			enum diag_id why;

			if (line->kind == IL_COMMENT || line->kind == IL_LABEL)
				continue;
			m = scope_find(c->scope, c->pou, line->operand, &why);
			if (m && scope_is_condition(m))
				report(c, DIAG_SFC_TRANSITION, (struct spot){
				       (int)line->line, line->col }, SFC_CONDITION);
		}
	}
}

bool check_sfc_names(struct scope *scope, const struct pou *pou, struct uses *uses,
		     struct arena *scratch, struct diag_list *diags)
{
	struct sfc_names c = { .scope = scope, .project = scope_project(scope),
			       .pou = pou, .sfc = pou->sfc, .uses = uses,
			       .diags = diags, .good = true };

	check_given(&c, scratch);
	check_uses(&c);
	check_steps(&c);
	check_control(&c);
	check_lists(&c);
	return c.good;
}
