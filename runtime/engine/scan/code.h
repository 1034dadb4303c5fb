/* SPDX-License-Identifier: MIT
 *
 * code - the format of a code image, and its verifier.
 *
 * A program is data: little-endian 32-bit words, position-independent, bounded, with a
 * checksum. code_open() either refuses the bytes or gives a program that the VM can run
 * without checks.
 *
 * Data memory (`m`): the areas of catalog.def, as large as the header says, one after
 * another (base/areas.h); then the program's own data up to `data_size`. Offset
 * CODE_FALSE_AT holds a constant 0 and CODE_TRUE_AT a constant 1. A BOOL is a byte of 0
 * or 1. Operands of instructions are words of 24 bits offset and 8 bits type.
 *
 * Instructions: a word `op | n << 8`, then operand words:
 *   END
 *   LUT    n × (a, b, c, d)     m[d >> 8] = bit (a + 2b + 4c) of the table in the
 *                               low 8 bits of d; a, b, c are offsets of BOOLs
 *   BITGET byte, dst            n: bit 0..7
 *   BITPUT src, byte            n: bit 0..7
 *   COPY   en, dst, src         types in the top 8 bits of dst and src; n 0: widens;
 *                               else the size of the one type that both have, no STRING
 *   CMP    left, right, c, dst  m[dst] = bit (order + 4c) of the table n of 8 bits;
 *                               order: 1 left >= right, 2 left <= right, 3 both; c, dst:
 *                               offsets of BOOLs; types of left and right on top
 *   CMP_REAL CMP_DINT CMP_INT   likewise; left and right are offsets of that type
 *   REAL   en, eno, dst, a, b   n: enum math and flags. Offsets of BOOLs and REALs; in
 *   DINT INT                    the way of FN, of two values of that type
 *   FN     fn, en, eno, dst, inputs …   n: type | inputs << 8 |
 *                               result << 16; en, eno BOOLs; CODE_OWN at inputs
 *   FB     instance             n: enum word of the block
 *   BLOCK  dst, src, size       whole values and instances, the same at both
 *   STOP   cond                 BOOL; asks for STOP at the end of the scan
 *   CALL   entry                runs it up to its END; who calls whom makes no circle
 *   JMP    target               word index in the section, of an instruction
 *   JMPC   target, cond         that begins in the same program; n 1: if cond is FALSE
 *   AGET   en, ok, dst, base, index, low, count, stride   dst = element `index`; ok:
 *                               there is one (else dst = 0, counted). base: typed,
 *                               of the first element, whose index is low (signed);
 *                               stride: bytes to the next
 *                               n 1: base and stride count bits of the areas;
 *                               CODE_KEEP: without an element dst is as it was;
 *                               CODE_SHORT …: what the operands are anyway
 *   APUT   en, ok, src, base, index, low, count, stride   likewise; else nothing
 *                               Both: for each further index four more words, index,
 *                               low, count, stride; how many in n from bit 1 on
 *   EACH   cursor, base, n × target   n BOOLs at base: goes on at the target of the next
 *                               one from cursor (UDINT) on that is TRUE, and cursor is
 *                               behind it; none: cursor is 0, and on behind all targets
 *   SWITCH index, low, n × target   goes on at the target of `index`, the first of which
 *                               belongs to low (both signed); if there is none, behind them.
 *                               All lie further down
 *   TICK   hold, last, dt, x, t   dt := now - last (0 while hold), last := now; TIME;
 *                               of n BOOLs at x: those that are TRUE have dt added at t
 *   ABLOCK en, ok, dst, src, size, index, low, count, stride   BLOCK, where src (n bit 0:
 *                               dst) is that of the first element; more indices likewise
 *   PEEK   en, ok, dst, pointer, more, index, low   pointer: an LWORD, with the type of what it
 *                               leads to. dst = the value in its place at its position + more +
 *                               (index - low) * size; ok: all of it is in the place (else dst
 *                               = 0, counted). Not on small boards
 *   POKE   en, ok, src, pointer, more, index, low   likewise; else nothing. Only numbers, texts
 *                               and bytes of texts are written
 *   PEEK POKE with n 1   en, ok, dst, pointer, more, size, 0   likewise `size` bytes, whose layout
 *                               must be the same at both places; without it nothing is written
 *   POINT                       a safe point, n: words of code up to the next one or the end.
 *                               Only in programs of tasks; nothing waits in scratch
 */
