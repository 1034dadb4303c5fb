/* SPDX-License-Identifier: MIT
 *
 * classic_convert - what the parts of the conversion share. Private to classic_*.c.
 */
#ifndef CLASSIC_CONVERT_H
#define CLASSIC_CONVERT_H

#include "engine/base/names.h"
#include "engine/exchange/classic/classic_rung.h"

#include <stdarg.h>

enum classic_kind {
	CLASSIC_TIMER, CLASSIC_MONOSTABLE, CLASSIC_IEC_TIMER, CLASSIC_COUNTER,
	CLASSIC_REGISTER, CLASSIC_KINDS
};

/* Functions of ClassicLadder's arithmetic that a project needs: classic_functions.c. */
enum classic_function {
	CLASSIC_SUM, CLASSIC_DIFFERENCE, CLASSIC_PRODUCT, CLASSIC_DIVIDE, CLASSIC_REMAINDER, CLASSIC_POWER, CLASSIC_AND, CLASSIC_XOR,
	CLASSIC_OR, CLASSIC_SHIFT_LEFT, CLASSIC_SHIFT_RIGHT, CLASSIC_ROTATE_LEFT,
	CLASSIC_ROTATE_RIGHT, CLASSIC_FUNCTIONS
};

/* One variable that the project uses, and what it is called here. */
struct classic_name {
	int type, number;      /* of a block: type of its first row in classic.def */
	const char *name;
	const struct classic_symbol *symbol; /* NULL: it has none                  */
	const char *comment;   /* of its symbol; ""                                */
};

struct classic_names {
	struct classic_name *list; /* by type, then number                     */
	int count;
};

/* What one look at the project finds. */
struct classic_uses;

/* A step as it is here: classic_chart.c. */
struct sfc_step {
	const char *name;
	bool publishes;        /* %X3 is this one's: several may have a number     */
	bool begins;           /* %X3 is TRUE before its page runs, and is seen    */
	bool late;             /* but not from the very beginning on               */
};

struct conversion {
	const struct classic_project *project;
	struct classic_options options;
	struct arena *arena;
	struct arena scratch;  /* what one rung alone needs                        */
	struct classic_text *out;
	struct classic_report *report;
	struct classic_names names;
	struct classic_uses *uses;
	struct names taken;    /* every name that is given, for none twice         */
	int *tried, tried_count; /* of each of them: how often it was wished again */
	const char **pou;      /* of each section, in the order of sections        */
	const char **label;    /* of each rung, in the order of rungs; NULL: none  */
	int *section_of;       /* of each rung: the last that had it, from 1 on    */
	const char *function_name[CLASSIC_FUNCTIONS]; /* NULL: not needed         */
	const char *section_pou; /* that is written now                            */
	int section;           /* its index                                        */
	int rungs_written;     /* in it                                            */
	int rung;              /* in it, of which is told now; 0: none             */
	struct classic_place at; /* of what is written now                         */
	size_t cap;
	int cap_lines;
	int temporaries;       /* BOOLs between the parts of a rung                */
	struct { const char **name; int count; } temps, programs;
	struct sfc_step *step; /* of each step; NULL: not needed yet             */
	const char *system;    /* the program of system bits; NULL: none is needed */
	const char *flash;     /* its time                                         */
};

