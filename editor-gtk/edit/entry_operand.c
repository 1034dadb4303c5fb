/* SPDX-License-Identifier: MIT
 *
 * entry_operand - one operand of a line, anywhere in it; the declaration of its name, as in
 * `Open AT %IX0.5 : BOOL`; and proposals for a new name; see entry_operand.h.
 *
 * The declaration of a new name is used; that of an existing name must match. The engine
 * knows which addresses are free (xref/address_map.h); the project's habit decides in which
 * area a new one lies.
 */
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/xref/address_map.h"

#include <stdio.h>
#include <string.h>

bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len)
{
	if (len > sizeof(entry->what) - 1)
		len = sizeof(entry->what) - 1;
	entry->sense = ENTRY_WRONG;
	entry->why = why;
	memcpy(entry->what, what, len);
	entry->what[len] = '\0';
	memcpy(entry->wrong, entry->what, len + 1);
	entry->wrong_at = 0;
	entry->wrong_len = len;
	return false;
}

bool entry_append(char *out, size_t size, const char *text, size_t len)
{
	const size_t used = strlen(out);

	if (used + len + 1 > size)
		return false;
	memcpy(out + used, text, len);
	out[used + len] = '\0';
	return true;
}

bool entry_literal(const char *text, size_t len, char *out, size_t size, bool *fits)
{
	struct literal literal;
	int64_t ns;

	*fits = true;
	if (len > 0 && *text == '+')
		return false;
	if (literal_parse(text, len, &literal) == LITERAL_OK)
		*fits = entry_append(out, size, text, len);
	else if (literal_parse_duration(text, len, &ns))
		*fits = entry_append(out, size, "T#", 2) && entry_append(out, size, text, len);
	else
		return false;
	return true;
}

/* ---- types that fit ---- */

/* Any number fits where one class of numbers does. */
static uint16_t classes_with(uint16_t classes)
{
	return classes & ANY_NUM ? classes | ANY_NUM : classes;
}

struct entry_fit entry_fit_bool(bool write)
{
	return (struct entry_fit){ IEC_BOOL, WORD_COUNT, CLASS_BOOL, write };
}

struct entry_fit entry_fit_type(enum iec_type type, bool write)
{
	return (struct entry_fit){ type, WORD_COUNT,
				   classes_with(iec_type_row(type)->class), write };
}

/* The default type of some classes. */
static enum iec_type usual_of(uint16_t classes)
{
	static const struct { uint16_t class; enum iec_type type; } usual[] = {
		{ CLASS_SIGNED, IEC_INT }, { CLASS_REAL, IEC_REAL },
		{ CLASS_TIME, IEC_TIME }, { CLASS_BOOL, IEC_BOOL },
		{ CLASS_BITS, IEC_WORD }, { CLASS_UNSIGNED, IEC_UINT },
		{ CLASS_STRING, IEC_STRING }, { CLASS_TOD, IEC_TIME_OF_DAY },
		{ CLASS_DATE, IEC_DATE }, { CLASS_DT, IEC_DATE_AND_TIME },
	};

	for (size_t i = 0; i < sizeof(usual) / sizeof(*usual); i++)
		if (classes & usual[i].class)
			return usual[i].type;
	return IEC_INT;
}

static struct entry_fit fit_classes(uint16_t classes, enum iec_type shared, bool write)
{
	const bool fits = shared != IEC_NONE && iec_type_row(shared)->class & classes;

	return (struct entry_fit){ fits ? shared : usual_of(classes), WORD_COUNT, classes,
				   write };
}

struct entry_fit entry_fit_pin(const struct word_row *row, const struct word_pin *pin,
			       enum iec_type shared, bool write)
{
	if (row->kind == WORD_FN && pin->type == IEC_NONE)
		return fit_classes(pin->classes, pin->own ? IEC_NONE : shared, write);
	if (row->kind == WORD_FN || pin->type != IEC_NONE)
		return pin->elements ? (struct entry_fit){ .word = WORD_COUNT } :
				       entry_fit_type(pin->type, write);
	return (struct entry_fit){ .word = pin->elements ? WORD_COUNT :
				   (enum word)pin->word, .write = write };
}

