/* SPDX-License-Identifier: MIT
 *
 * cmd_complete - `ladder complete`: what could stand at a place of a program. It is
 * the list that an editor offers; it changes nothing.
 */
#include "ladder/report.h"

#include <stdlib.h>
#include <string.h>

struct entry { char *text; }; /* a whole line of the result                  */

struct list {
	struct entry *entry;
	int count, room;
	bool json, failed;
};

/* "kind", "word" and "note" as one text, put together by a sink. */
static void keep(void *context, const char *text, size_t len)
{
	struct list *list = context;
	struct entry *last = &list->entry[list->count];
	size_t had = last->text ? strlen(last->text) : 0;
	char *more = list->failed ? NULL : realloc(last->text, had + len + 1);

	if (!more) {
		list->failed = true;
		return;
	}
	memcpy(more + had, text, len);
	more[had + len] = '\0';
	last->text = more;
}

static bool has_room(struct list *list)
{
	struct entry *more;

	if (list->count + 1 < list->room)
		return true;
	more = realloc(list->entry, sizeof(*more) * (size_t)(2 * list->room + 64));
	if (!more)
		return false;
	memset(more + list->room, 0, sizeof(*more) * (size_t)(list->room + 64));
	list->entry = more;
	list->room = 2 * list->room + 64;
	return true;
}

static void take(void *context, const struct ladder_word *word)
{
	struct list *list = context;
	struct sink sink = { .write = keep, .context = list };

	if (list->failed || !has_room(list)) {
		list->failed = true;
		return;
	}
	if (list->json) {
		sink_text(&sink, "{\"kind\": ");
		sink_json_text(&sink, word->kind);
		sink_text(&sink, ", \"word\": ");
		sink_json_text(&sink, word->text);
		sink_text(&sink, ", \"note\": ");
		sink_json_text(&sink, word->note);
		sink_text(&sink, "}");
	} else {
		sink_text(&sink, word->kind);
		sink_text(&sink, "\t");
		sink_text(&sink, word->text);
		sink_text(&sink, *word->note ? "\t" : "");
		sink_text(&sink, word->note);
	}
	list->count++;
}

static int by_text(const void *a, const void *b)
{
	return strcmp(((const struct entry *)a)->text, ((const struct entry *)b)->text);
}

/* A local hides the global of its name, and a word is offered once. */
static void print_list(struct list *list, const struct sink *out)
{
	const char *before = "";
	bool first = true;

	qsort(list->entry, (size_t)list->count, sizeof(*list->entry), by_text);
	sink_text(out, list->json ? "[" : "");
	for (int i = 0; i < list->count; i++) {
		const char *text = list->entry[i].text;

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
	if (!ladder_complete(ladder, text, len, line, column, take, &list, &place))
		status = report_usage(call, "the file has no line %d with a column %d",
				      line, column);
	else if (list.failed)
		status = report_no_memory(call->arg[0]);
	else if (list.entry || list.json)
		print_list(&list, &call->out);
	for (int i = 0; i < list.room; i++)
		free(list.entry[i].text);
	free(list.entry);
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
