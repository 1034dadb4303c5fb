/* SPDX-License-Identifier: MIT
 *
 * ports - the serial lines of a map, before anything is driven. It opens none, because another program serves them,
 * perhaps as another user. buses.c examines more.
 */
#ifndef HAL_PORTS_H
#define HAL_PORTS_H

#include "hal/iomap.h"

#ifndef RUNGBOARD_SMALL
/**
 * ports_check - finds the device of each serial line
 * @now:   a map that runs: its lines were there once, and are not looked for; NULL: none runs
 * @diags: NULL: nobody wants to know which are missing
 *
 * Scan-safe: no.   Fails: false and an error for each, with its place in the map.
 */
bool ports_check(const struct iomap *map, const struct iomap *now, struct diag_list *diags);
#else
#define ports_check(map, now, diags) ((void)(map), true)
#endif
#endif
