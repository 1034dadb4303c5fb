/* SPDX-License-Identifier: MIT
 *
 * to_classic_box - blocks of a rung: those of ClassicLadder, and those of IEC 61131-3 that
 * become one of these or contacts and coils.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"
#include "engine/model/args.h"

#include <stdlib.h>
#include <string.h>

/* The rung that a jump leads to; -1: none. */
static int target_of(const struct leaving *e, const struct pou *pou, uint32_t label)
{
	const struct names *names = &e->project->names;

	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    names_fold(names, pou->rung[i]->label) == names_fold(names, label))
			return i;
	return -1;
}

static bool in_loop(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = index; i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; k < rung->rows * rung->cols; k++) {
			int to = rung->cell[k].word == ELEM_JUMP && !rung->off ?
				 target_of(e, pou, rung->cell[k].operand) : -1;

			if (to >= 0 && to <= index)
				return true;
		}
	}
	return false;
}

struct call_place { const struct pou *pou; int rung, count; };

static void find_calls(const struct leaving *e, const struct pou *called,
		       struct call_place *place)
{
	*place = (struct call_place){ NULL, 0, 0 };
	for (int i = 0; i < e->project->pou_count; i++) {
		const struct pou *pou = &e->project->pou[i];

		for (int k = 0; k < pou->rung_count; k++)
			for (int m = 0; m < pou->rung[k]->rows * pou->rung[k]->cols; m++) {
				const struct cell *cell = &pou->rung[k]->cell[m];

				if (cell->word == ELEM_CALL && !pou->rung[k]->off &&
				    scope_pou(e->scope, pou, cell->operand) == called)
					*place = (struct call_place){ pou, k,
						place->count + 1 };
			}
	}
}

/* Can a rung before @index jump past it? */
static bool is_skipped(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = 0; i < index; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; !rung->off && k < rung->rows * rung->cols; k++) {
			const struct cell *cell = &rung->cell[k];

			if (cell->word == ELEM_RETURN || cell->word == ELEM_END ||
			    (cell->word == ELEM_JUMP &&
			     target_of(e, pou, cell->operand) > index))
				return true;
		}
	}
	return false;
}

/* Can a scan skip the rung in work? */
static bool may_rest(struct leaving *e)
{
	return e->pou->kind == POU_SUBROUTINE || is_skipped(e, e->pou, e->rung_index);
}

/* Can the rung in work run more than once in a scan? */
static bool runs_often(struct leaving *e)
{
	const struct pou *pou = e->pou;
	int rung = e->rung_index;

	for (int depth = 0; depth <= e->project->pou_count; depth++) {
		struct call_place place;

		if (in_loop(e, pou, rung))
			return true;
		if (pou->kind != POU_SUBROUTINE)
			return false;
		find_calls(e, pou, &place);
		if (place.count != 1)
			return place.count > 1;
		pou = place.pou;
		rung = place.rung;
	}
	return true;
}

static bool reads_pin(struct classic_variable variable, const struct out_part *box)
{
	return (int)classic_kind_of(variable.type) == box->slot->block &&
	       variable.number == box->slot->number;
}

bool part_touches(const struct out_part *item, const struct out_part *box)
{
	if (!box->slot || box->slot->block < 0)
		return true;
	if (is_block(item))
		return item->slot->block == box->slot->block &&
		       item->slot->number == box->slot->number;
	for (const char *at = item->text; at && (at = strpbrk(at, "@[")); at++) {
		char *slash, *end;
		const long type = strtol(at + 1, &slash, 10);
		const long number = *slash == '/' ? strtol(slash + 1, &end, 10) : -1;

		if (number >= 0 && reads_pin(variable_of((int)type, (int)number), box))
			return true;
	}
	if (item->text)
		return false;
	return reads_pin(item->variable, box) ||
	       reads_pin(variable_of(item->variable.index_type,
				     item->variable.index_number), box);
}

/* The inputs of a block, by row in ClassicLadder. */
struct box_row { enum word word; int code, kind; const char *pin[4]; };

