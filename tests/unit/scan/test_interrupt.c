/* SPDX-License-Identifier: MIT
 *
 * test_interrupt - tasks that interrupt each other, against a model.
 *
 * Random sets of tasks run with interruptions at random safe points. The model is written from
 * docs/language.md: it runs rung by rung and interrupts at the recorded places. Each rung
 * begins with a mark, so a place is told by variables, not by the engine. Every value that can
 * be seen must be the same after each scan and at each interruption.
 */
#include "engine/scan/interrupt.h"
#include "engine/trial/pace.h"
#include "tests/unit/rig.h"

#include <stdarg.h>

#define MS INT64_C(1000000)

enum { TASKS = 4, RUNGS = 30, BITS = 8, VALUES = 6, SAVED = 400 };

/* ---- random programs ---- */

enum line_kind { BEGIN, SUM, COIL, SET, RESET, WAIT, CYCLE, LOOP };
/* A bit: I0 …, Q0 …, B0 … */
struct mark { char area; int number; };
struct line {
	enum line_kind kind;
	struct mark on, to;
	bool negated;
	int a, b, c;        /* SUM: values; LOOP: rounds, the rung it goes back to */
};
struct job {
	int rungs;
	struct line rung[RUNGS];
	int64_t interval;   /* 0: it waits for B<event>                           */
	int event, priority;
	bool target[RUNGS];
};
struct set { int tasks; struct job task[TASKS]; };

static uint64_t state;

static uint32_t any(uint32_t below)
{
	state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
	return (uint32_t)(state >> 33) % below;
}

static struct mark any_bit(bool write)
{
	static const char areas[] = "BQI";

	return (struct mark){ areas[any(write ? 2 : 3)], (int)any(BITS) };
}

static void make_rung(struct job *task, int at)
{
	struct line *rung = &task->rung[at];

	rung->kind = at == 0 ? BEGIN : (enum line_kind)(SUM + any(LOOP - SUM));
	rung->on = any_bit(false);
	rung->to = any_bit(true);
	rung->negated = any(3) == 0;
	rung->a = (int)any(VALUES);
	rung->b = (int)any(VALUES);
	rung->c = (int)any(VALUES);
}

static void make_plan(struct set *plan)
{
	memset(plan, 0, sizeof(*plan));
	plan->tasks = 2 + (int)any(TASKS - 1);
	for (int t = 0; t < plan->tasks; t++) {
		struct job *task = &plan->task[t];
		const bool last = t + 1 == plan->tasks;

		task->rungs = last ? 4 + (int)any(RUNGS - 4) : 1 + (int)any(8);
		task->priority = t && any(5) == 0 && plan->task[t - 1].interval ?
					 plan->task[t - 1].priority : 2 * t;
		task->interval = (int64_t)(1 + any(last ? 12 : 4)) * MS;
		if (!last && task->priority == 2 * t && any(3) == 0)
			task->interval = 0;
		task->event = (int)any(BITS);
		for (int i = 0; i < task->rungs; i++)
			make_rung(task, i);
		if (task->rungs > 3 && any(2)) {
			struct line *loop = &task->rung[2 + any((uint32_t)task->rungs - 2)];

			loop->kind = LOOP;
			loop->a = 1 + (int)any(6);
			loop->b = 1 + (int)any((uint32_t)(loop - task->rung) - 1);
			task->target[loop->b] = true;
		}
	}
}

/* ---- as a file ---- */

static char file[32768];
static size_t used;

static void put(const char *format, ...) __attribute__((format(printf, 1, 2)));
static void put(const char *format, ...)
{
	va_list args;

	va_start(args, format);
	used += (size_t)vsnprintf(file + used, sizeof(file) - used, format, args);
	va_end(args);
}

