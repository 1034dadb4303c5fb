/* SPDX-License-Identifier: MIT
 *
 * test_classic_read - the reader of ClassicLadder projects: every form of every member, and
 * each error with its member and line. tests/classic/ tests what a project does.
 */
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/classic/inflate.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static struct arena arena;
static struct classic_report report;
static struct diag_list diags;

#define BOX(text) "_FILES_CLASSICLADDER\n" text "_/FILES_CLASSICLADDER\n"
#define MEMBER(name, text) "_FILE-" name "\n" text "_/FILE-" name "\n"
#define RUNG MEMBER("rung_0.csv", "1-0-50/0 , 9-0-0/0 , 50-0-60/0\n")

static const struct classic_project *read_bytes(const void *bytes, size_t len)
{
	arena_free(&arena);
	report_free(&report);
	diag_init(&diags);
	return classic_read(&arena, "x.clprj", bytes, len, &report, &diags);
}

static const struct classic_project *read_text(const char *text)
{
	return read_bytes(text, strlen(text));
}

/* "LD704 rung_0.csv:7", the first message and its place; "" when there is none. */
static const char *told(const char *text)
{
	static char said[200];
	const struct classic_project *project = read_text(text);

	said[0] = '\0';
	if (diags.count)
		snprintf(said, sizeof(said), "%s%s %d: %s", project ? "took, " : "",
			 diag_code(diags.diag[0].id), diags.diag[0].line, diags.diag[0].arg);
	else if (!project)
		snprintf(said, sizeof(said), "refused without a message");
	return said;
}

static void test_what_it_is(void)
{
	static const char *const good[] = { "_FILES_CLASSICLADDER\n", "\x1f\x8b\x08",
		"\xef\xbb\xbf_FILES_CLASSICLADDER\r\n", ";Rung:\n", "; rung :\n", "#LABEL=x\n",
		"\r\n; a comment\n1-0-50-0 , 9-0-0-0\n", " 1-0-50/0", ";Timers:\n1,2\n" };
	static const char *const bad[] = { "", "RUNGBOARD 1\n", "_FILES\n", "; a comment\n",
		"1-0-50", "hello", "(* Rung *)", ";\n;\nRung" };

	for (size_t i = 0; i < sizeof(good) / sizeof(*good); i++)
		CHECK_AS(classic_is(good[i], strlen(good[i])), good[i]);
	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++)
		CHECK_AS(!classic_is(bad[i], strlen(bad[i])), bad[i]);
}

static void test_rung(void)
{
	const struct classic_project *project = read_text(BOX(MEMBER("rung_4.csv",
		"; Rung :\n#VER=3.0\n#LABEL=Here\n#COMMENT=short\n#COMMENT_LONG=longer\n"
		"#PREVRUNG=-1\n#NEXTRUNG=-1\n#NBRLINES=8\n"
		"1-0-50/3[200/7] , 9-0-50/6 , 50-0-60/0\n\n"
		"0-1-60/99 , 103-0-50/1 , 54-1-9/2\n")));
	const struct classic_rung *rung;

	if (!CHECK(project))
		return;
	rung = classic_rung(project, 4);
	CHECK(rung && !classic_rung(project, 3) && !classic_rung(project, 5));
	if (!rung)
		return;
	CHECK_TEXT(rung->label, "Here");
	CHECK_TEXT(rung->comment, "longer");
	CHECK(rung->place.line == 3 && rung->row_line[0] == 11 && rung->row_line[1] == 13);
	CHECK(rung->rows == 2 && rung->columns == 3);
	CHECK(rung->cell[0][0].element == 1 && rung->cell[0][0].variable.type == 50 &&
	      rung->cell[0][0].variable.number == 3);
	CHECK(rung->cell[0][0].variable.index_type == 200 &&
	      rung->cell[0][0].variable.index_number == 7);
	CHECK(rung->cell[0][1].element == 9 && rung->cell[0][1].variable.type == 0);
	CHECK_AS(rung->cell[1][0].top && rung->cell[1][0].variable.number == 0,
		 "a free cell keeps only its link");
	CHECK(rung->cell[1][1].element == 103);
	CHECK(rung->cell[1][2].element == 54 && rung->cell[1][2].top &&
	      rung->cell[1][2].variable.number == 2 && rung->cell[1][2].variable.type == 0);
	CHECK(rung->cell[7][11].element == 0 && rung->cell[7][11].variable.index_type == -1);
	CHECK_AS(project->sections == 1 && project->section[0].first == 4 &&
		 project->section[0].last == 4 && project->section[0].subroutine == -1,
		 "without sections.csv there is one section");
}

