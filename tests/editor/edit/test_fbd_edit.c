/* SPDX-License-Identifier: MIT
 *
 * test_fbd_edit - edits of networks: known ones by their text, thousands of random ones by invariants: the
 * lines can be read again, are canonical, and a line that an edit does not touch stays as it is.
 */
#include "editor-gtk/edit/fbd_edit.h"
#include "editor-gtk/edit/fbd_instances.h"
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

#define ROUNDS 400
#define EDITS  25

static struct ladder *ladder;
static struct fbd_edit *edit;
static char *now;

static const char declared[] =
	"RUNGBOARD 1\n\nPROGRAM Main FBD\nVAR\n  Level, Raw, Tare, Weight : REAL;\n"
	"  Stop, Ready, Valve, Horn, A, B, C : BOOL;\n  Delay, Late : TON;\n  N : INT;\n  T : ARRAY[0..9] OF INT;\nEND_VAR\nEND_PROGRAM\n\n"
	"PROGRAM Other FBD\nVAR\n  A : BOOL;\n  Delay, Late : TON;\nEND_VAR\nNETWORK\n  Delay(IN := A)\nEND_PROGRAM\n\n"
	"FUNCTION_BLOCK Belt FBD\nVAR\n  Delay : TON;\nEND_VAR\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Members FBD\nVAR\n  A : BOOL;\n  Delay : TON;\n  Line : ARRAY[1..2] OF Belt;\nEND_VAR\nNETWORK\n"
	"  A := Line[1].Delay.Q\n  Line[2].Delay(IN := A)\nEND_PROGRAM\n";

static void keep(void)
{
	free(now);
	now = fbd_edit_text(edit);
}

static void begin(const char *lines)
{
	fbd_edit_free(edit);
	edit = fbd_edit_new(ladder_project(ladder), 0, lines, strlen(lines));
	keep();
}

static struct fbd_spot in(int statement, int box, int number, const char *pin)
{
	return (struct fbd_spot){ statement, box, pin, number, false };
}

static struct fbd_spot out(int statement, int box, const char *pin)
{
	return (struct fbd_spot){ statement, box, pin, 0, true };
}

#define EDIT(call, expected) do { \
	edit->why = NULL; \
	CHECK_AS((call), #call); \
	if (edit->why) \
		printf("# %s\n", edit->why); \
	keep(); \
	CHECK_TEXT(now, expected); \
} while (0)
#define REFUSED(call, reason) do { \
	edit->why = NULL; \
	CHECK_AS(!(call), #call " is refused"); \
	CHECK_TEXT(edit->why ? edit->why : "", reason); \
} while (0)

/* ---- reading ---- */

static void check_lines(void)
{
	static const char text[] =
		"  // levels\n"
		"  Low := LT(IN1 := Level,   IN2 := 20.0)  // low\n"
		"  Delay(IN := Low AND NOT Stop, PT := T#3s)  { at 3,1 }\n"
		"\n"
		"  Valve := Delay.Q\n"
		"  Horn S= A OR B AND C\n"
		"  Horn R= T[N + 1] > 3\n"
		"  JMP Fill IF Low\n"
		"  RETURN\n"
		"  this is nothing )\n";

	begin(text);
	CHECK_TEXT(now, text);
	CHECK(fbd_edit_statements(edit) == 8);
	CHECK(edit->net.line[2]->column == 3 && edit->net.line[2]->row == 1);
	begin("Low := A; Valve := Low; // both\n");
	CHECK(fbd_edit_statements(edit) == 2);
	CHECK_TEXT(edit->net.line[1]->notes, "  // both");
	begin("");
	CHECK_TEXT(now, "");
}

