/* SPDX-License-Identifier: MIT
 *
 * to_classic_names - the numbers that variables and blocks have in ClassicLadder.
 *
 * A variable with the address or name that an import gives keeps its number; any other gets
 * a number that is free. Names become symbols.
 */
#include "engine/base/ascii.h"
#include "engine/exchange/classic/to_classic_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool overlap(struct iec_addr a, int64_t bits, struct iec_addr b, int64_t more)
{
	int64_t from = (int64_t)a.byte * 8 + a.bit, to = (int64_t)b.byte * 8 + b.bit;

	return a.area == b.area && from < to + more && to < from + bits;
}

static int64_t bits_of(const struct var *var)
{
	return (int64_t)var->at.bits * (var->array.count ? var->array.count : 1);
}

static bool table_shares(const struct var_table *table, const struct var *var)
{
	for (int i = 0; i < table->count; i++)
		if (&table->var[i] != var && table->var[i].at.area != AREA_NONE &&
		    overlap(var->at, bits_of(var), table->var[i].at,
			    bits_of(&table->var[i])))
			return true;
	return false;
}

/* Does another variable or address overlap the memory of @var? */
static bool is_shared(struct leaving *e, const struct var *var)
{
	const struct names *names = &e->project->names;

	for (uint32_t id = 1; id < (uint32_t)names->count; id++) {
		const char *text = names_text(names, id);
		struct iec_addr addr;

		if (id != var->at_text && iec_addr_parse(text, strlen(text), &addr) == ADDR_OK &&
		    overlap(var->at, bits_of(var), addr, addr.bits) &&
		    memcmp(&addr, &var->at, sizeof(addr)) != 0)
			return true;
	}
	if (table_shares(&e->project->globals, var))
		return true;
	for (int i = 0; i < e->project->pou_count; i++)
		if (table_shares(&e->project->pou[i].vars, var))
			return true;
	return false;
}

/* Prefix of a block in ClassicLadder. */
static const char *const block_there[CLASSIC_KINDS] = { "T", "M", "TM", "C", "R" };

/* classic.def has 300 of LinuxCNC as 1300. */
static int written_type(const struct leaving *e, int type)
{
	return e->dialect == CLASSIC_LINUXCNC && type == 1300 ? 300 : type;
}

void size_note(struct leaving *e, int type, int number)
{
	if (type >= 0 && type < 400 && number >= e->sizes[type])
		e->sizes[type] = number + 1;
	if (number >= CLASSIC_LIMIT)
		out_refuse(e, DIAG_EXPORT_MANY, "%d", number);
}

int new_bit(struct leaving *e)
{
	size_note(e, CL_BIT, e->next_bit);
	return e->next_bit++;
}

int new_word(struct leaving *e)
{
	size_note(e, CL_WORD, e->next_word);
	return e->next_word++;
}

int spare_bit(struct leaving *e)
{
	if (e->helpers_used == e->spares) {
		int *slot = arena_push(e->arena, &e->spare, &e->spares, sizeof(*slot));

		if (!slot)
			return 0;
		*slot = new_bit(e);
	}
	return e->spare[e->helpers_used++];
}

int never_bit(struct leaving *e)
{
	if (e->never < 0)
		e->never = new_bit(e);
	return e->never;
}

int extra_bit(struct leaving *e, struct out_slot *slot, int index)
{
	if (slot->extra[index] < 0)
		slot->extra[index] = new_bit(e);
	return slot->extra[index];
}

/* ---- addresses ---- */

