/* SPDX-License-Identifier: MIT
 *
 * classic_read - the cursor, numbers, names and messages that the readers of members share.
 * Private to classic_read*.c.
 */
#ifndef CLASSIC_READ_H
#define CLASSIC_READ_H

#include "engine/exchange/classic/classic.h"

#include <stdint.h>
#include <string.h>

enum {
	CLASSIC_LINE = 2000,     /* bytes of a line; ClassicLadder has 298     */
	CLASSIC_PRESET = 32767,  /* of a block                                 */
	CLASSIC_PERIOD = 3600000, /* ms: longest time between scans            */
	CLASSIC_USUAL_PERIOD = 50
};

struct classic_reader {
	struct arena *arena;
	struct classic_project *project;
	struct classic_report *report;
	struct diag_list *diags;
	bool folder;             /* each member is a file of its own           */

	const struct classic_member *member; /* in work                        */
	const char *at, *end;    /* the part of it that is not read yet        */
	int line_number;
	const char *line;        /* the line under the cursor, blanks cut      */
	size_t len;
	bool good;               /* no error in it yet                         */
};

/* ---- lines ---- */
/** classic_member_begin - before the first line of @member. */
void classic_member_begin(struct classic_reader *reader,
			  const struct classic_member *member);
/** classic_line_next - the next line, without its end and the blanks around it. Lines that
 * are too long are reported and skipped. false: there is none. */
bool classic_line_next(struct classic_reader *reader);
/** classic_line_told - the same, without comments (;) and empty lines. */
bool classic_line_told(struct classic_reader *reader);
/** classic_line_after - the text behind @key; NULL: the line does not begin with it. */
const char *classic_line_after(const struct classic_reader *reader, const char *key);
/** classic_here - the place of the line under the cursor. */
struct classic_place classic_here(const struct classic_reader *reader);
/** classic_fail - a message about this line, "MEMBER: TEXT"; false for an error. */
bool classic_fail(struct classic_reader *reader, enum diag_id id, const char *text,
		  size_t len);
/** classic_lost - adds a line to the report: what is on this line is ignored. */
void classic_lost(struct classic_reader *reader, const char *text);
/** classic_text - @len bytes as UTF-8 to show; bytes that are not UTF-8 are read as
 * Latin-1, control characters become `?`. "": no memory. */
const char *classic_text(struct classic_reader *reader, const char *from, size_t len);
/** classic_name - the same for a name; a warning if it has more than @usual bytes (0: no
 * warning), an error if it is longer than names may be. */
const char *classic_name(struct classic_reader *reader, const char *from, size_t len,
			 size_t usual);
/** classic_number - one whole number at *@at, and blanks around it; steps over them. Larger
 * numbers become INT32_MAX. false: there is none. */
bool classic_number(const char **at, const char *end, int *out);
/** classic_numbers - numbers of the line from @at, with commas between them, @max at
 * most. Missing ones are 0; at least @least must be there. false: reported. */
bool classic_numbers(struct classic_reader *reader, const char *at, int *out, int least,
		     int max);
/** classic_in_range - false, and a message, if @number is out of range. */
bool classic_in_range(struct classic_reader *reader, int number, int low, int high);
/** classic_version - false, and a message, for `#VER=` beyond @known. */
bool classic_version(struct classic_reader *reader, int known);
/** classic_twice - reports that @what has one number twice. */
void classic_twice(struct classic_reader *reader, struct classic_place place,
		   const char *what, int number);

/* ---- classic_read_rung.c ---- */
/** classic_read_rung - one member rung_N.csv. */
void classic_read_rung(struct classic_reader *reader, const struct classic_member *member,
		       int number);
/** classic_read_numeric - a bare rung file. */
void classic_read_numeric(struct classic_reader *reader,
			  const struct classic_member *member);
/** classic_is_numeric - true if the text looks like a bare rung file. */
bool classic_is_numeric(const char *text, size_t len);

/* ---- classic_read_table.c ---- */
void classic_read_blocks(struct classic_reader *reader, const struct classic_member *member,
			 struct classic_blocks *blocks, const char *letters, int values);
void classic_read_expressions(struct classic_reader *reader,
			      const struct classic_member *member);
void classic_read_sections(struct classic_reader *reader,
			   const struct classic_member *member);
void classic_read_symbols(struct classic_reader *reader,
			  const struct classic_member *member);
void classic_read_io(struct classic_reader *reader, const struct classic_member *member);
void classic_read_settings(struct classic_reader *reader,
			   const struct classic_member *member);
/** classic_add_block - a block from "preset", "base,preset" or "base,preset,mode", by @values. */
void classic_add_block(struct classic_reader *reader, struct classic_blocks *blocks,
		       int number, const char *at, int values);

/* ---- classic_read_sfc.c ---- */
void classic_read_sfc(struct classic_reader *reader, const struct classic_member *member);
/** classic_read_variable - TYPE/NUMBER, also with an index. @slash: another separator beside
 * '/'. Returns what follows it; NULL: it is no variable. */
const char *classic_read_variable(const char *at, const char *end, char slash,
				  struct classic_variable *variable);

#endif