#ifndef SCAN_CODE_H
#define SCAN_CODE_H

#include "engine/base/areas.h"
#include "engine/base/arena.h"
#include "engine/base/catalog.h"
#include "engine/base/diag.h"

#define CODE_MAGIC   "RUNGCODE"
#define CODE_VERSION 13u
#define CODE_AREAS   16

/* A pointer: offset of a place, its bytes, and the position from its first byte on. */
#define CODE_POINTER_PLACE 40
#define CODE_POINTER_BYTES 20
#define CODE_POINTER_MOST  0x7ffffu

enum code_section_kind {
	CODE_PROGRAMS = 1, /* struct code_program each                         */
	CODE_TASKS,        /* struct code_task each, by priority               */
	CODE_LAYOUT,       /* struct code_run each: the layout of data         */
	CODE_INIT,         /* (offset, bytes, data padded to 4) each           */
	CODE_BITS,         /* struct code_bits each: bits that live a byte each */
	CODE_CALLS,        /* indices in CODE_PROGRAMS: what the tasks run     */
	CODE_TEXT,         /* instructions                                     */
	/* From here on a target may drop sections; not part of the identity. */
	CODE_WATCH,        /* instructions that also store the power of cells  */
	CODE_SYMBOLS,      /* a word each, in order of declaration, see below  */
	CODE_GROUPS,       /* struct code_group each: symbols of one kind      */
	CODE_POWER,        /* struct code_power each, ordered by place         */
	CODE_PLACES,       /* struct code_place each, ordered by their text    */
	CODE_STRINGS,      /* NUL-ended: first the symbols' names, in order    */
	CODE_WATCHED,      /* struct code_watched each: instances and their power */
	CODE_SECTION_COUNT
};

struct code_section { uint32_t offset, size; }; /* bytes from the start      */

struct code_header {
	char magic[8];
	uint32_t version;
	uint32_t size;      /* of the whole image in bytes                     */
	uint32_t crc;       /* CRC-32C of all behind this word                 */
	uint32_t data_size; /* bytes of data memory                            */
	uint32_t retain_offset, retain_size; /* retained variables' range      */
	uint32_t budget;    /* instructions a scan may take                    */
	uint32_t core_runs; /* of CODE_LAYOUT; runs from here on are for watching */
	uint32_t words;     /* WORD_COUNT of the catalogue that numbers the words */
	uint32_t spare;     /* 0                                               */
	uint32_t area_bytes[CODE_AREAS]; /* by enum iec_area; the others 0     */
	struct code_section section[CODE_SECTION_COUNT];
};

/* Run by the tasks that call it, or only by CALL. */
struct code_program {
	uint32_t text, text_words;   /* word index in CODE_TEXT, length      */
	uint32_t watch, watch_words; /* in CODE_WATCH; 0 words: none         */
	uint32_t name;               /* offset in CODE_STRINGS               */
};

enum task_kind { TASK_CYCLE, TASK_INTERVAL, TASK_EVENT };
struct code_task {      /* ordered by priority, ties as in the file        */
	uint32_t kind;         /* enum task_kind                           */
	uint32_t interval[2];  /* ns, low word first; of TASK_INTERVAL     */
	uint32_t watchdog[2];  /* ns, likewise; 0: none                    */
	uint32_t single;       /* of TASK_EVENT: offset of a byte of m, and
				  the number of the bit in it on top       */
	uint32_t priority;     /* 0: the highest                           */
	uint32_t first, count; /* of CODE_CALLS                            */
	uint32_t name;         /* offset in CODE_STRINGS; "": not declared */
};