static bool bit_of(struct leaving *e, struct iec_addr addr, struct classic_variable *out)
{
	int bit = (int)addr.byte * 8 + addr.bit;

	switch ((int)addr.area) {
	case AREA_I: *out = variable_of(50, bit); return true;
	case AREA_Q: *out = variable_of(60, bit); return true;
	case AREA_M: *out = variable_of(CL_BIT, bit); return true;
	case AREA_XQ: *out = variable_of(65, bit); return e->dialect == CLASSIC_UPSTREAM;
	case AREA_S:
		*out = bit < 256 ? variable_of(CL_SYSTEM_BIT, bit) :
				   variable_of(75, bit - 256);
		return bit < 512;
	case AREA_SM:
		break;
	default:
		return false;
	}
	/* SYS_FIRST_SCAN, SYS_CLOCK_1MIN, SYS_CLOCK_1S */
	e->clocks |= bit == 4 || bit == 5;
	*out = variable_of(CL_SYSTEM_BIT, bit == 1 ? 4 : bit == 4 ? 2 : 0);
	return e->dialect == CLASSIC_UPSTREAM && (bit == 1 || bit == 4 || bit == 5);
}

static bool word_of(struct leaving *e, struct iec_addr addr, struct classic_variable *out)
{
	int number = (int)addr.byte / 4;
	bool lc = e->dialect == CLASSIC_LINUXCNC;
	bool analog = addr.area == AREA_AI || addr.area == AREA_AQ;

	if (analog && addr.bits == 16)
		number = (int)addr.byte / 2;
	else if (addr.bits != 32)
		return false;
	if (addr.byte % (addr.bits / 8u))
		return false;
	if (analog) {
		uint8_t *wide = &e->wide[addr.area == AREA_AQ];

		*wide |= addr.bits == 16 ? 1 : 2;
		if (*wide == 3) /* %AIW2 and %AID4 would both be %IW1 */
			return false;
	}
	switch ((int)addr.area) {
	case AREA_V: *out = variable_of(CL_WORD, number); return true;
	case AREA_AI: *out = variable_of(270, number); return true;
	case AREA_AQ: *out = variable_of(280, number); return true;
	case AREA_S:
		*out = variable_of(CL_INPUT_SYSTEM_WORD, number - 16);
		return number >= 16;
	case AREA_XAI: *out = variable_of(written_type(e, 1300), number); return lc;
	case AREA_XAQ: *out = variable_of(310, number); return lc;
	default:
		return false;
	}
}

static bool address_variable(struct leaving *e, struct iec_addr addr,
			     struct out_operand *out)
{
	bool known;

	out->is_bool = addr.bits == 1;
	known = out->is_bool ? bit_of(e, addr, &out->variable) :
			       word_of(e, addr, &out->variable);
	if (known) {
		size_note(e, out->variable.type, out->variable.number);
		return true;
	}
	return false;
}

/* ---- numbers in use ---- */

static void note_address(struct leaving *e, const char *text, size_t len, bool index)
{
	struct iec_addr addr;

	if (iec_addr_parse(text, len, &addr) != ADDR_OK)
		return;
	e->asks_first |= addr.area == AREA_SM;
	if (addr.area == AREA_M && addr.bits == 1) {
		int bit = (int)addr.byte * 8 + addr.bit;

		e->bit_index |= index;
		if (bit >= e->next_bit)
			e->next_bit = bit + 1;
	} else if (addr.area == AREA_V) {
		int word = (int)addr.byte / 4;

		e->word_index |= index;
		if (word >= e->next_word)
			e->next_word = word + 1;
	}
}

/* Notes all addresses in a text of the project. */
static void note_text(struct leaving *e, const char *text)
{
	while (*text) {
		size_t len = 0;

		while (ascii_digit(text[len]) || text[len] == '%' || text[len] == '.' ||
		       (ascii_upper(text[len]) >= 'A' && ascii_upper(text[len]) <= 'Z'))
			len++;
		if (len)
			note_address(e, text, len, text[len] == '[');
		text += len ? len : 1;
	}
}

static void note_array(struct leaving *e, const struct var *var)
{
	int last;

	if (!var->array.count || var->at.area == AREA_NONE)
		return;
	if (var->at.area == AREA_V && var->at.bits == 32) {
		last = (int)(var->at.byte / 4 + var->array.count);
		if (last > e->next_word)
			e->next_word = last;
		size_note(e, CL_WORD, last - 1);
	} else if (var->at.area == AREA_M && var->at.bits == 1) {
		last = (int)(var->at.byte * 8 + var->at.bit + var->array.count);
		if (last > e->next_bit)
			e->next_bit = last;
	}
}

