/* SPDX-License-Identifier: MIT
 *
 * export_io - an I/O map as the lines of ClassicLadder's ioconf.csv: pins of a Raspberry Pi.
 *
 * Settings that such a line cannot hold are reported on standard error, with their place.
 */
#ifndef LADDER_EXPORT_IO_H
#define LADDER_EXPORT_IO_H

#include "ladder/report.h"

#include "engine/exchange/classic/to_classic.h"

/**
 * export_lines - the lines of a map
 * @path:  names the map in messages
 * @text:  the map
 * @arena: owns what is written to @lines
 *
 * Scan-safe: no.   Fails: false after telling what is wrong with the map.
 */
bool export_lines(const char *path, const char *text, size_t len, struct arena *arena,
		  struct classic_lines *lines);
#endif