enum code_run_kind { RUN_VALUES, RUN_CONSTANTS, RUN_INSTANCE };
#define RUN_POINTERS 1
struct code_run {       /* ordered by offset, no overlap                   */
	uint32_t offset;
	uint8_t kind;   /* enum code_run_kind                              */
	uint8_t type;   /* enum iec_type of RUN_VALUES, RUN_CONSTANTS      */
	uint16_t word;  /* enum word of RUN_INSTANCE; capacity of STRINGs; RUN_POINTERS of
			   LWORDs that are pointers                        */
	uint32_t count; /* of values one after another, or of instances    */
};

struct code_bits {      /* bits first … first+count-1 of an area live at
			   slot … slot+count-1, a byte each               */
	uint32_t area, first, count, slot;
};

/* Of a symbol, in the top 8 bits: its type (IEC_NONE: an instance) and marks. The rest
 * is its offset in m. Its name is the string of the same number. An array's name ends
 * with its bounds; type and offset are those of its first element. */
enum symbol_flag {
	SYMBOL_CONSTANT = 1, SYMBOL_RETAIN = 2, /* of its group            */
	SYMBOL_TYPE = 0x1f,   /* mask of the type                          */
	SYMBOL_BIT = 0x20,    /* the offset counts bits of the areas       */
	SYMBOL_HIDDEN = 0x40, /* a temporary: not shown                    */
	SYMBOL_SHARED = 0x80, /* a name that is in several tables          */
	/* Only in struct declared_name and struct symbol. In an image the line of a
	 * VAR_ACCESS is a hidden symbol behind all others whose name begins with READ_ONLY
	 * or READ_WRITE and a blank. */
	SYMBOL_EXPORTED = 0x100, SYMBOL_WRITABLE = 0x200,
};
struct code_group {     /* symbols from here to the next group             */
	uint32_t first; /* of the symbols; ascending, 0 first              */
	uint32_t pou;   /* 1 + index in CODE_PROGRAMS; 0: global           */
	uint32_t flags; /* SYMBOL_CONSTANT, SYMBOL_RETAIN                  */
};

struct code_power {     /* what a watched scan keeps                       */
	uint16_t pou;   /* index in CODE_PROGRAMS                          */
	uint16_t row, col; /* of a cell, 1-based. 0, CODE_LINE: of a line of a list; 0,
			   CODE_LISTED: of a line of a generated list      */
	uint16_t type;  /* of out: 0 is BOOL, as older images of this version have */
	uint32_t rung;  /* 1-based; of a list: line of the file; of a generated list:
			   number of the instruction                       */
	uint32_t in;    /* offset in m of a BOOL: power at the cell's left end; has the
			   line run in the last run of its POU?            */
	uint32_t out;   /* offset in m: power that the cell lets through; the current
			   result after the line                           */
};

/* While watched, the power of a block's cells is copied for each instance: the bytes
 * that CODE_POWER has at from … from + size - 1 are copied to to …. */
struct code_watched {
	uint32_t pou;   /* index in CODE_PROGRAMS                          */
	uint32_t name;  /* offset in CODE_STRINGS: "Belt1", "Line.Belt1.Soft" */
	uint32_t from, to, size;
};

struct code_place {     /* from this word of CODE_TEXT on                  */
	uint32_t text;      /* words of CODE_WATCH are counted after them */
	uint32_t pou, rung; /* index in CODE_PROGRAMS; 1-based             */
	uint16_t row, col;  /* 1-based; 0: none. CODE_LINE: rung is a line
			       of the file, in a list that was written; row, if
			       not 0: column of a statement that begins at
			       this word (ladder_watch_lists())            */
};
#define CODE_LINE UINT16_MAX
#define CODE_LISTED (UINT16_MAX - 1)

#define CODE_OFFSET_BITS 24
#define CODE_OFFSET(word) ((word) & 0xffffffu)
#define CODE_TYPE(word)   ((word) >> CODE_OFFSET_BITS)
/* Of an input of FN: it has a type of its own. */
#define CODE_OWN         0x80000000u
#define CODE_OPERAND(type, offset) ((uint32_t)(type) << 24 | (offset))
/* PEEK and POKE, which small boards do not have. */
#ifdef RUNGBOARD_SMALL
#define WITH_POINTERS(...)
#else
#define WITH_POINTERS(...) __VA_ARGS__
#endif
#define CODE_FALSE_AT(areas) ((areas)->size) /* first byte behind the areas */
#define CODE_TRUE_AT(areas)  ((areas)->size + 1)