static bool names_first(const char *text)
{
	static const char word[] = "SYS_FIRST_SCAN";

	for (; *text; text++)
		if (ascii_is(word, text, strnlen(text, sizeof(word) - 1)))
			return true;
	return false;
}

static void note_all(struct leaving *e)
{
	const struct names *names = &e->project->names;

	for (uint32_t id = 1; id < (uint32_t)names->count; id++) {
		const char *text = names_text(names, id);

		if (strncmp(text, "(*", 2) != 0)
			note_text(e, text);
		e->asks_first |= names_first(text);
	}
	/* Modbus and spy windows can read low numbers that the program does not use. */
	if (e->dialect == CLASSIC_UPSTREAM && e->next_bit < 300)
		e->next_bit = 300;
	if (e->dialect == CLASSIC_UPSTREAM && e->next_word < 100)
		e->next_word = 100;
	if (e->bit_index && e->next_bit < 500)
		e->next_bit = 500;
	if (e->word_index && e->next_word < 200)
		e->next_word = 200;
	e->first = e->asks_first && e->dialect != CLASSIC_UPSTREAM ? new_bit(e) : -1;
}

/* ---- slots ---- */

struct out_slot *slot_find(struct leaving *e, const struct var *var)
{
	for (int i = 0; i < e->slots; i++)
		if (e->slot[i].var == var)
			return &e->slot[i];
	return NULL;
}

static int block_of(enum word fb)
{
	switch ((int)fb) {
	case FB_CL_TIMER: return CLASSIC_TIMER;
	case FB_CL_MONO: return CLASSIC_MONOSTABLE;
	case FB_CL_TON: case FB_CL_TOF: case FB_CL_TP:
	case FB_TON: case FB_TOF: case FB_TP: return CLASSIC_IEC_TIMER;
	case FB_CL_COUNTER: case FB_CTU: case FB_CTD: case FB_CTUD: return CLASSIC_COUNTER;
	case FB_CL_REGISTER: return CLASSIC_REGISTER;
	}
	return -1;
}

static bool block_taken(const struct leaving *e, int kind, int number)
{
	for (int i = 0; i < e->slots; i++)
		if (e->slot[i].block == kind && e->slot[i].number == number)
			return true;
	return false;
}

/* TM3_Delay is %TM3; -1: the name has no number. */
static int number_in(const struct leaving *e, const char *name, int kind)
{
	size_t len = strlen(classic_kind_names[kind]);
	char *end;
	long number;

	if (strncmp(name, classic_kind_names[kind], len) != 0 || !ascii_digit(name[len]))
		return -1;
	number = strtol(name + len, &end, 10);
	if ((*end && *end != '_') || number >= CLASSIC_LIMIT ||
	    block_taken(e, kind, (int)number))
		return -1;
	return (int)number;
}

static bool whole_number(enum iec_type type)
{
	return type == IEC_SINT || type == IEC_INT || type == IEC_DINT ||
	       type == IEC_USINT || type == IEC_UINT || type == IEC_BYTE ||
	       type == IEC_WORD;
}

static void memory_slot(struct leaving *e, struct out_slot *slot)
{
	const struct var *var = slot->var;
	int count = var->array.count ? (int)var->array.count : 1;
	struct out_operand operand;

	slot->type = -1; /* no number: a use of it is refused */
	if (count > CLASSIC_LIMIT || (var->type != IEC_BOOL && !whole_number(var->type)))
		return;
	slot->count = count;
	if (var->at.area != AREA_NONE) {
		if (address_variable(e, var->at, &operand)) {
			slot->type = operand.variable.type;
			slot->number = operand.variable.number;
			return;
		}
		if ((var->at.area != AREA_V && var->at.area != AREA_M) ||
		    is_shared(e, var))
			return;
	}
	slot->type = var->type == IEC_BOOL ? CL_BIT : CL_WORD;
	slot->number = slot->type == CL_BIT ? new_bit(e) : new_word(e);
	for (int i = 1; i < count && e->good; i++)
		slot->type == CL_BIT ? new_bit(e) : new_word(e);
}