#define TEN "9-0-0/0,9-0-0/0,9-0-0/0,9-0-0/0,9-0-0/0,9-0-0/0,"
static void test_ten_columns(void)
{
	const struct classic_project *project = read_text(BOX(MEMBER("rung_0.csv", "#VER=2.0\n"
		TEN "9-0-0/0,1-0-0/7,2-0-0/8,50-1-60/1\n"
		TEN "9-0-0/0,99-1-0/0,99-0-0/0,60-0-0/3\n"
		TEN "9-0-0/0,9-0-0/0,9-0-0/0,0-1-0/0\n")));
	const struct classic_cell (*cell)[CLASSIC_COLUMNS];

	if (!CHECK(project))
		return;
	cell = project->rung[0]->cell;
	CHECK_AS(cell[0][9].element == 50 && cell[0][9].top && !cell[0][10].element &&
		 !cell[0][11].element, "the coil of a rung of ten columns stays in its column");
	CHECK(cell[0][8].element == 2 && cell[0][8].variable.number == 8);
	CHECK_AS(cell[1][9].element == 60 && cell[1][8].element == 99 && cell[1][7].top,
		 "an operation keeps its columns and its link");
	CHECK_AS(cell[2][9].element == 0 && cell[2][9].top, "a free cell keeps its link");
	CHECK(project->rung[0]->columns == 10);
}

static void test_blocks(void)
{
	const struct classic_project *project = read_text(BOX(
		MEMBER("timers.csv", "#VER=2.0\nT7,2,30\nT2,0,4\n")
		MEMBER("monostables.csv", "; Monostables :\n1,3\n2,10\n")
		MEMBER("counters.csv", "14\n0\n")
		MEMBER("timers_iec.csv", "#VER=2.0\nTM3,2,5,2\n")
		MEMBER("registers.csv", "#VER=1.0\nR1,2\n") RUNG));

	if (!CHECK(project))
		return;
	CHECK(project->timer.count == 2 && project->timer.block[0].number == 2);
	CHECK(classic_block(&project->timer, 7) && classic_block(&project->timer, 7)->base == 2 &&
	      classic_block(&project->timer, 7)->preset == 30);
	CHECK(!classic_block(&project->timer, 0));
	CHECK(project->monostable.count == 2 && project->monostable.block[1].base == 2 &&
	      project->monostable.block[1].preset == 10 &&
	      project->monostable.block[1].place.line == 10);
	CHECK(project->counter.count == 2 && project->counter.block[0].preset == 14);
	CHECK(classic_block(&project->iec_timer, 3)->mode == 2 &&
	      classic_block(&project->iec_timer, 3)->preset == 5);
	CHECK(classic_block(&project->reg, 1)->mode == 2 && project->register_list == 500);
}

static void test_tables(void)
{
	const struct classic_project *project = read_text(BOX(
		MEMBER("arithmetic_expressions.csv", "#VER=2.0\n0003,MINI(1,2)\n0001,#\n0000,@200/0@>1\n")
		MEMBER("sections.csv", "#VER=1.0\n#NAME002=b\n#NAME001=K\xfc" "he, a\n"
			"002,1,-1,0,0,3\n001,0,5,0,0,0\n")
		MEMBER("symbols.csv", "%I9, ,\n%TM0,tim,what, it is\n")
		MEMBER("ioconf.csv", "0,0,0,889,0,8,1\n1,-1,2,0,11,1,0,5\n0,0,0,0,0,0\n")
		MEMBER("general.txt", "PERIODIC_REFRESH=20\nSIZE_REGISTER_LIST=7\n") RUNG));

	if (!CHECK(project))
		return;
	CHECK(project->expressions == 2);
	CHECK_TEXT(classic_expression(project, 3), "MINI(1,2)");
	CHECK(!classic_expression(project, 1));
	CHECK(project->sections == 2 && project->section[0].number == 1 &&
	      project->section[0].subroutine == 5);
	CHECK_TEXT(project->section[0].name, "K\xc3\xbche, a");
	CHECK(project->section[1].sequential && project->section[1].page == 3);
	CHECK(project->symbols == 2 && diags.count == 1 &&
	      diags.diag[0].id == DIAG_IMPORT_COMMA && diags.diag[0].line == 17);
	CHECK_TEXT(project->symbol[1].comment, "what");
	CHECK(project->ios == 2 && project->io[0].inverted && project->io[0].sub_device == 889 &&
	      project->io[1].output && project->io[1].first == -1 && project->io[1].setup == 5);
	CHECK_AS(report.count == 0, "unused I/O lines are not reported");
	CHECK(project->period == 20 && project->register_list == 7);
	CHECK_TEXT(classic_setting(project, "PERIODIC_REFRESH"), "20");
	CHECK(!classic_setting(project, "PERIODIC"));
	CHECK_AS(project->members == 6 && strcmp(project->member[3].name, "ioconf.csv") == 0 &&
		 strncmp(project->member[3].text, "0,0,0,889", 9) == 0 &&
		 project->member[3].line == 20, "every member is kept");
}

