/* SPDX-License-Identifier: MIT
 *
 * check_names - declarations, labels, and whether what is declared is used.
 *
 * Lookups use folded names or indices, so that the cost is linear in the project.
 * check_operand looks at cells, check_il at types.
 */
#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/check/check.h"
#include "engine/check/access.h"
#include "engine/check/check_config.h"
#include "engine/check/check_fbd.h"
#include "engine/check/check_operand.h"
#include "engine/check/check_sfc.h"
#include "engine/check/check_sfc_names.h"
#include "engine/check/check_st.h"
#include "engine/check/reserved.h"
#include "engine/check/settle.h"
#include "engine/model/located.h"
#include "engine/model/named.h"
#include "engine/model/shape.h"
#include "engine/model/st.h"
#include "engine/model/init.h"

#include <stdio.h>
#include <string.h>

/* What a folded name is, apart from a variable. A number of a POU is 1-based. */
struct mark {
	int pou;        /* POU of this name */
	int label_in;   /* body in which it was a label last */
	int target_in;  /* body in which a jump named it last */
	int member_of;  /* structure that has it, 1-based, the last so far */
	bool reserved;
};

struct names_check {
	struct scope *scope;
	struct project *project;
	struct arena *scratch;
	struct diag_list *diags;
	struct uses uses;
	struct expr *expr;
	struct init_walk *walk;
	struct mark *mark; /* by folded name, for the names that exist at the start */
	uint32_t marks;
	int *end;          /* numbers of rungs that never fall through */
	int ends;
	int body;          /* number of the current body, from 1; a chart has many bodies */
	uint64_t located;  /* elements with an address                        */
	bool good;
};

static const char *text_of(const struct names_check *c, uint32_t id)
{
	return project_text(c->project, id);
}

/* @pou NULL: among the globals. */
static struct diag place_of(const struct names_check *c, enum diag_id id,
			    const struct pou *pou, int line)
{
	return (struct diag){ .id = id, .line = line,
		.file = pou ? pou->file : c->project->file,
		.pou = pou ? text_of(c, pou->name) : NULL };
}

/* Of the declaration of @var; @pou NULL: a global. */
static struct diag place_of_var(const struct names_check *c, enum diag_id id,
				const struct pou *pou, const struct var *var)
{
	const struct var_table *globals = &c->project->globals;
	struct diag place = place_of(c, id, pou, var->line);
	const struct var_block *block = pou || var < globals->var || var >= globals->var + globals->count ?
		NULL : vars_block(globals, (int)(var - globals->var));

	if (block && block->file)
		place.file = block->file;
	return place;
}

static void report_line(struct names_check *c, enum diag_id id,
			const struct pou *pou, int line, const char *arg)
{
	c->good &= diag_add(c->diags, place_of(c, id, pou, line), "%s", arg);
}

static void report_var(struct names_check *c, enum diag_id id,
		       const struct pou *pou, const struct var *var, const char *arg)
{
	c->good &= diag_add(c->diags, place_of_var(c, id, pou, var), "%s", arg);
}

/* @number 1-based; @row and @col 0-based, -1: the whole rung. */
static bool report_rung(struct names_check *c, enum diag_id id,
			const struct pou *pou, int number, int row, int col,
			uint32_t arg)
{
	struct diag place = {
		.id = id, .file = pou->file, .pou = text_of(c, pou->name),
		.line = rung_line(pou->rung[number - 1], row + 1),
		.rung = number, .row = row + 1, .col = col + 1,
	};
	bool good = diag_add(c->diags, place, "%s", text_of(c, arg));

	c->good &= good;
	return good;
}

/* ---- marks ---- */

static struct mark *mark_of(struct names_check *c, uint32_t fold)
{
	return fold && fold < c->marks ? &c->mark[fold] : NULL;
}

static uint32_t fold_text(struct names_check *c, const char *text)
{
	struct names *names = &c->project->names;

	return names_fold(names, names_intern(names, text, strlen(text)));
}

/* Folds every name that is looked up later, then makes the table. */
static bool make_marks(struct names_check *c)
{
	struct names *names = &c->project->names;

	for (int i = 0; reserved_word(i); i++)
		fold_text(c, reserved_word(i));
	for (int i = 0; i < c->project->pou_count; i++) {
		const struct pou *pou = &c->project->pou[i];

		names_fold(names, pou->name);
		for (int k = 0; k < pou->rung_count; k++)
			names_fold(names, pou->rung[k]->label);
	}
	for (int i = 0; i < c->project->structure_count; i++)
		names_fold(names, c->project->structure[i].name);
	c->marks = (uint32_t)names->count;
	c->mark = arena_alloc(c->scratch, c->marks * sizeof(*c->mark));
	if (!c->mark)
		return false;
	for (int i = 0; reserved_word(i); i++) {
		struct mark *mark = mark_of(c, fold_text(c, reserved_word(i)));

		if (mark)
			mark->reserved = true;
	}
	return true;
}

/* Plain IEC text has no rungs, whose words may be names there, and may have functions and blocks
 * with names of the catalogue. */
static bool is_reserved(struct names_check *c, const char *name, uint32_t fold)
{
	const struct mark *mark = mark_of(c, fold);

	return (mark && mark->reserved &&
		!(c->project->words.own_first && reserved_of_rungs(name))) ||
	       (strlen(name) >= 4 && ascii_same(name, "SYS_", 4)) ||
	       strchr(name, '.');
}

static bool is_taken(const struct names_check *c, const char *name)
{
	return !c->project->words.own_first && words_is_taken(name);
}

