/* SPDX-License-Identifier: MIT
 *
 * test_mirror - a simulation that shows a board: values, power, forces and modes as the board
 * publishes them; what it does not publish; edits that the board does not have; the past.
 *
 * The board is a twin in this process, which runs the program.
 */
#include "editor-gtk/live/timing.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/sim_mirror.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include "engine/scan/place.h"
#include "engine/scan/recorder.h"
#include "engine/trial/record_file.h"

#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n"
	"  Label : STRING := 'idle';\n  Count : DINT;\n  Table : ARRAY[1..3] OF INT;\n"
	"  Slow : TON;\n  Left, Right : Pair;\nEND_VAR\nVAR CONSTANT\n  Most : INT := 7;\nEND_VAR\n\n"
	"FUNCTION_BLOCK Pair LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Out : BOOL;\n"
	"END_VAR\nRUNG\n  | NO In | COIL Out |\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Go | COIL Lamp |\n"
	"RUNG\n  | --- | [ Count := Count + 1 ] |\n"
	"RUNG\n  | NO Go | TON Slow PT:=T#1s |\n"
	"RUNG\n  | NC Go | Pair Left |\n"
	"RUNG\n  | NO Go | Pair Right |\n"
	"END_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static struct sim_mirror *mirror;
static struct sim_program *program;
static struct twin board;
static int shown, changed, asked, acts, orders, pasts;
static struct act last_act;
static const char *refusal;

static void count(int *counter)
{
	(*counter)++;
}

/* ---- the board ---- */

static void act_of(gpointer data, const struct act *of, int count)
{
	(void)data;
	orders++;
	acts += count;
	last_act = of[count - 1];
}

static const char *why_not(gpointer data, enum sim_wish wish)
{
	(void)data;
	return wish == SIM_WISH_TIME ? "no time" : wish == SIM_WISH_RESTART ? "no restart" :
	       refusal;
}

static void wanted(gpointer data)
{
	(void)data;
	asked++;
}

static void past(gpointer data)
{
	(void)data;
	pasts++;
}

static struct location place(const char *name)
{
	return image_find(&board.resource.image, name, strlen(name));
}

static void set(const char *name, gint64 value)
{
	CHECK(image_set(&board.resource.image, place(name), (union iec_value){ .i = value }));
}

static void publish(guint most)
{
	const struct image *image = &board.resource.image;
	bool all;
	GArray *places = sim_mirror_places(mirror, most, &all);

	for (guint i = 0; i < places->len; i++) {
		const struct location at = g_array_index(places, struct location, i);

		sim_mirror_value(mirror, at, image_is_forced(image, at), SIM_GOOD, image_get(image, at));
	}
	g_array_unref(places);
}

/* Two bits a cell, in the order of the map. */
static void publish_power(const char *unit, guint16 pou, guint32 shift)
{
	const struct program *of = program->program;
	const guint8 *memory = board.resource.image.memory;
	guint8 bits[64] = { 0 };
	guint cells = 0;

	for (guint i = 0; i < of->power_count; i++)
		if (of->power[i].pou == pou) {
			bits[cells / 4] |= (guint8)((memory[of->power[i].in + shift] |
				memory[of->power[i].out + shift] << 1) << cells % 4 * 2);
			cells++;
		}
	CHECK(cells == sim_mirror_cells(mirror, unit));
	sim_mirror_power(mirror, unit, bits);
}

static guint16 unit_of(const char *name)
{
	for (guint i = 0; i < program->program->entry_count; i++)
		if (strcmp(program->program->string + program->program->entry[i].name, name) == 0)
			return (guint16)i;
	return 0;
}

static void publish_instance(const char *name)
{
	for (guint i = 0; i < program->program->watched_count; i++) {
		const struct code_watched *watched = &program->program->watched[i];

		if (strcmp(program->program->string + watched->name, name) == 0)
			publish_power(name, (guint16)watched->pou, watched->to - watched->from);
	}
}

static void moment(void)
{
	sim_mirror_moment(mirror, &(struct sim_moment){ board.resource.state, board.scan,
							5000000000 + board.now_ns });
}

static void show(void)
{
	publish(2048);
	publish_power("Main", unit_of("Main"), 0);
	publish_instance("Left");
	publish_instance("Right");
	moment();
	turn(0);
}

static void scan(int scans)
{
	while (scans-- > 0)
		twin_scan(&board);
}