/* A line in canonical form, which keeps what it means. */
static void check_forms(void)
{
	static const struct { const char *line, *is; } forms[] = {
		{ "W := A AND B AND C", "  W := A AND B AND C\n" },
		{ "W := A&B", "  W := A & B\n" },
		{ "W := A AND (B AND C)", "  W := A AND (B AND C)\n" },
		{ "W := (A OR B) AND C", "  W := (A OR B) AND C\n" },
		{ "W := NOT (A OR B)", "  W := NOT (A OR B)\n" },
		{ "W := -Level * -2.0 - (Raw - Tare)", "  W := -Level * -2.0 - (Raw - Tare)\n" },
		{ "W := Raw - Tare - Level", "  W := Raw - Tare - Level\n" },
		{ "W := AND(IN1:=A,IN2:=)", "  W := AND(IN1 := A, IN2 :=)\n" },
		{ "Delay(Q=>Valve,IN:=NOT A)", "  Delay(Q => Valve, IN := NOT A)\n" },
		{ "Delay(not Q=>Valve)", "  Delay(NOT Q => Valve)\n" },
		{ "W := SUB(EN:=A, 3, N, NOT ENO=>Horn)", "  W := SUB(EN := A, 3, N, NOT ENO => Horn)\n" },
		{ "W := LIMIT(0,N,\n 10)", "  W := LIMIT(0, N, 10)\n" },
		{ "T[N+1] := T[ 2 ]", "  T[N+1] := T[ 2 ]\n" },
		{ "W := A (* why *) OR B", "  W := A OR B  (* why *)\n" },
	};

	for (size_t i = 0; i < sizeof(forms) / sizeof(*forms); i++) {
		begin(forms[i].line);
		edit->net.line[0]->changed = true;
		keep();
		CHECK_TEXT(now, forms[i].is);
	}
}

/* ---- pins ---- */

static void check_inverted_outputs(void)
{
	struct fbd_spot spot = out(0, 0, "Q"), to;

	begin("  Delay(IN := A, Q => Horn)\n");
	EDIT(fbd_edit_negate(edit, &spot), "  Delay(IN := A, NOT Q => Horn)\n");
	EDIT(fbd_edit_negate(edit, &spot), "  Delay(IN := A, Q => Horn)\n");
	begin("  Delay(A, T#1s, Horn)\n");
	EDIT(fbd_edit_negate(edit, &spot), "  Delay(IN := A, PT := T#1s, NOT Q => Horn)\n");
	begin("  Delay(IN := A)\n");
	REFUSED(fbd_edit_negate(edit, &spot), "Nothing is connected here.");
	begin("  B := Delay.Q\n  Delay(IN := A)\n  Horn := Delay.Q OR C\n  Valve := NOT Delay.Q\n");
	spot = out(1, 0, "Q");
	EDIT(fbd_edit_negate(edit, &spot),
	     "  B := Delay.Q\n  Delay(IN := A, NOT Q => Wire1)\n  Horn := Wire1 OR C\n  Valve := NOT Wire1\n");
	EDIT(fbd_edit_negate(edit, &spot),
	     "  B := Delay.Q\n  Delay(IN := A, Q => Wire1)\n  Horn := Wire1 OR C\n  Valve := NOT Wire1\n");
	begin("  Delay(IN := A, NOT Q => Horn)\n  Valve := B\n"); /* a wire from there begins behind the circle */
	spot = out(0, 0, "Q");
	to = in(1, 0, 0, "");
	EDIT(fbd_edit_join(edit, &spot, &to), "  Delay(IN := A, NOT Q => Horn)\n  Valve := Horn\n");
	begin("  W := SUB(EN := A, IN1 := N, IN2 := 1, ENO => Horn)\n");
	spot = out(0, 0, "ENO");
	EDIT(fbd_edit_negate(edit, &spot), "  W := SUB(EN := A, IN1 := N, IN2 := 1, NOT ENO => Horn)\n");
	spot = out(0, 0, "OUT");
	REFUSED(fbd_edit_negate(edit, &spot), "A result is negated at the inputs that read it.");
	begin("  Horn := A AND B\n");
	spot = out(0, 0, "");
	REFUSED(fbd_edit_negate(edit, &spot), "A result is negated at the inputs that read it.");
}

