/* SPDX-License-Identifier: MIT
 *
 * outbox - periods that are over are left out, never caught up.
 */
#include "peer/outbox.h"

#include "hal/iomap_net.h"

#include "engine/base/name.h"

#include <string.h>

static int counting_line(const struct outbox *outbox, int number)
{
	const struct io_publish *own = outbox->line[number].publish;
	int i = 0;

	while (i < number && (outbox->line[i].publish->bus != own->bus ||
			      !name_equal(outbox->line[i].publish->as, own->as)))
		i++;
	return i;
}

bool outbox_open(struct outbox *outbox, const struct iomap *map, uint64_t run, struct arena *arena)
{
	const struct io_net *net = map->net;
	size_t values = 1;

	*outbox = (struct outbox){ .run = run };
	if (!net)
		return true;
	for (int i = 0; i < net->publish_count; i++)
		values += (size_t)net->publish[i].count;
	outbox->line = arena_alloc(arena, ((size_t)net->publish_count + 1) * sizeof(*outbox->line));
	outbox->value = arena_alloc(arena, values * sizeof(*outbox->value));
	if (!outbox->line || !outbox->value)
		return false;
	for (int i = 0; i < net->publish_count; i++) {
		outbox->line[i] = (struct outbox_line){ .publish = &net->publish[i], .first = outbox->value_count };
		outbox->line_count++;
		outbox->line[i].counts = counting_line(outbox, i);
		for (int k = 0; k < net->publish[i].count; k++)
			outbox->value[outbox->value_count++] = (struct outbox_value){ .name = net->publish[i].name[k] };
	}
	return true;
}

int64_t outbox_due(const struct outbox *outbox)
{
	int64_t due_ns = INT64_MAX;

	for (int i = 0; i < outbox->line_count; i++)
		if (outbox->line[i].due_ns < due_ns)
			due_ns = outbox->line[i].due_ns;
	return due_ns;
}

struct outbox_line *outbox_line_due(struct outbox *outbox, int64_t now_ns)
{
	for (int i = 0; i < outbox->line_count; i++) {
		struct outbox_line *line = &outbox->line[i];
		const int64_t every_ns = line->publish->every_ns > 0 ? line->publish->every_ns : 1;

		if (line->due_ns > now_ns)
			continue;
		line->due_ns = line->due_ns ? line->due_ns + ((now_ns - line->due_ns) / every_ns + 1) * every_ns :
					      now_ns + every_ns;
		line->next = 0;
		return line;
	}
	return NULL;
}

static struct peer_value value_of(const struct outbox_value *value)
{
	return (struct peer_value){
		.name = value->name, .name_len = (uint8_t)strlen(value->name), .type = value->type,
		.good = value->good, .value = value->value,
	};
}

_Static_assert(IO_PEER_BOARD == PEER_BOARD, "the map admits what a datagram carries");

bool outbox_write(struct outbox *outbox, struct outbox_line *line, uint8_t flags, uint32_t age_ms,
		  struct peer_writer *out)
{
	const struct io_publish *publish = line->publish;

	if (line->next >= (uint32_t)publish->count)
		return false;
	peer_begin(out, &(struct peer_head){
		.flags = flags, .run = outbox->run, .sequence = ++outbox->line[line->counts].sequence, .age_ms = age_ms,
		.board = publish->as, .board_len = (uint8_t)strlen(publish->as),
	});
	for (; line->next < (uint32_t)publish->count; line->next++) {
		const struct outbox_value *value = &outbox->value[line->first + line->next];
		const struct peer_value wire = value_of(value);

		if (value->known && !peer_add(out, &wire))
			break;
	}
	return true;
}
