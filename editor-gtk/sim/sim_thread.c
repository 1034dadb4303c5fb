/* SPDX-License-Identifier: MIT
 *
 * sim_thread - scans when a scan is due, does orders between scans, and records.
 *
 * Orders come through a queue. Its state goes out as a copy, at most once a frame; a copy is
 * skipped while the window reads the one before. It sleeps in the queue: a pause costs nothing.
 */
#include "editor-gtk/sim/sim_thread.h"

#include "hal/said.h"

#include <string.h>
#include <time.h>

#define COST_NS 100.0 /* unit of struct sim_thread's cost                      */
#define NS_PER_S G_GINT64_CONSTANT(1000000000)
#define FRAME_US G_GINT64_CONSTANT(16000)
#define BEHIND_US G_GINT64_CONSTANT(250000) /* a longer delay is not caught up      */

enum order_kind { ORDER_RUN, ORDER_SCAN, ORDER_SPEED, ORDER_FAULT_ON_ERROR, ORDER_ACT,
		  ORDER_CHANGE, ORDER_PLAY, ORDER_STOPS, ORDER_STEP, ORDER_END };
struct order {
	enum order_kind kind;
	int scans;               /* ORDER_RUN, ORDER_FAULT_ON_ERROR: 0 or 1    */
	double speed;
	struct act act;
	char *text;              /* of the act's STRING                        */
	struct sim_program *program;
	GArray *acts;            /* of struct sim_played                       */
	guint64 until;           /* scan                                       */
	struct sim_stops *stops;
	enum stops_step step;
};

struct sim_thread {
	struct sim_source source;
	GThread *thread;
	GAsyncQueue *orders;
	GSourceFunc notify;
	gpointer data;
	/* Of the thread alone: */
	struct twin twin;
	bool run;
	bool fault_on_error;
	bool fault;              /* an operation failed                        */
	struct stops *stops;     /* of the program that runs                   */
	struct sim_stops *list;  /* the breakpoints in it; NULL: none          */
	enum stops_step step;    /* how it goes on                             */
	bool passes;             /* breakpoints: scans are repeated            */
	bool failed;             /* an operation had failed before this scan   */
	bool touched;            /* values were set in the middle of this scan */
	guint8 *outside;         /* the areas before this scan                 */
	double speed;
	double due_us;           /* when the next scan is due                  */
	gint64 told_us;          /* when the last copy went out                */
	struct sim_refusal refusal;
	struct sim_events events;
	bool changed;            /* since told_us                              */
	/* Under `record_lock`: */
	GMutex record_lock;
	struct sim_eras *eras;
	/* Under `out_lock`: */
	GMutex out_lock;
	struct twin out;
	struct sim_program *program, *plant;
	bool out_run, out_fault;
	struct stops_frame out_frame[LIMIT_CALLS + 1];
	int out_frames;
	guint8 *out_outside;
	struct sim_refusal out_refusal;
	struct sim_events out_events;
	/* Atomic: */
	int notified;
	struct sim_lateness late; /* counted atomically, by late_step()        */
	struct sim_lateness cost; /* the same, in COST_NS                       */
};

static gsize areas_size(const struct sim_thread *thread)
{
	return thread->twin.resource.image.program->areas.size;
}

/* ---- out ---- */

static void publish(struct sim_thread *thread, bool must)
{
	if (must)
		g_mutex_lock(&thread->out_lock);
	else if (!g_mutex_trylock(&thread->out_lock))
		return;
	twin_copy(&thread->out, &thread->twin);
	stops_show(thread->stops, &thread->twin, &thread->out);
	thread->out_frames = stops_stack(thread->stops, &thread->twin, thread->out_frame);
	if (thread->out_frames)
		memcpy(thread->out_outside, thread->outside, areas_size(thread));
	/* Only the copy: the record, and so a scenario, has the outputs of the scan. */
	if (thread->fault || thread->twin.resource.halted)
		twin_outputs_safe(&thread->out);
	thread->out_run = thread->run;
	thread->out_fault = thread->fault;
	thread->out_refusal = thread->refusal;
	thread->out_events = thread->events;
	g_mutex_unlock(&thread->out_lock);
	thread->changed = false;
	thread->told_us = g_get_monotonic_time();
	if (g_atomic_int_compare_and_exchange(&thread->notified, 0, 1))
		g_idle_add_full(G_PRIORITY_DEFAULT, thread->notify, thread->data, NULL);
}

