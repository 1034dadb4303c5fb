/* SPDX-License-Identifier: MIT
 *
 * init - initial values of what has parts: `(Speed := 5, Times := [T#1s, 2(T#2s)])`.
 *
 * IEC 61131-3 writes them as a list in brackets for an array and in parentheses with
 * the names of members for a structure; n( … ) is one value n times. The text is kept as it
 * was written; here it is walked, constant by constant, with the place of each. What the
 * text does not name keeps the value that its own declaration gives it.
 */
#ifndef MODEL_INIT_H
#define MODEL_INIT_H

#include "engine/base/diag.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/project.h"

#define INIT_DEPTH (2 * LIMIT_NESTING + 2) /* lists and structures in one another */

/* A list or a structure that is open. */
struct init_level {
	const struct word_row *row; /* of a structure or block; NULL: a list   */
	struct word_pin item;       /* what an element of the list is          */
	uint32_t base, unit;        /* bytes behind the variable's first       */
	uint32_t element, count;    /* of a list: the next one; how many       */
	uint32_t times;             /* left of n( … ); 0: none is open         */
	int pin;                    /* of a structure: the member in work      */
	bool bare;                  /* members without a ( of their own: 2(a := 1) */
	struct lex again;           /* where the value of n( … ) begins        */
	uint32_t *given, room, turn; /* by pin: the turn that named it last    */
};

struct init_value {
	uint32_t offset;            /* bytes behind the variable's first      */
	enum iec_type type;
	uint32_t capacity;          /* of a STRING                            */
	struct literal literal;
	union iec_value value;      /* of its type; not of a STRING           */
};

struct init_walk {
	const struct project *project;
	struct arena *scratch;      /* NULL: the text was checked before      */
	struct lex lex;
	struct init_level level[INIT_DEPTH];
	int depth;
	bool begun;
	enum diag_id why;           /* DIAG_COUNT: nothing was wrong          */
	const char *arg;            /* what was; borrowed from the text       */
	size_t arg_len;
};

/** init_has_parts - is the value of @var a text to be walked here? Scan-safe: yes. */
bool init_has_parts(const struct var *var);
/**
 * init_begin - before the first constant of a variable's text
 * @scratch: the text is not known to be good: it is judged, and what is repeated is
 *           gone through once. NULL: it is, and each constant comes as often as it
 *           is meant
 *
 * Owns: nothing; @walk is about 5 KB, the caller's.   Scan-safe: no.
 */
void init_begin(struct init_walk *walk, const struct project *project,
		const struct var *var, struct arena *scratch);
/** init_next - the next constant. Scan-safe: no. Fails: false behind the last one, and
 * when something is wrong: then walk->why tells. */
bool init_next(struct init_walk *walk, struct init_value *out);
/** init_where - the place of what is in work behind the variable's name: `[3].Speed`;
 * as snprintf. Scan-safe: no. */
void init_where(const struct init_walk *walk, char *out, size_t size);
/** init_names_pin - does the text of an instance give @pin a value? Scan-safe: no. */
bool init_names_pin(const char *text, size_t len, const char *pin);
#endif