/* A verified code image: pointers into bytes that the caller keeps. */
struct program {
	const struct code_header *header;
	struct areas areas;     /* from the header                           */
	const uint8_t *base;
	const struct code_program *entry;
	const struct code_task *task;
	const uint32_t *call;
	const struct code_run *run;
	const struct code_bits *bits;
	const uint32_t *symbol;
	const struct code_group *group;
	const struct code_power *power;
	const struct code_place *place;
	const struct code_watched *watched;
	const uint32_t *text, *watch;
	const char *string;
	const struct symbol_index *index; /* NULL: none; set by the caller of code_open() */
	uint32_t entry_count, task_count, call_count, run_count, bits_count,
		 symbol_count, group_count, power_count, place_count, watched_count, text_words, watch_words,
		 string_bytes;
	bool classic;           /* set by the loader of a ClassicLadder project: */
};

/* In n of AGET and APUT. */
#define CODE_ACCESS 31u     /* mask of the rest                                   */
#define CODE_KEEP   32u     /* of AGET                                            */
#define CODE_SHORT  64u     /* one index, an INT; both values of one type of 2 bytes */
#define CODE_LONG   128u    /* with it: of 4 bytes                                */
#define CODE_WIDE   256u    /* with it: the index is a DINT                       */

#define CODE_DIMENSION 4u /* words of an index: its operand, low, count, stride */

/* n of REAL, DINT, INT: the functions of these names; no MOD of REAL. */
enum math { MATH_ADD, MATH_SUB, MATH_MUL, MATH_DIV, MATH_MOD, MATH_COUNT };
#define MATH_OF(n)   ((n) & 7u)
#define CODE_AT_MOST 0xccu /* n of CMP: <= of two values. */
#define MATH_ENABLED 8u  /* flag beside it: en is tested; else it is CODE_TRUE    */
#define MATH_LEFT    16u /* flag, not with MATH_ENABLED: dst = a if there is no result */
#define MATH_LOOP    64u /* flag, of ADD of INT and DINT without others: CMP_INT or CMP_DINT of its
			  * result follows, without another bit, and JMPC by that */
#define MATH_ROW     128u /* flag, of REAL with MATH_ENABLED: REAL with MATH_ENABLED follows, and its en is this
			  * eno: a row of boxes, which run one after the other if the first one does */
#define MATH_LIKELY  32u /* flag, with MATH_ENABLED: en is hardly ever FALSE, so a branch is faster */

/**
 * code_open - verifies an image and gives access to it
 * @bytes:   aligned to 8; kept by the caller as long as @out is used
 * @scratch: temporary memory; may be freed afterwards
 *
 * Checks checksum, version, sections, data layout, every operand (in range, of the
 * right type, not a constant when written), every jump target, and that the code ends.
 * Loops are bounded by the budget at run time.
 * Owns: nothing. Scan-safe: no.
 * Fails: false, a row of diag.def in @why and the byte offset in @where.
 */
bool code_open(const void *bytes, size_t len, struct arena *scratch,
	       struct program *out, enum diag_id *why, size_t *where);
/** code_open_made - the same of an image that assemble() has just made here: all but its header and checksum, which
 * takes as long to verify as it took to make. Owns: nothing. Scan-safe: no. Fails: as code_open(). */
bool code_open_made(const void *bytes, struct arena *scratch, struct program *out, enum diag_id *why,
		    size_t *where);

/** code_result - where a watched scan keeps the current result after a line of a list
 * @pou: index in CODE_PROGRAMS; @line: of the file
 *
 * Owns: nothing; lives with the program. Scan-safe: yes (a search). Fails: NULL: no
 * instruction is there, or the image has no map. `type` 0: it leaves no single value. */
const struct code_power *code_result(const struct program *program, uint32_t pou,
				     uint32_t line);
/** code_listed - the same of a list that a ladder or a chart becomes
 * @number: of the instruction, from 1; labels count, inputs and outputs of calls do not
 *
 * Scan-safe: yes. Fails: NULL, too, when the image has no such results: ladder_watch_lists(). */
