/* SPDX-License-Identifier: MIT
 *
 * serve_machine - what lines and devices the board has.
 */
#include "online/serve.h"

/* Rows from a number on, as many as fit. */
enum refusal serve_devices(struct asked *asked)
{
	const struct server_machine *machine = asked->server->setup.machine;
	const bool anew = wire_u8(&asked->frame.body) != 0;
	const uint32_t from = wire_u32(&asked->frame.body);
	struct machine_row row;
	uint16_t count = 0;
	bool ready, more;
	uint8_t *head;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!machine)
		return REFUSAL_NO_SERVICE;
	ready = machine->look(machine->context, anew);
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, ready);
	head = asked->out.at;
	wire_put_u32(&asked->out, 0);
	wire_put_u16(&asked->out, 0);
	more = ready && from < UINT32_MAX - UINT16_MAX && machine->row(machine->context, from, &row);
	while (more && (size_t)(asked->out.end - asked->out.at) > MACHINE_BYTES && count < UINT16_MAX) {
		machine_put(&asked->out, &row);
		count++;
		more = machine->row(machine->context, from + count, &row);
	}
	for (int i = 0; i < 4; i++)
		head[i] = (uint8_t)(more ? (from + count) >> (8 * i) : 0);
	head[4] = (uint8_t)count;
	head[5] = (uint8_t)(count >> 8);
	return REFUSAL_NONE;
}
