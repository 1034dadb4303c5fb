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

#include "engine/exchange/import.h"

/** plcopen_is - whether @bytes begin as such a file. Scan-safe: yes. */
bool plcopen_is(const void *bytes, size_t len);
/* `plcopen_format` (exchange/import.h) reads one. */
#endif
