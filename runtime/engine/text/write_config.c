/* SPDX-License-Identifier: MIT
 *
 * write_config - a CONFIGURATION as its one canonical text: a line a line, the
 * settings of a task in one order.
 */
#include "engine/text/writer.h"

#include "engine/text/text.h"

struct config_writer {
	const struct sink *sink;
	const struct project *project;
};

static void put_id(const struct config_writer *w, const char *before, uint32_t id)
{
	sink_text(w->sink, before);
	write_id(w->sink, w->project, id);
}

static void put_comment(const struct config_writer *w, uint32_t comment)
{
	if (comment)
		put_id(w, " ", comment);
	sink_text(w->sink, "\n");
}

static void put_task(const struct config_writer *w,
		     const struct config_entry *entry)
{
	put_id(w, "TASK ", entry->name);
	if (entry->interval)
		put_id(w, " (INTERVAL := ", entry->interval);
	else
		put_id(w, " (SINGLE := ", entry->single);
	sink_printf(w->sink, ", PRIORITY := %u", (unsigned)entry->priority);
	if (entry->watchdog)
		put_id(w, ", WATCHDOG := ", entry->watchdog);
	sink_text(w->sink, ");");
}

static void put_program(const struct config_writer *w,
			const struct config_entry *entry)
{
	put_id(w, "PROGRAM ", entry->name);
	if (entry->task)
		put_id(w, " WITH ", entry->task);
	put_id(w, " : ", entry->pou);
	sink_text(w->sink, ";");
}

static void put_entry(const struct config_writer *w,
		     const struct config_entry *entry)
{
	if (entry->kind == CONFIG_VARS) {
		write_block(w->sink, w->project, &w->project->globals,
			    entry->block);
		return;
	}
	sink_text(w->sink, entry->inside ? "    " : "  ");
	if (entry->kind == CONFIG_TASK)
		put_task(w, entry);
	else if (entry->kind == CONFIG_PROGRAM)
		put_program(w, entry);
	else
		sink_printf(w->sink, "AREA %s %u;",
			    iec_area_row(entry->area)->letters,
			    (unsigned)entry->bytes);
	put_comment(w, entry->comment);
}

/* The lines outside the RESOURCE keep their side of it. */
void write_config(const struct sink *sink, const struct project *project)
{
	const struct config_writer w = { sink, project };
	const struct config *config = project->config;
	bool open = false, done = !config->has_resource;

	put_id(&w, "CONFIGURATION ", config->name);
	put_comment(&w, config->comment);
	for (int i = 0; i <= config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		bool inside = i < config->count && entry->inside;

		if (!done && !open && (inside || i == config->count)) {
			put_id(&w, "  RESOURCE ", config->resource);
			if (config->on)
				put_id(&w, " ON ", config->on);
			put_comment(&w, config->resource_comment);
			open = true;
		}
		if (open && !done && !inside) {
			sink_text(sink, "  END_RESOURCE\n");
			done = true;
		}
		if (i < config->count)
			put_entry(&w, entry);
	}
	sink_text(sink, "END_CONFIGURATION\n");
}

void text_write_config(const struct project *project, const struct sink *sink)
{
	if (project->config)
		write_config(sink, project);
}
