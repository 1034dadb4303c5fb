/* SPDX-License-Identifier: MIT
 *
 * wires - see wires.h.
 *
 * First all wires are declared without a type. Then their types are found, line after line, until none
 * changes any more: PREVIOUS() may name a wire further down.
 */
#include "engine/check/wires.h"

#include "engine/base/ascii.h"
#include "engine/check/infer.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

#define ROUNDS_MOST 8
#define AHEAD_MOST 100 /* lines that are looked at for a reader of constants */

struct wiring {
	struct project *project;
	struct pou *pou;
	int network;
	const struct st_item *item;
	struct scope *scope;
	struct infer in;
	struct expr *expr;
	struct diag_list *ignored;
	bool changed, failed;
};

/* ---- declarations ---- */

static void add_variable(struct wiring *w, uint32_t name, enum iec_type type)
{
	struct var_table *table = &w->pou->vars;
	struct arena *arena = &w->project->arena;
	struct var_block *block = table->block_count ? &table->block[table->block_count - 1] : NULL;
	struct fbd_network *network = &w->pou->fbd->network[w->network];
	struct var *slot;

	if (!network->wires)
		network->wire = table->count;
	if (!name || fbd_variable(&w->project->names, w->pou, w->network, name) >= 0) {
		w->failed |= !name;
		return;
	}
	if (!block || !(block->flags & VAR_WIRE)) {
		block = arena_push(arena, &table->block, &table->block_count, sizeof(*block));
		if (block)
			*block = (struct var_block){ .flags = VAR_SFC | VAR_WIRE, .first = table->count };
	}
	slot = arena_push(arena, &table->var, &table->count, sizeof(*slot));
	if (!slot || !block) {
		w->failed = true;
		return;
	}
	*slot = (struct var){ .name = name, .type = type, .line = w->item->line };
	slot->fold = names_fold(&w->project->names, name);
	block->count++;
	network->wires++;
}

/* Is the name declared nowhere? */
static bool is_free(struct wiring *w, const struct token *name)
{
	const uint32_t id = names_intern(&w->project->names, name->text, name->len);
	enum diag_id why = DIAG_COUNT;

	return !scope_find(w->scope, w->pou, id, &why) && why == DIAG_UNKNOWN_NAME &&
	       !scope_pou(w->scope, w->pou, id) &&
	       words_find(&w->project->words, name->text, name->len) == WORD_COUNT;
}

static void declare_line(struct wiring *w, int *edges)
{
	struct fbd_names walk;
	struct token name;
	enum fbd_use use;
	bool whole;

	fbd_names_begin(&walk, &w->project->names, w->item);
	while (fbd_names_next(&walk, &name, &use, &whole))
		if (use == FBD_EDGE)
			add_variable(w, fbd_edge_name(&w->project->names, w->network, ++*edges), IEC_BOOL);
		else if ((use == FBD_WRITTEN || use == FBD_OUTPUT) && whole && name.len <= LIMIT_NAME &&
			 is_free(w, &name))
			add_variable(w, fbd_wire_name(&w->project->names, name.text, name.len, w->network, false),
				     IEC_NONE);
}

/* Wires whose value at the end of the scan before is asked for. */
static void declare_before(struct wiring *w)
{
	struct fbd_names walk;
	struct token name;
	enum fbd_use use;
	bool whole;

	fbd_names_begin(&walk, &w->project->names, w->item);
	while (fbd_names_next(&walk, &name, &use, &whole))
		if (use == FBD_BEFORE && whole &&
		    fbd_wire(&w->project->names, w->pou, w->network, name.text, name.len) >= 0)
			add_variable(w, fbd_wire_name(&w->project->names, name.text, name.len, w->network, true),
				     IEC_NONE);
}

/* ---- types ---- */

static bool is_same(const struct var *a, const struct var *b)
{
	return a->type == b->type && a->fb == b->fb && a->array.count == b->array.count &&
	       a->array.low == b->array.low && a->capacity == b->capacity &&
	       vars_same_bounds(a->dim, a->dims, b->dim, b->dims);
}

