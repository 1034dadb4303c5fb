/* SPDX-License-Identifier: MIT
 *
 * xref - every place where a variable, member, address, label or POU is used.
 *
 * It reads names as check/scope.h does, of projects with errors too: what has no
 * meaning is XREF_UNKNOWN. It judges nothing and changes nothing.
 */
#ifndef XREF_H
#define XREF_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

enum xref_what {
	XREF_UNKNOWN,    /* a name that means nothing                         */
	XREF_VARIABLE,   /* also an instance, and a member of a structure     */
	XREF_ADDRESS,
	XREF_LABEL,
	XREF_POU,
	XREF_STRUCTURE,
	XREF_STEP,       /* of a chart; Fill in Fill.X, too                   */
	XREF_TRANSITION,
	XREF_ACTION,
};

/* What is spoken of. */
struct xref_target {
	enum xref_what what;
	int table;       /* VARIABLE: 0 the globals, n + 1 those of POU n, behind
			    them the structures: pou_count + 1 + n. LABEL, STEP,
			    TRANSITION, ACTION: n + 1                         */
	int index;       /* VARIABLE: in its table; POU, STRUCTURE, STEP …: its
			    number; LABEL: its rung, or behind all rungs its line
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
	bool open;       /* an address with an index behind it: up to where?  */
	bool unnamed;    /* the name is made from its declaration: of a block */
	uint32_t *slot;  /* of the project: id of the text it stands in; NULL:
			    it is no text. Dies with the next change          */
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
 * xref_addresses - the memory in use alone: declared variables with an address, and
 * addresses in texts, each text once, without their places
 *
 * For address_map_make(), to which it means the same, at a tenth of the time. Owns, fails,
 * scan-safe: as xref_make.
 */
bool xref_addresses(struct xref *out, struct project *project);
void xref_free(struct xref *xref);

/** xref_same - do both speak of the same thing? Addresses: of the same bits. */
bool xref_same(const struct xref_target *a, const struct xref_target *b);
/** xref_touches - the same, or at least one bit of memory in common. */
bool xref_touches(const struct xref_target *a, const struct xref_target *b);
/** xref_table - the variables of a table number; NULL: there is none. */
struct var_table *xref_table(struct project *project, int table);
/** xref_var - of a VARIABLE; NULL: of anything else. */
struct var *xref_var(struct project *project, const struct xref_target *target);
/** xref_variable - the target of variable @index of a table. */
struct xref_target xref_variable(struct project *project, int table, int index);
/**
 * xref_name - Motor, Main.Delay (of a POU), Recipe.Speed, %QX0.1, Main:Seal (a label)
 * @use: tells the name of what has no declaration; may be NULL
 * Returns as snprintf.
 */
int xref_name(const struct project *project, const struct xref_target *target,
	      const struct xref_use *use, char *out, size_t size);
/** xref_rank - in which order lists show things: names in that of their declarations,
 * then addresses, then what is unknown. */
int64_t xref_rank(const struct xref_target *target);
/** xref_kind_word - "coil", "read". Lives for ever. */
const char *xref_kind_word(enum xref_kind kind);
/** xref_text - the whole text that the use stands in; "" for none. */
const char *xref_text(const struct xref *xref, const struct xref_use *use);

/* What a line of a text is called that was made from something else. */
struct xref_lines {
	int (*of)(const void *context, int line);
	const void *context;
};

/**
 * xref_print - uses, sorted by what they speak of, a line or JSON object each
 * @name: NULL: all; else of what has this name (any case), with or without its POU, or
 *        of what touches this address
 * @lines: NULL: lines are those of the text
 * Returns how many; -1: no memory.
 */
int xref_print(struct project *project, const char *name, bool json,
	       const struct xref_lines *lines, const struct sink *sink);

#endif
