/* SPDX-License-Identifier: MIT
 *
 * entry_operand - one operand of a line, wherever it stands, and what a new name becomes
 * there: its type, its address.
 *
 * A contact, a pin and a name in an expression differ only by their struct entry_fit.
 */
#ifndef EDITOR_ENTRY_OPERAND_H
#define EDITOR_ENTRY_OPERAND_H

#include "editor-gtk/edit/entry_names.h"

/* What a place of a line takes, and what a new name there becomes. */
struct entry_fit {
	enum iec_type type;      /* if the line does not say it; IEC_NONE: see word */
	enum word word;          /* an instance or structure of it; WORD_COUNT: no
				    new name can stand here                    */
	uint16_t classes;        /* that its type may be of, enum iec_class    */
	bool write;
};

/** entry_fit_bool - of a contact or a coil. */
struct entry_fit entry_fit_bool(bool write);
/** entry_fit_type - of a value that goes with those of a type. */
struct entry_fit entry_fit_type(enum iec_type type, bool write);
/** entry_fit_pin - of a pin. @shared: type of the other values of a function, IEC_NONE:
 * nobody knows. */
struct entry_fit entry_fit_pin(const struct word_row *row, const struct word_pin *pin,
			       enum iec_type shared, bool write);
/** entry_fit_result - of what a function gives. */
struct entry_fit entry_fit_result(const struct word_row *row, enum iec_type shared);
/** entry_operand - a name, a path, an address; or a new name, which is declared with what
 * the line says of it, else with what is proposed. Fails: false, the entry says why. */
bool entry_operand(const struct entry_place *place, const char *text, size_t len,
		   const struct entry_fit *fit, struct entry_target *out,
		   struct entry *entry);
/** entry_each_address - hands over every address that is used by itself. */
void entry_each_address(const struct entry_place *place,
			void (*take)(void *context, struct iec_addr addr),
			void *context);

/** entry_declare - a variable more. Fails: false and WRONG if there are too many. */
bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address);
/** entry_said_len - bytes of the declaration that a text begins with, its name, address
 * and type; 0: it is none. */
size_t entry_said_len(const char *text, size_t len);
/** entry_wrong - returns false. */
bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len);
/** entry_append - to a text of @size; false if it does not fit. */
bool entry_append(char *out, size_t size, const char *text, size_t len);

#endif
