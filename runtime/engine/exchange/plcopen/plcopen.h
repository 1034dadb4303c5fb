/* SPDX-License-Identifier: MIT
 *
 * plcopen - a project in PLCopen TC6 XML as the text of a rung file.
 *
 * Takes versions 1.0 to 2.01, as Beremiz, OpenPLC Editor, CODESYS and TwinCAT write them. An
 * element that reaches neither the text nor a line of the report is reported as left out. This
 * code opens no file: the reader of rung files reads its text.
 */
#ifndef PLCOPEN_H
#define PLCOPEN_H

#include "engine/base/diag.h"
#include "engine/exchange/drawing.h"
#include "engine/exchange/report.h"

struct plcopen_text {
	char *text;         /* ends with a NUL                                      */
	size_t len;
	const int *line;    /* in the XML, of each line of the text                 */
	int lines;
	struct drawings drawings; /* of rungs and networks, as they stand in the XML        */
};

/** plcopen_is - whether @bytes begin as such a file. Scan-safe: yes. */
bool plcopen_is(const void *bytes, size_t len);
/**
 * plcopen_to_rung - the text of the project, and where each line of it comes from
 * @file:   for messages
 * @report: gets what was taken, changed and lost
 *
 * Owns: @arena.   Scan-safe: no.   Fails: false after a diagnostic.
 */
bool plcopen_to_rung(const char *file, const void *bytes, size_t len, struct arena *arena,
		     struct plcopen_text *out, struct classic_report *report,
		     struct diag_list *diags);
#endif
