/* SPDX-License-Identifier: MIT
 *
 * ladder_words - random cells that can be exported to ClassicLadder: contacts, coils, blocks
 * of IEC 61131-3 and of ClassicLadder, small numbers.
 *
 * random.c makes the networks, this file their cells, as tests/walker/words.c does for other
 * tests. Left out is what ClassicLadder does otherwise: overflow, division by zero, counters
 * below 0.
 */
#include "tests/classic/ladder_words.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct row { const char *name, *rest; };

static const struct row bits[] = {
	{ "bool_a", ": BOOL" }, { "bool_e", ": BOOL" }, { "bool_c", ": BOOL := TRUE" },
	{ "bool_d", ": BOOL" }, { "mark_a", "AT %MX0.1 : BOOL" },
	{ "mark_b", "AT %MX1.7 : BOOL" }, { "out_a", "AT %QX0.0 : BOOL" },
	{ "out_b", "AT %QX1.3 : BOOL" }, { "row_b", ": ARRAY[-1..3] OF BOOL" },
};
static const struct row numbers[] = {
	{ "dint_a", ": DINT" }, { "dint_b", ": DINT := -7" }, { "num_a", ": DINT := 3" },
	{ "num_b", ": DINT" }, { "uint_a", ": UINT" }, { "word_v", "AT %VD8 : DINT" },
	{ "word_w", "AT %VD12 : DINT" },
	{ "row_n", ": ARRAY[1..4] OF DINT" }, { "small_a", ": INT := 3" }, { "index", ": DINT := 2" },
};
static const struct row blocks[] = {
	{ "ton_a", ": TON" }, { "tof_a", ": TOF" }, { "tp_a", ": TP" },
	{ "ctu_a", ": CTU" }, { "ctd_a", ": CTD" }, { "ctud_a", ": CTUD" }, { "sr_a", ": SR" },
	{ "rs_a", ": RS" }, { "rt_a", ": R_TRIG" }, { "ft_a", ": F_TRIG" },
	{ "clt_a", ": CL_TIMER := (P := 4, V := 4, BASE := T#100ms)" },
	{ "mono_a", ": CL_MONO := (P := 5, BASE := T#100ms)" },
	{ "clton_a", ": CL_TON := (P := 3, BASE := T#100ms)" },
	{ "cltof_a", ": CL_TOF := (P := 4, BASE := T#100ms)" },
	{ "cltp_a", ": CL_TP := (P := 2, BASE := T#100ms)" },
	{ "clc_a", ": CL_COUNTER := (P := 3, V := 0)" },
};
static const char *const read_bits[] = {
	"bool_a", "bool_e", "bool_c", "bool_d", "mark_a", "mark_b", "out_a", "out_b",
	"row_b[-1]", "row_b[2]", "row_b[index]", "%IX0.0", "%IX0.1", "%IX0.2", "%IX0.3", "%IX0.4",
	"%IX0.5", "%IX1.7", "%MX3.2", "%QX0.7", "SYS_FIRST_SCAN", "SYS_ALWAYS_ON",
	"ton_a.Q", "ton_b.Q", "tof_a.Q", "tp_a.Q", "ctu_a.Q", "ctd_a.Q", "ctud_a.QU",
	"ctud_a.QD", "sr_a.Q1", "rs_a.Q1", "rt_a.Q", "ft_a.Q", "clt_a.D", "clt_a.R",
	"mono_a.R", "clton_a.Q", "cltof_a.Q", "cltp_a.Q", "clc_a.D", "clc_a.E",
};
static const char *const written_bits[] = {
	"bool_a", "bool_e", "bool_c", "bool_d", "mark_a", "mark_b", "out_a", "out_b",
	"row_b[0]", "row_b[3]", "row_b[index]", "%MX3.2", "%QX0.7", "%QX1.0",
};
static const char *const read_numbers[] = {
	"dint_a", "dint_b", "num_a", "num_b", "word_v", "small_a", "row_n[1]", "row_n[4]",
	"row_n[index]", "ctu_a.CV", "clc_a.V", "word_w",
};
static const char *const boxes[] = {
	"TON ton_a PT:=T#300ms", "TON ton_b PT:=T#1s", "TOF tof_a PT:=T#200ms",
	"TP tp_a PT:=T#400ms", "CTU ctu_a PV:=3 R:=/mark_a", "CTU ctu_a PV:=small_a",
	"CTD ctd_a PV:=4 LD:=mark_b", "CTUD ctud_a PV:=3 R:=bool_a LD:=/out_a",
	"SR sr_a R:=out_b", "RS rs_a R1:=/out_b", "R_TRIG rt_a", "F_TRIG ft_a",
	"TON ton_a PT:=T#300ms Q=>bool_d", "CTU ctu_a PV:=3 CV=>dint_b",
	"CL_TIMER clt_a DT:=SYS_CYCLE", "CL_MONO mono_a DT:=SYS_CYCLE",
	"CL_TON clton_a DT:=SYS_CYCLE", "CL_TOF cltof_a DT:=SYS_CYCLE",
	"CL_TP cltp_a DT:=SYS_CYCLE", "CL_COUNTER clc_a UP:=bool_e",
};
/* Boxes with inputs that branches feed. */
static const struct { const char *text, *pin[3]; int pins; } fed[] = {
	{ "CTU ctu_a PV:=3", { "R" }, 1 }, { "CTD ctd_a PV:=4", { "LD" }, 1 },
	{ "CTUD ctud_a PV:=3", { "CD", "R", "LD" }, 3 }, { "SR sr_a", { "R" }, 1 },
	{ "RS rs_a", { "R1" }, 1 }, { "CL_TIMER clt_a DT:=SYS_CYCLE", { "C" }, 1 },
	{ "CL_COUNTER clc_a", { "LOAD", "UP", "DOWN" }, 3 },
};
#define COUNT(list) (sizeof(list) / sizeof(*(list)))
#define PICK(list) (list)[random_below(source, COUNT(list))]

