/* SPDX-License-Identifier: MIT
 *
 * test_samples - the scenarios of ladders/ with real lines.
 *
 * A plan (cases/plan.c) says which inputs change before which scan, and which outputs are
 * checked after which scan, with a mask: 0 where the result depends on the scan that sees
 * an edge. ladderd reports scan 1; inputs change half a period before their scan, outputs
 * are checked a quarter of a period after it.
 *
 * A long scenario tests the program more than the driver of the lines. So the second and the third
 * ladderd play only those of at most AGAIN_SCANS scans.
 */
#include "tests/targets/guest/bank.h"
#include "tests/targets/guest/child.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AGAIN_SCANS 2000
#define LINES 32
#define LINE_BYTES 300

struct plan {
	FILE *from;
	char line[LINE_BYTES];
	char name[64], map[64];
	char text[LINES][32];      /* names of lines, inputs first            */
	const char *names[LINES];
	uint32_t low;              /* active low, one bit a line              */
	unsigned inputs, lines;
	/* Of the running scenario. */
	struct bank bank;
	struct child child;
	int64_t first_ns, period_ns;
	unsigned long looks, wrong;
	char why[160];
};

static bool next_line(struct plan *plan)
{
	if (!fgets(plan->line, sizeof(plan->line), plan->from))
		return false;
	plan->line[strcspn(plan->line, "\n")] = 0;
	return true;
}

/* The text after a word; NULL: the line begins with another word. */
static char *behind(struct plan *plan, const char *word)
{
	size_t len = strlen(word);

	if (strncmp(plan->line, word, len) != 0 || plan->line[len] != ' ')
		return NULL;
	return plan->line + len + 1;
}

static void add_line(struct plan *plan, const char *text)
{
	size_t len = strcspn(text, " ");

	if (plan->lines == LINES)
		give_up("plan with too many lines");
	snprintf(plan->text[plan->lines], sizeof(plan->text[0]), "%.*s",
		 (int)len, text);
	plan->names[plan->lines] = plan->text[plan->lines];
	if (text[len])
		plan->low |= UINT32_C(1) << plan->lines;
	plan->lines++;
}

static void press(struct plan *plan, uint32_t inputs, uint32_t changed)
{
	for (unsigned i = 0; i < plan->inputs; i++)
		if (changed >> i & 1)
			bank_pull(&plan->bank, i,
				  ((inputs ^ plan->low) >> i & 1) != 0);
}

static uint32_t shown(struct plan *plan)
{
	return bank_levels(&plan->bank, plan->inputs,
			   plan->lines - plan->inputs) ^
	       plan->low >> plan->inputs;
}

static int64_t time_of(const struct plan *plan, unsigned long scan)
{
	return plan->first_ns + (int64_t)(scan - 1) * plan->period_ns;
}

static bool start(struct plan *plan, uint32_t inputs)
{
	char file[80], period[32];

	bank_up(&plan->bank, "sample", plan->names, plan->lines, -1);
	press(plan, inputs, UINT32_MAX);
	snprintf(file, sizeof(file), "%s.rung%s", plan->name,
		 guest.small ? "c" : "");
	snprintf(period, sizeof(period), "%ldus",
		 (long)(plan->period_ns / 1000));
	ladderd_start(&plan->child, file_case(file), file_case(plan->map),
		      "--period", period, "--watchdog", "1000", NULL);
	plan->first_ns = child_ready();
	plan->looks = plan->wrong = 0;
	plan->why[0] = 0;
	return plan->first_ns != 0;
}

static void look(struct plan *plan, unsigned long scan, uint32_t want,
		 uint32_t mask)
{
	uint32_t got;

	sleep_until(time_of(plan, scan) + plan->period_ns / 4);
	got = shown(plan);
	plan->looks++;
	if (((got ^ want) & mask) == 0)
		return;
	if (plan->wrong++ == 0)
		snprintf(plan->why, sizeof(plan->why),
			 "scan %lu: outputs %x, not %x (mask %x)", scan,
			 (unsigned)got, (unsigned)want, (unsigned)mask);
}