static void add_slot(struct leaving *e, const struct pou *pou, const struct var *var,
		     bool blocks)
{
	struct out_slot *slot;
	int kind = block_of(var->fb);

	if (slot_find(e, var) || blocks != (var->type == IEC_NONE))
		return;
	slot = arena_push(e->arena, &e->slot, &e->slots, sizeof(*slot));
	if (!slot)
		return;
	*slot = (struct out_slot){ .var = var, .pou = pou, .block = -1, .number = -1,
		.type = -1, .name = project_text(e->project, var->name),
		.comment = project_text(e->project, var->comment),
		.extra = { -1, -1, -1, -1 } };
	if (!blocks) {
		memory_slot(e, slot);
		return;
	}
	if (kind >= 0 && !var->array.count) {
		slot->number = number_in(e, slot->name, kind);
		slot->block = kind;
	}
}

/* Blocks without a number in their name get one that is free. */
static void number_blocks(struct leaving *e)
{
	for (int i = 0; i < e->slots; i++) {
		struct out_slot *slot = &e->slot[i];
		int *next;

		if (slot->block < 0)
			continue;
		next = &e->next_block[slot->block];
		while (slot->number < 0 && block_taken(e, slot->block, *next))
			(*next)++;
		if (slot->number < 0)
			slot->number = *next;
		if (slot->number >= CLASSIC_LIMIT)
			out_refuse(e, DIAG_EXPORT_MANY, "%s", slot->name);
	}
}

static void add_table(struct leaving *e, const struct pou *pou,
		      const struct var_table *table, bool blocks)
{
	for (int i = 0; i < table->count; i++)
		if (!(vars_flags(table, i) & VAR_SFC))
			add_slot(e, pou, &table->var[i], blocks);
}

bool names_prepare(struct leaving *e)
{
	note_all(e);
	for (int i = 0; i < e->project->globals.count; i++)
		note_array(e, &e->project->globals.var[i]);
	for (int pass = 0; pass < 2; pass++) {
		add_table(e, NULL, &e->project->globals, pass);
		for (int i = 0; i < e->project->pou_count; i++)
			if (!pou_has_frame(&e->project->pou[i]))
				add_table(e, &e->project->pou[i], &e->project->pou[i].vars,
					  pass);
	}
	number_blocks(e);
	return e->good;
}

static bool no_number(struct leaving *e, const char *text)
{
	return out_refuse(e, DIAG_EXPORT_TYPE, "%s", text);
}

static bool pin_operand(struct leaving *e, const struct meaning *m, const char *text,
			struct out_operand *out)
{
	struct out_slot *slot = slot_find(e, m->var);
	const struct word_row *row = scope_row(e->scope, m->var->fb);
	const char *pin = word_pins(row)[m->pin].name;

	if (!slot)
		return no_number(e, text);
	if (slot->type == CL_STEP_TIME && !strcmp(pin, "V")) {
		out->variable = variable_of(CL_STEP_TIME, slot->number);
		return true;
	}
	out->is_bool = true;
	switch ((int)m->var->fb) {
	case FB_SR: case FB_RS: case FB_R_TRIG: case FB_F_TRIG:
	case FB_CTU: case FB_CTD: case FB_CTUD:
		if (pin[0] != 'Q')
			break;
		out->variable = variable_of(CL_BIT, extra_bit(e, slot,
							      !strcmp(pin, "QD")));
		return true;
	}
	if (slot->block == CLASSIC_COUNTER && !strcmp(pin, "CV"))
		pin = "V";
	for (const struct classic_pin_row *row_of = classic_pin_rows;
	     row_of < classic_pin_rows + CLASSIC_PIN_ROWS; row_of++)
		if ((int)row_of->kind == slot->block && !strcmp(row_of->pin, pin)) {
			out->variable = variable_of(row_of->type, slot->number);
			out->is_bool = row_of->is_bool;
			return true;
		}
	return no_number(e, text);
}

