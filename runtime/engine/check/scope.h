/* SPDX-License-Identifier: MIT
 *
 * scope - what an operand's text means inside a POU.
 *
 * Locals win over globals, declared names over SYS_ names and short addresses. One hash
 * serves the project, so a lookup among 100,000 names costs the same as among ten.
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
	MEANING_ARRAY,     /* table, index, offset, stride: a whole array     */
	MEANING_ELEMENT,   /* table, index, offset; var NULL: behind an address; a part of a number */
	MEANING_ADDRESS,   /* addr; SYS_ names too                            */
	MEANING_LITERAL,   /* literal                                         */
};

/* An index that is computed in the scan: bounds, bytes from one element to the next, and its
 * operand. */
struct open_index {
	struct var_array array;
	uint32_t stride;
	const struct meaning *of;
};

struct meaning {
	/* One for each operand of a project, so it is small. */
	enum meaning_kind kind : 8;
	enum iec_type type : 8;   /* of the value; IEC_NONE: untyped literal  */
	bool writable;            /* by a program                             */
	bool constant;            /* declared CONSTANT                        */
	int index;                /* in its table                             */
	const struct pou *pou;    /* whose table; NULL: globals               */
	const struct var *var;    /* the variable or instance                 */
	union {
		int pin;          /* index in the row of the variable's word  */
		uint32_t stride;  /* of ARRAY: bytes from one to the next     */
		const struct meaning *number; /* of a part: of which it is one */
	};
	uint16_t word;            /* enum word of INSTANCE, STRUCT, an ARRAY of such */
	union {
		uint16_t capacity; /* of an ARRAY of STRING                   */
		uint16_t action;  /* of an INSTANCE that a path of an action names: number of
				     the POU + 1; 0: none                     */
	};
	struct iec_addr addr;     /* of ADDRESS, and of a variable with AT; of
				     an element with a fixed index its own    */
	uint32_t offset;          /* of a part or element: bytes behind the
				     variable's first; 0 of a whole variable  */
	struct var_array array;   /* of ARRAY                                 */
	uint8_t opens;            /* indices computed in the scan; addr and offset are those
	                             of the first elements */
	bool through;             /* a pointer leads to it: meaning_pointer()  */
	bool several;             /* of a LITERAL: a value of several enumerations with other numbers;
				     values_in_list() finds which is meant */
	bool within;              /* a variable inside of a block, from outside */
	bool part;                /* a bit, byte or word of a number that has no address of its own */
	uint8_t first;            /* of a part: its lowest bit                 */
	uint32_t address_of;      /* string id: what ADR names, a PIN of type LWORD; 0: none */
	const struct open_index *open; /* so many, from the left; then the pointer */
	const struct meaning *index_of; /* operand of the first computed index; of a fixed
	                                   one the named constant, or NULL */
	union {
		struct literal literal; /* of LITERAL                             */
		struct {             /* of all others:                            */
			const struct var *like;      /* declares it: the variable or the member;
			                                NULL: the catalogue, an address */
			const struct var_array *dim; /* of ARRAY: its dimensions, if there
			                                are several                     */
			uint8_t dims;
		};
	};
};

struct scope;
struct expr;
struct expr_node;

/** scope_new - the names of a project. Owns: @arena. NULL: no memory. */
struct scope *scope_new(struct project *project, struct arena *arena);

/**
 * scope_find - the meaning of an operand
 * @pou:  NULL: among globals only
 * @text: string id of the operand as written
 * @why:  when it has none: DIAG_UNKNOWN_NAME, DIAG_NO_PIN, DIAG_BAD_ADDRESS,
 *        DIAG_BAD_LITERAL, DIAG_LITERAL_RANGE, DIAG_NOT_ARRAY,
 *        DIAG_INDEX_TYPE, DIAG_INDEX_RANGE or DIAG_NO_SUCH_PART
 *
 * Remembered by POU and id: asking again is one look into a hash.
 * Owns: the arena of scope_new().   Scan-safe: no.
 * Fails: NULL; @why is DIAG_NO_MEMORY when memory is out.
 */
const struct meaning *scope_find(struct scope *scope, const struct pou *pou,
				 uint32_t text, enum diag_id *why);
/** scope_network - wires of this network of @pou, from 0, are names for scope_find() from now on; -1: none are.
 * Scan-safe: no. */
void scope_network(struct scope *scope, const struct pou *pou, int network);
/**
 * scope_index - the meaning of one index in an operand's text
 * @at: where in the text to look; is moved behind it
 *
 * Scan-safe: no. Fails: NULL behind the last one, and for one that has none.
 */
const struct meaning *scope_index(struct scope *scope, const struct pou *pou,
				  uint32_t text, size_t *at);
/** scope_first - the text of an array's first element with a path behind it: of
 * "Recipes" and ".Speed" that of "Recipes[1].Speed". Scan-safe: no. Fails: 0 if
 * it is no array, or too long. */
uint32_t scope_first(struct scope *scope, const struct pou *pou, uint32_t array,
		     const char *tail, size_t len);
