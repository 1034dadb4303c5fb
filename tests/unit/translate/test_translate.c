/* SPDX-License-Identifier: MIT
 *
 * test_translate - ladders become lists as a person would write them, and run as
 * the language document says; the printed list is the same program.
 */
#include "engine/text/text.h"
#include "engine/text/pou_print.h"
#include "tests/unit/rig.h"
#include "tests/usual.h"

#include <dirent.h>

static const char declared[] =
	"VAR\n  A AT %IX0.0 : BOOL;\n  B AT %IX0.1 : BOOL;\n  C AT %IX0.2 : BOOL;\n"
	"  D AT %IX0.3 : BOOL;\n  X, Y, Z : BOOL;\n  N, M : INT;\n  T : TIME;\n"
	"  Raw AT %MW4 : INT;\n  List : ARRAY[0..4] OF INT := [8, 9, 10, 11, 12];\n"
	"  Texts : ARRAY[0..4] OF STRING[8] := [5('abcd')];\n  Short : STRING[2];\n"
	"  Delay : TON;\n  Up : CTUD;\nEND_VAR\n";

static char text[200000];

static const char *program(const char *language, const char *body)
{
	snprintf(text, sizeof(text), "%sPROGRAM Main %s\n%s\nEND_PROGRAM\n",
		 declared, language, body);
	return text;
}

static bool ladder(struct rig *rig, const char *rungs, bool watch)
{
	return rig_open(rig, program("LD", rungs), watch);
}

static bool list(struct rig *rig, const char *lines)
{
	return rig_open(rig, program("IL", lines), false);
}

/* ---- the text ---- */

/* The list of these rungs, lines joined by |, without blanks and comments. */
static const char *lines(const char *rungs)
{
	static char out[4000];
	struct sink_memory memory;
	struct sink sink;
	struct rig rig;
	size_t len = 0;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	out[0] = '\0';
	if (ladder(&rig, rungs, false)) {
		text_write_il(ladder_project(rig.ladder),
			      ladder_il(rig.ladder, 0), &sink);
		for (const char *line = sink_memory_text(&memory); *line;) {
			int size = (int)strcspn(line, "\n");
			int blank = (int)strspn(line, " ");

			if (strncmp(line, "(*", 2) != 0)
				len += (size_t)snprintf(out + len,
					sizeof(out) - len, "%s%.*s",
					len ? "|" : "", size - blank,
					line + blank);
			line += size + (line[size] == '\n');
		}
		/* One blank between words. */
		for (char *at = out; (at = strstr(at, "  ")) != NULL;)
			memmove(at, at + 1, strlen(at));
	}
	sink_memory_free(&memory);
	rig_close(&rig);
	return out;
}

/* Tables of three inputs in the code. */
static int tables(const struct program *program)
{
	int count = 0;

	for (uint32_t i = 0; i < program->text_words; i++)
		if ((program->text[i] & 0xff) == VM_LUT) {
			count += (int)(program->text[i] >> 8);
			i += 4 * (program->text[i] >> 8);
		}
	return count;
}

/* @columns of @rows contacts beside each other, in series; B in every second row. */
static void put_dense(char *out, size_t size, int rows, int columns)
{
	size_t len = (size_t)snprintf(out, size, "RUNG\n");

	for (int row = 0; row < rows; row++) {
		len += (size_t)snprintf(out + len, size - len, " |");
		for (int col = 0; col < columns; col++)
			len += (size_t)snprintf(out + len, size - len, " %s %%IX%d.%d %s|",
						(row + col) & 1 ? "NC" : "NO", 1 + row, col,
						row ? "^" : "");
		len += (size_t)snprintf(out + len, size - len, row ? "\n" : " COIL X |\n");
	}
}

/* The power before contacts beside each other is read once. A table has three inputs and one
 * result, so n inputs need n / 2 of them. */
static void shares_power(void)
{
	char rung[4000];

	CHECK_TEXT(lines("RUNG\n | NO A | NO B | COIL X |\n | ^| NC C ^|\n"),
		   "LD A|AND( B|ORN C|)|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | NC B | COIL X |\n | NO D ^| NC C ^|\n"),
		   "LD A|OR D|AND(|LDN B|ORN C|)|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | NO B | COIL X |\n | ^| NC C ^|\n | NO D | --- ^|\n"),
		   "LD A|AND( B|ORN C|)|OR D|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | NO B | COIL X |\n | NO D | NO Y ^|\n | ^| NO Z ^|\n | ^| NC C ^|\n"),
		   "LD A|AND B|OR( D|AND( Y|OR Z|ORN C|)|)|ST X");
	for (int rows = 1; rows <= 7; rows++)
		for (int columns = 1; columns <= 7; columns++) {
			const int most = rows == 1 ? columns / 2 + (columns == 1) :
					 rows / 2 + (columns - 1) * ((rows + 1) / 2);
			struct rig rig;

			put_dense(rung, sizeof(rung), rows, columns);
			CHECK(ladder(&rig, rung, false));
			CHECK(tables(rig.resource.image.program) <= most);
			rig_close(&rig);
		}
}

