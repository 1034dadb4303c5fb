/* SPDX-License-Identifier: MIT
 *
 * ld_to_il - the order in which a rung is evaluated (docs/language.md).
 *
 * Phase 1 walks from the outputs back to the left rail, each element once; phase 2
 * lets coils, jumps and last assignments act, top to bottom.
 */
#include "engine/translate/ladder_unit.h"

#include "engine/check/wires.h"
#include "engine/check/reserved.h"
#include "engine/check/touch.h"

#include <stdio.h>
#include <string.h>

static const struct word_row *row_of(const struct ld *ld, int element)
{
	return word_row((enum word)ld->network.element[element].word);
}

static bool is_unread(const struct ld *ld, int element)
{
	int out = ld->network.element[element].out;

	return out == NET_RAIL || ld->network.reader_count[out] == 0;
}

/* An output, which acts in phase 2. */
static bool is_actor(const struct ld *ld, int element)
{
	const struct word_row *row = row_of(ld, element);

	if (row->operand == OPND_ASSIGN || row->operand == OPND_ROUTINE ||
	    row->operand == OPND_EXECUTE)
		return is_unread(ld, element);
	return row->place == PLACE_LAST;
}

static bool is_output(const struct ld *ld, int element)
{
	bool box = row_of(ld, element)->place == PLACE_BOX;

	return is_actor(ld, element) || (box && is_unread(ld, element));
}

static uint32_t operand_of(const struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];

	return rung_at(ld->rung, at->row, at->col)->operand;
}

static void add(struct ld *ld, bool output, uint32_t pin, uint32_t operand)
{
	if (!pin || !operand)
		ld->failed = true;
	ld_arg(ld, output, pin, operand);
}

const struct meaning *ld_meaning(struct ld *ld, uint32_t operand)
{
	enum diag_id why;

	return scope_find(ld->translation->scope, ld->unit->pou, operand, &why);
}

uint32_t ld_fetch(struct ld *ld, uint32_t element, uint32_t en, uint32_t *eno)
{
	const struct meaning *m = ld_meaning(ld, element);
	uint32_t value = m && meaning_is_whole(m) ? temps_whole(ld->temps, m) :
			 temps_number(ld->temps, m ? m->type : IEC_BOOL);

	*eno = temps_bool(ld->temps);
	ld_call(ld, FN_MOVE);
	add(ld, false, ld->en_id, en);
	add(ld, false, ld->in_id, element);
	add(ld, true, ld->eno_id, *eno);
	add(ld, true, ld->out_id, value);
	return value;
}

#define OPERAND_MOST 80 /* bytes that identify an operand                     */

static uint32_t mix(uint32_t hash, const char *text)
{
	for (; *text; text++)
		hash = (hash ^ (uint8_t)*text) * 16777619u;
	return (hash ^ 255u) * 16777619u;
}

/* A hash of the element, independent of the rungs around it. */
static uint32_t hash_rung(const struct ld *ld)
{
	const struct project *project = ld->translation->project;
	const struct rung *rung = ld->rung;
	uint32_t hash = 2166136261u ^ rung->cols;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];

		hash = mix(hash, words_row(&project->words,
					   (enum word)cell->word)->word);
		hash = mix(hash, cell->link ? "|" : "");
		hash = mix(hash, names_text(&project->names, cell->operand));
		if (cell->word != ELEM_EXECUTE) /* an edge stays when statements change */
			hash = mix(hash, names_text(&project->names, cell->args));
	}
	return hash;
}

/* "P Start @1a2b3c4d": a name with blanks, which no variable has. */
static uint32_t ld_memory(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct cell *cell = rung_at(ld->rung, at->row, at->col);
	const struct names *names = &ld->translation->project->names;
	char text[LIMIT_NAME + OPERAND_MOST + 16];
	int len = snprintf(text, sizeof(text), "%.*s %.*s @%08x", LIMIT_NAME,
			   word_row((enum word)cell->word)->word, OPERAND_MOST,
			   names_text(names, cell->operand), (unsigned)hash_rung(ld));

	return temps_edge(ld->temps, arena_copy(ld->translation->arena, text,
						(size_t)len));
}

void ld_emit_line(struct ld *ld, struct il_line line)
{
	if (ld->fbd && line.operand && line.kind != IL_LABEL)
		line.operand = wires_operand(ld->translation->project, ld->unit->pou, ld->fbd - 1, line.operand);
	line.rung = ld->number;
	line.row = ld->row;
	line.col = ld->col;
	line.line = (uint32_t)(ld->rung ? rung_line(ld->rung, ld->row) : ld->line);
	line.mark |= ld->mark;
	if (ld->begins && line.kind != IL_LABEL) {
		line.mark |= IL_BEGINS;
		ld->begins = false;
	}
	if (!il_add(ld->il, line))
		ld->failed = true;
}

/* The last line; NULL: none. @watching: or the last one that also runs unwatched. */
static const struct il_line *last_line(const struct ld *ld, bool watching)
{
	int at = ld->il->count - 1;

	while (!watching && at >= 0 && ld->il->line[at].mark & IL_WATCHING)
		at--;
	return at >= 0 ? &ld->il->line[at] : NULL;
}

