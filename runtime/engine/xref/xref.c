/* SPDX-License-Identifier: MIT
 *
 * xref - goes through a project and notes what is used where.
 *
 * Each text that may hold names is handed to xref_scan; here is known what a cell, an
 * instruction or a line of the configuration does with it. Printing is xref_print.c's.
 */
#include "engine/xref/xref_walk.h"

#include "engine/model/args.h"

#include <string.h>

/* Of a folded name: the body in which it was a label last, and where, 1-based. */
struct xref_label {
	int body, at;
};

/* ---- targets ---- */

struct var_table *xref_table(struct project *project, int table)
{
	const int structure = table - project->pou_count - 1;

	if (table == 0)
		return &project->globals;
	if (table > 0 && table <= project->pou_count)
		return &project->pou[table - 1].vars;
	return structure >= 0 && structure < project->structure_count ?
	       &project->structure[structure].vars : NULL;
}

struct var *xref_var(struct project *project, const struct xref_target *target)
{
	struct var_table *table = target->what == XREF_VARIABLE ?
		xref_table(project, target->table) : NULL;

	return table && target->index >= 0 && target->index < table->count ?
	       &table->var[target->index] : NULL;
}

struct xref_target xref_variable(struct project *project, int table, int index)
{
	struct xref_target target = { XREF_VARIABLE, table, index, { 0 } };

	target.addr = xref_table(project, table)->var[index].at;
	return target;
}

static bool same_bits(struct iec_addr a, struct iec_addr b)
{
	return a.area == b.area && a.bits == b.bits && a.bit == b.bit &&
	       a.byte == b.byte;
}

bool xref_same(const struct xref_target *a, const struct xref_target *b)
{
	if (a->what != b->what)
		return false;
	if (a->what == XREF_ADDRESS)
		return same_bits(a->addr, b->addr);
	return a->table == b->table && a->index == b->index;
}

bool xref_touches(const struct xref_target *a, const struct xref_target *b)
{
	const uint32_t first = a->addr.byte * 8 + a->addr.bit;
	const uint32_t other = b->addr.byte * 8 + b->addr.bit;

	if (xref_same(a, b))
		return true;
	return a->addr.area != AREA_NONE && a->addr.area == b->addr.area &&
	       first < other + b->addr.bits && other < first + a->addr.bits;
}

/* ---- noting ---- */

struct xref_use *xref_add(struct xref_walk *walk, struct xref_target target,
			  enum xref_kind kind, uint32_t at, uint32_t len)
{
	struct xref_use *use = arena_push(&walk->out->arena, &walk->out->use,
					  &walk->out->count, sizeof(*use));

	if (!use)
		return NULL;
	*use = walk->place;
	use->target = target;
	use->kind = kind;
	use->slot = walk->slot;
	use->at = at;
	use->len = len;
	return use;
}

void xref_all(struct xref_walk *walk, uint32_t *slot, enum xref_kind kind)
{
	if (!*slot)
		return;
	walk->slot = slot;
	xref_scan(walk, 0, names_len(&walk->project->names, *slot), kind);
}

/* The whole text names @target. */
void xref_whole(struct xref_walk *walk, uint32_t *slot,
		      struct xref_target target, enum xref_kind kind)
{
	walk->slot = slot;
	xref_add(walk, target, kind, 0,
		 (uint32_t)names_len(&walk->project->names, *slot));
}

/* A name that the writer makes from a declaration. */
static void add_word(struct xref_walk *walk, enum word word, enum xref_kind kind)
{
	const struct word_row *row = words_row(&walk->project->words, word);
	struct xref_target target = { .what = XREF_POU, .index = row->owner };
	struct xref_use *use;

	if (!word_is_own(word) || row->owner < 0)
		return;
	if (row->kind == WORD_STRUCT)
		target.what = XREF_STRUCTURE;
	walk->slot = NULL;
	use = xref_add(walk, target, kind, 0, 0);
	if (use)
		use->unnamed = true;
}

/* ---- declarations ---- */

static void walk_table(struct xref_walk *walk, int number)
{
	struct var_table *table = xref_table(walk->project, number);

	for (int i = 0; i < vars_declared(table); i++) {
		struct var *var = &table->var[i];

		if (vars_flags(table, i) & VAR_RESULT)
			continue;
		walk->place.line = var->line;
		xref_whole(walk, &var->name, xref_variable(walk->project, number, i),
			  XREF_DECLARED);
		if (var->type == IEC_NONE)
			add_word(walk, var->fb, XREF_TYPE);
	}
}

static void begin_place(struct xref_walk *walk, int pou, const char *file, int line,
			bool included)
{
	walk->place = (struct xref_use){ .pou = pou, .file = file, .line = line,
					 .included = included };
}