/* ---- scans ---- */

static bool stands(const struct sim_thread *thread)
{
	return thread->twin.resource.stopped;
}

/* May it stand in this scan? */
static bool may_stand(const struct sim_thread *thread)
{
	return !thread->passes && (thread->step != STOPS_GO || (thread->list && thread->list->stop->len));
}

static bool walk(struct sim_thread *thread)
{
	if (!stands(thread))
		memcpy(thread->outside, thread->twin.resource.image.memory, areas_size(thread));
	return stops_scan(thread->stops, &thread->twin, thread->step);
}

static void record_scan_of(struct sim_thread *thread)
{
	g_mutex_lock(&thread->record_lock);
	if (!thread->touched)
		sim_eras_scan(thread->eras, &thread->twin);
	else if (!sim_eras_break(thread->eras, &thread->twin))
		g_error("out of memory");
	g_mutex_unlock(&thread->record_lock);
	thread->touched = false;
}

/* A scan, or a part of one: it may stand afterwards. */
static void scan(struct sim_thread *thread)
{
	const struct vm *vm = &thread->twin.resource.vm;
	const bool stood = stands(thread);
	const uint64_t before = thread->twin.scan - stood;
	bool goes_on;

	if (!stood)
		thread->failed = vm->errors != 0;
	goes_on = stood || may_stand(thread) ? walk(thread) : twin_scan(&thread->twin);
	if (stands(thread)) {
		thread->run = false;
		thread->step = STOPS_GO;
		thread->changed = true;
		return;
	}
	if (!goes_on)
		thread->run = false; /* FAULT, or the program asked for STOP */
	if (thread->twin.scan == before)
		return;
	thread->fault = false;
	thread->events.ends += !goes_on;
	if (!thread->failed && vm->errors) {
		thread->events.failures++;
		thread->events.faulted = false;
	}
	record_scan_of(thread);
	thread->changed = true;
}

/* The next order needs a whole scan. */
static void leave_scan(struct sim_thread *thread)
{
	if (!stands(thread))
		return;
	thread->step = STOPS_LEAVE;
	scan(thread);
	thread->step = STOPS_GO;
}

static double wall_period_us(const struct sim_thread *thread)
{
	return thread->speed > 0 ? 1e6 / thread->speed :
				   (double)thread->twin.period_ns / 1e3;
}

/* us until the next scan is due; 0: now. */
static guint64 wait_us(struct sim_thread *thread)
{
	const double wait = thread->due_us - (double)g_get_monotonic_time();

	if (wait >= 0)
		return (guint64)wait;
	if (wait < -(double)BEHIND_US)
		thread->due_us = (double)g_get_monotonic_time();
	return 0;
}

/* Steps of 1/16 of the next lower power of two, so 6 % from step to step. */
static guint late_step(double us)
{
	const guint64 late = us > 0 ? (guint64)us : 0;
	const guint power = late < 16 ? 0 : g_bit_storage(late) - 5;

	return MIN(power * 16 + (guint)(late >> power), SIM_LATE_STEPS - 1);
}

static double late_us(guint step)
{
	return step < 32 ? step : (double)((guint64)(step % 16 + 16) << (step / 16 - 1));
}

/* The first failed operation of a start is a FAULT: time stands still, so that a person sees
 * where it was. The window gets safe outputs; the twin keeps those of a board and continues
 * with them. */
static void scan_or_fault(struct sim_thread *thread)
{
	const guint failures = thread->events.failures;

	scan(thread);
	if (!thread->fault_on_error || thread->events.failures == failures)
		return;
	thread->run = false;
	thread->fault = thread->events.faulted = true;
}

static gint64 now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (gint64)now.tv_sec * NS_PER_S + now.tv_nsec;
}

static void scan_in_time(struct sim_thread *thread)
{
	const gint64 began_ns = now_ns();

	g_atomic_int_inc((gint *)&thread->late.count[late_step(
		(double)began_ns / 1000 - thread->due_us)]);
	scan_or_fault(thread);
	g_atomic_int_inc((gint *)&thread->cost.count[late_step(
		(double)(now_ns() - began_ns) / COST_NS)]);
	thread->due_us += wall_period_us(thread);
	if (g_get_monotonic_time() - thread->told_us >= FRAME_US)
		publish(thread, false);
}

