/* SPDX-License-Identifier: MIT
 *
 * st_random - random programs of Structured Text: statements of each kind around
 * expressions of each type.
 *
 * A part of the numbers is at the limits of their types, some indices are outside. Most
 * programs are accepted; what is computed from constants alone is avoided.
 */
#include "tests/st/st_random.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Where a body stands: what it may use. */
enum room { ROOM_FUNCTION, ROOM_BLOCK, ROOM_ROUTINE, ROOM_MAIN };

struct maker {
	struct random_source source;
	char *out;
	size_t size, used;
	enum room room;
	int loops;              /* around the statement                       */
	int whiles;             /* counters in use                            */
	int labels;             /* so far                                     */
	bool chart;             /* in an action, where no program is called   */
	bool in_case;
};

static const char types[] =
	"RUNGBOARD 1\n\nTYPE\n"
	"  Colour : (Red, Green := 5, Blue);\n"
	"  Mode : USINT (Off := 1, Slow, Fast := 16#10);\n"
	"  Percent : INT (0..100) := 50;\n"
	"  Trim : SINT (-5..5);\n"
	"  Point : STRUCT\n    x : INT := 1;\n    y : DINT;\n    z : LREAL := 0.5;\n    on : BOOL;\n"
	"    share : Percent;\n    tag : STRING[6] := 'ab';\n    row : ARRAY[1..3] OF INT := [7, 8, 9];\n  END_STRUCT;\n"
	"END_TYPE\n\n";

static const char globals[] =
	"VAR\n"
	"  nb : BOOL;\n  ni : INT;\n  nd : DINT;\n  nr : REAL;\n  nu : USINT;\n  nw : WORD;\n  nt : TIME;\n  nl : LINT;\n"
	"  b1 : BOOL;\n  b2 : BOOL := TRUE;\n  b3 : BOOL;\n"
	"  s1 : SINT := 120;\n  s2 : SINT := -128;\n"
	"  i1 : INT := 3;\n  i2 : INT := -7;\n  i3 : INT := 32767;\n  i4 : INT;\n"
	"  d1 : DINT := 70000;\n  d2 : DINT := -2147483648;\n  d3 : DINT := 2;\n"
	"  l1 : LINT := 9223372036854775807;\n  l2 : LINT := -5;\n"
	"  us1 : USINT := 250;\n  us2 : USINT := 4;\n"
	"  ui1 : UINT := 65530;\n  ui2 : UINT := 9;\n"
	"  ud1 : UDINT := 4294967290;\n  ud2 : UDINT := 17;\n"
	"  ul1 : ULINT := 18446744073709551610;\n  ul2 : ULINT := 3;\n"
	"  by1 : BYTE := 16#A5;\n  by2 : BYTE := 16#0F;\n"
	"  w1 : WORD := 16#8001;\n  w2 : WORD := 16#00FF;\n"
	"  dw1 : DWORD := 16#DEADBEEF;\n  dw2 : DWORD;\n"
	"  lw1 : LWORD := 16#8000000000000001;\n  lw2 : LWORD := 16#FF;\n"
	"  r1 : REAL := 1.5;\n  r2 : REAL := 3.0E38;\n  r3 : REAL := -0.25;\n"
	"  lr1 : LREAL := 1.0E308;\n  lr2 : LREAL := 0.1;\n"
	"  t1 : TIME := T#1s500ms;\n  t2 : TIME := T#7ms;\n"
	"  st1 : STRING[8] := 'pump';\n  st2 : STRING[20] := 'valve 7';\n"
	"  da1 : DATE := D#2024-02-28;\n  da2 : DATE;\n  td1 : TIME_OF_DAY := TOD#23:59:59;\n  td2 : TIME_OF_DAY;\n"
	"  dt1 : DATE_AND_TIME := DT#2026-11-30-09:08:07.654;\n  dt2 : DATE_AND_TIME;\n"
	"  c1 : Colour;\n  c2 : Colour := Blue;\n  m1 : Mode := Slow;\n"
	"  p1 : Percent;\n  p2 : Percent := 99;\n  q1 : Trim;\n"
	"  ai : ARRAY[1..5] OF INT := [10, 20, -30, 2(4)];\n  aj : ARRAY[1..5] OF INT;\n"
	"  ad : ARRAY[0..2, -1..1] OF DINT := [9(6)];\n  ae : ARRAY[0..2, -1..1] OF DINT;\n"
	"  ar : ARRAY[0..1, 1..2, 0..2] OF REAL;\n  ab : ARRAY[2..4] OF BOOL := [TRUE];\n"
	"  ap : ARRAY[1..3] OF Percent;\n  two : ARRAY[1..2, -1..0] OF INT := [4, 5, 6, 7];\n"
	"  pt1 : Point;\n  pt2 : Point;\n  pts : ARRAY[1..3] OF Point;\n"
	"  wait : TON;\n  late : TOF;\n  pulse : TP;\n  down : CTD;\n  latch : SR;\n  clear : RS;\n  fall : F_TRIG;\n  count : CTU;\n  edge : R_TRIG;\n  waits : ARRAY[1..2] OF TON;\n"
	"  mix1 : Mix;\n  mix2 : Mix;\n  mixes : ARRAY[0..1, 1..2] OF Mix;\n"
	"  roll1 : Roll;\n  roll2 : Roll;\n  rolls : ARRAY[1..2] OF Roll;\n"
	"  k1 : INT;\n  k2 : SINT;\n  k3 : USINT;\n  k4 : DINT;\n  k5 : UINT;\n  k6 : Percent;\n  k7 : LINT;\n"
	"  pq : REF_TO INT;\n  pr : POINTER TO REAL;\n"
	"  pi : REF_TO INT;\n  pp : POINTER TO Point;\n  rd : REFERENCE TO DINT;\n"
	"  g1 : INT;\n  g2 : INT;\n  g3 : INT;\n  g4 : INT;\n"
	"END_VAR\n\n";

struct st_input st_random_input(int index)
{
	static const struct st_input inputs[] = {
		{ "nb", "BOOL" }, { "ni", "INT" }, { "nd", "DINT" }, { "nr", "REAL" },
		{ "nu", "USINT" }, { "nw", "WORD" }, { "nt", "TIME" }, { "nl", "LINT" }, { NULL, NULL },
	};

	return inputs[index];
}