/* The globals of an included file have its name nowhere: their block's part says it. */
static void mark_included(struct xref_walk *walk)
{
	const struct project *project = walk->project;

	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];
		const struct var_block *block;

		if (part->kind != PART_VARS || !part->included)
			continue;
		block = &project->globals.block[part->index];
		for (int k = 0; k < walk->out->count; k++) {
			struct xref_use *use = &walk->out->use[k];

			if (use->target.what == XREF_VARIABLE && !use->target.table &&
			    use->target.index >= block->first &&
			    use->target.index < block->first + block->count)
				use->included = true;
		}
	}
}

static bool structure_included(const struct project *project, int number)
{
	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (part->kind == PART_TYPES && number >= part->index &&
		    number < part->index + part->count)
			return part->included;
	}
	return false;
}

static void walk_declarations(struct xref_walk *walk)
{
	struct project *project = walk->project;

	begin_place(walk, -1, project->file, 0, false);
	walk_table(walk, 0);
	mark_included(walk);
	for (int i = 0; i < project->structure_count; i++) {
		struct structure *structure = &project->structure[i];
		struct xref_target target = { .what = XREF_STRUCTURE, .index = i };

		begin_place(walk, -1, structure->file, structure->line,
			    structure_included(project, i));
		xref_whole(walk, &structure->name, target, XREF_DECLARED);
		walk_table(walk, project->pou_count + 1 + i);
	}
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *pou = &project->pou[i];
		struct xref_target target = { .what = XREF_POU, .index = i };

		begin_place(walk, i, pou->file, pou->line, pou->included);
		xref_whole(walk, &pou->name, target, XREF_DECLARED);
		walk_table(walk, i + 1);
	}
}

/* ---- the configuration ---- */

static struct xref_target find_program(struct xref_walk *walk, uint32_t name)
{
	struct project *project = walk->project;
	struct xref_target target = { .what = XREF_UNKNOWN, .index = -1 };
	const uint32_t fold = names_fold(&project->names, name);

	for (int i = 0; i < project->pou_count; i++)
		if (names_fold(&project->names, project->pou[i].name) == fold)
			return (struct xref_target){ .what = XREF_POU, .index = i };
	return target;
}

static bool config_included(const struct project *project)
{
	for (int i = 0; i < project->part_count; i++)
		if (project->part[i].kind == PART_CONFIG)
			return project->part[i].included;
	return false;
}

static void walk_config(struct xref_walk *walk)
{
	struct config *config = walk->project->config;

	walk->pou = NULL;
	for (int i = 0; config && i < config->count; i++) {
		struct config_entry *entry = &config->entry[i];

		begin_place(walk, -1, config->file, entry->line,
			    config_included(walk->project));
		xref_all(walk, &entry->single, XREF_READ);
		if (entry->pou)
			xref_whole(walk, &entry->pou, find_program(walk, entry->pou),
				  XREF_RUN);
	}
}

/* ---- labels ---- */

static void note_label(struct xref_walk *walk, int pou, uint32_t *name, int at)
{
	const uint32_t fold = names_fold(&walk->project->names, *name);
	struct xref_target target = { XREF_LABEL, pou + 1, at - 1, { 0 } };

	if (!fold || fold >= walk->labels)
		return;
	if (walk->label[fold].body == walk->body) /* the second one: the first is meant */
		target.index = walk->label[fold].at - 1;
	else
		walk->label[fold] = (struct xref_label){ walk->body, at };
	xref_whole(walk, name, target, XREF_DECLARED);
}

static void add_jump(struct xref_walk *walk, uint32_t *name)
{
	const uint32_t fold = names_fold(&walk->project->names, *name);
	struct xref_target target = { XREF_LABEL, walk->place.pou + 1, -1, { 0 } };

	if (fold && fold < walk->labels &&
	    walk->label[fold].body == walk->body)
		target.index = walk->label[fold].at - 1;
	xref_whole(walk, name, target, XREF_JUMPED);
}

static void add_routine(struct xref_walk *walk, uint32_t *name)
{
	const struct pou *pou = scope_pou(walk->scope, walk->pou, *name);
	struct xref_target target = { .what = XREF_POU };

	if (!pou) {
		xref_all(walk, name, XREF_CALLED);
		return;
	}
	target.index = (int)(pou - walk->project->pou);
	xref_whole(walk, name, target, XREF_CALLED);
}

/* ---- cells ---- */

/* What the box does with the variable at its parameter. */
static enum xref_kind kind_of_value(enum pin_dir dir, bool output)
{
	if (dir == PIN_IN_OUT)
		return XREF_CHANGED;
	return output ? XREF_WRITTEN : XREF_READ;
}

