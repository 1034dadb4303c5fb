/* SPDX-License-Identifier: MIT
 *
 * cmd_complete - `ladder complete`: lists the words that fit at a place of a program, for
 * editors.
 */
#include "ladder/report.h"

#include <stdlib.h>
#include <string.h>

struct list {
	struct sink_memory *line; /* of the result                           */
	int count, room;
	bool json, failed;
};

static bool has_room(struct list *list)
{
	struct sink_memory *more;
	const int room = 2 * list->room + 64;

	if (list->count < list->room)
		return true;
	more = realloc(list->line, sizeof(*more) * (size_t)room);
	if (!more)
		return false;
	list->line = more;
	list->room = room;
	return true;
}

static void take(void *context, const struct ladder_word *word)
{
	struct list *list = context;
	struct sink sink;

	if (list->failed || !has_room(list)) {
		list->failed = true;
		return;
	}
	sink_memory_init(&list->line[list->count]);
	sink = sink_to_memory(&list->line[list->count]);
	if (list->json) {
		sink_text(&sink, "{\"kind\": ");
		sink_json_text(&sink, word->kind);
		report_json_field("word", word->text, &sink);
		report_json_field("note", word->note, &sink);
		sink_text(&sink, "}");
	} else {
		sink_text(&sink, word->kind);
		sink_text(&sink, "\t");
		sink_text(&sink, word->text);
		sink_text(&sink, *word->note ? "\t" : "");
		sink_text(&sink, word->note);
	}
	list->failed = list->line[list->count++].failed;
}

static int by_text(const void *a, const void *b)
{
	return strcmp(sink_memory_text(a), sink_memory_text(b));
}

/* Sorted; equal lines once, since a local hides the global of its name. */
static void print_list(struct list *list, const struct sink *out)
{
	const char *before = "";
	bool first = true;

	if (list->count)
		qsort(list->line, (size_t)list->count, sizeof(*list->line), by_text);
	sink_text(out, list->json ? "[" : "");
	for (int i = 0; i < list->count; i++) {
		const char *text = sink_memory_text(&list->line[i]);

		if (strcmp(text, before) == 0)
			continue;
		if (list->json)
			sink_text(out, first ? "\n " : ",\n ");
		sink_text(out, text);
		sink_text(out, list->json ? "" : "\n");
		before = text;
		first = false;
	}
	sink_text(out, list->json ? "\n]\n" : "");
}

static bool read_number(const char *text, int *out)
{
	char *end;
	long number = strtol(text, &end, 10);

	*out = (int)number;
	return end != text && !*end && number > 0 && number <= 1000000000;
}

static enum status complete(struct call *call, struct ladder *ladder, int line,
			    int column)
{
	struct list list = { .json = call_flag(call, "--json") };
	struct ladder_place place;
	enum status status = STATUS_GOOD;
	size_t len;
	char *text = report_read(call->arg[0], &len);

	if (!text)
		return STATUS_WRONG;
	ladder_load_text(ladder, call->arg[0], text, len);
	if (!ladder_complete(ladder, text, len, line, column, take, &list, &place)) {
		report_diag((struct diag){ .id = DIAG_NO_SUCH_PLACE, .file = call->arg[0] },
			    "%d" DIAG_AND "%d", line, column);
		status = STATUS_WRONG;
	} else if (list.failed) {
		status = report_no_memory(call->arg[0]);
	} else {
		print_list(&list, &call->out);
	}
	for (int i = 0; i < list.count; i++)
		sink_memory_free(&list.line[i]);
	free(list.line);
	free(text);
	return status;
}

enum status cmd_complete(struct call *call)
{
	struct ladder *ladder;
	enum status status;
	int line, column;

	if (!read_number(call->arg[1], &line) || !read_number(call->arg[2], &column))
		return report_usage(call, "LINE and COLUMN must be numbers, from 1 on");
	if (report_classic(call->arg[0]))
		return STATUS_NO;
	ladder = ladder_new();
	if (!ladder)
		return report_no_memory(call->arg[0]);
	status = complete(call, ladder, line, column);
	ladder_free(ladder);
	return status;
}
