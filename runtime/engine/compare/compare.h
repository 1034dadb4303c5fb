/* SPDX-License-Identifier: MIT
 *
 * compare - what differs between two projects, in words or as pairs.
 *
 * Nothing is checked. Control characters in a user's text are not printed, except
 * newlines.
 */
#ifndef COMPARE_H
#define COMPARE_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

/**
 * compare_projects - prints the differences from project @a to project @b, a line each
 * @json: an array of objects instead
 *
 * `Main rung 3 (Seal) cell (2,1): NO Motor -> NC Motor`. Rungs are matched by longest
 * common subsequence, then by content, label and likeness.
 * Returns the number of differences; 0: their canonical text is the same; -1: no
 * memory. Scan-safe: no.
 */
int compare_projects(const struct project *a, const struct project *b, bool json,
		     const struct sink *sink);

/* The part of a project that a difference belongs to. */
enum compare_group {
	COMPARE_PROJECT, COMPARE_CONFIG, COMPARE_TYPES, COMPARE_GLOBALS, COMPARE_POU
};
/* One difference; members that are NULL or 0 do not apply. Texts in English are words of
 * compare.c: kind, property (also a pin), change. */
struct compare_difference {
	enum compare_group group;
	const char *pou, *label;   /* of TYPES, @pou is the structure          */
	int rung, row, col, line;  /* 1-based; in project a, of what was added in b */
	int at_a, at_b;            /* the rung in each project; the line of a list or chart */
	const char *kind;          /* "variable", "view section"              */
	const char *subject;       /* its name, or the element in a cell      */
	const char *property;      /* "address"                               */
	const char *from, *to;     /* either may be "": nothing               */
	const char *change;        /* "added", when there is no from and to   */
};

/**
 * compare_each - the same differences as data
 * @take: gets each, those of a rung one after another; its texts are valid until it returns
 *
 * Returns the number of differences; -1: no memory. Scan-safe: no.
 */
int compare_each(const struct project *a, const struct project *b,
		 void (*take)(void *context, const struct compare_difference *what),
		 void *context);

/**
 * compare_besides - the same without differences in rungs, lists and charts
 * @pou: only declarations of this POU, any case; NULL: everything
 *
 * For callers that draw the rest. Returns the lines; -1: no memory. Scan-safe: no.
 */
int compare_besides(const struct project *a, const struct project *b, const char *pou,
		    const struct sink *sink);

/* A rung of project a and its match in project b. 0-based; -1: there is none. */
struct compare_pair {
	int pou_a, pou_b;
	int rung_a, rung_b; /* both -1: the POUs are lists, or only one of them is */
	bool moved;         /* its position among the matched rungs changed   */
	bool changed;       /* its text differs                               */
};

/**
 * compare_rungs - pairs of rungs, matched as compare_projects does
 * @take: gets every rung of either project once, POU by POU, in the order of reading
 *        them side by side; a POU in IL is one pair without rungs
 *
 * Owns: nothing. Scan-safe: no. Fails: false: no memory.
 */
bool compare_rungs(const struct project *a, const struct project *b,
		   void (*take)(void *context, struct compare_pair pair),
		   void *context);

/* A line of a list or a chart, without the blanks before it. */
struct compare_line {
	int line_a, line_b; /* 1-based, counted from the end of the declarations; 0: only
			     * the other project has it */
	int indent;         /* those blanks                                   */
	const char *text;   /* until @take returns                            */
};

/**
 * compare_lines - two lists or two charts line by line, matched as compare_projects does
 * @pou_a, @pou_b: their indices; -1: the project has none
 * @take: gets each line of either, in the order of reading one merged text
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false: no memory.
 */
bool compare_lines(const struct project *a, int pou_a, const struct project *b,
		   int pou_b,
		   void (*take)(void *context, struct compare_line line), void *context);

#endif
