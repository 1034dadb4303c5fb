/* SPDX-License-Identifier: MIT
 *
 * live_inside - what the files of live_map share. Only editor-gtk/live_*.c include it.
 */
#ifndef EDITOR_LIVE_INSIDE_H
#define EDITOR_LIVE_INSIDE_H

#include "editor-gtk/sim/live_map.h"

/* ---- live_map.c ---- */
/** live_map_power - where the cells of rung->number have their power. */
void live_map_power(const struct live_map *map, struct live_rung *rung);

/* ---- live_text.c ---- */
/** live_count_print - "3.2/5.0 s", "7/10": how far it is on the way to @goal. */
void live_count_print(enum iec_type type, union iec_value value, union iec_value goal,
		      char *out, size_t size);

#endif
