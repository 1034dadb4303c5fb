/* SPDX-License-Identifier: MIT
 *
 * classic_declare - declarations of an imported project: variables, blocks with their
 * presets, functions, and the program that sets system bits and words.
 */
#include "engine/exchange/classic/classic_convert.h"

#include <stdlib.h>
#include <string.h>

enum { SYSTEM_BIT = 70, SYSTEM_WORD = 290 };

static bool uses(struct conversion *c, int type, int number)
{
	return used_name(c, type, number) != NULL;
}

/* ---- declarations ---- */

/* Without comment marks. */
static const char *comment_text(struct conversion *c, const char *text)
{
	char *copy = arena_copy(c->arena, text, strlen(text));

	for (char *at = copy; at && *at; at++)
		if ((at[0] == '*' && at[1] == ')') || (at[0] == '(' && at[1] == '*'))
			at[0] = '+';
	return copy ? copy : "";
}

static const char *const base_text[] = { "T#1m", "T#1s", "T#100ms" };

static const char *base_of(const struct classic_block *block)
{
	return base_text[block && block->base >= 0 && block->base <= 2 ? block->base : 1];
}

const char *iec_word(const struct classic_block *block)
{
	static const char *const word[] = { "CL_TON", "CL_TOF", "CL_TP" };

	return word[block && block->mode >= 0 && block->mode <= 2 ? block->mode : 0];
}

/* ": CL_TON := (P := 20, BASE := T#100ms)" */
static void put_instance(struct conversion *c, enum classic_kind kind, int number)
{
	const struct classic_project *project = c->project;
	const char *faithful = c->options.faithful ? ", FAITHFUL := TRUE" : "";
	const struct classic_block *block;

	switch (kind) {
	case CLASSIC_TIMER:
		block = classic_block(&project->timer, number);
		put(c, "CL_TIMER := (P := %d, V := %d, BASE := %s)",
		    block ? block->preset : 0, block ? block->preset : 0, base_of(block));
		break;
	case CLASSIC_MONOSTABLE:
		block = classic_block(&project->monostable, number);
		put(c, "CL_MONO := (P := %d, BASE := %s%s)", block ? block->preset : 0,
		    base_of(block), faithful);
		break;
	case CLASSIC_IEC_TIMER:
		block = classic_block(&project->iec_timer, number);
		put(c, "%s := (P := %d, BASE := %s%s)", iec_word(block),
		    block ? block->preset : 0, base_of(block), faithful);
		break;
	case CLASSIC_COUNTER:
		block = classic_block(&project->counter, number);
		put(c, "CL_COUNTER := (P := %d, V := 0)", block ? block->preset : 0);
		break;
	case CLASSIC_REGISTER:
		block = classic_block(&project->reg, number);
		put(c, "CL_REGISTER := (SIZE := %d, LAST_OUT := %s)",
		    project->register_list < 500 ? project->register_list : 500,
		    block && block->mode == 2 ? "TRUE" : "FALSE");
		break;
	case CLASSIC_KINDS:
		break;
	}
}

/* "%TM0" */
static const char *original(struct conversion *c, const struct classic_name *name)
{
	const struct classic_memory_row *memory = classic_memory_of(name->type);
	const struct classic_pin_row *pin = classic_pin_of(name->type);

	return text_of(c, "%%%s%d", memory ? memory->prefix : pin ? pin->prefix : "X",
		       name->number);
}

void put_comment_line(struct conversion *c, const char *indent, const char *text)
{
	char *copy = arena_copy(c->arena, text, strlen(text));

	for (char *at = copy; at && *at; at++)
		if ((unsigned char)*at < ' ')
			*at = ' ';
	put(c, "%s(* %s *)\n", indent, copy ? comment_text(c, copy) : "");
}

bool time_is_used(struct conversion *c, int number)
{
	return uses(c, STEP_TIME, number);
}

static void put_comment(struct conversion *c, const struct classic_name *name)
{
	put(c, " (* %s%s%s *)\n", original(c, name), name->comment[0] ? ": " : "",
	    comment_text(c, name->comment));
}

int words_of(struct conversion *c, const struct classic_memory_row *memory)
{
	static const struct { const char *prefix, *key; int usual; } row[] = {
		{ "W", "SIZE_NBR_WORDS", 200 }, { "IW", "SIZE_NBR_PHYS_WORDS_INPUTS", 25 },
		{ "QW", "SIZE_NBR_PHYS_WORDS_OUTPUTS", 25 },
	};
	int used = used_numbers(c, memory), most = memory_numbers(memory);
	long count = 16;

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		const char *text = classic_setting(c->project, row[i].key);

		if (!strcmp(row[i].prefix, memory->prefix))
			count = text ? strtol(text, NULL, 10) : row[i].usual;
	}
	if (count < used)
		count = used;
	return count < 1 ? 1 : count > most ? most : (int)count;
}

