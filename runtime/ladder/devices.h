/* SPDX-License-Identifier: MIT
 *
 * devices - the analog devices of this machine with their present values, for `ladder io`.
 *
 * It reads inputs and changes nothing.
 */
#ifndef LADDER_DEVICES_H
#define LADDER_DEVICES_H

#include "ladder/report.h"

#ifdef RUNGBOARD_SMALL
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
/** devices_print - a table of them; nothing if there are none. Returns their number. */
int devices_print(const struct sink *out);
/** devices_json - `"devices": [ … ],` and a newline. */
void devices_json(const struct sink *out);
#endif
#endif