static void put_rung(const struct job *task, int t, int at)
{
	const struct line *r = &task->rung[at];

	put("RUNG");
	if (task->target[at])
		put(" L%d", at);
	put("\n  | [ At%d := %d ] | ", t, at);
	if (r->kind != BEGIN && r->kind != LOOP)
		put("%s %c%d | ", r->negated ? "NC" : "NO", r->on.area, r->on.number);
	switch (r->kind) {
	case BEGIN: put("[ Runs%d := Runs%d + 1 ] | [ K%d := 0 ] |\n", t, t, t); break;
	case SUM: put("[ V%d := V%d + V%d ] |\n", r->a, r->b, r->c); break;
	case COIL: put("COIL %c%d |\n", r->to.area, r->to.number); break;
	case SET: put("S %c%d |\n", r->to.area, r->to.number); break;
	case RESET: put("R %c%d |\n", r->to.area, r->to.number); break;
	case WAIT: put("TON T%d PT:=T#3ms | COIL %c%d |\n", at, r->to.area, r->to.number); break;
	case CYCLE: put("[ Cycle%d := SYS_CYCLE ] |\n", t); break;
	case LOOP:
		put("[ K%d := K%d + 1 ] | [ K%d < %d ] | JMP L%d |\n", t, t, t, r->a, r->b);
		break;
	}
}

static void put_globals(const struct set *plan)
{
	put("VAR_GLOBAL\n");
	for (int i = 0; i < BITS; i++)
		put("  I%d AT %%IX0.%d : BOOL;\n  Q%d AT %%QX0.%d : BOOL;\n  B%d : BOOL;\n", i, i, i,
		    i, i);
	for (int i = 0; i < VALUES; i++)
		put("  V%d : INT := %d;\n", i, i + 1);
	for (int t = 0; t < plan->tasks; t++)
		put("  At%d, Runs%d, K%d : INT;\n  Cycle%d : TIME;\n", t, t, t, t);
	put("END_VAR\nCONFIGURATION Plant\n  RESOURCE Cpu\n");
	for (int t = 0; t < plan->tasks; t++) {
		const struct job *task = &plan->task[t];

		if (task->interval)
			put("    TASK T%d (INTERVAL := T#%dms, PRIORITY := %d);\n", t,
			    (int)(task->interval / MS), task->priority);
		else
			put("    TASK T%d (SINGLE := B%d, PRIORITY := %d);\n", t, task->event,
			    task->priority);
	}
	for (int t = 0; t < plan->tasks; t++)
		put("    PROGRAM R%d WITH T%d : P%d;\n", t, t, t);
	put("  END_RESOURCE\nEND_CONFIGURATION\n");
}

static void put_plan(const struct set *plan)
{
	used = 0;
	put_globals(plan);
	for (int t = 0; t < plan->tasks; t++) {
		const struct job *task = &plan->task[t];

		put("PROGRAM P%d LD\nVAR\n", t);
		for (int i = 0; i < task->rungs; i++)
			if (task->rung[i].kind == WAIT)
				put("  T%d : TON;\n", i);
		put("  Unused : BOOL;\nEND_VAR\n");
		for (int i = 0; i < task->rungs; i++)
			put_rung(task, t, i);
		put("END_PROGRAM\n");
	}
}

/* ---- the engine, with interruptions at random ---- */

/* All that the programs can see or tell. */
struct seen {
	uint8_t i, q, b;
	int16_t v[VALUES], at[TASKS], runs[TASKS], k[TASKS];
	int64_t cycle[TASKS];
};
/* An interruption: which task, where (before it begins, or which rung was its last one), when,
 * with which inputs; what the board gets. */
struct saved { int task, at, runs, k; bool waits; int64_t now; uint8_t in, out; };

static struct rig rig;
static struct location place_of_v[VALUES], place_of_at[TASKS], place_of_runs[TASKS],
	place_of_k[TASKS], place_of_cycle[TASKS], place_of_b[BITS];
static struct saved saved[SAVED];
static int saved_count, order[SAVED], order_count;
static int64_t engine_ns;
static uint32_t hurry; /* one safe point in so many is used */

static void find_places(const struct set *plan)
{
	char name[24];

	for (int i = 0; i < VALUES; i++)
		snprintf(name, sizeof(name), "V%d", i), place_of_v[i] = rig_at(&rig, name);
	for (int i = 0; i < BITS; i++)
		snprintf(name, sizeof(name), "B%d", i), place_of_b[i] = rig_at(&rig, name);
	for (int t = 0; t < plan->tasks; t++) {
		snprintf(name, sizeof(name), "At%d", t), place_of_at[t] = rig_at(&rig, name);
		snprintf(name, sizeof(name), "Runs%d", t), place_of_runs[t] = rig_at(&rig, name);
		snprintf(name, sizeof(name), "K%d", t), place_of_k[t] = rig_at(&rig, name);
		snprintf(name, sizeof(name), "Cycle%d", t), place_of_cycle[t] = rig_at(&rig, name);
	}
}

