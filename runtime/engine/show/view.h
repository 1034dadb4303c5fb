/* SPDX-License-Identifier: MIT
 *
 * view - a project as text for people: drawings, differences, lists, words.
 *
 * Everything goes to a sink and nothing is changed. It judges nothing: a wrong
 * rung is drawn as it stands. What it prints of a user's text holds no control
 * characters but newlines.
 */
#ifndef VIEW_VIEW_H
#define VIEW_VIEW_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

struct view_show_options {
	bool ascii;   /* - | + instead of box characters                      */
	int width;    /* narrower rungs are stretched to it, in columns; 0: no */
	/* Power at the ends of a cell, 1-based as in resource_power(); where it has
	 * none, or does not tell, wires are drawn thin. NULL: nobody knows. */
	bool (*power)(void *context, int pou, int rung, int row, int col, bool *in,
		      bool *out);
	/* Is a step of a chart active, and for how long ("" if that is not told)? NULL:
	 * nobody knows. */
	bool (*step)(void *context, int pou, int step, char *time, size_t size);
	void *context;
	const char *instance; /* of a block whose rungs are drawn; or NULL    */
};

/**
 * view_show - draws rungs with box characters
 * @pou:     index in the project; -1: all POUs
 * @rung:    1-based number in its POU; 0: all
 * @options: NULL: Unicode, not stretched
 *
 * A POU in IL is printed as its list. Rungs wider than a terminal run wide.
 * Returns the rungs drawn (a POU in IL counts as one); 0: there is no such
 * rung; -1: memory is out.   Scan-safe: no.
 */
int view_show(const struct project *project, int pou, int rung,
	      const struct view_show_options *options, const struct sink *sink);

/**
 * view_diff - what differs from project @a to project @b, in words, a line each
 * @json: an array of objects instead
 *
 * `Main rung 3 (Seal) cell (2,1): NO Motor -> NC Motor`. Rungs are matched by
 * longest common subsequence, then by content, label and likeness.
 * Returns the number of differences; 0: their canonical text is the same;
 * -1: memory is out.   Scan-safe: no.
 */
int view_diff(const struct project *a, const struct project *b, bool json,
	      const struct sink *sink);

/**
 * view_diff_besides - the same without what is in rungs, lists and charts, in words
 * @pou: what is declared in this one alone, any case; NULL: everything
 *
 * For those who draw the rest. Returns the lines; -1: memory is out.   Scan-safe: no.
 */
int view_diff_besides(const struct project *a, const struct project *b, const char *pou,
		      const struct sink *sink);

/* A rung of project a and what it became in project b. 0-based; -1: there is none. */
struct view_pair {
	int pou_a, pou_b;
	int rung_a, rung_b; /* both -1: the POUs are lists, or only one of them is */
	bool moved;         /* it stands elsewhere                            */
	bool changed;       /* its text is another                            */
};

/**
 * view_diff_rungs - which rungs belong together, matched as view_diff does
 * @take: is handed every rung of either project once, by POUs, as one would read them
 *        beside each other; POUs in IL as a pair without rungs
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when memory is out.
 */
bool view_diff_rungs(const struct project *a, const struct project *b,
		     void (*take)(void *context, struct view_pair pair),
		     void *context);

/* A line of a list or a chart, without the blanks before it. */
struct view_line {
	int line_a, line_b; /* 1-based, counted from behind the declarations; 0: only the
			     * other project has it                          */
	int indent;         /* those blanks                                   */
	const char *text;   /* until @take returns                            */
};

/**
 * view_diff_lines - two lists or two charts line by line, matched as view_diff does
 * @pou_a, @pou_b: their indices; -1: the project has none
 * @take: is handed each line of either, as one would read them below each other
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when memory is out.
 */
bool view_diff_lines(const struct project *a, int pou_a, const struct project *b,
		     int pou_b,
		     void (*take)(void *context, struct view_line line), void *context);

/**
 * view_print_il - a whole POU as `PROGRAM Name IL … END_PROGRAM`
 * @pou:   of @project: its kind and name count
 * @vars:  its own variables
 * @temps: variables that translation added, @temp_count of them; those that @il
 *         does not use are left out
 * @il:    what to print; the text reads again to the same list
 *
 * Scan-safe: no.   Fails: false when memory is out; nothing was put out.
 */
bool view_print_il(const struct project *project, const struct pou *pou,
		   const struct var_table *vars, struct var *const *temps,
		   int temp_count, const struct il *il,
		   const struct sink *sink);

/**
 * view_print_pou - the canonical text of one POU, from PROGRAM to its END_PROGRAM
 * @pou: one of the project's, or a changed copy of one
 *
 * Owns: the caller, free(); NUL-ended.   Scan-safe: no.   Fails: NULL: no memory.
 */
char *view_print_pou(const struct project *project, const struct pou *pou);

/**
 * view_words - elements, boxes, instructions, types, areas and system names
 * @word: one of them, any case, with its details; NULL: all, a line each
 * @json: an array of objects; each has kind, word and doc, most have more
 *
 * Returns how many were listed; 0: there is no such word.   Scan-safe: no.
 */
int view_words(const char *word, bool json, const struct sink *sink);
/** view_words_markdown - the whole of docs/words.md. */
void view_words_markdown(const struct sink *sink);

#endif