/* No cell and no instruction begins with the name of a type, so it may be R or LD. */
static bool is_taken_type(const struct names_check *c, const char *name)
{
	const size_t len = strlen(name);

	return is_taken(c, name) && word_find(name, len) != WORD_COUNT && !words_is_operator(name, len);
}

/* ---- namespaces ---- */

/* The NAMESPACE line around part @at of the file; -1: none. */
static int space_around(const struct project *project, int at)
{
	int open = 0;

	while (at-- > 0) {
		const struct part *part = &project->part[at];
		const char *text = part->kind == PART_SPACE ? project_text(project, part->text) : "";

		if (ascii_same(text, "END_", 4))
			open++;
		else if (ascii_same(text, "NAMESPACE", 9) && open-- == 0)
			return at;
	}
	return -1;
}

/* The part of the file with what a mark names: POU, structure, named type. */
static int part_of(const struct project *project, int marked)
{
	const int structure = marked - 1 - project->pou_count, named = structure - project->structure_count;

	for (int i = 0; named < 0 && i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if (structure < 0 ? part->kind == PART_POU && part->index == marked - 1 :
				    part->kind == PART_TYPES && structure >= part->index &&
				    structure < part->index + part->count)
			return i;
	}
	return named < 0 || named >= project->named_count ? 0 : project->named[named].part;
}

/* Two of one name: DUPLICATE_NAME, or that they stand in two namespaces. */
static enum diag_id twice_of(const struct names_check *c, int marked, int other)
{
	const struct project *project = c->project;

	if (!project->words.space_count || space_around(project, part_of(project, marked)) ==
	    space_around(project, part_of(project, other)))
		return DIAG_DUPLICATE_NAME;
	return DIAG_TWO_SPACES;
}

/* ---- declarations ---- */

static bool fits(const struct var *var)
{
	unsigned int bits = iec_type_row(var->type)->size * 8u;

	return var->at.bits == (var->type == IEC_BOOL ? 1 : bits);
}

/* Names that a box uses for its own parameters. */
static bool is_result(const char *name)
{
	return ascii_is("OUT", name, strlen(name));
}

/* In plain IEC text a program or block may declare EN and ENO, as variables like others. */
static bool may_be_power(const struct names_check *c, const struct pou *pou, const char *name)
{
	return c->project->words.own_first && pou && pou->language == LANGUAGE_ST &&
	       (pou->kind == POU_PROGRAM || pou->kind == POU_BLOCK) &&
	       (ascii_is("EN", name, strlen(name)) || ascii_is("ENO", name, strlen(name)));
}

/* Counts elements too; bounded, because each is looked at later. */
static bool is_inside(struct names_check *c, const struct var *var)
{
	const struct areas *areas = scope_areas(c->scope);
	uint64_t before = c->located;

	if (var->at.area == AREA_NONE)
		return true;
	if (!var->array.count)
		return areas_have(areas, var->at);
	c->located += var->array.count;
	if (before <= LIMIT_LOCATED && c->located > LIMIT_LOCATED)
		report_var(c, DIAG_TOO_MANY, NULL, var,
			    "elements with an address");
	return areas_have(areas, vars_shift(var->at, var->array.count - 1));
}

static void report_twice(struct names_check *c, const struct pou *pou,
			 const struct var *var, int first)
{
	c->good &= diag_add(c->diags, place_of_var(c, DIAG_DUPLICATE_NAME, pou, var),
			    "%.40s" DIAG_AND "%d", text_of(c, var->name), first);
}

bool init_report(const struct project *project, const struct var *var,
		 const struct init_walk *walk, struct diag_list *diags, struct diag place)
{
	char where[LIMIT_ARG], said[LIMIT_ARG];

	place.id = walk->why;
	init_where(walk, where, sizeof(where));
	init_say(walk, said, sizeof(said));
	return diag_add(diags, place, "%s%s%s%s", said, strstr(said, DIAG_AND) ? DIAG_AND :
			DIAG_AND DIAG_AND, project_text(project, var->name), where);
}

/* Does the text of @var's initial values, which has parts, fit its type?
 * @walk:    *@walk NULL or what an earlier call left there; from @scratch
 * @place:   of the declaration
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false after one diagnostic.
 */
static bool check_init(const struct project *project, const struct var *var,
		       struct init_walk **walk, struct arena *scratch,
		       struct diag_list *diags, struct diag place)
{
	struct init_value value;

	if (!*walk)
		*walk = arena_alloc(scratch, sizeof(**walk));
	if (!*walk)
		return false; /* the caller reports that memory is out */
	init_begin(*walk, project, var, scratch);
	while (init_next(*walk, &value))
		continue;
	return (*walk)->why == DIAG_COUNT ||
	       init_report(project, var, *walk, diags, place);
}

/* Constants in the text of a declaration are read. */
static void note_text(struct names_check *c, const struct pou *pou, uint32_t id)
{
	struct names *names = &c->project->names;
	const struct meaning *m;
	enum diag_id why;
	struct lex lex;

	lex_init(&lex, names_text(names, id), names_len(names, id));
	lex_next(&lex);
	while (lex.token.kind != TOKEN_END) {
		const struct token token = lex.token;

		lex_next(&lex);
		if (token.kind != TOKEN_NAME || lex_is(&lex, ":="))
			continue;
		m = scope_find(c->scope, pou, names_intern(names, token.text, token.len), &why);
		if (m && m->kind == MEANING_VARIABLE)
			uses_add(&c->uses, m, USE_READ);
	}
}