static bool stores(const struct ld *ld, const struct il_line *line, uint32_t operand)
{
	return line && line->kind == IL_OP && line->op == OP_ST && !line->modifiers &&
	       line->operand == operand && line->rung == ld->number;
}

/* The type of the result behind line @at: of LD, and of operators on it; IEC_NONE: it is not known. */
static enum iec_type result_behind(struct ld *ld, int at)
{
	const struct il_line *line;
	const struct meaning *m;

	for (; at >= 0; at--) {
		line = &ld->il->line[at];
		if (line->kind == IL_OP && line->op == OP_LD && !line->modifiers) {
			m = ld_meaning(ld, line->operand);
			return m ? m->type : IEC_NONE;
		}
		if (line->kind != IL_FN || !word_shares(word_row((enum word)line->word)))
			break;
	}
	return IEC_NONE;
}

/* Is a value the same when it has been stored there by the last line? A number may get another type or be beyond a
 * subrange, a text may be cut, an element may not exist. */
static bool stores_all(struct ld *ld, uint32_t operand)
{
	const struct meaning *m = ld_meaning(ld, operand);

	if (!m || meaning_is_indexed(m))
		return false;
	if (m->type == IEC_BOOL || reserved_generated(project_text(ld->translation->project, operand)))
		return true;
	return m->type != IEC_STRING && !meaning_is_ranged(m) && result_behind(ld, ld->il->count - 2) == m->type;
}

/* Was it stored by the line before? Then it is still the result. */
static bool is_result(struct ld *ld, uint32_t operand)
{
	if (!stores_all(ld, operand))
		return false;
	if (stores(ld, last_line(ld, true), operand))
		return true;
	if (ld->mark || !stores(ld, last_line(ld, false), operand))
		return false;
	ld_emit_line(ld, (struct il_line){ .kind = IL_OP, .op = OP_LD, .mark = IL_WATCHING,
					   .operand = operand });
	return true;
}

void ld_emit(struct ld *ld, enum op op, uint8_t modifiers, uint32_t operand)
{
	struct il_line line = {
		.kind = IL_OP, .op = (uint8_t)op, .modifiers = modifiers,
		.operand = operand,
	};

	if (op == OP_LD && !modifiers && !ld->open && is_result(ld, operand))
		return;
	if (ld->open) {
		struct il_line open = {
			.kind = IL_OP, .op = ld->open_op,
			.modifiers = MOD_PAREN,
		};

		ld->open = false;
		if (op == OP_LD && !modifiers) {
			open.operand = operand; /* OR( Motor */
			ld_emit_line(ld, open);
			return;
		}
		ld_emit_line(ld, open);
	}
	ld_emit_line(ld, line);
}

uint32_t ld_store_new(struct ld *ld)
{
	uint32_t name = temps_bool(ld->temps);

	if (!name)
		ld->failed = true;
	ld_emit(ld, OP_ST, 0, name);
	return name;
}

/* An edge contact; the element's memory stays when it is skipped. */
static void ld_edge(struct ld *ld, int element, uint32_t operand)
{
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t memory = ld_memory(ld, element), eno, value;

	value = ld_fetch(ld, operand, ld->true_id, &eno);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_AND, 0, rising ? value : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : value);
	ld->element[element].leaf = ld_store_new(ld);
	ld_call(ld, FN_MOVE);
	add(ld, false, ld->en_id, eno);
	add(ld, false, ld->in_id, value);
	add(ld, true, ld->out_id, memory);
}

bool ld_is_indexed(struct ld *ld, uint32_t operand)
{
	const struct meaning *m = operand ? ld_meaning(ld, operand) : NULL;

	return m && meaning_is_indexed(m);
}

/* ---- phase 1 ---- */

/* An edge has a memory of its own, set at every evaluation. */
static void read_edge(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t operand = operand_of(ld, element);
	uint32_t memory;

	if (ld_is_indexed(ld, operand)) {
		ld_edge(ld, element, operand);
		return;
	}
	memory = ld_memory(ld, element);
	ld_emit(ld, OP_LD, 0, rising ? operand : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : operand);
	state->leaf = ld_store_new(ld);
	ld_emit(ld, OP_LD, 0, operand);
	ld_emit(ld, OP_ST, 0, memory);
	if (!memory)
		ld->failed = true;
}

void ld_place(struct ld *ld, int row, int col)
{
	ld->row = (uint16_t)(row + 1);
	ld->col = (uint16_t)(col + 1);
}

static uint8_t negation(const struct element_state *state)
{
	return state->negate ? MOD_N : 0;
}

/* Is the element's power one operand, perhaps negated? */
static bool is_single(const struct ld *ld, int element)
{
	const struct element_state *state = &ld->element[element];

	return state->leaf &&
	       (state->powered || ld->network.element[element].in == NET_RAIL);
}

/* A contact that may share the power before it: that is no operand yet. */
static bool is_factor(const struct ld *ld, int element)
{
	return ld->element[element].leaf && !is_single(ld, element);
}

/* Is it a contact between the same two nets as the contact @first? */
static bool is_beside(const struct ld *ld, int first, int element)
{
	return is_factor(ld, first) && is_factor(ld, element) &&
	       ld->network.element[element].in == ld->network.element[first].in;
}