struct entry_fit entry_fit_result(const struct word_row *row, enum iec_type shared)
{
	if (row->result == (int)RESULT_OPEN)
		return fit_classes(row->result_classes, IEC_NONE, true);
	if (!word_shares(row))
		return entry_fit_type(row->result, true);
	for (int i = 0; i < row->pin_count; i++)
		if (!row->pin[i].own)
			return fit_classes(row->pin[i].classes, shared, true);
	return fit_classes(ANY_NUM, shared, true);
}

/* ---- how wide ---- */

static int bits_of(enum iec_type type)
{
	if (type == IEC_BOOL)
		return 1;
	return iec_type_row(type)->class & ANY_SIMPLE ? iec_type_row(type)->size * 8 : 0;
}

/* The first signed type of the catalogue with this width, else the first one at all. */
static enum iec_type type_at(const struct entry_fit *fit, struct iec_addr addr)
{
	enum iec_type found = IEC_NONE;

	if (bits_of(fit->type) == addr.bits)
		return fit->type;
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++) {
		const enum iec_type type = (enum iec_type)i;
		const uint16_t class = iec_type_row(type)->class;

		if (!(class & fit->classes) || bits_of(type) != addr.bits)
			continue;
		if (class == CLASS_SIGNED)
			return type;
		if (found == IEC_NONE)
			found = type;
	}
	return found;
}

/* ---- addresses ---- */

/* The addresses of a place, or ones made for this call. */
struct uses {
	struct xref own;
	struct xref *xref;
};

static bool open_uses(const struct entry_place *place, struct uses *uses)
{
	memset(uses, 0, sizeof(*uses));
	uses->xref = place->xref;
	if (uses->xref)
		return true;
	uses->xref = &uses->own;
	return xref_addresses(&uses->own, place->project);
}

static void close_uses(struct uses *uses)
{
	if (uses->xref == &uses->own)
		xref_free(&uses->own);
}

void entry_each_address(const struct entry_place *place,
			void (*take)(void *context, struct iec_addr addr), void *context)
{
	struct uses uses;

	if (open_uses(place, &uses))
		for (int i = 0; i < uses.xref->count; i++)
			if (uses.xref->use[i].target.what == XREF_ADDRESS)
				take(context, uses.xref->use[i].target.addr);
	close_uses(&uses);
}

static bool is_used(const struct xref *xref, enum iec_area area)
{
	for (int i = 0; i < xref->count; i++)
		if (xref->use[i].target.addr.area == area)
			return true;
	return false;
}

static bool is_declared(const struct entry *entry, struct iec_addr addr)
{
	char text[40];

	iec_addr_print(addr, text, sizeof(text));
	for (int i = 0; i < entry->declares; i++)
		if (!strcmp(entry->declare[i].address, text))
			return true;
	return false;
}

static bool next_free(const struct address_map *map, enum iec_area area, int bits,
		      const struct entry *entry, struct iec_addr *out)
{
	bool found = address_map_next(map, area, bits, 1, NULL, out);

	while (found && is_declared(entry, *out)) {
		const struct iec_addr before = *out;

		found = address_map_next(map, area, bits, 1, &before, out);
	}
	return found;
}

/* Contacts go to the inputs; coils to the outputs, or to the markers if the project has
 * those and no outputs. */
static enum iec_area habit(const struct xref *xref, bool output)
{
	if (!output)
		return AREA_I;
	return is_used(xref, AREA_M) && !is_used(xref, AREA_Q) ? AREA_M : AREA_Q;
}

static void add_free(const struct address_map *map, enum iec_area area, int bits,
		     const struct entry *entry, struct entry_new *made)
{
	struct iec_addr addr;

	if (next_free(map, area, bits, entry, &addr))
		iec_addr_print(addr, made->choice[made->choices++], ENTRY_ADDRESS_TEXT);
}

static void add_all(const struct xref *xref, const struct address_map *map, int bits,
		    bool write, const struct entry *entry, struct entry_new *made)
{
	const enum iec_area first = habit(xref, write);

	if (bits > 1)
		made->choice[made->choices++][0] = '\0';
	add_free(map, first, bits, entry, made);
	add_free(map, first == AREA_M ? AREA_Q : AREA_M, bits, entry, made);
	if (bits == 1)
		made->choice[made->choices++][0] = '\0';
}

static void propose(const struct entry_place *place, struct entry *entry,
		     enum iec_type type, bool write)
{
	struct entry_new *made = &entry->declare[entry->declares - 1];
	const struct pou *pou = entry_pou(place);
	const int bits = bits_of(type);
	struct address_map map;
	struct arena arena;
	struct uses uses;

