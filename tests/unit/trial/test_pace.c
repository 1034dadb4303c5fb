/* SPDX-License-Identifier: MIT
 *
 * test_pace - virtual time with a speed: which period does how much work, what a period sees,
 * late scans, watchdogs, acts in the middle of a scan, rounds of loops, and a record.
 */
#include "engine/scan/code.h"
#include "engine/trial/pace.h"
#include "engine/trial/record.h"
#include "engine/trial/session.h"
#include "tests/unit/rig.h"

#include <stdarg.h>

#define MS INT64_C(1000000)

/* Slow counts K to 20 in a loop that begins with a safe point. */
static const char pair[] =
	"RUNGBOARD 1\n"
	"VAR_GLOBAL\n  N, K, Seen, Low : INT;\n  Go AT %IX0.0 : BOOL;\n  Q0 AT %QX0.0 : BOOL;\n"
	"  Q1 AT %QX0.1 : BOOL;\nEND_VAR\n"
	"CONFIGURATION Plant\n"
	"  TASK TFast (INTERVAL := T#1ms, PRIORITY := 0);\n"
	"  TASK TSlow (INTERVAL := T#50ms, PRIORITY := 1);\n"
	"  PROGRAM A WITH TFast : Fast;\n  PROGRAM B WITH TSlow : Slow;\n"
	"END_CONFIGURATION\n"
	"PROGRAM Fast IL\n  LD N\n  ADD 1\n  ST N\n  LD Go\n  ST Q0\nEND_PROGRAM\n"
	"PROGRAM Slow IL\n  LD 0\n  ST K\n  LD Go\n  ST Q1\nAgain:\n  LD K\n  ADD 1\n  ST K\n"
	"  LT 20\n  JMPC Again\n  LD Go\n  SEL Low, 7\n  ST Seen\nEND_PROGRAM\n";
/* One task, about 1,000 words. */
static char longer[64 * 1024];

static struct ladder *ladder;
static struct twin twin;

static bool open_twin(const char *text)
{
	ladder = ladder_new();
	ladder_watch(ladder, true);
	if (!CHECK_AS(ladder_load_text(ladder, "pace.rung", text, strlen(text)) &&
		      ladder_build(ladder), "the program builds"))
		rig_say_why(ladder);
	return CHECK(twin_init(&twin, ladder_program(ladder), NULL, MS));
}

static void close_twin(void)
{
	twin_free(&twin);
	ladder_free(ladder);
}

static bool act(enum act_kind kind, int64_t value)
{
	const struct act one = { .kind = kind, .value.i = value };

	return twin_act(&twin, &one);
}

static struct location at(const char *name)
{
	return image_find(&twin.resource.image, name, strlen(name));
}

static int64_t get(const char *name)
{
	return image_get(&twin.resource.image, at(name)).i;
}

static bool set(const char *name, int64_t value)
{
	const struct act one = { .kind = ACT_SET, .at = at(name), .value.i = value };

	return twin_act(&twin, &one);
}

static void scans(int count)
{
	while (count-- > 0)
		twin_scan(&twin);
}

/* Stands at scan 52 of 1 ms with K = 1 … 19. */
static void stand(uint64_t speed)
{
	/* The first scan is not interrupted: with a speed it would take three periods. */
	CHECK(act(ACT_SPEED, 0) && act(ACT_START, 0));
	scans(50);
	CHECK(get("N") == 50 && get("K") == 20 && act(ACT_SPEED, (int64_t)speed));
	scans(1);
	CHECK(twin.resource.standing && twin.resource.level == 1 && get("K") > 0 && get("K") < 20);
}

