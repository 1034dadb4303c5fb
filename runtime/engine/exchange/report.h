/* SPDX-License-Identifier: MIT
 *
 * report - what an import or export converted, changed and lost.
 *
 * A list of lines with places in the foreign file, for text, JSON and the editor. An
 * error that prevents an import is a diagnostic instead.
 */
#ifndef EXCHANGE_REPORT_H
#define EXCHANGE_REPORT_H

#include "engine/base/arena.h"

#include <stdbool.h>

enum report_kind {
	REPORT_TAKEN,   /* "18 rungs"                                            */
	REPORT_CHANGED, /* a fault of the original is repaired, a name differs */
	REPORT_LOST,    /* it was left out, as it has no equivalent               */
	REPORT_KINDS
};

struct report_line {
	enum report_kind kind;
	const char *member;  /* "rung_3.csv"; "": of the whole project           */
	int line;            /* 1-based in the file; 0: none                     */
	const char *pou;     /* POU of the result; NULL: none                    */
	int rung;            /* 1-based in @pou; 0: none                         */
	char *text;
};

/** REPORTED - marks a text of a report for translators where tell() does not get it itself. */
#define REPORTED(text) text

struct classic_report {
	struct arena arena;
	const char *(*translate)(const char *text); /* NULL: the texts are English    */
	struct report_line *line;
	int count;
};

/** report_init - an empty report in English. report_free frees its lines; the language
 * remains. */
void report_init(struct classic_report *report);
void report_free(struct classic_report *report);
/** report_said - @text, or a printf format, in the language of the report. */
const char *report_said(const struct classic_report *report, const char *text)
	__attribute__((format_arg(2)));
/**
 * report_add - one more line
 * @line: its text is ignored; member and pou are borrowed as long as the report lives
 * @text: printf format
 *
 * Scan-safe: no. Fails: without memory report->arena.failed is set.
 */
void report_add(struct classic_report *report, struct report_line line,
		const char *text, ...) __attribute__((format(printf, 3, 4)));
#endif
