/* SPDX-License-Identifier: MIT
 *
 * report - the fields of a gateway's report, written and read in one order.
 */
#include "online/report.h"

#include <string.h>

void report_put(struct wire_writer *out, const struct gateway_report *report)
{
	wire_put_string(out, report->text);
	wire_put_u16(out, report->count);
	for (uint16_t i = 0; i < report->count; i++) {
		const struct gateway_unit *unit = &report->unit[i];

		wire_put_string(out, unit->name);
		wire_put_u64(out, unit->requests);
		wire_put_u64(out, unit->errors);
		wire_put_u64(out, unit->timeouts);
	}
}

void report_take(struct wire_reader *in, struct gateway_report *report)
{
	memset(report, 0, sizeof(*report));
	wire_copy_text(in, report->text, sizeof(report->text));
	report->count = wire_u16(in);
	if (report->count > REPORT_UNITS) {
		report->count = 0;
		in->failed = true;
	}
	for (uint16_t i = 0; i < report->count; i++) {
		struct gateway_unit *unit = &report->unit[i];

		wire_copy_text(in, unit->name, sizeof(unit->name));
		unit->requests = wire_u64(in);
		unit->errors = wire_u64(in);
		unit->timeouts = wire_u64(in);
	}
}

void gateways_put(struct wire_writer *out, const struct gateways_status *all)
{
	wire_put_u8(out, all->count);
	for (uint8_t i = 0; i < all->count; i++) {
		const struct gateway_status *gateway = &all->gateway[i];

		wire_put_string(out, gateway->driver);
		wire_put_u8(out, gateway->runs);
		wire_put_u32(out, gateway->points);
		wire_put_string(out, gateway->user);
		report_put(out, &gateway->report);
	}
}

void gateways_take(struct wire_reader *in, struct gateways_status *all)
{
	uint8_t count;

	memset(all, 0, sizeof(*all));
	if (in->failed || !wire_left(in))
		return; /* a board of before these fields */
	count = wire_u8(in);
	for (uint8_t i = 0; i < count && !in->failed; i++) {
		struct gateway_status *gateway = &all->gateway[i < GATEWAY_COUNT ? i : GATEWAY_COUNT];

		wire_copy_text(in, gateway->driver, sizeof(gateway->driver));
		gateway->runs = wire_u8(in) != 0;
		gateway->points = wire_u32(in);
		wire_copy_text(in, gateway->user, sizeof(gateway->user));
		report_take(in, &gateway->report);
		all->count += !in->failed && i < GATEWAY_COUNT;
	}
}

void values_put(struct wire_writer *out, const struct values_status *all)
{
	wire_put_u32(out, all->good);
	wire_put_u32(out, all->stale);
	wire_put_u32(out, all->fault);
	wire_put_u16(out, all->count);
	for (uint16_t i = 0; i < all->count; i++) {
		wire_put_string(out, all->bad[i].address);
		wire_put_u8(out, all->bad[i].flags);
	}
}

void values_take(struct wire_reader *in, struct values_status *all)
{
	memset(all, 0, sizeof(*all));
	if (in->failed || !wire_left(in))
		return; /* a board of before these fields */
	all->good = wire_u32(in);
	all->stale = wire_u32(in);
	all->fault = wire_u32(in);
	all->count = wire_u16(in);
	if (all->count > VALUES_TOLD) {
		all->count = 0;
		in->failed = true;
	}
	for (uint16_t i = 0; i < all->count; i++) {
		wire_copy_text(in, all->bad[i].address, sizeof(all->bad[i].address));
		all->bad[i].flags = wire_u8(in);
	}
}

const char *value_quality(uint8_t flags)
{
	return flags & VALUE_FAULT ? "fault" : flags & VALUE_STALE ? "stale" : "good";
}