static void test_oldest_expressions(void)
{
	const struct classic_project *project = read_text(BOX(MEMBER(
		"arithmetic_expressions.csv",
		"; Arithmetic expressions :\n@200/0@>1\n\n5+@200/0@\n#\n@200/1@:=2\n\n") RUNG));

	if (!CHECK(project))
		return;
	CHECK(project->expressions == 3);
	CHECK_TEXT(classic_expression(project, 0), "@200/0@>1");
	CHECK_TEXT(classic_expression(project, 2), "5+@200/0@");
	CHECK_TEXT(classic_expression(project, 4), "@200/1@:=2");
}

#define NONE "-1,-1,-1,-1,-1,-1,-1,-1,-1,"
#define DRAWN "-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,-1,"
static void test_sfc(void)
{
	const struct classic_project *project = read_text(BOX(
		MEMBER("sections.csv", "000,1,-1,0,0,2\n")
		MEMBER("sequential.csv", "#VER=1.0\nC1,0,50/4\nP2,all\nS1,0,20,2,3,4\nS0,1,10,2,0,1\n"
			"T1,1," NONE "0," NONE DRAWN "2,5,6\nN0,2,7,8,a, note\n")));

	if (!CHECK(project))
		return;
	CHECK(project->steps == 2 && project->step[0].number == 10 && project->step[0].initial &&
	      project->step[1].index == 1 && project->step[1].x == 3 && project->step[1].page == 2);
	CHECK(project->transitions == 1 && project->transition[0].activates == 1 &&
	      project->transition[0].activate[0] == 1 &&
	      project->transition[0].deactivates == 1 &&
	      project->transition[0].deactivate[0] == 0 && project->transition[0].y == 6);
	CHECK(project->transition[0].condition.type == 50 &&
	      project->transition[0].condition.number == 4);
	CHECK(project->notes == 2 && project->note[0].page == 2 && project->note[0].x == -1);
	CHECK_TEXT(project->note[1].text, "a, note");
	CHECK(project->rungs == 0 && project->section[0].page == 2);
}

static void test_numeric(void)
{
	const struct classic_project *project = read_text("; Rung :\r\n#LABEL=Go\r\n#COMMENT=c\r\n"
		"1-0-0-3 , 3-0-0/19 , 50-0-60-1\r\n;Rung:\r\n2-0-50-1 , 99-0-0-0 , 10-0-0-1 , 50-0-0-2\r\n"
		"\r\n;Timers:\r\n;Base,Preset\r\n1,10\r\n0 , 2\r\nBase=2\r\nPreset=7\r\n");

	if (!CHECK(project))
		return;
	CHECK(project->dialect == CLASSIC_NUMERIC && project->rungs == 2);
	CHECK_TEXT(project->rung[0]->label, "Go");
	CHECK(project->rung[0]->cell[0][1].element == 3 &&
	      project->rung[0]->cell[0][1].variable.number == 19);
	CHECK(project->rung[1]->place.line == 5 && project->rung[1]->cell[0][2].element == 10);
	CHECK(project->rung[0]->next == 1 && project->section[0].last == 1);
	CHECK(project->timer.count == 3 && project->timer.block[1].base == 0 &&
	      project->timer.block[2].base == 2 && project->timer.block[2].preset == 7);
	project = read_text(";Rung:\n3-0-0-19 1-0-0-39\t9-0-0-0 , 50-0-60-0\n"
		"99-0-0-0 99-0-0-0 20-0-0-1 9-0-0-0\n;Timers:\n0 2\n1 5\n");
	CHECK_AS(project && project->rung[0]->columns == 4 &&
		 project->rung[0]->cell[0][1].variable.number == 39 &&
		 project->rung[0]->cell[1][2].element == 20 && project->timer.count == 2 &&
		 project->timer.block[0].preset == 2, "blanks alone between cells and numbers");
	CHECK_TEXT(told("1-0-0-3 , 50-0-60-1\n"), "");
	CHECK_TEXT(told(";Rung:\n1-0-0-3 ; 50-0-60-1\n"), "LD705 2: 1-0-0-3 ; 50-0-60-1");
	CHECK_TEXT(told(";Timers:\n1,2\n"), "LD711 0: ");
	CHECK_TEXT(told("1-0-0-3\n;Timers:\nwhat\n"), "LD713 3: what");
}

static void test_dialects(void)
{
	const struct classic_project *project = read_text(BOX(RUNG));

	CHECK(project && project->dialect == CLASSIC_UPSTREAM);
	project = read_text(BOX(RUNG MEMBER("com_params.txt", "MODBUS_MAP_COIL_READ=0\n")));
	CHECK(project && project->dialect == CLASSIC_LINUXCNC);
	project = read_text(BOX(RUNG MEMBER("com_params.txt", "MODBUS_MAP_COIL_READ=0\n")
				MEMBER("registers.csv", "")));
	CHECK(project && project->dialect == CLASSIC_UPSTREAM);
}

static void test_texts(void)
{
	const struct classic_project *project;

	project = read_text("\xef\xbb\xbf" BOX(MEMBER("rung_0.csv",
		"#COMMENT=\xe4 b\tc \x01 \x85\r\n#LABEL=\xc3\xa4\r\n1-0-50/0\r\n")));
	if (!CHECK(project))
		return;
	CHECK_TEXT(project->rung[0]->comment, "\xc3\xa4 b c ? ?");
	CHECK_TEXT(project->rung[0]->label, "\xc3\xa4");
	CHECK(project->rung[0]->row_line[0] == 5);
}

