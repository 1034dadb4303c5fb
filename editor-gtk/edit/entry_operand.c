/* SPDX-License-Identifier: MIT
 *
 * entry_operand - one operand of a line, wherever it stands, and what a new name becomes
 * there: its type, and how wide an address it can have.
 *
 * A contact, a pin, a name in an expression differ by their struct entry_fit only.
 */
#include "editor-gtk/edit/entry_inside.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

/* ---- what fits ---- */

/* Values that go with one: numbers with numbers. */
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

/* The usual type of some classes. */
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

int entry_type_bits(enum iec_type type)
{
	if (type == IEC_BOOL)
		return 1;
	return iec_type_row(type)->class & ANY_SIMPLE ? iec_type_row(type)->size * 8 : 0;
}

/* The first one of the catalogue that is signed, else the first one at all. */
enum iec_type entry_fit_address(const struct entry_fit *fit, struct iec_addr addr)
{
	enum iec_type found = IEC_NONE;

	if (entry_type_bits(fit->type) == addr.bits)
		return fit->type;
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++) {
		const enum iec_type type = (enum iec_type)i;
		const uint16_t class = iec_type_row(type)->class;

		if (!(class & fit->classes) || entry_type_bits(type) != addr.bits)
			continue;
		if (class == CLASS_SIGNED)
			return type;
		if (found == IEC_NONE)
			found = type;
	}
	return found;
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
		return entry_wrong(entry, N_("there is no such variable"), text, len);
	if (!entry_declare(place, entry, text, len, type_word(place, type, fit),
			   said ? said->address : ""))
		return false;
	if (!said && entry->declares > before)
		entry_proposals(place, entry, type, fit->write);
	return true;
}

bool entry_operand(const struct entry_place *place, const char *text, size_t len,
		   const struct entry_fit *fit, struct entry_target *out,
		   struct entry *entry)
{
	const size_t name = entry_declared_len(text, len, ENTRY_WORD_GIVEN);
	struct entry_said said;

	if (name > 0) {
		if (!entry_declaration(place, text, len, name, fit, &said, entry))
			return false;
		len = name;
	}
	entry_target_find(place, text, len, out);
	if (out->means == MEANS_WRONG || out->means == MEANS_NOTHING)
		return entry_wrong(entry, out->why ? out->why : N_("this is no operand"),
				   text, len);
	return out->means != MEANS_NEW ||
	       declare(place, text, len, fit, name ? &said : NULL, entry);
}