/* Whether the contact beside which @feeder[at] lies has been loaded already. */
static bool is_loaded(const struct ld *ld, const int *feeder, int at)
{
	for (int i = 0; i < at; i++)
		if (is_beside(ld, feeder[i], feeder[at]))
			return true;
	return false;
}

/* @feeder[0], and those of the @count - 1 elements after it that lie beside it. */
static int count_beside(const struct ld *ld, const int *feeder, int count)
{
	int beside = 1;

	for (int i = 1; i < count; i++)
		beside += is_beside(ld, feeder[0], feeder[i]);
	return beside;
}

static void emit_leaf(struct ld *ld, enum op op, int element)
{
	const struct element_state *state = &ld->element[element];
	const struct network_element *at = &ld->network.element[element];

	ld_place(ld, at->row, at->col);
	ld_emit(ld, op, negation(state), state->leaf);
}

static void open_parenthesis(struct ld *ld, enum op op)
{
	ld->open = true;
	ld->open_op = (uint8_t)op;
}

static void close_parenthesis(struct ld *ld)
{
	ld_emit_line(ld, (struct il_line){ .kind = IL_CLOSE });
}

/* The power of @feeder[0] and of those of the @count - 1 elements after it that lie beside it:
 * `power AND (a OR b OR c)`, which needs fewer tables than `power AND a OR power AND b …`. */
static void load_elements(struct ld *ld, const int *feeder, int count)
{
	const int first = feeder[0];
	const struct network_element *at = &ld->network.element[first];
	bool open = false;

	if (is_single(ld, first)) {
		emit_leaf(ld, OP_LD, first);
		return;
	}
	ld_place(ld, at->row, at->col);
	ld_load(ld, at->in);
	for (int i = 1; i < count; i++) {
		if (!is_beside(ld, first, feeder[i]))
			continue;
		if (!open) {
			open_parenthesis(ld, OP_AND);
			emit_leaf(ld, OP_LD, first);
		}
		open = true;
		emit_leaf(ld, OP_OR, feeder[i]);
	}
	if (open) {
		close_parenthesis(ld);
		return;
	}
	ld_place(ld, at->row, at->col);
	if (ld->element[first].leaf)
		emit_leaf(ld, OP_AND, first);
	else
		ld_emit(ld, OP_NOT, 0, 0);
}

void ld_load(struct ld *ld, int net)
{
	const struct network *n = &ld->network;
	const int *feeder = n->feeder + n->first_feeder[net];
	int count = n->first_feeder[net + 1] - n->first_feeder[net];

	if (net == NET_RAIL || ld->net[net].temp || count == 0) {
		ld_emit(ld, OP_LD, 0, net != NET_RAIL && ld->net[net].temp ?
			ld->net[net].temp : ld->true_id);
		return;
	}
	load_elements(ld, feeder, count);
	for (int i = 1; i < count; i++) {
		if (is_single(ld, feeder[i])) {
			emit_leaf(ld, OP_OR, feeder[i]);
		} else if (!is_loaded(ld, feeder, i)) {
			open_parenthesis(ld, OP_OR);
			load_elements(ld, feeder + i, count - i);
			close_parenthesis(ld);
		}
	}
}

/* The one operand that a net's power is, or 0. */
static uint32_t single_operand(const struct ld *ld, int net)
{
	const struct network *n = &ld->network;
	int first = n->first_feeder[net];

	if (net == NET_RAIL)
		return ld->true_id;
	if (ld->net[net].temp)
		return ld->net[net].temp;
	if (n->first_feeder[net + 1] != first + 1)
		return 0;
	if (is_single(ld, n->feeder[first]) &&
	    !ld->element[n->feeder[first]].negate)
		return ld->element[n->feeder[first]].leaf;
	return 0;
}

void ld_prepare(struct ld *ld, int net, int readers)
{
	const struct network *n = &ld->network;
	const int *feeder = n->feeder + n->first_feeder[net];
	const int count = n->first_feeder[net + 1] - n->first_feeder[net];

	if (net == NET_RAIL || ld->net[net].prepared)
		return;
	ld->net[net].prepared = true;
	for (int i = 0; i < count; i++)
		if (!ld->element[feeder[i]].powered && !is_loaded(ld, feeder, i))
			ld_prepare(ld, n->element[feeder[i]].in,
				   count_beside(ld, feeder + i, count - i));
	if (n->reader_count[net] > readers && !single_operand(ld, net)) {
		ld_load(ld, net);
		ld->net[net].temp = ld_store_new(ld);
	}
}

uint32_t ld_operand(struct ld *ld, int net)
{
	uint32_t operand;

	ld_prepare(ld, net, 1);
	operand = single_operand(ld, net);
	if (operand)
		return operand;
	ld_load(ld, net);
	return ld->net[net].temp = ld_store_new(ld);
}

/* A contact, normally open or closed: power only if there is one. */
static void ld_contact(struct ld *ld, int element, uint32_t operand)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	uint32_t en = ld_operand(ld, at->in), eno, value;

	ld_place(ld, at->row, at->col);
	value = ld_fetch(ld, operand, en, &eno);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_AND, row_of(ld, element)->negate ? MOD_N : 0, value);
	state->leaf = ld_store_new(ld);
	state->powered = true;
}