/* The lines from `scenario` to `end`. */
static void play(struct plan *plan, char *name, bool skipped)
{
	uint32_t inputs = 0;
	bool begun = false, started = false;
	char *text;
	int code;

	while (next_line(plan) && strcmp(plan->line, "end") != 0) {
		if (skipped)
			continue;
		if ((text = behind(plan, "at")) != NULL) {
			unsigned long scan = strtoul(text, &text, 10);
			uint32_t next = (uint32_t)strtoul(text, NULL, 16);

			if (!begun)
				started = start(plan, next);
			else if (started)
				sleep_until(time_of(plan, scan) -
					    plan->period_ns / 2);
			begun = true;
			press(plan, next, inputs ^ next);
			inputs = next;
		} else if ((text = behind(plan, "see")) != NULL && started) {
			unsigned long scan = strtoul(text, &text, 10);
			uint32_t want = (uint32_t)strtoul(text, &text, 16);

			look(plan, scan, want,
			     (uint32_t)strtoul(text, NULL, 16));
		}
	}
	if (skipped)
		return;
	if (!check(started && plan->looks > 0 && plan->wrong == 0,
		   "%s: %s (%lu looks)", plan->name, name, plan->looks))
		note("%s%lu wrong; %s", begun && !started ? "ladderd reported no scan; " : "",
		     plan->wrong, plan->why);
	if (!begun)
		return;
	code = child_stop(&plan->child);
	if (code != 0)
		check(false, "%s: %s: ends well, not with %d", plan->name, name, code);
	bank_down(&plan->bank);
}

static void scenario(struct plan *plan, char *text)
{
	static char name[LINE_BYTES];
	unsigned long scans;
	bool long_again, skipped;
	char *end;

	plan->period_ns = (int64_t)strtoul(text, &end, 10) * 1000;
	scans = strtoul(end, &end, 10);
	snprintf(name, sizeof(name), "%s", end + (*end == ' '));
	long_again = guest.again && scans > AGAIN_SCANS;
	skipped = long_again || (int64_t)scans * plan->period_ns > guest.longest_ns;
	if (skipped)
		skip(long_again ? "long: only with the first ladderd" : "longer than --longest allows",
		     "%s: %s", plan->name, name);
	play(plan, name, skipped);
}

static void run_plan(const char *name)
{
	static struct plan plan;
	char *text;

	memset(&plan, 0, sizeof(plan));
	snprintf(plan.line, sizeof(plan.line), "%.63s.plan", name);
	plan.from = fopen(file_case(plan.line), "r");
	if (!plan.from)
		give_up(file_case(plan.line));
	while (next_line(&plan)) {
		if ((text = behind(&plan, "name")) != NULL)
			snprintf(plan.name, sizeof(plan.name), "%.63s",
				 text);
		else if ((text = behind(&plan, "map")) != NULL)
			snprintf(plan.map, sizeof(plan.map), "%.63s", text);
		else if ((text = behind(&plan, "in")) != NULL)
			add_line(&plan, text), plan.inputs = plan.lines;
		else if ((text = behind(&plan, "out")) != NULL)
			add_line(&plan, text);
		else if ((text = behind(&plan, "scenario")) != NULL)
			scenario(&plan, text);
		else if ((text = behind(&plan, "skip")) != NULL)
			skip("sets what is no input", "%s: %s", plan.name,
			     text);
		else if ((text = behind(&plan, "dated")) != NULL)
			skip("goes by the date", "%s: %s", plan.name, text);
		else if ((text = behind(&plan, "days")) != NULL)
			skip("takes days", "%s: %s", plan.name, text);
	}
	fclose(plan.from);
}

/* The list of plans, one name a line. */
void test_samples(void)
{
	static char names[2048];
	char *at = names;

	if (file_take(file_case("plans"), names, sizeof(names)) <= 0)
		give_up(file_case("plans"));
	while (*at) {
		size_t len = strcspn(at, "\n");
		bool more = at[len] == '\n';

		at[len] = 0;
		if (len > 0)
			run_plan(at);
		at += len + more;
	}
}
