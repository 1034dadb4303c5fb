/* SPDX-License-Identifier: MIT
 *
 * test_show - drawings of rungs, character by character.
 */
#include "engine/base/lex.h"
#include "engine/model/project.h"
#include "engine/text/text.h"
#include "engine/show/show.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct sink_memory memory;
static struct diag_list diags;
static int drawn;

static const char *show(const char *pous, int pou, int rung, bool ascii,
			int width)
{
	static char text[100000];
	struct show_options options = { .ascii = ascii, .width = width };
	struct project *project = project_new("test.rung");
	struct sink sink = sink_to_memory(&memory);

	diag_init(&diags);
	snprintf(text, sizeof(text), "RUNGBOARD 1\n%s", pous);
	CHECK_AS(text_read(project, "test.rung", text, strlen(text), NULL,
			   &diags), "the program can be read");
	sink_memory_free(&memory);
	drawn = show_rungs(project, pou, rung, &options, &sink);
	project_free(project);
	return sink_memory_text(&memory);
}

static const char *rung(const char *rows)
{
	static char pou[70000];

	snprintf(pou, sizeof(pou), "PROGRAM Main LD\n%sEND_PROGRAM\n", rows);
	return show(pou, 0, 1, false, 0);
}

static void test_contacts(void)
{
	CHECK_TEXT(rung(
	"RUNG Seal \"The motor seals itself in until Stop\"\n"
	"| NO Open | NC Stop | --- | COIL Motor |\n"
	"| NO Motor ^|\n"),
	"Seal: The motor seals itself in until Stop\n"
	" │  Open    Stop       Motor  │\n"
	"1├──┤ ├──┬──┤/├─────────( )───┤\n"
	" │ Motor │                    │\n"
	" ├──┤ ├──┘                    │\n");
	CHECK(drawn == 1);
	CHECK_TEXT(rung("RUNG\n"
	"| P A | N B | NOT | COILNOT Y |\n"
	"| S Z |\n"
	"| R Z |\n"
	"| COILP Z |\n"
	"| COILN Z |\n"),
	" │   A       B                 Y    │\n"
	"1├──┤P├─────┤N├─────┤NOT├─────(/)───┤\n"
	" │   Z                              │\n"
	" ├──(S)─────────────────────────────┤\n"
	" │   Z                              │\n"
	" ├──(R)─────────────────────────────┤\n"
	" │   Z                              │\n"
	" ├──(P)─────────────────────────────┤\n"
	" │   Z                              │\n"
	" ├──(N)─────────────────────────────┤\n");
}

static void test_joints(void)
{
	CHECK_TEXT(rung("RUNG Nested\n"
	"| NO A | --- | NO B | --- | NO C | COIL X |\n"
	"| ^| NO D | NO E | --- ^| NC F ^| COILNOT Y |\n"
	"| | NO G ^| --- | NO H ^|\n"),
	"Nested\n"
	" │   A               B               C       X    │\n"
	"1├──┤ ├──┬──────────┤ ├──────────┬──┤ ├──┬──( )───┤\n"
	" │       │   D       E           │   F   │   Y    │\n"
	" │       └──┤ ├──┬──┤ ├──────────┼──┤/├──┴──(/)───┤\n"
	" │           G   │           H   │                │\n"
	" │       ───┤ ├──┴──────────┤ ├──┘                │\n");
	/* A bridge, which is no combination of series and parallel. */
	CHECK_TEXT(rung("RUNG\n"
	"| NO A | NO B | COIL X |\n"
	"| NO C ^| NO D ^| |\n"
	"| --- | NO E | JMP Out |\n"),
	" │   A       B         X    │\n"
	"1├──┤ ├──┬──┤ ├──┬────( )───┤\n"
	" │   C   │   D   │          │\n"
	" ├──┤ ├──┴──┤ ├──┘          │\n"
	" │           E              │\n"
	" ├──────────┤ ├─────>>Out   │\n");
}

static void test_outputs(void)
{
	CHECK_TEXT(rung("RUNG\n"
	"| NO A | NO B | COIL One |\n"
	"| | ^| COIL Two |\n"
	"| | ^| RET |\n"),
	" │   A       B           One   │\n"
	"1├──┤ ├─────┤ ├──┬───────( )───┤\n"
	" │               │       Two   │\n"
	" │               ├───────( )───┤\n"
	" │               └──<RETURN>   │\n");
	/* Not last on its branch: drawn without a line to the rail. */
	CHECK_TEXT(rung("RUNG\n| COIL A | NO B |\n"),
	" │   A       B    │\n"
	"1├──( )─────┤ ├───│\n");
}

