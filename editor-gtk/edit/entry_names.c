/* SPDX-License-Identifier: MIT
 *
 * entry_names - the meaning of a name, a path, an address in any spelling or a mnemonic,
 * and names for new variables; see entry_names.h.
 */
#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/name.h"
#include "engine/ladder.h"
#include "engine/model/expr.h"

#include <stdio.h>
#include <string.h>

static const struct var *find_in(const struct project *project,
				 const struct var_table *table, const char *text,
				 size_t len, uint16_t *flags)
{
	const int i = vars_find(table, names_find_any(&project->names, text, len));

	if (i >= 0 && flags)
		*flags = vars_flags(table, i);
	return i >= 0 ? &table->var[i] : NULL;
}

const struct var *entry_var_find(const struct entry_place *place, const char *text,
				 size_t len, uint16_t *flags)
{
	const struct pou *pou = entry_pou(place);
	const struct var *var = pou ? find_in(place->project, &pou->vars, text, len,
					      flags) : NULL;

	return var ? var : find_in(place->project, &place->project->globals, text, len,
				   flags);
}

bool entry_is_name(const char *text, size_t len)
{
	char name[LIMIT_NAME + 1];

	if (len > LIMIT_NAME)
		return false;
	memcpy(name, text, len);
	name[len] = '\0';
	return ladder_name_fault(name) == DIAG_COUNT;
}

/* ---- addresses of other dialects ---- */

const char entry_no_address[] = N_("“%s” is not an address");

bool entry_address_parse(const char *text, size_t len, struct iec_addr *out,
			 const char **why)
{
	struct dialect foreign;

	switch (iec_addr_parse(text, len, out)) {
	case ADDR_OK:
		return true;
	case ADDR_RANGE:
		*why = iec_addr_fault(text, len, out) == DIAG_BAD_BIT ?
		       N_("“%s” is not an address: the bits of a byte are 0 to 7") :
		       N_("“%s” is not an address of this project");
		return true;
	case ADDR_NONE:
		break;
	}
	if (dialect_find(text, len, 0, &foreign) &&
	    (foreign.kind == DIALECT_ADDRESS || foreign.kind == DIALECT_UNSURE)) {
		*out = foreign.addr;
		if (foreign.kind == DIALECT_UNSURE)
			*why = N_("“%s” is octal in some controllers and hexadecimal in others: "
				  "write %%IX1.0");
		return true;
	}
	if (len > 0 && text[0] == '%')
		*why = entry_no_address;
	return *why != NULL;
}

/* ---- paths ---- */

static void fail(struct entry_target *out, const char *why)
{
	out->means = MEANS_WRONG;
	out->why = why;
}

/* The end of `[3]`, `[-3]` or `[i]` at @at; NULL: no index. */
static const char *index_end(const char *at, const char *end)
{
	struct lex lex;
	bool minus;

	lex_init(&lex, at + 1, (size_t)(end - at - 1));
	lex_next(&lex);
	minus = lex_accept(&lex, "-");
	if (lex.token.kind != TOKEN_NUMBER &&
	    (minus || (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_ADDRESS)))
		return NULL;
	lex_next(&lex);
	return lex_is(&lex, "]") ? lex.token.text + 1 : NULL;
}

static bool is_number(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | CLASS_BITS);
}

/* `.3`, `.%X3`, `.%B1` from the dot to @end: the bits of a number. False: it has no such part. */
static bool take_part(const char *dot, const char *end, struct entry_target *out)
{
	const struct expr_tail tail = { dot + 1, (uint16_t)(end - dot - 1) };
	unsigned int bits, number;

	if (out->array || !is_number(out->type) || !expr_part(tail, &bits, &number) ||
	    bits * (number + 1) > 8u * iec_type_row(out->type)->size)
		return false;
	out->type = bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE : bits == 16 ? IEC_WORD :
		    bits == 32 ? IEC_DWORD : IEC_LWORD;
	out->word = WORD_COUNT;
	out->var = NULL;
	return true;
}

/* The end of a step, `[3]` or `.Q`, at @at; NULL: wrong. */
static const char *step(const struct entry_place *place, const char *at, const char *end,
			struct entry_target *out)
{
	const struct word_row *row;
	const char *stop = at + 1;
	int pin;