/* Counts of another program or period mean nothing. */
static void forget_cost(struct sim_thread *thread)
{
	for (guint i = 0; i < SIM_LATE_STEPS; i++)
		g_atomic_int_set((gint *)&thread->cost.count[i], 0);
}

/* ---- orders ---- */

static void start_clock(struct sim_thread *thread)
{
	thread->due_us = (double)g_get_monotonic_time() + wall_period_us(thread);
}

static void refuse(struct sim_thread *thread, enum sim_refused why)
{
	thread->refusal.why = why;
	thread->refusal.count++;
}

static bool is_value(const struct act *act)
{
	return act->kind == ACT_SET || act->kind == ACT_FORCE || act->kind == ACT_RELEASE ||
	       act->kind == ACT_RELEASE_ALL;
}

static void act(struct sim_thread *thread, const struct act *act)
{
	if (!is_value(act))
		leave_scan(thread);
	if (!stops_act(thread->stops, &thread->twin, act)) {
		refuse(thread, SIM_REFUSED_PLACE);
		return;
	}
	if (stands(thread)) {
		thread->touched = true;
		return;
	}
	if (act->kind == ACT_START || act->kind == ACT_WARM || act->kind == ACT_STOP)
		thread->fault = false;
	if (act->kind == ACT_PERIOD)
		forget_cost(thread);
	g_mutex_lock(&thread->record_lock);
	sim_eras_act(thread->eras, &thread->twin, act);
	g_mutex_unlock(&thread->record_lock);
}

/* In the program that runs, a place of another program is another variable. */
static void act_of(struct sim_thread *thread, const struct order *order)
{
	if (!order->program || order->program == thread->program ||
	    order->program == thread->plant)
		act(thread, &order->act);
	else
		refuse(thread, SIM_REFUSED_STALE);
}

/* Of the program that runs from now on. */
static void begin_stops(struct sim_thread *thread)
{
	stops_free(thread->stops);
	g_clear_pointer(&thread->list, sim_stops_free);
	thread->stops = stops_new(thread->program->program);
	if (!thread->stops)
		g_error("out of memory");
	thread->step = STOPS_GO;
	thread->out_frames = 0;
	thread->outside = g_realloc(thread->outside, areas_size(thread));
	thread->out_outside = g_realloc(thread->out_outside, areas_size(thread));
}

static void take_stops(struct sim_thread *thread, struct sim_stops *list)
{
	if (list->program != thread->program) {
		sim_stops_free(list);
		return;
	}
	sim_stops_give(list, thread->stops);
	sim_stops_free(thread->list);
	thread->list = list;
}

/* Replaces the twin by @next, and frees the one before. */
static void replace_twin(struct sim_thread *thread, const struct twin *next,
		       struct sim_program *program)
{
	g_mutex_lock(&thread->record_lock);
	g_mutex_lock(&thread->out_lock);
	twin_free(&thread->out);
	twin_free(&thread->twin);
	thread->twin = *next;
	if (!twin_clone(&thread->out, next) ||
	    !sim_eras_change(thread->eras, next, program))
		g_error("out of memory");
	sim_program_unref(thread->program);
	thread->program = program;
	begin_stops(thread);
	g_mutex_unlock(&thread->out_lock);
	g_mutex_unlock(&thread->record_lock);
}

static void change(struct sim_thread *thread, struct sim_program *program)
{
	struct twin next;

	leave_scan(thread);
	if (twin_init(&next, program->program, thread->plant ?
		      thread->plant->program : NULL, thread->twin.period_ns) &&
	    twin_change(&next, &thread->twin)) {
		twin_set_safe(&next, program->safe);
		replace_twin(thread, &next, program);
		forget_cost(thread);
		return;
	}
	twin_free(&next);
	sim_program_unref(program);
}

static void scan_some(struct sim_thread *thread, int scans)
{
	thread->run = false;
	thread->step = STOPS_GO;
	while (scans-- > 0) {
		scan(thread);
		if (stands(thread))
			break;
	}
}

/* The first part is done at once. */
static void step(struct sim_thread *thread, enum stops_step step)
{
	thread->step = step;
	thread->run = thread->twin.resource.state == STATE_RUN;
	start_clock(thread);
	if (thread->run)
		scan_or_fault(thread);
}

