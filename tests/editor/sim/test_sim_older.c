/* SPDX-License-Identifier: MIT
 *
 * test_sim_older - scans before an edit: each is shown with the program that ran it, and is
 * what a fresh run computes that does the same; together they stay within a limit of memory.
 *
 *   test_sim_older [COUNT [SEED]]    so many random programs with a random edit
 */
#include "editor-gtk/live/timing.h"
#include "editor-gtk/sim/sim_thread.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include "engine/trial/why.h"

#include <stdlib.h>
#include <string.h>

#define PROGRAMS 200
#define PARTS 3          /* before and after the edit                          */
#define LINES 4          /* of a chart, for each program                       */
#define TEXT_MAX (128 * 1024)
#define EDITS 12         /* of a program with a thousand numbers               */
#define EACH 10000       /* scans between two edits                           */

static LadderDocument *document;
static LadderSim *sim;
static GArray *states;   /* of guint64: states of a fresh run, scan by scan */
static int programs_changed;
static guint64 compared, olds;

/* ---- a run of one's own ---- */

static guint64 sum(const void *bytes, gsize size)
{
	guint64 hash = 14695981039346656037u;

	for (gsize i = 0; i < size; i++)
		hash = (hash ^ ((const guint8 *)bytes)[i]) * 1099511628211u;
	return hash;
}

static guint64 state_of(const struct twin *twin)
{
	return sum(twin->resource.image.memory, twin->memory_size) ^
	       (guint64)twin->now_ns ^ (guint64)twin->resource.state << 60;
}

struct run {
	struct twin twin;
	struct sim_program *program;
};

static void run_some(struct run *run, int scans)
{
	const struct act start = { .kind = ACT_START };
	guint64 state;

	if (run->twin.resource.state != STATE_RUN)
		twin_act(&run->twin, &start);
	while (scans-- > 0 && run->twin.resource.state == STATE_RUN) {
		twin_scan(&run->twin);
		state = state_of(&run->twin);
		g_array_append_val(states, state);
	}
}

static void run_change(struct run *run, const char *text)
{
	struct sim_program *program = sim_program_read_listed(ladder_new(),
		g_intern_static_string("-"), text, strlen(text), NULL);
	struct twin next = { 0 };

	CHECK(program && twin_init(&next, program->program, NULL, run->twin.period_ns) &&
	      twin_change(&next, &run->twin));
	twin_free(&run->twin);
	sim_program_unref(run->program);
	run->twin = next;
	run->program = program;
}

/* ---- both ---- */

static void scan_both(struct run *run, int scans)
{
	run_some(run, scans);
	ladder_sim_scan(sim, scans);
	CHECK_SOON(ladder_sim_twin(sim)->scan == run->twin.scan);
}

static void click_both(struct run *run, struct random_source *random)
{
	char name[16];
	struct act act = { .kind = ACT_SET, .value.i = random_chance(random, 50) };

	g_snprintf(name, sizeof(name), "%%IX0.%u", random_below(random, 8));
	act.at = image_find(&ladder_sim_twin(sim)->resource.image, name, strlen(name));
	if (act.at.type == IEC_NONE)
		return;
	ladder_sim_act(sim, &act);
	act.at = image_find(&run->twin.resource.image, name, strlen(name));
	CHECK(twin_act(&run->twin, &act));
}

static void play_some(struct run *run, struct random_source *random)
{
	for (int i = 0; i < PARTS && run->twin.resource.state != STATE_FAULT; i++) {
		click_both(run, random);
		scan_both(run, 1 + (int)random_below(random, 25));
	}
}

/* Edits as a person does: checked, built in a thread, exchanged. */
static void edit(const char *text)
{
	const int before = programs_changed;
	gsize len;
	char *now = ladder_document_text(document, &len);

	CHECK(ladder_document_replace(document, 0, len, text, NULL));
	g_free(now);
	ladder_document_check_now(document);
	CHECK_SOON(programs_changed > before && ladder_sim_rung(sim, document, 0, 0) == 0);
}

