/* SPDX-License-Identifier: MIT
 *
 * vars - declared variables, as IEC 61131-3 tables 16 to 18 have them.
 *
 * A table holds the globals of a project or the locals of a POU, in the order of
 * declaration. translate/ places variables in memory.
 */
#ifndef MODEL_VARS_H
#define MODEL_VARS_H

#include "engine/base/arena.h"
#include "engine/base/catalog.h"
#include "engine/base/names.h"

enum var_flag {
	VAR_RETAIN = 1, VAR_CONSTANT = 2, VAR_GLOBAL_WORD = 4,
	VAR_INPUT = 8, VAR_OUTPUT = 16, VAR_IN_OUT = 32, VAR_TEMP = 64,
	VAR_RESULT = 128,    /* the result of a function, from its heading; its ENO follows
			      * in the same block */
	VAR_EXTERNAL = 512,  /* names globals that the POU uses; a table of its own */
	VAR_NON_RETAIN = 1024, /* as without a word; kept for the file          */
	VAR_FIXED = 2048,    /* of VAR_INPUT CONSTANT: the POU does not write it */
	VAR_SFC = 256,       /* variables of a chart (model/sfc.h): programs can read them;
			      * they are not in the file */
	VAR_WIRE = 4096,     /* with VAR_SFC: wires of networks (model/fbd.h)   */
};

/* Part of an array's initial values: a value and its repetitions. */
struct var_init {
	uint32_t count;
	union iec_value value;
	uint32_t text;       /* string id: of a STRING, as written; 0: empty   */
};

enum written_place { WRITTEN_LOW, WRITTEN_HIGH, WRITTEN_CAPACITY, WRITTEN_INITIAL,
		     WRITTEN_LEAST, WRITTEN_MOST, WRITTEN_PLACES };

/* A declaration with constant expressions: Max : INT := Limit - 1. The numbers in struct var are
 * those that check/settle.c computes from it. */
struct var_written {
	uint32_t bound[2];   /* string ids: lowest and highest index, as written; 0: numbers */
	uint32_t capacity;   /* likewise, of a STRING                          */
	uint32_t range[2];   /* likewise, of a subrange                        */
	uint32_t (*dim)[2];  /* likewise, of an array of several dimensions; NULL: it has one */
	bool initial;        /* the initial value has expressions              */
	uint32_t value;      /* string id: the initial value with constants in place of them;
			      * 0: not computed                                */
	bool again;          /* of the same declaration as the variable before it */
	const char *file;
	struct { int line, column; } at[WRITTEN_PLACES];
	/* While they are computed: */
	uint8_t state;
	int table, index;    /* the variable: as in scope, behind the POUs the structures */
	struct var_written *below; /* needs the value of this one              */
	struct var_written *type;  /* of the named type that it has; NULL: none */
};

/* INT (0..100): the values that a variable may have. */
struct var_range {
	int64_t low, high;
};

/* How a pointer is declared. */
enum var_pointer { POINTER_TO, REF_TO, REFERENCE_TO };

/* POINTER TO T. The variable itself is an LWORD. */
struct var_target {
	enum var_pointer word;
	enum iec_type type;  /* of the value, or of an element                 */
	bool list;           /* T is an array, its first index is low          */
	int32_t low;
	struct var *like;    /* declared as T                               */
};

/* := REF(Name): the initial value of a pointer. */
struct var_points {
	int pou;             /* in which it is declared; -1: a global          */
	uint32_t text;       /* string id: &Name                               */
};

struct var {                 /* as small as it can be: a project has thousands */
	uint32_t name;       /* string id, as written                          */
	uint32_t fold;       /* names_fold of it                               */
	enum iec_type type : 8; /* of an array, of its elements; IEC_NONE for an
				instance or structure                  */
	uint8_t edge : 2;    /* of an input: 1 R_EDGE, 2 F_EDGE; 0: neither     */
	bool has_init : 1;
	bool wide : 1;       /* a STRING that is written WSTRING               */
	bool letter : 1;     /* that is written CHAR, or WCHAR                 */
	bool any_bounds : 1; /* ARRAY[*]: one element a dimension stands for all; check/generic.h */
	bool inherits : 1;   /* the initial value is that of its type, not in the file */
	uint8_t dims;        /* of its array; 0 or 1: array alone counts       */
	uint8_t own_dims;    /* so many are in the declaration, the others in its named type */
	enum word fb : 16;   /* the word of the block or structure             */
	uint16_t capacity;   /* of a STRING, in bytes; 0: of a temporary       */
	uint16_t named;      /* has the type project.named[named - 1]; 0: none.
				project_resolve() fills in type, word, bounds   */
	uint16_t enumeration; /* its values are project.enumeration[… - 1]; 0: none */
	struct iec_addr at;  /* area AREA_NONE: no AT                          */
	struct var_array array;
	uint32_t at_text;    /* string id: canonical address                   */
	uint32_t comment;    /* string id: trailing, with delimiters           */
	int init_count;      /* parts of init_list, of an array                */
	uint32_t init_text;  /* string id: as written (16#FF stays so); for arrays of
			      * structures, structures and instances the whole text:
			      * model/init.h */
	int line;
	union {
		union iec_value init;       /* of its type                    */
		struct var_init *init_list; /* of an array, from its first
					       element on                     */
	};
	struct var_written *written; /* NULL: no constant expressions           */
	struct var_array *dim; /* its dimensions; array has all elements, from 0 on if there are several */
	struct var_range *range; /* of a subrange; NULL: none                   */
	struct var_target *target; /* of a pointer; NULL: it is none            */
	struct var_points *points; /* its initial value; NULL: NULL, or none    */
};