static void test_messages(void)
{
	CHECK_TEXT(told(""), "LD101 0: ");
	CHECK_TEXT(told("hello\n"), "LD046 0: gzip");
	CHECK_TEXT(told("_FILES_CLASSICLADDER2\n"), "LD103 1: _FILES_CLASSICLADDER2");
	CHECK_TEXT(told("_FILES_CLASSICLADDER\n" RUNG), "LD702 4: ");
	CHECK_TEXT(told("_FILES_CLASSICLADDER\n"), "LD702 1: ");
	CHECK_TEXT(told("_FILES_CLASSICLADDER\n_FILE-a.csv\n1\n"), "LD703 2: a.csv");
	CHECK_TEXT(told(BOX("_FILE-a.csv\n" RUNG)), "LD703 2: a.csv");
	CHECK_TEXT(told(BOX("_FILE-a.csv\n")), "LD703 2: a.csv");
	CHECK_TEXT(told(BOX(RUNG RUNG)), "LD704 5: rung_0.csv");
	CHECK_TEXT(told(BOX(RUNG MEMBER("rung_00.csv", ""))), "LD704 6: rung_00.csv: rung 0");
	CHECK_TEXT(told(BOX(RUNG "what\n")), "LD713 5: what");
	CHECK_AS(read_text(BOX("")) != NULL, "an empty container is a project");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "T1,1,2\nT1,2,3\n") RUNG)),
		   "LD704 4: timers.csv: timer 1");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "T1,3,2\n") RUNG)), "LD707 3: timers.csv: 3");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "T1,1,-2\n") RUNG)), "LD707 3: timers.csv: -2");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "T99999999999,1,2\n") RUNG)),
		   "LD707 3: timers.csv: 2147483647");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "X1,1\n") RUNG)), "LD713 3: timers.csv: X1,1");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "T1,a\n") RUNG)), "LD708 3: timers.csv: T1,a");
	CHECK_TEXT(told(BOX(MEMBER("timers.csv", "#VER=3.0\n") RUNG)),
		   "LD103 3: timers.csv: #VER=3.0");
	CHECK_TEXT(told(BOX(MEMBER("registers.csv", "R0,3\n") RUNG)),
		   "LD707 3: registers.csv: mode");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "#VER=4.0\n"))), "LD103 3: rung_0.csv: #VER=4.0");
	CHECK_TEXT(told(BOX(MEMBER("rung_10000.csv", ""))), "LD707 3: rung_10000.csv: 10000");
}

static void test_too_many_parts(void)
{
	const size_t size = 1 << 20;
	char *text = malloc(size);
	size_t len = 0;

	if (!CHECK(text))
		return;
	len += (size_t)snprintf(text, size, "_FILES_CLASSICLADDER\n");
	for (int i = 0; i <= 2 * CLASSIC_LIMIT; i++)
		len += (size_t)snprintf(text + len, size - len, "_FILE-x%d.txt\n_/FILE-x%d.txt\n",
					i, i);
	snprintf(text + len, size - len, "_/FILES_CLASSICLADDER\n");
	CHECK_TEXT(told(text), "LD718 40002: x20000.txt");
	free(text);
}

static void test_cells(void)
{
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "9-0-0/0 , 3-0-0-19\n"))),
		   "LD705 3: rung_0.csv: 3-0-0-19");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "9-0-0/0 , 3-0\n"))), "LD705 3: rung_0.csv: 3-0");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "9-0-0/0 9-0-0/0\n"))),
		   "LD705 3: rung_0.csv: 9-0-0/0 9-0-0/0");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "1-0-50/0[200/0\n"))),
		   "LD705 3: rung_0.csv: 1-0-50/0[200/0");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "1-0-50/10000\n"))), "LD707 3: rung_0.csv: 10000");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "1-0-50/-1\n"))), "LD707 3: rung_0.csv: -1");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "1-2-50/1\n"))), "LD707 3: rung_0.csv: 2");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "1-0-50/1[200/1000000000]\n"))),
		   "LD707 3: rung_0.csv: 1000000000");
	CHECK_AS(*told(BOX(MEMBER("rung_0.csv", "0-0-50/-1\n9-0-0/1000000000\n"))) == '\0',
		 "leftover variables of free cells and wires are not checked");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,"
		"0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0,0-0-0/0\n"))),
		   "LD706 3: rung_0.csv");
	read_text(BOX(MEMBER("rung_0.csv", "0-0-0/0\n0-0-0/0\n0-0-0/0\n0-0-0/0\n0-0-0/0\n"
			     "0-0-0/0\n0-0-0/0\n0-0-0/0\n0-0-0/0\n1-0-50/0\n")));
	CHECK_AS(report.count == 1 && report.line[0].line == 12, "rows that ClassicLadder does not have are reported");
}

