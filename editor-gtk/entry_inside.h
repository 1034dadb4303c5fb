/* SPDX-License-Identifier: MIT
 *
 * entry_inside - what the files of quick entry share: names, addresses, words.
 *
 * Only editor-gtk/entry*.c include it. It reads a project and changes nothing in it but
 * strings and rows of words made by rule.
 */
#ifndef EDITOR_ENTRY_INSIDE_H
#define EDITOR_ENTRY_INSIDE_H

#include "editor-gtk/entry.h"

/* What a name, path or address stands for. */
enum entry_means {
	MEANS_NOTHING,  /* no operand at all                                   */
	MEANS_VALUE,    /* a value that is there                               */
	MEANS_INSTANCE, /* an instance or structure as a whole                 */
	MEANS_NEW,      /* a plain name that nothing has yet                   */
	MEANS_WRONG,    /* see why                                             */
};

struct entry_target {
	enum entry_means means;
	enum iec_type type;      /* of a value                                 */
	enum word word;          /* of an instance                             */
	bool write;              /* may a program write it?                    */
	bool array;              /* a whole array                              */
	const struct var *var;   /* base of the path; NULL: none               */
	struct iec_addr addr;    /* of an address, AREA_NONE: none             */
	const char *why;         /* N_() text                                  */
	char text[ENTRY_TEXT];   /* canonical                                  */
};

static inline struct pou *entry_pou(const struct entry_place *place)
{
	return place->pou >= 0 && place->pou < place->project->pou_count ?
		&place->project->pou[place->pou] : NULL;
}

/* Of how a line is written (entry_names.c). */
void entry_target_find(const struct entry_place *place, const char *text, size_t len,
		       struct entry_target *out);
/** entry_var_find - declared in the POU or globally, any case; NULL: none. @flags gets
 * enum var_flag of its block, may be NULL. */
const struct var *entry_var_find(const struct entry_place *place, const char *text,
				 size_t len, uint16_t *flags);
/** entry_address_parse - in any spelling. False: it is none; a wrong one is one and gets
 * @why, N_() text. */
bool entry_address_parse(const char *text, size_t len, struct iec_addr *out,
			 const char **why);
/** entry_is_name - could a variable be called so? */
bool entry_is_name(const char *text, size_t len);
/** entry_name_taken - by a variable, a POU, a label, or in the line itself. */
bool entry_name_taken(const struct entry_place *place, const struct entry *entry,
		      const char *name);
/** entry_fresh_name - base and the smallest number that makes a new name of it. */
void entry_fresh_name(const struct entry_place *place, const struct entry *entry,
		      const char *base, char *out, size_t size);
/** entry_family_base - what instances of a word are called: "Delay". */
const char *entry_family_base(const struct word_row *row);

/* entry_areas.c */
/** entry_proposals - the choice of @entry: free bits for a new Boolean, the one it gets
 * first, and at the end none. No choice for what is called: that has its own memory. */
void entry_proposals(const struct entry_place *place, struct entry *entry, bool output);
/** entry_shares - name of a variable that has the bit too, "": none. */
void entry_shares(const struct entry_place *place, struct iec_addr bit, char *out,
		  size_t size);
/** entry_each_address - hands over every address that is used by itself. */
void entry_each_address(const struct entry_place *place,
			void (*take)(void *context, struct iec_addr addr),
			void *context);

/* entry_words.c */
struct entry_mnemonic {
	const char *text;
	enum word word;
	bool below;
	const char *dialect;
};
/** entry_mnemonic - number @index of all dialects; NULL: past the last. */
const struct entry_mnemonic *entry_mnemonic(int index);
/** entry_word_find - a mnemonic or a word of the catalogue or project; WORD_COUNT:
 * none. @below gets whether it goes in parallel. */
enum word entry_word_find(const struct entry_place *place, const char *text, size_t len,
			  bool *below);
/** entry_glyph - a drawn element, -|/|- or -(S)-, at the begin of @line. Returns its
 * bytes; 0: none. */
size_t entry_glyph(const char *line, enum word *word);

/* entry_args.c */
/** entry_args - parameters, by name or in their order, to @entry->args; instances
 * without any get values to begin with. Fails: false, the entry says why. */
bool entry_args(const struct entry_place *place, const struct word_row *row,
		const char *text, struct entry *entry);
/** entry_declare - a variable more. Fails: false and WRONG if there are too many. */
bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address);
/** entry_wrong - returns false. */
bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len);
/** entry_append - to a text of @size; false if it does not fit. */
bool entry_append(char *out, size_t size, const char *text, size_t len);

/* entry_declaration.c */
/* What a name with `%` behind it could be, too: a word with its operand. */
enum entry_doubt { ENTRY_WORD_POSSIBLE, ENTRY_WORD_GIVEN };
/** entry_declared_len - bytes of the name that a declaration begins with, `Open AT` or
 * `Open :`, or `Open %` if no word is in doubt; 0: it is no declaration. */
size_t entry_declared_len(const char *text, size_t len, enum entry_doubt doubt);
/** entry_declaration - what is said behind the @name bytes of a name. @address gets it,
 * canonical, "": none. Fails: false, the entry says why: it is no BOOL, or another than
 * the name has. */
bool entry_declaration(const struct entry_place *place, const char *text, size_t len,
		       size_t name, bool write, char *address, size_t size,
		       struct entry *entry);

/* entry_expression.c */
/** entry_expression - a comparison or an assignment. */
bool entry_expression(const struct entry_place *place, const char *text, size_t len,
		      struct entry *entry);
#endif
