/* SPDX-License-Identifier: MIT
 *
 * classic_convert - types and functions that the files of the import share. Private to
 * classic_*.c.
 */
#ifndef CLASSIC_CONVERT_H
#define CLASSIC_CONVERT_H

#include "engine/base/names.h"
#include "engine/exchange/classic/classic_rung.h"

#include <stdarg.h>

/* Operators and functions of ClassicLadder that become functions of the rung file. */
enum classic_function {
	CLASSIC_SUM, CLASSIC_DIFFERENCE, CLASSIC_PRODUCT, CLASSIC_DIVIDE, CLASSIC_REMAINDER, CLASSIC_POWER, CLASSIC_AND, CLASSIC_XOR,
	CLASSIC_OR, CLASSIC_SHIFT_LEFT, CLASSIC_SHIFT_RIGHT, CLASSIC_ROTATE_LEFT,
	CLASSIC_ROTATE_RIGHT, CLASSIC_FUNCTIONS
};

/* One variable that the project uses, and its name in the rung file. */
struct classic_name {
	int type, number;      /* of a block: type of its first row in classic.def */
	const char *name;
	const struct classic_symbol *symbol; /* NULL: it has none                  */
	const char *comment;   /* of its symbol; ""                                */
	bool written;          /* the sections have this name                      */
};

struct classic_names {
	struct classic_name *list; /* by type, then number                     */
	int count;
};

/* The variables, blocks and jump targets that the project uses: classic_names.c. */
struct classic_uses;

/* A step of the chart in the rung file: classic_sfc.c. */
struct sfc_step {
	const char *name;
	bool publishes;        /* it sets %X3; of several steps with a number: one */
	bool begins;           /* %X3 must be TRUE before its page first runs      */
	bool late;             /* but not before the first page has run            */
};

struct conversion {
	const struct classic_project *project;
	struct classic_options options;
	struct arena *arena;
	struct arena scratch;  /* emptied before each rung                         */
	struct classic_text *out;
	struct classic_report *report;
	struct classic_names names;
	struct classic_uses *uses;
	struct names taken;    /* every name given so far                          */
	int *tried, tried_count; /* by name: the number that was last put behind it */
	const char **pou;      /* of each section, in the order of sections        */
	const char **label;    /* of each rung, in the order of rungs; NULL: none  */
	int *section_of;       /* of each rung: the last section that has it, 1-based */
	const char *function_name[CLASSIC_FUNCTIONS]; /* NULL: not needed         */
	const char *section_pou; /* POU of the section in work; NULL: none         */
	int section;           /* its index                                        */
	int rungs_written;     /* in it                                            */
	int rung;              /* in it, for the report; 0: none                   */
	struct classic_place at; /* place of the text in work                      */
	size_t cap;
	struct { const char **name; int count; } temps, programs;
	struct sfc_step *step; /* by index; NULL: not made yet                     */
	const char *system;    /* the program of system bits; NULL: not needed     */
	const char *flash;     /* its variable that counts the time                */
};

/* ---- text: classic_convert.c ---- */
void put(struct conversion *c, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** text_of - formatted text in the arena; "" without memory. */
const char *text_of(struct conversion *c, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** put_quoted - writes @text in quotes. */
void put_quoted(struct conversion *c, const char *text);
/** label_of - label of @rung in the section in work; NULL: the section does not have that
 * rung, or no jump leads to it. */
const char *label_of(const struct conversion *c, int rung);
/** tell - adds a line to the report, with the place and rung in work. */
void tell(struct conversion *c, enum report_kind kind, const char *format, ...)
	__attribute__((format(printf, 3, 4)));

/** write_kept - members that only ClassicLadder uses, in VIEW … END_VIEW; report_kept - their
 * lines of the report (classic_keep.c). */
void write_kept(struct conversion *c);
void report_kept(struct conversion *c);

/** add_program - adds a program to the end of the task. */
void add_program(struct conversion *c, const char *name);

/* ---- rows of classic.def: classic_names.c ---- */
enum {
	STEP_TYPE = 30, STEP_TIME = 220, /* %X3.A, %X3.V                           */
	LINUXCNC_IN = 300, LINUXCNC_INPUT = 1300, /* classic.def                   */
	CLASSIC_ALL = CLASSIC_LIMIT + 1  /* stands for the array of a type         */
};
/** memory_numbers - one more than the highest number that a rung file can hold. */
int memory_numbers(const struct classic_memory_row *row);
/** address_of - "%IX0.3", "%VD4" */
const char *address_of(struct conversion *c, const struct classic_memory_row *row,
		       int number);
/** name_of - its name in the rung file; NULL: it has none. */
const char *name_of(const struct conversion *c, int type, int number);

/* ---- new names ---- */
/** name_new - @wish, or with a suffix if it is taken or reserved. */
const char *name_new(struct conversion *c, const char *wish);

/* ---- variables in use ---- */
/** find_uses - notes the variables, blocks and jump targets of the project. false: no
 * memory. */
bool find_uses(struct conversion *c);
/** used_name - the entry of a variable or block; NULL: the project does not use it. */
struct classic_name *used_name(const struct conversion *c, int type, int number);
/** used_numbers - one more than the highest number in use of a row; 0: none. */
int used_numbers(const struct conversion *c, const struct classic_memory_row *memory);
/** block_cells - how many cells hold this block: 0, 1, or 2 for more. */
int block_cells(const struct conversion *c, enum classic_kind kind, int number);
/** is_jumped_to - true if a jump of any section leads to rung number @rung. */
bool is_jumped_to(const struct conversion *c, int rung);

/* ---- names: classic_names.c ---- */
/** symbol_is_none - true if it is empty or the own name of its variable. */
bool symbol_is_none(const struct classic_symbol *symbol);
/** find_names - names everything that find_uses() found. */
void find_names(struct conversion *c);
/** operand_of - text of @variable in a rung file; NULL after a line of the report.
 * @is_bool: gets whether it is a BOOL, else it is a DINT. */
const char *operand_of(struct conversion *c, struct classic_variable variable,
		       bool *is_bool);
/** target_of - the same for a variable that is written; NULL also if it is read-only. */
const char *target_of(struct conversion *c, struct classic_variable variable,
		      bool *is_bool);
/** instance_of - name of a block; NULL: nothing uses it. */
const char *instance_of(struct conversion *c, enum classic_kind kind, int number);
/** iec_word - CL_TON, CL_TOF or CL_TP. */
const char *iec_word(const struct classic_block *block);
/** step_of - name of %X@number; NULL: nothing uses it. */
const char *step_of(struct conversion *c, int number);
/** words_of - length of the array of a row: the size that general.txt gives, or the
 * highest number in use if that is more. */
int words_of(struct conversion *c, const struct classic_memory_row *memory);
/** time_is_used - true if something reads %X@number.V. */
bool time_is_used(struct conversion *c, int number);
/** put_comment_line - a comment on a line of its own; @text may hold comment marks. */
void put_comment_line(struct conversion *c, const char *indent, const char *text);
/* ---- declarations: classic_declare.c ---- */
void write_declarations(struct conversion *c);
/** name_system - makes the program of system bits the first one, if a rung reads one. */
void name_system(struct conversion *c);
void write_system(struct conversion *c);

/* ---- expressions: classic_expression.c ---- */
/** comparison_of, assignment_of - the text between `[` and `]`; NULL after a line of the
 * report. */
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
/** report_pages - reports pages that no section shows. */
void report_pages(struct conversion *c);
/** step_begins - true if %X@number is TRUE before the first scan. */
bool step_begins(struct conversion *c, int number);
#endif