/* ---- what is shown of it ---- */

static bool chart_is(const struct timing *timing, guint64 scan)
{
	const struct image *image = &ladder_sim_twin(sim)->resource.image;

	for (int i = 0; i < timing_lines(timing); i++) {
		const struct location at = image_find(image, timing_name(timing, i),
						      strlen(timing_name(timing, i)));
		const double is = at.type == IEC_NONE ? 0 : (double)image_get(image, at).i;

		if (timing_value(timing, i, scan) != is)
			return false;
	}
	return timing_time(timing, scan) == ladder_sim_twin(sim)->now_ns;
}

/* Variables of both programs; some are in one of them only. */
static struct timing *chart_of(const struct twin *const twins[], int count)
{
	struct timing *timing = timing_new(sim);

	for (int i = 0; i < count; i++) {
		struct symbol_cursor cursor = { 0 };
		struct symbol symbol;
		int lines = 0;

		while (lines < LINES &&
		       image_next_symbol(&twins[i]->resource.image, &cursor, &symbol))
			if (symbol.at.type == IEC_BOOL || symbol.at.type == IEC_INT)
				lines += timing_add(timing, symbol.name);
	}
	while (timing_feed(timing, 100000))
		;
	return timing;
}

static bool show_is(guint64 scan, guint64 edited, const struct timing *timing,
		    const char *text)
{
	struct sim_edited ended = { 0 };
	LadderDocument *older;
	gsize len;
	char *was;
	bool good = ladder_sim_show(sim, scan) && ladder_sim_twin(sim)->scan == scan &&
		    state_of(ladder_sim_twin(sim)) ==
		    g_array_index(states, guint64, scan - 1) && chart_is(timing, scan);

	older = ladder_sim_older(sim, &ended);
	compared++;
	if (scan > edited)
		return good && !older;
	olds++;
	was = older ? ladder_document_text(older, &len) : g_strdup("");
	good = good && older && strcmp(was, text) == 0 && ended.scan == edited &&
	       ended.us > 0 && ladder_document_is_fixed(older) &&
	       ladder_sim_rung(sim, older, 0, 0) == 0 &&
	       ladder_sim_rung(sim, document, 0, 0) == -1;
	g_free(was);
	return good;
}

/* Shows random scans on both sides of the edit. */
static bool look_back(struct random_source *random, guint64 edited, guint64 last,
		      const struct timing *timing, const char *text)
{
	bool good = show_is(edited, edited, timing, text) && show_is(1, edited, timing, text) &&
		    (last == edited || show_is(edited + 1, edited, timing, text));

	for (int i = 0; good && i < 12; i++)
		good = show_is(1 + random_below(random, (uint32_t)last), edited, timing, text);
	ladder_sim_show_now(sim);
	return good && !ladder_sim_older(sim, NULL) &&
	       ladder_sim_rung(sim, document, 0, 0) == 0;
}

/* ---- programs ---- */

static void other_rungs(struct random_program *program, guint64 seed,
			struct random_source *random)
{
	struct random_program *other = g_new(struct random_program, 1);
	const uint32_t at = random_below(random, (uint32_t)program->rungs);

	random_make(other, seed + 1000000);
	for (int i = 0; i < other->rungs; i++)
		if (other->rung[i].pou == program->rung[at].pou) {
			other->rung[i].label = program->rung[at].label;
			program->rung[at] = other->rung[i];
			break;
		}
	g_free(other);
}

static bool builds(const char *text)
{
	struct sim_program *program = sim_program_read_listed(ladder_new(),
		g_intern_static_string("-"), text, strlen(text), NULL);

	sim_program_unref(program);
	return program;
}

