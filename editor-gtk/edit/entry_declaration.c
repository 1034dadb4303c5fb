/* SPDX-License-Identifier: MIT
 *
 * entry_declaration - what a line says itself of its name: `Open AT %IX0.5 : BOOL`.
 *
 * Of a new name it is what is declared, of another it must be true. It judges what a
 * person wrote; what nobody wrote is proposed by entry_areas.c.
 */
#include "editor-gtk/edit/entry_inside.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdio.h>
#include <string.h>

bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address)
{
	struct entry_new *made;
	struct iec_addr addr;

	for (int i = 0; i < entry->declares; i++)
		if (ascii_is(entry->declare[i].name, name, len))
			return true;
	if (entry->declares == ENTRY_NEW_MOST)
		return entry_wrong(entry, N_("too many new names in one line"), name, len);
	made = &entry->declare[entry->declares++];
	snprintf(made->name, sizeof(made->name), "%.*s", (int)len, name);
	snprintf(made->type, sizeof(made->type), "%s", type);
	snprintf(made->address, sizeof(made->address), "%s", address);
	if (iec_addr_parse(address, strlen(address), &addr) == ADDR_OK)
		entry_shares(place, addr, made->shares, sizeof(made->shares));
	return true;
}

/* ---- its parts ---- */

struct piece {
	const char *text;
	size_t len;          /* 0: the line does not say it                    */
};

struct pieces {
	struct piece name, address, type;
};

/* A colon with a digit behind it belongs to an address: I:1/3; := is another sign. */
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

/* Up to what cannot be a part of one: in an expression signs go on. */
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
		return entry_wrong(entry, N_("an address is missing behind AT"),
				   out->name.text, out->name.len);
	out->address = cut(rest, len);
	return true;
}

static bool take_type(struct piece *rest, struct pieces *out, struct entry *entry)
{
	cut(rest, strlen(":"));
	if (rest->len == 0)
		return entry_wrong(entry, N_("a type is missing behind the colon"),
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
	       entry_wrong(entry, N_("only an address and a type stand behind a name"),
			   rest.text, rest.len);
}

/* ---- what they say ---- */

static bool read_address(const struct entry_place *place, const struct piece *piece,
			 struct iec_addr *out, struct entry *entry)
{
	const char *why = NULL;

	*out = (struct iec_addr){ .area = AREA_NONE };
	if (piece->len == 0)
		return true;
	if (!entry_address_parse(piece->text, piece->len, out, &why))
		why = N_("this is no address");
	else if (!why && !project_has(place->project, *out))
		why = N_("there is no such address");
	return !why || entry_wrong(entry, why, piece->text, piece->len);
}

struct type {
	enum iec_type type;  /* IEC_NONE: an instance, a structure, an array   */
	enum word word;
	struct piece more;    /* behind its word, of what has none              */
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
		return entry_wrong(entry, N_("there is no such type"), piece->text,
				   piece->len);
	cut(&rest, lex.token.len);
	out->more = rest;
	return true;
}

/* ---- of a name that is there ---- */

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
	return entry_wrong(entry, N_("it is declared as"), text, strlen(text));
}

/* ---- of a new name ---- */

/* Is it what the place takes, IEC_BOOL where only that will do? */
static bool fits_type(const struct entry_fit *fit, const struct pieces *pieces,
		      const struct type *type, struct entry *entry)
{
	const bool value = type->type != IEC_NONE;

	if (value ? !(type->type == fit->type ||
		      iec_type_row(type->type)->class & fit->classes) :
		    fit->type != IEC_NONE || type->word != fit->word)
		return entry_wrong(entry, fit->type == IEC_BOOL ? N_("this is no BOOL") :
				   N_("this type does not fit here"), pieces->type.text,
				   pieces->type.len);
	return type->more.len == 0 ||
	       entry_wrong(entry, N_("only an address and a type stand behind a name"),
			   type->more.text, type->more.len);
}

/* What is told of an address that is too wide or too narrow: how it should begin. */
static bool has_width(enum iec_type type, const struct piece *address,
		      struct iec_addr addr, struct entry *entry)
{
	static const char letters[] = "XBWDL";
	const int bits = entry_type_bits(type);
	char text[ENTRY_NAME];
	int letter = 0;

	if (addr.bits == bits)
		return true;
	if (type == IEC_BOOL)
		return entry_wrong(entry, N_("this is no address of a BOOL"),
				   address->text, address->len);
	if (bits == 0)
		return entry_wrong(entry, N_("what is of such a type has no address"),
				   address->text, address->len);
	for (int wide = 4; wide < bits; wide *= 2)
		letter++;
	snprintf(text, sizeof(text), "%.*s, %s: %%%s%c", (int)(address->len < 40 ?
		 address->len : 40), address->text, iec_type_row(type)->word,
		 iec_area_row(addr.area)->letters, letters[letter]);
	return entry_wrong(entry, N_("this address is not as wide as its type"), text,
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
		return entry_wrong(entry, N_("no variable can be called so"), name->text,
				   name->len);
	if (pieces->type.len > 0 && !fits_type(fit, pieces, type, entry))
		return false;
	if (pieces->type.len > 0)
		out->type = type->type;
	if (address->len == 0)
		return true;
	if (pieces->type.len == 0 && entry_fit_address(fit, addr) != IEC_NONE)
		out->type = entry_fit_address(fit, addr);
	if (!has_width(out->type, address, addr, entry))
		return false;
	return !fit->write || iec_area_row(addr.area)->access != ACCESS_READ ||
	       entry_wrong(entry, N_("this cannot be written"), address->text,
			   address->len);
}

bool entry_declaration(const struct entry_place *place, const char *text, size_t len,
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
