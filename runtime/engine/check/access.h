/* SPDX-License-Identifier: MIT
 *
 * access - what the lines of VAR_ACCESS mean.
 *
 * A path begins with the name of the resource or of a program, or with neither:
 * Station.Main.Speed, Main.Speed, Speed, Station.%IX0.3, %IX0.3. A program is named as in the
 * file, or as the CONFIGURATION names its instance. In a program a path is that of a variable of it.
 */
#ifndef CHECK_ACCESS_H
#define CHECK_ACCESS_H

#include "engine/check/uses.h"

struct access_path {
	const struct pou *pou; /* the program whose variable it is; NULL: a global or address */
	uint32_t program, program_len; /* bytes of its name in the path; 0: none */
	uint32_t at;           /* byte where the operand begins               */
	bool instance;         /* it is named as its instance in the CONFIGURATION */
};

/** access_split - the parts of a path. Owns: nothing. Scan-safe: no. Fails: never; an unknown
 * name stays part of the operand. */
struct access_path access_split(struct project *project, const struct access *access);
/**
 * access_find - the variable that a line of VAR_ACCESS names
 * @why: when there is none: as scope_find()
 *
 * Owns: the arena of scope_new(). Scan-safe: no. Fails: NULL.
 */
const struct meaning *access_find(struct scope *scope, const struct access *access,
				  enum diag_id *why);
/**
 * check_access - names, paths, types and directions of all VAR_ACCESS
 * @uses: gets the variables, as read, and as written with READ_WRITE
 *
 * Owns: nothing. Scan-safe: no. Fails: false when it added an error.
 */
bool check_access(struct scope *scope, struct uses *uses, struct arena *scratch,
		  struct diag_list *diags);
#endif
