/* SPDX-License-Identifier: MIT
 *
 * st_walk - a second, independent evaluator of Structured Text.
 *
 * It walks the statements of a project as docs/st.md, docs/declarations.md and
 * docs/language.md define them, with its own parser of expressions, its own variables and
 * control flow. It shares the arithmetic and the blocks of tests/walker. Only projects that
 * ladder_build() accepts may be walked.
 */
#ifndef ST_ST_WALK_H
#define ST_ST_WALK_H

#include "engine/model/project.h"
#include "tests/walker/walker.h"

struct st_world;

/** st_world_new - all variables at their initial values
 * Owns: the caller, st_world_free(). Fails: NULL; @why gets a text. */
struct st_world *st_world_new(struct project *project, const char **why);
void st_world_free(struct st_world *world);
/** st_world_scan - one scan; false: it took more steps than allowed. */
bool st_world_scan(struct st_world *world, int64_t now_ns);
/** st_world_errors - number of operations that failed. */
uint32_t st_world_errors(const struct st_world *world);

/* Values to compare: "Total", "Main.i", "Table[1][3]", "Wait.Q". */
int st_world_count(const struct st_world *world);
const char *st_world_name(const struct st_world *world, int index);
struct value *st_world_value(struct st_world *world, int index);
/** st_world_is_settled - false for the input of a block that was never called. */
bool st_world_is_settled(const struct st_world *world, int index);
#endif