static void test_whole(void)
{
	CHECK_TEXT(told(BOX(MEMBER("sections.csv", "000,0,-1,0,1,0\n") RUNG)),
		   "took, LD722 6: rung_0.csv");
	CHECK_TEXT(told(BOX(MEMBER("sections.csv", "000,0,-1,12,1,0\n") RUNG)),
		   "LD709 3: sections.csv: rung_12");
	CHECK_TEXT(told(BOX(MEMBER("sections.csv", "000,0,-1,0,1,0\n000,0,-1,0,0,0\n") RUNG)),
		   "LD704 4: sections.csv: section 0");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "#NEXTRUNG=3\n") MEMBER("rung_3.csv",
		"#NEXTRUNG=0\n") MEMBER("sections.csv", "#NAME000=Round\n000,0,-1,0,1,0\n"))),
		   "LD710 3: rung_0.csv: Round");
	CHECK_TEXT(told(BOX(MEMBER("sections.csv", "000,1,-1,0,0,0\n") MEMBER("sequential.csv",
		"S0,1,0,0,0,0\nT0,1," NONE "0," NONE DRAWN "0,0,0\n"))), "LD712 7: sequential.csv");
	CHECK_TEXT(told(BOX(MEMBER("sections.csv", "000,1,-1,0,0,0\n") MEMBER("sequential.csv",
		"T0,1,2\n"))), "LD708 6: sequential.csv: T0,1,2");
	CHECK_TEXT(told(BOX(MEMBER("rung_0.csv", "#LABEL=abcdefghij\n1-0-50/0\n"))),
		   "took, LD720 3: rung_0.csv: abcdefghij");
}

static void test_long(void)
{
	static char text[3000] = "_FILES_CLASSICLADDER\n_FILE-rung_0.csv\n#LABEL=";
	size_t len = strlen(text);

	memset(text + len, 'x', 2500);
	snprintf(text + len + 2500, sizeof(text) - len - 2500,
		 "\n_/FILE-rung_0.csv\n_/FILES_CLASSICLADDER\n");
	CHECK_TEXT(told(text), "LD714 3: rung_0.csv: #LABEL=xxxxxxxxx");
	text[len + 300] = '\n';
	text[len + 301] = ';';
	text[len + 1300] = '\n';
	text[len + 1301] = ';';
	CHECK(strncmp(told(text), "LD114 3: rung_0.csv: xxx", 24) == 0);
	CHECK(!read_bytes(BOX(MEMBER("a.csv", "x\0y\n")), sizeof(BOX(MEMBER("a.csv", "x\0y\n"))) - 1) &&
	      diags.diag[0].id == DIAG_BAD_BYTE && diags.diag[0].line == 3);
}

/* A project that is cut at any byte is an error, never half a project. */
static void test_cut(void)
{
	static const char text[] = BOX(MEMBER("timers.csv", "#VER=2.0\nT0,1,5\n") RUNG
		MEMBER("sections.csv", "#NAME000=a\n000,0,-1,0,0,0\n"));
	int taken = 0, silent = 0;

	for (size_t len = 0; len < sizeof(text) - 2; len++) {
		taken += read_bytes(text, len) != NULL;
		silent += diags.errors == 0;
	}
	CHECK_AS(taken == 0 && silent == 0, "a project that is cut at any byte is refused");
	CHECK(read_bytes(text, sizeof(text) - 2));
}

static void test_many(void)
{
	enum { MEMBERS = 5000, ROOM = 600000 };
	char *text = malloc(ROOM);
	const struct classic_project *project;
	size_t len;

	if (!CHECK(text))
		return;
	len = (size_t)snprintf(text, ROOM, "_FILES_CLASSICLADDER\n");
	for (int i = 0; i < MEMBERS; i++)
		len += (size_t)snprintf(text + len, ROOM - len, "_FILE-rung_%d.csv\n"
			"#NEXTRUNG=%d\n1-0-50/%d\n_/FILE-rung_%d.csv\n", i, i + 1, i, i);
	len += (size_t)snprintf(text + len, ROOM - len, MEMBER("sections.csv",
		"000,0,-1,0,4999,0\n") "_/FILES_CLASSICLADDER\n");
	project = read_bytes(text, len);
	CHECK_AS(project && project->rungs == MEMBERS &&
		 classic_rung(project, 4999)->cell[0][0].variable.number == 4999,
		 "5,000 rungs");
	free(text);
}