struct text { char *out; size_t size, used; };

static void put(struct text *text, const char *format, ...)
{
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(text->out + text->used, text->size - text->used, format, args);
	va_end(args);
	if (len > 0)
		text->used += (size_t)len;
	if (text->used >= text->size)
		text->used = text->size - 1;
}

/* ---- expressions: values stay below some thousands ---- */

static void small(struct random_source *source, struct text *text, int depth)
{
	static const char *const op[] = { "+", "-", "*" };

	switch (depth > 2 ? 0 : random_below(source, 7)) {
	case 0: case 1:
		put(text, "%s MOD %d", PICK(read_numbers), 2 + (int)random_below(source, 30));
		return;
	case 2:
		put(text, "%d", (int)random_below(source, 40) - 20);
		return;
	case 3:
		put(text, "ABS(%s MOD 50)", PICK(read_numbers));
		return;
	case 4:
		put(text, "%s(%s MOD 20, %d)", random_chance(source, 50) ? "MIN" : "MAX",
		    PICK(read_numbers), (int)random_below(source, 9));
		return;
	default:
		put(text, "(");
		small(source, text, depth + 1);
		put(text, ") %s (", PICK(op));
		small(source, text, depth + 1);
		put(text, ")");
	}
}

static void truth(struct random_source *source, struct text *text, int depth)
{
	static const char *const compare[] = { "=", "<>", "<", "<=", ">", ">=" };
	static const char *const join[] = { "AND", "OR", "XOR" };

	if (depth < 2 && random_chance(source, 35)) {
		put(text, "(");
		truth(source, text, depth + 1);
		put(text, ") %s (", PICK(join));
		truth(source, text, depth + 1);
		put(text, ")");
	} else if (random_chance(source, 25)) {
		put(text, "%s%s", random_chance(source, 40) ? "NOT " : "", PICK(read_bits));
	} else {
		put(text, "(");
		small(source, text, 1);
		put(text, ") %s (", PICK(compare));
		small(source, text, 2);
		put(text, ")");
	}
}

static void assignment(struct random_source *source, struct text *text)
{
	static const char *const target[] = { "dint_a", "dint_b", "num_a", "num_b", "word_v",
					      "row_n[2]", "row_n[3]", "row_n[index]", "word_w" };

	switch (random_below(source, 5)) {
	case 0:
		put(text, "[ %s := ", PICK(written_bits));
		truth(source, text, 1);
		break;
	case 1:
		put(text, "[ index := ABS(%s MOD 3) + 1", PICK(read_numbers));
		break;
	case 2:
		if (random_chance(source, 50))
			put(text, "[ dint_a := uint_a");
		else
			put(text, "[ uint_a := (uint_a + %d) MOD 1000",
			    (int)random_below(source, 40));
		break;
	default:
		put(text, "[ %s := (", PICK(target));
		small(source, text, 0);
		put(text, ") MOD 1000");
	}
	put(text, " ]");
}

/* ---- cells ---- */

