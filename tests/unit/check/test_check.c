/* SPDX-License-Identifier: MIT
 *
 * test_check - topology and names of rungs that are drawn as text.
 *
 * The drawing here is a few lines of its own (words apart from operands by one
 * blank), so that a fault of the reader cannot hide one of the checks.
 */
#include "engine/check/check.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct project *project;
static struct pou pous[2];
static struct var vars[16];
static int var_count;
static struct var_block block;
static struct arena arena;
static struct diag_list diags;

static uint32_t id(const char *text, size_t len)
{
	return names_intern(&project->names, text, len);
}

static bool has_assignment(const char *text, size_t len)
{
	for (size_t i = 0; i + 1 < len; i++)
		if (text[i] == ':' && text[i + 1] == '=')
			return true;
	return false;
}

static void draw_cell(struct cell *cell, const char *text, size_t len)
{
	const char *blank;

	while (len && *text == ' ')
		text++, len--;
	if (len && text[len - 1] == '^') {
		cell->link = 1;
		len--;
	}
	while (len && text[len - 1] == ' ')
		len--;
	if (!len)
		return;
	if (*text == '[') {
		cell->word = has_assignment(text, len) ? ELEM_ASSIGN :
							 ELEM_COMPARE;
		cell->operand = id(text + 2, len - 4);
		return;
	}
	if (*text == '.') {
		cell->word = ELEM_PIN;
		cell->operand = id(text + 1, len - 1);
		return;
	}
	if (*text == '-') {
		cell->word = ELEM_WIRE;
		return;
	}
	blank = memchr(text, ' ', len);
	cell->word = (uint16_t)word_find(text, blank ? (size_t)(blank - text) :
						       len);
	if (!blank)
		return;
	len -= (size_t)(blank + 1 - text);
	text = blank + 1;
	if (word_row((enum word)cell->word)->kind == WORD_FN) {
		cell->args = id(text, len);
		return;
	}
	blank = memchr(text, ' ', len);
	cell->operand = id(text, blank ? (size_t)(blank - text) : len);
	if (blank)
		cell->args = id(blank + 1, len - (size_t)(blank + 1 - text));
}

/* Rows are `|…|…|` one behind the other, with newlines between. */
static struct rung *draw(const char *text)
{
	struct rung *rung;
	int rows = 1, cols = 0, row = 0, col = 0;

	for (const char *c = text; *c; c++) {
		if (*c == '\n') {
			rows++;
			col = 0;
		} else if (*c == '|' && ++col - 1 > cols) {
			cols = col - 1;
		}
	}
	rung = rung_new(rows, cols);
	rung->line = 5;
	for (const char *c = text; *c; row++) {
		for (col = 0, c++; *c && *c != '\n'; col++) {
			size_t len = strcspn(c, "|");

			draw_cell(rung_cell(rung, row, col), c, len);
			c += len + 1;
		}
		c += *c == '\n';
	}
	return rung;
}

/* The diagnostics as "LD203(2,5)X LD310(1,1)": code, cell, argument. */
static const char *told(void)
{
	static char text[1024];
	size_t len = 0;

	text[0] = 0;
	for (int i = 0; i < diags.count && len < sizeof(text) - 100; i++) {
		const struct diag *d = &diags.diag[i];

		len += (size_t)snprintf(text + len, sizeof(text) - len,
					"%s%s(%d,%d)%s", i ? " " : "",
					diag_code(d->id), d->row, d->col,
					d->arg);
	}
	return text;
}

static const char *topology(const char *drawing)
{
	struct rung *rung = draw(drawing);
	struct network network;
	bool good;

	diag_init(&diags);
	arena_reset(&arena);
	good = network_make(rung, &arena, &network) &&
	       check_rung(project, &pous[0], 3, rung, &network, &arena, &diags);
	CHECK(good == (diags.errors == 0));
	rung_free(rung);
	return told();
}