/* Another order ends it. */
static void play(struct sim_thread *thread, GArray *acts, guint64 until)
{
	const struct act start = { .kind = ACT_START };
	guint next = 0;

	thread->run = false;
	thread->passes = true;
	act(thread, &start);
	while (thread->twin.scan < until && g_async_queue_length(thread->orders) <= 0 &&
	       thread->twin.resource.state == STATE_RUN) {
		for (; next < acts->len; next++) {
			struct sim_played *played = &g_array_index(acts, struct sim_played,
								   next);
			struct act again = played->act;

			if (played->after > thread->twin.scan)
				break;
			if (again.at.type == IEC_STRING)
				again.value.s = (const struct iec_string *)&played->text;
			act(thread, &again);
		}
		scan(thread);
	}
	thread->passes = false;
}

/* False: the thread is to end. */
static bool obey(struct sim_thread *thread, struct order *order)
{
	switch (order->kind) {
	case ORDER_RUN:
		thread->run = order->scans != 0;
		thread->step = STOPS_GO;
		start_clock(thread);
		break;
	case ORDER_STOPS: take_stops(thread, g_steal_pointer(&order->stops)); break;
	case ORDER_STEP: step(thread, order->step); break;
	case ORDER_SCAN: scan_some(thread, order->scans); break;
	case ORDER_SPEED:
		thread->speed = order->speed;
		start_clock(thread);
		break;
	case ORDER_FAULT_ON_ERROR: thread->fault_on_error = order->scans != 0; break;
	case ORDER_ACT: act_of(thread, order); break;
	case ORDER_CHANGE: change(thread, g_steal_pointer(&order->program)); break;
	case ORDER_PLAY: play(thread, order->acts, order->until); break;
	case ORDER_END: return false;
	}
	thread->changed = true;
	return true;
}

static struct order *next_order(struct sim_thread *thread)
{
	guint64 wait;

	if (!thread->run)
		return g_async_queue_pop(thread->orders);
	wait = wait_us(thread);
	return wait ? g_async_queue_timeout_pop(thread->orders, wait) :
		      g_async_queue_try_pop(thread->orders);
}

static void order_free(struct order *order)
{
	g_clear_pointer(&order->acts, g_array_unref);
	g_clear_pointer(&order->program, sim_program_unref);
	g_clear_pointer(&order->stops, sim_stops_free);
	g_free(order->text);
	g_free(order);
}

static gpointer main_of(gpointer data)
{
	struct sim_thread *thread = data;
	bool go_on = true;

	while (go_on) {
		struct order *order = next_order(thread);

		if (order)
			go_on = obey(thread, order);
		else if (thread->run)
			scan_in_time(thread);
		/* While it runs, scan_in_time() publishes. */
		if (thread->changed && (order || !thread->run) &&
		    g_async_queue_length(thread->orders) <= 0)
			publish(thread, true);
		if (order)
			order_free(order);
	}
	return NULL;
}

static void tell(struct sim_thread *thread, const struct order *order)
{
	g_async_queue_push(thread->orders, g_memdup2(order, sizeof(*order)));
}

/* ---- as a source ---- */

static struct sim_thread *thread_of(struct sim_source *source)
{
	return (struct sim_thread *)source;
}

static void free_source(struct sim_source *source)
{
	sim_thread_free(thread_of(source));
}

/* No scan runs while an order waits. */
static void order_act(struct sim_source *source, struct sim_program *of, const struct act *acts,
		      int count)
{
	GAsyncQueue *orders = thread_of(source)->orders;

	g_async_queue_lock(orders);
	for (int i = 0; i < count; i++) {
		const struct act *act = &acts[i];
		struct order order = { .kind = ORDER_ACT, .act = *act,
				       .program = sim_program_ref(of) };

		if (act->kind == ACT_SET && act->at.type == IEC_STRING) {
			order.text = g_memdup2(act->value.s,
					       sizeof(*act->value.s) + act->value.s->length);
			order.act.value.s = (const struct iec_string *)(gpointer)order.text;
		}
		g_async_queue_push_unlocked(orders, g_memdup2(&order, sizeof(order)));
	}
	g_async_queue_unlock(orders);
}

