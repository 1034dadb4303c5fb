/* SPDX-License-Identifier: MIT
 *
 * test_record - a replayed scan equals the original: random programs with random plants
 * and acts, against a separate run that stops there; compares memory, power, forces,
 * states and counters, in any order, also after the oldest were dropped.
 */
#include "engine/trial/record.h"
#include "tests/unit/rig.h"
#include "tests/walker/random.h"

#define SEEDS  60
#define SCANS  320
#define ACTS   4096
#define TEXT_MAX (128 * 1024)
#define NAMES  2048

/* ---- a state as one number ---- */

static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
	const uint8_t *at = bytes;

	for (; size >= 8; size -= 8, at += 8) {
		uint64_t word;

		memcpy(&word, at, 8);
		hash = (hash ^ word) * UINT64_C(0x9e3779b97f4a7c15);
		hash ^= hash >> 29;
	}
	for (; size; size--)
		hash = (hash ^ *at++) * UINT64_C(1099511628211);
	return hash;
}

static uint64_t mix_number(uint64_t hash, int64_t number)
{
	return mix(hash, &number, sizeof(number));
}

static uint64_t mix_place(uint64_t hash, const struct fault_place *at)
{
	hash = mix(hash, at->pou ? at->pou : "", at->pou ? strlen(at->pou) : 0);
	hash = mix_number(hash, at->rung * 100000000LL + at->row * 10000 + at->col);
	return mix_number(hash, at->line);
}

static uint64_t mix_tasks(uint64_t hash, const struct tasks *tasks)
{
	for (int i = 0; i < LIMIT_TASKS; i++) {
		const struct task_state *state = &tasks->state[i];

		hash = mix_number(hash, state->next_ns);
		hash = mix_number(hash, (int64_t)state->runs);
		hash = mix_number(hash, (int64_t)state->overruns);
		hash = mix_number(hash, state->late_row * 8LL + state->due * 4 +
				  state->ran * 2 + state->was);
	}
	return hash;
}

static uint64_t mix_resource(uint64_t hash, const struct resource *resource)
{
	const struct image *image = &resource->image;

	hash = mix(hash, image->memory, image_memory_size(image->program));
	for (int i = 0; i < image->force_count; i++) {
		const struct force *force = &image->force[i];

		hash = mix_number(hash, force->at.type * 64 + force->at.area);
		hash = mix_number(hash, force->at.where);
		hash = mix_number(hash, force->value.i);
		hash = mix_number(hash, force->aside.i);
	}
	hash = mix_number(hash, image->force_count);
	hash = mix_number(hash, resource->state * 16 + resource->fault * 2 +
			  resource->halted);
	hash = mix_place(mix_place(hash, &resource->fault_at), &resource->halt_at);
	hash = mix_place(hash, &resource->error_at);
	hash = mix_number(hash, (int64_t)resource->scans * 2 + resource->warm);
	hash = mix_number(hash, resource->start_ns);
	hash = mix_number(hash, resource->vm.errors);
	return mix_tasks(hash, &resource->tasks);
}

static uint64_t state_of(const struct twin *twin)
{
	uint64_t hash = mix_resource(1, &twin->resource);

	if (twin->plant.image.program)
		hash = mix_resource(hash, &twin->plant);
	hash = mix_number(hash, twin->now_ns);
	hash = mix_number(hash, twin->period_ns);
	return mix_number(hash, (int64_t)twin->scan);
}

/* ---- a run ---- */

struct step {
	uint64_t after;
	struct act act;
	struct iec_text text;
};

struct run {
	struct ladder *ladder, *plant;
	struct twin twin;
	struct location name[2][NAMES]; /* of the program, of the plant         */
	uint32_t names[2];
	struct step step[ACTS];
	int steps;
	uint64_t seen[SCANS + 1];     /* state right after each scan           */
	uint64_t last;
	struct random_source source;
};
static struct run run;

static struct ladder *open_random(uint64_t seed)
{
	static struct random_program program;
	static char text[TEXT_MAX];
	struct ladder *ladder = ladder_new();
	size_t len;

	random_make(&program, seed);
	len = random_print(&program, text, sizeof(text));
	ladder_watch(ladder, true);
	if (ladder_load_text(ladder, "random.rung", text, len) &&
	    ladder_build(ladder))
		return ladder;
	ladder_free(ladder);
	return NULL;
}

static void find_names(const struct image *image, int side)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;
	uint32_t count = 0;

	while (count < NAMES && image_next_symbol(image, &cursor, &symbol))
		run.name[side][count++] = symbol.at;
	run.names[side] = count;
}