/* Numbers of an enumeration: (Red := Base, Green := Base + 1). */
static void note_values(struct names_check *c, const struct pou *pou, const struct var *var)
{
	const struct project *project = c->project;
	const struct enumeration *list = &project->enumeration[var->enumeration - 1];

	for (int i = list->first; i < list->first + list->count; i++)
		if (project->enum_value[i].written && project->enum_value[i].text)
			note_text(c, pou, project->enum_value[i].text);
}

static void note_declaration(struct names_check *c, const struct pou *pou, const struct var *var)
{
	if (var->enumeration && !var->named)
		note_values(c, pou, var);
	if (!var->written)
		return;
	note_text(c, pou, var->written->bound[0]);
	note_text(c, pou, var->written->bound[1]);
	for (int i = 0; var->written->dim && i < var->own_dims; i++) {
		note_text(c, pou, var->written->dim[i][0]);
		note_text(c, pou, var->written->dim[i][1]);
	}
	note_text(c, pou, var->written->capacity);
	note_text(c, pou, var->written->range[0]);
	note_text(c, pou, var->written->range[1]);
	if (var->written->initial)
		note_text(c, pou, var->init_text);
}

static void report_outside(struct names_check *c, const struct var *var, int64_t number,
			   struct diag place)
{
	char has[LIMIT_ARG];

	place.id = DIAG_OUTSIDE;
	named_print(c->project, var, has, sizeof(has));
	c->good &= diag_add(c->diags, place, "%.40s" DIAG_AND "%lld" DIAG_AND "%.60s",
			    text_of(c, var->name), (long long)number, has);
}

/* The initial values of an enumeration or subrange. */
static void check_range(struct names_check *c, const struct var *var, struct diag place)
{
	if (!var->has_init || var->inherits || (!var->enumeration && !var->range))
		return;
	if (!var->array.count && !named_may_hold(c->project, var, var->init.i))
		report_outside(c, var, var->init.i, place);
	for (int i = 0; var->array.count && i < var->init_count; i++)
		if (!named_may_hold(c->project, var, var->init_list[i].value.i))
			report_outside(c, var, var->init_list[i].value.i, place);
}

/* := REF(Name) */
static void check_points(struct names_check *c, const struct pou *pou, const struct var *var)
{
	const uint32_t name = names_intern(&c->project->names, text_of(c, var->points->text) + 1,
					   strlen(text_of(c, var->points->text)) - 1);
	const struct meaning *m;
	enum diag_id why;

	m = scope_find(c->scope, pou, name, &why);
	if (m && scope_find(c->scope, pou, var->points->text, &why))
		uses_add(&c->uses, m, USE_READ | USE_WRITTEN);
	else
		report_var(c, why, pou, var, text_of(c, name));
}

/* A structure begins with a byte, and all of it is in the area. */
static void check_address_of_whole(struct names_check *c, const struct var *var, struct diag place)
{
	const struct word_row *row = words_row(&c->project->words, var->fb);
	const uint64_t size = shape_of_var(&c->project->words, var).size;
	const uint32_t most = scope_areas(c->scope)->bytes[var->at.area];

	place.id = row->kind != WORD_STRUCT || row->texts || row->unions ? DIAG_AT_HOLDS :
		   var->at.bits == 1 && var->at.bit ? DIAG_AT_TYPE :
		   size > most || var->at.byte > most - size ? DIAG_BAD_ADDRESS : DIAG_COUNT;
	if (place.id != DIAG_COUNT)
		c->good &= diag_add(c->diags, place, "%s", text_of(c, var->name));
}

static void check_address(struct names_check *c, const struct var *var, struct diag place)
{
	if (var->type == IEC_NONE) {
		check_address_of_whole(c, var, place);
		return;
	}
	place.id = DIAG_BAD_ADDRESS;
	if (!is_inside(c, var))
		c->good &= diag_add(c->diags, place, "%s", text_of(c, var->name));
	place.id = DIAG_AT_TYPE;
	if (!fits(var))
		c->good &= diag_add(c->diags, place, "%s", text_of(c, var->name));
}

/* Of its own, or from VAR_CONFIG? */
static bool has_address(const struct names_check *c, const struct var *var)
{
	const char *text = text_of(c, var->at_text);

	return var->at.area != AREA_NONE && !(*text && text[strlen(text) - 1] == '*');
}

/* The part that a line of VAR_CONFIG gives a value. */
/* Has the block that @to is within a task of its own? Without an instance the path names the program: the first
 * one that runs. */
static bool has_block_task(struct names_check *c, const struct located *to)
{
	struct project *project = c->project;
	const size_t len = strcspn(to->text, ".[");

	for (int i = 0; i < project->config->count; i++) {
		const struct config_entry *entry = &project->config->entry[i];
		const bool same = to->instance ? entry == to->instance : entry->kind == CONFIG_PROGRAM &&
				  !project_is_further(project, entry) && names_fold(&project->names, entry->pou) ==
				  names_fold(&project->names, project->pou[to->pou].name);

		for (int k = 0; same && k < entry->calls; k++)
			if (name_is(text_of(c, entry->called[k].name), to->text, len))
				return true;
	}
	return false;
}