static void check_operands(void)
{
	struct fbd_spot spot;

	begin("  Low := LT(IN1 := Level, IN2 := 20.0)\n  Valve := Low AND NOT Stop\n");
	spot = in(0, 0, 1, "IN2");
	EDIT(fbd_edit_operand(edit, &spot, "Raw + 1.0"),
	     "  Low := LT(IN1 := Level, IN2 := Raw + 1.0)\n  Valve := Low AND NOT Stop\n");
	spot = in(0, 1, 1, "IN2");
	EDIT(fbd_edit_clear(edit, &spot),
	     "  Wire1 := Raw + 1.0\n  Low := LT(IN1 := Level, IN2 :=)\n  Valve := Low AND NOT Stop\n");
	spot = in(2, 0, 1, "");
	EDIT(fbd_edit_negate(edit, &spot),
	     "  Wire1 := Raw + 1.0\n  Low := LT(IN1 := Level, IN2 :=)\n  Valve := Low AND Stop\n");
	EDIT(fbd_edit_negate(edit, &spot),
	     "  Wire1 := Raw + 1.0\n  Low := LT(IN1 := Level, IN2 :=)\n  Valve := Low AND NOT Stop\n");
	EDIT(fbd_edit_add_input(edit, &spot),
	     "  Wire1 := Raw + 1.0\n  Low := LT(IN1 := Level, IN2 :=)\n"
	     "  Valve := AND(IN1 := Low, IN2 := NOT Stop, IN3 :=)\n");
	begin("  Valve := Low AND NOT Stop\n");
	spot = in(0, 1, 0, "");
	EDIT(fbd_edit_clear(edit, &spot), "  Wire1 := Low AND NOT Stop\n  Valve := MOVE(IN :=)\n");
	spot = in(1, 0, 0, "IN");
	EDIT(fbd_edit_operand(edit, &spot, "Wire1"), "  Wire1 := Low AND NOT Stop\n  Valve := Wire1\n");
	REFUSED(fbd_edit_operand(edit, &spot, "Wire1 +"),
		"This is not a value: type a name, a constant or an expression.");
	spot = out(1, 0, "");
	EDIT(fbd_edit_operand(edit, &spot, "Horn"), "  Wire1 := Low AND NOT Stop\n  Horn := Wire1\n");
	spot = out(0, 0, "");
	EDIT(fbd_edit_operand(edit, &spot, "Both"), "  Both := Low AND NOT Stop\n  Horn := Both\n");
	EDIT(fbd_edit_operand(edit, &spot, "Valve"),
	     "  Both := Low AND NOT Stop\n  Valve := Both\n  Horn := Both\n");
	begin("  Delay(A, T#3s)\n  RETURN IF Delay.Q\n");
	spot = out(0, 0, "Q");
	EDIT(fbd_edit_operand(edit, &spot, "Valve"),
	     "  Delay(IN := A, PT := T#3s, Q => Valve)\n  RETURN IF Delay.Q\n");
	spot = in(1, 0, 0, "");
	EDIT(fbd_edit_clear(edit, &spot), "  Delay(IN := A, PT := T#3s, Q => Valve)\n  RETURN\n");
	REFUSED(fbd_edit_clear(edit, &spot), "Nothing is connected here.");
}

