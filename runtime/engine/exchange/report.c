/* SPDX-License-Identifier: MIT
 *
 * report - the lines of an import's or export's report.
 *
 * Only a list: the caller prints it. It owns its texts.
 */
#include "engine/exchange/report.h"

#include <stdarg.h>
#include <stdio.h>

void report_init(struct classic_report *report)
{
	*report = (struct classic_report){ 0 };
	arena_init(&report->arena);
}

void report_free(struct classic_report *report)
{
	const char *(*translate)(const char *text) = report->translate;

	arena_free(&report->arena);
	report_init(report);
	report->translate = translate;
}

const char *report_said(const struct classic_report *report, const char *text)
{
	return report->translate ? report->translate(text) : text;
}

void report_add(struct classic_report *report, struct report_line line,
		const char *text, ...)
{
	struct report_line *added;
	char whole[512];
	va_list args;
	int len;

	va_start(args, text);
	len = vsnprintf(whole, sizeof(whole), text, args);
	va_end(args);
	if (len < 0)
		len = 0;
	if ((size_t)len >= sizeof(whole))
		len = sizeof(whole) - 1;
	line.text = arena_copy(&report->arena, whole, (size_t)len);
	added = line.text ? arena_push(&report->arena, &report->line, &report->count,
				       sizeof(line)) : NULL;
	if (added)
		*added = line;
}