static int64_t get(struct location at)
{
	return image_get(&rig.resource.image, at).i;
}

static struct seen engine_sees(const struct set *plan)
{
	struct seen seen;

	memset(&seen, 0, sizeof(seen));
	seen.i = image_area(&rig.resource.image, AREA_I)[0];
	seen.q = image_area(&rig.resource.image, AREA_Q)[0];
	for (int i = 0; i < BITS; i++)
		seen.b |= (uint8_t)(get(place_of_b[i]) << i);
	for (int i = 0; i < VALUES; i++)
		seen.v[i] = (int16_t)get(place_of_v[i]);
	for (int t = 0; t < plan->tasks; t++) {
		seen.at[t] = (int16_t)get(place_of_at[t]);
		seen.runs[t] = (int16_t)get(place_of_runs[t]);
		seen.k[t] = (int16_t)get(place_of_k[t]);
		seen.cycle[t] = get(place_of_cycle[t]);
	}
	return seen;
}

static bool asks(struct resource *resource, int64_t *now_ns)
{
	struct saved *at = &saved[saved_count];
	const uint32_t task = resource->run[resource->level].task;

	if (saved_count == SAVED || any(hurry))
		return false;
	engine_ns += any(3) ? any(800000) : any(3000000);
	*now_ns = engine_ns;
	*at = (struct saved){ (int)task, (int)get(place_of_at[task]),
			      (int)get(place_of_runs[task]), (int)get(place_of_k[task]),
			      !resource->tasks.state[task].ran, engine_ns, 0, 0 };
	return true;
}

static bool begin(struct resource *resource, int64_t now_ns)
{
	struct saved *at = &saved[saved_count];

	(void)now_ns;
	order[order_count++] = saved_count++;
	at->in = (uint8_t)any(256);
	image_area(&resource->image, AREA_I)[0] = at->in;
	return true;
}

static bool end(struct resource *resource, int64_t now_ns)
{
	(void)now_ns;
	saved[order[--order_count]].out = image_area(&resource->image, AREA_Q)[0];
	return true;
}

static const struct interrupts at_random = { asks, begin, end, NULL };

/* ---- the model ---- */

struct model_timer { bool in; int64_t since; };
static struct {
	const struct set *plan;
	struct seen now;            /* i and q: those of the task that runs           */
	uint8_t written;            /* outputs of whole tasks                         */
	int64_t task_ns, cycle_ns;  /* time of the task that runs; its SYS_CYCLE      */
	int64_t next[TASKS], began[TASKS];
	bool has_begun[TASKS], due[TASKS], ran[TASKS], was[TASKS];
	struct model_timer timer[TASKS][RUNGS];
	int used;                   /* of saved[]                                     */
	bool wrong;
} model;

static bool bit_of(struct mark bit)
{
	const uint8_t byte = bit.area == 'I' ? model.now.i : bit.area == 'Q' ? model.now.q :
									       model.now.b;

	return byte >> bit.number & 1;
}

static void set_bit(struct mark bit, bool value)
{
	uint8_t *byte = bit.area == 'Q' ? &model.now.q : &model.now.b;

	*byte = (uint8_t)((*byte & ~(1u << bit.number)) | (unsigned)value << bit.number);
}

static bool timer_q(int t, int at, bool in)
{
	struct model_timer *timer = &model.timer[t][at];

	if (in && !timer->in)
		timer->since = model.task_ns;
	timer->in = in;
	return in && model.task_ns - timer->since >= 3 * MS;
}

/* Returns the rung that follows. */
static int run_rung(int t, int at)
{
	const struct line *r = &model.plan->task[t].rung[at];
	const bool on = r->kind != BEGIN && r->kind != LOOP && bit_of(r->on) != r->negated;
	int16_t *v = model.now.v;

	model.now.at[t] = (int16_t)at;
	switch (r->kind) {
	case BEGIN:
		model.now.runs[t]++;
		model.now.k[t] = 0;
		break;
	case SUM:
		if (on)
			v[r->a] = (int16_t)(uint16_t)(v[r->b] + v[r->c]);
		break;
	case COIL: set_bit(r->to, on); break;
	case SET:
		if (on)
			set_bit(r->to, true);
		break;
	case RESET:
		if (on)
			set_bit(r->to, false);
		break;
	case WAIT: set_bit(r->to, timer_q(t, at, on)); break;
	case CYCLE:
		if (on)
			model.now.cycle[t] = model.cycle_ns;
		break;
	case LOOP:
		if (++model.now.k[t] < r->a)
			return r->b;
		break;
	}
	return at + 1;
}

