/* SPDX-License-Identifier: MIT
 *
 * test_own_blocks - functions and function blocks of a project at work: faults and
 * errors inside a body, what a call costs, power of an instance's cells.
 *
 * Behaviour is tested in tests/golden/own-*.
 */
#include "tests/unit/rig.h"

static struct rig rig;

static const char source[] =
	"VAR\n  A : Outer;\n  B : Outer;\n  In : INT;\n  Bad : INT;\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"VAR\n  Own : Inner;\nEND_VAR\n"
	"RUNG\n  | NO I0 | Outer A | COIL Q0 |\n"
	"RUNG\n  | NO I1 | Outer B | COIL Q1 |\n"
	"RUNG\n  | NO I2 | Inner Own | COIL Q2 |\n"
	"RUNG\n  | NO I3 | Share X:=In OUT=>Bad |\n"
	"RUNG\n  | NO I4 | Spin |\n"
	"END_PROGRAM\n"
	"FUNCTION_BLOCK Outer LD\n"
	"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
	"VAR\n  Deep : Inner;\nEND_VAR\n"
	"RUNG\n  | NO On | Inner Deep | COIL Q |\n"
	"END_FUNCTION_BLOCK\n"
	"FUNCTION_BLOCK Inner LD\n"
	"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
	"RUNG\n  | NC On | COIL %MX0.0 |\n"
	"RUNG\n  | NO On | COIL Q |\n"
	"END_FUNCTION_BLOCK\n"
	"FUNCTION Share : INT LD\nVAR_INPUT\n  X : INT;\nEND_VAR\n"
	"RUNG\n  | [ Share := 1 ] |\n"
	"RUNG\n  | [ Share := 10 / X ] |\n"
	"END_FUNCTION\n"
	"FUNCTION Spin : INT IL\nVAR\n  N : INT;\nEND_VAR\n"
	"Again:\n  LD N\n  ADD 0\n  ST N\n  JMP Again\nEND_FUNCTION\n";