/* ENO goes straight to the coil, and to nothing else that reads it. */
static void stores_eno_at_once(void)
{
	static const char *const rung[] = {
		"RUNG\n | NO A | ADD IN1:=N IN2:=M OUT=>N | COIL X |\n",
		"RUNG\n | NO A | DIV IN1:=N IN2:=M OUT=>N | COIL X |\n",
		"RUNG\n | NO A | ADD IN1:=N IN2:=M OUT=>N | COIL X |\n | ^| COIL Y |\n",
		"RUNG\n | NO A | ADD IN1:=N IN2:=M OUT=>N | COILNOT X |\n",
		"RUNG\n | NO A | ADD IN1:=N IN2:=M OUT=>N | NO B | COIL X |\n",
	};
	static const int most[] = { 0, 0, 1, 1, 1 };

	for (size_t i = 0; i < sizeof(rung) / sizeof(*rung); i++) {
		struct rig rig;

		CHECK(ladder(&rig, rung[i], false));
		CHECK_AS(tables(rig.resource.image.program) == most[i], rung[i]);
		rig_close(&rig);
	}
}

static int copies(const struct program *program)
{
	int count = 0;

	for (const uint32_t *code = program->text, *end = code + program->text_words; code < end;
	     code += code_words(code))
		count += (*code & 0xff) == VM_COPY;
	return count;
}

/* A sum goes to where it is stored, and a later line finds it there. So does a quotient: without one
 * the left number. A text goes there by a COPY, as it may be cut. */
static void stores_numbers_at_once(void)
{
	static const struct { const char *lines; int copies; int64_t n, m; } row[] = {
		{ "LD N\nADD 1\nST N\n", 0, 8, 3 },
		{ "LD N\nADD M\nST M\n", 0, 7, 10 },
		{ "LD N\nSUB M\nMUL M\nST N\n", 0, 12, 3 },
		{ "LD N\nADD 1\nST N\nADD N\nST M\n", 0, 8, 16 },
		{ "LD N\nADD 1\nST N\nLT 100\nST X\n", 0, 8, 3 },
		{ "LD N\nADD 1\nST N\nST M\n", 1, 8, 8 },
		{ "LD N\nADD 1\nST N\nADD(M\nADD N\n)\nST M\n", 1, 8, 19 },
		{ "LD N\nDIV M\nST N\n", 0, 2, 3 },
		{ "LD N\nDIV M\nMOD 2\nST M\n", 0, 7, 0 },
		{ "LD N\nSUB 7\nST N\nLD M\nDIV N\nST M\nMOD N\nST N\n", 0, 3, 3 },
		{ "LD N\nADD 32767\nST N\n", 0, -32762, 3 },
		{ "LD N\nADD 1\nST Raw\nST N\n", 1, 8, 3 },
		{ "LD List[M]\nST N\n", 0, 11, 3 },
		{ "LD List[N]\nST M\n", 0, 7, 0 },
		{ "LD List[M]\nST M\nADD M\nST N\n", 0, 22, 11 },
		{ "LD Texts[M]\nST Short\nLEN\nST N\n", 3, 4, 3 },
	};

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		struct rig rig;

		CHECK_AS(list(&rig, row[i].lines), row[i].lines);
		rig_set(&rig, "N", 7);
		rig_set(&rig, "M", 3);
		rig_scan(&rig);
		CHECK_AS(copies(rig.resource.image.program) == row[i].copies, row[i].lines);
		CHECK_AS(rig_get(&rig, "N") == row[i].n && rig_get(&rig, "M") == row[i].m,
			 row[i].lines);
		rig_close(&rig);
	}
}

static int jumps_to_jumps(const struct program *program)
{
	int count = 0;

	for (const uint32_t *code = program->text, *end = code + program->text_words; code < end;
	     code += code_words(code)) {
		uint32_t targets;
		const uint32_t *target = code_targets(code, &targets);

		for (uint32_t i = 0; i < targets; i++)
			count += (program->text[target[i]] & 0xff) == VM_JMP;
	}
	return count;
}

