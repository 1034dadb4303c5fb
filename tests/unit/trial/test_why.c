/* SPDX-License-Identifier: MIT
 *
 * test_why - changing the listed contacts turns the coil on, changing fewer does not:
 * random circuits of contacts, explained and then tried in the VM.
 */
#include "engine/trial/why.h"
#include "tests/unit/rig.h"
#include "tests/walker/random.h"

#define CIRCUITS 3000
#define INPUTS   8
#define ASKS     24 /* inputs that each circuit is tried with                 */

static struct random_source source;
static struct why why;

/* ---- random circuits ---- */

static const char *between(void)
{
	return random_chance(&source, 20) ? " XOR " : random_chance(&source, 50) ? " AND " : " OR ";
}

/* `[ a AND NOT (b OR c) ]`: its parts are contacts, too. */
static void put_expression(char *out, size_t size)
{
	const int parts = 1 + (int)random_below(&source, 4);
	int open = 0;
	size_t used = (size_t)snprintf(out, size, "[ ");

	for (int i = 0; i < parts; i++) {
		const bool opens = i + 1 < parts && random_chance(&source, 40);

		used += (size_t)snprintf(out + used, size - used, "%s%s%s%%IX0.%u",
			i == 0 ? "" : between(),
			random_chance(&source, 30) ? "NOT " : "", opens ? "(" : "",
			random_below(&source, INPUTS));
		open += opens;
		if (open && !opens && random_chance(&source, 50)) {
			used += (size_t)snprintf(out + used, size - used, ")");
			open--;
		}
	}
	snprintf(out + used, size - used, "%.*s ]", open, "))))");
}

/* A circuit of contacts, expressions and wires with random links, and a coil. */
static void make_rung(struct random_rung *rung)
{
	memset(rung, 0, sizeof(*rung));
	rung->rows = 1 + (int)random_below(&source, 4);
	rung->cols = 3 + (int)random_below(&source, 4);
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			struct random_cell *cell = &rung->cell[row][col];
			const uint32_t dice = random_below(&source, 10);

			cell->link = row > 0 && random_chance(&source, 45);
			if (col == rung->cols - 1) {
				cell->link = false;
				cell->kind = row ? RANDOM_EMPTY : RANDOM_LAST;
				snprintf(cell->text, RANDOM_TEXT, row ? "" :
					 "COIL %%QX0.0");
			} else if (dice < 7 || row == 0) {
				cell->kind = dice < 1 ? RANDOM_WIRE : RANDOM_SERIES;
				if (dice >= 1)
					snprintf(cell->text, RANDOM_TEXT, "%s %%IX0.%u",
						 random_chance(&source, 60) ? "NO" : "NC",
						 random_below(&source, INPUTS));
			} else {
				cell->kind = dice < 8 ? RANDOM_WIRE : RANDOM_EMPTY;
			}
		}
}

/* A circuit of one expression. */
static void make_expression(struct random_rung *rung)
{
	memset(rung, 0, sizeof(*rung));
	rung->rows = 1;
	rung->cols = 2;
	rung->cell[0][0].kind = RANDOM_SERIES;
	put_expression(rung->cell[0][0].text, RANDOM_TEXT);
	rung->cell[0][1].kind = RANDOM_LAST;
	snprintf(rung->cell[0][1].text, RANDOM_TEXT, "COIL %%QX0.0");
}

static size_t print_rung(const struct random_rung *rung, char *out, size_t size)
{
	size_t used = (size_t)snprintf(out, size, "PROGRAM Main LD\nRUNG\n");

	for (int row = 0; row < rung->rows; row++) {
		used += (size_t)snprintf(out + used, size - used, "  |");
		for (int col = 0; col < rung->cols; col++) {
			const struct random_cell *cell = &rung->cell[row][col];

			used += (size_t)snprintf(out + used, size - used, " %s%s|",
				cell->kind == RANDOM_WIRE ? "--- " : cell->text,
				cell->link ? "^" : " ");
		}
		used += (size_t)snprintf(out + used, size - used, "\n");
	}
	return used + (size_t)snprintf(out + used, size - used, "END_PROGRAM\n");
}

/* As rig_open(), but a refused program is no failure. */
static bool open_circuit(struct rig *rig, const char *text)
{
	char file[8192];

	memset(rig, 0, sizeof(*rig));
	snprintf(file, sizeof(file), "RUNGBOARD 1\n%s", text);
	rig->ladder = ladder_new();
	ladder_watch(rig->ladder, true);
	rig->good = ladder_load_text(rig->ladder, "why.rung", file, strlen(file)) &&
		    ladder_build(rig->ladder);
	if (!rig->good)
		return false;
	rig->memory = calloc(1, image_memory_size(ladder_program(rig->ladder)));
	resource_init(&rig->resource, ladder_program(rig->ladder), rig->memory);
	rig->resource.watch = true;
	resource_start(&rig->resource);
	return true;
}

