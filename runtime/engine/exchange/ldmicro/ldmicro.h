/* SPDX-License-Identifier: MIT
 *
 * ldmicro - a program of LDmicro as it stands in its file.
 *
 * A rung is a tree of series and parallel circuits whose leaves are elements. ldmicro_text.c
 * makes the text of a rung file of it; docs/from-ldmicro.md says what the elements do. Everything
 * lives in one arena.
 */
#ifndef LDMICRO_H
#define LDMICRO_H

#include "engine/exchange/import.h"

/* The words of elements, and how many values follow at least. The file has them as they are
 * spelled here, but those in quotes. */
#define LDMICRO_WORDS(WORD, OTHER) \
	WORD(CONTACTS, 2) WORD(COIL, 4) WORD(SHORT, 0) WORD(OPEN, 0) WORD(PLACEHOLDER, 0) \
	WORD(COMMENT, 0) WORD(MASTER_RELAY, 0) \
	WORD(TON, 2) WORD(TOF, 2) WORD(RTO, 2) WORD(RTL, 2) WORD(TCY, 2) WORD(THI, 2) WORD(TLO, 2) \
	WORD(CTU, 2) WORD(CTD, 2) WORD(CTC, 2) WORD(CTR, 2) WORD(RES, 1) WORD(TIME2COUNT, 2) \
	WORD(OSR, 0) WORD(OSF, 0) WORD(ODR, 0) WORD(ODF, 0) WORD(OSC, 0) OTHER(OSL, "OSL", 0) \
	WORD(EQU, 2) WORD(NEQ, 2) WORD(GRT, 2) WORD(GEQ, 2) WORD(LES, 2) WORD(LEQ, 2) \
	WORD(IF_BIT_SET, 2) WORD(IF_BIT_CLEAR, 2) WORD(SET_BIT, 2) WORD(CLEAR_BIT, 2) \
	WORD(MOVE, 2) WORD(ADD, 3) WORD(SUB, 3) WORD(MUL, 3) WORD(DIV, 3) WORD(MOD, 3) WORD(NEG, 2) \
	WORD(AND, 3) WORD(OR, 3) WORD(XOR, 3) WORD(NOT, 2) WORD(SHL, 3) WORD(SHR, 3) WORD(SR0, 3) \
	WORD(ROL, 3) WORD(ROR, 3) WORD(SWAP, 2) \
	WORD(SHIFT_REGISTER, 2) WORD(LOOK_UP_TABLE, 4) WORD(PIECEWISE_LINEAR, 3) \
	WORD(READ_ADC, 1) WORD(SET_PWM, 2) WORD(PERSIST, 1) \
	WORD(GOTO, 1) WORD(GOSUB, 1) WORD(RETURN, 0) WORD(LABEL, 1) WORD(SUBPROG, 1) WORD(ENDSUB, 1) \
	WORD(UART_SEND, 1) WORD(UART_RECV, 1) WORD(UART_SEND_READY, 0) WORD(UART_SEND_BUSY, 0) \
	WORD(UART_UDRE, 0) WORD(UART_RECV_AVAIL, 0) WORD(FORMATTED_STRING, 1)

enum ldmicro_word {
#define WORD(id, least) LDM_##id,
#define OTHER(id, text, least) LDM_##id,
	LDMICRO_WORDS(WORD, OTHER)
#undef WORD
#undef OTHER
	LDM_SERIES, LDM_PARALLEL,
	LDM_POWER,               /* not in files: a contact of a helper            */
	LDM_UNKNOWN              /* stays as a box that does nothing               */
};

enum { LDMICRO_DEPTH = 64, LDMICRO_BYTES = 16 << 20, LDMICRO_STAGES = 256 };

struct ldmicro_piece;

struct ldmicro_node {
	enum ldmicro_word word;
	int line;
	const char *text;        /* the whole line, or the name of a helper        */
	char **arg;
	int args;
	struct ldmicro_piece *piece; /* what it becomes; NULL: not yet             */
	struct ldmicro_node *first, *next; /* what is in a circuit                  */
};

struct ldmicro_io { const char *name; int pin, line; };
struct ldmicro_size { const char *name; int bytes, line; };
struct ldmicro_rung { int line; struct ldmicro_node *first; };

struct ldmicro_program {
	bool old;                /* LDmicro0.1: timers are one cycle shorter       */
	int cycle_us, cycle_line; /* 0: none                                        */
	const char *micro;       /* ""                                             */
	struct ldmicro_io *io;     int ios;
	struct ldmicro_size *size; int sizes;
	struct ldmicro_rung *rung; int rungs;
	int elements;            /* of all rungs, comments among them              */
	struct ldmicro_io *setting; int settings; /* name: a line that means nothing here */
};

/** ldmicro_is - does a program of LDmicro begin so? */
bool ldmicro_is(const void *bytes, size_t len);
/** ldmicro_read - the program. Fails: NULL after a diagnostic. */
struct ldmicro_program *ldmicro_read(struct import *import);
/** ldmicro_to_rung - its text, into import->text. Fails: false: no memory. */
bool ldmicro_to_rung(struct import *import, struct ldmicro_program *program);

/** ldmicro_number - `10`, `-5`, `0xFF`, `0o17`, `0b101`, `'a'`. false: it is a name. */
bool ldmicro_number(const char *text, long long *value);
/** ldmicro_int - the same, within an int; 0 for a name. */
int ldmicro_int(const char *text);
#endif