const struct code_power *code_listed(const struct program *program, uint32_t pou,
				     uint32_t number);
/** code_run_size - bytes of one value or instance of a run. Scan-safe: yes. */
static inline uint32_t code_run_size(const struct code_run *run)
{
	return run->kind == RUN_INSTANCE ? word_row((enum word)run->word)->size :
	       iec_type_size((enum iec_type)run->type, run->word);
}
/** code_run_at - the run that holds this offset; NULL: none. Scan-safe: yes. */
const struct code_run *code_run_at(const struct program *program, uint32_t offset);
/** code_is_pointer - whether a pointer is there, which holds a place of this program. Scan-safe: yes. */
static inline bool code_is_pointer(const struct program *program, uint32_t offset)
{
	const struct code_run *run = code_run_at(program, offset);

	return run && run->kind == RUN_VALUES && run->type == IEC_LWORD && run->word == RUN_POINTERS;
}
/** code_bits_find - the offset of the byte that holds a bit of an area; 0: the bit is
 * packed.
 * @bits: ordered by area and first; @count of them.   Scan-safe: yes. */
static inline uint32_t code_bits_find(const struct code_bits *bits, uint32_t count,
				      enum iec_area area, uint32_t bit)
{
	uint32_t low = 0, high = count;

	while (low < high) {
		uint32_t middle = low + (high - low) / 2;

		if (bits[middle].area > area ||
		    (bits[middle].area == area && bits[middle].first > bit))
			high = middle;
		else
			low = middle + 1;
	}
	if (low == 0 || bits[low - 1].area != area ||
	    bit - bits[low - 1].first >= bits[low - 1].count)
		return 0;
	return bits[low - 1].slot + (bit - bits[low - 1].first);
}
/** code_order_alone - whether the table @n of CMP asks for the order alone, not for the bit c. Scan-safe: yes. */
static inline bool code_order_alone(uint32_t n)
{
	return n < 256 && n >> 4 == (n & 15);
}
/** code_words - words of the instruction at @code: 1 + its operands.
 * Scan-safe: yes. */
uint32_t code_words(const uint32_t *code);
/** code_targets - the words of the instruction at @code that say where it may jump to, each the
 * index of a word of its section; @count of them. Scan-safe: yes. */
const uint32_t *code_targets(const uint32_t *code, uint32_t *count);
/** code_type - the type that REAL, DINT, INT and CMP_REAL … compute with; IEC_NONE for
 * another @op. Scan-safe: yes. */
uint32_t code_type(uint32_t op);
/* Bounds in the name of a symbol that is an array: `Table[1..10]`. */
struct code_bounds {
	size_t head;     /* bytes before the [; the whole name if there is none */
	int32_t low;
	uint32_t count;  /* 0: no array                                     */
};
/** code_bounds - the bounds in a symbol's name. Scan-safe: yes. */
struct code_bounds code_bounds(const char *name);
/** code_instance - the FB whose instance is at @offset of data memory; WORD_COUNT:
 * none is. Scan-safe: yes. */
enum word code_instance(const struct program *program, uint32_t offset);
/** code_identity - SHA-256 of code and data layout, without the maps that a target may
 * drop. @out gets 32 bytes. Scan-safe: no (slow). */
void code_identity(const struct program *program, uint8_t out[32]);
/** code_is_same - whether code_identity() of both is the same; without the digests, which take milliseconds.
 * Scan-safe: no (slow). */
bool code_is_same(const struct program *a, const struct program *b);
/**
 * code_strip - an image without its maps, for small targets
 * @image: verified
 * @out:   caller's, aligned to 8, at least as large as the result; NULL: none
 *
 * Owns: nothing. Scan-safe: no. Returns the bytes of the result.
 */
size_t code_strip(const void *image, void *out);
/** code_print - one instruction as text, e.g. "lut     8a b100 b101 b102 -> b103"
 * @code: of a verified program
 * @part: which of the n parts of a LUT, 0-based; else 0
 * Returns as snprintf.   Scan-safe: no. */
int code_print(const uint32_t *code, uint32_t part, char *out, size_t size);
#endif
