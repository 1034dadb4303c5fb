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

/* A bit or word that another tool sets by itself, such as the first scan. */
struct dialect_special {
	const char *tool;     /* "GX Works"; lives for ever                      */
	const char *ours;     /* the word that has this meaning here, "SYS_FIRST_SCAN"; "": none */
};

/** dialect_special - whether @text is such a name, also if it is an address here, where it would be
 * an ordinary bit: M8000, SM400, %S0, SM0.6. Addresses that mean the same here are none: SM0.0.
 * Owns: nothing. Scan-safe: yes. */
bool dialect_special(const char *text, size_t len, struct dialect_special *out);

/** dialect_is_data_block - DB1.DBX0.0, DB20.DBW4: a place in a data block of a Siemens controller. Scan-safe: yes. */
bool dialect_is_data_block(const char *text, size_t len);

/** dialect_around - the word around a colon, such as S:FS or I:1/3, in @begin … @end; *@from: where it
 * begins. Returns its bytes. Owns: nothing. Scan-safe: yes. */
size_t dialect_around(const char *begin, const char *end, const char *colon, const char **from);

/**
 * dialect_find - the meaning of a name in another tool
 * @index: 0; and on for the other names that a step can have here
 *
 * Owns: nothing. Scan-safe: yes. Fails: false: no tool that is known has such a name, or no more
 * meanings.
 */
bool dialect_find(const char *text, size_t len, int index, struct dialect *out);
#endif