static const struct box_row box_rows[] = {
	{ FB_CL_TIMER, CL_OLD_TIMER, CLASSIC_TIMER, { "E", "C" } },
	{ FB_CL_MONO, CL_MONOSTABLE, CLASSIC_MONOSTABLE, { "IN" } },
	{ FB_CL_TON, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_CL_TOF, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_CL_TP, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_CL_COUNTER, CL_COUNT, CLASSIC_COUNTER, { "RESET", "LOAD", "UP", "DOWN" } },
	{ FB_CL_REGISTER, CL_REGISTER_BOX, CLASSIC_REGISTER, { "RESET", "PUSH", "POP" } },
	{ FB_TON, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_TOF, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_TP, CL_IEC, CLASSIC_IEC_TIMER, { "IN" } },
	{ FB_CTU, CL_COUNT, CLASSIC_COUNTER, { "R", NULL, "CU", NULL } },
	{ FB_CTD, CL_COUNT, CLASSIC_COUNTER, { NULL, "LD", NULL, "CD" } },
	{ FB_CTUD, CL_COUNT, CLASSIC_COUNTER, { "R", "LD", "CU", "CD" } },
	{ FB_R_TRIG, CL_PART, -1, { "CLK" } },
	{ FB_F_TRIG, CL_PART, -1, { "CLK" } },
	{ FB_SR, CL_PART, -1, { "S1", "R" } },
	{ FB_RS, CL_PART, -1, { "S", "R1" } },
};

enum { OWN_ROWS = 7, TIMER_ROWS = 3 }; /* rows of ClassicLadder; then timers of IEC 61131-3 */

static const struct box_row *row_of(enum word word)
{
	for (size_t i = 0; i < sizeof(box_rows) / sizeof(*box_rows); i++)
		if (box_rows[i].word == word)
			return &box_rows[i];
	return NULL;
}

static int pin_row(const struct box_row *row, const char *pin, size_t len)
{
	for (int i = 0; i < 4; i++)
		if (row->pin[i] && ascii_is(row->pin[i], pin, len))
			return i;
	return -1;
}

static struct classic_blocks *blocks_of(struct leaving *e, int kind)
{
	switch (kind) {
	case CLASSIC_TIMER: return &e->out->timer;
	case CLASSIC_MONOSTABLE: return &e->out->monostable;
	case CLASSIC_IEC_TIMER: return &e->out->iec_timer;
	case CLASSIC_COUNTER: return &e->out->counter;
	default: return &e->out->reg;
	}
}

/* The block with this number, made if there is none. */
static struct classic_block *block_entry(struct leaving *e, int kind, int number)
{
	struct classic_blocks *blocks = blocks_of(e, kind);
	int at = 0;

	while (at < blocks->count && blocks->block[at].number < number)
		at++;
	if (at < blocks->count && blocks->block[at].number == number)
		return &blocks->block[at];
	if (!arena_push(e->arena, &blocks->block, &blocks->count, sizeof(*blocks->block)))
		return NULL;
	memmove(&blocks->block[at + 1], &blocks->block[at],
		sizeof(*blocks->block) * (size_t)(blocks->count - 1 - at));
	blocks->block[at] = (struct classic_block){ .number = number, .base = 1 };
	return &blocks->block[at];
}

/* "P" of "(P := 20, BASE := T#100ms)"; NULL: it has none. */
static const char *member_of(struct leaving *e, const char *text, const char *name)
{
	struct lex lex;
	const char *from;

	if (!text)
		return NULL;
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		if (!lex_accept(&lex, name) || !lex_accept(&lex, ":="))
			continue;
		from = lex.token.text;
		while (*lex.at && *lex.at != ',' && *lex.at != ')')
			lex.at++;
		return out_text(e, "%.*s", (int)(lex.at - from), from);
	}
	return NULL;
}

static bool number_of(const char *text, enum iec_type type, int64_t *out)
{
	struct literal literal;
	union iec_value value;
	size_t len = text ? strlen(text) : 0;

	while (len && text[len - 1] == ' ')
		len--;
	if (!len || literal_parse(text, len, &literal) != LITERAL_OK ||
	    !literal_fit(&literal, type, &value))
		return false;
	*out = value.i;
	return true;
}

