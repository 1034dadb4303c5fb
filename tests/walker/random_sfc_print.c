/* SPDX-License-Identifier: MIT
 *
 * random_sfc_print - a random chart as text: its lines, conditions and bodies.
 *
 * All parts share one set of variables, so that they affect each other.
 */
#include "tests/walker/random_sfc.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ACTIONS 5
#define TIMERS  40
#define RING    10

struct page {
	struct random_sfc *sfc;
	char *out;
	size_t size, used;
	int timers;      /* used so far                                       */
	int beside;      /* steps of the rings beside the chart; 0: none      */
	int printed;     /* of them                                           */
	bool in_order;
};

static void put(struct page *page, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

static void put(struct page *page, const char *format, ...)
{
	va_list list;
	int n;

	va_start(list, format);
	n = vsnprintf(page->out + page->used, page->size - page->used, format, list);
	va_end(list);
	page->used += (size_t)n;
	if (page->used >= page->size)
		page->used = page->size - 1;
}

/* ---- operands ---- */

static void step_name(struct random_source *source, const struct random_sfc *sfc,
		      char *out, size_t size, const char *member)
{
	snprintf(out, size, "S%d.%s", (int)random_below(source, (uint32_t)sfc->steps),
		 member);
}

/* A BOOL to read. */
static void put_bool(struct page *page, struct random_source *source)
{
	char name[32];
	int number = (int)random_below(source, 8);

	switch (random_below(source, 16)) {
	case 0:
	case 1:
		step_name(source, page->sfc, name, sizeof(name), "X");
		put(page, "%s", name);
		break;
	case 2:
		put(page, "Mark%d", number);
		break;
	case 3:
		put(page, "Out%d", number);
		break;
	case 4:
		put(page, number < 4 ? "Lamp%d" : "b%d", number % 4);
		break;
	case 5:
		put(page, "Alarm%d", number % 4);
		break;
	default:
		put(page, "In%d", number);
		break;
	}
}

static const char *some_time(struct random_source *source)
{
	static const char *const times[] = {
		"T#0ms", "T#1ms", "T#10ms", "T#20ms", "T#25ms", "T#40ms", "T#60ms",
		"T#100ms", "T#150ms", "T#15ms", "Wait", "T#30ms",
	};

	return times[random_below(source, sizeof(times) / sizeof(*times))];
}

/* A BOOL condition for an expression. */
static void put_atom(struct page *page, struct random_source *source, int step)
{
	char name[32];

	if (random_chance(source, 25) && step >= 0) {
		put(page, "S%d.T >= %s", step, some_time(source));
	} else if (random_chance(source, 10)) {
		step_name(source, page->sfc, name, sizeof(name), "T");
		put(page, "%s < %s", name, some_time(source));
	} else if (random_chance(source, 8)) {
		put(page, "TRUE");
	} else if (random_chance(source, 8)) {
		put(page, "n%d > %d", (int)random_below(source, 6),
		    (int)random_below(source, 5));
	} else {
		put(page, random_chance(source, 35) ? "NOT " : "");
		put_bool(page, source);
	}
}

/* Comparisons are in parentheses. */
static void put_expression(struct page *page, struct random_source *source, int step)
{
	int atoms = random_chance(source, 50) ? 1 : 2 + (int)random_below(source, 2);

	for (int i = 0; i < atoms; i++) {
		put(page, i == 0 ? "" : random_chance(source, 20) ? " AND " : " OR ");
		put(page, atoms > 1 ? "(" : "");
		put_atom(page, source, step);
		put(page, atoms > 1 ? ")" : "");
	}
}

static void put_contact(struct page *page, struct random_source *source)
{
	static const char *const words[] = { "NO", "NO", "NC", "NO", "NO", "NC", "P", "N" };

	put(page, "%s ", words[random_below(source, 8)]);
	put_bool(page, source);
}

static void put_timer(struct page *page, struct random_source *source)
{
	static const char *const words[] = { "TON", "TOF", "TP" };
	int number = page->timers++;

	put(page, "%s t%d_%d PT:=%s", words[number % 3], number % 3, number,
	    some_time(source));
}

/* ---- conditions ---- */

/* An alternative that becomes TRUE, so that charts seldom stop: a time or an input. */
static void put_way_out(struct page *page, struct random_source *source, int step)
{
	if (random_chance(source, 60))
		put(page, "[ S%d.T >= T#%dms ]", step, 10 * (int)random_below(source, 6));
	else
		put(page, "NO In%d", (int)random_below(source, 8));
}

static void put_rung_condition(struct page *page, struct random_source *source, int step)
{
	uint32_t kind = random_below(source, 5);
	bool two = (kind == 1 && page->timers < TIMERS) || kind == 2 || kind == 3;

	put(page, "    RUNG\n      | ");
	put_contact(page, source);
	put(page, two ? " | " : "");
	if (kind == 1 && two)
		put_timer(page, source);
	if (kind == 2) {
		put(page, "[ ");
		put_expression(page, source, -1);
		put(page, " ]");
	}
	if (kind == 3)
		put_contact(page, source);
	put(page, " | COIL TRANSITION |\n");
	if (random_chance(source, 20))
		return;
	put(page, "      | ");
	put_way_out(page, source, step);
	put(page, two ? " | --- ^|\n" : " ^|\n");
}

static void put_list_condition(struct page *page, struct random_source *source)
{
	static const char *const words[] = { "AND", "OR", "XOR", "ANDN", "ORN" };

	put(page, "    LD ");
	put_bool(page, source);
	for (int i = 0; i < (int)random_below(source, 3); i++) {
		put(page, "\n    %s ", words[random_below(source, 5)]);
		put_bool(page, source);
	}
	put(page, "\n");
}

static void put_condition(struct page *page, const struct random_arc *arc)
{
	struct random_source source = sfc_source(sfc_key(arc->key, 1));
	uint32_t kind = random_below(&source, 10);

	if (!sfc_has(page->sfc, sfc_key(arc->key, 2))) {
		put(page, " := In0;");
	} else if (kind < 5) {
		put(page, " := ");
		put_expression(page, &source, arc->from[0]);
		if (random_chance(&source, 60))
			put(page, " OR (S%d.T >= %s)", arc->from[0], some_time(&source));
		put(page, ";");
	} else {
		put(page, ":\n");
		if (kind < 9)
			put_rung_condition(page, &source, arc->from[0]);
		else
			put_list_condition(page, &source);
		put(page, "  ");
	}
	put(page, " END_TRANSITION\n");
}

static void put_ends(struct page *page, const int *end, int count)
{
	put(page, count > 1 ? "(" : "");
	for (int i = 0; i < count; i++)
		put(page, "%sS%d", i ? ", " : "", end[i]);
	put(page, count > 1 ? ")" : "");
}

static void put_arc(struct page *page, const struct random_arc *arc, int number)
{
	struct random_source source = sfc_source(arc->key);
	int open_end = 0;

	put(page, "  TRANSITION");
	if (random_chance(&source, 20))
		put(page, " Go%d", number);
	if (random_chance(&source, 30) &&
	    sfc_has(page->sfc, sfc_key(arc->key, 3)))
		put(page, " (PRIORITY := %d)", 1 + (int)random_below(&source, 3));
	/* IN ORDER: source and sink transitions. */
	if (page->in_order && arc->macro < 0 && random_chance(&source, 8))
		open_end = 1 + (int)random_below(&source, 2);
	if (open_end != 1) {
		put(page, " FROM ");
		put_ends(page, arc->from, arc->from_count);
	}
	if (open_end != 2) {
		put(page, " TO ");
		put_ends(page, arc->to, arc->to_count);
	}
	put_condition(page, arc);
}

/* ---- steps ---- */

static void put_target(struct page *page, struct random_source *source)
{
	uint32_t number = random_below(source, ACTIONS + 4);

	if (number < ACTIONS)
		put(page, "A%d", (int)number);
	else if (random_chance(source, 20))
		put(page, "b%d", (int)number % 4);
	else /* by its name, or by its address: one BOOL */
		put(page, random_chance(source, 25) ? "%%QX0.%d" :
		    random_chance(source, 10) ? "q0.%d" : "Out%d",
		    (int)random_below(source, 6));
}

static void put_line(struct page *page, uint64_t key)
{
	static const char *const words[] = {
		"N", "S", "R", "P", "P0", "P1", "L", "D", "SD", "DS", "SL", "R", "N",
	};
	struct random_source source = sfc_source(key);
	uint32_t word = random_below(&source, 13);

	put(page, "    ");
	if (random_chance(&source, 15)) {
		put(page, random_chance(&source, 50) ? "SET " : "RESET ");
		for (int i = 0; i == 0 || (i < 3 && random_chance(&source, 40)); i++)
			put(page, i ? ", Mark%d" : "Mark%d", (int)random_below(&source, 8));
		if (random_chance(&source, 15))
			put(page, ", Out%d", (int)random_below(&source, 8));
		put(page, ";\n");
		return;
	}
	put_target(page, &source);
	if (random_chance(&source, 5))
		put(page, "();\n");
	else if (word >= 6 && word < 11)
		put(page, "(%s, %s);\n", words[word], some_time(&source));
	else
		put(page, "(%s);\n", words[word]);
}

static void put_supervision(struct page *page, const struct random_step *step)
{
	struct random_source source = sfc_source(sfc_key(step->key, 50));
	const char *between = " (";
	bool least = false;

	for (int i = 0; i < 3; i++) {
		bool has = random_chance(&source, i == 2 ? 40 : 20);
		const char *time = some_time(&source);
		uint32_t alarm = random_below(&source, 4);

		if (!has || !sfc_has(page->sfc, sfc_key(step->key, 51u + (uint32_t)i)))
			continue;
		if (i == 2)
			put(page, "%sALARM := Alarm%d", between, (int)alarm);
		else /* a MAX less than its MIN is refused */
			put(page, "%s%s := %s", between, i ? "MAX" : "MIN",
			    i && least ? "T#180ms" : time);
		least = i == 0;
		between = ", ";
	}
	put(page, *between == ',' ? "):\n" : ":\n");
}

static void put_inside(struct page *page, int macro);

static void put_step(struct page *page, int number)
{
	const struct random_step *step = &page->sfc->step[number];
	struct random_source source = sfc_source(sfc_key(step->key, 9));
	int lines = (int)random_below(&source, 4);

	put(page, "  %s S%d", step->is_macro ? "MACRO_STEP" :
	    step->initial ? "INITIAL_STEP" : "STEP", number);
	put_supervision(page, step);
	for (int i = 0; i < lines; i++) {
		uint64_t key = sfc_key(step->key, 60u + (uint32_t)i);

		if (sfc_has(page->sfc, key))
			put_line(page, key);
	}
	if (step->is_macro)
		put_inside(page, number);
	put(page, "  END_STEP\n");
}

/* ---- many steps: EACH makes lists of 64 or more ---- */

/* Of rings beside the chart, each with a token: up to @count more steps. */
static void put_beside(struct page *page, int count)
{
	for (; count > 0 && page->printed < page->beside; count--) {
		const int number = page->printed++;
		const uint64_t key = sfc_key(page->sfc->seed, 1000u + (uint32_t)number);
		struct random_source source = sfc_source(key);

		put(page, "  %s K%d:\n", number % RING ? "STEP" : "INITIAL_STEP", number);
		if (random_chance(&source, 25) && sfc_has(page->sfc, key))
			put_line(page, key);
		put(page, "  END_STEP\n");
	}
}

static void put_arcs_beside(struct page *page)
{
	for (int i = 0; i < page->beside; i++) {
		struct random_source source = sfc_source(sfc_key(page->sfc->seed, 2000u + (uint32_t)i));
		const int to = i % RING == RING - 1 ? i - RING + 1 : i + 1;

		put(page, "  TRANSITION FROM K%d TO K%d := ", i, to);
		if (random_chance(&source, 30))
			put(page, "K%d.T >= %s", i, some_time(&source));
		else
			put_bool(page, &source);
		put(page, "; END_TRANSITION\n");
	}
}

/* Steps and transitions of a macro-step, or of the chart: in order, or mixed. Depth:
 * nested macro-steps. */
static void put_inside(struct page *page, int macro)
{
	struct random_sfc *sfc = page->sfc;
	struct random_source source = sfc_source(sfc_key(sfc->seed,
						 100u + (uint32_t)macro));
	bool mixed = random_chance(&source, 50);
	bool back = random_chance(&source, 30);

	for (int pass = 0; pass < 2; pass++)
		for (int i = 0; i < sfc->steps + sfc->arcs; i++) {
			int at = back ? sfc->steps + sfc->arcs - 1 - i : i;
			int arc = at - sfc->steps;
			uint64_t key = arc < 0 ? sfc->step[at].key : sfc->arc[arc].key;
			int in = arc < 0 ? sfc->step[at].macro : sfc->arc[arc].macro;
			bool late = mixed ? key & 1 : arc >= 0;

			if (in != macro || late != pass)
				continue;
			if (macro < 0 && arc < 0)
				put_beside(page, (int)random_below(&source, 40));
			if (arc < 0)
				put_step(page, at);
			else
				put_arc(page, &sfc->arc[arc], arc);
		}
}

/* ---- bodies ---- */

static void put_coil(struct page *page, struct random_source *source)
{
	static const char *const words[] = { "COIL", "COIL", "S", "R", "COILNOT",
					     "COILP", "COILN" };

	put(page, "%s ", words[random_below(source, 7)]);
	switch (random_below(source, 4)) {
	case 0:
		put(page, "Mark%d", (int)random_below(source, 8));
		break;
	case 1:
		put(page, "b%d", (int)random_below(source, 4));
		break;
	case 2:
		put(page, random_chance(source, 20) ? "Alarm%d" : "Lamp%d",
		    (int)random_below(source, 4));
		break;
	default:
		put(page, "Lamp%d", (int)random_below(source, 8));
	}
}

static void put_body_rung(struct page *page, struct random_source *source, bool last)
{
	uint32_t kind = random_below(source, 9);

	put(page, "      | ");
	put_contact(page, source);
	if (kind == 0 && page->timers < TIMERS) {
		put(page, " | ");
		put_timer(page, source);
	} else if (kind == 1) {
		put(page, " | [ n%d := n%d + 1 ] |\n", (int)random_below(source, 5) + 1,
		    (int)random_below(source, 5) + 1);
		return;
	} else if (kind == 2 && !last) {
		put(page, " | JMP Last |\n");
		return;
	} else if (kind == 3) {
		put(page, " | RET |\n");
		return;
	} else if (kind == 4) {
		put(page, " | [ Wait := T#%dms ] |\n", 10 * (int)random_below(source, 12));
		return;
	}
	put(page, " | ");
	put_coil(page, source);
	put(page, " |\n");
	if (kind >= 7) {
		put(page, "      | ");
		put_contact(page, source);
		put(page, " ^|\n");
	}
}

static void put_list(struct page *page, struct random_source *source, int number)
{
	put(page, "    LD n%d\n    ADD 1\n    ST n%d\n", number % 6, number % 6);
	put(page, "    LD ");
	put_bool(page, source);
	put(page, "\n    AND( ");
	put_bool(page, source);
	put(page, "\n    ORN ");
	put_bool(page, source);
	put(page, "\n    )\n");
	if (random_chance(source, 30))
		put(page, "    JMPCN Last\n");
	put(page, "    %s Lamp%d\n", random_chance(source, 50) ? "ST" : "S",
	    (int)random_below(source, 8));
	put(page, "  Last:\n    LD ");
	put_bool(page, source);
	put(page, "\n    %s Mark%d\n", random_chance(source, 50) ? "R" : "STN",
	    (int)random_below(source, 8));
}

static void put_statement(struct page *page, struct random_source *source, int depth)
{
	static const char *const ends[] = { "RETURN", "n0 := 0", "Wait := T#30ms" };
	const char *in = &"          "[10 - 2 * depth];
	const uint32_t kind = depth < 4 ? random_below(source, 8) : 0;

	if (kind >= 6) {
		put(page, "%sIF ", in);
		put_bool(page, source);
		put(page, " AND n%d < %d THEN\n", (int)random_below(source, 6), (int)random_below(source, 30));
		put_statement(page, source, depth + 1);
		if (kind == 7) {
			put(page, "%sELSIF NOT ", in);
			put_bool(page, source);
			put(page, " THEN\n");
			put_statement(page, source, depth + 1);
			put(page, "%sELSE\n", in);
			put_statement(page, source, depth + 1);
		}
		put(page, "%sEND_IF;\n", in);
	} else if (kind == 5) {
		put(page, "%sWHILE n%d < %d DO\n", in, depth, (int)random_below(source, 20));
		put(page, "%s  n%d := n%d + 1;\n", in, depth, depth);
		put_statement(page, source, 4);
		put(page, "%sEND_WHILE;\n", in);
	} else if (kind == 4) {
		put(page, "%s%s;\n", in, ends[random_below(source, 3)]);
	} else {
		put(page, "%s%s%d := ", in, random_chance(source, 50) ? "Lamp" : "Mark",
		    (int)random_below(source, 8));
		put_bool(page, source);
		put(page, random_chance(source, 50) ? " AND NOT " : " OR ");
		put_bool(page, source);
		put(page, ";\n");
	}
}

static void put_text(struct page *page, uint64_t key, struct random_source *source, int number)
{
	const int count = 1 + (int)random_below(source, 4);

	put(page, "    c%d := c%d + 1;\n", number, number);
	for (int i = 0; i < count; i++) {
		const uint64_t at = sfc_key(key, 20u + (uint32_t)i);
		struct random_source own = sfc_source(at);

		if (sfc_has(page->sfc, at))
			put_statement(page, &own, 2);
	}
}

static void put_action(struct page *page, int number)
{
	uint64_t key = sfc_key(page->sfc->seed, 300u + (uint32_t)number);
	struct random_source source = sfc_source(key);
	int rungs = 1 + (int)random_below(&source, 4);
	char call[16];

	snprintf(call, sizeof(call), " A%d(", number);
	if (!strstr(page->out, call))
		return;
	put(page, "  ACTION A%d:\n", number);
	if (random_chance(&source, 15)) {
		put_list(page, &source, number);
		put(page, "  END_ACTION\n");
		return;
	}
	if (random_chance(&source, 25)) {
		put_text(page, key, &source, number);
		put(page, "  END_ACTION\n");
		return;
	}
	put(page, "    RUNG\n      | [ c%d := c%d + 1 ] |\n", number, number);
	for (int i = 0; i < rungs; i++) {
		uint64_t at = sfc_key(key, 1u + (uint32_t)i);
		struct random_source own = sfc_source(at);

		if (i + 1 < rungs && !sfc_has(page->sfc, at))
			continue;
		put(page, i + 1 == rungs ? "    RUNG Last\n" : "    RUNG\n");
		put_body_rung(page, &own, i + 1 == rungs);
	}
	put(page, "  END_ACTION\n");
}

/* ---- the whole ---- */

static void put_control(struct page *page)
{
	static const char *const controls[] = {
		"RESET := CReset", "HOLD := CHold", "SEMI := CSemi", "MANUAL := CManual",
		"TIP := CTip", "FORCE := CForce",
	};
	static const char *const inside[] = {
		"RESET := Alarm2", "HOLD := Alarm3", "SEMI := Mark7", "MANUAL := Mark6",
		"TIP := b3", "FORCE := n5",
	};
	uint64_t key = sfc_key(page->sfc->seed, 400);
	struct random_source source = sfc_source(key);
	const char *between = "  CONTROL(";

	if (!random_chance(&source, 30))
		return;
	for (uint32_t i = 0; i < 6; i++) {
		if (!random_chance(&source, 60) ||
		    !sfc_has(page->sfc, sfc_key(key, i)))
			continue;
		put(page, "%s%s", between,
		    random_chance(&source, 15) ? inside[i] : controls[i]);
		between = ", ";
	}
	put(page, *between == ',' ? ");\n" : "");
}

static void put_many(struct page *page, const char *name, const char *at, int count,
		     const char *type)
{
	for (int i = 0; i < count; i++)
		if (*at)
			put(page, "    %s%d AT %s%d : %s;\n", name, i, at, i, type);
		else
			put(page, "    %s%d : %s;\n", name, i, type);
}

static void put_head(struct page *page, const char *name, const char *evolution)
{
	static const char *const words[] = { "TON", "TOF", "TP" };

	put(page, "\nPROGRAM %s SFC%s\n  VAR\n", name, evolution);
	put_many(page, "In", "%IX0.", 8, "BOOL");
	put(page, "    CReset AT %%IX1.0 : BOOL;\n    CHold AT %%IX1.1 : BOOL;\n"
	    "    CSemi AT %%IX1.2 : BOOL;\n    CManual AT %%IX1.3 : BOOL;\n"
	    "    CTip AT %%IX1.4 : BOOL;\n    CForce AT %%IB2 : USINT;\n");
	put_many(page, "Out", "%QX0.", 8, "BOOL");
	put_many(page, "Lamp", "%QX1.", 8, "BOOL");
	put_many(page, "Mark", "%MX0.", 8, "BOOL");
	put_many(page, "Alarm", "%MX1.", 4, "BOOL");
	put_many(page, "b", "", 4, "BOOL");
	put_many(page, "n", "", 6, "INT");
	put_many(page, "c", "", ACTIONS, "INT");
	put(page, "    Wait : TIME := T#40ms;\n");
	for (int i = 0; i < page->timers; i++)
		put(page, "    t%d_%d : %s;\n", i % 3, i, words[i % 3]);
	put(page, "  END_VAR\n\n");
}

/* The text for chart->seed. */
static void put_program(struct page *whole, const char *name)
{
	static char body[96 * 1024];
	struct random_sfc *sfc = whole->sfc;
	struct page page = { .sfc = sfc, .out = body, .size = sizeof(body) };
	struct random_source source = sfc_source(sfc_key(sfc->seed, 500));
	uint32_t evolution = random_below(&source, 5);
	bool stable = evolution == 0 && sfc_has(sfc, sfc_key(sfc->seed, 501));

	page.in_order = evolution == 1;

	sfc_grow(sfc);
	if (random_chance(&source, 10) && sfc_has(sfc, sfc_key(sfc->seed, 502)))
		page.beside = RING * (7 + (int)random_below(&source, 12));
	put_control(&page);
	put_inside(&page, -1);
	put_beside(&page, page.beside);
	put_arcs_beside(&page);
	for (int i = 0; i < ACTIONS; i++)
		put_action(&page, i);
	whole->timers = page.timers;
	put_head(whole, name, page.in_order ? " IN ORDER" : stable ? " UNTIL STABLE" : "");
	put(whole, "%sEND_PROGRAM\n", body);
}

size_t random_sfc_print(struct random_sfc *sfc, char *out, size_t size)
{
	struct page whole = { .sfc = sfc, .out = out, .size = size };
	const uint64_t seed = sfc->seed, key = sfc_key(seed, 600);
	struct random_source source = sfc_source(key);
	bool unsafe;

	sfc->part_count = 0;
	put(&whole, "RUNGBOARD 1\n");
	put_program(&whole, "Chart");
	if (!random_chance(&source, 10) || !sfc_has(sfc, key))
		return whole.used;
	/* Another one on the same addresses. */
	unsafe = sfc->unsafe;
	sfc->seed = key;
	put_program(&whole, "Other");
	sfc->seed = seed;
	sfc->unsafe |= unsafe;
	return whole.used;
}