static void test_good_rungs(void)
{
	CHECK_TEXT(topology("| NO A | COIL B |"), "");
	CHECK_TEXT(topology("| NO A | NC S | --- | COIL M |\n| NO M^|"), "");
	CHECK_TEXT(topology("| COIL A |"), "");
	CHECK_TEXT(topology("| NO A | --- | COIL B |\n| ^| NO C | COIL D |"), "");
	CHECK_TEXT(topology("| NO A | --- | COIL B |\n|^| NO C | COIL D |"), "");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n| NO D^| NO E^|"), "");
	CHECK_TEXT(topology("| NO A | TON T PT:=T#1s |"), "");
	CHECK_TEXT(topology("| NO A | CTU C | COIL Q |\n| NO B | .R |"), "");
	CHECK_TEXT(topology("| NO A | CTU C | COIL Q |\n| | . |\n| NO B | .R |"),
		   "");
	CHECK_TEXT(topology("| NO A | ADD IN1:=1 IN2:=2 OUT=>X |"), "");
	CHECK_TEXT(topology("| [ X > 1 ] | [ X := 0 ] |"), "");
	CHECK_TEXT(topology("| NO A | [ X := 0 ] | COIL B |"), "");
	/* a right rail */
	CHECK_TEXT(topology("| NO A | COIL B |\n| NO C | COIL D^|"), "");
}

static void test_loose_ends(void)
{
	CHECK_TEXT(topology("| | NO A | COIL B |"), "LD201(1,2)A");
	CHECK_TEXT(topology("| | NO A | NO B | COIL C |"), "LD201(1,2)A");
	CHECK_TEXT(topology("| NO A | | COIL C |"),
		   "LD202(1,1)A LD201(1,3)C");
	CHECK_TEXT(topology("| NO A | COIL B |\n| NO C | NOT |"),
		   "LD202(2,2)NOT");
	CHECK_TEXT(topology("| NO A | COIL B |\n| --- | --- |"),
		   "LD202(2,2)---");
	CHECK_TEXT(topology("| NO A | COIL B |\n| | --- | |"), "LD201(2,2)---");
	CHECK_TEXT(topology("| NO A | --- | COIL B |\n| | ---^| |"),
		   "LD201(2,2)---");
	CHECK_TEXT(topology("| NO A | CTU C | COIL Q |\n| | .R |"),
		   "LD201(2,2)R");
	CHECK_AS(!*topology("| | |\n| | |"), "a POU with nothing drawn yet is correct");
	pous[0].rung_count = 2;
	CHECK_TEXT(topology("| | |\n| | |"), "LD207(0,0)");
	pous[0].rung_count = 0;
	CHECK_TEXT(topology("| NO A | NO B |"), "LD212(0,0)");
	CHECK_TEXT(topology("| --- | --- |"), "LD212(0,0)");
	CHECK_TEXT(topology("| NO A | COIL B |\n| NO C |\n| NO D^|"),
		   "LD202(2,1)C LD202(3,1)D");
	CHECK_TEXT(topology("| NO A | COIL B |\n| |\n| NO D^|"), "LD206(3,1)");
	CHECK_TEXT(topology("| NO A^| COIL B |"), "LD206(1,1)");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n|^|\n|^| NO D^|"),
		   "LD206(3,2)");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n|^| ^|\n|^| NO D^|"), "");
}