static bool open_run(uint64_t seed, bool plant)
{
	memset(&run, 0, sizeof(run));
	random_seed(&run.source, seed * 977 + 5);
	run.ladder = open_random(seed);
	run.plant = plant ? open_random(seed + 100000) : NULL;
	if (!run.ladder || !twin_init(&run.twin, ladder_program(run.ladder),
				      run.plant ? ladder_program(run.plant) : NULL,
				      10000000))
		return false;
	find_names(&run.twin.resource.image, 0);
	if (run.plant)
		find_names(&run.twin.plant.image, 1);
	return true;
}

static void close_run(void)
{
	if (run.twin.resource.image.memory)
		twin_free(&run.twin);
	ladder_free(run.plant);
	ladder_free(run.ladder);
}

static struct location random_place(bool plant)
{
	struct iec_addr addr = { .area = AREA_I, .bits = 1 };

	if (run.names[plant] && random_chance(&run.source, 60))
		return run.name[plant][random_below(&run.source, run.names[plant])];
	addr.byte = random_below(&run.source, 8);
	addr.bit = (uint8_t)random_below(&run.source, 8);
	return image_locate(plant ? &run.twin.plant.image : &run.twin.resource.image,
			    addr);
}

static enum act_kind random_kind(void)
{
	const uint32_t dice = random_below(&run.source, 100);

	return dice < 60 ? ACT_SET : dice < 75 ? ACT_FORCE : dice < 88 ? ACT_RELEASE :
	       dice < 90 ? ACT_RELEASE_ALL : dice < 92 ? ACT_START :
	       dice < 94 ? ACT_WARM : dice < 95 ? ACT_STOP : ACT_PERIOD;
}

/* Does a random act; false: the act was refused. */
static bool random_act(struct step *step)
{
	struct act *act = &step->act;

	*step = (struct step){ .after = run.twin.scan };
	act->kind = random_kind();
	act->plant = run.plant && random_chance(&run.source, 30);
	act->at = random_place(act->plant);
	act->value.i = (int64_t)random_next(&run.source) - (1 << 20);
	if (random_chance(&run.source, 60))
		act->value.i = random_below(&run.source, 3);
	if (act->kind == ACT_PERIOD)
		act->value.i = 1000000 * (int64_t)random_below(&run.source, 30);
	else if (act->at.type == IEC_REAL || act->at.type == IEC_LREAL)
		act->value.r = (double)act->value.i / 8;
	if (act->at.type == IEC_STRING && act->kind != ACT_PERIOD) {
		struct iec_string *text = iec_text_init(&step->text,
			(uint16_t)random_below(&run.source, 15));

		memset(text->text, 'a' + (int)random_below(&run.source, 26), text->length);
		act->value.s = text;
	}
	return twin_act(&run.twin, act);
}

/* Does the random act; in STOP or FAULT a start. */
static void act_now(struct record *record, bool start)
{
	struct step *step = &run.step[run.steps];

	if (run.steps == ACTS)
		return;
	if (start) {
		*step = (struct step){ .after = run.twin.scan,
				       .act.kind = ACT_START };
		if (!twin_act(&run.twin, &step->act))
			return;
	} else if (!random_act(step)) {
		return;
	}
	run.steps++;
	if (!record_act(record, &run.twin, &step->act))
		printf("# an act was not recorded\n");
}

static void play(struct record *record)
{
	run.seen[0] = state_of(&run.twin);
	while (run.twin.scan < SCANS) {
		if (run.twin.resource.state != STATE_RUN)
			act_now(record, true);
		while (random_chance(&run.source, 40))
			act_now(record, false);
		if (run.twin.resource.state != STATE_RUN)
			continue;
		twin_scan(&run.twin);
		record_scan(record, &run.twin);
		run.seen[run.twin.scan] = state_of(&run.twin);
	}
}

/* Does the same acts without a record: every scan must be the same. */
static bool play_again(void)
{
	struct twin fresh;
	int next = 0;
	bool same;

	if (!twin_init(&fresh, run.twin.resource.image.program,
		       run.twin.plant.image.program, 10000000))
		return false;
	same = state_of(&fresh) == run.seen[0];
	while (same && fresh.scan < SCANS) {
		for (; next < run.steps && run.step[next].after == fresh.scan; next++)
			same = twin_act(&fresh, &run.step[next].act) && same;
		twin_scan(&fresh);
		same = same && state_of(&fresh) == run.seen[fresh.scan];
	}
	twin_free(&fresh);
	return same;
}

static uint64_t compared;

