/* SPDX-License-Identifier: MIT
 *
 * xref - every place where a variable, member, address, label or POU is used.
 *
 * It resolves names as check/scope.h does, also in projects with errors: an unknown
 * name is XREF_UNKNOWN.
 */
#ifndef XREF_H
#define XREF_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

struct lex;

enum xref_what {
	XREF_UNKNOWN,    /* an unknown name                                   */
	XREF_VARIABLE,   /* also an instance, and a member of a structure     */
	XREF_ADDRESS,
	XREF_LABEL,
	XREF_POU,
	XREF_STRUCTURE,
	XREF_STEP,       /* of a chart; also Fill in Fill.X                   */
	XREF_TRANSITION,
	XREF_ACTION,
	XREF_NAMED,      /* a type with a name that is no structure           */
	XREF_VALUE,      /* a value of an enumeration                          */
};

/* The thing that a name means. */
struct xref_target {
	enum xref_what what;
	int table;       /* VARIABLE: 0 the globals, n + 1 those of POU n, behind
			    them the structures: pou_count + 1 + n, and the other
			    types with names, with one declaration each. LABEL,
			    STEP, TRANSITION, ACTION: n + 1                   */
	int index;       /* VARIABLE: in its table; POU, STRUCTURE, STEP, NAMED, VALUE …:
			    its number; LABEL: its rung, or behind all rungs its line
			    of a list; -1: there is none                      */
	struct iec_addr addr; /* of an ADDRESS, and of a variable with AT     */
};

enum xref_kind {
	XREF_DECLARED, XREF_TYPE, /* it is the type of a variable             */
	XREF_READ, XREF_WRITTEN, XREF_CHANGED, /* read and written            */
	XREF_COIL,       /* written in each scan                              */
	XREF_SET, XREF_RESET, XREF_CALLED, XREF_JUMPED,
	XREF_RUN,        /* a program that a configuration names              */
	XREF_LEFT, XREF_ENTERED, /* a step, by a transition                   */
	XREF_INITIAL,    /* a member or parameter in initial values           */
	XREF_KINDS
};

struct xref_use {
	struct xref_target target;
	enum xref_kind kind;
	int pou;         /* 0-based; -1: none: globals, structures, tasks     */
	int rung;        /* 1-based; 0: no rung                               */
	int row, col;    /* 1-based cell. Of a list: line counted from the heading
			    of its POU, and column. 0: none                   */
	int line;        /* 1-based in its file; 0: unknown                   */
	const char *file; /* borrowed from the project                        */
	bool included;   /* stands in a file that the project names           */
	bool off;        /* in a rung that is OFF                             */
	bool open;       /* an address with an index behind it: the end is not known */
	bool unnamed;    /* made from a declaration, as the name of a block is */
	uint32_t *slot;  /* in the project: id of the text it is in; NULL: it is not in a
			  * text. Invalid after a change */
	uint32_t at, len; /* bytes of that text                               */
};

struct xref {
	struct project *project;
	struct arena arena;
	struct xref_use *use;
	int count;
};

/**
 * xref_make - finds all uses, in the order of the file, declarations first
 * @project: borrowed as long as @out; only its table of names may grow
 *
 * Owns: xref_free(), also after a failure.   Scan-safe: no.
 * Fails: false: no memory.
 */
bool xref_make(struct xref *out, struct project *project);
/**
 * xref_addresses - only the used memory: declared variables with an address, and
 * addresses in texts, each text once, without places
 *
 * For address_map_make(): same result in a tenth of the time. Owns, fails, scan-safe:
 * as xref_make.
 */
bool xref_addresses(struct xref *out, struct project *project);
void xref_free(struct xref *xref);
/** xref_part - @addr is the address at the lexer; becomes the part that is named behind it: `%MW12.%X9` is
 * %MX13.1. Returns bytes of both. Scan-safe: yes. */
size_t xref_part(const struct lex *lex, struct iec_addr *addr);

/** xref_same - whether both mean the same thing; addresses: the same bits. */
bool xref_same(const struct xref_target *a, const struct xref_target *b);
/** xref_touches - whether both are the same or share a bit of memory. */
bool xref_touches(const struct xref_target *a, const struct xref_target *b);
/** xref_table - the variables of a table number; NULL: there is none. */
struct var_table *xref_table(struct project *project, int table);
/** xref_var - the variable of a VARIABLE; otherwise NULL. */
struct var *xref_var(struct project *project, const struct xref_target *target);
/** xref_value_owner - the declaration with the enumeration of a VALUE: of its type, or the first
 * variable of one without a name. @table, @index: get the place of it. False: there is none. */
bool xref_value_owner(const struct project *project, int value, int *table, int *index);
/** xref_variable - the target of variable @index of a table. */
struct xref_target xref_variable(struct project *project, int table, int index);
/**
 * xref_name - Motor, Main.Delay (of a POU), Recipe.Speed, %QX0.1, Main:Seal (a label),
 * Color#Red (a value; Main.Door#Open of an enumeration without a name)
 * @use: gives the name of an undeclared thing; may be NULL Returns as snprintf.
 */
int xref_name(const struct project *project, const struct xref_target *target,
	      const struct xref_use *use, char *out, size_t size);
/** xref_rank - the order of things in lists: names in the order of declarations, then
 * addresses, then unknown names. */
int64_t xref_rank(const struct xref_target *target);
/** xref_text - the whole text of the use; "" for none. */
const char *xref_text(const struct xref *xref, const struct xref_use *use);

/* Maps lines of a generated text to lines of its source. */
struct xref_lines {
	int (*of)(const void *context, int line);
	const void *context;
};

/**
 * xref_print - prints uses, sorted by thing, a line or JSON object each
 * @name: NULL: all; else things of this name (any case), with or without the POU, or
 *        things that share memory with this address
 * @lines: NULL: lines are those of the text
 * Returns how many; -1: no memory.
 */
int xref_print(struct project *project, const char *name, bool json,
	       const struct xref_lines *lines, const struct sink *sink);

#endif