	if (*at == '[') {
		if (!out->array)
			return NULL;
		out->array = false;
		return index_end(at, end);
	}
	while (stop < end && *stop != '.' && *stop != '[')
		stop++;
	if (*at == '.' && is_number(out->type))
		return take_part(at, end, out) ? end : NULL;
	if (*at != '.' || out->type != IEC_NONE || out->array || stop == at + 1)
		return NULL;
	row = words_row(&place->project->words, out->word);
	pin = word_pin_find(row, at + 1, (size_t)(stop - at - 1));
	if (pin < 0 || pin >= row->pin_count)
		return NULL;
	out->type = row->pin[pin].type;
	out->word = out->type == IEC_NONE ? row->pin[pin].word : WORD_COUNT;
	out->array = row->pin[pin].elements > 0;
	out->write &= row->kind == WORD_STRUCT || row->pin[pin].dir == PIN_IN;
	return stop;
}

static void walk(const struct entry_place *place, const char *at, const char *end,
		 struct entry_target *out)
{
	while (at && at < end)
		at = step(place, at, end, out);
	if (!at)
		fail(out, out->type == IEC_NONE && !out->array ?
		     N_("“%s” is not a pin or member") :
		     is_number(out->type) && !out->array ?
		     N_("“%s”: the number has no such bit") :
		     N_("“%s” does not exist: the variable has no elements and no members"));
	else
		out->means = out->type == IEC_NONE ? MEANS_INSTANCE : MEANS_VALUE;
}

static bool may_write(const struct var *var, uint16_t flags)
{
	return !(flags & (VAR_CONSTANT | VAR_INPUT)) &&
	       (var->at.area == AREA_NONE ||
		iec_area_row(var->at.area)->access == ACCESS_WRITE);
}

static bool find_system(const char *text, size_t len, struct entry_target *out)
{
	for (int i = 0; i < SYS_COUNT; i++) {
		const struct sys_row *row = sys_row((enum sys_id)i);

		if (!ascii_is(row->name, text, len))
			continue;
		out->means = MEANS_VALUE;
		out->type = row->type;
		snprintf(out->text, sizeof(out->text), "%s", row->name);
		return true;
	}
	return false;
}

/* `Fill.X` or `Fill.T` of a step of this chart. @head: bytes of the name before the dot. */
static bool find_step(const struct entry_place *place, const char *text, size_t head, size_t len,
		      struct entry_target *out)
{
	const struct pou *pou = entry_pou(place);
	const char member = len == head + 2 ? (char)(text[head + 1] & ~0x20) : 0;

	for (int i = 0; pou && pou->sfc && i < pou->sfc->step_count; i++) {
		const char *name = project_text(place->project, pou->sfc->step[i].name);

		if (text[head] != '.' || (member != 'X' && member != 'T') ||
		    !name_is(name, text, head))
			continue;
		out->means = MEANS_VALUE;
		out->type = member == 'X' ? IEC_BOOL : IEC_TIME;
		snprintf(out->text, sizeof(out->text), "%s.%c", name, member);
		return true;
	}
	return false;
}

/* The one variable of a plain type at exactly this address; NULL: none. */
static const struct var *var_on(const struct var_table *table, struct iec_addr addr)
{
	for (int i = 0; i < table->count; i++) {
		const struct var *var = &table->var[i];

		if (var->at.area == addr.area && var->at.bits == addr.bits &&
		    var->at.byte == addr.byte && var->at.bit == addr.bit &&
		    var->array.count == 0)
			return var;
	}
	return NULL;
}

