/* SPDX-License-Identifier: MIT
 *
 * entry_inside - what the files of quick entry share: names, addresses, words.
 *
 * Only editor-gtk/entry*.c include it. It reads a project and changes nothing in it but
 * strings and rows of words made by rule.
 */
#ifndef EDITOR_ENTRY_INSIDE_H
#define EDITOR_ENTRY_INSIDE_H

#include "editor-gtk/edit/entry.h"

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

/* What a place of a line takes, and what a new name there becomes. */
struct entry_fit {
	enum iec_type type;      /* if the line does not say it; IEC_NONE: see word */
	enum word word;          /* an instance or structure of it; WORD_COUNT: no
				    new name can stand here                    */
	uint16_t classes;        /* that its type may be of, enum iec_class    */
	bool write;
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

/* entry_operand.c */
/** entry_operand - a name, a path, an address; or a new name, which is declared with what
 * the line says of it, else with what is proposed. Fails: false, the entry says why. */
bool entry_operand(const struct entry_place *place, const char *text, size_t len,
		   const struct entry_fit *fit, struct entry_target *out,
		   struct entry *entry);
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
/** entry_fit_address - the type of a new name at an address; IEC_NONE: none fits. */
enum iec_type entry_fit_address(const struct entry_fit *fit, struct iec_addr addr);
/** entry_type_bits - how wide an address of the type is; 0: it can have none. */
int entry_type_bits(enum iec_type type);

/* entry_areas.c */
/** entry_proposals - the choice of what is declared last: free addresses as wide as
 * @type, and none; the first is what it gets: a BOOL a bit, all others none. No choice
 * for what is called: that has its own memory. */
void entry_proposals(const struct entry_place *place, struct entry *entry,
		     enum iec_type type, bool write);
/** entry_shares - name of a variable that lies there too, "": none. */
void entry_shares(const struct entry_place *place, struct iec_addr addr, char *out,
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
/** entry_wrong - returns false. */
bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len);
/** entry_append - to a text of @size; false if it does not fit. */
bool entry_append(char *out, size_t size, const char *text, size_t len);

/* entry_declaration.c */
/** entry_declare - a variable more. Fails: false and WRONG if there are too many. */
bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address);
/** entry_said_len - bytes of the declaration that a text begins with, its name, address
 * and type; 0: it is none. */
size_t entry_said_len(const char *text, size_t len);
struct entry_said {
	enum iec_type type;  /* said, or that of the place; IEC_NONE: no value */
	char address[ENTRY_ADDRESS_TEXT]; /* canonical, "": none               */
};
/** entry_declaration - what is said behind the @name bytes of a name. Fails: false, the
 * entry says why: it does not fit the place, or is another than the name has. */
bool entry_declaration(const struct entry_place *place, const char *text, size_t len,
		       size_t name, const struct entry_fit *fit, struct entry_said *out,
		       struct entry *entry);

/* entry_expression.c */
/** entry_expression - a comparison or an assignment. */
bool entry_expression(const struct entry_place *place, const char *text, size_t len,
		      struct entry *entry);

/* entry_infer.c */
struct expr;
/* Of each node of an expression. */
struct entry_types {
	uint8_t given[LIMIT_EXPR_NODES];  /* by what is declared, typed constants */
	uint8_t guessed[LIMIT_EXPR_NODES]; /* else by constants and operators  */
	uint8_t wanted[LIMIT_EXPR_NODES]; /* what a new name there becomes     */
	uint8_t target;                   /* of what is written                */
};
/**
 * entry_infer - which types new names get in an expression
 * @said: the type that the line says of a name, IEC_NONE: it says none
 *
 * As what they are compared and calculated with; where all is new, INT, or REAL beside
 * a constant with a point. It judges nothing: types are checked by the engine.
 */
void entry_infer(const struct entry_place *place, const struct expr *expr,
		 enum iec_type (*said)(void *context, const char *name, size_t len),
		 void *context, struct entry_types *out);
#endif