	made->choices = 0;
	if (!pou || pou_has_frame(pou) || bits == 0)
		return;
	arena_init(&arena);
	if (open_uses(place, &uses) && address_map_make(&map, uses.xref, &arena))
		add_all(uses.xref, &map, bits, write, entry, made);
	if (made->choices > 0)
		memcpy(made->address, made->choice[0], sizeof(made->address));
	close_uses(&uses);
	arena_free(&arena);
}

static const struct var *find_on(const struct var_table *table, struct iec_addr addr)
{
	for (int i = 0; i < table->count; i++)
		if (var_lies_on(&table->var[i], addr))
			return &table->var[i];
	return NULL;
}

static void find_sharer(const struct entry_place *place, struct iec_addr addr, char *out,
		  size_t size)
{
	const struct project *project = place->project;
	const struct var *var = find_on(&project->globals, addr);

	for (int i = 0; !var && i < project->pou_count; i++)
		var = find_on(&project->pou[i].vars, addr);
	snprintf(out, size, "%s", var ? project_text(project, var->name) : "");
}

/* ---- declarations ---- */

struct entry_said {
	enum iec_type type;  /* given, or that of the place; IEC_NONE: no value */
	char address[ENTRY_ADDRESS_TEXT]; /* canonical, "": none               */
};

bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address)
{
	struct entry_new *made;
	struct iec_addr addr;

	for (int i = 0; i < entry->declares; i++)
		if (name_is(entry->declare[i].name, name, len))
			return true;
	if (entry->declares == ENTRY_NEW_MOST)
		return entry_wrong(entry, N_("“%s” is not declared: one line declares "
				   "at most 4 names"), name, len);
	made = &entry->declare[entry->declares++];
	snprintf(made->name, sizeof(made->name), "%.*s", (int)len, name);
	snprintf(made->type, sizeof(made->type), "%s", type);
	snprintf(made->address, sizeof(made->address), "%s", address);
	if (iec_addr_parse(address, strlen(address), &addr) == ADDR_OK)
		find_sharer(place, addr, made->shares, sizeof(made->shares));
	return true;
}

struct piece {
	const char *text;
	size_t len;          /* 0: not given                                   */
};

struct pieces {
	struct piece name, address, type;
};

/* A colon before a digit belongs to an address (I:1/3), and := is another sign. */
static bool is_colon(const char *text, size_t len)
{
	return len > 0 && *text == ':' &&
	       (len == 1 || (!ascii_digit(text[1]) && text[1] != '='));
}

size_t entry_declared_len(const char *text, size_t len, enum entry_doubt doubt)
{
	struct lex lex;
	struct token name;
	size_t left;

	lex_init(&lex, text, len);
	if (lex_next(&lex) != TOKEN_NAME)
		return 0;
	name = lex.token;
	lex_next(&lex);
	left = (size_t)(text + len - lex.token.text);
	if (lex_is(&lex, "AT") || (lex_is(&lex, ":") && is_colon(lex.token.text, left)) ||
	    (doubt == ENTRY_WORD_GIVEN && left > 0 && *lex.token.text == '%'))
		return (size_t)(name.text - text) + name.len;
	return 0;
}

static void skip_blanks(struct piece *rest)
{
	while (rest->len > 0 && strchr(" \t\r\n", *rest->text)) {
		rest->text++;
		rest->len--;
	}
}

static struct piece cut(struct piece *rest, size_t len)
{
	const struct piece head = { rest->text, len };

	rest->text += len;
	rest->len -= len;
	skip_blanks(rest);
	return head;
}

static bool is_assign(const char *text, size_t len)
{
	return len > 1 && text[0] == ':' && text[1] == '=';
}

/* Length up to a character that no address contains. */
static size_t address_len(const struct piece *rest)
{
	size_t len = 0;

	while (len < rest->len && !strchr(" \t\r\n,;()<>=+-*&", rest->text[len]) &&
	       !is_colon(rest->text + len, rest->len - len) &&
	       !is_assign(rest->text + len, rest->len - len))
		len++;
	return len;
}

