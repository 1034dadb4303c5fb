/* SPDX-License-Identifier: MIT
 *
 * scope - what an operand's text means inside a POU.
 *
 * Locals win over globals, declared names over SYS_ names and over short
 * addresses. One hash a project, so that 100,000 names cost no more than ten
 * each.
 */
#ifndef CHECK_SCOPE_H
#define CHECK_SCOPE_H

#include "engine/base/diag.h"
#include "engine/base/literal.h"
#include "engine/model/project.h"

enum meaning_kind {
	MEANING_NONE,
	MEANING_VARIABLE,  /* table, index                                    */
	MEANING_INSTANCE,  /* table, index: a whole instance                  */
	MEANING_STRUCT,    /* table, index, offset: a whole structure         */
	MEANING_PIN,       /* table, index, pin of its FB, offset; a member   */
	MEANING_ADDRESS,   /* addr; SYS_ names too                            */
	MEANING_LITERAL,   /* literal                                         */
};

struct meaning {
	enum meaning_kind kind;
	enum iec_type type;       /* of the value; IEC_NONE: untyped literal  */
	const struct pou *pou;    /* whose table; NULL: globals               */
	const struct var *var;    /* the variable or instance                 */
	int index;                /* in its table                             */
	enum word word;           /* of an INSTANCE or STRUCT                 */
	int pin;                  /* index in the row of the variable's word  */
	uint32_t offset;          /* of a part: bytes behind the variable's
				     first; 0 of a whole variable             */
	struct iec_addr addr;     /* of ADDRESS, and of a variable with AT    */
	struct literal literal;
	bool writable;            /* by a program                             */
	bool constant;            /* declared CONSTANT                        */
};

struct scope;

/** scope_new - the names of a project. Owns: @arena. NULL: no memory. */
struct scope *scope_new(struct project *project, struct arena *arena);

/**
 * scope_find - the meaning of an operand
 * @pou:  NULL: among globals only
 * @text: string id of the operand as written
 * @why:  when it has none: DIAG_UNKNOWN_NAME, DIAG_NO_PIN, DIAG_BAD_ADDRESS,
 *        DIAG_BAD_LITERAL or DIAG_LITERAL_RANGE
 *
 * Remembered by POU and id: asking again is one look into a hash.
 * Owns: the arena of scope_new().   Scan-safe: no.
 * Fails: NULL; @why is DIAG_NO_MEMORY when memory is out.
 */
const struct meaning *scope_find(struct scope *scope, const struct pou *pou,
				 uint32_t text, enum diag_id *why);
/** scope_duplicate - an earlier declaration of the same name in the same table,
 * or -1. */
int scope_duplicate(struct scope *scope, const struct pou *pou, int index);
/**
 * scope_add - declares a temporary that translation makes, after all others
 * @var:   lives as long as the scope; only its exact spelling is found
 * @index: behind the declared variables of the POU's table
 * Scan-safe: no.   Fails: false when memory is out.
 */
bool scope_add(struct scope *scope, const struct pou *pou,
	       const struct var *var, int index);
/** scope_size - bytes of what @meaning is. Scan-safe: no. */
uint32_t scope_size(const struct scope *scope, const struct meaning *meaning);
struct project *scope_project(const struct scope *scope);
/** scope_row - the row of a word, be it the project's own. */
const struct word_row *scope_row(const struct scope *scope, enum word word);
/** scope_text - the string of an id. */
const char *scope_text(const struct scope *scope, uint32_t id);
#endif
