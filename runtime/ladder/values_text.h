/* SPDX-License-Identifier: MIT
 *
 * values_text - retained values as text that a person can read and compare, and back.
 *
 *   RUNGBOARD VALUES 1
 *   clock 12.5
 *   Main.Count DINT = 5
 *   Main.Parcels.value FIFO.DINT[4] = 7, 0, 0, 0
 *
 * The bytes are a payload of scan/retain.h.
 */
#ifndef LADDER_VALUES_TEXT_H
#define LADDER_VALUES_TEXT_H

#include "ladder/bytes.h"
#include "ladder/report.h"

/** values_print - @payload: well-formed. Scan-safe: no; so are all functions. */
void values_print(const uint8_t *payload, uint32_t len, struct bytes *out);
/** values_is_text - whether a file begins as such a text. */
bool values_is_text(const uint8_t *bytes, size_t len);
/** values_parse - @path: for diagnostics. Fails: after a message. */
enum status values_parse(const char *path, const char *text, size_t len, struct bytes *payload);
#endif