size_t entry_said_len(const char *text, size_t len)
{
	struct piece rest = { text, len }, part;
	struct lex lex;

	part = cut(&rest, entry_declared_len(text, len, ENTRY_WORD_POSSIBLE));
	if (part.len == 0)
		return 0;
	if (!is_colon(rest.text, rest.len)) {
		part = cut(&rest, strlen("AT"));
		if (address_len(&rest) > 0)
			part = cut(&rest, address_len(&rest));
	}
	if (is_colon(rest.text, rest.len)) {
		part = cut(&rest, strlen(":"));
		lex_init(&lex, rest.text, rest.len);
		if (lex_next(&lex) == TOKEN_NAME)
			part = cut(&rest, lex.token.len);
	}
	return (size_t)(part.text + part.len - text);
}

static bool take_address(struct piece *rest, struct pieces *out, struct entry *entry)
{
	size_t len;

	if (*rest->text != '%')
		cut(rest, strlen("AT"));
	len = address_len(rest);
	if (len == 0)
		return entry_wrong(entry, N_("“%s” needs an address behind AT"),
				   out->name.text, out->name.len);
	out->address = cut(rest, len);
	return true;
}

static bool take_type(struct piece *rest, struct pieces *out, struct entry *entry)
{
	cut(rest, strlen(":"));
	if (rest->len == 0)
		return entry_wrong(entry, N_("“%s” needs a type behind the colon"),
				   out->name.text, out->name.len);
	out->type = cut(rest, rest->len);
	return true;
}

static bool split(const char *text, size_t len, size_t name, struct pieces *out,
		  struct entry *entry)
{
	struct piece rest = { text, len };

	memset(out, 0, sizeof(*out));
	out->name = cut(&rest, name);
	if (!is_colon(rest.text, rest.len) && !take_address(&rest, out, entry))
		return false;
	if (is_colon(rest.text, rest.len) && !take_type(&rest, out, entry))
		return false;
	return rest.len == 0 ||
	       entry_wrong(entry, N_("“%s” is not expected: only an address and a type "
				"can follow a name"),
			   rest.text, rest.len);
}

/* ---- reading the parts ---- */

static bool read_address(const struct entry_place *place, const struct piece *piece,
			 struct iec_addr *out, struct entry *entry)
{
	const char *why = NULL;

	*out = (struct iec_addr){ .area = AREA_NONE };
	if (piece->len == 0)
		return true;
	if (!entry_address_parse(piece->text, piece->len, out, &why))
		why = entry_no_address;
	else if (!why && !project_has(place->project, *out))
		why = N_("“%s” is not an address of this project");
	return !why || entry_wrong(entry, why, piece->text, piece->len);
}

struct type {
	enum iec_type type;  /* IEC_NONE: an instance, a structure, an array   */
	enum word word;
	struct piece more;    /* the text behind the type                       */
};

static bool read_type(const struct entry_place *place, const struct piece *piece,
		      struct type *out, struct entry *entry)
{
	struct word_table *words = &place->project->words;
	struct lex lex;
	struct piece rest = *piece;

	memset(out, 0, sizeof(*out));
	if (piece->len == 0)
		return true;
	lex_init(&lex, piece->text, piece->len);
	lex_next(&lex);
	out->type = iec_type_find(lex.token.text, lex.token.len);
	out->word = words_find(words, lex.token.text, lex.token.len);
	if (out->type == IEC_NONE && !lex_is(&lex, "ARRAY") &&
	    (out->word == WORD_COUNT || (words_row(words, out->word)->kind != WORD_FB &&
					 words_row(words, out->word)->kind != WORD_STRUCT)))
		return entry_wrong(entry, N_("“%s” is not a type"), piece->text,
				   piece->len);
	cut(&rest, lex.token.len);
	out->more = rest;
	return true;
}

/* ---- a declared name ---- */

static bool is_same(const struct var *var, const struct pieces *pieces,
		    struct iec_addr addr, const struct type *type)
{
	if (pieces->address.len > 0 &&
	    (var->at.area != addr.area || var->at.bits != addr.bits ||
	     var->at.byte != addr.byte || var->at.bit != addr.bit))
		return false;
	if (pieces->type.len == 0)
		return true;
	return var->array.count == 0 && type->more.len == 0 && var->type == type->type &&
	       (var->type != IEC_NONE || var->fb == type->word);
}

static bool is_other(const struct entry_place *place, const struct var *var,
		     struct entry *entry)
{
	const struct project *project = place->project;
	char text[ENTRY_NAME];

