/* SPDX-License-Identifier: MIT
 *
 * board_gateways - what the status of a board tells of the programs that serve points of its map.
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

static bool ask(struct remote *remote, struct board_status *status, struct gateways_status *all)
{
	struct wire_writer request = desk_ask(&remote->desk, SERVICE_STATUS);
	struct wire_reader in;

	if (desk_call(&remote->desk, &request, &in) != DESK_GOOD)
		return false;
	status_take(&in, status);
	gateways_take(&in, all);
	return !in.failed;
}

void remote_print_gateways(struct remote *remote)
{
	const struct sink *out = &remote->call->out;
	struct board_status *status = calloc(1, sizeof(*status));
	struct gateways_status *all = calloc(1, sizeof(*all));

	if (status && all && ask(remote, status, all)) {
		sink_text(out, remote->json ? ", \"gateways\": [" : "");
		for (uint8_t i = 0; i < all->count; i++) {
			sink_text(out, remote->json && i ? ", " : "");
			(remote->json ? json_gateway : print_gateway)(out, &all->gateway[i]);
		}
		sink_text(out, remote->json ? "]" : "");
	}
	free(all);
	free(status);
}
