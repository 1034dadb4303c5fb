/* SPDX-License-Identifier: MIT
 *
 * machine - see machine.h. The thread fills a list that nobody reads until it has ended.
 */
#include "ladderd/machine.h"

#include "engine/base/ascii.h"
#include "hal/channel.h"
#include "hal/channels.h"
#include "hal/drivers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROWS_MOST 4096

enum looking { LOOK_NEVER, LOOK_RUNS, LOOK_DONE };

struct machine {
	const char *dev, *sys;
	_Atomic int looking;           /* enum looking                         */
	bool thread;                   /* it is to be joined                   */
	pthread_t id;
	struct arena arena;
	struct machine_row **row;
	int count;
};

static struct machine_row *add(struct machine *machine)
{
	struct machine_row *row = machine->count < ROWS_MOST ? arena_alloc(&machine->arena, sizeof(*row)) : NULL;
	struct machine_row **at = row ? arena_push(&machine->arena, &machine->row, &machine->count, sizeof(*at)) : NULL;

	if (!at)
		return NULL;
	memset(row, 0, sizeof(*row));
	*at = row;
	return row;
}

static void keep(char *out, size_t size, const char *text)
{
	const size_t len = utf8_cut(text, size - 1);

	memcpy(out, text, len);
	out[len] = '\0';
}

static void see_line(void *context, const struct line_seen *seen)
{
	struct machine_row *row = add(context);

	if (!row)
		return;
	keep(row->driver, sizeof(row->driver), driver_row(DRIVER_gpio)->word);
	keep(row->device, sizeof(row->device), seen->chip);
	keep(row->label, sizeof(row->label), seen->label);
	keep(row->channel, sizeof(row->channel), seen->name);
	keep(row->about, sizeof(row->about), seen->owner);
	row->offset = seen->offset;
	row->flags = (seen->output ? MACHINE_OUTPUT : 0) | (seen->used ? MACHINE_USED : 0);
}

static void see_device(void *context, const struct device_seen *seen)
{
	struct machine_row *row = add(context);

	if (!row)
		return;
	keep(row->driver, sizeof(row->driver), driver_row(seen->driver)->word);
	keep(row->device, sizeof(row->device), seen->device);
	keep(row->label, sizeof(row->label), seen->label);
	keep(row->channel, sizeof(row->channel), seen->channel);
	keep(row->about, sizeof(row->about), seen->problem);
	keep(row->unit, sizeof(row->unit), io_unit_word(seen->unit));
	row->flags = (seen->output ? MACHINE_OUTPUT : 0) | (seen->has_value ? MACHINE_VALUE : 0);
	row->value = seen->has_value ? seen->value : 0;
}

static void *look(void *context)
{
	struct machine *machine = context;
	struct diag_list *diags = calloc(1, sizeof(*diags));

	if (diags) {
		diag_init(diags);
		hal_list(machine->dev, see_line, machine, diags);
		channels_list(machine->sys, see_device, machine);
	}
	free(diags);
	atomic_store_explicit(&machine->looking, LOOK_DONE, memory_order_release);
	return NULL;
}

static void join(struct machine *machine)
{
	if (machine->thread)
		pthread_join(machine->id, NULL);
	machine->thread = false;
}

/* Without a thread the list stays empty. */
static void begin(struct machine *machine)
{
	join(machine);
	arena_free(&machine->arena);
	arena_init(&machine->arena);
	machine->row = NULL;
	machine->count = 0;
	atomic_store(&machine->looking, LOOK_RUNS);
	machine->thread = pthread_create(&machine->id, NULL, look, machine) == 0;
	if (!machine->thread)
		atomic_store(&machine->looking, LOOK_DONE);
}

static bool is_ready(void *context, bool anew)
{
	struct machine *machine = context;
	const int looking = atomic_load_explicit(&machine->looking, memory_order_acquire);

	if (looking == LOOK_NEVER || (looking == LOOK_DONE && anew))
		begin(machine);
	return looking == LOOK_DONE && !anew;
}

static bool get_row(void *context, uint32_t number, struct machine_row *out)
{
	const struct machine *machine = context;

	if (number >= (uint32_t)machine->count)
		return false;
	*out = *machine->row[number];
	return true;
}

struct machine *machine_new(const char *dev, const char *sys)
{
	struct machine *machine = calloc(1, sizeof(*machine));

	if (!machine)
		return NULL;
	machine->dev = dev;
	machine->sys = sys;
	arena_init(&machine->arena);
	return machine;
}

void machine_free(struct machine *machine)
{
	if (!machine)
		return;
	join(machine);
	arena_free(&machine->arena);
	free(machine);
}

struct server_machine machine_io(struct machine *machine)
{
	return (struct server_machine){ .context = machine, .look = is_ready, .row = get_row };
}