static enum xref_kind kind_of_pin(enum pin_dir dir, bool output)
{
	if (dir == PIN_IN_OUT)
		return XREF_CHANGED;
	return output ? XREF_READ : XREF_WRITTEN;
}

static void walk_args(struct xref_walk *walk, struct cell *cell)
{
	const char *text = project_text(walk->project, cell->args), *next = text;
	struct arg arg;

	while (args_next(&next, &arg)) {
		enum pin_dir dir;
		struct xref_target target = xref_pin(walk, (enum word)cell->word,
						     arg.pin, arg.pin_len, &dir);

		walk->slot = &cell->args;
		if (target.what != XREF_UNKNOWN)
			xref_add(walk, target, kind_of_pin(dir, arg.output),
				 (uint32_t)(arg.pin - text), (uint32_t)arg.pin_len);
		xref_scan(walk, (size_t)(arg.value - text), arg.value_len,
			  kind_of_value(dir, arg.output));
	}
}

/* A further row of the box above. */
static void walk_pin(struct xref_walk *walk, struct rung *rung, int row, int col)
{
	struct cell *cell = rung_cell(rung, row, col);
	const char *name = project_text(walk->project, cell->operand);
	struct xref_target target;
	enum pin_dir dir;

	if (!cell->operand)
		return;
	while (row > 0 && rung_at(rung, row, col)->word == ELEM_PIN)
		row--;
	target = xref_pin(walk, (enum word)rung_at(rung, row, col)->word, name,
			  strlen(name), &dir);
	if (target.what != XREF_UNKNOWN)
		xref_whole(walk, &cell->operand, target, kind_of_pin(dir, false));
}

static enum xref_kind kind_of_write(enum op op, bool list)
{
	if (op == OP_S)
		return XREF_SET;
	if (op == OP_R)
		return XREF_RESET;
	return list ? XREF_WRITTEN : XREF_COIL;
}

static void walk_operand(struct xref_walk *walk, struct cell *cell,
			 const struct word_row *row)
{
	switch (row->operand) {
	case OPND_BOOL_R:
	case OPND_ANY_R:
	case OPND_EXPR:
		xref_all(walk, &cell->operand, XREF_READ);
		return;
	case OPND_BOOL_W:
		xref_all(walk, &cell->operand, kind_of_write(row->next, false));
		return;
	case OPND_ANY_W:
	case OPND_ASSIGN:
		xref_all(walk, &cell->operand, XREF_WRITTEN);
		return;
	case OPND_INSTANCE:
		xref_all(walk, &cell->operand, XREF_CALLED);
		return;
	case OPND_LABEL:
		if (cell->operand)
			add_jump(walk, &cell->operand);
		return;
	case OPND_ROUTINE:
		if (cell->operand)
			add_routine(walk, &cell->operand);
		return;
	case OPND_LOOP:
		walk->slot = &cell->operand;
		if (cell->operand)
			xref_loop(walk);
		return;
	case OPND_NONE:
	case OPND_PIN:
	case OPND_LOOP_END:
		return;
	}
}

static void walk_cell(struct xref_walk *walk, struct rung *rung, int row, int col)
{
	struct cell *cell = rung_cell(rung, row, col);

	if (cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE)
		return;
	walk->place.row = row + 1;
	walk->place.col = col + 1;
	walk->place.line = rung_line(rung, row + 1);
	if (cell->word == ELEM_PIN) {
		walk_pin(walk, rung, row, col);
		return;
	}
	add_word(walk, (enum word)cell->word, XREF_CALLED);
	walk_operand(walk, cell, words_row(&walk->project->words, (enum word)cell->word));
	if (cell->args)
		walk_args(walk, cell);
}

static void begin_rung(struct xref_walk *walk, struct pou *pou, int i)
{
	const struct rung *rung = pou->rung[i];

	begin_place(walk, (int)(pou - walk->project->pou), pou->file,
		    rung_line(rung, 0), pou->included);
	walk->place.rung = i + 1;
	walk->place.off = rung->off;
}

static void walk_rungs(struct xref_walk *walk, struct pou *pou, int first, int count)
{
	const int end = first + count;

	walk->body++;
	for (int i = first; i < end; i++) {
		begin_rung(walk, pou, i);
		note_label(walk, walk->place.pou, &pou->rung[i]->label, i + 1);
	}
	for (int i = first; i < end; i++) {
		struct rung *rung = pou->rung[i];

		begin_rung(walk, pou, i);
		for (int k = 0; k < rung->rows * rung->cols; k++)
			walk_cell(walk, rung, k / rung->cols, k % rung->cols);
	}
}

/* ---- lists ---- */

