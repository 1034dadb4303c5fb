/* SPDX-License-Identifier: MIT
 *
 * formula - the value of an expression over a process image, between scans.
 *
 * Scenarios check a program with it. Programs themselves run in the VM; this is a
 * separate evaluator. Kinds are wider than types: any integer or bit string is 64 bits,
 * TIME is ns; an expression with a REAL compares as a float.
 */
#ifndef TRIAL_FORMULA_H
#define TRIAL_FORMULA_H

#include "engine/base/arena.h"
#include "engine/model/expr.h"
#include "engine/model/project.h"
#include "engine/scan/image.h"

enum formula_kind {
	KIND_BOOL, KIND_INT, KIND_REAL, KIND_TIME, KIND_TOD, KIND_DATE, KIND_DT,
	KIND_TEXT,
};

struct formula_term {
	uint8_t op;            /* enum expr_op                               */
	uint8_t kind;          /* enum formula_kind of the value             */
	uint16_t fn;           /* enum word of EXPR_FN                       */
	bool wide;             /* KIND_INT: i holds an unsigned number       */
	bool single;           /* KIND_REAL: has the precision of a float    */
	bool plant;            /* of EXPR_NAME: a variable of the plant      */
	int16_t left, right;
	struct location at;    /* of EXPR_NAME; of EXPR_INDEX element 0       */
	struct location index; /* of EXPR_INDEX without left: index read here */
	int32_t low;           /* of EXPR_INDEX: bounds, bytes from one to    */
	uint32_t count, stride; /* the next                                   */
	const char *name;      /* of EXPR_NAME; in the arena                 */
	union iec_value value; /* of a literal; else of the last evaluation  */
};

/* They name values of enumerations; NULL: numbers only. */
struct formula_projects {
	const struct project *program, *plant;
};

struct formula {
	struct formula_term *term; /* children before parents                */
	int count, root;
	bool constant;             /* contains no variable                   */
	const struct image *plant; /* image for names with `plant.`; or NULL */
	struct formula_projects projects;
};

/**
 * formula_new - resolves names and checks kinds
 * @plant:      of the program's plant, whose names begin with `plant.`; or NULL
 * @projects:   a value that has another number in each of them needs `plant.` for that of the plant
 * @expr:       what expr_parse gave
 * @line_start: of the source line, for columns
 *
 * BOOL counts as 0 or 1 beside numbers; TIME meets only TIME, a text a text; times and
 * dates add and subtract as in a program.
 * Owns: @arena. Scan-safe: no. Fails: NULL and a diagnostic.
 */
struct formula *formula_new(const struct image *image, const struct image *plant,
			    struct formula_projects projects, const struct expr *expr,
			    struct arena *arena, const char *line_start,
			    struct diag_list *diags, struct diag place);

/**
 * formula_value - the value now
 * @out: r of KIND_REAL, s of KIND_TEXT (borrowed), else i
 *
 * Scan-safe: no. Fails: false on overflow or division by zero.
 */
bool formula_value(struct formula *formula, const struct image *image,
		   union iec_value *out);
enum formula_kind formula_kind(const struct formula *formula);
/** formula_can_set - whether its kind may be stored as @type; ranges are not checked. */
bool formula_can_set(const struct formula *formula, enum iec_type type);
/** formula_fit - its value as one of @type; false if it is out of range. */
bool formula_fit(const struct formula *formula, union iec_value value,
		 enum iec_type type, union iec_value *out);
#endif