static const unsigned char fixed[] = {
	0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x8b, 0x77, 0xf3,
	0xf4, 0x71, 0x0d, 0x8e, 0x77, 0xf6, 0x71, 0x0c, 0x0e, 0xf6, 0x04, 0x92, 0x2e,
	0x2e, 0xae, 0x41, 0x5c, 0xf1, 0x20, 0x41, 0xdd, 0xa2, 0xd2, 0xbc, 0xf4, 0x78,
	0x03, 0xbd, 0xe4, 0xe2, 0x32, 0x2e, 0x43, 0x5d, 0x03, 0x5d, 0x53, 0x03, 0x7d,
	0x03, 0x05, 0x1d, 0x05, 0x4b, 0x20, 0x13, 0xc2, 0x32, 0x05, 0x32, 0x74, 0xcd,
	0x80, 0x6c, 0xae, 0x78, 0x7d, 0x74, 0x0d, 0x10, 0x11, 0x74, 0x73, 0x01, 0xf7,
	0x4a, 0xfb, 0x70, 0x6d, 0x00, 0x00, 0x00,
};
static const unsigned char dynamic[] = {
	0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x25, 0xd4, 0x3b,
	0x0e, 0xc3, 0x40, 0x0c, 0x03, 0xd1, 0x0b, 0x6d, 0x21, 0x6a, 0xfd, 0x5b, 0xe8,
	0xfe, 0xf7, 0x0a, 0x87, 0x29, 0x53, 0x10, 0x1e, 0x3c, 0x39, 0xae, 0x55, 0xf3,
	0x2e, 0x8d, 0xae, 0xd5, 0xd3, 0x5a, 0x7b, 0xfa, 0x5b, 0xd7, 0x5c, 0xeb, 0x1e,
	0x69, 0x3d, 0xa3, 0x6f, 0xbd, 0xd3, 0xf7, 0xfa, 0x46, 0xeb, 0xcc, 0xb7, 0x54,
	0xa3, 0x7b, 0x49, 0xd3, 0xbd, 0xe4, 0xc5, 0xf1, 0xfe, 0x66, 0xdf, 0xde, 0xeb,
	0xb0, 0x7f, 0xbc, 0x6f, 0xef, 0x0f, 0xf3, 0x87, 0xf9, 0xf6, 0x7c, 0x97, 0xf7,
	0x4f, 0xf6, 0x3b, 0xfb, 0xca, 0xfe, 0xf5, 0x7e, 0xb3, 0x2f, 0xf6, 0x2f, 0xfb,
	0xcb, 0xfb, 0xf2, 0xfe, 0x65, 0x7f, 0xb1, 0x97, 0xf7, 0xce, 0x3a, 0xce, 0x62,
	0x2f, 0xf6, 0x0e, 0x63, 0x7f, 0x7b, 0xef, 0xdf, 0x2e, 0x6b, 0xc2, 0x36, 0x5d,
	0x17, 0x59, 0xb7, 0xb3, 0x1e, 0xb2, 0x5e, 0xb2, 0x3e, 0xb2, 0x8e, 0xb3, 0xbc,
	0x3f, 0x99, 0x3f, 0x99, 0x6f, 0x1e, 0xef, 0x12, 0x97, 0x35, 0x61, 0x9b, 0xae,
	0x8b, 0xac, 0xdb, 0x59, 0x0f, 0x59, 0x2f, 0x59, 0x1f, 0x59, 0xc7, 0x59, 0x0a,
	0x57, 0xbc, 0x14, 0xb0, 0xa2, 0x4c, 0x03, 0x9f, 0xe0, 0x13, 0x7c, 0xce, 0xb2,
	0x9f, 0xf7, 0xe8, 0x09, 0x3d, 0x67, 0x1d, 0xb2, 0x14, 0xae, 0x78, 0x29, 0x60,
	0x45, 0x99, 0x39, 0xbc, 0x47, 0x4f, 0xd1, 0xdb, 0x3c, 0xbe, 0xbc, 0x87, 0x4f,
	0xf0, 0x35, 0x7c, 0xce, 0x52, 0xb8, 0xe2, 0xa5, 0x80, 0x15, 0x65, 0x1a, 0xf8,
	0xd0, 0x13, 0x7a, 0xce, 0xba, 0xc9, 0x7a, 0x06, 0x3e, 0xc1, 0x27, 0xf8, 0x9c,
	0xa5, 0x70, 0xe1, 0xa5, 0x80, 0x55, 0x0e, 0x49, 0x59, 0x0f, 0x7c, 0x82, 0x4f,
	0xf0, 0x39, 0xeb, 0x19, 0xf8, 0xd0, 0x53, 0xf4, 0x76, 0x1e, 0x5f, 0xec, 0xc3,
	0x27, 0xf8, 0x38, 0x24, 0x65, 0x3d, 0xf0, 0x09, 0x3e, 0xc1, 0xe7, 0xac, 0x67,
	0xe0, 0x43, 0x4f, 0xe8, 0x39, 0x4b, 0x7f, 0x2e, 0xbc, 0x14, 0xb0, 0xca, 0x21,
	0x29, 0xf3, 0x4f, 0xef, 0xd1, 0x13, 0x7a, 0xce, 0x7a, 0xc8, 0x7a, 0x27, 0x2f,
	0x1f, 0x7c, 0x0a, 0x1f, 0x5c, 0x78, 0x09, 0xb0, 0xca, 0x21, 0x29, 0x6b, 0xc2,
	0xf6, 0xc0, 0x27, 0xf8, 0x1a, 0x3e, 0x67, 0xbd, 0x03, 0x9f, 0xe0, 0x53, 0xf8,
	0xe0, 0xc2, 0x4b, 0x80, 0x55, 0x0e, 0x49, 0x59, 0x13, 0xb6, 0x07, 0x3e, 0xc1,
	0x27, 0xf8, 0x9c, 0x65, 0x3f, 0xef, 0xd1, 0x53, 0xf4, 0xe0, 0x8a, 0x97, 0x00,
	0xab, 0x1c, 0x92, 0xb2, 0x26, 0xcc, 0xaf, 0x8f, 0xf7, 0xe8, 0x29, 0x7a, 0x9b,
	0xc7, 0x97, 0xf7, 0xf0, 0x29, 0x7c, 0x1d, 0x3e, 0x2e, 0x09, 0x58, 0xe5, 0x90,
	0x94, 0x35, 0x61, 0x7b, 0xe0, 0x43, 0x4f, 0xe8, 0x39, 0xeb, 0x25, 0xeb, 0x1b,
	0xf8, 0x14, 0x3e, 0x85, 0x8f, 0x4b, 0x02, 0x56, 0x1c, 0x92, 0xb2, 0x26, 0x6c,
	0xd3, 0x75, 0x4d, 0x5e, 0x3e, 0xf8, 0x04, 0x9f, 0xb3, 0xfc, 0xfa, 0x78, 0x1f,
	0x3d, 0xfd, 0xf5, 0x76, 0x1e, 0x5f, 0xde, 0xc3, 0x27, 0xf8, 0x1a, 0x3e, 0x77,
	0x5d, 0x03, 0x9f, 0xe0, 0x13, 0x7c, 0xce, 0xfa, 0x06, 0xbe, 0xe8, 0x29, 0x7a,
	0x5c, 0x32, 0x60, 0xc5, 0x21, 0x29, 0x6b, 0xc2, 0x36, 0x5d, 0xf6, 0xf3, 0x1e,
	0x3d, 0xa1, 0xe7, 0xac, 0x8f, 0xac, 0x33, 0xff, 0x97, 0x2f, 0x7c, 0x0a, 0x9f,
	0xcb, 0x8a, 0x43, 0x0e, 0x7a, 0x8a, 0xde, 0xe6, 0xf1, 0xfc, 0xf9, 0xe1, 0x13,
	0x7c, 0x0d, 0x9f, 0xb3, 0xce, 0x84, 0x4f, 0xe1, 0x53, 0xf8, 0x5c, 0x56, 0x1c,
	0x72, 0xd0, 0x13, 0x7a, 0xee, 0xba, 0xc8, 0xba, 0x07, 0x3e, 0xc1, 0x27, 0xf8,
	0x9c, 0x75, 0x26, 0x7c, 0xd1, 0x53, 0xf4, 0x5c, 0x56, 0x39, 0xe4, 0xe4, 0xe5,
	0x83, 0x4f, 0xf0, 0x39, 0xcb, 0xaf, 0x8f, 0xf7, 0xe8, 0x29, 0x7a, 0x9b, 0xc7,
	0xe7, 0xcf, 0x1f, 0x3e, 0x85, 0xaf, 0xe1, 0xe3, 0x90, 0x03, 0x9f, 0xe0, 0x13,
	0x7c, 0xcd, 0xc7, 0x13, 0x3e, 0xf4, 0x84, 0x5e, 0xf3, 0xed, 0xec, 0x7c, 0x3c,
	0xc3, 0xa7, 0xf0, 0x09, 0xbe, 0xce, 0xc7, 0xd3, 0x7b, 0xf4, 0x84, 0x5e, 0xf3,
	0xed, 0x6c, 0x3e, 0x9e, 0x79, 0xf9, 0xe0, 0x13, 0x7c, 0x9d, 0x8f, 0x67, 0xf8,
	0xa2, 0x27, 0xf4, 0x7e, 0xeb, 0x70, 0x26, 0x4d, 0xbf, 0x05, 0x00, 0x00,
};
static const unsigned char stored[] = {
	0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x04, 0x03, 0x01, 0x03, 0x00,
	0xfc, 0xff, 0x61, 0x62, 0x63, 0xc2, 0x41, 0x24, 0x35, 0x03, 0x00, 0x00, 0x00,
};