static void say(struct maker *m, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
static void say(struct maker *m, const char *format, ...)
{
	va_list args;
	int len;

	va_start(args, format);
	len = vsnprintf(m->out + m->used, m->size - m->used, format, args);
	va_end(args);
	if (len > 0 && m->used + (size_t)len < m->size)
		m->used += (size_t)len;
}

static uint32_t below(struct maker *m, uint32_t n)
{
	return random_below(&m->source, n);
}

static bool chance(struct maker *m, uint32_t percent)
{
	return random_chance(&m->source, percent);
}

#define PICK(m, list) (list)[below(m, sizeof(list) / sizeof(*(list)))]

/* ---- operands ---- */

enum type { T_BOOL, T_SINT, T_INT, T_DINT, T_LINT, T_USINT, T_UINT, T_UDINT, T_ULINT, T_BYTE,
	    T_WORD, T_DWORD, T_LWORD, T_REAL, T_LREAL, T_TIME, T_STRING, T_COLOUR, T_MODE, T_DATE, T_TOD, T_DT, TYPES };

/* Variables that may be read; the first ones may be written. */
static const struct {
	const char *type;
	const char *name[10];
	const char *constant[6];
	enum type narrower;     /* widens to it; itself: none                 */
} type_row[TYPES] = {
	[T_BOOL] = { "BOOL", { "b1", "b2", "b3", "pt1.on", "nb", "wait.Q", "count.Q" }, { "TRUE", "FALSE" }, T_BOOL },
	[T_SINT] = { "SINT", { "s1", "s2", "q1" }, { "1", "-128", "127", "-3", "SINT#5" }, T_SINT },
	[T_INT] = { "INT", { "i1", "i2", "i3", "i4", "pt1.x", "pt2.row[2]", "p1", "p2", "ni", "k1" },
		    { "1", "2", "-32768", "32767", "-7", "INT#9" }, T_SINT },
	[T_DINT] = { "DINT", { "d1", "d2", "d3", "pt2.y", "nd" }, { "1", "3", "-2147483648", "2147483647", "65536" }, T_INT },
	[T_LINT] = { "LINT", { "l1", "l2", "nl" }, { "1", "-1", "9223372036854775807", "4294967296" }, T_DINT },
	[T_USINT] = { "USINT", { "us1", "us2", "nu" }, { "1", "255", "7" }, T_USINT },
	[T_UINT] = { "UINT", { "ui1", "ui2" }, { "1", "65535", "300" }, T_USINT },
	[T_UDINT] = { "UDINT", { "ud1", "ud2" }, { "1", "4294967295", "12" }, T_UINT },
	[T_ULINT] = { "ULINT", { "ul1", "ul2" }, { "1", "18446744073709551615", "6" }, T_UDINT },
	[T_BYTE] = { "BYTE", { "by1", "by2" }, { "16#F0", "BYTE#3", "255" }, T_BYTE },
	[T_WORD] = { "WORD", { "w1", "w2", "nw" }, { "16#F00F", "1" }, T_BYTE },
	[T_DWORD] = { "DWORD", { "dw1", "dw2" }, { "16#FFFF0000", "16#10" }, T_WORD },
	[T_LWORD] = { "LWORD", { "lw1", "lw2" }, { "16#FFFF00000000", "16#3" }, T_DWORD },
	[T_REAL] = { "REAL", { "r1", "r2", "r3", "nr", "ar[1, 2, 0]" }, { "1.5", "0.1", "-2.0", "3.0E38", "REAL#0.5", "2" }, T_INT },
	[T_LREAL] = { "LREAL", { "lr1", "lr2", "pt1.z" }, { "0.1", "1.0E300", "-3.5", "LREAL#2.5", "7" }, T_REAL },
	[T_TIME] = { "TIME", { "t1", "t2", "nt" }, { "T#5ms", "T#1d", "T#-2s" }, T_TIME },
	[T_STRING] = { "STRING", { "st1", "st2", "pt1.tag" }, { "'abc'", "''", "'long text here'" }, T_STRING },
	[T_COLOUR] = { "Colour", { "c1", "c2" }, { "Red", "Colour#Blue", "Green" }, T_COLOUR },
	[T_MODE] = { "Mode", { "m1" }, { "Off", "Mode#Fast", "Slow" }, T_MODE },
	[T_DATE] = { "DATE", { "da1", "da2" }, { "D#2000-02-29", "D#1969-12-31", "D#2262-04-11" }, T_DATE },
	[T_TOD] = { "TIME_OF_DAY", { "td1", "td2" }, { "TOD#00:00:00", "TOD#23:59:59.999", "TOD#12:30:00" }, T_TOD },
	[T_DT] = { "DATE_AND_TIME", { "dt1", "dt2" }, { "DT#1999-12-31-23:59:59", "DT#1900-03-01-00:00:01", "DT#2262-04-11-00:00:00" }, T_DT },
};

static void expr(struct maker *m, enum type type, int depth);

static const char *one_of(struct maker *m, const char *const list[], int most)
{
	int n = 0;

	while (n < most && list[n])
		n++;
	return list[below(m, (uint32_t)n)];
}

/* An index: mostly inside of low..high. */
static void index_of(struct maker *m, int low, int high, int depth)
{
	if (chance(m, 35))
		say(m, "%d", low + (int)below(m, (uint32_t)(high - low + 1)));
	else if (chance(m, 50))
		say(m, "%s", one_of(m, (const char *const[]){ "k1", "k2", "us2", "d3", "i1", NULL }, 6));
	else if (depth > 1 && chance(m, 30))
		expr(m, T_INT, 1);
	else
		say(m, "%s MOD %d + %d", one_of(m, (const char *const[]){ "k1", "i1", "ni", "i4" , NULL}, 5),
		    high - low + 1, low);
}

/* An element of an array of the type; false: there is none. */
static bool element(struct maker *m, enum type type, int depth)
{
	if (type == T_INT && chance(m, 30)) {
		say(m, "pts[");
		index_of(m, 1, 3, depth);
		say(m, "]%s", chance(m, 50) ? ".x" : ".row[");
		if (m->out[m->used - 1] == 'x')
			return true;
		index_of(m, 1, 3, depth);
		say(m, "]");
	} else if (type == T_INT) {
		say(m, "%s[", chance(m, 20) ? "ap" : chance(m, 50) ? "ai" : "aj");
		index_of(m, 1, m->out[m->used - 2] == 'p' ? 3 : 5, depth);
		say(m, "]");
	} else if (type == T_DINT) {
		say(m, "%s[", chance(m, 50) ? "ad" : "ae");
		index_of(m, 0, 2, depth);
		say(m, chance(m, 50) ? ", " : "][");
		index_of(m, -1, 1, depth);
		say(m, "]");
	} else if (type == T_REAL) {
		say(m, "ar[");
		index_of(m, 0, 1, depth);
		say(m, ", ");
		index_of(m, 1, 2, depth);
		say(m, ", ");
		index_of(m, 0, 2, depth);
		say(m, "]");
	} else if (type == T_BOOL) {
		say(m, "ab[");
		index_of(m, 2, 4, depth);
		say(m, "]");
	} else if (type == T_TIME && m->room >= ROOM_ROUTINE) {
		say(m, "waits[");
		index_of(m, 1, 2, depth);
		say(m, "].PT");
	} else {
		return false;
	}
	return true;
}

static void letter(struct maker *m)
{
	static const char *const texts[] = { "st1", "st2", "pt1.tag", "pts[2].tag", "pp^.tag" };

	say(m, "%s[%s]", PICK(m, texts), one_of(m, (const char *const[]){ "1", "2", "k1", "us2", "i1 MOD 4 + 1", NULL }, 6));
}

static void variable(struct maker *m, enum type type)
{
	if (m->room == ROOM_FUNCTION && type == T_INT && chance(m, 40))
		say(m, "%s", chance(m, 50) ? "A" : "Own");
	else if (m->room == ROOM_BLOCK && type == T_INT && chance(m, 40))
		say(m, "%s", chance(m, 50) ? "Add" : "Kept");
	else if (chance(m, 6) && type == T_INT)
		say(m, "%s", chance(m, 50) ? "pi^" : "pp^.x");
	else if (chance(m, 10) && type == T_DINT)
		say(m, "%s", chance(m, 50) ? "rd" : "pp^.y");
	else if (chance(m, 10) && type == T_STRING)
		say(m, "pp^.tag");
	else if (chance(m, 20) && type == T_STRING)
		letter(m);
	else if (chance(m, 10) && (type == T_BOOL || type == T_BYTE || type == T_WORD))
		say(m, "%s", type == T_BOOL ? one_of(m, (const char *const[]){ "w1.15", "i2.%X15", "dw1.7", "lw1.63", "pi^.2", "dw2.%W1.%X9", "lw2.%D1.%B2.7", NULL }, 8) :
		    type == T_BYTE ? one_of(m, (const char *const[]){ "dw1.%B3", "w2.%B0", "i3.%B1", "lw1.%D1.%W0.%B1", NULL }, 5) :
		    one_of(m, (const char *const[]){ "dw1.%W1", "lw2.%W3", "d2.%W0", NULL }, 4));
	else if (m->room >= ROOM_ROUTINE && (type == T_INT || type == T_DINT) && chance(m, 5))
		say(m, "%s", type == T_INT ? chance(m, 50) ? "Side.All" : "Side.Add" : "Side.Half");
	else if (m->room >= ROOM_ROUTINE && type == T_UINT && chance(m, 20))
		say(m, "mix1.Total"); /* not while it runs */
	else
		say(m, "%s", one_of(m, type_row[type].name, 10));
}

static void leaf(struct maker *m, enum type type, int depth)
{
	if (chance(m, 25) && element(m, type, depth))
		return;
	variable(m, type);
}

static void leaf_or_constant(struct maker *m, enum type type, int depth)
{
	if (chance(m, 35))
		say(m, "%s", one_of(m, type_row[type].constant, 6));
	else
		leaf(m, type, depth);
}

/* ---- expressions ---- */

static void two(struct maker *m, enum type type, const char *op, int depth)
{
	const bool parens = chance(m, 70) || (type >= T_BYTE && type <= T_LWORD);

	say(m, "%s", parens ? "(" : "");
	if (chance(m, 60))
		expr(m, type, depth - 1);
	else
		leaf(m, type, depth);
	say(m, " %s ", op);
	if (chance(m, 40))
		expr(m, type, depth - 1);
	else if (chance(m, 20))
		variable(m, type_row[type].narrower);
	else
		leaf_or_constant(m, type, depth);
	say(m, "%s", parens ? ")" : "");
}

static enum type any_number(struct maker *m)
{
	return T_SINT + (enum type)below(m, T_ULINT - T_SINT + 1);
}

static void comparison(struct maker *m, int depth)
{
	static const char *const order[] = { "=", "<>", "<", ">", "<=", ">=" };
	static const enum type types_of[] = { T_INT, T_INT, T_DINT, T_REAL, T_LREAL, T_TIME, T_STRING, T_ULINT, T_SINT, T_WORD, T_USINT, T_DATE, T_TOD, T_DT };
	const enum type type = PICK(m, types_of);

	say(m, "(");
	if (chance(m, 15)) {
		variable(m, chance(m, 70) ? T_COLOUR : T_MODE);
		say(m, " %s %s", order[below(m, 2)], m->out[m->used - 2] == 'c' ?
		    one_of(m, type_row[T_COLOUR].constant, 6) : one_of(m, type_row[T_MODE].constant, 6));
	} else {
		if (chance(m, 40))
			expr(m, type, depth - 1);
		else
			leaf(m, type, depth);
		say(m, " %s ", PICK(m, order));
		leaf_or_constant(m, type, depth);
	}
	say(m, ")");
}

static void bool_expr(struct maker *m, int depth)
{
	static const char *const logic[] = { "AND", "OR", "XOR", "&", "AND_THEN", "OR_ELSE" };

	if (chance(m, 45)) {
		comparison(m, depth);
	} else if (chance(m, 25)) {
		say(m, "NOT ");
		if (chance(m, 50))
			leaf(m, T_BOOL, depth);
		else
			comparison(m, depth);
	} else {
		two(m, T_BOOL, PICK(m, logic), depth);
	}
}

static void called(struct maker *m, enum type type, int depth)
{
	const char *word = type_row[type].type;

	switch (below(m, 6)) {
	case 0:
		say(m, "%s(", chance(m, 50) ? "MAX" : "MIN");
		leaf(m, type, depth);
		say(m, ", ");
		leaf_or_constant(m, type, depth);
		say(m, ")");
		break;
	case 1:
		say(m, "LIMIT(");
		leaf_or_constant(m, type, depth);
		say(m, ", ");
		expr(m, type, depth - 1);
		say(m, ", ");
		leaf(m, type, depth);
		say(m, ")");
		break;
	case 2:
		say(m, "SEL(");
		expr(m, T_BOOL, depth - 1);
		say(m, ", ");
		leaf(m, type, depth);
		say(m, ", ");
		leaf_or_constant(m, type, depth);
		say(m, ")");
		break;
	case 3: {
		const enum type from = type == T_REAL || type == T_LREAL ? any_number(m) :
			chance(m, 70) ? any_number(m) : chance(m, 50) ? T_REAL : T_LREAL;

		if (from == type) {
			leaf(m, type, depth);
			break;
		}
		say(m, "%s_TO_%s(", type_row[from].type, word);
		if (chance(m, 40))
			expr(m, from, depth - 1);
		else
			variable(m, from);
		say(m, ")");
		break;
	}
	case 4:
		say(m, "MUX(%s, ", chance(m, 50) ? "us2 MOD 3" : "i1");
		leaf(m, type, depth);
		say(m, ", ");
		leaf_or_constant(m, type, depth);
		say(m, ")");
		break;
	default:
		if (type == T_REAL || type == T_LREAL || (type >= T_SINT && type <= T_LINT)) {
			say(m, "ABS(");
			leaf(m, type, depth);
			say(m, ")");
		} else {
			leaf(m, type, depth);
		}
		break;
	}
}

static void own_call(struct maker *m, int depth)
{
	if (chance(m, 20)) {
		say(m, "Reckon(A := ");
		leaf(m, T_INT, depth);
		say(m, ", ");
		if (chance(m, 60)) {
			say(m, "EN := ");
			leaf(m, T_BOOL, depth);
			say(m, ", ");
		}
		say(m, "B := ");
		leaf_or_constant(m, T_INT, depth);
		if (chance(m, 60))
			say(m, ", Rest => %s", one_of(m, (const char *const[]){ "i2", "aj[3]", "pt2.x", "lw1.%W2", "dw1.%W1", NULL }, 6));
		say(m, "%s)", chance(m, 50) ? ", ENO => b3" : chance(m, 30) ? ", ENO => w1.7" : "");
	} else if (chance(m, 50)) {
		say(m, "Reckon(");
		leaf_or_constant(m, T_INT, depth);
		say(m, ", ");
		leaf(m, T_INT, depth);
		say(m, ")");
	} else {
		say(m, "Reckon(B := ");
		leaf(m, T_INT, depth);
		say(m, ", A := ");
		leaf_or_constant(m, T_INT, depth);
		say(m, ")");
	}
}

static void text_expr(struct maker *m, int depth)
{
	switch (below(m, 4)) {
	case 0:
		say(m, "CONCAT(");
		variable(m, T_STRING);
		say(m, ", ");
		leaf_or_constant(m, T_STRING, depth);
		say(m, ")");
		break;
	case 1:
		say(m, "%s(", chance(m, 50) ? "LEFT" : "RIGHT");
		variable(m, T_STRING);
		say(m, ", %s)", chance(m, 50) ? "3" : "i1");
		break;
	case 2:
		say(m, "MID(");
		variable(m, T_STRING);
		say(m, ", %s, 2)", chance(m, 50) ? "3" : "us2");
		break;
	default:
		leaf_or_constant(m, T_STRING, depth);
		break;
	}
}

static void expr(struct maker *m, enum type type, int depth)
{
	static const char *const whole[] = { "+", "-", "*", "/", "MOD", "+", "-" };
	static const char *const real[] = { "+", "-", "*", "/" };
	static const char *const bits[] = { "AND", "OR", "XOR" };

	if (depth <= 0) {
		leaf(m, type, depth);
		return;
	}
	if (type == T_BOOL) {
		bool_expr(m, depth);
	} else if (type == T_STRING) {
		text_expr(m, depth);
	} else if (type == T_COLOUR || type == T_MODE || type == T_DATE) {
		leaf(m, type, depth);
	} else if (type == T_TOD || type == T_DT) {
		leaf(m, type, depth);
		say(m, " %s ", chance(m, 50) ? "+" : "-");
		leaf_or_constant(m, T_TIME, depth);
	} else if (type == T_TIME && chance(m, 20)) {
		const enum type dated = T_DATE + (enum type)below(m, 3);

		say(m, "(");
		leaf(m, dated, depth);
		say(m, " - ");
		variable(m, dated);
		say(m, ")");
	} else if (type >= T_BYTE && type <= T_LWORD) {
		if (chance(m, 20)) {
			say(m, "NOT ");
			leaf(m, type, depth);
		} else if (chance(m, 25)) {
			say(m, "%s(", one_of(m, (const char *const[]){ "SHL", "SHR", "ROL", "ROR", NULL }, 5));
			leaf(m, type, depth);
			say(m, ", %s)", chance(m, 50) ? "3" : "us2");
		} else {
			two(m, type, PICK(m, bits), depth);
		}
	} else if (type == T_TIME) {
		if (chance(m, 40)) {
			variable(m, T_TIME);
			say(m, " %s ", chance(m, 50) ? "*" : "/");
			leaf(m, chance(m, 50) ? T_INT : T_REAL, depth);
		} else {
			two(m, type, chance(m, 50) ? "+" : "-", depth);
		}
	} else if (chance(m, 25)) {
		called(m, type, depth);
	} else if (type == T_DINT && m->room >= ROOM_BLOCK && chance(m, 12)) {
		say(m, "Carry(");
		leaf_or_constant(m, T_INT, depth);
		say(m, ", %s, %s)", one_of(m, (const char *const[]){ "i2", "aj[k1]", "pt2.x", NULL }, 4),
		    chance(m, 50) ? "ai" : "aj");
	} else if (type == T_DINT && m->room >= ROOM_BLOCK && chance(m, 10)) {
		say(m, "Sum(%s)", one_of(m, (const char *const[]){ "ai", "aj", "pt1.row", "pts[k1].row", "two[1]", NULL }, 6));
	} else if (type == T_INT && m->room >= ROOM_BLOCK && chance(m, 5)) {
		say(m, "Turn(%s, us2)", one_of(m, (const char *const[]){ "ai", "aj", "pt1.row", "two[2]", NULL }, 5));
	} else if (type == T_INT && m->room >= ROOM_BLOCK && chance(m, 15)) {
		own_call(m, depth);
	} else if (type == T_INT && chance(m, 8)) {
		say(m, "LEN(");
		variable(m, T_STRING);
		say(m, ")");
	} else if (chance(m, 8) && (type < T_USINT || type > T_ULINT)) {
		say(m, "-");
		leaf(m, type, depth);
	} else if (type == T_REAL || type == T_LREAL) {
		two(m, type, PICK(m, real), depth);
	} else {
		two(m, type, PICK(m, whole), depth);
	}
}

/* ---- statements ---- */

static void statements(struct maker *m, int depth, int count, int indent);

static void tab(struct maker *m, int indent)
{
	say(m, "%*s", indent * 2, "");
}

/* A place of the type that may be written. */
static void target(struct maker *m, enum type type)
{
	static const int writable[TYPES] = { 4, 3, 8, 4, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 2, 3, 2, 1, 2, 2, 2 };

	if (chance(m, 30) && element(m, type, 2))
		return;
	if (chance(m, 20) && type == T_STRING) {
		letter(m);
		return;
	}
	if (chance(m, 10) && (type == T_INT || type == T_DINT || type == T_STRING)) {
		say(m, "%s", type == T_INT ? chance(m, 50) ? "pi^" : "pp^.x" : type == T_STRING ? "pp^.tag" :
		    chance(m, 50) ? "rd" : "pp^.y");
		return;
	}
	if (chance(m, 10) && (type == T_BOOL || type == T_BYTE || type == T_WORD)) {
		say(m, "%s", type == T_BOOL ? one_of(m, (const char *const[]){ "w1.15", "i2.%X15", "dw1.7", "lw1.63", "dw2.%W1.%X9", "lw2.%D1.%B2.7", NULL }, 7) :
		    type == T_BYTE ? one_of(m, (const char *const[]){ "dw1.%B3", "w2.%B0", "i3.%B1", "lw1.%D1.%W0.%B1", NULL }, 5) :
		    one_of(m, (const char *const[]){ "dw1.%W1", "lw2.%W3", "d2.%W0", NULL }, 4));
		return;
	}
	if (m->room == ROOM_FUNCTION && type == T_INT && chance(m, 60))
		say(m, "%s", chance(m, 50) ? "Reckon" : "Own");
	else if (m->room == ROOM_BLOCK && type == T_INT && chance(m, 60))
		say(m, "%s", chance(m, 50) ? "Kept" : "Half");
	else if (m->room == ROOM_BLOCK && type == T_UINT && chance(m, 60))
		say(m, "Total");
	else if (type == T_UINT)
		say(m, "%s", chance(m, 50) ? "ui1" : "ui2");
	else
		say(m, "%s", type_row[type].name[below(m, (uint32_t)writable[type])]);
}

static bool is_whole(enum type type)
{
	return (type >= T_SINT && type <= T_ULINT) || (type >= T_BYTE && type <= T_LWORD);
}

static void assignment(struct maker *m)
{
	static const char *const whole[] = {
		"ai := aj", "aj := ai", "ad := ae", "ae := ad", "pt1 := pt2", "pt2 := pt1", "pt1 := pts[k1]",
		"pts[i1] := pt2", "pts[2] := pts[us2]", "pt1.row := pts[1].row", "ad[1] := ae[k1]",
		"pt1 := pp^", "pp^ := pt2", "pp^ := pts[k1]", "pts[i1] := pp^", "pt2.row := pp^.row", "pp^.row := pts[2].row",
		"pi := REF(i4)", "pi := ADR(aj[k1 MOD 5 + 1])", "pi := REF(pt1.x)", "pi := REF(pts[us2 MOD 5].row[2])", "pi := REF(pp^.x)",
		"pp := REF(pt2)", "pp := ADR(pts[i1 MOD 3 + 1])", "pp := ADR(pts[2])", "rd REF= d3", "rd REF= ad[1, k1 MOD 2]", "rd REF= pp^.y",
		"pi := REF(k1)", "rd REF= k4", "rd REF= rd",
		"pi ?= REF(i4)", "pi ?= pq", "pq ?= pi", "pq ?= pr", "pr ?= REF(r1)", "pr ?= pq", "pi ?= NULL", "pq ?= REF(aj[k1 MOD 5 + 1])",
		"i4 := i2 := i1 + 1", "k1 := ai[k1] := aj[2] := i3", "d3 := d1 := i4 * 1000", "pt1 := pts[2] := pt2", "r1 := i2 := s1", "st1 := st2 := 'xyz'",
		"dw1.%B1 := by2 := by1", "ai[i1] := pi^ := i4 / i2", "st1[2] := st2[1] := 'q'", "p1 := p2 := i3",
		"ae[d3] := ad[0]", "pts[k1] := pts[i1]", "ar[0] := ar[1]", "ar[k1, 1] := ar[0][2]",
	};
	const enum type type = (enum type)below(m, TYPES);

	if (chance(m, 8)) {
		say(m, "%s;\n", PICK(m, whole));
		return;
	}
	target(m, type);
	say(m, " := ");
	if (is_whole(type) && chance(m, 4))
		expr(m, T_BOOL, 2); /* 0 or 1 */
	else if (is_whole(type) && chance(m, 3))
		say(m, "(100 %s %d) MOD 60 + 9", one_of(m, (const char *const[]){ "+", "-", "*", "/" }, 4),
		    1 + (int)below(m, 300));
	else if (chance(m, 15))
		leaf_or_constant(m, type, 2);
	else
		expr(m, type, 1 + (int)below(m, 3));
	say(m, ";\n");
}

static void if_of(struct maker *m, int depth, int indent)
{
	say(m, "IF ");
	expr(m, T_BOOL, 2);
	say(m, " THEN\n");
	statements(m, depth - 1, 2, indent + 1);
	while (chance(m, 35)) {
		tab(m, indent);
		say(m, "ELSIF ");
		expr(m, T_BOOL, 2);
		say(m, " THEN\n");
		statements(m, depth - 1, 2, indent + 1);
	}
	if (chance(m, 50)) {
		tab(m, indent);
		say(m, "ELSE\n");
		statements(m, depth - 1, 2, indent + 1);
	}
	tab(m, indent);
	say(m, "END_IF;\n");
}

static void case_of(struct maker *m, int depth, int indent)
{
	static const char *const numbers[] = { "0", "1, 2", "3..6", "7..7, 9", "-5..-1", "10..100", "-32768..-20", "32767", "150, 151..160" };
	static const char *const colours[] = { "Red", "Green", "Colour#Blue" };
	static const char *const modes[] = { "Mode#Off", "Slow", "Fast" };
	const uint32_t kind = below(m, 5);
	const char *const *list = kind == 0 ? colours : kind == 1 ? modes : numbers;
	const int most = kind < 2 ? 3 : 9;

	say(m, "CASE ");
	if (kind < 2)
		variable(m, kind == 0 ? T_COLOUR : T_MODE);
	else if (kind == 2)
		expr(m, T_INT, 2);
	else
		leaf(m, kind == 3 ? T_DINT : T_INT, 2);
	say(m, " OF\n");
	for (int i = (int)below(m, 2); i < most; i += 1 + (int)below(m, 3)) {
		tab(m, indent + 1);
		say(m, "%s:\n", list[i]);
		statements(m, depth - 1, 2, indent + 2);
	}
	if (chance(m, 50)) {
		tab(m, indent);
		say(m, "ELSE\n");
		statements(m, depth - 1, 2, indent + 2);
	}
	tab(m, indent);
	say(m, "END_CASE;\n");
}

static void for_of(struct maker *m, int depth, int indent)
{
	static const struct { const char *variable; enum type type; const char *limits[6]; } rows[] = {
		{ "k1", T_INT, { "1 TO 5", "5 TO 1 BY -1", "32765 TO 32767", "-32766 TO -32768 BY -2", "1 TO 0", "0 TO 10 BY 3" } },
		{ "k2", T_SINT, { "120 TO 127", "-120 TO -128 BY -3", "-2 TO 2", "1 TO 3 BY 2" } },
		{ "k3", T_USINT, { "250 TO 255", "0 TO 4", "254 TO 255 BY 7" } },
		{ "k4", T_DINT, { "2147483646 TO 2147483647", "-1 TO 1", "0 TO 3" } },
		{ "k5", T_UINT, { "65533 TO 65535", "1 TO 2" } },
		{ "k6", T_INT, { "97 TO 100", "3 TO 0 BY -1", "1 TO 4" } },
		{ "k7", T_LINT, { "9223372036854775806 TO 9223372036854775807", "0 TO 2", "-9223372036854775807 TO -9223372036854775808 BY -1" } },
	};
	const uint32_t row = below(m, sizeof(rows) / sizeof(*rows));

	say(m, "FOR %s := ", rows[row].variable);
	if (chance(m, 60)) {
		say(m, "%s", one_of(m, rows[row].limits, 6));
	} else {
		static const char *const by[] = { "1", "-1", "2", "k1", "i1", "i4" };
		static const char *const to[] = { "us2 / 8", "i1 MOD 9", "ai[i1] / 7", "i1 / i4 MOD 5", "i2 + 10", "3", "p1 / 9" };

		if (rows[row].type == T_INT || rows[row].type == T_DINT || rows[row].type == T_LINT) {
			say(m, "%s TO %s", chance(m, 50) ? PICK(m, to) : "1", PICK(m, to));
			if (chance(m, 50))
				say(m, " BY %s", PICK(m, by));
		} else if (rows[row].type == T_SINT) {
			say(m, "0 TO s1 / 20");
		} else {
			say(m, "us2 TO us1 MOD 16");
		}
	}
	say(m, " DO\n");
	m->loops++;
	statements(m, depth - 1, 2, indent + 1);
	if (chance(m, 4)) {
		tab(m, indent + 1);
		say(m, "%s := %s + 1;\n", rows[row].variable, rows[row].variable);
	}
	m->loops--;
	tab(m, indent);
	say(m, "END_FOR;\n");
}

/* A counter ends the loop at the latest. */
static void while_of(struct maker *m, int depth, int indent)
{
	const int counter = ++m->whiles;
	const bool repeat = chance(m, 50);

	say(m, "g%d := 0;\n", counter);
	tab(m, indent);
	if (repeat) {
		say(m, "REPEAT\n");
	} else {
		say(m, "WHILE (g%d < %d) AND ", counter, 1 + (int)below(m, 6));
		expr(m, T_BOOL, 2);
		say(m, " DO\n");
	}
	tab(m, indent + 1);
	say(m, "g%d := g%d + 1;\n", counter, counter);
	m->loops++;
	statements(m, depth - 1, 2, indent + 1);
	m->loops--;
	m->whiles--;
	tab(m, indent);
	if (repeat) {
		say(m, "UNTIL (g%d >= %d) OR ", counter, 1 + (int)below(m, 6));
		expr(m, T_BOOL, 2);
		say(m, "\n");
		tab(m, indent);
	}
	say(m, repeat ? "END_REPEAT;\n" : "END_WHILE;\n");
}

static void more_calls(struct maker *m)
{
	static const struct { const char *begin, *end; } calls[] = {
		{ "late(IN := ", ", PT := T#4ms, Q => b1)" }, { "pulse(", ", T#6ms)" },
		{ "down(CD := ", ", LD := nb, PV := 3, CV => i4)" }, { "latch(", ", b3)" },
		{ "clear(S := b1, R1 := ", ", Q1 => ab[k1])" }, { "fall(CLK := ", ", Q => b2)" },
	};
	const uint32_t i = below(m, sizeof(calls) / sizeof(*calls));

	say(m, "%s", calls[i].begin);
	expr(m, T_BOOL, 2);
	say(m, "%s;\n", calls[i].end);
}

static void split_of(struct maker *m)
{
	const uint32_t kind = below(m, 3);

	say(m, "SPLIT_%s(", kind == 0 ? "DATE" : kind == 1 ? "TOD" : "DT");
	if (chance(m, 50)) {
		expr(m, T_DATE + (enum type)kind, 1);
		say(m, ", i4, d3%s);\n", chance(m, 50) ? ", by2" : ", aj[k1]");
	} else {
		say(m, "%s => %s, IN := ", kind == 1 ? "MINUTE" : "YEAR", one_of(m, (const char *const[]){ "i2", "us2", "w1", "p1", "ai[k1]", NULL }, 6));
		expr(m, T_DATE + (enum type)kind, 1);
		say(m, "%s);\n", kind == 2 ? ", MILLISECOND => s1, SECOND => lw1" : "");
	}
}

static void program_of(struct maker *m)
{
	if (chance(m, 30)) {
		say(m, "Side();\n");
		return;
	}
	say(m, "Side(Add := ");
	expr(m, T_INT, 2);
	if (chance(m, 50)) {
		say(m, ", On := ");
		expr(m, T_BOOL, 1);
	}
	say(m, "%s);\n", chance(m, 50) ? ", All => i4, Half => ad[1, 0]" : chance(m, 50) ? ", All => aj[k1]" : "");
}

/* A block with ARRAY[*]: each instance gets arrays of one size. */
static void roll(struct maker *m)
{
	const char *row = NULL;

	switch (below(m, 3)) {
	case 0:
		say(m, "roll1(");
		row = chance(m, 50) ? "ai" : "aj";
		break;
	case 1:
		say(m, "roll2(");
		row = chance(m, 50) ? "two[1]" : "two[k1]";
		break;
	default:
		say(m, "rolls[");
		index_of(m, 1, 2, 2);
		say(m, "](");
		row = chance(m, 50) ? "pt1.row" : "pts[k1].row";
		break;
	}
	say(m, "%sStep := ", chance(m, 30) ? "EN := b2, " : "");
	expr(m, T_INT, 2);
	say(m, ", Row := %s%s);\n", row, chance(m, 60) ? ", All => d1" : "");
}

static void call_of(struct maker *m)
{
	if (chance(m, 8)) {
		split_of(m);
		return;
	}
	if (m->room == ROOM_MAIN && !m->chart && chance(m, 10)) {
		program_of(m);
		return;
	}
	if (m->room != ROOM_BLOCK && chance(m, 25)) {
		more_calls(m);
		return;
	}
	switch (below(m, m->room == ROOM_BLOCK ? 3 : 7)) {
	case 0:
		say(m, m->room == ROOM_BLOCK ? "Inner" : "wait");
		say(m, "(IN := ");
		expr(m, T_BOOL, 2);
		say(m, ", PT := ");
		leaf_or_constant(m, T_TIME, 1);
		say(m, "%s);\n", chance(m, 50) ? ", Q => b1, ET => t1" : chance(m, 50) ? ", Q => ab[k1]" :
		    chance(m, 50) ? ", Q => w1.3" : "");
		break;
	case 1:
		if (m->room == ROOM_BLOCK) {
			say(m, "Reckon(Kept, 5);\n");
			break;
		}
		say(m, "count(");
		expr(m, T_BOOL, 2);
		say(m, ", b3, ");
		leaf_or_constant(m, T_INT, 1);
		say(m, ");\n");
		break;
	case 2:
		if (m->room == ROOM_BLOCK) {
			say(m, "Inner(IN := FALSE);\n");
			break;
		}
		say(m, "edge(CLK := ");
		expr(m, T_BOOL, 2);
		say(m, ", Q => b2);\n");
		break;
	case 3:
		say(m, "waits[");
		index_of(m, 1, 2, 2);
		say(m, "](IN := ");
		expr(m, T_BOOL, 1);
		say(m, ", PT := T#3ms, Q => %s);\n", chance(m, 50) ? "b3" : chance(m, 60) ? "ab[k1]" : "aj[k1].%X5");
		break;
	case 4:
		if (m->room == ROOM_MAIN) {
			say(m, chance(m, 50) ? "Start();\n" : "Start;\n");
			break;
		}
		say(m, "wait();\n");
		break;
	default:
		if (m->room >= ROOM_ROUTINE && chance(m, 30)) {
			roll(m);
			break;
		}
		if (chance(m, 50)) {
			say(m, "mix%d", 1 + (int)below(m, 2));
		} else {
			say(m, "mixes[");
			index_of(m, 0, 1, 2);
			say(m, chance(m, 50) ? ", " : "][");
			index_of(m, 1, 2, 2);
			say(m, "]");
		}
		say(m, "(%s", chance(m, 30) ? "EN := b2, " : "");
		say(m, "Add := ");
		expr(m, T_INT, 2);
		say(m, ", Both := ");
		say(m, "%s", one_of(m, (const char *const[]){ "i4", "ai[2]", "aj[k1]", "pt1.x", NULL }, 5));
		say(m, "%s);\n", chance(m, 60) ? ", Half => i2, Total => ui1" : "");
		break;
	}
}

static void leave(struct maker *m)
{
	if (m->loops > 0 && chance(m, 80))
		say(m, chance(m, 50) ? "EXIT;\n" : "CONTINUE;\n");
	else
		say(m, "RETURN;\n");
}

/* A jump forward to a label, over some statements; or back, a few times. */
static void jump_of(struct maker *m, int depth, int indent)
{
	const int label = ++m->labels;
	const bool back = m->room == ROOM_MAIN && m->whiles < 4 && chance(m, 40);
	const int counter = back ? ++m->whiles : 0;

	if (back) {
		say(m, "g%d := 0;\n", counter);
		tab(m, indent);
		say(m, "L%d:\n", label);
		tab(m, indent);
		say(m, "g%d := g%d + 1;\n", counter, counter);
	} else {
		say(m, "IF ");
		expr(m, T_BOOL, 1);
		say(m, " THEN\n");
		tab(m, indent + 1);
		say(m, "JMP L%d;\n", label);
		tab(m, indent);
		say(m, "END_IF;\n");
	}
	statements(m, depth - 1, 3, indent);
	tab(m, indent);
	if (back) {
		say(m, "IF (g%d < %d) AND ", counter, 1 + (int)below(m, 4));
		expr(m, T_BOOL, 1);
		say(m, " THEN\n");
		tab(m, indent + 1);
		say(m, "JMP l%d;\n", label);
		tab(m, indent);
		say(m, "END_IF;\n");
		m->whiles--;
		return;
	}
	say(m, "L%d:\n", label);
	tab(m, indent);
	assignment(m);
}

static void statement(struct maker *m, int depth, int indent)
{
	const uint32_t kind = below(m, 100);

	tab(m, indent);
	if (depth > 0 && kind < 15)
		if_of(m, depth, indent);
	else if (depth > 0 && kind < 25)
		case_of(m, depth, indent);
	else if (depth > 0 && kind < 37)
		for_of(m, depth, indent);
	else if (depth > 0 && kind < 45 && m->whiles < 4 && m->room == ROOM_MAIN)
		while_of(m, depth, indent);
	else if (depth > 0 && kind < 49)
		jump_of(m, depth, indent);
	else if (kind < 59 && m->room != ROOM_FUNCTION)
		call_of(m);
	else if (kind < 60)
		say(m, ";\n");
	else if (kind < 64 && depth < 3) {
		say(m, "IF ");
		expr(m, T_BOOL, 1);
		say(m, " THEN ");
		leave(m);
		tab(m, indent);
		say(m, "END_IF;\n");
	} else
		assignment(m);
}

static void statements(struct maker *m, int depth, int count, int indent)
{
	for (int i = 0; i < 1 + (int)below(m, (uint32_t)count); i++)
		statement(m, depth, indent);
}

/* The globals; now and then some arrays lie at an address. */
static void say_globals(struct maker *m)
{
	static const struct { const char *name, *at; } arrays[] = {
		{ " ai :", "%MW100" }, { " aj :", "%MW120" }, { " ad :", "%MD140" }, { " ae :", "%MD180" },
		{ " ab :", "%MX220.3" }, { " two :", "%MW230" },
	};
	const char *from = globals;
	const bool any = chance(m, 30);

	for (size_t i = 0; i < sizeof(arrays) / sizeof(*arrays) && any; i++) {
		const char *at = strstr(from, arrays[i].name);

		if (!at || !chance(m, 50))
			continue;
		at += strlen(arrays[i].name) - 1;
		say(m, "%.*sAT %s ", (int)(at - from), from, arrays[i].at);
		from = at;
	}
	say(m, "%s", from);
}

size_t st_random_print(uint64_t seed, char *out, size_t size)
{
	struct maker m = { .out = out, .size = size };

	random_seed(&m.source, seed);
	say(&m, "%s", types);
	say_globals(&m);
	m.room = ROOM_FUNCTION;
	say(&m, "FUNCTION Reckon : INT ST\nVAR_INPUT\n  A : INT;\n  B : INT;\nEND_VAR\nVAR_OUTPUT\n  Rest : INT;\nEND_VAR\nVAR\n  Own : INT := 3;\nEND_VAR\n"
		"  Reckon := A * 2 - B;\n  Rest := A / 2;\n");
	statements(&m, 1, 3, 1);
	if (chance(&m, 20))
		say(&m, "  ENO := A <> B;\n");
	say(&m, "END_FUNCTION\n\nFUNCTION Carry : DINT ST\nVAR_INPUT\n  By : INT;\nEND_VAR\nVAR_IN_OUT\n  One : INT;\n  Row : ARRAY[1..5] OF INT;\nEND_VAR\n"
		"  Carry := One;\n  Row[By] := One;\n  One := By + i4;\n");
	say(&m, "END_FUNCTION\n\nFUNCTION Sum : DINT ST\nVAR_INPUT\n  Row : ARRAY[*] OF INT;\nEND_VAR\nVAR\n  n : DINT;\nEND_VAR\n"
		"  FOR n := LOWER_BOUND(Row, 1) TO UPPER_BOUND(Row, 1) DO\n    Sum := Sum + Row[n];\n  END_FOR;\n"
		"END_FUNCTION\n\nFUNCTION Turn : INT ST\nVAR_IN_OUT\n  Row : ARRAY[*] OF INT;\nEND_VAR\nVAR_INPUT\n  Place : USINT;\nEND_VAR\n"
		"  Turn := Row[Place];\n  Row[UPPER_BOUND(Row, 1)] := Row[LOWER_BOUND(Row, 1)];\n");
	say(&m, "END_FUNCTION\n\nFUNCTION_BLOCK Mix ST\nVAR_INPUT\n  Add : INT := 2;\nEND_VAR\nVAR_IN_OUT\n  Both : INT;\nEND_VAR\n"
		"VAR_OUTPUT\n  Half : INT;\n  Total : UINT;\nEND_VAR\nVAR\n  Kept : INT;\n  Inner : TON;\nEND_VAR\n"
		"VAR_TEMP\n  Fresh : INT := 4;\nEND_VAR\n"
		"  Both := Both + Add;\n  Kept := Kept + Fresh;\n  Fresh := Fresh + 1;\n  Half := Add / 2;\n");
	m.room = ROOM_BLOCK;
	statements(&m, 2, 3, 1);
	say(&m, "END_FUNCTION_BLOCK\n\nFUNCTION_BLOCK Roll ST\nVAR_INPUT\n  Step : INT := 1;\nEND_VAR\nVAR_IN_OUT\n  Row : ARRAY[*] OF INT;\nEND_VAR\n"
		"VAR_OUTPUT\n  All : DINT;\nEND_VAR\nVAR\n  n : DINT;\n  Calls : INT;\nEND_VAR\n"
		"  Calls := Calls + 1;\n  All := Calls;\n  FOR n := LOWER_BOUND(Row, 1) TO UPPER_BOUND(Row, 1) DO\n"
		"    Row[n] := Row[n] + Step * Calls;\n    All := All + Row[n];\n  END_FOR;\n");
	say(&m, "END_FUNCTION_BLOCK\n\nSUBROUTINE Start ST\nVAR\n  Starts : INT;\nEND_VAR\n  Starts := Starts + 1;\n");
	m.room = ROOM_ROUTINE;
	statements(&m, 1, 3, 1);
	say(&m, "END_SUBROUTINE\n\nPROGRAM Side ST\nVAR_INPUT\n  Add : INT := 1;\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  All : INT;\n  Half : DINT;\nEND_VAR\n"
		"VAR_TEMP\n  Fresh : INT := 2;\nEND_VAR\n"
		"  All := All + Add + Fresh;\n  Fresh := 9;\n  Half := All / 2;\n  IF On THEN\n    i4 := All;\n  END_IF;\n");
	const bool action = chance(&m, 25); /* of a chart whose step is always active */

	say(&m, action ? "END_PROGRAM\n\nPROGRAM Main SFC\n  INITIAL_STEP Always:\n    Do(N);\n  END_STEP\n  ACTION Do:\n" :
		"END_PROGRAM\n\nPROGRAM Main ST\n");
	m.room = ROOM_MAIN;
	m.chart = action;
	if (chance(&m, 75))
		say(&m, "  pi := REF(i4);\n  pp := REF(pts[us2 MOD 3 + 1]);\n  rd REF= d3;\n");
	statements(&m, 3, 7, 1);
	say(&m, "%s  Start();\n%sEND_PROGRAM\n", action ? "" : "  Side(Add := 1);\n", action ? "  END_ACTION\n" : "");
	return m.used;
}
