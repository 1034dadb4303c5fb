/* SPDX-License-Identifier: MIT
 *
 * iomap_scan - the units on a bus that answer: `ladder-modbus scan`, run in the background for one BUS line.
 *
 * It asks from this machine, reads one register of each number and writes nothing.
 */
#ifndef EDITOR_IOMAP_SCAN_H
#define EDITOR_IOMAP_SCAN_H

#include "editor-gtk/document/iomap_text.h"

#include <gio/gio.h>

/* A unit that has answered. */
struct iomap_unit {
	int unit;
	double ms;               /* of its answer                              */
	int exception;           /* … which was this error; 0: none             */
};

struct iomap_scan;
/** iomap_scan_new - nothing is known. @changed: called with @data when a scan has ended. Caller:
 * iomap_scan_free(). */
struct iomap_scan *iomap_scan_new(void (*changed)(gpointer data), gpointer data);
/** iomap_scan_free - ends a scan that runs. */
void iomap_scan_free(struct iomap_scan *scan);

/** iomap_scan_begin - scans the bus of row @row of a map, which is a BUS line. Fails: false, and
 * iomap_scan_said() says why. */
bool iomap_scan_begin(struct iomap_scan *scan, const struct io_text *io, int row);
/** iomap_scan_stop - ends it; nothing new is known. */
void iomap_scan_stop(struct iomap_scan *scan);
bool iomap_scan_runs(const struct iomap_scan *scan);
/** iomap_scan_said - what the last one has found, or why it failed; NULL: nothing to say. Borrowed until the next
 * call. @wrong: gets whether it failed. */
const char *iomap_scan_said(const struct iomap_scan *scan, bool *wrong);
/** iomap_scan_hush - nothing to say any more, unless it runs; units stay known. */
void iomap_scan_hush(struct iomap_scan *scan);
/** iomap_scan_units - of struct iomap_unit, of the last scan of the bus of this name; NULL: none. Borrowed. */
const GArray *iomap_scan_units(const struct iomap_scan *scan, const char *bus);

#endif