/* ---- text: classic_rung.c ---- */
void put(struct conversion *c, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** text_of - a formatted string in the arena; "" without memory. */
const char *text_of(struct conversion *c, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** put_quoted - as a text of a rung file. */
void put_quoted(struct conversion *c, const char *text);
/** label_of - of a rung that the section has which is written now; NULL: it has no such
 * rung, or nothing jumps there. */
const char *label_of(const struct conversion *c, int rung);
/** tell - a line of the report about what is written now. */
void tell(struct conversion *c, enum report_kind kind, const char *format, ...)
	__attribute__((format(printf, 3, 4)));

/** write_kept - what only ClassicLadder understands (classic_keep.c). */
void write_kept(struct conversion *c);

/** add_program - one more that runs in each scan, behind the others. */
void add_program(struct conversion *c, const char *name);

/* ---- rows of classic.def: classic_names.c ---- */
struct classic_memory_row {
	int type;
	const char *prefix, *area;
	int first, size;
	const char *name;
};
struct classic_pin_row {
	int type;
	const char *prefix;
	enum classic_kind kind;
	const char *pin;
	bool is_bool;
};
enum {
	STEP_TYPE = 30, STEP_TIME = 220, /* %X3.A, %X3.V                           */
	LINUXCNC_IN = 300, LINUXCNC_INPUT = 1300, /* classic.def                   */
	MEMORY_KINDS = 12,               /* rows of CLASSIC_MEMORY                 */
	CLASSIC_ALL = CLASSIC_LIMIT + 1  /* the number of all words of a type      */
};
/** memory_of, pin_of - NULL: it is none. */
const struct classic_memory_row *memory_of(int type);
const struct classic_pin_row *pin_of(int type);
/** memory_numbers - how many of them there can be here, from 0. */
int memory_numbers(const struct classic_memory_row *row);
/** is_word - has this type 32 bits, and an address? */
bool is_word(int type);
/** address_of - "%IX0.3", "%VD4" */
const char *address_of(struct conversion *c, const struct classic_memory_row *row,
		       int number);
/** name_of - what it is called; NULL: nothing. */
const char *name_of(const struct conversion *c, int type, int number);

/* ---- new names ---- */
/** name_new - @wish, or something like it that nothing else has. */
const char *name_new(struct conversion *c, const char *wish);

/* ---- what is used ---- */
/** find_uses - looks at all of the project; false: no memory. */
bool find_uses(struct conversion *c);
/** used_name - the entry of a variable, or of the block it is a pin of; NULL: not used. */
struct classic_name *used_name(const struct conversion *c, int type, int number);
/** used_numbers - one more than the highest number that is used of a row; 0: none. */
int used_numbers(const struct conversion *c, const struct classic_memory_row *memory);
/** is_shared_block - does it stand in two places? @number is one of a cell. */
bool is_shared_block(const struct conversion *c, enum classic_kind kind, int number);
/** is_jumped_to - from anywhere. @rung is the number of one. */
bool is_jumped_to(const struct conversion *c, int rung);
/** has_step - is there one with this number? */
bool has_step(const struct conversion *c, int number);

/* ---- names: classic_names.c ---- */
/** find_names - gives everything that the project uses its name. */
void find_names(struct conversion *c);
/** operand_of - how @variable is written; NULL after telling why it cannot be.
 * @is_bool: what it is */
const char *operand_of(struct conversion *c, struct classic_variable variable,
		       bool *is_bool);
/** target_of - the same of what is written; NULL, too, when no program can write it. */
const char *target_of(struct conversion *c, struct classic_variable variable,
		      bool *is_bool);
/** instance_of - of a block. */
const char *instance_of(struct conversion *c, enum classic_kind kind, int number);
/** iec_word - CL_TON and its like. */
const char *iec_word(const struct classic_block *block);
/** step_of - its name; NULL: there is none. */
const char *step_of(struct conversion *c, int number);
/** kind_of - of a pin's type; CLASSIC_KINDS: it is no pin. */
enum classic_kind kind_of(int type);
/** words_of - how many words of a row there are, as the project says itself, or as it
 * uses. */
int words_of(struct conversion *c, const struct classic_memory_row *memory);
/** time_is_used - does anything read %X@number.V? */
bool time_is_used(struct conversion *c, int number);
/** put_comment_line - a line of its own, whatever stands in @text. */
void put_comment_line(struct conversion *c, const char *indent, const char *text);
/* ---- declarations: classic_declare.c ---- */
void write_declarations(struct conversion *c);
/** name_system - decides whether there is a program of system bits, which runs first. */
void name_system(struct conversion *c);
void write_system(struct conversion *c);

/* ---- expressions: classic_expression.c ---- */
/** comparison_of, assignment_of - what stands in `[ … ]`; NULL after telling why not. */
const char *comparison_of(struct conversion *c, const char *text);
const char *assignment_of(struct conversion *c, const char *text);
/** expression_uses - calls @take for each variable in @text. */
void expression_uses(const char *text,
		     void (*take)(void *context, struct classic_variable variable),
		     void *context);
void write_functions(struct conversion *c);

/* ---- rungs: classic_grid.c, charts: classic_sfc.c ---- */
void convert_rung(struct conversion *c, const struct classic_rung *rung);
void convert_sfc(struct conversion *c, const struct classic_section *section);
/** step_begins - is %X@number TRUE from the very beginning on? */
bool step_begins(struct conversion *c, int number);
#endif