static void connect_to(void)
{
	const struct sim_board of = { .name = "table", .program = program, .period_ns = 10000000,
		.act = act_of, .why_not = why_not, .wanted = wanted,
		.past = past };

	mirror = ladder_sim_mirror_begin(sim, &of);
}

/* ---- the editor ---- */

static const struct image *image(void)
{
	return &ladder_sim_twin(sim)->resource.image;
}

static gint64 value(const char *name)
{
	return image_get(image(), place(name)).i;
}

static bool power(const char *instance, guint rung, guint col)
{
	bool in = false, out = false;

	if (instance)
		CHECK(resource_power_in(&ladder_sim_twin(sim)->resource, instance,
					strlen(instance), rung, 1, col, &in, &out));
	else
		CHECK(resource_power(&ladder_sim_twin(sim)->resource, unit_of("Main"), rung, 1, col,
				     &in, &out));
	return in && out;
}

static void shows_a_board(void)
{
	CHECK_AS(!ladder_sim_is_on(sim) && !ladder_sim_twin(sim) && !ladder_sim_board(sim),
		 "nothing is shown before the first values");
	set("Go", 1);
	scan(3);
	show();
	CHECK(ladder_sim_is_on(sim) && ladder_sim_state(sim) == SIM_RUN && shown > 0);
	CHECK_TEXT(ladder_sim_board(sim), "table");
	CHECK(ladder_sim_twin(sim)->scan == 3 && value("Count") == 3 && value("Lamp") == 1);
	CHECK_TEXT(image_get(image(), place("Label")).s->text, "idle");
	CHECK_AS(power(NULL, 1, 1) && power("Right", 1, 1) && !power("Left", 1, 1),
		 "each instance has its own power");
	CHECK(memcmp(&ladder_sim_twin(sim)->now_ns, &(gint64){ 0 }, 8) == 0);
	CHECK(image_force(&board.resource.image, place("Lamp"), (union iec_value){ .i = 0 }));
	scan(1);
	show();
	CHECK(value("Lamp") == 0 && ladder_sim_forces(sim) == 1);
	CHECK(live_value_is_forced(sim, false, place("Lamp")));
	CHECK(image_unforce(&board.resource.image, place("Lamp")));
	scan(1);
	show();
	CHECK(value("Lamp") == 1 && ladder_sim_forces(sim) == 0);
	CHECK(ladder_sim_twin(sim)->now_ns == 2 * 10000000);
	CHECK(twin_act(&board, &(struct act){ .kind = ACT_STOP }));
	show();
	CHECK(ladder_sim_state(sim) == SIM_STOP && value("Lamp") == 0);
	CHECK(twin_act(&board, &(struct act){ .kind = ACT_WARM }));
	set("Go", 1);
	scan(1);
	show();
	CHECK(ladder_sim_state(sim) == SIM_RUN && value("Lamp") == 1);
}

static void orders_acts(void)
{
	const struct act both[] = { { .kind = ACT_SET, .at = place("Count"), .value.i = 7 },
				    { .kind = ACT_SET, .at = place("Lamp"), .value.i = 8 } };

	acts = 0;
	live_value_set(sim, false, place("Count"), (union iec_value){ .i = 40 });
	CHECK(acts == 1 && last_act.kind == ACT_SET && last_act.value.i == 40);
	CHECK_AS(value("Count") != 40, "a value is shown when the board has it");
	live_value_force(sim, false, place("Lamp"), (union iec_value){ .i = 1 });
	CHECK(acts == 2 && last_act.kind == ACT_FORCE);
	ladder_sim_release_all(sim);
	CHECK(acts == 3 && last_act.kind == ACT_RELEASE_ALL);
	ladder_sim_stop(sim);
	ladder_sim_run(sim);
	CHECK(acts == 4 && last_act.kind == ACT_STOP);
	CHECK(!ladder_sim_restart(sim, NULL) && ladder_sim_board(sim));
	ladder_sim_scan(sim, 1);
	ladder_sim_pause(sim);
	ladder_sim_set_period(sim, 1000000);
	CHECK_AS(acts == 4, "what a board does not do is not ordered");
	orders = 0;
	ladder_sim_act_all(sim, both, 2);
	CHECK_AS(orders == 1 && acts == 6 && last_act.value.i == 8,
		 "values that belong together go to the board in one order");
	ladder_sim_act_all(sim, NULL, 0);
	CHECK(orders == 1);
	acts = 4;
	refusal = "no";
	CHECK_TEXT(ladder_sim_why_not(sim, SIM_WISH_FORCE), "no");
	live_value_set(sim, false, place("Count"), (union iec_value){ .i = 41 });
	CHECK_AS(acts == 4, "what the role does not allow is not ordered");
	refusal = NULL;
}