/* ---- a POU ---- */

static uint32_t fold(struct ld *ld, uint32_t name)
{
	return names_fold(&ld->translation->project->names, name);
}

static struct names *names_of(struct ld *ld)
{
	return &ld->translation->project->names;
}

static uint32_t intern(struct ld *ld, const char *text, size_t len)
{
	uint32_t id = names_intern(names_of(ld), text, len);

	if (!id)
		ld->failed = true;
	return id;
}

static uint32_t label(struct ld *ld, char letter, uint32_t number)
{
	char text[24];
	int len = snprintf(text, sizeof(text), "_%c%u", letter, (unsigned)number);

	return intern(ld, text, (size_t)len);
}

static void head(struct ld *ld)
{
	const struct names *names = &ld->translation->project->names;
	struct il_line line = { .kind = IL_COMMENT };
	const char *label = names_text(names, ld->rung->label);
	char text[LIMIT_NAME + 32];
	int len;
	uint32_t id;

	if (!ld->watch) {
		len = snprintf(text, sizeof(text), "(* rung %u%s%s *)",
			       ld->number, *label ? ": " : "", label);
		line.operand = names_intern(&ld->translation->project->names,
					    text, (size_t)len);
		ld_emit_line(ld, line);
	}
	id = ld->rung->label ? fold(ld, ld->rung->label) : 0;
	if (id && id < ld->target_count && ld->target[id]) {
		line.kind = IL_LABEL;
		line.operand = ld->rung->label;
		ld_emit_line(ld, line);
	}
}

/* Readers are kept by place, so that a write compares with few: eight bytes of an area, or a
 * variable. A wide read may begin in the eight bytes before. */
static uint32_t place_key(const struct meaning *m)
{
	if (m->addr.area != AREA_NONE)
		return (uint32_t)m->addr.area << 16 | m->addr.byte / 8;
	return (uint32_t)((uintptr_t)m->var >> 4) * 2654435761u;
}

/* Notes an evaluated element for ld_freeze(). */
static void ld_read(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];
	const struct meaning *read = state->leaf ? ld_meaning(ld, state->leaf)
						 : NULL;
	int *head;

	if (!read)
		return;
	head = &ld->reader[place_key(read) & ld->reader_mask];
	state->next = *head;
	*head = element;
}

/* ---- watching ---- */

static uint32_t store_power(struct ld *ld)
{
	uint32_t name = temps_power(ld->temps);

	if (!name)
		ld->failed = true;
	ld_emit(ld, OP_ST, 0, name);
	return name;
}

/* What keeps the power of a net, or gives it. */
static uint32_t power_of(const struct ld *ld, int net)
{
	return net != NET_RAIL && ld->net[net].power ? ld->net[net].power : ld->true_id;
}

/* While listing: the power of an element in a variable of its own. The list that runs unwatched
 * has the lines without a mark, and the same results after them. */
static void keep_element(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];

	ld->mark = IL_WATCHING;
	ld_place(ld, at->row, at->col);
	if (is_single(ld, element)) {
		ld_emit(ld, OP_LD, negation(state), state->leaf);
	} else {
		ld_emit(ld, OP_LD, 0, power_of(ld, at->in));
		if (state->leaf)
			ld_emit(ld, OP_AND, negation(state), state->leaf);
		else
			ld_emit(ld, OP_NOT, 0, 0);
	}
	state->power = store_power(ld);
	ld->mark = 0;
}

/* While watching: power of an element in a variable. It is read from there, unless lists keep
 * results, too. */
static void ld_settle_element(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];
	const struct word_row *row = row_of(ld, element);

	if (!ld->watch || row->place == PLACE_LAST)
		return;
	if (!state->leaf && row->operand == OPND_ASSIGN)
		return;
	if (ld->listing) {
		keep_element(ld, element);
		return;
	}
	load_elements(ld, &element, 1);
	*state = (struct element_state){
		.seen = true, .powered = true, .leaf = store_power(ld),
		.next = state->next,
	};
}

/* Outputs behind a coil have its power, which is kept as an operand. */
static void pass_on(struct ld *ld, int element)
{
	struct element_state *state = &ld->element[element];

	if (row_of(ld, element)->operand != OPND_BOOL_W || is_unread(ld, element))
		return;
	state->leaf = ld_operand(ld, ld->network.element[element].in);
	state->powered = true;
	state->power = power_of(ld, ld->network.element[element].in);
	if (state->leaf != ld->true_id)
		ld_read(ld, element);
}

static void evaluate(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	const struct word_row *row = row_of(ld, element);

	ld_place(ld, at->row, at->col);
	if (is_actor(ld, element)) {
		pass_on(ld, element);
		return;
	}
	if (row->kind != WORD_ELEM)
		ld_box(ld, element);
	else if (row->operand == OPND_EXPR)
		ld_compare(ld, element);
	else if (row->operand == OPND_ASSIGN)
		ld_assign(ld, element);
	else if (row->operand == OPND_ROUTINE)
		ld_routine(ld, element);
	else if (row->operand == OPND_EXECUTE)
		ld_execute(ld, element);
	else if (row->edge != EDGE_NONE)
		read_edge(ld, element);
	else if (ld_is_indexed(ld, operand_of(ld, element)))
		ld_contact(ld, element, operand_of(ld, element));
	else
		state->leaf = operand_of(ld, element);
	state->negate = row->negate && !state->powered;
	ld_settle_element(ld, element);
	ld_read(ld, element);
}