static void check_located_part(struct names_check *c, const struct var *line, const struct located *to)
{
	struct project *project = c->project;
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, &project->pou[to->pou], scope_within(c->scope, to->text), &why);
	const char *open = m && m->like ? text_of(c, m->like->at_text) : "", *at = text_of(c, line->at_text);
	const size_t len = strlen(open);

	if (!m || m->type == IEC_NONE || m->type == IEC_STRING || m->kind == MEANING_ARRAY || m->constant ||
	    m->addr.area != AREA_NONE || meaning_is_indexed(m) || (m->like && m->like->target))
		c->good &= located_report(project, line, DIAG_NO_LOCATED, "", "", c->diags);
	else if (m->type != line->type)
		c->good &= located_report(project, line, DIAG_LOCATED_TYPE, iec_type_row(m->type)->word,
					  iec_type_row(line->type)->word, c->diags);
	else if (line->at_text && len && (open[len - 1] != '*' || strlen(at) < len || !ascii_same(open, at, len - 1)))
		c->good &= located_report(project, line, DIAG_LOCATED_AT, open, at, c->diags);
	else if (line->at_text && has_block_task(c, to))
		c->good &= located_report(project, line, DIAG_BLOCK_TASK_AT, "", "", c->diags);
	else
		uses_add(&c->uses, m, line->at.area == AREA_Q ? USE_READ : USE_WRITTEN);
}

/* VAR_CONFIG */
static void check_located(struct names_check *c)
{
	for (int i = 0; i < c->project->located.count; i++) {
		const struct var *line = &c->project->located.var[i];
		struct located to;

		if (has_address(c, line))
			check_address(c, line, (struct diag){ .file = c->project->config->file,
							      .line = line->line });
		if (located_find(c->project, text_of(c, line->name), &to) && to.part)
			check_located_part(c, line, &to);
		else if (located_is_whole(line) && init_has_parts(line))
			c->good &= check_init(c->project, line, &c->walk, c->scratch, c->diags,
					      (struct diag){ .file = c->project->config->file, .line = line->line });
	}
}

static const char *const pointer_words[] = { "POINTER", "REF_TO", "REFERENCE" };

/* A REFERENCE TO is what it leads to, so nothing leads to itself. */
static bool leads_well(const struct var *like)
{
	return !like->target || like->target->word != REFERENCE_TO;
}

/* Is what has the name of a global a program, a subroutine or an action? The place of a name tells a variable from a
 * type, a block or a function. */
static bool is_run_by_name(const struct names_check *c, int marked)
{
	const enum pou_kind kind = marked <= c->project->pou_count ? c->project->pou[marked - 1].kind : POU_BLOCK;

	return kind != POU_BLOCK && kind != POU_FUNCTION;
}

static void check_var(struct names_check *c, const struct pou *pou,
		      const struct var_table *table, int index, uint16_t flags)
{
	int twice = scope_duplicate(c->scope, pou, index);
	const struct var *var = &table->var[index];
	const char *name = text_of(c, var->name);
	const struct mark *mark = mark_of(c, var->fold);
	const struct diag place = place_of_var(c, DIAG_COUNT, pou, var);
	struct iec_addr addr;

	if (twice >= 0)
		report_twice(c, pou, var, table->var[twice].line);
	else if (!pou && mark && mark->pou && is_run_by_name(c, mark->pou))
		report_var(c, DIAG_DUPLICATE_NAME, pou, var, name);
	if (vars_is_eno(table, index))
		return;
	/* The printed list of `ladder il` declares its temporaries. */
	if (var_is_nameless(var))
		; /* its name is an address */
	else if ((is_reserved(c, name, var->fold) && !may_be_power(c, pou, name)) ||
	    (reserved_generated(name) && !(pou && pou->language == LANGUAGE_IL)) ||
	    (pou && pou->kind == POU_FUNCTION && is_result(name) && !c->project->words.own_first))
		report_var(c, DIAG_RESERVED_NAME, pou, var, name);
	else if (iec_addr_parse(name, strlen(name), &addr) != ADDR_NONE)
		report_var(c, DIAG_SHADOWS_ADDRESS, pou, var, name);
	if (has_address(c, var))
		check_address(c, var, place);
	note_declaration(c, pou, var);
	if (flags & VAR_CONSTANT && !var->has_init)
		report_var(c, c->project->words.own_first ? DIAG_CONSTANT_BY_TYPE :
			   DIAG_CONSTANT_NO_VALUE, pou, var, name);
	if (var->points)
		check_points(c, pou, var);
	if (var->target && !leads_well(var->target->like))
		report_line(c, DIAG_POINTER_TYPE, pou, var->line, pointer_words[var->target->word]);
	check_range(c, var, place);
	if (init_has_parts(var))
		c->good &= check_init(c->project, var, &c->walk, c->scratch, c->diags,
				      place);
}

/* ARRAY[1..N] is ARRAY[1..3] if N is 3. */
static bool is_same_array(const struct var *a, const struct var *b)
{
	return a->array.count && a->array.count == b->array.count && a->array.low == b->array.low &&
	       vars_same_bounds(a->dim, a->dims, b->dim, b->dims) && a->type == b->type && a->fb == b->fb &&
	       a->capacity == b->capacity && a->named == b->named && !a->target && !b->target &&
	       a->enumeration == b->enumeration && !a->range && !b->range;
}

/* VAR_EXTERNAL: a global of this name and type. */
static void check_external(struct names_check *c, const struct pou *pou)
{
	for (int i = 0; i < pou->external.count; i++) {
		const struct var *var = &pou->external.var[i];
		const int global = vars_find(&c->project->globals, var->fold);
		char wanted[LIMIT_ARG], is[LIMIT_ARG];

		if (global < 0) {
			report_var(c, DIAG_NO_GLOBAL, pou, var, text_of(c, var->name));
			continue;
		}
		project_print_type(c->project, var, wanted, sizeof(wanted));
		project_print_type(c->project, &c->project->globals.var[global], is, sizeof(is));
		if (strcmp(wanted, is) != 0 && !is_same_array(var, &c->project->globals.var[global]))
			c->good &= diag_add(c->diags, place_of_var(c, DIAG_OTHER_GLOBAL, pou, var),
					    "%s" DIAG_AND "%s" DIAG_AND "%s", text_of(c, var->name),
					    is, wanted);
	}
}

