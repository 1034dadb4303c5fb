/* SPDX-License-Identifier: MIT
 *
 * machine - the fields of a row, written and read in one order.
 */
#include "online/machine.h"

#include <string.h>

void machine_put(struct wire_writer *out, const struct machine_row *row)
{
	wire_put_string(out, row->driver);
	wire_put_string(out, row->device);
	wire_put_string(out, row->label);
	wire_put_string(out, row->channel);
	wire_put_string(out, row->about);
	wire_put_string(out, row->unit);
	wire_put_u32(out, row->offset);
	wire_put_u8(out, row->flags);
	wire_put_value(out, IEC_LREAL, (union iec_value){ .r = row->value });
}

void machine_take(struct wire_reader *in, struct machine_row *row)
{
	memset(row, 0, sizeof(*row));
	wire_copy_text(in, row->driver, sizeof(row->driver));
	wire_copy_text(in, row->device, sizeof(row->device));
	wire_copy_text(in, row->label, sizeof(row->label));
	wire_copy_text(in, row->channel, sizeof(row->channel));
	wire_copy_text(in, row->about, sizeof(row->about));
	wire_copy_text(in, row->unit, sizeof(row->unit));
	row->offset = wire_u32(in);
	row->flags = wire_u8(in);
	row->value = wire_value(in, IEC_LREAL, NULL).r;
}