static const int64_t base_ns[] = { INT64_C(60000000000), 1000000000, 100000000 };

static bool base_of(struct leaving *e, int64_t ns, const char *name, int *base)
{
	for (int i = 0; i < 3; i++)
		if (base_ns[i] == ns) {
			*base = i;
			return true;
		}
	return out_refuse(e, DIAG_EXPORT_TIME, "%s", name);
}

/* A time in units of the finest base that holds it. */
static bool time_units(struct leaving *e, int64_t ns, const char *name,
		       struct classic_block *block)
{
	/* A timer counts at most one unit a scan, so a base must not be shorter than a scan. */
	for (int i = 2; i >= 0; i--)
		if (ns > 0 && ns % base_ns[i] == 0 && ns / base_ns[i] <= 9999 &&
		    base_ns[i] >= e->out->period * INT64_C(1000000)) {
			block->base = i;
			block->preset = (int)(ns / base_ns[i]);
			return true;
		}
	return out_refuse(e, DIAG_EXPORT_TIME, "%s", name);
}

/* Preset, base and mode from the declaration of a block of ClassicLadder. */
static bool own_block(struct leaving *e, const struct out_slot *slot,
		      struct classic_block *block)
{
	const char *text = project_text(e->project, var_value_text(slot->var));
	const char *base = member_of(e, text, "BASE"), *list;
	int64_t value = 0;
	struct literal literal;

	if (number_of(member_of(e, text, "P"), IEC_DINT, &value))
		block->preset = (int)value;
	if (base && number_of(base, IEC_TIME, &value) &&
	    !base_of(e, value, slot->name, &block->base))
		return false;
	switch ((int)slot->var->fb) {
	case FB_CL_TOF: block->mode = 1; break;
	case FB_CL_TP: block->mode = 2; break;
	case FB_CL_REGISTER:
		list = member_of(e, text, "LAST_OUT");
		block->mode = list && literal_parse(list, strlen(list), &literal) ==
			LITERAL_OK && literal.value.i ? 2 : 1;
		if (number_of(member_of(e, text, "SIZE"), IEC_DINT, &value))
			e->out->register_list = (int)value;
		break;
	}
	return true;
}

/* Also of blocks that no rung calls: their presets can be read. */
void blocks_prepare(struct leaving *e)
{
	for (int i = 0; i < e->slots && e->good; i++) {
		const struct out_slot *slot = &e->slot[i];
		const struct box_row *row = slot->block < 0 ? NULL : row_of(slot->var->fb);
		struct classic_block *block;

		if (!row || row >= &box_rows[OWN_ROWS] ||
		    (slot->pou && pou_has_frame(slot->pou)))
			continue;
		block = block_entry(e, slot->block, slot->number);
		if (block)
			own_block(e, slot, block);
	}
}

static void later(struct leaving *e, struct out_part *item, const char *text, int bit)
{
	struct out_before *one = arena_alloc(e->arena, sizeof(*one)), **last = &item->after;

	while (*last)
		last = &(*last)->next;
	if (one)
		*one = (struct out_before){ text, bit, NULL };
	*last = one;
}

/* ClassicLadder cannot change a TIME, so a variable counts with its initial value. */
static bool declared_time(struct leaving *e, const char *name, int64_t *ns)
{
	uint32_t id = names_intern(&e->project->names, name, strlen(name));
	enum diag_id why;
	const struct meaning *m = scope_find(e->scope, e->pou, id, &why);
	struct out_slot *slot;

	if (!m || m->kind != MEANING_VARIABLE || m->var->type != IEC_TIME ||
	    !m->var->has_init || m->var->array.count)
		return false;
	slot = slot_find(e, m->var);
	if (slot)
		slot->calls++;
	if (!m->constant)
		tell_change(e, "%s is fixed in ClassicLadder", name);
	*ns = m->var->init.i;
	return true;
}