static void sees(void)
{
	CHECK(open_twin(pair));
	stand(115);
	/* The inputs of Slow are those of its begin; Fast and the lines get new ones. */
	CHECK(set("Go", 1) && get("Q0") == 0);
	scans(1);
	CHECK(get("N") == 52 && get("Q0") == 1 && get("Q1") == 0 && get("Go") == 1);
	CHECK(twin.resource.tasks.state[1].interrupted == 1 && twin.resource.late);
	while (twin.resource.standing && twin.scan < 60)
		scans(1);
	CHECK(get("K") == 20 && get("Seen") == 0 && get("Q1") == 0 && get("N") == (int64_t)twin.scan);
	scans(1);
	/* Its last words reached into a period, in which no other cycle begins, as on a board. */
	scans(2);
	CHECK(!twin.resource.late && get("Q0") == 1 && twin.resource.tasks.state[0].overruns == 1);
	CHECK(twin.resource.tasks.state[1].max_ns > 2 * MS);
	/* At no speed the rest takes no time. */
	stand(120);
	CHECK(act(ACT_SPEED, 0) && get("K") == 20 && !twin.resource.standing);
	scans(1);
	CHECK(get("N") == 52 && !twin.resource.interrupts && !act(ACT_SPEED, -1) &&
	      !act(ACT_SPEED, (int64_t)PACE_SPEED_MOST + 1));
	close_twin();
}

/* Each period has its share of words: a part of one that is over counts in the next one. */
static void shares(void)
{
	uint64_t words = 0, taken;

	CHECK(open_twin(pair));
	stand(100);
	taken = twin.resource.words;
	while (twin.resource.standing) {
		const uint64_t owed = twin.resource.pace.owed;

		CHECK(twin.resource.pace.parts >= 1 &&
		      twin.resource.pace.part[twin.resource.pace.parts - 1].task == 1 &&
		      !twin.resource.pace.part[twin.resource.pace.parts - 1].whole);
		scans(1);
		words = twin.resource.words;
		taken += words;
		CHECK(twin.resource.pace.begin_ns ==
		      twin.now_ns + (int64_t)(owed * (uint64_t)MS / 100));
		if (twin.resource.standing)
			CHECK(words + owed == 100 + twin.resource.pace.owed);
	}
	CHECK(twin.resource.pace.part[0].task == 0 && twin.resource.pace.part[0].whole &&
	      twin.resource.pace.part[1].task == 1 && twin.resource.pace.part[1].whole &&
	      twin.resource.pace.part[1].from == twin.resource.pace.part[0].to);
	CHECK(taken == twin.resource.pace.taken &&
	      twin.resource.scan_us == (uint32_t)(taken * 10));
	CHECK(pace_at(&twin.resource, 50) == twin.resource.pace.begin_ns + MS / 2);
	close_twin();
}

/* Stop, start and an edit in the middle of a scan. */
static void acts(void)
{
	struct ladder *other;
	struct twin next;

	CHECK(open_twin(pair));
	stand(120);
	CHECK(act(ACT_STOP, 0) && get("Q0") == 0);
	stand(120);
	CHECK(act(ACT_WARM, 0) && get("N") == 0 && !twin.resource.standing);
	stand(120);
	other = ladder_new();
	CHECK(ladder_load_text(other, "pace.rung", pair, strlen(pair)) && ladder_build(other));
	CHECK(twin_init(&next, ladder_program(other), NULL, MS) && twin_change(&next, &twin));
	CHECK(image_get(&next.resource.image, at("K")).i == 20 && get("K") < 20);
	CHECK(!next.resource.standing && next.resource.pace.speed == 120);
	CHECK(twin_scan(&next) && image_get(&next.resource.image, at("N")).i == 52);
	twin_free(&next);
	ladder_free(other);
	close_twin();
}

/* A record gives each period again, also those in which a scan stands. */
static void records(void)
{
	static int64_t k[80], n[80];
	struct record *record;
	struct replay replay;
	bool same;

	CHECK(open_twin(pair));
	record = record_new(&twin, 1000, 1 << 20);
	CHECK(record != NULL);
	for (enum act_kind kind = ACT_START; kind != ACT_SET;
	     kind = kind == ACT_START ? ACT_SPEED : ACT_SET) {
		const struct act one = { .kind = kind, .value.i = 120 };

		CHECK(twin_act(&twin, &one) && record_act(record, &twin, &one));
	}
	while (twin.scan < 70) {
		const struct act one = { .kind = ACT_SET, .at = at("Go"), .value.i = twin.scan & 1 };

		CHECK(twin_act(&twin, &one) && record_act(record, &twin, &one));
		twin_scan(&twin);
		record_scan(record, &twin);
		k[twin.scan] = get("K");
		n[twin.scan] = get("N") * 4 + get("Q0") * 2 + get("Q1");
	}
	same = replay_init(&replay, record);
	for (uint64_t scan = 70; same && scan >= 1; scan--) {
		const struct image *image = &replay.twin.resource.image;

		same = replay_seek(&replay, record, scan) && image_get(image, at("K")).i == k[scan] &&
		       image_get(image, at("N")).i * 4 + image_get(image, at("Q0")).i * 2 +
		       image_get(image, at("Q1")).i == n[scan];
	}
	CHECK_AS(same, "each period of the record is as it was");
	CHECK(k[51] < 20 && k[52] > k[51]);
	replay_free(&replay);
	record_free(record);
	close_twin();
}

