/* SPDX-License-Identifier: MIT
 *
 * overruns - scans of cycle.c in virtual time, on lines that change at every moment.
 *
 * Each look at the clock moves it and turns all inputs over. One scan in a hundred takes one and a
 * half periods: so many periods are counted as missed, none is caught up, no two scans begin closer
 * than half a period, and a scan sees each input with one level.
 */
#include "hal/hal.h"
#include "hal/sim.h"
#include "tests/cycle_alone.h"

#include <time.h>

#define MS     INT64_C(1000000)
#define PERIOD (10 * MS)
#define SCANS  20000u
#define INPUTS 4

static const char *const program[] = {
	/* Both ends of a scan see the same; the tasks of the second one look at the clock between. */
	"PROGRAM Main LD\n%sRUNG\n  | [ Before <> After ] | [ Torn := Torn + 1 ] |\nEND_PROGRAM\n",
	"CONFIGURATION Plant\n  TASK A (INTERVAL := T#10ms, PRIORITY := 1);\n"
	"  TASK B (INTERVAL := T#10ms, PRIORITY := 2);\n  PROGRAM First WITH A : One;\n"
	"  PROGRAM Last WITH B : Main;\nEND_CONFIGURATION\n"
	"PROGRAM One LD\nRUNG\n  | [ Before := %IB0 ] |\nEND_PROGRAM\n"
	"PROGRAM Main LD\n%sRUNG\n  | [ Before <> After ] | [ Torn := Torn + 1 ] |\nEND_PROGRAM\n",
};
static const char globals[] =
	"VAR_GLOBAL\n  Before, After : BYTE;\n  Torn, Ups, Runs : DINT;\nEND_VAR\n";

static struct cycle cycle;
static struct rig rig;
static struct requests requests;
static struct iomap map;
static struct arena arena;
static int64_t now_ns, began_ns, closest_ns;
static unsigned long injected, starts, levels;
static bool level;
static unsigned seed;

int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_nanosleep(clockid_t clock, int flags, const struct timespec *until,
			   struct timespec *left);

static unsigned draw(unsigned below)
{
	seed = seed * 1664525u + 1013904223u;
	return (seed >> 8) % below;
}

static void turn_over(void)
{
	level = !level;
	for (int i = 0; i < INPUTS; i++) {
		struct iec_addr addr;
		uint32_t line;
		struct request *request;
		char text[24];

		snprintf(text, sizeof(text), "%%IX0.%d", i);
		iec_addr_parse(text, strlen(text), &addr);
		request = hal_find(&cycle.hal, addr, &line);
		sim_set(request, line, level ^ (i & 1));
	}
	levels++;
}

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
	(void)clock;
	if (cycle.hal.map)
		turn_over();
	now_ns += 1000;
	*out = (struct timespec){ now_ns / 1000000000, now_ns % 1000000000 };
	return 0;
}

/* Wakes up to 3 ms late. */
int __wrap_clock_nanosleep(clockid_t clock, int flags, const struct timespec *until,
			   struct timespec *left)
{
	const int64_t at_ns = until->tv_sec * INT64_C(1000000000) + until->tv_nsec;

	(void)clock, (void)flags, (void)left;
	now_ns = at_ns > now_ns ? at_ns : now_ns;
	now_ns += draw(3000) * INT64_C(1000);
	if (draw(2))
		turn_over(); /* scans look at the clock equally often */
	return 0;
}

/* ---- what cycle.c calls ---- */

void link_note(struct link *link, enum link_note note, int64_t at_ns)
{
	(void)link;
	if (note == NOTE_SCAN) {
		if (starts++ && at_ns - began_ns < closest_ns)
			closest_ns = at_ns - began_ns;
		began_ns = at_ns;
	}
	if (note == NOTE_SCANNED) {
		const bool slow = starts > 1 && draw(100) == 0;

		injected += slow;
		now_ns += slow ? 15 * MS : draw(4000) * INT64_C(1000);
	}
}

void link_serve(struct link *link)
{
	(void)link;
}

void link_show(struct link *link, int64_t at_ns)
{
	(void)link, (void)at_ns;
}

/* ---- the test ---- */

static bool open_lines(void)
{
	static const char text[] = "BOARD \"b\"\n%IX0.0 sim\n%IX0.1 sim\n%IX0.2 sim\n%IX0.3 sim\n%QX0.0 sim safe=0\n";
	static struct diag_list diags;

	diag_init(&diags);
	arena_init(&arena);
	return CHECK(iomap_read(&map, &arena, "map", text, sizeof(text) - 1, &diags) &&
		     hal_open(&cycle.hal, &map, &arena, &diags));
}

static char text[40000];

static void add(const char *form, const char *address)
{
	const size_t len = strlen(text);

	snprintf(text + len, sizeof(text) - len, form, address);
}

/* @form has one %s: the rungs of Main. */
static char *write_program(const char *form)
{
	static const char address[INPUTS][8] = { "%IX0.0", "%IX0.1", "%IX0.2", "%IX0.3" };
	const char *rest = strstr(form, "%s");

	text[0] = '\0';
	add("%s", globals);
	snprintf(text + strlen(text), (size_t)(rest - form) + 1, "%s", form);
	add("%s", strstr(form, "CONFIGURATION") ? "" : "RUNG\n  | [ Before := %IB0 ] |\n");
	for (int i = 0; i < 300; i++)
		add("RUNG\n  | P %s | [ Ups := Ups + 1 ] |\n", address[i % INPUTS]);
	add("RUNG\n  | [ After := %s ] | [ Runs := Runs + 1 ] |\n", "%IB0");
	add("%s", rest + 2);
	return text;
}

static void run(const char *form, bool tasks)
{
	memset(&cycle, 0, sizeof(cycle));
	if (!rig_open(&rig, write_program(form), false) || !open_lines())
		return;
	seed = 1;
	injected = starts = levels = 0;
	now_ns = 1000 * MS;
	closest_ns = INT64_MAX;
	cycle.resource = rig.resource;
	cycle.requests = &requests;
	cycle.link = (struct link *)&cycle; /* link_note() looks at no field of it */
	cycle.most_scans = SCANS;
	cycle_plan(&cycle, PERIOD, 1000);
	CHECK(cycle_run(&cycle) == 0 && cycle.scans == SCANS && starts == SCANS);
	rig.resource = cycle.resource;
	printf("# %u scans, %lu of 1.5 periods, %lu missed; two scans at least %.2f periods apart; inputs turned over %lu times\n",
	       SCANS, injected, (unsigned long)cycle.late, (double)closest_ns / (double)PERIOD, levels);
	CHECK(injected > SCANS / 150 && injected < SCANS / 70);
	CHECK_AS(cycle.late == injected, "each scan that took too long is a period that was missed, and nothing else is");
	CHECK_AS(closest_ns >= PERIOD / 2, "no scan is caught up");
	CHECK_AS(rig_get(&rig, "Torn") == 0, "inputs do not change within a scan");
	CHECK(rig_get(&rig, "Runs") == (tasks ? rig_get(&rig, "Runs") : SCANS) && rig_get(&rig, "Runs") > SCANS * 9 / 10);
	CHECK_AS(rig_get(&rig, "Ups") > SCANS, "and they do change from one scan to another");
	hal_close(&cycle.hal);
	arena_free(&arena);
	rig_close(&rig);
}

int main(void)
{
	run(program[0], false);
	run(program[1], true);
	return tap_done();
}
