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
		     const struct config_item *item)
{
	put_id(w, "TASK ", item->name);
	if (item->interval)
		put_id(w, " (INTERVAL := ", item->interval);
	else
		put_id(w, " (SINGLE := ", item->single);
	sink_printf(w->sink, ", PRIORITY := %u", (unsigned)item->priority);
	if (item->watchdog)
		put_id(w, ", WATCHDOG := ", item->watchdog);
	sink_text(w->sink, ");");
}

static void put_program(const struct config_writer *w,
			const struct config_item *item)
{
	put_id(w, "PROGRAM ", item->name);
	if (item->task)
		put_id(w, " WITH ", item->task);
	put_id(w, " : ", item->pou);
	sink_text(w->sink, ";");
}

static void put_item(const struct config_writer *w,
		     const struct config_item *item)
{
	if (item->kind == CONFIG_VARS) {
		write_block(w->sink, w->project, &w->project->globals,
			    item->block);
		return;
	}
	sink_text(w->sink, item->inside ? "    " : "  ");
	if (item->kind == CONFIG_TASK)
		put_task(w, item);
	else if (item->kind == CONFIG_PROGRAM)
		put_program(w, item);
	else
		sink_printf(w->sink, "AREA %s %u;",
			    iec_area_row(item->area)->letters,
			    (unsigned)item->bytes);
	put_comment(w, item->comment);
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
		const struct config_item *item = &config->item[i];
		bool inside = i < config->count && item->inside;

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
			put_item(&w, item);
	}
	sink_text(sink, "END_CONFIGURATION\n");
}

void text_write_config(const struct project *project, const struct sink *sink)
{
	if (project->config)
		write_config(sink, project);
}