static void make_long(void)
{
	size_t used = (size_t)snprintf(longer, sizeof(longer), "RUNGBOARD 1\nVAR\n  N, A : INT;\n"
				       "END_VAR\nPROGRAM Main IL\n  LD N\n  ADD 1\n  ST N\n");

	for (int i = 0; i < 150; i++)
		used += (size_t)snprintf(longer + used, sizeof(longer) - used,
					 "  LD A\n  ADD %d\n  ST A\n", i);
	snprintf(longer + used, sizeof(longer) - used, "END_PROGRAM\n");
}

/* One task: a scan takes as many periods as it needs, and the next one begins at a period. */
static void one_task(void)
{
	uint64_t words;

	make_long();
	CHECK(open_twin(longer));
	words = ladder_program(ladder)->entry[0].text_words;
	CHECK(act(ACT_START, 0) && act(ACT_SPEED, (int64_t)(words * 10)));
	scans(5);
	CHECK(get("N") == 5 && !twin.resource.late && twin.resource.scan_us == 100);
	/* One and a half periods: each second one. */
	CHECK(act(ACT_SPEED, (int64_t)(words * 2 / 3)));
	scans(6);
	CHECK(get("N") == 8 && twin.resource.late && twin.scan == 11);
	/* Ten late ones in a row are a fault, as with ladderd. */
	scans(12);
	CHECK(get("N") == 14 && twin.resource.state == STATE_RUN);
	scans(3);
	CHECK(get("N") == 15 && twin.resource.state == STATE_FAULT &&
	      twin.resource.fault == FAULT_WATCHDOG);
	/* So is one that takes ten periods. */
	CHECK(act(ACT_SPEED, (int64_t)(words / 9)) && act(ACT_START, 0));
	scans(1);
	CHECK(twin.resource.state == STATE_RUN);
	CHECK(act(ACT_SPEED, (int64_t)(words / 10)) && act(ACT_START, 0));
	scans(1);
	CHECK(twin.resource.fault == FAULT_WATCHDOG && !twin.resource.fault_at.task);
	close_twin();
}

/* The WATCHDOG of a task counts the time in which it is interrupted. */
static void watchdogs(void)
{
	static char text[2048];
	const char *with = strstr(pair, "T#50ms,");

	snprintf(text, sizeof(text), "%.*sT#50ms, WATCHDOG := T#2ms,%s", (int)(with - pair), pair,
		 with + strlen("T#50ms,"));
	CHECK(open_twin(text));
	stand(120);
	while (twin.resource.state == STATE_RUN && twin.scan < 60)
		scans(1);
	CHECK(twin.resource.fault == FAULT_WATCHDOG && twin.scan < 60 &&
	      strcmp(twin.resource.fault_at.task, "TSlow") == 0);
	CHECK(twin.resource.level == 0 && !twin.resource.standing);
	close_twin();
}

/* A scenario that was recorded with a speed says so. */
static void sessions(void)
{
	struct sink_memory memory;
	struct session *session;
	struct act one = { .kind = ACT_SPEED, .value.i = 120 };
	struct sink sink;

	CHECK(open_twin(pair));
	session = session_new(&twin.resource.image, MS);
	session_speed(session, 120);
	CHECK(session_act(session, 3, &one));
	one.value.i = 121;
	CHECK(!session_act(session, 3, &one));
	CHECK(session_expect(session, 1, at("N"), (union iec_value){ .i = 1 }));
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	CHECK(session_write(session, "x", &sink));
	CHECK_TEXT(sink_memory_text(&memory), "scenario \"x\"\n  period 1ms\n  speed 120\n"
				"  at 1ms        expect N = 1\n");
	sink_memory_free(&memory);
	session_free(session);
	close_twin();
}

