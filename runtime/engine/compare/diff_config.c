/* SPDX-License-Identifier: MIT
 *
 * diff_config - two CONFIGURATIONs compared: tasks, programs and areas by name. Their
 * variables are compared with the other globals.
 */
#include "engine/compare/diff.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

static const struct config none;

static const struct config *config_of(const struct project *project)
{
	return project->config ? project->config : &none;
}

static const char *subject_of(const struct project *project,
			      const struct config_entry *entry)
{
	return entry->kind == CONFIG_AREA ? iec_area_row(entry->area)->letters :
					   project_text(project, entry->name);
}

/* The line of @project that is about the same; NULL: there is none. */
static const struct config_entry *same_line(const struct project *project,
					   const struct config_entry *entry,
					   const char *subject)
{
	const struct config *config = config_of(project);

	for (int i = 0; i < config->count; i++) {
		const struct config_entry *other = &config->entry[i];
		const char *text = subject_of(project, other);

		if (other->kind == entry->kind && strlen(text) == strlen(subject) &&
		    ascii_same(text, subject, strlen(text)))
			return other;
	}
	return NULL;
}

static void compare_ids(struct diff *diff, struct difference what,
			const char *property, uint32_t a, uint32_t b)
{
	diff_texts(diff, what, property, project_text(diff->a, a),
		   project_text(diff->b, b));
}

static void compare_numbers(struct diff *diff, struct difference what,
			    const char *property, uint32_t a, uint32_t b)
{
	char from[16], to[16];

	snprintf(from, sizeof(from), "%u", (unsigned)a);
	snprintf(to, sizeof(to), "%u", (unsigned)b);
	diff_texts(diff, what, property, from, to);
}

static void compare_entry(struct diff *diff, struct difference what,
			 const struct config_entry *a,
			 const struct config_entry *b)
{
	compare_ids(diff, what, "INTERVAL", a->interval, b->interval);
	compare_ids(diff, what, "SINGLE", a->single, b->single);
	compare_numbers(diff, what, "PRIORITY", a->priority, b->priority);
	compare_ids(diff, what, "WATCHDOG", a->watchdog, b->watchdog);
	compare_ids(diff, what, "task", a->task, b->task);
	compare_ids(diff, what, "program", a->pou, b->pou);
	compare_numbers(diff, what, "bytes", a->bytes, b->bytes);
	compare_ids(diff, what, "comment", a->comment, b->comment);
}

static const char *kind_of(const struct config_entry *entry)
{
	static const char *const kind[] = {
		[CONFIG_VARS] = "", [CONFIG_AREA] = "area",
		[CONFIG_TASK] = "task", [CONFIG_PROGRAM] = "instance",
	};

	return kind[entry->kind];
}

void diff_config(struct diff *diff)
{
	const struct config *a = config_of(diff->a), *b = config_of(diff->b);
	struct difference what = { .kind = "configuration" };

	compare_ids(diff, what, "name", a->name, b->name);
	compare_ids(diff, what, "comment", a->comment, b->comment);
	compare_ids(diff, what, "resource", a->resource, b->resource);
	compare_ids(diff, what, "kind of the resource", a->on, b->on);
	compare_ids(diff, what, "comment of the resource", a->resource_comment,
		    b->resource_comment);
	for (int i = 0; i < a->count; i++) {
		const struct config_entry *entry = &a->entry[i], *other;

		what.kind = kind_of(entry);
		what.subject = subject_of(diff->a, entry);
		if (entry->kind == CONFIG_VARS)
			continue;
		other = same_line(diff->b, entry, what.subject);
		what.change = other ? NULL : "removed";
		if (other)
			compare_entry(diff, what, entry, other);
		else
			diff_say(diff, what);
	}
	what.change = "added";
	for (int i = 0; i < b->count; i++) {
		what.kind = kind_of(&b->entry[i]);
		what.subject = subject_of(diff->b, &b->entry[i]);
		if (b->entry[i].kind != CONFIG_VARS &&
		    !same_line(diff->a, &b->entry[i], what.subject))
			diff_say(diff, what);
	}
}