static void interrupt_model(int t);

static bool is_here(int t, bool waits)
{
	const struct saved *at = &saved[model.used];

	return model.used < saved_count && at->task == t && at->waits == waits && at->at == model.now.at[t] &&
	       at->runs == model.now.runs[t] && at->k == model.now.k[t];
}

static void look(void)
{
	for (int t = 0; t < model.plan->tasks; t++) {
		const struct job *task = &model.plan->task[t];
		const bool on = model.now.b >> task->event & 1;

		if (task->interval)
			continue;
		if (on && !model.was[t])
			model.due[t] = true;
		model.was[t] = on;
	}
}

static void run_model_task(int t, int64_t now)
{
	const struct job *task = &model.plan->task[t];

	model.due[t] = false;
	model.ran[t] = true;
	if (task->interval)
		model.next[t] += ((now - model.next[t]) / task->interval + 1) * task->interval;
	model.cycle_ns = model.has_begun[t] ? model.task_ns - model.began[t] :
			 task->interval ? task->interval : RIG_PERIOD;
	model.has_begun[t] = true;
	model.began[t] = model.task_ns;
	for (int at = 0; at < task->rungs; at = run_rung(t, at))
		while (is_here(t, false))
			interrupt_model(t);
	look();
}

/* The due tasks with a number below @count, by priority. */
static void run_model(int count, int64_t now)
{
	for (int t = 0; t < count; t++) {
		model.ran[t] = false;
		if (model.plan->task[t].interval)
			model.due[t] = now >= model.next[t];
	}
	look();
	for (int t = 0; t < count; t++) {
		if (!model.due[t] || model.ran[t])
			continue;
		if (is_here(t, true))
			interrupt_model(t);
		else
			run_model_task(t, now);
		t = -1;
	}
}

static bool may_begin(int count, int64_t now)
{
	for (int t = 0; t < count; t++)
		if (!model.plan->task[t].interval || now >= model.next[t])
			return true;
	return false;
}

static void interrupt_model(int t)
{
	const struct saved *at = &saved[model.used++];
	const uint8_t i = model.now.i, q = model.now.q, before = model.written;
	const int64_t task_ns = model.task_ns, cycle_ns = model.cycle_ns;
	int count = 0;

	while (model.plan->task[count].priority < model.plan->task[t].priority)
		count++;
	if (!may_begin(count, at->now)) {
		model.wrong = true;
		return;
	}
	model.now.i = at->in;
	model.now.q = model.written;
	model.task_ns = at->now;
	run_model(count, at->now);
	model.written = model.now.q;
	if (model.written != at->out)
		model.wrong = true;
	model.now.i = i;
	/* What changed meanwhile is new; the rest is what this task wrote so far. */
	model.now.q = (uint8_t)((q & ~(before ^ model.written)) |
				(model.written & (before ^ model.written)));
	model.task_ns = task_ns;
	model.cycle_ns = cycle_ns;
}

static void start_model(const struct set *plan)
{
	memset(&model, 0, sizeof(model));
	model.plan = plan;
	for (int i = 0; i < VALUES; i++)
		model.now.v[i] = (int16_t)(i + 1);
}

static void scan_model(int64_t now, bool first)
{
	model.used = 0;
	model.task_ns = now;
	for (int t = 0; first && t < TASKS; t++)
		model.next[t] = now;
	run_model(model.plan->tasks, now);
	model.written = model.now.q;
	if (model.used != saved_count)
		model.wrong = true;
}

/* ---- comparisons ---- */

static uint64_t interruptions, nested;

/* The words of all runs: a whole program each, however often it was interrupted. */
static uint64_t words_of_runs(void)
{
	const struct program *program = rig.resource.image.program;
	uint64_t words = 0;

	for (uint32_t i = 0; i < program->task_count; i++)
		for (uint32_t k = 0; k < program->task[i].count; k++)
			words += rig.resource.tasks.state[i].runs *
				 program->entry[program->call[program->task[i].first + k]].text_words;
	return words;
}