/* ---- rounds of loops ---- */

/* The rounds of a loop are given while it runs: in a program without tasks, in a task of the
 * highest priority, and in a block that one calls. */
#define ROUND "  LD K\n  ADD 1\n  ST K\n  LT Rounds\n  JMPC Again\n"
#define SUM   "  LD 0\n  ST K\nAgain:\n" ROUND
#define VARS  "VAR_GLOBAL\n  Rounds, N : INT := 1;\nEND_VAR\n"
#define LOOP_BLOCK "FUNCTION_BLOCK Sum IL\nVAR\n  K : INT;\nEND_VAR\n" SUM "END_FUNCTION_BLOCK\n"
#define TOP   "CONFIGURATION Plant\n  TASK T1 (INTERVAL := T#1ms, PRIORITY := 0);\n" \
	"  TASK T2 (INTERVAL := T#1s, PRIORITY := 1);\n  PROGRAM A WITH T1 : Main;\n" \
	"  PROGRAM B WITH T2 : Low;\nEND_CONFIGURATION\nPROGRAM Low IL\n  LD N\n  ST N\nEND_PROGRAM\n"
static const char *const looping[] = {
	"RUNGBOARD 1\n" VARS "PROGRAM Main IL\nVAR\n  K : INT;\nEND_VAR\n" SUM "END_PROGRAM\n",
	"RUNGBOARD 1\n" VARS TOP "PROGRAM Main IL\nVAR\n  K : INT;\nEND_VAR\n" SUM "END_PROGRAM\n",
	"RUNGBOARD 1\n" VARS LOOP_BLOCK "PROGRAM Main IL\nVAR\n  S : Sum;\nEND_VAR\n  CAL S()\nEND_PROGRAM\n",
	"RUNGBOARD 1\n" VARS TOP LOOP_BLOCK
	"PROGRAM Main IL\nVAR\n  S : Sum;\nEND_VAR\n  CAL S()\nEND_PROGRAM\n",
};

/* Words of the next whole scan. */
static uint64_t words_for(int64_t rounds)
{
	CHECK(set("Rounds", rounds));
	scans(1);
	CHECK(!twin.resource.standing && twin.resource.state == STATE_RUN);
	return twin.resource.pace.taken;
}

static void rounds(void)
{
	uint64_t one, round;

	for (size_t i = 0; i < sizeof(looping) / sizeof(looping[0]); i++)
		for (int watch = 0; watch < 2; watch++) {
			CHECK(open_twin(looping[i]));
			twin.resource.watch = watch;
			CHECK(act(ACT_START, 0) && act(ACT_SPEED, (int64_t)PACE_SPEED_MOST));
			scans(2);
			one = words_for(1);
			round = words_for(2) - one;
			if (!CHECK(round > 10)) {
				close_twin();
				continue;
			}
			CHECK(round < one && words_for(100) == one + 99 * round &&
			      words_for(1000) == one + 999 * round && words_for(1) == one);
			/* The schedule: ten rounds a period, so 30 rounds are over in the fourth one. */
			CHECK(act(ACT_SPEED, (int64_t)(10 * round)) && set("Rounds", 30));
			scans(1);
			CHECK(twin.resource.late);
			scans(2);
			CHECK(twin.resource.late);
			scans(1);
			CHECK(twin.resource.scan_us == (one + 29 * round) * 1000 / (10 * round));
			close_twin();
		}
}

/* A jump over 50 statements: what it leaves out counts in a task that no task interrupts; in one that
 * is interrupted, only up to the next safe point. */
