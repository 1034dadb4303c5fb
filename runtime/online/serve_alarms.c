/* SPDX-License-Identifier: MIT
 *
 * serve_alarms - the list of alarms, and who acknowledges.
 */
#include "online/serve.h"

#include <stdio.h>

/* Rows from a number on, as many as fit. */
enum refusal serve_alarms(struct asked *asked)
{
	const struct alarms *alarms = asked->server->setup.alarms;
	const uint32_t from = wire_u32(&asked->frame.body);
	const struct alarm_row *row;
	uint32_t next = from, active, waiting;
	uint16_t count = 0;
	uint8_t *head;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!alarms)
		return REFUSAL_NO_SERVICE;
	alarm_list_count(&alarms->list, &active, &waiting);
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, active);
	wire_put_u32(&asked->out, waiting);
	wire_put_u32(&asked->out, alarms->list.lost);
	wire_put_u32(&asked->out, alarms->watch ? alarms->watch->left_out : 0);
	head = asked->out.at;
	wire_put_u16(&asked->out, 0);
	while ((size_t)(asked->out.end - asked->out.at) > ALARM_BYTES &&
	       (row = alarm_list_next(&alarms->list, next)) != NULL) {
		alarm_put(&asked->out, row);
		next = row->number + 1;
		count++;
	}
	head[0] = (uint8_t)count;
	head[1] = (uint8_t)(count >> 8);
	return REFUSAL_NONE;
}

/* The places that are written, in server->item. Returns how many. */
static uint32_t find_items(struct server *server, uint32_t number)
{
	const struct alarms *alarms = server->setup.alarms;
	uint32_t count = 0;

	for (uint32_t i = 0; alarms->watch && i < ALARM_ROWS; i++) {
		const struct alarm_row *row = &alarms->list.row[i];
		const struct alarm_block *block;

		if (!alarm_waits(row) || (number && row->number != number))
			continue;
		block = alarm_block_find(alarms->watch, row->name);
		if (!block || alarm_block_ack(block).type == IEC_NONE)
			continue;
		server->item[count++] = (struct order_item){ .at = alarm_block_ack(block),
							     .value.i = 1 };
	}
	return count;
}

/* The row changes at once; its block learns it in the next scan. */
static uint32_t acknowledge(struct asked *asked, uint32_t number)
{
	struct alarms *alarms = asked->server->setup.alarms;
	const int64_t now_ns = alarms->clock_ns();
	uint32_t done = 0;

	for (uint32_t i = 0; i < ALARM_ROWS; i++) {
		const struct alarm_row *row = &alarms->list.row[i];

		if (!alarm_waits(row) || (number && row->number != number))
			continue;
		alarm_list_ack(&alarms->list, row->number, asked->session->user, now_ns);
		asked_tell(asked, EVENT_ALARM_ACK, row->name, row->text);
		done++;
	}
	return done;
}

enum refusal serve_ack(struct asked *asked)
{
	struct server *server = asked->server;
	const uint32_t number = wire_u32(&asked->frame.body);
	enum refusal refusal = REFUSAL_NONE;
	uint32_t count;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!server->setup.alarms)
		return REFUSAL_NO_SERVICE;
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	if (number && !alarm_list_find(&server->setup.alarms->list, number)) {
		snprintf(asked->detail, sizeof(asked->detail), "%u", (unsigned)number);
		return REFUSAL_NO_ALARM;
	}
	count = find_items(server, number);
	if (count) {
		server->order = (struct order){ .kind = ORDER_WRITE,
			.program = server->setup.program, .item = server->item, .count = count };
		refusal = server_give(server);
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, acknowledge(asked, number));
	return REFUSAL_NONE;
}