static bool agree(const struct set *plan, int scans)
{
	uint64_t words = 0;

	start_model(plan);
	engine_ns = 0;
	for (int i = 0; i < scans; i++) {
		const int64_t now = engine_ns + (int64_t)any(12) * MS + 1;
		struct seen got;

		saved_count = 0;
		rig.resource.vm.ask = any(5) > 0; /* the timer did not come */
		engine_ns = now;
		model.now.i = (uint8_t)any(256);
		image_area(&rig.resource.image, AREA_I)[0] = model.now.i;
		if (!resource_scan(&rig.resource, now))
			return false;
		words += rig.resource.words;
		interruptions += (uint64_t)saved_count;
		for (int k = 1; k < saved_count; k++)
			nested += saved[k].task < saved[k - 1].task;
		got = engine_sees(plan);
		scan_model(now, i == 0);
		if (model.wrong || memcmp(&got, &model.now, sizeof(got)) != 0) {
			printf("# scan %d: %d interruptions, the model found %d\n", i, saved_count,
			       model.used);
			return false;
		}
		if (words != words_of_runs()) {
			printf("# scan %d: %llu words, those of the runs are %llu\n", i, (unsigned long long)words,
			       (unsigned long long)words_of_runs());
			return false;
		}
	}
	return true;
}

static bool open_plan(const struct set *plan, bool watch)
{
	static char whole[sizeof(file) + 16];

	put_plan(plan);
	memset(&rig, 0, sizeof(rig));
	rig.ladder = ladder_new();
	ladder_watch(rig.ladder, watch);
	snprintf(whole, sizeof(whole), "RUNGBOARD 1\n%s", file);
	rig.good = ladder_load_text(rig.ladder, "pair.rung", whole, strlen(whole)) &&
		   ladder_build(rig.ladder);
	if (!rig.good) {
		rig_say_why(rig.ladder);
		ladder_free(rig.ladder);
		return false;
	}
	rig.memory = calloc(1, image_memory_size(ladder_program(rig.ladder)));
	resource_init(&rig.resource, ladder_program(rig.ladder), rig.memory);
	rig.resource.watch = watch;
	rig.resource.period_ns = RIG_PERIOD;
	resource_start(&rig.resource);
	find_places(plan);
	return true;
}

static bool try_seed(uint64_t seed, bool watch)
{
	static struct set plan;
	bool good;

	state = seed * 77777 + 1;
	make_plan(&plan);
	hurry = 1 + any(4);
	if (!open_plan(&plan, watch))
		return false;
	rig.resource.interrupts = &at_random;
	good = agree(&plan, 30);
	rig_close(&rig);
	return good;
}

static void random_tasks(void)
{
	const char *wanted = getenv("INTERRUPT_COUNT");
	const int count = wanted ? (int)strtol(wanted, NULL, 10) : tap_rounds(1500);
	int wrong = 0;

	for (int seed = 1; seed <= count && wrong < 3; seed++)
		if (!try_seed((uint64_t)seed, seed % 2)) {
			printf("# seed %d:\n%s\n", seed, file);
			wrong++;
		}
	printf("# %d sets of tasks, %llu interruptions, %llu of them of a task that interrupted\n",
	       count, (unsigned long long)interruptions, (unsigned long long)nested);
	CHECK_AS(wrong == 0, "the engine and the model agree after every scan");
	CHECK_AS(interruptions > (uint64_t)count && nested > (uint64_t)count / 10,
		 "there were interruptions, some of them nested");
}

/* ---- the same in virtual time, with a speed ---- */

enum { PERIODS = 60 };
/* Where a period ended in a scan and tasks of higher priority began; a whole scan. */
struct cut { uint64_t scans; uint32_t points; int64_t now; uint8_t in; };
struct whole { int64_t now; uint8_t in; struct seen seen; uint64_t interrupted; };
static struct cut cut[PERIODS];
static struct whole whole_scan[PERIODS];
static int cuts, next_cut, wholes;
static bool inputs_stay = true;
static uint64_t cuts_of_all;