static void test_wrong_ways(void)
{
	CHECK_TEXT(topology("| NO A | COIL B | COIL C |"), "");
	CHECK_TEXT(topology("| NO A | COIL B | --- | S C | RET |"), "");
	CHECK_TEXT(topology("| NO A | COIL B |\n| NO C | COIL D^|\n| | ^| COIL E |"), "");
	CHECK_TEXT(topology("| NO A | COIL B | [ n := 1 ] |"), "");
	CHECK_TEXT(topology("| NO A | COIL B | NO C | COIL D |"),
		   "LD221(1,2)B");
	CHECK_TEXT(topology("| NO A | RET | COIL D |"), "LD203(1,2)RET");
	CHECK_TEXT(topology("| NO A | COIL B |\n| ---^|"), "LD204(1,1)A");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n| --- | ---^|"),
		   "LD204(1,2)B");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n| NO D | NO E^|\n"
			    "| --- | ---^|"), "LD204(1,2)B LD204(2,2)E");
	CHECK_TEXT(topology("| NO A | NO B | NO C | COIL D |\n"
			    "|^| --- | ---^|"), "LD204(1,3)C");
	CHECK_TEXT(topology("| NO A | NO B | COIL C |\n|^| ---^|"),
		   "LD204(1,2)B");
	/* C's power would come back to D over the wire of row 1 */
	CHECK_TEXT(topology("| NO A | --- | COIL E |\n| NO B | NO C^|\n"
			    "| | NO D | COIL F |"), "LD201(3,2)D");
	CHECK_TEXT(topology("| NO A | --- | COIL E |\n|^| NO D | COIL F |\n"
			    "| NO B | NO C |\n| | |"),
		   "LD202(3,2)C");
	CHECK_TEXT(topology("| NO A | --- | --- | COIL E |\n"
			    "|^| NO D | COIL F |\n"), "");
	CHECK_TEXT(topology("| NO B | NO C | COIL G |\n| NO A | ---^| COIL E |\n"
			    "|^| NO D | COIL F |"), "LD205(3,2)D");
}

static void test_boxes(void)
{
	CHECK_TEXT(topology("| NO A | COIL B |\n| NO C | .R |"), "LD208(2,2)R");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .X |"), "LD209(2,2)X");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .r |\n| NO D | .R |"),
		   "LD210(3,2)R");
	CHECK_TEXT(topology("| NO A | CTU C r:=D |\n| NO B | .R |"),
		   "LD210(2,2)R");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .PV |"),
		   "LD211(2,2)PV");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .Q |"), "LD211(2,2)Q");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .seen |"),
		   "LD209(2,2)seen");
	CHECK_TEXT(topology("| NO A | CTU C |\n| NO B | .CU |"), "LD213(2,2)CU");
	CHECK_TEXT(topology("| NO A | CTU C CU:=B |"), "LD213(1,2)CU" DIAG_AND DIAG_AND "CU:=B");
	CHECK_TEXT(topology("| NO A | ADD EN:=B IN1:=1 IN2:=2 OUT=>X |"),
		   "LD213(1,2)EN" DIAG_AND DIAG_AND "EN:=B");
	CHECK_TEXT(topology("| NO A | MOVE IN:=1 |\n| NO B | .OUT |"),
		   "LD211(2,2)OUT");
	CHECK_TEXT(topology("| NO A | MOVE OUT=>X |\n| NO B | .IN |"), "");
	CHECK_TEXT(topology("| NO A | ADD IN1:=1 OUT=>X |\n| NO B | .IN2 |"),
		   "LD211(2,2)IN2");
	CHECK_TEXT(topology("| NO A | CTU C |\n| | |\n| NO B | .R |"),
		   "LD214(3,2)R");
}

static void test_off(void)
{
	struct rung *rung = draw("| NO A |");
	struct network network;

	rung->off = 1;
	diag_init(&diags);
	arena_reset(&arena);
	CHECK(network_make(rung, &arena, &network));
	CHECK(check_rung(project, &pous[0], 1, rung, &network, &arena, &diags));
	CHECK(diags.count == 0);
	rung_free(rung);
}

/* ---- names ---- */

static void declare(const char *name, enum iec_type type, enum word fb,
		    const char *at)
{
	struct var *var = &vars[var_count++];

	*var = (struct var){ .name = id(name, strlen(name)), .type = type,
			     .fb = fb, .line = var_count };
	var->fold = names_fold(&project->names, var->name);
	if (at)
		iec_addr_parse(at, strlen(at), &var->at);
	block = (struct var_block){ .count = var_count };
	project->globals = (struct var_table){ vars, var_count, &block, 1 };
}

