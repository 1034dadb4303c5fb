/* SPDX-License-Identifier: MIT
 *
 * test_instances - several instances of one program have data of their own: they do what
 * copies of the program under other names do.
 */
#include "tests/unit/rig.h"

#define SCANS 120

/* %s: the programs behind B1 and B2; what follows them. */
static const char source[] =
	"VAR\n  Step AT %%IX0.0 : BOOL;\n  Sum : DINT;\nEND_VAR\n"
	"CONFIGURATION Plant\n"
	"  VAR_ACCESS\n    Shown : B.Count : INT READ_WRITE;\n  END_VAR\n"
	"  TASK Fast (INTERVAL := T#10ms, PRIORITY := 1);\n"
	"  TASK Slow (INTERVAL := T#30ms, PRIORITY := 2);\n"
	"  PROGRAM A WITH Fast : Work;\n"
	"  PROGRAM B WITH Slow : %s;\n"
	"  PROGRAM C : List;\n"
	"  PROGRAM D WITH Slow : %s;\n"
	"  PROGRAM E : Chart;\n"
	"  PROGRAM F WITH Slow : %s;\n"
	"END_CONFIGURATION\n"
	"FUNCTION_BLOCK Twice LD\n"
	"VAR_INPUT\n  X : INT;\nEND_VAR\nVAR_OUTPUT\n  Y : INT;\nEND_VAR\n"
	"RUNG\n  | [ Y := Y + X ] |\nEND_FUNCTION_BLOCK\n%s%s%s%s%s%s";

#define WORK(name) "PROGRAM " name " LD\n" \
	"VAR RETAIN\n  Count : INT := 5;\nEND_VAR\n" \
	"VAR\n  Wait : TON;\n  Edges : DINT;\n  Own : Twice;\n  Row : ARRAY[1..3] OF INT := [7, 8, 9];\nEND_VAR\n" \
	"RUNG\n  | P Step | [ Edges := Edges + 1 ] |\n" \
	"RUNG\n  | NO Step | TON Wait PT:=T#50ms | [ Count := Count + Row[2] ] |\n" \
	"RUNG\n  | --- | Twice Own X:=Count |\n" \
	"RUNG\n  | --- | [ Sum := Sum * 3 + INT_TO_DINT(Own.Y) ] |\nEND_PROGRAM\n"
#define LIST(name) "PROGRAM " name " IL\nVAR\n  N : DINT;\nEND_VAR\n" \
	"  LD N\n  ADD 3\n  ST N\nEND_PROGRAM\n"
#define CHART(name) "PROGRAM " name " SFC\nVAR\n  Rounds : DINT;\nEND_VAR\n" \
	"INITIAL_STEP Rest:\nEND_STEP\nTRANSITION FROM Rest TO Turn := Step; END_TRANSITION\n" \
	"STEP Turn:\n  Count(P);\nEND_STEP\nTRANSITION FROM Turn TO Rest := NOT Step; END_TRANSITION\n" \
	"ACTION Count:\nRUNG\n  | [ Rounds := Rounds + 1 ] |\nEND_ACTION\nEND_PROGRAM\n"

static struct rig rig, model;

static bool open(struct rig *out, bool watch, bool copies)
{
	static char text[8192];

	snprintf(text, sizeof(text), source, copies ? "B" : "Work", copies ? "D" : "List",
		 copies ? "F" : "Chart", WORK("Work"), LIST("List"), CHART("Chart"),
		 copies ? WORK("B") : "", copies ? LIST("D") : "", copies ? CHART("F") : "");
	return rig_open(out, text, watch);
}

static void same(const char *name)
{
	CHECK_AS(rig_get(&rig, name) == rig_get(&model, name), name);
}

/* Inputs that change at odd times. */
static void run(bool watch)
{
	static const char *const name[] = {
		"Sum", "Work.Count", "Work.Edges", "Work.Wait.ET", "Work.Own.Y", "B.Count",
		"B.Edges", "B.Wait.ET", "B.Own.Y", "List.N", "D.N", "Chart.Rounds", "F.Rounds",
	};

	if (!open(&rig, watch, false) || !open(&model, watch, true))
		return;
	for (int i = 0; i < SCANS; i++) {
		rig_set(&rig, "Step", i / 13 % 3 == 1);
		rig_set(&model, "Step", i / 13 % 3 == 1);
		CHECK(rig_scan(&rig) && rig_scan(&model));
		for (size_t k = 0; k < sizeof(name) / sizeof(name[0]); k++)
			if (rig_get(&rig, name[k]) != rig_get(&model, name[k]))
				CHECK_AS(false, name[k]);
	}
	for (size_t k = 0; k < sizeof(name) / sizeof(name[0]); k++)
		same(name[k]);
	CHECK(rig_get(&rig, "Work.Edges") > 0 && rig_get(&rig, "B.Edges") > 0);
	CHECK(rig_get(&rig, "B.Count") > 5 && rig_get(&rig, "B.Count") != rig_get(&rig, "Work.Count"));
	CHECK(rig_get(&rig, "Chart.Rounds") > 0 && rig_get(&rig, "F.Rounds") > 0);
	CHECK(rig_get(&rig, "D.N") < rig_get(&rig, "List.N"));
	/* The project is as it was: it can be written and built. */
	CHECK(ladder_project(rig.ladder)->pou_count == 4);
	rig_close(&rig);
	rig_close(&model);
}

int main(void)
{
	run(false);
	run(true);
	return tap_done();
}