static void check_joins(void)
{
	struct fbd_spot from, to;

	begin("  Valve := AND(IN1 :=, IN2 := A)\n  Low := LT(Level, 20.0)\n");
	from = out(1, 0, "OUT");
	to = in(0, 0, 0, "IN1");
	EDIT(fbd_edit_join(edit, &from, &to), "  Low := LT(Level, 20.0)\n  Valve := AND(IN1 := Low, IN2 := A)\n");
	/* A nested box, read by two. */
	begin("  Valve := A AND LT(Level, 20.0)\n  Horn := MOVE(IN :=)\n");
	from = out(0, 0, "OUT");
	to = in(1, 0, 0, "IN");
	EDIT(fbd_edit_join(edit, &from, &to),
	     "  Wire1 := LT(Level, 20.0)\n  Valve := A AND Wire1\n  Horn := Wire1\n");
	/* A loop is a value of the scan before. */
	from = out(1, 0, "");
	to = in(0, 0, 0, "IN1");
	EDIT(fbd_edit_join(edit, &from, &to),
	     "  Wire1 := LT(PREVIOUS(Wire2), 20.0)\n  Wire2 := A AND Wire1\n  Valve := Wire2\n"
	     "  Horn := Wire1\n");
	/* An output of an instance; its call comes before. */
	begin("  Valve := NOT A\n  Delay(IN := B)\n");
	from = out(1, 0, "Q");
	to = in(0, 0, 0, "");
	EDIT(fbd_edit_join(edit, &from, &to), "  Delay(IN := B)\n  Valve := NOT Delay.Q\n");
	from = out(1, 0, "");
	to = in(0, 0, 0, "IN");
	EDIT(fbd_edit_join(edit, &from, &to), "  Valve := NOT Delay.Q\n  Delay(IN := Valve)\n");
	/* ENO. */
	begin("  Weight := SUB(Raw, Tare)\n  Valve := A OR B\n");
	from = out(0, 0, "ENO");
	to = in(1, 0, 1, "");
	EDIT(fbd_edit_join(edit, &from, &to),
	     "  Weight := SUB(IN1 := Raw, IN2 := Tare, ENO => Wire1)\n  Valve := A OR Wire1\n");
	REFUSED(fbd_edit_join(edit, &to, &from), "A wire leads from an output to an input.");
}

/* ---- boxes ---- */

static void check_adding(void)
{
	struct fbd_spot spot;

	begin("");
	EDIT(fbd_edit_add(edit, -1, "AND", NULL), "  Wire1 := AND(IN1 :=, IN2 :=)\n");
	spot = out(0, 0, "");
	EDIT(fbd_edit_append(edit, &spot, "TON", "Delay"),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := Wire1)\n");
	spot = out(1, 0, "Q");
	EDIT(fbd_edit_append(edit, &spot, "NOT", NULL),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := Wire1)\n  Wire2 := NOT Delay.Q\n");
	CHECK(fbd_edit_made(edit) == 2);
	EDIT(fbd_edit_store(edit, &spot, FBD_LINE_SET, "Horn"),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := Wire1)\n  Horn S= Delay.Q\n  Wire2 := NOT Delay.Q\n");
	spot = in(1, 0, 0, "IN");
	EDIT(fbd_edit_insert(edit, &spot, "OR", NULL),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := OR(IN1 := Wire1, IN2 :=))\n"
	     "  Horn S= Delay.Q\n  Wire2 := NOT Delay.Q\n");
	spot = in(2, 0, 0, "");
	EDIT(fbd_edit_insert(edit, &spot, "TON", "Late"),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := OR(IN1 := Wire1, IN2 :=))\n"
	     "  Late(IN := Delay.Q)\n  Horn S= Late.Q\n  Wire2 := NOT Delay.Q\n");
	EDIT(fbd_edit_line(edit, 4, "Valve := Wire2 AND A"),
	     "  Wire1 := AND(IN1 :=, IN2 :=)\n  Delay(IN := OR(IN1 := Wire1, IN2 :=))\n"
	     "  Late(IN := Delay.Q)\n  Horn S= Late.Q\n  Wire2 := NOT Delay.Q\n  Valve := Wire2 AND A\n");
	REFUSED(fbd_edit_line(edit, 4, "IF a THEN"),
		"This is not a line of a network: type a box, or target := value.");
}