/* The wire gets the type of @like. */
static void set_like(struct wiring *w, int wire, const struct var *like)
{
	struct var *var = &w->pou->vars.var[wire];
	struct var next = { .name = var->name, .fold = var->fold, .line = var->line };

	next.type = like->type;
	next.fb = like->fb;
	next.array = like->array;
	next.capacity = like->capacity;
	next.dims = like->dims;
	next.dim = like->dim;
	w->changed |= !is_same(var, &next);
	*var = next;
}

static void set_type(struct wiring *w, int wire, enum iec_type type)
{
	const struct var like = { .type = type };

	if (type != IEC_NONE && type != IEC_TYPE_COUNT)
		set_like(w, wire, &like);
}

/* A whole structure or array that the expression is, or that it calls for. */
static bool set_whole(struct wiring *w, int wire)
{
	const struct expr_node *root = &w->expr->node[w->expr->root];
	const struct meaning *m;
	const struct var *result;
	enum diag_id why;
	struct var like = { .type = IEC_NONE };

	if (root->op == EXPR_CALL) {
		result = infer_result(&w->in, infer_function(&w->in, root));
		if (result && (result->array.count || result->type == IEC_NONE))
			set_like(w, wire, result);
		return result != NULL;
	}
	if (root->op != EXPR_NAME && root->op != EXPR_INDEX)
		return false;
	m = scope_find(w->scope, w->pou, scope_first_of(w->scope, w->pou, w->expr, root), &why);
	if (!m || (m->kind != MEANING_STRUCT && m->kind != MEANING_ARRAY))
		return m && m->kind == MEANING_INSTANCE;
	if (m->kind == MEANING_ARRAY && (!m->like || m->dims > 1))
		return true;
	like.type = m->type;
	like.fb = m->type == IEC_NONE ? (enum word)m->word : (enum word)0;
	like.array = m->kind == MEANING_ARRAY ? m->array : (struct var_array){ 0 };
	like.capacity = m->capacity;
	set_like(w, wire, &like);
	return true;
}

static int wire_at(struct wiring *w, const struct expr_node *node)
{
	return node->op == EXPR_NAME && !memchr(node->text, '.', node->len) ?
	       fbd_wire(&w->project->names, w->pou, w->network, node->text, node->len) : -1;
}

/* The type of the variable that an assignment of the wire alone stores to; IEC_NONE: it is none. Spoils w->expr. */
static enum iec_type stored_type(struct wiring *w, int wire, const struct st_item *item)
{
	const struct meaning *m;
	struct st_walk walk;
	struct st_part part;
	enum diag_id why;

	st_begin(&walk, &w->project->names, item);
	if (item->kind == ST_COMMENT || item->kind == ST_CALL ||
	    !st_next(&walk, &part, w->expr, w->ignored, (struct diag){ .id = DIAG_COUNT }) || part.role != ST_ASSIGNED ||
	    wire_at(w, &w->expr->node[w->expr->root]) != wire || w->expr->target_index >= 0 || w->expr->target_points ||
	    w->expr->target_bit.len)
		return IEC_NONE;
	m = scope_find(w->scope, w->pou, names_intern(&w->project->names, w->expr->target, w->expr->target_len), &why);
	return m && m->kind == MEANING_VARIABLE && iec_type_row(m->type)->class & (ANY_NUM | CLASS_BITS) ? m->type : IEC_NONE;
}

/* Constants alone have the type of the first variable that takes them. */
static enum iec_type type_of_constants(struct wiring *w, int wire)
{
	const struct fbd_network *network = &w->pou->fbd->network[w->network];
	const struct st_item *end = w->pou->st->item + network->first + network->count;
	enum iec_type type = IEC_NONE;

	for (const struct st_item *item = w->item + 1; item < end && item <= w->item + AHEAD_MOST && type == IEC_NONE; item++)
		type = stored_type(w, wire, item);
	return type != IEC_NONE ? type : IEC_DINT;
}

/* The wire that an expression is stored to. Spoils w->expr. */
static void type_of_value(struct wiring *w, int wire)
{
	const enum iec_type type = infer_type(&w->in, w->expr->root);

	if (type != IEC_NONE)
		set_type(w, wire, type);
	else if (!set_whole(w, wire) && w->pou->vars.var[wire].type == IEC_NONE)
		set_type(w, wire, type_of_constants(w, wire));
}