static void take_address(const struct entry_place *place, const char *text, size_t len,
			 size_t head, struct entry_target *out)
{
	const struct pou *pou = entry_pou(place);
	const struct var *var = NULL;
	char address[40];

	if (head < len && text[head] == '.') {
		out->type = iec_addr_type(out->addr);
		if (!project_has(place->project, out->addr) || !take_part(text + head, text + len, out)) {
			fail(out, N_("“%s”: the number has no such bit"));
			return;
		}
		out->means = MEANS_VALUE;
		out->write = iec_area_row(out->addr.area)->access == ACCESS_WRITE;
		iec_addr_print(out->addr, address, sizeof(address));
		snprintf(out->text, sizeof(out->text), "%s%.*s", address, (int)(len - head), text + head);
		out->addr = (struct iec_addr){ .area = AREA_NONE };
		return;
	}
	if (head < len && index_end(text + head, text + len) != text + len) {
		fail(out, N_("“%s” has no valid index: write a number or a variable"));
		return;
	}
	if (!project_has(place->project, out->addr)) {
		fail(out, N_("“%s” is not an address of this project"));
		return;
	}
	if (head == len && pou)
		var = var_on(&pou->vars, out->addr);
	if (head == len && !var)
		var = var_on(&place->project->globals, out->addr);
	iec_addr_print(out->addr, address, sizeof(address));
	out->means = MEANS_VALUE;
	out->var = var;
	out->type = var ? var->type : iec_addr_type(out->addr);
	out->write = iec_area_row(out->addr.area)->access == ACCESS_WRITE;
	snprintf(out->text, sizeof(out->text), "%s%.*s",
		 var ? project_text(place->project, var->name) : address,
		 (int)(len - head), text + head);
}

/* A name that another tool sets by itself, and that would be an ordinary bit, or a new name, here: it
 * is not taken in silence. A variable at its address is meant otherwise. */
static bool find_special(const struct entry_place *place, const char *text, size_t len,
			 struct entry_target *out)
{
	const struct pou *pou = entry_pou(place);
	const bool addressed = iec_addr_parse(text, len, &out->addr) == ADDR_OK;
	struct dialect_special special;

	if (!dialect_special(text, len, &special) ||
	    (addressed && ((pou && var_on(&pou->vars, out->addr)) ||
			   var_on(&place->project->globals, out->addr)))) {
		out->addr = (struct iec_addr){ .area = AREA_NONE };
		return false;
	}
	snprintf(out->instead, sizeof(out->instead), "%s", special.ours);
	if (!*special.ours && addressed)
		iec_addr_print(out->addr, out->instead, sizeof(out->instead));
	fail(out, *special.ours ? N_("“%s” is set by other controllers themselves: write %s, which is the same here") :
	     addressed && out->addr.area == AREA_SM ? N_("“%s” has another meaning in other controllers: write %s if you mean the one of Rungboard") :
	     addressed ? N_("“%s” is set by other controllers themselves; nothing sets it here: write %s if you mean an ordinary address") :
	     N_("“%s” is set by other controllers themselves; nothing sets it here"));
	return true;
}

/* ---- blocks, words and steps of other dialects ---- */

/* The variable called @stem, or @stem and more behind a _; else the step of that name. NULL: none. */
static const char *find_stem(const struct entry_place *place, const char *stem, bool step)
{
	const struct pou *pou = entry_pou(place);
	const struct var_table *tables[] = { pou ? &pou->vars : NULL, &place->project->globals };
	const size_t len = strlen(stem);

	for (int i = 0; step && pou && pou->sfc && i < pou->sfc->step_count; i++) {
		const char *name = project_text(place->project, pou->sfc->step[i].name);

		if (name_is(name, stem, len))
			return name;
	}
	for (int t = 0; t < 2 && !step; t++)
		for (int i = 0; tables[t] && i < tables[t]->count; i++) {
			const char *name = project_text(place->project, tables[t]->var[i].name);

			if (!strncmp(name, stem, len) && (name[len] == '\0' || name[len] == '_'))
				return name;
		}
	return NULL;
}

/* A pin or step of ClassicLadder: @path gets its name in this project, empty: there is none; and
 * @out the first meaning. */
static bool find_pin(const struct entry_place *place, const char *text, size_t len,
		     struct dialect *out, char *path, size_t size)
{
	struct dialect foreign;

	path[0] = '\0';
	if (!dialect_find(text, len, 0, out) ||
	    (out->kind != DIALECT_PIN && out->kind != DIALECT_STEP))
		return false;
	for (int i = 0; !*path && dialect_find(text, len, i, &foreign); i++) {
		const bool step = !strcmp(foreign.pin, "X") || !strcmp(foreign.pin, "T");
		const char *name = find_stem(place, foreign.name, step);

		if (name)
			snprintf(path, size, "%s%s%s", name, *foreign.pin ? "." : "", foreign.pin);
	}
	return true;
}

