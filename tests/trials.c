/* SPDX-License-Identifier: MIT
 *
 * trials - a program that is put into cycle.c on trial and has a FAULT, at each scan in turn: its first,
 * its second, … and the first after the trial. In virtual time.
 *
 * Within the trial the program before goes on as if the bad one had not been: the same bytes, no output at its
 * safe value. After the trial it is a FAULT, and the outputs are safe.
 */
#include "engine/scan/carry.h"
#include "hal/hal.h"
#include "hal/sim.h"
#include "ladderd/download.h"
#include "tests/cycle_alone.h"

#include <time.h>

#define MS     INT64_C(1000000)
#define PERIOD (10 * MS)
#define BEFORE 3u  /* scans before the exchange                             */
#define AFTER  4u  /* and after the FAULT                                   */

#define READING 1000 /* ns: each reading of the clock takes so long; before the first scan is one more */

enum kind { LOOP, SLOW, KINDS };

static const char good_text[] =
	"VAR\n  Lamp AT %QX0.0 : BOOL;\n  Brake AT %QX0.1 : BOOL;\n  Old : DINT;\n  Kept : INT := 5;\n  Slow : TON;\nEND_VAR\n"
	"PROGRAM Main LD\nRUNG\n  | [ Old := Old + 1 ] |\nRUNG\n  | NO SYS_ALWAYS_ON | TON Slow PT:=T#1h |\n"
	"RUNG\n  | NO SYS_ALWAYS_ON | COIL Lamp |\nEND_PROGRAM\n";
static const char bad_text[] =
	"VAR\n  Lamp AT %%QX0.0 : BOOL;\n  Brake AT %%QX0.1 : BOOL;\n  Old, New : DINT;\n  Kept : INT := 5;\n  Slow : TON;\n  Go : BOOL;\nEND_VAR\n"
	"PROGRAM Main LD\nRUNG\n  | [ New := New + 1 ] | [ Old := Old + 1000 ] | [ Kept := 7 ] |\n"
	"RUNG\n  | NC SYS_ALWAYS_ON | TON Slow PT:=T#2h |\nRUNG\n  | NO SYS_ALWAYS_ON | COIL Lamp |\n"
	"RUNG Again\n  | EQ IN1:=New IN2:=%u | COIL Go |\nRUNG\n  | NO Go | JMP Again |\nEND_PROGRAM\n";

static struct cycle cycle;
static struct requests requests;
static struct standby standby;
static struct rig good, bad;
static struct iomap map;
static struct arena arena;
static struct diag_list diags;
static uint8_t *was;                   /* the memory of the good program, at the exchange */
static int64_t now_ns;
static struct {
	enum kind kind;
	unsigned at, length;           /* the FAULT, the trial: scans         */
	unsigned back, passed, lit;    /* lit: scans with the outputs of RUN    */
	enum resource_state state;
	bool exchanged, same;
} now;

int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_nanosleep(clockid_t clock, int flags, const struct timespec *until,
			   struct timespec *left);

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
	(void)clock;
	now_ns += READING;
	*out = (struct timespec){ now_ns / 1000000000, now_ns % 1000000000 };
	return 0;
}

int __wrap_clock_nanosleep(clockid_t clock, int flags, const struct timespec *until,
			   struct timespec *left)
{
	const int64_t at_ns = until->tv_sec * INT64_C(1000000000) + until->tv_nsec;

	(void)clock, (void)flags, (void)left;
	now_ns = at_ns > now_ns ? at_ns : now_ns;
	return 0;
}

static bool level(const char *text)
{
	struct iec_addr addr;
	struct request *request;
	uint32_t line = 0;
	uint64_t levels = 0;

	iec_addr_parse(text, strlen(text), &addr);
	request = hal_find(&cycle.hal, addr, &line);
	request->driver->read(request, &levels);
	return levels >> line & 1;
}

static bool at_the_scan(enum kind kind)
{
	return now.kind == kind && now.exchanged && !now.back && rig_get(&bad, "New") == now.at;
}

/* ---- what cycle.c and download.c call ---- */

void link_note(struct link *link, enum link_note note, int64_t at_ns)
{
	(void)link, (void)at_ns;
	if (note == NOTE_SCANNED && at_the_scan(SLOW))
		now_ns += 3 * PERIOD;
}

void link_serve(struct link *link)
{
	(void)link;
	if (now.exchanged || cycle.scans != BEFORE)
		return;
	now.exchanged = true;
	memcpy(was, good.memory, image_memory_size(good.resource.image.program));
	CHECK(cycle_swap(&cycle, &standby, now.length) == REFUSAL_NONE);
	CHECK(cycle.resource.image.program == bad.resource.image.program);
}

void link_show(struct link *link, int64_t at_ns)
{
	(void)link, (void)at_ns;
	now.lit += level("%QX0.0") && !level("%QX0.1");
	now.state = cycle.resource.state;
}

