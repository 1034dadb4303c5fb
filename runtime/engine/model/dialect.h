/* SPDX-License-Identifier: MIT
 *
 * dialect - addresses, timers, counters and steps in the spelling of other tools.
 *
 * One rule for what a person types in the editor and for messages about a file. It knows no
 * project. What iec_addr_parse() takes is an address here and not foreign: ask that first. A
 * declared name has priority over both.
 */
#ifndef MODEL_DIALECT_H
#define MODEL_DIALECT_H

#include "engine/base/iec.h"

enum dialect_kind {
	DIALECT_ADDRESS, /* E0.0, X5, I:1/3, %B3, %W5: `addr` is the same here  */
	DIALECT_UNSURE,  /* X10: `addr` if it is octal, `other` if hexadecimal  */
	DIALECT_WORD,    /* D0: a variable of this name, at `addr`, of `type`   */
	DIALECT_BLOCK,   /* T37, C0: an instance of `word`, whose contact is `pin` */
	DIALECT_PIN,     /* %TM0.Q, T37.ET: `pin` of the instance `name` of `word` */
	DIALECT_STEP,    /* %X3.A: `pin` of the step, or ("") the BOOL, `name`  */
};

struct dialect {
	enum dialect_kind kind;
	struct iec_addr addr, other;
	enum iec_type type;
	const char *word, *pin; /* live for ever                              */
	char name[24];          /* "TM0"; an import of ClassicLadder adds _ and the symbol */
};

/**
 * dialect_find - the meaning of a name in another tool
 * @index: 0; and on for the other names that a step can have here
 *
 * Owns: nothing. Scan-safe: yes. Fails: false: no tool that is known has such a name, or no more
 * meanings.
 */
bool dialect_find(const char *text, size_t len, int index, struct dialect *out);
#endif
