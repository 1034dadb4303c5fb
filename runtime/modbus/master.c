/* SPDX-License-Identifier: MIT
 *
 * master - starts and ends the threads of the buses.
 */
#include "modbus/master.h"

#include <stdlib.h>
#include <time.h>

static bool has_work(const struct master *master)
{
	return atomic_load(&master->stop) || atomic_load(&master->bus.changed);
}

static void wait_until(struct master *master, int64_t until_ns)
{
	const struct timespec time = { .tv_sec = until_ns / 1000000000, .tv_nsec = until_ns % 1000000000 };
	int late = 0;

	pthread_mutex_lock(&master->bus.field->lock);
	while (!late && !has_work(master)) {
		if (until_ns == INT64_MAX)
			pthread_cond_wait(&master->wake, &master->bus.field->lock);
		else
			late = pthread_cond_timedwait(&master->wake, &master->bus.field->lock, &time);
	}
	pthread_mutex_unlock(&master->bus.field->lock);
}

static void *run(void *context)
{
	struct master *master = context;

	while (!atomic_load(&master->stop)) {
		const int64_t next_ns = bus_step(&master->bus);

		if (next_ns > line_now())
			wait_until(master, next_ns);
	}
	return NULL;
}

static bool start(struct master *master, const struct iomap *map, int number, struct field *field)
{
	pthread_condattr_t clock;

	if (!line_init(&master->line, &map->net->bus[number]) ||
	    !bus_open(&master->bus, map, number, field, line_wire(&master->line)))
		return false;
	pthread_condattr_init(&clock);
	pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
	pthread_cond_init(&master->wake, &clock);
	pthread_condattr_destroy(&clock);
	master->runs = pthread_create(&master->thread, NULL, run, master) == 0;
	return master->runs;
}

bool masters_start(struct masters *masters, const struct iomap *map, struct field *field)
{
	const int count = map->net ? map->net->bus_count : 0;

	masters->count = count;
	masters->of = calloc((size_t)count + 1, sizeof(struct master *));
	if (!masters->of)
		return false;
	for (int i = 0; i < count; i++) {
		if (map->net->bus[i].kind == BUS_PEER)
			continue;
		masters->of[i] = calloc(1, sizeof(struct master));
		if (!masters->of[i] || !start(masters->of[i], map, i, field))
			return false;
	}
	return true;
}

static void signal_master(struct master *master)
{
	pthread_mutex_lock(&master->bus.field->lock);
	pthread_cond_signal(&master->wake);
	pthread_mutex_unlock(&master->bus.field->lock);
}

void masters_stop(struct masters *masters)
{
	for (int i = 0; masters->of && i < masters->count; i++) {
		if (!masters->of[i] || !masters->of[i]->runs)
			continue;
		atomic_store(&masters->of[i]->stop, true);
		signal_master(masters->of[i]);
	}
	for (int i = 0; masters->of && i < masters->count; i++) {
		struct master *master = masters->of[i];

		if (!master)
			continue;
		if (master->runs)
			pthread_join(master->thread, NULL);
		bus_close(&master->bus);
		line_close(&master->line);
		free(master);
	}
	free(masters->of);
	*masters = (struct masters){ .count = 0 };
}

void masters_output(struct masters *masters, int point, union iec_value value)
{
	for (int i = 0; masters->of && i < masters->count; i++) {
		struct master *master = masters->of[i];

		if (!master || !master->runs || master->bus.map->point[point].channel->bus != i)
			continue;
		field_output(master->bus.field, point, value);
		bus_changed(&master->bus);
		signal_master(master);
	}
}

void masters_ask(struct masters *masters, const struct iomap *map, int ask, uint32_t number)
{
	const int bus = map->net->ask[ask].bus;
	struct master *master = masters->of && bus < masters->count ? masters->of[bus] : NULL;

	if (!master || !master->runs)
		return;
	bus_ask_for(&master->bus, ask, number);
	signal_master(master);
}