/* PT:=T#3s of a timer of IEC 61131-3. */
static bool iec_time(struct leaving *e, struct out_part *item, const char *text)
{
	struct classic_block *block = block_entry(e, CLASSIC_IEC_TIMER, item->slot->number);
	int64_t ns;

	if (!block || (!number_of(text, IEC_TIME, &ns) && !declared_time(e, text, &ns)))
		return out_refuse(e, DIAG_EXPORT_TIME, "%s", text);
	block->mode = item->word == FB_TON ? 0 : item->word == FB_TOF ? 1 : 2;
	if (may_rest(e))
		tell_change(e, "timer %s stops in ClassicLadder while its rung is skipped",
			    item->slot->name);
	return time_units(e, ns, item->slot->name, block);
}

static bool counter_preset(struct leaving *e, struct out_part *item, const char *text)
{
	struct classic_block *block = block_entry(e, CLASSIC_COUNTER, item->slot->number);
	struct out_operand operand;

	if (!block || !there_text(e, text, strlen(text), &operand))
		return false;
	tell_change(e, "counter %s counts from 0 to 9999 in ClassicLadder", item->slot->name);
	if (operand.is_constant) {
		block->preset = operand.value;
		return operand.value >= 0 && operand.value <= 9999 ? true :
		       out_refuse(e, DIAG_EXPORT_MANY, "%s", text);
	}
	item->before = arena_alloc(e->arena, sizeof(*item->before));
	if (item->before)
		*item->before = (struct out_before){ out_text(e, "@250/%d@:=%s",
			item->slot->number, out_encode(e, operand.variable)), -1, NULL };
	return true;
}

/* Q=>Lamp, CV=>Count: a rung behind the block copies it. */
static bool output_to(struct leaving *e, struct out_part *item, const struct arg *arg)
{
	struct out_operand target, pin;
	const char *name = out_text(e, "%s.%.*s", item->slot->name, (int)arg->pin_len,
				    arg->pin);

	if (!there_text(e, arg->value, arg->value_len, &target) ||
	    !there_text(e, name, strlen(name), &pin))
		return false;
	later(e, item, out_text(e, "%s:=%s", out_encode(e, target.variable),
				out_encode(e, pin.variable)), -1);
	return true;
}

static bool box_argument(struct leaving *e, const struct box_row *row,
			 const struct arg *arg, struct out_part *item)
{
	const char *value = out_text(e, "%.*s", (int)arg->value_len, arg->value);
	int at = pin_row(row, arg->pin, arg->pin_len);
	struct out_operand operand;

	if (arg->output)
		return output_to(e, item, arg);
	if (ascii_is("DT", arg->pin, arg->pin_len) && !strcmp(value, "SYS_CYCLE"))
		return true;
	if (ascii_is("PT", arg->pin, arg->pin_len))
		return iec_time(e, item, value);
	if (ascii_is("PV", arg->pin, arg->pin_len))
		return counter_preset(e, item, value);
	if (at < 0 || !there_text(e, value, strlen(value), &operand) ||
	    operand.variable.index_type >= 0 || operand.is_constant)
		return out_refuse(e, DIAG_EXPORT_WORD, "%.*s:=%s", (int)arg->pin_len, arg->pin,
			      value);
	item->given[at] = operand.variable;
	item->inverse[at] = arg->inverse;
	return true;
}

bool box_is_plain(const struct out_part *item)
{
	for (int i = 0; i < 4; i++)
		if (item->given[i].type >= 0)
			return false;
	return item->code != CL_PART && !item->moved && !item->after && !item->before;
}

static bool has_argument(const char *args, const char *pin)
{
	struct arg arg;

	for (const char *next = args; args_next(&next, &arg);)
		if (!arg.output && ascii_is(pin, arg.pin, arg.pin_len))
			return true;
	return false;
}

/* Checks the declaration of a block of IEC 61131-3: it can give the preset, nothing else. */
static bool iec_given(struct leaving *e, struct out_part *item, const char *args)
{
	const char *text = project_text(e->project, var_value_text(item->slot->var));
	const char *pin = item->code == CL_IEC ? "PT" : item->code == CL_COUNT ? "PV" : "";
	const char *value = *text && *pin ? member_of(e, text, pin) : NULL;

	for (const char *at = strstr(text, ":="); at; at = strstr(at + 2, ":="))
		if (!value || strstr(at + 2, ":="))
			return out_refuse(e, DIAG_EXPORT_WORD, "%s := %s", item->slot->name,
					  text);
	if (!*pin || has_argument(args, pin))
		return true;
	if (item->code == CL_IEC)
		return iec_time(e, item, value ? value : "T#0s");
	return counter_preset(e, item, value ? value : "0");
}

