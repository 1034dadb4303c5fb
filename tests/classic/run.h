/* SPDX-License-Identifier: MIT
 *
 * run - scripts for the second evaluator, and traces as ClassicLadder's were recorded.
 */
#ifndef CLASSIC_RUN_H
#define CLASSIC_RUN_H

#include "engine/exchange/classic/classic.h"

#include <stdio.h>

struct loaded {
	struct arena arena;
	struct classic_report report;
	struct diag_list diags;
	struct classic_project *project;
};

/** load_project - a file or a folder; what is wrong goes to standard error. */
bool load_project(struct loaded *loaded, const char *path);
void unload_project(struct loaded *loaded);
/** load_text - a whole file; the caller's, free(). NULL: told. */
char *load_text(const char *path);
/**
 * run_script - each line of the script, and what is to be shown
 *
 * A line sets variables and is a scan: `%I0=1 %W3=-4`, `.`, `+N` it takes N ms, `xN` N of
 * them, `quiet` the last alone is shown. `@print %Q0..7 …`, `@echo …`, `@period N`,
 * `@reset`. With @changes only what changed is shown.
 */
bool run_script(const struct classic_project *project, bool faithful, bool changes,
		const char *script, FILE *out);
#endif
