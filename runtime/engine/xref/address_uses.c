/* SPDX-License-Identifier: MIT
 *
 * address_uses - the memory that a project uses, without who uses it.
 *
 * A part of the cross reference, for whoever only asks which addresses are taken, and
 * asks at every key: no scope is made, and each text of the project is read once,
 * however often it is used.
 */
#include "engine/xref/xref.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/args.h"

#include <string.h>

/* Of a text: it was read whole, or as parameters. Of a folded name: it is declared. */
enum mark { SEEN_WHOLE = 1, SEEN_ARGS = 2, GLOBAL = 4, LOCAL = 8 };

struct walk {
	struct xref *out;
	const struct project *project;
	uint8_t *mark;           /* by string id                              */
	bool own;                /* the text may mean another in another POU  */
};

static struct xref_use *add(struct walk *walk, struct xref_target target,
			    enum xref_kind kind)
{
	struct xref_use *use = arena_push(&walk->out->arena, &walk->out->use,
					  &walk->out->count, sizeof(*use));

	if (use)
		*use = (struct xref_use){ .target = target, .kind = kind, .pou = -1 };
	return use;
}

static void walk_table(struct walk *walk, const struct var_table *table, int number)
{
	for (int i = 0; i < table->count; i++)
		if (table->var[i].at.area != AREA_NONE)
			add(walk, (struct xref_target){ XREF_VARIABLE, number, i,
							table->var[i].at },
			    XREF_DECLARED);
}

static void mark_table(struct walk *walk, const struct var_table *table, enum mark mark,
		       bool set)
{
	for (int i = 0; i < table->count; i++) {
		uint8_t *marks = &walk->mark[table->var[i].fold];

		*marks = (uint8_t)(set ? *marks | mark : *marks & ~mark);
	}
}

/* A variable may be called as an address is; then that is what is meant. */
static bool is_declared(struct walk *walk, const char *text, size_t len)
{
	walk->own = true;
	return walk->mark[names_find_any(&walk->project->names, text, len)] &
	       (GLOBAL | LOCAL);
}

/* An address, or a name of the system that has one. */
static bool is_address(struct walk *walk, const char *text, size_t len,
		       struct iec_addr *out)
{
	if (len > 4 && ascii_same(text, "SYS_", 4))
		for (int i = 0; i < SYS_COUNT; i++) {
			const struct sys_row *row = sys_row((enum sys_id)i);

			if (ascii_is(row->name, text, len))
				return iec_addr_parse(row->address, strlen(row->address),
						      out) == ADDR_OK;
		}
	return iec_addr_parse(text, len, out) == ADDR_OK &&
	       (text[0] == '%' || !is_declared(walk, text, len));
}

/* Most texts are one name: they need no scanner. */
static bool is_plain_name(const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (!ascii_digit(text[i]) && text[i] != '_' &&
		    !(ascii_upper(text[i]) >= 'A' && ascii_upper(text[i]) <= 'Z'))
			return false;
	return true;
}

static void scan(struct walk *walk, const char *text, size_t len)
{
	struct xref_use *last = NULL;
	struct iec_addr addr;
	struct lex lex;

	if (is_plain_name(text, len)) {
		if (is_address(walk, text, len, &addr))
			add(walk, (struct xref_target){ XREF_ADDRESS, 0, 0, addr },
			    XREF_READ);
		return;
	}
	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		const struct token *token = &lex.token;

		if (last && lex_is(&lex, "["))
			last->open = true;
		last = NULL;
		if ((token->kind == TOKEN_NAME || token->kind == TOKEN_ADDRESS) &&
		    is_address(walk, token->text, token->len, &addr))
			last = add(walk, (struct xref_target){ XREF_ADDRESS, 0, 0, addr },
				   XREF_READ);
	}
}

static void scan_whole(struct walk *walk, uint32_t id)
{
	if (!id || walk->mark[id] & SEEN_WHOLE)
		return;
	walk->own = false;
	scan(walk, project_text(walk->project, id), names_len(&walk->project->names, id));
	if (!walk->own)
		walk->mark[id] |= SEEN_WHOLE;
}

/* Only the values: a parameter may be called as an address is. */
static void scan_args(struct walk *walk, uint32_t id)
{
	const char *next;
	struct arg arg;

	if (!id || walk->mark[id] & SEEN_ARGS)
		return;
	walk->own = false;
	next = project_text(walk->project, id);
	while (args_next(&next, &arg))
		scan(walk, arg.value, arg.value_len);
	if (!walk->own)
		walk->mark[id] |= SEEN_ARGS;
}

/* Names of labels, routines and parameters are no memory. */
static bool is_memory(enum operand_kind operand)
{
	return operand != OPND_NONE && operand != OPND_LABEL &&
	       operand != OPND_PIN && operand != OPND_LOOP_END;
}

static void walk_rung(struct walk *walk, const struct rung *rung)
{
	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		if (!cell->operand && !cell->args)
			continue;
		if (is_memory(words_row(&walk->project->words,
					(enum word)cell->word)->operand))
			scan_whole(walk, cell->operand);
		scan_args(walk, cell->args);
	}
}

static void walk_list(struct walk *walk, const struct il *il)
{
	for (int i = 0; i < il->count; i++) {
		const struct il_line *line = &il->line[i];

		if (line->kind == IL_COMMENT || line->kind == IL_LABEL ||
		    (line->kind == IL_OP &&
		     !is_memory(op_row((enum op)line->op)->operand)))
			continue;
		scan_whole(walk, line->operand);
	}
}

static void walk_sfc(struct walk *walk, const struct sfc *sfc)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		scan_whole(walk, sfc->control[i]);
	for (int i = 0; i < sfc->step_count; i++) {
		scan_whole(walk, sfc->step[i].min);
		scan_whole(walk, sfc->step[i].max);
		scan_whole(walk, sfc->step[i].alarm);
	}
	for (int i = 0; i < sfc->use_count; i++) {
		if (sfc->use[i].action < 0)
			scan_whole(walk, sfc->use[i].operand);
		scan_whole(walk, sfc->use[i].time);
	}
}

static void walk_config(struct walk *walk, const struct config *config)
{
	for (int i = 0; config && i < config->count; i++)
		scan_whole(walk, config->entry[i].single);
}

bool xref_addresses(struct xref *out, struct project *project)
{
	struct walk walk = { .out = out, .project = project };

	*out = (struct xref){ .project = project };
	arena_init(&out->arena);
	walk.mark = arena_alloc(&out->arena, (size_t)project->names.count + 1);
	if (!walk.mark)
		return false;
	walk_table(&walk, &project->globals, 0);
	for (int i = 0; i < project->pou_count; i++)
		walk_table(&walk, &project->pou[i].vars, i + 1);
	mark_table(&walk, &project->globals, GLOBAL, true);
	walk_config(&walk, project->config);
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		mark_table(&walk, &pou->vars, LOCAL, true);
		for (int k = 0; k < pou->rung_count; k++)
			walk_rung(&walk, pou->rung[k]);
		walk_list(&walk, &pou->il);
		if (pou->sfc)
			walk_sfc(&walk, pou->sfc);
		mark_table(&walk, &pou->vars, LOCAL, false);
	}
	return !out->arena.failed;
}