static bool coil_with(struct rig *rig, unsigned inputs)
{
	*image_area(&rig->resource.image, AREA_I) = (uint8_t)inputs;
	rig_scan(rig);
	return *image_area(&rig->resource.image, AREA_Q) & 1;
}

static bool ask(struct rig *rig, int rung, int row, int col)
{
	struct why_place place = { .project = ladder_project(rig->ladder),
		.resource = &rig->resource, .rung = rung, .row = row, .col = col };
	struct arena arena;
	bool good;

	while (place.project->pou[place.pou].kind != POU_PROGRAM)
		place.pou++;

	arena_init(&arena);
	good = why_ask(&place, &arena, &why);
	arena_free(&arena);
	return good;
}

/* The inputs that this way changes. */
static unsigned inputs_of(const struct why_way *way)
{
	unsigned inputs = 0;

	for (int i = 0; i < way->count; i++)
		inputs |= 1u << (way->cell[i].name[5] - '0');
	return inputs;
}

static int asked_off, asked_on, ways, never, whole;

/* Whether the coil is on after a change of all inputs of @flip, and off after fewer. */
static bool is_way(struct rig *rig, unsigned inputs, unsigned flip)
{
	ways++;
	if (!coil_with(rig, inputs ^ flip))
		return false;
	for (unsigned less = (flip - 1) & flip; less; less = (less - 1) & flip)
		if (coil_with(rig, inputs ^ less))
			return false;
	return true;
}

/* All other inputs have random values. */
static bool is_held(struct rig *rig, unsigned inputs, unsigned by)
{
	ways++;
	for (int i = 0; i < 8; i++)
		if (!coil_with(rig, (inputs & by) | (random_next(&source) & 255u & ~by)))
			return false;
	return true;
}

static bool can_ever(struct rig *rig)
{
	for (unsigned inputs = 0; inputs < 256; inputs++)
		if (coil_with(rig, inputs))
			return true;
	return false;
}

static bool try_inputs(struct rig *rig, unsigned inputs, int coil)
{
	const bool on = coil_with(rig, inputs);
	static struct why copy;

	if (!ask(rig, 1, 1, coil) || why.on != on)
		return false;
	copy = why;
	*(on ? &asked_on : &asked_off) += 1;
	if (copy.whole == WHY_NEVER) {
		never++;
		return !can_ever(rig);
	}
	/* An expression that no change of its parts makes TRUE is listed as a whole. */
	if (copy.ways == 1 && copy.way[0].cell[0].kind == WHY_COMPARE) {
		whole++;
		return !on && !can_ever(rig);
	}
	for (int i = 0; i < copy.ways; i++) {
		const unsigned named = inputs_of(&copy.way[i]);

		if (on ? !is_held(rig, inputs, named) : !is_way(rig, inputs, named))
			return false;
		/* The shortest first. */
		if (i && copy.way[i].count < copy.way[i - 1].count)
			return false;
	}
	return copy.ways > 0 && copy.whole == WHY_COUNT;
}

static void test_circuits(void (*make)(struct random_rung *rung))
{
	static struct random_rung rung;
	char text[4096];
	struct rig rig;
	const int circuits = tap_rounds(CIRCUITS);
	int built = 0, wrong = 0;

	random_seed(&source, 7);
	for (int i = 0; i < 400000 && built < circuits; i++) {
		make(&rung);
		if (!random_sound(&rung))
			continue;
		print_rung(&rung, text, sizeof(text));
		if (open_circuit(&rig, text)) {
			bool good = true;

			built++;
			for (int k = 0; k < ASKS && good; k++)
				good = try_inputs(&rig, random_next(&source) & 255u,
						  rung.cols);
			wrong += !good;
			if (!good && wrong < 3)
				printf("# %s", text);
			free(rig.memory);
		}
		ladder_free(rig.ladder);
	}
	printf("# %d circuits: asked %d times while off, %d while on; %d ways tried, "
	       "%d times there was none, %d times an expression can never hold\n", built,
	       asked_off, asked_on, ways, never, whole);
	CHECK(built == circuits && wrong == 0);
	CHECK(asked_off > tap_rounds(2000) && asked_on > tap_rounds(1000) && ways > tap_rounds(5000));
}

/* ---- by hand ---- */

