/* SPDX-License-Identifier: MIT
 *
 * diff - what the parts of the comparison of two projects share.
 *
 * Private to compare/: diff.c compares projects, POUs and variables,
 * diff_rung.c rungs, diff_match.c finds what belongs together, diff_say.c puts
 * it into words, diff_pairs.c hands out rungs without words.
 */
#ifndef COMPARE_DIFF_H
#define COMPARE_DIFF_H

#include "engine/base/limits.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/compare/compare.h"

#define DIFF_LIMIT 1500      /* insertions and deletions looked for at most   */
#define DIFF_CANDIDATES 64   /* rungs of a gap looked at for likeness         */

struct diff {
	const struct project *a, *b;
	const struct sink *sink;
	bool json;
	bool failed;               /* memory is out                           */
	bool besides;              /* rungs and lines are counted and not said */
	const char *pou;           /* and what is not in this; NULL: all is said */
	int count;                 /* differences so far                      */
	int said;                  /* and of them                             */
	struct arena arena;        /* scratch                                 */
	struct names names;        /* strings of both projects, by one id     */
	struct sink_memory bytes;  /* scratch: a rung or line made comparable */
	char from[1024], to[1024]; /* scratch: texts of two cells or lines    */
	char subject[2 * LIMIT_NAME], pin[LIMIT_NAME + 1]; /* scratch: names  */
	/* Takes the rungs instead of words; NULL: words. */
	void (*take)(void *context, struct compare_pair pair);
	void (*take_line)(void *context, struct compare_line line); /* likewise     */
	void *context;
	struct compare_pair pair;     /* for take: its POUs                       */
};

/* One difference; what is NULL or 0 is not said. */
struct difference {
	const char *pou, *label;
	int rung, row, col, line;  /* 1-based                                 */
	const char *kind;          /* "variable", "view section"              */
	const char *subject;       /* its name, or the element in a cell      */
	const char *property;      /* "address"                               */
	const char *from, *to;     /* either may be "": nothing               */
	const char *change;        /* "added", when there is no from and to   */
};

/** diff_say - puts it out and counts it. */
void diff_say(struct diff *diff, struct difference what);
/** diff_texts - says @what when the texts differ; they become from and to. */
void diff_texts(struct diff *diff, struct difference what, const char *property,
		const char *from, const char *to);

/** diff_config - tasks, programs and areas of the configurations. */
void diff_config(struct diff *diff);

/**
 * diff_match - the longest common subsequence
 * @match: of each of the @a_count: its index in @b, or -1
 *
 * Beyond DIFF_LIMIT changes only what stands at the same index is matched.
 * Fails: false when memory is out.
 */
bool diff_match(struct arena *arena, const uint32_t *a, int a_count,
		const uint32_t *b, int b_count, int *match);

/** diff_id - one id for the same bytes; 0 and diff->failed: memory is out. */
uint32_t diff_id(struct diff *diff, const char *text, size_t len);
/** diff_name - one id for all spellings of a name in either project. */
uint32_t diff_name(struct diff *diff, const char *name);


/** diff_open - ready to compare. Owns: the caller, diff_close(). NULL: no memory. */
struct diff *diff_open(const struct project *a, const struct project *b,
		       const struct sink *sink);
/** diff_close - false: memory was out, and something is missing. */
bool diff_close(struct diff *diff);

void diff_rungs(struct diff *diff, const struct pou *a, const struct pou *b);
/** diff_il - lists and charts; with take_line one may be NULL. */
void diff_il(struct diff *diff, const struct pou *a, const struct pou *b);

#endif