/* A place that does not come is asked for, and is unknown until it comes. */
static void asks_for_what_is_seen(void)
{
	struct live_seen seen = { .known = false };
	struct live_map *map;
	GArray *places;
	bool all;

	ladder_sim_end(sim);
	connect_to();
	publish(2);
	moment();
	turn(0);
	CHECK(ladder_sim_is_on(sim) && ladder_sim_knows(sim, place("Go")));
	asked = changed = 0;
	CHECK(!live_value_look(&seen, sim, false, place("Table[3]")) && !seen.known);
	CHECK(ladder_sim_knows(sim, place("Most")));
	map = live_map_new(&ladder_sim_twin(sim)->resource, "Main", NULL);
	live_map_set_sim(map, sim);
	CHECK_AS(live_map_find(map, "Count", 5).type == IEC_NONE, "no value that did not come");
	CHECK_AS(!ladder_sim_has_power(sim, "Right"), "no power that did not come");
	CHECK_SOON(asked == 1);
	places = sim_mirror_places(mirror, 2, &all);
	CHECK(!all && places->len == 2);
	CHECK_AS(g_array_index(places, struct location, 0).where == place("Count").where &&
		 g_array_index(places, struct location, 1).where == place("Table[3]").where,
		 "what views need comes first");
	g_array_unref(places);
	sim_mirror_forget(mirror);
	publish(2);
	publish_instance("Right");
	moment();
	turn(0);
	CHECK(changed == 1 && ladder_sim_has_power(sim, "Right"));
	CHECK(live_map_find(map, "Count", 5).type == IEC_DINT);
	CHECK(live_value_look(&seen, sim, false, place("Table[3]")) && seen.known);
	CHECK_AS(!ladder_sim_knows(sim, place("Go")), "what is not published any more is unknown");
	live_map_free(map);
	/* Another quality of the same value. */
	CHECK(seen.quality == SIM_GOOD && !*live_quality_text(seen.quality));
	sim_mirror_value(mirror, place("Table[3]"), false, SIM_STALE, seen.value);
	moment();
	turn(0);
	CHECK(live_value_look(&seen, sim, false, place("Table[3]")) && seen.quality == SIM_STALE);
	CHECK(strcmp(live_quality_text(seen.quality), "⚠ stale") == 0 && strcmp(live_quality_word(SIM_VALUE_FAULT), "fault") == 0);
	CHECK_AS(!live_value_look(&seen, sim, false, place("Table[3]")), "it is the same as before");
}

static int main_pou(void)
{
	return project_find_pou(ladder_document_project(document), "Main", 4);
}

/* Rung @rung becomes a second rung @like. */
static void change_rung(int rung, int like)
{
	struct rung *copy = rung_copy(ladder_document_project(document)->pou[main_pou()].rung[like]);

	CHECK(ladder_document_put_rung(document, main_pou(), rung, copy, NULL));
}

static void marks_edits(void)
{
	const int pou = main_pou();

	ladder_sim_end(sim);
	connect_to();
	show();
	for (int rung = 0; rung < 5; rung++)
		CHECK(ladder_sim_rung(sim, document, pou, rung) == rung &&
		      !ladder_sim_is_missing(sim, document, pou, rung));
	change_rung(1, 0);
	CHECK(ladder_sim_is_missing(sim, document, pou, 1));
	CHECK(ladder_sim_rung(sim, document, pou, 2) == 2 &&
	      !ladder_sim_is_missing(sim, document, pou, 0));
	ladder_document_undo(document);
	ladder_document_check_now(document);
	CHECK_SOON(!ladder_sim_is_missing(sim, document, pou, 1));
	CHECK(ladder_sim_rung(sim, document, pou, 1) == 1);
}

