/* SPDX-License-Identifier: MIT
 *
 * board_gateways - what the status of a board tells of the values of its map, and of the programs that serve
 * points of it.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"
#include "ladder/report.h"
#include "online/report.h"

#include <stdlib.h>

static void print_unit(const struct sink *out, const struct gateway_unit *unit)
{
	sink_text(out, "  ");
	foreign_text(out, unit->name);
	sink_printf(out, ": %llu requests, %llu errors, %llu without an answer\n", (unsigned long long)unit->requests,
		    (unsigned long long)unit->errors, (unsigned long long)unit->timeouts);
}

static void print_gateway(const struct sink *out, const struct gateway_status *gateway)
{
	sink_text(out, "gateway ");
	foreign_text(out, gateway->driver);
	sink_printf(out, ": %u points", (unsigned)gateway->points);
	if (gateway->runs) {
		sink_text(out, ", user ");
		foreign_text(out, gateway->user);
	} else {
		sink_text(out, ", not there");
	}
	if (*gateway->report.text) {
		sink_text(out, ": ");
		foreign_text(out, gateway->report.text);
	}
	sink_text(out, "\n");
	for (uint16_t i = 0; i < gateway->report.count; i++)
		print_unit(out, &gateway->report.unit[i]);
}

static void json_gateway(const struct sink *out, const struct gateway_status *gateway)
{
	sink_text(out, "{\"driver\": ");
	sink_json_text(out, gateway->driver);
	sink_printf(out, ", \"runs\": %s, \"points\": %u", gateway->runs ? "true" : "false", (unsigned)gateway->points);
	report_json_field("user", gateway->runs ? gateway->user : NULL, out);
	report_json_field("text", *gateway->report.text ? gateway->report.text : NULL, out);
	sink_text(out, ", \"units\": [");
	for (uint16_t i = 0; i < gateway->report.count; i++) {
		const struct gateway_unit *unit = &gateway->report.unit[i];

		sink_text(out, i ? ", {\"name\": " : "{\"name\": ");
		sink_json_text(out, unit->name);
		sink_printf(out, ", \"requests\": %llu, \"errors\": %llu, \"timeouts\": %llu}", (unsigned long long)unit->requests,
			    (unsigned long long)unit->errors, (unsigned long long)unit->timeouts);
	}
	sink_text(out, "]}");
}

static void print_values(const struct sink *out, const struct values_status *all)
{
	if (!all->good && !all->stale && !all->fault)
		return;
	sink_printf(out, "values: %u good, %u stale, %u in fault\n", (unsigned)all->good, (unsigned)all->stale,
		    (unsigned)all->fault);
	for (uint16_t i = 0; i < all->count; i++) {
		sink_text(out, "  ");
		foreign_text(out, all->bad[i].address);
		sink_printf(out, ": %s\n", value_quality(all->bad[i].flags));
	}
}

static void json_values(const struct sink *out, const struct values_status *all)
{
	sink_printf(out, ", \"values\": {\"good\": %u, \"stale\": %u, \"fault\": %u, \"not_good\": {", (unsigned)all->good,
		    (unsigned)all->stale, (unsigned)all->fault);
	for (uint16_t i = 0; i < all->count; i++) {
		sink_text(out, i ? ", " : "");
		sink_json_text(out, all->bad[i].address);
		sink_text(out, ": ");
		sink_json_text(out, value_quality(all->bad[i].flags));
	}
	sink_text(out, "}}");
}

/* What a board of now tells in one answer. */
struct told {
	struct board_status status;
	struct gateways_status gateways;
	struct values_status values;
};

static bool ask(struct remote *remote, struct told *told)
{
	struct wire_writer request = desk_ask(&remote->desk, SERVICE_STATUS);
	struct wire_reader in;

	if (desk_call(&remote->desk, &request, &in) != DESK_GOOD)
		return false;
	status_take(&in, &told->status);
	gateways_take(&in, &told->gateways);
	values_take(&in, &told->values);
	return !in.failed;
}

void remote_print_gateways(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	struct told *told = calloc(1, sizeof(*told));

	if (told && ask(remote, told)) {
		(remote->json ? json_values : print_values)(out, &told->values);
		sink_text(out, remote->json ? ", \"gateways\": [" : "");
		for (uint8_t i = 0; i < told->gateways.count; i++) {
			sink_text(out, remote->json && i ? ", " : "");
			(remote->json ? json_gateway : print_gateway)(out, &told->gateways.gateway[i]);
		}
		sink_text(out, remote->json ? "]" : "");
	}
	free(told);
}