/* An expression that is not too long for a cell. */
static void whole(struct random_source *source, char *out, size_t size,
		  void (*make)(struct random_source *source, struct text *text))
{
	struct text text;

	do {
		text = (struct text){ out, size, 0 };
		*out = '\0';
		make(source, &text);
	} while (text.used + 2 >= size);
}

static void series(struct random_source *source, struct text *text)
{
	static const char *const contact[] = { "NO", "NO", "NO", "NC", "NC", "P", "N" };
	const char *word = PICK(contact), *name;

	if (random_chance(source, 8)) {
		put(text, "NOT");
		return;
	}
	if (random_chance(source, 15)) {
		put(text, "[ ");
		truth(source, text, 0);
		put(text, " ]");
		return;
	}
	do
		name = PICK(read_bits);
	while ((*word == 'P' || word[1] == '\0') && !strcmp(name, "SYS_ALWAYS_ON"));
	put(text, "%s %s", word, name);
}

void random_series(struct random_source *source, char *out, size_t size)
{
	whole(source, out, size, series);
}

void random_last(struct random_source *source, int later, char *out, size_t size)
{
	static const char *const coil[] = { "COIL", "COIL", "COIL", "COILNOT", "S", "R", "COILP",
					    "COILN" };

	if (later && random_chance(source, 15))
		snprintf(out, size, "JMP L%d", later);
	else if (random_chance(source, 3))
		snprintf(out, size, "RET");
	else if (random_chance(source, 15))
		whole(source, out, size, assignment);
	else
		snprintf(out, size, "%s %s", PICK(coil), PICK(written_bits));
}

int random_box(struct random_source *source, char *out, size_t size, const char *pin[3])
{
	if (random_chance(source, 30)) {
		whole(source, out, size, assignment);
	} else if (random_chance(source, 30)) {
		uint32_t i = random_below(source, COUNT(fed));

		snprintf(out, size, "%s", fed[i].text);
		memcpy(pin, fed[i].pin, sizeof(fed[i].pin));
		return fed[i].pins;
	} else {
		snprintf(out, size, "%s", PICK(boxes));
	}
	return 0;
}

/* ---- other functions that random.c needs ---- */

void random_own_call(struct random_source *source, int pou, char *out, size_t size)
{
	(void)source, (void)pou, (void)out, (void)size;
}

void random_without_memory(struct random_source *source, char *text, size_t size)
{
	(void)source, (void)text, (void)size;
}

const char *random_own_head(int pou)
{
	(void)pou;
	return "";
}

const char *random_own_tail(int pou)
{
	(void)pou;
	return "";
}

const char *random_types(const char *body)
{
	(void)body;
	return "";
}

static bool stands_in(const char *body, const char *name)
{
	size_t len = strlen(name);

	for (const char *at = body; (at = strstr(at, name)); at += len) {
		char before = at == body ? ' ' : at[-1], after = at[len];

		if (!isalnum((unsigned char)before) && before != '_' &&
		    !isalnum((unsigned char)after) && after != '_')
			return true;
	}
	return false;
}

bool random_block(const char *name, size_t len, size_t *which)
{
	for (*which = 0; *which < COUNT(blocks); ++*which)
		if (strlen(blocks[*which].name) == len &&
		    !strncmp(name, blocks[*which].name, len))
			return true;
	return false;
}

/* sr_a, sr_b, …: an instance for each call. */
static void declare_blocks(const char *body, struct text *text)
{
	for (size_t i = 0; i < COUNT(blocks); i++) {
		char name[16];

		snprintf(name, sizeof(name), "%s", blocks[i].name);
		for (char last = 'a'; last <= 'z'; last++) {
			name[strlen(name) - 1] = last;
			if (stands_in(body, name))
				put(text, "  %s %s;\n", name, blocks[i].rest);
		}
	}
}

size_t random_declare(const char *body, char *out, size_t size)
{
	static const struct { const struct row *row; size_t count; } list[] = {
		{ bits, COUNT(bits) }, { numbers, COUNT(numbers) },
	};
	struct text text = { out, size, 0 };

	put(&text, "VAR\n");
	for (size_t i = 0; i < COUNT(list); i++)
		for (size_t k = 0; k < list[i].count; k++)
			if (stands_in(body, list[i].row[k].name))
				put(&text, "  %s %s;\n", list[i].row[k].name,
				    list[i].row[k].rest);
	declare_blocks(body, &text);
	put(&text, "END_VAR\n");
	return text.used;
}