static void check_removing(void)
{
	struct fbd_spot spot, both[2];

	begin("  W := A AND LT(Level, 20.0)\n  Valve := W OR B\n  Horn := W\n");
	spot = out(0, 1, "");
	EDIT(fbd_edit_remove(edit, &spot, 1),
	     "  Wire1 := LT(Level, 20.0)\n  Valve := OR(IN1 :=, IN2 := B)\n  Horn := MOVE(IN :=)\n");
	begin("  W := NOT LT(Level, 20.0)\n  Valve := W\n");
	spot = out(0, 1, "");
	EDIT(fbd_edit_remove(edit, &spot, 1), "  W := LT(Level, 20.0)\n  Valve := W\n");
	begin("  Weight := ABS(Raw) + 2.0\n");
	spot = out(0, 0, "OUT");
	EDIT(fbd_edit_remove(edit, &spot, 1), "  Weight := Raw + 2.0\n");
	spot = out(0, 1, "");
	EDIT(fbd_edit_remove(edit, &spot, 1), "  Wire1 := Raw + 2.0\n");
	spot = out(0, 0, "");
	EDIT(fbd_edit_remove(edit, &spot, 1), "");
	begin("  W := Level\n  Weight := W * 2.0\n  Delay(IN := A OR B)\n");
	spot = out(0, 0, "");
	EDIT(fbd_edit_remove(edit, &spot, 1), "  Weight := Level * 2.0\n  Delay(IN := A OR B)\n");
	both[0] = out(0, 0, "");
	both[1] = out(1, 1, "Q");
	EDIT(fbd_edit_remove(edit, both, 2), "  Weight := Level\n  Wire1 := A OR B\n");
}

static void check_inputs(void)
{
	struct fbd_spot spot = in(0, 0, 0, "");

	begin("  W := A AND B\n");
	for (int i = 2; i < FBD_MOST_INPUTS; i++)
		CHECK(fbd_edit_add_input(edit, &spot));
	REFUSED(fbd_edit_add_input(edit, &spot), "This box cannot have more inputs.");
	begin("  W := A AND (B OR C) AND Stop\n");
	spot = in(0, 1, 1, "");
	EDIT(fbd_edit_drop_input(edit, &spot), "  Wire1 := B OR C\n  W := A AND Stop\n");
	spot = in(1, 0, 1, "");
	REFUSED(fbd_edit_drop_input(edit, &spot), "This box needs its inputs.");
	begin("  W := MAX(1, 2, 3)\n");
	spot = in(0, 0, 1, "IN2");
	EDIT(fbd_edit_drop_input(edit, &spot), "  W := MAX(IN1 := 1, IN2 := 3)\n");
	EDIT(fbd_edit_add_input(edit, &spot), "  W := MAX(IN1 := 1, IN2 := 3, IN3 :=)\n");
	begin("  Delay(IN := A)\n");
	spot = in(0, 0, 0, "IN");
	REFUSED(fbd_edit_add_input(edit, &spot), "This box has a fixed number of inputs.");
}

static void check_types(void)
{
	struct fbd_spot spot = in(0, 0, 0, "");

	begin("  W := A AND B\n");
	EDIT(fbd_edit_type(edit, &spot, "OR"), "  W := A OR B\n");
	EDIT(fbd_edit_type(edit, &spot, "MAX"), "  W := MAX(IN1 := A, IN2 := B)\n");
	EDIT(fbd_edit_type(edit, &spot, "<"), "  W := A < B\n");
	EDIT(fbd_edit_type(edit, &spot, "NOT"), "  W := NOT A\n");
	begin("  Delay(IN := A)\n  Valve := Delay.Q\n");
	EDIT(fbd_edit_type(edit, &spot, "Late"), "  Late(IN := A)\n  Valve := Late.Q\n");
}