/* A file declares what its sections use, the text for a script all that a project has. */
static bool is_declared(const struct conversion *c, const struct classic_name *name)
{
	if (name->type == STEP_TIME)
		return true;
	return name->name && (name->written || !c->options.task);
}

static void put_step(struct conversion *c, const struct classic_name *name)
{
	if (name->type == STEP_TIME)
		put(c, "  XTime%d : CL_STEP; (* %%X%d.V *)\n", name->number, name->number);
	else
		put(c, "  %s : BOOL%s; (* %%X%d.A *)\n", name->name,
		    step_begins(c, name->number) ? " := TRUE" : "", name->number);
}

void write_declarations(struct conversion *c)
{
	bool any = false;

	for (int i = 0; i < c->names.count; i++) {
		const struct classic_name *name = &c->names.list[i];
		const struct classic_memory_row *memory = classic_memory_of(name->type);
		const struct classic_pin_row *pin = classic_pin_of(name->type);

		if (!is_declared(c, name))
			continue;
		c->at = (struct classic_place){ "", 0 };
		if (!any)
			put(c, "VAR\n");
		if (name->symbol)
			c->at = name->symbol->place;
		any = true;
		if (!memory && !pin) {
			put_step(c, name);
			continue;
		}
		if (name->number == CLASSIC_ALL) {
			put(c, "  %s AT %s : ARRAY[0..%d] OF DINT; (* %%%s *)\n", name->name,
			    address_of(c, memory, 0), words_of(c, memory) - 1,
			    memory->prefix);
			continue;
		}
		if (memory) {
			put(c, "  %s AT %s : %s;", name->name,
			    address_of(c, memory, name->number),
			    memory->size == 1 ? "BOOL" : "DINT");
		} else {
			put(c, "  %s : ", name->name);
			put_instance(c, pin->kind, name->number);
			put(c, ";");
		}
		put_comment(c, name);
	}
	c->at = (struct classic_place){ "", 0 };
	if (any)
		put(c, "END_VAR\n\n");
}

/* ---- system bits and words ---- */

/* @ stands for the variable with the time, ? for the bit or word. */
struct system_row { int type, number; const char *rung; };

static const struct system_row system_rows[] = {
	{ SYSTEM_BIT, 0, "| [ @ MOD 1000 < 500 ] | COIL ? |" },
	{ SYSTEM_BIT, 1, "| [ @ MOD 1000 < 500 ] | COILNOT ? |" },
	{ SYSTEM_BIT, 2, "| [ @ < 30000 ] | COIL ? |" },
	{ SYSTEM_BIT, 3, "| [ @ < 30000 ] | COILNOT ? |" },
	{ SYSTEM_BIT, 4, "| NO SYS_FIRST_SCAN | COIL ? |" },
	{ SYSTEM_BIT, 5, "| NO SYS_FIRST_SCAN | COIL ? |" },
	{ SYSTEM_WORD, 0, "| [ ? := (SYS_HOUR * 100 + SYS_MINUTE) * 100 + SYS_SECOND ] |" },
	{ SYSTEM_WORD, 1, "| [ ? := (SYS_YEAR MOD 100 * 100 + SYS_MONTH) * 100 + SYS_DAY ] |" },
	{ SYSTEM_WORD, 2, "| [ ? := SYS_WEEKDAY MOD 7 ] |" },
};
enum { SYSTEM_ROWS = sizeof(system_rows) / sizeof(*system_rows), FLASH_ROWS = 4 };

static bool uses_row(struct conversion *c, int row)
{
	const struct classic_name *name = used_name(c, system_rows[row].type,
						    system_rows[row].number);

	return name && is_declared(c, name);
}

/* The time includes the first scan. */
static void write_flash(struct conversion *c)
{
	put(c, "VAR\n  %s : DINT; (* ms, a minute round *)\nEND_VAR\n", c->flash);
	put(c, "RUNG\n  | [ %s := (%s + TIME_TO_DINT(SYS_CYCLE)) MOD 60000 ] |\n", c->flash,
	    c->flash);
}

