/* SPDX-License-Identifier: MIT
 *
 * test_pace - virtual time with a speed: which period does how much work, what a period sees,
 * late scans, watchdogs, acts in the middle of a scan, and a record.
 */
#include "engine/trial/pace.h"
#include "engine/trial/record.h"
#include "engine/trial/session.h"
#include "tests/unit/rig.h"

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
	CHECK(act(ACT_START, 0));
	scans(50);
	CHECK(get("N") == 50 && get("K") == 20 && act(ACT_SPEED, (int64_t)speed));
	scans(1);
	CHECK(twin.resource.standing && twin.resource.level == 1 && get("K") > 0 && get("K") < 20);
}

static void sees(void)
{
	CHECK(open_twin(pair));
	stand(120);
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
	return tap_done();
}