/* A jump to a jump further down leads to where that one leads; a jump back stays one. */
static void jumps_once(void)
{
	static const struct { const char *lines; int chained; int64_t n; } row[] = {
		{ "LD A\nJMPC One\nLD 1\nST N\nOne:\nJMP Two\nLD 2\nST N\nTwo:\n", 0, 1 },
		{ "LD A\nJMPCN One\nLD 1\nST N\nOne:\nJMP Two\nLD 2\nST N\nTwo:\nJMP Three\n"
		  "LD 3\nST N\nThree:\nLD N\nADD 1\nST N\n", 0, 8 },
		{ "Back:\nLD N\nADD 1\nST N\nLT 20\nJMPC Low\nRET\nLow:\nJMP Back\n", 1, 20 },
	};

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		struct rig rig;

		CHECK_AS(list(&rig, row[i].lines), row[i].lines);
		rig_set(&rig, "N", 7);
		rig_scan(&rig);
		CHECK_AS(jumps_to_jumps(rig.resource.image.program) == row[i].chained, row[i].lines);
		CHECK_AS(rig_get(&rig, "N") == row[i].n, row[i].lines);
		rig_close(&rig);
	}
}

/* One parenthesis in another for each column, as deep as a rung allows: contacts beside each
 * other in each column, and in each column one that leads there from the rail. */
static void nests_as_deep_as_columns(void)
{
	enum { LAST = LIMIT_COLS - 2 };
	static char rung[100000];
	size_t len = (size_t)snprintf(rung, sizeof(rung), "RUNG\n");
	struct rig rig;

	for (int row = 0; row <= LAST + 1; row++) {
		const int own = LAST - row; /* column of the contact; below 1: the rows beside */

		len += (size_t)snprintf(rung + len, sizeof(rung) - len, " |");
		for (int col = 0; col <= LAST; col++)
			len += (size_t)snprintf(rung + len, sizeof(rung) - len, " %s %s|",
				own == 0 ? "NO A" : own < 0 ? (col ? "NC C" : "") :
				col < own ? "---" : col == own ? "NO B" : "",
				col > own || own < 0 ? "^" : "");
		len += (size_t)snprintf(rung + len, sizeof(rung) - len,
					row ? "\n" : " COIL X |\n");
	}
	CHECK(ladder(&rig, rung, false));
	CHECK(strstr(rung, "NC C") && ladder_il(rig.ladder, 0)->count > 3 * LAST);
	rig_close(&rig);
}

static void writes_contacts_and_coils(void)
{
	CHECK_TEXT(lines("RUNG\n | NO A | NC B | COIL X |\n | NO X ^|\n"),
		   "LD A|OR X|ANDN B|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | COIL X |\n | ^| COILNOT Y |\n | ^| S Z |\n"),
		   "LD A|ST X|STN Y|S Z");
	CHECK_TEXT(lines("RUNG\n | NO A | NO B | COIL X |\n"
			 " | NO C ^| ^| NO D | COIL Y |\n"),
		   "LD A|OR C|AND B|ST _T1|ST X|LD _T1|AND D|ST Y");
	CHECK_TEXT(lines("RUNG\n | NC A | NO B | COIL X |\n | NO C | NC D ^|\n"
			 " | NC B | --- ^|\n"),
		   "LDN A|AND B|OR( C|ANDN D|)|ORN B|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | NOT | COIL X |\n"), "LD A|NOT|ST X");
	CHECK_TEXT(lines("RUNG\n | COIL X |\n"), "LD TRUE|ST X");
	CHECK_TEXT(lines("RUNG\n | P A | COIL X |\n"),
		   "LD A|ANDN _E1|ST _T1|LD A|ST _E1|LD _T1|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | COILN X |\n"),
		   "LD A|ST _T1|LD _E1|ANDN _T1|ST X|LD _T1|ST _E1");
	CHECK_TEXT(lines("RUNG OFF\n | NO A | COIL X |\nRUNG\n | NO B | COIL Y |\n"),
		   "LD B|ST Y");
}