/* 1: correct, 0: wrong, -1: not decidable. */
static int play(const char *before, const char *after, guint64 seed)
{
	struct random_source random;
	struct run run = { .program = NULL };
	struct timing *timing;
	struct sim_replay *first = sim_replay_new();
	guint64 edited;
	gsize len;
	char *text;
	bool good;

	random_seed(&random, seed + 7);
	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, before, strlen(before), true);
	CHECK(ladder_sim_begin(sim, NULL));
	text = ladder_document_text(document, &len);
	g_array_set_size(states, 0);
	run.program = sim_program_read_listed(ladder_new(), g_intern_static_string("-"), text,
					      len, NULL);
	CHECK(twin_init(&run.twin, run.program->program, NULL, ladder_sim_period(sim)));
	play_some(&run, &random);
	edited = run.twin.scan;
	edit(after);
	g_free(text);
	text = ladder_document_text(document, &len);
	run_change(&run, text);
	g_free(text);
	play_some(&run, &random);
	text = g_strdup(before);
	/* the text before the edit */
	ladder_sim_show(sim, edited);
	if (ladder_sim_older(sim, NULL)) {
		g_free(text);
		text = ladder_document_text(ladder_sim_older(sim, NULL), &len);
	}
	CHECK(ladder_sim_replay(sim, first, 1));
	timing = chart_of((const struct twin *const[]){ sim_replay_twin(first), &run.twin },
			 2);
	good = ladder_sim_first(sim) == 0 && ladder_sim_last(sim) == run.twin.scan &&
	       timing_first(timing) == 0 && timing_end(timing) == run.twin.scan + 1 &&
	       look_back(&random, edited, run.twin.scan, timing, text);
	timing_free(timing);
	sim_replay_free(first);
	twin_free(&run.twin);
	sim_program_unref(run.program);
	g_free(text);
	return good;
}

static void test_random(guint64 first, int count)
{
	struct random_program *program = g_new(struct random_program, 1);
	char *before = g_malloc(TEXT_MAX), *after = g_malloc(TEXT_MAX);
	int played = 0, bad = 0;

	for (guint64 seed = first; played < count && seed < first + 20 * (guint64)count;
	     seed++) {
		struct random_source random;

		random_seed(&random, seed);
		random_make(program, seed);
		random_print(program, before, TEXT_MAX);
		other_rungs(program, seed, &random);
		random_print(program, after, TEXT_MAX);
		if (strcmp(before, after) == 0 || !builds(before) || !builds(after))
			continue;
		played++;
		if (!play(before, after, seed)) {
			printf("# seed %" G_GUINT64_FORMAT "\n", seed);
			bad++;
		}
	}
	printf("# %d random programs, %" G_GUINT64_FORMAT " scans compared, %" G_GUINT64_FORMAT
	       " of them before the edit\n", played, compared, olds);
	CHECK_AS(played == count, "the wanted number of edits was built");
	CHECK_AS(bad == 0, "each scan equals that of a fresh run");
	g_free(before);
	g_free(after);
	g_free(program);
}

/* ---- by hand ---- */

