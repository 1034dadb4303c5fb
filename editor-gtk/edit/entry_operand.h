/* SPDX-License-Identifier: MIT
 *
 * entry_operand - one operand of a line, and the type and address of a new name in its
 * place.
 *
 * A contact, a pin and a name in an expression differ only by their struct entry_fit.
 */
#ifndef EDITOR_ENTRY_OPERAND_H
#define EDITOR_ENTRY_OPERAND_H

#include "editor-gtk/edit/entry_names.h"

/* The types that fit a place of a line, and the type of a new name there. */
struct entry_fit {
	enum iec_type type;      /* default type; IEC_NONE: see word */
	enum word word;          /* an instance or structure of it; WORD_COUNT: no new name is
				    possible */
	uint16_t classes;        /* enum iec_class of types that fit           */
	bool write;
};

/** entry_fit_bool - what fits a contact or (@write) a coil. */
struct entry_fit entry_fit_bool(bool write);
/** entry_fit_type - what fits beside a value of a type. */
struct entry_fit entry_fit_type(enum iec_type type, bool write);
/** entry_fit_pin - what fits a pin. @shared: type of the other values of a function,
 * IEC_NONE: unknown. */
struct entry_fit entry_fit_pin(const struct word_row *row, const struct word_pin *pin,
			       enum iec_type shared, bool write);
/** entry_fit_result - what fits the result of a function. */
struct entry_fit entry_fit_result(const struct word_row *row, enum iec_type shared);
/** entry_operand - reads a name, a path or an address. A new name is declared as the line
 * says, else as proposed. Fails: false, the entry has the reason. */
bool entry_operand(const struct entry_place *place, const char *text, size_t len,
		   const struct entry_fit *fit, struct entry_target *out,
		   struct entry *entry);
/** entry_pin - the pin of a MEANS_NEW_PIN. Lives for ever. */
const struct word_pin *entry_pin(const struct entry_target *target);
/** entry_each_address - calls @take for each address that the project uses without a name. */
void entry_each_address(const struct entry_place *place,
			void (*take)(void *context, struct iec_addr addr),
			void *context);

/** entry_declare - adds a variable to @entry. Fails: false and WRONG if there are too many. */
bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address);
/** entry_said_len - bytes of the declaration at the start of a text: name, address, type;
 * 0: none. */
size_t entry_said_len(const char *text, size_t len);
/** entry_wrong - makes @entry ENTRY_WRONG, with this reason. Returns false. */
bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len);
/** entry_literal - appends a literal as a file has it: 5s becomes T#5s. False: no literal.
 * @fits: there was room. */
bool entry_literal(const char *text, size_t len, char *out, size_t size, bool *fits);
/** entry_append - appends to the text in @out; false if it does not fit. */
bool entry_append(char *out, size_t size, const char *text, size_t len);

#endif