static void writes_flow_and_boxes(void)
{
	CHECK_TEXT(lines("RUNG\n | NO A | NC B | JMP Far |\nRUNG Far\n | NO A | RET |\n"),
		   "LD A|ANDN B|JMPC Far|Far:|LD A|RETC");
	CHECK_TEXT(lines("RUNG\n | JMP Far |\nRUNG Far\n | RET |\n"),
		   "JMP Far|Far:|RET");
	CHECK_TEXT(lines("RUNG Unused\n | NO A | COIL X |\n"), "LD A|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | [ N > 5 ] | COIL X |\n"),
		   "LD N|GT 5|ST _T1|LD A|AND _T1|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | [ N := N + M * 2 ] |\n"),
		   "MUL(EN := A, IN1 := M, IN2 := 2, ENO => _T1, OUT => _N1)|"
		   "ADD(EN := _T1, IN1 := N, IN2 := _N1, ENO => _T2, OUT => N)");
	CHECK_TEXT(lines("RUNG\n | [ N := -5 ] |\n"),
		   "MOVE(EN := TRUE, IN := INT#-5, ENO => _T1, OUT => N)");
	CHECK_TEXT(lines("RUNG\n | NO A | TON Delay PT:=T#1s ET=>T | COIL X |\n"),
		   "LD A|ST Delay.IN|CAL Delay(PT := T#1s, ET => T)|LD Delay.Q|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | CTUD Up PV:=5 | COIL X |\n | NC B | .CD |\n"
			 " | NO C | .R |\n"),
		   "LD A|ST Up.CU|LDN B|ST Up.CD|LD C|ST Up.R|CAL Up(PV := 5)|"
		   "LD Up.QU|ST X");
	CHECK_TEXT(lines("RUNG\n | NO A | GT IN1:=N IN2:=M | COIL X |\n"),
		   "LD N|GT M|ST _T1|LD A|AND _T1|ST X");
}

/* ---- values a rung began with ---- */

static void keeps_old_values(void)
{
	struct rig rig;

	/* A coil above a contact of the same variable. */
	if (ladder(&rig, "RUNG\n | NO A | COIL X |\n | NO X | COIL Y |\n"
		   " | NC X | NO A | COIL Z |\n", false)) {
		rig_set(&rig, "A", 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "X") == 1);
		CHECK(rig_get(&rig, "Y") == 0 && rig_get(&rig, "Z") == 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "Y") == 1);
		CHECK(rig_get(&rig, "Z") == 0);
	}
	rig_close(&rig);
	/* A box that writes what a branch above has read. */
	if (ladder(&rig, "RUNG\n | NO X | --- | --- | COIL Y |\n"
		   " | ^| NO A | MOVE IN:=FALSE OUT=>X | COIL Z |\n", false)) {
		rig_set(&rig, "X", 1);
		rig_set(&rig, "A", 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "X") == 0);
		CHECK(rig_get(&rig, "Y") == 1 && rig_get(&rig, "Z") == 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "Y") == 0);
	}
	rig_close(&rig);
	/* A word that lies over a contact's bit. */
	if (ladder(&rig, "RUNG\n | NO M33 | --- | COIL Y |\n"
		   " | NO A | MOVE IN:=16#0000 OUT=>%MW4 | COIL Z |\n", false)) {
		rig_set(&rig, "M33", 1);
		rig_set(&rig, "A", 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "M33") == 0);
		CHECK(rig_get(&rig, "Y") == 1 && rig_get(&rig, "Z") == 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "Y") == 0);
	}
	rig_close(&rig);
	/* An instance called below what reads its pin. */
	if (ladder(&rig, "RUNG\n | NO Delay.Q | --- | COIL Y |\n"
		   " | NO A | TON Delay PT:=T#0s | COIL Z |\n", false)) {
		rig_set(&rig, "A", 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "Z") == 1);
		CHECK(rig_get(&rig, "Y") == 0 && rig_scan(&rig));
		CHECK(rig_get(&rig, "Y") == 1);
	}
	rig_close(&rig);
}