static void check_table(struct names_check *c, const struct pou *pou,
			const struct var_table *table)
{
	for (int i = 0; i < table->block_count; i++) {
		const struct var_block *block = &table->block[i];

		for (int k = 0; !(block->flags & VAR_SFC) && k < block->count; k++)
			check_var(c, pou, table, block->first + k,
				  block->flags);
	}
}

static void report_struct(struct names_check *c, enum diag_id id,
			  const struct structure *structure, int line,
			  uint32_t name)
{
	struct diag place = { .id = id, .line = line, .file = structure->file };

	c->good &= diag_add(c->diags, place, "%s", text_of(c, name));
}

static void check_members(struct names_check *c, int number)
{
	const struct structure *structure = &c->project->structure[number - 1];

	for (int i = 0; i < structure->vars.count; i++) {
		const struct var *var = &structure->vars.var[i];
		struct mark *mark = mark_of(c, var->fold);

		if (mark && mark->member_of == number)
			report_struct(c, DIAG_DUPLICATE_NAME, structure,
				      var->line, var->name);
		if (mark)
			mark->member_of = number;
		note_declaration(c, NULL, var);
		if (var->target && !leads_well(var->target->like))
			c->good &= diag_add(c->diags, (struct diag){ .id = DIAG_POINTER_TYPE,
				.line = var->line, .file = structure->file }, "%s",
				pointer_words[var->target->word]);
		check_range(c, var, (struct diag){ .line = var->line, .file = structure->file });
		if (init_has_parts(var))
			c->good &= check_init(c->project, var, &c->walk, c->scratch,
				c->diags, (struct diag){ .line = var->line,
				.file = structure->file });
	}
}

static void check_structures(struct names_check *c)
{
	struct project *project = c->project;

	for (int i = 0; i < project->structure_count; i++) {
		const struct structure *structure = &project->structure[i];
		uint32_t fold = names_fold(&project->names, structure->name);
		struct mark *mark = mark_of(c, fold);
		const char *name = text_of(c, structure->name);

		if (!structure->name) {
			check_members(c, i + 1);
			continue;
		}
		if (is_reserved(c, name, fold) || is_taken_type(c, name))
			report_struct(c, DIAG_RESERVED_NAME, structure,
				      structure->line, structure->name);
		if (mark && mark->pou)
			report_struct(c, twice_of(c, mark->pou, project->pou_count + i + 1), structure,
				      structure->line, structure->name);
		else if (mark)
			mark->pou = project->pou_count + i + 1;
		check_members(c, i + 1);
	}
}

static void report_named(struct names_check *c, enum diag_id id, const struct named_type *type)
{
	c->good &= diag_add(c->diags, (struct diag){ .id = id, .line = type->line,
			    .file = type->file }, "%s", text_of(c, type->name));
}

static void check_named(struct names_check *c)
{
	const struct project *project = c->project;

	for (int i = 0; i < project->named_count; i++) {
		const struct named_type *type = &project->named[i];
		const char *name = text_of(c, type->name);
		struct mark *mark = mark_of(c, type->fold);

		if (!type->like.var)
			continue;
		if (is_reserved(c, name, type->fold) || is_taken_type(c, name))
			report_named(c, DIAG_RESERVED_NAME, type);
		if (mark && mark->pou)
			report_named(c, twice_of(c, mark->pou, project->pou_count + project->structure_count + i + 1), type);
		else if (mark)
			mark->pou = project->pou_count + project->structure_count + i + 1;
		note_declaration(c, NULL, type->like.var);
		check_range(c, type->like.var, (struct diag){ .line = type->line,
			    .file = type->file });
	}
}

/* The action of a POU that there is; its name is one like others. */
static void check_action(struct names_check *c, const struct pou *pou)
{
	const char *name = text_of(c, pou->name), *own = pou_own_name(c->project, pou);
	const uint32_t id = names_intern(&c->project->names, own, strlen(own));
	char owner[LIMIT_ARG];

	if (!pou->name) /* the reader has reported it */
		return;
	if (pou_owner(c->project, pou) < 0) {
		snprintf(owner, sizeof(owner), "%.*s", own == name ? 60 : (int)(own - name) - 1, name);
		report_line(c, DIAG_UNKNOWN_NAME, pou, pou->line, owner);
	} else if (pou_has_any_bounds(&c->project->pou[pou_owner(c->project, pou)])) {
		report_line(c, DIAG_ANY_BOUNDS_ACTION, pou, pou->line, name);
	} else if (is_reserved(c, own, names_fold(&c->project->names, id))) {
		report_line(c, DIAG_RESERVED_NAME, pou, pou->line, own);
	}
}

static void check_pous(struct names_check *c)
{
	struct project *project = c->project;

	if (project->pou_count == 0 && project->structure_count == 0 && project->named_count == 0 &&
	    (project->globals.count == 0 || project->config || !project->words.own_first))
		report_line(c, DIAG_NO_PROGRAM, NULL, 0, "");
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];
		uint32_t fold = names_fold(&project->names, pou->name);
		struct mark *mark = mark_of(c, fold);
		const char *name = text_of(c, pou->name);

		if (pou->kind == POU_ACTION)
			check_action(c, pou);
		else if (is_reserved(c, name, fold) || (pou_has_frame(pou) && is_taken(c, name)))
			report_line(c, DIAG_RESERVED_NAME, pou, pou->line,
				    name);
		if (mark && mark->pou && !pou->copy_of)
			report_line(c, twice_of(c, mark->pou, i + 1), pou, pou->line, name);
		else if (mark && !mark->pou)
			mark->pou = i + 1;
	}
}

