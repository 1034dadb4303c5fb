/* SPDX-License-Identifier: MIT
 *
 * plcopen_write - a project as PLCopen XML, version 2.01 of TC6.
 *
 * Parts that the format cannot express are left out, and the report lists them. The project must
 * have been checked. This code opens no file.
 */
#ifndef PLCOPEN_WRITE_H
#define PLCOPEN_WRITE_H

#include "engine/exchange/report.h"
#include "engine/model/project.h"

/**
 * plcopen_write - the text of the XML
 * @report: gets what is left out or has another meaning there, with lines of the project
 *
 * Owns: the caller, free(); NUL-ended.   Scan-safe: no.   Fails: NULL: no memory.
 */
char *plcopen_write(struct project *project, size_t *len, struct classic_report *report);
#endif