/* Outputs of boxes into bits that a byte overlays, and into each other's inputs. */
static void writes_packed_bits(void)
{
	struct rig rig;

	if (ladder(&rig, "RUNG\n | NO A | MOVE IN:=B OUT=>%MX2.3 ENO=>%MX2.4 | COIL X |\n"
		   "RUNG\n | NO C | GT IN1:=N IN2:=5 OUT=>%MX2.5 ENO=>%MX2.6 |\n"
		   "RUNG\n | NO A | CTUD Up PV:=1 QD=>%MX2.7 | COIL %MX2.0 |\n"
		   "RUNG\n | [ %MB2 > 0 ] | COIL Z |\n", false)) {
		CHECK(rig_scan(&rig) && rig_get(&rig, "%MB2") == 0x80);
		rig_set(&rig, "A", 1);
		rig_set(&rig, "B", 1);
		CHECK(rig_scan(&rig) && rig_get(&rig, "%MB2") == 0x19);
		CHECK(rig_get(&rig, "Z") == 1 && rig_get(&rig, "X") == 1);
		rig_set(&rig, "A", 0);
		rig_set(&rig, "C", 1);
		rig_set(&rig, "N", 6);
		CHECK(rig_scan(&rig));
		CHECK_AS(rig_get(&rig, "%MB2") == 0x69, "OUT keeps its value, ENO is FALSE");
		rig_set(&rig, "C", 0);
		rig_set(&rig, "N", 0);
		CHECK(rig_scan(&rig) && rig_get(&rig, "%MB2") == 0x29);
	}
	rig_close(&rig);
}

/* ---- lists ---- */

/* One scan of a list; then what a variable is. */
static int64_t after(const char *body, const char *name)
{
	struct rig rig;
	int64_t value = INT64_MIN;

	if (list(&rig, body)) {
		rig_set(&rig, "A", 1);
		rig_set(&rig, "N", 20);
		if (rig_scan(&rig))
			value = rig_get(&rig, name);
	}
	rig_close(&rig);
	return value;
}

static void runs_operators(void)
{
	CHECK(after("LDN 0\nST X", "X") == 1 && after("LDN 1\nST X", "X") == 0);
	CHECK(after("LD 1\nST X\nST M", "M") == 1);
	CHECK(after("LD 1\nS X\nST M", "X") == 1);
	CHECK(after("LD 0\nJMPC L\nST M\nLD 5\nST M\nL:", "M") == 5);
	CHECK(after("LD 1\nJMPCN L\nLD 7\nST M\nL:", "M") == 7);
	CHECK(after("LD 1\nNOT\nSTN X", "X") == 1);
	CHECK(after("LD 0\nAND X\nSTN Y", "Y") == 1);
	CHECK(after("LD A\nXOR B\nST X", "X") == 1);
	CHECK(after("LD A\nXORN( A\nNOT\n)\nST X", "X") == 0);
	CHECK(after("LD A\nXOR(\nLDN B\nNOT\n)\nST X", "X") == 1);
	CHECK(after("LD A\nANDN(\nLD N\nGT 50\n)\nST X", "X") == 1);
	CHECK(after("LD B\nOR( N\nGT 10\nAND A\n)\nST X", "X") == 1);
	CHECK(after("LD A\nAND( 1\n)\nST X", "X") == 1);
	CHECK(after("LD N\nST M\nST Up.PV", "Up.PV") == 20);
	CHECK(after("LD N\nADD 1\nST N\nST M\nADD 1\nST N", "N") == 22);
	CHECK(after("LD N\nADD 1\nST N\nST M\nADD 1\nST N", "M") == 21);
	CHECK(after("LD N\nDIV M\nST M", "M") == 20);
	CHECK(after("LD A\nRETC\nST X", "X") == 0);
	CHECK(after("LD A\nRETCN\nST X", "X") == 1);
	CHECK(after("LD A\nST X\nRETC", "X") == 1);
	CHECK(after("LD A\nST X\nR X\nST Y", "Y") == 1);
	CHECK(after("LD A\nST X\nR X\nST Y", "X") == 0);
	CHECK(after("LD A\nST X\nLD B\nST X\nLD X\nST Y", "Y") == 0);
}

/* Both sides of a word that is stored over what was loaded. */
static void keeps_loaded_numbers(void)
{
	struct rig rig;

	if (list(&rig, "LD %MW0\nST %MW1\nST %MW4")) {
		rig_set(&rig, "%MW0", 0x1234);
		CHECK(rig_scan(&rig) && rig_get(&rig, "%MW4") == 0x1234);
		CHECK(rig_get(&rig, "%MW1") == 0x1234);
	}
	rig_close(&rig);
}

