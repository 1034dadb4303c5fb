/* SPDX-License-Identifier: MIT
 *
 * board_devices - see board_devices.h.
 */
#include "editor-gtk/online/board_devices.h"

#include "editor-gtk/kit/i18n.h"

#include "online/machine.h"

#include <string.h>

#define AGAIN_MS 200
#define AGAIN_MOST 300 /* times                                             */

struct asking {
	LadderBoardLink *link;
	GWeakRef owner;
	board_devices_came came;
	struct board_devices *devices;
	guint32 next;
	int again;
};

void board_devices_free(struct board_devices *devices)
{
	if (!devices)
		return;
	io_machine_free(&devices->machine);
	io_devices_free(&devices->devices);
	g_free(devices);
}

static void asking_free(struct asking *asking)
{
	board_devices_free(asking->devices);
	g_weak_ref_clear(&asking->owner);
	g_object_unref(asking->link);
	g_free(asking);
}

/* What a board says may be no UTF-8. */
static const char *keep(struct arena *arena, const char *text)
{
	char *valid = g_utf8_make_valid(text, -1);
	const char *kept = arena_copy(arena, valid, strlen(valid));

	g_free(valid);
	return kept ? kept : "";
}

static void add_line(struct io_machine *machine, const struct machine_row *row)
{
	struct io_found *line = arena_push(&machine->arena, &machine->line, &machine->count, sizeof(*line));

	if (!line)
		return;
	*line = (struct io_found){
		.chip = keep(&machine->arena, row->device), .label = keep(&machine->arena, row->label),
		.name = keep(&machine->arena, row->channel), .owner = keep(&machine->arena, row->about),
		.offset = row->offset, .used = row->flags & MACHINE_USED, .output = row->flags & MACHINE_OUTPUT,
	};
}

static void add_device(struct io_devices *devices, const struct machine_row *row)
{
	struct io_device *device = arena_push(&devices->arena, &devices->device, &devices->count, sizeof(*device));
	char value[48] = "", about[256];

	if (!device)
		return;
	if (row->flags & MACHINE_VALUE)
		g_snprintf(value, sizeof(value), "%.6g %s", row->value, row->unit);
	g_snprintf(about, sizeof(about), "%s%s%s", row->label,
		   *row->label && (*value || *row->about) ? ": " : "", *value ? value : row->about);
	*device = (struct io_device){
		.driver = keep(&devices->arena, row->driver), .device = keep(&devices->arena, row->device),
		.channel = keep(&devices->arena, row->channel), .about = keep(&devices->arena, about),
		.output = row->flags & MACHINE_OUTPUT,
	};
}

static void send(struct asking *asking, bool anew);

static gboolean send_again(gpointer data)
{
	send(data, false);
	return G_SOURCE_REMOVE;
}

static bool take(struct asking *asking, struct wire_reader *in)
{
	struct machine_row row;
	guint16 count;

	asking->next = wire_u32(in);
	count = wire_u16(in);
	for (guint16 i = 0; i < count && !in->failed; i++) {
		machine_take(in, &row);
		if (in->failed)
			break;
		if (strcmp(row.driver, "gpio") == 0)
			add_line(&asking->devices->machine, &row);
		else
			add_device(&asking->devices->devices, &row);
	}
	return !in->failed;
}

/* @looks: its answer was that it has none yet. */
static const char *why_not(const struct board_answer *answer, bool looks)
{
	return answer->end == DESK_GONE ? "" : *answer->text ? answer->text :
	       looks ? _("it is still looking") : _("its answer makes no sense");
}

static void answered(gpointer data, struct board_answer *answer)
{
	struct asking *asking = data;
	const guint32 before = asking->next;
	GObject *owner = g_weak_ref_get(&asking->owner);
	bool ready = false, good = owner && answer->end == DESK_GOOD;

	if (good) {
		ready = wire_u8(&answer->body) != 0;
		good = take(asking, &answer->body) && (!asking->next || asking->next > before);
	}
	if (good && !ready && ++asking->again < AGAIN_MOST) {
		g_timeout_add(AGAIN_MS, send_again, asking);
	} else if (good && ready && asking->next) {
		send(asking, false);
	} else {
		if (owner)
			asking->came(owner, good && ready ? g_steal_pointer(&asking->devices) : NULL, why_not(answer, good && !ready));
		asking_free(asking);
	}
	g_clear_object(&owner);
}

static void send(struct asking *asking, bool anew)
{
	struct wire_writer fields = ladder_board_link_begin(asking->link);

	wire_put_u8(&fields, anew);
	wire_put_u32(&fields, asking->next);
	ladder_board_link_send(asking->link, SERVICE_DEVICES, &fields, NULL, answered, asking);
}

void board_devices_ask(LadderBoardLink *link, GObject *owner, board_devices_came came)
{
	struct asking *asking = g_new0(struct asking, 1);

	asking->link = g_object_ref(link);
	g_weak_ref_init(&asking->owner, owner);
	asking->came = came;
	asking->devices = g_new0(struct board_devices, 1);
	arena_init(&asking->devices->machine.arena);
	diag_init(&asking->devices->machine.diags);
	asking->devices->machine.elsewhere = true;
	arena_init(&asking->devices->devices.arena);
	send(asking, true);
}