static uint64_t all_interrupted(void)
{
	uint64_t sum = 0;

	for (int t = 0; t < TASKS; t++)
		sum += rig.resource.tasks.state[t].interrupted;
	return sum;
}

/* What a scan that stands will do in a period that begins at @now. */
static void foresee_cut(int64_t now, uint8_t in)
{
	const struct resource *resource = &rig.resource;
	const struct program *program = resource->image.program;
	const struct paced *pace = &resource->pace;

	if (!resource->standing || pace->owed >= pace->speed)
		return;
	now += (int64_t)(pace->owed * (uint64_t)MS / pace->speed);
	if (tasks_may_begin(&resource->tasks, program,
			    tasks_above(program, resource->run[resource->level - 1].task), now))
		cut[cuts++] = (struct cut){ resource->scans, resource->vm.points, now, in };
}

/* Runs in periods of 1 ms, and notes what happened. */
static void run_paced(const struct set *plan, uint64_t speed)
{
	struct resource *resource = &rig.resource;

	cuts = wholes = 0;
	pace_set(resource, speed);
	for (int64_t now = MS; now <= PERIODS * MS && resource->state == STATE_RUN; now += MS) {
		const uint64_t before = resource->scans;
		const uint8_t in = (uint8_t)any(256);

		image_area(&resource->image, AREA_I)[0] = in;
		if (!resource->standing && !resource->pace.owed)
			whole_scan[wholes] = (struct whole){ .now = now, .in = in };
		foresee_cut(now, in);
		pace_scan(resource, now, MS);
		inputs_stay &= image_area(&resource->image, AREA_I)[0] == in;
		if (resource->scans == before || resource->state != STATE_RUN)
			continue;
		whole_scan[wholes].interrupted = all_interrupted();
		whole_scan[wholes++].seen = engine_sees(plan);
	}
}

static bool asks_as_cut(struct resource *resource, int64_t *now_ns)
{
	const struct cut *at = &cut[next_cut];

	if (next_cut == cuts || at->scans != resource->scans || at->points != resource->vm.points)
		return false;
	*now_ns = at->now;
	return true;
}

static bool begin_as_cut(struct resource *resource, int64_t now_ns)
{
	(void)now_ns;
	image_area(&resource->image, AREA_I)[0] = cut[next_cut++].in;
	return true;
}

static const struct interrupts as_cut = { asks_as_cut, begin_as_cut, NULL, NULL };

/* The inputs at the end of a scan are those of its begin for a board; in virtual time they are
 * those that came from outside. */
static bool same_seen(const struct seen *a, struct seen b)
{
	b.i = a->i;
	return memcmp(a, &b, sizeof(b)) == 0;
}

static bool run_cut(const struct set *plan)
{
	struct resource *resource = &rig.resource;

	next_cut = 0;
	resource->interrupts = &as_cut;
	for (int i = 0; i < wholes; i++) {
		image_area(&resource->image, AREA_I)[0] = whole_scan[i].in;
		resource->vm.ask = 1;
		if (!resource_scan(resource, whole_scan[i].now) ||
		    !same_seen(&whole_scan[i].seen, engine_sees(plan)) ||
		    whole_scan[i].interrupted != all_interrupted()) {
			printf("# scan %d differs\n", i + 1);
			return false;
		}
	}
	return true;
}

/* A board that is interrupted where the periods end gets the same values. With and without
 * power flow the periods end at the same points. */
static bool try_speed(uint64_t seed)
{
	static struct set plan;
	static struct cut other[PERIODS];
	uint64_t speed;
	bool good = true;

	state = seed * 99991 + 3;
	make_plan(&plan);
	speed = 10 + any(150);
	for (int watch = 0; watch < 2 && good; watch++) {
		state = seed;
		if (!open_plan(&plan, watch))
			return false;
		memset(cut, 0, sizeof(cut));
		run_paced(&plan, speed);
		rig_close(&rig);
		good = watch == 0 || memcmp(other, cut, sizeof(cut)) == 0;
		memcpy(other, cut, sizeof(cut));
	}
	if (!good || !open_plan(&plan, false))
		return false;
	good = run_cut(&plan);
	cuts_of_all += (uint64_t)cuts;
	rig_close(&rig);
	return good;
}