/* `ENO => Sure` and the like of functions in the expression. */
static void type_outputs(struct wiring *w)
{
	for (int i = 0; i < w->expr->count; i++) {
		const struct expr_node *call = &w->expr->node[i];

		for (int at = call->op == EXPR_CALL ? call->left : -1; at >= 0; at = w->expr->node[at].right) {
			const struct expr_node *arg = &w->expr->node[at];
			const int wire = arg->output ? wire_at(w, &w->expr->node[arg->left]) : -1;
			const struct word_row *row = scope_row(w->scope, infer_function(&w->in, call));
			const int pin = word_pin_find(row, arg->text, arg->len);

			if (wire < 0)
				continue;
			if (ascii_is("ENO", arg->text, arg->len))
				set_type(w, wire, IEC_BOOL);
			else if (pin >= 0 && pin < row->pin_count)
				set_like(w, wire, &(struct var){ .type = row->pin[pin].type, .fb = row->pin[pin].type ? (enum word)0 : row->pin[pin].word });
			else
				set_type(w, wire, infer_type(&w->in, i));
		}
	}
}

/* The outputs of an instance or a program that is called. */
static void type_call(struct wiring *w, struct st_walk *walk)
{
	struct st_part part;
	const struct meaning *m;
	const struct pou *program;
	const struct word_row *row;
	enum diag_id why;
	uint32_t id;
	int last = -1, at;

	if (!st_next(walk, &part, w->expr, w->ignored, (struct diag){ .id = DIAG_COUNT }))
		return;
	id = scope_first_of(w->scope, w->pou, w->expr, &w->expr->node[w->expr->root]);
	m = scope_find(w->scope, w->pou, id, &why);
	program = scope_pou(w->scope, w->pou, id);
	row = m && m->kind == MEANING_INSTANCE ? scope_row(w->scope, (enum word)m->word) : NULL;
	while (st_next(walk, &part, w->expr, w->ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART) {
		const int wire = part.role == ST_OUTPUT ? wire_at(w, &w->expr->node[w->expr->root]) : -1;

		if (part.role == ST_INPUT)
			type_outputs(w);
		if (wire < 0)
			continue;
		at = row ? word_pin_find(row, part.pin.text, part.pin.len) : -1;
		if (at >= 0 && at < row->pin_count)
			set_like(w, wire, &(struct var){ .type = row->pin[at].type, .capacity = row->pin[at].capacity,
				 .fb = row->pin[at].type ? (enum word)0 : row->pin[at].word });
		at = program ? vars_argument(&program->vars, names_fold(&w->project->names,
			     names_intern(&w->project->names, part.pin.text, part.pin.len)), true, &last) : -1;
		if (at >= 0)
			set_like(w, wire, &program->vars.var[at]);
	}
}

static bool is_function(struct wiring *w)
{
	const struct token first = st_label_name(&w->project->names, w->item);
	const struct expr_node node = { .op = EXPR_CALL, .text = first.text, .len = (uint16_t)first.len };
	enum diag_id why;

	return expr_function(&w->project->words, &node) != WORD_COUNT &&
	       !scope_find(w->scope, w->pou, names_intern(&w->project->names, first.text, first.len), &why);
}

static void type_line(struct wiring *w)
{
	struct st_walk walk;
	struct st_part part;

	st_begin(&walk, &w->project->names, w->item);
	if (w->item->kind == ST_CALL && is_function(w)) {
		if (expr_parse(&walk.lex, w->expr, w->ignored, (struct diag){ .id = DIAG_COUNT }))
			type_outputs(w);
		return;
	}
	if (w->item->kind == ST_CALL) {
		type_call(w, &walk);
		return;
	}
	while (st_next(&walk, &part, w->expr, w->ignored, (struct diag){ .id = DIAG_COUNT }) &&
	       part.role != ST_NO_PART) {
		type_outputs(w);
		if (part.role != ST_ASSIGNED)
			continue;
		const int wire = w->expr->target_index >= 0 || w->expr->target_points || w->expr->target_bit.len ? -1 :
			wire_at(w, &(struct expr_node){ .op = EXPR_NAME, .text = w->expr->target,
							.len = (uint16_t)w->expr->target_len });

		if (wire >= 0)
			type_of_value(w, wire);
		break;
	}
}

/* What the wires were has their types. */
static void type_before(struct wiring *w)
{
	struct fbd_names walk;
	struct token name;
	enum fbd_use use;
	bool whole;

	fbd_names_begin(&walk, &w->project->names, w->item);
	while (fbd_names_next(&walk, &name, &use, &whole)) {
		const int wire = use == FBD_BEFORE ?
			fbd_wire(&w->project->names, w->pou, w->network, name.text, name.len) : -1;
		const int before = wire < 0 ? -1 : fbd_variable(&w->project->names, w->pou, w->network,
			fbd_wire_name(&w->project->names, name.text, name.len, w->network, true));

		if (before >= 0)
			set_like(w, before, &w->pou->vars.var[wire]);
	}
}

/* ---- all ---- */

static void each(struct wiring *w, void (*line)(struct wiring *w))
{
	const struct fbd *fbd = w->pou->fbd;

	for (w->network = 0; w->network < fbd->count; w->network++) {
		const struct fbd_network *network = &fbd->network[w->network];

		scope_network(w->scope, w->pou, w->network);
		for (int i = network->first; !network->off && i < network->first + network->count; i++) {
			w->item = &w->pou->st->item[i];
			if (w->item->kind != ST_COMMENT)
				line(w);
		}
	}
	scope_network(w->scope, w->pou, -1);
}

static void declare_all(struct wiring *w)
{
	const struct fbd *fbd = w->pou->fbd;

	for (w->network = 0; w->network < fbd->count; w->network++) {
		const struct fbd_network *network = &fbd->network[w->network];
		int edges = 0;

		for (int i = network->first; !network->off && i < network->first + network->count; i++) {
			w->item = &w->pou->st->item[i];
			declare_line(w, &edges);
		}
		for (int i = network->first; !network->off && i < network->first + network->count; i++) {
			w->item = &w->pou->st->item[i];
			declare_before(w);
		}
	}
}

static bool has_networks(const struct project *project)
{
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].fbd)
			return true;
	return false;
}