static void walk_call(struct xref_walk *walk, struct il_line *line)
{
	const struct meaning *m;
	enum diag_id why;

	add_routine(walk, &line->operand);
	m = scope_find(walk->scope, walk->pou, line->operand, &why);
	walk->call = m && m->kind == MEANING_INSTANCE ? (enum word)m->word : WORD_COUNT;
}

static void walk_op(struct xref_walk *walk, struct il_line *line)
{
	const enum operand_kind operand = op_row((enum op)line->op)->operand;

	if (!line->operand)
		return;
	if (operand == OPND_LABEL)
		add_jump(walk, &line->operand);
	else if (operand == OPND_INSTANCE)
		walk_call(walk, line);
	else if (operand == OPND_ANY_W || operand == OPND_BOOL_W)
		xref_all(walk, &line->operand, kind_of_write((enum op)line->op, true));
	else
		xref_all(walk, &line->operand, XREF_READ);
}

static void walk_arg(struct xref_walk *walk, struct il_line *line)
{
	const char *name = project_text(walk->project, line->pin);
	const bool output = line->kind == IL_ARG_OUT;
	enum pin_dir dir;
	struct xref_target target = xref_pin(walk, walk->call, name, strlen(name), &dir);

	if (target.what != XREF_UNKNOWN)
		xref_whole(walk, &line->pin, target, kind_of_pin(dir, output));
	xref_all(walk, &line->operand, kind_of_value(dir, output));
}

static void walk_line(struct xref_walk *walk, struct il_line *line)
{
	switch ((enum il_kind)line->kind) {
	case IL_OP:
		walk->call = WORD_COUNT;
		walk_op(walk, line);
		return;
	case IL_FN:
	case IL_CALL:
		walk->call = (enum word)line->word;
		add_word(walk, walk->call, XREF_CALLED);
		xref_all(walk, &line->operand, XREF_READ);
		return;
	case IL_ARG_IN:
	case IL_ARG_OUT:
		walk_arg(walk, line);
		return;
	case IL_CLOSE:
	case IL_LABEL:
	case IL_COMMENT:
	case IL_EACH:
	case IL_TARGET:
	case IL_TICK:
		return;
	}
}

/* A place of a text that is no ladder. */
void xref_begin(struct xref_walk *walk, const struct pou *pou, int line, int column)
{
	begin_place(walk, (int)(pou - walk->project->pou), pou->file, line,
		    pou->included);
	walk->place.row = line ? line - pou->line + 1 : 0;
	walk->place.col = column;
}

static void begin_line(struct xref_walk *walk, struct pou *pou, const struct il_line *line)
{
	xref_begin(walk, pou, (int)line->line, line->rung ? 0 : line->col);
}

static void walk_list(struct xref_walk *walk, struct pou *pou, int first, int count)
{
	const int end = first + count;

	walk->body++;
	for (int i = first; i < end; i++) {
		struct il_line *line = &pou->il.line[i];

		begin_line(walk, pou, line);
		if (line->kind == IL_LABEL)
			note_label(walk, walk->place.pou, &line->operand,
				   pou->rung_count + i + 1);
	}
	walk->call = WORD_COUNT;
	for (int i = first; i < end; i++) {
		begin_line(walk, pou, &pou->il.line[i]);
		walk_line(walk, &pou->il.line[i]);
	}
}

void xref_body(struct xref_walk *walk, struct pou *pou, const struct sfc_body *body)
{
	if (body->kind == BODY_LIST)
		walk_list(walk, pou, body->first, body->count);
	else
		walk_rungs(walk, pou, body->first, body->count);
}

/* ---- all ---- */

/* Labels and jumps are known by their folded name, which must exist beforehand. */
static bool make_labels(struct xref_walk *walk)
{
	struct names *names = &walk->project->names;

	walk->labels = (uint32_t)names->count;
	walk->label = arena_alloc(&walk->out->arena,
				  walk->labels * sizeof(*walk->label));
	return walk->label;
}

bool xref_make(struct xref *out, struct project *project)
{
	struct xref_walk walk = { .out = out, .project = project };

	*out = (struct xref){ .project = project };
	arena_init(&out->arena);
	walk.scope = scope_new(project, &out->arena);
	if (!walk.scope || !make_labels(&walk))
		return false;
	walk_declarations(&walk);
	walk_config(&walk);
	for (int i = 0; i < project->pou_count; i++) {
		walk.pou = &project->pou[i];
		if (project->pou[i].sfc) {
			xref_sfc(&walk, &project->pou[i]);
			continue;
		}
		walk_rungs(&walk, &project->pou[i], 0, project->pou[i].rung_count);
		walk_list(&walk, &project->pou[i], 0, project->pou[i].il.count);
	}
	return !out->arena.failed && !project->arena.failed;
}

void xref_free(struct xref *xref)
{
	arena_free(&xref->arena);
	*xref = (struct xref){ 0 };
}