static void random_speeds(void)
{
	const int count = tap_rounds(600);
	int wrong = 0;

	for (int seed = 1; seed <= count && wrong < 3; seed++)
		if (!try_speed((uint64_t)seed)) {
			printf("# seed %d:\n%s\n", seed, file);
			wrong++;
		}
	printf("# %d sets of tasks, %llu periods that began in a scan\n", count,
	       (unsigned long long)cuts_of_all);
	CHECK_AS(wrong == 0, "virtual time with a speed gives the values of a board");
	CHECK_AS(inputs_stay, "after each period the inputs are those from outside");
	CHECK_AS(cuts_of_all > (uint64_t)count, "tasks interrupted others");
}

/* ---- one interruption at each safe point ---- */

static int64_t asked_ns;
static int asked, begun, ended;
static bool reads, writes;
static uint8_t out_at_end;

static bool asks_always(struct resource *resource, int64_t *now_ns)
{
	(void)resource;
	asked++;
	asked_ns += MS;
	*now_ns = asked_ns;
	return true;
}

static bool begin_always(struct resource *resource, int64_t now_ns)
{
	(void)resource, (void)now_ns;
	begun++;
	return reads;
}

static bool end_always(struct resource *resource, int64_t now_ns)
{
	(void)now_ns;
	ended++;
	out_at_end = image_area(&resource->image, AREA_Q)[0];
	return writes;
}

static const struct interrupts at_each = { asks_always, begin_always, end_always, NULL };

/* Slow loops 20 times; each round begins with a safe point. */
static bool open_pair(const char *fast)
{
	static char text[2048];

	snprintf(text, sizeof(text),
		 "VAR_GLOBAL\n  N, Last, K : INT;\n  Second : DATE_AND_TIME;\n"
		 "  Q0 AT %%QX0.0 : BOOL;\n  Q1 AT %%QX0.1 : BOOL;\nEND_VAR\n"
		 "CONFIGURATION Plant\n  RESOURCE Cpu\n"
		 "    TASK TFast (INTERVAL := T#1ms, PRIORITY := 0);\n"
		 "    TASK TSlow (INTERVAL := T#1s, PRIORITY := 1);\n"
		 "    PROGRAM A WITH TFast : Fast;\n    PROGRAM B WITH TSlow : Slow;\n"
		 "  END_RESOURCE\nEND_CONFIGURATION\n"
		 "PROGRAM Fast IL\n%s\nEND_PROGRAM\n"
		 "PROGRAM Slow IL\n  LD 0\n  ST K\nAgain:\n  LD K\n  ADD 1\n  ST K\n"
		 "  LT 20\n  ST Q1\n  JMPC Again\n  LD SYS_SECOND\n  ST Last\nEND_PROGRAM\n", fast);
	asked = begun = ended = 0;
	reads = writes = true;
	if (!rig_open(&rig, text, false))
		return false;
	rig.resource.interrupts = &at_each;
	/* The first scan is not interrupted. */
	rig.resource.vm.ask = 1;
	CHECK(resource_scan(&rig.resource, MS) && asked == 0);
	return true;
}

static bool scan_pair(int64_t now_ns)
{
	rig.resource.vm.ask = 1;
	asked_ns = now_ns;
	return resource_scan(&rig.resource, now_ns);
}

static void often(void)
{
	if (!open_pair("  LD N\n  ADD 1\n  ST N\n  LD TRUE\n  ST Q0"))
		return;
	CHECK(scan_pair(1001 * MS));
	/* At the start of Slow, before it, and in each round of its loop. */
	CHECK(asked == 22 && begun == 22 && ended == 22);
	CHECK(rig_get(&rig, "N") == 1 + 1 + 22);
	CHECK(rig.resource.tasks.state[1].interrupted == 21);
	CHECK(rig.resource.tasks.state[1].runs == 2);
	/* The outputs of Slow are not seen before it has ended. */
	CHECK((out_at_end & 3) == 1 && rig_get(&rig, "K") == 20);
	rig_close(&rig);
}

/* Each task has a budget of its own, however often it is interrupted: Slow needs less than
 * Fast, which gets hardly more than it needs. */