/* ---- labels and reach ---- */

static bool is_flow(enum word word)
{
	return word_row(word)->next == OP_JMP || word_row(word)->next == OP_RET;
}

/* Only bare wire between the rail and this cell, in its own row. */
static bool is_at_rail(const struct rung *rung, int row, int col)
{
	while (col > 0 && rung_at(rung, row, col - 1)->word == ELEM_WIRE)
		col--;
	return col == 0;
}

static bool check_label(struct names_check *c, const struct pou *pou, int rung_number)
{
	uint32_t label = pou->rung[rung_number - 1]->label;
	struct mark *mark = mark_of(c, names_fold(&c->project->names, label));
	bool good = true;

	if (!mark)
		return true;
	if (mark->label_in == c->body)
		good = report_rung(c, DIAG_DUPLICATE_LABEL, pou, rung_number,
				   -1, -1, label);
	if (reserved_generated(text_of(c, label)))
		good = report_rung(c, DIAG_RESERVED_NAME, pou, rung_number, -1,
				   -1, label);
	mark->label_in = c->body;
	return good;
}

/* Jumps of a rung: their labels, and whether the rung always ends with one. */
static bool check_jumps(struct names_check *c, const struct pou *pou, int rung_number)
{
	const struct rung *rung = pou->rung[rung_number - 1];
	bool good = true, ends = false;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		int row = i / rung->cols, col = i % rung->cols;
		struct mark *mark;

		if (!is_flow((enum word)cell->word))
			continue;
		ends |= is_at_rail(rung, row, col);
		if (word_row((enum word)cell->word)->operand != OPND_LABEL)
			continue;
		mark = mark_of(c, names_fold(&c->project->names,
					     cell->operand));
		if (mark && mark->label_in == c->body)
			mark->target_in = c->body;
		else
			good = report_rung(c, DIAG_NO_LABEL, pou, rung_number,
					   row, col, cell->operand);
	}
	if (ends) {
		int *end = arena_push(c->scratch, &c->end, &c->ends,
				      sizeof(*c->end));

		if (end)
			*end = rung_number;
	}
	return good;
}

/* The rungs behind one that always ends, up to the next label jumped to. */
static void check_reach(struct names_check *c, const struct pou *pou, int end)
{
	int told = 0;

	for (int i = 0; i < c->ends; i++) {
		if (c->end[i] <= told)
			continue;
		for (int k = c->end[i] + 1; k <= end; k++) {
			const struct rung *rung = pou->rung[k - 1];
			const struct mark *mark = mark_of(c,
				names_fold(&c->project->names, rung->label));

			if (rung->off)
				continue;
			if (mark && mark->target_in == c->body)
				break;
			told = k;
			report_rung(c, DIAG_UNREACHABLE, pou, k, -1, -1,
				    rung->label);
		}
	}
}

static void mark_bad(uint8_t *bad, int rung_number, bool good)
{
	if (bad && !good)
		bad[rung_number - 1] = 1;
}

/* Rungs that stand together: @first is the number, 0-based, of the first in @pou. @condition: they are
 * that of a transition; or NULL. */
static void check_ladder(struct names_check *c, const struct pou *pou, int first,
			 int count, const struct sfc_body *condition, uint8_t *bad)
{
	const int end = first + count;
	struct operand_check operands = {
		.scope = c->scope, .project = c->project, .uses = &c->uses,
		.expr = c->expr, .diags = c->diags, .pou = pou,
		.condition = condition != NULL,
		.statement = condition && condition->kind == BODY_EXPRESSION,
	};

	c->body++;
	c->ends = 0;
	c->end = NULL;
	for (int i = first + 1; i <= end; i++)
		if (!pou->rung[i - 1]->off)
			mark_bad(bad, i, check_label(c, pou, i));
	for (int i = first + 1; i <= end; i++) {
		if (pou->rung[i - 1]->off)
			continue;
		mark_bad(bad, i, check_jumps(c, pou, i));
		operands.rung = pou->rung[i - 1];
		operands.number = i;
		mark_bad(bad, i, check_operands(&operands));
		c->good &= operands.good;
	}
	check_reach(c, pou, end);
	c->good &= check_loops(c->project, pou, first, count, bad, c->diags);
}

static bool check_statements(struct names_check *c, const struct pou *pou, int first, int count)
{
	struct operand_check operands = {
		.scope = c->scope, .project = c->project, .uses = &c->uses,
		.expr = c->expr, .diags = c->diags, .pou = pou, .statement = true,
	};
	const bool good = check_st(&operands, first, count);

	c->good &= good;
	return good;
}

/* Statements that are a body. One with errors is not translated. */
static void check_text(struct names_check *c, const struct pou *pou, int first, int count, uint8_t *bad)
{
	if (!check_statements(c, pou, first, count) && bad)
		bad[pou->rung_count] = 1;
}

/* A body of networks. One with errors is not translated. */
static void check_networks(struct names_check *c, const struct pou *pou, uint8_t *bad)
{
	struct operand_check operands = {
		.scope = c->scope, .project = c->project, .uses = &c->uses,
		.expr = c->expr, .diags = c->diags, .pou = pou, .statement = true,
	};

	if (check_fbd(&operands, c->scratch))
		return;
	c->good = false;
	if (bad)
		bad[pou->rung_count] = 1;
}