static bool slot_operand(struct leaving *e, const struct meaning *m, const char *text,
			 struct out_operand *out)
{
	const struct out_slot *slot = slot_find(e, m->var);

	if (!slot || slot->type < 0 || slot->block >= 0)
		return no_number(e, text);
	out->variable = variable_of(slot->type, slot->number);
	out->is_bool = slot->type == CL_STEP_BIT || m->var->type == IEC_BOOL;
	if (m->kind == MEANING_ELEMENT)
		out->variable.number += (int)(m->offset / var_unit(m->var));
	return true;
}

static bool literal_operand(struct leaving *e, const struct literal *literal,
			    const char *text, struct out_operand *out)
{
	union iec_value value;

	out->is_constant = true;
	out->is_bool = literal->type == IEC_BOOL;
	if (!out->is_bool && !literal_fit(literal, IEC_DINT, &value) &&
	    !whole_number(literal->type))
		return no_number(e, text);
	out->value = (int32_t)literal->value.i;
	return true;
}

static bool meaning_operand(struct leaving *e, const struct meaning *m,
			    const char *text, struct out_operand *out);

static bool element_operand(struct leaving *e, const struct meaning *m, const char *text,
			    struct out_operand *out)
{
	struct out_operand index;
	int low = 0;

	if (m->var && m->var->at.area == AREA_NONE) {
		if (!slot_operand(e, m, text, out))
			return false;
	} else if (!address_variable(e, m->addr, out)) {
		return no_number(e, text);
	}
	if (!meaning_is_indexed(m))
		return true;
	if (m->opens > 1 || !m->index_of ||
	    !meaning_operand(e, m->index_of, text, &index) || index.is_bool ||
	    index.variable.index_type >= 0)
		return no_number(e, text);
	low = m->open[0].array.low;
	if (out->variable.number < low)
		return no_number(e, text);
	out->variable.number -= low;
	e->indexes = true;
	out->variable.index_type = index.variable.type;
	out->variable.index_number = index.variable.number;
	return true;
}

static bool meaning_operand(struct leaving *e, const struct meaning *m,
			    const char *text, struct out_operand *out)
{
	*out = (struct out_operand){ .variable = variable_of(-1, 0) };
	switch ((int)m->kind) {
	case MEANING_VARIABLE:
		return slot_operand(e, m, text, out);
	case MEANING_PIN:
		return pin_operand(e, m, text, out);
	case MEANING_ELEMENT:
		return element_operand(e, m, text, out);
	case MEANING_ADDRESS:
		if (m->addr.area == AREA_SM && m->addr.bits == 1 && !m->addr.byte &&
		    !m->addr.bit) {
			*out = (struct out_operand){ .is_bool = true,
				.is_constant = true, .value = 1 };
			return true;
		}
		if (m->addr.area == AREA_SM && e->dialect != CLASSIC_UPSTREAM &&
		    m->addr.bits == 1 && !m->addr.byte && m->addr.bit == 1) {
			*out = (struct out_operand){ .is_bool = true,
				.variable = variable_of(CL_BIT, e->first) };
			return true;
		}
		return address_variable(e, m->addr, out) || no_number(e, text);
	case MEANING_LITERAL:
		return literal_operand(e, &m->literal, text, out);
	default:
		return no_number(e, text);
	}
}

bool there_find(struct leaving *e, uint32_t text, struct out_operand *out)
{
	enum diag_id why;
	const struct meaning *m = scope_find(e->scope, e->pou, text, &why);

	*out = (struct out_operand){ .variable = variable_of(-1, 0) };
	if (!m)
		return no_number(e, project_text(e->project, text));
	return meaning_operand(e, m, project_text(e->project, text), out);
}

bool there_text(struct leaving *e, const char *text, size_t len, struct out_operand *out)
{
	return there_find(e, names_intern(&e->project->names, text, len), out);
}