/* While listing: what keeps the power of a net; a variable of its own, if no element has it. */
static void keep_net(struct ld *ld, int net)
{
	const struct network *n = &ld->network;
	int first = n->first_feeder[net], end = n->first_feeder[net + 1];

	if (end == first + 1 && ld->element[n->feeder[first]].power) {
		ld->net[net].power = ld->element[n->feeder[first]].power;
		return;
	}
	ld->mark = IL_WATCHING;
	for (int i = first; i < end; i++) {
		const struct network_element *at = &n->element[n->feeder[i]];
		uint32_t power = ld->element[n->feeder[i]].power;

		ld_place(ld, at->row, at->col);
		ld_emit(ld, i == first ? OP_LD : OP_OR, 0,
			power ? power : power_of(ld, at->in));
	}
	if (first == end)
		ld_emit(ld, OP_LD, 0, ld->true_id);
	ld->net[net].power = store_power(ld);
	ld->mark = 0;
}

static void ld_settle_net(struct ld *ld, int net)
{
	if (!ld->watch)
		return;
	if (ld->listing) {
		keep_net(ld, net);
		return;
	}
	if (net == NET_RAIL || ld->net[net].temp)
		return;
	ld_load(ld, net);
	ld->net[net].temp = store_power(ld);
}

static void visit(struct ld *ld, int element);

static void visit_net(struct ld *ld, int net)
{
	const struct network *n = &ld->network;

	if (net == NET_RAIL || ld->net[net].seen)
		return;
	ld->net[net].seen = true;
	for (int i = n->first_feeder[net]; i < n->first_feeder[net + 1]; i++)
		visit(ld, n->feeder[i]);
	ld_settle_net(ld, net);
}

/* The recursion is bounded: an element leads right, so at most LIMIT_COLS of them nest. */
static void visit(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];

	if (ld->element[element].seen)
		return;
	ld->element[element].seen = true;
	visit_net(ld, at->in);
	for (int i = 0; i < at->pins; i++)
		visit_net(ld, ld->network.pin[at->first_pin + i].in);
	evaluate(ld, element);
}

/* ---- phase 2 ---- */

/* Coils that only store the result, so that several can share it. */
static bool is_plain(const struct ld *ld, int element)
{
	const struct word_row *row = row_of(ld, element);

	return row->operand == OPND_BOOL_W && row->edge == EDGE_NONE;
}

static void act_plain(struct ld *ld, const int *group, int count)
{
	int net = ld->network.element[group[0]].in;

	/* A single group that alone reads its net needs no temporary for it. */
	ld_prepare(ld, net, count);
	ld_load(ld, net);
	for (int i = 0; i < count; i++) {
		const struct network_element *at =
			&ld->network.element[group[i]];
		const struct word_row *row = row_of(ld, group[i]);

		ld_place(ld, at->row, at->col);
		ld_emit(ld, row->first, row->negate ? MOD_N : 0,
			operand_of(ld, group[i]));
	}
}

static void act_edge(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	bool rising = row_of(ld, element)->edge == EDGE_RISING;
	uint32_t power, memory = ld_memory(ld, element);

	ld_prepare(ld, at->in, 1);
	ld_load(ld, at->in);
	ld_place(ld, at->row, at->col);
	power = ld_store_new(ld);
	ld_emit(ld, OP_LD, 0, rising ? power : memory);
	ld_emit(ld, OP_AND, MOD_N, rising ? memory : power);
	ld_emit(ld, row_of(ld, element)->first, 0, operand_of(ld, element));
	ld_emit(ld, OP_LD, 0, power);
	ld_emit(ld, OP_ST, 0, memory);
	if (!memory)
		ld->failed = true;
}

static void act_flow(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	bool always = at->in == NET_RAIL;

	ld_prepare(ld, at->in, 1);
	if (!always)
		ld_load(ld, at->in);
	ld_place(ld, at->row, at->col);
	ld_emit(ld, row_of(ld, element)->first, always ? 0 : MOD_C,
		operand_of(ld, element));
}

/* An assignment, statements, or a call of a subroutine. */
static void act_box(struct ld *ld, int element)
{
	if (row_of(ld, element)->operand == OPND_ASSIGN)
		ld_assign(ld, element);
	else if (row_of(ld, element)->operand == OPND_EXECUTE)
		ld_execute(ld, element);
	else
		ld_routine(ld, element);
	ld_settle_element(ld, element);
}

/* Outputs from @first on that share one result. */
static int group_size(const struct ld *ld, const int *actor, int first,
		      int count)
{
	int net = ld->network.element[actor[first]].in, n = 1;

	if (!is_plain(ld, actor[first]))
		return 1;
	while (first + n < count && is_plain(ld, actor[first + n]) &&
	       ld->network.element[actor[first + n]].in == net)
		n++;
	return n;
}

/* ---- keeping aside ---- */