static const char program[] =
	"VAR\n  A : BOOL;\n  B : BOOL;\n  N : INT := 3;\n  Wait : TON;\n  Inner : Seal;\n"
	"END_VAR\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR\n  Ready : BOOL;\n"
	"END_VAR\nVAR_OUTPUT\n  Run : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO On | NO Ready | COIL Run |\nEND_FUNCTION_BLOCK\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO A | TON Wait PT:=T#50ms | COIL %QX0.0 | COIL %QX0.7 |\n"
	"RUNG\n  | [ N > 5 ] | NO B | COIL %QX0.1 |\n"
	"RUNG\n  | P A | COIL %QX0.2 |\n"
	"RUNG\n  | NO A | NC A | COIL %QX0.3 |\n"
	"RUNG\n  | NO A | NOT | COIL %QX0.4 |\n"
	"RUNG\n  | NO B | JMP Over |\n"
	"RUNG\n  | NO A | COIL %QX0.5 |\n"
	"RUNG OFF\n  | NO A | COIL %QX0.6 |\n"
	"RUNG Over\n  | NO A | Seal Inner |\n"
	"END_PROGRAM\n";

static const struct why_cell *first(void)
{
	return &why.way[0].cell[0];
}

static void test_by_hand(void)
{
	struct rig rig;

	rig_open(&rig, program, true);
	CHECK(ask(&rig, 1, 1, 3) && why.whole == WHY_NOT_RUN);
	rig_set(&rig, "A", 1);
	rig_scan(&rig);
	rig_scan(&rig);
	CHECK(ask(&rig, 1, 1, 3) && !why.on && why.ways == 1 && why.way[0].count == 1);
	CHECK(first()->kind == WHY_BLOCK && first()->powered);
	CHECK_TEXT(first()->values, "IN=1 Q=0 PT=50 ET=10");
	CHECK(ask(&rig, 1, 1, 4) && !why.on && why.ways == 1 && why.way[0].count == 1 &&
	      first()->kind == WHY_BLOCK);
	CHECK(ask(&rig, 2, 1, 3) && why.way[0].count == 2);
	CHECK(first()->kind == WHY_COMPARE && first()->powered &&
	      !why.way[0].cell[1].powered);
	CHECK_TEXT(first()->values, "N=3");
	CHECK_TEXT(why.way[0].cell[1].name, "B");
	CHECK(ask(&rig, 3, 1, 2) && first()->kind == WHY_EDGE);
	CHECK(ask(&rig, 4, 1, 3) && why.whole == WHY_NEVER && why.ways == 0);
	CHECK(ask(&rig, 5, 1, 3) && first()->kind == WHY_INVERTED &&
	      why.way[0].count == 1);
	CHECK(ask(&rig, 7, 1, 2) && why.on && first()->kind == WHY_CONTACT);
	CHECK_TEXT(why_text(WHY_CONTACT, true), "%s is TRUE");
	CHECK(ask(&rig, 8, 1, 2) && why.whole == WHY_RUNG_OFF);
	CHECK(ask(&rig, 9, 1, 1) && why.on && why.ways == 1 && why.way[0].count == 0);
	rig_set(&rig, "B", 1);
	rig_scan(&rig);
	CHECK(ask(&rig, 7, 1, 2) && why.whole == WHY_SKIPPED && why.by_rung == 6);
	CHECK(!ask(&rig, 99, 1, 1) && !ask(&rig, 1, 2, 1) && !ask(&rig, 1, 1, 5));
	resource_stop(&rig.resource);
	CHECK(ask(&rig, 7, 1, 2) && why.whole == WHY_STOPPED);
	resource_fail(&rig.resource, FAULT_IO);
	CHECK(ask(&rig, 7, 1, 2) && why.whole == WHY_FAULTED);
	rig_close(&rig);
}

static void test_instance(void)
{
	struct why_place place = { .instance = "Inner", .rung = 1, .row = 1, .col = 3 };
	struct arena arena;
	struct rig rig;

	rig_open(&rig, program, true);
	rig_set(&rig, "A", 1);
	rig_scan(&rig);
	place.project = ladder_project(rig.ladder);
	place.resource = &rig.resource;
	while (place.project->pou[place.pou].kind != POU_BLOCK)
		place.pou++;
	arena_init(&arena);
	CHECK(why_ask(&place, &arena, &why) && !why.on && why.ways == 1);
	CHECK(why.way[0].count == 1 && first()->powered);
	CHECK_TEXT(first()->name, "Ready");
	rig_set(&rig, "A", 0);
	rig_scan(&rig);
	CHECK(why_ask(&place, &arena, &why) && why.way[0].count == 2);
	arena_free(&arena);
	rig_close(&rig);
}

int main(void)
{
	test_by_hand();
	test_instance();
	test_circuits(make_rung);
	test_circuits(make_expression);
	return tap_done();
}