	snprintf(text, sizeof(text), "%.200s%s%.31s : %s%.60s",
		 project_text(project, var->name), var->at_text ? " AT " : "",
		 project_text(project, var->at_text), var->array.count ? "ARRAY OF " : "",
		 var->type != IEC_NONE ? iec_type_row(var->type)->word :
		 words_row(&project->words, var->fb)->word);
	entry->known = var;
	entry_wrong(entry, N_("the name is declared already as %s"), text, strlen(text));
	entry->wrong_len = (size_t)snprintf(entry->wrong, sizeof(entry->wrong), "%.319s",
					    project_text(project, var->name));
	return false;
}

/* ---- a new name ---- */

/* Does the type fit the place? */
static bool fits_type(const struct entry_fit *fit, const struct pieces *pieces,
		      const struct type *type, struct entry *entry)
{
	const bool value = type->type != IEC_NONE;

	if (value ? !(type->type == fit->type ||
		      iec_type_row(type->type)->class & fit->classes) :
		    fit->type != IEC_NONE || type->word != fit->word)
		return entry_wrong(entry, fit->type == IEC_BOOL ?
				   N_("the type “%s” does not fit: this is a BOOL") :
				   N_("the type “%s” does not fit here"), pieces->type.text,
				   pieces->type.len);
	return type->more.len == 0 ||
	       entry_wrong(entry, N_("“%s” is not expected: only an address and a type "
				"can follow a name"),
			   type->more.text, type->more.len);
}

/* An error of the width includes the right form, such as %IW. */
static bool has_width(enum iec_type type, const struct piece *address,
		      struct iec_addr addr, struct entry *entry)
{
	static const char letters[] = "XBWDL";
	const int bits = bits_of(type);
	char text[ENTRY_NAME];
	int letter = 0;

	if (addr.bits == bits)
		return true;
	if (type == IEC_BOOL)
		return entry_wrong(entry, N_("“%s” is not the address of a BOOL"),
				   address->text, address->len);
	if (bits == 0)
		return entry_wrong(entry, N_("“%s” cannot be used: variables of this type have no address"),
				   address->text, address->len);
	for (int wide = 4; wide < bits; wide *= 2)
		letter++;
	snprintf(text, sizeof(text), "%.*s, %s: %%%s%c", (int)(address->len < 40 ?
		 address->len : 40), address->text, iec_type_row(type)->word,
		 iec_area_row(addr.area)->letters, letters[letter]);
	return entry_wrong(entry, N_("the address is not as wide as its type: %s"), text,
			   strlen(text));
}

static bool is_good(const struct entry_place *place, const struct pieces *pieces,
		    struct iec_addr addr, const struct type *type,
		    const struct entry_fit *fit, struct entry_said *out,
		    struct entry *entry)
{
	const struct piece *name = &pieces->name, *address = &pieces->address;
	struct entry_target target;

	entry_target_find(place, name->text, name->len, &target);
	if (target.means != MEANS_NEW)
		return entry_wrong(entry, N_("“%s” cannot be the name of a variable"), name->text,
				   name->len);
	if (pieces->type.len > 0 && !fits_type(fit, pieces, type, entry))
		return false;
	if (pieces->type.len > 0)
		out->type = type->type;
	if (address->len == 0)
		return true;
	if (pieces->type.len == 0 && type_at(fit, addr) != IEC_NONE)
		out->type = type_at(fit, addr);
	if (!has_width(out->type, address, addr, entry))
		return false;
	return !fit->write || iec_area_row(addr.area)->access != ACCESS_READ ||
	       entry_wrong(entry, N_("“%s” cannot be written"), address->text,
			   address->len);
}

static bool read_declaration(const struct entry_place *place, const char *text, size_t len,
		       size_t name, const struct entry_fit *fit, struct entry_said *out,
		       struct entry *entry)
{
	struct pieces pieces;
	struct iec_addr addr;
	struct type type;
	const struct var *var;

	*out = (struct entry_said){ .type = fit->type };
	if (!split(text, len, name, &pieces, entry) ||
	    !read_address(place, &pieces.address, &addr, entry) ||
	    !read_type(place, &pieces.type, &type, entry))
		return false;
	if (addr.area != AREA_NONE)
		iec_addr_print(addr, out->address, sizeof(out->address));
	var = entry_var_find(place, pieces.name.text, pieces.name.len, NULL);
	if (var)
		return is_same(var, &pieces, addr, &type) || is_other(place, var, entry);
	return is_good(place, &pieces, addr, &type, fit, out, entry);
}

