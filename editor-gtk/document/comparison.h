/* SPDX-License-Identifier: MIT
 *
 * comparison - two versions of a project, and the list of their differences.
 *
 * The engine finds the differences (compare/compare.h); here they become rows for a person:
 * one for each rung, step, transition, symbol or piece of a list, in words; and one for each line of
 * the I/O map. It shows nothing, and reads only the files that it is given, those that they name, and
 * their I/O maps.
 */
#ifndef EDITOR_COMPARISON_H
#define EDITOR_COMPARISON_H

#include "engine/ladder.h"

#include <glib.h>
#include <stdbool.h>

/* One version. */
struct compare_side {
	char *name;     /* for a person: "pump.rung, as saved"                   */
	char *path;     /* of the file, also if the text comes from elsewhere; NULL: none */
	char *text;     /* NULL: what the file holds                             */
	gsize len;
	GHashTable *files; /* text (GBytes) by name of each file that it names; NULL value: it
			      is not there. NULL: they are read from the disk. */
	char *map;      /* text of its I/O map; NULL: that beside the file, or with @files none */
};
/** compare_side_clear - frees its texts. */
void compare_side_clear(struct compare_side *side);
/** compare_side_copy - Owns: compare_side_clear(). */
struct compare_side compare_side_copy(const struct compare_side *side);
/** compare_side_wants - a file that the project names and @files does not have; NULL: none. Caller
 * frees. */
char *compare_side_wants(const struct compare_side *side);

enum compare_change { COMPARE_CHANGED, COMPARE_ADDED, COMPARE_REMOVED, COMPARE_MOVED };
/* How the place of a row is drawn: as text, rung, chart, network, lines, or the whole POU. */
enum compare_shows { COMPARE_SHOWS_TEXT, COMPARE_SHOWS_RUNG, COMPARE_SHOWS_CHART,
		     COMPARE_SHOWS_NETWORK, COMPARE_SHOWS_LINES, COMPARE_SHOWS_POU };

/* A property with its text in each version; "" : nothing. */
struct compare_detail { char *label, *from, *to; };

struct compare_row {
	char *group;                /* "PROGRAM Main", "Symbols"                */
	char *title;                /* "Rung 3 (Seal)"                          */
	char *words;                /* what changed, a line each; "": see change */
	enum compare_change change;
	enum compare_shows shows;
	GArray *details;            /* struct compare_detail                    */
	int pou_a, pou_b;           /* -1: none                                 */
	int at_a, at_b;             /* rung, shape of the chart, network, or first line, 0-based; -1 */
	int table, index;           /* of a declaration in the newer version, as in struct
				       xref_target; -1: none */
	bool map;                   /* of the I/O map                          */
};

struct comparison {
	struct compare_side a, b;   /* the older one, the newer one            */
	struct ladder *of_a, *of_b;
	bool read_a, read_b;        /* could they be read?                      */
	GPtrArray *rows;            /* struct compare_row                       */
	bool failed;                /* memory is out: rows are missing          */
};

/** comparison_new - takes over the texts of both sides. Owns: comparison_free(). */
struct comparison *comparison_new(struct compare_side *a, struct compare_side *b);
void comparison_free(struct comparison *comparison);
/** comparison_diags - why a side cannot be read, a line each. Caller frees. */
char *comparison_diags(struct ladder *side);
/** compare_change_text - "added", translated. Lives for ever. */
const char *compare_change_text(enum compare_change change);
/** compare_row_place - where a row is in the newer version, for win.go-to: POU, rung, row,
 * column. @project: the newer one. False: it is not there. */
bool compare_row_place(const struct compare_row *row, struct project *project, int place[4]);

#endif