static char *unpack(const unsigned char *bytes, size_t len, size_t limit, size_t *out,
		    enum diag_id *why)
{
	arena_free(&arena);
	return inflate_gzip(&arena, bytes, len, limit, out, why);
}

static void test_packed(void)
{
	unsigned char changed[sizeof(dynamic)];
	enum diag_id why;
	size_t len = 0;
	char *text = unpack(stored, sizeof(stored), 3, &len, &why);
	int taken = 0;

	CHECK(text && len == 3 && strcmp(text, "abc") == 0);
	CHECK(!unpack(stored, sizeof(stored), 2, &len, &why) && why == DIAG_TOO_LARGE);
	text = unpack(dynamic, sizeof(dynamic), 10000, &len, &why);
	CHECK(text && strncmp(text, "0,0;7,1;14,2;21,3;28,4;4,5;", 27) == 0);
	CHECK(inflate_crc32(0, "123456789", 9) == 0xcbf43926);
	CHECK(read_bytes(fixed, sizeof(fixed)) && diags.count == 0);
	for (size_t i = 0; i < sizeof(dynamic) - 1; i++)
		taken += unpack(dynamic, i, 10000, &len, &why) != NULL;
	CHECK_AS(taken == 0, "a packed project that is cut is refused");
	/* A changed bit can give the same text: a copy from another place. */
	for (size_t i = 10; i < sizeof(dynamic); i++) {
		memcpy(changed, dynamic, sizeof(dynamic));
		changed[i] ^= 1;
		text = unpack(changed, sizeof(changed), 10000, &len, &why);
		taken += text && strncmp(text, "0,0;7,1;14,2;21,3;28,4;4,5;", 27) != 0;
	}
	CHECK_AS(taken == 0,
		 "a packed project with a changed bit is refused or gives the same text");
	CHECK(!read_bytes(dynamic, sizeof(dynamic) - 1) &&
	      diags.diag[0].id == DIAG_IMPORT_PACKED);
	memcpy(changed, dynamic, sizeof(dynamic));
	memset(changed + sizeof(dynamic) - 4, 0x7f, 4);
	CHECK_AS(!read_bytes(changed, sizeof(changed)) && diags.diag[0].id == DIAG_IMPORT_PACKED,
		 "a packed size of 2 GB is refused before unpacking");
	changed[sizeof(dynamic) - 1] = changed[sizeof(dynamic) - 2] = 0;
	CHECK_AS(!unpack(changed, sizeof(changed), 10000, &len, &why) && why == DIAG_TOO_LARGE,
		 "unpacking stops at its limit of bytes");
	CHECK(!read_bytes(stored, sizeof(stored)) && diags.diag[0].id == DIAG_IS_PACKED);
}