void name_system(struct conversion *c)
{
	for (int i = 0; i < SYSTEM_ROWS && !c->system; i++)
		if (uses_row(c, i))
			c->system = name_new(c, "SystemBits");
	if (!c->system)
		return;
	c->flash = name_new(c, "Flash");
	add_program(c, c->system);
	/* It runs first. */
	for (int i = c->programs.count - 1; i > 0; i--)
		c->programs.name[i] = c->programs.name[i - 1];
	if (c->programs.count)
		c->programs.name[0] = c->system;
}

static void write_system_row(struct conversion *c, int row)
{
	const char *name = name_of(c, system_rows[row].type, system_rows[row].number);

	put(c, "RUNG\n  ");
	for (const char *at = system_rows[row].rung; *at; at++) {
		if (*at == '@')
			put(c, "%s", c->flash);
		else if (*at == '?')
			put(c, "%s", name);
		else
			put(c, "%c", *at);
	}
	put(c, "\n");
}

void write_system(struct conversion *c)
{
	bool flash = false;

	if (!c->system)
		return;
	for (int i = 0; i < FLASH_ROWS; i++)
		flash |= uses_row(c, i);
	put(c, "PROGRAM %s LD\n", c->system);
	if (flash)
		write_flash(c);
	for (int i = 0; i < SYSTEM_ROWS; i++)
		if (uses_row(c, i))
			write_system_row(c, i);
	put(c, "END_PROGRAM\n\n");
}

/* @ stands for the name of the function. */
struct body { const char *title, *rungs, *faithful; };

#define BITS(op) \
	"RUNG\n  | [ @ := DWORD_TO_DINT(DINT_TO_DWORD(A) " op " DINT_TO_DWORD(B)) ] |\n"
#define OUT_BIT "RUNG\n  | BIT_TEST IN:=Bits N:=Last | COIL %%SX1.0 |\n"
#define MOVED(op) "RUNG\n  | [ @ := DWORD_TO_DINT(" op "(Bits, B)) ] |\n"
/* ClassicLadder's fault: all bits but the highest are filled with the sign. */
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
		/* LinuxCNC squares B times; from 32 times on the result is 0 or 1. */
		"RUNG\n  | [ @ := A ] | [ Rest := MIN(B, 40) ] |\nRUNG\n  | FOR Bit := 1 TO Rest |\n"
		"RUNG\n  | [ @ := @ * @ ] |\nRUNG\n  | NEXT |\n" },
	[CLASSIC_AND] = { "the bits that both have", BITS("AND"), NULL },
	[CLASSIC_XOR] = { "the bits that one of them has", BITS("XOR"), NULL },
	[CLASSIC_OR] = { "the bits that any of them has", BITS("OR"), NULL },
	[CLASSIC_SHIFT_LEFT] = { "A, B places to the left; %%S8 is what falls out",
		MOVED("SHL") OUT_BIT, NULL },
	[CLASSIC_SHIFT_RIGHT] = { "A, B places to the right; %%S8 is what falls out",
		MOVED("SHR") OUT_BIT,
		OUT_BIT FILLED "RUNG\n  | [ @ := DWORD_TO_DINT(Bits) ] |\n" },
	[CLASSIC_ROTATE_LEFT] = { "A, B places round to the left; %%S8 is the last one",
		MOVED("ROL") OUT_BIT,
		OUT_BIT "RUNG\n  | [ Bits := SHL(Bits, B) ] |\n"
		"RUNG\n  | NO %%SX1.0 | [ Bits := Bits OR 16#1 ] |\n"
		"RUNG\n  | [ @ := DWORD_TO_DINT(Bits) ] |\n" },
	[CLASSIC_ROTATE_RIGHT] = { "A, B places round to the right; %%S8 is the last one",
		MOVED("ROR") OUT_BIT,
		OUT_BIT FILLED "RUNG\n  | NO %%SX1.0 | [ Bits := Bits OR 16#80000000 ] |\n"
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
	bool left = function == CLASSIC_SHIFT_LEFT || function == CLASSIC_ROTATE_LEFT;
	bool faithful = c->options.faithful && body->faithful &&
			(function != CLASSIC_POWER ||
			 c->project->dialect == CLASSIC_LINUXCNC);

	put_body(c, "(* ", name);
	put_body(c, body->title, name);
	put(c, " *)\nFUNCTION %s : DINT LD\nVAR_INPUT\n  A : DINT;\n  B : DINT;\nEND_VAR\n",
	    name);
	if (shift)
		put(c, "VAR\n  Bits : DWORD;\n  Last : DINT;\nEND_VAR\n"
		    "RUNG\n  | [ Bits := DINT_TO_DWORD(A) ] |\n"
		    "RUNG\n  | [ Last := %s ] |\n", left ? "32 - B" : "B - 1");
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