/* The text after each block that the POU calls, too, has got the name @to. */
static void check_again_in(int pou, const char *text, const char *old, const char *to, const char *expected)
{
	char name[LIMIT_NAME + 1] = "", *renamed;
	const char *type = "";

	CHECK_AS(fbd_instance_again(ladder_project(ladder), pou, text, name, &type) == (expected != NULL), text);
	if (!expected)
		return;
	CHECK_TEXT(name, old);
	CHECK_TEXT(type, "TON");
	renamed = fbd_name_replaced(text, name, to);
	CHECK_TEXT(renamed ? renamed : "", expected);
	free(renamed);
}

static void check_again(const char *text, const char *old, const char *to, const char *expected)
{
	check_again_in(1, text, old, to, expected);
}

/* A member has the name of an instance, in what is pasted and in what is there. */
static void check_members(void)
{
	check_again("  Line.Delay(IN := A)\n", "", "", NULL);
	check_again("  Line[1].Delay(IN := A)\n", "", "", NULL);
	check_again("  Line[Delay.ET].Delay(IN := A)\n", "", "", NULL);
	check_again("  Line[1].Delay(IN := A)\n  Delay(IN := Line[1].Delay.Q, PT := Delay.PT)\n", "Delay", "Delay1",
		    "  Line[1].Delay(IN := A)\n  Delay1(IN := Line[1].Delay.Q, PT := Delay1.PT)\n");
	check_again("  Valve := T[Delay.X].Delay\n  Delay(IN := A)\n", "Delay", "Delay1",
		    "  Valve := T[Delay1.X].Delay\n  Delay1(IN := A)\n");
	check_again_in(3, "  Delay(IN := A)\n", "", "", NULL);
	check_again_in(3, "  Line[2].Delay(IN := A)\n", "", "", NULL);
}

static void check_instances(void)
{
	char stem[LIMIT_NAME + 1];

	check_again("  Delay(IN := A)\n  Valve := Delay.Q AND Delay_ok\n", "Delay", "Delay2",
		    "  Delay2(IN := A)\n  Valve := Delay2.Q AND Delay_ok\n");
	check_again("NETWORK \"Delay(\"\n  (* Delay( *)\n  delay(IN := X.Delay, PT := Delay.PT)\n", "delay", "D",
		    "NETWORK \"Delay(\"\n  (* Delay( *)\n  D(IN := X.Delay, PT := D.PT)\n");
	check_members();
	check_again("  Late(IN := Delay.Q)\n", "", "", NULL);
	check_again("  Valve := MAX(1, 2) > Delay.ET\n", "", "", NULL);
	fbd_instance_stem("Delay12", stem);
	CHECK_TEXT(stem, "Delay");
	fbd_instance_stem("T1_x", stem);
	CHECK_TEXT(stem, "T1_x");
}

static void check_names(void)
{
	struct fbd_spot spot;

	begin("  W := A\n  Valve := W AND NOT W\n  V := B\n");
	EDIT(fbd_edit_rename(edit, "W", "Low"), "  Low := A\n  Valve := Low AND NOT Low\n  V := B\n");
	REFUSED(fbd_edit_rename(edit, "Low", "V"), "Another wire of this network has this name.");
	REFUSED(fbd_edit_move(edit, 0, true), "The order of these two follows from their wire.");
	begin("  W := A\n  T[W] := T[W + T[W]].W + W.X\n  H[W] S= B\n  JMP W IF W > 1\n  Delay(IN := T[MAX(W, 2)], Q => T[W])\n");
	EDIT(fbd_edit_rename(edit, "W", "Low"), "  Low := A\n  T[Low] := T[Low + T[Low]].W + Low.X\n  H[Low] S= B\n"
	     "  JMP W IF Low > 1\n  Delay(IN := T[MAX(Low, 2)], Q => T[Low])\n");
	begin("  Low := A\n  Valve := Low AND NOT Low\n  V := B\n");
	REFUSED(fbd_edit_move(edit, 0, true), "The order of these two follows from their wire.");
	EDIT(fbd_edit_move(edit, 2, false), "  Low := A\n  V := B\n  Valve := Low AND NOT Low\n");
	REFUSED(fbd_edit_move(edit, 0, false), "This is the first line of the network.");
	spot = out(2, 0, "");
	EDIT(fbd_edit_place(edit, &spot, 3, 2),
	     "  Low := A\n  V := B\n  Valve := Low AND NOT Low  { at 3,2 }\n");
	spot = out(2, 1, "");
	EDIT(fbd_edit_place(edit, &spot, 5, 1),
	     "  Low := A\n  V := B\n  Wire1 := Low AND NOT Low  { at 3,2 }\n  Valve := Wire1  { at 5,1 }\n");
	spot = out(2, 0, "");
	EDIT(fbd_edit_place(edit, &spot, 0, 0),
	     "  Low := A\n  V := B\n  Wire1 := Low AND NOT Low\n  Valve := Wire1  { at 5,1 }\n");
}