/* ---- one operand ---- */

static const char *type_word(const struct entry_place *place, enum iec_type type,
			     const struct entry_fit *fit)
{
	return type != IEC_NONE ? iec_type_row(type)->word :
				  words_row(&place->project->words, fit->word)->word;
}

static bool declare(const struct entry_place *place, const char *text, size_t len,
		    const struct entry_fit *fit, const struct entry_said *said,
		    struct entry *entry)
{
	const enum iec_type type = said ? said->type : fit->type;
	const int before = entry->declares;

	if (type == IEC_NONE && fit->word == WORD_COUNT)
		return entry_wrong(entry, N_("“%s” is not declared"), text, len);
	if (!entry_declare(place, entry, text, len, type_word(place, type, fit),
			   said ? said->address : ""))
		return false;
	if (!said && entry->declares > before)
		propose(place, entry, type, fit->write);
	return true;
}

/* ---- names of other tools ---- */

const struct word_pin *entry_pin(const struct entry_target *target)
{
	const struct dialect *foreign = &target->foreign;
	const struct word_row *row = word_row(word_find(foreign->word, strlen(foreign->word)));

	return &row->pin[word_pin_find(row, foreign->pin, strlen(foreign->pin))];
}

/* T37, %TM0.Q: the instance is declared, the operand is a pin of it. */
static bool take_pin(const struct entry_place *place, struct entry_target *out,
		     struct entry *entry)
{
	const struct word_pin *pin = entry_pin(out);
	const struct dialect *foreign = &out->foreign;

	out->means = MEANS_VALUE;
	out->type = pin->type;
	out->write = pin->dir == PIN_IN;
	snprintf(out->text, sizeof(out->text), "%s.%s", foreign->name, pin->name);
	return entry_declare(place, entry, foreign->name, strlen(foreign->name), foreign->word,
			     "");
}

/* D0: a number of 32 bits lies in D0 and D1. */
static bool take_number(const struct entry_place *place, const struct entry_fit *fit,
			const struct entry_target *target, struct entry *entry)
{
	const struct dialect *foreign = &target->foreign;
	struct entry_said said = { .type = fit->type };
	struct iec_addr addr = foreign->addr;

	addr.bits = (uint8_t)bits_of(fit->type);
	if (!project_has(place->project, addr))
		return entry_wrong(entry, N_("“%s” is not an address of this project"),
				   foreign->name, strlen(foreign->name));
	iec_addr_print(addr, said.address, sizeof(said.address));
	return declare(place, foreign->name, strlen(foreign->name), fit, &said, entry);
}

/* Does it mean here what it means there? A name that cannot be meant so is an ordinary one. */
static bool is_foreign(const struct entry_place *place, const struct entry_fit *fit,
		       const struct entry_target *target)
{
	const struct pou *pou = entry_pou(place);

	if (!target->foreign.name[0] || fit->type == IEC_NONE)
		return false;
	if (target->foreign.kind == DIALECT_BLOCK)
		return fit->type == IEC_BOOL && !fit->write;
	return bits_of(fit->type) > 1 && pou && !pou_has_frame(pou) &&
	       iec_type_row(fit->type)->class & (ANY_NUM | CLASS_BITS);
}

bool entry_operand(const struct entry_place *place, const char *text, size_t len,
		   const struct entry_fit *fit, struct entry_target *out,
		   struct entry *entry)
{
	const size_t name = entry_declared_len(text, len, ENTRY_WORD_GIVEN);
	struct entry_said said;

	if (name > 0) {
		if (!read_declaration(place, text, len, name, fit, &said, entry))
			return false;
		len = name;
	}
	entry_target_find(place, text, len, out);
	if (out->means == MEANS_WRONG || out->means == MEANS_NOTHING) {
		snprintf(entry->instead, sizeof(entry->instead), "%s", out->instead);
		return entry_wrong(entry, out->why ? out->why : N_("“%s” is not an operand"),
				   text, len);
	}
	if (out->means == MEANS_NEW_PIN || (out->means == MEANS_NEW && name == 0 &&
					    is_foreign(place, fit, out)))
		return out->foreign.kind == DIALECT_WORD ? take_number(place, fit, out, entry) :
							   take_pin(place, out, entry);
	return out->means != MEANS_NEW ||
	       declare(place, text, len, fit, name ? &said : NULL, entry);
}