/* Goes back and forward by short and long distances. */
static bool seek_all(const struct record *record)
{
	const uint64_t first = record_first(record), span = SCANS - first + 1;
	struct replay replay;
	uint64_t at = first;
	bool same = replay_init(&replay, record);

	for (int i = 0; same && i < 200; i++) {
		at = random_chance(&run.source, 50) ?
		     first + random_below(&run.source, (uint32_t)span) :
		     at + random_below(&run.source, 5) - 2;
		if (at < first || at > SCANS)
			at = first;
		same = replay_seek(&replay, record, at) &&
		       state_of(&replay.twin) == run.seen[at];
		if (!same)
			printf("# scan %llu differs\n", (unsigned long long)at);
		if (same && at < SCANS && random_chance(&run.source, 30))
			same = replay_next(&replay, record) &&
			       state_of(&replay.twin) == run.seen[++at];
		compared++;
	}
	same = same && !replay_seek(&replay, record, SCANS + 1) &&
	       (!first || !replay_seek(&replay, record, first - 1)) &&
	       replay_seek(&replay, record, SCANS) && !replay_next(&replay, record);
	replay_free(&replay);
	return same;
}

static uint64_t forgotten, faults, with_plant;

static bool test_seed(uint64_t seed)
{
	/* Sometimes with little memory, so that the oldest are dropped. */
	const size_t room = seed % 3 ? 6000 : 1 << 24;
	struct record *record;
	bool good;

	if (!open_run(seed, seed % 2)) {
		close_run();
		return true;
	}
	record = record_new(&run.twin, seed % 5 ? 100 : SCANS, room);
	play(record);
	good = record_last(record) == SCANS && play_again() && seek_all(record);
	if (seed % 3 == 0)
		good = good && record_first(record) == 0;
	forgotten += record_first(record) > 0;
	with_plant += run.plant != NULL;
	faults += run.twin.resource.vm.errors > 0;
	record_free(record);
	if (!good)
		printf("# seed %llu\n", (unsigned long long)seed);
	close_run();
	return good;
}

static void test_random(void)
{
	const uint64_t seeds = (uint64_t)tap_rounds(SEEDS);
	uint64_t good = 0;

	for (uint64_t seed = 1; seed <= seeds; seed++)
		good += test_seed(seed);
	printf("# %llu scans compared; %llu records forgot, %llu with a plant\n",
	       (unsigned long long)compared, (unsigned long long)forgotten,
	       (unsigned long long)with_plant);
	CHECK(good == seeds);
	CHECK(compared > (uint64_t)tap_rounds(5000));
	CHECK(forgotten > seeds / 6 && with_plant > seeds / 4);
}

/* ---- where its frames stand ---- */

static void run_scans(struct record *record, struct twin *twin, uint64_t count)
{
	while (count--) {
		twin_scan(twin);
		record_scan(record, twin);
	}
}

/* The scan of the frame at or before @scan. */
static uint64_t frame_of(const struct record *record, uint64_t scan)
{
	struct replay replay;
	uint64_t found;

	CHECK(replay_init(&replay, record) && replay_jump(&replay, record, scan));
	found = replay.twin.scan;
	replay_free(&replay);
	return found;
}

/* Frames are equally far apart while their size stays; with room for none, only the last frame is
 * kept. */
static void test_frames(void)
{
	struct rig rig;
	struct twin twin;
	struct record *record;
	uint64_t apart, begin;

	CHECK(rig_open(&rig, "VAR\n  N : INT;\nEND_VAR\nPROGRAM Main LD\nRUNG\n"
			     "  | [ N := N + 1 ] |\nEND_PROGRAM\n", false));
	CHECK(twin_init(&twin, ladder_program(rig.ladder), NULL, 1000000) &&
	      twin_restart(&twin.resource, false));
	record = record_new(&twin, 100, 1 << 20);
	run_scans(record, &twin, 1000);
	for (apart = 1; frame_of(record, apart) == 0; apart++)
		;
	CHECK(apart > 1 && apart < 100);
	CHECK(frame_of(record, apart) == apart && frame_of(record, 2 * apart - 1) == apart &&
	      frame_of(record, 2 * apart) == 2 * apart && frame_of(record, 1000) == 1000 / apart * apart);
	record_free(record);
	record = record_new(&twin, 100, 1);
	begin = record_first(record);
	for (int i = 0; i < 1000 && record_first(record) == begin; i++)
		run_scans(record, &twin, 1000);
	CHECK_AS(record_first(record) > begin && frame_of(record, record_last(record)) == record_first(record),
		 "without room only the last frame is kept");
	record_free(record);
	twin_free(&twin);
	rig_close(&rig);
}

int main(void)
{
	test_frames();
	test_random();
	return tap_done();
}