static const char motor[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n"
	"  Guard AT %IX0.1 : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n"
	"  | NO Start | NC Guard | COIL Motor |\nEND_PROGRAM\n";
static const char idle[] =
	"RUNGBOARD 1\n\nVAR\n  Other AT %IX0.7 : BOOL;\n  Start AT %IX0.0 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\n  Guard AT %IX0.1 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Other | COIL Motor |\nEND_PROGRAM\n";

static void set(const char *name, gint64 value)
{
	struct act act = { .kind = ACT_SET, .value.i = value };

	act.at = image_find(&ladder_sim_twin(sim)->resource.image, name, strlen(name));
	ladder_sim_act(sim, &act);
}

/* The contact that keeps the coil off in that scan. */
static char *why_at(guint64 scan)
{
	struct why *why = g_new0(struct why, 1);
	struct arena arena;
	char *name = NULL;

	arena_init(&arena);
	CHECK(ladder_sim_show(sim, scan));
	if (why_ask(&(struct why_place){
		.project = ladder_project(ladder_sim_ladder(sim)),
		.resource = &ladder_sim_twin(sim)->resource,
		.rung = 1, .row = 1, .col = ladder_project(ladder_sim_ladder(sim))->pou[0]
			.rung[0]->cols }, &arena, why) && why->ways > 0)
		name = g_strdup(why->way[0].cell[0].name);
	arena_free(&arena);
	g_free(why);
	return name;
}

static void why_is(guint64 scan, const char *want)
{
	char *name = why_at(scan);

	CHECK_TEXT(name ? name : "", want);
	g_free(name);
}

static void keep_told(LadderSim *of, const char *text, gboolean bad, char **told)
{
	(void)of;
	(void)bad;
	g_free(*told);
	*told = g_strdup(text);
}

/* The view is told that it shows an older program, also if it has not taken the newer one yet. */
static bool shows_before_taken(const char *text)
{
	const int before = programs_changed;
	struct sim_edited edit;
	char *now = ladder_document_text(document, NULL);
	bool first;

	CHECK(ladder_document_replace(document, 0, strlen(now), text, NULL));
	g_free(now);
	ladder_document_check_now(document);
	while (!ladder_sim_next_edit(sim, 4, &edit))
		g_main_context_iteration(NULL, FALSE);
	first = programs_changed == before && ladder_sim_twin(sim)->scan == 5;
	if (first) {
		CHECK(ladder_sim_show(sim, 2) && ladder_sim_older(sim, NULL));
		CHECK_AS(programs_changed == before + 1, "the sheets show the older program");
		ladder_sim_show_now(sim);
		CHECK(programs_changed == before + 2);
	}
	return first;
}

static void test_not_taken(void)
{
	bool any = false;

	for (int i = 0; i < 50 && !any; i++) {
		ladder_sim_end(sim);
		ladder_document_open_text(document, NULL, motor, strlen(motor), true);
		CHECK(ladder_sim_begin(sim, NULL));
		ladder_sim_scan(sim, 5);
		CHECK_SOON(ladder_sim_twin(sim)->scan == 5);
		any = shows_before_taken(idle);
	}
	CHECK_AS(any, "the view was later than the program once");
}

static void test_by_hand(void)
{
	char *told = NULL;
	const gulong handler = g_signal_connect(sim, "told", G_CALLBACK(keep_told), &told);

	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, motor, strlen(motor), true);
	CHECK(ladder_sim_begin(sim, NULL));
	set("Guard", 1);
	set("Start", 1);
	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 5);
	edit(idle);
	CHECK(told && strstr(told, "after scan 5"));
	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 10);
	why_is(3, "Guard");
	/* A click while the past is shown has no effect. */
	set("Guard", 0);
	CHECK(ladder_sim_is_past(sim) && told && strstr(told, "before an edit"));
	why_is(8, "Other");
	CHECK(!ladder_sim_older(sim, NULL));
	CHECK_AS(!ladder_document_replace(ladder_sim_show(sim, 2) ?
		 ladder_sim_older(sim, NULL) : document, 0, 0, " ", NULL),
		 "the project of an older program cannot be edited");
	/* Another edit while the past is shown: shows the present. */
	edit(motor);
	CHECK(!ladder_sim_is_past(sim));
	CHECK(ladder_sim_show(sim, 9) && ladder_sim_older(sim, NULL));
	why_is(9, "Other");
	why_is(4, "Guard");
	ladder_sim_show_now(sim);
	/* A restart drops all older programs. */
	CHECK(ladder_sim_restart(sim, NULL));
	CHECK(ladder_sim_last(sim) == 0 && !ladder_sim_show(sim, 3));
	g_signal_handler_disconnect(sim, handler);
	g_free(told);
}

