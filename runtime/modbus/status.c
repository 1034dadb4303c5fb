/* SPDX-License-Identifier: MIT
 *
 * status - counters as a report and as lines.
 */
#include "modbus/status.h"

#include <stdlib.h>
#include <string.h>

/* Each unit of each bus, until @visit has enough. */
static void each_unit(const struct masters *masters,
		      bool (*visit)(void *context, const char *bus, int id, const struct bus_told *told),
		      void *context)
{
	for (int i = 0; masters->of && i < masters->count; i++)
		for (int u = 0; masters->of[i] && u < 256; u++) {
			struct master *master = masters->of[i];
			struct bus_told told;

			if (!master->bus.has[u])
				continue;
			told = bus_tell(&master->bus, u);
			if (!visit(context, master->line.at->name, u, &told))
				return;
		}
}

static uint32_t exceptions_of(const struct unit_counts *counts)
{
	uint32_t all = 0;

	for (int i = 0; i < PDU_EXCEPTIONS; i++)
		all += counts->exceptions[i];
	return all;
}

/* ---- answers of others ---- */

bool status_strays_open(struct status_strays *strays, int buses)
{
	*strays = (struct status_strays){ .unit = calloc((size_t)buses * 256 + 1, sizeof(*strays->unit)) };
	return strays->unit != NULL;
}

void status_strays_close(struct status_strays *strays)
{
	free(strays->unit);
	strays->unit = NULL;
}

/* The first line of the map that names the unit. */
static struct diag place_of(const struct iomap *map, int bus, int id)
{
	struct diag diag = { .id = DIAG_MODBUS_STRANGE, .file = map->file };

	for (int i = map->count - 1; i >= 0; i--) {
		const struct io_point *point = &map->point[i];

		if (point->channel && point->channel->bus == bus && point->channel->unit_id == id) {
			diag.line = point->text_line;
			diag.column = point->text_column;
		}
	}
	return diag;
}

void status_strays(struct status_strays *strays, const struct masters *masters, const struct iomap *map,
		   struct diag_list *diags)
{
	strays->first[0] = '\0';
	for (int i = 0; masters->of && i < masters->count; i++)
		for (int u = 0; masters->of[i] && u < 256; u++) {
			struct status_stray *stray = &strays->unit[256 * i + u];
			struct bus_told told;
			char name[24];
			const bool was = stray->is;

			if (!masters->of[i]->bus.has[u])
				continue;
			told = bus_tell(&masters->of[i]->bus, u);
			stray->is = told.silent && (was || told.counts.wrong != stray->wrong);
			stray->wrong = told.counts.wrong;
			snprintf(name, sizeof(name), "%.18s/%u", masters->of[i]->line.at->name, (unsigned)(uint8_t)u);
			if (stray->is && !strays->first[0])
				memcpy(strays->first, name, sizeof(name));
			if (stray->is && !was)
				diag_add(diags, place_of(map, i, u), "%s", name);
		}
}

/* ---- the report ---- */

struct tally {
	struct gateway_report *report;
	bool silent;           /* those that do not answer, or the others        */
	int units, away;
};

static bool add_unit(void *context, const char *bus, int id, const struct bus_told *told)
{
	const struct unit_counts *counts = &told->counts;
	struct tally *tally = context;
	struct gateway_unit *out;

	if (told->silent != tally->silent)
		return true;
	tally->units++;
	tally->away += tally->silent;
	if (tally->report->count == REPORT_UNITS)
		return true;
	out = &tally->report->unit[tally->report->count++];
	snprintf(out->name, sizeof(out->name), "%s/%d", bus, id);
	out->requests = counts->requests;
	out->errors = (uint64_t)counts->crc + counts->wrong + counts->late + exceptions_of(counts);
	out->timeouts = counts->timeouts;
	return true;
}

void status_report(const struct masters *masters, const struct serve *serve, const struct status_strays *strays,
		   struct gateway_report *out)
{
	struct tally tally = { .report = out, .silent = true };
	int buses = 0, clients = 0;

	*out = (struct gateway_report){ .count = 0 };
	each_unit(masters, add_unit, &tally);
	tally.silent = false;
	each_unit(masters, add_unit, &tally);
	for (int i = 0; masters->of && i < masters->count; i++)
		buses += masters->of[i] != NULL;
	for (int i = 0; serve->net && i < serve->net->serve_count; i++)
		clients += serve->place[i].clients;
	if (strays->first[0])
		snprintf(out->text, sizeof(out->text), "LD876: %s; units: %d, silent: %d", strays->first, tally.units,
			 tally.away);
	else
		snprintf(out->text, sizeof(out->text), "buses: %d, units: %d, silent: %d, masters connected: %d", buses,
			 tally.units, tally.away, clients);
}

static bool print_unit(void *context, const char *bus, int id, const struct bus_told *told)
{
	FILE *out = context;
	const struct unit_counts *counts = &told->counts;

	fprintf(out, "%s/%d: %s, requests %u, answers %u, time-outs %u, wrong checks %u, wrong frames %u, late %u",
		bus, id, told->silent ? "silent" : "answers", counts->requests, counts->answers,
		counts->timeouts, counts->crc, counts->wrong, counts->late);
	for (int i = 1; i < PDU_EXCEPTIONS; i++)
		if (counts->exceptions[i])
			fprintf(out, ", exception %d: %u", i, counts->exceptions[i]);
	if (counts->exceptions[0])
		fprintf(out, ", other exceptions: %u", counts->exceptions[0]);
	fputc('\n', out);
	return true;
}

void status_print(const struct masters *masters, const struct serve *serve, FILE *out)
{
	each_unit(masters, print_unit, out);
	for (int i = 0; serve->net && i < serve->net->serve_count; i++)
		fprintf(out, "%s: masters connected: %d\n", serve->net->serve[i].at.name, serve->place[i].clients);
	if (serve->net && serve->net->serve_count)
		fprintf(out, "requests answered: %llu, refused: %llu\n", (unsigned long long)serve->answers,
			(unsigned long long)serve->refusals);
	fflush(out);
}