/* Statements of EXECUTE boxes. */
static void check_boxes(struct names_check *c, const struct pou *pou, uint8_t *bad)
{
	for (int i = 0; i < pou->boxed_count; i++) {
		const struct boxed *boxed = &pou->boxed[i];

		if (boxed->rung >= 0 && !pou->rung[boxed->rung]->off)
			mark_bad(bad, boxed->rung + 1,
				 check_statements(c, pou, boxed->first, boxed->count));
	}
}

/* Nothing jumps from one condition or action into another. */
static void check_whole_sfc(struct names_check *c, const struct pou *pou, uint8_t *bad)
{
	const struct sfc *sfc = pou->sfc;
	bool good;

	for (int i = 0; i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (body->kind != BODY_LIST && body->kind != BODY_ST)
			check_ladder(c, pou, body->first, body->count,
				     i < sfc->transition_count ? body : NULL, bad);
	}
	for (int i = 0; i < sfc->action_count; i++)
		if (sfc->action[i].body.kind == BODY_ST)
			check_text(c, pou, sfc->action[i].body.first, sfc->action[i].body.count, bad);
	check_boxes(c, pou, bad);
	good = check_sfc_names(c->scope, pou, &c->uses, c->scratch, c->diags);
	good &= check_sfc(c->scope, pou, c->scratch, c->diags);
	c->good &= good;
	if (bad && !good)
		bad[pou->rung_count] = 1;
}

static unsigned int use_of_operand(enum operand_kind operand)
{
	switch (operand) {
	case OPND_BOOL_R:
	case OPND_ANY_R:
	case OPND_EXPR:
		return USE_READ;
	case OPND_BOOL_W:
	case OPND_ANY_W:
		return USE_WRITTEN;
	case OPND_INSTANCE:
		return USE_CALLED;
	case OPND_NONE:
	case OPND_LABEL:
	case OPND_ROUTINE:
	case OPND_EXECUTE:
	case OPND_ASSIGN:
	case OPND_PIN:
	case OPND_LOOP:
	case OPND_LOOP_END:
		return 0;
	}
	return 0;
}

static unsigned int use_of_line(const struct il_line *line)
{
	switch ((enum il_kind)line->kind) {
	case IL_OP:
		return use_of_operand(op_row((enum op)line->op)->operand);
	case IL_FN:
	case IL_ARG_IN:
		return USE_READ;
	case IL_ARG_OUT:
		return USE_WRITTEN;
	case IL_CALL:
	case IL_CLOSE:
	case IL_LABEL:
	case IL_COMMENT:
	case IL_EACH:
	case IL_TARGET:
	case IL_TICK:
		return 0;
	}
	return 0;
}

/* Only notes the uses; check_il reports errors. */
static void note_il(struct names_check *c, const struct pou *pou)
{
	for (int i = 0; i < pou->il.count; i++) {
		const struct il_line *line = &pou->il.line[i];
		unsigned int use = use_of_line(line);
		const struct meaning *m;
		char told[LIMIT_PARTS];
		enum diag_id why;

		if (!use || !line->operand)
			continue;
		m = scope_find(c->scope, pou, line->operand, &why);
		if (m && operand_special(text_of(c, line->operand), m, told, sizeof(told)))
			report_line(c, DIAG_SET_BY_OTHERS, pou, (int)line->line, told);
		if (m)
			uses_add_index(&c->uses, c->scope, pou, line->operand, m);
		if (m && m->kind == MEANING_INSTANCE && m->action) /* an action may be called beside its block */
			use = USE_READ | USE_WRITTEN;
		if (m && uses_add(&c->uses, m, use))
			report_line(c, DIAG_INSTANCE_TWICE, pou,
				    (int)line->line, text_of(c, line->operand));
	}
}

/* The warning for a declared variable; DIAG_COUNT: none. A variable with an address may be
 * read from outside; an instance counts as written by its call. */
static enum diag_id judge_use(const struct var *var, unsigned int use,
			      uint16_t flags)
{
	bool outside = var->at.area != AREA_NONE ||
		       flags & (VAR_OUTPUT | VAR_IN_OUT | VAR_RESULT);
	bool given = var->has_init || flags & (VAR_CONSTANT | VAR_INPUT | VAR_IN_OUT) ||
		     (var->at.area != AREA_NONE &&
		      iec_area_row(var->at.area)->access == ACCESS_READ);

	if (use & USE_PASSED)
		use |= USE_WRITTEN;
	if (use & USE_CALLED || var_is_nameless(var))
		return DIAG_COUNT;
	if (!use)
		return DIAG_UNUSED;
	if (var->type == IEC_NONE)
		return use & USE_WRITTEN || given ? DIAG_COUNT :
						    DIAG_NEVER_WRITTEN;
	if (!(use & USE_WRITTEN) && !given)
		return DIAG_NEVER_WRITTEN;
	return use & USE_READ || outside ? DIAG_COUNT : DIAG_NEVER_READ;
}