static void forget(void)
{
	var_count = 0;
	project->globals = (struct var_table){ vars, 0, &block, 0 };
}

/* The drawings are rungs of one program; the text before a colon is a label. */
static const char *names(int count, const char *const drawing[], uint8_t *bad)
{
	uint8_t *const all[1] = { bad };
	struct rung *rung[8];
	struct scope *scope;
	bool good;

	for (int i = 0; i < count; i++) {
		const char *bar = strchr(drawing[i], '|');

		rung[i] = draw(bar);
		rung[i]->label = id(drawing[i], (size_t)(bar - drawing[i]));
	}
	pous[0].rung = rung;
	pous[0].rung_count = count;
	diag_init(&diags);
	arena_reset(&arena);
	scope = scope_new(project, &arena);
	good = check_names(scope, bad ? all : NULL, &arena, &diags);
	CHECK(good == (diags.errors == 0));
	for (int i = 0; i < count; i++)
		rung_free(rung[i]);
	pous[0].rung_count = 0;
	return told();
}

static const char *name(const char *drawing)
{
	return names(1, &drawing, NULL);
}

static void test_operands(void)
{
	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, "%IX0.0");
	declare("T", IEC_NONE, FB_TON, NULL);
	declare("W", IEC_INT, ELEM_EMPTY, "%MW0");
	CHECK_TEXT(name("| NO A | TON T PT:=T#1s | COIL Q0 |"), "LD325(0,0)W");
	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, "%IX0.0");
	declare("T", IEC_NONE, FB_TON, NULL);
	CHECK_TEXT(name("| NO A | CTU T |"), "LD309(1,2)T" DIAG_AND "CTU");
	CHECK_TEXT(name("| NO T | COIL A |"), "LD308(1,1)T LD304(1,2)A");
	CHECK_TEXT(name("| NO A | TON T PT:=X Q:=A Z:=1 ET=>A |"),
		   "LD301(1,2)X LD320(1,2)Q LD319(1,2)Z LD304(1,2)A");
	CHECK_TEXT(name("| NO T.Q | COIL T.Q |"),
		   "LD320(1,2)T.Q LD325(0,0)A");
	CHECK_TEXT(name("| NO A | TON T | COIL %QB0 |"), "LD324(1,3)%QB0");
	CHECK_TEXT(name("| NO A | TON T | ADD IN1:=1 OUT=>QB0 |"),
		   "LD321(1,3)IN2");
	CHECK_TEXT(name("| NO A | TON T | ADD IN1:=1 IN2:=1 IN4:=2 OUT=>QB0 |"),
		   "LD321(1,3)IN3");
	CHECK_TEXT(name("| NO A | TON T | [ Y := X + 1 ] |"),
		   "LD301(1,3)X LD301(1,3)Y");
	CHECK_TEXT(name("| NO A | TON T | COIL I0.0 |"), "LD304(1,3)I0.0");
	CHECK_TEXT(name("| NO A | TON T | COIL SYS_FIRST_SCAN |"),
		   "LD304(1,3)SYS_FIRST_SCAN");
}