static void check_copies(void)
{
	struct fbd_spot spot[2];
	char *text;

	begin("  W := A OR B\n  V := B\n  Valve := W\n");
	spot[0] = out(2, 0, "");
	spot[1] = out(0, 0, "");
	text = fbd_edit_copy(edit, spot, 2);
	CHECK_TEXT(text, "  W := A OR B\n  Valve := W\n");
	EDIT(fbd_edit_paste(edit, 1, text),
	     "  W := A OR B\n  V := B\n  Wire1 := A OR B\n  Valve := Wire1\n  Valve := W\n");
	free(text);
	REFUSED(fbd_edit_paste(edit, 0, "RUNG\n  | NO A | COIL B |\n"), "The clipboard has no boxes.");
}

static void check_headings(void)
{
	const struct fbd_heading all = { true, "Fill", "A \"b\"", "// why" }, none = { .off = false };
	char *text = fbd_heading_text(&all);

	CHECK_TEXT(text, "// why\nNETWORK OFF Fill \"A $\"b$\"\"\n");
	free(text);
	text = fbd_heading_text(&none);
	CHECK_TEXT(text, "NETWORK\n");
	free(text);
}

/* ---- random edits ---- */

static unsigned int seed = 1;

static int dice(int sides)
{
	seed = seed * 1103515245u + 12345u;
	return sides > 0 ? (int)((seed >> 16) % (unsigned int)sides) : 0;
}

static struct fbd_spot any_spot(bool output)
{
	static const char *const pins[] = { "", "IN", "IN1", "IN2", "PT", "Q", "OUT", "ENO", "EN" };
	struct fbd_spot spot = { .statement = dice(fbd_edit_statements(edit)), .number = dice(3),
				 .output = output };

	spot.box = dice(3);
	spot.pin = pins[dice(9)];
	return spot;
}

static bool any_edit(void)
{
	static const char *const values[] = { "A", "NOT B", "Level < 3.0", "T[N]", "A AND (B OR C)", "5", "",
					      "MAX(N, 3)", "Wire1" };
	static const char *const words[] = { "AND", "OR", "+", "LT", "MAX", "NOT", "R_EDGE", "LIMIT", "SEL" };
	const struct fbd_spot from = any_spot(true), to = any_spot(false);
	const int behind = dice(fbd_edit_statements(edit) + 1) - 1;
	const bool block = dice(4) == 0;
	const char *word = block ? "TON" : words[dice(9)], *instance = block ? dice(2) ? "Delay" : "Late" : NULL;

	switch (dice(16)) {
	case 0: return fbd_edit_add(edit, behind, word, instance);
	case 1: return fbd_edit_append(edit, &from, word, instance);
	case 2: return fbd_edit_insert(edit, &to, word, instance);
	case 3: return fbd_edit_store(edit, &from, (enum fbd_line_kind)(FBD_LINE_ASSIGN + dice(3)), "Valve");
	case 4: return fbd_edit_remove(edit, &from, 1);
	case 5: case 6: case 7: return fbd_edit_join(edit, &from, &to);
	case 8: return fbd_edit_clear(edit, dice(2) ? &from : &to);
	case 9: return fbd_edit_operand(edit, &to, values[dice(9)]);
	case 10: return fbd_edit_operand(edit, &from, dice(2) ? "Horn" : "Name");
	case 11: return fbd_edit_negate(edit, dice(2) ? &from : &to);
	case 12: return fbd_edit_add_input(edit, &to);
	case 13: return fbd_edit_drop_input(edit, &to);
	case 14: return fbd_edit_type(edit, &to, words[dice(9)]);
	default: return dice(2) ? fbd_edit_move(edit, behind, dice(2)) : fbd_edit_place(edit, &from, 2, 3);
	}
}