/* One VAR … END_VAR; canonical files keep blocks separate. */
struct var_block {
	uint16_t flags;       /* enum var_flag                                  */
	uint32_t comment;    /* above it                                       */
	int first, count;    /* in the table                                   */
	int line;
	const char *file;    /* it stands in; borrowed from the arena; NULL: made, not read */
	bool included;       /* of a file named by INCLUDE                     */
};

struct var_table {
	struct var *var;
	int count;
	struct var_block *block;
	int block_count;
};

/** vars_block - the block that contains variable @index; NULL: there is none. */
const struct var_block *vars_block(const struct var_table *table, int index);
/** vars_flags - of the block that contains variable @index. */
uint16_t vars_flags(const struct var_table *table, int index);
/**
 * vars_argument - the variable that an argument of a call of a program goes to, or comes from
 * @fold: the name as written, folded; 0: none, the next input behind @last, at first -1
 *
 * -1: there is none. Scan-safe: yes.
 */
int vars_argument(const struct var_table *table, uint32_t fold, bool output, int *last);
/** vars_is_eno - whether it is the implicit ENO that a function's body may set.
 * Scan-safe: yes. */
bool vars_is_eno(const struct var_table *table, int index);
/** vars_declared - number of variables in the file, which come first; without those that
 * a chart adds. Scan-safe: yes. */
int vars_declared(const struct var_table *table);
/** vars_head - the first word of a block with these flags: VAR_INPUT. */
const char *vars_head(uint16_t flags);
/** var_is_nameless - AT %QW1 : WORD; its name is the address. Scan-safe: yes. */
static inline bool var_is_nameless(const struct var *var)
{
	return var->at_text && var->name == var->at_text;
}
/** var_value_text - string id of its initial value with constants in place of expressions;
 * not of a plain number. Scan-safe: yes. */
static inline uint32_t var_value_text(const struct var *var)
{
	return var->written && var->written->value ? var->written->value : var->init_text;
}
/** var_unit - bytes from one element to the next; without an array the size. Not of
 * an instance. */
uint32_t var_unit(const struct var *var);
/** var_bytes - its size in data memory, with all elements. */
uint32_t var_bytes(const struct var *var);
/** vars_shift - the address of element @element, 0-based, behind @at. */
struct iec_addr vars_shift(struct iec_addr at, uint32_t element);
/** var_lies_on - whether it, or one of its elements, has a bit of the address. */
bool var_lies_on(const struct var *var, struct iec_addr addr);
/** vars_flat - @dims dimensions as one: of one its own bounds, of several all elements from 0 on.
 * More than 2^32 - 1 elements count as so many. Scan-safe: yes. */
struct var_array vars_flat(const struct var_array *dim, int dims);
/** vars_same_bounds - of arrays whose flat bounds are the same: the same dimensions, each from and to the same
 * number? With dims 0 or 1 the flat bounds tell all. Scan-safe: yes. */
bool vars_same_bounds(const struct var_array *a, int a_dims, const struct var_array *b, int b_dims);
/** var_range_fits - whether the scan can compare with it: its lowest value needs 32 bits, and it
 * has at most 2^32 - 1 values. Scan-safe: yes. */
bool var_range_fits(const struct var_range *range);
/** var_element - index @index as the number of an element, 0-based; -1: there is
 * none. */
int64_t var_element(struct var_array array, int64_t index);
/** vars_find - index by folded name, -1: none. Linear in small tables; large
 * ones are looked up through struct scope (check/scope.h). */
int vars_find(const struct var_table *table, uint32_t fold);
/** vars_push - adds a variable at the end of a block; later variables get other numbers.
 * Scan-safe: no. Fails: false: no memory, nothing changed. */
bool vars_push(struct var_table *table, int block, const struct var *var,
	       struct arena *arena);
/** vars_pop - removes the last variable of a block, which has one. Scan-safe: no. */
void vars_pop(struct var_table *table, int block);
#endif