static void test_declarations(void)
{
	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, "%IX0.0");
	declare("a", IEC_BOOL, ELEM_EMPTY, NULL);
	declare("M1", IEC_BOOL, ELEM_EMPTY, "%IB1");
	declare("Mod", IEC_BOOL, ELEM_EMPTY, "%IX1.0");
	declare("_T1", IEC_BOOL, ELEM_EMPTY, "%IX1.1");
	declare("main", IEC_BOOL, ELEM_EMPTY, "%IX1.2");
	CHECK_TEXT(name("| NO A | NO M1 | NO Mod | NO _T1 | NO main | COIL Q0 |"),
		   "LD302(0,0)a\0371 LD315(0,0)M1 LD318(0,0)M1 LD317(0,0)Mod "
		   "LD317(0,0)_T1 LD302(0,0)main");
	forget();
	declare("K", IEC_INT, ELEM_EMPTY, NULL);
	block.flags = VAR_CONSTANT | VAR_RETAIN;
	CHECK_TEXT(name("| [ K > 0 ] | [ K := 1 ] |"),
		   "LD323(0,0)K LD305(1,2)K");
	vars[0].has_init = true;
	block.flags = 0;
	CHECK_TEXT(name("| [ K > 0 ] | COIL Q0 |"), "");
}

static void test_usage(void)
{
	const char *const twice[] = {
		"| NO A | COIL Q0 |", "| NO A | COIL %QX0.0 |",
		"| NO A | S Q1 |", "| NO A | R Q1 |", "| NO A | COIL Q2 |", "| NO A | COIL Q0 |",
	};
	const char *const calls[] = {
		"| NO A | TON T |", "| NO A | TON T |", "| NO A | TON T |",
	};

	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, "%IX0.0");
	CHECK_TEXT(names(6, twice, NULL), "LD310(1,2)Q0 LD310(1,2)%QX0.0 LD310(1,2)Q0");
	declare("T", IEC_NONE, FB_TON, NULL);
	CHECK_TEXT(names(3, calls, NULL), "LD311(1,2)T");
	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, NULL);
	declare("B", IEC_BOOL, ELEM_EMPTY, NULL);
	CHECK_TEXT(name("| NO A | COIL B |"), "LD312(0,0)A LD313(0,0)B");
	forget();
	declare("A", IEC_BOOL, ELEM_EMPTY, "%MX0.3");
	CHECK_TEXT(name("| NO A | MOVE IN:=1 OUT=>%MB0 |"), "");
	CHECK_TEXT(name("| NO A | MOVE IN:=1 OUT=>%MB1 |"), "LD312(0,0)A");
}

static void test_labels(void)
{
	uint8_t bad[4] = { 0 };
	const char *const ways[] = {
		"Here| NO I0 | JMP there |", "here| --- | RET |",
		"| NO I0 | COIL Q0 |", "There| NO I0 | COIL Q1 |",
	};
	const char *const missing[] = {
		"| NO I0 | JMP Nowhere |", "| NO I0 | COIL Q0 |",
	};

	forget();
	CHECK_TEXT(names(4, ways, bad), "LD307(0,0)here LD314(0,0)");
	CHECK(!bad[0] && bad[1] && !bad[2] && !bad[3]);
	CHECK(diags.diag[1].rung == 3);
	memset(bad, 0, sizeof(bad));
	CHECK_TEXT(names(2, missing, bad), "LD306(1,2)Nowhere");
	CHECK(bad[0] && !bad[1]);
}

static void test_no_program(void)
{
	struct scope *scope;

	forget();
	project->pou_count = 0;
	diag_init(&diags);
	arena_reset(&arena);
	scope = scope_new(project, &arena);
	CHECK(!check_names(scope, NULL, &arena, &diags));
	CHECK_TEXT(told(), "LD326(0,0)");
	project->pou_count = 1;
}

int main(void)
{
	project = project_new("test.rung");
	if (!CHECK(project != NULL))
		return tap_done();
	pous[0] = (struct pou){ .name = id("Main", 4), .file = "test.rung" };
	project->pou = pous;
	project->pou_count = 1;
	arena_init(&arena);
	test_good_rungs();
	test_loose_ends();
	test_wrong_ways();
	test_boxes();
	test_off();
	test_operands();
	test_declarations();
	test_usage();
	test_labels();
	test_no_program();
	arena_free(&arena);
	project->pou = NULL;
	project->pou_count = 0;
	project_free(project);
	return tap_done();
}
