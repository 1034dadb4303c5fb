/* SPDX-License-Identifier: MIT
 *
 * translate - from a checked project to a code image.
 *
 * LD becomes IL (ld_to_il), IL becomes instructions (assemble). LD is translated twice: the
 * list that runs and is shown, and one that also stores the power of every cell. It
 * requires that check/ found no error.
 */
#ifndef TRANSLATE_TRANSLATE_H
#define TRANSLATE_TRANSLATE_H

#include "engine/check/scope.h"
#include "engine/scan/code.h"

/* Power at a cell: names of the variables that hold it; 0: the left rail. */
struct power_note {
	uint32_t rung;      /* 1-based                                        */
	uint16_t row, col;  /* 1-based                                        */
	uint32_t in, out;   /* string ids                                     */
};

struct expr;
struct temps;

/* A POU with its lists. */
struct unit {
	const struct pou *pou;
	struct il il;           /* the list that runs                         */
	struct il watch;        /* the list that runs while watched; LD only  */
	enum iec_type *types, *watch_types; /* a line, from check_il          */
	struct var **temp;      /* temporaries, in order of their first use   */
	int temp_count;
	struct temps *temps;    /* names in use; of LD                        */
	struct power_note *power;
	int power_count;
};

struct translation {
	struct project *project;
	struct scope *scope;
	struct arena *arena;    /* lives as long as the result                */
	struct diag_list *diags;
	struct unit *unit;      /* one a POU                                  */
	int unit_count;
	bool listing;           /* while watched, lists of ladders and charts keep results, too */
	struct expr *expr;      /* 50 KB that one POU after another uses; NULL: none did yet */
	struct diag_list *ignored;
};

/**
 * ld_to_il - the instruction list of a ladder POU
 * @skip:    a byte a rung; rungs with 1 are left out (they have errors)
 * @watch:   the instrumented list; call it without first
 * @scratch: emptied and used
 *
 * Adds to unit->il or unit->watch, unit->temp and unit->power.
 * Owns: translation->arena.   Scan-safe: no.   Fails: false when memory is out.
 */
bool ld_to_il(struct translation *translation, struct unit *unit,
	      const uint8_t *skip, bool watch, struct arena *scratch);

/** sfc_to_il - the same of a chart. */
bool sfc_to_il(struct translation *translation, struct unit *unit,
	       const uint8_t *skip, bool watch, struct arena *scratch);

/** st_to_il - the same of Structured Text: the list that runs. Reports parts of statements of a
 * wrong type. */
bool st_to_il(struct translation *translation, struct unit *unit, struct arena *scratch);

/** config_blocks - copies that VAR_CONFIG wants around the list of a program: variables within blocks, and their addresses.
 * Fails: false: no memory. */
bool config_blocks(struct translation *translation, struct unit *unit, struct il *il);
/** il_to_il - the list that runs, of one that was written. */
bool il_to_il(struct translation *translation, struct unit *unit, struct arena *scratch);

/**
 * assemble - the code image of all units
 * @watch: with the instrumented section
 * @len:   gets its bytes; the image is aligned to 8
 *
 * Owns: translation->arena.   Scan-safe: no.
 * Fails: NULL after a diagnostic (limits, memory).
 */
void *assemble(struct translation *translation, bool watch, size_t *len);

/** is_temporary - is this a name made by translation: _T1 _N1 _E1 _P1? */
bool is_temporary(const char *name, char letter);
#endif
