/* SPDX-License-Identifier: MIT
 *
 * classic - a ClassicLadder project as it stands in its files.
 *
 * Numbers are those of the files; classic.def has the codes of elements and variables.
 * classic_rung.h converts them; docs/from-classicladder.md describes what they do in
 * ClassicLadder. Everything lives in one arena. An entry of a numbered list begins with
 * its number and its place.
 */
#ifndef CLASSIC_H
#define CLASSIC_H

#include "engine/base/arena.h"
#include "engine/base/diag.h"
#include "engine/exchange/report.h"

#include <stdarg.h>

enum {
	CLASSIC_ROWS = 8,
	CLASSIC_COLUMNS = 12,
	CLASSIC_LINKS = 10,      /* steps of one side of a transition          */
	CLASSIC_LIMIT = 10000,   /* numbers of rungs, variables, blocks, lines */
	CLASSIC_BYTES = 16 << 20 /* of a project, unpacked                     */
};

/* The program that wrote the project. Grids and a few codes differ. */
enum classic_dialect { CLASSIC_UPSTREAM, CLASSIC_LINUXCNC, CLASSIC_NUMERIC };

struct classic_variable {
	int type, number;
	int index_type, index_number; /* %W0[%W4]; index_type -1: no index     */
};

struct classic_cell {
	int element;             /* its code; 0: free                          */
	bool top;                /* its left end is joined with that above     */
	struct classic_variable variable; /* of blocks: number alone           */
};

/* A place in the project, for messages and the report. */
struct classic_place {
	const char *member;      /* "rung_3.csv"                               */
	int line;                /* 1-based: in the whole unpacked text, or in
				    the file of a folder                       */
};

struct classic_rung {
	int number;              /* what jumps and links call it               */
	struct classic_place place;
	const char *label, *comment; /* UTF-8; "": none                        */
	int previous, next;      /* -1: none                                   */
	int rows, columns;       /* of the file                                */
	int row_line[CLASSIC_ROWS];
	struct classic_cell cell[CLASSIC_ROWS][CLASSIC_COLUMNS];
};

/* One timer, monostable, counter or register. Fields that its kind does not have are 0. */
struct classic_block {
	int number;
	struct classic_place place;
	int base;                /* 0 minutes, 1 seconds, 2 tenths of a second */
	int preset;              /* in units of its base                       */
	int mode;                /* IEC timer: 0 TON 1 TOF 2 TP; register: 1 FIFO 2 LIFO */
};

struct classic_blocks {
	struct classic_block *block; /* by ascending number                    */
	int count;
};

struct classic_expression {
	int number;
	struct classic_place place;
	const char *text;        /* encoded: "@200/0@+1"                       */
};

struct classic_section {
	int number;              /* sections run in this order                 */
	struct classic_place place;
	const char *name;
	bool sequential;
	int subroutine;          /* its number; -1: it runs in each scan       */
	int first, last;         /* rungs; -1: it has none                     */
	int page;
};

struct classic_step {
	int index;               /* transitions refer to it                    */
	struct classic_place place;
	bool initial;
	int number;              /* 3 of %X3                                   */
	int page, x, y;
};

struct classic_transition {
	int index;
	struct classic_place place;
	int activate[CLASSIC_LINKS], activates;     /* indices of steps        */
	int deactivate[CLASSIC_LINKS], deactivates;
	int page, x, y;
	struct classic_variable condition;          /* type -1: none           */
};

struct classic_note {                /* a comment on a sequential page         */
	struct classic_place place;
	int page, x, y;
	const char *text;
};

struct classic_symbol {
	struct classic_place place;
	const char *variable;    /* "%I0"                                      */
	const char *name, *comment;
};

struct classic_io {
	struct classic_place place;
	bool output;
	int first;               /* %I or %Q                                   */
	int device;              /* -1 none, 0 and 1 ports of a PC, 2 Raspberry Pi, 3 AT91, 100… Comedi */
	int sub_device, channel, count;
	bool inverted;
	int setup;
};

/* KEY=VALUE of general.txt, project_infos.txt, com_params.txt. */
struct classic_setting {
	struct classic_place place;
	const char *key, *value;
};