void link_trial_over(struct link *link, bool back)
{
	(void)link;
	*(back ? &now.back : &now.passed) += 1;
	now.same = memcmp(was, good.memory, image_memory_size(good.resource.image.program)) == 0;
}

void monitor_limit(int64_t limit_ns)
{
	(void)limit_ns;
}

void control_print_fault(const struct resource *resource, char *out, size_t size)
{
	snprintf(out, size, "%d", (int)resource->fault);
}

/* ---- the test ---- */

static bool open_all(void)
{
	static const char text[] = "BOARD \"b\"\n%QX0.0 sim safe=0\n%QX0.1 sim safe=1\n";
	static char program[2000];
	char detail[LIMIT_ARG];

	snprintf(program, sizeof(program), bad_text, now.kind == LOOP ? now.at : 1000000u);
	if (!rig_open(&good, good_text, false) || !rig_open(&bad, program, false))
		return false;
	memset(&cycle, 0, sizeof(cycle));
	memset(&standby, 0, sizeof(standby));
	diag_init(&diags);
	arena_init(&arena);
	standby.resource = bad.resource;
	standby.plan = carry_plan_new(bad.resource.image.program, good.resource.image.program, &arena);
	memset(standby.identity, 2, sizeof(standby.identity));
	memset(cycle.identity_bytes, 1, sizeof(cycle.identity_bytes));
	was = malloc(image_memory_size(good.resource.image.program));
	return CHECK(standby.plan && was && iomap_read(&map, &arena, "map", text, sizeof(text) - 1, &diags) &&
		     hal_open(&cycle.hal, &map, &arena, &diags) &&
		     hal_beside(&standby.lines, &cycle.hal, &map, &arena, &diags, detail) == BESIDE_GOOD &&
		     hal_open_new(&standby.lines, &diags));
}

static void close_all(void)
{
	hal_close(&cycle.hal);
	arena_free(&arena);
	rig_close(&bad);
	rig_close(&good);
	free(was);
	was = NULL;
}

static bool went_back(void)
{
	static const uint8_t one[32] = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
					 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 };

	good.resource = cycle.resource;
	return now.back == 1 && !now.passed && now.same && now.lit == cycle.scans &&
	       now.state == STATE_RUN && cycle.resource.fault == FAULT_NONE &&
	       memcmp(cycle.identity_bytes, one, sizeof(one)) == 0 && *standby.why != '0' &&
	       rig_get(&bad, "New") == now.at && rig_get(&good, "Kept") == 5 &&
	       rig_get(&good, "Old") == (int64_t)(cycle.scans - now.at) &&
	       rig_get(&good, "Slow.ET") >= (int64_t)(cycle.scans - 1) * PERIOD - READING;
}

static bool is_fault(void)
{
	return !now.back && now.passed == 1 && now.state == STATE_FAULT && !level("%QX0.0") &&
	       level("%QX0.1") && cycle.identity_bytes[0] == 2 &&
	       cycle.resource.image.program == bad.resource.image.program && rig_get(&bad, "New") == now.at;
}

static void run(enum kind kind, unsigned at, unsigned length)
{
	static const char *const word[KINDS] = { "a loop", "a scan that is too long" };

	now.kind = kind;
	now.at = at;
	now.length = length;
	now.back = now.passed = now.lit = 0;
	now.exchanged = now.same = false;
	now_ns = 1000 * MS;
	if (!open_all())
		return;
	cycle.resource = good.resource;
	cycle.requests = &requests;
	cycle.link = (struct link *)&cycle; /* link_note() looks at no field of it */
	cycle.most_scans = BEFORE + at + AFTER;
	cycle_plan(&cycle, PERIOD, 2);
	cycle_run(&cycle);
	if (!(at <= length ? went_back() : is_fault())) {
		printf("# %s at scan %u of a trial of %u scans: back %u, passed %u, same %d, state %d, %u of %lu scans lit\n",
		       word[kind], at, length, now.back, now.passed, now.same, (int)now.state, now.lit,
		       (unsigned long)cycle.scans);
		CHECK(false);
	}
	close_all();
}

int main(void)
{
	static const unsigned length[] = { 1, 2, 3, 5, 20, 100 };
	unsigned runs = 0;

	for (size_t i = 0; i < sizeof(length) / sizeof(length[0]); i++)
		for (enum kind kind = 0; kind < KINDS; kind++)
			for (unsigned at = 1; at <= length[i] + 1; at++, runs++)
				run(kind, at, length[i]);
	printf("# %u programs with a FAULT, at each scan of trials of 1 to 100 scans and at the first after it\n", runs);
	CHECK_AS(runs == KINDS * (131 + 6), "each scan of each trial");
	return tap_done();
}
