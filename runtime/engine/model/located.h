/* SPDX-License-Identifier: MIT
 *
 * located - VAR_CONFIG: addresses and initial values that a configuration gives the variables of
 * programs (IEC 61131-3, 2.7.1).
 */
#ifndef MODEL_LOCATED_H
#define MODEL_LOCATED_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

/* What the path of a line leads to. */
struct located {
	const struct config_entry *instance; /* NULL: the program has none     */
	int pou;
	int var;
	const char *text;    /* the path behind the program                    */
	bool part;           /* of the variable: `Delay.PT`, `Levels[3]`       */
};

/** located_resource - the entry of the configuration with which the RESOURCE of this name begins, 0 of the first one; -1: there
 * is none. @end: the entry behind its last one. Scan-safe: yes. */
int located_resource(const struct project *project, const char *text, size_t len, int *end);
/** located_find - the variable of @path, or the one that it is a part of. Scan-safe: no. Fails: false: there is none. */
bool located_find(struct project *project, const char *path, struct located *out);
/** located_is_whole - has the line the value of a structure, a block, an array or a text? check/ and the layout take it. Scan-safe: yes. */
bool located_is_whole(const struct var *line);
/** located_report - a message at a line of VAR_CONFIG; @has, @wants: "" or its other parts. False. */
bool located_report(struct project *project, const struct var *line, enum diag_id id, const char *has,
		    const char *wants, struct diag_list *diags);
/**
 * located_place - gives the variables of programs what the lines of VAR_CONFIG say
 *
 * The lines of an instance that has data of its own are compared with its program only. A line of a part is left to
 * check/ and to the layout. Types are
 * resolved, constants computed. Owns: the project's arena.   Scan-safe: no.
 * Fails: false after a diagnostic, or without memory.
 */
bool located_place(struct project *project, struct diag_list *diags);
/** located_further - the same for @pou, a further instance with its name, whose variables are copied
 * for it. Scan-safe: no.   Fails: false: no memory. */
bool located_further(struct project *project, struct pou *pou);
#endif