struct classic_member {          /* one file of the project, whole             */
	const char *name;
	const char *text;        /* its bytes, unchanged                       */
	size_t len;
	int line;                /* of its first line                          */
};

struct classic_project {
	enum classic_dialect dialect;
	const char *file;
	int period;              /* PERIODIC_REFRESH, ms; 50 without it        */
	struct classic_rung **rung;      int rungs;      /* by ascending number */
	struct classic_blocks timer, monostable, counter, iec_timer, reg;
	struct classic_expression *expression; int expressions; /* by number    */
	struct classic_section *section; int sections;   /* by number           */
	struct classic_step *step;       int steps;      /* by index            */
	struct classic_transition *transition; int transitions; /* by index     */
	struct classic_note *note;       int notes;
	struct classic_symbol *symbol;   int symbols;
	struct classic_io *io;           int ios;
	struct classic_setting *setting; int settings;
	struct classic_member *member;   int members;
	int register_list;       /* SIZE_REGISTER_LIST; 500 without it         */
};

/* ---- rows of classic.def: classic.c ---- */

enum classic_kind {
	CLASSIC_TIMER, CLASSIC_MONOSTABLE, CLASSIC_IEC_TIMER, CLASSIC_COUNTER,
	CLASSIC_REGISTER, CLASSIC_KINDS
};
struct classic_memory_row {
	int type;
	const char *prefix, *area;
	int first, size;
	const char *name;
};
struct classic_pin_row {
	int type;
	const char *prefix, *attribute;
	enum classic_kind kind;
	const char *pin;
	bool is_bool;
};
enum { CLASSIC_MEMORY_ROWS = 12, CLASSIC_PIN_ROWS = 20 };
extern const struct classic_memory_row classic_memory_rows[CLASSIC_MEMORY_ROWS];
extern const struct classic_pin_row classic_pin_rows[CLASSIC_PIN_ROWS];
/** classic_kind_names - "TM" of an instance TM0. A monostable is not M0: that is an address. */
extern const char *const classic_kind_names[CLASSIC_KINDS];

/** classic_memory_of, classic_pin_of - the row of @type; NULL: it is no memory, no pin. */
const struct classic_memory_row *classic_memory_of(int type);
const struct classic_pin_row *classic_pin_of(int type);
/** classic_kind_of - the kind of block that @type is a pin of; CLASSIC_KINDS: none. */
enum classic_kind classic_kind_of(int type);

/** classic_is - true if these can be the first bytes of a project or a bare rung file, packed
 * or not. Scan-safe: yes. */
bool classic_is(const void *bytes, size_t len);

/**
 * classic_read - a project from its bytes
 * @file:   names it in messages; must stay valid
 * @bytes:  the text, or that text packed by gzip
 * @report: gets a line for each part of the file that is ignored
 *
 * Owns: @arena owns everything.   Scan-safe: no.
 * Fails: NULL and at least one diagnostic; no part of the project is returned.
 */
struct classic_project *classic_read(struct arena *arena, const char *file,
				     const void *bytes, size_t len,
				     struct classic_report *report,
				     struct diag_list *diags);
/** classic_read_folder - the same for a folder that holds the members as files, as before
 * 2008. */
struct classic_project *classic_read_folder(struct arena *arena, const char *folder,
					    struct classic_report *report,
					    struct diag_list *diags);

/** classic_by_number - orders entries of a list by their number, which every entry begins
 * with: for qsort() and bsearch(). */
int classic_by_number(const void *a, const void *b);
/** classic_rung_index - index in project->rung of rung @number; -1: there is none. */
int classic_rung_index(const struct classic_project *project, int number);
/** classic_rung, classic_block, classic_expression, classic_setting - by number or key;
 * NULL: there is none. */
const struct classic_rung *classic_rung(const struct classic_project *project, int number);
const struct classic_block *classic_block(const struct classic_blocks *blocks, int number);
const char *classic_expression(const struct classic_project *project, int number);
const char *classic_setting(const struct classic_project *project, const char *key);

#endif