static void put_file(const char *folder, const char *name, const char *text)
{
	char path[300];
	FILE *file;

	snprintf(path, sizeof(path), "%s/%s", folder, name);
	file = fopen(path, "w");
	if (file) {
		fputs(text, file);
		fclose(file);
	}
}

static void test_folder(void)
{
	char folder[] = "/tmp/classicXXXXXX", path[300];
	const struct classic_project *project;

	arena_free(&arena);
	report_free(&report);
	diag_init(&diags);
	if (!CHECK(mkdtemp(folder)))
		return;
	put_file(folder, "rung_0.csv", "1-0-50/0 , 50-0-60/0\n");
	put_file(folder, "timers.csv", "1,10\n");
	put_file(folder, "notes.doc", "not ours\n");
	project = classic_read_folder(&arena, folder, &report, &diags);
	CHECK(project && project->rungs == 1 && project->timer.count == 1 &&
	      project->members == 2 && project->timer.block[0].place.line == 1);
	put_file(folder, "timers.csv", "1,10\n7,10\n");
	CHECK(!classic_read_folder(&arena, folder, &report, &diags) &&
	      diags.diag[0].id == DIAG_IMPORT_RANGE && diags.diag[0].line == 2);
	CHECK_TEXT(diags.diag[0].arg, "timers.csv: 7");
	for (int i = 0; i < 3; i++) {
		static const char *const name[] = { "rung_0.csv", "timers.csv", "notes.doc" };

		snprintf(path, sizeof(path), "%s/%s", folder, name[i]);
		unlink(path);
	}
	diag_init(&diags);
	CHECK(!classic_read_folder(&arena, folder, &report, &diags) &&
	      diags.diag[0].id == DIAG_NOT_A_FILE);
	put_file(folder, "notes.txt", "not ours either\n");
	diag_init(&diags);
	CHECK(!classic_read_folder(&arena, folder, &report, &diags) &&
	      diags.diag[0].id == DIAG_IMPORT_NOTHING);
	snprintf(path, sizeof(path), "%s/notes.txt", folder);
	unlink(path);
	rmdir(folder);
	diag_init(&diags);
	CHECK(!classic_read_folder(&arena, folder, &report, &diags) &&
	      diags.diag[0].id == DIAG_CANNOT_READ);
}

int main(void)
{
	arena_init(&arena);
	report_init(&report);
	test_what_it_is();
	test_rung();
	test_ten_columns();
	test_blocks();
	test_tables();
	test_oldest_expressions();
	test_sfc();
	test_numeric();
	test_dialects();
	test_texts();
	test_messages();
	test_too_many_parts();
	test_cells();
	test_whole();
	test_long();
	test_cut();
	test_many();
	test_packed();
	test_folder();
	arena_free(&arena);
	report_free(&report);
	return tap_done();
}
