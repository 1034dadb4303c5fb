/* SPDX-License-Identifier: MIT
 *
 * diag - what is wrong with a program text, as data with a place.
 *
 * Readers and checkers add to a list and go on; programs print the list. The
 * library itself prints nothing. Faults during a scan are not diagnostics.
 */
#ifndef BASE_DIAG_H
#define BASE_DIAG_H

#include "engine/base/limits.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define DIAG_AND "\037" /* between the parts of an argument                     */
#define DIAG_PARTS 4    /* at most                                             */

enum diag_severity { SEVERITY_WARNING, SEVERITY_ERROR };

enum diag_id {
#define DIAG(id, code, severity, text) DIAG_##id,
#include "engine/diag.def"
	DIAG_COUNT
};

struct diag {
	enum diag_id id;     /* row of diag.def: code, severity, text          */
	const char *file;    /* as the user wrote it; borrowed, outlives list  */
	int line;            /* 1-based; 0: the whole file                     */
	const char *pou;     /* name, or NULL; borrowed from the project       */
	int rung, row, col;  /* 1-based, as the editor numbers; 0: the whole   */
	int column;          /* 1-based byte in the line, for text; 0: none    */
	char arg[LIMIT_PARTS]; /* names and values for its text, clipped         */
};

struct diag_list {
	struct diag diag[LIMIT_DIAGS];
	int count;           /* kept, at most LIMIT_DIAGS                      */
	int dropped;         /* not kept, as the list is full; errors replace warnings */
	int errors;          /* errors among all of them, dropped ones too     */
};

/** diag_init - an empty list. Scan-safe: yes. */
void diag_init(struct diag_list *list);

/**
 * diag_add - one more diagnostic
 * @place: id and place; its arg is ignored
 * @arg:   printf format of the parts that go into the text, DIAG_AND between them;
 *         "" for none. Clipped at a whole UTF-8 character; control characters
 *         are shown as `?`.
 *
 * Returns false, so that `return diag_add(…)` reads well; true for a warning.
 * Owns: nothing.   Scan-safe: no.   Fails: never; a full list counts.
 */
bool diag_add(struct diag_list *list, struct diag place, const char *arg, ...)
	__attribute__((format(printf, 3, 4)));

/** diag_name_length - bytes of the first part of @diag's argument, which is usually the
 * name as it is written in the program. */
int diag_name_length(const struct diag *diag);

/** diag_code - "LD203" of an id. Lives for ever. */
const char *diag_code(enum diag_id id);
enum diag_severity diag_severity(enum diag_id id);
/** diag_text - the row's text, with the places of its parts. Lives for ever. */
const char *diag_text(enum diag_id id);

/**
 * diag_fill - a text of diag.def, or its translation, with the parts of @arg
 * @text: %1 is the first part, %2 the second; {…} is left out if one of its parts
 *        is empty. Parts without a place follow the text, each after a colon.
 *
 * Returns the length it needs, like snprintf.   Scan-safe: no.
 */
int diag_fill(const char *text, const char *arg, char *out, size_t size);

/**
 * diag_print - one diagnostic as a line, without a newline
 *
 * `pump.rung:14: rung 3 (2,5): error LD203: "%QX0.1" must be last on its branch`
 * Returns the length it needs, like snprintf.   Scan-safe: no.
 */
int diag_print(const struct diag *diag, char *out, size_t size);

#endif