static bool take(struct sim_source *source, struct sim_view *view, bool *other)
{
	struct sim_thread *thread = thread_of(source);

	g_atomic_int_set(&thread->notified, 0);
	g_mutex_lock(&thread->out_lock);
	*other = view->program != thread->program;
	if (*other) {
		sim_view_clear(view);
		view->program = sim_program_ref(thread->program);
		view->plant = sim_program_ref(thread->plant);
		if (!twin_clone(&view->twin, &thread->out))
			g_error("out of memory");
	} else {
		twin_copy(&view->twin, &thread->out);
	}
	view->frames = thread->out_frames;
	memcpy(view->frame, thread->out_frame, sizeof(view->frame));
	g_clear_pointer(&view->outside, g_free);
	if (view->frames)
		view->outside = g_memdup2(thread->out_outside, thread->program->program->areas.size);
	view->running = thread->out_run;
	view->fault = thread->out_fault;
	view->refusal = thread->out_refusal;
	view->events = thread->out_events;
	g_mutex_unlock(&thread->out_lock);
	return true;
}

static const char *why_not(struct sim_source *source, enum sim_wish wish)
{
	(void)source;
	(void)wish;
	return NULL;
}

static const struct sim_eras *lock(struct sim_source *source)
{
	g_mutex_lock(&thread_of(source)->record_lock);
	return thread_of(source)->eras;
}

static void unlock(struct sim_source *source)
{
	g_mutex_unlock(&thread_of(source)->record_lock);
}

static bool replay(struct sim_source *source, struct sim_replay *replay, guint64 scan)
{
	const bool good = sim_eras_replay(lock(source), replay, scan);

	unlock(source);
	return good;
}

static void span(struct sim_source *source, guint64 *first, guint64 *last)
{
	const struct sim_eras *eras = lock(source);

	*first = sim_eras_first(eras);
	*last = record_last(sim_eras_newest(eras)->record);
	unlock(source);
}

G_STATIC_ASSERT((int)QUALITY_STALE == (int)SIM_STALE && (int)QUALITY_FAULT == (int)SIM_VALUE_FAULT);

/* There is no device: the inputs that tell quality say what a person or a plant has set. */
static enum sim_quality quality(struct sim_source *source, const struct sim_view *view,
				const struct sim_replay *replay, struct location at)
{
	const struct sim_program *program = replay ? replay->program : view->program;
	const struct twin *twin = replay ? &replay->replay.twin : &view->twin;
	const enum hal_quality said = program ? io_said_quality(program->said, program->said_count, &twin->resource.image, at) :
						QUALITY_GOOD;

	(void)source;
	return said == QUALITY_FORCED ? SIM_GOOD : (enum sim_quality)said; /* a value that is forced has a mark of its own */
}

static bool knows(struct sim_source *source, struct location at)
{
	(void)source;
	(void)at;
	return true;
}

static bool has_power(struct sim_source *source, const char *unit)
{
	(void)source;
	(void)unit;
	return true;
}

static void past(struct sim_source *source)
{
	(void)source;
}

static const struct sim_source as_source = {
	.free = free_source, .take = take, .act = order_act, .why_not = why_not,
	.replay = replay, .span = span, .lock = lock, .unlock = unlock, .knows = knows, .quality = quality,
	.has_power = has_power, .past = past,
};

struct sim_source *sim_thread_source(struct sim_thread *thread)
{
	return &thread->source;
}

/* ---- called by the window ---- */

static bool start_twin(struct twin *twin, const struct sim_program *program,
		       const struct sim_program *plant, int64_t period_ns, guint64 speed)
{
	const struct act of_board = { .kind = ACT_SPEED, .value.i = (int64_t)speed };

	if (!twin_init(twin, program->program, plant ? plant->program : NULL, period_ns))
		return false;
	twin_set_safe(twin, program->safe);
	twin_act(twin, &of_board);
	return true;
}