static void runs_calls(void)
{
	CHECK(after("LD 1\nCALC Up(CU := 1, CV => M)", "M") == 1);
	CHECK(after("LD 0\nCALC Up(CU := 1, CV => M)", "M") == 0);
	CHECK(after("LD 0\nCALCN Up(CU := 1, CV => M)", "M") == 1);
	CHECK(after("LD A\nCALC Up(CU := TRUE, PV := INT#3)", "Up.PV") == 3);
	CHECK(after("LD A\nCALCN Up(CU := TRUE, PV := 3)", "Up.PV") == 0);
	CHECK(after("LD A\nST Up.CU\nCAL Up\nLD Up.CV\nST M", "M") == 1);
	CHECK(after("CAL Delay(IN := A, PT := T#0s, Q => X)", "X") == 1);
	CHECK(after("MOVE(EN := B, IN := 5, OUT => M)", "M") == 0);
	CHECK(after("MOVE(EN := A, IN := SINT#5, OUT => M, ENO => X)", "M") == 5);
	CHECK(after("DIV(IN1 := N, IN2 := M, OUT => N, ENO => X)\nLDN X\nST Y", "Y") == 1);
	CHECK(after("ADD(IN1 := N, IN2 := 1, IN3 := 1, IN4 := INT#8, OUT => M)", "M") == 30);
	CHECK(after("GT(IN1 := N, IN2 := 19, OUT => X)", "X") == 1);
}

/* A bit of two declarations begins with the value of the later one. */
static void begins_with_initial_values(void)
{
	struct rig rig;

	if (rig_open(&rig, "VAR\n  W AT %MW0 : WORD := 16#00F3;\n"
		     "  B AT %MX0.2 : BOOL := TRUE;\n  C AT %MX0.0 : BOOL := FALSE;\n"
		     "  E AT %QX0.0 : BOOL := TRUE;\n  F : BOOL := TRUE;\n"
		     "  R1 AT %QD4 : REAL := 1.5;\n  T : TIME := T#-1s;\nEND_VAR\n"
		     "PROGRAM Main LD\nRUNG\n | NO E | COIL %QX0.1 |\nEND_PROGRAM\n",
		     false)) {
		CHECK(rig_get(&rig, "W") == 0xf6 && rig_get(&rig, "F") == 1);
		CHECK(rig_get(&rig, "%QB0") == 1 && rig_real(&rig, "R1") == 1.5);
		CHECK(rig_get(&rig, "T") == -1000000000);
		CHECK(rig_scan(&rig) && rig_get(&rig, "%QB0") == 3);
	}
	rig_close(&rig);
}

/* A list may declare and use the names of the translation's temporaries. */
static int64_t with_temporaries(const char *body)
{
	static char whole[2000];

	snprintf(whole, sizeof(whole), "VAR\n  _T1, _T2 : BOOL;\nEND_VAR\n%s", body);
	return after(whole, "Y");
}

static void runs_temporaries(void)
{
	CHECK(with_temporaries("LD A\nST _T1\nLD _T1\nST Y") == 1);
	CHECK(with_temporaries("LD A\nST _T1\nLD _T1\nAND _T1\nANDN B\nST Y") == 1);
	CHECK_AS(with_temporaries("LD TRUE\nST _T1\n"
				  "MOVE(EN := FALSE, IN := FALSE, OUT => _T1)\n"
				  "LD _T1\nST Y") == 1,
					"OUT keeps its value if EN is FALSE");
	CHECK(with_temporaries("LD A\nST _T1\nLD B\nCALC Up(QU => _T1)\n"
			       "LD _T1\nST Y") == 1);
	CHECK(with_temporaries("LD A\nST _T1\nLD B\nJMPC L\nLD FALSE\nST _T1\n"
			       "L:\nLD _T1\nST Y") == 0);
	CHECK(with_temporaries("LD A\nST _T1\nLD A\nJMPC L\nLD FALSE\nST _T1\n"
			       "L:\nLD _T1\nST Y") == 1);
	CHECK(with_temporaries("LD A\nST _T1\nLD B\nR _T1\nLD _T1\nST Y") == 1);
	CHECK(with_temporaries("LD X\nOR A\nST _T1\nLD B\nST X\nLD _T1\nST Y") == 1);
	CHECK(with_temporaries("LD X\nORN X\nST _T1\nLD A\nST X\nLD _T1\nAND X\n"
			       "ST _T2\nLD _T1\nAND _T2\nST Y") == 1);
	CHECK(with_temporaries("MOVE(EN := A, IN := 1, OUT => N, ENO => _T1)\n"
			       "LD _T1\nST Y") == 1);
}

static void add(char *list, size_t size, const char *form, int number)
	__attribute__((format(printf, 3, 0)));
static void add(char *list, size_t size, const char *form, int number)
{
	size_t len = strlen(list);

	snprintf(list + len, size - len, form, number);
}

