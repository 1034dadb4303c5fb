/* SPDX-License-Identifier: MIT
 *
 * address_rows - the memory of a project as rows of bytes: what lies at each bit, how often it
 * is used, and what shares memory with it.
 *
 * The engine's cross reference knows the uses; nothing is counted here again. Bytes without
 * anything, and long runs of one array, are one row.
 */
#ifndef EDITOR_ADDRESS_ROWS_H
#define EDITOR_ADDRESS_ROWS_H

#include "editor-gtk/document/document.h"

#include "engine/xref/address_map.h"

/* The columns of a row: bit 0 to 7, then what is accessed as a byte, word and so on. */
enum { ADDRESS_BYTE = 8, ADDRESS_WORD, ADDRESS_DOUBLE, ADDRESS_LONG, ADDRESS_COLUMNS };

enum address_state {
	ADDRESS_FREE,
	ADDRESS_REACHED, /* free, but behind an address with an index: %MW0[I] */
	ADDRESS_UNUSED,  /* declared, never used                              */
	ADDRESS_USED,    /* by one variable, or as one address                */
	ADDRESS_SEVERAL, /* two things share it: a word over a bit            */
	ADDRESS_TWICE,   /* written in each scan in two places or more         */
	ADDRESS_STATES
};

struct address_row {
	enum iec_area area;
	uint32_t byte, end;      /* the bytes; end is behind the last          */
	int first, count;        /* its things in struct address_rows.member; 0: free */
};

struct address_rows {
	struct xref xref;
	struct address_thing *thing;
	int things;
	GArray *member;          /* of int: numbers of things                  */
	GArray *row;             /* of struct address_row                      */
	GArray *open;            /* of int: things with an index behind them   */
};

/** address_rows_new - of the document as it is, which must not change meanwhile; empty for a
 * document of text. Owns: the caller. */
struct address_rows *address_rows_new(LadderDocument *document);
void address_rows_free(struct address_rows *rows);
const struct address_row *address_rows_at(const struct address_rows *rows, int row);
/** address_state_of - of a cell. */
enum address_state address_state_of(const struct address_rows *rows, int row, int column);
/** address_is_own - is something in the cell of exactly this width? */
bool address_is_own(const struct address_rows *rows, int row, int column);
/** address_is_reached - may the index of an address before it, %MW0[I], lead into the row? Also
 * where something else is. */
bool address_is_reached(const struct address_rows *rows, int row);
/** address_cell_text - "%MW4: Speed, 3 uses", a line for each thing in the cell, translated.
 * Owns: the caller. */
char *address_cell_text(const struct address_rows *rows, int row, int column);
/** address_row_text - "%MB4", "%MB4 – %MB99"; ADDRESS_BYTE as its width. Owns: the caller. */
char *address_row_text(const struct address_rows *rows, int row);
/** address_row_names - "Start, Speed (%MW4), %MX0.3"; or "94 bytes free", translated. Owns:
 * the caller. */
char *address_row_names(const struct address_rows *rows, int row);
/** address_cell_goal - where a click on a cell leads: the only variable in it (its table and
 * index), or the uses of a name (@name, which the caller frees): of the address with the index
 * where that may lead. False: nothing is there. */
bool address_cell_goal(const struct address_rows *rows, int row, int column, int *table,
		       int *index, char **name);

#endif