static bool no_memory(struct project *project, struct diag_list *diags)
{
	return diag_add(diags, (struct diag){ .id = DIAG_NO_MEMORY, .file = project->file }, "%s", "");
}

bool wires_make(struct project *project, struct arena *scratch, struct diag_list *diags)
{
	struct wiring w = { .project = project, .changed = true };

	if (!has_networks(project))
		return true;
	w.scope = scope_new(project, scratch);
	w.expr = arena_alloc(scratch, sizeof(*w.expr));
	w.ignored = arena_alloc(scratch, sizeof(*w.ignored));
	if (!w.scope || !w.expr || !w.ignored)
		return no_memory(project, diags);
	for (int i = 0; i < project->pou_count; i++)
		if ((w.pou = &project->pou[i])->fbd)
			declare_all(&w);
	for (int round = 0; round < ROUNDS_MOST && w.changed && !w.failed; round++) {
		w.changed = false;
		w.scope = scope_new(project, scratch);
		if (!w.scope)
			return no_memory(project, diags);
		for (int i = 0; i < project->pou_count; i++) {
			w.pou = &project->pou[i];
			w.in = (struct infer){ .scope = w.scope, .pou = w.pou, .project = project, .expr = w.expr,
					       .statement = true };
			if (!w.pou->fbd)
				continue;
			each(&w, type_line);
			each(&w, type_before);
		}
	}
	if (w.failed || scratch->failed || project->arena.failed)
		return no_memory(project, diags);
	return shape_make(project, diags);
}

/* ---- operands of instructions ---- */

/* Is the name that of a variable which wires have: Sum.N2? */
static bool is_made(const char *dot, const char *end)
{
	const char *digit = dot ? dot + 2 : end;

	if (digit >= end || !strchr("NPE", dot[1]))
		return false;
	while (digit < end && *digit >= '0' && *digit <= '9')
		digit++;
	return digit > dot + 2 && (digit == end || *digit == '.');
}

/* How operand() names a variable: the wire of a network, or, of network -1, one with a dot as @plain. */
struct renaming { const struct pou *pou; int network; const uint32_t *plain; };