/* 64 parentheses, and 300 contacts in a row. */
static void runs_large_lists(void)
{
	static char body[20000];

	add(body, sizeof(body), "LD B\n", 0);
	for (int i = 0; i < LIMIT_IL_DEPTH; i++)
		add(body, sizeof(body), i % 2 ? "OR( B\n" : "ORN( A\n", 0);
	for (int i = 0; i < LIMIT_IL_DEPTH; i++)
		add(body, sizeof(body), ")\n", 0);
	add(body, sizeof(body), "ST Y", 0);
	/* B or not (A or …). */
	CHECK(after(body, "Y") == 0);
	body[0] = '\0';
	add(body, sizeof(body), "LD A\n", 0);
	for (int i = 0; i < 300; i++)
		add(body, sizeof(body), "ANDN V%d\n", i);
	add(body, sizeof(body), "ST Y", 0);
	CHECK(after(body, "Y") == 1);
	add(body, sizeof(body), "\nLD 1\nST V299", 0);
	CHECK(after(body, "Y") == 1);
	CHECK(after("", "Y") == 0 && after("RET", "Y") == 0);
}

/* ---- watched and not ---- */

static const char *const watched =
	"RUNG\n | NO A | NC B | --- | COIL X |\n | NO X ^| NO C | NOT ^| COILP Y |\n"
	"RUNG\n | P A | [ N := N + 1 ] |\n | N A | [ M := M - N ] | COIL Z |\n"
	"RUNG\n | NO A | CTUD Up PV:=3 CV=>Raw | S M40 |\n | NO B | .R |\n"
	"RUNG\n | NO M32 | NO D | JMP End |\n | NO X | --- | COIL M41 |\n"
	"RUNG\n | [ N MOD 3 = 1 ] | [ A XOR B ] | R M40 |\n"
	"RUNG\n | NO X | TON Delay PT:=T#20ms ET=>T | COILN M42 |\n"
	"RUNG\n | GT IN1:=N IN2:=M OUT=>Z | LT IN1:=N IN2:=50 | COIL M43 |\n"
	"RUNG End\n | NO C | DIV IN1:=N IN2:=M OUT=>N | COIL M44 |\n";

static void watches_without_a_trace(void)
{
	static const char *const name[] = { "X", "Y", "Z", "N", "M", "T", "%MW4",
		"%MB5", "Up.CV", "Delay.ET", "SYS_ERRORS" };
	struct rig plain, seen;
	int64_t before[sizeof(name) / sizeof(name[0])] = { 0 };
	uint32_t random = 1;
	int differ = 0, moved = 0;

	bool good = ladder(&plain, watched, false);

	good &= ladder(&seen, watched, true);
	if (good) {
		for (int scan = 0; scan < 2000; scan++) {
			random = random * 1664525u + 1013904223u;
			rig_set(&plain, "%IB0", random >> 28);
			rig_set(&seen, "%IB0", random >> 28);
			seen.resource.watch = random >> 20 & 3;
			if (!rig_scan(&plain) || !rig_scan(&seen))
				differ++;
			for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++) {
				int64_t value = rig_get(&plain, name[i]);

				differ += value != rig_get(&seen, name[i]);
				moved += value != before[i];
				before[i] = value;
			}
		}
		CHECK_AS(differ == 0,
			 "a watched program computes the same as an unwatched one");
		CHECK(moved > 2000 && rig_get(&plain, "SYS_ERRORS") > 0);
	}
	rig_close(&plain);
	rig_close(&seen);
}

/* ---- the list is the program ---- */

/* Prints the configuration without its variables, which are among the globals already. */
static void print_config(const struct project *project, const struct sink *sink)
{
	struct config *config = project->config;
	const char *from, *end;
	int kept = 0;
	size_t len;
	char *whole;

	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind != CONFIG_VARS)
			config->entry[kept++] = config->entry[i];
	if (!config)
		return;
	config->count = kept;
	whole = text_write(project, &len);
	from = strstr(whole, "\nCONFIGURATION") + 1;
	end = strstr(from, "\nEND_CONFIGURATION\n") + strlen("\nEND_CONFIGURATION\n");
	sink_write(sink, from, (size_t)(end - from));
	free(whole);
}

/* The data types, from the text of the whole project. */
static void print_types(struct project *project, const struct sink *sink)
{
	size_t len;
	char *whole = text_write(project, &len);

	for (const char *from = strstr(whole, "\nTYPE\n"); from; from = strstr(from, "\nTYPE\n")) {
		const char *end = strstr(from, "\nEND_TYPE\n") + strlen("\nEND_TYPE\n");

		sink_write(sink, from, (size_t)(end - from));
		from = end - 1;
	}
	free(whole);
}

