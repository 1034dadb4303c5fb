/* SPDX-License-Identifier: MIT
 *
 * classic_functions - the functions that an imported file brings along, because IEC
 * 61131-3 says something else: division by zero gives 0 and is remembered (%S7), bits of
 * numbers, shifts that keep the bit they push out (%S8).
 */
#include "engine/exchange/classic/classic_convert.h"

#include <string.h>

/* @ stands for the name of the function. */
struct body { const char *title, *rungs, *faithful; };

#define BITS(op) \
	"RUNG\n  | [ @ := DWORD_TO_DINT(DINT_TO_DWORD(A) " op " DINT_TO_DWORD(B)) ] |\n"
#define LEFT_OUT  "RUNG\n  | BIT_TEST IN:=Bits N:=Left | COIL %%SX1.0 |\n"
#define RIGHT_OUT "RUNG\n  | BIT_TEST IN:=Bits N:=Right | COIL %%SX1.0 |\n"
#define MOVED(op) "RUNG\n  | [ @ := DWORD_TO_DINT(" op "(Bits, B)) ] |\n"
/* The fault of the original: all but the highest bit are filled with the sign. */
#define FILLED \
	"RUNG\n  | [ Bits := SHR(Bits, B) ] |\n" \
	"RUNG\n  | [ A < 0 ] | [ Bits := Bits OR NOT SHR(16#FFFFFFFF, B) ] |\n" \
	"RUNG\n  | [ Bits := Bits AND 16#7FFFFFFF ] |\n"

static const struct body bodies[CLASSIC_FUNCTIONS] = {
	[CLASSIC_SUM] = { "A + B, of which 32 bits are left",
		"RUNG\n  | [ @ := A + B ] |\n", NULL },
	[CLASSIC_DIFFERENCE] = { "A - B, of which 32 bits are left",
		"RUNG\n  | [ @ := A - B ] |\n", NULL },
	[CLASSIC_PRODUCT] = { "A * B, of which 32 bits are left",
		"RUNG\n  | [ @ := A * B ] |\n", NULL },
	[CLASSIC_DIVIDE] = { "A / B; by zero it is 0 and %%S7 remembers it",
		"RUNG\n  | [ B <> 0 ] | [ @ := A / B ] |\n"
		"RUNG\n  | [ B = 0 ] | S %%SX0.7 |\n", NULL },
	[CLASSIC_REMAINDER] = { "A MOD B; by zero it is 0 and %%S7 remembers it",
		"RUNG\n  | [ B <> 0 ] | [ @ := A MOD B ] |\n"
		"RUNG\n  | [ B = 0 ] | S %%SX0.7 |\n", NULL },
	[CLASSIC_POWER] = { "A to the power of B",
		"RUNG\n  | [ @ := 1 ] |\n"
		"RUNG\n  | [ Rest > 0 ] | FOR Bit := 1 TO 31 |\n"
		"RUNG\n  | [ Rest MOD 2 = 1 ] | [ @ := @ * Base ] |\n"
		"RUNG\n  | [ Base := Base * Base ] |\nRUNG\n  | [ Rest := Rest / 2 ] |\n"
		"RUNG\n  | NEXT |\n",
		/* LinuxCNC's: a square for each of B, of which 32 make 0 or 1. */
		"RUNG\n  | [ @ := A ] | [ Rest := MIN(B, 40) ] |\nRUNG\n  | FOR Bit := 1 TO Rest |\n"
		"RUNG\n  | [ @ := @ * @ ] |\nRUNG\n  | NEXT |\n" },
	[CLASSIC_AND] = { "the bits that both have", BITS("AND"), NULL },
	[CLASSIC_XOR] = { "the bits that one of them has", BITS("XOR"), NULL },
	[CLASSIC_OR] = { "the bits that any of them has", BITS("OR"), NULL },
	[CLASSIC_SHIFT_LEFT] = { "A, B places to the left; %%S8 is what falls out",
		MOVED("SHL") LEFT_OUT, NULL },
	[CLASSIC_SHIFT_RIGHT] = { "A, B places to the right; %%S8 is what falls out",
		MOVED("SHR") RIGHT_OUT,
		RIGHT_OUT FILLED "RUNG\n  | [ @ := DWORD_TO_DINT(Bits) ] |\n" },
	[CLASSIC_ROTATE_LEFT] = { "A, B places round to the left; %%S8 is the last one",
		MOVED("ROL") LEFT_OUT,
		LEFT_OUT "RUNG\n  | [ Bits := SHL(Bits, B) ] |\n"
		"RUNG\n  | NO %%SX1.0 | [ Bits := Bits OR 16#1 ] |\n"
		"RUNG\n  | [ @ := DWORD_TO_DINT(Bits) ] |\n" },
	[CLASSIC_ROTATE_RIGHT] = { "A, B places round to the right; %%S8 is the last one",
		MOVED("ROR") RIGHT_OUT,
		RIGHT_OUT FILLED "RUNG\n  | NO %%SX1.0 | [ Bits := Bits OR 16#80000000 ] |\n"
		"RUNG\n  | [ @ := DWORD_TO_DINT(Bits) ] |\n" },
};

static void put_body(struct conversion *c, const char *text, const char *name)
{
	for (; *text; text++) {
		if (*text == '@')
			put(c, "%s", name);
		else if (text[0] != '%' || text[1] != '%')
			put(c, "%c", *text);
	}
}

static void write_function(struct conversion *c, enum classic_function function)
{
	const struct body *body = &bodies[function];
	const char *name = c->function_name[function];
	bool shift = function >= CLASSIC_SHIFT_LEFT;
	bool faithful = c->options.faithful && body->faithful &&
			(function != CLASSIC_POWER ||
			 c->project->dialect == CLASSIC_LINUXCNC);

	put_body(c, "(* ", name);
	put_body(c, body->title, name);
	put(c, " *)\nFUNCTION %s : DINT LD\nVAR_INPUT\n  A : DINT;\n  B : DINT;\nEND_VAR\n",
	    name);
	if (shift)
		put(c, "VAR\n  Bits : DWORD;\n  Left : DINT;\n  Right : DINT;\nEND_VAR\n"
		    "RUNG\n  | [ Bits := DINT_TO_DWORD(A) ] |\n"
		    "RUNG\n  | [ Left := 32 - B ] |\nRUNG\n  | [ Right := B - 1 ] |\n");
	if (function == CLASSIC_POWER)
		put(c, "VAR\n  Bit : DINT;\n  Base : DINT;\n  Rest : DINT;\nEND_VAR\n"
		    "RUNG\n  | [ Base := A ] |\nRUNG\n  | [ Rest := B ] |\n");
	put_body(c, faithful ? body->faithful : body->rungs, name);
	put(c, "END_FUNCTION\n\n");
}

void write_functions(struct conversion *c)
{
	for (int i = 0; i < CLASSIC_FUNCTIONS; i++)
		if (c->function_name[i])
			write_function(c, (enum classic_function)i);
}