static void freeze_at(struct ld *ld, const struct meaning *write, uint32_t key)
{
	int at = ld->reader[key & ld->reader_mask];

	for (; at >= 0; at = ld->element[at].next) {
		struct element_state *state = &ld->element[at];
		const struct meaning *read = ld_meaning(ld, state->leaf);

		if (!read || !meaning_touches(ld->translation->scope, write, read))
			continue;
		ld_emit(ld, OP_LD, 0, state->leaf);
		state->leaf = ld_store_new(ld);
	}
}

void ld_freeze(struct ld *ld, uint32_t operand)
{
	const struct meaning *write = ld_meaning(ld, operand);
	uint32_t key, last;

	if (!write || !ld->rung) /* no element of a rung has read it */
		return;
	key = place_key(write);
	freeze_at(ld, write, key);
	if (write->addr.area == AREA_NONE)
		return;
	freeze_at(ld, write, key - 1);
	last = key + (meaning_end(write) - 1) / 8 - write->addr.byte / 8 + 1;
	if (last - key > ld->reader_mask)
		last = key + ld->reader_mask; /* write all of them then */
	for (; key != last; key++)
		freeze_at(ld, write, key + 1);
}

static void emit_label(struct ld *ld, uint32_t name)
{
	ld_emit_line(ld, (struct il_line){ .kind = IL_LABEL, .operand = name });
}

static uint32_t part(struct ld *ld, const struct loop_part *part)
{
	return part->text ? intern(ld, part->text, part->len) : intern(ld, "1", 1);
}

static void emit_fn(struct ld *ld, enum word fn, uint32_t operand)
{
	ld_emit_line(ld, (struct il_line){ .kind = IL_FN, .mark = IL_MADE,
					   .word = (uint16_t)fn, .operand = operand });
}

/* Leaves the loop when @value is beyond its end. */
static void leave_past(struct ld *ld, const struct open_loop *loop, uint32_t value)
{
	ld_emit(ld, OP_LD, 0, value);
	emit_fn(ld, loop->down ? FN_LT : FN_GT, loop->to);
	ld_emit(ld, OP_JMP, MOD_C, loop->out);
}

static void ld_loop_begin(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	uint32_t id = rung_at(ld->rung, at->row, at->col)->operand;
	struct open_loop *loop;
	struct loop text;

	if (ld->loops == LIMIT_LOOPS ||
	    !loop_parse(names_text(names_of(ld), id), names_len(names_of(ld), id),
			&text))
		return;
	loop = &ld->loop[ld->loops++];
	*loop = (struct open_loop){
		.variable = part(ld, &text.variable), .to = part(ld, &text.to),
		.by = part(ld, &text.by), .down = text.step < 0,
		.top = label(ld, 'L', ld->number), .out = label(ld, 'X', ld->number),
	};
	if (at->in != NET_RAIL) {
		ld_prepare(ld, at->in, 1);
		ld_load(ld, at->in);
		ld_place(ld, at->row, at->col);
		ld_emit(ld, OP_JMP, MOD_C | MOD_N, loop->out);
	}
	ld_emit(ld, OP_LD, 0, part(ld, &text.from));
	ld_emit(ld, OP_ST, 0, loop->variable);
	emit_label(ld, loop->top);
	leave_past(ld, loop, loop->variable);
}

static enum iec_type type_of(struct ld *ld, uint32_t operand)
{
	enum diag_id why;
	const struct meaning *m = scope_find(ld->translation->scope, ld->unit->pou,
					     operand, &why);

	return m ? m->type : IEC_DINT;
}

static void ld_loop_end(struct ld *ld)
{
	const struct open_loop *loop;
	uint32_t next, eno;

	if (ld->loops == 0)
		return;
	loop = &ld->loop[--ld->loops];
	next = temps_number(ld->temps, type_of(ld, loop->variable));
	eno = temps_bool(ld->temps);
	ld_emit(ld, OP_LD, 0, loop->variable);
	emit_fn(ld, FN_EQ, loop->to);
	ld_emit(ld, OP_JMP, MOD_C, loop->out);
	ld_call(ld, FN_ADD);
	ld_arg(ld, false, intern(ld, "IN1", 3), loop->variable);
	ld_arg(ld, false, intern(ld, "IN2", 3), loop->by);
	ld_arg(ld, true, ld->eno_id, eno);
	ld_arg(ld, true, ld->out_id, next);
	ld_emit(ld, OP_LD, 0, eno);
	ld_emit(ld, OP_JMP, MOD_C | MOD_N, loop->out);
	leave_past(ld, loop, next);
	ld_emit(ld, OP_LD, 0, next);
	ld_emit(ld, OP_ST, 0, loop->variable);
	ld_emit(ld, OP_JMP, 0, loop->top);
	emit_label(ld, loop->out);
}