static void check_uses(struct names_check *c, int table_number)
{
	const struct pou *pou = table_number ?
				&c->project->pou[table_number - 1] : NULL;
	const struct var_table *table = pou ? &pou->vars : &c->project->globals;

	for (int i = 0; i < table->block_count && !(pou && pou_has_any_bounds(pou)); i++) {
		const struct var_block *block = &table->block[i];

		int end = block->first + block->count;

		for (int k = block->first; !(block->flags & VAR_SFC) && k < end; k++) {
			const struct var *var = &table->var[k];
			unsigned int use = uses_of(&c->uses, table_number, k,
						   var);
			enum diag_id lack = judge_use(var, use, block->flags);

			if (lack == DIAG_COUNT && use & USE_WRITTEN && block->flags & VAR_INPUT && pou &&
			    pou->kind != POU_PROGRAM && !c->project->words.own_first)
				lack = DIAG_OWN_INPUT;
			if (lack != DIAG_COUNT && !vars_is_eno(table, k) &&
			    !(pou && pou->no_result && k == 0) &&
			    scope_duplicate(c->scope, pou, k) < 0)
				report_var(c, lack, pou, var,
					    text_of(c, var->name));
		}
	}
}

static void check_bodies(struct names_check *c, uint8_t *const *bad)
{
	for (int i = 0; i < c->project->pou_count; i++) {
		const struct pou *pou = &c->project->pou[i];

		if (pou_has_any_bounds(pou)) /* its copies are checked */
			continue;
		check_table(c, pou, &pou->vars);
		check_external(c, pou);
		note_il(c, pou);
		if (pou->sfc)
			check_whole_sfc(c, pou, bad ? bad[i] : NULL);
		else if (pou->language == LANGUAGE_ST && pou->st)
			check_text(c, pou, 0, pou->st->count, bad ? bad[i] : NULL);
		else if (pou->fbd)
			check_networks(c, pou, bad ? bad[i] : NULL);
		else
			check_ladder(c, pou, 0, pou->rung_count, NULL,
				     bad ? bad[i] : NULL);
		if (!pou->sfc)
			check_boxes(c, pou, bad ? bad[i] : NULL);
	}
}

/* Has @pou the variable that a line of the CONFIGURATION names? Reports the name if not. */
__attribute__((noinline))
static bool has_value(struct names_check *c, const struct config_entry *entry, const struct pou *pou,
		      const struct st_item *item)
{
	struct names *names = &c->project->names;
	const char *text = text_of(c, item->text), *sign = strstr(text, " := ");
	const char *name = item->behind && sign ? sign + 4 : text;
	const size_t len = item->behind || !sign ? strlen(name) : (size_t)(sign - text);
	int last = -1;
	const int at = vars_argument(&pou->vars, names_fold(names, names_intern(names, name, len)),
				     item->behind, &last);
	char told[2 * LIMIT_NAME + 2];

	snprintf(told, sizeof(told), "%s.%.*s", text_of(c, entry->pou), (int)len, name);
	if (at < 0)
		c->good &= diag_add(c->diags, (struct diag){ .id = DIAG_NO_PIN, .file = c->project->config->file,
				    .line = item->line, .column = item->column }, "%s", told);
	return at >= 0;
}

/* PROGRAM P1 : Pump (In := Level, Out => Motor). Not inlined: it needs much of the stack. */
__attribute__((noinline))
static void check_values(struct names_check *c)
{
	const struct config *config = c->project->config;

	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		const char *name = text_of(c, entry->pou);
		const int at = entry->values ? project_find_pou(c->project, name, strlen(name)) : -1;
		const struct pou *pou = at < 0 ? NULL : &c->project->pou[at];
		struct operand_check operands = {
			.scope = c->scope, .project = c->project, .uses = &c->uses, .expr = c->expr,
			.diags = c->diags, .pou = pou, .statement = true,
			.place = { .file = config->file, .pou = name },
		};

		if (pou && pou->language != LANGUAGE_ST && !pou->fbd)
			c->good &= diag_add(c->diags, (struct diag){ .id = DIAG_VALUES_FOR_ST,
					    .file = config->file, .line = entry->line }, "%s", name);
		for (int k = 0; pou && (pou->language == LANGUAGE_ST || pou->fbd) && k < entry->values; k++)
			if (has_value(c, entry, pou, &entry->value[k]))
				c->good &= check_st_item(&operands, &entry->value[k]);
	}
}

/* Each coil of a place that two of them write: which one is meant, only a person knows. */
static void report_coils(struct names_check *c)
{
	for (const struct use_coil *coil = c->uses.coil; coil; coil = coil->next) {
		struct diag place = place_of(c, DIAG_COIL_TWICE, coil->pou, coil->line);

		place.column = coil->column;
		place.rung = coil->rung;
		place.row = coil->row;
		place.col = coil->col;
		if (uses_coil_twice(&c->uses, coil))
			diag_add(c->diags, place, "%s", text_of(c, coil->name));
	}
}

bool check_names(struct scope *scope, uint8_t *const *bad,
		 struct arena *scratch, struct diag_list *diags)
{
	struct names_check c = {
		.scope = scope, .project = scope_project(scope),
		.scratch = scratch, .diags = diags, .good = true,
	};

	c.expr = arena_alloc(scratch, sizeof(*c.expr));
	if (!c.expr || !make_marks(&c) ||
	    !uses_init(&c.uses, scope, scratch)) {
		report_line(&c, DIAG_NO_MEMORY, NULL, 0, "");
		return false;
	}
	check_pous(&c);
	check_structures(&c);
	check_named(&c);
	check_table(&c, NULL, &c.project->globals);
	check_located(&c);
	check_bodies(&c, bad);
	c.good &= check_config(scope, &c.uses, diags);
	check_values(&c);
	c.good &= check_access(scope, &c.uses, scratch, diags);
	report_coils(&c);
	for (int i = 0; i <= c.project->pou_count; i++)
		check_uses(&c, i);
	if (scratch->failed || c.project->arena.failed)
		report_line(&c, DIAG_NO_MEMORY, NULL, 0, "");
	return c.good;
}