static void jumps_forward(void)
{
	static char text[8 * 1024];
	uint64_t ran, left;

	for (int low = 0; low < 2; low++) {
		size_t used = (size_t)snprintf(text, sizeof(text), "RUNGBOARD 1\nVAR_GLOBAL\n  Rounds, N : INT;\nEND_VAR\n"
			"CONFIGURATION Plant\n  TASK T1 (INTERVAL := T#1ms, PRIORITY := %d);\n  TASK T2 (INTERVAL := T#1s, PRIORITY := 1);\n"
			"  PROGRAM A WITH T1 : Main;\n  PROGRAM B WITH T2 : Low;\nEND_CONFIGURATION\nPROGRAM Low IL\n  LD N\n  ST N\nEND_PROGRAM\n"
			"PROGRAM Main IL\n  LD Rounds\n  GT 0\n  JMPC Over\n", 2 * low);

		for (int i = 0; i < 50; i++)
			used += (size_t)snprintf(text + used, sizeof(text) - used, "  LD N\n  ADD 1\n  ST N\n");
		snprintf(text + used, sizeof(text) - used, "Over:\n  LD Rounds\n  ST N\nEND_PROGRAM\n");
		CHECK(open_twin(text) && act(ACT_START, 0) && act(ACT_SPEED, (int64_t)PACE_SPEED_MOST));
		scans(2);
		ran = words_for(0);
		left = words_for(1);
		printf("# %llu words, with the jump %llu\n", (unsigned long long)ran, (unsigned long long)left);
		CHECK(ran > 300 && (low ? left < 150 : left == ran));
		close_twin();
	}
}

/* A program of nested loops and calls, and its blocks; the model knows how often each loop turns. */
struct maker {
	char text[32 * 1024];
	size_t used;
	struct { int rounds; uint64_t turns; } loop[60];
	int loops, variable;
	uint32_t seed;
};

static uint32_t any(struct maker *maker, uint32_t below)
{
	maker->seed = maker->seed * 1664525 + 1013904223;
	return (maker->seed >> 8) % below;
}

static void say(struct maker *maker, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	maker->used += (size_t)vsnprintf(maker->text + maker->used, sizeof(maker->text) - maker->used,
					 format, args);
	va_end(args);
	if (maker->used >= sizeof(maker->text))
		abort();
}

/* @times: how often this part of the body runs in a call. @calls: gets how often each of two blocks
 * is called. */
static void make_part(struct maker *maker, int depth, uint64_t times, uint64_t *calls)
{
	const uint32_t kind = any(maker, depth < 3 && maker->loops < 50 ? 6 : 3);
	int here, number;

	if (kind == 2 && calls) {
		here = (int)any(maker, 2);
		calls[here] += times;
		say(maker, "  CAL Own%d()\n", here);
		return;
	}
	if (kind < 3) {
		say(maker, "  LD N\n  ADD %u\n  MOD 1000\n  ST N\n", any(maker, 9));
		return;
	}
	number = maker->variable++;
	here = (int)any(maker, 6) + 1;
	say(maker, "  LD 0\n  ST K%d\nL%d:\n", number, number);
	for (int i = (int)any(maker, 3); i >= 0; i--)
		make_part(maker, depth + 1, times * (uint64_t)here, calls);
	say(maker, "  LD K%d\n  ADD 1\n  ST K%d\n  LT %d\n  JMPC L%d\n", number, number, here, number);
	/* In the order of their jumps back, as in the code. */
	maker->loop[maker->loops].rounds = here;
	maker->loop[maker->loops++].turns = times * (uint64_t)(here - 1);
}

/* Gives the words of a call without those of blocks. */
static void make_pou(struct maker *maker, const char *kind, const char *name, bool calls, uint64_t *called)
{
	maker->loops = maker->variable = 0;
	say(maker, "%s %s IL\nVAR\n%s", kind, name, calls ? "  Own0 : B0;\n  Own1 : B1;\n" : "");
	for (int i = 0; i < 60; i++)
		say(maker, "  K%d : INT;\n", i);
	say(maker, "END_VAR\n  LD N\n  ST N\n");
	for (int i = (int)any(maker, 3); i >= 0; i--)
		make_part(maker, 0, 1, calls ? called : NULL);
	say(maker, "END_%s\n", kind);
}

/* The words of a call of the POU that was made last, its blocks apart. */
static uint64_t model(const struct maker *maker, const char *name)
{
	const struct program *program = ladder_program(ladder);
	const struct code_program *at = program->entry;
	const uint32_t *pc;
	uint64_t words;
	int loop = 0;

	while (strcmp(program->string + at->name, name) != 0)
		at++;
	words = at->text_words;
	for (pc = program->text + at->text; pc < program->text + at->text + at->text_words;
	     pc += code_words(pc)) {
		const uint32_t *to = program->text + pc[1];

		if ((*pc & 0xff) != VM_JMPC || to > pc)
			continue;
		words += maker->loop[loop++].turns * (uint64_t)(pc - to + code_words(pc));
	}
	CHECK(loop == maker->loops);
	return words;
}