struct sim_thread *sim_thread_new(struct sim_program *program, struct sim_program *plant,
				  gint64 period_ns, guint64 speed, GSourceFunc notify,
				  gpointer data)
{
	struct sim_thread *thread = g_new0(struct sim_thread, 1);

	if (!start_twin(&thread->twin, program, plant, period_ns, speed) ||
	    !twin_clone(&thread->out, &thread->twin)) {
		twin_free(&thread->twin);
		g_free(thread);
		return NULL;
	}
	thread->source = as_source;
	thread->notify = notify;
	thread->data = data;
	thread->program = sim_program_ref(program);
	thread->plant = sim_program_ref(plant);
	thread->eras = sim_eras_new(&thread->twin, program, plant);
	if (!thread->eras)
		g_error("out of memory");
	begin_stops(thread);
	g_mutex_init(&thread->record_lock);
	g_mutex_init(&thread->out_lock);
	thread->orders = g_async_queue_new_full((GDestroyNotify)order_free);
	thread->thread = g_thread_new("scan", main_of, thread);
	return thread;
}

void sim_thread_free(struct sim_thread *thread)
{
	if (!thread)
		return;
	tell(thread, &(struct order){ .kind = ORDER_END });
	g_thread_join(thread->thread);
	while (g_idle_remove_by_data(thread->data))
		;
	g_async_queue_unref(thread->orders);
	sim_eras_free(thread->eras);
	stops_free(thread->stops);
	sim_stops_free(thread->list);
	g_free(thread->outside);
	g_free(thread->out_outside);
	twin_free(&thread->twin);
	twin_free(&thread->out);
	sim_program_unref(thread->program);
	sim_program_unref(thread->plant);
	g_mutex_clear(&thread->record_lock);
	g_mutex_clear(&thread->out_lock);
	g_free(thread);
}

void sim_thread_run(struct sim_thread *thread, bool run)
{
	tell(thread, &(struct order){ .kind = ORDER_RUN, .scans = run });
}

void sim_thread_scan(struct sim_thread *thread, int scans)
{
	tell(thread, &(struct order){ .kind = ORDER_SCAN, .scans = scans });
}

void sim_thread_speed(struct sim_thread *thread, double scans)
{
	tell(thread, &(struct order){ .kind = ORDER_SPEED, .speed = scans });
}

void sim_thread_fault_on_error(struct sim_thread *thread, bool fault)
{
	tell(thread, &(struct order){ .kind = ORDER_FAULT_ON_ERROR, .scans = fault });
}

void sim_thread_play(struct sim_thread *thread, GArray *acts, guint64 scans)
{
	tell(thread, &(struct order){ .kind = ORDER_PLAY, .acts = g_array_ref(acts),
				      .until = scans });
}

void sim_thread_stops(struct sim_thread *thread, struct sim_stops *stops)
{
	tell(thread, &(struct order){ .kind = ORDER_STOPS, .stops = stops });
}

void sim_thread_step(struct sim_thread *thread, enum stops_step step)
{
	tell(thread, &(struct order){ .kind = ORDER_STEP, .step = step });
}

/* With one processor the window would else draw a frame first. */
void sim_thread_change(struct sim_thread *thread, struct sim_program *program)
{
	tell(thread, &(struct order){ .kind = ORDER_CHANGE,
				      .program = sim_program_ref(program) });
	g_thread_yield();
}

/* ---- lateness ---- */

static void copy_counts(struct sim_lateness *from, struct sim_lateness *out)
{
	for (guint i = 0; i < SIM_LATE_STEPS; i++)
		out->count[i] = (guint)g_atomic_int_get((gint *)&from->count[i]);
}

void sim_thread_lateness(struct sim_thread *thread, struct sim_lateness *out)
{
	copy_counts(&thread->late, out);
}

void sim_thread_cost(struct sim_thread *thread, struct sim_cost *out)
{
	struct sim_lateness cost;

	copy_counts(&thread->cost, &cost);
	out->scans = sim_lateness_scans(&cost);
	out->usual_ns = (gint64)(sim_lateness_us(&cost, 0.5) * COST_NS);
	out->most_ns = (gint64)(sim_lateness_us(&cost, 1) * COST_NS);
}

guint64 sim_lateness_scans(const struct sim_lateness *late)
{
	guint64 scans = 0;

	for (guint i = 0; i < SIM_LATE_STEPS; i++)
		scans += late->count[i];
	return scans;
}

double sim_lateness_us(const struct sim_lateness *late, double part)
{
	const double wanted = part * (double)sim_lateness_scans(late);
	guint64 seen = 0;

	for (guint i = 0; i < SIM_LATE_STEPS; i++) {
		seen += late->count[i];
		if (late->count[i] && (double)seen >= wanted)
			return late_us(i);
	}
	return 0;
}