static void act(struct ld *ld, const int *actor, int count)
{
	for (int i = 0, n; i < count; i += n) {
		const struct network_element *at =
			&ld->network.element[actor[i]];
		const struct word_row *row = row_of(ld, actor[i]);

		n = group_size(ld, actor, i, count);
		ld_place(ld, at->row, at->col);
		for (int k = 0; k < n && i + n < count; k++)
			if (row->operand == OPND_BOOL_W)
				ld_freeze(ld, operand_of(ld, actor[i + k]));
		if (row->place == PLACE_BOX)
			act_box(ld, actor[i]);
		else if (row->edge != EDGE_NONE)
			act_edge(ld, actor[i]);
		else if (row->operand == OPND_LOOP)
			ld_loop_begin(ld, actor[i]);
		else if (row->operand == OPND_LOOP_END)
			ld_loop_end(ld);
		else if (is_plain(ld, actor[i]))
			act_plain(ld, actor + i, n);
		else
			act_flow(ld, actor[i]);
	}
}

/* ---- a rung ---- */

static void note_power(struct ld *ld, int row, int col, uint32_t in,
		       uint32_t out)
{
	struct power_note *note = arena_push(ld->translation->arena,
					     &ld->unit->power,
					     &ld->unit->power_count,
					     sizeof(*note));

	if (!note) {
		ld->failed = true;
		return;
	}
	*note = (struct power_note){
		.rung = ld->number, .row = (uint16_t)(row + 1),
		.col = (uint16_t)(col + 1), .in = in, .out = out,
	};
}

/* Power of every cell that has been evaluated, in reading order. */
/* What keeps the power that the element lets through; 0: none. */
static uint32_t kept_of(const struct ld *ld, int element)
{
	return ld->listing ? ld->element[element].power : ld->element[element].leaf;
}

static void note_rung(struct ld *ld)
{
	const struct network *n = &ld->network;
	int element = 0;

	for (int row = 0; row < n->rows; row++)
		for (int col = 0; col < n->cols; col++) {
			const struct cell *cell = rung_at(ld->rung, row, col);
			int net = network_net(n, row, col);
			uint32_t in = ld->listing ? ld->net[net].power : ld->net[net].temp;
			uint32_t out = in;

			if (cell->word == ELEM_EMPTY ||
			    (net != NET_RAIL && !in && cell->word == ELEM_WIRE))
				continue;
			if (element < n->element_count &&
			    n->element[element].row == row &&
			    n->element[element].col == col) {
				if (!ld->element[element].seen) {
					element++;
					continue;
				}
				if (kept_of(ld, element))
					out = kept_of(ld, element);
				element++;
			}
			note_power(ld, row, col, in, out);
		}
}

/* One list of readers for about each element, at most 4096. */
static bool prepare_readers(struct ld *ld)
{
	uint32_t size = 4;

	while (size < 4096 && size < (uint32_t)ld->network.element_count)
		size *= 2;
	ld->reader_mask = size - 1;
	ld->reader = arena_alloc(ld->scratch, size * sizeof(*ld->reader));
	for (uint32_t i = 0; ld->reader && i < size; i++)
		ld->reader[i] = -1;
	return ld->reader;
}

static bool prepare_rung(struct ld *ld)
{
	const struct network *n = &ld->network;

	arena_reset(ld->scratch);
	if (!network_make(ld->rung, ld->scratch, &ld->network))
		return false;
	ld->element = arena_alloc(ld->scratch, ((size_t)n->element_count + 1) *
				  sizeof(*ld->element));
	ld->net = arena_alloc(ld->scratch,
			      ((size_t)n->net_count + 1) * sizeof(*ld->net));
	temps_rung(ld->temps);
	return ld->element && ld->net && prepare_readers(ld);
}

static void translate_rung(struct ld *ld)
{
	const struct network *n = &ld->network;
	int *actor = arena_alloc(ld->scratch, ((size_t)n->element_count + 1) *
				 sizeof(*actor));
	int count = 0;

	if (!actor) {
		ld->failed = true;
		return;
	}
	for (int i = 0; i < n->element_count; i++) {
		if (!is_output(ld, i))
			continue;
		visit(ld, i);
		if (is_actor(ld, i))
			actor[count++] = i;
	}
	act(ld, actor, count);
	if (ld->watch)
		note_rung(ld);
}

/* Writes only labels that a jump names, because a label ends fusing. */
static bool find_targets(struct ld *ld)
{
	const struct pou *pou = ld->unit->pou;
	const struct names *names = &ld->translation->project->names;

	for (int pass = 0; pass < 2; pass++) {
		for (int i = 0; i < pou->rung_count; i++) {
			const struct rung *rung = pou->rung[i];
			int cells = rung->off ? 0 : rung->rows * rung->cols;

			for (int k = 0; k < cells; k++) {
				const struct cell *cell = &rung->cell[k];
				uint32_t id;

				if (word_row((enum word)cell->word)->operand !=
				    OPND_LABEL)
					continue;
				id = fold(ld, cell->operand);
				if (pass == 1 && id < ld->target_count)
					ld->target[id] = 1;
			}
		}
		if (pass == 1)
			break;
		ld->target_count = (uint32_t)names->count;
		ld->target = arena_alloc(ld->translation->arena,
					 ld->target_count);
		if (!ld->target)
			return false;
	}
	return true;
}