/* Removes blanks in brackets, as in stored cells. Returns the length. */
static size_t tighten(const char *text, size_t len, char *out)
{
	size_t n = 0;
	int depth = 0;

	for (size_t i = 0; i < len; i++) {
		depth += (text[i] == '[') - (text[i] == ']');
		if (depth <= 0 || (text[i] != ' ' && text[i] != '\t'))
			out[n++] = text[i];
	}
	out[n] = '\0';
	return n;
}

/* Another tool's name of a block, word or step, in its meaning here. False: it is none. */
static bool take_foreign(const struct entry_place *place, const char *text, size_t len,
			 struct entry_target *out)
{
	struct dialect *foreign = &out->foreign;
	char path[ENTRY_TEXT];

	if (find_pin(place, text, len, foreign, path, sizeof(path))) {
		if (*path) {
			entry_target_find(place, path, strlen(path), out);
			return true;
		}
		if (foreign->kind == DIALECT_STEP) {
			fail(out, N_("“%s” is no step of this program: a step is named as in Step0.X"));
			return true;
		}
		snprintf(out->text, sizeof(out->text), "%s.%s", foreign->name, foreign->pin);
		out->means = MEANS_NEW_PIN;
		return true;
	}
	if (foreign->kind == DIALECT_BLOCK || foreign->kind == DIALECT_WORD)
		out->means = MEANS_NEW;
	else
		memset(foreign, 0, sizeof(*foreign));
	return out->means == MEANS_NEW;
}

void entry_target_find(const struct entry_place *place, const char *typed, size_t len,
		       struct entry_target *out)
{
	char text[ENTRY_TEXT];
	uint16_t flags = 0;
	size_t head = 0, whole = 0;

	memset(out, 0, sizeof(*out));
	if (len == 0 || len >= sizeof(out->text))
		return;
	len = tighten(typed, len, text);
	memcpy(out->text, text, len);
	if (!entry_var_find(place, text, len, NULL) && find_special(place, text, len, out))
		return;
	if (*text == '%' && take_foreign(place, text, len, out))
		return;
	while (head < len && text[head] != '.' && text[head] != '[')
		head++;
	while (whole < len && text[whole] != '[' && strncmp(text + whole, ".%", 2) != 0)
		whole++;
	if (find_step(place, text, head, len, out))
		return;
	out->var = entry_var_find(place, text, head, &flags);
	if (out->var) {
		out->type = out->var->type;
		out->word = out->var->fb;
		out->array = out->var->array.count > 0;
		out->write = may_write(out->var, flags);
		snprintf(out->text, sizeof(out->text), "%s%.*s",
			 project_text(place->project, out->var->name),
			 (int)(len - head), text + head);
		walk(place, text + head, text + len, out);
	} else if (find_system(text, len, out)) {
		return;
	} else if (entry_address_parse(text, whole, &out->addr, &out->why)) {
		if (out->why)
			out->means = MEANS_WRONG;
		else
			take_address(place, text, len, whole, out);
	} else if (take_foreign(place, text, len, out)) {
		return;
	} else if (entry_is_name(text, len)) {
		out->means = MEANS_NEW;
	} else if (entry_is_name(text, head)) {
		fail(out, N_("“%s” is not declared"));
	} else {
		fail(out, N_("“%s” cannot be the name of a variable"));
	}
}

/* ---- new names ---- */

bool entry_name_taken(const struct entry_place *place, const struct entry *entry,
		      const char *name)
{
	const struct project *project = place->project;
	const struct pou *pou = entry_pou(place);
	const size_t len = strlen(name);

	if (entry_var_find(place, name, len, NULL) || !entry_is_name(name, len))
		return true;
	if (project_find_pou(project, name, len) >= 0)
		return true;
	for (int i = 0; pou && i < pou->rung_count; i++)
		if (name_is(project_text(project, pou->rung[i]->label), name, len))
			return true;
	for (int i = 0; entry && i < entry->declares; i++)
		if (name_is(entry->declare[i].name, name, len))
			return true;
	return false;
}

void entry_fresh_name(const struct entry_place *place, const struct entry *entry,
		      const char *base, char *out, size_t size)
{
	int i = 1;

	do
		snprintf(out, size, "%.*s%d", LIMIT_NAME - 12, base, i++);
	while (entry_name_taken(place, entry, out) && i < LIMIT_VARS);
}