/** scope_first_of - the same of a path with indices that are expressions, an EXPR_NAME or EXPR_INDEX with
 * LIMIT_INDICES at most: that of its first element. Scan-safe: no. Fails: 0. */
uint32_t scope_first_of(struct scope *scope, const struct pou *pou, const struct expr *expr,
			const struct expr_node *node);
/** meaning_is_indexed - behind an index that is computed in the scan, or a pointer, or a part of
 * a number: it has no place of its own to read or write. Scan-safe: yes. */
static inline bool meaning_is_indexed(const struct meaning *meaning)
{
	return meaning->opens > 0 || meaning->through || meaning->part;
}
/** meaning_pointer - the pointer that leads to it. Scan-safe: yes. */
static inline const struct meaning *meaning_pointer(const struct meaning *meaning)
{
	return meaning->open[meaning->opens].of;
}
/** meaning_is_ranged - a value of a subrange? Scan-safe: yes. */
static inline bool meaning_is_ranged(const struct meaning *meaning)
{
	return meaning->kind != MEANING_LITERAL && meaning->like && meaning->like->range &&
	       meaning->type != IEC_NONE && meaning->kind != MEANING_ARRAY;
}
/** meaning_is_checked - does the scan find out whether it may be stored to? Scan-safe: yes. */
static inline bool meaning_is_checked(const struct meaning *meaning)
{
	return meaning_is_indexed(meaning) || meaning_is_ranged(meaning);
}
/** meaning_is_whole - a structure, instance or array as a whole? Scan-safe: yes. */
static inline bool meaning_is_whole(const struct meaning *meaning)
{
	return meaning->kind == MEANING_STRUCT || meaning->kind == MEANING_INSTANCE ||
	       meaning->kind == MEANING_ARRAY;
}
/** meaning_reach - the elements of an address that @meaning may be, as an array; count 0:
 * exactly one. Scan-safe: yes. */
struct var_array meaning_reach(const struct meaning *meaning);
/** meaning_fault - the reason why @meaning is no value: DIAG_INSTANCE_AS_VALUE or
 * DIAG_ARRAY_AS_VALUE; DIAG_COUNT: it is a value. Scan-safe: yes. */
enum diag_id meaning_fault(const struct meaning *meaning);
/** meaning_same - do both name one variable or one bit? FALSE with an index that is computed in
 * the scan. Scan-safe: yes. */
bool meaning_same(const struct meaning *a, const struct meaning *b);
/** scope_is_condition - TRANSITION of a chart? Scan-safe: yes. */
bool scope_is_condition(const struct meaning *meaning);
/** scope_pou - the POU of this name, unless a variable of @pou has it too; NULL: none.
 * @text: string id. Scan-safe: no. */
const struct pou *scope_pou(struct scope *scope, const struct pou *pou, uint32_t text);
/** scope_value - the value of an enumeration that `Red`, `Color#Red` or `Color.Red` is, by its
 * number in the project; -1: none, or several. A variable of the same name has priority: that is not
 * looked at. @head: gets the bytes in front of the value, with the sign: of `Color#`. Scan-safe: no. */
int scope_value(const struct scope *scope, const char *text, size_t len, size_t *head);
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
/** scope_size - bytes of @meaning. Scan-safe: no. */
uint32_t scope_size(const struct scope *scope, const struct meaning *meaning);
/** scope_span - bytes from its offset to the end of the last element that an index may reach.
 * Scan-safe: no. */
uint32_t scope_span(const struct scope *scope, const struct meaning *meaning);
/* Before the path of a variable within a block, which translation may read and write: `~A.Level`. */
#define SCOPE_WITHIN '~'
/** scope_within - the string id of a path with that sign; 0: no memory. Scan-safe: no. */
uint32_t scope_within(struct scope *scope, const char *path);
/** scope_has_several - is there a name that is a value of several enumerations, with other numbers? Scan-safe: yes. */
bool scope_has_several(const struct scope *scope);
struct project *scope_project(const struct scope *scope);
/** scope_areas - the areas of the project when the scope was made. Lives as long as the
 * scope. */
const struct areas *scope_areas(const struct scope *scope);
/** scope_row - the row of a word of the catalogue or the project. */
const struct word_row *scope_row(const struct scope *scope, enum word word);
/** scope_bytes - what SIZEOF gives: of a STRING its bytes and one more, of a pointer 4. Scan-safe: yes. */
uint32_t scope_bytes(const struct scope *scope, const struct meaning *m);
/** scope_type_bytes - what SIZEOF gives of the type with this name; 0: there is none. Scan-safe: no. */
uint32_t scope_type_bytes(struct scope *scope, const char *text, size_t len);
/** scope_said - scope_text() as it is written: REF(Name) for the place of a variable. Scan-safe: no. */
const char *scope_said(struct scope *scope, uint32_t id);
/** scope_tell - the arguments of a message about a name without a meaning, as named_tell(); of
 * DIAG_NO_SUCH_PART the part and the type of what should have it. Scan-safe: no. */
void scope_tell(struct scope *scope, const struct pou *pou, enum diag_id why, uint32_t text,
		char *out, size_t size);
/** scope_text - the string of an id. */
const char *scope_text(const struct scope *scope, uint32_t id);
#endif