/* Checks the declaration of a block of ClassicLadder: timers need DT:=SYS_CYCLE, counters begin
 * with 0. */
static bool own_given(struct leaving *e, struct out_part *item, const char *args)
{
	const char *text = project_text(e->project, var_value_text(item->slot->var));
	int64_t value = 0;

	if (item->code == CL_COUNT)
		return !number_of(member_of(e, text, "V"), IEC_DINT, &value) || !value ? true :
		       out_refuse(e, DIAG_EXPORT_WORD, "%s := %s", item->slot->name, text);
	if (item->code == CL_REGISTER_BOX || has_argument(args, "DT"))
		return true;
	return out_refuse(e, DIAG_EXPORT_WORD, "%s: DT", item->slot->name);
}

bool box_part(struct leaving *e, const struct network *network,
	      const struct network_element *at, const struct cell *cell,
	      struct out_part *item)
{
	static const int height[CLASSIC_KINDS] = { 2, 2, 2, 4, 3 };
	const struct box_row *row = row_of((enum word)cell->word);
	const struct word_row *word = scope_row(e->scope, (enum word)cell->word);
	const char *args = project_text(e->project, cell->args);
	enum diag_id why;
	const struct meaning *m;
	struct classic_block *block;
	struct arg arg;
	int first;

	item->word = (enum word)cell->word;
	if (!row || word->kind != WORD_FB ||
	    (row->kind == CLASSIC_REGISTER && e->dialect != CLASSIC_UPSTREAM))
		return out_refuse(e, DIAG_EXPORT_WORD, "%s", word->word);
	m = scope_find(e->scope, e->pou, cell->operand, &why);
	item->slot = m && m->var ? slot_find(e, m->var) : NULL;
	if (!item->slot || m->kind != MEANING_INSTANCE || m->var->array.count)
		return out_refuse(e, DIAG_EXPORT_TYPE, "%s",
			      project_text(e->project, cell->operand));
	if ((item->slot->calls++ && row >= &box_rows[OWN_ROWS]) ||
	    (row >= &box_rows[OWN_ROWS] && row < &box_rows[OWN_ROWS + TIMER_ROWS] &&
	     runs_often(e)))
		return out_refuse(e, DIAG_EXPORT_TWICE, "%s", item->slot->name);
	item->code = row->code;
	item->width = 2;
	item->height = row->kind >= 0 ? height[row->kind] : 2;
	item->variable = variable_of(0, item->slot->number);
	for (int i = 0; i < 4; i++) {
		item->pin[i] = NET_NONE;
		item->given[i] = variable_of(-1, 0);
	}
	first = word->pin_count ? pin_row(row, word_pins(word)[0].name,
					  strlen(word_pins(word)[0].name)) : -1;
	if (first < 0)
		return out_refuse(e, DIAG_EXPORT_WORD, "%s", word->word);
	item->pin[first] = at->in;
	for (int i = 0; i < at->pins; i++) {
		const struct network_pin *pin = &network->pin[at->first_pin + i];
		const char *name = project_text(e->project, pin->operand);
		int to = pin_row(row, name, strlen(name));

		if (to < 0)
			return out_refuse(e, DIAG_EXPORT_WORD, "%s.%s", word->word, name);
		item->pin[to] = pin->in;
		item->moved |= pin->row != at->row + to;
	}
	item->moved |= first != 0;
	block = row->kind >= 0 ? block_entry(e, row->kind, item->slot->number) : NULL;
	if (block && item->word != FB_TON && item->word != FB_TOF && item->word != FB_TP &&
	    !own_block(e, item->slot, block))
		return false;
	for (const char *next = args; args_next(&next, &arg);)
		if (!box_argument(e, row, &arg, item))
			return false;
	return e->good && (row < &box_rows[OWN_ROWS] ? own_given(e, item, args) :
						       iec_given(e, item, args));
}