static void error_names_the_body(void)
{
	struct resource *r = &rig.resource;

	CHECK(rig_open(&rig, source, false) && rig_scan(&rig));
	CHECK(rig_set(&rig, "I3", 1) && rig_scan(&rig));
	CHECK(r->vm.errors == 1 && rig_get(&rig, "Bad") == 1);
	CHECK_TEXT(r->error_at.pou, "Share");
	CHECK(r->error_at.rung == 2 && r->error_at.row == 1);
	CHECK(rig_set(&rig, "In", 5) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Bad") == 2);
}

static void loop_is_a_fault_of_the_body(void)
{
	struct resource *r = &rig.resource;

	CHECK(rig_set(&rig, "I4", 1) && !rig_scan(&rig));
	CHECK(r->state == STATE_FAULT && r->fault == FAULT_BUDGET);
	CHECK_TEXT(r->fault_at.pou, "Spin");
	rig_close(&rig);
}

static int power(const char *instance, uint32_t rung, uint32_t col)
{
	bool in, out;

	if (!resource_power_in(&rig.resource, instance, strlen(instance), rung, 1,
			       col, &in, &out))
		return -1;
	return in * 2 + out;
}

static void instances_have_their_own_power(void)
{
	CHECK(rig_open(&rig, source, true));
	CHECK(rig_set(&rig, "I0", 1) && rig_scan(&rig));
	CHECK(rig_get(&rig, "Q0") == 1 && rig_get(&rig, "Q1") == 0);
	/* A is on; B was called last and is off. */
	CHECK(power("A", 1, 1) == 3 && power("a", 1, 2) == 3);
	CHECK(power("B", 1, 1) == 2 && power("B", 1, 2) == 0);
	CHECK(power("A.Deep", 1, 1) == 2 && power("A.Deep", 2, 1) == 3);
	CHECK(power("B.Deep", 1, 1) == 3 && power("B.Deep", 2, 1) == 2);
	CHECK(power("Own", 1, 1) == 3 && power("Own", 2, 2) == 0);
	CHECK(rig_set(&rig, "I0", 0) && rig_set(&rig, "I2", 1) && rig_scan(&rig));
	CHECK(power("A", 1, 1) == 2 && power("Own", 2, 1) == 3);
	CHECK(power("C", 1, 1) == -1 && power("A", 2, 1) == -1);
	CHECK(power("A.Deep.On", 1, 1) == -1 && power("", 1, 1) == -1);
	rig_close(&rig);
}

static void elements_have_their_own_power(void)
{
	CHECK(rig_open(&rig,
		"VAR\n  Row : ARRAY[-1..1] OF Outer;\nEND_VAR\n"
		"PROGRAM Main LD\n"
		"RUNG\n  | NO I0 | Outer Row[-1] | COIL Q0 |\n"
		"RUNG\n  | NO I1 | Outer Row[1] | COIL Q1 |\n"
		"RUNG\n  | NO I2 | Outer Row[0] | COIL Q2 |\n"
		"END_PROGRAM\n"
		"FUNCTION_BLOCK Outer LD\n"
		"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
		"VAR\n  First : ARRAY[1..2] OF BOOL;\n  Deep : ARRAY[5..6] OF Inner;\n"
		"  Last : Inner;\nEND_VAR\n"
		"RUNG\n  | NO On | Inner Deep[5] | COIL Q |\n"
		"RUNG\n  | NC On | Inner Deep[6] | COIL First[2] |\n"
		"RUNG\n  | NO First[2] | Inner Last | S First[1] |\n"
		"END_FUNCTION_BLOCK\n"
		"FUNCTION_BLOCK Inner LD\n"
		"VAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
		"RUNG\n  | NO On | COIL Q |\n"
		"END_FUNCTION_BLOCK\n", true));
	CHECK(rig_set(&rig, "I1", 1) && rig_scan(&rig));
	CHECK(power("Row[1]", 1, 1) == 3 && power("row[0]", 1, 1) == 2);
	CHECK(power("Row[-1]", 1, 1) == 2 && power("Row[-1]", 2, 1) == 3);
	CHECK(power("Row[1].Deep[5]", 1, 1) == 3 && power("Row[1].Deep[6]", 1, 1) == 2);
	CHECK(power("Row[0].Deep[5]", 1, 1) == 2 && power("Row[0].Deep[6]", 1, 1) == 3);
	CHECK(power("Row[-1].Last", 1, 1) == 3 && power("Row[1].Last", 1, 1) == 2);
	CHECK(power("Row", 1, 1) == -1 && power("Row[2]", 1, 1) == -1);
	CHECK(power("Row[1].Deep", 1, 1) == -1 && power("Row[1].First[1]", 1, 1) == -1);
	rig_close(&rig);
}

/* A call costs the words that it runs: nested blocks, each calling the next ten times,
 * exceed the budget and are a fault. */
static void calls_cost(void)
{
	char text[8000] = "PROGRAM Main IL\nVAR\n  X : B0;\nEND_VAR\n";
	size_t used = strlen(text);

	for (int level = 0; level < 9; level++) {
		used += (size_t)snprintf(text + used, sizeof(text) - used,
			level ? "FUNCTION_BLOCK B%d IL\nVAR\n  X : B%d;\n"
				"  N : DINT;\nEND_VAR\n" : "\n", level - 1, level);
		for (int i = 0; i < 10; i++)
			used += (size_t)snprintf(text + used, sizeof(text) - used,
						 "  CAL X\n");
		used += (size_t)snprintf(text + used, sizeof(text) - used,
			level ? "END_FUNCTION_BLOCK\n" : "END_PROGRAM\n");
	}
	snprintf(text + used, sizeof(text) - used, "FUNCTION_BLOCK B8 IL\n"
		 "VAR\n  N : DINT;\nEND_VAR\n  LD N\n  ADD 1\n  ST N\n"
		 "END_FUNCTION_BLOCK\n");
	CHECK(rig_open(&rig, text, false));
	CHECK(!rig_scan(&rig) && rig.resource.fault == FAULT_BUDGET);
	rig_close(&rig);
}

int main(void)
{
	error_names_the_body();
	loop_is_a_fault_of_the_body();
	instances_have_their_own_power();
	elements_have_their_own_power();
	calls_cost();
	return tap_done();
}
