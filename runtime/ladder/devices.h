/* SPDX-License-Identifier: MIT
 *
 * devices - the analog devices of this machine with their present values, for `ladder io`.
 *
 * It reads inputs and changes nothing.
 */
#ifndef LADDER_DEVICES_H
#define LADDER_DEVICES_H

#include "ladder/report.h"

#include "hal/iomap.h"

#define DEVICE_VALUE 48 /* bytes of a value as text, with its NUL              */

#ifdef RUNGBOARD_SMALL
static inline char (*devices_values(const struct iomap *map))[DEVICE_VALUE]
{
	(void)map;
	return NULL;
}
static inline int devices_print(const struct sink *out)
{
	(void)out;
	return 0;
}
static inline void devices_json(const struct sink *out)
{
	(void)out;
}
#else
/** devices_values - for each point of a map the present value of its channel, such as "21.437 °C", or why it has
 * none; "": it is none of a device of this machine. Owns: free(). Fails: NULL: the map has no such point, or no
 * memory. */
char (*devices_values(const struct iomap *map))[DEVICE_VALUE];
/** devices_print - a table of them; nothing if there are none. Returns their number. */
int devices_print(const struct sink *out);
/** devices_json - `"devices": [ … ],` and a newline. */
void devices_json(const struct sink *out);
#endif
#endif