/* The new name of the first @size bytes of the token; NULL: it has none. */
static const char *new_name(struct project *project, const struct renaming *as, const struct token *token, size_t *size)
{
	const char *dot = memchr(token->text, '.', token->len), *end = token->text + token->len;
	const struct var_table *vars = &as->pou->vars;
	int at;

	*size = dot ? (size_t)(dot - token->text) : token->len;
	if (as->network >= 0) {
		at = is_made(dot, end) ? -1 : fbd_wire(&project->names, as->pou, as->network, token->text, *size);
		return at < 0 ? NULL : project_text(project, vars->var[at].name);
	}
	if (!is_made(dot, end))
		return NULL;
	*size = token->len;
	dot = memchr(dot + 1, '.', (size_t)(end - dot - 1));
	if (dot)
		*size = (size_t)(dot - token->text);
	at = vars_find(vars, names_fold(&project->names, names_intern(&project->names, token->text, *size)));
	return at < 0 || !as->plain[at] ? NULL : project_text(project, as->plain[at]);
}

static uint32_t renamed(struct project *project, const struct renaming *as, uint32_t operand)
{
	const char *text = project_text(project, operand);
	const size_t len = names_len(&project->names, operand);
	char out[2 * LIMIT_NAME + 200];
	size_t used = 0, from = 0, size;
	struct token before = { .kind = TOKEN_END };
	struct lex lex;

	if (len >= sizeof(out) || memchr(text, '\'', len))
		return operand;
	lex_init(&lex, text, len);
	while (lex_next(&lex) != TOKEN_END) {
		const bool member = before.kind == TOKEN_SYMBOL && *before.text == '.';
		const char *name = lex.token.kind != TOKEN_NAME || member ? NULL :
				   new_name(project, as, &lex.token, &size);
		const size_t at = (size_t)(lex.token.text - text);

		before = lex.token;
		if (!name || used + (at - from) + strlen(name) >= sizeof(out))
			continue;
		memcpy(out + used, text + from, at - from);
		used += at - from;
		memcpy(out + used, name, strlen(name));
		used += strlen(name);
		from = at + size;
	}
	if (!from || used + len - from >= sizeof(out))
		return operand;
	memcpy(out + used, text + from, len - from);
	return names_intern(&project->names, out, used + len - from);
}

uint32_t wires_operand(struct project *project, const struct pou *pou, int network, uint32_t operand)
{
	if (!pou->fbd->network[network].wires)
		return operand;
	return renamed(project, &(struct renaming){ .pou = pou, .network = network }, operand);
}

/* Low_N1 of Low.N1, with as many _ behind it as it needs to be new. */
static uint32_t plain_name(struct project *project, const struct var_table *vars, uint32_t name)
{
	char text[LIMIT_NAME + 40];
	int len = snprintf(text, sizeof(text), "%.*s", LIMIT_NAME + 20, project_text(project, name));
	uint32_t id;

	for (int i = 0; i < len; i++)
		text[i] = text[i] == '.' ? '_' : text[i];
	for (id = names_intern(&project->names, text, (size_t)len);
	     id && vars_find(vars, names_fold(&project->names, id)) >= 0 && len < (int)sizeof(text) - 1;
	     id = names_intern(&project->names, text, (size_t)len))
		text[len++] = '_';
	return id;
}

bool wires_declare(struct project *project, struct pou *pou, struct il *il)
{
	struct var_table *vars = &pou->vars;
	uint32_t *plain = arena_alloc(&project->arena, ((size_t)vars->count + 1) * sizeof(*plain));
	const struct renaming as = { .pou = pou, .network = -1, .plain = plain };

	if (!plain)
		return false;
	for (int i = 0; i < vars->count; i++)
		if (vars_flags(vars, i) & VAR_WIRE)
			plain[i] = plain_name(project, vars, vars->var[i].name);
	for (int i = 0; i < il->count; i++)
		if (il->line[i].operand && il->line[i].kind != IL_LABEL && il->line[i].kind != IL_COMMENT)
			il->line[i].operand = renamed(project, &as, il->line[i].operand);
	for (int i = 0; i < vars->count; i++)
		if (plain[i]) {
			vars->var[i].name = plain[i];
			vars->var[i].fold = names_fold(&project->names, plain[i]);
		}
	for (int i = 0; i < vars->block_count; i++)
		if (vars->block[i].flags & VAR_WIRE)
			vars->block[i].flags = 0;
	return true;
}