static bool print_all(struct ladder *ladder, const struct sink *sink)
{
	struct project *project = ladder_project(ladder);

	sink_text(sink, "RUNGBOARD 1\n");
	print_types(project, sink);
	text_write_vars(project, &project->globals, sink);
	print_config(project, sink);
	for (int i = 0; i < project->pou_count; i++) {
		int count;
		struct var *const *temps = ladder_temporaries(ladder, i, &count);

		if (!pou_print_il(project, &project->pou[i],
				   &project->pou[i].vars, temps, count,
				   ladder_il(ladder, i), sink))
			return false;
	}
	return true;
}

/* The temporaries of a block are members of it in the list: other bytes that do the
 * same. Inputs change at random. */
static bool does_the_same(struct ladder *a, struct ladder *b)
{
	struct ladder *ladder[] = { a, b };
	struct resource resource[2];
	uint32_t random = 1, size = usual_areas()->bytes[AREA_Q];
	bool same = true;

	for (int i = 0; i < 2; i++) {
		const struct program *program = ladder_program(ladder[i]);

		resource_init(&resource[i], program,
			      calloc(1, image_memory_size(program)));
		resource_start(&resource[i]);
	}
	for (int scan = 1; scan <= 2000 && same; scan++) {
		random = random * 1664525 + 1013904223;
		for (int i = 0; i < 2; i++) {
			uint8_t *in = image_area(&resource[i].image, AREA_I);

			in[random >> 30] ^= (uint8_t)(1u << (random >> 24 & 7));
			same &= resource_scan(&resource[i], scan * RIG_PERIOD);
		}
		same &= memcmp(image_area(&resource[0].image, AREA_Q),
			       image_area(&resource[1].image, AREA_Q), size) == 0;
	}
	free(resource[0].image.memory);
	free(resource[1].image.memory);
	return same;
}

/* Its list may be translated to other instructions than the text. */
static bool has_st(const struct project *project)
{
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].st)
			return true;
	return false;
}

static bool same_as_list(const char *path)
{
	struct ladder *from = ladder_new(), *back = ladder_new();
	uint8_t a[32] = { 0 }, b[32] = { 1 };
	struct sink_memory memory;
	struct sink sink;
	bool own = false;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (ladder_load(from, path) && ladder_build(from) &&
	    print_all(from, &sink) &&
	    ladder_load_text(back, "list.rung", memory.text, memory.len) &&
	    ladder_build(back)) {
		code_identity(ladder_program(from), a);
		code_identity(ladder_program(back), b);
		own = (ladder_project(from)->words.count > 0 || has_st(ladder_project(from))) &&
		      does_the_same(from, back);
	}
	rig_say_why(back);
	sink_memory_free(&memory);
	ladder_free(from);
	ladder_free(back);
	return own || memcmp(a, b, 32) == 0;
}

/* The list of a chart has EACH and TICK, which a list in a file may not have. */
static bool has_sfc(const char *path)
{
	struct ladder *ladder = ladder_new();
	bool found = false;

	if (ladder_load(ladder, path))
		for (int i = 0; i < ladder_project(ladder)->pou_count; i++)
			found |= ladder_project(ladder)->pou[i].sfc != NULL;
	ladder_free(ladder);
	return found;
}

static void prints_the_same_program(const char *folder, int least)
{
	DIR *dir = opendir(folder);
	struct dirent *entry;
	char path[400];
	int count = 0;

	while (dir && (entry = readdir(dir)) != NULL) {
		size_t len = strlen(entry->d_name);

		if (len < 5 || strcmp(entry->d_name + len - 5, ".rung") != 0)
			continue;
		snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
		if (has_sfc(path))
			continue;
		CHECK_AS(same_as_list(path), path);
		count++;
	}
	if (dir)
		closedir(dir);
	CHECK(count >= least);
}

int main(void)
{
	writes_contacts_and_coils();
	shares_power();
	stores_eno_at_once();
	stores_numbers_at_once();
	jumps_once();
	nests_as_deep_as_columns();
	writes_flow_and_boxes();
	keeps_old_values();
	writes_packed_bits();
	runs_operators();
	keeps_loaded_numbers();
	runs_calls();
	begins_with_initial_values();
	runs_temporaries();
	runs_large_lists();
	watches_without_a_trace();
	prints_the_same_program("ladders", 8);
	return tap_done();
}
