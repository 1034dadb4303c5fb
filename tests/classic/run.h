/* SPDX-License-Identifier: MIT
 *
 * run - runs scripts with the second evaluator and prints traces.
 */
#ifndef CLASSIC_RUN_H
#define CLASSIC_RUN_H

#include "engine/exchange/classic/classic.h"

#include <stdio.h>

struct loaded {
	struct arena arena;
	struct classic_project *project;
};

/** load_project - reads a file or a folder. false: errors are on standard error. */
bool load_project(struct loaded *loaded, const char *path);
void unload_project(struct loaded *loaded);
/** load_text - the text of a file; free it with free(). NULL: the error is on standard
 * error. */
char *load_text(const char *path);
/**
 * run_script - runs a script and prints the trace
 *
 * A line sets variables and runs a scan: `%I0=1 %W3=-4`; `.` sets nothing; `+N`: the scan is N
 * ms long; `xN`: N scans; `quiet`: only the last one is printed. Also `@print %Q0..7 …`,
 * `@echo …`, `@period N`. @changes: prints only variables that changed.
 */
bool run_script(const struct classic_project *project, bool faithful, bool changes,
		const char *script, FILE *out);
#endif