static void test_boxes(void)
{
	CHECK_TEXT(rung("RUNG\n"
	"| NO Motor | TON Runout PT:=T#3s ET=>Elapsed | --- | R Motor |\n"),
	" │               Runout                         │\n"
	" │ Motor        ┌─ TON ─┐                Motor  │\n"
	"1├──┤ ├─────────┤IN    Q├─────────────────(R)───┤\n"
	" │         T#3s─┤PT   ET├─ Elapsed              │\n"
	" │              └───────┘                       │\n");
	CHECK_TEXT(rung("RUNG Count \"计数器\"\n"
	"| P Start | CTU Parts PV:=100 Q=>Full CV=>Count | COIL Lamp |\n"
	"| NO 复位 | .R |\n"
	"| | . |\n"),
	"Count: 计数器\n"
	" │               Parts                   │\n"
	" │ Start       ┌─ CTU ─┐           Lamp  │\n"
	"1├──┤P├────────┤CU    Q├───────────( )───┤\n"
	" │  复位       │     CV├─ Count          │\n"
	" ├──┤ ├────────┤R     Q├─ Full           │\n"
	" │             │       │                 │\n"
	" │         100─┤PV     │                 │\n"
	" │             └───────┘                 │\n");
	CHECK_TEXT(rung("RUNG\n"
	"| ADD IN1:=A IN2:=B IN3:=C OUT=>Sum | GT IN1:=Sum IN2:=9 |\n"),
	" │   ┌─ ADD ──┐            ┌── GT ──┐   │\n"
	"1├───┤EN   ENO├────────────┤EN   ENO├───┤\n"
	" │ A─┤IN1  OUT├─ Sum   Sum─┤IN1     │   │\n"
	" │ B─┤IN2     │          9─┤IN2     │   │\n"
	" │ C─┤IN3     │            └────────┘   │\n"
	" │   └────────┘                         │\n");
}

static void test_expressions(void)
{
	CHECK_TEXT(rung("RUNG\n"
	"| [ Level > 10*Step + 5 ] | [ Total := Total + 1 ] |\n"),
	"1├──[ Level > 10*Step + 5 ]─────[ Total := Total + 1 ]───┤\n");
}

static void test_texts(void)
{
	CHECK_TEXT(rung("(* Why it is here.\n   灯 *)\n"
	"RUNG OFF Lamp \"on\"\n"
	"| NO A (* 绿 button *) | COIL Y (* lamp *) |\n"),
	"Lamp: on [OFF]\n"
	"   Why it is here.\n"
	"   灯\n"
	" ┆   A       Y    ┆\n"
	"1├──┤ ├─────( )───┤\n"
	"  (1,1) A: 绿 button\n"
	"  (1,2) Y: lamp\n");
}

static void test_ascii(void)
{
	CHECK_TEXT(show("PROGRAM Main LD\nRUNG\n| NO A | COIL X |\n| NO B ^|\n"
			"RUNG\n| NC A | TON T PT:=T#1s |\nEND_PROGRAM\n", 0, 0,
			true, 40),
	"PROGRAM Main\n"
	"\n"
	" |   A                            X    |\n"
	"1+--| |--+-----------------------( )---+\n"
	" |   B   |                             |\n"
	" +--| |--+                             |\n"
	"\n"
	" |                       T             |\n"
	" |   A               +- TON -+         |\n"
	"2+--|/|--------------|IN    Q|---------+\n"
	" |              T#1s-|PT   ET|         |\n"
	" |                   +-------+         |\n");
	CHECK(drawn == 2);
}

static void test_choice(void)
{
	const char *two = "PROGRAM Main LD\nRUNG\n| NO A | COIL X |\n"
			  "END_PROGRAM\nPROGRAM Sum IL\nLD A\nANDN B\nST X\n"
			  "END_PROGRAM\n";

	CHECK(strstr(show(two, -1, 0, false, 0), "PROGRAM Main\n\n"));
	CHECK(drawn == 2);
	CHECK(strstr(memory.text, "\n\nPROGRAM Sum IL\n"));
	show(two, 0, 2, false, 0);
	CHECK(drawn == 0 && memory.len == 0);
	show(two, 0, -1, false, 0);
	CHECK(drawn == 0 && memory.len == 0);
	show(two, 7, 0, false, 0);
	CHECK(drawn == 0 && memory.len == 0);
}

/* All lines of a rung have the same width, whatever it contains. */
static bool is_even(const char *text)
{
	int width = -1;

	while (*text) {
		const char *end = strchr(text, '\n');
		int columns = utf8_width(text, (size_t)(end - text));

		if (width >= 0 && columns != width)
			return false;
		width = columns;
		text = end + 1;
	}
	return width > 0;
}

static void test_wide(void)
{
	static char rows[60000];
	static const char *const cell[] = {
		"NO A", "TON 电机T PT:=T#1s ET=>X", "---", "",
		"[ A > 1234567 ]", "JMP L", "CTU C PV:=3", "COIL LongerName",
		".R", ". ", "NOT", "MOVE IN:=1 OUT=>电",
	};
	size_t len = (size_t)snprintf(rows, sizeof(rows), "RUNG\n");

	for (int row = 0; row < 30; row++) {
		for (int col = 0; col < 64; col++)
			len += (size_t)snprintf(rows + len, sizeof(rows) - len,
				"| %s %s", row > 0 || (col * 7) % 12 < 8 ?
				cell[(row * 5 + col * 7) % 12] : "---",
				row > 0 && (row + col) % 3 == 0 ? "^" : "");
		len += (size_t)snprintf(rows + len, sizeof(rows) - len, "|\n");
	}
	CHECK(is_even(rung(rows)));
	CHECK(drawn == 1);
}

static void test_clipped(void)
{
	static char row[1000];
	char name[201];

	memset(name, 'n', 200);
	name[200] = '\0';
	snprintf(row, sizeof(row), "RUNG\n| NO %s | TON T PT:=%s ET=>%s |\n",
		 name, name, name);
	CHECK(is_even(rung(row)));
	CHECK(strstr(memory.text, "nnn…") && !strstr(memory.text, name));
}

int main(void)
{
	test_contacts();
	test_joints();
	test_outputs();
	test_boxes();
	test_expressions();
	test_texts();
	test_ascii();
	test_choice();
	test_wide();
	test_clipped();
	sink_memory_free(&memory);
	return tap_done();
}