/* A program that ran no scan is not kept. */
static void test_edits_in_pause(void)
{
	struct sim_edited edited;

	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, motor, strlen(motor), true);
	CHECK(ladder_sim_begin(sim, NULL));
	edit(idle);
	CHECK(!ladder_sim_next_edit(sim, 0, &edited));
	ladder_sim_scan(sim, 2);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 2);
	edit(motor);
	edit(idle);
	edit(motor);
	ladder_sim_scan(sim, 2);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 4);
	CHECK(ladder_sim_next_edit(sim, 0, &edited) && edited.scan == 2);
	CHECK(!ladder_sim_next_edit(sim, 3, &edited));
	CHECK(ladder_sim_show(sim, 2) && ladder_sim_older(sim, NULL));
	ladder_sim_show_now(sim);
}

/* A thousand numbers that change in every scan, and edits: the memory limit holds. */
static void test_bound(void)
{
	GString *text = g_string_new("RUNGBOARD 1\n\nVAR\n  Many : ARRAY[0..999] OF DINT;\n"
				     "  I : DINT;\nEND_VAR\n\nPROGRAM Main IL\nVAR\n"
				     "  K : DINT;\nEND_VAR\n");
	struct sim_program *program;
	struct sim_eras *eras;
	struct twin twin, next;
	guint64 first = 0;
	gsize most = 0;

	for (int i = 0; i < 1000; i++)
		g_string_append_printf(text, "  LD Many[%d]\n  MUL 69069\n  ADD %d\n"
				       "  ST Many[%d]\n", i, 2 * i + 1, i);
	g_string_append(text, "END_PROGRAM\n");
	program = sim_program_read_listed(ladder_new(), g_intern_static_string("-"), text->str,
					  text->len, NULL);
	CHECK(program && twin_init(&twin, program->program, NULL, SIM_PERIOD));
	CHECK((eras = sim_eras_new(&twin, program, NULL)) != NULL);
	twin_act(&twin, &(struct act){ .kind = ACT_START });
	for (int edits = 0; edits < EDITS; edits++) {
		for (int i = 0; i < EACH; i++) {
			twin_scan(&twin);
			sim_eras_scan(eras, &twin);
			most = MAX(most, sim_eras_bytes(eras));
		}
		CHECK(sim_eras_first(eras) >= first && sim_eras_find(eras, twin.scan));
		CHECK(sim_eras_find(eras, sim_eras_first(eras)) &&
		      (!sim_eras_first(eras) ||
		       !sim_eras_find(eras, sim_eras_first(eras) - 1)));
		first = sim_eras_first(eras);
		CHECK(twin_init(&next, program->program, NULL, SIM_PERIOD) &&
		      twin_change(&next, &twin) && sim_eras_change(eras, &next, program));
		twin_free(&twin);
		twin = next;
	}
	printf("# %d scans of 1,000 numbers, %d edits: %zu MB at most, scans from %"
	       G_GUINT64_FORMAT " on\n", EDITS * EACH, EDITS, most >> 20, first);
	CHECK_AS(most <= SIM_BYTES, "all records together stay within SIM_BYTES");
	CHECK_AS(first > 0, "the oldest scans were dropped");
	sim_eras_free(eras);
	twin_free(&twin);
	sim_program_unref(program);
	g_string_free(text, TRUE);
}

static void count(int *counter)
{
	(*counter)++;
}

int main(int argc, char **argv)
{
	document = ladder_document_new();
	sim = ladder_sim_new(document);
	states = g_array_new(FALSE, FALSE, sizeof(guint64));
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(count),
				 &programs_changed);
	test_by_hand();
	test_not_taken();
	test_edits_in_pause();
	test_bound();
	test_random(argc > 2 ? (guint64)atoll(argv[2]) : 1, argc > 1 ? atoi(argv[1]) : PROGRAMS);
	g_object_unref(sim);
	g_object_unref(document);
	g_array_unref(states);
	return tap_done();
}