/* A rung file with these lines can be read, and is written with the same. */
static bool is_readable(const char *text)
{
	struct ladder *other = ladder_new();
	const size_t head = sizeof(declared) - sizeof("END_PROGRAM\n"), size = sizeof(declared) + strlen(text) + 16;
	char *whole = malloc(size), *written = NULL;
	size_t len;
	bool good;

	snprintf(whole, size, "%.*sNETWORK\n%sEND_PROGRAM\n", (int)head, declared, text);
	good = ladder_load_text(other, "test.rung", whole, strlen(whole));
	if (good)
		written = ladder_write(other, &len);
	good = good && written && strstr(written, text);
	if (!good)
		printf("# cannot be read, or is written in another way:\n%s# written:\n%s\n", whole, written ? written : "");
	free(written);
	free(whole);
	ladder_free(other);
	return good;
}

/* The text reads again, all lines are lines of a network, and written anew they are the same. */
static bool is_sound(const char *text)
{
	struct fbd_edit *again = fbd_edit_new(ladder_project(ladder), 0, text, strlen(text));
	char *canonical;
	bool good = true;

	for (int i = 0; i < again->net.count; i++) {
		good &= again->net.line[i]->kind != FBD_LINE_OTHER;
		again->net.line[i]->changed = true;
	}
	canonical = fbd_edit_text(again);
	good &= strcmp(canonical, text) == 0;
	if (!good)
		printf("# is:\n%s# canonical:\n%s", text, canonical);
	free(canonical);
	fbd_edit_free(again);
	return good;
}

static void check_random(void)
{
	int done = 0, refused = 0;
	bool sound = true;

	for (int round = 0; round < tap_rounds(ROUNDS) && sound; round++) {
		begin("  Low := LT(Level, 20.0)\n  Delay(IN := Low AND NOT Stop, PT := T#3s)\n  Valve := Delay.Q\n");
		for (int i = 0; i < EDITS && sound; i++) {
			char *before = strdup(now);
			const bool good = any_edit();

			if (good)
				keep();
			done += good;
			refused += !good;
			sound &= good ? is_sound(now) && is_readable(now) : edit->why != NULL;
			if (!sound)
				printf("# round %d, edit %d, before:\n%s", round, i, before);
			begin(sound && good ? now : before);
			free(before);
		}
	}
	CHECK(sound);
	printf("# %d edits done, %d refused\n", done, refused);
	CHECK_AS(done > tap_rounds(ROUNDS) * EDITS / 4 && refused > tap_rounds(ROUNDS), "edits of both kinds");
}

int main(void)
{
	ladder = ladder_new();
	CHECK(ladder_load_text(ladder, "test.rung", declared, strlen(declared)));
	check_lines();
	check_forms();
	check_inverted_outputs();
	check_operands();
	check_joins();
	check_adding();
	check_removing();
	check_inputs();
	check_types();
	check_names();
	check_instances();
	check_copies();
	check_headings();
	check_random();
	fbd_edit_free(edit);
	free(now);
	ladder_free(ladder);
	return tap_done();
}