bool ld_begin(struct ld *ld)
{
	struct translation *t = ld->translation;
	struct names *names = &t->project->names;

	if (!ld->unit->temps) {
		ld->unit->temps = arena_alloc(t->arena, sizeof(struct temps));
		if (!ld->unit->temps)
			return false;
		ld->unit->temps->translation = t;
		ld->unit->temps->unit = ld->unit;
	}
	ld->temps = ld->unit->temps;
	ld->listing = ld->watch && t->listing;
	ld->temps->edges = ld->temps->powers = 0;
	ld->il->arena = t->arena;
	t->expr = t->expr ? t->expr : arena_alloc(t->arena, sizeof(*t->expr));
	t->ignored = t->ignored ? t->ignored : arena_alloc(t->arena, sizeof(*t->ignored));
	ld->expr = t->expr;
	ld->ignored = t->ignored;
	ld->true_id = names_intern(names, "TRUE", 4);
	ld->in_id = names_intern(names, "IN", 2);
	ld->en_id = names_intern(names, "EN", 2);
	ld->eno_id = names_intern(names, "ENO", 3);
	ld->out_id = names_intern(names, "OUT", 3);
	return ld->expr && ld->ignored && ld->out_id && find_targets(ld);
}

/* Input.M, what the input was at the last call; Input.E, its edge. */
static uint32_t edge_name(struct ld *ld, const struct var *input, char letter)
{
	const char *name = project_text(ld->translation->project, input->name);
	const size_t size = strlen(name) + sizeof(".M");
	const struct var like = { .type = IEC_BOOL };
	char *text = arena_alloc(ld->scratch, size);
	uint32_t id;

	if (!text) {
		ld->failed = true;
		return 0;
	}
	snprintf(text, size, "%s.%c", name, letter);
	id = names_intern(&ld->translation->project->names, text, size - 1);
	if (!ld_meaning(ld, id)) /* a name that nobody can declare */
		id = temps_named(ld->temps, text, &like);
	ld->failed |= !id;
	return id;
}

void ld_edges(struct ld *ld)
{
	const struct var_table *vars = &ld->unit->pou->vars;
	const uint8_t mark = ld->mark;

	ld->mark |= IL_MADE | IL_ENTERS;
	for (int i = 0; i < vars->count && !ld->failed; i++) {
		const bool rising = vars->var[i].edge == 1;
		uint32_t before, edge;

		if (!vars->var[i].edge)
			continue;
		before = edge_name(ld, &vars->var[i], 'M');
		edge = edge_name(ld, &vars->var[i], 'E');
		ld_emit(ld, OP_LD, rising ? 0 : MOD_N, vars->var[i].name);
		ld_emit(ld, OP_AND, rising ? MOD_N : 0, before);
		ld_emit(ld, OP_ST, 0, edge);
		ld_emit(ld, OP_LD, 0, vars->var[i].name);
		ld_emit(ld, OP_ST, 0, before);
		ld_emit(ld, OP_LD, 0, edge);
		ld_emit(ld, OP_ST, 0, vars->var[i].name);
	}
	ld->mark = mark;
}

bool ld_rungs(struct ld *ld, int first, int count, const uint8_t *skip)
{
	for (int i = first; i < first + count && !ld->failed; i++) {
		ld->rung = ld->unit->pou->rung[i];
		ld->number = (uint32_t)i + 1;
		ld->row = ld->col = 0;
		if (ld->rung->off)
			continue;
		head(ld); /* a label counts even if the rung has errors */
		if (skip[i])
			continue;
		if (!prepare_rung(ld))
			return false;
		translate_rung(ld);
	}
	return !ld->failed;
}

bool ld_to_il(struct translation *translation, struct unit *unit,
	      const uint8_t *skip, bool watch, struct arena *scratch)
{
	struct ld ld = {
		.translation = translation, .unit = unit, .scratch = scratch,
		.il = watch ? &unit->watch : &unit->il, .watch = watch,
	};

	if (!ld_begin(&ld))
		return false;
	ld_edges(&ld);
	return ld_rungs(&ld, 0, unit->pou->rung_count, skip);
}

bool il_to_il(struct translation *translation, struct unit *unit, struct arena *scratch)
{
	const struct il *written = &unit->pou->il;
	struct ld ld = { .translation = translation, .unit = unit, .scratch = scratch, .il = &unit->il };

	if (!ld_begin(&ld))
		return false;
	ld_edges(&ld);
	for (int i = 0; i < written->count && !ld.failed; i++)
		ld.failed |= !il_add(&unit->il, written->line[i]);
	return !ld.failed;
}

/* @locals: those of the POU, too; those that translation made, such as _T1, nobody else writes. */
static void freeze_variables(struct ld *ld, bool locals)
{
	for (int i = 0; i < ld->network.element_count; i++) {
		struct element_state *state = &ld->element[i];
		const struct meaning *read = state->seen && state->leaf ?
			ld_meaning(ld, state->leaf) : NULL;

		if (!read || read->kind == MEANING_LITERAL ||
		    (read->pou && (!locals || reserved_generated(names_text(names_of(ld), state->leaf)))))
			continue;
		ld_emit(ld, OP_LD, 0, state->leaf);
		state->leaf = ld_store_new(ld);
	}
}

void ld_freeze_all(struct ld *ld)
{
	freeze_variables(ld, true);
}

void ld_freeze_globals(struct ld *ld)
{
	freeze_variables(ld, false);
}
