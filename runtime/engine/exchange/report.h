/* SPDX-License-Identifier: MIT
 *
 * report - what an import took, what means something else now, what it could not take.
 *
 * A list of lines with places in the file they speak of, for text, JSON and the editor.
 * What makes an import impossible is a diagnostic instead.
 */
#ifndef EXCHANGE_REPORT_H
#define EXCHANGE_REPORT_H

#include "engine/base/arena.h"

#include <stdbool.h>

enum report_kind {
	REPORT_TAKEN,   /* "18 rungs"                                            */
	REPORT_CHANGED, /* a fault of the original is repaired, a name is another */
	REPORT_LOST,    /* it has no meaning here and was left out                */
	REPORT_KINDS
};

struct report_line {
	enum report_kind kind;
	const char *member;  /* "rung_3.csv"; "": of the whole project           */
	int line;            /* 1-based in the file; 0: none                     */
	const char *pou;     /* here; NULL: nowhere                              */
	int rung;            /* 1-based in @pou; 0: none                         */
	char *text;
};

struct classic_report {
	struct arena arena;
	struct report_line *line;
	int count;
};

/** report_init - empty. report_free gives back what it holds. */
void report_init(struct classic_report *report);
void report_free(struct classic_report *report);
/**
 * report_add - one more line
 * @line: its text is ignored; member and pou must live as long as the report
 * @text: printf format
 *
 * Scan-safe: no.   Fails: never seen; without memory report->arena.failed is set.
 */
void report_add(struct classic_report *report, struct report_line line,
		const char *text, ...) __attribute__((format(printf, 3, 4)));
#endif