/* A random program: it takes what the model says, watched or not, alone, in a task that interrupts and in
 * one that is interrupted. */
static bool is_as_model(uint32_t seed)
{
	static const char *const name[] = { "B0", "B1", "Main" };
	static struct maker maker, made[3];
	uint64_t calls[2] = { 0, 0 }, wanted, seen[2];
	const uint32_t kind = seed % 3;
	bool over;

	maker.seed = seed;
	maker.used = 0;
	say(&maker, "RUNGBOARD 1\nVAR_GLOBAL\n  N, M : INT;\nEND_VAR\n");
	if (kind)
		say(&maker, "CONFIGURATION Plant\n  TASK T1 (INTERVAL := T#1ms, PRIORITY := %d);\n"
		    "  TASK T2 (INTERVAL := T#1s, PRIORITY := 1);\n  PROGRAM A WITH T1 : Main;\n"
		    "  PROGRAM B WITH T2 : Other;\nEND_CONFIGURATION\nPROGRAM Other IL\n  LD M\n  ST M\n"
		    "END_PROGRAM\n", kind == 1 ? 0 : 2);
	for (int i = 0; i < 3; i++) {
		make_pou(&maker, i < 2 ? "FUNCTION_BLOCK" : "PROGRAM", name[i], i == 2, calls);
		memcpy(made[i].loop, maker.loop, sizeof(maker.loop));
		made[i].loops = maker.loops;
	}
	if (!open_twin(maker.text)) {
		close_twin();
		return false;
	}
	wanted = model(&made[2], "Main") + calls[0] * model(&made[0], "B0") + calls[1] * model(&made[1], "B1");
	CHECK(act(ACT_START, 0) && act(ACT_SPEED, (int64_t)PACE_SPEED_MOST));
	scans(2);
	for (int watch = 0; watch < 2; watch++) {
		twin.resource.watch = watch;
		scans(1);
		seen[watch] = twin.resource.pace.taken;
	}
	over = twin.resource.state == STATE_FAULT && twin.resource.fault == FAULT_BUDGET;
	close_twin();
	if (over && wanted > LIMIT_BUDGET / 4)
		return true;
	if (seen[0] == wanted && seen[1] == wanted)
		return true;
	printf("# %u: %llu words, watched %llu, the model %llu\n", seed, (unsigned long long)seen[0],
	       (unsigned long long)seen[1], (unsigned long long)wanted);
	return false;
}

static void loops(void)
{
	const char *wanted = getenv("LOOP_COUNT");
	const uint32_t most = wanted ? (uint32_t)strtoul(wanted, NULL, 10) : 200;
	uint32_t same = 0;

	for (uint32_t seed = 0; seed < most; seed++)
		same += is_as_model(seed) ? 1 : 0;
	CHECK_AS(same == most, "random programs with loops take the words of the model");
}

static void reads(void)
{
	static const struct { const char *text; uint64_t speed; } given[] = {
		{ "0", 0 }, { "007", 7 }, { "100000000", PACE_SPEED_MOST }, { "", PACE_NO_NUMBER },
		{ "-1", PACE_NO_NUMBER }, { "5k", PACE_NO_NUMBER }, { "99999999999999999999999x", PACE_NO_NUMBER },
	};
	uint64_t large;

	for (size_t i = 0; i < sizeof(given) / sizeof(given[0]); i++)
		CHECK_AS(pace_read(given[i].text, strlen(given[i].text)) == given[i].speed, given[i].text);
	for (const char *text = "18446744073709551615000000"; strlen(text) > 9; text++) {
		large = pace_read(text, strlen(text));
		CHECK_AS(large > PACE_SPEED_MOST && large != PACE_NO_NUMBER, text);
		text += *text == '0';
	}
}

int main(void)
{
	reads();
	sees();
	shares();
	acts();
	records();
	one_task();
	watchdogs();
	sessions();
	rounds();
	jumps_forward();
	loops();
	return tap_done();
}