/* The board runs another program than the document: rungs are found by what they are. */
static void shows_another_program(void)
{
	static const char other[] =
		"RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n"
		"  Count : DINT;\nEND_VAR\n\nPROGRAM Main LD\n"
		"RUNG\n  | NO Lamp | COIL Lamp |\n"
		"RUNG\n  | --- | [ Count := Count + 1 ] |\n"
		"RUNG\n  | NO Go | COIL Lamp |\n"
		"END_PROGRAM\n\nPROGRAM Last LD\nRUNG\n  | --- | [ Count := Count ] |\n"
		"END_PROGRAM\n";

	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, other, strlen(other), true);
	connect_to();
	show();
	CHECK(ladder_sim_pou(sim, document, main_pou()) != main_pou());
	CHECK(ladder_sim_is_missing(sim, document, main_pou(), 0));
	CHECK(ladder_sim_rung(sim, document, main_pou(), 1) == 1);
	CHECK(ladder_sim_rung(sim, document, main_pou(), 2) == 0);
	CHECK(ladder_sim_is_missing(sim, document, 1, 0) && ladder_sim_pou(sim, document, 1) < 0);
}

static void shows_the_past(void)
{
	const guint64 first = board.scan + 1;
	struct timing *timing;
	gint64 before;

	ladder_sim_end(sim);
	connect_to();
	for (int i = 0; i < 700; i++) { /* more than one whole state */
		set("Go", i % 7 == 0);
		if (i % 5 == 0)
			image_force(&board.resource.image, place("Table[2]"),
				    (union iec_value){ .i = i });
		else
			image_unforce(&board.resource.image, place("Table[2]"));
		scan(i % 3 + 1);
		show();
	}
	CHECK(ladder_sim_first(sim) == first && ladder_sim_last(sim) == board.scan);
	pasts = 0;
	CHECK(ladder_sim_show(sim, first) && ladder_sim_is_past(sim));
	CHECK_AS(pasts == 1, "the board is asked for its record once");
	CHECK(value("Lamp") == 1 && ladder_sim_forces(sim) == 1);
	CHECK(ladder_sim_show(sim, first + 2) && value("Lamp") == 0 && ladder_sim_forces(sim) == 0);
	before = value("Count");
	CHECK_AS(ladder_sim_show(sim, first + 4) && value("Count") == before &&
		 ladder_sim_twin(sim)->scan == first + 4, "between two messages the older one stands");
	CHECK(!ladder_sim_show(sim, board.scan + 1));
	for (guint64 at = board.scan; at > first + 100; at -= 97) {
		CHECK(ladder_sim_show(sim, at));
		CHECK(ladder_sim_twin(sim)->scan == at);
	}
	ladder_sim_show_now(sim);
	CHECK(value("Count") == image_get(&board.resource.image, place("Count")).i);
	timing = timing_new(sim);
	CHECK(timing_add(timing, "Count"));
	while (timing_feed(timing, 1000000))
		;
	CHECK(timing_end(timing) == board.scan + 1);
	CHECK(timing_value(timing, 0, board.scan) == (double)value("Count"));
	CHECK_AS(timing_time(timing, board.scan) > timing_time(timing, first + 10), "time goes on");
	timing_free(timing);
}

/* A quality that a value has at a moment, and at later ones until it has another. */
static void say_quality(const char *name, enum sim_quality quality)
{
	scan(2);
	publish(4096);
	sim_mirror_value(mirror, place(name), false, quality, image_get(&board.resource.image, place(name)));
	moment();
	turn(0);
}

static enum sim_quality quality_then(guint64 at)
{
	CHECK(ladder_sim_show(sim, at));
	return ladder_sim_quality(sim, place("Go"));
}

static void knows_how_good_the_past_was(void)
{
	struct timing *timing;
	guint64 stale, fault, good, forgot;

	ladder_sim_end(sim);
	connect_to();
	show();
	say_quality("Go", SIM_STALE);
	stale = board.scan;
	say_quality("Go", SIM_VALUE_FAULT);
	fault = board.scan;
	CHECK(ladder_sim_quality(sim, place("Go")) == SIM_VALUE_FAULT);
	sim_mirror_forget(mirror); /* other values are published from now on */
	say_quality("Go", SIM_GOOD);
	good = board.scan;
	say_quality("Go", SIM_STALE);
	forgot = board.scan;
	CHECK(ladder_sim_quality(sim, place("Go")) == SIM_STALE);
	CHECK_AS(quality_then(stale) == SIM_STALE && quality_then(stale + 1) == SIM_STALE, "a scan of the past is as it was");
	CHECK(quality_then(stale - 1) == SIM_GOOD && quality_then(fault) == SIM_VALUE_FAULT);
	CHECK_AS(quality_then(good) == SIM_GOOD && quality_then(forgot) == SIM_STALE, "also when it was good again");
	CHECK_AS(ladder_sim_quality(sim, place("Lamp")) == SIM_GOOD, "of that value alone");
	ladder_sim_show_now(sim);
	timing = timing_new(sim);
	CHECK(timing_add(timing, "Go") && timing_add(timing, "Lamp"));
	while (timing_feed(timing, 1000000))
		;
	CHECK(timing_quality(timing, 0, stale) == SIM_STALE && timing_quality(timing, 0, stale - 1) == SIM_GOOD);
	CHECK(timing_quality(timing, 0, fault) == SIM_VALUE_FAULT && timing_quality(timing, 0, good) == SIM_GOOD);
	CHECK(timing_quality(timing, 1, fault) == SIM_GOOD);
	timing_free(timing);
}

