/* SPDX-License-Identifier: MIT
 *
 * drivers - how a driver says what is wrong.
 */
#include "hal/drivers.h"

#include <stdarg.h>
#include <stdio.h>

bool trouble_set(struct trouble *why, enum diag_id id, const char *format, ...)
{
	va_list args;

	why->id = id;
	why->line = 0;
	va_start(args, format);
	vsnprintf(why->text, sizeof(why->text), format, args);
	va_end(args);
	return false;
}