const char *entry_family_base(const struct word_row *row)
{
	static const struct { const char *family, *base; } bases[] = {
		{ "Timers", "Delay" }, { "Counters", "Counter" },
		{ "Bistables", "Latch" }, { "Edges", "Edge" }, { "Stores", "Store" },
	};

	for (size_t i = 0; i < sizeof(bases) / sizeof(*bases); i++)
		if (!strcmp(bases[i].family, explain_family(row)))
			return bases[i].base;
	return row->word;
}

/* ---- words: tables of other dialects, then the catalogue and the project ---- */

static const struct entry_mnemonic elements[] = {
#define MNEMONIC(text, id, below, dialect) { text, ELEM_##id, below },
#include "editor-gtk/edit/entry_words.def"
};

static const struct { const char *text, *word; } functions[] = {
#define BOX(text, word, dialect) { text, word },
#include "editor-gtk/edit/entry_words.def"
};

#define COUNT(table) ((int)(sizeof(table) / sizeof(*(table))))

const struct entry_mnemonic *entry_mnemonic(int index)
{
	return index >= 0 && index < COUNT(elements) ? &elements[index] : NULL;
}

static enum word find_element(const char *text, size_t len, bool *below)
{
	for (int i = 0; i < COUNT(elements); i++)
		if (ascii_is(elements[i].text, text, len)) {
			*below = elements[i].below;
			return elements[i].word;
		}
	return WORD_COUNT;
}

enum word entry_word_find(const struct entry_place *place, const char *text, size_t len,
			  bool *below)
{
	enum word word = find_element(text, len, below);

	if (word != WORD_COUNT)
		return word;
	*below = false;
	for (int i = 0; i < COUNT(functions); i++)
		if (ascii_is(functions[i].text, text, len))
			return word_find(functions[i].word, strlen(functions[i].word));
	word = words_find(&place->project->words, text, len);
	if (word == WORD_COUNT || word == ELEM_EMPTY ||
	    words_row(&place->project->words, word)->kind == WORD_STRUCT)
		return WORD_COUNT;
	return word;
}

/* Compares without blanks: "||" for "| |". */
static size_t match(const char *glyph, const char *text)
{
	size_t n = strlen(glyph);
	char tight[4] = "";
	size_t len = 0;

	if (!strncmp(text, glyph, n))
		return n;
	for (size_t i = 0; i < n && i < 3; i++)
		if (glyph[i] != ' ')
			tight[len++] = glyph[i];
	return len > 1 && !strncmp(text, tight, len) ? len : 0;
}

static size_t dashes(const char *text)
{
	return strspn(text, "- ");
}

/* -<RET>-, -<RETURN>-, ->>Label: outputs that have no bars or brackets. */
static size_t flow_glyph(const char *text, enum word *word)
{
	const char *end = *text == '<' ? strchr(text, '>') : NULL;
	bool below;

	if (!strncmp(text, ">>", 2)) {
		*word = ELEM_JUMP;
		return 2;
	}
	if (!end)
		return 0;
	*word = find_element(text + 1, (size_t)(end - text - 1), &below);
	if (*word == WORD_COUNT)
		*word = word_find(text + 1, (size_t)(end - text - 1));
	return *word != WORD_COUNT && *word < ELEM_PIN && word_row(*word)->place == PLACE_LAST &&
	       (word_row(*word)->operand == OPND_NONE || word_row(*word)->operand == OPND_LOOP_END) ?
		(size_t)(end - text) + 1 : 0;
}

size_t entry_glyph(const char *line, enum word *word)
{
	const size_t before = dashes(line), flow = flow_glyph(line + before, word);

	if (flow)
		return before + flow + dashes(line + before + flow);
	if (line[before] != '|' && line[before] != '(')
		return 0;
	for (int i = 0; i < WORD_KNOWN; i++) {
		const struct word_row *row = word_row((enum word)i);
		size_t len;

		if (row->kind != WORD_ELEM || (row->operand != OPND_BOOL_R &&
					       row->operand != OPND_BOOL_W))
			continue;
		len = match(explain_glyph(row), line + before);
		if (len == 0)
			continue;
		*word = (enum word)i;
		return before + len + dashes(line + before + len);
	}
	return 0;
}