/* Of "(* %B3: the pump *)": "the pump". */
static const char *plain_comment(struct leaving *e, const char *text)
{
	size_t len = strlen(text);
	const char *colon;
	char *copy;

	if (len < 4 || text[0] != '(')
		return "";
	copy = arena_copy(e->arena, text + 2, len - 4);
	while (copy && *copy == ' ')
		copy++;
	for (len = copy ? strlen(copy) : 0; len && copy[len - 1] == ' '; len--)
		copy[len - 1] = '\0';
	if (!copy || *copy != '%')
		return copy ? copy : "";
	colon = strstr(copy, ": ");
	return colon && !memchr(copy, ' ', (size_t)(colon - copy)) ? colon + 2 :
	       strchr(copy, ' ') ? copy : "";
}

/* Is it the name that an import gives without a symbol? */
static bool says_number(const struct out_slot *slot, const char *own)
{
	char text[LIMIT_NAME + 16];

	snprintf(text, sizeof(text), "%s%d", own, slot->number);
	return !strcmp(text, slot->name);
}

static bool symbol_taken(const struct leaving *e, const char *name)
{
	for (int i = 0; i < e->out->symbols; i++)
		if (!strcmp(e->out->symbol[i].name, name))
			return true;
	return false;
}

/* At most 9 bytes; a number at the end if another symbol has the name. */
static const char *symbol_name(struct leaving *e, const char *name)
{
	const char *cut = out_text(e, "%.*s", classic_cut(name, CLASSIC_SYMBOL), name);

	for (int i = 2; symbol_taken(e, cut) && i < CLASSIC_LIMIT; i++) {
		int digits = snprintf(NULL, 0, "%d", i);

		cut = out_text(e, "%.*s%d", classic_cut(name, CLASSIC_SYMBOL - digits),
			       name, i);
	}
	return cut;
}

/* Adds the symbol of a variable: @prefix and a number in ClassicLadder, @own and a number in
 * an imported file. */
static void out_symbol(struct leaving *e, const struct out_slot *slot, const char *prefix,
		       const char *own)
{
	const char *comment = plain_comment(e, slot->comment), *name = slot->name;
	const int most = e->dialect == CLASSIC_UPSTREAM ? CLASSIC_COMMENT :
							  CLASSIC_SYMBOL_COMMENT;
	struct classic_symbol *symbol;
	size_t len = strlen(own);

	if (says_number(slot, own) && !*comment)
		return;
	if (slot->block >= 0 && !strncmp(name, own, len)) {
		/* TM0_Delay */
		while (ascii_digit(name[len]))
			len++;
		if (name[len] == '_' && name[len + 1])
			name += len + 1;
	}
	symbol = arena_push(e->arena, &e->out->symbol, &e->out->symbols, sizeof(*symbol));
	if (!symbol)
		return;
	e->out->symbols--;
	symbol->variable = out_text(e, "%%%s%d", prefix, slot->number);
	symbol->name = says_number(slot, own) ? "" : symbol_name(e, name);
	symbol->comment = comment;
	if (*symbol->name && strcmp(symbol->name, name) != 0)
		tell_line(e, slot->var->line, "%s is called %s in ClassicLadder", slot->name,
			  symbol->name);
	if (strlen(comment) > (size_t)most)
		tell_line(e, slot->var->line, "the comment of %s is cut to %d bytes",
			  slot->name, most);
	e->out->symbols++;
}

/* ---- symbols ---- */

void names_symbols(struct leaving *e)
{
	for (int i = 0; i < e->slots; i++) {
		const struct out_slot *slot = &e->slot[i];
		const struct classic_memory_row *row;

		if (slot->block >= 0) {
			out_symbol(e, slot, block_there[slot->block],
				   classic_kind_names[slot->block]);
			continue;
		}
		row = classic_memory_of(slot->type == written_type(e, 1300) ? 1300 : slot->type);
		if (row && slot->count == 1)
			out_symbol(e, slot, row->prefix, row->name ? row->name : "");
	}
}

