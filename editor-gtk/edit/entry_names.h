/* SPDX-License-Identifier: MIT
 *
 * entry_names - the meaning of a name, a path, an address in any spelling or a mnemonic,
 * and names for new variables.
 *
 * It looks variables up as they are declared; types of expressions are the engine's. In a
 * project it changes only strings and rows of generated words.
 */
#ifndef EDITOR_ENTRY_NAMES_H
#define EDITOR_ENTRY_NAMES_H

#include "editor-gtk/edit/entry.h"

#include "engine/model/dialect.h"

/* The meaning of a name, path or address. */
enum entry_means {
	MEANS_NOTHING,  /* no operand                                          */
	MEANS_VALUE,    /* an existing value                                   */
	MEANS_INSTANCE, /* an instance or structure as a whole                 */
	MEANS_NEW,      /* an unknown plain name                               */
	MEANS_NEW_PIN,  /* a pin of `foreign`, which is not declared           */
	MEANS_WRONG,    /* see why                                             */
};

struct entry_target {
	enum entry_means means;
	enum iec_type type;      /* of a value                                 */
	enum word word;          /* of an instance or structure                */
	bool write;              /* may a program write it?                    */
	bool array;              /* a whole array                              */
	const struct var *var;   /* base of the path; NULL: none               */
	struct iec_addr addr;    /* of an address, AREA_NONE: none             */
	struct dialect foreign;  /* of a new name that has a meaning in another tool; name "":
				    it has none                                */
	const char *why;         /* N_() text                                  */
	char instead[40];        /* of a second %s in @why                     */
	char text[ENTRY_TEXT];   /* canonical                                  */
};

static inline struct pou *entry_pou(const struct entry_place *place)
{
	return place->pou >= 0 && place->pou < place->project->pou_count ?
		&place->project->pou[place->pou] : NULL;
}

void entry_target_find(const struct entry_place *place, const char *text, size_t len,
		       struct entry_target *out);
/** entry_var_find - declared in the POU or globally, in any case; NULL: none. @flags gets
 * enum var_flag of its block, may be NULL. */
const struct var *entry_var_find(const struct entry_place *place, const char *text,
				 size_t len, uint16_t *flags);
/** entry_address_parse - in any spelling. False: no address. An invalid address returns
 * true and sets @why, N_() text. */
bool entry_address_parse(const char *text, size_t len, struct iec_addr *out,
			 const char **why);
/** entry_no_address - the @why of a text that has not the form of an address, N_(). */
extern const char entry_no_address[];
/** entry_is_name - may a variable have this name? */
bool entry_is_name(const char *text, size_t len);
/** entry_name_taken - by a variable, a POU, a label, or in the line itself. */
bool entry_name_taken(const struct entry_place *place, const struct entry *entry,
		      const char *name);
/** entry_fresh_name - base and the smallest number that makes an unused name. */
void entry_fresh_name(const struct entry_place *place, const struct entry *entry,
		      const char *base, char *out, size_t size);
/** entry_family_base - the stem of names for instances of a word: "Delay". */
const char *entry_family_base(const struct word_row *row);

struct entry_mnemonic {
	const char *text;
	enum word word;
	bool below;
};
/** entry_mnemonic - number @index of all dialects; NULL: past the last. */
const struct entry_mnemonic *entry_mnemonic(int index);
/** entry_word_find - a mnemonic or a word of the catalogue or project; WORD_COUNT: none.
 * @below gets whether it goes in parallel. */
enum word entry_word_find(const struct entry_place *place, const char *text, size_t len,
			  bool *below);
/** entry_glyph - a drawn element, -|/|- or -(S)-, at the begin of @line. Returns its
 * bytes; 0: none. */
size_t entry_glyph(const char *line, enum word *word);

#endif