/* ---- the board's own record ---- */

#define RING (1u << 20)

static guint8 ring[RECORDER_BESIDE + RING];
static struct recorder recorder;

static void scan_recorded(int scans)
{
	while (scans-- > 0) {
		recorder_scan(&recorder, &board.resource, board.now_ns + board.period_ns);
		twin_scan(&board);
		recorder_scanned(&recorder, &board.resource);
	}
}

static struct record_file *record_so_far(void)
{
	static guint8 log[RING];
	static struct record_parts parts;
	struct recorder_part part = { .out = log, .room = sizeof(log) };
	struct sink_memory memory;
	struct sink sink;
	struct record_file *file;
	enum diag_id why;
	size_t where;

	recorder_take(&recorder, &part);
	parts = (struct record_parts){ .board = "table", .log = log, .len = part.len,
				       .program_count = 1 };
	code_identity(program->program, parts.program[0].identity);
	parts.program[0].image = program->program->base;
	parts.program[0].len = program->program->header->size;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	CHECK(record_write(&parts, &sink) && !memory.failed);
	file = record_file_open(memory.text, memory.len, &why, &where);
	sink_memory_free(&memory);
	return file;
}

/* The record and what is published come in messages of their own: either may be the first. */
static void waits_for_what_is_published(void)
{
	const guint64 before = board.scan;
	guint8 identity[32];
	guint64 first, last;
	struct record_file *file;
	gint64 counted;

	code_identity(program->program, identity);
	recorder_init(&recorder, ring, RING);
	board.resource.scans = board.scan; /* an earlier test has changed the mode */
	recorder.scan = board.scan; /* it has counted since the start */
	recorder_begin(&recorder, &board.resource, identity, RECORD_START);
	scan_recorded(20);
	show();
	scan_recorded(15);
	file = record_so_far();
	CHECK(file != NULL);
	sim_mirror_record(mirror, file);
	CHECK_AS(!sim_mirror_computed(mirror, &first, &last), "its last scans are not published yet");
	scan_recorded(5);
	show();
	CHECK_AS(sim_mirror_computed(mirror, &first, &last), "now they are");
	CHECK(first <= before + 1 && last == before + 35);
	CHECK(ladder_sim_show(sim, before + 21));
	counted = value("Count");
	for (guint64 i = 1; before + 21 + i <= last; i++)
		CHECK_AS(ladder_sim_show(sim, before + 21 + i) &&
			 value("Count") == counted + (gint64)i, "each scan is computed again");
	ladder_sim_show_now(sim);
}

static void ends(void)
{
	ladder_sim_end(sim);
	CHECK(!ladder_sim_is_on(sim) && !ladder_sim_board(sim) && !ladder_sim_twin(sim));
	CHECK_AS(ladder_sim_begin(sim, NULL) && ladder_sim_state(sim) == SIM_STOP,
		 "a simulation can begin again");
	ladder_sim_end(sim);
}

int main(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	sim = ladder_sim_new(document);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(count), &shown);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(count), &changed);
	program = ladder_sim_build(sim, NULL);
	CHECK(program != NULL);
	CHECK(twin_init(&board, program->program, NULL, 10000000));
	CHECK(twin_act(&board, &(struct act){ .kind = ACT_START }));
	connect_to();
	shows_a_board();
	orders_acts();
	asks_for_what_is_seen();
	marks_edits();
	shows_the_past();
	knows_how_good_the_past_was();
	waits_for_what_is_published();
	shows_another_program();
	ends();
	twin_free(&board);
	sim_program_unref(program);
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
