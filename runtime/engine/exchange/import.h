/* SPDX-License-Identifier: MIT
 *
 * import - what every reader of another tool's programs gets and gives.
 *
 * A reader makes the text of a rung file, which the ordinary reader reads. The facade asks each
 * format in turn whether a file is its own.
 */
#ifndef EXCHANGE_IMPORT_H
#define EXCHANGE_IMPORT_H

#include "engine/base/diag.h"
#include "engine/exchange/drawing.h"
#include "engine/exchange/foreign_text.h"

struct import {
	const char *path;        /* as the user wrote it                           */
	const void *bytes;       /* NULL: @path is a folder                        */
	size_t len;
	bool task;               /* write a CONFIGURATION with the period          */
	struct arena *arena;     /* owns the result                                */
	struct classic_report *report;
	struct diag_list *diags;
	/* The result: */
	struct foreign_text text;
	int64_t period_ns;       /* of its scans; 0: not known                     */
	struct drawings drawings; /* of rungs and networks, as they are drawn there */
};

struct import_format {
	const char *name;        /* "LDmicro"                                      */
	bool (*is)(const void *bytes, size_t len);  /* by its first bytes          */
	bool (*is_folder)(const char *path);        /* NULL: it has no folders     */
	bool (*read)(struct import *import);        /* false after a diagnostic    */
	bool declares_more;      /* it declares what the program may not use: no message says so */
};

extern const struct import_format ldmicro_format, openplc_format, plcopen_format;
#endif