static void budgets(void)
{
	uint32_t budget = 1000;

	if (!open_pair("  LD 0\n  ST N\nMore:\n  LD N\n  ADD 1\n  ST N\n  LT 1000\n  JMPC More"))
		return;
	do {
		budget += 50;
		((struct code_header *)rig.resource.image.program->header)->budget = budget;
		resource_start(&rig.resource);
		resource_scan(&rig.resource, MS);
	} while (rig.resource.state == STATE_FAULT && budget < 100000);
	CHECK(scan_pair(1001 * MS) && begun == 22 && rig_get(&rig, "N") == 1000);
	CHECK(rig.resource.fault == FAULT_NONE);
	rig_close(&rig);
}

static void faults(void)
{
	if (!open_pair("  LD 0\n  ST N\nMore:\n  LD K\n  GE 3\n  JMPC More"))
		return;
	rig_set(&rig, "K", 0);
	CHECK(!scan_pair(1001 * MS));
	CHECK(rig.resource.state == STATE_FAULT && rig.resource.fault == FAULT_BUDGET);
	CHECK(rig.resource.fault_at.task && strcmp(rig.resource.fault_at.task, "TFast") == 0);
	/* Its own run: then Slow runs no further, and nothing is written. */
	CHECK(rig_get(&rig, "K") == 3 || rig_get(&rig, "K") == 20);
	rig_close(&rig);
}

static void lines(bool reading)
{
	if (!open_pair("  LD N\n  ADD 1\n  ST N"))
		return;
	reads = !reading;
	writes = reading;
	CHECK(!scan_pair(1001 * MS) && rig.resource.fault == FAULT_IO && begun == 1);
	CHECK(rig_get(&rig, "N") == (reading ? 2 : 3));
	rig_close(&rig);
}

/* After STOP the tasks run on, but their outputs are not used. */
static void stops(void)
{
	if (!open_pair("  LD K\n  EQ 5\n  STPC\n  LD N\n  ADD 1\n  ST N"))
		return;
	CHECK(!scan_pair(1001 * MS) && rig.resource.halted && rig.resource.state == STATE_STOP);
	CHECK(begun == 22 && ended < 10 && rig_get(&rig, "K") == 20);
	rig_close(&rig);
}

/* Fast sees the time at which it begins; Slow the time of its own scan. */
static void times(void)
{
	if (!open_pair("  LD SYS_SECOND\n  ST N"))
		return;
	CHECK(scan_pair(59995 * MS));
	CHECK(rig_get(&rig, "N") == 0 && rig_get(&rig, "Last") == 59);
	rig_close(&rig);
}

/* Seven priorities: the fifth task that interrupts is not interrupted. */
static uint32_t deepest;

static bool asks_deeper(struct resource *resource, int64_t *now_ns)
{
	*now_ns = asked_ns += MS;
	if (resource->level > deepest)
		deepest = resource->level;
	return true;
}

static void depth(void)
{
	static const struct interrupts deeper = { asks_deeper, begin_always, end_always, NULL };
	static char text[4096];
	size_t at = 0;

#define PUT(...) at += (size_t)snprintf(text + at, sizeof(text) - at, __VA_ARGS__)
	PUT("VAR_GLOBAL\n  N : DINT;\nEND_VAR\nCONFIGURATION Plant\n  RESOURCE Cpu\n");
	for (int t = 0; t < 7; t++)
		PUT("    TASK T%d (INTERVAL := T#%dms, PRIORITY := %d);\n", t, t < 6 ? 1 : 1000, t);
	for (int t = 0; t < 7; t++)
		PUT("    PROGRAM R%d WITH T%d : P%d;\n", t, t, t);
	PUT("  END_RESOURCE\nEND_CONFIGURATION\n");
	for (int t = 0; t < 7; t++)
		PUT("PROGRAM P%d IL\n  LD N\n  ADD 1\n  ST N\nEND_PROGRAM\n", t);
#undef PUT
	if (!rig_open(&rig, text, false))
		return;
	rig.resource.interrupts = &deeper;
	reads = writes = true;
	CHECK(interrupt_levels(ladder_program(rig.ladder)) == LIMIT_LEVELS);
	CHECK(resource_scan(&rig.resource, MS) && scan_pair(1001 * MS));
	CHECK(deepest == LIMIT_LEVELS - 1 && rig.resource.level == 0);
	rig_close(&rig);
}

int main(void)
{
	often();
	depth();
	budgets();
	faults();
	lines(true);
	lines(false);
	stops();
	times();
	random_tasks();
	random_speeds();
	return tap_done();
}