static void first_scan_only(struct leaving *e, const struct out_part *output)
{
	bool upstream = e->dialect == CLASSIC_UPSTREAM;

	if (!upstream && e->started < 0)
		e->started = new_bit(e);
	draw_step(e, upstream ? CL_NO : CL_NC,
		  upstream ? variable_of(CL_SYSTEM_BIT, 4) :
			     variable_of(CL_BIT, e->started), output);
}

/* `%B3` set or reset, or `%W3:=5`. */
static struct out_part value_item(struct leaving *e, const struct out_slot *slot, int element,
				  int64_t value)
{
	struct classic_variable variable = variable_of(slot->type, slot->number + element);
	struct out_part item = { .code = value ? CL_SET : CL_RESET, .width = 1, .height = 1,
				 .variable = variable };

	if (slot->var->type == IEC_BOOL)
		return item;
	item.code = CL_OPERATE;
	item.width = 3;
	item.text = out_text(e, "%s:=%d", out_encode(e, variable), (int)value);
	return item;
}

/* Initial values of an array, as far as its list goes. */
static void initial_list(struct leaving *e, const struct out_slot *slot)
{
	const struct var *var = slot->var;
	int element = 0;

	for (int i = 0; i < var->init_count && e->good; i++)
		for (uint32_t k = 0; k < var->init_list[i].count && e->good; k++) {
			int64_t value = var->init_list[i].value.i;
			struct out_part item = value_item(e, slot, element++, value);

			if (value)
				first_scan_only(e, &item);
		}
}

void leave_temporaries(struct leaving *e, const struct pou *pou)
{
	for (int i = 0; i < pou->vars.count && e->good; i++) {
		const struct var *var = &pou->vars.var[i];
		const struct out_slot *slot = slot_find(e, var);
		struct out_part item;

		if (!(vars_flags(&pou->vars, i) & VAR_TEMP) || !slot || slot->type < 0)
			continue;
		if (var->array.count || slot->block >= 0) {
			out_refuse(e, DIAG_EXPORT_TYPE, "%s", slot->name);
			return;
		}
		item = value_item(e, slot, 0, var->has_init ? var->init.i : 0);
		draw_step(e, CL_WIRE, variable_of(0, 0), &item);
	}
}

static bool is_temporary(const struct out_slot *slot)
{
	return slot->pou && slot->var >= slot->pou->vars.var &&
	       slot->var < slot->pou->vars.var + slot->pou->vars.count &&
	       vars_flags(&slot->pou->vars, (int)(slot->var - slot->pou->vars.var)) & VAR_TEMP;
}

void leave_initial(struct leaving *e)
{
	section_begin(e, "Initial", -1, false);
	if (e->first >= 0) {
		const struct out_part first = { .code = CL_COIL, .width = 1, .height = 1,
			.variable = variable_of(CL_BIT, e->first) };

		first_scan_only(e, &first);
	}
	for (int i = 0; i < e->slots && e->good; i++) {
		const struct out_slot *slot = &e->slot[i];
		const struct var *var = slot->var;
		struct out_part item;

		/* A page sets bits of steps itself. */
		if (slot->block >= 0 || slot->type < 0 || slot->type == CL_STEP_BIT ||
		    !var->has_init || var->type == IEC_NONE || (slot->pou && pou_has_frame(slot->pou)))
			continue;
		e->pou = slot->pou;
		e->rung_index = -1;
		if (is_temporary(slot))
			continue;
		if (var->array.count) {
			initial_list(e, slot);
			continue;
		}
		item = value_item(e, slot, 0, var->init.i);
		if (var->init.i)
			first_scan_only(e, &item);
	}
	section_end(e, true);
}

/* The last section sets the bit that ends the first scan. */
void leave_started(struct leaving *e)
{
	struct out_part item = { .code = CL_SET, .width = 1, .height = 1 };

	if (e->started < 0)
		return;
	item.variable = variable_of(CL_BIT, e->started);
	section_begin(e, "Started", -1, false);
	draw_step(e, CL_WIRE, variable_of(0, 0), &item);
	section_end(e, false);
}
